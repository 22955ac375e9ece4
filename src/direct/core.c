/* core.c: finds a scene's fine detail: the boxes for which a sun's map gets faces of their own. Layer 4.
 *
 * The triangles that are small against the scene have a centre, weighted by area, and a mean distance from it.
 * Triangles over three times as far are dropped and both values recomputed, until none is dropped: a stray triangle has
 * no effect, however far it is. The size limits are 1/2, 1/8, .. 1/512 of the scene. The first limit finds the part
 * that contains nearly everything (`wide`). The others find a house on a terrain, which may contain a finer place
 * again. Geometry that touches such a box and is at most four times as large joins it: floors, walls, the ground before
 * the door.
 *
 * The boxes depend only on the scene, not on the view: the maps stay while the viewer moves, and two eyes see the same
 * light. Rejected: medians of counts, in which a far bird of 200 triangles wins against a room of 30. */
#include <lambent/map.h>

#include <string.h>

#include "../base/vec.h"
#include "../raster/triangle.h"

#if LMB_TREES

#define MAX_MEAN_DISTANCES 3.0   /* times the mean distance from the centre: limit of members */
#define MAX_TOUCHING_SIZE  4.0f  /* times the box's size: limit for geometry that touches it and joins it */
#define MAX_SPARE_AREA     0.015625f /* share of the area that `wide` may leave out */
#define MAX_FINER_SHARE    0.0125f /* of a face's width: a place with under 13 of 1,024 texels gets a face */
enum {
    MAX_CLUMP_ROUNDS = 8,
    MAX_SIZE_LIMITS = 5,
    MAX_FINER_CORES = 3,
    MAX_SAMPLE_TRIANGLES = 8192,
    MAX_FACE_RATIO = 16,
    MIN_CLUMP_TRIANGLES = 2
};

typedef struct core_box {
    lmb_vec3 low, high;
} core_box;

static float size_of_box(const core_box *b) { return largest3(sub3(b->high, b->low)); }

static void join_core_box(core_box *inout, const core_box *b)
{
    inout->low = min3(inout->low, b->low);
    inout->high = max3(inout->high, b->high);
}

static int overlap(const core_box *a, const core_box *b)
{
    return a->low.x <= b->high.x && a->low.y <= b->high.y && a->low.z <= b->high.z && b->low.x <= a->high.x &&
           b->low.y <= a->high.y && b->low.z <= a->high.z;
}

static int take_triangle(core_box *b, float *area, const lmb_scene *scene, uint32_t id)
{
    lmb_triangle t;
    lmb_vec3 normal;
    if (!lmb_triangle_fetch(&t, scene, id) || !lmb_triangle_shape(&normal, area, &t)) {
        return 0;
    }
    b->low = min3(min3(t.corner[0], t.corner[1]), t.corner[2]);
    b->high = max3(max3(t.corner[0], t.corner[1]), t.corner[2]);
    return 1;
}

/* Triangles below a size, in a box, near a centre. */
typedef struct clump {
    core_box in;
    float under;
    double at[3], reach; /* m */
    uint32_t count;
} clump;

static double distance_from(const clump *c, const core_box *b)
{
    const double x = 0.5 * ((double)b->low.x + (double)b->high.x) - c->at[0],
                 y = 0.5 * ((double)b->low.y + (double)b->high.y) - c->at[1],
                 z = 0.5 * ((double)b->low.z + (double)b->high.z) - c->at[2];
    const float d = (float)(x * x + y * y + z * z);
    return (double)sqrtf(d);
}

static int belongs(const clump *c, const core_box *b)
{
    return size_of_box(b) < c->under && overlap(b, &c->in) && distance_from(c, b) <= c->reach;
}

/* Sums over the members: area, and area times centre; or, in sum[1], area times distance. */
static uint32_t clump_sums(double sum[4], const clump *c, const lmb_scene *scene, uint32_t step, int distances)
{
    const uint32_t all = lmb_scene_triangles(scene);
    uint32_t count = 0;
    sum[0] = sum[1] = sum[2] = sum[3] = 0.0;
    for (uint32_t id = 1; id <= all && id >= 1; id += step) {
        core_box b;
        float area;
        if (take_triangle(&b, &area, scene, id) && belongs(c, &b)) {
            const double w = 0.5 * (double)area;
            ++count;
            sum[0] += (double)area;
            if (distances) {
                sum[1] += (double)area * distance_from(c, &b);
            } else {
                sum[1] += w * ((double)b.low.x + (double)b.high.x);
                sum[2] += w * ((double)b.low.y + (double)b.high.y);
                sum[3] += w * ((double)b.low.z + (double)b.high.z);
            }
        }
    }
    return count;
}

