/* test_light.c: direct light and its shadow test, against formulas and exact rays. [V3 V7 V29] */
#include <math.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../src/base/vec.h"
#include "../test.h"

void test_light(void);

#define PI       3.14159265358979323846
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

enum { TRIANGLES = 4096, SIDE = 512, FRAME = 128, PIXELS = FRAME * FRAME };

static const lmb_vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};

/* --- a scene of two meshes: a floor or a solid, and a plate with a material of its own ---------------------------- */

static float corners[TRIANGLES][3][3], uvs[TRIANGLES][3][2];
static struct {
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_texture texture;
    lmb_instance instance[2];
    lmb_scene scene;
    uint32_t count, first; /* triangles; where the second mesh begins */
} world;

static void world_begin(void)
{
    memset(&world, 0, sizeof world);
    memset(uvs, 0, sizeof uvs);
    for (int i = 0; i < 2; ++i) {
        world.material[i].albedo[0] = world.material[i].albedo[1] = world.material[i].albedo[2] = 0.5f;
        world.material[i].alpha = 1.0f;
        world.material[i].texture = -1;
        world.material[i].flags = LMB_DOUBLE_SIDED;
    }
}

static void world_triangle(lmb_vec3 a, lmb_vec3 b, lmb_vec3 c)
{
    const lmb_vec3 p[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
        corners[world.count][i][0] = p[i].x;
        corners[world.count][i][1] = p[i].y;
        corners[world.count][i][2] = p[i].z;
    }
    ++world.count;
}

