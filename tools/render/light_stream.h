/* light_stream.h: a tree of lights, for a sky, or for scenes with more lights than shadow maps. */
#ifndef LIGHT_STREAM_H
#define LIGHT_STREAM_H

#include <lambent/lambent.h>

#include "../common/report.h"

#define LIGHT_STREAM_CELLS 16384 /* by default: 10 MiB */

/* Zeroed: empty. light_stream_free releases it. */
typedef struct light_stream {
    lmb_many_lights tree;
    void *tree_memory;
    size_t bytes;
    double stream_s, build_s;
} light_stream;

typedef struct light_list {
    const lmb_light *lights;
    uint32_t count;
} light_list;

/* light_stream_take: builds the tree of the lights of both lists, with at most `cells` cells. Returns 1, or 0 with
 * `r` set. */
int light_stream_take(light_stream *out, const light_list lists[2], uint32_t cells, report *r);

void light_stream_free(light_stream *m);

#endif
