/* verb_render.c: `lambent render`: a scene in, a picture with bounced light out. */
#include "verb_render.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../platform/host/host.h"
#include "crew.h"
#include "demo_scene.h"
#include "model.h"
#include "picture.h"
#include "render_options.h"
#include "render_view.h"

#define MAP_TEXELS (2u << 20) /* over all lights' maps, by default: 16 MiB */

/* One run, from the options to the picture. Everything here is freed by job_free. */
typedef struct job {
    render_options o;
    model loaded;
    model_notes notes;
    lmb_scene scene; /* the loaded or built-in one, with the lights of this run */
    lmb_light sun;
    lmb_frame frame;
    lmb_render *render;
    crew crew;
    lmb_stats stats;
    image linear;
    void *map_memory, *point_memory, *blocker_memory, *depth_memory, *id_memory;
    size_t bytes; /* of the above and the state */
    double load_s, write_s, total_s;
    double indirect_share;
} job;

static void job_free(job *j)
{
    free(j->map_memory);
    free(j->point_memory);
    free(j->blocker_memory);
    free(j->depth_memory);
    free(j->id_memory);
    free(j->frame.groups);
    free(j->crew.scratches);
    free(j->render);
    image_free(&j->linear);
    model_free(&j->loaded);
}

static void *take(job *j, size_t bytes, report *r)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    j->bytes += bytes;
    if (p == NULL) {
        report_fail(r, "not enough memory: %.0f MiB more wanted; try a smaller --size or --light-map",
                    (double)bytes / 1048576.0);
    }
    return p;
}

/* --- scene and lights ----------------------------------------------------------------------------------------------- */

static int load_scene(job *j, report *r)
{
    if (strcmp(j->o.scene, "demo") == 0) {
        j->scene = *demo_scene();
        return 1;
    }
    if (!model_load(&j->loaded, j->o.scene, j->o.scene_name, &j->notes, r)) {
        return 0;
    }
    j->scene = j->loaded.scene;
    uint32_t lights = j->o.light_count > 0 ? 0 : j->scene.light_count;
    if (lmb_scene_triangles(&j->scene) == 0) {
        return report_fail(r, "%s: nothing to draw: no triangles; `lambent info` says what is in it", j->o.scene);
    }
    if (lights > LMB_MAX_LIGHTS) {
        return report_fail(r,
                           "%s: %u lights; this build draws up to %d at once, each with its own map; remove some, or "
                           "give others by --light",
                           j->o.scene, (unsigned)lights, LMB_MAX_LIGHTS);
    }
    return 1;
}

/* Once nothing but memory can fail: an error is a line on its own. */
static void tell_notes(const job *j)
{
    for (uint32_t i = 0; i < j->notes.count; ++i) {
        fprintf(stderr, "lambent: note: %s\n", j->notes.line[i]);
    }
}

static void set_lights(job *j)
{
    if (j->o.light_count > 0) {
        j->scene.lights = j->o.lights;
        j->scene.light_count = j->o.light_count;
    } else if (j->scene.light_count == 0) {
        lmb_light sun = {{0, 0, 0}, {-0.45f, -0.8f, -0.3968627f}, {3.0f, 2.9f, 2.7f}, 1.0f, 1.0f, LMB_LIGHT_DIRECTIONAL,
                         0};
        j->sun = sun;
        j->scene.lights = &j->sun;
        j->scene.light_count = 1;
        fprintf(stderr, "lambent: no light in %s: a sun of 3 W/m2 from the upper right; --light sets others\n",
                j->o.scene);
    }
}

/* --- memory --------------------------------------------------------------------------------------------------------- */

static uint32_t total_faces(const lmb_scene *s)
{
    uint32_t faces = 0;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        faces += (uint32_t)lmb_light_map_faces(&s->lights[i]);
    }
    return faces;
}

static int32_t choose_light_map(const job *j, uint32_t faces)
{
    uint32_t size = 1024;
    while (size > 64 && (uint64_t)size * size * faces > MAP_TEXELS) {
        size /= 2;
    }
    return j->o.light_map != 0 ? j->o.light_map : (int32_t)size;
}

static int take_maps(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    uint32_t faces = total_faces(&j->scene);
    f->light_map = choose_light_map(j, faces);
    for (uint32_t i = 0; i < j->scene.light_count; ++i) {
        f->map_bytes += lmb_light_map_bytes(lmb_light_map_faces(&j->scene.lights[i]), f->light_map, f->id_format);
    }
    f->map_memory = j->map_memory = take(j, f->map_bytes, r);
    return f->map_memory != NULL;
}

