/* model_build.c: memory of a loaded model, and helpers for the readers: notes, files beside the model, textures. */
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../picture/picture_read.h"
#include "model_build.h"

void model_free(model *m)
{
    uint32_t i;
    for (i = 0; i < m->block_count; ++i)
        free(m->blocks[i]);
    free(m->blocks);
    memset(m, 0, sizeof *m);
}

/* Makes room for one more block; the list doubles. */
static int reserve_block(model *m)
{
    uint32_t cap = m->block_cap ? m->block_cap * 2 : 64;
    void **grown;
    if (m->block_count < m->block_cap)
        return 1;
    if (cap > UINT32_MAX / 2 / sizeof *grown)
        return 0;
    grown = (void **)realloc(m->blocks, cap * sizeof *grown);
    if (!grown)
        return 0;
    m->blocks = grown;
    m->block_cap = cap;
    return 1;
}

/* Allocates count * size zeroed bytes in m's list, or NULL; no budget. */
static void *add_block(model *m, uint64_t count, size_t size)
{
    void *block;
    if (count == 0)
        count = 1;
    if (count > SIZE_MAX / size || !reserve_block(m))
        return NULL;
    block = calloc((size_t)count, size);
    if (block) {
        m->blocks[m->block_count++] = block;
        m->facts.memory_bytes += count * size;
    }
    return block;
}

static void *build_alloc(model_build *b, model *m, uint64_t count, size_t size)
{
    void *block;
    if (count > b->budget / size) {
        report_fail(b->r, "%s: asks for more than %d bytes of memory a byte of file; it is damaged or made to harm",
                    b->path, MODEL_BYTES_PER_BYTE);
        return NULL;
    }
    b->budget -= count * size;
    block = add_block(m, count, size);
    if (!block)
        report_fail(b->r, "%s: out of memory; load a smaller model", b->path);
    return block;
}

void *build_keep(model_build *b, uint64_t count, size_t size) { return build_alloc(b, b->out, count, size); }

void *build_scratch(model_build *b, uint64_t count, size_t size) { return build_alloc(b, &b->scratch, count, size); }

int build_materials(model_build *b, uint64_t count)
{
    b->materials = (lmb_material *)build_keep(b, count, sizeof *b->materials);
    return b->materials != NULL;
}

static void add_note(model_build *b, int kind, const char *format, va_list args)
{
    model_notes *n = b->notes;
    const uint32_t room = sizeof n->line / sizeof n->line[0];
    char line[sizeof n->line[0]];
    uint32_t i;
    vsnprintf(line, sizeof line, format, args);
    for (i = 0; i < n->count; ++i)
        if (strcmp(n->line[i], line) == 0)
            return;
    if (n->count == room) {
        snprintf(n->line[room - 1], sizeof line, "more notes than %u; the rest is left out", (unsigned)room);
        n->kind[room - 1] = MODEL_NOTE_PLAIN;
        return;
    }
    n->kind[n->count] = (uint8_t)kind;
    memcpy(n->line[n->count++], line, sizeof line);
}

void build_note(model_build *b, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    add_note(b, MODEL_NOTE_PLAIN, format, args);
    va_end(args);
}

void build_note_of(model_build *b, int kind, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    add_note(b, kind, format, args);
    va_end(args);
}

void build_note_count(model_build *b, const char *what, uint32_t count)
{
    if (count)
        build_note(b, "%s: %u", what, (unsigned)count);
}

void build_note_count_of(model_build *b, int kind, const char *what, uint32_t count)
{
    if (count)
        build_note_of(b, kind, "%s: %u", what, (unsigned)count);
}

float build_float(double v) { return v > 3.4e38 ? (float)INFINITY : v < -3.4e38 ? -(float)INFINITY : (float)v; }

float build_uv(double v) { return v > -1e6 && v < 1e6 ? (float)v : 0.0f; }

lmb_vec3 build_normal(const double v[3], uint32_t *zeros)
{
    const double d = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    lmb_vec3 n = {0.0f, 1.0f, 0.0f};
    if (!(d > 1e-20 && d < 1e30)) {
        ++*zeros;
        return n;
    }
    n.x = (float)(v[0] / d);
    n.y = (float)(v[1] / d);
    n.z = (float)(v[2] / d);
    return n;
}

