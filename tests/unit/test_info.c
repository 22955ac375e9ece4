/* test_info.c: `lambent info`: exact facts of small files; text, JSON and errors; counts of known scenes. */
#include "../folder.h"

#include <math.h>

#include "../../tools/cli/verb_info.h"
#include "../../tools/common/io_json.h"
#include "../../tools/model/model.h"
#include "../../tools/picture/image.h"
#include "../shared_file.h"

void test_info(void);

enum { TEXT_MAX = 1 << 14 };

static folder place;
static char said[TEXT_MAX], complained[TEXT_MAX]; /* of the last run of info */

/* --- files and runs --- */

static const char *put_file(const char *name, const void *data, size_t size)
{
    return folder_put(&place, name, data, size);
}

static const char *put_text(const char *name, const char *text) { return put_file(name, text, strlen(text)); }

static void take_back(char *text, FILE *f)
{
    size_t n;
    rewind(f);
    n = fread(text, 1, TEXT_MAX - 1, f);
    text[n] = '\0';
    fclose(f);
}

/* Returns the exit status of `info FIRST SECOND`; said and complained receive the output. */
static int info(const char *first, const char *second)
{
    char verb[] = "info", words[2][FOLDER_PATH], *argv[3];
    FILE *out = tmpfile(), *err = tmpfile();
    int status;
    CHECK(out && err);
    if (!out || !err)
        return -1;
    snprintf(words[0], FOLDER_PATH, "%s", first ? first : "");
    snprintf(words[1], FOLDER_PATH, "%s", second ? second : "");
    argv[0] = verb;
    argv[1] = words[0];
    argv[2] = words[1];
    status = info_to(out, err, 1 + (first != NULL) + (second != NULL), argv);
    take_back(said, out);
    take_back(complained, err);
    return status;
}

/* --- a glTF file with one of everything --- */

/* One triangle (0 0 0), (1 0 0), (0 2 0): 36 bytes; a light twice, a mesh twice, two cameras; an external image. */
static const char run_all[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3,4,5]}],"
    "\"extensionsUsed\":[\"KHR_texture_transform\",\"KHR_lights_punctual\",\"EXT_\\\"quoted\\\"\"],"
    "\"extensionsRequired\":[\"KHR_lights_punctual\"],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"spot\":{}},{\"type\":\"point\"}]}},"
    "\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"translation\":[0,0,-4]},"
    "{\"camera\":0,\"name\":\"a \\\"b\\\"\\n\\u00e9\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
    "{\"camera\":1,\"name\":\"flat\",\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
    "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},{},{}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}},"
    "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":2,\"ymag\":1,\"znear\":0,\"zfar\":9}}],"
    "\"animations\":[{},{}],\"skins\":[{}],\"images\":[{\"uri\":\"white.png\"},{}],"
    "\"textures\":[{\"source\":0}],"
    "\"materials\":[{\"doubleSided\":true,\"alphaMode\":\"MASK\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
    "\"baseColorTexture\":{\"index\":0}}},{},{}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0},"
    "{\"attributes\":{\"POSITION\":0},\"material\":1}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA\"}]}";

static const char *put_everything(size_t *png_size)
{
    static const uint8_t rgb[2 * 2 * 3] = {255, 0, 9, 255, 0, 9, 255, 0, 9, 255, 0, 13};
    file_bytes png = {NULL, 0};
    report r = {""};
    CHECK(png_encode(&png, rgb, 2, 2, &r));
    put_file("white.png", png.data, png.size);
    *png_size = png.size;
    file_free(&png);
    return put_text("all.gltf", run_all);
}

