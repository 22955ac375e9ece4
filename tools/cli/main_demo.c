/* main_demo.c: draws the built-in scene: demo-picture OUT.png. `make demo` links it, because it needs a quarter of the
 * tool and half of the library: it reads no files, and on x86-64 SSE2 is the only backend. */
#include <stdio.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../common/io_file.h"
#include "../common/progress.h"
#include "../model/io_lmt.h"
#include "../picture/world_read.h"
#include "../render/budget.h"
#include "../render/render_world.h"
#include "../render/verb_render.h"
#include "../render/wireframe.h"

/* In place of what `render` calls only for other scenes and options. The originals need the readers of files, a third
 * of the time to compile this program. */
static int fail(report *r) { return report_fail(r, "demo-picture draws only the built-in scene; build the tool"); }

int model_load_as(model *out, const char *path, const model_choice *choice, model_notes *notes, report *r)
{
    (void)out, (void)path, (void)choice, (void)notes;
    return fail(r);
}
void model_tell(const model_notes *notes, const char *name, int hides) { (void)notes, (void)name, (void)hides; }
int model_make_glossy(model *m) { (void)m; return 0; }
void model_free(model *m) { (void)m; }
int lmt_open(lmb_transfer *out, const file_bytes *file, const char *path, report *r)
{
    (void)out, (void)file, (void)path;
    return fail(r);
}
int world_hash(uint64_t *hash, const char *path, report *r) { (void)hash, (void)path; return fail(r); }
int world_sky(world *out, report *r) { (void)out; return fail(r); }
int world_read(world *out, const char *path, int is_quiet, report *r)
{
    (void)out, (void)path, (void)is_quiet;
    return fail(r);
}
int world_put_ground(world *inout, lmb_scene *scene, lmb_vec3 eye, report *r)
{
    (void)inout, (void)scene, (void)eye;
    return fail(r);
}
int world_light(world *inout, report *r) { (void)inout; return fail(r); }
void world_free(world *w) { (void)w; }
int budget_fit(budget_choice *out, render_job *j, report *r) { (void)out, (void)j; return fail(r); }
lmb_status wireframe_draw(render_job *j) { (void)j; return LMB_ERR_ARG; }

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
