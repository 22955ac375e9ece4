/* model.c: owns a loaded model's memory, picks the reader by content, and finishes what a reader built. */
#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../picture/picture_read.h"
#include "io_ply.h"
#include "model_build.h"

void model_free(model *m)
{
    uint32_t i;
    for (i = 0; i < m->block_count; ++i)
        free(m->blocks[i]);
    free(m->blocks);
    memset(m, 0, sizeof *m);
}

/* Room for one more block; the list doubles. */
static int reserve_block(model *m)
{
    uint32_t cap = m->block_cap ? m->block_cap * 2 : 64;
    void **grown;
    if (m->block_count < m->block_cap)
        return 1;
    if (cap > UINT32_MAX / 2 / sizeof *grown)
        return 0;
    grown = (void **)realloc(m->blocks, cap * sizeof *grown);
    if (!grown)
        return 0;
    m->blocks = grown;
    m->block_cap = cap;
    return 1;
}

/* count * size zeroed bytes in m's list, or NULL; without a budget. */
static void *add_block(model *m, uint64_t count, size_t size)
{
    void *block;
    if (count == 0)
        count = 1;
    if (count > SIZE_MAX / size || !reserve_block(m))
        return NULL;
    block = calloc((size_t)count, size);
    if (block) {
        m->blocks[m->block_count++] = block;
        m->facts.memory_bytes += count * size;
    }
    return block;
}

static void *build_alloc(model_build *b, model *m, uint64_t count, size_t size)
{
    void *block;
    if (count > b->budget / size) {
        report_fail(b->r, "%s: asks for more than %d bytes of memory a byte of file; it is damaged or made to harm",
                    b->path, MODEL_BYTES_PER_BYTE);
        return NULL;
    }
    b->budget -= count * size;
    block = add_block(m, count, size);
    if (!block)
        report_fail(b->r, "%s: out of memory; load a smaller model", b->path);
    return block;
}

void *build_keep(model_build *b, uint64_t count, size_t size) { return build_alloc(b, b->out, count, size); }

void *build_scratch(model_build *b, uint64_t count, size_t size) { return build_alloc(b, &b->scratch, count, size); }

int build_materials(model_build *b, uint64_t count)
{
    b->materials = (lmb_material *)build_keep(b, count, sizeof *b->materials);
    return b->materials != NULL;
}

void build_note(model_build *b, const char *format, ...)
{
    model_notes *n = b->notes;
    const uint32_t room = sizeof n->line / sizeof n->line[0];
    char line[sizeof n->line[0]];
    va_list args;
    uint32_t i;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    for (i = 0; i < n->count; ++i)
        if (strcmp(n->line[i], line) == 0)
            return;
    if (n->count == room) {
        snprintf(n->line[room - 1], sizeof line, "more notes than %u; the rest is left out", (unsigned)room);
        return;
    }
    memcpy(n->line[n->count++], line, sizeof line);
}

void build_note_count(model_build *b, const char *what, uint32_t count)
{
    if (count)
        build_note(b, "%s: %u", what, (unsigned)count);
}

float build_float(double v) { return v > 3.4e38 ? (float)INFINITY : v < -3.4e38 ? -(float)INFINITY : (float)v; }

float build_uv(double v) { return v > -1e6 && v < 1e6 ? (float)v : 0.0f; }

lmb_vec3 build_normal(const double v[3], uint32_t *zeros)
{
    const double d = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    lmb_vec3 n = {0.0f, 1.0f, 0.0f};
    if (!(d > 1e-20 && d < 1e30)) {
        ++*zeros;
        return n;
    }
    n.x = (float)(v[0] / d);
    n.y = (float)(v[1] / d);
    n.z = (float)(v[2] / d);
    return n;
}

