/* io_gltf_data.c: the bytes of a glTF file: GLB chunks, URIs, buffers, views and accessors, each range checked. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io_gltf.h"

/* glTF is little-endian everywhere. */
static uint32_t le16(const uint8_t *p) { return (uint32_t)p[0] | (uint32_t)p[1] << 8; }
static uint32_t le32(const uint8_t *p) { return le16(p) | le16(p + 2) << 16; }

/* Reads the chunks: JSON first, then the first BIN; others are skipped. */
static int glb_chunks(gltf *g, const uint8_t *data, size_t size, gltf_bytes *text)
{
    const char *path = g->b->path;
    size_t at = 12;
    while (size - at >= 8) {
        uint32_t length = le32(data + at), type = le32(data + at + 4);
        if (length > size - at - 8)
            return report_fail(g->b->r, "%s: byte %u: a chunk of %u bytes runs over the end; the file is truncated",
                               path, (unsigned)at, (unsigned)length);
        if (!text->ready) {
            if (type != 0x4E4F534Au)
                return report_fail(g->b->r, "%s: byte %u: the first chunk is not JSON; export the file again", path,
                                   (unsigned)at);
            text->data = data + at + 8;
            text->size = length;
            text->ready = 1;
            while (text->size > 0 && text->data[text->size - 1] == 0)
                --text->size; /* some pad with zeros */
        } else if (type == 0x004E4942u && !g->chunk.ready) {
            g->chunk.data = data + at + 8;
            g->chunk.size = length;
            g->chunk.ready = 1;
        }
        at += 8 + (size_t)length;
    }
    if (at != size || !text->ready)
        return report_fail(g->b->r, "%s: byte %u: the file ends inside a chunk's header; it is truncated", path,
                           (unsigned)at);
    return 1;
}

static int glb_open(gltf *g, const uint8_t *data, size_t size, gltf_bytes *text)
{
    const char *path = g->b->path;
    uint32_t version, length;
    if (size < 12)
        return report_fail(g->b->r, "%s: byte %u: the GLB header is truncated", path, (unsigned)size);
    version = le32(data + 4);
    length = le32(data + 8);
    if (version != 2)
        return report_fail(g->b->r, "%s: byte 4: GLB version %u; export as glTF 2.0", path, (unsigned)version);
    if (length > size || length < 12)
        return report_fail(g->b->r, "%s: byte 8: the header says %u bytes, the file has %zu; it is truncated", path,
                           (unsigned)length, size);
    return glb_chunks(g, data, length, text);
}

int gltf_container(gltf *g, const uint8_t *data, size_t size)
{
    gltf_bytes text = {NULL, 0, 0};
    if (size >= 4 && memcmp(data, "glTF", 4) == 0) {
        if (!glb_open(g, data, size, &text))
            return 0;
    } else {
        text.data = data;
        text.size = size;
    }
    return json_parse(&g->doc, (const char *)text.data, text.size, g->b->path, g->b->r);
}

int gltf_list_of(gltf_list *out, gltf *g, uint32_t array)
{
    uint32_t i, n = 0;
    if (array != JSON_NONE && json_kind(&g->doc, array) != JSON_ARRAY)
        return json_fail(&g->doc, array, g->b->r, "must be an array");
    out->count = json_count(&g->doc, array);
    out->items = (uint32_t *)build_scratch(g->b, out->count, sizeof *out->items);
    if (!out->items)
        return 0;
    for (i = json_first(&g->doc, array); i != JSON_NONE; i = json_next(&g->doc, i)) {
        if (json_kind(&g->doc, i) != JSON_OBJECT)
            return json_fail(&g->doc, i, g->b->r, "must be an object");
        out->items[n++] = i;
    }
    return 1;
}

