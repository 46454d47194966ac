/** Parts of a pressure or a stress, by keywords: what compute pressure and compute stress/atom share. */
#ifndef HS_STYLE_STRESS_PARTS_H
#define HS_STYLE_STRESS_PARTS_H

#include "style/args.h"

typedef struct hs_stress_parts {
    bool has_ke, has_pair, has_fix; /**< motion; pair style; fixes with `fix_modify virial yes` */
} hs_stress_parts;

/** `ke`, `pair`, `fix`, `virial` (all but ke), and LAMMPS's words for parts that are 0 here; ended by a NULL name. */
extern const hs_keyword hs_stress_parts_keywords[];

/** The parts that the words from index @p first on ask for: all of them when there are none. The words must have passed
 *  hs_syntax_check. */
hs_stress_parts hs_stress_parts_read(const hs_args *args, int first);

#endif
