/* light_picture.c: bounced light as a texture for new coordinates: charts of triangles with similar normals.
 *
 * Triangles are cut like in the bake, because light differs on both sides of a wall. A chart grows from its largest
 * triangle over shared edges, except at walls, and is projected along that triangle's normal. Triangles that would
 * overlap others of their chart become separate charts. Texels at an edge take the light of the nearest point of the
 * triangle, and two more rings of texels take that of their neighbours, so that no filter reads dark texels. */
#include "light_export.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "../model/io_lmt.h"
#include "bake_triangle.h"

#define ALIKE  0.8f /* least cosine between a triangle and the chart that it joins */
#define INSIDE 0.002f
enum { GUTTER = 3, TRIES = 60, DILATED = 3 };

typedef struct face {
    light_corner corner[3];
    lmb_vec3 normal;
    float area;
    uint32_t id, object;
    int32_t chart;
    int is_alone;
    uint32_t walls; /* a bit per edge: geometry touches it */
} face;

typedef struct edge {
    uint64_t key;
    uint32_t face;
} edge;

typedef struct chart {
    lmb_vec3 along[2];
    float low[2], high[2];       /* m */
    int32_t x, y, width, height; /* texels */
    uint32_t number;
} chart;

typedef struct texel {
    float far;     /* distance from the triangle, texels; negative: inside */
    uint32_t face; /* + 1; 0: none */
    lmb_vec3 at, normal;
} texel;

typedef struct map {
    light_solve *s;
    const model_source *source;
    face *face;
    edge *edge;
    chart *chart;
    texel *texel;
    float *light; /* 3 per texel */
    uint8_t *known;
    uint32_t *neighbour; /* three per face: adjacent face, or UINT32_MAX */
    uint32_t *beyond;    /* likewise: adjacent face behind a wall */
    uint32_t faces, charts;
    int32_t side;
    float per; /* texels per metre */
    report *r;
} map;

/* --- faces -------------------------------------------------------------------------------------------------------- */

/* Returns whether there are cuts at a node or below it. */
static int has_cut(const lmb_transfer *t, uint32_t at)
{
    const uint32_t word = t->section[LMB_TRANSFER_DIVISIONS][at];
    if ((word & LMB_TRANSFER_LEAF) != 0 || word >> LMB_TRANSFER_EDGE_BIT == LMB_TRANSFER_CUT) {
        return (word & LMB_TRANSFER_LEAF) == 0;
    }
    const uint32_t first = word & ((1u << LMB_TRANSFER_EDGE_BIT) - 1u);
    return has_cut(t, first) || has_cut(t, first + 1);
}

/* Moves the bits of edges k, k + 1 and k + 2 into place. */
static uint32_t edges_from(int k, uint32_t own, uint32_t next, uint32_t last)
{
    return own << k | next << (k + 1) % 3 | last << (k + 2) % 3;
}

/* Adds the parts of a face. Corners are in the file's order; `is_turned`: faces have the opposite winding. */
static void put_parts(map *m, const face *of, uint32_t at, int is_turned)
{
    const lmb_transfer *t = &m->s->job.transfer;
    if (at == LMB_TRANSFER_NONE || !has_cut(t, at)) {
        face *f = &m->face[m->faces++];
        *f = *of;
        if (is_turned) {
            f->corner[0] = of->corner[2];
            f->corner[2] = of->corner[0];
            f->walls = (of->walls & 1u) << 1 | (of->walls >> 1 & 1u) | (of->walls & 4u);
        }
        const lmb_vec3 corner[3] = {f->corner[0].at, f->corner[1].at, f->corner[2].at};
        f->area = triangle_area(corner);
        return;
    }
    const lmt_halving h = lmt_halving_of(t, at);
    const int from = h.from, to = h.to;
    const uint32_t own = of->walls >> from & 1u, next = of->walls >> to & 1u, last = of->walls >> (to + 1) % 3 & 1u;
    face half = *of;
    half.corner[to] = light_along(&of->corner[from], &of->corner[to], h.part);
    half.walls = edges_from(from, own, (uint32_t)h.is_wall, last);
    put_parts(m, &half, h.first, is_turned);
    half.corner[from] = half.corner[to];
    half.corner[to] = of->corner[to];
    half.walls = edges_from(from, own, next, (uint32_t)h.is_wall);
    put_parts(m, &half, h.first + 1, is_turned);
}

