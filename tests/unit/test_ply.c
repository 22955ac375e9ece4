/* test_ply.c: the PLY reader: every encoding and type with exact values, hostile counts, damage, known files. */
#include "../folder.h"

#include <math.h>

#include "../../tools/picture/image.h"
#include "../model_case.h"
#include "../shared_file.h"

void test_ply(void);

enum { PATH_SIZE = 512, FILE_MAX = 4096 };


static int with_cr; /* 1: load puts CR for LF in the header, and in the whole text file */

static int load_cr(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size);
    int in_header = 1, ok = 0;
    const int is_text = size > 16 && memcmp(data, "ply\nformat ascii", 16) == 0;
    for (size_t i = 0; copy != NULL && i < size; ++i) {
        copy[i] = data[i] == '\n' && in_header ? '\r' : data[i];
        in_header = is_text || (in_header && (i < 10 || memcmp(data + i - 10, "end_header\n", 11) != 0));
    }
    if (copy != NULL)
        ok = model_read(&loaded, "a", NULL, copy, size, &notes, &problem);
    free(copy);
    return ok;
}

static int load(const void *data, size_t size)
{
    forget();
    return with_cr ? load_cr((const uint8_t *)data, size)
                   : model_read(&loaded, "a", NULL, (const uint8_t *)data, size, &notes, &problem);
}

static int load_text(const char *text) { return load(text, strlen(text)); }

/* --- a file written in any encoding --- */

enum { TEXT, LITTLE, BIG, ENCODINGS };
static const char *const encodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};

static const struct {
    const char *name, *alias;
    uint32_t size;
    int is_float;
} types[] = {
    {"char", "int8", 1, 0}, {"uchar", "uint8", 1, 0}, {"short", "int16", 2, 0},   {"ushort", "uint16", 2, 0},
    {"int", "int32", 4, 0}, {"uint", "uint32", 4, 0}, {"float", "float32", 4, 1}, {"double", "float64", 8, 1},
};
enum { TYPES = sizeof types / sizeof types[0], UCHAR = 1, INT = 4, FLOAT = 6, DOUBLE = 7 };

typedef struct writer {
    uint8_t bytes[FILE_MAX];
    size_t size;
    int encoding;
} writer;

static void put_string(writer *w, const char *s)
{
    memcpy(w->bytes + w->size, s, strlen(s));
    w->size += strlen(s);
}

static void put(writer *w, int type, double v)
{
    const uint32_t n = types[type].size;
    uint64_t bits = types[type].is_float ? 0 : (uint64_t)(int64_t)v;
    char text[40];
    uint32_t i;
    if (w->encoding == TEXT) {
        snprintf(text, sizeof text, "%.17g ", v);
        put_string(w, text);
        return;
    }
    if (type == FLOAT) {
        const float f = (float)v;
        uint32_t low;
        memcpy(&low, &f, 4);
        bits = low;
    } else if (type == DOUBLE) {
        memcpy(&bits, &v, 8);
    }
    for (i = 0; i < n; ++i)
        w->bytes[w->size + (w->encoding == BIG ? n - 1 - i : i)] = (uint8_t)(bits >> 8 * i);
    w->size += n;
}

static void end_item(writer *w)
{
    if (w->encoding == TEXT)
        put_string(w, "\n");
}

static void begin(writer *w, int encoding)
{
    memset(w, 0, sizeof *w);
    w->encoding = encoding;
    put_string(w, "ply\nformat ");
    put_string(w, encodings[encoding]);
    put_string(w, " 1.0\ncomment element face 99\nobj_info a b c d e f g h\n");
}

static void put_property(writer *w, const char *type, const char *name)
{
    put_string(w, "property ");
    put_string(w, type);
    put_string(w, " ");
    put_string(w, name);
    put_string(w, "\n");
}

static void put_face(writer *w, int count_type, int type, int n, const int *corners)
{
    int i;
    put(w, count_type, n);
    for (i = 0; i < n; ++i)
        put(w, type, corners[i]);
}

/* --- loaded values --- */

static const lmb_mesh *mesh(void) { return &loaded.scene.meshes[0]; }

static int is_position(uint32_t v, double x, double y, double z)
{
    const float *p = (const float *)mesh()->positions + 3 * (size_t)v;
    return (double)p[0] == x && (double)p[1] == y && (double)p[2] == z;
}

static int are_indices(const uint16_t *expected, uint32_t triangles)
{
    return mesh()->triangle_count == triangles && mesh()->index_format == LMB_INDEX_U16 &&
           memcmp(mesh()->indices, expected, 3 * triangles * sizeof *expected) == 0;
}

static int is_colour(uint32_t v, int r, int g, int b, int a)
{
    const int code[4] = {r, g, b, a};
    lmb_vertex at;
    int ok = mesh()->colours && lmb_mesh_vertex(&at, mesh(), v);
    for (int k = 0; ok && k < 4; ++k)
        ok = (int)(at.colour[k] * 255.0f + 0.5f) == code[k];
    return ok;
}

/* Channel c at a corner, as the nearest byte. */
static int colour_of(uint32_t mesh_number, uint32_t corner, int c)
{
    const lmb_mesh *m = &loaded.scene.meshes[mesh_number];
    lmb_vertex v;
    return lmb_mesh_vertex(&v, m, ((const uint16_t *)m->indices)[corner]) ? (int)(v.colour[c] * 255.0f + 0.5f) : -1;
}

static int is_normal(uint32_t v, double x, double y, double z)
{
    lmb_vec3 n;
    if (!mesh()->normals)
        return 0;
    n = lmb_octahedral_decode(mesh()->normals + 2 * (size_t)v);
    return fabs((double)n.x - x) + fabs((double)n.y - y) + fabs((double)n.z - z) < 2e-4;
}

