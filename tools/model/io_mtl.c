/* io_mtl.c: reads OBJ material libraries: diffuse colour and map, emission, and fully transparent materials. Keywords
 * are not case-sensitive, because some programs write map_kd. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io_obj.h"

static uint64_t rotated(uint64_t v, int by) { return v << by | v >> (64 - by); }

/* SipHash with one round per word and three at the end (Aumasson and Bernstein, 2012), the upper half of the key 0. */
static void hash_round(uint64_t v[4])
{
    v[0] += v[1];
    v[2] += v[3];
    v[1] = rotated(v[1], 13) ^ v[0];
    v[3] = rotated(v[3], 16) ^ v[2];
    v[0] = rotated(v[0], 32) + v[3];
    v[2] += v[1];
    v[3] = rotated(v[3], 21) ^ v[0];
    v[1] = rotated(v[1], 17) ^ v[2];
    v[2] = rotated(v[2], 32);
}

static void hash_word(uint64_t v[4], uint64_t word)
{
    v[3] ^= word;
    hash_round(v);
    v[0] ^= word;
}

uint64_t obj_hash(uint64_t key, const void *data, size_t size)
{
    uint64_t v[4] = {UINT64_C(0x736F6D6570736575), UINT64_C(0x646F72616E646F6D), UINT64_C(0x6C7967656E657261),
                     UINT64_C(0x7465646279746573)};
    const uint8_t *at = (const uint8_t *)data;
    uint64_t word, last = (uint64_t)size << 56;
    size_t i;
    v[0] ^= key;
    v[2] ^= key;
    for (; size >= 8; size -= 8, at += 8) {
        memcpy(&word, at, 8);
        hash_word(v, word);
    }
    for (i = 0; i < size; ++i)
        last |= (uint64_t)at[i] << 8 * i;
    hash_word(v, last);
    v[2] ^= 0xFF;
    for (i = 0; i < 3; ++i)
        hash_round(v);
    return v[0] ^ v[1] ^ v[2] ^ v[3];
}

uint32_t obj_find(const obj_names *names, slice name, uint32_t *slot)
{
    *slot = (uint32_t)obj_hash(names->key, name.at, name.size) & names->mask;
    for (; names->slots[*slot] != 0; *slot = (*slot + 1) & names->mask) {
        const slice known = names->items[names->slots[*slot] - 1].name;
        if (known.size == name.size && memcmp(known.at, name.at, name.size) == 0)
            return names->slots[*slot] - 1;
    }
    return UINT32_MAX;
}

/* Converts CIE XYZ to linear light with sRGB primaries (IEC 61966-2-1), like all other colours. */
static void from_xyz(double c[3])
{
    const double x = c[0], y = c[1], z = c[2];
    c[0] = 3.2404542 * x - 1.5371385 * y - 0.4985314 * z;
    c[1] = -0.9692660 * x + 1.8760108 * y + 0.0415560 * z;
    c[2] = 0.0556434 * x - 0.2040259 * y + 1.0572252 * z;
}

/* Reads Kd or Ke: r g b, or xyz x y z; a single number is used for all three. *found is 0 for a spectrum, which is
 * in another file. */
static int read_colour(double out[3], int *found, obj_material *m, const char *name, cursor *c, report *r)
{
    slice token = {"", 0};
    int i = 0, is_xyz = 0;
    *found = 0;
    if (text_token(&token, c) && slice_is_like(token, "spectral")) {
        m->left_out |= OBJ_LEFT_SPECTRUM;
        return 1;
    }
    if (slice_is_like(token, "xyz")) {
        is_xyz = 1;
        token.size = 0;
        text_token(&token, c);
    }
    do {
        if (i == 0 && token.size == 0)
            return text_fail(c, r, "%s", name);
        if (!slice_number(&out[i], token))
            return text_fail(c, r, "%.2s takes numbers%s", name, strchr(name, ','));
        ++i;
    } while (i < 3 && text_token(&token, c));
    for (; i < 3; ++i)
        out[i] = out[0];
    if (is_xyz)
        from_xyz(out);
    *found = 1;
    return 1;
}

