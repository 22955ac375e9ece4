/* test_blit.c: pictures copied with each rule, also onto themselves; text. */
#include "../draw_case.h"

void test_blit(void);

#if LMB_DRAW

static uint32_t pixels[CASE_HIGH][CASE_WIDE];

static lmb_blit_image image_of(const void *data, int32_t format, int32_t width, int32_t height, int32_t stride)
{
    lmb_blit_image i;
    memset(&i, 0, sizeof i);
    i.data = data;
    i.format = (uint8_t)format;
    i.width = width;
    i.height = height;
    i.stride_bytes = stride;
    return i;
}

static lmb_blit_how how_of(int32_t x, int32_t y, int32_t width, int32_t height, int32_t scale, uint32_t flags)
{
    const lmb_blit_how h = {{x, y, width, height}, scale, flags, 0, 255};
    return h;
}

static uint32_t at(int x, int y)
{
    uint32_t v;
    memcpy(&v, drawn.colour[y][x], 4);
    return v;
}

static void fill(uint32_t seed)
{
    test_rng r = {seed};
    case_begin();
    for (int i = 0; i < CASE_HIGH * CASE_WIDE; ++i) {
        pixels[i / CASE_WIDE][i % CASE_WIDE] = test_random(&r);
    }
}

/* Copies to every place, also outside, and with scaling. */
static void test_places(void)
{
    const lmb_blit_image from = image_of(pixels, LMB_RGBA8, 12, 9, CASE_WIDE * 4);
    for (int32_t scale = 1; scale <= 4; ++scale) {
        for (int32_t n = 0; n < 25; ++n) {
            const int32_t x = (n % 5) * 13 - 14, y = (n / 5) * 11 - 13;
            const lmb_blit_how how = how_of(2, 1, 7, 6, scale, 0);
            int wrong = 0;
            fill(3);
            CHECK(lmb_blit(&drawn_on.colour, x, y, &from, &how) == LMB_OK);
            for (int32_t k = 0; k < CASE_HIGH * CASE_WIDE; ++k) {
                const int32_t px = k % CASE_WIDE, py = k / CASE_WIDE;
                const int in = px >= x && px < x + 7 * scale && py >= y && py < y + 6 * scale;
                wrong += at(px, py) != (in ? pixels[1 + (py - y) / scale][2 + (px - x) / scale] : 0);
            }
            CHECK_MSG(wrong == 0 && case_guard_is_whole(), "scale %d at %d %d: %d", scale, x, y, wrong);
        }
    }
    CHECK(lmb_blit(&drawn_on.colour, INT32_MAX, INT32_MIN, &from, NULL) == LMB_OK && case_guard_is_whole());
}