/* --- every encoding and type --- */

/* A quad with the given types of positions, corner counts and corner numbers. */
static void check_types(int encoding, int position, int count, int index, int alias)
{
    static const int corners[4] = {0, 1, 2, 3};
    static const uint16_t expected[6] = {0, 1, 2, 0, 2, 3};
    const char *list = alias ? "vertex_index" : "vertex_indices";
    char line[80];
    writer w;
    int i;
    begin(&w, encoding);
    put_string(&w, "element vertex 4\n");
    for (i = 0; i < 3; ++i)
        put_property(&w, alias ? types[position].alias : types[position].name, i == 0 ? "x" : i == 1 ? "y" : "z");
    snprintf(line, sizeof line, "element face 1\nproperty list %s %s %s\nend_header\n",
             alias ? types[count].alias : types[count].name, types[index].name, list);
    put_string(&w, line);
    for (i = 0; i < 4; ++i, end_item(&w)) {
        put(&w, position, i == 1 || i == 2 ? 100 : 1);
        put(&w, position, i >= 2 ? (position % 2 && position < FLOAT ? 3 : -3) : 2);
        put(&w, position, types[position].is_float ? 0.25 : 7);
    }
    put_face(&w, count, index, 4, corners);
    CHECK_LOADS(load(w.bytes, w.size));
    if (!loaded.blocks)
        return;
    CHECK_MSG(are_indices(expected, 2), "%s %d %d %d", encodings[encoding], position, count, index);
    CHECK(mesh()->vertex_count == 4 && is_position(0, 1, 2, types[position].is_float ? 0.25 : 7));
    CHECK(is_position(2, 100, position % 2 && position < FLOAT ? 3 : -3, types[position].is_float ? 0.25 : 7));
}

static void all_types(void)
{
    int encoding, a, b;
    for (encoding = 0; encoding < ENCODINGS; ++encoding)
        for (a = 0; a < TYPES; ++a)
            for (b = 0; b < TYPES; ++b)
                check_types(encoding, a, b, (a + b) % TYPES, a & 1);
}

/* Numbers at the limits of their types. */
static void extremes(void)
{
    static const double min[] = {-128, 0, -32768, 0, -2147483648.0, 0};
    static const double max[] = {127, 255, 32767, 65535, 2147483520.0, 4294967040.0}; /* also exact in float */
    static const int corners[3] = {0, 1, 2};
    int encoding, type, i;
    writer w;
    for (encoding = 0; encoding < ENCODINGS; ++encoding)
        for (type = 0; type < FLOAT; ++type) {
            begin(&w, encoding);
            put_string(&w, "element vertex 3\n");
            for (i = 0; i < 3; ++i)
                put_property(&w, types[type].name, i == 0 ? "x" : i == 1 ? "y" : "z");
            put_string(&w, "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n");
            for (i = 0; i < 9; ++i, i % 3 ? (void)0 : end_item(&w))
                put(&w, type, i % 2 ? min[type] : max[type]);
            put_face(&w, UCHAR, UCHAR, 3, corners);
            CHECK_LOADS(load(w.bytes, w.size));
            CHECK(loaded.blocks && is_position(0, max[type], min[type], max[type]));
            CHECK(loaded.blocks && is_position(1, min[type], max[type], min[type]));
        }
}

/* Everything at once: faces before vertices, properties in unusual order, ignored elements and lists in between. */
static size_t put_all(writer *w, int encoding)
{
    static const int dart[4] = {0, 1, 2, 4}, two[2] = {0, 1}, three[3] = {0, 2, 1};
    static const double places[6][3] = {{2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}, {1e6, 1e6, 1e6}, {0, 0, 0}, {9, 9, 9}};
    int i;
    size_t header;
    begin(w, encoding);
    put_string(w, "element face 3\nproperty uchar flags\nproperty list ushort int vertex_index\n"
                  "property list uchar float texcoord\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n"
                  "element nothing 4000000000\nelement vertex 6\nproperty float confidence\nproperty float z\n"
                  "property double y\nproperty float x\nproperty float nx\nproperty float ny\nproperty float nz\n"
                  "property uchar red\nproperty float green\nproperty ushort blue\nproperty uchar alpha\n"
                  "property list uchar int links\nproperty float texture_u\nproperty float texture_v\n"
                  "property float u\nend_header\n");
    header = w->size;
    for (i = 0; i < 3; ++i, end_item(w)) {
        put(w, UCHAR, 9);
        put_face(w, 3, INT, i == 0 ? 4 : i == 1 ? 2 : 3, i == 0 ? dart : i == 1 ? two : three);
        put_face(w, UCHAR, FLOAT, i == 1 ? 0 : 3, three);
    }
    for (i = 0; i < 2; ++i, end_item(w))
        put_face(w, INT, INT, 1, two);
    for (i = 0; i < 6; ++i, end_item(w)) {
        put(w, FLOAT, 0.125);
        put(w, FLOAT, places[i][2]);
        put(w, DOUBLE, places[i][1]);
        put(w, FLOAT, places[i][0]);
        put(w, FLOAT, 0);
        put(w, FLOAT, i == 1 ? 0 : 3);
        put(w, FLOAT, i == 1 ? 0 : 4);
        put(w, UCHAR, 10 * i);
        put(w, FLOAT, 0.5 * i);
        put(w, 3, 257 * i);
        put(w, UCHAR, 200 + i);
        put_face(w, UCHAR, INT, i % 3, three);
        put(w, FLOAT, 0.25 * i);
        put(w, FLOAT, 0.25);
        put(w, FLOAT, 7);
    }
    return header;
}

