/* io_pam.c: decodes PAM files into 8-bit pictures: header lines of a word and a value up to ENDHDR, then samples. */
#include "io_pam.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "../common/io_bytes.h"

enum { WIDTH, HEIGHT, DEPTH, MAXVAL, NUMBERS, TYPE_MAX = 40 };

typedef struct pam_reader {
    const uint8_t *data;
    size_t size, at;
    const char *name;
    report *r;
    uint32_t number[NUMBERS];
    char type[TYPE_MAX]; /* "": not given */
    uint32_t line;
} pam_reader;

/* A part of a line. */
typedef struct words {
    const uint8_t *at;
    size_t size;
} words;

static int is_blank(uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static int is_word(words w, const char *text) { return w.size == strlen(text) && memcmp(w.at, text, w.size) == 0; }

/* Removes the next word from the line and returns it; empty if there is none. */
static words next_word(words *line)
{
    words w;
    while (line->size > 0 && is_blank(*line->at)) {
        ++line->at;
        --line->size;
    }
    w.at = line->at;
    w.size = 0;
    while (w.size < line->size && !is_blank(w.at[w.size])) {
        ++w.size;
    }
    line->at += w.size;
    line->size -= w.size;
    return w;
}

/* Returns a number of 1 .. limit, or 0 if the word is no such number. limit: at most 2^28. */
static uint32_t number_of(words w, uint32_t limit)
{
    uint32_t value = 0;
    for (size_t i = 0; i < w.size; ++i) {
        if (w.at[i] < '0' || w.at[i] > '9') {
            return 0;
        }
        value = 10 * value + (uint32_t)(w.at[i] - '0');
        if (value > limit) {
            return 0;
        }
    }
    return value;
}

static int fail(const pam_reader *p, const char *what)
{
    return report_fail(p->r, "%s: line %u: %s", p->name, (unsigned)p->line, what);
}

static int read_number(pam_reader *p, int which, words line)
{
    static const uint32_t limits[NUMBERS] = {(uint32_t)PICTURE_MAX_PIXELS, (uint32_t)PICTURE_MAX_PIXELS, 4, 65535};
    static const char *const ranges[NUMBERS] = {"WIDTH: 1 to 2^28", "HEIGHT: 1 to 2^28", "DEPTH: 1 to 4 are read",
                                                "MAXVAL: 1 to 65535"};
    if (p->number[which] != 0) {
        return fail(p, "it stands there twice");
    }
    p->number[which] = number_of(next_word(&line), limits[which]);
    return (p->number[which] != 0 && next_word(&line).size == 0) || fail(p, ranges[which]);
}

static int read_type(pam_reader *p, words line)
{
    const words w = next_word(&line);
    if (w.size == 0 || w.size >= TYPE_MAX || next_word(&line).size > 0 || p->type[0] != '\0') {
        return fail(p, "TUPLTYPE: one word, once");
    }
    memcpy(p->type, w.at, w.size);
    p->type[w.size] = '\0';
    return 1;
}

/* Reads a line of the header. *is_end: it was ENDHDR. */
static int read_line(int *is_end, pam_reader *p)
{
    static const char *const names[NUMBERS] = {"WIDTH", "HEIGHT", "DEPTH", "MAXVAL"};
    const uint8_t *from = p->data + p->at, *stop = memchr(from, '\n', p->size - p->at);
    words line = {from, (size_t)((stop != NULL ? stop : p->data + p->size) - from)};
    ++p->line;
    if (stop == NULL) {
        return fail(p, "the header ends without ENDHDR and a line break");
    }
    p->at += line.size + 1;
    const words word = next_word(&line);
    *is_end = is_word(word, "ENDHDR");
    if (*is_end || word.size == 0 || word.at[0] == '#') {
        return 1;
    }
    for (int i = 0; i < NUMBERS; ++i) {
        if (is_word(word, names[i])) {
            return read_number(p, i, line);
        }
    }
    return is_word(word, "TUPLTYPE") ? read_type(p, line) : fail(p, "no word of a PAM header");
}

/* Checks that the type fits the depth. */
static int check_type(const pam_reader *p)
{
    static const struct {
        const char *name;
        uint32_t depth;
    } types[] = {{"BLACKANDWHITE", 1}, {"BLACKANDWHITE_ALPHA", 2}, {"GRAYSCALE", 1}, {"GRAYSCALE_ALPHA", 2}, {"RGB", 3},
                 {"RGB_ALPHA", 4}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
        if (strcmp(p->type, types[i].name) == 0) {
            if (types[i].depth != p->number[DEPTH]) {
                return report_fail(p->r, "%s: TUPLTYPE %s has DEPTH %u, not %u", p->name, p->type,
                                   (unsigned)types[i].depth, (unsigned)p->number[DEPTH]);
            }
            return i > 1 || p->number[MAXVAL] == 1 ||
                   report_fail(p->r, "%s: TUPLTYPE %s has MAXVAL 1, not %u", p->name, p->type,
                               (unsigned)p->number[MAXVAL]);
        }
    }
    return p->type[0] == '\0' ||
           report_fail(p->r, "%s: TUPLTYPE %s; BLACKANDWHITE, GRAYSCALE and RGB are read, with or without _ALPHA",
                       p->name, p->type);
}

static int read_header(pam_reader *p)
{
    static const char *const missing[NUMBERS] = {"WIDTH", "HEIGHT", "DEPTH", "MAXVAL"};
    int is_end = 0;
    if (!is_pam(p->data, p->size)) {
        return report_fail(p->r, "%s: not a PAM file: it does not begin with a line P7", p->name);
    }
    p->at = p->data[2] == '\r' && p->size > 3 && p->data[3] == '\n' ? 4 : 3;
    p->line = 1;
    while (!is_end) {
        if (!read_line(&is_end, p)) {
            return 0;
        }
    }
    for (int i = 0; i < NUMBERS; ++i) {
        if (p->number[i] == 0) {
            return report_fail(p->r, "%s: the header has no %s", p->name, missing[i]);
        }
    }
    return picture_fits(p->number[WIDTH], p->number[HEIGHT])
               ? check_type(p)
               : report_fail(p->r, "%s: %u x %u: at most 2^28 pixels are read", p->name, (unsigned)p->number[WIDTH],
                             (unsigned)p->number[HEIGHT]);
}

static int check_length(const pam_reader *p)
{
    const uint64_t left = p->size - p->at, need = (uint64_t)p->number[WIDTH] * p->number[HEIGHT] * p->number[DEPTH] *
                                                  (p->number[MAXVAL] > 255 ? 2 : 1);
    return left == need || report_fail(p->r, "%s: %" PRIu64 " bytes of pixels, but %u x %u take %" PRIu64 "%s", p->name,
                                       left, (unsigned)p->number[WIDTH], (unsigned)p->number[HEIGHT], need,
                                       left > need ? "; one picture is read" : "");
}

static int read_sample(uint32_t *out, pam_reader *p)
{
    *out = p->data[p->at++];
    if (p->number[MAXVAL] > 255) {
        *out = *out << 8 | p->data[p->at++];
    }
    return *out <= p->number[MAXVAL];
}

static uint8_t code_of(uint32_t sample, uint32_t max)
{
    return (uint8_t)(max == 65535 ? sample >> 8 : (sample * 255 + max / 2) / max);
}

static void put_texel(uint8_t to[4], const uint32_t *sample, uint32_t depth, uint32_t max)
{
    const int is_colour = depth > 2;
    for (int k = 0; k < 3; ++k) {
        to[k] = code_of(sample[is_colour ? k : 0], max);
    }
    to[3] = depth % 2 == 0 ? code_of(sample[depth - 1], max) : 255;
}

/* `is_16`: one sample per pixel; both bytes are kept. */
static int read_texels(uint8_t *texels, pam_reader *p, int is_16)
{
    const size_t count = (size_t)p->number[WIDTH] * p->number[HEIGHT];
    for (size_t i = 0; i < count; ++i) {
        uint32_t sample[4] = {0, 0, 0, 0};
        uint8_t *to = texels + 4 * i;
        for (uint32_t k = 0; k < p->number[DEPTH]; ++k) {
            if (!read_sample(&sample[k], p)) {
                return report_fail(p->r, "%s: pixel %u, %u: a sample over MAXVAL, before byte %.0f", p->name,
                                   (unsigned)(i % p->number[WIDTH]), (unsigned)(i / p->number[WIDTH]), (double)p->at);
            }
        }
        put_texel(to, sample, p->number[DEPTH], p->number[MAXVAL]);
        if (is_16) {
            to[0] = (uint8_t)(sample[0] >> 8);
            to[1] = (uint8_t)(sample[0] & 255);
        }
    }
    return 1;
}

static int decode(bitmap *out, const uint8_t *data, size_t size, const char *name, int is_16, report *r)
{
    pam_reader p;
    memset(out, 0, sizeof *out);
    memset(&p, 0, sizeof p);
    p.data = data;
    p.size = size;
    p.name = name;
    p.r = r;
    if (!read_header(&p)) {
        return 0;
    }
    if (is_16 && (p.number[DEPTH] != 1 || p.number[MAXVAL] < 256)) {
        return report_fail(r, "%s: DEPTH %u and MAXVAL %u; 1 and over 255 are read here", name,
                           (unsigned)p.number[DEPTH], (unsigned)p.number[MAXVAL]);
    }
    if (!check_length(&p)) {
        return 0;
    }
    out->texels = malloc((size_t)p.number[WIDTH] * p.number[HEIGHT] * 4); /* at most 2^30 */
    if (out->texels == NULL) {
        return report_fail(r, "%s: memory is short for %u x %u pixels", name, (unsigned)p.number[WIDTH],
                           (unsigned)p.number[HEIGHT]);
    }
    if (!read_texels(out->texels, &p, is_16)) {
        bitmap_free(out);
        return 0;
    }
    out->width = (int32_t)p.number[WIDTH];
    out->height = (int32_t)p.number[HEIGHT];
    return 1;
}

int pam_decode(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    return decode(out, data, size, name, 0, r);
}

int pam_decode_16(bitmap *out, const uint8_t *data, size_t size, const char *name, report *r)
{
    return decode(out, data, size, name, 1, r);
}

int32_t pam_channels(const uint8_t *data, size_t size)
{
    pam_reader p;
    report unheard = {""};
    memset(&p, 0, sizeof p);
    p.data = data;
    p.size = size;
    p.name = "";
    p.r = &unheard;
    return read_header(&p) ? (int32_t)p.number[DEPTH] : 3;
}
