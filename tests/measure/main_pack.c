/* main_pack.c: compares packed scenes with their sources: time until each can be drawn, and whether a program that
 * opens the file draws the same as the tool. measure-pack SOURCE FILE.lmp prints one line. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/host/host.h"
#include "../../tools/common/io_file.h"
#include "../../tools/model/model.h"

enum { RUNS = 15, WIDE = 320, HIGH = 240 };

/* Seconds to read a model: the minimum of several runs. */
static double read_s(const char *path, report *r)
{
    double least = 1e9;
    for (int i = 0; i < RUNS; ++i) {
        model m;
        model_notes notes;
        const double start = host_seconds();
        if (!model_load(&m, path, NULL, &notes, r)) {
            return -1.0;
        }
        const double took = host_seconds() - start;
        least = took < least ? took : least;
        model_free(&m);
    }
    return least;
}

/* Seconds from a file in memory to a scene. */
static double open_s(lmb_scene *scene, lmb_pack *pack, const file_bytes *file, void *memory, size_t bytes)
{
    double least = 1e9;
    for (int i = 0; i < RUNS; ++i) {
        const double start = host_seconds();
        if (lmb_pack_open(pack, file->data, file->size) != LMB_OK || lmb_pack_bytes(pack) > bytes ||
            lmb_pack_scene(scene, pack, memory, bytes) != LMB_OK) {
            return -1.0;
        }
        const double took = host_seconds() - start;
        least = took < least ? took : least;
    }
    return least;
}

/* The hash of a picture with direct light, seen from a corner of the scene's box. */
static uint64_t draw(const lmb_scene *s)
{
    static lmb_frame frame;
    static lmb_render render;
    static const lmb_light sun = {.kind = LMB_LIGHT_DIRECTIONAL, .direction = {0.0f, -0.8f, -0.6f}, .intensity = {3, 3, 3}};
    lmb_scene lit = *s;
    lmb_frame_settings set;
    const lmb_vec3 up = {0, 1, 0}, low = s->bounds_min, high = s->bounds_max;
    const lmb_vec3 middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    const lmb_vec3 eye = {low.x + 0.9f * (high.x - low.x), low.y + 0.8f * (high.y - low.y), low.z + 0.9f * (high.z - low.z)};
    memset(&set, 0, sizeof set);
    lit.lights = lit.light_count > 0 ? lit.lights : &sun;
    lit.light_count = 1;
    set.kernels = lmb_kernels_pick();
    set.scene = &lit;
    set.show = LMB_SHOW_DIRECT;
    if (lmb_view_look_at(&set.view, eye, middle, up, 1.0f, WIDE, HIGH) != LMB_OK) {
        return 0;
    }
    const size_t bytes = lmb_frame_bytes(&set);
    void *memory = malloc(bytes);
    const int ok = memory != NULL && lmb_frame_init(&frame, &set, memory, bytes) == LMB_OK &&
                   lmb_render_frame(&render, &frame) == LMB_OK;
    const uint64_t hash = ok ? lmb_surface_hash(&frame.out) : 0;
    free(memory);
    return hash;
}

int main(int argc, char **argv)
{
    enum { MEMORY = 1 << 24 };
    report r = {""};
    file_bytes file = {NULL, 0};
    lmb_pack pack;
    lmb_scene scene;
    model m;
    model_notes notes;
    void *memory = malloc(MEMORY);
    if (argc != 3 || memory == NULL || !file_read(&file, argv[2], &r) || !model_load(&m, argv[2], NULL, &notes, &r)) {
        fprintf(stderr, "measure-pack: %s\n", r.text[0] != '\0' ? r.text : "SOURCE FILE.lmp");
        return 1;
    }
    const double source = strcmp(argv[1], "demo") == 0 ? 0.0 : read_s(argv[1], &r), packed = read_s(argv[2], &r),
                 opened = open_s(&scene, &pack, &file, memory, MEMORY);
    const uint64_t a = draw(&scene), b = draw(&m.scene);
    printf("  source read in %.3f ms, the .lmp in %.3f ms; opened in place in %.3f ms, %zu bytes of RAM; drawn: %016llx, %s\n",
           1e3 * source, 1e3 * packed, 1e3 * opened, lmb_pack_bytes(&pack), (unsigned long long)a,
           a != 0 && a == b ? "as the tool" : "ANOTHER PICTURE THAN THE TOOL");
    model_free(&m);
    file_free(&file);
    free(memory);
    return a == 0 || a != b;
}
