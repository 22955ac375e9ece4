/* qemu_stages.c: a plugin for qemu's emulation of ARM processors that measures the room's cost by stage on consoles
 * that qemu does not support: `-plugin FILE.so,model=arm7|arm9[,frames=N][,functions=on]`.
 *
 * The console's own program runs on a board where all of its addresses are RAM. No device answers there, and the frames
 * are the same. Counts of instructions, loads and stores are exact. Cycles come from a model after the manuals:
 *
 *   arm9  ARM946E-S: an instruction takes 1; multiplies 2, long ones 3; jumps 3; loads of n registers n, at least 2;
 *         one more if the next instruction needs the loaded value. Main memory, 0x02000000 on, has caches of four ways
 *         and 32 bytes a line, 8 KiB for instructions and 4 KiB for data: a miss takes 46, a write that misses 18.
 *         All other memory is beside the processor, or written through its buffer, and takes none.
 *   arm7  ARM7TDMI: loads 3 and one more for each register, stores 2 likewise; jumps 3; multiplies 3, long ones 5; and
 *         the Game Boy Advance's wait states of data, by address. Instructions in ROM take 3 (narrow) or 6.
 *
 * It prints the same lines as the room, and ends the emulator after the last frame. Build the plugin for the host. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "qemu_interface.h"

/* --- counters ----------------------------------------------------------------------------------------------------- */

enum { TRANSFORM, LIGHT, FILL, SHOW, STAGES, BESIDE = STAGES }; /* BESIDE: the path, hashes
                                                                 * and text belong to no stage */

static const char *const stage_names[] = {"transform", "light", "fill", "show"};

/* A stage begins when its function is called. */
static const struct {
    const char *function;
    int stage;
} beginnings[] = {{"lmb_fixed_transform", TRANSFORM}, {"lmb_fixed_light", LIGHT}, {"lmb_fixed_prepare", FILL},
                  {"lmb_fixed_band", FILL},
                  {"port_screen_rows", SHOW},         {"port_show_frame", SHOW},  {"room_frame_hash", BESIDE},
                  {"room_path", BESIDE},              {"room_steer", BESIDE},     {"say_count", BESIDE},
                  {"port_calibrate", BESIDE},         {"port_calibrated", BESIDE}};
enum { BEGINNINGS = sizeof beginnings / sizeof beginnings[0] };

typedef struct counts {
    uint64_t instructions, loads, stores, cycles;
} counts;

enum { FUNCTIONS = 512 };

static struct {
    const char *name;
    uint64_t entry, cycles;
} functions[FUNCTIONS];
static int function_count;

static counts taken[STAGES + 1];
static int stage = BESIDE;
static long frame = -1, frames = 60;
static bool is_arm9, shows_functions, is_hashing;

static int function_of(const char *name, uint64_t at)
{
    int i = 0;
    while (i < function_count && strcmp(functions[i].name, name) != 0)
        ++i;
    if (i == function_count) {
        if (function_count == FUNCTIONS)
            return 0;
        functions[function_count].name = strdup(name);
        functions[function_count++].entry = at; /* the first instruction executed is the entry */
    }
    return i;
}

static void say(const char *what, uint64_t (*of)(const counts *), const char *unit)
{
    uint64_t all = 0;
    printf("%s %ld:", what, frame);
    for (int i = 0; i < STAGES; ++i) {
        printf(" %s %llu", stage_names[i], (unsigned long long)of(&taken[i]));
        all += of(&taken[i]);
    }
    printf(" all %llu%s\n", (unsigned long long)all, unit);
}

static uint64_t instructions_of(const counts *c) { return c->instructions; }
static uint64_t loads_of(const counts *c) { return c->loads; }
static uint64_t stores_of(const counts *c) { return c->stores; }
static uint64_t cycles_of(const counts *c) { return c->cycles; }