void build_normal_code(model_build *b, int16_t out[2], const double v[3])
{
    uint32_t zeros = 0;
    lmb_octahedral_encode(out, build_normal(v, &zeros));
    if (zeros)
        out[0] = out[1] = BUILD_NO_NORMAL;
    b->marked_normals += zeros;
}

uint16_t build_share(double v) { return v > 0 ? v < 1 ? (uint16_t)(v * 65535 + 0.5) : 65535 : 0; }

uint16_t build_linear(double v) { return build_share(v > 0 ? sqrt(v) : 0); }

/* A table converts 8-bit codes, which are the usual case. */
uint16_t build_colour(const model_build *b, double code)
{
    if (b->linear_colours || !(code > 0 && code < 1))
        return build_linear(code);
    const int whole = (int)(code * 255 + 0.5);
    return fabs(code * 255 - whole) < 1e-9 ? b->linear_of[whole] : build_linear(srgb_curve(code));
}

/* The byte of channel k with this code, or the next one, as floats round; or -1. */
static int byte_of(uint16_t code, size_t k)
{
    const double root = code / 65535.0, v = k % 4 < 3 ? root * root : root;
    const int byte = (int)(v * 255 + 0.5);
    return abs((k % 4 < 3 ? build_linear(byte / 255.0) : build_share(byte / 255.0)) - code) <= 1 ? byte : -1;
}

uint8_t build_narrow(uint16_t *codes, size_t n)
{
    uint8_t *to = (uint8_t *)codes;
    size_t i;
    for (i = 0; i < 4 * n; ++i)
        if (byte_of(codes[i], i) < 0)
            return LMB_COLOUR_RGBA16;
    for (i = 0; i < 4 * n; ++i) { /* each byte lies before the codes that are still to be read */
        uint16_t code;
        memcpy(&code, (const uint8_t *)codes + 2 * i, sizeof code);
        to[i] = (uint8_t)byte_of(code, i);
    }
    return LMB_COLOUR_RGBA8;
}

/* a//b and a/./b are a/b; ".." stays, as it may lead through a link. */
static void tidy_path(char *path)
{
    char *to = path;
    const char *from = path;
    while (*from) {
        const int at_start = from == path || from[-1] == '/';
        if (at_start && from[0] == '.' && from[1] == '/')
            from += 2;
        else if (at_start && from != path && from[0] == '/')
            ++from;
        else
            *to++ = *from++;
    }
    *to = '\0';
}

/* Makes room for one more file and the path; NULL with `r` set. */
static build_neighbour *add_neighbour(model_build *b, const char *path, report *r)
{
    const size_t bytes = strlen(path) + 1;
    build_neighbour *grown, *to;
    if (b->neighbour_count == b->neighbour_cap) {
        const uint32_t cap = b->neighbour_cap ? 2 * b->neighbour_cap : 16;
        grown = cap > UINT32_MAX / 2 / sizeof *grown ? NULL
                                                     : (build_neighbour *)realloc(b->neighbours, cap * sizeof *grown);
        if (!grown)
            return report_fail(r, "%s: out of memory; load a smaller model", path), NULL;
        b->neighbours = grown;
        b->neighbour_cap = cap;
    }
    to = &b->neighbours[b->neighbour_count];
    memset(to, 0, sizeof *to);
    to->path = (char *)malloc(bytes);
    if (!to->path)
        return report_fail(r, "%s: out of memory; load a smaller model", path), NULL;
    memcpy(to->path, path, bytes);
    return to;
}

/* If the system lacks memory or files, the whole model fails: only defects of the model itself may be skipped. */
static int pass_on(model_build *b, const report *why)
{
    return report_is_system(why) ? report_fail_system(b->r, "%s", why->text) : 0;
}

/* Returns the length of the folder part of the model's path. */
static size_t folder_size(const model_build *b)
{
    const char *slash = strrchr(b->path, '/');
#if defined(_WIN32)
    const char *back = strrchr(b->path, '\\');
    if (back && (!slash || back > slash))
        slash = back;
#endif
    return slash ? (size_t)(slash - b->path) + 1 : 0;
}

