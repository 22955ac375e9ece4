/* test_probe.c: worlds seen from other places, and their irradiance. Requirements S1-S14, S25. */
#include <lambent/lambent.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../src/probe/cube.h"
#include "../../src/probe/world.h"
#include "../test.h"

void test_probe(void);

enum { FACE = 64, GROUND = 32, WIDTH = 128, HEIGHT = 64, COUNT = WIDTH * HEIGHT, CUBE = 8 };
enum { CUBE_TEXELS = 6 * CUBE * CUBE };

/* --- a world of formulas ------------------------------------------------------------------------------------------ */

typedef struct stage {
    float face[6][FACE * FACE * 3], ground[GROUND * GROUND * 4], cube[3 * CUBE_TEXELS];
    float map[3 * COUNT], other[3 * COUNT];
    lmb_world_pictures pictures;
    lmb_world world;
    lmb_probe_table table;
    lmb_probe_lights lights;
    void *world_memory, *table_memory;
} stage;

/* Smooth, and different in each direction. */
static float sky(int c, lmb_vec3 d)
{
    const float x = d.x, y = d.y, z = d.z;
    return c == 0   ? 1.0f + 0.5f * x + 0.25f * y * z
           : c == 1 ? 0.8f + 0.3f * z - 0.2f * x * y
                    : 0.6f - 0.3f * y + 0.2f * x * z;
}

static void paint_sky(stage *s)
{
    for (int i = 0; i < 6 * FACE * FACE; ++i) {
        const int face = i / (FACE * FACE), at = i % (FACE * FACE);
        const lmb_vec3 d = cube_direction(face, at % FACE, at / FACE, FACE);
        for (int c = 0; c < 3; ++c) {
            s->face[face][3 * at + c] = sky(c, d);
        }
    }
}

static stage *stage_make(void)
{
    stage *s = calloc(1, sizeof *s);
    if (s == NULL) {
        abort();
    }
    paint_sky(s);
    for (int i = 0; i < 6; ++i) {
        s->pictures.face[i] = s->face[i];
    }
    s->pictures.face_size = FACE;
    s->pictures.radius = 50.0f;
    s->pictures.centre = vec3(0.0f, 1.5f, 0.0f);
    s->pictures.middle = s->pictures.centre;
    s->table_memory = malloc(lmb_probe_table_bytes(WIDTH, HEIGHT));
    const size_t bytes = lmb_probe_table_bytes(WIDTH, HEIGHT);
    CHECK(lmb_probe_table_init(&s->table, WIDTH, HEIGHT, -180.0f, s->table_memory, bytes) == LMB_OK);
    return s;
}

static lmb_status make_world(stage *s, int32_t format)
{
    const size_t bytes = lmb_world_bytes(&s->pictures, format);
    free(s->world_memory);
    s->world_memory = malloc(bytes);
    return lmb_world_init(&s->world, &s->pictures, format, s->world_memory, bytes);
}

static void stage_free(stage *s)
{
    free(s->world_memory);
    free(s->table_memory);
    free(s);
}

static lmb_vec3 direction_of(const stage *s, int k)
{
    const uint16_t *d = s->table.direction + k;
    return vec3((float)d[0] * (2.0f / 65535.0f) - 1.0f, (float)d[COUNT] * (2.0f / 65535.0f) - 1.0f,
                (float)d[2 * COUNT] * (2.0f / 65535.0f) - 1.0f);
}

static void see_from(stage *s, lmb_vec3 at, int32_t blend)
{
    CHECK(lmb_probe_remap(s->map, picked_kernels(), &s->world, &s->table, at, blend) == LMB_OK);
}

/* --- codes -------------------------------------------------------------------------------------------------------- */

/* S4: decoding is within a step of the code over [0, 99]. */
static void log_codes(void)
{
    const float step[2] = {1.0f / 65535.0f, 1.0f / 255.0f};
    int within = 1, rises = 1;
    float last = -1.0f;
    for (int i = 0; i <= 9900; ++i) {
        const float c = 0.01f * (float)i, e = lmb_world_encode(c), back = lmb_world_decode(e);
        within &= fabsf(back - c) <= 2e-5f * (c + 0.101f);
        rises &= e > last;
        last = e;
        for (int k = 0; k < 2; ++k) {
            const float coded = floorf(e / step[k] + 0.5f) * step[k];
            within &= fabsf(lmb_world_decode(coded) - c) <= 2.302585f * 3.0f * step[k] * (c + 0.101f);
        }
    }
    CHECK(within && rises);
    CHECK(lmb_world_encode(-1.0f) == lmb_world_encode(0.0f) && lmb_world_encode(NAN) == lmb_world_encode(0.0f));
    CHECK(lmb_world_encode(1e30f) <= 1.0f && lmb_world_decode(2.0f) == lmb_world_decode(1.0f));
    CHECK(lmb_world_decode(NAN) < 1e-6f);
}

/* Stored codes: each within a step over 0 .. 99. */
static void stored_codes(stage *s)
{
    const float step[2] = {1.0f / 65535.0f, 1.0f / 255.0f};
    for (int i = 0; i < FACE * FACE; ++i) {
        s->face[0][3 * i] = s->face[0][3 * i + 1] = s->face[0][3 * i + 2] = 99.0f * (float)i / (float)(FACE * FACE - 1);
    }
    for (int k = 0; k < 2; ++k) {
        int within = 1;
        CHECK(make_world(s, LMB_WORLD_LOG16 + k) == LMB_OK);
        for (int i = 0; i < FACE * FACE; ++i) {
            float rgba[4];
            const float c = s->face[0][3 * i];
            lmb_world_texel(rgba, &s->world, (size_t)((i / FACE + 1) * (FACE + 2) + i % FACE + 1));
            within &= fabsf(rgba[1] - c) <= 2.302585f * 3.0f * step[k] * (c + 0.101f) && rgba[3] == 1.0f;
        }
        CHECK(within);
    }
    paint_sky(s);
}

/* For irradiance 16 harmonics equal 9, because the clamped cosine has no third band; 25 add the fourth, -1 / 48. */
static void bands(void)
{
    double third = 0.0, fourth = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double x = (i + 0.5) / 100000.0;
        third += x * (5.0 * x * x * x - 3.0 * x) / 2.0 / 100000.0;
        fourth += x * (35.0 * x * x * x * x - 30.0 * x * x + 3.0) / 8.0 / 100000.0;
    }
    CHECK(fabs(third) < 1e-9 && fabs(fourth + 1.0 / 48.0) < 1e-9);
}

