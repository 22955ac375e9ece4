/* relight_lobes.c: bands of a picture with the ground that objects darken and with lobes that reflect both. */
#include "relight_contact.h"

#include <math.h>
#include <string.h>

/* The unoccluded share of a direction at sample i of a part, interpolated between the four nearest directions. */
static float sample_open(const hidden_part *p, uint32_t i, const uint16_t at[4], const float weight[4])
{
    const uint64_t *blocked = p->blocked[i / LMB_TILE_PIXELS];
    float open = 0.0f;
    for (int k = 0; k < 4; ++k) {
        open += blocked[at[k]] >> (i % LMB_TILE_PIXELS) & 1 ? 0.0f : weight[k];
    }
    return open;
}

/* The same at a vertex, for one direction and for uniform light. */
static void vertex_open(float *mirrored, float *all, const hidden_part *p, uint32_t vertex, const uint16_t at[4],
                        const float weight[4])
{
    *mirrored = *all = 0.0f;
    for (int i = 0; i < (p->share != NULL ? HIDDEN_SHARES : 1); ++i) {
        uint32_t sample;
        const float share = hidden_shared(&sample, p, vertex, i);
        if (share > 0.0f) {
            *mirrored += share * sample_open(p, sample, at, weight);
            *all += share * p->open[sample];
        }
    }
}

/* Barycentric coordinates of a point on a triangle. */
static void corner_shares(float out[3], const lmb_vec3 p[3], lmb_vec3 at)
{
    const lmb_vec3 a = {p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z},
                   b = {p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z},
                   c = {at.x - p[0].x, at.y - p[0].y, at.z - p[0].z};
    const float aa = hidden_dot(a, a), ab = hidden_dot(a, b), bb = hidden_dot(b, b), ac = hidden_dot(a, c),
                bc = hidden_dot(b, c), whole = aa * bb - ab * ab, per = whole > 0.0f ? 1.0f / whole : 0.0f;
    const float s = fminf(fmaxf((bb * ac - ab * bc) * per, 0.0f), 1.0f),
                t = fminf(fmaxf((aa * bc - ab * ac) * per, 0.0f), 1.0f - s);
    out[0] = 1.0f - s - t;
    out[1] = s;
    out[2] = t;
}

/* The unoccluded share of pixel k's mirror direction, blended with that of uniform light by roughness. */
static float pixel_open(const contact *c, const figures *f, const lmb_tile *tile, int k, const lmb_instance *in,
                        const uint16_t near[4], const float weight[4], float alpha)
{
    const uint32_t instance = (uint32_t)(in - f->instances), triangle = tile->id[k] - in->first_id;
    const hidden_part *p = &c->hidden.part[instance % c->hidden.parts];
    const lmb_vec3 foot = c->foot[instance / c->hidden.parts],
                   at = {tile->position[0][k] - foot.x, tile->position[1][k] - foot.y, tile->position[2][k] - foot.z};
    uint32_t vertex[3];
    lmb_vec3 corner[3];
    float share[3], mirrored = 0.0f, all = 0.0f;
    for (uint32_t i = 0; i < 3; ++i) {
        vertex[i] = hidden_vertex(&p->mesh, 3 * triangle + i);
        corner[i] = p->at[vertex[i]];
    }
    corner_shares(share, corner, at);
    for (int i = 0; i < 3; ++i) {
        float own, whole;
        vertex_open(&own, &whole, p, vertex[i], near, weight);
        mirrored += share[i] * own;
        all += share[i] * whole;
    }
    return mirrored + alpha * (all - mirrored);
}

/* The mirror direction. */
static lmb_vec3 mirrored_at(const lmb_tile *tile, const lmb_glossy *glossy, int k)
{
    const lmb_vec3 n = {tile->normal[0][k], tile->normal[1][k], tile->normal[2][k]},
                   v = {glossy->towards[0][k], glossy->towards[1][k], glossy->towards[2][k]};
    const float twice = 2.0f * hidden_dot(n, v);
    return (lmb_vec3){twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z};
}