static void run_all(int encoding)
{
    static const uint16_t plain[3] = {0, 2, 1};
    writer w;
    const float *uvs;
    const uint16_t *at;
    put_all(&w, encoding);
    CHECK_LOADS(load(w.bytes, w.size));
    if (!loaded.blocks)
        return;
    at = (const uint16_t *)mesh()->indices;
    uvs = (const float *)mesh()->uvs;
    CHECK(mesh()->vertex_count == 4 && mesh()->triangle_count == 3 && memcmp(at + 6, plain, sizeof plain) == 0);
    CHECK(!(at[0] == 0 && at[1] == 1 && at[2] == 2)); /* the dart is cut at the reflex corner */
    CHECK(is_position(0, 2, 0, 0) && is_position(2, 0, 2, 0) && is_position(3, 0, 0, 0)); /* 3 and 5 are unused */
    CHECK((double)loaded.scene.bounds_max.x == 2);
    CHECK(is_normal(0, 0, 0.6, 0.8) && is_normal(1, 0, 0, 1) && noted("without length, made from the faces there: 1"));
    CHECK(is_colour(0, 0, 0, 0, 200) && is_colour(1, 1, 55, 0, 201) && is_colour(3, 5, 255, 0, 204));
    CHECK(uvs && (double)uvs[6] == 1 && (double)uvs[7] == 0.75 && (double)uvs[2] == 0.25);
    CHECK(noted("other than vertex and face skipped: 2") && noted("fewer than 3 corners skipped: 1"));
    CHECK(noted("no face uses left out: 2"));
    CHECK(loaded.scene.material_count == 1 && loaded.scene.materials[0].flags == LMB_DOUBLE_SIDED);
    CHECK(loaded.scene.materials[0].albedo[0] == 1.0f && loaded.scene.materials[0].texture == -1);
    CHECK(loaded.scene.instance_count == 1 && loaded.scene.instances[0].to_world.m[15] == 1);
}

/* --- text --- */

#define HEAD  "ply\nformat ascii 1.0\n"
#define XYZ   "property float x\nproperty float y\nproperty float z\n"
#define FACES "property list uchar int vertex_indices\n"
#define TRI   HEAD "element vertex 3\n" XYZ "element face 1\n" FACES "end_header\n"
#define THREE "0 0 0\n1 0 0\n0 1 0\n"

static void text_forms(void)
{
    static const uint16_t expected[3] = {0, 1, 2};
    CHECK_LOADS(load_text(TRI THREE "3 0 1 2"));
    CHECK(loaded.blocks && are_indices(expected, 1) && !mesh()->normals && !mesh()->colours && !mesh()->uvs);
    CHECK_LOADS(load_text(TRI "\n \t\n0 0 0 \r\n+1.0 0e5 -0\r\n\n0 1 0\n\n3\t0 1 2.0\n\n \n"));
    CHECK(loaded.blocks && are_indices(expected, 1) && is_position(1, 1, 0, 0));
    CHECK_LOADS(load_text("ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\n"
                          "property float z\r\nelement face 1\r\nproperty list int int vertex_index\r\nend_header\r\n"
                          "0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n"));
    CHECK(loaded.blocks && are_indices(expected, 1));
    CHECK_LOADS(load_text(TRI "nan 0 0\n1e300 -1e300 inf\n0 1 0\n3 0 1 2\n")); /* the library drops the triangle */
    CHECK(loaded.blocks && isnan(((const float *)mesh()->positions)[0]));
    CHECK(loaded.blocks && isinf(((const float *)mesh()->positions)[3]));
    CHECK_LOADS(load_text(HEAD "element vertex 3\n" XYZ "property float red\nelement face 1\n" FACES
                               "end_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n"));
    CHECK(loaded.blocks && !mesh()->colours); /* a single channel is no colour */
}

/* Loads three vertices with one grey in `type`, written as `code`. */
static int load_grey(const char *type, const char *code, const model_choice *choice)
{
    char text[700];
    const int n = snprintf(text, sizeof text,
                           HEAD "element vertex 3\n" XYZ "property %s red\nproperty %s green\nproperty %s blue\n"
                                "element face 1\n" FACES "end_header\n0 0 0 %s %s %s\n1 0 0 %s %s %s\n0 1 0 %s %s %s\n"
                                "3 0 1 2\n", type, type, type, code, code, code, code, code, code, code, code, code);
    forget();
    return model_read_as(&loaded, "a", choice, (const uint8_t *)text, (size_t)n, &notes, &problem);
}

/* Dark colours keep their ratios: light of sRGB codes, and floats between them. */
static void dark_colours(void)
{
    static const struct {
        const char *type, *code;
        double light;
    } all[] = {{"uchar", "1", 0.000303527}, {"uchar", "2", 0.000607054}, {"uchar", "7", 0.00212469},
               {"uchar", "20", 0.00699541}, {"float", "0.00095", 0.0000735294}, {"double", "0.0123", 0.000952012}};
    const model_choice linear = {NULL, MODEL_COLOURS_LINEAR, 0};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        lmb_vertex v = {.colour = {0, 0, 0, 0}};
        CHECK_LOADS(load_grey(all[i].type, all[i].code, NULL));
        lmb_mesh_vertex(&v, mesh(), 0);
        CHECK_MSG(fabs((double)v.colour[1] / all[i].light - 1) < 3e-3, "%s %s: %g", all[i].type, all[i].code,
                  (double)v.colour[1]);
    }
    CHECK_LOADS(load_grey("float", "0.00095", &linear));
    lmb_vertex v = {.colour = {0, 0, 0, 0}};
    lmb_mesh_vertex(&v, mesh(), 2);
    CHECK(fabs((double)v.colour[2] - 0.00095) < 1e-6);
}

/* Codes are sRGB by default: 188 is half the light of 255, which is white and not a grey of 0.8. Floats are decoded
 * without rounding: 0.98235 lies between the codes 250 and 251, and so does the light. */
