/* pool.h: shares work among a desktop's processors. The library starts no threads: a band gets the
 * same bytes on any thread. */
#ifndef POOL_H
#define POOL_H

enum { POOL_MAX = 64 };

/* Processors that can work at once, 1 .. POOL_MAX; 1 if the system does not report the number or has no threads. */
int pool_processors(void);

/* pool_threads: the requested number, at most POOL_MAX; 0: one for each processor. */
int pool_threads(int asked);

/* One piece of work, 0 <= index < count, on worker 0 .. threads - 1; worker 0 is the caller. */
typedef void (*pool_job)(void *user, int index, int worker);

/* pool_run: runs each piece once, started in rising order (except a thread's first), on up to `threads` threads.
 * Returns when all are done. If the system refuses threads, uses fewer. */
void pool_run(int threads, int count, pool_job job, void *user);

/* pool_run_stages: the same, but pieces first .. count - 1 start after pieces 0 .. first - 1 are done. Threads start
 * once for both and keep their caches. `threads` <= first; larger values are reduced to first. */
void pool_run_stages(int threads, int first, int count, pool_job job, void *user);

#endif
