/* path.h: an independent path tracer in binary64 for truth of small scenes: direct light is exact, bounced light is
 * sampled. It shares no code with src/ or tools/.
 *
 * Surfaces are Lambertian and two-sided; lights are points, spots, suns and emitting triangles, as in scenes.h. Results
 * are radiance towards the eye, W/(sr m2), red, green, blue. */
#ifndef PATH_H
#define PATH_H

#include "../scenes/scenes.h"
#include "../test.h"

typedef struct path_triangle {
    svec a, u, v; /* a corner, and the edges from it */
    svec normal;
    int material;
} path_triangle;

/* Depth first: the first child follows its parent; a ray that misses a node continues at `skip`. */
typedef struct path_node {
    svec low, high;
    uint32_t first, count, skip; /* count 0: an inner node */
} path_node;

typedef struct path_tracer {
    const made_scene *scene;
    path_triangle *triangles;
    path_node *nodes;
    double *emitter_area; /* running sum of the area of emitters, m2 */
    uint32_t *emitters;
    uint32_t count, node_count, emitter_count;
} path_tracer;

/* A point on a surface; the normal is on the side that the ray came from. */
typedef struct path_point {
    svec at, normal;
    int material;
} path_point;

/* path_open: returns 1, or 0 if there is no memory. The scene stays in use until path_close. */
int path_open(path_tracer *p, const made_scene *scene);
void path_close(path_tracer *p);

/* path_eye: the point seen at the middle of pixel x, y of side x side, y from the top. Returns 0 if there is none. */
int path_eye(const path_tracer *p, path_point *out, int x, int y, int side);

/* path_hit: the first surface along a ray; returns 0 if there is none. path_sees: whether the way is free up to
 * a distance `far`, except for a small epsilon. path_scattered: cosine-distributed directions around the
 * normal, from u, v in 0 .. 1. */
int path_hit(const path_tracer *p, path_point *out, svec from, svec along);
int path_sees(const path_tracer *p, svec from, svec along, double far);
svec path_scattered(svec normal, double u, double v);

/* path_arrives: irradiance divided by a light's intensity, 0 if blocked. path_add_emitted: samples one random point of
 * all emitters and adds the reflected radiance to rgb, weighted for all emitters. */
double path_arrives(const path_tracer *p, const scene_light *l, const path_point *from);
void path_add_emitted(const path_tracer *p, const path_point *from, double u, double v, test_rng *r, double rgb[3]);

/* path_direct: the reflected radiance of direct light from points, spots and suns. Exact. */
void path_direct(const path_tracer *p, const path_point *at, double rgb[3]);

/* path_bounced: the reflected radiance of light that was reflected 1 .. `bounces` times before, and of direct light
 * from emitters. Traces `strata` x `strata` paths. */
void path_bounced(const path_tracer *p, const path_point *at, int bounces, int strata, test_rng *random, double rgb[3]);

#endif
