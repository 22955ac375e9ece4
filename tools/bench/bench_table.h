/* bench_table.h: a report as lines: for a terminal, as CSV, as JSON. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "../common/text_buffer.h"
#include "bench_results.h"

void bench_table(text_buffer *out, const bench_results *b); /* for people */
void bench_csv(text_buffer *out, const bench_results *b);   /* a line a setting */
void bench_json(text_buffer *out, const bench_results *b);  /* one object */

#endif
