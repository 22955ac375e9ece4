/* merge.c: the command line of `lambent merge` and `lambent-bench merge`: checks the slices of a job. */
#include "merge.h"

#include <string.h>

#include "command_name.h"
#include "io_file.h"
#include "progress.h"

static int is_complete(const merge_options *o, report *r)
{
    if (o->slices == 0) {
        return report_fail(r, "no slices given; try: %s OUT.*of4 -o OUT", command_name("merge"));
    }
    return o->out != NULL || report_fail(r, "no output given; add -o OUT");
}

/* Inputs must not be overwritten. */
static int keep_all(const merge_options *o, report *r)
{
    for (int32_t i = 0; i < o->slices; ++i) {
        if (!file_keep(o->slice[i], r)) {
            return 0;
        }
    }
    return 1;
}

int merge_slices(const option_table *t, int (*join)(const char *out, const slice_set *set, int is_quiet, report *r),
                 int argc, char **argv)
{
    static merge_options o; /* large */
    static slice_set set;
    report r = {""};
    memset(&o, 0, sizeof o);
    int asked = options_parse(&o, t, argc, argv, &r);
    asked = asked == OPTIONS_RUN && !is_complete(&o, &r) ? OPTIONS_BAD : asked;
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, t, &r);
    }
    progress_begin(o.is_quiet, "merge");
    report_print_notes(); /* why a slice is left out explains the error */
    int ok = keep_all(&o, &r) && slice_gather(&set, o.slice, o.slices, o.is_quiet, &r);
    if (ok) {
        report_note(!o.is_verbose, "%s: %d slices", set.about, (int)set.count);
        ok = join(o.out, &set, o.is_quiet, &r);
    }
    progress_end();
    return ok ? 0 : report_end(&r, "merge", 1);
}
