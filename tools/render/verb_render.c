/* verb_render.c: `lambent render`: a scene in, a picture with bounced light out. */
#include "verb_render.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../picture/grey.h"
#include "../picture/picture.h"
#include "background.h"
#include "budget.h"
#include "render_draw.h"
#include "render_finish.h"
#include "render_slice.h"
#include "render_verb.h"

/* Maps attributes to display range. Reflectance, points and groups are in 0 .. 1 already. */
static void grey_for_display(render_job *j)
{
    float near_m, far_m;
    switch (j->o.show) {
    case SHOW_DEPTH: grey_depths(&j->linear); break;
    case SHOW_EYE_DISTANCE:
    case SHOW_LIGHT_DISTANCE:
        grey_distances(&j->linear, &near_m, &far_m);
        report_note(j->o.view.is_quiet || !(far_m > 0.0f), "from %.4g m (white) to %.4g m (dark grey)", (double)near_m,
                    (double)far_m);
        break;
    case SHOW_OCCLUSION: grey_shares(&j->linear); break;
    case SHOW_NORMAL: grey_normals(&j->linear); break;
    default: break;
    }
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

/* --- reporting ---------------------------------------------------------------------------------------------------- */

/* Nodes of the light tree used by pixels, and shadow tests, summed over all threads. */
typedef struct asked_lights {
    double nodes, tests;
} asked_lights;

static asked_lights sum_asked(const render_job *j)
{
    asked_lights sum = {0.0, 0.0};
    for (int i = 0; i < j->workers.threads && j->many_lights.tree.lights > 0; ++i) {
        sum.nodes += (double)j->workers.scratches[i].many_lights.nodes;
        sum.tests += (double)j->workers.scratches[i].many_lights.tests;
    }
    return sum;
}

/* A count of fixed groups. Light by cuts has none, so prints null instead of 0. */
static const char *count_text(char out[32], const render_job *j, double count)
{
    snprintf(out, 32, j->frame.points.data != NULL ? "%.9g" : "null", count);
    return out;
}

static int write_stats(const render_job *j, report *r)
{
    char points[32], discs[32], groups[32], regroups[32], lit_w[32], grouped_w[32], kept[32];
    static const char *const names[] = {"shadow_maps", "BVH", "first_points", "groups",
                                        "bounces",    "view",     "samples", "bands"};
    char text[2048];
    int n = 0;
    const lmb_stats *s = &j->stats;
    const asked_lights lit = sum_asked(j);
    n += snprintf(text + n, sizeof text - (size_t)n,
                  "{\n  \"width\": %d, \"height\": %d, \"views\": %d,\n  \"seconds\": {\"load\": %.6f",
                  (int)j->linear.width, (int)j->linear.height, (int)j->eyes, j->load_s);
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        n += snprintf(text + n, sizeof text - (size_t)n, ", \"%s\": %.6f", names[i], j->workers.stage_s[i]);
    }
    n += snprintf(text + n, sizeof text - (size_t)n, ", \"write\": %.6f, \"total\": %.6f},\n", j->write_s, j->total_s);
    n += snprintf(
        text + n, sizeof text - (size_t)n,
        "  \"scene_triangles\": %u, \"triangles_read\": %u, \"triangles_drawn\": %u, \"triangles_dropped\": %u,\n"
        "  \"lights\": %u, \"shadow_map\": %d, \"first_points\": %s, \"discs\": %s, \"groups\": %s, \"regroups\": %s,\n"
        "  \"pairs\": %.0f, \"segments\": %.0f, \"full_cuts\": %.0f, \"tiles\": %.0f, \"coarse_tiles\": %.0f,\n"
        "  \"corner_segments\": %.0f, \"elements\": %u, \"element_m\": %.6g,\n",
        (unsigned)lmb_scene_triangles(&j->scene), (unsigned)s->triangles, (unsigned)s->triangles_drawn,
        (unsigned)s->triangles_dropped, (unsigned)j->scene.light_count, (int)j->frame.shadow_map,
        count_text(points, j, s->first_points), count_text(discs, j, s->discs), count_text(groups, j, s->groups),
        count_text(regroups, j, s->regroups), (double)s->pairs, (double)s->segments, (double)s->full_cuts,
        (double)s->tiles, (double)s->coarse_tiles, (double)s->corner_segments,
        (unsigned)j->render->frame.elements.count,
        (double)j->render->frame.elements.side);
    n += snprintf(text + n, sizeof text - (size_t)n,
                  "  \"flux_lit_w\": %s, \"flux_grouped_w\": %s, \"energy_kept\": %s,\n"
                  "  \"many_lights\": %u, \"light_cells\": %u, \"light_nodes\": %.0f, \"shadow_tests\": %.0f,\n"
                  "  \"light_stream_s\": %.6f, \"light_tree_s\": %.6f,\n"
                  "  \"bytes\": %.0f, \"model_bytes\": %.0f, \"loading_bytes\": %.0f,\n"
                  "  \"backend\": \"%s\"\n}\n",
                  count_text(lit_w, j, s->flux_lit), count_text(grouped_w, j, s->flux_grouped),
                  count_text(kept, j, s->flux_lit > 0.0 ? s->flux_grouped / s->flux_lit : 1.0),
                  (unsigned)j->many_lights.tree.lights, (unsigned)j->many_lights.tree.cell_count, lit.nodes, lit.tests,
                  j->many_lights.stream_s, j->many_lights.build_s,
                  (double)(j->bytes + j->many_lights.bytes), (double)j->loaded.facts.memory_bytes,
                  (double)j->loaded.facts.loading_bytes, lmb_kernels_name(j->frame.kernels));
    return file_write(j->o.stats, text, (size_t)n, r);
}

