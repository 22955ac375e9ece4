/* draw_rows.c: pixels of common states with specialised code, in plain C or by lanes. Layer 4.
 *
 * Common: 32-bit depth without a stencil; four-byte colours, opaque or blended by their alpha, with at most one
 * texture. Lanes support more. Values are those of draw_tile.c, which handles all other states. Values that all
 * pixels of a shape share are computed outside the loop. */
#include "draw_part.h"

#include <string.h>

#include "../lane/kernels.h"
#include "../raster/texels.h"

#if LMB_DRAW
/* How colours are written to the target. */
enum { ROWS_NOT = 0, ROWS_OPAQUE = 1, ROWS_ALPHA = 2, ROWS_ADD = 3 };

static int rows_blend(const lmb_draw_state *s)
{
    const int source = s->blend_source[0], target = s->blend_target[0];
    if ((s->flags & LMB_DRAW_LOGIC) != 0 || s->colour_mask != 15) {
        return ROWS_NOT;
    }
    if ((s->flags & LMB_DRAW_BLEND) == 0) {
        return ROWS_OPAQUE;
    }
    if (s->blend_equation[0] != LMB_DRAW_ADD || s->blend_equation[1] != LMB_DRAW_ADD || source != s->blend_source[1] ||
        target != s->blend_target[1] || source != LMB_DRAW_SOURCE_ALPHA) {
        return ROWS_NOT;
    }
    return target == LMB_DRAW_INVERSE_SOURCE_ALPHA ? ROWS_ALPHA : target == LMB_DRAW_ONE ? ROWS_ADD : ROWS_NOT;
}

static int rows_are_wide(const lmb_draw_target *t)
{
    return t->colour.format == LMB_RGBA8 || t->colour.format == LMB_BGRA8;
}

/* At most one texture, nearest, in the usual modes. */
static int rows_sample(const lmb_draw_state *s)
{
    const lmb_draw_stage *stage = &s->stage[0];
    return s->stage[1].texture == NULL &&
           (stage->texture == NULL || (texels_are_rgba8(stage->texture) && stage->texture->filter == LMB_NEAREST &&
                                       (stage->mode == LMB_DRAW_MODULATE || stage->mode == LMB_DRAW_REPLACE)));
}

#if LMB_DRAW_LANES
/* 1 if 32-bit reads of colours have red in the low bits. */
static int rows_are_little(void)
{
    const uint32_t one = 1;
    uint8_t first;
    memcpy(&first, &one, 1);
    return first == 1;
}

static int rows_lanes_sample(const lmb_draw_state *s)
{
    int good = 1;
    for (int i = 0; i < LMB_DRAW_STAGES; ++i) {
        const lmb_texture *t = s->stage[i].texture;
        good &= t == NULL || (texels_are_rgba8(t) && (t->filter != LMB_TRILINEAR || t->levels < 2) &&
                              s->stage[i].mode <= LMB_DRAW_PLUS);
    }
    return good;
}

/* 1: a kernel has the colours of this state: at most one texture, which replaces or modulates; opaque or blended by
 * alpha. */
static int rows_are_usual(const lmb_draw_pass *pass)
{
    const lmb_draw_stage *stage = pass->state->stage;
    return pass->paints_lanes && rows_blend(pass->state) != ROWS_NOT && stage[1].texture == NULL &&
           (stage[0].texture == NULL || stage[0].mode == LMB_DRAW_MODULATE || stage[0].mode == LMB_DRAW_REPLACE);
}

/* 1: a kernel draws whole triangles. */
static int rows_draw_areas(const lmb_draw_pass *pass)
{
    return rows_are_usual(pass) && pass->state->kernels->draw_area != NULL && pass->state->area_pattern == NULL &&
           (!pass->tests || (pass->tests_rows && pass->target->depth.layout == LMB_LINEAR));
}

/* 1: a kernel draws small triangles in batches, without fog. It reads and writes rows of eight pixels
 * inside the pass's tiles. */
