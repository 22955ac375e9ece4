/* fuzz_api.c: the library itself: scenes, lights, views and frames from bytes, with valid types but arbitrary numbers.
 * Memory has exactly the size from the *_bytes functions, so that a sanitizer finds an overrun of one byte.
 *
 * A frame ends in a finite number of steps, and no pixel is NaN. */
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "fuzz.h"

enum { TRIANGLES = 12, MESHES = 2, SIDE = 24, TEXELS = 8 * 8, MAP_MAX = 32 };
enum { HEAD = 128 /* bytes that choose the settings */ };

/* After the end, random bytes follow, so that short inputs have an effect too. */
typedef struct bytes {
    const uint8_t *at, *end;
    uint32_t more;
} bytes;

static uint32_t take_one(bytes *b)
{
    if (b->at < b->end) {
        return *b->at++;
    }
    b->more = b->more * 1664525u + 1013904223u;
    return b->more >> 24;
}

static uint32_t take(bytes *b, int count)
{
    uint32_t v = 0;
    for (int i = 0; i < count; ++i) {
        v = v << 8 | take_one(b);
    }
    return v;
}

static uint32_t below(bytes *b, uint32_t max) { return take(b, 1) % max; }

/* Mostly numbers of ordinary scenes; sometimes any 32 bits, or a known difficult number. */
static float number(bytes *b)
{
    static const float odd[] = {0.0f,  -0.0f, 1.0f,       -1.0f,       1e-30f, 1e-40f,
                                1e30f, 3e38f, 1048575.0f, -1048576.0f, 0.5f,   1e-6f};
    const uint32_t kind = take(b, 1);
    float v;
    if (kind < 8) {
        const uint32_t bits = take(b, 4);
        memcpy(&v, &bits, sizeof v);
        return v;
    }
    return kind < 32 ? odd[kind % 12] : (float)((int32_t)take(b, 2) - 32768) / 4096.0f;
}

/* Positive or 0, and finite, except in one of sixteen cases. */
static float positive(bytes *b)
{
    const float v = number(b);
    return below(b, 16) == 0 ? v : v > 0.0f && v < 1e30f ? v : v < 0.0f && v > -1e30f ? -v : 1.0f;
}

static float share(bytes *b) { return (float)take(b, 1) / 255.0f; }

/* A valid choice; in one of sixteen cases possibly one above the maximum. */
static int32_t choice(bytes *b, uint32_t max) { return (int32_t)below(b, below(b, 16) == 0 ? max + 1 : max); }

/* --- a scene ------------------------------------------------------------------------------------------------------ */

typedef struct world {
    float positions[MESHES][TRIANGLES * 9], uvs[MESHES][TRIANGLES * 6];
    uint32_t colours[MESHES][TRIANGLES * 6], normals[MESHES][TRIANGLES * 3], indices[MESHES][TRIANGLES * 3];
    uint32_t texels[TEXELS];
    lmb_mesh mesh[MESHES];
    lmb_material material[MESHES];
    lmb_texture texture;
    lmb_instance instance[MESHES];
    lmb_light light[2];
    lmb_scene scene;
} world;

static void fill_words(uint32_t *out, size_t count, bytes *b)
{
    for (size_t i = 0; i < count; ++i) {
        out[i] = take(b, 1) * 0x01010101u ^ (uint32_t)(i * 0x9e3779b9u);
    }
}

