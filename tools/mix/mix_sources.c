/* mix_sources.c: light from the object by patches: emission, and light reflected by metal. [M20 M25] */
#include "mix_sources.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265f

/* Share of a photo's brightness too small to change an 8-bit code. */
#define SHOWS 0.004f

/* Distance of a way's light from the surface, as a share of the object's longest side. */
#define CLEAR 0.01f

/* Likewise, the rounding error of points from a shadow map. */
#define ROUNDED 1e-4f

enum { TREE_SIZE = 512, CELLS = 32 /* maximum cells per side of the object */, PATCHES = 768 /* maximum */,
       GLOWING = 4096 /* likewise, without metal: near its foot, patches must be narrower than the distance */,
       MERGED = 6 /* patches merged for distant receivers */,
       BUNDLES = 48 /* of emitting patches; a new way, or a new light that metal reflects, starts another */ };

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

/* --- light of a patch --------------------------------------------------------------------------------------------- */

/* The lobe towards v per flux: GGX with the height-correlated Smith term. `spread` widens the lobe by the size of a
 * patch as seen from the receiver, so that patches make no spots. */
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

/* Adds a patch as a disc: the distance is clamped to the disc's radius, so the result never exceeds the patch's
 * radiance. */
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

static lmb_vec3 of_planes(const float planes[3][LMB_TILE_PIXELS], int32_t k)
{
    const lmb_vec3 out = {planes[0][k], planes[1][k], planes[2][k]};
    return out;
}

/* Would the patches' light be visible in the picture? Tests pixels at the corners and in the middle of the tile. */
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
        mix_sources_at(rgb, j->sources, way_of_light(j, light), of_planes(t->position, k), of_planes(t->normal, k));
        if (rgb[0] + rgb[1] + rgb[2] > SHOWS * PI * (photo[0] + photo[1] + photo[2])) {
            return 1;
        }
    }
    return 0;
}

/* A tile's pixels in visibility tests of bundles. */
typedef struct asked {
    const lmb_kernels *kernels;
    const lmb_tile *tile;
    float noise; /* m: maximum distance of pixels from their surfaces */
    lmb_traversal traversal;
} asked;

/* Columns and rows 0, 2, 5 and 7 of a tile: if these agree, the pixels between are not tested. */
#define SOME UINT64_C(0xa500a50000a500a5)

/* Those of `pixels` from which a place is hidden. */
static uint64_t hidden(asked *a, const mix_sources *s, uint64_t pixels, lmb_vec3 at)
{
    const float noise = a->noise + s->noise + lmb_place_noise(at, 0.0f);
    const uint64_t some = pixels & SOME;
    uint64_t found = 0;
    if (some != 0) {
        found = lmb_occluded_tile(a->kernels, &a->traversal, &s->bvh, a->tile, some, at, noise);
        if (found == 0 || found == some) {
            return found == 0 ? 0 : pixels;
        }
    }
    return found | lmb_occluded_tile(a->kernels, &a->traversal, &s->bvh, a->tile, pixels & ~some, at, noise);
}

/* Is the whole tile beyond the bundle's reach? Tests the corners with a margin. */
static int is_afar(const lmb_tile *t, const mix_bundle *b)
{
    static const int32_t corner[] = {0, 7, 56, 63};
    float near = INFINITY, wide = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const lmb_vec3 off = less(of_planes(t->position, corner[i]), b->middle),
                       side = less(of_planes(t->position, corner[i]), of_planes(t->position, 27));
        if (t->id[corner[i]] == 0 || t->id[27] == 0) {
            return 0;
        }
        near = fminf(near, sqrtf(dot(off, off)));
        wide = fmaxf(wide, sqrtf(dot(side, side)));
    }
    return near - wide > b->reach;
}

/* Computes the light of a bundle's patches at some of a tile's pixels. Returns the pixels that get any. *at: a point on
 * the brightest patch, because the object itself would hide a patch that faces away. */
