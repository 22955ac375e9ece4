/* bench_table.c: a report as text: for a terminal, as CSV, as JSON. */
#include "bench_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *mark(const bench_point *p) { return p->is_knee ? "knee" : p->on_front ? "front" : ""; }

/* --- text --------------------------------------------------------------------------------------------------------- */

static void say_point(text_buffer *out, const bench_results *b, const bench_point *p)
{
    char time[24], bytes[24], figure[24] = "-";
    if (p->failure[0] != '\0') {
        text_buffer_add(out, "       %-44s left out: %s\n", p->name, p->failure);
        return;
    }
    bench_say_time(time, p->time_s);
    bench_say_bytes(bytes, p->bytes);
    if (p->has_figures) {
        bench_say_figure(figure, b, 0, p->figure[0]);
    }
    text_buffer_add(out, "%-6s %-44s %10s %9s", mark(p), p->name, time, figure);
    for (int i = 1; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        bench_say_figure(figure, b, i, p->figure[i]);
        text_buffer_add(out, " %7s", p->has_figures ? figure : "-");
    }
    text_buffer_add(out, " %10s%s\n", bytes, p->same == 1 ? "  same bytes" : p->same == 0 ? "  OTHER BYTES" : "");
}

static void say_breakdown(text_buffer *out, const bench_breakdown *l)
{
    text_buffer_add(out, "\nerror breakdown of %s: squares, in %% of the whole (%.3g of mean light squared)\n", l->name,
                    l->total);
    for (int i = 0; i < l->rows; ++i) {
        text_buffer_add(out, "  %-30s %8.1f %%\n", l->row[i].stage, 100.0 * l->row[i].square / l->total);
    }
    text_buffer_add(out, "  %-30s %8.1f %%\n", "interaction of stages", 100.0 * (l->total - l->sum) / l->total);
}

void bench_table(text_buffer *out, const bench_results *b)
{
    text_buffer_add(out, "%s\nagainst %s\n%s; %s\n\n%-6s %-44s %10s", b->title, b->truth, b->computer, b->how, "",
                    "setting", "time");
    for (int i = 0; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        text_buffer_add(out, i == 0 ? " %9s" : " %7s", b->figure[i]);
    }
    text_buffer_add(out, " %10s\n", "memory");
    for (int i = 0; i < b->count; ++i) {
        say_point(out, b, &b->point[i]);
    }
    for (int i = 0; i < b->breakdowns; ++i) {
        say_breakdown(out, &b->breakdown[i]);
    }
}

/* --- CSV ---------------------------------------------------------------------------------------------------------- */

static void csv_head(text_buffer *out, const bench_results *b)
{
    text_buffer_plain(out, "setting,option,mark,seconds");
    for (int i = 0; i < BENCH_STAGES && b->stage[i] != NULL; ++i) {
        text_buffer_plain(out, ",s ");
        text_buffer_plain(out, b->stage[i]);
    }
    for (int i = 0; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        text_buffer_add(out, ",%s", b->figure[i]);
    }
    text_buffer_plain(out, ",bytes,work,instructions,threads,same bytes,command,left out because\n");
}

/* Empty if not measured. */
static void csv_number(text_buffer *out, int is_there, double v)
{
    text_buffer_plain(out, ",");
    if (is_there && !isnan(v)) {
        text_buffer_add(out, "%.10g", v);
    }
}

static void csv_point(text_buffer *out, const bench_results *b, const bench_point *p)
{
    const int is_there = p->failure[0] == '\0';
    text_buffer_csv(out, p->name);
    text_buffer_plain(out, ",");
    text_buffer_csv(out, p->option);
    text_buffer_add(out, ",%s", mark(p));
    csv_number(out, is_there, p->time_s);
    for (int i = 0; i < BENCH_STAGES && b->stage[i] != NULL; ++i) {
        csv_number(out, is_there, p->stage_s[i]);
    }
    for (int i = 0; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        csv_number(out, p->has_figures, p->figure[i]);
    }
    csv_number(out, is_there, p->bytes);
    csv_number(out, is_there, p->work);
    csv_number(out, p->instructions > 0.0, p->instructions);
    text_buffer_add(out, ",%d,%s,", p->threads, p->same == 1 ? "yes" : p->same == 0 ? "no" : "");
    text_buffer_csv(out, p->command);
    text_buffer_plain(out, ",");
    text_buffer_csv(out, p->failure);
    text_buffer_plain(out, "\n");
}

