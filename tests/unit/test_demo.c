/* test_demo.c: the built-in scene: valid data, closed objects with outward winding, an inward-facing room, the
 * camera. */
#include <math.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../src/base/vec.h"
#include "../../src/base/vertex.h"
#include "../../tools/demo/demo_field.h"
#include "../../tools/demo/demo_scene.h"
#include "../test.h"

void test_demo(void);

enum { WALLS = 6, MAX_VERTICES = 1536, FLASH_BYTES = 100 * 1024 };

/* World-space triangle of an instance. */
static void corners(lmb_vec3 p[3], const lmb_scene *s, const lmb_instance *in, uint32_t triangle)
{
    const lmb_mesh *m = s->meshes + in->mesh;
    uint32_t k;
    for (k = 0; k < 3; ++k) {
        p[k] = transform_point(&in->to_world, mesh_position(m, mesh_index(m, 3 * triangle + k)));
    }
}

static lmb_vec3 face_normal(const lmb_vec3 p[3])
{
    return normalize3(cross3(sub3(p[1], p[0]), sub3(p[2], p[0])));
}

/* Closed and consistently wound: each edge occurs once in each direction. */
static int is_closed(const lmb_mesh *m)
{
    static uint8_t walked[MAX_VERTICES][MAX_VERTICES];
    uint32_t t, k, a, b;
    memset(walked, 0, sizeof walked);
    for (t = 0; t < m->triangle_count; ++t) {
        for (k = 0; k < 3; ++k) {
            a = mesh_index(m, 3 * t + k);
            b = mesh_index(m, 3 * t + (k + 1) % 3);
            if (walked[a][b]++) {
                return 0;
            }
        }
    }
    for (a = 0; a < m->vertex_count; ++a) {
        for (b = 0; b < a; ++b) {
            if (walked[a][b] != walked[b][a]) {
                return 0;
            }
        }
    }
    return 1;
}

/* Positive if the faces point outwards (divergence theorem). */
static float volume(const lmb_scene *s, const lmb_instance *in)
{
    lmb_vec3 p[3], origin = vec3(in->to_world.m[12], in->to_world.m[13], in->to_world.m[14]);
    uint32_t t;
    float sum = 0.0f;
    for (t = 0; t < s->meshes[in->mesh].triangle_count; ++t) {
        corners(p, s, in, t);
        sum += dot3(sub3(p[0], origin), cross3(sub3(p[1], origin), sub3(p[2], origin))) / 6.0f;
    }
    return sum;
}

static void test_data(const lmb_scene *s)
{
    lmb_vec3 low, high;
    uint32_t i, last = 0, triangles = lmb_scene_triangles(s);
    CHECK(lmb_scene_check(s) == LMB_OK);
    lmb_scene_bounds(&low, &high, s);
    CHECK(!memcmp(&low, &s->bounds_min, sizeof low) && !memcmp(&high, &s->bounds_max, sizeof high));
    CHECK(low.x == -2.0f && low.y == 0.0f && low.z == -2.0f); /* the box of the room: nothing extends beyond it */
    CHECK(high.x == 2.0f && high.y == 2.75f && high.z == 2.75f);
    CHECK_MSG(triangles >= 1000 && triangles <= 6000, "%u", (unsigned)triangles);
    for (i = 0; i < s->instance_count; ++i) {
        CHECK(s->instances[i].first_id == last + 1);
        last += s->meshes[s->instances[i].mesh].triangle_count;
    }
    CHECK(last == triangles && triangles < 65536); /* 16-bit ids suffice */
}

/* Flash size of a mesh; also checks that all indices are in range. */
static uint32_t mesh_bytes(const lmb_mesh *m)
{
    uint32_t k, bad = 0, bytes = m->position_format == LMB_POSITION_I16 ? 8 : 12;
    CHECK(m->index_format == LMB_INDEX_U16 && m->vertex_count <= MAX_VERTICES);
    for (k = 0; k < 3 * m->triangle_count; ++k) {
        bad += mesh_index(m, k) >= m->vertex_count;
    }
    CHECK_MSG(bad == 0, "%u indices outside", (unsigned)bad);
    bytes += (m->normals ? 4u : 0u) + (m->colours ? 4u : 0u);
    bytes += m->uvs ? (m->uv_format == LMB_UV_U16 ? 4u : 8u) : 0u;
    return bytes * m->vertex_count + 6 * m->triangle_count;
}

