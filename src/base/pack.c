/* pack.c: opens a .lmp in place: checks the whole file once, then trusts it; scene in the caller's memory. Layer 1. */
#include <lambent/pack.h>

#include <string.h>

#include "memory_check.h"
#include "scene_check.h"
#include "vec.h"
#include "motion.h"
#include "records.h"

#if LMB_PACK

enum { PACK_ORDER = 1, PACK_SIZE, PACK_PARTS, PACK_RESERVED }; /* header words */

#define PACK_OWN_ORDER 0x01020304u
#define MAX_PACK_COUNT 0x0fffffffu /* limit of vertices and triangles: products with them fit 64 bits */
#define MAX_VALUE 1e30f       /* limit of a key */

/* A file that is being checked. */
typedef struct pack_source {
    lmb_pack *pack;
    uint32_t bytes;
    uint64_t indices, keys; /* words that indices and keys may still read: bounds the cost of shared ranges */
} pack_source;

/* Do `size` bytes at offset `at` lie inside the file? */
static int holds_part(const pack_source *s, uint32_t at, uint64_t size)
{
    return at % 4 == 0 && at >= 4 * LMB_PACK_HEADER_WORDS && at <= s->bytes && size <= s->bytes - at;
}

/* The same, but offset 0 means no data. */
static int may_hold(const pack_source *s, uint32_t at, uint64_t size) { return at == 0 || holds_part(s, at, size); }

static int is_word_finite(float v) { return v >= -FLT_MAX && v <= FLT_MAX; }

static int are_words_finite(const uint32_t *word, int count)
{
    int all = 1;
    for (int i = 0; i < count; ++i) {
        all &= is_word_finite(lmb_pack_float(word + i));
    }
    return all;
}

/* --- meshes ------------------------------------------------------------------------------------------------------- */

/* Is every index in range? */
static int are_indices(const lmb_mesh *m)
{
    const size_t corners = 3 * (size_t)m->triangle_count;
    uint32_t largest = 0;
    if (m->index_format == LMB_INDEX_NONE || corners == 0) {
        return 1;
    }
    if (m->index_format == LMB_INDEX_U16) {
        const uint16_t *index = (const uint16_t *)m->indices;
        for (size_t i = 0; i < corners; ++i) {
            largest = index[i] > largest ? index[i] : largest;
        }
    } else {
        const uint32_t *index = (const uint32_t *)m->indices;
        for (size_t i = 0; i < corners; ++i) {
            largest = index[i] > largest ? index[i] : largest;
        }
    }
    return largest < m->vertex_count;
}

static int is_mesh(pack_source *s, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(s->pack, LMB_PACK_MESHES, i);
    const uint64_t vertices = w[0], triangles = w[1];
    const uint32_t position = w[2] & 255u, uv = w[2] >> 8 & 255u, index = w[2] >> 16 & 255u;
    const uint64_t corners = index == LMB_INDEX_NONE ? 0 : 3 * triangles * (index == LMB_INDEX_U16 ? 2 : 4);
    lmb_mesh m;
    if (vertices > MAX_PACK_COUNT || triangles > MAX_PACK_COUNT || position > LMB_POSITION_I16 || uv > LMB_UV_U16 ||
        index > LMB_INDEX_U32 || corners > s->indices ||
        !may_hold(s, w[3], vertices * (position == LMB_POSITION_F32 ? 12 : 8)) || !may_hold(s, w[4], vertices * 4) ||
        !may_hold(s, w[5], vertices * 4) || !may_hold(s, w[6], vertices * (uv == LMB_UV_F32 ? 8 : 4)) ||
        !may_hold(s, w[7], vertices * (w[2] >> 28 == LMB_COLOUR_RGBA8 ? 4 : 8)) || !may_hold(s, w[8], corners)) {
        return 0;
    }
    s->indices -= corners;
    lmb_pack_take_mesh(&m, s->pack, i);
    return lmb_check_mesh(&m) == LMB_OK && are_indices(&m);
}

/* --- materials, textures, instances ------------------------------------------------------------------------------- */

static int is_texture(const pack_source *s, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(s->pack, LMB_PACK_TEXTURES, i);
    const int32_t width = (int32_t)(w[1] & 0xffffu), height = (int32_t)(w[1] >> 16), levels = (int32_t)(w[2] & 255u);
    const size_t bytes = lmb_texture_format_bytes((int32_t)(w[2] >> 8 & 255u), width, height, levels);
    return bytes > 0 && holds_part(s, w[0], bytes) && (w[2] >> 16 & 255u) <= LMB_WRAP_MIRROR &&
           w[2] >> 24 <= LMB_WRAP_MIRROR && w[3] <= LMB_TRILINEAR;
}