static void scan_colours(void)
{
    static const struct {
        const char *type, *code;
        int srgb, linear;
    } all[] = {
        {"uchar", "188", 128, 188},       {"uchar", "255", 255, 255},  {"uchar", "0", 0, 0},
        {"uchar", "1", 0, 1},             {"ushort", "48316", 128, 188}, {"float", "0.737255", 128, 188},
        {"float", "0.980392", 244, 250},  {"float", "0.98235", 245, 250}, {"float", "0.984314", 246, 251},
        {"double", "1", 255, 255},
        {"float", "nan", 0, 0},           {"float", "-1", 0, 0},       {"float", "inf", 255, 255},
    };
    const model_choice linear = {NULL, MODEL_COLOURS_LINEAR, 0};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; ++i) {
        CHECK_LOADS(load_grey(all[i].type, all[i].code, NULL));
        CHECK_MSG(loaded.blocks && is_colour(0, all[i].srgb, all[i].srgb, all[i].srgb, 255), "%s %s: %d", all[i].type,
                  all[i].code, loaded.blocks ? colour_of(0, 0, 0) : -1);
        CHECK(loaded.scene.materials[0].albedo[0] == 1.0f);
        if (all[i].linear == 188 || all[i].linear == 255) { /* bytes where bytes are exact */
            CHECK(mesh()->colour_format == (all[i].linear == 188 ? LMB_COLOUR_RGBA16 : LMB_COLOUR_RGBA8));
        }
        CHECK_LOADS(load_grey(all[i].type, all[i].code, &linear));
        CHECK_MSG(loaded.blocks && is_colour(2, all[i].linear, all[i].linear, all[i].linear, 255), "%s %s: %d", all[i].type,
                  all[i].code, loaded.blocks ? colour_of(0, 0, 0) : -1);
    }
}

/* --- strips --- */

enum { RESTART = -1 };

/* Loads five vertices and the strips of this list. Indices and strip ends have this type. */
static int load_strips(int encoding, int type, const char *before, const int *list, int n)
{
    static const double places[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    char line[200];
    writer w;
    int i, k;
    begin(&w, encoding);
    put_string(&w, "element vertex 5\n" "property float x\nproperty float y\nproperty float z\n");
    snprintf(line, sizeof line, "%selement tristrips 1\nproperty list int %s vertex_indices\nend_header\n", before,
             types[type].name);
    put_string(&w, line);
    for (i = 0; i < 5; ++i, end_item(&w))
        for (k = 0; k < 3; ++k)
            put(&w, FLOAT, places[i][k]);
    put(&w, INT, n);
    for (i = 0; i < n; ++i)
        put(&w, type, list[i] == RESTART && w.encoding == TEXT && type == UCHAR ? 255 : list[i]);
    end_item(&w);
    return load(w.bytes, w.size);
}

/* Every second triangle has the opposite winding, and repeated vertices count too. -1 begins a new strip. */
static void strips(void)
{
    static const int list[] = {0, 1, 2, 3, 4, RESTART, 3, 2, 4}, joined[] = {0, 1, 2, 2, 3, 3, 4, 2}, odd[] = {0, 1, 5};
    static const int shorts[] = {RESTART, 0, RESTART, RESTART, 0, 1, 2, RESTART, 3, 4}, none[] = {0, 1, RESTART, 2, 3};
    static const uint16_t expected[] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 3, 2, 4}, first[] = {0, 1, 2},
                          turned[] = {0, 1, 2, 4, 3, 2};
    static const int kinds[] = {0, UCHAR, 2, INT, FLOAT};
    for (int encoding = 0; encoding < ENCODINGS; ++encoding) {
        for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; ++k) {
            CHECK_LOADS(load_strips(encoding, kinds[k], "", list, 9));
            CHECK_MSG(loaded.blocks && are_indices(expected, 4) && notes.count == 0, "%s %s", encodings[encoding],
                      types[kinds[k]].name);
        }
        CHECK_LOADS(load_strips(encoding, INT, "", joined, 8));
        CHECK(loaded.blocks && are_indices(turned, 2));
        CHECK_LOADS(load_strips(encoding, INT, "", shorts, 10));
        CHECK(loaded.blocks && are_indices(first, 1) && noted("strips with fewer than 3 corners skipped: 2"));
        check_fails(load_strips(encoding, INT, "", odd, 3), "vertex number 5, but there are 5 from 0");
        check_fails(load_strips(encoding, INT, "", none, 5), "no strip makes a triangle");
        check_fails(load_strips(encoding, INT, "", none, 2), "no face has 3 corners");
    }
    CHECK_LOADS(load_strips(TEXT, INT, "element face 0\nproperty list uchar int vertex_indices\n", list, 9));
    CHECK(loaded.blocks && are_indices(expected, 4));
    check_fails(load_text(HEAD "element vertex 3\n" XYZ "element tristrips 1\nproperty int a\nend_header\n"), "strips have no list");
    check_fails(load_text(HEAD "element tristrips 1\nelement tristrips 1\n"), "line 4: a second element tristrips");
    CHECK_LOADS(load_text(HEAD "element vertex 4\n" XYZ "element tristrips 2\n" FACES "element face 1\n" FACES "end_header\n"
                               "0 0 0\n1 0 0\n0 1 0\n1 1 1\n3 0 1 2\n3 1 2 3\n3 0 2 3\n"));
    CHECK(loaded.blocks && mesh()->triangle_count == 3);
}

/* --- colours by face and by other names --- */

#define TWO   "0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
#define HEAD4 HEAD "element vertex 4\n" XYZ
#define RGB(prefix) "property uchar " prefix "red\nproperty uchar " prefix "green\nproperty uchar " prefix "blue\n"

