/* verb_info.c: `lambent info`: the contents of a scene or picture, and how lambent uses them. */
#include "verb_info.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/option_value.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../demo/demo_scene.h"
#include "../model/model.h"
#include "../picture/image.h"
#include "../picture/picture.h"
#include "../picture/picture_read.h"
#include "info_baked.h"
#include "info_text.h"

typedef struct options {
    const char *path; /* NULL: not given */
    model_choice choice;
    int json, is_quiet, is_verbose;
} options;

#define AT(member) .at = offsetof(options, member)

static const option_row info_rows[] = {
    {.name = "FILE", .kind = OPTION_TEXT, .value = "", AT(path),
     .help = "a scene, a picture, baked light (.lmt), a relief (.lmr), or demo, the built-in scene"},
    {.name = "--scene", .value = "NAME|N", .kind = OPTION_TEXT, AT(choice.scene),
     .help = "scene to show of a file with several, by name or number from 0 (default: the file's default scene)"},
    OPTION_VERTEX_COLOURS_ROW(options, choice.vertex_colours),
    {.name = "--json", .kind = OPTION_FLAG, AT(json), .help = "one object on one line"},
    {.name = "--quiet", .brief = "-q", .kind = OPTION_QUIET, AT(is_quiet),
     .help = "print no figures, only set the exit status: whether the file can be read"},
    {.name = "--verbose", .brief = "-v", .kind = OPTION_VERBOSE, AT(is_verbose),
     .help = "print how long reading took"},
    OPTION_ONLY_HERE,
    OPTION_TIME_LIMIT,
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "info",
    .usage = "info FILE [options]",
    .about =
        "Lists the contents of a scene that `lambent render` reads, a picture (PNG, JPEG, PPM, PGM, PAM, PFM or HDR), "
        "baked light or a relief, recognized by content. For a scene:\n"
        "scenes: of a glTF file; read: the one described below (you choose it with --scene);\n"
        "nodes meshes: in the file, with the number of primitives;\n"
        "instances: primitives placed in the world;\n"
        "triangles: placed: over all instances; unique: each mesh once;\n"
        "vertices: as stored, of the meshes that are placed;\n"
        "materials: in the file; drawn: those of instances, by kind;\n"
        "emissive: materials that emit light: radiance, W/(sr m2); `render --group method=cut` lights the scene with "
        "it;\n"
        "images textures: in the file; read: with size, mip levels and bytes in memory, shared by equal images;\n"
        "lights cameras: in the file; placed: by nodes; the number before a camera is for `render --camera`;\n"
        "extensions: read, converted on load, or ignored; if a scene requires an unknown one, it is "
        "refused with a message that names it;\n"
        "bounds: world metres;\n"
        "bytes: the file, others read for it, and memory when loaded;\n"
        "notes: features that the reader left out or replaced.\n"
        "For a picture: smallest, largest and mean value of each channel as stored: codes 0 to 255 (of 16 bits the "
        "high byte; palettes resolved), or linear light; values that are not finite are counted and left out. For a "
        "PFM the scale, by which these values are multiplied, and the byte order.\n"
        "For baked light: elements, which reflect light; receivers and clusters, from which pixels take it; links, "
        "which carry light from one to the other; for moving objects, ranges of triangles and places in the air; "
        "and the fingerprint of the scene that was baked.\n"
        "For a relief: the triangles of the simple model, and the reference views.",
    .part = {info_rows},
    .examples = "  lambent render demo --size 80x60 -o demo.pfm\n"
                "  lambent info demo.pfm\n",
    .status = "exit status: 0 done, 1 a file that cannot be read, 2 bad usage",
};

/* Counts that are not in the file or the scene. */
typedef struct summary {
    uint64_t unique_triangles;
    uint32_t drawn, double_sided, masked, textured, normal_mapped, emissive; /* materials */
    uint32_t lights[3];                             /* by LMB_LIGHT_ */
    uint32_t orthographic;
} summary;

