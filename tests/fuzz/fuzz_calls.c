/* fuzz_calls.c: sequences of public calls in any order, also after failures, on zeroed structs or results of earlier
 * calls, with arguments in and out of range.
 *
 * An input consists of records of 16 bytes: the action; the call, struct or member, by the hash of the name; one byte
 * for each argument, where 0 chooses a good value. The table of calls is generated from the headers
 * (tests/scripts/zeros.awk). Checks: a call returns a valid status; it does not write outside its memory, to scenes,
 * or, if the header promises that, to structs of a refused call; sanitizers also check reads and undefined behaviour.
 * The caller's duties in the headers are met: scenes are checked, arrays have the stated length, and a transfer's light
 * is laid out for the transfer. */
#include "fuzz_calls.h"

#if FUZZ_CALLS

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RECORD = 16, RECORDS = 64, ARGUMENTS = 12, COST = 128 };
enum { KEEP = 1 << 18, FRAME = 12 << 20 }; /* maximum size in bytes given to a call: any; lmb_frame_init */

typedef struct parameter {
    const char *type, *name;
    int is_pointer;
} parameter;

typedef struct call {
    const char *name;
    int (*make)(argument *);
    int is_status, count;
    parameter parameter[ARGUMENTS];
} call;

static const char *at_call = "";

static int calls_for(const char *name) { return strcmp(at_call, name) == 0; }
static int is_named(const argument *a, const char *name) { return strcmp(a->name, name) == 0; }

static void *plain(argument *a, size_t bytes)
{
    a->memory = pool_block(bytes);
    a->bytes = bytes < POOL_ARRAY ? bytes : POOL_ARRAY;
    a->is_plain = 1;
    memcpy(a->memory, pool_raw, a->bytes);
    return a->memory;
}

/* Arrays with a length in the prototype are made here, all others by `prepare`. */
static void *pointer(argument *a, size_t bytes)
{
    if (!a->is_ready) {
        if (bytes == 0) {
            fprintf(stderr, "fuzz_calls.c: how long is %s of %s? Say so in fuzz_lengths.c\n", a->name, at_call);
            abort();
        }
        plain(a, bytes);
        a->is_ready = 1;
    }
    return a->memory;
}

static int64_t whole(const argument *a) { return a->whole; }

static double number(const argument *a)
{
    return calls_for("lmb_many_lights_init") && a->byte == 0 ? 1e4 : a->byte == 0 ? 0.5 : (double)pool_float(a->byte);
}

static lmb_vec3 vector(const argument *a)
{
    const float side = is_named(a, "low") ? -9.0f : is_named(a, "high") ? 9.0f : 0.25f;
    const lmb_vec3 up = {0, 1, 0}, good = {side, side, side};
    return a->byte != 0 ? pool_vector(a->byte) : is_named(a, "up") || is_named(a, "to") ? up : good;
}

#include "calls.inc"

enum { CALLS = sizeof calls / sizeof *calls };

/* --- arguments ---------------------------------------------------------------------------------------------------- */

