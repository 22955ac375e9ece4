/* verb_mix.c: `lambent mix`: a virtual object in one photo with depth. */
#include "verb_mix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/progress.h"
#include "../picture/picture.h"
#include "../common/frame_name.h"
#include "mix_again.h"
#include "mix_frames.h"

static void tell_place(const mix_job *j)
{
    const double near = -(double)j->anchor.z;
    char gap[64] = "where no depth was measured"; /* NaN: no pixel of the foot has one */
    if (!isnan(j->gap_m)) {
        snprintf(gap, sizeof gap, "within %.1f mm of the measured depth", 1000.0 * fabs((double)j->gap_m));
    }
    if (j->floor < 0) {
        int32_t at[2] = {0, 0};
        const int is_near = mix_plane_near(at, j);
        report_note(j->o.is_quiet, "the object stands on no plane, %.2f m away, %s", near, gap);
        report_note(j->o.is_quiet || !is_near, "the nearest pixel where it would have one is --at %d,%d", (int)at[0],
                    (int)at[1]);
        return;
    }
    const lmb_flat *p = &j->planes.plane[j->floor];
    report_note(j->o.is_quiet,
                "%d planes; the object %s number %d, %.2f x %.2f m, %.2f m away, %s; --scale %.4g",
                (int)j->planes.count, j->hangs ? "hangs on" : "stands on", (int)j->floor + 1, (double)(p->high[0] - p->low[0]),
                (double)(p->high[1] - p->low[1]), near, gap, (double)j->scale);
    report_note(j->o.is_quiet || j->faces_up,
                "no plane faces up; that is the largest %s, it faces %.2f,%.2f,%.2f; --at X,Y names another, --show "
                "planes shows them",
                j->hangs ? "wall" : "plane",
                (double)p->normal.x, (double)p->normal.y, (double)p->normal.z);
}

/* Files in millimetres or inches, or of a house, fill the picture or vanish. */
static void tell_size(const mix_job *j)
{
    const double metres = (double)(mix_extent_of(j).longest * j->scale);
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height;
    const int fills = !(j->seen_px < 1.5f * (float)(w > h ? w : h)), vanishes = j->seen_px < 4.0f;
    if (fills || vanishes) {
        report_note(j->o.is_quiet, "the object is %.3g m long and %s; --fit chooses its size, --scale M sets it", metres,
                    fills ? "fills the picture" : "vanishes in the picture");
        return;
    }
    report_note(j->o.is_quiet || j->inside,
                "part of the object is off the picture; --at X,Y sets its place and --scale its size");
}

static void tell(const mix_job *j)
{
    for (uint32_t i = 0; i < j->notes.count; ++i) { /* those of options that only `render` has are none of ours */
        report_note(j->o.is_quiet || strstr(j->notes.line[i], "--glossy") != NULL ||
                        strstr(j->notes.line[i], "--grouping") != NULL,
                    "note: %s", j->notes.line[i]);
    }
    if (j->o.object == NULL || j->o.at == MIX_AT_WORLD || j->o.show == MIX_PLANES) { /* it was not put anywhere */
        return;
    }
    tell_place(j);
    tell_size(j);
}

static void tell_times(const mix_job *j)
{
    const struct stage {
        const char *name;
        double s;
    } stages[] = {{"reading", j->read_s}, {"planes", j->planes_s}, {"place", j->place_s},
                  {"light", j->light_s},  {"voxels", j->voxels_s}, {"picture", j->draw_s}};
    for (size_t i = 0; i < sizeof stages / sizeof *stages; ++i) {
        report_note(!j->o.is_verbose, "%-8s %8.1f ms", stages[i].name, stages[i].s * 1e3);
    }
}

static float exposure(const mix_job *j)
{
    if (!isnan(j->o.exposure_ev)) {
        return j->o.exposure_ev;
    }
    return j->frame.photo.codes.texels != NULL ? 0.0f : picture_auto_exposure(&j->frame.light, PICTURE_CLIPPED);
}

