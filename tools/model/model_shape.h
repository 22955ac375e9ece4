/* model_shape.h: meshes that change shape: morph targets with weights first, then a skin with joints. */
#ifndef MODEL_SHAPE_H
#define MODEL_SHAPE_H

#include "model_motion.h"

enum { SHAPE_POSITION, SHAPE_NORMAL, SHAPE_TANGENT, SHAPE_STREAMS };

/* One mesh of the model. No other instance shows it. */
typedef struct model_shape {
    uint32_t vertices;
    /* Streams of the file, with all weights 0 and no pose; then the streams of the mesh, which are filled. NULL:
     * none. */
    const float *rest_positions;
    const int16_t *rest_normals, *rest_tangents;
    float *positions;
    int16_t *normals, *tangents;
    /* Offsets of each target, 3 numbers per vertex, by stream; NULL: no offsets. */
    uint32_t targets;
    const float **add[SHAPE_STREAMS];
    const double *weights;    /* one per target, used if there is no track */
    const model_track *track; /* all weights at each key; NULL: not animated */
    /* The skin; joints 0: no skin. */
    uint32_t joints, influences; /* influences: per vertex */
    const uint32_t *joint_node;  /* of the motion */
    const double (*bind)[16];
    const uint16_t *joint;       /* by vertex and influence */
    const float *weight;
} model_shape;

/* All shapes of a motion. `weights` and `matrices` have room for the largest numbers of targets and joints of any
 * shape. */
struct model_shapes {
    model_shape *shape;
    uint32_t count;
    double *weights;
    double (*matrices)[16];
};

/* model_pose_shapes: fills the streams of all meshes that change shape, for a given time. Call model_pose for that
 * time first, and raise the revisions of those instances before you draw them. Cost: a pass over their vertices and
 * targets. */
void model_pose_shapes(const model *of, double time_s);

#endif
