/* golden_draw.c: fixed-function drawing: random primitives of each kind, with textures, fog, blending,
 * tests; pictures and text. */
#include "golden_cases.h"

#include <string.h>

#if LMB_DRAW

enum { DRAWN = GOLDEN_WIDTH * GOLDEN_HEIGHT, TILED = GOLDEN_WIDTH * 64 /* whole tiles */, TEXTURE = 16, VERTICES = 48 };

typedef struct draw_space {
    uint32_t colour[DRAWN], depth[TILED];
    uint8_t stencil[DRAWN], texels[4 * TEXTURE * TEXTURE * 2];
    float corners[VERTICES][3], uvs[VERTICES][2];
    uint8_t colours[VERTICES][4];
} draw_space;

GOLDEN_FITS(draw_space, first);

static void make_vertices(draw_space *s, uint32_t seed)
{
    (void)golden_soup(seed, 1.0f);
    for (int i = 0; i < VERTICES; ++i) {
        s->corners[i][0] = golden_random(-3.0f, 3.0f);
        s->corners[i][1] = golden_random(-3.0f, 3.0f);
        s->corners[i][2] = golden_random(-5.0f, 0.5f);
        for (int k = 0; k < 2; ++k) {
            s->uvs[i][k] = golden_random(-1.5f, 2.5f);
        }
        for (int k = 0; k < 4; ++k) {
            s->colours[i][k] = (uint8_t)golden_random(0.0f, 255.9f);
        }
    }
    for (int i = 0; i < (int)sizeof s->texels; ++i) {
        s->texels[i] = (uint8_t)golden_random(0.0f, 255.9f);
    }
}

/* State of a primitive. bits: 1 blends, 2 fog, 4 tests and logic, 8 clips, 16 one stage, 32 two stages. */
static void set_state(lmb_draw_state *s, lmb_texture texture[2], const draw_space *space, int bits, int n)
{
    const lmb_texture t = {space->texels,        TEXTURE,          TEXTURE, 5, (uint8_t)(n % 3),
                           (uint8_t)(n / 3 % 3), (uint8_t)(n % 3), 0};
    lmb_view view = golden_soup_view(n & 1);
    const lmb_mat4 closer = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.5f, 1}};
    (void)lmb_draw_state_init(s, GOLDEN_WIDTH, GOLDEN_HEIGHT);
    (void)lmb_draw_view(s, &view, &closer);
    s->kernels = golden_kernels;
    texture[0] = texture[1] = t;
    texture[1].filter = LMB_TRILINEAR;
    s->flags = LMB_DRAW_DEPTH_TEST | LMB_DRAW_DEPTH_WRITE | LMB_DRAW_DITHER;
    if (bits & 1) {
        s->flags |= LMB_DRAW_BLEND;
        s->blend_source[0] = s->blend_source[1] = (uint8_t)(n % 15);
        s->blend_target[0] = s->blend_target[1] = (uint8_t)((n * 7 + 5) % 10);
        s->blend_equation[0] = (uint8_t)(n % 5);
        s->blend_colour[0] = s->blend_colour[3] = 90;
    }
    if (bits & 2) {
        s->fog = (uint8_t)(1 + n % 3);
        s->fog_density = 0.2f, s->fog_end = 8.0f;
        s->fog_colour[1] = s->fog_colour[2] = 180;
    }
    if (bits & 4) {
        s->flags |= LMB_DRAW_STENCIL | LMB_DRAW_ALPHA_TEST | (n % 4 == 0 ? LMB_DRAW_LOGIC : 0u);
        s->stencil_func = (uint8_t)(1 + n % 7), s->stencil_value = (uint8_t)n;
        s->stencil_op[0] = (uint8_t)(n % 8), s->stencil_op[1] = (uint8_t)(n / 2 % 8),
        s->stencil_op[2] = (uint8_t)(n / 3 % 8);
        s->alpha_func = LMB_DRAW_GREATER, s->alpha_value = 60;
        s->logic_op = (uint8_t)(n * 5 % 16);
        s->offset_slope = 1.5f, s->offset_units = -2.0f;
    }
    if (bits & 8) {
        s->planes = 3;
        s->plane[0][0] = 1.0f, s->plane[0][3] = 1.5f;
        s->plane[1][1] = -1.0f, s->plane[1][2] = 0.3f, s->plane[1][3] = 2.0f;
        s->flags |= LMB_DRAW_SCISSOR | (n % 2 ? LMB_DRAW_CULL_BACK : LMB_DRAW_FLAT);
        s->scissor[0] = s->scissor[1] = 3;
    }
    s->stage[0].texture = bits & 48 ? &texture[0] : NULL;
    s->stage[1].texture = bits & 32 ? &texture[1] : NULL;
    s->stage[0].mode = (uint8_t)(n % 5), s->stage[1].mode = (uint8_t)(n / 2 % 5);
    s->stage[0].colour[0] = s->stage[1].colour[2] = 200;
    s->line_px = (uint8_t)(1 + n % 4), s->point_px = (uint8_t)(1 + n % 11);
}

