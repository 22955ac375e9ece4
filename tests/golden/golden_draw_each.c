/* golden_draw_each.c: fixed-function drawing with each value of a state: factors and equations, tests and operations,
 * wraps, filters and formats of textures, primitives and their modes, combined stages, light at vertices. */
#include "golden_cases.h"

#include <string.h>

#if LMB_DRAW

enum { EACH_PIXELS = GOLDEN_WIDTH * GOLDEN_HEIGHT, EACH_TILED = GOLDEN_WIDTH * 64, EACH_SIDE = 16, EACH_CORNERS = 24 };
enum { EACH_TEXELS = 64 + 4 * EACH_SIDE * EACH_SIDE * 2 };

typedef struct each_space {
    uint32_t colour[EACH_PIXELS], depth[EACH_TILED], texels[EACH_TEXELS / 4];
    float corners[EACH_CORNERS][3], normals[EACH_CORNERS][3], fogs[EACH_CORNERS];
    int32_t fixed[EACH_CORNERS][4];
    uint32_t order[EACH_CORNERS];
    uint8_t stencil[EACH_PIXELS], colours[4][EACH_CORNERS][4], edges[EACH_CORNERS], pattern[32][4];
} each_space;

GOLDEN_FITS(each_space, first);

/* Data of a case. */
typedef struct each_job {
    each_space *s;
    lmb_draw_target target;
    lmb_draw_state state;
    lmb_draw_vertices vertices;
    lmb_draw_indices indices;
    lmb_texture texture[2];
    lmb_status status;
} each_job;

static uint8_t each_byte(void) { return (uint8_t)golden_random(0.0f, 255.9f); }

static int each_choice(int count) { return (int)golden_random(0.0f, (float)count - 0.01f); }

static void each_begin(each_job *j, each_space *s, int32_t format, uint32_t seed)
{
    memset(j, 0, sizeof *j);
    memset(s, 0, sizeof *s);
    j->s = s;
    (void)golden_soup(seed, 1.0f);
    for (int i = 0; i < (int)sizeof s->colours; ++i) {
        (&s->colours[0][0][0])[i] = each_byte();
    }
    for (int i = 0; i < EACH_CORNERS; ++i) {
        s->edges[i] = (uint8_t)each_choice(2);
    }
    for (int i = 0; i < 128; ++i) {
        s->pattern[i / 4][i % 4] = each_byte();
    }
    (void)lmb_surface_init(&j->target.colour, format, GOLDEN_WIDTH, GOLDEN_HEIGHT, s->colour, sizeof s->colour);
    (void)lmb_surface_init(&j->target.depth, LMB_DEPTH32F, GOLDEN_WIDTH, GOLDEN_HEIGHT, s->depth, sizeof s->depth);
    j->target.stencil = s->stencil;
    j->target.stencil_stride = GOLDEN_WIDTH;
    j->vertices.positions = s->corners;
    j->vertices.uvs[0] = j->vertices.uvs[1] = s->normals; /* any numbers */
    j->vertices.colours = s->colours[0][0];
    j->vertices.count = EACH_CORNERS;
}

/* A state in pixels, and corners anywhere in the picture, in small primitives. */
static void each_next(each_job *j)
{
    each_space *s = j->s;
    (void)lmb_draw_state_init(&j->state, GOLDEN_WIDTH, GOLDEN_HEIGHT);
    (void)lmb_draw_pixels(&j->state);
    j->state.kernels = golden_kernels;
    for (int i = 0; i < EACH_CORNERS; ++i) {
        const float *first = s->corners[i & ~3];
        for (int k = 0; k < 3; ++k) {
            const float range = k == 0 ? GOLDEN_WIDTH : k == 1 ? GOLDEN_HEIGHT : 1.0f;
            s->corners[i][k] = i % 4 == 0 ? golden_random(0.0f, range) : first[k] + golden_random(-0.3f, 0.3f) * range;
            s->normals[i][k] = golden_random(-2.0f, 2.0f);
        }
        s->fogs[i] = golden_random(0.0f, 1.0f);
    }
}

static void each_draw(each_job *j, int32_t primitive)
{
    if (j->status == LMB_OK) {
        j->status = lmb_draw_list(&j->target, &j->state, &j->vertices, primitive,
                                  j->indices.data != NULL ? &j->indices : NULL, NULL);
    }
}

