/* test_shape.c: tests meshes that glTF animations reshape: two skins, morph weights, and both at once. */
#include <math.h>
#include <stdio.h>

#include "../../tools/model/model_shape.h"
#include "../blob.h"
#include "../model_case.h"

void test_shape(void);

static char text[1 << 14];

/* A joint at 0, and one 1 m above it that turns by -90 degrees about Z in one second. A triangle with corners at 0, 2 m
 * above, and next to that. The offsets of two morph targets. */
static const float numbers[] = {
    0, 1,                                                    /* 0: times */
    0, 0, 0, 1, 0, 0, -0.70710678f, 0.70710678f,             /* 8: turns */
    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,          /* 40: inverse bind */
    1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1,
    0, 0, 0, 0, 2, 0, 1, 2, 0,                               /* 168: positions */
    0, 0, 1, 0, 1, 0, 0, 0.8f, 0.6f,                         /* 204: normals */
    1, 0, 0, 0, 0.5f, 1.5f, 0, 0, 3, 0, 0, 0,                /* 240: weights of the second skin, not of sum 1 */
    1, 0, 0, 1, 0, 0, 1, 0, 0,                               /* 288: first target, positions */
    1, 0, -1, 0, 0, 0, 0, 0, 0,                              /* 324: normals of the first target */
    0, 0, 2, 0, 0, 2, 0, 0, 2,                               /* 360: second target */
    0, 0, 1, 0.5f,                                           /* 396: weights, linear */
    0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0};                     /* 412: weights, cubic: 0, with a tangent of 4 */
enum { NUMBERS = sizeof numbers / sizeof *numbers };
/* 460: joints of the first skin; 472: weights of the first skin; 484: joints of the second; 508: weights as normalized
 * integers. */

#define VIEW(offset, bytes) "{\"buffer\":0,\"byteOffset\":" #offset ",\"byteLength\":" #bytes "}"
#define ACCESSOR(view, component, count, type) \
    "{\"bufferView\":" #view ",\"componentType\":" #component ",\"count\":" #count ",\"type\":\"" type "\"}"
#define CODES(view, component, count, type)                                                               \
    "{\"bufferView\":" #view ",\"componentType\":" #component ",\"normalized\":true,\"count\":" #count \
    ",\"type\":\"" type "\"}"
#define SKINNED(joints, weights) \
    "\"attributes\":{\"POSITION\":3,\"NORMAL\":4,\"JOINTS_0\":" #joints ",\"WEIGHTS_0\":" #weights "}"
#define TARGETS "\"targets\":[{\"POSITION\":6,\"NORMAL\":7},{\"POSITION\":8}]"
#define SCENE                                                                                                        \
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,2,3,4,5,6]}],"                                      \
    "\"nodes\":[{\"children\":[1]},{\"translation\":[0,1,0]},{\"mesh\":0,\"skin\":0,\"translation\":[9,9,9]},"      \
    "{\"mesh\":1,\"skin\":1},{\"mesh\":2,\"translation\":[5,0,0]},{\"mesh\":2},"                                     \
    "{\"mesh\":3,\"skin\":0,\"weights\":[0,0.25]}],"                                                                 \
    "\"skins\":[{\"joints\":[0,1],\"inverseBindMatrices\":2},{\"joints\":[1,0]}],"                                   \
    "\"meshes\":[{\"primitives\":[{" SKINNED(11, 12) "}]},{\"primitives\":[{" SKINNED(13, 5) "}]},"                  \
    "{\"weights\":[0,0],\"primitives\":[{\"attributes\":{\"POSITION\":3,\"NORMAL\":4}," TARGETS "}]},"               \
    "{\"primitives\":[{" SKINNED(11, 12) "," TARGETS "}]}],"                                                         \
    "\"accessors\":[" ACCESSOR(0, 5126, 2, "SCALAR") "," ACCESSOR(1, 5126, 2, "VEC4") ","                            \
    ACCESSOR(2, 5126, 2, "MAT4") "," ACCESSOR(3, 5126, 3, "VEC3") "," ACCESSOR(4, 5126, 3, "VEC3") ","               \
    ACCESSOR(5, 5126, 3, "VEC4") "," ACCESSOR(6, 5126, 3, "VEC3") "," ACCESSOR(7, 5126, 3, "VEC3") ","               \
    ACCESSOR(8, 5126, 3, "VEC3") "," ACCESSOR(9, 5126, 4, "SCALAR") "," ACCESSOR(10, 5126, 12, "SCALAR") ","         \
    ACCESSOR(11, 5121, 3, "VEC4") "," CODES(12, 5121, 3, "VEC4") "," ACCESSOR(13, 5123, 3, "VEC4") ","               \
    CODES(14, 5120, 4, "SCALAR") "],"                                                                                \
    "\"bufferViews\":[" VIEW(0, 8) "," VIEW(8, 32) "," VIEW(40, 128) "," VIEW(168, 36) "," VIEW(204, 36) ","         \
    VIEW(240, 48) "," VIEW(288, 36) "," VIEW(324, 36) "," VIEW(360, 36) "," VIEW(396, 16) "," VIEW(412, 48) ","      \
    VIEW(460, 12) "," VIEW(472, 12) "," VIEW(484, 24) "," VIEW(508, 4) "],"                                          \
    "\"animations\":[{%s}],\"buffers\":[{\"byteLength\":512,\"uri\":\"data:application/octet-stream;base64,%s\"}]}"
