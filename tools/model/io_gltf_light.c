/* io_gltf_light.c: reads baked light from a file that `lambent bake --to` wrote: the scale and the lightmap.
 *
 * The lightmap is an image with the name MODEL_LIGHT_NAME. Each material refers to it in a slot without an effect,
 * because tools that rewrite the file keep only textures that materials refer to. Older files have the index of the
 * texture in asset.extras. That index is valid only until another tool rewrites the file. */
#include "io_gltf.h"

/* The content of asset.extras; JSON_NONE if another program wrote the file. */
static uint32_t extras(const gltf *g)
{
    const json *doc = &g->doc;
    return json_member(doc, json_member(doc, json_member(doc, 0, "asset"), "extras"), "lambent");
}

/* Returns 1 if texture `index` shows the lightmap. */
static int is_light(const gltf *g, uint32_t index)
{
    uint32_t source = JSON_NONE;
    report unread = {""};
    return index < g->textures.count &&
           json_read_uint(&source, &g->doc, json_member(&g->doc, g->textures.items[index], "source"), &unread) &&
           source < g->images.count &&
           json_equals(&g->doc, json_member(&g->doc, g->images.items[source], "name"), MODEL_LIGHT_NAME);
}

/* Returns the texture info of a material that shows the lightmap, or JSON_NONE if there is none. */
static uint32_t find_slot(const gltf *g, uint32_t material)
{
    const json *doc = &g->doc;
    const uint32_t past = doc->nodes[material].start + doc->nodes[material].size;
    for (uint32_t i = material; i < doc->count && doc->nodes[i].start < past; ++i) {
        uint32_t index = JSON_NONE;
        report unread = {""};
        if (json_kind(doc, i) == JSON_OBJECT &&
            json_read_uint(&index, doc, json_member(doc, i, "index"), &unread) && is_light(g, index)) {
            return i;
        }
    }
    return JSON_NONE;
}

int gltf_light_is_slot(const gltf *g, uint32_t info)
{
    uint32_t index = 0;
    report unread = {""};
    return g->light_uv != NULL && json_read_uint(&index, &g->doc, json_member(&g->doc, info, "index"), &unread) &&
           (index >= g->textures.count || is_light(g, index));
}

/* Finds the texture coordinates of the lightmap for each material. */
static int find_coordinates(gltf *g)
{
    uint32_t set = 1;
    g->light_uv = build_scratch(g->b, (uint64_t)g->materials.count + 1, sizeof *g->light_uv);
    if (g->light_uv == NULL ||
        !json_read_uint(&set, &g->doc, json_member(&g->doc, extras(g), "texCoord"), g->b->r)) {
        return 0;
    }
    for (uint32_t i = 0; i <= g->materials.count; ++i) {
        const uint32_t slot = i < g->materials.count ? find_slot(g, g->materials.items[i]) : JSON_NONE;
        g->light_uv[i].set = set;
        if (slot != JSON_NONE && !gltf_read_uv(&g->light_uv[i], g, slot)) {
            return 0;
        }
    }
    return 1;
}

int gltf_light_begin(gltf *g, uint32_t meshes)
{
    model_light *l = &g->b->out->light;
    double scale = 0.0;
    if (!json_read_double(&scale, &g->doc, json_member(&g->doc, extras(g), "scale"), g->b->r)) {
        return 0;
    }
    if (!(scale > 0.0 && scale < 1e30)) {
        return 1;
    }
    l->scale = (float)scale;
    l->colour = build_keep(g->b, meshes, sizeof *l->colour);
    l->uv = build_keep(g->b, meshes, sizeof *l->uv);
    return l->colour != NULL && l->uv != NULL && find_coordinates(g);
}

/* Finds the texture by name, else by the index in older files unless a material uses that texture. */
static int find_picture(uint32_t *out, gltf *g)
{
    const json *doc = &g->doc;
    uint32_t texture = JSON_NONE;
    *out = JSON_NONE;
    for (uint32_t i = 0; i < g->textures.count && *out == JSON_NONE; ++i) {
        *out = is_light(g, i) ? i : JSON_NONE;
    }
    if (*out != JSON_NONE) {
        return 1;
    }
    if (!json_read_uint(&texture, doc, json_member(doc, extras(g), "texture"), g->b->r)) {
        return 0;
    }
    *out = texture < g->textures.count ? texture : JSON_NONE;
    for (uint32_t m = 0; m < g->materials.count; ++m) {
        const uint32_t past = doc->nodes[g->materials.items[m]].start + doc->nodes[g->materials.items[m]].size;
        for (uint32_t i = g->materials.items[m]; i < doc->count && doc->nodes[i].start < past; ++i) {
            uint32_t index = JSON_NONE;
            report unread = {""};
            if (json_kind(doc, i) == JSON_OBJECT &&
                json_read_uint(&index, doc, json_member(doc, i, "index"), &unread) && index == *out) {
                *out = JSON_NONE;
            }
        }
    }
    return 1;
}

int gltf_light_end(gltf *g)
{
    uint32_t texture = JSON_NONE;
    int32_t slot = -1;
    if (!(g->b->out->light.scale > 0.0f) ||
        !json_equals(&g->doc, json_member(&g->doc, extras(g), "light"), "lightmap")) {
        return 1;
    }
    if (!find_picture(&texture, g) || (texture != JSON_NONE && !gltf_texture(&slot, g, texture))) {
        return 0;
    }
    g->b->out->light.picture = slot >= 0 ? &g->b->textures[slot] : NULL;
    if (slot < 0) {
        build_note(g->b, "the lightmap is gone: another tool has dropped its texture; bake again");
    }
    return 1;
}
