/* model_morph.h: shapes a mesh from morph targets and weights. */
#ifndef MODEL_MORPH_H
#define MODEL_MORPH_H

#include <lambent/lambent.h>

enum { MODEL_MORPH_POSITION, MODEL_MORPH_NORMAL, MODEL_MORPH_TANGENT, MODEL_MORPH_STREAMS };

/* The mesh with all weights 0, and the offsets of each target: 3 numbers per vertex. */
typedef struct model_morph {
    uint32_t vertices, targets;
    const float *positions;
    const int16_t *normals, *tangents; /* octahedral codes; tangents include their sides; NULL: none */
    const float **add[MODEL_MORPH_STREAMS]; /* by stream and target; NULL: nothing */
} model_morph;

/* model_morph_pose: fills the streams that are not NULL, with one weight per target. If a normal or tangent would have
 * no length, it stays as it is with all weights 0. */
void model_morph_pose(float *positions, int16_t *normals, int16_t *tangents, const model_morph *m,
                      const double *weights);

/* model_set_side: changes an octahedral code to LMB_TANGENT_SIDED: odd, or even if w is negative. The direction turns
 * by up to 5e-5 rad. model_side_of: returns 1 if w is negative. */
void model_set_side(int16_t code[2], int negative);
int model_side_of(const int16_t code[2]);

#endif
