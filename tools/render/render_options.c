/* render_options.c: the command lines of `lambent render` and `lambent plan`; `lambent play` shares most of the
 * rows. */
#include "render_options.h"

#include <math.h>
#include <string.h>

#include "../common/option_value.h"
#include "../common/options.h"
#include "../picture/picture.h"
#include "light_stream.h"

enum { CHOSEN = -1 }; /* from other options */

/* --- values of their own kinds ------------------------------------------------------------------------------------ */

/* Rounds up to a power of 4, as the library requires. */
static int parse_elements(const char *text, void *at)
{
    int32_t wanted, *elements = at;
    if (!option_int(text, 64, 1 << 24, &wanted)) {
        return 0;
    }
    for (*elements = 64; *elements < wanted; *elements *= 4) {
    }
    return 1;
}

/* Two digits of a colour, or -1. */
static int hex_byte(const char *at)
{
    int value = 0;
    for (int i = 0; i < 2; ++i) {
        const char c = at[i];
        const int digit = c >= '0' && c <= '9'   ? c - '0'
                          : c >= 'a' && c <= 'f' ? c - 'a' + 10
                          : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                 : -1;
        if (digit < 0) {
            return -1;
        }
        value = 16 * value + digit;
    }
    return value;
}

int render_option_background(const char *text, void *at)
{
    render_background *b = at;
    memset(b, 0, sizeof *b);
    if (strcmp(text, "world") == 0) {
        return 1;
    }
    if (strcmp(text, "transparent") == 0) {
        b->kind = BACKGROUND_TRANSPARENT;
        return 1;
    }
    b->kind = BACKGROUND_COLOUR;
    text += *text == '#';
    int ok = strlen(text) == 6;
    for (int c = 0; c < 3 && ok; ++c) {
        const int value = hex_byte(text + 2 * c);
        b->rgb[c] = (uint8_t)value;
        ok = value >= 0;
    }
    return ok;
}

/* --- the tables --------------------------------------------------------------------------------------------------- */

static const char *const qualities[] = {"draft", "default", "best", NULL};
static const int32_t quality_values[] = {LMB_QUALITY_DRAFT, LMB_QUALITY_DEFAULT, LMB_QUALITY_BEST};
static const char *const rests[] = {"estimate", "none", NULL};
static const char *const occlusions[] = {"exact", "none", "view", "view-world", NULL};
static const int32_t occlusion_values[] = {LMB_OCCLUSION_EXACT, LMB_OCCLUSION_NONE, LMB_OCCLUSION_VIEW,
                                           LMB_OCCLUSION_VIEW_WORLD};
static const char *const gathers[] = {"full", "live", NULL};
static const int32_t gather_values[] = {1, LMB_GATHER_LIVE};
static const char *const gone_gathers[] = {"half",     "live, or full for less error", "quarter", "live",
                                           "adaptive", "live, or full for less error", NULL};
static const char *const shows[] = {"full",           "direct", "indirect", "irradiance", "depth", "eye-distance",
                                    "normal",         "albedo", "light-distance", "points", "groups", "occlusion",
                                    "wireframe",      NULL};
static const int32_t show_values[] = {LMB_SHOW_FULL, LMB_SHOW_DIRECT,     LMB_SHOW_INDIRECT,   LMB_SHOW_IRRADIANCE,
                                      SHOW_DEPTH,    SHOW_EYE_DISTANCE,   SHOW_NORMAL,         SHOW_ALBEDO,
                                      SHOW_LIGHT_DISTANCE, SHOW_POINTS,   SHOW_GROUPS,         SHOW_OCCLUSION,
                                      SHOW_WIREFRAME};

#define AT(member) .at = offsetof(render_options, member)

const option_row render_scene_rows[] = {
    {.name = "SCENE", .kind = OPTION_TEXT, .value = "", AT(scene), .file = OPTION_READS,
     .help = HELP(".gltf, .glb, .obj, .ply, .lmp, or `demo`, a built-in room")},
    {.kind = OPTION_END},
};

#if !defined(OPTIONS_WITHOUT_HELP)
static int parse_wireframe(const char *text, void *at)
{
    (void)text;
    *(int32_t *)at = SHOW_WIREFRAME;
    return 1;
}
#endif

#if !defined(OPTIONS_WITHOUT_HELP)
static const char *const blends[] = {"pattern", "sorted", NULL};
static const int32_t blend_values[] = {0, 1};
#endif

