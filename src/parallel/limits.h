/** What may be asked of OpenMP. */
#ifndef HS_PARALLEL_LIMITS_H
#define HS_PARALLEL_LIMITS_H

/** Threads of a rank: with very many more the library ends the process. */
enum { HS_THREADS_MAX = 4096 };

#endif
