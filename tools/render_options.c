/* render_options.c: the command line of `lambent render`, strictly: every number whole, every word known. */
#include "render_options.h"

#include "many_lights.h"
#include "option_value.h"

#include <string.h>

enum { CHOSEN = -1 }; /* by the other options */

static const char usage_view[] =
    "usage: lambent render SCENE -o OUT [options]\n"
    "\n"
    "SCENE  .gltf, .glb, .obj, .ply, or `demo`, a built-in room.   OUT  .png .ppm (display), .pfm .hdr (linear)\n"
    "\n"
    "view\n"
    "  --size WxH                 picture, px (default: height 480, width by the camera's aspect)\n"
    "  --scene NAME|N             of a file with several scenes (default: its own choice)\n"
    "  --camera NAME|N            one of the scene's cameras, by name or number from 0 (default: 0)\n"
    "  --eye X,Y,Z --target X,Y,Z [--up X,Y,Z] --fov DEG\n"
    "                             a camera of your own; fov is the vertical angle (default 45), up +Y\n"
    "  --stereo METRES            two eyes that far apart, left | right side by side, each --size; "
    "one light serves both\n"
    "light\n"
    "  --light KIND:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER]\n"
    "                             instead of the scene's lights; may be repeated, lights add up. KIND is spot, point\n"
    "                             or sun; position in metres, direction of travel; W/sr, sun W/m2; a spot's half\n"
    "                             angles in degrees (default 0,45)\n"
    "  --light-map N              texels a side of a light's map, a multiple of 8 (default 1024, "
    "less for many lights)\n"
    "many lights\n"
    "  --many-lights CELLS        lights stream into at most CELLS cells of the world, and every 8x8 pixels take what\n"
    "                             they need of a tree over those, shadows by every triangle; so do --elements, which\n"
    "                             bounce their light. Millions take the memory of thousands. By itself, with 16384\n"
    "                             cells, where there are more than 128 lights, or more than 32 that bounce by cuts\n"
    "  --light-error E            share of a pixel's light that one node of that tree may be wrong by (default 0.02)\n";

static const char usage_bounce[] =
    "bounce\n"
    "  --quality draft|default|best\n"
    "                             sets the next three; see README for each one's error and time\n"
    "  --tree N                   first points a side of a light's map, a power of two, to an eighth of --light-map\n"
    "  --error E                  share that a pixel's bounced light may be wrong by where nothing blocks it\n"
    "  --error-bound E            the same as a proof, for each pixel: takes many times as long (one bounce; with\n"
    "                             --occlusion none also where it takes every texel)\n"
    "  --visible V                what may be seen or blocked as one: at most this share of a pixel's bounced light\n"
    "  --bounces N                reflections of light, 1 .. 64 (default 1); above 1 with --grouping cut. What an\n"
    "                             emitter sends straight is none: it always counts\n"
    "  --rest estimate|none       with --bounces over 1, light that is reflected more often: estimated from how the\n"
    "                             last of them grew weaker (default), or left out\n"
    "  --elements N               pieces of the scene that reflect again, or shine (a power of 4; default 16384, with\n"
    "                             --bounces over 1 65536)\n"
    "  --grouping cut|zones|greedy|none\n"
    "                             cut (default): every 8x8 pixels take what they need of a tree of all lit points.\n"
    "                             The others make one fixed set of groups; what follows to --steps is theirs:\n"
    "  --groups N                 groups at most (default 512)\n"
    "  --block N                  texels a side of a first point: 1 2 4 8 (default 8)\n"
    "  --neighbour METRES         neighbours are points within so many metres, say 0.25, 0.5 or 1 (default: those of\n"
    "                             the blocks around, as --neighbour-blocks 1)\n"
    "  --neighbour-blocks N       neighbours are points within so many blocks of the light's map; and within\n"
    "                             --neighbour, where both are given\n"
    "  --neighbourhood facing|hemisphere\n"
    "                             neighbours are points that face the same way (default), or any over the surface\n"
    "  --thin N                   of N points one becomes a disc, evenly spread, and the others join it, 1 .. 64\n"
    "                             (default 1)\n"
    "  --disc-radius R            a disc's radius is R x its mean distance to its neighbours (default: by the area of\n"
    "                             its points, so that none is lost or made)\n"
    "  --zones N                  zones that the discs' map is cut into at first (default: as --groups)\n"
    "  --join K                   points closer than K x their mean distance become one disc, 0 .. 1 (default 0.5)\n"
    "  --reach X                  a disc joins a group within X x the first disc's radius (default 3)\n"
    "  --cosine C                 ... and where the normals' cosine is at least C, -1 .. 1 (default 0.9)\n"
    "  --misfits keep|drop        what does not fit its zone opens another group, or is lost; how much is said\n"
    "  --centre barycentre|disc   where a group stands (default barycentre)\n"
    "  --occlusion exact|none|view|view-world\n"
    "                             what stands between lit points and pixels: every triangle (cut's default); nothing;\n"
    "                             or, for fixed groups, what the viewer's depth map shows, marched in map space or in\n"
    "                             world space (their default: view): it cannot know what is off screen or hidden\n"
    "  --steps N                  samples of a view march, 1 .. 64 (default 12)\n"
    "  --gather full|half|quarter at every pixel (default; half with many lights), or at every second or fourth\n"
    "                             each way and between them\n"
    "                             where surface and light go on; pixels that have no such neighbours "
    "are gathered too\n";

