/* piece.c: a piece's albedo, from four points of the triangle's textures, and emission. Layer 6. */
#include "piece.h"

#include <string.h>

#include "../base/poly.h"
#include "../base/vertex.h"
#include "../raster/resolve.h"
#include "../raster/texture.h"

#if LMB_TREES || LMB_TRANSFER

enum { ALBEDO_SAMPLES = 4 };

/* Texels of the base colour texture; if there is none, of the metal map. */
static void set_texels(piece_source *s)
{
    const lmb_material *m = s->triangle.material;
    const int32_t texture = m->texture >= 0 ? m->texture : (int32_t)m->metal_map - 1;
    s->texels = 0.0f;
    if (texture >= 0) {
        const lmb_texture *t = &s->scene->textures[texture];
        const float u1 = s->uv[1][0] - s->uv[0][0], v1 = s->uv[1][1] - s->uv[0][1];
        const float u2 = s->uv[2][0] - s->uv[0][0], v2 = s->uv[2][1] - s->uv[0][1];
        s->texels = 0.5f * absf(u1 * v2 - u2 * v1) * (float)t->width * (float)t->height;
    }
}

int lmb_source_open(piece_source *out, const lmb_scene *scene, uint32_t id)
{
    lmb_triangle *t = &out->triangle;
    if (!lmb_triangle_fetch(t, scene, id) || !lmb_triangle_shape(&out->normal, &out->area, t)) {
        return 0;
    }
    out->scene = scene;
    out->normal = mul3(out->normal, is_mirrored(&t->instance->to_world) ? -1.0f : 1.0f);
    for (int k = 0; k < 3; ++k) {
        mesh_uv(t->mesh, t->vertex[k], out->uv[k]);
        mesh_colour(t->mesh, t->vertex[k], out->colour[k]);
    }
    set_texels(out);
    return 1;
}

static void albedo_at_point(float out[3], const piece_source *s, float b1, float b2, float lod)
{
    const lmb_material *m = s->triangle.material;
    float texel[4] = {1.0f, 1.0f, 1.0f, 1.0f}, code[4], diffuse = 1.0f;
    if (m->texture >= 0) {
        lmb_texture_sample(texel, &s->scene->textures[m->texture], piece_uv_at(s, 0, b1, b2), piece_uv_at(s, 1, b1, b2),
                           lod);
    }
    if (m->metal_map > 0) {
        lmb_normal_map_sample(code, &s->scene->textures[m->metal_map - 1], piece_uv_at(s, 0, b1, b2),
                              piece_uv_at(s, 1, b1, b2), lod);
        diffuse = 1.0f - metallic_of(m, code);
    }
    for (int c = 0; c < 3; ++c) {
        const float colour = piece_mix(s->colour[0][c], s->colour[1][c], s->colour[2][c], b1, b2);
        out[c] = clampf(m->albedo[c] * colour * texel[c] * diffuse, 0.0f, 1.0f);
    }
}

float lmb_source_albedo(float albedo[3], const piece_source *s, const surface_piece *p, float share)
{
    const float texels = s->texels * share / ALBEDO_SAMPLES, lod = texels > 1.0f ? 0.5f * lmb_log2(texels) : 0.0f;
    const float b1 = (p->b1[0] + p->b1[1] + p->b1[2]) / 3.0f, b2 = (p->b2[0] + p->b2[1] + p->b2[2]) / 3.0f;
    int standing = 0;
    albedo[0] = albedo[1] = albedo[2] = 0.0f;
    for (int i = 0; i < ALBEDO_SAMPLES; ++i) {
        const float x = i < 3 ? 0.5f * (b1 + p->b1[i]) : b1, y = i < 3 ? 0.5f * (b2 + p->b2[i]) : b2;
        float a[3];
        if (lmb_triangle_opaque(&s->triangle, s->scene, x, y)) {
            albedo_at_point(a, s, x, y, lod);
            for (int c = 0; c < 3; ++c) {
                albedo[c] += a[c];
            }
            ++standing;
        }
    }
    for (int c = 0; c < 3; ++c) {
        albedo[c] /= (float)maxi(standing, 1);
    }
    return (float)standing / ALBEDO_SAMPLES;
}

