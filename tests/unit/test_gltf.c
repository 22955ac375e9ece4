/* test_gltf.c: glTF's multiple scenes, normal maps and tangents, emission, skins; the converter named in errors; and
 * limits that keep a small file cheap. */
#include "../folder.h"

#include <math.h>
#include <stdarg.h>

#include "../../tools/picture/image.h"
#include "../../tools/picture/io_png.h"
#include "../blob.h"
#include "../model_case.h"

void test_gltf(void);

static char text[1 << 16];
static const char *wanted; /* scene of the next load; NULL: as the file says */

static int load(const char *format, ...)
{
    va_list args;
    int n;
    va_start(args, format);
    n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    CHECK(n > 0 && n < (int)sizeof text);
    forget();
    return model_read(&loaded, "a.gltf", wanted, (const uint8_t *)text, (size_t)n, &notes, &problem);
}

#define LOADS(...) CHECK_MSG(load(__VA_ARGS__), "%s", problem.text)

static int near(float a, double b) { return fabs((double)a - b) <= 2e-4; }

static int is_vec(lmb_vec3 v, double x, double y, double z) { return near(v.x, x) && near(v.y, y) && near(v.z, z); }

#define ASSET "{\"asset\":{\"version\":\"2.0\"},"

/* --- scenes --- */

#define THREE_SCENES \
    ASSET "\"scene\":1,\"scenes\":[{\"name\":\"day\",\"nodes\":[0]},{\"name\":\"night\",\"nodes\":[1,2]},{}]," \
          "\"nodes\":[{\"camera\":0,\"name\":\"a\"},{\"camera\":0,\"name\":\"b\"},{\"camera\":0,\"name\":\"c\"}]," \
          "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}]}"

static void scenes(void)
{
    const model_facts *f = &loaded.facts;
    LOADS(THREE_SCENES);
    CHECK(f->scenes == 3 && f->scene == 1 && strcmp(f->scene_name, "night") == 0 && loaded.camera_count == 2);
    wanted = "day";
    LOADS(THREE_SCENES);
    CHECK(f->scene == 0 && strcmp(f->scene_name, "day") == 0 && loaded.camera_count == 1);
    CHECK(strcmp(loaded.cameras[0].name, "a") == 0);
    wanted = "2";
    LOADS(THREE_SCENES);
    CHECK(f->scene == 2 && f->scene_name[0] == '\0' && loaded.camera_count == 0);
    wanted = "3";
    check_fails(load(THREE_SCENES), "no scene `3`; it has 3, numbered from 0");
    wanted = "dawn";
    check_fails(load(THREE_SCENES), "a.gltf: no scene `dawn`");
    wanted = "-1";
    check_fails(load(THREE_SCENES), "no scene `-1`");
    CHECK(!model_read(&loaded, "a.obj", "day", (const uint8_t *)"v 0 0 0\n", 8, &notes, &problem));
    wanted = NULL;
    check_fails(load(ASSET "\"scene\":3,\"scenes\":[{}]}"), "scene: index 3, but there are 1");
}

/* --- one triangle with everything a material asks for --- */

/* POSITION, NORMAL, TEXCOORD_0, TANGENT, then a 2x1 PNG of (128, 128, 255) and (255, 0, 0). */
static void put_lookable(blob *b, size_t *png_size)
{
    static const float values[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0,
                                   0, 1, 1, 0, 0, 1, 0, 3, 0, -1, 0, -2, 0, 1};
    static const uint8_t rgb[] = {128, 128, 255, 255, 0, 0};
    file_bytes png = {NULL, 0};
    put_floats(b, values, (int)(sizeof values / sizeof values[0]));
    CHECK(png_encode(&png, rgb, 2, 1, &problem));
    memcpy(b->bytes + b->size, png.data, png.size);
    b->size += png.size;
    *png_size = png.size;
    file_free(&png);
}

