/* main_hostile.c: runs every parser on truncated files and on seeded damage; counts and times them by kind of file.
 *
 *     hostile PREFIXES MUTATIONS FILE...      number of prefixes of each file, of damaged files of each kind
 *     hostile --case prefix:N|seed:N FILE [OUT]     repeats one case; writes its bytes to OUT
 *
 * The kind is the name of the file's folder, as under tests/fuzz/corpus, or the file's extension. If a check fails, the
 * program prints the line that repeats the case and aborts; under AddressSanitizer that needs abort_on_error=1. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../tools/picture/image.h"
#include "fuzz.h"
#include "mutate.h"

enum { KINDS_MAX = 32, NAME_MAX_BYTES = 512 };

typedef struct kind {
    const char *name;
    fuzz_target target;
    uint32_t files, cases, accepted;
    double slowest; /* seconds a MB */
    char slowest_name[NAME_MAX_BYTES];
} kind;

static kind kinds[KINDS_MAX];

/* The current case, as arguments of --case. */
static char now[NAME_MAX_BYTES];

static void tell_case(int signal_number)
{
    signal(signal_number, SIG_DFL);
    fprintf(stderr, "\nfound by: hostile --case %s\n", now);
    raise(signal_number);
}

static kind *find_kind(const char *name, size_t length)
{
    for (int i = 0; fuzz_names[i] != NULL && i < KINDS_MAX; ++i) {
        if (strlen(fuzz_names[i]) == length && memcmp(fuzz_names[i], name, length) == 0) {
            kinds[i].name = fuzz_names[i];
            kinds[i].target = fuzz_find(fuzz_names[i]);
            return &kinds[i];
        }
    }
    return NULL;
}

static kind *kind_of(const char *path)
{
    const char *end = strrchr(path, '/'), *start = end, *dot = strrchr(path, '.');
    kind *found = NULL;
    while (start != NULL && start > path && start[-1] != '/') {
        --start;
    }
    if (end != NULL) {
        found = find_kind(start, (size_t)(end - start));
    }
    if (found == NULL && dot != NULL && strcmp(dot, ".glb") == 0) {
        dot = ".gltf";
    }
    if (found == NULL && dot != NULL && strcmp(dot, ".jpg") == 0) {
        dot = ".jpeg";
    }
    return found == NULL && dot != NULL ? find_kind(dot + 1, strlen(dot + 1)) : found;
}

/* Runs the target on a block of exactly these bytes, so that reads past the end are found. */
static void run_case(kind *k, const uint8_t *data, size_t size)
{
    uint8_t *exact = malloc(size);
    uint32_t failures = fuzz_failures;
    double seconds;
    clock_t begun;
    fuzz_require(exact != NULL || size == 0);
    if (size > 0) {
        memcpy(exact, data, size);
    }
    begun = clock();
    k->target(exact, size);
    seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
    free(exact);
    seconds /= size > 1000000 ? (double)size / 1e6 : 1.0;
    if (seconds > k->slowest) {
        k->slowest = seconds;
        memcpy(k->slowest_name, now, sizeof now);
    }
    ++k->cases;
    k->accepted += fuzz_failures == failures;
}

static void run_prefix(kind *k, const file_bytes *file, const char *path, size_t size)
{
    snprintf(now, sizeof now, "prefix:%.0f %s", (double)size, path);
    run_case(k, file->data, size);
}

/* Puts the damaged file into *out; free it. */
static size_t damage(uint8_t **out, const kind *k, const file_bytes *file, uint64_t seed)
{
    size_t cap = mutate_cap(file->size), size;
    *out = malloc(cap);
    fuzz_require(*out != NULL);
    memcpy(*out, file->data, file->size);
    size = mutate(*out, file->size, cap, seed);
    fuzz_repair(k->target, *out, size, seed);
    return size;
}

static void run_seed(kind *k, const file_bytes *file, const char *path, uint64_t seed)
{
    uint8_t *bytes;
    size_t size;
    snprintf(now, sizeof now, "seed:%.0f %s", (double)seed, path);
    size = damage(&bytes, k, file, seed);
    run_case(k, bytes, size);
    free(bytes);
}

