/* port_gba.c: the room on a Game Boy Advance: its 240 x 160 screen, buttons, and a clock of processor cycles. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../freestanding/arm_calibrate.h"
#include "../libretro/text_block.h"
#include "../port.h"
#include "../port_say.h"
#include "gba.h"

enum { WIDTH = 240, HEIGHT = 160, ROWS = 27 };

const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS,
              port_format = LMB_FIXED_BGR555;
const char *const port_clock_unit = "cycles";

/* --- words -------------------------------------------------------------------------------------------------------- */

__attribute__((section(".ewram"))) static text_block text = TEXT_BLOCK;

void port_put(const char *words) { text_block_put(&text, words); }

/* --- memory ------------------------------------------------------------------------------------------------------- */

static uint32_t band[ROOM_DEPTH_BYTES(WIDTH, ROWS) / 4]; /* in fast RAM, the default */
static size_t taken;

/* The hidden screen is in front of the room's memory. */
static uint16_t *hidden(void) { return (uint16_t *)(void *)ewram_end; }

void *port_memory(size_t *bytes)
{
    uint32_t *begin = ewram_end + WIDTH * HEIGHT * 2 / 4;
    const size_t free_bytes = (size_t)(ewram_top - begin) * 4, wanted = room_bytes_kept(WIDTH, HEIGHT);
    *bytes = taken = wanted < free_bytes ? wanted : free_bytes;
    return begin;
}

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

void port_ram_used(port_ram *out)
{
    out->data = (uint32_t)((fast_end - fast_begin) + (data_end - data_begin) + (ewram_end - ewram_begin)) * 4;
    out->bss = (uint32_t)(bss_end - bss_begin) * 4 + WIDTH * HEIGHT * 2 + (uint32_t)taken;
    out->stack = handheld_stack();
    out->size = (32u << 10) + (256u << 10);
}

/* --- time --------------------------------------------------------------------------------------------------------- */

ARM_CALIBRATE

/* A load from slow RAM waits 5 cycles. */
void gba_begin(void)
{
    handheld_start_clock();
    const uint32_t from = port_clock();
    port_calibrate(ewram_begin);
    const uint32_t loops = port_clock() - from;
    port_calibrated();
    say_count("calibration: ", loops);
    say_count(" cycles, known ", 4 * CALIBRATE_TURNS + (7 + 5) * CALIBRATE_LOADS);
    port_put(" and a call\n");
}

/* --- screen ------------------------------------------------------------------------------------------------------- */

uint16_t *port_screen_rows(int32_t y) { return hidden() + y * WIDTH; }

void port_show_frame(void)
{
    REGISTER_16(DISPLAY_CONTROL) = 0x0403; /* mode 3, background 2 */
    REGISTER_32(DMA_3_FROM) = (uint32_t)(uintptr_t)hidden();
    REGISTER_32(DMA_3_TO) = VIDEO_RAM;
    REGISTER_32(DMA_3_COUNT) = DMA_NOW_BY_WORDS | WIDTH * HEIGHT / 2;
}
