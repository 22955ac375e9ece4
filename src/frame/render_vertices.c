/* render_vertices.c: a frame's light at vertices, for lmb_draw_list. Layer 8.
 *
 * Vertices are the pixels of a scattered tile, without a triangle. A vertex without a normal gets the mean of the light
 * on all planes through it. A light contributes a quarter of the irradiance of a plane that faces the light: the mean
 * of a clamped cosine over all directions. Other light is averaged over six planes. */
#include <string.h>

#include "../base/codec.h"
#include "../base/light_kind.h"
#include "../base/poly.h"
#include "../base/vec.h"
#include "../draw/draw_part.h"
#include "../direct/light_tile.h"
#include "../raster/tile.h"
#include "requires.h"
#include "stages.h"

#if LMB_DRAW
#define VERTEX_ID 0xffffffffu /* no triangle: the vertex lies on none */

typedef struct vertex_job {
    const lmb_render *r;
    lmb_band_scratch *s;
    const lmb_draw_vertices *vertices;
    const float *normals;
    const lmb_mat4 *to_world;
    lmb_vec3 turn[3]; /* rotates normals */
} vertex_job;

static void vertex_face(lmb_tile *tile, int k, lmb_vec3 n)
{
    tile_set_vec(tile->face, k, n);
    tile_set_vec(tile->normal, k, n);
}

/* Sets the tile's pixels to vertices first .. first + n - 1. */
static void vertex_take(const vertex_job *j, uint32_t first, int n)
{
    const lmb_view *view = &j->r->frame.view;
    lmb_tile *tile = &j->s->together;
    memset(tile, 0, sizeof *tile);
    for (int k = 0; k < n; ++k) {
        const lmb_vec3 at = transform_point(j->to_world, lmb_draw_position(j->vertices, first + (uint32_t)k));
        lmb_vec3 normal = vec3(0.0f, 0.0f, 1.0f);
        if (j->normals != NULL) {
            const float *p = j->normals + 3 * ((size_t)first + (size_t)k);
            normal = normalize3(add3(add3(mul3(j->turn[0], p[0]), mul3(j->turn[1], p[1])), mul3(j->turn[2], p[2])));
        }
        if (is_place(at) && is_place(normal) && dot3(normal, normal) > 0.5f) {
            tile_set_vec(tile->position, k, at);
            tile->depth[k] = absf(dot3(view->back, sub3(at, view->eye)));
            tile->id[k] = VERTEX_ID;
            vertex_face(tile, k, normal);
            ++tile->hits;
        }
    }
}

static void vertex_add(lmb_radiance *sum, const lmb_irradiance *light, float share)
{
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            sum->rgb[c][k] += share * light->rgb[c][k];
        }
    }
}

static lmb_status vertex_add_bounced(const vertex_job *j, float share)
{
    lmb_band_scratch *s = j->s;
    s->saved_tests = 0;
    memset(&s->indirect, 0, sizeof s->indirect);
    const lmb_status status = lmb_render_gather(&s->indirect, NULL, j->r, s, &s->together, NULL);
    vertex_add(&s->radiance, &s->indirect, share);
    return status;
}

/* Adds lights with shadow maps. Vertices without normals face each light. */
static lmb_status vertex_add_lamps(const vertex_job *j)
{
    const lmb_frame *f = &j->r->frame;
    lmb_band_scratch *s = j->s;
    const lmb_tile *tile = &s->together;
    const light_tile lit = {f->kernels, f->scene, &f->view, tile};
    lmb_status status = LMB_OK;
    memset(&s->direct, 0, sizeof s->direct);
    for (uint32_t i = 0; requires_direct(f) && i < f->scene->light_count && status == LMB_OK; ++i) {
        const lmb_light *light = &f->scene->lights[i];
        for (int k = 0; k < LMB_TILE_PIXELS && j->normals == NULL; ++k) {
            vertex_face(&s->together, k,
                        light_kind_is(light->kind, LIGHT_FAR)
                            ? mul3(light->direction, -1.0f)
                            : normalize3(sub3(light->position, tile_vec(tile->position, k))));
        }
        if (!light_is(j->r, i, LMB_LIGHT_DARK)) {
            status = lmb_light_tile_add(&s->direct, NULL, &s->indirect, &lit, i, &j->r->maps[i]);
        }
    }
    vertex_add(&s->radiance, &s->direct, j->normals != NULL ? 1.0f : 0.25f);
    return status;
}