/* --- one place ---------------------------------------------------------------------------------------------------- */

/* S6: from the centre, each direction shows the cube in this direction. */
static void identity(stage *s, int32_t format, float max)
{
    float worst = 0.0f;
    CHECK(make_world(s, format) == LMB_OK);
    see_from(s, s->pictures.centre, 0);
    for (int k = 0; k < COUNT; ++k) {
        for (int c = 0; c < 3; ++c) {
            worst = maxf(worst, fabsf(s->map[c * COUNT + k] - sky(c, direction_of(s, k))));
        }
    }
    CHECK_MSG(worst < max, "%g", (double)worst);
}

/* A centre close to the wall is valid and is not moved inwards. */
static void centre_by_the_wall(stage *s)
{
    const lmb_vec3 low = s->pictures.low, high = s->pictures.high, centre = s->pictures.centre;
    s->pictures.shape = LMB_WORLD_BOX;
    s->pictures.low = vec3(-50.0f, centre.y - 0.001f, -50.0f);
    s->pictures.high = vec3(50.0f, 30.0f, 50.0f);
    identity(s, LMB_WORLD_F32, 0.003f);
    s->pictures.low.x = -INFINITY;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_ERR_ARG);
    s->pictures.low = low;
    s->pictures.high = high;
    s->pictures.shape = LMB_WORLD_SPHERE;
}

typedef struct exact {
    double v[3];
} exact;

static exact exact_of(lmb_vec3 p)
{
    const exact e = {{(double)p.x, (double)p.y, (double)p.z}};
    return e;
}

static double exact_dot(exact a, exact b) { return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2]; }

/* Distance from o along r to the sphere or the box. */
static double shape_distance(const lmb_world_pictures *p, exact o, exact r)
{
    double t = 1e30;
    if (p->shape == LMB_WORLD_SPHERE) {
        const exact middle = exact_of(p->middle);
        const exact m = {{o.v[0] - middle.v[0], o.v[1] - middle.v[1], o.v[2] - middle.v[2]}};
        const double radius = (double)p->radius, a = exact_dot(r, r), b = exact_dot(m, r),
                     c = exact_dot(m, m) - radius * radius;
        return (-b + sqrt(b * b - a * c)) / a;
    }
    const exact low = exact_of(p->low), high = exact_of(p->high);
    for (int i = 0; i < 3; ++i) {
        const double wall = ((r.v[i] > 0 ? high.v[i] : low.v[i]) - o.v[i]) / r.v[i];
        t = wall < t ? wall : t;
    }
    return t;
}

/* The same, or the distance to the floor if the floor is nearer. */
static double far_distance(const lmb_world_pictures *p, exact o, exact r)
{
    const double far = shape_distance(p, o, r), floor = ((double)p->ground_y - o.v[1]) / r.v[1];
    return p->has_floor && r.v[1] < 0.0 && floor < far ? floor : far;
}

/* The far world's point in double precision. */
static lmb_vec3 far_point(const lmb_world_pictures *p, lmb_vec3 at, lmb_vec3 d)
{
    const exact o = exact_of(at), r = exact_of(d);
    const double t = far_distance(p, o, r);
    return vec3((float)(o.v[0] + t * r.v[0]), (float)(o.v[1] + t * r.v[1]), (float)(o.v[2] + t * r.v[2]));
}

/* S5 S6: from another place, a direction shows the far point that it meets, as the centre sees it. */
static void elsewhere(stage *s, lmb_vec3 at)
{
    float worst = 0.0f;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, at, 0);
    for (int k = 0; k < COUNT; ++k) {
        const lmb_vec3 q = far_point(&s->pictures, at, direction_of(s, k));
        for (int c = 0; c < 3; ++c) {
            worst = maxf(worst, fabsf(s->map[c * COUNT + k] - sky(c, normalize3(sub3(q, s->pictures.centre)))));
        }
    }
    CHECK_MSG(worst < 0.006f, "%g", (double)worst);
}

/* A lamp below the horizon lies on the floor: unchanged from the centre, larger from nearby. */
static void lamp_on_floor(stage *s)
{
    const lmb_vec3 centre = s->pictures.centre, down = vec3(0.6f, -0.8f, 0.0f);
    const lmb_world_peak lamp = {{0.6f, -0.8f, 0.0f}, {1, 1, 1}, 1e-4f, 0, 0, 0, 0};
    lmb_world_job job;
    lmb_vec3 to;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    lmb_world_ask(&job, &s->world, LMB_WORLD_ALL, 0.01f, 0);
    const float there = lmb_world_see_peak(&to, &job, &s->world, &lamp, centre);
    CHECK(fabsf(there - 1.0f) < 1e-4f && fabsf(dot3(to, down) - 1.0f) < 1e-5f);
    const float high = centre.y - s->pictures.ground_y;
    const lmb_vec3 above = vec3(centre.x + 0.75f * high, centre.y - 0.5f * high, centre.z);
    const float near = lmb_world_see_peak(&to, &job, &s->world, &lamp, above); /* cosine 1, not 0.8; 1/2 high, not 5/4 */
    CHECK_MSG(fabsf(near - 6.25f / 0.8f) < 0.01f && to.y < -0.9999f, "%g", (double)near);
}

/* The lower half of the world lies on a floor from any place; the world's centre is above the floor. */
static void floor_below(stage *s)
{
    s->pictures.ground_y = -1.25f;
    s->pictures.has_floor = 1;
    elsewhere(s, vec3(20.0f, 3.0f, -11.0f));
    elsewhere(s, vec3(-3.0f, -1.0f, 0.5f));
    if (s->pictures.shape == LMB_WORLD_SPHERE) {
        identity(s, LMB_WORLD_F32, 0.003f);
        lamp_on_floor(s);
    }
    s->pictures.ground_y = s->pictures.centre.y;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_ERR_ARG);
    s->pictures.ground_y = NAN;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_ERR_ARG);
    s->pictures.ground_y = 0.0f;
    s->pictures.has_floor = 0;
}

/* --- ground ------------------------------------------------------------------------------------------------------- */

