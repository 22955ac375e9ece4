/* elements.h: a whole scene's surface as elements that light one another: every bounce after the first, and emissive
 * surfaces.
 *
 * A shadow map holds only surfaces that the light sees. Here each triangle is cut into pieces, and each side of a piece
 * that may be lit is an element: it receives light at the centre and sends light from the exact shape. Elements are
 * summed into a tree like the texels of a map, so the same cuts, with the same exact visibility, light pixels and
 * elements:
 *
 *     lmb_elements_build(&e, &scene, &lights);                           the tree holds emitted light
 *     for (b = 1; b < bounces; ++b) {
 *         lmb_elements_receive(&e, .., b == 1 ? &lights : NULL, ..);    from the maps, then from each other
 *         if (b + 1 == bounces) lmb_elements_rest(&e, .., 64 - bounces)  all further bounces, estimated
 *         lmb_elements_send(&e, b + 1 == bounces);                       the last time: all bounces together
 *     }                                  if materials emit light, one round more, before that of the maps: b = 0
 *     lmb_gather_cut(.., &lights, ..); lmb_gather_cut(.., &e.tree, ..);  a pixel
 *
 * Stability: experimental. Tags like [V3] are requirements in src/SOURCES.md. */
#ifndef LMB_ELEMENTS_H
#define LMB_ELEMENTS_H

#include "live.h"
#include "many_lights.h"
#include "tree.h"

enum { LMB_MAX_BOUNCES = 64 };

/* One side of a piece of a triangle, or of several small triangles that lie together. 100 bytes. */
typedef struct lmb_element {
    lmb_vec3 corner[3];           /* of the piece, m; of several, of the largest */
    float albedo[3], emission[3]; /* means over it; emission: radiance, W/(sr m2) */
    float received[3], fresh[3];  /* irradiance of all bounces so far, and of the last, W/m2 */
    float area;                   /* m2; of several, the sum */
    float reach2;                 /* distance from the centre to the farthest corner, squared, m2; 0: several */
    uint32_t key;                 /* side of space that it faces, then the position of the centre along a Z curve */
    uint32_t id;                  /* the triangle; of several, the largest */
} lmb_element;

/* The elements, in your memory. */
typedef struct lmb_elements {
    lmb_tree tree; /* of one face: the texel of Z order i is element i */
    lmb_element *data;
    uint32_t cap, count;
    float side;  /* m: upper limit of a piece's side, in the scene's core; triangles under half of it may be merged */
    float level; /* W/m2, R + G + B: approximate mean irradiance of the elements */
} lmb_elements;

/* Scratch of lmb_elements_receive; one for each thread. */
typedef struct lmb_element_scratch {
    const lmb_kernels *kernels;
    lmb_cut *cut;
    lmb_tile *tile;
    lmb_irradiance *received, *fresh;
} lmb_element_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_elements_bytes: memory of n elements and their tree; n: a power of 4, 64 .. 2^24. 0 if that is impossible. 175
 * bytes each. */
size_t lmb_elements_bytes(uint32_t n);

/* lmb_elements_init: lay out the elements in `memory`. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or
 * LMB_ERR_CAPACITY. */
lmb_status lmb_elements_init(lmb_elements *out, uint32_t n, void *memory, size_t bytes);

/* lmb_elements_build: build the elements of a checked scene, and the tree of those that emit light.
 *
 *   lights  the tree of the shadow maps, summed: read only for the scene's brightness. NULL: no lights.
 *
 * Triangles are halved at their longest edge until it is at most `side`. Triangles under half of `side` that face the
 * same side of space and lie in the same cell of half of `side` become one element, at the position of the largest. The
 * area side^2 begins at a size that certainly needs more than n elements, and doubles until they fit, which they always
 * do in the end: no area is lost. Outside the scene's core, elements are larger: twice as long at the core's size from
 * it. A single-sided material has no element at the back. Holes of masked materials are left out, measured at four
 * points a piece. Triangles that lmb_draw would drop are left out.
 * Cost: some passes over the triangles, about 1 us each, and a sort. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_elements_build(lmb_elements *inout, const lmb_scene *scene, const lmb_tree *lights);

/* lmb_elements_tiles: the number of tiles of 64 elements, the unit of work. */
int32_t lmb_elements_tiles(const lmb_elements *elements);

