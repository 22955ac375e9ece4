/* test_transfer.c: baked light: a handmade file, each kind of damage to it, and a box baked by the test. */
#include "../world.h"

#include <stdlib.h>

#include "../../src/direct/glossy.h"
#include "../../src/raster/target.h"
#include "../../src/raster/tile.h"
#include "../../src/raster/triangle.h"
#include "../../src/transfer/air.h"
#include "../../tools/bake/bake.h"
#include "../../tools/demo/demo_scene.h"
#include "../reused_frame.h"
#include "../small_transfer.h"

void test_transfer(void);

#if LMB_TRANSFER

#define HASH_BEGIN 0xcbf29ce484222325u

enum { SMALL_WORDS = SMALL_TRANSFER_WORDS(ROOM_TRIANGLES), MAP = 128, FRAME = 40 };

static small_room room;
static uint32_t file[SMALL_WORDS], copy[SMALL_WORDS];
static uint32_t map_memory[MAP * MAP * 2];
static lmb_transfer_scratch scratch;

static int is_near(float a, float b, float by) { return absf(a - b) <= by; }

/* --- light in separate memory ------------------------------------------------------------------------------------- */

typedef struct lit {
    const lmb_transfer *t;
    const lmb_scene *scene;
    void *memory;
    size_t bytes;
    lmb_transfer_light light;
} lit;

static lit lit_by(const lmb_transfer *t, const lmb_scene *scene)
{
    lit l;
    memset(&l, 0, sizeof l);
    l.t = t;
    l.scene = scene;
    l.bytes = lmb_transfer_light_bytes(t);
    l.memory = malloc(l.bytes);
    CHECK(lmb_transfer_light_init(&l.light, t, l.memory, l.bytes) == LMB_OK);
    CHECK(lmb_transfer_materials(&l.light, t, scene) == LMB_OK);
    CHECK(lmb_transfer_clear(&l.light, t) == LMB_OK);
    return l;
}

static uint32_t places(const lmb_transfer *t)
{
    return t->count[LMB_TRANSFER_RECEIVERS] + t->count[LMB_TRANSFER_CLUSTERS];
}

static double sum_of(const lit *l, int c)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < l->t->count[LMB_TRANSFER_AREAS]; ++i) {
        sum += (double)l->light.power[i][c];
    }
    return sum;
}

/* Sends all light, `piece` receivers per call. */
static void receive(lit *l, uint32_t piece)
{
    const uint32_t all = places(l->t);
    CHECK(lmb_transfer_send(&l->light, l->t) == LMB_OK);
    for (uint32_t i = 0; i < all; i += piece) {
        const uint32_t past = all - i < piece ? all : i + piece;
        CHECK(lmb_transfer_receivers(&l->light, picked_kernels(), l->t, i, past) == LMB_OK);
    }
}

static lmb_shadow_map draw_map(const lmb_scene *scene)
{
    lmb_shadow_map map;
    CHECK(lmb_shadow_map_init(&map, &scene->lights[0], scene, MAP, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    CHECK(lmb_shadow_map_clear(&map) == LMB_OK && map.faces == 1);
    CHECK(lmb_shadow_map_draw(&map, picked_kernels(), scene, 1, lmb_scene_triangles(scene), NULL) == LMB_OK);
    return map;
}

/* Collects face 0 with one sample per `each` x `each` texels, `rows` block rows per call. */
static void collect(lit *l, const lmb_shadow_map *map, int32_t each, int32_t rows)
{
    const int32_t all = MAP / each;
    memset(&scratch, 0, sizeof scratch);
    for (int32_t y = 0; y < all; y += rows) {
        CHECK(lmb_transfer_collect(&l->light, picked_kernels(), &scratch, l->t, l->scene, &l->scene->lights[0], map,
                                   0, each, y, all - y < rows ? all : y + rows) == LMB_OK);
    }
}

/* --- by hand ------------------------------------------------------------------------------------------------------ */

static lmb_transfer open_small(void)
{
    lmb_transfer t;
    small_room_make(&room);
    CHECK(lmb_scene_check(&room.scene) == LMB_OK);
    CHECK(small_transfer(file, &room.scene) == sizeof file);
    CHECK(lmb_transfer_open(&t, file, sizeof file) == LMB_OK);
    return t;
}

static void pixel(lmb_tile *tile, int k, uint32_t id, lmb_vec3 at, lmb_vec3 normal)
{
    tile->id[k] = id;
    set_plane(tile->position, k, at);
    set_plane(tile->face, k, normal);
    set_plane(tile->normal, k, normal);
}

static void by_hand(void)
{
    static lmb_tile tile;
    static const float power[SMALL_ELEMENTS] = {8, 4, 12, 16};
    static const float sent[SMALL_ELEMENTS] = {4, 2, 3, 2}; /* half of the power per area; 18 W on 8 m2 in all */
    const lmb_vec3 down = vec3(0, -1, 0);
    const lmb_transfer t = open_small();
    lit l = lit_by(&t, &room.scene);
    lmb_irradiance out;
    CHECK(t.nodes == SMALL_NODES && t.leaves == 3 && lmb_transfer_fits(&t, &room.scene) == LMB_OK);
    CHECK(l.bytes == 36 * SMALL_ELEMENTS + 8 * SMALL_NODES + 12 * SMALL_RECEIVERS + 36 * SMALL_CLUSTERS +
                       SMALL_ELEMENTS * sizeof(lmb_transfer_coarse) +
                       LMB_TRANSFER_PARTS * sizeof(lmb_transfer_part));
    for (int i = 0; i < SMALL_ELEMENTS; ++i) {
        CHECK(is_near(l.light.albedo[i][0], 0.5f, 1e-6f) && l.light.power[i][0] == 0.0f);
        for (int c = 0; c < 3; ++c) {
            l.light.power[i][c] = power[i] * (c == 2 ? 0.5f : 1.0f);
        }
    }
    receive(&l, 1000);
    for (int i = 0; i < SMALL_ELEMENTS; ++i) {
        CHECK(is_near((float)l.light.node[i][0] * l.light.step, sent[i], 1e-4f));
        CHECK(is_near((float)l.light.node[i][2] * l.light.step, 0.5f * sent[i], 1e-4f));
    }
    const float mean = (4.0f + 2.0f + 2.0f * 3.0f + 4.0f * 2.0f) / 8.0f;
    CHECK(is_near((float)l.light.node[4][0] * l.light.step, mean, 1e-4f));
    const float want[SMALL_RECEIVERS] = {1.0f, 0.5f + 3.0f / 32.0f, 0.25f + 3.0f / 16.0f, 0.125f + 3.0f / 8.0f,
                                         0.5f * (1.5f + 3.0f / 32.0f) - mean / 16.0f};
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        CHECK_MSG(is_near(l.light.receiver[i][0], want[i], 1e-4f), "%d: %g, not %g", i,
                  (double)l.light.receiver[i][0], (double)want[i]);
        CHECK(is_near(l.light.receiver[i][2], 0.5f * want[i], 1e-4f));
    }
    const float cluster[SMALL_CLUSTERS][3] = {
        {0.125f * (4 - 2), -0.25f * (4 + 2), 2.0f / 64.0f}, {0.2f * 0.25f, 0.2f * -1.5f - 1.5f, 0.2f * 2.0f / 64.0f}};
    for (int i = 0; i < 3 * SMALL_CLUSTERS; ++i) {
        CHECK(is_near(l.light.cluster[i / 3][i % 3], cluster[i / 3][i % 3], 1e-4f));
    }
    memset(&out, 0, sizeof out);
    memset(&tile, 0, sizeof tile);
    pixel(&tile, 0, 1, vec3(-1, 0, -1), Y);
    pixel(&tile, 1, 1, vec3(-1, 0, 0), Y);
    pixel(&tile, 2, 1, vec3(-1, 0, 1), Y);
    pixel(&tile, 3, 2, vec3(1, 0, -1), Y);
    pixel(&tile, 4, 1, vec3(-1, 0, 0.5f), Y);
    pixel(&tile, 5, 1, vec3(-1, 0, -1), down);      /* the back receives nothing */
    pixel(&tile, 6, 3, vec3(-1, 1, -1), down);      /* blend 0 */
    pixel(&tile, 7, 3, vec3(1, 1, 1), down);        /* blend 1 */
    pixel(&tile, 8, 3, vec3(-1, 1, -1), X);         /* by direction */
    pixel(&tile, 9, 3, vec3(-1, 1, -1), Y);         /* from above: negative, so clamped to 0 */
    pixel(&tile, 10, 5, vec3(-1, 1, -1), Y);        /* no such triangle */
    set_plane(tile.face, 8, down);
    set_plane(tile.face, 9, down);
    out.rgb[0][0] = 7.0f; /* the call adds to the output */
    memset(&scratch, 0, sizeof scratch);
    CHECK(lmb_transfer_tile(&out, NULL, picked_kernels(), &scratch, &l.light, &t, &room.scene, &tile) == LMB_OK);
    const float pixels[12] = {7.0f + want[0],
                              want[4],
                              want[1],
                              want[3],
                              0.5f * (want[4] + want[1]),
                              0.0f,
                              1.5f,
                              55.0f / 255.0f * 1.5f + 200.0f / 255.0f * 1.8f,
                              0.25f + 0.75f,
                              0.0f,
                              0.0f,
                              0.0f};
    for (int k = 0; k < 12; ++k) {
        CHECK_MSG(is_near(out.rgb[0][k], pixels[k], 1e-4f), "pixel %d: %g, not %g", k, (double)out.rgb[0][k],
                  (double)pixels[k]);
    }
    free(l.memory);
}

static void are_near(const lit *l, const char *what, const float *got, const float want[SMALL_ELEMENTS], float share)
{
    for (int i = 0; i < SMALL_ELEMENTS; ++i) {
        const float is = got[i * (int)(sizeof *l->light.coarse / sizeof *got)];
        CHECK_MSG(is_near(is, share * want[i], 2e-4f), "%s: %g at %d, not %g", what, (double)is, i,
                  (double)(share * want[i]));
    }
}

/* The floor receives a quarter from the ceiling. The ceiling receives a 16th from each half of the floor and an eighth
 * from the rest. */
static void again_by_hand(void)
{
    static const float power[SMALL_ELEMENTS] = {8, 4, 12, 16};
    static const float first[SMALL_ELEMENTS] = {0.5f, 0.5f, 0.5f, 0.75f}, second[] = {0.09375f, 0.09375f, 0.09375f, 0.0625f};
    static const float both[SMALL_ELEMENTS] = {0.59375f, 0.59375f, 0.59375f, 0.8125f};
    const float kept = 0.0126953125f / 0.09375f, by_all = (4 * 0.25f + 4 * 0.375f) / (4.0f + 2.0f + 6.0f + 8.0f);
    const lmb_transfer t = open_small();
    lit l = lit_by(&t, &room.scene);
    for (int i = 0; i < SMALL_ELEMENTS; ++i) {
        l.light.power[i][0] = power[i];
        l.light.power[i][2] = 0.5f * power[i];
        CHECK(is_near(l.light.coarse[i].albedo[0], 0.5f, 1e-6f));
    }
    CHECK(lmb_transfer_bounce(&l.light, &t, LMB_TRANSFER_SEND_COLLECTED) == LMB_OK);
    are_near(&l, "came", l.light.coarse[0].came, first, 1.0f);
    are_near(&l, "came, blue", l.light.coarse[0].came + 2, first, 0.5f);
    CHECK(lmb_transfer_rest(&l.light, &t, LMB_TRANSFER_SEND_COLLECTED, 1) == LMB_OK);
    are_near(&l, "with the rest", l.light.coarse[0].all, first, 1.0f + by_all);
    CHECK(lmb_transfer_clear(&l.light, &t) == LMB_OK && l.light.coarse[3].all[0] == 0.0f);
    for (int i = 0; i < SMALL_ELEMENTS; ++i) {
        l.light.power[i][0] = power[i];
    }
    CHECK(lmb_transfer_bounce(&l.light, &t, LMB_TRANSFER_SEND_COLLECTED) == LMB_OK);
    CHECK(lmb_transfer_bounce(&l.light, &t, LMB_TRANSFER_SEND_RECEIVED) == LMB_OK);
    are_near(&l, "came again", l.light.coarse[0].came, second, 1.0f);
    are_near(&l, "all", l.light.coarse[0].all, both, 1.0f);
    CHECK(lmb_transfer_rest(&l.light, &t, LMB_TRANSFER_SEND_RECEIVED, 2) == LMB_OK);
    CHECK(is_near(l.light.coarse[3].all[0], 0.8125f + 0.0625f * (kept + kept * kept), 2e-4f));
    CHECK(lmb_transfer_send(&l.light, &t) == LMB_OK);
    CHECK(is_near((float)l.light.node[3][0] * l.light.step, 2.0f + 0.5f * l.light.coarse[3].all[0], 2e-4f));
    free(l.memory);
}

/* 1 W/m2 everywhere: the light that this sends is reflected together with the collected light. */
static void emits_by_hand(void)
{
    const lmb_transfer t = open_small();
    room.material.emission[1] = 1.0f / LMB_PI;
    lit l = lit_by(&t, &room.scene);
    l.light.power[3][1] = 16.0f;
    CHECK(is_near(l.light.emission[0][1], 1.0f, 1e-6f) && l.light.emission[3][0] == 0.0f);
    CHECK(lmb_transfer_bounce(&l.light, &t, LMB_TRANSFER_SEND_EMITTED) == LMB_OK);
    CHECK(is_near(l.light.coarse[0].came[1], 0.25f, 1e-4f) && is_near(l.light.coarse[3].came[1], 0.25f, 1e-4f));
    CHECK(l.light.coarse[0].came[0] == 0.0f);
    CHECK(lmb_transfer_bounce(&l.light, &t, LMB_TRANSFER_SEND_COLLECTED) == LMB_OK);
    CHECK(is_near(l.light.coarse[0].came[1], 0.25f * (2.0f + 0.125f), 1e-4f));
    CHECK(lmb_transfer_send(&l.light, &t) == LMB_OK);
    const float all = 0.25f + 0.25f * (0.125f); /* of the ceiling: the floor's second share */
    CHECK(is_near((float)l.light.node[3][1] * l.light.step, 1.0f + 2.0f + 0.5f * all, 2e-4f));
    free(l.memory);
}

/* --- cuts --------------------------------------------------------------------------------------------------------- */

/* Cuts the floor's first triangle at `part` of an edge, for elements and for divisions. */
enum { CUT_FILE_WORDS = SMALL_WORDS + LMB_TRANSFER_CUT_WORDS };
static uint32_t cut_file[CUT_FILE_WORDS];

static lmb_status open_cut(lmb_transfer *t, float part, uint32_t flags)
{
    lmb_transfer good = open_small();
    const uint32_t cut[LMB_TRANSFER_CUT_WORDS] = {SMALL_HALF(0, 4) | flags, float_bits(part)};
    memcpy(cut_file, file, sizeof file);
    cut_file[good.section[LMB_TRANSFER_PIECES] - file] = SMALL_HALF(LMB_TRANSFER_CUT, 0);
    cut_file[good.section[LMB_TRANSFER_DIVISIONS] - file] = SMALL_HALF(LMB_TRANSFER_CUT, 0);
    memcpy(cut_file + SMALL_WORDS, cut, sizeof cut);
    cut_file[2] = sizeof cut_file;
    cut_file[6 + LMB_TRANSFER_CUTS] = 1;
    return lmb_transfer_open(t, cut_file, sizeof cut_file);
}

static void cuts_of_files(void)
{
    static const float bad[] = {0.0f, 1.0f, -0.5f, 1.5f, 5e-7f, 0.9999999f};
    lmb_transfer t;
    CHECK(open_cut(&t, 0.25f, 0) == LMB_OK && t.count[LMB_TRANSFER_CUTS] == 1);
    CHECK(open_cut(&t, 0.25f, LMB_TRANSFER_WALL) == LMB_OK);
    for (int i = 0; i < COUNT(bad); ++i) {
        CHECK_MSG(open_cut(&t, bad[i], 0) == LMB_ERR_FORMAT, "%g", (double)bad[i]);
    }
    CHECK(open_cut(&t, 0.25f, 3u << LMB_TRANSFER_EDGE_BIT) == LMB_ERR_FORMAT);
    CHECK(open_cut(&t, 0.25f, 1) == LMB_ERR_FORMAT); /* halves from 5 on, of 6 */
    CHECK(open_cut(&t, 0.25f, 0) == LMB_OK);
    cut_file[SMALL_WORDS + 1] = 0x7fc00000u;
    CHECK(lmb_transfer_open(&t, cut_file, sizeof cut_file) == LMB_ERR_FORMAT);
    CHECK(open_cut(&t, 0.25f, 0) == LMB_OK);
    cut_file[t.section[LMB_TRANSFER_PIECES] - cut_file] = SMALL_HALF(LMB_TRANSFER_CUT, 1);
    CHECK(lmb_transfer_open(&t, cut_file, sizeof cut_file) == LMB_ERR_FORMAT);
}

/* Light is linear on both parts, and each part has an element. */
static void lit_by_cuts(float part)
{
    static lmb_tile tile;
    static const float along[] = {0.0f, 0.5f, 0.999f, 1.001f, 1.5f, 2.0f}; /* on the first part, then on the second */
    lmb_transfer t;
    lmb_irradiance out;
    CHECK(open_cut(&t, part, 0) == LMB_OK);
    lit l = lit_by(&t, &room.scene);
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        l.light.receiver[i][0] = (float)(i == 4 ? 10 : i);
    }
    memset(&tile, 0, sizeof tile);
    memset(&out, 0, sizeof out);
    memset(&scratch, 0, sizeof scratch);
    for (int k = 0; k < COUNT(along); ++k) {
        const float at = along[k] < 1.0f ? part * along[k] : part + (1.0f - part) * (along[k] - 1.0f);
        pixel(&tile, k, 1, vec3(-1, 0, -1 + 2 * at), Y);
    }
    CHECK(lmb_transfer_tile(&out, NULL, picked_kernels(), &scratch, &l.light, &t, &room.scene, &tile) == LMB_OK);
    for (int k = 0; k < COUNT(along); ++k) {
        const float a = along[k], want = a < 1.0f ? 10.0f * a : 10.0f * (2.0f - a) + (a - 1.0f);
        CHECK_MSG(is_near(out.rgb[0][k], want, 1e-3f), "cut at %g, %g: %g, not %g", (double)part, (double)a,
                  (double)out.rgb[0][k], (double)want);
    }
    free(l.memory);
}

