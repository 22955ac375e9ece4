/* port_ps1.c: the room's port to the PlayStation: memory, picture, controller, clock, text.
 *
 * No BIOS call and no SDK. The program draws the picture in RAM; the graphics processor only copies
 * it to its memory, by DMA. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../consoles/consoles.h"
#include "../libretro/text_block.h"
#include "../port.h"

/* One band, because there is no data cache that a smaller one would fit. */
enum { WIDTH = 320, HEIGHT = 240, ROWS = HEIGHT };

const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS, port_format = LMB_FIXED_BGR555;

static volatile uint32_t *reg(uint32_t address) { return (volatile uint32_t *)(uintptr_t)address; }
static volatile uint16_t *reg16(uint32_t address) { return (volatile uint16_t *)(uintptr_t)address; }
static volatile uint8_t *reg8(uint32_t address) { return (volatile uint8_t *)(uintptr_t)address; }

/* --- text and end ------------------------------------------------------------------------------------------------- */

static text_block said = TEXT_BLOCK;

void port_put(const char *text) { text_block_put(&said, text); }

/* --- memory ------------------------------------------------------------------------------------------------------- */

const uint32_t console_ram_bytes = 2u << 20;

static uint32_t band[ROOM_DEPTH_BYTES(WIDTH, ROWS) / 4];

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

/* --- clock -------------------------------------------------------------------------------------------------------- */

const char *const port_clock_unit = "cycles";

#define COUNT(n) (*reg(0x1f801100u + 16u * (n)))
#define COUNT_MODE(n) (*reg(0x1f801104u + 16u * (n)))
enum { LINE_CYCLES = 2153, WRAP = 8 * 65536 };

/* Counter 2 steps every 8 cycles and wraps after 15 ms; counter 1 steps with each line, and
 * gives the number of wraps. */
uint32_t port_clock(void)
{
    static uint32_t cycles, eights, lines, begun;
    if (!begun) {
        COUNT_MODE(1) = 0x100, COUNT_MODE(2) = 0x200;
        begun = 1;
    }
    const uint32_t e = COUNT(2) & 0xffffu, l = COUNT(1) & 0xffffu;
    const uint32_t fine = 8 * ((e - eights) & 0xffffu), coarse = LINE_CYCLES * ((l - lines) & 0xffffu);
    const uint32_t wraps = coarse + WRAP / 2 < fine ? 0 : (coarse + WRAP / 2 - fine) / WRAP;
    eights = e, lines = l;
    return cycles += fine + wraps * WRAP;
}

/* --- picture ------------------------------------------------------------------------------------------------------ */

#define GPU_DATA (*reg(0x1f801810u))
#define GPU_CONTROL (*reg(0x1f801814u))
#define DMA_FROM (*reg(0x1f8010a0u))
#define DMA_BLOCKS (*reg(0x1f8010a4u))
#define DMA_MODE (*reg(0x1f8010a8u))
#define DMA_ENABLED (*reg(0x1f8010f0u))
enum { BUSY = 0x01000000, TO_GPU = 0x201, BLOCK = 16 /* words */ };

static uint16_t picture[HEIGHT][WIDTH] __attribute__((aligned(4)));
static uint32_t hidden, lit; /* hidden: the half of the graphics memory that is not shown */

static void wait_for_dma(void)
{
    while (DMA_MODE & BUSY) {}
}

/* NTSC, 320 x 240 of 15 bits; the display is still off. */
static void light_up(void)
{
    static const uint32_t commands[] = {0x00000000, 0x08000001, 0x05000000, 0x06c58258, 0x07040010, 0x04000002};
    for (uint32_t i = 0; i < sizeof commands / sizeof *commands; ++i)
        GPU_CONTROL = commands[i];
    DMA_ENABLED |= 0x800;
    lit = 1;
}

uint16_t *port_screen_rows(int32_t y) { return picture[y]; }

static void send(void)
{
    while (!(GPU_CONTROL & 0x04000000u)) {}
    GPU_DATA = 0xa0000000u; /* copy to the graphics memory: place, size, pixels */
    GPU_DATA = hidden * 256u << 16;
    GPU_DATA = (uint32_t)HEIGHT << 16 | (uint32_t)WIDTH;
    DMA_FROM = (uint32_t)(uintptr_t)picture & 0x1fffffu;
    DMA_BLOCKS = (uint32_t)(WIDTH * HEIGHT / 2 / BLOCK) << 16 | BLOCK;
    DMA_MODE = BUSY | TO_GPU;
}

void port_show_frame(void)
{
    if (!lit)
        light_up();
    send();
    wait_for_dma();
    GPU_CONTROL = 0x05000000u | hidden * 256u << 10;
    GPU_CONTROL = 0x03000000u;
    hidden ^= 1;
}

/* --- controller --------------------------------------------------------------------------------------------------- */

#define PAD_DATA (*reg8(0x1f801040u))
#define PAD_STATUS (*reg(0x1f801044u))
#define PAD_MODE (*reg16(0x1f801048u))
#define PAD_CONTROL (*reg16(0x1f80104au))
#define PAD_RATE (*reg16(0x1f80104eu))
enum { TAKEN = 2, PATIENCE = 2000 };

static void pause(uint32_t turns)
{
    while (turns--)
        __asm__ volatile("");
}

/* One byte each way; 0xff if there is no answer. */
static uint32_t exchange(uint32_t byte)
{
    PAD_DATA = (uint8_t)byte;
    for (int i = 0; i < PATIENCE; ++i)
        if (PAD_STATUS & TAKEN) {
            const uint32_t got = PAD_DATA;
            pause(200);
            return got;
        }
    return 0xff;
}

uint32_t port_buttons(void)
{
    static const uint32_t bits[ROOM_BUTTONS] = {0x80, 0x20, 0x10, 0x40, 0x8000, 0x2000, 0x4000, 0x1000};
    PAD_CONTROL = 0x40;
    PAD_RATE = 0x88, PAD_MODE = 0x0d;
    PAD_CONTROL = 0x1003; /* enables both directions, which wait for a sent byte: receiving only would run ahead */
    (void)PAD_DATA;       /* discards old bytes; from here on bytes are received */
    pause(400);
    exchange(0x01);
    const uint32_t kind = exchange(0x42), mark = exchange(0);
    const uint32_t low = exchange(0), high = exchange(0), up = ~(low | high << 8) & 0xffffu;
    PAD_CONTROL = 0;
    if (kind == 0xff || mark != 0x5a || up & 8) /* no controller, or Start: the end */
        return PORT_NO_BUTTONS;
    return room_held(up, bits);
}
