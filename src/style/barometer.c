#include "style/barometer.h"

#include <string.h>

#include "base/memory.h"

const char *const hs_couplings[] = {"none", "xyz", "xy", "yz", "xz", NULL};

void hs_barometer_couple(hs_barometer *barometer, int which)
{
    static const bool axes[][3] = {
        {0}, {true, true, true}, {true, true, false}, {false, true, true}, {true, false, true}};
    memcpy(barometer->is_coupled, axes[which], sizeof barometer->is_coupled);
}

hs_status hs_barometer_create(hs_fix *fix, const char *temperature, bool is_virial, hs_error *err)
{
    static const char *const words[] = {"thermo_temp", "virial"}; /* the first until the fix's own can be found */
    const hs_args none = {.command = "fix"}, pressure_words = {.command = "fix", .n = 1 + is_virial, .word = words};
    HS_TRY(hs_fix_own_compute(fix, HS_OWN_TEMPERATURE, temperature, "temp", 0, &none, err));
    HS_TRY(hs_fix_own_compute(fix, HS_OWN_PRESSURE, "pressure", "press", 0, &pressure_words, err));
    hs_compute *pressure = fix->own[HS_OWN_PRESSURE];
    return pressure->style->set_temperature(pressure, fix->own[HS_OWN_TEMPERATURE]->id, err);
}

void hs_barometer_fini(hs_barometer *barometer)
{
    HS_FREE(barometer->temperature_id);
    HS_FREE(barometer->pressure_id);
}

static hs_status find(const hs_fix *fix, const hs_barometer *barometer, int which, hs_compute **compute, hs_error *err)
{
    const char *id = which == HS_OWN_TEMPERATURE ? barometer->temperature_id : barometer->pressure_id;
    const hs_measure what = which == HS_OWN_TEMPERATURE ? HS_TEMPERATURE : HS_PRESSURE;
    *compute = fix->own[which];
    return id == NULL ? HS_OK : hs_compute_get(fix->env, id, what, hs_fix_who(fix).text, compute, err);
}

hs_status hs_barometer_temperature(const hs_fix *fix, const hs_barometer *barometer, hs_compute **temperature,
                                   hs_error *err)
{
    return find(fix, barometer, HS_OWN_TEMPERATURE, temperature, err);
}

hs_status hs_barometer_set_temperature(hs_fix *fix, hs_barometer *barometer, const char *id, hs_error *err)
{
    hs_compute *pressure;
    HS_TRY(hs_memory_replace(&barometer->temperature_id, id, err));
    if (fix->own[HS_OWN_PRESSURE] == NULL) return HS_OK;
    HS_TRY(find(fix, barometer, HS_OWN_PRESSURE, &pressure, err));
    return pressure->style->set_temperature != NULL ? pressure->style->set_temperature(pressure, id, err) : HS_OK;
}

hs_status hs_barometer_set_pressure(hs_barometer *barometer, const char *id, hs_error *err)
{
    return hs_memory_replace(&barometer->pressure_id, id, err);
}

hs_status hs_barometer_init(hs_fix *fix, const hs_barometer *barometer, hs_error *err)
{
    for (int which = HS_OWN_TEMPERATURE; which <= HS_OWN_PRESSURE; ++which) {
        hs_compute *compute;
        if (fix->own[which] == NULL) continue;
        HS_TRY(find(fix, barometer, which, &compute, err));
        if (fix->own[which]->style->init != NULL) HS_TRY(fix->own[which]->style->init(fix->own[which], err));
    }
    return HS_OK;
}

hs_status hs_barometer_read(const hs_fix *fix, const hs_barometer *barometer, double p[6], hs_error *err)
{
    hs_compute *pressure;
    double sum = 0.0;
    int n = 0;
    HS_TRY(find(fix, barometer, HS_OWN_PRESSURE, &pressure, err));
    if (barometer->is_iso) {
        HS_TRY(hs_compute_scalar(pressure, &p[0], err));
        p[1] = p[2] = p[0];
        p[3] = p[4] = p[5] = 0.0;
        return HS_OK;
    }
    HS_TRY(hs_compute_eval_vector(pressure, err));
    memcpy(p, pressure->vector, 6 * sizeof *p);
    for (int axis = 0; axis < fix->env->box->dimension; ++axis) {
        n += barometer->is_coupled[axis];
        if (barometer->is_coupled[axis]) sum += p[axis];
    }
    for (int axis = 0; axis < fix->env->box->dimension; ++axis)
        if (barometer->is_coupled[axis]) p[axis] = sum / n;
    return HS_OK;
}