static void facts_of_gltf(const char *path, size_t png_size)
{
    static model_notes notes;
    const model_extension *e;
    model_facts f;
    report r = {""};
    model m;
    CHECK_MSG(model_load(&m, path, NULL, &notes, &r), "%s", r.text);
    f = m.facts;
    e = f.extensions;
    CHECK(f.format && strcmp(f.format, "glTF") == 0);
    CHECK(f.nodes == 7 && f.meshes == 1 && f.primitives == 2 && f.vertices == 6 && f.materials == 3);
    CHECK(f.images == 2 && f.textures == 1 && f.lights == 2 && f.cameras == 2 && f.animations == 2 && f.skins == 1);
    CHECK(f.file_bytes == sizeof run_all - 1 && f.neighbour_bytes == png_size);
    CHECK(f.texel_bytes == 20 && f.memory_bytes >= 20 + 36 && f.extension_count == 3 && f.extension_more == 0);
    CHECK(strcmp(e[0].name, "KHR_lights_punctual") == 0 && e[0].use == MODEL_EXTENSION_READ && e[0].required);
    CHECK(strcmp(e[1].name, "KHR_texture_transform") == 0 && e[1].use == MODEL_EXTENSION_FOLDED && !e[1].required);
    CHECK(strcmp(e[2].name, "EXT_\"quoted\"") == 0 && e[2].use == MODEL_EXTENSION_IGNORED && !e[2].required);
    model_free(&m);
    CHECK(m.facts.format == NULL && m.facts.nodes == 0);
}

/* Returns 1 if the output contains the parts in order, otherwise prints the first missing one and returns 0. */
static int says(const char *const *parts, int count)
{
    const char *at = said;
    int i;
    for (i = 0; i < count; ++i) {
        at = strstr(at, parts[i]);
        if (!at) {
            printf("missing: %s\nin: %s\n", parts[i], said);
            return 0;
        }
        at += strlen(parts[i]);
    }
    return 1;
}

#define SAYS(parts) CHECK(says(parts, (int)(sizeof(parts) / sizeof *(parts))))

static void text_of_gltf(const char *path)
{
    static const char *const parts[] = {
        "all.gltf: glTF\n", "nodes        7\n", "meshes       1\n", "primitives   2\n", "instances    4\n",
        "triangles    4 placed, 2 unique\n", "vertices     6\n",
        "materials    3; drawn: 2 (1 double sided, 1 masked, 1 textured, 0 normal mapped)\n", "images       2\n",
        "textures     1; read: 1 (20 bytes)\n", " 0: 2x2, levels: 2, 20 bytes\n",
        "lights       2; placed: 3 (1 point, 2 spot, 0 directional)\n",
        "cameras      2; placed: 2 (1 perspective, 1 orthographic)\n",
        " 0: a \"b\"?\xC3\xA9: perspective, 57.2958 degrees high, at 0 0 0\n",
        " 1: flat: orthographic, 4 x 2 m, at 0 0 0\n", "animations   2\n", "skins        1\n", "extensions   3\n",
        " KHR_lights_punctual: read, required\n", " KHR_texture_transform: folded in\n", " EXT_\"quoted\": ignored\n",
        "bounds       min ", " -4\n", " max ", " 2 ", " 0\n", " size ", " 4\n", "bytes        ", "notes        ",
        " animations, which only `lambent play` shows: 2\n"};
    CHECK(info(path, NULL) == INFO_OK && complained[0] == '\0');
    SAYS(parts);
}

/* --- JSON --- */

static json doc;
static report problem;

/* `info PATH --json` prints one line that a strict reader accepts. */
static int read_json(const char *path)
{
    const int status = info(path, "--json");
    const size_t n = strlen(said);
    memset(&problem, 0, sizeof problem);
    CHECK(status == INFO_OK && complained[0] == '\0');
    CHECK(n > 2 && said[0] == '{' && said[n - 2] == '}' && strchr(said, '\n') == said + n - 1);
    if (json_parse(&doc, said, n, "info", &problem))
        return 1;
    CHECK_MSG(0, "%s", problem.text);
    return 0;
}

/* The value at a path of keys; "" is the first element of an array. */
static uint32_t find(const char *a, const char *b, const char *c, const char *d)
{
    const char *const keys[] = {a, b, c, d};
    uint32_t at = 0, i;
    for (i = 0; i < 4 && keys[i]; ++i)
        at = keys[i][0] ? json_member(&doc, at, keys[i]) : json_first(&doc, at);
    return at;
}

