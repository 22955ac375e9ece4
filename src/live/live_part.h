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

/* Adds refined nodes to the cut for the near leaves in scratch->leaf. Returns 1 if it added any. */
int lmb_live_come_near(lmb_live_scratch *scratch, const lmb_kernels *kernels, const lmb_live *live);

enum { LIVE_SKY_PACKETS = 8 }; /* max packets of segments towards a sky */

/* Adds the light of a sky, and sets scratch->sky_whole and sky_seen. at: the receiver as it is lit. */
void lmb_live_add_sky(float light[3], const lmb_kernels *kernels, lmb_live_scratch *scratch, const lmb_live_sky *sky,
                      const lmb_bvh *bvh, const struct lmb_live_job *job, const lmb_live_receiver *at);

/* A triangle in a map, with a unit normal on the lit side, and the vectors that give barycentrics. */
typedef struct live_plane {
    uint32_t id;
    lmb_vec3 corner, normal, side[2], along[2];
} live_plane;

enum { LIVE_PLANES = 8 };

/* Returns the plane of an id, from the cache `known`; zero the cache before you use it. NULL if the id names no
 * triangle with an area. */
const live_plane *lmb_live_plane(live_plane known[LIVE_PLANES], const lmb_scene *scene, const lmb_view *view,
                                 uint32_t id);

/* Sets the point of a plane at (sx, sy) of a view, moved onto the triangle if it lies outside. Rasterizers snap
 * corners, so a texel's middle may lie beside the triangle that the texel shows, and behind another one. Returns 0 if
 * there is no such point. */
int lmb_live_place(lmb_vec3 *out, const live_plane *plane, const lmb_view *view, float sx, float sy);

/* Blocks along a face's side. */
static inline int32_t live_blocks(const lmb_live_face *f) { return (f->size + f->each - 1) / f->each; }

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
