/* relight_options.c: the command line of `lambent relight`. */
#include "relight_options.h"

#include <math.h>
#include <string.h>

#include "demo_field.h"
#include "option_value.h"
#include "picture.h"

static const char usage_world[] =
    "usage: lambent relight --world WORLD [--at X,Y,Z] --cube OUT [options]\n"
    "       lambent relight --world WORLD --object FILE [--at X,Y,Z ...] -o OUT [options]\n"
    "\n"
    "What a place in a world receives, from pictures of the world that were taken elsewhere: irradiance by normal, as\n"
    "a small cube map; and objects drawn in that light, over the world as background. Metres, +Y up, linear light.\n"
    "\n"
    "world\n"
    "  --world FILE|PREFIX        one file: six faces (+x -x +y -y +z -z from the top or the left), or the whole\n"
    "                             sphere, twice as wide as high; or six files, PREFIXpx PREFIXnx ... PREFIXnz\n"
    "                             (.pfm .hdr .png .jpg), of which some may be missing; or `demo`, a built-in\n"
    "                             field with places of its own\n"
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
    "  --at X,Y,Z                 the place (default: the world's centre); outside the far world: the nearest in it\n"
    "  --filter cosine            exact, from 6 x 8 x 8 directions (default); off by about 0.5 %\n"
    "           sh9|sh16|sh25     spherical harmonics: 1 %, the same, 0.6 %; may be negative beside sharp lights\n"
    "           blur|blur1|blur2  by rows and columns: the source's 6 %, one product fitted a row 4 %, two 1.5 %\n"
    "  --cube OUT                 W/m2, N wide and 6 N high, faces +x -x +y -y +z -z from the top (.pfm .hdr; .png\n"
    "                             .ppm to look at)\n"
    "  --faces N                  texels of a face's side, 1 .. 64 (default 8)\n"
    "  --map OUT                  what the place sees, 128 x 64: longitude from -180 degrees, north on top;\n"
    "                             W/(sr m2)\n";

static const char usage_object[] =
    "objects\n"
    "  --object FILE              .gltf .glb .obj .ply, or `demo`, a figure: stands with the middle of its box's\n"
    "                             bottom at --at, and is lit as its box's middle is\n"
    "  --at X,Y,Z                 again and again: one more of it, up to 32\n"
    "  --scale M                  its longest side, m (default: as the file says)\n"
    "  --roughness R              0 (a mirror) .. 1 (default: glTF's materials' own, else 0.4)\n"
    "  --f0 F                     what it mirrors where it faces the viewer, 0 .. 1 (default: its own, else 0.04)\n"
    "  --per-part                 each part of the object is lit as its own box's middle is\n"
    "  --light KIND:P:D:RGB[:INNER,OUTER]\n"
    "                             a lamp or sun beside the world's light, as in `lambent render`; up to 16\n"
    "  --show both|normal|gloss   all light, that by normals alone, or what is mirrored alone (default both)\n"
    "  --path FILE                places of the object, X,Y,Z a line: a picture each, OUT with -0000, -0001, ...\n"
    "  --reuse M                  an object keeps its light until it is M metres from where it was computed (default\n"
    "                             0.15; 0: until it rests)\n"
    "  --every N                  but no longer than N pictures if it moves at all\n"
    "  --keep X,Y,Z               a named place: objects within --reuse of it use its light; may be repeated\n"
    "picture\n"
    "  -o OUT                     .png .ppm (display), .pfm .hdr (linear)\n"
    "  --size WxH                 px (default 640x480)\n"
    "  --eye X,Y,Z --target X,Y,Z [--up X,Y,Z] --fov DEG\n"
    "                             (default: so that all objects fit; 45 degrees)\n"
    "  --exposure EV|auto         stops, display formats only (default auto: said on stderr)\n"
    "  --backend NAME             scalar, sse2, avx2, avx512, neon, simd128: this machine's best by default\n"
    "\n"
    "exit status: 0 done, 1 a file that cannot be read or written, 2 bad usage\n";

const char *const relight_usage[RELIGHT_USAGE_PARTS] = {usage_world, usage_object};

const char *const relight_filters[FILTERS + 1] = {"cosine", "sh9", "sh16", "sh25", "blur", "blur1", "blur2", NULL};

/* --- the world ---------------------------------------------------------------------------------------------------- */

static int all_floats(const char *text, float *out, int count)
{
    return option_floats(&text, out, count) && *text == '\0';
}

