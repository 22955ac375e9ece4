/* paint.c: colours and normals of a tile's pixels from the textures of the triangle that they show. Layer 3. */
#include "paint.h"

#include "../base/poly.h"
#include "../base/vertex.h"
#include "resolve.h"
#include "texture.h"
#include "tile.h"

static lmb_vec3 vector_of(const float (*v)[LMB_SLOTS], int32_t slot)
{
    return vec3(v[0][slot], v[1][slot], v[2][slot]);
}

/* Copies the values of a slot out of the batch. */
static void take_slot(lmb_painted *p, const lmb_resolve_batch *b, int32_t slot)
{
    p->slot = slot;
    p->plane.corner = vector_of(b->corner[0], slot);
    p->plane.g1 = vector_of(b->corner[1], slot);
    p->plane.g2 = vector_of(b->corner[2], slot);
    p->plane.plane = vector_of(b->plane, slot);
    p->plane.w_min = b->w_min[slot];
    p->plane.w_max = b->w_max[slot];
    for (int i = 0; i < 3; ++i) {
        p->uv[i][0] = b->mesh->uvs != NULL ? b->uv[i][0][slot] : 0.0f;
        p->uv[i][1] = b->mesh->uvs != NULL ? b->uv[i][1][slot] : 0.0f;
    }
}

static float uv_at(const lmb_painted *p, int c, const float b[2])
{
    return p->uv[0][c] + (p->uv[1][c] * b[0] + p->uv[2][c] * b[1]);
}

static int has_lod(const lmb_texture *t) { return t->filter == LMB_TRILINEAR && t->levels > 1; }

/* Level of detail: the longer of the two pixel steps, in texels. */
static float pixel_lod(const lmb_painted *p, const lmb_rays *rays, const lmb_texture *t, int32_t pixel)
{
    float x = (float)(pixel % LMB_TILE), y = (float)(pixel / LMB_TILE);
    if (!has_lod(t)) {
        return 0.0f;
    }
    float b[3][2], size[2] = {(float)t->width, (float)t->height};
    lmb_resolve_point(&b[0][0], &b[0][1], &p->plane, rays, x, y);
    lmb_resolve_point(&b[1][0], &b[1][1], &p->plane, rays, x + 1.0f, y);
    lmb_resolve_point(&b[2][0], &b[2][1], &p->plane, rays, x, y + 1.0f);
    float longest = 0.0f;
    for (int step = 1; step < 3; ++step) {
        float d2 = 0.0f;
        for (int c = 0; c < 2; ++c) {
            float d = (uv_at(p, c, b[step]) - uv_at(p, c, b[0])) * size[c];
            d2 += d * d;
        }
        longest = maxf(longest, d2);
    }
    return longest > 1.0f && longest < 1e30f ? 0.5f * lmb_log2(longest) : 0.0f;
}

static void paint_levels(lmb_tile *out, const lmb_resolve_batch *b, const lmb_texture *t)
{
    lmb_painted p;
    p.slot = -1;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (b->slot[k] < 0) {
            continue;
        }
        if (b->slot[k] != p.slot) {
            take_slot(&p, b, b->slot[k]);
        }
        float texel[4];
        lmb_texture_sample(texel, t, out->uv[0][k], out->uv[1][k], pixel_lod(&p, &b->rays, t, k));
        for (int c = 0; c < 3; ++c) {
            out->albedo[c][k] *= texel[c];
        }
    }
}

#if LMB_TEXTURE_FORMATS
/* The kernel supports only RGBA8. */
static void paint_coded(lmb_tile *out, const lmb_resolve_batch *b, const lmb_texture *t)
{
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        float texel[4];
        if (b->slot[k] < 0) {
            continue;
        }
        lmb_texture_sample(texel, t, out->uv[0][k], out->uv[1][k], 0.0f);
        for (int c = 0; c < 3; ++c) {
            out->albedo[c][k] *= texel[c];
        }
    }
}
#endif

