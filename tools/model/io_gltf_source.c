/* io_gltf_source.c: keeps parts of a document that the scene does not have, for writing a file from it: the JSON text,
 * the image files, and vertex attributes unchanged. */
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

/* Returns the highest TEXCOORD_ index that a material uses, + 1. The JSON nodes of a material are contiguous. */
static uint32_t count_sets(const gltf *g)
{
    const json *doc = &g->doc;
    uint32_t sets = 0;
    for (uint32_t m = 0; m < g->materials.count; ++m) {
        const json_node *own = &doc->nodes[g->materials.items[m]];
        for (uint32_t i = g->materials.items[m]; i < doc->count && doc->nodes[i].start < own->start + own->size; ++i) {
            gltf_uv uv = {0};
            report unread = {""};
            if (json_kind(doc, i) != JSON_OBJECT || json_member(doc, i, "index") == JSON_NONE) {
                continue;
            }
            const uint32_t more = json_member(doc, json_member(doc, i, "extensions"), "KHR_texture_transform");
            json_read_uint(&uv.set, doc, json_member(doc, i, "texCoord"), &unread);
            json_read_uint(&uv.set, doc, json_member(doc, more, "texCoord"), &unread);
            sets = uv.set < 16 && uv.set >= sets ? uv.set + 1 : sets;
        }
    }
    return sets;
}

/* Makes one stream for each accessor. Primitives share it. */
static int read_stream(float **out, gltf *g, float **known, uint32_t reference, uint32_t components, uint32_t vertices)
{
    gltf_accessor a;
    uint32_t index;
    *out = NULL;
    if (!gltf_attribute(&a, &index, g, reference, components, components, vertices)) {
        return 0;
    }
    if (index == JSON_NONE) {
        return 1;
    }
    if (known[index] == NULL) {
        float *made = build_keep(g->b, (uint64_t)a.count * components, sizeof *made);
        if (made == NULL || !gltf_accessor_floats(made, g, &a)) {
            return 0;
        }
        known[index] = made;
    }
    *out = known[index];
    return 1;
}

/* A posed mesh gets no tangents: the renderer that reads the file must compute them. */
static int read_streams(model_source *s, gltf *g, float **known, uint32_t mesh, int is_posed)
{
    const uint32_t attributes = json_member(&g->doc, g->mesh_primitive[mesh], "attributes"),
                   vertices = g->b->meshes[mesh].vertex_count;
    for (uint32_t set = 0; set < MODEL_UV_SETS && set < s->uv_sets; ++set) {
        char key[24];
        snprintf(key, sizeof key, "TEXCOORD_%u", (unsigned)set);
        if (!read_stream(&s->uv[set][mesh], g, known, json_member(&g->doc, attributes, key), 2, vertices)) {
            return 0;
        }
    }
    return is_posed ||
           read_stream(&s->tangent[mesh], g, known, json_member(&g->doc, attributes, "TANGENT"), 4, vertices);
}

/* An image that cannot be read stays as it is in the document. */
static int keep_images(model_source *s, gltf *g)
{
    for (uint32_t i = 0; i < g->images.count; ++i) {
        gltf_bytes bytes = {NULL, 0, 0};
        char place[GLTF_PLACE];
        report why = {""};
        if (!gltf_image_bytes(&bytes, place, g, i, &why)) {
            if (g->b->r->text[0] != '\0') {
                return 0;
            }
            continue;
        }
        uint8_t *kept = build_keep(g->b, bytes.size, 1);
        if (kept == NULL) {
            return 0;
        }
        memcpy(kept, bytes.data, bytes.size);
        s->image[i] = kept;
        s->image_size[i] = bytes.size;
    }
    return 1;
}

static int make_tables(model_source *s, gltf *g)
{
    const uint32_t meshes = g->b->mesh_count, instances = g->b->instance_count;
    char *text = build_keep(g->b, (uint64_t)g->doc.size + 1, 1);
    s->image = build_keep(g->b, g->images.count, sizeof *s->image);
    s->image_size = build_keep(g->b, g->images.count, sizeof *s->image_size);
    s->node = build_keep(g->b, instances, sizeof *s->node);
    s->primitive = build_keep(g->b, instances, sizeof *s->primitive);
    s->is_posed = build_keep(g->b, instances, 1);
    s->tangent = build_keep(g->b, meshes, sizeof *s->tangent);
    for (int set = 0; set < MODEL_UV_SETS; ++set) {
        s->uv[set] = build_keep(g->b, meshes, sizeof *s->uv[set]);
    }
    if (text == NULL || g->b->r->text[0] != '\0') {
        return 0;
    }
    memcpy(text, g->doc.text, g->doc.size);
    s->json = text;
    s->json_size = g->doc.size;
    return 1;
}

int gltf_source(gltf *g)
{
    if (GLTF_HAS_CROWDS && g->places > 0) /* a node with several places has no single transform */
        return 1;
    model_source *s = build_keep(g->b, 1, sizeof *s);
    float **known = build_scratch(g->b, g->accessors.count, sizeof *known);
    uint8_t *is_read = build_scratch(g->b, g->b->mesh_count, 1);
    if (s == NULL || known == NULL || is_read == NULL || !make_tables(s, g) || !keep_images(s, g)) {
        return 0;
    }
    s->uv_sets = count_sets(g);
    for (uint32_t i = 0; i < g->b->instance_count; ++i) {
        const uint32_t mesh = g->b->instances[i].mesh;
        s->node[i] = g->instance_from[i];
        s->primitive[i] = g->mesh_primitive[mesh];
        s->is_posed[i] = g->instance_node[i] == MODEL_NONE;
        if (!is_read[mesh] && !read_streams(s, g, known, mesh, s->is_posed[i])) {
            return 0;
        }
        is_read[mesh] = 1;
    }
    g->b->out->source = s;
    return 1;
}