#define TRIANGLE \
    "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":" \
    "{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,\"TANGENT\":3},\"material\":0}]}]," \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}," \
    "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}," \
    "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}," \
    "{\"bufferView\":0,\"byteOffset\":96,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}]," \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":144},{\"buffer\":0,\"byteOffset\":144,\"byteLength\":%u}]," \
    "\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{\"wrapS\":33071}],\"images\":[{\"bufferView\":1}]," \
    "\"buffers\":[{\"byteLength\":%u,\"uri\":\"data:;base64,%s\"}],\"materials\":[{%s}]}"

static int load_look(const char *material)
{
    blob b = {{0}, 0};
    size_t png;
    put_lookable(&b, &png);
    return load(ASSET TRIANGLE, (unsigned)png, (unsigned)b.size, base64(b.bytes, b.size), material);
}

static void normal_maps(void)
{
    const lmb_material *m;
    const lmb_texture *t;
    CHECK_MSG(load_look("\"normalTexture\":{\"index\":0,\"scale\":0.5},\"pbrMetallicRoughness\":"
                        "{\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0}"), "%s", problem.text);
    m = loaded.scene.materials;
    t = loaded.scene.textures;
    CHECK(m->normal_scale == 0.5f && m->texture >= 0 && (int32_t)m->normal_map != m->texture &&
          loaded.scene.texture_count == 2);
    if (loaded.scene.texture_count == 2) {
        /* One image gives two sets of mip levels: means of codes for normals, of linear light for colours. */
        const uint8_t *normal = t[m->normal_map].texels, *colour = t[m->texture].texels;
        CHECK(memcmp(normal, colour, 8) == 0 && normal[8] == 192 && normal[9] == 64 && normal[10] == 128);
        CHECK(colour[8] == 205 && t[m->normal_map].wrap_s == LMB_WRAP_CLAMP && t[m->normal_map].levels == 2);
    }
    CHECK(loaded.scene.meshes[0].tangents && loaded.scene.meshes[0].uvs);
    if (loaded.scene.meshes[0].tangents) {
        const int16_t *codes = loaded.scene.meshes[0].tangents;
        CHECK(is_vec(lmb_octahedral_decode(codes), 1, 0, 0) && is_vec(lmb_octahedral_decode(codes + 2), 0, 1, 0));
        CHECK(is_vec(lmb_octahedral_decode(codes + 4), 0, -1, 0));
    }
    CHECK_MSG(load_look("\"normalTexture\":{\"index\":0}"), "%s", problem.text);
    CHECK(loaded.scene.materials[0].normal_scale == 1 && loaded.scene.materials[0].texture == -1);
    CHECK(loaded.scene.meshes[0].uvs && loaded.scene.texture_count == 1);
    CHECK_MSG(load_look("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}"), "%s", problem.text);
    CHECK(loaded.scene.materials[0].normal_scale == 0 && !loaded.scene.meshes[0].tangents);
    CHECK_MSG(load_look("\"normalTexture\":{\"index\":0,\"texCoord\":1},"
                        "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}"), "%s", problem.text);
    CHECK(loaded.scene.materials[0].normal_scale == 0 && noted("normal maps left out"));
    CHECK_MSG(load_look("\"normalTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"rotation\":1}}}"),
              "%s", problem.text);
    CHECK(loaded.scene.materials[0].normal_scale == 1 && loaded.scene.meshes[0].tangents); /* only the lookup rotates */
    check_fails(load_look("\"normalTexture\":{\"index\":1}"), "materials[0].normalTexture.index: index 1");
    check_fails(load_look("\"normalTexture\":{}"), "materials[0].normalTexture: index is missing");
    CHECK_MSG(load_look("\"occlusionTexture\":{\"index\":0}"), "%s", problem.text);
    CHECK(noted("occlusion maps ignored") && loaded.scene.texture_count == 0);
}

static int emits_light(double r, double g, double b)
{
    const float *e = loaded.scene.materials[0].emission;
    const lmb_vec3 v = {e[0], e[1], e[2]};
    return is_vec(v, r, g, b);
}

static void emission(void)
{
    const char *strong = "\"emissiveFactor\":[0.5,0.25,1],\"extensions\":{\"KHR_materials_emissive_strength\":"
                         "{\"emissiveStrength\":8}}%s";
    char material[512];
    snprintf(material, sizeof material, strong, "");
    CHECK_MSG(load_look(material), "%s", problem.text);
    CHECK(emits_light(4, 2, 8) && noted("emissive materials, which light the scene (but with fixed groups): 1"));
    snprintf(material, sizeof material, strong, ",\"emissiveTexture\":{\"index\":0}");
    CHECK_MSG(load_look(material), "%s", problem.text);
    CHECK(emits_light(4, 2, 8) && loaded.scene.materials[0].emission_map == 1 && loaded.scene.meshes[0].uvs &&
          !noted("emissive maps"));
    /* Other texture coordinates than the base colour: means in linear light, (0.21586 + 1) / 2, (0.21586 + 0) / 2, (1 +
     * 0) / 2. */
    snprintf(material, sizeof material, strong,
             ",\"emissiveTexture\":{\"index\":0,\"texCoord\":1},"
             "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}");
    CHECK_MSG(load_look(material), "%s", problem.text);
    CHECK(emits_light(4 * 0.60793, 2 * 0.10793, 8 * 0.5) && loaded.scene.materials[0].emission_map == 0 &&
          noted("emissive maps used by their mean"));
    CHECK_MSG(load_look("\"emissiveTexture\":{\"index\":0}"), "%s", problem.text);
    CHECK(emits_light(0, 0, 0) && !noted("emissive"));
    check_fails(load_look("\"emissiveFactor\":[1,2]"), "emissiveFactor: must be an array of 3");
    CHECK_MSG(load_look("\"emissiveFactor\":[-1,1e31,1]"), "%s", problem.text);
    CHECK(emits_light(0, 0, 1));
}

static int has_lobe(double albedo, double f0, double roughness)
{
    const lmb_material *m = &loaded.scene.materials[0];
    return fabs((double)m->albedo[1] - albedo) < 1e-4 && fabs((double)m->specular[1] - f0) < 1e-4 &&
           fabs((double)m->roughness - roughness) < 1e-6;
}

/* Without lobes first; then base x (1 - metallic) below mix(0.04, base, metallic). A textured metal uses the image's
 * mean. */
static void lobes(void)
{
    static const struct {
        const char *material;
        double before, albedo, f0, roughness;
    } cases[] = {
        {"\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,1,1],\"metallicFactor\":0,\"roughnessFactor\":0.25}",
         0.5, 0.5, 0.04, 0.25},
        {"\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,1,1]}", 0.02, 0, 0.5, 1},
        {"\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,1,1],\"metallicFactor\":0.25,\"roughnessFactor\":9}",
         0.375, 0.375, 0.155, 1},
        {"\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}", 0.04, 0, 0.10793, 1},
        {"\"pbrMetallicRoughness\":{\"metallicFactor\":5,\"baseColorFactor\":[1,30,1,1]}", 1, 0, 1, 1},
        {"\"extensions\":{\"KHR_materials_unlit\":{}}", 1, 1, 0, 0},
    };
    for (int i = 0; i < (int)(sizeof cases / sizeof *cases); ++i) {
        const int ok = load_look(cases[i].material);
        CHECK_MSG(ok, "%s", problem.text);
        if (!ok)
            continue;
        CHECK_MSG(has_lobe(cases[i].before, 0, 0), "material %d", i);
        CHECK(model_make_glossy(&loaded) && lmb_scene_check(&loaded.scene) == LMB_OK);
        CHECK_MSG(has_lobe(cases[i].albedo, cases[i].f0, cases[i].roughness), "material %d, with its lobe", i);
    }
    forget();
    CHECK(!model_make_glossy(&loaded));
}

/* A metallic map stays per texel for the lobe, with the factors; without a lobe, its mean darkens the albedo. With
 * other texture coordinates the lobe uses the mean too: blue (1 + 0) / 2, green (128 / 255 + 0) / 2. */
static void metal_maps(void)
{
    const lmb_material *m;
    CHECK_MSG(load_look("\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,1,1],\"metallicFactor\":0.5,"
                        "\"roughnessFactor\":0.25,\"metallicRoughnessTexture\":{\"index\":0}}"), "%s", problem.text);
    m = loaded.scene.materials;
    CHECK(has_lobe(0.375, 0, 0) && m->metal_map == 0 && m->metallic == 0.0f);
    CHECK(model_make_glossy(&loaded) && lmb_scene_check(&loaded.scene) == LMB_OK);
    CHECK(has_lobe(0.5, 0.04, 0.25) && m->metal_map == 1 && m->metallic == 0.5f);
    if (loaded.scene.texture_count == 1) /* means of codes, not of linear light */
        CHECK(loaded.scene.textures[0].texels[8] == 192 && loaded.scene.textures[0].texels[10] == 128);
    CHECK_MSG(load_look("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"roughnessFactor\":0.5,"
                        "\"metallicRoughnessTexture\":{\"index\":0,\"texCoord\":1}}"), "%s", problem.text);
    CHECK(has_lobe(0.5, 0, 0) && model_make_glossy(&loaded));
    CHECK(has_lobe(0.5, 0.04 + (0.10793 - 0.04) * 0.5, 0.5 * 64 / 255.0) && loaded.scene.materials[0].metal_map == 0);
}

/* --- skins --- */

/* Two joints with inverse bind matrices; three vertices: on the first, on the second, half on each. */
static void put_skinned(blob *b)
{
    static const float triangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0.70710678f, 0.70710678f, 0, 1, 0, 0};
    static const float bind[2][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5, 0, 0, 1}};
    static const float weights[] = {1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0};
    static const uint8_t joints[] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, /* a second set: */ 1,
                                     0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0};
    size_t i;
    put_floats(b, triangle, 18);
    put_floats(b, bind[0], 32);
    put_floats(b, weights, 12);
    for (i = 0; i < sizeof joints; ++i)
        put_u8(b, joints[i]);
}

