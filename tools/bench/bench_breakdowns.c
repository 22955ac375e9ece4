/* bench_breakdowns.c: error breakdowns of some settings, by chains of pictures with one more exact stage each. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/progress.h"
#include "bench_breakdown.h"
#include "bench_breakdowns.h"

#include <lambent/types.h>

enum { DRAWN_WEIGHT = 25 };

/* Pictures between a setting and the truth. */
typedef struct chain {
    image drawn[BENCH_ROWS];
    const float *picture[BENCH_ROWS + 1];
    int count;
} chain;

static int wanted(const bench_options *o) { return o->subject->exact != NULL && o->breakdown > 0; }

double bench_breakdowns_weight(const bench_options *o)
{
    return wanted(o) ? (double)BENCH_BREAKDOWNS * o->subject->exact_count * DRAWN_WEIGHT / o->breakdown : 0.0;
}

static int names(const bench_line *line, const char *option)
{
    const option_row *row = NULL;
    for (int i = 1; i < line->argc && (row == NULL || strcmp(row->name, option) != 0); ++i) {
        row = line->argv[i][0] == '-' ? options_find(line->table, line->argv[i]) : NULL;
    }
    return row != NULL && strcmp(row->name, option) == 0;
}

static int draw(image *out, const sweep *s, const bench_line *line, report *r)
{
    const bench_way way = {0, s->o->breakdown};
    bench_shot shot;
    if (!s->o->subject->draw(&shot, line, &way, r)) {
        return 0;
    }
    *out = shot.picture;
    shot.picture.pixels = NULL;
    bench_shot_free(&shot);
    return 1;
}

static void step(chain *c, bench_breakdown *l, const char *stage, const char *to, const float *picture)
{
    bench_row *row = &l->row[l->rows++];
    snprintf(row->stage, sizeof row->stage, "%s", stage);
    snprintf(row->to, sizeof row->to, "%s", to);
    c->picture[l->rows] = picture;
}

/* The picture with stage `at` exact. For the last stage this is the truth if it is the subject's, or a picture that is
 * drawn once for all settings. Returns NULL if the options so far are incompatible. */
static const float *lead(chain *c, sweep *s, const bench_line *line, int at, image *finest)
{
    const int is_last = at + 1 == s->o->subject->exact_count;
    image *into = is_last ? finest : &c->drawn[at];
    report unheard = {""};
    if (is_last && s->truth.is_own) {
        return s->truth.picture.pixels;
    }
    return into->pixels != NULL || draw(into, s, line, &unheard) ? into->pixels : NULL;
}

/* Builds the chain of a setting. If a stage can be made exact only together with the next one, both share a row. */
static int follow(chain *c, bench_breakdown *l, sweep *s, int point, image *finest, report *r)
{
    const bench_subject *subject = s->o->subject;
    const char *words = strcmp(s->b->point[point].name, "default") == 0 ? "" : s->b->point[point].name;
    char name[40] = "";
    bench_line line;
    int ok = sweep_line(&line, s, words, r) && bench_line_hurry(&line, subject);
    c->picture[0] = s->kept[point].pixels;
    for (int i = 0; i < subject->exact_count && ok; ++i) {
        const bench_exact *e = &subject->exact[i];
        const int is_exact = e->by != NULL && !names(&line, e->by);
        progress_whole(words[0] != '\0' ? words : "default", s->done / s->all);
        s->done += (double)DRAWN_WEIGHT / s->o->breakdown;
        ok = bench_line_add(&line, e->words) || report_fail(r, "too many options");
        const float *to = is_exact ? NULL : lead(c, s, &line, i, finest);
        snprintf(name + strlen(name), sizeof name - strlen(name), "%s%s", name[0] != '\0' ? " and " : "", e->stage);
        if (to != NULL) {
            step(c, l, name, e->words, to);
        }
        name[to != NULL || is_exact ? 0 : strlen(name)] = '\0';
    }
    if (!s->truth.is_own) {
        step(c, l, "what is left", "the truth", s->truth.picture.pixels);
    }
    return ok && (l->rows > 0 || report_fail(r, "no stage could be made exact"));
}

/* The pixels of the drawn bands. */
static uint8_t *sampled(const sweep *s)
{
    const image *t = &s->truth.picture;
    uint8_t *counts = calloc((size_t)t->width * (size_t)t->height, 1);
    for (int32_t i = 0; counts != NULL && i < t->width * t->height; ++i) {
        const int32_t band = i / t->width / LMB_TILE;
        counts[i] =
            (uint8_t)(band % s->o->breakdown == 0 && (s->truth.surface == NULL || s->truth.surface[3 * i + 2] > 0.5f));
    }
    return counts;
}

static int add(sweep *s, int point, image *finest, const uint8_t *counts, report *r)
{
    bench_breakdown *l = &s->b->breakdown[s->b->breakdowns];
    const size_t pixels = (size_t)s->truth.picture.width * (size_t)s->truth.picture.height;
    chain c;
    memset(&c, 0, sizeof c);
    memset(l, 0, sizeof *l); /* the last setting may have left rows, but no error that they share */
    snprintf(l->name, sizeof l->name, "%s", s->b->point[point].name);
    const int ok = follow(&c, l, s, point, finest, r);
    s->b->breakdowns += ok && bench_breakdown_sum(l, c.picture, counts, pixels);
    for (int i = 0; i < BENCH_ROWS; ++i) {
        image_free(&c.drawn[i]);
    }
    return ok;
}

/* Chooses the subject's first settings, which are presets, and the knee. */
static int choose(int out[BENCH_BREAKDOWNS], const sweep *s)
{
    int n = 0, knee = -1;
    for (int i = 0; i < s->b->count; ++i) {
        const bench_point *p = &s->b->point[i];
        const int is_first = n < BENCH_BREAKDOWNS - 1 && strcmp(p->option, s->b->point[0].option) == 0;
        if (p->has_figures && is_first && (s->o->ranges == 0 || i == 0)) {
            out[n++] = i;
        } else if (p->is_knee) {
            knee = i;
        }
    }
    if (knee >= 0) {
        out[n++] = knee;
    }
    return n;
}

int bench_breakdowns(sweep *s, report *r)
{
    int point[BENCH_BREAKDOWNS];
    if (!wanted(s->o)) {
        return 1;
    }
    image finest = {0, 0, 0, NULL};
    uint8_t *counts = sampled(s);
    int ok = counts != NULL || report_fail(r, "out of memory");
    const int n = choose(point, s);
    for (int i = 0; i < n && ok; ++i) {
        ok = add(s, point[i], &finest, counts, r);
    }
    s->b->breakdown_share = 1.0 / s->o->breakdown;
    free(counts);
    image_free(&finest);
    return ok;
}
