/* bench_table.h: a report as lines: for a terminal, as CSV, as JSON. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "../common/page.h"
#include "bench_report.h"

void bench_table(page *out, const bench_report *b); /* for people */
void bench_csv(page *out, const bench_report *b);   /* a line a setting */
void bench_json(page *out, const bench_report *b);  /* one object */

#endif
