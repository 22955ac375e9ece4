/* mix_swift.c: many placements of objects in one photo. */
#include "mix_swift.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/pool.h"
#include "../common/binned.h"
#include "../picture/picture.h"
#include "mix_front.h"
#include "mix_lobes.h"
#include "mix_run.h"
#include "mix_turn.h"

#define PI 3.14159265f

enum { SUN_SIDE = 96, GRID = 24 /* cells of ground about the foot, a side */, SAMPLES = 16 /* maximum */ };

#define EACH   (4.0f * PI / (float)MIX_BLOCK_WAYS) /* solid angle of a direction */
#define CORNER 0.42f                               /* tangent of the angle to a corner of that cone, which is square */
#define SPREAD 0.29f                               /* tangent of half the cone of one of MIX_BLOCK_WAYS directions */
#define AROUND 3.0f                                /* the ground's cells reach this far from the middle, in radii */
#define LEAST  0.004f                              /* share of the light: an object that blocks less is too far away */
#define MOST   0.012f                              /* from here on all of it counts */
#define UNDER  0.03f                               /* m: surfaces farther below the object's plane are hidden by it */
#define RIM    0.15f                               /* as in mix_lobes.c */
#define SHADED 0.6f                                /* of the environment that an object's side sees */

/* A tile of the photo. */
typedef struct mix_area {
    lmb_vec3 at, normal; /* means */
    float radius;        /* under 0: nothing is measured */
    uint64_t lit;
} mix_area;

/* An object in place. */
typedef struct placed {
    const mix_block *block;
    const mix_spot *spot;
    lmb_mat4 from_scene;                                   /* to mesh space */
    float per_metre;                                       /* mesh units */
    lmb_vec3 middle, normal;                               /* scene space; of the plane */
    float radius;                                          /* m */
    float foot;                                            /* height of the plane along `out`, mesh space */
    lmb_vec3 out;                                          /* the plane's normal in mesh space */
    lmb_vec3 across, along;                                /* in the plane */
    float way[MIX_BLOCK_WAYS][3], back[MIX_BLOCK_WAYS][3]; /* radiance from there; of the object towards there */
    lmb_vec3 to[MIX_BLOCK_WAYS];                           /* in mesh space */
    mix_block_view sun[MIX_SWIFT_LIGHTS];
    uint8_t has_sun[MIX_SWIFT_LIGHTS];
    lmb_vec3 suns;    /* middle of all suns' directions, mesh space */
    float suns_apart; /* tangent of the largest angle from it; under 0: there is another light */
    lmb_vec3 last_normal;
    float last_all[3]; /* irradiance of the environment on it */
    float spread[MIX_SWIFT_LIGHTS];
    float ground[GRID * GRID][3]; /* share of the light that is left */
    void *memory;
} placed;

struct mix_swift_desk {
    const mix_swift *s;
    placed object[MIX_TOGETHER];
    int32_t count;
    lmb_view view[SAMPLES];
    lmb_target eye[SAMPLES];
    int32_t samples, x0, y0;
    int32_t box[4]; /* px, of all objects, multiples of tiles */
    lmb_scene scene;
    lmb_mesh *meshes;
    lmb_material *materials;
    lmb_texture *textures;
    lmb_instance *instances;
    uint32_t first[MIX_TOGETHER + 1]; /* id */
    void *surfaces;
    image picture;
    uint8_t *codes, *rgba, *is_changed; /* is_changed: by tile */
    lmb_tile real, object_tile, before;
    lmb_irradiance without, with, soft, one, lit, all;
    lmb_glossy lobes;
    lmb_radiance photo, light, over;
    float covered[LMB_TILE_PIXELS], left[3][LMB_TILE_PIXELS];
    lmb_vec3 last_normal;
    float last_around[3];                                 /* irradiance of the environment on it */
    lmb_vec3 at[LMB_TILE_PIXELS], faces[LMB_TILE_PIXELS]; /* of the light that samples of a pixel share */
    uint64_t known, blocks;                               /* blocks: lights that may be blocked in the tile */
    mix_job job;                                          /* for labels */
    struct mix_labels labels;
};

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static lmb_vec3 plus(lmb_vec3 a, lmb_vec3 b, float s)
{
    return (lmb_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static lmb_vec3 unit(lmb_vec3 a)
{
    const lmb_vec3 zero = {0, 0, 0};
    return plus(zero, a, 1.0f / sqrtf(fmaxf(dot(a, a), 1e-30f)));
}

static lmb_vec3 position_of(const lmb_tile *t, int k)
{
    return (lmb_vec3){t->position[0][k], t->position[1][k], t->position[2][k]};
}

static lmb_vec3 normal_of(const lmb_tile *t, int k)
{
    return (lmb_vec3){t->normal[0][k], t->normal[1][k], t->normal[2][k]};
}

/* --- the photo ---------------------------------------------------------------------------------------------------- */

static int sun_count(const mix_job *j) { return j->light_count - j->lamp_count; }

/* Which lights reach the pixels of a row of tiles, and where its tiles lie. */
static void look_at_row(void *user, int row, int thread)
{
    const mix_swift *s = user;
    const mix_job *j = s->j;
    lmb_tile tile;
    lmb_view view;
    int32_t x0, y0;
    (void)thread;
    lmb_photo_view(&view, &x0, &y0, &j->frame.camera, &j->axes);
    for (int32_t x = 0; x < s->columns; ++x) {
        mix_area *a = &s->area[row * s->columns + x];
        uint64_t lit[LMB_TILE_PIXELS] = {0};
        float n = 0.0f, far = 0.0f;
        lmb_vec3 sum = {0, 0, 0}, faces = {0, 0, 0};
        lmb_real_tile(&tile, &j->cloud, &j->planes, &j->real, &j->axes, x * LMB_TILE, row * LMB_TILE);
        for (int32_t i = 0; i < sun_count(j); ++i) {
            lmb_irradiance one;
            memset(&one, 0, sizeof one);
            lmb_direct_tile(&one, j->o.kernels, &tile, &view, &j->scene, &j->lights[i], &j->maps[i][0]);
            for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
                lit[k] |= (uint64_t)(one.rgb[0][k] + one.rgb[1][k] + one.rgb[2][k] > 0.0f) << i;
            }
        }
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int32_t px = x * LMB_TILE + k % LMB_TILE, py = row * LMB_TILE + k / LMB_TILE;
            if (tile.id[k] != 0 && px < j->frame.camera.width && py < j->frame.camera.height) {
                s->lit[(size_t)py * (size_t)j->frame.camera.width + (size_t)px] = lit[k];
                a->lit |= lit[k];
                sum = plus(sum, position_of(&tile, k), 1.0f);
                faces = plus(faces, normal_of(&tile, k), 1.0f);
                n += 1.0f;
            }
        }
        a->at = plus((lmb_vec3){0, 0, 0}, sum, 1.0f / fmaxf(n, 1.0f));
        a->normal = unit(faces);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const lmb_vec3 d = plus(position_of(&tile, k), a->at, -1.0f);
            far = tile.id[k] != 0 ? fmaxf(far, dot(d, d)) : far;
        }
        a->radius = n > 0.0f ? sqrtf(far) : -1.0f;
    }
}

