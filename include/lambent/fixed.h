/* fixed.h: frames with integers only, for processors without an FPU: triangles with light at the vertices, in 32-bit
 * pixels or dithered in 16 bits. No float, no division.
 *
 *     lmb_fixed_open(..)       a baked scene, used in place: made by `lambent pack` or tools/pack
 *     lmb_fixed_transform(..)  vertices to the screen; visible triangles
 *     lmb_fixed_light(..)      the lamp's light at those vertices, including bounced light
 *     lmb_fixed_prepare(..)    if memory allows: set up each triangle once, not in each band
 *     lmb_fixed_band(..)       rows of the picture, in bands of any height: the same pixels
 *
 * Only the lamp and the camera of a scene move. The lamp's visibility from each vertex was baked for a lattice of
 * places, and is interpolated between them: shadows are as sharp as places are close.
 *
 * Stability: experimental. */
#ifndef LMB_FIXED_H
#define LMB_FIXED_H

#include "types.h"

enum {
    LMB_FIXED_VERSION = 1,       /* the blob's fourth byte, after `LMF` */
    LMB_FIXED_HEADER_WORDS = 20,
    LMB_FIXED_RECEIVER_WORDS = 3,
    LMB_FIXED_ROW_WORDS = 2,
    LMB_FIXED_REACH = 8191,      /* units: limit of coordinates, each way */
    LMB_FIXED_EYE = 24576,       /* the same for a camera */
    LMB_FIXED_MAX_SIDE = 640,    /* px */
    LMB_FIXED_MAX_VERTICES = 16384,
    LMB_FIXED_MAX_TRIANGLES = 32767,
    LMB_FIXED_MAX_ELEMENTS = 256,
    LMB_FIXED_MAX_PLACES = 4096,
    LMB_FIXED_MAX_LINKS = 254,   /* of a row */
    LMB_FIXED_GROUP = 8,
    LMB_FIXED_MAX_SUM = 32767,   /* of a row's weights: times 65535 it fits 31 bits */
    LMB_FIXED_SCALE = 36,        /* fraction bits of a row's scale: the weights times the scale sum up to at most 1 */
    LMB_FIXED_ONE = 16384,       /* of axes, directions and cosines */
    LMB_FIXED_WHITE = 4096       /* of intensity: just white for a white surface 1 m away that faces the lamp */
};

/* As background: surfaces cover the whole picture, so bands are not cleared first. Uncovered pixels keep their old
 * value. */
#define LMB_FIXED_COVERED 0xffffffffu

/* Formats of a picture: 0x00RRGGBB, codes up to LMB_FIXED_RGB_MOST; or 16 bits, dithered: red in the low five bits, or
 * in the high ones with the last bit 1. A code c of 0x00RRGGBB becomes (c + t / 2) / 8, each quotient rounded down; t
 * is the entry of Bayer's 4 x 4 matrix of 0 .. 15 at x & 3, y & 3. */
enum { LMB_FIXED_RGB888, LMB_FIXED_BGR555, LMB_FIXED_RGBA5551, LMB_FIXED_RGB_MOST = 248 };

/* A blob in place: 32-bit words in native byte order.
 *
 *   header      magic, total words, log2 of units a metre, vertices, triangles, elements, words of links, places along
 *               x, y, z, the first place's x, y, z, distance of places in units, world position of x, y, z = 0 in
 *               units, triangles of the hull, two words 0
 *   receivers   vertices, then elements: x | y << 16, z | nx << 16 | ny << 24, nz | r << 8 | g << 16 | b << 24:
 *               position in units, normal in 1/127, square roots of the linear albedo in 1/255
 *   triangles   two words: a | b << 16, c; counter-clockwise from the front, the only visible side. First those of the
 *               hull: walls with all of the scene in front of them. They are drawn without depths, because no visible
 *               surface lies behind one, and none hides another
 *   rows        of each receiver: first word among links | links << 24, an even number; scale
 *   links       two a word, the first in the low half: weight << 8 | element
 *   places      a bit each: 1 if the lamp may be there
 *   seen        of each receiver a bit a place, in whole words: 1 if no surface hides the place */
typedef struct lmb_fixed {
    const uint32_t *receiver, *triangle, *row, *link, *valid, *seen;
    uint32_t vertices, triangles, hull, elements, place_words;
    int32_t units_log2;
    int32_t places[3], first[3], spacing, origin[3];
} lmb_fixed;

/* Position in units; axes of length LMB_FIXED_ONE, orthogonal: right, up, back. */
typedef struct lmb_fixed_view {
    int32_t eye[3], axis[3][3];
    int32_t focal;         /* 1/16 px: half the height / tan(half the vertical angle of view) */
    int32_t width, height; /* px of the whole picture */
    int32_t near_units;    /* near plane, at least 16 */
} lmb_fixed_view;

/* A point light, or a spot: full inside the inner cone, 0 outside the outer one. It has no range. */
typedef struct lmb_fixed_lamp {
    int32_t position[3];  /* units */
    int32_t direction[3]; /* LMB_FIXED_ONE long; of spots */
    uint32_t intensity[3]; /* 1 is LMB_FIXED_WHITE; below 2^20 */
    int32_t cos_inner, cos_outer; /* 1 is LMB_FIXED_ONE; equal: a point light */
} lmb_fixed_lamp;

