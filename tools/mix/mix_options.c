/* mix_options.c: the command line of `lambent mix`. */
#include "mix_options.h"

#include <math.h>
#include <string.h>

#include "../common/frame_name.h"
#include "../common/option_value.h"
#include "../common/options.h"
#include "../picture/picture.h"

/* --- parsers for single options ----------------------------------------------------------------------------------- */

static int all_floats(const char *text, float *out, int count)
{
    return option_floats(&text, out, count) && *text == '\0';
}

static int parse_at(const char *text, void *at)
{
    mix_at *o = at;
    o->at = strcmp(text, "world") == 0 ? MIX_AT_WORLD : MIX_AT_PIXEL;
    return o->at == MIX_AT_WORLD || all_floats(text, o->px, 2);
}

static int parse_up(const char *text, void *at)
{
    mix_options *o = at;
    const int is_camera = strcmp(text, "camera") == 0, is_pose = strcmp(text, "pose") == 0;
    o->up = is_camera ? MIX_UP_CAMERA : is_pose ? MIX_UP_POSE : MIX_UP_GIVEN;
    return is_camera || is_pose ||
           (all_floats(text, o->up_to, 3) && fabsf(o->up_to[0]) + fabsf(o->up_to[1]) + fabsf(o->up_to[2]) > 1e-6f);
}

static int parse_roughness(const char *text, void *at)
{
    mix_options *o = at;
    float v[2] = {0.0f, 0.04f};
    if (!all_floats(text, v, 1) && !all_floats(text, v, 2)) {
        return 0;
    }
    o->roughness = v[0];
    o->specular = v[1];
    return v[0] >= 0.0f && v[0] <= 1.0f && v[1] > 0.0f && v[1] <= 1.0f;
}

/* --- the table ---------------------------------------------------------------------------------------------------- */

static const char *const cones[] = {"7", "19", "37", NULL};
static const int32_t cone_values[] = {7, 19, 37};
#if !defined(OPTIONS_WITHOUT_HELP)
static const char *const missing[] = {"skip", "estimate", NULL};
#endif
static const char *const ons[] = {"floor", "table", "wall", NULL};
static const int32_t on_values[] = {MIX_ON_FLOOR, MIX_ON_TABLE, MIX_ON_WALL};
static const char *const shows[] = {"final", "delta", "planes", "voxels", "env", "object", NULL};

#define AT(member) .at = offsetof(mix_options, member)
#define EACH(member, number)                                                                                \
    AT(member), .counts = offsetof(mix_options, number), .times = MIX_OBJECTS,                              \
    .size = sizeof *((mix_options *)0)->member

static const option_row photo_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("photo")},
    {.name = "--frame", .value = "PREFIX", .kind = OPTION_TEXT, AT(source.frame),
     .help = HELP("PREFIX.color.(png|jpg|pam|pfm), PREFIX.depth.(png|pfm) and PREFIX.json: fx fy cx cy, depth_unit_mm, "
             "and if known camera_to_world (4 x 4, row by row)")},
#if !defined(OPTIONS_WITHOUT_HELP) /* the web page mixes one photo */
    {.name = "--frames", .value = "DIR|LIST", .kind = OPTION_TEXT, AT(frames),
     .help = HELP("many frames, in order. LIST or DIR/frames.txt has one PREFIX per line, relative to the list. A "
             "line that begins with # is a comment; if the list has zero bytes, these separate the PREFIXes, and "
             "none is a comment. A TUM DIR has rgb.txt, depth.txt and groundtruth.txt; it needs --intrinsics, and "
             "--depth-scale is then 0.0002. The object stays where it stands in the first frame. Voxels are built "
             "again only if a twentieth of the surfaces around it is new or gone, or if the photo is that much "
             "brighter or darker. -o is a pattern, as frame_%04d.png. A frame that cannot be used is reported and "
             "left out; the exit status is then 1")},
#endif
#if !defined(OPTIONS_WITHOUT_HELP)
    {.name = "--missing-depth", .kind = OPTION_WORD, AT(source.may_lack_depth), .words = missing,
     .help = HELP("of frames without a depth file, or TUM photos without a depth within 0.02 s. skip: they are left "
             "out (default); estimate: depth comes from surfaces and planes of earlier frames, seen from the new "
             "pose; the first frame must have depth")},
