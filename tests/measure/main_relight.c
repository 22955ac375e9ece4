/* main_relight.c: objects lit by the world around them: cost of each method and distance from truth.         [S1-S27]
 *
 *     measure-relight [COUNTS]   tables; COUNTS has lines `FILTER INSTRUCTIONS`, printed beside the times
 *     measure-relight count      two updates by each filter, avx2: for counting instructions of relight_update
 *
 * Times are processor seconds of one core, the minimum of many samples. */
#include <stdlib.h>
#include <string.h>

#include "../shared_file.h"
#include "relight_stage.h"

int test_passed, test_failed, test_skipped;

static int has_truth(void)
{
    char path[SHARED_PATH];
    return shared_file(path, "truth/env_relight/ground.pfm");
}

/* The first call of a kind also resolves library functions; the second does not. */
static int count(relight_stage *s)
{
    s->kernels = lmb_kernels_named("avx2");
    if (s->kernels == NULL || !has_truth() || !relight_take_centre(s)) {
        return 1;
    }
    for (int i = 0; i < 2 * FILTERS; ++i) {
        relight_update(s, i / 2, relight_places[0], SIDE);
    }
    for (int i = 0; i < FILTERS; ++i) {
        printf("%s\n", filter_names[i]);
    }
    return 0;
}

int main(int argc, char **argv)
{
    static relight_stage s;
    relight_stage_make(&s);
    if (argc > 1 && strcmp(argv[1], "count") == 0) {
        const int status = count(&s);
        relight_stage_free(&s);
        return status;
    }
    if (has_truth()) {
        relight_tell_filters(&s, argc > 1 ? argv[1] : NULL);
        relight_tell_raster(&s);
    }
    relight_tell_maps(&s);
    relight_tell_glossy(&s);
    relight_tell_frames(&s);
    relight_stage_free(&s);
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
