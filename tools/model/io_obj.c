/* io_obj.c: reads Wavefront OBJ: polygons to triangles, corners to vertices, one mesh and instance per material.
 *
 * Two passes: the first counts, so that every array has its final size; the second fills. A corner, two bytes of text
 * or more, costs at most 36 bytes while reading, 60 more in the widest face of the file, and 28 in the model; a
 * triangle 20 and 12. Smoothing groups cost 88 more for each vertex, or for each corner if there are fewer corners. The
 * worst case is one huge face of one-digit corners, 64 bytes for each byte of the file: within MODEL_BYTES_PER_BYTE,
 * textures excluded. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io_obj.h"
#include "ear_clip.h"
#include "smooth_normals.h"

#define NONE          UINT32_MAX
#define SMOOTH        0x80000000u /* in place of a vn: use the normal of the smoothing group in the lower bits */
#define MAX_LIBRARIES 64
#define MAX_PROBES    256 /* in a hash table that is half empty, so that only a malicious file comes near */

/* A vertex: indices of v, vt and vn from 0; NONE: not given. vn may be SMOOTH | group. */
typedef struct corner {
    uint32_t v, vt, vn;
} corner;

/* Corners by number; group is 2 * material + (has normals). */
typedef struct triangle {
    uint32_t corner[3];
    uint32_t group;
} triangle;

/* Counts of the first pass; 64 bits, because a file of 4 GiB can have more items than 32 bits hold. */
typedef struct census {
    uint64_t v, vt, vn, corners, triangles, names, libraries, smoothings;
    uint64_t widest; /* most corners of a face */
    int colours;     /* some v has six numbers */
    uint64_t fourth, seventh;  /* lines of v with seven numbers, if the fourth (seventh) is not 1 */
    int whole_codes, fractions; /* some colour has two digits or more and no point; some colour has a point */
} census;

typedef struct obj {
    model_build *b;
    census n;
    float *v, *vt, *vn;
    uint16_t *colours;                    /* RGBA16 by v, A 0: no colour; or NULL */
    uint32_t v_count, vt_count, vn_count; /* so far: base of negative numbers */
    corner *corners;                      /* unique */
    uint32_t corner_count;
    uint32_t *slots; /* open addressing over corners: number + 1 */
    uint32_t slot_mask;
    triangle *triangles;
    uint32_t triangle_count;
    obj_names names;
    slice libraries[MAX_LIBRARIES];
    uint32_t library_count, library_extra;
    uint32_t material; /* of the faces that follow */
    uint32_t smoothing; /* group of the faces that follow; 0: flat */
    smooth_normals smooth;
    corner *face;      /* scratch for one face: corners, numbers, points and triangles */
    uint32_t *face_number, *face_cut, *face_links;
    double *face_points;
    uint64_t cut_steps; /* of polygon_cut_within, left for all faces */
    uint32_t points_lines, degenerate, overlapping, translucent, smoothed, odd_groups;
} obj;

/* --- first pass --- */

static void count_face(census *n, cursor *c)
{
    slice token;
    uint64_t corners = 0;
    while (text_token(&token, c))
        ++corners;
    n->corners += corners;
    n->triangles += corners > 2 ? corners - 2 : 0;
    n->widest = corners > n->widest ? corners : n->widest;
}

static int is_one(slice token)
{
    double v;
    return slice_number(&v, token) && v == 1;
}

static void count_colour(census *n, slice code)
{
    size_t i = 0;
    while (i < code.size && code.at[i] >= '0' && code.at[i] <= '9')
        ++i;
    n->whole_codes = n->whole_codes || (i == code.size && i > 1);
    n->fractions = n->fractions || i < code.size;
}

static void count_v(census *n, cursor *c)
{
    slice token[7];
    int numbers = 0, i;
    while (numbers < 7 && text_token(&token[numbers], c))
        ++numbers;
    ++n->v;
    n->colours = n->colours || numbers >= 6;
    for (i = 4; numbers >= 6 && i < 6; ++i) /* colours with and without a weight */
        count_colour(n, token[i]);
    if (numbers == 7) {
        n->fourth += !is_one(token[3]);
        n->seventh += !is_one(token[6]);
    }
}

