/* main_plan.c: fits the cost of operations to measured scenes.
 *
 *   measure-plan measure FILE [SCENE ...]   draw scenes by many settings; append rows to FILE
 *   measure-plan model FILE                 fit the model to the rows of fitted scenes, as src/frame/plan_model.inc */
#include <stdlib.h>
#include <string.h>

#include "../test.h"
#include "plan_rows.h"

int test_passed, test_failed, test_skipped;

static plan_scene scenes[PLAN_SCENES];

/* The rows are raw structs, readable only by the same build on the same machine. */
static int read_rows(const char *path)
{
    FILE *f = fopen(path, "rb");
    int count = 0;
    while (f != NULL && count < PLAN_SCENES && fread(&scenes[count], sizeof *scenes, 1, f) == 1) {
        ++count;
    }
    if (f != NULL) {
        fclose(f);
    }
    return count;
}

static int is_wanted(const char *name, int argc, char **argv)
{
    int wanted = argc <= 3;
    for (int i = 3; i < argc; ++i) {
        wanted |= strcmp(argv[i], name) == 0;
    }
    return wanted;
}

static void measure(const char *path, int argc, char **argv)
{
    for (int i = 0; i < plan_place_count; ++i) {
        if (!is_wanted(plan_places[i].name, argc, argv)) {
            continue;
        }
        if (!plan_measure(&scenes[0], &plan_places[i])) {
            SKIP("%s: not here", plan_places[i].name);
            continue;
        }
        FILE *f = fopen(path, "ab");
        CHECK(f != NULL && fwrite(&scenes[0], sizeof *scenes, 1, f) == 1);
        if (f != NULL) {
            fclose(f);
        }
        printf("%-16s %d settings\n", scenes[0].name, scenes[0].runs);
        fflush(stdout);
    }
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "measure-plan measure|model FILE [SCENE ...]\n");
        return 2;
    }
    if (strcmp(argv[1], "model") == 0) {
        const int count = read_rows(argv[2]);
        plan_fit(scenes, count, stdout);
        return count == 0;
    }
    measure(argv[2], argc, argv);
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