/* a//b and a/./b are a/b; ".." stays, as it may lead through a link. */
static void tidy_path(char *path)
{
    char *to = path;
    const char *from = path;
    while (*from) {
        const int at_start = from == path || from[-1] == '/';
        if (at_start && from[0] == '.' && from[1] == '/')
            from += 2;
        else if (at_start && from != path && from[0] == '/')
            ++from;
        else
            *to++ = *from++;
    }
    *to = '\0';
}

/* Room for one more file and its path; NULL with `r` set. */
static build_neighbour *add_neighbour(model_build *b, const char *path, report *r)
{
    const size_t bytes = strlen(path) + 1;
    build_neighbour *grown, *to;
    if (b->neighbour_count == b->neighbour_cap) {
        const uint32_t cap = b->neighbour_cap ? 2 * b->neighbour_cap : 16;
        grown = cap > UINT32_MAX / 2 / sizeof *grown ? NULL
                                                     : (build_neighbour *)realloc(b->neighbours, cap * sizeof *grown);
        if (!grown)
            return report_fail(r, "%s: out of memory; load a smaller model", path), NULL;
        b->neighbours = grown;
        b->neighbour_cap = cap;
    }
    to = &b->neighbours[b->neighbour_count];
    memset(to, 0, sizeof *to);
    to->path = (char *)malloc(bytes);
    if (!to->path)
        return report_fail(r, "%s: out of memory; load a smaller model", path), NULL;
    memcpy(to->path, path, bytes);
    return to;
}

int build_read(model_build *b, file_bytes *out, const char *path, report *r)
{
    char tidy[MODEL_PATH_MAX];
    build_neighbour *to;
    uint32_t i;
    snprintf(tidy, sizeof tidy, "%s", path);
    tidy_path(tidy);
    for (i = 0; i < b->neighbour_count; ++i)
        if (strcmp(b->neighbours[i].path, tidy) == 0) {
            *out = b->neighbours[i].file;
            return 1;
        }
    if (!file_is_plain(path, r))
        return 0;
    to = add_neighbour(b, tidy, r);
    if (!to)
        return 0;
    if (!file_read(&to->file, path, r)) {
        free(to->path);
        return 0;
    }
    ++b->neighbour_count;
    *out = to->file;
    b->budget += (uint64_t)out->size * MODEL_BYTES_PER_BYTE;
    b->pixel_budget += (uint64_t)out->size * MODEL_PIXELS_PER_BYTE;
    b->out->facts.neighbour_bytes += out->size;
    return 1;
}

static void forget_neighbours(model_build *b)
{
    uint32_t i;
    for (i = 0; i < b->neighbour_count; ++i) {
        free(b->neighbours[i].path);
        file_free(&b->neighbours[i].file);
    }
    free(b->neighbours);
}

int build_is_relative(const char *name)
{
    const size_t n = strcspn(name, ":/\\");
    return name[0] != '\0' && name[0] != '/' && name[0] != '\\' && name[n] != ':';
}

int build_sibling(char *out, size_t cap, const model_build *b, const char *name, report *r)
{
    const char *slash = strrchr(b->path, '/');
    size_t folder, n = strlen(name);
#if defined(_WIN32)
    const char *back = strrchr(b->path, '\\');
    if (back && (!slash || back > slash))
        slash = back;
#endif
    folder = slash ? (size_t)(slash - b->path) + 1 : 0;
    if (folder >= cap || n >= cap - folder)
        return report_fail(r, "%s: a path beside it is longer than %u bytes; move the model", b->path, (unsigned)cap);
    memcpy(out, b->path, folder);
    memcpy(out + folder, name, n + 1);
    return 1;
}