static const char usage_more[] =
    "picture\n"
    "  --glossy                   glTF's materials with highlights and reflections, by metallic, roughness and base\n"
    "                             colour (metallic-roughness maps by texel): of the lamps with maps, and of what\n"
    "                             bounces, by --grouping cut. Else, and in OBJ, PLY and `demo`, materials are\n"
    "                             Lambertian\n"
    "  --show full|direct|indirect|irradiance   (default full; irradiance: bounced, before albedo)\n"
    "         depth|eye-distance|normal|albedo  of what the eye sees; metres along the view, and from the eye\n"
    "         light-distance|points|groups      of the lights' maps, at their size, a row of faces a light: metres\n"
    "                             from the light; first points by what they send, W/m2 (discs, where --join or --thin\n"
    "                             is given); the number of the group that owns a texel, 0 dark, -1 dropped\n"
    "         occlusion           the share of the bounced light that --occlusion blocks\n"
    "                             Display formats scale distances, near is bright, and give each group a colour.\n"
    "  --exposure EV|auto         stops, display formats only (default auto, by the light that surfaces reflect: said\n"
    "                             on stderr). .pfm and .hdr stay linear\n"
    "other\n"
    "  --profile exact            the only one: the same bytes on every machine\n"
    "  --backend NAME             scalar, sse2, avx2, avx512, neon, simd128: this machine's best by default\n"
    "  --threads N                that draw at once; the picture does not depend on it (default: the processors)\n"
    "  --stats FILE.json          time by stage, counts, bytes\n";

static const char usage_budget[] =
    "budget\n"
    "  --budget-error E           bounced light may be that far off: RMSE over its mean, without the worst "
    "1 % of pixels\n"
    "  --budget-ms T              a frame may take that long here: T x the rate of `lambent bench --calibrate`\n"
    "  --budget-work N            the same in units, one a pixel lit by one node: the same choice on every machine\n"
    "  --budget-bytes N[KiB|MiB]  of maps, trees, view, picture and one thread's scratch\n"
    "                             With any of them --light-map, --tree, --error, --visible, --gather and --occlusion\n"
    "                             are chosen: the least error within them, or the least work that keeps\n"
    "                             --budget-error. What is chosen, and by how much it falls short, is said;\n"
    "                             `lambent plan` shows the reckoning\n"
    "  --rate UNITS               units of work a second, in place of measuring them\n";

const char *const render_usage[RENDER_USAGE_PARTS] = {usage_view, usage_bounce, usage_more, usage_budget};

static int parse_size(const char *text, render_options *o)
{
    return option_size(text, &o->view.width, &o->view.height);
}

static int parse_exposure(const char *text, render_options *o)
{
    o->exposure_auto = strcmp(text, "auto") == 0;
    return o->exposure_auto ||
           (option_number(text, -60.0f, 60.0f, &o->exposure_ev));
}

