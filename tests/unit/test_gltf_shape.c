/* test_gltf_shape.c: tests glTF tangents and their sides, normals without length, morph targets at rest, hidden nodes,
 * nodes of scale 0, and materials with other extensions. */
#include <math.h>
#include <stdio.h>

#include "../../tools/model/model_morph.h"
#include "../../tools/model/model_shape.h"
#include "../../tools/picture/image.h"
#include "../../tools/picture/io_png.h"
#include "../blob.h"
#include "../model_case.h"

void test_gltf_shape(void);

static int near(double a, double b) { return fabs(a - b) <= 2e-4; }

static int is_vec(lmb_vec3 v, double x, double y, double z)
{
    return near((double)v.x, x) && near((double)v.y, y) && near((double)v.z, z);
}

/* Float vectors from byte 0, as accessors with three each: 0 positions, 1 normals, 2 more positions, 3 more normals, 4
 * tangents of four, 5 texture coordinates, 6 tangent offsets, 7 offsets of the second target, sparse. */
static const float numbers[] = {
    0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, -1, 1, 0, -1, 1, 0, -1,
    1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, -1, 1, 0, -1, 1, 0, -1, 1, 0};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

#define FLOATS(offset, type) \
    "{\"bufferView\":0,\"byteOffset\":" #offset ",\"componentType\":5126,\"count\":3,\"type\":\"" type "\"}"
#define ASSET "{\"asset\":{\"version\":\"2.0\"},"
#define DATA                                                                                                        \
    "\"accessors\":[" FLOATS(0, "VEC3") "," FLOATS(36, "VEC3") "," FLOATS(72, "VEC3") "," FLOATS(108, "VEC3") ","     \
    FLOATS(144, "VEC4") "," FLOATS(192, "VEC2") "," FLOATS(216, "VEC3") ","                                          \
    "{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":1,"    \
    "\"componentType\":5121},\"values\":{\"bufferView\":0,\"byteOffset\":72}}},"                                      \
    "{\"bufferView\":2,\"componentType\":5120,\"count\":3,\"type\":\"VEC3\",\"normalized\":true}],"                   \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":252},{\"buffer\":0,\"byteOffset\":252,\"byteLength\":1},"            \
    "{\"buffer\":0,\"byteOffset\":256,\"byteLength\":12,\"byteStride\":4}],"                                          \
    "\"buffers\":[{\"byteLength\":268,\"uri\":\"data:;base64,%s\"}]}"

/* Index 2 in two bytes, then the offsets of a target as bytes: (127, 0, 0) at each vertex. */
static const char *data_with(int at, float instead)
{
    static char coded[2048];
    static blob b;
    float v[NUMBERS];
    memset(&b, 0, sizeof b);
    memcpy(v, numbers, sizeof v);
    for (int k = 0; at >= 0 && k < 3; ++k)
        v[at + k] = instead;
    put_floats(&b, v, NUMBERS);
    put_u32(&b, 2);
    for (int k = 0; k < 3; ++k)
        put_u32(&b, 127);
    snprintf(coded, sizeof coded, "%s", base64(b.bytes, b.size));
    return coded;
}

static const char *data(void) { return data_with(-1, 0); }

static lmb_vec3 normal(uint32_t mesh, uint32_t vertex)
{
    const int16_t *n = loaded.scene.meshes[mesh].normals;
    return n ? lmb_octahedral_decode(n + 2 * (size_t)vertex) : (lmb_vec3){0, 0, 0};
}

static lmb_vec3 tangent(uint32_t mesh, uint32_t vertex)
{
    const int16_t *t = loaded.scene.meshes[mesh].tangents;
    return t ? lmb_octahedral_decode(t + 2 * (size_t)vertex) : (lmb_vec3){0, 0, 0};
}

static lmb_vec3 position(uint32_t mesh, uint32_t vertex)
{
    const float *p = (const float *)loaded.scene.meshes[mesh].positions + 3 * (size_t)vertex;
    return (lmb_vec3){p[0], p[1], p[2]};
}

/* --- tangents --- */

#define MAPPED(attributes, texture)                                                                                  \
    ASSET "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0" attributes "},"       \
          "\"material\":0}]}],\"materials\":[{\"normalTexture\":{\"index\":0" texture "}}],\"textures\":[{\"source\":0}],"  \
          "\"images\":[{\"uri\":\"data:;base64,%s\"}]," DATA

