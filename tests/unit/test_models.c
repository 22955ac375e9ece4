/* test_models.c: the model readers: every feature with exact values, hostile and truncated files, known counts. */
#include "../folder.h"

#include <math.h>
#include <stdarg.h>

#include "../../tools/picture/image.h"
#include "../../tools/common/io_json.h"
#include "../../tools/model/ear_clip.h"
#include "../blob.h"
#include "../model_case.h"
#include "../shared_file.h"

void test_models(void);

enum { TEXT_MAX = 1 << 16 };

/* The run's folder, the text written last, and the model loaded last. */
static folder place;
static char text[TEXT_MAX];

/* --- files --- */

static void put_file(const char *name, const void *data, size_t size) { folder_put(&place, name, data, size); }

/* A path in the folder, whether or not the file exists. */
static void path_of(char path[FOLDER_PATH], const char *name)
{
    snprintf(path, FOLDER_PATH, "%.440s/%.60s", place.path, name);
}

static int load(const char *name)
{
    char path[FOLDER_PATH];
    path_of(path, name);
    forget();
    return model_load(&loaded, path, NULL, &notes, &problem);
}

/* Write formatted text as a file and load it. */
static int load_text(const char *name, const char *format, ...)
{
    va_list args;
    int n;
    va_start(args, format);
    n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    CHECK(n >= 0 && n < TEXT_MAX);
    put_file(name, text, (size_t)n);
    return load(name);
}

/* --- binary data --- */

static const float unit_triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/* A PNG of one colour. */
static void make_png(file_bytes *out, int32_t width, int32_t height, int red, int green, int blue)
{
    uint8_t rgb[64 * 3];
    int i;
    for (i = 0; i < width * height && i < 64; ++i) {
        rgb[3 * i] = (uint8_t)red;
        rgb[3 * i + 1] = (uint8_t)green;
        rgb[3 * i + 2] = (uint8_t)blue;
    }
    CHECK(png_encode(out, rgb, width, height, &problem));
}

/* --- values --- */

static int near(float a, double b, double e) { return fabs((double)a - b) <= e; }

static int is_vec(lmb_vec3 v, double x, double y, double z)
{
    return near(v.x, x, 1e-6) && near(v.y, y, 1e-6) && near(v.z, z, 1e-6);
}

static const float *position(uint32_t mesh, uint32_t v)
{
    return (const float *)loaded.scene.meshes[mesh].positions + 3 * (size_t)v;
}

static int is_position(uint32_t mesh, uint32_t v, float x, float y, float z)
{
    const float *p = position(mesh, v);
    return p[0] == x && p[1] == y && p[2] == z;
}

static uint32_t index_at(uint32_t mesh, uint32_t i)
{
    const lmb_mesh *m = &loaded.scene.meshes[mesh];
    if (m->index_format == LMB_INDEX_NONE)
        return i;
    return m->index_format == LMB_INDEX_U16 ? ((const uint16_t *)m->indices)[i] : ((const uint32_t *)m->indices)[i];
}

static int are_indices(uint32_t mesh, uint32_t n, const uint32_t *expected)
{
    uint32_t i;
    if (loaded.scene.meshes[mesh].triangle_count * 3 != n)
        return 0;
    for (i = 0; i < n; ++i)
        if (index_at(mesh, i) != expected[i])
            return 0;
    return 1;
}

/* --- JSON --- */

static int parses(json *doc, const char *s)
{
    memset(&problem, 0, sizeof problem);
    return json_parse(doc, s, strlen(s), "t.json", &problem);
}

static void json_values(void)
{
    json doc;
    double d = 0, three[3] = {0, 0, 0};
    uint32_t u = 7;
    int flag = 0;
    char s[64];
    CHECK(parses(
        &doc, " { \"a\" : [1, -2.5e1, 0.125], \"s\":\"x\\u00e9\\n\\ud83d\\ude00\\/\", \"t\":true, \"e\":{}, \"n\":null,"
              "\"big\":4294967294,\"f\":1.5,\"h\":1e999} "));
    CHECK(json_count(&doc, 0) == 8 && json_kind(&doc, json_member(&doc, 0, "e")) == JSON_OBJECT);
    CHECK(json_read_doubles(three, 3, &doc, json_member(&doc, 0, "a"), &problem));
    CHECK(three[0] == 1 && three[1] == -25 && three[2] == 0.125);
    CHECK(json_string(s, sizeof s, &doc, json_member(&doc, 0, "s")) == 9 &&
          strcmp(s, "x\xC3\xA9\n\xF0\x9F\x98\x80/") == 0);
    CHECK(json_string(s, 6, &doc, json_member(&doc, 0, "s")) == 9 && strcmp(s, "x\xC3\xA9\n") == 0);
    CHECK(json_read_bool(&flag, &doc, json_member(&doc, 0, "t"), &problem) && flag == 1);
    CHECK(json_read_uint(&u, &doc, json_member(&doc, 0, "big"), &problem) && u == 4294967294u);
    CHECK(json_read_uint(&u, &doc, json_member(&doc, 0, "absent"), &problem) && u == 4294967294u);
    CHECK(!json_read_uint(&u, &doc, json_member(&doc, 0, "f"), &problem));
    CHECK(strstr(problem.text, "t.json: f: must be a whole number") != NULL);
    CHECK(!json_read_double(&d, &doc, json_member(&doc, 0, "h"), &problem));
    CHECK(json_member(&doc, JSON_NONE, "a") == JSON_NONE && json_next(&doc, json_member(&doc, 0, "h")) == JSON_NONE);
    json_free(&doc);
}

static void json_paths(void)
{
    json doc;
    char path[64];
    uint32_t node;
    CHECK(parses(&doc, "{\"meshes\":[{},{\"primitives\":[1,{\"attributes\":{\"POSITION\":4}}]}]}"));
    node = json_next(&doc, json_first(&doc, json_member(&doc, 0, "meshes")));
    node = json_next(&doc, json_first(&doc, json_member(&doc, node, "primitives")));
    node = json_member(&doc, json_member(&doc, node, "attributes"), "POSITION");
    json_path(path, sizeof path, &doc, node);
    CHECK_MSG(strcmp(path, "meshes[1].primitives[1].attributes.POSITION") == 0, "%s", path);
    json_path(path, 20, &doc, node);
    CHECK_MSG(strcmp(path, "attributes.POSITION") == 0, "%s", path);
    json_free(&doc);
}

static void json_refuses(void)
{
    static const char *const bad[] = {
        "",
        " ",
        "[]",
        "1",
        "{",
        "{}x",
        "{\"a\"}",
        "{\"a\":}",
        "{\"a\":1,}",
        "{,}",
        "{\"a\":[1,]}",
        "{\"a\":[1 2]}",
        "{\"a\":01}",
        "{\"a\":1.}",
        "{\"a\":.5}",
        "{\"a\":+1}",
        "{\"a\":1e}",
        "{\"a\":-}",
        "{\"a\":NaN}",
        "{\"a\":Infinity}",
        "{\"a\":tru}",
        "{\"a\":'x'}",
        "{a:1}",
        "{\"a\":\"\t\"}",
        "{\"a\":\"\\x\"}",
        "{\"a\":\"\\u12g4\"}",
        "{\"a\":\"\\ud800\"}",
        "{\"a\":\"\\udc00\"}",
        "{\"a\":\"\\ud800\\u0041\"}",
        "{\"a\":\"",
        "{\"a\":\"\\",
        "{\"a\":[}",
        "{\"a\":{]}",
        "{\"a\":1}}",
        "{\"a\":1]",
        "{\"a\":1 //\n}",
        "{\"a\":0x10}",
        "{\"a\":\"\\u",
        "{\"a\":nul",
    };
    json doc;
    size_t i;
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK_MSG(!parses(&doc, bad[i]), "parsed: %s", bad[i]);
        CHECK(strncmp(problem.text, "t.json: line ", 13) == 0 && !doc.nodes);
    }
    CHECK(!parses(&doc, "{\n\"m\":[{},{\"x\":\n[1,2,?]}]}"));
    CHECK_MSG(strstr(problem.text, "line 3, byte 21, in m[1].x: expected a value") != NULL, "%s", problem.text);
    CHECK(!json_parse(&doc, "{\"a\":\"\0\"}", 9, "t.json", &problem));
}

static void json_depth(void)
{
    char deep[400];
    json doc;
    int n, i;
    for (n = 62; n <= 65; ++n) {
        char *p = deep + sprintf(deep, "{\"a\":");
        for (i = 0; i < n; ++i)
            *p++ = '[';
        for (i = 0; i < n; ++i)
            *p++ = ']';
        strcpy(p, "}");
        CHECK(parses(&doc, deep) == (n < JSON_MAX_DEPTH));
        json_free(&doc);
    }
}

/* --- glTF: scenes --- */