int gltf_lists(gltf *g)
{
    const struct {
        gltf_list *list;
        const char *key;
    } all[] = {
        {&g->accessors, "accessors"}, {&g->views, "bufferViews"}, {&g->buffers, "buffers"},     {&g->images, "images"},
        {&g->samplers, "samplers"},   {&g->textures, "textures"}, {&g->materials, "materials"}, {&g->meshes, "meshes"},
        {&g->nodes, "nodes"},         {&g->cameras, "cameras"}, {&g->skins, "skins"},
    };
    size_t i;
    for (i = 0; i < sizeof all / sizeof all[0]; ++i)
        if (!gltf_list_of(all[i].list, g, json_member(&g->doc, 0, all[i].key)))
            return 0;
    return 1;
}

int gltf_index(uint32_t *out, const gltf *g, const gltf_list *list, uint32_t reference)
{
    *out = JSON_NONE;
    if (!json_read_uint(out, &g->doc, reference, g->b->r))
        return 0;
    if (reference != JSON_NONE && *out >= list->count)
        return json_fail(&g->doc, reference, g->b->r, "index %u, but there are %u; export the file again",
                         (unsigned)*out, (unsigned)list->count);
    return 1;
}

int gltf_item(uint32_t *out, const gltf *g, const gltf_list *list, uint32_t reference)
{
    uint32_t index;
    if (!gltf_index(&index, g, list, reference))
        return 0;
    *out = index == JSON_NONE ? JSON_NONE : list->items[index];
    return 1;
}