/* The finite values of a channel. */
typedef struct channel {
    double min, largest, sum;
    uint64_t count;
} channel;

typedef struct picture_facts {
    const char *format;
    int32_t width, height;
    int channels; /* 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA */
    int linear;   /* floats; else codes 0 .. 255 */
    int has_scale, is_little; /* only of a PFM */
    float scale;
    channel values[4];
    uint64_t nonfinite, bytes;
} picture_facts;

/* --- scenes ------------------------------------------------------------------------------------------------------- */

/* Counts materials that an instance shows. Returns 0: memory is short. */
static int count_materials(summary *s, const lmb_scene *scene)
{
    uint8_t *seen = calloc((size_t)scene->material_count + 1, 1);
    if (!seen)
        return 0;
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        const uint32_t index = scene->instances[i].material;
        const lmb_material *m = &scene->materials[index];
        if (seen[index])
            continue;
        seen[index] = 1;
        ++s->drawn;
        s->double_sided += (m->flags & LMB_DOUBLE_SIDED) != 0;
        s->masked += (m->flags & LMB_ALPHA_MASK) != 0;
        s->textured += m->texture >= 0;
        s->normal_mapped += m->normal_scale != 0.0f;
    }
    free(seen);
    return 1;
}

static int is_emissive(const float radiance[3])
{
    return radiance[0] > 0.0f || radiance[1] > 0.0f || radiance[2] > 0.0f;
}

static int summarize(summary *s, const model *m)
{
    memset(s, 0, sizeof *s);
    for (uint32_t i = 0; i < m->scene.mesh_count; ++i)
        s->unique_triangles += m->scene.meshes[i].triangle_count;
    for (uint32_t i = 0; i < m->scene.light_count; ++i)
        ++s->lights[m->scene.lights[i].kind];
    for (uint32_t i = 0; i < m->camera_count; ++i)
        s->orthographic += m->cameras[i].orthographic != 0;
    for (uint32_t i = 0; i < m->scene.material_count; ++i)
        s->emissive += is_emissive(m->scene.materials[i].emission);
    return count_materials(s, &m->scene);
}

static uint64_t texture_bytes(const lmb_texture *t) { return lmb_texture_bytes(t->width, t->height, t->levels); }

static double degrees(float rad) { return (double)rad * 57.295779513082321; }

static lmb_vec3 extent(const lmb_scene *s)
{
    lmb_vec3 size;
    size.x = s->bounds_max.x - s->bounds_min.x;
    size.y = s->bounds_max.y - s->bounds_min.y;
    size.z = s->bounds_max.z - s->bounds_min.z;
    return size;
}

static const char *use_name(int use)
{
    static const char *const names[] = {"ignored", "read", "folded in"};
    return names[use];
}

static const char *format_name(const model_facts *f) { return f->format ? f->format : "scene"; }

static void text_counts(FILE *out, const model *m, const summary *s)
{
    const model_facts *f = &m->facts;
    if (f->scenes > 0) {
        label(out, "scenes");
        fprintf(out, "%u; read: %u%s", (unsigned)f->scenes, (unsigned)f->scene, f->scene_name[0] ? ", " : "");
        plain_text(out, f->scene_name);
        fputc('\n', out);
    }
    label(out, "nodes");
    fprintf(out, "%u\n", (unsigned)f->nodes);
    label(out, "meshes");
    fprintf(out, "%u\n", (unsigned)f->meshes);
    label(out, "primitives");
    fprintf(out, "%u\n", (unsigned)f->primitives);
    label(out, "instances");
    fprintf(out, "%u\n", (unsigned)m->scene.instance_count);
    label(out, "triangles");
    fprintf(out, "%u placed, %" PRIu64 " unique\n", (unsigned)lmb_scene_triangles(&m->scene), s->unique_triangles);
    label(out, "vertices");
    fprintf(out, "%" PRIu64 "\n", f->vertices);
    label(out, "materials");
    fprintf(out, "%u; drawn: %u (%u double sided, %u masked, %u textured, %u normal mapped)\n", (unsigned)f->materials,
            (unsigned)s->drawn, (unsigned)s->double_sided, (unsigned)s->masked, (unsigned)s->textured,
            (unsigned)s->normal_mapped);
    label(out, "emissive");
    fprintf(out, "%u\n", (unsigned)s->emissive);
    for (uint32_t i = 0; i < m->scene.material_count; ++i) {
        const float *e = m->scene.materials[i].emission;
        if (is_emissive(e)) {
            label(out, "");
            fprintf(out, "%u: %.6g %.6g %.6g%s\n", (unsigned)i, (double)e[0], (double)e[1], (double)e[2],
                    m->scene.materials[i].emission_map > 0 ? ", times its map" : "");
        }
    }
}