/* A scene of two placed triangles, lights and cameras; mesh 0 is used twice. */
static const char *scene_json(void)
{
    return "{\"asset\":{\"version\":\"2.0\"},\"scene\":1,\"scenes\":[{\"nodes\":[]},{\"nodes\":[0,3,4,5]}],"
           "\"extensionsUsed\":[\"KHR_lights_punctual\"],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
           "{\"type\":\"point\",\"color\":[1,0.5,0.25],\"intensity\":8,\"range\":3},{\"type\":\"spot\",\"range\":0},"
           "{\"type\":\"directional\",\"intensity\":2,\"range\":4},"
           "{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.5,\"outerConeAngle\":1}}]}},"
           "\"nodes\":[{\"translation\":[1,2,3],\"scale\":[2,2,2],\"children\":[1,2],\"mesh\":0},"
           "{\"rotation\":[0,0,0.70710678118654752,0.70710678118654752],\"mesh\":0,\"translation\":[1,0,0]},"
           "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}},\"translation\":[0,0.5,0]},"
           "{\"name\":\"eye\",\"camera\":0,\"matrix\":[0,0,-3,0, 0,3,0,0, 3,0,0,0, 7,8,9,1]},"
           "{\"camera\":1,\"rotation\":[0,1,0,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":3}}},"
           "{\"rotation\":[-0.70710678118654752,0,0,0.70710678118654752],\"children\":[6],"
           "\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}},"
           "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},{\"mesh\":0}],"
           "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.75,\"aspectRatio\":1.5,\"znear\":0.125}}"
           ","
           "{\"type\":\"orthographic\",\"name\":\"flat\",\"orthographic\":{\"xmag\":4,\"ymag\":2,\"znear\":0,\"zfar\":"
           "16}}],"
           "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
           "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0}}],"
           "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
           "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":"
           "\"data:application/octet-stream;base64,%s\"}]}";
}

static void gltf_nodes(void)
{
    blob b = {{0}, 0};
    const lmb_scene *s = &loaded.scene;
    put_floats(&b, unit_triangle, 9);
    CHECK_LOADS(load_text("scene.gltf", scene_json(), base64(b.bytes, b.size)));
    if (s->instance_count != 2) {
        CHECK(s->instance_count == 2);
        return;
    }
    CHECK(s->mesh_count == 1 && s->meshes[0].vertex_count == 3 && s->meshes[0].triangle_count == 1);
    CHECK(s->meshes[0].index_format == LMB_INDEX_NONE && s->meshes[0].position_format == LMB_POSITION_F32);
    CHECK(!s->meshes[0].normals && !s->meshes[0].uvs && !s->meshes[0].colours && is_position(0, 1, 1, 0, 0));
    CHECK(s->instances[0].mesh == 0 && s->instances[1].mesh == 0);
    CHECK(s->instances[0].first_id == 1 && s->instances[1].first_id == 2);
    CHECK(s->instances[0].to_world.m[0] == 2 && s->instances[0].to_world.m[13] == 2);
    CHECK(near(s->instances[1].to_world.m[1], 2, 1e-6) && near(s->instances[1].to_world.m[4], -2, 1e-6));
    CHECK(s->instances[1].to_world.m[12] == 3 && s->instances[1].to_world.m[15] == 1);
    CHECK(is_vec(s->bounds_min, 1, 2, 3) && is_vec(s->bounds_max, 3, 4, 3));
    CHECK(lmb_scene_triangles(s) == 2 && lmb_scene_check(s) == LMB_OK && notes.count == 0);
    CHECK(s->materials[0].albedo[0] == 1 && s->materials[0].flags == 0 && s->materials[0].texture == -1);
}

static void gltf_lights(void)
{
    const lmb_light *l = loaded.scene.lights;
    CHECK(loaded.scene.light_count == 4 && !noted("light range"));
    if (loaded.scene.light_count != 4)
        return;
    CHECK(l[0].kind == LMB_LIGHT_POINT && is_vec(l[0].position, 1, 3, 3));
    CHECK(l[0].range == 3.0f && l[1].range == 0.0f && l[2].range == 0.0f && l[3].range == 0.0f); /* node scale unused */
    CHECK(l[0].intensity[0] == 8 && l[0].intensity[1] == 4 && l[0].intensity[2] == 2);
    CHECK(l[1].kind == LMB_LIGHT_SPOT && is_vec(l[1].direction, 0, 0, 1) && is_vec(l[1].position, 0, 0, 0));
    CHECK(near(l[1].cos_inner, cos(0.5), 1e-7) && near(l[1].cos_outer, cos(1.0), 1e-7));
    CHECK(l[2].kind == LMB_LIGHT_DIRECTIONAL && is_vec(l[2].direction, 0, -1, 0) && l[2].intensity[2] == 2);
    CHECK(l[3].kind == LMB_LIGHT_SPOT && is_vec(l[3].direction, 0, -1, 0) && l[3].cos_inner == 1);
    CHECK(near(l[3].cos_outer, sqrt(0.5), 1e-7));
}

static void gltf_cameras(void)
{
    const model_camera *c = loaded.cameras;
    CHECK(loaded.camera_count == 2);
    if (loaded.camera_count != 2)
        return;
    CHECK(strcmp(c[0].name, "eye") == 0 && !c[0].orthographic && c[0].yfov_rad == 0.75f && c[0].aspect == 1.5f);
    CHECK(c[0].near_m == 0.125f && c[0].far_m == 0 && is_vec(c[0].eye, 7, 8, 9));
    CHECK(is_vec(c[0].right, 0, 0, -1) && is_vec(c[0].up, 0, 1, 0) && is_vec(c[0].back, 1, 0, 0));
    CHECK(strcmp(c[1].name, "flat") == 0 && c[1].orthographic && c[1].half_width == 4 && c[1].half_height == 2);
    CHECK(c[1].aspect == 2 && c[1].near_m == 0 && c[1].far_m == 16 && is_vec(c[1].back, 0, 0, -1));
    CHECK(is_vec(c[1].right, -1, 0, 0));
}

/* --- glTF: streams --- */

#define HEAD           "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
#define BUFFER         "\"buffers\":[{\"byteLength\":%u,\"uri\":\"data:;base64,%s\"}]}"
#define TAIL(b)        (unsigned)(b).size, base64((b).bytes, (b).size)
#define POSITIONS_AT_0 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]"
#define MESH_OF_0      "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"

/* Interleaved: position f32 x 3, normal i8 x 3 + 1, uv u16 x 2, colour u8 x 4: 24 bytes per vertex. */
static void gltf_interleaved(void)
{
    static const int8_t normals[3][3] = {{0, 0, 127}, {127, 0, 0}, {0, -128, 0}};
    static const float where[3][3] = {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
    blob b = {{0}, 0};
    const lmb_mesh *m;
    int i, k;
    for (i = 0; i < 3; ++i) {
        put_floats(&b, unit_triangle + 3 * i, 3);
        for (k = 0; k < 4; ++k)
            put_u8(&b, k < 3 ? (uint8_t)normals[i][k] : 0);
        put_u16(&b, 65535u * (uint32_t)(i == 1));
        put_u16(&b, 13107u * (uint32_t)i);
        for (k = 0; k < 4; ++k)
            put_u8(&b, (uint32_t)(16 * i + 64 * k));
    }
    CHECK_LOADS(load_text(
        "inter.gltf",
        HEAD
        "\"extensionsRequired\":[\"KHR_mesh_quantization\"],\"meshes\":[{\"primitives\":[{\"material\":0,"
        "\"attributes\":"
        "{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_1\":2,\"COLOR_0\":3}}]}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"texCoord\":1}}}],"
        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"one%%20white.png\"}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5120,\"normalized\":true,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":16,\"componentType\":5123,\"normalized\":true,\"count\":3,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":20,\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":\"VEC4\"}]"
        ","
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72,\"byteStride\":24}]," BUFFER,
        TAIL(b)));
    m = &loaded.scene.meshes[0];
    if (loaded.scene.mesh_count != 1 || !m->normals || !m->uvs || !m->colours) {
        CHECK(!"streams");
        return;
    }
    CHECK(is_position(0, 2, 0, 1, 0));
    for (i = 0; i < 3; ++i) {
        CHECK(is_vec(lmb_octahedral_decode(m->normals + 2 * i), (double)where[i][0], (double)where[i][1],
                     (double)where[i][2]));
        CHECK(((const float *)m->uvs)[2 * i] == (float)(i == 1));
        CHECK(near(((const float *)m->uvs)[2 * i + 1], 0.2 * i, 1e-7));
        for (k = 0; k < 4; ++k)
            CHECK(m->colour_format == LMB_COLOUR_RGBA8 && m->colours[4 * i + k] == 16 * i + 64 * k);
    }
}

/* 1 if channel c of a vertex is `light`, within a thousandth of it. */
static int has_light(uint32_t mesh, uint32_t vertex, int c, double light)
{
    lmb_vertex v;
    return lmb_mesh_vertex(&v, &loaded.scene.meshes[mesh], vertex) && near(v.colour[c], light, 1e-3 * light);
}

/* Quantised positions and float colours. */
static void gltf_integers(void)
{
    blob b = {{0}, 0};
    int i;
    for (i = 0; i < 3; ++i) { /* i16 normalized, 8 bytes apart */
        put_u16(&b, i == 1 ? 32767 : 0);
        put_u16(&b, i == 2 ? 0x8001 : 0);
        put_u16(&b, i == 2 ? 0x8000 : 0);
        put_u16(&b, 0);
    }
    for (i = 0; i < 3; ++i) { /* u8, not normalized */
        put_u8(&b, (uint32_t)(i == 1 ? 200 : 0));
        put_u8(&b, (uint32_t)(i == 2 ? 100 : 0));
        put_u16(&b, 0);
    }
    for (i = 0; i < 9; ++i)
        put_f32(&b, (float)i * 0.25f - 0.5f); /* -0.5 .. 1.5 */
    CHECK_LOADS(load_text(
        "ints.gltf",
        HEAD "\"extensionsRequired\":[\"KHR_mesh_quantization\"],\"meshes\":[{\"primitives\":["
             "{\"attributes\":{\"POSITION\":0,\"COLOR_0\":2}},{\"attributes\":{\"POSITION\":1}}]}],\"accessors\":["
             "{\"bufferView\":0,\"componentType\":5122,\"normalized\":true,\"count\":3,\"type\":\"VEC3\"},"
             "{\"bufferView\":1,\"componentType\":5121,\"count\":3,\"type\":\"VEC3\"},"
             "{\"bufferView\":2,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":["
             "{\"buffer\":0,\"byteLength\":24,\"byteStride\":8},{\"buffer\":0,\"byteOffset\":24,\"byteLength\":12,"
             "\"byteStride\":4},"
             "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":36}]," BUFFER,
        TAIL(b)));
    if (loaded.scene.mesh_count != 2 || !loaded.scene.meshes[0].colours) {
        CHECK(!"meshes");
        return;
    }
    CHECK(is_position(0, 1, 1, 0, 0) && is_position(0, 2, 0, -1, -1));
    CHECK(is_position(1, 1, 200, 0, 0) && is_position(1, 2, 0, 100, 0));
    CHECK(has_light(0, 0, 2, 0) && has_light(0, 0, 3, 1) && has_light(0, 1, 0, 0.25) && has_light(0, 2, 2, 1));
    CHECK(noted("without a material, drawn white: 2") && loaded.scene.materials[0].albedo[1] == 1);
}

