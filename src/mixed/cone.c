/* cone.c: cones over the hemisphere and along the mirrored view, through voxels and environment. Layer 6. [M20-M22] */
#include <string.h>

#include "../base/poly.h"
#include "../lane/kernels.h"
#include "../raster/tile.h"
#include "octree.h"

#if LMB_VOXELS

/* --- steps -------------------------------------------------------------------------------------------------------- */

/* A cone is 2 t tan wide at distance t. It reads voxels width_share as wide, but at least leaves; interpolation blurs
 * by as much again. Steps are as long as these voxels are wide: the longest without gaps, because the weights between
 * middles add up to 1. cover_share: inside a wall a cone keeps widening, so the wall's coverage adds up to 0.75 .. 1.3,
 * depending on the wall's position in its voxels. Coverage over 1 is lost, so a factor of 1.15 comes nearest to 1 in
 * the mean. A closed room then leaves 11 % open (18 % with 1, 10 % with 1.2), but a sphere's shadow grows with the
 * factor. */
static const float step_share = 1.0f, width_share = 0.5f, cover_share = 1.15f;

static int set_steps(lmb_cone_width *out, const lmb_voxels *v)
{
    const float end = 1.7320508f * (float)(1 << v->depth), tangent = out->tangent;
    const float share = minf(step_share, 0.5f / (tangent * width_share));
    float t = 0.0f;
    for (out->count = 0; t < end; ++out->count) {
        if (out->count == LMB_CONE_STEPS) {
            return 0;
        }
        lmb_cone_step *s = &out->step[out->count];
        const float middle = maxf(t / (1.0f - share * tangent * width_share), t + 0.5f * share);
        const float level = clampf(lmb_log2(maxf(2.0f * middle * tangent * width_share, 1.0f)), 0.0f,
                                   (float)(v->depth - 1));
        s->apart = 2.0f * middle * tangent * width_share > 1.0f ? 1.0f / middle : 0.0f;
        s->level = mini((int32_t)level, v->depth - 2);
        s->finer = 1.0f - (level - (float)s->level);
        s->at = middle * v->leaf;
        s->length = 2.0f * (middle - t) * cover_share;
        t += 2.0f * (middle - t);
    }
    return 1;
}

lmb_status lmb_cone_width_init(lmb_cone_width *out, const lmb_voxels *v, float tangent)
{
    if (out == NULL || v == NULL || v->count == 0 || !(tangent >= 0.01f) || !(tangent <= 2.0f)) {
        return LMB_ERR_ARG;
    }
    for (out->tangent = tangent; !set_steps(out, v);) {
        out->tangent *= 1.25f;
    }
    return LMB_OK;
}

float lmb_cone_tangent(float roughness)
{
    const float r = clampf(roughness, 0.0f, 1.0f), alpha = maxf(r * r, LMB_MIN_ALPHA);
    return alpha < 0.41421356f ? 2.0f * alpha / (1.0f - alpha * alpha) : 1.0f;
}

/* --- the hemisphere ----------------------------------------------------------------------------------------------- */

/* Irradiance is pi times the mean of radiance over the unit disc below the hemisphere. The disc is cut into rings of 1,
 * 6, 12, 18 cells of equal area: n cones, each pi / n of the whole. Ring i lies between radii a and b; a^2 and b^2 are
 * the shares of cells inside it, without and with the ring. On the hemisphere these radii have cosines sqrt(1 - a^2)
 * and sqrt(1 - b^2), so each of the ring's m cells has a solid angle of 2 pi (cos_a - cos_b) / m. A cone of half angle
 * w has 2 pi (1 - cos w). The axis goes through the centroid of the cell's area, 2/3 (b^3 - a^3) / (b^2 - a^2) from the
 * disc's middle. */
static void set_ring(lmb_cones *out, const lmb_voxels *v, int32_t ring, int32_t *first)
{
    const int32_t cells = ring == 0 ? 1 : 6 * ring;
    const float all = (float)out->count, a2 = (float)*first / all, b2 = (float)(*first + cells) / all;
    const float a = sqrtf(a2), b = sqrtf(b2);
    const float solid = (sqrtf(1.0f - a2) - sqrtf(maxf(1.0f - b2, 0.0f))) / (float)cells, cosine = 1.0f - solid;
    const float sine = ring == 0 ? 0.0f : 2.0f / 3.0f * (b2 * b - a2 * a) / (b2 - a2);
    lmb_cone_width_init(&out->width[ring], v, sqrtf(1.0f - cosine * cosine) / cosine);
    for (int32_t i = 0; i < cells; ++i) {
        const float turn = 2.0f * LMB_PI * ((float)i + 0.5f * (float)(ring & 1)) / (float)cells;
        float *d = out->direction[*first + i];
        out->ring[*first + i] = ring;
        d[0] = sine * lmb_cos(turn);
        d[1] = sine * lmb_sin(turn);
        d[2] = sqrtf(1.0f - sine * sine);
    }
    *first += cells;
}

lmb_status lmb_cones_init(lmb_cones *out, const lmb_voxels *v, int32_t count)
{
    if (out == NULL || v == NULL || v->count == 0 || (count != 7 && count != 19 && count != 37)) {
        return LMB_ERR_ARG;
    }
    int32_t first = 0;
    memset(out, 0, sizeof *out);
    out->count = count;
    for (int32_t ring = 0; first < count; ++ring) {
        set_ring(out, v, ring, &first);
    }
    return LMB_OK;
}

/* --- tracing ------------------------------------------------------------------------------------------------------ */

