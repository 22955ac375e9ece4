/* verb_relight.c: `lambent relight`: the light at a place of a world that was seen from another. */
#include "verb_relight.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "option_value.h"
#include "picture.h"
#include "world_read.h"

enum { WIDTH = 128, HEIGHT = 64, BLUR_WIDTH = WIDTH / 4, BLUR_HEIGHT = HEIGHT / 4 };

static const char help_text[] =
    "usage: lambent relight --world WORLD [--at X,Y,Z] --cube OUT [options]\n"
    "\n"
    "What a place in a world receives, from pictures of the world that were taken elsewhere: irradiance by normal, as\n"
    "a small cube map. Metres, +Y up, linear light.\n"
    "\n"
    "world\n"
    "  --world FILE|PREFIX        one file: six faces (+x -x +y -y +z -z from the top or the left), or the whole\n"
    "                             sphere, twice as wide as high; or six files, PREFIXpx PREFIXnx ... PREFIXnz\n"
    "                             (.pfm .hdr .png .jpg), of which some may be missing\n"
    "  --world-centre X,Y,Z       where it was taken (default 0,0,0)\n"
    "  --world-sphere X,Y,Z,R     what is far lies on this sphere (default: 100 m around the centre)\n"
    "  --world-box X0,Y0,Z0,X1,Y1,Z1\n"
    "                             or on the walls of this box; the centre lies inside\n"
    "  --ground FILE              the ground from above, right +x, down +z; transparent where it is not known\n"
    "  --ground-size W,D          its sides, m (default 100,100)\n"
    "  --ground-centre X,Z        the picture's middle (default: the world's centre)\n"
    "  --ground-height H          of the ground, m (default 0)\n"
    "  --storage f32|log16|log8   how the world is kept: floats, or log codes of 0 to 100 (default f32)\n"
    "  --overlap nearer|mean      where far world and ground both show (default nearer)\n"
    "light\n"
    "  --at X,Y,Z                 the place (default: the world's centre); outside the far world: the nearest inside\n"
    "  --filter cosine            exact, from 6 x 8 x 8 directions (default); off by about 0.5 %\n"
    "           sh9|sh16|sh25     spherical harmonics: 1 %, the same, 0.6 %; may be negative beside sharp lights\n"
    "           blur|blur1|blur2  by rows and columns: the source's 6 %, one product fitted a row 4 %, two 1.5 %\n"
    "output\n"
    "  --cube OUT                 W/m2, N wide and 6 N high, faces +x -x +y -y +z -z from the top (.pfm .hdr; .png\n"
    "                             .ppm to look at)\n"
    "  --faces N                  texels of a face's side, 1 .. 64 (default 8)\n"
    "  --map OUT                  what the place sees, 128 x 64: longitude from -180 degrees, north on top; W/(sr m2)\n"
    "  --backend NAME             scalar, sse2, avx2, avx512, neon, simd128: this machine's best by default\n"
    "\n"
    "exit status: 0 done, 1 a file that cannot be read or written, 2 bad usage\n";

enum { FILTER_COSINE, FILTER_SH9, FILTER_SH16, FILTER_SH25, FILTER_BLUR, FILTER_BLUR1, FILTER_BLUR2, FILTERS };
static const char *const filter_names[FILTERS + 1] = {"cosine", "sh9", "sh16", "sh25", "blur", "blur1", "blur2", NULL};

typedef struct options {
    const char *world, *ground, *cube, *map;
    lmb_vec3 at;
    lmb_world_pictures place; /* all but the pictures */
    float ground_size[2], ground_centre[2];
    int32_t faces, filter, format, blend;
    int has_at, has_far, has_ground_centre, help;
    const lmb_kernels *kernels;
} options;

/* --- command line ------------------------------------------------------------------------------------------------- */

static int all_floats(const char *text, float *out, int count)
{
    return option_floats(&text, out, count) && *text == '\0';
}

static int parse_sphere(const char *text, options *o)
{
    float v[4];
    if (!all_floats(text, v, 4) || !(v[3] > 0.0f)) {
        return 0;
    }
    o->place.shape = LMB_WORLD_SPHERE;
    o->place.middle = (lmb_vec3){v[0], v[1], v[2]};
    o->place.radius = v[3];
    return o->has_far = 1;
}

static int parse_box(const char *text, options *o)
{
    float v[6];
    if (!all_floats(text, v, 6) || !(v[0] < v[3] && v[1] < v[4] && v[2] < v[5])) {
        return 0;
    }
    o->place.shape = LMB_WORLD_BOX;
    o->place.low = (lmb_vec3){v[0], v[1], v[2]};
    o->place.high = (lmb_vec3){v[3], v[4], v[5]};
    return o->has_far = 1;
}