static int read_kd(lmb_material *out, obj_material *m, cursor *c, report *r)
{
    double v[3];
    int i, found;
    if (!read_colour(v, &found, m, "Kd needs three numbers, 0 to 1", c, r))
        return 0;
    for (i = 0; found && i < 3; ++i)
        out->albedo[i] = v[i] > 0 ? v[i] < 1 ? (float)v[i] : 1.0f : 0.0f;
    m->has_kd |= (uint8_t)found;
    return 1;
}

/* Emitted radiance. */
static int read_ke(float out[3], obj_material *m, cursor *c, report *r)
{
    double v[3];
    int i, found;
    if (!read_colour(v, &found, m, "Ke needs three numbers, 0 or more", c, r))
        return 0;
    for (i = 0; found && i < 3; ++i)
        out[i] = v[i] > 0 && v[i] < 1e30 ? (float)v[i] : 0.0f;
    return 1;
}

/* Number of values of a map's option. Values of -o -s -t may be omitted, so those are counted in the text. */
static int option_values(slice option)
{
    static const char *const one[] = {"-blendu", "-blendv", "-boost", "-texres", "-bm", "-imfchan", "-cc", "-type"};
    size_t i;
    for (i = 0; i < sizeof one / sizeof one[0]; ++i)
        if (slice_is_like(option, one[i]))
            return 1;
    return slice_is_like(option, "-mm")                                                      ? 2
           : slice_is_like(option, "-o") || slice_is_like(option, "-s") || slice_is_like(option, "-t") ? 3
                                                                                        : -1;
}

/* The index-th value of an option. */
static void take_value(obj_material *m, obj_map *map, slice option, int index, slice value)
{
    double number;
    if (slice_is_like(option, "-clamp"))
        map->wrap = slice_is_like(value, "on") ? LMB_WRAP_CLAMP : LMB_WRAP_REPEAT;
    if (!slice_number(&number, value))
        return;
    if (slice_is_like(option, "-s") && index < 2)
        map->scale[index] = number;
    if (slice_is_like(option, "-o") && index < 2)
        map->offset[index] = number;
    if ((slice_is_like(option, "-t") && number != 0) || (slice_is_like(option, "-mm") && number != index))
        m->left_out |= OBJ_LEFT_OPTION; /* turbulence; base and gain, of which 0 and 1 change nothing */
}

/* Reads the options of a map. The first other word is the start of the name. */
static void read_options(obj_material *m, obj_map *map, cursor *c)
{
    slice token, value;
    double number;
    for (;;) {
        cursor before = *c;
        int n, i;
        if (!text_token(&token, c))
            return;
        n = slice_is_like(token, "-clamp") ? 1 : option_values(token);
        if (n < 0) {
            *c = before;
            return;
        }
        for (i = 0; i < n; ++i) {
            before = *c;
            if (!text_token(&value, c))
                return;
            if (n == 3 && !slice_number(&number, value)) {
                *c = before;
                break;
            }
            take_value(m, map, token, i, value);
        }
    }
}

/* The rest of the line as a path with forward slashes, in scratch memory. */
static int read_path(char **out, model_build *b, cursor *c)
{
    slice name;
    size_t i;
    text_rest(&name, c);
    *out = (char *)build_scratch(b, (uint64_t)name.size + 1, 1);
    if (!*out)
        return 0;
    for (i = 0; i < name.size; ++i)
        (*out)[i] = name.at[i] == '\\' ? '/' : name.at[i];
    return 1;
}

/* Reads a map with options; a statement without a name changes nothing. */
static int read_map(obj_material *m, model_build *b, cursor *c)
{
    obj_map map = {NULL, {1, 1}, {0, 0}, LMB_WRAP_REPEAT};
    read_options(m, &map, c);
    if (!read_path(&map.path, b, c))
        return 0;
    if (map.path[0])
        m->map = map;
    return 1;
}

/* d 0 and Tr 1 make a surface invisible; values in between blend. The last d counts, or without a d the last Tr:
 * some exporters write the same number for both. With -halo the factor grows towards edges and is used as it is. */
