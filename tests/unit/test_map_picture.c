/* test_map_picture.c: pictures of a shadow map by `lambent render --show`: each texel against its ray and flux. */
#include <math.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../src/base/vec.h"
#include "../../tools/common/workers.h"
#include "../../tools/demo/demo_scene.h"
#include "../../tools/picture/grey.h"
#include "../../tools/render/map_picture.h"
#include "../test.h"

void test_map_picture(void);

enum { W = 16, H = 16, MAP = 64, BLOCK = 4, SIDE = MAP / BLOCK, FACES = 7, POINTS = 4 * SIDE * SIDE * FACES };
enum { LIGHTS = LMB_MAX_LIGHTS > 1 ? 2 : 1 };

static struct memory {
    uint32_t owner[FACES * MAP * MAP];
    uint32_t map[FACES * MAP * MAP * 2], depth[W * H], id[W * H];
    float out[W * H * 3];
    lmb_point points[POINTS];
    uint32_t cells[SIDE * SIDE + 1];
    lmb_groups groups;
    lmb_band_scratch scratch;
    lmb_tile tile;
    lmb_render render;
    lmb_stats stats;
} m;

static lmb_light lights[2];
static lmb_scene lit;

/* A point light with six faces, then the demo's spot; only the spot if there is room for one. */
static void set_scene(void)
{
    lit = *demo_scene();
    lights[LIGHTS - 1] = lit.lights[0];
    if (LIGHTS > 1) {
        memset(&lights[0], 0, sizeof lights[0]);
        lights[0].kind = LMB_LIGHT_POINT;
        lights[0].position = vec3(0.4f, 1.6f, 0.3f);
        lights[0].direction = vec3(0, -1, 0);
        lights[0].intensity[0] = lights[0].intensity[1] = lights[0].intensity[2] = 2.0f;
    }
    lit.lights = lights;
    lit.light_count = LIGHTS;
}

static lmb_frame make_frame(void)
{
    lmb_frame f;
    memset(&f, 0, sizeof f);
    f.kernels = picked_kernels();
    f.scene = &lit;
    f.view = demo_view(W, H);
    f.view.near_m = 0.05f;
    f.view.far_m = 20.0f;
    f.shadow_map = MAP;
    f.grouping.block = BLOCK;
    f.grouping.groups = LMB_MAX_GROUPS < 300 ? LMB_MAX_GROUPS : 300;
    f.map_memory = m.map;
    f.map_bytes = sizeof m.map;
    f.points.data = m.points;
    f.points.cap = POINTS;
    f.points.cells = m.cells;
    f.points.cell_cap = SIDE * SIDE + 1;
    f.points.owner = m.owner;
    f.points.owner_cap = FACES * MAP * MAP;
    f.groups = &m.groups;
    f.scratch = &m.scratch;
    memset(&m.stats, 0, sizeof m.stats);
    f.stats = &m.stats;
    lmb_surface_init(&f.eye.depth, LMB_DEPTH32F, W, H, m.depth, sizeof m.depth);
    lmb_surface_init(&f.eye.id, LMB_ID32, W, H, m.id, sizeof m.id);
    lmb_surface_init(&f.out, LMB_RGB32F, W, H, m.out, sizeof m.out);
    return f;
}

static void solve(const lmb_frame *f, int32_t past)
{
    int32_t stage;
    workers c;
    memset(&c, 0, sizeof c);
    c.threads = 1;
    c.scratches = &m.scratch;
    CHECK(workers_light(&c, &stage, &m.render, f, past) == LMB_OK && m.render.stage == past);
}

/* Calls `see` for every texel of every face, with the surface and the power through the texel. */
typedef struct seen {
    const image *picture;
    const float *pixel;
    uint32_t light;
    int32_t face, k; /* of m.tile */
    float power[3];
    int lit; /* some power, and a surface that it meets */
} seen;

static void see_tile(const image *p, uint32_t light, int32_t face, void (*see)(const seen *s))
{
    const lmb_shadow_map *map = &m.render.maps[light];
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const int32_t x = m.tile.x + k % LMB_TILE, y = m.tile.y + k / LMB_TILE;
        seen s = {p, NULL, light, face, k, {0, 0, 0}, 0};
        s.pixel = p->pixels + (((int32_t)light * MAP + y) * p->width + face * MAP + x) * p->channels;
        lmb_light_texel_power(s.power, &lit.lights[light], map, face, x, y);
        s.lit = m.tile.id[k] != 0 && s.power[0] + s.power[1] + s.power[2] > 0.0f;
        see(&s);
    }
}