static int parse_show(const char *text, render_options *o)
{
    static const char *const words[] = {"full",           "direct",       "indirect", "irradiance", "depth",
                                        "normal",         "albedo",       "eye-distance", "light-distance", "points",
                                        "groups",         "occlusion",    NULL};
    static const int32_t values[] = {LMB_SHOW_FULL, LMB_SHOW_DIRECT, LMB_SHOW_INDIRECT, LMB_SHOW_IRRADIANCE,
                                     SHOW_DEPTH,    SHOW_NORMAL,     SHOW_ALBEDO,       SHOW_EYE_DISTANCE,
                                     SHOW_LIGHT_DISTANCE, SHOW_POINTS, SHOW_GROUPS, SHOW_OCCLUSION};
    return option_word(text, words, values, &o->show);
}

static int parse_grouping(const char *text, render_options *o)
{
    static const char *const words[] = {"cut", "zones", "greedy", "none", NULL};
    static const int32_t values[] = {LMB_GROUP_CUT, LMB_GROUP_ZONES, LMB_GROUP_GREEDY, LMB_GROUP_NONE};
    return option_word(text, words, values, &o->grouping.method);
}

static int parse_occlusion(const char *text, render_options *o)
{
    static const char *const words[] = {"exact", "none", "view", "view-world", NULL};
    static const int32_t values[] = {LMB_OCCLUSION_EXACT, LMB_OCCLUSION_NONE, LMB_OCCLUSION_VIEW,
                                     LMB_OCCLUSION_VIEW_WORLD};
    return option_word(text, words, values, &o->occlusion);
}

static int parse_gather(const char *text, render_options *o)
{
    static const char *const words[] = {"full", "half", "quarter", NULL};
    static const int32_t values[] = {1, 2, 4};
    return option_word(text, words, values, &o->gather_step);
}

static int parse_block(const char *text, render_options *o)
{
    static const char *const words[] = {"1", "2", "4", "8", NULL};
    static const int32_t values[] = {1, 2, 4, 8};
    return option_word(text, words, values, &o->grouping.block);
}

static int parse_light_map(const char *text, render_options *o)
{
    return option_int(text, 8, 4096, &o->light_map) && o->light_map % 8 == 0;
}

static int parse_many_lights(const char *text, render_options *o)
{
    return option_int(text, 1, 1 << 22, &o->many_cells);
}

static int parse_fov(const char *text, render_options *o) { return view_option_fov(text, &o->view); }

static int parse_eye(const char *text, render_options *o)
{
    return o->view.has_eye = option_vec3(text, &o->view.eye);
}

static int parse_target(const char *text, render_options *o)
{
    return o->view.has_target = option_vec3(text, &o->view.target);
}

static int parse_up(const char *text, render_options *o) { return option_vec3(text, &o->view.up); }
static int parse_out(const char *text, render_options *o) { return (o->out = text)[0] != '\0'; }
static int parse_stats(const char *text, render_options *o) { return (o->stats = text)[0] != '\0'; }
static int parse_scene(const char *text, render_options *o) { return (o->scene_name = text)[0] != '\0'; }

static int parse_camera(const char *text, render_options *o) { return (o->camera = text)[0] != '\0'; }
/* For command lines that name it. */
static int parse_profile(const char *text, render_options *o)
{
    (void)o;
    return strcmp(text, "exact") == 0;
}

static int parse_backend(const char *text, render_options *o) { return (o->kernels = lmb_kernels_named(text)) != NULL; }
static int parse_threads(const char *text, render_options *o) { return option_int(text, 1, 64, &o->threads); }
static int parse_steps(const char *text, render_options *o) { return option_int(text, 1, 64, &o->steps); }

static int parse_groups(const char *text, render_options *o)
{
    return option_int(text, 1, LMB_MAX_GROUPS, &o->grouping.groups);
}

static int parse_quality(const char *text, render_options *o)
{
    static const char *const words[] = {"draft", "default", "best", NULL};
    static const int32_t values[] = {LMB_QUALITY_DRAFT, LMB_QUALITY_DEFAULT, LMB_QUALITY_BEST};
    return option_word(text, words, values, &o->quality);
}

static int parse_tree(const char *text, render_options *o)
{
    return option_int(text, 8, 4096, &o->tree) && (o->tree & (o->tree - 1)) == 0;
}

static int parse_error(const char *text, render_options *o)
{
    return option_number(text, 1e-4f, 10.0f, &o->error);
}

static int parse_error_bound(const char *text, render_options *o)
{
    o->proven = 1;
    return parse_error(text, o);
}

static int parse_visible(const char *text, render_options *o)
{
    return option_number(text, 1e-4f, 10.0f, &o->visible);
}

