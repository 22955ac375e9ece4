/* main_golden.c: runs the golden pictures on any port; prints the backends, a line `name hash` each, then the counts.
 *
 * A build that lmb_build_check refuses draws nothing. If the port measures its stack, prints the depth too.
 *
 * Freestanding, for systems without libc. */
#include "../../platform/port_say.h"
#include "golden.h"

static uint32_t line_count;

static void put_line(const char *line)
{
    port_put(line);
    port_put("\n");
    ++line_count;
}

static void put_backends(void)
{
    const lmb_kernels *kernels;
    port_put("backends:");
    for (int32_t i = 0; (kernels = lmb_kernels_at(i)) != NULL; ++i) {
        port_put(" ");
        port_put(lmb_kernels_name(kernels));
    }
    port_put("\n");
}

static void put_stack(void)
{
    port_ram ram;
    port_ram_used(&ram);
    if (ram.size > 0) {
        port_put("stack at its deepest: ");
        say_number(ram.stack);
        port_put(" bytes\n");
    }
}

int main(void)
{
    lmb_status s = lmb_build_check();
    if (s != LMB_OK) {
        port_put("lmb_build_check: ");
        port_put(lmb_status_name(s));
        port_put("\n0 passed, 1 failed, 0 skipped\n");
        return 1;
    }
    put_backends();
    uint32_t wrong = (uint32_t)golden_run(&golden_whole, put_line);
    put_stack();
    say_number(line_count > wrong ? line_count - wrong : 0);
    port_put(" passed, ");
    say_number(wrong);
    port_put(" failed, 0 skipped\n");
    return wrong > 0 || !line_count;
}
