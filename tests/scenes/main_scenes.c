/* main_scenes.c: generates a scene from its name.
 *
 *     scenes --list
 *     scenes NAME[:SEED] [--size N] [--rotate SEED|X,Y,Z,DEG] [--scale S] [--move X,Y,Z] -o DIR
 *
 * Writes scene.gltf and scene.bin for lambent, and scene.txt and scene.box for the path tracer of the truth, to DIR.
 * --rotate SEED draws an axis and an angle at random. Geometry, camera and lights are turned, then scaled, then moved
 * together, so the picture stays the same. --size: pixels a side of the truth. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"

static void list(void)
{
    for (int i = 0; i < scene_kind_count; ++i) {
        made_scene s;
        scene_make(&s, scene_kinds[i].name);
        printf("%-12s %-8s %6u triangles  %s\n", scene_kinds[i].name, scene_kinds[i].held_out ? "held-out" : "fitted",
               (unsigned)s.triangles, scene_kinds[i].what);
        scene_drop(&s);
    }
}

/* Returns 0 if the value is invalid. */
static int take_option(const char *option, const char *value, scene_place *p, int *size)
{
    double v[4];
    const int n = sscanf(value, "%lf,%lf,%lf,%lf", &v[0], &v[1], &v[2], &v[3]);
    if (strcmp(option, "--rotate") == 0 && n == 4) {
        scene_turn(p, at(v[0], v[1], v[2]), v[3]);
    } else if (strcmp(option, "--rotate") == 0 && n == 1) {
        scene_turn_any(p, (uint64_t)v[0]);
    } else if (strcmp(option, "--scale") == 0 && n == 1 && v[0] > 0) {
        p->scale = v[0];
    } else if (strcmp(option, "--move") == 0 && n == 3) {
        p->move = at(v[0], v[1], v[2]);
    } else if (strcmp(option, "--size") == 0 && n == 1 && v[0] >= 8 && v[0] <= 4096) {
        *size = (int)v[0];
    } else {
        return 0;
    }
    return 1;
}

int main(int argc, char **argv)
{
    const char *folder = NULL;
    scene_place place = scene_as_it_is();
    int size = 112;
    made_scene s;
    if (argc == 2 && strcmp(argv[1], "--list") == 0) {
        list();
        return 0;
    }
    for (int i = 2; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "-o") == 0) {
            folder = argv[i + 1];
        } else if (!take_option(argv[i], argv[i + 1], &place, &size)) {
            fprintf(stderr, "scenes: %s %s: see tests/scenes/main_scenes.c\n", argv[i], argv[i + 1]);
            return 2;
        }
    }
    if (folder == NULL || argc % 2 != 0) {
        fprintf(stderr, "usage: scenes --list | NAME[:SEED] [--size N] [--rotate SEED|X,Y,Z,DEG] [--scale S] "
                        "[--move X,Y,Z] -o DIR\n");
        return 2;
    }
    if (!scene_make(&s, argv[1])) {
        fprintf(stderr, "scenes: %s: no such kind; see --list\n", argv[1]);
        return 2;
    }
    scene_put(&s, &place);
    const int ok = scene_write(&s, folder, size);
    scene_drop(&s);
    return ok ? 0 : 1;
}
