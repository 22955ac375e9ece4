/* model.c: selects the reader by content, and completes the result. */
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "../common/ending.h"
#include "../common/view_frame.h"
#include "io_lmp.h"
#include "io_ply.h"
#include "mend_normals.h"
#include "model_build.h"

/* Ids start at 1, in instance order. */
static int number_triangles(model_build *b)
{
    uint64_t next = 1;
    uint32_t i;
    for (i = 0; i < b->instance_count; ++i) {
        b->instances[i].first_id = (uint32_t)next;
        next += b->meshes[b->instances[i].mesh].triangle_count;
        if (next - 1 > LMB_MAX_TRIANGLES)
            return report_fail(b->r, "%s: more than %u triangles in the scene; split it", b->path,
                               (unsigned)LMB_MAX_TRIANGLES);
    }
    return 1;
}

/* Limits the work: a few bytes of a file can place a mesh again, or use a vertex stream in another mesh. */
static int check_work(model_build *b)
{
    const model_facts *f = &b->out->facts;
    const uint64_t bytes = f->file_bytes + f->neighbour_bytes, paid = bytes * MODEL_TRIANGLES_PER_BYTE;
    uint64_t placed = 0, corners = 0;
    uint32_t i;
    for (i = 0; i < b->instance_count; ++i)
        placed += b->meshes[b->instances[i].mesh].triangle_count;
    for (i = 0; i < b->mesh_count; ++i)
        corners += (uint64_t)b->meshes[i].vertex_count + b->meshes[i].triangle_count;
    if (placed > MODEL_FREE_TRIANGLES + paid)
        return report_fail(b->r, "%s: %" PRIu64 " triangles in its instances, of files of %" PRIu64 " bytes; beyond %"
                           PRIu64 " it may be %d a byte; place meshes less often", b->path, placed, bytes,
                           MODEL_FREE_TRIANGLES, MODEL_TRIANGLES_PER_BYTE);
    return corners <= MODEL_FREE_CORNERS + paid ||
           report_fail(b->r, "%s: %" PRIu64 " vertices and triangles in its meshes, of files of %" PRIu64
                       " bytes; beyond %" PRIu64 " it may be %d a byte; join meshes that share their vertices", b->path,
                       corners, bytes, MODEL_FREE_CORNERS, MODEL_TRIANGLES_PER_BYTE);
}

#define EXACT_BOUNDS (UINT64_C(1) << 24) /* placed vertices up to which the scene's bounds are exact */
#define TINY_M 1e-4 /* scene size: a Cornell box of 2e-4 m keeps its light, one of 2e-5 m is 9 % off */

/* The corners of the bounds of a mesh's finite vertices; returns 0 if it has none. */
static int mesh_corners(lmb_vec3 corners[8], const lmb_mesh *mesh)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    lmb_instance alone;
    lmb_scene one;
    lmb_vec3 lo, hi;
    int i;
    memset(&alone, 0, sizeof alone);
    memset(&one, 0, sizeof one);
    alone.to_world = unit;
    one.meshes = mesh;
    one.instances = &alone;
    one.mesh_count = one.instance_count = 1;
    lmb_scene_bounds(&lo, &hi, &one);
    for (i = 0; i < 8; ++i) {
        corners[i].x = i & 1 ? hi.x : lo.x;
        corners[i].y = i & 2 ? hi.y : lo.y;
        corners[i].z = i & 4 ? hi.z : lo.z;
    }
    return mesh->vertex_count > 0;
}

/* Sets the scene's bounds. For many placed vertices they come from the bounds of the meshes, because a small file
 * may place a large mesh often. */
static int set_bounds(model_build *b)
{
    lmb_scene *scene = &b->out->scene, boxes = *scene;
    lmb_mesh *box = NULL;
    lmb_vec3 *corners = NULL;
    uint64_t placed = 0;
    uint32_t i;
    for (i = 0; i < b->instance_count; ++i)
        placed += b->meshes[b->instances[i].mesh].vertex_count;
    if (placed > EXACT_BOUNDS) {
        box = (lmb_mesh *)build_scratch(b, b->mesh_count, sizeof *box);
        corners = (lmb_vec3 *)build_scratch(b, 8 * (uint64_t)b->mesh_count, sizeof *corners);
        if (!box || !corners)
            return 0;
        for (i = 0; i < b->mesh_count; ++i) {
            box[i].positions = corners + 8 * (size_t)i;
            box[i].vertex_count = mesh_corners(corners + 8 * (size_t)i, &b->meshes[i]) ? 8 : 0;
        }
        boxes.meshes = box;
    }
    lmb_scene_bounds(&scene->bounds_min, &scene->bounds_max, &boxes);
    lmb_scene_core(&scene->core, scene);
    return 1;
}

