/* main_hard.c: runs the gallery of hard cases (tools/hard/hard.h), where a figure past its bound fails; then checks
 * what must not change a picture, and the same call made thousands of times.
 *
 *     hard              all
 *     hard ROOM...      these rooms of the gallery, or `invariants`, `again`
 * Ends with `N passed, N failed, N skipped`; exit status 1 where one failed. */
#include <stdio.h>
#include <string.h>

#include "hard_test.h"

int test_passed, test_failed, test_skipped;

static void run_room(const char *room)
{
    static hard_list list;
    CHECK_MSG(hard_run(&list, room, lmb_kernels_pick()), "%s: no such room, or no memory", room);
    for (int i = 0; i < list.count; ++i) {
        const hard_case *c = &list.item[i];
        CHECK_MSG(hard_holds(c), "%s: %s: %g %s, may be %g", c->room, c->name, c->figure, c->unit, c->bound);
    }
    CHECK_MSG(list.count > 0, "%s has no case", room);
}

static void run(const char *name)
{
    if (strcmp(name, "invariants") != 0 && strcmp(name, "again") != 0) {
        run_room(name);
        return;
    }
    hard_stage *stage = hard_stage_make(lmb_kernels_pick());
    CHECK(stage != NULL);
    if (stage != NULL) {
        strcmp(name, "again") == 0 ? hard_again(stage) : hard_invariants(stage);
    }
    hard_stage_free(stage);
}

int main(int argc, char **argv)
{
    static const char *const all[] = {"raster", "shadow", "bounce",     "probe", "relief",
                                      "mixed",  "far",    "all",        "invariants", "again"};
    const int count = argc > 1 ? argc - 1 : (int)(sizeof all / sizeof *all);
    for (int i = 0; i < count; ++i) {
        const char *name = argc > 1 ? argv[1 + i] : all[i];
        const int passed = test_passed, failed = test_failed;
        run(name);
        printf("%s: %d passed, %d failed\n", name, test_passed - passed, test_failed - failed);
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
