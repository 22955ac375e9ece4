/* draw_part.h: shared by the parts of a draw: corners, shapes, and the pixels of a shape in a tile. Layer 4.
 *
 * A primitive becomes corners, which are clipped, and then shapes: triangles, lines, points. A shape visits the frame's
 * tiles of 8x8 pixels and finds the pixels that it covers in each. lmb_draw_tile does the rest for these pixels: tests,
 * colours, the target. A specialised kernel would replace lmb_draw_tile for the states that it supports. */
#ifndef LMB_DRAW_PART_H
#define LMB_DRAW_PART_H

#include <lambent/draw.h>

#include "../lane/kernels.h"
#include "../raster/setup.h"
#include "../base/vec.h"

#if LMB_DRAW
enum { DRAW_FULL = !LMB_DRAW_SMALL };

/* Values of a corner; all are linear in clip space. */
enum {
    CORNER_X = 0,
    CORNER_Y = 1,
    CORNER_Z = 2,
    CORNER_W = 3,
    CORNER_RED = 4,
    CORNER_ALPHA = 7,
    CORNER_SHARE = CORNER_RED, /* with a shader: shares of the primitive's vertices 1 and 2 */
    CORNER_UV = 8, /* u, v of each stage */
    CORNER_FOG = CORNER_UV + 2 * LMB_DRAW_STAGES,
    CORNER_SECOND, /* R, G, B */
    CORNER_PLANES = CORNER_SECOND + 3,
    CORNER_VALUES = CORNER_PLANES + LMB_DRAW_PLANES
};
typedef struct lmb_draw_corner {
    float v[CORNER_VALUES];
} lmb_draw_corner;

/* Planes of clip space, in cutting order: w > 0, near, far, the guard band, and the state's own ones. */
enum {
    DRAW_CUT_W = 0,
    DRAW_CUT_NEAR = 1,
    DRAW_CUT_FAR = 2,
    DRAW_CUT_LEFT = 3,
    DRAW_CUT_RIGHT = 4,
    DRAW_CUT_TOP = 5,
    DRAW_CUT_BOTTOM = 6,
    DRAW_CUT_OWN = 7,
    DRAW_CUTS = DRAW_CUT_OWN + LMB_DRAW_PLANES
};
enum { DRAW_CORNERS = 3 + DRAW_CUTS }; /* of a triangle cut by all planes */

/* For a shader: the current primitive. small_from: the triangle from which a batch is tried; rest: triangles that the
 * last batch was put off for. */
typedef struct draw_primitive {
    uint32_t vertex[3];
    int32_t is_back;
    uint32_t small_from, rest;
} draw_primitive;

/* Constant over a call. */
typedef struct lmb_draw_pass {
    const lmb_draw_target *target;
    const lmb_draw_state *state;
    const lmb_draw_vertices *vertices;
    const lmb_draw_indices *indices;
    int32_t x0, y0, x1, y1;     /* pixels of the frame that may be drawn */
    int32_t middle_x, middle_y; /* viewport's centre, 24.8 in the frame */
    float snap_x, snap_y, guard_x, guard_y;
    float depth_scale, depth_bias; /* LMB_DEPTH16: code = d scale + bias */
    int32_t tests;                 /* 1: depth or stencil test */
    int32_t shows;                 /* 1: colours may be written */
    int32_t paints_first;          /* 1: tests need colours */
    uint32_t *dashed;              /* pixels of earlier lines: line_pattern continues from this count */
    int32_t tests_rows, paints_rows, paints_lanes; /* 1: draw_rows.c, or a kernel, supports this state */
    int32_t fills;                   /* upright rectangles that need no triangles: DRAW_FILLS_COLOUR, ... */
    struct draw_vertex *few;         /* DRAW_FEW corners of triangles; NULL: all take the general path */
    int32_t fog_is_w;              /* 1: the fog distance is the w of clip space */
    int32_t draws;                 /* kernels draw whole triangles: DRAW_AREAS; small ones in batches: DRAW_SMALLS;
                                      lines: DRAW_LINES */
    draw_primitive *now;
    lmb_stats *stats;
} lmb_draw_pass;

/* A primitive after setup. A value at a pixel is that of corner 0, plus n1 / q and n2 / q times the differences of
 * corners 1 and 2 from it. */