static void gltf_sparse(void)
{
    static const float moved[6] = {5, 6, 7, 8, 9, 10};
    blob b = {{0}, 0};
    put_floats(&b, unit_triangle, 9);
    put_u16(&b, 0);
    put_u16(&b, 2);
    put_floats(&b, moved, 6);
    CHECK_LOADS(load_text(
        "sparse.gltf",
        HEAD
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}},{\"attributes\":{\"POSITION\":1}}]}],"
        "\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":{\"count\":2,\"indices\":"
        "{\"bufferView\":1,\"componentType\":5123},\"values\":{\"bufferView\":2}}},"
        "{\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":"
        "{\"bufferView\":1,\"byteOffset\":2,\"componentType\":5123},\"values\":{\"bufferView\":2,\"byteOffset\":12}}}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":4},"
        "{\"buffer\":0,\"byteOffset\":40,\"byteLength\":24}]," BUFFER,
        TAIL(b)));
    if (loaded.scene.mesh_count != 2)
        return;
    CHECK(is_position(0, 0, 5, 6, 7) && is_position(0, 1, 1, 0, 0) && is_position(0, 2, 8, 9, 10));
    CHECK(is_position(1, 0, 0, 0, 0) && is_position(1, 2, 8, 9, 10) && is_position(1, 3, 0, 0, 0));
    CHECK(loaded.scene.meshes[1].triangle_count == 1 && noted("vertices left over"));
}

/* Sparse indices must increase strictly, both for values and for vertex numbers. */
static void gltf_sparse_order(void)
{
    static const uint32_t twice[2] = {1, 1}, back[2] = {2, 1}, beyond[2] = {0, 3};
    const uint32_t *const orders[] = {twice, back, beyond};
    for (int k = 0; k < 3; ++k) {
        blob b = {{0}, 0};
        put_floats(&b, unit_triangle, 9);
        put_u16(&b, orders[k][0]);
        put_u16(&b, orders[k][1]);
        put_floats(&b, unit_triangle, 6);
        check_fails(load_text("order.gltf",
                              HEAD MESH_OF_0
                              ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"sparse\":"
                              "{\"count\":2,\"indices\":{\"bufferView\":1,\"componentType\":5123},\"values\":{\"bufferView\":2}}}],"
                              "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":4},"
                              "{\"buffer\":0,\"byteOffset\":40,\"byteLength\":24}]," BUFFER,
                              TAIL(b)),
                    "at entry 1; they must rise and stay under 3");
    }
}

/* One vertex array in every mode and with every index type; streams are shared. */
static void gltf_modes(void)
{
    static const uint32_t strip[9] = {0, 1, 2, 1, 3, 2, 2, 3, 4}, fan[9] = {1, 2, 0, 2, 3, 0, 3, 4, 0},
                          list[6] = {4, 3, 2, 0, 1, 2}, strip8[6] = {4, 3, 2, 3, 0, 2};
    blob b = {{0}, 0};
    int i;
    for (i = 0; i < 5; ++i) {
        put_f32(&b, (float)(i / 2));
        put_f32(&b, (float)(i % 2));
        put_f32(&b, 0);
    }
    put_u32(&b, 4), put_u32(&b, 3), put_u32(&b, 2), put_u32(&b, 0), put_u32(&b, 1), put_u32(&b, 2);
    put_u8(&b, 4), put_u8(&b, 3), put_u8(&b, 2), put_u8(&b, 0);
    CHECK_LOADS(load_text(
        "modes.gltf",
        HEAD
        "\"meshes\":[{\"primitives\":[{\"mode\":5,\"attributes\":{\"POSITION\":0}},{\"mode\":6,\"attributes\":{"
        "\"POSITION\":0}},"
        "{\"indices\":1,\"attributes\":{\"POSITION\":0}},{\"mode\":5,\"indices\":2,\"attributes\":{\"POSITION\":0}},"
        "{\"mode\":0,\"attributes\":{\"POSITION\":0}},{\"mode\":1,\"attributes\":{\"POSITION\":0}},"
        "{\"mode\":3,\"attributes\":{\"POSITION\":0}},{\"attributes\":{\"NORMAL\":0}}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5125,\"count\":6,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"componentType\":5121,\"count\":4,\"type\":\"SCALAR\"}],\"bufferViews\":["
        "{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":24},"
        "{\"buffer\":0,\"byteOffset\":84,\"byteLength\":4}]," BUFFER,
        TAIL(b)));
    if (loaded.scene.mesh_count != 4) {
        CHECK(loaded.scene.mesh_count == 4);
        return;
    }
    CHECK(are_indices(0, 9, strip) && are_indices(1, 9, fan) && are_indices(2, 6, list) && are_indices(3, 6, strip8));
    CHECK(loaded.scene.meshes[0].positions == loaded.scene.meshes[3].positions);
    CHECK(loaded.scene.meshes[2].index_format == LMB_INDEX_U16 && loaded.scene.instances[3].first_id == 9);
    CHECK(noted("points or lines skipped: 3") && noted("without POSITION skipped: 1"));
}

/* More than 65536 vertices need 32-bit indices; NaN positions are accepted and do not affect the bounds. */
static void gltf_large(void)
{
    enum { N = 65537 };
    float *values = (float *)calloc(3 * (size_t)N, sizeof *values);
    blob b = {{0}, 0};
    size_t i;
    uint8_t *bytes = (uint8_t *)malloc(12 * (size_t)N + 12);
    CHECK(values && bytes);
    if (!values || !bytes)
        return;
    values[3 * (N - 1)] = 1;
    for (i = 0; i < 3 * (size_t)N; ++i) {
        b.size = 0;
        put_f32(&b, i == 3 ? (float)NAN : i == 7 ? (float)INFINITY : values[i]);
        memcpy(bytes + 4 * i, b.bytes, 4);
    }
    b.size = 0;
    put_u32(&b, 0), put_u32(&b, N - 1), put_u32(&b, 1);
    memcpy(bytes + 12 * (size_t)N, b.bytes, 12);
    put_file("large.bin", bytes, 12 * (size_t)N + 12);
    CHECK_LOADS(
        load_text("large.gltf", HEAD
                  "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"accessors\":["
                  "{\"bufferView\":0,\"componentType\":5126,\"count\":65537,\"type\":\"VEC3\"},"
                  "{\"bufferView\":0,\"byteOffset\":786444,\"componentType\":5125,\"count\":3,\"type\":\"SCALAR\"}],"
                  "\"bufferViews\":[{\"buffer\":0,\"byteLength\":786456}],\"buffers\":[{\"byteLength\":786456,\"uri\":"
                  "\"large.bin\"}]}"));
    CHECK(loaded.scene.mesh_count == 1 && loaded.scene.meshes[0].index_format == LMB_INDEX_U32);
    CHECK(loaded.scene.mesh_count == 1 && index_at(0, 1) == N - 1 && isnan(position(0, 1)[0]));
    CHECK(is_vec(loaded.scene.bounds_max, 1, 0, 0));
    free(values);
    free(bytes);
}

/* --- glTF: materials --- */

