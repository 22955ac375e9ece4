/* qemu_caches.c: a plugin for qemu's user mode that measures the room's cost by stage on consoles with MIPS and PowerPC
 * processors: `-plugin FILE.so,model=vr4300|r3000|ppc750[,functions=on]`, with a program of port_counted.c.
 *
 * Counts of instructions, loads and stores are exact. Cycles come from a model of an in-order pipeline that stalls
 * until operands are ready, with the processor's real caches:
 *
 *   vr4300  one instruction a cycle; a loaded value is ready after 2 cycles; products 5, divisions 37, and both stall
 *           everything; 16 KiB of code in lines of 32 bytes, a miss 46; 8 KiB of data in lines of 16 bytes, written
 *           back, a miss 42, and 20 more if the evicted line was modified. Lines of the screen are allocated without
 *           being fetched: 20 each.
 *   r3000   one instruction a cycle; data is in RAM, without cache: a load takes 5, a store goes through a buffer of
 *           four entries that drains one in 5; in the 1 KiB at 1f800000 both take 1; products 10 and divisions 36,
 *           which only stall users of the result; 4 KiB of code in lines of 16 bytes, a miss 7.
 *   ppc750  two instructions a cycle, of them one load or store and one product; loads 2, products 4, divisions 19,
 *           floats 3; jumps are predicted by 512 two-bit counters, 5 if wrong; 32 KiB of code and of data in lines of
 *           32 bytes, 8 ways; behind them 256 KiB, two ways, 10; main memory 60. Lines of the screen take 10 each. */
#define _POSIX_C_SOURCE 200809L /* strdup */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../freestanding/qemu_interface.h"

/* --- counters ----------------------------------------------------------------------------------------------------- */

enum { TRANSFORM, LIGHT, FILL, SHOW, STAGES, BESIDE = STAGES };
static const char *const stage_names[] = {"transform", "light", "fill", "show"};

static const struct {
    const char *function;
    int stage;
} beginnings[] = {{"lmb_fixed_transform", TRANSFORM}, {"lmb_fixed_light", LIGHT}, {"lmb_fixed_prepare", FILL},
                  {"lmb_fixed_band", FILL},
                  {"port_show_band", SHOW}, {"port_screen_rows", SHOW},           {"port_show_frame", SHOW}, {"room_frame_hash", BESIDE},
                  {"room_path", BESIDE},              {"say_count", BESIDE},       {"counted_end", BESIDE},
                  {"port_ram_used", BESIDE},          {"lmb_render_begin", FILL},  {"lmb_render_step", FILL},
                  {"counted_turns", BESIDE},          {"counted_loads", BESIDE},   {"counted_products", BESIDE}};
enum { BEGINNINGS = sizeof beginnings / sizeof beginnings[0], FUNCTIONS = 512 };

typedef struct counts {
    uint64_t instructions, loads, stores, cycles, code_misses, data_misses;
} counts;

static struct {
    const char *name;
    uint64_t entry, cycles, instructions, misses;
} functions[FUNCTIONS];
static int function_count;

static counts taken[STAGES + 1];
static int stage = BESIDE, calibrated, is_hashing;
static long frame = -1;
static bool shows_functions;
static enum { VR4300, R3000, PPC750 } model;

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

static void say(const char *what, size_t offset)
{
    uint64_t all = 0;
    fprintf(stderr, "%s %ld:", what, frame);
    for (int i = 0; i < STAGES; ++i) {
        uint64_t v;
        memcpy(&v, (const char *)&taken[i] + offset, sizeof v);
        fprintf(stderr, " %s %llu", stage_names[i], (unsigned long long)v);
        all += v;
    }
    fprintf(stderr, " all %llu\n", (unsigned long long)all);
}

static int by_cycles(const void *a, const void *b)
{
    const uint64_t x = functions[*(const int *)a].cycles, y = functions[*(const int *)b].cycles;
    return x < y ? 1 : x > y ? -1 : 0;
}

