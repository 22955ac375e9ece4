/* main_decodes.c: a picture as the tools decode it against what another program made of the same file.
 *
 *   codes FILE REFERENCE    8-bit codes; the reference is a raw PGM, PPM or PAM
 *   light FILE FLOATS       a PFM; the reference is its floats in this machine's order, bottom row first as in the file
 *   upright FILE REFERENCE  a PFM; the reference is a raw PGM, PPM or PAM, values of 0 to 1 rounded to its codes
 *   rgbe FILE FLOATS RGBE   an HDR; the references are Radiance's floats, half a step over the tools', and its bytes
 *   extract FILE PREFIX     writes a GLB's images to PREFIX0.png and so on; prints their names
 *
 * The first four print: pixels, values that differ, largest difference. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/common/io_bytes.h"
#include "../../tools/common/io_json.h"
#include "../../tools/picture/io_jpeg.h"
#include "../../tools/picture/picture_read.h"

typedef struct difference {
    uint64_t values; /* that differ */
    double largest;
} difference;

static void add(difference *d, double ours, double theirs)
{
    double off = fabs(ours - theirs);
    d->values += !(off <= 0);
    if (!(off <= d->largest))
        d->largest = off; /* NaN, too, which then stays */
}

static int print_difference(const difference *d, const stored_picture *p)
{
    printf("%" PRIu64 " %" PRIu64 " %g\n", (uint64_t)p->width * (uint64_t)p->height, d->values, d->largest);
    return 1;
}

/* --- reference pictures: what a Netpbm program writes --- */

typedef struct plain_picture {
    uint32_t width, height, depth, max;
    const uint8_t *samples;
} plain_picture;

/* "P5 w h m" or "P6 w h m", one white space behind each, without comments. */
static int read_pnm(plain_picture *out, const char *text, const uint8_t **end)
{
    int n = 0;
    char kind;
    if (sscanf(text, "P%c %" SCNu32 " %" SCNu32 " %" SCNu32 "%n", &kind, &out->width, &out->height, &out->max, &n) < 4)
        return 0;
    out->depth = kind == '5' ? 1 : kind == '6' ? 3 : 0;
    *end = (const uint8_t *)text + n + 1;
    return out->depth > 0;
}

static int read_pam(plain_picture *out, const char *text, const uint8_t **end)
{
    const char *stop = strstr(text, "ENDHDR\n"), *line = text;
    for (; stop && line < stop; line = strchr(line, '\n') + 1) {
        sscanf(line, "WIDTH %" SCNu32, &out->width);
        sscanf(line, "HEIGHT %" SCNu32, &out->height);
        sscanf(line, "DEPTH %" SCNu32, &out->depth);
        sscanf(line, "MAXVAL %" SCNu32, &out->max);
    }
    if (!stop)
        return 0;
    *end = (const uint8_t *)stop + 7;
    return 1;
}

static int read_plain(plain_picture *out, const file_bytes *file, const char *name, report *r)
{
    char head[256] = {0};
    const uint8_t *end = NULL;
    memset(out, 0, sizeof *out);
    memcpy(head, file->data, file->size < 255 ? file->size : 255);
    for (size_t i = 0; i < 255; ++i)
        head[i] = head[i] ? head[i] : '?'; /* pixels behind the header may be anything */
    int ok = memcmp(head, "P7\n", 3) == 0 ? read_pam(out, head, &end) : read_pnm(out, head, &end);
    if (!ok || !picture_fits(out->width, out->height) || out->depth < 1 || out->depth > 4 || out->max < 1)
        return report_fail(r, "%s: no raw PGM, PPM or PAM", name);
    size_t header = (size_t)((const char *)end - head);
    out->samples = file->data + header;
    if (file->size - header != (size_t)out->width * out->height * out->depth * (out->max > 255 ? 2 : 1))
        return report_fail(r, "%s: not as long as its header says", name);
    return 1;
}

static uint32_t sample_at(const plain_picture *p, size_t i)
{
    return p->max > 255 ? (uint32_t)p->samples[2 * i] << 8 | p->samples[2 * i + 1] : p->samples[i];
}

