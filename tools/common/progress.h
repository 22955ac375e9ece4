/* progress.h: a progress line on a terminal, shown after a second. */
#ifndef PROGRESS_H
#define PROGRESS_H

/* progress_begin: enables progress if stderr is a terminal and is_quiet is 0. */
void progress_begin(int is_quiet, const char *verb);

/* progress_begin_log: like progress_begin, but if stderr is no terminal, it prints a line every ten seconds. For
 * work that takes minutes. */
void progress_begin_log(int is_quiet, const char *verb);

/* progress_is_quiet: whether is_quiet was set, for code without access to the options. */
int progress_is_quiet(void);

/* progress_tell: reports that `share` of `step` is done, 0 .. 1. Call it from the thread that began, as often as you
 * like. The line has the step, the percentage and the remaining seconds at the rate so far. progress_again: shows the
 * line again if it is time to, for long parts of a step. */
void progress_tell(const char *step, double share);
void progress_again(void);

/* progress_whole: reports the share of the whole work, with `part` as the name; progress of parts is then ignored. */
void progress_whole(const char *part, double share);

/* progress_end: clears the line and disables progress. progress_wipe: for a signal handler. */
void progress_end(void);
void progress_wipe(void);

#endif
