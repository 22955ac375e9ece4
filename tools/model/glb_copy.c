/* glb_copy.c: copies a glTF document with new meshes. Names, nodes, materials, textures, cameras and extras are copied
 * unchanged and keep their indices. Animations and skins are dropped because baked light does not move. Extensions that
 * refer to accessors are dropped too. */
#include <stdlib.h>
#include <string.h>

#include "glb_parts.h"

#define NONE UINT32_MAX

typedef struct copy {
    glb_writer *w;
    text_buffer *p; /* of the writer */
    json doc;
    uint32_t nodes, materials, textures, images, samplers; /* of the document */
    uint32_t *mesh_of;  /* by node: index of the mesh that is written, or NONE */
    uint32_t *posed;    /* nodes with a skin, in world space; each mesh moves to a node without a parent */
    uint32_t posed_count;
    int has_lights;     /* the lights of the scene come from the document */
    int has_specular;   /* a material has the lightmap in KHR_materials_specular */
} copy;

/* --- JSON as it is ------------------------------------------------------------------------------------------------ */

/* Writes a comma between members or items. */
static void put_comma(text_buffer *p)
{
    if (p->size > 0 && p->data[p->size - 1] != '{' && p->data[p->size - 1] != '[') {
        text_buffer_plain(p, ",");
    }
}

static void put_value(text_buffer *p, const json *doc, uint32_t node)
{
    const char *quote = json_kind(doc, node) == JSON_STRING ? "\"" : "";
    text_buffer_plain(p, quote);
    text_buffer_span(p, doc->text + doc->nodes[node].start, doc->nodes[node].size);
    text_buffer_plain(p, quote);
}

static int is_key(const json *doc, uint32_t node, const char *key)
{
    const json_node *n = &doc->nodes[node];
    return n->key_size == strlen(key) && memcmp(doc->text + n->key_start, key, n->key_size) == 0;
}

static int is_among(const json *doc, uint32_t node, const char *const *keys)
{
    while (*keys != NULL && !is_key(doc, node, *keys)) {
        ++keys;
    }
    return *keys != NULL;
}

static void put_member(text_buffer *p, const json *doc, uint32_t node)
{
    put_comma(p);
    text_buffer_plain(p, "\"");
    text_buffer_span(p, doc->text + doc->nodes[node].key_start, doc->nodes[node].key_size);
    text_buffer_plain(p, "\":");
    put_value(p, doc, node);
}

/* Writes all members of an object except those in `without`, a list that ends with NULL. */
static void put_members(text_buffer *p, const json *doc, uint32_t object, const char *const *without)
{
    for (uint32_t i = json_first(doc, object); i != JSON_NONE; i = json_next(doc, i)) {
        if (!is_among(doc, i, without)) {
            put_member(p, doc, i);
        }
    }
}

/* Writes the items of the top-level array `key`. A missing array has no items. */
static void put_items(text_buffer *p, const json *doc, const char *key)
{
    for (uint32_t i = json_first(doc, json_member(doc, 0, key)); i != JSON_NONE; i = json_next(doc, i)) {
        put_comma(p);
        put_value(p, doc, i);
    }
}

/* Returns the item of a top-level array that `reference` points to. The reader has already checked the reference. */
static uint32_t item_of(const json *doc, const char *key, uint32_t reference)
{
    uint32_t index = 0, i;
    report unread = {""};
    if (reference == JSON_NONE || !json_read_uint(&index, doc, reference, &unread)) {
        return JSON_NONE;
    }
    for (i = json_first(doc, json_member(doc, 0, key)); i != JSON_NONE && index > 0; --index) {
        i = json_next(doc, i);
    }
    return i;
}

/* --- extensions --------------------------------------------------------------------------------------------------- */

/* Extensions of meshes, and extensions with indices of objects that are not written. */
static const char *const dropped[] = {
    "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",    "EXT_structural_metadata", "EXT_mesh_features",       "EXT_instance_features",
    "KHR_animation_pointer",      "KHR_interactivity",       "KHR_materials_variants",  "MSFT_lod", NULL};

