/* pad_n64.c: an input plugin of mupen64plus: one controller with buttons from a list. Built as a
 * shared library for the host.
 *
 * ROOM_PADS holds hexadecimal numbers in the controller's format, one for each poll; Start (10) follows. */
#include <stdint.h>
#include <stdlib.h>

typedef struct controller {
    int present, raw, plugin, type;
} controller;

typedef struct control_info {
    controller *controls;
} control_info;

enum { PLUGIN_INPUT = 4, START = 0x10 };

int PluginStartup(void *core, void *context, void (*debug)(void *, int, const char *));
int PluginShutdown(void);
int PluginGetVersion(int *type, int *version, int *interface, const char **name, int *capabilities);
void InitiateControllers(control_info info);
void GetKeys(int which, uint32_t *keys);
void ControllerCommand(int which, uint8_t *bytes);
void ReadController(int which, uint8_t *bytes);
int RomOpen(void);
void RomClosed(void);
void SDL_KeyDown(int modifiers, int key);
void SDL_KeyUp(int modifiers, int key);

int PluginStartup(void *core, void *context, void (*debug)(void *, int, const char *))
{
    (void)core, (void)context, (void)debug;
    return 0;
}

int PluginShutdown(void) { return 0; }

int PluginGetVersion(int *type, int *version, int *interface, const char **name, int *capabilities)
{
    if (type)
        *type = PLUGIN_INPUT;
    if (version)
        *version = 0x10000;
    if (interface)
        *interface = 0x20100;
    if (name)
        *name = "buttons from a list";
    if (capabilities)
        *capabilities = 0;
    return 0;
}

void InitiateControllers(control_info info)
{
    info.controls[0].present = 1;
    info.controls[0].plugin = 1; /* no pak */
}

void GetKeys(int which, uint32_t *keys)
{
    static const char *list;
    static int begun;
    char *end;
    *keys = 0;
    if (which != 0)
        return;
    if (!begun)
        begun = 1, list = getenv("ROOM_PADS");
    *keys = START;
    if (list != NULL) {
        const unsigned long value = strtoul(list, &end, 16);
        if (end != list)
            *keys = (uint32_t)value;
        list = end;
    }
}

void ControllerCommand(int which, uint8_t *bytes) { (void)which, (void)bytes; }
void ReadController(int which, uint8_t *bytes) { (void)which, (void)bytes; }
int RomOpen(void) { return 1; }
void RomClosed(void) {}
void SDL_KeyDown(int modifiers, int key) { (void)modifiers, (void)key; }
void SDL_KeyUp(int modifiers, int key) { (void)modifiers, (void)key; }
