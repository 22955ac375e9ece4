/* verb_relief.c: `lambent relief`: calls `bake` or `render`. */
#include "verb_relief.h"

#include <string.h>

#include "relief_options.h"

static const option_row ask_rows[] = {OPTION_ASK, {.kind = OPTION_END}};

static const option_table relief_both = {
    .verb = "relief",
    .usage = HELP("relief bake MODEL -o OUT.lmr [options]\nrelief render FILE.lmr [--path FILE] -o OUT [options]\n"
                  "relief render --crowd LIST [--path FILE] -o OUT [options]"),
    .about = HELP("Draws a complex model as a few triangles that carry its surface, silhouette, depth and shadow, by "
        "views of it: `bake` makes the views and the simple model, `render` draws them. Each has its own --help."),
    .part = {ask_rows},
    .examples = HELP("  a tent, its relief and a picture of that:\n" RELIEF_TENT
                "    lambent relief render tent.lmr --size 160x120 -o tent.png\n"),
};

int verb_relief(int argc, char **argv)
{
    if (argc >= 2 && strcmp(argv[1], "bake") == 0) {
        return verb_relief_bake(argc - 1, argv + 1);
    }
    if (argc >= 2 && strcmp(argv[1], "render") == 0) {
        return verb_relief_render(argc - 1, argv + 1);
    }
    static const char *const verbs[] = {"bake", "render", NULL};
    report r = {""};
    const char *meant = argc >= 2 ? options_nearest(verbs, argv[1]) : NULL;
    if (meant != NULL) {
        report_fail(&r, "there is no `relief %s`; did you mean relief %s?", argv[1], meant);
        return report_end(&r, "relief", 2);
    }
    if (argc >= 2 && argv[1][0] != '-') {
        report_fail(&r, "there is no `relief %s`: give bake or render; lambent relief --help describes both", argv[1]);
        return report_end(&r, "relief", 2);
    }
    const int asked = options_parse(NULL, &relief_both, argc, argv, &r);
    if (asked != OPTIONS_RUN) {
        return options_answer(asked, &relief_both, &r);
    }
    report_fail(&r, "give bake or render; lambent relief --help describes both");
    return report_end(&r, "relief", 2);
}
