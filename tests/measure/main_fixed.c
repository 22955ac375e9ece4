/* main_fixed.c: light by vertex in integers: makes the demo's blob, pictures of the room, and its error against
 * lmb_render.
 *
 *     measure-fixed write OUT.inc      the demo's blob, as the numbers of a C array
 *     measure-fixed picture N OUT.png  frame N of the room, 320 x 240
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/demo/room.h"
#include "../../tools/common/io_file.h"
#include "../../tools/demo/demo_scene.h"
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

int main(int argc, char **argv)
{
    report r = {""};
    vertex_light_options o = {0, 0, 0, 0};
    int ok;
    if (argc >= 3 && strcmp(argv[1], "write") == 0) {
        o.vertices = argc > 3 ? (uint32_t)atoi(argv[3]) : 0;
        o.elements = argc > 4 ? (uint32_t)atoi(argv[4]) : 0;
        o.links = argc > 5 ? (uint32_t)atoi(argv[5]) : 0;
        o.places = argc > 6 ? (uint32_t)atoi(argv[6]) : 0;
        ok = write_blob(argv[2], &o, &r);
    } else if (argc == 4 && strcmp(argv[1], "picture") == 0) {
        ok = picture(atoi(argv[2]), argv[3], &r);
    } else {
        fprintf(stderr, "measure-fixed: `write OUT.inc` or `picture N OUT.png`\n");
        return 2;
    }
    if (!ok) {
        fprintf(stderr, "measure-fixed: %s\n", r.text);
    }
    return !ok;
}