static const option_row output_rows[] = {
    {.name = "-o", .value = "OUT", .kind = OPTION_OWN, AT(out), .file = OPTION_WRITES, .parse = picture_option,
     .expects = PICTURE_OPTION_WANTS,
     .help = HELP("the picture: " PICTURE_OPTION_HELP)},
#if !defined(OPTIONS_WITHOUT_HELP) /* the web page has neither slices nor draw.h */
    OPTION_SLICE_ROW(render_options, slice, "picture, in bands of eight rows"),
    {.name = "--wireframe", .kind = OPTION_FLAG, AT(show), .parse = parse_wireframe,
     .help = HELP("the edges of triangles that no surface hides, white on black; short for --show wireframe")},
    {.name = "--blend", .kind = OPTION_WORD, AT(sorted), .words = blends, .values = blend_values,
     .help = HELP("how BLEND materials mix: pattern (default): each layer covers alpha's share of a pixel's samples; "
                  "sorted: each sample mixes its layers from back to front, up to 32 of them; takes about a frame's "
                  "time for each layer and sample, in the pixels that show layers")},
#endif
    {.kind = OPTION_END},
};

const option_row render_view_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("view")},
    VIEW_OPTION_SIZE(render_options, view,
                     "picture size, px (default: height 480, width from the camera's aspect ratio, or from the "
                     "scene's shape if it has no camera)"),
    {.name = "--scene", .value = "NAME|N", .kind = OPTION_TEXT, AT(choice.scene),
     .help = HELP("scene to load from a file with several (default: the file's default scene)")},
    OPTION_VERTEX_COLOURS_ROW(render_options, choice.vertex_colours),
    {.name = "--camera", .value = "NAME|N", .kind = OPTION_TEXT, AT(camera),
     .help = HELP("camera of the scene, by name or number from 0 (default 0)")},
    VIEW_OPTIONS_CAMERA(render_options, view, "position of your own camera; give --target too"),
    {.kind = OPTION_END},
};

static const char *const grounds[] = {"auto", "none", NULL};
static const int32_t ground_values[] = {0, 1};

const option_row render_world_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("world")},
    {.name = "--world", .value = "FILE|sky|none", .kind = OPTION_TEXT, AT(world),
     .help = HELP("surroundings that light the scene and are visible behind it: a clear sky with a sun, or an "
                  "environment map (.hdr, .pfm, .png, .jpg; twice as wide as high, or cube faces) (default: sky if "
                  "the scene has no light of its own, else none)")},
    {.name = "--ground", .kind = OPTION_WORD, AT(no_ground), .words = grounds, .values = ground_values,
     .help = HELP("auto: put a grey ground below a scene without lights and without a floor (default), unless "
                  "--background is a colour or transparent; with an environment map it is a round disc four times "
                  "as wide as the scene. With --transfer there is none, because a bake has no ground")},
    {.name = "--background", .value = "RRGGBB|world|transparent", .kind = OPTION_OWN, AT(background),
     .parse = render_option_background, .expects = RENDER_BACKGROUND_WANTS,
     .help = HELP("shown where there is no surface: a colour, the world (default; black if there is none), or "
                  "transparent, for a PNG with alpha")},
    {.kind = OPTION_END},
};

static const option_row stereo_rows[] = {
    {.name = "--stereo", .value = "METRES", .kind = OPTION_ABOVE, AT(stereo_m), .low = 0.0, .high = 1e6,
     .help = HELP("two eyes this far apart, left | right side by side, each of --size; both use the same light")},
    {.kind = OPTION_END},
};

