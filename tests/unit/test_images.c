/* test_images.c: picture files: written files read back, every kind of PNG, and damaged files. */
#if !defined(_WIN32) && !defined(_XOPEN_SOURCE)
#define _XOPEN_SOURCE 700 /* directory and link functions */
#endif
#include "../test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/image.h"
#include "../../tools/picture/io_pam.h"
#include "../../tools/picture/io_ppm_read.h"
#include "../../tools/picture/picture_read.h"

#ifndef _WIN32
#include <dirent.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

void test_images(void);

/* --- deflate and inflate --- */

/* Kinds of random data; each exercises another part of the packer. */
enum { NOISE, ZEROS, TWO_BYTES, SMOOTH, FEW_BITS, REPEATS, KINDS };

static void fill_kind(uint8_t *out, size_t n, int kind, test_rng *rng)
{
    size_t i, period = 1 + test_random(rng) % 40000;
    uint8_t level = 0;
    for (i = 0; i < n; ++i) {
        uint32_t v = test_random(rng);
        level = (uint8_t)(level + v % 3 - 1);
        switch (kind) {
        case NOISE: out[i] = (uint8_t)(v >> 8); break;
        case ZEROS: out[i] = 0; break;
        case TWO_BYTES: out[i] = v & 64 ? 'a' : 'b'; break;
        case SMOOTH: out[i] = level; break;
        case FEW_BITS: out[i] = (uint8_t)(v & (v >> 8) & (v >> 16)); break;
        default: out[i] = i < period ? (uint8_t)v : out[i - period]; break;
        }
    }
}

static int survives_deflate(const uint8_t *in, size_t n)
{
    uint8_t *packed, *back = malloc(n + 1);
    size_t size;
    int same = 0;
    if (back && deflate_zlib(&packed, &size, in, n)) {
        same = inflate_zlib(back, n, packed, size) && memcmp(back, in, n) == 0;
        same = same && !inflate_zlib(back, n + 1, packed, size) && !inflate_zlib(back, n, packed, size - 1);
        same = same && (n == 0 || !inflate_zlib(back, n - 1, packed, size));
        same = same && size <= n + n / 1000 + 64; /* noise is stored with little overhead */
        free(packed);
    }
    free(back);
    return same;
}

static void check_deflate(test_rng *rng)
{
    static const size_t sizes[] = {0, 1, 2, 3, 4, 258, 259, 16384, 16385, 32768, 32769, 65535, 65536, 131071, 200000};
    size_t i;
    uint8_t *data = malloc(200000);
    int kind;
    CHECK(data != NULL);
    for (kind = 0; data && kind < KINDS; ++kind) {
        for (i = 0; i < sizeof sizes / sizeof sizes[0] + 10; ++i) {
            size_t n = i < sizeof sizes / sizeof sizes[0] ? sizes[i] : test_random(rng) % 50000;
            fill_kind(data, n, kind, rng);
            CHECK_MSG(survives_deflate(data, n), "kind %d, %d bytes", kind, (int)n);
        }
    }
    free(data);
}

static uint32_t adler_bytewise(const uint8_t *p, size_t n)
{
    uint32_t a = 1, b = 0;
    for (; n > 0; --n, ++p) {
        a = (a + *p) % 65521u;
        b = (b + a) % 65521u;
    }
    return b << 16 | a;
}

/* A damaged stream is refused unless the checksum matches: Adler-32 is weak enough to miss a flipped bit now and
 * then. */
static void check_deflate_damage(test_rng *rng)
{
    uint8_t data[3000], back[3000], *packed;
    size_t size, i;
    int kind, k, wrong = 0, passed = 0;
    for (kind = 0; kind < KINDS; ++kind) {
        fill_kind(data, sizeof data, kind, rng);
        if (!deflate_zlib(&packed, &size, data, sizeof data)) continue;
        for (i = 0; i < 8 * size; i += 1 + test_random(rng) % 9) {
            uint32_t sum;
            packed[i / 8] ^= (uint8_t)(1u << i % 8);
            if (inflate_zlib(back, sizeof back, packed, size)) {
                ++passed;
                sum = adler_bytewise(back, sizeof back);
                for (k = 1; k <= 4; ++k, sum >>= 8) wrong += packed[size - (size_t)k] != (sum & 255u);
            }
            packed[i / 8] ^= (uint8_t)(1u << i % 8);
        }
        free(packed);
    }
    CHECK(wrong == 0);
    CHECK_MSG(passed < 50, "%d of some 15000", passed);
}

/* Streams of zlib 1.2: 300 bytes (i * i / 7) & 15, in a dynamic and in a fixed block. */
static void check_inflate_known(void)
{
    static const uint8_t dynamic[] = {
        0x78, 0xda, 0xe5, 0xcb, 0xcb, 0x0d, 0x00, 0x20, 0x08, 0x04, 0xd1, 0xe5, 0x17, 0xd9,
        0x40, 0xb0, 0xff, 0x6e, 0xd5, 0x3a, 0x9c, 0x77, 0x1e, 0x00, 0xa2, 0x16, 0x8b, 0x35,
        0xe2, 0xd9, 0x70, 0x8e, 0x71, 0x47, 0x29, 0x91, 0x17, 0xb5, 0x62, 0xd3, 0x86, 0x8e,
        0x4e, 0x97, 0x29, 0xae, 0x30, 0x15, 0xbc, 0xbe, 0xfb, 0x0e, 0x12, 0x4b, 0x06, 0xe8
    };
    static const uint8_t fixed[] = {0x78, 0x01, 0x63, 0x60, 0x60, 0x60, 0x64, 0x62, 0x66, 0x65, 0xe7, 0xe4, 0xe6,
                                    0x63, 0x64, 0xe1, 0xe0, 0x61, 0x60, 0xe1, 0xe4, 0x63, 0xe6, 0xe4, 0x67, 0xe5,
                                    0x66, 0xe2, 0x64, 0xe0, 0x00, 0x42, 0x4e, 0x26, 0x6e, 0x56, 0x7e, 0x4e, 0x66,
                                    0x3e, 0x4e, 0x16, 0x06, 0x1e, 0x0e, 0x16, 0x46, 0x3e, 0x6e, 0x4e, 0x76, 0x56,
                                    0x66, 0x26, 0x46, 0x06, 0x10, 0x18, 0x71, 0xfa, 0x00, 0x12, 0x4b, 0x06, 0xe8};
    uint8_t want[300], got[300];
    int i;
    for (i = 0; i < 300; ++i) want[i] = (uint8_t)(i * i / 7 & 15);
    CHECK(inflate_zlib(got, 300, dynamic, sizeof dynamic) && memcmp(got, want, 300) == 0);
    CHECK(inflate_zlib(got, 300, fixed, sizeof fixed) && memcmp(got, want, 300) == 0);
    for (i = 0; i < (int)sizeof dynamic; ++i) CHECK(!inflate_zlib(got, 300, dynamic, (size_t)i));
}

/* A zlib stream assembled bit by bit. */
typedef struct bit_stream {
    uint8_t data[512];
    size_t bits;
} bit_stream;

static void add_bits(bit_stream *s, uint32_t value, int n)
{
    for (; n > 0; --n, value >>= 1, ++s->bits) s->data[s->bits / 8] |= (uint8_t)((value & 1u) << s->bits % 8);
}

/* A code word, top bit first. */
static void add_word(bit_stream *s, uint32_t word, int n)
{
    while (n-- > 0) add_bits(s, word >> n, 1);
}

static void start(bit_stream *s, int type)
{
    memset(s, 0, sizeof *s);
    add_bits(s, 0x0178, 16);
    add_bits(s, 1, 1);
    add_bits(s, (uint32_t)type, 2);
}

/* Adds the checksum of `text` and returns whether the stream decodes to `text`. */
static int gives(bit_stream *s, const char *text)
{
    static uint8_t out[40000];
    size_t n = strlen(text), i;
    uint32_t sum = adler_bytewise((const uint8_t *)text, n);
    s->bits = (s->bits + 7) / 8 * 8;
    for (i = 0; i < 4; ++i) add_bits(s, sum >> (24 - 8 * i) & 255u, 8);
    return inflate_zlib(out, n, s->data, s->bits / 8) && memcmp(out, text, n) == 0;
}