static int parse_sphere(const char *text, relight_options *o)
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

static int parse_box(const char *text, relight_options *o)
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

static int parse_world(const char *text, relight_options *o) { return (o->world = text)[0] != '\0'; }
static int parse_ground(const char *text, relight_options *o) { return (o->ground = text)[0] != '\0'; }
static int parse_centre(const char *text, relight_options *o) { return option_vec3(text, &o->place.centre); }

static int parse_ground_size(const char *text, relight_options *o)
{
    return all_floats(text, o->ground_size, 2) && o->ground_size[0] > 0.0f && o->ground_size[1] > 0.0f;
}

static int parse_ground_centre(const char *text, relight_options *o)
{
    return o->has_ground_centre = all_floats(text, o->ground_centre, 2);
}

static int parse_ground_height(const char *text, relight_options *o) { return all_floats(text, &o->place.ground_y, 1); }

static int parse_storage(const char *text, relight_options *o)
{
    static const char *const words[] = {"f32", "log16", "log8", NULL}; /* in the order of LMB_WORLD_ */
    return option_word(text, words, NULL, &o->format);
}

static int parse_overlap(const char *text, relight_options *o)
{
    static const char *const words[] = {"nearer", "mean", NULL};
    return option_word(text, words, NULL, &o->blend);
}

/* --- places and light --------------------------------------------------------------------------------------------- */

int relight_place(const char *text, lmb_vec3 *out)
{
    return option_vec3(text, out) && fabsf(out->x) <= 1e6f && fabsf(out->y) <= 1e6f && fabsf(out->z) <= 1e6f;
}

static int add_place(const char *text, lmb_vec3 *places, int32_t *count)
{
    return *count < RELIGHT_PLACES && relight_place(text, &places[(*count)++]);
}

static int parse_at(const char *text, relight_options *o) { return add_place(text, o->at, &o->at_count); }
static int parse_keep(const char *text, relight_options *o) { return add_place(text, o->keep, &o->keep_count); }
static int parse_object(const char *text, relight_options *o) { return (o->object = text)[0] != '\0'; }
static int parse_path(const char *text, relight_options *o) { return (o->path = text)[0] != '\0'; }
static int parse_faces(const char *text, relight_options *o) { return option_int(text, 1, 64, &o->faces); }
static int parse_scale(const char *text, relight_options *o) { return option_number(text, 1e-3f, 1e5f, &o->scale_m); }
static int parse_f0(const char *text, relight_options *o) { return option_number(text, 0.0f, 1.0f, &o->f0); }
static int parse_every(const char *text, relight_options *o) { return option_int(text, 1, 1 << 20, &o->policy.every); }

static int parse_filter(const char *text, relight_options *o)
{
    return option_word(text, relight_filters, NULL, &o->filter);
}

static int parse_roughness(const char *text, relight_options *o)
{
    return option_number(text, 0.0f, 1.0f, &o->roughness);
}

static int parse_reuse(const char *text, relight_options *o)
{
    return option_number(text, 0.0f, 1e5f, &o->policy.radius_m);
}

static int add_light(const char *text, relight_options *o)
{
    return o->light_count < RELIGHT_LIGHTS && option_light(text, &o->lights[o->light_count++]);
}

