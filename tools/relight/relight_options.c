/* relight_options.c: the command line of `lambent relight`. */
#include "relight_options.h"

#include <math.h>
#include <string.h>

#include "../common/frame_name.h"
#include "../common/option_value.h"
#include "../common/options.h"
#include "../demo/demo_field.h"
#include "../picture/picture.h"
#include "relight_export.h"

#define PLAIN_GROUND 100.0f /* m, default side */
#define EYE_HEIGHT   1.6f   /* m: default camera height over a world's floor */

const char *const relight_filters[FILTERS + 1] = {"cosine", "sh9", "sh16", "sh25", "blur", "blur1", "blur2", NULL};

/* --- parsers for single options ----------------------------------------------------------------------------------- */

static int all_floats(const char *text, float *out, int count)
{
    return option_floats(&text, out, count) && *text == '\0';
}

static int parse_sphere(const char *text, void *at)
{
    relight_options *o = at;
    float v[4];
    if (!all_floats(text, v, 4) || !(v[3] > 0.0f)) {
        return 0;
    }
    o->place.shape = LMB_WORLD_SPHERE;
    o->place.middle = (lmb_vec3){v[0], v[1], v[2]};
    o->place.radius = v[3];
    return o->has_far = 1;
}

static int parse_box(const char *text, void *at)
{
    relight_options *o = at;
    float v[6];
    if (!all_floats(text, v, 6) || !(v[0] < v[3] && v[1] < v[4] && v[2] < v[5])) {
        return 0;
    }
    o->place.shape = LMB_WORLD_BOX;
    o->place.low = (lmb_vec3){v[0], v[1], v[2]};
    o->place.high = (lmb_vec3){v[3], v[4], v[5]};
    return o->has_far = 1;
}

int relight_place(const char *text, lmb_vec3 *out)
{
    return option_vec3(text, out) && fabsf(out->x) <= 1e6f && fabsf(out->y) <= 1e6f && fabsf(out->z) <= 1e6f;
}

static int parse_place(const char *text, void *at) { return relight_place(text, at); }

/* --- the table ---------------------------------------------------------------------------------------------------- */

static const char *const storages[] = {"f32", "log16", "log8", NULL}; /* in the order of LMB_WORLD_ */
static const char *const floors[] = {"auto", "on", "none", NULL};
static const char *const overlaps[] = {"nearer", "mean", NULL};
static const char *const shows[] = {"both", "normal", "glossy", NULL}; /* in the order of LMB_RELIGHT_ */

#define AT(member) .at = offsetof(relight_options, member)
#define COUNTS(member) .counts = offsetof(relight_options, member)

static const option_row world_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("world")},
    {.name = "--world", .value = "FILE|PREFIX", .kind = OPTION_TEXT, AT(world), COUNTS(worlds), .times = RELIGHT_WORLDS,
     .size = sizeof(char *), .file = OPTION_READS,
     .help = HELP("one file: six faces (+x -x +y -y +z -z from the top or the left), or the whole sphere, twice as "
             "wide as high; or six files, PREFIXpx PREFIXnx ... PREFIXnz (.pfm .hdr .png .jpg), of which some may "
             "be missing; or `demo`, a built-in field with its own places. If you give several, the nearer ones "
             "light an object more, by the inverse square of the distance, and the one nearest to the eye is the "
             "background")},
    {.name = "--world-centre", .kind = OPTION_POINT, AT(centre), COUNTS(centres), .times = RELIGHT_WORLDS,
     .size = sizeof(lmb_vec3), .help = HELP("the camera's position (default 0,0,0); for several worlds one each, in "
             "the same order")},
    {.name = "--world-sphere", .value = "X,Y,Z,R", .kind = OPTION_OWN, .parse = parse_sphere,
     .expects = "X,Y,Z,R with R over 0",
     .help = HELP("the distant surroundings lie on this sphere (default: 100 m around the centre)")},
    {.name = "--world-box", .value = "X0,Y0,Z0,X1,Y1,Z1", .kind = OPTION_OWN, .parse = parse_box,
     .expects = "X0,Y0,Z0,X1,Y1,Z1, the smaller ones first",
     .help = HELP("or on the walls of this box; the centre lies inside")},
    {.name = "--ground", .value = "FILE", .kind = OPTION_TEXT, AT(ground), .file = OPTION_READS,
     .help = HELP("the ground from above, right +x, down +z; transparent if not known")},
    {.name = "--ground-size", .value = "W,D", .kind = OPTION_NUMBERS, AT(ground_size), .size = 2, .low = 1e-6,
     .high = 1e30, .expects = "W,D over 0",
     .help = HELP("sides, m (default 100,100)")},
    {.name = "--ground-centre", .value = "X,Z", .kind = OPTION_NUMBERS, AT(ground_centre), .size = 2, .low = -1e30,
     .high = 1e30, COUNTS(has_ground_centre),
     .help = HELP("the picture's middle (default: the world's centre)")},
    {.name = "--ground-height", .value = "H", .kind = OPTION_NUMBER, AT(place.ground_y), .low = -1e30, .high = 1e30,
     .help = HELP("of the ground, m (default 0)")},
    {.name = "--floor", .kind = OPTION_WORD, AT(floor), .words = floors,
     .help = HELP("on: everything below the world's horizon lies flat at --ground-height, and objects stand on it; "
             "none: it lies as far away as the rest; auto (default): on if an object is drawn in a single --world "
             "without --ground, --world-sphere and --world-box. The world's centre is then 1.6 m above the floor by "
             "default")},
    {.name = "--storage", .kind = OPTION_WORD, AT(format), .words = storages,
     .help = HELP("how the world is stored: floats, or log codes of 0 to 100 (default f32)")},
    {.name = "--overlap", .kind = OPTION_WORD, AT(blend), .words = overlaps,
     .help = HELP("if distant world and ground are both visible (default nearer)")},
    {.kind = OPTION_END},
};