/* fo is the word for a face in old files; readers treat it as f (appendix B1 of Wavefront's manual). */
static int is_face(slice word) { return slice_is_like(word, "f") || slice_is_like(word, "fo"); }

static census count_all(cursor c)
{
    census n;
    slice word;
    memset(&n, 0, sizeof n);
    do {
        if (!text_token(&word, &c))
            continue;
        if (slice_is_like(word, "v")) {
            count_v(&n, &c);
        } else if (slice_is_like(word, "vt")) {
            ++n.vt;
        } else if (slice_is_like(word, "vn")) {
            ++n.vn;
        } else if (is_face(word)) {
            count_face(&n, &c);
        } else if (slice_is_like(word, "usemtl")) {
            ++n.names;
        } else if (slice_is_like(word, "s")) {
            ++n.smoothings;
        }
    } while (text_next_line(&c));
    return n;
}

/* The least power of two that is at least twice n: half of the slots stay empty. */
static uint64_t slots_for(uint64_t n)
{
    uint64_t slots = 16;
    while (slots < 2 * n)
        slots *= 2;
    return slots;
}

static int allocate_names(obj *o)
{
    const uint64_t n = o->n.names + 1, slots = slots_for(n);
    uint32_t slot;
    slice nothing = {"", 0};
    o->names.items = (obj_material *)build_scratch(o->b, n, sizeof *o->names.items);
    o->names.slots = (uint32_t *)build_scratch(o->b, slots, sizeof *o->names.slots);
    o->names.mask = (uint32_t)(slots - 1);
    if (!o->names.items || !o->names.slots)
        return 0;
    o->names.items[0].name = nothing;
    obj_find(&o->names, nothing, &slot);
    o->names.slots[slot] = 1;
    o->names.count = 1;
    return 1;
}

static int allocate(obj *o)
{
    const census *n = &o->n;
    const uint64_t slots = slots_for(n->corners);
    if (n->v >= NONE / 4 || n->vt >= NONE / 4 || n->vn >= NONE / 4 || n->corners >= NONE / 4)
        return report_fail(o->b->r, "%s: more than a thousand million elements; split it", o->b->path);
    o->v = (float *)build_scratch(o->b, n->v, 3 * sizeof *o->v);
    o->vt = (float *)build_scratch(o->b, n->vt, 2 * sizeof *o->vt);
    o->vn = (float *)build_scratch(o->b, n->vn, 3 * sizeof *o->vn);
    o->corners = (corner *)build_scratch(o->b, n->corners, sizeof *o->corners);
    o->slots = (uint32_t *)build_scratch(o->b, slots, sizeof *o->slots);
    o->slot_mask = (uint32_t)(slots - 1);
    o->triangles = (triangle *)build_scratch(o->b, n->triangles, sizeof *o->triangles);
    o->face = (corner *)build_scratch(o->b, n->widest, sizeof *o->face);
    o->face_number = (uint32_t *)build_scratch(o->b, n->widest, sizeof *o->face_number);
    o->face_cut = (uint32_t *)build_scratch(o->b, n->widest, 3 * sizeof *o->face_cut);
    o->face_links = (uint32_t *)build_scratch(o->b, n->widest, 2 * sizeof *o->face_links);
    o->face_points = (double *)build_scratch(o->b, n->widest, 3 * sizeof *o->face_points);
    if (n->colours && !(o->colours = (uint16_t *)build_scratch(o->b, n->v, 4 * sizeof *o->colours)))
        return 0;
    return o->v && o->vt && o->vn && o->corners && o->slots && o->triangles && o->face && o->face_number &&
           o->face_cut && o->face_links && o->face_points && allocate_names(o);
}

/* --- second pass --- */

/* Reads up to `max` numbers of the line, *count of them; fewer than `min` is an error. */
static int read_numbers(double *out, int *count, int min, int max, cursor *c, report *r)
{
    slice token;
    *count = 0;
    while (*count < max && text_token(&token, c)) {
        if (!slice_number(&out[*count], token))
            return text_fail(c, r, "\"%.*s\" is not a number; repair the line", token.size < 40 ? (int)token.size : 40,
                             token.at);
        ++*count;
    }
    return *count >= min || text_fail(c, r, "%d numbers where %d are needed; repair the line", *count, min);
}

