/* Another name of lj/smooth/linear, which decks use. */
#include "pair/force_shifted.h"

const hs_pair_style hs_pair_style_lj_sf =
    HS_FORCE_SHIFTED_STYLE("lj/sf", "Lennard-Jones with shifted force: another name of lj/smooth/linear");