static void make_mesh(world *w, uint32_t k, bytes *b)
{
    lmb_mesh *m = &w->mesh[k];
    const uint32_t how = take(b, 1);
    for (int i = 0; i < TRIANGLES * 9; ++i) {
        w->positions[k][i] = number(b);
    }
    for (int i = 0; i < TRIANGLES * 6; ++i) {
        w->uvs[k][i] = number(b);
    }
    fill_words(w->colours[k], TRIANGLES * 3, b);
    fill_words(w->normals[k], TRIANGLES * 3, b);
    m->positions = w->positions[k];
    m->uvs = how & 1u ? w->uvs[k] : NULL;
    m->colours = how & 2u ? (const uint8_t *)w->colours[k] : NULL;
    m->normals = how & 4u ? (const int16_t *)w->normals[k] : NULL;
    m->tangents = how & 8u ? (const int16_t *)w->normals[k] : NULL;
    m->triangle_count = below(b, TRIANGLES + 1);
    m->vertex_count = 3 * TRIANGLES;
    memcpy(w->colours[k] + TRIANGLES * 3, w->colours[k], TRIANGLES * 3 * sizeof w->colours[k][0]);
    m->colour_format = (uint8_t)(how >> 2 & 1u);
    m->position_format = (uint8_t)(how >> 4 & 1u);
    m->uv_format = (uint8_t)(how >> 5 & 1u);
    m->tangent_format = (uint8_t)(how >> 5 & 1u);
    m->position_scale = (lmb_vec3){positive(b), positive(b), positive(b)};
    m->position_offset = (lmb_vec3){positive(b), positive(b), positive(b)};
    m->uv_scale[0] = positive(b);
    m->uv_scale[1] = positive(b);
    if (how & 64u) {
        m->index_format = how & 128u ? LMB_INDEX_U32 : LMB_INDEX_U16;
        m->indices = w->indices[k];
        for (int i = 0; i < TRIANGLES * 3; ++i) {
            w->indices[k][i] = take(b, 1) % 40u; /* some outside */
        }
    }
}

static void make_material(lmb_material *m, bytes *b)
{
    for (int c = 0; c < 3; ++c) {
        m->albedo[c] = share(b);
        m->emission[c] = below(b, 8) == 0 ? positive(b) : 0.0f;
        m->specular[c] = below(b, 4) == 0 ? share(b) : 0.0f;
    }
    m->alpha = share(b);
    m->alpha_cutoff = share(b);
    m->texture = (int32_t)below(b, 2) - 1;
    m->flags = below(b, 4);
    m->normal_map = below(b, 16) == 0;
    m->normal_scale = below(b, 4) == 0 ? positive(b) : 0.0f;
    m->roughness = share(b);
    m->emission_map = below(b, 4) == 0;
    m->metal_map = below(b, 4) == 0;
    m->metallic = share(b);
}

static void make_light(lmb_light *l, bytes *b)
{
    static const lmb_vec3 way[4] = {{0, -1, 0}, {1, 0, 0}, {0.6f, -0.8f, 0}, {0, 0.6f, -0.8f}};
    memset(l, 0, sizeof *l);
    l->kind = (int32_t)below(b, below(b, 16) == 0 ? 4 : 3);
    l->position = (lmb_vec3){number(b), number(b), number(b)};
    l->direction = way[below(b, 4)];
    for (int c = 0; c < 3; ++c) {
        l->intensity[c] = positive(b);
    }
    l->cos_inner = share(b);
    l->cos_outer = l->cos_inner * share(b);
    l->range = below(b, 4) == 0 ? positive(b) : 0.0f;
}

static void make_instance(lmb_instance *n, uint32_t k, bytes *b)
{
    for (int i = 0; i < 4; ++i) {
        n->to_world.m[5 * i] = 1.0f;
    }
    if (below(b, 3) == 0) {
        for (int i = 0; i < 12; ++i) {
            n->to_world.m[i / 3 * 4 + i % 3] = number(b);
        }
    }
    n->mesh = n->material = k;
}