/* Copying part of a picture onto itself gives the result of reading it first, in all directions and with blending. */
static void test_overlaps(void)
{
    for (int32_t n = 0; n < 50; ++n) {
        const int32_t dx = n % 5 - 2, dy = n / 5 % 5 - 2, blends = n / 25;
        uint32_t right[CASE_HIGH][CASE_WIDE];
        lmb_blit_image from = image_of(pixels, LMB_RGBA8, CASE_WIDE, CASE_HIGH, CASE_WIDE * 4);
        lmb_blit_how how = how_of(5, 5, 20, 15, 1, blends ? LMB_BLIT_ALPHA : 0);
        fill(7);
        how.alpha = 200;
        memcpy(drawn.colour, pixels, sizeof pixels);
        CHECK(lmb_blit(&drawn_on.colour, 5 + dx, 5 + dy, &from, &how) == LMB_OK);
        memcpy(right, drawn.colour, sizeof right);
        memcpy(drawn.colour, pixels, sizeof pixels);
        from.data = drawn.colour;
        CHECK(lmb_blit(&drawn_on.colour, 5 + dx, 5 + dy, &from, &how) == LMB_OK);
        CHECK_MSG(memcmp(right, drawn.colour, sizeof right) == 0, "%d %d, blends %d", dx, dy, blends);
        /* the same with the last row first */
        lmb_surface turned = drawn_on.colour;
        turned.data = drawn.colour[CASE_HIGH - 1];
        turned.stride_bytes = -turned.stride_bytes;
        from.data = turned.data;
        from.stride_bytes = turned.stride_bytes;
        memcpy(drawn.colour, pixels, sizeof pixels);
        how.part[1] = CASE_HIGH - 20;
        CHECK(lmb_blit(&turned, 5 + dx, CASE_HIGH - 20 - dy, &from, &how) == LMB_OK);
        CHECK_MSG(memcmp(right, drawn.colour, sizeof right) == 0, "turned: %d %d, blends %d", dx, dy, blends);
    }
    lmb_blit_image self = image_of(drawn.colour, LMB_RGBA8, 8, 8, CASE_WIDE * 4);
    lmb_blit_how how = how_of(0, 0, 8, 8, 2, 0);
    const uint64_t hash = lmb_surface_hash(&drawn_on.colour);
    CHECK(lmb_blit(&drawn_on.colour, 1, 1, &self, &how) == LMB_ERR_ARG);
    self.format = LMB_BGRA8;
    CHECK(lmb_blit(&drawn_on.colour, 1, 1, &self, NULL) == LMB_ERR_ARG);
    CHECK(lmb_surface_hash(&drawn_on.colour) == hash);
    self.format = LMB_RGBA8;
    CHECK(lmb_blit(&drawn_on.colour, 10, 12, &self, &how) == LMB_OK && at(11, 13) == at(0, 0));
}

static void test_rules(void)
{
    static const uint8_t indices[2][4] = {{0, 1, 2, 255}, {3, 1, 0, 2}};
    static uint8_t palette[256][4];
    lmb_blit_image from = image_of(indices, LMB_BLIT_PALETTE8, 4, 2, 4);
    lmb_blit_how how = how_of(0, 0, 4, 2, 1, LMB_BLIT_KEY);
    for (int i = 0; i < 256; ++i) {
        palette[i][0] = (uint8_t)i, palette[i][1] = (uint8_t)(255 - i), palette[i][3] = (uint8_t)(i == 1 ? 128 : 255);
    }
    from.palette = &palette[0][0];
    how.key = 2;
    case_begin();
    memset(drawn.colour, 40, sizeof drawn.colour);
    CHECK(lmb_blit(&drawn_on.colour, 0, 0, &from, &how) == LMB_OK);
    CHECK(memcmp(drawn.colour[0][0], palette[0], 4) == 0 && memcmp(drawn.colour[0][1], palette[1], 4) == 0 &&
          drawn.colour[0][2][0] == 40 && memcmp(drawn.colour[0][3], palette[255], 4) == 0 &&
          drawn.colour[1][3][0] == 40);
    how.flags = LMB_BLIT_ALPHA;
    how.alpha = 128;
    memset(drawn.colour, 40, sizeof drawn.colour);
    CHECK(lmb_blit(&drawn_on.colour, 0, 0, &from, &how) == LMB_OK);
    const int share = (128 * 128 + 127) / 255;
    CHECK(drawn.colour[0][3][0] == (255 * 128 + 40 * 127 + 127) / 255 &&
          drawn.colour[0][3][3] == (255 * 128 + 40 * 127 + 127) / 255);
    CHECK(drawn.colour[0][1][1] == (254 * share + 40 * (255 - share) + 127) / 255);
    how.alpha = 0;
    const uint64_t hash = lmb_surface_hash(&drawn_on.colour);
    CHECK(lmb_blit(&drawn_on.colour, 0, 0, &from, &how) == LMB_OK && lmb_surface_hash(&drawn_on.colour) == hash);
}

