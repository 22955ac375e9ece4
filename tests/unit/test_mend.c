/* test_mend.c: a pixel against the pixels around it. Requirement P12. */
#include <string.h>

#include "../../src/base/vec.h"
#include "../../src/relief/mend.h"
#include "../test.h"

void test_mend(void);

#if LMB_RELIEF

#define AWAY 10.0f /* m: a wall in front of the eye, 1 m per pixel */

typedef struct wall {
    lmb_tile tile;
    lmb_view view;
    lmb_relief_job job;
    lmb_relief_found found;
} wall;

static void put(float (*planes)[LMB_TILE_PIXELS], int k, lmb_vec3 v)
{
    planes[0][k] = v.x;
    planes[1][k] = v.y;
    planes[2][k] = v.z;
}

static void set_depth(wall *w, int k, float depth)
{
    w->tile.depth[k] = depth;
    put(w->tile.position, k, vec3((float)(k % LMB_TILE) - 3.5f, 3.5f - (float)(k / LMB_TILE), -depth));
}

/* A tile that is the whole picture, viewed along -z. */
static void build(wall *w, lmb_vec3 normal)
{
    memset(w, 0, sizeof *w);
    w->view.right.x = w->view.up.y = w->view.back.z = 1.0f;
    w->view.half_width = w->view.half_height = 4.0f;
    w->view.kind = LMB_ORTHOGRAPHIC;
    w->view.near_m = 1.0f;
    w->view.far_m = 100.0f;
    w->view.frame_width = w->view.frame_height = LMB_TILE;
    w->job.back.z = 1.0f;
    w->job.pixel = 1.0f;
    w->found.hit = ~(uint64_t)0;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        set_depth(w, k, AWAY);
        put(w->tile.normal, k, normal);
        put(w->tile.albedo, k, vec3(0.5f, 0.5f, 0.5f));
        w->tile.id[k] = 1;
    }
}

static void mend(wall *w) { lmb_relief_mend(&w->tile, &w->found, &w->job, &w->view); }

/* Pixels that no view shows, away from those that one does: past an orthographic view of the whole model there is
 * nothing. Photos show only a part, so the simple model stays. */
static void test_beside_views(void)
{
    for (int outside = 0; outside < 2; ++outside) {
        wall w;
        uint64_t kept = 0;
        build(&w, vec3(0.0f, 0.0f, 1.0f));
        w.job.outside = outside;
        w.found.hit = 0x0303030303030303u; /* two columns */
        mend(&w);
        for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
            kept |= (uint64_t)((w.found.missed >> k & 1u) == 0) << k;
        }
        CHECK_MSG((kept >> 31 & 1u) == (uint64_t)!outside && (kept & 0x0303030303030303u) == 0x0303030303030303u,
                  "outside %d: kept %016llx", outside, (unsigned long long)kept);
        CHECK(outside != 0 || w.found.missed == 0);
    }
}

/* Pixels within four pixel sides of depth show one surface. */
static void test_near_by(void)
{
    static const float off[] = {3.5f, 4.5f, -3.5f, -4.5f};
    wall w;
    for (int i = 0; i < 4; ++i) {
        build(&w, vec3(0, 0, 1));
        set_depth(&w, 27, AWAY + off[i]);
        mend(&w);
        const float wanted = absf(off[i]) < 4.0f ? AWAY + off[i] : AWAY;
        CHECK_MSG(absf(w.tile.depth[27] - wanted) < 1e-5f, "%g off: %g", (double)off[i], (double)w.tile.depth[27]);
    }
}

/* A hole in a corner, beside planes nearly along its ray: below a cosine of 0.05 they give no depth. */
static void test_edge_on(void)
{
    static const float cosine[] = {0.04f, 0.06f, -0.06f};
    wall w;
    for (int i = 0; i < 3; ++i) {
        build(&w, vec3(sqrtf(1.0f - cosine[i] * cosine[i]), 0.0f, cosine[i]));
        w.found.hit &= ~(uint64_t)1;
        mend(&w);
        CHECK_MSG((absf(w.tile.depth[0] - AWAY) > 1.0f) == (i == 1), "%g: %g", (double)cosine[i], (double)w.tile.depth[0]);
        CHECK((w.found.hit & 1) != 0);
    }
}

/* A row of holes is mended from both ends, one pixel per pass in three passes. */
static void test_passes(void)
{
    wall w;
    for (int from = 0; from < 2; ++from) {
        const uint64_t row = (from == 1 ? (uint64_t)0x7e : (uint64_t)0xff) << 24;
        build(&w, vec3(0, 0, 1));
        w.found.hit = ~row;
        w.found.missed = row;
        mend(&w);
        CHECK(w.found.missed == (from == 1 ? 0 : (uint64_t)0x18 << 24));
        CHECK(w.found.hit == ~w.found.missed);
    }
}

/* Pixels outside the picture stay as they are. */
static void test_outside(void)
{
    wall w;
    for (int outside = 0; outside < 2; ++outside) {
        build(&w, vec3(0, 0, 1));
        w.view.frame_width = LMB_TILE - outside;
        w.found.hit = ~((uint64_t)1 << 31); /* the last pixel of a row */
        w.tile.id[31] = 0;
        mend(&w);
        CHECK((w.tile.id[31] != 0) == !outside && (w.found.hit >> 31 & 1) == (uint64_t)!outside);
    }
}

void test_mend(void)
{
    test_beside_views();
    test_near_by();
    test_edge_on();
    test_passes();
    test_outside();
}

#else

void test_mend(void) {}

#endif
