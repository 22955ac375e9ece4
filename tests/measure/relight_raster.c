/* relight_raster.c: the baseline that the filters avoid: rendering a cube map at a place of truth/env_relight.
 *
 * The world as a mesh (the ground up to 150 m, a sphere of 128 x 64 quads) is drawn into six views of 64 x 64 pixels,
 * one ray a pixel. Each pixel samples the float pictures at its uv, bilinearly. 4 x 4 pixels become a light with their
 * exact solid angles. The 6 x 16 x 16 lights are summed by cosine for 6 x 8 x 8 normals. Drawing, resolving and summing
 * use lambent's kernels; sampling pictures and reducing are plain C. */
#include <math.h>
#include <string.h>

#include "../../src/probe/cube.h"
#include "../truth_scene.h"
#include "relight_stage.h"

enum { VIEW = 64, PIXELS = 6 * VIEW * VIEW, COARSE = 16, BLOCK = VIEW / COARSE, QUARTERS = 4 };
enum { ACROSS = 128, DOWN = 64, ROUND = (ACROSS + 1) * (DOWN + 1), VERTICES = ROUND + 4,
       GROUND_ID = 2 * ACROSS * DOWN + 1, TRIANGLES = GROUND_ID + 1 };
static const float far_m = 150.0f, half_ground_m = 100.0f;

enum { DRAW, RESOLVE, READ, REDUCE, SUM, STEPS };
static const char *const step_names[STEPS] = {"draw six views of 64 x 64", "resolve uv", "read the pictures",
                                              "reduce to 6 x 16 x 16 lights", "sum for 6 x 8 x 8 normals"};

typedef struct raster {
    relight_stage *stage;
    image ground, sphere;
    float position[VERTICES][3], uv[VERTICES][2];
    uint16_t index[TRIANGLES][3];
    lmb_mesh mesh;
    lmb_material material;
    lmb_instance instance;
    lmb_scene scene;
    lmb_view view[6];
    lmb_target target[6];
    float depth[6][VIEW * VIEW];
    uint32_t id[6][VIEW * VIEW];
    lmb_tile tile;
    float seen_uv[PIXELS][2], seen[PIXELS][3]; /* by pixel of the cube map */
    uint8_t on_ground[PIXELS];
    float area[VIEW * VIEW]; /* sr */
    /* The lights, split into quarters by even or odd column and row: lmb_probe_cosine takes one quarter and returns pi
     * times the mean. `whole` converts that to a sum: the cosine-weighted sum of the solid angles, over pi. */
    lmb_probe_lights lights[QUARTERS];
    lmb_probe_table table[QUARTERS];
    float direction[QUARTERS][3 * TEXELS], whole[QUARTERS][TEXELS], part[3 * TEXELS];
    int step;
} raster;

/* --- the world as a mesh ------------------------------------------------------------------------------------------ */

static void set_vertex(raster *r, int i, lmb_vec3 p, float u, float v)
{
    r->position[i][0] = p.x;
    r->position[i][1] = p.y;
    r->position[i][2] = p.z;
    r->uv[i][0] = u;
    r->uv[i][1] = v;
}

static void set_quad(raster *r, int first, int a, int b, int c, int d)
{
    const int corner[6] = {a, b, c, a, c, d};
    for (int i = 0; i < 6; ++i) {
        r->index[first + i / 3][i % 3] = (uint16_t)corner[i];
    }
}

static void set_sphere(raster *r)
{
    for (int i = 0; i < ROUND; ++i) {
        const double u = (double)(i % (ACROSS + 1)) / ACROSS, v = (double)(i / (ACROSS + 1)) / DOWN;
        double d[3];
        sky_direction(d, 2.0 * u, v, 1);
        set_vertex(r, i, mul3(vec3((float)d[0], (float)d[1], (float)d[2]), far_m), (float)u, (float)v);
    }
    for (int i = 0; i < ACROSS * DOWN; ++i) {
        const int at = i / ACROSS * (ACROSS + 1) + i % ACROSS;
        set_quad(r, 2 * i, at, at + ACROSS + 1, at + ACROSS + 2, at + 1);
    }
}

static void set_ground(raster *r)
{
    for (int i = 0; i < 4; ++i) {
        const float x = i == 1 || i == 2 ? far_m : -far_m, z = i > 1 ? far_m : -far_m;
        set_vertex(r, ROUND + i, vec3(x, 0.0f, z), 0.5f + 0.5f * x / half_ground_m, 0.5f + 0.5f * z / half_ground_m);
    }
    set_quad(r, GROUND_ID - 1, ROUND, ROUND + 1, ROUND + 2, ROUND + 3);
}