static int put_faces(map *m)
{
    const lmb_scene *scene = &m->s->job.scene;
    const lmb_transfer *t = &m->s->job.transfer;
    const uint32_t ids = t->count[LMB_TRANSFER_SURFACES];
    const size_t cap = 2 * (size_t)ids + t->count[LMB_TRANSFER_DIVISIONS] + 1;
    m->face = calloc(cap, sizeof *m->face);
    m->edge = malloc(3 * cap * sizeof *m->edge);
    m->chart = calloc(cap, sizeof *m->chart);
    m->neighbour = malloc(3 * cap * sizeof *m->neighbour);
    m->beyond = malloc(3 * cap * sizeof *m->beyond);
    if (m->face == NULL || m->edge == NULL || m->chart == NULL || m->neighbour == NULL || m->beyond == NULL) {
        return report_fail(m->r, "not enough memory for %u triangles", (unsigned)ids);
    }
    for (uint32_t id = 1; id <= ids; ++id) {
        for (uint32_t back = 0; back < 2; ++back) {
            const uint32_t root =
                t->section[LMB_TRANSFER_SURFACES][LMB_TRANSFER_SURFACE_WORDS * (size_t)(id - 1) + 2 + back];
            lmb_triangle own;
            face f;
            memset(&f, 0, sizeof f);
            if ((back && root == LMB_TRANSFER_NONE) || !lmb_triangle_fetch(&own, scene, id) ||
                !light_corners(f.corner, &f.normal, scene, m->source, id, back)) {
                continue;
            }
            const lmb_vec3 d = sub3(f.corner[0].at, own.corner[0]);
            const int is_turned = dot3(d, d) > 0.0f;
            const light_corner first = f.corner[is_turned ? 2 : 0];
            f.corner[2] = f.corner[is_turned ? 0 : 2];
            f.corner[0] = first;
            f.id = id;
            f.object = 2 * (uint32_t)(own.instance - scene->instances) + back;
            put_parts(m, &f, root, is_turned);
        }
    }
    return 1;
}

static uint64_t key_of(const face *f, int k)
{
    const lmb_vec3 a = f->corner[k].at, b = f->corner[(k + 1) % 3].at;
    const float v[2][3] = {{a.x + 0.0f, a.y + 0.0f, a.z + 0.0f}, {b.x + 0.0f, b.y + 0.0f, b.z + 0.0f}};
    const int turned = memcmp(v[0], v[1], sizeof v[0]) > 0;
    const uint64_t hash = slice_hash(SLICE_HASH ^ f->object, v[turned], sizeof v[0]);
    return slice_hash(hash, v[!turned], sizeof v[0]);
}

static int by_key(const void *a, const void *b)
{
    const edge *x = a, *y = b;
    return x->key != y->key ? (x->key < y->key ? -1 : 1) : x->face < y->face ? -1 : x->face > y->face;
}

static int is_at_wall(const map *m, uint32_t i) { return (m->face[i / 3].walls >> i % 3 & 1u) != 0; }

static void join_faces(map *m)
{
    for (uint32_t i = 0; i < 3 * m->faces; ++i) {
        m->edge[i].key = key_of(&m->face[i / 3], (int)(i % 3));
        m->edge[i].face = i;
        m->neighbour[i] = m->beyond[i] = UINT32_MAX;
    }
    if (m->faces > 0) {
        qsort(m->edge, 3 * (size_t)m->faces, sizeof *m->edge, by_key);
    }
    for (uint32_t i = 1; i < 3 * m->faces; ++i) {
        const edge *a = &m->edge[i - 1], *b = &m->edge[i];
        if (a->key == b->key) {
            uint32_t *to = is_at_wall(m, a->face) || is_at_wall(m, b->face) ? m->beyond : m->neighbour;
            to[a->face] = b->face / 3;
            to[b->face] = a->face / 3;
        }
    }
}

/* --- charts ------------------------------------------------------------------------------------------------------- */

/* A face in the order of area. */
typedef struct seed {
    float area;
    uint32_t face;
} seed;

static int by_area(const void *a, const void *b)
{
    const seed *x = a, *y = b;
    return x->area != y->area ? (x->area > y->area ? -1 : 1) : x->face < y->face ? -1 : x->face > y->face;
}