int mix_swift_begin(mix_swift *out, mix_job *j, const mix_thing *things, report *r)
{
    const lmb_pinhole *c = &j->frame.camera;
    const size_t pixels = (size_t)c->width * (size_t)c->height;
    const int32_t whole[4] = {0, 0, c->width, c->height};
    memset(out, 0, sizeof *out);
    out->j = j;
    out->things = things;
    out->columns = (c->width + LMB_TILE - 1) / LMB_TILE;
    out->rows = (c->height + LMB_TILE - 1) / LMB_TILE;
    out->exposure_ev = mix_exposure(j);
    out->lit = mix_take(j, pixels * sizeof *out->lit, r);
    out->area = mix_take(j, (size_t)out->columns * (size_t)out->rows * sizeof *out->area, r);
    j->front = mix_take(j, pixels * sizeof *j->front, r);
    out->codes = mix_take(j, 3 * pixels, r);
    mix_way *way = mix_take(j, pixels * sizeof *way, r);
    if (out->lit == NULL || out->area == NULL || j->front == NULL || way == NULL || out->codes == NULL) {
        return 0;
    }
    uint8_t *codes = picture_codes(&j->frame.light, out->exposure_ev, PICTURE_CLIPPED);
    if (codes == NULL) {
        return report_fail(r, "out of memory");
    }
    memcpy(out->codes, codes, 3 * pixels);
    free(codes);
    mix_front_refine(j->front, way, &j->cloud, &j->planes, j->frame.light.pixels, whole);
    pool_run(pool_threads(j->o.threads), out->rows, look_at_row, out);
    return 1;
}

/* --- an object in place ------------------------------------------------------------------------------------------- */

/* The inverse of a turn, a scale and a move. */
static lmb_mat4 back_of(const lmb_mat4 *m)
{
    const float s2 = m->m[0] * m->m[0] + m->m[1] * m->m[1] + m->m[2] * m->m[2], by = 1.0f / fmaxf(s2, 1e-30f);
    lmb_mat4 out;
    memset(&out, 0, sizeof out);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            out.m[4 * k + i] = m->m[4 * i + k] * by;
        }
        out.m[12 + i] = -(m->m[4 * i] * m->m[12] + m->m[4 * i + 1] * m->m[13] + m->m[4 * i + 2] * m->m[14]) * by;
    }
    out.m[15] = 1.0f;
    return out;
}

/* Environment light on a surface, in mesh space, without the object. Pixels of a plane share one normal. */
static void whole_env(float all[3], placed *o, lmb_vec3 n)
{
    const lmb_vec3 turned = plus(n, o->last_normal, -1.0f);
    if (dot(turned, turned) > 1e-10f) {
        float sum[3] = {0, 0, 0};
        for (int32_t i = 0; i < MIX_BLOCK_WAYS; ++i) {
            const float cosine = fmaxf(dot(n, o->to[i]), 0.0f) * EACH;
            for (int c = 0; c < 3; ++c) {
                sum[c] += cosine * o->way[i][c];
            }
        }
        memcpy(o->last_all, sum, sizeof sum);
        o->last_normal = n;
    }
    memcpy(all, o->last_all, sizeof o->last_all);
}

/* The same. Also sums the light that the object blocks, minus the light that the object reflects instead. */
static void block_env(float all[3], float blocked[3], placed *o, lmb_vec3 p, lmb_vec3 n)
{
    const lmb_vec3 off = plus(o->block->middle, p, -1.0f);
    const float far2 = dot(off, off), reach = 1.05f * o->block->radius + CORNER * sqrtf(far2);
    const float min_along2 = far2 - reach * reach; /* squared, along a direction whose cone may meet the object */
    whole_env(all, o, n);
    blocked[0] = blocked[1] = blocked[2] = 0.0f;
    for (int32_t i = 0; i < MIX_BLOCK_WAYS; ++i) {
        const float cosine = dot(n, o->to[i]) * EACH, along = dot(off, o->to[i]);
        if (!(cosine > 0.0f) || along < -o->block->radius || along * along < min_along2) {
            continue;
        }
        const float covers = mix_block_soft(&o->block->way[i], p, SPREAD);
        for (int c = 0; c < 3; ++c) {
            blocked[c] += cosine * covers * (o->way[i][c] - o->back[i][c]);
        }
    }
}

/* Irradiance of a light without shadows on a point. */
static void light_of(float out[3], const lmb_light *l, lmb_vec3 p, lmb_vec3 n)
{
    lmb_vec3 to = plus((lmb_vec3){0, 0, 0}, l->direction, -1.0f);
    float by = 1.0f;
    if (l->kind != LMB_LIGHT_DIRECTIONAL) {
        const lmb_vec3 d = plus(l->position, p, -1.0f);
        const float far2 = fmaxf(dot(d, d), 1e-12f);
        to = unit(d);
        by = 1.0f / far2;
        if (l->kind == LMB_LIGHT_SPOT) {
            const float t = fminf(
                fmaxf((-dot(to, l->direction) - l->cos_outer) / fmaxf(l->cos_inner - l->cos_outer, 1e-6f), 0.0f), 1.0f);
            by *= t * t * (3.0f - 2.0f * t);
        }
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = l->intensity[c] * by * fmaxf(dot(n, to), 0.0f);
    }
}

static lmb_vec3 to_light(const lmb_light *l, lmb_vec3 p)
{
    return l->kind == LMB_LIGHT_DIRECTIONAL ? plus((lmb_vec3){0, 0, 0}, l->direction, -1.0f)
                                            : plus(l->position, p, -1.0f);
}