static int parse_rest(const char *text, render_options *o)
{
    o->truncated = strcmp(text, "none") == 0;
    return o->truncated || strcmp(text, "estimate") == 0;
}

static int parse_bounces(const char *text, render_options *o) { return option_int(text, 1, 64, &o->bounces); }

/* Rounded up to what the library takes: a power of 4. */
static int parse_elements(const char *text, render_options *o)
{
    int32_t wanted;
    if (!option_int(text, 64, 1 << 24, &wanted)) {
        return 0;
    }
    for (o->elements = 64; o->elements < wanted; o->elements *= 4) {
    }
    return 1;
}

static int parse_neighbour(const char *text, render_options *o)
{
    return option_number(text, 0.0f, 1e6f, &o->grouping.neighbour_m);
}

static int parse_neighbour_blocks(const char *text, render_options *o)
{
    return option_int(text, 1, LMB_MAX_SIDE, &o->grouping.neighbour_cells);
}

static int parse_disc_radius(const char *text, render_options *o)
{
    return option_number(text, 0.0f, 1e6f, &o->grouping.radius) && o->grouping.radius > 0.0f;
}

static int parse_zones(const char *text, render_options *o)
{
    return option_int(text, 1, 1 << 26, &o->grouping.zones);
}

static int parse_light_error(const char *text, render_options *o)
{
    return option_number(text, 1e-6f, 1.0f, &o->light_error);
}

/* 0 means the default to the library, so the least there is stands for it. */
static int parse_join(const char *text, render_options *o)
{
    int ok = option_number(text, 0.0f, 1.0f, &o->grouping.join);
    o->grouping.join = o->grouping.join > 0.0f ? o->grouping.join : 1e-30f;
    return ok;
}

static int parse_reach(const char *text, render_options *o)
{
    return option_number(text, 0.01f, 1e6f, &o->grouping.reach);
}

static int parse_cosine(const char *text, render_options *o)
{
    int ok = option_number(text, -1.0f, 1.0f, &o->grouping.cosine);
    o->grouping.cosine = o->grouping.cosine != 0.0f ? o->grouping.cosine : 1e-30f;
    return ok;
}

/* One of two words sets or clears a flag. */
static int parse_flag_word(const char *text, const char *clear, const char *set, uint32_t flag, uint32_t *flags)
{
    if (strcmp(text, clear) != 0 && strcmp(text, set) != 0) {
        return 0;
    }
    *flags = strcmp(text, set) == 0 ? *flags | flag : *flags & ~flag;
    return 1;
}

static int parse_misfits(const char *text, render_options *o)
{
    return parse_flag_word(text, "keep", "drop", LMB_ZONES_STRICT, &o->grouping.flags);
}

static int parse_centre(const char *text, render_options *o)
{
    return parse_flag_word(text, "barycentre", "disc", LMB_POINT_CENTRE, &o->grouping.flags);
}

static int parse_neighbourhood(const char *text, render_options *o)
{
    return parse_flag_word(text, "facing", "hemisphere", LMB_NEAR_HEMISPHERE, &o->grouping.flags);
}

static int parse_thin(const char *text, render_options *o)
{
    return option_int(text, 1, LMB_MAX_THIN, &o->grouping.thin);
}

static int parse_stereo(const char *text, render_options *o)
{
    return option_number(text, 0.0f, 1e6f, &o->stereo_m) && o->stereo_m > 0.0f;
}

static int parse_budget_error(const char *text, render_options *o)
{
    return option_number(text, 1e-5f, 10.0f, &o->budget.error);
}

static int parse_budget_ms(const char *text, render_options *o)
{
    return option_number(text, 1e-3f, 1e9f, &o->budget_ms);
}

static int parse_budget_work(const char *text, render_options *o)
{
    float work;
    const int ok = option_number(text, 1.0f, 1e18f, &work);
    o->budget.work = ok ? (double)work : 0.0;
    return ok;
}

static int parse_budget_bytes(const char *text, render_options *o)
{
    const char *p = text;
    float n;
    if (!option_float(&p, &n) || !(n >= 1.0f) || n > 1e15f) {
        return 0;
    }
    const double unit = strcmp(p, "KiB") == 0 ? 1024.0 : strcmp(p, "MiB") == 0 ? 1048576.0 : 1.0;
    o->budget.bytes = (uint64_t)((double)n * unit);
    return *p == '\0' || unit > 1.0;
}