static int rows_draw_small(const lmb_draw_pass *pass)
{
    const lmb_draw_target *t = pass->target;
    return pass->draws != 0 && pass->state->kernels->draw_small != NULL &&
           (pass->state->stage[0].texture == NULL || pass->vertices->uvs[0] != NULL) &&
           pass->state->fog == LMB_DRAW_FOG_NONE &&
           mini(pass->x1 | 7, t->x0 + t->colour.width - 1) - maxi(pass->x0 & ~7, t->x0) >= 7 &&
           pass->vertices->count < (uint32_t)1 << 28; /* indices of floats fit 32 bits */
}

/* 1: a kernel colours both triangles of upright rectangles. */
static int rows_fills_sheet(const lmb_draw_pass *pass)
{
    return rows_are_usual(pass) && pass->state->kernels->draw_sheet != NULL && pass->state->fog == LMB_DRAW_FOG_NONE;
}
#endif

void lmb_draw_rows_begin(lmb_draw_pass *pass)
{
    const lmb_draw_state *s = pass->state;
    const int seconds = pass->vertices->seconds != NULL || pass->vertices->back_seconds != NULL;
    const int paints = pass->shows && !pass->paints_first && !seconds && s->shader == NULL && s->passed == NULL &&
                       rows_are_wide(pass->target);
    pass->tests_rows = (s->flags & LMB_DRAW_DEPTH_TEST) != 0 && (s->flags & LMB_DRAW_STENCIL) == 0 &&
                       pass->target->depth.format == LMB_DEPTH32F;
    pass->paints_rows = paints && s->fog == LMB_DRAW_FOG_NONE && rows_sample(s) ? rows_blend(s) : ROWS_NOT;
    int sheets = 0;
    pass->draws = 0;
#if LMB_DRAW_LANES
    pass->paints_lanes =
        s->kernels != NULL && paints && rows_are_little() && rows_lanes_sample(s);
    pass->draws |= rows_draw_areas(pass) ? DRAW_AREAS : 0;
    pass->draws |= rows_draw_small(pass) ? DRAW_SMALLS : 0;
    sheets = rows_fills_sheet(pass) ? DRAW_FILLS_SHEET : 0;
#endif
    if (paints && !pass->tests && s->area_pattern == NULL && s->planes == 0 && pass->vertices->back_colours == NULL &&
        (s->flags & (LMB_DRAW_CULL_FRONT | LMB_DRAW_CULL_BACK)) == 0 && s->polygon_mode[0] == LMB_DRAW_FILL &&
        s->polygon_mode[1] == LMB_DRAW_FILL) {
        pass->fills = (pass->paints_rows != ROWS_NOT && s->stage[0].texture == NULL ? DRAW_FILLS_COLOUR : 0) | sheets;
    }
}

/* --- by lanes ----------------------------------------------------------------------------------------------------- */

#if LMB_DRAW_LANES
/* Kernels write whole rows of a tile, so the target must have them. For few pixels, a row at a time is as fast. */
enum { ROWS_FEW_TESTED = 6, ROWS_FEW_PAINTED = 3 };

static int rows_are_whole(const tile_job *j)
{
    const lmb_draw_target *t = j->pass->target;
    const lmb_surface *s = t->colour.data != NULL ? &t->colour : &t->depth;
    return j->x - t->x0 + LMB_TILE <= s->width && j->y - t->y0 + LMB_TILE <= s->height;
}

int lmb_draw_rows_stencils(const tile_job *j)
{
    const lmb_draw_state *s = j->pass->state;
    return (s->flags & LMB_DRAW_STENCIL) != 0 && s->kernels != NULL && rows_are_little() && rows_are_whole(j) &&
           ((s->flags & LMB_DRAW_DEPTH_TEST) == 0 || j->pass->target->depth.format == LMB_DEPTH32F);
}

static int rows_are_few(uint64_t mask, int few)
{
    for (int i = 0; i < few; ++i) {
        mask &= mask - 1;
    }
    return mask == 0;
}

static lmb_draw_slope rows_slope(const tile_slope *p)
{
    const lmb_draw_slope s = {p->at, p->x, p->y};
    return s;
}