static double number(const char *a, const char *b, const char *c, const char *d)
{
    double v = -12345;
    report r = {""};
    return json_read_double(&v, &doc, find(a, b, c, d), &r) ? v : -54321;
}

static int is_text(uint32_t node, const char *wanted)
{
    char text[FOLDER_PATH];
    json_string(text, sizeof text, &doc, node);
    return strcmp(text, wanted) == 0;
}

static void json_of_gltf(const char *path, size_t png_size)
{
    if (!read_json(path))
        return;
    CHECK(is_text(find("file", NULL, NULL, NULL), path) && is_text(find("kind", NULL, NULL, NULL), "scene"));
    CHECK(is_text(find("format", NULL, NULL, NULL), "glTF"));
    CHECK(number("nodes", NULL, NULL, NULL) == 7 && number("meshes", NULL, NULL, NULL) == 1);
    CHECK(number("primitives", NULL, NULL, NULL) == 2 && number("instances", NULL, NULL, NULL) == 4);
    CHECK(number("triangles", "placed", NULL, NULL) == 4 && number("triangles", "unique", NULL, NULL) == 2);
    CHECK(number("vertices", NULL, NULL, NULL) == 6 && number("materials", "count", NULL, NULL) == 3);
    CHECK(number("materials", "drawn", NULL, NULL) == 2 && number("materials", "masked", NULL, NULL) == 1);
    CHECK(number("lights", "count", NULL, NULL) == 2 && number("lights", "spot", NULL, NULL) == 2);
    CHECK(number("animations", NULL, NULL, NULL) == 2 && number("skins", NULL, NULL, NULL) == 1);
    CHECK(number("textures", "images", NULL, NULL) == 2 && number("textures", "read", "", "width") == 2);
    CHECK(number("textures", "bytes", NULL, NULL) == 20 && number("textures", "read", "", "bytes") == 20);
    CHECK(is_text(find("cameras", "placed", "", "name"), "a \"b\"\n\xC3\xA9"));
    CHECK(fabs(number("cameras", "placed", "", "yfov_deg") - 57.29577951) < 1e-6);
    CHECK(json_count(&doc, find("cameras", "placed", NULL, NULL)) == 2);
    CHECK(is_text(find("extensions", "", "name", NULL), "KHR_lights_punctual"));
    CHECK(json_kind(&doc, find("extensions", "", "required", NULL)) == JSON_TRUE);
    CHECK(json_count(&doc, find("extensions", NULL, NULL, NULL)) == 3);
    CHECK(number("bounds", "min", "", NULL) == 0 && number("bounds", "max", "", NULL) == 1);
    CHECK(number("bounds", "size", "", NULL) == 1 && number("bytes", "other_files", NULL, NULL) == (double)png_size);
    CHECK(number("bytes", "file", NULL, NULL) == (double)(sizeof run_all - 1));
    CHECK(json_count(&doc, find("notes", NULL, NULL, NULL)) > 0 && strstr(said, "\"animations, which only `lambent play` shows: 2\""));
    json_free(&doc);
}

/* Bytes of a file name that are not UTF-8 (a single lead byte, an overlong one) still give valid JSON. */
static void names_of_any_bytes(void)
{
    const char *path = put_text("n\xC3 \xC0\xAF\xE2\x82\xAC.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    char wanted[FOLDER_PATH + 32];
    if (!read_json(path))
        return;
    snprintf(wanted, sizeof wanted, "%s/n\xEF\xBF\xBD \xEF\xBF\xBD\xEF\xBF\xBD\xE2\x82\xAC.obj", place.path);
    CHECK(is_text(find("file", NULL, NULL, NULL), wanted));
    json_free(&doc);
}

/* Extensions that exceed the capacity are counted. */
static void many_extensions(void)
{
    static char text[4096];
    size_t n = (size_t)snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"X\"");
    int i;
    for (i = 0; i < 39; ++i)
        n += (size_t)snprintf(text + n, sizeof text - n, ",\"X%d\"", i);
    snprintf(text + n, sizeof text - n, "]}");
    if (!read_json(put_text("many.gltf", text)))
        return;
    CHECK(json_count(&doc, find("extensions", NULL, NULL, NULL)) == 32);
    CHECK(number("extensions_not_listed", NULL, NULL, NULL) == 8);
    json_free(&doc);
}

