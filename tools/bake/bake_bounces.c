/* bake_bounces.c: groups elements that receive similar light into runs, and links to them for further bounces. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bake_share.h"
#include "bake_triangle.h"

enum { POINTS = 2, TOGETHER = 64 / POINTS }; /* sample points of a run: in the middle of each part of the area */

#define LOOSE 24.0f /* times a receiver's error: a run covers many places, and all surfaces receive light from it */
#define FOREIGN 1e20f /* error of a run with several zones, because no light passes between them */
#define FLAT  0.2f /* error per area of an evenly lit run, added to the relative deviation: splits large runs */

/* --- runs --------------------------------------------------------------------------------------------------------- */

/* Elements first .. past - 1, and the error of treating them as one. */
typedef struct run {
    uint32_t first, past;
    float error;
} run;

static int has_zones(const bake *b, uint32_t first, uint32_t past)
{
    uint32_t zone = BAKE_NO_ZONE;
    for (uint32_t e = first; e < past; ++e) {
        const uint32_t own = b->node_zone[e];
        if (own != BAKE_NO_ZONE && zone != BAKE_NO_ZONE && own != zone) {
            return 1;
        }
        zone = own != BAKE_NO_ZONE ? own : zone;
    }
    return 0;
}

static run run_of(const bake *b, uint32_t first, uint32_t past, float floor)
{
    run out = {first, past, 0.0f};
    float area = 0.0f, light = 0.0f, off = 0.0f;
    for (uint32_t e = first; e < past; ++e) {
        area += bake_open_area(&b->element[e]);
        light += bake_open_area(&b->element[e]) * b->element[e].light;
    }
    const float mean = area > 0.0f ? light / area : 0.0f;
    for (uint32_t e = first; e < past; ++e) {
        off += bake_open_area(&b->element[e]) * absf(b->element[e].light - mean);
    }
    out.error = past - first > 1 && area > 0.0f ? off / (mean + floor) + FLAT * area : 0.0f;
    out.error = has_zones(b, first, past) ? out.error + FOREIGN : out.error;
    return out;
}

/* Returns the element at which the area is halved. */
static uint32_t middle_of(const bake *b, const run *r)
{
    float area = 0.0f, half = 0.0f;
    uint32_t at = r->first;
    for (uint32_t e = r->first; e < r->past; ++e) {
        area += bake_open_area(&b->element[e]);
    }
    while (at + 1 < r->past && half < 0.5f * area) {
        half += bake_open_area(&b->element[at++]);
    }
    return at > r->first ? at : r->first + 1;
}

/* Splits the worst run until there are enough. */
static uint32_t part(run *runs, const bake *b)
{
    double light = 0.0;
    uint32_t count = 1;
    for (uint32_t e = 0; e < b->element_count; ++e) {
        light += (double)(bake_open_area(&b->element[e]) * b->element[e].light);
    }
    const float floor = 0.1f * (float)(light / (double)b->area);
    runs[0] = run_of(b, 0, b->set.elements, floor);
    while (count < LMB_TRANSFER_MAX_COARSE) {
        uint32_t worst = 0;
        for (uint32_t i = 1; i < count; ++i) {
            worst = runs[i].error > runs[worst].error ? i : worst;
        }
        if (!(runs[worst].error > 0.0f)) {
            break;
        }
        const uint32_t at = middle_of(b, &runs[worst]);
        runs[count++] = run_of(b, at, runs[worst].past, floor);
        runs[worst] = run_of(b, runs[worst].first, at, floor);
    }
    return count;
}

static int by_first(const void *a, const void *b)
{
    const run *x = a, *y = b;
    return x->first < y->first ? -1 : 1;
}

/* --- light that arrives ------------------------------------------------------------------------------------------- */

typedef struct looks {
    lmb_vec3 at[TOGETHER * POINTS], normal[TOGETHER * POINTS];
    uint32_t of[TOGETHER * POINTS];
    int count;
} looks;

/* The element at offset `at`, m2, of a run's area. */
static uint32_t element_at(const bake *b, const run *r, float at)
{
    uint32_t last = r->first;
    for (uint32_t e = r->first; e < r->past && at >= 0.0f; ++e) {
        if (bake_open_area(&b->element[e]) > 0.0f) {
            last = e;
            at -= bake_open_area(&b->element[e]);
        }
    }
    return last;
}

static void add_look(looks *l, const bake_element *e, uint32_t of)
{
    l->at[l->count] = bake_place(e);
    l->normal[l->count] = bake_facing(e);
    l->of[l->count++] = of;
}

static void add_looks(looks *l, const bake *b, const run *r, uint32_t of)
{
    float area = 0.0f;
    for (uint32_t e = r->first; e < r->past; ++e) {
        area += bake_open_area(&b->element[e]);
    }
    for (int k = 0; k < POINTS && area > 0.0f; ++k) {
        add_look(l, &b->element[element_at(b, r, area * ((float)k + 0.5f) / (float)POINTS)], of);
    }
}

