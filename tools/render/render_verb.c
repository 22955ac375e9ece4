/* render_verb.c: the common frame of `lambent render` and `lambent plan`. */
#include "render_verb.h"

#include <string.h>

#include "../common/progress.h"

int render_verb(const option_table *t, int argc, char **argv, int (*run)(render_job *j, report *r))
{
    report r = {""};
    static render_job j; /* too large for a small stack: the options hold 64 lights */
    memset(&j, 0, sizeof j);
    const int asked = render_options_parse(&j.o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, t, &r);
    }
    progress_begin(j.o.view.is_quiet, t->verb);
    const int ok = render_options_job(&j.o, t, argc, argv, &r) && run(&j, &r);
    progress_end();
    render_job_free(&j);
    return ok ? 0 : report_end(&r, t->verb, 1);
}