/* Radiance by direction: of the environment, and of the object. */
static void set_ways(placed *o, const mix_job *j)
{
    for (int32_t i = 0; i < MIX_BLOCK_WAYS; ++i) {
        const lmb_vec3 to = unit(mix_turn(&o->spot->placed, o->block->way[i].to)),
                       back = plus((lmb_vec3){0, 0, 0}, to, -1.0f);
        float around[3];
        o->to[i] = o->block->way[i].to;
        lmb_env_sample(o->way[i], &j->env[0], to, SPREAD);
        lmb_env_irradiance(around, &j->env[0], back);
        for (int c = 0; c < 3; ++c) {
            around[c] *= SHADED;
        }
        for (int32_t k = 0; k < sun_count(j); ++k) {
            float sun[3];
            light_of(sun, &j->lights[k], o->middle, back);
            for (int c = 0; c < 3; ++c) {
                around[c] += sun[c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            o->back[i][c] = o->block->albedo[c] * around[c] / PI;
        }
    }
}

/* The half width of the light that one sample of a sun or lamp stands for. */
static float spread_of(const mix_job *j, int32_t light, lmb_vec3 at)
{
    const lmb_light *l = &j->lights[light];
    int32_t first = 0;
    if (j->o.light_count == 0) {
        return 0.00872664626f * j->sun_size / sqrtf((float)MIX_SUN_SAMPLES);
    }
    for (int32_t i = 0; i < j->o.light_count; ++i) {
        const int32_t count = j->o.light_size[i] > 0.0f ? MIX_LIGHT_FEW : 1;
        if (light < first + count) {
            const lmb_vec3 d = plus(l->position, at, -1.0f);
            const float size = j->o.light_size[i] / sqrtf((float)count);
            return l->kind == LMB_LIGHT_DIRECTIONAL ? 0.00872664626f * size
                                                    : 0.5f * size / fmaxf(sqrtf(dot(d, d)), 1e-6f);
        }
        first += count;
    }
    return 0.0f;
}

/* A cone about the directions of all suns, to find tiles that none of their shadows reaches. */
static void group_suns(placed *o, const mix_job *j)
{
    lmb_vec3 sum = {0, 0, 0};
    o->suns_apart = sun_count(j) > 0 ? 0.0f : -1.0f;
    for (int32_t i = 0; i < sun_count(j); ++i) {
        sum = plus(sum, o->sun[i].to, 1.0f);
    }
    o->suns = unit(sum);
    for (int32_t i = 0; i < sun_count(j) && o->suns_apart >= 0.0f; ++i) {
        const float cosine = dot(o->suns, o->sun[i].to), apart = sqrtf(fmaxf(1.0f - cosine * cosine, 0.0f)) / cosine;
        o->suns_apart = o->sun[i].is_near || !(cosine > 0.1f) ? -1.0f : fmaxf(o->suns_apart, apart + o->spread[i]);
    }
}

static void set_suns(placed *o, const mix_job *j)
{
    const size_t bytes = mix_block_bytes(SUN_SIDE);
    for (int32_t i = 0; i < sun_count(j); ++i) {
        const lmb_light *l = &j->lights[i];
        const int is_near = l->kind != LMB_LIGHT_DIRECTIONAL;
        const lmb_vec3 to =
            is_near ? mix_move(&o->from_scene, l->position) : mix_turn(&o->from_scene, to_light(l, o->middle));
        o->has_sun[i] =
            (uint8_t)mix_block_look(&o->sun[i], o->block, to, is_near, SUN_SIDE, (char *)o->memory + (size_t)i * bytes);
        o->spread[i] = spread_of(j, i, o->middle);
    }
    group_suns(o, j);
}

static uint64_t lit_at(const mix_swift *s, lmb_vec3 p)
{
    const mix_job *j = s->j;
    const lmb_pinhole *c = &j->frame.camera;
    const float ahead = -dot(j->axes.back, p), x = c->cx + c->fx * dot(j->axes.right, p) / ahead + 0.5f,
                y = c->cy - c->fy * dot(j->axes.up, p) / ahead + 0.5f;
    return ahead > 0.0f && x >= 0.0f && y >= 0.0f && x < (float)c->width && y < (float)c->height
               ? s->lit[(size_t)y * (size_t)c->width + (size_t)x]
               : ~(uint64_t)0;
}

/* The share of light left on the plane around the foot, which lights the object from below. */
static void set_ground(placed *o, const mix_swift *s)
{
    const mix_job *j = s->j;
    const float step = 2.0f * AROUND * o->block->radius / (float)GRID;
    const lmb_vec3 foot = plus(o->block->middle, o->out, o->foot - dot(o->out, o->block->middle));
    for (int32_t i = 0; i < GRID * GRID; ++i) {
        const float u = ((float)(i % GRID) + 0.5f) * step - AROUND * o->block->radius,
                    v = ((float)(i / GRID) + 0.5f) * step - AROUND * o->block->radius;
        const lmb_vec3 p = plus(plus(foot, o->across, u), o->along, v), there = mix_move(&o->spot->placed, p);
        const uint64_t lit = lit_at(s, there);
        float all[3], blocked[3];
        block_env(all, blocked, o, p, o->out);
        for (int32_t k = 0; k < sun_count(j); ++k) {
            float sun[3];
            const float covers = (lit >> k & 1) != 0 && o->has_sun[k] ? mix_block_soft(&o->sun[k], p, o->spread[k]) : 0;
            light_of(sun, &j->lights[k], there, o->normal);
            for (int c = 0; c < 3 && (lit >> k & 1) != 0; ++c) {
                all[c] += sun[c];
                blocked[c] += covers * sun[c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            o->ground[i][c] = all[c] > 0.0f ? fminf(fmaxf(1.0f - blocked[c] / all[c], 0.0f), 1.0f) : 1.0f;
        }
    }
}

static const float *ground_at(const placed *o, lmb_vec3 p, lmb_vec3 to)
{
    static const float all[3] = {1, 1, 1};
    const float down = -dot(o->out, to), high = dot(o->out, p) - o->foot, reach = AROUND * o->block->radius;
    if (!(down > 0.02f) || o->spot->plane < 0) {
        return all;
    }
    const lmb_vec3 off = plus(plus(p, to, fmaxf(high, 0.0f) / down), o->block->middle, -1.0f);
    const float u = (dot(o->across, off) + reach) * (float)GRID / (2.0f * reach),
                v = (dot(o->along, off) + reach) * (float)GRID / (2.0f * reach);
    return u >= 0.0f && v >= 0.0f && u < (float)GRID && v < (float)GRID ? o->ground[(int)v * GRID + (int)u] : all;
}

static void place(placed *o, const mix_swift *s, const mix_spot *spot)
{
    o->spot = spot;
    o->block = &s->things[spot->thing].block;
    o->from_scene = back_of(&spot->placed);
    o->per_metre = 1.0f / fmaxf(spot->scale, 1e-30f);
    o->middle = mix_move(&spot->placed, o->block->middle);
    o->radius = o->block->radius * spot->scale;
    o->out = spot->hangs ? (lmb_vec3){0, 0, 1} : (lmb_vec3){0, 1, 0};
    o->across = (lmb_vec3){1, 0, 0};
    o->along = spot->hangs ? (lmb_vec3){0, 1, 0} : (lmb_vec3){0, 0, 1};
    o->normal = unit(mix_turn(&spot->placed, o->out));
    const lmb_scene *mesh = &s->things[spot->thing].object.scene;
    o->last_normal = (lmb_vec3){0, 0, 0};
    o->foot = spot->hangs ? mesh->bounds_min.z : mesh->bounds_min.y;
    set_ways(o, s->j);
    set_suns(o, s->j);
    set_ground(o, s);
}

/* --- real surfaces ------------------------------------------------------------------------------------------------ */

/* An estimate of the share of a surface's light that the object can block. */
static float share_of(const placed *o, lmb_vec3 at, lmb_vec3 normal, float wide)
{
    const lmb_vec3 d = plus(o->middle, at, -1.0f);
    const float far = sqrtf(dot(d, d)), near = fmaxf(far - wide, o->radius), share = o->radius / near,
                faces = fminf(fmaxf(dot(d, normal) / fmaxf(far, 1e-6f) + (o->radius + wide) / near, 0.0f), 1.0f);
    return share * share * faces;
}

/* Can a shadow of any sun reach a tile? */
static int may_be_shaded(const placed *o, const mix_area *a)
{
    const lmb_vec3 d = plus(mix_move(&o->from_scene, a->at), o->block->middle, -1.0f);
    const float to = dot(o->suns, d), wide = a->radius * o->per_metre,
                reach = 1.05f * o->block->radius + wide + fmaxf(o->block->radius - to, 0.0f) * o->suns_apart;
    const lmb_vec3 side = plus(d, o->suns, -to);
    return o->suns_apart < 0.0f || (to - wide < o->block->radius && dot(side, side) < reach * reach);
}

static int may_shadow(const placed *o, const mix_area *a, int32_t light)
{
    const mix_block_view *v = &o->sun[light];
    const lmb_vec3 p = mix_move(&o->from_scene, a->at), d = plus(p, v->middle, -1.0f);
    const float to = dot(v->to, d), wide = a->radius * o->per_metre;
    const lmb_vec3 side = plus(d, v->to, -to);
    const float by = v->is_near ? fmaxf(v->away - to, 0.0f) / v->away : 1.0f,
                reach = o->block->radius * (1.05f * by + 0.05f) + wide + fmaxf(-to, 0.0f) * o->spread[light];
    return to - wide < o->block->radius && dot(side, side) < reach * reach;
}

/* Also finds the lights that may be blocked. */
static int affects(mix_swift_desk *d, const mix_area *a)
{
    int near = 0;
    d->blocks = 0;
    for (int32_t i = 0; i < d->count && a->radius >= 0.0f; ++i) {
        const placed *o = &d->object[i];
        near |= share_of(o, a->at, a->normal, a->radius) > LEAST;
        const int is_shaded = a->lit != 0 && may_be_shaded(o, a);
        for (int32_t k = 0; is_shaded && k < sun_count(d->s->j); ++k) {
            const int blocks = (a->lit >> k & 1) != 0 && o->has_sun[k] && may_shadow(o, a, k);
            d->blocks |= (uint64_t)blocks << k;
        }
    }
    return near || d->blocks != 0;
}

/* Moves a pixel of the object's plane onto the surface at the object's foot. */
static lmb_vec3 lifted(const mix_swift_desk *d, const placed *o, int k)
{
    const lmb_vec3 p = position_of(&d->real, k), zero = {0, 0, 0};
    const int32_t x = d->real.x + k % LMB_TILE, y = d->real.y + k / LMB_TILE;
    const mix_job *j = d->s->j;
    if (o->spot->plane < 0 || j->planes.label[y * j->frame.camera.width + x] != o->spot->plane + 1) {
        return p;
    }
    const float q = 1.0f / fmaxf(d->real.depth[k], 1e-6f);
    return plus(zero, p, q / fmaxf(q + o->spot->lift, 0.5f * q));
}

/* The share of the environment's light that the objects leave at a pixel. */
static void find_left(mix_swift_desk *d, int k)
{
    const lmb_vec3 n = normal_of(&d->real, k);
    for (int c = 0; c < 3; ++c) {
        d->left[c][k] = 1.0f;
    }
    for (int32_t i = 0; i < d->count; ++i) {
        placed *o = &d->object[i];
        const lmb_vec3 p = lifted(d, o, k), there = mix_move(&o->from_scene, p);
        const float counts = fminf((share_of(o, p, n, 0.0f) - LEAST) / (MOST - LEAST), 1.0f);
        const int is_under = o->spot->plane >= 0 && dot(o->out, there) - o->foot < -UNDER * o->per_metre;
        float all[3], blocked[3];
        if (!(counts > 0.0f) || is_under) {
            continue;
        }
        block_env(all, blocked, o, there, unit(mix_turn(&o->from_scene, n)));
        for (int c = 0; c < 3; ++c) {
            d->left[c][k] *= all[c] > 0.0f ? fmaxf(1.0f - counts * blocked[c] / all[c], 0.0f) : 1.0f;
        }
    }
}

/* Pixel k lies between two that are known and on one plane with them. */
static int fill_between(mix_swift_desk *d, int k, int step)
{
    const lmb_tile *t = &d->real;
    const int a = k - step, b = k + step;
    if (t->id[a] == 0 || t->id[b] == 0 || dot(normal_of(t, a), normal_of(t, k)) < 0.999f ||
        dot(normal_of(t, b), normal_of(t, k)) < 0.999f ||
        fabsf(t->depth[a] + t->depth[b] - 2.0f * t->depth[k]) > 0.01f * t->depth[k]) {
        return 0;
    }
    for (int c = 0; c < 3; ++c) {
        d->left[c][k] = 0.5f * (d->left[c][a] + d->left[c][b]);
    }
    return 1;
}

/* The environment is even, so every second pixel each way is enough on a plane: first those in even rows and columns,
 * then between them in rows, then between rows. The last row and column have no next one and are found, too. */
static void find_all_left(mix_swift_desk *d)
{
    for (int pass = 0; pass < 3; ++pass) {
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int x = k % LMB_TILE, y = k / LMB_TILE, between_x = x % 2 == 1 && x < LMB_TILE - 1,
                      between_y = y % 2 == 1 && y < LMB_TILE - 1;
            if (d->real.id[k] == 0 || pass != (between_y ? 2 : between_x ? 1 : 0)) {
                continue;
            }
            if (pass == 0 || !fill_between(d, k, pass == 1 ? 1 : LMB_TILE)) {
                find_left(d, k);
            }
        }
    }
}

static void shade_real_pixel(mix_swift_desk *d, int k, uint64_t lit)
{
    const mix_job *j = d->s->j;
    const lmb_vec3 n = normal_of(&d->real, k), turned = plus(n, d->last_normal, -1.0f);
    lmb_vec3 there[MIX_TOGETHER];
    if (dot(turned, turned) > 1e-10f) {
        lmb_env_irradiance(d->last_around, &j->env[0], n);
        d->last_normal = n;
    }
    for (int c = 0; c < 3; ++c) {
        d->without.rgb[c][k] = d->last_around[c];
        d->with.rgb[c][k] = d->last_around[c] * d->left[c][k];
    }
    for (int32_t i = 0; i < d->count && lit != 0; ++i) {
        there[i] = mix_move(&d->object[i].from_scene, lifted(d, &d->object[i], k));
    }
    for (int32_t i = 0; i < sun_count(j); ++i) {
        float sun[3], open = 1.0f;
        if ((lit >> i & 1) == 0) {
            continue;
        }
        for (int32_t m = 0; m < d->count && (d->blocks >> i & 1) != 0; ++m) {
            open *= d->object[m].has_sun[i]
                        ? 1.0f - mix_block_soft(&d->object[m].sun[i], there[m], d->object[m].spread[i])
                        : 1.0f;
        }
        light_of(sun, &j->lights[i], position_of(&d->real, k), n);
        for (int c = 0; c < 3; ++c) {
            d->without.rgb[c][k] += sun[c];
            d->with.rgb[c][k] += open < 1.0f ? open * sun[c] : sun[c];
        }
    }
}

static void shade_real(mix_swift_desk *d)
{
    const mix_job *j = d->s->j;
    memset(&d->without, 0, sizeof d->without);
    memset(&d->with, 0, sizeof d->with);
    find_all_left(d);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = d->real.x + k % LMB_TILE, y = d->real.y + k / LMB_TILE;
        if (d->real.id[k] != 0 && x < j->frame.camera.width && y < j->frame.camera.height) {
            shade_real_pixel(d, k, d->s->lit[(size_t)y * (size_t)j->frame.camera.width + (size_t)x]);
        }
    }
    lmb_delta_tile(&d->photo, &d->real, &d->without, mix_soften(&d->soft, &d->with, &d->without, j->softens));
}

/* --- the object --------------------------------------------------------------------------------------------------- */

/* Environment light on the object, with the ground below and the object itself in the way. */
static void env_on(float out[3], const placed *o, lmb_vec3 p, lmb_vec3 n)
{
    const float texel = 1.0f / o->block->way[0].per_unit;
    const lmb_vec3 from = plus(p, n, 0.75f * texel);
    for (int c = 0; c < 3; ++c) {
        out[c] = 0.0f;
    }
    for (int32_t i = 0; i < MIX_BLOCK_WAYS; ++i) {
        const float cosine = dot(n, o->to[i]);
        if (!(cosine > 0.0f)) {
            continue;
        }
        const float hidden = mix_block_hard(&o->block->way[i], from, texel * (0.5f + 0.5f / fmaxf(cosine, 0.2f)));
        const float *ground = ground_at(o, p, o->to[i]);
        for (int c = 0; c < 3; ++c) {
            out[c] += cosine * (o->way[i][c] * ground[c] * (1.0f - hidden) + o->back[i][c] * hidden);
        }
    }
    for (int c = 0; c < 3; ++c) {
        out[c] *= EACH;
    }
}

static int32_t object_of(const mix_swift_desk *d, uint32_t id)
{
    int32_t i = 0;
    while (i + 1 < d->count && id >= d->first[i + 1]) {
        ++i;
    }
    return i;
}

/* The share of a light that no object takes from a pixel. */
static float open_of(const mix_swift_desk *d, int32_t own, lmb_vec3 p, lmb_vec3 n, int32_t light)
{
    float open = 1.0f;
    for (int32_t i = 0; i < d->count; ++i) {
        const placed *o = &d->object[i];
        if (o->has_sun[light]) {
            const float texel = 1.0f / o->sun[light].per_unit;
            const lmb_vec3 at = mix_move(&o->from_scene, p), face = unit(mix_turn(&o->from_scene, n)),
                           from = plus(at, face, i == own ? texel : 0.0f);
            open *= 1.0f - mix_block_hard(&o->sun[light], from, 1.5f * texel);
        }
    }
    return open;
}

/* Finds the light of pixels whose samples so far do not have it. */
static void light_pixels(mix_swift_desk *d, uint64_t asked)
{
    const lmb_tile *t = &d->object_tile;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((asked >> k & 1) == 0) {
            continue;
        }
        const int32_t own = object_of(d, t->id[k]);
        const lmb_vec3 p = position_of(t, k), n = normal_of(t, k);
        float rgb[3];
        env_on(rgb, &d->object[own], mix_move(&d->object[own].from_scene, p),
               unit(mix_turn(&d->object[own].from_scene, n)));
        for (int32_t i = 0; i < d->count; ++i) {
            float all[3], blocked[3];
            placed *o = &d->object[i];
            if (i == own || share_of(o, p, n, 0.0f) < LEAST) {
                continue;
            }
            block_env(all, blocked, o, mix_move(&o->from_scene, p), unit(mix_turn(&o->from_scene, n)));
            for (int c = 0; c < 3; ++c) {
                rgb[c] *= all[c] > 0.0f ? fmaxf(1.0f - blocked[c] / all[c], 0.0f) : 1.0f;
            }
        }
        d->at[k] = p;
        d->faces[k] = n;
        for (int c = 0; c < 3; ++c) {
            d->lit.rgb[c][k] = rgb[c];
        }
    }
    d->known |= asked;
}

/* The environment in the lobes' mirrored direction. */
static void mirror_env(mix_swift_desk *d)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if ((d->lobes.pixels >> k & 1) == 0) {
            continue;
        }
        const placed *o = &d->object[object_of(d, d->object_tile.id[k])];
        const lmb_vec3 n = normal_of(&d->object_tile, k),
                       v = {d->lobes.towards[0][k], d->lobes.towards[1][k], d->lobes.towards[2][k]}, zero = {0, 0, 0},
                       to = unit(plus(plus(zero, v, -1.0f), n, 2.0f * dot(n, v)));
        const float alpha = sqrtf(d->lobes.alpha2[k]), edge = 1.0f - fminf(fmaxf(d->lobes.facing[k], RIM), 1.0f),
                    rise = edge * edge * edge * edge * edge, dull = (1.0f - alpha) * (1.0f - alpha) * (1.0f - alpha);
        const float *ground =
            ground_at(o, mix_move(&o->from_scene, position_of(&d->object_tile, k)), unit(mix_turn(&o->from_scene, to)));
        float rgb[3];
        lmb_env_sample(rgb, &d->s->j->env[0], to, lmb_cone_tangent(sqrtf(alpha)));
        for (int c = 0; c < 3; ++c) {
            const float f = d->lobes.specular[c][k];
            d->lobes.rgb[c][k] += rgb[c] * ground[c] * (f + (1.0f - f) * dull * rise);
        }
    }
}

