/* host.h: what the tool asks of a desktop's operating system beyond C99: a clock, whether someone is watching, to be
 * told of a full disk instead of being ended by it, and to clean up where a signal ends it. */
#ifndef HOST_H
#define HOST_H

/* Seconds since some start, steadily rising. */
double host_seconds(void);

/* Seconds of processor time that the whole program took. */
double host_cpu_seconds(void);

/* host_sleep: let others run for about so long, s. */
void host_sleep(double seconds);

/* Is stderr a terminal? */
int host_watched(void);

/* The processor's name, as the system tells it; "" where it does not. */
void host_processor(char *out, int size);

/* host_make_folders: the folders of a path, up to its last separator, as far as they are not there. What fails shows
 * when a file is to be written there. */
void host_make_folders(const char *path);

/* host_take_streams: standard streams that are closed get a file that can be neither read nor written, so that no file
 * takes their number and gets what is printed. */
void host_take_streams(void);

/* host_end_cleanly: INT, TERM and HUP, where they are not ignored, call `clean` first, which may do no more than a
 * signal handler may; then they end the program as they always do. host_hold_signals: they wait while it is held. */
void host_end_cleanly(void (*clean)(void));
void host_hold_signals(int is_held);

/* host_wipe_line: blanks over the line that stderr's terminal stands at; in a signal handler, too. */
void host_wipe_line(void);

/* From now on a file that grows beyond the user's limit is a failed write, no longer the program's end. */
void host_outlive_file_limit(void);

#endif
