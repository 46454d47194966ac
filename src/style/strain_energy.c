#include "style/strain_energy.h"

#include <string.h>

/** h[a][b]: component a of edge b. */
static void find_edges(const hs_box *box, double h[3][3])
{
    memset(h, 0, 9 * sizeof h[0][0]);
    for (int axis = 0; axis < 3; ++axis) h[axis][axis] = hs_box_length(box, axis);
    h[0][1] = box->tilt[0];
    h[0][2] = box->tilt[1];
    h[1][2] = box->tilt[2];
}

static void invert(double h[3][3], double inverse[3][3])
{
    memset(inverse, 0, 9 * sizeof inverse[0][0]);
    for (int a = 0; a < 3; ++a) inverse[a][a] = 1.0 / h[a][a];
    inverse[0][1] = -h[0][1] * inverse[0][0] * inverse[1][1];
    inverse[1][2] = -h[1][2] * inverse[1][1] * inverse[2][2];
    inverse[0][2] = (h[0][1] * h[1][2] * inverse[1][1] - h[0][2]) * inverse[0][0] * inverse[2][2];
}

void hs_strain_energy_set(hs_strain_energy *strain, const hs_box *box, const double s[6])
{
    static const int at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
    double h[3][3], inverse[3][3];
    find_edges(box, h);
    invert(h, inverse);
    strain->volume = hs_box_volume(box);
    memset(strain->sigma, 0, sizeof strain->sigma);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            for (int c = 0; c < 3; ++c)
                for (int d = 0; d < 3; ++d)
                    strain->sigma[a][b] += strain->volume * inverse[a][c] * s[at[c][d]] * inverse[b][d];
}

/** h0^-T diag(h0) has ones on its diagonal and mixes those components in its lower half into the others. */
void hs_strain_energy_set_at_rest(hs_strain_energy *strain, const hs_box *box, const double stress[6])
{
    double h[3][3], inverse[3][3], s[6];
    find_edges(box, h);
    invert(h, inverse);
    const double m21 = inverse[0][1] * h[0][0], m31 = inverse[0][2] * h[0][0], m32 = inverse[1][2] * h[1][1];
    s[2] = stress[2];
    s[4] = stress[4];
    s[5] = stress[5];
    s[3] = stress[3] - s[4] * m32;
    s[1] = stress[1] - s[5] * m32;
    s[0] = stress[0] - s[3] * m21 - s[4] * m31;
    hs_strain_energy_set(strain, box, s);
}

double hs_strain_energy_of(const hs_strain_energy *strain, const hs_box *box)
{
    double h[3][3], sum = 0.0;
    find_edges(box, h);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            for (int c = 0; c < 3; ++c) sum += 0.5 * strain->sigma[a][b] * h[c][a] * h[c][b];
    return sum;
}

static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};

/** h sigma: component a along edge b. */
static void find_forces(const hs_strain_energy *strain, double h[3][3], double force[3][3])
{
    memset(force, 0, 9 * sizeof force[0][0]);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            for (int c = 0; c < 3; ++c) force[a][b] += h[a][c] * strain->sigma[c][b];
}

void hs_strain_energy_forces(const hs_strain_energy *strain, const hs_box *box, double force[6])
{
    double h[3][3], all[3][3];
    find_edges(box, h);
    find_forces(strain, h, all);
    for (int k = 0; k < 6; ++k) force[k] = all[row[k]][column[k]];
}

void hs_strain_energy_stress(const hs_strain_energy *strain, const hs_box *box, double stress[6])
{
    double h[3][3], force[3][3];
    find_edges(box, h);
    find_forces(strain, h, force);
    for (int k = 0; k < 6; ++k) {
        stress[k] = 0.0;
        for (int c = 0; c < 3; ++c) stress[k] += force[row[k]][c] * h[column[k]][c];
    }
}
