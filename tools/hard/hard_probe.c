/* hard_probe.c: hard cases of worlds as light: poles, seams, places at the edge, pictures with non-finite values.
 *
 * Worlds of radiance 1 and 1 + a . d have irradiance in closed form: pi, and pi (1 + 2/3 a . n). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

#define PI 3.14159265358979323846

enum { FACE = 32, WIDTH = 128, HEIGHT = 64, CUBE = 8, TEXELS = 6 * CUBE * CUBE };

typedef struct probe_stage {
    float face[6][FACE * FACE * 3], ground[4 * 4 * 4], map[3 * WIDTH * HEIGHT], cube[3 * TEXELS];
    lmb_world_pictures pictures;
    lmb_world world;
    lmb_probe_table table;
    lmb_probe_lights lights;
    lmb_probe_rays rays;
    void *world_memory, *table_memory;
    size_t world_bytes, table_bytes;
    const lmb_kernels *kernels;
} probe_stage;

/* The unit direction of a face's texel: GL order, rows from the top. */
static dvec direction_of(int face, int x, int y, int side)
{
    const double s = (2.0 * x + 1.0) / side - 1.0, t = (2.0 * y + 1.0) / side - 1.0;
    switch (face) {
    case 0:
        return dvec_unit(dvec_of(1, -t, -s));
    case 1:
        return dvec_unit(dvec_of(-1, -t, s));
    case 2:
        return dvec_unit(dvec_of(s, 1, t));
    case 3:
        return dvec_unit(dvec_of(s, -1, -t));
    case 4:
        return dvec_unit(dvec_of(s, -t, 1));
    default:
        return dvec_unit(dvec_of(-s, -t, -1));
    }
}

/* Radiance 1 + a . d. */
static void paint(probe_stage *p, dvec a)
{
    for (int i = 0; i < 6 * FACE * FACE; ++i) {
        const int f = i / (FACE * FACE), at = i % (FACE * FACE);
        const double v = 1.0 + dvec_dot(a, direction_of(f, at % FACE, at / FACE, FACE));
        for (int c = 0; c < 3; ++c) {
            p->face[f][3 * at + c] = (float)v;
        }
    }
}

static probe_stage *probe_make(const lmb_kernels *kernels)
{
    probe_stage *p = calloc(1, sizeof *p);
    if (p == NULL) {
        return NULL;
    }
    for (int i = 0; i < 6; ++i) {
        p->pictures.face[i] = p->face[i];
    }
    p->kernels = kernels;
    p->pictures.face_size = FACE;
    p->pictures.radius = 50.0f;
    p->world_bytes = lmb_world_bytes(&p->pictures, LMB_WORLD_F32) + 4096;
    p->table_bytes = lmb_probe_table_bytes(WIDTH, HEIGHT);
    p->world_memory = malloc(p->world_bytes);
    p->table_memory = malloc(p->table_bytes);
    return p;
}

static void probe_free(probe_stage *p)
{
    free(p->world_memory);
    free(p->table_memory);
    free(p);
}

/* Computes irradiance by normal at a place, with exact cosines. Returns 0 if the library refuses. */
static int see(probe_stage *p, lmb_vec3 at, float start_deg, int32_t format)
{
    return lmb_world_init(&p->world, &p->pictures, format, p->world_memory, p->world_bytes) == LMB_OK &&
           lmb_probe_table_init(&p->table, WIDTH, HEIGHT, start_deg, p->table_memory, p->table_bytes) == LMB_OK &&
           lmb_probe_remap(p->map, p->kernels, &p->world, &p->table, at, 0) == LMB_OK &&
           lmb_probe_reduce(&p->lights, p->kernels, p->map, &p->table) == LMB_OK &&
           lmb_probe_cosine(p->cube, CUBE, p->kernels, &p->lights, &p->table) == LMB_OK;
}

/* Maximum relative error of the cube; `poles`: only of the faces that look up and down. */
static double off_by(const probe_stage *p, dvec a, int poles)
{
    double worst = 0.0;
    for (int i = 0; i < TEXELS; ++i) {
        const int f = i / (CUBE * CUBE), at = i % (CUBE * CUBE);
        const double want = PI * (1.0 + 2.0 / 3.0 * dvec_dot(a, direction_of(f, at % CUBE, at / CUBE, CUBE)));
        if (!poles || f == 2 || f == 3) {
            const double off = fabs((double)p->cube[i] / want - 1.0);
            worst = off >= worst ? off : worst;
            worst = off == off ? worst : HUGE_VAL;
        }
    }
    return worst;
}

