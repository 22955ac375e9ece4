/* relight_hidden.h: directions that an object blocks for vertices and for the ground, computed once. */
#ifndef RELIGHT_HIDDEN_H
#define RELIGHT_HIDDEN_H

#include "relight_figures.h"

enum {
    HIDDEN_MAPS = 2,   /* of the ground around an object: a wide one, and a finer one close to it */
    HIDDEN_SIDE = 128, /* texels of a map's side */
    HIDDEN_RAYS = 4,   /* per direction, each with a separate shadow on the ground */
    HIDDEN_SHARES = 4  /* samples that a vertex interpolates */
};

#define HIDDEN_LOWEST 0.05f /* sine of the minimum elevation of lights that cast shadows on the ground */

/* Texels from .. to of a row of the ground are shadowed by a region. */
typedef struct hidden_run {
    uint8_t row, from, to, region;
} hidden_run;

typedef struct hidden_runs {
    hidden_run *run;
    uint32_t count, cap;
} hidden_runs;

/* The samples and weights of a vertex. */
typedef struct hidden_share {
    uint32_t sample[HIDDEN_SHARES];
    float weight[HIDDEN_SHARES]; /* sum to 1 */
} hidden_share;

/* A mesh of the samples, which casts the shadows of an object with many triangles. count 0: the object casts them. */
typedef struct hidden_proxy {
    uint32_t (*key)[3];
    float *corners;   /* 9 per triangle */
    uint32_t *source; /* by triangle: one of the object's */
    uint8_t *region;  /* by triangle */
    uint32_t count;
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
} hidden_proxy;

/* A part of the object; positions are relative to the middle of the object's bottom, m. A flat-shaded mesh is split
 * into separate vertices per corner, because each face receives other light. */
typedef struct hidden_part {
    lmb_mesh mesh;
    void *memory;
    lmb_vec3 *at, *normal;                 /* by vertex: slightly above the surface; unit */
    uint32_t samples, *vertex_of;          /* the vertices that are sampled; NULL: all */
    hidden_share *share;                   /* by vertex; NULL: each vertex is a sample */
    float *open;                           /* by sample: the unoccluded share of uniform light */
    uint64_t (*blocked)[LMB_PROBE_TEXELS]; /* by 64 samples and direction: a bit each */
} hidden_part;

/* A part of the ground, relative to the figure's foot, and runs by direction and ray. */
typedef struct hidden_map {
    float wide, deep, corner_x, corner_z; /* m */
    int fades;                            /* fades out at the edges, because no wider map follows */
    uint32_t first[LMB_PROBE_TEXELS * HIDDEN_RAYS + 1];
    hidden_runs runs;
} hidden_map;

/* Memory of one thread for drawing shadows. */
typedef struct hidden_hand {
    lmb_surface depth, id;
    lmb_instance *sheared;
    hidden_runs runs;
    lmb_traversal traversal;
    void *memory[2];
    int failed;
} hidden_hand;

typedef struct hidden {
    hidden_part *part;
    uint32_t parts;
    lmb_vec3 middle; /* of the box */
    float radius;    /* of a sphere around that, m */
    float height;    /* m: of the object over the ground */
    int has_ground;
    hidden_map map[HIDDEN_MAPS];
    float lift;               /* m: of vertices above the surface */
    hidden_proxy proxy;
    const uint8_t *region_of; /* by triangle that casts a shadow */
    lmb_scene scene; /* the object with the foot at 0, 0, 0; the same for all figures */
    lmb_scene thrown; /* shadow casters: the same, or the proxy */
    lmb_bvh bvh;     /* of the object */
    lmb_instance *instances;
    void *memory;
    int threads;
    hidden_hand *hand; /* by thread */
    lmb_traversal traversal;
} hidden;

/* hidden_make: computes self-occlusion of the first figure, once. hidden_ground: computes the ground's occlusion for an
 * object at this height, if not done. hidden_shadow: adds the runs of one more direction to a map; `ray` offsets the
 * texels by a quarter. They return 1, or 0 if memory is short. hidden_coarse: the number of tests so far with coarser
 * visibility, because too many triangles intersect. */
int hidden_make(hidden *inout, const figures *f, const relight_options *o, const float *directions);
int hidden_ground(hidden *inout, const figures *f, const relight_options *o, float height);
int hidden_shadow(hidden *inout, int map, hidden_runs *runs, const relight_options *o, lmb_vec3 to, int ray);
uint32_t hidden_coarse(const hidden *h);

/* Prepares a traversal for the next tile: resets the test limit, keeps the count of coarser tests. */
void hidden_bound(lmb_traversal *inout);

/* The vertex of a sample; the i-th sample of a vertex and the weight, 0 if there are fewer. */
uint32_t hidden_sampled(const hidden_part *p, uint32_t sample);
float hidden_shared(uint32_t *sample, const hidden_part *p, uint32_t vertex, int i);

/* The place of a figure: the middle of the box's bottom. */
lmb_vec3 hidden_foot(const figures *f, uint32_t figure);

/* The vertex of a mesh's corner; the dot product. */
uint32_t hidden_vertex(const lmb_mesh *m, uint32_t corner);
float hidden_dot(lmb_vec3 a, lmb_vec3 b);

void hidden_free(hidden *h);

#endif
