/* main_faults.c: each command with its nth allocation, open, write, rename or thread failing, for all n: faults SHIM
 * TOOL <CASES, in a folder whose `out` takes the outputs.
 *
 * A line of CASES is a command's arguments. Only exit statuses 0 and 1 are right; 1 goes with a line on stderr, 0 with
 * none; in `out` lies nothing but whole outputs and what stood there before. */
#define _XOPEN_SOURCE 700
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WORDS = 64, FILES = 8, KINDS = 5, SECONDS = 60, LONGEST = 4096 };

static const char *const kinds[KINDS] = {"alloc", "open", "write", "rename", "thread"};
static const char before[] = "before\n";

/* A file's whole content. */
typedef struct content {
    char name[256];
    char *data;
    size_t size;
} content;

typedef struct suite {
    const char *shim, *tool;
    char bench[LONGEST]; /* lambent-bench, which lies beside the tool */
    int is_bench;        /* the case begins with lambent-bench */
    char *words[WORDS + 2];
    const char *line;
    content wanted[FILES]; /* what the command writes when nothing fails */
    int wanted_count;
    int passed, failed;
} suite;

static int fail(suite *s, const char *fault, const char *why)
{
    ++s->failed;
    printf("FAIL FAULT=%s lambent %s: %s\n", fault, s->line, why);
    return 0;
}

/* --- files -------------------------------------------------------------------------------------------------------- */

static void read_content(content *out, const char *path)
{
    FILE *f = fopen(path, "rb");
    out->data = malloc(1 << 22);
    out->size = f != NULL && out->data != NULL ? fread(out->data, 1, 1 << 22, f) : 0;
    if (f != NULL) {
        fclose(f);
    }
}

/* Calls `visit` for each file in `out`; stops where it returns 0. */
static int each_file(suite *s, int (*visit)(suite *s, const char *name, const char *path, const char *fault),
                     const char *fault)
{
    DIR *folder = opendir("out");
    struct dirent *entry;
    int ok = folder != NULL;
    while (ok && (entry = readdir(folder)) != NULL) {
        char path[300];
        snprintf(path, sizeof path, "out/%s", entry->d_name);
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            ok = visit(s, entry->d_name, path, fault);
        }
    }
    if (folder != NULL) {
        closedir(folder);
    }
    return ok;
}

static int remove_one(suite *s, const char *name, const char *path, const char *fault)
{
    (void)s, (void)name, (void)fault;
    remove(path);
    return 1;
}

static int want_one(suite *s, const char *name, const char *path, const char *fault)
{
    content *c = &s->wanted[s->wanted_count];
    if (s->wanted_count == FILES) {
        return fail(s, fault, "too many outputs");
    }
    snprintf(c->name, sizeof c->name, "%s", name);
    read_content(c, path);
    ++s->wanted_count;
    return 1;
}

/* What has times in it is only known by its beginning and end. */
static int is_wanted(const content *c, const content *wanted)
{
    if (strstr(wanted->name, ".json") != NULL || strstr(wanted->name, ".html") != NULL ||
        strstr(wanted->name, ".csv") != NULL) {
        return c->size > 9 && memcmp(c->data, wanted->data, 2) == 0 && c->data[c->size - 1] == '\n' &&
               c->data[c->size - 2] == wanted->data[wanted->size - 2];
    }
    return c->size == wanted->size && memcmp(c->data, wanted->data, c->size) == 0;
}

static int judge_one(suite *s, const char *name, const char *path, const char *fault)
{
    content c;
    int ok = 0;
    read_content(&c, path);
    for (int i = 0; i < s->wanted_count; ++i) {
        ok |= strcmp(name, s->wanted[i].name) == 0 && is_wanted(&c, &s->wanted[i]);
    }
    ok |= c.size == sizeof before - 1 && memcmp(c.data, before, c.size) == 0;
    free(c.data);
    return ok || fail(s, fault, name);
}

/* A command that succeeded has written all. */
static int has_all(suite *s, const char *fault)
{
    for (int i = 0; i < s->wanted_count; ++i) {
        char path[300];
        content c;
        snprintf(path, sizeof path, "out/%s", s->wanted[i].name);
        read_content(&c, path);
        const int ok = is_wanted(&c, &s->wanted[i]);
        free(c.data);
        if (!ok) {
            return fail(s, fault, "status 0, and an output is not there");
        }
    }
    return 1;
}

static void put_before(const suite *s)
{
    for (int i = 0; i < s->wanted_count; ++i) {
        char path[300];
        snprintf(path, sizeof path, "out/%s", s->wanted[i].name);
        FILE *f = fopen(path, "wb");
        if (f != NULL) {
            fputs(before, f);
            fclose(f);
        }
    }
}