/* Seven numbers are x y z r g b a, as most programs write, or x y z w r g b if the weight is 1 in the whole file. */
static int first_colour(const census *n, int numbers)
{
    return numbers == 7 && n->fourth == 0 && n->seventh > 0 ? 4 : 3;
}

/* Colours are 0 .. 1, or integers up to 255. */
static void put_colour(obj *o, const double *code, int has_alpha)
{
    uint16_t *to = o->colours + 4 * (size_t)o->v_count;
    const double top = o->n.whole_codes && !o->n.fractions ? 255 : 1;
    int i;
    for (i = 0; i < 3; ++i)
        to[i] = build_colour(o->b, code[i] / top);
    to[3] = 65535;
    o->translucent += has_alpha && code[3] < top && code[3] != 1;
}

/* Reads x y z, then an optional weight (ignored) or colour. */
static int read_v(obj *o, cursor *c)
{
    double v[7];
    int n, i;
    if (!read_numbers(v, &n, 3, 7, c, o->b->r))
        return 0;
    for (i = 0; i < 3; ++i)
        o->v[3 * (size_t)o->v_count + (size_t)i] = build_float(v[i]);
    if (n >= 6)
        put_colour(o, v + first_colour(&o->n, n), n == 7 && first_colour(&o->n, n) == 3);
    ++o->v_count;
    return 1;
}

/* In OBJ v counts upwards from the bottom of the image, in lambent downwards from the top. */
static int read_vt(obj *o, cursor *c)
{
    double v[3] = {0, 0, 0};
    int n;
    if (!read_numbers(v, &n, 1, 3, c, o->b->r))
        return 0;
    o->vt[2 * (size_t)o->vt_count] = build_uv(v[0]);
    o->vt[2 * (size_t)o->vt_count + 1] = build_uv(1 - v[1]);
    ++o->vt_count;
    return 1;
}

static int read_vn(obj *o, cursor *c)
{
    double v[3];
    lmb_vec3 unit;
    float *to = o->vn + 3 * (size_t)o->vn_count;
    uint32_t zeros = 0;
    int n;
    if (!read_numbers(v, &n, 3, 3, c, o->b->r))
        return 0;
    unit = build_normal(v, &zeros);
    to[0] = zeros ? 0 : unit.x;
    to[1] = zeros ? 0 : unit.y;
    to[2] = zeros ? 0 : unit.z;
    ++o->vn_count;
    return 1;
}

/* One number of a corner: from 1 over the whole file, or relative. `total` are in the file, `here` were read so far. */
static int resolve(uint32_t *out, slice number, uint64_t total, uint32_t here, const char *what, cursor *c, report *r)
{
    int64_t value;
    if (!slice_integer(&value, number))
        return text_fail(c, r, "\"%.*s\" is not a %s number; repair the line", number.size < 40 ? (int)number.size : 40,
                         number.at, what);
    if (value > 0 && (uint64_t)value <= total) {
        *out = (uint32_t)(value - 1);
        return 1;
    }
    if (value < 0 && -value <= (int64_t)here) {
        *out = here - (uint32_t)-value;
        return 1;
    }
    return text_fail(c, r, "%s number %.*s, but there are %u; repair the line", what,
                     number.size < 40 ? (int)number.size : 40, number.at, (unsigned)(value < 0 ? here : total));
}

/* Returns the text before the next slash; the rest stays in *token. */
static slice cut_at_slash(slice *token)
{
    slice part = *token;
    part.size = 0;
    while (part.size < token->size && token->at[part.size] != '/')
        ++part.size;
    token->at += part.size;
    token->size -= part.size;
    if (token->size) {
        ++token->at;
        --token->size;
    }
    return part;
}