static int is_kept(const copy *c, uint32_t node)
{
    return !is_among(&c->doc, node, dropped) && (c->has_lights || !is_key(&c->doc, node, "KHR_lights_punctual"));
}

/* Writes the member "extensions" of `object`. If `more` is not NULL, it replaces the extension `instead`. */
static void put_extensions(copy *c, uint32_t object, const char *instead, const char *more)
{
    const json *doc = &c->doc;
    const uint32_t own = json_member(doc, object, "extensions");
    int count = more != NULL;
    for (uint32_t i = json_first(doc, own); i != JSON_NONE; i = json_next(doc, i)) {
        count += is_kept(c, i) && (more == NULL || !is_key(doc, i, instead));
    }
    if (count == 0) {
        return;
    }
    put_comma(c->p);
    text_buffer_plain(c->p, "\"extensions\":{");
    for (uint32_t i = json_first(doc, own); i != JSON_NONE; i = json_next(doc, i)) {
        if (is_kept(c, i) && (more == NULL || !is_key(doc, i, instead))) {
            put_member(c->p, doc, i);
        }
    }
    if (more != NULL) {
        put_comma(c->p);
        text_buffer_plain(c->p, more);
    }
    text_buffer_plain(c->p, "}");
}

/* Writes the list of names `key` without the dropped extensions, then adds `more`, a list that ends with NULL. */
static void put_names(copy *c, const char *key, const char *const *more)
{
    const json *doc = &c->doc;
    const uint32_t list = json_member(doc, 0, key);
    const size_t before = c->p->size;
    text_buffer_add(c->p, ",\"%s\":[", key);
    const size_t empty = c->p->size;
    for (uint32_t i = json_first(doc, list); i != JSON_NONE; i = json_next(doc, i)) {
        const char *const *gone = dropped;
        while (*gone != NULL && !json_equals(doc, i, *gone)) {
            ++gone;
        }
        const char *const *new = more;
        while (*new != NULL && !json_equals(doc, i, *new)) {
            ++new;
        }
        if (*gone == NULL && *new == NULL && json_kind(doc, i) == JSON_STRING) {
            put_comma(c->p);
            put_value(c->p, doc, i);
        }
    }
    for (; *more != NULL; ++more) {
        put_comma(c->p);
        text_buffer_add(c->p, "\"%s\"", *more);
    }
    if (c->p->size == empty && !c->p->is_short) { /* glTF forbids empty lists */
        c->p->size = before;
        return;
    }
    text_buffer_plain(c->p, "]");
}

/* --- nodes and meshes --------------------------------------------------------------------------------------------- */

/* Returns the index after the meshes that belong to the same node as `first`: the primitives of one mesh of the
 * file. */
static uint32_t past_of(const copy *c, uint32_t first)
{
    const model_source *s = c->w->loaded->source;
    const glb_mesh *m = c->w->mesh;
    uint32_t past = first + 1;
    while (past < c->w->mesh_count && s->node[m[past].instance] == s->node[m[first].instance]) {
        ++past;
    }
    return past;
}

/* Assigns a mesh to each node that shows one. */
static int share_meshes(copy *c)
{
    const model_source *s = c->w->loaded->source;
    uint32_t meshes = 0;
    c->mesh_of = malloc(((size_t)c->nodes + 1) * sizeof *c->mesh_of);
    c->posed = malloc(((size_t)c->nodes + 1) * sizeof *c->posed);
    if (c->mesh_of == NULL || c->posed == NULL) {
        return report_fail(c->w->r, "not enough memory for %u nodes", (unsigned)c->nodes);
    }
    memset(c->mesh_of, 0xff, ((size_t)c->nodes + 1) * sizeof *c->mesh_of);
    for (uint32_t i = 0; i < c->w->mesh_count; i = past_of(c, i)) {
        const uint32_t instance = c->w->mesh[i].instance, node = s->node[instance];
        c->mesh_of[node] = meshes++;
        if (s->is_posed[instance]) {
            c->posed[c->posed_count++] = node;
        }
    }
    return 1;
}

