/* group.c: all discs into a fixed-size array of groups, by the chosen method. Layer 5.              [V13 V19 V20 V22]
 *
 * If there are too many groups, the zone or the reach grows and grouping restarts, so the discs always fit. */
#include "group.h"

#include <string.h>

#if LMB_BOUNCE

/* Sorts discs so that the members of a group are contiguous, in order; discs without a group go last. Works in place:
 * links become target indices, then cycles are followed. out->members counts through each group's range. */
static void sort_members(lmb_groups *out, lmb_points *points)
{
    uint32_t total = 0;
    for (int32_t k = 0; k < out->count; ++k) {
        out->first[k] = total;
        total += out->members[k];
        out->members[k] = 0;
    }
    for (uint32_t i = 0; i < points->count; ++i) {
        uint32_t k = points->data[i].link;
        points->data[i].link = k == LMB_UNGROUPED ? total++ : out->first[k] + out->members[k]++;
    }
    for (uint32_t t = 0; points->owner != NULL && t < points->owner_count; ++t) {
        points->owner[t] = points->owner[t] != LMB_NOBODY ? points->data[points->owner[t]].link : LMB_NOBODY;
    }
    for (uint32_t i = 0; i < points->count; ++i) {
        while (points->data[i].link != i) {
            uint32_t to = points->data[i].link;
            lmb_point moved = points->data[to];
            points->data[to] = points->data[i];
            points->data[i] = moved;
        }
    }
}

static void set_vec(float planes[3][LMB_MAX_GROUPS], int32_t k, lmb_vec3 v)
{
    planes[0][k] = v.x;
    planes[1][k] = v.y;
    planes[2][k] = v.z;
}

/* Distance from a point to the farthest corner of the disc. */
static float corner_distance(const lmb_point *d, lmb_vec3 from)
{
    lmb_vec3 sum = add3(d->axis_u, d->axis_v), difference = sub3(d->axis_u, d->axis_v);
    lmb_vec3 away = sub3(d->position, from);
    float far2 = 0.0f;
    for (int i = 0; i < 4; ++i) {
        lmb_vec3 corner = add3(away, mul3(i & 1 ? sum : difference, i & 2 ? 1.0f : -1.0f));
        far2 = maxf(far2, dot3(corner, corner));
    }
    return sqrtf(far2);
}

/* Computes group k from the members. */
static void close_group(lmb_groups *out, int32_t k, const lmb_points *points, uint32_t flags)
{
    lmb_group_sum g;
    float flux[3] = {0, 0, 0}, albedo[3] = {0, 0, 0}, area = 0.0f, radius = 0.0f;
    const lmb_point *members = points->data + out->first[k];
    lmb_group_open(&g);
    for (uint32_t i = 0; i < out->members[k]; ++i) {
        lmb_group_add(&g, &members[i]);
        const float own = lmb_disc_area(&members[i]);
        area += own;
        for (int c = 0; c < 3; ++c) {
            flux[c] += members[i].flux[c];
            albedo[c] += members[i].albedo[c] * own;
        }
    }
    lmb_vec3 centre = flags & LMB_POINT_CENTRE ? members[0].position : g.centre;
    for (uint32_t i = 0; i < out->members[k]; ++i) {
        radius = maxf(radius, corner_distance(&members[i], centre));
    }
    set_vec(out->position, k, centre);
    set_vec(out->normal, k, g.axis);
    out->area[k] = maxf(area, 1e-24f);
    out->radius[k] = maxf(radius, 1e-12f);
    for (int c = 0; c < 3; ++c) {
        out->flux[c][k] = flux[c];
        out->albedo[c][k] = albedo[c] / out->area[k];
    }
}

/* LMB_UNGROUPED discs of strict zones stay outside all member ranges. */
static void close_groups(lmb_groups *out, lmb_points *points, uint32_t count, uint32_t flags)
{
    out->count = (int32_t)count;
    memset(out->members, 0, sizeof out->members);
    for (uint32_t i = 0; i < points->count; ++i) {
        if (points->data[i].link != LMB_UNGROUPED) {
            ++out->members[points->data[i].link];
        }
    }
    sort_members(out, points);
    for (int32_t k = 0; k < out->count; ++k) {
        close_group(out, k, points, flags);
    }
}

