/* group_zones.c: the disc map cut into square zones, one group each; misfits open further groups. Layer 5. [V20 V21]
 *
 * The first disc of a zone leads. Another disc joins if its normal agrees with the group's and it lies within the size
 * of the zone from the barycentre; this separates a foreground edge from the wall behind it. Discs that do not fit the
 * zone's first group open a second, and so on. LMB_ZONES_STRICT drops them instead. */
#include "group.h"

#if LMB_BOUNCE

/* 1 if both lie in one row of zones, or, with `across`, in one zone. */
static int is_same_zone(const lmb_point *a, const lmb_point *b, int32_t zone, int across)
{
    return a->face == b->face && a->cell_y / zone == b->cell_y / zone &&
           (!across || a->cell_x / zone == b->cell_x / zone);
}

/* Past the last disc that may share a zone with disc i: faces follow one another, and so do rows of zones. */
static uint32_t zone_row_end(const lmb_points *points, uint32_t i, int32_t zone)
{
    const lmb_point *d = &points->data[i];
    uint32_t end = i;
    while (end < points->count && is_same_zone(&points->data[end], d, zone, 0)) {
        ++end;
    }
    return end;
}

/* The reach of a zone, m: the side in discs times their distance, plus half for the diagonal. */
static float zone_reach(const lmb_point *first, int32_t zone, float reach)
{
    float disc = maxf(first->distance, sqrtf(lmb_disc_area(first)));
    return disc * (float)zone * maxf(reach * 0.5f, 1.0f);
}

/* Makes one group of the free discs in the zone of disc i. */
static void fill_group(lmb_points *points, uint32_t i, uint32_t end, int32_t zone, const lmb_grouping *grouping,
                       uint32_t group)
{
    lmb_group_sum g;
    const float reach_m = zone_reach(&points->data[i], zone, grouping->reach);
    lmb_group_open(&g);
    for (uint32_t j = i; j < end; ++j) {
        lmb_point *d = &points->data[j];
        if (d->link == LMB_UNGROUPED && is_same_zone(d, &points->data[i], zone, 1)) {
            lmb_vec3 away = sub3(d->position, g.centre);
            if (g.count == 0 || (dot3(away, away) <= reach_m * reach_m && lmb_group_agrees(&g, d, grouping->cosine))) {
                d->link = group;
                lmb_group_add(&g, d);
            }
        }
    }
}

/* Strict zones: drops the zone's remaining discs, so that none of them leads again. */
static void drop_rest(lmb_points *points, uint32_t i, uint32_t end, int32_t zone)
{
    for (uint32_t j = i + 1; j < end; ++j) {
        if (points->data[j].link == LMB_UNGROUPED && is_same_zone(&points->data[j], &points->data[i], zone, 1)) {
            points->data[j].link = LMB_UNGROUPED - 1;
        }
    }
}

uint32_t lmb_group_zones(lmb_points *points, const lmb_grouping *grouping, int32_t zone, uint32_t max)
{
    uint32_t groups = 0, end = 0;
    for (uint32_t i = 0; i < points->count; ++i) {
        end = i >= end ? zone_row_end(points, i, zone) : end;
        if (points->data[i].link == LMB_UNGROUPED) {
            if (groups == max) {
                return max + 1;
            }
            fill_group(points, i, end, zone, grouping, groups);
            if (grouping->flags & LMB_ZONES_STRICT) {
                drop_rest(points, i, end, zone);
            }
            ++groups;
        }
    }
    for (uint32_t i = 0; i < points->count; ++i) {
        if (points->data[i].link == LMB_UNGROUPED - 1) {
            points->data[i].link = LMB_UNGROUPED;
        }
    }
    return groups;
}

#endif