const option_row render_light_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("light")},
    {.name = "--light", .kind = OPTION_LIGHT, AT(lights), .counts = offsetof(render_options, light_count),
     .times = RENDER_LIGHTS, .size = sizeof(lmb_light), .sizes = offsetof(render_options, light_size),
     .help = HELP("replaces the scene's lights; repeat it to add lights. KIND is spot, point or sun; position in "
                  "metres, direction of travel; W/sr, for a sun W/m2; half angles of a spot in degrees (default "
                  "0,45); SIZE: width in m, for a sun degrees: soft shadows, made with 64 lights")},
    {.name = "--shadow-map", .value = "N", .kind = OPTION_MULTIPLE_OF_8, AT(shadow_map), .low = 8, .high = 4096,
     .help = HELP("texels per side of a shadow map (default 1024, less for many lights)")},
    {.kind = OPTION_TITLE, .help = HELP("many lights")},
    {.name = "--many-lights", .value = "CELLS", .kind = OPTION_INT, AT(many_lights_cells), .low = 1, .high = 1 << 22,
     .help = HELP("cluster the lights into at most CELLS cells; every 8x8 pixels select nodes of a tree over the "
                  "cells, and shadows test every triangle. --elements are lit in the same way and bounce the light. "
                  "Millions of lights need no more memory than thousands. Used by default, with 16384 cells, if "
                  "there are more than 128 lights, or more than 32 that bounce by cuts")},
    {.name = "--light-error", .value = "E", .kind = OPTION_NUMBER, AT(light_error), .low = 1e-6, .high = 1,
     .help = HELP("share of a pixel's light that one node of that tree may be wrong by (default 0.02; 0.01 if "
                  "the tree has only the light of a sky)")},
    {.kind = OPTION_END},
};

const option_row render_bounce_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("bounce")},
    {.name = "--quality", .kind = OPTION_WORD, AT(quality), .words = qualities, .values = quality_values,
     .help = HELP("sets --tree, --error and --visibility if you do not; see README for the error and time of each")},
    {.name = "--transfer", .value = "FILE.lmt", .kind = OPTION_TEXT, AT(transfer), .file = OPTION_READS,
     .help = HELP("bounced light from a file that `lambent bake` made for this scene, or from a .lmp that contains "
                  "it; one bounce, or as many as --bounces")},
    {.name = "--tree", .value = "N", .kind = OPTION_POWER_OF_2, AT(tree), .low = 8, .high = 4096,
     .help = HELP("first points per side of a shadow map, at most an eighth of --shadow-map")},
    {.name = "--error", .value = "E", .kind = OPTION_NUMBER, AT(error), .low = 1e-4, .high = 10,
     .help = HELP("largest relative error of a pixel's bounced light, ignoring occlusion")},
    {.name = "--error-bound", .value = "E", .kind = OPTION_NUMBER, AT(error), .low = 1e-4, .high = 10,
     .counts = offsetof(render_options, conservative),
     .help = HELP("like --error, but a proven bound for each pixel: takes many times as long (one bounce; with "
                  "--occlusion none it also holds if a pixel needs every texel)")},
    {.name = "--visibility", .value = "V", .kind = OPTION_NUMBER, AT(visibility), .low = 1e-4, .high = 10,
     .help = HELP("largest share of a pixel's bounced light that one visibility test decides")},
    {.name = "--bounces", .value = "N", .kind = OPTION_INT, AT(bounces), .low = 1, .high = 64,
     .help = HELP("number of bounces (default 1); more than 1 need --group method=cut. Light that reaches a surface "
                  "directly from an emitter is no bounce and always counts")},
    {.name = "--rest", .kind = OPTION_WORD, AT(truncated), .words = rests,
     .help = HELP("with --bounces over 1, light of further bounces: estimated from the decrease of the last ones "
                  "(default), or left out")},
    {.name = "--elements", .value = "N", .kind = OPTION_OWN, AT(elements), .parse = parse_elements,
     .expects = "a number, 64 .. 16777216",
     .help = HELP("surface elements that bounce light again, or emit it (a power of 4; default 16384, with "
                  "--bounces over 1 65536)")},
    {.name = "--occlusion", .kind = OPTION_WORD, AT(occlusion), .words = occlusions, .values = occlusion_values,
     .help = HELP("occlusion between lit points and pixels: test every triangle (default of cut); none; or, for "
                  "fixed groups, march the viewer's depth map in map space or in world space (their default: view), "
                  "which misses geometry that is off screen or hidden")},
    {.name = "--gather", .kind = OPTION_WORD, AT(gather_step), .words = gathers, .values = gather_values,
     .gone = gone_gathers,
     .help = HELP("full: every pixel; live: every 16th pixel each way, by 64 segments each (draft: 32), denser if the "
                  "light needs it, and interpolated if surface and light are continuous: the fastest, for moving "
                  "light. Default: full; from 65,536 pixels on, except with best: live for --quality draft, for "
                  "`play`, under a sky and for many lights, unless you give --error, --visibility, --tree or a "
                  "budget")},
#if LMB_LIVE
    {.name = "--steady", .kind = OPTION_FLAG, AT(is_steady),
     .help = HELP("--gather live whose bounced light flickers less while lights or the camera move, for about half as "
                  "much time again; more error out of doors")},
