/* reused_frame.h: a frame that is drawn after others in its memory, by threads or by strips. */
#ifndef REUSED_FRAME_H
#define REUSED_FRAME_H

#include <string.h>

#include "../tools/common/workers.h"

enum { MOST_THREADS = 4 };

/* By threads; or, where there are none, by steps, with depth and ids of so many rows at once. */
typedef struct reuse_way {
    int32_t rows;
    int threads;
} reuse_way;

/* Some strips and numbers of threads, of a frame of `height` rows. */
#define REUSED_WAYS(height) \
    {8, 0}, {16, 0}, {32, 0}, {(height), 1}, {(height), 2}, {(height), 3}, {(height), MOST_THREADS}

/* What did not change since r's last frame is kept. f->scratch: one a thread. */
static inline lmb_status reused_frame(lmb_render *r, const lmb_frame *f, const reuse_way *by)
{
    workers w;
    int32_t stage;
    if (by->threads > 0) {
        memset(&w, 0, sizeof w);
        w.threads = by->threads;
        w.scratches = f->scratch;
        return workers_reuse(&w, &stage, r, f);
    }
    lmb_status status = lmb_render_reuse(r, f);
    if (status == LMB_OK) {
        do {
            status = lmb_render_step(r, 5);
        } while (status == LMB_MORE);
    }
    return status;
}

#endif
