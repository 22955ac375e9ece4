/* bench_threads.h: `lambent bench threads`: what threads gain, beside processes that know nothing of each other. */
#ifndef BENCH_THREADS_H
#define BENCH_THREADS_H

/* argv[0] is "threads". Returns an exit status. */
int bench_threads(int argc, char **argv);

#endif
