/* mix_options.c: the command line of `lambent mix`. */
#include "mix_options.h"

#include <math.h>
#include <string.h>

#include "option_value.h"
#include "picture.h"

const char mix_help[] =
    "usage: lambent mix --frame PREFIX --object MESH -o OUT [options]\n"
    "       lambent mix --photo P --depth D --intrinsics FX,FY,CX,CY --object MESH -o OUT [options]\n"
    "\n"
    "Puts a virtual object into one photo with depth: finds the planes, stands it on one, lights it by what is\n"
    "around, and lets the photo answer with its shadow, its colour and its mirror image. Metres.\n"
    "\n"
    "photo\n"
    "  --frame PREFIX             PREFIX.color.(png|jpg|pfm), PREFIX.depth.(png|pfm) and PREFIX.json: fx fy cx cy,\n"
    "                             depth_unit_mm, and camera_to_world (4 x 4, rows) where it is known\n"
    "  --photo FILE               .png .jpg .pfm\n"
    "  --depth FILE               along the camera's axis, registered to the photo: 16-bit grey .png or .pfm;\n"
    "                             0 is not measured\n"
    "  --depth-scale S            m of a unit of it (default 0.001 for .png, 1 for .pfm)\n"
    "  --intrinsics FX,FY,CX,CY   px; the middle of the first pixel is 0,0\n"
    "object\n"
    "  --object MESH              .gltf .glb .obj .ply, +Y up; without one the photo comes out as it went in\n"
    "  --scale M                  m of a unit of the mesh (default: a sixth of the plane's side in all, or what fits)\n"
    "  --at X,Y                   stands on what is at this pixel (default: near the middle of the largest plane that\n"
    "                             faces up, where nothing else stands)\n"
    "  --at world                 is where the mesh has it, in the world of the frame's camera_to_world\n"
    "  --turn DEG                 about its upright axis (default 0: +Z towards the viewer)\n"
    "light\n"
    "  --light KIND:P:D:RGB[:INNER,OUTER]\n"
    "                             spot, point or sun: place, direction it goes, W/sr or W/m2, degrees of a spot's\n"
    "                             cones; in the frame's world, or without a pose the camera's (x right, y up, -z\n"
    "                             ahead). A photo's white is 1 W/(m2 sr). Default: a sun is guessed\n"
    "  --world FILE               what is around, a panorama or cube (default: folded from the photo)\n"
    "  --roughness R[,F]          0 .. 1: the plane under the object mirrors it, as if varnished (default: it does\n"
    "                             not); F: how much of what it sees straight down, 0 .. 1 (default 0.04)\n"
    "  --light-map N              texels a side, a power of two (default 1024)\n"
    "  --voxels D                 4 .. 10: 2^D voxels a side (default 7)\n"
    "  --cones N                  7, 19 or 37 a hemisphere (default 19)\n"
    "output\n"
    "  -o OUT                     .png .ppm .pfm .hdr\n"
    "  --show final               the photo with the object (default)\n"
    "         delta               what changed on real surfaces; in .png and .ppm round middle grey\n"
    "         planes              each in its colour\n"
    "         voxels              the light in them as the camera sees it\n"
    "         env                 the surroundings as a cube, faces +x -x +y -y +z -z from the top\n"
    "         object              alone, before black\n"
    "  --exposure EV              stops, for .png and .ppm (default 0; where the photo is linear, so that it fits)\n"
    "  --stats FILE.json          planes, voxels, seconds by stage\n"
    "  --backend NAME             scalar, sse2, avx2, avx512, neon, simd128: this machine's best by default\n"
    "\n"
    "exit status: 0 done, 1 a file that cannot be read or written, or nothing to stand on, 2 bad usage\n";

static int all_floats(const char *text, float *out, int count)
{
    return option_floats(&text, out, count) && *text == '\0';
}

static int parse_frame(const char *text, mix_options *o) { return (o->source.frame = text)[0] != '\0'; }
static int parse_photo(const char *text, mix_options *o) { return (o->source.photo = text)[0] != '\0'; }
static int parse_depth(const char *text, mix_options *o) { return (o->source.depth = text)[0] != '\0'; }
static int parse_object(const char *text, mix_options *o) { return (o->object = text)[0] != '\0'; }
static int parse_world(const char *text, mix_options *o) { return (o->world = text)[0] != '\0'; }
static int parse_stats(const char *text, mix_options *o) { return (o->stats = text)[0] != '\0'; }
static int parse_out(const char *text, mix_options *o) { return picture_format(o->out = text) != PICTURE_UNKNOWN; }
static int parse_scale(const char *text, mix_options *o) { return option_number(text, 1e-6f, 1e6f, &o->scale); }
static int parse_turn(const char *text, mix_options *o) { return option_number(text, -3600.0f, 3600.0f, &o->turn_deg); }
static int parse_voxels(const char *text, mix_options *o) { return option_int(text, 4, 10, &o->depth); }