static uint64_t rows_lanes_test(const tile_job *j, uint8_t *depth, int32_t step, uint64_t mask)
{
    lmb_draw_patch p;
    p.state = j->pass->state;
    p.d = rows_slope(&j->d);
    p.d_min = j->shape->d_min;
    p.d_max = j->shape->d_max;
    p.d_add = j->shape->d_add;
    p.depth = (float *)(void *)depth;
    p.depth_step = step / 4;
    return p.state->kernels->draw_test(&p, mask);
}

/* Sets value i of the kernel from value `from` of the corners. */
static void rows_lanes_value(lmb_draw_patch *p, const lmb_draw_shape *s, int i, int from)
{
    p->at[i] = s->corner[0]->v[from];
    p->more1[i] = s->corner[1]->v[from] - p->at[i];
    p->more2[i] = s->corner[2]->v[from] - p->at[i];
}

static uint8_t *rows_pixel(const lmb_draw_pass *pass, int32_t x, int32_t y)
{
    const lmb_surface *to = &pass->target->colour;
    return (uint8_t *)to->data + (ptrdiff_t)(y - pass->target->y0) * to->stride_bytes +
           (ptrdiff_t)(x - pass->target->x0) * 4;
}

/* All but the slopes. */
static void rows_lanes_set(lmb_draw_patch *p, const lmb_draw_pass *pass, const lmb_draw_shape *shape, int32_t x,
                           int32_t y)
{
    p->state = pass->state;
    p->varies = 0;
    for (int i = 0; i < 4; ++i) {
        rows_lanes_value(p, shape, i, CORNER_RED + i);
        p->varies |= p->more1[i] != 0.0f || p->more2[i] != 0.0f;
    }
    for (int i = 0; i < 2 * LMB_DRAW_STAGES; ++i) {
        if (p->state->stage[i >> 1].texture != NULL) {
            rows_lanes_value(p, shape, 4 + i, CORNER_UV + i);
        }
    }
    if (p->state->fog != LMB_DRAW_FOG_NONE) {
        rows_lanes_value(p, shape, LMB_DRAW_VALUES - 1, CORNER_FOG);
    }
    p->is_even = shape->is_even;
    p->swaps = pass->target->colour.format == LMB_BGRA8;
    p->colour = rows_pixel(pass, x, y);
    p->colour_stride = pass->target->colour.stride_bytes;
}

static void rows_lanes_paint(const tile_job *j, uint64_t mask)
{
    lmb_draw_patch p;
    rows_lanes_set(&p, j->pass, j->shape, j->x, j->y);
    p.n1 = rows_slope(&j->n1);
    p.n2 = rows_slope(&j->n2);
    if (!p.is_even) {
        p.q = rows_slope(&j->q);
    }
    p.state->kernels->draw_paint(&p, mask);
}

int lmb_draw_lanes_paint(const tile_job *j, uint64_t mask)
{
    if (!j->pass->paints_lanes || j->shape->is_cut || !rows_are_whole(j) ||
        (j->pass->paints_rows && rows_are_few(mask, ROWS_FEW_PAINTED))) {
        return 0;
    }
    rows_lanes_paint(j, mask);
    return 1;
}

int lmb_draw_lanes_put(const tile_job *j, const uint8_t (*codes)[4], uint64_t mask)
{
    const lmb_draw_state *s = j->pass->state;
    const lmb_surface *to = &j->pass->target->colour;
    if (s->kernels == NULL || s->kernels->draw_put == NULL || !rows_are_wide(j->pass->target) || !rows_are_little() ||
        rows_blend(s) == ROWS_NOT || !rows_are_whole(j)) {
        return 0;
    }
    const lmb_draw_put p = {s, rows_pixel(j->pass, j->x, j->y), to->stride_bytes, to->format == LMB_BGRA8};
    s->kernels->draw_put(&p, codes, mask);
    return 1;
}