/* Lengths 0 .. size - 1 if these are few enough, else `prefixes` lengths, evenly spread. */
static void run_prefixes(kind *k, const file_bytes *file, const char *path, uint64_t prefixes)
{
    uint64_t n = file->size < prefixes ? file->size : prefixes;
    for (uint64_t i = 0; i < n; ++i) {
        run_prefix(k, file, path, (size_t)(i * file->size / n));
    }
}

/* File `index` of a kind gets every `files`-th seed. */
static void run_file(kind *k, const char *path, uint32_t index, uint64_t prefixes, uint64_t mutations)
{
    report r = {{0}};
    file_bytes file;
    fuzz_require(file_read(&file, path, &r));
    run_prefixes(k, &file, path, prefixes);
    for (uint64_t seed = index; seed < mutations && file.size > 0; seed += k->files) {
        run_seed(k, &file, path, seed);
    }
    file_free(&file);
}

/* Repeats one case; a failure aborts. */
static int repeat(int argc, char **argv)
{
    const char *path = argv[3];
    kind *k = kind_of(path);
    uint64_t number = strtoull(strchr(argv[2], ':') ? strchr(argv[2], ':') + 1 : "", NULL, 10);
    report r = {{0}};
    file_bytes file;
    uint8_t *bytes = NULL;
    size_t size;
    int ok;
    if (k == NULL || !file_read(&file, path, &r)) {
        fprintf(stderr, "%s: %s\n", path, k ? r.text : "of no kind that is known");
        return 2;
    }
    size = number < file.size ? (size_t)number : file.size;
    if (strncmp(argv[2], "seed:", 5) == 0) {
        size = damage(&bytes, k, &file, number);
    }
    ok = argc < 5 || file_write(argv[4], bytes ? bytes : file.data, size, &r);
    snprintf(now, sizeof now, "%s %s", argv[2], path);
    run_case(k, bytes ? bytes : file.data, size);
    free(bytes);
    file_free(&file);
    printf("%s: %s, %.3f s a MB\n", now, k->accepted ? "accepted" : "refused", k->slowest);
    return !ok;
}

static void print_table(void)
{
    printf("%-8s %6s %8s %9s %9s  %s\n", "kind", "files", "cases", "accepted", "s/MB", "of the slowest, which is");
    for (int i = 0; i < KINDS_MAX; ++i) {
        const kind *k = &kinds[i];
        if (k->cases > 0) {
            printf("%-8s %6u %8u %9u %9.3f  %s\n", k->name, (unsigned)k->files, (unsigned)k->cases,
                   (unsigned)k->accepted, k->slowest, k->slowest_name);
        }
    }
}

int main(int argc, char **argv)
{
    uint32_t seen[KINDS_MAX] = {0}, passed = 0, failed = 0;
    signal(SIGABRT, tell_case);
    signal(SIGSEGV, tell_case);
    if (argc >= 4 && strcmp(argv[1], "--case") == 0) {
        return repeat(argc, argv);
    }
    if (argc < 4) {
        fputs("usage: hostile PREFIXES MUTATIONS FILE...\n       hostile --case prefix:N|seed:N FILE [OUT]\n", stderr);
        return 2;
    }
    for (int i = 3; i < argc; ++i) {
        kind *k = kind_of(argv[i]);
        if (k != NULL) {
            ++k->files;
        } else {
            printf("FAIL %s: of no kind that is known\n", argv[i]);
            ++failed;
        }
    }
    for (int i = 3; i < argc; ++i) {
        kind *k = kind_of(argv[i]);
        if (k != NULL) {
            run_file(k, argv[i], seen[k - kinds]++, strtoull(argv[1], NULL, 10), strtoull(argv[2], NULL, 10));
        }
    }
    print_table();
    for (int i = 0; i < KINDS_MAX; ++i) {
        passed += kinds[i].cases;
    }
    printf("%u passed, %u failed, 0 skipped\n", (unsigned)passed, (unsigned)failed);
    return failed != 0;
}
