/* test_normal_map.c: normals bent by a normal map: axes, back faces, mirrors, given and missing tangents, and random
 * triangles against the formula in binary64. */
#include <math.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../test.h"

void test_normal_map(void);

enum { SIDE = 16 };

/* One triangle in front of the camera, covered by one texel of a normal map. */
typedef struct stage {
    float positions[9], uvs[6];
    int16_t normals[6], tangents[6];
    uint32_t texel;
    uint32_t depth[SIDE * SIDE], id[SIDE * SIDE];
    lmb_mesh mesh;
    lmb_material material;
    lmb_texture map;
    lmb_instance instance;
    lmb_scene scene;
    lmb_view view;
    lmb_target target;
    lmb_tile tile;
} stage;

static stage st;

static lmb_vec3 vec(float x, float y, float z)
{
    lmb_vec3 v = {x, y, z};
    return v;
}

/* A map with the constant code (r, g, b). */
static void set_map(uint8_t r, uint8_t g, uint8_t b)
{
    const uint8_t rgba[4] = {r, g, b, 255};
    memcpy(&st.texel, rgba, 4);
}

/* A right triangle that fills the view; u along +x, v along -y, as in an image; flat normals. */
static void set_stage(void)
{
    static const float positions[9] = {-4, -4, 0, 8, -4, 0, -4, 8, 0}, uvs[6] = {0, 1, 1, 1, 0, 0};
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    memset(&st, 0, sizeof st);
    memcpy(st.positions, positions, sizeof positions);
    memcpy(st.uvs, uvs, sizeof uvs);
    st.mesh.positions = st.positions;
    st.mesh.uvs = st.uvs;
    st.mesh.vertex_count = 3;
    st.mesh.triangle_count = 1;
    for (int k = 0; k < 3; ++k) {
        st.material.albedo[k] = 0.5f;
    }
    st.material.alpha = 1.0f;
    st.material.texture = -1;
    st.material.flags = LMB_DOUBLE_SIDED;
    st.material.normal_scale = 1.0f;
    st.map.texels = (const uint8_t *)&st.texel;
    st.map.width = st.map.height = st.map.levels = 1;
    st.instance.to_world = unit;
    st.instance.first_id = 1;
    st.scene.meshes = &st.mesh;
    st.scene.materials = &st.material;
    st.scene.textures = &st.map;
    st.scene.instances = &st.instance;
    st.scene.mesh_count = st.scene.material_count = st.scene.texture_count = st.scene.instance_count = 1;
    set_map(128, 128, 255);
}

/* The normal and face at the picture's centre, viewed from `eye` towards the origin. */
static lmb_vec3 look(lmb_vec3 *face, lmb_vec3 eye)
{
    const lmb_kernels *kernels = picked_kernels();
    lmb_scene_bounds(&st.scene.bounds_min, &st.scene.bounds_max, &st.scene);
    CHECK(lmb_scene_check(&st.scene) == LMB_OK);
    CHECK(lmb_view_look_at(&st.view, eye, vec(0, 0, 0), vec(0, 1, 0), 0.5f, SIDE, SIDE) == LMB_OK);
    st.view.near_m = 0.01f;
    CHECK(lmb_surface_init(&st.target.depth, LMB_DEPTH32F, SIDE, SIDE, st.depth, sizeof st.depth) == LMB_OK);
    CHECK(lmb_surface_init(&st.target.id, LMB_ID32, SIDE, SIDE, st.id, sizeof st.id) == LMB_OK);
    lmb_surface_clear(&st.target.depth);
    lmb_surface_clear(&st.target.id);
    CHECK(lmb_draw(&st.target, kernels, &st.view, &st.scene, 1, 1, 0, NULL) == LMB_OK);
    CHECK(lmb_resolve_tile(&st.tile, kernels, &st.view, &st.scene, &st.target, 8, 8) == LMB_OK);
    CHECK(st.tile.id[0] == 1);
    *face = vec(st.tile.face[0][0], st.tile.face[1][0], st.tile.face[2][0]);
    return vec(st.tile.normal[0][0], st.tile.normal[1][0], st.tile.normal[2][0]);
}

