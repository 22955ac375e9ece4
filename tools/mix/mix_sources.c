/* mix_sources.c: light that an object sends on: what it emits, and what its metal throws on of the lights' light, by
 * patches of its surface. [M20 M25] */
#include "mix_sources.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265f

/* Of a photo's brightness, what no code of 8 bits shows. */
#define SHOWS 0.004f

/* Of the object's longest side: how far before its surface the lights are that stand for its patches. */
#define CLEAR 0.01f

enum { TREE_SIZE = 512, CELLS = 32 /* a side of the object, at most */, PATCHES = 768 /* at most */ };

static lmb_vec3 less(lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 out = {a.x - b.x, a.y - b.y, a.z - b.z};
    return out;
}

static lmb_vec3 times(lmb_vec3 a, float s)
{
    const lmb_vec3 out = {a.x * s, a.y * s, a.z * s};
    return out;
}

static lmb_vec3 plus(lmb_vec3 a, lmb_vec3 b)
{
    const lmb_vec3 out = {a.x + b.x, a.y + b.y, a.z + b.z};
    return out;
}

static float dot(lmb_vec3 a, lmb_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* --- what a patch sends ------------------------------------------------------------------------------------------- */

/* What a lobe sends towards v, over what its flux is: GGX with the height-correlated Smith term. As wide as it is, and
 * as its neighbour lies from here, so that patches make no spots. */
static float lobe_of(const mix_patch *p, lmb_vec3 v, float spread, float *low)
{
    lmb_vec3 h = plus(p->from, v);
    h = times(h, 1.0f / sqrtf(fmaxf(dot(h, h), 1e-12f)));
    const float a2 = fminf(p->alpha2 + spread, 1.0f), nh = dot(p->normal, h), nv = dot(p->normal, v),
                nl = fmaxf(dot(p->normal, p->from), 1e-3f), d = nh * nh * (a2 - 1.0f) + 1.0f;
    const float see = nl * sqrtf(a2 + (1.0f - a2) * nv * nv) + nv * sqrtf(a2 + (1.0f - a2) * nl * nl);
    const float side = fmaxf(1.0f - dot(v, h), 0.0f);
    *low = side * side * side * side * side;
    return nh > 0.0f ? a2 / (PI * d * d) * 0.5f / see : 0.0f;
}

/* A disc of the patch's area sends no more than its radiance: its distance is never under its radius. */
static void add_patch(float inout[3], const mix_patch *p, lmb_vec3 at, lmb_vec3 normal)
{
    const lmb_vec3 to = less(p->at, at);
    const float sent = -dot(p->normal, to), got = dot(normal, to), r2 = dot(to, to);
    if (!(sent > 0.0f && got > 0.0f)) {
        return;
    }
    const float e = sent * got / (r2 * (r2 + p->area * (1.0f / PI)));
    if (p->alpha2 == 0.0f) {
        for (int c = 0; c < 3; ++c) {
            inout[c] += p->flux[c] * (1.0f / PI) * e;
        }
        return;
    }
    float low;
    const float lobe = e * lobe_of(p, times(to, -1.0f / sqrtf(r2)), 0.125f * p->area / r2, &low);
    for (int c = 0; c < 3; ++c) {
        inout[c] += lobe * (p->flux[c] + (p->arrives[c] - p->flux[c]) * low);
    }
}

void mix_sources_at(float out[3], const mix_sources *s, int32_t light, lmb_vec3 at, lmb_vec3 normal)
{
    out[0] = out[1] = out[2] = 0.0f;
    for (int32_t i = s->first[light]; i < s->first[light + 1]; ++i) {
        add_patch(out, &s->piece[i], at, normal);
    }
}

/* --- tiles -------------------------------------------------------------------------------------------------------- */

static int32_t way_of_light(const mix_job *j, int32_t i) { return i - (j->light_count - j->lamp_count); }

static void at_pixel(float out[3], const mix_job *j, int32_t light, const lmb_tile *t, int32_t k)
{
    const lmb_vec3 at = {t->position[0][k], t->position[1][k], t->position[2][k]},
                   normal = {t->normal[0][k], t->normal[1][k], t->normal[2][k]};
    mix_sources_at(out, j->sources, way_of_light(j, light), at, normal);
}

/* Would the picture show what comes to the tile? By pixels at its corners and in its middle. */
static int shows(const mix_job *j, int32_t light, const lmb_tile *t)
{
    static const int32_t some[] = {0, 7, 27, 56, 63};
    const image *p = &j->frame.light;
    for (size_t i = 0; i < sizeof some / sizeof *some; ++i) {
        const int32_t k = some[i], x = t->x + k % LMB_TILE, y = t->y + k / LMB_TILE;
        float rgb[3];
        if (t->id[k] == 0 || x >= p->width || y >= p->height) {
            continue;
        }
        const float *photo = p->pixels + 3 * ((size_t)y * (size_t)p->width + (size_t)x);
        at_pixel(rgb, j, light, t, k);
        if (rgb[0] + rgb[1] + rgb[2] > SHOWS * PI * (photo[0] + photo[1] + photo[2])) {
            return 1;
        }
    }
    return 0;
}

/* Is pixel k beyond the plane that the way's light lies in? Between both is the object itself, whose patches know that: of
 * a metal ball those at a slant see farther round it than the light before its middle. What emits may stand on a foot. */
static int is_beyond(const mix_job *j, int32_t i, const lmb_tile *tile, int32_t k)
{
    const lmb_vec3 at = {tile->position[0][k], tile->position[1][k], tile->position[2][k]};
    const mix_sources *s = j->sources;
    const int32_t way = way_of_light(j, i);
    return s->piece[s->first[way]].alpha2 > 0.0f && dot(less(at, j->lights[i].position), s->axis[way]) < 0.0f;
}

void mix_sources_tile(lmb_irradiance *inout, const mix_job *j, const lmb_view *view, const lmb_tile *tile, int32_t i,
                      int photo)
{
    lmb_irradiance seen;
    if (photo && !shows(j, i, tile)) {
        return;
    }
    memset(&seen, 0, sizeof seen);
    lmb_direct_tile(&seen, j->o.kernels, tile, view, &j->scene, &j->lights[i], &j->maps[i][1]);
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        float rgb[3];
        if (seen.rgb[0][k] > 0.0f || (photo && tile->id[k] != 0 && is_beyond(j, i, tile, k))) {
            at_pixel(rgb, j, i, tile, k);
            for (int c = 0; c < 3; ++c) {
                inout->rgb[c][k] += rgb[c];
            }
        }
    }
}

