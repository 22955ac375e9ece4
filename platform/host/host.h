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

/* The processor's name, as the system tells it; "" where it does not. */
void host_processor(char *out, int size);

/* host_make_folders: the folders of a path, up to its last separator, as far as they are not there. What fails shows
 * when a file is to be written there. */
void host_make_folders(const char *path);

/* From now on a file that grows beyond the user's limit is a failed write, no longer the program's end. */
void host_outlive_file_limit(void);

#endif