static int is_material(const pack_source *s, uint32_t i)
{
    lmb_material m;
    lmb_pack_take_material(&m, s->pack, i);
    return lmb_check_material(&m, s->pack->count[LMB_PACK_TEXTURES]) == LMB_OK;
}

static int is_node(const lmb_pack *p, uint32_t node)
{
    return node == LMB_PACK_NONE || node < p->count[LMB_PACK_NODES];
}

static int are_instances(const lmb_pack *p)
{
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < p->count[LMB_PACK_INSTANCES]; ++i) {
        const uint32_t *w = lmb_pack_record(p, LMB_PACK_INSTANCES, i);
        if (!are_words_finite(w, 12) || w[12] >= p->count[LMB_PACK_MESHES] || w[13] >= p->count[LMB_PACK_MATERIALS] ||
            !is_node(p, w[PACK_INSTANCE_NODE])) {
            return 0;
        }
        triangles += lmb_pack_record(p, LMB_PACK_MESHES, w[12])[1];
        if (triangles > LMB_MAX_TRIANGLES) {
            return 0;
        }
    }
    return 1;
}

static int is_light(const lmb_pack *p, uint32_t i)
{
    lmb_light l;
    lmb_pack_take_light(&l, p, i);
    return lmb_check_light(&l) == LMB_OK && is_node(p, lmb_pack_record(p, LMB_PACK_LIGHTS, i)[PACK_LIGHT_NODE]);
}

static int is_packed_camera(const lmb_pack *p, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_CAMERAS, i);
    return are_words_finite(w, 12) && w[12] <= LMB_ORTHOGRAPHIC && are_words_finite(w + 13, 6) &&
           lmb_pack_float(w + 13) > 0.0f && lmb_pack_float(w + 14) > 0.0f && is_node(p, w[PACK_CAMERA_NODE]);
}

/* --- nodes and tracks --------------------------------------------------------------------------------------------- */

/* Checks that times rise from 0 on and values are finite. */
static int is_track(pack_source *s, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(s->pack, LMB_PACK_TRACKS, i), *data = s->pack->data;
    const uint32_t what = w[0] & 255u, between = w[0] >> 8, keys = w[1];
    const uint64_t floats = (uint64_t)keys * (what == 1 ? 4 : 3) * (between == 2 ? 3 : 1);
    float last = -1.0f;
    if (what > 2 || between > 2 || keys == 0 || floats > s->keys || !holds_part(s, w[2], 4 * (uint64_t)keys) ||
        !holds_part(s, w[3], 4 * floats)) {
        return 0;
    }
    s->keys -= floats;
    for (uint32_t k = 0; k < keys; ++k) {
        const float time = lmb_pack_float(data + w[2] / 4 + k);
        if (!(time >= 0.0f && time > last && time <= MAX_VALUE)) {
            return 0;
        }
        last = time;
    }
    for (uint64_t k = 0; k < floats; ++k) {
        if (!(absf(lmb_pack_float(data + w[3] / 4 + k)) <= MAX_VALUE)) {
            return 0;
        }
    }
    s->pack->seconds = maxf(s->pack->seconds, last);
    return 1;
}

static int are_nodes(const lmb_pack *p)
{
    for (uint32_t i = 0; i < p->count[LMB_PACK_NODES]; ++i) {
        const uint32_t *w = lmb_pack_record(p, LMB_PACK_NODES, i);
        const uint32_t tracks = p->count[LMB_PACK_TRACKS];
        uint32_t taken = 0, above = 0;
        if ((w[0] != LMB_PACK_NONE && w[0] >= i) || w[1] > tracks || w[2] > 3 || w[2] > tracks - w[1] || w[3] > 1 ||
            !are_words_finite(w + 4, 12)) {
            return 0;
        }
        for (uint32_t t = w[1]; t < w[1] + w[2]; ++t) {
            const uint32_t bit = 1u << (lmb_pack_record(p, LMB_PACK_TRACKS, t)[0] & 255u);
            if ((taken & bit) != 0 || w[3] == 1) {
                return 0;
            }
            taken |= bit;
        }
        for (uint32_t n = w[0]; n != LMB_PACK_NONE; n = lmb_pack_record(p, LMB_PACK_NODES, n)[0]) {
            if (++above > LMB_PACK_MOST_ABOVE) {
                return 0;
            }
        }
    }
    return 1;
}

/* --- the whole ---------------------------------------------------------------------------------------------------- */

