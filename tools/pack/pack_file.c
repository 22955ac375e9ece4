/* pack_file.c: joins the parts to a .lmp; converts a .lmp to the other byte order. */
#include <stdlib.h>
#include <string.h>

#include "../common/checksum.h"
#include "pack.h"

static const uint8_t words_each[LMB_PACK_KINDS] = LMB_PACK_WORDS_EACH;

enum { ALIGNMENT = 16 }; /* of parts, for cache lines and for copying hardware with large units */

/* Parts in the order in which they are read. */
static const int order[] = {LMB_PACK_SCENE, LMB_PACK_MESHES, LMB_PACK_MATERIALS, LMB_PACK_TEXTURES, LMB_PACK_INSTANCES,
                            LMB_PACK_LIGHTS, LMB_PACK_CAMERAS, LMB_PACK_NAMES, LMB_PACK_NODES, LMB_PACK_TRACKS,
                            LMB_PACK_KEYS, LMB_PACK_VERTEX_LIGHT, LMB_PACK_TRANSFER, LMB_PACK_VERTICES,
                            LMB_PACK_INDICES, LMB_PACK_TEXELS};
enum { PARTS = sizeof order / sizeof *order };

static uint32_t aligned(uint32_t at) { return (at + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT; }

/* Converts offsets in records of a kind: `count` words from word `first` on. */
static void set_offsets(uint8_t *file, const uint32_t *at, const pack *p, int kind, int first, int count, int to)
{
    const size_t each = words_each[kind], records = p->part[kind].size / 4 / each;
    uint32_t *word = (uint32_t *)(void *)(file + at[kind]) + first;
    for (size_t i = 0; i < records; ++i, word += each) {
        for (int k = 0; k < count; ++k) {
            word[k] = word[k] != 0 ? word[k] - 4 + at[to] : 0;
        }
    }
}

int pack_file(file_bytes *out, const pack *p, report *r)
{
    uint32_t head[LMB_PACK_HEADER_WORDS] = {0, 0x01020304u}, at[LMB_PACK_KINDS] = {0};
    uint64_t bytes = sizeof head;
    memset(out, 0, sizeof *out);
    for (int i = 0; i < PARTS; ++i) {
        if (p->part[order[i]].is_short) {
            return report_fail(r, "not enough memory, or over 2 GB; a smaller model, or smaller textures");
        }
        head[3] += p->part[order[i]].size > 0;
    }
    bytes += 4 * LMB_PACK_PART_WORDS * (uint64_t)head[3];
    for (int i = 0; i < PARTS; ++i) {
        if (p->part[order[i]].size > 0) {
            bytes = aligned((uint32_t)bytes);
            at[order[i]] = (uint32_t)bytes;
            bytes += p->part[order[i]].size;
        }
        if (bytes > UINT32_MAX / 2) {
            return report_fail(r, "a file of %.0f MB is too large; a smaller model, or smaller textures",
                               (double)bytes * 1e-6);
        }
    }
    out->data = calloc((size_t)bytes, 1);
    if (out->data == NULL) {
        return report_fail(r, "not enough memory for a file of %.0f MB", (double)bytes * 1e-6);
    }
    out->size = (size_t)bytes;
    memcpy(head, "LMP", 3);
    ((uint8_t *)head)[3] = LMB_PACK_VERSION;
    head[2] = (uint32_t)bytes;
    memcpy(out->data, head, sizeof head);
    uint32_t *table = (uint32_t *)(void *)out->data + LMB_PACK_HEADER_WORDS;
    for (int i = 0; i < PARTS; ++i) {
        const pack_buffer *part = &p->part[order[i]];
        if (part->size > 0) {
            *table++ = (uint32_t)order[i];
            *table++ = at[order[i]];
            *table++ = (uint32_t)part->size;
            *table++ = 0;
            memcpy(out->data + at[order[i]], part->data, part->size);
        }
    }
    set_offsets(out->data, at, p, LMB_PACK_MESHES, 3, 5, LMB_PACK_VERTICES);
    set_offsets(out->data, at, p, LMB_PACK_MESHES, 8, 1, LMB_PACK_INDICES);
    set_offsets(out->data, at, p, LMB_PACK_TEXTURES, 0, 1, LMB_PACK_TEXELS);
    set_offsets(out->data, at, p, LMB_PACK_TRACKS, 2, 2, LMB_PACK_KEYS);
    checksum_put(out, LMB_PACK_HEADER_WORDS);
    return 1;
}

/* --- the other byte order ----------------------------------------------------------------------------------------- */

static void swap(void *data, size_t count, size_t each)
{
    uint8_t *p = data;
    for (size_t i = 0; i < count; ++i, p += each) {
        for (size_t a = 0, b = each - 1; a < b; ++a, --b) {
            const uint8_t v = p[a];
            p[a] = p[b];
            p[b] = v;
        }
    }
}

static void swap_at(uint8_t *file, const void *in_it, size_t count, size_t each)
{
    if (in_it != NULL) {
        swap(file + ((const uint8_t *)in_it - file), count, each);
    }
}

/* An offset of 0 means no data. */
static const void *at_offset(const lmb_pack *p, uint32_t offset) { return offset != 0 ? p->data + offset / 4 : NULL; }

void pack_streams(lmb_mesh *out, const lmb_pack *p, uint32_t i)
{
    const uint32_t *w = p->part[LMB_PACK_MESHES] + LMB_PACK_MESH_WORDS * (size_t)i;
    memset(out, 0, sizeof *out);
    out->vertex_count = w[0];
    out->triangle_count = w[1];
    out->position_format = (uint8_t)(w[2] & 255u);
    out->uv_format = (uint8_t)(w[2] >> 8 & 255u);
    out->index_format = (uint8_t)(w[2] >> 16 & 255u);
    out->colour_format = (uint8_t)(w[2] >> 28);
    out->positions = at_offset(p, w[3]);
    out->normals = at_offset(p, w[4]);
    out->tangents = at_offset(p, w[5]);
    out->uvs = at_offset(p, w[6]);
    out->colours = at_offset(p, w[7]);
    out->indices = at_offset(p, w[8]);
}

static void swap_mesh(uint8_t *file, const lmb_mesh *m)
{
    const size_t vertices = m->vertex_count, corners = 3 * (size_t)m->triangle_count;
    const int is_short = m->position_format == LMB_POSITION_I16;
    swap_at(file, m->positions, vertices * (is_short ? 4 : 3), is_short ? 2 : 4);
    swap_at(file, m->normals, 2 * vertices, 2);
    swap_at(file, m->tangents, 2 * vertices, 2);
    swap_at(file, m->uvs, 2 * vertices, m->uv_format == LMB_UV_U16 ? 2 : 4);
    if (m->colour_format == LMB_COLOUR_RGBA16)
        swap_at(file, m->colours, 4 * vertices, 2);
    swap_at(file, m->indices, corners, m->index_format == LMB_INDEX_U16 ? 2 : 4);
}

/* Swaps a file. Each stream belongs to one mesh, and they are in order; texels may be shared by several textures. */
void pack_swap(file_bytes *inout, const lmb_pack *p)
{
    uint8_t *file = inout->data;
    const uint8_t *done = file;
    for (uint32_t i = 0; i < p->count[LMB_PACK_MESHES]; ++i) {
        lmb_mesh m;
        pack_streams(&m, p, i);
        swap_mesh(file, &m);
    }
    for (uint32_t i = 0; i < p->count[LMB_PACK_TEXTURES]; ++i) {
        const uint32_t *w = p->part[LMB_PACK_TEXTURES] + LMB_PACK_TEXTURE_WORDS * (size_t)i;
        const uint8_t *texels = at_offset(p, w[0]);
        if ((w[2] >> 8 & 255u) == LMB_TEXELS_RGB565 && texels > done) {
            swap_at(file, texels,
                    lmb_texture_bytes((int32_t)(w[1] & 65535u), (int32_t)(w[1] >> 16), (int32_t)(w[2] & 255u)) / 4, 2);
            done = texels;
        }
    }
    for (int kind = 1; kind < LMB_PACK_KINDS; ++kind) {
        if (words_each[kind] > 0) {
            swap_at(file, p->part[kind], p->bytes[kind] / 4, 4);
        }
    }
    for (int kind = LMB_PACK_TRANSFER; kind <= LMB_PACK_VERTEX_LIGHT; ++kind) { /* word 0 holds letters */
        if (p->bytes[kind] > 4) {
            swap_at(file, p->part[kind] + 1, p->bytes[kind] / 4 - 1, 4);
        }
    }
    uint32_t parts;
    memcpy(&parts, file + 12, sizeof parts);
    swap(file + 4, LMB_PACK_HEADER_WORDS - 1 + LMB_PACK_PART_WORDS * (size_t)parts, 4);
    checksum_put(inout, LMB_PACK_HEADER_WORDS);
}
