/* io_lmp.c: reads packed scenes: the library opens them; cameras and motion are converted to those of a model. */
#include "io_lmp.h"

#include <string.h>

#include "../common/checksum.h"
#include "model_motion.h"

int lmp_begins(const uint8_t *data, size_t size) { return size >= 4 && memcmp(data, "LMP", 3) == 0; }

int lmp_refuse(const char *path, const uint8_t *data, size_t size, report *r)
{
    static const uint32_t own = 0x01020304u;
    const uint8_t *order = (const uint8_t *)&own;
    uint32_t bytes;
    if (data[3] != LMB_PACK_VERSION) {
        return report_fail(r, "%s: a packed scene of version %d, and this reads version %d; pack it again", path,
                           data[3], LMB_PACK_VERSION);
    }
    if (size >= 8 && data[4] == order[3] && data[5] == order[2] && data[6] == order[1] && data[7] == order[0]) {
        const int is_big = order[0] == 1;
        return report_fail(r, "%s: packed for %s-endian machines, unlike this one; pack it with --endian %s", path,
                           is_big ? "little" : "big", is_big ? "big" : "little");
    }
    if (size >= 12) {
        memcpy(&bytes, data + 8, sizeof bytes);
        if (bytes > size) {
            return report_fail(r, "%s: a packed scene of %u bytes, of which %zu are there; copy it again", path,
                               (unsigned)bytes, size);
        }
    }
    return report_fail(r, "%s: a damaged packed scene; pack it again", path);
}

/* --- cameras ------------------------------------------------------------------------------------------------------ */

/* Each name ends with a 0; missing ones have none. */
static void name_cameras(model *m, const lmb_pack *p)
{
    size_t bytes;
    const char *name = (const char *)lmb_pack_part(p, LMB_PACK_NAMES, &bytes),
               *end = name != NULL ? name + bytes : NULL;
    for (uint32_t i = 0; name != NULL && i < m->camera_count; ++i) {
        const char *zero = (const char *)memchr(name, 0, (size_t)(end - name));
        if (zero == NULL) {
            return;
        }
        if ((size_t)(zero - name) < sizeof m->cameras[i].name) {
            memcpy(m->cameras[i].name, name, (size_t)(zero - name) + 1);
        }
        name = zero + 1;
    }
}

static const uint32_t *record_of(const lmb_pack *p, int kind, uint32_t words, uint32_t i)
{
    return p->part[kind] + (size_t)words * i;
}

static int take_cameras(model_build *b, const lmb_pack *p)
{
    model *m = b->out;
    m->camera_count = p->count[LMB_PACK_CAMERAS];
    m->cameras = (model_camera *)build_keep(b, m->camera_count, sizeof *m->cameras);
    for (uint32_t i = 0; m->cameras != NULL && i < m->camera_count; ++i) {
        const uint32_t *w = record_of(p, LMB_PACK_CAMERAS, LMB_PACK_CAMERA_WORDS, i);
        model_camera *c = &m->cameras[i];
        float f[19];
        memcpy(f, w, sizeof f);
        memcpy(&c->eye, f, sizeof c->eye);
        memcpy(&c->right, f + 3, sizeof c->right);
        memcpy(&c->up, f + 6, sizeof c->up);
        memcpy(&c->back, f + 9, sizeof c->back);
        c->orthographic = w[12] == LMB_ORTHOGRAPHIC;
        c->half_width = f[13];
        c->half_height = f[14];
        c->aspect = f[15];
        c->near_m = f[16];
        c->far_m = f[17];
        c->yfov_rad = f[18];
    }
    if (m->cameras != NULL) {
        name_cameras(m, p);
    }
    return m->cameras != NULL;
}

/* --- moving items ------------------------------------------------------------------------------------------------- */

/* `word`: of a record with `words`, names the node that moves the item. */
static const uint32_t *nodes_of(model_build *b, const lmb_pack *p, int kind, uint32_t words, uint32_t word)
{
    uint32_t *out = (uint32_t *)build_keep(b, p->count[kind], sizeof *out);
    for (uint32_t i = 0; out != NULL && i < p->count[kind]; ++i) {
        out[i] = record_of(p, kind, words, i)[word];
    }
    return out;
}

