/* process.h: other processes that do the same job again and again, to compare threads with. */
#ifndef PROCESS_H
#define PROCESS_H

/* A copy of this program as it was at process_start, with memory of its own; it waits to be told. */
typedef struct process {
    int go, done; /* ends of pipes */
    int id;
} process;

typedef void (*process_job)(void *user);

/* process_start: 1, or 0 where the system has no copies of programs or refuses one. `job` has run once when it
 * returns, so that the copy's memory is its own. */
int process_start(process *out, process_job job, void *user);

/* process_go: let it do its job once; process_wait: until it has. 1, or 0 where it is no longer there. */
int process_go(const process *p);
int process_wait(const process *p);

/* process_end: it goes away. */
void process_end(const process *p);

#endif
