/* golden_mixed.c: cases of mixed pictures: points, planes and mesh of a noisy corner, a folded cube, a delta.
 *                                                                                              [M1-M4 M14-M19 M23] */
#include "golden_cases.h"

#include <string.h>

#if LMB_MIXED

enum { WIDTH = 56, HEIGHT = 40, PIXELS = WIDTH * HEIGHT, STEP = 4, CELLS = PIXELS / (STEP * STEP), CUBE = 8 };

typedef struct mixed_space {
    float depth[PIXELS], photo[PIXELS * 3];
    uint32_t cloud[PIXELS * 4], planes[PIXELS * 5 / 4], mesh[CELLS * 24];
} mixed_space;
GOLDEN_FITS(mixed_space, first);

typedef struct answer_space {
    lmb_tile tile;
    lmb_irradiance without, with;
    lmb_radiance photo;
    uint32_t cube[CUBE * CUBE * 6 * 3];
    lmb_planes planes;
    lmb_real_mesh mesh;
} answer_space;
GOLDEN_FITS(answer_space, second);

static const lmb_pinhole camera = {WIDTH, HEIGHT, 45.0f, 45.0f, 27.5f, 19.5f};

/* A floor and a wall, a box in front of them with unmeasured pixels at the sides, and noise. */
static void draw_corner(mixed_space *s)
{
    golden_soup(8u, 1.0f);
    for (int i = 0; i < PIXELS; ++i) {
        const lmb_vec3 ray = lmb_cloud_ray(&camera, (float)(i % WIDTH), (float)(i / WIDTH));
        float inverse = ray.y < -0.2f ? -2.0f * ray.y : 0.4f;
        inverse = i % WIDTH > 36 && i % WIDTH < 46 && i / WIDTH > 10 && i / WIDTH < 30 ? 0.7f : inverse;
        inverse += golden_random(-0.003f, 0.003f);
        s->depth[i] = i % WIDTH == 36 || i % 19 == 7 ? 0.0f : 1.0f / inverse;
        for (int c = 0; c < 3; ++c) {
            s->photo[3 * i + c] = golden_random(0.0f, 1.0f);
        }
    }
}

static uint64_t hash_planes(uint64_t h, const lmb_planes *planes)
{
    for (int32_t i = 0; i < planes->count; ++i) {
        const lmb_flat *p = &planes->plane[i];
        h = golden_hash_floats(h, p->slope, 3);
        h = golden_hash_floats(h, &p->normal.x, 3);
        h = golden_hash_floats(h, &p->centre.x, 3);
        h = golden_hash_u32(h, (uint32_t)p->pixels);
    }
    for (int32_t i = 0; i < PIXELS; ++i) {
        h = golden_hash_u32(h, planes->label[i]);
    }
    return h;
}

static uint64_t hash_tiles(uint64_t h, answer_space *a, const lmb_cloud *cloud, const lmb_axes *axes)
{
    for (int32_t y = 0; y < HEIGHT; y += LMB_TILE) {
        for (int32_t x = 0; x < WIDTH; x += LMB_TILE) {
            h = golden_hash_u32(h, (uint32_t)lmb_real_tile(&a->tile, cloud, &a->planes, &a->mesh, axes, x, y));
            h = golden_hash_floats(h, a->tile.position[0], 3 * LMB_TILE_PIXELS);
            h = golden_hash_floats(h, a->tile.normal[0], 3 * LMB_TILE_PIXELS);
        }
    }
    return h;
}

uint64_t case_mixed(int variant)
{
    mixed_space *s = golden_first();
    answer_space *a = golden_second();
    lmb_cloud cloud;
    uint64_t h = GOLDEN_START;
    draw_corner(s);
    h = golden_hash_u32(h, (uint32_t)lmb_cloud_init(&cloud, &camera, s->depth, s->cloud, sizeof s->cloud));
    lmb_cloud_normals(&cloud, 0, LMB_MAX_SIDE);
    h = golden_hash_floats(h, &cloud.normal[0].x, 3 * PIXELS);
    h = golden_hash_u32(h, (uint32_t)lmb_planes_find(&a->planes, &cloud, s->planes, sizeof s->planes));
    h = hash_planes(h, &a->planes);
    if (variant == 0) {
        return h;
    }
    const int32_t floor = lmb_planes_floor(&a->planes);
    const lmb_axes axes = lmb_axes_upright(a->planes.plane[floor < 0 ? 0 : floor].normal);
    lmb_planes_move(&cloud, &a->planes);
    h = golden_hash_u32(h, (uint32_t)lmb_real_mesh_build(&a->mesh, &cloud, &a->planes, STEP, &axes, s->mesh,
                                                         sizeof s->mesh));
    h = golden_hash_floats(h, a->mesh.positions, (size_t)a->mesh.count * 12);
    return hash_tiles(h, a, &cloud, &axes);
}

/* A tile of the photo with light removed and added, under the folded cube. */
uint64_t case_folded(int variant)
{
    mixed_space *s = golden_first();
    answer_space *a = golden_second();
    lmb_env env;
    uint64_t h = GOLDEN_START;
    const lmb_axes axes = lmb_axes_upright((lmb_vec3){0.0f, 0.8f, 0.6f});
    draw_corner(s);
    lmb_env_init(&env, CUBE, a->cube, sizeof a->cube);
    h = golden_hash_u32(h, (uint32_t)lmb_env_fold(&env, s->photo, WIDTH, HEIGHT, &axes));
    for (size_t i = 0; i < lmb_env_bytes(CUBE) / 2; ++i) {
        h = golden_hash_u32(h, env.texels[i]);
    }
    memset(&a->tile, 0, sizeof a->tile);
    for (int32_t k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 d = {(float)(k % 8) - 3.4f, (float)(k / 8) - 3.3f, 1.5f};
        float seen[3];
        lmb_env_sample(seen, &env, d, 0.02f * (float)k);
        a->tile.id[k] = (uint32_t)(k % 5);
        for (int c = 0; c < 3; ++c) {
            a->photo.rgb[c][k] = s->photo[3 * k + c];
            a->without.rgb[c][k] = seen[c];
            a->with.rgb[c][k] = seen[(c + variant) % 3];
        }
    }
    h = golden_hash_u32(h, (uint32_t)lmb_delta_tile(&a->photo, &a->tile, &a->without, &a->with));
    return golden_hash_floats(h, a->photo.rgb[0], 3 * LMB_TILE_PIXELS);
}

#endif