/* Even light on the triangle is split between both elements by area. */
static void collected_by_cuts(float part)
{
    lmb_transfer t, halved = open_small();
    lit one = lit_by(&halved, &room.scene);
    const lmb_shadow_map map = draw_map(&room.scene);
    collect(&one, &map, 1, MAP);
    const float all = one.light.power[0][0] + one.light.power[1][0];
    CHECK(open_cut(&t, part, 0) == LMB_OK);
    lit l = lit_by(&t, &room.scene);
    collect(&l, &map, 1, MAP);
    CHECK(all > 0.0f && is_near(l.light.power[0][0] + l.light.power[1][0], all, 1e-4f * all));
    CHECK(part < 0.5f ? l.light.power[0][0] < one.light.power[0][0] : l.light.power[0][0] > one.light.power[0][0]);
    CHECK(is_near(l.light.power[2][0], one.light.power[2][0], 1e-4f * all));
    free(one.memory);
    free(l.memory);
}

/* A wall on a floor that the light sees on both sides divides the light like any cut: each = 4 and 8 have 4 x 4 cells. */
static void collected_by_wall(float part, int32_t each)
{
    lmb_transfer t;
    const lmb_shadow_map map = draw_map(&room.scene);
    float power[2][SMALL_ELEMENTS];
    for (int is_wall = 0; is_wall < 2; ++is_wall) {
        CHECK(open_cut(&t, part, is_wall ? LMB_TRANSFER_WALL : 0) == LMB_OK);
        lit l = lit_by(&t, &room.scene);
        collect(&l, &map, each, MAP);
        for (int i = 0; i < SMALL_ELEMENTS; ++i) {
            power[is_wall][i] = l.light.power[i][0];
        }
        free(l.memory);
    }
    const float all = power[0][0] + power[0][1];
    for (int i = 0; i < SMALL_ELEMENTS; ++i) {
        CHECK_MSG(is_near(power[1][i], power[0][i], 0.01f * all), "element %d, wall at %g, %d: %g, not %g", i,
                  (double)part, (int)each, (double)power[1][i], (double)power[0][i]);
    }
}

/* --- damage ------------------------------------------------------------------------------------------------------- */

/* An element with half of triangle 1, dark, and all of triangle 2, bright: albedos are weighted by area, at any
 * depth. */
static void parts_by_area(void)
{
    static uint8_t colours[4 * 3 * ROOM_TRIANGLES];
    lmb_transfer t = open_small();
    memset(colours, 51, sizeof colours / 4);
    memset(colours + sizeof colours / 4, 204, sizeof colours - sizeof colours / 4);
    room.mesh.colours = colours;
    file[LMB_TRANSFER_HEADER_WORDS + 4 * ROOM_TRIANGLES + 1] = SMALL_LEAF(0);
    CHECK(lmb_transfer_open(&t, file, sizeof file) == LMB_OK);
    lit l = lit_by(&t, &room.scene);
    CHECK(is_near(l.light.albedo[0][0], 0.5f * (1.0f * 0.2f + 2.0f * 0.8f) / 3.0f, 1e-5f));
    CHECK(is_near(l.light.albedo[1][1], 0.5f * 0.2f, 1e-5f));
    free(l.memory);
}

static void cut_off(void)
{
    lmb_transfer t;
    for (size_t n = 0; n < sizeof file; ++n) {
        memcpy(copy, file, sizeof file);
        CHECK(n % 4 != 0 || lmb_transfer_open(&t, copy, n) == LMB_ERR_FORMAT);
        copy[2] = (uint32_t)n;
        CHECK_MSG(lmb_transfer_open(&t, copy, n) == LMB_ERR_FORMAT, "%d bytes that say so", (int)n);
    }
}

static void bad_header(void)
{
    static const uint32_t turned[] = {1, 0x10000000u, 0x80000000u, 0xffffffffu};
    lmb_transfer t;
    for (int i = 0; i < LMB_TRANSFER_HEADER_WORDS * COUNT(turned); ++i) {
        const int word = i / COUNT(turned);
        memcpy(copy, file, sizeof file);
        copy[word] ^= turned[i % COUNT(turned)];
        const lmb_status status = lmb_transfer_open(&t, copy, sizeof copy);
        if (word == LMB_TRANSFER_HEADER_WORDS - 1) {
            CHECK(status == LMB_OK); /* a checksum, for readers of the whole file */
        } else if (word == 3 || word == 4) {
            CHECK(status == LMB_OK && lmb_transfer_fits(&t, &room.scene) == LMB_ERR_SCENE);
        } else {
            CHECK_MSG(status == LMB_ERR_FORMAT, "word %d by %x", word, (unsigned)turned[i % COUNT(turned)]);
        }
    }
    for (int i = 0; i < SMALL_WORDS; ++i) { /* the other byte order */
        const uint32_t w = file[i];
        copy[i] = i == 0 ? w : w >> 24 | (w >> 8 & 0xff00u) | (w & 0xff00u) << 8 | w << 24;
    }
    CHECK(lmb_transfer_open(&t, copy, sizeof copy) == LMB_ERR_FORMAT);
}

