/* world.h: what tests set up by hand: a scene of loose triangles, lights, views, discs and groups.
 *
 * Every test file that includes this has a world of its own. A scene is made between world_begin and world_end; what
 * the test sets on `world` in between (a texture, vertex colours, lights) is kept. */
#ifndef TEST_WORLD_H
#define TEST_WORLD_H

#include <math.h>
#include <stddef.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../src/base/vec.h"
#include "test.h"

#define PI       3.14159265358979323846
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

static const lmb_vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};

/* --- a scene of two meshes, each with a material of its own; the second is empty unless world_part was called ----- */

enum { WORLD_TRIANGLES = 9216 }; /* a sphere of 48 x 96 and a little */

static struct {
    float corners[WORLD_TRIANGLES][3][3], uvs[WORLD_TRIANGLES][3][2];
    lmb_mesh mesh[2];
    lmb_material material[2];
    lmb_texture texture;
    lmb_instance instance[2];
    lmb_scene scene;
    uint32_t count, first; /* triangles; where the second mesh begins, 0 for nowhere */
} world;

static inline void world_begin(float red, float green, float blue)
{
    memset(&world, 0, sizeof world);
    for (int i = 0; i < 2; ++i) {
        lmb_material *m = &world.material[i];
        m->albedo[0] = red;
        m->albedo[1] = green;
        m->albedo[2] = blue;
        m->alpha = 1.0f;
        m->texture = -1;
        m->flags = LMB_DOUBLE_SIDED;
    }
}

/* What follows belongs to the second mesh. */
static inline void world_part(void) { world.first = world.count; }

static inline void world_triangle(lmb_vec3 a, lmb_vec3 b, lmb_vec3 c)
{
    const lmb_vec3 p[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
        world.corners[world.count][i][0] = p[i].x;
        world.corners[world.count][i][1] = p[i].y;
        world.corners[world.count][i][2] = p[i].z;
    }
    ++world.count;
}

