/* main_golden.c: runs the golden pictures on any port: a line `name hash` each, then the counts.
 *
 * Freestanding: it runs where there is no libc. */
#include <stdint.h>

#include "../../platform/port.h"

int golden_run(void (*put)(const char *line));

static uint32_t line_count;

static void put_line(const char *line)
{
    port_put(line);
    port_put("\n");
    ++line_count;
}

static void put_number(uint32_t v)
{
    char text[11];
    int i = 10;
    text[i] = 0;
    do
        text[--i] = (char)('0' + v % 10);
    while (v /= 10);
    port_put(text + i);
}

int main(void)
{
    uint32_t wrong = (uint32_t)golden_run(put_line);
    put_number(line_count > wrong ? line_count - wrong : 0);
    port_put(" passed, ");
    put_number(wrong);
    port_put(" failed, 0 skipped\n");
    return wrong > 0 || !line_count;
}