/* Half sides u and v, with the texture's (0, 0) at -u -v and (1, 1) at +u +v. */
static void world_quad(lmb_vec3 centre, lmb_vec3 u, lmb_vec3 v)
{
    static const float uv[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    lmb_vec3 a = sub3(sub3(centre, u), v), b = sub3(add3(centre, u), v), c = add3(add3(centre, u), v),
             d = add3(sub3(centre, u), v);
    memcpy(uvs[world.count], uv, sizeof uv);
    world_triangle(a, b, c);
    world_triangle(a, c, d);
}

static void world_box(lmb_vec3 centre, float half)
{
    const lmb_vec3 axis[3] = {X, Y, Z};
    for (int i = 0; i < 6; ++i) {
        lmb_vec3 out = mul3(axis[i / 2], i & 1 ? -half : half);
        world_quad(add3(centre, out), mul3(axis[(i / 2 + 1) % 3], half), mul3(axis[(i / 2 + 2) % 3], half));
    }
}

static lmb_vec3 on_sphere(int stack, int stacks, int slice, int slices)
{
    double a = PI * stack / stacks, b = 2.0 * PI * slice / slices;
    return vec3((float)(sin(a) * cos(b)), (float)cos(a), (float)(sin(a) * sin(b)));
}

static void world_sphere(int stacks, int slices)
{
    for (int i = 0; i < stacks; ++i) {
        for (int j = 0; j < slices; ++j) {
            lmb_vec3 a = on_sphere(i, stacks, j, slices), b = on_sphere(i, stacks, j + 1, slices);
            lmb_vec3 c = on_sphere(i + 1, stacks, j + 1, slices), d = on_sphere(i + 1, stacks, j, slices);
            if (i > 0) {
                world_triangle(a, b, c);
            }
            if (i + 1 < stacks) {
                world_triangle(a, c, d);
            }
        }
    }
}

static void world_plate(void) { world.first = world.count; }

static void world_end(void)
{
    lmb_scene *s = &world.scene;
    world.first = world.first > 0 ? world.first : world.count;
    world.mesh[0].triangle_count = world.first;
    world.mesh[1].triangle_count = world.count - world.first;
    for (uint32_t i = 0; i < 2; ++i) {
        world.mesh[i].positions = i ? corners[world.first] : corners[0];
        world.mesh[i].uvs = i ? uvs[world.first] : uvs[0];
        world.mesh[i].vertex_count = 3 * world.mesh[i].triangle_count;
        memset(world.instance[i].to_world.m, 0, sizeof world.instance[i].to_world.m);
        for (int d = 0; d < 4; ++d) {
            world.instance[i].to_world.m[5 * d] = 1.0f;
        }
        world.instance[i].mesh = world.instance[i].material = i;
        world.instance[i].first_id = i ? world.first + 1 : 1;
    }
    s->meshes = world.mesh;
    s->materials = world.material;
    s->textures = &world.texture;
    s->instances = world.instance;
    s->mesh_count = s->material_count = s->instance_count = 2;
    s->texture_count = world.texture.texels != NULL;
    lmb_scene_bounds(&s->bounds_min, &s->bounds_max, s);
    CHECK(lmb_scene_check(s) == LMB_OK);
}

/* --- lights and pictures ------------------------------------------------------------------------------------------ */

static lmb_light make_light(int32_t kind, lmb_vec3 at, lmb_vec3 along)
{
    lmb_light l;
    memset(&l, 0, sizeof l);
    l.kind = kind;
    l.position = at;
    l.direction = normalize3(along);
    l.intensity[0] = 2.0f;
    l.intensity[1] = 3.0f;
    l.intensity[2] = 5.0f;
    l.cos_inner = l.cos_outer = -1.0f;
    return l;
}

static lmb_light spot(lmb_vec3 at, lmb_vec3 along, double inner_deg, double outer_deg)
{
    lmb_light l = make_light(LMB_LIGHT_SPOT, at, along);
    l.cos_inner = (float)cos(inner_deg * PI / 180.0);
    l.cos_outer = (float)cos(outer_deg * PI / 180.0);
    return l;
}

static uint32_t map_memory[6 * SIDE * SIDE * 2], depth_memory[PIXELS], id_memory[PIXELS];
static lmb_light_map map;
static lmb_raster_scratch raster;
static lmb_target eye;

/* What was seen, and the irradiance there without shadows [0] and with [1]. */
static struct {
    lmb_vec3 at, normal;
    uint32_t id;
    float open[3], shadowed[3];
} seen[PIXELS];

static lmb_view look(lmb_vec3 from, lmb_vec3 target, double fov_deg)
{
    lmb_view v;
    lmb_vec3 d = sub3(target, from);
    lmb_vec3 up = absf(d.y) > 0.99f * length3(d) ? Z : Y;
    CHECK(lmb_view_look(&v, from, target, up, (float)(fov_deg * PI / 180), FRAME, FRAME) == LMB_OK);
    return v;
}

static void draw_map(const lmb_light *light, int32_t size)
{
    CHECK(lmb_light_map_init(&map, light, &world.scene, size, LMB_ID32, map_memory, sizeof map_memory) == LMB_OK);
    CHECK(lmb_light_map_clear(&map) == LMB_OK);
    CHECK(lmb_light_map_draw(&map, lmb_kernels_pick(), &raster, &world.scene, 1, TRIANGLES, NULL) == LMB_OK);
}

static void draw_view(const lmb_view *v)
{
    memset(&eye, 0, sizeof eye);
    CHECK(lmb_surface_init(&eye.depth, LMB_DEPTH32F, FRAME, FRAME, depth_memory, sizeof depth_memory) == LMB_OK);
    CHECK(lmb_surface_init(&eye.id, LMB_ID32, FRAME, FRAME, id_memory, sizeof id_memory) == LMB_OK);
    lmb_surface_clear(&eye.depth);
    lmb_surface_clear(&eye.id);
    CHECK(lmb_draw(&eye, lmb_kernels_pick(), &raster, v, &world.scene, 1, TRIANGLES, LMB_CULL_BACK, NULL) == LMB_OK);
}

static void shade_tile(const lmb_view *v, const lmb_light *light, int32_t x, int32_t y)
{
    static lmb_tile tile;
    lmb_irradiance open, shadowed;
    const lmb_kernels *k = lmb_kernels_pick();
    memset(&open, 0, sizeof open);
    memset(&shadowed, 0, sizeof shadowed);
    CHECK(lmb_resolve_tile(&tile, k, v, &world.scene, &eye, x, y) == LMB_OK);
    CHECK(lmb_direct_tile(&open, k, &tile, v, &world.scene, light, NULL) == LMB_OK);
    CHECK(lmb_direct_tile(&shadowed, k, &tile, v, &world.scene, light, &map) == LMB_OK);
    for (int i = 0; i < LMB_TILE_PIXELS; ++i) {
        int32_t p = (y + i / LMB_TILE) * FRAME + x + i % LMB_TILE;
        seen[p].at = vec3(tile.position[0][i], tile.position[1][i], tile.position[2][i]);
        seen[p].normal = vec3(tile.normal[0][i], tile.normal[1][i], tile.normal[2][i]);
        seen[p].id = tile.id[i];
        for (int c = 0; c < 3; ++c) {
            seen[p].open[c] = open.rgb[c][i];
            seen[p].shadowed[c] = shadowed.rgb[c][i];
        }
    }
}

static void shade(const lmb_view *v, const lmb_light *light, int32_t size)
{
    draw_map(light, size);
    draw_view(v);
    for (int32_t y = 0; y < FRAME; y += LMB_TILE) {
        for (int32_t x = 0; x < FRAME; x += LMB_TILE) {
            shade_tile(v, light, x, y);
        }
    }
}

/* --- irradiance --------------------------------------------------------------------------------------------------- */

/* V3: intensity x cosine / distance2, smoothstep of the angle's cosine between the cones; in double. */
static double irradiance(const lmb_light *l, lmb_vec3 p, lmb_vec3 n)
{
    double d[3] = {(double)l->position.x - (double)p.x, (double)l->position.y - (double)p.y,
                   (double)l->position.z - (double)p.z};
    double axis[3] = {(double)l->direction.x, (double)l->direction.y, (double)l->direction.z};
    double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], r = sqrt(r2), share = 1.0;
    if (l->kind == LMB_LIGHT_DIRECTIONAL) {
        return fmax(0.0, -(axis[0] * (double)n.x + axis[1] * (double)n.y + axis[2] * (double)n.z));
    }
    if (l->kind == LMB_LIGHT_SPOT) {
        double t = -(d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]) / r,
               wide = (double)l->cos_inner - (double)l->cos_outer;
        t = fmin(fmax((t - (double)l->cos_outer) / fmax(wide, 1e-6), 0.0), 1.0);
        share = t * t * (3.0 - 2.0 * t);
    }
    return share * fmax(0.0, (d[0] * (double)n.x + d[1] * (double)n.y + d[2] * (double)n.z) / (r * r2));
}