static void face_colours(void)
{
    static const char *const names[] = {"", "diffuse_"};
    char text[700];
    for (int k = 0; k < 2; ++k) {
        snprintf(text, sizeof text, HEAD4 "element face 2\n" FACES "property uchar %sred\nproperty uchar %sgreen\n"
                 "property uchar %sblue\nend_header\n" TWO "3 0 1 2 255 188 0\n3 1 3 2 0 0 255\n", names[k], names[k], names[k]);
        CHECK_LOADS(load_text(text));
        CHECK(mesh()->vertex_count == 6 && mesh()->triangle_count == 2 && mesh()->colours && notes.count == 0);
        for (uint32_t i = 0; mesh()->colours && i < 3; ++i) {
            CHECK(colour_of(0, i, 0) == 255 && colour_of(0, i, 1) == 128 && colour_of(0, i, 2) == 0);
            CHECK(colour_of(0, i + 3, 0) == 0 && colour_of(0, i + 3, 2) == 255);
        }
        CHECK(loaded.scene.materials[0].albedo[0] == 1.0f && is_position(0, 0, 0, 0) && is_position(4, 1, 1, 0));
    }
    CHECK_LOADS(load_text(HEAD "element vertex 5\n" XYZ RGB("") "element face 3\n" FACES RGB("") "end_header\n0 0 0 9 9 9\n"
                          "1 0 0 9 9 9\n0 1 0 9 9 9\n1 1 0 9 9 9\n5 5 5 9 9 9\n3 0 1 2 255 0 0\n4 0 1 3 2 255 0 0\n3 0 1 2 0 255 0\n"));
    CHECK(mesh()->vertex_count == 7 && noted("colours of vertices left out, as faces have") && noted("left out: 1"));
    CHECK((double)loaded.scene.bounds_max.x == 1);
    CHECK_LOADS(load_text(HEAD "element vertex 3\n" XYZ RGB("diffuse_") "element face 1\n" FACES
                          "end_header\n0 0 0 255 188 0\n1 0 0 0 0 255\n0 1 0 0 0 0\n3 0 1 2\n"));
    CHECK(loaded.blocks && is_colour(0, 255, 128, 0, 255) && is_colour(1, 0, 0, 255, 255));
    CHECK_LOADS(load_text(HEAD "element vertex 3\n" XYZ "property uchar red\nelement face 1\n" FACES
                          "end_header\n0 0 0 255\n1 0 0 0\n0 1 0 0\n3 0 1 2\n"));
    CHECK(loaded.blocks && !mesh()->colours && noted("colours that are not red, green and blue left out"));
    CHECK_LOADS(load_text(HEAD "element vertex 3\n" XYZ RGB("") "property uchar alpha\nelement face 1\n" FACES
                          "end_header\n0 0 0 1 1 1 255\n1 0 0 1 1 1 9\n0 1 0 1 1 1 254\n3 0 1 2\n"));
    CHECK(loaded.blocks && noted("colours with an alpha under 1, drawn opaque: 2"));
}

/* 8-bit codes in a wider type. */
static void wide_codes(void)
{
    CHECK_LOADS(load_grey("int", "188", NULL));
    CHECK(loaded.blocks && is_colour(0, 128, 128, 128, 255) && noted("type int hold no more than codes, read as 0 to 255"));
    CHECK_LOADS(load_grey("ushort", "188", NULL));
    CHECK(loaded.blocks && is_colour(0, 128, 128, 128, 255) && noted("type ushort"));
    CHECK_LOADS(load_grey("uint", "48316", NULL));
    CHECK(loaded.blocks && is_colour(0, 128, 128, 128, 255) && noted("read as 0 to 65535"));
    CHECK_LOADS(load_grey("float", "188", NULL));
    CHECK(loaded.blocks && is_colour(0, 128, 128, 128, 255) && noted("type float"));
    CHECK_LOADS(load_grey("float", "187.9", NULL));
    CHECK(loaded.blocks && is_colour(0, 128, 128, 128, 255));
    CHECK_LOADS(load_grey("float", "1.5", NULL));
    CHECK(loaded.blocks && is_colour(0, 255, 255, 255, 255) && notes.count == 0);
}

/* --- textures --- */

static int load_in(folder *place, const char *text)
{
    forget();
    return model_load(&loaded, folder_put(place, "a.ply", text, strlen(text)), NULL, &notes, &problem);
}

static int has_uv(uint32_t mesh_number, uint32_t corner, double u, double v)
{
    const lmb_mesh *m = &loaded.scene.meshes[mesh_number];
    const float *uv = m->uvs ? (const float *)m->uvs + 2 * (size_t)((const uint16_t *)m->indices)[corner] : NULL;
    return uv && fabs((double)uv[0] - u) < 1e-6 && fabs((double)uv[1] - v) < 1e-6;
}

#define PICTURE   "comment TextureFile "
#define FACE_UVS  "property list uchar float texcoord\n"
#define START(c)  "ply\nformat ascii 1.0\n" c "element vertex 4\n" XYZ