static int is_trace_valid(const lmb_cone_trace *t)
{
    return t != NULL && t->kernels != NULL && t->voxels != NULL && t->voxels->count > 0 && t->field >= 0 &&
           t->field < LMB_VOXELS_THREE && t->voxels->light[t->field] != NULL && t->world >= 0 &&
           t->world < t->voxels->worlds && t->scratch != NULL;
}

static void follow(lmb_cone_seen *out, const lmb_cone_trace *trace, const lmb_cone_width *width, const lmb_tile *tile,
                   float direction[3][LMB_TILE_PIXELS])
{
    const lmb_voxels *v = trace->voxels;
    lmb_cone_job job;
    job.child = v->child;
    job.cover = v->cover[trace->world];
    job.light = v->light[trace->field];
    job.step = width->step;
    job.steps = width->count;
    job.depth = v->depth;
    job.low = v->low;
    job.leaf = v->leaf;
    job.per_leaf = 1.0f / v->leaf;
    job.faced = trace->faced;
    trace->kernels->cone(out, &job, tile, direction);
}

/* The open part of the cone sees the environment, filtered to the cone's width. [M22] */
static void finish_cone(lmb_cone_seen *inout, const lmb_cone_trace *trace, float tangent, const lmb_tile *tile,
                        float direction[3][LMB_TILE_PIXELS])
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int there = tile->depth[k] > 0.0f;
        inout->open[k] = there ? inout->open[k] : 0.0f;
        float sky[3] = {0.0f, 0.0f, 0.0f};
        if (trace->env != NULL && inout->open[k] > 0.0f) {
            lmb_env_sample(sky, trace->env, tile_vec((const float(*)[LMB_TILE_PIXELS])direction, k), tangent);
        }
        for (int c = 0; c < 3; ++c) {
            inout->rgb[c][k] = there ? inout->rgb[c][k] + inout->open[k] * sky[c] : 0.0f;
        }
    }
}

lmb_status lmb_cones_trace(lmb_cone_seen *out, const lmb_cone_trace *trace, const lmb_cone_width *width,
                           const lmb_tile *tile, float direction[3][LMB_TILE_PIXELS])
{
    if (out == NULL || !is_trace_valid(trace) || width == NULL || tile == NULL || direction == NULL) {
        return LMB_ERR_ARG;
    }
    follow(out, trace, width, tile, direction);
    finish_cone(out, trace, width->tangent, tile, direction);
    return LMB_OK;
}

/* Sets tangents: perpendicular to the normal and to the axis least aligned with it. */
static void set_tangents(float out[3][LMB_TILE_PIXELS], const lmb_tile *tile)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 n = tile_vec(tile->normal, k);
        const float x = absf(n.x), y = absf(n.y), z = absf(n.z);
        const lmb_vec3 axis = x <= y && x <= z ? vec3(1, 0, 0) : y <= z ? vec3(0, 1, 0) : vec3(0, 0, 1);
        tile_set_vec(out, k, normalize3(cross3(axis, n)));
    }
}

static void aim(float out[3][LMB_TILE_PIXELS], const lmb_tile *tile, float tangent[3][LMB_TILE_PIXELS],
                const float along[3])
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 n = tile_vec(tile->normal, k), u = tile_vec((const float(*)[LMB_TILE_PIXELS])tangent, k);
        const lmb_vec3 d = add3(add3(mul3(u, along[0]), mul3(cross3(n, u), along[1])), mul3(n, along[2]));
        tile_set_vec(out, k, d);
    }
}

lmb_status lmb_cones_diffuse(lmb_irradiance *inout, float open[LMB_TILE_PIXELS], const lmb_cone_trace *trace,
                             const lmb_cones *cones, const lmb_tile *tile)
{
    if (inout == NULL || !is_trace_valid(trace) || cones == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    const float share = 1.0f / (float)cones->count;
    lmb_cone_scratch *s = trace->scratch;
    if (open != NULL) {
        memset(open, 0, LMB_TILE_PIXELS * sizeof *open);
    }
    set_tangents(s->tangent, tile);
    for (int32_t i = 0; i < cones->count; ++i) {
        const lmb_cone_width *width = &cones->width[cones->ring[i]];
        aim(s->direction, tile, s->tangent, cones->direction[i]);
        follow(&s->seen, trace, width, tile, s->direction);
        finish_cone(&s->seen, trace, width->tangent, tile, s->direction);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            for (int c = 0; c < 3; ++c) {
                inout->rgb[c][k] += LMB_PI * share * s->seen.rgb[c][k];
            }
            if (open != NULL) {
                open[k] += share * s->seen.open[k];
            }
        }
    }
    return LMB_OK;
}

lmb_status lmb_cones_glossy(lmb_cone_seen *out, const lmb_cone_trace *trace, const lmb_cone_width *width,
                            const lmb_tile *tile, lmb_vec3 eye)
{
    if (out == NULL || !is_trace_valid(trace) || width == NULL || tile == NULL) {
        return LMB_ERR_ARG;
    }
    float (*direction)[LMB_TILE_PIXELS] = trace->scratch->direction;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 n = tile_vec(tile->normal, k), d = normalize3(sub3(tile_vec(tile->position, k), eye));
        tile_set_vec(direction, k, sub3(d, mul3(n, 2.0f * dot3(n, d))));
    }
    follow(out, trace, width, tile, direction);
    finish_cone(out, trace, width->tangent, tile, direction);
    return LMB_OK;
}

#endif
