/* golden.h: the golden cases, and the ways to draw them. */
#ifndef GOLDEN_H
#define GOLDEN_H

#include <lambent/lambent.h>

enum { GOLDEN_POINTS = 400 }; /* of frames that do not request fewer */
enum { GOLDEN_WIDTH = 80, GOLDEN_HEIGHT = 60 };
enum { GOLDEN_WORKERS = 8 };  /* workers that may draw bands of one frame */

/* A way to draw cases. All ways have the same hashes. */
typedef struct golden_way {
    lmb_status (*draw)(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view,
                       const lmb_scene *scene, uint32_t flags, lmb_stats *stats); /* all triangles */
    lmb_status (*draw_map)(const lmb_shadow_map *map, const lmb_kernels *kernels, const lmb_scene *scene);
    lmb_status (*render)(lmb_render *r, const lmb_frame *frame);
    lmb_status (*again)(lmb_render *r, const lmb_frame *frame); /* lmb_render_again and the rest of the frame */
    int32_t backend; /* case k: lmb_kernels_at(this + k, modulo their number); -1: all of them */
    int32_t third;   /* 0: every case; 1 to 3: only every third one, from the first, second or third on */
} golden_way;

extern const golden_way golden_whole; /* each in one call */

/* A worker's memory for the samples of a case's bands. */
#if LMB_MULTISAMPLE && !defined(LMB_CONFIG_TINY)
typedef struct golden_samples {
    lmb_multisample room;
    uint32_t depth[GOLDEN_WIDTH * 16 * LMB_TILE], id[GOLDEN_WIDTH * 16 * LMB_TILE];
} golden_samples;
#else
typedef int golden_samples;
#endif

/* golden_give_samples: gives the memory to a worker, filled with noise. */
void golden_give_samples(lmb_band_scratch *out, golden_samples *own, int32_t samples);

/* Name of the only case to run; NULL: all. */
extern const char *golden_only;

/* golden_run: runs all cases on the way's backends, with a line each to `put`; returns the number of wrong hashes. */
int golden_run(const golden_way *way, void (*put)(const char *line));

#endif
