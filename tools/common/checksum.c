/* checksum.c: the checksum of .lmp, .lmr and .lmt files. */
#include "checksum.h"

#define BASIS UINT32_C(0x811c9dc5) /* of FNV-1a */
#define PRIME UINT32_C(0x01000193)

static uint32_t hash_bytes(uint32_t hash, const uint8_t *at, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        hash = (hash ^ at[i]) * PRIME;
    }
    return hash;
}

static uint32_t checksum_of(const uint8_t *data, size_t size, size_t header)
{
    const uint32_t hash = hash_bytes(hash_bytes(BASIS, data, header - 4), data + header, size - header);
    return hash != 0 ? hash : 1;
}

/* Word 1 of all three is 0x01020304. */
static uint32_t word_of(const uint8_t *data, size_t at)
{
    const uint8_t *b = data + at;
    return data[4] == 1 ? (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3]
                        : (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
}

void checksum_put(file_bytes *inout, int words)
{
    const size_t header = 4 * (size_t)words;
    const uint32_t sum = checksum_of(inout->data, inout->size, header);
    for (int i = 0; i < 4; ++i) {
        inout->data[header - 4 + (size_t)i] = (uint8_t)(sum >> 8 * (inout->data[4] == 1 ? 3 - i : i));
    }
}

int checksum_fits(const uint8_t *data, size_t size, int words)
{
    const size_t header = 4 * (size_t)words;
    const uint32_t told = size >= header ? word_of(data, header - 4) : 0, bytes = size >= header ? word_of(data, 8) : 0;
    return told == 0 || bytes < header || bytes > size || told == checksum_of(data, bytes, header);
}
