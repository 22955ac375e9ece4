/* lrhost.c: runs a program in a libretro core without a window: presses buttons, prints the program's text
 * (text_block.h) and writes the screen as a picture. Struct layouts and numbers are libretro's ABI, version 1. */
#define _GNU_SOURCE /* dl_iterate_phdr */
#include <dlfcn.h>
#include <link.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "text_block.h"

static const char usage[] =
    "usage: lrhost CORE ROM [--frames N] [--until TEXT] [--limit N] [--press BUTTON@FRAME[+COUNT]]...\n"
    "              [-o PICTURE.ppm] [--crop WxH+X+Y] [--bits N] [--option KEY=VALUE]... [--system DIR] [--log]\n"
    "\n"
    "Runs N frames of the screen (60). With --until, these begin when the program has said TEXT, which must be within\n"
    "--limit frames (36000). FRAME of --press counts from there; the button is held for COUNT frames (10).\n"
    "Buttons: b y select start up down left right a x l r l2 r2.\n"
    "--bits N keeps the upper N bits of each colour and repeats them below. --option sets a variable of the core.\n"
    "--log prints the core's log to stderr. Exit: 0 done, 1 failed, 2 bad usage.\n";

/* --- options ------------------------------------------------------------------------------------------------------ */

enum { PRESSES = 64, OPTIONS = 32 };

typedef struct press {
    unsigned button;
    long from, count;
} press;

static struct {
    const char *core, *rom, *until, *picture, *options[OPTIONS], *system;
    long frames, limit, bits, crop[4];
    press presses[PRESSES];
    int press_count, option_count;
    bool log, cropped;
} asked;

static const char *const buttons[] = {"b",    "y",     "select", "start", "up", "down", "left",
                                      "right", "a", "x",      "l",     "r",  "l2",   "r2"};
enum { BUTTONS = sizeof buttons / sizeof buttons[0] };

static int refused(const char *what, const char *value)
{
    fprintf(stderr, "lrhost: %s: %s\n%s", what, value, usage);
    return 2;
}

static bool read_press(const char *text)
{
    press *p = &asked.presses[asked.press_count];
    const char *at = strchr(text, '@');
    char rest;
    p->count = 10;
    if (at == NULL || asked.press_count == PRESSES)
        return false;
    const int read = sscanf(at, "@%ld+%ld%c", &p->from, &p->count, &rest);
    if (read < 1 || read > 2 || p->from < 0 || p->count < 1)
        return false;
    for (p->button = 0; p->button < BUTTONS; ++p->button)
        if (strlen(buttons[p->button]) == (size_t)(at - text) &&
            strncmp(buttons[p->button], text, (size_t)(at - text)) == 0) {
            ++asked.press_count;
            return true;
        }
    return false;
}

static bool read_long(const char *text, long lowest, long highest, long *out)
{
    char *end;
    *out = strtol(text, &end, 10);
    return end != text && *end == 0 && *out >= lowest && *out <= highest;
}

static bool read_value(const char *name, const char *value)
{
    if (strcmp(name, "--frames") == 0)
        return read_long(value, 0, 10000000, &asked.frames);
    if (strcmp(name, "--limit") == 0)
        return read_long(value, 1, 10000000, &asked.limit);
    if (strcmp(name, "--bits") == 0)
        return read_long(value, 4, 8, &asked.bits);
    if (strcmp(name, "--press") == 0)
        return read_press(value);
    if (strcmp(name, "--until") == 0)
        return (asked.until = value)[0] != 0;
    if (strcmp(name, "--system") == 0)
        return (asked.system = value)[0] != 0;
    if (strcmp(name, "-o") == 0)
        return (asked.picture = value)[0] != 0;
    if (strcmp(name, "--option") == 0) {
        if (strchr(value, '=') == NULL || asked.option_count == OPTIONS)
            return false;
        asked.options[asked.option_count++] = value;
        return true;
    }
    if (strcmp(name, "--crop") == 0) {
        char rest;
        long *c = asked.crop;
        asked.cropped = sscanf(value, "%ldx%ld+%ld+%ld%c", c, c + 1, c + 2, c + 3, &rest) == 4;
        return asked.cropped && c[0] > 0 && c[1] > 0 && c[2] >= 0 && c[3] >= 0;
    }
    return false;
}

static int read_command_line(int count, char **words)
{
    asked.frames = 60, asked.limit = 36000, asked.bits = 8, asked.system = ".";
    for (int i = 1; i < count; ++i) {
        if (strcmp(words[i], "--help") == 0) {
            fputs(usage, stdout);
            exit(0);
        }
        if (strcmp(words[i], "--log") == 0)
            asked.log = true;
        else if (words[i][0] == '-') {
            if (i + 1 == count)
                return refused("unknown option, or without its value", words[i]);
            if (!read_value(words[i], words[i + 1]))
                return refused(words[i], words[i + 1]);
            ++i;
        } else if (asked.core == NULL)
            asked.core = words[i];
        else if (asked.rom == NULL)
            asked.rom = words[i];
        else
            return refused("one word too many", words[i]);
    }
    return asked.rom == NULL ? refused("missing", "CORE ROM") : 0;
}

