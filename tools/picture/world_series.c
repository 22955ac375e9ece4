/* world_series.c: a world that changes: numbered files, blended from one to the next. */
#include "world_series.h"

#include <stdlib.h>
#include <string.h>

#include "../common/frame_name.h"

enum { MOST_FIRST = 9999, MOST = 1000000, NAME = 4096 };

int world_series_name(char *out, size_t size, const world_series *s, int32_t index, report *r)
{
    return frame_name(out, size, s->pattern, s->first + index, r);
}

int world_series_find(world_series *out, const char *pattern, report *r)
{
    char name[NAME];
    out->pattern = pattern;
    out->first = out->count = 0;
    for (; out->first < MOST_FIRST; ++out->first) {
        if (!world_series_name(name, sizeof name, out, 0, r)) {
            return 0;
        }
        if (world_is_there(name)) {
            break;
        }
    }
    while (out->count < MOST && world_series_name(name, sizeof name, out, out->count, r) && world_is_there(name)) {
        ++out->count;
    }
    return out->count > 0 || report_fail(r, "%s: no world of this name with a number from 0 to %d", pattern,
                                         MOST_FIRST);
}

world_moment world_series_at(const world_series *s, int32_t k, int32_t every)
{
    world_moment at = {k / every, (float)(k % every) / (float)every};
    if (at.index >= s->count - 1) {
        at.index = s->count - 1;
        at.share = 0.0f;
    }
    return at;
}

int world_series_check(const world_series *s, int32_t first, int32_t pictures, int32_t every, int has_one_size,
                       report *r)
{
    const world_moment from = world_series_at(s, first, every), last = world_series_at(s, first + pictures - 1, every);
    const int32_t past = last.index + (last.share > 0.0f ? 2 : 1);
    int32_t wanted = 0, side = 0;
    char name[NAME], one[NAME];
    for (int32_t i = from.index; i < past; ++i) {
        if (!world_series_name(name, sizeof name, s, i, r) || !world_check(name, &side, r)) {
            return 0;
        }
        wanted = i == from.index ? side : wanted;
        if (has_one_size && side != wanted) {
            return world_series_name(one, sizeof one, s, from.index, r) &&
                   report_fail(r, "%s: faces of %d pixels, and %s has %d; files of one series have one size", name,
                               (int)side, one, (int)wanted);
        }
    }
    return 1;
}

void world_series_tell(const world_series *s, int32_t last_picture, int32_t every, int is_quiet)
{
    const double stays = (double)(s->count - 1) * (double)every;
    report_note(is_quiet || s->count == 0 || (double)last_picture <= stays,
                "note: %s ends after number %d: from picture %.0f on the world stays", s->pattern,
                (int)(s->first + s->count - 1), stays);
}

/* --- a blend ------------------------------------------------------------------------------------------------------ */

static float alpha_at(const lmb_world_pictures *p, int face, size_t i)
{
    return p->face[face] == NULL ? 0.0f : p->alpha[face] == NULL ? 1.0f : p->alpha[face][i];
}

/* Blends a face: light by alpha, so that where one is blank only the other counts. */
static void blend_face(float *rgb, float *alpha, const lmb_world_pictures *a, const lmb_world_pictures *b, int face,
                       float share)
{
    const size_t texels = (size_t)a->face_size * (size_t)a->face_size;
    for (size_t i = 0; i < texels; ++i) {
        const float wa = (1.0f - share) * alpha_at(a, face, i), wb = share * alpha_at(b, face, i), sum = wa + wb;
        for (size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const float from = wa > 0.0f ? wa * a->face[face][c] : 0.0f, to = wb > 0.0f ? wb * b->face[face][c] : 0.0f;
            rgb[c] = sum > 0.0f ? (from + to) / sum : 0.0f;
        }
        if (alpha != NULL) {
            alpha[i] = sum;
        }
    }
}

static int blend(lmb_world_pictures *out, world_pictures *own, const lmb_world_pictures *a, const lmb_world_pictures *b,
                 float share, const char *name, report *r)
{
    const size_t texels = (size_t)a->face_size * (size_t)a->face_size;
    out->face_size = a->face_size;
    for (int i = 0; i < 6; ++i) {
        const int is_whole = a->face[i] != NULL && b->face[i] != NULL && a->alpha[i] == NULL && b->alpha[i] == NULL;
        if (a->face[i] == NULL && b->face[i] == NULL) {
            continue;
        }
        out->face[i] = own->face[i] = malloc(3 * texels * sizeof(float));
        out->alpha[i] = own->alpha[i] = is_whole ? NULL : malloc(texels * sizeof(float));
        if (own->face[i] == NULL || (!is_whole && own->alpha[i] == NULL)) {
            return report_fail(r, "%s: out of memory", name);
        }
        blend_face(own->face[i], own->alpha[i], a, b, i, share);
    }
    return 1;
}

int world_series_read(lmb_world_pictures *out, world_pictures *own, const world_series *s, world_moment at, report *r)
{
    char name[2][NAME];
    lmb_world_pictures cube[2];
    world_pictures memory[2];
    int ok = 1;
    if (at.share == 0.0f) {
        return world_series_name(name[0], NAME, s, at.index, r) && world_read_cube(out, own, name[0], r);
    }
    memset(out->face, 0, sizeof out->face);
    memset(out->alpha, 0, sizeof out->alpha);
    memset(cube, 0, sizeof cube);
    memset(memory, 0, sizeof memory);
    for (int i = 0; ok && i < 2; ++i) {
        ok = world_series_name(name[i], NAME, s, at.index + i, r) &&
             world_read_cube(&cube[i], &memory[i], name[i], r);
    }
    if (ok && cube[0].face_size != cube[1].face_size) { /* a file that has changed since world_series_check */
        ok = report_fail(r, "%s: faces of %d pixels, and %s has %d", name[1], (int)cube[1].face_size, name[0],
                         (int)cube[0].face_size);
    }
    ok = ok && blend(out, own, &cube[0], &cube[1], at.share, name[0], r);
    own->not_finite += memory[0].not_finite + memory[1].not_finite;
    world_pictures_free(&memory[0]);
    world_pictures_free(&memory[1]);
    return ok;
}