static void closed_forms(hard_list *l, probe_stage *p)
{
    static const lmb_vec3 origin = {0, 0, 0};
    const dvec none = dvec_of(0, 0, 0), up = dvec_of(0, 0.9, 0), aside = dvec_of(0.5, 0.3, -0.6);
    static float other[3 * TEXELS];
    double worst = 0.0;
    paint(p, none);
    hard_put(l, HARD_BOUNDED, "a world of one radiance: irradiance off pi",
             see(p, origin, -180, LMB_WORLD_F32) ? 1e6 * off_by(p, none, 0) : HUGE_VAL, 2, "ppm");
    paint(p, up);
    hard_put(l, HARD_MEASURED, "a world that brightens to the pole: there",
             see(p, origin, -180, LMB_WORLD_F32) ? 100 * off_by(p, up, 1) : HUGE_VAL, 0.3, "%");
    paint(p, aside);
    hard_put(l, HARD_MEASURED, "one that brightens aside: all around",
             see(p, origin, -180, LMB_WORLD_F32) ? 100 * off_by(p, aside, 0) : HUGE_VAL, 0.3, "%");
    memcpy(other, p->cube, sizeof other);
    see(p, origin, -90, LMB_WORLD_F32);
    for (int i = 0; i < 3 * TEXELS; ++i) {
        const double off = fabs((double)p->cube[i] / (double)other[i] - 1.0);
        worst = off <= worst ? worst : off; /* fmax crashes gcc 12.2 for AArch64 */
    }
    hard_put(l, HARD_MEASURED, "its seam a quarter turned: changes", 100.0 * worst, 0.001, "%");
}

/* Counts values that are NaN, under `low` or over `high`. */
static int outside(const probe_stage *p, double low, double high)
{
    int count = 0;
    for (int i = 0; i < 3 * TEXELS; ++i) {
        const double v = (double)p->cube[i];
        count += (v >= low) + (v <= high) < 2;
    }
    return count;
}

/* Counts values that are NaN, under -2 % of the maximum, or over the irradiance of the brightest texel everywhere. */
static double absurd(const probe_stage *p, double brightest)
{
    return outside(p, -0.02 * PI * brightest, PI * brightest * 1.001);
}

static void places(hard_list *l, probe_stage *p)
{
    static const lmb_vec3 at[] = {{49.99f, 0, 0},     {0, 50, 0},    {0, 0, -50.0f}, {500, 1, -700},
                                  {1e6f, 1e6f, 1e6f}, {0, 1e-7f, 0}, {0, 0, 0},      {0, -1, 0}};
    double wrong = 0.0;
    paint(p, dvec_of(0.5, 0.3, -0.6));
    for (int i = 0; i < 16; ++i) {
        p->ground[4 * i] = p->ground[4 * i + 1] = p->ground[4 * i + 2] = 0.5f;
        p->ground[4 * i + 3] = 1.0f;
    }
    p->pictures.ground = p->ground;
    p->pictures.ground_width = p->pictures.ground_height = 4;
    p->pictures.ground_x = p->pictures.ground_z = -2.0f;
    p->pictures.ground_width_m = p->pictures.ground_depth_m = 4.0f;
    for (size_t i = 0; i < sizeof at / sizeof *at; ++i) {
        wrong += see(p, at[i], -180, LMB_WORLD_F32) ? absurd(p, 1.84) : TEXELS;
    }
    hard_put(l, HARD_EXACT, "at and beyond the world's edge, on and under its ground: absurd", wrong, 0, "values");
    p->pictures.ground = NULL;
    p->pictures.ground_width = p->pictures.ground_height = 0;
}

/* A world of ones with NaN, infinities, negatives, 1e5 and denormals. */
static void hostile(hard_list *l, probe_stage *p)
{
    static const float bad[] = {NAN, INFINITY, -INFINITY, -1.0f, 1e-40f, -1e30f};
    static const lmb_vec3 at = {1, 1, 1};
    double wrong = 0.0, refused = 0.0;
    for (int32_t format = LMB_WORLD_F32; format <= LMB_WORLD_LOG8; ++format) {
        paint(p, dvec_of(0, 0, 0));
        for (int i = 0; i < 6 * FACE * FACE; i += 7) {
            p->face[i / (FACE * FACE)][3 * (i % (FACE * FACE))] = bad[i / 7 % 6];
        }
        refused += !see(p, at, -180, format);
        wrong += absurd(p, format == LMB_WORLD_F32 ? 1.001 : 1.03);
    }
    hard_put(l, HARD_EXACT, "NaN, infinity, negatives in its pictures, by three codes: absurd", refused + wrong, 0,
             "values");
    paint(p, dvec_of(0, 0, 0));
    p->face[2][0] = p->face[2][1] = p->face[2][2] = 1e5f;
    wrong = see(p, at, -180, LMB_WORLD_F32) ? absurd(p, 1e5) : HUGE_VAL;
    hard_put(l, HARD_EXACT, "one texel of 1e5: absurd", wrong, 0, "values");
    const lmb_world_query query = {&p->world, 0.02f, 0};
    const lmb_status status = lmb_probe_reflect(p->cube, CUBE, p->kernels, &p->rays, &query, at, 0.0f);
    wrong = status == LMB_OK ? wrong + outside(p, 0.0, 1.3e5) : HUGE_VAL;
    hard_put(l, HARD_EXACT, "and in a mirror: absurd", wrong, 0, "values");
}

void hard_probe(hard_list *l)
{
    probe_stage *p = probe_make(l->stage->kernels);
    if (p != NULL) {
        closed_forms(l, p);
        places(l, p);
        hostile(l, p);
        probe_free(p);
    }
}
