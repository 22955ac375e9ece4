/* facets.h: the parts of a texel in which several surfaces show. Layer 6. */
#ifndef LMB_TREE_FACETS_H
#define LMB_TREE_FACETS_H

#include "../base/vec.h"
#include "../raster/triangle.h"
#include "tree.h"

/* lmb_texel.side[0] of such a texel. side[1]: 127 (c + 1), with the cosine c of the widest angle between the texel's
 * normal and the others; side[2]: the map's pixel that the texel is of, in its tile; share: m, depth of all that shows,
 * of which side[3] / 255 is nearer to the light than the texel's point. */
enum { SIDE_SEVERAL = 0 };

static inline int facets_are_several(const lmb_texel *t) { return LMB_FACETS && t->side[0] == SIDE_SEVERAL; }
static inline float facets_cosine(const lmb_texel *t) { return ((float)t->side[1] - 127.0f) * (1.0f / 127.0f); }

/* Where the surfaces of a texel lie: from `down` below its point to `up` above, m, along the unit vector to the light;
 * wide: half the diagonal of the texel's cell there. */
typedef struct facets_extent {
    lmb_vec3 ray;
    float wide, up, down;
} facets_extent;

static inline facets_extent facets_extent_of(const lmb_texel *t, const lmb_view *v, int32_t size)
{
    facets_extent e;
    const int is_cone = v->kind == LMB_PERSPECTIVE;
    const lmb_vec3 to = is_cone ? sub3(v->eye, t->position) : v->back;
    const float far = length3(to);
    e.ray = mul3(to, 1.0f / maxf(far, 1e-18f));
    e.wide = 1.5f * (is_cone ? far : 1.0f) * v->half_width / (float)size;
    e.up = t->share * (float)t->side[3] * (1.0f / 255.0f);
    e.down = t->share - e.up;
    return e;
}

/* Marks a texel if its block of each x each pixels of the map, from pixel `first` of the tile on, shows several planes.
 * Two planes that meet at a sharp edge are a crease and do not count, unless one is steep and the tree `tests`. own:
 * the texel's pixel; size: of the tree. */
void lmb_facets_mark(lmb_texel *inout, const lmb_tile *t, int own, int first, int32_t each, const lmb_view *v,
                     int32_t size, int32_t tests);

/* One part: a polygon, counter-clockwise around the normal, which is on the lit side. */
typedef struct lmb_facet {
    lmb_vec3 corner[CREASE_CORNERS + 1], normal, middle;
    float area, flux[3]; /* m2; W/m2 */
    float per_area;      /* texels per m2 */
    int corners;
} lmb_facet;

/* A triangle that shows in the texel. */
typedef struct lmb_facet_surface {
    lmb_vec3 normal, on; /* its plane; the normal is on the lit side */
    uint64_t pixels;     /* of the block that show it */
    uint32_t id;
    int is_speck; /* covers less than half of these pixels, and is not steep */
} lmb_facet_surface;

typedef struct lmb_facets {
    const lmb_tree *tree;
    const lmb_scene *scene;
    lmb_node_ref at;
    int32_t each, surfaces, at_surface;
    uint64_t left; /* pixels of the current surface with parts to come */
    uint32_t id[LMB_TILE_PIXELS], own;
    lmb_facet_surface surface[LMB_TILE_PIXELS];
    float more; /* factor on the light of small triangles, for those that no pixel shows */
} lmb_facets;

#if LMB_FACETS
/* Too large for a stack. */
typedef char lmb_facets_fits[sizeof(lmb_facets) <= sizeof(((lmb_cut *)0)->with.facets) ? 1 : -1];
#endif

/* lmb_facets_open: lists what shows in a marked texel. lmb_facets_next: the parts one by one; 0: no more. */
void lmb_facets_open(lmb_facets *out, const lmb_tree *tree, const lmb_scene *scene, lmb_node_ref at);
int lmb_facets_next(lmb_facet *out, lmb_facets *f);

#endif