#endif
    {.name = "--photo", .value = "FILE", .kind = OPTION_TEXT, AT(source.photo), .file = OPTION_READS,
     .help = HELP(".png .jpg .pfm")},
    {.name = "--depth", .value = "FILE", .kind = OPTION_TEXT, AT(source.depth), .file = OPTION_READS,
     .help = HELP("along the camera's axis, registered to the photo: 16-bit grey .png or .pfm; 0 is not measured. "
             "If it has another size of the same shape, it is resampled, with edges from the photo's colours")},
    {.name = "--depth-scale", .value = "S", .kind = OPTION_NUMBER, AT(source.depth_scale), .low = 1e-9, .high = 1e6,
     .help = HELP("metres per unit of depth (default 0.001 for .png, 1 for .pfm)")},
    {.name = "--intrinsics", .value = "FX,FY,CX,CY", .kind = OPTION_NUMBERS, AT(source.intrinsics), .size = 4,
     .low = -1e30, .high = 1e30, .counts = offsetof(mix_options, source.has_intrinsics),
     .help = HELP("px; the middle of the first pixel is 0,0")},
    {.kind = OPTION_END},
};

static const option_row object_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("object")},
    {.name = "--object", .value = "MESH", .kind = OPTION_TEXT, EACH(object_of, objects), .file = OPTION_READS,
     .help = HELP(".gltf .glb .obj .ply, +Y up; without it the photo is written unchanged. If you give several, give "
             "one --at each, in the same order, and one --scale and --turn for all or one each; light is then "
             "simpler, as for --placements")},
    OPTION_VERTEX_COLOURS_ROW(mix_options, choice.vertex_colours),
    {.name = "--scale", .value = "M", .kind = OPTION_NUMBER, EACH(scale_of, scales), .low = 1e-6, .high = 1e6,
     .help = HELP("metres per unit of the mesh (default 1: the mesh is in metres)")},
    {.name = "--fit", .kind = OPTION_FLAG, AT(fit),
     .help = HELP("chooses --scale: a sixth of the plane's side in all, less if the picture has no room for that")},
    {.name = "--at", .value = "X,Y|world", .kind = OPTION_OWN, EACH(at_of, ats), .parse = parse_at,
     .expects = "X,Y or world",
     .help = HELP("the object stands on the surface at this pixel, or hangs there if it is a wall (default: near "
             "the middle of the largest plane that faces up, with free space around); world: the object is where "
             "the mesh has it, in the world of the frame's camera_to_world")},
    {.name = "--on", .kind = OPTION_WORD, AT(on), .words = ons, .values = on_values,
     .help = HELP("floor: the lowest plane that faces up; table: the largest one 0.3 m above another; wall: the "
             "mesh hangs there upright, with +Z away from it (default: the largest plane that faces up, or else the "
             "largest wall)")},
    {.name = "--up", .value = "X,Y,Z|camera|pose", .kind = OPTION_OWN, .parse = parse_up,
     .expects = "X,Y,Z, camera or pose",
     .help = HELP("the up direction, for cameras that look down: in the frame's world, or without a pose the "
             "camera's (x right, y up, -z ahead); camera: up in the picture; pose: +Y of the world. Default: +Y or "
             "+Z of the world if a plane lies across it, or else the direction that the planes within 70 degrees of "
             "the picture's up agree on")},
    {.name = "--turn", .value = "DEG", .kind = OPTION_NUMBER, EACH(turn_of, turns), .low = -3600, .high = 3600,
     .help = HELP("about the object's upright axis (default 0: +Z towards the viewer); on a wall, about the wall's "
             "normal")},
#if !defined(OPTIONS_WITHOUT_HELP)
    {.name = "--placements", .value = "LIST", .kind = OPTION_TEXT, AT(placements), .file = OPTION_READS,
     .help = HELP("many pictures of one photo, instead of --object and -o. LIST is a text file with a line per "
             "object: OUT MESH PLACE [TURN [SIZE]], separated by blanks. Names are relative to LIST; quote a name "
             "with blanks: \"my vase.glb\". PLACE: X,Y or world as for --at, or floor, table, wall or any as for "
             "--on. TURN: degrees (default 0). SIZE: metres of the longest side, fit, or - for the mesh's own "
             "(default). Successive lines with one OUT put up to 16 objects into one picture; they do not avoid each "
             "other. The folders of all OUT must exist. A line that begins with # is a comment. Light is simpler "
             "than for --object: an object reflects light once, in its mean colour, and does not glow. Not with "
             "--frames, --show, --stats and --roughness")},