static void set_scene(raster *r)
{
    set_sphere(r);
    set_ground(r);
    r->mesh.positions = r->position;
    r->mesh.uvs = r->uv;
    r->mesh.indices = r->index;
    r->mesh.index_format = LMB_INDEX_U16;
    r->mesh.vertex_count = VERTICES;
    r->mesh.triangle_count = TRIANGLES;
    r->material.alpha = 1.0f;
    r->material.texture = -1;
    r->material.flags = LMB_DOUBLE_SIDED;
    for (int i = 0; i < 4; ++i) {
        r->instance.to_world.m[5 * i] = 1.0f;
    }
    r->instance.first_id = 1;
    r->scene.meshes = &r->mesh;
    r->scene.materials = &r->material;
    r->scene.instances = &r->instance;
    r->scene.mesh_count = r->scene.material_count = r->scene.instance_count = 1;
    r->scene.bounds_min = vec3(-far_m, -far_m, -far_m);
    r->scene.bounds_max = vec3(far_m, far_m, far_m);
    CHECK(lmb_scene_check(&r->scene) == LMB_OK);
}

/* --- set up once -------------------------------------------------------------------------------------------------- */

/* Cube maps are left-handed, so columns are drawn from the right. */
static void set_views(raster *r)
{
    for (int i = 0; i < 6; ++i) {
        lmb_view *v = &r->view[i];
        const lmb_vec3 middle = cube_point(i, 0.0f, 0.0f);
        v->right = sub3(middle, cube_point(i, 1.0f, 0.0f));
        v->up = sub3(middle, cube_point(i, 0.0f, 1.0f));
        v->back = mul3(middle, -1.0f);
        v->half_width = v->half_height = 1.0f;
        v->near_m = 0.05f;
        v->far_m = 1000.0f;
        v->kind = LMB_PERSPECTIVE;
        v->frame_width = v->frame_height = VIEW;
        CHECK(lmb_surface_init(&r->target[i].depth, LMB_DEPTH32F, VIEW, VIEW, r->depth[i], sizeof r->depth[i]) ==
              LMB_OK);
        CHECK(lmb_surface_init(&r->target[i].id, LMB_ID32, VIEW, VIEW, r->id[i], sizeof r->id[i]) == LMB_OK);
    }
}

/* Solid angle of the cube's face from the middle to (x, y): the sum of d s d t / (1 + s^2 + t^2)^1.5. */
static double corner_area(double x, double y) { return atan2(x * y, sqrt(x * x + y * y + 1.0)); }

static void set_areas(raster *r)
{
    for (int i = 0; i < VIEW * VIEW; ++i) {
        const double x = 2.0 * (i % VIEW) / VIEW - 1.0, y = 2.0 * (i / VIEW) / VIEW - 1.0, d = 2.0 / VIEW;
        r->area[i] = (float)(corner_area(x + d, y + d) - corner_area(x, y + d) - corner_area(x + d, y) +
                             corner_area(x, y));
    }
}

/* Maps light (x, y) of a face to a quarter and a slot. */
static int quarter_of(int *slot, int face, int x, int y)
{
    *slot = (face * SIDE + y / 2) * SIDE + x / 2;
    return x % 2 + 2 * (y % 2);
}

static float block_area(const raster *r, int x, int y)
{
    float sum = 0.0f;
    for (int i = 0; i < BLOCK * BLOCK; ++i) {
        sum += r->area[(BLOCK * y + i / BLOCK) * VIEW + BLOCK * x + i % BLOCK];
    }
    return sum;
}

static void set_lights(raster *r)
{
    for (int i = 0; i < 6 * COARSE * COARSE; ++i) {
        const int x = i % COARSE, y = i / COARSE % COARSE, face = i / (COARSE * COARSE);
        int slot;
        const int q = quarter_of(&slot, face, x, y);
        const lmb_vec3 d = cube_direction(face, x, y, COARSE);
        const float area = block_area(r, x, y);
        r->table[q].light = r->direction[q];
        r->direction[q][slot] = d.x;
        r->direction[q][TEXELS + slot] = d.y;
        r->direction[q][2 * TEXELS + slot] = d.z;
        r->lights[q].rgbw[3][slot] = area;
        for (int k = 0; k < TEXELS; ++k) {
            const lmb_vec3 n = cube_direction(k / (SIDE * SIDE), k % SIDE, k / SIDE % SIDE, SIDE);
            r->whole[q][k] += maxf(dot3(n, d), 0.0f) * area / (float)PI;
        }
    }
}

/* --- per place ---------------------------------------------------------------------------------------------------- */

static void draw(raster *r)
{
    for (int i = 0; i < 6; ++i) {
        lmb_surface_clear(&r->target[i].depth);
        lmb_surface_clear(&r->target[i].id);
        lmb_draw(&r->target[i], r->stage->kernels, &r->view[i], &r->scene, 1, TRIANGLES, 0, NULL);
    }
}

