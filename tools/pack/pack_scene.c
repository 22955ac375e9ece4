/* pack_scene.c: packs a model, or copies the parts of a packed scene unchanged. */
#include "pack.h"

#include <stdlib.h>
#include <string.h>


void pack_free(pack *p)
{
    for (int i = 0; i < LMB_PACK_KINDS; ++i) {
        free(p->part[i].data);
    }
    memset(p, 0, sizeof *p);
}

/* --- records ------------------------------------------------------------------------------------------------------ */

static uint32_t slot_of(const uint32_t *slot, uint32_t texture, uint32_t count)
{
    return texture < count && slot[texture] != UINT32_MAX ? slot[texture] : 0;
}

static void put_floats(pack_buffer *to, const float *v, int count)
{
    for (int i = 0; i < count; ++i) {
        pack_float(to, v[i]);
    }
}

static void put_materials(pack *out, const lmb_scene *s, const uint32_t *slot)
{
    pack_buffer *to = &out->part[LMB_PACK_MATERIALS];
    for (uint32_t i = 0; i < s->material_count; ++i) {
        const lmb_material *m = &s->materials[i];
        put_floats(to, m->albedo, 3);
        pack_float(to, m->alpha);
        pack_float(to, m->alpha_cutoff);
        pack_word(to, m->texture >= 0 ? slot_of(slot, (uint32_t)m->texture, s->texture_count) : UINT32_MAX);
        pack_word(to, m->flags);
        pack_word(to, m->normal_scale != 0.0f ? slot_of(slot, m->normal_map, s->texture_count) : 0);
        pack_float(to, m->normal_scale);
        put_floats(to, m->emission, 3);
        put_floats(to, m->specular, 3);
        pack_float(to, m->roughness);
        pack_word(to, m->emission_map > 0 ? 1 + slot_of(slot, m->emission_map - 1, s->texture_count) : 0);
        pack_word(to, m->metal_map > 0 ? 1 + slot_of(slot, m->metal_map - 1, s->texture_count) : 0);
        pack_float(to, m->metallic);
        pack_word(to, 0);
    }
}

static void put_instances(pack *out, const lmb_scene *s, const uint32_t *node)
{
    pack_buffer *to = &out->part[LMB_PACK_INSTANCES];
    for (uint32_t i = 0; i < s->instance_count; ++i) {
        const lmb_instance *in = &s->instances[i];
        for (int c = 0; c < 4; ++c) {
            put_floats(to, in->to_world.m + 4 * c, 3);
        }
        pack_word(to, in->mesh);
        pack_word(to, in->material);
        pack_word(to, node[i]);
        pack_word(to, 0);
    }
}

static void put_lights(pack *out, const lmb_scene *s, const uint32_t *node)
{
    pack_buffer *to = &out->part[LMB_PACK_LIGHTS];
    for (uint32_t i = 0; i < s->light_count; ++i) {
        const lmb_light *l = &s->lights[i];
        pack_vec(to, l->position);
        pack_vec(to, l->direction);
        put_floats(to, l->intensity, 3);
        pack_float(to, l->cos_inner);
        pack_float(to, l->cos_outer);
        pack_word(to, (uint32_t)l->kind);
        pack_word(to, node[i]);
        pack_float(to, l->range);
        pack_words(to, 2, 0);
    }
}

/* Writes a camera. Tangents use the library's function, which is equal on every machine. */
static void put_camera(pack *out, const model_camera *c, uint32_t node)
{
    pack_buffer *to = &out->part[LMB_PACK_CAMERAS], *names = &out->part[LMB_PACK_NAMES];
    const float tangent = lmb_tan(0.5f * c->yfov_rad), aspect = c->aspect > 0.0f ? c->aspect : 1.0f;
    pack_vec(to, c->eye);
    pack_vec(to, c->right);
    pack_vec(to, c->up);
    pack_vec(to, c->back);
    pack_word(to, c->orthographic ? LMB_ORTHOGRAPHIC : LMB_PERSPECTIVE);
    pack_float(to, c->orthographic ? c->half_width : tangent * aspect);
    pack_float(to, c->orthographic ? c->half_height : tangent);
    pack_float(to, c->aspect);
    pack_float(to, c->near_m);
    pack_float(to, c->far_m);
    pack_float(to, c->orthographic ? 0.0f : c->yfov_rad);
    pack_word(to, node);
    pack_put(names, c->name, strlen(c->name) + 1);
    if (!names->is_short) { /* padding zeros would count as names */
        names->size -= (4 - (strlen(c->name) + 1) % 4) % 4;
    }
}

static void put_cameras(pack *out, const model *m, const uint32_t *node)
{
    pack_buffer *names = &out->part[LMB_PACK_NAMES];
    int any = 0;
    for (uint32_t i = 0; i < m->camera_count; ++i) {
        put_camera(out, &m->cameras[i], node[i]);
        any |= m->cameras[i].name[0] != '\0';
    }
    names->size = any ? (names->size + 3) / 4 * 4 : 0;
}

