/* golden.h: the golden cases, and the ways in which they are drawn. */
#ifndef GOLDEN_H
#define GOLDEN_H

#include <lambent/lambent.h>

enum { GOLDEN_POINTS = 400 }; /* of the frames that do not ask for fewer */
enum { GOLDEN_WIDTH = 80, GOLDEN_HEIGHT = 60 };
enum { GOLDEN_WORKERS = 8 };  /* that may draw bands of one frame */

/* How cases draw. Every way has the same hashes. */
typedef struct golden_way {
    lmb_status (*draw)(const lmb_target *target, const lmb_kernels *kernels, const lmb_view *view,
                       const lmb_scene *scene, uint32_t flags, lmb_stats *stats); /* all triangles */
    lmb_status (*draw_map)(const lmb_shadow_map *map, const lmb_kernels *kernels, const lmb_scene *scene);
    lmb_status (*render)(lmb_render *r, const lmb_frame *frame);
    lmb_status (*again)(lmb_render *r, const lmb_frame *frame); /* lmb_render_again, and all that follows */
    int32_t backend; /* case k: lmb_kernels_at(this + k, modulo their number); -1: all of them */
} golden_way;

extern const golden_way golden_whole; /* each in one call */

/* What a worker needs for the samples of a case's bands. */
#if LMB_MULTISAMPLE && !defined(LMB_CONFIG_TINY)
typedef struct golden_samples {
    lmb_multisample room;
    uint32_t depth[GOLDEN_WIDTH * 16 * LMB_TILE], id[GOLDEN_WIDTH * 16 * LMB_TILE];
} golden_samples;
#else
typedef int golden_samples;
#endif

/* golden_give_samples: gives it to a worker, with noise in it. */
void golden_give_samples(lmb_band_scratch *out, golden_samples *own, int32_t samples);

/* The name of the only case to run; NULL: all. */
extern const char *golden_only;

/* golden_run: all cases, by the way's backends, a line each to `put`; how many have another hash. */
int golden_run(const golden_way *way, void (*put)(const char *line));

#endif
