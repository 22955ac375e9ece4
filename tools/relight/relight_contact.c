/* relight_contact.c: the ground's light that objects take, by their projections along the world's lights; and by vertex the
 * light that reaches it, by rays. */
#include "relight_contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define REACH 2.5f /* of a figure's height: how far around it the ground is looked at */
#define LOWEST 0.05f /* sine of the height from which on light throws shadows on the ground */
#define ROUND 0.8f /* what blocks is itself in the shade: of the light that it would reflect in the open */
#define BELOW 0.6f /* the same of what hangs over the ground */
#define LIFT 0.005f /* of a figure's height */
#define PI 3.14159265f

enum { LIGHTS = LMB_PROBE_TEXELS + LMB_PROBE_PEAKS };

/* The world's light at a place from one direction: W/m2 across it; and what blocks it reflects in its place,
 * to a vertex and to the ground. */
typedef struct far_light {
    lmb_vec3 to;
    float rgb[3], blocked[3], under[3];
} far_light;

typedef struct far_lights {
    far_light light[LIGHTS];
    int32_t count;
} far_lights;

/* Where one figure's work is done. */
typedef struct bench {
    far_lights lights;
    float reflects[3], under[3]; /* radiance of what blocks a vertex; and the ground */
    float lift; /* m: off its surface, as a smooth one's facets lie below it */
    lmb_bvh bvh;
    lmb_tile tile;
    lmb_traversal traversal;
    lmb_surface depth;
    float codes[CONTACT_SIDE * CONTACT_SIDE];
    lmb_instance *sheared;
} bench;

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* --- light -------------------------------------------------------------------------------------------------------- */

static void add_light(bench *b, lmb_vec3 to, const float rgb[3], float solid_angle)
{
    far_light *l = &b->lights.light[b->lights.count++];
    l->to = to;
    for (int c = 0; c < 3; ++c) {
        l->rgb[c] = fmaxf(rgb[c], 0.0f);
        l->blocked[c] = b->reflects[c] * solid_angle;
        l->under[c] = b->under[c] * solid_angle;
    }
}

/* The mean albedo over pi times the mean irradiance, a quarter of all light; of what hangs over the ground, times what
 * comes from below. */
static void set_reflected(bench *b, const figures *f, const lmb_probe_lights *l, const float *down)
{
    for (int c = 0; c < 3; ++c) {
        float all = 0.0f, below = 0.0f, albedo = 0.0f;
        for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
            all += l->rgbw[c][i];
            below += l->rgbw[c][i] * fmaxf(-down[i], 0.0f);
        }
        for (int32_t i = 0; i < l->peaks; ++i) {
            all += l->peak[3 + c][i];
        }
        for (uint32_t i = 0; i < f->parts; ++i) {
            albedo += f->materials[f->scene.instances[i].material].albedo[c] / (float)f->parts;
        }
        b->reflects[c] = albedo * ROUND * 0.25f * all / PI;
        b->under[c] = albedo * BELOW * below / PI;
    }
}

static int take_light(bench *b, const figures *f, uint32_t figure, relight_light *w, const relight_options *o)
{
    const float *at = w->table[0].light;
    const lmb_probe_lights *l = &w->lights;
    const lmb_vec3 place = figures_middle(f, figure * figures_owners_each(f));
    if (!relight_light_see(w, o, place) ||
        lmb_probe_reduce(&w->lights, o->kernels, w->map, &w->table[0]) != LMB_OK) {
        return 0;
    }
    b->lights.count = 0;
    set_reflected(b, f, l, at + LMB_PROBE_TEXELS);
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        const float rgb[3] = {l->rgbw[0][i], l->rgbw[1][i], l->rgbw[2][i]};
        add_light(b, (lmb_vec3){at[i], at[LMB_PROBE_TEXELS + i], at[2 * LMB_PROBE_TEXELS + i]}, rgb, l->rgbw[3][i]);
    }
    for (int32_t i = 0; i < l->peaks; ++i) {
        const float rgb[3] = {l->peak[3][i], l->peak[4][i], l->peak[5][i]};
        add_light(b, (lmb_vec3){l->peak[0][i], l->peak[1][i], l->peak[2][i]}, rgb, 0.0f);
    }
    return 1;
}

/* --- the ground --------------------------------------------------------------------------------------------------- */

