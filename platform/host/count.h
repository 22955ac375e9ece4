/* count.h: counts the instructions of this program if the system can: on Linux, if it is allowed
 * (kernel.perf_event_paranoid under 3) and the processor, or its emulator, has counters. */
#ifndef COUNT_H
#define COUNT_H

/* count_start: returns 1, or 0 if counting is not possible. count_stop: returns instructions of all threads since then
 * in user mode; 0 if nothing was counted. */
int count_start(void);
double count_stop(void);

#endif
