/* frame_init.c: the size of a frame's memory, and the layout in one block. Layer 8. */
#include <lambent/render.h>

#include <string.h>

#include "requires.h"
#include "solver.h"
#include "stages.h"

#ifdef LMB_CONFIG_TINY
#define MAP_TEXELS (1u << 14) /* for all shadow maps: 96 KiB with 16-bit ids */
#else
#define MAP_TEXELS (1u << 21)
#endif

enum { FINEST_MAP = 1024, COARSEST_MAP = 64, MAX_THREADS = 1024 };

/* --- settings ----------------------------------------------------------------------------------------------------- */

/* Errors and times of the presets: tests/results/README.md. */
static const struct preset {
    float error, visibility;
} presets[] = {{0.02f, 0.015f}, {0.06f, 0.06f}, {0.01f, 0.002f}, {0.02f, 0.015f}},
  /* for light from all sides */
  even_presets[] = {{0.1f, 0.2f}, {0.2f, 0.3f}, {0.01f, 0.005f}, {0.1f, 0.2f}};

static lmb_status check(const lmb_frame_settings *s)
{
    if (s->kernels == NULL || s->scene == NULL || s->view.frame_width < 1 || s->view.frame_width > LMB_MAX_SIDE ||
        s->view.frame_height < 1 || s->view.frame_height > LMB_MAX_SIDE || s->show < LMB_SHOW_FULL ||
        s->show > LMB_SHOW_IRRADIANCE || s->quality < LMB_QUALITY_DEFAULT || s->quality > LMB_QUALITY_FIXED ||
        s->bounces < 0 || s->bounces > LMB_MAX_BOUNCES || s->threads < 0 || s->threads > MAX_THREADS ||
        s->shadow_map < 0 || s->tree < 0 ||
        (s->gather_step != 0 && s->gather_step != 1 && (!LMB_LIVE || s->gather_step != LMB_GATHER_LIVE)) ||
        !(s->error >= 0.0f) || !(s->visibility >= 0.0f) ||
        (s->by_bands && s->threads > 1) || (s->samples > 1 && !LMB_MULTISAMPLE) ||
        (s->samples > 1 && s->samples != 4 && s->samples != 8 && s->samples != 16) || s->samples < 0) {
        return LMB_ERR_ARG;
    }
    if (!LMB_TRANSFER && s->transfer != NULL) {
        return LMB_ERR_ARG;
    }
    const int repeats = s->bounces > 1 && s->transfer == NULL;
    if (has_no_tree(s) &&
        (repeats || s->grouping.method == LMB_GROUP_CUT || s->gather_step == LMB_GATHER_LIVE)) {
        return LMB_ERR_ARG;
    }
    if (s->scene->light_count > LMB_MAX_LIGHTS) {
        return LMB_ERR_CAPACITY;
    }
    if (s->id_format != 0 && s->id_format != LMB_ID16 && s->id_format != LMB_ID32) {
        return LMB_ERR_FORMAT;
    }
    return s->id_format == LMB_ID16 && lmb_scene_triangles(s->scene) > 65535u ? LMB_ERR_SCENE : LMB_OK;
}

static int32_t chosen_map(const lmb_frame_settings *s)
{
    const uint32_t faces = lmb_frame_map_faces(s->scene);
    int32_t size = FINEST_MAP;
    while (size > COARSEST_MAP && (uint64_t)size * (uint64_t)size * faces > MAP_TEXELS) {
        size /= 2;
    }
    return s->shadow_map != 0 ? s->shadow_map : size;
}

/* Sets all fields except memory. */
static void set_numbers(lmb_frame *f, const lmb_frame_settings *s)
{
    memset(f, 0, sizeof *f);
    f->kernels = s->kernels;
    f->scene = s->scene;
    f->many_lights = s->many_lights;
    f->transfer = s->transfer;
    const int even = wants_even_light(f);
    const struct preset *p = even ? &even_presets[s->quality] : &presets[s->quality];
    f->view = s->view;
    f->show = s->show;
    f->shadow_map = chosen_map(s);
    f->grouping = s->grouping;
    f->grouping.method = has_no_tree(s) ? s->grouping.method : LMB_GROUP_CUT;
    f->occlusion = has_no_tree(s) ? LMB_OCCLUSION_VIEW : LMB_OCCLUSION_EXACT;
    f->error = s->error != 0.0f ? s->error : p->error;
    f->visibility = s->visibility != 0.0f ? s->visibility : p->visibility;
    f->bounces = s->bounces;
    f->samples = s->samples != 0 ? s->samples : 1;
    f->gather_step = s->gather_step != 0 ? s->gather_step : 1;
    f->id_format = s->id_format != 0 ? s->id_format : lmb_scene_triangles(s->scene) <= 65535u ? LMB_ID16 : LMB_ID32;
}

