/* hard.c: the table of the groups of hard cases, and the results. */
#include "hard.h"

#include <string.h>

const char *const hard_groups[] = {"raster", "shadow", "bounce", "probe", "relief", "mixed",
                                   "far",    "whole",  "baked",  "cliff", "sheet", "pillar", "room", "slit", NULL};

static void (*const groups[])(hard_list *) = {hard_raster, hard_shadow, hard_bounce, hard_probe,
                                              hard_relief, hard_mixed,  hard_far,    hard_whole, hard_baked,
                                              hard_cliff,  hard_sheet,  hard_pillar, hard_room, hard_slit};

int hard_run(hard_list *out, int i, const lmb_kernels *kernels)
{
    memset(out, 0, sizeof *out);
    out->stage = hard_stage_make(kernels);
    if (out->stage == NULL) {
        return 0;
    }
    for (int k = 0; hard_groups[k] != NULL; ++k) {
        if (i < 0 || i == k) {
            out->group = hard_groups[k];
            groups[k](out);
        }
    }
    hard_stage_free(out->stage);
    out->stage = NULL;
    return 1;
}
