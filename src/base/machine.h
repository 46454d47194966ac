/** What this machine is, for logs that are read elsewhere. */
#ifndef HS_BASE_MACHINE_H
#define HS_BASE_MACHINE_H

#include <stddef.h>

/** Processor, number of cores, operating system, in one line without newline; cut to @p size. */
void hs_machine_describe(char *text, size_t size);

#endif
