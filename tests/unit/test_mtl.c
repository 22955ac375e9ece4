/* test_mtl.c: OBJ's material libraries: search paths, the effect of each statement, notes about ignored ones. */
#include "../folder.h"

#include <math.h>

#include "../../tools/model/io_obj.h"
#include "../model_case.h"

void test_mtl(void);

enum { TEXT_MAX = 1 << 16, MANY = 2000 };

#define FACE "f 1/1 2/2 3/3\n"

/* The run's folder, and the model loaded last. */
static folder place;

static void put(const char *name, const char *text) { folder_put(&place, name, text, strlen(text)); }

/* A triangle for each of the lines `uses`, which can name libraries and materials. */
static int load(const char *uses)
{
    static char text[TEXT_MAX];
    int n = snprintf(text, sizeof text, "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvt 0.5 1\n%s", uses);
    CHECK(n >= 0 && n < TEXT_MAX);
    forget();
    return model_load(&loaded, folder_put(&place, "m.obj", text, (size_t)n), NULL, &notes, &problem);
}

/* A model with the materials a and b of the library. */
static int load_library(const char *library)
{
    put("m.mtl", library);
    return load("mtllib m.mtl\nusemtl a\n" FACE "usemtl b\n" FACE);
}

/* A triangle with sides of this many metres. */
static void tiny(void)
{
    CHECK_LOADS(load("v 0 0 0.00001\nv 0.00002 0 0.00001\nv 0 0.00002 0.00001\nf 4 5 6\n"));
    CHECK(noted("the scene is 2.83e-05 m across; light is inexact in what is under 0.0001 m, scale it up"));
    CHECK_LOADS(load("v 0 0 0.0001\nv 0.0002 0 0.0001\nv 0 0.0002 0.0001\nf 4 5 6\n"));
    CHECK(!noted("light is inexact"));
}

static void put_picture(const char *name)
{
    static const uint8_t rgb[12] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
    file_bytes png;
    CHECK(png_encode(&png, rgb, 2, 2, &problem));
    folder_put(&place, name, png.data, png.size);
    file_free(&png);
}

/* --- emission --- */

static int emits(uint32_t material, float x, float y, float z)
{
    const float *e = loaded.scene.materials[material].emission;
    return e[0] == x && e[1] == y && e[2] == z;
}

static void emission(void)
{
    CHECK_LOADS(load_library("newmtl a\nKe 17 12.5 4\nnewmtl b\nKe 3\n"));
    CHECK(emits(0, 0, 0, 0) && emits(1, 17, 12.5f, 4) && emits(2, 3, 3, 3) &&
          noted("light the scene (but with fixed groups): 2"));
    CHECK_LOADS(load_library("newmtl a\nKe 2 1\nnewmtl b\nKe -1 1e39 0.5\n"));
    CHECK(emits(1, 2, 1, 2) && emits(2, 0, 0, 0.5f) && noted("light the scene (but with fixed groups): 2"));
    CHECK_LOADS(load_library("newmtl a\nKe 0 0 0\nnewmtl b\nKe 0 7 0\n"));
    CHECK(emits(1, 0, 0, 0) && emits(2, 0, 7, 0) && noted("light the scene (but with fixed groups): 1"));
    CHECK_LOADS(load_library("newmtl a\nKe spectral x.rfl 1\nnewmtl b\nKe xyz 1 2 3\n"));
    CHECK(emits(1, 0, 0, 0) && noted("spectrum (Kd or Ke spectral) is left out: 1"));
    CHECK(emits(2, 0, (float)(-0.9692660 + 2 * 1.8760108 + 3 * 0.0415560),
                (float)(0.0556434 - 2 * 0.2040259 + 3 * 1.0572252)));
}