/* Sets a patch for the shares of the primitive's vertices. Returns 0 if the kernels cannot. */
static int rows_set_shares(lmb_draw_patch *p, const tile_job *j)
{
    const lmb_draw_shape *s = j->shape;
    const lmb_kernels *kernels = j->pass->state->kernels;
    if (kernels == NULL || kernels->draw_shares == NULL || s->corners == 1 || s->is_cut) {
        return 0;
    }
    rows_lanes_value(p, s, 0, CORNER_SHARE);
    rows_lanes_value(p, s, 1, CORNER_SHARE + 1);
    p->is_even = s->is_even;
    p->n1 = rows_slope(&j->n1);
    p->n2 = rows_slope(&j->n2);
    if (!p->is_even) {
        p->q = rows_slope(&j->q);
    }
    return 1;
}

int lmb_draw_lanes_shares(float out[2][LMB_TILE_PIXELS], const tile_job *j, uint64_t mask)
{
    lmb_draw_patch p;
    const int good = rows_set_shares(&p, j);
    if (good) {
        j->pass->state->kernels->draw_shares(out, &p, mask);
    }
    return good;
}

int lmb_draw_lanes_steps(float by_x[2][LMB_TILE_PIXELS], float by_y[2][LMB_TILE_PIXELS], const tile_job *j,
                         uint64_t mask)
{
    lmb_draw_patch p;
    const int good = rows_set_shares(&p, j);
    if (good) {
        j->pass->state->kernels->draw_steps(by_x, by_y, &p, mask);
    }
    return good;
}

int lmb_draw_rows_area(const lmb_draw_pass *pass, lmb_draw_shape *shape, const draw_edge edge[3], const int32_t box[4])
{
    const lmb_draw_target *t = pass->target;
    const int32_t x = box[0] & ~7, y = box[1] & ~7;
    lmb_draw_area a;
    if (x < t->x0 || y < t->y0 || (box[2] | 7) - t->x0 >= t->colour.width || (box[3] | 7) - t->y0 >= t->colour.height) {
        return 0;
    }
    if (shape->late != NULL) {
        lmb_draw_finish(pass, shape);
    }
    rows_lanes_set(&a.pixels, pass, shape, x, y);
    a.plane[0] = &shape->d;
    a.plane[1] = &shape->n1;
    a.plane[2] = &shape->n2;
    a.plane[3] = &shape->q;
    draw_set_steps(&a.pixels.d, &shape->d);
    draw_set_steps(&a.pixels.n1, &shape->n1);
    draw_set_steps(&a.pixels.n2, &shape->n2);
    if (!shape->is_even) {
        draw_set_steps(&a.pixels.q, &shape->q);
    }
    a.pixels.d_min = shape->d_min;
    a.pixels.d_max = shape->d_max;
    a.pixels.d_add = shape->d_add;
    a.colour = a.pixels.colour;
    a.tests = pass->tests;
    if (pass->tests) {
        a.pixels.depth_step = t->depth.stride_bytes / 4;
        a.depth = (float *)t->depth.data + (ptrdiff_t)(y - t->y0) * a.pixels.depth_step + (x - t->x0);
    }
    a.x = (x * 256 + 128 - pass->middle_x) * (1.0 / 256.0);
    a.y = (y * 256 + 128 - pass->middle_y) * (1.0 / 256.0);
    for (int i = 0; i < 3; ++i) {
        a.edge[i] = edge[i].at;
        a.edge_x[i] = edge[i].x;
        a.edge_y[i] = edge[i].y;
    }
    a.x0 = box[0] - x;
    a.y0 = box[1] - y;
    a.x1 = box[2] - x;
    a.y1 = box[3] - y;
    pass->state->kernels->draw_area(&a);
    return 1;
}