static lmb_status vertex_add_many_lights(const vertex_job *j, float share)
{
    const lmb_frame *f = &j->r->frame;
    lmb_band_scratch *s = j->s;
    const lmb_many_lights_query query = {
        f->many_lights, f->bvh.triangle != NULL ? &f->bvh : NULL, f->many_lights_error, 1, 0, &s->counts};
    memset(&s->direct, 0, sizeof s->direct);
    const lmb_status status =
        requires_many_lights(f)
            ? lmb_many_lights_direct_tile(&s->direct, f->kernels, &s->many_lights, &s->together, &query)
            : LMB_OK;
    vertex_add(&s->radiance, &s->direct, share);
    return status;
}

/* Sets s->radiance to the irradiance of the tile's pixels. */
static lmb_status vertex_light(const vertex_job *j)
{
    lmb_band_scratch *s = j->s;
    memset(&s->radiance, 0, sizeof s->radiance);
    lmb_status status = vertex_add_lamps(j);
    if (j->normals != NULL) {
        status = status == LMB_OK ? vertex_add_bounced(j, 1.0f) : status;
        return status == LMB_OK ? vertex_add_many_lights(j, 1.0f) : status;
    }
    for (int side = 0; side < 6 && status == LMB_OK; ++side) {
        const float to = side % 2 == 0 ? 1.0f : -1.0f;
        const lmb_vec3 n = vec3(side / 2 == 0 ? to : 0.0f, side / 2 == 1 ? to : 0.0f, side / 2 == 2 ? to : 0.0f);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            vertex_face(&s->together, k, n);
        }
        status = vertex_add_bounced(j, 1.0f / 6.0f);
        status = status == LMB_OK ? vertex_add_many_lights(j, 1.0f / 6.0f) : status;
    }
    return status;
}

static void vertex_show(uint8_t *colours, const vertex_job *j, uint32_t first, int n)
{
    static const uint8_t white[4] = {255, 255, 255, 255};
    const float gain = lmb_exp2(j->r->frame.exposure_ev) * (1.0f / LMB_PI);
    for (int k = 0; k < n; ++k) {
        const size_t at = 4 * ((size_t)first + (size_t)k);
        uint8_t own[4];
        memcpy(own, j->vertices->colours != NULL ? j->vertices->colours + at : white, sizeof own);
        for (int c = 0; c < 3; ++c) {
            colours[at + (size_t)c] = lmb_srgb_encode(lmb_srgb_decode(own[c]) * (j->s->radiance.rgb[c][k] * gain));
        }
        colours[at + 3] = own[3];
    }
}

static int vertex_is_matrix(const lmb_mat4 *m)
{
    int good = 1;
    for (int i = 0; i < 16; ++i) {
        good &= m->m[i] > -1e15f && m->m[i] < 1e15f;
    }
    return good;
}

static lmb_status vertex_check(const uint8_t *colours, const lmb_render *r, const lmb_band_scratch *scratch,
                               const lmb_draw_vertices *v, const float *normals, const lmb_mat4 *to_world)
{
    if (colours == NULL || r == NULL || scratch == NULL || v == NULL || to_world == NULL ||
        r->stage < LMB_STAGE_BANDS || lacks_live(&r->frame, scratch) || !vertex_is_matrix(to_world)) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = lmb_draw_check_vertices(v);
    return status == LMB_OK && (uintptr_t)normals % sizeof *normals != 0 ? LMB_ERR_ALIGN
           : status == LMB_OK                                            ? r->failed
                                                                         : status;
}

lmb_status lmb_render_vertices(uint8_t *colours, const lmb_render *r, lmb_band_scratch *scratch,
                               const lmb_draw_vertices *v, const float *normals, const lmb_mat4 *to_world)
{
    lmb_status status = vertex_check(colours, r, scratch, v, normals, to_world);
    if (status != LMB_OK) {
        return status;
    }
    const float *m = to_world->m, sign = is_mirrored(to_world) ? -1.0f : 1.0f;
    const lmb_vec3 x = vec3(m[0], m[1], m[2]), y = vec3(m[4], m[5], m[6]), z = vec3(m[8], m[9], m[10]);
    const vertex_job j = {r, scratch, v, normals, to_world,
                          {mul3(cross3(y, z), sign), mul3(cross3(z, x), sign), mul3(cross3(x, y), sign)}};
    for (uint32_t first = 0; first < v->count && status == LMB_OK; first += LMB_TILE_PIXELS) {
        const int n = (int)(v->count - first < LMB_TILE_PIXELS ? v->count - first : LMB_TILE_PIXELS);
        vertex_take(&j, first, n);
        status = vertex_light(&j);
        if (status == LMB_OK) {
            vertex_show(colours, &j, first, n);
        }
    }
    return status;
}
#endif