static void darken_lobe(float rgb[3], const contact *c, const figures *f, const lmb_tile *tile,
                        const lmb_glossy *glossy, int k, const lmb_instance *in)
{
    const uint32_t instance = (uint32_t)(in - f->instances);
    const lmb_vec3 r = mirrored_at(tile, glossy, k);
    uint16_t near[4];
    float weight[4], ground[3] = {1.0f, 1.0f, 1.0f};
    region_directions(near, weight, c->fold, r);
    const float open = pixel_open(c, f, tile, k, in, near, weight, sqrtf(glossy->alpha2[k]));
    if (r.y < -HIDDEN_LOWEST) {
        const float far = (c->ground_y - tile->position[1][k]) / r.y;
        contact_ground_left(ground, c, tile->position[0][k] + far * r.x, tile->position[2][k] + far * r.z);
    }
    for (int h = 0; h < 3; ++h) {
        float back = 0.0f;
        for (int i = 0; i < 4; ++i) {
            back += weight[i] * c->lights[instance / c->hidden.parts].light[near[i]].back[h];
        }
        rgb[h] = open * ground[h] * rgb[h] + (1.0f - open) * glossy->specular[h][k] * back;
    }
}

/* Adds a band's lobes to the picture; `rows` has them without occlusion. */
static void add_lobes(const contact *c, const figures *f, const lmb_relight *r, lmb_relight_scratch *s,
                      const float *rows, const lmb_surface *out, int32_t x0, int32_t y0)
{
    const lmb_instance *in = f->instances;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = x0 + k % LMB_TILE, y = k / LMB_TILE;
        float rgb[3], *to = (float *)(void *)((uint8_t *)out->data + (y0 + y) * out->stride_bytes) + 3 * x;
        if (!(s->glossy.pixels >> k & 1) || x >= out->width || y0 + y >= out->height) {
            continue;
        }
        while (s->tile.id[k] < in->first_id ||
               s->tile.id[k] - in->first_id >= f->scene.meshes[in->mesh].triangle_count) {
            in = s->tile.id[k] < in->first_id ? f->instances : in + 1;
        }
        memcpy(rgb, rows + 3 * (y * out->width + x), sizeof rgb);
        darken_lobe(rgb, c, f, &s->tile, &s->glossy, k, in);
        for (int h = 0; h < 3; ++h) {
            to[h] = (r->show == LMB_RELIGHT_GLOSSY ? 0.0f : to[h]) + rgb[h];
        }
    }
}

static lmb_status lobes_of_band(const contact *c, const figures *f, const lmb_relight *r, lmb_relight_scratch *s,
                                float *rows, const lmb_surface *out, int32_t band)
{
    lmb_relight glossy = *r;
    lmb_surface eight = *out;
    eight.data = rows;
    eight.height = LMB_TILE;
    eight.stride_bytes = out->width * 3 * (int32_t)sizeof(float);
    glossy.show = LMB_RELIGHT_GLOSSY;
    lmb_status status = lmb_relight_band(&glossy, s, &eight, band);
    if (r->show == LMB_RELIGHT_GLOSSY && status == LMB_OK) {
        status = lmb_relight_band(&glossy, s, out, band); /* including the background */
    }
    for (int32_t x = 0; x < out->width && status == LMB_OK; x += LMB_TILE) {
        status = lmb_resolve_tile(&s->tile, r->kernels, &r->view, r->scene, &r->eye, x, band * LMB_TILE);
        if (status == LMB_OK && lmb_glossy_tile(&s->glossy, &s->tile, &r->view, r->scene)) {
            add_lobes(c, f, r, s, rows, out, x, band * LMB_TILE);
        }
    }
    return status;
}

lmb_status contact_band(const contact *c, const figures *f, const ground_lights *g, const lmb_relight *r,
                        lmb_relight_scratch *scratch, float *rows, const lmb_surface *out, int32_t band)
{
    lmb_status status = LMB_OK;
    if (r->show != LMB_RELIGHT_GLOSSY) {
        lmb_relight matte = *r;
        matte.show = LMB_RELIGHT_NORMAL;
        status = lmb_relight_band(&matte, scratch, out, band);
        status = status == LMB_OK ? ground_band(g, c, r, scratch, out, band) : status;
    }
    return status != LMB_OK || r->show == LMB_RELIGHT_NORMAL ? status
                                                             : lobes_of_band(c, f, r, scratch, rows, out, band);
}
