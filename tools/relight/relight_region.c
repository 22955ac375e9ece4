/* relight_region.c: the light that an object's surfaces reflect, as a few regions that light each other. */
#include "relight_region.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265f

enum { ROUNDS = 3, FACES = 6, STEPS = 64 };

/* --- once --------------------------------------------------------------------------------------------------------- */

/* The quarter of a cube's side that a normal points at; fewer kinds if there are many parts. */
static uint32_t facing_of(lmb_vec3 n, uint32_t kinds)
{
    const float v[3] = {n.x, n.y, n.z};
    int axis = fabsf(n.x) >= fabsf(n.y) ? 0 : 1;
    axis = fabsf(n.z) > fabsf(v[axis]) ? 2 : axis;
    const uint32_t face = 2 * (uint32_t)axis + (v[axis] < 0.0f);
    const uint32_t quarter = 2 * (v[(axis + 1) % 3] < 0.0f) + (v[(axis + 2) % 3] < 0.0f);
    return kinds == 4 * FACES ? 4 * face + quarter : kinds == FACES ? face : 0;
}

static lmb_vec3 less(lmb_vec3 a, lmb_vec3 b) { return (lmb_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }

static void add_sample(region *p, const hidden_part *part, uint32_t sample, const float *directions, float area)
{
    const uint32_t vertex = hidden_sampled(part, sample);
    const lmb_vec3 n = part->normal[vertex], at = part->at[vertex];
    const uint64_t *blocked = part->blocked[sample / LMB_TILE_PIXELS];
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        const float cosine =
            n.x * directions[i] + n.y * directions[LMB_PROBE_TEXELS + i] + n.z * directions[2 * LMB_PROBE_TEXELS + i];
        if (cosine > 0.0f) {
            *(blocked[i] >> (sample % LMB_TILE_PIXELS) & 1 ? &p->shut[i] : &p->open[i]) += area * cosine;
        }
    }
    p->area += area;
    p->middle = (lmb_vec3){p->middle.x + area * at.x, p->middle.y + area * at.y, p->middle.z + area * at.z};
}

/* A triangle's vertices; a normal of twice the area's length; the kind of normal; the height step, below STEPS. */
typedef struct facet {
    uint32_t vertex[3], kind;
    lmb_vec3 normal;
    int step;
} facet;

