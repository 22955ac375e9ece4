/* io_mtl.c: reads OBJ material libraries: diffuse colour, its map, and what is wholly transparent. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io_obj.h"

/* FNV-1a. */
static uint32_t hash_text(const char *text, size_t size)
{
    uint32_t hash = 2166136261u;
    size_t i;
    for (i = 0; i < size; ++i)
        hash = (hash ^ (uint8_t)text[i]) * 16777619u;
    return hash;
}

uint32_t obj_find(const obj_names *names, slice name, uint32_t *slot)
{
    for (*slot = hash_text(name.at, name.size) & names->mask; names->slots[*slot] != 0; *slot = (*slot + 1) & names->mask) {
        const slice known = names->items[names->slots[*slot] - 1].name;
        if (known.size == name.size && memcmp(known.at, name.at, name.size) == 0)
            return names->slots[*slot] - 1;
    }
    return UINT32_MAX;
}

static int read_kd(lmb_material *out, obj_material *m, cursor *c, report *r)
{
    slice token;
    double v;
    int i;
    for (i = 0; i < 3 && text_token(&token, c); ++i) {
        if (i == 0 && (slice_is(token, "spectral") || slice_is(token, "xyz")))
            return 1;
        if (!slice_number(&v, token))
            return text_fail(c, r, "Kd takes numbers, 0 to 1");
        out->albedo[i] = v > 0 ? v < 1 ? (float)v : 1.0f : 0.0f;
    }
    if (i == 0)
        return text_fail(c, r, "Kd needs three numbers, 0 to 1");
    for (; i < 3; ++i)
        out->albedo[i] = out->albedo[0]; /* one number: grey */
    m->has_kd = 1;
    return 1;
}

/* Emitted radiance; what a colour may leave out, it may too. */
static int read_ke(lmb_vec3 *out, cursor *c, report *r)
{
    double v[3] = {0, 0, 0};
    slice token;
    int i;
    for (i = 0; i < 3 && text_token(&token, c); ++i) {
        if (i == 0 && (slice_is(token, "spectral") || slice_is(token, "xyz")))
            return 1;
        if (!slice_number(&v[i], token))
            return text_fail(c, r, "Ke takes numbers, 0 or more");
        v[i] = v[i] > 0 && v[i] < 1e30 ? v[i] : 0;
    }
    out->x = (float)v[0];
    out->y = (float)(i == 1 ? v[0] : v[1]);
    out->z = (float)(i == 1 ? v[0] : v[2]);
    return 1;
}

/* Values of a map's option; those of -o -s -t may be left away, so numbers are counted as they come. */
static int option_values(slice option)
{
    static const char *const one[] = {"-blendu", "-blendv", "-boost", "-texres", "-bm", "-imfchan", "-cc", "-type"};
    size_t i;
    for (i = 0; i < sizeof one / sizeof one[0]; ++i)
        if (slice_is(option, one[i]))
            return 1;
    return slice_is(option, "-mm")                                                      ? 2
           : slice_is(option, "-o") || slice_is(option, "-s") || slice_is(option, "-t") ? 3
                                                                                        : -1;
}