/* Counts vertices that no drawn triangle can use, over all meshes. */
static void note_absurd_vertices(model_build *b)
{
    uint64_t absurd = 0;
    uint32_t i, v;
    for (i = 0; i < b->mesh_count; ++i) {
        const float *p = (const float *)b->meshes[i].positions;
        for (v = 0; b->meshes[i].position_format == LMB_POSITION_F32 && v < b->meshes[i].vertex_count; ++v, p += 3)
            absurd += !(fabsf(p[0]) < 1048576.0f && fabsf(p[1]) < 1048576.0f && fabsf(p[2]) < 1048576.0f);
    }
    if (absurd)
        build_note(b, "vertices that are not finite or 2^20 m away, whose triangles are not drawn: %" PRIu64, absurd);
}

/* Far from the origin, binary32 has few bits left for the shape. In scenes of under TINY_M, rounding makes bounced
 * light miss shadows. */
static void note_place(model_build *b)
{
    const lmb_vec3 lo = b->out->scene.bounds_min, hi = b->out->scene.bounds_max;
    double cx = ((double)lo.x + (double)hi.x) / 2, cy = ((double)lo.y + (double)hi.y) / 2,
           cz = ((double)lo.z + (double)hi.z) / 2;
    double dx = (double)hi.x - (double)lo.x, dy = (double)hi.y - (double)lo.y, dz = (double)hi.z - (double)lo.z;
    double distance = sqrt(cx * cx + cy * cy + cz * cz), diagonal = sqrt(dx * dx + dy * dy + dz * dz);
    if (distance > 1000 * diagonal && diagonal > 0)
        build_note(b, "the scene is %.3g m across but %.3g m from the origin; move it there for precision", diagonal,
                   distance);
    if (diagonal < TINY_M && diagonal > 0)
        build_note(b, "the scene is %.3g m across; light is inexact in what is under %g m, scale it up", diagonal,
                   TINY_M);
}

static void note_emission(model_build *b)
{
    uint32_t i, count = 0;
    for (i = 0; i < b->material_count; ++i) {
        const float *e = b->materials[i].emission;
        count += e[0] > 0.0f || e[1] > 0.0f || e[2] > 0.0f;
    }
    if (count)
        build_note_of(b, MODEL_NOTE_OPTION, "emissive materials, which light the scene (but with fixed groups): %u",
                      (unsigned)count);
}

/* Counts facts that a reader has not set: the file has as much as the scene, with one primitive per mesh. */
static void count_facts(model_build *b)
{
    model_facts *facts = &b->out->facts;
    uint64_t vertices = 0;
    uint32_t i;
    for (i = 0; i < b->mesh_count; ++i)
        vertices += b->meshes[i].vertex_count;
    if (facts->meshes == 0)
        facts->meshes = facts->primitives = b->mesh_count;
    if (facts->vertices == 0)
        facts->vertices = vertices;
    if (facts->textures == 0)
        facts->textures = facts->images = b->texture_count;
}

static int finish(model_build *b)
{
    lmb_scene *scene = &b->out->scene;
    lmb_status status;
    if (!number_triangles(b) || !check_work(b) || !mend_normals(b))
        return 0;
    scene->meshes = b->meshes;
    scene->materials = b->materials;
    scene->textures = b->textures;
    scene->instances = b->instances;
    scene->lights = b->lights;
    scene->mesh_count = b->mesh_count;
    scene->material_count = b->material_count;
    scene->texture_count = b->texture_count;
    scene->instance_count = b->instance_count;
    scene->light_count = b->light_count;
    if (!set_bounds(b))
        return 0;
    status = lmb_scene_check(scene);
    if (status != LMB_OK)
        return report_fail(b->r, "%s: the scene that was read is not valid (%s); please report this file", b->path,
                           lmb_status_name(status));
    note_place(b);
    note_absurd_vertices(b);
    note_emission(b);
    count_facts(b);
    return 1;
}

typedef int (*model_reader)(model_build *b, const uint8_t *data, size_t size);

static int is_stdin(const char *path)
{
    return strcmp(path, "-") == 0 || strcmp(path, "/dev/stdin") == 0 || strncmp(path, "/dev/fd/", 8) == 0;
}

/* Selects by magic for packed scenes; magic, extension or a first brace for glTF; first line or extension for PLY.
 * OBJ has no magic: only the extension selects it, or text on standard input. Otherwise returns NULL. */