/* The tree of light, and of what blocks it. */
static int take_tree(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    const uint32_t faces = total_faces(&j->scene), triangles = lmb_scene_triangles(&j->scene);
    const size_t bytes = lmb_tree_bytes(faces, f->light_map), blocker_bytes = lmb_blockers_bytes(triangles);
    if (bytes == 0) {
        return report_fail(r, "--grouping cut: --light-map must be a power of two, 8 .. 4096, not %d",
                           (int)f->light_map);
    }
    j->point_memory = take(j, bytes, r);
    j->blocker_memory = take(j, f->occlusion == LMB_OCCLUSION_EXACT ? blocker_bytes : 0, r);
    if (j->point_memory == NULL || j->blocker_memory == NULL) {
        return 0;
    }
    if (f->occlusion == LMB_OCCLUSION_EXACT) {
        lmb_blockers_init(&f->blockers, triangles, j->blocker_memory, blocker_bytes);
    }
    return lmb_tree_init(&f->tree, faces, f->light_map, j->point_memory, bytes) == LMB_OK;
}

/* Room for every block to hold all the surfaces that the library tells apart. */
static int take_points(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    int32_t block = f->grouping.block != 0 ? f->grouping.block : LMB_TILE;
    uint32_t side = (uint32_t)(f->light_map / block);
    uint64_t n = (uint64_t)side * side * 4u * total_faces(&j->scene);
    if (n > 64000000u) {
        return report_fail(r, "%.0f first points are too many; use a larger --block or a smaller --light-map",
                           (double)n);
    }
    n = n > 0 ? n : 1;
    size_t bytes = lmb_points_bytes((uint32_t)n, side);
    j->point_memory = take(j, bytes, r);
    f->groups = take(j, sizeof *f->groups, r);
    return j->point_memory != NULL && f->groups != NULL &&
           lmb_points_init(&f->points, (uint32_t)n, side, j->point_memory, bytes) == LMB_OK;
}

static int take_frame(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    int32_t w = f->view.frame_width, h = f->view.frame_height;
    size_t depth = lmb_surface_bytes(LMB_DEPTH32F, w, h), id = lmb_surface_bytes(f->id_format, w, h);
    size_t out = (size_t)w * (size_t)h * 3 * sizeof(float);
    j->depth_memory = take(j, depth, r);
    j->id_memory = take(j, id, r);
    j->linear.pixels = take(j, out, r);
    f->scratch = j->crew.scratches = take(j, sizeof *f->scratch * (size_t)j->crew.threads, r);
    if (f->scratch) memset(f->scratch, 0, sizeof *f->scratch * (size_t)j->crew.threads);
    j->render = take(j, sizeof *j->render, r);
    if (r->text[0] != '\0') {
        return 0;
    }
    memset(j->linear.pixels, 0, out);
    j->linear.width = w;
    j->linear.height = h;
    j->linear.channels = 3;
    lmb_surface_init(&f->eye.depth, LMB_DEPTH32F, w, h, j->depth_memory, depth);
    lmb_surface_init(&f->eye.id, f->id_format, w, h, j->id_memory, id);
    lmb_surface_init(&f->out, LMB_RGB32F, w, h, j->linear.pixels, out);
    return 1;
}

static int set_frame(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    if (!render_view(&f->view, &j->o, &j->loaded, &j->scene, r)) {
        return 0;
    }
    tell_notes(j);
    set_lights(j);
    j->crew.threads = j->o.threads > 0 ? j->o.threads : pool_processors();
    j->crew.threads = j->crew.threads > POOL_MAX ? POOL_MAX : j->crew.threads;
    f->kernels = j->o.kernels;
    f->scene = &j->scene;
    f->show = j->o.show < SHOW_DEPTH ? j->o.show : LMB_SHOW_FULL;
    f->grouping = j->o.grouping;
    f->occlusion = j->o.occlusion;
    f->steps = j->o.steps;
    f->error = j->o.error;
    f->visible = j->o.visible;
    f->id_format = LMB_ID32;
    f->stats = &j->stats;
    if (j->o.show >= SHOW_DEPTH) {
        return take_frame(j, r);
    }
    return take_maps(j, r) &&
           (j->o.show == LMB_SHOW_DIRECT ||
            (f->grouping.method == LMB_GROUP_CUT ? take_tree(j, r) : take_points(j, r))) &&
           take_frame(j, r);
}

