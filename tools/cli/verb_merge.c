/* verb_merge.c: `lambent merge`: joins the slices of a job to the bytes of one machine. */
#include "verb_merge.h"

#include "../common/io_file.h"
#include "../common/merge.h"
#include "../bake/bake_slice.h"
#include "../play/play_slice.h"
#include "../render/render_slice.h"

static const option_row rows[] = {
    MERGE_ROWS("output of the job, with the ending that the slices were made for; for frames "
               "the pattern, frame_%04d.png")};

static const option_table table = {
    .verb = "merge",
    .usage = "merge SLICE... -o OUT",
    .about = "Joins the files that `lambent render`, `play` and `bake` wrote with --slice I/N, on any number of "
             "machines: the output has the same bytes as from one machine. `lambent-bench merge` joins sweeps.\nA "
             "slice file has a hash of the job's inputs, options and version, and a checksum. Truncated "
             "or damaged slices are reported and skipped. If slices are missing, they are listed and nothing is "
             "written. A slice of another job is an error, and so are two different ones of the same number.",
    .part = {rows},
    .examples = "  lambent render demo --size 64x48 --slice 1/2 -o joined.png\n"
                "  lambent render demo --size 64x48 --slice 2/2 -o joined.png\n"
                "  lambent merge joined.png.*of2 -o joined.png\n",
};

static int join(const char *out, const slice_set *set, int is_quiet, report *r)
{
    switch (set->kind) {
    case SLICE_RENDER: return file_can_write(out, r) && render_slice_merge(out, set, is_quiet, r);
    case SLICE_PLAY: return play_slice_merge(out, set, r);
    case SLICE_BAKE: return file_can_write(out, r) && bake_slice_merge(out, set, r);
    case SLICE_BENCH: return report_fail(r, "%s: a slice of a sweep; `lambent-bench merge` joins it", set->first);
    default: return report_fail(r, "%s: slices of what this version does not know", set->first);
    }
}

int verb_merge(int argc, char **argv) { return merge_slices(&table, join, argc, argv); }
