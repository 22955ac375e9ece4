/* nds_image.c: a .nds cartridge image of the main processor's program: nds_image PROGRAM.bin OUT.nds. The second
 * processor gets an endless loop. The header has no logo. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEADER = 0x4000, /* bytes */
    MAIN = 0x02000000,
    SECOND = 0x023f0000,
    SECTOR = 512,
    MOST = 0x3f0000, /* of a program, bytes */
    LEAST_SHIFT = 17 /* images have 2^17 bytes or a larger power of two */
};

static void put(uint8_t *to, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i)
        to[i] = (uint8_t)(value >> 8 * i);
}

static uint32_t crc16(const uint8_t *data, size_t bytes)
{
    uint32_t crc = 0xffff;
    for (size_t i = 0; i < bytes; ++i) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (crc & 1 ? 0xa001u : 0u);
    }
    return crc;
}

static int failed(const char *name, const char *why)
{
    fprintf(stderr, "nds_image: %s: %s\n", name, why);
    return 1;
}

int main(int count, char **words)
{
    if (count != 3) {
        fprintf(stderr, "usage: nds_image PROGRAM.bin OUT.nds\n");
        return 2;
    }
    FILE *in = fopen(words[1], "rb");
    uint8_t *image = calloc(1, (size_t)HEADER + MOST + 2 * SECTOR + ((size_t)8 << 20));
    if (in == NULL || image == NULL)
        return failed(words[1], "cannot be read");
    const size_t bytes = fread(image + HEADER, 1, MOST + 1, in);
    fclose(in);
    if (bytes == 0 || bytes > MOST)
        return failed(words[1], "empty, or larger than 3.9 MiB");
    const uint32_t size = (uint32_t)(bytes + 3) / 4 * 4, second = (HEADER + size + SECTOR - 1) / SECTOR * SECTOR;
    uint32_t shift = LEAST_SHIFT;
    while ((1u << shift) < second + SECTOR)
        ++shift;
    put(image + second, 0xeafffffeu, 4); /* b . */

    memcpy(image, "LAMBENT ROOM", 12);
    memcpy(image + 0x0c, "LMBE00", 6);
    image[0x14] = (uint8_t)(shift - LEAST_SHIFT);
    const uint32_t main_part[4] = {HEADER, MAIN, MAIN, size}, second_part[4] = {second, SECOND, SECOND, 4};
    for (int i = 0; i < 4; ++i) {
        put(image + 0x20 + 4 * i, main_part[i], 4); /* offset in the image, entry, address in memory, bytes */
        put(image + 0x30 + 4 * i, second_part[i], 4);
    }
    put(image + 0x80, second + 4, 4); /* used size */
    put(image + 0x84, HEADER, 4);
    put(image + 0x15c, crc16(image + 0xc0, 0x9c), 2); /* of the logo */
    put(image + 0x15e, crc16(image, 0x15e), 2);

    FILE *out = fopen(words[2], "wb");
    if (out == NULL)
        return failed(words[2], "cannot be written");
    const size_t written = fwrite(image, 1, (size_t)1 << shift, out);
    if (fclose(out) != 0 || written != (size_t)1 << shift) {
        remove(words[2]);
        return failed(words[2], "cannot be written");
    }
    free(image);
    return 0;
}
