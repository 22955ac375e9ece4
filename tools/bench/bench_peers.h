/* bench_peers.h: other rasterizers' programs on the same cases. */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include "../../platform/host/programs.h"
#include "../common/report.h"

enum { BENCH_PEER_CASES = 32 };

/* Times of a case, ms; 0: the program does not draw it. */
typedef struct bench_peer_case {
    const char *name;
    double own_ms, ms[PROGRAMS];
} bench_peer_case;

/* The programs of a folder, and their times. */
typedef struct bench_peers {
    const char *folder; /* NULL: none */
    programs found;
    bench_peer_case row[BENCH_PEER_CASES];
    int count;
} bench_peers;

/* bench_peers_find: finds the folder's programs, and sets their environment: the folder of the meshes and the time per
 * case. Returns 1, or 0 with `r` set if there are none. */
int bench_peers_find(bench_peers *out, const char *folder, const char *data, double seconds, report *r);

/* bench_peers_run: runs program i on a case and parses the shortest processor time of a frame, ms, from a line that it
 * must print:
 * NAME,CASE,...,cpu_min_ms=MS,...
 * If it prints nothing, it does not draw the case: 0 ms. Returns 1, or 0 with `r` set if the program fails or prints
 * something else. */
int bench_peers_run(double *out_ms, const bench_peers *peers, int i, const char *name, report *r);

/* bench_peers_print: the times of all cases as a table in Markdown: ms, and how many times ours that is. */
void bench_peers_print(const bench_peers *peers);

#endif