/* Node 0 places the mesh, with a transform that must not count; joint 1 (node 2) is rotated by a quarter turn about z
 * and moved. */
#define SKINNED(SKIN, JOINT_1) SKINNED_BY("", SKIN, JOINT_1)
#define SKINNED_BY(MORE, SKIN, JOINT_1) \
    ASSET "\"scenes\":[{\"nodes\":[0,1,2,3]}],\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[100,0,0]}," \
          "{\"translation\":[0,0,7]},{" JOINT_1 "},{\"mesh\":0}]," \
          "\"skins\":[" SKIN "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1," \
          "\"JOINTS_0\":4,\"WEIGHTS_0\":3" MORE "}}]}]," \
          "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}," \
          "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}," \
          "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5126,\"count\":2,\"type\":\"MAT4\"}," \
          "{\"bufferView\":0,\"byteOffset\":200,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}," \
          "{\"bufferView\":0,\"byteOffset\":248,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"}," \
          "{\"bufferView\":0,\"byteOffset\":260,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"}]," \
          "\"bufferViews\":[{\"buffer\":0,\"byteLength\":272}]," \
          "\"buffers\":[{\"byteLength\":272,\"uri\":\"data:;base64,%s\"}]}"

#define SET(N) ",\"JOINTS_" N "\":5,\"WEIGHTS_" N "\":3"
#define QUARTER "\"rotation\":[0,0,0.70710678,0.70710678],\"translation\":[5,0,0]"