/* variant: the target's format, and 8 times the bits of set_state. */
uint64_t case_draw(int variant)
{
    draw_space *s = golden_first();
    lmb_draw_target target;
    lmb_draw_vertices v;
    lmb_texture texture[2];
    lmb_draw_state state;
    lmb_status status = LMB_OK;
    make_vertices(s, 1234);
    memset(s->depth, 0, sizeof s->depth);
    memset(s->stencil, 0, sizeof s->stencil);
    memset(&target, 0, sizeof target);
    memset(&v, 0, sizeof v);
    (void)lmb_surface_init(&target.colour, variant % 8, GOLDEN_WIDTH, GOLDEN_HEIGHT, s->colour, sizeof s->colour);
    (void)lmb_surface_init(&target.depth, variant & 8 ? LMB_DEPTH16 : LMB_DEPTH32F, GOLDEN_WIDTH, GOLDEN_HEIGHT,
                           s->depth, sizeof s->depth);
    target.stencil = s->stencil;
    target.stencil_stride = GOLDEN_WIDTH;
    target.depth_far = 0.01f;
    v.positions = s->corners;
    v.uvs[0] = v.uvs[1] = s->uvs;
    v.colours = &s->colours[0][0];
    v.count = 12;
    for (int n = 0; n < 36 && status == LMB_OK; ++n) {
        set_state(&state, texture, s, variant >> 3, n);
        v.positions = s->corners[n], v.uvs[0] = v.uvs[1] = s->uvs[n % 30], v.colours = s->colours[n];
        status = lmb_draw_list(&target, &state, &v, n % 9, NULL, NULL);
    }
    uint64_t h = golden_hash_u32(GOLDEN_START, (uint32_t)status);
    for (int i = 0; i < DRAWN; i += 4) {
        h = golden_hash_u32(h, s->stencil[i] | (uint32_t)s->stencil[i + 1] << 8 | (uint32_t)s->stencil[i + 2] << 16 |
                                   (uint32_t)s->stencil[i + 3] << 24);
    }
    h = (h ^ lmb_surface_hash(&target.colour)) * UINT64_C(0x100000001b3);
    return (h ^ lmb_surface_hash(&target.depth)) * UINT64_C(0x100000001b3);
}

/* Pixels of a picture; those of 16 bits as numbers, so that byte order does not matter. */
static void make_image(draw_space *s, int32_t format, uint32_t n)
{
    for (uint32_t i = 0; i < TEXTURE * TEXTURE * 4; ++i) {
        const uint32_t v = (i * 2654435761u + n * 40503u) >> 13;
        if (format != LMB_RGB565 && format != LMB_RGB555) {
            s->texels[i] = (uint8_t)v;
        } else if (i < TEXTURE * TEXTURE) {
            ((uint16_t *)(void *)s->texels)[i] = (uint16_t)v;
        }
    }
}

/* variant: the format of the pictures' target. All characters, over a picture copied by each rule. */
uint64_t case_blit(int variant)
{
    draw_space *s = golden_first();
    lmb_surface to;
    lmb_blit_image from;
    char text[100];
    static const uint8_t ink[4] = {250, 200, 90, 180};
    make_vertices(s, 77);
    (void)lmb_surface_init(&to, variant, GOLDEN_WIDTH, GOLDEN_HEIGHT, s->colour, sizeof s->colour);
    memset(&from, 0, sizeof from);
    from.data = s->texels;
    from.width = from.height = TEXTURE;
    lmb_status status = LMB_OK;
    for (int n = 0; n < 24 && status == LMB_OK; ++n) {
        lmb_blit_how how = {{n % 3, n % 5, 9, 8}, 1 + n % 3, (uint32_t)n & LMB_BLIT_FLAGS, 0, (uint8_t)(n * 10)};
        const int32_t format = n % 6 == 5 ? LMB_BLIT_PALETTE8 : LMB_RGB565 + n % 6;
        make_image(s, format, (uint32_t)n);
        from.format = (uint8_t)format;
        from.palette = s->texels + TEXTURE * TEXTURE;
        from.stride_bytes = TEXTURE * (n % 6 == 5 ? 1 : lmb_pixel_bytes(format));
        how.key = from.format == LMB_RGB565 || from.format == LMB_RGB555 ? 0u : s->texels[n];
        status = lmb_blit(&to, n * 11 % GOLDEN_WIDTH - 4, n * 7 % GOLDEN_HEIGHT - 3, &from, &how);
    }
    for (int i = 0; i < 99; ++i) {
        text[i] = (char)(i % 17 == 16 ? '\n' : 32 + i);
    }
    text[99] = 0;
    status = status != LMB_OK ? status : lmb_text(&to, 1, 2, text, 1, ink);
    status = status != LMB_OK ? status : lmb_text(&to, lmb_text_width("Hi"), 30, "Hi", 2, ink);
    return golden_hash_u32(lmb_surface_hash(&to), (uint32_t)status);
}

#endif
