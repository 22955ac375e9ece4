/* main_fixed.c: light at vertices in integers. Makes the demo's blob and pictures of the room, and measures the
 * error against lmb_render.
 *
 *     measure-fixed write OUT.inc [VERTICES ELEMENTS LINKS PLACES]
 *                                      the demo's blob as a C array; default: the settings of the ports' room
 *     measure-fixed picture N OUT.png  frame N of the room, 320 x 240
 *     measure-fixed options SCENE FRAME   the frame's camera and lamp as options of `lambent render`
 *     measure-fixed errors SCENE FOLDER GAIN [VERTICES ELEMENTS LINKS PLACES]
 *                                      against FOLDER/FRAME_bBOUNCES_direct|full|indirect.pfm; GAIN avoids clipping */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/demo/room.h"
#include "../../tools/common/io_file.h"
#include "../../tools/demo/demo_scene.h"
#include "../../tools/model/model.h"
#include "../../tools/pack/vertex_light.h"
#include "../../tools/picture/image.h"
#include "../../tools/picture/metrics.h"

static void say_facts(uint32_t words, const vertex_light_facts *f)
{
    printf("%u words, %u vertices, %u triangles (%u of the hull, %u hidden left out), %u elements, %u links, %u of %u places, "
           "%.3f m apart\n",
           (unsigned)words, (unsigned)f->vertices, (unsigned)f->triangles, (unsigned)f->hull, (unsigned)f->hidden,
           (unsigned)f->elements, (unsigned)f->links, (unsigned)f->valid, (unsigned)f->places, f->spacing_m);
}

static int write_blob(const char *path, const vertex_light_options *o, report *r)
{
    uint32_t *words, count;
    vertex_light_facts facts;
    if (!vertex_light_make(&words, &count, &facts, demo_scene(), o, r)) {
        return 0;
    }
    FILE *f = fopen(path, "w");
    if (f == NULL) {
        free(words);
        return report_fail(r, "%s: cannot be written", path);
    }
    for (uint32_t i = 0; i < count; ++i) {
        fprintf(f, "0x%08x,%s", (unsigned)words[i], i % 10 == 9 ? "\n" : " ");
    }
    fprintf(f, "\n");
    free(words);
    say_facts(count, &facts);
    return fclose(f) == 0 || report_fail(r, "%s: cannot be written", path);
}

enum { WIDTH = 320, HEIGHT = 240, ROWS = 16 };
static uint8_t rgb[3 * WIDTH * HEIGHT];
static uint32_t hash;

static void keep(void *user, const uint32_t *pixel, int32_t width, int32_t y, int32_t rows)
{
    (void)user;
    hash = room_hash(hash, pixel, width * rows);
    for (int32_t i = 0; i < width * rows; ++i) {
        uint8_t *out = rgb + 3 * (y * width + i);
        out[0] = (uint8_t)(pixel[i] >> 16), out[1] = (uint8_t)(pixel[i] >> 8), out[2] = (uint8_t)pixel[i];
    }
}

static int picture(int32_t frame, const char *path, report *r)
{
    static uint32_t band[ROOM_BAND_BYTES(WIDTH, ROWS) / 4];
    room shown;
    room_pose pose;
    file_bytes file = {NULL, 0};
    const size_t bytes = room_bytes(WIDTH, HEIGHT);
    void *memory = malloc(bytes);
    hash = ROOM_HASH;
    if (memory == NULL || room_open(&shown, WIDTH, HEIGHT, ROWS, memory, bytes, band, sizeof band) != 0) {
        free(memory);
        return report_fail(r, "the room does not open");
    }
    room_path(&pose, frame);
    room_see(&shown, &pose);
    room_put_bands(&shown, keep, NULL);
    printf("frame %d %08x, %u triangles\n", (int)frame, (unsigned)hash, (unsigned)shown.frame.seen_count);
    const int ok = png_encode(&file, rgb, WIDTH, HEIGHT, r) && file_write(path, file.data, file.size, r);
    file_free(&file);
    free(memory);
    return ok;
}

