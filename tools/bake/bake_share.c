/* bake_share.c: a step's batches -> one file per slice -> the results of all batches.
 *
 * No slice depends on another. If one is lost or late, the others do that work. A slice that comes late or runs again
 * finds the finished results in the folder. */
#include "bake_share.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"

enum { GROUP = 8 };
#define LOOK_S  0.002 /* between two checks for files */
#define STIR_S  0.1   /* between two temporary files in the folder */
#define LEAST_S 1.0   /* least time to wait for others, in addition to TIMES the expected time of their batches here */
#define TIMES   3.0
#define LATE    0.05  /* of that wait, for slices that were late before */

/* --- rows --------------------------------------------------------------------------------------------------------- */

void bake_put_halves(byte_buffer *to, const uint16_t *row, size_t count)
{
    for (size_t i = 0; i < count; i += GROUP) {
        uint8_t bytes[1 + 2 * GROUP];
        size_t size = 1;
        bytes[0] = 0;
        for (size_t k = 0; k < GROUP; ++k) {
            if (row[i + k] != 0) {
                bytes[0] = (uint8_t)(bytes[0] | 1u << k);
                bytes[size++] = (uint8_t)(row[i + k] & 255u);
                bytes[size++] = (uint8_t)(row[i + k] >> 8);
            }
        }
        byte_put(to, bytes, size);
    }
}

int bake_get_halves(uint16_t *row, size_t count, byte_reader *from)
{
    for (size_t i = 0; i < count; i += GROUP) {
        const uint8_t *mask = byte_get(from, 1);
        for (size_t k = 0; k < GROUP; ++k) {
            const uint8_t *v = mask != NULL && (*mask >> k & 1u) != 0 ? byte_get(from, 2) : NULL;
            row[i + k] = v != NULL ? (uint16_t)(v[0] | v[1] << 8) : 0;
        }
    }
    return !from->is_short;
}

/* --- a step ------------------------------------------------------------------------------------------------------- */

/* A step in progress. */
typedef struct sharing {
    bake_share *s;
    const bake_step *step;
    int32_t *owner; /* of each batch: the slice, from 0 */
    double *weight; /* of each slice in this step */
    uint8_t *is_there; /* results of a slice are available */
    uint64_t job;
    report *r;
} sharing;

/* Gives each batch to the slice with the least work over all steps. The loads stay even, although a step may have
 * fewer batches than there are slices. */
static void deal(const sharing *w)
{
    bake_share *s = w->s;
    for (int32_t i = 0; i < w->step->batches; ++i) {
        const double own = w->step->weight != NULL ? w->step->weight(w->step->user, i) : 1.0;
        int32_t to = 0;
        for (int32_t k = 1; k < s->slice.count; ++k) {
            to = s->load[k] < s->load[to] ? k : to;
        }
        w->owner[i] = to;
        s->load[to] += own;
        w->weight[to] += own;
        s->all += own;
    }
}

/* Hash of job, step and owners of the batches: files of another distribution do not match. */
static uint64_t job_of(const sharing *w)
{
    const uint8_t step[2] = {(uint8_t)(w->s->step & 255), (uint8_t)(w->s->step >> 8)};
    uint64_t job = slice_hash(w->s->job, step, sizeof step);
    for (int32_t i = 0; i < w->step->batches; ++i) {
        const uint8_t owner[2] = {(uint8_t)(w->owner[i] & 255), (uint8_t)(w->owner[i] >> 8)};
        job = slice_hash(job, owner, sizeof owner);
    }
    return job;
}

static int file_of(char out[SLICE_NAME], const sharing *w, int32_t k)
{
    const int n = snprintf(out, SLICE_NAME, "%s%dof%d.%d", w->s->folder, (int)k + 1, (int)w->s->slice.count,
                           (int)w->s->step);
    return (n > 0 && n < SLICE_NAME) || report_fail(w->r, "%s: the name is too long", w->s->folder);
}

/* Reads the results of slice k; returns 0 if the file is missing, incomplete or of another job. */
static int fetch(const sharing *w, int32_t k)
{
    char name[SLICE_NAME];
    slice_file f;
    report unheard = {""};
    if (!file_of(name, w, k) || !slice_read(&f, name, &unheard)) {
        return 0;
    }
    int ok =
        f.kind == SLICE_BAKE_STEP && f.job == w->job && f.slice.count == w->s->slice.count && f.slice.number == k + 1;
    for (int32_t i = 0; ok && i < w->step->batches; ++i) {
        ok = w->owner[i] != k || w->step->get(w->step->user, i, &f.says);
    }
    ok = ok && f.says.at == f.says.end;
    slice_file_free(&f);
    return ok;
}

