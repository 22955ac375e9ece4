/* bench_chart.c: the front of speed against error as SVG, log-log, with the knee marked. */
#include "bench_chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench_front.h"

enum { LEFT = 66, RIGHT = 18, TOP = 14, BOTTOM = 48, BOXES = 1024 };

#define LETTER 6.7 /* px, width of a label's character: monospaced, 11 px */

typedef struct box {
    double x, y, width, height;
} box;

typedef struct chart {
    text_buffer *out;
    const bench_results *b;
    double width, height;
    double low[2], high[2]; /* logarithms of time and error at the edges */
    box taken[BOXES]; /* areas closed to labels */
    int boxes;
} chart;

static const char style[] =
    "<style>text{font:11px ui-monospace,Menlo,Consolas,monospace;fill:#333;"
    "paint-order:stroke;stroke:#fff;stroke-width:3px}"
    ".paper{fill:#fff}.grid{stroke:#ddd}"
    ".axis{stroke:#888}.dot{fill:#999}.front{stroke:#0b6e99;stroke-width:2;fill:none}.on{fill:#0b6e99}"
    ".knee{stroke:#c2410c;stroke-width:2.5;fill:none}.lead{stroke:#999}.at-knee{font-weight:bold}</style>";

void bench_label(char out[BENCH_NAME], const char *name)
{
    size_t n = 0;
    for (const char *c = name; *c != '\0' && n + 2 < BENCH_NAME; ++c) {
        const int starts = strncmp(c, "--", 2) == 0;
        if (starts && n > 0) {
            out[n - 1] = ',';
            out[n++] = ' ';
        }
        c += starts ? 2 : 0;
        out[n++] = *c;
    }
    out[n] = '\0';
}

/* --- layout ------------------------------------------------------------------------------------------------------- */

static int is_shown(const bench_point *p) { return p->has_figures && p->failure[0] == '\0' && p->threads == 1; }

static double value(const bench_point *p, int axis)
{
    const double v = axis == 0 ? p->time_s : p->figure[0], min = axis == 0 ? BENCH_MIN_S : BENCH_MIN_ERROR;
    return log10(v > min ? v : min);
}

static void find_range(chart *c)
{
    for (int axis = 0; axis < 2; ++axis) {
        double low = 1e30, high = -1e30;
        for (int i = 0; i < c->b->count; ++i) {
            if (is_shown(&c->b->point[i])) {
                low = fmin(low, value(&c->b->point[i], axis));
                high = fmax(high, value(&c->b->point[i], axis));
            }
        }
        const double room = 0.06 * (high - low) + 0.04;
        c->low[axis] = low - room;
        c->high[axis] = high + room;
    }
}

static double x_of(const chart *c, double t)
{
    return LEFT + (t - c->low[0]) / (c->high[0] - c->low[0]) * (c->width - LEFT - RIGHT);
}

static double y_of(const chart *c, double e)
{
    return c->height - BOTTOM - (e - c->low[1]) / (c->high[1] - c->low[1]) * (c->height - TOP - BOTTOM);
}

/* --- axes --------------------------------------------------------------------------------------------------------- */