/* A number that calls accept, by its name; for counts, the maximum of a slot. */
static int64_t good_number(const argument *a)
{
    static const struct {
        const char *call, *name; /* call NULL: any */
        int value;
    } all[] = {
        {"lmb_probe_table_init", "width", 32},
        {"lmb_probe_blur_init", "terms", 1},
        {"lmb_voxels_init", "cap", 4700},
        {"lmb_voxels_init", "fields", 3},
        {"lmb_cones_init", "count", 7},
        {"lmb_view_sample", "samples", 4},
        {"lmb_lattice_init", "width", POOL_WIDE},
        {"lmb_tree_init", "faces", 6},
        {"lmb_surface_init", "format", LMB_RGB32F},
        {"lmb_env_init", "size", POOL_SMALL},
        {"lmb_tree_init", "size", POOL_MAP / 2},
        {"lmb_draw", "count", 100},
        {"lmb_clusters_build", "count", POOL_CLUSTERS},
        {"lmb_bins_build", "count", 100},
        {"lmb_bins_draw", "count", POOL_BINS},
        {"lmb_shadow_map_draw", "count", 100},
        {"lmb_gouraud_draw", "count", 100},
        {"lmb_around_points", "count", 100},
        {"lmb_many_lights_add", "count", POOL_LIGHTS},
        {"lmb_voxels_inject", "count", POOL_TEXELS},
        {"lmb_around_gather", "count", POOL_TEXELS},
        {"lmb_around_points", "cap", POOL_TEXELS},
        {"lmb_env_lights", "cap", POOL_LIGHTS},
        {"lmb_probe_cosine", "n", POOL_SMALL},
        {"lmb_probe_reflect", "n", POOL_SMALL},
        {"lmb_probe_cube_init", "n", POOL_SMALL},
        {"lmb_probe_sh_cube", "n", POOL_SMALL},
        {"lmb_probe_map_cube", "n", POOL_SMALL},
        {"lmb_tree_texels", "past", POOL_MAP / 8},
        {"lmb_shadow_map_rows", "past", POOL_MAP / 8},
        {"lmb_transfer_collect", "past", POOL_MAP / 8},
        {"lmb_transfer_receivers", "past", 7},
        {NULL, "camera", 0},
        {NULL, "x", 0},
        {NULL, "y", 0},
        {NULL, "x0", 0},
        {NULL, "y0", 0},
        {NULL, "face", 0},
        {NULL, "into", 0},
        {NULL, "first", 0},
        {NULL, "tile_y0", 0},
        {NULL, "tile_y1", POOL_MAP / 8},
        {NULL, "band", 0},
        {NULL, "part", 0},
        {NULL, "p", 0},
        {NULL, "from", 0},
        {NULL, "k", 4},
        {NULL, "slots", 4},
        {NULL, "step", 4},
        {NULL, "depth", 4},
        {NULL, "id_format", LMB_ID32},
        {NULL, "n", 64},
        {NULL, "side", POOL_SMALL},
        {NULL, "size", POOL_MAP},
        {NULL, "width", POOL_WIDE},
        {NULL, "height", POOL_HIGH},
        {NULL, "terms", 9},
        {NULL, "c", 0},
        {NULL, "field", 0},
        {NULL, "level", 0},
        {NULL, "units", 1000},
        {NULL, "pixels", -1},
        {NULL, "known", 1},
        {NULL, "last", 0},
        {NULL, "cells", 16},
        {NULL, "corners", 3},
        {NULL, "each", 8},
        {NULL, "rung", 2},
        {NULL, "flags", 0},
        {NULL, "i", 0},
        {NULL, "tiles", 1},
        {NULL, "wanted", 4},
        {NULL, "what", 0},
        {NULL, "format", 0},
        {NULL, "levels", 2},
        {NULL, "blend", 0},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        if ((all[i].call == NULL || calls_for(all[i].call)) && is_named(a, all[i].name)) {
            return all[i].value;
        }
    }
    return 1;
}

/* If a number is the length of an array, limits it to that array. */
static int64_t vouched(const argument *a, int64_t n)
{
    static const struct {
        const char *call, *name;
        int64_t max;
    } all[] = {
        {"lmb_many_lights_add", "count", POOL_LIGHTS},
        {"lmb_clusters_build", "count", POOL_CLUSTERS},
        {"lmb_bins_draw", "count", POOL_BINS},
        {"lmb_env_lights", "cap", POOL_LIGHTS}, {"lmb_around_points", "cap", POOL_TEXELS},
        {"lmb_around_gather", "count", POOL_TEXELS}, {"lmb_voxels_inject", "count", POOL_TEXELS},
        {"lmb_voxels_build", "count", POOL_PARTS}, {"lmb_transfer_fingerprint", "count", POOL_PLACES},
        {"lmb_polygon_factor", "corners", POOL_PLACES},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        if (calls_for(all[i].call) && is_named(a, all[i].name)) {
            return strcmp(a->type, "int32_t") == 0 || strcmp(a->type, "int") == 0
                       ? (n > all[i].max ? all[i].max : n)
                       : (n < 0 || n > all[i].max ? all[i].max : n);
        }
    }
    return n;
}

static int is_struct(const argument *a)
{
    return strncmp(a->type, "lmb_", 4) == 0 && strcmp(a->type, "lmb_kernels") != 0;
}

/* A scene for lmb_relief_scene or lmb_pack_scene to write, or, for calls that pose it, the sample's scene. */
static void *spare_scene(int is_posed)
{
    lmb_scene *s = pool_block(sizeof *s);
    size_t bytes;
    lmb_pack pack;
    if (is_posed) {
        const uint32_t *words = pool_pack(&bytes);
        fuzz_require(lmb_pack_open(&pack, words, bytes) == LMB_OK);
        bytes = lmb_pack_bytes(&pack);
        fuzz_require(lmb_pack_scene(s, &pack, pool_block(bytes), bytes) == LMB_OK);
    }
    return s;
}

static int is_spare(const argument *a)
{
    return (is_named(a, "out") && (calls_for("lmb_relief_scene") || calls_for("lmb_pack_scene"))) ||
           (calls_for("lmb_pack_pose") && is_named(a, "inout"));
}

static void take_struct(argument *a)
{
    a->is_ready = 1;
    a->memory = a->byte >= 240 ? NULL
                : strcmp(a->type, "lmb_scene") == 0 && is_spare(a) ? spare_scene(calls_for("lmb_pack_pose"))
                                                                   : pool_slot(a->type, a->byte);
}

