/* pool.c: threads that live during one pool_run: POSIX's or Windows's. */
#if defined(_WIN32)
#undef _WIN32_WINNT
#define _WIN32_WINNT 0x0600 /* SRWLOCK: Windows Vista */
#elif !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* sysconf, pthread */
#if defined(__APPLE__)
#define _DARWIN_C_SOURCE /* _SC_NPROCESSORS_ONLN */
#endif
#endif
#include "pool.h"

typedef struct worker worker;
static void work(worker *w);

/* --- names of the systems: a lock, a thread, number of processors ------------------------------------------------- */

#if defined(_WIN32)

#include <windows.h>

#include <process.h>

typedef SRWLOCK lock;
typedef HANDLE thread;
#define LOCK_FREE SRWLOCK_INIT
static void hold(lock *l) { AcquireSRWLockExclusive(l); }
static void let_go(lock *l) { ReleaseSRWLockExclusive(l); }

static unsigned __stdcall begin(void *argument)
{
    work(argument);
    return 0;
}

/* Uses the C library's call, which gives the thread its own errno. */
static int start(thread *out, worker *w)
{
    *out = (HANDLE)_beginthreadex(NULL, 0, begin, w, 0, NULL);
    return *out != NULL;
}

static void join(thread t)
{
    WaitForSingleObject(t, INFINITE);
    CloseHandle(t);
}

static void let_others_run(void) { SwitchToThread(); }

static long processors(void)
{
    SYSTEM_INFO about;
    GetSystemInfo(&about);
    return (long)about.dwNumberOfProcessors;
}

#else

#include <pthread.h>
#include <sched.h>
#include <unistd.h>

typedef pthread_mutex_t lock;
typedef pthread_t thread;
#define LOCK_FREE PTHREAD_MUTEX_INITIALIZER
static void hold(lock *l) { pthread_mutex_lock(l); }
static void let_go(lock *l) { pthread_mutex_unlock(l); }

static void *begin(void *argument)
{
    work(argument);
    return NULL;
}

static int start(thread *out, worker *w) { return pthread_create(out, NULL, begin, w) == 0; }
static void join(thread t) { pthread_join(t, NULL); }
static void let_others_run(void) { sched_yield(); }

static long processors(void)
{
#ifdef _SC_NPROCESSORS_ONLN
    return sysconf(_SC_NPROCESSORS_ONLN);
#else
    return 1;
#endif
}

#endif

/* --- the pool ----------------------------------------------------------------------------------------------------- */

typedef struct pool {
    lock next_lock;
    int next, count; /* next .. count - 1 are the free parts */
    int first, done; /* parts of the first stage; number of those done */
    pool_job job;
    void *user;
} pool;

struct worker {
    pool *shared;
    int number; /* and the first part: without a lock, which would hide shared accesses of two
                 * parts from a race detector */
    thread own;
};

int pool_processors(void)
{
    const long n = processors();
    return n < 1 ? 1 : n > POOL_MAX ? POOL_MAX : (int)n;
}

int pool_threads(int asked) { return asked < 1 ? pool_processors() : asked > POOL_MAX ? POOL_MAX : asked; }

static int take(pool *p)
{
    hold(&p->next_lock);
    int i = p->next < p->count ? p->next++ : -1;
    let_go(&p->next_lock);
    return i;
}

static void note_done(pool *p)
{
    hold(&p->next_lock);
    ++p->done;
    let_go(&p->next_lock);
}

/* Waits until other threads finished their parts of the first stage: one part each, or more if
 * threads could not be started. */
static void await_first(pool *p)
{
    for (int done = 0; !done;) {
        hold(&p->next_lock);
        done = p->done == p->first;
        let_go(&p->next_lock);
        if (!done) {
            let_others_run();
        }
    }
}

static void do_part(pool *p, int i, int number)
{
    if (i >= p->first && p->first > 0) {
        await_first(p);
    }
    p->job(p->user, i, number);
    if (i < p->first) {
        note_done(p);
    }
}

static void work(worker *w)
{
    for (int i = w->number; i >= 0; i = take(w->shared)) {
        do_part(w->shared, i, w->number);
    }
}

void pool_run(int threads, int count, pool_job job, void *user) { pool_run_stages(threads, 0, count, job, user); }

void pool_run_stages(int threads, int first, int count, pool_job job, void *user)
{
    threads = threads < 1 ? 1 : threads;
    threads = threads > count ? count : threads;
    threads = first > 0 && threads > first ? first : threads;
    threads = threads > POOL_MAX ? POOL_MAX : threads;
    pool p = {LOCK_FREE, threads, count, first, 0, job, user};
    worker workers[POOL_MAX];
    int started = 1;
    for (int i = 0; i < POOL_MAX; ++i) {
        workers[i].shared = &p;
        workers[i].number = i;
    }
    while (started < threads && start(&workers[started].own, &workers[started])) {
        ++started;
    }
    for (int i = started; i < threads; ++i) {
        do_part(&p, i, 0);
    }
    if (threads > 0) {
        work(&workers[0]);
    }
    for (int i = 1; i < started; ++i) {
        join(workers[i].own);
    }
}
