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

/* path_direct: what a place reflects of light that comes straight from points, spots and suns. Exact. */
void path_direct(const path_tracer *p, const path_point *at, double rgb[3]);

/* path_bounced: what it reflects of light that was reflected 1 .. `bounces` times before, and of what emitters send
 * straight. `strata` x `strata` paths. */
void path_bounced(const path_tracer *p, const path_point *at, int bounces, int strata, test_rng *random, double rgb[3]);

#endif