const frame_solver *lmb_solver_for(const lmb_frame *f, const lmb_frame_settings *s)
{
    const int fixed = has_no_tree(s);
    const int is_lit =
        lmb_frame_map_faces(f->scene) > 0 || f->many_lights != NULL || (lmb_scene_emits(f->scene) && !fixed);
    if (s->show == LMB_SHOW_DIRECT) {
        return NULL;
    }
#if LMB_TRANSFER
    if (s->transfer != NULL) {
        return &lmb_solver_transfer;
    }
#endif
#if LMB_BOUNCE
    if (fixed && is_lit) {
        return &lmb_solver_groups;
    }
#endif
#if LMB_LIVE
    if (!fixed && is_lit && f->gather_step == LMB_GATHER_LIVE) {
        return &lmb_solver_live;
    }
#endif
#if LMB_TREES
    if (!fixed && is_lit) {
        return &lmb_solver_cut;
    }
#endif
    (void)is_lit;
    return NULL;
}

/* --- parts -------------------------------------------------------------------------------------------------------- */

static lmb_status place_map_memory(lmb_frame *f, frame_block *b)
{
    const lmb_scene *s = f->scene;
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        const size_t own = lmb_shadow_map_bytes(lmb_shadow_map_faces(&s->lights[i], s), f->shadow_map, f->id_format);
        if (own == 0) {
            return LMB_ERR_ARG;
        }
        bytes += own;
    }
    f->map_memory = lmb_frame_take(b, bytes);
    f->map_bytes = (size_t)bytes;
    return LMB_OK;
}

/* Places the viewer's depth and ids, and the picture. */
static lmb_status place_surfaces(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const int32_t rows = s->by_bands ? LMB_TILE : f->view.frame_height;
    const int32_t format = s->format != 0 ? s->format : LMB_RGBA8;
    lmb_status status = lmb_frame_take_surface(&f->eye.depth, LMB_DEPTH32F, &f->view, rows, b);
    if (status == LMB_OK) {
        status = lmb_frame_take_surface(&f->eye.id, f->id_format, &f->view, rows, b);
    }
    f->out = s->out;
    if (status != LMB_OK || s->out.data != NULL) {
        return status;
    }
    status = format < LMB_DEPTH32F ? lmb_frame_take_surface(&f->out, format, &f->view, rows, b) : LMB_ERR_FORMAT;
    return status == LMB_OK && !is_only_measured(b) ? lmb_surface_clear(&f->out) : status;
}

#if LMB_TREES
static lmb_status place_bvh(lmb_frame *f, frame_block *b)
{
    const uint32_t triangles = lmb_scene_triangles(f->scene);
    const size_t bytes = lmb_bvh_bytes(triangles);
    void *memory = lmb_frame_take(b, bytes);
    return bytes == 0 ? LMB_ERR_ARG : is_only_measured(b) ? LMB_OK : lmb_bvh_init(&f->bvh, triangles, memory, bytes);
}

#endif

#if LMB_TREES
/* Does a frame that needs no BVH for bounced light trace lit pixels that the texels around them do not decide? */
static int traces_direct(const lmb_frame *f)
{
    const int has_no_full = f->show == LMB_SHOW_DIRECT || f->transfer != NULL;
    const uint32_t triangles = lmb_scene_triangles(f->scene);
    return LMB_FACETS && has_no_full && triangles > 0 && triangles <= LMB_TRACED_TRIANGLES &&
           lmb_frame_map_faces(f->scene) > 0;
}
#endif

/* Places the memory for occlusion and bounced light. */
static lmb_status place_bounced(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const frame_solver *solver = lmb_solver_for(f, s);
    lmb_status status = LMB_OK;
#if LMB_TREES
    if (f->many_lights != NULL || (solver != NULL && solver->receive != NULL) || traces_direct(f)) {
        status = place_bvh(f, b);
    }
#endif
    return status == LMB_OK && solver != NULL ? solver->place(f, s, b) : status;
}

