/* port_linux_fb.c: the room on Linux's framebuffer device, without a window system: 16 or 32 bits a pixel, in
 * the middle of the screen.
 *
 * Environment: FB_DEVICE (default /dev/fb0); FB_FILE replaces it by a plain file of FB_SIZE, "320x240x16" (or x32), for
 * the screen's memory; FB_SECONDS: how long the last picture stays after the path. */
#define _XOPEN_SOURCE 700 /* clock_gettime, ftruncate */
#include <fcntl.h>
#include <linux/fb.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "../demo/room.h"
#include "../demo/room_port.h"

enum { WIDTH = 320, HEIGHT = 240, ROWS = 16, ROOM_BYTES = 65536 };
const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS,
              port_format = LMB_FIXED_RGB888;
const char *const port_clock_unit = "us";

static uint32_t memory[ROOM_BYTES / 4], band[WIDTH * ROWS * 6 / 4];
static struct {
    unsigned char *data; /* of the screen */
    uint32_t width, height, line, bits; /* px, px, bytes, bits a pixel */
    struct fb_bitfield red, green, blue;
} screen;

static int refuse(const char *name, const char *why)
{
    fprintf(stderr, "linux-fb: %s: %s\n", name, why);
    exit(1);
    return 0;
}

static void ask_device(int file, const char *name)
{
    struct fb_var_screeninfo var;
    struct fb_fix_screeninfo fix;
    if (ioctl(file, FBIOGET_VSCREENINFO, &var) != 0 || ioctl(file, FBIOGET_FSCREENINFO, &fix) != 0)
        refuse(name, "no framebuffer; set FB_DEVICE");
    screen.width = var.xres, screen.height = var.yres, screen.line = fix.line_length, screen.bits = var.bits_per_pixel;
    screen.red = var.red, screen.green = var.green, screen.blue = var.blue;
}

static void make_file(int file, const char *name)
{
    static const struct fb_bitfield of_16[] = {{11, 5, 0}, {5, 6, 0}, {0, 5, 0}};
    static const struct fb_bitfield of_32[] = {{16, 8, 0}, {8, 8, 0}, {0, 8, 0}};
    const char *size = getenv("FB_SIZE");
    if (sscanf(size ? size : "320x240x16", "%ux%ux%u", &screen.width, &screen.height, &screen.bits) != 3 ||
        screen.width > 16384 || screen.height > 16384 || (screen.bits != 16 && screen.bits != 32))
        refuse(name, "FB_SIZE is WIDTHxHEIGHTx16 or x32");
    const struct fb_bitfield *f = screen.bits == 16 ? of_16 : of_32;
    screen.red = f[0], screen.green = f[1], screen.blue = f[2];
    screen.line = screen.width * screen.bits / 8;
    if (ftruncate(file, (off_t)screen.line * screen.height) != 0)
        refuse(name, "cannot be made as long as the screen");
}

static void open_screen(void)
{
    const char *plain = getenv("FB_FILE"), *device = getenv("FB_DEVICE");
    const char *name = plain ? plain : device ? device : "/dev/fb0";
    const int file = plain ? open(name, O_RDWR | O_CREAT | O_TRUNC, 0666) : open(name, O_RDWR);
    if (file < 0)
        refuse(name, "cannot be opened for writing");
    if (plain)
        make_file(file, name);
    else
        ask_device(file, name);
    if (screen.width < WIDTH || screen.height < HEIGHT || (screen.bits != 16 && screen.bits != 32))
        refuse(name, "needs 320x240 pixels of 16 or 32 bits");
    screen.data = mmap(NULL, (size_t)screen.line * screen.height, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (screen.data == MAP_FAILED)
        refuse(name, "cannot be mapped");
}

void *port_memory(size_t *bytes)
{
    open_screen();
    *bytes = sizeof memory;
    return memory;
}

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

uint32_t port_clock(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint32_t)((uint64_t)t.tv_sec * 1000000u + (uint64_t)t.tv_nsec / 1000u);
}

/* 16 bits: room_rgb565 if the screen has that format. Otherwise the upper bits of each colour. */
static void put_row(unsigned char *to, const uint32_t *rgb, int32_t width, int32_t y)
{
    if (screen.bits == 16 && screen.red.offset == 11 && screen.green.offset == 5 && screen.green.length == 6) {
        room_rgb565((uint16_t *)(void *)to, rgb, width, y);
        return;
    }
    for (int32_t x = 0; x < width; ++x) {
        const uint32_t c = (rgb[x] >> 16 & 255u) >> (8 - screen.red.length) << screen.red.offset |
                           (rgb[x] >> 8 & 255u) >> (8 - screen.green.length) << screen.green.offset |
                           (rgb[x] & 255u) >> (8 - screen.blue.length) << screen.blue.offset;
        if (screen.bits == 16)
            ((uint16_t *)(void *)to)[x] = (uint16_t)c;
        else
            ((uint32_t *)(void *)to)[x] = c;
    }
}

void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user;
    const uint32_t left = (screen.width - WIDTH) / 2, top = (screen.height - HEIGHT) / 2;
    for (int32_t i = 0; i < rows; ++i)
        put_row(screen.data + (size_t)(top + (uint32_t)(y + i)) * screen.line + left * screen.bits / 8, rgb + i * width,
                width, y + i);
}

uint16_t *port_screen_rows(int32_t y) { return (void)y, NULL; } /* only for a format of 16 bits */

void port_show_frame(void) {}

/* No keyboard is read, so no button is held during FB_SECONDS. */
uint32_t port_buttons(void)
{
    static time_t end;
    const char *seconds = getenv("FB_SECONDS");
    if (end == 0)
        end = time(NULL) + (seconds ? atoi(seconds) : 0);
    return time(NULL) < end ? 0 : PORT_NO_BUTTONS;
}
