/* pool.c: POSIX threads that live as long as one pool_run; elsewhere the caller does it all. */
#if !defined(_WIN32) && !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* sysconf, pthread */
#endif
#include "pool.h"

int pool_threads(int asked) { return asked < 1 ? pool_processors() : asked > POOL_MAX ? POOL_MAX : asked; }

#ifdef _WIN32

int pool_processors(void) { return 1; }

void pool_run(int threads, int count, pool_job job, void *user)
{
    (void)threads;
    for (int i = 0; i < count; ++i) {
        job(user, i, 0);
    }
}

#else

#include <pthread.h>
#include <unistd.h>

typedef struct pool {
    pthread_mutex_t lock; /* of `next` */
    int next, count;      /* parts that nobody has taken: next .. count - 1 */
    pool_job job;
    void *user;
} pool;

typedef struct worker {
    pool *shared;
    int number; /* and its first part: by no lock, which would hide from a race detector what two parts both touch */
    pthread_t thread;
} worker;

int pool_processors(void)
{
#ifdef _SC_NPROCESSORS_ONLN
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > POOL_MAX ? POOL_MAX : (int)n;
#else
    return 1;
#endif
}

static int take(pool *p)
{
    pthread_mutex_lock(&p->lock);
    int i = p->next < p->count ? p->next++ : -1;
    pthread_mutex_unlock(&p->lock);
    return i;
}

static void *work(void *argument)
{
    worker *w = argument;
    for (int i = w->number; i >= 0; i = take(w->shared)) {
        w->shared->job(w->shared->user, i, w->number);
    }
    return NULL;
}

void pool_run(int threads, int count, pool_job job, void *user)
{
    threads = threads < 1 ? 1 : threads;
    threads = threads > count ? count : threads;
    threads = threads > POOL_MAX ? POOL_MAX : threads;
    pool p = {PTHREAD_MUTEX_INITIALIZER, threads, count, job, user};
    worker workers[POOL_MAX];
    int started = 1;
    for (int i = 0; i < POOL_MAX; ++i) {
        workers[i].shared = &p;
        workers[i].number = i;
    }
    while (started < threads && pthread_create(&workers[started].thread, NULL, work, &workers[started]) == 0) {
        ++started;
    }
    for (int i = started; i < threads; ++i) {
        job(user, i, 0);
    }
    if (threads > 0) {
        work(&workers[0]);
    }
    for (int i = 1; i < started; ++i) {
        pthread_join(workers[i].thread, NULL);
    }
}

#endif