static void gltf_materials(void)
{
    const lmb_material *m;
    blob b = {{0}, 0};
    put_floats(&b, unit_triangle, 9);
    CHECK_LOADS(load_text(
        "mats.gltf",
        HEAD MESH_OF_0
        ",\"extensionsRequired\":[\"KHR_materials_unlit\",\"KHR_materials_emissive_strength\"],\"materials\":["
        "{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,2,0.75],\"metallicFactor\":0}},"
        "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,1,1],\"metallicFactor\":0.5},\"alphaMode\":\"BLEND\"}"
        ","
        "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,1,1]},\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25},"
        "{\"extensions\":{\"KHR_materials_unlit\":{}},\"emissiveFactor\":[1,0,0]}]"
        "," POSITIONS_AT_0 ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}]," BUFFER,
        TAIL(b)));
    m = loaded.scene.materials;
    CHECK(loaded.scene.material_count == 5);
    if (loaded.scene.material_count != 5)
        return;
    CHECK(m[0].albedo[0] == 0.5f && m[0].albedo[1] == 0.25f && m[0].albedo[2] == 1 && m[0].alpha == 0.75f);
    CHECK(m[0].flags == LMB_DOUBLE_SIDED && m[0].texture == -1);
    CHECK(m[1].albedo[0] == 0.25f && m[1].flags == (LMB_ALPHA_MASK | LMB_ALPHA_BLEND) && m[1].alpha_cutoff == 0.5f && noted("BLEND"));
    CHECK(m[2].albedo[0] == 0.02f && m[2].albedo[2] == 0.04f && m[2].flags == LMB_ALPHA_MASK);
    CHECK(m[2].alpha_cutoff == 0.25f && m[3].albedo[0] == 1 && noted("unlit materials") && noted("metallic materials"));
    CHECK(!noted("emissive materials") && loaded.scene.instances[0].material == 4);
}

/* A PNG from a file with a space in the name, from a data URI and from a bufferView, each with a sampler. */
static void gltf_textures(void)
{
    file_bytes png = {NULL, 0};
    blob b = {{0}, 0};
    char data_uri[4096];
    const lmb_texture *t;
    put_floats(&b, unit_triangle, 9);
    make_png(&png, 4, 2, 10, 20, 30);
    snprintf(data_uri, sizeof data_uri, "%s", base64(png.data, png.size));
    memcpy(b.bytes + b.size, png.data, png.size);
    b.size += png.size;
    CHECK_LOADS(load_text(
        "tex.gltf",
        HEAD MESH_OF_0
        ",\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":{\"index\":0}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1},\"metallicRoughnessTexture\":{\"index\":2}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2}}},{\"pbrMetallicRoughness\":{"
        "\"baseColorTexture\":{\"index\":3}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":4}}},{\"pbrMetallicRoughness\":{"
        "\"baseColorTexture\":{\"index\":4}}}],"
        "\"textures\":[{\"source\":0},{\"source\":1,\"sampler\":0},{\"source\":2,\"sampler\":1},{\"source\":3},{"
        "\"source\":4}],"
        "\"samplers\":[{\"magFilter\":9728,\"minFilter\":9984,\"wrapS\":33071,\"wrapT\":33648},{\"minFilter\":9729,"
        "\"wrapT\":10497}],"
        "\"images\":[{\"uri\":\"one%%20white.png\"},{\"uri\":\"data:image/"
        "png;base64,%s\"},{\"bufferView\":1,\"mimeType\":\"image/png\"},"
        "{\"uri\":\"data:image/jpeg;base64,/9j/4AAQ\"},{\"uri\":\"no such.png\"}]," POSITIONS_AT_0
        ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":%u}]"
        "," BUFFER,
        data_uri, (unsigned)png.size, TAIL(b)));
    file_free(&png);
    t = loaded.scene.textures;
    CHECK(loaded.scene.texture_count == 4); /* one both as colour and as metallic map */
    CHECK(noted("left out, plain colour instead: 2 (first: images[3]: marker E0 at byte 2 runs"));
    if (loaded.scene.texture_count != 4)
        return;
    CHECK(t[0].filter == LMB_TRILINEAR && t[0].levels == 2 && t[0].width == 2 && t[0].texels[16] == 255);
    CHECK(t[1].filter == LMB_NEAREST && t[1].wrap_s == LMB_WRAP_CLAMP && t[1].wrap_t == LMB_WRAP_MIRROR);
    CHECK(t[1].width == 4 && t[1].height == 2 && t[1].levels == 1 &&
          memcmp(t[1].texels + 28, "\x0A\x14\x1E\xFF", 4) == 0);
    CHECK(t[3].filter == LMB_BILINEAR && t[3].wrap_s == LMB_WRAP_REPEAT && t[3].texels[2] == 30);
    CHECK(near(loaded.scene.materials[1].albedo[0], 1 - 30.0 / 255, 1e-6) && loaded.scene.materials[2].texture == 3);
    CHECK(loaded.scene.materials[3].texture == -1 && loaded.scene.materials[5].texture == -1);
}

/* A JPEG of 2 x 2 texels of 200, 100, 50. A metallic map uses the mean, and the texels are there for lobes. */
static void gltf_jpeg_texture(void)
{
    blob b = {{0}, 0};
    put_floats(&b, unit_triangle, 9);
    CHECK_LOADS(load_text(
        "jpeg.gltf",
        HEAD MESH_OF_0
        ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},"
        "\"metallicRoughnessTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0}],"
        "\"images\":[{\"uri\":\"data:image/jpeg;base64,"
        "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEB"
        "AQEBAQEBAQH/2wBDAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQH/wAAR"
        "CAACAAIDAREAAhEBAxEB/8QAFAABAAAAAAAAAAAAAAAAAAAABv/EABQQAQAAAAAAAAAAAAAAAAAAAAD/xAAUAQEAAAAAAAAAAAAAAAAAAAAJ"
        "/8QAFBEBAAAAAAAAAAAAAAAAAAAAAP/aAAwDAQACEQMRAD8APivNg//Z\"}]," POSITIONS_AT_0
        ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}]," BUFFER,
        TAIL(b)));
    CHECK(loaded.scene.texture_count == 2);
    if (loaded.scene.texture_count != 2)
        return;
    CHECK(loaded.scene.textures[0].width == 2 && memcmp(loaded.scene.textures[0].texels, "\xC8\x64\x32\xFF", 4) == 0);
    CHECK(near(loaded.scene.materials[0].albedo[0], 1 - 50.0 / 255, 1e-6));
}

/* offset + rotation (counter-clockwise, v down) * scale, and a separate texCoord. */
static void gltf_texture_transform(void)
{
    static const float uv[6] = {0, 0, 1, 0, 0, 1};
    blob b = {{0}, 0};
    const float *out;
    put_floats(&b, unit_triangle, 9);
    put_floats(&b, uv, 6);
    CHECK_LOADS(load_text(
        "move.gltf",
        HEAD
        "\"extensionsRequired\":[\"KHR_texture_transform\"],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":"
        "0,"
        "\"TEXCOORD_0\":0,\"TEXCOORD_1\":1},\"material\":0}]}],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":"
        "\"one%%20white.png\"}],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_"
        "transform\":"
        "{\"offset\":[0.5,0.25],\"rotation\":1.5707963267948966,\"scale\":[2,3],\"texCoord\":1}}}}}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60}]," BUFFER,
        TAIL(b)));
    if (loaded.scene.mesh_count != 1 || !loaded.scene.meshes[0].uvs) {
        CHECK(!"uvs");
        return;
    }
    out = (const float *)loaded.scene.meshes[0].uvs;
    CHECK(near(out[0], 0.5, 1e-6) && near(out[1], 0.25, 1e-6));
    CHECK(near(out[2], 0.5, 1e-6) && near(out[3], 0.25 - 2, 1e-6));
    CHECK(near(out[4], 0.5 + 3, 1e-6) && near(out[5], 0.25, 1e-6));
}

/* A node that a scene lists although it is another node's child is drawn once: below the parent if the parent is drawn,
 * otherwise by itself. */
static void gltf_named_children(void)
{
    blob b = {{0}, 0};
    put_floats(&b, unit_triangle, 9);
#define MOVED(x, more) "{\"mesh\":0,\"translation\":[" x ",0,0]" more "}"
#define NAMED(scene, nodes)                                                                                     \
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[" scene "]}],\"nodes\":[" nodes "]," MESH_OF_0 "," POSITIONS_AT_0   \
    ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}]," BUFFER
    CHECK_LOADS(load_text("named.gltf", NAMED("2,1,0", MOVED("1", ",\"children\":[1]") "," MOVED("2", ",\"children\":[2]") "," MOVED("4", "")),
                          TAIL(b)));
    CHECK(noted("nodes that a scene names though they are no roots, or twice; drawn once: 2"));
    CHECK(loaded.scene.instance_count == 3);
    for (uint32_t i = 0; i < loaded.scene.instance_count; ++i)
        CHECK(loaded.scene.instances[i].to_world.m[12] == (float)((2 << i) - 1)); /* 1, 1 + 2, 1 + 2 + 4 */
    CHECK_LOADS(load_text("named.gltf", NAMED("2,1", MOVED("1", ",\"children\":[1,2]") "," MOVED("2", "") "," MOVED("4", "")), TAIL(b)));
    CHECK(noted("drawn once: 2") && loaded.scene.instance_count == 2);
    if (loaded.scene.instance_count == 2)
        CHECK(loaded.scene.instances[0].to_world.m[12] == 4 && loaded.scene.instances[1].to_world.m[12] == 2);
    CHECK_LOADS(load_text("named.gltf", NAMED("0,1,0,1", MOVED("1", "") "," MOVED("2", "")), TAIL(b)));
    CHECK(noted("drawn once: 2") && loaded.scene.instance_count == 2);
    /* a listed descendant with an unlisted node in between */
    CHECK_LOADS(load_text("named.gltf", NAMED("0,2", MOVED("1", ",\"children\":[1]") "," MOVED("2", ",\"children\":[2]") "," MOVED("4", "")),
                          TAIL(b)));
    CHECK(noted("drawn once: 1") && loaded.scene.instance_count == 3);
#undef NAMED
#undef MOVED
}

