/* golden_voxel.c: cases of voxels: surfaces, light, and cones. [M6-M8 M13 M20 M21]
 *
 * The smallest pool takes 0.7 MB, more than the small configuration has. */
#include "golden_cases.h"

#include <string.h>

#if LMB_VOXELS && !defined(LMB_CONFIG_TINY)

enum { VOXELS = 5600, MAP = 32, TRIANGLES = 40 };

static float voxel_memory[VOXELS * (1 + LMB_VOXEL_COVER + LMB_VOXEL_LIGHT)] GOLDEN_ALIGNED;

typedef struct voxel_space {
    uint32_t map[MAP * MAP * 2];
    lmb_texel texel[MAP * MAP];
    lmb_target shown;
    lmb_node node[(MAP * MAP - 1) / 3];
    lmb_view view;
} voxel_space;
GOLDEN_FITS(voxel_space, first);

typedef struct cone_space {
    lmb_cones cones;
    lmb_cone_scratch scratch;
    lmb_tile tile;
    lmb_irradiance light;
    lmb_cone_seen seen;
    float open[LMB_TILE_PIXELS];
} cone_space;
GOLDEN_FITS(cone_space, second);

static uint64_t hash_voxels(uint64_t h, const lmb_voxels *v)
{
    h = golden_hash_u32(golden_hash_u32(h, v->count), (uint32_t)v->depth);
    h = golden_hash_floats(h, v->child, v->count);
    h = golden_hash_floats(h, v->cover[0], (size_t)v->count * LMB_VOXEL_COVER);
    return golden_hash_floats(h, v->light[0], (size_t)v->count * LMB_VOXEL_LIGHT);
}

static lmb_scene *lit_soup(void)
{
    static lmb_light light;
    lmb_scene *soup = golden_soup(33u, 2.0f);
    memset(&light, 0, sizeof light);
    light.kind = LMB_LIGHT_SPOT;
    light.position = (lmb_vec3){1.5f, 2.0f, 3.0f};
    light.direction = (lmb_vec3){-0.48f, -0.6f, -0.64f};
    light.intensity[0] = 30.0f;
    light.intensity[1] = 20.0f;
    light.intensity[2] = 10.0f;
    light.cos_inner = 0.9f;
    light.cos_outer = 0.8f;
    soup->lights = &light;
    soup->light_count = 1;
    return soup;
}

/* First points of the soup's light. */
static const lmb_texel *first_points(const lmb_scene *soup)
{
    voxel_space *s = golden_first();
    cone_space *c = golden_second();
    lmb_shadow_map map;
    lmb_tree tree;
    memset(&tree, 0, sizeof tree);
    lmb_shadow_map_init(&map, soup->lights, soup, MAP, LMB_ID16, s->map, sizeof s->map);
    lmb_shadow_map_clear(&map);
    lmb_shadow_map_draw(&map, golden_kernels, soup, 1, TRIANGLES, NULL);
    lmb_tree_init(&tree, 1, MAP, s->texel, sizeof *s - offsetof(voxel_space, texel));
    lmb_tree_texels(&tree, golden_kernels, &c->tile, soup, soup->lights, &map, 0, 0, 0, MAP / LMB_TILE);
    return tree.texel;
}

/* Cones from the middle tiles of a view. */
static uint64_t hash_cones(uint64_t h, const lmb_voxels *v, const lmb_scene *soup)
{
    cone_space *s = golden_second();
    const lmb_cone_trace trace = {golden_kernels, v, 0, 0, NULL, &s->scratch, 0};
    const lmb_view view = golden_soup_view(0);
    const lmb_target eye = golden_eye(LMB_DEPTH32F, LMB_ID16);
    lmb_draw(&eye, golden_kernels, &view, soup, 1, TRIANGLES, 0, NULL);
    h = golden_hash_u32(h, (uint32_t)lmb_cones_init(&s->cones, v, 7));
    for (int32_t x = 24; x < 56; x += LMB_TILE) {
        memset(&s->light, 0, sizeof s->light);
        lmb_resolve_tile(&s->tile, golden_kernels, &view, soup, &eye, x, 24);
        lmb_cones_diffuse(&s->light, s->open, &trace, &s->cones, &s->tile);
        lmb_cones_glossy(&s->seen, &trace, &s->cones.width[0], &s->tile, view.eye);
        h = golden_hash_floats(golden_hash_floats(h, s->light.rgb[0], 3 * LMB_TILE_PIXELS), s->open, LMB_TILE_PIXELS);
        h = golden_hash_floats(golden_hash_floats(h, s->seen.rgb[0], 3 * LMB_TILE_PIXELS), s->seen.open,
                               LMB_TILE_PIXELS);
    }
    return h;
}

/* Variant: requested depth, plus 16 h; h: half of the cube's side. If h is small, the pool holds fewer levels. */
uint64_t case_voxels(int variant)
{
    const float half = (float)(variant / 16);
    const lmb_vec3 low = {-half, -half, -half}, high = {half, half, half};
    const lmb_scene *soup = lit_soup();
    const lmb_voxel_part part = {soup, 1, TRIANGLES, {1, 0}};
    lmb_voxels v;
    const lmb_texel *texels = first_points(soup);
    lmb_voxels_init(&v, VOXELS, LMB_VOXELS_ONE, voxel_memory, sizeof voxel_memory);
    lmb_voxels_build(&v, &low, &high, variant & 15, &part, 1);
    lmb_voxels_inject(&v, 0, texels, (size_t)MAP * MAP);
    lmb_voxels_filter(&v, 0);
    return hash_cones(hash_voxels(GOLDEN_START, &v), &v, soup);
}

#endif