#endif
    {.kind = OPTION_END},
};

static const option_row light_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("light")},
    {.name = "--light", .kind = OPTION_LIGHT, AT(lights), .counts = offsetof(mix_options, light_count),
     .times = MIX_LIGHTS, .size = sizeof(lmb_light), .sizes = offsetof(mix_options, light_size),
     .nones = offsetof(mix_options, no_light),
     .help = HELP("KIND is spot, point or sun: place, direction, W/sr or W/m2, degrees of a spot's cones. SIZE "
             "makes shadows soft: the light's width in m, or a sun's in degrees. All in the frame's world, or "
             "without a pose the camera's (x right, y up, -z ahead). A photo's white is 1 W/(m2 sr). none: only the "
             "environment lights the object. Default: a sun or lamp estimated from the photo's shadows and "
             "shading; if these show none, a weak light from above, and the object darkens half as much")},
    {.name = "--world", .value = "FILE", .kind = OPTION_TEXT, AT(world), .file = OPTION_READS,
     .help = HELP("the environment, a panorama or cube (default: folded from the photo)")},
    {.name = "--roughness", .value = "R[,F]", .kind = OPTION_OWN, .parse = parse_roughness,
     .expects = "R or R,F, 0 .. 1",
     .help = HELP("0 .. 1: the plane under the object reflects it, as if varnished (default: it does not); F: "
             "reflectance as seen straight from above, 0 .. 1 (default 0.04)")},
    {.name = "--shadow-map", .value = "N", .kind = OPTION_POWER_OF_2, AT(shadow_map), .low = 8, .high = 4096,
     .help = HELP("texels per side (default 1024)")},
    {.name = "--voxels", .value = "D", .kind = OPTION_INT, AT(depth), .low = 4, .high = 10,
     .help = HELP("2^D voxels per side (default 7)")},
    {.name = "--cones", .kind = OPTION_WORD, AT(cones), .words = cones, .values = cone_values,
     .help = HELP("per hemisphere (default 19)")},
    {.kind = OPTION_END},
};

static const option_row output_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("output")},
    {.name = "-o", .value = "OUT", .kind = OPTION_OWN, AT(out), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP(PICTURE_OPTION_HELP)},
    {.name = "--show", .kind = OPTION_WORD, AT(show), .words = shows,
     .help = HELP("final: the photo with the object (default);\ndelta: the change of real surfaces; in .png and "
             ".ppm relative to middle grey;\nplanes: one colour each;\nvoxels: the light in the voxels, as the "
             "camera sees it;\nenv: the environment as a cube, faces +x -x +y -y +z -z from the top;\nobject: "
             "without the photo, before black")},
#if !defined(OPTIONS_WITHOUT_HELP) /* the web page writes no files */
    {.name = "--labels", .value = "PREFIX", .kind = OPTION_TEXT, AT(labels),
     .help = HELP("also writes PREFIX.mask.png: white where the object is visible, and 254, 253 ... for more objects; "
             "PREFIX.depth.pfm: depth, m; PREFIX.normal.pfm: normals, x right, y up, z towards the camera; "
             "PREFIX.object.png: the object without the photo, with alpha; PREFIX.pose.json: the camera, and "
             "transforms from the mesh to the camera, as camera_to_world, and to the world. --placements adds each "
             "OUT's name without ending to PREFIX: labels/ and out/1.png give labels/out/1.mask.png; the folder "
             "must exist")},
    {.name = "--match-grain", .kind = OPTION_FLAG, AT(match_grain),
     .help = HELP("adds noise like the photo's to the object, by brightness and colour")},
#endif
    {.name = "--samples", .kind = OPTION_WORD, AT(samples), .words = option_samples, .values = option_sample_values,
     .help = HELP("per pixel, of the object over the photo (default 4 for .png and .ppm, 1 for .pfm and .hdr)")},
    {.name = "--exposure", .value = "EV|auto", .kind = OPTION_OWN, AT(exposure_ev), .parse = option_stops,
     .expects = OPTION_STOPS_WANTS,
     .help = HELP("stops, for .png and .ppm (default auto: 0, or if the photo is linear, a value that fits it; "
             "--frames takes the first frame's)")},
