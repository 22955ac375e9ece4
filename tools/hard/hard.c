/* hard.c: the gallery's table: which rooms there are, and what they found. */
#include "hard.h"

#include <stdlib.h>
#include <string.h>

const char *const hard_rooms[] = {"raster", "shadow", "bounce", "probe", "relief", "mixed", "far", "all", NULL};

static void (*const rooms[])(hard_list *) = {hard_raster, hard_shadow, hard_bounce, hard_probe,
                                             hard_relief, hard_mixed,  hard_far,    hard_all};

int hard_run(hard_list *out, const char *room, const lmb_kernels *kernels)
{
    int found = 0;
    memset(out, 0, sizeof *out);
    out->stage = hard_stage_make(kernels);
    for (int i = 0; out->stage != NULL && hard_rooms[i] != NULL; ++i) {
        if (room == NULL || strcmp(room, hard_rooms[i]) == 0) {
            out->room = hard_rooms[i];
            rooms[i](out);
            found = 1;
        }
    }
    hard_stage_free(out->stage);
    out->stage = NULL;
    return found;
}