static uint64_t send_bundle(lmb_irradiance *out, lmb_vec3 *at, const lmb_tile *t, const mix_sources *s,
                            const mix_bundle *from, uint64_t pixels)
{
    uint64_t reached = 0;
    float max = 0.0f;
    const int afar = is_afar(t, from);
    memset(out, 0, sizeof *out);
    for (int32_t i = afar ? from->far_first : from->first; i < (afar ? from->far_past : from->past); ++i) {
        float all = 0.0f;
        for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
            float rgb[3] = {0, 0, 0};
            if ((pixels >> k & 1u) == 0) {
                continue;
            }
            add_patch(rgb, &s->piece[i], of_planes(t->position, k), of_planes(t->normal, k));
            const float one = rgb[0] + rgb[1] + rgb[2];
            all += one;
            reached |= (uint64_t)(one > 0.0f) << k;
            for (int c = 0; c < 3; ++c) {
                out->rgb[c][k] += rgb[c];
            }
        }
        *at = all > max ? s->piece[i].on : *at;
        max = fmaxf(max, all);
    }
    return reached;
}

/* Adds the light of a way's patches to a tile. Pixels from which the bundle is hidden try again with the patch that is
 * brightest for them: near the foot of a ball, each pixel sees another part of the side. */
static void add_way(lmb_irradiance *inout, asked *a, const mix_sources *s, int32_t way)
{
    enum { AGAIN = 3 };
    uint64_t all = 0;
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        all |= (uint64_t)(a->tile->id[k] != 0) << k;
    }
    for (int32_t b = s->bundles[way]; b < s->bundles[way + 1]; ++b) {
        uint64_t left = all;
        for (int i = 0; i < AGAIN && left != 0; ++i) {
            lmb_irradiance sent;
            lmb_vec3 at = {0, 0, 0};
            const uint64_t reached = send_bundle(&sent, &at, a->tile, s, &s->bundle[b], left);
            left = reached != 0 ? hidden(a, s, reached, at) : 0;
            for (int32_t k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
                const int32_t c = k / LMB_TILE_PIXELS, p = k % LMB_TILE_PIXELS;
                inout->rgb[c][p] += ((reached & ~left) >> p & 1u) != 0 ? sent.rgb[c][p] : 0.0f;
            }
        }
    }
}

/* Maximum distance of pixels from the mesh of real surfaces, m: 0 on planes, elsewhere three standard deviations of the
 * depth. */
static float measured_noise(const mix_job *j, const lmb_tile *t)
{
    float noise = lmb_tile_noise(t, ~(uint64_t)0);
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (t->id[k] != 0 && t->id[k] <= j->real_triangles && t->depth[k] > 0.0f &&
            j->real.label[(t->id[k] - 1) / 2] == 0) {
            const float q = 1.0f / t->depth[k];
            noise = fmaxf(noise, 3.0f * lmb_cloud_sigma(&j->cloud, q) / (q * q));
        }
    }
    return noise;
}

void mix_sources_tile(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, int32_t i, int photo)
{
    asked a;
    if (photo && !shows(j, i, tile)) {
        return;
    }
    memset(&a, 0, sizeof a);
    a.kernels = j->o.kernels;
    a.tile = tile;
    a.noise = measured_noise(j, tile);
    add_way(inout, &a, j->sources, way_of_light(j, i));
}

/* --- points ------------------------------------------------------------------------------------------------------- */

static void put_point(lmb_tile *to, int32_t k, const lmb_texel *from)
{
    const float p[3] = {from->position.x, from->position.y, from->position.z},
                n[3] = {from->normal.x, from->normal.y, from->normal.z};
    for (int32_t i = 0; i < 3; ++i) {
        to->position[i][k] = p[i];
        to->face[i][k] = to->normal[i][k] = n[i];
    }
    to->depth[k] = 1.0f;
    to->id[k] = 1;
}