/* --- first points ------------------------------------------------------------------------------------------------- */

/* What arrives over what a light of 1 W/sr brings; at grazing angles patches lie elsewhere than the light. */
static void scale_texel(lmb_texel *t, const mix_job *j, int32_t i)
{
    const lmb_vec3 to = less(j->lights[i].position, t->position);
    const float r2 = dot(to, to), one = fmaxf(dot(to, t->normal) / sqrtf(fmaxf(r2, 1e-12f)), 0.05f) / fmaxf(r2, 1e-12f);
    float rgb[3];
    mix_sources_at(rgb, j->sources, way_of_light(j, i), t->position, t->normal);
    for (int c = 0; c < 3; ++c) {
        t->flux[c] *= rgb[c] / one;
    }
}

/* The direction of a texel's middle. */
static lmb_vec3 way_out(const lmb_view *v, int32_t size, int32_t i)
{
    const float s = ((2.0f * (float)(i % size) + 1.0f) / (float)size - 1.0f) * v->half_width,
                t = (1.0f - (2.0f * (float)(i / size) + 1.0f) / (float)size) * v->half_height;
    const lmb_vec3 d = less(plus(times(v->right, s), times(v->up, t)), v->back);
    return times(d, 1.0f / sqrtf(dot(d, d)));
}

/* W that leave for nowhere through a texel of `power` sr: by what arrives far away. */
static void add_elsewhere(double elsewhere[3], const mix_job *j, int32_t i, lmb_vec3 out, float power)
{
    const float far = 1e3f;
    float rgb[3];
    mix_sources_at(rgb, j->sources, way_of_light(j, i), plus(j->lights[i].position, times(out, far)), times(out, -1.0f));
    for (int c = 0; c < 3; ++c) {
        elsewhere[c] += (double)(rgb[c] * far * far * power);
    }
}