/* Step over a map's options; only -clamp matters. What is no option is the start of the name. */
static void skip_options(obj_material *m, cursor *c)
{
    slice token, value;
    double number;
    for (;;) {
        cursor before = *c;
        int n, loose;
        if (!text_token(&token, c))
            return;
        n = slice_is(token, "-clamp") ? 1 : option_values(token);
        if (n < 0) {
            *c = before;
            return;
        }
        for (loose = n == 3; n > 0; --n) {
            before = *c;
            if (!text_token(&value, c))
                return;
            if (loose && !slice_number(&number, value)) {
                *c = before;
                break;
            }
            if (slice_is(token, "-clamp") && slice_is(value, "on"))
                m->wrap = LMB_WRAP_CLAMP;
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

/* d 0 and Tr 1 make a surface vanish; everything between is drawn opaque. */
static void read_opacity(lmb_material *out, double visible)
{
    if (visible > 0)
        return;
    out->alpha = 0.0f;
    out->flags |= LMB_ALPHA_MASK;
}

static int read_statement(lmb_material *out, obj_material *m, model_build *b, slice word, cursor *c)
{
    slice token;
    double v;
    if (slice_is(word, "Kd"))
        return read_kd(out, m, c, b->r);
    if (slice_is(word, "Ke"))
        return read_ke(&b->out->emission[out - b->materials], c, b->r);
    if (slice_is(word, "map_Kd")) {
        skip_options(m, c);
        return read_path(&m->map, b, c);
    }
    if ((slice_is(word, "d") || slice_is(word, "Tr")) && text_token(&token, c) && slice_number(&v, token))
        read_opacity(out, slice_is(word, "d") ? v : 1 - v);
    return 1;
}

int mtl_read(model_build *b, obj_names *names, cursor c)
{
    uint32_t current = UINT32_MAX, slot;
    slice word, name;
    do {
        if (!text_token(&word, &c))
            continue;
        if (slice_is(word, "newmtl")) {
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

int mtl_load(model_build *b, obj_names *names, slice file)
{
    char name[512], path[MODEL_PATH_MAX];
    file_bytes bytes = {NULL, 0};
    report why;
    size_t i;
    int ok;
    why.text[0] = '\0';
    snprintf(name, sizeof name, "%.*s", file.size < sizeof name ? (int)file.size : (int)sizeof name - 1, file.at);
    for (i = 0; name[i]; ++i)
        if (name[i] == '\\')
            name[i] = '/';
    if (!build_is_relative(name))
        report_fail(&why, "%.100s: not a path from the model's folder", name);
    if (why.text[0] || !build_sibling(path, sizeof path, b, name, &why) || !build_read(b, &bytes, path, &why)) {
        build_note(b, "no material library (%.150s); its materials are grey", why.text);
        return 1;
    }
    ok = mtl_read(b, names, text_open(bytes.data, bytes.size, path));
    return ok;
}

/* The map of materials[index]; the slot of an earlier material with the same map, or a new one. 0: see `why`. */
static int load_map(int32_t *slot, model_build *b, const obj_names *names, uint32_t index, report *why)
{
    const obj_material *m = &names->items[index];
    lmb_texture *to = &b->textures[b->texture_count];
    char path[MODEL_PATH_MAX];
    file_bytes bytes = {NULL, 0};
    int ok;
    if (!build_is_relative(m->map))
        return report_fail(why, "%.100s: not a path from the model's folder", m->map);
    if (!build_sibling(path, sizeof path, b, m->map, why) || !build_read(b, &bytes, path, why))
        return 0;
    ok = build_texels(b, to, bytes.data, bytes.size, TEXELS_COLOUR, path, why);
    if (!ok)
        return 0;
    to->wrap_s = to->wrap_t = m->wrap;
    to->filter = LMB_TRILINEAR;
    *slot = (int32_t)b->texture_count++;
    return 1;
}

/* The first material that shows the same map in the same way; `index` itself, which then stands in the index of maps,
 * where there is none. */
static uint32_t same_map(const obj_names *names, uint32_t *slots, uint32_t index)
{
    const obj_material *m = &names->items[index];
    uint32_t slot = (hash_text(m->map, strlen(m->map)) ^ m->wrap) & names->mask;
    for (; slots[slot] != 0; slot = (slot + 1) & names->mask) {
        const obj_material *known = &names->items[slots[slot] - 1];
        if (known->wrap == m->wrap && strcmp(known->map, m->map) == 0)
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
        if (!names->items[i].map)
            continue;
        first = same_map(names, slots, i);
        why.text[0] = '\0';
        if (first != i) {
            out->texture = b->materials[first].texture;
        } else if (!load_map(&out->texture, b, names, i, &why)) {
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