/* Kd as CIE XYZ: the white of D65, and a red. With a spectrum the material stays grey. */
static void xyz(void)
{
    const lmb_material *m;
    CHECK_LOADS(load_library("newmtl a\nKd xyz 0.95047 1 1.08883\nnewmtl b\nKd XYZ 0.2062 0.1063 0.0097\n"));
    m = loaded.scene.materials;
    for (int k = 0; k < 3; ++k)
        CHECK(fabs((double)m[1].albedo[k] - 1) < 1e-3 && fabs((double)m[2].albedo[k] - (k == 0 ? 0.5 : 0)) < 1e-3);
    CHECK(notes.count == 0);
    CHECK_LOADS(load_library("newmtl a\nKd xyz 0.25\nnewmtl b\nKd spectral a.rfl 1\n"));
    m = loaded.scene.materials;
    CHECK(fabs((double)m[1].albedo[1] - 0.25 * 0.9483) < 1e-3 && m[2].albedo[0] == 0.8f);
    CHECK(noted("spectrum (Kd or Ke spectral) is left out: 1") && notes.count == 1);
    CHECK(!load_library("newmtl a\nKd xyz\n") && strstr(problem.text, "line 2: Kd needs three numbers"));
    CHECK(!load_library("newmtl a\nKd xyz 1 z\n") && strstr(problem.text, "line 2: Kd takes numbers, 0 to 1"));
}

/* Keywords are not case-sensitive, but names of materials and files are. */
static void letter_case(void)
{
    put_picture("Pic.png");
    put("m.mtl", "NEWMTL a\nKD 0.25 0.5 0.75\nMap_KD -CLAMP ON Pic.png\nnewmtl b\nkd 0.25\nKE 1 2 3\nD 0.5\nMAP_BUMP x.png\nIllum 5\n");
    CHECK_LOADS(load("MTLLIB m.mtl\nUSEMTL a\nF 1/1 2/2 3/3\nUseMtl b\n" FACE "s OFF\n"));
    const lmb_material *m = loaded.scene.materials;
    CHECK(loaded.scene.material_count == 3 && loaded.scene.mesh_count == 2 && loaded.scene.texture_count == 1);
    CHECK(m[1].albedo[2] == 0.75f && m[1].texture == 0 && loaded.scene.textures[0].wrap_s == LMB_WRAP_CLAMP);
    CHECK(m[2].albedo[0] == 0.25f && m[2].alpha == 0.5f && emits(2, 1, 2, 3) && noted("bump or normal map") && noted("mirrors"));
    put("m.mtl", "newmtl A\nKd 1\nmap_kd pic.png\n");
    CHECK_LOADS(load("mtllib m.mtl\nusemtl a\n" FACE "usemtl A\n" FACE));
    CHECK(noted("no library describes, drawn grey: 1 (first: a)") && noted("pic.png"));
}

static void emission_refuses(void)
{
    CHECK(!load_library("newmtl a\nKd 1\nKe\n") && strstr(problem.text, "m.mtl: line 3: Ke needs three numbers"));
    CHECK(!load_library("newmtl b\nKe 1 bright 1\n") && strstr(problem.text, "m.mtl: line 2: Ke takes numbers"));
    CHECK(loaded.block_count == 0 && !loaded.blocks);
    CHECK_LOADS(load_library("newmtl other\nKe\nKe bright\n")); /* of an unused material */
}

/* --- ignored statements --- */

static void opacity(void)
{
    CHECK_LOADS(load_library("newmtl a\nd 0.5\nTr 0.5\nnewmtl b\nTr 0.25\n"));
    const lmb_material *m = loaded.scene.materials;
    CHECK(noted("by alpha 0.5: 2") && notes.count == 1 && m[1].alpha == 0.5f && m[2].alpha == 0.75f);
    CHECK((m[1].flags & LMB_ALPHA_BLEND) && (m[1].flags & LMB_ALPHA_MASK) && m[1].alpha_cutoff == 0.5f);
    CHECK_LOADS(load_library("newmtl a\nd 1\nTr 0\nnewmtl b\nd 0\n"));
    CHECK(notes.count == 0 && loaded.scene.materials[1].alpha == 1 && loaded.scene.materials[2].alpha == 0);
    CHECK_LOADS(load_library("newmtl a\nd 0.5\nd 1\nnewmtl b\nd\nTr\nd none\n"));
    CHECK(notes.count == 0 && loaded.scene.materials[1].alpha == 1);
    CHECK(!(loaded.scene.materials[1].flags & (LMB_ALPHA_BLEND | LMB_ALPHA_MASK)));
    /* Exporters that write one number for both, in either order. */
    CHECK_LOADS(load_library("newmtl a\nd 1\nTr 1\nnewmtl b\nTr 1\nd 1\n"));
    CHECK(notes.count == 0 && loaded.scene.materials[1].alpha == 1 && loaded.scene.materials[2].alpha == 1);
    CHECK(!(loaded.scene.materials[2].flags & (LMB_ALPHA_BLEND | LMB_ALPHA_MASK)));
    CHECK_LOADS(load_library("newmtl a\nd -halo 0.25\nnewmtl b\nd -halo\n"));
    CHECK(noted("by alpha 0.5: 1") && loaded.scene.materials[1].alpha == 0.25f && loaded.scene.materials[2].alpha == 1);
}