static int parse_world(const char *text, options *o) { return (o->world = text)[0] != '\0'; }
static int parse_ground(const char *text, options *o) { return (o->ground = text)[0] != '\0'; }
static int parse_cube(const char *text, options *o) { return picture_format(o->cube = text) != PICTURE_UNKNOWN; }
static int parse_map(const char *text, options *o) { return picture_format(o->map = text) != PICTURE_UNKNOWN; }
static int parse_centre(const char *text, options *o) { return option_vec3(text, &o->place.centre); }
static int parse_at(const char *text, options *o) { return o->has_at = option_vec3(text, &o->at); }
static int parse_faces(const char *text, options *o) { return option_int(text, 1, 64, &o->faces); }
static int parse_filter(const char *text, options *o) { return option_word(text, filter_names, NULL, &o->filter); }
static int parse_backend(const char *text, options *o) { return (o->kernels = lmb_kernels_named(text)) != NULL; }

static int parse_ground_size(const char *text, options *o)
{
    return all_floats(text, o->ground_size, 2) && o->ground_size[0] > 0.0f && o->ground_size[1] > 0.0f;
}

static int parse_ground_centre(const char *text, options *o)
{
    return o->has_ground_centre = all_floats(text, o->ground_centre, 2);
}

static int parse_ground_height(const char *text, options *o) { return all_floats(text, &o->place.ground_y, 1); }

static int parse_storage(const char *text, options *o)
{
    static const char *const words[] = {"f32", "log16", "log8", NULL}; /* in the order of LMB_WORLD_ */
    return option_word(text, words, NULL, &o->format);
}

static int parse_overlap(const char *text, options *o)
{
    static const char *const words[] = {"nearer", "mean", NULL};
    return option_word(text, words, NULL, &o->blend);
}

static const struct flag {
    option_name of;
    int (*parse)(const char *text, options *o);
} flags[] = {
    {{"--world", "a file, or what six files' names begin with"}, parse_world},
    {{"--world-centre", "X,Y,Z"}, parse_centre},
    {{"--world-sphere", "X,Y,Z,R with R over 0"}, parse_sphere},
    {{"--world-box", "X0,Y0,Z0,X1,Y1,Z1, the smaller ones first"}, parse_box},
    {{"--ground", "a file"}, parse_ground},
    {{"--ground-size", "W,D over 0"}, parse_ground_size},
    {{"--ground-centre", "X,Z"}, parse_ground_centre},
    {{"--ground-height", "a number"}, parse_ground_height},
    {{"--storage", "f32, log16 or log8"}, parse_storage},
    {{"--overlap", "nearer or mean"}, parse_overlap},
    {{"--at", "X,Y,Z"}, parse_at},
    {{"--filter", "cosine, sh9, sh16, sh25, blur, blur1 or blur2"}, parse_filter},
    {{"--cube", "a file name ending in .pfm, .hdr, .png or .ppm"}, parse_cube},
    {{"--faces", "1 .. 64"}, parse_faces},
    {{"--map", "a file name ending in .pfm, .hdr, .png or .ppm"}, parse_map},
    {{"--backend", "scalar, sse2, avx2, avx512, neon or simd128, as far as this machine has it"}, parse_backend},
};

/* What follows from what was given. */
static int complete(options *o, report *r)
{
    lmb_world_pictures *p = &o->place;
    if (o->world == NULL) {
        return report_fail(r, "no world given; add --world FILE");
    }
    if (o->cube == NULL && o->map == NULL) {
        return report_fail(r, "no output given; add --cube FILE.pfm");
    }
    if (!o->has_far) {
        p->middle = p->centre;
        p->radius = 100.0f;
    }
    if (!o->has_ground_centre) {
        o->ground_centre[0] = p->centre.x;
        o->ground_centre[1] = p->centre.z;
    }
    p->ground_width_m = o->ground_size[0];
    p->ground_depth_m = o->ground_size[1];
    p->ground_x = o->ground_centre[0] - 0.5f * o->ground_size[0];
    p->ground_z = o->ground_centre[1] - 0.5f * o->ground_size[1];
    o->at = o->has_at ? o->at : p->centre;
    return 1;
}

static int parse(options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    o->faces = 8;
    o->ground_size[0] = o->ground_size[1] = 100.0f;
    o->kernels = lmb_kernels_pick();
    for (int i = 1; i < argc; i += 2) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            return o->help = 1;
        }
        const int f = option_find(flags, sizeof *flags, sizeof flags / sizeof *flags, argv, i, r);
        if (f < 0 || (!flags[f].parse(argv[i + 1], o) && !option_refuse(&flags[f].of, argv[i + 1], r))) {
            return 0;
        }
    }
    return complete(o, r);
}

/* --- light -------------------------------------------------------------------------------------------------------- */

/* All that the work needs; large, and one of it. */
typedef struct work {
    world_pictures pictures;
    lmb_world world;
    void *world_memory, *table_memory[3], *blur_memory;
    lmb_probe_table table[3]; /* of the map, its half and its quarter */
    lmb_probe_lights lights;
    lmb_probe_blur blur;
    float map[3 * WIDTH * HEIGHT], half[3 * WIDTH * HEIGHT / 4], blurred[3 * BLUR_WIDTH * BLUR_HEIGHT];
    float line[4 * BLUR_WIDTH], cube[3 * 6 * 64 * 64];
} work;

