/* bake_air.c: receivers at points in the air, for six directions, to light moving objects. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

enum { SIDES = LMB_TRANSFER_AIR_RECEIVERS, TOGETHER = 10, PLACES = 1500 };

#define SUPPORT 1.5e-6f /* of the total area: support of a receiver; the grid itself is coarse */
#define SEEN    0.05f /* of all directions: a point that can receive light from less counts as inside a solid */

typedef struct air {
    bake *b;
    lmb_vec3 low;
    float step;
    uint32_t count[3];
    float *row[TOGETHER * SIDES], *memory;
    report *r;
} air;

/* About PLACES points with equal spacing along all axes, the outer ones half a step inside the scene's bounds. */
static void set_grid(air *a)
{
    const lmb_scene *s = a->b->scene;
    const lmb_vec3 size = sub3(s->bounds_max, s->bounds_min);
    const float extent[3] = {size.x, size.y, size.z}, longest = largest3(size);
    float count = 1e30f;
    for (a->step = longest / (float)LMB_TRANSFER_MAX_AIR; count > (float)PLACES; a->step *= 1.02f) {
        count = 1.0f;
        for (int k = 0; k < 3; ++k) {
            a->count[k] = (uint32_t)maxf(floorf(extent[k] / a->step), 1.0f);
            count *= (float)a->count[k];
        }
    }
    a->step /= 1.02f;
    const lmb_vec3 middle = mul3(add3(s->bounds_min, s->bounds_max), 0.5f);
    a->low = sub3(middle, mul3(vec3((float)(a->count[0] - 1), (float)(a->count[1] - 1), (float)(a->count[2] - 1)),
                               0.5f * a->step));
}

static lmb_vec3 place_of(const air *a, uint32_t i)
{
    const uint32_t x = i % a->count[0], y = i / a->count[0] % a->count[1], z = i / a->count[0] / a->count[1];
    return add3(a->low, mul3(vec3((float)x, (float)y, (float)z), a->step));
}

static lmb_vec3 side_of(int side)
{
    const float sign = side % 2 ? -1.0f : 1.0f;
    return vec3(side / 2 == 0 ? sign : 0.0f, side / 2 == 1 ? sign : 0.0f, side / 2 == 2 ? sign : 0.0f);
}

/* A receiver without parents: the whole row becomes links. */
static int add_receiver(air *a, lmb_vec3 at, lmb_vec3 normal, const float *row)
{
    bake *b = a->b;
    if (b->receiver_count == b->receiver_cap) {
        const uint32_t cap = 2 * b->receiver_cap + 64;
        bake_receiver *more = realloc(b->receiver, cap * sizeof *more);
        if (more == NULL) {
            return report_fail(a->r, "not enough memory for %u receivers", (unsigned)cap);
        }
        b->receiver = more;
        b->receiver_cap = cap;
    }
    bake_receiver *v = &b->receiver[b->receiver_count++];
    memset(v, 0, sizeof *v);
    v->place = v->at = at;
    v->target.normal = normal;
    v->target.support = SUPPORT * b->area;
    v->target.row = malloc(b->set.elements * sizeof *v->target.row);
    for (uint32_t e = 0; v->target.row != NULL && e < b->set.elements; ++e) {
        v->target.row[e] = bake_short(row[e]);
    }
    return v->target.row != NULL ||
           report_fail(a->r, "not enough memory for %u receivers", (unsigned)b->receiver_count);
}

static float sum_of(const air *a, int first)
{
    float sum = 0.0f;
    for (int k = first; k < first + SIDES; ++k) {
        for (uint32_t e = 0; e < a->b->set.elements; ++e) {
            sum += a->row[k][e];
        }
    }
    return sum / (float)SIDES;
}