/* --- runs --------------------------------------------------------------------------------------------------------- */

static void run_child(const suite *s, const char *fault, const char *counts)
{
    const struct rlimit none = {0, 0};
    const int nothing = open("/dev/null", O_RDWR), err = open("err.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    setrlimit(RLIMIT_CORE, &none);
    dup2(nothing, 0);
    dup2(nothing, 1);
    dup2(err, 2);
    setenv("LD_PRELOAD", s->shim, 1);
    setenv("FAULT", fault, 1);
    if (counts != NULL) {
        setenv("FAULT_COUNTS", counts, 1);
    }
    alarm(SECONDS);
    execv(s->is_bench ? s->bench : s->tool, s->words + s->is_bench);
    _exit(127);
}

/* The wait status. */
static int run(const suite *s, const char *fault, const char *counts)
{
    int status = -1;
    fflush(stdout);
    const pid_t id = fork();
    if (id == 0) {
        run_child(s, fault, counts);
    }
    waitpid(id, &status, 0);
    return status;
}

static int lines_said(void)
{
    content c;
    int lines = 0;
    read_content(&c, "err.txt");
    for (size_t i = 0; i < c.size; ++i) {
        lines += c.data[i] == '\n';
    }
    lines += c.size > 0 && c.data[c.size - 1] != '\n';
    free(c.data);
    return lines;
}

/* Odd numbers find nothing in `out`, even ones files of the outputs' names. */
static void run_one(suite *s, const char *kind, int n)
{
    char fault[64], why[96];
    snprintf(fault, sizeof fault, "%s:%d", kind, n);
    each_file(s, remove_one, fault);
    if (n % 2 == 0) {
        put_before(s);
    }
    const int status = run(s, fault, NULL), code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, lines = lines_said();
    if (code != 0 && code != 1) {
        snprintf(why, sizeof why, WIFSIGNALED(status) ? "signal %d" : "exit status %d",
                 WIFSIGNALED(status) ? WTERMSIG(status) : code);
        fail(s, fault, why);
    } else if (lines != code) {
        snprintf(why, sizeof why, "exit status %d and %d lines on stderr", code, lines);
        fail(s, fault, why);
    } else if (each_file(s, judge_one, fault) && (code != 0 || has_all(s, fault))) {
        ++s->passed;
    }
}

static void run_case(suite *s)
{
    int count[KINDS] = {0}, all = 0;
    remove("counts.txt");
    each_file(s, remove_one, "");
    s->wanted_count = 0;
    const int status = run(s, "", "counts.txt");
    FILE *f = fopen("counts.txt", "r");
    for (int k = 0; f != NULL && k < KINDS; ++k) {
        all += fscanf(f, "%d", &count[k]);
    }
    if (f != NULL) {
        fclose(f);
    }
    if (status != 0 || all != KINDS || !each_file(s, want_one, "")) {
        fail(s, "none", "it does not succeed");
        return;
    }
    for (int k = 0; k < KINDS; ++k) {
        for (int n = 1; n <= count[k]; ++n) {
            run_one(s, kinds[k], n);
        }
    }
    printf("%5d allocations %2d opens %3d writes %d renames %3d threads: %s\n", count[0], count[1], count[2], count[3],
           count[4], s->line);
    for (int i = 0; i < s->wanted_count; ++i) {
        free(s->wanted[i].data);
    }
}

static int split(suite *s, char *line)
{
    int n = 1;
    for (char *word = strtok(line, " \n"); word != NULL && n <= WORDS; word = strtok(NULL, " \n")) {
        s->words[n++] = word;
    }
    s->words[n] = NULL;
    s->is_bench = n > 1 && strcmp(s->words[1], "lambent-bench") == 0;
    return n > 1;
}

int main(int argc, char **argv)
{
    static suite s;
    static char line[LONGEST], copy[LONGEST], name[] = "lambent";
    if (argc != 3) {
        fputs("faults SHIM TOOL <CASES\n", stderr);
        return 2;
    }
    s.shim = argv[1];
    s.tool = argv[2];
    snprintf(s.bench, sizeof s.bench, "%s-bench", s.tool);
    s.words[0] = name;
    while (fgets(line, sizeof line, stdin) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        memcpy(copy, line, sizeof copy);
        s.line = line;
        if (split(&s, copy)) {
            run_case(&s);
        }
    }
    printf("%d passed, %d failed, 0 skipped\n", s.passed, s.failed);
    return s.failed > 0 || s.passed == 0;
}
