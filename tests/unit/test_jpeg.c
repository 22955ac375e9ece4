/* test_jpeg.c: JPEG pictures: every kind against another decoder's pixels, refusals, and damaged files. */
#include "../test.h"

#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/io_jpeg.h"

#include "jpeg_samples.inc"

void test_jpeg(void);

typedef struct sample {
    const char *name;
    const uint8_t *jpeg;
    size_t size;
    int32_t width, height, channels;
    const uint8_t *pixels;
} sample;

#define SAMPLE(name, width, height, channels) \
    {#name, name##_jpeg, sizeof name##_jpeg, width, height, channels, name##_pixels}

static const sample samples[] = {
    SAMPLE(baseline_420, 17, 13, 3),
    SAMPLE(baseline_444, 17, 13, 3),
    SAMPLE(baseline_422, 19, 9, 3),
    SAMPLE(baseline_440, 9, 19, 3),
    SAMPLE(baseline_411, 35, 5, 3),
    SAMPLE(chroma_wider, 11, 11, 3),
    SAMPLE(grey, 17, 13, 1),
    SAMPLE(one_pixel, 1, 1, 3),
    SAMPLE(narrow, 3, 18, 3),
    SAMPLE(rgb, 10, 7, 3),
    SAMPLE(coarse_16_bit, 17, 13, 3),
    SAMPLE(three_scans, 17, 13, 3),
    SAMPLE(restarts, 33, 17, 3),
    SAMPLE(progressive_420, 33, 17, 3),
    SAMPLE(progressive_444, 17, 13, 3),
    SAMPLE(progressive_restarts, 17, 13, 3),
    SAMPLE(progressive_grey, 17, 13, 1),
    SAMPLE(cmyk, 11, 7, 3),
    SAMPLE(ycck_progressive, 13, 9, 3),
};
enum { SAMPLES = sizeof samples / sizeof samples[0], SAMPLE_MAX = 2048 };

/* --- one file --- */

/* Decodes an exactly sized copy, so that a sanitizer detects the first byte read past the end. */
static int decode_copy(bitmap *map, const uint8_t *data, size_t size, report *r)
{
    uint8_t *copy = malloc(size > 0 ? size : 1);
    int ok = 0;
    r->text[0] = '\0';
    if (!copy) report_fail(r, "out of memory");
    if (copy) {
        memcpy(copy, data, size);
        ok = jpeg_decode(map, copy, size, "j", r);
    }
    free(copy);
    return ok;
}

/* Returns 1 for a picture, 0 for a message without a picture, 2 for anything else. */
static int ends_cleanly(const uint8_t *data, size_t size)
{
    bitmap map;
    report r;
    int ok;
    memset(&map, 0, sizeof map);
    ok = decode_copy(&map, data, size, &r);
    if (ok != (r.text[0] == '\0') || ok != (map.texels != NULL) || ok != (map.width > 0 && map.height > 0)) ok = 2;
    bitmap_free(&map);
    return ok;
}

/* --- pixels --- */

static int difference(const sample *s, const bitmap *map)
{
    int32_t i, k, max = 0;
    for (i = 0; i < s->width * s->height; ++i) {
        for (k = 0; k < 3; ++k) {
            int32_t expected = s->pixels[s->channels * i + (s->channels == 1 ? 0 : k)];
            int32_t d = abs(map->texels[4 * i + k] - expected);
            if (d > max) max = d;
        }
        if (map->texels[4 * i + 3] != 255) return 256;
    }
    return max;
}

static void check_pixels(const sample *s)
{
    bitmap map;
    report r;
    int ok = decode_copy(&map, s->jpeg, s->size, &r);
    CHECK_MSG(ok, "%s: %s", s->name, r.text);
    if (!ok) return;
    CHECK_MSG(map.width == s->width && map.height == s->height, "%s: %dx%d", s->name, (int)map.width, (int)map.height);
    if (map.width == s->width && map.height == s->height)
        CHECK_MSG(difference(s, &map) <= 1, "%s: off by %d", s->name, difference(s, &map));
    bitmap_free(&map);
}

/* Four components are CMYK with Adobe's transform 0 or without Adobe's marker, otherwise YCCK: 1 acts as 2. In both,
 * 255 is no ink. */
static void check_inks(const sample *s)
{
    enum { MARKER = 2, TRANSFORM = 17, AFTER = 18 };
    uint8_t copy[SAMPLE_MAX];
    bitmap plain = {0}, map = {0}, ycck = {0};
    report r;
    const size_t texels = 4 * (size_t)s->width * (size_t)s->height;
    int ok = s->jpeg[MARKER + 1] == 0xEE && s->jpeg[TRANSFORM] == 0 && decode_copy(&plain, s->jpeg, s->size, &r);
    memcpy(copy, s->jpeg, MARKER);
    memcpy(copy + MARKER, s->jpeg + AFTER, s->size - AFTER);
    ok = ok && decode_copy(&map, copy, s->size - (AFTER - MARKER), &r);
    CHECK(ok && memcmp(map.texels, plain.texels, texels) == 0);
    bitmap_free(&map);
    memcpy(copy, s->jpeg, s->size);
    copy[TRANSFORM] = 2;
    ok = ok && decode_copy(&ycck, copy, s->size, &r);
    CHECK(ok && memcmp(ycck.texels, plain.texels, texels) != 0);
    copy[TRANSFORM] = 1;
    CHECK(ok && decode_copy(&map, copy, s->size, &r) && memcmp(map.texels, ycck.texels, texels) == 0);
    bitmap_free(&map);
    bitmap_free(&ycck);
    bitmap_free(&plain);
}

/* --- damage --- */

static void check_prefixes(const sample *s)
{
    size_t n;
    int wrong = 0;
    for (n = 0; n < s->size; ++n) wrong += ends_cleanly(s->jpeg, n) != 0;
    CHECK_MSG(wrong == 0, "%s: %d prefixes", s->name, wrong);
}

/* For each byte: flips all bits, and one bit. */
static void check_flips(const sample *s)
{
    uint8_t copy[SAMPLE_MAX];
    size_t i;
    int wrong = 0;
    memcpy(copy, s->jpeg, s->size);
    for (i = 0; i < s->size; ++i) {
        copy[i] ^= 0xFF;
        wrong += ends_cleanly(copy, s->size) == 2;
        copy[i] ^= (uint8_t)(0xFFu ^ 1u << i % 8);
        wrong += ends_cleanly(copy, s->size) == 2;
        copy[i] = s->jpeg[i];
    }
    CHECK_MSG(wrong == 0, "%s: %d flips", s->name, wrong);
}

/* --- not as it should be, though it can be read --- */

/* A grey block with details that end in a run of two or three empty blocks, although there is only one block. */
static void check_long_run(void)
{
    static const uint8_t head[] = {0xFF, 0xD8, 0xFF, 0xDB, 0, 67, 0},
                         rest[] = {0xFF, 0xC2, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0, /* 8 x 8, progressive */
                                   0xFF, 0xC4, 0, 20, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                   0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 0, 0, 0x7F, /* a mean of 128 */
                                   0xFF, 0xC4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x10,
                                   0xFF, 0xDA, 0, 8, 1, 1, 0, 1, 63, 0, 0x3F, 0xFF, 0xD9};
    uint8_t file[sizeof head + 64 + sizeof rest];
    bitmap map;
    report r;
    memcpy(file, head, sizeof head);
    memset(file + sizeof head, 1, 64);
    memcpy(file + sizeof head + 64, rest, sizeof rest);
    const int ok = decode_copy(&map, file, sizeof file, &r);
    CHECK_MSG(ok, "%s", r.text);
    if (ok) {
        CHECK(map.note != NULL && strstr(map.note, "empty blocks run past") != NULL);
        CHECK(map.texels[0] == 128 && map.texels[4 * 63 + 2] == 128);
        bitmap_free(&map);
    }
    CHECK(decode_copy(&map, samples[0].jpeg, samples[0].size, &r) && map.note == NULL);
    bitmap_free(&map);
}

/* The first sample with an Exif segment in front: two entries, the second of which is `tag` with `value`. `cut` bytes
 * of the segment's end are missing. Returns whether the orientation is noted. */
static int is_turned(int is_big, uint32_t tag, uint32_t value, size_t cut)
{
    static uint8_t file[1 << 14];
    uint8_t exif[10 + 8 + 2 + 24] = {0xFF, 0xE1, 0, 0, 'E', 'x', 'i', 'f', 0, 0};
    const uint32_t number[][3] = {{2, 42, 2},   {4, 8, 4},  {8, 2, 2},  {10, 0x100, 2},
                                  {22, tag, 2}, {24, 3, 2}, {26, 1, 4}, {30, value, 2}}; /* offset, number, bytes */
    const size_t size = sizeof exif - cut, rest = samples[0].size - 2;
    bitmap map;
    report r;
    exif[3] = (uint8_t)(size - 2);
    exif[10] = exif[11] = is_big ? 'M' : 'I';
    for (size_t i = 0; i < sizeof number / sizeof *number; ++i)
        for (uint32_t k = 0; k < number[i][2]; ++k)
            exif[10 + number[i][0] + k] = (uint8_t)(number[i][1] >> 8 * (is_big ? number[i][2] - 1 - k : k));
    memcpy(file, samples[0].jpeg, 2);
    memcpy(file + 2, exif, size);
    memcpy(file + 2 + size, samples[0].jpeg + 2, rest);
    if (!decode_copy(&map, file, 2 + size + rest, &r)) {
        CHECK_MSG(0, "%s", r.text);
        return 0;
    }
    const int is_noted = map.note != NULL && strstr(map.note, "Exif orientation") != NULL;
    bitmap_free(&map);
    return is_noted;
}

static void check_orientation(void)
{
    for (int is_big = 0; is_big < 2; ++is_big) {
        CHECK(is_turned(is_big, 0x112, 6, 0) && is_turned(is_big, 0x112, 8, 0) && is_turned(is_big, 0x112, 2, 0));
        CHECK(!is_turned(is_big, 0x112, 1, 0) && !is_turned(is_big, 0x112, 9, 0) && !is_turned(is_big, 0x113, 6, 0));
        for (size_t cut = 5; cut < 40; ++cut)
            CHECK(!is_turned(is_big, 0x112, 6, cut));
    }
}

/* --- refusals --- */

/* Offset of the first marker of this kind. */
static size_t find(const sample *s, int marker)
{
    size_t i = 0;
    while (i + 2 < s->size && (s->jpeg[i] != 0xFF || s->jpeg[i + 1] != marker)) ++i;
    return i;
}

/* If the byte at `at` behind a marker is replaced, s is refused with these words. */
static void refuses(const sample *s, int marker, size_t at, int value, const char *words)
{
    uint8_t copy[SAMPLE_MAX];
    bitmap map;
    report r;
    int ok;
    memcpy(copy, s->jpeg, s->size);
    copy[find(s, marker) + at] = (uint8_t)value;
    ok = decode_copy(&map, copy, s->size, &r);
    CHECK_MSG(!ok && strstr(r.text, words), "%s: %s", words, r.text);
    if (ok) bitmap_free(&map);
}

enum { FRAME = 0xC0, CODES = 0xC4, SCAN = 0xDA, QUANTIZERS = 0xDB, RESTART = 0xD0 };

static void check_methods(void)
{
    const sample *s = &samples[0];
    refuses(s, FRAME, 1, 0xC3, "lossless");
    refuses(s, FRAME, 1, 0xC5, "hierarchical");
    refuses(s, FRAME, 1, 0xC9, "arithmetic-coded");
    refuses(s, FRAME, 1, 0xCA, "arithmetic-coded");
    refuses(s, FRAME, 1, 0xC8, "extension");
    refuses(s, FRAME, 4, 12, "12 bits a sample are not read");
    refuses(s, FRAME, 6, 0, "height is not in the header");
    refuses(s, FRAME, 5, 0xFF, "cannot fill 17 x 65293 pixels");
    refuses(s, FRAME, 9, 1, "cannot hold 15 bytes");
    refuses(s, FRAME, 11, 0x32, "sampling factor 3");
    refuses(s, FRAME, 11, 0x52, "a sampling factor or a table does not exist");
    refuses(s, FRAME, 11, 0x44, "more than 10 blocks in turn");
    refuses(s, 0xD8, 1, 0xD9, "not a JPEG file");
}

static void check_structure(void)
{
    const sample *s = &samples[0], *progressive = &samples[13], *restarts = &samples[12];
    refuses(s, QUANTIZERS, 5, 0, "a quantizer is 0");
    refuses(s, QUANTIZERS, 4, 4, "no such quantization table");
    refuses(s, CODES, 4, 0x20, "no such Huffman table");
    refuses(s, SCAN, 5, 9, "a component that the frame has not");
    refuses(s, SCAN, 7, 1, "one component twice");
    refuses(s, SCAN, 6, 0x33, "its Huffman table is not there");
    refuses(s, SCAN, 11, 1, "no such part of a picture");
    refuses(s, SCAN, 1, 0xDC, "a height (DNL)");
    refuses(restarts, RESTART, 1, 0xD1, "no restart marker 0 at byte");
    refuses(progressive, SCAN, 13, 0x21, "lacks the one before it");
}

/* A frame header of two components with a correct length; and a Huffman code with three symbols of one bit. */
static void check_made(void)
{
    static const uint8_t two[] = {0xFF, 0xD8, 0xFF, 0xC0, 0, 14, 8, 0, 8, 0, 8, 2, 1, 0x11, 0, 2, 0x11, 0, 0xFF, 0xD9};
    static const uint8_t crowded[] = {0xFF, 0xD8, 0xFF, 0xC4, 0, 22, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                      0, 1, 2, 3, 0xFF, 0xD9};
    bitmap map;
    report r;
    CHECK(!decode_copy(&map, two, sizeof two, &r) && strstr(r.text, "2 components are not read; convert it to grey"));
    CHECK(!decode_copy(&map, crowded, sizeof crowded, &r) && strstr(r.text, "more Huffman codes than"));
    CHECK(!decode_copy(&map, crowded, 2, &r) && strstr(r.text, "ends at byte 2, before EOI"));
}

/* Fill bytes before a marker, a comment, and bytes after the end are ignored. */
static void check_extras(void)
{
    static const uint8_t extra[] = {0xFF, 0xD8, 0xFF, 0xFF, 0xFF, 0xFE, 0, 5, 'a', 0xFF, 0xD9, 0xFF};
    const sample *s = &samples[1];
    uint8_t copy[SAMPLE_MAX];
    sample with = *s;
    memcpy(copy, extra, sizeof extra);
    memcpy(copy + sizeof extra, s->jpeg + 2, s->size - 2);
    copy[sizeof extra + s->size - 2] = 0;
    with.jpeg = copy;
    with.size = sizeof extra + s->size - 1;
    check_pixels(&with);
}

void test_jpeg(void)
{
    check_long_run();
    check_orientation();
    int i;
    for (i = 0; i < SAMPLES; ++i) {
        check_pixels(&samples[i]);
        check_prefixes(&samples[i]);
        check_flips(&samples[i]);
        if (strcmp(samples[i].name, "cmyk") == 0) check_inks(&samples[i]);
    }
    check_methods();
    check_structure();
    check_made();
    check_extras();
}
