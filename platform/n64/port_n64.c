/* port_n64.c: the room's port to the Nintendo 64: memory, picture by the video interface, controller, clock, text.
 *
 * Own start-up code (start_n64.S), no SDK. Pictures are in RDRAM as RGBA5551; a band's lines of 16 bytes are allocated
 * in the data cache without being fetched. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../consoles/consoles.h"
#include "../libretro/text_block.h"
#include "../port.h"
#include "../port_say.h"
#include "lines_n64.h"

enum { WIDTH = 320, HEIGHT = 240, ROWS = 12 };

const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS,
              port_format = LMB_FIXED_RGBA5551;

/* --- registers and uncached RDRAM --------------------------------------------------------------------------------- */

static volatile uint32_t *reg(uint32_t address) { return (volatile uint32_t *)(uintptr_t)address; }
static uint32_t physical(const volatile void *p) { return (uint32_t)(uintptr_t)p & 0x1fffffffu; }

#define VI(n) (*reg(0xa4400000u + 4 * (n)))
enum { VI_CONTROL, VI_ORIGIN, VI_WIDTH, VI_INTERRUPT, VI_LINE };

#define SI(n) (*reg(0xa4800000u + 4 * (n)))
enum { SI_RAM, SI_READ, SI_WRITE = 4, SI_STATUS = 6 };

/* --- video interface ------------------------------------------------------------------------------------------- */

static uint32_t lit; /* whether the video interface is on */

/* NTSC, 320 x 240 of 16 bits: no anti-aliasing, each pixel on two dots. */
static void light_up(void)
{
    static const uint32_t from_interrupt[] = {0x200,      0,       0x03e52239, 0x20d,      0xc15,
                                              0x0c150c15, 0x6c02ec, 0x220202, 0x0e0204, 0x200, 0x400};
    VI(VI_CONTROL) = 0x3202;
    VI(VI_WIDTH) = WIDTH;
    for (uint32_t i = 0; i < sizeof from_interrupt / sizeof *from_interrupt; ++i)
        VI(VI_INTERRUPT + i) = from_interrupt[i];
    lit = 1;
}

/* --- text and end ------------------------------------------------------------------------------------------------- */

/* In separate cache lines, because it is written uncached. */
static text_block said __attribute__((aligned(64), section(".data.said"))) = TEXT_BLOCK;

/* The text port of a development cartridge, which emulators support too; others ignore it. */
static void viewer_put(const char *text)
{
    uint32_t n = 0, word = 0;
    for (; text[n]; ++n) {
        word |= (uint32_t)(uint8_t)text[n] << (24 - 8 * (n & 3));
        if ((n & 3) == 3 || text[n + 1] == 0) {
            *reg(0xb3ff0020u + (n & ~3u)) = word;
            word = 0;
        }
    }
    *reg(0xb3ff0014u) = n;
}

/* Emulators read text once a field, and there are no fields before the video interface is on. */
void port_put(const char *text)
{
    if (!lit)
        light_up();
    text_block_put((text_block *)((uintptr_t)&said | 0x20000000u), text);
    viewer_put(text);
}

/* Called by the start-up on an exception. */
void n64_fault(uint32_t cause, uint32_t at, uint32_t wanted);

void n64_fault(uint32_t cause, uint32_t at, uint32_t wanted)
{
    say_count("fault ", cause >> 2 & 31u);
    port_put(" at ");
    say_word(at);
    port_put(" of ");
    say_word(wanted);
    port_put("\nleft: failed\n");
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

const uint32_t console_ram_bytes = 4u << 20;

static uint32_t band[ROOM_DEPTH_BYTES(WIDTH, ROWS) / 4] __attribute__((aligned(16)));
static uint16_t screens[2][HEIGHT][WIDTH] __attribute__((aligned(64)));
static uint32_t hidden; /* the hidden screen */

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

/* --- clock -------------------------------------------------------------------------------------------------------- */

const char *const port_clock_unit = "cycles";

/* Count is incremented every second cycle of the processor. */
uint32_t port_clock(void)
{
    uint32_t count;
    __asm__ volatile("mfc0 %0, $9" : "=r"(count));
    return 2 * count;
}

/* --- picture ------------------------------------------------------------------------------------------------------ */

uint16_t *port_screen_rows(int32_t y)
{
    n64_make_lines(screens[hidden][y], sizeof screens[hidden][y] * (size_t)(HEIGHT - y < ROWS ? HEIGHT - y : ROWS));
    return screens[hidden][y];
}

/* The current field still reads the other screen; the change takes effect with the next. */
void port_show_frame(void)
{
    n64_write_back();
    VI(VI_ORIGIN) = physical(screens[hidden]);
    if (!lit)
        light_up();
    hidden ^= 1;
}

/* --- controller --------------------------------------------------------------------------------------------------- */

/* Commands for the joybus processor: controller 0: send 1 byte (1: state), receive 4; end of commands; go. */
static uint32_t pif[16] __attribute__((aligned(16)));

static void pif_transfer(uint32_t direction)
{
    SI(SI_RAM) = physical(pif);
    SI(direction) = 0x1fc007c0u;
    while (SI(SI_STATUS) & 3u) {}
    SI(SI_STATUS) = 0;
}

uint32_t port_buttons(void)
{
    static const uint32_t bits[ROOM_BUTTONS] = {0x02000000u, 0x01000000u, 0x08000000u, 0x04000000u,
                                                0x00020000u, 0x00010000u, 0x00040000u, 0x00080000u};
    volatile uint32_t *block = reg((uint32_t)(uintptr_t)pif | 0x20000000u);
    for (uint32_t i = 0; i < 16; ++i)
        block[i] = 0;
    block[0] = 0xff010401u, block[1] = 0xffffffffu, block[2] = 0xfe000000u, block[15] = 1;
    pif_transfer(SI_WRITE);
    pif_transfer(SI_READ);
    if (block[0] >> 8 & 0x80u) /* no answer: no controller */
        return PORT_NO_BUTTONS;
    return block[1] & 0x10000000u ? PORT_NO_BUTTONS : room_held(block[1], bits); /* Start: the end */
}