/* --- against lmb_render ------------------------------------------------------------------------------------------- */

static int32_t whole(double v) { return (int32_t)floor(v + 0.5); }

/* Sets a camera and a light in a blob's units. `gain` scales the light so that no pixel exceeds white. */
static void set_frame(lmb_fixed_frame *f, const lmb_view *v, const lmb_light *l, double gain)
{
    const lmb_fixed *s = f->scene;
    const double per = ldexp(1.0, s->units_log2);
    const lmb_vec3 axis[3] = {v->right, v->up, v->back};
    const float eye[3] = {v->eye.x, v->eye.y, v->eye.z}, at[3] = {l->position.x, l->position.y, l->position.z},
                way[3] = {l->direction.x, l->direction.y, l->direction.z};
    for (int i = 0; i < 3; ++i) {
        f->view.eye[i] = whole(per * (double)eye[i]) - s->origin[i];
        f->view.axis[i][0] = whole(16384.0 * (double)axis[i].x);
        f->view.axis[i][1] = whole(16384.0 * (double)axis[i].y);
        f->view.axis[i][2] = whole(16384.0 * (double)axis[i].z);
        f->lamp.position[i] = whole(per * (double)at[i]) - s->origin[i];
        f->lamp.direction[i] = l->kind == LMB_LIGHT_SPOT ? whole(16384.0 * (double)way[i]) : 0;
        f->lamp.intensity[i] = (uint32_t)whole(LMB_FIXED_WHITE * gain * (double)l->intensity[i] / 3.141592653589793);
    }
    f->lamp.cos_inner = l->kind == LMB_LIGHT_SPOT ? whole(16384.0 * (double)l->cos_inner) : 0;
    f->lamp.cos_outer = l->kind == LMB_LIGHT_SPOT ? whole(16384.0 * (double)l->cos_outer) : 0;
    f->view.width = v->frame_width;
    f->view.height = v->frame_height;
    f->view.focal = whole(8.0 * v->frame_height / (double)v->half_height);
    f->view.near_units = whole(0.06 * per) > 16 ? whole(0.06 * per) : 16;
}

/* Frame N of the room. */
static void room_frame(lmb_view *v, lmb_light *l, int32_t n)
{
    room_pose pose;
    room_path(&pose, n);
    const double turn = pose.yaw * 6.283185307179586 / 65536.0, tilt = pose.pitch * 6.283185307179586 / 65536.0;
    const lmb_vec3 eye = {(float)(pose.eye[0] / 1024.0), (float)(pose.eye[1] / 1024.0), (float)(pose.eye[2] / 1024.0)},
                   up = {0, 1, 0},
                   to = {eye.x - (float)(sin(turn) * cos(tilt)), eye.y + (float)sin(tilt),
                         eye.z - (float)(cos(turn) * cos(tilt))};
    memset(l, 0, sizeof *l);
    l->position.x = (float)(pose.lamp[0] / 1024.0), l->position.y = (float)(pose.lamp[1] / 1024.0);
    l->position.z = (float)(pose.lamp[2] / 1024.0);
    l->intensity[0] = l->intensity[1] = l->intensity[2] = 9.42477796f;
    lmb_view_look_at(v, eye, to, up, 0.872664626f, WIDTH, HEIGHT);
}

/* Prints the frame as options of the tool. */
static void say_frame(const lmb_view *v, const lmb_light *l)
{
    printf("--eye %.6f,%.6f,%.6f --target %.6f,%.6f,%.6f --fov %.6f --light %s:%.6f,%.6f,%.6f:%.6f,%.6f,%.6f:%g,%g,%g",
           (double)v->eye.x, (double)v->eye.y, (double)v->eye.z, (double)(v->eye.x - v->back.x),
           (double)(v->eye.y - v->back.y), (double)(v->eye.z - v->back.z),
           atan((double)v->half_height) * 360.0 / 3.141592653589793, l->kind == LMB_LIGHT_SPOT ? "spot" : "point",
           (double)l->position.x, (double)l->position.y, (double)l->position.z, (double)l->direction.x,
           (double)l->direction.y, (double)l->direction.z + (l->kind == LMB_LIGHT_SPOT ? 0.0 : 1.0),
           (double)l->intensity[0], (double)l->intensity[1], (double)l->intensity[2]);
    if (l->kind == LMB_LIGHT_SPOT) {
        printf(":%.6f,%.6f", acos((double)l->cos_inner) * 180.0 / 3.141592653589793,
               acos((double)l->cos_outer) * 180.0 / 3.141592653589793);
    }
    printf("\n");
}

