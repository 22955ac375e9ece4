/* hard_mixed.c: hard cases of photos with depth: nothing measured, one distance, one pixel, all planes, full pools. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

enum { WIDTH = 256, HEIGHT = 192, PIXELS = WIDTH * HEIGHT, POOL = 4689, WORDS = PIXELS * 5 / 4 };

static const lmb_pinhole camera = {WIDTH, HEIGHT, 220.0f, 220.0f, 127.5f, 95.5f};

typedef struct mixed_stage {
    float depth[PIXELS];
    lmb_cloud cloud;
    lmb_planes planes;
    uint32_t cloud_memory[PIXELS * 4], plane_memory[WORDS];
    lmb_tile tile;
    lmb_voxels voxels;
} mixed_stage;

static int find(mixed_stage *m, const lmb_pinhole *c)
{
    return lmb_cloud_init(&m->cloud, c, m->depth, m->cloud_memory, sizeof m->cloud_memory) == LMB_OK &&
           lmb_cloud_normals(&m->cloud, 0, LMB_MAX_SIDE) == LMB_OK &&
           lmb_planes_find(&m->planes, &m->cloud, m->plane_memory, sizeof m->plane_memory) == LMB_OK;
}

static void fill(mixed_stage *m, float v)
{
    for (int i = 0; i < PIXELS; ++i) {
        m->depth[i] = v;
    }
}

static void pictures(hard_list *l, mixed_stage *m)
{
    static const lmb_pinhole one = {1, 1, 80.0f, 80.0f, 0.0f, 0.0f};
    static const float bad[] = {NAN, INFINITY, -1.0f, 1e-30f, 1e30f, 0.0f};
    double found = 0.0;
    for (int i = 0; i < 6; ++i) {
        fill(m, bad[i]);
        found += find(m, &camera) ? m->planes.count : 99;
    }
    m->depth[0] = 1.0f;
    found += find(m, &one) ? m->planes.count : 99;
    hard_put(l, HARD_EXACT, "no depth, NaN, infinity, 1e30, one pixel: planes found", found, 0, "planes");
    fill(m, 3.0f);
    const int ok = find(m, &camera) && m->planes.count == 1;
    const lmb_flat *p = &m->planes.plane[0];
    hard_put(l, HARD_EXACT, "constant depth: pixels not of one plane", ok ? PIXELS - p->pixels : HUGE_VAL, 0, "px");
    hard_put(l, HARD_BOUNDED, "its distance off", ok ? 1e6 * fabs((double)p->distance - 3.0) / 3.0 : HUGE_VAL, 10,
             "ppm");
    hard_put(l, HARD_BOUNDED, "its normal off", ok ? 1e6 * acos(fmin(1.0, (double)p->normal.z)) : HUGE_VAL, 500,
             "urad");
}

/* A board of more slanted squares than LMB_MAX_PLANES: as many as fit are found, each correctly. */
static void all_planes(hard_list *l, mixed_stage *m)
{
    enum { ACROSS = 6, DOWN = 5 };
    lmb_vec3 want[ACROSS * DOWN];
    uint64_t rng = 41;
    double worst = 0.0;
    for (int k = 0; k < ACROSS * DOWN; ++k) {
        const dvec n = dvec_unit(dvec_of(hard_uniform(&rng, -0.5, 0.5), hard_uniform(&rng, -0.5, 0.5), 1));
        want[k] = (lmb_vec3){(float)n.x, (float)n.y, (float)n.z};
    }
    for (int i = 0; i < PIXELS; ++i) {
        const int k = i / WIDTH * DOWN / HEIGHT * ACROSS + i % WIDTH * ACROSS / WIDTH;
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        const float along = want[k].x * ray.x + want[k].y * ray.y + want[k].z * ray.z;
        m->depth[i] = -(2.0f + 0.2f * (float)(k % 7)) / along;
    }
    const int ok = find(m, &camera);
    for (int p = 0; ok && p < m->planes.count; ++p) {
        double nearest = HUGE_VAL;
        for (int k = 0; k < ACROSS * DOWN; ++k) {
            const lmb_vec3 n = m->planes.plane[p].normal;
            const double dot =
                (double)n.x * (double)want[k].x + (double)n.y * (double)want[k].y + (double)n.z * (double)want[k].z;
            nearest = fmin(nearest, acos(fmin(1.0, dot)));
        }
        worst = fmax(worst, nearest);
    }
    hard_put(l, HARD_EXACT, "thirty planes where 24 have room: room left",
             ok ? LMB_MAX_PLANES - m->planes.count : HUGE_VAL, 0, "planes");
    hard_put(l, HARD_MEASURED, "the normal of the worst", worst * 57.29578, 0.06, "degrees");
}