typedef struct lmb_draw_shape {
    const lmb_draw_corner *corner[3];
    lmb_draw_plane d, n1, n2, q;
    float d_min, d_max; /* range of the corners */
    float d_add;        /* depth offset */
    int32_t corners;    /* 1: all values are corner 0's; 2: n2 is 0 */
    int32_t is_even;    /* 1: q is 1 */
    int32_t is_cut;     /* 1: from a cut triangle; coloured in plain C */
    struct lmb_draw_late *late; /* inputs from which corner, n1, n2 and q are computed once a pixel passes; or NULL */
} lmb_draw_shape;

/* A linear value over a tile: at the first pixel, and per px. */
typedef struct tile_slope {
    float at, x, y;
} tile_slope;

/* A shape in a tile. */
typedef struct tile_job {
    const lmb_draw_pass *pass;
    const lmb_draw_shape *shape;
    int32_t x, y; /* pixel 0, px of the frame */
    tile_slope d, n1, n2, q;
} tile_job;

/* As in src/raster. */
static inline float tile_at(const tile_slope *p, int k)
{
    return (p->at + p->y * (float)(k >> 3)) + p->x * (float)(k & 7);
}

/* lmb_draw_cut_polygon: cuts a triangle. Returns the number of corners, 0 or 3 .. DRAW_CORNERS. lmb_draw_cut_line: cuts
 * a line. Returns 0 if nothing is left. lmb_draw_is_out: 1 if a point is outside. */
int lmb_draw_cut_polygon(lmb_draw_corner corner[DRAW_CORNERS], const lmb_draw_pass *pass);
int lmb_draw_cut_line(lmb_draw_corner corner[2], const lmb_draw_pass *pass);
int lmb_draw_is_out(const lmb_draw_corner *corner, const lmb_draw_pass *pass);

/* Draw a primitive with finite corners. Return 1 if part of it may show. The corners are changed. */
int lmb_draw_triangle(const lmb_draw_pass *pass, const lmb_draw_corner corner[3]);
int lmb_draw_line(const lmb_draw_pass *pass, lmb_draw_corner corner[2]);
int lmb_draw_point(const lmb_draw_pass *pass, const lmb_draw_corner *corner);

/* A transformed corner. */
typedef struct draw_vertex {
    uint32_t name, out; /* vertex + 1, or 0: none; bits of the planes it is outside of, or DRAW_DROPPED */
    int32_t x, y;       /* 24.8 from the viewport's centre */
    float d, inverse;   /* 1 / w */
} draw_vertex;
enum { DRAW_AREAS = 1, DRAW_SMALLS = 2, DRAW_LINES = 4 };
enum { DRAW_FILLS_COLOUR = 1 /* of one colour */, DRAW_FILLS_SHEET = 2 /* any, with the state's kernels */ };
enum { DRAW_FEW = 4 /* for quads and strips */, DRAW_DROPPED = 256 };

/* Inputs for the rest of a shape. */
typedef struct lmb_draw_late {
    lmb_screen_vertex at[3]; /* the winding is always the same */
    float inverse[3];
    uint32_t vertex[3], flat;
    double by_area;
    lmb_draw_corner corner[3];
} lmb_draw_late;

static inline float quick_row(const float *m, const float p[4])
{
    return m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12] * p[3];
}

static inline float quick_fog(const lmb_draw_pass *pass, const float p[4], float w)
{
    const float *axis = pass->state->fog_axis;
    return pass->fog_is_w ? w : axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2] + axis[3] * p[3];
}

/* Position i: x, y, z, and w, which is 1 with LMB_DRAW_F32. */
static inline void quick_fetch(float out[4], const lmb_draw_vertices *v, uint32_t i)
{
    const int has_w = v->position_format == LMB_DRAW_F32X4;
    const float *from = (const float *)v->positions + (has_w ? (size_t)4 : (size_t)3) * i;
    out[0] = from[0];
    out[1] = from[1];
    out[2] = from[2];
    out[3] = has_w ? from[3] : 1.0f;
}

/* draw_quick.c. begin: sets pass->few if the fast path supports the state's triangles. quick: draws a triangle from
 * places in the list; returns 0 if it needs the general path. run: draws triangles of vertices (i - 2, i - 1, i), three
 * further on each, until one needs the general path; returns its i. draw_late.c: finish: computes the rest of a late
 * shape. */