static void maps_left_out(void)
{
    static const char *const bumps[] = {"bump", "map_bump", "map_Bump", "norm", "map_Kn", "map_Norm"};
    char library[64];
    size_t i;
    CHECK_LOADS(load_library("newmtl a\nmap_d x.png\nmap_Ke x.png\nnewmtl b\nmap_d x.png\n"));
    CHECK(noted("(map_d) is left out: 2") && noted("(map_Ke) is left out: 1") && notes.count == 2);
    for (i = 0; i < sizeof bumps / sizeof bumps[0]; ++i) {
        snprintf(library, sizeof library, "newmtl a\n%s -bm 1 x.png\n%s y.png\n", bumps[i], bumps[i]);
        CHECK_LOADS(load_library(library));
        CHECK_MSG(noted("bump or normal map is left out: 1"), "no note on %s", bumps[i]);
    }
    CHECK_LOADS(load_library("newmtl a\ndisp x.png\nnewmtl b\ndecal -s 1 1 1 x.png\n"));
    CHECK(noted("disp or decal is left out: 2") && notes.count == 1);
    CHECK_LOADS(load_library("newmtl a\nillum 5\nnewmtl b\nillum 7\nillum 2\nnewmtl c\nillum 1\n"));
    CHECK(noted("mirrors and glasses (illum 3 to 9), drawn without their mirror: 1") && notes.count == 1);
    CHECK_LOADS(load_library("newmtl a\nmap_d\nmap_Ke # none\nbump\nnewmtl b\nmap_Ks x.png\n"));
    CHECK(notes.count == 0);
}

static void options_left_out(void)
{
    CHECK_LOADS(load_library("newmtl a\nmap_Kd -t 1 x.png\nnewmtl b\nmap_Kd -mm 0 2 x.png\n"));
    CHECK(noted("without its options -t or -mm: 2") && loaded.scene.texture_count == 1);
    CHECK_LOADS(load_library("newmtl a\nmap_Kd -t 0 0 0 -mm 0 1 -blendu off x.png\n"
                             "newmtl b\nmap_Kd -mm 0.5 1 x.png\n"));
    CHECK(noted("without its options -t or -mm: 1"));
}

/* --- maps --- */

static int is_uv(uint32_t mesh, uint32_t vertex, float u, float v)
{
    const float *uv = (const float *)loaded.scene.meshes[mesh].uvs;
    return uv && uv[2 * vertex] == u && uv[2 * vertex + 1] == v;
}

/* By hand: (1, 0.25) times (2, 3), moved by (0.25, 0.5), is (2.25, 1.25), which is at 1 - 1.25 with v down. */
static void scaled_and_moved(void)
{
    CHECK_LOADS(load_library("newmtl a\nmap_Kd -s 2 3 -o 0.25 0.5 0 x.png\nnewmtl b\nmap_Kd x.png\n"));
    CHECK(loaded.scene.texture_count == 1 && loaded.scene.materials[2].texture == 0 && notes.count == 0);
    CHECK(is_uv(0, 0, 0.25f, 0.5f) && is_uv(0, 1, 2.25f, -0.25f) && is_uv(0, 2, 1.25f, -2.5f));
    CHECK(is_uv(1, 0, 0, 1) && is_uv(1, 1, 1, 0.75f) && is_uv(1, 2, 0.5f, 0));
    CHECK_LOADS(load_library("newmtl a\nmap_Kd -s 2 x.png\nnewmtl b\nmap_Kd -o -0.5 x.png\n"));
    CHECK(is_uv(0, 1, 2, 0.75f) && is_uv(1, 1, 0.5f, 0.75f));
    CHECK_LOADS(load_library("newmtl a\nmap_Kd -s 1e39 nan -o 0 0 x.png\nnewmtl b\nmap_Kd -o 1e7 -1e300 x.png\n"));
    CHECK(is_uv(0, 1, 0, 0) && is_uv(1, 1, 0, 0)); /* out of range: the corner */
}

