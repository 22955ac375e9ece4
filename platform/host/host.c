/* host.c: the clock and the terminal of a desktop: POSIX, Windows, or plain C. */
#if !defined(_WIN32)
#define _POSIX_C_SOURCE 200112L
#endif
#include "host.h"

#include <stdio.h>
#include <time.h>

#if defined(_WIN32)
#include <io.h>
double host_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
int host_watched(void) { return _isatty(2); }
#else
#include <unistd.h>
double host_seconds(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_MONOTONIC, &t) == 0 ? (double)t.tv_sec + 1e-9 * (double)t.tv_nsec
                                                   : (double)clock() / CLOCKS_PER_SEC;
}
int host_watched(void) { return isatty(STDERR_FILENO); }
#endif