/* --- glTF: damage --- */

/* Each body is placed between the head and a valid buffer of one triangle. */
static void gltf_refuses(void)
{
    static const struct {
        const char *body, *says;
    } bad[] = {
        {"\"nodes\":[{\"children\":[1]},{\"children\":[0]}]", "is its own ancestor"},
        {"\"nodes\":[{\"children\":[0]}]", "is its own ancestor"},
        {"\"nodes\":[{},{\"children\":[3]},{\"children\":[3]},{}]",
         "nodes[2].children[0]: node 3 already is a child of node 1"},
        {"\"nodes\":[{\"children\":[9]}]", "nodes[0].children[0]: index 9, but there are 1"},
        {"\"nodes\":[{\"mesh\":0}]", "nodes[0].mesh: index 0, but there are 0"},
        {"\"nodes\":[{\"rotation\":[0,0,0,0]}]", "nodes[0]: rotation"},
        {"\"nodes\":[{\"matrix\":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}]", "nodes[0].matrix: the last row"},
        {"\"nodes\":[{\"matrix\":[1,0]}]", "nodes[0].matrix: must be an array of 16"},
        {"\"nodes\":[{\"scale\":[1e200,1,1]}]", "nodes[0]: its place"},
        {"\"nodes\":[{\"camera\":0}],\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":9,\"znear\":1}}]",
         "cameras[0].perspective"},
        {"\"nodes\":[{\"camera\":0}],\"cameras\":[{}]", "cameras[0]: type must be"},
        {"\"nodes\":[{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]", "light: index 0, but there are 0"},
        {"\"nodes\":[{}],\"extensionsRequired\":[\"KHR_lights_punctual\",\"KHR_draco_mesh_compression\"]",
         "extensionsRequired[1]: requires KHR_draco_mesh_compression"},
        {"\"nodes\":7", "nodes: must be an array"},
        {"\"nodes\":[[]]", "nodes[0]: must be an object"},
        {"\"nodes\":[{\"mesh\":0}]," MESH_OF_0,
         "meshes[0].primitives[0].attributes.POSITION: index 0, but there are 0"},
#define MESH "\"nodes\":[{\"mesh\":0}]," MESH_OF_0 ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":["
        {MESH "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}]",
         "accessors[0]: 4 elements from byte 0"},
        {MESH "{\"bufferView\":0,\"byteOffset\":4294967294,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]",
         "do not fit"},
        {MESH "{\"bufferView\":0,\"componentType\":5126,\"count\":2147483648,\"type\":\"VEC3\"}]",
         "2147483648 elements"},
        {MESH "{\"componentType\":5126,\"count\":2147483648,\"type\":\"VEC3\"}]", "bytes of memory a byte of file"},
        {MESH "{\"bufferView\":0,\"componentType\":5126,\"count\":-1,\"type\":\"VEC3\"}]",
         "accessors[0].count: must be a whole"},
        {MESH "{\"bufferView\":0,\"componentType\":5126,\"count\":1e99,\"type\":\"VEC3\"}]",
         "accessors[0].count: must be a whole"},
        {MESH "{\"bufferView\":0,\"componentType\":5126,\"count\":0,\"type\":\"VEC3\"}]", "count must be at least 1"},
        {MESH "{\"bufferView\":0,\"componentType\":5124,\"count\":3,\"type\":\"VEC3\"}]", "componentType 5124"},
        {MESH "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC5\"}]", "type must be"},
        {MESH "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}]",
         "attributes.POSITION: accessor 0 has a type"},
        {MESH "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]",
         "accessors[0].bufferView: index 1"},
        {"\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":7}]}]",
         "mode 7"},
        {"\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
         "\"bufferViews\":"
         "[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
         "\"type\":\"VEC3\"},"
         "{\"bufferView\":0,\"componentType\":5125,\"count\":6,\"type\":\"SCALAR\"}]",
         "accessors[1]: index 1065353216 at entry 3, but there are 3"},
        {"\"nodes\":[{\"mesh\":0}]," MESH_OF_0 ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":37}]," POSITIONS_AT_0,
         "bufferViews[0]: bytes 0 + 37"},
        {"\"nodes\":[{\"mesh\":0}]," MESH_OF_0
         ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36,\"byteStride\":4}]," POSITIONS_AT_0,
         "byteStride 4"},
        {"\"nodes\":[{\"mesh\":0}]," MESH_OF_0 ",\"bufferViews\":[{\"buffer\":1,\"byteLength\":36}]," POSITIONS_AT_0,
         "bufferViews[0].buffer: index 1"},
    };
    blob b = {{0}, 0};
    size_t i;
    put_floats(&b, unit_triangle, 9);
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        check_fails(load_text("bad.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],%s," BUFFER,
                              bad[i].body, TAIL(b)),
                    bad[i].says);
}

static void gltf_refuses_buffers(void)
{
    static const struct {
        const char *buffer, *says;
    } bad[] = {
        {"{\"byteLength\":36,\"uri\":\"http://example.org/a.bin\"}",
         "buffers[0].uri: absolute URI \"http://example.org/a.bin\""},
        {"{\"byteLength\":36,\"uri\":\"/etc/hostname\"}", "absolute URI"},
        {"{\"byteLength\":36,\"uri\":\"C:\\\\a.bin\"}", "absolute URI"},
        {"{\"byteLength\":36,\"uri\":\"a%0\"}", "damaged %-escape"},
        {"{\"byteLength\":36,\"uri\":\"a%00b\"}", "damaged %-escape"},
        {"{\"byteLength\":36,\"uri\":\"not there.bin\"}", "not there.bin"},
        {"{\"byteLength\":36,\"uri\":\"data:;base64,AAAA\"}", "buffers[0]: byteLength 36, but only 3 bytes"},
        {"{\"byteLength\":36,\"uri\":\"data:;base64,A*AA\"}", "damaged base64"},
        {"{\"byteLength\":36,\"uri\":\"data:,AAAA\"}", "not base64"},
        {"{\"byteLength\":36,\"uri\":3}", "buffers[0].uri: must be a URI"},
        {"{\"byteLength\":36}", "no uri and no GLB chunk"},
        {"{\"uri\":\"data:;base64,AAAA\"}", "byteLength is missing"},
    };
    size_t i;
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        check_fails(load_text("bad.gltf",
                              HEAD MESH_OF_0 "," POSITIONS_AT_0 ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                                             "\"buffers\":[%s]}",
                              bad[i].buffer),
                    bad[i].says);
    check_fails(load_text("bad.gltf", "{\"asset\":{\"version\":\"1.0\"}}"), "asset: version is not 2.x");
    check_fails(load_text("bad.gltf", "{}"), "version is not 2.x");
    check_fails(load_text("bad.txt", "hello"), "not a model that lambent reads");
    check_fails(load("not there.gltf"), "not there.gltf");
    CHECK_LOADS(load_text("empty.gltf", "{\"asset\":{\"version\":\"2.0\"}}"));
    CHECK(loaded.scene.instance_count == 0 && lmb_scene_check(&loaded.scene) == LMB_OK);
}

/* A GLB of one triangle. */
static void make_glb(blob *b)
{
    static const char doc[] = HEAD MESH_OF_0 "," POSITIONS_AT_0 ",\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                                             "\"buffers\":[{\"byteLength\":36}]}   ";
    const uint32_t size = (uint32_t)(sizeof doc - 1) & ~3u;
    b->size = 0;
    put_u32(b, 0x46546C67u), put_u32(b, 2), put_u32(b, 12 + 8 + size + 8 + 36);
    put_u32(b, size), put_u32(b, 0x4E4F534Au);
    memcpy(b->bytes + b->size, doc, size);
    b->size += size;
    put_u32(b, 36), put_u32(b, 0x004E4942u);
    put_floats(b, unit_triangle, 9);
}

static void glb_prefixes(void)
{
    blob b, broken;
    size_t n;
    make_glb(&b);
    put_file("whole.glb", b.bytes, b.size);
    CHECK_LOADS(load("whole.glb"));
    CHECK(lmb_scene_triangles(&loaded.scene) == 1);
    for (n = 0; n < b.size; ++n) {
        put_file("part.glb", b.bytes, n);
        check_fails(load("part.glb"), "part.glb: ");
        if (n < 12)
            continue;
        broken = b; /* and with a header that matches the cut */
        broken.size = 8;
        put_u32(&broken, (uint32_t)n);
        put_file("part.glb", broken.bytes, n);
        check_fails(load("part.glb"), "part.glb: ");
    }
    broken = b;
    broken.bytes[4] = 1;
    put_file("part.glb", broken.bytes, b.size);
    check_fails(load("part.glb"), "GLB version 1");
}

/* Damages every byte, one at a time: the file loads or fails. */
static void glb_damage(void)
{
    blob b, broken;
    size_t i;
    int k;
    make_glb(&b);
    for (i = 0; i < b.size; ++i)
        for (k = 0; k < 3; ++k) {
            broken = b;
            broken.bytes[i] = (uint8_t)(k == 0 ? 0 : k == 1 ? 255 : b.bytes[i] ^ 16);
            put_file("hurt.glb", broken.bytes, b.size);
            CHECK(load("hurt.glb") ? lmb_scene_check(&loaded.scene) == LMB_OK : problem.text[0] != '\0');
        }
}

