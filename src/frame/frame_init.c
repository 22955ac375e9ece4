/* frame_init.c: the size of a frame's memory, and the layout in one block. Layer 8. */
#include <lambent/render.h>

#include <string.h>

#include "requires.h"
#include "stages.h"

#define LINE 64u /* bytes: parts start at multiples of this */

#ifdef LMB_CONFIG_TINY
#define MAP_TEXELS    (1u << 14) /* for all shadow maps: 96 KiB with 16-bit ids */
#define TREE_SHARE    8          /* divides the tree size of a quality: 60 to 80 bytes a texel */
#define ELEMENTS      256u
#define MANY_ELEMENTS 1024u
#else
#define MAP_TEXELS    (1u << 21)
#define TREE_SHARE    1
#define ELEMENTS      16384u /* for emissive surfaces and many lights */
#define MANY_ELEMENTS 65536u /* for repeated bounces: with fewer, rooms lose a tenth of the later light */
#endif

enum { FINEST_MAP = 1024, COARSEST_MAP = 64, MAX_THREADS = 1024, FINEST_TREE = 4096 };

/* The block: only measured if `memory` is NULL, otherwise allocated in the same order. */
typedef struct block {
    uint8_t *memory;
    uint64_t used;
} block;

static void *take(block *b, uint64_t bytes)
{
    void *part = b->memory != NULL ? b->memory + (size_t)b->used : NULL;
    b->used += (bytes + LINE - 1) / LINE * LINE;
    return part;
}

static int is_measured(const block *b) { return b->memory == NULL; }

/* --- settings ----------------------------------------------------------------------------------------------------- */

/* Errors and times of the presets: tests/results/README.md. */
static const struct preset {
    int32_t tree;
    float error, visibility;
} presets[] = {{256, 0.02f, 0.015f}, {128, 0.06f, 0.06f}, {1024, 0.01f, 0.002f}, {256, 0.02f, 0.015f}},
  /* for light from all sides, gathered at every second pixel each way */
  even_presets[] = {{256, 0.1f, 0.2f}, {128, 0.2f, 0.3f}, {1024, 0.01f, 0.005f}, {256, 0.1f, 0.2f}};

static int is_fixed(const lmb_frame_settings *s) { return !LMB_TREES || s->quality == LMB_QUALITY_FIXED; }

static uint32_t map_faces(const lmb_scene *s)
{
    uint32_t faces = 0;
    for (uint32_t i = 0; i < s->light_count; ++i) {
        faces += (uint32_t)lmb_shadow_map_faces(&s->lights[i], s);
    }
    return faces;
}

static lmb_status check(const lmb_frame_settings *s)
{
    if (s->kernels == NULL || s->scene == NULL || s->view.frame_width < 1 || s->view.frame_width > LMB_MAX_SIDE ||
        s->view.frame_height < 1 || s->view.frame_height > LMB_MAX_SIDE || s->show < LMB_SHOW_FULL ||
        s->show > LMB_SHOW_IRRADIANCE || s->quality < LMB_QUALITY_DEFAULT || s->quality > LMB_QUALITY_FIXED ||
        s->bounces < 0 || s->bounces > LMB_MAX_BOUNCES || s->threads < 0 || s->threads > MAX_THREADS ||
        s->shadow_map < 0 || s->tree < 0 || s->gather_step < 0 || s->gather_step == 3 ||
        (s->gather_step > 4 && !takes_lattice(s->gather_step)) || !(s->error >= 0.0f) || !(s->visibility >= 0.0f) ||
        (s->by_bands && s->threads > 1) || (s->samples > 1 && !LMB_MULTISAMPLE) ||
        (s->samples > 1 && s->samples != 4 && s->samples != 8 && s->samples != 16) || s->samples < 0) {
        return LMB_ERR_ARG;
    }
    if (!LMB_TRANSFER && s->transfer != NULL) {
        return LMB_ERR_ARG;
    }
    const int repeats = s->bounces > 1 && s->transfer == NULL;
    if (is_fixed(s) &&
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
    const uint32_t faces = map_faces(s->scene);
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
    f->grouping.method = is_fixed(s) ? s->grouping.method : LMB_GROUP_CUT;
    f->occlusion = is_fixed(s) ? LMB_OCCLUSION_VIEW : LMB_OCCLUSION_EXACT;
    f->error = s->error != 0.0f ? s->error : p->error;
    f->visibility = s->visibility != 0.0f ? s->visibility : p->visibility;
    f->bounces = s->bounces;
    f->samples = s->samples != 0 ? s->samples : 1;
    f->gather_step = s->gather_step != 0 ? s->gather_step : even ? 2 : 1;
    f->id_format = s->id_format != 0 ? s->id_format : lmb_scene_triangles(s->scene) <= 65535u ? LMB_ID16 : LMB_ID32;
}

/* --- parts -------------------------------------------------------------------------------------------------------- */

static lmb_status place_maps(lmb_frame *f, block *b)
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
    f->map_memory = take(b, bytes);
    f->map_bytes = (size_t)bytes;
    return LMB_OK;
}

