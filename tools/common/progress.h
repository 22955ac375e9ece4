/* progress.h: one line on a terminal that says how far the work is, once it has taken a second. */
#ifndef PROGRESS_H
#define PROGRESS_H

/* progress_begin: where stderr is a terminal and it is not to be quiet, what follows is told. */
void progress_begin(int is_quiet, const char *verb);

/* progress_begin_log: the same, but if stderr is no terminal, it prints a line every ten seconds. For work that takes
 * minutes. */
void progress_begin_log(int is_quiet, const char *verb);

/* progress_is_quiet: was it to be quiet? For those who know no options. */
int progress_is_quiet(void);

/* progress_tell: `step` is done by `share`, 0 .. 1; from the thread that began, as often as is handy. The line has the
 * step, its per cent and the seconds that it still takes at the rate so far. */
void progress_tell(const char *step, double share);

/* progress_whole: the same of the whole work, whatever part of it is named; what its parts tell is left out. */
void progress_whole(const char *part, double share);

/* progress_end: the line is empty again, and nothing more is told. progress_wipe: the same in a signal handler. */
void progress_end(void);
void progress_wipe(void);

#endif