#endif
    {.kind = OPTION_END},
};

const option_row render_picture_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("picture")},
    {.name = "--glossy", .kind = OPTION_FLAG, AT(glossy),
     .help = HELP("draw highlights and reflections of glTF materials, from metallic, roughness and base colour "
                  "(metallic-roughness maps by texel): for lights with maps, and for bounced light with --group "
                  "method=cut or --transfer. Otherwise, and in OBJ, PLY and `demo`, materials are Lambertian")},
    {.name = "--show", .kind = OPTION_WORD, AT(show), .words = shows, .values = show_values,
     .help = HELP("light, the only choices of `play` and `plan` (default full; irradiance: bounced, before "
                  "albedo);\ndepth, eye-distance, normal, albedo: attributes of the view; metres along the view "
                  "axis, and from the eye;\nlight-distance, points, groups: shadow maps in map resolution, a row of "
                  "faces per light: metres from the light; exitance of first points, W/m2 (discs, if you give "
                  "--group join or thin); number of the group that owns a texel, 0 dark, -1 dropped;\nocclusion: the "
                  "share of bounced light that --occlusion blocks;\nwireframe: edges of triangles.\nDisplay formats "
                  "scale distances, near is bright, and give each group a colour")},
    {.name = "--samples", .kind = OPTION_WORD, AT(samples), .words = option_samples, .values = option_sample_values,
     .help = HELP("samples per pixel for edges and direct light; bounced light is gathered once per visible surface "
                  "(default 4 for .png and .ppm, 1 for .pfm and .hdr; --show modes without light use 1)")},
    OPTION_TONE_ROW(render_options, tone),
    {.name = "--exposure", .value = "EV|auto", .kind = OPTION_OWN, AT(exposure_ev), .parse = option_stops,
     .expects = OPTION_STOPS_WANTS,
     .help = HELP("stops, display formats only (default auto: from the light that surfaces reflect, printed on "
                  "stderr). .pfm and .hdr stay linear")},
    {.kind = OPTION_END},
};

const option_row render_other_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("other")},
    OPTION_BACKEND_ROW(render_options, kernels),
    OPTION_THREADS_ROW(render_options, threads, "draw the picture"),
#if !defined(OPTIONS_WITHOUT_HELP) /* the web page writes no files */
    {.name = "--stats", .value = "FILE.json", .kind = OPTION_TEXT, AT(stats), .file = OPTION_WRITES,
     .help = HELP("write time per stage, counts, and bytes: of memory for drawing (bytes), of the model (model_bytes), "
                  "and of the model while it is read (loading_bytes)")},
#endif
    OPTION_ONLY_HERE,
    OPTION_LOUDNESS(render_options, view.is_quiet, view.is_verbose,
                    "print the settings, and the time of each stage"),
    OPTION_ASK,
    {.kind = OPTION_END},
};

static const option_row json_rows[] = {
    {.kind = OPTION_TITLE, .help = HELP("plan")},
    {.name = "--json", .kind = OPTION_FLAG, AT(json),
     .help = HELP("print everything as JSON, with the bytes of the stages (bytes), and those together with the state "
                  "and the scratch of further threads (memory)")},
    {.kind = OPTION_END},
};

#if defined(OPTIONS_WITHOUT_HELP) /* the web page has its own sliders instead */
#define KEY_ROWS
#else
#define KEY_ROWS render_group_rows, render_budget_rows,
#endif

const option_table render_table = {
    .verb = "render",
    .usage = HELP("render SCENE -o OUT [options]"),
    .about = HELP("Draws a scene with bounced light."),
    .part = {render_scene_rows, output_rows, render_view_rows, stereo_rows, render_world_rows,
             render_light_rows, render_bounce_rows, KEY_ROWS render_picture_rows, render_other_rows},
    .examples = HELP("  lambent render demo --size 320x240 -o demo.png\n"
                "  lambent render demo --size 160x120 --show indirect -o light.pfm\n"
                "  lambent render demo --size 160x120 --eye 0.5,1.25,2.5 --target 0.5,1,-1 \\\n"
                "      --light point:0,1.5,0:0,-1,0:6,6,6 -o lamp.png\n"),
};

