/* host.h: what the tool asks of a desktop's operating system beyond C99: a clock, whether someone is watching, and
 * to be told of a full disk instead of being ended by it. */
#ifndef HOST_H
#define HOST_H

/* Seconds since some start, steadily rising. */
double host_seconds(void);

/* Seconds of processor time that the whole program took. */
double host_cpu_seconds(void);

/* Is stderr a terminal? */
int host_watched(void);

/* From now on a file that grows beyond the user's limit is a failed write, no longer the program's end. */
void host_outlive_file_limit(void);

#endif