static int read_neighbour(model_build *b, file_bytes *out, const char *path, report *r)
{
    char tidy[MODEL_PATH_MAX];
    build_neighbour *to;
    uint32_t i;
    snprintf(tidy, sizeof tidy, "%s", path);
    tidy_path(tidy);
    for (i = 0; i < b->neighbour_count; ++i)
        if (strcmp(b->neighbours[i].path, tidy) == 0) {
            *out = b->neighbours[i].file;
            return 1;
        }
    if (!file_is_below(path, b->path, folder_size(b), r))
        return 0;
    if (strcmp(path, "-") == 0)
        return report_fail(r, "-: a file of this name beside the model is not read");
    if (!file_is_plain(path, r))
        return 0;
    to = add_neighbour(b, tidy, r);
    if (!to)
        return 0;
    if (!file_read(&to->file, path, r)) {
        free(to->path);
        return 0;
    }
    ++b->neighbour_count;
    *out = to->file;
    b->budget += (uint64_t)out->size * MODEL_BYTES_PER_BYTE;
    b->pixel_budget += (uint64_t)out->size * MODEL_PIXELS_PER_BYTE;
    b->out->facts.neighbour_bytes += out->size;
    return 1;
}

int build_read(model_build *b, file_bytes *out, const char *path, report *r)
{
    return read_neighbour(b, out, path, r) || pass_on(b, r);
}

void build_forget(model_build *b)
{
    uint32_t i;
    for (i = 0; i < b->neighbour_count; ++i) {
        free(b->neighbours[i].path);
        file_free(&b->neighbours[i].file);
    }
    free(b->neighbours);
}

int build_is_relative(const char *name)
{
    const size_t n = strcspn(name, ":/\\");
    return name[0] != '\0' && name[0] != '/' && name[0] != '\\' && name[n] != ':';
}

int build_sibling(char *out, size_t cap, const model_build *b, const char *name, report *r)
{
    const size_t folder = folder_size(b), n = strlen(name);
    if (folder >= cap || n >= cap - folder)
        return report_fail(r, "%s: a path beside it is longer than %u bytes; move the model", b->path, (unsigned)cap);
    memcpy(out, b->path, folder);
    memcpy(out + folder, name, n + 1);
    return 1;
}

/* Makes a decoded image the model's level 0, with room for `levels` after it. Does not copy, because large images
 * would be in memory twice. */
static uint8_t *keep_texels(model_build *b, bitmap *map, int32_t levels, const char *name, report *why)
{
    const size_t bytes = lmb_texture_bytes(map->width, map->height, levels);
    model *m = b->out;
    uint8_t *texels = NULL;
    if (bytes == 0) {
        report_fail(why, "%s: %dx%d pixels; sides may have up to %d", name, (int)map->width, (int)map->height,
                    LMB_MAX_SIDE);
        return NULL;
    }
    texels = reserve_block(m) ? (uint8_t *)realloc(map->texels, bytes) : NULL;
    if (!texels) {
        report_fail(why, "%s: no memory left for textures; shrink them", name);
        pass_on(b, why);
        return NULL;
    }
    map->texels = NULL;
    m->blocks[m->block_count++] = texels;
    m->facts.memory_bytes += bytes;
    m->facts.texel_bytes += bytes;
    return texels;
}

/* The bytes of an image count too, because a decoder may read all of them before it finds an error. */
static int pay_picture(model_build *b, uint64_t pixels, size_t size, const char *name, report *why)
{
    if (pixels > b->pixel_budget && pixels <= b->large_picture)
        b->large_picture = 0;
    else if (pixels > b->pixel_budget)
        return report_fail(why, "%s: %" PRIu64 " pixels are more than the model's pictures may still have, which is %"
                           PRIu64 " (%d for each byte of the files); shrink them", name, pixels,
                           b->pixel_budget > b->large_picture ? b->pixel_budget : b->large_picture,
                           MODEL_PIXELS_PER_BYTE);
    else
        b->pixel_budget -= pixels;
    if (size > b->pixel_budget)
        return report_fail(why, "%s: %zu bytes; the model's pictures have been decoded too often", name, size);
    b->pixel_budget -= size;
    return 1;
}

int build_picture(model_build *b, bitmap *out, const uint8_t *data, size_t size, const char *name, report *why)
{
    memset(out, 0, sizeof *out);
    if (!pay_picture(b, picture_work(data, size), size, name, why))
        return 0;
    if (!picture_read_codes(out, data, size, name, why))
        return pass_on(b, why);
    if (out->note != NULL)
        build_note(b, "%s: %s", name, out->note);
    return 1;
}

