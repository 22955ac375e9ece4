/* bench_html.c: a report as one self-contained page, without scripts or other files. */
#include "bench_html.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../picture/image.h"
#include "bench_chart.h"
#include "bench_front.h"
#include "bench_style.h"

static void put_label(text_buffer *out, const bench_point *p)
{
    char label[BENCH_NAME];
    bench_label(label, p->name);
    text_buffer_html(out, label);
}

/* All pictures were drawn, so a missing one means that memory was short. The report is then not written. */
static void put_picture(text_buffer *out, const bench_picture *p, const char *what)
{
    file_bytes png = {NULL, 0};
    report unheard = {""};
    if (p->rgb == NULL || !png_encode(&png, p->rgb, p->width, p->height, &unheard)) {
        out->is_short = 1;
        return;
    }
    text_buffer_add(out, "<img alt=\"%s\" width=\"%d\" height=\"%d\" src=\"data:image/png;base64,", what, (int)p->width,
                    (int)p->height);
    text_buffer_base64(out, png.data, png.size);
    text_buffer_plain(out, "\">");
    file_free(&png);
}

/* --- results ------------------------------------------------------------------------------------------------------ */

static void put_fact(text_buffer *out, const bench_results *b, const bench_point *p, const char *what, const char *why)
{
    char time[24], error[24], bytes[24];
    bench_say_time(time, p->time_s);
    bench_say_figure(error, b, 0, p->figure[0]);
    bench_say_bytes(bytes, p->bytes);
    text_buffer_add(out, "<div class=\"fact%s\"><h3>%s</h3><b>", p->is_knee ? " at-knee" : "", what);
    put_label(out, p);
    text_buffer_add(
        out,
        "</b><p><span class=\"big\">%s</span> for an error of <span class=\"big\">%s</span>, %s of memory</p>"
        "<p class=\"why\">%s</p></div>",
        time, error, bytes, why);
}

static void put_summary(text_buffer *out, const bench_results *b, const int *order, int n)
{
    text_buffer_plain(out, "<div class=\"facts\">");
    for (int i = 0; i < n; ++i) {
        const bench_point *p = &b->point[order[i]];
        if (i == 0) {
            put_fact(out, b, p, "Fastest", "No other setting takes less time.");
        } else if (p->is_knee) {
            put_fact(out, b, p, "Knee", "From here on each further step of error costs the most time.");
        } else if (i == n - 1) {
            put_fact(out, b, p, "Nearest to the truth", "No other setting has a smaller error.");
        }
    }
    text_buffer_plain(out, "</div>\n");
}

static void put_head(text_buffer *out, const bench_results *b)
{
    text_buffer_plain(
        out, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
             "<meta name=\"viewport\" content=\"width=device-width\"><title>speed against error</title>\n<style>");
    for (int i = 0; i < BENCH_STYLE_PARTS; ++i) {
        text_buffer_plain(out, bench_style[i]);
    }
    text_buffer_plain(out, "</style></head><body>\n<h1>Speed against error</h1>\n<p><code>");
    text_buffer_html(out, b->title);
    text_buffer_plain(out,
                      "</code></p>\n<p>How long a picture takes by each setting, and how far it is from the truth: ");
    text_buffer_html(out, b->truth);
    text_buffer_add(out, ". Error is <b>%s</b>: %s.</p>\n", b->figure[0], b->figure_is[0]);
}