/* Places the lattice of frames that bounce light. */
static lmb_status place_lattice(lmb_frame *f, frame_block *b)
{
    const lmb_view *v = &f->view;
    if (f->gather_step != LMB_GATHER_LIVE || f->show == LMB_SHOW_DIRECT) {
        return LMB_OK;
    }
    const size_t bytes = lmb_lattice_bytes(v->frame_width, v->frame_height);
    void *memory = lmb_frame_take(b, bytes);
    return bytes == 0         ? LMB_ERR_ARG
           : is_only_measured(b) ? LMB_OK
                              : lmb_lattice_init(&f->lattice, v->frame_width, v->frame_height, memory, bytes);
}

/* Places one multisample scratch for each thread. */
static lmb_status place_multisample(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    lmb_status status = LMB_OK;
    for (int32_t i = 0; requires_multisample(f) && i < (s->threads > 1 ? s->threads : 1) && status == LMB_OK; ++i) {
        lmb_target eye;
        memset(&eye, 0, sizeof eye);
        lmb_multisample *m = (lmb_multisample *)lmb_frame_take(b, sizeof *m);
        status = lmb_frame_take_surface(&eye.depth, LMB_DEPTH32F, &f->view, LMB_TILE * f->samples, b);
        if (status == LMB_OK) {
            status = lmb_frame_take_surface(&eye.id, f->id_format, &f->view, LMB_TILE * f->samples, b);
        }
        if (status == LMB_OK && !is_only_measured(b)) {
            memset(m, 0, sizeof *m);
            m->eye = eye;
            f->scratch[i].multisample = m;
        }
    }
    return status;
}

static lmb_status lay_out_frame(lmb_frame *f, const lmb_frame_settings *s, frame_block *b)
{
    const uint64_t scratch = sizeof *f->scratch * (uint64_t)(s->threads > 1 ? s->threads : 1);
    set_numbers(f, s);
    f->scratch = (lmb_band_scratch *)lmb_frame_take(b, scratch);
    if (!is_only_measured(b)) {
        memset(f->scratch, 0, (size_t)scratch);
    }
    lmb_status status = place_map_memory(f, b);
    if (status == LMB_OK) {
        status = place_surfaces(f, s, b);
    }
    if (status == LMB_OK) {
        status = place_bounced(f, s, b);
    }
    if (status == LMB_OK) {
        status = place_lattice(f, b);
    }
    return status == LMB_OK ? place_multisample(f, s, b) : status;
}

/* --- calls -------------------------------------------------------------------------------------------------------- */

static lmb_status measure_frame(lmb_frame *f, uint64_t *bytes, const lmb_frame_settings *settings)
{
    frame_block b = {NULL, 0};
    lmb_status status = check(settings);
    if (status == LMB_OK) {
        status = lay_out_frame(f, settings, &b);
    }
    *bytes = b.used;
    return status != LMB_OK ? status : b.used > SIZE_MAX ? LMB_ERR_CAPACITY : LMB_OK;
}

size_t lmb_frame_bytes(const lmb_frame_settings *settings)
{
    lmb_frame f;
    uint64_t bytes = 0;
    return settings != NULL && measure_frame(&f, &bytes, settings) == LMB_OK ? (size_t)bytes : 0;
}

lmb_status lmb_frame_init(lmb_frame *out, const lmb_frame_settings *settings, void *memory, size_t bytes)
{
    lmb_frame f;
    uint64_t needed = 0;
    if (out == NULL || settings == NULL || memory == NULL) {
        return LMB_ERR_ARG;
    }
    lmb_status status = measure_frame(&f, &needed, settings);
    if (status != LMB_OK) {
        return status;
    }
    if ((uintptr_t)memory % sizeof(uint64_t) != 0) {
        return LMB_ERR_ALIGN;
    }
    if (bytes < needed) {
        return LMB_ERR_CAPACITY;
    }
    frame_block b = {(uint8_t *)memory, 0};
    status = lay_out_frame(&f, settings, &b);
    if (status == LMB_OK) {
        *out = f;
    }
    return status;
}