static int parse_show(const char *text, relight_options *o)
{
    static const char *const words[] = {"both", "normal", "gloss", NULL}; /* in the order of LMB_RELIGHT_ */
    return option_word(text, words, NULL, &o->show);
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static int parse_picture(const char *text, const char **out) { return picture_format(*out = text) != PICTURE_UNKNOWN; }
static int parse_out(const char *text, relight_options *o) { return parse_picture(text, &o->out); }
static int parse_cube(const char *text, relight_options *o) { return parse_picture(text, &o->cube); }
static int parse_map(const char *text, relight_options *o) { return parse_picture(text, &o->map); }
static int parse_up(const char *text, relight_options *o) { return option_vec3(text, &o->view.up); }
static int parse_fov(const char *text, relight_options *o) { return view_option_fov(text, &o->view); }

static int parse_size(const char *text, relight_options *o)
{
    return option_size(text, &o->view.width, &o->view.height);
}

static int parse_eye(const char *text, relight_options *o)
{
    return o->view.has_eye = option_vec3(text, &o->view.eye);
}

static int parse_target(const char *text, relight_options *o)
{
    return o->view.has_target = option_vec3(text, &o->view.target);
}

static int parse_exposure(const char *text, relight_options *o)
{
    o->exposure_auto = strcmp(text, "auto") == 0;
    return o->exposure_auto || option_number(text, -60.0f, 60.0f, &o->exposure_ev);
}

static int parse_backend(const char *text, relight_options *o)
{
    return (o->kernels = lmb_kernels_named(text)) != NULL;
}

static const struct flag {
    option_name of;
    int (*parse)(const char *text, relight_options *o);
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
    {{"--at", "X,Y,Z within 1,000,000 m, at most 32 of them"}, parse_at},
    {{"--filter", "cosine, sh9, sh16, sh25, blur, blur1 or blur2"}, parse_filter},
    {{"--cube", "a file name ending in .pfm, .hdr, .png or .ppm"}, parse_cube},
    {{"--faces", "1 .. 64"}, parse_faces},
    {{"--map", "a file name ending in .pfm, .hdr, .png or .ppm"}, parse_map},
    {{"--object", "a file"}, parse_object},
    {{"--scale", "metres, over 0"}, parse_scale},
    {{"--roughness", "a number from 0 to 1"}, parse_roughness},
    {{"--f0", "a number from 0 to 1"}, parse_f0},
    {{"--light", "spot|point|sun:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER], up to 16 of them, angles <= 89"}, add_light},
    {{"--show", "both, normal or gloss"}, parse_show},
    {{"--path", "a file"}, parse_path},
    {{"--reuse", "metres, 0 or more"}, parse_reuse},
    {{"--every", "a number of pictures, at least 1"}, parse_every},
    {{"--keep", "X,Y,Z within 1,000,000 m, at most 32 of them"}, parse_keep},
    {{"-o", "a file name ending in .png, .ppm, .pfm or .hdr"}, parse_out},
    {{"--size", "WxH, 1 .. 8192 each"}, parse_size},
    {{"--eye", "X,Y,Z"}, parse_eye},
    {{"--target", "X,Y,Z"}, parse_target},
    {{"--up", "X,Y,Z"}, parse_up},
    {{"--fov", "degrees, over 0 and under 179"}, parse_fov},
    {{"--exposure", "stops (-60 .. 60) or auto"}, parse_exposure},
    {{"--backend", "scalar, sse2, avx2, avx512, neon or simd128, as far as this machine has it"}, parse_backend},
};

/* --- all of it ---------------------------------------------------------------------------------------------------- */

static int check_together(const relight_options *o, report *r)
{
    if (o->world == NULL) {
        return report_fail(r, "no world given; add --world FILE");
    }
    if (o->cube == NULL && o->map == NULL && o->out == NULL) {
        return report_fail(r, "no output given; add --cube FILE.pfm, or --object FILE -o FILE.png");
    }
    if ((o->object == NULL) != (o->out == NULL)) {
        return report_fail(r, "--object and -o go together");
    }
    if (o->path != NULL && (o->object == NULL || o->at_count > 0)) {
        return report_fail(r, "--path moves one --object; leave --at out");
    }
    if ((o->cube != NULL || o->map != NULL) && (o->at_count > 1 || o->path != NULL)) {
        return report_fail(r, "--cube and --map are of one place: give one --at");
    }
    return view_options_check(&o->view, r);
}

/* What follows from what was given. */
static void complete(relight_options *o)
{
    lmb_world_pictures *p = &o->place;
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
    if (o->at_count == 0 && o->path == NULL) {
        o->at[0] = p->centre;
        o->at[0].y = o->object != NULL && o->ground != NULL ? p->ground_y : p->centre.y;
        o->at_count = 1;
    }
}

int relight_options_parse(relight_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    o->faces = 8;
    o->ground_size[0] = o->ground_size[1] = 100.0f;
    o->roughness = o->f0 = -1.0f;
    o->policy.radius_m = LMB_PROBE_RADIUS;
    o->exposure_auto = 1;
    o->kernels = lmb_kernels_pick();
    view_options_init(&o->view);
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            return o->help = 1;
        }
        if (strcmp(argv[i], "--per-part") == 0) {
            o->per_part = 1;
            continue;
        }
        const int f = option_find(flags, sizeof *flags, sizeof flags / sizeof *flags, argv, i, r);
        if (f < 0 || (!flags[f].parse(argv[++i], o) && !option_refuse(&flags[f].of, argv[i], r))) {
            return 0;
        }
    }
    if (o->world != NULL && strcmp(o->world, "demo") == 0) {
        demo_field_options(o);
    }
    complete(o);
    return check_together(o, r);
}