static int is_posed(const copy *c, uint32_t node)
{
    uint32_t i = 0;
    while (i < c->posed_count && c->posed[i] != node) {
        ++i;
    }
    return i < c->posed_count;
}

/* If the mesh of a node is in world space, moves the mesh and the name to a new node. */
static void put_nodes(copy *c)
{
    static const char *const own[] = {"mesh", "skin", "weights", "extensions", NULL},
                      *const nameless[] = {"mesh", "skin", "weights", "extensions", "name", NULL};
    const json *doc = &c->doc;
    const uint32_t list = json_member(doc, 0, "nodes");
    uint32_t number = 0;
    text_buffer_plain(c->p, ",\"nodes\":[");
    for (uint32_t i = json_first(doc, list); i != JSON_NONE; i = json_next(doc, i), ++number) {
        const int has_moved = is_posed(c, number);
        put_comma(c->p);
        text_buffer_plain(c->p, "{");
        put_members(c->p, doc, i, has_moved ? nameless : own);
        if (c->mesh_of[number] != NONE && !has_moved) {
            put_comma(c->p);
            text_buffer_add(c->p, "\"mesh\":%u", (unsigned)c->mesh_of[number]);
        }
        put_extensions(c, i, "", NULL);
        text_buffer_plain(c->p, "}");
    }
    number = 0;
    for (uint32_t i = json_first(doc, list); i != JSON_NONE; i = json_next(doc, i), ++number) {
        const uint32_t name = json_member(doc, i, "name");
        if (is_posed(c, number)) {
            text_buffer_add(c->p, ",{\"mesh\":%u", (unsigned)c->mesh_of[number]);
            if (name != JSON_NONE) {
                put_member(c->p, doc, name);
            }
            text_buffer_plain(c->p, "}");
        }
    }
    if (!c->has_lights) {
        glb_put_light_nodes(c->p, c->w->scene);
    }
    text_buffer_plain(c->p, "]");
}

static int has_parent(const copy *c, uint32_t node)
{
    const json *doc = &c->doc;
    for (uint32_t i = json_first(doc, json_member(doc, 0, "nodes")); i != JSON_NONE; i = json_next(doc, i)) {
        const uint32_t children = json_member(doc, i, "children");
        for (uint32_t k = json_first(doc, children); k != JSON_NONE; k = json_next(doc, k)) {
            uint32_t child = NONE;
            report unread = {""};
            if (json_read_uint(&child, doc, k, &unread) && child == node) {
                return 1;
            }
        }
    }
    return 0;
}

/* Writes the scene that was read, with the new nodes. */
static void put_scene(copy *c)
{
    static const char *const without[] = {"nodes", "extensions", NULL};
    const json *doc = &c->doc;
    uint32_t scene = json_first(doc, json_member(doc, 0, "scenes"));
    const uint32_t more = c->posed_count + (c->has_lights ? 0 : c->w->scene->light_count);
    for (uint32_t i = 0; i < c->w->loaded->facts.scene && scene != JSON_NONE; ++i) {
        scene = json_next(doc, scene);
    }
    text_buffer_plain(c->p, ",\"scene\":0,\"scenes\":[{");
    put_members(c->p, doc, scene, without);
    put_extensions(c, scene, "", NULL);
    put_comma(c->p);
    text_buffer_plain(c->p, "\"nodes\":[");
    const uint32_t roots = json_member(doc, scene, "nodes");
    for (uint32_t i = json_first(doc, roots); i != JSON_NONE; i = json_next(doc, i)) {
        put_comma(c->p);
        put_value(c->p, doc, i);
    }
    for (uint32_t i = 0; scene == JSON_NONE && i < c->nodes; ++i) {
        if (!has_parent(c, i)) {
            put_comma(c->p);
            text_buffer_add(c->p, "%u", (unsigned)i);
        }
    }
    for (uint32_t i = 0; i < more; ++i) {
        put_comma(c->p);
        text_buffer_add(c->p, "%u", (unsigned)(c->nodes + i));
    }
    text_buffer_plain(c->p, "]}]");
}