void mix_sources_texels(lmb_texel *inout, int32_t size, double elsewhere[3], const mix_job *j, int32_t i,
                        int32_t face)
{
    lmb_shadow_map coarse = j->maps[i][1];
    coarse.size = size;
    for (int32_t k = 0; k < size * size; ++k) {
        if (inout[k].flux[0] + inout[k].flux[1] + inout[k].flux[2] > 0.0f) {
            scale_texel(&inout[k], j, i);
        } else {
            float power[3];
            lmb_light_texel_power(power, &j->lights[i], &coarse, face, k % size, k / size);
            add_elsewhere(elsewhere, j, i, way_out(&coarse.view[face], size, k), power[0]);
        }
    }
}

/* --- patches ------------------------------------------------------------------------------------------------------ */

/* Points of the surface that send something, before they are gathered. */
typedef struct point {
    mix_patch p;
    float weight;  /* sum of its flux */
    uint32_t told; /* the light that it reflects */
    uint32_t way, key;
    size_t order; /* of those found */
} point;

typedef struct points {
    point *all; /* realloc's */
    size_t count, cap;
    lmb_vec3 low; /* of the object's box */
} points;

static uint32_t way_of(lmb_vec3 n)
{
    const float x = fabsf(n.x), y = fabsf(n.y), z = fabsf(n.z);
    return x >= y && x >= z ? n.x < 0 : y >= z ? 2 + (n.y < 0) : 4 + (n.z < 0);
}

/* 0 without memory. */
static int add_point(points *to, const mix_patch *p, uint32_t told)
{
    const float weight = p->flux[0] + p->flux[1] + p->flux[2];
    const point q = {*p, weight, told, way_of(p->normal), 0, to->count};
    if (!(weight > 0.0f)) {
        return 1;
    }
    if (to->count == to->cap) {
        point *more = realloc(to->all, (2 * to->cap + 1024) * sizeof *more);
        if (more == NULL) {
            return 0;
        }
        to->all = more;
        to->cap = 2 * to->cap + 1024;
    }
    to->all[to->count++] = q;
    return 1;
}

static int by_key(const void *a, const void *b)
{
    const point *x = a, *y = b;
    return x->way != y->way ? (x->way > y->way) - (x->way < y->way) : (x->key > y->key) - (x->key < y->key);
}

/* No two alike: each C library's qsort then sorts as any other, and sums are in one order. */
static int by_order(const void *a, const void *b)
{
    const point *x = a, *y = b;
    const int key = by_key(a, b);
    return key != 0 ? key : (x->order > y->order) - (x->order < y->order);
}

static uint32_t cell_of(float at, float low, float per) { return (uint32_t)fminf(fmaxf((at - low) * per, 0.0f), 31.0f); }

/* Points of one way, one cell of the object's box and one light are a patch. */
static size_t sort_points(points *s, float cell)
{
    size_t patches = 0;
    for (size_t i = 0; i < s->count; ++i) {
        point *p = &s->all[i];
        p->key = ((p->told << 5 | cell_of(p->p.at.x, s->low.x, 1.0f / cell)) << 5 |
                  cell_of(p->p.at.y, s->low.y, 1.0f / cell)) << 5 | cell_of(p->p.at.z, s->low.z, 1.0f / cell);
    }
    qsort(s->all, s->count, sizeof *s->all, by_order);
    for (size_t i = 0; i < s->count; ++i) {
        patches += i == 0 || by_key(&s->all[i - 1], &s->all[i]) != 0;
    }
    return patches;
}

/* By how much a lobe is wider where a patch's points face several ways, for it is to reach the next patch's, and where light
 * comes to them from several, which moves half vectors half as much: alpha^2 for what the mean of those lacks of unit
 * length. By less, single patches of a ball are seen as rays on the floor. */
#define BY_NORMALS 6.0f
#define BY_LIGHTS  0.5f