static int parse_rate(const char *text, render_options *o) { return option_number(text, 1.0f, 1e15f, &o->rate); }

static int add_light(const char *text, render_options *o)
{
    return o->light_count < RENDER_LIGHTS && option_light(text, &o->lights[o->light_count++]);
}

static const struct flag {
    option_name of;
    int (*parse)(const char *text, render_options *o);
} flags[] = {
    {{"-o", "a file name"}, parse_out},
    {{"--size", "WxH, 1 .. 8192 each"}, parse_size},
    {{"--scene", "a scene's name or number"}, parse_scene},
    {{"--camera", "a camera's name or number"}, parse_camera},
    {{"--eye", "X,Y,Z"}, parse_eye},
    {{"--target", "X,Y,Z"}, parse_target},
    {{"--up", "X,Y,Z"}, parse_up},
    {{"--fov", "degrees, over 0 and under 179"}, parse_fov},
    {{"--stereo", "metres, over 0"}, parse_stereo},
    {{"--light", "spot|point|sun:PX,PY,PZ:DX,DY,DZ:R,G,B[:INNER,OUTER], at most 64 of them, angles <= 89"}, add_light},
    {{"--light-map", "a multiple of 8, 8 .. 4096"}, parse_light_map},
    {{"--many-lights", "a number of cells, 1 .. 4194304"}, parse_many_lights},
    {{"--light-error", "a number from 0.000001 to 1"}, parse_light_error},
    {{"--grouping", "cut, zones, greedy or none"}, parse_grouping},
    {{"--quality", "draft, default or best"}, parse_quality},
    {{"--tree", "a power of two, 8 .. 4096"}, parse_tree},
    {{"--error", "a share, 0.0001 .. 10"}, parse_error},
    {{"--error-bound", "a share, 0.0001 .. 10"}, parse_error_bound},
    {{"--visible", "a share, 0.0001 .. 10"}, parse_visible},
    {{"--bounces", "a number from 1 to 64"}, parse_bounces},
    {{"--rest", "estimate or none"}, parse_rest},
    {{"--elements", "a number from 64 to 16777216"}, parse_elements},
    {{"--groups", "a number from 1 to the build's capacity (2048)"}, parse_groups},
    {{"--block", "1, 2, 4 or 8"}, parse_block},
    {{"--neighbour", "metres, 0 or more"}, parse_neighbour},
    {{"--neighbour-blocks", "a number from 1 to 8192"}, parse_neighbour_blocks},
    {{"--neighbourhood", "facing or hemisphere"}, parse_neighbourhood},
    {{"--disc-radius", "a number over 0"}, parse_disc_radius},
    {{"--zones", "a number from 1 to 67108864"}, parse_zones},
    {{"--thin", "a number from 1 to 64"}, parse_thin},
    {{"--join", "a number from 0 to 1"}, parse_join},
    {{"--reach", "a number over 0"}, parse_reach},
    {{"--cosine", "a number from -1 to 1"}, parse_cosine},
    {{"--misfits", "keep or drop"}, parse_misfits},
    {{"--centre", "barycentre or disc"}, parse_centre},
    {{"--occlusion", "exact, none, view or view-world"}, parse_occlusion},
    {{"--steps", "1 .. 64"}, parse_steps},
    {{"--gather", "full, half or quarter"}, parse_gather},
    {{"--show", "full, direct, indirect, irradiance, depth, eye-distance, normal, albedo, light-distance, points, "
                "groups or occlusion"}, parse_show},
    {{"--exposure", "stops (-60 .. 60) or auto"}, parse_exposure},
    {{"--profile", "exact (there is no other)"}, parse_profile},
    {{"--backend", "scalar, sse2, avx2, avx512, neon or simd128, as far as this machine has it"}, parse_backend},
    {{"--threads", "1 .. 64"}, parse_threads},
    {{"--stats", "a file name"}, parse_stats},
    {{"--budget-error", "a share, 0.00001 .. 10"}, parse_budget_error},
    {{"--budget-ms", "milliseconds, 0.001 or more"}, parse_budget_ms},
    {{"--budget-work", "a number of units, 1 or more"}, parse_budget_work},
    {{"--budget-bytes", "a number of bytes, or of KiB or MiB: 100KiB"}, parse_budget_bytes},
    {{"--rate", "units of work a second, 1 or more"}, parse_rate},
};

