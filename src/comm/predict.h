/** What a decomposition will cost, from geometry alone: nothing is run. */
#ifndef HS_COMM_PREDICT_H
#define HS_COMM_PREDICT_H

#include "comm/domain.h"

/** The brick in the middle of the box, which has the most neighbors. */
typedef struct hs_prediction {
    int n[3];         /**< bricks per axis */
    double length[3]; /**< of a brick, distance */
    double n_local;   /**< atoms of a rank */
    double n_halo;    /**< halo atoms, periodic images of the rank's own atoms included */
    double n_remote;  /**< those of them that other ranks send, as many as are sent to others */
    int n_partners; /**< ranks that atoms are sent to, as many as they are received from: messages one way in a step */
} hs_prediction;

/** Cut the box for so many ranks and describe a brick, for atoms spread evenly. @p reach is how far halos extend, distance;
 *  @p wanted is that of hs_domain. Not collective. An error when no grid fits, or bricks are far thinner than the reach. */
HS_MUST_USE hs_status hs_predict(hs_prediction *prediction, const hs_box *box, const int wanted[3], int n_ranks,
                                 double n_atoms, double reach, hs_error *err);

#endif
