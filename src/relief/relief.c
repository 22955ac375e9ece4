/* relief.c: opens a .lmr in place: checks the whole file once, then trusts it. Layer 5. [P10] */
#include <lambent/relief.h>

#include <string.h>

#include "../base/vec.h"
#include "../raster/target.h"

#if LMB_RELIEF

enum {
    RELIEF_MAGIC,
    RELIEF_ORDER,
    RELIEF_SIZE,
    FORMAT,
    VIEWS,
    RECORDS,
    VERTICES,
    TRIANGLES,
    POSITIONS,
    NORMALS,
    COLOURS,
    INDICES,
    INDEX_FORMAT,
    RELIEF_RESERVED
};                                                 /* header words; the last one is the tool's checksum */
enum { V_KIND = 16, V_WIDTH, V_HEIGHT, V_TEXELS }; /* words of a view's record, after its 16 floats */
enum { HEADER_BYTES = 4 * LMB_RELIEF_HEADER_WORDS, VIEW_BYTES = 4 * LMB_RELIEF_VIEW_WORDS, MAX_SIDE = 4096 };

#define RELIEF_OWN_ORDER 0x01020304u
#define OTHER_ORDER 0x04030201u
#define MAX_RELIEF_COUNT 0x0fffffffu /* limit of vertices and triangles: products with them fit 64 bits */

/* A file that is being checked. */
typedef struct relief_source {
    const uint8_t *data;
    uint64_t bytes;
    int swapped; /* the numbers are in the other byte order */
} relief_source;

static uint32_t turned(uint32_t v) { return v >> 24 | (v >> 8 & 0xff00u) | (v << 8 & 0xff0000u) | v << 24; }

static uint32_t word_at(const relief_source *s, uint64_t at)
{
    uint32_t v;
    memcpy(&v, s->data + at, sizeof v);
    return s->swapped ? turned(v) : v;
}

