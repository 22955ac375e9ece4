/* bench_state.c: the options of a setting. */
#include "bench_state.h"

int sweep_line(bench_line *l, const sweep *s, const char *words, report *r)
{
    return bench_options_line(l, s->o, s->truth.is_own ? NULL : &s->truth.picture, r) &&
           (bench_line_add(l, words) || report_fail(r, "too many options"));
}