/* The last statement with a file name counts, with only the options of this statement. */
static void statement_again(void)
{
    CHECK_LOADS(load_library("newmtl a\nmap_Kd -clamp on -s 2 x.png\nmap_Kd\nmap_Kd -s 4\nnewmtl b\n"
                             "map_Kd -clamp on -s 2 y.png\nmap_Kd x.png\n"));
    CHECK(loaded.scene.texture_count == 2 && notes.count == 0);
    CHECK(loaded.scene.textures[0].wrap_s == LMB_WRAP_CLAMP && loaded.scene.textures[1].wrap_t == LMB_WRAP_REPEAT);
    CHECK(is_uv(0, 1, 2, 0.75f) && is_uv(1, 1, 1, 0.75f));
    CHECK_LOADS(load_library("newmtl a\nmap_Kd -clamp off x.png\nnewmtl b\nmap_Kd\n"));
    CHECK(loaded.scene.materials[1].texture == 0 && loaded.scene.textures[0].wrap_s == LMB_WRAP_REPEAT);
    CHECK(loaded.scene.materials[2].texture == -1);
}

static void foreign_picture(void)
{
    put("x.avif", "    ftypavif");
    CHECK_LOADS(load_library("newmtl a\nmap_Kd x.avif\n"));
    CHECK(noted("this picture is AVIF, which is not read"));
    put("x.pbm", "P4 8 1\n0");
    CHECK_LOADS(load_library("newmtl a\nmap_Kd x.pbm\n"));
    CHECK(noted("this picture is PBM, which is not read"));
    put("x.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n0000");
    CHECK_LOADS(load_library("newmtl a\nmap_Kd x.hdr\n"));
    CHECK(noted("this picture is HDR, linear light"));
}

/* --- libraries --- */

static float grey(uint32_t material) { return loaded.scene.materials[material].albedo[1]; }

static void libraries(void)
{
    put("1.mtl", "newmtl a\nKd 0.25\n");
    put("2.mtl", "newmtl b\nKd 0.5\n");
    put("1.mtl 2.mtl 3", "newmtl a\nKd 0.75\n");
    CHECK_LOADS(load("mtllib 1.mtl \t2.mtl\nusemtl a\n" FACE "usemtl b\n" FACE));
    CHECK(grey(1) == 0.25f && grey(2) == 0.5f && notes.count == 0);
    CHECK_LOADS(load("mtllib 1.mtl 2.mtl 3\nusemtl a\n" FACE "usemtl b\n" FACE)); /* as one name, if it exists */
    CHECK(grey(1) == 0.75f && grey(2) == 0.8f && noted("no library describes, drawn grey: 1"));
    CHECK_LOADS(load("mtllib 1.mtl # of one\nmtllib # none\nusemtl a\n" FACE));
    CHECK(grey(1) == 0.25f && noted("materials are grey: 1 (first: ") && notes.count == 1);
    CHECK_LOADS(load("mtllib 1.mtl\nmtllib 1.mtl 2.mtl 3\nmtllib ./1.mtl .//1.mtl\nusemtl a\n" FACE));
    CHECK(grey(1) == 0.75f && notes.count == 0); /* 1.mtl is not read again */
}

static void libraries_missing(void)
{
    char uses[1400];
    CHECK_LOADS(load("mtllib no.mtl 1.mtl nor.mtl no.mtl\nmtllib nor.mtl\nusemtl a\n" FACE));
    CHECK(grey(1) == 0.25f && noted("materials are grey: 2 (first: ") && noted("nor.mtl: cannot be opened"));
    CHECK_LOADS(load("mtllib /1.mtl\nusemtl a\n" FACE));
    CHECK(grey(1) == 0.8f && noted("/1.mtl: not a path from the model's folder"));
    memset(uses, 'x', sizeof uses);
    memcpy(uses, "mtllib ", 7);
    memcpy(uses + 1200, "\nusemtl a\n" FACE, sizeof "\nusemtl a\n" FACE);
    CHECK_LOADS(load(uses));
    CHECK(noted("a name of 1193 bytes"));
}