/* v, v/vt, v//vn or v/vt/vn. */
static int read_corner(corner *out, const obj *o, slice token, cursor *c)
{
    const slice v = cut_at_slash(&token), vt = cut_at_slash(&token), vn = token;
    out->vt = out->vn = NONE;
    if (!resolve(&out->v, v, o->n.v, o->v_count, "v", c, o->b->r))
        return 0;
    if (vt.size && !resolve(&out->vt, vt, o->n.vt, o->vt_count, "vt", c, o->b->r))
        return 0;
    return !vn.size || resolve(&out->vn, vn, o->n.vn, o->vn_count, "vn", c, o->b->r);
}

/* Returns the number of an equal corner, or adds the corner. The table has room for all corners of the file. A
 * corner that finds no slot nearby becomes a new vertex each time. */
static uint32_t intern(obj *o, const corner *key)
{
    uint32_t hash = key->v * 0x9E3779B1u ^ key->vt * 0x85EBCA77u ^ key->vn * 0xC2B2AE3Du, slot, probes = 0;
    hash ^= hash >> 15;
    for (slot = hash & o->slot_mask; o->slots[slot] && probes < MAX_PROBES; slot = (slot + 1) & o->slot_mask) {
        const corner *known = &o->corners[o->slots[slot] - 1];
        if (known->v == key->v && known->vt == key->vt && known->vn == key->vn)
            return o->slots[slot] - 1;
        ++probes;
    }
    o->corners[o->corner_count++] = *key;
    if (!o->slots[slot])
        o->slots[slot] = o->corner_count;
    return o->corner_count - 1;
}

/* A corner without a normal uses the normal of the smoothing group. Without a group the face is flat. */
static int smooth_face(obj *o, uint32_t n)
{
    uint32_t i;
    for (i = 0; i < n; ++i)
        if (o->smoothing == 0)
            o->face[i].vn = NONE;
        else if (o->face[i].vn == NONE)
            o->face[i].vn = SMOOTH | o->smoothing;
    o->smoothed += o->smoothing != 0;
    return o->smoothing != 0;
}

/* A face may refer to vertices that come later in the file. These are still 0 here, so such a face is cut with the
 * known ones; the corners are filled in when the whole file was read. */
static void cut_face(obj *o, uint32_t n, int with_normals)
{
    uint32_t i, k;
    for (i = 0; i < n; ++i) {
        o->face_number[i] = intern(o, &o->face[i]);
        for (k = 0; k < 3; ++k)
            o->face_points[3 * (size_t)i + k] = (double)o->v[3 * (size_t)o->face[i].v + k];
    }
    if (!polygon_cut_within(o->face_cut, o->face_points, n, o->face_links, &o->cut_steps))
        ++o->overlapping;
    for (i = 0; i < n - 2; ++i) {
        triangle *t = &o->triangles[o->triangle_count++];
        for (k = 0; k < 3; ++k)
            t->corner[k] = o->face_number[o->face_cut[3 * (size_t)i + k]];
        t->group = 2 * o->material + (uint32_t)with_normals;
    }
}

static int read_face(obj *o, cursor *c)
{
    slice token;
    uint32_t n = 0;
    int with_normals = 1;
    while (text_token(&token, c)) {
        if (!read_corner(&o->face[n], o, token, c))
            return 0;
        with_normals = with_normals && o->face[n].vn != NONE;
        ++n;
    }
    if (n < 3)
        ++o->degenerate;
    else
        cut_face(o, n, with_normals || smooth_face(o, n));
    return 1;
}

/* `s off` and `s 0` mean flat, `s on` means group 1. An invalid group counts as no group and is noted. */
static void use_smoothing(obj *o, cursor *c)
{
    slice word = {"", 0};
    int64_t group = 0;
    const int has_word = text_token(&word, c), is_off = has_word && slice_is_like(word, "off");
    if (has_word && slice_is_like(word, "on"))
        group = 1;
    else if (!is_off && (!slice_integer(&group, word) || group < 0 || group >= (int64_t)(NONE - SMOOTH))) {
        ++o->odd_groups;
        group = 0;
    }
    o->smoothing = (uint32_t)group;
}

static void use_material(obj *o, cursor *c)
{
    slice name;
    uint32_t slot;
    text_rest(&name, c);
    o->material = obj_find(&o->names, name, &slot);
    if (o->material != UINT32_MAX)
        return;
    o->material = o->names.count++;
    o->names.items[o->material].name = name;
    o->names.slots[slot] = o->names.count;
}

