/* capture_options.c: the command line of `lambent capture`: what `render` has of light, and places. */
#include "capture_options.h"

#include <string.h>

#include "../common/frame_name.h"
#include "../common/option_value.h"
#include "../common/options.h"
#include "../picture/picture.h"

#define LINEAR_WANTS "a file name ending in .hdr or .pfm, or hdr:- or pfm:- for standard output"

static int parse_linear(const char *text, void *at)
{
    return picture_option(text, at) && picture_is_linear(picture_format(text));
}

#define AT(member) .at = offsetof(capture_options, member)
#define COUNTS(member) .counts = offsetof(capture_options, member)

static const option_row place_rows[] = {
    {.name = "--at", .kind = OPTION_POINT, AT(at), COUNTS(at_count), .times = CAPTURE_PLACES, .size = sizeof(lmb_vec3),
     .help = "where the cube is taken; several places make a cube each"},
    {.name = "-o", .value = "OUT", .kind = OPTION_OWN, AT(render.out), .file = OPTION_WRITES, .parse = parse_linear,
     .expects = LINEAR_WANTS,
     .help = "the cube: faces +x -x +y -y +z -z from the top, W/(sr m2) (.hdr .pfm; hdr:-, pfm:- are standard output); "
             "of several places a name with one %0Nd, as world_%02d.hdr"},
    {.name = "--faces", .value = "N", .kind = OPTION_INT, AT(faces), .low = 8, .high = 1024,
     .help = "pixels of a face's side, and of the ground's picture (default 256)"},
    {.kind = OPTION_TITLE, .help = "ground"},
    {.name = "--ground", .value = "OUT", .kind = OPTION_OWN, AT(ground), .file = OPTION_WRITES, .parse = parse_linear,
     .expects = LINEAR_WANTS,
     .help = "the ground from above, right +x, down +z, without what stands on it: a cut at a twentieth of the first "
             "place's height over it; black where nothing is (.hdr .pfm)"},
    {.name = "--ground-size", .value = "W,D", .kind = OPTION_NUMBERS, AT(ground_size), COUNTS(has_ground_size),
     .size = 2, .low = 1e-6, .high = 1e6, .expects = "W,D over 0", .help = "its sides, m (default: the scene's)"},
    {.name = "--ground-centre", .value = "X,Z", .kind = OPTION_NUMBERS, AT(ground_centre), COUNTS(has_ground_centre),
     .size = 2, .low = -1e6, .high = 1e6, .help = "the picture's middle (default: the scene's)"},
    {.name = "--ground-height", .value = "H", .kind = OPTION_NUMBER, AT(ground_y), COUNTS(has_ground_y), .low = -1e6,
     .high = 1e6, .help = "of the ground, m (default: the scene's lowest point)"},
    {.kind = OPTION_TITLE, .help = "scene"},
    {.name = "--scene", .value = "NAME|N", .kind = OPTION_TEXT, AT(render.choice.scene),
     .help = "of a file with several scenes (default: its own choice)"},
    OPTION_VERTEX_COLOURS_ROW(capture_options, render.choice.vertex_colours),
    {.name = "--world", .value = "FILE|sky|none", .kind = OPTION_TEXT, AT(render.world),
     .help = "what lies around the scene, as in `lambent render`"},
    {.kind = OPTION_END},
};

static const option_row other_rows[] = {
    {.kind = OPTION_TITLE, .help = "other"},
    {.name = "--samples", .kind = OPTION_WORD, AT(render.samples), .words = option_samples,
     .values = option_sample_values, .help = "a pixel; their mean is kept (default 4)"},
    {.name = "--glossy", .kind = OPTION_FLAG, AT(render.glossy), .help = "glTF's materials with their lobes"},
    OPTION_BACKEND_ROW(capture_options, render.kernels),
    OPTION_THREADS_ROW(capture_options, render.threads, "draw the faces"),
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(capture_options, render.view.is_quiet, render.view.is_verbose, "say how long what took"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

const option_table capture_table = {
    .verb = "capture",
    .usage = "capture SCENE --at X,Y,Z -o WORLD [--ground OUT] [options]",
    .about = "What a place of a scene sees, with bounced light, as the world of `lambent relight`: a cube, and the "
             "ground from above. Objects are then lit anywhere near by without the scene. Light that comes straight "
             "from spots, points and suns is in no picture: give it to relight as --light. What relight needs to know "
             "of the places is printed as its options.",
    .part = {render_scene_rows, place_rows, render_light_rows, render_bounce_rows, render_group_rows, other_rows},
    .examples = "  lambent capture demo --at 0.5,1,0.5 --faces 32 -o world.hdr --ground ground.hdr\n"
                "  several places, between which relight blends:\n"
                "    lambent capture demo --at 0.3,1,0.5 --at 1.2,1,0.5 --faces 32 -o world_%02d.hdr\n",
};

static int check_together(const capture_options *o, report *r)
{
    if (o->render.scene == NULL) {
        return report_fail(r, "no scene given; try: lambent capture demo --at 0.5,1,0.5 -o world.hdr");
    }
    if (o->at_count == 0 || o->render.out == NULL) {
        return report_fail(r, o->at_count == 0 ? "no place given; add --at X,Y,Z"
                                               : "no output given; add -o WORLD.hdr (or .pfm)");
    }
    if ((o->at_count > 1) != (frame_digits(o->render.out) > 0)) {
        return report_fail(r,
                           o->at_count > 1
                               ? "%s: several places make a cube each: a name with one %%0Nd, as world_%%02d.hdr"
                               : "%s: numbers cubes of several places, and one --at is given",
                           o->render.out);
    }
    return o->ground != NULL || !(o->has_ground_size || o->has_ground_centre || o->has_ground_y) ||
           report_fail(r, "--ground-size, --ground-centre and --ground-height are of a --ground");
}

int capture_options_parse(capture_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    render_options_begin(&o->render);
    o->faces = 256;
    o->render.samples = 4;
    o->render.has_sky = 1;
    const int asked = options_parse(o, &capture_table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    return check_together(o, r) && render_options_complete(&o->render, r) ? OPTIONS_RUN : OPTIONS_BAD;
}
