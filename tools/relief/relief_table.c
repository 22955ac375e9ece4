/* relief_table.c: the options of `lambent relief render`, and options that exclude each other. */
#include <math.h>
#include <string.h>

#include "../common/option_value.h"
#include "../picture/picture.h"
#include "../render/background.h"
#include "relief_options.h"
#include "relief_path.h"

#define AMBIENT 0.3f /* W/m2 */
enum { NO_PLANE = -1 }; /* --show is not given */

static const char *const picks[] = {"p", "eye-ray", NULL}; /* in the order of LMB_RELIEF_ */
static const char *const samplings[] = {"bilinear", "nearest", NULL};
static const char *const shows[] = {"full", "depth", "normal", "albedo", "lit", NULL}; /* in the order of PLANE_ */

static const char *const grounds[] = {"auto", "none", NULL};
static const int32_t ground_values[] = {0, 1};

#define AT(member) .at = offsetof(relief_options, member)

static const option_row rows[] = {
    {.name = "FILE.lmr", .kind = OPTION_TEXT, .value = "", AT(file), .file = OPTION_READS,
     .help = HELP("made by `lambent relief bake`")},
    {.name = "--crowd", .value = "LIST", .kind = OPTION_TEXT, AT(crowd), .file = OPTION_READS,
     .help = HELP("many reliefs in one picture, in place of FILE.lmr: a list of placements, one per line, each "
             "FILE.lmr X Y Z [TURN [SCALE]]. TURN is in degrees about +y; names are relative to the list and have no "
             "spaces; # begins a comment. At most 1,000,000 placements of 1,000 files. The time grows with the pixels "
             "that placements cover and with their triangles: bake small ones with --size 64 --triangles 500. A ground "
             "and --bounce take time for all triangles")},
    {.kind = OPTION_TITLE, .help = HELP("view")},
    VIEW_OPTION_SIZE(relief_options, view, "px (default 640x480)"),
    VIEW_OPTIONS_CAMERA(relief_options, view, "the camera's position (default: the whole model from slightly above)"),
    {.name = "--photo", .value = "PREFIX", .kind = OPTION_TEXT, AT(photo),
     .help = HELP("draws from the place of a photo as in `relief bake --frame`, in the photo's size and without light, "
             "and prints how far the picture is from it (PSNR) and how many pixels the simple model fills. Use a photo "
             "that the relief was not made of")},
    {.kind = OPTION_TITLE, .help = HELP("surface")},
    {.name = "--pick", .kind = OPTION_WORD, AT(how.pick), .words = picks,
     .help = HELP("the winning candidate: nearest to the simple surface (default), or to the eye's ray")},
    {.name = "--sampling", .kind = OPTION_WORD, AT(how.sampling), .words = samplings,
     .help = HELP("of the views' texels (default bilinear)")},
    RELIEF_OPTIONS_LOOK(relief_options),
    {.kind = OPTION_TITLE, .help = HELP("light")},
    {.name = "--light", .kind = OPTION_LIGHT, AT(light), .counts = offsetof(relief_options, has_light),
     .help = HELP("KIND is spot, point or sun (default: a sun from the upper right)")},
    {.name = "--shadow-map", .value = "N", .kind = OPTION_MULTIPLE_OF_8, AT(shadow_map), .low = 0, .high = LMB_MAX_SIDE,
     .help = HELP("texels per side of the light's shadow map, at most (default 1024); the relief's map has at most the "
             "texels that its views show, and at most two per pixel. 0: no shadows")},
    {.name = "--ambient", .value = "E", .kind = OPTION_NUMBER, AT(ambient), .low = 0, .high = 1e6,
     .help = HELP("irradiance from everywhere, W/m2 (default 0.3, with a --world 0)")},
    {.name = "--world", .value = "FILE|sky|none", .kind = OPTION_TEXT, AT(world),
     .help = HELP("surroundings that light the picture and are visible behind it: a clear sky with a sun, or an "
             "environment map as in `lambent render` (default none). The world's sun replaces the default one. The "
             "scene of --with and the ground have contact shadows of the sky's light, the relief itself has none")},
    {.name = "--ground", .kind = OPTION_WORD, AT(no_ground), .words = grounds, .values = ground_values,
     .help = HELP("auto (default): with a --world, put a grey disc below the relief, unless there is a --with or the "
             "--background is a colour or transparent")},
    {.name = "--background", .value = "RRGGBB|world|transparent", .kind = OPTION_OWN, AT(background),
     .parse = render_option_background, .expects = RENDER_BACKGROUND_WANTS,
     .help = HELP("shown where there is no surface: a colour, the world (default; black if there is none), or "
             "transparent, for a PNG with alpha")},
    {.name = "--with", .value = "SCENE", .kind = OPTION_TEXT, AT(with), .file = OPTION_READS,
     .help = HELP("other geometry in the same picture: both shadow and hide each other")},
    OPTION_VERTEX_COLOURS_ROW(relief_options, choice.vertex_colours),
    {.name = "--bounce", .kind = OPTION_FLAG, AT(bounce),
     .help = HELP("adds light reflected once by the other geometry and the simple model")},
    {.kind = OPTION_TITLE, .help = HELP("output")},
    {.name = "-o", .value = "OUT", .kind = OPTION_OWN, AT(out), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP(PICTURE_OPTION_HELP)},
    {.name = "--show", .kind = OPTION_WORD, AT(show), .words = shows,
     .help = HELP("(default full; with --photo albedo)")},
    {.name = "--samples", .kind = OPTION_WORD, AT(samples), .words = option_samples, .values = option_sample_values,
     .help = HELP("per pixel, of the light (default 4 for .png and .ppm, 1 for .pfm and .hdr; with --compare 1)")},
    {.name = "--exposure", .value = "EV|auto", .kind = OPTION_OWN, AT(exposure_ev), .parse = option_stops,
     .expects = OPTION_STOPS_WANTS,
     .help = HELP("stops, display formats only (default 0)")},
    {.name = "--compare", .value = "MODEL", .kind = OPTION_TEXT, AT(compare), .file = OPTION_READS,
     .help = HELP("also draws the complex model, and prints speed and errors side by side")},
    OPTION_BACKEND_ROW(relief_options, kernels),
    OPTION_THREADS_ROW(relief_options, threads, "draw the picture"),
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(relief_options, view.is_quiet, view.is_verbose, "print the time of each stage"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

const option_table relief_table = {
    .verb = "relief render",
    .usage = HELP("relief render FILE.lmr [--path FILE] -o OUT [options]\n"
                  "relief render --crowd LIST [--path FILE] -o OUT [options]"),
    .about = HELP("Draws a complex model as a few triangles that carry its surface, silhouette, depth and shadow, "
             "by views of it."),
    .part = {rows, relief_path_rows},
    .examples = HELP("  a tent, its relief and a picture of that:\n" RELIEF_TENT
                "    lambent relief render tent.lmr --size 160x120 -o tent.png\n"),
};

int relief_has_world(const relief_options *o) { return o->world != NULL && strcmp(o->world, "none") != 0; }

static int background_fits(const relief_options *o, report *r)
{
    const int format = picture_format(o->out);
    if (o->background.kind != BACKGROUND_WORLD && o->show != PLANE_FULL) {
        return report_fail(r, "--background: only pictures of light have one; use --show full");
    }
    if (o->background.kind == BACKGROUND_TRANSPARENT && format != PICTURE_PNG) {
        return report_fail(r, "--background transparent: only PNG has alpha; name a .png");
    }
    return o->background.kind != BACKGROUND_COLOUR || !picture_is_linear(format) ||
           report_fail(r, "--background: a colour needs a display format; name a .png or a .ppm");
}

/* --photo leaves nothing of the camera and the light to choose. The web page reads no photos. */
static int photo_fits(const relief_options *o, report *r)
{
#if defined(OPTIONS_WITHOUT_HELP)
    return (void)o, (void)r, 1;
#else
    view_options usual;
    view_options_init(&usual);
    const int sees = o->view.has_eye || o->view.has_target || o->view.width > 0 || o->view.near_m > 0.0f ||
                     o->view.fov_deg != usual.fov_deg || o->view.up.x != usual.up.x || o->view.up.y != usual.up.y ||
                     o->view.up.z != usual.up.z;
    if (sees || o->path != NULL || o->compare != NULL) {
        return report_fail(r, "--photo sets camera and size: leave --eye, --target, --up, --fov, --near, --size, "
                           "--path and --compare out");
    }
    if (o->has_light || relief_has_world(o) || o->bounce || o->samples != 0 || o->show == PLANE_FULL ||
        o->show == PLANE_LIT) {
        return report_fail(r, "--photo draws without light: leave --light, --world, --bounce, --samples, --show full "
                           "and --show lit out");
    }
    return o->background.kind == BACKGROUND_WORLD ||
           report_fail(r, "--photo has no background: leave --background out");
#endif
}

int relief_options_parse(relief_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    view_options_init(&o->view);
    o->shadow_map = 1024;
    o->show = NO_PLANE;
    o->ambient = NAN;
    o->kernels = lmb_kernels_pick();
    const int asked = options_parse(o, &relief_table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    if (o->file == NULL && o->crowd == NULL) {
        return report_fail(r, "no relief given; lambent relief bake makes one");
    }
    if (o->crowd != NULL && (o->file != NULL || o->compare != NULL)) {
        return report_fail(r, "--crowd names the reliefs to draw: leave %s out",
                           o->file != NULL ? o->file : "--compare");
    }
    if (o->compare != NULL && o->with != NULL) {
        return report_fail(r, "--compare draws only the complex model: leave --with out");
    }
    if (o->out == NULL) {
        return report_fail(r, "no output given; add -o FILE.png");
    }
    if (relief_has_world(o) && o->compare != NULL) {
        return report_fail(r, "--compare needs a single light: leave --world out");
    }
    if (o->photo != NULL && !photo_fits(o, r)) {
        return OPTIONS_BAD;
    }
    if (o->show == NO_PLANE) {
        o->show = o->photo != NULL ? PLANE_ALBEDO : PLANE_FULL;
    }
    if (isnan(o->ambient)) {
        o->ambient = relief_has_world(o) ? 0.0f : AMBIENT;
    }
    if (!background_fits(o, r)) {
        return OPTIONS_BAD;
    }
    return relief_path_check(o, r) && view_options_check(&o->view, r) ? OPTIONS_RUN : OPTIONS_BAD;
}