static void check_normal(lmb_vec3 eye, double x, double y, double z, const char *what)
{
    lmb_vec3 face, n = look(&face, eye);
    double d = (double)n.x * x + (double)n.y * y + (double)n.z * z;
    CHECK_MSG(d > 0.99999 * sqrt(x * x + y * y + z * z), "%s: %g %g %g, not along %g %g %g", what, (double)n.x,
              (double)n.y, (double)n.z, x, y, z);
}

/* A code of 255, 128, 128 is (1, 1/255, 1/255): almost flat against the surface, so MIN_RISE does not interfere. */
static const double half = 1.0 / 255.0;

static void test_axes(void)
{
    const lmb_vec3 front = vec(0, 0, 5), back = vec(0, 0, -5);
    set_stage();
    check_normal(front, half, half, 1, "a flat map leaves the normal");
    set_map(219, 128, 219);
    check_normal(front, 1, half / 0.7176, 1, "red leans towards larger u");
    set_map(128, 219, 219);
    check_normal(front, half / 0.7176, 1, 1, "green leans towards smaller v");
    st.material.normal_scale = 0.5f;
    check_normal(front, half / 1.435, 0.5, 1, "the scale shrinks x and y");
    st.material.normal_scale = -1.0f;
    check_normal(front, -half / 0.7176, -1, 1, "a negative scale turns dents to bumps");
    st.material.normal_scale = 1.0f;
    check_normal(back, -half / 0.7176, -1, -1, "a back face has the front's normal, turned round");
    set_map(219, 128, 219);
    check_normal(back, -1, -half / 0.7176, -1, "and so along u");
    st.uvs[0] = 1, st.uvs[2] = 0, st.uvs[4] = 1;
    check_normal(front, -1, half / 0.7176, 1, "a mirrored image leans the other way");
    st.uvs[0] = st.uvs[2] = st.uvs[4] = 0.3f;
    check_normal(front, 0, 0, 1, "coordinates without area leave the normal");
    st.mesh.uvs = NULL;
    check_normal(front, 0, 0, 1, "a mesh without coordinates leaves the normal");
}

