/* test_motion.c: glTF's node animations: keys, interpolation, and refused files. */
#include <math.h>

#include "../../tools/model/model_motion.h"
#include "../blob.h"
#include "../model_case.h"

void test_motion(void);

static int is_vec(lmb_vec3 v, double x, double y, double z)
{
    return fabs((double)v.x - x) < 1e-5 && fabs((double)v.y - y) < 1e-5 && fabs((double)v.z - z) < 1e-5;
}

/* Times 0, 1 and 3; positions; rotations by 0, 90 and 180 degrees about Y; cubic keys; a triangle. */
static const float numbers[] = {0, 1, 3,
                                0, 0, 0, 2, 0, 0, 2, 4, 0,
                                0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f, 0, 1, 0, 0,
                                9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 0, 1, 2, 0, 9, 9, 9,
                                0, 0, 0, 1, 0, 0, 0, 1, 0};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

#define VIEW(offset, bytes) "{\"buffer\":0,\"byteOffset\":" #offset ",\"byteLength\":" #bytes "}"
#define FLOATS(view, count, type) \
    "{\"bufferView\":" #view ",\"componentType\":5126,\"count\":" #count ",\"type\":\"" type "\"}"
#define SCENE(animations, node)                                                                                      \
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],\"scenes\":[{\"nodes\":[0,2,3,4]}]," \
    "\"nodes\":[{\"children\":[1],\"translation\":[5,5,5]},"                                                        \
    "{\"translation\":[0,1,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},{\"camera\":0},{\"mesh\":0},"    \
    "{\"mesh\":0" node "},{\"mesh\":0}],"                                                                           \
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"spot\":{}}]}},"                       \
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"                             \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":4}}]}],"                                              \
    "\"accessors\":[" FLOATS(0, 3, "SCALAR") "," FLOATS(1, 3, "VEC3") "," FLOATS(2, 3, "VEC4") ","                    \
    FLOATS(3, 9, "VEC3") "," FLOATS(4, 3, "VEC3") "," FLOATS(1, 2, "VEC3") "," FLOATS(2, 3, "SCALAR") "],"            \
    "\"bufferViews\":[" VIEW(0, 12) "," VIEW(12, 36) "," VIEW(48, 48) "," VIEW(96, 108) "," VIEW(204, 36) "],"        \
    "\"animations\":[" animations "],\"buffers\":[{\"byteLength\":240,\"uri\":\"data:application/octet-stream;base64,%s\"}]}"
#define CHANNEL(sampler, node, path) \
    "{\"sampler\":" #sampler ",\"target\":{\"node\":" #node ",\"path\":\"" path "\"}}"
#define SAMPLER(input, output, way) "{\"input\":" #input ",\"output\":" #output way "}"
#define ALL                                                                                                         \
    "{\"channels\":[" CHANNEL(0, 0, "translation") "," CHANNEL(1, 1, "rotation") "," CHANNEL(0, 5, "translation")     \
    "],\"samplers\":[" SAMPLER(0, 1, "") "," SAMPLER(0, 2, ",\"interpolation\":\"LINEAR\"") "]},"                     \
    "{\"channels\":[" CHANNEL(1, 2, "translation") "," CHANNEL(0, 3, "translation") "," CHANNEL(0, 0, "translation")  \
    "," CHANNEL(0, 1, "weights") ",{\"sampler\":0,\"target\":{\"path\":\"scale\"}}],"                                \
    "\"samplers\":[" SAMPLER(0, 1, ",\"interpolation\":\"STEP\"") ","                                                \
    SAMPLER(0, 3, ",\"interpolation\":\"CUBICSPLINE\"") "]}"

static const char *coded(void)
{
    static blob b;
    b.size = 0;
    put_floats(&b, numbers, NUMBERS);
    return base64(b.bytes, b.size);
}

typedef struct pose {
    lmb_instance instance[2];
    lmb_light light;
    model_camera camera;
} pose;

static pose at(double time_s)
{
    pose p;
    memcpy(p.instance, loaded.scene.instances, sizeof p.instance);
    p.light = loaded.scene.lights[0];
    p.camera = loaded.cameras[0];
    CHECK(model_pose(p.instance, &p.light, &p.camera, &loaded, time_s));
    return p;
}

static lmb_vec3 place_of(const lmb_instance *i)
{
    lmb_vec3 v;
    v.x = i->to_world.m[12];
    v.y = i->to_world.m[13];
    v.z = i->to_world.m[14];
    return v;
}

