/* pool.h: work shared out among a desktop's processors. The library knows of no threads: what it does with a band is
 * the same on any of them. */
#ifndef POOL_H
#define POOL_H

enum { POOL_MAX = 64 };

/* Processors that can work at once, 1 .. POOL_MAX; 1 where the system does not say or has no threads. */
int pool_processors(void);

/* pool_threads: as many as were asked for, at most POOL_MAX; 0: one a processor. */
int pool_threads(int asked);

/* One piece of work, 0 <= index < count, done by one of the workers 0 .. threads - 1; worker 0 is the caller. */
typedef void (*pool_job)(void *user, int index, int worker);

/* pool_run: all pieces, each once, begun in rising order (but a thread's first), on up to `threads` threads. Returns
 * when all are done. Threads that the system refuses are done without. */
void pool_run(int threads, int count, pool_job job, void *user);

/* pool_run_stages: the same, but pieces first .. count - 1 begin when pieces 0 .. first - 1 are done. Threads start once
 * for both, and keep what their processor has cached. `threads` <= first, or as many as first are used. */
void pool_run_stages(int threads, int first, int count, pool_job job, void *user);

#endif
