/* room_pixel.c: the built-in scene with its baked light, drawn by lmb_render from a pose. */
#include "room_pixel.h"

#include "../../tools/demo/demo_scene.h"

/* The words of the file from `lambent bake demo`. */
static const uint32_t baked[] = {
#include "room_pixel.inc"
};

static lmb_status place_surfaces(room_pixel *r, uint32_t *memory)
{
    const size_t row = 4 * (size_t)r->width;
    lmb_frame *f = &r->frame;
    lmb_status s = lmb_surface_init(&f->out, LMB_RGBA8, r->width, ROOM_PIXEL_BAND, memory, row * ROOM_PIXEL_BAND);
    memory += r->width * ROOM_PIXEL_BAND;
    if (s == LMB_OK)
        s = lmb_surface_init(&f->eye.depth, LMB_DEPTH32F, r->width, ROOM_PIXEL_STRIP, memory, row * ROOM_PIXEL_STRIP);
    memory += r->width * ROOM_PIXEL_STRIP;
    if (s == LMB_OK)
        s = lmb_surface_init(&f->eye.id, LMB_ID16, r->width, ROOM_PIXEL_STRIP, memory, row * ROOM_PIXEL_STRIP / 2);
    memory += r->width * ROOM_PIXEL_STRIP / 2;
    f->map_memory = memory;
    f->map_bytes = 4 * (size_t)ROOM_PIXEL_MAP_WORDS;
    memory += ROOM_PIXEL_MAP_WORDS;
    if (s == LMB_OK)
        s = lmb_transfer_light_init(&f->transfer_light, &r->transfer, memory, 4 * (size_t)ROOM_PIXEL_LIGHT_WORDS);
    return s;
}

static int put_band(void *user, const lmb_surface *rows, int32_t y)
{
    room_pixel *r = user;
    uint32_t *word = rows->data;
    const int32_t count = rows->width * rows->height;
    for (int32_t i = 0; i < count; ++i) {
        const uint8_t *c = (const uint8_t *)&word[i];
        word[i] = (uint32_t)c[0] << 16 | (uint32_t)c[1] << 8 | c[2];
    }
    const uint32_t from = r->clock ? r->clock() : 0;
    r->put(r->user, word, rows->width, y, rows->height);
    const uint32_t taken = r->clock ? r->clock() - from : 0;
    r->taken[ROOM_PIXEL_SHOWN] += taken;
    r->from += taken;
    return 0;
}

lmb_status room_pixel_open(room_pixel *out, int32_t width, int32_t height, uint32_t *memory)
{
    static const room_pixel nothing;
    *out = nothing;
    out->width = width, out->height = height;
    out->scene = *demo_scene();
    out->lamp.kind = LMB_LIGHT_POINT;
    for (int i = 0; i < 3; ++i)
        out->lamp.intensity[i] = 9.424778f; /* a white surface at 1 m is three times as bright as white */
    out->scene.lights = &out->lamp;
    lmb_status s = width % 8 == 0 && height % 8 == 0 ? lmb_build_check() : LMB_ERR_ARG;
    if (s == LMB_OK)
        s = lmb_transfer_open(&out->transfer, baked, sizeof baked);
    if (s == LMB_OK)
        s = lmb_transfer_fits(&out->transfer, &out->scene);
    if (s == LMB_OK)
        s = place_surfaces(out, memory);
    if (s == LMB_OK)
        s = lmb_transfer_materials(&out->frame.transfer_light, &out->transfer, &out->scene);
    out->frame.kernels = lmb_kernels_pick();
    out->frame.scene = &out->scene;
    out->frame.transfer = &out->transfer;
    out->frame.shadow_map = ROOM_PIXEL_MAP;
    out->frame.id_format = LMB_ID16;
    out->frame.scratch = &out->scratch;
    out->frame.callback = put_band;
    out->frame.user = out;
    return s;
}

/* Sine of an angle in 1/65536 of a turn: the Taylor series to x^9, with an error under 4e-6. */
static float sine(int32_t angle)
{
    int32_t a = (int32_t)((uint32_t)angle & 65535u);
    a = a < 16384 ? a : a < 49152 ? 32768 - a : a - 65536; /* to a quarter turn each way */
    const float x = (float)a * 9.58737992e-5f, square = x * x;
    float s = square * 2.7557319e-6f - 1.9841270e-4f;
    s = s * square + 8.3333333e-3f;
    s = s * square - 0.16666667f;
    return x + x * square * s;
}

static float cosine(int32_t angle) { return sine(angle + 16384); }

static lmb_status place(room_pixel *r, const room_pose *pose)
{
    const float metre = 1.0f / 1024.0f, level = cosine(pose->pitch), vfov_rad = 0.872664626f; /* 50 degrees */
    const lmb_vec3 eye = {(float)pose->eye[0] * metre, (float)pose->eye[1] * metre, (float)pose->eye[2] * metre};
    const lmb_vec3 target = {eye.x - sine(pose->yaw) * level, eye.y + sine(pose->pitch),
                             eye.z - cosine(pose->yaw) * level};
    const lmb_vec3 up = {0, 1, 0};
    r->lamp.position.x = (float)pose->lamp[0] * metre;
    r->lamp.position.y = (float)pose->lamp[1] * metre;
    r->lamp.position.z = (float)pose->lamp[2] * metre;
    ++r->lamp.revision;
    return lmb_view_look_at(&r->frame.view, eye, target, up, vfov_rad, r->width, r->height);
}

static int stage_of(int32_t stage)
{
    return stage == LMB_STAGE_SHADOW_MAP ? ROOM_PIXEL_MAPPED
           : stage < LMB_STAGE_VIEW      ? ROOM_PIXEL_LIT
                                         : ROOM_PIXEL_FILLED;
}

lmb_status room_pixel_draw(room_pixel *r, const room_pose *pose, room_put *put, void *user)
{
    r->put = put, r->user = user;
    for (int i = 0; i < ROOM_PIXEL_STAGES; ++i)
        r->taken[i] = 0;
    r->from = r->clock ? r->clock() : 0;
    lmb_status s = place(r, pose);
    if (s == LMB_OK)
        s = lmb_render_begin(&r->render, &r->frame);
    for (int more = s == LMB_OK; more;) {
        const int stage = stage_of(r->render.stage);
        s = lmb_render_step(&r->render, ROOM_PIXEL_BAND);
        more = s == LMB_MORE;
        if (r->clock) {
            const uint32_t now = r->clock();
            r->taken[stage] += now - r->from;
            r->from = now;
        }
    }
    return s;
}