static void choose(render_options *o)
{
    const int viewed = o->occlusion == LMB_OCCLUSION_VIEW || o->occlusion == LMB_OCCLUSION_VIEW_WORLD;
    if (o->grouping.method == CHOSEN) {
        lmb_grouping plain; /* an option that fixed groups alone have asks for them */
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

static int check_budget(const render_options *o, report *r)
{
    if (!has_budget(&o->budget, o->budget_ms)) {
        return 1;
    }
    if (o->grouping.method != LMB_GROUP_CUT || o->proven) {
        return report_fail(r, "--budget-*: settings are chosen for --grouping cut, without --error-bound");
    }
    if (o->show == SHOW_OCCLUSION || shows_attribute(o->show) || shows_map(o->show) || o->show == LMB_SHOW_DIRECT) {
        return report_fail(r, "--budget-*: settings are chosen for bounced light; --show full, indirect or irradiance");
    }
    if (o->budget.work > 0.0 && o->budget_ms > 0.0f) {
        return report_fail(r, "--budget-ms and --budget-work exclude each other: one is the other times the rate");
    }
    return 1;
}

static int check_together(const render_options *o, int plans, report *r)
{
    if (o->scene == NULL) {
        return report_fail(r, plans ? "no scene given; try: lambent plan demo"
                                    : "no scene given; try: lambent render demo -o demo.png");
    }
    if (!check_budget(o, r)) {
        return 0;
    }
    if (plans && o->out != NULL) {
        return report_fail(r, "-o: a plan draws nothing; `lambent render` does");
    }
    if (!plans && o->json) {
        return report_fail(r, "--json: is of `lambent plan`; --stats FILE.json tells what was drawn");
    }
    if (o->out == NULL && !plans) {
        return report_fail(r, "no output given; add -o FILE.png (or .ppm .pfm .hdr)");
    }
    if (o->bounces > 1 && o->grouping.method != LMB_GROUP_CUT) {
        return report_fail(r, "--bounces above 1 needs --grouping cut");
    }
    if (!view_options_check(&o->view, r)) {
        return 0;
    }
    if (o->view.has_eye && o->camera != NULL) {
        return report_fail(r, "--camera and --eye exclude each other");
    }
    if (o->stereo_m > 0.0f && shows_map(o->show)) {
        return report_fail(r, "--stereo: what lives in a light's map is one for both eyes; show it without");
    }
    if (o->grouping.method == LMB_GROUP_CUT && (o->show == SHOW_POINTS || o->show == SHOW_GROUPS)) {
        return report_fail(r, "--show points, groups: a cut is each tile's own; use --grouping zones, greedy or none");
    }
    if (o->show == SHOW_OCCLUSION && o->occlusion == LMB_OCCLUSION_NONE) {
        return report_fail(r, "--show occlusion wants an --occlusion other than none");
    }
    if ((o->grouping.method == LMB_GROUP_CUT) != (o->occlusion == LMB_OCCLUSION_EXACT) &&
        o->occlusion != LMB_OCCLUSION_NONE) {
        return report_fail(r,
                           "--occlusion exact goes with --grouping cut; view and view-world with zones, greedy, none");
    }
    return 1;
}

int render_options_parse(render_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    view_options_init(&o->view);
    o->grouping.method = o->occlusion = CHOSEN;
    o->exposure_auto = 1;
    o->kernels = lmb_kernels_pick();
    const int plans = strcmp(argv[0], "plan") == 0;
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            o->help = 1;
            return 1;
        }
        if (strcmp(argv[i], "--glossy") == 0) {
            o->glossy = 1;
        } else if (strcmp(argv[i], "--json") == 0) {
            o->json = 1;
        } else if (argv[i][0] == '-' && argv[i][1] != '\0') {
            const int f = option_find(flags, sizeof *flags, sizeof flags / sizeof *flags, argv, i, r);
            if (f < 0 || (!flags[f].parse(argv[++i], o) && !option_refuse(&flags[f].of, argv[i], r))) {
                return 0;
            }
        } else if (o->scene != NULL) {
            return report_fail(r, "one scene at a time: `%s` and `%s`", o->scene, argv[i]);
        } else {
            o->scene = argv[i];
        }
    }
    choose(o);
    return check_together(o, plans, r);
}
