/* test_relit.c: cubes as the lookups use them, and objects lit at their places. Requirements S15-S24. */
#include <lambent/lambent.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/probe/cube.h"
#include "../world.h"

void test_relit(void);

enum { FACE = 16, SIDE = 8, TEXELS = 6 * SIDE * SIDE, PIXELS = 64 };

/* Two probes in one world, at one place each. */
typedef struct stage {
    float face[6][FACE * FACE * 3], planes[3 * TEXELS];
    lmb_world_pictures pictures;
    lmb_world world;
    lmb_probe_table table;
    float map[3 * 64 * 32];
    lmb_probe_lights lights;
    lmb_probe_rays rays;
    uint32_t world_memory[40000], table_memory[12000], cube[2][2][6 * (SIDE + 2) * (SIDE + 2) * 4];
    lmb_probe probe[2];
    uint16_t probe_of[2];
    lmb_shadow_map shadow_map;
    uint32_t light_memory[6 * 64 * 64 * 2];
    uint32_t depth[PIXELS * PIXELS], id[PIXELS * PIXELS];
    float out[3][PIXELS * PIXELS * 3]; /* indexed by LMB_RELIGHT_ */
    lmb_relight relight;
    lmb_relight_scratch scratch;
} stage;

/* radiance(direction), W/(m2 sr). */
static void make_world(stage *s, float (*radiance)(int c, lmb_vec3 d))
{
    for (int i = 0; i < 6 * FACE * FACE * 3; ++i) {
        const int at = i / 3, face = at / (FACE * FACE);
        const lmb_vec3 d = cube_direction(face, at % FACE, at / FACE % FACE, FACE);
        s->face[face][i - 3 * FACE * FACE * face] = radiance(i % 3, d);
        s->pictures.face[face] = s->face[face];
    }
    s->pictures.face_size = FACE;
    s->pictures.radius = 10.0f;
    CHECK(lmb_world_init(&s->world, &s->pictures, LMB_WORLD_F32, s->world_memory, sizeof s->world_memory) == LMB_OK);
    CHECK(lmb_probe_table_init(&s->table, 64, 32, -180.0f, s->table_memory, sizeof s->table_memory) == LMB_OK);
}

static void make_probe(stage *s, int i, lmb_vec3 at, float roughness)
{
    const lmb_kernels *k = picked_kernels();
    const lmb_world_query query = {&s->world, 0.0f, 0};
    memset(&s->probe[i], 0, sizeof s->probe[i]);
    CHECK(lmb_probe_remap(s->map, k, &s->world, &s->table, at, 0) == LMB_OK);
    CHECK(lmb_probe_reduce(&s->lights, k, s->map, &s->table) == LMB_OK);
    CHECK(lmb_probe_cosine(s->planes, SIDE, k, &s->lights, &s->table) == LMB_OK);
    CHECK(lmb_probe_cube_init(&s->probe[i].irradiance, s->planes, SIDE, s->cube[i][0], sizeof s->cube[i][0]) == LMB_OK);
    if (lmb_probe_glossy_side(roughness) > 0) {
        CHECK(lmb_probe_reflect(s->planes, SIDE, k, &s->rays, &query, at, roughness) == LMB_OK);
        CHECK(lmb_probe_cube_init(&s->probe[i].glossy, s->planes, SIDE, s->cube[i][1], sizeof s->cube[i][1]) == LMB_OK);
    }
}

/* Two white balls at x -1.2 and 1.2, an instance each, from 5 m in front. */
static void make_balls(stage *s, float f0, float roughness)
{
    world_begin(1.0f, 1.0f, 1.0f);
    for (int i = 0; i < 2; ++i) {
        for (int c = 0; c < 3; ++c) {
            world.material[i].specular[c] = f0;
        }
        world.material[i].roughness = roughness;
    }
    world_sphere(vec3(-1.2f, 0.0f, 0.0f), 1.0f, 24, 48);
    world_part();
    world_sphere(vec3(1.2f, 0.0f, 0.0f), 1.0f, 24, 48);
    CHECK(world_end() == LMB_OK);
    lmb_relight *r = &s->relight;
    memset(r, 0, sizeof *r);
    r->kernels = picked_kernels();
    r->scene = &world.scene;
    r->world = &s->world;
    r->probes = s->probe;
    r->probe_of = s->probe_of;
    r->probe_count = 2;
    r->view = look(vec3(0.0f, 0.0f, 5.0f), vec3(0, 0, 0), 50.0, PIXELS);
    r->view.near_m = 0.1f;
    r->eye = target_of(LMB_DEPTH32F, PIXELS, s->depth, s->id);
    world_draw(&r->eye, &r->view, LMB_CULL_BACK);
    s->probe_of[0] = 0;
    s->probe_of[1] = 1;
}

