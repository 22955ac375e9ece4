/* bench_merge.c: `lambent-bench merge`: joins the slices of a sweep. */
#include "bench_merge.h"

#include "../common/io_file.h"
#include "../common/merge.h"
#include "bench_slice.h"

static const option_row rows[] = {MERGE_ROWS("a .csv, .json, .html or .svg")};

static const option_table table = {
    .verb = "merge",
    .usage = "merge SLICE... -o OUT",
    .about = "Joins the files that `lambent-bench SCENE` wrote with --slice I/N, on any number of machines: the output "
             "has the same bytes as from one machine, except for the times.\nTruncated or damaged slices are reported "
             "and skipped. If slices are missing, they are listed and nothing is written. A slice of another job is an "
             "error; of two of the same number, the first one counts.",
    .part = {rows},
    .examples = "  lambent-bench demo --size 24x16 --runs 1 --sweep tree=16,32 --slice 1/2 -o swept\n"
                "  lambent-bench demo --size 24x16 --runs 1 --sweep tree=16,32 --slice 2/2 -o swept\n"
                "  lambent-bench merge swept.*of2 -o swept.csv\n",
};

static int join(const char *out, const slice_set *set, int is_quiet, report *r)
{
    if (set->kind != SLICE_BENCH) {
        return report_fail(r, "%s: no slice of a sweep; `lambent merge` joins it", set->first);
    }
    return file_can_write(out, r) && bench_slice_merge(out, set, is_quiet, r);
}

int bench_merge(int argc, char **argv) { return merge_slices(&table, join, argc, argv); }
