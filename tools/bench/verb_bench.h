/* verb_bench.h: `lambent-bench`. */
#ifndef VERB_BENCH_H
#define VERB_BENCH_H

/* argv[0] is "bench". Returns the exit status. */
int verb_bench(int argc, char **argv);

#endif