/* --- scenes ------------------------------------------------------------------------------------------------------- */

typedef struct subject {
    const char *name;
    model m;
    int is_demo;
} subject;

static int load(subject *s, const char *name, report *r)
{
    model_notes notes;
    memset(s, 0, sizeof *s);
    memset(&notes, 0, sizeof notes);
    s->name = name;
    s->is_demo = strcmp(name, "demo") == 0;
    return s->is_demo || model_load(&s->m, name, NULL, &notes, r);
}

/* A scene from a file has one camera and one light, so all frames are equal. */
static int pose(lmb_view *v, lmb_light *l, const subject *s, int32_t frame, report *r)
{
    if (s->is_demo) {
        room_frame(v, l, frame);
        return 1;
    }
    if (s->m.camera_count == 0 || s->m.scene.light_count == 0) {
        return report_fail(r, "%s: has no camera or no light", s->name);
    }
    const model_camera *c = &s->m.cameras[0];
    const lmb_vec3 to = {c->eye.x - c->back.x, c->eye.y - c->back.y, c->eye.z - c->back.z};
    *l = s->m.scene.lights[0];
    lmb_view_look_at(v, c->eye, to, c->up, c->yfov_rad, WIDTH, HEIGHT);
    return 1;
}

/* Adds `sign` times the picture with `bounces`. */
static int draw_linear(float *out, lmb_fixed_frame *f, int32_t bounces, float sign, double gain, report *r)
{
    f->bounces = bounces;
    if (lmb_fixed_transform(f) != LMB_OK || lmb_fixed_light(f) != LMB_OK || lmb_fixed_band(f, 0, HEIGHT) != LMB_OK) {
        return report_fail(r, "the frame is refused");
    }
    for (int32_t i = 0; i < 3 * WIDTH * HEIGHT; ++i) {
        const int code = (int)(f->pixel[i / 3] >> (16 - 8 * (i % 3)) & 255u);
        out[i] += sign * (float)(srgb_decode(code) / gain);
    }
    return 1;
}

/* Compares with FOLDER/FRAME_bBOUNCES_WHAT.pfm, if the file exists. */
static int compare(lmb_fixed_frame *f, const char *folder, int32_t frame, int32_t bounces, const char *what, double gain,
                   report *r)
{
    static float own[3 * WIDTH * HEIGHT];
    char path[512];
    image truth;
    file_bytes file = {NULL, 0};
    metrics m;
    report missing = {""};
    snprintf(path, sizeof path, "%s/%d_b%d_%s.pfm", folder, (int)frame, (int)bounces, what);
    if (!file_read(&file, path, &missing)) {
        return 1;
    }
    int ok = pfm_decode(&truth, file.data, file.size, path, r);
    const metrics_input in = {own, truth.pixels, NULL, NULL, WIDTH, HEIGHT, 3};
    memset(own, 0, sizeof own);
    ok = ok && draw_linear(own, f, strcmp(what, "direct") == 0 ? 0 : bounces, 1.0f, gain, r) &&
         (strcmp(what, "indirect") != 0 || draw_linear(own, f, 0, -1.0f, gain, r)) && metrics_measure(&m, &in, r);
    if (ok) {
        printf("frame %2d, bounces %d, %-8s  trim %.3f  rmse %.3f  e50 %.3f  mean %.3f\n", (int)frame, (int)bounces, what,
               m.trim, m.rmse, m.e50, m.mean);
    }
    file_free(&file);
    image_free(&truth);
    return ok;
}