static void add_library(obj *o, slice name)
{
    uint32_t i;
    for (i = 0; i < o->library_count; ++i)
        if (o->libraries[i].size == name.size && memcmp(o->libraries[i].at, name.at, name.size) == 0)
            return;
    if (o->library_count < MAX_LIBRARIES)
        o->libraries[o->library_count++] = name;
    else
        ++o->library_extra;
}

static int read_line(obj *o, cursor *c)
{
    slice word;
    if (!text_token(&word, c))
        return 1;
    if (slice_is_like(word, "v"))
        return read_v(o, c);
    if (slice_is_like(word, "vt"))
        return read_vt(o, c);
    if (slice_is_like(word, "vn"))
        return read_vn(o, c);
    if (is_face(word))
        return read_face(o, c);
    if (slice_is_like(word, "usemtl"))
        use_material(o, c);
    if (slice_is_like(word, "s"))
        use_smoothing(o, c);
    if (slice_is_like(word, "mtllib")) {
        text_rest(&word, c);
        add_library(o, word);
    }
    o->points_lines += slice_is_like(word, "l") || slice_is_like(word, "p");
    return 1;
}

/* --- materials --- */

/* Splits a line into names if the whole line is not the name of a file; returns 0 if there is at most one. */
static int split_library(obj *o, slice line)
{
    cursor c = text_open((const uint8_t *)line.at, line.size, o->b->path);
    slice name;
    if (!text_token(&name, &c) || name.size == line.size)
        return 0;
    do
        add_library(o, name);
    while (text_token(&name, &c));
    return 1;
}

/* A file with several names is read once. */
static int is_read_before(const uint8_t **before, uint32_t *count, const uint8_t *data)
{
    uint32_t i;
    for (i = 0; i < *count; ++i)
        if (before[i] == data)
            return 1;
    before[(*count)++] = data;
    return 0;
}

static int load_libraries(obj *o)
{
    const uint8_t *before[MAX_LIBRARIES];
    char path[MODEL_PATH_MAX];
    uint32_t i, count = 0, missing = 0;
    file_bytes file;
    report why, first;
    first.text[0] = '\0';
    for (i = 0; i < o->library_count; ++i) {
        why.text[0] = '\0';
        if (mtl_find(&file, path, o->b, o->libraries[i], &why)) {
            if (!is_read_before(before, &count, file.data) &&
                !mtl_read(o->b, &o->names, text_open(file.data, file.size, path)))
                return 0;
        } else if (o->b->r->text[0]) {
            return 0;
        } else if (!split_library(o, o->libraries[i]) && missing++ == 0) {
            first = why;
        }
    }
    if (missing)
        build_note(o->b, "material libraries left out, whose materials are grey: %u (first: %.120s)", (unsigned)missing,
                   first.text);
    return 1;
}

/* Faces before the first usemtl have no material. */
static int keep_names(obj *o)
{
    const char **names = (const char **)build_keep(o->b, o->names.count, sizeof *names);
    uint32_t i;
    for (i = 1; names && i < o->names.count; ++i) {
        const slice name = o->names.items[i].name;
        char *kept = (char *)build_keep(o->b, (uint64_t)name.size + 1, 1);
        if (!kept)
            return 0;
        memcpy(kept, name.at, name.size);
        names[i] = kept;
    }
    o->b->out->material_names = names;
    return names != NULL;
}

/* Returns 1 if the only known colours of a material are vertex colours. */
static int is_painted(const obj *o, uint32_t material) { return o->colours && !o->names.items[material].has_kd; }

/* Materials are middle grey until a library sets them, or white with vertex colours. They are double-sided because OBJ
 * does not specify sides. */
