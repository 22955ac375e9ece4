/* bench_merge.h: `lambent-bench merge`. */
#ifndef BENCH_MERGE_H
#define BENCH_MERGE_H

int bench_merge(int argc, char **argv);

#endif