/* Open floor and a tilted plate: formula and picture agree; the whole cone is passed through. */
static void check_irradiance(const char *name, lmb_light light)
{
    lmb_view v = look(vec3(0.5f, 3, 3), vec3(0, 0, 0), 60);
    double worst = 0.0, peak = 0.0, least = 1e30;
    uint32_t dark = 0, pixels = 0;
    world_begin();
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    world_plate();
    world_quad(vec3(-0.2f, 0.3f, -1.5f), mul3(X, 0.7f), vec3(0, 0.3f, -0.2f));
    world_end();
    shade(&v, &light, 256);
    for (int i = 0; i < PIXELS; ++i) {
        if (seen[i].id != 0) {
            double want = irradiance(&light, seen[i].at, seen[i].normal);
            peak = fmax(peak, want);
            least = fmin(least, want);
            for (int c = 0; c < 3; ++c) {
                worst = fmax(worst, fabs((double)seen[i].open[c] - want * (double)light.intensity[c]) /
                                        (double)light.intensity[c]);
            }
            ++pixels;
            dark += want > 0.0 && seen[i].open[0] == 0.0f;
        }
    }
    printf("  irradiance, %-10s %.1e of the peak off the formula over %u pixels\n", name, worst / peak,
           (unsigned)pixels);
    CHECK_MSG(pixels > PIXELS / 4 && worst < 1e-5 * peak, "%s: %g of %g", name, worst, peak);
    if (light.kind == LMB_LIGHT_SPOT) {
        CHECK(least == 0.0); /* outside the cone, too */
    }
    CHECK_MSG(dark * 1000 <= pixels, "%u", (unsigned)dark);
}

