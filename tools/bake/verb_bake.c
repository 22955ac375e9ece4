/* verb_bake.c: `lambent bake`: a static scene -> a file with light transfer. */
#include "verb_bake.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "../common/ending.h"
#include "../common/option_value.h"
#include "../common/options.h"
#include "../demo/demo_scene.h"
#include "../model/model.h"
#include "../model/scene_hash.h"
#include "bake.h"
#include "bake_slice.h"
#include "light_export.h"

enum { MOVING = 256 }; /* objects */
enum { EYES = 64 };    /* given by the user and cameras of the scene */

typedef struct options {
    const char *scene, *out, *moving;
    model_choice choice;
    float error, division, cluster, smallest;
    lmb_vec3 eye[EYES];
    int32_t elements, receivers, dividing, threads, budget, is_big, eyes;
    int32_t quality; /* QUALITY_ */
    int is_quiet, is_verbose, has_report, is_once, is_glossy;
    int32_t to; /* LIGHT_ */
    lmb_light lights[RENDER_LIGHTS];
    int32_t light_count, bounces, texels;
    float step_m;
    slice slice;
    uint64_t slice_job;
} options;

#define AT(member) .at = offsetof(options, member)

static const char *const orders[] = {"little", "big", NULL};
static const char *const forms[] = {"transfer", "vertex-colours", "lightmap", "probes", NULL};
static const char *const endings[] = {".lmt", ".glb", ".glb", ".json"};

/* Settings of --quality: elements, and receivers in addition to those at triangle corners. */
enum { QUALITY_DRAFT, QUALITY_DEFAULT, QUALITY_BEST };
static const char *const qualities[] = {"draft", "default", "best", NULL};
static const struct {
    int32_t elements, dividing;
} quality_counts[] = {{1024, 1500}, {4096, 7000}, {16384, 12000}};

