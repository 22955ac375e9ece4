/* port_counted.c: a console's frames as a Linux program without libc, for qemu's user mode and the plugin
 * qemu_caches.c. It uses the same object files as the console, except for the port's own. Prints the
 * hashes; the plugin counts. */
#include "../demo/room.h"
#include "../demo/room_port.h"
#include "../port.h"

#if defined(COUNTED_N64)
#define N64_NO_CACHE_OPERATIONS
#include "../n64/lines_n64.h"
enum { WIDTH = 320, HEIGHT = 240, ROWS = COUNTED_ROWS, FORMAT = LMB_FIXED_RGBA5551 };
#elif defined(COUNTED_PS1)
enum { WIDTH = 320, HEIGHT = 240, ROWS = COUNTED_ROWS, FORMAT = LMB_FIXED_BGR555 };
#else
#include "../gamecube/port_gamecube.h"
enum { WIDTH = 640, HEIGHT = 480, ROWS = COUNTED_ROWS, FORMAT = LMB_FIXED_RGB888 };
#endif

const int32_t port_width = WIDTH, port_height = HEIGHT, port_rows = ROWS, port_format = FORMAT;
const char *const port_clock_unit = "nothing";

static uint32_t memory[65536] __attribute__((aligned(64)));
static uint32_t band[ROOM_BAND_BYTES(WIDTH, ROWS) / 4] __attribute__((aligned(64)));
static uint32_t screen[WIDTH * HEIGHT / 2] __attribute__((aligned(64), used));

/* --- the system --------------------------------------------------------------------------------------------------- */

static long call(long number, long a, long b, long c)
{
#if defined(__mips__)
    register long v0 __asm__("$2") = number, a0 __asm__("$4") = a, a1 __asm__("$5") = b, a2 __asm__("$6") = c;
    register long a3 __asm__("$7") = 0;
    __asm__ volatile("syscall" : "+r"(v0), "+r"(a3) : "r"(a0), "r"(a1), "r"(a2) : "memory", "$1", "$3", "$8", "$9",
                     "$10", "$11", "$12", "$13", "$14", "$15", "$24", "$25", "hi", "lo");
    return v0;
#else
    register long r0 __asm__("0") = number, r3 __asm__("3") = a, r4 __asm__("4") = b, r5 __asm__("5") = c;
    __asm__ volatile("sc" : "+r"(r0), "+r"(r3), "+r"(r4), "+r"(r5) : : "memory", "6", "7", "8", "9", "10", "11", "12",
                     "cr0", "ctr");
    return r3;
#endif
}

#if defined(__mips__)
#if _MIPS_SIM == _ABIN32
enum { WRITE = 6001, EXIT = 6058 };
#else
enum { WRITE = 4004, EXIT = 4001 };
#endif
#else
enum { WRITE = 4, EXIT = 1 };
#endif

void port_put(const char *text)
{
    long n = 0;
    while (text[n])
        ++n;
    call(WRITE, 1, (long)text, n);
}

void port_ram_used(port_ram *out) { out->data = out->bss = out->stack = out->size = 0; }
uint32_t port_clock(void) { return 0; }
uint32_t port_buttons(void) { return PORT_NO_BUTTONS; }

void *port_memory(size_t *bytes)
{
    *bytes = sizeof memory;
    return memory;
}

void *port_band_memory(size_t *bytes)
{
    *bytes = sizeof band;
    return band;
}

/* --- picture, as on the console ----------------------------------------------------------------------------------- */

uint16_t *port_screen_rows(int32_t y)
{
    uint16_t *rows = (uint16_t *)screen + y * WIDTH;
#if defined(COUNTED_N64)
    n64_make_lines(rows, (size_t)(HEIGHT - y < ROWS ? HEIGHT - y : ROWS) * WIDTH * sizeof *rows);
#endif
    return rows;
}

void port_show_band(void *user, const uint32_t *rgb, int32_t width, int32_t y, int32_t rows)
{
    (void)user;
#if defined(COUNTED_GAMECUBE)
    for (int32_t row = 0; row < rows; ++row)
        gamecube_row(screen + (y + row) * width / 2, rgb + row * width, width);
#else
    (void)rgb, (void)width, (void)y, (void)rows;
#endif
}

void port_show_frame(void)
{
#if defined(COUNTED_N64)
    n64_write_back();
#endif
}

/* --- calibration: checks the model on loops of known cost --------------------------------------------------------- */

void counted_turns(uint32_t n);
uint32_t counted_loads(const uint32_t *from, uint32_t n, uint32_t step);
uint32_t counted_products(uint32_t n);
void counted_end(void);

__attribute__((noinline)) void counted_turns(uint32_t n)
{
    for (; n; --n)
        __asm__ volatile("");
}

__attribute__((noinline)) uint32_t counted_loads(const uint32_t *from, uint32_t n, uint32_t step)
{
    uint32_t sum = 0;
    for (const uint32_t *past = from + n * step; from != past; from += step)
        sum += *from;
    return sum;
}

__attribute__((noinline)) uint32_t counted_products(uint32_t n)
{
    uint32_t v = n;
    for (; n; --n)
        v *= v;
    return v;
}

__attribute__((noinline)) void counted_end(void) { __asm__ volatile(""); }

#if defined(COUNTED_PS1)
/* At the console's address: see scratchpad_ps1.c. */
uint8_t counted_scratchpad[1024] __attribute__((section(".scratchpad,\"aw\",@nobits#"), used));
#endif

/* The stack ends at a multiple of 64 KiB, as on the console, so cache lines do not depend on
 * the system's environment. */
uint8_t counted_stack[65536] __attribute__((aligned(65536)));

#if defined(__mips__)
__asm__(".globl _start\n"
        "_start:\n"
        "\tla $29, counted_stack + 65536 - 64\n"
        "\tj counted_begin\n"
        "\tnop\n");
#else
__asm__(".globl _start\n"
        "_start:\n"
        "\tlis 1, (counted_stack + 65536 - 64)@ha\n"
        "\taddi 1, 1, (counted_stack + 65536 - 64)@l\n"
        "\tb counted_begin\n");
#endif

int main(void);
void counted_begin(void);

static volatile uint32_t kept;

void counted_begin(void)
{
    counted_turns(10000);
    counted_end();
    kept = counted_loads(screen, 1024, 1);
    counted_end();
    kept = counted_loads(screen, 1024, 1);
    counted_end();
    kept = counted_loads(screen, 1024, 16);
    counted_end();
    kept = counted_products(10000);
    counted_end();
    call(EXIT, main(), 0, 0);
    for (;;) {}
}