static model_reader find_reader(const char *path, const file_bytes *file)
{
    size_t i = 0;
    if (file->size >= 4 && memcmp(file->data, "glTF", 4) == 0)
        return gltf_load;
    if (lmp_begins(file->data, file->size))
        return lmp_load;
    if (ply_begins(file->data, file->size) || has_ending(path, ".ply"))
        return ply_load;
    if (has_ending(path, ".obj"))
        return obj_load;
    while (i < file->size && strchr(" \t\r\n", file->data[i]) && file->data[i])
        ++i;
    if (has_ending(path, ".gltf") || has_ending(path, ".glb") || (i < file->size && file->data[i] == '{'))
        return gltf_load;
    return is_stdin(path) && file->size > 0 && !memchr(file->data, 0, file->size) ? obj_load : NULL;
}

static int load_content(model_build *b, const file_bytes *file)
{
    const model_reader read = find_reader(b->path, file);
    if (file->size == 0)
        return report_fail(b->r, "%s: the file is empty (0 bytes); export or copy it again", b->path);
    if (!read)
        return report_fail(b->r, "%s: not a model that lambent reads; give a .gltf, .glb, .obj, .ply or .lmp file",
                           b->path);
    if (b->scene && read != gltf_load)
        return report_fail_usage(b->r, "--scene %.60s: %s: only glTF files hold several", b->scene, b->path);
    if (b->linear_colours && read != obj_load && read != ply_load)
        build_note(b, "--vertex-colours linear changes nothing: only OBJ and PLY leave it open");
    return read(b, file->data, file->size);
}

static void fill_linear_of(model_build *b)
{
    for (int i = 0; i < 256; ++i)
        b->linear_of[i] = build_linear(srgb_decode(i));
}

int model_read_as(model *out, const char *path, const model_choice *choice, const uint8_t *data, size_t size,
                  model_notes *notes, report *r)
{
    const file_bytes file = {(uint8_t *)data, size};
    model_build b;
    model_notes unread;
    int ok;
    memset(out, 0, sizeof *out);
    memset(&b, 0, sizeof b);
    b.out = out;
    b.notes = notes ? notes : &unread;
    b.notes->count = 0;
    b.r = r;
    b.path = path;
    b.scene = choice ? choice->scene : NULL;
    b.linear_colours = choice && choice->vertex_colours == MODEL_COLOURS_LINEAR;
    fill_linear_of(&b);
    b.keeps_source = choice && choice->keeps_source;
    b.budget = MODEL_BYTES_FREE + (uint64_t)size * MODEL_BYTES_PER_BYTE;
    b.pixel_budget = MODEL_FREE_PIXELS + (uint64_t)size * MODEL_PIXELS_PER_BYTE;
    b.large_picture = MODEL_LARGE_PICTURE;
    out->facts.file_bytes = size;
    ok = load_content(&b, &file) && finish(&b);
    out->facts.loading_bytes =
        size + out->facts.neighbour_bytes + out->facts.memory_bytes + b.scratch.facts.memory_bytes;
    model_free(&b.scratch);
    build_forget(&b);
    if (!ok)
        model_free(out);
    return ok;
}

static int load_file(model *out, const char *path, const model_choice *choice, model_notes *notes, report *r)
{
    file_bytes file;
    int ok;
    memset(out, 0, sizeof *out);
    if (!file_read(&file, path, r))
        return 0;
    ok = model_read_as(out, path, choice, file.data, file.size, notes, r);
    file_free(&file);
    return ok;
}

int model_load_as(model *out, const char *path, const model_choice *choice, model_notes *notes, report *r)
{
    if (!load_file(out, path, choice, notes, r))
        return 0;
    if ((!out->motion || lmb_scene_triangles(&out->scene) == 0) && !view_any(&out->scene, path, r)) {
        model_free(out);
        return 0;
    }
    return 1;
}

int model_read(model *out, const char *path, const char *scene, const uint8_t *data, size_t size, model_notes *notes,
               report *r)
{
    const model_choice choice = {scene, MODEL_COLOURS_SRGB, 0};
    return model_read_as(out, path, &choice, data, size, notes, r);
}

int model_load(model *out, const char *path, const char *scene, model_notes *notes, report *r)
{
    const model_choice choice = {scene, MODEL_COLOURS_SRGB, 0};
    return load_file(out, path, &choice, notes, r);
}

/* The model owns the materials; only the scene's view of them is const. */
int model_make_glossy(model *m)
{
    lmb_material *materials = (lmb_material *)(uintptr_t)m->scene.materials;
    for (uint32_t i = 0; m->lobes && i < m->scene.material_count; ++i) {
        memcpy(materials[i].albedo, m->lobes[i].albedo, sizeof materials[i].albedo);
        memcpy(materials[i].specular, m->lobes[i].specular, sizeof materials[i].specular);
        materials[i].roughness = m->lobes[i].roughness;
        materials[i].metallic = m->lobes[i].metallic;
        materials[i].metal_map = m->lobes[i].metal_map;
    }
    return m->lobes != NULL;
}