static lmb_status place_surface(lmb_surface *out, int32_t format, const lmb_view *v, int32_t height, block *b)
{
    const size_t bytes = lmb_surface_bytes(format, v->frame_width, height);
    if (bytes == 0) {
        return LMB_ERR_FORMAT;
    }
    void *memory = take(b, bytes);
    return is_measured(b) ? LMB_OK : lmb_surface_init(out, format, v->frame_width, height, memory, bytes);
}

/* Places the viewer's depth and ids, and the picture. */
static lmb_status place_surfaces(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    const int32_t rows = s->by_bands ? LMB_TILE : f->view.frame_height;
    const int32_t format = s->format != 0 ? s->format : LMB_RGBA8;
    lmb_status status = place_surface(&f->eye.depth, LMB_DEPTH32F, &f->view, rows, b);
    if (status == LMB_OK) {
        status = place_surface(&f->eye.id, f->id_format, &f->view, rows, b);
    }
    f->out = s->out;
    if (status != LMB_OK || s->out.data != NULL) {
        return status;
    }
    status = format < LMB_DEPTH32F ? place_surface(&f->out, format, &f->view, rows, b) : LMB_ERR_FORMAT;
    return status == LMB_OK && !is_measured(b) ? lmb_surface_clear(&f->out) : status;
}

#if LMB_BOUNCE
/* Places first points, groups, and the whole view's depth if the eye holds only bands. */
static lmb_status place_groups(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    const int32_t block_side = f->grouping.block != 0 ? f->grouping.block : LMB_TILE;
    if (block_side < 1 || block_side > LMB_TILE || f->shadow_map % block_side != 0) {
        return LMB_ERR_ARG;
    }
    const uint32_t side = (uint32_t)(f->shadow_map / block_side);
    const uint64_t max = (uint64_t)side * side * 4u * map_faces(f->scene), n = s->points != 0 ? s->points : max;
    const size_t bytes = n <= UINT32_MAX ? lmb_points_bytes((uint32_t)n, side) : 0;
    if (bytes == 0) {
        return LMB_ERR_ARG;
    }
    void *points = take(b, bytes);
    f->groups = (lmb_groups *)take(b, sizeof *f->groups);
    lmb_status status = is_measured(b) ? LMB_OK : lmb_points_init(&f->points, (uint32_t)n, side, points, bytes);
    if (status == LMB_OK && s->by_bands) {
        const int32_t format = f->view.far_m > f->view.near_m ? LMB_DEPTH16 : LMB_DEPTH32F;
        status = place_surface(&f->eye_depth, format, &f->view, f->view.frame_height, b);
    }
    return status;
}
#endif

#if LMB_TREES
static lmb_status place_bvh(lmb_frame *f, block *b)
{
    const uint32_t triangles = lmb_scene_triangles(f->scene);
    const size_t bytes = lmb_bvh_bytes(triangles);
    void *memory = take(b, bytes);
    return bytes == 0 ? LMB_ERR_ARG : is_measured(b) ? LMB_OK : lmb_bvh_init(&f->bvh, triangles, memory, bytes);
}

static lmb_status place_elements(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    const int live = LMB_LIVE && f->gather_step == LMB_GATHER_LIVE;
    const uint32_t n = s->elements != 0 ? s->elements : s->bounces > 1 && !live ? MANY_ELEMENTS : ELEMENTS;
    const size_t bytes = lmb_elements_bytes(n);
    void *memory = take(b, bytes);
    f->elements.cap = n;
    return bytes == 0 ? LMB_ERR_ARG : is_measured(b) ? LMB_OK : lmb_elements_init(&f->elements, n, memory, bytes);
}