static float along(const chart *c, int k, lmb_vec3 p) { return dot3(c->along[k], p); }

/* The longest edge of the face lies along u. */
static void begin_chart(chart *c, const face *f)
{
    int longest = 0;
    float peak = -1.0f;
    for (int k = 0; k < 3; ++k) {
        const lmb_vec3 d = sub3(f->corner[(k + 1) % 3].at, f->corner[k].at);
        longest = dot3(d, d) > peak ? k : longest;
        peak = maxf(peak, dot3(d, d));
    }
    const lmb_vec3 d = sub3(f->corner[(longest + 1) % 3].at, f->corner[longest].at);
    c->along[0] = mul3(d, 1.0f / maxf(length3(d), 1e-20f));
    c->along[1] = cross3(f->normal, c->along[0]);
    for (int k = 0; k < 2; ++k) {
        c->low[k] = INFINITY;
        c->high[k] = -INFINITY;
    }
}

static void add_to_chart(map *m, chart *c, uint32_t i)
{
    m->face[i].chart = (int32_t)(c - m->chart);
    for (int k = 0; k < 6; ++k) {
        const float at = along(c, k % 2, m->face[i].corner[k / 2].at);
        c->low[k % 2] = minf(c->low[k % 2], at);
        c->high[k % 2] = maxf(c->high[k % 2], at);
    }
}

/* Returns whether a wall separates it from a face of the chart, to which another path may lead around the wall. */
static int is_parted(const map *m, uint32_t i, int32_t of)
{
    for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t other = m->beyond[3 * i + k];
        if (other != UINT32_MAX && m->face[other].chart == of) {
            return 1;
        }
    }
    return 0;
}

/* Grows over shared edges, breadth first. */
static void grow_chart(map *m, chart *c, uint32_t first, uint32_t *wave)
{
    const lmb_vec3 normal = m->face[first].normal;
    uint32_t count = 1;
    wave[0] = first;
    for (uint32_t at = 0; at < count; ++at) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t other = m->neighbour[3 * wave[at] + k];
            if (other != UINT32_MAX && m->face[other].chart < 0 && !m->face[other].is_alone &&
                dot3(m->face[other].normal, normal) > ALIKE && !is_parted(m, other, (int32_t)(c - m->chart))) {
                add_to_chart(m, c, other);
                wave[count++] = other;
            }
        }
    }
}

static int make_charts(map *m)
{
    seed *order = malloc(((size_t)m->faces + 1) * sizeof *order);
    uint32_t *wave = malloc(((size_t)m->faces + 1) * sizeof *wave);
    const int ok =
        (order != NULL && wave != NULL) || report_fail(m->r, "not enough memory for %u triangles", (unsigned)m->faces);
    m->charts = 0;
    for (uint32_t i = 0; ok && i < m->faces; ++i) {
        order[i].area = m->face[i].area;
        order[i].face = i;
        m->face[i].chart = -1;
    }
    if (ok && m->faces > 0) {
        qsort(order, m->faces, sizeof *order, by_area);
    }
    for (uint32_t i = 0; ok && i < m->faces; ++i) {
        const uint32_t first = order[i].face;
        if (m->face[first].chart < 0) {
            chart *c = &m->chart[m->charts++];
            begin_chart(c, &m->face[first]);
            add_to_chart(m, c, first);
            if (!m->face[first].is_alone) {
                grow_chart(m, c, first, wave);
            }
        }
    }
    free(order);
    free(wave);
    return ok;
}

/* --- the picture's room ------------------------------------------------------------------------------------------- */

static int by_height(const void *a, const void *b)
{
    const chart *x = *(chart *const *)a, *y = *(chart *const *)b;
    return x->height != y->height ? (x->height > y->height ? -1 : 1)
           : x->width != y->width ? (x->width > y->width ? -1 : 1)
           : x < y                ? -1
                                  : x > y;
}

