/* golden_relief.c: cases of reliefs: a sphere on a cube, and light on it. [P1-P12] */
#include "golden_cases.h"

#include "../small_relief.h"

#if LMB_RELIEF

enum { SIDE = 20, MAP = 64 };

typedef struct relief_space {
    uint32_t file[SMALL_WORDS(SIDE)], map[MAP * MAP * 6 / 4];
    lmb_relief relief;
    lmb_tile tile;
    lmb_shadow_map shadow_map;
} relief_space;
GOLDEN_FITS(relief_space, first);

static uint64_t hash_tile(uint64_t h, const lmb_tile *t, uint64_t lit)
{
    h = golden_hash_floats(h, t->position[0], 3 * LMB_TILE_PIXELS);
    h = golden_hash_floats(h, t->normal[0], 3 * LMB_TILE_PIXELS);
    h = golden_hash_floats(h, t->albedo[0], 3 * LMB_TILE_PIXELS);
    h = golden_hash_floats(h, t->depth, LMB_TILE_PIXELS);
    return golden_hash_u32(golden_hash_u32(h, (uint32_t)lit), (uint32_t)(lit >> 32));
}

static void draw_map(relief_space *s, const lmb_light *light, const lmb_scene *scene, const lmb_relief_how *how)
{
    lmb_shadow_map_init(&s->shadow_map, light, scene, MAP, LMB_ID16, s->map, sizeof s->map);
    lmb_shadow_map_clear(&s->shadow_map);
    lmb_shadow_map_draw(&s->shadow_map, golden_kernels, scene, 1, 12, NULL);
    lmb_relief_shadow_rows(&s->shadow_map, golden_kernels, &s->tile, &s->relief, how, 0, MAP / LMB_TILE);
}

/* Bit 0: packed; 1: unfiltered texels, nearest to the eye's ray; 2: one view. */
uint64_t case_relief(int variant)
{
    relief_space *s = golden_first();
    const lmb_target eye = golden_eye(LMB_DEPTH32F, LMB_ID16);
    const lmb_light sun = {{0, 0, 0}, {-0.48f, -0.6f, -0.64f}, {3, 3, 3}, 1.0f, 1.0f, LMB_LIGHT_DIRECTIONAL, 0, 0};
    const lmb_relief_how how = {variant & 4 ? 1 : 0, variant >> 1 & 1, variant >> 1 & 1, 0, 0};
    uint64_t h = GOLDEN_START;
    lmb_scene scene;
    lmb_view view;
    lmb_relief_open(&s->relief, s->file,
                    small_relief(s->file, variant & 1 ? LMB_RELIEF_PACKED : LMB_RELIEF_FULL, SIDE));
    lmb_relief_scene(&scene, &s->relief);
    lmb_view_look_at(&view, vec3(2.0f, 1.5f, 2.5f), vec3(0, 0, 0), vec3(0, 1, 0), 0.8f, GOLDEN_WIDTH, GOLDEN_HEIGHT);
    lmb_draw(&eye, golden_kernels, &view, &scene, 1, 12, 0, NULL);
    draw_map(s, &sun, &scene, &how);
    for (int32_t y = 0; y < GOLDEN_HEIGHT; y += LMB_TILE) {
        for (int32_t x = 0; x < GOLDEN_WIDTH; x += LMB_TILE) {
            lmb_resolve_tile(&s->tile, golden_kernels, &view, &scene, &eye, x, y);
            lmb_relief_tile(&s->tile, golden_kernels, &s->relief, &view, &how, NULL);
            h = hash_tile(h, &s->tile, lmb_relief_lit(&s->shadow_map, &sun, &s->tile));
        }
    }
    return h;
}

#endif
