/* play_options.c: the command line of `lambent play`: most of `render`'s options, and motion. */
#include "play_options.h"

#include <string.h>

#include "../common/frame_name.h"
#include "../common/key_path.h"
#include "../common/options.h"
#include "../picture/picture.h"

enum { MOST = 1000000 };

static int parse_out(const char *text, void *at) { return picture_option(text, at) && frame_digits(text) > 0; }

static const char *const moves[] = {"light", "camera", "object", "all", NULL};
static const int32_t move_values[] = {KEY_LIGHT, KEY_CAMERA, KEY_OBJECT, KEY_LIGHT | KEY_CAMERA | KEY_OBJECT};

#define AT(member) .at = offsetof(play_options, member)

static const option_row play_rows[] = {
    {.name = "-o", .value = "OUT", .kind = OPTION_OWN, AT(render.out), .parse = parse_out,
     .expects = "a file name with one %0Nd, as frame_%04d.png; .png .ppm .pfm .hdr",
     .help = "one picture per frame, numbered by %0Nd: frame_%04d.png (.png .ppm display, .pfm .hdr linear); "
             "without -o, frames are only drawn and timed"},
    OPTION_SLICE_ROW(play_options, render.slice, "frames"),
    {.kind = OPTION_TITLE, .help = "motion"},
    {.name = "--move", .kind = OPTION_WORD, AT(move), .words = moves, .values = move_values,
     .help = "what moves (default all): with --path, the keys; else all animations of a glTF file (nodes, skins, "
             "morph weights) together; else a light on a figure of eight (a sun's direction in a cone) and the "
             "camera on an arc around the target, once in 10 s, as far as there is room. Frame 0 is then the "
             "picture of `render`"},
    {.name = "--path", .value = "FILE", .kind = OPTION_TEXT, AT(path), .file = OPTION_READS,
     .help = "motion by keys: lines of TIME WHAT X,Y,Z [X,Y,Z]: seconds; camera, light (or light:N) or object:N, "
             "numbered from 0; position; the target that it looks at or shines on (an object faces it with +Z), if "
             "that changes. A smooth curve goes through the keys of each; before and after them it rests. # begins "
             "a comment"},
    {.name = "--frames", .value = "N", .kind = OPTION_INT, AT(frames), .low = 1, .high = MOST,
     .help = "how many (default 60)"},
    {.name = "--from", .value = "K", .kind = OPTION_INT, AT(from), .low = 0, .high = MOST,
     .help = "the first frame's number (default 0); the frame has the same bytes as in a longer run"},
    {.name = "--fps", .value = "F", .kind = OPTION_ABOVE, AT(fps), .low = 0.0, .high = 1e5,
     .help = "frames per second of the path: frame k is at k / F seconds (default 30)"},
    {.name = "--world-every", .value = "N", .kind = OPTION_INT, AT(world_every), .low = 1, .high = MOST,
     .help = "with a numbered --world, such as sky_%03d.hdr: number of frames from one file to the next; the world is "
             "blended in between (default 1: a file a frame). The lowest number that exists is frame 0, a missing "
             "number ends the series, and the last file stays. Suns within 20 degrees of each other move"},
    {.name = "--check", .value = "K", .kind = OPTION_INT, AT(check), .low = 1, .high = MOST,
     .help = "each Kth frame's error against the same frame by --quality best and --gather full, as in `lambent "
             "compare`"},
    {.kind = OPTION_END},
};

const option_table play_table = {
    .verb = "play",
    .usage = "play SCENE --frames N [--move WHAT] [--path FILE] [--transfer FILE.lmt] [-o OUT]",
    .about = "Draws frames of a scene with moving lights, camera or objects, and prints their times: milliseconds "
             "per frame by stage, minimum, median and the value that 95 of 100 frames stay under, by the clock and "
             "of the processor (all threads together; --threads 1: the drawing thread). A frame depends only on the "
             "scene, the path and the frame's number. Parts that did not move since the last frame are reused, "
             "which changes no byte.",
    .part = {render_scene_rows, play_rows, render_view_rows, render_world_rows, render_light_rows,
             render_bounce_rows, render_group_rows, render_picture_rows, render_other_rows},
    .examples = "  lambent play demo --size 64x48 --quality draft --frames 4 --check 2\n"
                "  with bounced light that was baked once:\n"
                "    lambent bake demo -o demo.lmt --elements 1024 --receivers 2000\n"
                "    lambent play demo --size 64x48 --transfer demo.lmt --frames 4 -o frame_%02d.png\n",
};

static int check_together(const play_options *o, report *r)
{
    if (o->render.scene == NULL) {
        return report_fail(r, "no scene given; try: lambent play demo --frames 30");
    }
    if (o->render.show >= SHOW_DEPTH) {
        return report_fail(r, "--show: frames are of light: full, direct, indirect or irradiance");
    }
    const int is_series = o->render.world != NULL && frame_digits(o->render.world) > 0;
    if (!is_series && o->world_every > 0) {
        return report_fail(r, "--world-every needs a numbered --world, as sky_%%03d.hdr");
    }
    if (is_series && o->render.out != NULL && strcmp(o->render.out, o->render.world) == 0) {
        return report_fail(r, "%s: both --world and -o; the frames would join the world", o->render.out);
    }
    if (o->check > 0 && o->render.show == LMB_SHOW_DIRECT) {
        return report_fail(r, "--check: errors are of bounced light; --show full, indirect or irradiance");
    }
    return o->render.slice.count == 0 || o->render.out != NULL ||
           report_fail(r, "--slice: a slice of frames is a file: add -o frame_%%04d.png");
}

int play_options_parse(play_options *o, int argc, char **argv, report *r)
{
    memset(o, 0, sizeof *o);
    render_options_begin(&o->render);
    o->render.has_sky = 1;
    o->render.is_moving = 1;
    o->move = KEY_LIGHT | KEY_CAMERA | KEY_OBJECT;
    o->frames = 60;
    o->fps = 30.0f;
    const int asked = options_parse(o, &play_table, argc, argv, r);
    if (asked != OPTIONS_RUN) {
        return asked;
    }
    return check_together(o, r) && render_options_complete(&o->render, r) ? OPTIONS_RUN : OPTIONS_BAD;
}