static void text_textures(FILE *out, const model *m)
{
    label(out, "images");
    fprintf(out, "%u\n", (unsigned)m->facts.images);
    label(out, "textures");
    fprintf(out, "%u; read: %u (%" PRIu64 " bytes)\n", (unsigned)m->facts.textures,
            (unsigned)m->scene.texture_count, m->facts.texel_bytes);
    for (uint32_t i = 0; i < m->scene.texture_count; ++i) {
        const lmb_texture *t = &m->scene.textures[i];
        label(out, "");
        fprintf(out, "%u: %ux%u, levels: %u, %" PRIu64 " bytes\n", (unsigned)i, (unsigned)t->width,
                (unsigned)t->height, (unsigned)t->levels, texture_bytes(t));
    }
}

static void text_cameras(FILE *out, const model *m, const summary *s)
{
    label(out, "cameras");
    fprintf(out, "%u; placed: %u (%u perspective, %u orthographic)\n", (unsigned)m->facts.cameras,
            (unsigned)m->camera_count, (unsigned)(m->camera_count - s->orthographic), (unsigned)s->orthographic);
    for (uint32_t i = 0; i < m->camera_count; ++i) {
        const model_camera *c = &m->cameras[i];
        label(out, "");
        fprintf(out, "%u: ", (unsigned)i);
        plain_text(out, c->name);
        fputs(c->name[0] != '\0' ? ": " : "", out);
        if (c->orthographic)
            fprintf(out, "orthographic, %.6g x %.6g m", 2 * (double)c->half_width, 2 * (double)c->half_height);
        else
            fprintf(out, "perspective, %.6g degrees high", degrees(c->yfov_rad));
        fprintf(out, ", at %.6g %.6g %.6g\n", (double)c->eye.x, (double)c->eye.y, (double)c->eye.z);
    }
}

static void text_extensions(FILE *out, const model_facts *f)
{
    label(out, "extensions");
    fprintf(out, "%u\n", (unsigned)(f->extension_count + f->extension_more));
    for (uint32_t i = 0; i < f->extension_count; ++i) {
        const model_extension *e = &f->extensions[i];
        label(out, "");
        plain_text(out, e->name);
        fprintf(out, ": %s%s\n", use_name(e->use), e->required ? ", required" : "");
    }
}

static void text_bounds(FILE *out, const lmb_scene *s)
{
    const char *const names[] = {"bounds", "", ""}, *const ends[] = {"min", "max", "size"};
    const lmb_vec3 rows[3] = {s->bounds_min, s->bounds_max, extent(s)};
    for (int i = 0; i < 3; ++i) {
        label(out, names[i]);
        fprintf(out, "%-4s %13.6g %13.6g %13.6g\n", ends[i], (double)rows[i].x, (double)rows[i].y, (double)rows[i].z);
    }
}