static void far_away(void)
{
    CHECK_LOADS(load_text("far.obj", "v 90000 0 0\nv 90001 0 0\nv 90000 1 0\nf 1 2 3\n"));
    CHECK(noted("from the origin"));
    CHECK_LOADS(load_text("near.obj", "v 900 0 0\nv 901 0 0\nv 900 1 0\nf 1 2 3\n"));
    CHECK(!noted("from the origin"));
}

/* --- OBJ --- */

static void obj_plain(void)
{
    static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};
    CHECK_LOADS(load_text("quad.obj", "# a quad\r\no thing\r\ng a b\ns off\nv 0 0 0\nv 1 0 0 1\n"
                                      "v 1 1 \\\r\n 0\nv 0 1 0\nf -4 -3 -2 -1 # negative\nl 1 2\np 1\nf 1 2\n"));
    if (loaded.scene.mesh_count != 1) {
        CHECK(loaded.scene.mesh_count == 1);
        return;
    }
    CHECK(loaded.scene.meshes[0].vertex_count == 4 && are_indices(0, 6, quad) && is_position(0, 2, 1, 1, 0));
    CHECK(!loaded.scene.meshes[0].normals && !loaded.scene.meshes[0].uvs && !loaded.scene.meshes[0].colours);
    CHECK(loaded.scene.materials[0].flags == LMB_DOUBLE_SIDED && loaded.scene.materials[0].albedo[0] == 0.8f);
    CHECK(noted("points or lines skipped: 2") && noted("fewer than 3 corners skipped: 1"));
    CHECK(loaded.scene.instances[0].first_id == 1 && loaded.scene.instances[0].to_world.m[5] == 1);
}

/* Two triangles share an edge with equal corners, a third has another vt there: 4 + 2 vertices. */
static void obj_corners(void)
{
    static const char library[] = "newmtl a\nKd 1 1 1\nmap_Kd -s 1 1 1 -clamp on one white.png\n";
    const lmb_mesh *m;
    put_file("m.mtl", library, sizeof library - 1);
    CHECK_LOADS(load_text(
        "c.obj", "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.25 1\nvn 0 0 2\n"
                 "usemtl a\nf 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/1/1\nf 1/2/1 2/2/1 3/1/1\nf 1/1 2/1 3/1\n"));
    if (loaded.scene.mesh_count != 2 || !loaded.scene.meshes[1].normals || !loaded.scene.meshes[1].uvs) {
        CHECK(!"meshes");
        return;
    }
    m = &loaded.scene.meshes[1];
    CHECK(m->vertex_count == 6 && m->triangle_count == 3 && index_at(1, 3) == 0 && index_at(1, 8) == 2);
    CHECK(!loaded.scene.meshes[0].normals && loaded.scene.meshes[0].triangle_count == 1);
    CHECK(loaded.scene.instances[0].material == loaded.scene.instances[1].material);
    CHECK(((const float *)m->uvs)[1] == 1 && ((const float *)m->uvs)[8] == 0.25f && ((const float *)m->uvs)[9] == 0);
    CHECK(is_vec(lmb_octahedral_decode(m->normals), 0, 0, 1));
    CHECK(m->colours && has_light(1, 0, 0, 1) && has_light(1, 0, 1, 0) && has_light(1, 1, 1, 0.214041) && has_light(1, 2, 0, 1));
    CHECK(loaded.scene.texture_count == 1 && loaded.scene.textures[0].wrap_s == LMB_WRAP_CLAMP);
    CHECK(loaded.scene.textures[0].filter == LMB_TRILINEAR && loaded.scene.textures[0].levels == 2);
}

/* A triangle with the three given `v` lines. */
static int load_painted(const char *v, const char *more, int32_t colours)
{
    const model_choice choice = {NULL, colours, 0};
    char path[FOLDER_PATH];
    const int n = snprintf(text, sizeof text, "%s%sf 1 2 3\n", v, more);
    put_file("v.obj", text, (size_t)n);
    path_of(path, "v.obj");
    forget();
    return model_load_as(&loaded, path, &choice, &notes, &problem);
}

static int is_colour(uint32_t v, int r, int g, int b)
{
    const int code[3] = {r, g, b};
    lmb_vertex at;
    int ok = loaded.scene.mesh_count && loaded.scene.meshes[0].colours && lmb_mesh_vertex(&at, &loaded.scene.meshes[0], v);
    for (int k = 0; ok && k < 3; ++k)
        ok = (int)(at.colour[k] * 255.0f + 0.5f) == code[k];
    return ok && at.colour[3] == 1.0f;
}

/* Vertex colours are sRGB codes, also after a weight or before an alpha. White stays white. */
static void obj_colours(void)
{
    static const char plain[] = "v 0 0 0 1 0.737255 0\nv 1 0 0 .2 .2 .2\nv 0 1 0\n";
    static const char kd[] = "newmtl a\nKd 0.5 0.5 0.5\n";
    put_file("kd.mtl", kd, sizeof kd - 1);
    CHECK_LOADS(load_painted(plain, "", MODEL_COLOURS_SRGB));
    CHECK(is_colour(0, 255, 128, 0) && is_colour(1, 8, 8, 8) && loaded.scene.materials[0].albedo[1] == 1.0f);
    CHECK(is_colour(2, 204, 204, 204)); /* a vertex without a colour is as grey as in a file without colours */
    CHECK_LOADS(load_painted(plain, "", MODEL_COLOURS_LINEAR));
    CHECK(is_colour(0, 255, 188, 0) && is_colour(1, 51, 51, 51) && is_colour(2, 204, 204, 204));
    CHECK_LOADS(load_painted(plain, "mtllib kd.mtl\nusemtl a\n", MODEL_COLOURS_SRGB));
    CHECK(is_colour(0, 255, 128, 0) && is_colour(2, 255, 255, 255) && loaded.scene.materials[1].albedo[1] == 0.5f);
    CHECK_LOADS(load_painted("v 0 0 0 1 0 .737255 0\nv 1 0 0 1 0 0 1\nv 0 1 0 1.0 1 1 1\n", "", MODEL_COLOURS_SRGB));
    CHECK(is_colour(0, 0, 128, 0) && is_colour(1, 0, 0, 255) && notes.count == 0);
    CHECK_LOADS(load_painted("v 0 0 0 1 .737255 0 1\nv 1 0 0 0 0 1 1\nv 0 1 0 1 1 1 .5\n", "", MODEL_COLOURS_SRGB));
    CHECK(is_colour(0, 255, 128, 0) && is_colour(1, 0, 0, 255) && noted("alpha under 1, drawn opaque: 1"));
    CHECK_LOADS(load_painted("v 0 0 0 255 188 0\nv 1 0 0 0 0 1\nv 0 1 0 10 20 30\n", "", MODEL_COLOURS_SRGB));
    CHECK(is_colour(0, 255, 128, 0) && is_colour(1, 0, 0, 0) && noted("whole numbers, read as 0 to 255"));
    CHECK_LOADS(load_painted("v 0 0 0 1 2 3\nv 1 0 0 .00095 .0004 1\nv 0 1 0 0 0 0\n", "", MODEL_COLOURS_LINEAR));
    CHECK(has_light(0, 1, 0, 0.00095) && has_light(0, 1, 1, 0.0004) && has_light(0, 1, 2, 1)); /* dark ratios stay */
    CHECK_LOADS(load_painted("v 0 0 0 10 20 3\nv 1 0 0 0 2 1\nv 0 1 0 0 0 0\n", "", MODEL_COLOURS_SRGB));
    CHECK(has_light(0, 0, 2, 0.000910581) && has_light(0, 1, 1, 0.000607054) && has_light(0, 1, 2, 0.000303527));
}

/* --- smoothing groups --- */

#define ROOF "v -1 -1 0\nv 0 -1 1\nv 0 1 1\nv -1 1 0\nv 1 -1 0\nv 1 1 0\n" /* the ridge: 2 and 3 */
static const double slope = 0.7071067811865476;

/* Returns the normal of the only mesh at this position: the first one with an x of this sign; zeros if there is
 * none. */
static int has_normal(double px, double py, double pz, double x, double y, double z)
{
    const lmb_mesh *m = &loaded.scene.meshes[0];
    uint32_t i;
    for (i = 0; loaded.scene.mesh_count == 1 && m->normals && i < m->vertex_count; ++i) {
        const lmb_vec3 n = lmb_octahedral_decode(m->normals + 2 * (size_t)i);
        if (is_position(0, i, px, py, pz) && near(n.x, x, 1e-4) && near(n.y, y, 1e-4) && near(n.z, z, 1e-4))
            return 1;
    }
    return 0;
}

/* fo is f by an old name. */
static void obj_face_outline(void)
{
    CHECK_LOADS(load_text("s.obj", ROOF "s 1\nfo 1 2 3 4\nfo 2 5 6 3\n"));
    CHECK(loaded.scene.meshes[0].vertex_count == 6 && has_normal(0, -1, 1, 0, 0, 1));
}

static int is_flat(const char *lines)
{
    CHECK_LOADS(load_text("s.obj", "%s", lines));
    return loaded.scene.mesh_count == 1 && !loaded.scene.meshes[0].normals && !noted("makes smooth");
}

