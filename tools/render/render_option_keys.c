/* render_option_keys.c: the options that take keys: --group, also of `play`, `capture` and `explain`, and --budget, of
 * `render` and `plan`. The web page has neither. */
#include "render_options.h"

#if !defined(OPTIONS_WITHOUT_HELP)

#include <string.h>

#include "../common/option_value.h"
#include "../common/options.h"

#define AT(member) .at = offsetof(render_options, member)

/* 0 selects the default in the library, so the smallest positive number replaces it. */
static int parse_or_zero(const char *text, float low, float *at)
{
    const int ok = option_number(text, low, 1.0f, at);
    *at = *at != 0.0f ? *at : 1e-30f;
    return ok;
}

static int parse_join(const char *text, void *at) { return parse_or_zero(text, 0.0f, at); }
static int parse_cosine(const char *text, void *at) { return parse_or_zero(text, -1.0f, at); }

/* One of two words sets or clears a flag. */
static int parse_flag_word(const char *text, const char *clear, const char *set, uint32_t flag, uint32_t *flags)
{
    if (strcmp(text, clear) != 0 && strcmp(text, set) != 0) {
        return 0;
    }
    *flags = strcmp(text, set) == 0 ? *flags | flag : *flags & ~flag;
    return 1;
}

static int parse_misfits(const char *text, void *at)
{
    return parse_flag_word(text, "keep", "drop", LMB_ZONES_STRICT, at);
}

static int parse_centre(const char *text, void *at)
{
    return parse_flag_word(text, "barycentre", "disc", LMB_POINT_CENTRE, at);
}

static int parse_neighbourhood(const char *text, void *at)
{
    return parse_flag_word(text, "facing", "hemisphere", LMB_NEAR_HEMISPHERE, at);
}

static int parse_budget_work(const char *text, void *at)
{
    float work;
    const int ok = option_number(text, 1.0f, 1e18f, &work);
    *(double *)at = ok ? (double)work : 0.0;
    return ok;
}

static int parse_budget_bytes(const char *text, void *at)
{
    const char *p = text;
    float n;
    if (!option_float(&p, &n) || !(n >= 1.0f) || n > 1e15f) {
        return 0;
    }
    const double unit = strcmp(p, "KiB") == 0 ? 1024.0 : strcmp(p, "MiB") == 0 ? 1048576.0 : 1.0;
    *(uint64_t *)at = (uint64_t)((double)n * unit);
    return *p == '\0' || unit > 1.0;
}

static const char *const groupings[] = {"cut", "zones", "greedy", "none", NULL};
static const int32_t grouping_values[] = {LMB_GROUP_CUT, LMB_GROUP_ZONES, LMB_GROUP_GREEDY, LMB_GROUP_NONE};
static const char *const blocks[] = {"1", "2", "4", "8", NULL};
static const int32_t block_values[] = {1, 2, 4, 8};