static void paint_ground(stage *s, float alpha)
{
    for (int i = 0; i < GROUND * GROUND; ++i) {
        s->ground[4 * i] = 2.0f + 0.05f * (float)(i % GROUND);
        s->ground[4 * i + 1] = 3.0f + 0.05f * (float)(i / GROUND);
        s->ground[4 * i + 2] = 1.0f;
        s->ground[4 * i + 3] = alpha;
    }
    s->pictures.ground = s->ground;
    s->pictures.ground_width = s->pictures.ground_height = GROUND;
    s->pictures.ground_x = s->pictures.ground_z = -16.0f;
    s->pictures.ground_width_m = s->pictures.ground_depth_m = 32.0f;
    s->pictures.ground_y = 0.0f;
}

/* S7: straight down shows the ground below the object, straight up does not; if the ground is blank, the far world
 * shows. */
static void ground_and_sky(stage *s)
{
    const lmb_vec3 at = vec3(5.0f, 1.0f, -3.0f);
    const int down = (HEIGHT - 1) * WIDTH;
    paint_ground(s, 1.0f);
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, at, 0);
    CHECK(fabsf(s->map[down] - (2.0f + 0.05f * 20.5f)) < 0.05f);
    CHECK(fabsf(s->map[COUNT + down] - (3.0f + 0.05f * 12.5f)) < 0.05f);
    CHECK(fabsf(s->map[2 * COUNT + down] - 1.0f) < 1e-5f && fabsf(s->map[2 * COUNT] - sky(2, vec3(0, 1, 0))) < 0.02f);
    see_from(s, at, 1); /* S7's variant: the mean of both */
    const lmb_vec3 q = far_point(&s->pictures, at, direction_of(s, down));
    const float far = sky(2, normalize3(sub3(q, s->pictures.centre)));
    CHECK(fabsf(s->map[2 * COUNT + down] - 0.5f * (1.0f + far)) < 0.01f);
    see_from(s, vec3(5.0f, 0.0f, -3.0f), 0); /* on the ground: it is invisible */
    CHECK(fabsf(s->map[2 * COUNT + down] - 1.0f) > 0.05f);
    paint_ground(s, 0.0f);
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, at, 0);
    CHECK(fabsf(s->map[2 * COUNT + down] - far) < 0.01f);
    s->pictures.has_floor = 1; /* the picture lies on the floor */
    s->pictures.ground_y = -0.001f;
    paint_ground(s, 1.0f);
    s->pictures.ground_y = -0.001f;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, at, 0);
    CHECK(fabsf(s->map[2 * COUNT + down] - 1.0f) < 1e-5f);
    s->pictures.has_floor = 0;
    /* S2: the ground fills missing faces of the cube; beyond the ground there is nothing. */
    paint_ground(s, 1.0f);
    s->pictures.ground_y = -60.0f; /* below the far world */
    s->pictures.face[3] = NULL;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, vec3(0.0f, 1.5f, 0.0f), 0);
    CHECK(fabsf(s->map[2 * COUNT + down] - 1.0f) < 0.02f);
    s->pictures.ground = NULL;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, vec3(0.0f, 1.5f, 0.0f), 0);
    CHECK(s->map[down] == 0.0f && s->map[COUNT + down] == 0.0f);
    s->pictures.face[3] = s->face[3];
}

/* --- blank parts -------------------------------------------------------------------------------------------------- */

/* S1, the source's second figure: faces that are blank below the horizon are filled from the ground, whatever the
 * colour under the alpha, as if they showed the ground. Without a ground they are black. */
static void blank_in_part(stage *s)
{
    static float alpha[6][FACE * FACE], whole[3 * COUNT];
    float worst = 0.0f, mean = 0.0f;
    paint_ground(s, 1.0f);
    s->pictures.ground_y = -60.0f; /* below the far world, so the ground is the farther of the two */
    s->pictures.ground_width_m = s->pictures.ground_depth_m = 4000.0f;
    s->pictures.ground_x = s->pictures.ground_z = -2000.0f;
    for (int i = 0; i < GROUND * GROUND * 4; ++i) {
        s->ground[i] = i % 4 < 3 ? 0.5f : 1.0f;
    }
    for (int k = 0; k < 2; ++k) { /* filled first, then blank */
        for (int i = 0; i < 6 * FACE * FACE; ++i) {
            const int face = i / (FACE * FACE), at = i % (FACE * FACE);
            const int below = cube_direction(face, at % FACE, at / FACE, FACE).y < 0.0f;
            alpha[face][at] = k == 1 && below ? 0.0f : 1.0f;
            for (int c = 0; c < 3 && below; ++c) {
                s->face[face][3 * at + c] = k == 1 ? 7.0f : 0.5f;
            }
            s->pictures.alpha[face] = alpha[face];
        }
        CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
        see_from(s, vec3(3.0f, 4.0f, -2.0f), 0);
        if (k == 0) {
            memcpy(whole, s->map, sizeof whole);
        }
    }
    for (int i = 0; i < 3 * COUNT; ++i) {
        worst = maxf(worst, fabsf(s->map[i] - whole[i]));
        mean += fabsf(s->map[i] - whole[i]) / (float)(3 * COUNT);
    }
    CHECK_MSG(mean < 0.002f && worst < 0.3f, "mean %g, worst %g", (double)mean, (double)worst);
    s->pictures.ground = NULL;
    CHECK(make_world(s, LMB_WORLD_LOG16) == LMB_OK);
    see_from(s, s->pictures.centre, 0);
    CHECK(s->map[(HEIGHT - 1) * WIDTH] < 1e-6f && s->map[(HEIGHT * 3 / 4) * WIDTH] < 1e-6f && s->map[0] > 0.1f);
    memset(s->pictures.alpha, 0, sizeof s->pictures.alpha);
    paint_sky(s);
}

/* --- lamps -------------------------------------------------------------------------------------------------------- */

/* Normal of the far world at a point of it, of either sign. */
static lmb_vec3 far_normal(const lmb_world_pictures *p, lmb_vec3 q)
{
    const lmb_vec3 to_low = sub3(q, p->low), to_high = sub3(p->high, q), off = min3(to_low, to_high);
    if (p->shape == LMB_WORLD_SPHERE) {
        return normalize3(sub3(q, p->middle));
    }
    return off.x < minf(off.y, off.z) ? vec3(1, 0, 0) : off.y < off.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
}