static lmb_vec3 position(const lmb_instance *in, uint32_t vertex)
{
    const float *p = (const float *)loaded.scene.meshes[in->mesh].positions + 3 * (size_t)vertex, *m = in->to_world.m;
    lmb_vec3 v;
    v.x = m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12];
    v.y = m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13];
    v.z = m[2] * p[0] + m[6] * p[1] + m[10] * p[2] + m[14];
    return v;
}

static void skins(void)
{
    const lmb_instance *in;
    blob b = {{0}, 0};
    put_skinned(&b);
    LOADS(SKINNED("{\"joints\":[1,2],\"inverseBindMatrices\":2}", QUARTER), base64(b.bytes, b.size));
    in = loaded.scene.instances;
    CHECK(loaded.scene.instance_count == 2 && loaded.scene.mesh_count == 2 && loaded.facts.primitives == 1);
    if (loaded.scene.instance_count == 2) {
        /* Joint 2's matrix is T(5) R T(-5): (1, 0, 0) -> (-4, 0, 0) -> (0, -4, 0) -> (5, -4, 0). */
        CHECK(is_vec(position(in, 0), 0, 0, 7) && is_vec(position(in, 1), 5, -4, 0));
        /* (0, 1, 0): (0, 1, 7) by joint 1; (-5, 1) -> (-1, -5) -> (4, -5) by joint 2; half of each. */
        CHECK(is_vec(position(in, 2), 2, -2, 3.5));
        CHECK(is_vec(lmb_octahedral_decode(loaded.scene.meshes[in->mesh].normals), 1, 0, 0));
        CHECK(is_vec(lmb_octahedral_decode(loaded.scene.meshes[in->mesh].normals + 2), -sqrt(0.5), sqrt(0.5), 0));
        CHECK(is_vec(lmb_octahedral_decode(loaded.scene.meshes[in->mesh].normals + 4), sqrt(0.5), sqrt(0.5), 0));
        CHECK(is_vec(position(in + 1, 1), 1, 0, 0)); /* the same mesh without a skin is unchanged */
    }
    CHECK(noted("skinned nodes posed") && loaded.facts.skins == 1);
    LOADS(SKINNED("{\"joints\":[1,2]}", "\"translation\":[0,0,7]"), base64(b.bytes, b.size));
    CHECK(is_vec(position(loaded.scene.instances, 1), 1, 0, 7)); /* no matrices: the identity is used */
    /* Non-uniform scale: normals use the inverse transpose. */
    LOADS(SKINNED("{\"joints\":[1,2]}", "\"scale\":[2,1,1]"), base64(b.bytes, b.size));
    in = loaded.scene.instances;
    CHECK(is_vec(lmb_octahedral_decode(loaded.scene.meshes[in->mesh].normals + 2), 0.4472136, 0.8944272, 0));
    /* Two sets with the same weights: vertex 0 half on each joint, vertex 1 only on the second. */
    LOADS(SKINNED_BY(",\"JOINTS_1\":5,\"WEIGHTS_1\":3", "{\"joints\":[1,2]}", "\"translation\":[8,0,0]"),
          base64(b.bytes, b.size));
    in = loaded.scene.instances;
    CHECK(is_vec(position(in, 0), 4, 0, 3.5) && is_vec(position(in, 1), 9, 0, 0));
    check_fails(load(SKINNED_BY(SET("1") SET("2") SET("3") SET("4") SET("5") SET("6") SET("7") SET("8"),
                                "{\"joints\":[1,2]}", QUARTER), base64(b.bytes, b.size)),
                "more than 32 joints at a vertex");
    check_fails(load(SKINNED("{\"joints\":[1]}", QUARTER), base64(b.bytes, b.size)),
                "joint 1 at vertex 1, but the skin has 1");
    check_fails(load(SKINNED("{\"joints\":[]}", QUARTER), base64(b.bytes, b.size)), "skins[0]: a skin without joints");
    check_fails(load(SKINNED("{\"joints\":[1,9]}", QUARTER), base64(b.bytes, b.size)), "skins[0].joints[1]: index 9");
    check_fails(load(SKINNED("{\"joints\":[1,2,1],\"inverseBindMatrices\":2}", QUARTER), base64(b.bytes, b.size)),
            "needs a MAT4 of floats for each of the 3 joints");
    check_fails(load(SKINNED("{\"joints\":[1,2],\"inverseBindMatrices\":3}", QUARTER), base64(b.bytes, b.size)),
                "MAT4");
    check_fails(load(SKINNED("", QUARTER), base64(b.bytes, b.size)), "nodes[0].skin: index 0, but there are 0");
}

