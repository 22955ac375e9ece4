/* process.h: other processes that repeat the same job, for comparison with threads. */
#ifndef PROCESS_H
#define PROCESS_H

/* A copy of this program at process_start, with its own memory; it waits for process_go. */
typedef struct process {
    int go, done; /* ends of pipes */
    int id;
} process;

typedef void (*process_job)(void *user);

/* process_start: returns 1, or 0 if the system cannot copy programs or refuses to. The copy has run `job` once before
 * the call returns, so that its memory is its own. */
int process_start(process *out, process_job job, void *user);

/* process_go: starts the job once; process_wait: waits for the end. Return 1, or 0 if the copy no longer exists. */
int process_go(const process *p);
int process_wait(const process *p);

/* process_end: ends the copy. */
void process_end(const process *p);

#endif
