/* explain_light.c: the lights of a place, and the surfaces that send light to it, by rays from the place. */
#include "explain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

#define PI 3.14159265358979

static const float FAR_M = 3.0e38f;

int explain_space_make(explain_space *s, const lmb_scene *scene, const lmb_kernels *kernels, report *r)
{
    memset(s, 0, sizeof *s);
    s->kernels = kernels;
    s->tile = calloc(1, sizeof *s->tile);
    return s->tile != NULL ? ray_space_make(&s->rays, scene, r)
                           : report_fail(r, "not enough memory to trace the scene");
}

void explain_space_free(explain_space *s)
{
    free(s->tile);
    ray_space_free(&s->rays);
}

lmb_vec3 explain_light_at(float out[3], float *far_m, const lmb_light *l, lmb_vec3 at, lmb_vec3 normal)
{
    const int is_far = l->kind == LMB_LIGHT_DIRECTIONAL;
    const lmb_vec3 way = is_far ? mul3(l->direction, -1.0f) : sub3(l->position, at);
    const double far2 = (double)dot3(way, way), distance = sqrt(far2);
    const lmb_vec3 to = far2 > 0.0 ? mul3(way, (float)(1.0 / distance)) : normal;
    double share = fmax((double)dot3(to, normal), 0.0);
    *far_m = is_far ? 0.0f : (float)distance;
    if (!is_far) {
        share /= fmax(far2, 1e-20);
        if (l->range > 0.0f && l->range < 1073741824.0f) {
            const double part = distance / (double)l->range;
            share *= fmax(1.0 - part * part * part * part, 0.0);
        }
    }
    if (l->kind == LMB_LIGHT_SPOT) {
        const double cosine = -(double)dot3(to, l->direction), wide = (double)l->cos_inner - (double)l->cos_outer;
        const double t = wide > 0.0 ? fmin(fmax((cosine - (double)l->cos_outer) / wide, 0.0), 1.0)
                                    : cosine >= (double)l->cos_outer;
        share *= t * t * (3.0 - 2.0 * t);
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = (float)(share * (double)l->intensity[c]);
    }
    return to;
}

/* Returns a bit for each point of s->tile that a light does not reach. `noise` is the largest of the points. */
static uint64_t blocked_by(explain_space *s, const lmb_light *l, uint64_t points, float noise)
{
    if (l->kind == LMB_LIGHT_DIRECTIONAL) {
        return lmb_occluded_sun(s->kernels, &s->traversal, &s->rays.bvh, s->tile, points, mul3(l->direction, -1.0f));
    }
    return lmb_occluded_tile(s->kernels, &s->traversal, &s->rays.bvh, s->tile, points, l->position,
                             noise + lmb_place_noise(l->position, 0.0f));
}

/* Puts a place into the tile. lmb_occluded_sun takes the rounding of a place from its depth. */
static void put_place(lmb_tile *tile, int k, const explain_place *p)
{
    const float at[3] = {p->at.x, p->at.y, p->at.z}, face[3] = {p->face.x, p->face.y, p->face.z};
    const float normal[3] = {p->normal.x, p->normal.y, p->normal.z};
    for (int c = 0; c < 3; ++c) {
        tile->position[c][k] = at[c];
        tile->face[c][k] = face[c];
        tile->normal[c][k] = normal[c];
    }
    tile->depth[k] = p->depth;
    tile->id[k] = p->id;
    tile->hits = k + 1;
}

static float sum_of(const float c[3]) { return c[0] + c[1] + c[2]; }