/* The header of a dynamic block in which 'a' and symbol `second` have `bits` bits each, 1 or 2. In the meta code,
 * `bits` and 18 (a run of 11 zeros or more) have one bit each, with the words 0 and 1. */
static void start_tiny(bit_stream *s, int bits, uint32_t second, uint32_t dists)
{
    int i;
    start(s, 2);
    add_bits(s, 0, 5);
    add_bits(s, dists - 1, 5);
    add_bits(s, 18 - 4, 4);
    for (i = 0; i < 18; ++i) add_bits(s, i == 2 || i == (bits == 1 ? 17 : 15), 3);
    add_word(s, 1, 1), add_bits(s, 97 - 11, 7);
    add_word(s, 0, 1);
    add_word(s, 1, 1), add_bits(s, 127, 7);
    add_word(s, 1, 1), add_bits(s, second - 98 - 138 - 11, 7);
    add_word(s, 0, 1);
}

static void check_inflate_crafted(void)
{
    bit_stream s;

    start_tiny(&s, 1, 256, 1);
    add_word(&s, 0, 1);  /* a single distance code of one bit is valid */
    add_word(&s, 1, 3);  /* a, a, end */
    CHECK(gives(&s, "aa"));
    start_tiny(&s, 1, 255, 10); /* no code for the end */
    add_word(&s, 1, 1), add_bits(&s, 0, 7);
    add_word(&s, 3, 3);
    CHECK(!gives(&s, "aa"));
    start_tiny(&s, 1, 256, 2);
    add_word(&s, 0, 2);
    add_word(&s, 1, 3);
    CHECK(gives(&s, "aa"));
    start_tiny(&s, 1, 256, 3); /* three distances of one bit: one too many */
    add_word(&s, 0, 3);
    add_word(&s, 1, 3);
    CHECK(!gives(&s, "aa"));
    start_tiny(&s, 1, 256, 1); /* the last run exceeds the lists */
    add_word(&s, 1, 1), add_bits(&s, 0, 7);
    add_word(&s, 1, 3);
    CHECK(!gives(&s, "aa"));
    start_tiny(&s, 1, 256, 11); /* no distances */
    add_word(&s, 1, 1), add_bits(&s, 0, 7);
    add_word(&s, 1, 3);
    CHECK(gives(&s, "aa"));
    start_tiny(&s, 2, 256, 11); /* two codes of two bits leave half the space unused */
    add_word(&s, 1, 1), add_bits(&s, 0, 7);
    add_word(&s, 1, 6);
    CHECK(!gives(&s, "aa"));
    start(&s, 3);
    CHECK(!gives(&s, ""));
}

static void check_inflate_fixed(void)
{
    bit_stream s;

    start(&s, 1);
    add_word(&s, 0x30 + 'a', 8);
    add_word(&s, 1, 7), add_word(&s, 0, 5); /* length 3, distance 1 */
    add_word(&s, 0, 7);
    CHECK(gives(&s, "aaaa"));
    start(&s, 1); /* reaches back before the start */
    add_word(&s, 0x30 + 'a', 8);
    add_word(&s, 1, 7), add_word(&s, 1, 5);
    add_word(&s, 0, 7);
    CHECK(!gives(&s, "aaaa"));
    start(&s, 0);
    add_bits(&s, 0, 5), add_bits(&s, 1, 16), add_bits(&s, 0xfffe, 16), add_bits(&s, 'a', 8);
    CHECK(gives(&s, "a"));
    start(&s, 0); /* wrong complement of the length */
    add_bits(&s, 0, 5), add_bits(&s, 1, 16), add_bits(&s, 0xffff, 16), add_bits(&s, 'a', 8);
    CHECK(!gives(&s, "a"));
    start(&s, 0); /* longer than the stream */
    add_bits(&s, 0, 5), add_bits(&s, 9, 16), add_bits(&s, 0xfff6, 16), add_bits(&s, 'a', 8);
    CHECK(!gives(&s, "a"));
}

/* Length symbol 286 and distance symbol 30 do not exist; their formulas, continued, would give 323 and 32769. */
static void check_inflate_beyond(void)
{
    static char text[33100];
    bit_stream s;
    int i;

    memset(text, 'a', 1 + 323);
    start(&s, 1);
    add_word(&s, 0x30 + 'a', 8);
    add_word(&s, 0xc6, 8), add_bits(&s, 0, 6), add_word(&s, 0, 5);
    add_word(&s, 0, 7);
    CHECK(!gives(&s, text));
    memset(text, 'a', 1 + 128 * 258 + 3);
    start(&s, 1);
    add_word(&s, 0x30 + 'a', 8);
    for (i = 0; i < 128; ++i) add_word(&s, 0xc5, 8), add_word(&s, 0, 5);
    add_word(&s, 1, 7), add_word(&s, 30, 5), add_bits(&s, 0, 14);
    add_word(&s, 0, 7);
    CHECK(!gives(&s, text));
}

/* --- a builder of PNG files, independent of the writer --- */

enum { MAX_SIDE = 20, FILE_CAP = 1 << 16 };

typedef struct png_file {
    uint8_t data[FILE_CAP];
    size_t size;
} png_file;

typedef struct picture {
    uint32_t width, height, depth, colour, channels;
    int interlaced, keyed;
    uint32_t palette_count, alpha_count;
    uint8_t palette[256][4];
    uint16_t key[3];
    uint16_t samples[MAX_SIDE * MAX_SIDE * 4];
} picture;

static void put_be(uint8_t *p, uint32_t v)
{
    p[0] = (uint8_t)(v >> 24);
    p[1] = (uint8_t)(v >> 16);
    p[2] = (uint8_t)(v >> 8);
    p[3] = (uint8_t)v;
}