/* --- the converter in messages --- */

static void conversions(void)
{
    check_fails(load(ASSET "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}"), "gltf-transform cp");
    check_fails(load(ASSET "\"extensionsRequired\":[\"EXT_meshopt_compression\"]}"), "gltfpack -noq");
    check_fails(load(ASSET "\"extensionsRequired\":[\"KHR_texture_basisu\"]}"), "gltf-transform ktxdecompress");
    check_fails(load(ASSET "\"extensionsRequired\":[\"EXT_texture_webp\"]}"), "gltf-transform png");
    check_fails(load(ASSET "\"extensionsRequired\":[\"EXT_texture_avif\"]}"), "gltf-transform png");
    check_fails(load(ASSET "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                       "\"extensions\":{\"KHR_draco_mesh_compression\":{}}}]}],\"accessors\":[{\"componentType\":5126,"
                       "\"count\":3,\"type\":\"VEC3\"}]}"), "gltf-transform cp");
    LOADS(ASSET "\"extensionsUsed\":[\"EXT_texture_webp\"]}");
    CHECK(noted("EXT_texture_webp is ignored; make its textures PNGs: gltf-transform png"));
    check_fails(load(ASSET "\"extensionsRequired\":[\"KHR_no_such\"]}"), "extensionsRequired[0]: requires KHR_no_such");
}

/* --- a small file stays small --- */

/* A file beside the model is read and charged once, however often and under whatever names it is used. */
static void neighbours(void)
{
    folder place;
    uint8_t bytes[64] = {0};
    report r = {{0}};
    model m;
    const char *path;
    const char *document =
        ASSET "\"nodes\":[{\"mesh\":0}],\"buffers\":[{\"byteLength\":64,\"uri\":\"a.bin\"},"
              "{\"byteLength\":64,\"uri\":\"./a.bin\"},{\"byteLength\":64,\"uri\":\".//././a.bin\"}],"
              "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":1,\"byteLength\":36},{\"buffer\":2,"
              "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":"
              "\"VEC3\"},{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":2,"
              "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":"
              "{\"POSITION\":0}},{\"attributes\":{\"POSITION\":1}},{\"attributes\":{\"POSITION\":2}}]}]}";
    folder_open(&place);
    folder_put(&place, "a.bin", bytes, sizeof bytes);
    path = folder_put(&place, "a.gltf", document, strlen(document));
    CHECK_MSG(model_load(&m, path, NULL, &notes, &r), "%s", r.text);
    CHECK(m.scene.instance_count == 3 && m.facts.neighbour_bytes == 64);
    model_free(&m);
    folder_close(&place);
}

/* Accessors without bytes are zeros: counts that would exhaust memory are refused. */
static void counts(void)
{
    check_fails(load(ASSET "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                       "\"accessors\":[{\"componentType\":5126,\"count\":4000000000,\"type\":\"VEC3\"}]}"),
            "more than 96 bytes of memory a byte of file");
}

/* No picture of a small file may exceed 2^26 pixels; a header alone could claim more. */
static void pixels(void)
{
    static const uint8_t png[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R',
                                  0, 0, 0x20, 0x40, 0, 0, 0x20, 0x40, 8, 2, 0, 0, 0, 0, 0, 0, 0};
    LOADS(ASSET "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],\"textures\":"
                "[{\"source\":0}],\"images\":[{\"uri\":\"data:;base64,%s\"}]}", base64(png, sizeof png));
    CHECK(noted("images[0]: 68161536 pixels are more than the model's pictures may still have"));
}