/* Inner cone: everything; outer: nothing; half way between, of the cosine: half. A hard cone has no between. */
static void check_cone(void)
{
    static lmb_tile tile;
    lmb_irradiance e;
    lmb_view v = look(vec3(0, 2, 0), vec3(0, 0, 0), 60);
    lmb_light l = spot(vec3(0, 1, 0), vec3(0, -1, 0), 20, 40);
    world_begin();
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    world_end();
    memset(&tile, 0, sizeof tile);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) { /* cosines from 1 down to 0.7 */
        double cosine = 1.0 - 0.3 * k / (LMB_TILE_PIXELS - 1), sine = sqrt(1.0 - cosine * cosine);
        tile.position[0][k] = (float)sine;
        tile.position[1][k] = (float)(1.0 - cosine);
        tile.normal[0][k] = tile.face[0][k] = (float)-sine; /* facing the light from 1 m */
        tile.normal[1][k] = tile.face[1][k] = (float)cosine;
        tile.id[k] = 1;
    }
    memset(&e, 0, sizeof e);
    CHECK(lmb_direct_tile(&e, lmb_kernels_pick(), &tile, &v, &world.scene, &l, NULL) == LMB_OK);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        double cosine = 1.0 - 0.3 * k / (LMB_TILE_PIXELS - 1),
               t = (cosine - cos(PI * 40 / 180)) / (cos(PI * 20 / 180) - cos(PI * 40 / 180));
        t = fmin(fmax(t, 0.0), 1.0);
        CHECK_MSG(fabs((double)e.rgb[0][k] - 2.0 * t * t * (3.0 - 2.0 * t)) < 1e-5, "cosine %g: %g", cosine,
                  (double)e.rgb[0][k]);
    }
    l = spot(vec3(0, 1, 0), vec3(0, -1, 0), 30, 30);
    CHECK(lmb_direct_tile(&e, lmb_kernels_pick(), &tile, &v, &world.scene, &l, NULL) ==
          LMB_OK); /* added to what is there */
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        double cosine = 1.0 - 0.3 * k / (LMB_TILE_PIXELS - 1),
               t = (cosine - cos(PI * 40 / 180)) / (cos(PI * 20 / 180) - cos(PI * 40 / 180));
        t = fmin(fmax(t, 0.0), 1.0);
        double want = 2.0 * t * t * (3.0 - 2.0 * t) + (cosine > cos(PI * 30 / 180) ? 2.0 : 0.0);
        CHECK_MSG(fabs((double)e.rgb[0][k] - want) < 1e-5, "hard, cosine %g: %g", cosine, (double)e.rgb[0][k]);
    }
    for (int k = 0; k < LMB_TILE_PIXELS;
         ++k) { /* the surface itself turned away: smooth normals let no light through */
        tile.face[0][k] = -tile.face[0][k];
        tile.face[1][k] = -tile.face[1][k];
    }
    memset(&e, 0, sizeof e);
    CHECK(lmb_direct_tile(&e, lmb_kernels_pick(), &tile, &v, &world.scene, &l, NULL) == LMB_OK);
    CHECK(e.rgb[0][0] == 0.0f && e.rgb[1][20] == 0.0f && e.rgb[2][63] == 0.0f);
    CHECK(lmb_direct_tile(NULL, lmb_kernels_pick(), &tile, &v, &world.scene, &l, NULL) == LMB_ERR_ARG);
    CHECK(lmb_direct_tile(&e, lmb_kernels_pick(), &tile, &v, NULL, &l, NULL) == LMB_ERR_ARG);
}

