/* resolve.c: ids of a tile -> position, normal, albedo, sixteen triangles of an instance at a time. Layer 3. */
#include "resolve.h"

#include <string.h>

#include "../base/poly.h"
#include "../base/vertex.h"
#include "paint.h"
#include "plane.h"
#include "target.h"
#include "texture.h"

/* --- one triangle ------------------------------------------------------------------------------------------------- */

void lmb_resolve_alpha_of(lmb_resolve_alpha *out, const lmb_triangle *t)
{
    for (int k = 0; k < 3; ++k) {
        float uv[2], colour[4];
        mesh_uv(t->mesh, t->vertex[k], uv);
        mesh_colour(t->mesh, t->vertex[k], colour);
        out->u[k] = uv[0];
        out->v[k] = uv[1];
        out->corner[k] = t->material->alpha * colour[3];
    }
    out->cutoff = t->material->flags & LMB_ALPHA_MASK ? t->material->alpha_cutoff : 0.0f;
    out->texture = t->material->texture;
}

/* Alpha of level 0. Small builds share the code that samples colours. */
static float alpha_of_texture(const lmb_texture *t, float u, float v)
{
#if LMB_TREES
    return lmb_texture_alpha(t, u, v);
#else
    float texel[4];
    lmb_texture_sample(texel, t, u, v, 0.0f);
    return texel[3];
#endif
}

float lmb_resolve_alpha_at(const lmb_resolve_alpha *alpha, const lmb_scene *scene, float b1, float b2)
{
    b1 = clampf(b1, 0.0f, 1.0f);
    b2 = clampf(b2, 0.0f, 1.0f - b1);
    float a = resolve_mix3(alpha->corner, b1, b2);
    if (alpha->texture >= 0) {
        a *= alpha_of_texture(&scene->textures[alpha->texture], resolve_mix3(alpha->u, b1, b2),
                              resolve_mix3(alpha->v, b1, b2));
    }
    return a;
}

#if LMB_MULTISAMPLE
/* The step to a neighbouring pixel along one texture coordinate, in texels. */
static float texel_step(const float corner[3], float b1, float b2, int32_t side)
{
    return ((corner[1] - corner[0]) * b1 + (corner[2] - corner[0]) * b2) * (float)side;
}

float lmb_resolve_blend_alpha(const lmb_resolve_alpha *alpha, const lmb_scene *scene, const lmb_plane *plane,
                              const lmb_rays *rays, int32_t x, int32_t y)
{
    const lmb_texture *t = alpha->texture >= 0 ? &scene->textures[alpha->texture] : NULL;
    const int has_levels = t != NULL && t->filter == LMB_TRILINEAR && t->levels > 1;
    float b1, b2, next1, next2, longest = 0.0f, texel[4];
    lmb_resolve_point(&b1, &b2, plane, rays, (float)x, (float)y);
    for (int step = 0; step < 2 && has_levels; ++step) {
        lmb_resolve_point(&next1, &next2, plane, rays, (float)(x + 1 - step), (float)(y + step));
        const float u = texel_step(alpha->u, next1 - b1, next2 - b2, t->width),
                    v = texel_step(alpha->v, next1 - b1, next2 - b2, t->height);
        longest = maxf(longest, u * u + v * v);
    }
    if (!(longest > 1.0f && longest < 1e30f)) {
        return lmb_resolve_alpha_at(alpha, scene, b1, b2);
    }
    b1 = clampf(b1, 0.0f, 1.0f);
    b2 = clampf(b2, 0.0f, 1.0f - b1);
    lmb_texture_sample(texel, t, resolve_mix3(alpha->u, b1, b2), resolve_mix3(alpha->v, b1, b2),
                       0.5f * lmb_log2(longest));
    return texel[3] * resolve_mix3(alpha->corner, b1, b2);
}
#endif

int lmb_resolve_opaque(const lmb_resolve_alpha *alpha, const lmb_scene *scene, float b1, float b2)
{
    return lmb_resolve_alpha_at(alpha, scene, b1, b2) >= alpha->cutoff;
}