/* Coordinates per vertex. The first of two pictures is used because faces do not choose one. */
static void vertex_textures(folder *place)
{
    static const char *const names[] = {"s", "t", "u", "v", "texture_u", "texture_v", "texture_s", "texture_t"};
    char text[700];
    for (int k = 0; k < 8; k += 2) {
        snprintf(text, sizeof text, START(PICTURE "a b.png\r\n") RGB("") "property float %s\nproperty float %s\n"
                 "element face 1\n" FACES "end_header\n0 0 0 9 9 9 0 0\n1 0 0 9 9 9 1 0\n0 1 0 9 9 9 0.25 0.75\n1 1 0 9 9 9 1 1\n"
                 "3 0 1 2\n", names[k], names[k + 1]);
        CHECK_LOADS(load_in(place, text));
        CHECK(loaded.scene.texture_count == 1 && loaded.scene.materials[0].texture == 0 && !mesh()->colours);
        CHECK(loaded.scene.materials[0].albedo[2] == 1.0f && has_uv(0, 2, 0.25, 0.25) && has_uv(0, 0, 0, 1));
        CHECK(noted("colours beside a texture left out") && noted("no face uses left out: 1"));
    }
    CHECK_LOADS(load_in(place, START(PICTURE "none.png\n") RGB("") "property float s\nproperty float t\nelement face 1\n" FACES
                        "end_header\n0 0 0 255 188 0 0 0\n1 0 0 9 9 9 1 0\n0 1 0 9 9 9 0 1\n1 1 0 9 9 9 1 1\n3 0 1 2\n"));
    CHECK(is_colour(0, 255, 128, 0, 255) && noted("textures left out, plain colour instead: 1 (first: ") && noted("none.png"));
    CHECK_LOADS(load_in(place, START(PICTURE "a b.png\n") "element face 1\n" FACES "end_header\n" TWO "3 0 1 2\n"));
    CHECK(loaded.scene.texture_count == 0 && noted("textures without texture coordinates left out: 1"));
    CHECK_LOADS(load_in(place, START(PICTURE "../x.png\n" PICTURE "/x.png\n") "property float s\nproperty float t\nelement face 1\n"
                        FACES "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n3 0 1 2\n"));
    CHECK(loaded.scene.texture_count == 0 && noted("plain colour instead: 2"));
}

/* Coordinates per face: corners at one vertex have different positions in the picture. Faces without a picture are
 * grey. */
static void face_textures(folder *place)
{
    CHECK_LOADS(load_in(place, START(PICTURE "a b.png\n" PICTURE "none.png\ncomment texturefile c.png\n") "element face 6\n" FACES FACE_UVS
                        "property int texnumber\nend_header\n" TWO "3 0 1 2 6 0 0 1 0 0 1 0\n3 1 3 2 6 .5 0 .5 1 0 1 2\n"
                        "3 0 1 2 6 0 0 1 0 0 1 -1\n3 0 1 2 0 0\n3 0 1 2 4 0 0 1 0 0\n3 0 1 2 6 0 0 1 0 0 1 1\n"));
    if (loaded.scene.mesh_count != 3 || loaded.scene.material_count != 3 || loaded.scene.texture_count != 2) {
        CHECK(!"a mesh a material");
        return;
    }
    CHECK(loaded.scene.materials[0].texture == 0 && loaded.scene.materials[1].texture == 1 &&
          loaded.scene.materials[2].texture == -1 && loaded.scene.materials[2].albedo[0] == 0.8f);
    CHECK(loaded.scene.meshes[0].triangle_count == 1 && has_uv(0, 0, 0, 1) && has_uv(0, 1, 1, 1) && has_uv(0, 2, 0, 0));
    CHECK(loaded.scene.meshes[1].triangle_count == 1 && has_uv(1, 0, 0.5, 1) && has_uv(1, 1, 0.5, 0) && has_uv(1, 2, 0, 0));
    CHECK(loaded.scene.meshes[2].triangle_count == 4 && loaded.scene.instances[2].material == 2);
    CHECK(noted("texture coordinates are not two a corner, drawn plain: 1") && noted("plain colour instead: 1"));
}

static void textures(void)
{
    static const uint8_t rgb[12] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
    folder place;
    file_bytes png;
    folder_open(&place);
    CHECK(png_encode(&png, rgb, 2, 2, &problem));
    folder_put(&place, "a b.png", png.data, png.size);
    file_free(&png);
    CHECK(png_encode(&png, rgb, 1, 4, &problem));
    folder_put(&place, "c.png", png.data, png.size);
    file_free(&png);
    vertex_textures(&place);
    face_textures(&place);
    forget();
    folder_close(&place);
}

/* Many faces of many colours on two vertices: there must be room for all wedges. */
static void many_wedges(void)
{
    const int n = 3000;
    char *text = malloc(40 * (size_t)n + 800), *at = text;
    int i;
    CHECK(text != NULL);
    if (!text)
        return;
    at += sprintf(at, HEAD4 "element face %d\n" FACES RGB("") "element tristrips 1\n" FACES "end_header\n" TWO, n);
    for (i = 0; i < n; ++i)
        at += sprintf(at, "3 0 1 %d %d %d 0\n", 2 + i % 2, i % 256, i / 256);
    at += sprintf(at, "100");
    for (i = 0; i < 100; ++i)
        at += sprintf(at, " %d", i % 3);
    at += sprintf(at, "\n");
    CHECK_LOADS(load(text, (size_t)(at - text)));
    CHECK(loaded.blocks && mesh()->triangle_count == (uint32_t)n + 98);
    free(text);
}

static void many_vertices(void)
{
    const uint32_t n = 65537;
    char *text = malloc(32 * (size_t)n + 400), *at = text;
    uint32_t i;
    CHECK(text != NULL);
    if (!text)
        return;
    at += sprintf(at, HEAD "element vertex %u\n" XYZ "element face %u\n" FACES "end_header\n", (unsigned)n,
                  (unsigned)(n - 2));
    for (i = 0; i < n; ++i)
        at += sprintf(at, "%u 0 0\n", (unsigned)(i % 10));
    for (i = 0; i + 2 < n; ++i)
        at += sprintf(at, "3 %u %u %u\n", (unsigned)i, (unsigned)i + 1, (unsigned)i + 2);
    CHECK_LOADS(load(text, (size_t)(at - text)));
    CHECK(loaded.blocks && mesh()->index_format == LMB_INDEX_U32 && mesh()->vertex_count == n);
    CHECK(loaded.blocks && ((const uint32_t *)mesh()->indices)[3 * (n - 2) - 1] == 65536);
    free(text);
}

