/* light_colours.c: bounced light as vertex colours: subdivides triangles like the bake, so that light is as linear on
 * each. */
#include "light_export.h"

#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "../model/io_lmt.h"
#include "bake_triangle.h"

#define INSIDE 0.002f /* of the way to the middle: the light of a leaf's corners is sampled this far inside */
#define LINEAR 0.03f  /* of the mean light: largest error at the middle of an edge */
enum { CONFORM = 24, ROUNDS = 5, TOGETHER = SOLVE_PLACES / 3 };

/* A leaf of the subdivision. */
typedef struct leaf {
    light_corner corner[3];
    lmb_vec3 face;
    uint32_t id;
    uint32_t number;   /* index when created */
    float light[3][3]; /* W/m2 */
} leaf;

/* All leaves of one object, and the positions of all corners. */
typedef struct colours {
    light_solve *s;
    const model_source *source;
    leaf *leaf;
    size_t count, cap;
    lmb_vec3 *place; /* a set, by hash; w of an empty slot: used 0 */
    uint8_t *used;
    uint32_t mask;
    report *r;
} colours;

/* --- places ------------------------------------------------------------------------------------------------------- */

static uint32_t hash_of(lmb_vec3 p)
{
    uint32_t bits[3], h = 2166136261u;
    const float v[3] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; /* avoids minus zero */
    memcpy(bits, v, sizeof bits);
    for (int c = 0; c < 3; ++c) {
        h = (h ^ bits[c]) * 16777619u;
        h ^= h >> 15;
    }
    return h;
}

static int is_same(lmb_vec3 a, lmb_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static int has_place(const colours *c, lmb_vec3 p)
{
    uint32_t h = hash_of(p) & c->mask;
    while (c->used[h] && !is_same(c->place[h], p)) {
        h = (h + 1) & c->mask;
    }
    return c->used[h];
}

static void put_place(colours *c, lmb_vec3 p)
{
    uint32_t h = hash_of(p) & c->mask;
    while (c->used[h] && !is_same(c->place[h], p)) {
        h = (h + 1) & c->mask;
    }
    c->used[h] = 1;
    c->place[h] = p;
}

static int put_places(colours *c)
{
    uint32_t slots = 1024;
    while (slots < 8 * c->count) {
        slots *= 2;
    }
    c->mask = slots - 1;
    c->place = malloc(slots * sizeof *c->place);
    c->used = calloc(slots, 1);
    if (c->place == NULL || c->used == NULL) {
        return report_fail(c->r, "not enough memory for %.0f corners", 3.0 * (double)c->count);
    }
    for (size_t i = 0; i < c->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            put_place(c, c->leaf[i].corner[k].at);
        }
    }
    return 1;
}

/* --- leaves ------------------------------------------------------------------------------------------------------- */

static int put_leaf(colours *c, const light_corner corner[3], lmb_vec3 face, uint32_t id)
{
    if (c->count == c->cap) {
        const size_t cap = 2 * c->cap + 1024;
        leaf *more = realloc(c->leaf, cap * sizeof *more);
        if (more == NULL) {
            return report_fail(c->r, "not enough memory for %.0f pieces of triangles", (double)cap);
        }
        c->leaf = more;
        c->cap = cap;
    }
    leaf *l = &c->leaf[c->count++];
    memset(l, 0, sizeof *l);
    memcpy(l->corner, corner, sizeof l->corner);
    l->face = face;
    l->id = id;
    l->number = (uint32_t)c->count;
    return 1;
}

/* Halves the triangle. Corners are in the order of the file, and `turn` maps them. */
static int divide(colours *c, uint32_t at, const light_corner corner[3], lmb_vec3 face, uint32_t id, int is_turned)
{
    const uint32_t word = c->s->job.transfer.section[LMB_TRANSFER_DIVISIONS][at];
    if (word & LMB_TRANSFER_LEAF) {
        const light_corner turned[3] = {corner[2], corner[1], corner[0]};
        return put_leaf(c, is_turned ? turned : corner, face, id);
    }
    const lmt_halving h = lmt_halving_of(&c->s->job.transfer, at);
    const int to = h.to;
    const light_corner between = light_along(&corner[h.from], &corner[to], h.part);
    light_corner half[3];
    memcpy(half, corner, sizeof half);
    half[to] = between;
    if (!divide(c, h.first, half, face, id, is_turned)) {
        return 0;
    }
    half[to] = corner[to];
    half[h.from] = between;
    return divide(c, h.first + 1, half, face, id, is_turned);
}