static int by_cycles(const void *a, const void *b)
{
    const uint64_t x = functions[*(const int *)a].cycles, y = functions[*(const int *)b].cycles;
    return x < y ? 1 : x > y ? -1 : 0;
}

static void say_functions(void)
{
    static int order[FUNCTIONS];
    for (int i = 0; i < function_count; ++i)
        order[i] = i;
    qsort(order, (size_t)function_count, sizeof order[0], by_cycles);
    for (int i = 0; i < function_count && i < 24; ++i)
        printf("%12llu %s\n", (unsigned long long)functions[order[i]].cycles, functions[order[i]].name);
}

static void end_frame(void)
{
    if (frame == 0 || frame == 30 || frame == 59) {
        say("instructions", instructions_of, "");
        say("loads", loads_of, "");
        say("stores", stores_of, "");
        say(is_arm9 ? "cost" : "model", cycles_of, " cycles by model");
        if (shows_functions)
            say_functions();
    }
    for (int i = 0; i < function_count; ++i)
        functions[i].cycles = 0;
    if (++frame == frames) {
        fflush(stdout);
        exit(0);
    }
    memset(taken, 0, sizeof taken);
}

static void begin(int which)
{
    const char *function = beginnings[which].function;
    if (strcmp(function, "port_calibrate") == 0)
        memset(taken, 0, sizeof taken);
    if (strcmp(function, "port_calibrated") == 0)
        printf("calibration: %llu instructions, %llu cycles\n", (unsigned long long)taken[BESIDE].instructions,
               (unsigned long long)taken[BESIDE].cycles);
    is_hashing = strcmp(function, "room_frame_hash") == 0 ||
                 (is_hashing && strcmp(function, "say_count") != 0 && strcmp(function, "room_path") != 0);
    stage = is_hashing ? BESIDE : beginnings[which].stage;
    if (strcmp(function, "room_path") == 0 || strcmp(function, "room_steer") == 0)
        end_frame();
}

/* --- caches ------------------------------------------------------------------------------------------------------- */

enum { LINE = 32, WAYS = 4, MOST_SETS = 64, MISS = 46, WRITE_MISS = 18 };

typedef struct cache {
    uint32_t line[MOST_SETS][WAYS]; /* + 1 if valid; most recently used first */
    uint32_t sets;
} cache;

static cache code = {{{0}}, 64}, data = {{{0}}, 32};

static bool is_cached(uint64_t at) { return at >> 22 == 0x02000000u >> 22; }

/* Returns 1 for a hit. A write that misses allocates no line. */
static bool touch(cache *c, uint32_t at, bool takes_line)
{
    uint32_t *way = c->line[at / LINE % c->sets];
    const uint32_t wanted = at / LINE * LINE | 1u;
    int i = 0;
    while (i < WAYS && way[i] != wanted)
        ++i;
    const bool hit = i < WAYS;
    if (!hit && !takes_line)
        return false;
    memmove(way + 1, way, (size_t)(hit ? i : WAYS - 1) * sizeof *way);
    way[0] = wanted;
    return hit;
}

/* --- instructions ------------------------------------------------------------------------------------------------- */

enum { IS_JUMP = 1, IS_LOAD = 2 };

typedef struct meaning {
    uint32_t cycles, kind, loaded, used; /* registers as bits */
} meaning;

static uint32_t bits_of(uint32_t v)
{
    uint32_t n = 0;
    for (; v; v &= v - 1)
        ++n;
    return n;
}

