/* host.c: the clock, the terminal and the file limit of a desktop: POSIX, Windows, or plain C. */
#if !defined(_WIN32)
#define _XOPEN_SOURCE 600 /* clock_gettime, isatty, SIGXFSZ */
#endif
#include "host.h"

#include <signal.h>
#include <stdio.h>
#include <time.h>

#if defined(_WIN32)
#include <io.h>
double host_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
double host_cpu_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
int host_watched(void) { return _isatty(2); }
#else
#include <unistd.h>
double host_seconds(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_MONOTONIC, &t) == 0 ? (double)t.tv_sec + 1e-9 * (double)t.tv_nsec
                                                   : (double)clock() / CLOCKS_PER_SEC;
}
double host_cpu_seconds(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t) == 0 ? (double)t.tv_sec + 1e-9 * (double)t.tv_nsec
                                                            : (double)clock() / CLOCKS_PER_SEC;
}
int host_watched(void) { return isatty(STDERR_FILENO); }
#endif

#if defined(SIGXFSZ)
void host_outlive_file_limit(void) { signal(SIGXFSZ, SIG_IGN); }
#else
void host_outlive_file_limit(void) {}
#endif
