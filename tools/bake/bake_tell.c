/* bake_tell.c: how far it is, on a terminal. */
#include "bake.h"

#include <stdio.h>

#include "../../platform/host/host.h"

void bake_tell(bake *b, const char *step, double share)
{
    const double now = b->is_watched ? host_seconds() : 0.0;
    if (b->is_watched && now - b->shown > 0.2) {
        fprintf(stderr, "\rlambent: bake: %s, %.0f %% ", step, 100.0 * share);
        b->shown = now;
    }
}

void bake_tell_end(const bake *b)
{
    if (b->shown > 0.0) {
        fprintf(stderr, "\r%60s\r", "");
    }
}
