/* piece.c: the mean albedo of a piece of a triangle, by four points of its textures. Layer 8. */
#include "piece.h"

#include "../base/poly.h"
#include "../base/vertex.h"
#include "../raster/resolve.h"
#include "../raster/texture.h"

#if LMB_TREES || LMB_TRANSFER

enum { SAMPLES = 4 };

/* Of the base colour's; where there is none, of the map of metal. */
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

static void albedo_at(float out[3], const piece_source *s, float b1, float b2, float lod)
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
    const float texels = s->texels * share / SAMPLES, lod = texels > 1.0f ? 0.5f * lmb_log2(texels) : 0.0f;
    const float b1 = (p->b1[0] + p->b1[1] + p->b1[2]) / 3.0f, b2 = (p->b2[0] + p->b2[1] + p->b2[2]) / 3.0f;
    int standing = 0;
    albedo[0] = albedo[1] = albedo[2] = 0.0f;
    for (int i = 0; i < SAMPLES; ++i) {
        const float x = i < 3 ? 0.5f * (b1 + p->b1[i]) : b1, y = i < 3 ? 0.5f * (b2 + p->b2[i]) : b2;
        float a[3];
        if (lmb_triangle_opaque(&s->triangle, s->scene, x, y)) {
            albedo_at(a, s, x, y, lod);
            for (int c = 0; c < 3; ++c) {
                albedo[c] += a[c];
            }
            ++standing;
        }
    }
    for (int c = 0; c < 3; ++c) {
        albedo[c] /= (float)maxi(standing, 1);
    }
    return (float)standing / SAMPLES;
}

#endif