void lmb_source_albedo_at(float out[3], const piece_source *s, lmb_vec3 at, float area)
{
    const lmb_vec3 *corner = s->triangle.corner, p = sub3(at, corner[0]);
    const lmb_vec3 across = cross3(sub3(corner[1], corner[0]), sub3(corner[2], corner[0]));
    const float per = 1.0f / dot3(across, across), texels = s->texels * area / s->area;
    const float b1 = clampf(dot3(cross3(p, sub3(corner[2], corner[0])), across) * per, 0.0f, 1.0f),
                b2 = clampf(dot3(cross3(sub3(corner[1], corner[0]), p), across) * per, 0.0f, 1.0f - b1);
    albedo_at_point(out, s, b1, b2, texels > 1.0f ? 0.5f * lmb_log2(texels) : 0.0f);
}

/* --- emission ----------------------------------------------------------------------------------------------------- */

enum { MAX_ROWS = 4, MAX_ROWS_BARE = 32 /* of a piece; of a piece with a map without mip levels */ };

/* Texels along the longest edge of a piece, in a map. */
static float texels_along(const piece_source *s, const surface_piece *p, const lmb_texture *map)
{
    float longest = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const int to = (k + 1) % 3;
        const float du = (piece_uv_at(s, 0, p->b1[to], p->b2[to]) - piece_uv_at(s, 0, p->b1[k], p->b2[k])) *
                         (float)map->width;
        const float dv = (piece_uv_at(s, 1, p->b1[to], p->b2[to]) - piece_uv_at(s, 1, p->b1[k], p->b2[k])) *
                         (float)map->height;
        longest = maxf(longest, du * du + dv * dv);
    }
    return longest < 1e30f ? sqrtf(longest) : 0.0f;
}

/* Adds the map at a point of the piece, if the point is opaque. at: shares of the second and third corner, and the mip
 * level. */
static int add_glow(float sum[3], const piece_source *s, const surface_piece *p, const lmb_texture *map,
                    const float at[3])
{
    const float b1 = piece_mix(p->b1[0], p->b1[1], p->b1[2], at[0], at[1]);
    const float b2 = piece_mix(p->b2[0], p->b2[1], p->b2[2], at[0], at[1]);
    float texel[4];
    if (!lmb_triangle_opaque(&s->triangle, s->scene, b1, b2)) {
        return 0;
    }
    lmb_texture_sample(texel, map, piece_uv_at(s, 0, b1, b2), piece_uv_at(s, 1, b1, b2), at[2]);
    for (int c = 0; c < 3; ++c) {
        sum[c] += texel[c];
    }
    return 1;
}

/* Mean over a piece: sampled at the middles of rows x rows congruent triangles, enough to visit each texel of the
 * level. Only a few texels of a map may glow, and they provide all light of an element. */
void lmb_source_emission(float out[3], const piece_source *s, const surface_piece *p)
{
    const lmb_material *m = s->triangle.material;
    memcpy(out, m->emission, sizeof m->emission);
    if (m->emission_map == 0 || !(largest3(vec3(out[0], out[1], out[2])) > 0.0f)) {
        return;
    }
    lmb_texture map = s->scene->textures[m->emission_map - 1];
    map.filter = map.levels > 1 ? LMB_TRILINEAR : map.filter;
    const float along = texels_along(s, p, &map), max = map.levels > 1 ? MAX_ROWS : MAX_ROWS_BARE;
    const int rows = (int)clampf(along, 0.0f, max - 1.0f) + 1;
    const float step = 1.0f / (float)rows, lod = along > max ? lmb_log2(along * step) : 0.0f;
    float sum[3] = {0.0f, 0.0f, 0.0f};
    int standing = 0;
    for (int i = 0; i < rows * rows; ++i) {
        const int row = i / rows, column = i % rows, down = row + column >= rows; /* the far half, mirrored */
        const float x = (float)(down ? rows - 1 - column : column), y = (float)(down ? rows - 1 - row : row);
        const float third = down ? 2.0f / 3.0f : 1.0f / 3.0f;
        const float at[3] = {(x + third) * step, (y + third) * step, lod};
        standing += add_glow(sum, s, p, &map, at);
    }
    for (int c = 0; c < 3; ++c) {
        out[c] *= sum[c] / (float)maxi(standing, 1);
    }
}

#endif
