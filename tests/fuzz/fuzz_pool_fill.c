/* fuzz_pool_fill.c: sets public structs between calls, as a program does. */
#include "fuzz_pool.h"

#if FUZZ_CALLS

#include <stddef.h>
#include <string.h>

#define SLOT(type) ((type *)pool_slot(#type, 0))
#define COUNT(a)   ((int)(sizeof(a) / sizeof *(a)))

/* --- good values, by `how`: 0 is the simplest --------------------------------------------------------------------- */

static void set_surface(lmb_surface *s, int32_t format, int32_t width, int32_t height)
{
    const size_t bytes = lmb_surface_bytes(format, width, height);
    fuzz_require(lmb_surface_init(s, format, width, height, pool_block(bytes), bytes) == LMB_OK);
}

static void fill_surface(void *out, int how)
{
    static const uint8_t formats[] = {LMB_RGB32F, LMB_R32F,   LMB_DEPTH32F, LMB_ID32,   LMB_RGBA8,     LMB_BGRA8,
                                      LMB_RGB565, LMB_RGB555, LMB_DEPTH16,  LMB_ID16, LMB_RGB565_BE};
    set_surface(out, formats[how % COUNT(formats)], POOL_WIDE, how & 64 ? POOL_SMALL : POOL_HIGH);
}

static void fill_target(void *out, int how)
{
    lmb_target *t = out;
    const int32_t height = how & 4 ? LMB_TILE : POOL_HIGH;
    memset(t, 0, sizeof *t);
    set_surface(&t->depth, how & 1 ? LMB_DEPTH16 : LMB_DEPTH32F, POOL_WIDE, height);
    set_surface(&t->id, how & 2 ? LMB_ID16 : LMB_ID32, POOL_WIDE, height);
}

/* Bounds for any window of lmb_target, from odd floats, and clusters of any scene. */
static void fill_culling(void *out, int how)
{
    lmb_culling *c = out;
    memset(c, 0, sizeof *c);
    if (!(how & 1)) {
        c->tiles = POOL_WIDE * POOL_HIGH;
        c->farthest = pool_block(c->tiles * sizeof *c->farthest);
        for (uint32_t i = 0; how != 0 && i < c->tiles; ++i) {
            c->farthest[i] = pool_float((uint8_t)(how + (int)i));
        }
    }
    if (!(how & 2)) {
        c->clusters = SLOT(lmb_cluster);
        c->cluster_count = POOL_CLUSTERS;
    }
}

static void fill_cluster(void *out, int how)
{
    lmb_cluster *c = out;
    for (int i = 0; i < POOL_CLUSTERS; ++i) {
        c[i] = (lmb_cluster){pool_vector((uint8_t)(how + i)), pool_vector((uint8_t)(how * 3 + i))};
    }
}

/* Ranges of a scene in memory that holds all, some or none of them. */
static void fill_bins(void *out, int how)
{
    static const size_t bytes[] = {1 << 16, 2000, 700, 0};
    lmb_bins *b = out;
    memset(b, 0, POOL_BINS * sizeof *b);
    for (int i = 0; i < POOL_BINS; ++i) {
        b[i].bytes = bytes[(how + i) % 4];
        b[i].memory = pool_block(b[i].bytes + 1);
        lmb_bins_build(&b[i], lmb_kernels_pick(), SLOT(lmb_view), pool_scene(how / 4 % 4), (uint32_t)(1 + 30 * i), 30,
                       (uint32_t)how / 16 % 4, NULL, NULL);
    }
}

static void fill_view(void *out, int how)
{
    const lmb_vec3 eye = how == 0 ? (lmb_vec3){0.5f, 0.6f, 2.5f} : pool_vector((uint8_t)how), up = {0, 1, 0};
    lmb_view_look_at(out, eye, (lmb_vec3){0, 0.5f, 0}, up, 0.9f, POOL_WIDE, POOL_HIGH);
}

static void fill_light(void *out, int how)
{
    lmb_light *l = out;
    for (int i = 0; i < POOL_LIGHTS; ++i) {
        l[i] = pool_scene(1)->lights[(i + how) % 3];
        l[i].position = pool_vector((uint8_t)(144 + 5 * i));
    }
}