/* A world with one texel of `radiance` among dark ones. Returns its irradiance at a place, and sets the direction. */
static float one_lamp(lmb_vec3 *to, stage *s, int face, int at, float radiance, lmb_vec3 place)
{
    const int32_t x = at % FACE, y = at / FACE;
    const float u = cube_coordinate(x, FACE), v = cube_coordinate(y, FACE), l2 = 1.0f + u * u + v * v;
    const lmb_vec3 d = cube_direction(face, x, y, FACE), q = far_point(&s->pictures, s->pictures.centre, d),
                   way = sub3(q, place), from = sub3(q, s->pictures.centre);
    const lmb_vec3 normal = far_normal(&s->pictures, q);
    const float area = 4.0f / ((float)(FACE * FACE) * l2 * sqrtf(l2));
    *to = normalize3(way);
    memset(s->face, 0, sizeof s->face);
    s->face[face][3 * at] = s->face[face][3 * at + 1] = s->face[face][3 * at + 2] = radiance;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK && s->world.peaks == 1);
    return radiance * area * (dot3(from, from) / dot3(way, way)) * absf(dot3(normal, *to) / dot3(normal, d));
}

static void lamp(stage *s, int face, int at, float radiance, lmb_vec3 place, float tolerance)
{
    lmb_vec3 to;
    const float flux = one_lamp(&to, s, face, at, radiance, place);
    see_from(s, place, 0);
    CHECK(lmb_probe_reduce(&s->lights, picked_kernels(), s->map, &s->table) == LMB_OK && s->lights.peaks > 0);
    CHECK(lmb_probe_cosine(s->cube, CUBE, picked_kernels(), &s->lights, &s->table) == LMB_OK);
    float worst = 0.0f;
    for (int i = 0; i < CUBE_TEXELS; ++i) {
        const lmb_vec3 n = cube_direction(i / (CUBE * CUBE), i % CUBE, i / CUBE % CUBE, CUBE);
        worst = maxf(worst, fabsf(s->cube[i] - flux * maxf(dot3(n, to), 0.0f)));
    }
    CHECK_MSG(worst < tolerance * flux, "face %d, texel %d: %g of %g", face, at, (double)worst, (double)flux);
}

/* A lamp of one texel lights each normal by the cosine, for any texel and any place. */
static void lamps(stage *s)
{
    s->pictures.ground = NULL;
    for (int i = 0; i < 24; ++i) {
        lamp(s, i % 6, (i * 1237 + 411) % (FACE * FACE), 1000.0f, i < 12 ? s->pictures.centre : vec3(11.0f, 9.0f, -20.0f),
             0.01f);
    }
    s->pictures.shape = LMB_WORLD_BOX;
    for (int i = 0; i < 6; ++i) { /* one on each wall */
        lamp(s, i, (i * 531 + 1211) % (FACE * FACE), 1000.0f, vec3(11.0f, 9.0f, -12.0f), 0.01f);
    }
    /* A place outside the box counts as the nearest place inside. */
    see_from(s, vec3(11.0f, 900.0f, -12.0f), 0);
    const lmb_vec3 middle = mul3(add3(s->pictures.low, s->pictures.high), 0.5f);
    memcpy(s->other, s->map, sizeof s->map);
    see_from(s, vec3(11.0f, middle.y + 0.999f * (s->pictures.high.y - middle.y), -12.0f), 0);
    float most = 0.0f, off = 0.0f;
    for (int i = 0; i < 3 * COUNT; ++i) {
        most = maxf(most, s->map[i]);
        off = maxf(off, fabsf(s->map[i] - s->other[i]));
    }
    CHECK_MSG(most > 0.0f && off < 1e-4f * most, "%g of %g", (double)off, (double)most);
    s->pictures.shape = LMB_WORLD_SPHERE;
    paint_sky(s);
}

/* The ground's picture lets the light of a lamp behind it through as far as it is blank there; with blend 1 it stops
 * half of this. */
static void lamp_under_ground(stage *s)
{
    enum { NO_GROUND, QUARTER, WHOLE, BESIDE, BEHIND, CASES };
    const lmb_world_peak lamp = {{0.6f, -0.8f, 0.0f}, {1, 1, 1}, 1e-4f, 0, 0, 0, 0};
    const lmb_vec3 at = vec3(2.0f, 1.0f, -3.5f), far = far_point(&s->pictures, s->pictures.centre, lamp.to),
                   way = sub3(far, at), meets = add3(at, mul3(way, 1.0f / -way.y)); /* at y = 0 */
    float seen[2][CASES];
    for (int i = 0; i < CASES; ++i) {
        paint_ground(s, i == QUARTER ? 0.0f : 1.0f);
        s->ground[4 * ((int)(meets.z + 16.0f) * GROUND + (int)(meets.x + 16.0f)) + 3] = i == QUARTER ? 0.25f : 1.0f;
        s->pictures.ground = i == NO_GROUND ? NULL : s->ground;
        s->pictures.ground_x += i == BESIDE ? 20.0f : 0.0f; /* now from x = 4 on */
        if (i == BEHIND) {
            s->pictures.ground_y = -60.0f;
            s->pictures.ground_x = s->pictures.ground_z = -2000.0f;
            s->pictures.ground_width_m = s->pictures.ground_depth_m = 4000.0f;
        }
        CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
        for (int32_t blend = 0; blend < 2; ++blend) {
            lmb_world_job job;
            lmb_vec3 to;
            lmb_world_ask(&job, &s->world, LMB_WORLD_ALL, 0.01f, blend);
            seen[blend][i] = lmb_world_see_peak(&to, &job, &s->world, &lamp, at);
        }
    }
    const float all = seen[0][NO_GROUND];
    CHECK(all > 0.5f && seen[1][NO_GROUND] == all);
    CHECK(fabsf(seen[0][QUARTER] - 0.75f * all) < 1e-5f && fabsf(seen[1][QUARTER] - 0.875f * all) < 1e-5f);
    CHECK(seen[0][WHOLE] == 0.0f && fabsf(seen[1][WHOLE] - 0.5f * all) < 1e-5f);
    CHECK(seen[0][BESIDE] == all && seen[1][BESIDE] == all);
    CHECK(seen[0][BEHIND] == all && fabsf(seen[1][BEHIND] - 0.5f * all) < 1e-5f);
    s->pictures.ground = NULL;
    s->pictures.ground_y = 0.0f;
}