/* Places a tree as fine as the settings request. A texel of the tree covers 1 x 1 to 8 x 8 texels of the maps. */
static lmb_status place_tree(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    const uint32_t lit = map_faces(f->scene), faces = lit > 0 ? lit : 1;
    const int32_t finest = f->shadow_map < FINEST_TREE ? f->shadow_map : FINEST_TREE, min = f->shadow_map / 8;
    const int32_t wanted = s->tree != 0 ? s->tree : presets[s->quality].tree / TREE_SHARE;
    const int32_t size = wanted > finest ? finest : wanted < min ? min : wanted;
    const size_t bytes = lmb_tree_bytes(faces, size);
    if (bytes == 0 || f->shadow_map % size != 0) {
        return LMB_ERR_ARG;
    }
    void *memory = take(b, bytes);
    return is_measured(b) ? LMB_OK : lmb_tree_init(&f->tree, faces, size, memory, bytes);
}
#endif

#if LMB_TRANSFER
static lmb_status place_transfer(lmb_frame *f, block *b)
{
    const size_t bytes = lmb_transfer_light_bytes(f->transfer);
    void *memory = take(b, bytes), *places = NULL;
    if (f->many_lights != NULL) {
        places = take(b, (uint64_t)sizeof(lmb_transfer_place) * f->transfer->count[LMB_TRANSFER_AREAS]);
    }
    if (bytes == 0 || is_measured(b)) {
        return bytes == 0 ? LMB_ERR_ARG : LMB_OK;
    }
    const lmb_status status = lmb_transfer_light_init(&f->transfer_light, f->transfer, memory, bytes);
    f->transfer_light.place = (lmb_transfer_place *)places;
    return status != LMB_OK ? status : lmb_transfer_materials(&f->transfer_light, f->transfer, f->scene);
}
#endif

/* Places the memory for bounced light and occlusion. Nothing is needed if nothing lights the scene. */
static lmb_status place_bounced(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    const int emits = lmb_scene_emits(f->scene) && !is_fixed(s);
    const int bounces = s->show != LMB_SHOW_DIRECT && (map_faces(f->scene) > 0 || emits || f->many_lights != NULL);
    const int by_tree = bounces && !is_fixed(s);
#if LMB_TRANSFER
    if (s->transfer != NULL) {
        const lmb_status placed = s->show != LMB_SHOW_DIRECT ? place_transfer(f, b) : LMB_OK;
#if LMB_TREES
        return placed == LMB_OK && f->many_lights != NULL ? place_bvh(f, b) : placed;
#else
        return placed;
#endif
    }
#endif
#if LMB_BOUNCE
    lmb_status status = bounces && is_fixed(s) ? place_groups(f, s, b) : LMB_OK;
#else
    lmb_status status = LMB_OK;
    (void)b, (void)bounces;
#endif
#if LMB_TREES
    if (status == LMB_OK && (by_tree || f->many_lights != NULL)) {
        status = place_bvh(f, b);
    }
    if (status == LMB_OK && by_tree) {
        status = place_tree(f, s, b);
    }
    if (status == LMB_OK && by_tree && (s->bounces > 1 || emits || f->many_lights != NULL)) {
        status = place_elements(f, s, b);
    }
#else
    (void)emits;
    (void)by_tree;
#endif
    return status;
}

/* Places the lattice of frames that bounce light. */
static lmb_status place_lattice(lmb_frame *f, block *b)
{
    const lmb_view *v = &f->view;
    if (!takes_lattice(f->gather_step) || f->show == LMB_SHOW_DIRECT) {
        return LMB_OK;
    }
    const size_t bytes = lmb_lattice_bytes(v->frame_width, v->frame_height);
    void *memory = take(b, bytes);
    return bytes == 0         ? LMB_ERR_ARG
           : is_measured(b) ? LMB_OK
                              : lmb_lattice_init(&f->lattice, v->frame_width, v->frame_height, memory, bytes);
}