static const option_row light_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("light")},
    {.name = "--at", .value = "X,Y,Z", .kind = OPTION_OWN, AT(at), COUNTS(at_count), .times = RELIGHT_PLACES,
     .size = sizeof(lmb_vec3), .parse = parse_place, .expects = "X,Y,Z within 1,000,000 m",
     .help = HELP("the place (default: the world's centre). A place outside the distant world is moved to the "
             "nearest one inside. With --object: one more copy of it each time")},
    {.name = "--filter", .kind = OPTION_WORD, AT(filter), .words = relight_filters,
     .help = HELP("cosine: exact, from 6 x 8 x 8 directions (default); error about 0.5 %;\nsh9, sh16, sh25: "
             "spherical harmonics: 1 %, the same, 0.6 %; may be negative beside sharp lights;\nblur, blur1, blur2: "
             "by rows and columns: 6 %, with one fitted product per row 4 %, with two 1.5 %, in the built-in world. "
             "Beside small lamps and suns all blurs are wrong by 15 to 250 %, and harmonics by 5 %: use cosine "
             "there")},
    {.name = "--cube", .value = "OUT", .kind = OPTION_OWN, AT(cube), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP("W/m2, N wide and 6 N high, faces +x -x +y -y +z -z from the top (.pfm .hdr; .png .ppm to view; "
             "-, ppm:-, pfm:-, hdr:- are standard output)")},
    {.name = "--faces", .value = "N", .kind = OPTION_INT, AT(faces), .low = 1, .high = 64,
     .help = HELP("texels per side of a face (default 8)")},
    {.name = "--map", .value = "OUT", .kind = OPTION_OWN, AT(map), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP("the view from the place, longitude by latitude, north on top; W/(sr m2); file formats as for "
             "--cube")},
#if !defined(OPTIONS_WITHOUT_HELP) /* the web page has no other programs */
    {.name = "--map-height", .value = "H", .kind = OPTION_MULTIPLE_OF_8, AT(map_height), .low = 8, .high = 512,
     .help = HELP("rows; the map is twice as wide (default 64)")},
    {.name = "--azimuth", .value = "DEG", .kind = OPTION_NUMBER, AT(azimuth), .low = -360, .high = 360,
     .help = HELP("the longitude of the map's left edge: -180 (default), -90 or 0; 0 is -z, 90 is +x")},
    {.name = "--vectors", .value = "FILE.pfm", .kind = OPTION_TEXT, AT(vectors_in), .file = OPTION_READS,
     .help = HELP("a transform image: the direction of each pixel of the map")},
    {.name = "--save-vectors", .value = "OUT.pfm", .kind = OPTION_OWN, AT(vectors_out), .file = OPTION_WRITES,
     .parse = picture_option, .expects = PICTURE_OPTION_WANTS, .help = HELP("the transform image of the map")},
#endif
    {.kind = OPTION_END},
};

