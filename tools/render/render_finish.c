/* render_finish.c: from light to an image file. */
#include "render_finish.h"

#include <string.h>

#include "../common/fvec.h"
#include "../picture/picture.h"
#include "background.h"
#include "unlit.h"

#define DIM_EV 8.0f /* stops: light that needs more is practically black */

static int begin(render_finish *f, const render_job *j, int is_auto, float exposure_ev, report *r)
{
    memset(f, 0, sizeof *f);
    f->format = picture_format(j->o.out);
    f->background = j->o.background;
    f->tone = j->o.tone;
    f->exposure_auto = is_auto && !picture_is_linear(f->format);
    f->exposure_ev = exposure_ev;
    if (!(f->exposure_auto ? exposure_look(&f->view, j, r) : unlit_colours(&f->view.unlit, j, r))) {
        return 0;
    }
    f->view.width = j->linear.width;
    f->view.height = j->linear.height;
    f->view.eye_width = j->o.view.width;
    if (f->background.kind != BACKGROUND_WORLD && (f->view.cover = background_cover(j, r)) == NULL) { /* no world */
        finish_free(f);
        return 0;
    }
    return 1;
}

int finish_begin(render_finish *f, const render_job *j, report *r)
{
    return begin(f, j, j->o.exposure_auto, j->o.exposure_ev, r);
}

int finish_begin_at(render_finish *f, const render_job *j, float exposure_ev, report *r)
{
    return begin(f, j, 0, exposure_ev, r);
}

void finish_free(render_finish *f) { exposure_view_free(&f->view); }

/* Light is dark behind surfaces; fills in a display colour, or transparency. */
static int encode_before(file_bytes *out, const render_finish *f, image *linear, float ev, int tone, report *r)
{
    if (f->background.kind == BACKGROUND_TRANSPARENT) {
        return picture_encode_alpha(out, linear, f->view.cover, ev, tone, r);
    }
    picture_expose(linear, ev, tone);
    background_colour(linear, f->background.rgb, f->view.cover);
    return picture_encode(out, f->format, linear, 0.0f, PICTURE_CLIPPED, r);
}

int finish_encode(file_bytes *out, const render_finish *f, image *linear, int is_quiet, report *r)
{
    float ev = f->exposure_ev;
    int tone = f->tone;
    if (f->exposure_auto) {
        exposure_view by = f->view;
        by.cover = f->background.kind == BACKGROUND_WORLD ? by.cover : NULL;
        if (!exposure_of(&ev, &by, linear, r)) {
            return 0;
        }
        report_note(is_quiet, "exposure %+.3g EV (auto)%s", (double)ev,
                    ev > DIM_EV ? ": hardly any light comes to what is seen; the eye may be inside a wall" : "");
    }
    if (f->view.unlit != NULL && !picture_is_linear(f->format)) {
        unlit_expose(linear, f->view.unlit, ev, tone);
        ev = 0.0f;
        tone = PICTURE_CLIPPED;
    }
    return f->background.kind == BACKGROUND_WORLD ? picture_encode(out, f->format, linear, ev, tone, r)
                                                  : encode_before(out, f, linear, ev, tone, r);
}

int finish_write(const render_finish *f, const char *path, image *linear, int is_quiet, report *r)
{
    file_bytes file = {NULL, 0};
    report own = {""};
    int ok = finish_encode(&file, f, linear, is_quiet, &own) || report_fail(r, "%s: %s", path, own.text);
    ok = ok && file_write(path, file.data, file.size, r);
    file_free(&file);
    return ok;
}

void render_tell_coarse(int is_quiet, const lmb_stats *stats)
{
    if (stats->coarse_tiles > 0) {
        report_note(is_quiet, "note: %.0f of %.0f tiles have coarser visibility: too many triangles cross there",
                    (double)stats->coarse_tiles, (double)stats->tiles);
    }
}

void render_tell_dropped(int is_quiet, const lmb_scene *scene, const lmb_stats *stats)
{
    uint32_t dropped = 0;
    const uint32_t triangles = stats->triangles_dropped > 0 ? lmb_scene_triangles(scene) : 0;
    for (uint32_t id = 1; id <= triangles; ++id) {
        lmb_triangle t;
        dropped += !lmb_triangle_fetch(&t, scene, id) || !is_place(t.corner[0]) || !is_place(t.corner[1]) ||
                   !is_place(t.corner[2]);
    }
    if (dropped > 0) {
        report_note(is_quiet, "note: %u of %u triangles dropped: vertices not finite or over 2^20 m away",
                    (unsigned)dropped, (unsigned)triangles);
    }
}