static const char *flat_map(void)
{
    static blob b;
    static char coded[256];
    static const uint8_t rgb[] = {128, 128, 255};
    file_bytes png = {NULL, 0};
    CHECK(png_encode(&png, rgb, 1, 1, &problem));
    memcpy(b.bytes, png.data, png.size);
    b.size = png.size;
    file_free(&png);
    snprintf(coded, sizeof coded, "%s", base64(b.bytes, b.size));
    return coded;
}

/* The sign is kept with the direction for any texture transform. Without normals there are no tangents. */
static void keeps_sides(void)
{
    const lmb_mesh *m;
    CHECK_LOADS(load_gltf(MAPPED(",\"NORMAL\":1,\"TANGENT\":4,\"TEXCOORD_0\":5", ""), flat_map(), data()));
    m = loaded.scene.meshes;
    CHECK(m->tangents != NULL && m->tangent_format == LMB_TANGENT_SIDED);
    for (uint32_t i = 0; m->tangents != NULL && i < 3; ++i)
        CHECK(is_vec(tangent(0, i), 1, 0, 0) && model_side_of(m->tangents + 2 * i) == (i < 2));
    CHECK_LOADS(load_gltf(MAPPED(",\"NORMAL\":1,\"TANGENT\":4,\"TEXCOORD_0\":5",
                            ",\"extensions\":{\"KHR_texture_transform\":{\"scale\":[-1,1]}}"), flat_map(), data()));
    CHECK(loaded.scene.meshes[0].tangents != NULL && model_side_of(loaded.scene.meshes[0].tangents));
    CHECK_LOADS(load_gltf(MAPPED(",\"TANGENT\":4,\"TEXCOORD_0\":5", ""), flat_map(), data()));
    CHECK(loaded.scene.meshes[0].tangents == NULL);
}

/* Every code has a neighbour with each sign within an angle of 1e-4. */
static void sides_turn_little(void)
{
    for (int i = 0; i < 200; ++i) {
        const double a = 0.37 * i, z = i / 100.0 - 0.995, s = sqrt(1 - z * z);
        const lmb_vec3 v = {(float)(s * cos(a)), (float)(s * sin(a)), (float)z};
        for (int side = 0; side < 2; ++side) {
            int16_t code[2];
            lmb_octahedral_encode(code, v);
            model_set_side(code, side);
            const lmb_vec3 back = lmb_octahedral_decode(code);
            CHECK(model_side_of(code) == side && fabs((double)(back.x - v.x)) < 1e-4 && fabs((double)(back.y - v.y)) < 1e-4 &&
                  fabs((double)(back.z - v.z)) < 1e-4);
        }
    }
}

/* --- normals --- */

#define TWO_FACES                                                                                                   \
    ASSET "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}},"      \
          "{\"attributes\":{\"POSITION\":2,\"NORMAL\":1}}]}]," DATA

