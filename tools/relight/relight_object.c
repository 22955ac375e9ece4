/* relight_object.c: loads an object and places it. */
#include <string.h>

#include "../demo/demo_field.h"
#include "relight_figures.h"

void figures_place(lmb_mat4 *out, const lmb_mat4 *from, lmb_vec3 low, lmb_vec3 high, float scale, lmb_vec3 at)
{
    const float foot[3] = {0.5f * (low.x + high.x), low.y, 0.5f * (low.z + high.z)},
                to[3] = {at.x, at.y, at.z};
    *out = *from;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) {
            float *m = &out->m[4 * column + row];
            *m = column < 3 ? *m * scale : (*m - foot[row]) * scale + to[row];
        }
    }
}

int figures_load_model(model *out, const char *name, const relight_options *o, report *r)
{
    model_notes notes = {0};
    if (strcmp(name, "demo") == 0) {
        out->scene = *demo_field_figure();
    } else if (!model_load_as(out, name, &o->choice, &notes, r)) {
        return 0;
    }
    model_tell(&notes, name, MODEL_NOTE_OPTION);
    return 1;
}
