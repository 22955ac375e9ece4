/* main_demo.c: draws the built-in scene: demo-picture OUT.png. `make demo` links it, because it needs less than half of
 * the tool. */
#include <stdio.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../common/io_file.h"
#include "../common/progress.h"
#include "../render/verb_render.h"

/* In a signal handler, before the program ends. */
static void clean_up(void)
{
    file_drop_aside();
    progress_wipe();
}

int main(int argc, char **argv)
{
    static char verb[] = "render", scene[] = "demo", option[] = "-o";
    host_take_streams();
    host_outlive_file_limit();
    host_end_cleanly(clean_up);
    if (argc != 2) {
        fputs("usage: demo-picture OUT.png\n", stderr);
        return 2;
    }
    if (lmb_build_check() != LMB_OK) {
        fputs("demo-picture: this build computes other pixels; build with the Makefile's flags\n", stderr);
        return 1;
    }
    char *words[] = {verb, scene, option, argv[1], NULL};
    const int status = verb_render(4, words);
    file_keep_end();
    return status;
}