const option_row render_group_rows[] = {
    {.name = "--group", .value = "KEY=VALUE[,KEY=VALUE ...]", .kind = OPTION_KEYS,
     .help = HELP("how lit points are grouped; each other key selects zones. Keys:")},
    {.name = "--group method", .kind = OPTION_WORD, AT(grouping.method), .words = groupings, .values = grouping_values,
     .help = HELP("cut (default): every 8x8 pixels select nodes of a tree of all lit points; no other key applies. "
                  "The others make one fixed set of groups")},
    {.name = "--group groups", .value = "N", .kind = OPTION_INT, AT(grouping.groups), .low = 1, .high = LMB_MAX_GROUPS,
     .help = HELP("maximum number of groups (default 512)")},
    {.name = "--group block", .kind = OPTION_WORD, AT(grouping.block), .words = blocks, .values = block_values,
     .help = HELP("texels per side of a first point (default 8)")},
    {.name = "--group neighbour", .value = "METRES", .kind = OPTION_NUMBER, AT(grouping.neighbour_m), .low = 0,
     .high = 1e6,
     .help = HELP("neighbours are points within this distance, for example 0.25, 0.5 or 1 (default: those of "
                  "adjacent blocks, like neighbour-blocks=1)")},
    {.name = "--group neighbour-blocks", .value = "N", .kind = OPTION_INT, AT(grouping.neighbour_cells), .low = 1,
     .high = LMB_MAX_SIDE,
     .help = HELP("neighbours are points within this many blocks of the shadow map; if you give neighbour too, both "
                  "must hold")},
    {.name = "--group neighbourhood", .value = "facing|hemisphere", .kind = OPTION_OWN, AT(grouping.flags),
     .parse = parse_neighbourhood, .expects = "facing or hemisphere",
     .help = HELP("neighbours must face the same way (default), or may be anywhere above the surface")},
    {.name = "--group thin", .value = "N", .kind = OPTION_INT, AT(grouping.thin), .low = 1, .high = LMB_MAX_THIN,
     .help = HELP("one of N points becomes a disc, evenly spread, and the others join it (default 1)")},
    {.name = "--group disc-radius", .value = "R", .kind = OPTION_ABOVE, AT(grouping.radius), .low = 0, .high = 1e6,
     .help = HELP("disc radius: R x the mean distance to neighbouring discs (default: from the area of the points, "
                  "which preserves the total area)")},
    {.name = "--group zones", .value = "N", .kind = OPTION_INT, AT(grouping.zones), .low = 1, .high = 1 << 26,
     .help = HELP("initial number of zones of the map of discs (default: same as groups)")},
    {.name = "--group join", .value = "K", .kind = OPTION_OWN, AT(grouping.join), .parse = parse_join,
     .expects = "a number, 0 .. 1",
     .help = HELP("points closer than K x their mean distance become one disc, 0 .. 1 (default 0.5)")},
    {.name = "--group reach", .value = "X", .kind = OPTION_NUMBER, AT(grouping.reach), .low = 0.01, .high = 1e6,
     .help = HELP("a disc joins a group within X x the radius of the first disc (default 3)")},
    {.name = "--group cosine", .value = "C", .kind = OPTION_OWN, AT(grouping.cosine), .parse = parse_cosine,
     .expects = "a number, -1 .. 1",
     .help = HELP("... and if the cosine between the normals is at least C, -1 .. 1 (default 0.9)")},
    {.name = "--group misfits", .value = "keep|drop", .kind = OPTION_OWN, AT(grouping.flags), .parse = parse_misfits,
     .expects = "keep or drop",
     .help = HELP("a disc that does not fit its zone opens another group, or is dropped; the loss is printed")},
    {.name = "--group centre", .value = "barycentre|disc", .kind = OPTION_OWN, AT(grouping.flags),
     .parse = parse_centre,
     .expects = "barycentre or disc",
     .help = HELP("position of a group (default barycentre)")},
    {.name = "--group steps", .value = "N", .kind = OPTION_INT, AT(steps), .low = 1, .high = 64,
     .help = HELP("samples of a march through the depth map, with --occlusion view or view-world (default 12)")},
    {.kind = OPTION_END},
};

const option_row render_budget_rows[] = {
    {.name = "--budget", .value = "KEY=VALUE[,KEY=VALUE ...]", .kind = OPTION_KEYS,
     .help = HELP("--shadow-map, --tree, --error, --visibility, --gather and --occlusion are chosen for you: the least "
                  "error within the limits, or the least work within an error. The choice, and limits that it "
                  "misses, are printed; `lambent plan` shows the estimates. Keys:")},
    {.name = "--budget error", .value = "E", .kind = OPTION_NUMBER, AT(budget.error), .low = 1e-5, .high = 10,
     .help = HELP("error limit of bounced light: RMSE over the mean, without the worst 1 % of pixels")},
    {.name = "--budget ms", .value = "T", .kind = OPTION_NUMBER, AT(budget_ms), .low = 1e-3, .high = 1e9,
     .help = HELP("time limit of a frame on this machine: T x the rate of `lambent-bench --calibrate`")},
    {.name = "--budget work", .value = "N", .kind = OPTION_OWN, AT(budget.work), .parse = parse_budget_work,
     .expects = "a number of units, 1 or more",
     .help = HELP("the same in units (one pixel lit by one node), for the same choice on every machine")},
    {.name = "--budget bytes", .value = "N[KiB|MiB]", .kind = OPTION_OWN, AT(budget.bytes), .parse = parse_budget_bytes,
     .expects = "a number of bytes, or of KiB or MiB: 100KiB",
     .help = HELP("limit of maps, trees, view, picture and one thread's scratch; the state and the scratch of further "
                  "threads, which do not change the choice, are printed beside it")},
    {.name = "--budget rate", .value = "UNITS", .kind = OPTION_NUMBER, AT(rate), .low = 1, .high = 1e15,
     .help = HELP("units of work per second, instead of measuring them")},
    {.kind = OPTION_END},
};

#endif
