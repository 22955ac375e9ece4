/* render_verb.h: the common frame of `lambent render` and `lambent plan`. */
#ifndef RENDER_VERB_H
#define RENDER_VERB_H

#include "render_job.h"

/* render_verb: parses the command line with the verb's table, calls `run` with a job in which only the options are
 * set, and frees the job. Returns the exit status: 0 done, 1 failed, 2 bad usage. */
int render_verb(const option_table *t, int argc, char **argv, int (*run)(render_job *j, report *r));

#endif
