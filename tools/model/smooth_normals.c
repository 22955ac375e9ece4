/* smooth_normals.c: sums the normals of triangles by position and group.
 *
 * Positions are compared by value, not by vertex index, because programs write a vertex once per texture coordinate.
 * Each normal is weighted by the angle of the triangle at the vertex. So the result does not depend on the
 * triangulation of a polygon, and the normals of a cube point along the diagonals. Weighted by area, they would lean to
 * the side with two triangles there. */
#include <math.h>
#include <string.h>

#include "io_obj.h"
#include "smooth_normals.h"

/* Height divided by longest edge; below it the normal of a triangle is mostly rounding error. */
#define LEAST_HEIGHT 1e-4
#define LOW_WEIGHT   1e-6

int smooth_open(smooth_normals *out, model_build *b, uint64_t room, uint64_t key)
{
    uint64_t slots = 16;
    while (slots < 2 * room)
        slots *= 2;
    out->places = (smooth_place *)build_scratch(b, room, sizeof *out->places);
    out->slots = (uint32_t *)build_scratch(b, slots, sizeof *out->slots);
    out->mask = (uint32_t)(slots - 1);
    out->count = 0;
    out->key = key;
    return out->places && out->slots;
}

/* Returns the slot of this position and group, or the free slot for them. -0 counts as 0. */
static uint32_t *slot_of(const smooth_normals *s, smooth_place *wanted, const float place[3], uint32_t group)
{
    uint32_t at;
    int k;
    memset(wanted, 0, sizeof *wanted);
    for (k = 0; k < 3; ++k)
        wanted->place[k] = place[k] + 0.0f;
    wanted->group = group;
    at = (uint32_t)obj_hash(s->key, wanted, offsetof(smooth_place, sum)) & s->mask;
    while (s->slots[at] != 0 && memcmp(&s->places[s->slots[at] - 1], wanted, offsetof(smooth_place, sum)) != 0)
        at = (at + 1) & s->mask;
    return &s->slots[at];
}

static void add_at(smooth_normals *s, const float place[3], uint32_t group, const double normal[3], double weight)
{
    smooth_place wanted, *to;
    uint32_t *slot = slot_of(s, &wanted, place, group);
    const int is_new = *slot == 0;
    int k;
    if (is_new) {
        s->places[s->count] = wanted;
        *slot = ++s->count;
    }
    to = &s->places[*slot - 1];
    for (k = 0; k < 3; ++k) {
        to->sum[k] += weight * normal[k];
        to->first[k] = is_new ? (float)normal[k] : to->first[k];
    }
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

int corner_weights(double normal[3], double weight[3], const float *const corner[3])
{
    double edge[3][3], length[3], area;
    int i, k;
    for (i = 0; i < 3; ++i) {
        for (k = 0; k < 3; ++k)
            edge[i][k] = (double)corner[(i + 1) % 3][k] - (double)corner[i][k];
        length[i] = sqrt(dot(edge[i], edge[i]));
    }
    for (k = 0; k < 3; ++k)
        normal[k] = edge[0][(k + 1) % 3] * edge[1][(k + 2) % 3] - edge[0][(k + 2) % 3] * edge[1][(k + 1) % 3];
    area = sqrt(dot(normal, normal));
    const double longest = fmax(length[0], fmax(length[1], length[2]));
    if (!(area > 0 && area < 1e300)) /* NaN too */
        return 0;
    for (i = 0; i < 3; ++i) {
        const int before = (i + 2) % 3;
        const double cosine = -dot(edge[i], edge[before]) / (length[i] * length[before]);
        weight[i] = (double)lmb_acos((float)cosine) * (area < LEAST_HEIGHT * longest * longest ? LOW_WEIGHT : 1);
        normal[i] /= area;
    }
    return 1;
}

void smooth_add(smooth_normals *s, const float *const corner[3], const uint32_t group[3])
{
    double normal[3], weight[3];
    int i;
    if (!corner_weights(normal, weight, corner))
        return;
    for (i = 0; i < 3; ++i)
        if (group[i] != 0)
            add_at(s, corner[i], group[i], normal, weight[i]);
}

lmb_vec3 smooth_at(const smooth_normals *s, const float place[3], uint32_t group)
{
    smooth_place wanted;
    const uint32_t slot = *slot_of(s, &wanted, place, group);
    const smooth_place *at = slot != 0 ? &s->places[slot - 1] : &wanted;
    const double first[3] = {(double)at->first[0], (double)at->first[1], (double)at->first[2]};
    uint32_t zeros = 0;
    return build_normal(dot(at->sum, at->sum) > 1e-24 ? at->sum : first, &zeros);
}
