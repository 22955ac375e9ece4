/* io_gltf.c: reads glTF 2.0: version and extensions, instances, notes; the other io_gltf_*.c read the parts. */
#include <stdio.h>
#include <string.h>

#include "io_gltf.h"

static int check_version(gltf *g)
{
    const uint32_t asset = json_member(&g->doc, 0, "asset");
    char version[16];
    json_string(version, sizeof version, &g->doc, json_member(&g->doc, asset, "version"));
    if (strncmp(version, "2.", 2) == 0)
        return 1;
    return json_fail(&g->doc, asset, g->b->r, "version is not 2.x; export as glTF 2.0");
}

/* Returns the MODEL_EXTENSION_ support for an extension name. */
static int extension_use(const gltf *g, uint32_t name)
{
    static const struct {
        const char *name;
        int use;
    } known[] = {{"KHR_lights_punctual", MODEL_EXTENSION_READ},
                 {"KHR_texture_transform", MODEL_EXTENSION_FOLDED},
                 {"KHR_materials_unlit", MODEL_EXTENSION_FOLDED},
                 {"KHR_materials_pbrSpecularGlossiness", MODEL_EXTENSION_FOLDED},
                 {"KHR_materials_emissive_strength", MODEL_EXTENSION_FOLDED},
                 {"KHR_node_visibility", MODEL_EXTENSION_READ},
                 {"KHR_mesh_quantization", MODEL_EXTENSION_READ}};
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i)
        if (json_equals(&g->doc, name, known[i].name))
            return known[i].use;
    return GLTF_HAS_CROWDS ? gltf_crowd_use(g, name) : MODEL_EXTENSION_IGNORED;
}

/* Adds each name of a list once to the facts: the required ones, which come first, and the used ones. */
static void list_extensions(gltf *g, uint32_t list, int required)
{
    model_facts *facts = &g->b->out->facts;
    const uint32_t room = sizeof facts->extensions / sizeof facts->extensions[0];
    model_extension one;
    uint32_t i, k;
    for (i = json_first(&g->doc, list); i != JSON_NONE; i = json_next(&g->doc, i)) {
        memset(&one, 0, sizeof one);
        json_string(one.name, sizeof one.name, &g->doc, i);
        one.use = extension_use(g, i);
        one.required = required;
        for (k = 0; k < facts->extension_count && strcmp(facts->extensions[k].name, one.name) != 0; ++k)
            continue;
        if (k == room)
            ++facts->extension_more;
        else if (k == facts->extension_count)
            facts->extensions[facts->extension_count++] = one;
    }
}

/* Advice how to convert a file with a compression extension; NULL for others. */
static const char *advice_for(const gltf *g, uint32_t name)
{
    static const struct {
        const char *name, *advice;
    } known[] = {{"KHR_draco_mesh_compression", GLTF_UNDO_DRACO},
                 {"EXT_meshopt_compression", "decompress it: gltfpack -noq -i IN.glb -o OUT.glb"},
                 {"KHR_texture_basisu", "make its KTX2 textures PNGs: gltf-transform ktxdecompress IN.glb OUT.glb"},
                 {"EXT_texture_webp", "make its textures PNGs: gltf-transform png IN.glb OUT.glb"},
                 {"EXT_texture_avif", "make its textures PNGs: gltf-transform png IN.glb OUT.glb"}};
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i)
        if (json_equals(&g->doc, name, known[i].name))
            return known[i].advice;
    return NULL;
}

/* Required and unknown is an error; used and unknown a note. */
static int check_extensions(gltf *g)
{
    const uint32_t required = json_member(&g->doc, 0, "extensionsRequired"),
                   used = json_member(&g->doc, 0, "extensionsUsed");
    char name[64];
    uint32_t i;
    for (i = json_first(&g->doc, required); i != JSON_NONE; i = json_next(&g->doc, i)) {
        if (extension_use(g, i) != MODEL_EXTENSION_IGNORED)
            continue;
        json_string(name, sizeof name, &g->doc, i);
        return json_fail(&g->doc, i, g->b->r, "requires %s, which lambent does not read; %s", name,
                         advice_for(g, i) ? advice_for(g, i) : "export without it");
    }
    for (i = json_first(&g->doc, used); i != JSON_NONE; i = json_next(&g->doc, i)) {
        if (extension_use(g, i) != MODEL_EXTENSION_IGNORED)
            continue;
        json_string(name, sizeof name, &g->doc, i);
        build_note(g->b, "extension %s is ignored%s%s", name, advice_for(g, i) ? "; " : "",
                   advice_for(g, i) ? advice_for(g, i) : "");
    }
    list_extensions(g, required, 1);
    list_extensions(g, used, 0);
    return 1;
}
/* First mesh of each drawn node, in the tree's order. Meshes are made at first use, and again for each node with a skin
 * or weights. `mesh` is JSON_NONE if the node has no mesh. */
