/* Homogeneous flow at constant temperature: the SLLOD equations with Nose-Hoover chains. */
#include "style/box_flow.h"
#include "style/nose_hoover.h"

static hs_status create(hs_fix *fix, const hs_args *args, hs_error *err)
{
    ((hs_nose_hoover *)fix->state)->is_sllod = true;
    return hs_nose_hoover_create(fix, args, true, false, err);
}

static hs_status init(hs_fix *fix, hs_error *err)
{
    const hs_box_flow *flow = fix->env->box_flow;
    if (flow == NULL)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: there is no fix deform whose change of the box would be the flow; fix nvt is for fluids at rest",
            hs_fix_who(fix).text);
    if (flow->moves_velocities == 0)
        return hs_fail(
            err, HS_ERROR_INPUT,
            "%s: fix deform must have 'remap v', so that atoms which cross a face take the velocity of their image",
            hs_fix_who(fix).text);
    return hs_nose_hoover_init(fix, err);
}

const hs_fix_style hs_fix_style_nvt_sllod = {
    .about =
        {.name = "nvt/sllod",
         .syntax = {.usage = "temp <Tstart> <Tstop> <Tdamp> [keyword value ...]",
                    .n_min = 0,
                    .n_max = 0,
                    .keywords = hs_nose_hoover_sllod_keywords},
         .summary = "integrate a homogeneous flow at constant temperature (SLLOD)",
         .details =
             "For fluids that flow with a box which fix deform shears or stretches (`remap v`): moves the atoms of the "
             "group, in the place of fix nve, by the SLLOD equations, in which the velocity gradient acts on all atoms "
             "alike and not by walls. The thermostat is that of fix nvt, with its keywords, and acts on the velocities "
             "without the flow (compute temp/deform, which the fix makes as `ID_temp`). `tchain` is 1 by default, for "
             "longer chains take long to become steady in a flow.\n\n"
             "With the velocity u of a place in the flow, its gradient G and c = v - u the equations are x' = v, m v' "
             "= f - m G c - (p_eta/Q) m c, as LAMMPS integrates them. The flow acts on c twice in this, here and as "
             "atoms move to places with another u: docs/shear-flow.md tells how much that is (some percent of a "
             "liquid's viscosity), and how to do without. `psllod yes` has G v in place of G c (p-SLLOD), the same for "
             "a simple shear: LAMMPS of 2021 has only this variant, later versions have both, and this default.\n\n"
             "With `fix deform ... xy erate <R>` the viscosity is -<Pxy>/R, where the pressure's kinetic part is that "
             "of the thermal velocities: `thermo_modify temp ID_temp`. At high rates a fluid thins.\n\n"
             "A fluid that is at rest when the box begins to move is set into motion in some time; `velocity all ramp "
             "vx ... y ...` begins with the profile. `compute temp/profile`, or fix ave/chunk, shows it. Scalar and "
             "vector are those of fix nvt.",
         .reference = "D. J. Evans, G. P. Morriss, Phys. Rev. A 30, 1528 (1984), doi:10.1103/PhysRevA.30.1528; P. J. "
                      "Daivis, B. D. Todd, J. Chem. Phys. 124, 194103 (2006), doi:10.1063/1.2192775",
         .example = "fix 1 all nvt/sllod temp 1.0 1.0 0.5\nfix 2 all deform 1 xy erate 0.1 remap v\nthermo_modify temp "
                    "1_temp"},
    HS_NOSE_HOOVER_HOOKS,
    .init = init,
    .allows_dynamic_group = true,
};