void lmb_draw_quick_begin(lmb_draw_pass *pass, draw_vertex few[DRAW_FEW]);
int lmb_draw_quick(const lmb_draw_pass *pass, uint32_t a, uint32_t b, uint32_t c, uint32_t flat);
uint32_t lmb_draw_quick_run(const lmb_draw_pass *pass, uint32_t i, uint32_t count);
/* Draws triangles `n` .. `count` - 1 of strips, fans, polygons and quads in batches, until one needs another path (a
 * whole quad if the triangle is the first of two); returns the number of that one. Use it if DRAW_SMALLS is set. */
uint32_t lmb_draw_quick_others(const lmb_draw_pass *pass, int32_t primitive, uint32_t n, uint32_t count);
/* If pass->fills: fills a quad from places in the list. Returns 0, and draws nothing, if the quad is no upright
 * rectangle that pass->fills names, is clipped, or covers no pixel. */
int lmb_draw_quick_rectangle(const lmb_draw_pass *pass, const uint32_t at[4], uint32_t flat);
void lmb_draw_finish(const lmb_draw_pass *pass, lmb_draw_shape *shape);

/* place: sets a corner; `out` is 0 if it needs no cutting. find_fog: sets pass->fog_is_w. */
void lmb_draw_place(draw_vertex *out, const lmb_draw_pass *pass, uint32_t i);
void lmb_draw_find_fog(lmb_draw_pass *pass);

/* draw_line.c, after lmb_draw_rows_begin. begin: sets DRAW_LINES. quick_line: draws a line between places in the list;
 * returns 0 if it needs the general path. */
void lmb_draw_lines_begin(lmb_draw_pass *pass);
int lmb_draw_quick_line(const lmb_draw_pass *pass, uint32_t a, uint32_t b);

/* draw_stencil.c, if lmb_draw_rows_stencils: the pixels of the mask that pass stencil and depth test, both updated. */
uint64_t lmb_draw_stencil(const tile_job *job, uint64_t mask);
int lmb_draw_rows_stencils(const tile_job *job);

/* draw_rows.c: common states, row by row. begin: selects them. tests: returns the pixels of the mask that pass, and
 * stores their depths. paints: colours pixels. */
void lmb_draw_rows_begin(lmb_draw_pass *pass);
uint64_t lmb_draw_rows_test(const tile_job *job, uint64_t mask);
void lmb_draw_rows_paint(const tile_job *job, uint64_t mask);
int lmb_draw_lanes_paint(const tile_job *job, uint64_t mask); /* with the state's kernels; 0: they cannot */
int lmb_draw_lanes_put(const tile_job *job, const uint8_t (*codes)[4], uint64_t mask); /* colours of pixels; the same */
int lmb_draw_lanes_shares(float out[2][LMB_TILE_PIXELS], const tile_job *job, uint64_t mask); /* the same */
int lmb_draw_lanes_steps(float by_x[2][LMB_TILE_PIXELS], float by_y[2][LMB_TILE_PIXELS], const tile_job *job,
                         uint64_t mask); /* the same */

/* An edge's value at pixel (0, 0) of the frame, and per px. Pixels are inside where it is not negative. */
typedef struct draw_edge {
    int64_t at;
    int32_t x, y;
} draw_edge;

/* If pass->fills & DRAW_FILLS_SHEET: colours the pixels box[0] .. box[2], box[1] .. box[3] of the frame, inside the
 * pass, with the two triangles of an upright rectangle: the first inside their shared edge, the second outside. The box
 * lies in tiles that the target has whole. */
void lmb_draw_rows_sheet(const lmb_draw_pass *pass, const lmb_draw_shape half[2], const draw_edge *edge,
                         const int32_t box[4]);

/* If pass->draws & DRAW_AREAS: draws pixels box[0] .. box[2], box[1] .. box[3] of the frame, inside the pass, that are
 * inside the edges. Returns 0, and draws nothing, if the target cuts tiles of the box off. */
int lmb_draw_rows_area(const lmb_draw_pass *pass, lmb_draw_shape *shape, const draw_edge edge[3], const int32_t box[4]);

static inline void draw_scale_plane(lmb_draw_plane *p, double by)
{
    p->origin *= by;
    p->x *= by;
    p->y *= by;
}

#if LMB_DRAW_LANES
/* The changes of a plane per px, for a kernel. */
static inline void draw_set_steps(lmb_draw_slope *out, const lmb_draw_plane *p)
{
    out->x = (float)p->x;
    out->y = (float)p->y;
}
#endif