static uint64_t fresh(const mix_swift_desk *d)
{
    const lmb_tile *t = &d->object_tile;
    uint64_t out = 0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int same = (d->known >> k & 1) != 0 && dot(d->faces[k], normal_of(t, k)) > 0.95f;
        const lmb_vec3 off = plus(position_of(t, k), d->at[k], -1.0f);
        const float near = same && t->id[k] != 0 ? 0.05f * d->object[object_of(d, t->id[k])].radius : 0.0f;
        out |= (uint64_t)(t->id[k] != 0 && !(same && dot(off, off) < near * near)) << k;
    }
    return out;
}

static void light_object(mix_swift_desk *d, int32_t sample)
{
    const mix_job *j = d->s->j;
    const lmb_view *view = &d->view[sample];
    lmb_tile *t = &d->object_tile;
    light_pixels(d, fresh(d));
    d->all = d->lit;
    const int is_glossy = lmb_glossy_tile(&d->lobes, t, view, &d->scene);
    for (int32_t i = sample % 4 * (sun_count(j) >= 8); i < sun_count(j); i += sun_count(j) >= 8 ? 4 : 1) {
        const float times = sun_count(j) >= 8 ? 4.0f : 1.0f; /* samples of a pixel take turns */
        memset(&d->one, 0, sizeof d->one);
        lmb_direct_tile(&d->one, j->o.kernels, t, view, &d->scene, &j->lights[i], &j->maps[i][0]);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            if (d->one.rgb[0][k] + d->one.rgb[1][k] + d->one.rgb[2][k] > 0.0f) {
                const float open = times * open_of(d, object_of(d, t->id[k]), position_of(t, k), normal_of(t, k), i);
                for (int c = 0; c < 3; ++c) {
                    d->one.rgb[c][k] *= open;
                    d->all.rgb[c][k] += d->one.rgb[c][k];
                }
            }
        }
        if (is_glossy) {
            lmb_glossy_direct(&d->lobes, j->o.kernels, t, &d->one, &j->lights[i]);
        }
    }
    lmb_compose_tile(&d->light, j->o.kernels, t, &d->all, NULL);
    if (is_glossy) {
        mirror_env(d);
        lmb_compose_glossy(&d->light, &d->lobes);
    }
    if (lmb_scene_emits(&d->scene)) {
        lmb_compose_emission(&d->light, &d->scene, view, t);
    }
}

