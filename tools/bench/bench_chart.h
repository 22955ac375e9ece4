/* bench_chart.h: the front of speed against error as SVG, logarithmic both ways, with its knee. */
#ifndef BENCH_CHART_H
#define BENCH_CHART_H

#include "../common/text_buffer.h"
#include "bench_results.h"

/* A size in pixels. `styled`: with colours of its own, as a file wants; else the classes are the page's. */
void bench_chart(text_buffer *out, const bench_results *b, int width, int height, int styled);

/* bench_label: a setting's name without dashes. */
void bench_label(char out[BENCH_NAME], const char *name);

#endif
