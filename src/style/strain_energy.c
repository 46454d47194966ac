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

/** S of the components that are wanted; h0^-T diag(h0) has ones on its diagonal and mixes those in its lower half into
 *  the others. */
static void find_stress(double h[3][3], double inverse[3][3], const double stress[6], double s[3][3])
{
    const double m21 = inverse[0][1] * h[0][0], m31 = inverse[0][2] * h[0][0], m32 = inverse[1][2] * h[1][1];
    s[2][2] = stress[2];
    s[0][2] = s[2][0] = stress[4];
    s[1][2] = s[2][1] = stress[5];
    s[0][1] = s[1][0] = stress[3] - s[0][2] * m32;
    s[1][1] = stress[1] - s[1][2] * m32;
    s[0][0] = stress[0] - s[0][1] * m21 - s[0][2] * m31;
}

void hs_strain_energy_set(hs_strain_energy *strain, const hs_box *box, const double stress[6])
{
    double h[3][3], inverse[3][3], s[3][3];
    find_edges(box, h);
    invert(h, inverse);
    find_stress(h, inverse, stress, s);
    strain->volume = hs_box_volume(box);
    memset(strain->sigma, 0, sizeof strain->sigma);
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            for (int c = 0; c < 3; ++c)
                for (int d = 0; d < 3; ++d)
                    strain->sigma[a][b] += strain->volume * inverse[a][c] * s[c][d] * inverse[b][d];
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

void hs_strain_energy_forces(const hs_strain_energy *strain, const hs_box *box, double force[6])
{
    static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    double h[3][3];
    find_edges(box, h);
    for (int k = 0; k < 6; ++k) {
        force[k] = 0.0;
        for (int c = 0; c < 3; ++c) force[k] += h[row[k]][c] * strain->sigma[c][column[k]];
    }
}
