/* main.c: runs the tests: tests [GROUP | NAME | -NAME]... [K/N]   no arguments: all tests; -NAME: except this one; K/N:
 * every N-th of the selected tests, from the K-th on.
 *
 * The Makefile lists the tests in tests.inc, a line TEST(group, name) for each tests/GROUP/test_NAME.c. */
#include "../test.h"

#include <string.h>
#include <time.h>

#ifndef TEST_TABLE
#define TEST_TABLE "tests.inc"
#endif

int test_passed, test_failed, test_skipped;

#define TEST(group, name) void test_##name(void);
#include TEST_TABLE
#undef TEST

static const struct test {
    const char *group, *name;
    void (*run)(void);
} tests[] = {
#define TEST(group, name) {#group, #name, test_##name},
#include TEST_TABLE
#undef TEST
};
enum { TEST_COUNT = sizeof tests / sizeof tests[0] };

static int is_wanted(const struct test *t, int argc, char **argv)
{
    int wanted = argc < 2;
    for (int i = 1; i < argc; ++i) {
        if (argv[i][0] == '-' && !strcmp(argv[i] + 1, t->name))
            return 0;
        wanted |= !strcmp(argv[i], t->group) || !strcmp(argv[i], t->name);
    }
    return wanted;
}

/* Prints a line per test first, so that a crash shows which test it was in, then the counts and the seconds of
 * processor time. */
static void run(const struct test *t)
{
    int passed = test_passed, failed = test_failed, skipped = test_skipped;
    clock_t begun = clock();
    printf("%s/%s\n", t->group, t->name);
    fflush(stdout);
    t->run();
    printf("%s/%s: %d passed", t->group, t->name, test_passed - passed);
    if (test_failed > failed)
        printf(", %d failed", test_failed - failed);
    if (test_skipped > skipped)
        printf(", %d skipped", test_skipped - skipped);
    printf(", %.2f s\n", (double)(clock() - begun) / CLOCKS_PER_SEC);
}

/* Number of tests with this name or in this group. */
static int count_of(const char *word)
{
    int count = 0;
    for (int i = 0; i < TEST_COUNT; ++i)
        count += !strcmp(word, tests[i].group) || !strcmp(word, tests[i].name);
    return count;
}

int main(int argc, char **argv)
{
    int wanted = 0, first = 1, each = 1;
    if (argc > 1 && sscanf(argv[argc - 1], "%d/%d", &first, &each) == 2 && first > 0 && each >= first) {
        --argc;
    }
    for (int i = 1; i < argc; ++i)
        if (!count_of(argv[i] + (argv[i][0] == '-'))) {
            printf("FAIL there is no test or group `%s`\n", argv[i]);
            ++test_failed;
        }
    for (int i = 0; i < TEST_COUNT; ++i)
        if (is_wanted(&tests[i], argc, argv) && wanted++ % each == first - 1) {
            run(&tests[i]);
        }
    printf("%d passed, %d failed, %d skipped\n", test_passed, test_failed, test_skipped);
    return test_failed > 0;
}
