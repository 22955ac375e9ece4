/* relight_hidden.c: an object's self-occlusion, by rays, and its occlusion of the ground, by projection. */
#include "relight_hidden.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/progress.h"
#include "relight_samples.h"

static const float reach[HIDDEN_MAPS] = {2.5f, 0.25f}; /* of a figure's height: the width of the ground map around it */
#define LIFT 0.005f /* of a figure's height: offset from the surface, because facets of a smooth surface lie below it */
#define NEAR_M 0.5f

static void bounds_of(lmb_vec3 *low, lmb_vec3 *high, const figures *f, uint32_t figure)
{
    lmb_scene own = f->scene;
    own.instances = f->instances + figure * f->parts;
    own.instance_count = f->parts;
    lmb_scene_bounds(low, high, &own);
}

lmb_vec3 hidden_foot(const figures *f, uint32_t figure)
{
    lmb_vec3 low, high;
    bounds_of(&low, &high, f, figure);
    return (lmb_vec3){0.5f * (low.x + high.x), low.y, 0.5f * (low.z + high.z)};
}

/* --- vertices ----------------------------------------------------------------------------------------------------- */

static lmb_vec3 turned(const lmb_mat4 *m, lmb_vec3 p, float one)
{
    const float *a = m->m;
    return (lmb_vec3){a[0] * p.x + a[4] * p.y + a[8] * p.z + a[12] * one,
                      a[1] * p.x + a[5] * p.y + a[9] * p.z + a[13] * one,
                      a[2] * p.x + a[6] * p.y + a[10] * p.z + a[14] * one};
}

static lmb_vec3 unit_of(lmb_vec3 a)
{
    const float length = sqrtf(hidden_dot(a, a)), k = length > 0.0f ? 1.0f / length : 0.0f;
    return (lmb_vec3){a.x * k, a.y * k, a.z * k};
}

static lmb_vec3 position_of(const lmb_mesh *m, uint32_t vertex)
{
    if (m->position_format == LMB_POSITION_F32) {
        const float *p = (const float *)m->positions + 3 * (size_t)vertex;
        return (lmb_vec3){p[0], p[1], p[2]};
    }
    const int16_t *p = (const int16_t *)m->positions + 4 * (size_t)vertex;
    return (lmb_vec3){m->position_scale.x * p[0] + m->position_offset.x,
                      m->position_scale.y * p[1] + m->position_offset.y,
                      m->position_scale.z * p[2] + m->position_offset.z};
}

/* Splits a flat-shaded mesh into separate vertices per corner. */
static int take_mesh(hidden_part *out, const lmb_mesh *from)
{
    static const size_t position_bytes[] = {12, 8}, uv_bytes[] = {8, 4}, colour_bytes[] = {4, 8};
    out->mesh = *from;
    if (from->normals != NULL) {
        return 1;
    }
    const size_t n = 3 * (size_t)from->triangle_count,
                 size[4] = {position_bytes[from->position_format], from->uvs != NULL ? uv_bytes[from->uv_format] : 0,
                            from->tangents != NULL ? 4 : 0,
                            from->colours != NULL ? colour_bytes[from->colour_format] : 0};
    const void *source[4] = {from->positions, from->uvs, from->tangents, from->colours};
    uint8_t *to[4], *p = malloc(n * (size[0] + size[1] + size[2] + size[3]) + 1);
    if ((out->memory = p) == NULL) {
        return 0;
    }
    for (int k = 0; k < 4; p += n * size[k++]) {
        to[k] = p;
        for (size_t i = 0; i < n && size[k] > 0; ++i) {
            memcpy(p + size[k] * i, (const uint8_t *)source[k] + size[k] * hidden_vertex(from, (uint32_t)i), size[k]);
        }
    }
    out->mesh.positions = to[0];
    out->mesh.uvs = from->uvs != NULL ? to[1] : NULL;
    out->mesh.tangents = from->tangents != NULL ? (const int16_t *)(const void *)to[2] : NULL;
    out->mesh.colours = from->colours != NULL ? to[3] : NULL;
    out->mesh.indices = NULL;
    out->mesh.index_format = LMB_INDEX_NONE;
    out->mesh.vertex_count = (uint32_t)n;
    return 1;
}