/* A line with more names than the maximum of libraries. */
static void libraries_many(void)
{
    static char uses[TEXT_MAX / 2];
    size_t n = (size_t)sprintf(uses, "mtllib");
    int i;
    for (i = 0; i < 100; ++i)
        n += (size_t)sprintf(uses + n, " %d.mtl", i);
    sprintf(uses + n, "\nusemtl a\n" FACE "usemtl b\n" FACE);
    CHECK_LOADS(load(uses));
    CHECK(grey(1) == 0.25f && grey(2) == 0.5f && noted("after the first 64: 37") && noted("grey: 61 (first: "));
}

/* --- names --- */

/* Short names as hashed by another program; longer ones depend on the byte order. */
static void hash(void)
{
    static const char text[] = "a name of some length";
    char changed[sizeof text];
    const uint64_t whole = obj_hash(1, text, sizeof text);
    size_t i;
    CHECK(obj_hash(0, "a", 1) == UINT64_C(0x407448D2B89B1813));
    CHECK(obj_hash(0, "lambent", 7) == UINT64_C(0x7459B02C7AC02EC6));
    for (i = 0; i < sizeof text; ++i) {
        memcpy(changed, text, sizeof text);
        changed[i] ^= 1;
        CHECK(obj_hash(1, changed, sizeof text) != whole && obj_hash(1, text, i) != whole);
    }
    CHECK(obj_hash(2, text, sizeof text) != whole && obj_hash(UINT64_C(1) << 63 | 1, text, sizeof text) != whole);
}

/* The key determines a name's slot: few of 64 names share one of 1024 slots. */
static void names_are_keyed(void)
{
    obj_material items[1];
    static uint32_t slots[1024];
    obj_names names = {items, slots, 0, 1023, 1, 1};
    uint32_t first, second, same = 0;
    char text[8];
    slice name = {text, 0};
    int i;
    for (i = 0; i < 64; ++i) {
        name.size = (size_t)sprintf(text, "n%d", i);
        names.key = 1;
        CHECK(obj_find(&names, name, &first) == UINT32_MAX && first < 1024);
        names.key = 2;
        CHECK(obj_find(&names, name, &second) == UINT32_MAX);
        same += first == second;
    }
    CHECK_MSG(same < 8, "%u of 64 names go where they went by another key", (unsigned)same);
}

/* Each name is one material, however many there are, and a library finds each. */
static void names_many(void)
{
    static char uses[TEXT_MAX - 256], library[2 * TEXT_MAX];
    size_t n = (size_t)sprintf(uses, "mtllib many.mtl\n" FACE), l = 0;
    uint32_t i, wrong = 0;
    for (i = 0; i < 2 * MANY; ++i)
        n += (size_t)sprintf(uses + n, "usemtl %u\n", (unsigned)(i % MANY));
    sprintf(uses + n, FACE);
    for (i = 0; i < MANY; ++i)
        l += (size_t)sprintf(library + l, "newmtl %u\nKd 0 0.%04u\n", (unsigned)i, (unsigned)i);
    put("many.mtl", library);
    CHECK_LOADS(load(uses));
    CHECK(loaded.scene.material_count == MANY + 1 && loaded.facts.materials == MANY && notes.count == 0);
    for (i = 0; i < MANY && loaded.scene.material_count == MANY + 1; ++i)
        wrong += !(fabs((double)grey(i + 1) - i * 1e-4) < 1e-7);
    CHECK_MSG(wrong == 0, "%u materials have another's colour", (unsigned)wrong);
}

void test_mtl(void)
{
    folder_open(&place);
    put_picture("x.png");
    put_picture("y.png");
    emission();
    emission_refuses();
    xyz();
    letter_case();
    opacity();
    maps_left_out();
    options_left_out();
    scaled_and_moved();
    statement_again();
    foreign_picture();
    libraries();
    libraries_missing();
    libraries_many();
    hash();
    names_are_keyed();
    names_many();
    tiny();
    model_free(&loaded);
    folder_close(&place);
}