static facet facet_of(const hidden *h, const hidden_part *part, uint32_t triangle, uint32_t kinds)
{
    facet f;
    for (uint32_t k = 0; k < 3; ++k) {
        f.vertex[k] = hidden_vertex(&part->mesh, 3 * triangle + k);
    }
    const lmb_vec3 *at = part->at, a = at[f.vertex[0]], b = at[f.vertex[1]], c = at[f.vertex[2]], u = less(b, a),
                   v = less(c, a);
    f.normal = (lmb_vec3){u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    f.kind = facing_of(f.normal, kinds);
    const float y = h->radius > 0.0f ? 0.5f + ((a.y + b.y + c.y) / 3.0f - h->middle.y) / (2.0f * h->radius) : 0.0f;
    f.step = (int)(fminf(fmaxf(y, 0.0f), 0.999f) * STEPS);
    return f;
}

static float area_of(const facet *f) { return 0.5f * sqrtf(hidden_dot(f->normal, f->normal)); }

/* Divides each kind's height steps into slices of equal area. */
static void slice_part(uint8_t out[4 * FACES][STEPS], const hidden *h, const hidden_part *part, uint32_t kinds,
                       uint32_t slices)
{
    float area[4 * FACES][STEPS] = {{0}};
    for (uint32_t t = 0; t < part->mesh.triangle_count; ++t) {
        const facet f = facet_of(h, part, t, kinds);
        area[f.kind][f.step] += area_of(&f);
    }
    for (uint32_t k = 0; k < kinds; ++k) {
        float all = 1e-30f, below = 0.0f;
        for (int i = 0; i < STEPS; ++i) {
            all += area[k][i];
        }
        for (int i = 0; i < STEPS; below += area[k][i++]) {
            const uint32_t slice = (uint32_t)((float)slices * (below + 0.5f * area[k][i]) / all);
            out[k][i] = (uint8_t)(slice < slices ? slice : slices - 1);
        }
    }
}

/* Samples the texture at a triangle's middle, at a mip level with texels of about the triangle's size. */
static void texel_of(float out[4], const lmb_texture *t, const lmb_vertex vertex[3])
{
    lmb_texture smooth = *t;
    const float *const uv[3] = {vertex[0].uv, vertex[1].uv, vertex[2].uv};
    const float twice =
        fabsf((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[2][0] - uv[0][0]) * (uv[1][1] - uv[0][1]));
    float texels = 0.5f * twice * (float)t->width * (float)t->height, level = 0.0f;
    for (; texels >= 2.0f && level < (float)(t->levels - 1); texels *= 0.25f) {
        level += 1.0f;
    }
    smooth.filter = t->levels > 1 ? LMB_TRILINEAR : t->filter;
    lmb_texture_sample(out, &smooth, (uv[0][0] + uv[1][0] + uv[2][0]) / 3.0f, (uv[0][1] + uv[1][1] + uv[2][1]) / 3.0f,
                       level);
}

/* Albedo as drawn: material x texture x vertex colours. */
static void add_albedo(region *p, const lmb_scene *scene, const lmb_instance *in, const lmb_mesh *m,
                       const uint32_t vertex[3], float area)
{
    const lmb_material *material = &scene->materials[in->material];
    float texel[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    lmb_vertex own[3];
    for (int k = 0; k < 3; ++k) {
        lmb_mesh_vertex(&own[k], m, vertex[k]);
    }
    if (material->texture >= 0) {
        texel_of(texel, &scene->textures[material->texture], own);
    }
    for (int c = 0; c < 3; ++c) {
        p->albedo[c] += area * material->albedo[c] * texel[c] *
                        (own[0].colour[c] + own[1].colour[c] + own[2].colour[c]) / 3.0f;
    }
}

/* Adds the area of each region nearest to each sample: many corners share one. `sums`: REGIONS x samples. */
static void add_sums(regions *p, const hidden_part *part, const float *sums, const float *directions)
{
    for (uint32_t k = 0; k < REGIONS; ++k) {
        for (uint32_t i = 0; i < part->samples; ++i) {
            const float area = sums[(size_t)k * part->samples + i];
            if (area > 0.0f) {
                add_sample(&p->region[k], part, i, directions, area);
            }
        }
    }
}

static int add_part(regions *p, uint8_t *of, const hidden *h, const hidden_part *part, const lmb_instance *in,
                    uint32_t first, uint32_t kinds, uint32_t slices, const float *directions)
{
    uint8_t slice[4 * FACES][STEPS];
    float *sums = part->share != NULL ? calloc((size_t)part->samples * REGIONS, sizeof *sums) : NULL;
    if (part->share != NULL && sums == NULL) {
        return 0;
    }
    slice_part(slice, h, part, kinds, slices);
    for (uint32_t t = 0; t < part->mesh.triangle_count; ++t) {
        const facet f = facet_of(h, part, t, kinds);
        of[t] = (uint8_t)(first + slices * f.kind + slice[f.kind][f.step]);
        for (int k = 0; k < 3; ++k) {
            if (sums != NULL) {
                sums[(size_t)of[t] * part->samples + part->share[f.vertex[k]].sample[0]] += area_of(&f) / 3.0f;
            } else {
                add_sample(&p->region[of[t]], part, f.vertex[k], directions, area_of(&f) / 3.0f);
            }
        }
        add_albedo(&p->region[of[t]], &h->scene, in, &part->mesh, f.vertex, area_of(&f));
    }
    if (sums != NULL) {
        add_sums(p, part, sums, directions);
    }
    free(sums);
    return 1;
}

static void finish(region *p)
{
    const float per = p->area > 0.0f ? 1.0f / p->area : 0.0f;
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        p->open[i] *= per;
        p->shut[i] *= per;
    }
    for (int c = 0; c < 3; ++c) {
        p->albedo[c] *= per;
    }
    p->middle = (lmb_vec3){p->middle.x * per, p->middle.y * per, p->middle.z * per};
}

static void set_opposite(uint16_t out[LMB_PROBE_TEXELS])
{
    enum { N = LMB_PROBE_SIDE };
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        const int32_t face = i / (N * N), x = i % N, y = i / N % N, is_level = face / 2 == 1;
        out[i] = (uint16_t)(((face ^ 1) * N + (is_level ? y : N - 1 - y)) * N + (is_level ? N - 1 - x : x));
    }
}