static int errors(subject *s, const char *folder, double gain, const vertex_light_options *o, report *r)
{
    static uint32_t pixel[WIDTH * HEIGHT];
    static uint16_t depth[WIDTH * HEIGHT];
    static const int32_t frames[3] = {0, 30, 59};
    static const char *const whats[3] = {"direct", "full", "indirect"};
    lmb_fixed blob;
    lmb_fixed_frame f;
    vertex_light_facts facts;
    uint32_t *words = NULL, count;
    void *memory = NULL;
    memset(&f, 0, sizeof f);
    int ok = vertex_light_make(&words, &count, &facts, s->is_demo ? demo_scene() : &s->m.scene, o, r) &&
             lmb_fixed_open(&blob, words, 4 * (size_t)count) == LMB_OK;
    memory = ok ? malloc(lmb_fixed_memory(&blob, blob.triangles)) : NULL;
    ok = ok && memory != NULL &&
         lmb_fixed_lay(&f, &blob, blob.triangles, memory, lmb_fixed_memory(&blob, blob.triangles)) == LMB_OK;
    f.pixel = pixel;
    f.depth = depth;
    if (ok) {
        say_facts(count, &facts);
    }
    for (int i = 0; i < (s->is_demo ? 3 : 1) && ok; ++i) {
        lmb_view view;
        lmb_light light;
        ok = pose(&view, &light, s, frames[i], r);
        if (ok) {
            set_frame(&f, &view, &light, gain);
        }
        for (int32_t bounces = 1; bounces <= 3 && ok; bounces += 2) {
            for (int k = 0; k < 3 && ok; ++k) {
                ok = compare(&f, folder, frames[i], bounces, whats[k], gain, r);
            }
        }
    }
    free(memory);
    free(words);
    return ok || report_fail(r, "%s: cannot be drawn", s->name);
}

static int say_options(const subject *s, int32_t frame, report *r)
{
    lmb_view view;
    lmb_light light;
    if (!pose(&view, &light, s, frame, r)) {
        return 0;
    }
    say_frame(&view, &light);
    return 1;
}

/* --- */

/* The ports' room. Chosen only on the demo, by its cost and looks on consoles. */
static const vertex_light_options room_options = {560, 192, 20, 512};

static void set_options(vertex_light_options *o, char **at)
{
    uint32_t *const to[4] = {&o->vertices, &o->elements, &o->links, &o->places};
    for (int i = 0; i < 4 && *at != NULL; ++i, ++at) {
        *to[i] = (uint32_t)atoi(*at);
    }
}

int main(int argc, char **argv)
{
    report r = {""};
    vertex_light_options o = {0, 0, 0, 0};
    int ok;
    if (argc >= 3 && strcmp(argv[1], "write") == 0) {
        o = room_options;
        set_options(&o, argv + 3);
        ok = write_blob(argv[2], &o, &r);
    } else if (argc == 4 && strcmp(argv[1], "picture") == 0) {
        ok = picture(atoi(argv[2]), argv[3], &r);
    } else if (argc >= 4 && (strcmp(argv[1], "errors") == 0 || strcmp(argv[1], "options") == 0)) {
        const int is_errors = strcmp(argv[1], "errors") == 0;
        subject s;
        if (strcmp(argv[2], "demo") == 0) {
            o = room_options;
        }
        if (is_errors && argc > 5) {
            set_options(&o, argv + 5);
        }
        ok = load(&s, argv[2], &r) && (is_errors ? errors(&s, argv[3], argc > 4 ? atof(argv[4]) : 0.25, &o, &r)
                                                 : say_options(&s, atoi(argv[3]), &r));
        model_free(&s.m);
    } else {
        fprintf(stderr, "measure-fixed: `write OUT.inc [VERTICES ELEMENTS LINKS PLACES]`, `picture N OUT.png`,\n"
                        "  `options SCENE FRAME` or `errors SCENE FOLDER GAIN [VERTICES ..]`\n");
        return 2;
    }
    if (!ok) {
        fprintf(stderr, "measure-fixed: %s\n", r.text);
    }
    return !ok;
}
