/* host.c: clock, terminal and file limit of a desktop: POSIX, Windows, or plain C. */
#if !defined(_WIN32)
#define _XOPEN_SOURCE 600 /* clock_gettime, isatty, mkdir, SIGXFSZ, sigaction */
#endif
#include "host.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#if defined(_WIN32)
#include <windows.h>

#include <direct.h>
#include <io.h>
static int make_folder(const char *path) { return _mkdir(path); }
static int is_separator(char c) { return c == '/' || c == '\\'; }
double host_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
static double seconds_of(FILETIME t)
{
    return 1e-7 * ((double)t.dwHighDateTime * 4294967296.0 + (double)t.dwLowDateTime);
}
double host_cpu_seconds(void) /* clock() returns the time of day there */
{
    FILETIME from, to, system, user;
    return GetProcessTimes(GetCurrentProcess(), &from, &to, &system, &user) ? seconds_of(system) + seconds_of(user)
                                                                             : (double)clock() / CLOCKS_PER_SEC;
}
void host_sleep(double seconds) { Sleep((DWORD)(1e3 * seconds)); }
int host_watched(void) { return _isatty(2); }
#else
#include <fcntl.h>
#include <poll.h>
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
void host_sleep(double seconds)
{
    struct timespec t;
    t.tv_sec = (time_t)seconds;
    t.tv_nsec = (long)(1e9 * (seconds - (double)t.tv_sec));
    nanosleep(&t, NULL); /* a signal may end the sleep early */
}
int host_watched(void) { return isatty(STDERR_FILENO); }
#endif

#if defined(SIGXFSZ)
void host_outlive_file_limit(void) { signal(SIGXFSZ, SIG_IGN); }
#else
void host_outlive_file_limit(void) {}
#endif

#define BLANKS "                                        "
static const char blank_line[] = "\r" BLANKS BLANKS "\r";

#if defined(_WIN32)
void host_take_streams(void) {}
void host_end_cleanly(void (*clean)(void)) { (void)clean; }
void host_hold_signals(int is_held) { (void)is_held; }
void host_print_now(const char *text, size_t size) { (void)!_write(2, text, (unsigned)size); }
#else
static const int ends[] = {SIGINT, SIGTERM, SIGHUP};
static void (*clean_up)(void);

void host_take_streams(void)
{
    for (int i = 0; i < 3; ++i) {
        if (fcntl(i, F_GETFD) == -1 && errno == EBADF) { /* open returns the lowest free number, this one */
            (void)!open("/dev/null", i == 0 ? O_WRONLY : O_RDONLY);
        }
    }
}

/* The signal is pending until the handler returns; then it ends the program, because it has no handler any more. */
static void end(int number)
{
    clean_up();
    raise(number);
}

void host_end_cleanly(void (*clean)(void))
{
    clean_up = clean;
    for (size_t i = 0; i < sizeof ends / sizeof *ends; ++i) {
        struct sigaction now, new;
        memset(&new, 0, sizeof new);
        new.sa_handler = end;
        new.sa_flags = (int)SA_RESETHAND;
        sigemptyset(&new.sa_mask);
        if (sigaction(ends[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN) {
            sigaction(ends[i], &new, NULL);
        }
    }
}

void host_hold_signals(int is_held)
{
    sigset_t all;
    sigemptyset(&all);
    for (size_t i = 0; i < sizeof ends / sizeof *ends; ++i) {
        sigaddset(&all, ends[i]);
    }
    sigprocmask(is_held ? SIG_BLOCK : SIG_UNBLOCK, &all, NULL);
}

void host_print_now(const char *text, size_t size)
{
    struct pollfd err;
    err.fd = STDERR_FILENO;
    err.events = POLLOUT;
    /* Some systems cannot poll terminals and return POLLNVAL. */
    if (poll(&err, 1, 0) == 1 && (err.revents & (POLLERR | POLLHUP)) == 0 && (err.revents & (POLLOUT | POLLNVAL)) != 0) {
        (void)!write(STDERR_FILENO, text, size);
    }
}
#endif

void host_wipe_line(void) { host_print_now(blank_line, sizeof blank_line - 1); }

/* Reads Linux's list of processors: `model name : NAME` once for each. */
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
