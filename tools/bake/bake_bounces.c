/* bake_bounces.c: runs of elements to which light comes alike, and links to them, by which light is reflected again. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bake_triangle.h"

enum { POINTS = 2, TOGETHER = 64 / POINTS }; /* looked from, of a run: in the middle of each part of its area */

#define LOOSE 24.0f /* times a receiver's error: a run stands for many places, and what it sends is seen by all */
#define FLAT  0.2f /* error of a run to which light comes evenly, beside its relative deviation: large ones are parted */

/* --- runs --------------------------------------------------------------------------------------------------------- */

/* Elements first .. past - 1, and what is lost by taking them as one. */
typedef struct run {
    uint32_t first, past;
    float error;
} run;

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
    return out;
}

/* Where its area is halved. */
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

/* The worst one is parted until there are enough. */
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

/* --- what comes to them ------------------------------------------------------------------------------------------- */

typedef struct looks {
    lmb_vec3 at[TOGETHER * POINTS], normal[TOGETHER * POINTS];
    uint32_t of[TOGETHER * POINTS];
    int count;
} looks;

/* The element in whose part of a run's area `at` lies, m2. */
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

/* The mean rows of `count` runs, into the first rows. */
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

static int put_run(bake *b, bake_linker *linker, const run *own, float *row, report *r)
{
    bake_words *to = &b->section[LMB_TRANSFER_COARSE];
    const size_t first = b->section[LMB_TRANSFER_COARSE_LINKS].count;
    const float error = LOOSE * b->set.error;
    float *const rows[1] = {row};
    uint32_t count;
    float scale;
    return bake_links(linker, rows, 1, vec3(0.0f, 0.0f, 1.0f), error * error, &b->section[LMB_TRANSFER_COARSE_LINKS],
                      &count, &scale, r) &&
           bake_put(to, own->first, r) && bake_put(to, (uint32_t)first, r) && bake_put(to, count, r) &&
           bake_put_float(to, scale, r);
}

int bake_bounces(bake *b, report *r)
{
    float *row[TOGETHER * POINTS];
    float *memory = malloc((size_t)TOGETHER * POINTS * b->set.elements * sizeof *memory);
    run *runs = malloc(LMB_TRANSFER_MAX_COARSE * sizeof *runs);
    bake_linker *linker = bake_linker_new(b, r);
    int ok = (linker != NULL && memory != NULL && runs != NULL) || report_fail(r, "not enough memory for further reflections");
    const uint32_t count = ok ? part(runs, b) : 0;
    for (int k = 0; k < TOGETHER * POINTS && ok; ++k) {
        row[k] = memory + (size_t)k * b->set.elements;
    }
    if (ok) {
        qsort(runs, count, sizeof *runs, by_first);
    }
    for (uint32_t i = 0; i < count && ok; i += TOGETHER) {
        progress_tell("bounces", (double)i / (double)count);
        const uint32_t some = count - i < TOGETHER ? count - i : TOGETHER;
        ok = look(row, b, runs + i, some, r);
        for (uint32_t k = 0; k < some && ok; ++k) {
            ok = put_run(b, linker, &runs[i + k], row[k], r);
        }
    }
    bake_linker_free(linker);
    free(memory);
    free(runs);
    return ok;
}
