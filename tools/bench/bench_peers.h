/* bench_peers.h: other rasterizers' programs on the same cases. */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include "../../platform/host/programs.h"
#include "../common/report.h"

/* The programs of a folder, and what one of them measured. */
typedef struct bench_peers {
    const char *folder; /* NULL: none */
    programs found;
} bench_peers;

/* bench_peers_find: the folder's programs, which will find where the meshes are, and how long a case is to be measured.
 * 1, or 0 with `r` set where there are none. */
int bench_peers_find(bench_peers *out, const char *folder, const char *data, double seconds, report *r);

/* bench_peers_run: let program i draw a case; the least processor time of a frame, in ms, by the line that it prints,
 * NAME,CASE,...,cpu_min_ms=MS,...
 * 1, or 0 with `r` set: it did not end well, or printed no such line. */
int bench_peers_run(double *out_ms, const bench_peers *peers, int i, const char *name, report *r);

#endif