#if !defined(OPTIONS_WITHOUT_HELP)
    {.name = "--stats", .value = "FILE.json", .kind = OPTION_TEXT, AT(stats), .file = OPTION_WRITES,
     .help = HELP("planes, voxels, seconds by stage")},
    OPTION_BACKEND_ROW(mix_options, kernels),
    OPTION_THREADS_ROW(mix_options, threads, "draw the picture"),
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(mix_options, is_quiet, is_verbose, "print the time of each stage"),
    OPTION_ASK,
#endif
    {.kind = OPTION_END},
};

const option_table mix_table = {
    .verb = "mix",
    .usage = HELP("mix --frame PREFIX --object MESH -o OUT [options]\n"
             "mix --photo P --depth D --intrinsics FX,FY,CX,CY --object MESH -o OUT [options]\n"
             "mix --frame PREFIX --object MESH --at X,Y --object MESH --at X,Y ... -o OUT\n"
             "mix --frames DIR|LIST --object MESH -o frame_%04d.png [options]\n"
             "mix --frame PREFIX --placements LIST [options]"),
    .about = HELP("Puts a virtual object into one photo with depth: finds the planes, stands the object on one, "
             "lights it by the environment, and adds its shadow, colour bleeding and reflection to the photo. Units "
             "are metres."),
    .part = {photo_rows, object_rows, light_rows, output_rows},
    .examples = HELP("  a photo with depth of the built-in room, and a tent put into it:\n"
                "    eye='--eye 0.5,1.25,2.5 --target 0.5,1,-1 --size 80x60'\n"
                "    lambent render demo $eye -o photo.png\n"
                "    lambent render demo $eye --show depth -o depth.pfm\n"
                "    printf 'v %s\\n' '-1 0 -1' '1 0 -1' '0 0 1' '0 1 0' >tent.obj\n"
                "    printf 'f %s\\n' '1 2 3' '1 4 2' '2 4 3' '3 4 1' >>tent.obj\n"
                "    lambent mix --photo photo.png --depth depth.pfm --intrinsics 72.43,72.43,39.5,29.5 \\\n"
                "        --object tent.obj --fit --voxels 5 -o mixed.png\n"),
    .status = HELP("exit status: 0 done, 1 a file that cannot be read or written, or no plane to stand on, 2 bad "
             "usage, also one file for two purposes"),
};

static int complete_frames(const mix_options *o, report *r)
{
    if (o->source.frame != NULL || o->source.photo != NULL || o->source.depth != NULL) {
        return report_fail(r, "--frames names all photos; leave --frame, --photo and --depth out");
    }
    if (o->labels != NULL || o->placements != NULL) {
        return report_fail(r, "--frames: --labels and --placements are of one photo");
    }
    if (o->out == NULL || frame_digits(o->out) == 0) {
        return report_fail(r, "--frames: -o is a name with one %%0Nd, as frame_%%04d.png");
    }
    if (o->stats != NULL) {
        return report_fail(r, "--frames: --stats is of one photo; -v says what each frame took");
    }
    return o->show != MIX_PLANES && o->show != MIX_ENV && o->show != MIX_VOXELS
               ? 1
               : report_fail(r, "--frames: --show planes, voxels and env are of one photo");
}

static int complete_placements(const mix_options *o, report *r)
{
    if (o->object != NULL || o->out != NULL || o->at != MIX_AT_CENTRE || o->on != MIX_ON_ANY || o->turn_deg != 0.0f ||
        o->scale > 0.0f || o->fit) {
        return report_fail(r, "--placements: lines of the list have object, place, turn, size and output; leave "
                              "--object, --at, --on, --turn, --scale, --fit and -o out");
    }
    if (o->frames != NULL || o->stats != NULL || o->show != MIX_FINAL || o->specular > 0.0f) {
        return report_fail(r, "--placements: leave --frames, --stats, --show and --roughness out");
    }
    return 1;
}

static int complete_photo(const mix_options *o, report *r)
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
    return o->placements != NULL ? complete_placements(o, r)
                                 : o->out != NULL || report_fail(r, "no output given; add -o FILE.png");
}

