/* progress.c: shows progress in one line on a terminal; elsewhere, for some verbs, in a line every ten seconds. */
#include "progress.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "command_name.h"
#include "notes.h"

#define SILENT_S 1.0 /* shorter work shows no progress */
#define EVERY_S  0.2
#define LINE_EVERY_S 10.0 /* if stderr is no terminal */

static struct watch {
    int is_on, is_whole, is_quiet, is_log;
    const char *verb;
    char step[40];
    double share, first_share;       /* reported last; first of the step */
    double begun, step_begun, shown; /* s */
} watch;

static volatile sig_atomic_t has_line;

void progress_begin(int is_quiet, const char *verb)
{
    memset(&watch, 0, sizeof watch);
    watch.is_quiet = is_quiet;
    watch.is_on = !is_quiet && host_watched();
    watch.verb = verb;
    watch.begun = watch.step_begun = watch.is_on ? host_seconds() : 0.0;
}

void progress_begin_log(int is_quiet, const char *verb)
{
    progress_begin(is_quiet, verb);
    if (!is_quiet && !watch.is_on) {
        watch.is_on = watch.is_log = 1;
        watch.begun = watch.step_begun = watch.shown = host_seconds();
    }
}

int progress_is_quiet(void) { return watch.is_quiet; }

/* Early in a short run the remaining time cannot be estimated. `first` is the share when the time began. */
static void left_of(char *out, size_t size, double share, double first, double passed)
{
    const double done = share - first;
    const double more = done > (passed > 2.0 ? 1e-6 : 0.02) ? passed / done * (1.0 - share) : -1.0;
    out[0] = '\0';
    if (more >= 99.5) {
        snprintf(out, size, ", %.0f min left", more / 60.0);
    } else if (more >= 0.0) {
        snprintf(out, size, ", %.0f s left", more);
    }
}

static void show(const char *name, double share, double begun, double now)
{
    char line[128], left[40];
    if (now - watch.begun < SILENT_S || now - watch.shown < (watch.is_log ? LINE_EVERY_S : EVERY_S)) {
        return;
    }
    left_of(left, sizeof left, share, watch.first_share, now - begun);
    snprintf(line, sizeof line, "%s: %s %.0f %%%s", command_name(watch.verb), name, 100.0 * share, left);
    watch.shown = now;
    if (watch.is_log) {
        fprintf(stderr, "%s\n", line);
        return;
    }
    has_line = 1;
    fprintf(stderr, "\r%-78.78s", line);
}

static void print_notes(void)
{
    if (notes_wait()) {
        progress_wipe();
        notes_print();
    }
}

void progress_tell(const char *step, double share)
{
    print_notes();
    if (!watch.is_on) {
        return;
    }
    const double now = host_seconds();
    if (watch.is_whole) { /* shows the line even if one part takes long */
        show(watch.step, watch.share, watch.begun, now);
        return;
    }
    if (strncmp(step, watch.step, sizeof watch.step - 1) != 0 || share < watch.share) { /* new, or repeated */
        snprintf(watch.step, sizeof watch.step, "%s", step);
        watch.step_begun = now;
        watch.first_share = share;
    }
    watch.share = share;
    show(watch.step, share, watch.step_begun, now);
}

void progress_again(void)
{
    if (watch.is_on && watch.step[0] != '\0') {
        show(watch.step, watch.share, watch.is_whole ? watch.begun : watch.step_begun, host_seconds());
    }
}

void progress_whole(const char *part, double share)
{
    print_notes();
    if (watch.is_on) {
        watch.is_whole = 1;
        watch.share = share;
        watch.first_share = 0.0;
        snprintf(watch.step, sizeof watch.step, "%s", part);
        show(part, share, watch.begun, host_seconds());
    }
}

void progress_wipe(void)
{
    if (has_line) {
        host_wipe_line();
        has_line = 0;
    }
}

void progress_end(void)
{
    progress_wipe();
    watch.is_on = 0;
}
