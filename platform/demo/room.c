/* room.c: the demo of every port, with integers only: lmb_fixed with a path for lamp and camera. */
#include "room.h"

static const uint32_t baked[] = {
#include "room_data.inc"
};

enum {
    STEP = 512,         /* step of a held button: 1/65536 of a turn */
    LAMP_STEP = 32,     /* 1/1024 m */
    STEEPEST = 8192,    /* limit of pitch */
    LAMP = 2 * LMB_FIXED_WHITE
};

/* The walls of the room are at x = -2 .. 2 m, y = 0 .. 2.75, z = -2 .. 2.75. */
static const int32_t lamp_low[3] = {-1900, 200, -1900}, lamp_high[3] = {1900, 2700, 2700};

/* A quarter wave in sixteen steps, in 1/16384. */
static const int16_t quarter[17] = {0,     1606,  3196,  4756,  6270,  7723,  9102,  10394, 11585,
                                    12665, 13623, 14449, 15137, 15679, 16069, 16305, 16384};

/* Sine of an angle in 1/65536 of a turn. */
static int32_t sine(int32_t angle)
{
    const int32_t at = angle & 0x3fff, is_second = angle >> 14 & 1, x = is_second ? 0x4000 - at : at, i = x >> 10;
    const int32_t v = i == 16 ? quarter[16] : quarter[i] + (((quarter[i + 1] - quarter[i]) * (x & 1023)) >> 10);
    return angle >> 15 & 1 ? -v : v;
}

static int32_t cosine(int32_t angle) { return sine(angle + 0x4000); }

size_t room_bytes(int32_t width, int32_t height)
{
    lmb_fixed scene;
    return width > 0 && height > 0 && width <= ROOM_MAX_WIDTH && height <= ROOM_MAX_HEIGHT &&
                   lmb_fixed_open(&scene, baked, sizeof baked) == LMB_OK
               ? (lmb_fixed_memory(&scene, scene.triangles) + 3) / 4 * 4
               : 0;
}

size_t room_bytes_kept(int32_t width, int32_t height)
{
    const size_t bytes = room_bytes(width, height);
    return bytes > 0 ? bytes + ROOM_KEPT * sizeof(lmb_fixed_ready) : 0;
}

int room_open(room *out, int32_t width, int32_t height, int32_t rows, void *memory, size_t bytes, void *band,
              size_t band_bytes)
{
    static const room nothing;
    *out = nothing;
    if (width < 1 || height < 1 || width > ROOM_MAX_WIDTH || height > ROOM_MAX_HEIGHT || rows < 1 || band == NULL ||
        band_bytes < (size_t)ROOM_DEPTH_BYTES(width, rows) ||
        lmb_fixed_open(&out->scene, baked, sizeof baked) != LMB_OK ||
        lmb_fixed_lay(&out->frame, &out->scene, out->scene.triangles, memory, bytes) != LMB_OK)
        return 1;
    const size_t needed = room_bytes(width, height), kept = (bytes - needed) / sizeof(lmb_fixed_ready);
    if (bytes > needed && kept > 0) {
        out->frame.ready = (lmb_fixed_ready *)(void *)((unsigned char *)memory + needed);
        out->frame.ready_cap = kept < ROOM_KEPT ? (uint32_t)kept : ROOM_KEPT;
    }
    out->width = width, out->height = height;
    out->rows = out->put_rows = rows;
    while (band_bytes < (size_t)ROOM_BAND_BYTES(width, out->put_rows))
        --out->put_rows;
    out->memory = memory, out->band = band;
    out->memory_bytes = bytes, out->band_bytes = band_bytes;
    out->frame.view.width = width, out->frame.view.height = height;
    out->frame.view.focal = (height * 4392) >> 8; /* 8 / tan(25 degrees): 50 degrees from top to bottom */
    out->frame.view.near_units = 128;
    out->frame.background = LMB_FIXED_COVERED; /* the room is closed */
    out->frame.bounces = 2;
    for (int i = 0; i < 3; ++i)
        out->frame.lamp.intensity[i] = LAMP;
    return 0;
}

void room_path(room_pose *out, int32_t frame)
{
    const int32_t n = frame % ROOM_FRAMES, turn = (n < 0 ? n + ROOM_FRAMES : n) * 65536 / ROOM_FRAMES;
    out->eye[0] = (sine(turn) * 900) >> 14;
    out->eye[1] = 1450 + ((sine(2 * turn) * 120) >> 14);
    out->eye[2] = 2350 + ((cosine(turn) * 250) >> 14);
    out->yaw = (sine(turn) * 2600) >> 14;
    out->pitch = -900;
    out->lamp[0] = (cosine(turn + 8192) * 1250) >> 14;
    out->lamp[1] = 2050 + ((sine(turn) * 350) >> 14);
    out->lamp[2] = 500 + ((sine(turn + 8192) * 1300) >> 14);
}

static int32_t within(int32_t v, int32_t low, int32_t high) { return v < low ? low : v > high ? high : v; }

/* Converts to the blob's units. */
static void units_of(int32_t out[3], const lmb_fixed *s, const int32_t at[3])
{
    for (int i = 0; i < 3; ++i) {
        const int32_t up = s->units_log2 - 10;
        out[i] = (up > 0 ? at[i] * (1 << up) : at[i] >> -up) - s->origin[i];
    }
}