/* Half sides u and v, the front is u x v; the texture's (0, 0) at -u -v and (1, 1) at +u +v. */
static inline void world_quad(lmb_vec3 centre, lmb_vec3 u, lmb_vec3 v)
{
    static const float uv[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    lmb_vec3 a = sub3(sub3(centre, u), v), b = sub3(add3(centre, u), v), c = add3(add3(centre, u), v),
             d = add3(sub3(centre, u), v);
    memcpy(world.uvs[world.count], uv, sizeof uv);
    world_triangle(a, b, c);
    world_triangle(a, c, d);
}

static inline void world_box(lmb_vec3 centre, float half)
{
    const lmb_vec3 axis[3] = {X, Y, Z};
    for (int i = 0; i < 6; ++i) {
        lmb_vec3 out = mul3(axis[i / 2], i & 1 ? -half : half);
        world_quad(add3(centre, out), mul3(axis[(i / 2 + 1) % 3], half), mul3(axis[(i / 2 + 2) % 3], half));
    }
}

static inline lmb_vec3 on_sphere(int stack, int stacks, int column, int columns)
{
    double a = PI * stack / stacks, b = 2.0 * PI * column / columns;
    return vec3((float)(sin(a) * cos(b)), (float)cos(a), (float)(sin(a) * sin(b)));
}

/* 2 x slices x (stacks - 1) triangles with their corners on the sphere. */
static inline void world_sphere(lmb_vec3 centre, float radius, int stacks, int slices)
{
    for (int i = 0; i < stacks; ++i) {
        for (int j = 0; j < slices; ++j) {
            lmb_vec3 a = add3(centre, mul3(on_sphere(i, stacks, j, slices), radius));
            lmb_vec3 b = add3(centre, mul3(on_sphere(i, stacks, j + 1, slices), radius));
            lmb_vec3 c = add3(centre, mul3(on_sphere(i + 1, stacks, j + 1, slices), radius));
            lmb_vec3 d = add3(centre, mul3(on_sphere(i + 1, stacks, j, slices), radius));
            if (i > 0) {
                world_triangle(a, b, c);
            }
            if (i + 1 < stacks) {
                world_triangle(a, c, d);
            }
        }
    }
}

/* Ids are the triangles in their order, from 1. May be called again after a change. */
static inline lmb_status world_end(void)
{
    lmb_scene *s = &world.scene;
    world.first = world.first > 0 ? world.first : world.count;
    for (uint32_t i = 0; i < 2; ++i) {
        uint32_t from = i ? world.first : 0, to = i ? world.count : world.first;
        world.mesh[i].positions = world.corners[from];
        world.mesh[i].uvs = world.uvs[from];
        world.mesh[i].triangle_count = to - from;
        world.mesh[i].vertex_count = 3 * (to - from);
        for (int d = 0; d < 4; ++d) {
            world.instance[i].to_world.m[5 * d] = 1.0f;
        }
        world.instance[i].mesh = world.instance[i].material = i;
        world.instance[i].first_id = from + 1;
    }
    s->meshes = world.mesh;
    s->materials = world.material;
    s->textures = &world.texture;
    s->instances = world.instance;
    s->mesh_count = s->material_count = s->instance_count = 2;
    s->texture_count = world.texture.texels != NULL;
    lmb_scene_bounds(&s->bounds_min, &s->bounds_max, s);
    return lmb_scene_check(s);
}

/* --- lights ------------------------------------------------------------------------------------------------------- */

static inline lmb_light make_light(int32_t kind, lmb_vec3 at, lmb_vec3 along)
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

static inline lmb_light spot(lmb_vec3 at, lmb_vec3 along, double inner_deg, double outer_deg)
{
    lmb_light l = make_light(LMB_LIGHT_SPOT, at, along);
    l.cos_inner = (float)cos(inner_deg * PI / 180.0);
    l.cos_outer = (float)cos(outer_deg * PI / 180.0);
    return l;
}

static inline lmb_light point_light(lmb_vec3 at) { return make_light(LMB_LIGHT_POINT, at, vec3(0, -1, 0)); }
static inline lmb_light sun(lmb_vec3 along) { return make_light(LMB_LIGHT_DIRECTIONAL, vec3(0, 0, 0), along); }

/* Power for 1 W/sr: the mean of smoothstep over its width is 1/2. */
static inline double cone_power(double inner_deg, double outer_deg)
{
    double inner = cos(inner_deg * PI / 180.0), outer = cos(outer_deg * PI / 180.0);
    return 2.0 * PI * (1.0 - inner + 0.5 * (inner - outer));
}

/* Power on a wide plane at distance h from a point light of 1 W/sr with this range, within the angle of this cosine: 2
 * pi times the integral of 1 - (h / range / c)^4 over c. */
static inline double range_power(double h, double range, double cosine)
{
    const double end = h / range, from = fmax(cosine, end), end4 = end * end * end * end;
    return 2.0 * PI * (1.0 - from - end4 / 3.0 * (1.0 / (from * from * from) - 1.0));
}

/* --- views, square ------------------------------------------------------------------------------------------------ */

/* Y is up, or Z within 2.6 degrees of the vertical. */
static inline lmb_view look(lmb_vec3 from, lmb_vec3 target, double fov_deg, int32_t side)
{
    lmb_view v = {.sample_x = 0};
    lmb_vec3 d = sub3(target, from);
    lmb_vec3 up = absf(d.y) > 0.999f * length3(d) ? Z : Y;
    CHECK(lmb_view_look_at(&v, from, target, up, (float)(fov_deg * PI / 180), side, side) == LMB_OK);
    return v;
}

/* Depth and ids of a whole view, in side x side words each. */
static inline lmb_target target_of(int32_t depth_format, int32_t side, uint32_t *depth, uint32_t *id)
{
    size_t bytes = (size_t)side * (size_t)side * sizeof *depth;
    lmb_target t;
    memset(&t, 0, sizeof t);
    CHECK(lmb_surface_init(&t.depth, depth_format, side, side, depth, bytes) == LMB_OK);
    CHECK(lmb_surface_init(&t.id, LMB_ID32, side, side, id, bytes) == LMB_OK);
    return t;
}

static inline void world_draw(lmb_target *t, const lmb_view *v, uint32_t flags)
{
    lmb_surface_clear(&t->depth);
    lmb_surface_clear(&t->id);
    CHECK(lmb_draw(t, picked_kernels(), v, &world.scene, 1, WORLD_TRIANGLES, flags, NULL) == LMB_OK);
}

/* --- tiles, discs and groups -------------------------------------------------------------------------------------- */

static inline lmb_vec3 plane_vec(float planes[3][LMB_TILE_PIXELS], int k)
{
    return vec3(planes[0][k], planes[1][k], planes[2][k]);
}

static inline void set_plane(float planes[3][LMB_TILE_PIXELS], int k, lmb_vec3 v)
{
    planes[0][k] = v.x;
    planes[1][k] = v.y;
    planes[2][k] = v.z;
}

/* A disc of half sides u and v; the same flux in all channels. */
static inline void set_disc(lmb_point *p, lmb_vec3 at, lmb_vec3 normal, lmb_vec3 u, lmb_vec3 v, float flux)
{
    memset(p, 0, sizeof *p);
    p->position = at;
    p->normal = normal;
    p->axis_u = u;
    p->axis_v = v;
    p->flux[0] = p->flux[1] = p->flux[2] = flux;
}

/* A group without members and flux. */
static inline void set_group(lmb_groups *g, int32_t k, lmb_vec3 at, lmb_vec3 axis, float area, float radius)
{
    const float place[3] = {at.x, at.y, at.z}, way[3] = {axis.x, axis.y, axis.z};
    for (int c = 0; c < 3; ++c) {
        g->position[c][k] = place[c];
        g->normal[c][k] = way[c];
        g->flux[c][k] = 0.0f;
    }
    g->area[k] = area;
    g->radius[k] = radius;
    g->first[k] = g->members[k] = 0;
}

#endif
