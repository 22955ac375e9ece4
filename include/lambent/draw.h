/* draw.h: fixed-function drawing: triangles, lines, points, pictures and text on a colour, depth and stencil target.
 *
 * There is no current state: you pass each call everything that it depends on. A pixel depends on the target's old
 * value there, and on nothing else of other draws. It does not depend on the scissor, or on the window of the frame
 * that the target holds. Colours are the codes 0 .. 255 in memory, without conversion between sRGB and linear light.
 *
 * Clip space: x and y from -w to w, z from 0 to w; d = z / w. lmb_draw_view sets a matrix that gives d as a frame's
 * depth: larger is nearer, and 0 is infinitely far. To draw into a frame's own depth with lmb_draw_list, use
 * LMB_DRAW_GREATER.
 *
 * Stability: experimental. */
#ifndef LMB_DRAW_H
#define LMB_DRAW_H

#include "scene.h"
#include "surface.h"

#if LMB_DRAW
enum { LMB_DRAW_STAGES = 2, LMB_DRAW_PLANES = 6 };

/* The target of draws. All surfaces in it have the same size; set at least one. */
typedef struct lmb_draw_target {
    lmb_surface colour; /* LMB_RGB565 .. LMB_BGRA8; data NULL: none. Alpha of 16-bit formats reads as 255 */
    lmb_surface depth;  /* LMB_DEPTH32F or LMB_DEPTH16, tiled or linear; data NULL: none */
    uint8_t *stencil;   /* rows of `stencil_stride` bytes, >= the width; NULL: none */
    int32_t stencil_stride;
    float depth_far;    /* LMB_DEPTH16: the d of code 1, 0 .. 0.999 (of a view, near_m / far_m) */
    int32_t x0, y0;     /* position of pixel (0, 0) in the frame, px: multiples of LMB_TILE, 0 .. LMB_MAX_FRAME */
} lmb_draw_target;

/* Primitives. Quads are split (0, 1, 2) (0, 2, 3), also if folded. With LMB_DRAW_FLAT, a primitive has the colour of
 * its last vertex. */
enum { LMB_DRAW_TRIANGLES = 0, LMB_DRAW_TRIANGLE_STRIP = 1, LMB_DRAW_TRIANGLE_FAN = 2, LMB_DRAW_QUADS = 3,
       LMB_DRAW_QUAD_STRIP = 4, LMB_DRAW_LINES = 5, LMB_DRAW_LINE_STRIP = 6, LMB_DRAW_LINE_LOOP = 7,
       LMB_DRAW_POINTS = 8,
       LMB_DRAW_POLYGON = 9 /* convex; drawn as a fan. Flat colour: of the first vertex */ };

enum { LMB_DRAW_F32 = 0,  /* float */
       LMB_DRAW_I16 = 1,  /* int16; positions are x, y, z, 0 */
       LMB_DRAW_FIXED = 2, /* int32, 16.16 fixed point */
       LMB_DRAW_F32X4 = 3 /* float x, y, z, w of positions; each of any size that clip space holds */ };

/* Vertex streams, each tightly packed and aligned to the values. */
typedef struct lmb_draw_vertices {
    const void *positions;            /* x, y, z; w is 1 */
    const void *uvs[LMB_DRAW_STAGES]; /* u, v of each stage; NULL: (0, 0) */
    const uint8_t *colours;           /* R G B A; NULL: the state's colour */
    const uint8_t *seconds;           /* R G B and an unused byte, added after the stages; NULL: 0 */
    const uint8_t *back_colours, *back_seconds; /* for triangles that face away; NULL: as in front */
    const float *fogs;                /* fog distances; NULL: computed from fog_axis */
    const uint8_t *edges;             /* 0: the side that begins here is not an edge of the polygon; NULL: all are */
    uint32_t count;
    lmb_vec3 position_scale, position_offset; /* LMB_DRAW_I16: scale * v + offset */
    float uv_scale;                           /* LMB_DRAW_I16: scale * v */
    uint8_t position_format, uv_format;       /* LMB_DRAW_F32, ... */
} lmb_draw_vertices;

enum { LMB_DRAW_INDEX_U8 = 3 /* in addition to LMB_INDEX_NONE, LMB_INDEX_U16, LMB_INDEX_U32 */ };