static void fill_settings(void *out, int how)
{
    lmb_frame_settings *s = out;
    memset(s, 0, sizeof *s);
    s->kernels = lmb_kernels_at(how >> 6) ? lmb_kernels_at(how >> 6) : lmb_kernels_pick();
    s->scene = pool_scene(how & 3);
    fill_view(&s->view, 0);
    s->shadow_map = POOL_MAP;
    s->tree = POOL_MAP / 2;
    s->error = s->visibility = 0.2f;
    s->elements = 64;
    s->points = how & 4 ? 0 : 64; /* 0: the maximum */
    s->quality = how & 4 ? LMB_QUALITY_FIXED : LMB_QUALITY_DRAFT;
    s->bounces = how & 8 && !(how & 4) ? 2 : 1;
    s->gather_step = how & 16 && !(how & 4) ? LMB_GATHER_LIVE : 1;
    s->samples = how & 32 ? 4 : 1;
}

static void fill_cut_params(void *out, int how)
{
    *(lmb_cut_params *)out = (lmb_cut_params){.error = 0.2f, .visibility = 0.2f, .bvh = how & 1 ? NULL : SLOT(lmb_bvh)};
}

static void fill_occluder(void *out, int how)
{
    *(lmb_occluder *)out = (lmb_occluder){SLOT(lmb_view), &SLOT(lmb_target)->depth, 1 + how % 2, 8};
}

static void fill_many_lights_query(void *out, int how)
{
    *(lmb_many_lights_query *)out =
        (lmb_many_lights_query){SLOT(lmb_many_lights), SLOT(lmb_bvh), 0.1f, how & 1, how >> 1 & 1, NULL};
}

static void fill_pinhole(void *out, int how)
{
    *(lmb_pinhole *)out = (lmb_pinhole){POOL_WIDE, POOL_HIGH, 20.0f, 20.0f, 11.5f, (float)how + 7.5f};
}

static void fill_axes(void *out, int how)
{
    *(lmb_axes *)out = lmb_axes_upright(how == 0 ? (lmb_vec3){0, 1, 0} : (lmb_vec3){0.28f, 0.96f, 0});
}

static void fill_pictures(void *out, int how)
{
    lmb_world_pictures *p = out;
    const size_t face = POOL_SMALL * POOL_SMALL * 3 * sizeof(float),
                 ground = POOL_SMALL * POOL_SMALL * 4 * sizeof(float);
    memset(p, 0, sizeof *p);
    for (int f = 0; f < 6; ++f) {
        float *rgb = how & 1 << f ? NULL : pool_block(face);
        if (rgb != NULL) {
            memcpy(rgb, pool_raw + f, face);
        }
        p->face[f] = rgb;
        p->alpha[f] = how & 2 << f ? NULL : memcpy(pool_block(face / 3), pool_raw + f, face / 3);
    }
    p->face_size = POOL_SMALL;
    p->radius = 5.0f;
    p->low = (lmb_vec3){-5, -5, -5};
    p->high = (lmb_vec3){5, 5, 5};
    p->shape = how >> 6 & 1;
    if (how & 128) {
        p->ground = memcpy(pool_block(ground), pool_raw, ground);
        p->ground_width = p->ground_height = POOL_SMALL;
        p->ground_x = p->ground_z = p->ground_y = -1.0f;
        p->ground_width_m = p->ground_depth_m = 2.0f;
        p->has_floor = how & 1;
    }
}

static void fill_world_query(void *out, int how)
{
    *(lmb_world_query *)out = (lmb_world_query){SLOT(lmb_world), 0.02f, how & 1};
}

static void fill_parts(void *out, int how)
{
    lmb_voxel_part *p = out;
    for (int i = 0; i < POOL_PARTS; ++i) {
        const lmb_scene *s = pool_scene(how + i);
        p[i] = (lmb_voxel_part){s, 1, lmb_scene_triangles(s), {i == 0, 1}};
    }
}

static void fill_trace(void *out, int how)
{
    *(lmb_cone_trace *)out = (lmb_cone_trace){lmb_kernels_pick(), SLOT(lmb_voxels), how % 3, how >> 2 & 1,
                                              how & 8 ? SLOT(lmb_env) : NULL, SLOT(lmb_cone_scratch), how >> 4 & 1};
}

