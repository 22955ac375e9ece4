/* bench_chart.h: the front of speed against error as SVG, log-log, with the knee marked. */
#ifndef BENCH_CHART_H
#define BENCH_CHART_H

#include "../common/text_buffer.h"
#include "bench_results.h"

/* Size in pixels. If `styled`, the SVG includes colours, as a file needs; otherwise it uses the page's classes. */
void bench_chart(text_buffer *out, const bench_results *b, int width, int height, int styled);

/* bench_label: a setting's name without dashes. */
void bench_label(char out[BENCH_NAME], const char *name);

#endif