/* --- drawing -------------------------------------------------------------------------------------------------------- */

static void show_progress(const lmb_render *render, double since)
{
    const char *name;
    float part = lmb_render_progress(&name, render);
    double passed = host_seconds() - since;
    char bar[21];
    for (int i = 0; i < 20; ++i) {
        bar[i] = (float)i < part * 20.0f ? '#' : '.';
    }
    bar[20] = '\0';
    if (render->stage == LMB_STAGE_BANDS && part > 0.02f) {
        fprintf(stderr, "\r%-12s [%s] %3.0f %%  %.0f s left   ", name, bar, (double)part * 100.0,
                passed / (double)part - passed);
    } else {
        fprintf(stderr, "\r%-12s [%s] %3.0f %%               ", name, bar, (double)part * 100.0);
    }
}

typedef struct watcher {
    int32_t stage;
    double start, stage_start, shown; /* s; shown 0: nothing was */
} watcher;

/* What stopped a frame, in words. The memory is sized here, so little can. */
static int explain(const job *j, lmb_status status, int stage, report *r)
{
    if (status == LMB_ERR_CAPACITY && stage == LMB_STAGE_GROUPS) {
        return report_fail(r, "--grouping none: %u discs do not fit %d groups; use a smaller --light-map, or zones",
                           (unsigned)j->stats.first_points, LMB_MAX_GROUPS);
    }
    return report_fail(r, "%s: rendering stopped: %s", j->o.scene, lmb_status_name(status));
}

/* A second of silence first, then ten times a second. */
static void watch(void *user, const lmb_render *at)
{
    watcher *w = user;
    const double now = host_seconds();
    if (at->stage != w->stage) {
        w->stage = at->stage;
        w->stage_start = now;
    }
    if (now - w->start > 1.0 && now - w->shown > 0.1) {
        show_progress(at, w->stage_start);
        w->shown = now;
    }
}

static int draw(job *j, report *r)
{
    watcher w = {LMB_STAGE_LIGHT_MAP, host_seconds(), 0.0, 0.0};
    w.stage_start = w.start;
    j->crew.tell = host_watched() ? watch : NULL;
    j->crew.user = &w;
    int32_t stage;
    lmb_status status = crew_render(&j->crew, &stage, j->render, &j->frame);
    if (w.shown > 0.0) {
        fprintf(stderr, "\r%60s\r", "");
    }
    return status == LMB_OK || explain(j, status, stage, r);
}

/* Attributes instead of light: the view alone is drawn. */
static int draw_attributes(job *j, report *r)
{
    lmb_frame *f = &j->frame;
    lmb_surface z = f->out, *depth = NULL, *normal = NULL, *albedo = NULL;
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    lmb_status status = lmb_draw(&f->eye, f->kernels, &f->view, &j->scene, 1, UINT32_MAX - 1,
                                 LMB_CULL_BACK, &j->stats);
    if (j->o.show == SHOW_DEPTH) {
        z.format = LMB_R32F;
        z.stride_bytes = z.width * 4;
        j->linear.channels = 1;
        depth = &z;
    } else if (j->o.show == SHOW_NORMAL) {
        normal = &f->out;
    } else {
        albedo = &f->out;
    }
    for (int32_t band = 0; status == LMB_OK && band < (f->view.frame_height + 7) / 8; ++band) {
        status =
            lmb_gbuffer_band(depth, normal, albedo, &f->scratch->tile, f->kernels, &f->view, &j->scene, &f->eye, band);
    }
    return status == LMB_OK || report_fail(r, "%s: drawing stopped: %s", j->o.scene, lmb_status_name(status));
}

/* Display formats show attributes as pictures: depth near to white, normals with 0 at middle grey. */
static int attributes_for_display(job *j, report *r)
{
    size_t n = (size_t)j->linear.width * (size_t)j->linear.height;
    float far_m = 1e-30f, *wide;
    if (j->o.show == SHOW_NORMAL) {
        for (size_t i = 0; i < 3 * n; ++i) {
            j->linear.pixels[i] = 0.5f + 0.5f * j->linear.pixels[i];
        }
    }
    if (j->o.show != SHOW_DEPTH) {
        return 1;
    }
    wide = malloc(3 * n * sizeof *wide);
    if (wide == NULL) {
        return report_fail(r, "not enough memory for the picture; try a smaller --size");
    }
    for (size_t i = 0; i < n; ++i) {
        far_m = fmaxf(far_m, j->linear.pixels[i]);
    }
    for (size_t i = 0; i < n; ++i) {
        float d = j->linear.pixels[i];
        wide[3 * i] = wide[3 * i + 1] = wide[3 * i + 2] = d > 0.0f ? 1.0f - 0.9f * d / far_m : 0.0f;
    }
    free(j->linear.pixels);
    j->linear.pixels = wide;
    j->linear.channels = 3;
    return 1;
}