#if LMB_TREES /* small builds draw holes pixel by pixel */
/* For rounding of the interpolation and of the sample's weights. */
#define WEIGHT_MARGIN 1.0001f
#define MIDDLE_SHARE    (1.0f / 3.0f)
#define ABOVE_ALL_ALPHA 2.0f /* more than any alpha */

int lmb_resolve_is_hole(const lmb_resolve_alpha *a, const lmb_scene *scene, uint32_t *texels)
{
    const float largest = maxf(maxf(a->corner[0], a->corner[1]), a->corner[2]) * WEIGHT_MARGIN;
    if (!(a->cutoff > 0.0f) || !is_sane(largest)) {
        return 0;
    }
    if (largest < a->cutoff) { /* a texture can only reduce it */
        return 1;
    }
    if (a->texture < 0 || lmb_resolve_opaque(a, scene, MIDDLE_SHARE, MIDDLE_SHARE) ||
        lmb_resolve_opaque(a, scene, 0.5f, 0.5f) || lmb_resolve_opaque(a, scene, 0.0f, 0.5f) ||
        lmb_resolve_opaque(a, scene, 0.5f, 0.0f)) {
        return 0;
    }
    const float low[2] = {minf(minf(a->u[0], a->u[1]), a->u[2]), minf(minf(a->v[0], a->v[1]), a->v[2])};
    const float high[2] = {maxf(maxf(a->u[0], a->u[1]), a->u[2]), maxf(maxf(a->v[0], a->v[1]), a->v[2])};
    return lmb_texture_coverage(&scene->textures[a->texture], low, high, a->cutoff / (largest * WEIGHT_MARGIN),
                                ABOVE_ALL_ALPHA, texels) == LMB_COVERS_NONE;
}

/* The range of a value given at the corners, between barycentrics inside the triangle. */
static void mix_range(float *low, float *high, const float corner[3], const float from[2], const float to[2])
{
    const float e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const float min = minf(minf(corner[0], corner[1]), corner[2]), max = maxf(maxf(corner[0], corner[1]), corner[2]);
    *low = maxf(corner[0] + (minf(e1 * from[0], e1 * to[0]) + minf(e2 * from[1], e2 * to[1])), min);
    *high = minf(corner[0] + (maxf(e1 * from[0], e1 * to[0]) + maxf(e2 * from[1], e2 * to[1])), max);
}

int lmb_resolve_coverage(const lmb_resolve_alpha *a, const lmb_scene *scene, const float low[2], const float high[2],
                         float cutoff_min, float cutoff_max, uint32_t *texels)
{
    const float largest = maxf(maxf(a->corner[0], a->corner[1]), a->corner[2]) * WEIGHT_MARGIN;
    const float smallest = minf(minf(a->corner[0], a->corner[1]), a->corner[2]);
    float from[2], to[2], uv_low[2], uv_high[2];
    if (a->texture < 0 || !(cutoff_min > 0.0f) || !(smallest > 0.0f) || !is_sane(largest)) {
        return 0;
    }
    to[0] = clampf(high[0], 0.0f, 1.0f);
    to[1] = clampf(high[1], 0.0f, 1.0f);
    from[0] = clampf(low[0], 0.0f, 1.0f);
    from[1] = minf(clampf(low[1], 0.0f, 1.0f), 1.0f - to[0]); /* lmb_resolve_opaque clamps the second to 1 - first */
    mix_range(&uv_low[0], &uv_high[0], a->u, from, to);
    mix_range(&uv_low[1], &uv_high[1], a->v, from, to);
    return lmb_texture_coverage(&scene->textures[a->texture], uv_low, uv_high, cutoff_min / (largest * WEIGHT_MARGIN),
                                cutoff_max * WEIGHT_MARGIN / smallest, texels);
}
#endif

int lmb_triangle_opaque(const lmb_triangle *t, const lmb_scene *scene, float b1, float b2)
{
    lmb_resolve_alpha alpha;
    if ((t->material->flags & LMB_ALPHA_MASK) == 0) {
        return 1;
    }
    lmb_resolve_alpha_of(&alpha, t);
    return lmb_resolve_opaque(&alpha, scene, b1, b2);
}