/* Means by flux. */
static void gather(mix_patch *out, const point *from, size_t count, float cell)
{
    float weight = 0.0f;
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < count; ++i) {
        const point *p = &from[i];
        weight += p->weight;
        out->at = plus(out->at, times(p->p.at, p->weight));
        out->normal = plus(out->normal, times(p->p.normal, p->weight));
        out->from = plus(out->from, times(p->p.from, p->weight));
        out->alpha2 += p->p.alpha2 * p->weight;
        for (int c = 0; c < 3; ++c) {
            out->flux[c] += p->p.flux[c];
            out->arrives[c] += p->p.arrives[c];
        }
    }
    const float n = sqrtf(dot(out->normal, out->normal)), f = sqrtf(dot(out->from, out->from));
    out->at = times(out->at, 1.0f / weight);
    out->normal = times(out->normal, 1.0f / fmaxf(n, 1e-12f));
    out->from = times(out->from, 1.0f / fmaxf(f, 1e-12f));
    const float wider = BY_NORMALS * fmaxf(1.0f - n / weight, 0.0f) + BY_LIGHTS * fmaxf(1.0f - f / weight, 0.0f);
    out->alpha2 = out->alpha2 > 0.0f ? out->alpha2 / weight + wider : 0.0f;
    out->area = cell * cell;
}

/* --- what emits --------------------------------------------------------------------------------------------------- */

/* First points of what emits, as if it reflected a light of pi W/m2 everywhere: their flux over `*peak` is what it
 * emits. */
static lmb_texel *emitted(size_t *count, float *peak, mix_job *j, report *r)
{
    enum { SIDE = 8, PARTS = 32 };
    lmb_material *m;
    lmb_env white;
    lmb_vec3 low, high;
    mix_object_box(&low, &high, j);
    const float size = fmaxf(fmaxf(high.x - low.x, high.y - low.y), high.z - low.z), one[3] = {1, 1, 1};
    const size_t bytes = lmb_env_bytes(SIDE);
    void *memory = mix_take(j, bytes, r);
    lmb_scene *scene = mix_copy_scene(&m, j, r);
    if (memory == NULL || scene == NULL || lmb_env_init(&white, SIDE, memory, bytes) != LMB_OK) {
        return NULL;
    }
    for (int32_t i = 0; i < 6 * SIDE * SIDE; ++i) {
        lmb_env_set(&white, i / (SIDE * SIDE), i % SIDE, i / SIDE % SIDE, one);
    }
    lmb_env_mips(&white);
    *peak = 0.0f;
    for (uint32_t i = 0; i < 3 * scene->material_count; ++i) {
        *peak = fmaxf(*peak, m[i / 3].emission[i % 3]);
    }
    for (uint32_t i = 0; i < scene->material_count; ++i) {
        for (int c = 0; c < 3; ++c) {
            m[i].albedo[c] = m[i].emission[c] / *peak;
        }
        m[i].texture = (int32_t)m[i].emission_map - 1;
    }
    const float leaf = fmaxf(size / PARTS, 1e-6f);
    *count = lmb_around_points(NULL, 0, scene, j->real_triangles + 1, j->object_triangles, leaf, &white);
    lmb_texel *out = mix_take(j, *count * sizeof *out, r);
    if (out != NULL) {
        lmb_around_points(out, *count, scene, j->real_triangles + 1, j->object_triangles, leaf, &white);
    }
    return out;
}

static int add_emitted(points *to, mix_job *j, report *r)
{
    size_t count = 0;
    float peak = 0.0f;
    const lmb_texel *t = emitted(&count, &peak, j, r);
    int ok = t != NULL;
    for (size_t i = 0; ok && i < count; ++i) {
        mix_patch p;
        memset(&p, 0, sizeof p);
        p.at = t[i].position;
        p.normal = t[i].normal;
        for (int c = 0; c < 3; ++c) {
            p.flux[c] = t[i].flux[c] * peak;
        }
        ok = add_point(to, &p, 0);
    }
    return ok || report_fail(r, "out of memory");
}

/* --- what metal reflects ------------------------------------------------------------------------------------------ */

/* Where the lights' first points are made: of a scene in which metals reflect F0 and all else nothing, of one in which all
 * is white, and of one in which all reflects the width of its lobe. */
typedef struct mirror {
    lmb_scene *look[3];
    lmb_tree tree[3];
    lmb_tile *scratch;
} mirror;