static void test_irradiance(void)
{
    check_irradiance("point", make_light(LMB_LIGHT_POINT, vec3(0.3f, 1.2f, -0.4f), Y));
    check_irradiance("spot", spot(vec3(0.3f, 1.2f, -0.4f), vec3(-0.2f, -1, -0.3f), 20, 38));
    check_irradiance("wide spot", spot(vec3(0.3f, 0.7f, -0.4f), vec3(-0.2f, -1, -0.1f), 30, 62));
    check_irradiance("hard spot", spot(vec3(0.3f, 1.2f, -0.4f), vec3(-0.2f, -1, -0.3f), 30, 30));
    check_irradiance("sun", make_light(LMB_LIGHT_DIRECTIONAL, vec3(0, 0, 0), vec3(0.4f, -0.8f, -0.2f)));
    check_cone();
}

/* --- shadows ------------------------------------------------------------------------------------------------------ */

/* The plate: half sides of 0.5 m, turned, 1 m over the floor. */
static const lmb_vec3 plate_at = {0.1f, 1, -0.05f}, plate_u = {0.46f, 0, 0.2f}, plate_v = {-0.2f, 0, 0.46f};

static void make_plate(void)
{
    world_begin();
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    world_plate();
    world_quad(plate_at, plate_u, plate_v);
    world_end();
}

/* Where the way from p to the light passes the plate, in its half sides; 0 where it does not pass its height. */
static int cross_plate(double uv[2], const lmb_light *l, lmb_vec3 p)
{
    double up[3] = {-(double)l->direction.x, -(double)l->direction.y, -(double)l->direction.z};
    if (l->kind != LMB_LIGHT_DIRECTIONAL) {
        up[0] = (double)l->position.x - (double)p.x;
        up[1] = (double)l->position.y - (double)p.y;
        up[2] = (double)l->position.z - (double)p.z;
    }
    double t = ((double)plate_at.y - (double)p.y) / up[1], size = (double)dot3(plate_u, plate_u);
    double x = (double)p.x + t * up[0] - (double)plate_at.x, z = (double)p.z + t * up[2] - (double)plate_at.z;
    uv[0] = (x * (double)plate_u.x + z * (double)plate_u.z) / size;
    uv[1] = (x * (double)plate_v.x + z * (double)plate_v.z) / size;
    return t > 0.0;
}

/* A place in the map's face that looks down (point lights), or its only one: texels. */
static void place_in_map(double xy[2], lmb_vec3 p)
{
    const lmb_view *v = &map.view[map.faces == 1 ? 0 : 3];
    lmb_vec3 d = sub3(p, v->eye);
    double w = v->kind == LMB_PERSPECTIVE ? -(double)dot3(v->back, d) : 1.0;
    xy[0] = ((double)dot3(v->right, d) / (w * (double)v->half_width) * 0.5 + 0.5) * map.size;
    xy[1] = (0.5 - (double)dot3(v->up, d) / (w * (double)v->half_height) * 0.5) * map.size;
}