static void end_frame(void)
{
    static int order[FUNCTIONS];
    if (frame == 0 || frame == 30 || frame == 59) {
        say("instructions", offsetof(counts, instructions));
        say("loads", offsetof(counts, loads));
        say("stores", offsetof(counts, stores));
        say("code misses", offsetof(counts, code_misses));
        say("data misses", offsetof(counts, data_misses));
        say("cycles", offsetof(counts, cycles));
        for (int i = 0; i < function_count; ++i)
            order[i] = i;
        qsort(order, (size_t)function_count, sizeof order[0], by_cycles);
        for (int i = 0; shows_functions && i < function_count && i < 16; ++i)
            fprintf(stderr, "%12llu %12llu %12llu %s\n", (unsigned long long)functions[order[i]].cycles,
                    (unsigned long long)functions[order[i]].instructions, (unsigned long long)functions[order[i]].misses,
                    functions[order[i]].name);
    }
    for (int i = 0; i < function_count; ++i)
        functions[i].cycles = functions[i].instructions = functions[i].misses = 0;
    ++frame;
    memset(taken, 0, sizeof taken);
}

static void begin(int which)
{
    static const char *const loops[] = {"10000 turns", "1024 loads in a row", "again", "1024 loads, 64 bytes apart",
                                        "10000 products"};
    const char *function = beginnings[which].function;
    if (strcmp(function, "counted_end") == 0 && calibrated < 5)
        fprintf(stderr, "calibration: %s: %llu instructions, %llu cycles\n", loops[calibrated++],
                (unsigned long long)taken[BESIDE].instructions, (unsigned long long)taken[BESIDE].cycles);
    if (strncmp(function, "counted_", 8) == 0)
        memset(taken, 0, sizeof taken);
    is_hashing = strcmp(function, "room_frame_hash") == 0 ||
                 (is_hashing && strcmp(function, "say_count") != 0 && strcmp(function, "room_path") != 0);
    stage = is_hashing ? BESIDE : beginnings[which].stage;
    if (strcmp(function, "room_path") == 0 || strcmp(function, "port_ram_used") == 0)
        end_frame();
}

/* --- caches ------------------------------------------------------------------------------------------------------- */

typedef struct cache {
    uint32_t line_log2, ways, sets;
    uint32_t line[4096]; /* number of the line * 4, + 2: modified, + 1: valid; most recently used first in a set */
} cache;

static cache code, data, behind;

/* Returns 1 for a hit. *lost: a modified line was evicted. */
static bool touch(cache *c, uint64_t at, bool writes, bool *lost)
{
    const uint32_t number = (uint32_t)(at >> c->line_log2);
    uint32_t *way = c->line + number % c->sets * c->ways, kept = 0, i = 0;
    while (i < c->ways && way[i] >> 2 != number)
        ++i;
    const bool hit = i < c->ways && (way[i] & 1u);
    if (hit)
        kept = way[i] & 2u;
    else
        i = c->ways - 1, *lost = (way[i] & 3u) == 3u;
    memmove(way + 1, way, i * sizeof *way);
    way[0] = number << 2 | kept | (writes ? 2u : 0u) | 1u;
    return hit;
}

/* --- instructions ------------------------------------------------------------------------------------------------- */

#define SCRATCHPAD 0x1f800000u /* r3000 */

enum { HI_LO = 32, FLOATS = 33, REGISTERS = 65 };
enum { OTHER, LOAD, STORE, PRODUCT, QUOTIENT, FLOAT, JUMP, CLEAR_LINE, FLUSH_LINE };

typedef struct meaning {
    uint64_t at;
    uint8_t used[3], made, kind, cycles; /* registers; 255: none */
    int function, beginning;             /* -1: does not begin a stage */
} meaning;

enum { NONE = 255 };

static void set(meaning *m, int kind, uint32_t a, uint32_t b, uint32_t made, uint32_t cycles)
{
    m->kind = (uint8_t)kind, m->used[0] = (uint8_t)a, m->used[1] = (uint8_t)b, m->made = (uint8_t)made;
    m->cycles = (uint8_t)cycles;
}