/* End of the table of parts, in bytes. */
static uint32_t table_end(const uint32_t *word)
{
    return 4 * (LMB_PACK_HEADER_WORDS + LMB_PACK_PART_WORDS * word[PACK_PARTS]);
}

static int is_header(const uint32_t *word, size_t bytes)
{
    uint32_t rest = 0;
    if (bytes < 4 * LMB_PACK_HEADER_WORDS || memcmp(word, "LMP", 3) != 0 ||
        ((const uint8_t *)word)[3] != LMB_PACK_VERSION || word[PACK_ORDER] != PACK_OWN_ORDER ||
        word[PACK_SIZE] > bytes || word[PACK_SIZE] % 4 != 0 || word[PACK_PARTS] == 0 ||
        word[PACK_PARTS] > LMB_PACK_MOST_PARTS) {
        return 0;
    }
    for (int i = PACK_RESERVED; i < LMB_PACK_HEADER_WORDS - 1; ++i) { /* the last one is the tool's checksum */
        rest |= word[i];
    }
    return rest == 0 && table_end(word) <= word[PACK_SIZE];
}

/* Is part i disjoint from the table of parts and all earlier parts? All of them lie in the file. */
static int is_apart(const uint32_t *data, uint32_t i)
{
    const uint32_t *part = data + LMB_PACK_HEADER_WORDS, *own = part + LMB_PACK_PART_WORDS * (size_t)i;
    if (own[2] == 0) {
        return 1;
    }
    for (; part < own; part += LMB_PACK_PART_WORDS) {
        if (part[2] > 0 && own[1] < part[1] + part[2] && part[1] < own[1] + own[2]) {
            return 0;
        }
    }
    return own[1] >= table_end(data);
}

static int find_pack_parts(pack_source *s)
{
    lmb_pack *p = s->pack;
    for (uint32_t i = 0; i < p->data[PACK_PARTS]; ++i) {
        const uint32_t *w = p->data + LMB_PACK_HEADER_WORDS + LMB_PACK_PART_WORDS * (size_t)i, kind = w[0];
        if (!holds_part(s, w[1], w[2]) || !is_apart(p->data, i) || w[3] != 0 || kind == 0) {
            return 0;
        }
        if (kind >= LMB_PACK_KINDS) {
            continue;
        }
        const uint32_t each = 4u * lmb_pack_words_each[kind];
        if (p->part[kind] != NULL || (each > 0 && w[2] % each != 0)) {
            return 0;
        }
        p->part[kind] = p->data + w[1] / 4;
        p->bytes[kind] = w[2];
        p->count[kind] = each > 0 ? w[2] / each : 0;
    }
    return p->count[LMB_PACK_SCENE] == 1;
}

static int is_packed_scene(pack_source *s)
{
    lmb_pack *p = s->pack;
    lmb_scene scene;
    int all = find_pack_parts(s);
    if (!all) {
        return 0;
    }
    memset(&scene, 0, sizeof scene);
    lmb_pack_take_bounds(&scene, p);
    all = lmb_check_bounds(&scene) == LMB_OK;
    for (uint32_t i = 0; all && i < p->count[LMB_PACK_MESHES]; ++i) {
        all = is_mesh(s, i);
    }
    for (uint32_t i = 0; all && i < p->count[LMB_PACK_TEXTURES]; ++i) {
        all = is_texture(s, i);
    }
    for (uint32_t i = 0; all && i < p->count[LMB_PACK_MATERIALS]; ++i) {
        all = is_material(s, i);
    }
    all = all && are_instances(p);
    for (uint32_t i = 0; all && i < p->count[LMB_PACK_LIGHTS]; ++i) {
        all = is_light(p, i);
    }
    for (uint32_t i = 0; all && i < p->count[LMB_PACK_CAMERAS]; ++i) {
        all = is_packed_camera(p, i);
    }
    for (uint32_t i = 0; all && i < p->count[LMB_PACK_TRACKS]; ++i) {
        all = is_track(s, i);
    }
    return all && are_nodes(p);
}

lmb_status lmb_pack_open(lmb_pack *out, const void *data, size_t bytes)
{
    pack_source s;
    if (out == NULL || data == NULL) {
        return LMB_ERR_ARG;
    }
    memset(out, 0, sizeof *out);
    if ((uintptr_t)data % 4 != 0) {
        return LMB_ERR_ALIGN;
    }
    if (!is_header((const uint32_t *)data, bytes)) {
        return LMB_ERR_FORMAT;
    }
    out->data = (const uint32_t *)data;
    s.pack = out;
    s.bytes = out->data[PACK_SIZE];
    s.indices = s.bytes;
    s.keys = s.bytes / 4;
    if (!is_packed_scene(&s)) {
        memset(out, 0, sizeof *out);
        return LMB_ERR_FORMAT;
    }
    return LMB_OK;
}