void mix_sources_points(lmb_texel *inout, const lmb_texel *white, size_t count, double arrives[3], const mix_job *j)
{
    lmb_tile tile;
    for (size_t i = 0; i < count; i += LMB_TILE_PIXELS) {
        const size_t n = count - i < LMB_TILE_PIXELS ? count - i : LMB_TILE_PIXELS;
        lmb_irradiance light;
        asked a;
        memset(&tile, 0, sizeof tile);
        memset(&light, 0, sizeof light);
        memset(&a, 0, sizeof a);
        for (size_t k = 0; k < n; ++k) {
            put_point(&tile, (int32_t)k, &inout[i + k]);
        }
        a.kernels = j->o.kernels;
        a.tile = &tile;
        a.noise = lmb_tile_noise(&tile, ~(uint64_t)0);
        for (int32_t way = 0; way < j->lamp_count; ++way) {
            add_way(&light, &a, j->sources, way);
        }
        for (size_t k = 0; k < n; ++k) {
            for (int c = 0; c < 3; ++c) {
                inout[i + k].flux[c] *= light.rgb[c][k] * (1.0f / PI);
                arrives[c] += (double)(white[i + k].flux[c] * light.rgb[c][k] * (1.0f / PI));
            }
        }
    }
}

/* --- patches ------------------------------------------------------------------------------------------------------ */

/* Surface points that send light, before they are grouped. */
typedef struct point {
    mix_patch p;
    float weight;  /* sum of the flux */
    uint32_t told; /* the light that it reflects */
    uint32_t way, key;
    size_t order; /* in which it was found */
} point;

typedef struct points {
    point *all; /* allocated with realloc */
    size_t count, cap;
    lmb_vec3 low; /* of the object's box */
} points;

static uint32_t way_of(lmb_vec3 n)
{
    const float x = fabsf(n.x), y = fabsf(n.y), z = fabsf(n.z);
    return x >= y && x >= z ? n.x < 0 : y >= z ? 2 + (n.y < 0) : 4 + (n.z < 0);
}

/* Returns 0 if memory is short. */
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

/* A total order: every C library's qsort then gives one result, so sums have one order. */
static int by_order(const void *a, const void *b)
{
    const point *x = a, *y = b;
    const int key = by_key(a, b);
    return key != 0 ? key : (x->order > y->order) - (x->order < y->order);
}

static uint32_t cell_of(float at, float low, float per)
{
    return (uint32_t)fminf(fmaxf((at - low) * per, 0.0f), 31.0f);
}

/* Receivers this many widths of a merged patch away use the merged one. */
#define AFAR 8.0f

/* Spreads five bits to every third bit, for a Morton key: neighbouring cells are sorted near each other. */
static uint32_t apart(uint32_t v)
{
    return (v & 1u) | (v & 2u) << 2 | (v & 4u) << 4 | (v & 8u) << 6 | (v & 16u) << 8;
}

/* Sorts the points. Points with the same way, light and cell of the object's box form a patch. Returns the number of
 * patches. */
static size_t sort_points(points *s, float cell)
{
    size_t patches = 0;
    for (size_t i = 0; i < s->count; ++i) {
        point *p = &s->all[i];
        p->key = p->told << 15 | apart(cell_of(p->p.at.x, s->low.x, 1.0f / cell)) << 2 |
                 apart(cell_of(p->p.at.y, s->low.y, 1.0f / cell)) << 1 |
                 apart(cell_of(p->p.at.z, s->low.z, 1.0f / cell));
    }
    qsort(s->all, s->count, sizeof *s->all, by_order);
    for (size_t i = 0; i < s->count; ++i) {
        patches += i == 0 || by_key(&s->all[i - 1], &s->all[i]) != 0;
    }
    return patches;
}

/* Widening of a patch's lobe, as alpha^2 per shortfall of a mean direction from unit length: for varying normals, so
 * that it reaches the next patch's lobe, and for varying light directions, which move half vectors half as much.
 * Smaller values show patches of a ball as rays on the floor. */
#define BY_NORMALS 6.0f
#define BY_LIGHTS  0.5f

