/* model_shape.h: meshes whose shape moves: morph targets by their weights, then a skin by its joints. */
#ifndef MODEL_SHAPE_H
#define MODEL_SHAPE_H

#include "model_motion.h"

enum { SHAPE_POSITION, SHAPE_NORMAL, SHAPE_TANGENT, SHAPE_STREAMS };

/* One mesh of the model, which no other instance shows. */
typedef struct model_shape {
    uint32_t vertices;
    /* As the file has it, at weights of 0 and unposed; and the mesh's own streams, which are filled. NULL: none. */
    const float *rest_positions;
    const int16_t *rest_normals, *rest_tangents;
    float *positions;
    int16_t *normals, *tangents;
    /* What each target adds, 3 numbers a vertex, by stream; NULL: nothing. */
    uint32_t targets;
    const float **add[SHAPE_STREAMS];
    const double *weights;    /* a target, where no track moves them */
    const model_track *track; /* of all of them, a key; NULL: none */
    /* A skin; no joints: none. */
    uint32_t joints, influences; /* influences: of each vertex */
    const uint32_t *joint_node;  /* of the motion */
    const double (*bind)[16];
    const uint16_t *joint;       /* by vertex and influence */
    const float *weight;
} model_shape;

/* All of a motion's. `weights` and `matrices` have room for the most targets and joints of one. */
struct model_shapes {
    model_shape *shape;
    uint32_t count;
    double *weights;
    double (*matrices)[16];
};

/* model_pose_shapes: fill the streams of the model's meshes that change their shape as they are at a time; after
 * model_pose of that time. Raise the revisions of those instances. Cost: a pass over their vertices and targets. */
void model_pose_shapes(const model *of, double time_s);

#endif