static void fills_normals(void)
{
    float tilted[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    blob b;
    CHECK_LOADS(load_gltf(TWO_FACES, data_with(12, 0)));
    CHECK(is_vec(normal(0, 0), 0, 0, 1) && is_vec(normal(0, 1), 0, 0, 1));
    CHECK(noted("normals without length, made from the faces there: 1"));
    CHECK_LOADS(load_gltf(TWO_FACES, data_with(9, NAN)));
    CHECK(is_vec(normal(0, 0), 0, 0, 1) && noted("faces there: 1"));
    /* The face points along (1, 1, 1). */
    memset(&b, 0, sizeof b);
    put_floats(&b, tilted, 9);
    put_floats(&b, numbers + 9, 6);
    put_floats(&b, (const float[3]){0, 0, 0}, 3);
    put_floats(&b, numbers + 18, NUMBERS - 18);
    put_u32(&b, 2);
    put_u32(&b, 127), put_u32(&b, 127), put_u32(&b, 127);
    CHECK_LOADS(load_gltf(TWO_FACES, base64(b.bytes, b.size)));
    CHECK(is_vec(normal(0, 2), sqrt(1 / 3.0), sqrt(1 / 3.0), sqrt(1 / 3.0)) && is_vec(normal(0, 1), 0, 0, 1));
    /* No normal has a length. */
    memset(b.bytes + 36, 0, 36);
    CHECK_LOADS(load_gltf(TWO_FACES, base64(b.bytes, b.size)));
    CHECK(is_vec(normal(0, 0), sqrt(1 / 3.0), sqrt(1 / 3.0), sqrt(1 / 3.0)) && noted("faces there: "));
}

/* --- morph targets --- */

#define SHAPED(weights, nodes, target)                                                                               \
    ASSET "\"nodes\":[" nodes "],\"scenes\":[{\"nodes\":[0,1]}],\"meshes\":[{" weights "\"primitives\":[{"               \
          "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TANGENT\":4,\"TEXCOORD_0\":5},\"material\":0,"                  \
          "\"targets\":[{},{" target "}]}]}],\"materials\":[{\"normalTexture\":{\"index\":0}}],"                         \
          "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:;base64,%s\"}]," DATA
#define TWO "{\"mesh\":0},{\"mesh\":0,\"translation\":[0,0,5]}"
#define ALL "\"POSITION\":2,\"NORMAL\":3,\"TANGENT\":6"

static void shapes_by_weights(void)
{
    CHECK_LOADS(load_gltf(SHAPED("\"weights\":[0.3,0.5],", TWO, ALL), flat_map(), data()));
    CHECK(loaded.scene.mesh_count == 1 && is_vec(position(0, 1), 1.5, 0, 0) && is_vec(position(0, 2), 0.5, 1, 0));
    CHECK(is_vec(normal(0, 0), sqrt(0.5), 0, sqrt(0.5)) && is_vec(tangent(0, 2), sqrt(0.5), sqrt(0.5), 0));
    CHECK(model_side_of(loaded.scene.meshes[0].tangents) && !model_side_of(loaded.scene.meshes[0].tangents + 4));
    CHECK(!noted("morph"));
    /* A node's weights override those of the mesh, for this node only. Weights missing in the node are 0. */
    CHECK_LOADS(load_gltf(SHAPED("\"weights\":[0,1],", "{\"mesh\":0,\"weights\":[1]},{\"mesh\":0}", ALL), flat_map(), data()));
    CHECK(loaded.scene.instance_count == 2 && loaded.scene.mesh_count == 2);
    CHECK(is_vec(position(loaded.scene.instances[0].mesh, 1), 1, 0, 0));
    CHECK(is_vec(position(loaded.scene.instances[1].mesh, 1), 2, 0, 0));
    CHECK(is_vec(normal(loaded.scene.instances[1].mesh, 1), 1, 0, 0));
    CHECK_LOADS(load_gltf(SHAPED("", "{\"mesh\":0,\"weights\":[0,-2]},{\"mesh\":0}", ALL), flat_map(), data()));
    CHECK(is_vec(position(loaded.scene.instances[0].mesh, 0), -2, 0, 0) && loaded.scene.instances[0].to_world.m[0] == 1);
    CHECK(is_vec(position(loaded.scene.instances[1].mesh, 0), 0, 0, 0));
    /* Sparse, without a buffer view; and as bytes. */
    CHECK_LOADS(load_gltf(SHAPED("\"weights\":[0,1],", TWO, "\"POSITION\":7"), flat_map(), data()));
    CHECK(is_vec(position(0, 1), 1, 0, 0) && is_vec(position(0, 2), 1, 1, 0) && is_vec(normal(0, 2), 0, 0, 1));
    CHECK_LOADS(load_gltf(SHAPED("\"weights\":[0,0.25],", TWO, "\"POSITION\":8"), flat_map(), data()));
    CHECK(is_vec(position(0, 1), 1.25, 0, 0));
    /* Other attributes of a target do not change, and a note reports them. */
    CHECK_LOADS(load_gltf(SHAPED("\"weights\":[0,1],", TWO, "\"POSITION\":2,\"TEXCOORD_0\":5"), flat_map(), data()));
    CHECK(noted("primitives whose morph targets move colours or texture coordinates, which stay: 1"));
    check_fails(load_gltf(SHAPED("\"weights\":[0,1],", TWO, "\"POSITION\":5"), flat_map(), data()), "does not take");
    check_fails(load_gltf(SHAPED("\"weights\":[0,{}],", TWO, ALL), flat_map(), data()), "weights[1]");
}

/* Morph targets are applied first, then the skin: joint 0 moves all by 10 along x. */
static void shapes_before_it_poses(void)
{
    CHECK_LOADS(load_gltf(ASSET "\"nodes\":[{\"mesh\":0,\"skin\":0,\"weights\":[1]},{\"translation\":[10,0,0]}],"
                           "\"skins\":[{\"joints\":[1]}],\"scenes\":[{\"nodes\":[0,1]}],\"meshes\":[{\"primitives\":[{"
                           "\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":2}]}]}]," DATA, data()));
    CHECK(is_vec(position(loaded.scene.instances[0].mesh, 1), 12, 0, 0));
}