static int parse_cones(const char *text, mix_options *o)
{
    static const char *const words[] = {"7", "19", "37", NULL};
    static const int32_t values[] = {7, 19, 37};
    return option_word(text, words, values, &o->cones);
}

static int parse_backend(const char *text, mix_options *o) { return (o->kernels = lmb_kernels_named(text)) != NULL; }

static int parse_exposure(const char *text, mix_options *o)
{
    return option_number(text, -60.0f, 60.0f, &o->exposure_ev);
}

static int parse_depth_scale(const char *text, mix_options *o)
{
    return option_number(text, 1e-9f, 1e6f, &o->source.depth_scale);
}

static int parse_intrinsics(const char *text, mix_options *o)
{
    return o->source.has_intrinsics = all_floats(text, o->source.intrinsics, 4);
}

static int parse_at(const char *text, mix_options *o)
{
    o->at = strcmp(text, "world") == 0 ? MIX_AT_WORLD : MIX_AT_PIXEL;
    return o->at == MIX_AT_WORLD || all_floats(text, o->at_px, 2);
}

static int parse_light(const char *text, mix_options *o)
{
    return o->light_count < MIX_LIGHTS && option_light(text, &o->lights[o->light_count++]);
}

static int parse_roughness(const char *text, mix_options *o)
{
    float v[2] = {0.0f, 0.04f};
    if (!all_floats(text, v, 1) && !all_floats(text, v, 2)) {
        return 0;
    }
    o->roughness = v[0];
    o->specular = v[1];
    return v[0] >= 0.0f && v[0] <= 1.0f && v[1] > 0.0f && v[1] <= 1.0f;
}

static int parse_light_map(const char *text, mix_options *o)
{
    return option_int(text, 8, 4096, &o->light_map) && (o->light_map & (o->light_map - 1)) == 0;
}

static int parse_show(const char *text, mix_options *o)
{
    static const char *const words[] = {"final", "delta", "planes", "voxels", "env", "object", NULL};
    return option_word(text, words, NULL, &o->show);
}

static const struct flag {
    option_name of;
    int (*parse)(const char *text, mix_options *o);
} flags[] = {
    {{"--frame", "what the files' names begin with"}, parse_frame},
    {{"--photo", "a file"}, parse_photo},
    {{"--depth", "a file"}, parse_depth},
    {{"--depth-scale", "metres over 0"}, parse_depth_scale},
    {{"--intrinsics", "FX,FY,CX,CY"}, parse_intrinsics},
    {{"--object", "a file"}, parse_object},
    {{"--scale", "metres over 0"}, parse_scale},
    {{"--at", "X,Y or world"}, parse_at},
    {{"--turn", "degrees"}, parse_turn},
    {{"--light", "KIND:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER], KIND spot, point or sun, at most eight times"},
     parse_light},
    {{"--world", "a file, or what six files' names begin with"}, parse_world},
    {{"--roughness", "R or R,F, 0 .. 1"}, parse_roughness},
    {{"--light-map", "a power of two, 8 .. 4096"}, parse_light_map},
    {{"--voxels", "4 .. 10"}, parse_voxels},
    {{"--cones", "7, 19 or 37"}, parse_cones},
    {{"--show", "final, delta, planes, voxels, env or object"}, parse_show},
    {{"-o", "a file name ending in .png, .ppm, .pfm or .hdr"}, parse_out},
    {{"--exposure", "stops, -60 .. 60"}, parse_exposure},
    {{"--stats", "a file"}, parse_stats},
    {{"--backend", "scalar, sse2, avx2, avx512, neon or simd128, as far as this machine has it"}, parse_backend},
};

static int complete(const mix_options *o, report *r)
{
    if (o->source.frame == NULL && o->source.photo == NULL) {
        return report_fail(r, "no photo given; add --frame PREFIX, or --photo, --depth and --intrinsics");
    }
    if (o->source.frame == NULL && o->source.depth == NULL) {
        return report_fail(r, "no depth given; add --depth FILE");
    }
    if (o->source.frame == NULL && !o->source.has_intrinsics) {
        return report_fail(r, "no camera given; add --intrinsics FX,FY,CX,CY");
    }
    if (o->out == NULL) {
        return report_fail(r, "no output given; add -o FILE.png");
    }
    if (o->object == NULL && (o->show == MIX_OBJECT || o->show == MIX_VOXELS)) {
        return report_fail(r, "--show: no object given; add --object MESH");
    }
    return 1;
}

int mix_options_parse(mix_options *out, int argc, char **argv, report *r)
{
    memset(out, 0, sizeof *out);
    out->light_map = 1024;
    out->depth = 7;
    out->cones = 19;
    out->exposure_ev = NAN;
    out->kernels = lmb_kernels_pick();
    for (int i = 1; i < argc; i += 2) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            return out->help = 1;
        }
        const int f = option_find(flags, sizeof *flags, sizeof flags / sizeof *flags, argv, i, r);
        if (f < 0 || (!flags[f].parse(argv[i + 1], out) && !option_refuse(&flags[f].of, argv[i + 1], r))) {
            return 0;
        }
    }
    return complete(out, r);
}
