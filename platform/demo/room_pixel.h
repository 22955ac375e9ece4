/* room_pixel.h: the room of room.h by the library's whole renderer: each pixel gets light straight from the lamp, with
 * shadows by a map, and what surfaces throw back, by baked transfer. Takes binary32 arithmetic; soft float will do.
 *
 *     room_pixel_open(..)   memory, the baked light, the scene
 *     room_pixel_draw(..)   a frame by a pose of room.h, in bands of 8 rows from top to bottom, each handed to `put`
 */
#ifndef ROOM_PIXEL_H
#define ROOM_PIXEL_H

#include <lambent/lambent.h>

#include "room.h"

enum {
    ROOM_PIXEL_BAND = 8,   /* rows */
    ROOM_PIXEL_STRIP = 16, /* rows whose depth and ids are kept: the scene is drawn once for each strip */
    ROOM_PIXEL_MAP = 32,   /* texels of the side of each of the shadow map's six faces */
    ROOM_PIXEL_MAP_WORDS = ROOM_PIXEL_MAP * ROOM_PIXEL_MAP * 6 * 6 / 4, /* depth and 16-bit ids */
    ROOM_PIXEL_LIGHT_WORDS = 6400
};

/* Words of memory for a picture `width` px wide, which is a multiple of 8: a band of colours, a strip's depth and
 * 16-bit ids, the shadow map, and the baked light's state. */
#define ROOM_PIXEL_WORDS(width)                                                                    \
    ((width) * (ROOM_PIXEL_BAND + ROOM_PIXEL_STRIP + ROOM_PIXEL_STRIP / 2) + ROOM_PIXEL_MAP_WORDS + \
     ROOM_PIXEL_LIGHT_WORDS)

/* Stages whose cost is told apart. */
enum { ROOM_PIXEL_MAPPED, ROOM_PIXEL_LIT, ROOM_PIXEL_FILLED, ROOM_PIXEL_SHOWN, ROOM_PIXEL_STAGES };

typedef struct room_pixel {
    lmb_frame frame;
    lmb_render render;
    lmb_band_scratch scratch;
    lmb_transfer transfer;
    lmb_scene scene; /* the demo's; its light moves */
    lmb_light lamp;
    int32_t width, height;
    uint32_t (*clock)(void); /* counts up, and may wrap; NULL: nothing is counted */
    uint32_t taken[ROOM_PIXEL_STAGES], from; /* by the last frame; where the stage at hand began */
    room_put *put;
    void *user;
} room_pixel;

/* room_pixel_open: `memory` has ROOM_PIXEL_WORDS(width) words and stays the room's; width and height are multiples of
 * 8. The library's status. */
lmb_status room_pixel_open(room_pixel *out, int32_t width, int32_t height, uint32_t *memory);

/* room_pixel_draw: the time that `put` takes is counted as ROOM_PIXEL_SHOWN. The library's status. */
lmb_status room_pixel_draw(room_pixel *r, const room_pose *pose, room_put *put, void *user);

#endif