void room_steer(room_pose *inout, uint32_t buttons)
{
    const int32_t way[3] = {(int32_t)(buttons >> 5 & 1u) - (int32_t)(buttons >> 4 & 1u), 0,
                            (int32_t)(buttons >> 6 & 1u) - (int32_t)(buttons >> 7 & 1u)};
    inout->yaw += ((int32_t)(buttons & 1u) - (int32_t)(buttons >> 1 & 1u)) * STEP;
    inout->pitch += ((int32_t)(buttons >> 2 & 1u) - (int32_t)(buttons >> 3 & 1u)) * STEP;
    inout->pitch = within(inout->pitch, -STEEPEST, STEEPEST);
    for (int i = 0; i < 3; ++i)
        inout->lamp[i] = within(inout->lamp[i] + way[i] * LAMP_STEP, lamp_low[i], lamp_high[i]);
}

/* Turns about y by yaw, then about the camera's x by pitch. */
static void set_view(lmb_fixed_view *v, const lmb_fixed *s, const room_pose *pose)
{
    const int32_t sy = sine(pose->yaw), cy = cosine(pose->yaw), sp = sine(pose->pitch), cp = cosine(pose->pitch);
    units_of(v->eye, s, pose->eye);
    v->axis[0][0] = cy, v->axis[0][1] = 0, v->axis[0][2] = -sy;
    v->axis[1][0] = (sy * sp) >> 14, v->axis[1][1] = cp, v->axis[1][2] = (cy * sp) >> 14;
    v->axis[2][0] = (sy * cp) >> 14, v->axis[2][1] = -sp, v->axis[2][2] = (cy * cp) >> 14;
}

static uint32_t now(const room *r) { return r->clock ? r->clock() : 0; }

void room_see(room *r, const room_pose *pose)
{
    lmb_fixed_frame *f = &r->frame;
    set_view(&f->view, &r->scene, pose);
    units_of(f->lamp.position, &r->scene, pose->lamp);
    const uint32_t begun = now(r);
    lmb_fixed_transform(f);
    const uint32_t seen = now(r);
    lmb_fixed_light(f);
    const uint32_t lit = now(r);
    lmb_fixed_prepare(f);
    r->taken[ROOM_TRANSFORM] = seen - begun, r->taken[ROOM_LIGHT] = lit - seen, r->taken[ROOM_FILL] = now(r) - lit;
    r->taken[ROOM_SHOW] = 0;
}

static int32_t draw_band(room *r, int32_t y, int32_t cap)
{
    const int32_t rows = cap < r->height - y ? cap : r->height - y;
    const uint32_t from = now(r);
    lmb_fixed_band(&r->frame, y, y + rows);
    r->taken[ROOM_FILL] += now(r) - from;
    return rows;
}

void room_put_bands(room *r, room_put *put, void *user)
{
    lmb_fixed_frame *f = &r->frame;
    f->format = LMB_FIXED_RGB888;
    f->pixel = r->band;
    f->depth = (uint16_t *)(f->pixel + r->width * r->put_rows);
    for (int32_t y = 0, rows; y < r->height; y += rows) {
        rows = draw_band(r, y, r->put_rows);
        put(user, f->pixel, r->width, y, rows);
    }
}

void room_draw_on(room *r, int32_t format, room_rows *rows)
{
    lmb_fixed_frame *f = &r->frame;
    f->format = format;
    f->depth = r->band;
    for (int32_t y = 0; y < r->height; y += r->rows) {
        f->pixel_16 = rows(y);
        draw_band(r, y, r->rows);
    }
}

static void add_hash(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    uint32_t *hash = user;
    (void)y;
    *hash = room_hash(*hash, rgb, width * rows);
}

uint32_t room_frame_hash(room *r)
{
    uint32_t hash = ROOM_HASH, (*const clock)(void) = r->clock;
    r->clock = NULL;
    room_put_bands(r, add_hash, &hash);
    r->clock = clock;
    return hash;
}

uint32_t room_hash(uint32_t hash, const uint32_t *rgb, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
        for (int shift = 16; shift >= 0; shift -= 8)
            hash = (hash ^ (rgb[i] >> shift & 255u)) * 16777619u;
    return hash;
}

static uint32_t threshold(int32_t x, int32_t y)
{
    static const uint8_t bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    return bayer[y & 3][x & 3];
}

static uint32_t level(uint32_t rgb, int shift, uint32_t step)
{
    const uint32_t c = rgb >> shift & 255u;
    return ((c > 248 ? 248 : c) + step) >> 3;
}

void room_rgb555(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y)
{
    for (int32_t x = 0; x < width; ++x) {
        const uint32_t step = threshold(x, y) / 2;
        out[x] = (uint16_t)(level(rgb[x], 16, step) | level(rgb[x], 8, step) << 5 | level(rgb[x], 0, step) << 10);
    }
}

/* All three colours at once: c - c / 32 + t / 2, and for green c - c / 64 + t / 4, are at most 255. */
static inline uint16_t pixel_565(uint32_t rgb, uint32_t steps)
{
    const uint32_t v = rgb - ((rgb >> 5 & 0x070007u) | (rgb >> 6 & 0x000300u)) + steps;
    return (uint16_t)((v >> 8 & 0xf800u) | (v >> 5 & 0x7e0u) | (v >> 3 & 31u));
}

void room_rgb565(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y)
{
    uint32_t steps[4];
    for (int32_t x = 0; x < 4; ++x)
        steps[x] = (threshold(x, y) >> 1) * 0x010001u + ((threshold(x, y) >> 2) << 8);
    const uint32_t s0 = steps[0], s1 = steps[1], s2 = steps[2], s3 = steps[3];
    for (; width >= 4; width -= 4, out += 4, rgb += 4) {
        out[0] = pixel_565(rgb[0], s0), out[1] = pixel_565(rgb[1], s1);
        out[2] = pixel_565(rgb[2], s2), out[3] = pixel_565(rgb[3], s3);
    }
    for (int32_t x = 0; x < width; ++x)
        out[x] = pixel_565(rgb[x], steps[x]);
}
