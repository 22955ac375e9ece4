/* pack_buffer.c: a growing byte array, appended to in words. */
#include <stdlib.h>
#include <string.h>

#include "pack.h"

enum { FIRST = 4096 };

void pack_put(pack_buffer *to, const void *data, size_t size)
{
    const size_t whole = (size + 3) / 4 * 4;
    size_t cap = to->cap > 0 ? to->cap : FIRST;
    uint8_t *grown;
    while (cap - to->size < whole && cap < SIZE_MAX / 4) {
        cap *= 2;
    }
    if (to->is_short || cap - to->size < whole || to->size + whole > UINT32_MAX / 2) {
        to->is_short = 1;
        return;
    }
    if (cap > to->cap) {
        grown = realloc(to->data, cap);
        if (grown == NULL) {
            to->is_short = 1;
            return;
        }
        to->data = grown;
        to->cap = cap;
    }
    if (size > 0) {
        memcpy(to->data + to->size, data, size);
        memset(to->data + to->size + size, 0, whole - size);
    }
    to->size += whole;
}

void pack_word(pack_buffer *to, uint32_t word) { pack_put(to, &word, sizeof word); }

void pack_float(pack_buffer *to, float v)
{
    v = v == 0.0f ? 0.0f : v; /* -0 becomes 0 */
    pack_put(to, &v, sizeof v);
}

void pack_vec(pack_buffer *to, lmb_vec3 v)
{
    pack_float(to, v.x);
    pack_float(to, v.y);
    pack_float(to, v.z);
}

void pack_words(pack_buffer *to, int count, uint32_t word)
{
    for (int i = 0; i < count; ++i) {
        pack_word(to, word);
    }
}

uint32_t pack_place(const pack_buffer *part) { return (uint32_t)part->size + 4; }
