/* room.c: a stand-in with the room's interface, to bring ports up with. */
#include "room.h"

size_t room_bytes(int32_t width, int32_t height)
{
    return width > 0 && height > 0 && width <= ROOM_MAX_WIDTH && height <= ROOM_MAX_HEIGHT ? 4 : 0;
}

size_t room_band_bytes(int32_t width, int32_t rows) { return width > 0 && rows > 0 ? (size_t)(width * rows) * 6 : 0; }

int room_open(room *out, int32_t width, int32_t height, int32_t rows, void *memory, size_t bytes, void *band,
              size_t band_bytes)
{
    static const room nothing;
    *out = nothing;
    if (room_bytes(width, height) == 0 || rows < 1 || bytes < room_bytes(width, height) ||
        band_bytes < room_band_bytes(width, rows))
        return 1;
    out->width = width, out->height = height, out->rows = rows;
    out->memory = memory, out->band = band;
    out->memory_bytes = bytes, out->band_bytes = band_bytes;
    return 0;
}

void room_path(room_pose *out, int32_t frame)
{
    static const room_pose start = {{0, 1454, 2764}, 0, 0, {0, 2048, 0}};
    *out = start;
    out->yaw = frame * 100;
    out->lamp[0] = (frame - 30) * 20;
}

void room_steer(room_pose *inout, uint32_t buttons)
{
    inout->yaw += (int32_t)(buttons & 1u) * 512 - (int32_t)(buttons >> 1 & 1u) * 512;
    inout->pitch += (int32_t)(buttons >> 2 & 1u) * 512 - (int32_t)(buttons >> 3 & 1u) * 512;
    inout->lamp[0] += (int32_t)(buttons >> 5 & 1u) * 64 - (int32_t)(buttons >> 4 & 1u) * 64;
    inout->lamp[2] += (int32_t)(buttons >> 6 & 1u) * 64 - (int32_t)(buttons >> 7 & 1u) * 64;
}

void room_draw(room *r, const room_pose *pose, room_put *put, void *user)
{
    uint32_t *pixel = r->band;
    const uint32_t from = r->clock ? r->clock() : 0;
    for (int32_t y = 0; y < r->height; y += r->rows) {
        const int32_t rows = r->rows < r->height - y ? r->rows : r->height - y;
        for (int32_t i = 0; i < rows * r->width; ++i) {
            const int32_t x = i % r->width, row = y + i / r->width;
            const uint32_t red = (uint32_t)(x * 255 / r->width), green = (uint32_t)(row * 255 / r->height);
            const int32_t at = r->width / 2 + pose->lamp[0] * r->width / 2048;
            pixel[i] = red << 16 | green << 8 | (x > at - 8 && x < at + 8 ? 255u : (uint32_t)(pose->yaw >> 6 & 255));
        }
        put(user, pixel, r->width, y, rows);
    }
    r->taken[ROOM_FILL] = r->clock ? r->clock() - from : 0;
}

uint32_t room_hash(uint32_t hash, const uint32_t *rgb, int32_t count)
{
    for (int32_t i = 0; i < count; ++i)
        for (int shift = 16; shift >= 0; shift -= 8)
            hash = (hash ^ (rgb[i] >> shift & 255u)) * 16777619u;
    return hash;
}

static const uint8_t bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

static uint32_t dithered(uint32_t code, uint32_t most, uint32_t t) { return (code * most * 16 + t * 255 + 127) / 4080; }

void room_rgb555(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y)
{
    for (int32_t x = 0; x < width; ++x) {
        const uint32_t t = bayer[y & 3][x & 3], c = rgb[x];
        out[x] = (uint16_t)(dithered(c >> 16 & 255u, 31, t) | dithered(c >> 8 & 255u, 31, t) << 5 |
                            dithered(c & 255u, 31, t) << 10);
    }
}

void room_rgb565(uint16_t *out, const uint32_t *rgb, int32_t width, int32_t y)
{
    for (int32_t x = 0; x < width; ++x) {
        const uint32_t t = bayer[y & 3][x & 3], c = rgb[x];
        out[x] = (uint16_t)(dithered(c >> 16 & 255u, 31, t) << 11 | dithered(c >> 8 & 255u, 63, t) << 5 |
                            dithered(c & 255u, 31, t));
    }
}
