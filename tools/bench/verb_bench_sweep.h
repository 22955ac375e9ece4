/* verb_bench_sweep.h: `lambent-bench SCENE`, `relight`, `relief`, `mix`. */
#ifndef VERB_BENCH_SWEEP_H
#define VERB_BENCH_SWEEP_H

/* argv[0] is "bench", argv[1] the subject. Returns the exit status: 0 done, 1 failed, 2 bad usage. */
int verb_bench_sweep(int argc, char **argv);

#endif