/* Between all formats: white stays white, and 16-bit values survive a round trip. */
static void test_conversions(void)
{
    for (int a = LMB_RGB565; a <= LMB_BGRA8; ++a) {
        for (int b = LMB_RGB565; b <= LMB_BGRA8; ++b) {
            static uint32_t first[64], second[64], back[64];
            lmb_surface s, t, u;
            test_rng r = {1};
            CHECK(lmb_surface_init(&s, a, 8, 8, first, sizeof first) == LMB_OK);
            CHECK(lmb_surface_init(&t, b, 8, 8, second, sizeof second) == LMB_OK);
            CHECK(lmb_surface_init(&u, a, 8, 8, back, sizeof back) == LMB_OK);
            memset(back, 0, sizeof back);
            for (int i = 0; i < 64; ++i) {
                first[i] = test_random(&r) & (a == LMB_RGB555 ? 0x7fff7fffu : ~0u);
            }
            const lmb_blit_image from = image_of(first, a, 8, 8, s.stride_bytes),
                                 to = image_of(second, b, 8, 8, t.stride_bytes);
            CHECK(lmb_blit(&t, 0, 0, &from, NULL) == LMB_OK && lmb_blit(&u, 0, 0, &to, NULL) == LMB_OK);
            const int holds = a == b || (lmb_pixel_bytes(b) == 4) || (b != LMB_RGB555 && lmb_pixel_bytes(a) == 2);
            CHECK_MSG(!holds || lmb_surface_hash(&s) == lmb_surface_hash(&u), "%d by %d", a, b);
        }
    }
}

static void test_refused_blits(void)
{
    const lmb_blit_image good = image_of(pixels, LMB_RGBA8, 8, 8, 32);
    case_begin();
    for (int i = 0; i < 17; ++i) {
        lmb_blit_image from = good;
        lmb_blit_how how = how_of(0, 0, 8, 8, 1, 0);
        lmb_surface to = drawn_on.colour;
        lmb_status right = LMB_ERR_ARG;
        switch (i) {
        case 0:
            from.data = NULL;
            break;
        case 1:
            from.width = 0;
            break;
        case 2:
            from.height = LMB_MAX_SIDE + 1;
            break;
        case 3:
            from.stride_bytes = 28;
            break;
        case 4:
            from.stride_bytes = INT32_MIN;
            break;
        case 5:
            from.format = LMB_BLIT_PALETTE8;
            break;
        case 6:
            how.scale = 0;
            break;
        case 7:
            how.scale = 65;
            break;
        case 8:
            how.flags = 8;
            break;
        case 9:
            how.part[0] = 1;
            break;
        case 10:
            how.part[3] = 9;
            break;
        case 11:
            how.part[1] = -1;
            break;
        case 12:
            how.part[2] = INT32_MIN;
            break;
        case 13:
            to.data = NULL;
            break;
        case 14:
            from.format = LMB_RGB32F, right = LMB_ERR_FORMAT;
            break;
        case 15:
            to.format = LMB_DEPTH32F, right = LMB_ERR_FORMAT;
            break;
        default:
            from.data = (const uint8_t *)pixels + 2, right = LMB_ERR_ALIGN;
            break;
        }
        CHECK_MSG(lmb_blit(&to, 0, 0, &from, &how) == right, "%d", i);
    }
    CHECK(lmb_blit(NULL, 0, 0, &good, NULL) == LMB_ERR_ARG &&
          lmb_blit(&drawn_on.colour, 0, 0, NULL, NULL) == LMB_ERR_ARG);
    CHECK(drawn.colour[0][0][3] == 0 && case_guard_is_whole());
}

/* --- text --------------------------------------------------------------------------------------------------------- */