static int make_materials(obj *o)
{
    uint32_t i, undefined = 0;
    slice first = {"", 0};
    model_build *b = o->b;
    b->textures = (lmb_texture *)build_keep(b, o->names.count, sizeof *b->textures);
    if (!build_materials(b, o->names.count) || !b->textures)
        return 0;
    b->material_count = o->names.count;
    for (i = 0; i < o->names.count; ++i) {
        lmb_material *m = &b->materials[i];
        m->albedo[0] = m->albedo[1] = m->albedo[2] = 0.8f;
        m->alpha = 1.0f;
        m->alpha_cutoff = 0.5f;
        m->texture = -1;
        m->flags = LMB_DOUBLE_SIDED;
    }
    if (!load_libraries(o) || !keep_names(o))
        return 0;
    for (i = 1; i < o->names.count; ++i) {
        if (!o->names.items[i].defined && undefined++ == 0)
            first = o->names.items[i].name;
    }
    if (undefined)
        build_note(b, "materials that no library describes, drawn grey: %u (first: %.*s)", (unsigned)undefined,
                   (int)(first.size < 60 ? first.size : 60), first.at);
    for (i = 0; i < o->names.count; ++i)
        if (is_painted(o, i))
            b->materials[i].albedo[0] = b->materials[i].albedo[1] = b->materials[i].albedo[2] = 1.0f;
    mtl_tell_left_out(b, &o->names);
    return mtl_textures(b, &o->names);
}

/* --- smoothing groups --- */

static uint32_t group_of(const corner *c) { return c->vn != NONE && c->vn >= SMOOTH ? c->vn - SMOOTH : 0; }

/* Computes the normals of smoothing groups once all vertices are known. */
static int sum_normals(obj *o, uint64_t key)
{
    uint32_t i, k;
    if (!o->smoothed)
        return 1;
    const uint64_t n = o->n.smoothings < o->n.corners / o->n.v ? o->n.v * o->n.smoothings : o->n.corners;
    if (!smooth_open(&o->smooth, o->b, n, key))
        return 0;
    for (i = 0; i < o->triangle_count; ++i) {
        const float *place[3];
        uint32_t group[3];
        for (k = 0; k < 3; ++k) {
            const corner *c = &o->corners[o->triangles[i].corner[k]];
            place[k] = o->v + 3 * (size_t)c->v;
            group[k] = group_of(c);
        }
        smooth_add(&o->smooth, place, group);
    }
    return 1;
}

/* --- meshes --- */

/* Sorts triangles by group: numbers of triangles, and the start of each group (groups + 1). */
static int sort_by_group(uint32_t **sorted, uint32_t **starts, obj *o)
{
    const uint32_t groups = 2 * o->names.count;
    uint32_t i;
    *sorted = (uint32_t *)build_scratch(o->b, o->triangle_count, sizeof **sorted);
    *starts = (uint32_t *)build_scratch(o->b, (uint64_t)groups + 2, sizeof **starts);
    if (!*sorted || !*starts)
        return 0;
    for (i = 0; i < o->triangle_count; ++i)
        ++(*starts)[o->triangles[i].group + 2];
    for (i = 2; i < groups + 2; ++i)
        (*starts)[i] += (*starts)[i - 1];
    for (i = 0; i < o->triangle_count; ++i)
        (*sorted)[(*starts)[o->triangles[i].group + 1]++] = i;
    return 1;
}

/* Numbers the corners of these triangles in the order of first use: local[corner] = number + 1, used[number] =
 * corner. */
static uint32_t number_corners(uint32_t *local, uint32_t *used, const obj *o, const uint32_t *list, uint32_t n)
{
    uint32_t count = 0, i, k;
    for (i = 0; i < n; ++i)
        for (k = 0; k < 3; ++k) {
            const uint32_t corner_number = o->triangles[list[i]].corner[k];
            if (local[corner_number])
                continue;
            used[count++] = corner_number;
            local[corner_number] = count;
        }
    return count;
}

static int fill_indices(lmb_mesh *out, const obj *o, const uint32_t *local, const uint32_t *list)
{
    const int small = out->vertex_count <= 65536;
    void *indices = build_keep(o->b, 3 * (uint64_t)out->triangle_count, small ? 2 : 4);
    uint32_t i, k;
    if (!indices)
        return 0;
    for (i = 0; i < out->triangle_count; ++i)
        for (k = 0; k < 3; ++k) {
            const uint32_t number = local[o->triangles[list[i]].corner[k]] - 1;
            if (small)
                ((uint16_t *)indices)[3 * (size_t)i + k] = (uint16_t)number;
            else
                ((uint32_t *)indices)[3 * (size_t)i + k] = number;
        }
    out->indices = indices;
    out->index_format = small ? LMB_INDEX_U16 : LMB_INDEX_U32;
    return 1;
}

