/* room_pixel.h: the room of room.h by the library's whole renderer: each pixel gets direct light of the lamp with
 * shadows from a map, and bounced light from baked transfer. Needs binary32 arithmetic, possibly as soft float.
 *
 *     room_pixel_open(..)   memory, the baked light, the scene
 *     room_pixel_draw(..)   a frame for a pose of room.h, in bands of 8 rows from top to bottom; `put` gets each */
#ifndef ROOM_PIXEL_H
#define ROOM_PIXEL_H

#include <lambent/lambent.h>

#include "room.h"

enum {
    ROOM_PIXEL_BAND = 8,   /* rows */
    ROOM_PIXEL_STRIP = 16, /* rows of stored depth and ids: the scene is drawn once for each strip */
    ROOM_PIXEL_MAP = 32,   /* side of each of the shadow map's six faces, in texels */
    ROOM_PIXEL_MAP_WORDS = ROOM_PIXEL_MAP * ROOM_PIXEL_MAP * 6 * 6 / 4, /* depth and 16-bit ids */
    ROOM_PIXEL_LIGHT_WORDS = 6400
};

/* Words of memory for a picture of `width` px, a multiple of 8: a band of colours, a strip's depth and 16-bit ids, the
 * shadow map, and the baked light's state. */
#define ROOM_PIXEL_WORDS(width)                                                                    \
    ((width) * (ROOM_PIXEL_BAND + ROOM_PIXEL_STRIP + ROOM_PIXEL_STRIP / 2) + ROOM_PIXEL_MAP_WORDS + \
     ROOM_PIXEL_LIGHT_WORDS)

/* Stages with separate costs. */
enum { ROOM_PIXEL_MAPPED, ROOM_PIXEL_LIT, ROOM_PIXEL_FILLED, ROOM_PIXEL_SHOWN, ROOM_PIXEL_STAGES };

typedef struct room_pixel {
    lmb_frame frame;
    lmb_render render;
    lmb_band_scratch scratch;
    lmb_transfer transfer;
    lmb_scene scene; /* the demo's, with a moving light */
    lmb_light lamp;
    int32_t width, height;
    uint32_t (*clock)(void); /* counts up, and may wrap; NULL: no counting */
    uint32_t taken[ROOM_PIXEL_STAGES], from; /* in the last frame; start of the current stage */
    room_put *put;
    void *user;
} room_pixel;

/* room_pixel_open: `memory` has ROOM_PIXEL_WORDS(width) words and stays in use; width and height are multiples of 8.
 * Returns the library's status. */
lmb_status room_pixel_open(room_pixel *out, int32_t width, int32_t height, uint32_t *memory);

/* room_pixel_draw: counts the time of `put` as ROOM_PIXEL_SHOWN. Returns the library's status. */
lmb_status room_pixel_draw(room_pixel *r, const room_pose *pose, room_put *put, void *user);

#endif