static const option_row file_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("light for other programs, at one --at")},
#if !defined(OPTIONS_WITHOUT_HELP)
    {.name = "--lobes", .value = "OUT", .kind = OPTION_OWN, AT(lobes), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP("radiance by mirrored direction, GGX: six cubes of roughness 0, 0.2 .. 1 in the layout of --cube, "
             "numbered as light_%01d.hdr or light-0000.hdr; the first is the world as a cube")},
    {.name = "--side", .value = "N", .kind = OPTION_POWER_OF_2, AT(side), .low = 16, .high = 256,
     .help = HELP("texels per side of the first; each further cube has half as many, at least 8 (default 128)")},
    {.name = "--harmonics", .value = "OUT.json", .kind = OPTION_TEXT, AT(harmonics), .file = OPTION_WRITES,
     .help = HELP("nine coefficients of radiance, as a LightProbe of three.js, and of irradiance; the file names "
             "the functions")},
    {.name = "--dfg", .value = "OUT", .kind = OPTION_OWN, AT(dfg), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP("a table of 128 x 128 pixels: in white light a lobe reflects F0 x red + green. Columns: cosine to "
             "the viewer; rows: roughness")},
#endif
    {.kind = OPTION_END},
};

static const option_row object_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("objects")},
    {.name = "--object", .value = "FILE", .kind = OPTION_TEXT, AT(object_of), COUNTS(objects), .times = RELIGHT_OBJECTS,
     .size = sizeof(char *), .file = OPTION_READS,
     .help = HELP(".gltf .glb .obj .ply, or `demo`, a figure: stands with the middle of its box's bottom at --at, "
             "and is lit as at the middle of its box. If you give several, give one --at each, in the same order")},
    OPTION_VERTEX_COLOURS_ROW(relight_options, choice.vertex_colours),
    {.name = "--scale", .value = "M", .kind = OPTION_NUMBER, AT(scale_of), COUNTS(scales), .times = RELIGHT_OBJECTS,
     .size = sizeof(float), .low = 1e-3, .high = 1e5,
     .help = HELP("longest side, m (default: as in the file); for several objects one for all, or one each")},
    {.name = "--roughness", .value = "R", .kind = OPTION_NUMBER, AT(roughness), .low = 0, .high = 1,
     .help = HELP("0: a mirror (default: from glTF's materials, else 0.4)")},
    {.name = "--f0", .value = "F", .kind = OPTION_NUMBER, AT(f0), .low = 0, .high = 1,
     .help = HELP("reflectance of a surface that faces the viewer (default: from the materials, else 0.04)")},
    {.name = "--per-part", .kind = OPTION_FLAG, AT(per_part),
     .help = HELP("lights each part of the object as at the middle of the part's box")},
    {.name = "--contact", .kind = OPTION_FLAG, AT(contact),
     .help = HELP("objects darken the ground below them, themselves and each other, and light them by reflection; "
             "lobes show that. Occlusion is computed once: of an object by itself with rays from each vertex, of "
             "the ground again for another height; then up to 448 lights of the world are used per picture. An "
             "object with over 4,096 vertices is thinned to about as many for this. Default with a --floor")},
    {.name = "--no-contact", .kind = OPTION_FLAG, AT(no_contact), .help = HELP("turns --contact off")},
    {.name = "--light", .kind = OPTION_LIGHT, AT(lights), COUNTS(light_count), .times = RELIGHT_LIGHTS,
     .size = sizeof(lmb_light),
     .help = HELP("a light or sun in addition to the world's light, as in `lambent render`. The world's pictures "
             "show the ground in this light, so objects that block it darken the ground")},
    {.name = "--show", .kind = OPTION_WORD, AT(show), .words = shows,
     .help = HELP("all light, only that by normals, or only reflections (default both)")},
#if !defined(OPTIONS_WITHOUT_HELP) /* the web page draws one picture */
    {.name = "--path", .value = "FILE", .kind = OPTION_TEXT, AT(path), .file = OPTION_READS,
     .help = HELP("places of the object, X,Y,Z per line: a picture each, numbered by OUT's %0Nd, as frame_%04d.png, "
             "or else by -0000, -0001, ... A place may be followed by a new world's file, relative to FILE. That world "
             "holds from this picture on, with the same centre. `lambent capture` makes worlds of a scene")},
    {.name = "--world-every", .value = "N", .kind = OPTION_INT, AT(world_every), .low = 1, .high = 1000000,
     .help = HELP("with --path and a numbered --world, such as sky_%03d.hdr: number of pictures from one file to the "
             "next; the world is blended in between (default 1: a file a picture). The lowest number that exists is "
             "picture 0, a missing number ends the series, and the last file stays")},
    {.name = "--reuse", .value = "M", .kind = OPTION_NUMBER, AT(policy.radius_m), .low = 0, .high = 1e5,
     .help = HELP("an object keeps its light until it is M metres from where it was computed (default 0.15; 0: until "
             "it rests)")},
    {.name = "--every", .value = "N", .kind = OPTION_INT, AT(policy.every), .low = 1, .high = 1 << 20,
     .help = HELP("but for at most N pictures if it moves at all")},
    {.name = "--keep", .value = "X,Y,Z", .kind = OPTION_OWN, AT(keep), COUNTS(keep_count), .times = RELIGHT_PLACES,
     .size = sizeof(lmb_vec3), .parse = parse_place, .expects = "X,Y,Z within 1,000,000 m",
     .help = HELP("a named place: objects within --reuse of it use its light")},