/* If pass->fills: fills columns x0 .. x1 and rows y0 .. y1 of the frame, inside the pass, with R G B A. */
void lmb_draw_rows_fill(const lmb_draw_pass *pass, const uint8_t codes[4], int32_t x0, int32_t x1, int32_t y0,
                        int32_t y1);

/* The n-th vertex index; the vertex count if it is out of range. */
static inline uint32_t draw_index(const lmb_draw_pass *pass, uint32_t n)
{
    const lmb_draw_indices *x = pass->indices;
    uint32_t i = n;
    if (x != NULL && x->format == LMB_DRAW_INDEX_U8) {
        i = ((const uint8_t *)x->data)[n];
    } else if (x != NULL && x->format == LMB_INDEX_U16) {
        i = ((const uint16_t *)x->data)[n];
    } else if (x != NULL && x->format == LMB_INDEX_U32) {
        i = ((const uint32_t *)x->data)[n];
    }
    return i < pass->vertices->count ? i : pass->vertices->count;
}

/* 24.8 within the range of setup.c. floorf is a call if the processor lacks the instruction. */
#define DRAW_SNAP_MAX 4194304.0f
static inline int32_t draw_to_24_8(float v)
{
    const float held = minf(maxf(v, -DRAW_SNAP_MAX), DRAW_SNAP_MAX);
    const int32_t whole = (int32_t)held;
    return whole - ((float)whole > held);
}

/* Draws the pixels `mask` of the shape in the tile with pixel 0 at (x, y) of the frame. Skips pixels outside the
 * pass. */
void lmb_draw_tile(const lmb_draw_pass *pass, lmb_draw_shape *shape, int32_t x, int32_t y, uint64_t mask);

/* Check the values of targets and states. */
lmb_status lmb_draw_check_target(const lmb_draw_target *target);
lmb_status lmb_draw_check_state(const lmb_draw_state *state, const lmb_draw_target *target);

/* a b / 255 of two codes, to nearest; ties cannot occur. */
static inline uint32_t draw_times(uint32_t a, uint32_t b) { return (a * b + 127u) / 255u; }

/* a if share is 255, b if it is 0. */
static inline uint32_t draw_between(uint32_t a, uint32_t b, uint32_t share)
{
    return (a * share + b * (255u - share) + 127u) / 255u;
}

/* Applies a stage's LMB_DRAW_COMBINE. first: the colour before all stages. */
void lmb_draw_combine_codes(uint8_t inout[4], const lmb_draw_state *state, int stage, const uint8_t first[4],
                            const uint8_t texel[LMB_DRAW_STAGES][4]);

static inline float draw_value(const lmb_draw_shape *s, int i, float b1, float b2)
{
    const float at = s->corner[0]->v[i];
    return at + (b1 * (s->corner[1]->v[i] - at) + b2 * (s->corner[2]->v[i] - at));
}

/* One texel's bytes R G B A. level: in 1/256 levels. */
void lmb_draw_texel(uint8_t out[4], const lmb_texture *texture, float u, float v, int32_t level);

/* Vertices: check: are the values valid; fetch: `n` values of vertex i; position_w: x, y, z and w; position: (x, y, z)
 * / w, or (x, y, z) if w is 0. */
lmb_status lmb_draw_check_vertices(const lmb_draw_vertices *vertices);
void lmb_draw_fetch(float *out, const void *data, uint32_t i, int n, int format);
lmb_vec3 lmb_draw_position_w(float *w, const lmb_draw_vertices *vertices, uint32_t i);
lmb_vec3 lmb_draw_position(const lmb_draw_vertices *vertices, uint32_t i);

static inline int draw_passes(int func, int32_t value, int32_t other)
{
    return (func & (value < other ? LMB_DRAW_LESS : value == other ? LMB_DRAW_EQUAL : LMB_DRAW_GREATER)) != 0;
}

/* Reads the codes R G B A of a pixel in memory, and writes them. Dithered at (x, y) of the frame. */
void lmb_draw_read_pixel(uint8_t out[4], int32_t format, const uint8_t *at);
uint32_t lmb_draw_pixel_bits(int32_t format, const uint8_t *at);
uint32_t lmb_draw_pixel_of(int32_t format, const uint8_t codes[4], int dithers, int32_t x, int32_t y);
uint32_t lmb_draw_pixel_mask(int32_t format, uint32_t channels); /* bits of channels 0 .. 3 */
void lmb_draw_put_bits(int32_t format, uint8_t *at, uint32_t bits);
#endif

#endif
