/* gl_names.c: calls by their names, and calls that are not offered. No prototypes: all are void f(void) here. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>

typedef void (*gl_proc)(void);
enum { NAMES_SLOTS = 64, NAMES_BYTES = 48 };
void gl_refuse(const char *name);
char *gl_missing_name(int slot); /* the current context's; NULL: no context or no slot left */
gl_proc OSMesaGetProcAddress(const char *name);
gl_proc glXGetProcAddressARB(const unsigned char *name);
gl_proc glXGetProcAddress(const unsigned char *name);

#define OFFERED(name) void name(void);
#define ALIAS(name, call)
#define REFUSED(name) void name(void);
#include "gl_names.inc"
#undef OFFERED
#undef REFUSED

#define OFFERED(name)
#define REFUSED(name) void name(void) { gl_refuse(#name); }
#include "gl_names.inc"
#undef OFFERED
#undef ALIAS
#undef REFUSED

#define OSMESA(X) \
    X(OSMesaCreateContext) X(OSMesaCreateContextExt) X(OSMesaCreateContextAttribs) X(OSMesaDestroyContext) \
    X(OSMesaMakeCurrent) X(OSMesaGetCurrentContext) X(OSMesaPixelStore) X(OSMesaGetIntegerv) X(OSMesaGetDepthBuffer) \
    X(OSMesaGetColorBuffer) X(OSMesaColorClamp) X(OSMesaPostprocess)
#define DECLARE(name) void name(void);
OSMESA(DECLARE)

typedef struct names_row {
    const char *name;
    gl_proc call;
} names_row;
#define OFFERED(name) {#name, name},
#define ALIAS(name, call) {#name, call},
#define REFUSED(name) {#name, name},
static const names_row names_rows[] = {OSMESA(OFFERED) {"OSMesaGetProcAddress", (gl_proc)OSMesaGetProcAddress},
#include "gl_names.inc"
};

/* Stand-ins for unknown names: each prints the name that was looked up. */
static void names_missing(int slot)
{
    const char *name = gl_missing_name(slot);
    gl_refuse(name != NULL && name[0] != '\0' ? name : "an unknown call");
}
#define SLOT(n) static void names_slot_##n(void) { names_missing(0x##n); }
#define SIXTEEN(X, high) \
    X(high##0) X(high##1) X(high##2) X(high##3) X(high##4) X(high##5) X(high##6) X(high##7) \
    X(high##8) X(high##9) X(high##a) X(high##b) X(high##c) X(high##d) X(high##e) X(high##f)
SIXTEEN(SLOT, 0)
SIXTEEN(SLOT, 1) SIXTEEN(SLOT, 2) SIXTEEN(SLOT, 3)
#define SLOT_ROW(n) names_slot_##n,
    static const gl_proc names_slots[NAMES_SLOTS] = {SIXTEEN(SLOT_ROW, 0) SIXTEEN(SLOT_ROW, 1) SIXTEEN(SLOT_ROW, 2)
                                                         SIXTEEN(SLOT_ROW, 3)};
static void names_unknown(void) { gl_refuse("an unknown call"); }

static gl_proc names_stand_in(const char *name)
{
    for (int i = 0; i < NAMES_SLOTS; ++i) {
        char *slot = gl_missing_name(i);
        if (slot == NULL) {
            break;
        }
        if (slot[0] == '\0') {
            strncpy(slot, name, NAMES_BYTES - 1);
        }
        if (strncmp(slot, name, NAMES_BYTES - 1) == 0) {
            return names_slots[i];
        }
    }
    return names_unknown;
}

gl_proc OSMesaGetProcAddress(const char *name)
{
    if (name == NULL) {
        return NULL;
    }
    for (size_t i = 0; i < sizeof names_rows / sizeof names_rows[0]; ++i) {
        if (strcmp(names_rows[i].name, name) == 0) {
            return names_rows[i].call;
        }
    }
    return strncmp(name, "gl", 2) == 0 && name[2] >= 'A' && name[2] <= 'Z' ? names_stand_in(name) : NULL;
}

gl_proc glXGetProcAddressARB(const unsigned char *name) { return OSMesaGetProcAddress((const char *)name); }
gl_proc glXGetProcAddress(const unsigned char *name) { return OSMesaGetProcAddress((const char *)name); }