/* Kernels as wide as a tile write every pixel in a tile's first batch, so nothing is cleared before them. */
enum { HAVE_WIDE = LMB_HAVE_AVX2 || LMB_HAVE_AVX512 };

static int writes_all(const lmb_kernels *kernels) { return HAVE_WIDE && kernels->lanes >= LMB_TILE; }

/* --- a tile ------------------------------------------------------------------------------------------------------- */

/* Ids of the tile's pixels inside window and frame. Other ids are set to 0 if they were not cleared before. */
static void read_ids(uint32_t id[LMB_TILE_PIXELS], const lmb_target *target, const lmb_view *v, int32_t x, int32_t y)
{
    const lmb_fill_tile t = lmb_target_tile(target, (x - target->x0) / LMB_TILE, (y - target->y0) / LMB_TILE);
    const int32_t width = mini(mini(target->x0 + target->depth.width, v->frame_width) - x, LMB_TILE);
    const int32_t height = mini(mini(target->y0 + target->depth.height, v->frame_height) - y, LMB_TILE);
    if (t.id_format == LMB_ID32 && t.id_step == LMB_TILE && width == LMB_TILE && height == LMB_TILE) {
        memcpy(id, t.id, LMB_TILE_PIXELS * sizeof *id);
        return;
    }
    if (HAVE_WIDE) {
        memset(id, 0, LMB_TILE_PIXELS * sizeof *id);
    }
    for (int32_t row = 0; row < height; ++row) {
        for (int32_t column = 0; column < width; ++column) {
            const int32_t at = row * t.id_step + column;
            id[row * LMB_TILE + column] =
                t.id_format == LMB_ID16 ? ((const uint16_t *)t.id)[at] : ((const uint32_t *)t.id)[at];
        }
    }
}

/* Vertex numbers of a batch, [slot][corner]. */
typedef uint32_t corner_vertices[LMB_SLOTS][3];

/* Unrolled: gcc -O2 keeps loops of three. */
static void fetch_float(float to[3][LMB_SLOTS], int k, const float *p)
{
    to[0][k] = p[0];
    to[1][k] = p[1];
    to[2][k] = p[2];
}

static void fetch_floats(lmb_resolve_batch *b, corner_vertices vertex)
{
    const float *positions = (const float *)b->mesh->positions;
    for (int k = 0; k < b->count; ++k) {
        fetch_float(b->corner[0], k, positions + 3 * (size_t)vertex[k][0]);
        fetch_float(b->corner[1], k, positions + 3 * (size_t)vertex[k][1]);
        fetch_float(b->corner[2], k, positions + 3 * (size_t)vertex[k][2]);
    }
}

static void fetch_positions(lmb_resolve_batch *b, corner_vertices vertex)
{
    for (int k = 0; k < b->count; ++k) {
        for (int i = 0; i < 3; ++i) {
            const lmb_vec3 p = mesh_position(b->mesh, vertex[k][i]);
            b->corner[i][0][k] = p.x;
            b->corner[i][1][k] = p.y;
            b->corner[i][2][k] = p.z;
        }
    }
}

static void fetch_normals(lmb_resolve_batch *b, corner_vertices vertex)
{
    for (int k = 0; k < b->count; ++k) {
        for (int i = 0; i < 3; ++i) {
            const int16_t *code = b->mesh->normals + 2 * (size_t)vertex[k][i];
            b->normal[i][0][k] = code[0];
            b->normal[i][1][k] = code[1];
        }
    }
}

static uint32_t colour_at(const lmb_mesh *m, uint32_t vertex)
{
    const uint8_t *code = m->colours + 4 * (size_t)vertex;
    return (uint32_t)code[0] | (uint32_t)code[1] << 8 | (uint32_t)code[2] << 16 | (uint32_t)code[3] << 24;
}