static void fill_policy(void *out, int how) { *(lmb_probe_policy *)out = (lmb_probe_policy){0.1f, how % 4}; }

static void fill_relight(void *out, int how)
{
    lmb_relight *r = out;
    uint16_t *of = pool_block(2 * sizeof *of); /* the scenes have up to two instances */
    memset(r, 0, sizeof *r);
    of[1] = (uint16_t)(how >> 6);
    r->kernels = lmb_kernels_pick();
    r->scene = pool_scene(how & 3);
    r->maps = how & 4 ? SLOT(lmb_shadow_map) : NULL;
    r->world = how & 8 ? NULL : SLOT(lmb_world);
    r->probes = SLOT(lmb_probe);
    r->probe_of = of;
    r->probe_count = 1;
    r->view = *SLOT(lmb_view);
    r->eye = *SLOT(lmb_target);
}

static void fill_probe(void *out, int how)
{
    *(lmb_probe *)out = (lmb_probe){*SLOT(lmb_probe_cube), *SLOT(lmb_probe_cube)};
    if (how & 1) {
        ((lmb_probe *)out)->glossy.texel = NULL;
    }
}

static void fill_gouraud(void *out, int how)
{
    lmb_gouraud *g = out;
    const lmb_transfer *t = SLOT(lmb_transfer);
    memset(g, 0, sizeof *g);
    g->scene = pool_scene(how & 3);
    g->transfer = t;
    g->light = SLOT(lmb_transfer_light);
    g->maps = how & 4 ? NULL : SLOT(lmb_shadow_map);
    g->direct = pool_block((t->count[LMB_TRANSFER_RECEIVERS] + 8) * sizeof *g->direct); /* also for a file opened
                                                                                         * later */
    g->scratch = SLOT(lmb_gouraud_scratch);
    fill_view(&g->view, 0);
    set_surface(&g->out, LMB_RGB565, POOL_WIDE, POOL_HIGH);
    g->depth = pool_block(POOL_WIDE * POOL_HIGH * sizeof *g->depth);
}

static void fill_receiver(void *out, int how)
{
    lmb_irradiance *two = pool_slot("lmb_irradiance", 1);
    *(lmb_element_scratch *)out = (lmb_element_scratch){how & 1 ? lmb_kernels_named("scalar") : lmb_kernels_pick(),
                                                        SLOT(lmb_cut), SLOT(lmb_tile), SLOT(lmb_irradiance), two};
}

/* A tile as filled in by a program with its own rasterizer, including odd numbers, and ids of small scenes. */
static void fill_tile(void *out, int how)
{
    lmb_tile *t = out;
    float *const plane[] = {t->position[0], t->position[1], t->position[2], t->albedo[0], t->albedo[1], t->albedo[2],
                            t->uv[0],       t->uv[1],       t->depth};
    memset(t, 0, sizeof *t);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        for (int i = 0; i < COUNT(plane); ++i) {
            plane[i][k] = how == 0 ? 0.0625f * (float)(k + i + 1) : pool_float((uint8_t)(how + how * i + k / 8));
        }
        t->face[k / 8 % 3][k] = t->normal[k / 8 % 3][k] = k & 1 ? -1.0f : 1.0f;
        t->id[k] = 1 + (uint32_t)k / 22;
    }
    t->hits = LMB_TILE_PIXELS;
}

/* Planes of a struct that contains only floats. */
static void fill_floats(float *out, size_t count, int how)
{
    for (size_t i = 0; i < count; ++i) {
        out[i] = how == 0 ? 1.0f : pool_float((uint8_t)(how + (int)(i / 16) * (how >> 5)));
    }
}

static void fill_irradiance(void *out, int how) { fill_floats(out, sizeof(lmb_irradiance) / sizeof(float), how); }
static void fill_seen(void *out, int how) { fill_floats(out, sizeof(lmb_cone_seen) / sizeof(float), how); }
static void fill_places(void *out, int how) { fill_floats(out, POOL_PLACES * 3, how == 0 ? 170 : how | 32); }