static void put_meshes(copy *c)
{
    static const char *const of_mesh[] = {"primitives", "weights", "extensions", NULL},
                      *const of_primitive[] = {"attributes", "indices",    "material", "mode",
                                               "targets",    "extensions", NULL};
    const model_source *s = c->w->loaded->source;
    const json *doc = &c->doc;
    for (uint32_t first = 0, past; first < c->w->mesh_count; first = past) {
        uint32_t node = json_first(doc, json_member(doc, 0, "nodes"));
        past = past_of(c, first);
        for (uint32_t i = 0; i < s->node[c->w->mesh[first].instance]; ++i) {
            node = json_next(doc, node);
        }
        text_buffer_plain(c->p, first == 0 ? ",\"meshes\":[{" : ",{");
        put_members(c->p, doc, item_of(doc, "meshes", json_member(doc, node, "mesh")), of_mesh);
        put_comma(c->p);
        text_buffer_plain(c->p, "\"primitives\":[");
        for (uint32_t i = first; i < past; ++i) {
            put_comma(c->p);
            glb_put_primitive(c->w, &c->w->mesh[i]);
            put_members(c->p, doc, s->primitive[c->w->mesh[i].instance], of_primitive);
            text_buffer_plain(c->p, "}");
        }
        text_buffer_plain(c->p, "]}");
    }
    text_buffer_plain(c->p, c->w->mesh_count > 0 ? "]" : "");
}

/* --- materials ---------------------------------------------------------------------------------------------------- */

/* Returns 1 if this texture info shows the lightmap of an earlier bake. */
static int is_old_slot(const json *doc, uint32_t info)
{
    const uint32_t texture = item_of(doc, "textures", json_member(doc, info, "index"));
    const uint32_t image = item_of(doc, "images", json_member(doc, texture, "source"));
    return json_equals(doc, json_member(doc, image, "name"), MODEL_LIGHT_NAME);
}

static int emits(const json *doc, uint32_t material)
{
    double factor[3] = {0.0, 0.0, 0.0};
    report unread = {""};
    json_read_doubles(factor, 3, doc, json_member(doc, material, "emissiveFactor"), &unread);
    return json_member(doc, material, "emissiveTexture") != JSON_NONE || factor[0] > 0.0 || factor[1] > 0.0 ||
           factor[2] > 0.0;
}

/* Puts the lightmap into the first free slot without an effect: occlusion of strength 0, emission of factor 0, or a
 * specular texture (only alpha has an effect, and the lightmap has no alpha). Each side has separate front faces, so
 * no material is double-sided. */
static void put_material(copy *c, uint32_t material)
{
    static const char *const without[] = {"doubleSided", "extensions", "occlusionTexture", NULL};
    const json *doc = &c->doc;
    const uint32_t occlusion = json_member(doc, material, "occlusionTexture"),
                   extensions = json_member(doc, material, "extensions"),
                   specular = json_member(doc, extensions, "KHR_materials_specular");
    const int is_free = occlusion == JSON_NONE || is_old_slot(doc, occlusion);
    char slot[GLB_SLOT];
    text_buffer more;
    memset(&more, 0, sizeof more);
    put_comma(c->p);
    text_buffer_plain(c->p, "{");
    put_members(c->p, doc, material, without);
    if (!is_free) {
        put_member(c->p, doc, occlusion);
    }
    glb_light_slot(slot, c->w, c->textures);
    if (c->w->light->picture != NULL && is_free) {
        put_comma(c->p);
        text_buffer_add(c->p, "\"occlusionTexture\":{%s,\"strength\":0}", slot);
    } else if (c->w->light->picture != NULL && !emits(doc, material)) {
        put_comma(c->p);
        text_buffer_add(c->p, "\"emissiveTexture\":{%s}", slot);
    } else if (c->w->light->picture != NULL && json_member(doc, specular, "specularTexture") == JSON_NONE &&
               json_member(doc, extensions, "KHR_materials_unlit") == JSON_NONE) {
        static const char *const none[] = {NULL};
        c->has_specular = 1;
        text_buffer_plain(&more, "\"KHR_materials_specular\":{");
        put_members(&more, doc, specular, none);
        put_comma(&more);
        text_buffer_add(&more, "\"specularTexture\":{%s}}", slot);
    }
    put_extensions(c, material, "KHR_materials_specular", more.data);
    c->p->is_short |= more.is_short;
    text_buffer_free(&more);
    text_buffer_plain(c->p, "}");
}