static const option_row rows[] = {
    {.name = "SCENE", .kind = OPTION_TEXT, .value = "", AT(scene), .file = OPTION_READS,
     .help = ".gltf .glb .obj .ply .lmp, or `demo`"},
    {.name = "-o", .value = "OUT", .kind = OPTION_TEXT, AT(out), .file = OPTION_WRITES,
     .help = "a .lmt for `lambent render --transfer`; with --to a .glb or .json"},
    {.name = "--to", .kind = OPTION_WORD, AT(to), .words = forms,
     .help = "for other engines: the bounced light of the scene's lights, W/m2 before albedo, in a format that they "
             "can draw:\nvertex-colours: a .glb with triangles divided until light is linear on each; COLOR_1, "
             "times the scale in asset.extras.lambent;\nlightmap: a .glb with TEXCOORD_1 and a PNG;\nprobes: a "
             ".json and a .bin: a lattice of spherical harmonics.\nThe error of the format is measured and printed "
             "(default transfer: for lights that move)"},
    {.name = "--scene", .value = "NAME", .kind = OPTION_TEXT, AT(choice.scene),
     .help = "scene to load from a file with several, by name or number"},
    OPTION_VERTEX_COLOURS_ROW(options, choice.vertex_colours),
    {.name = "--quality", .kind = OPTION_WORD, AT(quality), .words = qualities,
     .help = "draft: 1024 elements, and 1500 receivers in addition to those at triangle corners; default: 4096 and "
             "7000; best: 16384 and 12000, which takes 1.5 to nine times as long as the default. Scenes of many "
             "thin parts get more receivers (default default)"},
    {.name = "--error", .value = "SHARE", .kind = OPTION_ABOVE, AT(error), .low = 0.0, .high = 1.0,
     .help = "accuracy of the links, which carry light from elements to receivers: the error that one more link "
             "must save, as a share of all light around a receiver that represents a 10,000th of the scene's area "
             "(errors at receivers with a larger area count more). Smaller: more accurate, a larger file (default "
             "0.00014)"},
    {.name = "--division", .value = "SHARE", .kind = OPTION_ABOVE, AT(division), .low = 0.0, .high = 1.0,
     .help = "accuracy of the division of triangles, with a receiver at each corner: light over a piece may differ "
             "from linear by this share of all light, over a thousandth of the scene's area. Smaller: finer shadows "
             "of bounced light, more receivers (default 0.008)"},
    {.name = "--elements", .value = "N", .kind = OPTION_POWER_OF_2, AT(elements), .low = 64,
     .high = LMB_TRANSFER_MAX_ELEMENTS,
     .help = "pieces of surface that emit light: 256, 1024, 4096 or 16384 (default: set by --quality); fewer are "
             "faster"},
    {.name = "--receivers", .value = "N", .kind = OPTION_INT, AT(receivers), .low = 64, .high = 500000,
     .help = "stop halving triangles at this number of receivers (default: set by --quality)"},
    {.name = "--cluster", .value = "METRES", .kind = OPTION_ABOVE, AT(cluster), .low = 0.0, .high = 1e5,
     .help = "triangles of meshes under twice this size are lit by clusters of this size (default: from the scene's "
             "area)"},
    {.name = "--smallest", .value = "METRES", .kind = OPTION_ABOVE, AT(smallest), .low = 0.0, .high = 1e5,
     .help = "shorter edges are not halved (default: from the scene's area)"},
    {.name = "--moving", .value = "N[,N..]", .kind = OPTION_TEXT, AT(moving),
     .help = "objects that may move, by number from 0 as in `lambent play`: lit by receivers in the air, with "
             "shadows of direct light. They neither block nor reflect bounced light, which gives a crate in a room "
             "a trim of 0.15 to 0.22"},
    {.name = "--eye", .value = "X,Y,Z", .kind = OPTION_POINT, AT(eye), .counts = offsetof(options, eyes), .times = EYES,
     .size = sizeof(lmb_vec3),
     .help = "position of a later camera or light, in addition to those of the scene: for rooms that these do not "
             "see"},
    {.name = "--once", .kind = OPTION_FLAG, AT(is_once),
     .help = "for pictures with one bounce: no links for further ones, which saves a tenth of the file, and memory "
             "on small machines. Not for a scene lit by materials, because surfaces that reflect their light are "
             "left out"},
    {.name = "--glossy", .kind = OPTION_FLAG, AT(is_glossy),
     .help = "for `render --glossy`: glTF's metals and smooth materials store light by direction, like those with a "
             "normal map, in two to three times the bytes"},
    {.name = "--light", .kind = OPTION_LIGHT, AT(lights), .counts = offsetof(options, light_count),
     .times = RENDER_LIGHTS, .size = sizeof(lmb_light),
     .help = "with --to: replaces the scene's lights, as in `render`"},
    {.name = "--bounces", .value = "N", .kind = OPTION_INT, AT(bounces), .low = 1, .high = 64,
     .help = "with --to: number of bounces; further ones are estimated (default 4)"},
    {.name = "--texels", .value = "N", .kind = OPTION_MULTIPLE_OF_8, AT(texels), .low = 64, .high = 8192,
     .help = "with --to lightmap: texels per side, a multiple of 8 (default 2048)"},
    {.name = "--step", .value = "METRES", .kind = OPTION_ABOVE, AT(step_m), .low = 0.0, .high = 1e6,
     .help = "with --to probes: distance between points of the lattice (default: a 12th of the scene's longest side)"},
    {.name = "--budget-bytes", .value = "N", .kind = OPTION_INT, AT(budget), .low = 1000, .high = 2000000000,
     .help = "use a larger --error if the file would be larger than this, and print it"},
    {.name = "--endian", .kind = OPTION_WORD, AT(is_big), .words = orders,
     .help = "byte order of the machine that reads the file (default: same as this one)"},
    OPTION_SLICE_ROW(options, slice, "bake, by rows of receivers"),
    {.name = "--report", .kind = OPTION_FLAG, AT(has_report), .help = "print the bytes of each part of the file"},
    OPTION_THREADS_ROW(options, threads, "bake the file"),
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(options, is_quiet, is_verbose, "print the time it took, and the number of visibility tests"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "bake",
    .usage = "bake SCENE -o OUT.lmt [options]",
    .about = "Precomputes light transport of a static scene: `render --transfer` then adds bounced light many times "
             "faster than without, for any lights and camera. You may change colours too.\nSurfaces stay dark if no "
             "light would reach them from any light or camera of the scene, after any number of bounces: the "
             "insides of solids, and closed rooms without a light or camera (use --eye for these). If a scene has "
             "more than 64 cameras, the first 64 count.\nTakes seconds to minutes, and memory: 2 bytes x elements x "
             "receivers (8 with a normal map or a lobe), 6 bytes x elements x clusters, and up to 100 MB in addition "
             "to the scene; half a gigabyte for a room with --quality best.\nSlices run at the same time, on machines "
             "that share the output's "
             "folder. They exchange results through OUT.shared; if a result does not arrive in time, a slice "
             "computes it itself.",
    .part = {rows},
    .examples = "  lambent bake demo -o demo.lmt\n"
                "  lambent render demo --transfer demo.lmt -o demo.png\n"
                "  lambent bake demo -o demo.glb --to vertex-colours --elements 1024 --receivers 2000\n",
};

/* Parses `0,3,4`: object numbers of the scene, without duplicates. */
static int parse_moving(uint32_t out[MOVING], uint32_t *count, const char *text, const lmb_scene *scene, report *r)
{
    const char *at = text;
    *count = 0;
    while (at != NULL && *count < MOVING) {
        char *end;
        const unsigned long n = *at >= '0' && *at <= '9' ? strtoul(at, &end, 10) : ULONG_MAX;
        if (n >= scene->instance_count || (*end != ',' && *end != '\0')) {
            return report_fail_usage(r, "--moving: `%s` is no list of objects 0 .. %u, like 0,3", text,
                               (unsigned)scene->instance_count - 1);
        }
        for (uint32_t i = 0; i < *count; ++i) {
            if (out[i] == n) {
                return report_fail_usage(r, "--moving: object %lu twice", n);
            }
        }
        out[(*count)++] = (uint32_t)n;
        at = *end == ',' ? end + 1 : NULL;
    }
    return at == NULL || report_fail_usage(r, "--moving: at most %d objects", MOVING);
}

static void tell(const options *o, const bake *b, size_t bytes)
{
    static const char *const names[LMB_TRANSFER_SECTIONS] = {
        "surfaces",  "pieces", "areas",  "divisions", "corners",
        "receivers", "links",  "blends", "clusters",  "cluster links",
        "coarse",    "coarse links", "moving", "grid",  "air",   "cuts"};
    const double links = (double)b->section[LMB_TRANSFER_LINKS].count, receivers = b->receiver_count;
    const double more = (double)b->section[LMB_TRANSFER_CLUSTER_LINKS].count / LMB_TRANSFER_CLUSTER_LINK_WORDS;
    if (o->is_quiet) {
        return;
    }
    report_say("%s: %u elements, %.0f receivers, %.1f links each, %u clusters, %.1f links each, %.2f MB\n", o->out,
           (unsigned)b->element_count, receivers, links / (receivers > 0.0 ? receivers : 1.0),
           (unsigned)b->cluster_count, more / (b->cluster_count > 0 ? b->cluster_count : 1), (double)bytes * 1e-6);
    if (b->set.error > o->error) {
        report_say("  by --error %.3g, which fits into %d bytes\n", (double)b->set.error, (int)o->budget);
    }
    for (int s = 0; s < LMB_TRANSFER_SECTIONS && o->has_report; ++s) {
        report_say("  %-14s %10.0f bytes\n", names[s], 4.0 * (double)b->section[s].count);
    }
}

static int is_own_big(void)
{
    const uint32_t one = 1;
    return *(const uint8_t *)(const void *)&one == 0;
}

/* Writes the file; repeats with a larger error while it is too large. */
static int make_file(file_bytes *file, const options *o, bake *b, report *r)
{
    int ok = bake_code_all(b, r) && bake_file(file, b, r);
    while (ok && o->budget > 0 && file->size > (size_t)o->budget && b->set.error < 1.0f) {
        const float over = (float)file->size / (float)o->budget;
        file_free(file);
        b->set.error *= over < 1.1f ? 1.1f : over > 4.0f ? 4.0f : over;
        ok = bake_code_all(b, r) && bake_file(file, b, r);
    }
    return ok &&
           (o->budget == 0 || file->size <= (size_t)o->budget ||
            report_fail(r, "--budget-bytes %d: without any link it is %.0f bytes; fewer --receivers or --elements",
                        (int)o->budget, (double)file->size));
}

/* Computes the light of the scene's lights from the bake, and writes it in another format. */
static int export(const options *o, const char *path, const lmb_scene *scene, const model *loaded, bake *b,
                  file_bytes *lmt, report *r)
{
    static light_solve s; /* large */
    render_options ask;
    render_options_begin(&ask);
    ask.scene = o->scene;
    ask.transfer = o->out;
    ask.show = LMB_SHOW_IRRADIANCE;
    ask.bounces = o->bounces;
    ask.threads = o->threads;
    ask.view.width = 320;
    ask.view.height = 240;
    ask.view.is_quiet = o->is_quiet;
    ask.samples = 1;
    memcpy(ask.lights, o->lights, sizeof ask.lights);
    ask.light_count = (uint32_t)o->light_count;
    int ok = render_options_complete(&ask, r) && light_begin(&s, &ask, scene, loaded, lmt, r);
    if (ok) {
        ok = o->to == LIGHT_PROBES ? light_probes(path, &s, b, o->step_m, o->is_quiet, r)
                                   : (o->to == LIGHT_MAP ? light_picture(path, &s, loaded, o->texels, r)
                                                         : light_colours(path, &s, loaded, r)) &&
                                         light_check(path, &s, forms[o->to], o->is_quiet, r);
    }
    light_end(&s);
    return ok;
}

/* Other formats are written to the folder that slices share, read back and removed. */
static int export_slice(file_bytes file[BAKE_FILES], const options *o, const lmb_scene *scene, const model *loaded,
                        bake *b, report *r)
{
    char path[BAKE_FILES][SLICE_NAME];
    const char *slash = strrchr(o->out, '/');
    const int n = snprintf(path[0], SLICE_NAME, "%s%d/%s", b->share->folder, (int)o->slice.number,
                           slash != NULL ? slash + 1 : o->out);
    const int files = o->to == LIGHT_PROBES ? 2 : 1;
    int ok = (n > 0 && n < SLICE_NAME) || report_fail(r, "%s: the name is too long", o->out);
    if (ok) {
        host_make_folders(path[0]);
    }
    ok = ok && (files == 1 || bake_slice_numbers(path[1], path[0], r)) &&
         export(o, path[0], scene, loaded, b, &file[0], r);
    file_free(&file[0]);
    for (int i = 0; ok && i < files; ++i) {
        ok = file_read(&file[i], path[i], r);
        remove(path[i]);
    }
    return ok;
}

/* `file`: the .lmt. */
static int write_slice(const options *o, const lmb_scene *scene, const model *loaded, bake *b, file_bytes *file,
                       report *r)
{
    file_bytes all[BAKE_FILES] = {*file, {NULL, 0}};
    char about[SLICE_ABOUT];
    const size_t bytes = file->size;
    memset(file, 0, sizeof *file);
    snprintf(about, sizeof about, "bake %.160s to %s", o->scene, forms[o->to]);
    const int ok = (o->to == LIGHT_TRANSFER || export_slice(all, o, scene, loaded, b, r)) &&
                   bake_slice_write(o->out, b->share, about, all, o->to == LIGHT_PROBES ? 2 : 1, r);
    if (ok) {
        report_note(o->is_quiet, "%s.%dof%d: %.0f of %.0f rows were made here", o->out, (int)o->slice.number,
                    (int)o->slice.count, b->share->made, b->share->all);
        tell(o, b, bytes);
    }
    for (int i = 0; i < BAKE_FILES; ++i) {
        file_free(&all[i]);
    }
    return ok;
}

/* Ends file_keep_all: slice files are read and written again, so they may be overwritten. */
static int begin_slice(bake_share *s, char folder[SLICE_NAME], const options *o, const lmb_scene *scene, report *r)
{
    char name[SLICE_NAME];
    const uint64_t own = scene_hash(scene); /* includes the files beside the scene file */
    s->slice = o->slice;
    s->job = slice_hash(o->slice_job, &own, sizeof own);
    s->job = slice_hash(s->job, o->is_big ? "big" : "little", 3); /* the default is the byte order of the machine */
    s->folder = folder;
    if (!slice_name(name, o->out, o->slice, r) || !file_can_write(name, r) || !bake_slice_folder(folder, o->out, r)) {
        return 0;
    }
    file_keep_end();
    return 1;
}

static int bake_scene(const options *o, const lmb_scene *whole, const model *loaded, const lmb_vec3 *eyes,
                      uint32_t eye_count, report *r)
{
    static bake_share share; /* large: it contains a folder name */
    static char folder[SLICE_NAME];
    bake b;
    bake_settings set;
    file_bytes file = {NULL, 0};
    memset(&b, 0, sizeof b);
    memset(&set, 0, sizeof set);
    set.error = o->error;
    set.division = o->division;
    set.cluster_m = o->cluster;
    set.smallest_m = o->smallest;
    set.elements = (uint32_t)o->elements;
    set.receivers = (uint32_t)o->receivers;
    set.dividing = (uint32_t)o->dividing;
    set.threads = pool_threads(o->threads);
    set.is_swapped = o->is_big != is_own_big();
    uint32_t moving[MOVING], count, coarse = 0;
    uint64_t tests = 0;
    bake_still_scene still = {*whole, NULL};
    b.coarse = &coarse;
    b.tests = &tests;
    b.share = o->slice.count > 0 ? &share : NULL;
    int ok = (o->to != LIGHT_PROBES || light_probes_fit(whole, o->step_m, r)) &&
             (b.share == NULL || begin_slice(&share, folder, o, whole, r)) &&
             parse_moving(moving, &count, o->moving, whole, r) &&
             (count == 0 || bake_still(&still, whole, moving, count, &b.section[LMB_TRANSFER_MOVING], r)) &&
             bake_begin(&b, &still.scene, &set, r) && bake_reach(&b, eyes, eye_count, r) && bake_receivers(&b, r) &&
             bake_clusters(&b, r) && bake_directed(&b, r) && bake_air(&b, r) && (o->is_once || bake_bounces(&b, r)) &&
             make_file(&file, o, &b, r);
    if (ok && b.share != NULL) {
        ok = write_slice(o, whole, loaded, &b, &file, r);
    } else if (ok && o->to != LIGHT_TRANSFER) {
        ok = export(o, o->out, whole, loaded, &b, &file, r);
    } else if (ok && file_write(o->out, file.data, file.size, r)) {
        tell(o, &b, file.size);
    }
    ok = ok && r->text[0] == '\0';
    report_note(!ok || o->is_quiet || coarse == 0,
                "note: %.0f sights have coarser visibility: too many triangles cross "
                "there",
                (double)coarse);
    report_note(!ok || !o->is_verbose, "%.1f million visibility tests", 1e-6 * (double)tests);
    file_free(&file);
    free(still.instance);
    bake_free(&b);
    return ok;
}

static int bake_model(const options *o, const lmb_scene *scene, const model *m, report *r)
{
    lmb_vec3 eyes[2 * EYES];
    uint32_t count = (uint32_t)o->eyes;
    memcpy(eyes, o->eye, sizeof o->eye);
    report_note(o->is_quiet || m->camera_count <= EYES,
                "note: %s has %u cameras, of which the first %d count; rooms that "
                "only others see into stay dark, but for --eye",
                o->scene, (unsigned)m->camera_count, EYES);
    for (uint32_t i = 0; i < EYES && i < m->camera_count; ++i) {
        eyes[count++] = m->cameras[i].eye;
    }
    return bake_scene(o, scene, m, eyes, count, r);
}

static int is_complete(const options *o, report *r)
{
    if (o->scene == NULL) {
        return report_fail(r, "no scene given");
    }
    if (o->out == NULL) {
        return report_fail(r, "no output given; add -o FILE.lmt");
    }
    if ((o->elements & 0x55555555) == 0) {
        return report_fail(r, "--elements: `%d` is not a power of four: 64, 256, 1024, 4096, 16384", (int)o->elements);
    }
    if (o->to != LIGHT_TRANSFER && (o->moving != NULL || o->budget > 0)) {
        return report_fail(r, "--to %s: light stands still in it: no --moving and no --budget-bytes go with it",
                           forms[o->to]);
    }
    if (o->to == LIGHT_TRANSFER && (o->light_count > 0 || o->bounces > 0)) {
        return report_fail(r, "--light and --bounces are for --to: a .lmt is for any lights and bounces");
    }
    return o->to == LIGHT_TRANSFER || has_ending(o->out, endings[o->to])
               ? file_suits("-o", o->out, endings[o->to], r)
               : report_fail(r, "-o %s: --to %s writes a %s; name it *%s", o->out, forms[o->to], endings[o->to],
                             endings[o->to]);
}

int verb_bake(int argc, char **argv)
{
    report r = {""};
    options o;
    model loaded;
    model_notes notes;
    const double start = host_seconds();
    memset(&o, 0, sizeof o);
    memset(&loaded, 0, sizeof loaded);
    memset(&notes, 0, sizeof notes);
    o.error = 0.00014f;
    o.division = 0.008f;
    o.quality = QUALITY_DEFAULT;
    o.is_big = is_own_big();
    int asked = options_parse(&o, &table, argc, argv, &r);
    o.elements = o.elements > 0 ? o.elements : quality_counts[o.quality].elements;
    o.dividing = quality_counts[o.quality].dividing;
    asked = asked == OPTIONS_RUN && !is_complete(&o, &r) ? OPTIONS_BAD : asked;
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &table, &r);
    }
    const int is_demo = strcmp(o.scene, "demo") == 0;
    o.bounces = o.bounces > 0 ? o.bounces : 4;
    o.texels = o.texels > 0 ? o.texels : 2048;
    o.choice.keeps_source = o.to == LIGHT_COLOURS || o.to == LIGHT_MAP;
    progress_begin_log(o.is_quiet, "bake");
    int ok = options_files(&o, &table, &r) &&
             (o.slice.count == 0 || slice_job(&o.slice_job, &o, &table, argc, argv, &r)) &&
             (is_demo || model_load_as(&loaded, o.scene, &o.choice, &notes, &r)) && options_files(&o, &table, &r) &&
             (!o.is_glossy || model_make_glossy(&loaded) ||
              report_fail_usage(&r, "--glossy: %s: only glTF's materials have a lobe", o.scene)) &&
             (model_tell(&notes, o.scene, MODEL_NOTE_OPTION),
              bake_model(&o, is_demo ? demo_scene() : &loaded.scene, &loaded, &r));
    progress_end();
    model_free(&loaded);
    report_note(!ok || !o.is_verbose, "baked in %.1f s", host_seconds() - start);
    return ok ? 0 : report_end(&r, "bake", 1);
}