static int is_metal(const lmb_material *m) { return m->metal_map != 0 || m->specular[0] + m->specular[1] + m->specular[2] > 0.0f; }

static void set_looks(lmb_material *look[3], const lmb_material *from, uint32_t count)
{
    for (uint32_t i = 0; i < count; ++i) {
        const float alpha = fmaxf(from[i].roughness * from[i].roughness, LMB_MIN_ALPHA);
        for (int c = 0; c < 3; ++c) {
            look[0][i].albedo[c] = !is_metal(&from[i])       ? 0.0f
                                   : from[i].metal_map != 0 ? from[i].albedo[c] * from[i].metallic
                                                             : from[i].specular[c];
            look[1][i].albedo[c] = 1.0f;
            look[2][i].albedo[c] = alpha * alpha;
        }
        look[0][i].texture = from[i].metal_map != 0 ? from[i].texture : -1;
        look[1][i].texture = look[2][i].texture = -1;
    }
}

/* A map of more texels than the tree has is no finer than twice, four or eight times as fine. */
static int32_t tree_side(const mix_job *j)
{
    const int32_t map = j->maps[0][1].size, low = map / 8 > TREE_SIZE ? map / 8 : TREE_SIZE;
    return map < TREE_SIZE ? map : low;
}

static int take_mirror(mirror *m, mix_job *j, report *r)
{
    lmb_material *look[3];
    const int32_t side = tree_side(j);
    const size_t bytes = lmb_tree_bytes(1, side);
    m->scratch = mix_take(j, sizeof *m->scratch, r);
    for (int i = 0; i < 3; ++i) {
        void *memory = mix_take(j, bytes, r);
        m->look[i] = mix_copy_scene(&look[i], j, r);
        if (memory == NULL || m->scratch == NULL || m->look[i] == NULL) {
            return 0;
        }
        if (lmb_tree_init(&m->tree[i], 1, side, memory, bytes) != LMB_OK) {
            return report_fail(r, "--shadow-map: a power of two, not %d", (int)j->maps[0][1].size);
        }
        m->tree[i].faces = 1;
    }
    set_looks(look, j->scene.materials, j->scene.material_count);
    return 1;
}

static lmb_vec3 towards(const lmb_light *l, lmb_vec3 at)
{
    const lmb_vec3 to = less(l->position, at);
    return l->kind == LMB_LIGHT_DIRECTIONAL ? times(l->direction, -1.0f)
                                            : times(to, 1.0f / sqrtf(fmaxf(dot(to, to), 1e-12f)));
}

static int add_face(points *to, mirror *m, const mix_job *j, int32_t light, int32_t face, uint32_t told)
{
    const int32_t side = m->tree[0].size;
    int ok = 1;
    for (int i = 0; i < 3; ++i) {
        if (lmb_tree_texels(&m->tree[i], j->o.kernels, m->scratch, m->look[i], &j->lights[light], &j->maps[light][1],
                            face, 0, 0, j->maps[light][1].size / LMB_TILE) != LMB_OK) {
            return 0;
        }
    }
    for (int32_t k = 0; ok && k < side * side; ++k) {
        const lmb_texel *t = &m->tree[0].texel[k];
        const float *white = m->tree[1].texel[k].flux, *wide = m->tree[2].texel[k].flux;
        mix_patch p;
        memset(&p, 0, sizeof p);
        p.at = t->position;
        p.normal = t->normal;
        p.from = towards(&j->lights[light], t->position);
        p.alpha2 = (wide[0] + wide[1] + wide[2]) / fmaxf(white[0] + white[1] + white[2], 1e-30f);
        memcpy(p.flux, t->flux, sizeof p.flux);
        memcpy(p.arrives, white, sizeof p.arrives);
        ok = add_point(to, &p, told);
    }
    return ok;
}

/* Lights that are one with a size are one. */
static uint32_t told_of(const mix_job *j, int32_t light)
{
    int32_t first = 0;
    for (int32_t i = 0; i < j->o.light_count; ++i) {
        first += j->o.light_size[i] > 0.0f ? MIX_LIGHT_SAMPLES : 1;
        if (light < first) {
            return (uint32_t)i + 1;
        }
    }
    return 1;
}