/* A file to open: the sample with one word changed; its length is in the argument `bytes`. */
static void take_file(argument *a, argument *size)
{
    size_t bytes = 0;
    const uint32_t *words = strstr(at_call, "relief") ? pool_relief(&bytes)
                            : strstr(at_call, "pack") ? pool_pack(&bytes)
                                                      : pool_transfer(&bytes);
    uint32_t *copy = pool_block(bytes);
    memcpy(copy, words, bytes);
    if (a->byte >= 32) {
        copy[a->byte % 32 + (a->byte >= 128 ? 32 : 0)] = (uint32_t)(uint64_t)pool_whole(size->byte);
    }
    size->whole = (int64_t)(size->byte < 64 || size->byte >= 192 ? bytes : bytes * (size->byte - 64u) / 128);
    a->memory = memcpy(pool_block((size_t)size->whole), copy, (size_t)size->whole);
    a->is_ready = 1;
}

/* Memory for a call: the requested size, less, or misaligned. Returns 0 if the call requests too much; then skip it. */
static int take_memory(argument *a, argument *size, size_t asked)
{
    const size_t most = calls_for("lmb_frame_init") ? FRAME : calls_for("lmb_voxels_init") ? 8 * KEEP : KEEP;
    const size_t bytes = asked > most ? most : a->byte >= 64 && a->byte < 128 ? asked / 64 * (a->byte - 64u) : asked;
    const size_t off = a->byte >= 128 && a->byte < 136 ? a->byte % 8 : 0;
    a->is_ready = 1;
    if (size == NULL) {
        a->is_plain = asked <= POOL_ARRAY;
        a->memory = a->byte >= 240 ? NULL : a->is_plain ? plain(a, asked) : NULL;
        return asked <= POOL_ARRAY;
    }
    size->whole = (int64_t)bytes;
    a->memory = a->byte >= 240 ? NULL : (uint8_t *)pool_block(bytes + off) + off;
    return 1;
}

static int take_array(const call *c, argument *a, int i)
{
    argument *size = i + 1 < c->count && strcmp(c->parameter[i + 1].name, "bytes") == 0 ? &a[i + 1] : NULL;
    size_t asked;
    static const char *const names[] = {"avx2", "scalar", "", "sse2", "neon", "avx512"};
    if (size != NULL && (strstr(at_call, "_open") || strstr(at_call, "_swap"))) {
        take_file(&a[i], size);
        return 1;
    }
    if (calls_for("lmb_kernels_named")) {
        a[i].memory = a[i].byte >= 240 ? NULL : (void *)(uintptr_t)names[a[i].byte % 6];
        a[i].is_ready = 1;
        return 1;
    }
    if (is_named(&a[i], "text")) {
        static const char *const texts[] = {"", "a", "two\nlines", "\x7f\xff\t", "0123456789"};
        a[i].memory = a[i].byte >= 240 ? NULL : (void *)(uintptr_t)texts[a[i].byte % 5];
        a[i].is_ready = 1;
        return 1;
    }
    if (fuzz_length(&asked, a, at_call, a[i].name)) {
        return take_memory(&a[i], size, asked);
    }
    if (a[i].byte >= 240) {
        a[i].is_ready = 1; /* NULL */
    }
    return 1;
}

/* Returns 0 if the call must be skipped. */
static int prepare(const call *c, argument a[ARGUMENTS], const uint8_t *b)
{
    memset(a, 0, ARGUMENTS * sizeof *a);
    for (int i = 0; i < c->count; ++i) {
        a[i].type = c->parameter[i].type;
        a[i].name = c->parameter[i].name;
        a[i].byte = b[i];
        if (!c->parameter[i].is_pointer) {
            a[i].whole = vouched(&a[i], b[i] == 0 ? good_number(&a[i]) : pool_whole((uint8_t)(b[i] - 1)));
        } else if (is_struct(&a[i])) {
            take_struct(&a[i]);
        } else if (strcmp(a[i].type, "lmb_kernels") == 0) {
            a[i].memory = b[i] >= 240 ? NULL : (void *)(uintptr_t)lmb_kernels_at(b[i] % 4);
            a[i].is_ready = 1;
        }
    }
    for (int i = 0; i < c->count; ++i) { /* using the arguments so far */
        if (c->parameter[i].is_pointer && !a[i].is_ready && !take_array(c, a, i)) {
            return 0;
        }
    }
    return 1;
}

/* --- calls -------------------------------------------------------------------------------------------------------- */