/* --- nodes --- */

#define LAMP "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}"
#define LAMPS "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"directional\"}]}},"
#define EYES "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"
#define HIDDEN "\"KHR_node_visibility\":{\"visible\":false}"

static void hides(void)
{
    CHECK_LOADS(load_gltf(ASSET "\"extensionsRequired\":[\"KHR_node_visibility\"]," LAMPS EYES
                           "\"scenes\":[{\"nodes\":[0,4]}],\"nodes\":[{\"children\":[1,2,3],\"extensions\":{" HIDDEN "}},"
                           "{\"mesh\":0,\"extensions\":{\"KHR_node_visibility\":{\"visible\":true}}},{" LAMP "},"
                           "{\"camera\":0},{\"mesh\":0,\"children\":[5]},{" LAMP "}],"
                           "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]," DATA, data()));
    CHECK(loaded.scene.instance_count == 1 && loaded.scene.light_count == 1 && loaded.camera_count == 1);
    check_fails(load_gltf(ASSET "\"nodes\":[{\"extensions\":{\"KHR_node_visibility\":{\"visible\":0}}}]}"), "visible");
}

/* --- instances of a node --- */

#define CROWD(members, attributes)                                                                                   \
    ASSET "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],\"nodes\":[{\"mesh\":0,\"translation\":[10,0,0],"        \
          "\"scale\":[2,2,2]," members "\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{" attributes          \
          "}}}},{}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":2}]},"          \
          "{\"attributes\":{\"POSITION\":2},\"targets\":[{\"POSITION\":2}]}]}],"

/* Numbers 12 to 14 and 4 to 6 of an instance's transform: the place and the Y axis. */
static int is_placed(uint32_t instance, const double place[3], const double up[3])
{
    const float *m = loaded.scene.instances[instance].to_world.m;
    for (int k = 0; k < 3; ++k)
        if (!near((double)m[12 + k], place[k]) || !near((double)m[4 + k], up[k]))
            return 0;
    return 1;
}

/* Each place has all primitives. Accessor 4 holds two turns by -90 degrees about X, then one by 90. */
static void draws_crowds(void)
{
    static const double place[3][3] = {{10, 0, 0}, {12, 0, 0}, {10, 2, 0}}, up[3][3] = {{0, 0, -2}, {0, 0, -2}, {0, 0, 2}};
    CHECK_LOADS(load_gltf(CROWD("", "\"TRANSLATION\":0,\"ROTATION\":4") DATA, data()));
    CHECK(loaded.scene.instance_count == 6 && loaded.scene.mesh_count == 2);
    for (uint32_t i = 0; i < loaded.scene.instance_count; ++i)
        CHECK(is_placed(i, place[i / 2 % 3], up[i / 2 % 3]) && loaded.scene.instances[i].mesh == i % 2);
    CHECK_LOADS(load_gltf(CROWD("", "\"_ID\":0") DATA, data()));
    CHECK(loaded.scene.instance_count == 2);
    CHECK_LOADS(load_gltf(CROWD("\"skin\":0,", "\"TRANSLATION\":0") "\"skins\":[{\"joints\":[1]}]," DATA, data()));
    CHECK(loaded.scene.instance_count == 2 && noted("skinned nodes with instances (EXT_mesh_gpu_instancing), drawn once: 1"));
    check_fails(load_gltf(CROWD("", "\"ROTATION\":0") DATA, data()), "ROTATION: accessor 0 has a type");
    check_fails(load_gltf(CROWD("", "\"SCALE\":9") DATA, data()), "SCALE: index 9");
    check_fails(load_gltf(CROWD("", "\"TRANSLATION\":0") DATA, data_with(3, INFINITY)), "not finite");
    check_fails(load_gltf(CROWD("", "\"ROTATION\":1,\"SCALE\":0") "\"accessors\":[{\"componentType\":5126,\"count\":3,"
                          "\"type\":\"VEC3\"},{\"componentType\":5126,\"count\":1,\"type\":\"VEC4\"}]}"), "SCALE: 3 places, but");
    check_fails(load_gltf(CROWD("", "\"SCALE\":0") "\"accessors\":[{\"componentType\":5126,\"count\":4194305,"
                          "\"type\":\"VEC3\"}]}"), "over 4194304 places");
}

/* A small file with 240,000 instances: 20,000 places without data, 12 primitives. */
static void draws_large_crowds(void)
{
    static char text[4096] =
        ASSET "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],\"nodes\":[{\"mesh\":0,\"extensions\":{"
              "\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":4}}}}],\"meshes\":[{\"primitives\":[";
    const char *data_of = DATA, *first = strstr(data_of, "\"accessors\":[");
    CHECK(first != NULL);
    for (int i = 0; i < 12; ++i)
        strcat(text, i == 0 ? "{\"attributes\":{\"POSITION\":0}}" : ",{\"attributes\":{\"POSITION\":0}}");
    strcat(text, "]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{},{},{},"
                 "{\"componentType\":5126,\"count\":20000,\"type\":\"VEC3\"}],");
    strcat(text, strstr(data_of, "\"bufferViews\""));
    CHECK_LOADS(load_gltf(text, data()));
    CHECK(loaded.scene.instance_count == 240000);
}