static int take_motion(model_build *b, const lmb_pack *p)
{
    struct model_motion *m;
    if (p->count[LMB_PACK_TRACKS] == 0) {
        return 1;
    }
    m = (struct model_motion *)build_keep(b, 1, sizeof *m);
    if (m == NULL) {
        return 0;
    }
    m->nodes = p->count[LMB_PACK_NODES];
    m->tracks = p->count[LMB_PACK_TRACKS];
    m->end_s = (double)p->seconds;
    m->of_instance = nodes_of(b, p, LMB_PACK_INSTANCES, LMB_PACK_INSTANCE_WORDS, 14);
    m->of_light = nodes_of(b, p, LMB_PACK_LIGHTS, LMB_PACK_LIGHT_WORDS, 12);
    m->of_camera = nodes_of(b, p, LMB_PACK_CAMERAS, LMB_PACK_CAMERA_WORDS, 19);
    m->moves = (uint8_t *)build_keep(b, m->nodes, 1);
    if (m->of_instance == NULL || m->of_light == NULL || m->of_camera == NULL || m->moves == NULL) {
        return 0;
    }
    for (uint32_t i = 0; i < m->nodes; ++i) {
        const uint32_t *w = record_of(p, LMB_PACK_NODES, LMB_PACK_NODE_WORDS, i);
        m->moves[i] = w[2] > 0 || (w[0] != LMB_PACK_NONE && m->moves[w[0]]);
    }
    b->out->motion = m;
    return 1;
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

/* Keeps the lobes of a packed scene, if it has any, for model_make_glossy. */
static int take_lobes(model_build *b)
{
    model_lobe *lobes;
    if (!lmb_scene_is_glossy(&b->out->scene)) {
        return 1;
    }
    lobes = (model_lobe *)build_keep(b, b->material_count, sizeof *lobes);
    for (uint32_t i = 0; lobes != NULL && i < b->material_count; ++i) {
        const lmb_material *m = &b->materials[i];
        memcpy(lobes[i].albedo, m->albedo, sizeof lobes[i].albedo);
        memcpy(lobes[i].specular, m->specular, sizeof lobes[i].specular);
        lobes[i].roughness = m->roughness;
        lobes[i].metallic = m->metallic;
        lobes[i].metal_map = m->metal_map;
    }
    b->out->lobes = lobes;
    return lobes != NULL;
}

/* The arrays lie in a block that the model owns: only the scene's view of them is const. */
static int take_scene(model_build *b, const lmb_pack *p)
{
    const size_t bytes = lmb_pack_bytes(p);
    void *memory = build_keep(b, bytes + 1, 1);
    lmb_scene *s = &b->out->scene;
    lmb_status status;
    if (memory == NULL) {
        return 0;
    }
    status = lmb_pack_scene(s, p, memory, bytes + 1);
    if (status != LMB_OK) {
        return report_fail(b->r, "%s: the packed scene is not valid (%s); pack it again", b->path,
                           lmb_status_name(status));
    }
    b->meshes = (lmb_mesh *)(uintptr_t)s->meshes;
    b->materials = (lmb_material *)(uintptr_t)s->materials;
    b->textures = (lmb_texture *)(uintptr_t)s->textures;
    b->instances = (lmb_instance *)(uintptr_t)s->instances;
    b->lights = (lmb_light *)(uintptr_t)s->lights;
    b->mesh_count = s->mesh_count;
    b->material_count = s->material_count;
    b->texture_count = s->texture_count;
    b->instance_count = s->instance_count;
    b->light_count = s->light_count;
    return take_lobes(b);
}

static void count_facts(model *m, const lmb_pack *p)
{
    model_facts *f = &m->facts;
    f->format = "LMP";
    f->materials = p->count[LMB_PACK_MATERIALS];
    f->lights = p->count[LMB_PACK_LIGHTS];
    f->cameras = p->count[LMB_PACK_CAMERAS];
    f->animations = p->count[LMB_PACK_NODES] > 0; /* nodes without tracks: it moved omitted items */
    f->nodes = p->count[LMB_PACK_NODES];
    f->texel_bytes = p->bytes[LMB_PACK_TEXELS];
}

int lmp_load(model_build *b, const uint8_t *data, size_t size)
{
    uint8_t *copy = (uint8_t *)build_keep(b, size, 1);
    lmb_pack *p = (lmb_pack *)build_keep(b, 1, sizeof *p);
    if (copy == NULL || p == NULL) {
        return 0;
    }
    memcpy(copy, data, size);
    if (lmb_pack_open(p, copy, size) != LMB_OK || !checksum_fits(copy, size, LMB_PACK_HEADER_WORDS)) {
        return lmp_refuse(b->path, data, size, b->r);
    }
    b->out->pack = p;
    count_facts(b->out, p);
    return take_scene(b, p) && take_cameras(b, p) && take_motion(b, p);
}