/* Its four codes: the high byte of 16 bits; of fewer than 8, repeated (their largest values divide 255). */
static void plain_texel(uint32_t out[4], const plain_picture *p, size_t pixel)
{
    const uint32_t colours = p->depth < 3 ? 1 : 3;
    uint32_t codes[4];
    for (uint32_t k = 0; k < p->depth; ++k) {
        uint32_t v = sample_at(p, pixel * p->depth + k);
        codes[k] = p->max == 65535 ? v >> 8 : v * (255 / p->max);
    }
    for (uint32_t k = 0; k < 3; ++k)
        out[k] = codes[colours == 1 ? 0 : k];
    out[3] = p->depth > colours ? codes[colours] : 255;
}

static int compare_codes(const stored_picture *p, const file_bytes *file, const char *name, report *r)
{
    plain_picture plain;
    difference d = {0, 0};
    if (!read_plain(&plain, file, name, r))
        return 0;
    if (!p->codes.texels || (uint32_t)p->width != plain.width || (uint32_t)p->height != plain.height)
        return report_fail(r, "%s: the sizes differ", name);
    if (plain.max != 65535 && 255 % plain.max != 0)
        return report_fail(r, "%s: a largest value of %u does not divide 255", name, (unsigned)plain.max);
    for (size_t i = 0; i < (size_t)plain.width * plain.height; ++i) {
        uint32_t texel[4];
        plain_texel(texel, &plain, i);
        for (size_t k = 0; k < 4; ++k)
            add(&d, p->codes.texels[4 * i + k], texel[k]);
    }
    return print_difference(&d, p);
}

/* --- light --- */

static float float_at(const file_bytes *file, size_t i)
{
    float v;
    memcpy(&v, file->data + 4 * i, 4);
    return v;
}

static int check_floats(const stored_picture *p, const file_bytes *floats, const char *name, report *r)
{
    size_t values = (size_t)p->width * (size_t)p->height * (size_t)p->channels;
    if (!p->light.pixels || floats->size != 4 * values)
        return report_fail(r, "%s: %zu bytes are not this picture's floats", name, floats->size);
    return 1;
}

/* Bit for bit, so that NaN and the sign of 0 count. */
static int compare_light(const stored_picture *p, const file_bytes *floats, const char *name, report *r)
{
    difference d = {0, 0};
    if (!check_floats(p, floats, name, r))
        return 0;
    const size_t row = (size_t)p->width * (size_t)p->channels, height = (size_t)p->height;
    for (size_t i = 0; i < row * height; ++i) {
        float theirs = float_at(floats, (height - 1 - i / row) * row + i % row), ours = p->light.pixels[i];
        if (memcmp(&ours, &theirs, 4) == 0)
            continue;
        add(&d, (double)ours, (double)theirs);
        d.values += ours == theirs; /* zeros of either sign */
    }
    return print_difference(&d, p);
}

/* In codes of the reference; what is not in 0 .. 1 has none and is left out. */
static int compare_upright(const stored_picture *p, const file_bytes *file, const char *name, report *r)
{
    plain_picture plain;
    difference d = {0, 0};
    if (!read_plain(&plain, file, name, r))
        return 0;
    if (!p->light.pixels || (uint32_t)p->width != plain.width || (uint32_t)p->height != plain.height ||
        (uint32_t)p->channels != plain.depth)
        return report_fail(r, "%s: the sizes differ", name);
    for (size_t i = 0; i < (size_t)plain.width * plain.height * plain.depth; ++i) {
        const double v = (double)p->light.pixels[i];
        if (v >= 0 && v <= 1)
            add(&d, floor(v * plain.max + 0.5), sample_at(&plain, i));
    }
    return print_difference(&d, p);
}

/* Mantissa m and exponent e are m 2^(e - 136) here, (m + 1/2) 2^(e - 136) in Radiance; both are exact. */
static int compare_rgbe(const stored_picture *p, const file_bytes *floats, const file_bytes *rgbe, report *r)
{
    difference d = {0, 0};
    if (!check_floats(p, floats, "floats", r))
        return 0;
    const size_t values = (size_t)p->width * (size_t)p->height * 3;
    if (p->channels != 3 || rgbe->size != values / 3 * 4)
        return report_fail(r, "%zu bytes are not this picture's RGBE", rgbe->size);
    for (size_t i = 0; i < values; ++i) {
        const int e = rgbe->data[i / 3 * 4 + 3];
        const double half = e ? ldexp(0.5, e - 136) : 0;
        add(&d, (double)p->light.pixels[i] + half, (double)float_at(floats, i));
    }
    return print_difference(&d, p);
}

