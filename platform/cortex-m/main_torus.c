/* main_torus.c: frames of a torus of 578 triangles on a floor, by content and size: RAM of the whole frame
 * (lmb_frame_bytes), and instructions if it is drawn; for the table of platform/README.md. */
#include <lambent/lambent.h>

#include "../../tests/torus.h"
#include "../port_say.h"
#include "count.h"

typedef struct feature {
    const char *name;
    int32_t show, quality, samples, by_bands;
} feature;

static const feature features[] = {
    {"direct", LMB_SHOW_DIRECT, LMB_QUALITY_FIXED, 1, 0},
    {"direct, 8 rows at a time", LMB_SHOW_DIRECT, LMB_QUALITY_FIXED, 1, 1},
    {"direct, 4 samples", LMB_SHOW_DIRECT, LMB_QUALITY_FIXED, 4, 0},
    {"bounced, fixed groups", LMB_SHOW_FULL, LMB_QUALITY_FIXED, 1, 0},
    {"bounced, a tree, draft", LMB_SHOW_FULL, LMB_QUALITY_DRAFT, 1, 0},
};
static const int32_t widths[] = {80, 160, 320};
enum {
    FEATURES = sizeof features / sizeof features[0],
    WIDTHS = sizeof widths / sizeof widths[0],
    DIRECT = 160,
    MAP = 128
};

/* Width and shadow map of the drawn frames with other light or samples; main_torus_few.c sets smaller ones. */
#ifndef OTHERS
#define OTHERS 160
#define OTHERS_MAP MAP
#endif

static uint64_t memory[350000];
static torus scene;
static lmb_render render;

static int take_band(void *user, const lmb_surface *band, int32_t y)
{
    (void)user, (void)band, (void)y;
    return 0;
}

static lmb_frame_settings settings_of(const feature *f, int32_t width)
{
    static const lmb_vec3 eye = {0.0f, 4.0f, 5.0f}, target = {0.0f, 0.6f, 0.0f}, up = {0.0f, 1.0f, 0.0f};
    lmb_frame_settings s;
    memset(&s, 0, sizeof s);
    s.kernels = lmb_kernels_pick();
    s.scene = &scene.scene;
    lmb_view_look_at(&s.view, eye, target, up, 0.8f, width, width * 3 / 4);
    s.format = LMB_RGB565;
    s.show = f->show;
    s.quality = f->quality;
    s.samples = f->samples;
    s.by_bands = f->by_bands;
    s.shadow_map = MAP;
    return s;
}

static void draw(const feature *f, const lmb_frame_settings *s)
{
    static lmb_frame frame;
    lmb_status status = lmb_frame_init(&frame, s, memory, sizeof memory);
    (void)f;
    frame.callback = s->by_bands ? take_band : NULL;
    count_start();
    if (status == LMB_OK)
        status = lmb_render_frame(&render, &frame);
    say_count(", instructions ", count_taken());
    port_put(" ");
    port_put(lmb_status_name(status));
    if (!s->by_bands) {
        port_put(" ");
        say_hex(lmb_surface_hash(&frame.out));
    }
}

int main(void)
{
    if (lmb_build_check() != LMB_OK)
        return 1;
    torus_make(&scene);
    say_count("lmb_render ", (uint32_t)sizeof render);
    say_count(", the scene ", (uint32_t)sizeof scene);
    port_put("\n");
    for (int i = 0; i < FEATURES; ++i)
        for (int k = 0; k < WIDTHS; ++k) {
            lmb_frame_settings s = settings_of(&features[i], widths[k]);
            port_put(features[i].name);
            say_count(" ", (uint32_t)widths[k]);
            say_count(" bytes ", (uint32_t)lmb_frame_bytes(&s));
            if (widths[k] == (i == 0 ? DIRECT : OTHERS)) {
                s.shadow_map = i == 0 ? MAP : OTHERS_MAP;
                draw(&features[i], &s);
            }
            port_put("\n");
        }
    return 0;
}