static lmb_vec3 normal_of(const lmb_mesh *m, const lmb_mat4 *to_world, uint32_t vertex)
{
    if (m->normals != NULL) {
        return unit_of(turned(to_world, lmb_octahedral_decode(m->normals + 2 * (size_t)vertex), 0.0f));
    }
    const uint32_t first = vertex / 3 * 3;
    const lmb_vec3 o = turned(to_world, position_of(m, first), 1.0f),
                   s = turned(to_world, position_of(m, first + 1), 1.0f),
                   t = turned(to_world, position_of(m, first + 2), 1.0f);
    const lmb_vec3 u = {s.x - o.x, s.y - o.y, s.z - o.z}, v = {t.x - o.x, t.y - o.y, t.z - o.z};
    return unit_of((lmb_vec3){u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x});
}

static void set_vertices(hidden_part *p, const lmb_mat4 *to_world, float lift)
{
    for (uint32_t i = 0; i < p->mesh.vertex_count; ++i) {
        const lmb_vec3 at = turned(to_world, position_of(&p->mesh, i), 1.0f), n = normal_of(&p->mesh, to_world, i);
        p->normal[i] = n;
        p->at[i] = (lmb_vec3){at.x + lift * n.x, at.y + lift * n.y, at.z + lift * n.z};
    }
}

/* --- visibility --------------------------------------------------------------------------------------------------- */

void hidden_bound(lmb_traversal *t)
{
    const uint32_t coarse = t->coarse;
    memset(t, 0, sizeof *t);
    t->bounded = 1;
    t->left = LMB_TRAVERSAL_FIRST;
    t->coarse = coarse;
}

uint32_t hidden_coarse(const hidden *h)
{
    uint32_t sum = h->traversal.coarse;
    for (int i = 0; h->hand != NULL && i < h->threads; ++i) {
        sum += h->hand[i].traversal.coarse;
    }
    return sum;
}

/* Tests 64 samples in all directions. */
static void look_around(lmb_traversal *traversal, const hidden *h, hidden_part *p, const relight_options *o,
                        const float *directions, uint32_t first)
{
    lmb_tile t;
    float all[LMB_TILE_PIXELS] = {0}, open[LMB_TILE_PIXELS] = {0};
    const uint32_t left = p->samples - first, count = left < LMB_TILE_PIXELS ? left : LMB_TILE_PIXELS;
    memset(&t, 0, sizeof t);
    hidden_bound(traversal);
    for (uint32_t k = 0; k < count; ++k) {
        const lmb_vec3 at = p->at[hidden_sampled(p, first + k)];
        t.position[0][k] = at.x;
        t.position[1][k] = at.y;
        t.position[2][k] = at.z;
        t.id[k] = 1;
    }
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        const lmb_vec3 to = {directions[i], directions[LMB_PROBE_TEXELS + i], directions[2 * LMB_PROBE_TEXELS + i]};
        float cosine[LMB_TILE_PIXELS];
        uint64_t faces = 0;
        for (uint32_t k = 0; k < count; ++k) {
            cosine[k] = hidden_dot(p->normal[hidden_sampled(p, first + k)], to);
            faces |= (uint64_t)(cosine[k] > 0.0f) << k;
        }
        const uint64_t blocked =
            faces != 0 ? lmb_occluded_sun(o->kernels, traversal, &h->bvh, &t, faces, to) & faces : 0;
        p->blocked[first / LMB_TILE_PIXELS][i] = blocked;
        for (uint32_t k = 0; k < count; ++k) {
            all[k] += faces >> k & 1 ? cosine[k] : 0.0f;
            open[k] += (faces & ~blocked) >> k & 1 ? cosine[k] : 0.0f;
        }
    }
    for (uint32_t k = 0; k < count; ++k) {
        p->open[first + k] = all[k] > 0.0f ? open[k] / all[k] : 1.0f;
    }
}

/* Tiles of one part, for any thread. */
typedef struct looking {
    hidden *h;
    hidden_part *p;
    const relight_options *o;
    const float *directions;
} looking;