typedef struct lmb_draw_indices {
    const void *data; /* NULL with LMB_INDEX_NONE: vertices in order */
    uint32_t count;   /* of indices, or of vertices */
    uint8_t format;
} lmb_draw_indices;

enum { LMB_DRAW_DEPTH_TEST = 1, LMB_DRAW_DEPTH_WRITE = 2 /* only with the test */, LMB_DRAW_SCISSOR = 4,
       LMB_DRAW_STENCIL = 8, LMB_DRAW_ALPHA_TEST = 16, LMB_DRAW_BLEND = 32,
       LMB_DRAW_LOGIC = 64 /* instead of blending */,
       LMB_DRAW_DITHER = 128 /* 16-bit colours: lmb_store_tile's pattern */, LMB_DRAW_FLAT = 256,
       LMB_DRAW_CLOCKWISE = 512 /* front faces are clockwise in the picture */, LMB_DRAW_CULL_FRONT = 1024,
       LMB_DRAW_CULL_BACK = 2048,
       LMB_DRAW_DISCARDS = 4096 /* the shader may leave pixels out: it runs before the tests */,
       LMB_DRAW_FLAGS = 8191 };

/* Tests pass if VALUE FUNC OTHER: a pixel's d and the stored d; alpha and alpha_value; stencil_value and the
 * stencil, both and-ed with stencil_mask. */
enum { LMB_DRAW_NEVER = 0, LMB_DRAW_LESS = 1, LMB_DRAW_EQUAL = 2, LMB_DRAW_LEQUAL = 3, LMB_DRAW_GREATER = 4,
       LMB_DRAW_NOTEQUAL = 5, LMB_DRAW_GEQUAL = 6, LMB_DRAW_ALWAYS = 7 };

enum { LMB_DRAW_KEEP = 0, LMB_DRAW_CLEAR = 1, LMB_DRAW_PUT = 2, LMB_DRAW_INCREASE = 3, LMB_DRAW_DECREASE = 4,
       LMB_DRAW_INVERT = 5, LMB_DRAW_INCREASE_WRAP = 6, LMB_DRAW_DECREASE_WRAP = 7 };

/* Factors, 0 .. 1, of the new colour (SOURCE) and of the target's (TARGET). CONSTANT: blend_colour. INVERSE: 1
 * minus. */
enum { LMB_DRAW_ZERO = 0, LMB_DRAW_ONE = 1, LMB_DRAW_SOURCE_COLOUR = 2, LMB_DRAW_INVERSE_SOURCE_COLOUR = 3,
       LMB_DRAW_SOURCE_ALPHA = 4, LMB_DRAW_INVERSE_SOURCE_ALPHA = 5, LMB_DRAW_TARGET_ALPHA = 6,
       LMB_DRAW_INVERSE_TARGET_ALPHA = 7, LMB_DRAW_TARGET_COLOUR = 8, LMB_DRAW_INVERSE_TARGET_COLOUR = 9,
       LMB_DRAW_SATURATE = 10 /* min(source alpha, 1 - target alpha); of alpha 1 */, LMB_DRAW_CONSTANT_COLOUR = 11,
       LMB_DRAW_INVERSE_CONSTANT_COLOUR = 12, LMB_DRAW_CONSTANT_ALPHA = 13, LMB_DRAW_INVERSE_CONSTANT_ALPHA = 14 };
enum { LMB_DRAW_ADD = 0, LMB_DRAW_SUBTRACT = 1 /* source - target */, LMB_DRAW_REVERSE_SUBTRACT = 2, LMB_DRAW_MIN = 3,
       LMB_DRAW_MAX = 4 /* both without factors */ };

/* logic_op, a truth table. Bit 0: the result if source and target bit are 1; bit 1: source 1, target 0; bit 2: source
 * 0, target 1; bit 3: both 0. So 3 copies, 6 is exclusive or, 1 and, 7 or, 10 inverts the target. */

/* Effect of a stage's texel T with alpha a on the current colour C with alpha A. Every product is divided by 255
 * exactly, and rounded to nearest. */