static void see_all(const image *p, void (*see)(const seen *s))
{
    for (uint32_t i = 0; i < LIGHTS; ++i) {
        const lmb_shadow_map *map = &m.render.maps[i];
        for (int32_t at = 0; at < map->faces * MAP * MAP / 64; ++at) {
            const int32_t face = at / (MAP * MAP / 64), tile = at % (MAP * MAP / 64);
            if ((map->drawn >> face) & 1u) {
                CHECK(lmb_resolve_tile(&m.tile, picked_kernels(), &map->view[face], &lit, &map->face[face],
                                       tile % (MAP / 8) * 8, tile / (MAP / 8) * 8) == LMB_OK);
                see_tile(p, i, face, see);
            }
        }
    }
}

static int has_size(const image *p, int32_t channels)
{
    return p->width == MAP * (LIGHTS > 1 ? 6 : 1) && p->height == MAP * LIGHTS && p->channels == channels;
}

/* --- distances ---------------------------------------------------------------------------------------------------- */

static int texels, wrong;

static void see_distance(const seen *s)
{
    const lmb_vec3 at = vec3(m.tile.position[0][s->k], m.tile.position[1][s->k], m.tile.position[2][s->k]);
    const float want = s->lit ? length3(sub3(at, lit.lights[s->light].position)) : 0.0f;
    texels += s->lit;
    wrong += !(absf(s->pixel[0] - want) <= 1e-4f * want);
}

/* V6, V33: metres from the light, inside the cone. */
static void test_distances(void)
{
    image p;
    report r = {""};
    lmb_frame f = make_frame();
    solve(&f, LMB_STAGE_POINTS);
    CHECK(map_distances(&p, &m.render, &r) && has_size(&p, 1));
    texels = wrong = 0;
    see_all(&p, see_distance);
    CHECK_MSG(wrong == 0 && texels > MAP * MAP / 2, "%d of %d", wrong, texels);
    image_free(&p);
}

/* --- groups ------------------------------------------------------------------------------------------------------- */

static double owned[LMB_MAX_GROUPS + 2]; /* W by number: [0] dropped, [k + 1] group k */
static double lost;                      /* W of lit texels without an owner */

static void see_owner(const seen *s)
{
    const double flux = (double)(s->power[1] * m.tile.albedo[1][s->k]);
    const int number = (int)s->pixel[0];
    texels += s->lit;
    wrong += !s->lit && s->pixel[0] != 0.0f;
    if (s->lit && (number == 0 || number > m.groups.count)) {
        lost += flux;
    } else if (s->lit) {
        owned[number < 0 ? 0 : number] += flux;
    }
}

/* The share of the flux in texels of the wrong group. */
static double misplaced(const lmb_frame *f)
{
    image p;
    report r = {""};
    double off = 0.0, all = 0.0;
    solve(f, LMB_STAGE_VIEW);
    CHECK(map_groups(&p, &m.render, 0, &r) && has_size(&p, 1));
    memset(owned, 0, sizeof owned);
    lost = 0.0;
    texels = wrong = 0;
    see_all(&p, see_owner);
    image_free(&p);
    for (int32_t k = 0; k < m.groups.count; ++k) {
        off += fabs(owned[k + 1] - (double)m.groups.flux[1][k]);
        all += (double)m.groups.flux[1][k];
    }
    CHECK(wrong == 0 && texels > MAP * MAP / 2 && all > 0.0 && m.groups.count > 20);
    CHECK(lost == 0.0);
    return off / all;
}

/* V33: the light of all texels with one number equals the light that the group sends, whether points were joined,
 * thinned out, or neither; texels of dropped discs have the light that strict zones lose [V20]. */
static void test_owners(void)
{
    lmb_frame f = make_frame();
    f.grouping.join = 1e-30f;
    const double alone = misplaced(&f);
    f = make_frame();
    const double joined = misplaced(&f);
    f = make_frame();
    f.grouping.thin = 5;
    const double thinned = misplaced(&f);
    CHECK_MSG(alone < 1e-5 && joined < 1e-5 && thinned < 1e-5, "%g, joined %g, thinned %g", alone, joined, thinned);
    f = make_frame();
    f.grouping.flags = LMB_ZONES_STRICT;
    CHECK(misplaced(&f) < 1e-5);
    double dropped = 0.0;
    const lmb_points *points = &m.render.frame.points;
    for (uint32_t i = 0; i < points->count; ++i) {
        dropped += (double)points->data[i].flux[1];
    }
    for (int32_t k = 0; k < m.groups.count; ++k) {
        dropped -= (double)m.groups.flux[1][k];
    }
    CHECK_MSG(dropped > 0.0 && fabs(owned[0] / dropped - 1.0) < 1e-4, "%g W dropped, %g W seen", dropped, owned[0]);
}

