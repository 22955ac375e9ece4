/* mend_normals.h: replaces normals that have no length in the file. */
#ifndef MEND_NORMALS_H
#define MEND_NORMALS_H

#include "model_build.h"

/* mend_normals: gives vertices that build_normal_code marked the mean normal of their triangles in the mesh, weighted
 * by corner_weights, or +Y if the triangles have no area. Returns 1, or 0 with b->r set. */
int mend_normals(model_build *b);

#endif
