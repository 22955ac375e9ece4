/* bench_html.h: a report as one page that needs nothing else. */
#ifndef BENCH_HTML_H
#define BENCH_HTML_H

#include "../common/page.h"
#include "bench_report.h"

void bench_html(page *out, const bench_report *b);

#endif
