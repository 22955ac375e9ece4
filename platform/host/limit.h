/* limit.h: limits the time that the program may take. */
#ifndef LIMIT_H
#define LIMIT_H

/* limit_time: after `seconds` a separate thread calls `over` and ends the program with status 1, whatever other threads
 * do. Returns 1, or 0 if the system starts no thread. A second call changes nothing. */
int limit_time(double seconds, void (*over)(void));

/* limit_hold: while it is held, the limit does not end the program. Hold it briefly, for work that must not be
 * interrupted, such as creating, writing and renaming a file. Do not nest holds. */
void limit_hold(int is_held);

/* limit_end: the program has finished; from now on the limit no longer ends it. */
void limit_end(void);

#endif