/* The axes of a normal map in the world. */
typedef struct tangent_frame {
    lmb_vec3 tangent[3]; /* the first one, at the corners */
    float turn[3];       /* +1 or -1: the second one is turn * (front normal x tangent) */
    float side;          /* -1 if the pixels show the back */
} tangent_frame;

/* 1 if the mesh defines both axes. Small builds take the side from texture coordinates. */
static int is_sided(const lmb_mesh *m)
{
    return LMB_TREES && m->tangents != NULL && m->tangent_format == LMB_TANGENT_SIDED;
}

static lmb_vec3 transform_direction(const lmb_mat4 *t, lmb_vec3 d)
{
    const float *m = t->m;
    return add3(add3(mul3(vec3(m[0], m[1], m[2]), d.x), mul3(vec3(m[4], m[5], m[6]), d.y)),
                mul3(vec3(m[8], m[9], m[10]), d.z));
}

static lmb_vec3 tangent_in_world(const lmb_triangle *t, int corner)
{
    return normalize3(transform_direction(&t->instance->to_world, mesh_tangent(t->mesh, t->vertex[corner])));
}

/* The mesh's axes. Mirroring flips a cross product. */
static void set_sided(tangent_frame *f, const lmb_triangle *t, float mirror)
{
    for (int k = 0; k < 3; ++k) {
        f->tangent[k] = tangent_in_world(t, k);
        f->turn[k] = mesh_tangent_side(t->mesh, t->vertex[k]) * mirror;
    }
}

/* From P(u, v): dP/du = (e1 dv2 - e2 dv1) / area and dP/dv = (e2 du1 - e1 du2) / area; only directions matter. Returns
 * 0 if the coordinates have no area. */
static int set_by_uv(tangent_frame *f, const lmb_painted *p, const lmb_triangle *t, lmb_vec3 front)
{
    float du1 = p->uv[1][0], dv1 = p->uv[1][1], du2 = p->uv[2][0], dv2 = p->uv[2][1];
    float area = du1 * dv2 - du2 * dv1, sign = area < 0.0f ? -1.0f : 1.0f;
    lmb_vec3 e1 = sub3(t->corner[1], t->corner[0]), e2 = sub3(t->corner[2], t->corner[0]);
    lmb_vec3 along_u = normalize3(mul3(sub3(mul3(e1, dv2), mul3(e2, dv1)), sign));
    lmb_vec3 against_v = mul3(sub3(mul3(e1, du2), mul3(e2, du1)), sign);
    if (!(area * area > 1e-30f) || !is_sane(area)) {
        return 0;
    }
    const float turn = dot3(cross3(front, along_u), against_v) < 0.0f ? -1.0f : 1.0f;
    for (int k = 0; k < 3; ++k) {
        f->tangent[k] = t->mesh->tangents != NULL ? tangent_in_world(t, k) : along_u;
        f->turn[k] = turn;
    }
    return 1;
}

static int set_tangent_frame(tangent_frame *f, const lmb_painted *p, const lmb_triangle *t, lmb_vec3 face)
{
    const float mirror = is_mirrored(&t->instance->to_world) ? -1.0f : 1.0f;
    const lmb_vec3 front = mul3(p->plane.plane, mirror);
    f->side = dot3(front, face) < 0.0f ? -1.0f : 1.0f;
    if (!is_sided(t->mesh)) {
        return set_by_uv(f, p, t, front);
    }
    set_sided(f, t, mirror);
    return 1;
}

/* Both axes at pixel `k`. The first one is made perpendicular to the normal. If that leaves nothing, the length is
 * arbitrary. */
static void axes_at(lmb_vec3 axis[2], const tangent_frame *f, const lmb_painted *p, const lmb_rays *rays,
                    lmb_vec3 normal, int32_t k)
{
    const lmb_vec3 *t = f->tangent;
    const float *turn = f->turn;
    float b1, b2;
    lmb_resolve_point(&b1, &b2, &p->plane, rays, (float)(k % LMB_TILE), (float)(k / LMB_TILE));
    b1 = clampf(b1, 0.0f, 1.0f);
    b2 = clampf(b2, 0.0f, 1.0f - b1);
    lmb_vec3 mixed = add3(t[0], add3(mul3(sub3(t[1], t[0]), b1), mul3(sub3(t[2], t[0]), b2)));
    axis[0] = normalize3(sub3(mixed, mul3(normal, dot3(mixed, normal))));
    axis[1] = mul3(cross3(normal, axis[0]), turn[0] + ((turn[1] - turn[0]) * b1 + (turn[2] - turn[0]) * b2));
}

