/* model_morph.h: a mesh's shape by the weights of its morph targets. */
#ifndef MODEL_MORPH_H
#define MODEL_MORPH_H

#include <lambent/lambent.h>

enum { MODEL_MORPH_POSITION, MODEL_MORPH_NORMAL, MODEL_MORPH_TANGENT, MODEL_MORPH_STREAMS };

/* The mesh at weights of 0, and what each target adds: 3 a vertex. */
typedef struct model_morph {
    uint32_t vertices, targets;
    const float *positions;
    const int16_t *normals, *tangents; /* octahedral; tangents with their sides; NULL: none */
    const float **add[MODEL_MORPH_STREAMS]; /* by stream and target; NULL: nothing */
} model_morph;

/* model_morph_pose: fill the streams that are not NULL by one weight a target. A normal or tangent that the targets
 * leave without length stays as at weights of 0. */
void model_morph_pose(float *positions, int16_t *normals, int16_t *tangents, const model_morph *m,
                      const double *weights);

/* model_set_side: make an octahedral code that of LMB_TANGENT_SIDED: odd, or even where w is negative. The direction
 * turns by up to 5e-5 rad. model_side_of: 1 where w is negative. */
void model_set_side(int16_t code[2], int negative);
int model_side_of(const int16_t code[2]);

#endif