#endif
    {.kind = OPTION_END},
};

static const option_row picture_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("picture")},
    {.name = "-o", .value = "OUT", .kind = OPTION_OWN, AT(out), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP(PICTURE_OPTION_HELP)},
    VIEW_OPTION_SIZE(relight_options, view, "px (default 640x480)"),
    VIEW_OPTIONS_CAMERA(relight_options, view, "the camera's position (default: all objects fit)"),
#if !defined(OPTIONS_WITHOUT_HELP)
    {.name = "--stereo", .value = "METRES", .kind = OPTION_ABOVE, AT(stereo_m), .low = 0.0, .high = 1e6,
     .help = HELP("two eyes this far apart, left | right side by side, each of --size; both use the same light")},
#endif
    {.name = "--samples", .kind = OPTION_WORD, AT(samples), .words = option_samples, .values = option_sample_values,
     .help = HELP("per pixel, averaged (default 4 for .png and .ppm, 1 for .pfm and .hdr)")},
    OPTION_TONE_ROW(relight_options, tone),
    {.name = "--exposure", .value = "EV|auto", .kind = OPTION_OWN, AT(exposure_ev), .parse = option_stops,
     .expects = OPTION_STOPS_WANTS,
     .help = HELP("stops, display formats only (default auto: printed to stderr)")},
    OPTION_BACKEND_ROW(relight_options, kernels),
    OPTION_THREADS_ROW(relight_options, threads, "draw the objects' picture"),
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(relight_options, view.is_quiet, view.is_verbose, "print the time of each stage"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

const option_table relight_table = {
    .verb = "relight",
    .usage = HELP("relight --world WORLD [--at X,Y,Z] --cube OUT [options]\n"
             "relight --world WORLD --object FILE [--at X,Y,Z ...] -o OUT [options]"),
    .about = HELP("Computes the light at a place in a world, from pictures of the world taken elsewhere: irradiance "
             "by normal, as a small cube map. Also draws objects in that light, over the world as background. "
             "Metres, +Y up, linear light."),
    .part = {world_rows, light_rows, file_rows, object_rows, picture_rows},
    .examples = HELP("  lambent relight --world demo --at 4,1,-2 --cube light.pfm\n"
                "  lambent relight --world demo --object demo -o field.png\n"),
};

int relight_has_ground(const relight_options *o) { return o->place.ground != NULL || o->place.has_floor; }

/* --- the whole command line --------------------------------------------------------------------------------------- */

/* Several objects need a place each, and one size or one each. */
static int check_objects(const relight_options *o, report *r)
{
    if (o->scales > 1 && o->scales != o->objects) {
        return report_fail(r, "--object and --scale: %d and %d of them; give one --scale, or each object one",
                           (int)o->objects, (int)o->scales);
    }
    if (o->objects < 2) {
        return 1;
    }
    if (o->path != NULL || o->keep_count > 0) {
        return report_fail(r, "--path and --keep are for one --object");
    }
    return o->at_count == o->objects ||
           report_fail(r, "--object and --at: %d and %d of them; give each object its place", (int)o->objects,
                       (int)o->at_count);
}

static int check_together(const relight_options *o, report *r)
{
    if (!check_objects(o, r)) {
        return 0;
    }
    if (o->worlds == 0) {
        return report_fail(r, "no world given; add --world FILE");
    }
    if (!relight_worlds_check(o, r)) {
        return 0;
    }
    if (o->cube == NULL && !relight_exports(o) && o->out == NULL) {
        return report_fail(r, "no output given; add --cube FILE.pfm, or --object FILE -o FILE.png");
    }
    if ((o->object == NULL) != (o->out == NULL)) {
        return report_fail(r, "--object and -o go together");
    }
    if (o->object == NULL && o->stereo_m > 0.0f) {
        return report_fail(r, "--stereo draws a picture for each eye; add --object FILE -o FILE.png");
    }
    if (o->path != NULL && o->out != NULL && file_is_stdout(o->out)) {
        return report_fail(r, "--path draws a picture a place: give -o a file name");
    }
    if (o->lobes != NULL && file_is_stdout(o->lobes)) {
        return report_fail(r, "--lobes writes six files: give it a file name");
    }
    if (o->path == NULL && o->out != NULL && frame_digits(o->out) > 0) {
        return report_fail(r, "%s: numbers pictures of a --path, and none is given", o->out);
    }
    if (o->path != NULL && (o->object == NULL || o->at_count > 0)) {
        return report_fail(r, "--path moves one --object; leave --at out");
    }
    if ((o->cube != NULL || o->map != NULL) && (o->at_count > 1 || o->path != NULL)) {
        return report_fail(r, "--cube and --map are of one place: give one --at");
    }
    if (relight_exports(o) && (o->at_count > 1 || o->path != NULL)) {
        return report_fail(r, "light for other programs is of one place: give one --at");
    }
    return relight_export_check(o, r) && view_options_check(&o->view, r);
}

/* Sets the options that follow from others. */
static void complete(relight_options *o)
{
    lmb_world_pictures *p = &o->place;
    const int floor_fits = o->object != NULL && o->ground == NULL && !o->has_far && o->worlds == 1;
    p->has_floor = o->floor == FLOOR_ON ||
                   (o->floor == FLOOR_AUTO && floor_fits && (o->centres == 0 || p->centre.y > p->ground_y));
    if (p->has_floor && o->centres == 0 && !o->has_far) {
        p->centre.y = p->ground_y + EYE_HEIGHT;
    }
    o->contact = (o->contact || p->has_floor) && !o->no_contact;
    o->centre[0] = p->centre; /* the built-in world has a fixed centre */
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
    if (o->at_count == 0 && o->path == NULL && o->objects < 2) {
        o->at[0] = p->centre;
        o->at[0].y = o->object != NULL && (o->ground != NULL || p->has_floor) ? p->ground_y : p->centre.y;
        o->at_count = 1;
    }
}

/* Sets the places of the built-in world's pictures, and the defaults: several figures and a camera. */
static int demo_options(relight_options *o, report *r)
{
    static const lmb_vec3 places[] = {{-9.8f, 0, -2.5f}, {-8.4f, 0, -0.2f}, {-3.7f, 0, 2.4f}, {-0.9f, 0, -4.5f},
                                      {0.5f, 0, 4.1f}, {3.4f, 0, 0.4f}, {8.2f, 0, -0.8f}, {9.9f, 0, -3.0f}};
    if (o->has_far || o->has_ground_centre || o->centres > 0 || o->place.ground_y != 0.0f ||
        o->ground_size[0] != PLAIN_GROUND || o->ground_size[1] != PLAIN_GROUND) {
        return report_fail(r, "--world demo lies where it lies: leave out --world-centre, --world-sphere, --world-box, "
                              "--ground-size, --ground-centre and --ground-height");
    }
    demo_field_place(&o->place, o->ground_size);
    o->has_far = o->has_ground_centre = 1;
    o->ground_centre[0] = o->ground_centre[1] = 0.0f;
    if (o->object != NULL && strcmp(o->object, "demo") == 0 && o->objects == 1 && o->at_count == 0 && o->path == NULL) {
        memcpy(o->at, places, sizeof places);
        o->at_count = (int32_t)(sizeof places / sizeof *places);
        if (!o->view.has_eye && !o->view.has_target) {
            o->view.has_eye = o->view.has_target = 1;
            o->view.eye = (lmb_vec3){0.0f, 2.3f, 8.4f};
            o->view.target = (lmb_vec3){0.0f, 0.9f, 0.0f};
            o->view.fov_deg = 58.0f;
        }
    }
    return 1;
}

int relight_options_parse(relight_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    o->faces = 8;
    o->map_height = RELIGHT_HEIGHT;
    o->azimuth = -180.0f;
    o->side = 128;
    o->ground_size[0] = o->ground_size[1] = PLAIN_GROUND;
    o->roughness = o->f0 = -1.0f;
    o->policy.radius_m = LMB_PROBE_RADIUS;
    o->exposure_ev = NAN;
    o->kernels = lmb_kernels_pick();
    view_options_init(&o->view);
    const int asked = options_parse(o, &relight_table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    o->place.centre = o->centre[0];
    o->object = o->objects > 0 ? o->object_of[0] : NULL;
    if (o->worlds == 1 && strcmp(o->world[0], "demo") == 0 && !demo_options(o, r)) {
        return OPTIONS_BAD;
    }
    if (o->contact && o->no_contact) {
        report_fail(r, "--contact and --no-contact exclude each other");
        return OPTIONS_BAD;
    }
    complete(o);
    return check_together(o, r) ? OPTIONS_RUN : OPTIONS_BAD;
}