/* --- pictures that are the same byte for byte --- */

enum { HASHED_PER_PIXEL = 8 }; /* bytes compared in about the time of decoding one pixel */

static uint64_t hash_of(const uint8_t *data, size_t size)
{
    uint64_t hash = size, word;
    for (size_t at = 0; at < size; at += sizeof word) {
        const size_t n = size - at < sizeof word ? size - at : sizeof word;
        word = 0;
        memcpy(&word, data + at, n);
        hash = (hash ^ word) * UINT64_C(0x9E3779B97F4A7C15);
        hash ^= hash >> 32;
    }
    return hash;
}

/* Returns the slot of these bytes, or the free slot for them. */
static uint32_t *slot_of(const model_build *b, uint64_t hash, const uint8_t *data, size_t size)
{
    const uint32_t mask = b->content_slot_count - 1;
    uint32_t at = (uint32_t)hash & mask;
    for (; b->content_slots[at] != 0; at = (at + 1) & mask) {
        const build_content *c = &b->contents[b->content_slots[at] - 1];
        if (c->hash == hash && c->size == size && (c->data == data || memcmp(c->data, data, size) == 0))
            break;
    }
    return &b->content_slots[at];
}

/* Doubles the room and inserts all slots again. */
static int grow_contents(model_build *b)
{
    const uint32_t slots = b->content_slot_count > 0 ? 2 * b->content_slot_count : 32;
    build_content *grown = (build_content *)build_scratch(b, slots / 2, sizeof *grown);
    uint32_t *table = (uint32_t *)build_scratch(b, slots, sizeof *table);
    if (!grown || !table)
        return 0;
    if (b->content_count > 0)
        memcpy(grown, b->contents, b->content_count * sizeof *grown);
    b->contents = grown;
    b->content_slots = table;
    b->content_slot_count = slots;
    for (uint32_t i = 0; i < b->content_count; ++i)
        *slot_of(b, grown[i].hash, grown[i].data, grown[i].size) = i + 1;
    return 1;
}

/* Returns the index of these bytes; comparing known ones counts as work too. */
static int find_content(uint32_t *out, model_build *b, const uint8_t *data, size_t size, const char *name, report *why)
{
    const uint64_t price = size / HASHED_PER_PIXEL + 1;
    if (price > b->pixel_budget)
        return report_fail(why, "%s: the model's pictures have been decoded too often; name each once", name);
    b->pixel_budget -= price;
    if (2 * b->content_count == b->content_slot_count && !grow_contents(b))
        return 0;
    const uint64_t hash = hash_of(data, size);
    uint32_t *slot = slot_of(b, hash, data, size);
    if (*slot == 0) {
        build_content *c = &b->contents[b->content_count];
        c->data = data;
        c->size = size;
        c->hash = hash;
        *slot = ++b->content_count;
    }
    *out = *slot - 1;
    return 1;
}

static int decode_texels(model_build *b, lmb_texture *out, const uint8_t *data, size_t size, int kind, const char *name,
                         report *why)
{
    bitmap map;
    int32_t levels;
    uint8_t *texels;
    if (!build_picture(b, &map, data, size, name, why))
        return 0;
    levels = kind != TEXELS_PLAIN ? lmb_texture_level_count(map.width, map.height) : 1;
    texels = keep_texels(b, &map, levels, name, why);
    if (texels) {
        out->texels = texels;
        out->width = (uint16_t)map.width;
        out->height = (uint16_t)map.height;
        out->levels = (uint8_t)levels;
        (kind == TEXELS_NORMALS ? lmb_normal_map_mips : lmb_texture_mips)(texels, map.width, map.height, levels);
    }
    bitmap_free(&map);
    return texels != NULL;
}

int build_texels(model_build *b, lmb_texture *out, const uint8_t *data, size_t size, int kind, const char *name,
                 uint32_t *content, report *why)
{
    uint32_t at = 0;
    if (!find_content(&at, b, data, size, name, why))
        return 0;
    lmb_texture *known = &b->contents[at].texels[kind];
    if (!known->texels && !decode_texels(b, known, data, size, kind, name, why))
        return 0;
    out->texels = known->texels;
    out->width = known->width;
    out->height = known->height;
    out->levels = known->levels;
    if (content != NULL)
        *content = at;
    return 1;
}