/* The message for an unreadable picture contains the file name. */
static void names_pictures(void)
{
    static const char document[] = ASSET "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
                                         "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"a wall.png\"}]}";
    folder place;
    folder_open(&place);
    folder_put(&place, "a wall.png", "no picture", 10);
    CHECK_LOADS(load_file(folder_put(&place, "a.gltf", document, strlen(document))));
    CHECK(noted("(first: images[0], a wall.png: "));
    folder_close(&place);
}

/* A PNG of one pixel with a long unused chunk, so that its checksum takes time. */
static void put_long_png(blob *b, uint8_t *chunk, size_t size)
{
    static const uint8_t rgb[3] = {9, 9, 9};
    file_bytes png = {NULL, 0};
    CHECK(png_encode(&png, rgb, 1, 1, &problem));
    memset(chunk, 0, size);
    put_u32_be(chunk, (uint32_t)(size - 12));
    memcpy(chunk + 4, "teSt", 4);
    put_u32_be(chunk + size - 4, png_crc(chunk + 4, size - 8));
    CHECK(png.size < sizeof b->bytes);
    if (png.size < sizeof b->bytes)
        memcpy(b->bytes, png.data, b->size = png.size);
    file_free(&png);
}

/* A document with IMAGES pictures of `size` bytes and more; `cut`: each is one byte shorter than the one before. */
static size_t put_images(char *document, size_t cap, size_t size, int images, int cut)
{
    static const char *const ends[] = {"],\"textures\":[", "],\"materials\":[", "]}"};
    size_t n = (size_t)snprintf(document, cap, ASSET "\"buffers\":[{\"byteLength\":%u,\"uri\":\"long.png\"}],\"bufferViews\":[",
                                (unsigned)size);
    for (int i = 0; i < images; ++i)
        n += (size_t)snprintf(document + n, cap - n, "%s{\"buffer\":0,\"byteLength\":%u}", i ? "," : "",
                              (unsigned)(size - (size_t)(cut ? i : 0)));
    n += (size_t)snprintf(document + n, cap - n, "],\"images\":[");
    for (int part = 0; part < 3; ++part) {
        for (int i = 0; i < images; ++i) {
            n += (size_t)snprintf(document + n, cap - n, "%s", i ? "," : "");
            n += (size_t)snprintf(document + n, cap - n,
                                  part == 0   ? "{\"bufferView\":%u}"
                                  : part == 1 ? "{\"source\":%u}"
                                              : "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":%u},"
                                                "\"metallicRoughnessTexture\":{\"index\":0}}}",
                                  (unsigned)i);
        }
        n += (size_t)snprintf(document + n, cap - n, "%s", ends[part]);
    }
    return n;
}

/* The pixel budget is exact: 2^24 plus 64 per byte of the files, and one picture may exceed the rest. Each decoding
 * costs its pixels and bytes, each name an eighth of its bytes. */
static void pixels_left(void)
{
    enum { WIDTH = 4096, HEIGHT = 2048, IMAGES = 3, CAP = 4096 };
    folder place;
    file_bytes png = {NULL, 0};
    char document[CAP], said[120];
    uint8_t *rgb = (uint8_t *)calloc((size_t)WIDTH * HEIGHT, 3);
    uint8_t *file = NULL;
    CHECK(rgb != NULL && png_encode(&png, rgb, WIDTH, HEIGHT, &problem));
    free(rgb);
    if (png.data != NULL && (file = (uint8_t *)calloc(png.size + IMAGES, 1)) != NULL) {
        const size_t size = png.size + IMAGES, n = put_images(document, CAP, size, IMAGES, 1);
        memcpy(file, png.data, png.size);
        folder_open(&place);
        folder_put(&place, "long.png", file, size);
        CHECK_LOADS(load_file(folder_put(&place, "a.gltf", document, n)));
        folder_close(&place);
        /* The first picture is decoded as colour and as metallic map, and the second is the one that exceeds the
         * rest. */
        const size_t decoded = size + size + (size - 1),
                     named = 2 * (size / 8 + 1) + ((size - 1) / 8 + 1) + ((size - 2) / 8 + 1);
        snprintf(said, sizeof said,
                 "images[2]: 8388608 pixels are more than the model's pictures may still have, which is %u ",
                 (unsigned)(64 * (size + n) - decoded - named));
        CHECK_MSG(noted(said), "not: %s", said);
        CHECK_MSG(loaded.scene.texture_count == 3, "%u textures", (unsigned)loaded.scene.texture_count);
    }
    free(file);
    file_free(&png);
}

