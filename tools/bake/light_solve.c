/* light_solve.c: the bounced light of a scene from a transfer, at any surface point. */
#include "light_solve.h"

#include <string.h>

#include "../model/io_lmt.h"

int light_begin(light_solve *s, const render_options *o, const lmb_scene *scene, const model *loaded, file_bytes *lmt,
                report *r)
{
    render_job *j = &s->job;
    int32_t stage;
    memset(s, 0, sizeof *s);
    j->o = *o;
    j->scene = *scene;
    j->loaded.cameras = loaded->cameras; /* borrowed: only the blocks of `loaded` are freed */
    j->loaded.camera_count = loaded->camera_count;
    j->transfer_file = *lmt;
    memset(lmt, 0, sizeof *lmt);
    if (!lmt_open(&j->transfer, &j->transfer_file, o->transfer, r) || !render_job_set(j, r)) {
        return 0;
    }
    const lmb_status status = workers_light(&j->workers, &stage, j->render, &j->frame, LMB_STAGE_VIEW);
    return status == LMB_OK || report_fail(r, "%s: its light cannot be solved: %s", o->scene, lmb_status_name(status));
}

void light_end(light_solve *s) { render_job_free(&s->job); }

void light_at(float (*out)[3], light_solve *s, const light_place *place, int count)
{
    lmb_tile *t = &s->tile;
    lmb_irradiance light;
    const lmb_frame *f = &s->job.render->frame;
    memset(t, 0, sizeof *t);
    memset(&light, 0, sizeof light);
    t->hits = count;
    for (int k = 0; k < count; ++k) {
        const light_place *p = &place[k];
        const float at[3] = {p->at.x, p->at.y, p->at.z}, face[3] = {p->face.x, p->face.y, p->face.z},
                    normal[3] = {p->normal.x, p->normal.y, p->normal.z};
        for (int c = 0; c < 3; ++c) {
            t->position[c][k] = at[c];
            t->face[c][k] = face[c];
            t->normal[c][k] = normal[c];
        }
        t->depth[k] = 1.0f;
        t->id[k] = p->id;
    }
    lmb_transfer_tile(&light, NULL, f->kernels, &s->scratch, &f->transfer_light, f->transfer, f->scene, t);
    for (int k = 0; k < count; ++k) {
        for (int c = 0; c < 3; ++c) {
            out[k][c] = light.rgb[c][k];
        }
    }
}