void explain_sky(double open[3], double seen[3], explain_space *s, const explain_place *p)
{
    memset(s->tile, 0, sizeof *s->tile);
    put_place(s->tile, 0, p);
    for (int c = 0; c < 3; ++c) {
        open[c] = seen[c] = 0.0;
    }
    for (uint32_t i = 0; i < s->sky_count; ++i) {
        float part[3], far_m;
        const lmb_vec3 to = explain_light_at(part, &far_m, &s->sky[i], p->at, p->normal);
        if (!(sum_of(part) > 0.0f) || !(dot3(to, p->face) > 0.0f)) {
            continue;
        }
        const int is_blocked = blocked_by(s, &s->sky[i], 1, p->noise) != 0;
        for (int c = 0; c < 3; ++c) {
            open[c] += (double)part[c];
            seen[c] += is_blocked ? 0.0 : (double)part[c];
        }
    }
}

void explain_lights(explain_light *out, explain_space *s, const explain_place *p)
{
    memset(s->tile, 0, sizeof *s->tile);
    put_place(s->tile, 0, p);
    for (uint32_t i = 0; i < s->rays.scene->light_count; ++i) {
        const lmb_light *l = &s->rays.scene->lights[i];
        explain_light *e = &out[i];
        memset(e, 0, sizeof *e);
        e->number = i;
        const lmb_vec3 to = explain_light_at(e->open, &e->far_m, l, p->at, p->normal);
        const float reach = l->kind == LMB_LIGHT_DIRECTIONAL ? FAR_M : e->far_m;
        e->angle_deg = (float)(acos(fmin(fmax((double)dot3(to, p->normal), -1.0), 1.0)) * 180.0 / PI);
        e->is_behind = !(dot3(to, p->normal) > 0.0f) || !(dot3(to, p->face) > 0.0f);
        if (e->is_behind || !(sum_of(e->open) > 0.0f)) {
            continue;
        }
        e->is_blocked = blocked_by(s, l, 1, p->noise) != 0;
        if (e->is_blocked) {
            const uint32_t found = ray_nearest(&e->blocker_m, &s->rays, p->at, to, p->noise, reach);
            e->blocker = found > 0 ? s->rays.bvh.triangle[found - 1].id & ~LMB_BVH_MASKED : 0;
        }
    }
}

/* --- surfaces that send light ------------------------------------------------------------------------------------- */

/* The diffuse albedo at a hit with these barycentric coordinates, and the emitted radiance, by level 0 of the textures:
 * rays average many texels. */
static void material_at(double albedo[3], double emission[3], const lmb_scene *scene, const lmb_triangle *t,
                        const double part[3])
{
    const lmb_material *m = t->material;
    float texture[4] = {1.0f, 1.0f, 1.0f, 1.0f}, glow[4] = {1.0f, 1.0f, 1.0f, 1.0f}, code[4];
    double uv[2] = {0.0, 0.0}, colour[3] = {0.0, 0.0, 0.0}, rest = 1.0; /* rest: the share that is no metal */
    for (uint32_t k = 0; k < 3; ++k) {
        lmb_vertex v;
        lmb_mesh_vertex(&v, t->mesh, t->vertex[k]);
        uv[0] += part[k] * (double)v.uv[0];
        uv[1] += part[k] * (double)v.uv[1];
        for (size_t c = 0; c < 3; ++c) {
            colour[c] += part[k] * (double)v.colour[c];
        }
    }
    if (m->texture >= 0) {
        lmb_texture_sample(texture, &scene->textures[m->texture], (float)uv[0], (float)uv[1], 0.0f);
    }
    if (m->emission_map > 0) {
        lmb_texture_sample(glow, &scene->textures[m->emission_map - 1], (float)uv[0], (float)uv[1], 0.0f);
    }
    if (m->metal_map > 0) {
        lmb_normal_map_sample(code, &scene->textures[m->metal_map - 1], (float)uv[0], (float)uv[1], 0.0f);
        rest = 1.0 - (double)fminf(m->metallic * fmaxf(0.5f + 0.5f * code[2], 0.0f), 1.0f);
    }
    for (int c = 0; c < 3; ++c) {
        albedo[c] = (double)m->albedo[c] * (double)texture[c] * colour[c] * rest;
        emission[c] = (double)m->emission[c] * (double)glow[c];
    }
}