/* As many colours as visible groups, and one colour per number. */
static void test_colours(void)
{
    static float colour[LMB_MAX_GROUPS + 1][3];
    static int met[LMB_MAX_GROUPS + 1];
    image p, n;
    report r = {""};
    int equal = 0;
    lmb_frame f = make_frame();
    solve(&f, LMB_STAGE_VIEW);
    CHECK(map_groups(&p, &m.render, 1, &r) && has_size(&p, 3) && map_groups(&n, &m.render, 0, &r));
    memset(met, 0, sizeof met);
    wrong = 0;
    for (int i = 0; i < p.width * p.height; ++i) {
        const int k = (int)n.pixels[i];
        if (k > 0 && !met[k]) {
            met[k] = 1;
            memcpy(colour[k], p.pixels + 3 * i, sizeof colour[k]);
        }
        wrong += k > 0 ? memcmp(colour[k], p.pixels + 3 * i, sizeof colour[k]) != 0 : p.pixels[3 * i] != 0.0f;
    }
    for (int a = 1; a <= m.groups.count; ++a) {
        for (int b = 1; b < a; ++b) {
            equal += met[a] && met[b] && memcmp(colour[a], colour[b], sizeof colour[a]) == 0;
        }
    }
    CHECK_MSG(wrong == 0 && equal == 0, "%d pixels of another colour, %d colours twice", wrong, equal);
    image_free(&p);
    image_free(&n);
}

/* --- first points ------------------------------------------------------------------------------------------------- */

/* The exitance of a point in the texel's cell. */
static void see_point(const seen *s)
{
    const int32_t x = m.tile.x + s->k % LMB_TILE, y = m.tile.y + s->k / LMB_TILE;
    const lmb_points *points = &m.render.frame.points;
    int found = 0;
    texels += s->lit;
    for (uint32_t i = 0; i < points->count && s->lit; ++i) {
        const lmb_point *p = &points->data[i];
        const float area = 4.0f * length3(cross3(p->axis_u, p->axis_v));
        found |= p->cell_x == x / BLOCK && p->cell_y == y / BLOCK &&
                 absf(s->pixel[1] * area - p->flux[1]) <= 1e-4f * p->flux[1];
    }
    wrong += s->lit ? !found : s->pixel[1] != 0.0f;
}

static void test_first_points(void)
{
    image p;
    report r = {""};
    int dots = 0;
    lmb_frame f = make_frame();
    f.grouping.join = 1e-30f;
    solve(&f, LMB_STAGE_GROUPS);
    CHECK(map_points(&p, &m.render, 0, &r) && has_size(&p, 3));
    texels = wrong = 0;
    see_all(&p, see_point);
    CHECK_MSG(wrong == 0 && texels > MAP * MAP / 2, "%d of %d", wrong, texels);
    image_free(&p);
    CHECK(map_points(&p, &m.render, 1, &r) && has_size(&p, 3));
    for (int i = 0; i < p.width * p.height; ++i) {
        const float *c = p.pixels + 3 * i;
        dots += c[0] == 1.0f && c[1] == 0.05f && c[2] == 0.4f;
    }
    CHECK_MSG(dots > (int)m.stats.first_points && dots <= 4 * (int)m.stats.first_points, "%d texels of %u dots", dots,
              (unsigned)m.stats.first_points);
    image_free(&p);
}

/* Near is bright, nothing is black; shares and normals keep their extremes. */
static void test_greys(void)
{
    float far[5] = {2.0f, 0.0f, 1.0f, 1.5f, 3.0f}, share[3] = {0.0f, 1.0f, 0.5f}, normal[3] = {-1.0f, 0.0f, 1.0f};
    image p = {5, 1, 1, far}, shares = {3, 1, 1, share}, normals = {1, 1, 3, normal};
    float nearest, farthest;
    grey_distances(&p, &nearest, &farthest);
    CHECK(nearest == 1.0f && farthest == 3.0f);
    CHECK(far[2] == 1.0f && far[2] > far[3] && far[3] > far[0] && far[0] > far[4] && far[4] > 0.0f && far[1] == 0.0f);
    grey_shares(&shares);
    CHECK(share[0] == 0.0f && share[1] == 1.0f && fabsf(share[2] - 0.2159f) < 1e-3f); /* 128 of 255 in sRGB */
    grey_normals(&normals);
    CHECK(normal[0] == 0.0f && normal[1] == 0.5f && normal[2] == 1.0f);
}

/* A picture too large for the writers. */
static void test_too_large(void)
{
    image p;
    report r = {""};
    lmb_frame f = make_frame();
    solve(&f, LMB_STAGE_POINTS);
    m.render.frame.shadow_map = LMB_MAX_SIDE + LMB_TILE;
    CHECK(!map_distances(&p, &m.render, &r) && strstr(r.text, "--shadow-map") != NULL);
}

void test_map_picture(void)
{
    set_scene();
    test_distances();
    test_owners();
    test_colours();
    test_first_points();
    test_greys();
    test_too_large();
}