#define KEYS(output, path)                                                                                           \
    "\"animations\":[{\"samplers\":[{\"input\":9,\"output\":" output "}],\"channels\":[{\"sampler\":0,\"target\":"      \
    "{\"node\":0,\"path\":\"" path "\"}}]}],"

/* The places follow a moving node, and each place has a mesh that changes shape. Accessor 9: 0 and 1. */
static void moves_crowds(void)
{
    static char text[4096];
    lmb_instance moved[6];
    for (int shape = 0; shape < 2; ++shape) {
        snprintf(text, sizeof text, "%s", shape ? CROWD("", "\"TRANSLATION\":0") KEYS("9", "weights") DATA
                                                : CROWD("", "\"TRANSLATION\":0") KEYS("10", "translation") DATA);
        char *end = strstr(text, "}],\"bufferViews\"");
        CHECK(end != NULL);
        static char whole[5120];
        snprintf(whole, sizeof whole, "%.*s},{\"bufferView\":0,\"byteOffset\":8,\"componentType\":5126,\"count\":2,"
                 "\"type\":\"SCALAR\"},{\"bufferView\":0,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"%s",
                 (int)(end - text), text, end);
        CHECK_LOADS(load_gltf(whole, data()));
        const struct model_motion *m = loaded.motion;
        CHECK_MSG(m != NULL, "%s", loaded.motion_problem.text);
        if (m == NULL || loaded.scene.instance_count != 6)
            continue;
        if (shape == 0) {
            memcpy(moved, loaded.scene.instances, sizeof moved);
            CHECK(model_pose(moved, NULL, NULL, &loaded, 1));
            for (int i = 0; i < 6; ++i)
                CHECK(near((double)moved[i].to_world.m[12], i / 2 == 1 ? 3 : 1));
            continue;
        }
        CHECK(m->shapes != NULL && m->shapes->count == 6);
        for (uint32_t i = 0; m->shapes != NULL && i < m->shapes->count; ++i)
            CHECK(m->shapes->shape[i].vertices == 3 && m->shapes->shape[i].rest_positions[0] == (float)(i % 2));
    }
}

/* A quarter turn about Y, below scales that leave only one axis or none. */
static void keeps_directions(void)
{
    static const char *const above[] = {
        "\"scale\":[0,0,0]", "\"scale\":[0,1,0]", "\"scale\":[0,0,1]", "\"scale\":[1e-40,1e-40,1e-40]",
        "\"matrix\":[0,0,0,0,0,0,0,0,0,0,0,0,3,4,5,1]", "\"matrix\":[0,0,0,0,0,2,0,0,0,0,0,0,3,4,5,1]",
        "\"scale\":[1e-18,1e-18,1e-18]", "\"scale\":[1e18,1e18,1e18]"};
    for (int i = 0; i < (int)(sizeof above / sizeof *above); ++i) {
        CHECK_LOADS(load_gltf(ASSET LAMPS EYES "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{%s%s,\"children\":[1]},"
                               "{\"rotation\":[0,0.70710678,0,0.70710678],\"camera\":0," LAMP "}]}", above[i],
                         strstr(above[i], "matrix") ? "" : ",\"translation\":[3,4,5]"));
        CHECK_MSG(is_vec(loaded.scene.lights[0].direction, -1, 0, 0), "light below %s", above[i]);
        CHECK_MSG(is_vec(loaded.cameras[0].back, 1, 0, 0) && is_vec(loaded.cameras[0].up, 0, 1, 0) &&
                      is_vec(loaded.cameras[0].right, 0, 0, -1), "camera below %s", above[i]);
        CHECK(is_vec(loaded.cameras[0].eye, 3, 4, 5) && is_vec(loaded.scene.lights[0].position, 3, 4, 5));
    }
    CHECK_LOADS(load_gltf(ASSET LAMPS "\"nodes\":[{\"scale\":[1,1,-1]," LAMP "}]}")); /* mirroring reverses it */
    CHECK(is_vec(loaded.scene.lights[0].direction, 0, 0, 1));
}