/* Each pair of factors, with the equations in turns; then each equation of colour and alpha. */
static void each_blend(each_job *j)
{
    for (int n = 0; n < 15 * 15 + 25; ++n) {
        const int pair = n < 225 ? n : (n - 225) * 31 % 225;
        each_next(j);
        j->vertices.count = 4;
        j->state.flags = LMB_DRAW_BLEND | (n % 3 == 0 ? LMB_DRAW_DITHER : 0u);
        j->state.blend_source[0] = (uint8_t)(pair % 15), j->state.blend_source[1] = (uint8_t)(pair / 15);
        j->state.blend_target[0] = (uint8_t)(pair / 15 == 10 ? 4 : pair / 15);
        j->state.blend_target[1] = (uint8_t)(pair % 15 == 10 ? 7 : pair % 15);
        j->state.blend_equation[0] = (uint8_t)(n % 5), j->state.blend_equation[1] = (uint8_t)(n / 5 % 5);
        for (int i = 0; i < 4; ++i) {
            j->state.blend_colour[i] = each_byte();
        }
        each_draw(j, LMB_DRAW_QUADS);
    }
}

/* Each function of depth, alpha and stencil, each operation, logic and mask. */
static void each_test(each_job *j)
{
    for (int n = 0; n < 128; ++n) {
        each_next(j);
        j->vertices.count = 8;
        j->state.flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_STENCIL | LMB_DRAW_ALPHA_TEST | (n % 2 ? LMB_DRAW_LOGIC : 0u) |
                         (n % 3 != 0 ? LMB_DRAW_DEPTH_WRITE : 0u);
        j->state.depth_func = (uint8_t)(n % 8 == 0 && n > 8 ? LMB_DRAW_ALWAYS : n % 8);
        j->state.alpha_func = (uint8_t)(n / 8 % 8 == 0 ? LMB_DRAW_ALWAYS : n / 8 % 8);
        j->state.stencil_func = (uint8_t)(n / 4 % 8 == 0 ? LMB_DRAW_ALWAYS : n / 4 % 8);
        j->state.alpha_value = each_byte();
        j->state.stencil_value = each_byte() & 3, j->state.stencil_mask = (uint8_t)(n % 7 == 0 ? 2 : 255);
        j->state.stencil_write = (uint8_t)(n % 5 == 0 ? 0x3c : 255);
        for (int i = 0; i < 3; ++i) {
            j->state.stencil_op[i] = (uint8_t)((n >> i) % 8);
        }
        j->state.logic_op = (uint8_t)(n / 2 % 16);
        j->state.colour_mask = (uint8_t)(n % 16);
        j->state.depth_range[0] = n % 4 == 0 ? 0.25f : 0.0f, j->state.depth_range[1] = n % 4 == 1 ? 0.5f : 1.0f;
        j->state.offset_slope = n % 6 == 0 ? 0.5f : 0.0f, j->state.offset_units = n % 6 == 3 ? 3.0f : 0.0f;
        each_draw(j, LMB_DRAW_QUADS);
    }
}

static void each_set_texture(each_job *j, lmb_texture *t, int n)
{
    t->texels = (const uint8_t *)j->s->texels;
    t->width = EACH_SIDE, t->height = EACH_SIDE, t->levels = 5;
    t->format = (uint8_t)(LMB_TEXTURE_FORMATS ? n / 27 % 3 : LMB_TEXELS_RGBA8);
    t->filter = (uint8_t)(n % 3), t->wrap_s = (uint8_t)(n / 3 % 3), t->wrap_t = (uint8_t)(n / 9 % 3);
    for (int i = 0; i < EACH_TEXELS / 2; ++i) {
        const uint32_t v = (uint32_t)golden_random(0.0f, 65535.9f);
        if (t->format == LMB_TEXELS_RGB565) {
            ((uint16_t *)(void *)j->s->texels)[i] = (uint16_t)v;
        } else {
            ((uint8_t *)j->s->texels)[2 * i] = (uint8_t)v;
            ((uint8_t *)j->s->texels)[2 * i + 1] = (uint8_t)(v >> 8);
        }
    }
}