/* --- OBJ and pictures --- */

static void obj_file(void)
{
    static const char *const parts[] = {
        "box.obj: OBJ\n",
        "nodes        0\n",
        "meshes       2\n",
        "instances    2\n",
        "triangles    3 placed, 3 unique\n",
        "vertices     5\n",
        "materials    2; drawn: 2 (2 double sided, 0 masked, 0 textured, 0 normal mapped)\n",
        "textures     0; read: 0 (0 bytes)\n",
        "bounds       min ",
        "bytes        91 file, 18 other files, "};
    put_text("box.mtl", "newmtl a\nKd 1 0 0\n");
    CHECK(info(put_text("box.obj", "mtllib box.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n"
                                   "usemtl a\nf 1 2 3 4\nusemtl b\nf 1 2 5\n"),
               NULL) == INFO_OK);
    SAYS(parts);
}

static void ply_file(void)
{
    static const char *const parts[] = {"one.ply: PLY\n", "meshes       1\n", "triangles    1 placed, 1 unique\n",
                                        "vertices     3\n", "materials    0; drawn: 1 "};
    CHECK(info(put_text("one.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                   "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                   "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
               NULL) == INFO_OK);
    SAYS(parts);
}

/* A 2x1 PPM, a PFM with values that are not finite, grey PNG in different channels than colour ones. */
static void pictures(void)
{
    static const char pfm[] = "Pf\n2 2\n-1.0\n\0\0\x80\x7F\0\0\x80\xBF\0\0\0\x40\0\0\x20\x40"; /* inf -1 2 2.5 */
    static const char none[] = "Pf\n1 1\n-1.0\n\0\0\xC0\x7F";
    static const char *const ppm[] = {"tiny.ppm: PPM, 17 bytes\n", "size         2x1\n",
                                      "channels     3, codes 0 to 255\n", " red   min 0             max 10 ",
                                      " mean 5\n", " green min 2 ", " mean 16\n", " blue  min 3 ", " mean 129\n"};
    static const char *const grey[] = {"tiny.PFM: PFM, 28 bytes\n", "size         2x2\n", "channels     1, linear\n",
                                       " grey  min -1 ", " max 2.5 ", " mean 1.16667\n",
                                       "scale        1, little endian\n", "not finite   1\n"};
    static const char *const scaled[] = {" grey  min 3 ", "scale        1.5, big endian\n"};
    static const char *const pam[] = {"tiny.pam: PAM, 73 bytes\n", "channels     2, codes 0 to 255\n",
                                      " grey  min 10 ", " alpha min 7 "};
    CHECK(info(put_file("tiny.ppm", "P6\n2 1\n255\n\x0A\x02\xFF\x00\x1E\x03", 17), NULL) == INFO_OK);
    SAYS(ppm);
    CHECK(info(put_file("tiny.PFM", pfm, sizeof pfm - 1), NULL) == INFO_OK);
    SAYS(grey);
    CHECK(info(put_file("big.pfm", "Pf\n1 1\n1.5\n\x40\0\0\0", 15), NULL) == INFO_OK);
    SAYS(scaled);
    CHECK(info(put_file("tiny.pam",
                        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 2\nMAXVAL 255\nTUPLTYPE GRAYSCALE_ALPHA\nENDHDR\n\x0A\x07",
                        73), NULL) == INFO_OK);
    SAYS(pam);
    if (read_json(put_file("none.pfm", none, sizeof none - 1))) {
        CHECK(is_text(find("kind", NULL, NULL, NULL), "picture") && number("nonfinite", NULL, NULL, NULL) == 1);
        CHECK(json_kind(&doc, find("channels", "", "mean", NULL)) == JSON_NULL);
        json_free(&doc);
    }
}

/* A Radiance pixel of 1, 0.5, 0: mantissas 128, 64, 0 with exponent 1 (values are (m + 0 or 0.5) / 256 * 2^1). */
static void hdr_picture(void)
{
    static const char hdr[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\0\x81";
    if (!read_json(put_file("one.hdr", hdr, sizeof hdr - 1)))
        return;
    CHECK(is_text(find("format", NULL, NULL, NULL), "HDR") && is_text(find("values", NULL, NULL, NULL), "linear"));
    CHECK(fabs(number("channels", "", "mean", NULL) - 1) < 0.01 && number("width", NULL, NULL, NULL) == 1);
    json_free(&doc);
}

/* white.png of the glTF test: 2x2, no alpha. */
static void png_picture(void)
{
    char path[FOLDER_PATH];
    snprintf(path, sizeof path, "%.440s/white.png", place.path);
    if (!read_json(path))
        return;
    CHECK(json_count(&doc, find("channels", NULL, NULL, NULL)) == 3 && number("width", NULL, NULL, NULL) == 2);
    CHECK(is_text(find("format", NULL, NULL, NULL), "PNG") && is_text(find("values", NULL, NULL, NULL), "codes"));
    CHECK(number("channels", "", "min", NULL) == 255 && number("channels", "", "mean", NULL) == 255);
    CHECK(strstr(said, "{\"name\":\"blue\",\"min\":9,\"max\":13,\"mean\":10}") != NULL);
    json_free(&doc);
}

/* --- errors --- */

/* One line on stderr, nothing on stdout. */
static void check_status(int wanted, const char *first, const char *second, const char *part)
{
    const int status = info(first, second);
    CHECK_MSG(status == wanted, "%d: %s", status, complained);
    CHECK_MSG(strstr(complained, part) != NULL, "\"%s\" lacks \"%s\"", complained, part);
    CHECK(said[0] == '\0' && strchr(complained, '\n') == complained + strlen(complained) - 1);
}

static void errors(void)
{
    check_status(INFO_USAGE, NULL, NULL, "a scene, picture or baked file is needed");
    check_status(INFO_USAGE, "--json", NULL, "a scene, picture or baked file is needed");
    check_status(INFO_USAGE, "a.glb", "b.glb", "`b.glb` is one word too many: FILE is `a.glb`");
    check_status(INFO_USAGE, "a.glb", "--jsn", "unknown option --jsn; did you mean --json?");
    check_status(INFO_FAILED, "no such file.glb", NULL, "no such file.glb");
    check_status(INFO_FAILED, "no such file.png", "--json", "no such file.png");
    check_status(INFO_FAILED, put_text("broken.png", "no picture"), NULL, "broken.png");
    check_status(INFO_FAILED, put_text("draco.gltf", "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":"
                                                     "[\"KHR_draco_mesh_compression\"]}"),
                 "--json", "requires KHR_draco_mesh_compression");
    CHECK(info("--help", NULL) == INFO_OK && strncmp(said, "usage: lambent info FILE", 24) == 0 && !complained[0]);
}

/* --- known scenes --- */

/* Counts from data/MANIFEST.md; `unique` if a mesh is placed several times and the list counts it once. */
static const struct {
    const char *path;
    uint32_t triangles, vertices, meshes, nodes, materials, images, cameras, animations;
    int unique;
} known[] = {
    {"gltf/LeePerrySmith.glb", 17684, 9279, 1, 3, 1, 0, 0, 0, 0},
    {"gltf/Box.glb", 12, 24, 1, 2, 1, 0, 0, 0, 0},
    {"gltf/BoxTextured.glb", 12, 24, 1, 2, 1, 1, 0, 0, 0},
    {"gltf/Duck.glb", 4212, 2399, 1, 3, 1, 1, 1, 0, 0},
    {"gltf/Avocado.glb", 682, 406, 1, 1, 1, 3, 0, 0, 0},
    {"gltf/Suzanne.glb", 3936, 11808, 1, 1, 1, 2, 0, 0, 0},
    {"gltf/LightsPunctualLamp.glb", 6000, 4555, 3, 8, 3, 7, 0, 0, 0},
    {"gltf/GlassVaseFlowers.glb", 10218, 5989, 3, 4, 3, 4, 0, 0, 1},
    {"gltf/VertexColorTest.glb", 36, 72, 2, 2, 2, 2, 0, 0, 0},
    {"gltf/kenney-character.glb", 550, 1038, 6, 8, 1, 1, 0, 4, 0},
    {"gltf/kenney-platform-large.glb", 254, 432, 1, 1, 1, 1, 0, 0, 0},
    {"gltf/plastic_monobloc_chair.glb", 3356, 3271, 1, 1, 1, 3, 0, 0, 0},
    {"scenes/living_room.glb", 5088, 4568, 2, 2, 7, 0, 0, 0, 0},
    {"scenes/CornellBox-Original.obj", 36, 72, 0, 0, 8, 0, 0, 0, 0},
    {"scenes/CornellBox-Sphere.obj", 2188, 1116, 0, 0, 8, 0, 0, 0, 0},
    {"scenes/zdm2.obj", 70754, 39488, 0, 0, 84, 0, 0, 0, 0},
};

static void check_known(const char *path, size_t i)
{
    static model_notes notes;
    model m;
    report r = {""};
    uint64_t unique = 0;
    uint32_t k;
    CHECK_MSG(model_load(&m, path, NULL, &notes, &r), "%s", r.text);
    for (k = 0; k < m.scene.mesh_count; ++k)
        unique += m.scene.meshes[k].triangle_count;
    CHECK_MSG(unique == known[i].triangles, "%s: %u triangles", path, (unsigned)unique);
    CHECK_MSG((lmb_scene_triangles(&m.scene) > known[i].triangles) == known[i].unique, "%s: %u placed", path,
              (unsigned)lmb_scene_triangles(&m.scene));
    CHECK_MSG(m.facts.vertices == known[i].vertices, "%s: %u vertices", path, (unsigned)m.facts.vertices);
    CHECK_MSG(m.facts.nodes == known[i].nodes, "%s: %u nodes", path, (unsigned)m.facts.nodes);
    CHECK_MSG(known[i].meshes == 0 || m.facts.meshes == known[i].meshes, "%s: %u meshes", path,
              (unsigned)m.facts.meshes);
    CHECK_MSG(m.facts.materials == known[i].materials, "%s: %u materials", path, (unsigned)m.facts.materials);
    CHECK_MSG(m.facts.images == known[i].images, "%s: %u images", path, (unsigned)m.facts.images);
    CHECK_MSG(m.facts.cameras == known[i].cameras && m.camera_count == known[i].cameras, "%s: %u cameras", path,
              (unsigned)m.facts.cameras);
    CHECK_MSG(m.facts.animations == known[i].animations, "%s: %u animations", path, (unsigned)m.facts.animations);
    model_free(&m);
}

static void known_scenes(void)
{
    char path[SHARED_PATH], name[64];
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i) {
        snprintf(name, sizeof name, "data/%s", known[i].path);
        if (shared_file(path, name))
            check_known(path, i);
    }
}

void test_info(void)
{
    const char *path;
    size_t png_size;
    folder_open(&place);
    path = put_everything(&png_size);
    facts_of_gltf(path, png_size);
    text_of_gltf(path);
    json_of_gltf(path, png_size);
    names_of_any_bytes();
    many_extensions();
    obj_file();
    ply_file();
    hdr_picture();
    pictures();
    png_picture();
    errors();
    known_scenes();
    folder_close(&place);
}