/* One picture under many names is decoded once per use, as colour or not. If the names differ in the bytes after the
 * picture's end, each costs its bytes. The budget of 2^24 plus 64 per byte of the files ends before the last picture;
 * without it, time would grow with bytes times names. */
static void decoded_often(void)
{
    enum { SIZE = 1 << 19, HEADER = 33, IMAGES = 208, MORE = 256, CAP = 1 << 16 };
    folder place;
    blob b = {{0}, 0};
    uint8_t *file = (uint8_t *)malloc(SIZE + sizeof b.bytes + MORE);
    char *document = (char *)malloc(CAP);
    CHECK(file != NULL && document != NULL);
    if (!file || !document)
        return;
    put_long_png(&b, file + HEADER, SIZE);
    CHECK(b.size > HEADER);
    memcpy(file, b.bytes, HEADER);
    memcpy(file + HEADER + SIZE, b.bytes + HEADER, b.size - HEADER);
    memset(file + SIZE + b.size, 0, MORE);
    folder_open(&place);
    folder_put(&place, "long.png", file, SIZE + b.size + MORE);
    CHECK_LOADS(load_file(folder_put(&place, "a.gltf", document, put_images(document, CAP, SIZE + b.size, IMAGES, 0))));
    CHECK_MSG(loaded.scene.texture_count == IMAGES + 1, "%u textures", (unsigned)loaded.scene.texture_count);
    CHECK(loaded.facts.texel_bytes == 8 && !noted("textures left out"));
    for (uint32_t i = 2; i < loaded.scene.texture_count; ++i) /* the second: the first picture as metallic map */
        CHECK(loaded.scene.textures[i].texels == loaded.scene.textures[0].texels);
    CHECK_LOADS(load_file(folder_put(&place, "a.gltf", document, put_images(document, CAP, SIZE + b.size + MORE, IMAGES, 1))));
    CHECK_MSG(loaded.scene.texture_count > 75 && loaded.scene.texture_count < 100, "%u decoded",
              (unsigned)loaded.scene.texture_count);
    CHECK(noted("textures left out, plain colour instead") && noted("have been decoded too often"));
    folder_close(&place);
    free(document);
    free(file);
}

/* A mesh of 5,000 vertices placed 5,000 times: only its box is transformed, not 25 million vertices. */
static void many_places(void)
{
    enum { PLACES = 5000, VERTICES = 5000 };
    size_t cap = PLACES * 40 + 4096, n = 0;
    char *document = (char *)malloc(cap);
    CHECK(document != NULL);
    if (!document)
        return;
    n += (size_t)snprintf(document, cap,
                          ASSET "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                                "\"accessors\":[{\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"}],\"nodes\":[",
                          VERTICES);
    for (int i = 0; i < PLACES; ++i)
        n += (size_t)snprintf(document + n, cap - n, "%s{\"mesh\":0,\"translation\":[%d,0,0]}", i ? "," : "", i);
    n += (size_t)snprintf(document + n, cap - n, "]}");
    forget();
    CHECK_MSG(model_read(&loaded, "a.gltf", NULL, (const uint8_t *)document, n, &notes, &problem), "%s", problem.text);
    CHECK(is_vec(loaded.scene.bounds_min, 0, 0, 0) && is_vec(loaded.scene.bounds_max, PLACES - 1, 0, 0));
    free(document);
}

/* A million shared vertices in many meshes, or a mesh with them in many places, is refused before they are processed so
 * often. */
static void shared_vertices(void)
{
    enum { CAP = 1 << 16 };
    static char document[CAP];
    static const struct {
        int meshes, places;
        const char *says; /* NULL: loads */
    } tries[] = {{8, 1, NULL}, {40, 1, "vertices and triangles in its meshes, of files of"},
                 {1, 200, NULL}, {1, 400, "triangles in its instances, of files of"}};
    for (size_t k = 0; k < sizeof tries / sizeof tries[0]; ++k) {
        size_t n = (size_t)snprintf(document, CAP, ASSET "\"accessors\":[{\"componentType\":5126,\"count\":999999,\"type\":\"VEC3\"}],"
                                                         "\"meshes\":[{\"primitives\":[");
        for (int i = 0; i < tries[k].meshes; ++i)
            n += (size_t)snprintf(document + n, CAP - n, "%s{\"attributes\":{\"POSITION\":0}}", i ? "," : "");
        n += (size_t)snprintf(document + n, CAP - n, "]}],\"nodes\":[");
        for (int i = 0; i < tries[k].places; ++i)
            n += (size_t)snprintf(document + n, CAP - n, "%s{\"mesh\":0}", i ? "," : "");
        n += (size_t)snprintf(document + n, CAP - n, "]}");
        forget();
        const int ok = model_read(&loaded, "a.gltf", NULL, (const uint8_t *)document, n, &notes, &problem);
        if (tries[k].says != NULL)
            check_fails(ok, tries[k].says);
        else
            CHECK_LOADS(ok);
    }
}

