/* golden_probe.c: cases of worlds: surroundings and light at places, and objects drawn in them. [S1-S24] */
#include "golden_cases.h"

#include <string.h>

#if LMB_PROBES

enum { FACE = 8, GROUND = 16, WIDTH = 32, HEIGHT = 16, SIDE = 4, TEXELS = 6 * SIDE * SIDE };

typedef struct probe_space {
    float face[6][FACE * FACE * 3], ground[GROUND * GROUND * 4];
    uint32_t world_memory[5400], table_memory[3200], blur_memory[2600];
    lmb_world world;
    lmb_probe_table table;
    lmb_probe_lights lights;
    lmb_probe_blur blur;
    lmb_probe_rays rays;
    float map[3 * WIDTH * HEIGHT], blurred[3 * WIDTH * HEIGHT], cube[3 * TEXELS], line[4 * WIDTH];
} probe_space;
GOLDEN_FITS(probe_space, first);

typedef struct relit_space {
    uint32_t cube[2][2][6 * (SIDE + 2) * (SIDE + 2) * 4];
    lmb_relight_scratch scratch;
    float out[GOLDEN_WIDTH * LMB_TILE * 3];
} relit_space;
GOLDEN_FITS(relit_space, second);

/* Two faces of six are missing, and the ground's border is blank. */
static void set_pictures(lmb_world_pictures *p, probe_space *s, int32_t shape)
{
    golden_soup(5u, 1.0f);
    memset(p, 0, sizeof *p);
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < FACE * FACE * 3; ++k) {
            s->face[i][k] = golden_random(0.0f, 8.0f);
        }
        p->face[i] = i % 3 == 1 ? NULL : s->face[i];
    }
    for (int k = 0; k < GROUND * GROUND * 4; ++k) {
        const int x = k / 4 % GROUND, y = k / 4 / GROUND;
        s->ground[k] = k % 4 < 3 ? golden_random(0.0f, 2.0f) : x > 0 && y > 1 ? 1.0f : 0.0f;
    }
    p->face_size = FACE;
    p->ground = s->ground;
    p->ground_width = p->ground_height = GROUND;
    p->ground_x = p->ground_z = -6.0f;
    p->ground_width_m = p->ground_depth_m = 12.0f;
    p->ground_y = -2.0f;
    p->shape = shape;
    p->radius = 20.0f;
    p->low = (lmb_vec3){-9.0f, -3.0f, -11.0f};
    p->high = (lmb_vec3){8.0f, 7.0f, 10.0f};
}

static lmb_status make(probe_space *s, int32_t format, int32_t shape)
{
    lmb_world_pictures p;
    set_pictures(&p, s, shape);
    const lmb_status table =
        lmb_probe_table_init(&s->table, WIDTH, HEIGHT, -90.0f, s->table_memory, sizeof s->table_memory);
    return table != LMB_OK ? table : lmb_world_init(&s->world, &p, format, s->world_memory, sizeof s->world_memory);
}

static uint64_t hash_cube(uint64_t h, const probe_space *s)
{
    return golden_hash_floats(h, s->cube, sizeof s->cube / sizeof *s->cube);
}

static uint64_t blurred(uint64_t h, probe_space *s, int32_t terms)
{
    h = golden_hash_u32(h, (uint32_t)lmb_probe_blur_init(&s->blur, &s->table, terms, s->blur_memory,
                                                         sizeof s->blur_memory));
    lmb_probe_blur_map(s->blurred, golden_kernels, s->line, s->map, &s->blur);
    lmb_probe_map_cube(s->cube, SIDE, s->blurred, &s->table);
    return hash_cube(golden_hash_floats(h, s->blurred, sizeof s->blurred / sizeof *s->blurred), s);
}

/* All of a place's light. Variant: the storage; + 3: a box, ground and far world blended. */
uint64_t case_probe(int variant)
{
    static const lmb_vec3 at = {1.5f, -1.0f, 3.0f};
    probe_space *s = golden_first();
    float harmonics[3][LMB_SH_25];
    uint64_t h = golden_hash_u32(GOLDEN_START, (uint32_t)make(s, variant % 3, variant / 3));
    const lmb_world_query query = {&s->world, 0.0f, variant / 3};
    lmb_probe_remap(s->map, golden_kernels, &s->world, &s->table, at, variant / 3);
    h = golden_hash_floats(h, s->map, sizeof s->map / sizeof *s->map);
    lmb_probe_reduce(&s->lights, golden_kernels, s->map, &s->table);
    lmb_probe_cosine(s->cube, SIDE, golden_kernels, &s->lights, &s->table);
    h = hash_cube(h, s);
    lmb_probe_sh(harmonics, s->map, &s->table);
    lmb_probe_sh_cube(s->cube, SIDE, (const float (*)[LMB_SH_25])harmonics, LMB_SH_25);
    h = hash_cube(h, s);
    for (int32_t i = 0; i < 3; ++i) {
        lmb_probe_reflect(s->cube, SIDE, golden_kernels, &s->rays, &query, at, 0.4f * (float)i);
        h = hash_cube(h, s);
    }
    return blurred(h, s, variant % 3);
}