static lmb_status draw(stage *s, int32_t show)
{
    lmb_surface out;
    lmb_status status = LMB_OK;
    s->relight.show = show;
    CHECK(lmb_surface_init(&out, LMB_RGB32F, PIXELS, PIXELS, s->out[show], sizeof s->out[show]) == LMB_OK);
    for (int32_t band = PIXELS / LMB_TILE - 1; band >= 0 && status == LMB_OK; --band) {
        status = lmb_relight_band(&s->relight, &s->scratch, &out, band);
    }
    return status;
}

static const float *pixel(const stage *s, int32_t show, int x, int y) { return s->out[show] + 3 * (y * PIXELS + x); }

/* --- a white world ------------------------------------------------------------------------------------------------ */

static float white(int c, lmb_vec3 d)
{
    (void)c;
    (void)d;
    return 1.0f;
}

/* White objects in a white world are invisible, smooth or rough, with cubes or with the world. */
static void furnace(stage *s)
{
    static const float roughness[] = {0.0f, 0.3f, 1.0f};
    make_world(s, white);
    for (int i = 0; i < 3; ++i) {
        float worst = 0.0f;
        make_probe(s, 0, vec3(-1.2f, 0, 0), roughness[i]);
        make_probe(s, 1, vec3(1.2f, 0, 0), roughness[i]);
        make_balls(s, i == 1 ? 0.6f : 0.04f, roughness[i]);
        CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_OK);
        for (int k = 0; k < 3 * PIXELS * PIXELS; ++k) {
            worst = maxf(worst, fabsf(s->out[LMB_RELIGHT_BOTH][k] - 1.0f));
        }
        CHECK_MSG(worst < 2e-6f, "roughness %g: %g", (double)roughness[i], (double)worst);
    }
}

/* --- a world of colours ------------------------------------------------------------------------------------------- */

static float colours(int c, lmb_vec3 d) { return 1.0f + 0.8f * (c == 0 ? d.x : c == 1 ? d.y : d.z); }

/* S24: diffuse and glossy reflection add up to both; S22: glossy reflection is stronger at grazing angles. */
static void parts(stage *s)
{
    float worst = 0.0f, middle, rim;
    make_world(s, colours);
    make_probe(s, 0, vec3(-1.2f, 0, 0), 0.3f);
    make_probe(s, 1, vec3(1.2f, 0, 0), 0.0f);
    make_balls(s, 0.04f, 0.0f);
    world.material[0].roughness = 0.3f;
    for (int32_t show = 0; show < 3; ++show) {
        CHECK(draw(s, show) == LMB_OK);
    }
    for (int k = 0; k < 3 * PIXELS * PIXELS; ++k) {
        const float a = s->out[LMB_RELIGHT_NORMAL][k], b = s->out[LMB_RELIGHT_GLOSSY][k];
        worst = a != b ? maxf(worst, fabsf(a + b - s->out[LMB_RELIGHT_BOTH][k])) : worst; /* behind: the same world */
    }
    CHECK_MSG(worst < 1e-6f, "%g", (double)worst);
    middle = pixel(s, LMB_RELIGHT_GLOSSY, PIXELS * 3 / 4 - 2, PIXELS / 2)[1];
    rim = pixel(s, LMB_RELIGHT_GLOSSY, PIXELS * 3 / 4 - 2, 17)[1];
    CHECK_MSG(rim > 2.0f * middle && middle > 0.01f, "%g %g", (double)rim, (double)middle);
}

