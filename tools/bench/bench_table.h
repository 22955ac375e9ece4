/* bench_table.h: a report as text: for a terminal, as CSV, as JSON. */
#ifndef BENCH_TABLE_H
#define BENCH_TABLE_H

#include "../common/text_buffer.h"
#include "bench_results.h"

void bench_table(text_buffer *out, const bench_results *b); /* to read */
void bench_csv(text_buffer *out, const bench_results *b);   /* one line per setting */
void bench_json(text_buffer *out, const bench_results *b);  /* one object */

#endif