static void text_scene(FILE *out, const char *path, const model *m, const summary *s, const model_notes *notes)
{
    const model_facts *f = &m->facts;
    label(out, "file");
    plain_text(out, path);
    fprintf(out, ": %s\n", format_name(f));
    text_counts(out, m, s);
    text_textures(out, m);
    label(out, "lights");
    fprintf(out, "%u; placed: %u (%u point, %u spot, %u directional)\n", (unsigned)f->lights,
            (unsigned)m->scene.light_count, (unsigned)s->lights[LMB_LIGHT_POINT],
            (unsigned)s->lights[LMB_LIGHT_SPOT], (unsigned)s->lights[LMB_LIGHT_DIRECTIONAL]);
    text_cameras(out, m, s);
    label(out, "animations");
    fprintf(out, "%u\n", (unsigned)f->animations);
    label(out, "skins");
    fprintf(out, "%u\n", (unsigned)f->skins);
    text_extensions(out, f);
    text_bounds(out, &m->scene);
    label(out, "bytes");
    fprintf(out, "%" PRIu64 " file, %" PRIu64 " other files, %" PRIu64 " in memory, %" PRIu64 " while loading\n",
            f->file_bytes, f->neighbour_bytes, f->memory_bytes, f->loading_bytes);
    label(out, "notes");
    fprintf(out, "%u\n", (unsigned)notes->count);
    for (uint32_t i = 0; i < notes->count; ++i) {
        label(out, "");
        plain_text(out, notes->line[i]);
        fputc('\n', out);
    }
}

static void json_counts(FILE *out, const model *m, const summary *s)
{
    const model_facts *f = &m->facts;
    fprintf(out, "\"scenes\":{\"count\":%u,\"read\":%u,\"name\":", (unsigned)f->scenes, (unsigned)f->scene);
    json_text(out, f->scene_name);
    fprintf(out, "},\"nodes\":%u,\"meshes\":%u,\"primitives\":%u,\"instances\":%u,", (unsigned)f->nodes,
            (unsigned)f->meshes, (unsigned)f->primitives, (unsigned)m->scene.instance_count);
    fprintf(out, "\"triangles\":{\"placed\":%u,\"unique\":%" PRIu64 "},\"vertices\":%" PRIu64 ",",
            (unsigned)lmb_scene_triangles(&m->scene), s->unique_triangles, f->vertices);
    fprintf(out, "\"materials\":{\"count\":%u,\"drawn\":%u,\"double_sided\":%u,\"masked\":%u,\"textured\":%u,"
                 "\"normal_mapped\":%u,\"emissive\":[",
            (unsigned)f->materials, (unsigned)s->drawn, (unsigned)s->double_sided, (unsigned)s->masked,
            (unsigned)s->textured, (unsigned)s->normal_mapped);
    for (uint32_t i = 0, n = 0; i < m->scene.material_count; ++i)
        if (is_emissive(m->scene.materials[i].emission)) {
            const float *e = m->scene.materials[i].emission;
            const lmb_vec3 radiance = {e[0], e[1], e[2]};
            fprintf(out, "%s{\"material\":%u,", n++ ? "," : "", (unsigned)i);
            json_vec3(out, "radiance", radiance);
            fputc('}', out);
        }
    fputs("]},", out);
    fprintf(out, "\"lights\":{\"count\":%u,\"point\":%u,\"spot\":%u,\"directional\":%u},", (unsigned)f->lights,
            (unsigned)s->lights[LMB_LIGHT_POINT], (unsigned)s->lights[LMB_LIGHT_SPOT],
            (unsigned)s->lights[LMB_LIGHT_DIRECTIONAL]);
    fprintf(out, "\"animations\":%u,\"skins\":%u,", (unsigned)f->animations, (unsigned)f->skins);
}