/* Computes the work of slice k here and writes the file. */
static int make(const sharing *w, int32_t k)
{
    const slice of = {k + 1, w->s->slice.count};
    const double start = host_seconds();
    char name[SLICE_NAME];
    byte_buffer says = {NULL, 0, 0, 0};
    int ok = file_of(name, w, k);
    for (int32_t i = 0; ok && i < w->step->batches; ++i) {
        if (w->owner[i] == k) {
            ok = w->step->make(w->step->user, i, w->r);
            w->step->put(w->step->user, i, &says);
        }
    }
    w->s->made += w->weight[k];
    w->s->unit_s = w->weight[k] > 0.0 ? (host_seconds() - start) / w->weight[k] : w->s->unit_s;
    ok = ok && slice_write(name, of, SLICE_BAKE_STEP, w->job, "a step of a bake", &says, w->r);
    free(says.data);
    return ok;
}

/* How long to wait for slice k. */
static double patience(const sharing *w, int32_t k)
{
    const double s = LEAST_S + TIMES * w->s->unit_s * w->weight[k];
    return w->s->is_late[k] ? LATE * s : s;
}

/* Returns one overdue slice. Slices that wait for the same ones start at different places. */
static int32_t overdue(const sharing *w, double waited)
{
    const int32_t n = w->s->slice.count;
    for (int32_t i = 0; i < n; ++i) {
        const int32_t k = (w->s->slice.number + i * (w->s->slice.number % 2 ? 1 : n - 1)) % n;
        if (!w->is_there[k] && waited > patience(w, k)) {
            return k;
        }
    }
    return -1;
}

/* Reads the files that have arrived; returns how many are missing. */
static int32_t fetch_all(const sharing *w)
{
    int32_t missing = 0;
    for (int32_t k = 0; k < w->s->slice.count; ++k) {
        if (!w->is_there[k] && fetch(w, k)) {
            w->is_there[k] = 1;
            w->s->is_late[k] = 0;
        }
        missing += !w->is_there[k];
    }
    return missing;
}

/* A network file system may report a new file as missing until the folder changes. */
static int stir(const sharing *w)
{
    char name[SLICE_NAME];
    report unheard = {""};
    return file_of(name, w, w->s->slice.number - 1) && file_can_write(name, &unheard);
}

static int run(const sharing *w)
{
    const int32_t own = w->s->slice.number - 1;
    for (int32_t k = 0; k < w->s->slice.count; ++k) {
        w->is_there[k] = !(w->weight[k] > 0.0);
    }
    if (!w->is_there[own]) { /* may exist from an earlier run */
        w->is_there[own] = (uint8_t)(fetch(w, own) || make(w, own));
        if (!w->is_there[own]) {
            return 0;
        }
    }
    const double start = host_seconds();
    double stirred = 0.0;
    while (fetch_all(w) > 0) {
        const double waited = host_seconds() - start;
        const int32_t k = overdue(w, waited);
        if (k < 0 && waited > stirred + STIR_S) { /* clears the folder cache of a network file system */
            stirred = waited;
            (void)stir(w);
        } else if (k < 0) {
            host_sleep(LOOK_S);
        }
        if (k < 0) {
            continue;
        }
        w->s->is_late[k] = 1;
        if (!make(w, k)) {
            return 0;
        }
        w->is_there[k] = 1;
    }
    return 1;
}

/* `s`: NULL, or the only slice. */
static int make_alone(bake_share *s, const bake_step *step, report *r)
{
    int ok = 1;
    for (int32_t i = 0; ok && i < step->batches; ++i) {
        const double own = s != NULL && step->weight != NULL ? step->weight(step->user, i) : 1.0;
        if (s != NULL) {
            s->made += own;
            s->all += own;
        }
        ok = step->make(step->user, i, r);
    }
    return ok;
}

int bake_share_step(bake_share *s, const bake_step *step, report *r)
{
    if (s == NULL || s->slice.count < 2) {
        return make_alone(s, step, r);
    }
    if (step->batches == 0) {
        return 1;
    }
    sharing w = {s, step, NULL, NULL, NULL, 0, r};
    const size_t slices = (size_t)s->slice.count;
    w.owner = malloc((size_t)step->batches * sizeof *w.owner);
    w.weight = calloc(slices, sizeof *w.weight);
    w.is_there = calloc(slices, 1);
    ++s->step;
    int ok = (w.owner != NULL && w.weight != NULL && w.is_there != NULL) ||
             report_fail(r, "not enough memory for %d batches", (int)step->batches);
    if (ok) {
        deal(&w);
        w.job = job_of(&w);
        ok = run(&w);
    }
    free(w.owner);
    free(w.weight);
    free(w.is_there);
    return ok;
}