static void look_job(void *user, int tile, int thread)
{
    const looking *l = user;
    const uint32_t tiles = (l->p->samples + LMB_TILE_PIXELS - 1) / LMB_TILE_PIXELS;
    look_around(&l->h->hand[thread].traversal, l->h, l->p, l->o, l->directions, (uint32_t)tile * LMB_TILE_PIXELS);
    if (thread == 0) {
        progress_tell("contact: the object", (double)(tile + 1) / (double)tiles);
    }
}

static int look_part(hidden *h, hidden_part *p, const relight_options *o, const float *directions)
{
    const uint32_t tiles = (p->samples + LMB_TILE_PIXELS - 1) / LMB_TILE_PIXELS;
    looking l = {h, p, o, directions};
    p->open = malloc(((size_t)p->samples + 1) * sizeof *p->open);
    p->blocked = malloc(((size_t)tiles + 1) * sizeof *p->blocked);
    if (p->open == NULL || p->blocked == NULL) {
        return 0;
    }
    pool_run(h->threads, (int)tiles, look_job, &l);
    return 1;
}

/* --- once --------------------------------------------------------------------------------------------------------- */

static int take_part(hidden *h, hidden_part *p, const figures *f, const lmb_instance *in)
{
    if (!take_mesh(p, &f->loaded.scene.meshes[in->mesh])) {
        return 0;
    }
    const size_t n = (size_t)p->mesh.vertex_count + 1;
    p->at = malloc(n * sizeof *p->at);
    p->normal = malloc(n * sizeof *p->normal);
    if (p->at == NULL || p->normal == NULL) {
        return 0;
    }
    set_vertices(p, &in->to_world, h->lift);
    return 1;
}

/* The proxy casts the shadows, unless the object has alpha holes. */
static void choose_thrown(hidden *h)
{
    hidden_proxy *x = &h->proxy;
    int has_holes = 0;
    for (uint32_t i = 0; i < h->scene.material_count; ++i) {
        has_holes |= (h->scene.materials[i].flags & LMB_ALPHA_MASK) != 0;
    }
    h->thrown = h->scene;
    if (x->count == 0 || has_holes) {
        x->count = 0;
        return;
    }
    x->mesh.positions = x->corners;
    x->mesh.vertex_count = 3 * x->count;
    x->mesh.triangle_count = x->count;
    x->material.alpha = 1.0f;
    x->material.texture = -1;
    x->instance.first_id = 1;
    for (int i = 0; i < 4; ++i) {
        x->instance.to_world.m[5 * i] = 1.0f;
    }
    h->thrown.meshes = &x->mesh;
    h->thrown.materials = &x->material;
    h->thrown.instances = &x->instance;
    h->thrown.mesh_count = h->thrown.material_count = h->thrown.instance_count = 1;
}

static int take_hand(hidden_hand *hand, uint32_t instances)
{
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, HIDDEN_SIDE, HIDDEN_SIDE),
                 id = lmb_surface_bytes(LMB_ID32, HIDDEN_SIDE, HIDDEN_SIDE);
    hand->memory[0] = malloc(depth);
    hand->memory[1] = malloc(id);
    hand->sheared = malloc(((size_t)instances + 1) * sizeof *hand->sheared);
    return hand->memory[0] != NULL && hand->memory[1] != NULL && hand->sheared != NULL &&
           lmb_surface_init(&hand->depth, LMB_DEPTH32F, HIDDEN_SIDE, HIDDEN_SIDE, hand->memory[0], depth) == LMB_OK &&
           lmb_surface_init(&hand->id, LMB_ID32, HIDDEN_SIDE, HIDDEN_SIDE, hand->memory[1], id) == LMB_OK;
}

static int take_hands(hidden *h, int threads)
{
    h->threads = pool_threads(threads);
    h->hand = calloc((size_t)h->threads, sizeof *h->hand);
    int ok = h->hand != NULL;
    for (int i = 0; ok && i < h->threads; ++i) {
        ok = take_hand(&h->hand[i], h->parts);
    }
    return ok;
}