int regions_make(regions *out, const hidden *h, const float *directions)
{
    if (out->region != NULL) {
        return 1;
    }
    const uint32_t kinds = h->parts * 4 * FACES <= REGIONS ? 4 * FACES : h->parts * FACES <= REGIONS ? FACES : 1;
    const uint32_t fit = REGIONS / (h->parts * kinds), slices = fit > 0 ? fit : 1;
    uint32_t triangles = 0;
    out->region = calloc(REGIONS, sizeof *out->region);
    out->of = malloc((size_t)lmb_scene_triangles(&h->scene) + 1);
    if (out->region == NULL || out->of == NULL) {
        return 0;
    }
    for (uint32_t i = 0; i < h->parts; ++i) {
        const uint32_t wanted = slices * kinds * i, first = wanted < REGIONS ? wanted : REGIONS - 1;
        out->count = first + slices * kinds;
        if (!add_part(out, out->of + triangles, h, &h->part[i], &h->instances[i], first, kinds, slices, directions)) {
            return 0;
        }
        triangles += h->part[i].mesh.triangle_count;
    }
    for (uint32_t i = 0; i < out->count; ++i) {
        finish(&out->region[i]);
    }
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        float seen = 0.0f;
        for (uint32_t k = 0; k < out->count; ++k) {
            seen += out->region[k].area * out->region[k].shut[i];
        }
        out->per_seen[i] = seen > 0.0f ? 1.0f / seen : 0.0f;
    }
    set_opposite(out->opposite);
    return 1;
}

void regions_free(regions *p)
{
    free(p->region);
    free(p->of);
}

/* --- a picture ---------------------------------------------------------------------------------------------------- */

void region_directions(uint16_t at[4], float weight[4], const uint16_t *fold, lmb_vec3 d)
{
    enum { N = LMB_PROBE_SIDE, WIDE = LMB_PROBE_SIDE + 2 };
    const float x = fabsf(d.x), y = fabsf(d.y), z = fabsf(d.z);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const float along = axis == 0 ? d.x : axis == 1 ? d.y : d.z, size = 1.0f / fmaxf(fabsf(along), 1e-6f);
    const int face = 2 * axis + (along < 0.0f), sign = along < 0.0f ? -1 : 1;
    const float s = (axis == 0 ? -(float)sign * d.z : axis == 1 ? d.x : (float)sign * d.x) * size,
                t = (axis == 1 ? (float)sign * d.z : -d.y) * size;
    const float u = fminf(fmaxf((s + 1.0f) * (0.5f * N) + 0.5f, 0.0f), (float)N + 0.999f),
                v = fminf(fmaxf((t + 1.0f) * (0.5f * N) + 0.5f, 0.0f), (float)N + 0.999f);
    const int ix = (int)u, iy = (int)v;
    for (int k = 0; k < 4; ++k) {
        const float wx = k & 1 ? u - (float)ix : 1.0f - (u - (float)ix),
                    wy = k & 2 ? v - (float)iy : 1.0f - (v - (float)iy);
        at[k] = fold[(face * WIDE + iy + (k >> 1)) * WIDE + ix + (k & 1)];
        weight[k] = wx * wy;
    }
}