static uint32_t group_none(lmb_points *points, uint32_t max)
{
    for (uint32_t i = 0; i < points->count; ++i) {
        points->data[i].link = i;
    }
    return points->count > max ? max + 1 : points->count;
}

static void count_stats(lmb_stats *stats, const lmb_groups *groups, const lmb_points *points)
{
    stats->discs += points->count;
    stats->groups += (uint32_t)groups->count;
    for (uint32_t i = 0; i < points->count; ++i) {
        stats->flux_lit +=
            (double)points->data[i].flux[0] + (double)points->data[i].flux[1] + (double)points->data[i].flux[2];
    }
    for (int32_t k = 0; k < groups->count; ++k) {
        stats->flux_grouped += (double)groups->flux[0][k] + (double)groups->flux[1][k] + (double)groups->flux[2][k];
    }
}

/* Zone size for the first try, so that about `zones` zones, or `groups`, cover the map. Discs that do not fit increase
 * the count. */
static int32_t first_zone(const lmb_points *points, const lmb_grouping *g)
{
    const uint64_t cells = (uint64_t)points->count * (uint64_t)maxi(g->thin, 1);
    const uint64_t wanted = (uint64_t)(g->zones > 0 ? g->zones : g->groups);
    uint64_t zone = 1;
    while (cells >= (wanted + 1) * (zone * zone)) {
        ++zone;
    }
    return (int32_t)zone;
}

/* Widens the limits: first zone and reach; if that is not enough, the normals too. At last, if there are more faces
 * than groups, the greedy method replaces zones, until any disc joins any group. */
static void widen_zones(lmb_grouping *g, float *reach, int32_t *zone, uint32_t tries)
{
    *reach *= 1.5f;
    *zone = *zone < 4096 ? *zone + maxi(*zone / 4, 1) : *zone;
    if (tries > 8) {
        g->cosine = maxf(g->cosine - 0.25f, -1.0f);
        g->reach *= 2.0f;
    }
    if (tries > 24) {
        g->method = LMB_GROUP_GREEDY;
    }
}

lmb_status lmb_group_points(lmb_groups *out, lmb_points *points, const lmb_grouping *grouping, lmb_stats *stats)
{
    lmb_grouping g;
    if (out == NULL || points == NULL || points->data == NULL || grouping == NULL || grouping->groups < 0 ||
        grouping->groups > LMB_MAX_GROUPS || grouping->method < LMB_GROUP_ZONES || grouping->method > LMB_GROUP_NONE ||
        grouping->zones < 0 || (uint32_t)grouping->thin > LMB_MAX_THIN) {
        return LMB_ERR_ARG;
    }
    g = *grouping;
    g.groups = g.groups != 0 ? g.groups : mini(512, LMB_MAX_GROUPS);
    g.reach = g.reach > 0.0f ? g.reach : 3.0f;
    g.cosine = g.cosine != 0.0f ? g.cosine : 0.9f;
    uint32_t max = (uint32_t)(g.method == LMB_GROUP_NONE ? LMB_MAX_GROUPS : g.groups), count = 0;
    int32_t zone = first_zone(points, &g);
    float reach = g.reach;
    for (uint32_t tries = 0;; ++tries) {
        for (uint32_t i = 0; i < points->count; ++i) {
            points->data[i].link = LMB_UNGROUPED;
        }
        count = g.method == LMB_GROUP_NONE     ? group_none(points, max)
                : g.method == LMB_GROUP_GREEDY ? lmb_group_greedy(points, &g, reach, max)
                                               : lmb_group_zones(points, &g, zone, max);
        if (count <= max) {
            break;
        }
        if (g.method == LMB_GROUP_NONE) {
            return LMB_ERR_CAPACITY;
        }
        widen_zones(&g, &reach, &zone, tries);
        if (stats != NULL) {
            ++stats->regroups;
        }
    }
    close_groups(out, points, count, g.flags);
    if (stats != NULL) {
        count_stats(stats, out, points);
    }
    return LMB_OK;
}

#endif