static void put_object(mix_swift_desk *d)
{
    const mix_job *j = d->s->j;
    lmb_radiance behind = d->photo;
    uint64_t any = 0;
    memset(&d->over, 0, sizeof d->over);
    memset(d->covered, 0, sizeof d->covered);
    memset(&d->lit, 0, sizeof d->lit);
    d->known = 0;
    for (int32_t i = 0; i < d->samples; ++i) {
        if (lmb_resolve_tile(&d->object_tile, j->o.kernels, &d->view[i], &d->scene, &d->eye[i], d->x0 + d->real.x,
                             d->y0 + d->real.y) != LMB_OK ||
            d->object_tile.hits == 0) {
            continue;
        }
        light_object(d, i);
        mix_front_tile(&d->before, &d->real, &d->object_tile, j->front, &j->cloud,
                       (float)d->view[i].sample_x * (1.0f / 256.0f), (float)d->view[i].sample_y * (1.0f / 256.0f));
        const uint64_t shown = lmb_object_tile(&behind, &d->light, &d->object_tile, &d->before, &j->cloud);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const float share = (shown >> k & 1) != 0 ? 1.0f / (float)d->samples : 0.0f;
            d->covered[k] += share;
            for (int c = 0; c < 3; ++c) {
                d->over.rgb[c][k] += share > 0.0f ? share * d->light.rgb[c][k] : 0.0f;
            }
        }
        mix_labels_sample(&d->job, &d->real, &d->object_tile, shown);
        any |= shown;
    }
    for (int k = 0; k < LMB_TILE_PIXELS && any != 0; ++k) {
        for (int c = 0; c < 3 && d->covered[k] > 0.0f; ++c) {
            d->photo.rgb[c][k] = d->over.rgb[c][k] + (1.0f - d->covered[k]) * d->photo.rgb[c][k];
        }
    }
    mix_labels_cover(&d->job, &d->real, &d->over, d->covered);
    mix_labels_grain(&d->photo, j, &d->real, d->covered);
}