/* PFM keeps one channel; a Radiance picture has three. */
static int depth_for_hdr(job *j, report *r)
{
    size_t n = (size_t)j->linear.width * (size_t)j->linear.height;
    float *wide = malloc(3 * n * sizeof *wide);
    if (wide == NULL) {
        return report_fail(r, "not enough memory for the picture; try a smaller --size");
    }
    for (size_t i = 0; i < n; ++i) {
        wide[3 * i] = wide[3 * i + 1] = wide[3 * i + 2] = j->linear.pixels[i];
    }
    free(j->linear.pixels);
    j->linear.pixels = wide;
    j->linear.channels = 3;
    return 1;
}

static double mean(const image *p)
{
    double sum = 0.0;
    size_t n = (size_t)p->width * (size_t)p->height * 3;
    for (size_t i = 0; i < n; ++i) {
        sum += (double)p->pixels[i];
    }
    return sum / (double)n;
}

/* --- reporting ------------------------------------------------------------------------------------------------------ */

static int write_stats(const job *j, report *r)
{
    static const char *const names[] = {"light_maps", "blockers", "first_points", "groups", "view", "bands"};
    char text[2048];
    int n = 0;
    const lmb_stats *s = &j->stats;
    double nodes = 0, asked = 0;
    for (int i = 0; i < j->crew.threads; ++i) {
        nodes += (double)j->crew.scratches[i].gather.cut.nodes;
        asked += (double)j->crew.scratches[i].gather.cut.asked;
    }
    fprintf(stderr, "NODES %g a tile, segments %g a pixel\n", nodes * 64 / (j->frame.view.frame_width * j->frame.view.frame_height), asked / (j->frame.view.frame_width * j->frame.view.frame_height));
    n += snprintf(text + n, sizeof text - (size_t)n,
                  "{\n  \"width\": %d, \"height\": %d,\n  \"seconds\": {\"load\": %.6f", (int)j->frame.view.frame_width,
                  (int)j->frame.view.frame_height, j->load_s);
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        n += snprintf(text + n, sizeof text - (size_t)n, ", \"%s\": %.6f", names[i], j->crew.stage_s[i]);
    }
    n += snprintf(text + n, sizeof text - (size_t)n, ", \"write\": %.6f, \"total\": %.6f},\n", j->write_s, j->total_s);
    n += snprintf(
        text + n, sizeof text - (size_t)n,
        "  \"scene_triangles\": %u, \"triangles_read\": %u, \"triangles_drawn\": %u, \"triangles_dropped\": %u,\n"
        "  \"lights\": %u, \"light_map\": %d, \"first_points\": %u, \"discs\": %u, \"groups\": %u, \"regroups\": %u,\n",
        (unsigned)lmb_scene_triangles(&j->scene), (unsigned)s->triangles, (unsigned)s->triangles_drawn,
        (unsigned)s->triangles_dropped, (unsigned)j->scene.light_count, (int)j->frame.light_map,
        (unsigned)s->first_points, (unsigned)s->discs, (unsigned)s->groups, (unsigned)s->regroups);
    n += snprintf(text + n, sizeof text - (size_t)n,
                  "  \"flux_lit_w\": %.9g, \"flux_grouped_w\": %.9g, \"energy_kept\": %.9g,\n"
                  "  \"bytes\": %.0f, \"model_bytes\": %.0f, \"loading_bytes\": %.0f,\n"
                  "  \"backend\": \"%s\"\n}\n",
                  s->flux_lit, s->flux_grouped, s->flux_lit > 0.0 ? s->flux_grouped / s->flux_lit : 1.0,
                  (double)j->bytes, (double)j->loaded.facts.memory_bytes, (double)j->loaded.facts.loading_bytes,
                  lmb_kernels_name(j->frame.kernels));
    return file_write(j->o.stats, text, (size_t)n, r);
}