/* Packs charts onto shelves, the highest first; returns 0 if they do not fit. */
static int lay_out(map *m, chart **order)
{
    int32_t x = 0, y = 0, shelf = 0;
    for (uint32_t i = 0; i < m->charts; ++i) {
        chart *c = order[i] = &m->chart[i];
        const float w = (c->high[0] - c->low[0]) * m->per, h = (c->high[1] - c->low[1]) * m->per;
        if (w > (float)m->side || h > (float)m->side) {
            return 0;
        }
        c->width = (int32_t)ceilf(w) + 1 + 2 * GUTTER;
        c->height = (int32_t)ceilf(h) + 1 + 2 * GUTTER;
    }
    qsort(order, m->charts, sizeof *order, by_height);
    for (uint32_t i = 0; i < m->charts; ++i) {
        chart *c = order[i];
        if (x + c->width > m->side) {
            x = 0;
            y += shelf;
            shelf = 0;
        }
        shelf = c->height > shelf ? c->height : shelf;
        if (c->width > m->side || y + c->height > m->side) {
            return 0;
        }
        c->x = x;
        c->y = y;
        x += c->width;
    }
    return 1;
}

static int find_room(map *m)
{
    double area = 0.0;
    chart **order = malloc(((size_t)m->charts + 1) * sizeof *order);
    for (uint32_t i = 0; i < m->charts; ++i) {
        const chart *c = &m->chart[i];
        area += (double)(c->high[0] - c->low[0]) * (double)(c->high[1] - c->low[1]);
    }
    m->per = (float)m->side / sqrtf((float)area + 1e-20f);
    int fits = 0;
    for (int i = 0; order != NULL && !fits && i < TRIES; ++i) {
        fits = lay_out(m, order);
        m->per *= fits ? 1.0f : 0.94f;
    }
    free(order);
    return fits || (order == NULL ? report_fail(m->r, "not enough memory for %u charts", (unsigned)m->charts)
                                  : report_fail(m->r, "%u charts do not fit %d x %d texels; give a larger --texels",
                                                (unsigned)m->charts, (int)m->side, (int)m->side));
}

/* In texels; texel centres are at .5. */
static void texel_of(float out[2], const map *m, const face *f, lmb_vec3 at)
{
    const chart *c = &m->chart[f->chart];
    out[0] = (float)c->x + (float)GUTTER + 0.5f + (along(c, 0, at) - c->low[0]) * m->per;
    out[1] = (float)c->y + (float)GUTTER + 0.5f + (along(c, 1, at) - c->low[1]) * m->per;
}

/* --- texels ------------------------------------------------------------------------------------------------------- */

