/* bench_outputs.c: a report -> a file. */
#include "bench_outputs.h"

#include <string.h>

#include "bench_chart.h"
#include "bench_html.h"
#include "bench_table.h"

void bench_svg(text_buffer *out, const bench_results *b) { bench_chart(out, b, 900, 420, 1); }

int bench_output_as(const char *path, bench_fill fill, const bench_results *b, report *r)
{
    text_buffer p;
    memset(&p, 0, sizeof p);
    fill(&p, b);
    const int ok = path == NULL || text_buffer_write(&p, path, r);
    text_buffer_free(&p);
    return ok;
}

int bench_output(const char *path, const bench_results *b, report *r)
{
    static const struct {
        const char *ending;
        bench_fill fill;
    } forms[] = {{".csv", bench_csv}, {".json", bench_json}, {".html", bench_html}, {".svg", bench_svg}};
    const char *ending = strrchr(path, '.');
    for (size_t i = 0; ending != NULL && i < sizeof forms / sizeof *forms; ++i) {
        if (strcmp(ending, forms[i].ending) == 0) {
            return bench_output_as(path, forms[i].fill, b, r);
        }
    }
    return report_fail(r, "-o %s: a sweep's slices make a .csv, .json, .html or .svg", path);
}