const void *lmb_pack_part(const lmb_pack *pack, int32_t kind, size_t *bytes)
{
    const int is_there = pack != NULL && kind > 0 && kind < LMB_PACK_KINDS && pack->part[kind] != NULL;
    if (bytes != NULL) {
        *bytes = is_there ? pack->bytes[kind] : 0;
    }
    return is_there ? pack->part[kind] : NULL;
}

/* --- the scene ---------------------------------------------------------------------------------------------------- */

/* Offsets of the arrays in the caller's memory; arrays with pointers come first. They have 64 bits, because the sum may
 * overflow size_t on small targets. */
typedef struct layout {
    uint64_t meshes, textures, materials, instances, lights, bytes;
} layout;

static layout lay_out_scene(const lmb_pack *p)
{
    layout l;
    l.meshes = 0;
    l.textures = l.meshes + (uint64_t)p->count[LMB_PACK_MESHES] * sizeof(lmb_mesh);
    l.materials = l.textures + (uint64_t)p->count[LMB_PACK_TEXTURES] * sizeof(lmb_texture);
    l.instances = l.materials + (uint64_t)p->count[LMB_PACK_MATERIALS] * sizeof(lmb_material);
    l.lights = l.instances + (uint64_t)p->count[LMB_PACK_INSTANCES] * sizeof(lmb_instance);
    l.bytes = l.lights + (uint64_t)p->count[LMB_PACK_LIGHTS] * sizeof(lmb_light);
    return l;
}

size_t lmb_pack_bytes(const lmb_pack *pack)
{
    return pack != NULL && pack->data != NULL ? size_or_none(lay_out_scene(pack).bytes) : 0;
}

static lmb_status check_pack(const lmb_pack *pack, const void *memory, size_t bytes)
{
    if (pack == NULL || pack->data == NULL || memory == NULL) {
        return LMB_ERR_ARG;
    }
    if ((uintptr_t)memory % sizeof(void *) != 0) {
        return LMB_ERR_ALIGN;
    }
    return check_memory(memory, bytes, lay_out_scene(pack).bytes > 0 ? lmb_pack_bytes(pack) : 1);
}

static void take_instances(lmb_instance *out, const lmb_pack *p)
{
    uint32_t id = 1;
    for (uint32_t i = 0; i < p->count[LMB_PACK_INSTANCES]; ++i) {
        const uint32_t *w = lmb_pack_record(p, LMB_PACK_INSTANCES, i);
        memset(&out[i], 0, sizeof out[i]);
        lmb_pack_take_matrix(&out[i].to_world, w);
        out[i].mesh = w[12];
        out[i].material = w[13];
        out[i].first_id = id;
        id += lmb_pack_record(p, LMB_PACK_MESHES, w[12])[1];
    }
}

lmb_status lmb_pack_scene(lmb_scene *out, const lmb_pack *pack, void *memory, size_t bytes)
{
    const lmb_status status = check_pack(pack, memory, bytes);
    if (out == NULL || status != LMB_OK) {
        return out == NULL ? LMB_ERR_ARG : status;
    }
    const layout l = lay_out_scene(pack);
    uint8_t *at = (uint8_t *)memory;
    lmb_mesh *meshes = (lmb_mesh *)(void *)(at + l.meshes);
    lmb_texture *textures = (lmb_texture *)(void *)(at + l.textures);
    lmb_material *materials = (lmb_material *)(void *)(at + l.materials);
    lmb_instance *instances = (lmb_instance *)(void *)(at + l.instances);
    lmb_light *lights = (lmb_light *)(void *)(at + l.lights);
    memset(out, 0, sizeof *out);
    out->meshes = meshes;
    out->textures = textures;
    out->materials = materials;
    out->instances = instances;
    out->lights = lights;
    for (; out->mesh_count < pack->count[LMB_PACK_MESHES]; ++out->mesh_count) {
        lmb_pack_take_mesh(&meshes[out->mesh_count], pack, out->mesh_count);
    }
    for (; out->texture_count < pack->count[LMB_PACK_TEXTURES]; ++out->texture_count) {
        lmb_pack_take_texture(&textures[out->texture_count], pack, out->texture_count);
    }
    for (; out->material_count < pack->count[LMB_PACK_MATERIALS]; ++out->material_count) {
        lmb_pack_take_material(&materials[out->material_count], pack, out->material_count);
    }
    for (; out->light_count < pack->count[LMB_PACK_LIGHTS]; ++out->light_count) {
        lmb_pack_take_light(&lights[out->light_count], pack, out->light_count);
    }
    take_instances(instances, pack);
    out->instance_count = pack->count[LMB_PACK_INSTANCES];
    lmb_pack_take_bounds(out, pack);
    return lmb_scene_check(out);
}