/* D G / 4 of the lobe seen along its normal, for light at this cosine to the mirror direction. */
static double lobe(double alpha, double z)
{
    const double a2 = alpha * alpha, h = 0.5 * (1.0 + z) * (a2 - 1.0) + 1.0;
    return z > 0.0 ? a2 / (4.0 * 3.14159265358979 * h * h) * 2.0 * z / (z + sqrt(a2 + (1.0 - a2) * z * z)) : 0.0;
}

/* A rough surface shows a lamp as the lobe around it, so that a world of radiance 1 would show 1. */
static void lamp_in_lobe(stage *s)
{
    enum { STEPS = 2000 };
    const lmb_vec3 place = vec3(11.0f, 9.0f, -20.0f);
    const lmb_world_query query = {&s->world, 0.0f, 0};
    static lmb_probe_rays rays;
    lmb_vec3 to;
    const float roughness[2] = {0.3f, 0.7f}, flux = one_lamp(&to, s, 2, 1200, 1000.0f, place);
    for (int i = 0; i < 2; ++i) {
        const double alpha = (double)(roughness[i] * roughness[i]);
        double all = 0.0, worst = 0.0;
        for (int k = 0; k < STEPS; ++k) {
            all += lobe(alpha, (k + 0.5) / STEPS) * 2.0 * 3.14159265358979 / STEPS;
        }
        const double most = (double)flux * lobe(alpha, 1.0) / all;
        CHECK(lmb_probe_reflect(s->cube, CUBE, picked_kernels(), &rays, &query, place, roughness[i]) == LMB_OK);
        for (int k = 0; k < 3 * CUBE_TEXELS; ++k) {
            const int at = k % CUBE_TEXELS;
            const lmb_vec3 r = cube_direction(at / (CUBE * CUBE), at % CUBE, at / CUBE % CUBE, CUBE);
            worst = fmax(worst, fabs((double)s->cube[k] - (double)flux * lobe(alpha, (double)dot3(r, to)) / all));
        }
        CHECK_MSG(worst < 0.01 * most, "roughness %g: %g of %g", (double)roughness[i], worst, most);
    }
    paint_sky(s);
}

/* A mirror's cube of the world's side, or half of that, has all light of a lamp of one texel, and no negative texel. Other
 * sides may be 30 % off, because texels are clamped. */
static void lamp_in_mirror(stage *s)
{
    enum { SIDES = 2, MOST = FACE };
    static const int32_t side[SIDES] = {FACE / 2, FACE};
    static float planes[18 * MOST * MOST];
    static lmb_probe_rays rays;
    const lmb_world_query query = {&s->world, 0.0f, 0};
    for (int i = 0; i < SIDES * 6; ++i) {
        const int32_t n = side[i % SIDES], texels = 6 * n * n;
        lmb_vec3 to;
        const float flux = one_lamp(&to, s, i / SIDES, (i * 1237 + 411) % (FACE * FACE), 1000.0f, s->pictures.centre);
        double light = 0.0;
        float least = 1.0f;
        CHECK(lmb_probe_reflect(planes, n, picked_kernels(), &rays, &query, s->pictures.centre, 0.0f) == LMB_OK);
        for (int32_t k = 0; k < texels; ++k) {
            const float u = cube_coordinate(k % n, n), v = cube_coordinate(k / n % n, n), l2 = 1.0f + u * u + v * v;
            light += (double)planes[k] * 4.0 / ((double)(n * n) * (double)l2 * sqrt((double)l2));
            least = minf(least, planes[k]);
        }
        CHECK_MSG(fabs(light - (double)flux) < (n < FACE ? 0.05 : 0.006) * (double)flux && least >= 0.0f,
                  "side %d, face %d: light %g, not %g; least %g", (int)n, i / SIDES, light, (double)flux, (double)least);
    }
    paint_sky(s);
}

/* Of more bright blocks than a reduced map has peaks, the strongest become peaks. */
static void strongest_blocks(stage *s)
{
    enum { MORE = LMB_PROBE_PEAKS + 16 };
    float weakest = 1e30f, light[MORE];
    double sum = 0.0, strongest = 0.0;
    memset(s->map, 0, sizeof s->map);
    for (int i = 0; i < MORE; ++i) { /* rows 20 .. 35: MORE different lights, in no order */
        const int at = (20 + 2 * (i / 10)) * WIDTH + 12 * (i % 10);
        s->map[at] = 100.0f + (float)(i * 37 % MORE);
        light[i] = s->map[at] * s->table.area[at / WIDTH];
    }
    CHECK(lmb_probe_reduce(&s->lights, picked_kernels(), s->map, &s->table) == LMB_OK);
    CHECK(s->lights.peaks == LMB_PROBE_PEAKS);
    for (int i = 0; i < LMB_PROBE_PEAKS; ++i) {
        weakest = minf(weakest, s->lights.peak[3][i]);
        sum += (double)s->lights.peak[3][i];
    }
    for (int i = 0; i < MORE; ++i) {
        int stronger = 0;
        for (int k = 0; k < MORE; ++k) {
            stronger += light[k] > light[i];
        }
        strongest += stronger < LMB_PROBE_PEAKS ? (double)light[i] : 0.0;
        CHECK((stronger < LMB_PROBE_PEAKS) == (light[i] > weakest * (1.0f - 1e-6f)));
    }
    CHECK_MSG(fabs(sum / strongest - 1.0) < 1e-6, "%g of %g", sum, strongest);
}