static void test_transforms(void)
{
    const lmb_mat4 mirror = {{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const lmb_mat4 quarter = {{0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}; /* x to y, non-uniform */
    set_stage();
    set_map(219, 128, 219);
    st.positions[0] = st.positions[6] = -8;
    st.instance.to_world = mirror;
    check_normal(vec(0, 0, 5), -1, half / 0.7176, 1, "a mirrored node mirrors red");
    check_normal(vec(0, 0, -5), 1, -half / 0.7176, -1, "and its back");
    set_map(128, 219, 219);
    check_normal(vec(0, 0, 5), -half / 0.7176, 1, 1, "but leaves green");
    st.instance.to_world = quarter;
    check_normal(vec(0, 0, 5), -1, half / 0.7176, 1, "a turned node turns both");
}

/* Mesh tangents take precedence over the triangle's direction. */
static void test_tangents(void)
{
    set_stage();
    for (int k = 0; k < 3; ++k) {
        lmb_octahedral_encode(st.tangents + 2 * k, vec(0.70710678f, 0.70710678f, 0));
    }
    st.mesh.tangents = st.tangents;
    set_map(219, 128, 219);
    check_normal(vec(0, 0, 5), 0.7071 - half * 0.985, 0.7071 + half * 0.985, 1, "the mesh's tangent counts");
    set_map(128, 219, 219);
    check_normal(vec(0, 0, 5), -0.7071 + half * 0.985, 0.7071 + half * 0.985, 1, "and what is square to it");
}

/* A tangent along x at each corner, with the side given by a sign. */
static void set_sides(int a, int b, int c)
{
    const int odd[3] = {a > 0, b > 0, c > 0};
    for (int k = 0; k < 3; ++k) {
        lmb_octahedral_encode(st.tangents + 2 * k, vec(1, 0, 0));
        st.tangents[2 * k] = (int16_t)(odd[k] ? 32767 : 32766);
    }
    st.mesh.tangents = st.tangents;
    st.mesh.tangent_format = LMB_TANGENT_SIDED;
}

/* Both axes come from the mesh: texture coordinates are used only for the lookup. */
static void test_sides(void)
{
    const lmb_mat4 mirror = {{-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const lmb_vec3 front = vec(0, 0, 5), back = vec(0, 0, -5);
    set_stage();
    set_sides(1, 1, 1);
    set_map(128, 219, 219);
    check_normal(front, half / 0.7176, 1, 1, "w = 1: green leans along normal x tangent");
    set_sides(-1, -1, -1);
    check_normal(front, half / 0.7176, -1, 1, "w = -1: the other way");
    check_normal(back, -half / 0.7176, 1, -1, "and turned round from behind");
    st.uvs[0] = 1, st.uvs[2] = 0, st.uvs[4] = 1;
    check_normal(front, half / 0.7176, -1, 1, "a mirrored image changes nothing");
    for (int k = 0; k < 6; ++k) {
        st.uvs[k] = 0.3f;
    }
    check_normal(front, half / 0.7176, -1, 1, "nor do coordinates at one point");
    st.mesh.uvs = NULL;
    check_normal(front, half / 0.7176, -1, 1, "nor a mesh without any");
    st.positions[0] = st.positions[6] = -8;
    st.instance.to_world = mirror;
    check_normal(front, -half / 0.7176, -1, 1, "a mirrored node mirrors red and leaves green");
    set_sides(1, -1, -1);
    st.instance.to_world = (lmb_mat4){{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    st.positions[0] = st.positions[6] = -4;
    check_normal(front, half / 0.7176, -1.0 / 3, 1, "corners that differ mix");
    st.mesh.tangent_format = 2;
    CHECK(lmb_scene_check(&st.scene) == LMB_ERR_FORMAT);
}

/* However far a map leans, the normal stays on the viewer's side of the face. */
static void test_rise(void)
{
    static const uint8_t codes[6][3] = {{255, 0, 0},   {0, 0, 0},       {255, 255, 0},
                                        {128, 128, 0}, {255, 128, 128}, {0, 255, 100}};
    set_stage();
    for (int i = 0; i < 12; ++i) {
        lmb_vec3 face, n;
        set_map(codes[i % 6][0], codes[i % 6][1], codes[i % 6][2]);
        n = look(&face, vec(0.5f, 0.25f, i < 6 ? 5.0f : -5.0f));
        CHECK(n.x * face.x + n.y * face.y + n.z * face.z > 0.0098f);
        CHECK(fabsf(n.x * n.x + n.y * n.y + n.z * n.z - 1.0f) < 1e-5f);
    }
}

typedef struct vector {
    double x, y, z;
} vector;

static vector mix(vector a, double s, vector b)
{
    vector v = {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
    return v;
}

static vector cross(vector a, vector b)
{
    vector v = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return v;
}

static double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static vector unit(vector a)
{
    const vector none = {0, 0, 0};
    return mix(none, 1 / sqrt(dot(a, a)), a);
}

static vector position_of(int k)
{
    const float *p = st.positions + 3 * k;
    vector v = {(double)p[0], (double)p[1], (double)p[2]};
    return v;
}

/* The texture directions, solved from P = P0 + u dP/du + v dP/dv. */
static vector expected(vector n, const double code[3])
{
    double du1 = (double)st.uvs[2] - (double)st.uvs[0], dv1 = (double)st.uvs[3] - (double)st.uvs[1];
    double du2 = (double)st.uvs[4] - (double)st.uvs[0], dv2 = (double)st.uvs[5] - (double)st.uvs[1];
    double area = du1 * dv2 - du2 * dv1;
    vector none = {0, 0, 0}, e1 = mix(position_of(1), -1, position_of(0)), e2 = mix(position_of(2), -1, position_of(0));
    vector along_u = mix(mix(none, dv2 / area, e1), -dv1 / area, e2),
           along_v = mix(mix(none, du1 / area, e2), -du2 / area, e1);
    vector t = unit(mix(along_u, -dot(along_u, n), n)), b = cross(n, t);
    b = dot(b, along_v) > 0 ? mix(none, -1, b) : b;
    return unit(mix(mix(mix(none, code[0], t), code[1], b), code[2], n));
}

static void test_any_triangle(void)
{
    test_rng rng = {77};
    double worst = 0;
    int tried = 0;
    for (int i = 0; i < 3000; ++i) {
        double code[3];
        lmb_vec3 face, got;
        uint8_t map[3];
        set_stage();
        for (int k = 0; k < 9; ++k) {
            st.positions[k] += test_uniform(&rng, -2.0f, 2.0f);
        }
        for (int k = 0; k < 6; ++k) {
            st.uvs[k] = test_uniform(&rng, -3.0f, 3.0f);
        }
        for (int k = 0; k < 3; ++k) {
            map[k] = (uint8_t)(k == 2 ? 200 + test_random(&rng) % 56 : 64 + test_random(&rng) % 128);
            code[k] = map[k] / 127.5 - 1;
        }
        double area = ((double)st.uvs[2] - (double)st.uvs[0]) * ((double)st.uvs[5] - (double)st.uvs[1]) -
                      ((double)st.uvs[4] - (double)st.uvs[0]) * ((double)st.uvs[3] - (double)st.uvs[1]);
        set_map(map[0], map[1], map[2]);
        got = look(&face, vec(0, 0, 9));
        if (fabs(area) < 0.05) {
            continue;
        }
        vector n = {(double)face.x, (double)face.y, (double)face.z}, want = expected(n, code);
        if (dot(want, n) < 0.011) {
            continue;
        }
        vector given = {(double)got.x, (double)got.y, (double)got.z}, off = mix(given, -1, want);
        worst = fmax(worst, sqrt(dot(off, off)));
        ++tried;
    }
    CHECK(tried > 2500);
    CHECK_MSG(worst < 2e-5, "off the formula by up to %g", worst);
}

static void test_checks(void)
{
    uint8_t texels[4 * (4 + 1 + 1)] = {0, 255, 128, 255, 0, 255, 128, 255, 255, 0, 129, 255, 255, 0, 129, 255};
    set_stage();
    lmb_scene_bounds(&st.scene.bounds_min, &st.scene.bounds_max, &st.scene);
    CHECK(lmb_scene_check(&st.scene) == LMB_OK);
    st.material.normal_map = 1;
    CHECK(lmb_scene_check(&st.scene) == LMB_ERR_SCENE);
    st.material.normal_scale = 0.0f;
    CHECK(lmb_scene_check(&st.scene) == LMB_OK);
    st.material.normal_scale = NAN;
    CHECK(lmb_scene_check(&st.scene) == LMB_ERR_ARG);
    st.material.normal_scale = 0.0f;
    st.mesh.tangents = (const int16_t *)(const void *)((const char *)st.tangents + 2);
    CHECK(lmb_scene_check(&st.scene) == LMB_ERR_ALIGN);
    CHECK(lmb_normal_map_mips(texels, 2, 2, 2) == LMB_OK && texels[16] == 128 && texels[17] == 128 &&
          texels[18] == 129);
    CHECK(lmb_normal_map_mips(NULL, 2, 2, 2) == LMB_ERR_ARG && lmb_normal_map_mips(texels, 2, 2, 9) == LMB_ERR_ARG);
}

void test_normal_map(void)
{
    test_axes();
    test_transforms();
    test_tangents();
    test_sides();
    test_rise();
    test_any_triangle();
    test_checks();
}