/* Writes the materials of the document, then those that the reader made for primitives without a material. */
static void put_materials(copy *c)
{
    const json *doc = &c->doc;
    char slot[GLB_SLOT];
    glb_light_slot(slot, c->w, c->textures);
    text_buffer_plain(c->p, ",\"materials\":[");
    for (uint32_t i = json_first(doc, json_member(doc, 0, "materials")); i != JSON_NONE; i = json_next(doc, i)) {
        put_material(c, i);
    }
    for (uint32_t i = c->materials; i < c->w->scene->material_count; ++i) {
        glb_put_material(c->p, &c->w->scene->materials[i], NULL, c->w->light->picture != NULL ? slot : NULL,
                         i == 0);
    }
    text_buffer_plain(c->p, "]");
}

/* --- textures ----------------------------------------------------------------------------------------------------- */

static const char *kind_of(const uint8_t *data, size_t size)
{
    return size > 3 && memcmp(data, "\377\330\377", 3) == 0          ? "image/jpeg"
           : size > 12 && memcmp(data + 8, "WEBP", 4) == 0          ? "image/webp"
           : size > 12 && memcmp(data, "\253KTX 20\273", 8) == 0    ? "image/ktx2"
                                                                    : "image/png";
}

static void put_bytes(copy *c, const uint8_t *data, size_t size)
{
    glb_writer *w = c->w;
    const size_t from = w->bytes.size;
    byte_put(&w->bytes, data, size);
    put_comma(c->p);
    text_buffer_add(c->p, "\"mimeType\":\"%s\",\"bufferView\":%u", kind_of(data, size),
                    (unsigned)glb_end_view(w, from, 0));
}

/* Embeds the bytes of each image file. An image that cannot be read is copied unchanged. */
static void put_images(copy *c)
{
    static const char *const of_bytes[] = {"bufferView", "uri", "mimeType", NULL},
                      *const of_none[] = {"bufferView", NULL},
                      *const of_old[] = {"bufferView", "uri", "mimeType", "name", NULL};
    const model_source *s = c->w->loaded->source;
    const json *doc = &c->doc;
    uint32_t number = 0;
    text_buffer_plain(c->p, ",\"images\":[");
    for (uint32_t i = json_first(doc, json_member(doc, 0, "images")); i != JSON_NONE; i = json_next(doc, i), ++number) {
        const int is_old = json_equals(doc, json_member(doc, i, "name"), MODEL_LIGHT_NAME);
        put_comma(c->p);
        text_buffer_plain(c->p, "{");
        put_members(c->p, doc, i, s->image[number] == NULL ? of_none : is_old ? of_old : of_bytes);
        if (s->image[number] != NULL) {
            put_bytes(c, s->image[number], s->image_size[number]);
        }
        text_buffer_plain(c->p, "}");
    }
    if (c->w->light->picture != NULL) {
        put_comma(c->p);
        text_buffer_plain(c->p, "{\"name\":\"" MODEL_LIGHT_NAME "\"");
        put_bytes(c, c->w->light->picture->data, c->w->light->picture->size);
        text_buffer_plain(c->p, "}");
    }
    text_buffer_plain(c->p, "]");
}

