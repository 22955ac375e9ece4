/* merge.h: the command line of `lambent merge` and `lambent-bench merge`. */
#ifndef MERGE_H
#define MERGE_H

#include "slice.h"

enum { MERGE_FILES = 2 * SLICE_MOST };

typedef struct merge_options {
    const char *slice[MERGE_FILES], *out;
    int32_t slices;
    int is_quiet, is_verbose;
} merge_options;

#define MERGE_ROWS(output)                                                                                       \
    {.name = "SLICE", .value = "", .kind = OPTION_TEXT, .at = offsetof(merge_options, slice),                    \
     .counts = offsetof(merge_options, slices), .times = MERGE_FILES, .size = sizeof(const char *),              \
     .help = "files written with `--slice I/N`, OUT.IofN: all N of one job, in any order; duplicates are allowed"}, \
    {.name = "-o", .value = "OUT", .kind = OPTION_TEXT, .at = offsetof(merge_options, out), .help = output},     \
    OPTION_ONLY_HERE,                                                                                            \
    OPTION_LOUDNESS(merge_options, is_quiet, is_verbose, "print the job of the slices"),                         \
    OPTION_ASK,                                                                                                  \
    {.kind = OPTION_END}

/* merge_slices: parses the command line, checks the slices and calls `join`, which writes the output and returns 1, or
 * 0 with `r` set. Returns the exit status. */
int merge_slices(const option_table *t, int (*join)(const char *out, const slice_set *set, int is_quiet, report *r),
                 int argc, char **argv);

#endif