/* Cubes of light and of reflections at two places. */
static void set_probes(lmb_probe probe[2], relit_space *relit, probe_space *s)
{
    static const lmb_vec3 at[2] = {{1.5f, -1.0f, 3.0f}, {-2.0f, 0.0f, -1.0f}};
    const lmb_world_query query = {&s->world, 0.0f, 0};
    for (int i = 0; i < 2; ++i) {
        lmb_probe_remap(s->map, golden_kernels, &s->world, &s->table, at[i], 0);
        lmb_probe_reduce(&s->lights, golden_kernels, s->map, &s->table);
        lmb_probe_cosine(s->cube, SIDE, golden_kernels, &s->lights, &s->table);
        lmb_probe_cube_init(&probe[i].irradiance, s->cube, SIDE, relit->cube[i][0], sizeof relit->cube[i][0]);
        lmb_probe_reflect(s->cube, SIDE, golden_kernels, &s->rays, &query, at[i], 0.5f);
        lmb_probe_cube_init(&probe[i].glossy, s->cube, SIDE, relit->cube[i][1], sizeof relit->cube[i][1]);
    }
    probe[1].glossy.texel = NULL; /* samples the world itself */
}

/* Two instances with a probe each, a light, and the world as background. Variant: LMB_RELIGHT_. */
uint64_t case_relit(int variant)
{
    static const uint16_t probe_of[2] = {0, 1};
    probe_space *s = golden_first();
    relit_space *relit = golden_second();
    lmb_probe probe[2];
    lmb_relight r;
    lmb_surface out;
    uint64_t h = golden_hash_u32(GOLDEN_START, (uint32_t)make(s, LMB_WORLD_LOG16, LMB_WORLD_SPHERE));
    memset(&r, 0, sizeof r);
    set_probes(probe, relit, s);
    lmb_scene *scene = golden_soup(11u, 1.2f);
    lmb_material glossy_material[2] = {scene->materials[0], scene->materials[1]};
    for (int i = 0; i < 2; ++i) {
        glossy_material[i].specular[0] = glossy_material[i].specular[1] = 0.3f;
        glossy_material[i].specular[2] = 0.6f;
        glossy_material[i].roughness = 0.5f * (float)(1 - i);
    }
    scene->materials = glossy_material;
    scene->light_count = 0;
    r.kernels = golden_kernels;
    r.scene = scene;
    r.world = &s->world;
    r.probes = probe;
    r.probe_of = probe_of;
    r.probe_count = 2;
    r.view = golden_soup_view(0);
    r.eye = golden_eye(LMB_DEPTH32F, LMB_ID16);
    r.show = variant;
    lmb_status status = lmb_draw(&r.eye, golden_kernels, &r.view, scene, 1, UINT32_MAX - 1, 0, NULL);
    lmb_surface_init(&out, LMB_RGB32F, GOLDEN_WIDTH, LMB_TILE, relit->out, sizeof relit->out);
    for (int32_t band = 0; band < (GOLDEN_HEIGHT + LMB_TILE - 1) / LMB_TILE && status == LMB_OK; ++band) {
        status = lmb_relight_band(&r, &relit->scratch, &out, band);
        h = golden_hash_floats(h, relit->out, sizeof relit->out / sizeof *relit->out);
    }
    return golden_hash_u32(h, (uint32_t)status);
}

/* A world with a ground, and all memory of one object's update, with a map of 48 x 24: under 64 KiB. */
typedef struct small_update {
    uint32_t world_memory[1400], table_memory[4400];
    lmb_world world;
    lmb_probe_table table;
    lmb_probe_lights lights;
    union {
        float map[3 * 48 * 24];
        struct {
            float planes[3 * 6 * 8 * 8];
            uint32_t cube[6 * 10 * 10 * 4];
        } after; /* the map became lights */
    } step;
} small_update;
GOLDEN_FITS(small_update, second);

/* The work of a small device for an object that moved. */
uint64_t case_small_probe(int variant)
{
    static const lmb_vec3 at = {1.5f, -1.0f, 3.0f};
    probe_space *pictures = golden_first(); /* these may lie in flash */
    small_update *s = golden_second();
    lmb_world_pictures p;
    lmb_probe_cube cube;
    (void)variant;
    set_pictures(&p, pictures, LMB_WORLD_SPHERE);
    lmb_status status = lmb_probe_table_init(&s->table, 48, 24, -180.0f, s->table_memory, sizeof s->table_memory);
    if (status == LMB_OK) {
        status = lmb_world_init(&s->world, &p, LMB_WORLD_LOG8, s->world_memory, sizeof s->world_memory);
    }
    if (status == LMB_OK) {
        lmb_probe_remap(s->step.map, golden_kernels, &s->world, &s->table, at, 0);
        lmb_probe_reduce(&s->lights, golden_kernels, s->step.map, &s->table);
        lmb_probe_cosine(s->step.after.planes, 8, golden_kernels, &s->lights, &s->table);
        status = lmb_probe_cube_init(&cube, s->step.after.planes, 8, s->step.after.cube, sizeof s->step.after.cube);
    }
    return golden_hash_floats(golden_hash_u32(GOLDEN_START, (uint32_t)status),
                              (const float *)(const void *)s->step.after.cube, 6 * 10 * 10 * 4);
}

#endif