/* S17: a flat mirror shows the world along the reflected ray from the visible point, weighted by Schlick's term. */
static void mirror(stage *s)
{
    const lmb_vec3 u = vec3(2.0f, 0.0f, 0.0f), v = vec3(0.0f, 1.2f, -0.9f), n = normalize3(cross3(u, v));
    make_balls(s, 0.04f, 0.0f);
    const lmb_view *view = &s->relight.view;
    world_begin(0.0f, 0.0f, 0.0f);
    world.material[0].specular[0] = world.material[0].specular[1] = world.material[0].specular[2] = 0.04f;
    world_quad(vec3(0.0f, 0.0f, 0.0f), u, v);
    CHECK(world_end() == LMB_OK);
    s->probe_of[0] = 1; /* uses the world directly */
    world_draw(&s->relight.eye, view, 0);
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_OK);
    for (int y = 20; y < 50; y += 7) {
        const int x = y + 5;
        const lmb_vec3 d = normalize3(vec3((2.0f * ((float)x + 0.5f) / PIXELS - 1.0f) * view->half_width,
                                           (1.0f - 2.0f * ((float)y + 0.5f) / PIXELS) * view->half_height, -1.0f));
        const lmb_vec3 at = add3(view->eye, mul3(d, -dot3(view->eye, n) / dot3(d, n)));
        const lmb_vec3 r = sub3(d, mul3(n, 2.0f * dot3(n, d)));
        const float c = dot3(at, r), far = -c + sqrtf(c * c - dot3(at, at) + 100.0f), low = 1.0f + dot3(n, d);
        const lmb_vec3 seen = normalize3(add3(at, mul3(r, far)));
        for (int k = 0; k < 3; ++k) {
            const float want = colours(k, seen) * (0.04f + 0.96f * 0.970299f * powf(low, 5.0f)); /* alpha: 0.01 */
            CHECK_MSG(fabsf(pixel(s, 0, x, y)[k] - want) < 0.01f * want, "%d, %d: %g, not %g", x, k,
                      (double)pixel(s, 0, x, y)[k], (double)want);
        }
    }
}

/* S21: a ball's top is lit from above: pi (1 + 0.8 x 2/3 n.y) / pi there. S15: each ball uses its probe. */
static void normals(stage *s)
{
    make_balls(s, 0.0f, 0.5f);
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_OK);
    const float *top = pixel(s, 0, 15, 18), *bottom = pixel(s, 0, 15, 45);
    CHECK(top[1] > 1.3f && top[1] < 1.0f + 0.8f * 2.0f / 3.0f && bottom[1] > 0.46f && bottom[1] < 0.7f);
    const float front = pixel(s, 0, 48, 32)[2];
    CHECK_MSG(fabsf(front - (1.0f + 0.8f * 2.0f / 3.0f)) < 0.02f, "%g", (double)front);
    s->probe_of[1] = 0;
    memset(s->cube[0][0], 0, sizeof s->cube[0][0]); /* the first probe goes dark: both balls are */
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_OK);
    CHECK(pixel(s, 0, 48, 32)[2] == 0.0f && pixel(s, 0, 16, 32)[2] == 0.0f);
}

/* In the background, the view's rays see the world from its centre. */
static void background(stage *s)
{
    const lmb_view *v = &s->relight.view;
    s->relight.view.eye = vec3(0.0f, 0.0f, 0.0f); /* the sky uses nothing else of the view */
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_OK);
    const float x = (2.0f * 2.5f / PIXELS - 1.0f) * v->half_width, y = (1.0f - 2.0f * 3.5f / PIXELS) * v->half_height;
    const lmb_vec3 d = normalize3(vec3(x, y, -1.0f));
    for (int c = 0; c < 3; ++c) {
        CHECK(fabsf(pixel(s, 0, 2, 3)[c] - colours(c, d)) < 0.01f);
    }
}

/* One light in a dark world, and its shadow. */
static float black(int c, lmb_vec3 d) { return 0.0f * white(c, d); }

static void one_light(stage *s)
{
    const lmb_kernels *k = picked_kernels();
    lmb_light light = sun(vec3(1.0f, 0.0f, 0.0f));
    make_world(s, black);
    make_probe(s, 0, vec3(0, 0, 0), 0.5f);
    make_probe(s, 1, vec3(0, 0, 0), 0.5f);
    make_balls(s, 0.0f, 0.5f);
    world.scene.lights = &light;
    world.scene.light_count = 1;
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_OK);
    const float alone = pixel(s, 0, 40, 32)[0];
    CHECK(alone > 0.2f && pixel(s, 0, 1, 1)[0] == 0.0f);
    CHECK(lmb_shadow_map_init(&s->shadow_map, &light, &world.scene, 64, LMB_ID32, s->light_memory,
                              sizeof s->light_memory) == LMB_OK);
    CHECK(lmb_shadow_map_clear(&s->shadow_map) == LMB_OK);
    CHECK(lmb_shadow_map_draw(&s->shadow_map, k, &world.scene, 1, WORLD_TRIANGLES, NULL) == LMB_OK);
    s->relight.maps = &s->shadow_map;
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_OK);
    const float shaded = pixel(s, 0, 40, 32)[0], left = pixel(s, 0, 6, 32)[0]; /* the left one shadows the right one */
    CHECK_MSG(shaded == 0.0f && left > 0.1f, "%g %g", (double)shaded, (double)left);
}

