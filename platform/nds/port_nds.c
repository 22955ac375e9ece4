/* port_nds.c: the room on a Nintendo DS: its upper screen of 256 x 192, buttons, and a clock of bus cycles. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../freestanding/arm_calibrate.h"
#include "../libretro/text_block.h"
#include "../port.h"
#include "nds.h"

enum { WIDTH = 256, HEIGHT = 192, ROWS = 8 };

const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS,
              port_format = LMB_FIXED_BGR555;
const char *const port_clock_unit = "bus cycles";

/* --- words -------------------------------------------------------------------------------------------------------- */

static text_block text = TEXT_BLOCK;

void port_put(const char *words) { text_block_put(&text, words); }

/* --- memory ------------------------------------------------------------------------------------------------------- */

__attribute__((section(".near"))) static uint32_t band[ROOM_DEPTH_BYTES(WIDTH, ROWS) / 4];

/* The rest of the memory that holds the code. */
void *port_memory(size_t *bytes)
{
    *bytes = (size_t)(fast_top - fast_end) * 4;
    return fast_end;
}

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

void port_ram_used(port_ram *out)
{
    out->data = (uint32_t)((data_end - image_begin) + (fast_top - fast_begin)) * 4; /* includes the program, which is in
                                                                                     * RAM */
    out->bss = (uint32_t)((bss_end - bss_begin) + (near_end - near_begin)) * 4;
    out->stack = handheld_stack();
    out->size = (4096u + 32u + 16u) << 10;
}

/* --- time --------------------------------------------------------------------------------------------------------- */

ARM_CALIBRATE

/* --- screen ------------------------------------------------------------------------------------------------------- */

static uint32_t hidden; /* the hidden bank */

void nds_begin(void)
{
    handheld_start_clock();
    port_calibrate((const uint32_t *)0x02000000);
    port_calibrated();
    REGISTER_16(POWER) = 0x8203;        /* both screens, the main one above */
    REGISTER_8(BANK_A) = 0x80;          /* banks A and B are mapped to the processor and shown unchanged */
    REGISTER_8(BANK_A + 1) = 0x80;
}

/* The bank ignores writes of bytes, but takes halfwords and words. */
uint16_t *port_screen_rows(int32_t y) { return (uint16_t *)(VIDEO_RAM + hidden * BANK_BYTES) + y * WIDTH; }

void port_show_frame(void)
{
    REGISTER_32(DISPLAY_CONTROL) = 0x00020000u | hidden << 18;
    hidden ^= 1;
}