void lmb_draw_rows_sheet(const lmb_draw_pass *pass, const lmb_draw_shape half[2], const draw_edge *edge,
                         const int32_t box[4])
{
    const int32_t x = box[0] & ~7, y = box[1] & ~7;
    lmb_draw_sheet s;
    for (int i = 0; i < 2; ++i) {
        rows_lanes_set(&s.half[i], pass, &half[i], x, y);
        s.plane[i][0] = &half[i].n1;
        s.plane[i][1] = &half[i].n2;
        s.plane[i][2] = &half[i].q;
        draw_set_steps(&s.half[i].n1, &half[i].n1);
        draw_set_steps(&s.half[i].n2, &half[i].n2);
        if (!half[i].is_even) {
            draw_set_steps(&s.half[i].q, &half[i].q);
        }
    }
    s.x = (x * 256 + 128 - pass->middle_x) * (1.0 / 256.0);
    s.y = (y * 256 + 128 - pass->middle_y) * (1.0 / 256.0);
    s.edge = edge->at + (int64_t)edge->x * x + (int64_t)edge->y * y;
    s.edge_x = edge->x;
    s.edge_y = edge->y;
    s.colour = s.half[0].colour;
    s.x0 = box[0] - x;
    s.y0 = box[1] - y;
    s.x1 = box[2] - x;
    s.y1 = box[3] - y;
    pass->state->kernels->draw_sheet(&s);
}
#endif

/* --- depth -------------------------------------------------------------------------------------------------------- */

uint64_t lmb_draw_rows_test(const tile_job *j, uint64_t mask)
{
    const lmb_draw_state *s = j->pass->state;
    const lmb_draw_target *t = j->pass->target;
    const lmb_draw_shape *shape = j->shape;
    const int32_t x = j->x - t->x0, y = j->y - t->y0;
    const int tiled = t->depth.layout == LMB_TILED;
    const int32_t step = tiled ? LMB_TILE * 4 : t->depth.stride_bytes;
    uint8_t *row =
        (uint8_t *)t->depth.data + (tiled ? (ptrdiff_t)(y >> 3) * t->depth.stride_bytes + (ptrdiff_t)x * LMB_TILE * 4
                                          : (ptrdiff_t)y * t->depth.stride_bytes + (ptrdiff_t)x * 4);
#if LMB_DRAW_LANES
    if (s->kernels != NULL && !rows_are_few(mask, ROWS_FEW_TESTED) && rows_are_whole(j)) {
        return rows_lanes_test(j, row, step, mask);
    }
#endif
    const uint32_t writes = (s->flags & LMB_DRAW_DEPTH_WRITE) != 0;
    const int less = s->depth_func & 1, equal = s->depth_func >> 1 & 1, greater = s->depth_func >> 2;
    const float per_x = j->d.x;
    const float low = shape->d_min, high = shape->d_max, add = shape->d_add;
    uint64_t out = 0;
    while (mask != 0) {
        const int i = lowest_bit_64(mask) >> 3;
        float *depth = (float *)(void *)(row + (ptrdiff_t)i * step);
        const float at = j->d.at + j->d.y * (float)i;
        uint32_t passing = 0;
        uint32_t bits = (uint32_t)(mask >> (LMB_TILE * i)) & 0xffu;
        mask ^= (uint64_t)bits << (LMB_TILE * i);
        for (; bits != 0; bits &= bits - 1) {
            const int k = lowest_bit(bits);
            float d = minf(maxf(at + per_x * (float)k, low), high);
            const float was = depth[k];
            if (add != 0.0f) {
                d = minf(maxf(d + add, 0.0f), 1.0f);
            }
            const uint32_t passes = (uint32_t)(d < was ? less : d == was ? equal : greater);
            passing |= passes << k;
            if ((passes & writes) != 0) {
                depth[k] = d;
            }
        }
        out |= (uint64_t)passing << (LMB_TILE * i);
    }
    return out;
}

/* --- colours ------------------------------------------------------------------------------------------------------ */

enum { ROWS_VALUES = 6 /* R G B A u v */ };

/* Values of corner 0, and the differences of the other corners. */
typedef struct rows_values {
    float at[ROWS_VALUES], more1[ROWS_VALUES], more2[ROWS_VALUES];
    uint32_t same;            /* the packed colour, if all corners have the same one */
    uint32_t alpha;           /* of corner 0 */
    int varies, alpha_varies; /* 1: corners differ */
} rows_values;

static inline uint32_t rows_code(float v) { return (uint32_t)(int32_t)(minf(maxf(v, 0.0f), 255.0f) + 0.5f); }

static inline uint32_t rows_pack(uint32_t r, uint32_t g, uint32_t b, uint32_t a)
{
    return r | g << 8 | b << 16 | a << 24;
}

