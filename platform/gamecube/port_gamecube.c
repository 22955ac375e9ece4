/* port_gamecube.c: the room's port to the GameCube: memory, picture by the video interface, controller, clock, text.
 *
 * Own start-up code, no SDK. The processor draws the picture, as YCbCr in RAM. */
#include "port_gamecube.h"

#include "../consoles/consoles.h"
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../port.h"

enum { WIDTH = 640, HEIGHT = 480, ROWS = 6 };

const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS,
              port_format = LMB_FIXED_RGB888;

static volatile uint32_t *reg(uint32_t address) { return (volatile uint32_t *)(uintptr_t)address; }
static volatile uint16_t *reg16(uint32_t address) { return (volatile uint16_t *)(uintptr_t)address; }

/* --- text and end ------------------------------------------------------------------------------------------------- */

#define EXI_SELECT (*reg(0xcc006800u))
#define EXI_CONTROL (*reg(0xcc00680cu))
#define EXI_DATA (*reg(0xcc006810u))
enum { SERIAL = 0x100 | 0x30, WRITE_ONE = 0x05, WRITE_FOUR = 0x35 };

static void exi_write(uint32_t data, uint32_t how)
{
    EXI_DATA = data;
    EXI_CONTROL = how;
    while (EXI_CONTROL & 1u) {}
}

/* The serial line of development consoles, behind the clock chip: a line ends with a carriage return. */
void port_put(const char *text)
{
    for (; *text; ++text) {
        EXI_SELECT = SERIAL;
        exi_write(0xa0010000u, WRITE_FOUR);
        exi_write((uint32_t)(*text == '\n' ? '\r' : *text) << 24, WRITE_ONE);
        EXI_SELECT = 0;
    }
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

const uint32_t console_ram_bytes = 24u << 20;

static uint32_t band[ROOM_BAND_BYTES(WIDTH, ROWS) / 4] __attribute__((aligned(32)));
static uint32_t screens[2][HEIGHT][WIDTH / 2] __attribute__((aligned(32)));
static uint32_t hidden, lit;

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

/* --- clock -------------------------------------------------------------------------------------------------------- */

const char *const port_clock_unit = "cycles";

/* The time base steps every 12 cycles: 40.5 of 486 MHz. */
uint32_t port_clock(void)
{
    uint32_t ticks;
    __asm__ volatile("mftb %0" : "=r"(ticks));
    return 12 * ticks;
}

/* --- picture ------------------------------------------------------------------------------------------------------ */

#define VI(n) (*reg16(0xcc002000u + (n)))
#define VI2(n) (*reg(0xcc002000u + (n)))
enum { TOP_FIELD = 0x1c, BOTTOM_FIELD = 0x24 };

/* NTSC, 640 x 480 in two fields of 240 lines. */
static void light_up(void)
{
    static const uint16_t timing[] = {0x0f06, 0x0001, 0x4769, 0x01ad, 0x02ea, 0x5140, 0x0003, 0x0018,
                                      0x0002, 0x0019, 0x410c, 0x410c, 0x40ed, 0x40ed};
    static const uint16_t filter[] = {0x1ae7, 0x71f0, 0x0db4, 0xa574, 0x00c1, 0x188e, 0xc4c0, 0xcbe2,
                                      0xfcec, 0xdecf, 0x1313, 0x0f08, 0x0008, 0x0c0f};
    for (uint32_t i = 0; i < sizeof timing / sizeof *timing; ++i)
        if (i != 1)
            VI(2 * i) = timing[i];
    VI(0x48) = 0x2850; /* 40 words of 16 pixels a line, lines of a field two apart */
    VI(0x4a) = 0x0100;
    for (uint32_t i = 0; i < sizeof filter / sizeof *filter; ++i)
        VI(0x4c + 2 * i) = filter[i];
    VI(0x6c) = 0;
    VI(2) = timing[1];
    lit = 1;
}

void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user;
    for (int32_t row = 0; row < rows; ++row)
        gamecube_row(screens[hidden][y + row], rgb + row * width, width);
}

uint16_t *port_screen_rows(int32_t y) { return (void)y, NULL; } /* only for a format of 16 bits */

/* Addresses in units of 32 bytes; they take effect with the next field. */
void port_show_frame(void)
{
    const uint32_t at = (uint32_t)(uintptr_t)screens[hidden] & 0x1ffffffu;
    __asm__ volatile("sync" : : : "memory");
    VI2(TOP_FIELD) = 0x10000000u | at >> 5;
    VI2(BOTTOM_FIELD) = 0x10000000u | (at + 2 * WIDTH) >> 5;
    if (!lit)
        light_up();
    hidden ^= 1;
}

/* --- controller --------------------------------------------------------------------------------------------------- */

#define SI(n) (*reg(0xcc006400u + (n)))
enum { SI_OUT = 0, SI_IN = 4, SI_POLL = 0x30, SI_STATUS = 0x38 };

/* The serial interface polls the controller by itself, twice a field. */
uint32_t port_buttons(void)
{
    static const uint32_t bits[ROOM_BUTTONS] = {0x00010000, 0x00020000, 0x00080000, 0x00040000,
                                                0x02000000, 0x04000000, 0x01000000, 0x08000000};
    static uint32_t asked;
    if (!asked) {
        SI(SI_OUT) = 0x00400300u;
        SI(SI_POLL) = 0x00f70280u;
        SI(SI_STATUS) = 0x80000000u;
        for (const uint32_t from_here = port_clock(); port_clock() - from_here < 486000000u / 20;) {}
        asked = 1;
    }
    const uint32_t state = SI(SI_IN);
    if (state & 0x90000000u) /* no controller, or Start: the end */
        return PORT_NO_BUTTONS;
    return room_held(state, bits);
}
