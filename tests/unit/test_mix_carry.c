/* test_mix_carry.c: light reused from the previous frame: only of the same surface, interpolated between its pixels or
 * taken from beside if noise hides them. */
#include <stdlib.h>
#include <string.h>

#include "../../tools/mix/mix_carry.h"
#include "../../tools/mix/mix_frames.h"
#include "../test.h"

void test_mix_carry(void);

enum { WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT };

static const lmb_pinhole camera = {WIDTH, HEIGHT, 20.0f, 20.0f, 11.5f, 7.5f};

/* A wall 1 m ahead in the previous frame, lit with the number of the column; and a tile of it in the current frame. */
typedef struct pair {
    mix_job now, last;
    mix_kept kept;
    float inverse[PIXELS];
    lmb_vec3 normal[PIXELS];
    mix_carried was[PIXELS], is[PIXELS];
    lmb_tile tile;
    lmb_irradiance without, with;
    mix_direct direct;
} pair;

static void set_axes(mix_job *j)
{
    j->frame.camera = camera;
    j->axes.right = (lmb_vec3){1, 0, 0};
    j->axes.up = (lmb_vec3){0, 1, 0};
    j->axes.back = (lmb_vec3){0, 0, 1};
}

/* The tile at (8, 0), with pixels that see the points `right` px to the right in the previous frame. */
static void begin(pair *p, float right)
{
    memset(p, 0, sizeof *p);
    set_axes(&p->now);
    set_axes(&p->last);
    p->now.kept = &p->kept;
    p->now.carried = p->is;
    p->kept.last = &p->last;
    p->kept.frames = 1;
    p->last.cloud.camera = camera;
    p->last.cloud.noise = 1e-4f;
    p->last.cloud.inverse = p->inverse;
    p->last.cloud.normal = p->normal;
    p->last.carried = p->was;
    for (int i = 0; i < 4; ++i) {
        p->now.to_last.m[5 * i] = 1.0f;
    }
    for (int i = 0; i < PIXELS; ++i) {
        p->inverse[i] = 1.0f;
        p->normal[i] = (lmb_vec3){0, 0, 1};
        p->was[i].is_known = 1;
        p->was[i].rgb[0][1] = (float)(i % WIDTH);
        p->was[i].rgb[1][2] = 100.0f + (float)(i % WIDTH);
        p->was[i].direct[1] = 10.0f + (float)(i % WIDTH);
    }
    p->tile.x = 8;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float x = (float)(8 + k % LMB_TILE) + right, y = (float)(k / LMB_TILE);
        p->tile.id[k] = 1;
        p->tile.position[0][k] = (x - camera.cx) / camera.fx;
        p->tile.position[1][k] = (camera.cy - y) / camera.fy;
        p->tile.position[2][k] = -1.0f;
        p->tile.normal[2][k] = 1.0f;
    }
}

static uint64_t get(pair *p)
{
    memset(&p->without, 0, sizeof p->without);
    memset(&p->with, 0, sizeof p->with);
    return mix_carry_get(&p->without, &p->with, &p->direct, &p->now, &p->tile);
}

static int is_near(float a, float b) { return a > b - 1e-3f && a < b + 1e-3f; }

static void between_pixels(pair *p)
{
    begin(p, 0.25f);
    CHECK(get(p) == ~(uint64_t)0 && p->direct.known == ~(uint64_t)0);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float x = 8.25f + (float)(k % LMB_TILE);
        CHECK_MSG(is_near(p->without.rgb[1][k], x) && is_near(p->with.rgb[2][k], 100.0f + x) &&
                      is_near(p->direct.light.rgb[1][k], 10.0f + x),
                  "pixel %d: %g", k, (double)p->without.rgb[1][k]);
    }
    for (int i = 0; i < PIXELS; ++i) { /* lights of one of the four were not stored: traced again */
        p->was[i].direct[0] = i % WIDTH == 11 ? -1.0f : 0.0f;
    }
    CHECK(get(p) == ~(uint64_t)0 && p->direct.known == ~(uint64_t)0x0c0c0c0c0c0c0c0cu);
}

enum { FAR, TURNED, UNKNOWN, WAYS };

static void spoil(pair *p, int i, int way)
{
    p->inverse[i] = way == FAR ? 0.5f : p->inverse[i];
    p->normal[i] = way == TURNED ? (lmb_vec3){1, 0, 0} : p->normal[i];
    p->was[i].is_known = way == UNKNOWN ? 0 : 1;
}

/* If one column shows something else, its light is that of the nearest other column; five such columns leave their
 * middle without light. */
static void beside_pixels(pair *p)
{
    for (int way = 0; way < WAYS; ++way) {
        begin(p, 0.0f);
        p->tile.position[0][3] += 0.125f / camera.fx; /* the left ones of the four have most weight */
        for (int i = 11; i < PIXELS; i += WIDTH) {
            spoil(p, i, way);
        }
        CHECK_MSG(get(p) == ~(uint64_t)0, "way %d", way);
        CHECK_MSG(p->without.rgb[1][3] == 12.0f && p->with.rgb[2][3] == 112.0f, "way %d: %g", way, (double)p->without.rgb[1][3]);
        CHECK(p->without.rgb[1][2] == 10.0f && p->without.rgb[1][4] == 12.0f);
        begin(p, 0.0f);
        for (int i = 0; i < PIXELS; ++i) {
            if (i % WIDTH >= 9 && i % WIDTH <= 13) {
                spoil(p, i, way);
            }
        }
        CHECK_MSG(get(p) == ~(uint64_t)0x0808080808080808u, "way %d", way);
        CHECK(p->without.rgb[1][2] == 8.0f && p->without.rgb[1][4] == 14.0f);
    }
}

/* Nothing is known beyond the previous picture, behind its camera, of other light or of another world. */
static void out_of_sight(pair *p)
{
    begin(p, 12.0f);
    CHECK(get(p) == 0x3f3f3f3f3f3f3f3fu); /* columns 20 to 23, and two beside them */
    begin(p, 0.0f);
    p->now.to_last.m[14] = 3.0f;
    CHECK(get(p) == 0);
    begin(p, 0.0f);
    p->kept.is_other_light = 1;
    CHECK(get(p) == 0);
    begin(p, 0.0f);
    p->now.world = &p->now; /* rebuilt */
    CHECK(get(p) == 0);
}

void test_mix_carry(void)
{
    pair *p = malloc(sizeof *p);
    if (p == NULL) {
        abort();
    }
    between_pixels(p);
    beside_pixels(p);
    out_of_sight(p);
    free(p);
}
