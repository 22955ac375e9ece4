/* render.c: runs the stages in order: the whole frame, or one bounded step at a time. Layer 8. [V33 V34] */
#include "../base/vec.h"
#include "stages.h"
#include "requires.h"

int32_t lmb_render_has_parts(const lmb_render *r)
{
    if (r == NULL || r->frame.scene == NULL || r->failed != LMB_OK) {
        return 0;
    }
    switch (r->stage) {
    case LMB_STAGE_SHADOW_MAP:
    case LMB_STAGE_POINTS:
    case LMB_STAGE_BOUNCES:
        return lmb_render_solve_has_parts(r);
    case LMB_STAGE_VIEW:
        return r->progress == 0 && !reuses(r, LMB_REUSE_VIEW);
    case LMB_STAGE_SAMPLES:
        return r->progress == 0 && is_whole(&r->frame.eye.depth, &r->frame.view);
    default:
        return 0;
    }
}

lmb_status lmb_render_part(const lmb_render *r, lmb_band_scratch *scratch, int32_t part, int32_t parts,
                           lmb_stats *stats)
{
    if (!lmb_render_has_parts(r) || scratch == NULL || part < 0 || part >= parts || parts > 65535 ||
        lacks_live(&r->frame, scratch)) {
        return LMB_ERR_ARG;
    }
    return r->stage == LMB_STAGE_VIEW      ? lmb_render_view_part(r, part, parts, stats)
           : r->stage == LMB_STAGE_SAMPLES ? lmb_render_samples_part(r, scratch, part, parts, stats)
                                           : lmb_render_solve_part(r, scratch, part, parts, stats);
}

/* Ends the stage, after success or failure. */
static lmb_status end_stage(lmb_render *r, lmb_status status)
{
    if (status < 0) {
        r->stage = LMB_STAGE_DONE;
        r->failed = status;
        return status;
    }
    if (status == LMB_OK) {
        r->stage += r->stage == LMB_STAGE_VIEW && !requires_samples(r) ? 2 : 1;
        r->light = r->face = r->progress = 0;
    }
    return r->stage == LMB_STAGE_DONE ? LMB_OK : LMB_MORE;
}

lmb_status lmb_render_parts_done(lmb_render *r, int32_t parts)
{
    if (!lmb_render_has_parts(r) || parts < 1) {
        return LMB_ERR_ARG;
    }
    return end_stage(r, r->stage == LMB_STAGE_SAMPLES ? lmb_render_samples_on(r) : lmb_render_solve_on(r, parts));
}

lmb_status lmb_render_step(lmb_render *r, int32_t units)
{
    if (r == NULL || r->frame.scene == NULL) {
        return LMB_ERR_ARG;
    }
    if (r->failed != LMB_OK) {
        return r->failed;
    }
    units = mini(maxi(units, 1), 1 << 20);
    switch (r->stage) {
    case LMB_STAGE_SHADOW_MAP:
    case LMB_STAGE_BVH:
    case LMB_STAGE_POINTS:
    case LMB_STAGE_GROUPS:
    case LMB_STAGE_BOUNCES:
        return end_stage(r, lmb_render_solve(r, units));
    case LMB_STAGE_VIEW:
        return end_stage(r, lmb_render_view(r, units));
    case LMB_STAGE_SAMPLES:
        return end_stage(r, lmb_render_samples(r, units));
    case LMB_STAGE_BANDS:
        return end_stage(r, lmb_render_bands(r, units));
    default:
        return LMB_OK;
    }
}

lmb_status lmb_render_frame(lmb_render *r, const lmb_frame *frame)
{
    lmb_status status = lmb_render_begin(r, frame);
    if (status == LMB_OK) {
        do {
            status = lmb_render_step(r, 64);
        } while (status == LMB_MORE);
    }
    return status;
}

float lmb_render_progress(const char **name, const lmb_render *r)
{
    static const char *const names[] = {"shadow maps", "BVH",  "first points", "groups",
                                        "bounces",     "view", "samples",      "bands", "done"};
    const int is_over = r == NULL || r->frame.scene == NULL || r->stage < 0 || r->stage > LMB_STAGE_DONE;
    if (name != NULL) {
        *name = names[is_over ? LMB_STAGE_DONE : r->stage];
    }
    if (is_over) {
        return 1.0f;
    }
    float lights = maxf((float)r->frame.scene->light_count, 1.0f), triangles = maxf((float)r->triangles, 1.0f),
          done = 0.0f;
    switch (r->stage) {
    case LMB_STAGE_SHADOW_MAP:
        done = ((float)r->light + (float)r->progress / triangles) / lights;
        break;
    case LMB_STAGE_POINTS:
        done = (float)r->light / lights;
        break;
    case LMB_STAGE_BOUNCES:
        done = lmb_render_solve_done(r);
        break;
    case LMB_STAGE_VIEW:
        done = (float)r->progress / triangles;
        break;
    case LMB_STAGE_SAMPLES:
        done = (float)r->light / 8.0f;
        break;
    case LMB_STAGE_BANDS:
        done = (float)r->progress / (float)band_count(&r->frame.view);
        break;
    case LMB_STAGE_DONE:
        done = 1.0f;
        break;
    default:
        break;
    }
    return minf(done, 1.0f);
}