static void make_world(world *w, bytes *b)
{
    uint32_t id = 1;
    memset(w, 0, sizeof *w);
    fill_words(w->texels, TEXELS, b);
    w->texture.texels = (const uint8_t *)w->texels;
    w->texture.width = (uint16_t)(1 + below(b, 8));
    w->texture.height = (uint16_t)(1 + below(b, 8));
    w->texture.levels = 1;
    w->texture.wrap_s = (uint8_t)below(b, 3);
    w->texture.wrap_t = (uint8_t)below(b, 3);
    w->texture.filter = (uint8_t)below(b, 3);
    for (uint32_t k = 0; k < MESHES; ++k) {
        make_mesh(w, k, b);
        make_material(&w->material[k], b);
        make_instance(&w->instance[k], k, b);
        make_light(&w->light[k], b);
        w->instance[k].first_id = id;
        id += w->mesh[k].triangle_count;
    }
    w->scene.meshes = w->mesh;
    w->scene.materials = w->material;
    w->scene.textures = &w->texture;
    w->scene.instances = w->instance;
    w->scene.lights = w->light;
    w->scene.mesh_count = w->scene.material_count = w->scene.instance_count = MESHES;
    w->scene.texture_count = 1;
    w->scene.light_count = below(b, 3);
    lmb_scene_bounds(&w->scene.bounds_min, &w->scene.bounds_max, &w->scene);
    lmb_scene_core(&w->scene.core, &w->scene);
}

/* --- a frame ------------------------------------------------------------------------------------------------------ */

/* Memory of one frame; each piece is a separate block. */
typedef struct memory {
    void *depth, *id, *out, *map, *points, *tree, *bvh, *elements;
    lmb_band_scratch *scratch;
    lmb_groups *groups;
} memory;

static void make_view(lmb_view *v, bytes *b)
{
    const int32_t width = 1 + (int32_t)below(b, SIDE), height = 1 + (int32_t)below(b, SIDE);
    const lmb_vec3 eye = {number(b), number(b), number(b)}, target = {number(b), number(b), number(b)}, up = {0, 1, 0};
    if (lmb_view_look_at(v, eye, target, up, number(b), width, height) != LMB_OK) {
        lmb_view_look_at(v, (lmb_vec3){0.5f, 1.0f, 4.0f}, (lmb_vec3){0, 0, 0}, up, 0.9f, width, height);
    }
    if (below(b, 4) == 0) {
        v->near_m = number(b);
        v->far_m = number(b);
        v->half_width = number(b);
        v->kind = (int32_t)below(b, 3);
    }
}

static void set_surfaces(lmb_frame *f, memory *m, bytes *b)
{
    /* The last format is refused. */
    static const uint8_t formats[] = {LMB_RGB32F, LMB_RGBA8,     LMB_BGRA8, LMB_RGB565,
                                      LMB_RGB555, LMB_RGB565_BE, LMB_R32F};
    const int32_t width = f->view.frame_width, height = f->view.frame_height, format = formats[choice(b, 6)];
    const size_t depth = lmb_surface_bytes(LMB_DEPTH32F, width, height),
                 id = lmb_surface_bytes(LMB_ID32, width, height), out = lmb_surface_bytes(format, width, height);
    m->depth = malloc(depth);
    m->id = malloc(id);
    m->out = malloc(out);
    fuzz_require(m->depth && m->id && m->out);
    lmb_surface_init(&f->eye.depth, LMB_DEPTH32F, width, height, m->depth, depth);
    lmb_surface_init(&f->eye.id, LMB_ID32, width, height, m->id, id);
    lmb_surface_init(&f->out, format, width, height, m->out, out);
    memset(m->out, 0x5a, out);
}

static void set_light(lmb_frame *f, memory *m, bytes *b)
{
    const uint32_t triangles = lmb_scene_triangles(f->scene);
    f->shadow_map = 8 * (1 + (int32_t)below(b, MAP_MAX / 8));
    f->id_format = below(b, 2) ? LMB_ID16 : LMB_ID32;
    for (uint32_t i = 0; i < f->scene->light_count; ++i) {
        const int32_t faces = lmb_shadow_map_faces(&f->scene->lights[i], f->scene);
        f->map_bytes += lmb_shadow_map_bytes(faces, f->shadow_map, f->id_format);
    }
    const size_t points = lmb_points_bytes(256, MAP_MAX), tree = lmb_tree_bytes(12, 8),
                 bvh = lmb_bvh_bytes(triangles + 1), elements = lmb_elements_bytes(64);
    m->map = malloc(f->map_bytes + 1);
    m->points = malloc(points);
    m->tree = malloc(tree);
    m->bvh = malloc(bvh);
    m->elements = malloc(elements);
    fuzz_require(m->map && m->points && m->tree && m->bvh && m->elements);
    f->map_memory = m->map;
    lmb_points_init(&f->points, 256, MAP_MAX, m->points, points);
    if (below(b, 4) > 0) {
        lmb_tree_init(&f->tree, 12, 8, m->tree, tree);
        lmb_bvh_init(&f->bvh, triangles + 1, m->bvh, bvh);
        lmb_elements_init(&f->elements, 64, m->elements, elements);
    }
}