#if LMB_TEXTURE_FORMATS
/* Unused slots must hold valid numbers. */
static void fetch_wide_colours(lmb_resolve_batch *b, corner_vertices vertex)
{
    if (b->count < LMB_SLOTS) {
        memset(b->albedo, 0, sizeof b->albedo);
    }
    for (int k = 0; k < b->count; ++k) {
        for (int i = 0; i < 9; ++i) {
            b->albedo[i / 3][i % 3][k] = mesh_wide_colour(b->mesh, vertex[k][i / 3], i % 3);
        }
    }
}
#endif

static void fetch_colours(lmb_resolve_batch *b, corner_vertices vertex)
{
#if LMB_TEXTURE_FORMATS
    if (mesh_colours_are_wide(b->mesh)) {
        fetch_wide_colours(b, vertex);
        return;
    }
#endif
    for (int k = 0; k < b->count; ++k) {
        for (int i = 0; i < 3; ++i) {
            b->colour[i][k] = colour_at(b->mesh, vertex[k][i]);
        }
    }
}

static void fetch_uvs(lmb_resolve_batch *b, corner_vertices vertex)
{
    for (int k = 0; k < b->count; ++k) {
        for (int i = 0; i < 3; ++i) {
            float uv[2];
            mesh_uv(b->mesh, vertex[k][i], uv);
            b->uv[i][0][k] = uv[0];
            b->uv[i][1][k] = uv[1];
        }
    }
}

/* Replaces missing vertices by vertex 0. Returns their slots, one bit each. */
static uint32_t fetch_indices(corner_vertices vertex, const lmb_resolve_batch *b)
{
    const lmb_mesh *m = b->mesh;
    const uint32_t past = m->vertex_count, first = b->instance->first_id;
    uint32_t bad = 0;
    for (int k = 0; k < b->count && m->indices != NULL; ++k) {
        mesh_index_soon(m, 3 * (b->id[k] - first));
    }
    for (int k = 0; k < b->count; ++k) {
        mesh_triangle(m, b->id[k] - first, vertex[k]);
        if (vertex[k][0] >= past || vertex[k][1] >= past || vertex[k][2] >= past) {
            bad |= 1u << k;
            vertex[k][0] = vertex[k][1] = vertex[k][2] = 0;
        }
    }
    return bad;
}

/* Prefetches the three vertices of each slot. */
MESH_HINT void fetch_soon(const void *stream, size_t bytes, corner_vertices vertex, int count)
{
    for (int k = 0; k < count; ++k) {
        MESH_SOON((const uint8_t *)stream + bytes * vertex[k][0]);
        MESH_SOON((const uint8_t *)stream + bytes * vertex[k][1]);
        MESH_SOON((const uint8_t *)stream + bytes * vertex[k][2]);
    }
}

/* Unused slots must hold valid numbers, from corners to uvs. Wide kernels do not read them. */
static void fetch_nothing(lmb_resolve_batch *b)
{
    const size_t from = offsetof(lmb_resolve_batch, corner), past = offsetof(lmb_resolve_batch, plane);
    memset((uint8_t *)b + from, 0, past - from);
}

/* Fetches all slots' triangles from the mesh. Returns the invalid ones, one bit each. */
static uint32_t fetch_batch(lmb_resolve_batch *b, int is_wide)
{
    const lmb_mesh *m = b->mesh;
    corner_vertices vertex;
    const uint32_t bad = fetch_indices(vertex, b);
    if (b->count < LMB_SLOTS && !is_wide) {
        fetch_nothing(b);
    }
    if (m->vertex_count == 0) {
        return bad;
    }
    const int is_float = HAVE_WIDE && m->position_format == LMB_POSITION_F32;
    fetch_soon(m->positions, m->position_format == LMB_POSITION_F32 ? 12 : 8, vertex, b->count);
    if (m->colours != NULL) {
        fetch_soon(m->colours, mesh_colours_are_wide(m) ? 8 : 4, vertex, b->count);
    }
    if (m->uvs != NULL) {
        fetch_soon(m->uvs, m->uv_format == LMB_UV_F32 ? 8 : 4, vertex, b->count);
    }
    if (is_float) {
        fetch_floats(b, vertex);
    } else {
        fetch_positions(b, vertex);
    }
    if (m->normals != NULL && !b->albedo_only) {
        fetch_normals(b, vertex);
    }
    if (m->colours != NULL) {
        fetch_colours(b, vertex);
    }
    if (m->uvs != NULL) {
        fetch_uvs(b, vertex);
    }
    return bad;
}