static int failed(const char *what, const char *why)
{
    fprintf(stderr, "lrhost: %s: %s\n", what, why);
    return 1;
}

/* --- the core ----------------------------------------------------------------------------------------------------- */

typedef struct game_info {
    const char *path;
    const void *data;
    size_t size;
    const char *meta;
} game_info;

typedef struct variable {
    const char *key, *value;
} variable;

typedef struct memory_piece {
    uint64_t flags; /* 1: constant */
    const char *data;
    size_t offset, start, select, disconnect, bytes;
    const char *space;
} memory_piece;

typedef struct memory_map {
    const memory_piece *pieces;
    unsigned count;
} memory_map;

typedef struct log_callback {
    void (*log)(int level, const char *format, ...);
} log_callback;

typedef bool environment_call(unsigned command, void *data);
typedef void video_call(const void *data, unsigned width, unsigned height, size_t pitch);
typedef void sample_call(int16_t left, int16_t right);
typedef size_t batch_call(const int16_t *data, size_t frames);
typedef void poll_call(void);
typedef int16_t input_call(unsigned port, unsigned device, unsigned index, unsigned id);

static struct {
    void (*retro_set_environment)(environment_call *);
    void (*retro_set_video_refresh)(video_call *);
    void (*retro_set_audio_sample)(sample_call *);
    void (*retro_set_audio_sample_batch)(batch_call *);
    void (*retro_set_input_poll)(poll_call *);
    void (*retro_set_input_state)(input_call *);
    void (*retro_init)(void);
    void (*retro_deinit)(void);
    bool (*retro_load_game)(const game_info *);
    void (*retro_unload_game)(void);
    void (*retro_get_system_av_info)(void *);
    void (*retro_set_controller_port_device)(unsigned port, unsigned device);
    void (*retro_run)(void);
    void *(*retro_get_memory_data)(unsigned);
    size_t (*retro_get_memory_size)(unsigned);
} core;

enum { SHORT_1555, WORD_8888, SHORT_565 }; /* pixel formats */

static struct {
    uint8_t *pixels;
    unsigned width, height;
    size_t pitch;
    unsigned format;
} screen;

static struct {
    const void *data;
    size_t bytes;
} writable[32]; /* memory reported by the core */
static int writable_count;

static void keep_pieces(const memory_map *map)
{
    writable_count = 0;
    for (unsigned i = 0; i < map->count && writable_count < 32; ++i) {
        const memory_piece *p = &map->pieces[i];
        if (p->data == NULL || (p->flags & 1))
            continue;
        writable[writable_count].data = p->data + p->offset;
        writable[writable_count++].bytes = p->bytes;
    }
}

static FILE *words_out; /* the program's text; the core's log uses standard output */

static long frame = -1; /* -1: the text of --until was not printed yet */

static void on_log(int level, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    if (asked.log) {
        fprintf(stderr, "[%d] ", level);
        vfprintf(stderr, format, values);
    }
    va_end(values);
}

static bool on_environment(unsigned command, void *data)
{
    enum { CAN_DUPE = 3, SYSTEM_FOLDER = 9, PIXEL_FORMAT = 10, VARIABLE = 15, CHANGED = 17, LOG = 27 };
    enum { SAVE_FOLDER = 31, MEMORY_MAPS = 36 };
    switch (command & 0xffffu) {
    case CAN_DUPE: *(bool *)data = true; return true;
    case SYSTEM_FOLDER:
    case SAVE_FOLDER: *(const char **)data = asked.system; return true;
    case PIXEL_FORMAT:
        memcpy(&screen.format, data, sizeof screen.format);
        return screen.format <= SHORT_565;
    case VARIABLE: {
        variable *v = data;
        const size_t length = strlen(v->key);
        v->value = NULL;
        for (int i = 0; i < asked.option_count; ++i)
            if (strncmp(asked.options[i], v->key, length) == 0 && asked.options[i][length] == '=')
                v->value = asked.options[i] + length + 1;
        return v->value != NULL;
    }
    case MEMORY_MAPS: keep_pieces(data); return true;
    case CHANGED: *(bool *)data = false; return true;
    case LOG: ((log_callback *)data)->log = on_log; return true;
    default: return false;
    }
}

static void on_video(const void *data, unsigned width, unsigned height, size_t pitch)
{
    if (data == NULL) /* as before */
        return;
    uint8_t *pixels = realloc(screen.pixels, pitch * height);
    if (pixels == NULL)
        return;
    memcpy(pixels, data, pitch * (height - 1) + width * (screen.format == WORD_8888 ? 4u : 2u));
    screen.pixels = pixels, screen.width = width, screen.height = height, screen.pitch = pitch;
}