static void tell_demo(const job *j)
{
    const char *name;
    lmb_render at = *j->render;
    printf("%s: %d x %d, %u triangles, %u groups\n", j->o.out, (int)j->frame.view.frame_width,
           (int)j->frame.view.frame_height, (unsigned)lmb_scene_triangles(&j->scene), (unsigned)j->stats.groups);
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        at.stage = i;
        lmb_render_progress(&name, &at);
        printf("  %-13s %8.1f ms\n", name, j->crew.stage_s[i] * 1e3);
    }
    printf("  %.1f %% of the light in the picture is indirect\n", j->indirect_share * 100.0);
}

/* How much of the picture's light has bounced: the same frame again, direct light only, which costs little. */
static int measure_share(job *j, report *r)
{
    double full = mean(&j->linear);
    image direct;
    lmb_render *render = malloc(sizeof *render);
    lmb_frame f = j->frame;
    size_t bytes = (size_t)j->linear.width * (size_t)j->linear.height * 3 * sizeof(float);
    direct = j->linear;
    direct.pixels = malloc(bytes);
    if (render == NULL || direct.pixels == NULL) {
        free(render);
        free(direct.pixels);
        return report_fail(r, "not enough memory for the picture; try a smaller --size");
    }
    f.show = LMB_SHOW_DIRECT;
    f.stats = NULL;
    lmb_surface_init(&f.out, LMB_RGB32F, direct.width, direct.height, direct.pixels, bytes);
    crew again = j->crew;
    int32_t stage;
    again.tell = NULL;
    lmb_status status = crew_render(&again, &stage, render, &f);
    j->indirect_share = full > 0.0 ? 1.0 - mean(&direct) / full : 0.0;
    free(render);
    free(direct.pixels);
    return status == LMB_OK || report_fail(r, "rendering stopped: %s", lmb_status_name(status));
}

static int save(job *j, report *r)
{
    float ev = j->o.exposure_ev;
    int linear = picture_is_linear(picture_format(j->o.out));
    if (j->o.show >= SHOW_DEPTH) {
        ev = 0.0f;
        if ((!linear && !attributes_for_display(j, r)) ||
            (j->o.show == SHOW_DEPTH && picture_format(j->o.out) == PICTURE_HDR && !depth_for_hdr(j, r))) {
            return 0;
        }
    } else if (j->o.exposure_auto && !linear) {
        ev = picture_auto_exposure(&j->linear) + 0.0f; /* no minus zero */
        fprintf(stderr, "lambent: exposure %+.3g EV (auto)\n", (double)ev);
    }
    return picture_write(j->o.out, &j->linear, ev, r);
}

static int run(job *j, report *r)
{
    double start = host_seconds();
    if (!file_can_write(j->o.out, r) || (j->o.stats != NULL && !file_can_write(j->o.stats, r)) || !load_scene(j, r)) {
        return 0;
    }
    j->load_s = host_seconds() - start;
    if (!set_frame(j, r) || !(j->o.show >= SHOW_DEPTH ? draw_attributes(j, r) : draw(j, r))) {
        return 0;
    }
    if (j->stats.triangles_dropped > 0) {
        fprintf(stderr, "lambent: note: %u triangles dropped: vertices not finite or over 2^20 m away\n",
                (unsigned)j->stats.triangles_dropped);
    }
    int demo = strcmp(j->o.scene, "demo") == 0 && j->o.show == LMB_SHOW_FULL;
    if (demo && !measure_share(j, r)) {
        return 0;
    }
    double before = host_seconds();
    if (!save(j, r)) {
        return 0;
    }
    j->write_s = host_seconds() - before;
    j->total_s = host_seconds() - start;
    if (j->o.stats != NULL && !write_stats(j, r)) {
        return 0;
    }
    if (demo) {
        tell_demo(j);
    }
    return 1;
}

int verb_render(int argc, char **argv)
{
    report r = {""};
    static job j; /* too large for a small stack: the options hold 64 lights */
    memset(&j, 0, sizeof j);
    if (!render_options_parse(&j.o, argc, argv, &r)) {
        fprintf(stderr, "lambent render: %s\n", r.text);
        return 2;
    }
    if (j.o.help) {
        fputs(render_usage, stdout);
        return 0;
    }
    if (picture_format(j.o.out) == PICTURE_UNKNOWN) {
        fprintf(stderr, "lambent render: %s: the name must end in .png, .ppm, .pfm or .hdr\n", j.o.out);
        return 2;
    }
    int ok = run(&j, &r);
    if (!ok) {
        fprintf(stderr, "lambent render: %s\n", r.text);
    }
    job_free(&j);
    return ok ? 0 : 1;
}