/* Barycentric coordinates of a place on a triangle. */
static void parts_of(double out[3], const lmb_bvh_triangle *t, lmb_vec3 at)
{
    double area[3], all = 0.0;
    for (int k = 0; k < 3; ++k) {
        const lmb_vec3 a = sub3(t->corner[(k + 1) % 3], at), b = sub3(t->corner[(k + 2) % 3], at);
        area[k] = (double)dot3(cross3(a, b), t->normal);
        all += area[k];
    }
    for (int k = 0; k < 3; ++k) {
        out[k] = all != 0.0 ? area[k] / all : 1.0 / 3.0;
    }
}

/* Ray i of n over the half sphere: by the cosine, on a lattice of low discrepancy (Roberts' R2 sequence). */
static lmb_vec3 ray_of(uint32_t i, lmb_vec3 normal)
{
    const double u = fmod(0.5 + i * 0.7548776662466927, 1.0), v = fmod(0.5 + i * 0.5698402909980532, 1.0);
    const lmb_vec3 other = fabsf(normal.x) < 0.6f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
    lmb_vec3 x = cross3(other, normal);
    x = mul3(x, 1.0f / sqrtf(dot3(x, x)));
    const lmb_vec3 y = cross3(normal, x);
    const float a = (float)(sqrt(u) * cos(2.0 * PI * v)), b = (float)(sqrt(u) * sin(2.0 * PI * v));
    return add3(add3(mul3(x, a), mul3(y, b)), mul3(normal, (float)sqrt(1.0 - u)));
}

/* Up to 64 hits whose lights are tested together. */
typedef struct hits {
    explain_place place[LMB_TILE_PIXELS];
    float far_m[LMB_TILE_PIXELS];
    double part[LMB_TILE_PIXELS][3]; /* barycentric coordinates */
    int count;
} hits;

/* Adds the irradiance of one light, times `scale`, to each hit. */
static void add_light(double direct[][3], explain_space *s, const hits *h, const lmb_light *light,
                      const double scale[3], float noise)
{
    float open[LMB_TILE_PIXELS][3], far_m;
    uint64_t lit = 0;
    for (int k = 0; k < h->count; ++k) {
        explain_light_at(open[k], &far_m, light, h->place[k].at, h->place[k].face);
        lit |= (uint64_t)(sum_of(open[k]) > 0.0f) << k;
    }
    lit &= lit != 0 ? ~blocked_by(s, light, lit, noise) : 0;
    for (int k = 0; k < h->count; ++k) {
        for (int c = 0; c < 3 && (lit >> k & 1) != 0; ++c) {
            direct[k][c] += scale[c] * (double)open[k][c];
        }
    }
}

/* Adds a list of lights: only every nth of more than `max`, scaled so that the sum over the lights is kept. */
static void add_lights(double direct[][3], explain_space *s, const hits *h, const lmb_light *lights, uint32_t count,
                       uint32_t max, float noise)
{
    const uint32_t step = (count + max - 1) / max;
    double all[3] = {0.0, 0.0, 0.0}, some[3] = {0.0, 0.0, 0.0};
    for (uint32_t i = 0; i < count; ++i) {
        for (int c = 0; c < 3; ++c) {
            all[c] += (double)lights[i].intensity[c];
            some[c] += i % step == 0 ? (double)lights[i].intensity[c] : 0.0;
        }
    }
    for (int c = 0; c < 3; ++c) {
        all[c] = some[c] > 0.0 ? all[c] / some[c] : 1.0;
    }
    for (uint32_t i = 0; i < count; i += step) {
        add_light(direct, s, h, &lights[i], all, noise);
    }
}

