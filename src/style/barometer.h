/** What fixes share that let the box follow a pressure: the computes that measure it, and axes that are coupled. A fix
 *  that measures a temperature only has no compute of a pressure. */
#ifndef HS_STYLE_BAROMETER_H
#define HS_STYLE_BAROMETER_H

#include "style/compute.h"
#include "style/fix.h"

/** The fix's own computes, <ID>_temp and <ID>_press of all atoms, are fix->own[0] and [1]. */
enum { HS_OWN_TEMPERATURE, HS_OWN_PRESSURE };

typedef struct hs_barometer {
    char *temperature_id, *pressure_id; /**< owned; of fix_modify temp, press; NULL: the fix's own */
    bool is_coupled[3];                 /**< axes that follow the mean of their pressures */
    bool is_iso;                        /**< all of them: the scalar pressure. Set by its user */
} hs_barometer;

/** Words of the keyword `couple`, ended by NULL: none, xyz, xy, yz, xz. */
extern const char *const hs_couplings[];
/** The coupling number @p which of these. */
void hs_barometer_couple(hs_barometer *barometer, int which);
/** Make the fix's computes, the temperature of style @p temperature; with @p is_virial the pressure is without its kinetic
 *  part. */
HS_MUST_USE hs_status hs_barometer_create(hs_fix *fix, const char *temperature, bool is_virial, hs_error *err);
/** The compute of the temperature that is in use. */
HS_MUST_USE hs_status hs_barometer_temperature(const hs_fix *fix, const hs_barometer *barometer,
                                               hs_compute **temperature, hs_error *err);
void hs_barometer_fini(hs_barometer *barometer);
/** ->set_temperature (the pressure follows it, as in LAMMPS), ->set_pressure, ->init of such a fix. */
HS_MUST_USE hs_status hs_barometer_set_temperature(hs_fix *fix, hs_barometer *barometer, const char *id, hs_error *err);
HS_MUST_USE hs_status hs_barometer_set_pressure(hs_barometer *barometer, const char *id, hs_error *err);
HS_MUST_USE hs_status hs_barometer_init(hs_fix *fix, const hs_barometer *barometer, hs_error *err);
/** Components xx yy zz xy xz yz of the pressure; those of coupled axes are their mean, and iso has but the first
 *  three, the others are 0 (collective). */
HS_MUST_USE hs_status hs_barometer_read(const hs_fix *fix, const hs_barometer *barometer, double p[6], hs_error *err);

#endif
