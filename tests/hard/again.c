/* again.c: ten thousand frames in a row: the same bytes, and nothing of the caller's memory that a call must not write.
 *
 * The library has no heap, so what could grow is only what lies in its structs: they are compared too. */
#include <string.h>

#include "hard_test.h"

enum { SIDE = 8, MAP = 8, FRAMES = 10000 / HARD_FEWER };

void hard_again(hard_stage *s)
{
    static float first[SIDE * SIDE * 3];
    static lmb_render kept;
    int differ = 0, failed = 0;
    hard_begin(s, 0.5);
    hard_quad(s, dvec_of(0, 0, 0), dvec_of(1, 0, 0), dvec_of(0, 0, -1));
    hard_quad(s, dvec_of(0, 1, -1), dvec_of(1, 0, 0), dvec_of(0, 1, 0));
    hard_spot(s, dvec_of(0.2, 1.8, 0.5), dvec_of(0, 0, 0), 35.0, 4.0);
    CHECK(hard_end(s));
    hard_look(s, dvec_of(0.5, 1, 3), dvec_of(0, 0.5, 0), 40.0, SIDE);
    for (int i = 0; i < FRAMES; ++i) {
        failed += hard_frame(s, LMB_SHOW_FULL, MAP, 0.1f) != LMB_OK;
        if (i == 0) {
            memcpy(first, s->out, sizeof first);
            memcpy(&kept, &s->render, sizeof kept);
        }
        differ += memcmp(first, s->out, sizeof first) != 0 || memcmp(&kept, &s->render, sizeof kept) != 0;
    }
    CHECK_MSG(failed == 0 && differ == 0, "%d failed, %d differ", failed, differ);
}
