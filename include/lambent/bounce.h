/* bounce.h: light received at a point from lit points, grouped in fixed-size arrays. [V: patent JP5873672B2]
 *
 * The shadow map gives first points (lmb_points_collect), neighbours join into discs (lmb_discs_join), discs into
 * groups (lmb_group_points), and groups light the pixels of a tile (lmb_gather_tile).
 *
 * Stability: experimental. Tags like [V16] are requirements in src/SOURCES.md. */
#ifndef LMB_BOUNCE_H
#define LMB_BOUNCE_H

#include "light.h"
#include "occlusion.h"

/* A pixel closer to a disc than this many half-diagonals of its quad gets the quad's exact form factor. */
#define LMB_NEAR 2.8f

/* A first point, and a disc once neighbours have joined it. 88 bytes.
 *
 * The shape is a parameter of the area [V16]: from afar a square, a rectangle, an oval or a disc of 4 |u x v| give the
 * same light to second order, so only the area is used; near by, the quad's corners count. You may store any shape as
 * the quad of equal area and extent: an oval of half axes a and b by |u| = sqrt(pi)/2 a, |v| = sqrt(pi)/2 b. */
typedef struct lmb_point {
    lmb_vec3 position, normal; /* m; unit, on the lit side                                             [V5 V6] */
    float flux[3];             /* outgoing Lambertian power: reflectance x power received, W           [V28] */
    float albedo[3];           /* members' mean reflectance, weighted by power received [V12] */
    lmb_vec3 axis_u, axis_v;   /* half sides of the quad on the surface; area = 4 |u x v| [V16] */
    float distance;            /* mean distance to the neighbours, m; set by lmb_discs_join [V8] */
    uint16_t cell_x, cell_y;   /* column and row in the map of its face, in blocks of texels [V15] */
    uint32_t face;             /* numbers the faces of all lights: equal numbers share one map */
    uint32_t link;             /* scratch of lmb_group_points */
} lmb_point;

/* Your points. `cells` finds the neighbours: cell c of the current face begins at data[cells[c]]. */
typedef struct lmb_points {
    lmb_point *data;
    uint32_t cap, count;
    uint32_t *cells;
    uint32_t cell_cap; /* >= (map size / block)^2 + 1 */
    uint32_t faces;    /* collected so far */
    uint32_t *owner;   /* NULL, or for each texel of each face, in order, rows from the top: the index in `data` of the
                          point with the texel's light, updated by joining and grouping; LMB_NOBODY if there is none
                          [V33] */
    uint32_t owner_cap, owner_count; /* texels */
} lmb_points;
#define LMB_NOBODY 0xffffffffu

