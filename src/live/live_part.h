/* live_part.h: functions shared by the files of src/live. Layer 5. */
#ifndef LMB_LIVE_PART_H
#define LMB_LIVE_PART_H

#include <lambent/live.h>

#include <string.h>

#include "../base/vec.h"
#include "../direct/footprint.h"
#include "../direct/texel.h"

/* Returns the mask of requested rays in scratch->rays that something blocks. */
uint64_t lmb_live_blocked(const lmb_kernels *kernels, lmb_live_scratch *scratch, const lmb_bvh *bvh,
                          const lmb_live_receiver *receiver, uint64_t asked);

/* Selects the targets of a steady point, of `all` light. lmb_live_put_steady puts the targets from `first` on into
 * scratch->rays, at most a packet. */
void lmb_live_pick_steady(lmb_live_scratch *scratch, const lmb_live *live, float all);
void lmb_live_put_steady(lmb_live_scratch *scratch, int32_t first);

/* Adds refined nodes to the cut for the near leaves in scratch->leaf. Returns 1 if it added any. */
int lmb_live_come_near(lmb_live_scratch *scratch, const lmb_kernels *kernels, const lmb_live *live);

/* Same result as lmb_live_receive, but reuses chunks that earlier calls made. Call lmb_live_forget before the first of
 * these calls, and again if the tree, the scene, a map or the contents of the scratch changed. */
lmb_status lmb_live_receive_again(float light[3], const lmb_kernels *kernels, lmb_live_scratch *scratch,
                                  const lmb_live *live, const lmb_bvh *bvh, const lmb_live_receiver *receiver);
void lmb_live_forget(lmb_live_scratch *scratch);
#if !LMB_LIVE
#define lmb_live_forget(scratch) ((void)sizeof *(scratch))
#endif

enum { LIVE_SKY_PACKETS = 8 }; /* max packets of segments towards a sky */

/* Adds the light of a sky, and sets scratch->sky_whole and sky_seen. at: the receiver as it is lit. */
void lmb_live_add_sky(float light[3], const lmb_kernels *kernels, lmb_live_scratch *scratch, const lmb_live_sky *sky,
                      const lmb_bvh *bvh, const struct lmb_live_job *job, const lmb_live_receiver *at);

/* Returns the facet of an id in a face of the tree, from a cache of `many`; zero the ids before you use it. NULL if the
 * id names no triangle with an area. */
const lmb_live_facet *lmb_live_facet_of(lmb_live_facet *known, uint32_t many, const lmb_scene *scene,
                                        const lmb_view *view, uint32_t face, uint32_t id);

/* Sets the point of a plane at (sx, sy) of a view, moved onto the triangle if it lies outside. Rasterizers snap
 * corners, so a texel's middle may lie beside the triangle that the texel shows, and behind another one. Returns 0 if
 * there is no such point. */
int lmb_live_place(lmb_vec3 *out, const lmb_live_facet *facet, const lmb_view *view, float sx, float sy);

/* A block's sixteen parts, 4 x 4, each of which one texel represents. */
typedef struct lmb_live_block {
    uint32_t id[LMB_LIVE_NODES];
    int32_t x, y, step; /* texel of the first part, and the distance to the next one */
    uint32_t shown;     /* parts that show a surface, a bit each */
    int is_one;         /* 1: all parts have id[0]; the other members may not be set */
} lmb_live_block;

/* 1 if all texels of 8 x 8 blocks show one id, which is set. Returns 0 for maps that are not tiled or have blocks of
 * more than 4 x 4 texels, and for squares that lie partly outside. */
int lmb_live_square_is_one(uint32_t *id, const lmb_live_face *face, int32_t column, int32_t row);

/* lmb_live_block_of: the ids of a block. lmb_live_block_on: mask of the parts that show a facet, or other surfaces in
 * the plane of the facet. `depth`: of the face's map, LMB_DEPTH32F. */
void lmb_live_block_of(lmb_live_block *out, const lmb_live_face *face, int32_t column, int32_t row);
uint32_t lmb_live_block_on(const lmb_live_block *block, const lmb_live_face *face, const lmb_surface *depth,
                           const lmb_live_facet *facet);

/* Blocks along a face's side. */
static inline int32_t live_blocks(const lmb_live_face *f) { return (f->size + f->each - 1) / f->each; }