static uint32_t crc_bitwise(const uint8_t *p, size_t n)
{
    uint32_t crc = ~0u;
    int k;
    for (; n > 0; --n, ++p) {
        crc ^= *p;
        for (k = 0; k < 8; ++k) crc = crc & 1u ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

static void add_chunk(png_file *f, const char *type, const void *body, size_t n)
{
    uint8_t *p = f->data + f->size;
    if (f->size + n + 12 > FILE_CAP) return;
    put_be(p, (uint32_t)n);
    memcpy(p + 4, type, 4);
    if (n > 0) memcpy(p + 8, body, n);
    put_be(p + 8 + n, crc_bitwise(p + 4, n + 4));
    f->size += n + 12;
}

static void add_header(png_file *f, const picture *p)
{
    uint8_t b[13] = {0};
    memcpy(f->data, "\x89PNG\r\n\x1a\n", 8);
    f->size = 8;
    put_be(b, p->width);
    put_be(b + 4, p->height);
    b[8] = (uint8_t)p->depth;
    b[9] = (uint8_t)p->colour;
    b[12] = (uint8_t)p->interlaced;
    add_chunk(f, "IHDR", b, sizeof b);
}

static void add_palette(png_file *f, const picture *p)
{
    uint8_t colours[768], alphas[256], key[6];
    uint32_t i;
    for (i = 0; i < p->palette_count; ++i) {
        memcpy(colours + 3 * i, p->palette[i], 3);
        alphas[i] = p->palette[i][3];
    }
    for (i = 0; i < 3; ++i) {
        uint32_t v = p->key[i] | (p->width % 2 ? 0xffffu << p->depth : 0); /* bits above the depth are ignored */
        key[2 * i] = (uint8_t)(v >> 8);
        key[2 * i + 1] = (uint8_t)v;
    }
    if (p->palette_count) add_chunk(f, "PLTE", colours, 3 * p->palette_count);
    if (p->alpha_count) add_chunk(f, "tRNS", alphas, p->alpha_count);
    if (p->keyed) add_chunk(f, "tRNS", key, 2 * p->channels);
}

static const uint16_t *pixel(const picture *p, uint32_t x, uint32_t y)
{
    return p->samples + (y * p->width + x) * p->channels;
}

/* The interlace pass of a pixel: the specification's 8 x 8 pattern. */
static int pass_of(const picture *p, uint32_t x, uint32_t y)
{
    static const char pattern[8][9] = {"16462646", "77777777", "56565656", "77777777",
                                       "36463646", "77777777", "56565656", "77777777"};
    return p->interlaced ? pattern[y % 8][x % 8] - '0' : 1;
}

/* Packs the row's pixels of one pass from the top bit. Returns the number of bytes. */
static size_t pack_row(uint8_t *row, const picture *p, int pass, uint32_t y)
{
    size_t bits = 0;
    uint32_t x, c, b;
    memset(row, 0, 8 * MAX_SIDE);
    for (x = 0; x < p->width; ++x) {
        if (pass_of(p, x, y) != pass) continue;
        for (c = 0; c < p->channels; ++c) {
            for (b = p->depth; b-- > 0; ++bits) {
                row[bits / 8] |= (uint8_t)((pixel(p, x, y)[c] >> b & 1u) << (7 - bits % 8));
            }
        }
    }
    return (bits + 7) / 8;
}

static int predict(int filter, int left, int above, int corner)
{
    int guess = left + above - corner, a = abs(guess - left), b = abs(guess - above), c = abs(guess - corner);
    switch (filter) {
    case 1: return left;
    case 2: return above;
    case 3: return (left + above) / 2;
    case 4: return a <= b && a <= c ? left : b <= c ? above : corner;
    default: return 0;
    }
}

/* Packs all rows of all passes with random filters. Returns the number of bytes. */
static size_t pack_rows(uint8_t *out, const picture *p, test_rng *rng)
{
    uint8_t rows[2][8 * MAX_SIDE];
    size_t n, i, size = 0, step = p->channels * p->depth < 8 ? 1 : p->channels * p->depth / 8;
    uint32_t y;
    int pass;
    for (pass = 1; pass <= 7; ++pass) {
        memset(rows, 0, sizeof rows);
        for (y = 0; y < p->height; ++y) {
            int filter = (int)(test_random(rng) % 5);
            n = pack_row(rows[0], p, pass, y);
            if (n == 0) continue;
            out[size++] = (uint8_t)filter;
            for (i = 0; i < n; ++i) {
                int left = i < step ? 0 : rows[0][i - step], corner = i < step ? 0 : rows[1][i - step];
                out[size++] = (uint8_t)(rows[0][i] - predict(filter, left, rows[1][i], corner));
            }
            memcpy(rows[1], rows[0], sizeof rows[1]);
        }
    }
    return size;
}

/* Image data in up to three chunks, one of which can be empty. */
static void add_data(png_file *f, const uint8_t *rows, size_t n, test_rng *rng)
{
    uint8_t *packed;
    size_t size, first, second;
    if (!deflate_zlib(&packed, &size, rows, n)) return;
    first = test_random(rng) % (size + 1);
    second = first + test_random(rng) % (size - first + 1);
    add_chunk(f, "IDAT", packed, first);
    add_chunk(f, "IDAT", packed + first, second - first);
    add_chunk(f, "IDAT", packed + second, size - second);
    free(packed);
}

static void build_png(png_file *f, const picture *p, test_rng *rng)
{
    static uint8_t rows[MAX_SIDE * (8 * MAX_SIDE + 8)];
    add_header(f, p);
    add_chunk(f, "gAMA", "\0\0\261\217", 4);
    add_palette(f, p);
    add_chunk(f, "tEXt", "Comment\0none", 12);
    add_data(f, rows, pack_rows(rows, p, rng), rng);
    add_chunk(f, "tIME", "\7\352\1\1\0\0\0", 7);
    add_chunk(f, "IEND", "", 0);
}

static void random_palette(picture *p, test_rng *rng)
{
    uint32_t i, max = 1u << p->depth;
    p->palette_count = 1 + test_random(rng) % max;
    p->alpha_count = test_random(rng) % (p->palette_count + 1);
    for (i = 0; i < p->palette_count; ++i) {
        put_be(p->palette[i], test_random(rng));
        if (i >= p->alpha_count) p->palette[i][3] = 255;
    }
}

static void random_picture(picture *p, uint32_t colour, uint32_t depth, test_rng *rng)
{
    uint32_t i, n, limit = 1u << depth;
    memset(p, 0, sizeof *p);
    p->width = 1 + test_random(rng) % MAX_SIDE;
    p->height = 1 + test_random(rng) % MAX_SIDE;
    p->depth = depth;
    p->colour = colour;
    p->channels = colour == 2 ? 3 : colour == 4 ? 2 : colour == 6 ? 4 : 1;
    if (colour == 3) {
        random_palette(p, rng);
        limit = p->palette_count;
    }
    n = p->width * p->height * p->channels;
    for (i = 0; i < n; ++i) p->samples[i] = (uint16_t)(test_random(rng) % limit);
    p->keyed = (colour == 0 || colour == 2) && test_random(rng) % 2;
    if (p->keyed) memcpy(p->key, pixel(p, test_random(rng) % p->width, test_random(rng) % p->height), 2 * p->channels);
}

/* --- reading PNG --- */

static void expected_texel(uint8_t out[4], const picture *p, const uint16_t *s)
{
    uint32_t max = (1u << p->depth) - 1, k, colours = p->channels < 3 ? 1 : 3;
    if (p->colour == 3) {
        memcpy(out, p->palette[s[0]], 4);
        return;
    }
    for (k = 0; k < 4; ++k) {
        uint32_t v = k < 3 ? s[colours == 1 ? 0 : k] : p->channels > colours ? s[colours] : max;
        out[k] = (uint8_t)(p->depth == 16 ? v >> 8 : v * 255 / max);
    }
    if (p->keyed && memcmp(s, p->key, 2 * colours) == 0) out[3] = 0;
}

static int is_picture(const bitmap *got, const picture *p)
{
    uint32_t x, y;
    uint8_t want[4];
    if (got->width != (int32_t)p->width || got->height != (int32_t)p->height) return 0;
    for (y = 0; y < p->height; ++y) {
        for (x = 0; x < p->width; ++x) {
            expected_texel(want, p, pixel(p, x, y));
            if (memcmp(got->texels + 4 * (y * p->width + x), want, 4) != 0) return 0;
        }
    }
    return 1;
}

static const uint8_t png_kinds[15][2] = {{0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 16}, {2, 8},  {2, 16}, {3, 1},
                                         {3, 2}, {3, 4}, {3, 8}, {4, 8}, {4, 16}, {6, 8}, {6, 16}};

static void check_png_kinds(test_rng *rng)
{
    static picture p;
    static png_file f;
    int i, turn;
    for (i = 0; i < 15 * 2; ++i) {
        for (turn = 0; turn < 20; ++turn) {
            report r = {""};
            bitmap got;
            random_picture(&p, png_kinds[i / 2][0], png_kinds[i / 2][1], rng);
            p.interlaced = i % 2;
            build_png(&f, &p, rng);
            CHECK_MSG(png_decode(&got, f.data, f.size, "kind.png", &r) && is_picture(&got, &p),
                      "colour %d, %d bits, interlace %d, %d x %d: %s", (int)p.colour, (int)p.depth, p.interlaced,
                      (int)p.width, (int)p.height, r.text);
            bitmap_free(&got);
        }
    }
}

/* Decodes a copy in an exactly sized block, so that a sanitizer detects reads past the end. */
static int decode_copy(const uint8_t *data, size_t size, report *r)
{
    bitmap got;
    uint8_t *copy = malloc(size ? size : 1);
    int done = 0;
    memset(r, 0, sizeof *r);
    if (!copy) return 0;
    memcpy(copy, data, size);
    done = png_decode(&got, copy, size, "x.png", r);
    if (!done) CHECK(!got.texels && strncmp(r->text, "x.png: ", 7) == 0);
    bitmap_free(&got);
    free(copy);
    return done;
}

static void check_png_prefixes(test_rng *rng)
{
    static picture p;
    static png_file f;
    report r;
    size_t i;
    random_picture(&p, 3, 4, rng);
    p.interlaced = 1;
    build_png(&f, &p, rng);
    for (i = 0; i < f.size; ++i) CHECK_MSG(!decode_copy(f.data, i, &r), "%d bytes", (int)i);
    CHECK(decode_copy(f.data, f.size, &r));
}

/* Recomputes the checksum of each intact chunk, so that damage passes the check. */
static void repair_checksums(uint8_t *data, size_t size)
{
    size_t at = 8;
    while (at < size && size - at >= 12) {
        const uint8_t *p = data + at;
        uint32_t n = (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
        if (n > size - at - 12) return;
        put_be(data + at + 8 + n, crc_bitwise(data + at + 4, (size_t)n + 4));
        at += 12 + (size_t)n;
    }
}

static void check_png_damage(test_rng *rng)
{
    static picture p;
    static png_file f, damaged;
    report r;
    int turn, k;
    for (turn = 0; turn < 3000; ++turn) {
        if (turn % 50 == 0) {
            random_picture(&p, png_kinds[turn / 50 % 15][0], png_kinds[turn / 50 % 15][1], rng);
            p.interlaced = turn / 50 % 2;
            build_png(&f, &p, rng);
        }
        damaged.size = f.size;
        memcpy(damaged.data, f.data, f.size);
        for (k = 0; k <= turn % 3; ++k) {
            size_t at = test_random(rng) % f.size;
            damaged.data[at] ^= (uint8_t)(1u << test_random(rng) % 8);
        }
        if (turn % 4) repair_checksums(damaged.data, damaged.size);
        if (decode_copy(damaged.data, damaged.size, &r)) ++test_passed; /* passes either way if it returns */
    }
}

static void add_tiny_data(png_file *f)
{
    uint8_t *packed;
    size_t n;
    if (!deflate_zlib(&packed, &n, (const uint8_t *)"\0\1\0\1", 4)) return;
    add_chunk(f, "IDAT", packed, n);
    free(packed);
}

/* A 1 x 2 picture with chunks named by the letters of `plan`. */
static void build_plan(png_file *f, const char *plan, uint32_t colour)
{
    picture p;
    memset(&p, 0, sizeof p);
    p.width = 1;
    p.height = 2;
    p.depth = 8;
    p.colour = colour;
    add_header(f, &p);
    for (; *plan; ++plan) {
        switch (*plan) {
        case 'H': f->size += 25; memcpy(f->data + f->size - 25, f->data + 8, 25); break;
        case 'P': add_chunk(f, "PLTE", "abcdef", 6); break;
        case 'q': add_chunk(f, "PLTE", "abc", 3); break;
        case 'Q': add_chunk(f, "PLTE", "abcdefghi", 9); break;
        case 'p': add_chunk(f, "PLTE", "abcde", 5); break;
        case 't': add_chunk(f, "tRNS", "ab", 2); break;
        case 'T': add_chunk(f, "tRNS", "abc", 3); break;
        case 'U': add_chunk(f, "tRNS", "abcd", 4); break;
        case 'a': add_chunk(f, "teSt", "abc", 3); break;
        case 'C': add_chunk(f, "TeSt", "abc", 3); break;
        case 'D': add_tiny_data(f); break;
        case 'd': add_chunk(f, "IDAT", "abcdefghijk", 11); break;
        case 'E': add_chunk(f, "IEND", "", 0); break;
        case 'e': add_chunk(f, "IEND", "a", 1); break;
        case '1': f->data[24] = 1; repair_checksums(f->data, f->size); break; /* one bit per sample */
        default: f->data[f->size++] = '?'; break;
        }
    }
}

static void check_png_order(void)
{
    static const struct {
        const char *plan;
        uint32_t colour;
        const char *says; /* NULL: decodes */
    } cases[] = {
        {"DE", 0, NULL}, {"aDaE", 0, NULL}, {"PtDE", 3, NULL}, {"tDE", 0, NULL}, {"DE?!", 0, NULL},
        {"1PDE", 3, NULL}, {"E", 0, "no image data"}, {"D", 0, "before IEND"},
        {"DaDE", 0, "IDAT at byte 72 may not"}, {"HDE", 0, "IHDR at byte 33 may not"},
        {"CDE", 0, "TeSt at byte 33 is not known"}, {"De", 0, "cannot hold 1 bytes"},
        {"DE", 3, "IDAT at byte 33 may not"}, {"pDE", 3, "PLTE at byte 33 cannot hold 5"},
        {"1QDE", 3, NULL}, {"1QTDE", 3, NULL}, {"1QUDE", 3, "tRNS at byte 54 cannot hold 4"}, {"PPDE", 3, "PLTE at byte 51 may not"},
        {"DPE", 3, "IDAT at byte 33 may not"}, {"DPE", 2, "may not"}, {"PDE", 0, "PLTE at byte 33 may not"},
        {"PTDE", 3, "tRNS at byte 51 cannot hold 3"}, {"tPDE", 3, "tRNS at byte 33 may not"},
        {"ttDE", 0, "tRNS at byte 47 may not"}, {"TDE", 0, "tRNS at byte 33 cannot hold 3"}, {"DtE", 0, "may not"},
        {"tDE", 4, "tRNS at byte 33 may not"}, {"tDE", 6, "tRNS at byte 33 may not"},
        {"qDE", 3, "pixel 0, 0 has a colour index outside the palette of 1"},
        {"dE", 0, "does not inflate to the 4 bytes of 1 x 2 pixels"}, {"DE", 2, "does not inflate"},
        {"DE", 1, "colour type 1"}, {"DE", 7, "colour type 7"}, {"PD?", 3, "ends at byte"}
    };
    static png_file f;
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        report r;
        int done;
        build_plan(&f, cases[i].plan, cases[i].colour);
        done = decode_copy(f.data, f.size, &r);
        CHECK_MSG(done == !cases[i].says && (done || strstr(r.text, cases[i].says)), "%s of colour type %d: '%s'",
                  cases[i].plan, (int)cases[i].colour, r.text);
    }
}

/* A header field set to v, with a correct checksum. */
static void check_png_header(size_t at, uint32_t v, int bytes, const char *says)
{
    static png_file f;
    report r;
    build_plan(&f, "DE", 0);
    if (bytes == 4) put_be(f.data + at, v);
    else f.data[at] = (uint8_t)v;
    repair_checksums(f.data, f.size);
    CHECK(!decode_copy(f.data, f.size, &r));
    CHECK_MSG(strstr(r.text, says) != NULL, "'%s'", r.text);
}

static void check_png_headers(void)
{
    check_png_header(16, 0, 4, "0 x 2 pixels");
    check_png_header(20, 0, 4, "1 x 0 pixels");
    check_png_header(16, 0xffffffffu, 4, "4294967295 x 2 pixels");
    check_png_header(16, 1u << 25, 4, "cannot fill 33554432 x 2 pixels"); /* refused before allocation */
    check_png_header(20, 1u << 26, 4, "cannot fill");
    check_png_header(16, 1u << 27, 4, "134217728 x 2 pixels");
    check_png_header(24, 3, 1, "with 3 bits");
    check_png_header(26, 1, 1, "compression 1");
    check_png_header(27, 64, 1, "filter 64");
    check_png_header(28, 2, 1, "interlace 2");
}

static void check_png_messages(void)
{
    static png_file f;
    report r;
    build_plan(&f, "aDE", 0);
    CHECK(!decode_copy((const uint8_t *)"GIF89a, surely", 14, &r) && strstr(r.text, "not a PNG file"));
    f.data[35] = 9; /* length of the chunk at 33 */
    CHECK(!decode_copy(f.data, f.size, &r) && strstr(r.text, "chunk teSt at byte 33 runs past the end of the file"));
    build_plan(&f, "aDE", 0);
    f.data[42] ^= 1;
    CHECK(!decode_copy(f.data, f.size, &r) && strstr(r.text, "chunk teSt at byte 33 has a wrong checksum"));
}

/* --- writing PNG and PPM --- */

static int survives_png(const uint8_t *rgb, int32_t width, int32_t height)
{
    report r = {""};
    file_bytes file;
    bitmap got = {0, 0, NULL, NULL};
    int same = 0, i;
    if (png_encode(&file, rgb, width, height, &r) && png_decode(&got, file.data, file.size, "back.png", &r)) {
        same = got.width == width && got.height == height;
        for (i = 0; same && i < width * height; ++i) {
            same = memcmp(got.texels + 4 * i, rgb + 3 * i, 3) == 0 && got.texels[4 * i + 3] == 255;
        }
    }
    bitmap_free(&got);
    file_free(&file);
    return same;
}

static void check_png_written(test_rng *rng)
{
    uint8_t *rgb = malloc(640 * 480 * 3);
    report r = {""};
    file_bytes file;
    int turn;
    CHECK(rgb != NULL);
    for (turn = 0; rgb && turn < 40; ++turn) {
        int32_t w = (int32_t)(1 + test_random(rng) % 70), h = (int32_t)(1 + test_random(rng) % 70);
        fill_kind(rgb, (size_t)(w * h * 3), turn % KINDS, rng);
        CHECK_MSG(survives_png(rgb, w, h), "kind %d, %d x %d", turn % KINDS, (int)w, (int)h);
    }
    if (rgb) {
        fill_kind(rgb, 640 * 480 * 3, NOISE, rng); /* several IDAT chunks */
        CHECK(survives_png(rgb, 640, 480));
    }
    CHECK(!png_encode(&file, rgb, 0, 4, &r) && !file.data && r.text[0]);
    CHECK(!png_encode(&file, rgb, INT32_MAX, INT32_MAX, &r) && !file.data);
    CHECK(!png_encode(&file, rgb, 4, -1, &r) && !file.data);
    free(rgb);
}

static void check_ppm(void)
{
    report r = {""};
    file_bytes file;
    CHECK(ppm_encode(&file, (const uint8_t *)"abcdef", 1, 2, &r));
    CHECK(file.size == 17 && memcmp(file.data, "P6\n1 2\n255\nabcdef", 17) == 0);
    file_free(&file);
    CHECK(!ppm_encode(&file, NULL, 0, 2, &r) && !file.data && r.text[0]);
}

/* --- reading PPM --- */

typedef int (*text_reader)(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r);

static int read_text(bitmap *out, text_reader read, const char *text, size_t size)
{
    report r = {""};
    uint8_t *copy = malloc(size); /* exactly sized, so that a sanitizer detects reads past the end */
    int ok = 0;
    memset(out, 0, sizeof *out);
    if (copy) {
        memcpy(copy, text, size);
        ok = read(out, copy, size, "a.file", &r);
        CHECK(ok ? out->texels != NULL && !r.text[0] : strncmp(r.text, "a.file: ", 8) == 0 && !out->texels);
    }
    free(copy);
    return ok;
}

/* Returns whether the text gives a picture with `width` pixels per row and `codes` as red, green and blue of the first
 * `n` texels. */
static int gives_codes(const char *text, size_t size, int32_t width, const char *codes, size_t n)
{
    bitmap map;
    int same = read_text(&map, ppm_decode, text, size) && map.width == width;
    for (size_t i = 0; same && i < n; ++i)
        same = memcmp(map.texels + 4 * i, codes + 3 * i, 3) == 0 && map.texels[4 * i + 3] == 255;
    bitmap_free(&map);
    return same;
}

static int refuses_ppm(const char *text, size_t size)
{
    bitmap map;
    int ok = read_text(&map, ppm_decode, text, size);
    bitmap_free(&map);
    return !ok;
}

#define PPM_GIVES(text, width, codes) gives_codes(text, sizeof text - 1, width, codes, sizeof codes / 3)
#define PPM_REFUSED(text)             refuses_ppm(text, sizeof text - 1)

static void check_ppm_kinds(void)
{
    CHECK(PPM_GIVES("P6 1 1 255\nabc", 1, "abc") && PPM_GIVES("P6#c\n1#d\r1\t\t255 abc", 1, "abc"));
    CHECK(PPM_GIVES("P5 2 1 255\nab", 2, "aaabbb"));
    CHECK(PPM_GIVES("P3 2 1 255 97 98 99\n100 101 102\n", 2, "abcdef") && PPM_GIVES("P3 1 1 255 97 98 99", 1, "abc"));
    CHECK(PPM_GIVES("P2 2 1 # grey\n255 # most\n097#a\n98 # end", 2, "aaabbb"));
    /* 15 values widen exactly, 3 of 7 is 109.3, 1 of 2 is 127.5; 300 of 1000 is 76.5, halves go up */
    CHECK(PPM_GIVES("P2 3 1 15 0 7 15", 3, "\0\0\0\x77\x77\x77\xFF\xFF\xFF"));
    CHECK(PPM_GIVES("P3 1 1 7 3 0 7", 1, "\x6D\0\xFF") && PPM_GIVES("P2 1 1 2 1", 1, "\x80\x80\x80"));
    CHECK(PPM_GIVES("P6 1 1 1000 \x01\x2C\x03\xE8\0\0", 1, "\x4D\xFF\0"));
    /* 65535 uses the high byte, although 0x13 would be nearest to 0x12FF */
    CHECK(PPM_GIVES("P6 1 1 65535 \x12\xFF\xFF\xFF\0\xFF", 1, "\x12\xFF\0"));
    CHECK(PPM_GIVES("P5 1 1 256 \x01\0", 1, "\xFF\xFF\xFF") && PPM_GIVES("P2 1 1 65535 65279", 1, "\xFE\xFE\xFE"));
}

static void check_ppm_refusals(void)
{
    CHECK(PPM_REFUSED("P6 1 1 255\nab") && PPM_REFUSED("P6 1 1 255\nabcd") && PPM_REFUSED("P6 1 1 255"));
    CHECK(PPM_REFUSED("P4 1 1 255\nabc") && PPM_REFUSED("P61 1 255\nabc") && PPM_REFUSED("P"));
    CHECK(PPM_REFUSED("P6 0 1 255\n") && PPM_REFUSED("P6 -1 1 255\nabc") && PPM_REFUSED("P6 1 1 0\nabc"));
    CHECK(PPM_REFUSED("P6 1 1 65536\nabcabc") && PPM_REFUSED("P6 99999999999 99999999999 255\nabc"));
    CHECK(PPM_REFUSED("P6 1048576 1048576 255\nabc") && PPM_REFUSED("P6 # 1 1 255"));
    CHECK(PPM_REFUSED("P6 1 1 254\nab\xFF") && PPM_REFUSED("P5 1 1 1000 \x03\xE9")); /* above the maximum value */
    CHECK(PPM_REFUSED("P5 1 1 65535 a") && PPM_REFUSED("P5 1 1 65535 abc"));
    CHECK(PPM_REFUSED("P3 1 1 255 97 98") && PPM_REFUSED("P3 1 1 255 97 98 99 100") && PPM_REFUSED("P2 1 1 9 10"));
    CHECK(PPM_REFUSED("P2 1 1 255 x") && PPM_REFUSED("P2 1 1 255 -1") && PPM_REFUSED("P2 1 1 255 1.0"));
    CHECK(PPM_REFUSED("P2 16384 16384 255 1 2 3")); /* refused before allocation */
}

/* --- reading PAM --- */

static int gives_texels(text_reader read, const char *text, size_t size, int32_t width, const char *texels, size_t n)
{
    bitmap map;
    const int same = read_text(&map, read, text, size) && map.width == width && memcmp(map.texels, texels, n) == 0;
    bitmap_free(&map);
    return same;
}

static int refuses_pam(text_reader read, const char *text, size_t size)
{
    bitmap map;
    const int ok = read_text(&map, read, text, size);
    bitmap_free(&map);
    return !ok;
}

#define PAM_HEAD(width, depth, max, type) \
    "P7\nWIDTH " width "\nHEIGHT 1\nDEPTH " depth "\nMAXVAL " max "\nTUPLTYPE " type "\nENDHDR\n"
#define PAM_GIVES(text, width, texels) gives_texels(pam_decode, text, sizeof text - 1, width, texels, sizeof texels - 1)
#define PAM_REFUSED(text)              refuses_pam(pam_decode, text, sizeof text - 1)

static void check_pam_kinds(void)
{
    CHECK(PAM_GIVES(PAM_HEAD("2", "1", "1", "BLACKANDWHITE") "\0\1", 2, "\0\0\0\xFF\xFF\xFF\xFF\xFF"));
    CHECK(PAM_GIVES(PAM_HEAD("1", "2", "1", "BLACKANDWHITE_ALPHA") "\1\0", 1, "\xFF\xFF\xFF\0"));
    CHECK(PAM_GIVES(PAM_HEAD("2", "1", "255", "GRAYSCALE") "ab", 2, "aaa\xFF" "bbb\xFF"));
    CHECK(PAM_GIVES(PAM_HEAD("1", "2", "255", "GRAYSCALE_ALPHA") "ab", 1, "aaab"));
    CHECK(PAM_GIVES(PAM_HEAD("2", "3", "255", "RGB") "abcdef", 2, "abc\xFF" "def\xFF"));
    CHECK(PAM_GIVES(PAM_HEAD("2", "4", "255", "RGB_ALPHA") "abcdefgh", 2, "abcdefgh"));
    /* 65535 uses the high byte; 3 of 7 is 109.3; 300 of 1000 is 76.5, halves are rounded up */
    CHECK(PAM_GIVES(PAM_HEAD("1", "2", "65535", "GRAYSCALE_ALPHA") "\x12\xFF\xFE\0", 1, "\x12\x12\x12\xFE"));
    CHECK(PAM_GIVES(PAM_HEAD("1", "3", "7", "RGB") "\3\0\7", 1, "\x6D\0\xFF\xFF"));
    CHECK(PAM_GIVES(PAM_HEAD("1", "1", "1000", "GRAYSCALE") "\x01\x2C", 1, "\x4D\x4D\x4D\xFF"));
    /* header words in any order, comments, empty lines, CR; without a type, DEPTH determines it */
    CHECK(PAM_GIVES("P7\n# c\n\nMAXVAL 255\nDEPTH 4\r\n  HEIGHT\t1 \nWIDTH 1\nENDHDR\nabcd", 1, "abcd"));
    CHECK(PAM_GIVES("P7\r\nWIDTH 1\r\nHEIGHT 1\r\nDEPTH 1\r\nMAXVAL 255\r\nENDHDR\r\na", 1, "aaa\xFF"));
    CHECK(gives_texels(pam_decode_16, PAM_HEAD("1", "1", "65535", "GRAYSCALE") "ab", 69, 1, "ab", 2));
    CHECK(refuses_pam(pam_decode_16, PAM_HEAD("1", "1", "255", "GRAYSCALE") "a", 66));
}

static void check_pam_refusals(void)
{
    CHECK(PAM_REFUSED(PAM_HEAD("2", "3", "255", "RGB") "abcde") &&
          PAM_REFUSED(PAM_HEAD("2", "3", "255", "RGB") "abcdefg"));
    CHECK(PAM_REFUSED(PAM_HEAD("0", "3", "255", "RGB")) && PAM_REFUSED(PAM_HEAD("-1", "3", "255", "RGB") "abc"));
    CHECK(PAM_REFUSED(PAM_HEAD("99999999999", "3", "255", "RGB") "abc") &&
          PAM_REFUSED(PAM_HEAD("1.0", "1", "255", "GRAYSCALE") "a"));
    CHECK(PAM_REFUSED(PAM_HEAD("1", "5", "255", "RGB") "abcde") && PAM_REFUSED(PAM_HEAD("1", "0", "255", "RGB")));
    CHECK(PAM_REFUSED(PAM_HEAD("1", "1", "0", "GRAYSCALE") "a") &&
          PAM_REFUSED(PAM_HEAD("1", "1", "65536", "GRAYSCALE") "ab"));
    CHECK(PAM_REFUSED(PAM_HEAD("1", "1", "7", "GRAYSCALE") "\x08") &&
          PAM_REFUSED(PAM_HEAD("1", "1", "2", "BLACKANDWHITE") "\1"));
    CHECK(PAM_REFUSED(PAM_HEAD("1", "1", "255", "RGB") "a") && PAM_REFUSED(PAM_HEAD("1", "3", "255", "CMYK") "abc"));
    CHECK(PAM_REFUSED(PAM_HEAD("1 2", "1", "255", "GRAYSCALE") "a") &&
          PAM_REFUSED(PAM_HEAD("1\nWIDTH 1", "1", "255", "GRAYSCALE") "a"));
    CHECK(PAM_REFUSED("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nENDHDR\na"));
    CHECK(PAM_REFUSED("P7\nENDHDR\n") && PAM_REFUSED("P7\n"));
    CHECK(PAM_REFUSED("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nENDHDR") && PAM_REFUSED("P7\nCOLOUR 1\nENDHDR\na"));
    CHECK(PAM_REFUSED("P7\nWIDTH 16385\nHEIGHT 16385\nDEPTH 1\nMAXVAL 255\nENDHDR\na") && PAM_REFUSED("P6\n"));
}

/* --- pictures by their content --- */

static int says_of(const char *data, size_t size, const char *format, const char *part)
{
    stored_picture p;
    report r = {""}, codes = {""};
    bitmap map;
    int refused = !picture_read(&p, (const uint8_t *)data, size, "x.png", &r) && !p.codes.texels && !p.light.pixels;
    CHECK(!picture_read_codes(&map, (const uint8_t *)data, size, "x.png", &codes) && !map.texels);
    CHECK_MSG(strcmp(r.text, codes.text) == 0, "%s", codes.text);
    return refused && strncmp(r.text, "x.png: ", 7) == 0 && strstr(r.text, format) && strstr(r.text, part);
}

#define SAYS_OF(text, format, part) says_of(text, sizeof text - 1, format, part)

static void check_foreign(void)
{
    static const char end_of_tga[] = "\0\0\2 any pixels \0\0\0\0\0\0\0\0TRUEVISION-XFILE.\0";
    CHECK(SAYS_OF("RIFF\x10\0\0\0WEBPVP8 ", "WebP", "dwebp") && SAYS_OF("\0\0\0\x20" "ftypavif", "AVIF", "avifdec"));
    CHECK(SAYS_OF("\xABKTX 20\xBB\r\n\x1A\n", "KTX2", "ktx extract") && SAYS_OF("DDS |", "DDS", "magick"));
    CHECK(SAYS_OF("GIF89a", "GIF", "magick") && SAYS_OF("II*\0\x08", "TIFF", "magick"));
    CHECK(SAYS_OF("\x76\x2F\x31\x01\2", "OpenEXR", "oiiotool") && SAYS_OF("P7\nWIDTH 1", "line 2", "ENDHDR"));
    CHECK(SAYS_OF(end_of_tga, "TGA", "magick"));
    CHECK(SAYS_OF("RIFF\x10\0\0\0WAVE", "not a PNG", "by its first bytes") && SAYS_OF("", "the file is empty", "0 bytes"));
    CHECK(picture_begins((const uint8_t *)"GIF89a", 6) && !picture_begins((const uint8_t *)"o cube\nv 0 0 0", 14));
    CHECK(!picture_begins((const uint8_t *)"ply\n", 4) && !picture_begins((const uint8_t *)"", 0));
}

static void check_stored(void)
{
    static const char hdr[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\0\x81";
    static png_file f;
    stored_picture p;
    report r = {""};
    bitmap map;
    CHECK(picture_read(&p, (const uint8_t *)"P5 1 1 255 a", 12, "x", &r) && p.channels == 1 && p.width == 1);
    CHECK(p.codes.texels && !p.light.pixels && strcmp(p.format, "PGM") == 0);
    stored_picture_free(&p);
    CHECK(picture_read(&p, (const uint8_t *)hdr, sizeof hdr - 1, "x", &r) && p.channels == 3 && p.height == 1);
    CHECK(!p.codes.texels && p.light.pixels && p.light.pixels[0] == 1.0f && p.light.pixels[1] == 0.5f);
    stored_picture_free(&p);
    CHECK(!picture_read_codes(&map, (const uint8_t *)hdr, sizeof hdr - 1, "x", &r) && strstr(r.text, "linear light"));
    build_plan(&f, "DE", 0);
    CHECK(picture_read(&p, f.data, f.size, "x", &r) && p.channels == 1 && p.codes.height == 2);
    stored_picture_free(&p);
}

/* --- PFM --- */

/* Random bits, including infinities, NaN and denormals. */
static int make_image(image *out, int32_t width, int32_t height, int32_t channels, test_rng *rng)
{
    size_t n = (size_t)(width * height * channels), i;
    out->width = width;
    out->height = height;
    out->channels = channels;
    out->pixels = malloc(n * sizeof *out->pixels);
    for (i = 0; out->pixels && i < n; ++i) {
        uint32_t bits = test_random(rng);
        memcpy(out->pixels + i, &bits, 4);
    }
    return out->pixels != NULL;
}

static int same_image(const image *a, const image *b)
{
    size_t n = (size_t)(a->width * a->height * a->channels) * sizeof *a->pixels;
    return a->width == b->width && a->height == b->height && a->channels == b->channels && b->pixels &&
           memcmp(a->pixels, b->pixels, n) == 0;
}

/* The same picture with its floats in the other byte order. */
static void make_big_endian(file_bytes *file, size_t floats)
{
    uint8_t *p = file->data + file->size - 4 * floats;
    memcpy(p - 5, "+1.0\n", 5);
    for (; floats > 0; --floats, p += 4) {
        uint8_t a = p[0], b = p[1];
        p[0] = p[3];
        p[1] = p[2];
        p[2] = b;
        p[3] = a;
    }
}

static void check_pfm_round(test_rng *rng)
{
    int turn;
    for (turn = 0; turn < 30; ++turn) {
        report r = {""};
        image in, got;
        file_bytes file;
        int32_t channels = turn % 2 ? 1 : 3;
        if (!make_image(&in, (int32_t)(1 + test_random(rng) % 30), (int32_t)(1 + test_random(rng) % 30), channels, rng))
            continue;
        CHECK(pfm_encode(&file, &in, &r));
        CHECK_MSG(pfm_decode(&got, file.data, file.size, "a.pfm", &r) && same_image(&in, &got), "%s", r.text);
        image_free(&got);
        make_big_endian(&file, (size_t)(in.width * in.height * channels));
        CHECK_MSG(pfm_decode(&got, file.data, file.size, "b.pfm", &r) && same_image(&in, &got), "%s", r.text);
        image_free(&got);
        file_free(&file);
        image_free(&in);
    }
}

static int decode_pfm_text(image *out, const char *text, size_t size, report *r)
{
    uint8_t *copy = malloc(size ? size : 1);
    int done = 0;
    memset(r, 0, sizeof *r);
    memset(out, 0, sizeof *out);
    if (copy) {
        memcpy(copy, text, size);
        done = pfm_decode(out, copy, size, "x.pfm", r);
    }
    free(copy);
    return done;
}

static void check_pfm_text(void)
{
    static const char noted[] = "Pf # one\n#two\n1 1\n-1\n\0\0\0\0";
    static const char good[] = "PF \t1\r\n2 -2e0\n\0\0\200?\0\0\0@\0\0@@\0\0\200@\0\0\240@\0\0\300@";
    static const char *const bad[] = {"", "P", "PF", "PG\n1 1\n-1\n1234", " Pf\n1 1\n-1\n1234", "Pf\n1 1\n0\n1234",
                                      "Pf\n1 1\nnan\n1234", "Pf\n1 1\n1x\n1234", "Pf\n1 1\n-1e40\n1234",
                                      "Pf\n-1 1\n1\n1234", "Pf\n0 1\n1\n1234", "Pf\n99999999999 1\n1\n1234",
                                      "Pf\n2234123412341 1\n1\n1234", "Pf\n268435456 2\n1\n1234",
                                      "Pf\n1 2\n1\n1234", "Pf\n1 1\n1\n12345", "Pf\n1 1\n1", "PF\n1 1\n1\n1234",
                                      "Pf\n1 1\n1.00000000000000000000000000000000000\n1234"};
    image got;
    report r;
    size_t i;
    CHECK(decode_pfm_text(&got, noted, sizeof noted - 1, &r) && got.width == 1 && got.pixels[0] == 0.0f);
    image_free(&got);
    CHECK(decode_pfm_text(&got, good, sizeof good - 1, &r));
    CHECK(got.pixels && got.width == 1 && got.height == 2 && got.channels == 3);
    for (i = 0; got.pixels && i < 6; ++i) CHECK(got.pixels[i] == 2.0f * (float)(i < 3 ? i + 4 : i - 2));
    image_free(&got);
    for (i = 0; i + 1 < sizeof good; ++i) CHECK(!decode_pfm_text(&got, good, i, &r) && !got.pixels && r.text[0]);
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        CHECK_MSG(!decode_pfm_text(&got, bad[i], strlen(bad[i]), &r) && !got.pixels && r.text[0], "%s", bad[i]);
}

/* --- HDR --- */

/* Reads one component of a coded row. Returns the offset after it, or 0 if the stream does not fit. */
static size_t read_runs(uint8_t *out, int32_t width, const file_bytes *file, size_t at)
{
    int32_t x = 0;
    while (x < width) {
        int32_t n;
        if (at + 2 > file->size) return 0;
        n = file->data[at++];
        if (n > 128) {
            if (n - 128 > width - x) return 0;
            memset(out + x, file->data[at++], (size_t)(n - 128));
            x += n - 128;
        } else {
            if (n == 0 || n > width - x || at + (size_t)n > file->size) return 0;
            memcpy(out + x, file->data + at, (size_t)n);
            at += (size_t)n;
            x += n;
        }
    }
    return at;
}

/* Reads all rows into planes of mantissas and exponents. Returns 1 if they fill the file exactly. */
static int read_hdr(uint8_t *planes, const image *in, const file_bytes *file)
{
    char header[80];
    size_t at, w = (size_t)in->width, x;
    int32_t y;
    int k;
    snprintf(header, sizeof header, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", (int)in->height,
             (int)in->width);
    at = strlen(header);
    if (file->size < at || memcmp(file->data, header, at) != 0) return 0;
    for (y = 0; y < in->height; ++y, planes += 4 * w) {
        if (in->width < 8) {
            for (x = 0; x < 4 * w; ++x) planes[x % 4 * w + x / 4] = file->data[at++];
            continue;
        }
        if (file->data[at] != 2 || file->data[at + 1] != 2) return 0;
        if (file->data[at + 2] * 256 + file->data[at + 3] != in->width) return 0;
        at += 4;
        for (k = 0; k < 4 && at; ++k) at = read_runs(planes + (size_t)k * w, in->width, file, at);
        if (!at) return 0;
    }
    return at == file->size;
}

/* The largest component of a pixel keeps 8 bits: all three are within half a step of 2^(e - 8). */
static int hdr_near(const image *in, const uint8_t *planes)
{
    int32_t x, y;
    int k;
    for (y = 0; y < in->height; ++y, planes += 4 * (size_t)in->width) {
        for (x = 0; x < in->width; ++x) {
            double step = ldexp(1.0, planes[3 * in->width + x] - 136);
            for (k = 0; k < 3; ++k) {
                int32_t c = in->channels == 3 ? k : 0;
                double want = (double)in->pixels[(y * in->width + x) * in->channels + c];
                double got = planes[3 * in->width + x] ? planes[k * in->width + x] * step : 0.0;
                if (!(want > 0.0)) want = 0.0;
                if (want > 1.6947656946257677e38) want = 1.6947656946257677e38;
                if (fabs(got - want) > 0.5 * step + 3e-39) return 0;
            }
        }
    }
    return 1;
}

static void check_hdr(test_rng *rng)
{
    int turn;
    for (turn = 0; turn < 60; ++turn) {
        report r = {""};
        image in;
        file_bytes file;
        int32_t w = (int32_t)(1 + test_random(rng) % (turn % 3 ? 20 : 700)), h = (int32_t)(1 + test_random(rng) % 5), i;
        uint8_t *planes = malloc((size_t)(4 * w * h));
        if (!planes || !make_image(&in, w, h, turn % 2 ? 1 : 3, rng)) continue;
        for (i = 0; turn % 4 && i < w * h * in.channels; ++i) /* steps create runs */
            in.pixels[i] = i % 970 < 600 ? 0.7f : turn % 4 == 2 ? 0.999f : test_uniform(rng, 0.0f, 4.0f);
        CHECK(hdr_encode(&file, &in, &r));
        CHECK_MSG(file.data && read_hdr(planes, &in, &file) && hdr_near(&in, planes), "turn %d: %d x %d", turn, (int)w,
                  (int)h);
        file_free(&file);
        image_free(&in);
        free(planes);
    }
}

/* --- files --- */

static int holds(const char *path, const char *text)
{
    report r = {""};
    file_bytes file;
    int same = file_read(&file, path, &r) && file.size == strlen(text) && memcmp(file.data, text, file.size) == 0;
    file_free(&file);
    return same;
}

#ifndef _WIN32

/* Returns the number of entries without . and .., or -1 if there is no such directory. */
static int count_entries(const char *path)
{
    DIR *d = opendir(path);
    int n = -2;
    if (!d) return -1;
    while (readdir(d)) ++n;
    closedir(d);
    return n;
}

static void check_links(const char *file, const char *link)
{
    report r = {""};
    struct stat s, before;
    if (symlink("a", link) != 0) {
        SKIP("links: none can be made");
        return;
    }
    CHECK(stat(file, &before) == 0 && file_write(link, "linked", 6, &r) && holds(file, "linked"));
    CHECK(lstat(link, &s) == 0 && S_ISLNK(s.st_mode));
    CHECK(stat(file, &s) == 0 && s.st_ino != before.st_ino); /* replaced, not overwritten */
    remove(link);
}

static void check_permissions(const char *file)
{
    report r = {""};
    struct stat s;
    CHECK(chmod(file, 0666) == 0 && file_write(file, "mode", 4, &r));
    CHECK(stat(file, &s) == 0 && (s.st_mode & 0777) == 0666);
    if (geteuid() == 0) return; /* root may write to any file */
    CHECK(chmod(file, 0444) == 0 && !file_write(file, "x", 1, &r) && holds(file, "mode"));
    CHECK(chmod(file, 0644) == 0);
}

/* A write that fails halfway leaves the old file and no other. */
static void check_full_disk(const char *file)
{
    static const char big[100000] = "big";
    report r = {""};
    struct rlimit limit, small;
    void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0) return;
    small = limit;
    small.rlim_cur = 50000;
    if (setrlimit(RLIMIT_FSIZE, &small) == 0) CHECK(!file_write(file, big, sizeof big, &r) && r.text[0]);
    setrlimit(RLIMIT_FSIZE, &limit);
    signal(SIGXFSZ, handler);
    CHECK(holds(file, "mode"));
}

static void check_files_in(const char *directory)
{
    char file[600], link[600], beyond[600];
    report r = {""};
    file_bytes got;
    file_keep_end(); /* from earlier commands */
    snprintf(file, sizeof file, "%s/a", directory);
    snprintf(link, sizeof link, "%s/b", directory);
    snprintf(beyond, sizeof beyond, "%s/none/a", directory);
    CHECK(file_write(file, "first", 5, &r) && holds(file, "first"));
    CHECK(file_write(file, "", 0, &r) && holds(file, ""));
    CHECK(file_write(file, "second one", 10, &r) && holds(file, "second one"));
    check_links(file, link);
    check_permissions(file);
    check_full_disk(file);
    CHECK(!r.text[0] && count_entries(directory) == 1);
    CHECK(!file_write(beyond, "x", 1, &r) && strstr(r.text, "none/a"));
    memset(&r, 0, sizeof r);
    CHECK(!file_write(directory, "x", 1, &r) && r.text[0]);
    memset(&r, 0, sizeof r);
    CHECK(!file_read(&got, beyond, &r) && !got.data && strstr(r.text, "none/a"));
    memset(&r, 0, sizeof r);
    CHECK(!file_read(&got, directory, &r) && !got.data && r.text[0]);
    remove(file);
    CHECK(count_entries(directory) == 0);
}

static void check_files(void)
{
    char directory[512];
    const char *base = getenv("TMPDIR");
    report r = {""};
    struct stat s;
    snprintf(directory, sizeof directory, "%s/test_images.XXXXXX", base && *base ? base : "/tmp");
    if (mkdtemp(directory)) {
        check_files_in(directory);
        rmdir(directory);
    } else {
        SKIP("files: no directory can be made; set TMPDIR");
    }
    CHECK(file_write("/dev/null", "x", 1, &r) && !r.text[0] && stat("/dev/null", &s) == 0 && S_ISCHR(s.st_mode));
    if (stat("/dev/full", &s) == 0) CHECK(!file_write("/dev/full", "x", 1, &r) && strstr(r.text, "/dev/full: "));
}

/* --- the pictures that scenes use --- */

static int ends_in_png(const char *name)
{
    size_t n = strlen(name);
    return n > 4 && strcmp(name + n - 4, ".png") == 0;
}

static void check_shared_png(const char *path, const char *shown)
{
    report r = {""};
    file_bytes file;
    bitmap got = {0, 0, NULL, NULL};
    CHECK_MSG(file_read(&file, path, &r) && png_decode(&got, file.data, file.size, shown, &r), "%s", r.text);
    CHECK(got.width > 0 && got.height > 0);
    bitmap_free(&got);
    file_free(&file);
}

/* All PNG files of a directory and subdirectories down to `depth`. Returns the number of files. */
static int check_shared_in(const char *directory, int depth)
{
    DIR *d = opendir(directory);
    const struct dirent *entry;
    char path[1024];
    int n = 0;
    if (!d) return 0;
    while ((entry = readdir(d)) != NULL) {
        if (entry->d_name[0] == '.') continue;
        if (snprintf(path, sizeof path, "%s/%s", directory, entry->d_name) >= (int)sizeof path) continue;
        if (ends_in_png(entry->d_name)) {
            check_shared_png(path, entry->d_name);
            ++n;
        } else if (depth > 0) {
            n += check_shared_in(path, depth - 1);
        }
    }
    closedir(d);
    return n;
}

static void check_shared(void)
{
    const char *shared = getenv("LMB_SHARED");
    char path[512];
    if (!shared || !*shared) shared = "../shared";
    snprintf(path, sizeof path, "%s/data", shared);
    if (check_shared_in(path, 2) == 0) SKIP("shared pictures: no PNG under %s; set LMB_SHARED", path);
}

#else

static void check_files(void)
{
    report r = {""};
    CHECK(file_write("test_images.tmp", "first", 5, &r) && holds("test_images.tmp", "first"));
    CHECK(file_write("test_images.tmp", "second", 6, &r) && holds("test_images.tmp", "second"));
    remove("test_images.tmp");
}

static void check_shared(void)
{
    SKIP("shared pictures: directories are read on POSIX systems only");
}

#endif

static void check_report(void)
{
    report r = {""};
    char many[REPORT_TEXT + 88];
    memset(many, 'a', sizeof many);
    many[sizeof many - 1] = 0;
    CHECK(report_fail(&r, "a\nb: %d", 3) == 0 && strcmp(r.text, "a?b: 3") == 0);
    CHECK(report_fail(&r, "later") == 0 && strcmp(r.text, "a?b: 3") == 0);
    memset(&r, 0, sizeof r);
    CHECK(report_fail(&r, "%s", many) == 0 && strlen(r.text) == sizeof r.text - 2);
}

/* Work in pixels, estimated from headers only. */
static void work(void)
{
    static const uint8_t plain[] = {0xFF, 0xD8, 0xFF, 0xC0, 0, 11, 8, 0, 16, 0, 10, 1, 1, 0x11, 0, 0xFF, 0xDA, 0, 8, 1},
                         scans[] = {0xFF, 0xD8, 0xFF, 0xC2, 0, 11, 8, 0, 16, 0, 10, 1, 1, 0x11, 0, 0xFF, 0xDA, 0, 8, 1,
                                    0xFF, 0,    0xFF, 0xDA, 0, 8,  1, 0xFF, 0xFF, 0xDA, 0xFF};
    CHECK(picture_work(plain, sizeof plain) == 160);
    CHECK(picture_work(scans, sizeof scans) == 160 + 3 * 40);
    CHECK(picture_work(scans, 12) == 160 && picture_work(scans, 4) == 0);
}

void test_images(void)
{
    work();
    test_rng rng = {20260101};
    check_report();
    check_inflate_known();
    check_inflate_crafted();
    check_inflate_fixed();
    check_inflate_beyond();
    check_deflate(&rng);
    check_deflate_damage(&rng);
    check_png_kinds(&rng);
    check_png_prefixes(&rng);
    check_png_damage(&rng);
    check_png_order();
    check_png_headers();
    check_png_messages();
    check_png_written(&rng);
    check_ppm();
    check_ppm_kinds();
    check_ppm_refusals();
    check_pam_kinds();
    check_pam_refusals();
    check_foreign();
    check_stored();
    check_pfm_round(&rng);
    check_pfm_text();
    check_hdr(&rng);
    check_files();
    check_shared();
}
