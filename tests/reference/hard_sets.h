/* hard_sets.h: random triangles of kinds that are difficult for rasterizers. */
#ifndef HARD_SETS_H
#define HARD_SETS_H

#include <lambent/lambent.h>

enum { HARD_TRIANGLES = 300, HARD_SETS = 20 };

typedef struct hard_set {
    const char *name;
    int cull, steep; /* steep: planes with a large change of depth within a px */
    float corners[HARD_TRIANGLES][3][3];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_scene scene;
    lmb_view view;
} hard_set;

/* Makes set i of HARD_SETS: each kind in perspective and orthographic, then two special ones. Do not copy the struct:
 * it contains pointers to itself. */
void hard_set_make(hard_set *out, int i);

#endif
