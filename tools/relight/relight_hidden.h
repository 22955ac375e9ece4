/* relight_hidden.h: what an object hides from its own vertices and from the ground below it, by direction: found once. */
#ifndef RELIGHT_HIDDEN_H
#define RELIGHT_HIDDEN_H

#include "relight_figures.h"

enum {
    HIDDEN_MAPS = 2,   /* of the ground around an object: a wide one, and one of what is near */
    HIDDEN_SIDE = 128, /* their texels */
    HIDDEN_RAYS = 4,   /* of a direction, each with a shadow of its own on the ground */
    HIDDEN_SHARES = 4  /* samples that a vertex takes its light from */
};

#define HIDDEN_LOWEST 0.05f /* sine of the height from which on light throws shadows on the ground */

/* Texels from .. to of a row of the ground lie in the shadow of a region. */
typedef struct hidden_run {
    uint8_t row, from, to, region;
} hidden_run;

typedef struct hidden_runs {
    hidden_run *run;
    uint32_t count, cap;
} hidden_runs;

/* Samples that stand for a vertex, and how much of each. */
typedef struct hidden_share {
    uint32_t sample[HIDDEN_SHARES];
    float weight[HIDDEN_SHARES]; /* sum to 1 */
} hidden_share;

/* The samples' own triangles: they throw the shadows of an object with many. count 0: the object throws its own. */
typedef struct hidden_proxy {
    uint32_t (*key)[3];
    float *corners;   /* 9 a triangle */
    uint32_t *source; /* by triangle: one of the object's */
    uint8_t *region;  /* by triangle */
    uint32_t count;
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
} hidden_proxy;

/* A part of the object: places are from the middle of its box's bottom, m. Flat surfaces meet at vertices with other
 * light, so their corners are vertices of their own in `mesh`. */
typedef struct hidden_part {
    lmb_mesh mesh;
    void *memory;
    lmb_vec3 *at, *normal;                 /* by vertex: a little off the surface; unit */
    uint32_t samples, *vertex_of;          /* the vertices that are sampled; NULL: all are */
    hidden_share *share;                   /* by vertex; NULL: each is its own sample */
    float *open;                           /* by sample: the part of light from everywhere that reaches it */
    uint64_t (*blocked)[LMB_PROBE_TEXELS]; /* by 64 samples and direction: a bit each */
} hidden_part;

/* A part of the ground, from the figure's foot, and the runs in it by direction and ray. */
typedef struct hidden_map {
    float wide, deep, corner_x, corner_z; /* m */
    int fades;                            /* towards its edges, where no wider one is */
    uint32_t first[LMB_PROBE_TEXELS * HIDDEN_RAYS + 1];
    hidden_runs runs;
} hidden_map;

/* What one thread draws shadows with. */
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
    lmb_vec3 middle; /* of its box */
    float radius;    /* of a sphere around that, m */
    float height;    /* m: of the object over the ground */
    int has_ground;
    hidden_map map[HIDDEN_MAPS];
    float lift;               /* m: of vertices off their surface */
    hidden_proxy proxy;
    const uint8_t *region_of; /* by triangle that throws a shadow */
    lmb_scene scene; /* the object, its foot at 0, 0, 0: all figures alike */
    lmb_scene thrown; /* what throws shadows: the same, or the proxy */
    lmb_bvh bvh;     /* of it */
    lmb_instance *instances;
    void *memory;
    int threads;
    hidden_hand *hand; /* by thread */
    lmb_traversal traversal;
} hidden;

/* hidden_make: of the first figure's own vertices, where they are not known yet. hidden_ground: of the ground so far
 * below it, where it is not known. hidden_shadow: add the runs of one more direction in a map; `ray` moves the texels
 * by a quarter. 1, or 0: out of memory. hidden_coarse: sights so far that are coarser, as too many triangles cross. */
int hidden_make(hidden *inout, const figures *f, const relight_options *o, const float *directions);
int hidden_ground(hidden *inout, const figures *f, const relight_options *o, float height);
int hidden_shadow(hidden *inout, int map, hidden_runs *runs, const relight_options *o, lmb_vec3 to, int ray);
uint32_t hidden_coarse(const hidden *h);

/* A traversal for the next tile: so many tests, and the sights that were coarser before. */
void hidden_bound(lmb_traversal *inout);

/* The vertex of a sample; and a sample of a vertex, the i-th, with its weight: 0 for those that it lacks. */
uint32_t hidden_sampled(const hidden_part *p, uint32_t sample);
float hidden_shared(uint32_t *sample, const hidden_part *p, uint32_t vertex, int i);

/* Where a figure stands: the middle of its box's bottom. */
lmb_vec3 hidden_foot(const figures *f, uint32_t figure);

/* The vertex of a mesh's corner; the product of two directions. */
uint32_t hidden_vertex(const lmb_mesh *m, uint32_t corner);
float hidden_dot(lmb_vec3 a, lmb_vec3 b);

void hidden_free(hidden *h);

#endif