/* --- a picture ---------------------------------------------------------------------------------------------------- */

static int take_scene(mix_swift_desk *d, const mix_spot *spots, report *r)
{
    const mix_swift *s = d->s;
    uint32_t meshes = 1, materials = 1, textures = 0, instances = 1;
    for (int32_t i = 0; i < d->count; ++i) {
        const lmb_scene *from = &s->things[spots[i].thing].object.scene;
        meshes += from->mesh_count;
        materials += from->material_count;
        textures += from->texture_count;
        instances += from->instance_count;
    }
    d->meshes = realloc(d->meshes, meshes * sizeof *d->meshes);
    d->materials = realloc(d->materials, materials * sizeof *d->materials);
    d->textures = realloc(d->textures, (textures + 1) * sizeof *d->textures);
    d->instances = realloc(d->instances, instances * sizeof *d->instances);
    return (d->meshes != NULL && d->materials != NULL && d->textures != NULL && d->instances != NULL) ||
           report_fail(r, "out of memory");
}

/* The real mesh is the first instance, as in the photo's scene, whose shadow maps name its triangles. */
static int join_scene(mix_swift_desk *d, const mix_spot *spots, report *r)
{
    const mix_swift *s = d->s;
    lmb_scene *to = &d->scene;
    if (!take_scene(d, spots, r)) {
        return 0;
    }
    *to = s->j->scene;
    d->meshes[0] = s->j->scene.meshes[0];
    d->materials[0] = s->j->scene.materials[0];
    d->instances[0] = s->j->scene.instances[0];
    to->mesh_count = to->material_count = to->instance_count = 1;
    to->texture_count = 0;
    uint32_t first = s->j->real_triangles;
    for (int32_t i = 0; i < d->count; ++i) {
        const lmb_scene *from = &s->things[spots[i].thing].object.scene;
        d->first[i] = first + 1;
        for (uint32_t k = 0; k < from->material_count; ++k) {
            lmb_material *m = &d->materials[to->material_count + k];
            *m = from->materials[k];
            mix_lobes_sheen(m, &s->things[spots[i].thing].object, k);
            m->texture += m->texture >= 0 ? (int32_t)to->texture_count : 0;
            m->normal_map += to->texture_count;
            m->emission_map += m->emission_map > 0 ? to->texture_count : 0;
            m->metal_map += m->metal_map > 0 ? to->texture_count : 0;
        }
        for (uint32_t k = 0; k < from->instance_count; ++k) {
            lmb_instance *in = &d->instances[to->instance_count + k];
            *in = from->instances[k];
            in->to_world = mix_product(&spots[i].placed, &in->to_world);
            in->mesh += to->mesh_count;
            in->material += to->material_count;
            in->first_id += first;
        }
        for (uint32_t k = 0; k < from->mesh_count; ++k) {
            d->meshes[to->mesh_count + k] = from->meshes[k];
        }
        for (uint32_t k = 0; k < from->texture_count; ++k) {
            d->textures[to->texture_count + k] = from->textures[k];
        }
        first += lmb_scene_triangles(from);
        to->mesh_count += from->mesh_count;
        to->material_count += from->material_count;
        to->texture_count += from->texture_count;
        to->instance_count += from->instance_count;
    }
    d->first[d->count] = first + 1;
    to->meshes = d->meshes;
    to->materials = d->materials;
    to->textures = d->textures;
    to->instances = d->instances;
    lmb_scene_bounds(&to->bounds_min, &to->bounds_max, to);
    return lmb_scene_check(to) == LMB_OK ||
           report_fail(r, "%s: too large where it stands; the list's size sets metres", s->things[spots[0].thing].path);
}