/* Places first .. past - 1, at most TOGETHER. */
static int add_places(air *a, uint32_t first, uint32_t past)
{
    bake_words *to = &a->b->section[LMB_TRANSFER_AIR];
    lmb_vec3 at[TOGETHER * SIDES], normal[TOGETHER * SIDES];
    const int count = (int)(past - first) * SIDES;
    for (int k = 0; k < count; ++k) {
        at[k] = place_of(a, first + (uint32_t)(k / SIDES));
        normal[k] = side_of(k % SIDES);
    }
    if (!bake_rows(a->b, at, normal, count, 1, a->row, NULL, a->r)) {
        return 0;
    }
    for (int k = 0; k < count; k += SIDES) {
        const int is_seen = sum_of(a, k) >= SEEN;
        if (!bake_put(to, is_seen ? a->b->receiver_count : LMB_TRANSFER_NONE, a->r)) {
            return 0;
        }
        for (int i = k; i < k + SIDES && is_seen; ++i) {
            if (!add_receiver(a, at[i], normal[i], a->row[i])) {
                return 0;
            }
        }
    }
    return 1;
}

static int put_grid(air *a)
{
    bake_words *to = &a->b->section[LMB_TRANSFER_GRID];
    return bake_put_float(to, a->low.x, a->r) && bake_put_float(to, a->low.y, a->r) &&
           bake_put_float(to, a->low.z, a->r) && bake_put_float(to, 1.0f / a->step, a->r) &&
           bake_put(to, a->count[0], a->r) && bake_put(to, a->count[1], a->r) && bake_put(to, a->count[2], a->r);
}

int bake_air(bake *b, report *r)
{
    air a;
    if (b->section[LMB_TRANSFER_MOVING].count == 0) {
        return 1;
    }
    memset(&a, 0, sizeof a);
    a.b = b;
    a.r = r;
    set_grid(&a);
    a.memory = malloc((size_t)TOGETHER * SIDES * b->set.elements * sizeof *a.memory);
    int ok = (a.memory != NULL || report_fail(r, "not enough memory for light in the air")) && put_grid(&a);
    for (int k = 0; k < TOGETHER * SIDES && ok; ++k) {
        a.row[k] = a.memory + (size_t)k * b->set.elements;
    }
    const uint32_t all = a.count[0] * a.count[1] * a.count[2];
    for (uint32_t i = 0; i < all && ok; i += TOGETHER) {
        progress_tell("air", (double)i / (double)all);
        ok = add_places(&a, i, all - i < TOGETHER ? all : i + TOGETHER);
    }
    free(a.memory);
    return ok;
}

/* --- moving objects ----------------------------------------------------------------------------------------------- */

static int by_id(const void *a, const void *b)
{
    const uint32_t *x = a, *y = b;
    return x[0] < y[0] ? -1 : 1;
}

int bake_still(bake_still_scene *out, const lmb_scene *scene, const uint32_t *moving, uint32_t count,
               bake_words *ranges, report *r)
{
    const lmb_vec3 middle = mul3(add3(scene->bounds_min, scene->bounds_max), 0.5f);
    out->scene = *scene;
    out->instance = malloc((scene->instance_count + 1) * sizeof *out->instance);
    if (out->instance == NULL) {
        return report_fail(r, "not enough memory for %u objects", (unsigned)scene->instance_count);
    }
    memcpy(out->instance, scene->instances, scene->instance_count * sizeof *out->instance);
    out->scene.instances = out->instance;
    for (uint32_t i = 0; i < count; ++i) {
        lmb_instance *to = &out->instance[moving[i]];
        const uint32_t triangles = scene->meshes[to->mesh].triangle_count;
        memset(&to->to_world, 0, sizeof to->to_world);
        to->to_world.m[12] = middle.x;
        to->to_world.m[13] = middle.y;
        to->to_world.m[14] = middle.z;
        to->to_world.m[15] = 1.0f;
        if (triangles > 0 && (!bake_put(ranges, to->first_id, r) || !bake_put(ranges, to->first_id + triangles, r))) {
            return 0;
        }
    }
    if (ranges->count > 0) {
        qsort(ranges->data, ranges->count / LMB_TRANSFER_MOVING_WORDS, 2 * sizeof *ranges->data, by_id);
    }
    lmb_scene_bounds(&out->scene.bounds_min, &out->scene.bounds_max, &out->scene);
    lmb_scene_core(&out->scene.core, &out->scene);
    return 1;
}