/* Puts the mean rows of `count` runs into the first rows. */
static int look(float *const *row, const bake *b, const run *runs, uint32_t count, report *r)
{
    looks l;
    l.count = 0;
    for (uint32_t i = 0; i < count; ++i) {
        add_looks(&l, b, &runs[i], i);
    }
    if (l.count > 0 && !bake_rows(b, l.at, l.normal, l.count, 1, row, NULL, r)) {
        return 0;
    }
    for (int k = l.count; k < TOGETHER * POINTS; ++k) {
        memset(row[k], 0, b->set.elements * sizeof *row[k]);
    }
    for (uint32_t i = 0, k = 0; i < count; ++i) {
        const int is_lit = k < (uint32_t)l.count && l.of[k] == i;
        for (uint32_t e = 0; e < b->set.elements; ++e) {
            float sum = 0.0f;
            for (uint32_t p = 0; p < POINTS && is_lit; ++p) {
                sum += row[k + p][e];
            }
            row[i][e] = sum * (1.0f / POINTS);
        }
        k += is_lit ? POINTS : 0;
    }
    return 1;
}

/* Batches of runs and their results. */
typedef struct bounce_step {
    bake *b;
    const run *runs;
    uint32_t count;
    bake_linker *linker;
    float *row[TOGETHER * POINTS];
    bake_target *target; /* of each run: links and their unit */
} bounce_step;

static uint32_t past_of(const bounce_step *s, int32_t batch)
{
    return bake_past(batch, TOGETHER, s->count);
}

static int make_batch(void *user, int32_t batch, report *r)
{
    const bounce_step *s = user;
    const uint32_t first = (uint32_t)batch * TOGETHER;
    const float error = LOOSE * s->b->set.error;
    progress_tell("bounces", (double)first / (double)s->count);
    int ok = look(s->row, s->b, s->runs + first, past_of(s, batch) - first, r);
    for (uint32_t i = first; ok && i < past_of(s, batch); ++i) {
        float *const row[1] = {s->row[i - first]};
        bake_target *t = &s->target[i];
        t->link.count = 0;
        ok = bake_links(s->linker, row, 1, vec3(0.0f, 0.0f, 1.0f), error * error, &t->link, &t->links, &t->scale, r);
    }
    return ok;
}

static double weight_of(const void *user, int32_t batch)
{
    return (double)POINTS * (double)(past_of(user, batch) - (uint32_t)batch * TOGETHER);
}

static void put_batch(const void *user, int32_t batch, byte_buffer *to)
{
    const bounce_step *s = user;
    for (uint32_t i = (uint32_t)batch * TOGETHER; i < past_of(s, batch); ++i) {
        const bake_target *t = &s->target[i];
        byte_put_float(to, t->scale);
        byte_put_int(to, (int32_t)t->link.count);
        for (size_t k = 0; k < t->link.count; ++k) {
            byte_put_int(to, (int32_t)t->link.data[k]);
        }
    }
}

static int get_batch(void *user, int32_t batch, byte_reader *from)
{
    const bounce_step *s = user;
    report unheard = {""};
    for (uint32_t i = (uint32_t)batch * TOGETHER; i < past_of(s, batch); ++i) {
        bake_target *t = &s->target[i];
        t->scale = byte_get_float(from);
        t->links = (uint32_t)byte_get_int(from);
        t->link.count = 0;
        for (uint32_t k = 0; k < t->links && !from->is_short; ++k) {
            if (!bake_put(&t->link, (uint32_t)byte_get_int(from), &unheard)) {
                return 0;
            }
        }
    }
    return !from->is_short;
}

/* Writes the runs into the sections of the file. */
static int put_runs(const bounce_step *s, report *r)
{
    bake_words *to = &s->b->section[LMB_TRANSFER_COARSE], *links = &s->b->section[LMB_TRANSFER_COARSE_LINKS];
    int ok = 1;
    for (uint32_t i = 0; ok && i < s->count; ++i) {
        const bake_target *t = &s->target[i];
        ok = bake_put(to, s->runs[i].first, r) && bake_put(to, (uint32_t)links->count, r) &&
             bake_put(to, t->links, r) && bake_put_float(to, t->scale, r);
        for (size_t k = 0; ok && k < t->link.count; ++k) {
            ok = bake_put(links, t->link.data[k], r);
        }
    }
    return ok;
}

int bake_bounces(bake *b, report *r)
{
    float *memory = malloc((size_t)TOGETHER * POINTS * b->set.elements * sizeof *memory);
    run *runs = malloc(LMB_TRANSFER_MAX_COARSE * sizeof *runs);
    bounce_step s = {b, runs, 0, bake_linker_new(b, r), {NULL}, calloc(LMB_TRANSFER_MAX_COARSE, sizeof *s.target)};
    int ok = (s.linker != NULL && memory != NULL && runs != NULL && s.target != NULL) ||
             report_fail(r, "not enough memory for further reflections");
    for (int k = 0; k < TOGETHER * POINTS && ok; ++k) {
        s.row[k] = memory + (size_t)k * b->set.elements;
    }
    if (ok) {
        s.count = part(runs, b);
        qsort(runs, s.count, sizeof *runs, by_first);
    }
    const bake_step step = {
        (int32_t)((s.count + TOGETHER - 1) / TOGETHER), weight_of, make_batch, put_batch, get_batch, &s};
    ok = ok && bake_share_step(b->share, &step, r) && put_runs(&s, r);
    for (uint32_t i = 0; s.target != NULL && i < s.count; ++i) {
        free(s.target[i].link.data);
    }
    bake_linker_free(s.linker);
    free(s.target);
    free(memory);
    free(runs);
    return ok;
}