static const char *stage_name(const render_job *j, int stage)
{
    const char *name;
    lmb_render at = *j->render;
    at.stage = stage;
    lmb_render_progress(&name, &at);
    return name;
}

/* --verbose: prints settings and times. */
static void tell_how(const render_job *j)
{
    const lmb_frame *f = &j->frame;
    if (!j->o.view.is_verbose) {
        return;
    }
    report_note(0, "%d threads of %s lanes; --gather %s --shadow-map %d --tree %d --error %.3g --visibility %.3g; "
                   "%.0f KiB",
                j->workers.threads, lmb_kernels_name(f->kernels),
                f->gather_step == LMB_GATHER_LIVE ? "live" : "full",
                (int)f->shadow_map, (int)f->tree.size, (double)f->error, (double)f->visibility,
                (double)(j->bytes + j->many_lights.bytes) / 1024.0);
    report_note(0, "%-13s %8.1f ms", "reading", j->load_s * 1e3);
    for (int i = 0; i < LMB_STAGE_DONE; ++i) {
        report_note(0, "%-13s %8.1f ms", stage_name(j, i), j->workers.stage_s[i] * 1e3);
    }
    report_note(0, "%-13s %8.1f ms", "writing", j->write_s * 1e3);
}

static void tell_demo(const render_job *j)
{
    report_say("%s: %d x %d, %u triangles", j->o.out, (int)j->linear.width, (int)j->linear.height,
           (unsigned)lmb_scene_triangles(&j->scene));
    if (j->stats.groups > 0) {
        report_say(", %u groups", (unsigned)j->stats.groups);
    }
    report_say("\n");
    for (int i = 0; i < LMB_STAGE_DONE && !j->o.view.is_verbose; ++i) { /* --verbose has printed them */
        report_say("  %-13s %8.1f ms\n", stage_name(j, i), j->workers.stage_s[i] * 1e3);
    }
    report_say("  %.1f %% of the light in the picture is indirect\n", j->indirect_share * 100.0);
}

/* Measures the share of bounced light: draws the frame again with direct light only, which is cheap. */
static int measure_share(render_job *j, report *r)
{
    const double full = mean(&j->linear);
    image direct = {0, 0, 0, NULL};
    lmb_frame f = j->frame;
    f.show = LMB_SHOW_DIRECT;
    const int ok = render_draw_once_more(j, &direct, f, r);
    j->indirect_share = ok && full > 0.0 ? 1.0 - mean(&direct) / full : 0.0;
    image_free(&direct);
    return ok;
}

/* Writes an image that shows no light. */
static int save_other(render_job *j, report *r)
{
    const int linear = picture_is_linear(picture_format(j->o.out));
    if (!linear) {
        grey_for_display(j);
    }
    return (j->linear.channels != 1 || picture_format(j->o.out) == PICTURE_PFM || image_widen(&j->linear, r)) &&
           picture_write(j->o.out, &j->linear, 0.0f, PICTURE_CLIPPED, r);
}

static int save(render_job *j, report *r)
{
    render_finish f;
    if (j->o.show >= SHOW_DEPTH) {
        return save_other(j, r);
    }
    const int ok = finish_begin(&f, j, r) && (j->o.slice.count > 0
                                                  ? render_slice_write(j, &f, r)
                                                  : finish_write(&f, j->o.out, &j->linear, j->o.view.is_quiet, r));
    finish_free(&f);
    return ok;
}

/* Strict zones: prints the loss [V20]. */
static void tell_loss(const render_job *j)
{
    const double lost = j->stats.flux_lit - j->stats.flux_grouped;
    if ((j->frame.grouping.flags & LMB_ZONES_STRICT) && j->stats.groups > 0) {
        report_note(j->o.view.is_quiet, "note: --group misfits=drop lost %.3g %% of the light that bounces",
                    j->stats.flux_lit > 0.0 ? fmax(lost, 0.0) / j->stats.flux_lit * 100.0 : 0.0);
    }
}