static void look_down(lmb_view *v, contact_ground *g, const figures *f, uint32_t figure, float y)
{
    lmb_scene own = f->scene;
    lmb_vec3 low, high;
    own.instances = f->instances + figure * f->parts;
    own.instance_count = f->parts;
    lmb_scene_bounds(&low, &high, &own);
    const float around = REACH * fmaxf(high.y - y, 0.01f), width = high.x - low.x + 2.0f * around,
                depth = high.z - low.z + 2.0f * around;
    g->x = low.x - around;
    g->z = low.z - around;
    g->per_x = (float)CONTACT_SIDE / width;
    g->per_z = (float)CONTACT_SIDE / depth;
    memset(v, 0, sizeof *v);
    v->eye = (lmb_vec3){g->x + 0.5f * width, high.y + 1.0f, g->z + 0.5f * depth};
    v->right.x = v->back.y = 1.0f;
    v->up.z = -1.0f;
    v->half_width = 0.5f * width;
    v->half_height = 0.5f * depth;
    v->kind = LMB_ORTHOGRAPHIC;
    v->near_m = 0.5f;
    v->far_m = high.y - y + 2.0f;
    v->frame_width = v->frame_height = CONTACT_SIDE;
}

/* A figure projected onto the ground along a light: moved sideways by height. */
static int draw_shadow(bench *b, const lmb_view *v, const figures *f, uint32_t figure, const relight_options *o,
                       lmb_vec3 to, float y)
{
    lmb_scene own = f->scene;
    lmb_target target;
    uint32_t id = 1;
    memset(&target, 0, sizeof target);
    target.depth = b->depth;
    for (uint32_t i = 0; i < f->parts; ++i) {
        float *m = b->sheared[i].to_world.m;
        b->sheared[i] = f->instances[figure * f->parts + i];
        b->sheared[i].first_id = id;
        id += f->scene.meshes[b->sheared[i].mesh].triangle_count;
        for (int column = 0; column < 4; ++column) {
            const float height = m[4 * column + 1] - (column == 3 ? y : 0.0f);
            m[4 * column] -= height * (to.x / to.y);
            m[4 * column + 2] -= height * (to.z / to.y);
        }
    }
    own.instances = b->sheared;
    own.instance_count = f->parts;
    lmb_surface_clear(&b->depth);
    return lmb_draw(&target, o->kernels, v, &own, 1, id - 1, 0, NULL) == LMB_OK &&
           lmb_depth_linearize(b->codes, sizeof b->codes, &b->depth) == LMB_OK;
}

static int shade_ground(contact_ground *g, bench *b, const figures *f, uint32_t figure, const relight_options *o,
                        float y)
{
    lmb_view v;
    float all[3] = {1e-30f, 1e-30f, 1e-30f};
    look_down(&v, g, f, figure, y);
    memset(g->left, 0, sizeof g->left);
    for (int32_t i = 0; i < b->lights.count; ++i) {
        const far_light *l = &b->lights.light[i];
        if (l->to.y < LOWEST) {
            continue;
        }
        if (!draw_shadow(b, &v, f, figure, o, l->to, y)) {
            return 0;
        }
        for (int c = 0; c < 3; ++c) {
            const float lost = (l->rgb[c] - l->under[c]) * l->to.y;
            all[c] += l->rgb[c] * l->to.y;
            for (int32_t k = 0; k < CONTACT_SIDE * CONTACT_SIDE; ++k) {
                g->left[k][c] += b->codes[k] > 0.0f ? lost : 0.0f;
            }
        }
    }
    for (int32_t k = 0; k < CONTACT_SIDE * CONTACT_SIDE; ++k) {
        for (int c = 0; c < 3; ++c) {
            g->left[k][c] = fminf(fmaxf(1.0f - g->left[k][c] / all[c], 0.0f), 1.0f);
        }
    }
    return 1;
}

/* What is left at a place of the ground, by all figures: bilinear, 1 beside the maps. */
static void ground_left(float out[3], const contact *c, float x, float z)
{
    out[0] = out[1] = out[2] = 1.0f;
    for (uint32_t i = 0; c->grounds != NULL && i < c->figures; ++i) {
        const contact_ground *g = &c->grounds[i];
        const float u = (x - g->x) * g->per_x - 0.5f, v = (z - g->z) * g->per_z - 0.5f;
        if (!(u >= 0.0f && v >= 0.0f && u < (float)(CONTACT_SIDE - 1) && v < (float)(CONTACT_SIDE - 1))) {
            continue;
        }
        const int32_t ix = (int32_t)u, iz = (int32_t)v;
        const float fx = u - (float)ix, fz = v - (float)iz;
        const float (*p)[3] = &g->left[iz * CONTACT_SIDE + ix];
        for (int k = 0; k < 3; ++k) {
            const float near = p[0][k] + fx * (p[1][k] - p[0][k]),
                        far = p[CONTACT_SIDE][k] + fx * (p[CONTACT_SIDE + 1][k] - p[CONTACT_SIDE][k]);
            out[k] *= near + fz * (far - near);
        }
    }
}