static void fill_texels(void *out, int how)
{
    lmb_texel *t = out;
    for (int i = 0; i < POOL_TEXELS; ++i) {
        const uint8_t n = (uint8_t)(how == 0 ? 140 + i % 16 : how + i);
        t[i] = (lmb_texel){pool_vector(n),
                           {0, i & 1 ? -1.0f : 1.0f, 0},
                           {1, 0.5f, pool_float((uint8_t)how)},
                           {128, 128, 128, 128},
                           1.0f};
    }
}

/* For anti-aliasing; its target has 8 rows for each of 16 samples. */
static void fill_scratch(void *out, int how)
{
    lmb_multisample *m = SLOT(lmb_multisample);
    set_surface(&m->eye.depth, LMB_DEPTH32F, POOL_WIDE, how & 1 ? 64 : 128);
    set_surface(&m->eye.id, LMB_ID32, POOL_WIDE, how & 1 ? 64 : 128);
    ((lmb_band_scratch *)out)->multisample = m;
}

static void fill_transfer_light(void *out, int how)
{
    lmb_transfer_light *l = out;
    const uint32_t elements = SLOT(lmb_transfer)->count[LMB_TRANSFER_AREAS];
    l->place = how & 1 ? NULL : pool_block((elements + 8) * sizeof *l->place);
}

/* Sets those parts of a frame that lmb_frame_init does not set; the frame itself comes from that call. */
static void fill_frame(void *out, int how)
{
    lmb_frame *f = out;
    f->stats = how & 1 ? NULL : SLOT(lmb_stats);
    f->many_lights = how & 2 ? SLOT(lmb_many_lights) : NULL;
    f->background = how & 4 ? SLOT(lmb_env) : NULL;
    f->transfer = how & 8 ? SLOT(lmb_transfer) : f->transfer;
    f->transfer_light = how & 8 ? *SLOT(lmb_transfer_light) : f->transfer_light;
    set_surface(&f->out, how & 16 ? LMB_RGB565 : LMB_RGB32F, POOL_WIDE, POOL_HIGH);
}

static void fill_draw_target(void *out, int how)
{
    lmb_draw_target *t = out;
    memset(t, 0, sizeof *t);
    if (how != 3) {
        set_surface(&t->colour, LMB_RGB565 + how % 5, POOL_WIDE, POOL_HIGH);
    }
    if (!(how & 8)) {
        set_surface(&t->depth, how & 16 ? LMB_DEPTH16 : LMB_DEPTH32F, POOL_WIDE, POOL_HIGH);
    }
    t->stencil = how & 32 ? NULL : pool_block(POOL_WIDE * POOL_HIGH);
    t->stencil_stride = POOL_WIDE;
    t->x0 = how & 64 ? LMB_TILE : 0;
}

static uint64_t fill_shade(void *user, const lmb_draw_pixels_of *pixels, uint8_t colour[64][4])
{
    float share[2][64], by_x[2][64], by_y[2][64];
    (void)user;
    lmb_draw_shares(share, pixels);
    lmb_draw_steps(by_x, by_y, pixels);
    for (int k = 0; k < 64; ++k) {
        lmb_draw_fragment_at at;
        lmb_draw_fragment(&at, pixels, k);
        colour[k][0] = colour[k][3] = (uint8_t)(at.share[0] > 0.5f ? k : 255);
        colour[k][1] = (uint8_t)pixels->vertex[1];
        colour[k][2] = (uint8_t)((pixels->mask >> k & 1) != 0 && share[1][k] > by_x[0][k] + by_y[1][k]);
    }
    return pixels->mask & UINT64_C(0xff7fffffffffff5f);
}

