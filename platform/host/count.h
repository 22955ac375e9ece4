/* count.h: instructions that this program takes, where the system counts them for programs: Linux, if it is allowed
 * (kernel.perf_event_paranoid under 3) and the processor, or what plays it, has counters. */
#ifndef COUNT_H
#define COUNT_H

/* count_start: 1, or 0 where nothing is counted. count_stop: instructions of all threads since then outside the
 * system; 0 where nothing was. */
int count_start(void);
double count_stop(void);

#endif
