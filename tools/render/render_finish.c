/* render_finish.c: a picture's light -> its file. */
#include "render_finish.h"

#include <string.h>

#include "../picture/picture.h"
#include "background.h"
#include "unlit.h"

#define DIM_EV 8.0f /* what is lifted by more stops than these is as good as black */

int finish_begin(render_finish *f, const render_job *j, report *r)
{
    memset(f, 0, sizeof *f);
    f->format = picture_format(j->o.out);
    f->background = j->o.background;
    f->tone = j->o.tone;
    f->exposure_auto = j->o.exposure_auto && !picture_is_linear(f->format);
    f->exposure_ev = j->o.exposure_ev;
    if (!(f->exposure_auto ? exposure_look(&f->view, j, r) : unlit_colours(&f->view.unlit, j, r))) {
        return 0;
    }
    f->view.width = j->linear.width;
    f->view.height = j->linear.height;
    f->view.eye_width = j->o.view.width;
    if (f->background.kind != BACKGROUND_WORLD && (f->view.cover = background_cover(j, r)) == NULL) { /* no world's */
        finish_free(f);
        return 0;
    }
    return 1;
}

void finish_free(render_finish *f) { exposure_view_free(&f->view); }

/* What lies behind surfaces is dark in the light: a colour of the display's, or nothing, comes behind them. */
static int write_before(const render_finish *f, const char *path, image *linear, float ev, int tone, report *r)
{
    if (f->background.kind == BACKGROUND_TRANSPARENT) {
        return picture_write_alpha(path, linear, f->view.cover, ev, tone, r);
    }
    picture_expose(linear, ev, tone);
    background_colour(linear, f->background.rgb, f->view.cover);
    return picture_write(path, linear, 0.0f, PICTURE_CLIPPED, r);
}

int finish_write(const render_finish *f, const char *path, image *linear, int is_quiet, report *r)
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
    return f->background.kind == BACKGROUND_WORLD ? picture_write(path, linear, ev, tone, r)
                                                  : write_before(f, path, linear, ev, tone, r);
}