/* Cost of an instruction that is not taken: jumps and loads are refined at run time. */
static meaning wide_meaning(uint32_t w)
{
    meaning m = {1, 0, 0, 0};
    const uint32_t rn = 1u << (w >> 16 & 15), rd = 1u << (w >> 12 & 15), rs = 1u << (w >> 8 & 15), rm = 1u << (w & 15);
    if ((w & 0x0e000000u) == 0x0a000000u || (w & 0x0ffffff0u) == 0x012fff10u || (w & 0x0ffffff0u) == 0x012fff30u)
        m.kind = IS_JUMP;
    else if ((w & 0x0fc000f0u) == 0x00000090u)
        m.cycles = is_arm9 ? 2 : 3, m.used = rm | rs | rd;
    else if ((w & 0x0f8000f0u) == 0x00800090u)
        m.cycles = is_arm9 ? 3 : 5, m.used = rm | rs;
    else if ((w & 0x0e000000u) == 0x08000000u) { /* many registers */
        const uint32_t list = w & 0xffffu;
        m.used = rn;
        m.cycles = is_arm9 ? (bits_of(list) > 1 ? bits_of(list) : 2) : bits_of(list) + (w >> 20 & 1 ? 2 : 1);
        if (w >> 20 & 1)
            m.kind = list >> 15 ? IS_JUMP : 0, m.loaded = 1u << (31 - __builtin_clz(list | 1u));
    } else if ((w & 0x0c000000u) == 0x04000000u || (w & 0x0e000090u) == 0x00000090u) { /* one register, or half of it */
        m.used = rn | (w & 0x0c000000u && !(w >> 25 & 1) ? 0 : rm);
        if (w >> 20 & 1)
            m.loaded = rd, m.kind = rd >> 15 ? IS_JUMP : 0, m.cycles = is_arm9 ? 1 : 3;
        else
            m.cycles = is_arm9 ? 1 : 2;
    } else { /* arithmetic */
        m.used = rn | (w >> 25 & 1 ? 0 : rm);
        if (!(w >> 25 & 1) && (w >> 4 & 1))
            m.cycles = 2, m.used |= rs;
        m.kind = rd >> 15 ? IS_JUMP : 0;
    }
    return m;
}

static meaning narrow_meaning(uint32_t h)
{
    meaning m = {1, 0, 0, 0};
    const uint32_t low = 1u << (h & 7), middle = 1u << (h >> 3 & 7), high = 1u << (h >> 6 & 7);
    const uint32_t top = h >> 12;
    if (top == 13 || top == 14 || top == 15 || (h & 0xff00u) == 0x4700u)
        m.kind = IS_JUMP;
    else if ((h & 0xffc0u) == 0x4340u)
        m.cycles = is_arm9 ? 2 : 3;
    else if ((h & 0xf800u) == 0x4800u || top == 9)
        m.loaded = h & 0x800u ? 1u << (h >> 8 & 7) : 0, m.cycles = is_arm9 ? 1 : h & 0x800u ? 3 : 2;
    else if (top == 5 || top == 6 || top == 7 || top == 8) {
        const bool load = top == 5 ? (h >> 9 & 7) >= 3 : h >> 11 & 1;
        m.used = middle | (top == 5 ? high : 0), m.loaded = load ? low : 0;
        m.cycles = is_arm9 ? 1 : load ? 3 : 2;
    } else if (top == 12 || (h & 0xf600u) == 0xb400u) {
        const uint32_t n = bits_of(h & (top == 12 ? 0xffu : 0x1ffu));
        m.cycles = is_arm9 ? (n > 1 ? n : 2) : n + (h >> 11 & 1 ? 2 : 1);
        m.kind = (h & 0xff00u) == 0xbd00u ? IS_JUMP : 0;
    } else
        m.used = low | middle | high;
    return m;
}

/* Instructions without a jump in between. */
typedef struct stretch {
    uint32_t from, past, instructions, cycles;
    int function, beginning; /* -1: does not begin a stage */
} stretch;

static uint32_t expected; /* address at which the last stretch continues without a jump */

