/* blob.h: little-endian bytes under construction, and base64 of them, for the files that tests make. */
#ifndef BLOB_H
#define BLOB_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct blob {
    uint8_t bytes[2048];
    size_t size;
} blob;

static inline void put_u8(blob *b, uint32_t v) { b->bytes[b->size++] = (uint8_t)v; }

static inline void put_u16(blob *b, uint32_t v)
{
    put_u8(b, v & 255);
    put_u8(b, v >> 8 & 255);
}

static inline void put_u32(blob *b, uint32_t v)
{
    put_u16(b, v & 65535);
    put_u16(b, v >> 16);
}

static inline void put_f32(blob *b, float v)
{
    uint32_t bits;
    memcpy(&bits, &v, 4);
    put_u32(b, bits);
}

static inline void put_floats(blob *b, const float *v, int n)
{
    while (n-- > 0)
        put_f32(b, *v++);
}

/* Of at most 3,000 bytes; stays until the next call. */
static inline const char *base64(const uint8_t *data, size_t n)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static char out[4096];
    size_t i, o = 0;
    for (i = 0; i < n; i += 3) {
        uint32_t v =
            (uint32_t)data[i] << 16 | (i + 1 < n ? (uint32_t)data[i + 1] << 8 : 0) | (i + 2 < n ? data[i + 2] : 0u);
        out[o++] = digit[v >> 18];
        out[o++] = digit[v >> 12 & 63];
        out[o++] = i + 1 < n ? digit[v >> 6 & 63] : '=';
        out[o++] = i + 2 < n ? digit[v & 63] : '=';
    }
    out[o] = '\0';
    return out;
}

#endif