/* More lamps than peaks: the strongest become peaks, and no light of the others is lost. */
static void many_lamps(stage *s)
{
    double whole = 0.0, got = 0.0;
    memset(s->face, 0, sizeof s->face);
    for (int i = 0; i < 6 * FACE * FACE; ++i) {
        const int face = i / (FACE * FACE), at = i % (FACE * FACE), x = at % FACE, y = at / FACE;
        if (x % 8 == 3 && y % 16 == 5) {
            const double u = (double)cube_coordinate(x, FACE), v = (double)cube_coordinate(y, FACE);
            s->face[face][3 * at] = 50.0f + (float)(i % 7);
            whole += (double)s->face[face][3 * at] * 4.0 / (FACE * FACE * pow(1.0 + u * u + v * v, 1.5));
        }
    }
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK && s->world.peaks == LMB_WORLD_PEAKS);
    see_from(s, s->pictures.centre, 0);
    for (int i = 0; i < COUNT; ++i) {
        got += (double)s->map[i] * (double)s->table.area[i / WIDTH];
    }
    CHECK_MSG(fabs(got / whole - 1.0) < 0.03, "%g of %g", got, whole);
    s->lights.peaks = LMB_PROBE_PEAKS + 1;
    CHECK(lmb_probe_cosine(s->cube, CUBE, picked_kernels(), &s->lights, &s->table) == LMB_ERR_ARG);
    s->lights.peaks = -1;
    CHECK(lmb_probe_cosine(s->cube, CUBE, picked_kernels(), &s->lights, &s->table) == LMB_ERR_ARG);
    paint_sky(s);
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static void paint_all(stage *s, float radiance)
{
    for (int i = 0; i < 6 * FACE * FACE * 3; ++i) {
        s->face[i / (FACE * FACE * 3)][i % (FACE * FACE * 3)] = radiance;
    }
}

static float farthest(const float *v, int n, float from)
{
    float worst = 0.0f;
    for (int i = 0; i < n; ++i) {
        worst = maxf(worst, fabsf(v[i] - from));
    }
    return worst;
}

/* A world of constant radiance gives pi times the radiance to 1e-6, with each filter and from any place. */
static void one_radiance(stage *s)
{
    const float pi = 3.14159265f;
    float harmonics[3][LMB_SH_25];
    paint_all(s, 1.0f);
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, vec3(20.0f, 3.0f, -11.0f), 0);
    CHECK(farthest(s->map, 3 * COUNT, 1.0f) < 1e-6f);
    CHECK(lmb_probe_reduce(&s->lights, picked_kernels(), s->map, &s->table) == LMB_OK);
    CHECK(lmb_probe_cosine(s->cube, CUBE, picked_kernels(), &s->lights, &s->table) == LMB_OK);
    const float off = farthest(s->cube, 3 * CUBE_TEXELS, pi);
    CHECK_MSG(off < 1e-6f * pi, "%g", (double)off);
    CHECK(lmb_probe_sh(harmonics, s->map, &s->table) == LMB_OK);
    for (int32_t terms = 9; terms <= 25; terms += terms == 9 ? 7 : 9) {
        CHECK(lmb_probe_sh_cube(s->cube, CUBE, (const float (*)[LMB_SH_25])harmonics, terms) == LMB_OK);
        CHECK_MSG(farthest(s->cube, 3 * CUBE_TEXELS, pi) < 1e-6f * pi, "%d terms: %g", (int)terms,
                  (double)farthest(s->cube, 3 * CUBE_TEXELS, pi));
    }
    paint_sky(s);
}

static const double half_turn = 3.14159265358979323846;

/* Legendre's function without (-1)^m, by the recurrence in l, normalised over the sphere with its wave. */
static double harmonic(int l, int m, double y, double angle)
{
    double a = 1.0, b = 0.0, scale = (2 * l + 1) / (4.0 * half_turn);
    const int k = abs(m);
    for (int i = 1; i <= k; ++i) {
        a *= (2 * i - 1) * sqrt(1.0 - y * y);
    }
    for (int i = k + 1; i <= l; ++i) {
        const double next = ((2 * i - 1) * y * a - (i + k - 1) * b) / (i - k);
        b = a;
        a = next;
    }
    for (int i = l - k + 1; i <= l + k; ++i) {
        scale /= i;
    }
    return sqrt(k > 0 ? 2.0 * scale : scale) * a * (m < 0 ? sin(k * angle) : cos(k * angle));
}

/* A map of one harmonic has this coefficient and no other. */
static void each_harmonic(stage *s)
{
    float got[3][LMB_SH_25];
    for (int one = 0; one < LMB_SH_25; ++one) {
        const int l = (int)sqrt(one + 0.5);
        double off = 0.0;
        for (int i = 0; i < COUNT; ++i) {
            s->map[i] = (float)harmonic(l, one - l * l - l, cos((i / WIDTH + 0.5) * half_turn / HEIGHT),
                                        (i % WIDTH + 0.5) * 2.0 * half_turn / WIDTH - half_turn);
        }
        CHECK(lmb_probe_sh(got, s->map, &s->table) == LMB_OK);
        for (int k = 0; k < LMB_SH_25; ++k) {
            off = fmax(off, fabs((double)got[0][k] - (k == one)));
        }
        CHECK_MSG(off < 5e-3, "%d: %g", one, off);
    }
}

/* The same for blurs, at a quarter of the map's size; the sky is as accurate as a blur can be. */
static void blurred(stage *s)
{
    static const float max[3] = {0.03f, 0.055f, 0.006f}; /* of the mean */
    const size_t table_bytes = lmb_probe_table_bytes(WIDTH / 2, HEIGHT / 2);
    static float half[3 * COUNT / 4], out[3 * COUNT / 4], line[2 * WIDTH + COUNT / 4];
    lmb_probe_table table;
    void *table_memory = malloc(table_bytes);
    CHECK(lmb_probe_table_init(&table, WIDTH / 2, HEIGHT / 2, -90.0f, table_memory, table_bytes) == LMB_OK);
    for (int32_t terms = 0; terms <= 2; ++terms) {
        lmb_probe_blur blur;
        const size_t bytes = lmb_probe_blur_bytes(&table, terms);
        void *memory = malloc(bytes);
        CHECK(lmb_probe_blur_init(&blur, &table, terms, memory, bytes) == LMB_OK);
        CHECK(lmb_probe_blur_init(&blur, &table, terms, memory, bytes - 4) == LMB_ERR_CAPACITY);
        for (int i = 0; i < 3 * COUNT / 4; ++i) {
            half[i] = 1.0f;
        }
        CHECK(lmb_probe_blur_map(out, picked_kernels(), line, half, &blur) == LMB_OK);
        CHECK(farthest(out, 3 * COUNT / 4, 3.14159265f) < 4e-6f);
        CHECK(lmb_probe_remap(half, picked_kernels(), &s->world, &table, s->pictures.centre, 0) == LMB_OK);
        CHECK(lmb_probe_blur_map(out, picked_kernels(), line, half, &blur) == LMB_OK);
        CHECK(lmb_probe_map_cube(s->cube, CUBE, out, &table) == LMB_OK);
        CHECK(lmb_probe_blur_map(half, picked_kernels(), line, half, &blur) == LMB_OK);
        CHECK(memcmp(half, out, sizeof half) == 0); /* S13 */
        float worst = 0.0f;
        for (int i = 0; i < CUBE_TEXELS; ++i) {
            const lmb_vec3 n = cube_direction(i / (CUBE * CUBE), i % CUBE, i / CUBE % CUBE, CUBE);
            worst = maxf(worst, fabsf(s->cube[i] - (3.14159265f + 1.04719755f * n.x + 0.19634954f * n.y * n.z)));
        }
        CHECK_MSG(worst < max[terms] * 3.14159265f, "%d terms: %g", (int)terms, (double)worst);
        free(memory);
    }
    CHECK(lmb_probe_blur_bytes(&table, 3) == 0 && lmb_probe_blur_bytes(NULL, 1) == 0);
    CHECK(lmb_probe_blur_map(out, picked_kernels(), line, out, NULL) == LMB_ERR_ARG);
    free(table_memory);
}

