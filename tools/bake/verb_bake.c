/* verb_bake.c: `lambent bake`: a scene that does not move -> its light transfer, in a file. */
#include "verb_bake.h"

#include <stdio.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../platform/host/pool.h"
#include "../common/options.h"
#include "../demo/demo_scene.h"
#include "../model/model.h"
#include "bake.h"

typedef struct options {
    const char *scene, *out, *scene_name;
    float error, division, cluster, smallest;
    int32_t elements, receivers, threads;
    int is_quiet, is_verbose;
} options;

enum { EYES = 64 }; /* cameras of the scene that are looked from */

#define AT(member) .at = offsetof(options, member)

static const option_row rows[] = {
    {.name = "SCENE", .kind = OPTION_TEXT, .value = "", AT(scene), .help = ".gltf .glb .obj .ply, or `demo`"},
    {.name = "-o", .value = "OUT.lmt", .kind = OPTION_TEXT, AT(out), .help = "for `lambent render --transfer`"},
    {.name = "--scene", .value = "NAME", .kind = OPTION_TEXT, AT(scene_name),
     .help = "of a file with several scenes: which, by name or number"},
    {.name = "--error", .kind = OPTION_ABOVE, AT(error), .low = 0.0, .high = 1.0,
     .help = "what a link of a receiver that lights a 10,000th of all area has to save, as a share of all light around "
             "it; the larger a receiver's area the less (default 0.00013)"},
    {.name = "--division", .kind = OPTION_ABOVE, AT(division), .low = 0.0, .high = 1.0,
     .help = "how far light may be from linear between receivers, as such a share of a thousandth of all area "
             "(default 0.008)"},
    {.name = "--elements", .value = "N", .kind = OPTION_POWER_OF_2, AT(elements), .low = 64,
     .high = LMB_TRANSFER_MAX_ELEMENTS,
     .help = "pieces of surface that send light: 256, 1024, 4096 or 16384 (default 16384); fewer bake faster"},
    {.name = "--receivers", .value = "N", .kind = OPTION_INT, AT(receivers), .low = 64, .high = 500000,
     .help = "no triangle is halved from so many receivers on (default 12000)"},
    {.name = "--cluster", .value = "M", .kind = OPTION_ABOVE, AT(cluster), .low = 0.0, .high = 1e5,
     .help = "triangles of meshes under twice this, m, are lit by clusters of this size (default: by the scene)"},
    {.name = "--smallest", .value = "M", .kind = OPTION_ABOVE, AT(smallest), .low = 0.0, .high = 1e5,
     .help = "no edge under this, m, is halved (default: by the scene)"},
    {.name = "--threads", .value = "N", .kind = OPTION_INT, AT(threads), .low = 1, .high = POOL_MAX,
     .help = "the file is the same with any (default: all processors)"},
    OPTION_LOUDNESS(options, is_quiet, is_verbose, "say how long it took"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_table table = {
    .verb = "bake",
    .usage = "bake SCENE -o OUT.lmt [options]",
    .about = "How light goes between the surfaces of a scene that does not move: `render --transfer` then adds light "
             "that is reflected once, many times faster than without, wherever lights and camera are. Colours may "
             "change, too. What moves, emits light or is glossy, and further reflections, are not in it.\n"
             "Takes seconds to minutes, and 4 bytes x elements x receivers of memory.",
    .part = {rows},
    .examples = "  lambent bake demo -o demo.lmt\n"
                "  lambent render demo --transfer demo.lmt -o demo.png\n",
};

static int bake_scene(const options *o, const lmb_scene *scene, const lmb_vec3 *eyes, uint32_t eye_count, report *r)
{
    static const char *const names[LMB_TRANSFER_SECTIONS] = {
        "surfaces",  "pieces", "areas",  "divisions", "corners",
        "receivers", "links",  "blends", "clusters",  "cluster links"};
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
    set.threads = o->threads > 0 ? o->threads : pool_processors();
    b.is_quiet = o->is_quiet || !(o->is_verbose || host_watched());
    int ok = bake_begin(&b, scene, &set, r) && bake_reach(&b, eyes, eye_count, r) &&
             bake_receivers(&b, r) && bake_clusters(&b, r) &&
             bake_file(&file, &b, r) && file_write(o->out, file.data, file.size, r);
    if (ok && !o->is_quiet) {
        printf("%s: %u elements, %u receivers, %.1f links each, %u clusters, %.1f links each, %.2f MB\n", o->out,
               (unsigned)b.element_count, (unsigned)b.receiver_count,
               (double)b.section[LMB_TRANSFER_LINKS].count / (b.receiver_count > 0 ? b.receiver_count : 1),
               (unsigned)b.cluster_count,
               (double)b.section[LMB_TRANSFER_CLUSTER_LINKS].count / 2.0 / (b.cluster_count > 0 ? b.cluster_count : 1),
               (double)file.size * 1e-6);
        for (int s = 0; s < LMB_TRANSFER_SECTIONS && o->is_verbose; ++s) {
            printf("  %-14s %8.3f MB\n", names[s], 4e-6 * (double)b.section[s].count);
        }
    }
    file_free(&file);
    bake_free(&b);
    return ok;
}

static int bake_model(const options *o, const lmb_scene *scene, const model *m, report *r)
{
    lmb_vec3 eyes[EYES];
    uint32_t count = 0;
    for (; count < EYES && count < m->camera_count; ++count) {
        eyes[count] = m->cameras[count].eye;
    }
    return bake_scene(o, scene, eyes, count, r);
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
    return 1;
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
    o.error = 0.00013f;
    o.division = 0.008f;
    o.elements = 16384;
    o.receivers = 12000;
    int asked = options_parse(&o, &table, argc, argv, &r);
    asked = asked == OPTIONS_RUN && !is_complete(&o, &r) ? OPTIONS_BAD : asked;
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &table, &r);
    }
    const int is_demo = strcmp(o.scene, "demo") == 0;
    int ok = file_can_write(o.out, &r) && (is_demo || model_load(&loaded, o.scene, o.scene_name, &notes, &r)) &&
             bake_model(&o, is_demo ? demo_scene() : &loaded.scene, &loaded, &r);
    model_free(&loaded);
    report_note(!ok || !o.is_verbose, "baked in %.1f s", host_seconds() - start);
    return ok ? 0 : report_end(&r, "bake", 1);
}