#define CHANNEL(sampler, node, path) "{\"sampler\":" #sampler ",\"target\":{\"node\":" #node ",\"path\":\"" path "\"}}"
#define SAMPLER(output, way) "{\"input\":0,\"output\":" #output ",\"interpolation\":\"" way "\"}"
#define ALL                                                                                                          \
    "\"channels\":[" CHANNEL(0, 1, "rotation") "," CHANNEL(1, 4, "weights") "," CHANNEL(2, 6, "weights") "],"        \
    "\"samplers\":[" SAMPLER(1, "LINEAR") "," SAMPLER(9, "LINEAR") "," SAMPLER(10, "CUBICSPLINE") "]"

static const char *coded(void)
{
    static const uint8_t joints[12] = {0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    static const uint8_t weights[12] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0};
    static const uint8_t far_joints[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, codes[4] = {0, 0, 127, 129};
    static blob b;
    b.size = 0;
    put_floats(&b, numbers, NUMBERS);
    for (int i = 0; i < 12; ++i)
        put_u8(&b, joints[i]);
    for (int i = 0; i < 12; ++i)
        put_u8(&b, weights[i]);
    for (int i = 0; i < 12; ++i)
        put_u16(&b, far_joints[i]);
    for (int i = 0; i < 4; ++i)
        put_u8(&b, codes[i]);
    CHECK(b.size == 512);
    return base64(b.bytes, b.size);
}

static int load(const char *animations)
{
    const int n = snprintf(text, sizeof text, SCENE, animations, coded());
    CHECK(n > 0 && n < (int)sizeof text);
    forget();
    return model_read(&loaded, "a.gltf", NULL, (const uint8_t *)text, (size_t)n, &notes, &problem);
}

static void pose(double time_s)
{
    static lmb_instance instance[5];
    memcpy(instance, loaded.scene.instances, sizeof instance);
    CHECK(model_pose(instance, NULL, NULL, &loaded, time_s));
    model_pose_shapes(&loaded, time_s);
}

static const lmb_mesh *mesh_of(uint32_t instance) { return &loaded.scene.meshes[loaded.scene.instances[instance].mesh]; }

static int is_at(uint32_t instance, uint32_t vertex, double x, double y, double z)
{
    const float *p = (const float *)mesh_of(instance)->positions + 3 * (size_t)vertex;
    const int ok = fabs((double)p[0] - x) < 1e-5 && fabs((double)p[1] - y) < 1e-5 && fabs((double)p[2] - z) < 1e-5;
    CHECK_MSG(ok, "instance %u, vertex %u: %g %g %g", (unsigned)instance, (unsigned)vertex, (double)p[0], (double)p[1],
              (double)p[2]);
    return ok;
}

static int faces(uint32_t instance, uint32_t vertex, double x, double y, double z)
{
    const lmb_vec3 n = lmb_octahedral_decode(mesh_of(instance)->normals + 2 * (size_t)vertex);
    return fabs((double)n.x - x) < 1e-4 && fabs((double)n.y - y) < 1e-4 && fabs((double)n.z - z) < 1e-4;
}

/* In the order of the file: skin 0, skin 1, the mesh with weights, the same mesh without animation, skin 0 with
 * weights. */
static void moves_all(void)
{
    const double half = sqrt(0.5);
    CHECK_LOADS(load(ALL));
    CHECK_MSG(loaded.motion != NULL && loaded.motion->shapes != NULL, "%s", loaded.motion_problem.text);
    CHECK(loaded.motion->shapes->count == 4 && !loaded.motion->reshapes[3] && loaded.motion->tracks == 1);
    is_at(0, 1, 0, 2, 0); /* the position in the file */
    pose(1.0);
    is_at(0, 0, 0, 0, 0);
    is_at(0, 1, 1, 1, 0);
    is_at(0, 2, 1, 0, 0);
    CHECK(faces(0, 0, 0, 0, 1) && faces(0, 1, 1, 0, 0) && faces(0, 2, 0.8, 0, 0.6));
    is_at(1, 0, 0, 0, 0); /* joint 1 of the second skin is the first node; without bind matrices */
    is_at(1, 1, 0.25 * 2, 0.25 * 1 + 0.75 * 2, 0);
    is_at(1, 2, 2, 0, 0);
    is_at(2, 0, 1, 0, 1);
    is_at(2, 2, 2, 2, 1);
    CHECK(faces(2, 0, 1, 0, 0) && faces(2, 1, 0, 1, 0));
    is_at(3, 0, 0, 0, 0);
    is_at(3, 2, 1, 2, 0);
    pose(0.5);
    is_at(0, 1, half, 1 + half, 0);
    is_at(2, 0, 0.5, 0, 0.5);
    is_at(4, 0, 0.5, 0, 0); /* the first target with weight 4 u (1 - u)^2, then the skin */
    is_at(4, 1, 1.0 * half + 0.5 * half, 1 + 1.0 * half - 0.5 * half, 0);
    CHECK(faces(4, 0, half, 0, half)); /* 0.5, 0, 0.5 at the joint that does not move */
    pose(1e9);
    is_at(0, 1, 1, 1, 0);
    pose(0.0);
    is_at(0, 1, 0, 2, 0);
    is_at(2, 0, 0, 0, 0);
}

/* Only weights, with STEP and as normalized integers: the skins do not move, and their weights at rest are those of the
 * node. */
static void moves_weights(void)
{
    CHECK_LOADS(load("\"channels\":[" CHANNEL(0, 4, "weights") "],\"samplers\":[" SAMPLER(14, "STEP") "]"));
    CHECK(loaded.motion != NULL && loaded.motion->shapes != NULL && loaded.motion->shapes->count == 1);
    pose(0.99);
    is_at(2, 0, 0, 0, 0);
    pose(1.0);
    is_at(2, 0, 1, 0, -2);
    is_at(3, 0, 0, 0, 0);
    CHECK_LOADS(load("\"channels\":[" CHANNEL(0, 1, "rotation") "],\"samplers\":[" SAMPLER(1, "STEP") "]"));
    CHECK(loaded.motion != NULL && loaded.motion->shapes != NULL && loaded.motion->shapes->count == 3);
    pose(1.0);
    is_at(4, 0, 0, 0, 0.5);
    is_at(4, 1, 1, 1, 0.5);
}

static void refuses(void)
{
    CHECK_LOADS(load("\"channels\":[" CHANNEL(0, 4, "weights") "],\"samplers\":[" SAMPLER(9, "CUBICSPLINE") "]"));
    CHECK(loaded.motion == NULL && strstr(loaded.motion_problem.text, "4 values for 2 keys") != NULL);
    CHECK_LOADS(load("\"channels\":[" CHANNEL(0, 2, "weights") "," CHANNEL(0, 0, "pointer") "],\"samplers\":["
                           SAMPLER(9, "LINEAR") "]"));
    CHECK(loaded.motion == NULL && loaded.motion_problem.text[0] == '\0' && loaded.idle_channels == 2);
}

void test_shape(void)
{
    moves_all();
    moves_weights();
    refuses();
    forget();
}
