/* masks.c: checks how many pixels of a thousand screens test alpha, and that drawing by triangle gives equal bytes.
 *
 * A test because it replaces a kernel; tools/hard/hard_cliff.c has the other scenes that need much work. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../src/lane/kernels.h"
#include "hard_test.h"

enum { QUADS = 1000, PICTURE = 64, MAP = 256, TEXELS = 64, ONE = -1 };

static lmb_kernels counting;
static uint64_t (*see_tile)(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked);
static void (*fill_tile)(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked,
                         uint64_t seen, uint64_t solid);
static double tests, sampled; /* pixels: covered and not hidden; of these, with a test of alpha */

static double bits_of(uint64_t bits)
{
    double count = 0;
    for (; bits != 0; bits &= bits - 1) {
        ++count;
    }
    return count;
}

/* Counts the covered pixels that pass the depth test. */
static uint64_t count_seen(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked)
{
    const uint64_t seen = see_tile(tile, job, masked);
    tests += masked->is_solid ? 0 : bits_of(seen);
    return seen;
}

/* Counts the pixels that test alpha. */
static void count_tile(const lmb_fill_tile *tile, const lmb_fill_job *job, const lmb_masked_job *masked, uint64_t seen,
                       uint64_t solid)
{
    sampled += bits_of(seen & ~solid);
    fill_tile(tile, job, masked, seen, solid);
}

/* Screens 1 mm apart in a closed box, turned about its vertical axis. Squares of `squares` texels are opaque in turns;
 * ONE: a single texel is opaque. */
static int make_screens(hard_stage *s, double turn, int squares)
{
    static uint8_t texels[4 * TEXELS * TEXELS];
    const dvec along = dvec_of(cos(turn), 0, sin(turn)), across = dvec_of(-sin(turn), 0, cos(turn));
    hard_begin(s, 0.5);
    for (int i = 0; i < QUADS; ++i) {
        hard_quad(s, dvec_mul(along, 0.001 * i - 0.5), dvec_of(0, 1, 0), across);
    }
    hard_holes(s, 0, texels, TEXELS);
    for (int i = 0; i < TEXELS * TEXELS; ++i) {
        const int x = i % TEXELS, y = i / TEXELS;
        const int is_solid = squares == ONE ? x == 43 && y == 21 : ((x / squares) ^ (y / squares)) & 1;
        texels[4 * i + 3] = is_solid ? 255 : 0;
    }
    (void)hard_part(s, 0.5);
    hard_box(s, dvec_of(0, 0, 0), dvec_of(2, 2, 2));
    hard_point(s, dvec_of(1.8, 0.3, 0.2), 10.0);
    return hard_end(s);
}

/* The tests of alpha for a picture and its shadow map, per screen and pixel of the picture. Without a kernel pixels are
 * tested one by one: 0. */
static double alpha_tests(hard_stage *s, double turn, int squares)
{
    const lmb_kernels *kernels = s->kernels;
    if (!make_screens(s, turn, squares)) {
        return HUGE_VAL;
    }
    counting = *kernels;
    fill_tile = kernels->fill_masked;
    see_tile = kernels->masked_seen;
    counting.masked_seen = see_tile != NULL ? count_seen : NULL;
    counting.fill_masked = fill_tile != NULL ? count_tile : NULL;
    tests = sampled = 0;
    s->kernels = &counting;
    hard_look(s, dvec_of(1.9, 0.2, 0.1), dvec_of(0, 0.2, 0.1), 70.0, PICTURE);
    const lmb_status status = hard_frame(s, LMB_SHOW_DIRECT, MAP, 0.02f);
    s->kernels = kernels;
    return status == LMB_OK ? tests / (QUADS * PICTURE * PICTURE) : HUGE_VAL;
}

/* 1 if a draw of all screens, of which some are drawn ahead, has the bytes of draws of single triangles. */
static int draws_are_equal(hard_stage *s, int format)
{
    enum { PIXELS = PICTURE * PICTURE };
    static uint32_t depth[2][PIXELS], id[2][PIXELS];
    int same = make_screens(s, 0.5, 3);
    hard_look(s, dvec_of(1.9, 0.2, 0.1), dvec_of(0, 0.2, 0.1), 70.0, PICTURE);
    for (int i = 0; i < 2 && same; ++i) {
        lmb_target target;
        memset(&target, 0, sizeof target);
        memset(depth[i], 0, sizeof depth[i]);
        memset(id[i], 0, sizeof id[i]);
        lmb_surface_init(&target.depth, format, PICTURE, PICTURE, depth[i], sizeof depth[i]);
        lmb_surface_init(&target.id, LMB_ID32, PICTURE, PICTURE, id[i], sizeof id[i]);
        const uint32_t each = i == 0 ? s->count : 1;
        for (uint32_t k = 0; k < s->count && same; k += each) {
            same = lmb_draw(&target, s->kernels, &s->view, &s->scene, 1 + k, each, 0, NULL) == LMB_OK;
        }
    }
    return same && memcmp(depth[0], depth[1], sizeof depth[0]) == 0 && memcmp(id[0], id[1], sizeof id[0]) == 0;
}

void hard_masks(hard_stage *s)
{
    static const struct {
        double turn, bound, share; /* share: of these pixels, those that test alpha */
        int squares;
    } row[] = {{0, 3.4, 0.97, ONE}, {0.5, 4.3, 0.95, ONE}, {0.9, 6.4, 0.8, ONE}, {0, 2.3, 0.97, 8}, {0.5, 1.6, 1, 3},
               {0.9, 1.1, 1, 2}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; ++i) {
        const double figure = alpha_tests(s, row[i].turn, row[i].squares);
        CHECK_MSG(figure <= row[i].bound, "turned by %g, squares %d: %g tests of alpha, may be %g", row[i].turn,
                  row[i].squares, figure, row[i].bound);
        CHECK_MSG(sampled <= row[i].share * tests, "turned by %g, squares %d: %g of them test alpha, may be %g",
                  row[i].turn, row[i].squares, sampled / tests, row[i].share);
        printf("  masks, turned by %g, squares %d: %.3f, of which %.3f test alpha\n", row[i].turn, row[i].squares,
               figure, tests > 0 ? sampled / tests : 0.0);
    }
    CHECK(draws_are_equal(s, LMB_DEPTH32F));
    CHECK(draws_are_equal(s, LMB_DEPTH16));
}
