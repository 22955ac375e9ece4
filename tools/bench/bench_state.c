/* bench_state.c: the words of a setting, and how far a sweep is. */
#include "bench_state.h"

#include <stdio.h>

#include "../../platform/host/host.h"

int sweep_line(bench_line *l, const sweep *s, const char *words, report *r)
{
    return bench_options_line(l, s->o, s->truth.is_own ? NULL : &s->truth.picture, r) &&
           (bench_line_add(l, words) || report_fail(r, "too many options"));
}

void bench_progress(const sweep *s, const char *what)
{
    const double passed = host_seconds() - s->start, part = s->all > 0.0 ? s->done / s->all : 0.0;
    char left[32] = "";
    if (!host_watched() || s->o->is_quiet) {
        return;
    }
    if (what == NULL) {
        fprintf(stderr, "\r%79s\r", "");
        return;
    }
    if (part > 0.01 && passed > 1.0) {
        const double more = passed / part - passed;
        snprintf(left, sizeof left, "%.0f %s left", more < 100.0 ? more : more / 60.0, more < 100.0 ? "s" : "min");
    }
    fprintf(stderr, "\r%3.0f %%  %-13s %-55.55s", 100.0 * part, left, what);
}
