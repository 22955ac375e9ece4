/* bench_calibrate.h: measures the units of work per second of this machine. */
#ifndef BENCH_CALIBRATE_H
#define BENCH_CALIBRATE_H

/* bench_calibrate: returns the units per second of `threads` threads: draws the built-in room a few times and takes
 * the fastest. Takes about half a second. Returns 0 if memory is short. */
double bench_calibrate(int threads);

#endif
