/* model_build.c: a loaded model's memory, and what the readers build it with: notes, neighbouring files, textures. */
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

/* Room for one more block; the list doubles. */
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

/* count * size zeroed bytes in m's list, or NULL; without a budget. */
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

void build_note(model_build *b, const char *format, ...)
{
    model_notes *n = b->notes;
    const uint32_t room = sizeof n->line / sizeof n->line[0];
    char line[sizeof n->line[0]];
    va_list args;
    uint32_t i;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    for (i = 0; i < n->count; ++i)
        if (strcmp(n->line[i], line) == 0)
            return;
    if (n->count == room) {
        snprintf(n->line[room - 1], sizeof line, "more notes than %u; the rest is left out", (unsigned)room);
        return;
    }
    memcpy(n->line[n->count++], line, sizeof line);
}

void build_note_count(model_build *b, const char *what, uint32_t count)
{
    if (count)
        build_note(b, "%s: %u", what, (unsigned)count);
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

/* Room for one more file and its path; NULL with `r` set. */
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

int build_read(model_build *b, file_bytes *out, const char *path, report *r)
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
    const char *slash = strrchr(b->path, '/');
    size_t folder, n = strlen(name);
#if defined(_WIN32)
    const char *back = strrchr(b->path, '\\');
    if (back && (!slash || back > slash))
        slash = back;
#endif
    folder = slash ? (size_t)(slash - b->path) + 1 : 0;
    if (folder >= cap || n >= cap - folder)
        return report_fail(r, "%s: a path beside it is longer than %u bytes; move the model", b->path, (unsigned)cap);
    memcpy(out, b->path, folder);
    memcpy(out + folder, name, n + 1);
    return 1;
}

/* Level 0 to the model's memory, with room for `levels`. */
static uint8_t *keep_texels(model_build *b, const bitmap *map, int32_t levels, const char *name, report *why)
{
    size_t bytes = lmb_texture_bytes(map->width, map->height, levels);
    uint8_t *texels = NULL;
    if (bytes == 0) {
        report_fail(why, "%s: %dx%d pixels; sides may have up to %d", name, (int)map->width, (int)map->height,
                    LMB_MAX_SIDE);
        return NULL;
    }
    texels = (uint8_t *)add_block(b->out, bytes, 1);
    if (!texels) {
        report_fail(why, "%s: no memory left for textures; shrink them", name);
        return NULL;
    }
    b->out->facts.texel_bytes += bytes;
    memcpy(texels, map->texels, (size_t)map->width * (size_t)map->height * 4);
    return texels;
}

/* A picture pays for its bytes too: the same ones may be shown under any number of names, and each is decoded anew. */
int build_picture(model_build *b, bitmap *out, const uint8_t *data, size_t size, const char *name, report *why)
{
    const uint64_t pixels = picture_pixels(data, size);
    memset(out, 0, sizeof *out);
    if (pixels > b->pixel_budget)
        return report_fail(why, "%s: %" PRIu64 " pixels are more than the model's pictures may still have, which is %"
                           PRIu64 "; shrink them", name, pixels, b->pixel_budget);
    b->pixel_budget -= pixels;
    if (size > b->pixel_budget)
        return report_fail(why, "%s: %zu bytes; the model's pictures have been decoded too often", name, size);
    b->pixel_budget -= size;
    return picture_read_codes(out, data, size, name, why);
}

int build_texels(model_build *b, lmb_texture *out, const uint8_t *data, size_t size, int kind, const char *name,
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
