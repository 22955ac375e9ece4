/* path.h: a path tracer of its own in binary64, for truth of small scenes: exact where light arrives straight, by random
 * directions where it bounces. It shares no code with src/ or tools/.
 *
 * Surfaces are Lambertian and have two sides; lights are points, spots, suns and emitting triangles, as in scenes.h. What
 * it gives is radiance towards the eye, W/(sr m2), red, green, blue. */
#ifndef PATH_H
#define PATH_H

#include "../scenes/scenes.h"
#include "../test.h"

typedef struct path_triangle {
    svec a, u, v; /* a corner, and the edges from it */
    svec normal;
    int material;
} path_triangle;

/* Depth first: the next node is the first child; `skip` is where a ray that misses it goes on. */
typedef struct path_node {
    svec low, high;
    uint32_t first, count, skip; /* count 0: an inner node */
} path_node;

typedef struct path_tracer {
    const made_scene *scene;
    path_triangle *triangles;
    path_node *nodes;
    double *emitter_area; /* of all emitters up to this one, m2 */
    uint32_t *emitters;
    uint32_t count, node_count, emitter_count;
} path_tracer;

/* A place on a surface; the normal is on the side that the ray came from. */
typedef struct path_point {
    svec at, normal;
    int material;
} path_point;

/* path_open: 1, or 0 without memory. The scene stays in use until path_close. */
int path_open(path_tracer *p, const made_scene *scene);
void path_close(path_tracer *p);

/* path_eye: what is seen at the middle of pixel x, y of side x side, y from the top; 0 where nothing is. */
int path_eye(const path_tracer *p, path_point *out, int x, int y, int side);

/* path_hit: the first surface along a ray; 0 where there is none. path_sees: nothing between a place and what lies that
 * far off, less a hair. path_scattered: directions by the cosine to the normal, from u, v in 0 .. 1. */
int path_hit(const path_tracer *p, path_point *out, svec from, svec along);
int path_sees(const path_tracer *p, svec from, svec along, double far);
svec path_scattered(svec normal, double u, double v);

/* path_arrives: irradiance over a light's intensity, as far as nothing blocks it. path_add_emitted: added to rgb is what
 * a place reflects of what comes straight from one random place of all emitters, as if all emitters were there. */
double path_arrives(const path_tracer *p, const scene_light *l, const path_point *from);
void path_add_emitted(const path_tracer *p, const path_point *from, double u, double v, test_rng *r, double rgb[3]);

/* path_direct: what a place reflects of light that comes straight from points, spots and suns. Exact. */
void path_direct(const path_tracer *p, const path_point *at, double rgb[3]);

/* path_bounced: what it reflects of light that was reflected 1 .. `bounces` times before, and of what emitters send
 * straight. `strata` x `strata` paths. */
void path_bounced(const path_tracer *p, const path_point *at, int bounces, int strata, test_rng *random, double rgb[3]);

#endif