/* Normals stay on the viewer's side of the face, at least this sine above the plane. */
#define MIN_RISE 0.01f

static lmb_vec3 above_face(lmb_vec3 n, lmb_vec3 face)
{
    float rise = dot3(n, face);
    return rise < MIN_RISE ? normalize3(add3(n, mul3(face, MIN_RISE - rise))) : n;
}

/* Bends the normals of the pixels of one triangle. */
static void paint_normal(lmb_tile *out, const lmb_resolve_batch *b, const lmb_painted *p, const tangent_frame *f,
                         const lmb_texture *map)
{
    const lmb_vec3 face = vector_of(b->face, p->slot);
    const float scale = b->material->normal_scale;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (b->slot[k] != p->slot) {
            continue;
        }
        float code[4];
        lmb_vec3 n = mul3(vec3(out->normal[0][k], out->normal[1][k], out->normal[2][k]), f->side), axis[2];
        axes_at(axis, f, p, &b->rays, n, k);
        lmb_normal_map_sample(code, map, out->uv[0][k], out->uv[1][k], pixel_lod(p, &b->rays, map, k));
        lmb_vec3 bent = add3(add3(mul3(axis[0], code[0] * scale), mul3(axis[1], code[1] * scale)), mul3(n, code[2]));
        float length2 = dot3(bent, bent);
        if (length2 > 1e-12f && is_sane(length2)) {
            n = above_face(mul3(bent, f->side / sqrtf(length2)), face);
            tile_set_vec(out->normal, k, n);
        }
    }
}

static void paint_normals(lmb_tile *out, const lmb_resolve_batch *b, const lmb_scene *scene)
{
    for (int32_t slot = 0; slot < b->count; ++slot) {
        lmb_painted p;
        tangent_frame frame;
        lmb_triangle t;
        take_slot(&p, b, slot);
        if (lmb_triangle_fetch(&t, scene, b->id[slot]) && set_tangent_frame(&frame, &p, &t, vector_of(b->face, slot))) {
            paint_normal(out, b, &p, &frame, &scene->textures[b->material->normal_map]);
        }
    }
}

#if LMB_LOBES

/* --- metals ------------------------------------------------------------------------------------------------------- */

/* Metals reflect no diffuse light. */
static void paint_metal(lmb_tile *out, const lmb_resolve_batch *b, const lmb_texture *map)
{
    lmb_painted p;
    p.slot = -1;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        float code[4];
        if (b->slot[k] < 0) {
            continue;
        }
        if (b->slot[k] != p.slot) {
            take_slot(&p, b, b->slot[k]);
        }
        lmb_normal_map_sample(code, map, out->uv[0][k], out->uv[1][k], pixel_lod(&p, &b->rays, map, k));
        for (int c = 0; c < 3; ++c) {
            out->albedo[c][k] *= 1.0f - metallic_of(b->material, code);
        }
    }
}

/* --- pixels of a tile that is resolved ---------------------------------------------------------------------------- */

void lmb_painter_begin(lmb_painter *out, const lmb_scene *scene, const lmb_view *view, const lmb_tile *tile)
{
    out->tile = tile;
    out->scene = scene;
    out->triangle.id = 0;
    lmb_resolve_rays(&out->rays, view, tile->x, tile->y);
}