/* The part of the picture that the objects may cover. */
static void find_box(mix_swift_desk *d)
{
    const mix_job *j = d->s->j;
    const lmb_pinhole *c = &j->frame.camera;
    float x0 = FLT_MAX, y0 = FLT_MAX, x1 = -FLT_MAX, y1 = -FLT_MAX;
    for (int32_t i = 0; i < d->count; ++i) {
        const placed *o = &d->object[i];
        const lmb_scene *mesh = &d->s->things[o->spot->thing].object.scene;
        for (int k = 0; k < 8; ++k) {
            const lmb_vec3 at = {k & 1 ? mesh->bounds_max.x : mesh->bounds_min.x,
                                 k & 2 ? mesh->bounds_max.y : mesh->bounds_min.y,
                                 k & 4 ? mesh->bounds_max.z : mesh->bounds_min.z},
                           p = mix_move(&o->spot->placed, at);
            const float ahead = -dot(j->axes.back, p), x = c->cx + c->fx * dot(j->axes.right, p) / ahead,
                        y = c->cy - c->fy * dot(j->axes.up, p) / ahead;
            const int is_ahead = ahead > 0.0f;
            x0 = is_ahead ? fminf(x0, x) : 0.0f;
            y0 = is_ahead ? fminf(y0, y) : 0.0f;
            x1 = is_ahead ? fmaxf(x1, x) : (float)c->width;
            y1 = is_ahead ? fmaxf(y1, y) : (float)c->height;
            if (!is_ahead) {
                i = d->count;
                break;
            }
        }
    }
    const float w = (float)c->width, h = (float)c->height;
    d->box[0] = (int32_t)fminf(fmaxf(x0 - 2.0f, 0.0f), w) / LMB_TILE;
    d->box[1] = (int32_t)fminf(fmaxf(y0 - 2.0f, 0.0f), h) / LMB_TILE;
    d->box[2] = ((int32_t)fminf(fmaxf(x1 + 3.0f, 0.0f), w) + LMB_TILE - 1) / LMB_TILE;
    d->box[3] = ((int32_t)fminf(fmaxf(y1 + 3.0f, 0.0f), h) + LMB_TILE - 1) / LMB_TILE;
}

static int draw_eyes(mix_swift_desk *d, report *r)
{
    const mix_job *j = d->s->j;
    const int32_t w = (d->box[2] - d->box[0]) * LMB_TILE, h = (d->box[3] - d->box[1]) * LMB_TILE;
    if (w <= 0 || h <= 0) {
        return 1;
    }
    const size_t a = lmb_surface_bytes(LMB_DEPTH32F, w, h), b = lmb_surface_bytes(LMB_ID32, w, h);
    lmb_status status = lmb_photo_view(&d->view[0], &d->x0, &d->y0, &j->frame.camera, &j->axes);
    for (int32_t i = d->samples - 1; i >= 0 && status == LMB_OK; --i) {
        char *memory = (char *)d->surfaces + (size_t)i * (a + b);
        lmb_target *eye = &d->eye[i];
        memset(eye, 0, sizeof *eye);
        lmb_surface_init(&eye->depth, LMB_DEPTH32F, w, h, memory, a);
        lmb_surface_init(&eye->id, LMB_ID32, w, h, memory + a, b);
        lmb_surface_clear(&eye->depth);
        lmb_surface_clear(&eye->id);
        eye->x0 = d->x0 + d->box[0] * LMB_TILE;
        eye->y0 = d->y0 + d->box[1] * LMB_TILE;
        d->view[i] = d->view[0];
        status = d->samples > 1 ? lmb_view_sample(&d->view[i], d->samples, i) : LMB_OK;
        if (status == LMB_OK) {
            status = lmb_draw(eye, j->o.kernels, &d->view[i], &d->scene, d->first[0], d->first[d->count] - d->first[0],
                              LMB_CULL_BACK | LMB_BLEND, NULL);
        }
    }
    return status == LMB_OK || report_fail(r, "the object cannot be drawn: %s", lmb_status_name(status));
}

static void copy_tile(image *to, const image *from, int32_t x0, int32_t y0)
{
    for (int32_t y = y0; y < y0 + LMB_TILE && y < to->height; ++y) {
        const int32_t n = to->width - x0 < LMB_TILE ? to->width - x0 : LMB_TILE;
        const size_t at = 3 * ((size_t)y * (size_t)to->width + (size_t)x0);
        memcpy(to->pixels + at, from->pixels + at, 3 * (size_t)n * sizeof(float));
    }
}

static void get_tile(lmb_radiance *out, const image *p, int32_t x, int32_t y)
{
    memset(out, 0, sizeof *out);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        for (int c = 0; c < 3 && px < p->width && py < p->height; ++c) {
            out->rgb[c][k] = p->pixels[3 * ((size_t)py * (size_t)p->width + (size_t)px) + (size_t)c];
        }
    }
}

/* Stores a tile as light and as codes. */
static void put_tile(mix_swift_desk *d, int32_t x, int32_t y)
{
    image *p = &d->picture;
    uint8_t rgba[4 * LMB_TILE_PIXELS];
    lmb_surface codes;
    lmb_surface_init(&codes, LMB_RGBA8, LMB_TILE, LMB_TILE, rgba, sizeof rgba);
    lmb_store_tile(&codes, d->s->j->o.kernels, 0, 0, &d->photo, 0, 0, d->s->exposure_ev);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t px = x + k % LMB_TILE, py = y + k / LMB_TILE;
        for (int c = 0; c < 3 && px < p->width && py < p->height; ++c) {
            const size_t at = 3 * ((size_t)py * (size_t)p->width + (size_t)px) + (size_t)c;
            p->pixels[at] = d->photo.rgb[c][k];
            d->codes[at] = rgba[4 * k + c];
        }
    }
}

