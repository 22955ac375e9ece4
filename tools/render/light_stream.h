/* light_stream.h: a scene's lights as a tree, for scenes with more of them than maps. */
#ifndef LIGHT_STREAM_H
#define LIGHT_STREAM_H

#include <lambent/lambent.h>

#include "../common/report.h"

#define LIGHT_STREAM_CELLS 16384 /* by default: 10 MiB */

/* Zeroed: none. light_stream_free releases it. */
typedef struct light_stream {
    lmb_many_lights tree;
    void *tree_memory;
    size_t bytes;
    double stream_s, build_s;
} light_stream;

/* light_stream_take: the tree of the scene's lights, at most `cells`; *scene is left with none. 1, or 0 with `r`
 * set. */
int light_stream_take(light_stream *out, lmb_scene *scene, uint32_t cells, report *r);

void light_stream_free(light_stream *m);

#endif