/* Prints a note if more groups were needed than allowed [V21]. */
static void tell_regroups(const render_job *j)
{
    if (j->stats.regroups > 0) {
        report_note(j->o.view.is_quiet,
                    "note: discs were grouped again %u time%s, each coarser, until --group groups was enough: %u",
                    (unsigned)j->stats.regroups, j->stats.regroups == 1 ? "" : "s", (unsigned)j->stats.groups);
    }
}

/* Prints a note on pixels with cuts too small for the error limit. */
static void tell_full_cuts(const render_job *j)
{
    if (LMB_LIVE && j->stats.full_cuts > 0 && j->frame.gather_step == LMB_GATHER_LIVE) {
        report_note(!j->o.view.is_verbose,
                    "note: at %.0f points near lit surfaces, some of the light comes from larger parts than elsewhere "
                    "(LMB_LIVE_CUT, LMB_LIVE_NEAR); --gather full has no such limit",
                    (double)j->stats.full_cuts);
    } else if (j->stats.full_cuts > 0) {
        report_note(j->o.view.is_quiet,
                    "note: %.0f pixel clusters have coarser bounced light than asked for: %d nodes of the light's "
                    "tree were not enough (LMB_MAX_CUT); a smaller --tree or a larger --error asks for less",
                    (double)j->stats.full_cuts, LMB_MAX_CUT);
    }
}

/* Prints a note on pixels with too many layers. */
static void tell_layers(const render_job *j)
{
    const uint32_t over = blended_over(&j->blended);
    report_note(j->o.view.is_quiet || over == 0, "note: --blend sorted: %u pixels show more than %d layers; the "
                "farthest are left out", (unsigned)over, (int)BLENDED_MAX_LAYERS);
}

/* 1 if a sample of an eye shows a surface, or if memory is short. */
static int shows_surface(const render_job *j)
{
    report unused = {""};
    float *cover = background_cover(j, &unused);
    int any = cover == NULL;
    for (size_t i = 0; i < (size_t)j->linear.width * (size_t)j->linear.height && !any; ++i) {
        any = cover[i] > 0.0f;
    }
    free(cover);
    return any;
}

/* Prints a note if no sample shows a surface: the picture is only background. */
static void tell_nothing(const render_job *j)
{
    const lmb_surface *eye = &j->frame.eye.depth;
    const size_t n = (size_t)eye->width * (size_t)eye->height;
    const int shows_view = j->o.show <= LMB_SHOW_IRRADIANCE || j->o.show == SHOW_DEPTH || j->o.show == SHOW_ALBEDO ||
                           j->o.show == SHOW_NORMAL || j->o.show == SHOW_WIREFRAME || j->o.show == SHOW_EYE_DISTANCE;
    if (j->o.view.is_quiet || !shows_view || j->o.slice.count > 0 || j->o.sorted) {
        return;
    }
    float *depth = malloc(n * sizeof *depth);
    int any = depth == NULL || lmb_depth_linearize(depth, n * sizeof *depth, eye) != LMB_OK;
    for (size_t i = 0; i < n && !any; ++i) {
        any = depth[i] > 0.0f;
    }
    free(depth);
    report_note(any || shows_surface(j), "note: no surface is in the picture; --eye and --target set the view");
}

static int run(render_job *j, report *r)
{
    double start = host_seconds();
    j->o.has_sky = 1;
    if (!options_files(&j->o, &render_table, r) || !render_job_load(j, r) || !options_files(&j->o, &render_table, r)) {
        return 0;
    }
    j->load_s = host_seconds() - start;
    j->workers.slice = j->o.slice;
    budget_choice choice;
    if (!render_job_set(j, r) || (has_budget(&j->o.budget, j->o.budget_ms) && !budget_fit(&choice, j, r)) ||
        !render_draw(j, r)) {
        return 0;
    }
    report_note(j->o.view.is_quiet || j->o.slice.count == 0 ||
                    j->frame.gather_step != LMB_GATHER_LIVE,
                "note: --gather live takes its samples from the whole picture in every slice; full is "
                "shared");
    tell_loss(j);
    tell_regroups(j);
    tell_full_cuts(j);
    tell_layers(j);
    tell_nothing(j);
    render_tell_coarse(j->o.view.is_quiet, &j->stats);
    render_tell_dropped(j->o.view.is_quiet, &j->scene, &j->stats);
    const int demo = strcmp(j->o.scene, "demo") == 0 && j->o.show == LMB_SHOW_FULL && !j->o.view.is_quiet &&
                     j->o.slice.count == 0;
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
    tell_how(j);
    if (demo) {
        tell_demo(j);
    }
    return 1;
}

int verb_render(int argc, char **argv) { return render_verb(&render_table, argc, argv, run); }