/* Approximate cost of a call in milliseconds under sanitizers. */
static int cost_of(const char *name)
{
    static const struct {
        const char *part;
        int cost;
    } all[] = {{"lmb_render_frame", 24}, {"lmb_render_step", 5}, {"lmb_render_part", 8}, {"lmb_render_sample", 12},
               {"lmb_frame_init", 4}, {"lmb_voxels_build", 6}, {"lmb_voxels_init", 4}, {"lmb_probe_blur_init", 6},
               {"lmb_cones_diffuse", 6}, {"lmb_elements", 3}, {"lmb_many_lights_e", 3}, {"lmb_gather_cut", 6},
               {"lmb_probe_re", 4}, {"lmb_world_init", 4}, {"lmb_render", 4}, {"lmb_around", 2}, {"lmb_draw", 2}};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        if (strncmp(name, all[i].part, strlen(all[i].part)) == 0) {
            return all[i].cost;
        }
    }
    return 1;
}

/* Calls that leave their first struct unchanged when they return an error, as their headers promise. */
static int leaves_alone(const char *name)
{
    static const char *const all[] = {"lmb_surface_init", "lmb_shadow_map_init", "lmb_many_lights_init",
                                      "lmb_relief_open",  "lmb_frame_init",      "lmb_resolve_tile",
                                      "lmb_view_look_at", "lmb_render_again"};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        if (strcmp(name, all[i]) == 0) {
            return 1;
        }
    }
    return 0;
}

/* A transfer's light stores no lengths, so only files with the counts of the sample are used. */
static void drop_other_files(const call *c, const argument *a, int status)
{
    static const uint32_t counts[] = {6, 4, 6};
    lmb_transfer *t = a[0].memory;
    if (strcmp(c->name, "lmb_transfer_open") == 0 && status == LMB_OK &&
        (memcmp(&t->count[LMB_TRANSFER_PIECES], counts, sizeof counts) != 0 || t->count[LMB_TRANSFER_RECEIVERS] != 5 ||
         t->count[LMB_TRANSFER_CLUSTERS] != 2 || t->count[LMB_TRANSFER_COARSE] != 4)) {
        memset(t, 0, sizeof *t);
    }
}

static void say_call(const call *c, const argument *a)
{
    pool_say("%s(", c->name);
    for (int i = 0; i < c->count; ++i) {
        const parameter *p = &c->parameter[i];
        if (p->is_pointer) {
            pool_say("%s%s %s", i ? ", " : "", p->type,
                     a[i].memory || !a[i].is_ready ? a[i].byte & 1 ? "1" : "0" : "NULL");
        } else if (strcmp(p->type, "lmb_vec3") == 0) {
            const lmb_vec3 v = vector(&a[i]);
            pool_say("%s{%g, %g, %g}", i ? ", " : "", (double)v.x, (double)v.y, (double)v.z);
        } else {
            pool_say("%s%s %g", i ? ", " : "", p->name,
                     strstr("float double", p->type) ? number(&a[i]) : (double)a[i].whole);
        }
    }
    pool_say(")");
}

static int make_call(const call *c, const uint8_t *b)
{
    argument a[ARGUMENTS];
    at_call = c->name;
    if (!prepare(c, a, b)) {
        return 0;
    }
    const size_t bytes = leaves_alone(c->name) && a[0].memory != NULL ? pool_slot_bytes(a[0].type) : 0;
    void *before = malloc(bytes + 1);
    fuzz_require(before != NULL);
    if (bytes > 0) {
        memcpy(before, a[0].memory, bytes);
    }
    say_call(c, a);
    const int status = c->make(a);
    pool_say(c->is_status ? ": %s\n" : "\n", lmb_status_name((lmb_status)status));
    fuzz_require(status >= LMB_ERR_BUILD && status <= LMB_MORE);
    fuzz_require(status >= LMB_OK || bytes == 0 || memcmp(before, a[0].memory, bytes) == 0);
    fuzz_failures += status < LMB_OK;
    free(before);
    drop_other_files(c, a, status);
    for (int i = 0; i < c->count; ++i) {
        if (a[i].is_plain && a[i].memory != NULL) {
            memcpy(pool_raw, a[i].memory, a[i].bytes);
        }
    }
    return cost_of(c->name);
}

static int act(const uint8_t *b)
{
    if (b[0] < 192) {
        return make_call(&calls[pool_nearest(&calls[0].name, sizeof *calls, CALLS, (uint16_t)(b[1] | b[2] << 8))],
                         b + 3);
    }
    (b[0] < 208 ? pool_fill : b[0] < 224 ? pool_poke : b[0] < 240 ? pool_link : pool_change)(b + 1);
    return 1;
}

void fuzz_calls(const uint8_t *data, size_t size)
{
    int cost = 0;
    pool_begin();
    for (size_t i = 0; i < size / RECORD && i < RECORDS && cost < COST; ++i) {
        cost += act(data + i * RECORD);
    }
    pool_end();
}

#else

void fuzz_calls(const uint8_t *data, size_t size) { (void)data, (void)size; }

#endif
