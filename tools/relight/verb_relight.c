/* verb_relight.c: `lambent relight`: the light at a place of a world captured at another, and objects in it. */
#include "verb_relight.h"

#include <stdlib.h>

#include "../../platform/host/host.h"
#include "../common/progress.h"
#include "relight_draw.h"
#include "relight_export.h"
#include "relight_light.h"

/* Writes the light of the requested place, or with an object of the object's middle. */
static int write_light(relight_light *w, const relight_options *o, lmb_vec3 at, report *r)
{
    return (o->cube == NULL || (relight_light_at(w, o, at, o->faces, r) &&
                                relight_write_planes(o->cube, w->cube, o->faces, 6 * o->faces, r))) &&
           relight_export(w, o, at, r);
}

static int relight(relight_light *w, relight_options *o, report *r)
{
    lmb_vec3 at = o->at[0];
    const int is_brief = !o->view.is_verbose;
    const double start = host_seconds();
    if (!options_files(o, &relight_table, r) || !relight_light_make(w, o, r) || !options_files(o, &relight_table, r)) {
        return 0;
    }
    const double made = host_seconds();
    report_note(is_brief, "the world and its tables %10.1f ms", (made - start) * 1e3);
    if (o->object != NULL && !relight_draw(&at, w, o, r)) {
        return 0;
    }
    const double drawn = host_seconds();
    report_note(is_brief || o->object == NULL, "objects and their picture %8.1f ms", (drawn - made) * 1e3);
    if ((o->cube != NULL || relight_exports(o)) && !write_light(w, o, at, r)) {
        return 0;
    }
    report_note(is_brief, "light at the place %16.1f ms", (host_seconds() - drawn) * 1e3);
    return 1;
}

int verb_relight(int argc, char **argv)
{
    report r = {""};
    relight_options o;
    const int asked = relight_options_parse(&o, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &relight_table, &r);
    }
    relight_light *w = calloc(1, sizeof *w);
    progress_begin(o.view.is_quiet, "relight");
    const int ok = w != NULL ? relight(w, &o, &r) : report_fail(&r, "out of memory");
    if (w != NULL) {
        relight_light_free(w);
        free(w);
    }
    progress_end();
    return ok ? 0 : report_end(&r, "relight", 1);
}