const option_table plan_table = {
    .verb = "plan",
    .usage = HELP("plan SCENE [options]"),
    .about = HELP("Reports what `lambent render` would do with the same options (and --world none), without "
                  "drawing: the stages that run, with counted operations, units of work and memory; and those that "
                  "are skipped, with the reason. `exact`: skipping changes no byte of the picture; that is proved, "
                  "and tested. Without a budget nothing else is skipped:\na light of 0 W (no map, no light); a "
                  "light that points away from the scene (faces of its map that see nothing of the scene); bounced "
                  "light of surfaces that reflect nothing, or are unlit; lobes and emission that no material has; "
                  "and in a convex, empty room, where nothing can lie between two points, every segment.\nPairs and "
                  "segments of bounced light are estimated from up to 192 sample tiles of the picture. So is the "
                  "error of settings chosen for a budget, against finer settings. Sampling never costs over a "
                  "quarter of the picture. Work is counted in units: one is a pixel lit by one node."),
    .part = {render_scene_rows, json_rows, render_view_rows, stereo_rows, render_light_rows, render_bounce_rows,
             KEY_ROWS render_picture_rows, render_other_rows},
    .examples = HELP("  lambent plan demo --size 32x24\n"
                "  settings for a frame of 16 ms on this machine:\n"
                "    lambent plan demo --size 32x24 --budget ms=16\n"
                "  the least work for an error of 5 %:\n"
                "    lambent plan demo --size 32x24 --budget error=0.05\n"
                "  settings for a small memory, or how much more is needed:\n"
                "    lambent plan demo --size 32x24 --budget bytes=400KiB\n"),
};

static const char *show_name(int32_t show)
{
    int i = 0;
    while (show_values[i] != show) {
        ++i;
    }
    return shows[i];
}

static void choose(render_options *o)
{
    const int viewed = o->occlusion == LMB_OCCLUSION_VIEW || o->occlusion == LMB_OCCLUSION_VIEW_WORLD;
    if (o->grouping.method == CHOSEN) {
        lmb_grouping plain; /* an option that only fixed groups use selects them */
        memset(&plain, 0, sizeof plain);
        plain.method = CHOSEN;
        const int grouped = viewed || o->steps != 0 || o->show == SHOW_POINTS || o->show == SHOW_GROUPS ||
                            memcmp(&plain, &o->grouping, sizeof plain) != 0;
        o->grouping.method = grouped ? LMB_GROUP_ZONES : LMB_GROUP_CUT;
    }
    if (o->occlusion == CHOSEN) {
        o->occlusion = o->grouping.method == LMB_GROUP_CUT ? LMB_OCCLUSION_EXACT : LMB_OCCLUSION_VIEW;
    }
}

#if !defined(OPTIONS_WITHOUT_HELP) /* the web page has neither --budget nor --error-bound */
static int check_choices(const render_options *o, report *r)
{
    if (o->conservative && (o->gather_step == LMB_GATHER_LIVE || o->is_steady)) {
        return report_fail(r, "--error-bound: --gather live keeps no bound; use --gather full");
    }
    if (o->is_steady && o->gather_step == 1) {
        return report_fail(r, "--steady is a kind of --gather live; leave --gather full out");
    }
    if (o->rate > 0.0f && !(o->budget_ms > 0.0f)) {
        return report_fail(r, "--budget rate: a speed goes only with ms, which it turns into work");
    }
    if (!has_budget(&o->budget, o->budget_ms)) {
        return 1;
    }
    if (o->grouping.method != LMB_GROUP_CUT || o->conservative) {
        return report_fail(r, "--budget: settings are chosen for --group method=cut, without --error-bound");
    }
    if (o->show == SHOW_OCCLUSION || shows_attribute(o->show) || shows_map(o->show) || o->show == LMB_SHOW_DIRECT) {
        return report_fail(r, "--budget: settings are chosen for bounced light; --show full, indirect or irradiance");
    }
    if (o->budget.work > 0.0 && o->budget_ms > 0.0f) {
        return report_fail(r, "--budget ms and --budget work exclude each other: one is the other times the rate");
    }
    return 1;
}
#else
#define check_choices(o, r) 1
#endif