static void obj_smoothing(void)
{
    CHECK_LOADS(load_text("s.obj", ROOF "s 1\nf 1 2 3 4\nf 2 5 6 3\n"));
    CHECK(loaded.scene.meshes[0].vertex_count == 6 && has_normal(0, -1, 1, 0, 0, 1) && has_normal(0, 1, 1, 0, 0, 1));
    CHECK(has_normal(-1, 1, 0, -slope, 0, slope) && has_normal(1, -1, 0, slope, 0, slope));
    CHECK(noted("smoothing group (s) makes smooth: 2"));
    CHECK(is_flat(ROOF "f 1 2 3 4\nf 2 5 6 3\n") && is_flat(ROOF "s off\nf 1 2 3 4\nf 2 5 6 3\n") &&
          is_flat(ROOF "s 0\nf 1 2 3 4\nf 2 5 6 3\n") && is_flat(ROOF "s 7\ns 0\nf 1 2 3 4\nf 2 5 6 3\n"));
    CHECK_LOADS(load_text("s.obj", ROOF "s 1\nf 1 2 3 4\ns 2\nf 2 5 6 3\n"));
    CHECK(has_normal(0, -1, 1, -slope, 0, slope) && has_normal(0, -1, 1, slope, 0, slope));
    CHECK(!has_normal(0, -1, 1, 0, 0, 1) && loaded.scene.meshes[0].vertex_count == 8);
    CHECK_LOADS(load_text("s.obj", ROOF "s 3\nf 1 2 3 4\ns off\ns 3\no other\nf 2 5 6 3\n"));
    CHECK(has_normal(0, -1, 1, 0, 0, 1));
}

/* Duplicate vertices, vertices with different texture coordinates, a face before its vertices, and normals of the file,
 * which are kept. */
static void obj_smoothing_corners(void)
{
    CHECK_LOADS(load_text("s.obj", ROOF "v -0.0 -1 1\nv 0 1 1\ns 1\nf 1 2 3 4\nf 7 5 6 8\n"));
    CHECK(loaded.scene.meshes[0].vertex_count == 8 && has_normal(0, -1, 1, 0, 0, 1) &&
          !has_normal(0, -1, 1, slope, 0, slope) && !has_normal(0, -1, 1, -slope, 0, slope));
    CHECK_LOADS(load_text("s.obj", "s 1\nf 1 2 3 4\nf 2/2 5 6 3/1\n" ROOF "vt 0 0\nvt 1 1\n"));
    CHECK(has_normal(0, -1, 1, 0, 0, 1) && !has_normal(0, -1, 1, slope, 0, slope));
    CHECK_LOADS(load_text("s.obj", ROOF "vn 0 1 0\ns 1\nf 1 2 3 4\nf 2//1 5//1 6//1 3//1\n"));
    CHECK(has_normal(0, -1, 1, -slope, 0, slope) && has_normal(0, -1, 1, 0, 1, 0) && !has_normal(0, -1, 1, 0, 0, 1));
    CHECK_LOADS(load_text("s.obj", ROOF "vn 0 1 0\ns 1\nf 1 2//1 3 4\nf 2 5 6 3\n"));
    CHECK(has_normal(0, -1, 1, 0, 1, 0) && has_normal(0, 1, 1, 0, 0, 1));
    CHECK(is_flat(ROOF "vn 0 1 0\nf 1 2//1 3 4\n"));
}

/* For any triangulation, the corner normals of a cube point along its diagonals. One side has three times as many
 * pieces. */
static void obj_smoothing_weights(void)
{
    int i;
    CHECK_LOADS(load_text("s.obj", "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                                   "v 0 0 1\ns 1\nf 4 3 2 1\nf 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                                   "f 4 1 5 8\n"));
    for (i = 0; i < 8; ++i) {
        const double x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1, z = i & 4 ? 1 : -1, a = 0.5773502691896258;
        CHECK_MSG(has_normal(x, y, z, a * x, a * y, a * z), "corner %d", i);
    }
    CHECK(has_normal(0, 0, 1, 0, 0, 1));
}

/* Triangles with no area, or almost none, change no normal. Coincident sides keep their normals. Invalid lines are
 * noted. */
static void obj_smoothing_odd(void)
{
    CHECK_LOADS(load_text("s.obj", ROOF "v 0 0 1.00000001\nv 0 0 1\nv nan 0 0\ns 1\nf 1 2 3 4\nf 2 5 6 3\nf 2 3 3\nf 2 7 3\n"
                                        "f 2 8 3\nf 2 2 2\nf 2 3 9\n"));
    CHECK(has_normal(0, -1, 1, 0, 0, 1) && has_normal(0, 1, 1, 0, 0, 1));
    CHECK_LOADS(load_text("s.obj", ROOF "s 1\nf 1 2 3 4\nf 4 3 2 1\n"));
    CHECK(has_normal(0, -1, 1, -slope, 0, slope));
    CHECK_LOADS(load_text("s.obj", ROOF "v 0.00001 0 1\ns 1\nf 2 7 3\n")); /* only a sliver */
    CHECK(has_normal(0, -1, 1, 0, 0, 1));
    CHECK(is_flat(ROOF "s yes\nf 1 2 3 4\n") && noted("smoothing groups that are no number, taken as off: 1"));
    CHECK_LOADS(load_text("s.obj", ROOF "s on\nf 1 2 3 4\ns 1\nf 2 5 6 3\n")); /* group 1 */
    CHECK(has_normal(0, -1, 1, 0, 0, 1) && noted("makes smooth: 2") && !noted("taken as off"));
    CHECK(is_flat(ROOF "s\ns -1\ns 2147483647\nf 1 2 3 4\n") && noted("taken as off: 3"));
    CHECK_LOADS(load_text("s.obj", ROOF "s 2147483646\nf 1 2 3 4\nf 2 5 6 3\n"));
    CHECK(has_normal(0, -1, 1, 0, 0, 1));
}

/* Normals without length are replaced by those of the faces at the vertex, or +Y if the faces have no area. Infinite
 * normals too. */
static void obj_odd_normals(void)
{
    CHECK_LOADS(load_text("n.obj", ROOF "vn 0 0 0\nvn 0 0 inf\nvn 0 3 0\nf 1//1 2//1 3//1 4//2\nf 2//1 5//3 6//2 3//1\n"));
    CHECK(has_normal(-1, -1, 0, -slope, 0, slope) && has_normal(-1, 1, 0, -slope, 0, slope));
    CHECK(has_normal(0, -1, 1, 0, 0, 1) && has_normal(1, 1, 0, slope, 0, slope) && has_normal(1, -1, 0, 0, 1, 0));
    CHECK(noted("normals without length, made from the faces there: 5"));
    CHECK_LOADS(load_text("n.obj", ROOF "vn 0 0 0\nf 1//1 1//1 3//1\n"));
    CHECK(has_normal(-1, -1, 0, 0, 1, 0));
}

/* Two primitives share normals without length and use different vertices of them. */
static void gltf_odd_normals(void)
{
    static const float places[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1};
    float data[36] = {0};
    static const uint16_t indices[6] = {0, 1, 2, 3, 4, 5};
    uint8_t bytes[sizeof data + sizeof indices];
    memcpy(data, places, sizeof places);
    data[18 + 14] = 2; /* z of vertex 4 */
    memcpy(bytes, data, sizeof data);
    memcpy(bytes + sizeof data, indices, sizeof indices);
    put_file("n.bin", bytes, sizeof bytes);
    CHECK_LOADS(load_text("n.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"uri\":\"n.bin\",\"byteLength\":156}],\"bufferViews\":["
        "{\"buffer\":0,\"byteLength\":72},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":72},"
        "{\"buffer\":0,\"byteOffset\":144,\"byteLength\":12}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,1]},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"byteOffset\":6,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2},"
        "{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":3}]}],\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}],"
        "\"scene\":0}"));
    CHECK(loaded.scene.mesh_count == 2 && noted("normals without length, made from the faces there: 5"));
    for (uint32_t i = 0; loaded.scene.mesh_count == 2 && i < 6; ++i) {
        const lmb_vec3 n = lmb_octahedral_decode(loaded.scene.meshes[0].normals + 2 * (size_t)i);
        CHECK_MSG(is_vec(n, i > 2 && i != 4, 0, i < 3 || i == 4), "vertex %u", (unsigned)i);
    }
}

static void obj_materials(void)
{
    static const char library[] =
        "newmtl red\n\tKd 0.5 0.25 2 # too bright\nd 0.5\nnewmtl gone\nd 0\nnewmtl pic\n"
        "map_Kd no\\such picture.png\nnewmtl pic2\nKd 0.125 0.125 0.125\nmap_Kd no\\such picture.png\n"
        "newmtl clear\nTr 1\nnewmtl other\nKd 0 0 0\n";
    const lmb_material *m;
    put_file("lib.mtl", library, sizeof library - 1);
    CHECK_LOADS(
        load_text("mat.obj",
                  "mtllib lib.mtl\nmtllib lib.mtl\nmtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"
                  "usemtl gone\nf 1 2 3\nusemtl red\nf 3 2 1\nusemtl pic\nf 1 2 3\nusemtl pic2\nf 1 2 3\n"
                  "usemtl clear\nf 1 2 3\nusemtl unknown one\nf 1 2 3\n"));
    m = loaded.scene.materials;
    CHECK(loaded.scene.material_count == 7 && loaded.scene.instance_count == 6 && loaded.scene.texture_count == 0);
    if (loaded.scene.material_count != 7 || loaded.scene.mesh_count != 6)
        return;
    CHECK(m[1].albedo[0] == 0.5f && m[1].albedo[2] == 1 && m[1].alpha == 0.5f && (m[1].flags & LMB_ALPHA_BLEND));
    CHECK(m[2].alpha == 0 && (m[2].flags & LMB_ALPHA_MASK) && m[3].albedo[0] == 0.8f && m[4].albedo[0] == 0.125f);
    CHECK(m[5].alpha == 0 && m[6].albedo[0] == 0.8f && loaded.scene.meshes[0].triangle_count == 2);
    CHECK(noted("left out, plain colour instead: 1 (first:") && noted("missing.mtl") && noted("drawn grey: 1"));
}