/* --- materials --- */

#define GLOSS "\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":[0.5,0.25,1,0.75],\"specularFactor\":[0.2,0.1,0]," \
              "\"glossinessFactor\":0.75}"

static void reads_other_materials(void)
{
    const lmb_material *m;
    CHECK_LOADS(load_gltf(ASSET "\"materials\":[{\"extensions\":{" GLOSS "}},{\"pbrMetallicRoughness\":{\"metallicFactor\":0},"
                           "\"extensions\":{" GLOSS "}},{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,1,0.25,1]},"
                           "\"normalTexture\":{\"index\":0},\"emissiveFactor\":[1,1,1],\"extensions\":{\"KHR_materials_unlit\":{}}}"
                           "],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:;base64,%s\"}]}", flat_map()));
    m = loaded.scene.materials;
    CHECK(near((double)m[0].albedo[0], 0.4) && near((double)m[0].albedo[1], 0.2) && near((double)m[0].albedo[2], 0.8));
    CHECK(m[0].alpha == 0.75f && m[1].albedo[0] == 1 && m[1].alpha == 1);
    CHECK(m[2].flags == LMB_UNLIT && m[2].albedo[0] == 0.5f && m[2].albedo[1] == 1 && m[2].albedo[2] == 0.25f);
    CHECK(m[2].emission[0] == 0 && m[2].normal_scale == 0 && noted("unlit materials, shown by their own colour"));
    CHECK(model_make_glossy(&loaded) && lmb_scene_check(&loaded.scene) == LMB_OK);
    m = loaded.scene.materials;
    CHECK(near((double)m[0].specular[0], 0.2) && m[0].specular[2] == 0 && m[0].roughness == 0.25f);
    CHECK(near((double)m[0].albedo[0], 0.4) && m[2].specular[0] == 0);
    /* Means of the map: specular in linear light, glossiness in alpha, which is 1. A metal without a lobe is not black,
     * and its diffuse texture does not darken the colour that replaces the lobe. */
    CHECK_LOADS(load_gltf(ASSET "\"materials\":[{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":"
                           "[0,0,0,1],\"specularGlossinessTexture\":{\"index\":0},\"diffuseTexture\":{\"index\":0}}}}],"
                           "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:;base64,%s\"}]}", flat_map()));
    m = loaded.scene.materials;
    CHECK(m->texture == -1 && near((double)m->albedo[0], 0.04 * 0.21586) && near((double)m->albedo[2], 0.04));
    CHECK(noted("specular-glossiness maps used by their mean") && model_make_glossy(&loaded));
    m = loaded.scene.materials;
    CHECK(near((double)m->specular[0], 0.21586) && m->specular[2] == 1 && m->roughness == 0 && m->albedo[2] == 0);
    /* A texture stays if it shows more, or if its alpha cuts holes. */
    CHECK_LOADS(load_gltf(ASSET "\"materials\":[{\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"specularFactor\":"
                           "[0.6,0.5,0.4],\"diffuseTexture\":{\"index\":0}}}},{\"alphaMode\":\"MASK\",\"extensions\":{"
                           "\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseTexture\":{\"index\":0}}}}],"
                           "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"data:;base64,%s\"}]}", flat_map()));
    m = loaded.scene.materials;
    CHECK(m[0].texture == 0 && near((double)m[0].albedo[0], 0.4) && m[1].texture == 0);
}

void test_gltf_shape(void)
{
    keeps_sides();
    sides_turn_little();
    fills_normals();
    shapes_by_weights();
    shapes_before_it_poses();
    hides();
    draws_crowds();
    draws_large_crowds();
    moves_crowds();
    keeps_directions();
    reads_other_materials();
    forget();
}
