/* bench_shares.c: each case's share of the machine's bound, as a page with bars. */
#include "bench_shares.h"

#include "bench_style.h"

enum { LEFT = 200, RIGHT = 190, TOP = 30, ROW = 22, BAR = 14, WIDTH = 940 };

static double x_of(double share) { return LEFT + share * (WIDTH - LEFT - RIGHT); }

static void put_grid(text_buffer *out, int bottom)
{
    for (int percent = 0; percent <= 100; percent += 10) {
        const double x = x_of(percent / 100.0);
        text_buffer_add(out, "<line class=\"grid\" x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\"/>", x, TOP, x, bottom);
        text_buffer_add(out, "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%d %%</text>", x, TOP - 8, percent);
    }
}

/* A share may exceed 1, because load on the machine can differ between the frame and the bound's loops. */
static void put_bar(text_buffer *out, const bench_share *s, int y)
{
    const double share = s->bound_ms / s->ms, end = x_of(share < 1.0 ? share : 1.0);
    text_buffer_add(out, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">", LEFT - 8, y + 11);
    text_buffer_html(out, s->name);
    text_buffer_add(out, "</text><rect class=\"on\" x=\"%d\" y=\"%d\" width=\"%.1f\" height=\"%d\"/>", LEFT, y,
                    end - LEFT, BAR);
    text_buffer_add(out, "<text x=\"%.1f\" y=\"%d\">%.0f %%: %.2f of %.2f ms, %s</text>", end + 6, y + 11,
                    100.0 * share, s->bound_ms, s->ms, s->by);
}

static void put_chart(text_buffer *out, const bench_shares *b)
{
    const int bottom = TOP + ROW * b->count, height = bottom + 10;
    text_buffer_add(out,
                    "<div class=\"chart\"><svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
                    "height=\"%d\" role=\"img\"><rect class=\"paper\" width=\"%d\" height=\"%d\"/>",
                    WIDTH, height, WIDTH, height, WIDTH, height);
    put_grid(out, bottom);
    for (int i = 0; i < b->count; ++i) {
        put_bar(out, &b->row[i], TOP + ROW * i + (ROW - BAR) / 2);
    }
    text_buffer_plain(out, "</svg></div>\n");
}

void bench_shares_html(text_buffer *out, const bench_shares *b)
{
    text_buffer_plain(out, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                           "<meta name=\"viewport\" content=\"width=device-width\"><title>shares of the bound</title>\n"
                           "<style>");
    for (int i = 0; i < BENCH_STYLE_PARTS; ++i) {
        text_buffer_plain(out, bench_style[i]);
    }
    text_buffer_add(out, "</style></head><body>\n<h1>Shares of the bound</h1>\n<p>Least times of the raster workload's "
                         "frames on one thread, back end <b>%s</b>. ",
                    b->backend);
    text_buffer_plain(out,
                      "A bar is the share of its time that the same run finds this machine needs at least: to read, "
                      "test and write the frame's depths in cache (depth), or to keep one unit busy with its "
                      "arithmetic. All lanes count as if they were of use.</p>\n");
    put_chart(out, b);
    if (b->count == 0) {
        text_buffer_plain(out, "<p>No rates of this back end are known here.</p>\n");
    }
    text_buffer_plain(out, "</body></html>\n");
}