/* Adds the leaves of a side. If no light reaches it, adds one dark leaf for a front, none for a back. */
static int put_side(colours *c, uint32_t id, uint32_t back)
{
    const lmb_transfer *t = &c->s->job.transfer;
    const uint32_t root = t->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1) + 2 + back];
    light_corner corner[3];
    lmb_vec3 face;
    lmb_triangle own;
    if (!light_corners(corner, &face, &c->s->job.scene, c->source, id, back) ||
        !lmb_triangle_fetch(&own, &c->s->job.scene, id)) {
        return 1; /* degenerate */
    }
    if (root == LMB_TRANSFER_NONE) {
        return back || put_leaf(c, corner, face, id);
    }
    const int is_turned = !is_same(corner[0].at, own.corner[0]);
    const light_corner turned[3] = {corner[2], corner[1], corner[0]};
    return divide(c, root, is_turned ? turned : corner, face, id, is_turned);
}

/* A point slightly inside the leaf, so that no neighbour's light is sampled. */
static light_place place_in(const leaf *l, const light_corner *at)
{
    const lmb_vec3 middle = mul3(add3(l->corner[0].at, add3(l->corner[1].at, l->corner[2].at)), 1.0f / 3.0f);
    const light_place p = {add3(at->at, mul3(sub3(middle, at->at), INSIDE)), l->face, at->normal, l->id};
    return p;
}

/* Computes the light at the corners of leaves from `first` on. */
static void light_leaves(colours *c, size_t first)
{
    light_place place[SOLVE_PLACES];
    float out[SOLVE_PLACES][3];
    for (; first < c->count; first += TOGETHER) {
        const size_t some = c->count - first < TOGETHER ? c->count - first : TOGETHER;
        for (size_t i = 0; i < 3 * some; ++i) {
            place[i] = place_in(&c->leaf[first + i / 3], &c->leaf[first + i / 3].corner[i % 3]);
        }
        light_at(out, c->s, place, (int)(3 * some));
        for (size_t i = 0; i < 3 * some; ++i) {
            memcpy(c->leaf[first + i / 3].light[i % 3], out[i], sizeof out[i]);
        }
    }
}

static float mean_light(const colours *c)
{
    double sum = 0.0, area = 0.0;
    for (size_t i = 0; i < c->count; ++i) {
        const leaf *l = &c->leaf[i];
        const lmb_vec3 at[3] = {l->corner[0].at, l->corner[1].at, l->corner[2].at};
        const double own = (double)triangle_area(at);
        area += own;
        for (int k = 0; k < 9; ++k) {
            sum += own * (double)l->light[k / 3][k % 3] / 9.0;
        }
    }
    return area > 0.0 ? (float)(sum / area) : 0.0f;
}

/* Returns the difference between the light at the middle of each edge and the mean of both ends. */
static void bends_of(float bend[3], const leaf *l, float (*middle)[3])
{
    for (int k = 0; k < 3; ++k) {
        bend[k] = 0.0f;
        for (int i = 0; i < 3; ++i) {
            const float d = middle[k][i] - 0.5f * (l->light[k][i] + l->light[(k + 1) % 3][i]);
            bend[k] = maxf(bend[k], maxf(d, -d));
        }
    }
}

static int split(colours *c, size_t at, int k)
{
    leaf l = c->leaf[at], half = l;
    const int to = (k + 1) % 3;
    half.corner[k] = c->leaf[at].corner[to] = light_between(&l.corner[k], &l.corner[to]);
    return put_leaf(c, half.corner, half.face, half.id);
}

/* Light by direction depends on the pixel's normal, so it is not linear on curved surfaces: halves the edges where
 * it deviates most. */
static int refine(colours *c)
{
    const float enough = LINEAR * mean_light(c);
    size_t past = c->count;
    for (size_t first = 0; first < past; first += TOGETHER) {
        const size_t some = past - first < TOGETHER ? past - first : TOGETHER;
        light_place place[SOLVE_PLACES];
        float middle[SOLVE_PLACES][3], bend[3];
        for (size_t i = 0; i < 3 * some; ++i) {
            const leaf *l = &c->leaf[first + i / 3];
            const light_corner between = light_between(&l->corner[i % 3], &l->corner[(i + 1) % 3]);
            place[i] = place_in(l, &between);
        }
        light_at(middle, c->s, place, (int)(3 * some));
        for (size_t i = 0; i < some; ++i) {
            bends_of(bend, &c->leaf[first + i], middle + 3 * i);
            const int k = bend[0] >= bend[1] && bend[0] >= bend[2] ? 0 : bend[1] >= bend[2] ? 1 : 2;
            if (bend[k] > enough && !split(c, first + i, k)) {
                return 0;
            }
        }
    }
    light_leaves(c, 0);
    return 1;
}