/* Takes the first figure, with the foot at 0, 0, 0. */
static int take_object(hidden *h, const figures *f)
{
    const lmb_vec3 foot = hidden_foot(f, 0);
    lmb_vec3 low, high;
    lmb_scene *own = &h->scene;
    *own = f->scene;
    h->instances = malloc(f->parts * sizeof *h->instances);
    h->part = calloc(f->parts, sizeof *h->part);
    if (h->instances == NULL || h->part == NULL) {
        return 0;
    }
    h->parts = f->parts;
    for (uint32_t i = 0; i < f->parts; ++i) {
        float *m = h->instances[i].to_world.m;
        h->instances[i] = f->instances[i];
        h->instances[i].mesh = f->loaded.scene.instances[i].mesh;
        m[12] -= foot.x;
        m[13] -= foot.y;
        m[14] -= foot.z;
    }
    own->meshes = f->loaded.scene.meshes;
    own->mesh_count = f->loaded.scene.mesh_count;
    own->instances = h->instances;
    own->instance_count = f->parts;
    lmb_scene_bounds(&low, &high, own);
    const lmb_vec3 half = {0.5f * (high.x - low.x), 0.5f * (high.y - low.y), 0.5f * (high.z - low.z)};
    h->middle = (lmb_vec3){low.x + half.x, low.y + half.y, low.z + half.z};
    h->radius = sqrtf(hidden_dot(half, half));
    h->lift = LIFT * f->scale * (f->high.y - f->low.y);
    const uint32_t triangles = lmb_scene_triangles(own);
    const size_t bytes = lmb_bvh_bytes(triangles);
    h->memory = malloc(bytes);
    return h->memory != NULL && lmb_bvh_init(&h->bvh, triangles, h->memory, bytes) == LMB_OK &&
           lmb_bvh_build(&h->bvh, own) == LMB_OK;
}

int hidden_make(hidden *h, const figures *f, const relight_options *o, const float *directions)
{
    if (h->part != NULL) {
        return 1;
    }
    int ok = take_object(h, f) && take_hands(h, o->threads);
    for (uint32_t i = 0; ok && i < h->parts; ++i) {
        ok = take_part(h, &h->part[i], f, &h->instances[i]);
    }
    ok = ok && samples_take(h);
    for (uint32_t i = 0; ok && i < h->parts; ++i) {
        ok = look_part(h, &h->part[i], o, directions);
    }
    if (ok) {
        choose_thrown(h);
    }
    return ok;
}

/* --- the ground --------------------------------------------------------------------------------------------------- */

static int add_run(hidden_runs *r, hidden_run run)
{
    if (r->count == r->cap) {
        const uint32_t cap = r->cap > 0 ? 2 * r->cap : 4096;
        hidden_run *more = realloc(r->run, cap * sizeof *more);
        if (more == NULL) {
            return 0;
        }
        r->run = more;
        r->cap = cap;
    }
    r->run[r->count++] = run;
    return 1;
}

/* A view from below, so that the lowest surface is in front. The texels of a ray are offset by a quarter each way. */
static void look_up(lmb_view *v, const hidden_map *m, float height, int ray)
{
    memset(v, 0, sizeof *v);
    v->eye = (lmb_vec3){m->corner_x + 0.5f * m->wide + (ray & 1 ? 0.25f : -0.25f) * m->wide / HIDDEN_SIDE,
                        -height - NEAR_M,
                        m->corner_z + 0.5f * m->deep + (ray & 2 ? 0.25f : -0.25f) * m->deep / HIDDEN_SIDE};
    v->right.x = v->up.z = 1.0f;
    v->back.y = -1.0f;
    v->half_width = 0.5f * m->wide;
    v->half_height = 0.5f * m->deep;
    v->kind = LMB_ORTHOGRAPHIC;
    v->near_m = NEAR_M;
    v->far_m = m->wide + m->deep + 2.0f;
    v->frame_width = v->frame_height = HIDDEN_SIDE;
}

/* Projects the object onto the ground along a light by a shear. */
static void shear(lmb_instance *sheared, const hidden *h, lmb_vec3 to)
{
    uint32_t id = 1;
    for (uint32_t i = 0; i < h->thrown.instance_count; ++i) {
        float *m = sheared[i].to_world.m;
        sheared[i] = h->thrown.instances[i];
        sheared[i].first_id = id;
        id += h->thrown.meshes[sheared[i].mesh].triangle_count;
        for (int column = 0; column < 4; ++column) {
            const float height = m[4 * column + 1] + (column == 3 ? h->height : 0.0f);
            m[4 * column] -= height * (to.x / to.y);
            m[4 * column + 2] -= height * (to.z / to.y);
        }
    }
}