/* --- light that `lambent bake --to lightmap` stored --- */

/* The triangle of TRIANGLE with extras, the names of the two images, and a material. */
static int load_baked(const char *extras, const char *first, const char *second, const char *material)
{
    static const char form[] =
        "{\"asset\":{\"version\":\"2.0\",\"extras\":{\"lambent\":{%s}}},\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"TEXCOORD_1\":2},\"material\":0}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":16,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":144},{\"buffer\":0,\"byteOffset\":144,\"byteLength\":%u}],"
        "\"textures\":[{\"source\":0},{\"source\":1}],\"images\":[{\"bufferView\":1,\"name\":\"%s\"},"
        "{\"bufferView\":1,\"name\":\"%s\"}],"
        "\"buffers\":[{\"byteLength\":%u,\"uri\":\"data:;base64,%s\"}],\"materials\":[{%s}]}";
    blob b = {{0}, 0};
    size_t png;
    put_lookable(&b, &png);
    return load(form, extras, (unsigned)png, first, second, (unsigned)b.size, base64(b.bytes, b.size), material);
}

/* Checks that there is a lightmap, with texture coordinates (u, v) at the second corner. */
static int is_lit(float u, float v)
{
    const model_light *l = &loaded.light;
    return l->picture != NULL && l->uv[0] != NULL && near(l->uv[0][2], (double)u) && near(l->uv[0][3], (double)v) &&
           !noted("lightmap is gone");
}

static int is_gone(void) { return loaded.light.picture == NULL && noted("the lightmap is gone"); }

static void baked_light(void)
{
    static const char now[] = "\"light\":\"lightmap\",\"scale\":2,\"texCoord\":1",
                      then[] = "\"light\":\"lightmap\",\"scale\":2,\"texture\":1,\"texCoord\":1",
                      past[] = "\"light\":\"lightmap\",\"scale\":2,\"texture\":2,\"texCoord\":1";
    /* Corner 1: (1, 0) of TEXCOORD_0, (0, 1) of TEXCOORD_1. */
    CHECK_LOADS(load_baked(now, "a", MODEL_LIGHT_NAME, "\"occlusionTexture\":{\"index\":1,\"texCoord\":1,\"strength\":0}"));
    CHECK(is_lit(0, 1) && !noted("occlusion"));
    CHECK_LOADS(load_baked(now, MODEL_LIGHT_NAME, "b", "\"emissiveTexture\":{\"index\":0,\"texCoord\":0}"));
    CHECK(is_lit(1, 0));
    CHECK_LOADS(load_baked(now, "a", MODEL_LIGHT_NAME,
                           "\"extensions\":{\"KHR_materials_specular\":{\"specularTexture\":{\"index\":1,\"texCoord\":1,"
                           "\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.25,0.5],\"scale\":[1,2]}}}}}"));
    CHECK(is_lit(0.25f, 2.5f));
    CHECK_LOADS(load_baked(now, "a", "b", "\"occlusionTexture\":{\"index\":7,\"texCoord\":1}"));
    CHECK(is_gone() && !noted("occlusion"));
    CHECK_LOADS(load_baked(now, "a", "b", "\"occlusionTexture\":{\"index\":1}"));
    CHECK(is_gone() && noted("occlusion maps ignored"));
    /* As older versions wrote files. */
    CHECK_LOADS(load_baked(then, "a", "b", "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}"));
    CHECK(is_lit(0, 1));
    CHECK_LOADS(load_baked(past, "a", "b", "\"doubleSided\":true"));
    CHECK(is_gone());
    CHECK_LOADS(load_baked(then, "a", "b", "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}"));
    CHECK(is_gone()); /* now the index of another texture */
    CHECK_LOADS(load_baked("\"light\":\"vertex-colours\",\"scale\":2", "a", "b", "\"doubleSided\":true"));
    CHECK(loaded.light.scale == 2 && !noted("lightmap is gone"));
}

void test_gltf(void)
{
    scenes();
    normal_maps();
    emission();
    lobes();
    metal_maps();
    skins();
    conversions();
    neighbours();
    counts();
    pixels();
    names_pictures();
    pixels_left();
    decoded_often();
    many_places();
    shared_vertices();
    baked_light();
    model_free(&loaded);
}
