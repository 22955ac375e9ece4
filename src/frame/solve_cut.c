/* solve_cut.c: bounced light by cuts of a tree of the maps' texels, for 8x8 pixels. Layer 8. [V33 V34]
 *
 * Further bounces, emissive surfaces and many lights come from a second tree, of elements (solve_elements.c). */
#include "requires.h"
#include "solver.h"
#include "stages.h"

#if LMB_TREES

#ifdef LMB_CONFIG_TINY
#define TREE_SHARE 8 /* divides the tree size of a quality: 60 to 80 bytes a texel */
#else
#define TREE_SHARE 1
#endif
enum { FINEST_TREE = 4096 };
static const int32_t tree_sizes[] = {256, 128, 1024, 256}; /* of the qualities; errors: tests/results/README.md */

/* --- memory ------------------------------------------------------------------------------------------------------- */

/* Places a tree as fine as the settings request. A texel of the tree covers 1 x 1 to 8 x 8 texels of the maps. */
static lmb_status place_tree(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const uint32_t lit = lmb_frame_map_faces(f->scene), faces = lit > 0 ? lit : 1;
    const int32_t finest = f->shadow_map < FINEST_TREE ? f->shadow_map : FINEST_TREE, min = f->shadow_map / 8;
    const int32_t wanted = s->tree != 0 ? s->tree : tree_sizes[s->quality] / TREE_SHARE;
    const int32_t size = wanted > finest ? finest : wanted < min ? min : wanted;
    const size_t bytes = lmb_tree_bytes(faces, size);
    if (bytes == 0 || f->shadow_map % size != 0) {
        return LMB_ERR_ARG;
    }
    void *memory = lmb_frame_take(b, bytes);
    return is_only_measured(b) ? LMB_OK : lmb_tree_init(&f->tree, faces, size, memory, bytes);
}

lmb_status lmb_solve_cut_place(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const int sends = s->bounces > 1 || lmb_scene_emits(f->scene) || f->many_lights != NULL;
    const lmb_status status = place_tree(f, s, b);
    return status == LMB_OK && sends ? lmb_solve_elements_place(f, s, b) : status;
}

/* --- first points ------------------------------------------------------------------------------------------------- */

lmb_status lmb_solve_cut_rows(const lmb_render *r, lmb_tile *tile, int32_t first, int32_t past)
{
    const lmb_frame *f = &r->frame;
    return !requires_texels(r) ? LMB_OK
                               : lmb_tree_texels(&f->tree, f->kernels, tile, f->scene, &f->scene->lights[r->light],
                                                 &r->maps[r->light], (int32_t)r->face, f->tree.faces, first, past);
}

lmb_status lmb_solve_cut_end_face(lmb_render *r)
{
    lmb_tree *tree = &r->frame.tree;
    const lmb_status status = requires_texels(r) ? lmb_tree_sum(tree, tree->faces) : LMB_OK;
    ++tree->faces;
    return status;
}

/* --- bounces ------------------------------------------------------------------------------------------------------ */

static lmb_status cut_build_elements(lmb_render *r)
{
    lmb_frame *f = &r->frame;
    return !requires_elements(r) || reuses(r, LMB_REUSE_BOUNCES)
               ? LMB_OK
               : lmb_elements_build(&f->elements, f->scene, &f->tree);
}

/* The maps' texels that light the elements in pass r->light: those of the first reflection. */
static const lmb_tree *texels_of_pass(const lmb_render *r)
{
    return r->light == (uint32_t)sends_direct(r) ? &r->frame.tree : NULL;
}

static lmb_status cut_receive(const lmb_render *r, lmb_band_scratch *s, int32_t first, int32_t past, lmb_stats *stats)
{
    const lmb_frame *f = &r->frame;
    const lmb_cut_params cut_params = cut_params_of(f, stats);
    const lmb_element_scratch own = {f->kernels, &s->gather.cut, &s->tile, &s->direct, &s->indirect};
    return lmb_elements_receive(&f->elements, &own, texels_of_pass(r), &cut_params, first, past);
}

static lmb_status cut_rest(lmb_render *r, int32_t left)
{
    return lmb_elements_rest(&r->frame.elements, texels_of_pass(r), left);
}

/* --- a tile ------------------------------------------------------------------------------------------------------- */

lmb_status lmb_solve_cut_tile(lmb_irradiance *inout, lmb_glossy *glossy, const lmb_render *r, lmb_band_scratch *s,
                              const lmb_tile *tile, const lmb_irradiance *direct)
{
    const lmb_frame *f = &r->frame;
    lmb_cut_params cut_params = cut_params_of(f, &s->counts);
    cut_params.glossy = glossy;
    cut_params.view = &f->view;
    cut_params.direct = direct;
    if (LMB_MULTISAMPLE && tile == &s->together && f->samples > 1) { /* all samples of a tile: as many as its middles */
        cut_params.tests = LMB_TRAVERSAL_FIRST / f->samples;
    }
    cut_params.saved = &s->saved_tests;
    cut_params.beside = gathers_many_lights(f) ? inout : NULL;
    lmb_status status = lmb_gather_cut(inout, f->kernels, &s->gather.cut, tile, &f->tree, &cut_params);
    if (status == LMB_OK && requires_elements(r)) {
        cut_params.beside = inout;
        status = lmb_gather_cut(inout, f->kernels, &s->gather.cut, tile, &f->elements.tree, &cut_params);
    }
    return status;
}

const frame_solver lmb_solver_cut = {
    .place = lmb_solve_cut_place,
    .rows = lmb_solve_cut_rows,
    .end_face = lmb_solve_cut_end_face,
    .build = cut_build_elements,
    .step = lmb_solve_elements_step,
    .done = lmb_solve_elements_done,
    .receive = cut_receive,
    .rest = cut_rest,
    .tile = lmb_solve_cut_tile,
};

#endif
