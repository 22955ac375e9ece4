/* bench_calibrate.h: how many units of work this machine does in a second. */
#ifndef BENCH_CALIBRATE_H
#define BENCH_CALIBRATE_H

/* bench_calibrate: units a second with so many threads: the built-in room, drawn a few times; the fastest counts. Takes
 * about half a second; 0 where there is no memory for it. */
double bench_calibrate(int threads);

#endif