static void fill_draw_state(void *out, int how)
{
    lmb_draw_state *s = out;
    const int32_t format = how % 3;
    lmb_texture *t = pool_block(sizeof *t);
    fuzz_require(lmb_draw_state_init(s, POOL_WIDE, POOL_HIGH) == LMB_OK);
    t->width = POOL_SMALL, t->height = POOL_SMALL - 1, t->levels = 3;
    t->format = (uint8_t)(LMB_TEXTURE_FORMATS ? format : 0);
    t->filter = (uint8_t)(how / 3 % 3);
    t->wrap_s = (uint8_t)(how / 9 % 3);
    t->texels = pool_block(lmb_texture_format_bytes(t->format, t->width, t->height, t->levels));
    s->stage[how & 1].texture = how & 2 ? t : NULL;
    s->stage[how & 1].mode = (uint8_t)(how % 6);
    s->stage[how & 1].combine.func[0] = (uint8_t)(how / 2 % 8);
    s->stage[how & 1].combine.source[0][0] = (uint8_t)(how / 3 % 6);
    s->polygon_mode[how & 1] = (uint8_t)(how / 5 % 3);
    s->line_pattern = (uint16_t)(how & 8 ? 0xffff : how * 1043);
    s->line_repeat = (uint16_t)(1 + how % 256);
    s->area_pattern = how & 64 ? pool_block(128) : NULL;
    s->flags = (uint32_t)how * 37u & LMB_DRAW_FLAGS;
    s->fog = how >> 2 & 3;
    s->shader = how & 128 && how & 1 ? fill_shade : NULL;
    s->passed = how & 128 && how & 2 ? pool_block(sizeof *s->passed) : NULL;
    s->kernels = how & 4 ? lmb_kernels_pick() : NULL;
    s->planes = how & 16 ? 5 : 0;
    s->line_px = s->point_px = (uint8_t)(1 + how % 9);
    if (how & 32) {
        fuzz_require(lmb_draw_pixels(s) == LMB_OK);
    }
}

static void fill_draw_vertices(void *out, int how)
{
    lmb_draw_vertices *v = out;
    enum { COUNT_OF = 24, NUMBERS = 4 * COUNT_OF };
    float *positions = pool_block(NUMBERS * sizeof *positions), *uvs = pool_block(NUMBERS * sizeof *uvs);
    memset(v, 0, sizeof *v);
    for (int i = 0; i < NUMBERS; ++i) {
        positions[i] = how & 1 ? pool_float((uint8_t)(how + i)) : (float)((i * 37 + how) % 23) * 0.1f - 1.0f;
        uvs[i] = how & 2 ? pool_float((uint8_t)(how * 3 + i)) : (float)(i % 7) * 0.3f;
    }
    v->positions = positions;
    v->uvs[0] = v->uvs[1] = uvs;
    v->colours = how & 4 ? NULL : pool_block(4 * COUNT_OF);
    v->seconds = how & 8 ? NULL : pool_block(4 * COUNT_OF);
    v->back_colours = how & 16 ? NULL : pool_block(4 * COUNT_OF);
    v->back_seconds = how & 32 ? NULL : pool_block(4 * COUNT_OF);
    v->edges = how & 64 ? NULL : pool_block(COUNT_OF);
    v->fogs = how & 128 ? NULL : positions;
    v->count = COUNT_OF;
    v->position_format = (uint8_t)(how / 8 % 4);
    v->uv_format = (uint8_t)(how / 16 % 3);
    v->position_scale = v->position_offset = (lmb_vec3){0.01f, 0.01f, 0.01f};
    v->uv_scale = 0.1f;
}

static void fill_draw_indices(void *out, int how)
{
    lmb_draw_indices *x = out;
    enum { INDICES = 30 };
    uint32_t *data = pool_block(INDICES * sizeof *data);
    for (uint32_t i = 0; i < INDICES; ++i) {
        data[i] = (i * 7 + (uint32_t)how) % (how & 64 ? 40 : 24);
    }
    x->data = data;
    x->count = INDICES;
    x->format = (uint8_t)(how % 4);
}

static void fill_draw_lighting(void *out, int how)
{
    lmb_draw_lighting *l = out;
    lmb_draw_lamp *lamps = pool_block(LMB_DRAW_LAMPS * sizeof *lamps);
    memset(l, 0, sizeof *l);
    for (int i = 0; i < LMB_DRAW_LAMPS; ++i) {
        fill_floats((float *)(void *)&lamps[i], 4 + 9 + 3, how + i);
        lamps[i].spot_exponent = how & 1 ? 20.0f : pool_float((uint8_t)(how + i));
        lamps[i].spot_cos = (float)(i - 4) * 0.25f;
        lamps[i].attenuation[i % 3] = how & 2 ? 0.0f : (float)i;
    }
    fill_floats((float *)(void *)&l->material[0], 13, how);
    fill_floats((float *)(void *)&l->material[1], 13, how / 2);
    fill_floats(l->ambient, 3, how);
    fill_floats(l->to_eye.m, 16, how & 4 ? 0 : how);
    l->material[how & 1].shininess = (float)(how / 2);
    l->lamps = lamps;
    l->count = (uint32_t)how % (LMB_DRAW_LAMPS + 2);
    l->tracks = (uint8_t)(how / 8 % 17);
    l->is_local = how & 1;
    l->is_raw = how >> 1 & 1;
}

