/* screen_n64.c: a video plugin of mupen64plus without a window: writes the picture of the video interface to a file,
 * and prints the program's text. Built as a shared library for the host.
 *
 * ROOM_PICTURE names the file. When the program ends, it is written from the memory at the interface's registers. */
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../libretro/text_block.h"

/* --- the used part of the emulator's interface -------------------------------------------------------------------- */

typedef struct video_info {
    uint8_t *header, *rdram, *dmem, *imem;
    uint32_t *mi_interrupt, *dpc[8];
    uint32_t *control, *origin, *width, *interrupt, *line, *timing, *lines, *line_time, *leap, *across, *down, *burst,
        *scale_x, *scale_y;
    void (*check)(void);
} video_info;

enum { PLUGIN_VIDEO = 2, STOP = 6 };

static video_info video;
static int (*command)(int, int, void *);

int PluginStartup(void *core, void *context, void (*debug)(void *, int, const char *));
int PluginShutdown(void);
int PluginGetVersion(int *type, int *version, int *interface, const char **name, int *capabilities);
int InitiateGFX(video_info info);
int RomOpen(void);
void RomClosed(void);
void ChangeWindow(void);
void MoveScreen(int x, int y);
void ProcessDList(void);
void ProcessRDPList(void);
void ShowCFB(void);
void UpdateScreen(void);
void ViStatusChanged(void);
void ViWidthChanged(void);
void ReadScreen2(void *out, int *width, int *height, int front);
void SetRenderingCallback(void (*callback)(int));
void ResizeVideoOutput(int width, int height);
void FBRead(uint32_t address);
void FBWrite(uint32_t address, uint32_t size);
void FBGetFrameBufferInfo(void *info);

int PluginStartup(void *core, void *context, void (*debug)(void *, int, const char *))
{
    void *found = dlsym(core, "CoreDoCommand");
    (void)context, (void)debug;
    memcpy(&command, &found, sizeof command);
    return 0;
}

int PluginShutdown(void) { return 0; }

int PluginGetVersion(int *type, int *version, int *interface, const char **name, int *capabilities)
{
    if (type)
        *type = PLUGIN_VIDEO;
    if (version)
        *version = 0x10000;
    if (interface)
        *interface = 0x20200;
    if (name)
        *name = "screen into a file";
    if (capabilities)
        *capabilities = 0;
    return 0;
}

int InitiateGFX(video_info info)
{
    video = info;
    return 1;
}

int RomOpen(void) { return 1; }
void RomClosed(void) {}
void ChangeWindow(void) {}
void MoveScreen(int x, int y) { (void)x, (void)y; }
void ProcessDList(void) {}
void ProcessRDPList(void) {}
void ShowCFB(void) {}
void ViStatusChanged(void) {}
void ViWidthChanged(void) {}
void ReadScreen2(void *out, int *width, int *height, int front) { (void)out, (void)front, *width = *height = 0; }
void SetRenderingCallback(void (*callback)(int)) { (void)callback; }
void ResizeVideoOutput(int width, int height) { (void)width, (void)height; }
void FBRead(uint32_t address) { (void)address; }
void FBWrite(uint32_t address, uint32_t size) { (void)address, (void)size; }
void FBGetFrameBufferInfo(void *info) { memset(info, 0, 6 * 20); }

/* --- picture ------------------------------------------------------------------------------------------------------ */

enum { RDRAM_BYTES = 4 << 20, MOST = 640 };

/* RDRAM is stored in words of the host. */
static uint32_t word_at(uint32_t address)
{
    uint32_t word;
    memcpy(&word, video.rdram + (address & (RDRAM_BYTES - 1)), 4);
    return word;
}

static uint32_t half_at(uint32_t address) { return word_at(address & ~3u) >> (address & 2 ? 0 : 16) & 0xffffu; }

static uint8_t full(uint32_t five) { return (uint8_t)(five << 3 | five >> 2); }

/* As many pixels as the registers' ranges and scales show, sampled at whole positions. */
static int write_picture(const char *path)
{
    const uint32_t dots = (*video.across & 0x3ff) - (*video.across >> 16 & 0x3ff);
    const uint32_t halves = (*video.down & 0x3ff) - (*video.down >> 16 & 0x3ff);
    const uint32_t width = dots * (*video.scale_x & 0xfff) >> 10, height = halves * (*video.scale_y & 0xfff) >> 11;
    FILE *file;
    if ((*video.control & 3) != 2 || width == 0 || width > MOST || height == 0 || height > MOST) {
        fprintf(stderr, "screen_n64: the video interface shows no 16-bit picture\n");
        return 0;
    }
    if ((file = fopen(path, "wb")) == NULL) {
        perror(path);
        return 0;
    }
    fprintf(file, "P6\n%u %u\n255\n", width, height);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const uint32_t c = half_at(*video.origin + 2 * (y * *video.width + x));
            const uint8_t rgb[3] = {full(c >> 11), full(c >> 6 & 31), full(c >> 1 & 31)};
            fwrite(rgb, 1, 3, file);
        }
    return fclose(file) == 0;
}

/* --- text --------------------------------------------------------------------------------------------------------- */

/* Address of the program's text_block; 0: not found yet. */
static uint32_t find_text(void)
{
    static const uint32_t marks[TEXT_MARKS] = {TEXT_MARK(0), TEXT_MARK(1), TEXT_MARK(2), TEXT_MARK(3),
                                               TEXT_MARK(4), TEXT_MARK(5), TEXT_MARK(6), TEXT_MARK(7)};
    for (uint32_t at = 0; at < RDRAM_BYTES - sizeof(text_block); at += 64)
        if (memcmp(video.rdram + at, marks, sizeof marks) == 0)
            return at;
    return 0;
}

/* Once a field: prints new text; when the program has ended, writes the picture and stops the emulator. */
void UpdateScreen(void)
{
    static char said[TEXT_BYTES + 1];
    static uint32_t at, n;
    static int over;
    if (over || (at == 0 && (at = find_text()) == 0))
        return;
    for (const uint32_t bytes = word_at(at + 4 * TEXT_MARKS); n < bytes && n < TEXT_BYTES; ++n) {
        const uint32_t address = at + 4 * TEXT_MARKS + 4 + n;
        said[n] = (char)(word_at(address & ~3u) >> 8 * (3 - (address & 3)) & 255);
        putchar(said[n]);
    }
    fflush(stdout);
    if (strstr(said, "left: ") == NULL)
        return;
    over = 1;
    if (getenv("ROOM_PICTURE") != NULL && !write_picture(getenv("ROOM_PICTURE")))
        exit(1);
    command(STOP, 0, NULL);
}