/* The scene contains every stream format that a device would use, and stays small. */
static void test_formats(const lmb_scene *s)
{
    uint32_t i, bytes = 0, packed = 0, floats = 0, smooth = 0, coloured = 0, textured = 0;
    for (i = 0; i < s->mesh_count; ++i) {
        const lmb_mesh *m = s->meshes + i;
        bytes += mesh_bytes(m);
        packed += m->position_format == LMB_POSITION_I16;
        floats += m->position_format == LMB_POSITION_F32;
        smooth += m->normals != NULL;
        coloured += m->colours != NULL;
        textured += m->uvs != NULL;
    }
    CHECK(packed && floats && smooth && coloured && textured);
    bytes += (uint32_t)lmb_texture_bytes(s->textures->width, s->textures->height, s->textures->levels);
    CHECK_MSG(bytes <= FLASH_BYTES, "%u bytes", (unsigned)bytes);
}

/* Vertex normals of a closed smooth mesh have unit length and lie on the front of every adjacent face. */
static void check_smooth(const lmb_scene *s, const lmb_instance *in)
{
    const lmb_mesh *m = s->meshes + in->mesh;
    lmb_mat4 turn = in->to_world;
    lmb_vec3 p[3];
    uint32_t t, k, bad = 0;
    turn.m[12] = turn.m[13] = turn.m[14] = 0.0f;
    for (t = 0; t < m->triangle_count; ++t) {
        corners(p, s, in, t);
        for (k = 0; k < 3; ++k) {
            lmb_vec3 n = mesh_normal(m, mesh_index(m, 3 * t + k));
            bad += absf(length3(n) - 1.0f) > 1e-5f;
            bad += dot3(normalize3(transform_point(&turn, n)), face_normal(p)) < 0.7f;
        }
    }
    CHECK_MSG(bad == 0, "%u of %u corners", (unsigned)bad, (unsigned)(3 * m->triangle_count));
}

/* The faces of a convex object point away from its centre. */
static void check_convex(const lmb_scene *s, const lmb_instance *in)
{
    lmb_vec3 p[3], middle = vec3(0.0f, 0.0f, 0.0f);
    uint32_t t, count = s->meshes[in->mesh].triangle_count, bad = 0;
    for (t = 0; t < count; ++t) {
        corners(p, s, in, t);
        middle = add3(middle, mul3(add3(add3(p[0], p[1]), p[2]), 1.0f / (3.0f * (float)count)));
    }
    for (t = 0; t < count; ++t) {
        corners(p, s, in, t);
        bad += !(dot3(sub3(p[0], middle), face_normal(p)) > 0.0f);
    }
    CHECK_MSG(bad == 0, "%u of %u faces", (unsigned)bad, (unsigned)count);
}

static void test_objects(const lmb_scene *s)
{
    uint32_t i, closed = 0, smooth = 0;
    for (i = 0; i < s->instance_count; ++i) {
        const lmb_instance *in = s->instances + i;
        if (!is_closed(s->meshes + in->mesh)) {
            continue;
        }
        ++closed;
        CHECK_MSG(volume(s, in) > 1e-4f, "instance %u: %g m3", (unsigned)i, (double)volume(s, in));
        if (s->meshes[in->mesh].normals) {
            check_smooth(s, in);
            ++smooth;
        } else {
            check_convex(s, in); /* boxes */
        }
    }
    CHECK(smooth == 2);
    CHECK(closed == s->instance_count - WALLS - 1); /* all except the room and the painting */
}

/* Walls come first and face the centre of the room. */
static void test_room(const lmb_scene *s)
{
    lmb_vec3 p[3], middle = mul3(add3(s->bounds_min, s->bounds_max), 0.5f);
    uint32_t i, t;
    for (i = 0; i < WALLS; ++i) {
        for (t = 0; t < 2; ++t) {
            corners(p, s, s->instances + i, t);
            CHECK_MSG(dot3(sub3(middle, p[0]), face_normal(p)) > 1.0f, "wall %u", (unsigned)i);
        }
    }
}

static void test_texture(const lmb_scene *s)
{
    static uint8_t again[64 * 64 * 4 * 2];
    const lmb_texture *t = s->textures;
    size_t bytes = lmb_texture_bytes(t->width, t->height, t->levels);
    CHECK(t->levels == lmb_texture_level_count(t->width, t->height));
    CHECK(bytes > 0 && bytes <= sizeof again);
    memcpy(again, t->texels, (size_t)t->width * t->height * 4);
    CHECK(lmb_texture_mips(again, t->width, t->height, t->levels) == LMB_OK);
    CHECK(!memcmp(again, t->texels, bytes));
}