static void json_textures(FILE *out, const model *m)
{
    fprintf(out, "\"textures\":{\"count\":%u,\"images\":%u,\"bytes\":%" PRIu64 ",\"read\":[",
            (unsigned)m->facts.textures, (unsigned)m->facts.images, m->facts.texel_bytes);
    for (uint32_t i = 0; i < m->scene.texture_count; ++i) {
        const lmb_texture *t = &m->scene.textures[i];
        fprintf(out, "%s{\"width\":%u,\"height\":%u,\"levels\":%u,\"bytes\":%" PRIu64 "}", i ? "," : "",
                (unsigned)t->width, (unsigned)t->height, (unsigned)t->levels, texture_bytes(t));
    }
    fputs("]},", out);
}

static void json_cameras(FILE *out, const model *m)
{
    fprintf(out, "\"cameras\":{\"count\":%u,\"placed\":[", (unsigned)m->facts.cameras);
    for (uint32_t i = 0; i < m->camera_count; ++i) {
        const model_camera *c = &m->cameras[i];
        fprintf(out, "%s{\"name\":", i ? "," : "");
        json_text(out, c->name);
        if (c->orthographic)
            fprintf(out, ",\"kind\":\"orthographic\",\"width\":%.9g,\"height\":%.9g,", 2 * (double)c->half_width,
                    2 * (double)c->half_height);
        else
            fprintf(out, ",\"kind\":\"perspective\",\"yfov_deg\":%.9g,", degrees(c->yfov_rad));
        json_vec3(out, "eye", c->eye);
        fputc('}', out);
    }
    fputs("]},", out);
}

static void json_extensions(FILE *out, const model_facts *f)
{
    fputs("\"extensions\":[", out);
    for (uint32_t i = 0; i < f->extension_count; ++i) {
        fprintf(out, "%s{\"name\":", i ? "," : "");
        json_text(out, f->extensions[i].name);
        fprintf(out, ",\"use\":\"%s\",\"required\":%s}", use_name(f->extensions[i].use),
                f->extensions[i].required ? "true" : "false");
    }
    fprintf(out, "],\"extensions_not_listed\":%u,", (unsigned)f->extension_more);
}

static void json_scene(FILE *out, const char *path, const model *m, const summary *s, const model_notes *notes)
{
    const model_facts *f = &m->facts;
    fputs("{\"file\":", out);
    json_text(out, path);
    fprintf(out, ",\"kind\":\"scene\",\"format\":\"%s\",", format_name(f));
    json_counts(out, m, s);
    json_textures(out, m);
    json_cameras(out, m);
    json_extensions(out, f);
    fputs("\"bounds\":{", out);
    json_vec3(out, "min", m->scene.bounds_min);
    fputc(',', out);
    json_vec3(out, "max", m->scene.bounds_max);
    fputc(',', out);
    json_vec3(out, "size", extent(&m->scene));
    fprintf(out, "},\"bytes\":{\"file\":%" PRIu64 ",\"other_files\":%" PRIu64 ",\"memory\":%" PRIu64
                 ",\"loading\":%" PRIu64 "},\"notes\":[",
            f->file_bytes, f->neighbour_bytes, f->memory_bytes, f->loading_bytes);
    for (uint32_t i = 0; i < notes->count; ++i) {
        fputs(i ? "," : "", out);
        json_text(out, notes->line[i]);
    }
    fputs("]}\n", out);
}

/* The built-in scene, with the camera of `render demo`. */
static void demo_model(model *out, model_camera *camera)
{
    const lmb_view v = demo_view(640, 480);
    model_facts *f = &out->facts;
    memset(out, 0, sizeof *out);
    memset(camera, 0, sizeof *camera);
    out->scene = *demo_scene();
    out->cameras = camera;
    out->camera_count = f->cameras = f->scenes = 1;
    camera->eye = v.eye;
    camera->yfov_rad = 2.0f * atanf(v.half_height);
    snprintf(camera->name, sizeof camera->name, "demo");
    f->format = "built in";
    f->nodes = out->scene.instance_count;
    f->meshes = f->primitives = out->scene.mesh_count;
    f->materials = out->scene.material_count;
    f->textures = f->images = out->scene.texture_count;
    f->lights = out->scene.light_count;
    for (uint32_t i = 0; i < out->scene.mesh_count; ++i)
        f->vertices += out->scene.meshes[i].vertex_count;
    for (uint32_t i = 0; i < out->scene.texture_count; ++i)
        f->texel_bytes += texture_bytes(&out->scene.textures[i]);
}

