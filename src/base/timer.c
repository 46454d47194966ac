#include "base/timer.h"

#include <string.h>
#include <time.h>

static double clock_s(clockid_t id)
{
    struct timespec now;
    clock_gettime(id, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double hs_time_now_s(void) { return clock_s(CLOCK_MONOTONIC); }

double hs_time_cpu_s(void) { return clock_s(CLOCK_PROCESS_CPUTIME_ID); }

void hs_timer_reset(hs_timer *timer)
{
    memset(timer, 0, sizeof *timer);
    timer->start_s = timer->last_s = hs_time_now_s();
}

void hs_timer_mark(hs_timer *timer) { timer->last_s = hs_time_now_s(); }

void hs_timer_add(hs_timer *timer, hs_phase phase)
{
    double now_s = hs_time_now_s();
    timer->phase_s[phase] += now_s - timer->last_s;
    timer->last_s = now_s;
}

void hs_timer_add_comm(hs_timer *timer, hs_comm_part part)
{
    const double before_s = timer->phase_s[HS_PHASE_COMM];
    hs_timer_add(timer, HS_PHASE_COMM);
    timer->comm_s[part] += timer->phase_s[HS_PHASE_COMM] - before_s;
}
