/* start_web.c: entry (run) and output (put) of a WebAssembly program, and two functions of libm. */
#include "../port.h"

__attribute__((import_module("env"), import_name("put"))) void host_put(const char *text);
__attribute__((export_name("run"))) int run(void);

int main(void);
float sqrtf(float x);
float floorf(float x);

int run(void) { return main(); }

void port_put(const char *text) { host_put(text); }

void port_ram_used(port_ram *out)
{
    const port_ram unknown = {0, 0, 0, 0};
    *out = unknown;
}

/* One instruction each: f32.sqrt, f32.floor. */
float sqrtf(float x) { return __builtin_sqrtf(x); }
float floorf(float x) { return __builtin_floorf(x); }
