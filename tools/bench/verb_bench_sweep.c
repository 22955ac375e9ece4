/* verb_bench_sweep.c: `lambent-bench SCENE`: speed against error, as a table and as files. */
#include "verb_bench_sweep.h"

#include <stdio.h>
#include <string.h>

#include "../common/progress.h"
#include "bench_html.h"
#include "bench_outputs.h"
#include "bench_slice.h"
#include "bench_sweep.h"
#include "bench_task.h"
#include "bench_table.h"

static int tell(const bench_results *b, report *r)
{
    text_buffer p;
    memset(&p, 0, sizeof p);
    bench_table(&p, b);
    const int ok = !p.is_short && fputs(p.data, report_words()) >= 0;
    text_buffer_free(&p);
    return (ok || report_fail(r, "out of memory")) && report_flush(r);
}

static int write_all(const bench_options *o, const bench_results *b, report *r)
{
    return bench_output_as(o->html, bench_html, b, r) && bench_output_as(o->csv, bench_csv, b, r) &&
           bench_output_as(o->json, bench_json, b, r) && bench_output_as(o->svg, bench_svg, b, r) &&
           (o->is_quiet || tell(b, r));
}

static int sweep_and_write(const bench_options *o, report *r)
{
    char name[SLICE_NAME];
    bench_results b;
    memset(&b, 0, sizeof b);
    option_table own;
    bench_options_table(&own, o->subject);
    const int is_slice = o->slice.count > 0;
    const int ok = options_files(o, &own, r) &&
                   (!is_slice || (slice_name(name, o->out, o->slice, r) && file_can_write(name, r))) &&
                   bench_sweep(&b, o, r) && (is_slice ? bench_slice_write(o, &b, r) : write_all(o, &b, r));
    bench_results_free(&b);
    return ok;
}

/* Without objects, the light at a place is swept. */
static const bench_subject *relight_of(int argc, char **argv)
{
    int i = 2;
    while (i < argc && strncmp(argv[i], "--object", 8) != 0) {
        ++i;
    }
    return i < argc ? &bench_figures : &bench_relight;
}

static const bench_subject *subject_of(int argc, char **argv)
{
    return strcmp(argv[1], "relight") == 0  ? relight_of(argc, argv)
           : strcmp(argv[1], "relief") == 0 ? &bench_relief
           : strcmp(argv[1], "mix") == 0    ? &bench_mixed
                                            : &bench_render;
}

int verb_bench_sweep(int argc, char **argv)
{
    static bench_options o; /* too large for a small stack */
    report r = {""};
    const bench_subject *subject = subject_of(argc, argv);
    const int words = subject == &bench_render ? 1 : 2;
    option_table own;
    bench_options_table(&own, subject);
    int asked = bench_options_parse(&o, subject, argc - words, argv + words, &r);
    if (asked == OPTIONS_RUN && !bench_check(&o, &r)) {
        asked = OPTIONS_BAD;
    }
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &own, &r);
    }
    progress_begin(o.is_quiet, "");
    const int ok = sweep_and_write(&o, &r);
    progress_end();
    return ok ? 0 : report_end(&r, "", 1);
}
