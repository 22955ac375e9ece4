/* bake_sight.c: tests whether geometry covers a triangle: corners must see the middle, just above the plane. */
#include "bake.h"

#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "bake_triangle.h"

#define FIRST 16384 /* visibility tests that a job starts with; each call adds more */
#define PULL 0.1f  /* of the smallest edge: receivers lie this far inside a triangle, away from geometry at the edges */
#define OVER 0.25f /* of the distance: height over a mesh that clears bulges between points that face alike */
#define UP   0.05f /* of the smallest edge: height at which the corners must see the middle */

int bake_sight_begin(bake_sight *s, report *r)
{
    memset(s, 0, sizeof *s);
    s->tile = calloc(1, sizeof *s->tile);
    if (s->tile == NULL) {
        return report_fail(r, "not enough memory for a tile");
    }
    s->traversal.bounded = 1;
    s->traversal.left = LMB_TRAVERSAL_FIRST;
    s->tile->hits = 1;
    s->tile->id[0] = 1;
    s->tile->depth[0] = 1.0f;
    return 1;
}

void bake_bound(lmb_traversal *traversal)
{
    const uint32_t coarse = traversal->coarse;
    memset(traversal, 0, sizeof *traversal);
    traversal->bounded = 1;
    traversal->left = FIRST;
    traversal->coarse = coarse;
}

void bake_count_coarse(const bake *b, uint32_t calls)
{
    if (b->coarse != NULL) {
        *b->coarse += calls;
    }
}

void bake_sight_end(bake_sight *s, const bake *b)
{
    bake_count_coarse(b, s->traversal.coarse);
    free(s->tile);
}

lmb_vec3 bake_pulled(const bake *b, lmb_vec3 at, lmb_vec3 to)
{
    const lmb_vec3 d = sub3(to, at);
    const float length = length3(d), step = minf(PULL * b->set.smallest_m, 0.25f * length);
    return length > 0.0f ? add3(at, mul3(d, step / length)) : at;
}

int bake_sees(bake_sight *s, const bake *b, lmb_vec3 from, lmb_vec3 to, lmb_vec3 normal)
{
    const lmb_vec3 up = mul3(normal, UP * b->set.smallest_m), over = add3(from, up), end = add3(to, up);
    s->tile->position[0][0] = over.x;
    s->tile->position[1][0] = over.y;
    s->tile->position[2][0] = over.z;
    const float noise = lmb_place_noise(over, 0.0f) + lmb_place_noise(end, 0.0f);
    return lmb_occluded_tile(b->kernels, &s->traversal, &b->bvh, s->tile, 1, end, noise) == 0;
}

int bake_sees_over(bake_sight *s, const bake *b, lmb_vec3 from, lmb_vec3 from_normal, lmb_vec3 to, lmb_vec3 to_normal)
{
    const lmb_vec3 d = sub3(to, from);
    const float up = OVER * length3(d);
    return dot3(d, d) < 1e-12f || bake_sees(s, b, add3(from, mul3(from_normal, up)), add3(to, mul3(to_normal, up)),
                                            normalize3(add3(from_normal, to_normal)));
}

int bake_stands_free(bake_sight *s, const bake *b, const lmb_vec3 corner[3], lmb_vec3 normal)
{
    const lmb_vec3 middle = triangle_middle(corner);
    return bake_sees(s, b, middle, bake_pulled(b, corner[0], middle), normal) &&
           bake_sees(s, b, middle, bake_pulled(b, corner[1], middle), normal) &&
           bake_sees(s, b, middle, bake_pulled(b, corner[2], middle), normal);
}

void bake_nearest_put(bake_nearest *n, lmb_vec3 at, float far2)
{
    n->count += n->count < n->limit;
    int k = n->count - 1;
    for (; k > 0 && n->far2[k - 1] > far2; --k) {
        n->far2[k] = n->far2[k - 1];
        n->at[k] = n->at[k - 1];
    }
    n->far2[k] = far2;
    n->at[k] = at;
}