static void mips_meaning(meaning *m, uint32_t w)
{
    const uint32_t op = w >> 26, rs = w >> 21 & 31, rt = w >> 16 & 31, rd = w >> 11 & 31, f = w & 63;
    const uint32_t product = model == VR4300 ? 5 : 10, quotient = model == VR4300 ? 37 : 36;
    if (op == 0 && f >= 0x18 && f <= 0x1f)
        set(m, (f & 2) ? QUOTIENT : PRODUCT, rs, rt, HI_LO,
            (f & 2) ? quotient + (f & 4 ? 32 : 0) : product + (f & 4 ? 3 : 0));
    else if (op == 0 && (f == 0x10 || f == 0x12))
        set(m, OTHER, HI_LO, NONE, rd, 1);
    else if (op == 0 && (f == 8 || f == 9))
        set(m, JUMP, rs, NONE, f == 9 ? rd : NONE, 1);
    else if (op == 0)
        set(m, OTHER, rs, rt, rd, 1);
    else if (op < 8 || (op >= 20 && op < 24))
        set(m, JUMP, op == 2 || op == 3 ? NONE : rs, op == 4 || op == 5 || op == 20 || op == 21 ? rt : NONE,
            op == 3 ? 31 : NONE, 1);
    else if (op < 16)
        set(m, OTHER, rs, NONE, rt, 1);
    else if (op == 17 && rs >= 16) {
        const bool slow = f == 3 || f == 4;
        set(m, FLOAT, FLOATS + rd, f < 4 ? FLOATS + rt : NONE, f >= 0x30 ? NONE : FLOATS + (w >> 6 & 31),
            slow ? 29 : f == 2 ? 5 : f < 2 ? 3 : f >= 0x20 && f < 0x30 ? 5 : 1);
    } else if (op == 17)
        set(m, OTHER, rs == 4 ? rt : FLOATS + rd, NONE, rs == 4 ? FLOATS + rd : rt, 2);
    else if (op == 0x31 || op == 0x35)
        set(m, LOAD, rs, NONE, FLOATS + rt, 2);
    else if ((op >= 0x20 && op < 0x28) || op == 0x37)
        set(m, LOAD, rs, op == 0x22 || op == 0x26 ? rt : NONE, rt, model == VR4300 ? 2 : 1);
    else
        set(m, STORE, rs, op >= 0x39 ? NONE : rt, NONE, 1);
}

static void ppc_meaning(meaning *m, uint32_t w)
{
    const uint32_t op = w >> 26, d = w >> 21 & 31, a = w >> 16 & 31, b = w >> 11 & 31, x = w >> 1 & 0x3ff;
    static const uint16_t into_a[] = {28, 60, 124, 284, 316, 412, 444, 476, 24, 536, 792, 824, 26, 954, 922};
    if (op == 16 || op == 18 || op == 19)
        set(m, JUMP, NONE, NONE, NONE, 1);
    else if (op == 7)
        set(m, PRODUCT, a, NONE, d, 3);
    else if (op == 10 || op == 11)
        set(m, OTHER, a, NONE, NONE, 1);
    else if (op >= 8 && op < 16)
        set(m, OTHER, a == 0 && op >= 14 ? NONE : a, NONE, d, 1);
    else if (op >= 20 && op < 24)
        set(m, OTHER, d, op == 20 ? a : op == 23 ? b : NONE, a, 1);
    else if (op >= 24 && op < 30)
        set(m, OTHER, d, NONE, a, 1);
    else if (op == 31 && x == 1014)
        set(m, CLEAR_LINE, b, NONE, NONE, 1);
    else if (op == 31 && x == 86)
        set(m, FLUSH_LINE, b, NONE, NONE, 1);
    else if (op == 31 && (x == 235 || x == 75 || x == 11))
        set(m, PRODUCT, a, b, d, 4);
    else if (op == 31 && (x == 491 || x == 459))
        set(m, QUOTIENT, a, b, d, 19);
    else if (op == 31 && (x == 0 || x == 32))
        set(m, OTHER, a, b, NONE, 1);
    else if (op == 31 && (x & 31) == 23) {
        const bool float_one = x >= 512 && x < 800, store = x & 128;
        set(m, store ? STORE : LOAD, a, b, store ? NONE : float_one ? FLOATS + d : d, 2);
        m->used[2] = (uint8_t)(store ? (float_one ? FLOATS + d : d) : NONE);
    } else if (op == 31) {
        set(m, OTHER, a, b, d, 1);
        for (size_t i = 0; i < sizeof into_a / sizeof *into_a; ++i)
            if (x == into_a[i])
                set(m, OTHER, d, x == 824 || x == 26 || x == 954 || x == 922 ? NONE : b, a, 1);
    } else if (op >= 32 && op < 56) {
        const bool store = op >= 52 || (op < 48 && (op & 4) && op != 46);
        const uint32_t r = op >= 48 ? FLOATS + d : d;
        set(m, store ? STORE : LOAD, a, store ? r : NONE, store ? NONE : r, 2);
    } else
        set(m, FLOAT, FLOATS + a, FLOATS + b, FLOATS + d, op == 59 && (x & 31) == 18 ? 17 : 3);
}