static void rows_set_values(rows_values *out, const lmb_draw_shape *s, int textured)
{
    const float *a = s->corner[0]->v, *b = s->corner[1]->v, *c = s->corner[2]->v;
    for (int i = 0; i < 4; ++i) {
        out->at[i] = a[CORNER_RED + i];
        out->more1[i] = b[CORNER_RED + i] - out->at[i];
        out->more2[i] = c[CORNER_RED + i] - out->at[i];
    }
    for (int i = 4; i < ROWS_VALUES && textured; ++i) {
        out->at[i] = a[CORNER_UV + i - 4];
        out->more1[i] = b[CORNER_UV + i - 4] - out->at[i];
        out->more2[i] = c[CORNER_UV + i - 4] - out->at[i];
    }
    const float *m1 = out->more1, *m2 = out->more2;
    out->alpha_varies = m1[3] != 0.0f || m2[3] != 0.0f;
    out->alpha = rows_code(a[CORNER_ALPHA]);
    out->varies = out->alpha_varies || m1[0] != 0.0f || m2[0] != 0.0f || m1[1] != 0.0f || m2[1] != 0.0f ||
                  m1[2] != 0.0f || m2[2] != 0.0f;
    out->same =
        out->varies ? 0 : rows_pack(rows_code(out->at[0]), rows_code(out->at[1]), rows_code(out->at[2]), out->alpha);
}

static inline float rows_value(const rows_values *v, int i, float b1, float b2)
{
    return v->at[i] + (b1 * v->more1[i] + b2 * v->more2[i]);
}

/* Address of a texture's nearest texel. */
static const uint8_t *rows_texel(const lmb_texture *t, float u, float v)
{
    const int32_t x = texel_wrap((int32_t)(texel_reduce(u, t->wrap_s) * (float)t->width), t->width, t->wrap_s);
    const int32_t y = texel_wrap((int32_t)(texel_reduce(v, t->wrap_t) * (float)t->height), t->height, t->wrap_t);
    return t->texels + 4 * ((size_t)y * t->width + (size_t)x);
}

/* Two codes at once, in the low and the high half: (a b + 127) / 255 of each, exact. */
static uint32_t rows_between(uint32_t a, uint32_t b, uint32_t share)
{
    const uint32_t v = a * share + b * (255u - share) + 0x00800080u;
    return ((v + (v >> 8 & 0x00ff00ffu)) >> 8) & 0x00ff00ffu;
}

static uint32_t rows_add(uint32_t a, uint32_t b, uint32_t share)
{
    const uint32_t v = a * share + 0x00800080u;
    const uint32_t sum = (((v + (v >> 8 & 0x00ff00ffu)) >> 8) & 0x00ff00ffu) + b;
    const uint32_t over = sum & 0x01000100u;
    return (sum | (over - (over >> 8))) & 0x00ff00ffu;
}