typedef struct shown {
    uint32_t mesh, first;
    int is_posed; /* in world metres */
} shown;

static int has(const gltf *g, uint32_t node, const char *key) { return json_member(&g->doc, node, key) != JSON_NONE; }

/* Makes a mesh with the default weights, once per mesh. */
static int make_mesh(gltf *g, uint32_t mesh)
{
    const int is_new = g->mesh_first[mesh] == JSON_NONE;
    if (!gltf_mesh(g, mesh))
        return 0;
    for (uint32_t i = g->mesh_first[mesh]; is_new && i < g->mesh_first[mesh] + g->mesh_size[mesh]; ++i)
        if (!gltf_morph(&g->b->meshes[i], g, g->meshes.items[mesh], g->mesh_primitive[i], JSON_NONE))
            return 0;
    return 1;
}

/* Copies the mesh of a node for this node only, and applies morph weights and skin. */
static int make_own(shown *inout, const gltf_tree *t, gltf *g, uint32_t node)
{
    const uint32_t mesh = inout->mesh;
    uint32_t i;
    inout->first = g->b->mesh_count;
    for (i = 0; i < g->mesh_size[mesh]; ++i) {
        const uint32_t from = g->mesh_first[mesh] + i, to = g->b->mesh_count++;
        lmb_mesh *m = &g->b->meshes[to];
        g->mesh_material[to] = g->mesh_material[from];
        g->mesh_primitive[to] = g->mesh_primitive[from];
        *m = g->b->meshes[from];
        if (!has(g, node, "weights"))
            continue;
        *m = g->mesh_rest[from];
        if (!gltf_morph(m, g, g->meshes.items[mesh], g->mesh_primitive[from], node))
            return 0;
    }
    inout->is_posed = has(g, node, "skin");
    g->left_out.skins += (uint32_t)inout->is_posed;
    return !inout->is_posed || gltf_pose(g, t, node, mesh, inout->first);
}

/* Makes the meshes of drawn nodes; *total counts repeated ones each time. */
static int make_meshes(shown *to, uint64_t *total, const gltf_tree *t, gltf *g)
{
    uint32_t i;
    *total = 0;
    for (i = 0; i < t->count; ++i) {
        const uint32_t node = g->nodes.items[t->order[i]];
        if (!gltf_index(&to[i].mesh, g, &g->meshes, json_member(&g->doc, node, "mesh")))
            return 0;
        if (t->hidden[t->order[i]])
            to[i].mesh = JSON_NONE;
        if (to[i].mesh == JSON_NONE)
            continue;
        if (!make_mesh(g, to[i].mesh))
            return 0;
        to[i].first = g->mesh_first[to[i].mesh];
        const uint32_t places = GLTF_HAS_CROWDS && g->crowd[i].count > 0 ? g->crowd[i].count : 1;
        *total += (uint64_t)g->mesh_size[to[i].mesh] * places;
        if ((has(g, node, "skin") || has(g, node, "weights")) && !make_own(&to[i], t, g, node))
            return 0;
    }
    return 1;
}

/* Instances that may take memory beside what the file's bytes allow. */
enum { FREE_INSTANCES = 1 << 20 };