static void fill_draw_lit(void *out, int how)
{
    lmb_draw_lit *l = out;
    enum { CODES = 4 * 24 };
    l->colours = how == 1 ? NULL : pool_block(CODES);
    l->seconds = how & 2 ? NULL : pool_block(CODES);
    l->back_colours = how & 4 ? NULL : pool_block(CODES);
    l->back_seconds = how & 8 ? NULL : pool_block(CODES);
}

static void fill_blit_image(void *out, int how)
{
    lmb_blit_image *b = out;
    const int32_t format = how % 6 == 5 ? LMB_BLIT_PALETTE8 : LMB_RGB565 + how % 6;
    const int32_t bytes = format == LMB_BLIT_PALETTE8 ? 1 : lmb_pixel_bytes(format);
    b->data = pool_block((size_t)(POOL_SMALL * POOL_SMALL * bytes));
    b->palette = pool_block(1024);
    b->width = b->height = POOL_SMALL;
    b->stride_bytes = POOL_SMALL * bytes;
    b->format = (uint8_t)format;
}

static void fill_blit_how(void *out, int how)
{
    lmb_blit_how *h = out;
    *h = (lmb_blit_how){{how & 1, how >> 1 & 1, POOL_SMALL - 2, POOL_SMALL - 1}, 1 + how % 5, (uint32_t)how >> 5, 0,
                        (uint8_t)how};
}

static const struct {
    const char *type;
    void (*fill)(void *out, int how);
} fills[] = {
    {"lmb_surface", fill_surface}, {"lmb_target", fill_target}, {"lmb_view", fill_view}, {"lmb_light", fill_light},
    {"lmb_frame_settings", fill_settings}, {"lmb_cut_params", fill_cut_params}, {"lmb_occluder", fill_occluder},
    {"lmb_many_lights_query", fill_many_lights_query}, {"lmb_pinhole", fill_pinhole}, {"lmb_axes", fill_axes},
    {"lmb_world_pictures", fill_pictures}, {"lmb_world_query", fill_world_query}, {"lmb_voxel_part", fill_parts},
    {"lmb_cone_trace", fill_trace}, {"lmb_probe_policy", fill_policy}, {"lmb_relight", fill_relight},
    {"lmb_probe", fill_probe}, {"lmb_gouraud", fill_gouraud}, {"lmb_element_scratch", fill_receiver},
    {"lmb_tile", fill_tile},
    {"lmb_irradiance", fill_irradiance}, {"lmb_cone_seen", fill_seen}, {"lmb_vec3", fill_places},
    {"lmb_texel", fill_texels}, {"lmb_band_scratch", fill_scratch}, {"lmb_transfer_light", fill_transfer_light},
    {"lmb_frame", fill_frame}, {"lmb_culling", fill_culling}, {"lmb_cluster", fill_cluster},
    {"lmb_bins", fill_bins}, {"lmb_draw_target", fill_draw_target}, {"lmb_draw_state", fill_draw_state},
    {"lmb_draw_vertices", fill_draw_vertices}, {"lmb_draw_indices", fill_draw_indices},
    {"lmb_draw_lighting", fill_draw_lighting}, {"lmb_draw_lit", fill_draw_lit},
    {"lmb_blit_image", fill_blit_image}, {"lmb_blit_how", fill_blit_how},
};

void pool_fill(const uint8_t b[12])
{
    const int i = pool_nearest(&fills[0].type, sizeof *fills, COUNT(fills), (uint16_t)(b[0] | b[1] << 8));
    if (b[4] != 0) { /* plain arrays change too */
        fill_floats(pool_raw, COUNT(pool_raw), b[4] == 1 ? 0 : b[4]);
    }
    pool_say("fill %s %d: %d\n", fills[i].type, b[2] % POOL_SLOTS, b[3]);
    fills[i].fill(pool_slot(fills[i].type, b[2]), b[3]);
}

#endif