static void bad_words(void)
{
    static const struct { int section, word; uint32_t value; const char *what; } bad[] = {
        {LMB_TRANSFER_SURFACES, 0, 6, "no such piece"},
        {LMB_TRANSFER_SURFACES, 15, 6, "no such division"},
        {LMB_TRANSFER_SURFACES, 3, 0xfffffffeu, "no such division"},
        {LMB_TRANSFER_PIECES, 0, SMALL_HALF(0, 0), "a child that is its parent"},
        {LMB_TRANSFER_PIECES, 4, SMALL_HALF(0, 1), "a child before its parent"},
        {LMB_TRANSFER_PIECES, 0, SMALL_HALF(0, 5), "one child past the end"},
        {LMB_TRANSFER_PIECES, 0, SMALL_HALF(0, 6), "children past the end"},
        {LMB_TRANSFER_PIECES, 0, SMALL_HALF(3, 4), "no such edge"},
        {LMB_TRANSFER_PIECES, 1, SMALL_LEAF(SMALL_ELEMENTS), "no such element"},
        {LMB_TRANSFER_AREAS, 0, 0xbf800000u, "an area under 0"},
        {LMB_TRANSFER_AREAS, 3, 0x7f800000u, "an endless area"},
        {LMB_TRANSFER_AREAS, 2, 0x7fc00000u, "an area that is no number"},
        {LMB_TRANSFER_DIVISIONS, 0, SMALL_HALF(0, 0), "a child that is its parent"},
        {LMB_TRANSFER_DIVISIONS, 5, SMALL_HALF(0, 4), "a child before its parent"},
        {LMB_TRANSFER_DIVISIONS, 0, SMALL_HALF(3, 4), "no such edge"},
        {LMB_TRANSFER_DIVISIONS, 1, SMALL_LEAF(5), "no such corners"},
        {LMB_TRANSFER_CORNERS, 0, SMALL_RECEIVERS, "no such receiver"},
        {LMB_TRANSFER_CORNERS, 9, 2, "no such blend"},
        {LMB_TRANSFER_RECEIVERS, 20, 4, "its own parent"},
        {LMB_TRANSFER_RECEIVERS, 21, 5, "a parent behind it"},
        {LMB_TRANSFER_RECEIVERS, 21, LMB_TRANSFER_NONE, "one parent"},
        {LMB_TRANSFER_RECEIVERS, 0, 0, "the first has a parent"},
        {LMB_TRANSFER_RECEIVERS, 2, 8, "links past the end"},
        {LMB_TRANSFER_RECEIVERS, 2, 0xffffffffu, "links past the end"},
        {LMB_TRANSFER_RECEIVERS, 3, 0xffffffffu, "links without end"},
        {LMB_TRANSFER_RECEIVERS, 3, 9, "the same links twice"},
        {LMB_TRANSFER_RECEIVERS, 4, 0xbf800000u, "a scale under 0"},
        {LMB_TRANSFER_RECEIVERS, 4, 0x7f800000u, "an endless scale"},
        {LMB_TRANSFER_LINKS, 0, SMALL_LINK(SMALL_NODES, 1), "no such node"},
        {LMB_TRANSFER_LINKS, 1, SMALL_LINK(2, 16384), "weights over the sum"},
        {LMB_TRANSFER_LINKS, 1, SMALL_LINK(2, -16384), "weights over the sum"},
        {LMB_TRANSFER_LINKS, 8, SMALL_LINK(2, -32768), "a weight over the sum"},
        {LMB_TRANSFER_BLENDS, 0, SMALL_CLUSTERS, "no such cluster"},
        {LMB_TRANSFER_BLENDS, 4, SMALL_CLUSTERS << 16, "no such cluster"},
        {LMB_TRANSFER_BLENDS, 2, 255u | 1u << 8, "weights over their sum"},
        {LMB_TRANSFER_CLUSTERS, 0, 1, "a parent behind it, though of no weight"},
        {LMB_TRANSFER_CLUSTERS, 2, 1, "the first has a parent"},
        {LMB_TRANSFER_CLUSTERS, 3, 2, "links past the end"},
        {LMB_TRANSFER_CLUSTERS, 4, 3, "the same links twice"},
        {LMB_TRANSFER_CLUSTERS, 5, 0x7fc00000u, "a scale that is no number"},
        {LMB_TRANSFER_CLUSTERS, 6, 1, "its own parent"},
        {LMB_TRANSFER_CLUSTERS, 7, 2u << 16, "no such parent"},
        {LMB_TRANSFER_CLUSTERS, 8, 0x01010101u * 64u, "weights over their sum"},
        {LMB_TRANSFER_CLUSTER_LINKS, 0, SMALL_LINK(SMALL_NODES, 1), "no such node"},
        {LMB_TRANSFER_CLUSTER_LINKS, 0, SMALL_LINK(0, 28672), "weights along x over the sum"},
        {LMB_TRANSFER_CLUSTER_LINKS, 1, 0x9fff, "weights along y over the sum"},
        {LMB_TRANSFER_CLUSTER_LINKS, 1, 0x7e00e000u, "weights along z over the sum"},
        {LMB_TRANSFER_COARSE, 0, 1, "an element before the first"},
        {LMB_TRANSFER_COARSE, 8, 1, "a run without elements"},
        {LMB_TRANSFER_COARSE, 12, SMALL_ELEMENTS, "no such element"},
        {LMB_TRANSFER_COARSE, 1, 6, "links past the end"},
        {LMB_TRANSFER_COARSE, 14, 4, "links past the end"},
        {LMB_TRANSFER_COARSE, 2, 5, "the same links twice"},
        {LMB_TRANSFER_COARSE, 3, 0x7f800000u, "an endless scale"},
        {LMB_TRANSFER_COARSE_LINKS, 0, SMALL_LINK(SMALL_NODES, 1), "no such node"},
        {LMB_TRANSFER_COARSE_LINKS, 4, SMALL_LINK(1, 28672), "weights over the sum"},
    };
    static uint32_t longer[SMALL_WORDS + 1];
    lmb_transfer good, t;
    CHECK(lmb_transfer_open(&good, file, sizeof file) == LMB_OK);
    for (int i = 0; i < COUNT(bad); ++i) {
        memcpy(copy, file, sizeof file);
        copy[good.section[bad[i].section] - file + bad[i].word] = bad[i].value;
        CHECK_MSG(lmb_transfer_open(&t, copy, sizeof copy) == LMB_ERR_FORMAT, "section %d, word %d: %s",
                  bad[i].section, bad[i].word, bad[i].what);
        CHECK(t.section[0] == NULL && lmb_transfer_light_bytes(&t) == 0);
    }
    memcpy(longer, file, sizeof file); /* a word that no section has */
    longer[2] = sizeof longer;
    CHECK(lmb_transfer_open(&t, longer, sizeof longer) == LMB_ERR_FORMAT);
    memcpy(copy, file, sizeof file); /* the maximum that is allowed */
    copy[good.section[LMB_TRANSFER_LINKS] - file + 1] = SMALL_LINK(2, -16383);
    CHECK(lmb_transfer_open(&t, copy, sizeof copy) == LMB_OK);
}

/* Triangle 2 moves between two places in the air, the second of which has no light. */
enum { AIR_WORDS = 11, AIRY_WORDS = SMALL_WORDS + AIR_WORDS };
static uint32_t airy[AIRY_WORDS];

static void put_air(void)
{
    const uint32_t air[AIR_WORDS] = {2, 3, float_bits(-1.0f), float_bits(0.5f), float_bits(0.0f), float_bits(0.5f), 2, 1, 1,
                                     0, LMB_TRANSFER_NONE};
    memcpy(airy, file, sizeof file);
    memcpy(airy + SMALL_WORDS, air, sizeof air);
    airy[2] = sizeof airy;
    airy[6 + LMB_TRANSFER_MOVING] = airy[6 + LMB_TRANSFER_GRID] = 1;
    airy[6 + LMB_TRANSFER_AIR] = 2;
}

/* The six receivers of a place must exist: with eight receivers they start at 0, 1 or 2. */
static void last_air(void)
{
    enum { MORE = 3, EACH = LMB_TRANSFER_RECEIVER_WORDS };
    static uint32_t longer[AIRY_WORDS + MORE * EACH];
    lmb_transfer t;
    put_air();
    airy[SMALL_WORDS + 9] = LMB_TRANSFER_NONE;
    CHECK(lmb_transfer_open(&t, airy, sizeof airy) == LMB_OK && t.count[LMB_TRANSFER_RECEIVERS] + MORE == 8);
    const size_t past = (size_t)(t.section[LMB_TRANSFER_RECEIVERS + 1] - airy);
    memcpy(longer, airy, past * sizeof *airy);
    for (int i = 0; i < MORE; ++i) {
        const uint32_t one[EACH] = {LMB_TRANSFER_NONE, LMB_TRANSFER_NONE, 0, 0, float_bits(SMALL_ONE)};
        memcpy(longer + past + EACH * i, one, sizeof one);
    }
    memcpy(longer + past + MORE * EACH, airy + past, sizeof airy - past * sizeof *airy);
    longer[2] = sizeof longer;
    longer[6 + LMB_TRANSFER_RECEIVERS] += MORE;
    for (uint32_t first = 0; first < 12; ++first) {
        longer[SMALL_WORDS + 9 + MORE * EACH] = first;
        CHECK_MSG(lmb_transfer_open(&t, longer, sizeof longer) == (first <= 2 ? LMB_OK : LMB_ERR_FORMAT), "from %u",
                  (unsigned)first);
    }
}

/* The small file has five receivers, and a place in the air takes six. */
static void bad_air(void)
{
    static const struct { int word; uint32_t value; const char *what; } bad[] = {
        {0, 0, "no such id"},          {1, 2, "an empty range"},      {1, ROOM_TRIANGLES + 2, "no such id"},
        {2, 0x7f800000u, "no place"},  {5, 0xbf800000u, "under no places a metre"}, {5, 0x7fc00000u, "no number"},
        {6, 0, "no places"},           {6, 3, "more places than there are"}, {7, 2, "more places than there are"},
        {8, LMB_TRANSFER_MAX_AIR + 1, "too many places"}, {9, 0, "six receivers of five"}, {9, 0xfffffffeu, "no receivers"},
    };
    lmb_transfer t;
    put_air();
    airy[SMALL_WORDS + 9] = LMB_TRANSFER_NONE;
    CHECK(lmb_transfer_open(&t, airy, sizeof airy) == LMB_OK && t.count[LMB_TRANSFER_AIR] == 2);
    for (int i = 0; i < COUNT(bad); ++i) {
        put_air();
        airy[SMALL_WORDS + 9] = LMB_TRANSFER_NONE;
        airy[SMALL_WORDS + bad[i].word] = bad[i].value;
        CHECK_MSG(lmb_transfer_open(&t, airy, sizeof airy) == LMB_ERR_FORMAT, "%s", bad[i].what);
    }
}

/* Pieces that share halves: no more paths are followed than there are pieces. Light reaches an element below fewer than
 * LMB_TRANSFER_MAX_HALVINGS halvings, and none below more. */
static void shared_halves(uint32_t lines)
{
    enum { MOST = 200 };
    static uint32_t word[SMALL_WORDS + MOST - 6];
    const size_t at = LMB_TRANSFER_HEADER_WORDS + 4 * ROOM_TRIANGLES, bytes = sizeof file + (lines - 6) * sizeof *word;
    lmb_transfer t, plain = open_small();
    const lmb_shadow_map map = draw_map(&room.scene);
    memcpy(word, file, at * sizeof *word);
    for (uint32_t i = 0; i < lines; ++i) {
        word[at + i] = i + 2 < lines ? SMALL_HALF(0, i + 1) : SMALL_LEAF(0);
    }
    memcpy(word + at + lines, file + at + 6, sizeof file - (at + 6) * sizeof *word);
    word[2] = (uint32_t)bytes;
    word[7] = lines;
    CHECK(lmb_transfer_open(&t, word, bytes) == LMB_OK);
    lit l = lit_by(&t, &room.scene), whole = lit_by(&plain, &room.scene); /* ends */
    collect(&l, &map, 8, MAP);
    collect(&whole, &map, 8, MAP);
    const double all = sum_of(&whole, 0), want = lines > LMB_TRANSFER_MAX_HALVINGS ? 0.0 : all;
    CHECK_MSG(all > 0.0 && fabs(sum_of(&l, 0) - want) <= 1e-4 * all, "%u pieces: %g, not %g", (unsigned)lines,
              sum_of(&l, 0), want);
    free(l.memory);
    free(whole.memory);
}

/* Which ids move: those of each range, and LMB_TRANSFER_NONE. Without places in the air, moving pixels stay dark. */
static void moves_by_ranges(void)
{
    static const uint32_t range[4] = {2, 3, 4, 5};
    static lmb_tile tile;
    static lmb_irradiance out;
    lmb_transfer t = open_small();
    lit l = lit_by(&t, &room.scene);
    for (int i = 0; i < SMALL_RECEIVERS; ++i) {
        l.light.receiver[i][0] = 1.0f;
    }
    t.section[LMB_TRANSFER_MOVING] = range;
    t.count[LMB_TRANSFER_MOVING] = 2;
    for (uint32_t id = 1; id <= 5; ++id) {
        CHECK_MSG(lmb_transfer_moves(&t, id) == (id == 2 || id == 4), "%u", (unsigned)id);
    }
    CHECK(lmb_transfer_moves(&t, LMB_TRANSFER_NONE));
    memset(&out, 0, sizeof out);
    memset(&tile, 0, sizeof tile);
    memset(&scratch, 0, sizeof scratch);
    for (int k = 0; k < 2; ++k) {
        pixel(&tile, k, 1 + (uint32_t)k, vec3(-0.5f + (float)k, 0, 0), Y);
    }
    CHECK(lmb_transfer_tile(&out, NULL, picked_kernels(), &scratch, &l.light, &t, &room.scene, &tile) == LMB_OK);
    CHECK(is_near(out.rgb[0][0], 1.0f, 1e-5f) && out.rgb[0][1] == 0.0f);
    free(l.memory);
}