static int by_id(const void *a, const void *b)
{
    const leaf *x = a, *y = b;
    return x->id != y->id ? (x->id < y->id ? -1 : 1) : (x->number < y->number ? -1 : 1);
}

/* --- triangles ---------------------------------------------------------------------------------------------------- */

/* Neighbours with finer subdivision have corners on the edges of this leaf. Splits the leaf there, so that no gaps
 * appear; the light stays linear. */
static int put_conform(colours *c, light_mesh *m, const leaf *l, float per, int depth)
{
    for (int k = 0; k < 3 && depth < CONFORM; ++k) {
        const int to = (k + 1) % 3;
        const light_corner middle = light_between(&l->corner[k], &l->corner[to]);
        if (is_same(middle.at, l->corner[k].at) || is_same(middle.at, l->corner[to].at) || !has_place(c, middle.at)) {
            continue;
        }
        leaf a = *l, b = *l;
        a.corner[to] = b.corner[k] = middle;
        for (int i = 0; i < 3; ++i) {
            a.light[to][i] = b.light[k][i] = 0.5f * (l->light[k][i] + l->light[to][i]);
        }
        return put_conform(c, m, &a, per, depth + 1) && put_conform(c, m, &b, per, depth + 1);
    }
    glb_vertex v[3];
    for (int k = 0; k < 3; ++k) {
        light_vertex_of(&v[k], &l->corner[k]);
        for (int i = 0; i < 3; ++i) {
            v[k].light[i] = (uint16_t)(minf(maxf(l->light[k][i], 0.0f) * per, 1.0f) * 65535.0f + 0.5f);
        }
    }
    return light_mesh_put(m, v, c->r);
}

static float brightest(const colours *c)
{
    float peak = 1e-20f;
    for (size_t i = 0; i < 9 * c->count; ++i) {
        peak = maxf(peak, c->leaf[i / 9].light[i / 3 % 3][i % 3]);
    }
    return peak;
}

static int put_meshes(colours *c, glb_mesh *mesh, uint32_t *count, float per)
{
    const lmb_scene *scene = &c->s->job.scene;
    size_t i = 0;
    for (uint32_t o = 0; o < scene->instance_count && i < c->count; ++o) {
        const lmb_instance *own = &scene->instances[o];
        const uint32_t past = own->first_id + scene->meshes[own->mesh].triangle_count;
        light_mesh m;
        if (c->leaf[i].id >= past) {
            continue;
        }
        int ok = light_mesh_begin(&m, scene, o, c->r);
        for (; ok && i < c->count && c->leaf[i].id < past; ++i) {
            ok = put_conform(c, &m, &c->leaf[i], per, 0);
        }
        light_mesh_end(&m);
        mesh[(*count)++] = m.mesh;
        if (!ok) {
            return 0;
        }
    }
    return 1;
}

int light_colours(const char *path, light_solve *s, const model *loaded, report *r)
{
    const lmb_scene *scene = &s->job.scene;
    colours c;
    uint32_t meshes = 0;
    memset(&c, 0, sizeof c);
    c.s = s;
    c.source = loaded->source;
    c.r = r;
    glb_mesh *mesh = calloc((size_t)scene->instance_count + 1, sizeof *mesh);
    int ok = mesh != NULL || report_fail(r, "not enough memory for %u objects", (unsigned)scene->instance_count);
    for (uint32_t id = 1; ok && id <= s->job.transfer.count[LMB_TRANSFER_SURFACES]; ++id) {
        ok = put_side(&c, id, 0) && put_side(&c, id, 1);
    }
    if (ok) {
        light_leaves(&c, 0);
    }
    for (int i = 0; ok && i < ROUNDS; ++i) {
        ok = refine(&c);
    }
    if (ok) {
        qsort(c.leaf, c.count, sizeof *c.leaf, by_id);
    }
    const float scale = ok ? brightest(&c) : 1.0f;
    const glb_light light = {"vertex-colours", scale, NULL};
    ok = ok && put_places(&c) && put_meshes(&c, mesh, &meshes, 1.0f / scale) &&
         glb_write(path, scene, loaded, mesh, meshes, &light, r);
    for (uint32_t i = 0; i < meshes; ++i) {
        free(mesh[i].vertex);
        free(mesh[i].index);
    }
    free(mesh);
    free(c.leaf);
    free(c.place);
    free(c.used);
    return ok;
}