/* --- headers as programs write them --- */

/* Comments anywhere, blank lines, the format last, meaningless lines, and both kinds of line end. */
static void loose_headers(void)
{
    static const char loose[] =
        "ply \nobj_info num_cols 512\nelement vertex 3\n\ncomment  a\tb c d e f g h i\n" XYZ
        "made by someone on a Monday\nelement face 1\n" FACES "obj_info\n  \nformat ascii 1.0\ncomment\nend_header\n"
        "comment the vertices\n\n" THREE "obj_info 1 2 3\ncomment\n3 0 1 2\n\ncomment the end";
    static const float xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const uint8_t face[13] = {3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0};
    static const uint16_t all[3] = {0, 1, 2};
    char crlf[2 * sizeof loose];
    writer w;
    size_t n = 0;
    for (size_t i = 0; i + 1 < sizeof loose; ++i) {
        if (loose[i] == '\n')
            crlf[n++] = '\r';
        crlf[n++] = loose[i];
    }
    CHECK_LOADS(load_text(loose));
    CHECK(loaded.blocks && are_indices(all, 1) && is_position(1, 1, 0, 0) && noted("mean nothing here passed over: 1"));
    CHECK_LOADS(load(crlf, n));
    CHECK(loaded.blocks && are_indices(all, 1) && is_position(2, 0, 1, 0) && noted("mean nothing here passed over: 1"));
    memset(&w, 0, sizeof w);
    put_string(&w, "ply\r\ncomment first\r\n\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
                   "element face 1\r\nproperty list uchar int vertex_indices\r\nformat binary_little_endian 1.0\r\nend_header\r\n");
    for (int i = 0; i < 9; ++i) {
        uint32_t bits;
        memcpy(&bits, &xyz[i], 4);
        for (int k = 0; k < 4; ++k)
            w.bytes[w.size++] = (uint8_t)(bits >> 8 * k);
    }
    memcpy(w.bytes + w.size, face, sizeof face);
    CHECK_LOADS(load(w.bytes, w.size + sizeof face));
    CHECK(loaded.blocks && are_indices(all, 1) && is_position(1, 1, 0, 0) && notes.count == 0);
}

/* --- refused input --- */

static const struct {
    const char *text, *says;
} bad[] = {
    {"ply", "not a model"},
    {"ply\n", "line 2: the file ends in its header"},
    {"ply\nformat ascii 1.0\nend_header", "line 3: the file ends in its header"},
    {"ply\nformat ascii 1.1\n", "line 2: not a format of PLY 1.0"},
    {"ply\nformat binary 1.0\n", "line 2: not a format of PLY 1.0"},
    {HEAD "format ascii 1.0\n", "line 3: a second format"},
    {"ply\nelement vertex 1\nend_header\n", "line 3: no line before it says the format"},
    {HEAD "element vertex\n", "line 3: not an element's name and count"},
    {HEAD "element vertex -1\n", "line 3: not an element's name and count"},
    {HEAD "element vertex 4294967296\n", "line 3: not an element's name and count"},
    {HEAD "element vertex 1 2\n", "line 3: not an element's"},
    {HEAD "element vertex 1\nelement vertex 1\n", "line 4: a second element vertex"},
    {HEAD "property float x\n", "line 3: a property before any element"},
    {HEAD "element vertex 1\nproperty float\n", "line 4: not a property's type and name"},
    {HEAD "element vertex 1\nproperty list uchar x\n", "line 4: not a property's type and name"},
    {HEAD "element vertex 1\nproperty half x\n", "line 4: property x is of no type"},
    {HEAD "element vertex 1\nproperty list uchar int x\n", "line 4: x must not be a list"},
    {HEAD "element face 1\nproperty int vertex_index\n", "line 4: vertex_index must be a list"},
    {HEAD "element vertex 1\n" XYZ "property int x\n", "line 7: a second property x"},
    {HEAD "element face 1\n" FACES "property list int int vertex_index\n", "both vertex_indices and vertex_index"},
    {HEAD "element vertex 1\nproperty list uchar int a b c\n", "more words"},
    {HEAD "end_header\n", "no faces; points and lines are not drawn"},
    {HEAD "element vertex 1\n" XYZ "end_header\n0 0 0\n", "no faces; points and lines are not drawn"},
    {HEAD "element vertex 3\n" XYZ "element face 0\n" FACES "end_header\n" THREE, "no faces; points"},
    {HEAD "element vertex 3\n" XYZ "element face 1\n" FACES "end_header\n" THREE "2 0 1\n", "no face has 3 corners"},
    {HEAD "element vertex 3\nproperty float x\nproperty float z\nelement face 1\n" FACES "end_header\n",
     "no property y"},
    {HEAD "element vertex 3\n" XYZ "element face 1\nproperty int a\nend_header\n", "no list vertex_indices"},
    {TRI THREE "3 0 1 3\n", "line 13: vertex number 3, but there are 3 from 0"},
    {TRI THREE "3 0 1 -1\n", "line 13: vertex number -1"},
    {TRI THREE "3 0 1 1.5\n", "line 13: 1.5 is not of the type int"},
    {TRI THREE "3 0 1 2 3\n", "line 13: \"3\" is one value more"},
    {TRI THREE "3 0 1\n", "line 13: fewer values"},
    {TRI THREE "256 0 1 2\n", "line 13: 256 is not of the type uchar"},
    {TRI THREE "-3 0 1 2\n", "line 13: -3 is not of the type uchar"},
    {TRI THREE "200 0 1 2\n", "line 13: a list of 200 values, which is more than the rest"},
    {TRI THREE "3 0 1 two\n", "line 13: \"two\" is not a number"},
    {TRI "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "line 11: \"x\" is not a number"},
    {TRI "0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 11: fewer values"},
    {TRI "0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n", "line 11: \"0\" is one value more"},
    {TRI THREE "3 0 1 2\n3 0 1 2\n", "bytes behind the last element"},
    {HEAD "element vertex 4000000000\n" XYZ "element face 1\n" FACES "end_header\n" THREE, "4000000000 elements"},
    {HEAD "element vertex 3\n" XYZ "element face 4294967295\n" FACES "end_header\n" THREE "3 0 1 2\n",
     "4294967295 elements, which is more than the rest"},
};

