#include "base/machine.h"

#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

/** The processor's name as Linux tells it. */
static void find_processor(char *name, size_t size)
{
    char line[256];
    snprintf(name, size, "unknown processor");
    FILE *file = fopen("/proc/cpuinfo", "r");
    if (file == NULL) return;
    while (fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || colon == NULL) continue;
        colon += 1 + strspn(colon + 1, " \t");
        snprintf(name, size, "%.*s", (int)strcspn(colon, "\n"), colon);
        break;
    }
    fclose(file);
}

void hs_machine_describe(char *text, size_t size)
{
    char processor[160];
    struct utsname system;
    find_processor(processor, sizeof processor);
    if (uname(&system) != 0) strcpy(system.sysname, "unknown system"), system.release[0] = system.machine[0] = '\0';
    snprintf(text, size, "%s, %ld cores, %s %s %s", processor, sysconf(_SC_NPROCESSORS_ONLN), system.sysname,
             system.release, system.machine);
}