/* --- changes ------------------------------------------------------------------------------------------------------ */

static void deltas(hard_list *l, mixed_stage *m)
{
    static const float light[] = {0.0f, 1e-30f, 1.0f, 1e20f, 3e38f};
    lmb_irradiance without, with;
    lmb_radiance photo, before;
    double changed = 0.0, absurd = 0.0;
    memset(&m->tile, 0, sizeof m->tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        m->tile.id[k] = 1;
        m->tile.depth[k] = 1.0f;
        for (int c = 0; c < 3; ++c) {
            before.rgb[c][k] = 0.01f * (float)(k + c);
        }
    }
    m->tile.hits = LMB_TILE_PIXELS;
    for (int i = 0; i < 25; ++i) {
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            without.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] = light[i / 5];
            with.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] = light[i % 5];
        }
        photo = before;
        lmb_delta_tile(&photo, &m->tile, &without, &with);
        changed += i / 5 == i % 5 && memcmp(&photo, &before, sizeof photo) != 0;
        for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
            const float v = photo.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
            absurd += !(v >= 0.0f && v <= 3.4e38f);
        }
    }
    hard_put(l, HARD_EXACT, "equal light, 0 to 3e38: photos changed", changed, 0, "tiles");
    hard_put(l, HARD_EXACT, "light from 0 to 3e38 and back: absurd", absurd, 0, "values");
}

/* --- full pools --------------------------------------------------------------------------------------------------- */

/* Depths 4 .. 10 with the smallest pool: area is kept, depth is reduced. */
static void pools(hard_list *l, mixed_stage *m)
{
    hard_stage *s = l->stage;
    const size_t bytes = lmb_voxels_bytes(POOL, LMB_VOXELS_ONE);
    void *memory = malloc(bytes);
    lmb_voxel_part part;
    double worst = 0.0, area = 0.0, refused = memory == NULL;
    hard_begin(s, 0.5);
    hard_ball(s, dvec_of(0.1, 0.2, 0.3), 0.7, 24);
    hard_box(s, dvec_of(-1, 0.2, 0.1), dvec_of(0.3, 0.3, 0.3));
    hard_end(s);
    for (uint32_t i = 0; i < s->count; ++i) {
        area += 0.5 * dvec_length(dvec_turn(s->world[i][0], s->world[i][1], s->world[i][2]));
    }
    memset(&part, 0, sizeof part);
    part.scene = &s->scene;
    part.first_id = 1;
    part.count = s->count;
    part.in[0] = part.in[1] = 1;
    for (int32_t depth = 4; depth <= 10 && refused == 0.0; depth += 2) {
        refused +=
            lmb_voxels_init(&m->voxels, POOL, LMB_VOXELS_ONE, memory, bytes) != LMB_OK ||
            lmb_voxels_build(&m->voxels, &s->scene.bounds_min, &s->scene.bounds_max, depth, &part, 1) != LMB_OK ||
            m->voxels.count > POOL;
        worst = fmax(worst, fabs(m->voxels.area / area - 1.0));
    }
    hard_put(l, HARD_BOUNDED, "a full pool of voxels: area lost", refused == 0.0 ? 1e6 * worst : HUGE_VAL, 100, "ppm");
    free(memory);
}

void hard_mixed(hard_list *l)
{
    mixed_stage *m = calloc(1, sizeof *m);
    if (m != NULL) {
        pictures(l, m);
        all_planes(l, m);
        deltas(l, m);
        pools(l, m);
        free(m);
    }
}
