/* records.c: the words of a .lmp's records -> the library's structs. Layer 1. */
#include "records.h"

#include <string.h>

#include "vec.h"

#if LMB_PACK

const uint8_t lmb_pack_words_each[LMB_PACK_KINDS] = LMB_PACK_WORDS_EACH;

const uint32_t *lmb_pack_record(const lmb_pack *p, int kind, uint32_t i)
{
    return p->part[kind] + (size_t)i * lmb_pack_words_each[kind];
}

float lmb_pack_float(const uint32_t *word)
{
    float v;
    memcpy(&v, word, sizeof v);
    return v;
}

lmb_vec3 lmb_pack_vec(const uint32_t *word)
{
    return vec3(lmb_pack_float(word), lmb_pack_float(word + 1), lmb_pack_float(word + 2));
}

static void take_floats(float *out, const uint32_t *word, size_t count) { memcpy(out, word, count * sizeof *out); }

/* Offset 0 means no data. */
static const void *data_at(const lmb_pack *p, uint32_t offset) { return offset != 0 ? p->data + offset / 4 : NULL; }

void lmb_pack_take_mesh(lmb_mesh *out, const lmb_pack *p, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_MESHES, i);
    memset(out, 0, sizeof *out);
    out->vertex_count = w[0];
    out->triangle_count = w[1];
    out->position_format = (uint8_t)(w[2] & 255u);
    out->uv_format = (uint8_t)(w[2] >> 8 & 255u);
    out->index_format = (uint8_t)(w[2] >> 16 & 255u);
    out->tangent_format = (uint8_t)(w[2] >> 24 & 15u);
    out->colour_format = (uint8_t)(w[2] >> 28);
    out->positions = data_at(p, w[3]);
    out->normals = (const int16_t *)data_at(p, w[4]);
    out->tangents = (const int16_t *)data_at(p, w[5]);
    out->uvs = data_at(p, w[6]);
    out->colours = (const uint8_t *)data_at(p, w[7]);
    out->indices = data_at(p, w[8]);
    out->position_scale = lmb_pack_vec(w + 9);
    out->position_offset = lmb_pack_vec(w + 12);
    take_floats(out->uv_scale, w + 15, 2);
}

void lmb_pack_take_material(lmb_material *out, const lmb_pack *p, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_MATERIALS, i);
    memset(out, 0, sizeof *out);
    take_floats(out->albedo, w, 3);
    out->alpha = lmb_pack_float(w + 3);
    out->alpha_cutoff = lmb_pack_float(w + 4);
    memcpy(&out->texture, w + 5, sizeof out->texture);
    out->flags = w[6];
    out->normal_map = w[7];
    out->normal_scale = lmb_pack_float(w + 8);
    take_floats(out->emission, w + 9, 3);
    take_floats(out->specular, w + 12, 3);
    out->roughness = lmb_pack_float(w + 15);
    out->emission_map = w[16];
    out->metal_map = w[17];
    out->metallic = lmb_pack_float(w + 18);
}

void lmb_pack_take_texture(lmb_texture *out, const lmb_pack *p, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_TEXTURES, i);
    memset(out, 0, sizeof *out);
    out->texels = (const uint8_t *)data_at(p, w[0]);
    out->width = (uint16_t)(w[1] & 0xffffu);
    out->height = (uint16_t)(w[1] >> 16);
    out->levels = (uint8_t)(w[2] & 255u);
    out->format = (uint8_t)(w[2] >> 8 & 255u);
    out->wrap_s = (uint8_t)(w[2] >> 16 & 255u);
    out->wrap_t = (uint8_t)(w[2] >> 24);
    out->filter = (uint8_t)w[3];
}

void lmb_pack_take_matrix(lmb_mat4 *out, const uint32_t *w)
{
    for (int c = 0; c < 4; ++c) {
        take_floats(out->m + 4 * c, w + 3 * c, 3);
        out->m[4 * c + 3] = c == 3 ? 1.0f : 0.0f;
    }
}

void lmb_pack_take_light(lmb_light *out, const lmb_pack *p, uint32_t i)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_LIGHTS, i);
    memset(out, 0, sizeof *out);
    out->position = lmb_pack_vec(w);
    out->direction = lmb_pack_vec(w + 3);
    take_floats(out->intensity, w + 6, 3);
    out->cos_inner = lmb_pack_float(w + 9);
    out->cos_outer = lmb_pack_float(w + 10);
    memcpy(&out->kind, w + 11, sizeof out->kind);
    out->range = lmb_pack_float(w + 13); /* 0 in files that older tools made */
}

void lmb_pack_take_bounds(lmb_scene *out, const lmb_pack *p)
{
    const uint32_t *w = lmb_pack_record(p, LMB_PACK_SCENE, 0);
    out->bounds_min = lmb_pack_vec(w);
    out->bounds_max = lmb_pack_vec(w + 3);
    out->core.low = lmb_pack_vec(w + 6);
    out->core.high = lmb_pack_vec(w + 9);
    out->core.wide_low = lmb_pack_vec(w + 12);
    out->core.wide_high = lmb_pack_vec(w + 15);
    memcpy(&out->core.faces, w + 18, sizeof out->core.faces);
}

#endif