static void put_front(text_buffer *out, const bench_results *b)
{
    text_buffer_plain(
        out, "<h2>The front</h2>\n<p>Each dot is a setting. No setting is both faster and nearer to the truth "
             "than one on the <span class=\"swatch\"></span> line; grey dots are beaten by one that is. At the "
             "<span class=\"ring\"></span> knee more time stops to pay. Both axes are logarithmic.</p>\n"
             "<div class=\"chart\">");
    bench_chart(out, b, 940, 470, 0);
    text_buffer_plain(out, "</div>\n");
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static void put_scale(text_buffer *out)
{
    text_buffer_plain(out,
                      "<p>Beside each picture, how wrong each pixel is, relative to the truth: <span class=\"scale\">"
                      "</span> from 0 (black) by 5, 10 and 15 % to 20 % and more (white).</p>\n");
}

static void put_card(text_buffer *out, const bench_results *b, const bench_point *p)
{
    char time[24], error[24], bytes[24];
    bench_say_time(time, p->time_s);
    bench_say_figure(error, b, 0, p->figure[0]);
    bench_say_bytes(bytes, p->bytes);
    text_buffer_add(out, "<figure%s><div class=\"pair\">", p->is_knee ? " class=\"at-knee\"" : "");
    put_picture(out, &p->picture, "picture");
    put_picture(out, &p->heat, "error by pixel");
    text_buffer_add(out, "</div><figcaption>%s<b>", p->is_knee ? "knee: " : "");
    put_label(out, p);
    text_buffer_add(out, "</b><br>%s, error %s, %s</figcaption></figure>\n", time, error, bytes);
}

static void put_cards(text_buffer *out, const bench_results *b, const int *order, int n)
{
    text_buffer_plain(out, "<h2>Pictures on the front, from the fastest</h2>\n");
    put_scale(out);
    text_buffer_plain(out, "<div class=\"cards\"><figure><div class=\"pair\">");
    put_picture(out, &b->truth_picture, "truth");
    text_buffer_plain(out, "</div><figcaption><b>the truth</b></figcaption></figure>\n");
    for (int i = 0; i < n; ++i) {
        put_card(out, b, &b->point[order[i]]);
    }
    text_buffer_plain(out, "</div>\n");
}

/* --- stages ------------------------------------------------------------------------------------------------------- */

static void put_stage_names(text_buffer *out, const bench_results *b)
{
    text_buffer_plain(out, "<p class=\"keys\">");
    for (int i = 0; i < BENCH_STAGES && b->stage[i] != NULL; ++i) {
        text_buffer_add(out, "<span><i class=\"s%d\"></i>%s</span>", i, b->stage[i]);
    }
    text_buffer_plain(out, "</p>\n");
}

static void put_stage_bar(text_buffer *out, const bench_results *b, const bench_point *p)
{
    char time[24];
    bench_say_time(time, p->time_s);
    text_buffer_plain(out, "<tr><th>");
    put_label(out, p);
    text_buffer_add(out, "</th><td class=\"n\">%s</td><td class=\"bar\"><div>", time);
    for (int i = 0; i < BENCH_STAGES && b->stage[i] != NULL; ++i) {
        if (p->stage_s[i] > 0.001 * p->time_s) {
            bench_say_time(time, p->stage_s[i]);
            text_buffer_add(out, "<i class=\"s%d\" style=\"width:%.2f%%\" title=\"%s: %s\"></i>", i,
                            100.0 * p->stage_s[i] / p->time_s, b->stage[i], time);
        }
    }
    text_buffer_plain(out, "</div></td></tr>\n");
}

static void put_stages(text_buffer *out, const bench_results *b, const int *order, int n)
{
    text_buffer_plain(
        out, "<h2>Where the time goes</h2>\n<p>Each stage's share of a setting's time, for those on the front.</p>\n");
    put_stage_names(out, b);
    text_buffer_plain(out, "<table class=\"stages\">\n");
    for (int i = 0; i < n; ++i) {
        put_stage_bar(out, b, &b->point[order[i]]);
    }
    text_buffer_plain(out, "</table>\n");
}

/* --- the error breakdown ------------------------------------------------------------------------------------------ */

/* The row of this stage, or NULL if it was already exact. */
static const bench_row *row_of(const bench_breakdown *l, const char *stage)
{
    for (int i = 0; i < l->rows; ++i) {
        if (strcmp(l->row[i].stage, stage) == 0) {
            return &l->row[i];
        }
    }
    return NULL;
}

static void put_share(text_buffer *out, double share)
{
    text_buffer_add(out, "<td class=\"n\"><div class=\"share\"><i style=\"width:%.1f%%\"></i></div>%.1f %%</td>",
                    fmin(100.0 * fabs(share), 100.0), 100.0 * share);
}

static void put_breakdown_row(text_buffer *out, const bench_results *b, const char *stage)
{
    text_buffer_add(out, "<tr><th>%s</th>", stage);
    for (int i = 0; i < b->breakdowns; ++i) {
        const bench_row *row = row_of(&b->breakdown[i], stage);
        if (row != NULL) {
            put_share(out, row->square / b->breakdown[i].total);
        } else {
            text_buffer_plain(out, "<td class=\"n\">exact</td>");
        }
    }
    text_buffer_plain(out, "</tr>\n");
}

/* Writes the stages in the order of the longest chain, then those missing from it. */
static void put_breakdown_rows(text_buffer *out, const bench_results *b)
{
    const bench_breakdown *longest = &b->breakdown[0];
    for (int k = 1; k < b->breakdowns; ++k) {
        longest = b->breakdown[k].rows > longest->rows ? &b->breakdown[k] : longest;
    }
    for (int i = 0; i < longest->rows; ++i) {
        put_breakdown_row(out, b, longest->row[i].stage);
    }
    for (int k = 0; k < b->breakdowns; ++k) {
        for (int i = 0; i < b->breakdown[k].rows; ++i) {
            const char *stage = b->breakdown[k].row[i].stage;
            int known = row_of(longest, stage) != NULL;
            for (int e = 0; e < k; ++e) {
                known |= row_of(&b->breakdown[e], stage) != NULL;
            }
            if (!known) {
                put_breakdown_row(out, b, stage);
            }
        }
    }
}

static void put_breakdown(text_buffer *out, const bench_results *b)
{
    if (b->breakdowns == 0) {
        return;
    }
    text_buffer_add(
        out,
        "<h2>Where the error comes from</h2>\n<p>One stage after another is made exact, from the top down, until "
        "the truth is reached. A row is the squared error that its step takes away, as a share of the whole; the rows "
        "and the interaction (what stages' errors hide, below 0, or add to each other's) make 100 %%. Over %s "
        "of the picture.</p>\n<table class=\"breakdown\"><tr><th></th>",
        b->breakdown_share < 1.0 ? "a sample" : "all");
    for (int i = 0; i < b->breakdowns; ++i) {
        char label[BENCH_NAME];
        bench_label(label, b->breakdown[i].name);
        text_buffer_plain(out, "<th>");
        text_buffer_html(out, label);
        text_buffer_plain(out, "</th>");
    }
    text_buffer_plain(out, "</tr>\n");
    put_breakdown_rows(out, b);
    text_buffer_plain(out, "<tr class=\"sum\"><th>interaction</th>");
    for (int i = 0; i < b->breakdowns; ++i) {
        put_share(out, (b->breakdown[i].total - b->breakdown[i].sum) / b->breakdown[i].total);
    }
    text_buffer_plain(out, "</tr><tr class=\"sum\"><th>error of the sample</th>");
    for (int i = 0; i < b->breakdowns; ++i) {
        char error[24];
        bench_say_figure(error, b, 0, sqrt(b->breakdown[i].total));
        text_buffer_add(out, "<td class=\"n\">%s</td>", error);
    }
    text_buffer_plain(out, "</tr></table>\n");
}

/* --- all settings ------------------------------------------------------------------------------------------------- */

/* The setting that this one extends: the longest name that is a prefix of it, or the first setting. */
static const bench_point *base_of(const bench_results *b, const bench_point *p)
{
    const bench_point *base = &b->point[0];
    size_t max = 0;
    for (int i = 0; i < b->count; ++i) {
        const size_t n = strlen(b->point[i].name);
        if (n > max && strncmp(b->point[i].name, p->name, n) == 0 && p->name[n] == ' ') {
            base = &b->point[i];
            max = n;
        }
    }
    return base;
}

/* Writes v / of, with a bar to the left of the middle if it is below 1; a doubling is a quarter of the cell. */
static void put_factor(text_buffer *out, double v, double of)
{
    const double f = v > 0.0 && of > 0.0 ? v / of : 1.0, part = fmin(fabs(log2(f)) * 12.5, 50.0);
    text_buffer_add(out,
                    "<td class=\"factor\"><div><i class=\"%s\" style=\"width:%.1f%%;%s:50%%\"></i></div></td>"
                    "<td class=\"n\">&times;%.*f</td>",
                    f < 1.0 ? "less" : "more", part, f < 1.0 ? "right" : "left", f < 9.95 ? 2 : 0, f);
}

static void put_measured(text_buffer *out, const bench_results *b, const bench_point *p)
{
    char text[24];
    const bench_point *base = base_of(b, p);
    bench_say_time(text, p->time_s);
    text_buffer_add(out, "<td class=\"n\">%s</td>", text);
    put_factor(out, p->time_s, base->time_s);
    if (p->has_figures) {
        bench_say_figure(text, b, 0, p->figure[0]);
        text_buffer_add(out, "<td class=\"n\">%s</td>", text);
        put_factor(out, p->figure[0], base->figure[0]);
    } else {
        text_buffer_add(out, "<td class=\"n\" colspan=\"3\">%s</td>",
                        p->same == 1   ? "the same bytes"
                        : p->same == 0 ? "OTHER BYTES"
                                       : "another picture");
    }
    for (int i = 1; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        bench_say_figure(text, b, i, p->figure[i]);
        text_buffer_add(out, "<td class=\"n\">%s</td>", p->has_figures ? text : "");
    }
    bench_say_bytes(text, p->bytes);
    text_buffer_add(out, "<td class=\"n\">%s</td>", text);
}

static void put_setting(text_buffer *out, const bench_results *b, const bench_point *p, int columns)
{
    text_buffer_add(out, "<tr%s><th>", p->is_knee ? " class=\"at-knee\"" : p->on_front ? " class=\"at-front\"" : "");
    put_label(out, p);
    text_buffer_plain(out, "</th>");
    if (p->failure[0] != '\0') {
        text_buffer_add(out, "<td colspan=\"%d\">left out: ", columns - 1);
        text_buffer_html(out, p->failure);
        text_buffer_plain(out, "</td>");
    } else {
        put_measured(out, b, p);
    }
    text_buffer_plain(out, "</tr>\n");
}

static void put_settings(text_buffer *out, const bench_results *b)
{
    int columns = 8;
    text_buffer_plain(
        out,
        "<h2>What each option costs and what it buys</h2>\n<p>One option at a time; factors are against the "
        "setting that it is added to (the first line, or the preset that its name begins with). "
        "<span class=\"less\"></span> less, <span class=\"more\"></span> more, a quarter of the bar for each "
        "doubling. Settings on the front are bold.</p>\n<div class=\"wide\"><table class=\"settings\"><tr><th>setting"
        "</th><th class=\"n\">time</th><th colspan=\"2\"></th>");
    for (int i = 0; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        text_buffer_add(out, "<th class=\"n\" title=\"%s\">%s</th>%s", b->figure_is[i], b->figure[i],
                        i == 0 ? "<th colspan=\"2\"></th>" : "");
        columns += i > 0;
    }
    text_buffer_plain(out, "<th class=\"n\">memory</th></tr>\n");
    for (int i = 0; i < b->count; ++i) {
        const bench_point *p = &b->point[i];
        if (i == 0 || strcmp(p->option, b->point[i - 1].option) != 0) {
            text_buffer_add(out, "<tr class=\"option\"><th colspan=\"%d\">", columns);
            text_buffer_html(out, p->option);
            text_buffer_plain(out, "</th></tr>\n");
        }
        put_setting(out, b, p, columns);
    }
    text_buffer_plain(out, "</table></div>\n<dl class=\"figures\">");
    for (int i = 0; i < BENCH_FIGURES && b->figure[i] != NULL; ++i) {
        text_buffer_add(out, "<dt>%s</dt><dd>%s</dd>", b->figure[i], b->figure_is[i]);
    }
    text_buffer_plain(out, "</dl>\n");
}

/* --- commands to repeat it ---------------------------------------------------------------------------------------- */

static void put_commands(text_buffer *out, const bench_results *b)
{
    text_buffer_plain(out, "<h2>The same again</h2>\n<p>");
    text_buffer_html(out, b->computer);
    text_buffer_add(out, ". Timed: %s. Instructions: ", b->how);
    if (b->count > 0 && b->point[0].instructions > 0.0) {
        text_buffer_add(out, "%.4g for the first setting.</p>\n", b->point[0].instructions);
    } else {
        text_buffer_plain(out, "this system counts none for programs.</p>\n");
    }
    text_buffer_plain(out, "<pre>");
    for (int i = 0; i < b->count; ++i) {
        text_buffer_html(out, b->point[i].command);
        text_buffer_plain(out, "\n");
    }
    text_buffer_plain(out, "</pre></body></html>\n");
}

void bench_html(text_buffer *out, const bench_results *b)
{
    int order[BENCH_POINTS];
    const int n = bench_front_order(order, b);
    put_head(out, b);
    put_summary(out, b, order, n);
    put_front(out, b);
    put_cards(out, b, order, n);
    put_breakdown(out, b);
    put_settings(out, b);
    put_stages(out, b, order, n);
    put_commands(out, b);
}
