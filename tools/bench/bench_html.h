/* bench_html.h: a report as one self-contained page. */
#ifndef BENCH_HTML_H
#define BENCH_HTML_H

#include "../common/text_buffer.h"
#include "bench_results.h"

void bench_html(text_buffer *out, const bench_results *b);

#endif