enum { LMB_DRAW_MODULATE = 0, /* C T, A a */
       LMB_DRAW_REPLACE = 1,  /* T, a */
       LMB_DRAW_DECAL = 2,    /* C (1 - a) + T a, A */
       LMB_DRAW_MIX = 3,      /* C (1 - T) + colour T, A a */
       LMB_DRAW_PLUS = 4,     /* C + T, A a */
       LMB_DRAW_COMBINE = 5   /* see lmb_draw_combine */ };

/* LMB_DRAW_COMBINE: functions of arguments a, b and c, each 0 .. 1; results are scaled, then clamped. SIGNED adds half
 * a code to get whole codes. DOT3 is 4 ((Ra - 1/2) (Rb - 1/2) + (G..) + (B..)) for R, G and B; DOT4 for A too. */
enum { LMB_DRAW_ARG = 0 /* a */, LMB_DRAW_PRODUCT = 1 /* a b */, LMB_DRAW_SUM = 2 /* a + b */,
       LMB_DRAW_SIGNED = 3 /* a + b - 1/2 */, LMB_DRAW_INTERPOLATE = 4 /* a c + b (1 - c) */,
       LMB_DRAW_DIFFERENCE = 5 /* a - b */, LMB_DRAW_DOT3 = 6, LMB_DRAW_DOT4 = 7 };
/* An argument is a source, and an operand that picks the channel itself or alpha; INVERSE: 1 minus. */
enum { LMB_DRAW_FROM_TEXTURE = 0, LMB_DRAW_FROM_CONSTANT = 1 /* the stage's colour */,
       LMB_DRAW_FROM_VERTEX = 2 /* the colour before all stages */, LMB_DRAW_FROM_PREVIOUS = 3 /* the stage before */,
       LMB_DRAW_FROM_STAGE = 4 /* + n: the texel of stage n; 1 if it has no texture */ };
enum { LMB_DRAW_TAKE_COLOUR = 0, LMB_DRAW_TAKE_INVERSE_COLOUR = 1, LMB_DRAW_TAKE_ALPHA = 2,
       LMB_DRAW_TAKE_INVERSE_ALPHA = 3 };

/* Index 0: of R, G and B; 1: of A. */
typedef struct lmb_draw_combine {
    uint8_t func[2];       /* LMB_DRAW_ARG, ...; of A at most LMB_DRAW_DIFFERENCE */
    uint8_t source[2][3];  /* of a, b and c */
    uint8_t operand[2][3]; /* of A, both COLOUR and ALPHA take alpha */
    uint8_t shift[2];      /* 0 .. 2: times 1, 2 or 4 */
} lmb_draw_combine;

/* A texture stage. The texture's own filter applies: LMB_NEAREST and LMB_BILINEAR read level 0, LMB_TRILINEAR the two
 * levels around log2 of the texels per pixel. Weights are whole 1/256. Codes are mixed without conversion. */
typedef struct lmb_draw_stage {
    const lmb_texture *texture; /* NULL: the colour passes unchanged */
    float level_bias;           /* added to the level, -16 .. 16 */
    uint8_t mode;               /* LMB_DRAW_MODULATE, ... */
    uint8_t colour[4];          /* of LMB_DRAW_MIX and LMB_DRAW_FROM_CONSTANT */
    lmb_draw_combine combine;
} lmb_draw_stage;

/* Fog by distance c: f = (end - c) / (end - start), 2^(-density c log2 e), or 2^(-(density c)^2 log2 e) with the
 * library's own exp2, as a code 0 .. 255. The colour becomes f C + (1 - f) fog_colour, rounded to nearest. */
enum { LMB_DRAW_FOG_NONE = 0, LMB_DRAW_FOG_LINEAR = 1, LMB_DRAW_FOG_EXP = 2, LMB_DRAW_FOG_EXP2 = 3 };

/* Polygon modes. Edges are drawn as lines and corners as points, each clipped separately, with the values of the
 * polygon's vertices. Depth offset does not move them. */
enum { LMB_DRAW_FILL = 0, LMB_DRAW_EDGES = 1, LMB_DRAW_CORNERS = 2 };