/* lmb_elements_receive: sum the light from `lights` (NULL: none) and from the elements' own tree into `fresh`, for the
 * elements of tiles first .. past - 1. Tiles may run in any order, on any threads, each with its own scratch.
 *
 *   cut_params  error and visibility as for pixels, but as shares of an element's own light and `level` together: a
 *               dark element emits little, and need not be accurate.
 * Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_elements_receive(const lmb_elements *elements, const lmb_element_scratch *own_scratch,
                                const lmb_tree *lights, const lmb_cut_params *cut_params, int32_t first, int32_t past);

/* lmb_many_lights_elements: add the direct light of elements' tiles first .. past - 1 to their `fresh`, which is 0
 * after lmb_elements_build, or holds light of emissive surfaces after lmb_elements_receive. Tiles may run in any order,
 * on any threads, each with its own scratches (own_scratch: kernels, tile and fresh are used). Returns LMB_OK or
 * LMB_ERR_ARG.
 * lmb_many_lights_elements_done: call it when you have lit all tiles: adds their light to `level`. lmb_elements_send
 * then sends the first reflection. Returns LMB_OK or LMB_ERR_ARG. [V3] */
lmb_status lmb_many_lights_elements(const lmb_elements *elements, const lmb_element_scratch *own_scratch,
                                    lmb_many_lights_scratch *scratch, const lmb_many_lights_query *query, int32_t first,
                                    int32_t past);
lmb_status lmb_many_lights_elements_done(lmb_elements *inout);

/* lmb_elements_rest: estimate `bounces` further bounces and add them to `fresh`: the last bounce times r + r^2 + ... +
 * r^bounces. r, one a channel and at most 1, is the share of light that the last bounce kept. Call it once, after all
 * tiles have received and before you call lmb_elements_send.
 *
 *   lights  further sources of the last bounce's light besides the elements; or NULL.
 * After some bounces light is distributed as the first eigenvector of the radiosity matrix, and each bounce is the one
 * before times r: then the estimate is exact. It is exact from the start if all walls have the same irradiance and
 * albedo. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_elements_rest(lmb_elements *inout, const lmb_tree *lights, int32_t bounces);

/* With lambent/live.h, elements light each other, and pixels, as single points. Missing with LMB_LIVE 0:
 *
 * lmb_elements_live: copy the elements' flux from lmb_elements_build or lmb_elements_send to the points of
 * live->element; lmb_live_build then puts them into the tree. Returns LMB_OK, LMB_ERR_ARG or LMB_ERR_CAPACITY.
 * lmb_elements_receive_live: like lmb_elements_receive, from all light in the tree. `scratch`: one a thread.
 * lmb_elements_rest_live: like lmb_elements_rest; `live`: the tree that the last bounce received light from; if it
 * holds first points of maps, these sent light too. */
lmb_status lmb_elements_live(lmb_live *inout, const lmb_elements *elements);
lmb_status lmb_elements_receive_live(const lmb_elements *elements, const lmb_kernels *kernels,
                                     lmb_live_scratch *scratch, const lmb_live *live, const lmb_bvh *bvh,
                                     int32_t first, int32_t past);
lmb_status lmb_elements_rest_live(lmb_elements *inout, const lmb_live *live, int32_t bounces);

/* lmb_elements_send: set the tree's flux to albedo x `fresh`; with `last`, to that of all bounces together, plus the
 * flux of emissive surfaces. Returns LMB_OK or LMB_ERR_ARG. */
lmb_status lmb_elements_send(lmb_elements *inout, int32_t last);

#ifdef __cplusplus
}
#endif
#endif
