/* bare_room.c: room_port.h on a machine without operating system: 160 x 120 in RGB565 in memory, as for a display;
 * files of the debugger, or qemu, are accessed by semihosting.
 *
 * The program's command line, if there is one, is `room COUNTS PICTURE [all]`: qemu_count.c puts its counts into
 * COUNTS; PICTURE gets the last picture as PPM, or with `all` each picture behind the other. `-` means no file. */
#include "../demo/room_port.h"

#include <string.h>

#include "../demo/room.h"
#include "bare.h"

#ifndef BARE_ROWS
#define BARE_ROWS 8
#endif
#ifndef BARE_ROOM_BYTES
#define BARE_ROOM_BYTES 18432 /* room_bytes of the size below */
#endif

enum { WIDTH = 160, HEIGHT = 120, LINE = 512 };
const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = BARE_ROWS,
              port_format = LMB_FIXED_RGB888;

static uint32_t memory[BARE_ROOM_BYTES / 4], band[WIDTH * BARE_ROWS * 6 / 4];
static uint16_t screen[HEIGHT][WIDTH];

void *port_memory(size_t *bytes) { return *bytes = sizeof memory, memory; }
void *port_band_memory(size_t *bytes) { return *bytes = sizeof band, band; }

/* --- files of the host -------------------------------------------------------------------------------------------- */

enum { SYS_OPEN = 0x01, SYS_WRITE = 0x05, SYS_READ = 0x06, SYS_SEEK = 0x0a, SYS_GET_CMDLINE = 0x15 };
enum { READ_BYTES = 1, WRITE_BYTES = 5 }; /* "rb", "wb" */
#define NO_FILE (~(uintptr_t)0)

static uintptr_t call(uint32_t operation, uintptr_t a, uintptr_t b, uintptr_t c)
{
    uintptr_t block[3];
    block[0] = a, block[1] = b, block[2] = c;
    return semihost(operation, block);
}

static char line[LINE];
static uintptr_t counts = NO_FILE, picture = NO_FILE;
static int is_all;

/* The next word of the line, terminated by 0, and its length. */
static char *next_word(char **at, uint32_t *length)
{
    char *word = *at, *past;
    while (*word == ' ')
        ++word;
    for (past = word; *past != ' ' && *past != 0;)
        ++past;
    *length = (uint32_t)(past - word);
    *at = *past ? past + 1 : past;
    *past = 0;
    return word;
}

static uintptr_t open_file(char **at, uint32_t mode)
{
    uint32_t length;
    const char *name = next_word(at, &length);
    if (length == 0 || (length == 1 && name[0] == '-'))
        return NO_FILE;
    const uintptr_t file = call(SYS_OPEN, (uintptr_t)name, mode, length);
    return (uint32_t)file == 0xffffffffu ? NO_FILE : file;
}

static void open_files(void)
{
    static int is_open;
    if (is_open)
        return;
    is_open = 1;
    if ((uint32_t)call(SYS_GET_CMDLINE, (uintptr_t)line, sizeof line - 1, 0) != 0)
        return;
    char *at = line;
    uint32_t length;
    next_word(&at, &length);
    counts = open_file(&at, READ_BYTES);
    picture = open_file(&at, WRITE_BYTES);
    next_word(&at, &length);
    is_all = length != 0;
}

/* --- the clock: the counter of qemu's plugin ---------------------------------------------------------------------- */

static char unit[16] = "of no clock";
const char *const port_clock_unit = unit;

/* The plugin detects calls of this function. */
void bare_mark(void);
__attribute__((noinline)) void bare_mark(void) { __asm__ volatile("" ::: "memory"); }

uint32_t port_clock(void)
{
    uint8_t said[4 + sizeof unit];
    open_files();
    if (counts == NO_FILE)
        return 0;
    memset(said, 0, sizeof said);
    bare_mark();
    call(SYS_SEEK, counts, 0, 0);
    call(SYS_READ, counts, (uintptr_t)said, sizeof said - 1);
    memcpy(unit, said + 4, sizeof unit);
    return said[0] | (uint32_t)said[1] << 8 | (uint32_t)said[2] << 16 | (uint32_t)said[3] << 24;
}

/* --- the screen ---------------------------------------------------------------------------------------------------- */

void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user;
    for (int32_t i = 0; i < rows; ++i)
        room_rgb565(screen[y + i], rgb + i * width, width, y + i);
}

uint16_t *port_screen_rows(int32_t y) { return (void)y, NULL; } /* only for a format of 16 bits */

void port_show_frame(void)
{
    static const char head[] = "P6\n160 120\n255\n";
    uint8_t row[WIDTH][3];
    open_files();
    if (picture == NO_FILE)
        return;
    if (!is_all)
        call(SYS_SEEK, picture, 0, 0);
    call(SYS_WRITE, picture, (uintptr_t)head, sizeof head - 1);
    for (int32_t y = 0; y < HEIGHT; ++y) {
        for (int32_t x = 0; x < WIDTH; ++x) {
            const uint32_t c = screen[y][x], red = c >> 11, green = c >> 5 & 63u, blue = c & 31u;
            row[x][0] = (uint8_t)(red << 3 | red >> 2);
            row[x][1] = (uint8_t)(green << 2 | green >> 4);
            row[x][2] = (uint8_t)(blue << 3 | blue >> 2);
        }
        call(SYS_WRITE, picture, (uintptr_t)row, sizeof row);
    }
}

uint32_t port_buttons(void) { return PORT_NO_BUTTONS; }