static int make_world(work *w, options *o, report *r)
{
    if (!world_read_cube(&o->place, &w->pictures, o->world, r) ||
        (o->ground != NULL && !world_read_ground(&o->place, &w->pictures, o->ground, r))) {
        return 0;
    }
    const size_t bytes = lmb_world_bytes(&o->place, o->format);
    if ((w->world_memory = malloc(bytes)) == NULL) {
        return report_fail(r, "%s: out of memory", o->world);
    }
    return lmb_world_init(&w->world, &o->place, o->format, w->world_memory, bytes) == LMB_OK ||
           report_fail(r, "--world-centre: lies outside the far world, or numbers are over 1,000,000 m");
}

static int make_table(work *w, int i, report *r)
{
    const size_t bytes = lmb_probe_table_bytes(WIDTH >> i, HEIGHT >> i);
    w->table_memory[i] = malloc(bytes);
    return (w->table_memory[i] != NULL && lmb_probe_table_init(&w->table[i], WIDTH >> i, HEIGHT >> i, -180.0f,
                                                               w->table_memory[i], bytes) == LMB_OK) ||
           report_fail(r, "out of memory");
}

static int blur_cube(work *w, const options *o, report *r)
{
    const int32_t terms = o->filter - FILTER_BLUR;
    const size_t bytes = lmb_probe_blur_bytes(&w->table[2], terms);
    w->blur_memory = malloc(bytes);
    if (w->blur_memory == NULL || lmb_probe_blur_init(&w->blur, &w->table[2], terms, w->blur_memory, bytes) != LMB_OK) {
        return report_fail(r, "out of memory");
    }
    lmb_probe_halve(w->half, w->map, &w->table[0]);
    lmb_probe_halve(w->half, w->half, &w->table[1]);
    lmb_probe_blur_map(w->blurred, w->line, o->kernels, w->half, &w->blur);
    return lmb_probe_map_cube(w->cube, o->faces, w->blurred, &w->table[2]) == LMB_OK;
}

static int light_cube(work *w, const options *o, report *r)
{
    static const int32_t terms[] = {0, LMB_SH_9, LMB_SH_16, LMB_SH_25};
    float harmonics[3][LMB_SH_25];
    if (o->filter >= FILTER_BLUR) {
        return blur_cube(w, o, r);
    }
    if (o->filter == FILTER_COSINE) {
        lmb_probe_reduce(&w->lights, w->map, &w->table[0]);
        return lmb_probe_cosine(w->cube, o->faces, o->kernels, &w->lights, &w->table[0]) == LMB_OK;
    }
    lmb_probe_sh(harmonics, w->map, &w->table[0]);
    return lmb_probe_sh_cube(w->cube, o->faces, (const float (*)[LMB_SH_25])harmonics, terms[o->filter]) == LMB_OK;
}

/* Planes as a picture. */
static int write_planes(const char *path, const float *planes, int32_t width, int32_t height, report *r)
{
    const size_t pixels = (size_t)width * (size_t)height;
    image out = {width, height, 3, malloc(3 * pixels * sizeof(float))};
    if (out.pixels == NULL) {
        return report_fail(r, "%s: out of memory", path);
    }
    for (size_t i = 0; i < 3 * pixels; ++i) {
        out.pixels[i] = planes[i % 3 * pixels + i / 3];
    }
    const int ok = picture_write(path, &out, picture_auto_exposure(&out), r);
    image_free(&out);
    return ok;
}

static int relight(work *w, options *o, report *r)
{
    if ((o->cube != NULL && !file_can_write(o->cube, r)) || (o->map != NULL && !file_can_write(o->map, r)) ||
        !make_world(w, o, r)) {
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        if (!make_table(w, i, r)) {
            return 0;
        }
    }
    if (lmb_probe_remap(w->map, o->kernels, &w->world, &w->table[0], o->at, o->blend) != LMB_OK) {
        return report_fail(r, "--at: numbers over 1,000,000 m");
    }
    return (o->map == NULL || write_planes(o->map, w->map, WIDTH, HEIGHT, r)) &&
           (o->cube == NULL ||
            (light_cube(w, o, r) && write_planes(o->cube, w->cube, o->faces, 6 * o->faces, r)));
}

static void work_free(work *w)
{
    world_pictures_free(&w->pictures);
    free(w->world_memory);
    for (int i = 0; i < 3; ++i) {
        free(w->table_memory[i]);
    }
    free(w->blur_memory);
    free(w);
}

int verb_relight(int argc, char **argv)
{
    report r = {""};
    options o;
    if (!parse(&o, argc, argv, &r)) {
        fprintf(stderr, "lambent relight: %s\n", r.text);
        return 2;
    }
    if (o.help) {
        fputs(help_text, stdout);
        return 0;
    }
    work *w = calloc(1, sizeof *w);
    const int ok = w != NULL ? relight(w, &o, &r) : report_fail(&r, "out of memory");
    if (!ok) {
        fprintf(stderr, "lambent: %s\n", r.text);
    }
    if (w != NULL) {
        work_free(w);
    }
    return ok ? 0 : 1;
}
