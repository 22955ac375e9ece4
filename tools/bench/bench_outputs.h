/* bench_outputs.h: a report as a file, in the format that the name's ending selects. */
#ifndef BENCH_OUTPUTS_H
#define BENCH_OUTPUTS_H

#include "../common/report.h"
#include "../common/text_buffer.h"
#include "bench_results.h"

typedef void (*bench_fill)(text_buffer *out, const bench_results *b);

/* bench_output_as: writes a report in one format; NULL: does nothing. bench_output: by the ending .csv, .json, .html or
 * .svg. They return 1, or 0 with `r` set. bench_svg: writes only the front. */
int bench_output_as(const char *path, bench_fill fill, const bench_results *b, report *r);
int bench_output(const char *path, const bench_results *b, report *r);
void bench_svg(text_buffer *out, const bench_results *b);

#endif