/* If only some vertices have colours, the others are grey or white, as in a file without vertex colours. */
static void fill_colour(uint16_t *to, const uint16_t *from, int is_grey)
{
    if (from[3] != 0)
        memcpy(to, from, 4 * sizeof *to);
    else
        to[0] = to[1] = to[2] = build_linear(is_grey ? 0.8 : 1), to[3] = 65535;
}

static int fill_positions(lmb_mesh *out, const obj *o, uint32_t material, const uint32_t *used)
{
    const int is_grey = is_painted(o, material) && o->b->materials[material].texture < 0;
    float *positions = (float *)build_keep(o->b, out->vertex_count, 3 * sizeof *positions);
    uint16_t *colours = o->colours ? (uint16_t *)build_keep(o->b, out->vertex_count, 4 * sizeof *colours) : NULL;
    uint32_t i;
    if (!positions || (o->colours && !colours))
        return 0;
    for (i = 0; i < out->vertex_count; ++i) {
        const size_t v = o->corners[used[i]].v;
        memcpy(positions + 3 * (size_t)i, o->v + 3 * v, 3 * sizeof *positions);
        if (colours)
            fill_colour(colours + 4 * (size_t)i, o->colours + 4 * v, is_grey);
    }
    out->positions = positions;
    out->colour_format = colours ? build_narrow(colours, out->vertex_count) : LMB_COLOUR_RGBA8;
    out->colours = (const uint8_t *)colours;
    out->position_format = LMB_POSITION_F32;
    return 1;
}

/* Scales and moves as OBJ does; with v downwards the result is 1 - v. */
static void lay_map(float uv[2], const obj_map *map)
{
    uv[0] = build_uv((double)uv[0] * map->scale[0] + map->offset[0]);
    uv[1] = build_uv((double)uv[1] * map->scale[1] + (1 - map->scale[1] - map->offset[1]));
}

/* Fills texture coordinates if the material has a texture; corners without them get (0, 0). */
static int fill_uvs(lmb_mesh *out, const obj *o, const obj_map *map, const uint32_t *used)
{
    float *uvs = (float *)build_keep(o->b, out->vertex_count, 2 * sizeof *uvs);
    uint32_t i;
    if (!uvs)
        return 0;
    for (i = 0; i < out->vertex_count; ++i) {
        const uint32_t vt = o->corners[used[i]].vt;
        if (vt == NONE)
            continue;
        memcpy(uvs + 2 * (size_t)i, o->vt + 2 * (size_t)vt, 2 * sizeof *uvs);
        lay_map(uvs + 2 * (size_t)i, map);
    }
    out->uvs = uvs;
    out->uv_format = LMB_UV_F32;
    return 1;
}

static void code_normal(int16_t out[2], const obj *o, const corner *c)
{
    const uint32_t group = group_of(c);
    if (group != 0) {
        lmb_octahedral_encode(out, smooth_at(&o->smooth, o->v + 3 * (size_t)c->v, group));
        return;
    }
    static const double nothing[3] = {0, 0, 0};
    const float *n = o->vn + 3 * (size_t)c->vn;
    const lmb_vec3 unit = {n[0], n[1], n[2]};
    if (n[0] == 0 && n[1] == 0 && n[2] == 0)
        build_normal_code(o->b, out, nothing);
    else
        lmb_octahedral_encode(out, unit);
}

static int fill_normals(lmb_mesh *out, const obj *o, const uint32_t *used)
{
    int16_t *codes = (int16_t *)build_keep(o->b, out->vertex_count, 2 * sizeof *codes);
    uint32_t i;
    if (!codes)
        return 0;
    for (i = 0; i < out->vertex_count; ++i) {
        code_normal(codes + 2 * (size_t)i, o, &o->corners[used[i]]);
    }
    out->normals = codes;
    return 1;
}