/* Level 0 to the model's memory, with room for `levels`. */
static uint8_t *keep_texels(model_build *b, const bitmap *map, int32_t levels, const char *name, report *why)
{
    size_t bytes = lmb_texture_bytes(map->width, map->height, levels);
    uint8_t *texels = NULL;
    if (bytes == 0) {
        report_fail(why, "%s: %dx%d pixels; sides may have up to %d", name, (int)map->width, (int)map->height,
                    LMB_MAX_SIDE);
        return NULL;
    }
    texels = (uint8_t *)add_block(b->out, bytes, 1);
    if (!texels) {
        report_fail(why, "%s: no memory left for textures; shrink them", name);
        return NULL;
    }
    b->out->facts.texel_bytes += bytes;
    memcpy(texels, map->texels, (size_t)map->width * (size_t)map->height * 4);
    return texels;
}

/* A picture pays for its bytes too: the same ones may be shown under any number of names, and each is decoded anew. */
int build_picture(model_build *b, bitmap *out, const uint8_t *data, size_t size, const char *name, report *why)
{
    const uint64_t pixels = picture_pixels(data, size);
    memset(out, 0, sizeof *out);
    if (pixels > b->pixel_budget)
        return report_fail(why, "%s: %" PRIu64 " pixels are more than the model's pictures may still have, which is %"
                           PRIu64 "; shrink them", name, pixels, b->pixel_budget);
    b->pixel_budget -= pixels;
    if (size > b->pixel_budget)
        return report_fail(why, "%s: %zu bytes; the model's pictures have been decoded too often", name, size);
    b->pixel_budget -= size;
    return picture_read_codes(out, data, size, name, why);
}

int build_texels(model_build *b, lmb_texture *out, const uint8_t *data, size_t size, int kind, const char *name,
                 report *why)
{
    bitmap map;
    int32_t levels;
    uint8_t *texels;
    if (!build_picture(b, &map, data, size, name, why))
        return 0;
    levels = kind != TEXELS_PLAIN ? lmb_texture_level_count(map.width, map.height) : 1;
    texels = keep_texels(b, &map, levels, name, why);
    if (texels) {
        out->texels = texels;
        out->width = (uint16_t)map.width;
        out->height = (uint16_t)map.height;
        out->levels = (uint8_t)levels;
        (kind == TEXELS_NORMALS ? lmb_normal_map_mips : lmb_texture_mips)(texels, map.width, map.height, levels);
    }
    bitmap_free(&map);
    return texels != NULL;
}

/* Ids 1 .. in instance order. */
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

#define EXACT_BOUNDS (UINT64_C(1) << 24) /* placed vertices up to which the scene's box is that of them all */

/* The box of one mesh's finite vertices, by its eight corners; 0 where it has none. */
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

/* The scene's box: of many placed vertices that of the meshes' boxes, as a small file may place a large mesh often. */
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

/* Vertices that no triangle can be drawn with, over the meshes. */
static void note_absurd_vertices(model_build *b)
{
    uint64_t absurd = 0;
    uint32_t i, v;
    for (i = 0; i < b->mesh_count; ++i) {
        const float *p = (const float *)b->meshes[i].positions;
        for (v = 0; v < b->meshes[i].vertex_count; ++v, p += 3)
            absurd += !(fabsf(p[0]) < 1048576.0f && fabsf(p[1]) < 1048576.0f && fabsf(p[2]) < 1048576.0f);
    }
    if (absurd)
        build_note(b, "vertices that are not finite or 2^20 m away, whose triangles are not drawn: %" PRIu64, absurd);
}

/* Far from the origin, binary32 has few bits left for the shape itself. */
static void note_far_away(model_build *b)
{
    const lmb_vec3 lo = b->out->scene.bounds_min, hi = b->out->scene.bounds_max;
    double cx = ((double)lo.x + (double)hi.x) / 2, cy = ((double)lo.y + (double)hi.y) / 2,
           cz = ((double)lo.z + (double)hi.z) / 2;
    double dx = (double)hi.x - (double)lo.x, dy = (double)hi.y - (double)lo.y, dz = (double)hi.z - (double)lo.z;
    double distance = sqrt(cx * cx + cy * cy + cz * cz), diagonal = sqrt(dx * dx + dy * dy + dz * dz);
    if (distance > 1000 * diagonal && diagonal > 0)
        build_note(b, "the scene is %.3g m across but %.3g m from the origin; move it there for precision", diagonal,
                   distance);
}