/* Peaks as weighted neighbouring directions of the reduced cube. */
typedef struct beside {
    uint16_t at[LMB_PROBE_PEAKS][4];
    float weight[LMB_PROBE_PEAKS][4];
} beside;

static float open_to(const region *p, const beside *b, int32_t i)
{
    if (i < LMB_PROBE_TEXELS) {
        return p->open[i];
    }
    const uint16_t *at = b->at[i - LMB_PROBE_TEXELS];
    const float *weight = b->weight[i - LMB_PROBE_TEXELS];
    return weight[0] * p->open[at[0]] + weight[1] * p->open[at[1]] + weight[2] * p->open[at[2]] +
           weight[3] * p->open[at[3]];
}

/* Sets the irradiance by the world. */
static void take_world(float out[3], const region *p, const far_lights *f, const beside *b, region_ground *ground,
                       const void *user)
{
    out[0] = out[1] = out[2] = 0.0f;
    for (int32_t i = 0; i < f->count; ++i) {
        const far_light *l = &f->light[i];
        const float open = open_to(p, b, i);
        float left[3] = {1.0f, 1.0f, 1.0f};
        if (open > 0.0f && ground != NULL && l->to.y < -HIDDEN_LOWEST) {
            ground(left, user, p->middle, l->to);
        }
        for (int c = 0; c < 3; ++c) {
            out[c] += open * left[c] * l->rgb[c];
        }
    }
}

/* Sets the light that regions reflect along each direction to those that see them there: the mean of the visible
 * ones. */
static void set_back(far_lights *f, const regions *p, float (*light)[3])
{
    float sum[LMB_PROBE_TEXELS][3] = {{0}};
    for (uint32_t k = 0; k < p->count; ++k) {
        const region *q = &p->region[k];
        for (int32_t i = 0; i < LMB_PROBE_TEXELS && q->area > 0.0f; ++i) {
            const float seen = q->area * q->shut[i];
            sum[i][0] += seen * light[k][0];
            sum[i][1] += seen * light[k][1];
            sum[i][2] += seen * light[k][2];
        }
    }
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        for (int c = 0; c < 3; ++c) {
            f->light[p->opposite[i]].back[c] = sum[i][c] * p->per_seen[i];
        }
    }
}

/* Computes a region's radiance from the world's irradiance and the light of the other regions. */
static void reflect(float out[3], const region *p, const float world[3], const far_lights *f)
{
    float sum[3] = {world[0], world[1], world[2]};
    for (int32_t i = 0; i < LMB_PROBE_TEXELS; ++i) {
        const float seen = p->shut[i] * f->angle[i];
        sum[0] += seen * f->light[i].back[0];
        sum[1] += seen * f->light[i].back[1];
        sum[2] += seen * f->light[i].back[2];
    }
    for (int c = 0; c < 3; ++c) {
        out[c] = p->albedo[c] * sum[c] / PI;
    }
}

void regions_light(float out[REGIONS][3], far_lights *f, const regions *p, const uint16_t *fold, region_ground *ground,
                   const void *user)
{
    float world[REGIONS][3];
    beside peaks;
    for (int32_t i = LMB_PROBE_TEXELS; i < f->count; ++i) {
        region_directions(peaks.at[i - LMB_PROBE_TEXELS], peaks.weight[i - LMB_PROBE_TEXELS], fold, f->light[i].to);
    }
    for (int32_t i = 0; i < f->count; ++i) {
        memset(f->light[i].back, 0, sizeof f->light[i].back);
    }
    for (uint32_t k = 0; k < p->count; ++k) {
        out[k][0] = out[k][1] = out[k][2] = 0.0f;
        if (p->region[k].area > 0.0f) {
            take_world(world[k], &p->region[k], f, &peaks, ground, user);
        }
    }
    for (int round = 0; round < ROUNDS; ++round) {
        for (uint32_t k = 0; k < p->count; ++k) {
            if (p->region[k].area > 0.0f) {
                reflect(out[k], &p->region[k], world[k], f);
            }
        }
        set_back(f, p, out);
    }
}