static void read_opacity(lmb_material *out, obj_material *m, int is_d, cursor c)
{
    slice token;
    double v;
    if (!text_token(&token, &c) || (is_d && slice_is_like(token, "-halo") && !text_token(&token, &c)) ||
        !slice_number(&v, token) || (!is_d && m->has_d))
        return;
    m->has_d |= (uint8_t)is_d;
    const double visible = is_d ? v : 1 - v;
    m->left_out &= (uint8_t)~OBJ_LEFT_OPACITY;
    if (visible > 0 && visible < 1)
        m->left_out |= OBJ_LEFT_OPACITY;
    out->alpha = visible > 0 ? visible < 1 ? (float)visible : 1.0f : 0.0f;
    out->alpha_cutoff = 0.5f;
    out->flags &= ~(uint32_t)(LMB_ALPHA_MASK | LMB_ALPHA_BLEND);
    out->flags |= visible < 1 ? LMB_ALPHA_MASK | LMB_ALPHA_BLEND : 0;
}

/* Models 3 to 9 trace rays: mirrors and glass. The last statement counts. */
static void read_illum(obj_material *m, double illum)
{
    m->left_out &= (uint8_t)~OBJ_LEFT_MIRROR;
    if (illum >= 3 && illum <= 9)
        m->left_out |= OBJ_LEFT_MIRROR;
}

/* The feature of a statement that is ignored; 0: none, or the statement has no value. */
static uint8_t left_out_by(slice word, cursor c)
{
    static const struct {
        const char *word;
        uint8_t left_out;
    } known[] = {{"map_d", OBJ_LEFT_OPACITY_MAP}, {"map_Ke", OBJ_LEFT_EMISSION_MAP}, {"bump", OBJ_LEFT_BUMP},
                 {"map_bump", OBJ_LEFT_BUMP},     {"norm", OBJ_LEFT_BUMP},
                 {"map_Kn", OBJ_LEFT_BUMP},       {"map_norm", OBJ_LEFT_BUMP},
                 {"disp", OBJ_LEFT_RELIEF},       {"decal", OBJ_LEFT_RELIEF}};
    slice token;
    size_t i;
    for (i = 0; i < sizeof known / sizeof known[0]; ++i)
        if (slice_is_like(word, known[i].word))
            return text_token(&token, &c) ? known[i].left_out : 0;
    return 0;
}

static int read_statement(lmb_material *out, obj_material *m, model_build *b, slice word, cursor *c)
{
    slice token;
    double v;
    if (slice_is_like(word, "Kd"))
        return read_kd(out, m, c, b->r);
    if (slice_is_like(word, "Ke"))
        return read_ke(out->emission, m, c, b->r);
    if (slice_is_like(word, "map_Kd"))
        return read_map(m, b, c);
    m->left_out |= left_out_by(word, *c);
    if (slice_is_like(word, "d") || slice_is_like(word, "Tr"))
        read_opacity(out, m, slice_is_like(word, "d"), *c);
    if (slice_is_like(word, "illum") && text_token(&token, c) && slice_number(&v, token))
        read_illum(m, v);
    return 1;
}

int mtl_read(model_build *b, obj_names *names, cursor c)
{
    uint32_t current = UINT32_MAX, slot;
    slice word, name;
    names->map_key = obj_hash(names->map_key, c.at, (size_t)(c.end - c.at));
    do {
        if (!text_token(&word, &c))
            continue;
        if (slice_is_like(word, "newmtl")) {
            text_rest(&name, &c);
            current = obj_find(names, name, &slot);
            if (current != UINT32_MAX)
                names->items[current].defined = 1;
        } else if (current != UINT32_MAX &&
                   !read_statement(&b->materials[current], &names->items[current], b, word, &c)) {
            return 0;
        }
    } while (text_next_line(&c));
    return 1;
}

int mtl_find(file_bytes *out, char path[MODEL_PATH_MAX], model_build *b, slice name, report *why)
{
    char text[512];
    size_t i;
    if (name.size >= sizeof text)
        return report_fail(why, "%.40s ...: a name of %.0f bytes", name.at, (double)name.size);
    for (i = 0; i < name.size; ++i)
        text[i] = name.at[i] == '\\' ? '/' : name.at[i];
    text[i] = '\0';
    if (!build_is_relative(text))
        return report_fail(why, "%.100s: not a path from the model's folder", text);
    return build_sibling(path, MODEL_PATH_MAX, b, text, why) && build_read(b, out, path, why);
}