/* Adds the light that these hits send towards the place to the sums of their instances. */
static void add_hits(explain_bounce *out, explain_space *s, const hits *h)
{
    double direct[LMB_TILE_PIXELS][3];
    float noise = 0.0f;
    memset(direct, 0, sizeof direct);
    memset(s->tile, 0, sizeof *s->tile);
    for (int k = 0; k < h->count; ++k) {
        put_place(s->tile, k, &h->place[k]);
        noise = fmaxf(noise, h->place[k].noise);
    }
    if (h->count > 0) {
        add_lights(direct, s, h, s->rays.scene->lights, s->rays.scene->light_count, EXPLAIN_TREE, noise);
        add_lights(direct, s, h, s->sky, s->sky_count, EXPLAIN_SKY, noise);
    }
    for (int k = 0; k < h->count; ++k) {
        lmb_triangle t;
        lmb_triangle_fetch(&t, s->rays.scene, h->place[k].id);
        explain_sender *e = &out->sender[t.instance - s->rays.scene->instances];
        double albedo[3], emission[3], sum = 0.0;
        material_at(albedo, emission, s->rays.scene, &t, h->part[k]);
        for (int c = 0; c < 3; ++c) {
            const double emitted = PI * emission[c] / EXPLAIN_RAYS;
            const double sent = albedo[c] * direct[k][c] / EXPLAIN_RAYS + emitted;
            e->emitted[c] += emitted;
            e->irradiance[c] += sent;
            out->irradiance[c] += sent;
            sum += sent;
        }
        out->dark += !(sum > 0.0);
        if (sum > 0.0) {
            e->near_m = e->near_m > 0.0f ? fminf(e->near_m, h->far_m[k]) : h->far_m[k];
            e->far_m = fmaxf(e->far_m, h->far_m[k]);
        }
    }
}

static double power_of(const explain_sender *e) { return e->irradiance[0] + e->irradiance[1] + e->irradiance[2]; }

static int by_power(const void *a, const void *b)
{
    const explain_sender *x = a, *y = b;
    const double p = power_of(x), q = power_of(y);
    return p != q ? (p < q) - (p > q) : (x->instance > y->instance) - (x->instance < y->instance);
}

void explain_gather(explain_bounce *out, explain_space *s, const explain_place *p)
{
    hits h;
    const uint32_t instances = s->rays.scene->instance_count;
    h.count = 0;
    for (uint32_t i = 0; i < instances; ++i) {
        memset(&out->sender[i], 0, sizeof out->sender[i]);
        out->sender[i].instance = i;
    }
    for (uint32_t i = 0; i < EXPLAIN_RAYS; ++i) {
        const lmb_vec3 along = ray_of(i, p->normal);
        float far_m;
        const int is_above = dot3(along, p->face) > 0.0f;
        const uint32_t found = is_above ? ray_nearest(&far_m, &s->rays, p->at, along, p->noise, FAR_M) : 0;
        if (found == 0) {
            ++out->missed;
            continue;
        }
        const lmb_bvh_triangle *t = &s->rays.bvh.triangle[found - 1];
        const uint32_t id = t->id & ~LMB_BVH_MASKED;
        const int is_back = dot3(t->normal, along) > 0.0f;
        lmb_triangle own;
        lmb_triangle_fetch(&own, s->rays.scene, id);
        if (is_back && (own.material->flags & LMB_DOUBLE_SIDED) == 0) {
            ++out->dark;
            continue;
        }
        explain_place *q = &h.place[h.count];
        q->at = add3(p->at, mul3(along, far_m));
        q->face = q->normal = mul3(t->normal, is_back ? -1.0f : 1.0f);
        q->depth = far_m;
        q->noise = lmb_place_noise(q->at, far_m);
        q->id = id;
        parts_of(h.part[h.count], t, q->at);
        h.far_m[h.count++] = far_m;
        if (h.count == LMB_TILE_PIXELS) {
            add_hits(out, s, &h);
            h.count = 0;
        }
    }
    add_hits(out, s, &h);
    qsort(out->sender, instances, sizeof *out->sender, by_power);
    while (out->senders < instances && power_of(&out->sender[out->senders]) > 0.0) {
        ++out->senders;
    }
}
