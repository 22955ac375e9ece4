/* io_gltf_light.c: baked light of a file that `lambent bake --to` wrote: its scale, and its picture. */
#include "io_gltf.h"

/* What asset.extras say; JSON_NONE where the file is another one's. */
static uint32_t extras(const gltf *g)
{
    const json *doc = &g->doc;
    return json_member(doc, json_member(doc, json_member(doc, 0, "asset"), "extras"), "lambent");
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
    return l->colour != NULL && l->uv != NULL;
}

int gltf_light_end(gltf *g)
{
    const uint32_t node = json_member(&g->doc, extras(g), "texture");
    uint32_t texture = JSON_NONE;
    int32_t slot = -1;
    if (!(g->b->out->light.scale > 0.0f) || node == JSON_NONE) {
        return 1;
    }
    if (!json_read_uint(&texture, &g->doc, node, g->b->r) ||
        (texture >= g->textures.count && !json_fail(&g->doc, node, g->b->r, "no such texture")) ||
        !gltf_texture(&slot, g, texture)) {
        return 0;
    }
    g->b->out->light.picture = slot >= 0 ? &g->b->textures[slot] : NULL;
    return 1;
}