static void test_text_cells(void)
{
    static const uint8_t white[4] = {255, 255, 255, 255}, half[4] = {255, 255, 255, 128};
    static const char *const bar[8] = {"..#...", "..#...", "..#...", "..#...", "..#...", "......", "..#...", "......"};
    int wrong = 0, different = 0;
    case_begin();
    CHECK(lmb_text(&drawn_on.colour, 6, 8, "!", 2, white) == LMB_OK);
    for (int k = 0; k < 12 * 16; ++k) {
        wrong += (drawn.colour[8 + k / 12][6 + k % 12][0] == 255) != (bar[k / 24][k % 12 / 2] == '#');
    }
    CHECK(wrong == 0 && lmb_text_width("ab\nabc") == 18 && lmb_text_width("") == 0 && lmb_text_width(NULL) == 0);
    for (int c = 33; c < 127; ++c) { /* no character looks like another or like the box */
        for (int d = c + 1; d <= 127; ++d) {
            const char text[4] = {(char)c, '\n', (char)d, 0};
            int same = 1;
            memset(drawn.colour, 0, sizeof drawn.colour);
            different += lmb_text(&drawn_on.colour, 0, 0, text, 1, white) != LMB_OK;
            for (int y = 0; y < 8; ++y) {
                same &= memcmp(drawn.colour[y], drawn.colour[y + 8], 24) == 0;
            }
            different += !same;
        }
    }
    CHECK(different == 94 * 95 / 2);
    case_begin();
    CHECK(lmb_text(&drawn_on.colour, -3, CASE_HIGH - 4, "W\n\xff", 1, half) == LMB_OK && case_guard_is_whole());
    CHECK(drawn.colour[CASE_HIGH - 4][1][0] == 128);
    CHECK(lmb_text(&drawn_on.colour, INT32_MAX, INT32_MIN, "far\naway", 64, white) == LMB_OK);
    CHECK(lmb_text(&drawn_on.colour, 0, 0, NULL, 1, white) == LMB_ERR_ARG);
    CHECK(lmb_text(&drawn_on.colour, 0, 0, "a", 0, white) == LMB_ERR_ARG);
    CHECK(lmb_text(&drawn_on.colour, 0, 0, "a", 65, white) == LMB_ERR_ARG);
    CHECK(lmb_text(&drawn_on.colour, 0, 0, "a", 1, NULL) == LMB_ERR_ARG &&
          lmb_text(NULL, 0, 0, "a", 1, white) == LMB_ERR_ARG);
}

/* Each ink, in each order of the bytes, over any colours: an exact mix where white text is white, nothing elsewhere. */
static void test_text_inks(void)
{
    static const uint8_t white[4] = {255, 255, 255, 255};
    for (int32_t n = 0; n < 24; ++n) {
        const int32_t format = n % 2 ? LMB_RGBA8 : LMB_BGRA8, alpha = n % 3 == 0 ? 255 : n % 3 * 100 - 100;
        const int32_t x = n % 4 * ((CASE_WIDE - 6) / 3) + n / 12 * 3, y = n % 5 - 2;
        const uint8_t ink[4] = {200, 90, 30, (uint8_t)alpha};
        uint32_t is_text[CASE_HIGH][CASE_WIDE];
        int wrong = 0;
        fill((uint32_t)n + 1);
        CHECK(lmb_text(&drawn_on.colour, x, y, "W\n@", 1, white) == LMB_OK);
        memcpy(is_text, drawn.colour, sizeof is_text);
        memcpy(drawn.colour, pixels, sizeof is_text);
        drawn_on.colour.format = (uint8_t)format;
        CHECK(lmb_text(&drawn_on.colour, x, y, "W\n@", 1, ink) == LMB_OK && case_guard_is_whole());
        for (int32_t k = 0; k < 4 * CASE_HIGH * CASE_WIDE; ++k) {
            const int32_t px = k / 4 % CASE_WIDE, py = k / 4 / CASE_WIDE, i = k % 4;
            const int32_t was = ((const uint8_t *)&pixels[py][px])[i];
            const int32_t own = i == 3 ? 255 : ink[format == LMB_BGRA8 ? 2 - i : i];
            const int32_t mixed = (2 * (own * alpha + was * (255 - alpha)) + 255) / 510;
            const int in = is_text[py][px] != 0 && px >= x && px < x + 6;
            wrong += drawn.colour[py][px][i] != (in ? mixed : was);
        }
        CHECK_MSG(wrong == 0, "text %d: %d codes", n, wrong);
    }
}

void test_blit(void)
{
    test_text_inks();
    test_places();
    test_overlaps();
    test_rules();
    test_conversions();
    test_refused_blits();
    test_text_cells();
}

#else
void test_blit(void) { SKIP("a build without fixed-function drawing"); }
#endif