/* Each filter with each wrap of each format, in each mode. */
static void each_texture(each_job *j)
{
    for (int n = 0; n < 81; ++n) {
        each_next(j);
        j->vertices.count = 8;
        each_set_texture(j, &j->texture[0], n);
        j->state.stage[n % 2].texture = &j->texture[0];
        j->state.stage[n % 2].mode = (uint8_t)(n % 5);
        j->state.stage[n % 2].level_bias = (float)(n % 4) - 1.5f;
        j->state.stage[n % 2].colour[n % 4] = 130;
        each_draw(j, LMB_DRAW_QUADS);
    }
}

/* Combined stages: each function with each source and operand. */
static void each_combine(each_job *j)
{
    for (int n = 0; n < 96; ++n) {
        each_next(j);
        j->vertices.count = 4;
        for (int k = 0; k < 2; ++k) {
            lmb_draw_stage *stage = &j->state.stage[k];
            lmb_draw_combine *c = &stage->combine;
            each_set_texture(j, &j->texture[k], n + k);
            stage->texture = &j->texture[k];
            stage->mode = LMB_DRAW_COMBINE;
            c->func[0] = (uint8_t)((n + k) % 8), c->func[1] = (uint8_t)(n / 8 % 6);
            c->shift[0] = (uint8_t)(n % 3), c->shift[1] = (uint8_t)(n / 3 % 3);
            for (int i = 0; i < 6; ++i) {
                c->source[i / 3][i % 3] = (uint8_t)((n / 8 + i * (k + 1)) % 6);
                c->operand[i / 3][i % 3] = (uint8_t)each_choice(4);
            }
            for (int i = 0; i < 4; ++i) {
                stage->colour[i] = each_byte();
            }
        }
        each_draw(j, LMB_DRAW_QUADS);
    }
}

/* Integer corners, in a format other than float. */
static void each_set_format(each_job *j, int format)
{
    each_space *s = j->s;
    int16_t *short_of = (int16_t *)(void *)s->fixed;
    j->vertices.position_format = (uint8_t)format;
    j->vertices.positions = format == LMB_DRAW_F32 ? (const void *)s->corners : s->fixed;
    j->vertices.position_scale = (lmb_vec3){0.25f, 0.25f, 0.001f};
    j->vertices.position_offset = (lmb_vec3){0.5f, -1.0f, 0.0f};
    for (int i = 0; i < EACH_CORNERS && format == LMB_DRAW_I16; ++i) {
        for (int k = 0; k < 3; ++k) {
            short_of[4 * i + k] = (int16_t)(s->corners[i][k] * (k == 2 ? 1000.0f : 4.0f));
        }
    }
    for (int i = 0; i < 3 * EACH_CORNERS && format == LMB_DRAW_FIXED; ++i) {
        (&s->fixed[0][0])[i] = (int32_t)((&s->corners[0][0])[i] * 65536.0f);
    }
}

static void each_set_order(each_job *j, int format)
{
    for (int i = 0; i < EACH_CORNERS; ++i) {
        const uint32_t at = (uint32_t)(i * 5 % EACH_CORNERS);
        if (format == LMB_INDEX_U32) {
            j->s->order[i] = at;
        } else if (format == LMB_INDEX_U16) {
            ((uint16_t *)(void *)j->s->order)[i] = (uint16_t)at;
        } else {
            ((uint8_t *)j->s->order)[i] = (uint8_t)at;
        }
    }
    j->indices.data = format == LMB_INDEX_NONE ? NULL : j->s->order;
    j->indices.count = EACH_CORNERS;
    j->indices.format = (uint8_t)format;
}

/* Each primitive in each polygon mode, with patterns, in each format of positions and indices. */
static void each_primitive(each_job *j)
{
    static const uint8_t formats[4] = {LMB_INDEX_NONE, LMB_DRAW_INDEX_U8, LMB_INDEX_U16, LMB_INDEX_U32};
    for (int n = 0; n < 90; ++n) {
        each_next(j);
        j->vertices.count = EACH_CORNERS;
        j->vertices.edges = n % 4 == 1 ? j->s->edges : NULL;
        each_set_format(j, n / 10 % 3);
        each_set_order(j, formats[n % 4]);
        j->state.polygon_mode[0] = (uint8_t)(n / 10 % 3), j->state.polygon_mode[1] = (uint8_t)(n / 30 % 3);
        j->state.flags = (n % 3 == 0 ? LMB_DRAW_FLAT : 0u) | (n % 5 == 0 ? LMB_DRAW_CULL_FRONT : 0u) |
                         (n % 5 == 1 ? LMB_DRAW_CULL_BACK : 0u) | (n % 2 ? LMB_DRAW_CLOCKWISE : 0u);
        j->state.line_pattern = (uint16_t)(n % 3 == 2 ? 0xffff : 0x1b27 * (n + 1));
        j->state.line_repeat = (uint16_t)(1 + n % 3);
        j->state.area_pattern = n % 2 ? j->s->pattern[0] : NULL;
        j->state.line_px = (uint8_t)(1 + n % 4), j->state.point_px = (uint8_t)(1 + n % 9);
        each_draw(j, n % 10);
    }
}