static void refuses(void)
{
    char *text = malloc(40 * 600 + 100), *at;
    size_t i;
    for (i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        check_fails(load_text(bad[i].text), bad[i].says);
    CHECK(text != NULL);
    for (i = 0; text && i < 2; ++i) {
        int k;
        at = text + sprintf(text, HEAD "element a 1\n");
        for (k = 0; k < 600; ++k)
            at += sprintf(at, i ? "element b%d 1\n" : "property int b%d\n", k);
        check_fails(load_text(text), i ? "more than 32 elements" : "more than 512 properties");
    }
    free(text);
}

static void refuses_bytes(void)
{
    static const struct {
        const char *header;
        int count_type;
        double count;
        const char *says;
    } hostile[] = {
        {"element face 1\nproperty list int int vertex_indices\n", INT, -1, "a list of -1 values"},
        {"element face 1\nproperty list uint int vertex_indices\n", 5, 4294967295.0, "more than the rest"},
        {"element face 1\nproperty list double int vertex_indices\n", DOUBLE, 2.5, "a list of 2.5 values"},
        {"element face 1\nproperty list double int vertex_indices\n", DOUBLE, 1e300, "a list of 1e+300 values"},
        {"element face 1\nproperty list float double vertex_indices\n", FLOAT, (double)NAN, "a list of"},
        {"element face 4294967295\nproperty list uchar char vertex_indices\n", UCHAR, 3, "4294967295 elements, which"},
    };
    size_t i, k;
    writer w;
    for (i = 0; i < 2 * (sizeof hostile / sizeof hostile[0]); ++i) {
        begin(&w, i % 2 ? BIG : LITTLE);
        put_string(&w, "element vertex 3\n" XYZ);
        put_string(&w, hostile[i / 2].header);
        put_string(&w, "end_header\n");
        for (k = 0; k < 9; ++k)
            put(&w, FLOAT, (double)k);
        put(&w, hostile[i / 2].count_type, hostile[i / 2].count);
        put(&w, INT, 0);
        check_fails(load(w.bytes, w.size), hostile[i / 2].says);
        CHECK(strstr(problem.text, ": byte ") != NULL);
    }
}

/* --- damage --- */

static void prefixes(int encoding)
{
    writer w;
    size_t n;
    put_all(&w, encoding);
    while (encoding == TEXT && (w.bytes[w.size - 1] == '\n' || w.bytes[w.size - 1] == ' '))
        --w.size; /* the last line needs no line end */
    CHECK_LOADS(load(w.bytes, w.size));
    for (n = 0; n < w.size; ++n)
        CHECK_MSG(!load(w.bytes, n) && problem.text[0] && !loaded.blocks, "%s: %d of %d bytes", encodings[encoding],
                  (int)n, (int)w.size);
}

/* A changed byte gives another valid scene or a message. */
static void damage(int encoding)
{
    static const uint8_t flips[] = {1, 16, 128, 255};
    writer w;
    size_t n, k;
    put_all(&w, encoding);
    for (n = 0; n < w.size; ++n)
        for (k = 0; k < sizeof flips; ++k) {
            w.bytes[n] ^= flips[k];
            if (load(w.bytes, w.size))
                CHECK(lmb_scene_check(&loaded.scene) == LMB_OK && lmb_scene_triangles(&loaded.scene) > 0);
            else
                CHECK(problem.text[0] != '\0' && !strstr(problem.text, "please report"));
            w.bytes[n] ^= flips[k];
        }
}

/* --- real files --- */

static const struct {
    const char *name;
    uint32_t vertices, triangles;
    int normals;
} known[] = {
    {"lucy_100k.ply", 50002, 100000, 0},
    {"rhino_3k.ply", 1691, 2999, 1},
    {"rhino_60k.ply", 34654, 60000, 1},
    {"stanford_bunny_2k.ply", 1017, 1999, 1},
};

static void known_files(void)
{
    char path[SHARED_PATH], name[64];
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i) {
        snprintf(name, sizeof name, "data/meshes/%s", known[i].name);
        if (!shared_file(path, name))
            continue;
        CHECK_LOADS(load_file(path));
        CHECK_MSG(lmb_scene_triangles(&loaded.scene) == known[i].triangles, "%s: %u", name,
                  (unsigned)lmb_scene_triangles(&loaded.scene));
        CHECK(loaded.blocks && mesh()->vertex_count == known[i].vertices && !mesh()->normals == !known[i].normals);
    }
}

void test_ply(void)
{
    int encoding;
    all_types();
    extremes();
    text_forms();
    scan_colours();
    dark_colours();
    strips();
    with_cr = 1;
    strips();
    with_cr = 0;
    face_colours();
    wide_codes();
    textures();
    many_wedges();
    many_vertices();
    loose_headers();
    refuses();
    refuses_bytes();
    for (encoding = 0; encoding < ENCODINGS; ++encoding) {
        run_all(encoding);
        prefixes(encoding);
        damage(encoding);
    }
    known_files();
    model_free(&loaded);
}