static void execute(unsigned cpu, void *user)
{
    const stretch *s = user;
    (void)cpu;
    if (s->beginning >= 0)
        begin(s->beginning);
    uint64_t cycles = s->cycles + (s->from != expected ? 2u : 0u);
    expected = s->past;
    if (is_arm9 && is_cached(s->from))
        for (uint32_t at = s->from / LINE * LINE; at < s->past; at += LINE)
            cycles += touch(&code, at, true) ? 0u : MISS;
    taken[stage].instructions += s->instructions;
    taken[stage].cycles += cycles;
    if (stage != BESIDE)
        functions[s->function].cycles += cycles;
}

/* Wait states of the Game Boy Advance's memories. */
static uint32_t waits_of(uint64_t at, unsigned size_shift)
{
    switch (at >> 24) {
    case 2: return size_shift == 2 ? 5 : 2;
    case 6: return size_shift == 2 ? 1 : 0;
    case 8: return size_shift == 2 ? 5 : 3;
    default: return 0;
    }
}

static void access_memory(unsigned cpu, uint32_t info, uint64_t at, void *user)
{
    const stretch *s = user;
    const bool is_store = qemu_plugin_mem_is_store(info);
    uint32_t cycles = 0;
    (void)cpu;
    if (is_store)
        taken[stage].stores += 1;
    else
        taken[stage].loads += 1;
    if (!is_arm9)
        cycles = waits_of(at, qemu_plugin_mem_size_shift(info));
    else if (is_cached(at) && !touch(&data, (uint32_t)at, !is_store))
        cycles = is_store ? WRITE_MISS : MISS;
    taken[stage].cycles += cycles;
    if (stage != BESIDE)
        functions[s->function].cycles += cycles;
}

static void translate(plugin_id id, block *b)
{
    const size_t count = qemu_plugin_tb_n_insns(b);
    stretch *s = calloc(1, sizeof *s);
    uint32_t loaded = 0;
    (void)id;
    if (s == NULL)
        exit(1);
    const char *name = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(b, 0));
    s->from = s->past = (uint32_t)qemu_plugin_tb_vaddr(b);
    s->function = function_of(name ? name : "?", s->from);
    s->beginning = -1;
    for (int i = 0; i < BEGINNINGS && name; ++i)
        if (strcmp(name, beginnings[i].function) == 0 && functions[s->function].entry == s->from)
            s->beginning = i;
    for (size_t k = 0; k < count; ++k) {
        instruction *i = qemu_plugin_tb_get_insn(b, k);
        const size_t bytes = qemu_plugin_insn_size(i);
        uint32_t word = 0;
        memcpy(&word, qemu_plugin_insn_data(i), bytes);
        const meaning m = bytes == 4 ? wide_meaning(word) : narrow_meaning(word);
        s->past += (uint32_t)bytes;
        s->instructions += 1;
        s->cycles += m.cycles + (is_arm9 && (loaded & m.used) ? 1u : 0u);
        if (!is_arm9 && s->from >> 24 == 8)
            s->cycles += bytes == 4 ? 5u : 2u;
        loaded = m.loaded;
        qemu_plugin_register_vcpu_mem_cb(i, access_memory, NO_REGISTERS, READS_AND_WRITES, s);
    }
    qemu_plugin_register_vcpu_tb_exec_cb(b, execute, NO_REGISTERS, s);
}

QEMU_EXPORTED int qemu_plugin_install(plugin_id id, const void *info, int count, char **word)
{
    bool known = false;
    (void)info;
    for (int i = 0; i < count; ++i) {
        if (strcmp(word[i], "model=arm7") == 0)
            known = true;
        else if (strcmp(word[i], "model=arm9") == 0)
            known = is_arm9 = true;
        else if (strcmp(word[i], "functions=on") == 0)
            shows_functions = true;
        else if (strncmp(word[i], "frames=", 7) == 0 && (frames = strtol(word[i] + 7, NULL, 10)) > 0)
            continue;
        else
            return fprintf(stderr, "qemu_stages: unknown word %s\n", word[i]);
    }
    if (!known)
        return fprintf(stderr, "qemu_stages: model=arm7 or model=arm9 is missing\n");
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    return 0;
}