/* Sets the bounds of the packed scene, which is the one drawn: opens the file once without bounds. */
static int put_bounds(pack *out, report *r)
{
    pack_buffer *to = &out->part[LMB_PACK_SCENE];
    file_bytes file = {NULL, 0};
    lmb_pack opened;
    lmb_scene s;
    void *memory = NULL;
    memset(&s, 0, sizeof s);
    pack_words(to, LMB_PACK_SCENE_WORDS, 0);
    int ok = pack_file(&file, out, r);
    if (ok) {
        const size_t bytes = lmb_pack_open(&opened, file.data, file.size) == LMB_OK ? lmb_pack_bytes(&opened) + 1 : 0;
        memory = bytes > 0 ? malloc(bytes) : NULL;
        ok = (bytes > 0 || report_fail(r, "what was packed does not open")) &&
             (memory != NULL || report_fail(r, "not enough memory for its scene")) &&
             (lmb_pack_scene(&s, &opened, memory, bytes) == LMB_OK || report_fail(r, "what was packed is not valid"));
    }
    if (ok) {
        lmb_scene_bounds(&s.bounds_min, &s.bounds_max, &s);
        lmb_scene_core(&s.core, &s);
        to->size = 0;
        pack_vec(to, s.bounds_min);
        pack_vec(to, s.bounds_max);
        pack_vec(to, s.core.low);
        pack_vec(to, s.core.high);
        pack_vec(to, s.core.wide_low);
        pack_vec(to, s.core.wide_high);
        pack_word(to, (uint32_t)s.core.faces);
        pack_word(to, 0);
    }
    free(memory);
    file_free(&file);
    return ok;
}

int pack_model(pack *out, const model *m, const pack_settings *set, report *r)
{
    const lmb_scene *s = &m->scene;
    const size_t nodes = (size_t)s->instance_count + s->light_count + m->camera_count;
    uint32_t *slot = malloc(((size_t)s->texture_count + nodes + 1) * sizeof *slot);
    if (slot == NULL) {
        return report_fail(r, "not enough memory for %u objects", (unsigned)s->instance_count);
    }
    uint32_t *instance = slot + s->texture_count, *light = instance + s->instance_count,
             *camera = light + s->light_count;
    int ok = pack_meshes(out, s, set, r) && pack_textures(out, slot, s, set, r) &&
             pack_motion(out, m, instance, light, camera, r);
    if (ok) {
        put_materials(out, s, slot);
        put_instances(out, s, instance);
        put_lights(out, s, light);
        put_cameras(out, m, camera);
        ok = put_bounds(out, r);
    }
    free(slot);
    return ok;
}

/* --- a packed scene ----------------------------------------------------------------------------------------------- */

/* Makes a record's offset relative to the part's start. Returns 0 if it points outside the part. */
static int rebase(uint32_t *word, const lmb_pack *from, int kind)
{
    const uint32_t start = from->part[kind] != NULL ? (uint32_t)(4 * (from->part[kind] - from->data)) : 0;
    if (*word == 0) {
        return 1;
    }
    if (from->part[kind] == NULL || *word < start || *word - start > from->bytes[kind]) {
        return 0;
    }
    *word = *word - start + 4;
    return 1;
}

/* Does it still open with the parts moved? A stream may have continued into another part. */
static int is_whole(const pack *p, report *r)
{
    file_bytes file = {NULL, 0};
    lmb_pack opened;
    const int ok = pack_file(&file, p, r) && lmb_pack_open(&opened, file.data, file.size) == LMB_OK;
    file_free(&file);
    return ok;
}

int pack_take(pack *out, const lmb_pack *from, const char *path, report *r)
{
    /* Kind of the records, first word with an offset, number of offsets, part that they point into. */
    static const int offsets[][4] = {{LMB_PACK_MESHES, 3, 5, LMB_PACK_VERTICES},
                                     {LMB_PACK_MESHES, 8, 1, LMB_PACK_INDICES},
                                     {LMB_PACK_TEXTURES, 0, 1, LMB_PACK_TEXELS},
                                     {LMB_PACK_TRACKS, 2, 2, LMB_PACK_KEYS}};
    static const uint8_t words_each[LMB_PACK_KINDS] = LMB_PACK_WORDS_EACH;
    int ok = 1;
    for (int kind = 1; kind < LMB_PACK_KINDS; ++kind) {
        if (from->part[kind] != NULL) {
            pack_put(&out->part[kind], from->part[kind], from->bytes[kind]);
        }
    }
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; ++i) {
        const int kind = offsets[i][0];
        const size_t each = words_each[kind];
        uint32_t *word = (uint32_t *)(void *)out->part[kind].data;
        for (uint32_t k = 0; !out->part[kind].is_short && k < from->count[kind]; ++k, word += each) {
            for (int w = 0; w < offsets[i][2]; ++w) {
                ok &= rebase(word + offsets[i][1] + w, from, offsets[i][3]);
            }
        }
    }
    return (ok && is_whole(out, r)) ||
           report_fail(r, "%s: a packed scene whose parts lie in one another; pack its source again", path);
}
