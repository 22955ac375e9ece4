/* bench_peers.h: other rasterizers' programs on the same cases. */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include "../../platform/host/programs.h"
#include "../common/report.h"

/* The programs of a folder. */
typedef struct bench_peers {
    const char *folder; /* NULL: none */
    programs found;
} bench_peers;

/* bench_peers_find: finds the folder's programs, and sets their environment: the folder of the meshes and the time per
 * case. Returns 1, or 0 with `r` set if there are none. */
int bench_peers_find(bench_peers *out, const char *folder, const char *data, double seconds, report *r);

/* bench_peers_run: runs program i on a case and parses the shortest processor time of a frame, ms, from a line that it
 * must print:
 * NAME,CASE,...,cpu_min_ms=MS,...
 * Returns 1, or 0 with `r` set if the program fails or prints no such line. */
int bench_peers_run(double *out_ms, const bench_peers *peers, int i, const char *name, report *r);

#endif