/* A vertex on the screen. 10 bytes. */
typedef struct lmb_fixed_vertex {
    int16_t x, y;      /* 1/16 px from the picture's upper left corner, minus a bias of the middle */
    uint16_t depth;    /* larger is nearer */
    uint8_t colour[3]; /* sRGB, 1 .. 247 */
    uint8_t flags;
} lmb_fixed_vertex;

/* A triangle that may be visible; a clipped one is listed once for each triangle that remains of it. */
typedef struct lmb_fixed_seen {
    uint16_t triangle; /* and a bit if it has to be clipped */
    int16_t first, past; /* rows */
} lmb_fixed_seen;

/* Rows of LMB_FIXED_GROUP triangles that may be visible, so that bands skip all of them at once. */
typedef struct lmb_fixed_rows {
    int16_t first, past;
} lmb_fixed_rows;

/* An edge in a row, and the step to the next row: 2^-14 px. */
typedef struct lmb_fixed_edge {
    int32_t at, slope;
} lmb_fixed_edge;

/* A triangle set up for filling: depth, red, green, blue in the row `first`, at the centre of the first pixel; the
 * steps to the next pixel and row. The edge over all rows, and those above and below the middle corner. 84 bytes. */
typedef struct lmb_fixed_ready {
    int16_t first, middle, past; /* rows */
    int16_t left, right;         /* columns that it may cover */
    uint8_t is_gentle, is_whole_left;
    uint32_t at[4], per_x[4], per_y[4];
    lmb_fixed_edge whole, upper, lower;
} lmb_fixed_ready;

/* The frame to draw, and your memory for it. */
typedef struct lmb_fixed_frame {
    const lmb_fixed *scene;
    lmb_fixed_view view;
    lmb_fixed_lamp lamp;
    int32_t bounces;        /* 0 .. 3 reflections of light */
    lmb_fixed_vertex *vertex;      /* one per vertex */
    lmb_fixed_seen *seen;          /* one per triangle; if there are fewer, further triangles are left out */
    lmb_fixed_rows *group;         /* one per LMB_FIXED_GROUP entries of `seen` */
    uint32_t (*direct)[3];         /* one per element: light of the lamp */
    uint32_t seen_cap, seen_count; /* count: set by lmb_fixed_transform */
    lmb_fixed_ready *ready;        /* for the first seen_count triangles, as many as fit; may be NULL */
    uint32_t ready_cap, ready_count; /* count: set by lmb_fixed_prepare */
    int32_t format;
    uint32_t *pixel;               /* of a band: width x rows, for LMB_FIXED_RGB888 */
    uint16_t *pixel_16;            /* for the other formats; may be the screen's own memory */
    uint16_t *depth;               /* width x rows, too */
    uint32_t background;           /* 0x00RRGGBB, codes up to LMB_FIXED_RGB_MOST; or LMB_FIXED_COVERED */
} lmb_fixed_frame;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_fixed_open: use a blob in place. `data` is 4-byte aligned; do not move it while you use `out`. The call checks
 * all of it in one pass: afterwards no number in it can lead outside the blob or overflow a sum.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN, LMB_ERR_FORMAT (no blob, cut off, damaged), or LMB_ERR_BUILD: it has the
 * other byte order. */
lmb_status lmb_fixed_open(lmb_fixed *out, const void *data, size_t bytes);

/* lmb_fixed_memory: bytes of vertex, seen (of seen_cap), group and direct together; 0: null.
 * lmb_fixed_lay: lay them out in 4-byte aligned memory. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or
 * LMB_ERR_CAPACITY. */
size_t lmb_fixed_memory(const lmb_fixed *scene, uint32_t seen_cap);
lmb_status lmb_fixed_lay(lmb_fixed_frame *frame, const lmb_fixed *scene, uint32_t seen_cap, void *memory, size_t bytes);

/* lmb_fixed_look_at: set eye and axes of an upright view. Returns LMB_OK or LMB_ERR_ARG: target at eye, straight above
 * or below it, eye beyond LMB_FIXED_EYE or target beyond LMB_FIXED_REACH. */
lmb_status lmb_fixed_look_at(lmb_fixed_view *inout, const int32_t eye[3], const int32_t target[3]);

/* lmb_fixed_transform: transform vertices to the screen, and find the visible triangles.
 * lmb_fixed_light: then compute light at the vertices of these triangles.
 * Both return LMB_OK or LMB_ERR_ARG (null, a number out of range). Stack: 2.5 KiB. */
lmb_status lmb_fixed_transform(lmb_fixed_frame *frame);
lmb_status lmb_fixed_light(lmb_fixed_frame *frame);

/* lmb_fixed_prepare: after light, fill `ready`; bands then need not set up these triangles. The pixels are the same.
 * Returns LMB_OK, also if `ready` is null, or LMB_ERR_ARG. */
lmb_status lmb_fixed_prepare(lmb_fixed_frame *frame);

/* lmb_fixed_band: draw rows `first` .. `past` - 1 of the picture into the band's memory, from the first row on. Returns
 * LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_fixed_band(const lmb_fixed_frame *frame, int32_t first, int32_t past);

#ifdef __cplusplus
}
#endif
#endif
