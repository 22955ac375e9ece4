/* main_fixed.c: light by vertex in integers: makes the demo's blob, pictures of the room, and its error against
 * lmb_render.
 *
 *     measure-fixed write OUT.inc      the demo's blob, as the numbers of a C array
 *     measure-fixed picture N OUT.png  frame N of the room, 320 x 240
 *     measure-fixed linear SCENE FRAME BOUNCES full|indirect GAIN OUT.pfm
 *                                      a frame's radiance; prints the camera and lamp of the room's frame as the
 *                                      tool's options
 */
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
    printf("%u words, %u vertices, %u triangles (%u hidden left out), %u elements, %u links, %u of %u places, %.3f m apart\n",
           (unsigned)count, (unsigned)facts.vertices, (unsigned)facts.triangles, (unsigned)facts.hidden,
           (unsigned)facts.elements, (unsigned)facts.links, (unsigned)facts.valid, (unsigned)facts.places,
           facts.spacing_m);
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
    static uint32_t band[WIDTH * ROWS * 6 / 4];
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
    room_draw(&shown, &pose, keep, NULL);
    printf("frame %d %08x, %u triangles\n", (int)frame, (unsigned)hash, (unsigned)shown.frame.seen_count);
    const int ok = png_encode(&file, rgb, WIDTH, HEIGHT, r) && file_write(path, file.data, file.size, r);
    file_free(&file);
    free(memory);
    return ok;
}

/* --- against lmb_render ------------------------------------------------------------------------------------------- */

static int32_t whole(double v) { return (int32_t)floor(v + 0.5); }

/* A camera and a light in a blob's units; `gain`: of what is shown, so that nothing is beyond white. */
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

/* Frame N of the room as the tool has it: its camera and lamp. */
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
    printf("--eye %.6f,%.6f,%.6f --target %.6f,%.6f,%.6f --fov 50 --light point:%.6f,%.6f,%.6f:0,-1,0:%g,%g,%g\n",
           (double)eye.x, (double)eye.y, (double)eye.z, (double)to.x, (double)to.y, (double)to.z, (double)l->position.x,
           (double)l->position.y, (double)l->position.z, (double)l->intensity[0], (double)l->intensity[1],
           (double)l->intensity[2]);
}

/* What `bounces` show; less what the lamp alone does, where is_indirect. */
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

typedef struct errors_of {
    const char *scene, *out;
    int32_t frame, bounces, is_indirect;
    double gain;
    vertex_light_options o;
} errors_of;

static int linear(const errors_of *e, report *r)
{
    static uint32_t pixel[WIDTH * HEIGHT];
    static uint16_t depth[WIDTH * HEIGHT];
    model m;
    model_notes notes;
    lmb_view view;
    lmb_light light;
    lmb_fixed s;
    lmb_fixed_frame f;
    vertex_light_facts facts;
    uint32_t *words = NULL, count;
    file_bytes file = {NULL, 0};
    image picture_of = {WIDTH, HEIGHT, 3, NULL};
    memset(&m, 0, sizeof m);
    memset(&notes, 0, sizeof notes);
    memset(&f, 0, sizeof f);
    const int is_demo = strcmp(e->scene, "demo") == 0;
    if (!is_demo && !model_load(&m, e->scene, NULL, &notes, r)) {
        return 0;
    }
    if (is_demo) {
        room_frame(&view, &light, e->frame);
    } else if (m.camera_count == 0 || m.scene.light_count == 0) {
        return report_fail(r, "%s: has no camera or no light", e->scene);
    } else {
        const model_camera *c = &m.cameras[0];
        light = m.scene.lights[0];
        const lmb_vec3 to = {c->eye.x - c->back.x, c->eye.y - c->back.y, c->eye.z - c->back.z};
        lmb_view_look_at(&view, c->eye, to, c->up, c->yfov_rad, WIDTH, HEIGHT);
        printf("\n");
    }
    int ok = vertex_light_make(&words, &count, &facts, is_demo ? demo_scene() : &m.scene, &e->o, r);
    ok = ok && lmb_fixed_open(&s, words, 4 * (size_t)count) == LMB_OK;
    void *memory = ok ? malloc(lmb_fixed_memory(&s, s.triangles)) : NULL;
    picture_of.pixels = calloc((size_t)3 * WIDTH * HEIGHT, sizeof(float));
    ok = ok && memory != NULL && picture_of.pixels != NULL &&
         lmb_fixed_lay(&f, &s, s.triangles, memory, lmb_fixed_memory(&s, s.triangles)) == LMB_OK;
    if (ok) {
        set_frame(&f, &view, &light, e->gain);
        f.pixel = pixel;
        f.depth = depth;
        ok = draw_linear(picture_of.pixels, &f, e->bounces, 1.0f, e->gain, r) &&
             (!e->is_indirect || draw_linear(picture_of.pixels, &f, 0, -1.0f, e->gain, r)) &&
             pfm_encode(&file, &picture_of, r) && file_write(e->out, file.data, file.size, r);
    }
    fprintf(stderr, "%u words, %u vertices, %u triangles, %u elements, %u links, %u of %u places %.3f m apart\n",
            (unsigned)count, (unsigned)facts.vertices, (unsigned)facts.triangles, (unsigned)facts.elements,
            (unsigned)facts.links, (unsigned)facts.valid, (unsigned)facts.places, facts.spacing_m);
    file_free(&file);
    free(picture_of.pixels);
    free(memory);
    free(words);
    model_free(&m);
    return ok || report_fail(r, "%s: cannot be drawn", e->scene);
}

/* --- */

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
        set_options(&o, argv + 3);
        ok = write_blob(argv[2], &o, &r);
    } else if (argc == 4 && strcmp(argv[1], "picture") == 0) {
        ok = picture(atoi(argv[2]), argv[3], &r);
    } else if (argc >= 8 && strcmp(argv[1], "linear") == 0) {
        errors_of e = {argv[2], argv[7], atoi(argv[3]), atoi(argv[4]), strcmp(argv[5], "indirect") == 0, atof(argv[6]), o};
        set_options(&e.o, argv + 8);
        ok = linear(&e, &r);
    } else {
        fprintf(stderr, "measure-fixed: `write OUT.inc [VERTICES ELEMENTS LINKS PLACES]`, `picture N OUT.png` or\n"
                        "  `linear SCENE FRAME BOUNCES full|indirect GAIN OUT.pfm [VERTICES ..]`\n");
        return 2;
    }
    if (!ok) {
        fprintf(stderr, "measure-fixed: %s\n", r.text);
    }
    return !ok;
}
