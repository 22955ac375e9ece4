/* relight_shade.c: the ground in a picture, darkened by objects. */
#include "relight_shade.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "relight_contact.h"

#define FARTHEST 1e5f /* m: the ground beyond is not darkened */

int ground_lights_take(ground_lights *g, const figures *f, relight_light *w, const relight_options *o, report *r)
{
    if (o->light_count == 0 || !relight_has_ground(o)) {
        return 1;
    }
    if (g->foot == NULL) {
        g->foot = malloc(f->count * sizeof *g->foot);
        g->rgb = malloc(f->count * sizeof *g->rgb);
    }
    far_lights *lights = malloc(sizeof *lights);
    int ok = g->foot != NULL && g->rgb != NULL && lights != NULL;
    g->ground_y = o->place.ground_y;
    for (uint32_t i = 0; ok && i < f->count; ++i) {
        g->foot[i] = hidden_foot(f, i);
        ok = figure_light(lights, f, i, w, o);
        if (ok) {
            ground_light(g->rgb[i], lights);
        }
    }
    free(lights);
    g->figures = f->count;
    return ok || report_fail(r, "%s: out of memory", o->object);
}

void ground_lights_free(ground_lights *g)
{
    free(g->foot);
    free(g->rgb);
}

/* The world's light at a place, interpolated between figures by inverse squared distance. */
static void light_at(float out[3], const ground_lights *g, float x, float z)
{
    float all = 0.0f;
    out[0] = out[1] = out[2] = 0.0f;
    for (uint32_t i = 0; i < g->figures; ++i) {
        const float dx = x - g->foot[i].x, dz = z - g->foot[i].z, weight = 1.0f / (dx * dx + dz * dz + 1e-6f);
        all += weight;
        for (int k = 0; k < 3; ++k) {
            out[k] += weight * g->rgb[i][k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        out[k] /= all;
    }
}

/* Intersects the ray of a pixel's sample with the ground. Returns 1, or 0 if it misses. */
static int meet(float out[3], const lmb_view *v, int32_t x, int32_t y, float ground_y)
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
    out[2] = far; /* along the view's axis */
    return along.y < 0.0f && far > 0.0f;
}

/* Collects a tile's pixels that show the ground. */
static int take_ground(lmb_tile *t, const lmb_relight *r, int32_t x0, int32_t y0, float ground_y)
{
    const lmb_surface *id = &r->eye.id;
    const int32_t tiles = (id->width + LMB_TILE - 1) / LMB_TILE;
    const uint32_t *ids =
        (const uint32_t *)id->data + (size_t)(y0 / LMB_TILE * tiles + x0 / LMB_TILE) * LMB_TILE_PIXELS;
    memset(t, 0, sizeof *t);
    t->x = x0;
    t->y = y0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = x0 + k % LMB_TILE, y = y0 + k / LMB_TILE;
        float place[3];
        if (ids[k] == 0 && x < id->width && y < id->height && meet(place, &r->view, x, y, ground_y) &&
            place[2] < FARTHEST) {
            t->position[0][k] = place[0];
            t->position[1][k] = ground_y;
            t->position[2][k] = place[1];
            t->normal[1][k] = t->face[1][k] = 1.0f;
            t->depth[k] = place[2];
            t->id[k] = lmb_scene_triangles(r->scene) + 1; /* an id outside the scene */
            ++t->hits;
        }
    }
    return t->hits > 0;
}

/* The share of the ground's light left, of given lights and the world. */
static void ground_share(float left[3], const ground_lights *g, const lmb_irradiance *all, const lmb_irradiance *lit,
                         const lmb_tile *t, int k)
{
    float world[3];
    light_at(world, g, t->position[0][k], t->position[2][k]);
    for (int c = 0; c < 3; ++c) {
        const float sum = world[c] + all->rgb[c][k];
        left[c] = sum > 0.0f ? (left[c] * world[c] + lit->rgb[c][k]) / sum : 1.0f;
    }
}

static lmb_status ground_tile(const ground_lights *g, const contact *c, const lmb_relight *r, lmb_relight_scratch *s,
                              const lmb_surface *out)
{
    lmb_status status = LMB_OK;
    memset(&s->light, 0, sizeof s->light);
    memset(&s->one, 0, sizeof s->one);
    for (uint32_t i = 0; g->figures > 0 && i < r->scene->light_count && status == LMB_OK; ++i) {
        const lmb_light *l = &r->scene->lights[i];
        status = lmb_direct_tile(&s->one, r->kernels, &s->tile, &r->view, r->scene, l, NULL);
        if (status == LMB_OK) {
            status = lmb_direct_tile(&s->light, r->kernels, &s->tile, &r->view, r->scene, l,
                                     r->maps != NULL ? &r->maps[i] : NULL);
        }
    }
    for (int k = 0; k < LMB_TILE_PIXELS && status == LMB_OK; ++k) {
        float left[3] = {1.0f, 1.0f, 1.0f};
        if (s->tile.id[k] == 0) {
            continue;
        }
        float *rgb = (float *)(void *)((uint8_t *)out->data + (s->tile.y + k / LMB_TILE) * out->stride_bytes) +
                     3 * (s->tile.x + k % LMB_TILE);
        if (c != NULL) {
            contact_ground_left(left, c, s->tile.position[0][k], s->tile.position[2][k]);
        }
        if (g->figures > 0) {
            ground_share(left, g, &s->one, &s->light, &s->tile, k);
        }
        for (int h = 0; h < 3; ++h) {
            rgb[h] *= left[h];
        }
    }
    return status;
}

lmb_status ground_band(const ground_lights *g, const contact *c, const lmb_relight *r, lmb_relight_scratch *scratch,
                       const lmb_surface *out, int32_t band)
{
    lmb_status status = LMB_OK;
    const float ground_y = g->figures > 0 ? g->ground_y : c != NULL ? c->ground_y : 0.0f;
    const int has_ground = g->figures > 0 || (c != NULL && c->grounds != NULL);
    for (int32_t x = 0; has_ground && x < out->width && status == LMB_OK; x += LMB_TILE) {
        if (take_ground(&scratch->tile, r, x, band * LMB_TILE, ground_y)) {
            status = ground_tile(g, c, r, scratch, out);
        }
    }
    return status;
}