static int base64_digit(int c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/* Decodes in place (three bytes replace four); returns the length, or SIZE_MAX if the text is not base64. */
static size_t base64_decode(char *text)
{
    size_t n = strlen(text), i, out = 0;
    uint32_t bits = 0;
    while (n > 0 && text[n - 1] == '=')
        --n;
    if (n % 4 == 1)
        return SIZE_MAX;
    for (i = 0; i < n; ++i) {
        int digit = base64_digit((unsigned char)text[i]);
        if (digit < 0)
            return SIZE_MAX;
        bits = bits << 6 | (uint32_t)digit;
        if (i % 4 != 0)
            text[out++] = (char)(uint8_t)(bits >> (6 - 2 * (i % 4)));
    }
    return out;
}

static int data_uri(gltf_bytes *out, const gltf *g, uint32_t node, char *text, report *r)
{
    char *comma = strchr(text, ',');
    size_t n;
    if (!comma || comma - text < 7 || memcmp(comma - 7, ";base64", 7) != 0)
        return json_fail(&g->doc, node, r, "a data URI that is not base64; export with separate files");
    n = base64_decode(comma + 1);
    if (n == SIZE_MAX)
        return json_fail(&g->doc, node, r, "damaged base64; export the file again");
    out->data = (const uint8_t *)comma + 1;
    out->size = n;
    out->ready = 1;
    return 1;
}

static int hex_value(int c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* Resolves %20 and the like in place; returns 0 for a broken escape or a zero byte. */
static int percent_decode(char *text)
{
    char *to = text;
    for (; *text; ++text) {
        int hi, lo;
        if (*text != '%') {
            *to++ = *text;
            continue;
        }
        hi = hex_value((unsigned char)text[1]);
        lo = hi < 0 ? -1 : hex_value((unsigned char)text[2]);
        if (lo < 0 || hi + lo == 0)
            return 0;
        *to++ = (char)(uint8_t)(hi * 16 + lo);
        text += 2;
    }
    *to = '\0';
    return 1;
}

int gltf_uri(gltf_bytes *out, gltf *g, uint32_t uri, report *r)
{
    const uint32_t raw = json_kind(&g->doc, uri) == JSON_STRING ? g->doc.nodes[uri].size : 0;
    char path[MODEL_PATH_MAX], *text;
    file_bytes file;
    if (raw == 0)
        return json_fail(&g->doc, uri, r, "must be a URI");
    text = (char *)build_scratch(g->b, (uint64_t)raw + 1, 1);
    if (!text)
        return 0;
    json_string(text, (size_t)raw + 1, &g->doc, uri);
    if (strncmp(text, "data:", 5) == 0)
        return data_uri(out, g, uri, text, r);
    if (!build_is_relative(text))
        return json_fail(&g->doc, uri, r, "absolute URI \"%.*s\"; put the file beside the model and name it alone",
                         raw < 80 ? (int)raw : 80, g->doc.text + g->doc.nodes[uri].start);
    if (!percent_decode(text))
        return json_fail(&g->doc, uri, r, "damaged %%-escape in the URI");
    if (!build_sibling(path, sizeof path, g->b, text, r) || !build_read(g->b, &file, path, r))
        return 0;
    out->data = file.data;
    out->size = file.size;
    out->ready = 1;
    return 1;
}

/* The bytes of buffers[index], read at first use. */
static int buffer_bytes(gltf_bytes *out, gltf *g, uint32_t index)
{
    const uint32_t node = g->buffers.items[index], uri = json_member(&g->doc, node, "uri"),
                   member = json_member(&g->doc, node, "byteLength");
    gltf_bytes *bytes = &g->buffer_bytes[index];
    uint32_t length = 0;
    if (!bytes->ready) {
        if (member == JSON_NONE)
            return json_fail(&g->doc, node, g->b->r, "byteLength is missing");
        if (!json_read_uint(&length, &g->doc, member, g->b->r))
            return 0;
        if (uri != JSON_NONE) {
            if (!gltf_uri(bytes, g, uri, g->b->r))
                return 0;
        } else if (index == 0 && g->chunk.ready) {
            *bytes = g->chunk;
        } else {
            return json_fail(&g->doc, node, g->b->r, "no uri and no GLB chunk holds it; export the file again");
        }
        if (bytes->size < length)
            return json_fail(&g->doc, node, g->b->r,
                             "byteLength %u, but only %zu bytes are there; the data is truncated", (unsigned)length,
                             bytes->size);
        bytes->size = length;
    }
    *out = *bytes;
    return 1;
}

int gltf_view(gltf_bytes *out, gltf *g, uint32_t view)
{
    const json *doc = &g->doc;
    const uint32_t reference = json_member(doc, view, "buffer"), length_node = json_member(doc, view, "byteLength");
    uint32_t buffer, offset = 0, length = 0;
    gltf_bytes whole = {NULL, 0, 0};
    if (reference == JSON_NONE || length_node == JSON_NONE)
        return json_fail(doc, view, g->b->r, "buffer or byteLength is missing");
    if (!gltf_index(&buffer, g, &g->buffers, reference) || !buffer_bytes(&whole, g, buffer) ||
        !json_read_uint(&offset, doc, json_member(doc, view, "byteOffset"), g->b->r) ||
        !json_read_uint(&length, doc, length_node, g->b->r))
        return 0;
    if ((uint64_t)offset + length > whole.size)
        return json_fail(doc, view, g->b->r, "bytes %u + %u of a buffer of %zu; export the file again",
                         (unsigned)offset, (unsigned)length, whole.size);
    out->data = whole.data + offset;
    out->size = length;
    out->ready = 1;
    return 1;
}

static uint32_t component_size(uint32_t component)
{
    switch (component) {
    case GLTF_I8:
    case GLTF_U8:
        return 1;
    case GLTF_I16:
    case GLTF_U16:
        return 2;
    case GLTF_U32:
    case GLTF_F32:
        return 4;
    default:
        return 0;
    }
}

/* Finds the first of `count` elements of `size` bytes, `stride` apart, in the view that `owner` names; checks that
 * all are inside. */
static int locate(const uint8_t **out, uint32_t *stride, gltf *g, uint32_t owner, uint32_t count, uint32_t size)
{
    const json *doc = &g->doc;
    uint32_t view, offset = 0;
    gltf_bytes bytes = {NULL, 0, 0};
    if (!gltf_item(&view, g, &g->views, json_member(doc, owner, "bufferView")))
        return 0;
    if (view == JSON_NONE)
        return json_fail(doc, owner, g->b->r, "bufferView is missing");
    if (!gltf_view(&bytes, g, view) || !json_read_uint(&offset, doc, json_member(doc, owner, "byteOffset"), g->b->r))
        return 0;
    *stride = size;
    if (!json_read_uint(stride, doc, json_member(doc, view, "byteStride"), g->b->r))
        return 0;
    if (*stride < size || *stride > 252)
        return json_fail(doc, view, g->b->r, "byteStride %u for elements of %u bytes; it must be that to 252",
                         (unsigned)*stride, (unsigned)size);
    if (count > 0 && offset + (uint64_t)*stride * (count - 1) + size > bytes.size)
        return json_fail(doc, owner, g->b->r, "%u elements from byte %u do not fit in the view's %zu bytes",
                         (unsigned)count, (unsigned)offset, bytes.size);
    *out = bytes.data + offset;
    return 1;
}

static int open_sparse(gltf_accessor *a, gltf *g, uint32_t sparse)
{
    const json *doc = &g->doc;
    const uint32_t indices = json_member(doc, sparse, "indices"), values = json_member(doc, sparse, "values");
    const uint32_t size = a->components * component_size(a->component);
    uint32_t stride;
    if (!json_read_uint(&a->sparse_count, doc, json_member(doc, sparse, "count"), g->b->r) ||
        !json_read_uint(&a->sparse_component, doc, json_member(doc, indices, "componentType"), g->b->r))
        return 0;
    if (a->sparse_count == 0 || a->sparse_count > a->count || indices == JSON_NONE || values == JSON_NONE)
        return json_fail(doc, sparse, g->b->r, "needs indices, values and a count from 1 to %u", (unsigned)a->count);
    if (a->sparse_component != GLTF_U8 && a->sparse_component != GLTF_U16 && a->sparse_component != GLTF_U32)
        return json_fail(doc, indices, g->b->r, "componentType must be 5121, 5123 or 5125");
    if (!locate(&a->sparse_indices, &stride, g, indices, a->sparse_count, component_size(a->sparse_component)))
        return 0;
    if (stride != component_size(a->sparse_component))
        return json_fail(doc, indices, g->b->r, "the bufferView may not have a byteStride");
    if (!locate(&a->sparse_values, &stride, g, values, a->sparse_count, size))
        return 0;
    if (stride != size)
        return json_fail(doc, values, g->b->r, "the bufferView may not have a byteStride");
    a->sparse_node = sparse;
    return 1;
}

/* VEC3 -> 3; 0 for unknown words and smaller matrices, which lambent never reads. */
static uint32_t components_of(const json *doc, uint32_t type)
{
    static const char *const names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    uint32_t i;
    for (i = 0; i < 4; ++i)
        if (json_equals(doc, type, names[i]))
            return i + 1;
    return json_equals(doc, type, "MAT4") ? 16 : 0;
}

int gltf_accessor_open(gltf_accessor *out, gltf *g, uint32_t accessor)
{
    const json *doc = &g->doc;
    const uint32_t sparse = json_member(doc, accessor, "sparse");
    memset(out, 0, sizeof *out);
    out->node = accessor;
    out->components = components_of(doc, json_member(doc, accessor, "type"));
    if (!json_read_uint(&out->count, doc, json_member(doc, accessor, "count"), g->b->r) ||
        !json_read_uint(&out->component, doc, json_member(doc, accessor, "componentType"), g->b->r) ||
        !json_read_bool(&out->normalized, doc, json_member(doc, accessor, "normalized"), g->b->r))
        return 0;
    if (component_size(out->component) == 0)
        return json_fail(doc, accessor, g->b->r, "componentType %u; glTF has 5120 to 5123, 5125 and 5126",
                         (unsigned)out->component);
    if (out->components == 0)
        return json_fail(doc, accessor, g->b->r, "type must be SCALAR, VEC2, VEC3, VEC4 or MAT4 here");
    if (out->count == 0)
        return json_fail(doc, accessor, g->b->r, "count must be at least 1");
    if (json_member(doc, accessor, "bufferView") != JSON_NONE &&
        !locate(&out->data, &out->stride, g, accessor, out->count, out->components * component_size(out->component)))
        return 0;
    return sparse == JSON_NONE || open_sparse(out, g, sparse);
}

/* One component as a number; normalized integers as in glTF 2.0: c / max, signed ones not below -1. */
static float component_float(const uint8_t *p, uint32_t component, int normalized)
{
    uint32_t bits;
    float value, scale;
    switch (component) {
    case GLTF_F32:
        bits = le32(p);
        memcpy(&value, &bits, 4);
        return value;
    case GLTF_I8:
        value = (float)(p[0] < 128 ? (int)p[0] : (int)p[0] - 256), scale = 127.0f;
        break;
    case GLTF_U8:
        value = (float)p[0], scale = 255.0f;
        break;
    case GLTF_I16:
        value = (float)(le16(p) < 32768 ? (int32_t)le16(p) : (int32_t)le16(p) - 65536), scale = 32767.0f;
        break;
    case GLTF_U16:
        value = (float)le16(p), scale = 65535.0f;
        break;
    default:
        value = (float)le32(p), scale = 4294967295.0f;
        break;
    }
    if (!normalized)
        return value;
    return value / scale < -1.0f ? -1.0f : value / scale;
}

static void element_floats(float *out, const gltf_accessor *a, const uint8_t *p)
{
    const uint32_t size = component_size(a->component);
    uint32_t c;
    for (c = 0; c < a->components; ++c)
        out[c] = component_float(p + c * size, a->component, a->normalized);
}

static uint32_t index_value(const uint8_t *p, uint32_t component)
{
    return component == GLTF_U8 ? p[0] : component == GLTF_U16 ? le16(p) : le32(p);
}

/* The element that sparse entry i replaces; JSON_NONE with the report set if the indices do not rise. */
static uint32_t sparse_target(const gltf *g, const gltf_accessor *a, uint32_t i)
{
    const uint32_t size = component_size(a->sparse_component);
    const uint32_t target = index_value(a->sparse_indices + (size_t)i * size, a->sparse_component);
    const uint32_t before = i ? index_value(a->sparse_indices + (size_t)(i - 1) * size, a->sparse_component) : 0;
    if (target < a->count && (i == 0 || target > before))
        return target;
    json_fail(&g->doc, a->sparse_node, g->b->r, "index %u at entry %u; they must rise and stay under %u",
              (unsigned)target, (unsigned)i, (unsigned)a->count);
    return JSON_NONE;
}

int gltf_accessor_floats(float *out, const gltf *g, const gltf_accessor *a)
{
    const uint32_t size = a->components * component_size(a->component);
    uint32_t i;
    if (!a->data)
        memset(out, 0, (size_t)a->count * a->components * sizeof *out);
    for (i = 0; a->data && i < a->count; ++i)
        element_floats(out + (size_t)i * a->components, a, a->data + (size_t)i * a->stride);
    for (i = 0; i < a->sparse_count; ++i) {
        const uint32_t target = sparse_target(g, a, i);
        if (target == JSON_NONE)
            return 0;
        element_floats(out + (size_t)target * a->components, a, a->sparse_values + (size_t)i * size);
    }
    return 1;
}

int gltf_accessor_indices(uint32_t *out, const gltf *g, const gltf_accessor *a)
{
    const uint32_t size = component_size(a->component);
    uint32_t i;
    if (a->components != 1 || (a->component != GLTF_U8 && a->component != GLTF_U16 && a->component != GLTF_U32))
        return json_fail(&g->doc, a->node, g->b->r, "indices must be SCALAR of type 5121, 5123 or 5125");
    for (i = 0; i < a->count; ++i)
        out[i] = a->data ? index_value(a->data + (size_t)i * a->stride, a->component) : 0;
    for (i = 0; i < a->sparse_count; ++i) {
        const uint32_t target = sparse_target(g, a, i);
        if (target == JSON_NONE)
            return 0;
        out[target] = index_value(a->sparse_values + (size_t)i * size, a->component);
    }
    return 1;
}