static void bad_arguments(void)
{
    static lmb_tile tile;
    static lmb_irradiance out;
    static const lmb_transfer none;
    static lmb_transfer_light dark;
    lmb_transfer t;
    lmb_transfer_light other;
    uint32_t own[2];
    const lmb_transfer good = open_small();
    const lmb_shadow_map map = draw_map(&room.scene);
    lit l = lit_by(&good, &room.scene);
    const lmb_scene *s = &room.scene;
    const lmb_light *from = &room.light;
    const lmb_kernels *all = picked_kernels();
    memcpy(copy, file, sizeof file);
    CHECK(lmb_transfer_open(NULL, copy, sizeof copy) == LMB_ERR_ARG);
    CHECK(lmb_transfer_open(&t, NULL, sizeof copy) == LMB_ERR_ARG);
    for (int i = 1; i < 4; ++i) {
        CHECK(lmb_transfer_open(&t, (const uint8_t *)copy + i, sizeof copy - 4) == LMB_ERR_ALIGN);
    }
    lmb_transfer_fingerprint(NULL, s, NULL, 0);
    lmb_transfer_fingerprint(own, NULL, NULL, 0);
    CHECK(lmb_transfer_fits(NULL, s) == LMB_ERR_ARG && lmb_transfer_fits(&good, NULL) == LMB_ERR_ARG);
    CHECK(lmb_transfer_fits(&none, s) == LMB_ERR_ARG);
    CHECK(lmb_transfer_light_bytes(NULL) == 0 && lmb_transfer_light_bytes(&none) == 0);
    CHECK(lmb_transfer_light_init(NULL, &good, l.memory, l.bytes) == LMB_ERR_ARG);
    CHECK(lmb_transfer_light_init(&other, NULL, l.memory, l.bytes) == LMB_ERR_ARG);
    CHECK(lmb_transfer_light_init(&other, &none, l.memory, l.bytes) == LMB_ERR_ARG);
    CHECK(lmb_transfer_light_init(&other, &good, NULL, l.bytes) == LMB_ERR_ARG);
    CHECK(lmb_transfer_light_init(&other, &good, (uint8_t *)l.memory + 2, l.bytes) == LMB_ERR_ALIGN);
    CHECK(lmb_transfer_light_init(&other, &good, l.memory, l.bytes - 1) == LMB_ERR_CAPACITY);
    CHECK(lmb_transfer_materials(NULL, &good, s) == LMB_ERR_ARG);
    CHECK(lmb_transfer_materials(&dark, &good, s) == LMB_ERR_ARG);
    CHECK(lmb_transfer_materials(&l.light, NULL, s) == LMB_ERR_ARG);
    CHECK(lmb_transfer_materials(&l.light, &none, s) == LMB_ERR_ARG);
    CHECK(lmb_transfer_materials(&l.light, &good, NULL) == LMB_ERR_ARG);
    CHECK(lmb_transfer_clear(NULL, &good) == LMB_ERR_ARG && lmb_transfer_clear(&dark, &good) == LMB_ERR_ARG);
    CHECK(lmb_transfer_clear(&l.light, NULL) == LMB_ERR_ARG && lmb_transfer_clear(&l.light, &none) == LMB_ERR_ARG);
    CHECK(lmb_transfer_send(NULL, &good) == LMB_ERR_ARG && lmb_transfer_send(&dark, &good) == LMB_ERR_ARG);
    CHECK(lmb_transfer_send(&l.light, NULL) == LMB_ERR_ARG && lmb_transfer_send(&l.light, &none) == LMB_ERR_ARG);
    CHECK(lmb_transfer_bounce(NULL, &good, 0) == LMB_ERR_ARG && lmb_transfer_bounce(&dark, &good, 0) == LMB_ERR_ARG);
    CHECK(lmb_transfer_bounce(&l.light, NULL, 0) == LMB_ERR_ARG && lmb_transfer_bounce(&l.light, &none, 0) == LMB_ERR_ARG);
    CHECK(lmb_transfer_bounce(&l.light, &good, -1) == LMB_ERR_ARG && lmb_transfer_bounce(&l.light, &good, 3) == LMB_ERR_ARG);
    CHECK(lmb_transfer_rest(NULL, &good, 1, 1) == LMB_ERR_ARG && lmb_transfer_rest(&dark, &good, 1, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_rest(&l.light, &none, 1, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_rest(&l.light, &good, 1, -1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_rest(&l.light, &good, 1, LMB_MAX_BOUNCES + 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_receivers(NULL, all, &good, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_receivers(&dark, all, &good, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_receivers(&l.light, NULL, &good, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_receivers(&l.light, all, NULL, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_receivers(&l.light, all, &none, 0, 0) == LMB_ERR_ARG);
    CHECK(lmb_transfer_receivers(&l.light, all, &good, 2, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_receivers(&l.light, all, &good, 0, places(&good) + 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(NULL, NULL, all, &scratch, &l.light, &good, s, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, NULL, &scratch, &l.light, &good, s, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, all, NULL, &l.light, &good, s, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, all, &scratch, NULL, &good, s, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, all, &scratch, &dark, &good, s, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, all, &scratch, &l.light, NULL, s, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, all, &scratch, &l.light, &none, s, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, all, &scratch, &l.light, &good, NULL, &tile) == LMB_ERR_ARG);
    CHECK(lmb_transfer_tile(&out, NULL, all, &scratch, &l.light, &good, s, NULL) == LMB_ERR_ARG);
    static const struct { int32_t face, each, first, past; } bad[] = {
        {1, 1, 0, 1}, {-1, 1, 0, 1}, {0, 0, 0, 1}, {0, -1, 0, 1}, {0, 3, 0, 1}, {0, 2 * MAP, 0, 1}, {0, 1, -1, 1},
        {0, 1, 2, 1}, {0, 1, 0, MAP + 1}, {0, 2, 0, MAP / 2 + 1}};
    for (int i = 0; i < COUNT(bad); ++i) {
        CHECK_MSG(lmb_transfer_collect(&l.light, all, &scratch, &good, s, from, &map, bad[i].face, bad[i].each,
                                       bad[i].first, bad[i].past) == LMB_ERR_ARG, "%d", i);
    }
    CHECK(lmb_transfer_collect(NULL, all, &scratch, &good, s, from, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&dark, all, &scratch, &good, s, from, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&l.light, NULL, &scratch, &good, s, from, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&l.light, all, NULL, &good, s, from, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&l.light, all, &scratch, NULL, s, from, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&l.light, all, &scratch, &none, s, from, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&l.light, all, &scratch, &good, NULL, from, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&l.light, all, &scratch, &good, s, NULL, &map, 0, 1, 0, 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_collect(&l.light, all, &scratch, &good, s, from, NULL, 0, 1, 0, 1) == LMB_ERR_ARG);
    free(l.memory);
}

/* The positions of the triangles decide, not their colours or the lights. */
static void fits(void)
{
    const lmb_transfer t = open_small();
    room.material.albedo[0] = 0.9f;
    room.material.emission[1] = 3.0f;
    room.light.position.x = 0.5f;
    room.scene.light_count = 0;
    CHECK(lmb_transfer_fits(&t, &room.scene) == LMB_OK);
    room.instance.to_world.m[0] = -0.0f; /* the sign of a zero does not move anything */
    room.instance.to_world.m[0] = 1.0f;
    room.instance.to_world.m[1] = -0.0f;
    CHECK(lmb_transfer_fits(&t, &room.scene) == LMB_OK);
    room.instance.to_world.m[3] = room.instance.to_world.m[12] = 0.001f;
    CHECK(lmb_transfer_fits(&t, &room.scene) == LMB_ERR_SCENE);
    room.instance.to_world.m[3] = room.instance.to_world.m[12] = 0.0f;
    CHECK(lmb_transfer_fits(&t, &room.scene) == LMB_OK);
    room.material.flags = LMB_DOUBLE_SIDED;
    CHECK(lmb_transfer_fits(&t, &room.scene) == LMB_ERR_SCENE);
    room.material.flags = 0;
    room.corners[3][2][1] += 1e-6f;
    CHECK(lmb_transfer_fits(&t, &room.scene) == LMB_ERR_SCENE);
    room.corners[3][2][1] = 1.0f;
    room.mesh.triangle_count = 3;
    CHECK(lmb_transfer_fits(&t, &room.scene) == LMB_ERR_SCENE);
}

/* --- a box -------------------------------------------------------------------------------------------------------- */

static lmb_light box_light;

/* A room with a block at height y. */
static void make_box(float y)
{
    world_begin(0.7f, 0.5f, 0.3f);
    world_box(vec3(0, 0, 0), 1.5f);
    world_part();
    world_box(vec3(0.4f, y, 0.2f), 0.3f);
    box_light = spot(vec3(-0.5f, 1.2f, 0.3f), vec3(0.3f, -1, 0), 25, 40);
    world.scene.lights = &box_light;
    world.scene.light_count = 1;
    CHECK(world_end() == LMB_OK);
}

static uint64_t tests_of_bake; /* visibility tests of the last bake */

/* All steps of `lambent bake`; moves: the moving object, or NULL. */
static file_bytes bake_whole(const lmb_scene *scene, const bake_settings *set, const uint32_t *moves)
{
    bake_still_scene still = {*scene, NULL};
    bake b;
    report r = {""};
    file_bytes out = {NULL, 0};
    memset(&b, 0, sizeof b);
    b.tests = &tests_of_bake;
    tests_of_bake = 0;
    CHECK_MSG((moves == NULL || bake_still(&still, scene, moves, 1, &b.section[LMB_TRANSFER_MOVING], &r)) &&
                  bake_begin(&b, &still.scene, set, &r) && bake_reach(&b, NULL, 0, &r) && bake_receivers(&b, &r) &&
                  bake_clusters(&b, &r) && bake_directed(&b, &r) && bake_air(&b, &r) && bake_bounces(&b, &r) &&
                  bake_code_all(&b, &r) && bake_file(&out, &b, &r),
              "%s", r.text);
    bake_free(&b);
    free(still.instance);
    return out;
}

/* Few enough for a bake of under a second per file. */
static bake_settings few(float error, float division, int receivers)
{
    bake_settings set;
    memset(&set, 0, sizeof set);
    set.error = error;
    set.division = division;
    set.elements = 256;
    set.receivers = receivers;
    set.dividing = 12000;
    set.threads = 2;
    return set;
}

/* moves: whether the block moves. */
static file_bytes bake_box(int threads, int moves)
{
    static const uint32_t block[1] = {1};
    bake_settings set = few(0.0013f, 0.01f, 200);
    set.threads = threads;
    return bake_whole(&world.scene, &set, moves ? block : NULL);
}

/* The light barely changes with one link fewer or one piece sampled from another point, so only hashes of the file show
 * such changes. They are equal on all machines. */
static uint64_t hash_words(uint64_t hash, const void *words, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        uint32_t word;
        memcpy(&word, (const uint8_t *)words + 4 * i, sizeof word);
        hash = (hash ^ word) * 0x100000001b3u;
    }
    return hash;
}

/* Hashes a file's words, independent of byte order, with 0 for the checksum, which is over bytes. */
static void is_pinned(const char *name, const file_bytes *baked, uint64_t wanted)
{
    static const uint32_t none;
    const size_t head = 4 * LMB_TRANSFER_HEADER_WORDS;
    uint64_t hash = 0;
    if (baked->size >= head) {
        hash = hash_words(HASH_BEGIN, baked->data + 4, LMB_TRANSFER_HEADER_WORDS - 2);
        hash = hash_words(hash_words(hash, &none, 1), baked->data + head, (baked->size - head) / 4);
    }
    CHECK_MSG(hash == wanted, "what was baked of %s is 0x%016llx", name, (unsigned long long)hash);
}

/* A panel with corners and the middle of the longest edge inside blocks. Some places in the air are inside too, because
 * a small block moves. */
static void bytes_of_buried(void)
{
    static const uint32_t small[1] = {1};
    const bake_settings set = few(0.0013f, 1.0f, 0);
    world_begin(0.7f, 0.5f, 0.3f);
    world_box(vec3(0, 0, 0), 1.5f);
    world_triangle(vec3(-1, -0.6f, -0.8f), vec3(0, -0.6f, 1), vec3(1, -0.6f, -0.8f));
    world_box(vec3(-1, -0.6f, -0.8f), 0.3f);
    world_box(vec3(1, -0.6f, -0.8f), 0.3f);
    world_box(vec3(0, -0.6f, 1), 0.3f);
    world_box(vec3(0, -0.6f, -0.8f), 0.3f);
    world_part();
    world_box(vec3(0, 0.8f, 0), 0.1f);
    world.scene.lights = &box_light;
    world.scene.light_count = 1;
    CHECK(world_end() == LMB_OK);
    file_bytes baked = bake_whole(&world.scene, &set, small);
    is_pinned("a panel in blocks", &baked, 0xdf0716fecc740dceu);
    file_free(&baked);
}

/* Large triangles, and small ones that share clusters and elements. */
static void bytes_of_demo(void)
{
    bake_settings set = few(0.00014f, 0.008f, 300);
    set.cluster_m = 0.3f;
    file_bytes baked = bake_whole(demo_scene(), &set, NULL);
    is_pinned("the demo", &baked, 0xa55ed3df044a4c90u);
    file_free(&baked);
}

/* Bounds the work of a bake, in visibility tests. Light by direction needs the same tests as light along the normal, so
 * normal maps take no second pass (here 12 % more tests). Of the 60 million, 3.5 find small sides that only the elements
 * with most light reach. Seven more would be needed if all quarters of near elements were split. */
static void tests_are_few(void)
{
    static lmb_material bumpy[64];
    lmb_scene scene = *demo_scene();
    const bake_settings set = few(0.00014f, 0.008f, 600);
    file_bytes baked = bake_whole(&scene, &set, NULL);
    const double plain = (double)tests_of_bake;
    file_free(&baked);
    CHECK(scene.material_count <= 64);
    for (uint32_t i = 0; i < scene.material_count; ++i) {
        bumpy[i] = scene.materials[i];
        bumpy[i].normal_scale = 1.0f;
    }
    scene.materials = bumpy;
    baked = bake_whole(&scene, &set, NULL);
    const double by_direction = (double)tests_of_bake;
    file_free(&baked);
    CHECK_MSG(by_direction <= 1.05 * plain, "%.0f tests with normal maps, %.0f without", by_direction, plain);
    CHECK_MSG(plain <= 61e6, "%.0f tests", plain);
}

static void is_same_by(const lmb_transfer *t, const lmb_scene *scene)
{
    static const int32_t rows[] = {1, 5, MAP / 2};
    static const uint32_t pieces[] = {1, 3, 64};
    const size_t elements = t->count[LMB_TRANSFER_AREAS];
    const lmb_shadow_map map = draw_map(scene);
    lit whole = lit_by(t, scene), l = lit_by(t, scene);
    collect(&whole, &map, 1, MAP);
    for (int i = 0; i < COUNT(rows); ++i) {
        CHECK(lmb_transfer_clear(&l.light, t) == LMB_OK);
        collect(&l, &map, 1, rows[i]);
        CHECK_MSG(memcmp(l.light.power, whole.light.power, elements * sizeof *l.light.power) == 0, "by %d rows",
                  (int)rows[i]);
    }
    receive(&whole, 1u << 20);
    for (int i = 0; i < COUNT(pieces); ++i) {
        memset(l.light.receiver, 0x3c, t->count[LMB_TRANSFER_RECEIVERS] * sizeof *l.light.receiver);
        memset(l.light.cluster, 0x3c, t->count[LMB_TRANSFER_CLUSTERS] * sizeof *l.light.cluster);
        receive(&l, pieces[i]);
        CHECK_MSG(memcmp(l.memory, whole.memory, l.bytes) == 0, "by %d", (int)pieces[i]);
    }
    free(whole.memory);
    free(l.memory);
}

/* W: sum over the texels that show a surface. */
static double power_of(const lmb_shadow_map *map, const lmb_light *light, int c)
{
    double sum = 0.0;
    for (int32_t i = 0; i < MAP * MAP; ++i) {
        const int32_t x = i % MAP, y = i / MAP;
        const lmb_fill_tile tile = lmb_target_tile(&map->face[0], x / LMB_TILE, y / LMB_TILE);
        float power[3];
        lmb_light_texel_power(power, light, map, 0, x, y);
        sum += ((const uint32_t *)tile.id)[y % LMB_TILE * tile.id_step + x % LMB_TILE] != 0 ? (double)power[c] : 0.0;
    }
    return sum;
}

static void keeps_power(const lmb_transfer *t, const lmb_scene *scene)
{
    const lmb_shadow_map map = draw_map(scene);
    lit l = lit_by(t, scene);
    collect(&l, &map, 1, MAP);
    for (int c = 0; c < 3; ++c) {
        const double want = power_of(&map, scene->lights, c), got = sum_of(&l, c);
        CHECK_MSG(want > 0.0 && fabs(got / want - 1.0) < 1e-4, "%g W of %g", got, want);
    }
    const double all = sum_of(&l, 0);
    CHECK(lmb_transfer_clear(&l.light, t) == LMB_OK && sum_of(&l, 0) == 0.0);
    collect(&l, &map, 4, MAP); /* a 16th of the texels: nearly the same */
    CHECK_MSG(fabs(sum_of(&l, 0) / all - 1.0) < 0.01, "%g W of %g", sum_of(&l, 0), all);
    free(l.memory);
}

/* A range scales the light on each triangle by distance: tested with a hard cone 0.75 m above the floor. */
static void keeps_to_range(const lmb_transfer *t)
{
    static const float ranges[] = {3.0f, 1.2f, 0.9f, 0.7f};
    const lmb_light before = room.light;
    room.light.cos_inner = room.light.cos_outer = 0.7f;
    for (int each = 1; each <= 2; ++each) {
        double all = 0.0;
        for (int i = -1; i < COUNT(ranges); ++i) {
            room.light.range = i < 0 ? 0.0f : ranges[i];
            const lmb_shadow_map map = draw_map(&room.scene);
            lit l = lit_by(t, &room.scene);
            collect(&l, &map, each, MAP / each);
            const double got = sum_of(&l, 0), open = 2.0 * PI * 0.3;
            all = i < 0 ? got : all;
            const double end = (double)room.light.range;
            const double want = i < 0 ? all : end < 0.75 ? 0.0 : range_power(0.75, end, 0.7) / open * all;
            CHECK_MSG(want > 0.0 ? fabs(got / want - 1.0) < 5e-3 : got == 0.0, "range %g, by %d: %g W, not %g",
                      (double)room.light.range, each, got, want);
            free(l.memory);
        }
    }
    room.light = before;
}

/* Light passes the holes of a masked floor and belongs to no element: the outline does not include the holes. */
static void keeps_masked_power(const lmb_transfer *t)
{
    static uint8_t texels[64][4];
    static float uvs[ROOM_TRIANGLES][3][2];
    static const lmb_texture holes = {texels[0], 8, 8, 1, LMB_WRAP_REPEAT, LMB_WRAP_REPEAT, LMB_NEAREST, 0};
    const small_room whole = room;
    for (int i = 0; i < 64; ++i) {
        memset(texels[i], (i % 8 + i / 8) % 2 ? 255 : 0, 4);
    }
    for (int i = 0; i < 3 * ROOM_TRIANGLES; ++i) {
        uvs[i / 3][i % 3][0] = room.corners[i / 3][i % 3][0];
        uvs[i / 3][i % 3][1] = room.corners[i / 3][i % 3][2];
    }
    room.mesh.uvs = uvs;
    room.scene.textures = &holes;
    room.scene.texture_count = 1;
    room.material.texture = 0;
    room.material.alpha_cutoff = 0.5f;
    room.material.flags |= LMB_ALPHA_MASK;
    keeps_power(t, &room.scene);
    room = whole;
}

/* In a closed room, elements collect the closed-form power of a spot, 2 pi (1 - mean of the cones' cosines) times the
 * intensity, to 0.1 %, even if the spot lights only parts of a few elements. */
static void collects_all(const lmb_transfer *t)
{
    static const float cone[][2] = {{25.0f, 40.0f}, {44.0f, 45.0f}, {2.0f, 4.0f}, {1.0f, 1.5f}};
    const lmb_light before = box_light;
    for (int i = 0; i < 4; ++i) {
        box_light = spot(vec3(-0.5f, 1.2f, 0.3f), vec3(0.31f, -1, 0.07f), (double)cone[i][0], (double)cone[i][1]);
        const lmb_shadow_map map = draw_map(&world.scene);
        lit l = lit_by(t, &world.scene);
        collect(&l, &map, 1, MAP);
        const double mean = 0.5 * ((double)box_light.cos_inner + (double)box_light.cos_outer);
        uint32_t lit_elements = 0;
        for (uint32_t k = 0; k < t->count[LMB_TRANSFER_AREAS]; ++k) {
            lit_elements += l.light.power[k][0] > 0.0f;
        }
        for (int c = 0; c < 3; ++c) {
            const double want = 2.0 * PI * (1.0 - mean) * (double)box_light.intensity[c], got = sum_of(&l, c);
            CHECK_MSG(want > 0.0 && fabs(got / want - 1.0) < 1e-3, "%g degrees: %g W of %g", (double)cone[i][1], got,
                      want);
        }
        CHECK_MSG(lit_elements > 0 && (cone[i][1] > 2.0f || lit_elements <= 4), "%u elements", (unsigned)lit_elements);
        free(l.memory);
    }
    box_light = before;
}

enum { LIGHTS = 40, CELLS = 64 };

static lmb_light many_light[LIGHTS];

/* Points between the walls and above the block. Sets the sum of their intensities. Returns the tree's memory. */
static void *make_many_lights(lmb_many_lights *out, float sum[3])
{
    const size_t bytes = lmb_many_lights_bytes(CELLS);
    void *memory = malloc(bytes);
    test_rng r = {11};
    sum[0] = sum[1] = sum[2] = 0.0f;
    for (int i = 0; i < LIGHTS; ++i) {
        lmb_light *l = &many_light[i];
        l->kind = LMB_LIGHT_POINT;
        l->position.x = (float)(test_random(&r) % 200u) * 0.01f - 1.0f;
        l->position.y = (float)(test_random(&r) % 140u) * 0.01f - 0.4f;
        l->position.z = (float)(test_random(&r) % 200u) * 0.01f - 1.0f;
        for (int c = 0; c < 3; ++c) {
            l->intensity[c] = (float)(1 + test_random(&r) % 9u) * 0.1f;
            sum[c] += l->intensity[c];
        }
    }
    CHECK(lmb_many_lights_init(out, CELLS, vec3(-2, -2, -2), vec3(2, 2, 2), 200.0f, memory, bytes) == LMB_OK);
    CHECK(lmb_many_lights_add(out, many_light, LIGHTS) == LMB_OK && lmb_many_lights_build(out) == LMB_OK);
    return memory;
}

/* Lights without maps: at one place per element, the elements collect 4 pi of the summed intensities. Other pieces give
 * the same bytes. */
static void takes_many_lights(const lmb_transfer *t)
{
    static lmb_many_lights_scratch cut;
    static lmb_tile tile;
    lmb_irradiance fresh;
    lmb_many_lights many;
    lmb_bvh bvh;
    float sum[3];
    const size_t bvh_bytes = lmb_bvh_bytes(lmb_scene_triangles(&world.scene));
    void *memory = make_many_lights(&many, sum), *bvh_memory = malloc(bvh_bytes);
    CHECK(lmb_bvh_init(&bvh, lmb_scene_triangles(&world.scene), bvh_memory, bvh_bytes) == LMB_OK);
    CHECK(lmb_bvh_build(&bvh, &world.scene) == LMB_OK);
    const lmb_many_lights_query query = {&many, &bvh, 0.001f, 1, 0, NULL};
    const lmb_element_scratch own = {picked_kernels(), NULL, &tile, NULL, &fresh};
    const uint32_t elements = t->count[LMB_TRANSFER_AREAS];
    const int32_t tiles = lmb_transfer_tiles(t);
    lit l = lit_by(t, &world.scene), again = lit_by(t, &world.scene);
    CHECK(l.light.place == NULL && tiles == 4);
    CHECK(lmb_transfer_many_lights(&l.light, &own, &cut, t, &query, 0, tiles) == LMB_ERR_ARG);
    l.light.place = malloc(elements * sizeof *l.light.place);
    again.light.place = l.light.place;
    CHECK(lmb_transfer_materials(&l.light, t, &world.scene) == LMB_OK);
    CHECK(lmb_transfer_many_lights(&l.light, &own, &cut, t, &query, 0, tiles) == LMB_OK);
    for (int c = 0; c < 3; ++c) {
        const double want = 4.0 * PI * (double)sum[c], got = sum_of(&l, c);
        CHECK_MSG(fabs(got / want - 1.0) < 0.03, "%g W of %g", got, want);
    }
    for (int32_t i = tiles; i-- > 0;) {
        CHECK(lmb_transfer_many_lights(&again.light, &own, &cut, t, &query, i, i + 1) == LMB_OK);
    }
    CHECK(memcmp(l.light.power, again.light.power, elements * sizeof *l.light.power) == 0);
    CHECK(lmb_transfer_many_lights(&l.light, &own, &cut, t, &query, 0, tiles + 1) == LMB_ERR_ARG);
    CHECK(lmb_transfer_many_lights(&l.light, &own, &cut, t, NULL, 0, 1) == LMB_ERR_ARG);
    free(l.light.place);
    free(l.memory);
    free(again.memory);
    free(memory);
    free(bvh_memory);
}

enum { STEPS = 64 };

/* Largest change of an element's light between lights `steps` apart, relative to the total. */
static double largest_change(float (*power)[3], size_t elements, int steps, double all)
{
    double largest = 0.0;
    for (size_t i = 0; i < (size_t)(STEPS - steps) * elements; ++i) {
        largest = fmax(largest, fabs((double)power[i + (size_t)steps * elements][0] - (double)power[i][0]));
    }
    return largest / all;
}

/* A spot moves 6 mm in 64 steps: small steps change an element's light little. Half the step reduces the largest change
 * to 0.6 or less. */
static void moves_steadily(const lmb_transfer *t)
{
    const lmb_light before = box_light;
    const size_t elements = t->count[LMB_TRANSFER_AREAS];
    float(*power)[3] = malloc(STEPS * elements * sizeof *power);
    lit l = lit_by(t, &world.scene);
    double all = 0.0;
    CHECK(power != NULL);
    for (int i = 0; i < STEPS && power != NULL; ++i) {
        box_light = spot(vec3(-0.6f + 0.006f * (float)i / STEPS, 1.2f, 0.25f), vec3(0, -1, 0), 25.0, 40.0);
        const lmb_shadow_map map = draw_map(&world.scene);
        CHECK(lmb_transfer_clear(&l.light, t) == LMB_OK);
        collect(&l, &map, 4, MAP);
        memcpy(power + (size_t)i * elements, l.light.power, elements * sizeof *power);
        all = sum_of(&l, 0);
    }
    double last = power != NULL ? largest_change(power, elements, 32, all) : 0.0;
    CHECK(last > 0.0);
    for (int steps = 16; steps > 0 && power != NULL; steps /= 2) {
        const double now = largest_change(power, elements, steps, all);
        CHECK_MSG(now < 0.6 * last, "%d steps: an element's light changes by %g, by %g in twice as many", steps, now,
                  last);
        last = now;
    }
    free(power);
    free(l.memory);
    box_light = before;
}

/* A light `times` as strong gives `times` the result everywhere, up to the step in which nodes send. */
static void is_linear(const lmb_transfer *t, const lmb_scene *scene, float times)
{
    const lmb_light before = scene->lights[0];
    const lmb_shadow_map map = draw_map(scene);
    lit once = lit_by(t, scene), more = lit_by(t, scene);
    lmb_light strong = before;
    float worst = 0.0f, max = 0.0f;
    for (int c = 0; c < 3; ++c) {
        strong.intensity[c] *= times;
    }
    collect(&once, &map, 1, MAP);
    CHECK(lmb_transfer_collect(&more.light, picked_kernels(), &scratch, t, scene, &strong, &map, 0, 1, 0, MAP) ==
          LMB_OK);
    receive(&once, 1u << 20);
    receive(&more, 1u << 20);
    for (uint32_t i = 0; i < 3 * t->count[LMB_TRANSFER_RECEIVERS]; ++i) {
        const float a = once.light.receiver[i / 3][i % 3], b = more.light.receiver[i / 3][i % 3];
        worst = maxf(worst, absf(times * a - b));
        max = maxf(max, b);
    }
    CHECK_MSG(max > 0.0f && worst <= 2.0f * more.light.step, "off by %g of %g, a step is %g", (double)worst,
              (double)max, (double)more.light.step);
    free(once.memory);
    free(more.memory);
}

enum { PASSES = 5, ALL = 64 };

static const double FURNACE = 2.0 / 0.3; /* e / (1 - albedo), W/m2 */

/* All surfaces of a closed room have equal emission and albedo, without lights: the same amount arrives everywhere. */
static lit furnace_of(const lmb_transfer *t)
{
    for (int k = 0; k < 2; ++k) {
        world.material[k].emission[0] = 2.0f / LMB_PI;
    }
    lit l = lit_by(t, &world.scene);
    for (int pass = 0; pass < PASSES; ++pass) {
        CHECK(lmb_transfer_bounce(&l.light, t, pass < 2 ? pass : LMB_TRANSFER_SEND_RECEIVED) == LMB_OK);
    }
    CHECK(lmb_transfer_rest(&l.light, t, LMB_TRANSFER_SEND_RECEIVED, ALL) == LMB_OK);
    receive(&l, 1u << 20);
    return l;
}

static void furnace(void)
{
    lmb_transfer t;
    double sum = 0.0, area = 0.0;
    make_box(-0.6f);
    file_bytes baked = bake_box(2, 0);
    CHECK(lmb_transfer_open(&t, baked.data, baked.size) == LMB_OK);
    lit l = furnace_of(&t);
    for (uint32_t i = 0; i < t.count[LMB_TRANSFER_AREAS]; ++i) {
        float own;
        memcpy(&own, t.section[LMB_TRANSFER_AREAS] + i, sizeof own);
        sum += (double)(own * (l.light.albedo[i][0] * l.light.coarse[i].all[0] + l.light.emission[i][0]));
        area += (double)own;
    }
    CHECK_MSG(fabs(sum / area / FURNACE - 1.0) < 0.03, "%g W/m2, not %g", sum / area, FURNACE);
    sum = 0.0;
    for (uint32_t i = 0; i < t.count[LMB_TRANSFER_RECEIVERS]; ++i) {
        sum += (double)l.light.receiver[i][0];
    }
    sum /= (double)t.count[LMB_TRANSFER_RECEIVERS];
    CHECK_MSG(fabs(sum / FURNACE - 1.0) < 0.03, "%g W/m2 arrive, not %g", sum, FURNACE);
    free(l.memory);
    file_free(&baked);
}

/* --- light by direction ------------------------------------------------------------------------------------------- */

enum { WALLS = 12 }; /* triangles of the room */

/* Normals tilted from a wall by up to 45 degrees, in all directions. */
static void make_turned(lmb_tile *tile, uint32_t id, lmb_vec3 at, lmb_vec3 wall)
{
    const lmb_vec3 right = cross3(wall, absf(wall.y) < 0.5f ? Y : X), up = cross3(right, wall);
    memset(tile, 0, sizeof *tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const double turn = PI / 180.0 * 9.0 * (k / 8 % 6), around = 2.0 * PI / 8.0 * (k % 8);
        const lmb_vec3 side = add3(mul3(right, (float)cos(around)), mul3(up, (float)sin(around)));
        pixel(tile, k, id, at, wall);
        set_plane(tile->normal, k, add3(mul3(wall, (float)cos(turn)), mul3(side, (float)sin(turn))));
    }
}

/* In the furnace, half of the hemisphere that a tilted normal loses is lit: the closed form is (1 + cosine) / 2 of the
 * light. Without directions the result would be 1, with the light's sum only the cosine. */
static void turned_in_furnace(const lmb_transfer *t, const lmb_tile *tile)
{
    lmb_irradiance out;
    lit l = furnace_of(t);
    memset(&out, 0, sizeof out);
    memset(&scratch, 0, sizeof scratch);
    CHECK(lmb_transfer_tile(&out, NULL, picked_kernels(), &scratch, &l.light, t, &world.scene, tile) == LMB_OK);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const double want = FURNACE * (0.5 + 0.5 * (double)dot3(tile_vec(tile->normal, k), tile_vec(tile->face, k)));
        CHECK_MSG(fabs((double)out.rgb[0][k] / want - 1.0) < 0.04, "pixel %d: %g, not %g", k, (double)out.rgb[0][k],
                  want);
    }
    free(l.memory);
}

/* The form factors of a triangle along three axes, computed together, equal those along both directions of each axis,
 * even if the triangle crosses the horizon. */
static void factors_at_once(void)
{
    static const lmb_vec3 corner[3] = {{0.5f, 0.25f, 2.0f}, {-1.0f, 1.5f, 1.0f}, {0.25f, -1.0f, 1.5f}};
    const lmb_vec3 at = vec3(0.125f, 0.25f, -0.5f), out = normalize3(cross3(sub3(corner[1], corner[0]), sub3(corner[2], corner[0])));
    const lmb_vec3 axis = dot3(out, sub3(at, corner[0])) > 0.0f ? out : mul3(out, -1.0f);
    const int is_turned = axis.x != out.x;
    const lmb_vec3 round[3] = {corner[0], corner[is_turned ? 2 : 1], corner[is_turned ? 1 : 2]};
    const lmb_vec3 faces[] = {{0, 0, 1}, {0.6f, 0, 0.8f}, {1, 0, 0}, {0, -0.8f, 0.6f}};
    for (size_t i = 0; i < sizeof faces / sizeof faces[0]; ++i) {
        const lmb_vec3 all = lmb_triangle_vector(at, faces[i], round, axis);
        const float own[3] = {all.x, all.y, all.z};
        CHECK(dot3(all, all) > 0.0f);
        for (int k = 0; k < 3; ++k) {
            const lmb_vec3 along = vec3(k == 0, k == 1, k == 2);
            const float one = lmb_polygon_factor(at, faces[i], along, round, 3, axis) -
                              lmb_polygon_factor(at, faces[i], mul3(along, -1.0f), round, 3, axis);
            CHECK_MSG(fabsf(own[k] - one) < 1e-7f, "face %d, axis %d: %g, not %g", (int)i, k, (double)own[k], (double)one);
        }
    }
    CHECK(lmb_polygon_factor(at, faces[0], faces[0], round, 3, mul3(axis, -1.0f)) == 0.0f &&
          lmb_triangle_vector(at, faces[0], round, mul3(axis, -1.0f)).z == 0.0f); /* the back */
}

/* Form factor of the block's triangles that face the place, to a plane with this normal. */
static float block_factor(lmb_vec3 at, lmb_vec3 face, lmb_vec3 normal, lmb_vec3 middle)
{
    float sum = 0.0f;
    for (uint32_t id = WALLS + 1; id <= 2 * WALLS; ++id) {
        lmb_triangle t;
        lmb_vec3 out = {0.0f, 0.0f, 0.0f};
        float area;
        CHECK(lmb_triangle_fetch(&t, &world.scene, id) && lmb_triangle_shape(&out, &area, &t));
        const int is_inward = dot3(out, sub3(t.corner[0], middle)) < 0.0f;
        const lmb_vec3 corner[3] = {t.corner[0], t.corner[is_inward ? 2 : 1], t.corner[is_inward ? 1 : 2]};
        out = is_inward ? mul3(out, -1.0f) : out;
        if (dot3(out, sub3(at, t.corner[0])) > 0.0f) {
            sum += lmb_polygon_factor(at, face, normal, corner, 3, out);
        }
    }
    return sum;
}

/* Only the block emits: its light on normals that tilt towards it and away, in closed form. Lobes receive all of the
 * light from one direction. */
static void turned_to_block(const lmb_transfer *t, const lmb_tile *tile, lmb_vec3 middle)
{
    static lmb_glossy glossy, one;
    lmb_irradiance out;
    const lmb_vec3 at = tile_vec(tile->position, 0), face = tile_vec(tile->face, 0);
    world.material[0].emission[0] = 0.0f;
    lit l = lit_by(t, &world.scene);
    receive(&l, 1u << 20);
    memset(&out, 0, sizeof out);
    memset(&scratch, 0, sizeof scratch);
    memset(&glossy, 0, sizeof glossy);
    glossy.pixels = 3;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        glossy.specular[0][k] = glossy.facing[k] = glossy.towards[0][k] = 1.0f;
        glossy.alpha2[k] = 0.1f;
    }
    one = glossy;
    CHECK(lmb_transfer_tile(&out, &glossy, picked_kernels(), &scratch, &l.light, t, &world.scene, tile) == LMB_OK);
    const float flat = 2.0f * block_factor(at, face, face, middle);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const lmb_vec3 n = tile_vec(tile->normal, k);
        const float want = 2.0f * block_factor(at, face, n, middle) + 0.5f * (1.0f - dot3(n, face)) * flat;
        CHECK_MSG(flat > 0.01f && is_near(out.rgb[0][k], want, 0.1f * flat), "pixel %d: %g, not %g (%g)", k,
                  (double)out.rgb[0][k], (double)want, (double)flat);
    }
    lmb_glossy_add(&one, tile, 0, sub3(middle, at), 1.0f, vec3(out.rgb[0][0], 0.0f, 0.0f));
    CHECK_MSG(one.rgb[0][0] > 0.0f && fabs((double)(glossy.rgb[0][0] / one.rgb[0][0]) - 1.0) < 0.1, "%g, not %g",
              (double)glossy.rgb[0][0], (double)one.rgb[0][0]);
    CHECK(glossy.rgb[0][1] > 0.0f && glossy.rgb[0][2] == 0.0f);
    free(l.memory);
}

/* Walls with a lobe and a block without. */
static void directed_box(void)
{
    static lmb_tile tile;
    const lmb_vec3 at = vec3(-1.5f, 0.6f, 0.35f), middle = vec3(0.4f, -0.6f, 0.2f);
    lmb_transfer t;
    make_box(-0.6f);
    file_bytes plain = bake_box(2, 0);
    world.material[0].specular[0] = 0.04f;
    file_bytes one = bake_box(1, 0), baked = bake_box(2, 0);
    CHECK(one.size == baked.size && memcmp(one.data, baked.data, one.size) == 0);
    is_pinned("walls with a lobe", &one, 0x589722bdf79643e8u);
    CHECK(lmb_transfer_open(&t, plain.data, plain.size) == LMB_OK && t.count[LMB_TRANSFER_CLUSTERS] == 0);
    const uint32_t receivers = t.count[LMB_TRANSFER_RECEIVERS], corners = t.count[LMB_TRANSFER_CORNERS];
    CHECK(lmb_transfer_open(&t, baked.data, baked.size) == LMB_OK);
    CHECK(t.count[LMB_TRANSFER_RECEIVERS] > 0 && t.count[LMB_TRANSFER_CLUSTERS] > 0 && t.leaves > 0);
    CHECK(t.count[LMB_TRANSFER_RECEIVERS] + t.count[LMB_TRANSFER_CLUSTERS] == receivers);
    CHECK(t.count[LMB_TRANSFER_CORNERS] == corners && t.leaves < corners);
    uint32_t id = 1;
    for (; id < WALLS; ++id) { /* the first wall half whose bounding box contains the place */
        lmb_triangle own;
        CHECK(lmb_triangle_fetch(&own, &world.scene, id));
        const lmb_vec3 a = sub3(own.corner[1], own.corner[0]), b = sub3(own.corner[2], own.corner[0]),
                       p = sub3(at, own.corner[0]);
        const lmb_vec3 n = cross3(a, b);
        const float b1 = dot3(cross3(p, b), n) / dot3(n, n), b2 = dot3(cross3(a, p), n) / dot3(n, n);
        if (absf(dot3(p, n)) < 1e-4f && b1 >= 0.0f && b2 >= 0.0f && b1 + b2 <= 1.0f) {
            break;
        }
    }
    make_turned(&tile, id, at, X);
    turned_in_furnace(&t, &tile);
    turned_to_block(&t, &tile, middle);
    file_free(&plain);
    file_free(&one);
    file_free(&baked);
}

/* At a grid place, each normal along an axis uses the receiver of that side. */
static void by_side(lit *l)
{
    static lmb_tile tile;
    const uint32_t *grid = l->t->section[LMB_TRANSFER_GRID], *air = l->t->section[LMB_TRANSFER_AIR];
    uint32_t place = 0;
    lmb_irradiance out;
    float low[3], per;
    while (air[place] == LMB_TRANSFER_NONE) {
        ++place;
    }
    memcpy(low, grid, sizeof low);
    memcpy(&per, grid + 3, sizeof per);
    const lmb_vec3 at = vec3(low[0] + (float)(place % grid[4]) / per, low[1] + (float)(place / grid[4] % grid[5]) / per,
                             low[2] + (float)(place / grid[4] / grid[5]) / per);
    memset(&tile, 0, sizeof tile);
    memset(&out, 0, sizeof out);
    for (int k = 0; k < LMB_TRANSFER_AIR_RECEIVERS; ++k) {
        const float sign = k % 2 ? -1.0f : 1.0f;
        l->light.receiver[air[place] + (uint32_t)k][0] = 100.0f * (float)(k + 1);
        pixel(&tile, k, 13, at, vec3(k / 2 == 0 ? sign : 0.0f, k / 2 == 1 ? sign : 0.0f, k / 2 == 2 ? sign : 0.0f));
    }
    memset(&scratch, 0, sizeof scratch);
    CHECK(lmb_transfer_tile(&out, NULL, picked_kernels(), &scratch, &l->light, l->t, l->scene, &tile) == LMB_OK);
    for (int k = 0; k < LMB_TRANSFER_AIR_RECEIVERS; ++k) {
        CHECK_MSG(is_near(out.rgb[0][k], 100.0f * (float)(k + 1), 0.1f), "side %d: %g", k, (double)out.rgb[0][k]);
    }
}

/* The file fits the scene wherever the block is, and the block is lit on all sides. */
static void moving_block(const file_bytes *baked)
{
    static lmb_tile tile;
    lmb_irradiance out;
    lmb_transfer t;
    make_box(-0.6f);
    CHECK(lmb_transfer_open(&t, baked->data, baked->size) == LMB_OK);
    is_pinned("a block that moves", baked, 0xa2a8be8655226c47u);
    CHECK(t.count[LMB_TRANSFER_MOVING] == 1 && t.count[LMB_TRANSFER_GRID] == 1 && t.count[LMB_TRANSFER_AIR] > 500);
    CHECK(t.section[LMB_TRANSFER_MOVING][0] == 13 && t.section[LMB_TRANSFER_MOVING][1] == 25);
    CHECK(lmb_transfer_fits(&t, &world.scene) == LMB_OK);
    world.instance[1].to_world.m[12] = 0.5f;
    CHECK(lmb_transfer_fits(&t, &world.scene) == LMB_OK);
    world.instance[0].to_world.m[12] = 0.5f;
    CHECK(lmb_transfer_fits(&t, &world.scene) == LMB_ERR_SCENE);
    world.instance[0].to_world.m[12] = 0.0f;
    lit l = furnace_of(&t);
    memset(&tile, 0, sizeof tile);
    memset(&out, 0, sizeof out);
    memset(&scratch, 0, sizeof scratch);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) { /* across the room and beyond */
        const lmb_vec3 n = normalize3(vec3((float)(k % 7) - 3.0f, (float)(k % 5) - 2.0f, (float)(k % 3) - 0.9f));
        pixel(&tile, k, 13 + (uint32_t)k % 12,
              vec3(0.5f * (float)(k % 4) - 0.8f, 0.5f * (float)(k / 4 % 4) - 0.8f, (float)(k / 16) - 1.7f), n);
    }
    CHECK(lmb_transfer_tile(&out, NULL, picked_kernels(), &scratch, &l.light, &t, &world.scene, &tile) == LMB_OK);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        CHECK_MSG(fabs((double)out.rgb[0][k] / FURNACE - 1.0) < 0.04, "%d: %g, not %g", k, (double)out.rgb[0][k],
                  FURNACE);
    }
    by_side(&l);
    free(l.memory);
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static lmb_render render;
static float picture[2][FRAME * FRAME * 3];

typedef struct framed {
    lmb_frame frame;
    void *memory;
} framed;

/* many: lights without maps, or NULL. */
static framed frame_with(const lmb_transfer *t, const lmb_scene *scene, int which, const lmb_many_lights *many,
                         int32_t map)
{
    framed f;
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    memset(picture[which], 0x3c, sizeof picture[which]);
    s.kernels = picked_kernels();
    s.scene = scene;
    s.transfer = t;
    s.view = look(vec3(-1.2f, 0.4f, -1.2f), vec3(0.4f, -0.8f, 0.4f), 80, FRAME);
    s.show = LMB_SHOW_INDIRECT;
    s.shadow_map = map;
    s.many_lights = many;
    CHECK(lmb_surface_init(&s.out, LMB_RGB32F, FRAME, FRAME, picture[which], sizeof picture[which]) == LMB_OK);
    const size_t bytes = lmb_frame_bytes(&s);
    f.memory = malloc(bytes);
    CHECK(bytes > 0 && lmb_frame_init(&f.frame, &s, f.memory, bytes) == LMB_OK);
    return f;
}

static framed frame_of(const lmb_transfer *t, const lmb_scene *scene, int which)
{
    return frame_with(t, scene, which, NULL, MAP);
}

static int is_same_picture(void) { return memcmp(picture[0], picture[1], sizeof picture[0]) == 0; }

static void draws_frames(const lmb_transfer *t, const lmb_scene *scene)
{
    static const int32_t units[] = {1, 3, 1000000};
    framed f = frame_of(t, scene, 0);
    double sum = 0.0;
    CHECK(lmb_render_frame(&render, &f.frame) == LMB_OK);
    for (int i = 0; i < FRAME * FRAME * 3; ++i) {
        CHECK(picture[0][i] >= 0.0f || !"a pixel under 0");
        sum += (double)picture[0][i];
    }
    CHECK(sum > 0.0);
    free(f.memory);
    f = frame_of(t, scene, 1); /* baked light is not gathered at single points */
    f.frame.gather_step = LMB_GATHER_LIVE;
    CHECK(lmb_render_frame(&render, &f.frame) == LMB_OK && is_same_picture());
    free(f.memory);
    for (int i = 0; i < COUNT(units); ++i) {
        f = frame_of(t, scene, 1);
        lmb_status status = lmb_render_begin(&render, &f.frame);
        CHECK(status == LMB_OK);
        while ((status = lmb_render_step(&render, units[i])) == LMB_MORE) {
        }
        CHECK_MSG(status == LMB_OK && is_same_picture(), "steps of %d", (int)units[i]);
        free(f.memory);
    }
    f = frame_of(t, scene, 1);
    CHECK(lmb_render_begin(&render, &f.frame) == LMB_OK);
    while (render.stage < LMB_STAGE_BANDS && lmb_render_step(&render, 7) == LMB_MORE) {
    }
    CHECK(render.stage == LMB_STAGE_BANDS);
    for (int32_t band = FRAME / LMB_TILE - 1; band >= 0; --band) {
        CHECK(lmb_render_band(&render, render.frame.scratch, &render.frame.eye, &render.frame.out, band) == LMB_OK);
    }
    CHECK(is_same_picture());
    free(f.memory);
}

#if LMB_PLAN
/* A plan counts the memory of baked light, and of the elements' places if the lights have no maps. */
static void plans_places(const lmb_transfer *t)
{
    static lmb_plan plan;
    lmb_transfer_place *kept = render.frame.transfer_light.place;
    uint64_t bytes[2];
    for (int i = 0; i < 2; ++i) {
        render.frame.transfer_light.place = i == 0 ? kept : NULL;
        CHECK(lmb_plan_frame(&plan, &render, 0.0, 0.0) == LMB_OK);
        bytes[i] = plan.row[LMB_PLAN_POINTS].bytes;
    }
    render.frame.transfer_light.place = kept;
    CHECK(kept != NULL && bytes[0] - bytes[1] == (uint64_t)t->count[LMB_TRANSFER_AREAS] * sizeof *kept);
    CHECK(bytes[1] >= lmb_transfer_light_bytes(t));
}
#else
static void plans_places(const lmb_transfer *t) { (void)t; }
#endif

/* Frames of lights without maps: the elements collect 4 pi of the summed intensities, and the bounced light is the same
 * in steps of any size. In each step the progress of the bounces grows. */
static void draws_many_lights(const lmb_transfer *t)
{
    lmb_many_lights many;
    float sum[3];
    void *memory = make_many_lights(&many, sum);
    world.scene.light_count = 0;
    framed whole = frame_with(t, &world.scene, 0, &many, MAP), steps = frame_with(t, &world.scene, 1, &many, MAP);
    CHECK(lmb_render_frame(&render, &whole.frame) == LMB_OK);
    const lit l = {t, &world.scene, NULL, 0, whole.frame.transfer_light};
    for (int c = 0; c < 3; ++c) {
        const double want = 4.0 * PI * (double)sum[c], got = sum_of(&l, c);
        CHECK_MSG(fabs(got / want - 1.0) < 0.05, "%g W of %g", got, want);
    }
    lmb_status status = lmb_render_begin(&render, &steps.frame);
    plans_places(t);
    int rises = 0, falls = 0;
    float before = 0.0f;
    while (status == LMB_OK || status == LMB_MORE) {
        status = lmb_render_step(&render, 1);
        const float now = lmb_render_progress(NULL, &render);
        if (render.stage == LMB_STAGE_BOUNCES) {
            rises += now > before;
            falls += now < before || now > 1.0f;
            before = now;
        }
        if (status == LMB_OK) {
            break;
        }
    }
    CHECK_MSG(status == LMB_OK && rises > 1 && falls == 0 && is_same_picture(), "%d rises, %d falls", rises, falls);
    free(whole.memory);
    free(steps.memory);
    free(memory);
    world.scene.light_count = 1;
}

/* Elements collect one texel in two by two of a map of 512, and all of a map of 256. */
static void collects_some_texels(void)
{
    const lmb_transfer t = open_small();
    for (int32_t side = 256; side <= 512; side *= 2) {
        framed f = frame_with(&t, &room.scene, 0, NULL, side);
        CHECK(lmb_render_frame(&render, &f.frame) == LMB_OK);
        for (int32_t each = 1; each <= 4; each *= 2) {
            lit l = lit_by(&t, &room.scene);
            memset(&scratch, 0, sizeof scratch);
            CHECK(lmb_transfer_collect(&l.light, picked_kernels(), &scratch, &t, &room.scene, &room.light,
                                       &render.maps[0], 0, each, 0, side / each) == LMB_OK);
            const int same = memcmp(l.light.power, f.frame.transfer_light.power,
                                    t.count[LMB_TRANSFER_AREAS] * sizeof *l.light.power) == 0;
            CHECK_MSG(same == (each == side / 256), "map of %d, each %d", (int)side, (int)each);
            free(l.memory);
        }
        free(f.memory);
    }
}

/* Hashes of a picture with three reflections, and of the elements' light for blocks of texels. */
static void draws_pinned(const char *name, const lmb_transfer *t, const lmb_scene *scene, uint64_t frame,
                         uint64_t light)
{
    framed f = frame_of(t, scene, 0);
    const lmb_shadow_map map = draw_map(scene);
    lit l = lit_by(t, scene);
    uint64_t hash = HASH_BEGIN;
    f.frame.bounces = 3;
    CHECK(lmb_render_frame(&render, &f.frame) == LMB_OK);
    CHECK_MSG((hash = hash_words(hash, picture[0], FRAME * FRAME * 3)) == frame, "%s is drawn as 0x%016llx", name,
              (unsigned long long)hash);
    hash = HASH_BEGIN;
    for (int32_t each = 1; each <= 16; each *= 2) {
        CHECK(lmb_transfer_clear(&l.light, t) == LMB_OK);
        collect(&l, &map, each, MAP);
        hash = hash_words(hash, l.light.power, 3 * (size_t)t->count[LMB_TRANSFER_AREAS]);
    }
    CHECK_MSG(hash == light, "%s gets light 0x%016llx", name, (unsigned long long)hash);
    free(f.memory);
    free(l.memory);
}

/* The state that lmb_transfer_tile keeps between tiles changes nothing: a picture's tiles with one scratch and with new
 * ones, on each backend. */
static void draws_tiles(const lmb_transfer *t, const lmb_scene *scene)
{
    enum { TILES = FRAME / LMB_TILE };
    static lmb_transfer_scratch fresh;
    static lmb_irradiance want[TILES * TILES], got;
    static lmb_tile tile;
    const lmb_kernels *kernels;
    framed f = frame_of(t, scene, 0);
    double sum = 0.0;
    CHECK(lmb_render_frame(&render, &f.frame) == LMB_OK);
    memset(want, 0, sizeof want);
    for (int32_t b = 0; (kernels = lmb_kernels_at(b)) != NULL; ++b) {
        memset(&scratch, 0, sizeof scratch);
        for (int32_t i = 0; i < TILES * TILES; ++i) {
            const int32_t at = i * 7 % (TILES * TILES); /* not in order */
            CHECK(lmb_resolve_tile(&tile, kernels, &f.frame.view, scene, &f.frame.eye, at % TILES * LMB_TILE,
                                   at / TILES * LMB_TILE) == LMB_OK);
            memset(&fresh, 0, sizeof fresh);
            memset(&got, 0, sizeof got);
            if (b == 0) {
                CHECK(lmb_transfer_tile(&want[at], NULL, kernels, &fresh, &f.frame.transfer_light, t, scene, &tile) ==
                      LMB_OK);
                sum += (double)want[at].rgb[0][LMB_TILE_PIXELS / 2];
            }
            CHECK(lmb_transfer_tile(&got, NULL, kernels, &scratch, &f.frame.transfer_light, t, scene, &tile) == LMB_OK);
            CHECK_MSG(memcmp(&got, &want[at], sizeof got) == 0, "tile %d by %s", (int)at, lmb_kernels_name(kernels));
        }
    }
    CHECK(sum > 0.0);
    free(f.memory);
}

/* --- whatever was drawn before ------------------------------------------------------------------------------------ */

enum { MOMENTS = 8, NOISE = 0x3c };

static float cold[MOMENTS][FRAME * FRAME * 3];
static lmb_band_scratch scratches[MOST_THREADS];

/* Leftovers of a frame of another scene: ids of this scene's triangles at other places. */
static void spoil_scratches(void)
{
    memset(scratches, NOISE, sizeof scratches);
    for (int i = 0; i < MOST_THREADS; ++i) {
        for (uint32_t k = 0; k < LMB_TRANSFER_KEPT; ++k) {
            scratches[i].gather.transfer.met.kept.id[k] = k > 0 ? k : LMB_TRANSFER_KEPT;
        }
    }
}

/* Each bit of `k` changes something: bit 0 the light, bit 1 the viewer, bit 2 the block's place and the number of
 * reflections. Unchanged parts keep their revision. */
static void set_moment(lmb_frame *f, int k)
{
    const lmb_vec3 lamp = k & 1 ? vec3(0.6f, 0.9f, -0.4f) : vec3(-0.5f, 1.2f, 0.3f);
    const float block = k & 4 ? 0.0f : -0.7f;
    if (box_light.position.x != lamp.x) {
        box_light.position = lamp;
        ++box_light.revision;
    }
    if (world.instance[1].to_world.m[12] != block) {
        world.instance[1].to_world.m[12] = block;
        ++world.scene.revision;
    }
    f->view = k & 2 ? look(vec3(1.1f, 0.9f, 1.2f), vec3(-0.2f, -1.0f, 0), 70, FRAME)
                    : look(vec3(-1.2f, 0.4f, -1.2f), vec3(0.4f, -0.8f, 0.4f), 80, FRAME);
    f->bounces = k & 4 ? 3 : 1;
}

static void is_as_cold(framed *f, int k, const reuse_way *by, int before)
{
    memset(picture[0], NOISE, sizeof picture[0]);
    set_moment(&f->frame, k);
    CHECK(reused_frame(&render, &f->frame, by) == LMB_OK);
    CHECK_MSG(memcmp(picture[0], cold[k], sizeof cold[k]) == 0, "moment %d after %d by %d rows, %d threads", k, before,
              (int)by->rows, by->threads);
}

static void draw_cold(const lmb_transfer *t)
{
    for (int k = 0; k < MOMENTS; ++k) {
        framed f = frame_of(t, &world.scene, 0);
        set_moment(&f.frame, k);
        CHECK(lmb_render_frame(&render, &f.frame) == LMB_OK);
        memcpy(cold[k], picture[0], sizeof cold[k]);
        for (int i = 0; i < k; ++i) {
            CHECK_MSG(memcmp(cold[k], cold[i], sizeof cold[k]) != 0, "moments %d and %d", i, k);
        }
        free(f.memory);
    }
}

/* In each way, in reverse order. */
static void any_way(framed *f)
{
    static const reuse_way ways[] = {REUSED_WAYS(FRAME)};
    for (int i = 0; i < COUNT(ways); ++i) {
        f->frame.eye.depth.height = f->frame.eye.id.height = ways[i].rows;
        for (int k = MOMENTS - 1; k >= 0; --k) {
            spoil_scratches();
            is_as_cold(f, k, &ways[i], k + 1);
        }
    }
}

/* A frame has the same bytes whatever frame came before it in the same memory. */
static void any_history(const file_bytes *baked)
{
    static const reuse_way whole = {FRAME, 0};
    lmb_transfer t;
    make_box(-0.6f);
    CHECK(lmb_transfer_open(&t, baked->data, baked->size) == LMB_OK);
    draws_pinned("a block that moves", &t, &world.scene, 0x3626cace31f5efd8u, 0xb0bdbacff342fd01u);
    draw_cold(&t);
    framed f = frame_of(&t, &world.scene, 0);
    f.frame.scratch = scratches; /* each frame finds the leftovers of the one before */
    memset(&render, 0, sizeof render);
    for (int i = 0; i < MOMENTS * MOMENTS; ++i) {
        is_as_cold(&f, i / MOMENTS, &whole, i % MOMENTS);
        is_as_cold(&f, i % MOMENTS, &whole, i / MOMENTS);
    }
    any_way(&f);
    free(f.memory);
}

/* One file for all tests, because baking takes longer than they do. */
static void block_that_moves(void)
{
    make_box(-0.6f);
    file_bytes baked = bake_box(2, 1);
    moving_block(&baked);
    any_history(&baked);
    file_free(&baked);
}

/* Walls with a lobe store light by direction. */
static void draws_directed(void)
{
    lmb_transfer t;
    make_box(-0.6f);
    world.material[0].specular[0] = 0.04f;
    file_bytes baked = bake_box(2, 0);
    CHECK(lmb_transfer_open(&t, baked.data, baked.size) == LMB_OK);
    draws_pinned("walls with a lobe", &t, &world.scene, 0xbe7a4219c97c5956u, 0x8573165df04f2f10u);
    file_free(&baked);
}

/* --- the box ------------------------------------------------------------------------------------------------------ */

/* New materials need no new file. */
static void takes_materials(const lmb_transfer *t)
{
    lit l = lit_by(t, &world.scene);
    CHECK(is_near(l.light.albedo[0][0], 0.7f, 1e-5f) && is_near(l.light.albedo[0][2], 0.3f, 1e-5f));
    world.material[0].albedo[0] = world.material[1].albedo[0] = 0.1f;
    CHECK(lmb_transfer_fits(t, &world.scene) == LMB_OK);
    CHECK(lmb_transfer_materials(&l.light, t, &world.scene) == LMB_OK);
    CHECK(is_near(l.light.albedo[0][0], 0.1f, 1e-5f) && l.light.power[0][0] == 0.0f);
    world.material[0].albedo[0] = world.material[1].albedo[0] = 0.7f;
    free(l.memory);
}

static void test_box(void)
{
    lmb_transfer t;
    make_box(-1.2f); /* the block stands on the floor */
    file_bytes one = bake_box(1, 0), two = bake_box(2, 0);
    CHECK(one.size == two.size && one.size > 0 && memcmp(one.data, two.data, one.size) == 0);
    is_pinned("a box with a block on its floor", &one, 0x3f0d90b0ed8ed134u);
    CHECK(lmb_transfer_open(&t, one.data, one.size) == LMB_OK);
    CHECK(lmb_transfer_fits(&t, &world.scene) == LMB_OK);
    CHECK(t.count[LMB_TRANSFER_AREAS] == 256 && t.count[LMB_TRANSFER_RECEIVERS] > 100);
    is_same_by(&t, &world.scene);
    keeps_power(&t, &world.scene);
    collects_all(&t);
    takes_many_lights(&t);
    moves_steadily(&t);
    is_linear(&t, &world.scene, 2.0f);
    is_linear(&t, &world.scene, 3.7f);
    draws_frames(&t, &world.scene);
    draws_many_lights(&t);
    draws_pinned("a box with a block on its floor", &t, &world.scene, 0x03bdce99b77c0398u, 0x44eef72ca5ffe398u);
    draws_tiles(&t, &world.scene);
    takes_materials(&t);
    world.instance[1].to_world.m[3] = world.instance[1].to_world.m[12] = 0.1f;
    CHECK(lmb_transfer_fits(&t, &world.scene) == LMB_ERR_SCENE);
    file_free(&one);
    file_free(&two);
}

void test_transfer(void)
{
    factors_at_once();
    by_hand();
    again_by_hand();
    emits_by_hand();
    parts_by_area();
    const lmb_transfer t = open_small();
    cut_off();
    bad_header();
    bad_words();
    bad_air();
    last_air();
    shared_halves(200);
    shared_halves(30);
    moves_by_ranges();
    cuts_of_files();
    lit_by_cuts(0.5f);
    lit_by_cuts(0.25f);
    lit_by_cuts(0.9f);
    collected_by_cuts(0.25f);
    collected_by_cuts(0.8f);
    collected_by_wall(0.3f, 4);
    collected_by_wall(0.6f, 8);
    collected_by_wall(0.5f, 1);
    open_small();
    bad_arguments();
    is_same_by(&t, &room.scene);
    keeps_power(&t, &room.scene);
    keeps_to_range(&t);
    keeps_masked_power(&t);
    is_linear(&t, &room.scene, 3.7f);
    collects_some_texels();
    fits();
    test_box();
    furnace();
    directed_box();
    block_that_moves();
    draws_directed();
    bytes_of_buried();
    bytes_of_demo();
    tests_are_few();
}

#else

void test_transfer(void) {}

#endif
