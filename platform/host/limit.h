/* limit.h: a limit of the time that the program may take. */
#ifndef LIMIT_H
#define LIMIT_H

/* limit_time: after so many seconds a thread of its own calls `over`, and the program ends with status 1, whatever its
 * other threads do. Returns 1, or 0 where the system gives no thread. A second call changes nothing. */
int limit_time(double seconds, void (*over)(void));

/* limit_hold: while it is held the limit waits: for what is to be done whole. Short: a file that is made, written and
 * renamed. Not within another one. */
void limit_hold(int is_held);

/* limit_end: the program has done its work: it ends by itself from here on. */
void limit_end(void);

/* limit_tell: a line on stderr, past the buffers that other threads may hold. */
void limit_tell(const char *line);

#endif