/* --- vertices ----------------------------------------------------------------------------------------------------- */

static uint32_t vertex_of(const lmb_mesh *m, uint32_t corner)
{
    return m->index_format == LMB_INDEX_NONE  ? corner
           : m->index_format == LMB_INDEX_U16 ? ((const uint16_t *)m->indices)[corner]
                                              : ((const uint32_t *)m->indices)[corner];
}

static lmb_vec3 turned(const lmb_mat4 *m, lmb_vec3 p, float one)
{
    const float *a = m->m;
    return (lmb_vec3){a[0] * p.x + a[4] * p.y + a[8] * p.z + a[12] * one,
                      a[1] * p.x + a[5] * p.y + a[9] * p.z + a[13] * one,
                      a[2] * p.x + a[6] * p.y + a[10] * p.z + a[14] * one};
}

static lmb_vec3 unit_of(lmb_vec3 a)
{
    const float length = sqrtf(dot(a, a)), k = length > 0.0f ? 1.0f / length : 0.0f;
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

/* Flat surfaces meet at vertices with other light: their corners become vertices of their own. */
static int take_mesh(lmb_mesh *out, void **memory, const lmb_mesh *from)
{
    static const size_t position_bytes[] = {12, 8}, uv_bytes[] = {8, 4};
    const int is_flat = from->normals == NULL;
    const size_t n = is_flat ? 3 * (size_t)from->triangle_count : from->vertex_count;
    const size_t a = position_bytes[from->position_format], b = from->uvs != NULL ? uv_bytes[from->uv_format] : 0,
                 c = from->tangents != NULL ? 4 : 0;
    uint8_t *p = malloc(n * (4 + (is_flat ? a + b + c : 0)) + 1), *to[3];
    if (p == NULL) {
        return 0;
    }
    *memory = p;
    *out = *from;
    out->colours = p;
    to[0] = p + 4 * n;
    to[1] = to[0] + n * b;
    to[2] = to[1] + n * c;
    for (size_t i = 0; i < n; ++i) {
        const size_t v = is_flat ? vertex_of(from, (uint32_t)i) : i;
        memset(p + 4 * i, 255, 4);
        if (from->colours != NULL) {
            memcpy(p + 4 * i, from->colours + 4 * v, 4);
        }
        if (is_flat) {
            if (b > 0) {
                memcpy(to[0] + b * i, (const uint8_t *)from->uvs + b * v, b);
            }
            if (c > 0) {
                memcpy(to[1] + c * i, (const uint8_t *)from->tangents + c * v, c);
            }
            memcpy(to[2] + a * i, (const uint8_t *)from->positions + a * v, a);
        }
    }
    if (is_flat) {
        out->positions = to[2];
        out->uvs = from->uvs != NULL ? to[0] : NULL;
        out->tangents = from->tangents != NULL ? (const int16_t *)(const void *)to[1] : NULL;
        out->indices = NULL;
        out->index_format = LMB_INDEX_NONE;
        out->vertex_count = (uint32_t)n;
    }
    return 1;
}

static void put_vertex(bench *b, int k, const lmb_mesh *m, const lmb_mat4 *to_world, uint32_t vertex)
{
    const lmb_vec3 p = turned(to_world, position_of(m, vertex), 1.0f);
    lmb_vec3 n;
    if (m->normals != NULL) {
        n = turned(to_world, lmb_octahedral_decode(m->normals + 2 * (size_t)vertex), 0.0f);
    } else {
        const uint32_t first = vertex / 3 * 3;
        const lmb_vec3 o = turned(to_world, position_of(m, first), 1.0f),
                       s = turned(to_world, position_of(m, first + 1), 1.0f),
                       t = turned(to_world, position_of(m, first + 2), 1.0f);
        const lmb_vec3 u = {s.x - o.x, s.y - o.y, s.z - o.z}, v = {t.x - o.x, t.y - o.y, t.z - o.z};
        n = (lmb_vec3){u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    }
    n = unit_of(n);
    b->tile.position[0][k] = p.x + b->lift * n.x;
    b->tile.position[1][k] = p.y + b->lift * n.y;
    b->tile.position[2][k] = p.z + b->lift * n.z;
    b->tile.normal[0][k] = n.x;
    b->tile.normal[1][k] = n.y;
    b->tile.normal[2][k] = n.z;
    b->tile.id[k] = 1;
}

/* What a place gets of a light that is not blocked: from below it is the ground's, where that is dark. */
static void add_open(float sum[3], const contact *c, const far_light *l, const lmb_tile *t, int k, float cosine)
{
    float left[3] = {1.0f, 1.0f, 1.0f};
    if (l->to.y < -LOWEST && c->grounds != NULL) {
        const float far = (c->ground_y - t->position[1][k]) / l->to.y;
        ground_left(left, c, t->position[0][k] + far * l->to.x, t->position[2][k] + far * l->to.z);
    }
    for (int i = 0; i < 3; ++i) {
        sum[i] += cosine * l->rgb[i] * left[i];
    }
}

/* `count` vertices from `first` on, at most a tile's pixels. */
static void shade_vertices(uint8_t *colours, bench *b, const contact *c, const relight_options *o, const lmb_mesh *m,
                           const lmb_mat4 *to_world, uint32_t first, uint32_t count)
{
    float all[LMB_TILE_PIXELS][3] = {{0}}, left[LMB_TILE_PIXELS][3] = {{0}};
    for (uint32_t k = 0; k < count; ++k) {
        put_vertex(b, (int)k, m, to_world, first + k);
    }
    for (int32_t i = 0; i < b->lights.count; ++i) {
        const far_light *l = &b->lights.light[i];
        float cosine[LMB_TILE_PIXELS];
        uint64_t faces = 0;
        for (uint32_t k = 0; k < count; ++k) {
            cosine[k] = b->tile.normal[0][k] * l->to.x + b->tile.normal[1][k] * l->to.y + b->tile.normal[2][k] * l->to.z;
            faces |= (uint64_t)(cosine[k] > 0.0f) << k;
        }
        const uint64_t blocked =
            faces != 0 ? lmb_occluded_sun(&b->bvh, o->kernels, &b->tile, faces, l->to, &b->traversal) : 0;
        for (uint32_t k = 0; k < count; ++k) {
            if (!(faces >> k & 1)) {
                continue;
            }
            for (int h = 0; h < 3; ++h) {
                all[k][h] += cosine[k] * l->rgb[h];
                left[k][h] += blocked >> k & 1 ? cosine[k] * l->blocked[h] : 0.0f;
            }
            if (!(blocked >> k & 1)) {
                add_open(left[k], c, l, &b->tile, (int)k, cosine[k]);
            }
        }
    }
    for (uint32_t k = 0; k < count; ++k) {
        for (int h = 0; h < 3; ++h) {
            uint8_t *code = &colours[4 * (size_t)(first + k) + (size_t)h];
            const float share = all[k][h] > 0.0f ? fminf(left[k][h] / all[k][h], 1.0f) : 1.0f;
            *code = (uint8_t)((float)*code * share + 0.5f);
        }
    }
}

static void shade_mesh(lmb_mesh *m, void *memory, bench *b, const contact *c, const relight_options *o,
                       const lmb_mat4 *to_world)
{
    for (uint32_t first = 0; first < m->vertex_count; first += LMB_TILE_PIXELS) {
        const uint32_t left = m->vertex_count - first;
        shade_vertices(memory, b, c, o, m, to_world, first, left < LMB_TILE_PIXELS ? left : LMB_TILE_PIXELS);
    }
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

static void drop_meshes(contact *c)
{
    for (uint32_t i = 0; c->memory != NULL && i < c->instances; ++i) {
        free(c->memory[i]);
        c->memory[i] = NULL;
    }
}

static int take_contact(contact *c, const figures *f, const relight_options *o)
{
    c->figures = f->count;
    c->instances = f->count * f->parts;
    c->ground_y = o->place.ground_y;
    if (c->meshes == NULL) {
        c->meshes = malloc(c->instances * sizeof *c->meshes);
        c->memory = calloc(c->instances, sizeof *c->memory);
        c->grounds = o->place.ground != NULL ? malloc(c->figures * sizeof *c->grounds) : NULL;
    }
    return c->meshes != NULL && c->memory != NULL && (c->grounds != NULL || o->place.ground == NULL);
}

static int work(contact *c, bench *b, figures *f, relight_light *w, const relight_options *o)
{
    for (uint32_t i = 0; c->grounds != NULL && i < c->figures; ++i) {
        if (!take_light(b, f, i, w, o) || !shade_ground(&c->grounds[i], b, f, i, o, c->ground_y)) {
            return 0;
        }
    }
    for (uint32_t i = 0; i < c->instances; ++i) {
        if ((i % f->parts == 0 && !take_light(b, f, i / f->parts, w, o)) ||
            !take_mesh(&c->meshes[i], &c->memory[i], &f->loaded.scene.meshes[f->loaded.scene.instances[i % f->parts].mesh])) {
            return 0;
        }
        b->lift = LIFT * f->scale * (f->high.y - f->low.y);
        shade_mesh(&c->meshes[i], c->memory[i], b, c, o, &f->instances[i].to_world);
    }
    return 1;
}

/* The figures' scene as the file has it. */
static void show_plain(figures *f)
{
    for (uint32_t i = 0; i < f->count * f->parts; ++i) {
        f->instances[i].mesh = f->loaded.scene.instances[i % f->parts].mesh;
    }
    f->scene.meshes = f->loaded.scene.meshes;
    f->scene.mesh_count = f->loaded.scene.mesh_count;
}

static void show_darkened(figures *f, contact *c)
{
    for (uint32_t i = 0; i < c->instances; ++i) {
        f->instances[i].mesh = i;
        ++f->instances[i].revision;
    }
    f->scene.meshes = c->meshes;
    f->scene.mesh_count = c->instances;
}

int contact_make(contact *c, figures *f, relight_light *w, const relight_options *o, report *r)
{
    const uint32_t triangles = lmb_scene_triangles(&f->scene);
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, CONTACT_SIDE, CONTACT_SIDE), tree = lmb_bvh_bytes(triangles);
    bench *b = calloc(1, sizeof *b);
    void *depth_memory = malloc(depth), *tree_memory = malloc(tree);
    show_plain(f);
    drop_meshes(c);
    int ok = b != NULL && depth_memory != NULL && tree_memory != NULL && take_contact(c, f, o);
    if (ok) {
        b->sheared = malloc(f->parts * sizeof *b->sheared);
        ok = b->sheared != NULL &&
             lmb_surface_init(&b->depth, LMB_DEPTH32F, CONTACT_SIDE, CONTACT_SIDE, depth_memory, depth) == LMB_OK &&
             lmb_bvh_init(&b->bvh, triangles, tree_memory, tree) == LMB_OK && lmb_bvh_build(&b->bvh, &f->scene) == LMB_OK &&
             work(c, b, f, w, o);
        free(b->sheared);
    }
    free(b);
    free(depth_memory);
    free(tree_memory);
    if (ok) {
        show_darkened(f, c);
    }
    return ok || report_fail(r, "--contact: %s: out of memory", o->object);
}

/* The ray through a pixel's sample meets the ground in front of the eye? */
static int ground_at(float out[2], const lmb_view *v, int32_t x, int32_t y, float ground_y)
{
    const float across = 2.0f * ((float)x + 0.5f + (float)v->sample_x * (1.0f / 256.0f)) / (float)v->frame_width - 1.0f,
                up = 1.0f - 2.0f * ((float)y + 0.5f + (float)v->sample_y * (1.0f / 256.0f)) / (float)v->frame_height;
    const float a = across * v->half_width, b = up * v->half_height;
    const int is_far = v->kind == LMB_ORTHOGRAPHIC;
    const lmb_vec3 side = {a * v->right.x + b * v->up.x, a * v->right.y + b * v->up.y, a * v->right.z + b * v->up.z};
    const lmb_vec3 from = is_far ? (lmb_vec3){v->eye.x + side.x, v->eye.y + side.y, v->eye.z + side.z} : v->eye;
    const lmb_vec3 along = is_far ? (lmb_vec3){-v->back.x, -v->back.y, -v->back.z}
                                  : (lmb_vec3){side.x - v->back.x, side.y - v->back.y, side.z - v->back.z};
    const float far = (ground_y - from.y) / along.y;
    out[0] = from.x + far * along.x;
    out[1] = from.z + far * along.z;
    return along.y < 0.0f && far > 0.0f;
}

void contact_darken(image *inout, const contact *c, const lmb_view *view, const lmb_surface *id)
{
    const int32_t tiles = (id->width + LMB_TILE - 1) / LMB_TILE;
    for (int32_t i = 0; c->grounds != NULL && i < inout->width * inout->height; ++i) {
        const int32_t x = i % inout->width, y = i / inout->width;
        const uint32_t *tile = (const uint32_t *)id->data + (size_t)(y / LMB_TILE * tiles + x / LMB_TILE) * LMB_TILE_PIXELS;
        float place[2], left[3];
        if (tile[y % LMB_TILE * LMB_TILE + x % LMB_TILE] == 0 && ground_at(place, view, x, y, c->ground_y)) {
            ground_left(left, c, place[0], place[1]);
            for (int k = 0; k < 3; ++k) {
                inout->pixels[3 * (size_t)i + (size_t)k] *= left[k];
            }
        }
    }
}

void contact_free(contact *c)
{
    drop_meshes(c);
    free(c->memory);
    free(c->meshes);
    free(c->grounds);
}