static void moves_by_keys(void)
{
    const double half = sqrt(0.5);
    CHECK_LOADS(load_gltf(SCENE(ALL, ""), coded()));
    CHECK_MSG(loaded.motion != NULL, "%s", loaded.motion_problem.text);
    CHECK(loaded.motion->tracks == 4 && loaded.motion->end_s == 3.0);
    CHECK(is_vec(loaded.scene.lights[0].position, 5, 6, 5)); /* at rest as in the file */
    pose p = at(0.5);
    CHECK(is_vec(p.light.position, 1, 1, 0) && is_vec(p.light.direction, -half, 0, -half)); /* first one's, LINEAR */
    CHECK(is_vec(p.camera.eye, 0.5, 0, 0) && is_vec(p.camera.back, 0, 0, 1) && is_vec(place_of(p.instance), 0, 0, 0));
    p = at(2.0);
    CHECK(is_vec(p.light.position, 2, 3, 0) && is_vec(p.light.direction, -half, 0, half));
    CHECK(is_vec(p.camera.eye, 1, 1.5, 0) && is_vec(place_of(p.instance), 2, 0, 0));
    CHECK(is_vec(place_of(at(0.999).instance), 0, 0, 0) && is_vec(place_of(at(1.0).instance), 2, 0, 0));
    p = at(1.0);
    CHECK(is_vec(p.light.position, 2, 1, 0) && is_vec(p.light.direction, -1, 0, 0) && is_vec(p.camera.eye, 1, 0, 0));
    p = at(-1.0);
    CHECK(is_vec(p.light.position, 0, 1, 0) && is_vec(p.camera.eye, 0, 0, 0));
    p = at(1e9);
    CHECK(is_vec(p.light.position, 2, 5, 0) && is_vec(p.camera.eye, 1, 2, 0) && is_vec(place_of(p.instance), 2, 4, 0));
    CHECK(memcmp(&p.instance[1], &loaded.scene.instances[1], sizeof p.instance[1]) == 0);
    CHECK(loaded.motion->of_light[0] == 1 && loaded.motion->of_instance[1] != MODEL_NONE);
}

/* The scene still loads; the problem is stored for callers that need the motion. */
#define REFUSED(animation, node, part)                                                                       \
    do {                                                                                                     \
        CHECK_LOADS(load_gltf(SCENE(animation, node), coded()));                                                  \
        CHECK(loaded.motion == NULL && loaded.scene.instance_count == 2);                                    \
        CHECK_MSG(strstr(loaded.motion_problem.text, part) != NULL, "\"%s\"", loaded.motion_problem.text);   \
    } while (0)
#define ONE(channel, sampler) "{\"channels\":[" channel "],\"samplers\":[" sampler "]}"

static void refuses(void)
{
    REFUSED(ONE(CHANNEL(0, 0, "translation"), SAMPLER(0, 1, ",\"interpolation\":\"BEZIER\"")), "", "LINEAR, STEP or CUB");
    REFUSED(ONE(CHANNEL(0, 0, "translation"), SAMPLER(0, 5, "")), "", "2 values for 3 keys");
    REFUSED(ONE(CHANNEL(0, 0, "translation"), SAMPLER(0, 1, ",\"interpolation\":\"CUBICSPLINE\"")), "", "3 values for");
    REFUSED(ONE(CHANNEL(0, 0, "rotation"), SAMPLER(0, 1, "")), "", "accessor 1 has a type");
    REFUSED(ONE(CHANNEL(0, 0, "translation"), SAMPLER(6, 1, "")), "", "must rise from 0 on; key 1");
    REFUSED(ONE(CHANNEL(0, 0, "translation"), SAMPLER(99, 1, "")), "", "index 99");
    REFUSED(ONE(CHANNEL(3, 0, "translation"), SAMPLER(0, 1, "")), "", "index 3");
    REFUSED(ONE(CHANNEL(0, 77, "translation"), SAMPLER(0, 1, "")), "", "index 77");
    REFUSED(ONE(CHANNEL(0, 0, "translation"), "{}"), "", "needs input and output");
    REFUSED(ONE("{\"target\":{\"node\":0,\"path\":\"scale\"}}", SAMPLER(0, 1, "")), "", "a channel without a sampler");
    REFUSED(ONE(CHANNEL(0, 4, "translation"), SAMPLER(0, 1, "")), ",\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]",
            "node 4 has a matrix");
}

/* Nothing of the scene moves: no motion, and no problem. */
static void stands_still(void)
{
    CHECK_LOADS(load_gltf(SCENE("{},{\"channels\":[]}," ONE(CHANNEL(0, 5, "scale"), SAMPLER(0, 1, "")), ""), coded()));
    CHECK(loaded.motion == NULL && loaded.motion_problem.text[0] == '\0');
}

/* With a scale of 0 in a parent, lights and cameras keep the directions of their rotations. */
static void keeps_its_way(void)
{
    CHECK_LOADS(load_gltf(SCENE(ONE(CHANNEL(0, 1, "scale") "," CHANNEL(1, 0, "rotation") "," CHANNEL(0, 2, "scale"),
                               SAMPLER(0, 1, "") "," SAMPLER(0, 2, "")), ""), coded()));
    CHECK_MSG(loaded.motion != NULL, "%s", loaded.motion_problem.text);
    pose p = at(0.0);
    CHECK(is_vec(p.light.direction, 0, 0, -1) && is_vec(p.light.position, 5, 6, 5));
    CHECK(is_vec(p.camera.back, 0, 0, 1) && is_vec(p.camera.up, 0, 1, 0) && is_vec(p.camera.right, 1, 0, 0));
    p = at(1.0); /* a scale of (2, 0, 0) below a quarter turn */
    CHECK(is_vec(p.light.direction, -1, 0, 0) && is_vec(p.camera.back, 0, 0, 1));
}

void test_motion(void)
{
    moves_by_keys();
    refuses();
    stands_still();
    keeps_its_way();
    forget();
}
