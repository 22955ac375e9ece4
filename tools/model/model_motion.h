/* model_motion.h: the animations of a file: transforms of the scene's nodes at a time. */
#ifndef MODEL_MOTION_H
#define MODEL_MOTION_H

#include "model.h"

/* Transform of a node relative to the parent: translation, rotation (x, y, z, w) and scale, or a matrix. */
typedef struct model_local {
    double t[3], q[4], s[3], matrix[16];
    int is_matrix;
} model_local;

enum { MODEL_TRANSLATION, MODEL_ROTATION, MODEL_SCALE, MODEL_WEIGHTS };
enum { MODEL_STEP, MODEL_LINEAR, MODEL_CUBIC };

/* The keys of a node's translation, rotation or scale, or of all morph weights. */
typedef struct model_track {
    uint32_t node;
    int what, between;
    uint32_t count;     /* of the keys */
    const float *time;  /* s, rising */
    const float *value; /* 3, 4 or the number of targets per key; MODEL_CUBIC: in-tangent, value, out-tangent */
} model_track;

#define MODEL_NONE UINT32_MAX

/* Nodes are those of the scene, parents first. */
struct model_motion {
    uint32_t nodes, tracks;
    const uint32_t *parent; /* MODEL_NONE: none */
    const model_local *rest;
    const model_track *track;
    const uint32_t *of_instance, *of_light, *of_camera; /* the node of each; MODEL_NONE: never moves */
    uint8_t *moves;                                     /* a node: it or one above it has a track */
    double (*world)[16], (*turn)[16];                   /* scratch of model_pose */
    double end_s;                                       /* the last key */
    struct model_shapes *shapes;                        /* see model_shape.h; NULL: no mesh changes shape */
    const uint8_t *reshapes;                            /* by instance: 1 if the mesh changes shape; NULL: none does */
};

/* model_track_at: writes the `size` numbers of a track at a time: the first value before the first key, and the last
 * value after the last key. */
void model_track_at(double *out, const model_track *t, double time_s, int size);

/* model_pose: writes the instances, lights and cameras at a time to arrays with room for all of the model; only
 * moving items are written. Before the first key and after the last key, the first and last values apply. Returns 1,
 * or 0 if a transform is invalid: a rotation without length, or numbers beyond the range of float. */
int model_pose(lmb_instance *instances, lmb_light *lights, model_camera *cameras, const model *of, double time_s);

/* model_compose: makes a column-major matrix. Returns 0 if the rotation has no length. model_compose_turn: uses only
 * rotation and mirroring, so the result is valid for a scale of 0. For a matrix it makes orthonormal axes. */
int model_compose(double out[16], const model_local *l);
int model_compose_turn(double out[16], const model_local *l);
void model_multiply(double out[16], const double a[16], const double b[16]);

/* Set the position and direction of a light, or the position and axes of a camera, from the world matrix of the node.
 * If a scale of 0 leaves no direction in that matrix, the product of turns is used. */
void model_place_light(lmb_light *inout, const double world[16], const double turn[16]);
void model_place_camera(model_camera *inout, const double world[16], const double turn[16]);

#endif