/* Loads a map as a new texture with index *slot. Returns 0: see `why`. */
static int load_map(int32_t *slot, model_build *b, const obj_map *map, report *why)
{
    lmb_texture *to = &b->textures[b->texture_count];
    char path[MODEL_PATH_MAX];
    file_bytes bytes = {NULL, 0};
    if (!build_is_relative(map->path))
        return report_fail(why, "%.100s: not a path from the model's folder", map->path);
    if (!build_sibling(path, sizeof path, b, map->path, why) || !build_read(b, &bytes, path, why) ||
        !build_texels(b, to, bytes.data, bytes.size, TEXELS_COLOUR, path, NULL, why))
        return 0;
    to->wrap_s = to->wrap_t = map->wrap;
    to->filter = LMB_TRILINEAR;
    *slot = (int32_t)b->texture_count++;
    return 1;
}

/* Finds the first material with the same texture. If there is none, returns `index` and adds it to the index of
 * maps. Scale and offset of the texture are in the meshes' coordinates. */
static uint32_t same_map(const obj_names *names, uint32_t *slots, uint32_t index)
{
    const obj_map *map = &names->items[index].map;
    uint32_t slot = (uint32_t)obj_hash(names->map_key, map->path, strlen(map->path)) & names->mask;
    for (; slots[slot] != 0; slot = (slot + 1) & names->mask) {
        const obj_map *known = &names->items[slots[slot] - 1].map;
        if (known->wrap == map->wrap && strcmp(known->path, map->path) == 0)
            return slots[slot] - 1;
    }
    slots[slot] = index + 1;
    return index;
}

int mtl_textures(model_build *b, obj_names *names)
{
    uint32_t *slots = (uint32_t *)build_scratch(b, (uint64_t)names->mask + 1, sizeof *slots), i, first, missing = 0;
    report why, seen;
    seen.text[0] = '\0';
    if (!slots)
        return 0;
    for (i = 0; i < names->count; ++i) {
        lmb_material *out = &b->materials[i];
        if (!names->items[i].map.path)
            continue;
        first = same_map(names, slots, i);
        why.text[0] = '\0';
        if (first != i) {
            out->texture = b->materials[first].texture;
        } else if (!load_map(&out->texture, b, &names->items[i].map, &why)) {
            if (b->r->text[0])
                return 0;
            if (missing++ == 0)
                seen = why;
        }
        if (out->texture >= 0 && !names->items[i].has_kd)
            out->albedo[0] = out->albedo[1] = out->albedo[2] = 1.0f;
    }
    if (missing)
        build_note(b, "textures left out, plain colour instead: %u (first: %.120s)", (unsigned)missing, seen.text);
    return 1;
}

void mtl_tell_left_out(model_build *b, const obj_names *names)
{
    static const struct {
        uint8_t left_out;
        const char *says;
    } all[] = {{OBJ_LEFT_OPACITY, "materials partly transparent (d, Tr), which light passes or does not by alpha 0.5"},
               {OBJ_LEFT_OPACITY_MAP, "materials whose map of opacity (map_d) is left out"},
               {OBJ_LEFT_EMISSION_MAP, "materials whose map of emission (map_Ke) is left out"},
               {OBJ_LEFT_MIRROR, "mirrors and glasses (illum 3 to 9), drawn without their mirror"},
               {OBJ_LEFT_SPECTRUM, "materials whose spectrum (Kd or Ke spectral) is left out"},
               {OBJ_LEFT_BUMP, "materials whose bump or normal map is left out"},
               {OBJ_LEFT_RELIEF, "materials whose disp or decal is left out"},
               {OBJ_LEFT_OPTION, "materials whose map_Kd is drawn without its options -t or -mm"}};
    size_t k;
    for (k = 0; k < sizeof all / sizeof all[0]; ++k) {
        uint32_t i, count = 0;
        for (i = 0; i < names->count; ++i)
            count += (names->items[i].left_out & all[k].left_out) != 0;
        if (count)
            build_note(b, "%s: %u", all[k].says, (unsigned)count);
    }
}