/* Makes one instance per node, place and primitive; posed meshes are already in world space. */
static int add_instances(const gltf_tree *t, gltf *g)
{
    static const gltf_matrix unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    shown *nodes = (shown *)build_scratch(g->b, t->count, sizeof *nodes);
    uint64_t total;
    if (!nodes || (GLTF_HAS_CROWDS && !gltf_crowds(t, g)) || !make_meshes(nodes, &total, t, g))
        return 0;
    if (total > UINT32_MAX / sizeof(lmb_instance))
        return report_fail(g->b->r, "%s: too many instances", g->b->path);
    if (GLTF_HAS_CROWDS && g->places > 0) /* a place of 12 bytes may show many primitives */
        g->b->budget += (total < FREE_INSTANCES ? total : FREE_INSTANCES) *
                        (sizeof(lmb_instance) + 3 * sizeof(uint32_t));
    g->b->instances = (lmb_instance *)build_keep(g->b, total, sizeof *g->b->instances);
    g->instance_node = (uint32_t *)build_keep(g->b, total, sizeof *g->instance_node);
    g->instance_shown = (uint32_t *)build_scratch(g->b, total, sizeof *g->instance_shown);
    g->instance_from = (uint32_t *)build_scratch(g->b, total, sizeof *g->instance_from);
    if (!g->b->instances || !g->instance_node || !g->instance_shown || !g->instance_from)
        return 0;
    g->b->instance_count = 0;
    for (uint32_t i = 0; i < t->count; ++i) {
        const int is_posed = nodes[i].is_posed;
        const gltf_placing p = {nodes[i].mesh, nodes[i].first, i, is_posed ? MODEL_NONE : i,
                                is_posed ? &unit : &t->world[t->order[i]]};
        if (nodes[i].mesh == JSON_NONE)
            continue;
        if (!GLTF_HAS_CROWDS || g->crowd[i].count == 0)
            gltf_add_instances(g, t, &p);
        else if (!gltf_add_crowd(g, t, &p))
            return 0;
    }
    return 1;
}

static void count_occlusion_maps(gltf *g)
{
    uint32_t i;
    for (i = 0; i < g->materials.count; ++i) {
        const uint32_t map = json_member(&g->doc, g->materials.items[i], "occlusionTexture");
        g->left_out.occlusion_maps += map != JSON_NONE && !gltf_light_is_slot(g, map);
    }
}

/* Adds notes about features that the picture lacks. */
static void tell_left_out(gltf *g)
{
    const gltf_counts *n = &g->left_out;
    if (n->textures)
        build_note(g->b, "textures left out, plain colour instead: %u (first: %.120s)", (unsigned)n->textures,
                   g->texture_error.text);
    build_note_count(g->b, "primitives of points or lines skipped", n->points_lines);
    build_note_count(g->b, "primitives without POSITION skipped", n->without_positions);
    build_note_count(g->b, "primitives with vertices left over, which are dropped", n->ragged);
    build_note_count(g->b, "primitives without a material, drawn white", n->bare);
    build_note_count(g->b, "BLEND materials, which light passes or does not by alpha 0.5", n->blends);
    build_note_count_of(g->b, MODEL_NOTE_OPTION | MODEL_NOTE_GLOSSY,
                        "metallic materials, which reflect only with --glossy", n->metals);
    build_note_count_of(g->b, MODEL_NOTE_OPTION | MODEL_NOTE_GLOSSY,
                        "metallic maps used by their mean without --glossy, 0 where one cannot be read",
                        n->metal_maps);
    build_note_count(g->b, "specular-glossiness maps used by their mean, or left out where one cannot be read",
                     n->gloss_maps);
    build_note_count(g->b, "unlit materials, shown by their own colour; to other surfaces they are as any", n->unlit);
    build_note_count(g->b,
                     "emissive maps used by their mean, or left out: not the base colour's texture coordinates, or not "
                     "read",
                     n->emissive_maps);
    build_note_count(g->b, "normal maps left out: their texture coordinates are not the base colour's",
                     n->odd_normal_maps);
    build_note_count(g->b, "textured primitives without the texture coordinates, of one texel's colour",
                     n->without_uvs);
    build_note_count(g->b, "occlusion maps ignored: light is worked out here", n->occlusion_maps);
    build_note_count(g->b, "nodes that a scene names though they are no roots, or twice; drawn once", n->no_roots);
    build_note_count(g->b, "skinned nodes posed by their joints as the file places them, or in `lambent play` as "
                     "animations do", n->skins);
    build_note_count(g->b, "primitives whose morph targets move colours or texture coordinates, which stay",
                     n->odd_morphs);
    build_note_count_of(g->b, MODEL_NOTE_MOTION, "animations, which only `lambent play` shows",
                        json_count(&g->doc, json_member(&g->doc, 0, "animations")));
}