/* Half the size gives the same light. */
static void halved(const stage *s)
{
    static float half[3 * COUNT / 4];
    double whole = 0.0, after = 0.0;
    CHECK(lmb_probe_halve(half, s->map, &s->table) == LMB_OK);
    for (int i = 0; i < COUNT; ++i) {
        whole += (double)s->map[i] * (double)s->table.area[i / WIDTH];
    }
    for (int i = 0; i < COUNT / 4; ++i) {
        const int y = i / (WIDTH / 2);
        after += (double)half[i] * 2.0 * (double)(s->table.area[2 * y] + s->table.area[2 * y + 1]);
    }
    CHECK(fabs(whole - after) < 1e-5 * whole);
}

/* The sky has only bands 0 to 2: harmonics are exact and show each band's factor; 16 terms equal 9. */
static void known_irradiance(stage *s)
{
    float harmonics[3][LMB_SH_25], nine[3 * CUBE_TEXELS], worst_sh = 0.0f, worst_cosine = 0.0f;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, s->pictures.centre, 0);
    CHECK(lmb_probe_sh(harmonics, s->map, &s->table) == LMB_OK);
    CHECK(lmb_probe_sh_cube(nine, CUBE, (const float (*)[LMB_SH_25])harmonics, LMB_SH_9) == LMB_OK);
    CHECK(lmb_probe_sh_cube(s->cube, CUBE, (const float (*)[LMB_SH_25])harmonics, LMB_SH_16) == LMB_OK);
    CHECK(memcmp(nine, s->cube, sizeof nine) == 0);
    CHECK(lmb_probe_reduce(&s->lights, picked_kernels(), s->map, &s->table) == LMB_OK);
    CHECK(lmb_probe_cosine(s->cube, CUBE, picked_kernels(), &s->lights, &s->table) == LMB_OK);
    for (int i = 0; i < CUBE_TEXELS; ++i) {
        const lmb_vec3 n = cube_direction(i / (CUBE * CUBE), i % CUBE, i / CUBE % CUBE, CUBE);
        const float pi = 3.14159265f, one = 2.0f / 3.0f * pi, two = pi / 4.0f;
        const float want[3] = {pi + one * 0.5f * n.x + two * 0.25f * n.y * n.z,
                               0.8f * pi + one * 0.3f * n.z - two * 0.2f * n.x * n.y,
                               0.6f * pi - one * 0.3f * n.y + two * 0.2f * n.x * n.z};
        for (int c = 0; c < 3; ++c) {
            worst_sh = maxf(worst_sh, fabsf(nine[c * CUBE_TEXELS + i] - want[c]));
            worst_cosine = maxf(worst_cosine, fabsf(s->cube[c * CUBE_TEXELS + i] - want[c]));
        }
    }
    CHECK_MSG(worst_sh < 0.002f && worst_cosine < 0.008f, "%g %g", (double)worst_sh, (double)worst_cosine);
}

/* No step across the seam at 180 degrees, the poles, or the cube's edges exceeds the steps inside a face. */
static void no_seams(stage *s)
{
    float inside = 0.0f, seam = 0.0f, pole = 0.0f;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    see_from(s, vec3(9.0f, 2.0f, 4.0f), 0);
    for (int y = 0; y < HEIGHT; ++y) {
        const float *row = s->map + y * WIDTH;
        for (int x = 0; x + 1 < WIDTH; ++x) {
            inside = maxf(inside, fabsf(row[x + 1] - row[x]));
        }
        seam = maxf(seam, fabsf(row[0] - row[WIDTH - 1]));
    }
    for (int x = 0; x < WIDTH; ++x) {
        const float *last = s->map + (HEIGHT - 1) * WIDTH;
        pole = maxf(pole, fabsf(s->map[x] - s->map[(x + WIDTH / 2) % WIDTH]));
        pole = maxf(pole, fabsf(last[x] - last[(x + WIDTH / 2) % WIDTH]));
    }
    CHECK_MSG(seam <= inside && pole <= inside, "%g %g %g", (double)inside, (double)seam, (double)pole);
}

/* --- refusals ----------------------------------------------------------------------------------------------------- */

