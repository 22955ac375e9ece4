/* cube_lit.c: an object in the light of a cube map, with the map as background: a corner of a room under a
 * blue sky, over brown ground.
 *
 * The picture of the world is a cube of six faces in floats. For the object's place, the example samples it by
 * direction (lmb_probe_remap), sums the light by normal (reduce, cosine) and stores the sums as a small cube.
 * lmb_relight_band then draws bands of the picture with that cube. If you move the object, compute the cube again. */
#include "room.h"

#include <stdlib.h>

enum { WIDTH = 96, HEIGHT = 64, FACE = 16, MAP = 64, SIDE = LMB_PROBE_SIDE };

static uint32_t depth_memory[WIDTH * HEIGHT], id_memory[WIDTH * HEIGHT], picture[WIDTH * HEIGHT];
static float faces[6][FACE * FACE * 3], map[3 * MAP * MAP / 2], irradiance[3 * 6 * SIDE * SIDE];
static lmb_world world;
static lmb_probe_lights lights;
static lmb_relight_scratch scratch;

/* Blue above, brown below; faces in GL order, +x -x +y -y +z -z. */
static void paint_sky(void)
{
    static const float sky[3] = {0.5f, 0.8f, 1.6f}, ground[3] = {0.4f, 0.3f, 0.2f};
    for (int f = 0; f < 6; ++f) {
        for (int i = 0; i < FACE * FACE; ++i) {
            const int above = f == 2 || (f != 3 && i < FACE * FACE / 2);
            memcpy(&faces[f][3 * i], above ? sky : ground, sizeof sky);
        }
    }
}

/* Irradiance by normal at `at`, ready for lookups. The memory blocks live as long as the program. */
static int light_of(lmb_probe_cube *out, lmb_vec3 at, const lmb_kernels *kernels)
{
    lmb_world_pictures p;
    lmb_probe_table table;
    memset(&p, 0, sizeof p);
    for (int f = 0; f < 6; ++f) {
        p.face[f] = faces[f];
    }
    p.face_size = FACE;
    p.radius = 50.0f; /* the world's shape is a sphere, so near parts shift when the place moves */
    const size_t bytes = lmb_world_bytes(&p, LMB_WORLD_F32), table_bytes = lmb_probe_table_bytes(MAP, MAP / 2);
    const size_t cube_bytes = lmb_probe_cube_bytes(SIDE);
    return lmb_world_init(&world, &p, LMB_WORLD_F32, malloc(bytes), bytes) == LMB_OK &&
           lmb_probe_table_init(&table, MAP, MAP / 2, 0.0f, malloc(table_bytes), table_bytes) == LMB_OK &&
           lmb_probe_remap(map, kernels, &world, &table, at, 0) == LMB_OK &&
           lmb_probe_reduce(&lights, kernels, map, &table) == LMB_OK &&
           lmb_probe_cosine(irradiance, SIDE, kernels, &lights, &table) == LMB_OK &&
           lmb_probe_cube_init(out, irradiance, SIDE, malloc(cube_bytes), cube_bytes) == LMB_OK;
}

int main(void)
{
    static const uint16_t probe_of[2] = {0, 0}; /* by instance */
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    lmb_scene scene = room_scene(mesh, material, place, &light);
    lmb_probe probe;
    lmb_relight r;
    lmb_surface out;
    scene.light_count = 0; /* the world is the only light */
    memset(&r, 0, sizeof r), memset(&probe, 0, sizeof probe);
    r.kernels = lmb_kernels_pick(), r.scene = &scene, r.world = &world;
    r.probes = &probe, r.probe_of = probe_of, r.probe_count = 1;
    paint_sky();
    int ok = light_of(&probe.irradiance, room_middle, r.kernels) &&
             lmb_view_look_at(&r.view, room_eye, room_middle, room_up, 1.2f, WIDTH, HEIGHT) == LMB_OK &&
             lmb_surface_init(&r.eye.depth, LMB_DEPTH32F, WIDTH, HEIGHT, depth_memory, sizeof depth_memory) == LMB_OK &&
             lmb_surface_init(&r.eye.id, LMB_ID32, WIDTH, HEIGHT, id_memory, sizeof id_memory) == LMB_OK &&
             lmb_surface_init(&out, LMB_RGBA8, WIDTH, HEIGHT, picture, sizeof picture) == LMB_OK &&
             lmb_draw(&r.eye, r.kernels, &r.view, &scene, 1, 1000, 0, NULL) == LMB_OK;
    for (int band = 0; ok && band < HEIGHT / LMB_TILE; ++band) {
        ok = lmb_relight_band(&r, &scratch, &out, band) == LMB_OK;
    }
    return !ok || ends_with("lit by a cube", lmb_surface_hash(&out), UINT64_C(0xdb464af2c1b0fc3f));
}
