/* host.h: services of a desktop's operating system that the tool needs beyond C99: a clock, terminal detection, an
 * error instead of a signal if a file grows too large, and clean-up when a signal ends the tool. */
#ifndef HOST_H
#define HOST_H

#include <stddef.h>

/* Seconds from some start, never decreasing. */
double host_seconds(void);

/* Seconds of processor time of the whole program. */
double host_cpu_seconds(void);

/* host_sleep: yields to other programs for about this time, s. */
void host_sleep(double seconds);

/* Returns whether stderr is a terminal. */
int host_watched(void);

/* The processor's name from the system, or "". */
void host_processor(char *out, int size);

/* host_make_folders: creates the missing folders of a path, up to the last separator. It reports no errors:
 * writing the file will fail. */
void host_make_folders(const char *path);

/* host_take_streams: opens closed standard streams on a file that can be neither read nor written, so that no other
 * file gets their numbers and receives printed text. */
void host_take_streams(void);

/* host_end_cleanly: INT, TERM and HUP, unless ignored, first call `clean`, which may only do what a signal handler may;
 * then they end the program as usual. host_hold_signals: delays these signals while held. */
void host_end_cleanly(void (*clean)(void));
void host_hold_signals(int is_held);

/* host_print_now: writes to stderr without buffers, which other threads may hold. On POSIX, writes nothing if it would have
 * to wait: for a full pipe, or a terminal that is stopped. Safe in a signal handler. */
void host_print_now(const char *text, size_t size);

/* host_wipe_line: overwrites the current line of stderr's terminal with blanks; safe in a signal handler. */
void host_wipe_line(void);

/* From now on, exceeding the user's limit on file sizes is a failed write and does not end the program. */
void host_outlive_file_limit(void);

#endif