static lmb_resolve_batch *batch_of(lmb_tile *t) { return (lmb_resolve_batch *)(void *)t->work.bytes; }

/* Clears the pixels of slot k: their id comes from another scene. */
static void drop_slot(lmb_tile *out, int k)
{
    int32_t *slot = batch_of(out)->slot;
    for (int i = 0; i < LMB_TILE_PIXELS; ++i) {
        if (slot[i] == k) {
            slot[i] = -1;
            out->id[i] = 0;
        }
    }
}

/* Resolves as many triangles of the pixels `left` as fit a batch. Returns the pixels that are done. */
static uint64_t resolve_some(lmb_tile *out, const lmb_kernels *kernels, const lmb_scene *scene, uint64_t left)
{
    lmb_resolve_batch *b = batch_of(out);
    const int first = lowest_bit_64(left);
    b->instance = lmb_instance_of(scene, out->id[first]);
    if (b->instance == NULL) {
        out->id[first] = 0;
        return (uint64_t)1 << first;
    }
    b->mesh = &scene->meshes[b->instance->mesh];
    b->material = &scene->materials[b->instance->material];
    const uint64_t done = kernels->resolve_slots(b, out->id, left);
    for (uint32_t bad = fetch_batch(b, writes_all(kernels)); bad != 0; bad &= bad - 1) {
        drop_slot(out, lowest_bit(bad));
    }
    kernels->resolve_setup(b);
    kernels->resolve(out, b);
    if (HAVE_WIDE) {
        b->is_first = 0;
    }
    lmb_paint_tile(out, b, kernels, scene);
    return done;
}

/* Clears from the first plane, or from albedo, to `past`. */
static void clear_to(lmb_tile *out, int albedo_only, size_t past)
{
    const size_t from = albedo_only ? offsetof(lmb_tile, albedo) : 0;
    memset((uint8_t *)out + from, 0, past - from);
}

static lmb_status resolve(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                          const lmb_target *target, int32_t x, int32_t y, int albedo_only)
{
    if (out == NULL || kernels == NULL || view == NULL || scene == NULL || target == NULL || target->id.data == NULL ||
        lmb_target_check(target, view, 0) != LMB_OK || x < target->x0 || y < target->y0 ||
        x >= target->x0 + target->id.width || y >= target->y0 + target->id.height || x % LMB_TILE != 0 ||
        y % LMB_TILE != 0) {
        return LMB_ERR_ARG;
    }
    lmb_resolve_batch *batch = batch_of(out);
    const int by_kernel = writes_all(kernels);
    if (!by_kernel) {
        clear_to(out, albedo_only, offsetof(lmb_tile, work));
    }
    out->x = x;
    out->y = y;
    if (by_kernel) {
        out->hits = 0;
        batch->is_first = 1;
    }
    read_ids(out->id, target, view, x, y);
    uint64_t left = kernels->resolve_shown(out->id);
    if (left != 0) {
        lmb_resolve_rays(&batch->rays, view, x, y);
        batch->albedo_only = (int16_t)albedo_only;
        while (left != 0) {
            left &= ~resolve_some(out, kernels, scene, left);
        }
        out->hits = count_bits_64(kernels->resolve_shown(out->id));
    }
    if (by_kernel && batch->is_first) {
        clear_to(out, albedo_only, offsetof(lmb_tile, id));
    }
    return LMB_OK;
}

lmb_status lmb_resolve_tile(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                            const lmb_target *target, int32_t x, int32_t y)
{
    return resolve(out, kernels, view, scene, target, x, y, 0);
}

lmb_status lmb_resolve_albedo(lmb_tile *out, const lmb_kernels *kernels, const lmb_view *view, const lmb_scene *scene,
                              const lmb_target *target, int32_t x, int32_t y)
{
    return resolve(out, kernels, view, scene, target, x, y, 1);
}