/* A primitive's pixels in a tile of 8x8, for a shader. Pixel k is (x + k % 8, y + k / 8) of the frame. */
typedef struct lmb_draw_pixels_of {
    const void *job;    /* for lmb_draw_fragment */
    uint32_t vertex[3]; /* the primitive's vertices in the streams; of a line the third is the first; of a point all are
                           equal */
    int32_t x, y;
    int32_t is_back;    /* 1: the triangle shows its back; also set for the edges and corners */
    uint64_t mask;      /* pixels to colour, a bit each */
} lmb_draw_pixels_of;

/* Position of a pixel in its primitive. To interpolate a vertex value, use v0 + share[0] (v1 - v0) + share[1] (v2 -
 * v0); the result is perspective-correct. by_x, by_y: the shares' changes per px. */
typedef struct lmb_draw_fragment_at {
    float share[2], by_x[2], by_y[2];
} lmb_draw_fragment_at;

/* Your own shader: write R G B A of the pixels in the mask, and return the mask of pixels to draw. */
typedef uint64_t (*lmb_draw_shader)(void *user, const lmb_draw_pixels_of *pixels, uint8_t colour[64][4]);

/* The state of a draw. Initialize it with lmb_draw_state_init, then change the members that you need. */
typedef struct lmb_draw_state {
    const struct lmb_kernels *kernels; /* lmb_kernels_pick(): the same pixels in less time; NULL: plain C */
    lmb_mat4 to_clip;                 /* matrix from the vertices' space to clip space */
    float plane[LMB_DRAW_PLANES][4];  /* clips away points with plane[i] . (x, y, z, 1) < 0, in the vertices' space */
    float fog_axis[4];                /* c = fog_axis . (x, y, z, 1); all 0: the w of clip space */
    int32_t viewport[4];              /* x, y, width, height: px of the frame; nothing is drawn outside */
    int32_t scissor[4];               /* as viewport, with LMB_DRAW_SCISSOR; width and height from 0 */
    float depth_range[2];             /* stored d for z / w = 0 and 1; each 0 .. 1 */
    float offset_slope, offset_units; /* added to triangles' d: slope x the larger change per px + units x the smallest
                                         step */
    lmb_draw_stage stage[LMB_DRAW_STAGES];
    const uint8_t *area_pattern;      /* of filled polygons: a bit each for 32 x 32 px of the frame, 4 bytes a row, low
                                         bits to the left; pixels with 0 are left out. NULL: none */
    float fog_start, fog_end, fog_density;
    lmb_draw_shader shader;           /* replaces colours, stages, second colours and fog; NULL: none */
    void *shader_user;
    uint64_t *passed;                 /* incremented by the number of pixels that pass all tests; NULL: none */
    uint32_t flags;                   /* LMB_DRAW_DEPTH_TEST, ... */
    uint8_t colour[4], fog_colour[3], blend_colour[4];
    uint8_t planes;                   /* active clip planes, a bit each */
    uint8_t fog;                      /* LMB_DRAW_FOG_NONE, ... */
    uint8_t depth_func, alpha_func, alpha_value;
    uint8_t colour_mask;              /* bits 0 .. 3: write R, G, B, A */
    uint8_t stencil_func, stencil_value, stencil_mask, stencil_write; /* write: bits that may change */
    uint8_t stencil_op[3];            /* if the stencil test fails; if the depth test fails; if both pass */
    uint8_t blend_source[2], blend_target[2], blend_equation[2]; /* of colour, of alpha */
    uint8_t logic_op;
    uint8_t line_px, point_px;        /* widths, 1 .. 255 */
    uint8_t polygon_mode[2];          /* of front and of back faces: LMB_DRAW_FILL, ... */
    uint16_t line_pattern;            /* pixel n of a line is left out if bit n / line_repeat % 16 is 0 */
    uint16_t line_repeat;             /* 1 .. 256. In strips, loops and polygons n continues from line to line */
} lmb_draw_state;

/* Light at vertices with the formula of OpenGL 1.x: lmb_draw_light. Positions of lamps are in eye space: the eye is at
 * (0, 0, 0) and looks along -z. Colours are codes / 255. */
enum { LMB_DRAW_LAMPS = 8 };
typedef struct lmb_draw_lamp {
    float position[4];                       /* w 0: the direction to it, infinitely far */
    float ambient[3], diffuse[3], specular[3];
    float spot_direction[3];                 /* any length */
    float spot_exponent;                     /* 0 .. 128 */
    float spot_cos;                          /* cosine of the cone's half angle; -1: no cone */
    float attenuation[3];                    /* factors of 1, distance and distance^2, each >= 0; ignored if w is 0 */
} lmb_draw_lamp;