void bench_csv(text_buffer *out, const bench_results *b)
{
    csv_head(out, b);
    for (int i = 0; i < b->count; ++i) {
        csv_point(out, b, &b->point[i]);
    }
}

/* --- JSON --------------------------------------------------------------------------------------------------------- */

static void json_text(text_buffer *out, const char *key, const char *text)
{
    text_buffer_json(out, key);
    text_buffer_plain(out, ": ");
    text_buffer_json(out, text);
    text_buffer_plain(out, ", ");
}

/* null if not measured. */
static void json_number(text_buffer *out, int is_there, double v)
{
    if (is_there && !isnan(v)) {
        text_buffer_add(out, "%.10g", v);
    } else {
        text_buffer_plain(out, "null");
    }
}

static void json_figures(text_buffer *out, const bench_results *b, const bench_point *p)
{
    for (int i = 0; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        text_buffer_plain(out, i > 0 ? ", " : "");
        text_buffer_json(out, b->figure[i]);
        text_buffer_plain(out, ": ");
        json_number(out, p->has_figures, p->figure[i]);
    }
}

static void json_stages(text_buffer *out, const bench_results *b, const bench_point *p)
{
    for (int i = 0; i < BENCH_STAGES && b->stage[i] != NULL; ++i) {
        text_buffer_plain(out, i > 0 ? ", " : "");
        text_buffer_json(out, b->stage[i]);
        text_buffer_add(out, ": %.6g", p->stage_s[i]);
    }
}

static void json_point(text_buffer *out, const bench_results *b, const bench_point *p)
{
    text_buffer_plain(out, "    {");
    json_text(out, "setting", p->name);
    json_text(out, "option", p->option);
    json_text(out, "command", p->command);
    if (p->failure[0] != '\0') {
        json_text(out, "left_out", p->failure);
    }
    text_buffer_add(out, "\"front\": %s, \"knee\": %s, \"seconds\": %.6g, \"stages\": {",
                    p->on_front ? "true" : "false", p->is_knee ? "true" : "false", p->time_s);
    json_stages(out, b, p);
    text_buffer_plain(out, "}, \"error\": {");
    json_figures(out, b, p);
    text_buffer_add(out, "}, \"bytes\": %.0f, \"work\": %.0f, \"threads\": %d, \"same_bytes\": %s, \"instructions\": ",
                    p->bytes, p->work, p->threads,
                    p->same < 0 ? "null"
                    : p->same   ? "true"
                                : "false");
    json_number(out, p->instructions > 0.0, p->instructions);
    text_buffer_plain(out, "}");
}

static void json_breakdown(text_buffer *out, const bench_breakdown *l)
{
    text_buffer_plain(out, "    {");
    json_text(out, "setting", l->name);
    text_buffer_add(out, "\"total\": %.6g, \"sum\": %.6g, \"interaction\": %.6g, \"steps\": [", l->total, l->sum,
                    l->total - l->sum);
    for (int i = 0; i < l->rows; ++i) {
        text_buffer_plain(out, i > 0 ? ", {" : "{");
        json_text(out, "stage", l->row[i].stage);
        json_text(out, "to", l->row[i].to);
        text_buffer_add(out, "\"square\": %.6g}", l->row[i].square);
    }
    text_buffer_plain(out, "]}");
}

void bench_json(text_buffer *out, const bench_results *b)
{
    text_buffer_plain(out, "{\n  ");
    json_text(out, "title", b->title);
    json_text(out, "truth", b->truth);
    json_text(out, "machine", b->computer);
    json_text(out, "timed", b->how);
    text_buffer_add(out, "\"seconds\": %.3f,\n  \"settings\": [\n", b->seconds);
    for (int i = 0; i < b->count; ++i) {
        json_point(out, b, &b->point[i]);
        text_buffer_plain(out, i + 1 < b->count ? ",\n" : "\n");
    }
    text_buffer_plain(out, "  ],\n  \"breakdowns\": [\n");
    for (int i = 0; i < b->breakdowns; ++i) {
        json_breakdown(out, &b->breakdown[i]);
        text_buffer_plain(out, i + 1 < b->breakdowns ? ",\n" : "\n");
    }
    text_buffer_add(out, "  ],\n  \"breakdown_share\": %.6g\n}\n", b->breakdown_share);
}