/* Finds the centre of the triangles below a size. Returns 0 if there are almost none. */
static int find_clump(clump *c, const lmb_scene *scene, uint32_t step)
{
    double sum[4];
    c->at[0] = c->at[1] = c->at[2] = 0.0;
    c->reach = 1e30;
    c->count = 0;
    for (int round = 0; round < MAX_CLUMP_ROUNDS; ++round) {
        const uint32_t before = c->count;
        c->count = clump_sums(sum, c, scene, step, 0);
        if (c->count < MIN_CLUMP_TRIANGLES || !(sum[0] > 0.0)) {
            return 0;
        }
        if (c->count == before) {
            return 1;
        }
        for (int i = 0; i < 3; ++i) {
            c->at[i] = sum[1 + i] / sum[0];
        }
        clump_sums(sum, c, scene, step, 1);
        c->reach = MAX_MEAN_DISTANCES * sum[1] / sum[0];
    }
    return 1;
}

/* The clump's own box, then joined with geometry that touches it. in, rest: area in c->in that is inside `out`, and
 * outside. */
static void box_of_clump(core_box *out, float *in, float *rest, const clump *c, const lmb_scene *scene)
{
    const uint32_t all = lmb_scene_triangles(scene);
    core_box own = {{3e38f, 3e38f, 3e38f}, {-3e38f, -3e38f, -3e38f}}, b;
    float area;
    double inside = 0.0, outside = 0.0;
    for (uint32_t id = 1; id <= all; ++id) {
        if (take_triangle(&b, &area, scene, id) && belongs(c, &b)) {
            join_core_box(&own, &b);
        }
    }
    const float max = MAX_TOUCHING_SIZE * size_of_box(&own);
    *out = own;
    for (uint32_t id = 1; id <= all; ++id) {
        if (take_triangle(&b, &area, scene, id) && overlap(&b, &own) && size_of_box(&b) <= max) {
            join_core_box(out, &b);
        }
    }
    for (uint32_t id = 1; id <= all; ++id) {
        if (take_triangle(&b, &area, scene, id) && overlap(&b, &c->in)) {
            const double held = overlap(&b, out) ? (double)minf(area, 2.0f * size_of_box(out) * size_of_box(out)) : 0.0;
            inside += held;
            outside += (double)area - held;
        }
    }
    *in = (float)inside;
    *rest = (float)outside;
}

static uint32_t step_of_samples(const lmb_scene *scene)
{
    return lmb_scene_triangles(scene) / MAX_SAMPLE_TRIANGLES + 1;
}

/* The box that contains nearly everything: at most half the scene's size, or the scene itself. */
static void find_wide(core_box *inout, const lmb_scene *scene)
{
    clump c;
    core_box b;
    float in, rest;
    c.in = *inout;
    c.under = 0.5f * size_of_box(inout);
    if (find_clump(&c, scene, step_of_samples(scene))) {
        box_of_clump(&b, &in, &rest, &c, scene);
        *inout = size_of_box(&b) <= 0.5f * size_of_box(inout) && rest <= MAX_SPARE_AREA * in ? b : *inout;
    }
}

/* A place in a box, no wider than an eightieth of the box. Returns 0 if there is none. */
static int find_finer(core_box *inout, const lmb_scene *scene)
{
    clump c;
    float limit = 0.5f * size_of_box(inout), in, rest;
    c.in = *inout;
    for (int i = 0; i < MAX_SIZE_LIMITS; ++i, limit *= 0.25f) {
        core_box b;
        c.under = limit;
        if (!find_clump(&c, scene, step_of_samples(scene))) {
            return 0;
        }
        if (c.reach < (double)(size_of_box(inout) * MAX_FINER_SHARE)) {
            box_of_clump(&b, &in, &rest, &c, scene);
            if (size_of_box(&b) <= size_of_box(inout) * MAX_FINER_SHARE) {
                *inout = b;
                return 1;
            }
        }
    }
    return 0;
}

/* Number of steps by MAX_FACE_RATIO, rounded up, from one size to another. */
static int steps_between(float small, float large)
{
    int n = 0;
    for (; small < large && n < LMB_CORE_FACES; small *= (float)MAX_FACE_RATIO) {
        ++n;
    }
    return n;
}

static int is_box_between(const core_box *b, lmb_vec3 low, lmb_vec3 high)
{
    return memcmp(&b->low, &low, sizeof low) == 0 && memcmp(&b->high, &high, sizeof high) == 0;
}

void lmb_scene_core(lmb_core *out, const lmb_scene *scene)
{
    core_box wide, core;
    if (out == NULL) {
        return;
    }
    memset(out, 0, sizeof *out);
    if (scene == NULL || scene->instances == NULL || scene->meshes == NULL) {
        return;
    }
    wide.low = scene->bounds_min;
    wide.high = scene->bounds_max;
    find_wide(&wide, scene);
    core = wide;
    for (int i = 0; i < MAX_FINER_CORES && find_finer(&core, scene); ++i) {
    }
    const int beyond = !is_box_between(&wide, scene->bounds_min, scene->bounds_max);
    const int within = 1 + steps_between(size_of_box(&core), size_of_box(&wide));
    if (beyond + within > 1 && size_of_box(&core) > 0.0f) {
        out->low = core.low;
        out->high = core.high;
        out->wide_low = wide.low;
        out->wide_high = wide.high;
        out->faces = mini(beyond + within, LMB_CORE_FACES);
    }
}

#endif
