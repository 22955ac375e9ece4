/* byte_buffer.c: a growing array of little-endian numbers. */
#include "byte_buffer.h"

#include <stdlib.h>
#include <string.h>

#include "io_bytes.h"

void byte_put(byte_buffer *b, const void *data, size_t size)
{
    if (size > b->cap - b->size && !b->is_short) {
        const size_t cap = 2 * b->cap + size + 4096;
        uint8_t *more = realloc(b->data, cap);
        b->is_short = more == NULL;
        b->data = more != NULL ? more : b->data;
        b->cap = more != NULL ? cap : b->cap;
    }
    if (!b->is_short && size > 0) {
        memcpy(b->data + b->size, data, size);
        b->size += size;
    }
}

void byte_put_int(byte_buffer *b, int32_t v)
{
    uint8_t bytes[4];
    put_u32_le(bytes, (uint32_t)v);
    byte_put(b, bytes, sizeof bytes);
}

void byte_put_long(byte_buffer *b, uint64_t v)
{
    byte_put_int(b, (int32_t)(uint32_t)v);
    byte_put_int(b, (int32_t)(uint32_t)(v >> 32));
}

void byte_put_float(byte_buffer *b, float v)
{
    int32_t bits;
    memcpy(&bits, &v, sizeof bits);
    byte_put_int(b, bits);
}

void byte_put_floats(byte_buffer *b, const float *v, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        byte_put_float(b, v[i]);
    }
}

void byte_put_double(byte_buffer *b, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    byte_put_long(b, bits);
}

const uint8_t *byte_get(byte_reader *s, size_t size)
{
    const uint8_t *at = s->at;
    if ((size_t)(s->end - at) < size) {
        s->is_short = 1;
        s->at = s->end;
        return NULL;
    }
    s->at += size;
    return at;
}

int32_t byte_get_int(byte_reader *s)
{
    const uint8_t *at = byte_get(s, 4);
    return at != NULL ? (int32_t)get_u32_le(at) : 0;
}

uint64_t byte_get_long(byte_reader *s)
{
    const uint64_t low = (uint32_t)byte_get_int(s);
    return low | (uint64_t)(uint32_t)byte_get_int(s) << 32;
}

float byte_get_float(byte_reader *s)
{
    const int32_t bits = byte_get_int(s);
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

void byte_get_floats(float *out, byte_reader *s, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        out[i] = byte_get_float(s);
    }
}

double byte_get_double(byte_reader *s)
{
    const uint64_t bits = byte_get_long(s);
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}
