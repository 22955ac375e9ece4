/* room.h: the demo that every port shows: a baked room, whose lamp and camera move along a fixed path of ROOM_FRAMES
 * frames. Integers alone, so that machines without an FPU draw it, and each machine the same.
 *
 *     room_open(..)       memory for one size of picture
 *     room_path(..)       where lamp and camera are in a frame;  room_steer(..): moved by buttons
 *     room_see(..)        a frame begins: what is seen, and its light
 *     room_put_bands(..)  then its rows from top to bottom, each band handed to `put`
 *     room_draw_on(..)    or straight onto a screen of 16 bits
 *     room_frame_hash(..) of its colours before dithering: equal on all machines
 *     room_rgb555(..), room_rgb565(..)  a row of 0x00RRGGBB in a display's own format, dithered
 */
#ifndef ROOM_H
#define ROOM_H

#include <lambent/fixed.h>

enum {
    ROOM_FRAMES = 60,
    ROOM_KEPT = 480, /* triangles */
    ROOM_MAX_WIDTH = 640, /* px */
    ROOM_MAX_HEIGHT = 480
};

/* Where lamp and camera are. Lengths in 1/1024 m, angles in 1/65536 of a turn. */
typedef struct room_pose {
    int32_t eye[3], yaw, pitch; /* yaw 0: towards -Z; larger turns to the left. Larger pitch looks up */
    int32_t lamp[3];
} room_pose;

enum {
    ROOM_LEFT = 1, ROOM_RIGHT = 2, ROOM_UP = 4, ROOM_DOWN = 8,                  /* turn the camera */
    ROOM_LAMP_LEFT = 16, ROOM_LAMP_RIGHT = 32, ROOM_LAMP_NEAR = 64, ROOM_LAMP_FAR = 128, /* move the lamp */
    ROOM_BUTTONS = 8
};

/* Stages whose cost is told apart. */
enum { ROOM_TRANSFORM, ROOM_LIGHT, ROOM_FILL, ROOM_SHOW, ROOM_STAGES };

/* rgb: 0x00RRGGBB, width x rows of them, of the rows from y on. */
typedef void room_put(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows);

/* Where a screen that is not shown yet has the rows from y on, without gaps between them. */
typedef uint16_t *room_rows(int32_t y);

typedef struct room {
    int32_t width, height; /* px */
    int32_t rows, put_rows; /* of a band that is drawn straight onto a screen, and of one that is handed on */
    void *memory, *band;
    size_t memory_bytes, band_bytes;
    uint32_t (*clock)(void);      /* counts up, and may wrap; NULL: nothing is counted */
    uint32_t taken[ROOM_STAGES];  /* by the last frame */
    lmb_fixed scene;
    lmb_fixed_frame frame;
} room;

/* room_bytes: memory beside the band; room_bytes_kept: with more, a frame's bands share what they know of up to
 * ROOM_KEPT triangles; room_band_bytes: of a band, for the fastest memory that there is: colours and depths, or depths
 * alone where its colours go onto the screen. 0: bad size. */
size_t room_bytes(int32_t width, int32_t height);
size_t room_bytes_kept(int32_t width, int32_t height);
#define ROOM_BAND_BYTES(width, rows) ((width) * (rows) * 6)
#define ROOM_DEPTH_BYTES(width, rows) ((width) * ((rows) < 3 ? 6 : (rows) * 2))

/* room_open: both blocks lie on 4 bytes and stay the room's; `rows` is of bands of depths, or of both. 0, or 1: bad size,
 * too little memory or damaged data. */
int room_open(room *out, int32_t width, int32_t height, int32_t rows, void *memory, size_t bytes, void *band,
              size_t band_bytes);

/* room_path: of frame 0 .. ROOM_FRAMES - 1; others wrap. room_steer: one frame of held buttons, kept within the room. */
void room_path(room_pose *out, int32_t frame);
void room_steer(room_pose *inout, uint32_t buttons);

/* The time that `put` takes is no stage's; whoever gives it adds it to taken[ROOM_SHOW]. `format`: of lambent/fixed.h, one
 * of 16 bits. */
void room_see(room *r, const room_pose *pose);
void room_put_bands(room *r, room_put *put, void *user);
void room_draw_on(room *r, int32_t format, room_rows *rows);

/* room_frame_hash: of the frame that was begun last, by bands of its own, whose time is no stage's. */
uint32_t room_frame_hash(room *r);

/* room_hash: FNV-1a of 32 bits over R, G, B of each pixel; begin with ROOM_HASH, go on with the last result. */
#define ROOM_HASH 2166136261u
uint32_t room_hash(uint32_t hash, const uint32_t *rgb, int32_t count);

/* A row, dithered by Bayer's 4 x 4 matrix t of 0 .. 15 by x & 3 and y & 3, each quotient rounded down.
 * room_rgb555: red in the low bits, the code c of 0 .. 255 becomes (min(c, 248) + t / 2) / 8, as in lambent/fixed.h.
 * room_rgb565: red in the high bits, (c - c / 32 + t / 2) / 8, and green (c - c / 64 + t / 4) / 4. */
void room_rgb555(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y);
void room_rgb565(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y);

#endif