static int add_reflected(points *to, mix_job *j, report *r)
{
    mirror m;
    int ok = j->light_count == 0 || take_mirror(&m, j, r);
    for (int32_t i = 0; ok && i < j->light_count; ++i) {
        for (int32_t f = 0; ok && f < j->maps[i][1].faces; ++f) {
            ok = (j->maps[i][1].drawn >> f & 1u) == 0 || add_face(to, &m, j, i, f, told_of(j, i)) ||
                 report_fail(r, "out of memory");
        }
    }
    return ok;
}

/* --- their lights ------------------------------------------------------------------------------------------------- */

/* Before the middle of a way's points, beyond the one that stands out most: a patch lies at the mean of its points, which of
 * a curved surface is within it, and a light there would see nothing. `clear`: how far beyond, m. Returns their normal. */
static lmb_vec3 set_light(lmb_light *out, const point *p, size_t count, float clear)
{
    lmb_vec3 at = {0, 0, 0}, normal = {0, 0, 0};
    float weight = 0.0f, reach = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        at = plus(at, times(p[i].p.at, p[i].weight));
        normal = plus(normal, times(p[i].p.normal, p[i].weight));
        weight += p[i].weight;
    }
    at = times(at, 1.0f / weight);
    normal = times(normal, 1.0f / sqrtf(fmaxf(dot(normal, normal), 1e-30f)));
    for (size_t i = 0; i < count; ++i) {
        reach = fmaxf(reach, dot(less(p[i].p.at, at), normal));
    }
    memset(out, 0, sizeof *out);
    out->kind = LMB_LIGHT_POINT;
    out->position = plus(at, times(normal, reach + clear));
    out->direction = (lmb_vec3){0, -1, 0};
    out->cos_inner = out->cos_outer = 1.0f;
    out->intensity[0] = out->intensity[1] = out->intensity[2] = 1.0f;
    return normal;
}

/* Cells grow until patches are few enough for each pixel to ask them all. */
static float choose_cell(points *s, float side, size_t *patches)
{
    float cell = side / CELLS;
    while ((*patches = sort_points(s, cell)) > PATCHES && cell < side) {
        cell *= 1.25f;
    }
    return cell;
}

static int32_t make_patches(lmb_light out[MIX_WAYS], points *s, float side, mix_job *j, report *r)
{
    size_t patches = 0, at = 0;
    int32_t ways = 0, n = 0;
    const float cell = choose_cell(s, side, &patches);
    j->sources = mix_take(j, sizeof *j->sources, r);
    mix_patch *p = mix_take(j, (patches + 1) * sizeof *p, r);
    if (j->sources == NULL || p == NULL) {
        return -1;
    }
    j->sources->piece = p;
    while (at < s->count) {
        const uint32_t way = s->all[at].way;
        const size_t begins = at;
        for (j->sources->first[ways] = n; at < s->count && s->all[at].way == way; ++n) {
            const size_t from = at;
            while (at < s->count && by_key(&s->all[from], &s->all[at]) == 0) {
                ++at;
            }
            gather(&p[n], &s->all[from], at - from, cell);
        }
        j->sources->axis[ways] = set_light(&out[ways], &s->all[begins], at - begins, CLEAR * side);
        j->sources->first[++ways] = n;
    }
    return ways;
}

int32_t mix_sources_find(lmb_light out[MIX_WAYS], mix_job *j, report *r)
{
    points s = {NULL, 0, 0, {0, 0, 0}};
    lmb_vec3 high;
    int32_t ways = 0;
    if (j->object_triangles == 0) {
        return 0;
    }
    mix_object_box(&s.low, &high, j);
    const float side = fmaxf(fmaxf(high.x - s.low.x, high.y - s.low.y), fmaxf(high.z - s.low.z, 1e-6f));
    const int ok = (!lmb_scene_emits(&j->scene) || add_emitted(&s, j, r)) &&
                   (!lmb_scene_is_glossy(&j->scene) || add_reflected(&s, j, r));
    if (!ok || s.count > 0) {
        ways = ok ? make_patches(out, &s, side, j, r) : -1;
    }
    free(s.all);
    return ways;
}