static void on_sample(int16_t left, int16_t right)
{
    (void)left;
    (void)right;
}

static size_t on_samples(const int16_t *data, size_t frames)
{
    (void)data;
    return frames;
}

static void on_poll(void) {}

enum { JOYPAD = 1 };

static int16_t on_input(unsigned port, unsigned device, unsigned index, unsigned id)
{
    enum { ALL_AS_BITS = 256 };
    unsigned held = 0;
    (void)index;
    if (port != 0 || device != JOYPAD)
        return 0;
    for (const press *p = asked.presses; p < asked.presses + asked.press_count; ++p)
        if (frame >= p->from && frame < p->from + p->count)
            held |= 1u << p->button;
    return (int16_t)(id == ALL_AS_BITS ? held : held >> (id & 31u) & 1u);
}

static int open_core(void)
{
    void *library = dlopen(asked.core, RTLD_NOW), *symbol;
    if (library == NULL)
        return failed(asked.core, dlerror());
#define CALL(name)                                                        \
    if ((symbol = dlsym(library, #name)) == NULL)                         \
        return failed(asked.core, "it has no " #name ": no libretro core"); \
    memcpy(&core.name, &symbol, sizeof symbol);
    CALL(retro_set_environment)
    CALL(retro_set_video_refresh)
    CALL(retro_set_audio_sample)
    CALL(retro_set_audio_sample_batch)
    CALL(retro_set_input_poll)
    CALL(retro_set_input_state)
    CALL(retro_init)
    CALL(retro_deinit)
    CALL(retro_load_game)
    CALL(retro_unload_game)
    CALL(retro_get_system_av_info)
    CALL(retro_set_controller_port_device)
    CALL(retro_run)
    CALL(retro_get_memory_data)
    CALL(retro_get_memory_size)
#undef CALL
    core.retro_set_environment(on_environment);
    core.retro_init();
    core.retro_set_video_refresh(on_video);
    core.retro_set_audio_sample(on_sample);
    core.retro_set_audio_sample_batch(on_samples);
    core.retro_set_input_poll(on_poll);
    core.retro_set_input_state(on_input);
    return 0;
}

static int open_rom(void)
{
    static game_info game; /* cores may keep a pointer to it */
    static double timing[16];
    FILE *file = fopen(asked.rom, "rb");
    long size = -1;
    if (file != NULL && fseek(file, 0, SEEK_END) == 0)
        size = ftell(file);
    void *data = size > 0 ? malloc((size_t)size) : NULL;
    if (data == NULL)
        return failed(asked.rom, "cannot be read");
    rewind(file);
    game.path = asked.rom, game.data = data;
    game.size = fread(data, 1, (size_t)size, file);
    fclose(file);
    if (game.size != (size_t)size)
        return failed(asked.rom, "cannot be read");
    if (!core.retro_load_game(&game))
        return failed(asked.rom, "the core refuses it; --log may say why");
    core.retro_get_system_av_info(timing);
    core.retro_set_controller_port_device(0, JOYPAD); /* otherwise some cores have no controller */
    return 0;
}

/* --- the program's text ------------------------------------------------------------------------------------------- */

static const text_block *block_within(const char *memory, size_t bytes)
{
    static const uint32_t marks[TEXT_MARKS] = {TEXT_MARK(0), TEXT_MARK(1), TEXT_MARK(2), TEXT_MARK(3),
                                               TEXT_MARK(4), TEXT_MARK(5), TEXT_MARK(6), TEXT_MARK(7)};
    for (size_t at = 0; memory != NULL && at + sizeof(text_block) <= bytes; at += 4)
        if (memcmp(memory + at, marks, sizeof marks) == 0)
            return (const void *)(memory + at);
    return NULL;
}


/* Searches the writable data of the core, if the core exposes no memory. */
static int search_core(struct dl_phdr_info *library, size_t bytes, void *found)
{
    (void)bytes;
    if (strcmp(library->dlpi_name, asked.core) != 0)
        return 0;
    for (int i = 0; i < library->dlpi_phnum; ++i) {
        const ElfW(Phdr) *part = &library->dlpi_phdr[i];
        const char *memory = (const char *)(library->dlpi_addr + part->p_vaddr);
        if (part->p_type == PT_LOAD && (part->p_flags & PF_W) && *(const text_block **)found == NULL)
            *(const text_block **)found = block_within(memory, part->p_memsz);
    }
    return 1;
}

/* Caches the address, because the search is slow. */
static const text_block *find_block(void)
{
    enum { SYSTEM_RAM = 2, SELDOM = 10 };
    static const text_block *found;
    static unsigned calls;
    if (found != NULL || calls++ % SELDOM != 0)
        return found;
    const char *memory = core.retro_get_memory_data(SYSTEM_RAM);
    found = block_within(memory, core.retro_get_memory_size(SYSTEM_RAM));
    for (int i = 0; i < writable_count && found == NULL; ++i)
        found = block_within(writable[i].data, writable[i].bytes);
    if (memory == NULL && writable_count == 0)
        dl_iterate_phdr(search_core, &found);
    return found;
}

/* Prints new text. Returns 1 if the whole text contains that of --until. */
static bool listen(void)
{
    static char said[TEXT_BYTES + 1];
    static uint32_t printed;
    const text_block *block = find_block();
    if (block == NULL)
        return false;
    const uint32_t bytes = block->bytes < TEXT_BYTES ? block->bytes : TEXT_BYTES;
    if (bytes == printed)
        return false;
    for (; printed < bytes; ++printed)
        fputc(said[printed] = block->text[printed], words_out);
    fflush(words_out);
    return asked.until != NULL && strstr(said, asked.until) != NULL;
}

/* --- the screen --------------------------------------------------------------------------------------------------- */

static unsigned widened(unsigned value, unsigned bits)
{
    value <<= 8 - bits;
    return value | value >> bits;
}

static void pixel_at(uint8_t out[3], unsigned x, unsigned y)
{
    const uint8_t *row = screen.pixels + y * screen.pitch;
    uint32_t word;
    uint16_t half;
    if (screen.format == WORD_8888) {
        memcpy(&word, row + 4u * x, sizeof word);
        out[0] = (uint8_t)(word >> 16), out[1] = (uint8_t)(word >> 8), out[2] = (uint8_t)word;
    } else {
        memcpy(&half, row + 2u * x, sizeof half);
        const unsigned green = screen.format == SHORT_565 ? 6 : 5;
        out[0] = (uint8_t)widened(half >> (5 + green) & 31u, 5);
        out[1] = (uint8_t)widened(half >> 5 & ((1u << green) - 1), green);
        out[2] = (uint8_t)widened(half & 31u, 5);
    }
    for (int i = 0; i < 3; ++i)
        out[i] = (uint8_t)widened(out[i] >> (8 - asked.bits), (unsigned)asked.bits);
}

static int write_picture(void)
{
    char part[1024];
    const long whole[4] = {(long)screen.width, (long)screen.height, 0, 0}, *c = asked.cropped ? asked.crop : whole;
    if (screen.pixels == NULL)
        return failed(asked.picture, "the core showed no picture");
    if (c[2] + c[0] > whole[0] || c[3] + c[1] > whole[1])
        return failed("--crop", "beyond the screen");
    if (snprintf(part, sizeof part, "%s.part", asked.picture) >= (int)sizeof part)
        return failed(asked.picture, "too long a name");
    FILE *file = fopen(part, "wb");
    if (file == NULL)
        return failed(part, "cannot be written");
    fprintf(file, "P6\n%ld %ld\n255\n", c[0], c[1]);
    for (long y = 0; y < c[1]; ++y)
        for (long x = 0; x < c[0]; ++x) {
            uint8_t rgb[3];
            pixel_at(rgb, (unsigned)(x + c[2]), (unsigned)(y + c[3]));
            fwrite(rgb, 1, 3, file);
        }
    const bool bad = ferror(file) != 0;
    if (fclose(file) != 0 || bad || rename(part, asked.picture) != 0) {
        remove(part);
        return failed(asked.picture, "cannot be written");
    }
    return 0;
}

static int run(void)
{
    if (asked.until != NULL) {
        long waited = 0;
        do {
            if (waited++ == asked.limit)
                return failed("--until", "the program has not said it within --limit frames");
            core.retro_run();
        } while (!listen());
    }
    for (frame = 0; frame < asked.frames; ++frame) {
        core.retro_run();
        listen();
    }
    return asked.picture ? write_picture() : 0;
}

/* Cores write to standard output: redirects that to stderr with --log, and discards it otherwise. */
static int keep_output(void)
{
    const int own = dup(STDOUT_FILENO);
    words_out = own < 0 ? NULL : fdopen(own, "w");
    if (words_out == NULL || freopen("/dev/null", "w", stdout) == NULL ||
        (asked.log && dup2(STDERR_FILENO, STDOUT_FILENO) < 0))
        return failed("standard output", "cannot be kept apart from the core's");
    return 0;
}

int main(int count, char **words)
{
    int status = read_command_line(count, words);
    if (status != 0 || (status = keep_output()) != 0 || (status = open_core()) != 0)
        return status;
    status = open_rom();
    if (status == 0) {
        status = run();
        core.retro_unload_game();
    }
    core.retro_deinit();
    free(screen.pixels);
    return status;
}
