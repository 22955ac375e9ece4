/* bench_peers.c: other rasterizers' programs: runs them and parses their output. */
#include "bench_peers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PRINTED = 65536 };

int bench_peers_find(bench_peers *p, const char *folder, const char *data, double seconds, report *r)
{
    char text[40];
    p->folder = folder;
    if (!programs_find(&p->found, folder)) {
        return report_fail(r, "%s: no folder of programs that can be run here; give one that can be read", folder);
    }
    if (p->found.count == 0) {
        return report_fail(r, "%s: no file in it may be run; build the peers there, or chmod +x them", folder);
    }
    snprintf(text, sizeof text, "%g", seconds);
    program_tell("BENCH_SEC", text);
    if (data != NULL) {
        program_tell("BENCH_DATA", data);
    }
    return 1;
}

/* A plausible frame time, ms, after `cpu_min_ms=` in a line; 0 if there is none. */
static double time_in(const char *line, size_t length)
{
    static const char key[] = ",cpu_min_ms=";
    const size_t n = sizeof key - 1;
    for (size_t i = 0; i + n < length; ++i) {
        if (memcmp(line + i, key, n) == 0) {
            char *end;
            const double ms = strtod(line + i + n, &end);
            const int ends = *end == ',' || *end == '\n' || *end == '\r' || *end == '\0';
            return ends && ms > 0.0 && ms < 1e9 ? ms : 0.0;
        }
    }
    return 0.0;
}

/* Finds the line with the case as second word; skips other lines. */
static double find_time(const char *printed, const char *name)
{
    const size_t n = strlen(name);
    for (const char *line = printed; *line != '\0';) {
        const size_t length = strcspn(line, "\n"), word = strcspn(line, ",\n");
        if (word + 1 + n < length && strncmp(line + word + 1, name, n) == 0 && line[word + 1 + n] == ',') {
            return time_in(line, length);
        }
        line += length + (line[length] == '\n');
    }
    return 0.0;
}

int bench_peers_run(double *out_ms, const bench_peers *p, int i, const char *name, report *r)
{
    static char printed[PRINTED];
    char path[1024];
    int code = 0;
    snprintf(path, sizeof path, "%.900s/%s", p->folder, p->found.name[i]);
    switch (program_run(&code, path, name, printed, sizeof printed)) {
    case PROGRAM_NOT_RUN: return report_fail(r, "%s: it cannot be run", path);
    case PROGRAM_SIGNAL:
        return report_fail(r, "%s: ended by signal %d at %s; mend it, or take it away", path, code, name);
    case PROGRAM_FAILED: return report_fail(r, "%s: exit status %d at %s; mend it, or take it away", path, code, name);
    default: break;
    }
    *out_ms = find_time(printed, name);
    return *out_ms > 0.0 || printed[0] == '\0' ||
           report_fail(r, "%s: printed no line NAME,%s,...,cpu_min_ms=MS; see tools/README.md", path, name);
}

static void print_row(const bench_peer_case *row, int count)
{
    printf("| %s | %.3g |", row->name, row->own_ms);
    for (int i = 0; i < count; ++i) {
        if (row->ms[i] > 0.0) {
            printf(" %.3g (%.3g) |", row->ms[i], row->ms[i] / row->own_ms);
        } else {
            printf(" - |");
        }
    }
    puts("");
}

void bench_peers_print(const bench_peers *p)
{
    printf("\n| case, ms (times ours) | lambent |");
    for (int i = 0; i < p->found.count; ++i) {
        printf(" %s |", p->found.name[i]);
    }
    printf("\n|---|---|");
    for (int i = 0; i < p->found.count; ++i) {
        printf("---|");
    }
    puts("");
    for (int i = 0; i < p->count; ++i) {
        print_row(&p->row[i], p->found.count);
    }
}