static int check_together(const render_options *o, report *r)
{
    if (!check_choices(o, r)) {
        return 0;
    }
    if (o->background.kind != BACKGROUND_WORLD && o->show > LMB_SHOW_IRRADIANCE) {
        return report_fail(r, "--background: only pictures of light have one; use --show full, direct or indirect");
    }
    if (o->background.kind == BACKGROUND_TRANSPARENT && o->out != NULL && picture_format(o->out) != PICTURE_PNG) {
        return report_fail(r, "--background transparent: only PNG has alpha; name a .png");
    }
    if (o->background.kind == BACKGROUND_COLOUR && o->out != NULL && picture_is_linear(picture_format(o->out))) {
        return report_fail(r, "--background: a colour needs a display format; name a .png or a .ppm");
    }
    if (o->bounces > 1 && o->grouping.method != LMB_GROUP_CUT) {
        return report_fail(r, "--bounces above 1 needs --group method=cut");
    }
    if (!view_options_check(&o->view, r)) {
        return 0;
    }
    if (o->view.has_eye && o->camera != NULL) {
        return report_fail(r, "--camera and --eye exclude each other");
    }
    if (o->stereo_m > 0.0f && shows_map(o->show)) {
        return report_fail(r, "--stereo: what lives in a shadow map is one for both eyes; show it without");
    }
    if (o->grouping.method == LMB_GROUP_CUT && (o->show == SHOW_POINTS || o->show == SHOW_GROUPS)) {
        return report_fail(r, "--show points, groups: a cut is each tile's own; use --group method=zones, greedy or "
                              "none");
    }
    if (o->samples > 1 && o->show > LMB_SHOW_IRRADIANCE) {
        return report_fail(r, "--samples %d: only light has a mean over a pixel; --show %s takes one sample",
                           (int)o->samples, show_name(o->show));
    }
    if (o->sorted && o->show > LMB_SHOW_IRRADIANCE) {
        return report_fail(r, "--blend sorted: only light is mixed; --show %s shows one surface at each pixel",
                           show_name(o->show));
    }
    if (o->show == SHOW_OCCLUSION && o->occlusion == LMB_OCCLUSION_NONE) {
        return report_fail(r, "--show occlusion wants an --occlusion other than none");
    }
    if ((o->grouping.method == LMB_GROUP_CUT) != (o->occlusion == LMB_OCCLUSION_EXACT) &&
        o->occlusion != LMB_OCCLUSION_NONE) {
        return report_fail(r, "--occlusion exact goes with --group method=cut; view and view-world with zones, greedy, "
                              "none");
    }
    return 1;
}

void render_options_begin(render_options *o)
{
    memset(o, 0, sizeof *o);
    view_options_init(&o->view);
    o->grouping.method = o->occlusion = CHOSEN;
    o->exposure_ev = NAN;
    o->kernels = lmb_kernels_pick();
}

int render_options_complete(render_options *o, report *r)
{
    o->exposure_auto = isnan(o->exposure_ev) != 0;
    o->exposure_ev = o->exposure_auto ? 0.0f : o->exposure_ev;
    choose(o);
    return check_together(o, r);
}

static int check_verb(const render_options *o, int plans, report *r)
{
    if (o->scene == NULL) {
        return report_fail(r, plans ? "no scene given; try: lambent plan demo"
                                    : "no scene given; try: lambent render demo -o demo.png");
    }
    if (plans && o->show >= SHOW_DEPTH) {
        return report_fail(r, "--show: plans are of pictures of light: full, direct, indirect or irradiance");
    }
    return o->out != NULL || plans || report_fail(r, "no output given; add -o FILE.png (or .ppm .pfm .hdr)");
}

/* All machines must choose alike, so the speed of a machine must not affect any setting. */
static int check_slice(const render_options *o, report *r)
{
    char name[SLICE_NAME];
    if (o->slice.count == 0) {
        return 1;
    }
    if (o->show >= SHOW_DEPTH) {
        return report_fail(r,
                           "--slice: only pictures of light are drawn by slices; use --show full, direct or indirect");
    }
    if (o->budget_ms > 0.0f && !(o->rate > 0.0f)) {
        return report_fail(r, "--slice: --budget ms chooses by the machine's speed; add rate, or use work");
    }
    return o->out == NULL || slice_name(name, o->out, o->slice, r);
}

int render_options_parse(render_options *o, int argc, char **argv, report *r)
{
    render_options_begin(o);
    const int plans = strcmp(argv[0], "plan") == 0;
    const int asked = options_parse(o, plans ? &plan_table : &render_table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    return check_verb(o, plans, r) && check_slice(o, r) && render_options_complete(o, r) ? OPTIONS_RUN : OPTIONS_BAD;
}
