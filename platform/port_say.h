/* port_say.h: prints numbers and a program's use of RAM by port_put. */
#ifndef PORT_SAY_H
#define PORT_SAY_H

#include "port.h"

static inline void say_hex(uint64_t v)
{
    char text[17];
    for (int i = 0; i < 16; ++i)
        text[i] = "0123456789abcdef"[(v >> (60 - 4 * i)) & 15];
    text[16] = 0;
    port_put(text);
}

/* Prints 32 bits as eight digits. */
static inline void say_word(uint32_t v)
{
    char text[9];
    for (int i = 0; i < 8; ++i)
        text[i] = "0123456789abcdef"[(v >> (28 - 4 * i)) & 15u];
    text[8] = 0;
    port_put(text);
}

static inline void say_number(uint32_t v)
{
    char text[11];
    int i = 10;
    text[i] = 0;
    do
        text[--i] = (char)('0' + v % 10);
    while (v /= 10);
    port_put(text + i);
}

static inline void say_count(const char *name, uint32_t v)
{
    port_put(name);
    say_number(v);
}

/* Prints a line with the name of an error; returns the program's status. */
static inline int say_error(const char *name)
{
    port_put(name);
    port_put("\n");
    return 1;
}

/* Prints a line if the port can measure RAM. Returns 1 if more is used than exists. */
static inline int say_ram(void)
{
    port_ram ram;
    port_ram_used(&ram);
    const uint32_t total = ram.data + ram.bss + ram.stack;
    if (!ram.size)
        return 0;
    say_count("ram ", total);
    say_count(" of ", ram.size);
    say_count(" bytes: data ", ram.data);
    say_count(", bss ", ram.bss);
    say_count(", stack ", ram.stack);
    port_put("\n");
    return total >= ram.size;
}

#endif