#if LMB_LIVE
/* Places the tree of single points, and a scratch for each thread. */
static lmb_status place_live(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    const uint32_t lit = map_faces(f->scene), faces = lit > 0 ? lit : 1;
    const int32_t side = lmb_live_side(faces, f->shadow_map);
    const uint32_t elements = f->elements.cap;
    const size_t bytes = lmb_live_bytes(faces, side, elements);
    if (f->gather_step != LMB_GATHER_LIVE || f->show == LMB_SHOW_DIRECT || f->transfer != NULL) {
        return LMB_OK;
    }
    f->live = (lmb_live *)take(b, sizeof *f->live);
    void *memory = take(b, bytes);
    lmb_live_scratch *scratch =
        (lmb_live_scratch *)take(b, sizeof *scratch * (uint64_t)(s->threads > 1 ? s->threads : 1));
    if (bytes == 0 || is_measured(b)) {
        return bytes == 0 ? LMB_ERR_ARG : LMB_OK;
    }
    for (int32_t i = 0; i < (s->threads > 1 ? s->threads : 1); ++i) {
        memset(&scratch[i], 0, sizeof *scratch);
        f->scratch[i].live = &scratch[i];
    }
    const lmb_status status = lmb_live_init(f->live, faces, side, elements, memory, bytes);
    const int few = s->quality == LMB_QUALITY_DRAFT && !lmb_scene_emits(f->scene); /* emitters are the brightest */
    f->live->strata = few ? LMB_LIVE_STRATA / 2 : LMB_LIVE_STRATA;
    f->live->split = s->quality == LMB_QUALITY_DRAFT ? 8.0f : 16.0f;
    return status;
}
#endif

/* Places one multisample scratch for each thread. */
static lmb_status place_multisample(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    lmb_status status = LMB_OK;
    for (int32_t i = 0; requires_multisample(f) && i < (s->threads > 1 ? s->threads : 1) && status == LMB_OK; ++i) {
        lmb_target eye;
        memset(&eye, 0, sizeof eye);
        lmb_multisample *m = (lmb_multisample *)take(b, sizeof *m);
        status = place_surface(&eye.depth, LMB_DEPTH32F, &f->view, LMB_TILE * f->samples, b);
        if (status == LMB_OK) {
            status = place_surface(&eye.id, f->id_format, &f->view, LMB_TILE * f->samples, b);
        }
        if (status == LMB_OK && !is_measured(b)) {
            memset(m, 0, sizeof *m);
            m->eye = eye;
            f->scratch[i].multisample = m;
        }
    }
    return status;
}

static lmb_status lay_out(lmb_frame *f, const lmb_frame_settings *s, block *b)
{
    const uint64_t scratch = sizeof *f->scratch * (uint64_t)(s->threads > 1 ? s->threads : 1);
    set_numbers(f, s);
    f->scratch = (lmb_band_scratch *)take(b, scratch);
    lmb_status status = place_maps(f, b);
    if (status == LMB_OK) {
        status = place_surfaces(f, s, b);
    }
    if (status == LMB_OK) {
        status = place_bounced(f, s, b);
    }
    if (status == LMB_OK) {
        status = place_lattice(f, b);
    }
    if (status == LMB_OK && !is_measured(b)) {
        memset(f->scratch, 0, (size_t)scratch);
    }
#if LMB_LIVE
    if (status == LMB_OK) {
        status = place_live(f, s, b);
    }
#endif
    return status == LMB_OK ? place_multisample(f, s, b) : status;
}

/* --- calls -------------------------------------------------------------------------------------------------------- */

static lmb_status measure(lmb_frame *f, uint64_t *bytes, const lmb_frame_settings *settings)
{
    block b = {NULL, 0};
    lmb_status status = check(settings);
    if (status == LMB_OK) {
        status = lay_out(f, settings, &b);
    }
    *bytes = b.used;
    return status != LMB_OK ? status : b.used > SIZE_MAX ? LMB_ERR_CAPACITY : LMB_OK;
}

size_t lmb_frame_bytes(const lmb_frame_settings *settings)
{
    lmb_frame f;
    uint64_t bytes = 0;
    return settings != NULL && measure(&f, &bytes, settings) == LMB_OK ? (size_t)bytes : 0;
}

lmb_status lmb_frame_init(lmb_frame *out, const lmb_frame_settings *settings, void *memory, size_t bytes)
{
    lmb_frame f;
    uint64_t needed = 0;
    if (out == NULL || settings == NULL || memory == NULL) {
        return LMB_ERR_ARG;
    }
    lmb_status status = measure(&f, &needed, settings);
    if (status != LMB_OK) {
        return status;
    }
    if ((uintptr_t)memory % sizeof(uint64_t) != 0) {
        return LMB_ERR_ALIGN;
    }
    if (bytes < needed) {
        return LMB_ERR_CAPACITY;
    }
    block b = {(uint8_t *)memory, 0};
    status = lay_out(&f, settings, &b);
    if (status == LMB_OK) {
        *out = f;
    }
    return status;
}
