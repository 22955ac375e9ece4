/* mix_run.c: steps shared by one photo and a sequence of them: the picture, and notes about it. */
#include "mix_run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../picture/picture.h"
#include "mix_frames.h"

static void tell_place(const mix_job *j)
{
    const double near = -(double)j->anchor.z;
    char gap[64] = "where no depth was measured"; /* NaN: no pixel of the foot has a depth */
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
    report_note(j->o.is_quiet, "%d planes; the object %s number %d, %.2f x %.2f m, %.2f m away, %s; --scale %.4g",
                (int)j->planes.count, j->hangs ? "hangs on" : "stands on", (int)j->floor + 1,
                (double)(p->high[0] - p->low[0]), (double)(p->high[1] - p->low[1]), near, gap, (double)j->scale);
    report_note(j->o.is_quiet || j->faces_up,
                "no plane faces up; that is the largest %s, it faces %.2f,%.2f,%.2f; --at X,Y names another, --show "
                "planes shows them",
                j->hangs ? "wall" : "plane",
                (double)p->normal.x, (double)p->normal.y, (double)p->normal.z);
}

/* A file in millimetres or inches, or a whole building, would fill the picture or vanish. */
static void tell_size(const mix_job *j)
{
    const double metres = (double)(mix_extent_of(j).longest * j->scale);
    const int32_t w = j->frame.camera.width, h = j->frame.camera.height;
    const int fills = !(j->seen_px < 1.5f * (float)(w > h ? w : h)), vanishes = j->seen_px < 4.0f;
    if (!j->o.fit && (fills || vanishes)) {
        report_note(j->o.is_quiet, "the object is %.3g m long and %s; --fit chooses its size, --scale M sets it",
                    metres, fills ? "fills the picture" : "vanishes in the picture");
        return;
    }
    report_note(j->o.is_quiet || j->inside,
                "part of the object is off the picture; --at X,Y sets its place and --scale its size");
}

/* Prints notes about the object, before the long work. */
static void tell_object(const mix_job *j)
{
    if (j->o.object == NULL) {
        return;
    }
    model_tell(&j->notes, j->o.object, MODEL_NOTE_OPTION);
    if (j->o.at != MIX_AT_WORLD) { /* it was placed */
        tell_place(j);
        tell_size(j);
    }
}

void mix_tell_times(const mix_job *j)
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

float mix_exposure(const mix_job *j)
{
    if (!isnan(j->o.exposure_ev)) {
        return j->o.exposure_ev;
    }
    return j->frame.photo.codes.texels != NULL ? 0.0f : picture_auto_exposure(&j->frame.light, PICTURE_CLIPPED);
}

double mix_lap(double *from)
{
    const double now = host_seconds(), was = *from;
    *from = now;
    return now - was;
}

int mix_make_picture(mix_job *j, double *from, report *r)
{
    if (j->o.show == MIX_PLANES) {
        return mix_show_planes(j, r);
    }
    int ok = mix_place(j, r) && options_files(&j->o, &mix_table, r); /* with files that the object refers to */
    j->place_s = mix_lap(from);
    ok = ok && mix_light(j, r);
    j->light_s = mix_lap(from);
    if (ok && (j->kept == NULL || j->kept->frames == 0)) {
        tell_object(j);
        report_print_notes();
    }
    if (j->o.show == MIX_ENV) {
        return ok && mix_show_env(j, r);
    }
    ok = ok && mix_voxels(j, r);
    j->voxels_s = mix_lap(from);
    ok = ok && (j->o.show == MIX_VOXELS ? mix_show_voxels(j, r) : mix_draw(j, r));
    j->draw_s = mix_lap(from);
    return ok;
}