/* Seconds since *from, which becomes now. */
static double lap(double *from)
{
    const double now = host_seconds(), was = *from;
    *from = now;
    return now - was;
}

static int make_picture(mix_job *j, double *from, report *r)
{
    if (j->o.show == MIX_PLANES) {
        return mix_show_planes(j, r);
    }
    int ok = mix_place(j, r) && options_files(&j->o, &mix_table, r); /* with what the object's file has beside it */
    j->place_s = lap(from);
    ok = ok && mix_light(j, r);
    j->light_s = lap(from);
    if (j->o.show == MIX_ENV) {
        return ok && mix_show_env(j, r);
    }
    ok = ok && mix_voxels(j, r);
    j->voxels_s = lap(from);
    ok = ok && (j->o.show == MIX_VOXELS ? mix_show_voxels(j, r) : mix_draw(j, r));
    j->draw_s = lap(from);
    return ok;
}

static int write_stats(const mix_job *j, report *r)
{
    char text[1024], gap[32] = "null";
    const lmb_voxels *v = &j->voxels;
    if (!isnan(j->gap_m)) {
        snprintf(gap, sizeof gap, "%.6f", (double)j->gap_m);
    }
    const int n = snprintf(
        text, sizeof text,
        "{\n  \"planes\": %d,\n  \"stands_on\": %d,\n  \"faces_up\": %s,\n  \"in_picture\": %s,\n"
        "  \"scale\": %.6g,\n  \"gap_m\": %s,\n  \"noise_per_m\": %.6f,\n  \"voxels\": %u,\n"
        "  \"voxels_a_side\": %d,\n  \"leaf_m\": %.6f,\n  \"pool_bytes\": %.0f,\n  \"used_bytes\": %.0f,\n"
        "  \"read_s\": %.4f,\n  \"planes_s\": %.4f,\n  \"place_s\": %.4f,\n  \"light_s\": %.4f,\n"
        "  \"build_s\": %.4f,\n  \"voxels_s\": %.4f,\n  \"draw_s\": %.4f\n}\n",
        (int)j->planes.count, (int)j->floor + 1, j->faces_up ? "true" : "false", j->inside ? "true" : "false",
        (double)j->scale, gap, (double)j->cloud.noise, (unsigned)v->count,
        v->count > 0 ? 1 << v->depth : 0, (double)v->leaf, (double)lmb_voxels_bytes(v->cap, LMB_VOXELS_THREE),
        (double)lmb_voxels_bytes(v->count, LMB_VOXELS_THREE), j->read_s, j->planes_s, j->place_s, j->light_s,
        j->build_s, j->voxels_s, j->draw_s);
    return file_write(j->o.stats, text, (size_t)n, r);
}

static int mix(mix_job *j, report *r)
{
    double from = host_seconds();
    int ok = options_files(&j->o, &mix_table, r) && mix_frame_read(&j->frame, &j->o.source, r) &&
             options_files(&j->o, &mix_table, r);
    j->read_s = lap(&from);
    ok = ok && mix_find_planes(j, r);
    j->planes_s = lap(&from);
    if (!ok || !make_picture(j, &from, r)) {
        return 0;
    }
    tell(j);
    tell_times(j);
    return picture_write(j->o.out, &j->picture, exposure(j), PICTURE_CLIPPED, r) && (j->o.stats == NULL || write_stats(j, r));
}

/* --- sequences ---------------------------------------------------------------------------------------------------- */

static int read_entry(mix_job *j, const mix_entry *e, report *r)
{
    mix_source *s = &j->o.source;
    if (e->prefix[0] != '\0') {
        s->frame = e->prefix;
        return mix_frame_read(&j->frame, s, r);
    }
    s->photo = e->photo;
    s->depth = e->depth;
    s->depth_scale = s->depth_scale > 0.0f ? s->depth_scale : 0.0002f;
    if (!s->has_intrinsics) {
        return report_fail(r, "no camera given; add --intrinsics FX,FY,CX,CY");
    }
    if (!e->has_pose || !mix_is_pose(e->pose)) {
        return report_fail(r, "has no pose");
    }
    if (!mix_frame_read(&j->frame, s, r)) {
        return 0;
    }
    j->frame.has_pose = 1;
    memcpy(j->frame.pose, e->pose, sizeof j->frame.pose);
    return 1;
}

