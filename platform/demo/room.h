/* room.h: the demo of every port: a baked room. Lamp and camera move along a fixed path of ROOM_FRAMES frames. The code
 * uses only integers, so machines without an FPU draw the room, and all machines draw the same.
 *
 *     room_open(..)       memory for one size of picture
 *     room_path(..)       lamp and camera of a frame;  room_steer(..): moved by buttons
 *     room_see(..)        begins a frame: visible surfaces and their light
 *     room_put_bands(..)  then the rows from top to bottom; `put` gets each band
 *     room_draw_on(..)    or draws directly onto a screen of 16 bits
 *     room_frame_hash(..) hash of the colours before dithering: equal on all machines
 *     room_rgb555(..), room_rgb565(..)  a row of 0x00RRGGBB in a display's own format, dithered */
#ifndef ROOM_H
#define ROOM_H

#include <lambent/fixed.h>

enum {
    ROOM_FRAMES = 60,
    ROOM_KEPT = 480, /* triangles */
    ROOM_MAX_WIDTH = 640, /* px */
    ROOM_MAX_HEIGHT = 480
};

/* Poses of lamp and camera. Lengths in 1/1024 m, angles in 1/65536 of a turn. */
typedef struct room_pose {
    int32_t eye[3], yaw, pitch; /* yaw 0: towards -Z; larger turns to the left. Larger pitch looks up */
    int32_t lamp[3];
} room_pose;

enum {
    ROOM_LEFT = 1, ROOM_RIGHT = 2, ROOM_UP = 4, ROOM_DOWN = 8,                  /* turn the camera */
    ROOM_LAMP_LEFT = 16, ROOM_LAMP_RIGHT = 32, ROOM_LAMP_NEAR = 64, ROOM_LAMP_FAR = 128, /* move the lamp */
    ROOM_BUTTONS = 8
};

/* Stages with separate costs. */
enum { ROOM_TRANSFORM, ROOM_LIGHT, ROOM_FILL, ROOM_SHOW, ROOM_STAGES };

/* rgb: 0x00RRGGBB, `rows` rows of `width` from row y on. */
typedef void room_put(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows);

/* Returns the memory for the rows from y on of a screen that is not shown yet; rows have no gaps. */
typedef uint16_t *room_rows(int32_t y);

typedef struct room {
    int32_t width, height; /* px */
    int32_t rows, put_rows; /* of a band drawn directly onto a screen, and of a band for `put` */
    void *memory, *band;
    size_t memory_bytes, band_bytes;
    uint32_t (*clock)(void);      /* counts up, and may wrap; NULL: no counting */
    uint32_t taken[ROOM_STAGES];  /* in the last frame */
    lmb_fixed scene;
    lmb_fixed_frame frame;
} room;

/* room_bytes: memory without the band. room_bytes_kept: with this size, a frame's bands share results for up to
 * ROOM_KEPT triangles. room_band_bytes: memory of a band, which should be the fastest: colours and depths, or only
 * depths if colours go directly onto the screen. 0: bad size. */
size_t room_bytes(int32_t width, int32_t height);
size_t room_bytes_kept(int32_t width, int32_t height);
#define ROOM_BAND_BYTES(width, rows) ((width) * (rows) * 6)
#define ROOM_DEPTH_BYTES(width, rows) ((width) * ((rows) < 3 ? 6 : (rows) * 2))

/* room_open: both blocks are aligned to 4 bytes and stay in use; `rows` is for bands of depths, or of both. Returns 0,
 * or 1: bad size, too little memory or damaged data. */
int room_open(room *out, int32_t width, int32_t height, int32_t rows, void *memory, size_t bytes, void *band,
              size_t band_bytes);

/* room_path: the pose of frame 0 .. ROOM_FRAMES - 1; others wrap. room_steer: applies one frame of held
 * buttons, and stays in the room. */
void room_path(room_pose *out, int32_t frame);
void room_steer(room_pose *inout, uint32_t buttons);

/* Stages exclude the time of `put`; if you want it counted, add it to taken[ROOM_SHOW]. `format`: one of 16
 * bits from lambent/fixed.h. */
void room_see(room *r, const room_pose *pose);
void room_put_bands(room *r, room_put *put, void *user);
void room_draw_on(room *r, int32_t format, room_rows *rows);

/* room_frame_hash: of the last frame begun; draws extra bands, and their time is not counted. */
uint32_t room_frame_hash(room *r);

/* room_hash: FNV-1a of 32 bits over R, G, B of each pixel; begin with ROOM_HASH, then pass the last result. */
#define ROOM_HASH 2166136261u
uint32_t room_hash(uint32_t hash, const uint32_t *rgb, int32_t count);

/* A row, dithered by Bayer's 4 x 4 matrix t of 0 .. 15 by x & 3 and y & 3, each quotient rounded down.
 * room_rgb555: red in the low bits, the code c of 0 .. 255 becomes (min(c, 248) + t / 2) / 8, as in lambent/fixed.h.
 * room_rgb565: red in the high bits, (c - c / 32 + t / 2) / 8, and green (c - c / 64 + t / 4) / 4. */
void room_rgb555(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y);
void room_rgb565(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y);

#endif