static void refusals(stage *s)
{
    lmb_world_pictures *p = &s->pictures;
    const size_t bytes = lmb_world_bytes(p, LMB_WORLD_LOG8);
    CHECK(bytes > 0 && lmb_world_bytes(p, LMB_WORLD_F32) == 4 * bytes && lmb_world_bytes(NULL, 0) == 0);
    CHECK(lmb_world_init(&s->world, p, 3, s->world_memory, bytes) == LMB_ERR_FORMAT);
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, s->world_memory, bytes - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, (uint8_t *)s->world_memory + 2, bytes) == LMB_ERR_ALIGN);
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, NULL, bytes) == LMB_ERR_ARG);
    p->radius = 0.0f;
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, s->world_memory, bytes) == LMB_ERR_ARG);
    p->radius = 50.0f;
    p->centre.x = 51.0f; /* outside the pictured world */
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, s->world_memory, bytes) == LMB_ERR_ARG);
    p->centre.x = NAN;
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, s->world_memory, bytes) == LMB_ERR_ARG);
    p->centre.x = 0.0f;
    p->middle.y = NAN;
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, s->world_memory, bytes) == LMB_ERR_ARG);
    p->middle.y = 1.5f;
    p->radius = 2e5f; /* around a centre beyond 2^20 m */
    p->middle.x = 1e6f;
    p->centre.x = 1.1e6f;
    CHECK(lmb_world_init(&s->world, p, LMB_WORLD_LOG8, s->world_memory, bytes) == LMB_ERR_ARG);
    p->centre.x = p->middle.x = 0.0f;
    p->radius = 50.0f;
    p->face_size = 0;
    CHECK(lmb_world_bytes(p, LMB_WORLD_LOG8) == 0);
    p->face_size = FACE;
    CHECK(lmb_probe_table_bytes(128, 60) == 0 && lmb_probe_table_bytes(16, 8) > 0);
    CHECK(lmb_probe_table_bytes(2048, 1024) == 0);
    CHECK(lmb_probe_table_init(&s->table, WIDTH, HEIGHT, NAN, s->table_memory, 1u << 20) == LMB_ERR_ARG);
    CHECK(lmb_probe_table_init(&s->table, 128, 60, 0.0f, s->table_memory, 1u << 20) == LMB_ERR_ARG);
    CHECK(lmb_probe_table_init(NULL, WIDTH, HEIGHT, 0.0f, s->table_memory, 1u << 20) == LMB_ERR_ARG);
    CHECK(lmb_probe_table_init(&s->table, WIDTH, HEIGHT, 0.0f, s->table_memory, 64) == LMB_ERR_CAPACITY);
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    CHECK(lmb_probe_halve(NULL, s->map, &s->table) == LMB_ERR_ARG &&
          lmb_probe_halve(s->cube, s->map, NULL) == LMB_ERR_ARG);
    CHECK(lmb_probe_remap(s->map, picked_kernels(), &s->world, &s->table, vec3(NAN, 0, 0), 0) == LMB_ERR_ARG);
    CHECK(lmb_probe_remap(NULL, picked_kernels(), &s->world, &s->table, vec3(0, 0, 0), 0) == LMB_ERR_ARG);
    CHECK(lmb_probe_cosine(s->cube, 65, picked_kernels(), &s->lights, &s->table) == LMB_ERR_ARG);
    /* A place outside the far world counts as the nearest place inside. */
    see_from(s, vec3(400.0f, 1.5f, 0.0f), 0);
    const float outside = s->map[COUNT / 2];
    see_from(s, vec3(0.999f * 50.0f, 1.5f, 0.0f), 0);
    CHECK(fabsf(outside - s->map[COUNT / 2]) < 1e-4f);
}

/* The last mip level of a face or ground of any size is the alpha-weighted mean of all texels. */
static void means_of_levels(stage *s, int32_t face, int32_t width, int32_t height)
{
    double want[2][4] = {{0}};
    float got[2][4];
    paint_ground(s, 1.0f);
    for (int32_t i = 0; i < face * face; ++i) {
        s->face[1][3 * i] = 1.0f + (float)(i % face == face - 1) * 40.0f + (float)(i / face == face - 1) * 20.0f;
        want[0][0] += (double)s->face[1][3 * i] / (face * face);
    }
    for (int32_t i = 0; i < width * height; ++i) {
        float *rgba = &s->ground[4 * i];
        rgba[0] = 1.0f + (float)(i % width == width - 1) * 40.0f + (float)(i / width == height - 1) * 20.0f;
        rgba[3] = i % 3 == 1 ? 0.25f : 1.0f;
        want[1][0] += (double)(rgba[0] * rgba[3]) / (width * height);
        want[1][3] += (double)rgba[3] / (width * height);
    }
    s->pictures.face_size = face;
    s->pictures.ground_width = width;
    s->pictures.ground_height = height;
    CHECK(make_world(s, LMB_WORLD_F32) == LMB_OK);
    lmb_world_texel(got[0], &s->world, lmb_world_face_texel(&s->world.cube[s->world.cube_levels - 1], 1, 0, 0));
    lmb_world_texel(got[1], &s->world, s->world.ground[s->world.ground_levels - 1].at);
    CHECK_MSG(fabs((double)got[0][0] - want[0][0]) < 1e-4 * want[0][0], "face of %d: %f, not %f", (int)face, (double)got[0][0],
              want[0][0]);
    CHECK_MSG(fabs((double)(got[1][0] * got[1][3]) - want[1][0]) < 1e-4 * want[1][0] && fabs((double)got[1][3] - want[1][3]) < 1e-5,
              "ground of %dx%d: %f, not %f", (int)width, (int)height, (double)(got[1][0] * got[1][3]), want[1][0]);
    s->pictures.face_size = FACE;
    s->pictures.ground = NULL;
    paint_sky(s);
}

void test_probe(void)
{
    stage *s = stage_make();
    log_codes();
    stored_codes(s);
    bands();
    identity(s, LMB_WORLD_F32, 0.003f);
    identity(s, LMB_WORLD_LOG16, 0.003f);
    identity(s, LMB_WORLD_LOG8, 0.026f); /* half a step of 1.85 */
    elsewhere(s, vec3(20.0f, 3.0f, -11.0f));
    floor_below(s);
    centre_by_the_wall(s);
    s->pictures.shape = LMB_WORLD_BOX;
    s->pictures.low = vec3(-30.0f, -10.0f, -20.0f);
    s->pictures.high = vec3(40.0f, 15.0f, 25.0f);
    elsewhere(s, vec3(-12.0f, 3.0f, 7.0f));
    floor_below(s);
    s->pictures.shape = LMB_WORLD_SPHERE;
    one_radiance(s);
    known_irradiance(s);
    halved(s);
    blurred(s);
    no_seams(s);
    ground_and_sky(s);
    blank_in_part(s);
    for (int32_t i = 1; i <= FACE; ++i) {
        means_of_levels(s, i, 1 + i * 7 % GROUND, 1 + i * 5 % GROUND);
    }
    lamps(s);
    lamp_in_lobe(s);
    lamp_in_mirror(s);
    lamp_under_ground(s);
    many_lamps(s);
    strongest_blocks(s);
    refusals(s);
    each_harmonic(s);
    stage_free(s);
}