/* --- images inside a GLB --- */

/* JSON chunk first, then the binary one: 12 bytes of header, 8 before each chunk. */
static const uint8_t *find_binary(const file_bytes *file, size_t *json_size, size_t *size)
{
    if (file->size < 28 || memcmp(file->data, "glTF", 4) != 0)
        return NULL;
    *json_size = get_u32_le(file->data + 12);
    if (*json_size > file->size - 28)
        return NULL;
    *size = get_u32_le(file->data + 20 + *json_size);
    return *size <= file->size - 28 - *json_size ? file->data + 28 + *json_size : NULL;
}

static uint32_t child(const json *doc, uint32_t array, uint32_t index)
{
    uint32_t node = json_first(doc, array);
    while (index-- > 0)
        node = json_next(doc, node);
    return node;
}

static int write_image(const json *doc, uint32_t image_node, const file_bytes *binary, const char *stem, report *r)
{
    uint32_t view = JSON_NONE, at = 0, size = 0;
    char path[512];
    if (!json_read_uint(&view, doc, json_member(doc, image_node, "bufferView"), r))
        return 0;
    if (view == JSON_NONE)
        return 1; /* a file of its own */
    uint32_t node = child(doc, json_member(doc, 0, "bufferViews"), view);
    if (!json_read_uint(&at, doc, json_member(doc, node, "byteOffset"), r) ||
        !json_read_uint(&size, doc, json_member(doc, node, "byteLength"), r))
        return 0;
    if (at > binary->size || size > binary->size - at)
        return report_fail(r, "%s: an image outside the file", doc->name);
    snprintf(path, sizeof path, "%.400s.%s", stem, is_jpeg(binary->data + at, size) ? "jpg" : "png");
    puts(path);
    return file_write(path, binary->data + at, size, r);
}

static int extract(const file_bytes *file, const char *name, const char *prefix, report *r)
{
    file_bytes binary;
    json doc;
    size_t json_size;
    int ok = 1, index = 0;
    binary.data = (uint8_t *)find_binary(file, &json_size, &binary.size);
    if (!binary.data)
        return report_fail(r, "%s: no GLB of two chunks", name);
    if (!json_parse(&doc, (const char *)file->data + 20, json_size, name, r))
        return 0;
    uint32_t node = json_first(&doc, json_member(&doc, 0, "images"));
    for (; ok && node != JSON_NONE; node = json_next(&doc, node), ++index) {
        char path[420];
        snprintf(path, sizeof path, "%.390s%d", prefix, index);
        ok = write_image(&doc, node, &binary, path, r);
    }
    json_free(&doc);
    return ok;
}

/* --- the command --- */

static int run(int argc, char **argv, file_bytes files[3], report *r)
{
    const char *verb = argv[1];
    stored_picture p;
    int ok = 0;
    if (strcmp(verb, "extract") == 0)
        return extract(&files[0], argv[2], argv[3], r);
    if (!picture_read(&p, files[0].data, files[0].size, argv[2], r))
        return 0;
    if (strcmp(verb, "codes") == 0)
        ok = compare_codes(&p, &files[1], argv[3], r);
    else if (strcmp(verb, "light") == 0)
        ok = compare_light(&p, &files[1], argv[3], r);
    else if (strcmp(verb, "upright") == 0)
        ok = compare_upright(&p, &files[1], argv[3], r);
    else if (strcmp(verb, "rgbe") == 0 && argc == 5)
        ok = compare_rgbe(&p, &files[1], &files[2], r);
    stored_picture_free(&p);
    return ok || report_fail(r, "usage: see the source's first lines");
}

int main(int argc, char **argv)
{
    file_bytes files[3] = {{NULL, 0}, {NULL, 0}, {NULL, 0}};
    report r = {""};
    int ok = argc == 4 || argc == 5, last = argc > 1 && strcmp(argv[1], "extract") == 0 ? 3 : argc;
    for (int i = 2; ok && i < last; ++i)
        ok = file_read(&files[i - 2], argv[i], &r);
    ok = ok && run(argc, argv, files, &r);
    for (int i = 0; i < 3; ++i)
        file_free(&files[i]);
    if (!ok)
        fprintf(stderr, "%s\n", r.text[0] ? r.text : "usage: see the source's first lines");
    return !ok;
}
