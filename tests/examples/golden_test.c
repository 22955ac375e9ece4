/* golden_test.c: lambent as the reference for your renderer: does every pixel have the same bytes?
 *
 * The renderer under test fills rectangles. The reference draws the same ones as triangles. lmb_surface_diff
 * returns the first pixel that differs, in row order, even if the two surfaces have different layouts (yours is in
 * rows, the reference's in tiles). The renderer has a deliberate fault: with `wide` it also fills pixels with their
 * centre past the right edge. */
#include "room.h"

enum { WIDTH = 64, HEIGHT = 48, BOXES = 2 };

/* x0 y0 x1 y1, px; distance, m. */
static const float boxes[BOXES][5] = {{8.25f, 6.5f, 40.5f, 30.75f, 6.0f}, {20.0f, 16.5f, 50.25f, 44.0f, 5.0f}};
static float yours[HEIGHT][WIDTH];
static uint32_t oracle_memory[WIDTH * HEIGHT];
static float corners[BOXES * 2][3][3];

/* Under test: reversed depth of an orthographic view from 4 to 8 m; the nearer box wins. */
static void your_renderer(int wide)
{
    memset(yours, 0, sizeof yours);
    for (int b = 0; b < BOXES; ++b) {
        const float *box = boxes[b], depth = (8.0f - box[4]) / 4.0f;
        for (int y = 0; y < HEIGHT; ++y) {
            for (int x = 0; x < WIDTH; ++x) {
                const float px = (float)x + 0.5f, py = (float)y + 0.5f, right = wide ? box[2] + 1.0f : box[2];
                if (px >= box[0] && px < right && py >= box[1] && py < box[3] && depth > yours[y][x]) {
                    yours[y][x] = depth;
                }
            }
        }
    }
}

/* The same boxes as two triangles each; a pixel is a metre. */
static lmb_status draw_oracle(const lmb_surface *depth)
{
    static const int corner[2][3] = {{0, 3, 2}, {0, 2, 1}};
    const lmb_view view = {{0, 0, 0},  {1, 0, 0}, {0, 1, 0}, {0, 0, 1},        WIDTH / 2, /* eye, right, up, back */
                           HEIGHT / 2, 4,         8,         LMB_ORTHOGRAPHIC, WIDTH,     HEIGHT, 0, 0};
    for (int t = 0; t < BOXES * 2; ++t) {
        const float *b = boxes[t / 2];
        for (int k = 0; k < 3; ++k) {
            const int c = corner[t % 2][k];
            corners[t][k][0] = (c == 1 || c == 2 ? b[2] : b[0]) - WIDTH / 2;
            corners[t][k][1] = HEIGHT / 2 - (c >= 2 ? b[3] : b[1]);
            corners[t][k][2] = -b[4];
        }
    }
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_instance place[2];
    lmb_light light;
    lmb_target target;
    lmb_scene scene = room_scene(mesh, material, place, &light); /* only the mesh differs */
    memset(&mesh[0], 0, sizeof mesh[0]);
    memset(&target, 0, sizeof target);
    target.depth = *depth;
    mesh[0].positions = corners;
    mesh[0].vertex_count = 3 * (mesh[0].triangle_count = BOXES * 2);
    scene.instance_count = 1;
    return lmb_draw(&target, lmb_kernels_pick(), &view, &scene, 1, BOXES * 2, 0, NULL);
}

int main(void)
{
    lmb_surface depth, own = {yours, WIDTH, HEIGHT, WIDTH * 4, LMB_DEPTH32F, LMB_LINEAR, 0};
    int32_t x = -1, y = -1;
    if (lmb_surface_init(&depth, LMB_DEPTH32F, WIDTH, HEIGHT, oracle_memory, sizeof oracle_memory) != LMB_OK ||
        draw_oracle(&depth) != LMB_OK) {
        return 1;
    }
    your_renderer(0);
    const int right = lmb_surface_diff(&x, &y, &own, &depth) == 0;
    your_renderer(1);
    const int found = lmb_surface_diff(&x, &y, &own, &depth) == 1;
    printf("without the fault %s; with it the first other pixel is %d,%d\n", right ? "all is equal" : "not all is",
           (int)x, (int)y);
    return !right || !found || x != 40 || y != 6;
}