static void say_tick(const chart *c, double at, double v, int axis)
{
    char text[24];
    if (axis == 0) {
        const char *unit = v >= 0.999 ? "s" : v >= 0.000999 ? "ms" : "us";
        snprintf(text, sizeof text, "%g %s", v >= 0.999 ? v : v >= 0.000999 ? 1e3 * v : 1e6 * v, unit);
        text_buffer_add(c->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>", at,
                        c->height - BOTTOM + 16, text);
    } else {
        snprintf(text, sizeof text, c->b->percent ? "%g %%" : "%g", c->b->percent ? 100.0 * v : v);
        text_buffer_add(c->out, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%s</text>", LEFT - 7, at + 4, text);
    }
}

/* Draws lines at 1, 2 and 5 of each decade; over many decades only at 1, over less than one at more values. */
static void draw_grid(const chart *c, int axis)
{
    static const double steps[7] = {1.0, 2.0, 5.0, 1.5, 3.0, 4.0, 7.0};
    const double decades = c->high[axis] - c->low[axis];
    const int all = decades < 1.0 ? 7 : decades < 3.5 ? 3 : 1;
    for (int decade = (int)floor(c->low[axis]); decade <= (int)ceil(c->high[axis]); ++decade) {
        for (int i = 0; i < all; ++i) {
            const double v = steps[i] * pow(10.0, decade), l = log10(v);
            if (l < c->low[axis] || l > c->high[axis]) {
                continue;
            }
            const double at = axis == 0 ? x_of(c, l) : y_of(c, l);
            text_buffer_add(c->out, "<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>",
                            axis == 0 ? at : LEFT, axis == 0 ? TOP : at, axis == 0 ? at : c->width - RIGHT,
                            axis == 0 ? c->height - BOTTOM : at);
            say_tick(c, at, v, axis);
        }
    }
}

static void draw_axes(const chart *c)
{
    const double bottom = c->height - BOTTOM, right = c->width - RIGHT;
    draw_grid(c, 0);
    draw_grid(c, 1);
    text_buffer_add(c->out, "<path class=\"axis\" fill=\"none\" d=\"M%d %dV%.1fH%.1f\"/>", LEFT, TOP, bottom, right);
    text_buffer_add(
        c->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">time of one picture: farther left is faster</text>",
        (LEFT + right) / 2, c->height - 10);
    text_buffer_add(
        c->out,
        "<text transform=\"translate(13 %.1f) rotate(-90)\" text-anchor=\"middle\">error (%s): lower is nearer</text>",
        (TOP + bottom) / 2, c->b->figure[0]);
}

/* --- points ------------------------------------------------------------------------------------------------------- */

static void take(chart *c, box k)
{
    if (c->boxes < BOXES) {
        c->taken[c->boxes++] = k;
    }
}

static void draw_dot(chart *c, const bench_point *p)
{
    char label[BENCH_NAME], time[24], error[24];
    const double x = x_of(c, value(p, 0)), y = y_of(c, value(p, 1)), r = p->on_front ? 5.0 : 3.5;
    const double around = p->is_knee ? 12.0 : r + 1.0;
    const box k = {x - around, y - around, 2.0 * around, 2.0 * around};
    bench_label(label, p->name);
    bench_say_time(time, p->time_s);
    bench_say_figure(error, c->b, 0, p->figure[0]);
    if (p->is_knee) {
        text_buffer_add(c->out, "<circle class=\"knee\" cx=\"%.1f\" cy=\"%.1f\" r=\"10\"/>", x, y);
    }
    text_buffer_add(c->out, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"><title>",
                    p->on_front ? "on" : "dot", x, y, r);
    text_buffer_html(c->out, label);
    text_buffer_add(c->out, ": %s, %s</title></circle>", time, error);
    take(c, k);
}

static int overlaps(const box *a, const box *b)
{
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height && b->y < a->y + a->height;
}

static int is_free(const chart *c, const box *k)
{
    if (k->x < LEFT + 2 || k->x + k->width > c->width - 2 || k->y < 2 || k->y + k->height > c->height - BOTTOM - 2) {
        return 0;
    }
    for (int i = 0; i < c->boxes; ++i) {
        if (overlaps(k, &c->taken[i])) {
            return 0;
        }
    }
    return 1;
}

/* Tries places around the point, above and to the right first, then farther away. Returns 0 if all are taken. */
static int find_place(const chart *c, box *k, double x, double y)
{
    static const double way[8][2] = {{0, -1}, {-1, 1}, {0, 1}, {-1, -1}, {-0.5, -1}, {-0.5, 1}, {0, 0}, {-1, 0}};
    for (int far = 0; far < 9; ++far) {
        for (int i = 0; i < 8; ++i) {
            const double dx = way[i][0], dy = way[i][1], gap = 9.0 + 13.0 * far;
            k->x = x + dx * k->width + (dx < -0.6 ? -6.0 : dx < -0.1 ? 0.0 : 6.0) * (dy != 0.0 ? 1.0 : 2.0);
            k->y = y - k->height / 2 + dy * gap;
            if (is_free(c, k) && (dy != 0.0 || far == 0)) {
                return 1;
            }
        }
    }
    return 0;
}

static void draw_label(chart *c, const bench_point *p)
{
    char label[BENCH_NAME];
    const double x = x_of(c, value(p, 0)), y = y_of(c, value(p, 1));
    bench_label(label, p->name);
    box k = {0, 0, LETTER * (double)(strlen(label) + (p->is_knee ? 6 : 0)), 13};
    if (!find_place(c, &k, x, y)) {
        return;
    }
    const double middle = k.y + k.height / 2, to = x < k.x ? k.x - 2 : x > k.x + k.width ? k.x + k.width + 2 : x;
    if (fabs(middle - y) > 20.0) {
        text_buffer_add(c->out, "<line class=\"lead\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>", x, y, to,
                        middle < y ? k.y + k.height : k.y);
    }
    text_buffer_add(c->out, "<text x=\"%.1f\" y=\"%.1f\"%s>%s", k.x, k.y + 10, p->is_knee ? " class=\"at-knee\"" : "",
                    p->is_knee ? "knee: " : "");
    text_buffer_html(c->out, label);
    text_buffer_plain(c->out, "</text>");
    take(c, k);
}

/* Keeps labels off a line, as far as there is room. */
static void take_line(chart *c, double x0, double y0, double x1, double y1)
{
    const int pieces = 1 + (int)(hypot(x1 - x0, y1 - y0) / 10.0);
    for (int i = 0; i <= pieces; ++i) {
        const double t = (double)i / pieces;
        const box k = {x0 + t * (x1 - x0) - 1.5, y0 + t * (y1 - y0) - 1.5, 3.0, 3.0};
        take(c, k);
    }
}

static void draw_front(chart *c, const int *order, int n)
{
    double x = 0.0, y = 0.0;
    for (int i = 0; i < n; ++i) {
        const bench_point *p = &c->b->point[order[i]];
        const double from_x = x, from_y = y;
        x = x_of(c, value(p, 0));
        y = y_of(c, value(p, 1));
        text_buffer_add(c->out, "%s%.1f %.1f", i == 0 ? "<path class=\"front\" d=\"M" : "L", x, y);
        if (i > 0) {
            take_line(c, from_x, from_y, x, y);
        }
    }
    text_buffer_plain(c->out, n > 0 ? "\"/>" : "");
}

/* Labels the knee first, then the front, then the first option's settings, which all readers know. */
static void draw_labels(chart *c, const int *order, int n)
{
    for (int i = 0; i < n; ++i) {
        if (c->b->point[order[i]].is_knee) {
            draw_label(c, &c->b->point[order[i]]);
        }
    }
    for (int i = 0; i < n; ++i) {
        if (!c->b->point[order[i]].is_knee) {
            draw_label(c, &c->b->point[order[i]]);
        }
    }
    for (int i = 0; i < c->b->count; ++i) {
        const bench_point *p = &c->b->point[i];
        if (is_shown(p) && !p->on_front && strcmp(p->option, c->b->point[0].option) == 0) {
            draw_label(c, p);
        }
    }
}

void bench_chart(text_buffer *out, const bench_results *b, int width, int height, int styled)
{
    static chart c; /* large; refilled each time */
    int order[BENCH_POINTS];
    memset(&c, 0, sizeof c);
    c.out = out;
    c.b = b;
    c.width = width;
    c.height = height;
    find_range(&c);
    text_buffer_add(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" role=\"img\">"
        "%s<rect class=\"paper\" width=\"%d\" height=\"%d\"/>",
        width, height, width, height, styled ? style : "", width, height);
    if (c.low[0] < c.high[0]) {
        const int n = bench_front_order(order, b);
        draw_axes(&c);
        draw_front(&c, order, n);
        for (int i = 0; i < b->count; ++i) {
            if (is_shown(&b->point[i])) {
                draw_dot(&c, &b->point[i]);
            }
        }
        draw_labels(&c, order, n);
    }
    text_buffer_plain(out, "</svg>\n");
}