/* Static storage for n points from maps of `side` x `side` blocks: LMB_POINTS_ARRAY(points, 400, 16); */
#define LMB_POINTS_ARRAY(name, n, side) \
    static lmb_point name##_data[n]; \
    static uint32_t name##_cells[(side) * (side) + 1]; \
    static lmb_points name = {name##_data, (n), 0, name##_cells, (side) * (side) + 1, 0, NULL, 0, 0}

/* How first points become groups. Zeros select the defaults. */
typedef struct lmb_grouping {
    int32_t method;         /* LMB_GROUP_*; default LMB_GROUP_ZONES */
    int32_t block;          /* texels a side of a first point's surface element: 1 2 4 8; default 8 [V4] */
    int32_t groups;         /* maximum number of groups, <= LMB_MAX_GROUPS; default 512 [V21] */
    float neighbour_m;      /* m: a point's neighbours lie within this distance; default no limit [V9] */
    float join;             /* points closer than this x mean distance join a disc, 0 < k <= 1; default 0.5 [V11] */
    float reach;            /* a disc joins a group within this x the first disc's radius; default 3 [V17] */
    float cosine;           /* a disc joins if the normals' cosine is at least this; -1: any; default 0.9 [V17] */
    uint32_t flags;         /* LMB_ZONES_STRICT | LMB_POINT_CENTRE | LMB_NEAR_HEMISPHERE */
    int32_t thin;           /* one point in so many becomes a disc, <= LMB_MAX_THIN; the others join it; default 1
                               [V14] */
    int32_t neighbour_cells; /* neighbours lie within this many blocks of the map, across and down; default 1, or
                                no limit if neighbour_m is set [V8] */
    float radius;           /* a disc's radius is this x the mean distance; default: the area is the sum of its points'
                               [V12] */
    int32_t zones;          /* zones that the discs' map is first divided into; default `groups` [V20] */
} lmb_grouping;
enum { LMB_GROUP_ZONES = 0, LMB_GROUP_GREEDY = 1, LMB_GROUP_NONE = 2,
       LMB_GROUP_CUT = 3 /* lmb_render: a separate cut of the light tree for each tile, see tree.h */ };
enum { LMB_ZONES_STRICT = 1, /* discs that do not fit their zone's group are dropped; lmb_stats.flux_grouped lacks their
                                flux [V20] */
       LMB_POINT_CENTRE = 2, /* a group's position is its first disc instead of the barycentre [V22] */
       LMB_NEAR_HEMISPHERE = 4 /* a point's neighbours are those above its surface, on any surface, not those that face
                                  its way [V10] */ };
#define LMB_MAX_THIN 64

/* Groups of discs, as planes for the gather. Member discs of group k: points->data[first[k] .. first[k] +
 * members[k]). */
typedef struct lmb_groups {
    int32_t count;
    float position[3][LMB_MAX_GROUPS], normal[3][LMB_MAX_GROUPS]; /*                                   [V13 V18 V19] */
    float flux[3][LMB_MAX_GROUPS];                                /* W */
    float albedo[3][LMB_MAX_GROUPS];                              /* mean, weighted by area             [V19] */
    float area[LMB_MAX_GROUPS];                                   /* m2, sum of the members' */
    float radius[LMB_MAX_GROUPS];                                 /* encloses all members, m           [V19] */
    uint32_t first[LMB_MAX_GROUPS], members[LMB_MAX_GROUPS];
} lmb_groups;

/* Scratch of lmb_gather_tile. */
typedef struct lmb_gather_scratch {
    uint64_t near_pixels[LMB_MAX_GROUPS]; /* per near group: the pixels that are near it, a bit each */
    float pairs[3][LMB_GATHER_PAIRS];     /* of one block of groups with the pixels that are computed together */
} lmb_gather_scratch;

#ifdef __cplusplus
extern "C" {
#endif

/* lmb_points_bytes: memory for n points and the cells of a map of side x side blocks; 0 if that is impossible. */
size_t lmb_points_bytes(uint32_t n, uint32_t side);
/* lmb_points_init: lay out the points in `memory`. Returns LMB_OK, LMB_ERR_ARG, LMB_ERR_ALIGN or LMB_ERR_CAPACITY. */
lmb_status lmb_points_init(lmb_points *out, uint32_t n, uint32_t side, void *memory, size_t bytes);

/* lmb_points_collect: append the first points of the map's tile rows tile_y0 .. tile_y1 - 1 of one face.
 *                                                                                                   [V1 V2 V4 V5 V6 V7]
 * No texel's flux is lost: the texels of a block that share a surface (normals within 25 degrees, planes within a
 * texel) make one first point, at most four a block; a texel that fits none joins the most similar one.
 * Begin a face at tile_y0 = 0 and go on in order. Returns LMB_OK, LMB_ERR_ARG, or LMB_ERR_CAPACITY when data, cells or
 * owners are full: the points so far are valid, the rest of the face is missing. */
lmb_status lmb_points_collect(lmb_points *points, const lmb_kernels *kernels, lmb_tile *scratch,
                              const lmb_scene *scene, const lmb_light *light, const lmb_shadow_map *map, int32_t face,
                              int32_t tile_y0, int32_t tile_y1, const lmb_grouping *grouping);

/* lmb_discs_join: for the face collected last, find the mean distance of each point's neighbours, thin the points if
 * grouping->thin is over 1, and join close ones. In place; order is kept. Flux and area are sums, so both are
 * conserved, also by `thin`. With `radius`, area is no longer a sum.
 * Neighbours are points of the same face of a shadow map that face the same way (or LMB_NEAR_HEMISPHERE), within
 * grouping->neighbour_m in space, else within neighbour_cells of the map; if both are set, within both. A disc joins
 * points within grouping->join x its mean distance, up to 32 cells away. With `thin`, one cell of the map in `thin` has
 * a disc, on the lattice with cells as far apart as possible. A point with no disc of its surface in reach becomes one.
 * Returns LMB_OK or LMB_ERR_ARG. Cost: points x cells that the radius spans; over 65 x 65 of these, only every second,
 * third .. each way is read.                                                             [V8 V9 V10 V11 V12 V14 V15] */
lmb_status lmb_discs_join(lmb_points *points, const lmb_shadow_map *map, const lmb_grouping *grouping);

/* lmb_group_points: groups of all discs by grouping->method; reorders the discs so that members lie together.
 *
 * If more than grouping->groups (or LMB_MAX_GROUPS) would be needed, reach or zone size doubles and grouping starts
 * again: every disc ends in a group, except those that strict zones drop (stats->flux_grouped). LMB_GROUP_NONE: one
 * group a disc, if they fit, else LMB_ERR_CAPACITY.
 * Cost: greedy discs x groups x rounds; zones discs x groups a zone. Returns LMB_OK, LMB_ERR_ARG or
 * LMB_ERR_CAPACITY. */
lmb_status lmb_group_points(lmb_groups *out, lmb_points *points, const lmb_grouping *grouping, lmb_stats *stats);

/* lmb_gather_tile: add the groups' irradiance to a tile's pixels.                                         [V25 V27 V28]
 *
 *   inout     added to. Pixels without a surface are unchanged.
 *   scratch   yours; contents before and after are undefined.
 *   points    the discs of the groups, for near pairs; NULL: groups only.
 *   occluder  occlusion on the way, or NULL: none.
 *
 * Far pair, with c = cosP cosG, g = nP.nG, s = A / (pi r^2), t = c (3 cos^2 G - 1) + g cos^2 G:
 *   E = M / (pi r^2) * min(t >= 0 ? c^2 / (c + t s) : c - t s, cosG / s)
 * the disc's form factor to second order in its size; exact on the axis of a facing disc, never over M / A.
 * Near pair: each disc by the same formula, or the quad by Lambert's polygon formula clipped to the horizon.
 * Doubling every flux exactly doubles the added light. Returns LMB_OK or LMB_ERR_ARG.
 * Stack: 1.25 KiB in the tiny configuration, under 4 KiB elsewhere. */
lmb_status lmb_gather_tile(lmb_irradiance *inout, const lmb_kernels *kernels, lmb_gather_scratch *scratch,
                           const lmb_tile *tile, const lmb_groups *groups, const lmb_points *points,
                           const lmb_occluder *occluder);

/* lmb_disc_factor: the far formula for one pair, per unit flux (1/m2); 0 if either faces away.
 * lmb_quad_factor: the near formula: the exact form factor of a quad, corners centre +- u +- v, over the area. `face`
 * is the normal of the receiver's horizon, `normal` the shading normal (the same on flat surfaces); `axis` is the side
 * that emits light. 0 from behind, and 0 in the quad's plane if the receiver is parallel to the quad. A receiver closer
 * to the plane than a thousandth of the quad's size and bent by over 26 degrees, as on the edge of a room, gets the
 * light of a point a thousandth of that size above the plane.
 * lmb_triangle_factor: the same for a triangle.
 * lmb_polygon_factor: the form factor itself, per unit of exitance, of a convex polygon of 3 .. 8 corners,
 * counter-clockwise on the side that emits light; fewer or more: 0.
 * lmb_triangle_vector: the form factor of a triangle along each axis, signed, corners counter-clockwise around the unit
 * vector `axis`. The dot product with any direction is the form factor along it, so one call serves light that is kept
 * by direction. (0, 0, 0) from behind. Missing, like the two above, in builds without trees. */
float lmb_disc_factor(lmb_vec3 at, lmb_vec3 normal, lmb_vec3 centre, lmb_vec3 axis, float area);
float lmb_quad_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, lmb_vec3 centre, lmb_vec3 axis, lmb_vec3 u,
                      lmb_vec3 v);
float lmb_triangle_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, const lmb_vec3 corner[3], lmb_vec3 axis);
float lmb_polygon_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, const lmb_vec3 *corner, int corners,
                         lmb_vec3 axis);
lmb_vec3 lmb_triangle_vector(lmb_vec3 at, lmb_vec3 face, const lmb_vec3 corner[3], lmb_vec3 axis);

#ifdef __cplusplus
}
#endif
#endif