/* Reads a row of ids as regions; -1: open. */
static int take_row(int16_t region[HIDDEN_SIDE], const hidden *h, const hidden_hand *hand, int32_t y)
{
    const uint32_t *ids = (const uint32_t *)hand->id.data + y / LMB_TILE * (HIDDEN_SIDE / LMB_TILE) * LMB_TILE_PIXELS +
                          y % LMB_TILE * LMB_TILE;
    uint32_t any = 0;
    for (int32_t x = 0; x < HIDDEN_SIDE; ++x) {
        const uint32_t id = ids[x / LMB_TILE * LMB_TILE_PIXELS + x % LMB_TILE];
        any |= id;
        region[x] = id != 0 ? (int16_t)h->region_of[id - 1] : -1;
    }
    return any != 0;
}

/* Rows of the surface start at the far side, because the view is from below. */
static int add_rows(const hidden *h, const hidden_hand *hand, hidden_runs *runs)
{
    int16_t region[HIDDEN_SIDE];
    for (int32_t y = 0; y < HIDDEN_SIDE; ++y) {
        const int has_any = take_row(region, h, hand, y);
        for (int32_t x = 0, from = 0; has_any && x < HIDDEN_SIDE; ++x) {
            const int ends = x + 1 == HIDDEN_SIDE || region[x + 1] != region[x];
            if (ends && region[x] >= 0 &&
                !add_run(runs,
                         (hidden_run){(uint8_t)(HIDDEN_SIDE - 1 - y), (uint8_t)from, (uint8_t)x, (uint8_t)region[x]})) {
                return 0;
            }
            from = ends ? x + 1 : from;
        }
    }
    return 1;
}

static int throw_shadow(hidden_hand *hand, const hidden *h, int map, hidden_runs *runs, const relight_options *o,
                        lmb_vec3 to, int ray)
{
    lmb_scene own = h->thrown;
    lmb_view v;
    lmb_target target;
    memset(&target, 0, sizeof target);
    target.depth = hand->depth;
    target.id = hand->id;
    look_up(&v, &h->map[map], h->height, ray);
    shear(hand->sheared, h, to);
    own.instances = hand->sheared;
    lmb_surface_clear(&hand->depth);
    lmb_surface_clear(&hand->id);
    return lmb_draw(&target, o->kernels, &v, &own, 1, lmb_scene_triangles(&own), 0, NULL) == LMB_OK &&
           add_rows(h, hand, runs);
}

int hidden_shadow(hidden *h, int map, hidden_runs *runs, const relight_options *o, lmb_vec3 to, int ray)
{
    return throw_shadow(&h->hand[0], h, map, runs, o, to, ray);
}