static float float_at(const relief_source *s, uint64_t at)
{
    const uint32_t bits = word_at(s, at);
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static uint32_t header(const relief_source *s, int word) { return word_at(s, 4u * (uint64_t)word); }

/* Do `size` bytes at offset `at` lie inside the file? */
static int holds_bytes(const relief_source *s, uint64_t at, uint64_t size)
{
    return at % 4 == 0 && at >= HEADER_BYTES && at <= s->bytes && size <= s->bytes - at;
}

static int holds_array(const relief_source *s, int word, uint64_t count, uint64_t size)
{
    return holds_bytes(s, header(s, word), count * size);
}

/* --- views -------------------------------------------------------------------------------------------------------- */

static uint64_t relief_texel_bytes(uint32_t format, uint64_t texels)
{
    return format == LMB_RELIEF_FULL ? 12 * texels : 4 * texels + (texels + 1) / 2 * 4;
}

static lmb_vec3 vec_at(const relief_source *s, uint64_t at)
{
    return vec3(float_at(s, at), float_at(s, at + 4), float_at(s, at + 8));
}

static lmb_view view_at(const relief_source *s, uint64_t at)
{
    lmb_view v;
    v.eye = vec_at(s, at);
    v.right = vec_at(s, at + 12);
    v.up = vec_at(s, at + 24);
    v.back = vec_at(s, at + 36);
    v.half_width = float_at(s, at + 48);
    v.half_height = float_at(s, at + 52);
    v.near_m = float_at(s, at + 56);
    v.far_m = float_at(s, at + 60);
    v.kind = (int32_t)word_at(s, at + 4 * V_KIND);
    v.frame_width = (int32_t)word_at(s, at + 4 * V_WIDTH);
    v.frame_height = (int32_t)word_at(s, at + 4 * V_HEIGHT);
    v.sample_x = v.sample_y = 0;
    return v;
}

/* Within these limits, products of a view's lengths neither overflow nor underflow. */
static int is_length(float v) { return v > 1e-9f && v < 1048576.0f; }

static int is_relief_view(const relief_source *s, const lmb_view *v, uint64_t at)
{
    const int sides = v->frame_width >= 2 && v->frame_width <= MAX_SIDE && v->frame_height >= 2 &&
                      v->frame_height <= MAX_SIDE;
    return sides && lmb_view_is_valid(v) && (v->kind == LMB_PERSPECTIVE || v->kind == LMB_ORTHOGRAPHIC) &&
           is_length(v->half_width) && is_length(v->half_height) && is_length(v->near_m) && is_length(v->far_m) &&
           v->far_m > v->near_m && absf(dot3(v->right, v->up)) < 0.01f && absf(dot3(v->right, v->back)) < 0.01f &&
           absf(dot3(v->up, v->back)) < 0.01f &&
           holds_bytes(s, word_at(s, at + 4 * V_TEXELS),
                       relief_texel_bytes(header(s, FORMAT), (uint64_t)v->frame_width * (uint64_t)v->frame_height));
}

/* Sets the row of a matrix that computes scale * axis . (p - eye) + rest * w. */
static void set_view_row(float row[4], lmb_vec3 axis, float scale, lmb_vec3 eye)
{
    const lmb_vec3 a = mul3(axis, scale);
    row[0] = a.x;
    row[1] = a.y;
    row[2] = a.z;
    row[3] = -dot3(a, eye);
}

static void set_view_rows(lmb_relief_view *out, const lmb_view *v)
{
    const float w = (float)v->frame_width, h = (float)v->frame_height;
    const float mid_u = 0.5f * (w - 1.0f), mid_v = 0.5f * (h - 1.0f);
    set_view_row(out->to_view[0], v->right, 0.5f * w / v->half_width, v->eye);
    set_view_row(out->to_view[1], v->up, -0.5f * h / v->half_height, v->eye);
    if (v->kind == LMB_PERSPECTIVE) {
        set_view_row(out->to_view[3], v->back, -1.0f, v->eye);
        for (int i = 0; i < 4; ++i) {
            out->to_view[0][i] += mid_u * out->to_view[3][i];
            out->to_view[1][i] += mid_v * out->to_view[3][i];
            out->to_view[2][i] = i < 3 ? 0.0f : v->near_m;
        }
    } else {
        const float per_m = 1.0f / (v->far_m - v->near_m);
        set_view_row(out->to_view[2], v->back, per_m, v->eye);
        out->to_view[0][3] += mid_u;
        out->to_view[1][3] += mid_v;
        out->to_view[2][3] += v->far_m * per_m;
        for (int i = 0; i < 4; ++i) {
            out->to_view[3][i] = i < 3 ? 0.0f : 1.0f;
        }
    }
}

static void set_view(lmb_relief_view *out, const lmb_view *v, uint32_t format)
{
    const float max = format == LMB_RELIEF_FULL ? 16777215.0f : 65535.0f;
    const float wide = 2.0f * v->half_width / (float)v->frame_width,
                high = 2.0f * v->half_height / (float)v->frame_height;
    const int perspective = v->kind == LMB_PERSPECTIVE;
    set_view_rows(out, v);
    out->width = v->frame_width;
    out->height = v->frame_height;
    out->perspective = perspective;
    out->eye = v->eye;
    out->back = v->back;
    out->per_u = mul3(v->right, wide);
    out->per_v = mul3(v->up, -high);
    out->corner = add3(mul3(v->right, 0.5f * wide - v->half_width), mul3(v->up, v->half_height - 0.5f * high));
    out->corner = perspective ? sub3(out->corner, v->back) : add3(out->corner, v->eye);
    out->min = perspective ? v->near_m / v->far_m : 0.0f;
    out->per_code = (1.0f - out->min) / max;
    out->z_at_0 = v->far_m;
    out->z_per_d = v->near_m - v->far_m;
    out->near_m = v->near_m;
    out->texel = maxf(wide, high);
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

static lmb_status check_header(const relief_source *s)
{
    const uint32_t format = header(s, FORMAT), views = header(s, VIEWS), index = header(s, INDEX_FORMAT),
                   vertices = header(s, VERTICES), triangles = header(s, TRIANGLES);
    if (header(s, RELIEF_SIZE) > s->bytes || (format != LMB_RELIEF_FULL && format != LMB_RELIEF_PACKED) || views == 0 ||
        vertices > MAX_RELIEF_COUNT || triangles > MAX_RELIEF_COUNT ||
        (index != LMB_INDEX_U16 && index != LMB_INDEX_U32) ||
        (header(s, RELIEF_RESERVED) | header(s, RELIEF_RESERVED + 1)) != 0) {
        return LMB_ERR_FORMAT;
    }
    if (!holds_array(s, POSITIONS, vertices, 12) || !holds_array(s, NORMALS, vertices, 4) ||
        (header(s, COLOURS) != 0 && !holds_array(s, COLOURS, vertices, 4)) ||
        !holds_array(s, INDICES, 3 * (uint64_t)triangles, index == LMB_INDEX_U16 ? 2 : 4) ||
        !holds_array(s, RECORDS, views, VIEW_BYTES)) {
        return LMB_ERR_FORMAT;
    }
    return LMB_OK;
}

typedef struct file_range {
    uint64_t at, bytes;
} file_range;

enum { ARRAYS = 5 }; /* besides the texels of the views */

/* Byte range of array i, or of the texels of view i - ARRAYS. */
static file_range range_of(const relief_source *s, uint32_t i)
{
    const uint64_t vertices = header(s, VERTICES), corners = 3 * (uint64_t)header(s, TRIANGLES);
    file_range r = {0, 0};
    switch (i) {
    case 0: r.at = header(s, RECORDS), r.bytes = (uint64_t)header(s, VIEWS) * VIEW_BYTES; break;
    case 1: r.at = header(s, POSITIONS), r.bytes = 12 * vertices; break;
    case 2: r.at = header(s, NORMALS), r.bytes = 4 * vertices; break;
    case 3: r.at = header(s, COLOURS), r.bytes = r.at != 0 ? 4 * vertices : 0; break;
    case 4: r.at = header(s, INDICES), r.bytes = corners * (header(s, INDEX_FORMAT) == LMB_INDEX_U16 ? 2 : 4); break;
    default: {
        const uint64_t record = header(s, RECORDS) + (uint64_t)(i - ARRAYS) * VIEW_BYTES;
        const uint64_t width = word_at(s, record + 4 * V_WIDTH), height = word_at(s, record + 4 * V_HEIGHT);
        r.at = word_at(s, record + 4 * V_TEXELS);
        r.bytes = relief_texel_bytes(header(s, FORMAT), width * height);
    }
    }
    return r;
}

static int overlaps(file_range a, file_range b)
{
    return a.bytes > 0 && b.bytes > 0 && a.at < b.at + b.bytes && b.at < a.at + a.bytes;
}

/* Are all arrays disjoint? Views are compared with each other only if lmb_relief_open accepts that many, so that the
 * time stays linear in the file size. */
static int are_apart(const relief_source *s)
{
    const uint32_t views = header(s, VIEWS), all = ARRAYS + views;
    for (uint32_t i = 1; i < all; ++i) {
        const file_range own = range_of(s, i);
        const uint32_t past = i < ARRAYS || views <= LMB_RELIEF_VIEWS ? i : ARRAYS;
        for (uint32_t k = 0; k < past; ++k) {
            if (overlaps(own, range_of(s, k))) {
                return 0;
            }
        }
    }
    return 1;
}

/* Checks each offset and each number, in either byte order. */
static lmb_status check_file(relief_source *s, const void *data, size_t bytes)
{
    if (data == NULL) {
        return LMB_ERR_ARG;
    }
    if ((uintptr_t)data % 4 != 0) {
        return LMB_ERR_ALIGN;
    }
    s->data = (const uint8_t *)data;
    s->bytes = bytes;
    s->swapped = 0;
    if (bytes < HEADER_BYTES || memcmp(data, "LMR\1", 4) != 0) {
        return LMB_ERR_FORMAT;
    }
    const uint32_t order = header(s, RELIEF_ORDER);
    s->swapped = order == OTHER_ORDER;
    if (order != RELIEF_OWN_ORDER && order != OTHER_ORDER) {
        return LMB_ERR_FORMAT;
    }
    if (check_header(s) != LMB_OK) {
        return LMB_ERR_FORMAT;
    }
    for (uint32_t i = 0; i < header(s, VIEWS); ++i) {
        const uint64_t at = header(s, RECORDS) + (uint64_t)i * VIEW_BYTES;
        const lmb_view v = view_at(s, at);
        if (!is_relief_view(s, &v, at)) {
            return LMB_ERR_FORMAT;
        }
    }
    return are_apart(s) ? LMB_OK : LMB_ERR_FORMAT;
}

static void set_mesh(lmb_mesh *m, const relief_source *s)
{
    memset(m, 0, sizeof *m);
    m->positions = s->data + header(s, POSITIONS);
    m->normals = (const int16_t *)(const void *)(s->data + header(s, NORMALS));
    m->colours = header(s, COLOURS) != 0 ? s->data + header(s, COLOURS) : NULL;
    m->indices = s->data + header(s, INDICES);
    m->vertex_count = header(s, VERTICES);
    m->triangle_count = header(s, TRIANGLES);
    m->index_format = (uint8_t)header(s, INDEX_FORMAT);
}

static void set_relief_look(lmb_relief *out)
{
    memset(&out->material, 0, sizeof out->material);
    memset(&out->instance, 0, sizeof out->instance);
    for (int i = 0; i < 3; ++i) {
        out->material.albedo[i] = 1.0f;
        out->instance.to_world.m[5 * i] = 1.0f;
    }
    out->instance.to_world.m[15] = 1.0f;
    out->instance.first_id = 1;
    out->material.alpha = 1.0f;
    out->material.texture = -1;
    out->material.roughness = 1.0f;
}

lmb_status lmb_relief_open(lmb_relief *out, const void *data, size_t bytes)
{
    relief_source s;
    lmb_scene scene;
    if (out == NULL) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_file(&s, data, bytes);
    if (status != LMB_OK || s.swapped) {
        return status != LMB_OK ? status : LMB_ERR_FORMAT;
    }
    if (header(&s, VIEWS) > LMB_RELIEF_VIEWS) {
        return LMB_ERR_CAPACITY;
    }
    memset(out, 0, sizeof *out);
    out->views = (int32_t)header(&s, VIEWS);
    out->format = (int32_t)header(&s, FORMAT);
    for (int32_t i = 0; i < out->views; ++i) {
        const uint64_t at = header(&s, RECORDS) + (uint64_t)i * VIEW_BYTES;
        const lmb_view v = view_at(&s, at);
        set_view(&out->view[i], &v, (uint32_t)out->format);
        out->view[i].texels = s.data + word_at(&s, at + 4 * V_TEXELS);
    }
    set_mesh(&out->mesh, &s);
    set_relief_look(out);
    lmb_relief_scene(&scene, out);
    lmb_scene_bounds(&out->low, &out->high, &scene);
    return LMB_OK;
}

void lmb_relief_scene(lmb_scene *out, const lmb_relief *relief)
{
    if (out == NULL) {
        return;
    }
    memset(out, 0, sizeof *out);
    if (relief == NULL) {
        return;
    }
    out->meshes = &relief->mesh;
    out->materials = &relief->material;
    out->instances = &relief->instance;
    out->mesh_count = out->material_count = out->instance_count = 1;
    out->bounds_min = relief->low;
    out->bounds_max = relief->high;
}

/* --- the other byte order ----------------------------------------------------------------------------------------- */

static void turn_bytes(uint8_t *p, uint64_t count, int size)
{
    for (uint64_t i = 0; i < count; ++i) {
        for (int a = 0, b = size - 1; a < b; ++a, --b) {
            const uint8_t v = p[a];
            p[a] = p[b];
            p[b] = v;
        }
        p += size;
    }
}

/* Sections do not overlap, so each byte is swapped once. */
lmb_status lmb_relief_swap(void *data, size_t bytes)
{
    relief_source s;
    const lmb_status status = check_file(&s, data, bytes);
    if (status != LMB_OK || !s.swapped) {
        return status;
    }
    uint8_t *p = (uint8_t *)data;
    const uint64_t vertices = header(&s, VERTICES), corners = 3 * (uint64_t)header(&s, TRIANGLES);
    turn_bytes(p + header(&s, POSITIONS), 3 * vertices, 4);
    turn_bytes(p + header(&s, NORMALS), 2 * vertices, 2);
    turn_bytes(p + header(&s, INDICES), corners, header(&s, INDEX_FORMAT) == LMB_INDEX_U16 ? 2 : 4);
    turn_bytes(p + header(&s, RECORDS), (uint64_t)header(&s, VIEWS) * LMB_RELIEF_VIEW_WORDS, 4);
    turn_bytes(p + 4, LMB_RELIEF_HEADER_WORDS - 1, 4);
    return check_file(&s, data, bytes);
}

#endif