typedef struct lmb_draw_material {
    float emission[3], ambient[3], diffuse[4] /* with alpha */, specular[3];
    float shininess; /* 0 .. 128 */
} lmb_draw_material;

/* Material colours that are replaced by the vertices' colours; alpha with DIFFUSE. */
enum { LMB_DRAW_TRACK_EMISSION = 1, LMB_DRAW_TRACK_AMBIENT = 2, LMB_DRAW_TRACK_DIFFUSE = 4,
       LMB_DRAW_TRACK_SPECULAR = 8 };

typedef struct lmb_draw_lighting {
    const lmb_draw_lamp *lamps;
    uint32_t count;                /* of lamps, up to LMB_DRAW_LAMPS */
    lmb_mat4 to_eye;               /* matrix of vertices and, as inverse transpose, of normals */
    float ambient[3];              /* of the scene */
    lmb_draw_material material[2]; /* of fronts and of backs */
    uint8_t tracks;                /* LMB_DRAW_TRACK_EMISSION, ... */
    uint8_t is_local;              /* 1: highlights with the direction to the eye; 0: with +z */
    uint8_t is_raw;                /* 1: normals keep their length; 0: they are normalized */
} lmb_draw_lighting;

/* Output colours, 4 bytes a vertex. */
typedef struct lmb_draw_lit {
    uint8_t *colours, *seconds;           /* seconds: highlights, to be added after the stages; NULL: highlights go into
                                             `colours` */
    uint8_t *back_colours, *back_seconds; /* of backs, lit with reversed normals; NULL: none */
} lmb_draw_lit;

/* A picture to copy from. */
enum { LMB_BLIT_PALETTE8 = 64 /* in addition to LMB_RGB565 .. LMB_BGRA8: a byte a pixel */ };
typedef struct lmb_blit_image {
    const void *data; /* first row, aligned for the pixels */
    const uint8_t *palette; /* 256 colours R G B A, for LMB_BLIT_PALETTE8 */
    int32_t width, height, stride_bytes;
    uint8_t format;
} lmb_blit_image;

enum { LMB_BLIT_KEY = 1, LMB_BLIT_ALPHA = 2, LMB_BLIT_DITHER = 4, LMB_BLIT_FLAGS = 7 };
typedef struct lmb_blit_how {
    int32_t part[4]; /* x, y, width, height of the part to copy, inside the image */
    int32_t scale;   /* each pixel becomes scale x scale, 1 .. 64 */
    uint32_t flags;
    uint32_t key;    /* LMB_BLIT_KEY: pixels of this value are left out; palette: the index; 4 bytes: R in the low
                        bits */
    uint8_t alpha;   /* LMB_BLIT_ALPHA: factor of the pixel's alpha: source x alpha + target x (1 - alpha) */
} lmb_blit_how;
#endif