static void note_emission(model_build *b)
{
    uint32_t i, count = 0;
    for (i = 0; i < b->material_count; ++i) {
        const float *e = b->materials[i].emission;
        count += e[0] > 0.0f || e[1] > 0.0f || e[2] > 0.0f;
    }
    if (count)
        build_note(b, "emissive materials, which light the scene with --grouping cut only: %u", (unsigned)count);
}

/* What a reader left to count: the file has what the scene has, each mesh of one piece. */
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
    if (!number_triangles(b))
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
        return report_fail(b->r, "%s: the scene that was read is not sound (%s); please report this file", b->path,
                           lmb_status_name(status));
    note_far_away(b);
    note_absurd_vertices(b);
    note_emission(b);
    count_facts(b);
    return 1;
}

/* Does the path end in `extension` (lower case, with its point)? */
static int has_extension(const char *path, const char *extension)
{
    size_t n = strlen(path), e = strlen(extension), i;
    if (n < e)
        return 0;
    for (i = 0; i < e; ++i)
        if (tolower((unsigned char)path[n - e + i]) != extension[i])
            return 0;
    return 1;
}

typedef int (*model_reader)(model_build *b, const uint8_t *data, size_t size);

/* glTF by its magic, its extension or a first brace; PLY by its first line or its extension; OBJ, which has no mark,
 * by its extension alone; else NULL. */
static model_reader find_reader(const char *path, const file_bytes *file)
{
    size_t i = 0;
    if (file->size >= 4 && memcmp(file->data, "glTF", 4) == 0)
        return gltf_load;
    if (ply_begins(file->data, file->size) || has_extension(path, ".ply"))
        return ply_load;
    if (has_extension(path, ".obj"))
        return obj_load;
    while (i < file->size && strchr(" \t\r\n", file->data[i]) && file->data[i])
        ++i;
    return has_extension(path, ".gltf") || has_extension(path, ".glb") || (i < file->size && file->data[i] == '{')
               ? gltf_load
               : NULL;
}

static int load_content(model_build *b, const file_bytes *file)
{
    const model_reader read = find_reader(b->path, file);
    if (!read)
        return report_fail(b->r, "%s: not a model that lambent reads; give a .gltf, .glb, .obj or .ply file", b->path);
    if (b->scene && read != gltf_load)
        return report_fail(b->r, "%s: --scene %.60s: only glTF files hold several", b->path, b->scene);
    return read(b, file->data, file->size);
}

int model_read(model *out, const char *path, const char *scene, const uint8_t *data, size_t size, model_notes *notes,
               report *r)
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
    b.scene = scene;
    b.budget = MODEL_BYTES_FREE + (uint64_t)size * MODEL_BYTES_PER_BYTE;
    b.pixel_budget = MODEL_FREE_PIXELS + (uint64_t)size * MODEL_PIXELS_PER_BYTE;
    out->facts.file_bytes = size;
    ok = load_content(&b, &file) && finish(&b);
    out->facts.loading_bytes =
        size + out->facts.neighbour_bytes + out->facts.memory_bytes + b.scratch.facts.memory_bytes;
    model_free(&b.scratch);
    forget_neighbours(&b);
    if (!ok)
        model_free(out);
    return ok;
}

int model_load(model *out, const char *path, const char *scene, model_notes *notes, report *r)
{
    file_bytes file;
    int ok;
    memset(out, 0, sizeof *out);
    if (!file_read(&file, path, r))
        return 0;
    ok = model_read(out, path, scene, file.data, file.size, notes, r);
    file_free(&file);
    return ok;
}

/* The model owns its materials; only the scene's view of them is const. */
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
