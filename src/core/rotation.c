#include "core/rotation.h"

#include <math.h>
#include <string.h>

/** Solve I omega = L by cofactors. */
static void solve_regular(const double m[3][3], double determinant, const double momentum[3], double omega[3])
{
    double inverse[3][3];
    inverse[0][0] = m[1][1] * m[2][2] - m[1][2] * m[2][1];
    inverse[0][1] = -(m[0][1] * m[2][2] - m[0][2] * m[2][1]);
    inverse[0][2] = m[0][1] * m[1][2] - m[0][2] * m[1][1];
    inverse[1][0] = -(m[1][0] * m[2][2] - m[1][2] * m[2][0]);
    inverse[1][1] = m[0][0] * m[2][2] - m[0][2] * m[2][0];
    inverse[1][2] = -(m[0][0] * m[1][2] - m[0][2] * m[1][0]);
    inverse[2][0] = m[1][0] * m[2][1] - m[1][1] * m[2][0];
    inverse[2][1] = -(m[0][0] * m[2][1] - m[0][1] * m[2][0]);
    inverse[2][2] = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) inverse[r][c] /= determinant;
    for (int r = 0; r < 3; ++r)
        omega[r] = inverse[r][0] * momentum[0] + inverse[r][1] * momentum[1] + inverse[r][2] * momentum[2];
}

/** One Jacobi rotation of the symmetric m that makes m[p][q] zero; the columns of axes turn along. */
static void rotate_away(double m[3][3], double axes[3][3], int p, int q)
{
    if (m[p][q] == 0.0) return;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double t = copysign(1.0, theta) / (fabs(theta) + sqrt(theta * theta + 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double kp = m[k][p], kq = m[k][q];
        m[k][p] = c * kp - s * kq;
        m[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; ++k) {
        const double pk = m[p][k], qk = m[q][k];
        m[p][k] = c * pk - s * qk;
        m[q][k] = s * pk + c * qk;
    }
    for (int k = 0; k < 3; ++k) {
        const double kp = axes[k][p], kq = axes[k][q];
        axes[k][p] = c * kp - s * kq;
        axes[k][q] = s * kp + c * kq;
    }
}

void hs_principal_axes(const double matrix[3][3], double values[3], double axes[3][3])
{
    enum { N_SWEEPS = 50 };
    static const double none[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    double m[3][3];
    memcpy(m, matrix, sizeof m);
    memcpy(axes, none, sizeof none);
    for (int sweep = 0; sweep < N_SWEEPS; ++sweep) {
        rotate_away(m, axes, 0, 1);
        rotate_away(m, axes, 0, 2);
        rotate_away(m, axes, 1, 2);
    }
    for (int k = 0; k < 3; ++k) values[k] = m[k][k];
}

/** Atoms on one line (or one atom) have no moment of inertia along it: solve in the principal axes without those. */
static void solve_singular(const double inertia[3][3], const double momentum[3], double omega[3])
{
    double moment[3], axes[3][3];
    hs_principal_axes(inertia, moment, axes);
    const double largest = fmax(fmax(moment[0], moment[1]), moment[2]);
    memset(omega, 0, 3 * sizeof *omega);
    for (int c = 0; c < 3; ++c) {
        if (!(moment[c] > 1.0e-7 * largest)) continue;
        const double along = axes[0][c] * momentum[0] + axes[1][c] * momentum[1] + axes[2][c] * momentum[2];
        for (int axis = 0; axis < 3; ++axis) omega[axis] += axes[axis][c] * along / moment[c];
    }
}

void hs_rotation_velocity(const double inertia[3][3], const double momentum[3], double omega[3])
{
    const double(*const m)[3] = inertia;
    const double determinant = m[0][0] * m[1][1] * m[2][2] + m[0][1] * m[1][2] * m[2][0] + m[0][2] * m[1][0] * m[2][1] -
                               m[0][0] * m[1][2] * m[2][1] - m[0][1] * m[1][0] * m[2][2] - m[2][0] * m[1][1] * m[0][2];
    if (determinant > 1.0e-6)
        solve_regular(inertia, determinant, momentum, omega);
    else
        solve_singular(inertia, momentum, omega);
}
