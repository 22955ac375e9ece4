/* verb_pack.c: `lambent pack`: a scene as one file to use in place, or as a C array. */
#include "verb_pack.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/option_value.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../demo/demo_scene.h"
#include "../model/io_lmt.h"
#include "../model/model_motion.h"
#include "c_name.h"
#include "pack.h"

typedef struct options {
    const char *scene, *out, *name, *transfer;
    model_choice choice;
    float position_error, texture_error;
    int32_t position_given, texture_given, order_given, textures_given;
    int32_t is_big, order, textures;
    int is_quiet, is_verbose, has_report, is_glossy;
} options;

#define AT(member) .at = offsetof(options, member)

static const char *const endians[] = {"little", "big", NULL};
static const char *const orders[] = {"locality", "file", NULL};
static const char *const formats[] = {"auto", "rgba8", "rgb565", "palette4", NULL};

static const option_row rows[] = {
    {.name = "SCENE", .kind = OPTION_TEXT, .value = "", AT(scene), .file = OPTION_READS,
     .help = ".gltf .glb .obj .ply, `demo`, or a packed .lmp, whose parts stay unchanged"},
    {.name = "-o", .value = "OUT", .kind = OPTION_TEXT, AT(out), .file = OPTION_WRITES,
     .help = ".lmp: a file to load or map; .c: the same words as an array to link"},
    {.name = "--name", .value = "NAME", .kind = OPTION_TEXT, AT(name),
     .help = "name of the array, valid in C and C++ (default: the file's name up to the first dot, with _ for other "
             "characters than letters and digits; if that is not valid, scene_ is put in front)"},
    {.name = "--scene", .value = "NAME", .kind = OPTION_TEXT, AT(choice.scene),
     .help = "one of several scenes in the file, by name or number"},
    OPTION_VERTEX_COLOURS_ROW(options, choice.vertex_colours),
    {.name = "--transfer", .value = "FILE.lmt", .kind = OPTION_TEXT, AT(transfer), .file = OPTION_READS,
     .help = "adds baked light to the file; bake it from the packed scene, because packing moves vertices"},
    {.name = "--position-error", .value = "METRES", .kind = OPTION_NUMBER, AT(position_error), .low = 0.0, .high = 1e6,
     .counts = offsetof(options, position_given),
     .help = "how far a vertex may move to a grid, which saves 4 of 12 bytes; 0: not at all (default: a 32768th of "
             "the scene's diagonal)"},
    {.name = "--order", .kind = OPTION_WORD, AT(order), .words = orders, .counts = offsetof(options, order_given),
     .help = "of triangles: so that they share vertices with preceding ones (default), or as in the file"},
    {.name = "--textures", .kind = OPTION_WORD, AT(textures), .words = formats,
     .counts = offsetof(options, textures_given),
     .help = "of base colours and emission maps, all levels: the smallest that --texture-error allows (default), or "
             "one for all. Other maps are rgba8, and those with holes are not rgb565. With rgba8, vertex colours are "
             "bytes too, for builds without LMB_TEXTURE_FORMATS"},
    {.name = "--texture-error", .value = "CODES", .kind = OPTION_NUMBER, AT(texture_error), .low = 0.0, .high = 255.0,
     .counts = offsetof(options, texture_given),
     .help = "maximum error of a texture's codes, of 255, as the root of the mean square; twice as "
             "much in the smaller levels, which show from afar (default 3)"},
    {.name = "--glossy", .kind = OPTION_FLAG, AT(is_glossy),
     .help = "keeps the highlights of glTF's metals and smooth materials"},
    {.name = "--endian", .kind = OPTION_WORD, AT(is_big), .words = endians,
     .help = "byte order of the machine that reads the file (default: of this one)"},
    {.name = "--report", .kind = OPTION_FLAG, AT(has_report), .help = "prints the bytes of the file, part by part"},
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(options, is_quiet, is_verbose, "print the time it took"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "pack",
    .usage = "pack SCENE -o OUT.lmp|OUT.c [options]",
    .about = "Packs a scene into one file that a program uses in place, from flash or a mapped file, by "
             "lmb_pack_open: vertices in 16 bits, textures in 4 to 32 bits with their levels, materials, lights, "
             "cameras, animations and baked light.\nThe bytes are the same on every machine. Other verbs take a "
             ".lmp as a SCENE. To add baked light, pack, bake the .lmp, and pack the .lmp with --transfer.",
    .part = {rows},
    .examples = "  lambent pack demo -o demo.lmp --report\n"
                "  lambent bake demo.lmp -o demo.lmt --elements 256 --receivers 300\n"
                "  lambent pack demo.lmp --transfer demo.lmt -o demo_scene.c\n",
};

/* --- the report --------------------------------------------------------------------------------------------------- */

static void say_part(const char *name, double bytes, double all)
{
    if (bytes > 0.0) {
        report_say("  %-14s %10.0f bytes %5.1f %%\n", name, bytes, 100.0 * bytes / all);
    }
}

static void say_vertices(const lmb_pack *p, double all)
{
    double positions = 0.0, normals = 0.0, tangents = 0.0, uvs = 0.0, colours = 0.0;
    for (uint32_t i = 0; i < p->count[LMB_PACK_MESHES]; ++i) {
        lmb_mesh m;
        pack_streams(&m, p, i);
        positions += (m.position_format == LMB_POSITION_I16 ? 8.0 : 12.0) * m.vertex_count;
        normals += m.normals != NULL ? 4.0 * m.vertex_count : 0.0;
        tangents += m.tangents != NULL ? 4.0 * m.vertex_count : 0.0;
        uvs += m.uvs == NULL ? 0.0 : (m.uv_format == LMB_UV_U16 ? 4.0 : 8.0) * m.vertex_count;
        colours += m.colours == NULL ? 0.0 : (m.colour_format == LMB_COLOUR_RGBA16 ? 8.0 : 4.0) * m.vertex_count;
    }
    say_part("positions", positions, all);
    say_part("normals", normals, all);
    say_part("tangents", tangents, all);
    say_part("coordinates", uvs, all);
    say_part("colours", colours, all);
}

static void say_parts(const lmb_pack *p, size_t size)
{
    static const char *const names[LMB_PACK_KINDS] = {
        "", "bounds", "meshes", "", "indices", "materials", "textures", "texels", "instances", "lights", "cameras",
        "nodes", "tracks", "keys", "names", "transfer", "vertex light"};
    double parts = 0.0;
    say_vertices(p, (double)size);
    for (int kind = 1; kind < LMB_PACK_KINDS; ++kind) {
        parts += p->bytes[kind];
        if (kind != LMB_PACK_VERTICES) {
            say_part(names[kind], p->bytes[kind], (double)size);
        }
    }
    say_part("table", (double)size - parts, (double)size);
    report_say("  %-14s %10zu bytes\n", "in all", size);
}

static void say_losses(const pack_losses *l)
{
    report_say("  %u triangles of %u vertices, before %u; fetched by a cache of 16: %.2f a triangle, before %.2f\n",
               (unsigned)l->triangles, (unsigned)l->vertices, (unsigned)l->vertices_before,
               (double)l->fetched / (l->triangles > 0 ? l->triangles : 1),
               (double)l->fetched_before / (l->triangles > 0 ? l->triangles : 1));
    report_say("  vertices moved by up to %.3g m, texture coordinates by %.3g texels\n", l->position_m, l->uv_texels);
    report_say("  textures: %u rgba8, %u rgb565, %u palette4, off by up to %.2f of 255\n",
               (unsigned)l->textures[LMB_TEXELS_RGBA8], (unsigned)l->textures[LMB_TEXELS_RGB565],
               (unsigned)l->textures[LMB_TEXELS_PALETTE4], l->texture);
}

/* --- the work ----------------------------------------------------------------------------------------------------- */

static int is_own_big(void)
{
    const uint32_t one = 1;
    return *(const uint8_t *)(const void *)&one == 0;
}

/* Adds the baked light to the file, if it fits the packed scene. */
static int put_transfer(pack *p, const options *o, report *r)
{
    file_bytes file = {NULL, 0}, packed = {NULL, 0};
    lmb_transfer t;
    lmb_pack opened;
    lmb_scene s;
    void *memory = NULL;
    int ok = file_read(&file, o->transfer, r) && lmt_open(&t, &file, o->transfer, r) && pack_file(&packed, p, r) &&
             (lmb_pack_open(&opened, packed.data, packed.size) == LMB_OK ||
              report_fail(r, "%s: what was packed does not open", o->scene));
    if (ok) {
        const size_t bytes = lmb_pack_bytes(&opened) + 1;
        memory = malloc(bytes);
        ok = (memory != NULL || report_fail(r, "not enough memory for its scene")) &&
             (lmb_pack_scene(&s, &opened, memory, bytes) == LMB_OK || report_fail(r, "%s: not valid", o->scene)) &&
             (lmb_transfer_fits(&t, &s) == LMB_OK ||
              report_fail(r,
                          "%s: baked from another scene than what %s becomes here; pack it, `lambent bake` the .lmp, "
                          "and pack that with --transfer",
                          o->transfer, o->scene));
    }
    if (ok) {
        const uint8_t *words = (const uint8_t *)(t.section[0] - LMB_TRANSFER_HEADER_WORDS);
        uint32_t size;
        memcpy(&size, words + 8, sizeof size);
        p->part[LMB_PACK_TRANSFER].size = 0;
        pack_put(&p->part[LMB_PACK_TRANSFER], words, size);
        if (!p->part[LMB_PACK_TRANSFER].is_short) { /* the checksum of the whole file covers it */
            memset(p->part[LMB_PACK_TRANSFER].data + 4 * (LMB_TRANSFER_HEADER_WORDS - 1), 0, 4);
        }
    }
    free(memory);
    file_free(&file);
    file_free(&packed);
    return ok;
}

static int is_code(const char *path)
{
    const size_t n = strlen(path);
    return n > 2 && strcmp(path + n - 2, ".c") == 0;
}

/* Chooses the name of the array: --name, or a name made from the file name. */
static int array_name(char out[C_NAME], const options *o, report *r)
{
    const char *wrong = o->name != NULL ? c_name_check(o->name) : NULL;
    if (wrong != NULL) {
        return report_fail_usage(r, "--name: `%s` is no name in C and C++: %s; give another one", o->name, wrong);
    }
    if (o->name != NULL) {
        strcpy(out, o->name);
    } else {
        c_name_of(out, o->out);
    }
    return 1;
}

static void tell(const options *o, const pack *p, const lmb_pack *opened, size_t size, int is_new)
{
    if (o->is_quiet) {
        return;
    }
    report_say("%s: %.2f MB, %u meshes, %u textures\n", o->out, (double)size * 1e-6,
               (unsigned)opened->count[LMB_PACK_MESHES], (unsigned)opened->count[LMB_PACK_TEXTURES]);
    if (is_new) {
        say_losses(&p->lost);
        report_note(p->lost.dropped == 0, "note: triangles without area or vertices, which are left out: %u",
                    (unsigned)p->lost.dropped);
        report_note(p->lost.float_meshes == 0 || (o->position_given > 0 && o->position_error == 0.0f),
                    "note: meshes whose positions stay in 32 bits, as they are too large for the error: %u",
                    (unsigned)p->lost.float_meshes);
    }
    if (o->has_report) {
        say_parts(opened, size);
    }
}

static int write_out(const options *o, const pack *p, int is_new, report *r)
{
    file_bytes file = {NULL, 0};
    lmb_pack opened;
    char name[C_NAME];
    int ok =
        (!is_code(o->out) || array_name(name, o, r)) && pack_file(&file, p, r) &&
        (lmb_pack_open(&opened, file.data, file.size) == LMB_OK || report_fail(r, "what was packed does not open"));
    if (ok && o->is_big != is_own_big()) {
        pack_swap(&file, &opened);
    }
    ok = ok && (is_code(o->out) ? pack_code(o->out, name, &file, o->is_big, r)
                                : file_write(o->out, file.data, file.size, r));
    if (ok && o->is_big != is_own_big()) {
        file_free(&file); /* `opened` points into the file that is swapped now */
        ok = pack_file(&file, p, r) && lmb_pack_open(&opened, file.data, file.size) == LMB_OK;
    }
    if (ok) {
        tell(o, p, &opened, file.size, is_new);
    }
    file_free(&file);
    return ok;
}

static float diagonal_of(const lmb_scene *s)
{
    const double x = (double)s->bounds_max.x - (double)s->bounds_min.x,
                 y = (double)s->bounds_max.y - (double)s->bounds_min.y,
                 z = (double)s->bounds_max.z - (double)s->bounds_min.z;
    return (float)lmb_sqrt((float)(x * x + y * y + z * z));
}

/* A packed scene is not packed again, because errors would add up. */
static int may_take(const options *o, report *r)
{
    return (o->position_given + o->texture_given + o->order_given + o->textures_given == 0 && !o->is_glossy) ||
           report_fail_usage(
               r,
               "%s: a packed scene stays as it is; options of vertices, textures and materials are for its "
               "source",
               o->scene);
}

static int pack_scene(const options *o, const model *m, report *r)
{
    pack p;
    pack_settings set;
    memset(&p, 0, sizeof p);
    set.position_error_m = o->position_given > 0 ? (double)o->position_error : (double)diagonal_of(&m->scene) / 32768.0;
    set.texture_error = (double)o->texture_error;
    set.order = o->order;
    set.textures = o->textures;
    const int ok =
        (m->pack != NULL ? may_take(o, r) && pack_take(&p, m->pack, o->scene, r) : pack_model(&p, m, &set, r)) &&
        (o->transfer == NULL || put_transfer(&p, o, r)) && write_out(o, &p, m->pack == NULL, r);
    pack_free(&p);
    return ok;
}

/* The built-in scene, with the camera of `render demo`. */
static void make_demo(model *out, model_camera *camera)
{
    const lmb_view v = demo_view(640, 480);
    memset(camera, 0, sizeof *camera);
    camera->eye = v.eye;
    camera->right = v.right;
    camera->up = v.up;
    camera->back = v.back;
    camera->yfov_rad = 0.872664626f;
    camera->aspect = 4.0f / 3.0f;
    out->scene = *demo_scene();
    out->cameras = camera;
    out->camera_count = 1;
}

static int is_complete(const options *o, report *r)
{
    if (o->scene == NULL) {
        return report_fail(r, "no scene given");
    }
    if (o->out == NULL) {
        return report_fail(r, "no output given; add -o FILE.lmp or -o FILE.c");
    }
    if (o->name != NULL && !is_code(o->out)) {
        return report_fail(r, "--name is of a C array; name the output FILE.c");
    }
    return file_suits("-o", o->out, ".lmp", r);
}

int verb_pack(int argc, char **argv)
{
    report r = {""};
    options o;
    model loaded;
    model_camera camera;
    model_notes notes;
    const double start = host_seconds();
    memset(&o, 0, sizeof o);
    memset(&loaded, 0, sizeof loaded);
    memset(&notes, 0, sizeof notes);
    o.texture_error = 3.0f;
    o.is_big = is_own_big();
    int asked = options_parse(&o, &table, argc, argv, &r);
    asked = asked == OPTIONS_RUN && !is_complete(&o, &r) ? OPTIONS_BAD : asked;
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &table, &r);
    }
    const int is_demo = strcmp(o.scene, "demo") == 0;
    if (is_demo) {
        make_demo(&loaded, &camera);
    }
    progress_begin(o.is_quiet, "pack");
    int ok = options_files(&o, &table, &r) && (is_demo || model_load_as(&loaded, o.scene, &o.choice, &notes, &r)) &&
             options_files(&o, &table, &r) &&
             (!o.is_glossy || loaded.pack != NULL || model_make_glossy(&loaded) ||
              report_fail_usage(&r, "--glossy: %s: only glTF's materials have a lobe", o.scene));
    if (ok) {
        model_tell(&notes, o.scene, MODEL_NOTE_PLAIN);
    }
    report_note(!ok || o.is_quiet || loaded.motion == NULL || loaded.motion->shapes == NULL,
                "note: skins and morph targets that animations move stand still in what is packed");
    ok = ok && pack_scene(&o, &loaded, &r);
    if (!is_demo) {
        model_free(&loaded);
    }
    report_note(!ok || !o.is_verbose, "packed in %.1f s", host_seconds() - start);
    return ok ? 0 : report_end(&r, "pack", 1);
}