/* A ray in one quarter of a direction's texel of the reduced cube: probe.h. */
static lmb_vec3 ray_of(int32_t i, int ray)
{
    enum { N = LMB_PROBE_SIDE };
    const float s = (2.0f * (float)(i % N) + (ray & 1 ? 1.5f : 0.5f)) / N - 1.0f,
                t = (2.0f * (float)(i / N % N) + (ray & 2 ? 1.5f : 0.5f)) / N - 1.0f;
    const lmb_vec3 to[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
    return unit_of(to[i / (N * N)]);
}

/* A map's shadows, drawn by any thread, and the position of each one's runs. */
typedef struct filling {
    hidden *h;
    const relight_options *o;
    int map;
    struct {
        uint32_t first, count;
        int thread;
    } of[LMB_PROBE_TEXELS * HIDDEN_RAYS];
} filling;

static void fill_job(void *user, int i, int thread)
{
    filling *f = user;
    hidden_hand *hand = &f->h->hand[thread];
    const lmb_vec3 to = ray_of(i / HIDDEN_RAYS, i % HIDDEN_RAYS);
    const int is_cast = f->map == 0 || i % HIDDEN_RAYS % (HIDDEN_RAYS - 1) == 0; /* close map: two of them, diagonal */
    f->of[i].thread = thread;
    f->of[i].first = hand->runs.count;
    if (is_cast && to.y >= HIDDEN_LOWEST && !hand->failed) {
        hand->failed = !throw_shadow(hand, f->h, f->map, &hand->runs, f->o, to, i % HIDDEN_RAYS);
    }
    f->of[i].count = hand->runs.count - f->of[i].first;
    if (thread == 0) {
        progress_tell("contact: the ground", (f->map + (double)i / (LMB_PROBE_TEXELS * HIDDEN_RAYS)) / HIDDEN_MAPS);
    }
}

/* Joins the threads' runs in the order of the rays. */
static int join_runs(hidden_map *m, const filling *f)
{
    uint32_t all = 0;
    for (int i = 0; i < LMB_PROBE_TEXELS * HIDDEN_RAYS; ++i) {
        m->first[i] = all;
        all += f->of[i].count;
    }
    m->first[LMB_PROBE_TEXELS * HIDDEN_RAYS] = all;
    if (m->runs.cap < all) {
        free(m->runs.run);
        m->runs.cap = 0;
        if ((m->runs.run = malloc((size_t)all * sizeof *m->runs.run)) == NULL) {
            return 0;
        }
        m->runs.cap = all;
    }
    m->runs.count = all;
    for (int i = 0; i < LMB_PROBE_TEXELS * HIDDEN_RAYS; ++i) {
        const hidden_run *from = f->h->hand[f->of[i].thread].runs.run;
        if (f->of[i].count > 0) {
            memcpy(m->runs.run + m->first[i], from + f->of[i].first, f->of[i].count * sizeof *from);
        }
    }
    return 1;
}

static int fill_map(hidden *h, int map, const relight_options *o)
{
    filling *f = calloc(1, sizeof *f);
    int ok = f != NULL;
    if (ok) {
        f->h = h;
        f->o = o;
        f->map = map;
        for (int i = 0; i < h->threads; ++i) {
            h->hand[i].runs.count = 0;
        }
        pool_run(h->threads, LMB_PROBE_TEXELS * HIDDEN_RAYS, fill_job, f);
        ok = join_runs(&h->map[map], f);
    }
    for (int i = 0; i < h->threads; ++i) {
        ok = ok && !h->hand[i].failed;
    }
    free(f);
    return ok;
}

int hidden_ground(hidden *h, const figures *f, const relight_options *o, float height)
{
    lmb_vec3 low, high;
    if (h->has_ground && h->height == height) {
        return 1;
    }
    bounds_of(&low, &high, f, 0);
    h->height = height;
    for (int i = 0; i < HIDDEN_MAPS; ++i) {
        hidden_map *m = &h->map[i];
        const float around = reach[i] * fmaxf(high.y - low.y + height, 0.01f);
        m->wide = high.x - low.x + 2.0f * around;
        m->deep = high.z - low.z + 2.0f * around;
        m->corner_x = -0.5f * m->wide;
        m->corner_z = -0.5f * m->deep;
        m->fades = i == 0;
        if (!fill_map(h, i, o)) {
            return 0;
        }
    }
    h->has_ground = 1;
    return 1;
}

void hidden_free(hidden *h)
{
    for (uint32_t i = 0; h->part != NULL && i < h->parts; ++i) {
        free(h->part[i].memory);
        free(h->part[i].at);
        free(h->part[i].normal);
        free(h->part[i].vertex_of);
        free(h->part[i].share);
        free(h->part[i].open);
        free(h->part[i].blocked);
    }
    free(h->part);
    for (int i = 0; i < HIDDEN_MAPS; ++i) {
        free(h->map[i].runs.run);
    }
    for (int i = 0; h->hand != NULL && i < h->threads; ++i) {
        free(h->hand[i].memory[0]);
        free(h->hand[i].memory[1]);
        free(h->hand[i].sheared);
        free(h->hand[i].runs.run);
    }
    free(h->hand);
    free(h->proxy.key);
    free(h->proxy.corners);
    free(h->proxy.source);
    free(h->proxy.region);
    free(h->instances);
    free(h->memory);
}
