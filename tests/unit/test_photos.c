/* test_photos.c: posed photos with depth as views of a relief: refused photos, and blocks around their points. [P11] */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/vec.h"
#include "../../tools/relief/relief_photos.h"
#include "../../tools/relief/relief_withheld.h"
#include "../test.h"

void test_photos(void);

enum { SIDE = 16, PIXELS = SIDE * SIDE };

static float depth[PIXELS], light[3 * PIXELS];

/* A wall two metres ahead. */
static mix_frame wall(void)
{
    static const double upright[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    mix_frame f;
    memset(&f, 0, sizeof f);
    for (int k = 0; k < PIXELS; ++k) {
        depth[k] = 2.0f;
        light[3 * k] = light[3 * k + 1] = light[3 * k + 2] = 0.5f;
    }
    f.depth = depth;
    f.light.width = f.light.height = SIDE;
    f.light.channels = 3;
    f.light.pixels = light;
    f.camera.width = f.camera.height = SIDE;
    f.camera.fx = f.camera.fy = 16.0f;
    f.camera.cx = f.camera.cy = 7.5f;
    f.has_pose = 1;
    memcpy(f.pose, upright, sizeof upright);
    return f;
}

static int is_taken(const mix_frame *f)
{
    relief_photo p;
    report r = {""};
    const int taken = relief_photo_of(&p, f, &r);
    CHECK_MSG(taken || r.text[0] != '\0', "refused without a word");
    if (taken) {
        relief_photo_free(&p);
    }
    return taken;
}

/* Sets each number of a pose to an extreme value. The second column follows from the first and the third. */
static void test_poses(void)
{
    static const double wild[] = {1e300, -1e300, (double)NAN, (double)INFINITY};
    mix_frame f = wall();
    CHECK(is_taken(&f));
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            for (size_t k = 0; k < sizeof wild / sizeof *wild; ++k) {
                f = wall();
                f.pose[4 * row + column] = wild[k];
                CHECK_MSG(is_taken(&f) == (column == 1), "pose %d, %d: %g", row, column, wild[k]);
            }
        }
    }
    f = wall();
    f.pose[3] = 5e6; /* beyond the limit of positions */
    CHECK(!is_taken(&f));
    f = wall();
    f.pose[2] = 1.0; /* not orthogonal */
    CHECK(!is_taken(&f));
}

static void test_pictures(void)
{
    mix_frame f = wall();
    f.camera.cx = 9.0f;
    CHECK(!is_taken(&f));
    f = wall();
    f.camera.width = 4104;
    f.camera.cx = 2051.5f;
    CHECK(!is_taken(&f));
    f = wall();
    memset(depth, 0, sizeof depth);
    CHECK(!is_taken(&f));
}

/* The wall's points lie inside the blocks, whatever is beside them. */
static void test_blocks(void)
{
    relief_photo p[2];
    triangle_mesh mesh;
    report r = {""};
    mix_frame f = wall();
    CHECK(relief_photo_of(&p[0], &f, &r));
    f.pose[3] = 0.5;
    CHECK(relief_photo_of(&p[1], &f, &r));
    const float size = relief_photo_size(p, 2);
    CHECK_MSG(fabsf(size - 2.375f) < 0.01f, "%g m", (double)size);
    CHECK(relief_blocks(&mesh, p, 2, 0.25f, &r));
    float low = 3e38f, high = -3e38f;
    for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
        low = fminf(low, mesh.positions[3 * v + 2]);
        high = fmaxf(high, mesh.positions[3 * v + 2]);
    }
    CHECK_MSG(low <= -2.0f && high >= -2.0f && high - low < 0.51f, "blocks from %g to %g m", (double)low, (double)high);
    triangle_mesh_free(&mesh);
    relief_photo_free(&p[0]);
    relief_photo_free(&p[1]);
}

/* Colour of the wall at a place, m. */
static float tint(float x, float y) { return 0.5f + 0.2f * sinf(3.0f * x) * cosf(2.0f * y); }

/* A photo of a painted wall from a place beside the origin. */
static mix_frame painted(double beside_m)
{
    mix_frame f = wall();
    f.pose[3] = beside_m;
    for (int k = 0; k < PIXELS; ++k) {
        const float x = (float)beside_m + 2.0f * ((float)(k % SIDE) - 7.5f) / 16.0f,
                    y = 2.0f * ((float)(k / SIDE) - 7.5f) / 16.0f;
        light[3 * k] = light[3 * k + 1] = light[3 * k + 2] = tint(x, y);
    }
    return f;
}

/* Two photos show a third from a place between them; from a place beside them a part is filled or missing. */
static void test_withheld(void)
{
    static const double places[4] = {-0.25, 0.25, 0.0, 1.0};
    relief_photo p[4];
    triangle_mesh mesh;
    relief_bake bake;
    file_bytes file = {NULL, 0};
    lmb_relief relief;
    report r = {""};
    withheld_figures e[2];
    memset(&bake, 0, sizeof bake);
    bake.format = LMB_RELIEF_FULL;
    for (int i = 0; i < 4; ++i) {
        const mix_frame f = painted(places[i]);
        CHECK(relief_photo_of(&p[i], &f, &r));
        CHECK(i > 1 || relief_add_planes(&bake, &p[i].view, p[i].depth, p[i].normal, p[i].colour, 0, &r));
    }
    CHECK(relief_blocks(&mesh, p, 2, 0.25f, &r));
    CHECK(relief_encode(&file, &bake, &mesh, &r) && lmb_relief_open(&relief, file.data, file.size) == LMB_OK);
    for (int i = 0; i < 2; ++i) {
        relief_frame f;
        relief_shot shot = {.kernels = lmb_kernels_pick(), .view = p[2 + i].view, .relief = &relief};
        shot.view.near_m *= 0.1f;
        CHECK(relief_shoot(&f, &shot, &r));
        withheld_measure(&e[i], &f, &p[2 + i]);
        relief_frame_free(&f);
        relief_photo_free(&p[2 + i]);
        relief_photo_free(&p[i]);
    }
    CHECK_MSG(e[0].db > 35.0 && e[0].shown > 0.95 && e[0].filled < 0.05, "between: %g dB, %g shown, %g filled", e[0].db,
              e[0].shown, e[0].filled);
    CHECK_MSG(e[1].db > 15.0 && e[1].shown < 0.9 && e[1].shown > 0.4, "beside: %g dB, %g shown, %g filled", e[1].db,
              e[1].shown, e[1].filled);
    triangle_mesh_free(&mesh);
    relief_bake_free(&bake);
    file_free(&file);
}

void test_photos(void)
{
    test_withheld();
    test_poses();
    test_pictures();
    test_blocks();
}
