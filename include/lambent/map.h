/* map.h: the view of a camera or a light: a view's G-buffer, and the shadow map of a light. [V6 V7 V33]
 *
 * Stability: stable. Tags like [V6] are requirements in src/SOURCES.md. */
#ifndef LMB_MAP_H
#define LMB_MAP_H

#include "raster.h"

/* The shadow map: depth + triangle id per face, nothing else. Flux, normals and positions are resolved from it on
 * demand. Spot lights up to 50 degrees half angle have one face. Wider spots and point lights have six, in GL order (+x
 * -x +y -y +z -z); a spot draws only those that meet the cone. A directional light has one face, or scene->core.faces
 * along the same axes: the finest first, each with all casters of shadows into it. Coarser faces have no first points
 * inside a finer face. */
typedef struct lmb_shadow_map {
    lmb_view view[6];
    lmb_target face[6];
    int32_t faces;  /* 1 .. 6 */
    int32_t size;   /* texels a side */
    uint32_t drawn; /* bit f: face f is part of the map */
} lmb_shadow_map;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_gbuffer_band: write one band of the frame's attributes as pixels of full-frame surfaces.
 *
 *   depth   LMB_R32F, view-space distance in m; normal, albedo: LMB_RGB32F, world face normal turned to the viewer (the
 *           shading normal if the mesh has normals), linear reflectance. Any may be NULL. Size: the frame.
 *   tile    scratch; afterwards the band's last tile.
 *   target  holds the rows 8 * band .. 8 * band + 7 with ids.
 * Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_FORMAT. */
lmb_status lmb_gbuffer_band(const lmb_surface *depth, const lmb_surface *normal, const lmb_surface *albedo,
                            const lmb_kernels *kernels, lmb_tile *tile, const lmb_view *view, const lmb_scene *scene,
                            const lmb_target *target, int32_t band);

/* lmb_shadow_map_faces: number of faces of a light's shadow map in a scene: 1 .. 6. */
int32_t lmb_shadow_map_faces(const lmb_light *light, const lmb_scene *scene);

/* lmb_shadow_map_bytes: memory of a map of size x size texels a face; id_format LMB_ID16 or LMB_ID32. 0: bad size. */
size_t lmb_shadow_map_bytes(int32_t faces, int32_t size, int32_t id_format);

/* Static storage for a shadow map of one face: LMB_SHADOW_MAP_ARRAY(memory, 128) with 16-bit ids. */
#define LMB_SHADOW_MAP_ARRAY(name, size) static uint32_t name[(size) * (size) * 6 / 4]

/* lmb_shadow_map_init: place a shadow map into `memory` and fit the views.
 *
 *   size    texels a side: a multiple of 8, 8 .. LMB_MAX_SIDE.
 *   scene   directional maps are fitted to the bounds and core, and every map's near plane is set by the bounds. If
 *           there is no core, and bounds are those of lmb_scene_bounds, a directional map is fitted to the vertices
 *           themselves, along the light's own axes, in one pass. Builds without trees use the bounds.
 * Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN, LMB_ERR_CAPACITY (bytes): then `out` is unchanged. */
lmb_status lmb_shadow_map_init(lmb_shadow_map *out, const lmb_light *light, const lmb_scene *scene, int32_t size,
                               int32_t id_format, void *memory, size_t bytes);

/* lmb_shadow_map_clear: clear every face that is part of the map. Returns LMB_OK or LMB_ERR_ARG.
 * lmb_shadow_map_draw: then, lmb_draw into each of them. Returns LMB_OK, LMB_ERR_ARG or an error of lmb_draw. Cost:
 * that of lmb_draw, for each face. */
lmb_status lmb_shadow_map_clear(const lmb_shadow_map *map);
lmb_status lmb_shadow_map_draw(const lmb_shadow_map *map, const lmb_kernels *kernels, const lmb_scene *scene,
                               uint32_t first_id, uint32_t count, lmb_stats *stats);

/* lmb_shadow_map_rows: clear and draw the tile rows `first` .. `past` - 1 of the map, all triangles. Rows are counted
 * through all faces: row y of face f is f * size / 8 + y. If you draw every row once, in any pieces, the map is that of
 * clear and draw; pieces may be drawn at once, on any threads.
 *
 *   stats  a face's triangles count once: with row 0. May be NULL.
 * Cost: a piece sets up all triangles of the faces that it covers, so few large pieces are best: one a thread.
 * Returns LMB_OK, LMB_ERR_ARG (rows outside: then nothing was drawn), or an error of lmb_draw. */
lmb_status lmb_shadow_map_rows(const lmb_shadow_map *map, const lmb_kernels *kernels, const lmb_scene *scene,
                               int32_t first, int32_t past, lmb_stats *stats);

/* lmb_light_texel_power: power in W per channel that a light of `intensity` sends through texel (x, y) of a face:
 * intensity x exact solid angle of the texel (directional: the area, or 0 inside a finer face), with the spot's
 * fall-off averaged over 2x2 points. The light's range is not applied, because it depends on the distance of the
 * receiver. Relative error of the solid angle under 1e-6 for maps of 16 texels or more. */
void lmb_light_texel_power(float out[3], const lmb_light *light, const lmb_shadow_map *map, int32_t face, int32_t x,
                           int32_t y);

#ifdef __cplusplus
}
#endif
#endif