/* --- animation ---------------------------------------------------------------------------------------------------- */

lmb_status lmb_pack_pose(lmb_scene *inout, const lmb_pack *pack, float time_s)
{
    if (inout == NULL || pack == NULL || pack->data == NULL ||
        inout->instance_count != pack->count[LMB_PACK_INSTANCES] ||
        inout->light_count != pack->count[LMB_PACK_LIGHTS] || inout->mesh_count != pack->count[LMB_PACK_MESHES]) {
        return LMB_ERR_ARG;
    }
    lmb_instance *instances = (lmb_instance *)(uintptr_t)inout->instances; /* only the scene's view of them is const */
    lmb_light *lights = (lmb_light *)(uintptr_t)inout->lights;
    int moved = 0;
    for (uint32_t i = 0; i < inout->instance_count; ++i) {
        lmb_instance to = instances[i];
        if (lmb_pack_place_instance(&to, pack, i, time_s) != LMB_OK) {
            return LMB_ERR_SCENE;
        }
        if (memcmp(&to, &instances[i], sizeof to) != 0) {
            ++to.revision;
            instances[i] = to;
            moved = 1;
        }
    }
    for (uint32_t i = 0; i < inout->light_count; ++i) {
        lmb_light to = lights[i];
        if (lmb_pack_place_light(&to, pack, i, time_s) != LMB_OK) {
            return LMB_ERR_SCENE;
        }
        if (memcmp(&to, &lights[i], sizeof to) != 0) {
            ++to.revision;
            lights[i] = to;
        }
    }
    if (moved) {
        ++inout->revision;
        lmb_scene_bounds(&inout->bounds_min, &inout->bounds_max, inout);
    }
    return LMB_OK;
}

/* Distance from a point to the farthest corner of the scene's box. */
static float reach_from(const lmb_scene *s, lmb_vec3 eye)
{
    const lmb_vec3 low = sub3(s->bounds_min, eye), high = sub3(s->bounds_max, eye);
    float far2 = 0.0f;
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 to = vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        far2 = maxf(far2, dot3(to, to));
    }
    return maxf(sqrtf(far2), 1e-4f);
}

/* Near plane, as in the tool: a ten-thousandth of `reach`, halved until it is at most 0.1 mm. */
static float near_of(float reach)
{
    float near_m = 1e-4f * reach;
    while (near_m > 1e-4f && near_m < 1e30f) { /* beyond 1e30 no view is valid */
        near_m *= 0.5f;
    }
    return near_m;
}

lmb_status lmb_pack_view(lmb_view *out, const lmb_pack *pack, const lmb_scene *scene, uint32_t camera, float time_s,
                         int32_t width, int32_t height)
{
    lmb_view v;
    if (out == NULL || pack == NULL || scene == NULL || camera >= pack->count[LMB_PACK_CAMERAS] || width < 1 ||
        height < 1 || width > LMB_MAX_FRAME || height > LMB_MAX_FRAME) {
        return LMB_ERR_ARG;
    }
    const uint32_t *w = lmb_pack_record(pack, LMB_PACK_CAMERAS, camera);
    memset(&v, 0, sizeof v);
    v.eye = lmb_pack_vec(w);
    v.right = lmb_pack_vec(w + 3);
    v.up = lmb_pack_vec(w + 6);
    v.back = lmb_pack_vec(w + 9);
    v.kind = (int32_t)w[12];
    v.half_height = lmb_pack_float(w + 14);
    v.half_width = v.half_height * ((float)width / (float)height);
    v.near_m = lmb_pack_float(w + 16);
    v.far_m = lmb_pack_float(w + 17);
    v.frame_width = width;
    v.frame_height = height;
    if (!lmb_pack_place_camera(&v, pack, camera, time_s)) {
        return LMB_ERR_SCENE;
    }
    const float reach = reach_from(scene, v.eye);
    v.near_m = v.near_m > 0.0f ? v.near_m : near_of(reach);
    v.far_m = v.kind == LMB_ORTHOGRAPHIC && v.far_m > v.near_m ? v.far_m : v.near_m + 2.0f * reach;
    *out = v;
    return LMB_OK;
}

#endif
