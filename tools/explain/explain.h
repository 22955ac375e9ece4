/* explain.h: why a pixel has its light: its surface, each light with the geometry that blocks it, and the surfaces
 * that send bounced light to it. */
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "../common/report.h"
#include "../render/ray_space.h"
#include "../render/render_job.h"

enum {
    EXPLAIN_RAYS = 4096,   /* over the half sphere above the surface */
    EXPLAIN_SENDERS = 5,   /* instances listed, the largest senders first */
    EXPLAIN_LIGHTS = 16,   /* lights listed, the brightest first */
    EXPLAIN_TREE = 2048,   /* lights that light the hit of a ray */
    EXPLAIN_SKY = 256      /* pieces of the sky that light the hit of a ray */
};

/* A scene to trace. explain_space_free releases it. */
typedef struct explain_space {
    ray_space rays;
    const lmb_light *sky; /* pieces of a sky, all directional; not among the scene's lights */
    uint32_t sky_count;
    const lmb_kernels *kernels;
    lmb_traversal traversal;
    lmb_tile *tile; /* points whose lights are tested together */
} explain_space;

/* A point on a surface. */
typedef struct explain_place {
    lmb_vec3 at, face, normal; /* m; unit, towards the viewer: of the triangle, and for shading */
    float depth;               /* m: length of the ray that found `at` */
    float noise;               /* m: rounding of `at`; lmb_place_noise */
    uint32_t id;               /* of its triangle */
} explain_place;

/* The light that one light source adds at a place. */
typedef struct explain_light {
    uint32_t number;        /* in scene->lights */
    float open[3];          /* W/m2, as if nothing blocked it */
    float angle_deg;        /* between the shading normal and the direction to the light */
    float far_m;            /* distance of the light; directional: 0 */
    float blocker_m;        /* distance of the nearest triangle before it */
    uint32_t blocker;       /* id of that triangle; 0: none was found */
    int is_behind, is_blocked;
} explain_light;

/* The light that one instance reflects once, or emits, towards a place. */
typedef struct explain_sender {
    uint32_t instance;
    double irradiance[3], emitted[3]; /* W/m2 at the place: in all, and of that by emission */
    float near_m, far_m;              /* distances at which rays hit it */
} explain_sender;

/* The light that arrives at a place after one bounce: the sum over EXPLAIN_RAYS cosine-distributed rays. */
typedef struct explain_bounce {
    double irradiance[3]; /* W/m2 */
    uint32_t missed;      /* rays that leave the scene */
    uint32_t dark;        /* rays that hit a surface that sends nothing */
    explain_sender *sender; /* by instance at first; then the largest come first */
    uint32_t senders;       /* that send something */
} explain_bounce;

/* explain_space_make: 1, or 0 with `r` set. */
int explain_space_make(explain_space *out, const lmb_scene *scene, const lmb_kernels *kernels, report *r);
void explain_space_free(explain_space *s);

/* explain_light_at: a light's irradiance at a place as if nothing blocked it, W/m2, for a surface with this normal.
 * Returns the direction to the light; *far_m: its distance, 0 for a directional light. */
lmb_vec3 explain_light_at(float out[3], float *far_m, const lmb_light *light, lmb_vec3 at, lmb_vec3 normal);

/* explain_lights: all lights of the scene at a place, into `out`, which has room for scene->light_count. */
void explain_lights(explain_light *out, explain_space *s, const explain_place *p);

/* explain_sky: the sky's irradiance at a place, W/m2: in all, and of the pieces that nothing blocks. */
void explain_sky(double open[3], double seen[3], explain_space *s, const explain_place *p);

/* explain_gather: the bounced light of a place. out->sender has room for scene->instance_count. */
void explain_gather(explain_bounce *out, explain_space *s, const explain_place *p);

#endif
