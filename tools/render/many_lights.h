/* many_lights.h: a scene's lights as a tree, for scenes with more of them than maps. */
#ifndef MANY_LIGHTS_H
#define MANY_LIGHTS_H

#include <lambent/lambent.h>

#include "../common/report.h"

#define MANY_LIGHTS_CELLS 16384 /* by default: 10 MiB */

/* Zeroed: none. many_lights_free releases it. */
typedef struct many_lights {
    lmb_many tree;
    void *tree_memory;
    size_t bytes;
    double stream_s, build_s;
} many_lights;

/* many_lights_take: the tree of the scene's lights, at most `cells`; *scene is left with none. 1, or 0 with `r` set. */
int many_lights_take(many_lights *out, lmb_scene *scene, uint32_t cells, report *r);

void many_lights_free(many_lights *m);

#endif