static void test_light(const lmb_scene *s)
{
    const lmb_light *l = s->lights;
    CHECK(s->light_count == 1 && l->kind == LMB_LIGHT_SPOT);
    CHECK(lmb_shadow_map_faces(l, s) == 1);
    CHECK(absf(length3(l->direction) - 1.0f) < 1e-6f);
    CHECK(l->cos_inner > l->cos_outer && l->cos_inner < 1.0f);
    CHECK(l->position.y < s->bounds_max.y && l->position.z < s->bounds_max.z);
}

static void test_view(const lmb_scene *s)
{
    lmb_view v = demo_view(320, 240), tall = demo_view(120, 160), none = demo_view(0, 240), zero;
    memset(&zero, 0, sizeof zero);
    CHECK(v.frame_width == 320 && v.frame_height == 240 && v.kind == LMB_PERSPECTIVE);
    CHECK(absf(v.half_width / v.half_height - 320.0f / 240.0f) < 1e-6f);
    CHECK(fabs((double)v.half_height - tan(25.0 * 3.14159265358979 / 180.0)) < 1e-6);
    CHECK(tall.half_height == v.half_height && tall.half_width < v.half_width);
    CHECK(v.eye.x < s->bounds_max.x && v.eye.y < s->bounds_max.y && v.eye.z < s->bounds_max.z);
    CHECK(none.frame_width == 0 && none.near_m == zero.near_m && none.kind == zero.kind);
}

/* --- the field ---------------------------------------------------------------------------------------------------- */

/* The cube's faces and the ground's picture show one world: a texel facing the field has the ground's colour there,
 * except at the field's lines. Four lamps are above, symmetric to the left and right. */
static void test_field(void)
{
    lmb_world_pictures p;
    world_pictures own;
    report r = {""};
    float size[2];
    double lamp[2] = {0.0, 0.0};
    int down = 0, same = 0, lamps = 0, whole = 1; /* texels: on the field; of the field's colour; bright */
    memset(&own, 0, sizeof own);
    demo_field_place(&p, size);
    CHECK_MSG(demo_field_pictures(&p, &own, &r), "%s", r.text);
    for (int face = 0; face < 6; ++face) {
        whole &= p.face[face] != NULL;
    }
    CHECK(whole && p.ground != NULL && p.face_size > 0);
    for (int i = 0, n = p.face_size; whole && i < 6 * n * n; ++i) {
        const int face = i / (n * n), x = i % n, y = i / n % n;
        const float s = 2.0f * ((float)x + 0.5f) / (float)n - 1.0f, t = 2.0f * ((float)y + 0.5f) / (float)n - 1.0f;
        const lmb_vec3 to[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
        const lmb_vec3 d = normalize3(to[face]), at = mul3(d, d.y < 0.0f ? p.centre.y / -d.y : 0.0f);
        const float *seen = (const float *)p.face[face] + 3 * (y * n + x);
        if (d.y < -0.2f && absf(at.x) < 10.0f && absf(at.z) < 6.0f) {
            const int column = (int)((at.x / size[0] + 0.5f) * (float)p.ground_width),
                      row = (int)((at.z / size[1] + 0.5f) * (float)p.ground_height);
            const float *own_texel = (const float *)p.ground + 4 * (row * p.ground_width + column);
            ++down;
            same += absf(seen[0] - own_texel[0]) + absf(seen[1] - own_texel[1]) + absf(seen[2] - own_texel[2]) < 0.1f;
        } else if (seen[0] > 30.0f) {
            ++lamps;
            lamp[0] += (double)d.x;
            lamp[1] += (double)d.y;
        }
    }
    CHECK_MSG(down > 10000 && same > down - down / 16, "%d of %d texels have the ground's colour", same, down);
    CHECK_MSG(lamps > 16 && fabs(lamp[0]) < 0.02 * lamps && fabs(lamp[1] / lamps - sin(0.401)) < 0.02,
              "%d lamps: %g, %g", lamps, lamp[0] / lamps, lamp[1] / lamps);
    world_pictures_free(&own);
}

void test_demo(void)
{
    test_field();
    const lmb_scene *s = demo_scene();
    test_data(s);
    test_formats(s);
    test_objects(s);
    test_room(s);
    test_texture(s);
    test_light(s);
    test_view(s);
}
