/* verb_merge.c: `lambent merge`: checks the slices of a job and joins them to the bytes of one machine. */
#include "verb_merge.h"

#include <string.h>

#include "../common/io_file.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/slice.h"
#include "../bake/bake_slice.h"
#include "../bench/bench_slice.h"
#include "../play/play_slice.h"
#include "../render/render_slice.h"

enum { FILES = 2 * SLICE_MOST };

typedef struct options {
    const char *slice[FILES], *out;
    int32_t slices;
    int is_quiet, is_verbose;
} options;

#define AT(member) .at = offsetof(options, member)

static const option_row rows[] = {
    {.name = "SLICE", .value = "", .kind = OPTION_TEXT, AT(slice), .counts = offsetof(options, slices), .times = FILES,
     .size = sizeof(const char *),
     .help = "files written with `--slice I/N`, OUT.IofN: all N of one job, in any order; duplicates are allowed"},
    {.name = "-o", .value = "OUT", .kind = OPTION_TEXT, AT(out),
     .help = "output of the job, with the ending that the slices were made for; for frames the pattern, "
             "frame_%04d.png; for a sweep a .csv, .json, .html or .svg"},
    OPTION_LOUDNESS(options, is_quiet, is_verbose, "print the job of the slices"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "merge",
    .usage = "merge SLICE... -o OUT",
    .about = "Joins the files that `lambent render`, `play`, `bake` and `bench SCENE` wrote with --slice I/N, on "
             "any number of machines: the output has the same bytes as from one machine, except for the times of a "
             "sweep.\nA slice file has a hash of the job's inputs, options and version, and a checksum. Truncated "
             "or damaged slices are reported and skipped. If slices are missing, they are listed and nothing is "
             "written. A slice of another job is an error, and so are two different ones of the same number, except "
             "in a sweep, where the first one counts.",
    .part = {rows},
    .examples = "  lambent render demo --size 64x48 --slice 1/2 -o joined.png\n"
                "  lambent render demo --size 64x48 --slice 2/2 -o joined.png\n"
                "  lambent merge joined.png.*of2 -o joined.png\n",
};

static int is_complete(const options *o, report *r)
{
    if (o->slices == 0) {
        return report_fail(r, "no slices given; try: lambent merge OUT.*of4 -o OUT");
    }
    return o->out != NULL || report_fail(r, "no output given; add -o OUT");
}

/* Inputs must not be overwritten. */
static int keep_all(const options *o, report *r)
{
    for (int32_t i = 0; i < o->slices; ++i) {
        if (!file_keep(o->slice[i], r)) {
            return 0;
        }
    }
    return 1;
}

static int join(const options *o, report *r)
{
    static slice_set set; /* large */
    if (!keep_all(o, r) || !slice_gather(&set, o->slice, o->slices, o->is_quiet, r)) {
        return 0;
    }
    report_note(!o->is_verbose, "%s: %d slices", set.about, (int)set.count);
    switch (set.kind) {
    case SLICE_RENDER: return file_can_write(o->out, r) && render_slice_merge(o->out, &set, o->is_quiet, r);
    case SLICE_PLAY: return play_slice_merge(o->out, &set, r);
    case SLICE_BENCH: return file_can_write(o->out, r) && bench_slice_merge(o->out, &set, o->is_quiet, r);
    case SLICE_BAKE: return file_can_write(o->out, r) && bake_slice_merge(o->out, &set, r);
    default: return report_fail(r, "%s: slices of what this version does not know", set.first);
    }
}

int verb_merge(int argc, char **argv)
{
    report r = {""};
    static options o; /* large */
    memset(&o, 0, sizeof o);
    int asked = options_parse(&o, &table, argc, argv, &r);
    asked = asked == OPTIONS_RUN && !is_complete(&o, &r) ? OPTIONS_BAD : asked;
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &table, &r);
    }
    progress_begin(o.is_quiet, "merge");
    const int ok = join(&o, &r);
    progress_end();
    return ok ? 0 : report_end(&r, "merge", 1);
}