static void restore_codes(mix_swift_desk *d, int32_t x0, int32_t y0)
{
    const image *p = &d->picture;
    for (int32_t y = y0; y < y0 + LMB_TILE && y < p->height; ++y) {
        const int32_t n = p->width - x0 < LMB_TILE ? p->width - x0 : LMB_TILE;
        const size_t at = 3 * ((size_t)y * (size_t)p->width + (size_t)x0);
        memcpy(d->codes + at, d->s->codes + at, 3 * (size_t)n);
    }
}

static void draw_tiles(mix_swift_desk *d)
{
    const mix_swift *s = d->s;
    const mix_job *j = s->j;
    for (int32_t i = 0; i < s->columns * s->rows; ++i) {
        const int32_t tx = i % s->columns, ty = i / s->columns, x = tx * LMB_TILE, y = ty * LMB_TILE;
        const int may_show = tx >= d->box[0] && tx < d->box[2] && ty >= d->box[1] && ty < d->box[3],
                  changes = affects(d, &s->area[i]);
        if (d->is_changed[i]) {
            copy_tile(&d->picture, &j->frame.light, x, y);
            restore_codes(d, x, y);
        }
        d->is_changed[i] = (uint8_t)(may_show || changes);
        if (!may_show && !changes) {
            continue;
        }
        lmb_real_tile(&d->real, &j->cloud, &j->planes, &j->real, &j->axes, x, y);
        get_tile(&d->photo, &j->frame.light, x, y);
        if (changes) {
            shade_real(d);
        }
        if (may_show) {
            put_object(d);
        }
        put_tile(d, x, y);
    }
}

static int write_picture(const mix_swift_desk *d, const char *out, report *r)
{
    const image *p = &d->picture;
    const int format = picture_format(out);
    if (picture_is_linear(format)) {
        return picture_write(out, p, 0.0f, PICTURE_CLIPPED, r);
    }
    file_bytes file = {NULL, 0};
    const int ok = (format == PICTURE_PNG ? png_encode_quick : ppm_encode)(&file, d->codes, p->width, p->height, r) &&
                   file_write(out, file.data, file.size, r);
    file_free(&file);
    return ok;
}

static void begin_labels(mix_swift_desk *d, const char *labels, const mix_spot *spots)
{
    const size_t pixels = (size_t)d->picture.width * (size_t)d->picture.height;
    d->job.labels = NULL;
    if (labels == NULL) {
        return;
    }
    d->job.labels = &d->labels;
    d->job.o.labels = labels;
    memset(d->labels.covered, 0, MIX_LABEL_FLOATS * pixels * sizeof(float));
    d->labels.count = d->count;
    for (int32_t i = 0; i < d->count; ++i) {
        d->labels.placed[i] = spots[i].placed;
        d->labels.path[i] = d->s->things[spots[i].thing].path;
        d->labels.first[i] = d->first[i];
    }
}

int mix_swift_draw(mix_swift_desk *d, const mix_swift *s, const mix_spot *spots, int32_t count, const char *out,
                   const char *labels, report *r)
{
    d->count = count;
    for (int32_t i = 0; i < count; ++i) {
        place(&d->object[i], s, &spots[i]);
    }
    d->samples = picture_is_linear(picture_format(out)) ? 1 : 4;
    d->samples = s->j->o.samples != 0 ? s->j->o.samples : d->samples;
    if (!join_scene(d, spots, r)) {
        return 0;
    }
    find_box(d);
    begin_labels(d, labels, spots);
    if (!draw_eyes(d, r)) {
        return 0;
    }
    draw_tiles(d);
    return write_picture(d, out, r) && mix_labels_write(&d->job, s->exposure_ev, r);
}

/* --- memory of a thread ------------------------------------------------------------------------------------------- */

static int take_desk(mix_swift_desk *d, const mix_swift *s)
{
    const lmb_pinhole *c = &s->j->frame.camera;
    const size_t pixels = (size_t)c->width * (size_t)c->height, bytes = mix_block_bytes(SUN_SIDE);
    const int32_t w = s->columns * LMB_TILE, h = s->rows * LMB_TILE;
    const int32_t samples = s->j->o.samples > 4 ? s->j->o.samples : 4;
    d->picture = s->j->frame.light;
    d->picture.pixels = malloc(3 * pixels * sizeof(float));
    d->codes = malloc(3 * pixels);
    d->is_changed = calloc((size_t)s->columns * (size_t)s->rows, 1);
    d->surfaces = malloc((size_t)samples * (lmb_surface_bytes(LMB_DEPTH32F, w, h) + lmb_surface_bytes(LMB_ID32, w, h)));
    int ok = d->picture.pixels != NULL && d->codes != NULL && d->is_changed != NULL && d->surfaces != NULL;
    if (s->j->o.labels != NULL) {
        d->labels.covered = malloc(MIX_LABEL_FLOATS * pixels * sizeof(float));
        ok = ok && d->labels.covered != NULL;
        mix_labels_lay_out(&d->labels, pixels);
    }
    for (int32_t i = 0; i < MIX_TOGETHER && ok; ++i) {
        d->object[i].memory = malloc((size_t)(sun_count(s->j) > 0 ? sun_count(s->j) : 1) * bytes);
        ok = d->object[i].memory != NULL;
    }
    if (ok) {
        memcpy(d->picture.pixels, s->j->frame.light.pixels, 3 * pixels * sizeof(float));
        memcpy(d->codes, s->codes, 3 * pixels);
    }
    return ok;
}

mix_swift_desk *mix_swift_desk_make(const mix_swift *s, report *r)
{
    mix_swift_desk *d = calloc(1, sizeof *d);
    if (d == NULL) {
        report_fail(r, "out of memory");
        return NULL;
    }
    d->s = s;
    d->job = *s->j;
    if (!take_desk(d, s)) {
        mix_swift_desk_free(d);
        report_fail(r, "out of memory");
        return NULL;
    }
    return d;
}

void mix_swift_desk_free(mix_swift_desk *d)
{
    for (int32_t i = 0; d != NULL && i < MIX_TOGETHER; ++i) {
        free(d->object[i].memory);
    }
    if (d != NULL) {
        free(d->picture.pixels);
        free(d->codes);
        free(d->is_changed);
        free(d->surfaces);
        free(d->labels.covered);
        free(d->meshes);
        free(d->materials);
        free(d->textures);
        free(d->instances);
        free(d);
    }
}