static void set_how(lmb_frame *f, bytes *b)
{
    f->show = choice(b, 4);
    f->grouping.method = choice(b, 4);
    f->grouping.block = 1 << choice(b, 4);
    f->grouping.groups = (int32_t)below(b, 64);
    f->grouping.join = share(b);
    f->grouping.reach = positive(b);
    f->grouping.cosine = share(b);
    f->grouping.flags = (uint32_t)choice(b, 8);
    f->grouping.thin = (int32_t)below(b, 4);
    f->occlusion = f->grouping.method == LMB_GROUP_CUT ? choice(b, 2) * LMB_OCCLUSION_EXACT : choice(b, 3);
    f->steps = (int32_t)below(b, 20);
    f->error = 0.1f + share(b); /* smaller values are slow and find nothing more */
    f->visibility = 0.1f + share(b);
    f->conservative = below(b, 8) == 0;
    f->bounces = f->grouping.method == LMB_GROUP_CUT ? choice(b, 4) : choice(b, 2);
    f->gather_step = choice(b, 2);
    f->exposure_ev = number(b);
}

static void free_memory(memory *m)
{
    free(m->depth);
    free(m->id);
    free(m->out);
    free(m->map);
    free(m->points);
    free(m->tree);
    free(m->bvh);
    free(m->elements);
    free(m->scratch);
    free(m->groups);
}

/* Finite lights give finite light or, if it exceeds binary32, infinity, but never NaN. */
static void check_out(const lmb_frame *f)
{
    const float *v = f->out.data;
    const size_t count = 3 * (size_t)f->out.width * (size_t)f->out.height;
    for (size_t i = 0; f->out.format == LMB_RGB32F && i < count; ++i) {
        fuzz_require(v[i] == v[i]);
    }
}

static void draw(const lmb_scene *scene, bytes *b)
{
    static lmb_render render;
    static lmb_stats stats;
    lmb_frame f;
    memory m;
    memset(&f, 0, sizeof f);
    memset(&m, 0, sizeof m);
    f.scene = scene;
    f.kernels = lmb_kernels_at((int32_t)below(b, 4));
    f.kernels = f.kernels != NULL ? f.kernels : lmb_kernels_pick();
    f.stats = &stats;
    m.scratch = malloc(sizeof *m.scratch);
    m.groups = malloc(sizeof *m.groups);
    fuzz_require(m.scratch && m.groups);
    f.scratch = m.scratch;
    f.groups = m.groups;
    make_view(&f.view, b);
    set_how(&f, b);
    set_surfaces(&f, &m, b);
    set_light(&f, &m, b);
    lmb_status status = lmb_render_begin(&render, &f);
    for (int steps = 0; status >= LMB_OK && steps < 100000; ++steps) {
        status = lmb_render_step(&render, 1 + (int32_t)below(b, 8));
        if (status == LMB_OK) {
            check_out(&f);
            break;
        }
    }
    fuzz_failures += status != LMB_OK; /* refused; counted as such */
    free_memory(&m);
}

void fuzz_api(const uint8_t *data, size_t size)
{
    static world w;
    const size_t head = size < HEAD ? size : HEAD;
    bytes how = {data, data + head, (uint32_t)size}, b = {data + head, data + size, (uint32_t)size + 1};
    make_world(&w, &b);
    if (lmb_scene_check(&w.scene) == LMB_OK) {
        draw(&w.scene, &how);
    } else {
        ++fuzz_failures;
    }
}