/* --- the pipeline ------------------------------------------------------------------------------------------------- */

static uint64_t now, ready[REGISTERS], emptied[4];
static uint32_t slots, moves, products; /* used in this cycle, ppc750 */
static uint64_t screen_from, screen_past;
static const meaning *jump;             /* the last instruction, if it was a jump */
static uint8_t guesses[512];

static void pay(const meaning *m, uint64_t before)
{
    taken[stage].cycles += now - before;
    if (stage != BESIDE)
        functions[m->function].cycles += now - before;
}

static void next_cycle(uint64_t at_least)
{
    now = at_least;
    slots = moves = products = 0;
}

/* Checks whether the last jump was taken, and predicted. */
static void look_back(uint64_t at)
{
    if (jump == NULL)
        return;
    uint8_t *g = &guesses[jump->at >> 2 & 511];
    const bool went = at != jump->at + 4;
    if (went != (*g >= 2))
        next_cycle(now + 5);
    else if (went) /* the target starts with the next cycle */
        next_cycle(now + 1);
    if (went)
        *g = (uint8_t)(*g < 3 ? *g + 1 : 3);
    else
        *g = (uint8_t)(*g > 0 ? *g - 1 : 0);
    jump = NULL;
}

static void issue_two(const meaning *m, uint64_t when)
{
    if (when > now)
        next_cycle(when);
    if (m->kind == JUMP) { /* in addition to the two */
        jump = m;
        return;
    }
    const bool moves_data = m->kind == LOAD || m->kind == STORE || m->kind >= CLEAR_LINE;
    const bool multiplies = m->kind == PRODUCT || m->kind == QUOTIENT;
    if (slots == 2 || (moves_data && moves) || (multiplies && products))
        next_cycle(now + 1);
    ++slots;
    moves += moves_data, products += multiplies;
    if (m->made != NONE)
        ready[m->made] = now + m->cycles;
    if (multiplies) /* occupies the unit */
        now += m->kind == QUOTIENT ? 18 : 1;
}

static void issue_one(const meaning *m, uint64_t when)
{
    now = when > now ? when : now;
    if (model == VR4300 && (m->kind == PRODUCT || m->kind == QUOTIENT || m->kind == FLOAT)) {
        now += m->cycles;
        return;
    }
    now += 1;
    if (m->made != NONE && m->made != 0)
        ready[m->made] = now - 1 + m->cycles;
}

static bool has_moved; /* qemu splits unaligned stores of MIPS into bytes */

static void execute(unsigned cpu, void *user)
{
    const meaning *m = user;
    const uint64_t before = now;
    has_moved = false;
    uint64_t when = now;
    bool lost = false;
    (void)cpu;
    if (m->beginning >= 0)
        begin(m->beginning);
    if (model == PPC750)
        look_back(m->at);
    if (!touch(&code, m->at, false, &lost)) {
        taken[stage].code_misses += 1;
        now += model == VR4300 ? 46 : model == R3000 ? 7 : touch(&behind, m->at, false, &lost) ? 10 : 60;
    }
    for (int i = 0; i < 3; ++i)
        if (m->used[i] != NONE && ready[m->used[i]] > when)
            when = ready[m->used[i]];
    taken[stage].instructions += 1;
    functions[m->function].instructions += stage != BESIDE;
    if (model == PPC750)
        issue_two(m, when);
    else
        issue_one(m, when);
    pay(m, before);
}

static void store_buffered(void)
{
    static uint32_t oldest;
    const uint64_t last = emptied[(oldest + 3) & 3];
    if (emptied[oldest] > now)
        now = emptied[oldest];
    emptied[oldest] = (last > now ? last : now) + 5;
    oldest = (oldest + 1) & 3;
}