static int fill_mesh(lmb_mesh *out, const obj *o, uint32_t group, const uint32_t *list, uint32_t *local, uint32_t *used)
{
    uint32_t i;
    out->vertex_count = number_corners(local, used, o, list, out->triangle_count);
    if (!fill_indices(out, o, local, list) || !fill_positions(out, o, group / 2, used))
        return 0;
    if (o->b->materials[group / 2].texture >= 0 && !fill_uvs(out, o, &o->names.items[group / 2].map, used))
        return 0;
    if (group % 2 && !fill_normals(out, o, used))
        return 0;
    for (i = 0; i < out->vertex_count; ++i)
        local[used[i]] = 0;
    return 1;
}

static void place(lmb_instance *out, uint32_t mesh, uint32_t material)
{
    out->to_world.m[0] = out->to_world.m[5] = out->to_world.m[10] = out->to_world.m[15] = 1.0f;
    out->mesh = mesh;
    out->material = material;
}

/* Makes a mesh and an instance for each group with triangles. */
static int make_meshes(obj *o)
{
    const uint32_t groups = 2 * o->names.count;
    model_build *b = o->b;
    uint32_t *sorted, *starts, g;
    uint32_t *local = (uint32_t *)build_scratch(b, o->corner_count, sizeof *local);
    uint32_t *used = (uint32_t *)build_scratch(b, o->corner_count, sizeof *used);
    b->meshes = (lmb_mesh *)build_keep(b, groups, sizeof *b->meshes);
    b->instances = (lmb_instance *)build_keep(b, groups, sizeof *b->instances);
    if (!local || !used || !b->meshes || !b->instances || !sort_by_group(&sorted, &starts, o))
        return 0;
    for (g = 0; g < groups; ++g) {
        lmb_mesh *mesh = &b->meshes[b->mesh_count];
        mesh->triangle_count = starts[g + 1] - starts[g];
        if (mesh->triangle_count == 0)
            continue;
        if (!fill_mesh(mesh, o, g, sorted + starts[g], local, used))
            return 0;
        place(&b->instances[b->instance_count++], b->mesh_count++, g / 2);
    }
    return 1;
}

static void tell_left_out(const obj *o)
{
    build_note_count(o->b, "elements of points or lines skipped", o->points_lines);
    build_note_count(o->b, "faces with fewer than 3 corners skipped", o->degenerate);
    build_note_count(o->b, "concave faces too large or too tangled to cut well, which may overlap themselves",
                     o->overlapping);
    build_note_count(o->b, "faces without normals that their smoothing group (s) makes smooth", o->smoothed);
    build_note_count(o->b, "smoothing groups that are no number, taken as off", o->odd_groups);
    build_note_count(o->b, "vertices with an alpha under 1, drawn opaque", o->translucent);
    if (o->colours && o->n.whole_codes && !o->n.fractions)
        build_note(o->b, "colours of vertices are whole numbers, read as 0 to 255");
    build_note_count(o->b, "material libraries left out after the first 64", o->library_extra);
}

int obj_load(model_build *b, const uint8_t *data, size_t size)
{
    obj o;
    cursor c = text_open(data, size, b->path);
    memset(&o, 0, sizeof o);
    o.b = b;
    o.cut_steps = polygon_steps(size);
    o.n = count_all(c);
    if (o.n.triangles == 0)
        return report_fail(b->r, "%s: no faces; give a polygon model", b->path);
    if (o.n.names)
        o.names.key = o.names.map_key = obj_hash(0, data, size);
    if (!allocate(&o))
        return 0;
    do {
        if (!read_line(&o, &c))
            return 0;
    } while (text_next_line(&c));
    if (!sum_normals(&o, o.smoothed ? obj_hash(1, data, size) : 0) || !make_materials(&o) || !make_meshes(&o))
        return 0;
    tell_left_out(&o);
    b->out->facts.format = "OBJ";
    b->out->facts.vertices = o.n.v;
    b->out->facts.materials = o.names.count - 1; /* without the first, for faces before any name */
    return 1;
}
