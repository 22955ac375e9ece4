/* render_draw.c: draws the picture that the options show. */
#include "render_draw.h"

#include <math.h>
#include <string.h>

#include "../common/progress.h"
#include "../picture/picture.h"
#include "map_picture.h"
#include "wireframe.h"

/* Explains why a frame stopped. Memory is allocated here, so there are few reasons. */
static int explain(const render_job *j, lmb_status status, int stage, report *r)
{
    if (status == LMB_ERR_CAPACITY && stage == LMB_STAGE_GROUPS) {
        return report_fail(r,
                           "--group method=none: %u discs do not fit %d groups; use a smaller --shadow-map, or zones",
                           (unsigned)j->stats.first_points, LMB_MAX_GROUPS);
    }
    if (status == LMB_ERR_ARG) {
        return report_fail(r, "%s: cannot be drawn; is the view or a light over 1048576 m from the origin?",
                           j->o.scene);
    }
    if (status == LMB_ERR_CAPACITY && j->o.sorted) {
        return report_fail(r, "--blend sorted: not enough memory for the layers; try a smaller --size");
    }
    return report_fail(r, "%s: rendering stopped: %s", j->o.scene, lmb_status_name(status));
}

static void watch(void *user, const lmb_render *at)
{
    const char *name;
    const float part = lmb_render_progress(&name, at);
    (void)user;
    progress_tell(name, (double)part);
}

/* Draws the frame `how` for all eyes; the light stages run once. */
static lmb_status draw_eyes(render_job *j, workers *c, int32_t *stage, lmb_frame how, const image *into)
{
    lmb_status status = LMB_OK;
    for (int32_t eye = 0; eye < j->eyes && status == LMB_OK; ++eye) {
        render_job_eye(j, &how, into, eye);
        status = j->lit ? workers_again(c, stage, j->render, &how) : workers_render(c, stage, j->render, &how);
        j->lit = 1;
        if (status == LMB_OK && j->o.sorted && blended_is_any(&j->scene)) {
            status = blended_draw(&j->blended, c, stage, j->render, &how, into->width, into->height,
                                  eye * j->o.view.width);
        }
    }
    return status;
}

static int draw(render_job *j, report *r)
{
    int32_t stage;
    j->workers.tell = watch;
    lmb_status status = draw_eyes(j, &j->workers, &stage, j->frame, &j->linear);
    return status == LMB_OK || explain(j, status, stage, r);
}

/* Elements use one occlusion test to send light. */
int render_draw_once_more(render_job *j, image *out, lmb_frame how, report *r)
{
    workers again = j->workers;
    int32_t stage;
    again.tell = NULL;
    how.stats = NULL;
    j->lit = how.elements.data == NULL || how.occlusion == j->frame.occlusion;
    if (!render_job_picture(j, out, r)) {
        return 0;
    }
    lmb_status status = draw_eyes(j, &again, &stage, how, out);
    return status == LMB_OK || explain(j, status, stage, r);
}

/* The share of the light that is blocked: 1 - with / without, over the sum of the channels. */
static int draw_occlusion(render_job *j, report *r)
{
    image open = {0, 0, 0, NULL};
    lmb_frame f = j->frame;
    const size_t n = (size_t)j->linear.width * (size_t)j->linear.height;
    float *p = j->linear.pixels;
    f.occlusion = LMB_OCCLUSION_NONE;
    if (!draw(j, r) || !render_draw_once_more(j, &open, f, r)) {
        image_free(&open);
        return 0;
    }
    for (size_t i = 0; i < n; ++i) {
        const float *all = open.pixels + 3 * i;
        const float with = p[3 * i] + p[3 * i + 1] + p[3 * i + 2], without = all[0] + all[1] + all[2];
        p[i] = without > 0.0f ? fminf(fmaxf(1.0f - with / without, 0.0f), 1.0f) : 0.0f;
    }
    j->linear.channels = 1;
    image_free(&open);
    return 1;
}

/* Runs the light stages as far as needed, and shows them instead of the view. */
static int draw_map(render_job *j, report *r)
{
    const int display = !picture_is_linear(picture_format(j->o.out));
    const int32_t past = j->o.show == SHOW_GROUPS   ? LMB_STAGE_VIEW
                         : j->o.show == SHOW_POINTS ? LMB_STAGE_GROUPS
                                                    : LMB_STAGE_POINTS;
    int32_t stage;
    lmb_status status = workers_light(&j->workers, &stage, j->render, &j->frame, past);
    if (status != LMB_OK) {
        return explain(j, status, stage, r);
    }
    image_free(&j->linear);
    return j->o.show == SHOW_GROUPS   ? map_groups(&j->linear, j->render, display, r)
           : j->o.show == SHOW_POINTS ? map_points(&j->linear, j->render, display, r)
                                      : map_distances(&j->linear, j->render, r);
}

/* Attributes of one eye's view instead of light: draws only the view. */
static lmb_status draw_attribute(render_job *j)
{
    lmb_frame *f = &j->frame;
    const lmb_surface *depth = f->out.format == LMB_R32F ? &f->out : NULL;
    const lmb_surface *normal = j->o.show == SHOW_NORMAL ? &f->out : NULL;
    const lmb_surface *albedo = j->o.show == SHOW_ALBEDO ? &f->out : NULL;
    lmb_surface_clear(&f->eye.depth);
    lmb_surface_clear(&f->eye.id);
    lmb_status status =
        lmb_draw(&f->eye, f->kernels, &f->view, &j->scene, 1, UINT32_MAX - 1, LMB_CULL_BACK | LMB_BLEND, &j->stats);
    if (j->o.show == SHOW_WIREFRAME) {
        return status != LMB_OK ? status : wireframe_draw(j);
    }
    for (int32_t band = 0; status == LMB_OK && band < (f->view.frame_height + 7) / 8; ++band) {
        status =
            lmb_gbuffer_band(depth, normal, albedo, f->kernels, &f->scratch->tile, &f->view, &j->scene, &f->eye, band);
    }
    if (j->o.show == SHOW_EYE_DISTANCE) {
        distance_of_depth(f->out.data, f->out.width, f->out.height, (size_t)j->linear.width, &f->view);
    }
    return status;
}

static int draw_attributes(render_job *j, report *r)
{
    lmb_status status = LMB_OK;
    j->linear.channels = j->o.show == SHOW_DEPTH || j->o.show == SHOW_EYE_DISTANCE ? 1 : 3;
    for (int32_t eye = 0; eye < j->eyes && status == LMB_OK; ++eye) {
        render_job_eye(j, &j->frame, &j->linear, eye);
        status = draw_attribute(j);
    }
    return status == LMB_OK || report_fail(r, "%s: drawing stopped: %s", j->o.scene, lmb_status_name(status));
}

int render_draw(render_job *j, report *r)
{
    return shows_attribute(j->o.show)    ? draw_attributes(j, r)
           : shows_map(j->o.show)        ? draw_map(j, r)
           : j->o.show == SHOW_OCCLUSION ? draw_occlusion(j, r)
                                         : draw(j, r);
}