static uint32_t rows_load(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

static void rows_store(uint8_t *p, uint32_t v)
{
    p[0] = (uint8_t)v;
    p[1] = (uint8_t)(v >> 8);
    p[2] = (uint8_t)(v >> 16);
    p[3] = (uint8_t)(v >> 24);
}

/* Swaps R and B. */
static uint32_t rows_swapped(uint32_t v) { return (v & 0xff00ff00u) | (v >> 16 & 0xffu) | (v & 0xffu) << 16; }

static uint32_t rows_blended(uint32_t v, uint32_t was, int blend)
{
    const uint32_t share = v >> 24;
    if (blend == ROWS_ALPHA) {
        return rows_between(v & 0x00ff00ffu, was & 0x00ff00ffu, share) |
               rows_between(v >> 8 & 0x00ff00ffu, was >> 8 & 0x00ff00ffu, share) << 8;
    }
    return rows_add(v & 0x00ff00ffu, was & 0x00ff00ffu, share) |
           rows_add(v >> 8 & 0x00ff00ffu, was >> 8 & 0x00ff00ffu, share) << 8;
}

/* Constant along the pixels of one row. */
typedef struct rows_line {
    float at1, at2, at_q, x1, x2, x_q;
    int is_even;
} rows_line;

static inline rows_line rows_line_of(const tile_job *j, int i)
{
    rows_line l;
    l.at1 = j->n1.at + j->n1.y * (float)i;
    l.at2 = j->n2.at + j->n2.y * (float)i;
    l.x1 = j->n1.x;
    l.x2 = j->n2.x;
    l.is_even = j->shape->is_even;
    l.at_q = l.is_even ? 1.0f : j->q.at + j->q.y * (float)i;
    l.x_q = l.is_even ? 0.0f : j->q.x;
    return l;
}

/* The shares of pixel k. */
static inline void rows_share(float share[2], const rows_line *l, int k)
{
    const float x = (float)k;
    float b1 = l->at1 + l->x1 * x, b2 = l->at2 + l->x2 * x;
    if (!l->is_even) {
        const float q = l->at_q + l->x_q * x, inverse = q > 1e-30f ? 1.0f / q : 0.0f;
        b1 *= inverse;
        b2 *= inverse;
    }
    share[0] = minf(maxf(b1, 0.0f), 1.0f);
    share[1] = minf(maxf(b2, 0.0f), 1.0f);
}

/* Four codes of values 0 .. 255, which may be slightly out of range. */
static inline uint32_t rows_smooth(const rows_values *v, const float share[2])
{
    const float b1 = share[0], b2 = share[1];
    return rows_pack(rows_code(rows_value(v, 0, b1, b2)), rows_code(rows_value(v, 1, b1, b2)),
                     rows_code(rows_value(v, 2, b1, b2)),
                     v->alpha_varies ? rows_code(rows_value(v, 3, b1, b2)) : v->alpha);
}

/* The colour of pixel k. */
static uint32_t rows_colour(const rows_values *v, const lmb_draw_stage *stage, const rows_line *l, int k)
{
    float share[2];
    rows_share(share, l, k);
    const uint32_t code = v->varies ? rows_smooth(v, share) : v->same;
    if (stage == NULL) {
        return code;
    }
    const uint8_t *t =
        rows_texel(stage->texture, rows_value(v, 4, share[0], share[1]), rows_value(v, 5, share[0], share[1]));
    if (stage->mode == LMB_DRAW_REPLACE || code == 0xffffffffu) {
        return rows_load(t);
    }
    return rows_pack(draw_times(code & 0xffu, t[0]), draw_times(code >> 8 & 0xffu, t[1]),
                     draw_times(code >> 16 & 0xffu, t[2]), draw_times(code >> 24, t[3]));
}

/* A row of smooth, opaque colours. */
static void rows_paint_smooth(uint8_t *pixel, const rows_values *v, const rows_line *l, uint32_t bits, int swaps)
{
    for (; bits != 0; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        float share[2];
        rows_share(share, l, k);
        const uint32_t code = rows_smooth(v, share);
        rows_store(pixel + 4 * k, swaps ? rows_swapped(code) : code);
    }
}

void lmb_draw_rows_paint(const tile_job *j, uint64_t mask)
{
    const lmb_draw_stage *stage = j->pass->state->stage[0].texture != NULL ? &j->pass->state->stage[0] : NULL;
    const lmb_surface *to = &j->pass->target->colour;
    const int blend = j->pass->paints_rows, swaps = to->format == LMB_BGRA8;
    const int shares = j->shape->corners > 1;
    rows_values v;
    uint8_t *row = (uint8_t *)to->data + (ptrdiff_t)(j->y - j->pass->target->y0) * to->stride_bytes +
                   (ptrdiff_t)(j->x - j->pass->target->x0) * 4;
    rows_set_values(&v, j->shape, stage != NULL);
    const int flat = !v.varies && (stage == NULL || !shares),
              is_smooth = v.varies && stage == NULL && blend == ROWS_OPAQUE;
    rows_line l = rows_line_of(j, 0);
    uint32_t code = flat ? rows_colour(&v, stage, &l, 0) : 0;
    code = swaps ? rows_swapped(code) : code;
    while (mask != 0) {
        const int i = lowest_bit_64(mask) >> 3;
        uint8_t *pixel = row + (ptrdiff_t)i * to->stride_bytes;
        uint32_t bits = (uint32_t)(mask >> (LMB_TILE * i)) & 0xffu;
        mask ^= (uint64_t)bits << (LMB_TILE * i);
        l = rows_line_of(j, i);
        if (is_smooth) {
            rows_paint_smooth(pixel, &v, &l, bits, swaps);
            continue;
        }
        for (; bits != 0; bits &= bits - 1) {
            const int k = lowest_bit(bits);
            if (!flat) {
                code = rows_colour(&v, stage, &l, k);
                code = swaps ? rows_swapped(code) : code;
            }
            rows_store(pixel + 4 * k,
                       blend == ROWS_OPAQUE ? code : rows_blended(code, rows_load(pixel + 4 * k), blend));
        }
    }
}

/* --- rectangles --------------------------------------------------------------------------------------------------- */

enum { ROWS_LONG = 256 };
enum { ROWS_CHUNK = 32 << 10 }; /* bytes; copies of 20 to 40 KiB are the fastest, as they stay in the first cache */

/* Copies a pixel to `count` pixels. */
static void rows_repeat(uint8_t *row, uint32_t code, size_t count)
{
    const size_t bytes = 4 * count;
    size_t chunk = 4;
    rows_store(row, code);
    for (size_t done = 4; done < bytes; done += chunk) {
        chunk = done < ROWS_CHUNK ? done : ROWS_CHUNK;
        chunk = chunk < bytes - done ? chunk : bytes - done;
        memcpy(row + done, row, chunk);
    }
}

/* Blends a colour onto rows of pixels. */
static void rows_mix(const lmb_draw_pass *pass, uint8_t *row, int32_t stride, int32_t width, int32_t height,
                     uint32_t code)
{
    const int blend = pass->paints_rows;
#if LMB_DRAW_LANES
    if (pass->paints_lanes) {
        const int adds = blend == ROWS_ADD;
        const int32_t before = height == 1 && width >= ROWS_LONG ? (int32_t)((0u - (uintptr_t)row) & 63u) / 4 : 0;
        if (before > 0) { /* vectors within lines of the cache are faster */
            pass->state->kernels->draw_fill(row, stride, before, 1, code, adds);
        }
        pass->state->kernels->draw_fill(row + 4 * before, stride, width - before, height, code, adds);
        return;
    }
#endif
    for (; height > 0; --height, row += stride) {
        for (int32_t k = 0; k < width; ++k) {
            rows_store(row + 4 * k, rows_blended(code, rows_load(row + 4 * k), blend));
        }
    }
}

void lmb_draw_rows_fill(const lmb_draw_pass *pass, const uint8_t codes[4], int32_t x0, int32_t x1, int32_t y0,
                        int32_t y1)
{
    const lmb_surface *to = &pass->target->colour;
    const int blend = pass->paints_rows, width = x1 - x0 + 1;
    const uint32_t plain = rows_load(codes),
                   code = to->format == LMB_BGRA8 ? rows_swapped(plain) : plain;
    uint8_t *row = (uint8_t *)to->data + (ptrdiff_t)(y0 - pass->target->y0) * to->stride_bytes +
                   (ptrdiff_t)(x0 - pass->target->x0) * 4;
    if (blend == ROWS_OPAQUE) {
        const int is_one = to->stride_bytes == 4 * width; /* the rows have no gaps */
        const uint8_t *first = row;
        rows_repeat(row, code, (size_t)width * (size_t)(is_one ? y1 - y0 + 1 : 1));
        for (int32_t y = y0; y < y1 && !is_one; ++y) {
            row += to->stride_bytes;
            memcpy(row, first, 4 * (size_t)width);
        }
        return;
    }
    if (to->stride_bytes == 4 * width) { /* the rows have no gaps */
        rows_mix(pass, row, 0, width * (y1 - y0 + 1), 1, code);
    } else {
        rows_mix(pass, row, to->stride_bytes, width, y1 - y0 + 1, code);
    }
}
#endif