/* Averages points, weighted by flux. */
static void gather(mix_patch *out, const point *from, size_t count, float cell)
{
    float weight = 0.0f, max = 0.0f;
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < count; ++i) {
        const point *p = &from[i];
        weight += p->weight;
        out->on = p->weight > max ? p->p.at : out->on;
        max = fmaxf(max, p->weight);
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

/* --- emission ----------------------------------------------------------------------------------------------------- */

int mix_white_env(lmb_env *out, int32_t side, void *memory, size_t bytes)
{
    const float one[3] = {1, 1, 1};
    if (lmb_env_init(out, side, memory, bytes) != LMB_OK) {
        return 0;
    }
    for (int32_t i = 0; i < 6 * side * side; ++i) {
        lmb_env_set(out, i / (side * side), i % side, i / side % side, one);
    }
    lmb_env_mips(out);
    return 1;
}

/* First points of the emitting surfaces, with emission as albedo under a light of pi W/m2 everywhere. Their flux times
 * `*peak` is the emitted power. */
static lmb_texel *emitted(size_t *count, float *peak, mix_job *j, report *r)
{
    enum { SIDE = 8, PARTS = 32 };
    lmb_material *m;
    lmb_env white;
    lmb_vec3 low, high;
    mix_object_box(&low, &high, j);
    const float size = fmaxf(fmaxf(high.x - low.x, high.y - low.y), high.z - low.z);
    const size_t bytes = lmb_env_bytes(SIDE);
    void *memory = mix_take(j, bytes, r);
    lmb_scene *scene = mix_copy_scene(&m, j, r);
    if (memory == NULL || scene == NULL || !mix_white_env(&white, SIDE, memory, bytes)) {
        return NULL;
    }
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

/* --- reflection by metal ------------------------------------------------------------------------------------------ */

/* First points of the lights, from three scenes: metals with albedo F0 and all else black; all white; all with alpha^2
 * of the lobe as albedo. */
typedef struct mirror {
    lmb_scene *look[3];
    lmb_tree tree[3];
    lmb_tile *scratch;
} mirror;

static int is_metal(const lmb_material *m)
{
    return m->metal_map != 0 || m->specular[0] + m->specular[1] + m->specular[2] > 0.0f;
}

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

/* The side of the tree: at most TREE_SIZE, but at least an eighth of the map's. */
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

/* The number of a given light: all samples of a light with a size count as one. */
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

/* --- lights of the ways ------------------------------------------------------------------------------------------- */

/* Places a light in front of a way's points, `clear` m beyond the outermost one. The mean of points on a curved surface
 * lies inside the object, and so would a light there. */
static void set_light(lmb_light *out, const point *p, size_t count, float clear)
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
}

/* Enlarges cells until each pixel can afford to evaluate all patches. */
static float choose_cell(points *s, float side, size_t *patches)
{
    float cell = side / CELLS;
    size_t max = GLOWING;
    for (size_t i = 0; i < s->count; ++i) {
        max = s->all[i].p.alpha2 > 0.0f ? PATCHES : max;
    }
    while ((*patches = sort_points(s, cell)) > max && cell < side) {
        cell *= 1.25f;
    }
    return cell;
}

static float sends(const mix_patch *p) { return p->flux[0] + p->flux[1] + p->flux[2]; }

/* Adds patch i to its way's last bundle, or starts a new one if that has its share of the flux. */
static void add_to_bundle(mix_sources *s, int32_t way, int32_t i, int is_new, float share)
{
    int32_t n = s->bundles[way + 1];
    float sum = 0.0f;
    for (int32_t k = is_new ? i : s->bundle[n - 1].first; k < i; ++k) {
        sum += sends(&s->piece[k]);
    }
    if (is_new || sum >= share) {
        s->bundle[n++].first = i;
        s->bundles[way + 1] = n;
    }
    s->bundle[n - 1].past = i + 1;
}

/* Merges a few patches for distant receivers. */
static mix_patch merge(const mix_patch *p, int32_t count)
{
    mix_patch out = p[0];
    float all = 0.0f, max = 0.0f;
    out.at = out.normal = (lmb_vec3){0, 0, 0};
    out.area = out.flux[0] = out.flux[1] = out.flux[2] = 0.0f;
    for (int32_t i = 0; i < count; ++i) {
        const float one = sends(&p[i]);
        out.at = plus(out.at, times(p[i].at, one));
        out.normal = plus(out.normal, times(p[i].normal, one));
        out.area += p[i].area;
        out.on = one > max ? p[i].on : out.on;
        max = fmaxf(max, one);
        all += one;
        for (int c = 0; c < 3; ++c) {
            out.flux[c] += p[i].flux[c];
        }
    }
    out.at = times(out.at, 1.0f / all);
    out.normal = times(out.normal, 1.0f / sqrtf(fmaxf(dot(out.normal, out.normal), 1e-30f)));
    return out;
}

/* Appends the merged patches of a bundle. Metal's patches are not merged, because lobes are narrow. Returns the new
 * number of patches. */
static int32_t add_far(mix_sources *s, mix_bundle *b, int32_t n)
{
    float far = 0.0f;
    if (s->piece[b->first].alpha2 > 0.0f) {
        b->reach = INFINITY;
        return n;
    }
    b->far_first = n;
    for (int32_t i = b->first; i < b->past; i += MERGED) {
        s->piece[n++] = merge(&s->piece[i], b->past - i < MERGED ? b->past - i : MERGED);
    }
    b->far_past = n;
    b->middle = merge(&s->piece[b->first], b->past - b->first).at;
    for (int32_t i = b->first; i < b->past; ++i) {
        const lmb_vec3 off = less(s->piece[i].at, b->middle);
        far = fmaxf(far, sqrtf(dot(off, off)));
    }
    b->reach = far + AFAR * sqrtf(MERGED * s->piece[b->first].area);
    return n;
}

/* Makes patches of one way's points, from s->all[at] on. Returns the number of points. */
static size_t make_way(lmb_light *light, mix_sources *to, const points *s, size_t at, int32_t ways, float cell,
                       float clear, float share)
{
    const size_t begins = at;
    const uint32_t way = s->all[at].way;
    int32_t n = to->first[ways];
    uint32_t told = UINT32_MAX;
    to->bundles[ways + 1] = to->bundles[ways];
    while (at < s->count && s->all[at].way == way) {
        const size_t from = at;
        while (at < s->count && by_key(&s->all[from], &s->all[at]) == 0) {
            ++at;
        }
        gather(&to->piece[n], &s->all[from], at - from, cell);
        add_to_bundle(to, ways, n++, told != s->all[from].told, share);
        told = s->all[from].told;
    }
    to->first[ways + 1] = n;
    set_light(light, &s->all[begins], at - begins, clear);
    return at - begins;
}

static int32_t make_patches(lmb_light out[MIX_WAYS], points *s, float side, mix_job *j, report *r)
{
    size_t patches = 0;
    int32_t ways = 0;
    float all = 0.0f;
    const float cell = choose_cell(s, side, &patches);
    mix_sources *to = j->sources = mix_take(j, sizeof *to, r);
    if (to == NULL || (to->piece = mix_take(j, 2 * (patches + 1) * sizeof *to->piece, r)) == NULL ||
        (to->bundle = mix_take(j, (patches + 1) * sizeof *to->bundle, r)) == NULL) {
        return -1;
    }
    for (size_t i = 0; i < s->count; ++i) {
        all += s->all[i].weight;
        for (int c = 0; c < 3; ++c) {
            to->sent[c] += (double)s->all[i].p.flux[c];
        }
    }
    for (size_t at = 0; at < s->count; ++ways) {
        at += make_way(&out[ways], to, s, at, ways, cell, CLEAR * side, all / BUNDLES);
    }
    int32_t n = to->first[ways];
    for (int32_t i = 0; i < to->bundles[ways]; ++i) {
        n = add_far(to, &to->bundle[i], n);
    }
    to->noise = ROUNDED * side;
    return ways;
}

static int build_bvh(mix_job *j, report *r)
{
    const uint32_t triangles = lmb_scene_triangles(&j->scene);
    const size_t bytes = lmb_bvh_bytes(triangles);
    void *memory = mix_take(j, bytes, r);
    return memory != NULL && ((lmb_bvh_init(&j->sources->bvh, triangles, memory, bytes) == LMB_OK &&
                               lmb_bvh_build(&j->sources->bvh, &j->scene) == LMB_OK) ||
                              report_fail(r, "the object has too many triangles to shine"));
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
    return ways > 0 && !build_bvh(j, r) ? -1 : ways;
}