static void access_memory(unsigned cpu, uint32_t info, uint64_t at, void *user)
{
    const meaning *m = user;
    const bool is_store = qemu_plugin_mem_is_store(info), is_screen = at >= screen_from && at < screen_past;
    const uint64_t before = now;
    bool lost = false;
    (void)cpu;
    if (m->kind == CLEAR_LINE || m->kind == FLUSH_LINE) {
        if (m->kind == CLEAR_LINE && !touch(&data, at, true, &lost))
            now += is_screen ? 10 : 0;
        pay(m, before);
        return;
    }
    if (has_moved && model != PPC750)
        return;
    has_moved = true;
    if (is_store)
        taken[stage].stores += 1;
    else
        taken[stage].loads += 1;
    if (model == R3000) {
        if (at - SCRATCHPAD < 1024)
            ;
        else if (is_store)
            store_buffered();
        else
            now += 4;
    } else if (!touch(&data, at, is_store, &lost)) {
        taken[stage].data_misses += 1;
        functions[m->function].misses += stage != BESIDE;
        if (model == VR4300)
            now += is_screen && is_store ? 20 + (lost ? 20 : 0) : 42 + (lost ? 20 : 0);
        else
            now += is_screen && is_store ? 10 : touch(&behind, at, is_store, &lost) ? 10 : 60;
        slots = 0;
    }
    pay(m, before);
}

static void translate(plugin_id id, block *b)
{
    const size_t count = qemu_plugin_tb_n_insns(b);
    meaning *all = calloc(count, sizeof *all);
    (void)id;
    if (all == NULL)
        exit(1);
    for (size_t k = 0; k < count; ++k) {
        instruction *i = qemu_plugin_tb_get_insn(b, k);
        const uint8_t *c = qemu_plugin_insn_data(i);
        const uint32_t word = model == R3000 ? c[0] | c[1] << 8 | c[2] << 16 | (uint32_t)c[3] << 24
                                             : c[3] | c[2] << 8 | c[1] << 16 | (uint32_t)c[0] << 24;
        const char *name = qemu_plugin_insn_symbol(i);
        meaning *m = &all[k];
        m->at = qemu_plugin_insn_vaddr(i);
        m->used[2] = NONE;
        if (model == PPC750)
            ppc_meaning(m, word);
        else
            mips_meaning(m, word);
        m->function = function_of(name ? name : "?", m->at);
        m->beginning = -1;
        for (int n = 0; n < BEGINNINGS && name; ++n)
            if (strcmp(name, beginnings[n].function) == 0 && functions[m->function].entry == m->at)
                m->beginning = n;
        qemu_plugin_register_vcpu_insn_exec_cb(i, execute, NO_REGISTERS, m);
        qemu_plugin_register_vcpu_mem_cb(i, access_memory, NO_REGISTERS, READS_AND_WRITES, m);
    }
}

static void set_cache(cache *c, uint32_t bytes, uint32_t line_log2, uint32_t ways)
{
    c->line_log2 = line_log2, c->ways = ways, c->sets = (bytes >> line_log2) / ways;
}

QEMU_EXPORTED int qemu_plugin_install(plugin_id id, const void *info, int count, char **word)
{
    bool known = false;
    (void)info;
    for (int i = 0; i < count; ++i) {
        if (strcmp(word[i], "model=vr4300") == 0) {
            known = true, model = VR4300;
            set_cache(&code, 16384, 5, 1), set_cache(&data, 8192, 4, 1);
        } else if (strcmp(word[i], "model=r3000") == 0) {
            known = true, model = R3000;
            set_cache(&code, 4096, 4, 1);
        } else if (strcmp(word[i], "model=ppc750") == 0) {
            known = true, model = PPC750;
            set_cache(&code, 32768, 5, 8), set_cache(&data, 32768, 5, 8), set_cache(&behind, 262144, 6, 2);
        } else if (strcmp(word[i], "functions=off") == 0)
            shows_functions = false;
        else if (strcmp(word[i], "functions=on") == 0)
            shows_functions = true;
        else if (strncmp(word[i], "screen=", 7) == 0) {
            screen_from = strtoull(word[i] + 7, NULL, 16);
            screen_past = screen_from + (model == VR4300 ? 320 * 240 * 2 : 640 * 480 * 2);
        } else
            return fprintf(stderr, "qemu_caches: unknown word %s\n", word[i]);
    }
    if (!known)
        return fprintf(stderr, "qemu_caches: model=vr4300, r3000 or ppc750 is missing\n");
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    return 0;
}
