/** Wall-clock time and the phases of a run that are timed by name. */
#ifndef HS_BASE_TIMER_H
#define HS_BASE_TIMER_H

/** Phases of a timestep, in the order of LAMMPS's timing table. */
typedef enum {
    HS_PHASE_PAIR,   /**< pair kernels and the reduction of thread buffers */
    HS_PHASE_NEIGH,  /**< sort, cells, lists, displacement check */
    HS_PHASE_COMM,   /**< wrap, migration, halo forward and reverse */
    HS_PHASE_OUTPUT, /**< thermo, dumps, checkpoints */
    HS_PHASE_MODIFY, /**< fixes: integration, thermostats, walls */
    HS_N_PHASES
} hs_phase;

/** Parts of HS_PHASE_COMM. */
typedef enum {
    HS_COMM_PACK,     /**< halo: positions and forces into messages, own images */
    HS_COMM_WAIT,     /**< halo: messages that are not there yet */
    HS_COMM_UNPACK,   /**< halo: positions and forces out of messages */
    HS_COMM_AGREE,    /**< sums and maxima that all ranks wait for at every step */
    HS_COMM_EXCHANGE, /**< when lists are due: atoms wrapped, migrated, balanced; the new halo */
    HS_N_COMM_PARTS
} hs_comm_part;

typedef struct hs_timer {
    double phase_s[HS_N_PHASES];    /**< seconds spent in each phase since reset */
    double comm_s[HS_N_COMM_PARTS]; /**< those of HS_PHASE_COMM */
    double start_s;                 /**< when the timer was reset */
    double last_s;                  /**< when the last phase ended */
} hs_timer;

/** Seconds of a monotonic clock. */
double hs_time_now_s(void);
/** Seconds of processor time of all threads of this process. */
double hs_time_cpu_s(void);

void hs_timer_reset(hs_timer *timer);
/** Skip what happened since the last mark: it belongs to no phase ("Other"). */
void hs_timer_mark(hs_timer *timer);
/** Add the time since the last mark to @p phase, and mark. HS_PHASE_COMM has a function of its own. */
void hs_timer_add(hs_timer *timer, hs_phase phase);
void hs_timer_add_comm(hs_timer *timer, hs_comm_part part);

#endif