/* --- facets smaller than pixels ----------------------------------------------------------------------------------- */

enum { CELLS = 60, GRID = 15 /* covered pixels from the centre each way, plus one */ };

static float half_lit(int c, lmb_vec3 d) { return c >= 0 && d.x > 0.0f ? 1.0f : 0.0f; }

/* A grid corner, with a reproducible height of up to `rough` m. */
static lmb_vec3 corner_of(int x, int y, float rough)
{
    const uint32_t hash = ((uint32_t)x * 73856093u ^ (uint32_t)y * 19349663u) * 2654435761u;
    const float high = rough * (float)(hash >> 8) / 16777216.0f;
    return vec3(0.04f * (float)(x - CELLS / 2), 0.04f * (float)(y - CELLS / 2), high);
}

/* A mirror across the view with `cells` squares each way: with CELLS, several triangles share each pixel. */
static void draw_grid(stage *s, int cells, float rough)
{
    const int wide = CELLS / cells;
    make_balls(s, 1.0f, 0.0f);
    world_begin(0.0f, 0.0f, 0.0f);
    world.material[0].specular[0] = world.material[0].specular[1] = world.material[0].specular[2] = 1.0f;
    for (int i = 0; i < cells * cells; ++i) {
        const int x = i % cells * wide, y = i / cells * wide;
        const lmb_vec3 a = corner_of(x, y, rough), c = corner_of(x + wide, y + wide, rough);
        world_triangle(a, corner_of(x + wide, y, rough), c);
        world_triangle(a, c, corner_of(x, y + wide, rough));
    }
    CHECK(world_end() == LMB_OK);
    s->probe_of[0] = 1; /* uses the world directly */
    world_draw(&s->relight.eye, &s->relight.view, 0);
    CHECK(draw(s, LMB_RELIGHT_GLOSSY) == LMB_OK);
}

static float red(const stage *s, int x, int y) { return pixel(s, LMB_RELIGHT_GLOSSY, x, y)[0]; }

/* Returns whether the pixel's red differs by a third from all eight neighbours in the same direction. */
static int is_speck(const stage *s, int x, int y)
{
    int above = 1, below = 1;
    for (int k = 0; k < 9; ++k) {
        const float off = red(s, x, y) - red(s, x + k % 3 - 1, y + k / 3 - 1);
        above &= k == 4 || off > 0.33f;
        below &= k == 4 || off < -0.33f;
    }
    return above | below;
}

/* A rough mirror has no specks and the mean brightness of the facets; a flat one with as many triangles equals one of
 * two. */
static void small_facets(stage *s)
{
    static float whole[PIXELS * PIXELS];
    float sum = 0.0f, worst = 0.0f;
    int specks = 0;
    make_world(s, half_lit);
    make_probe(s, 1, vec3(0.0f, 0.0f, 0.0f), 0.0f);
    draw_grid(s, CELLS, 0.02f);
    for (int i = 0; i < 4 * GRID * GRID; ++i) {
        const int x = PIXELS / 2 - GRID + i % (2 * GRID), y = PIXELS / 2 - GRID + i / (2 * GRID);
        sum += red(s, x, y) / (4.0f * GRID * GRID);
        specks += is_speck(s, x, y);
    }
    CHECK_MSG(specks == 0, "%d specks", specks);
    CHECK_MSG(fabsf(sum - 0.5f) < 0.05f, "%g", (double)sum);
    draw_grid(s, 1, 0.0f);
    for (int i = 0; i < PIXELS * PIXELS; ++i) {
        whole[i] = red(s, i % PIXELS, i / PIXELS);
    }
    draw_grid(s, CELLS, 0.0f);
    for (int i = 0; i < PIXELS * PIXELS; ++i) {
        worst = maxf(worst, fabsf(whole[i] - red(s, i % PIXELS, i / PIXELS)));
    }
    CHECK_MSG(worst < 1e-4f, "%g", (double)worst);
}

/* --- cubes -------------------------------------------------------------------------------------------------------- */

