/* verb_mix.c: `lambent mix`: a virtual object in one photo with depth. */
#include "verb_mix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../common/progress.h"
#include "../picture/picture.h"
#include "mix_labels.h"
#include "mix_run.h"

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
    j->read_s = mix_lap(&from);
    ok = ok && mix_find_planes(j, r);
    j->planes_s = mix_lap(&from);
    if (!ok || !mix_make_picture(j, &from, r)) {
        return 0;
    }
    mix_tell_times(j);
    const float exposure_ev = mix_exposure(j);
    return picture_write(j->o.out, &j->picture, exposure_ev, PICTURE_CLIPPED, r) &&
           mix_labels_write(j, exposure_ev, r) && (j->o.stats == NULL || write_stats(j, r));
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
#if !defined(OPTIONS_WITHOUT_HELP)
    const int ok = j->o.frames != NULL       ? mix_frames(&j->o, &r)
                   : j->o.placements != NULL || j->o.objects > 1 ? mix_placements(j, &r)
                                             : mix(j, &r);
#else
    const int ok = j->o.frames != NULL ? mix_frames(&j->o, &r) : mix(j, &r);
#endif
    progress_end();
    mix_job_free(j);
    return ok ? 0 : report_end(&r, "mix", 1);
}
