/* solver.h: the ways to solve bounced light: one table each, and a frame has one of them or none. Layer 8. [V33 V34]
 *
 * The stages of a solution and the calls of each:
 *
 *     first points   begin; collect or rows, and end_face, for each face of each shadow map; end_points
 *     groups         build
 *     bounces        step; or part by part on threads: receive, then rest and built (solve_elements.c)
 *     bands          tile, on threads
 *
 * Except `place`, `rows` or `collect`, `build` and `tile`, a member may be NULL: nothing to do. `build` and `step` are
 * called even if bounces are skipped or reused, and must test that (skips and reuses in requires.h). */
#ifndef LMB_FRAME_SOLVER_H
#define LMB_FRAME_SOLVER_H

#include <lambent/render.h>

/* The memory of a frame: only measured if `memory` is NULL, otherwise handed out in the same order. */
typedef struct frame_block {
    uint8_t *memory;
    uint64_t used;
} frame_block;

static inline int is_only_measured(const frame_block *b) { return b->memory == NULL; }

/* lmb_frame_take: the next part of the block; NULL if the block is measured. lmb_frame_take_surface: the same for a
 * surface as wide as the view; sets `out` unless the block is measured. */
void *lmb_frame_take(frame_block *b, uint64_t bytes);
lmb_status lmb_frame_take_surface(lmb_surface *out, int32_t format, const lmb_view *v, int32_t height, frame_block *b);

/* Number of faces of all shadow maps. */
uint32_t lmb_frame_map_faces(const lmb_scene *s);

typedef struct frame_solver frame_solver;
struct frame_solver {
    /* Places the memory. Called twice: to measure, and with memory. */
    lmb_status (*place)(lmb_frame *f, const lmb_frame_settings *s, frame_block *b);

    /* First points. begin: before the first face. collect: tile rows first .. past - 1 of the current face, which is
     * drawn. rows: the same, if any thread may collect any rows: `tile` is the thread's scratch. end_face: after all
     * rows of a drawn face. end_points: after all faces, by steps: returns LMB_MORE until it is done. Solvers with
     * parts have neither begin nor end_points. */
    lmb_status (*begin)(lmb_render *r);
    lmb_status (*collect)(lmb_render *r, int32_t first, int32_t past);
    lmb_status (*rows)(const lmb_render *r, lmb_tile *tile, int32_t first, int32_t past);
    lmb_status (*end_face)(lmb_render *r);
    lmb_status (*end_points)(lmb_render *r, int32_t units);

    /* Without `rows`: a face in parts on threads. has_parts: whether the face can be split; NULL: never. part: one
     * part. join: after all parts, before end_face. */
    int (*has_parts)(const lmb_render *r);
    lmb_status (*part)(const lmb_render *r, lmb_tile *tile, int32_t part, int32_t parts);
    void (*join)(lmb_render *r, int32_t parts);

    /* Groups what was collected. Returns LMB_MORE to be called again. */
    lmb_status (*build)(lmb_render *r);

    /* step: runs up to `units` of the bounces; `own` is this table. done: the share that is done, 0 .. 1. */
    lmb_status (*step)(lmb_render *r, const frame_solver *own, int32_t units);
    float (*done)(const lmb_render *r);

    /* Solvers with elements (solve_elements.c) and a BVH. receive: lights elements first .. past - 1 in pass r->light.
     * rest: estimates `left` further reflections. built: called after each pass. */
    lmb_status (*receive)(const lmb_render *r, lmb_band_scratch *s, int32_t first, int32_t past, lmb_stats *stats);
    lmb_status (*rest)(lmb_render *r, int32_t left);
    lmb_status (*built)(lmb_render *r);

    /* Adds the bounced light of a tile, irradiance in W/m2, as lmb_render_gather (stages.h) requires. */
    lmb_status (*tile)(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                       const lmb_tile *tile, const lmb_irradiance *direct);
};

#if LMB_BOUNCE
extern const frame_solver lmb_solver_groups; /* groups of first points, the same for all pixels */
#endif
#if LMB_TREES
extern const frame_solver lmb_solver_cut; /* cuts of a tree of texels, for 8x8 pixels */
#endif
#if LMB_LIVE
extern const frame_solver lmb_solver_live; /* cuts of a tree of first points, for single points */
#endif
#if LMB_TRANSFER
extern const frame_solver lmb_solver_transfer; /* baked light */
#endif

/* lmb_solver_of: the solver of a frame with memory; NULL: no light bounces. lmb_solver_for: that of a frame's settings,
 * with defaults replaced. */
const frame_solver *lmb_solver_of(const lmb_frame *f);
const frame_solver *lmb_solver_for(const lmb_frame *f, const lmb_frame_settings *s);

/* Settings that require fixed groups: these, or all of a build without trees. */
static inline int has_no_tree(const lmb_frame_settings *s) { return !LMB_TREES || s->quality == LMB_QUALITY_FIXED; }

#if LMB_TREES
/* --- solvers with elements (solve_elements.c) --------------------------------------------------------------------- */

lmb_status lmb_solve_elements_place(lmb_frame *f, const lmb_frame_settings *s, frame_block *b);
lmb_status lmb_solve_elements_step(lmb_render *r, const frame_solver *own, int32_t units);
float lmb_solve_elements_done(const lmb_render *r);

/* Elements receive light in parts; then the pass ends: LMB_MORE if there is another. */
lmb_status lmb_solve_elements_part(const lmb_render *r, const frame_solver *own, lmb_band_scratch *scratch,
                                   int32_t part, int32_t parts, lmb_stats *stats);
lmb_status lmb_solve_elements_end(lmb_render *r, const frame_solver *own);

/* --- shared by cut and live (solve_cut.c) ------------------------------------------------------------------------- */

lmb_status lmb_solve_cut_place(lmb_frame *f, const lmb_frame_settings *s, frame_block *b);
lmb_status lmb_solve_cut_rows(const lmb_render *r, lmb_tile *tile, int32_t first, int32_t past);
lmb_status lmb_solve_cut_end_face(lmb_render *r);
lmb_status lmb_solve_cut_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                              const lmb_tile *tile, const lmb_irradiance *direct);
#endif

#endif
