/* main_hard.c: runs the gallery of hard cases (tools/hard/hard.h), where a figure past its bound fails; then checks
 * what must not change a picture, and the same call made thousands of times.
 *
 *     hard              all
 *     hard CASES...     these groups of cases (`lambent-bench hard --help` lists them), or `invariants`, `again`,
 *                       `masks`
 *     hard -CASES       all but that one
 * Ends with `N passed, N failed, N skipped`; exit status 1 where one failed. */
#include <stdio.h>
#include <string.h>

#include "hard_test.h"

int test_passed, test_failed, test_skipped;

static void run_group(int i)
{
    static hard_list list;
    CHECK_MSG(hard_run(&list, i, lmb_kernels_pick()), "%s: no memory", hard_groups[i]);
    for (int k = 0; k < list.count; ++k) {
        const hard_case *c = &list.item[k];
        CHECK_MSG(hard_holds(c), "%s: %s: %g %s, may be %g", c->group, c->name, c->figure, c->unit, c->bound);
    }
    CHECK_MSG(list.count > 0, "%s has no case", hard_groups[i]);
}

static void run_checks(void (*checks)(hard_stage *))
{
    hard_stage *stage = hard_stage_make(lmb_kernels_pick());
    CHECK(stage != NULL);
    if (stage != NULL) {
        checks(stage);
    }
    hard_stage_free(stage);
}

static void tell(const char *name, int passed, int failed)
{
    printf("%s: %d passed, %d failed\n", name, test_passed - passed, test_failed - failed);
}

/* NULL: all; -NAME: all others. */
static int is_meant(const char *name, const char *one)
{
    return name == NULL || (name[0] == '-' ? strcmp(name + 1, one) != 0 : strcmp(name, one) == 0);
}

/* 0 where there is none of that name. */
static int run(const char *name)
{
    static const struct {
        const char *name;
        void (*run)(hard_stage *);
    } checks[] = {{"invariants", hard_invariants}, {"again", hard_again}, {"masks", hard_masks}};
    int found = 0;
    for (int i = 0; hard_groups[i] != NULL; ++i) {
        const int passed = test_passed, failed = test_failed;
        if (is_meant(name, hard_groups[i])) {
            run_group(i);
            tell(hard_groups[i], passed, failed);
            found = 1;
        }
    }
    for (int i = 0; i < 3; ++i) {
        const int passed = test_passed, failed = test_failed;
        if (is_meant(name, checks[i].name)) {
            run_checks(checks[i].run);
            tell(checks[i].name, passed, failed);
            found = 1;
        }
    }
    return found;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        run(NULL);
    }
    for (int i = 1; i < argc; ++i) {
        CHECK_MSG(run(argv[i]), "%s: there are no such cases", argv[i]);
    }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