/* The triangle of pixel k. Returns 0 if the id names none, which no resolved tile has. */
static int take_painted_pixel(lmb_painter *at, int k)
{
    lmb_triangle *t = &at->triangle;
    lmb_painted *p = &at->painted;
    if (at->tile->id[k] == t->id) {
        return t->id != 0;
    }
    if (!lmb_triangle_fetch(t, at->scene, at->tile->id[k])) {
        t->id = 0;
        return 0;
    }
    lmb_resolve_plane(&p->plane, t->corner, &at->rays);
    for (int i = 0; i < 3; ++i) {
        mesh_uv(t->mesh, t->vertex[i], p->uv[i]);
        for (int c = 0; c < 2; ++c) {
            p->uv[i][c] -= i > 0 ? p->uv[0][c] : 0.0f;
        }
    }
    return 1;
}

void lmb_painter_colour(float out[4], lmb_painter *at, uint32_t texture, int k)
{
    const lmb_texture *t = &at->scene->textures[texture];
    out[0] = out[1] = out[2] = out[3] = 0.0f;
    if (!take_painted_pixel(at, k)) {
        return;
    }
    lmb_texture_sample(out, t, at->tile->uv[0][k], at->tile->uv[1][k], pixel_lod(&at->painted, &at->rays, t, k));
}

void lmb_painter_metal(float *metallic, float *roughness, lmb_painter *at, int k)
{
    float code[4];
    *metallic = *roughness = 0.0f;
    if (!take_painted_pixel(at, k)) {
        return;
    }
    const lmb_material *m = at->triangle.material;
    const lmb_texture *t = &at->scene->textures[m->metal_map - 1];
    lmb_normal_map_sample(code, t, at->tile->uv[0][k], at->tile->uv[1][k], pixel_lod(&at->painted, &at->rays, t, k));
    *metallic = metallic_of(m, code);
    *roughness = roughness_of(m, code);
}

void lmb_painter_base(float out[3], lmb_painter *at, int k)
{
    out[0] = out[1] = out[2] = 0.0f;
    if (!take_painted_pixel(at, k)) {
        return;
    }
    const lmb_triangle *t = &at->triangle;
    float texel[4] = {1.0f, 1.0f, 1.0f, 1.0f}, colour[3][4], b1, b2;
    if (t->material->texture >= 0) {
        lmb_painter_colour(texel, at, (uint32_t)t->material->texture, k);
    }
    for (int i = 0; i < 3; ++i) {
        mesh_colour(t->mesh, t->vertex[i], colour[i]);
    }
    lmb_resolve_point(&b1, &b2, &at->painted.plane, &at->rays, (float)(k % LMB_TILE), (float)(k / LMB_TILE));
    b1 = clampf(b1, 0.0f, 1.0f);
    b2 = clampf(b2, 0.0f, 1.0f - b1);
    for (int c = 0; c < 3; ++c) {
        const float corner[3] = {colour[0][c], colour[1][c], colour[2][c]};
        out[c] = clampf(t->material->albedo[c] * texel[c] * resolve_mix3(corner, b1, b2), 0.0f, 1.0f);
    }
}

#endif

/* --- a batch ------------------------------------------------------------------------------------------------------ */

void lmb_paint_tile(lmb_tile *out, const lmb_resolve_batch *batch, const lmb_kernels *kernels, const lmb_scene *scene)
{
    const lmb_material *m = batch->material;
    if (m->texture >= 0 && has_lod(&scene->textures[m->texture]) && batch->mesh->uvs != NULL) {
        paint_levels(out, batch, &scene->textures[m->texture]);
#if LMB_TEXTURE_FORMATS
    } else if (m->texture >= 0 && scene->textures[m->texture].format != LMB_TEXELS_RGBA8) {
        paint_coded(out, batch, &scene->textures[m->texture]);
#endif
    } else if (m->texture >= 0) {
        kernels->texture(out, batch, &scene->textures[m->texture]);
    }
#if LMB_LOBES
    if (m->metal_map > 0) {
        paint_metal(out, batch, &scene->textures[m->metal_map - 1]);
    }
#endif
    if (m->normal_scale != 0.0f && (batch->mesh->uvs != NULL || is_sided(batch->mesh)) && !batch->albedo_only) {
        paint_normals(out, batch, scene);
    }
}