static void resolve(raster *r)
{
    const lmb_tile *t = &r->tile;
    for (int i = 0; i < PIXELS / LMB_TILE_PIXELS; ++i) {
        const int face = i / (VIEW * VIEW / LMB_TILE_PIXELS), x = i % (VIEW / LMB_TILE) * LMB_TILE,
                  y = i / (VIEW / LMB_TILE) % (VIEW / LMB_TILE) * LMB_TILE;
        lmb_resolve_albedo(&r->tile, r->stage->kernels, &r->view[face], &r->scene, &r->target[face], x, y);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            const int at = (face * VIEW + y + k / LMB_TILE) * VIEW + VIEW - 1 - x - k % LMB_TILE;
            r->seen_uv[at][0] = t->uv[0][k];
            r->seen_uv[at][1] = t->uv[1][k];
            r->on_ground[at] = t->id[k] >= GROUND_ID;
        }
    }
}

static void read_all(raster *r)
{
    for (int i = 0; i < PIXELS; ++i) {
        const int ground = r->on_ground[i];
        relight_read(r->seen[i], ground ? &r->ground : &r->sphere, r->seen_uv[i][0], r->seen_uv[i][1], !ground);
    }
}

static void reduce(raster *r)
{
    for (int i = 0; i < 6 * COARSE * COARSE; ++i) {
        const int x = i % COARSE, y = i / COARSE % COARSE, face = i / (COARSE * COARSE);
        float sum[3] = {0.0f, 0.0f, 0.0f};
        int slot;
        for (int k = 0; k < BLOCK * BLOCK; ++k) {
            const int at = (BLOCK * y + k / BLOCK) * VIEW + BLOCK * x + k % BLOCK;
            for (int c = 0; c < 3; ++c) {
                sum[c] += r->seen[face * VIEW * VIEW + at][c] * r->area[at];
            }
        }
        lmb_probe_lights *lights = &r->lights[quarter_of(&slot, face, x, y)];
        for (int c = 0; c < 3; ++c) {
            lights->rgbw[c][slot] = sum[c];
        }
    }
}

static void sum_lights(raster *r)
{
    float *cube = r->stage->cube;
    memset(cube, 0, 3 * TEXELS * sizeof *cube);
    for (int q = 0; q < QUARTERS; ++q) {
        lmb_probe_cosine(r->part, SIDE, r->stage->kernels, &r->lights[q], &r->table[q]);
        for (int k = 0; k < 3 * TEXELS; ++k) {
            cube[k] += r->part[k] * r->whole[q][k % TEXELS];
        }
    }
}

static void take_step(void *context)
{
    static void (*const steps[STEPS])(raster *) = {draw, resolve, read_all, reduce, sum_lights};
    raster *r = context;
    steps[r->step](r);
}

static void light_at(raster *r, lmb_vec3 at)
{
    for (int i = 0; i < 6; ++i) {
        r->view[i].eye = at;
    }
    for (r->step = 0; r->step < STEPS; ++r->step) {
        take_step(r);
    }
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

/* Times of the steps for the last place. */
static void print_times(raster *r)
{
    double whole = 0.0;
    printf("| step of a rendered cube | us, %s |\n|---|---|\n", lmb_kernels_name(r->stage->kernels));
    for (r->step = 0; r->step < STEPS; ++r->step) {
        const double s = relight_seconds(take_step, r);
        whole += s;
        printf("| %s | %.1f |\n", step_names[r->step], 1e6 * s);
    }
    printf("| all | %.1f |\n\n", 1e6 * whole);
}

static void print_errors(raster *r)
{
    double sum = 0.0, worst = 0.0, largest = 0.0;
    for (int i = 0; i < PLACES; ++i) {
        char file[40];
        image truth = {0};
        snprintf(file, sizeof file, "pos%d_irradiance8.pfm", i + 1);
        if (truth_picture(&truth, "env_relight", file)) {
            light_at(r, relight_places[i]);
            const relight_error e = relight_compare(r->stage->cube, truth.pixels, TEXELS);
            sum += e.rmse;
            worst = e.rmse > worst ? e.rmse : worst;
            largest = e.largest > largest ? e.largest : largest;
        }
        image_free(&truth);
    }
    printf("A rendered cube, one ray a pixel: rmse %.2f %% (mean of five places), %.2f (worst), largest %.1f\n\n",
           20.0 * sum, 100.0 * worst, 100.0 * largest);
    CHECK_MSG(worst <= 0.015, "rendered: %.4f", worst);
}

void relight_tell_raster(relight_stage *s)
{
    static raster r;
    memset(&r, 0, sizeof r);
    r.stage = s;
    if (truth_picture(&r.ground, "env_relight", "ground.pfm") &&
        truth_picture(&r.sphere, "env_relight", "far_sphere.pfm")) {
        set_scene(&r);
        set_views(&r);
        set_areas(&r);
        set_lights(&r);
        print_errors(&r);
        print_times(&r);
    }
    image_free(&r.ground);
    image_free(&r.sphere);
}
