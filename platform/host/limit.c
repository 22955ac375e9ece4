/* limit.c: limits the time that the program may take. A thread waits for the limit, because only a thread works during
 * a long call on every system: Windows has no alarm, and a signal might arrive while a file has no name yet. */
#if defined(_WIN32)
#undef _WIN32_WINNT
#define _WIN32_WINNT 0x0600 /* SRWLOCK: Windows Vista */
#elif !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* pthread */
#endif
#include "limit.h"

#include "host.h"

#define LONGEST_S 60.0 /* longest single sleep; a signal may end it early */

static struct limit {
    double until; /* s */
    void (*over)(void);
    int is_set, is_ended;
} limit;

static void watch(void);

#if defined(_WIN32)

#include <windows.h>

#include <process.h>
#include <stdlib.h>

static SRWLOCK lock = SRWLOCK_INIT;
static void hold(void) { AcquireSRWLockExclusive(&lock); }
static void let_go(void) { ReleaseSRWLockExclusive(&lock); }

static unsigned __stdcall begin(void *unused)
{
    (void)unused;
    watch();
    return 0;
}

static int start(void)
{
    const HANDLE thread = (HANDLE)_beginthreadex(NULL, 0, begin, NULL, 0, NULL);
    if (thread != NULL) {
        CloseHandle(thread);
    }
    return thread != NULL;
}

#else

#include <pthread.h>
#include <unistd.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static void hold(void) { pthread_mutex_lock(&lock); }
static void let_go(void) { pthread_mutex_unlock(&lock); }

static void *begin(void *unused)
{
    (void)unused;
    watch();
    return NULL;
}

static int start(void)
{
    pthread_t thread;
    return pthread_create(&thread, NULL, begin, NULL) == 0 && pthread_detach(thread) == 0;
}

#endif

static void watch(void)
{
    double left;
    while ((left = limit.until - host_seconds()) > 0.0) {
        host_sleep(left < LONGEST_S ? left : LONGEST_S);
    }
    hold();
    if (!limit.is_ended) {
        limit.over();
        _exit(1);
    }
    let_go();
}

int limit_time(double seconds, void (*over)(void))
{
    if (limit.is_set) {
        return 1;
    }
    limit.until = host_seconds() + seconds;
    limit.over = over;
    limit.is_set = start();
    return limit.is_set;
}

void limit_hold(int is_held) { (is_held ? hold : let_go)(); }

void limit_end(void)
{
    hold();
    limit.is_ended = 1;
    let_go();
}