/* Texels between a floor point and the plate's outline in the map. */
static double texels_to_edge(lmb_vec3 p)
{
    static const float sign[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    double corner[5][2], at[2], nearest = 1e30;
    place_in_map(at, p);
    for (int i = 0; i < 5; ++i) {
        place_in_map(corner[i], add3(plate_at, add3(mul3(plate_u, sign[i][0]), mul3(plate_v, sign[i][1]))));
    }
    for (int i = 0; i < 4; ++i) {
        double ex = corner[i + 1][0] - corner[i][0], ey = corner[i + 1][1] - corner[i][1];
        double dx = at[0] - corner[i][0], dy = at[1] - corner[i][1];
        double t = fmin(fmax((dx * ex + dy * ey) / (ex * ex + ey * ey), 0.0), 1.0);
        nearest = fmin(nearest, hypot(dx - t * ex, dy - t * ey));
    }
    return nearest;
}

/* V7: lit or dark as the exact ray says, up to a texel from the shadow's edge. */
static void check_shadow(const char *name, lmb_light light, int32_t size)
{
    lmb_view v = look(vec3(1.2f, 2.6f, 2.4f), vec3(0, 0, 0), 60);
    int wrong = 0, close = 0, near_edge = 0, dark = 0, lit = 0;
    double farthest = 0.0;
    make_plate();
    shade(&v, &light, size);
    for (int i = 0; i < PIXELS; ++i) {
        double uv[2];
        if (seen[i].id == 0 || seen[i].id > 2 || seen[i].open[0] == 0.0f || !cross_plate(uv, &light, seen[i].at)) {
            continue;
        }
        int shaded = fabs(uv[0]) < 1.0 && fabs(uv[1]) < 1.0, differs = (seen[i].shadowed[0] == 0.0f) != shaded;
        double texels = texels_to_edge(seen[i].at);
        dark += shaded;
        lit += !shaded;
        near_edge += texels <= 1.0;
        close += differs && texels <= 1.0;
        wrong += differs && texels > 1.0;
        farthest = differs ? fmax(farthest, texels) : farthest;
        CHECK(seen[i].shadowed[0] == 0.0f || memcmp(seen[i].shadowed, seen[i].open, sizeof seen[i].open) == 0);
    }
    printf("  shadow, %-5s map %3d: %d wrong of %d, at most %.2f texels from the edge (%d pixels within one)\n", name,
           (int)size, close + wrong, dark + lit, farthest, near_edge);
    CHECK_MSG(dark > 100 && lit > 1000, "%d dark, %d lit", dark, lit);
    CHECK_MSG(wrong == 0, "%s, map %d: %d pixels farther than a texel", name, (int)size, wrong);
    CHECK_MSG(close * 25 <= near_edge, "%s, map %d: %d of %d within a texel", name, (int)size, close, near_edge);
}

/* A texture of holes: every second texel of 8x8 is missing. */
static void check_mask(lmb_light light, int32_t size)
{
    static uint8_t texels[64][4];
    lmb_view v = look(vec3(0.4f, 0.9f, 2.0f), vec3(0, 0, 0), 60);
    int wrong = 0, through = 0, stopped = 0, corner = 0;
    for (int i = 0; i < 64; ++i) {
        memset(texels[i], (i % 8 + i / 8) % 2 ? 255 : 0, 4);
    }
    make_plate();
    world.texture.texels = &texels[0][0];
    world.texture.width = world.texture.height = 8;
    world.texture.levels = 1;
    world.texture.filter = LMB_NEAREST;
    world.texture.wrap_s = world.texture.wrap_t = LMB_WRAP_CLAMP;
    world.material[1].texture = 0;
    world.material[1].alpha_cutoff = 0.5f;
    world.material[1].flags |= LMB_ALPHA_MASK;
    world_end();
    shade(&v, &light, size);
    for (int i = 0; i < PIXELS; ++i) {
        double uv[2];
        if (seen[i].id == 0 || seen[i].id > 2 || seen[i].open[0] == 0.0f || !cross_plate(uv, &light, seen[i].at) ||
            fabs(uv[0]) > 0.98 || fabs(uv[1]) > 0.98) {
            continue;
        }
        double s = (uv[0] + 1.0) * 4.0, t = (uv[1] + 1.0) * 4.0;
        double side = fmin(s - floor(s), ceil(s) - s), other = fmin(t - floor(t), ceil(t) - t);
        int hole = ((int)s + (int)t) % 2 == 0, differs = (seen[i].shadowed[0] > 0.0f) != hole;
        through += hole;
        stopped += !hole;
        if (fmax(side, other) < 0.3) { /* where four holes meet, no texel's middle need lie in the right one */
            corner += differs;
        } else {
            wrong += differs && fmin(side, other) > 0.005;
        }
    }
    printf("  holes, map %d: %d of %d pixels wrong, %d more at corners\n", (int)size, wrong, through + stopped, corner);
    CHECK_MSG(through > 50 && stopped > 50 && wrong * 500 <= through + stopped, "%d of %d", wrong, through + stopped);
    CHECK_MSG(corner * 50 <= through + stopped, "%d of %d", corner, through + stopped);
}

/* A plate 4 mm over a floor shadows it: the slack for rounding is far smaller. Seen through the gap. */
static void check_low_plate(lmb_light light)
{
    lmb_view v = look(vec3(0.3f, 0.003f, 1.5f), vec3(0, 0.001f, 0), 3);
    int dark = 0, wrong = 0;
    world_begin();
    world_quad(vec3(0, 0.004f, 0), mul3(Z, 0.5f), mul3(X, 0.5f));
    world_quad(vec3(0, 0, 0), mul3(Z, 0.4f), mul3(X, 0.4f));
    world_end();
    shade(&v, &light, 256);
    for (int i = 0; i < PIXELS; ++i) {
        int inner = absf(seen[i].at.x) < 0.39f && absf(seen[i].at.z) < 0.39f;
        if (seen[i].id > 2 && inner && seen[i].open[0] > 0.0f) {
            ++dark;
            wrong += seen[i].shadowed[0] != 0.0f;
        }
    }
    CHECK_MSG(dark > 100 && wrong == 0, "%d of %d pixels 4 mm under a plate are lit", wrong, dark);
}

static void test_shadows(void)
{
    static const int32_t sizes[] = {64, 256, SIDE};
    lmb_light sun = make_light(LMB_LIGHT_DIRECTIONAL, vec3(0, 0, 0), vec3(0.3f, -0.8f, -0.2f));
    lmb_light lamp = make_light(LMB_LIGHT_POINT, vec3(-0.3f, 2.2f, 0.3f), Y);
    lmb_light cone = spot(vec3(-0.6f, 2.5f, 0.4f), vec3(0.25f, -1, -0.15f), 25, 40);
    for (int i = 0; i < COUNT(sizes); ++i) {
        check_shadow("sun", sun, sizes[i]);
        check_shadow("point", lamp, sizes[i]);
        check_shadow("spot", cone, sizes[i]);
    }
    check_mask(sun, SIDE);
    check_mask(lamp, SIDE);
    check_mask(cone, 256);
    check_low_plate(sun);
    check_low_plate(lamp);
    check_low_plate(cone);
}

/* --- no acne ------------------------------------------------------------------------------------------------------ */

/* Pixels that face the light and are dark: on a convex body there must be none. */
static int dark_pixels(int *facing, const lmb_view *v, const lmb_light *light, int32_t size)
{
    int dark = 0;
    shade(v, light, size);
    for (int i = 0; i < PIXELS; ++i) {
        *facing += seen[i].open[0] > 0.0f;
        dark += seen[i].open[0] > 0.0f && seen[i].shadowed[0] == 0.0f;
    }
    return dark;
}

static void check_convex(const char *name, int32_t size)
{
    static const double degrees[] = {0, 20, 45, 60, 75, 85, 89, 89.9};
    static const float eyes[][3] = {{3, 1, 2}, {-1, 3, -2}, {0.1f, -2.5f, 2.2f}};
    int dark = 0, facing = 0;
    for (int e = 0; e < COUNT(eyes); ++e) {
        lmb_view v = look(vec3(eyes[e][0], eyes[e][1], eyes[e][2]), vec3(0, 0, 0), 45);
        for (int d = 0; d < COUNT(degrees); ++d) {
            double a = degrees[d] * PI / 180;
            lmb_vec3 up = vec3((float)(sin(a) * 0.8), (float)cos(a), (float)(sin(a) * 0.6));
            lmb_light l = make_light(LMB_LIGHT_DIRECTIONAL, vec3(0, 0, 0), mul3(up, -1.0f));
            dark += dark_pixels(&facing, &v, &l, size);
            l = make_light(LMB_LIGHT_POINT, mul3(up, 3.0f), Y);
            dark += dark_pixels(&facing, &v, &l, size);
            l = spot(mul3(up, 2.5f), mul3(up, -1.0f), 30, 45);
            dark += dark_pixels(&facing, &v, &l, size);
        }
    }
    printf("  convex %s, map %d: %d of %d lit pixels are dark\n", name, (int)size, dark, facing);
    CHECK_MSG(facing > 10000 && dark == 0, "%s, map %d: %d of %d pixels that face the light are dark", name, (int)size,
              dark, facing);
}

/* Triangles of one plane, side by side and one over the other, at all turns. */
static void check_coplanar(void)
{
    int dark = 0, facing = 0;
    for (int i = 0; i < 8; ++i) {
        double a = 0.35 * i, b = 0.2 + 0.13 * i;
        lmb_vec3 n = vec3((float)(sin(b) * cos(a)), (float)cos(b), (float)(sin(b) * sin(a)));
        lmb_vec3 u = normalize3(cross3(Z, n)), w = cross3(n, u), at = mul3(vec3(0.3f, 0.7f, -0.2f), (float)i);
        lmb_view v = look(add3(at, add3(mul3(n, 2.5f), mul3(u, 1.5f))), at, 50);
        world_begin();
        world_quad(at, mul3(u, 1.1f), mul3(w, 1.1f));
        world_quad(at, add3(mul3(u, 0.7f), mul3(w, 0.3f)), add3(mul3(w, 0.7f), mul3(u, -0.3f)));
        world_end();
        for (int d = 1; d < 10; ++d) {
            double c = d * 9.9 * PI / 180; /* up to 89.1 degrees from the normal */
            lmb_vec3 up = add3(mul3(n, (float)cos(c)), mul3(add3(mul3(u, 0.8f), mul3(w, 0.6f)), (float)sin(c)));
            lmb_light l = make_light(LMB_LIGHT_DIRECTIONAL, vec3(0, 0, 0), mul3(up, -1.0f));
            dark += dark_pixels(&facing, &v, &l, 64);
            l = make_light(LMB_LIGHT_POINT, add3(at, mul3(up, 2.0f)), Y);
            dark += dark_pixels(&facing, &v, &l, 64);
        }
    }
    CHECK_MSG(facing > 10000 && dark == 0, "%d of %d pixels of a plane shadow themselves", dark, facing);
}

/* A light 1 mm above a floor of 4 m: all of it is lit, by the formula. */
static void check_low_light(void)
{
    lmb_light l = make_light(LMB_LIGHT_POINT, vec3(0.1f, 0.001f, 0.2f), Y);
    lmb_view v = look(vec3(0.5f, 3, 2), vec3(0, 0, 0), 60);
    int dark = 0, facing = 0;
    double worst = 0.0;
    world_begin();
    world_quad(vec3(0, 0, 0), mul3(Z, 2), mul3(X, 2));
    world_end();
    dark = dark_pixels(&facing, &v, &l, 256);
    for (int i = 0; i < PIXELS; ++i) {
        if (seen[i].id != 0) {
            double want = 2.0 * irradiance(&l, seen[i].at, seen[i].normal);
            worst = fmax(worst, fabs((double)seen[i].shadowed[0] / want - 1.0));
        }
    }
    printf("  light 1 mm over a floor: %d of %d pixels dark, %.1e off the formula\n", dark, facing, worst);
    CHECK_MSG(facing > 1000 && dark == 0 && worst < 1e-3, "%d dark, %g", dark, worst);
}

static void test_acne(void)
{
    static const int32_t sizes[] = {16, 64, 256};
    for (int i = 0; i < COUNT(sizes); ++i) {
        world_begin();
        world_box(vec3(0, 0, 0), 0.7f);
        world_end();
        check_convex("box", sizes[i]);
        world_begin();
        world_sphere(24, 48);
        world_end();
        check_convex("sphere", sizes[i]);
    }
    check_coplanar();
    check_low_light();
}

void test_light(void)
{
    test_irradiance();
    test_shadows();
    test_acne();
}
