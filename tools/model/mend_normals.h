/* mend_normals.h: normals in place of those that a file gives without length. */
#ifndef MEND_NORMALS_H
#define MEND_NORMALS_H

#include "model_build.h"

/* mend_normals: vertices that build_normal_code marked get the normal of their triangles in the mesh, by
 * corner_weights; +Y where these have no area. 1, or 0 with b->r set. */
int mend_normals(model_build *b);

#endif