/* Vertices lit by lamps of every kind; second and back colours; distances of fog. */
static void each_light(each_job *j)
{
    for (int n = 0; n < 32; ++n) {
        lmb_draw_lamp lamps[4];
        lmb_draw_lighting how;
        each_space *s = j->s;
        const lmb_draw_lit lit = {s->colours[0][0], n % 2 ? s->colours[1][0] : NULL, s->colours[2][0],
                                  n % 2 ? s->colours[3][0] : NULL};
        each_next(j);
        memset(&how, 0, sizeof how);
        for (int i = 0; i < 21 * 4; ++i) {
            ((float *)(void *)lamps)[i] = golden_random(0.05f, 0.9f);
        }
        for (int i = 0; i < 4; ++i) {
            lamps[i].position[0] *= GOLDEN_WIDTH, lamps[i].position[1] *= GOLDEN_HEIGHT;
            lamps[i].position[3] = (float)((n + i) % 2);
            lamps[i].spot_exponent *= 20.0f, lamps[i].spot_cos = i % 2 ? -1.0f : lamps[i].spot_cos - 0.5f;
            lamps[i].attenuation[1] *= 0.02f, lamps[i].attenuation[2] *= 0.001f;
        }
        for (int i = 0; i < 28; ++i) {
            (&how.material[i / 14].emission[0])[i % 14] = golden_random(0.0f, 0.7f);
        }
        how.material[0].shininess = how.material[1].shininess = (float)(n % 5) * 9.0f;
        how.to_eye.m[0] = how.to_eye.m[5] = how.to_eye.m[10] = how.to_eye.m[15] = 1.0f;
        how.to_eye.m[1] = 0.3f, how.to_eye.m[6] = -0.2f, how.to_eye.m[14] = -3.0f;
        how.lamps = lamps, how.count = 4;
        how.tracks = (uint8_t)(n % 16), how.is_local = (uint8_t)(n / 2 % 2), how.is_raw = (uint8_t)(n / 4 % 2);
        j->vertices.colours = s->colours[0][0];
        j->status = j->status != LMB_OK ? j->status
                                        : lmb_draw_light(&lit, &how, &j->vertices, n % 8 == 7 ? NULL : s->normals[0]);
        j->vertices.back_colours = s->colours[2][0];
        j->vertices.seconds = lit.seconds, j->vertices.back_seconds = lit.back_seconds;
        j->vertices.fogs = n % 3 == 0 ? s->fogs : NULL;
        j->state.fog = (uint8_t)(n % 3 == 0 ? 1 + n / 3 % 3 : 0);
        j->state.fog_density = 1.3f;
        each_draw(j, LMB_DRAW_QUADS);
    }
}

/* variant: the target's format, plus 8 times the function. */
uint64_t case_draw_each(int variant)
{
    static void (*const all[])(each_job *) = {each_blend,   each_test,      each_texture,
                                              each_combine, each_primitive, each_light};
    each_job j;
    each_begin(&j, golden_first(), variant % 8, 91u + (uint32_t)variant);
    all[variant / 8](&j);
    uint64_t h = golden_hash_u32(GOLDEN_START, (uint32_t)j.status);
    for (int i = 0; i < EACH_PIXELS; ++i) {
        h = golden_hash_u32(h, j.s->stencil[i]);
    }
    h = (h ^ lmb_surface_hash(&j.target.colour)) * UINT64_C(0x100000001b3);
    return (h ^ lmb_surface_hash(&j.target.depth)) * UINT64_C(0x100000001b3);
}

#endif