static void obj_refuses(void)
{
    static const struct {
        const char *lines, *says;
    } bad[] = {
        {"", "the file is empty (0 bytes)"},
        {"v 0 0 0\n", "no faces"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: v number 4, but there are 3"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4: v number 0"},
        {"v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n", "line 3: v number -3, but there are 2"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n", "line 4: vt number 1, but there are 0"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//9 2//1 3//1\n", "line 4: vn number 9"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/x 2 3\n", "line 4: \"x\" is not a vt number"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/// 2 3\n", "is not a vn number"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 99999999999999999999 2 3\n", "is not a v number"},
        {"v 0 0\nf 1 1 1\n", "line 1: 2 numbers where 3 are needed"},
        {"v 0 0 zero\nf 1 1 1\n", "line 1: \"zero\" is not a number"},
        {"v 0 0 0x\nf 1 1 1\n", "\"0x\" is not a number"},
        {"v 0 0 0000000000000000000000000000000000000000000000000000000000000000\nf 1 1 1\n", "is not a number"},
    };
    size_t i;
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        check_fails(load_text("bad.obj", "%s", bad[i].lines), bad[i].says);
    CHECK_LOADS(load_text("nan.obj", "v nan 0 0\nv inf 0 0\nv 1e300 1 0\nv 1 1 1\nf 1 2 3 4\nf 4 4 4\n"));
    CHECK(lmb_scene_triangles(&loaded.scene) == 3 && isnan(position(0, 0)[0]) && isinf(position(0, 2)[0]));
    CHECK_LOADS(load_text("go.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\\\nf 1 2 3\nf 1 2 3\nmtllib b\\\r\nf 1 2 3"));
    CHECK(lmb_scene_triangles(&loaded.scene) == 1); /* a backslash also continues the line of usemtl */
}

/* Damages every byte, as for GLB. */
static void obj_damage(void)
{
    static const char model_text[] =
        "mtllib m.mtl\nv 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nv .5 .5 0\nvt 0 1\nvn 0 0 1\nusemtl a\n"
        "f 1/1/1 2/1/1 3/1/1 4/1/1\nf -1 \\\n-2 -3\n";
    static const char swap[] = "\\\n/#-9 \0f";
    char broken[sizeof model_text];
    size_t i, k;
    for (i = 0; i + 1 < sizeof model_text; ++i)
        for (k = 0; k + 1 < sizeof swap; ++k) {
            memcpy(broken, model_text, sizeof broken);
            broken[i] = swap[k];
            put_file("hurt.obj", broken, sizeof broken - 1);
            CHECK(load("hurt.obj") ? lmb_scene_check(&loaded.scene) == LMB_OK : problem.text[0] != '\0');
        }
}

/* --- polygons --- */

static double area_of(const double *p, const uint32_t *t)
{
    const double *a = p + 3 * t[0], *b = p + 3 * t[1], *c = p + 3 * t[2];
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

/* Positive areas that sum to the polygon's: no overlap, and the winding is kept. */
static void check_cut(const double *points, uint32_t n, double area)
{
    uint32_t cut[3 * 64], links[2 * 64], i;
    double sum = 0;
    CHECK(polygon_cut(cut, points, n, links));
    for (i = 0; i + 2 < n; ++i) {
        const double one = area_of(points, cut + 3 * i);
        CHECK(area > 0 ? one >= 0 : one <= 0);
        sum += one;
    }
    CHECK_MSG(fabs(sum - area) < 1e-12 * fabs(area), "%g, not %g", sum, area);
}

static void polygons(void)
{
    static const double dart[12] = {2, 0, 0, 0.5, 0.5, 0, 0, 2, 0, 0, 0, 0};
    static const double comb[36] = {0, 0, 5, 5, 0, 5, 5, 3, 5, 4, 3, 5, 4, 1, 5, 3, 1, 5,
                                    3, 3, 5, 2, 3, 5, 2, 1, 5, 1, 1, 5, 1, 3, 5, 0, 3, 5};
    static const double ring[30] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 0, 0, 0, /* bridge to a hole */
                                    1, 1, 0, 1, 3, 0, 3, 3, 0, 3, 1, 0, 1, 1, 0};
    double back[36];
    uint32_t cut[6], links[8];
    int i;
    check_cut(dart, 4, 1);
    CHECK(polygon_cut(cut, dart, 4, links) && !(cut[0] == 0 && cut[1] == 1 && cut[2] == 2));
    check_cut(comb, 12, 11);
    check_cut(ring, 10, 12);
    for (i = 0; i < 36; ++i)
        back[i] = comb[3 * (11 - i / 3) + i % 3];
    check_cut(back, 12, -11);
}

/* --- real files --- */

/* Triangles placed in the default scene; GlassVaseFlowers shows one mesh (of 3,818) twice. */
static const struct {
    const char *path;
    uint32_t triangles, lights, cameras;
} known[] = {
    {"data/gltf/Avocado.glb", 682, 0, 0},
    {"data/gltf/Box.glb", 12, 0, 0},
    {"data/gltf/BoxTextured.glb", 12, 0, 0},
    {"data/gltf/Duck.glb", 4212, 0, 1},
    {"data/gltf/GlassVaseFlowers.glb", 14036, 0, 0},
    {"data/gltf/LeePerrySmith.glb", 17684, 0, 0},
    {"data/gltf/LightsPunctualLamp.glb", 6000, 5, 0},
    {"data/gltf/Suzanne.glb", 3936, 0, 0},
    {"data/gltf/VertexColorTest.glb", 36, 0, 0},
    {"data/gltf/kenney-character.glb", 550, 0, 0},
    {"data/gltf/kenney-platform-large.glb", 254, 0, 0},
    {"data/gltf/plastic_monobloc_chair.glb", 3356, 0, 0},
    {"data/scenes/living_room.glb", 5088, 0, 0},
    {"data/scenes/CornellBox-Original.obj", 36, 0, 0},
    {"data/scenes/CornellBox-Sphere.obj", 2188, 0, 0},
    {"data/scenes/zdm2.obj", 70754, 0, 0},
    {"data/meshes/spot.obj", 5856, 0, 0},
    {"data/meshes/stanford_bunny.obj", 69451, 0, 0},
    {"truth/bunny_room/scene.gltf", 69583, 1, 1},
    {"truth/cornell/scene.gltf", 34, 1, 1},
    {"truth/corner_contact/scene.gltf", 4010, 1, 1},
    {"truth/corridor/scene.gltf", 144, 1, 1},
    {"truth/furnace_sphere/scene.gltf", 9024, 1, 1},
    {"truth/grazing_sun/scene.gltf", 2572, 1, 1},
    {"truth/many_lights_100/scene.gltf", 1032, 100, 1},
    {"truth/many_lights_1000/scene.gltf", 1032, 1000, 1},
    {"truth/many_lights_10000/scene.gltf", 1032, 10000, 1},
    {"truth/mixed_with/scene.gltf", 4148, 1, 1},
    {"truth/mixed_without/scene.gltf", 168, 1, 1},
    {"truth/point_room/scene.gltf", 2436, 1, 1},
    {"truth/sponza/scene.gltf", 56095, 1, 1},
    {"truth/two_lights/scene.gltf", 2412, 2, 1},
};

static void known_files(void)
{
    char path[SHARED_PATH];
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i) {
        if (!shared_file(path, known[i].path))
            continue;
        CHECK_LOADS(load_file(path));
        CHECK_MSG(lmb_scene_triangles(&loaded.scene) == known[i].triangles, "%s: %u", path,
                  (unsigned)lmb_scene_triangles(&loaded.scene));
        CHECK(loaded.scene.light_count == known[i].lights && loaded.camera_count == known[i].cameras);
    }
}

void test_models(void)
{
    file_bytes white = {NULL, 0};
    json_values();
    json_paths();
    json_refuses();
    json_depth();
    polygons();
    folder_open(&place);
    make_png(&white, 2, 2, 255, 255, 255);
    put_file("one white.png", white.data, white.size);
    file_free(&white);
    gltf_nodes();
    gltf_lights();
    gltf_cameras();
    gltf_interleaved();
    gltf_integers();
    gltf_sparse();
    gltf_sparse_order();
    gltf_modes();
    gltf_large();
    gltf_materials();
    gltf_textures();
    gltf_jpeg_texture();
    gltf_texture_transform();
    gltf_named_children();
    gltf_refuses();
    gltf_refuses_buffers();
    glb_prefixes();
    glb_damage();
    far_away();
    obj_plain();
    obj_corners();
    obj_colours();
    obj_odd_normals();
    gltf_odd_normals();
    obj_face_outline();
    obj_smoothing();
    obj_smoothing_corners();
    obj_smoothing_weights();
    obj_smoothing_odd();
    obj_materials();
    obj_refuses();
    obj_damage();
    known_files();
    model_free(&loaded);
    folder_close(&place);
}