enum { CACHE_LINE = 64 /* bytes: an alignment of memory */ };
/* Slots for the other surfaces of 8 x 8 blocks; after the last point, a dark one. */
enum { LIVE_SURFACES = LMB_LIVE_SMALL ? 24 : 64 };

/* Tiles of 8 x 8 blocks in a face of `side` x `side` blocks. */
static inline size_t live_tiles(int32_t side)
{
    const size_t tiles = (size_t)((side + LMB_TILE - 1) / LMB_TILE);
    return tiles * tiles;
}

/* Slots of the points of `faces` faces. */
static inline size_t live_slots(uint32_t faces, int32_t side)
{
    return faces * ((size_t)side * (size_t)side + LIVE_SURFACES * live_tiles(side));
}

/* Number of the element that a point represents. */
static inline uint32_t live_element_of(const lmb_live_point *p) { return (uint32_t)p->row << 16 | p->column; }

/* Factor on the squared radius within which a node counts as near: under 1 for elements that emit nothing. */
float lmb_live_softness(const lmb_live *live, const lmb_live_point *p);

/* Squared radius of a single point. */
float lmb_live_reach2(const lmb_live *live, const lmb_live_point *p);

/* Is a point indivisible? */
int lmb_live_is_whole(const lmb_live *live, const lmb_live_point *p);

/* Share of a node's area that counts as A in live_nodes if the node has parts, because these are not all as near as the
 * middle. */
#define LIVE_DISC 0.25f

static inline float live_power(const float flux[3]) { return (flux[0] + flux[1] + flux[2]) * (1.0f / 3.0f); }

/* Clears nodes: no light, and near nothing. */
static inline void live_blank(lmb_live_chunk *c)
{
    memset(c, 0, sizeof *c);
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        c->area[i] = 1.0f;
    }
}

/* What a point sends: flux by power, and power. */
typedef struct live_light {
    float colour[3], power;
} live_light;

static inline live_light live_light_of(const float flux[3])
{
    live_light out;
    out.power = live_power(flux);
    const float per = 1.0f / out.power;
    for (int h = 0; h < 3; ++h) {
        out.colour[h] = flux[h] * per;
    }
    return out;
}

/* Stores a node, except the radius and parts. */
static inline void live_put(lmb_live_chunk *c, int i, lmb_vec3 place, lmb_vec3 normal, const live_light *light,
                            float area, lmb_vec3 to, lmb_vec3 facet, uint32_t id)
{
    lmb_live_target *t = &c->target[i];
    const float at[3][4] = {{place.x, normal.x, to.x, facet.x},
                            {place.y, normal.y, to.y, facet.y},
                            {place.z, normal.z, to.z, facet.z}};
    for (int h = 0; h < 3; ++h) {
        c->place[h][i] = at[h][0];
        c->normal[h][i] = at[h][1];
        t->at[h] = at[h][2];
        t->facet[h] = at[h][3];
        t->colour[h] = c->colour[h][i] = light->colour[h];
    }
    c->power[i] = light->power;
    c->area[i] = area;
    t->id = id;
}

/* Id that a map shows at a texel. */
static inline uint32_t live_id(const lmb_surface *s, int32_t x, int32_t y)
{
    const uint8_t *data = (const uint8_t *)s->data;
    const int32_t bytes = s->format == LMB_ID16 ? 2 : 4;
    const uint8_t *row = s->layout == LMB_TILED
                             ? data + (ptrdiff_t)(y / LMB_TILE) * s->stride_bytes +
                                   (ptrdiff_t)(x / LMB_TILE * LMB_TILE_PIXELS + y % LMB_TILE * LMB_TILE) * bytes
                             : data + (ptrdiff_t)y * s->stride_bytes + (ptrdiff_t)(x / LMB_TILE * LMB_TILE) * bytes;
    return bytes == 2 ? ((const uint16_t *)(const void *)row)[x % LMB_TILE]
                      : ((const uint32_t *)(const void *)row)[x % LMB_TILE];
}

/* A threshold, 0 .. 1: those of numbers beside each other differ by the golden ratio. */
static inline float live_threshold(uint32_t number, uint32_t kind)
{
    return (float)((number * 0x9e3779b9u + kind) >> 8) * (1.0f / 16777216.0f);
}

/* Uniform hash of three numbers. */
static inline uint32_t live_hash(uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t h = a * 0x9e3779b1u ^ b * 0x85ebca77u ^ c * 0xc2b2ae3du;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    return h ^ h >> 15;
}

#endif