#ifdef __cplusplus
extern "C" {
#endif

#if LMB_DRAW
/* lmb_draw_state_init: a state that draws white, without tests, into a viewport of width x height at (0, 0); vertices
 * are in clip space with w = 1. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_draw_state_init(lmb_draw_state *out, int32_t width, int32_t height);

/* lmb_draw_view: set to_clip, fog_axis and the viewport for the frame of a view, and for vertices that `to_world`
 * transforms. The view's samples are ignored. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_draw_view(lmb_draw_state *inout, const lmb_view *view, const lmb_mat4 *to_world);

/* lmb_draw_pixels: set to_clip so that vertices are pixels of the viewport, (0, 0) the upper left corner, y down; z is
 * d. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_draw_pixels(lmb_draw_state *inout);

#if !LMB_DRAW_SMALL
/* lmb_draw_light: compute lit colours of `vertices` for lmb_draw_list, with the library's own log2 and exp2.
 *
 *   out      colours must be set, the others may be NULL. May be vertices->colours.
 *   normals  x, y, z a vertex; NULL: all face the eye, (0, 0, 1) in eye space. A normal of length near 0 gets no light
 *            of lamps.
 * LMB_DRAW_F32X4: at (x, y, z) / w, or at (x, y, z) if w is 0. A vertex that is not finite gets an unspecified colour.
 * Returns LMB_OK, or LMB_ERR_ARG, LMB_ERR_FORMAT or LMB_ERR_ALIGN: then nothing is written. */
lmb_status lmb_draw_light(const lmb_draw_lit *out, const lmb_draw_lighting *how, const lmb_draw_vertices *vertices,
                          const float *normals);
#endif

/* lmb_draw_list: draw primitives.
 *
 * Vertices snap to 1/256 px. Triangles cover the pixels with centres inside, by the top-left rule. A line of one pixel
 * covers the pixels with diamonds (|dx| + |dy| < 1/2) that it leaves. A point on a diamond's edge counts as a little
 * further to the left, and by a much smaller amount further up. A line of width n begins (n - 1) / 2 px further up, and
 * covers n pixels downwards at each step. A steep line begins further to the left, and covers n pixels to the right.
 * Points are squares. Points and wide lines are drawn as far as they lie in the viewport. Attributes are
 * perspective-correct. Blending rounds the exact quotient to nearest. If blending leaves a channel of 16-bit colours
 * unchanged, the channel keeps its bits.
 *
 *   indices  NULL: all vertices in order.   primitive  LMB_DRAW_TRIANGLES, ...; vertices left over are ignored.
 *   stats    or NULL: primitives count as triangles. Primitives are dropped and counted if a vertex is not finite, if a
 *            position or texture coordinate is 2^20 or more, or if an index is outside.
 * The order of draws does not matter if they blend by ADD with the factors ONE and ONE, by MIN or by MAX.
 * Returns LMB_OK; LMB_ERR_ARG, LMB_ERR_FORMAT or LMB_ERR_ALIGN if a value of target, state, vertices or indices is out
 * of range, or if a test has no surface: then nothing is written. Stack: under 4 KiB. */
lmb_status lmb_draw_list(const lmb_draw_target *target, const lmb_draw_state *state, const lmb_draw_vertices *vertices,
                         int32_t primitive, const lmb_draw_indices *indices, lmb_stats *stats);

#if !LMB_DRAW_SMALL
/* lmb_draw_fragment: the position of pixel `k`, 0 .. 63, in the primitive. Call it only inside the shader; gives zeros
 * if `pixels` has no job or `k` is outside. */
void lmb_draw_fragment(lmb_draw_fragment_at *out, const lmb_draw_pixels_of *pixels, int32_t k);

/* lmb_draw_shares: the shares of all pixels of the mask at once, equal to those of lmb_draw_fragment. Values
 * of other pixels are undefined. */
void lmb_draw_shares(float out[2][64], const lmb_draw_pixels_of *pixels);

/* lmb_draw_steps: by_x and by_y of all pixels of the mask at once, equal to those of lmb_draw_fragment. Values of other
 * pixels are undefined. */
void lmb_draw_steps(float by_x[2][64], float by_y[2][64], const lmb_draw_pixels_of *pixels);
#endif

/* lmb_blit: copy an image to (x, y) of a surface; parts outside the surface are cut off.
 *
 *   how  NULL: the whole image, scale 1, no flags.
 * An image may lie in the surface's own memory. At scale 1, with equal formats and strides, the result is as if the
 * image were read first. Otherwise, if the bytes from the first to the last written pixel overlap those that are read,
 * the call returns LMB_ERR_ARG.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_FORMAT; nothing is written unless LMB_OK. */
lmb_status lmb_blit(const lmb_surface *to, int32_t x, int32_t y, const lmb_blit_image *from, const lmb_blit_how *how);

/* lmb_text: write text at (x, y), the upper left corner, in cells of 6 x 8 px times `scale`, 1 .. 64. '\n' begins a
 * line. Bytes outside ASCII 32 .. 126 are drawn as a box.
 *
 *   colour  R G B A; alpha blends.
 * Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_FORMAT. */
lmb_status lmb_text(const lmb_surface *to, int32_t x, int32_t y, const char *text, int32_t scale,
                    const uint8_t colour[4]);

/* lmb_text_width: width of the text's widest line at scale 1, px; 0 for NULL. */
int32_t lmb_text_width(const char *text);
#endif

#ifdef __cplusplus
}
#endif
#endif