/* The red value of a lookup. */
static float found(const lmb_probe_cube *cube, lmb_vec3 d)
{
    static lmb_probe_rays rays;
    static lmb_tile tile;
    lmb_irradiance e;
    memset(&e, 0, sizeof e);
    tile.normal[0][9] = d.x;
    tile.normal[1][9] = d.y;
    tile.normal[2][9] = d.z;
    CHECK(lmb_probe_light_tile(&e, picked_kernels(), &rays, &tile, 1u << 9, cube) == LMB_OK);
    CHECK(e.rgb[0][8] == 0.0f);
    return e.rgb[0][9];
}

/* No step across a cube's edges and corners exceeds the steps inside a face: rings over faces of noise. */
static void no_edges(stage *s)
{
    static const lmb_vec3 axis[3] = {{0, 0, 1}, {0.3f, 1, 0.2f}, {1, -1, 0}}; /* the last ring crosses two corners */
    lmb_probe_cube cube;
    uint32_t random = 77u;
    for (int i = 0; i < 3 * TEXELS; ++i) {
        random = random * 1664525u + 1013904223u;
        s->planes[i] = (float)(random >> 8) * (1.0f / 16777216.0f);
    }
    CHECK(lmb_probe_cube_init(&cube, s->planes, SIDE, s->cube[0][0], sizeof s->cube[0][0]) == LMB_OK);
    for (int ring = 0; ring < 3; ++ring) {
        const lmb_vec3 n = normalize3(axis[ring]), u = normalize3(cross3(n, vec3(0.1f, 0.2f, 1.0f))), v = cross3(n, u);
        float last = found(&cube, u), worst = 0.0f;
        for (int i = 1; i <= 2000; ++i) {
            const double a = 2.0 * PI * i / 2000.0;
            const float here = found(&cube, add3(mul3(u, (float)cos(a)), mul3(v, (float)sin(a))));
            worst = maxf(worst, fabsf(here - last));
            last = here;
        }
        CHECK_MSG(worst < 0.045f, "%d: %g", ring, (double)worst); /* 2000 steps, 32 texels per turn: 1/62 of a texel */
    }
    const lmb_vec3 corner = vec3(1.0f, 1.0f, 1.0f);
    const float a = found(&cube, add3(corner, vec3(1e-4f, 0, 0))), b = found(&cube, add3(corner, vec3(0, 1e-4f, 0))),
                c = found(&cube, add3(corner, vec3(0, 0, 1e-4f)));
    CHECK(fabsf(a - b) < 1e-3f && fabsf(b - c) < 1e-3f);
}

static void refusals(stage *s)
{
    lmb_surface out;
    float *planes = s->planes;
    lmb_probe_cube cube;
    CHECK(lmb_probe_cube_bytes(0) == 0 && lmb_probe_cube_bytes(257) == 0 && lmb_probe_cube_bytes(8) == 9600);
    CHECK(lmb_probe_cube_init(&cube, planes, 8, s->cube, 9599) == LMB_ERR_CAPACITY);
    CHECK(lmb_probe_cube_init(&cube, NULL, 8, s->cube, 9600) == LMB_ERR_ARG);
    make_balls(s, 0.04f, 0.5f);
    CHECK(lmb_surface_init(&out, LMB_RGB32F, PIXELS, PIXELS, s->out[0], sizeof s->out[0]) == LMB_OK);
    CHECK(lmb_relight_band(&s->relight, &s->scratch, &out, PIXELS / LMB_TILE) == LMB_ERR_ARG);
    CHECK(lmb_relight_band(&s->relight, &s->scratch, NULL, 0) == LMB_ERR_FORMAT);
    s->probe_of[1] = 2;
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_ERR_ARG);
    s->probe_of[1] = 1;
    s->probe[1].irradiance.texel = NULL;
    CHECK(draw(s, LMB_RELIGHT_BOTH) == LMB_ERR_ARG);
    const lmb_world_query query = {&s->world, 0.0f, 0};
    CHECK(lmb_probe_reflect(planes, 8, picked_kernels(), &s->rays, &query, vec3(0, 0, 0), 1.5f) == LMB_ERR_ARG);
    CHECK(lmb_probe_reflect(planes, 8, picked_kernels(), &s->rays, &query, vec3(NAN, 0, 0), 0.5f) == LMB_ERR_ARG);
}

void test_relit(void)
{
    stage *s = calloc(1, sizeof *s);
    CHECK(s != NULL);
    if (s != NULL) {
        furnace(s);
        parts(s);
        mirror(s);
        normals(s);
        background(s);
        one_light(s);
        small_facets(s);
        no_edges(s);
        refusals(s);
    }
    free(s);
}