/* The last frame's answer to this one's photo. */
static int mix_still(mix_job *j, mix_job *last, double *from, int32_t number, report *r)
{
    char name[4200];
    const mix_frame was = last->frame;
    last->frame = j->frame;
    j->frame = was;
    mix_again_draw(last);
    j->draw_s = lap(from);
    tell_times(j);
    return frame_name(name, sizeof name, j->o.out, number, r) &&
           picture_write(name, &last->picture, exposure(last), PICTURE_CLIPPED, r);
}

/* One frame: its picture is written, and what later frames need is kept; of a frame that is drawn anew that is *job. */
static int mix_one(mix_job **job, mix_kept *k, const mix_entry *e, int32_t number, report *r)
{
    char name[4200];
    mix_job *j = *job;
    double from = host_seconds();
    j->kept = k;
    if (!read_entry(j, e, r)) {
        return 0;
    }
    if (k->frames > 0 && k->has_pose != j->frame.has_pose) {
        return report_fail(r, j->frame.has_pose ? "has a pose, and those before it have none" : "has no pose");
    }
    j->read_s = lap(&from);
    lmb_pinhole_round(&j->frame.camera);
    if (!mix_keep_depth(k, &j->frame, r)) {
        return 0;
    }
    const double bright = mix_brightness(&j->frame);
    if (mix_is_still(k, bright)) {
        return mix_still(j, k->last, &from, number, r);
    }
    if (!mix_find_planes(j, r)) {
        return 0;
    }
    j->planes_s = lap(&from);
    if (!make_picture(j, &from, r) || !frame_name(name, sizeof name, j->o.out, number, r) ||
        !picture_write(name, &j->picture, exposure(j), PICTURE_CLIPPED, r)) {
        return 0;
    }
    if (k->frames == 0) {
        tell(j);
    }
    tell_times(j);
    if (j->o.object != NULL && !mix_keep(k, j, r)) {
        return 0;
    }
    *job = k->last; /* which nobody needs any more */
    k->last = j;
    k->bright = bright;
    k->changed = 0;
    return 1;
}

/* A frame that cannot be used is said and left out; the others go on as if it had not been listed. */
static int mix_frames(const mix_options *o, report *r)
{
    mix_list list;
    mix_kept kept;
    int32_t done = 0;
    memset(&kept, 0, sizeof kept);
    if (!mix_list_read(&list, o->frames, r)) {
        return 0;
    }
    for (int32_t i = 0; i < list.count; ++i) {
        report one = {""};
        mix_job *j = calloc(1, sizeof *j);
        if (j == NULL) {
            break;
        }
        j->o = *o;
        const int ok = mix_one(&j, &kept, &list.entry[i], i, &one);
        done += ok;
        if (!ok) {
            report_note(o->is_quiet, "frame %d is left out: %s", (int)i, one.text);
        }
        if (j != NULL) {
            mix_job_free(j);
        }
        progress_tell("frames", (double)(i + 1) / (double)list.count);
    }
    mix_kept_free(&kept);
    mix_list_free(&list);
    return done > 0 || report_fail(r, "%s: no frame could be used", o->frames);
}

int verb_mix(int argc, char **argv)
{
    report r = {""};
    mix_job *j = calloc(1, sizeof *j);
    if (j == NULL) {
        report_fail(&r, "out of memory");
        return report_end(&r, "mix", 1);
    }
    const int asked = mix_options_parse(&j->o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        free(j);
        return options_answer(asked, &mix_table, &r);
    }
    progress_begin(j->o.is_quiet, "mix");
    const int ok = j->o.frames != NULL ? mix_frames(&j->o, &r) : mix(j, &r);
    progress_end();
    mix_job_free(j);
    return ok ? 0 : report_end(&r, "mix", 1);
}
