/* host.h: what the tool asks of a desktop's operating system beyond C99: a clock and whether someone is watching. */
#ifndef HOST_H
#define HOST_H

/* Seconds since some start, steadily rising. */
double host_seconds(void);

/* Is stderr a terminal? */
int host_watched(void);

#endif