/* One value for all objects, or one each? */
static int counts_fit(int32_t count, int32_t objects, const char *option, report *r)
{
    return count <= 1 || count == objects ||
           report_fail(r, "--object and %s: %d and %d of them; give one %s, or each object one", option, (int)objects,
                       (int)count, option);
}

/* Several objects need a place each; scale and turn are one for all, or one each. */
static int complete_objects(const mix_options *o, report *r)
{
    const int32_t n = o->objects;
#if defined(OPTIONS_WITHOUT_HELP) /* the web page has no placements */
    if (n > 1) {
        return report_fail(r, "--object: %d of them; give one", (int)n);
    }
#endif
    if (n > 1 && o->ats != n) {
        return report_fail(r, "--object and --at: %d and %d of them; give each object its place", (int)n, (int)o->ats);
    }
    if (n < 2 && o->ats > 1) {
        return report_fail(r, "--at: %d places, but %s; give each place its --object", (int)o->ats,
                           n == 1 ? "one --object" : "no --object");
    }
    if (!counts_fit(o->scales, n, "--scale", r) || !counts_fit(o->turns, n, "--turn", r)) {
        return 0;
    }
    for (int32_t i = 0; i < n && n > 1; ++i) {
        if (o->at_of[i].at == MIX_AT_WORLD && (o->fit || o->scales > 0 || o->turns > 0)) {
            return report_fail(r, "--at world has the mesh's own scale and turn; leave --scale, --fit and --turn out");
        }
    }
    if (n > 1 && (o->depth > 0 || o->cones > 0)) {
        return report_fail(r, "--voxels and --cones apply only to one --object; leave them out");
    }
    return n < 2 || (o->frames == NULL && o->stats == NULL && o->show == MIX_FINAL && !(o->specular > 0.0f)) ||
           report_fail(r, "several --object: leave --frames, --stats, --show and --roughness out");
}

static int complete(const mix_options *o, report *r)
{
    if (!complete_objects(o, r)) {
        return 0;
    }
    if (o->frames == NULL && o->source.may_lack_depth) {
        return report_fail(r, "--missing-depth estimate needs earlier frames; add --frames");
    }
    if (!(o->frames != NULL ? complete_frames(o, r) : complete_photo(o, r))) {
        return 0;
    }
    if (o->source.has_intrinsics && !mix_is_camera(o->source.intrinsics)) {
        return report_fail(r, "--intrinsics: focal lengths are over 0, and all four in pixels");
    }
    if (o->labels != NULL && ((o->object == NULL && o->placements == NULL) || o->show != MIX_FINAL)) {
        return report_fail(r, "--labels is of an object in the photo; add --object MESH, and leave --show out");
    }
    if (o->object == NULL && (o->show == MIX_OBJECT || o->show == MIX_VOXELS)) {
        return report_fail(r, "--show: no object given; add --object MESH");
    }
    if (o->no_light && o->light_count > 0) {
        return report_fail(r, "--light none leaves all lights out, and another --light adds one; leave one out");
    }
    if (o->fit && (o->scale > 0.0f || o->at == MIX_AT_WORLD)) {
        return report_fail(r, "--fit chooses the size that %s; leave one out",
                           o->scale > 0.0f ? "--scale sets" : "--at world has");
    }
    if (o->on != MIX_ON_ANY && o->at != MIX_AT_CENTRE) {
        return report_fail(r, "--on and --at both say where the object stands; leave one out");
    }
    return 1;
}

int mix_options_parse(mix_options *out, int argc, char **argv, report *r)
{
    memset(out, 0, sizeof *out);
    out->shadow_map = 1024;
    out->exposure_ev = NAN;
    out->kernels = lmb_kernels_pick();
    const int asked = options_parse(out, &mix_table, argc, argv, r);
    out->object = out->objects > 0 ? out->object_of[0] : NULL;
    out->at = out->at_of[0].at;
    memcpy(out->at_px, out->at_of[0].px, sizeof out->at_px);
    out->scale = out->scale_of[0];
    out->turn_deg = out->turn_of[0];
    if (asked == OPTIONS_RUN && !complete(out, r)) {
        return OPTIONS_BAD;
    }
    out->depth = out->depth > 0 ? out->depth : 7;
    out->cones = out->cones > 0 ? out->cones : 19;
    return asked;
}