/* `file` NULL: the built-in scene. */
static int scene_info(FILE *out, const options *o, const file_bytes *file, report *r)
{
    model_notes notes;
    model_camera camera;
    model m;
    summary s;
    notes.count = 0;
    if (file == NULL)
        demo_model(&m, &camera);
    else if (!model_read_as(&m, o->path, &o->choice, file->data, file->size, &notes, r))
        return 0;
    int ok = summarize(&s, &m) || report_fail(r, "%s: memory is short for its materials", o->path);
    if (ok && !o->is_quiet)
        (o->json ? json_scene : text_scene)(out, o->path, &m, &s, &notes);
    if (file != NULL)
        model_free(&m);
    return ok;
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static void add_value(picture_facts *p, int k, double v)
{
    channel *c = &p->values[k];
    if (!isfinite(v)) {
        ++p->nonfinite;
        return;
    }
    c->min = c->count && c->min < v ? c->min : v;
    c->largest = c->count && c->largest > v ? c->largest : v;
    c->sum += v;
    ++c->count;
}

/* Measures the channels of four stored codes per pixel: grey is in the first three, alpha last. */
static void measure_codes(picture_facts *p, const bitmap *map)
{
    const size_t pixels = (size_t)map->width * (size_t)map->height;
    for (size_t i = 0; i < pixels; ++i)
        for (int k = 0; k < p->channels; ++k)
            add_value(p, k, map->texels[4 * i + (size_t)(p->channels == 2 && k == 1 ? 3 : k)]);
}

static void measure_floats(picture_facts *p, const image *img)
{
    const size_t pixels = (size_t)img->width * (size_t)img->height, n = (size_t)img->channels;
    for (size_t i = 0; i < pixels; ++i)
        for (size_t k = 0; k < n; ++k)
            add_value(p, (int)k, (double)img->pixels[n * i + k]);
}

static int measure_picture(picture_facts *p, const file_bytes *file, const char *path, report *r)
{
    stored_picture stored;
    if (!picture_read(&stored, file->data, file->size, path, r))
        return 0;
    p->format = stored.format;
    p->bytes = file->size;
    p->width = stored.width;
    p->height = stored.height;
    p->channels = stored.channels;
    p->linear = stored.light.pixels != NULL;
    p->has_scale = p->linear && pfm_figures(&p->scale, &p->is_little, file->data, file->size);
    if (p->linear)
        measure_floats(p, &stored.light);
    else
        measure_codes(p, &stored.codes);
    stored_picture_free(&stored);
    return 1;
}

static const char *channel_name(const picture_facts *p, int k)
{
    static const char *const colours[] = {"red", "green", "blue", "alpha"};
    return p->channels > 2 ? colours[k] : k == 0 ? "grey" : "alpha";
}

static void text_picture(FILE *out, const char *path, const picture_facts *p)
{
    label(out, "file");
    plain_text(out, path);
    fprintf(out, ": %s, %" PRIu64 " bytes\n", p->format, p->bytes);
    label(out, "size");
    fprintf(out, "%dx%d\n", (int)p->width, (int)p->height);
    label(out, "channels");
    fprintf(out, "%d, %s\n", p->channels, p->linear ? "linear" : "codes 0 to 255");
    for (int k = 0; k < p->channels; ++k) {
        const channel *c = &p->values[k];
        label(out, "");
        fprintf(out, "%-5s ", channel_name(p, k));
        if (c->count)
            fprintf(out, "min %-13.6g max %-13.6g mean %.6g\n", c->min, c->largest, c->sum / (double)c->count);
        else
            fputs("no finite value\n", out);
    }
    if (p->has_scale) {
        label(out, "scale");
        fprintf(out, "%.9g, %s endian\n", (double)p->scale, p->is_little ? "little" : "big");
    }
    if (p->linear) {
        label(out, "not finite");
        fprintf(out, "%" PRIu64 "\n", p->nonfinite);
    }
}

static void json_picture(FILE *out, const char *path, const picture_facts *p)
{
    fputs("{\"file\":", out);
    json_text(out, path);
    fprintf(out, ",\"kind\":\"picture\",\"format\":\"%s\",\"bytes\":%" PRIu64 ",\"width\":%d,\"height\":%d,", p->format,
            p->bytes, (int)p->width, (int)p->height);
    if (p->has_scale)
        fprintf(out, "\"scale\":%.9g,\"endian\":\"%s\",", (double)p->scale, p->is_little ? "little" : "big");
    fprintf(out, "\"values\":\"%s\",\"nonfinite\":%" PRIu64 ",\"channels\":[", p->linear ? "linear" : "codes",
            p->nonfinite);
    for (int k = 0; k < p->channels; ++k) {
        const channel *c = &p->values[k];
        fprintf(out, "%s{\"name\":\"%s\",", k ? "," : "", channel_name(p, k));
        if (c->count)
            fprintf(out, "\"min\":%.9g,\"max\":%.9g,\"mean\":%.9g}", c->min, c->largest, c->sum / (double)c->count);
        else
            fputs("\"min\":null,\"max\":null,\"mean\":null}", out);
    }
    fputs("]}\n", out);
}

static int picture_info(FILE *out, const options *o, const file_bytes *file, report *r)
{
    picture_facts p;
    memset(&p, 0, sizeof p);
    if (!measure_picture(&p, file, o->path, r))
        return 0;
    if (!o->is_quiet)
        (o->json ? json_picture : text_picture)(out, o->path, &p);
    return 1;
}

/* Reads a file once, so that a pipe works. If the content does not show the kind, the name decides. */
static int file_info(FILE *out, const options *o, report *r)
{
    file_bytes file = {NULL, 0};
    if (strcmp(o->path, "demo") == 0 && o->choice.scene == NULL)
        return scene_info(out, o, NULL, r);
    if (!file_read(&file, o->path, r))
        return 0;
    int is_named = !file_is_stdout(o->path) && picture_format(o->path) != PICTURE_UNKNOWN;
    int is_picture = is_named || picture_begins(file.data, file.size);
    int ok = is_picture                 ? picture_info(out, o, &file, r)
             : info_baked_begins(&file) ? info_baked(o->is_quiet ? NULL : out, o->path, &file, o->json, r)
                                        : scene_info(out, o, &file, r);
    file_free(&file);
    return ok;
}

/* --- the command -------------------------------------------------------------------------------------------------- */

int info_to(FILE *out, FILE *err, int argc, char **argv)
{
    report r = {""};
    options o;
    memset(&o, 0, sizeof o);
    int asked = options_parse(&o, &table, argc, argv, &r);
    if (asked == OPTIONS_RUN && o.path == NULL) {
        asked = report_fail(&r, "a scene, picture or baked file is needed; see lambent info --help");
    }
    if (asked != OPTIONS_RUN) {
        return options_answer_to(out, err, asked, &table, &r);
    }
    progress_begin(o.is_quiet, "info");
    const double start = host_seconds();
    int ok = file_info(out, &o, &r);
    ok = ok && report_flush_to(out, &r);
    if (ok && o.is_verbose) {
        fprintf(err, "lambent: read in %.1f ms\n", (host_seconds() - start) * 1e3);
    }
    return ok ? INFO_OK : report_end_to(err, &r, "info", INFO_FAILED);
}

int verb_info(int argc, char **argv) { return info_to(stdout, stderr, argc, argv); }