static void put_textures(copy *c)
{
    const int has_light = c->w->light->picture != NULL;
    if (c->images + (uint32_t)has_light > 0) {
        put_images(c);
    }
    if (c->samplers + (uint32_t)has_light > 0) {
        text_buffer_plain(c->p, ",\"samplers\":[");
        put_items(c->p, &c->doc, "samplers");
        if (has_light) {
            put_comma(c->p);
            text_buffer_plain(c->p, GLB_LIGHT_SAMPLER);
        }
        text_buffer_plain(c->p, "]");
    }
    if (c->textures + (uint32_t)has_light > 0) {
        text_buffer_plain(c->p, ",\"textures\":[");
        put_items(c->p, &c->doc, "textures");
        if (has_light) {
            put_comma(c->p);
            text_buffer_add(c->p, "{\"source\":%u,\"sampler\":%u}", (unsigned)c->images, (unsigned)c->samplers);
        }
        text_buffer_plain(c->p, "]");
    }
}

/* --- the document ------------------------------------------------------------------------------------------------- */

static void put_asset(copy *c)
{
    static const char *const without[] = {"version", "minVersion", "generator", "extras", NULL},
                      *const own[] = {"lambent", NULL};
    const uint32_t asset = json_member(&c->doc, 0, "asset"), extras = json_member(&c->doc, asset, "extras");
    text_buffer_plain(c->p, "{\"asset\":{");
    put_members(c->p, &c->doc, asset, without);
    put_comma(c->p);
    glb_put_version(c->p);
    text_buffer_plain(c->p, ",\"extras\":{");
    put_members(c->p, &c->doc, json_kind(&c->doc, extras) == JSON_OBJECT ? extras : JSON_NONE, own);
    put_comma(c->p);
    glb_put_extras(c->w);
    text_buffer_plain(c->p, "}}");
}

static void put_lists(copy *c)
{
    const char *more[3] = {NULL, NULL, NULL}, *const none[] = {NULL};
    int count = 0;
    if (c->has_specular) {
        more[count++] = "KHR_materials_specular";
    }
    if (!c->has_lights && c->w->scene->light_count > 0) {
        more[count] = "KHR_lights_punctual";
    }
    put_names(c, "extensionsUsed", more);
    put_names(c, "extensionsRequired", none);
}

static void put_document(copy *c)
{
    static const char *const own[] = {"asset",     "extensionsUsed", "extensionsRequired", "scene",    "scenes",
                                      "nodes",     "meshes",         "materials",          "textures", "images",
                                      "samplers",  "accessors",      "bufferViews",        "buffers",  "skins",
                                      "animations", "extensions",    NULL};
    text_buffer lights;
    memset(&lights, 0, sizeof lights);
    put_asset(c);
    put_members(c->p, &c->doc, 0, own);
    put_scene(c);
    put_nodes(c);
    put_meshes(c);
    put_materials(c);
    put_textures(c);
    if (!c->has_lights && c->w->scene->light_count > 0) {
        glb_put_lights(&lights, c->w->scene);
    }
    put_extensions(c, 0, "KHR_lights_punctual", lights.data);
    put_lists(c);
    c->p->is_short |= lights.is_short;
    text_buffer_free(&lights);
}

int glb_copy(glb_writer *w)
{
    const model_source *s = w->loaded->source;
    const lmb_scene *given = w->scene, *read = &w->loaded->scene;
    copy c;
    memset(&c, 0, sizeof c);
    c.w = w;
    c.p = &w->json;
    if (!json_parse(&c.doc, s->json, s->json_size, "the scene's document", w->r)) {
        return 0;
    }
    c.nodes = json_count(&c.doc, json_member(&c.doc, 0, "nodes"));
    c.materials = json_count(&c.doc, json_member(&c.doc, 0, "materials"));
    c.textures = json_count(&c.doc, json_member(&c.doc, 0, "textures"));
    c.images = json_count(&c.doc, json_member(&c.doc, 0, "images"));
    c.samplers = json_count(&c.doc, json_member(&c.doc, 0, "samplers"));
    c.has_lights = given->light_count == read->light_count &&
                   (given->light_count == 0 ||
                    memcmp(given->lights, read->lights, given->light_count * sizeof *given->lights) == 0);
    const int ok = share_meshes(&c);
    if (ok) {
        put_document(&c);
    }
    free(c.mesh_of);
    free(c.posed);
    json_free(&c.doc);
    return ok;
}