static float cross2(const float a[2], const float b[2], const float p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* Returns the distance to the nearest point of a triangle, negative inside; w: the weights of that point. */
static float nearest(float w[3], float corner[3][2], const float p[2])
{
    const float all = cross2(corner[0], corner[1], corner[2]);
    float best = INFINITY;
    int inside = all != 0.0f;
    for (int k = 0; k < 3; ++k) {
        w[k] = inside ? cross2(corner[(k + 1) % 3], corner[(k + 2) % 3], p) / all : -1.0f;
    }
    inside = inside && w[0] >= 0.0f && w[1] >= 0.0f && w[2] >= 0.0f;
    if (inside) {
        return -minf(w[0], minf(w[1], w[2]));
    }
    for (int k = 0; k < 3; ++k) {
        const float *a = corner[k], *b = corner[(k + 1) % 3], d[2] = {b[0] - a[0], b[1] - a[1]};
        const float long2 = d[0] * d[0] + d[1] * d[1];
        float t = long2 > 0.0f ? ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / long2 : 0.0f;
        t = minf(maxf(t, 0.0f), 1.0f);
        const float x = a[0] + t * d[0] - p[0], y = a[1] + t * d[1] - p[1], far = sqrtf(x * x + y * y);
        if (far < best) {
            best = far;
            w[k] = 1.0f - t;
            w[(k + 1) % 3] = t;
            w[(k + 2) % 3] = 0.0f;
        }
    }
    return best;
}

/* Rasterizes a face; returns 0 if it overlaps another one of the chart. */
static int draw_face(map *m, uint32_t i)
{
    const face *f = &m->face[i];
    float corner[3][2], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    int free_of_others = 1;
    for (int k = 0; k < 3; ++k) {
        texel_of(corner[k], m, f, f->corner[k].at);
        for (int c = 0; c < 2; ++c) {
            low[c] = minf(low[c], corner[k][c]);
            high[c] = maxf(high[c], corner[k][c]);
        }
    }
    for (int32_t y = (int32_t)low[1] - 1; y <= (int32_t)high[1] + 1; ++y) {
        for (int32_t x = (int32_t)low[0] - 1; x <= (int32_t)high[0] + 1; ++x) {
            float w[3];
            const float p[2] = {(float)x + 0.5f, (float)y + 0.5f}, far = nearest(w, corner, p);
            texel *t = x >= 0 && y >= 0 && x < m->side && y < m->side
                           ? &m->texel[(size_t)y * (size_t)m->side + (size_t)x]
                           : NULL;
            if (t == NULL || far > 1.5f) {
                continue;
            }
            free_of_others &= !(t->face != 0 && far < -0.02f && t->far < -0.02f);
            if (t->face != 0 && t->far <= far) {
                continue;
            }
            t->far = far;
            t->face = i + 1;
            t->at = t->normal = vec3(0.0f, 0.0f, 0.0f);
            for (int k = 0; k < 3; ++k) {
                const float in = w[k] * (1.0f - INSIDE) + INSIDE / 3.0f;
                t->at = add3(t->at, mul3(f->corner[k].at, in));
                t->normal = add3(t->normal, mul3(f->corner[k].normal, in));
            }
        }
    }
    return free_of_others;
}

/* Rasterizes all faces; moves those that overlap others to separate charts and returns 0. */
static int draw_faces(map *m)
{
    int ok = 1;
    memset(m->texel, 0, (size_t)m->side * (size_t)m->side * sizeof *m->texel);
    for (uint32_t i = 0; i < m->faces; ++i) {
        if (!draw_face(m, i)) {
            m->face[i].is_alone = 1;
            ok = 0;
        }
    }
    return ok;
}

static void light_texels(map *m)
{
    light_place place[SOLVE_PLACES];
    float out[SOLVE_PLACES][3];
    size_t at[SOLVE_PLACES], all = (size_t)m->side * (size_t)m->side;
    int count = 0;
    for (size_t i = 0; i <= all; ++i) {
        if (i < all && m->texel[i].face != 0) {
            const texel *t = &m->texel[i];
            const face *f = &m->face[t->face - 1];
            const float length = length3(t->normal);
            const light_place p = {t->at, f->normal, length > 0.0f ? mul3(t->normal, 1.0f / length) : f->normal, f->id};
            place[count] = p;
            at[count++] = i;
        }
        if (count == SOLVE_PLACES || (i == all && count > 0)) {
            light_at(out, m->s, place, count);
            for (int k = 0; k < count; ++k) {
                memcpy(m->light + 3 * at[k], out[k], sizeof out[k]);
                m->known[at[k]] = 1;
            }
            count = 0;
        }
    }
}

/* Gives texels next to known ones their mean. */
static void dilate(map *m, uint8_t round)
{
    for (int32_t y = 0; y < m->side; ++y) {
        for (int32_t x = 0; x < m->side; ++x) {
            const size_t i = (size_t)y * (size_t)m->side + (size_t)x;
            float sum[3] = {0.0f, 0.0f, 0.0f}, n = 0.0f;
            for (int k = 0; k < 9 && m->known[i] == 0; ++k) {
                const int32_t px = x + k % 3 - 1, py = y + k / 3 - 1;
                const size_t o = (size_t)py * (size_t)m->side + (size_t)px;
                if (px >= 0 && py >= 0 && px < m->side && py < m->side && m->known[o] != 0 && m->known[o] < round) {
                    n += 1.0f;
                    for (int c = 0; c < 3; ++c) {
                        sum[c] += m->light[3 * o + (size_t)c];
                    }
                }
            }
            for (int c = 0; c < 3 && n > 0.0f; ++c) {
                m->light[3 * i + (size_t)c] = sum[c] / n;
                m->known[i] = round;
            }
        }
    }
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

/* past[code]: the light from which on a larger code is nearer. */
static uint8_t code_of(float v, const double past[255])
{
    int low = 0, high = 255;
    while (low < high) {
        const int middle = (low + high) / 2;
        if ((double)v > past[middle]) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return (uint8_t)low;
}

/* Encodes the PNG; *scale becomes the light of the brightest texel. */
static int encode(file_bytes *out, float *scale, const map *m)
{
    const size_t floats = 3 * (size_t)m->side * (size_t)m->side;
    uint8_t *rgb = malloc(floats);
    double past[255];
    *scale = 1e-20f;
    for (int code = 0; code < 255; ++code) {
        past[code] = 0.5 * (srgb_decode(code) + srgb_decode(code + 1));
    }
    for (size_t i = 0; i < floats; ++i) {
        *scale = maxf(*scale, m->light[i]);
    }
    for (size_t i = 0; rgb != NULL && i < floats; ++i) {
        rgb[i] = code_of(maxf(m->light[i], 0.0f) / *scale, past);
    }
    const int ok = rgb != NULL ? png_encode(out, rgb, m->side, m->side, m->r)
                               : report_fail(m->r, "not enough memory for the lightmap");
    free(rgb);
    return ok;
}

static int put_mesh(map *m, glb_mesh *out, uint32_t first, uint32_t past)
{
    const lmb_scene *scene = &m->s->job.scene;
    light_mesh own;
    int ok = light_mesh_begin(&own, scene, m->face[first].object / 2, m->r);
    for (uint32_t i = first; ok && i < past; ++i) {
        glb_vertex v[3];
        for (int k = 0; k < 3; ++k) {
            light_vertex_of(&v[k], &m->face[i].corner[k]);
            texel_of(v[k].light_uv, m, &m->face[i], m->face[i].corner[k].at);
            v[k].light_uv[0] /= (float)m->side;
            v[k].light_uv[1] /= (float)m->side;
        }
        ok = light_mesh_put(&own, v, m->r);
    }
    light_mesh_end(&own);
    *out = own.mesh;
    return ok;
}

static int write(const map *m, const char *path, const model *loaded, glb_mesh *mesh)
{
    file_bytes png = {NULL, 0};
    glb_light light = {"lightmap", 1.0f, &png};
    uint32_t count = 0;
    map own = *m;
    int ok = encode(&png, &light.scale, m);
    for (uint32_t first = 0, past; ok && first < m->faces; first = past) {
        for (past = first + 1; past < m->faces && m->face[past].object / 2 == m->face[first].object / 2; ++past) {
        }
        ok = put_mesh(&own, &mesh[count++], first, past);
    }
    ok = ok && glb_write(path, &m->s->job.scene, loaded, mesh, count, &light, m->r);
    for (uint32_t i = 0; i < count; ++i) {
        free(mesh[i].vertex);
        free(mesh[i].index);
    }
    file_free(&png);
    return ok;
}

/* Builds charts and their texels until none overlap. */
static int draw(map *m)
{
    int is_drawn = 0;
    for (int i = 0; i < 8 && !is_drawn; ++i) {
        if (!make_charts(m) || !find_room(m)) {
            return 0;
        }
        is_drawn = draw_faces(m);
    }
    return is_drawn || report_fail(m->r, "charts that do not overlap were not found; give another --texels");
}

int light_picture(const char *path, light_solve *s, const model *loaded, int32_t side, report *r)
{
    map m;
    memset(&m, 0, sizeof m);
    m.s = s;
    m.source = loaded->source;
    m.r = r;
    m.side = side;
    const size_t texels = (size_t)side * (size_t)side;
    glb_mesh *mesh = calloc((size_t)s->job.scene.instance_count + 1, sizeof *mesh);
    m.texel = malloc(texels * sizeof *m.texel);
    m.light = calloc(texels, 3 * sizeof *m.light);
    m.known = calloc(texels, 1);
    int ok = (mesh != NULL && m.texel != NULL && m.light != NULL && m.known != NULL) ||
             report_fail(r, "not enough memory for %d x %d texels", (int)side, (int)side);
    ok = ok && put_faces(&m);
    if (ok) {
        join_faces(&m);
    }
    ok = ok && draw(&m);
    if (ok) {
        light_texels(&m);
        for (uint8_t round = 2; round < 2 + DILATED; ++round) {
            dilate(&m, round);
        }
    }
    ok = ok && write(&m, path, loaded, mesh);
    free(mesh);
    free(m.face);
    free(m.edge);
    free(m.chart);
    free(m.neighbour);
    free(m.beyond);
    free(m.texel);
    free(m.light);
    free(m.known);
    return ok;
}
