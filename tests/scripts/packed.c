/* packed.c: draws a packed scene, linked in or read from a file, at a given time with the first camera, as PFM:
 * packed OUT.pfm TIME_S [FILE.lmp]. With LINKED the array is `scene_words`. */
#include <lambent/lambent.h>
#include <stdio.h>
#include <stdlib.h>

#ifdef LINKED
extern const uint32_t scene_words[];
extern const size_t scene_words_bytes;
#endif

enum { WIDE = 64, HIGH = 48 };

static const void *find_words(size_t *bytes, const char *path)
{
    static uint32_t from_file[1 << 18];
#ifdef LINKED
    if (path == NULL) {
        *bytes = scene_words_bytes;
        return scene_words;
    }
#endif
    FILE *file = path != NULL ? fopen(path, "rb") : NULL;
    *bytes = file != NULL ? fread(from_file, 1, sizeof from_file, file) : 0;
    if (file != NULL) {
        fclose(file);
    }
    return from_file;
}

int main(int argc, char **argv)
{
    static lmb_frame frame;
    static lmb_render render;
    static float pixels[HIGH][WIDE][3];
    const uint16_t one = 1;
    const int is_little = *(const uint8_t *)&one;
    const float time_s = argc > 2 ? (float)atof(argv[2]) : 0.0f;
    lmb_pack pack;
    lmb_scene scene;
    size_t bytes;
    const void *words = find_words(&bytes, argc > 3 ? argv[3] : NULL);
    lmb_status status = lmb_pack_open(&pack, words, bytes);
    void *memory = malloc(lmb_pack_bytes(&pack) + 1);
    lmb_frame_settings set = {.kernels = lmb_kernels_pick(), .scene = &scene, .show = LMB_SHOW_DIRECT, .shadow_map = 64};
    if (status == LMB_OK && memory != NULL) {
        status = lmb_pack_scene(&scene, &pack, memory, lmb_pack_bytes(&pack));
    }
    if (status == LMB_OK) {
        status = lmb_pack_pose(&scene, &pack, time_s);
    }
    if (status == LMB_OK) {
        status = lmb_pack_view(&set.view, &pack, &scene, 0, time_s, WIDE, HIGH);
    }
    if (status != LMB_OK) {
        printf("%s\n", lmb_status_name(status));
        return 1;
    }
    set.out.data = pixels;
    set.out.width = WIDE;
    set.out.height = HIGH;
    set.out.stride_bytes = (int32_t)sizeof pixels[0];
    set.out.format = LMB_RGB32F;
    bytes = lmb_frame_bytes(&set);
    void *room = malloc(bytes);
    FILE *file = argc > 1 ? fopen(argv[1], "wb") : NULL;
    if (room == NULL || file == NULL || lmb_frame_init(&frame, &set, room, bytes) != LMB_OK ||
        lmb_render_frame(&render, &frame) != LMB_OK) {
        return 1;
    }
    fprintf(file, "PF\n%d %d\n%s\n", WIDE, HIGH, is_little ? "-1.0" : "1.0");
    for (int y = HIGH - 1; y >= 0; --y) {
        fwrite(pixels[y], sizeof pixels[0], 1, file);
    }
    return fclose(file) != 0;
}
