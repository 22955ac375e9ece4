/* host.c: the clock, the terminal and the file limit of a desktop: POSIX, Windows, or plain C. */
#if !defined(_WIN32)
#define _XOPEN_SOURCE 600 /* clock_gettime, isatty, mkdir, SIGXFSZ */
#endif
#include "host.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#if defined(_WIN32)
#include <direct.h>
#include <io.h>
static int make_folder(const char *path) { return _mkdir(path); }
static int is_separator(char c) { return c == '/' || c == '\\'; }
double host_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
double host_cpu_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
int host_watched(void) { return _isatty(2); }
#else
#include <sys/stat.h>
#include <unistd.h>
static int make_folder(const char *path) { return mkdir(path, 0777); }
static int is_separator(char c) { return c == '/'; }
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

/* Linux's list of processors: `model name : NAME` once for each. */
void host_processor(char *out, int size)
{
    char line[256];
    FILE *f = fopen("/proc/cpuinfo", "r");
    out[0] = '\0';
    while (f != NULL && out[0] == '\0' && fgets(line, sizeof line, f) != NULL) {
        const char *name = strchr(line, ':');
        line[strcspn(line, "\n")] = '\0';
        if (strncmp(line, "model name", 10) == 0 && name != NULL) {
            snprintf(out, (size_t)size, "%s", name + 1 + (name[1] == ' '));
        }
    }
    if (f != NULL) {
        fclose(f);
    }
}

void host_make_folders(const char *path)
{
    char folder[1024];
    for (size_t i = 0; path[i] != '\0' && i < sizeof folder; ++i) {
        folder[i] = path[i];
        if (i > 0 && is_separator(path[i])) {
            folder[i] = '\0';
            make_folder(folder);
            folder[i] = path[i];
        }
    }
}