/* Counts the meshes that the scene may need: one for each primitive, and copies for nodes with another shape. */
static uint64_t count_primitives(const gltf_tree *t, gltf *g, uint64_t *all)
{
    uint64_t own = 0;
    uint32_t i, mesh;
    *all = 0;
    for (i = 0; i < g->meshes.count; ++i)
        *all += json_count(&g->doc, json_member(&g->doc, g->meshes.items[i], "primitives"));
    for (i = 0; i < t->count; ++i) {
        const uint32_t node = g->nodes.items[t->order[i]];
        if ((has(g, node, "skin") || has(g, node, "weights")) &&
            gltf_item(&mesh, g, &g->meshes, json_member(&g->doc, node, "mesh")))
            own += json_count(&g->doc, json_member(&g->doc, mesh, "primitives"));
    }
    return *all + own;
}

/* Allocates the tables by accessor, buffer and mesh. */
static int make_tables(const gltf_tree *t, gltf *g)
{
    const uint32_t accessors = g->accessors.count;
    uint64_t primitives, meshes = count_primitives(t, g, &primitives);
    uint32_t i;
    g->b->out->facts.primitives = (uint32_t)primitives;
    g->b->meshes = (lmb_mesh *)build_keep(g->b, meshes, sizeof *g->b->meshes);
    g->mesh_material = (uint32_t *)build_scratch(g->b, meshes, sizeof *g->mesh_material);
    g->mesh_primitive = (uint32_t *)build_scratch(g->b, meshes, sizeof *g->mesh_primitive);
    g->mesh_rest = (lmb_mesh *)build_scratch(g->b, meshes, sizeof *g->mesh_rest);
    g->mesh_influences = (gltf_influences *)build_scratch(g->b, meshes, sizeof *g->mesh_influences);
    g->mesh_first = (uint32_t *)build_scratch(g->b, g->meshes.count, sizeof *g->mesh_first);
    g->mesh_size = (uint32_t *)build_scratch(g->b, g->meshes.count, sizeof *g->mesh_size);
    g->positions = (const void **)build_scratch(g->b, accessors, sizeof *g->positions);
    g->uvs = (const void **)build_scratch(g->b, accessors, sizeof *g->uvs);
    g->normals = (int16_t **)build_scratch(g->b, accessors, sizeof *g->normals);
    g->tangents = (const int16_t **)build_scratch(g->b, accessors, sizeof *g->tangents);
    g->colours = (const uint8_t **)build_scratch(g->b, accessors, sizeof *g->colours);
    g->colour_formats = (uint8_t *)build_scratch(g->b, accessors, sizeof *g->colour_formats);
    g->uv_owner = (uint32_t *)build_scratch(g->b, accessors, sizeof *g->uv_owner);
    g->buffer_bytes = (gltf_bytes *)build_scratch(g->b, g->buffers.count, sizeof *g->buffer_bytes);
    for (i = 0; g->mesh_first && i < g->meshes.count; ++i)
        g->mesh_first[i] = JSON_NONE;
    return gltf_light_begin(g, (uint32_t)meshes) && g->b->r->text[0] == '\0'; /* each failure has set the report */
}

/* Counts items of the document. */
static void count_facts(gltf *g)
{
    model_facts *facts = &g->b->out->facts;
    facts->nodes = g->nodes.count;
    facts->meshes = g->meshes.count;
    facts->materials = g->materials.count;
    facts->textures = g->textures.count;
    facts->images = g->images.count;
    facts->lights = g->lights.count;
    facts->cameras = g->cameras.count;
    facts->animations = json_count(&g->doc, json_member(&g->doc, 0, "animations"));
    facts->skins = g->skins.count;
}

static int load_document(gltf *g)
{
    gltf_tree t;
    if (!check_version(g) || !check_extensions(g) || !gltf_lists(g) || !gltf_make_tree(&t, g) || !make_tables(&t, g) ||
        !gltf_materials(g) || !add_instances(&t, g) || (g->b->keeps_source && !gltf_source(g)) || !gltf_light_end(g) ||
        !gltf_lights(&t, g) || !gltf_cameras(&t, g))
        return 0;
    gltf_motion(&t, g);
    count_occlusion_maps(g);
    tell_left_out(g);
    count_facts(g);
    return 1;
}

int gltf_load(model_build *b, const uint8_t *data, size_t size)
{
    gltf g;
    int ok;
    memset(&g, 0, sizeof g);
    g.b = b;
    b->out->facts.format = size >= 4 && memcmp(data, "glTF", 4) == 0 ? "GLB" : "glTF";
    if (!gltf_container(&g, data, size))
        return 0;
    ok = load_document(&g);
    json_free(&g.doc);
    return ok;
}
