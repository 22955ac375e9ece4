/* io_ply_read.c: reads PLY: a header that describes elements, then their values as text or in either byte order.
 *
 * There are two passes over the values. The first finds the start of each element and counts the corners of faces. So
 * it checks that the file is as long as the header claims before anything is allocated. The second pass fills the
 * scene. A corner takes at least one byte in the file and costs 13 bytes in the model, and 52 more in the widest face
 * of the file. A vertex takes at least three bytes and costs at most 32. If a face has colours or texture coordinates,
 * each corner takes several bytes and costs 48 more. All of these are within MODEL_BYTES_PER_BYTE. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "io_ply_read.h"

static const scalar_type types[] = {
    {"char", "int8", -128, 127, 1},
    {"uchar", "uint8", 0, 255, 1},
    {"short", "int16", -32768, 32767, 2},
    {"ushort", "uint16", 0, 65535, 2},
    {"int", "int32", -2147483648.0, 2147483647.0, 4},
    {"uint", "uint32", 0, 4294967295.0, 4},
    {"float", "float32", 0, 0, 4},
    {"double", "float64", 0, 0, 8},
};
enum { TYPE_COUNT = sizeof types / sizeof types[0] };

static const struct {
    const char *name;
    int role, of; /* kinds of elements */
} known_roles[] = {
    {"x", X, VERTEX},
    {"y", Y, VERTEX},
    {"z", Z, VERTEX},
    {"nx", NX, VERTEX},
    {"ny", NY, VERTEX},
    {"nz", NZ, VERTEX},
    {"red", RED, VERTEX | FACE},
    {"green", GREEN, VERTEX | FACE},
    {"blue", BLUE, VERTEX | FACE},
    {"alpha", ALPHA, VERTEX | FACE},
    {"diffuse_red", RED, VERTEX | FACE},
    {"diffuse_green", GREEN, VERTEX | FACE},
    {"diffuse_blue", BLUE, VERTEX | FACE},
    {"diffuse_alpha", ALPHA, VERTEX | FACE},
    {"r", RED, VERTEX | FACE},
    {"g", GREEN, VERTEX | FACE},
    {"b", BLUE, VERTEX | FACE},
    {"s", U, VERTEX},
    {"t", V, VERTEX},
    {"u", U, VERTEX},
    {"v", V, VERTEX},
    {"texture_u", U, VERTEX},
    {"texture_v", V, VERTEX},
    {"texture_s", U, VERTEX},
    {"texture_t", V, VERTEX},
    {"texnumber", PICTURE, FACE},
    {"texcoord", TEXCOORDS, FACE},
    {"vertex_indices", INDICES, FACE | STRIP},
    {"vertex_index", INDICES, FACE | STRIP},
};

int ply_fail(const ply *p, const char *format, ...)
{
    char message[320];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (p->in_bytes)
        return report_fail(p->b->r, "%s: byte %.0f: %s", p->b->path, (double)(p->at - p->begin), message);
    return report_fail(p->b->r, "%s: line %u: %s", p->b->path, (unsigned)p->line, message);
}

/* Limits the length for %.*s, because names and numbers of a damaged file can be long. */
static int shown(slice s) { return s.size < 40 ? (int)s.size : 40; }

/* --- header --- */

/* CR is a blank before LF, and ends lines if the header has no LF. */
static int is_blank(uint8_t c) { return c == ' ' || c == '\t' || c == '\r'; }
static int ends_line(const ply *p, uint8_t c) { return c == '\n' || (p->has_cr_lines && c == '\r'); }

/* Reads the next word of this line. Returns 0 at the end of the line. */
static int next_word(slice *out, ply *p)
{
    while (p->at < p->end && is_blank(*p->at) && !ends_line(p, *p->at))
        ++p->at;
    out->at = (const char *)p->at;
    while (p->at < p->end && !ends_line(p, *p->at) && !is_blank(*p->at))
        ++p->at;
    out->size = (size_t)((const char *)p->at - out->at);
    return out->size > 0;
}

static int next_line(ply *p)
{
    while (p->at < p->end && !ends_line(p, *p->at))
        ++p->at;
    if (p->at == p->end)
        return ply_fail(p, "the file ends in its header; get the whole file");
    ++p->at;
    ++p->line;
    return 1;
}

static const scalar_type *find_type(slice name)
{
    int i;
    for (i = 0; i < TYPE_COUNT; ++i)
        if (slice_is(name, types[i].name) || slice_is(name, types[i].alias))
            return &types[i];
    return NULL;
}

static int read_format(ply *p, const slice *words, int n)
{
    if (p->format != NO_FORMAT)
        return ply_fail(p, "a second format; keep one");
    if (n == 3 && slice_is(words[1], "ascii"))
        p->format = TEXT;
    else if (n == 3 && slice_is(words[1], "binary_little_endian"))
        p->format = LITTLE_ENDIAN_BYTES;
    else if (n == 3 && slice_is(words[1], "binary_big_endian"))
        p->format = BIG_ENDIAN_BYTES;
    if (p->format == NO_FORMAT || !slice_is(words[2], "1.0"))
        return ply_fail(p, "not a format of PLY 1.0: ascii, binary_little_endian or binary_big_endian");
    return 1;
}

static int read_element(ply *p, const slice *words, int n)
{
    element *e = &p->elements[p->element_count];
    int64_t count = -1;
    if (n != 3 || !slice_integer(&count, words[2]) || count < 0 || count > (int64_t)UINT32_MAX)
        return ply_fail(p, "not an element's name and count (up to %u)", (unsigned)UINT32_MAX);
    if (p->element_count == MAX_ELEMENTS)
        return ply_fail(p, "more than %d elements; leave some out", (int)MAX_ELEMENTS);
    e->count = (uint32_t)count;
    e->first = p->property_count;
    e->kind = slice_is(words[1], "vertex")      ? VERTEX
              : slice_is(words[1], "face")      ? FACE
              : slice_is(words[1], "tristrips") ? STRIP
                                                : OTHER;
    if ((e->kind == VERTEX && p->vertex) || (e->kind == FACE && p->face) || (e->kind == STRIP && p->strip))
        return ply_fail(p, "a second element %.*s; join them", shown(words[1]), words[1].at);
    if (e->kind == VERTEX)
        p->vertex = e;
    if (e->kind == FACE)
        p->face = e;
    if (e->kind == STRIP)
        p->strip = e;
    ++p->element_count;
    return 1;
}

static int role_of(const element *e, slice name)
{
    size_t i;
    for (i = 0; i < sizeof known_roles / sizeof known_roles[0]; ++i)
        if ((known_roles[i].of & e->kind) != 0 && slice_is(name, known_roles[i].name))
            return known_roles[i].role;
    return NO_ROLE;
}

/* If there are several pairs of texture coordinates, or several colours, the first counts. Any other duplicate is
 * ambiguous. */
static int take_role(ply *p, element *e, property *out)
{
    const int role = role_of(e, out->name), is_list = out->count_type != NULL;
    uint32_t i;
    for (i = e->first; i < p->property_count; ++i)
        if (p->properties[i].name.size == out->name.size &&
            memcmp(p->properties[i].name.at, out->name.at, out->name.size) == 0)
            return ply_fail(p, "a second property %.*s in one element", shown(out->name), out->name.at);
    out->role = NO_ROLE;
    if (role == NO_ROLE)
        return 1;
    if (is_list != (role >= INDICES) && e->kind == FACE && role != INDICES)
        return 1; /* in a face these are extras, and other programs may use them differently */
    if (is_list != (role >= INDICES))
        return ply_fail(p, "%.*s must %sbe a list", shown(out->name), out->name.at, is_list ? "not " : "");
    if (e->roles[role] && role == INDICES)
        return ply_fail(p, "both vertex_indices and vertex_index; keep one");
    if (!e->roles[role]) {
        e->roles[role] = out;
        out->role = role;
    }
    return 1;
}

/* property TYPE NAME, or property list COUNT-TYPE TYPE NAME. */
static int read_property(ply *p, const slice *words, int n)
{
    const int is_list = n > 1 && slice_is(words[1], "list");
    property *out = &p->properties[p->property_count];
    element *e;
    if (p->element_count == 0)
        return ply_fail(p, "a property before any element");
    if (p->property_count == MAX_PROPERTIES)
        return ply_fail(p, "more than %d properties; leave some out", (int)MAX_PROPERTIES);
    if (n != (is_list ? 5 : 3))
        return ply_fail(p, "not a property's type and name");
    e = &p->elements[p->element_count - 1];
    out->name = words[n - 1];
    out->type = find_type(words[n - 2]);
    out->count_type = is_list ? find_type(words[2]) : NULL;
    if (!out->type || (is_list && !out->count_type))
        return ply_fail(p, "property %.*s is of no type of PLY 1.0", shown(out->name), out->name.at);
    if (!take_role(p, e, out))
        return 0;
    e->has_lists = e->has_lists || is_list;
    ++p->property_count;
    ++e->properties;
    return 1;
}

/* Comment lines in the header, or between items in text files. */
static int is_remark(slice word) { return slice_is(word, "comment") || slice_is(word, "obj_info"); }

/* Reads a line "comment TextureFile NAME". There may be several; texnumber is an index into them. */
static void take_picture(ply *p, const slice *words)
{
    slice name = {words[2].at, 0};
    while ((const uint8_t *)name.at + name.size < p->end && !ends_line(p, (uint8_t)name.at[name.size]))
        ++name.size;
    while (name.size > 0 && is_blank((uint8_t)name.at[name.size - 1]))
        --name.size;
    if (p->pictures < MAX_PICTURES)
        p->picture[p->pictures++] = name;
    else
        ++p->more_pictures;
}

/* Reads a header line after the first; sets *done at end_header. Like other readers, it skips unknown lines, for
 * example the second line of a comment without the keyword, and adds a note. */
static int read_header_line(ply *p, int *done)
{
    slice words[MAX_WORDS], extra;
    int n = 0;
    while (n < MAX_WORDS && next_word(&words[n], p))
        ++n;
    if (n > 2 && slice_is(words[0], "comment") && slice_is_like(words[1], "TextureFile"))
        take_picture(p, words);
    if (n == 0 || is_remark(words[0]))
        return 1;
    const int kind = slice_is(words[0], "format")       ? 1
                     : slice_is(words[0], "element")    ? 2
                     : slice_is(words[0], "property")   ? 3
                     : slice_is(words[0], "end_header") ? 4
                                                        : 0;
    if (kind > 0 && (next_word(&extra, p) || (kind == 4 && n > 1)))
        return ply_fail(p, "more words than a line of the header has");
    p->unknown_lines += kind == 0;
    *done = kind == 4;
    return kind == 1 ? read_format(p, words, n)
         : kind == 2 ? read_element(p, words, n)
         : kind == 3 ? read_property(p, words, n)
                     : 1;
}

/* Computes the minimum number of bytes of an item. It runs after the header because the format line may be anywhere. */
static void count_bytes(ply *p)
{
    uint32_t i, k;
    for (i = 0; i < p->element_count; ++i) {
        element *e = &p->elements[i];
        for (k = 0; k < e->properties; ++k) {
            const property *prop = &p->properties[e->first + k];
            e->bytes += p->format == TEXT ? 2 : (prop->count_type ? prop->count_type : prop->type)->size;
        }
    }
}

static int check_elements(ply *p)
{
    int k;
    p->face = p->face && p->face->count > 0 ? p->face : NULL;
    p->strip = p->strip && p->strip->count > 0 ? p->strip : NULL;
    if (!p->vertex || (!p->face && !p->strip) || p->vertex->count == 0)
        return report_fail(p->b->r, "%s: no faces; points and lines are not drawn, give a polygon model", p->b->path);
    for (k = X; k <= Z; ++k)
        if (!p->vertex->roles[k])
            return report_fail(p->b->r, "%s: its vertices have no property %s", p->b->path, known_roles[k].name);
    if (p->strip && !p->strip->roles[INDICES])
        return report_fail(p->b->r, "%s: its strips have no list vertex_indices", p->b->path);
    return !p->face || p->face->roles[INDICES] != NULL ||
           report_fail(p->b->r, "%s: its faces have no list vertex_indices", p->b->path);
}

static int read_header(ply *p)
{
    int done = 0;
    if (!ply_begins(p->begin, (size_t)(p->end - p->begin)))
        return ply_fail(p, "not a PLY file: its first line is not \"ply\"");
    while (!done) {
        if (!next_line(p) || !read_header_line(p, &done))
            return 0;
    }
    if (p->format == NO_FORMAT)
        return ply_fail(p, "no line before it says the format");
    if (!next_line(p))
        return 0;
    count_bytes(p);
    p->in_bytes = p->format != TEXT;
    return check_elements(p);
}

/* --- values --- */

static int is_whole_within(double v, double min, double max) { return v >= min && v <= max && v == floor(v); }

static int take_bytes(ply *p, uint64_t n)
{
    if ((uint64_t)(p->end - p->at) < n)
        return ply_fail(p, "the file ends in the middle of its elements; get the whole file");
    p->at += (size_t)n;
    return 1;
}

static double bytes_value(const uint8_t *from, const scalar_type *t, int big_endian)
{
    uint64_t bits = 0;
    uint32_t i;
    for (i = 0; i < t->size; ++i)
        bits = bits << 8 | from[big_endian ? i : t->size - 1 - i];
    if (ply_is_float(t) && t->size == 4) {
        const uint32_t low = (uint32_t)bits;
        float v;
        memcpy(&v, &low, 4);
        return (double)v;
    }
    if (ply_is_float(t)) {
        double v;
        memcpy(&v, &bits, 8);
        return v;
    }
    return (double)bits > t->max ? (double)bits - (t->max - t->min + 1) : (double)bits;
}

static int text_value(double *out, slice word, const scalar_type *t, const ply *p)
{
    if (!slice_number(out, word))
        return ply_fail(p, "\"%.*s\" is not a number", shown(word), word.at);
    if (!ply_is_float(t) && !is_whole_within(*out, t->min, t->max))
        return ply_fail(p, "%.*s is not of the type %s", shown(word), word.at, t->name);
    return 1;
}

/* Reads one value; out NULL: skips it. A double holds the values of every type exactly. */
static int take_value(ply *p, double *out, const scalar_type *t)
{
    slice word;
    if (p->format == TEXT) {
        if (!next_word(&word, p))
            return ply_fail(p, "fewer values than the header promises");
        return !out || text_value(out, word, t, p);
    }
    if (!take_bytes(p, t->size))
        return 0;
    if (out)
        *out = bytes_value(p->at - t->size, t, p->format == BIG_ENDIAN_BYTES);
    return 1;
}

/* Reads the length of a list. It cannot exceed the bytes left, because each value takes at least one byte. */
static int take_count(ply *p, uint32_t *out, const property *list)
{
    const double left = (double)(p->end - p->at);
    double count;
    if (!take_value(p, &count, list->count_type))
        return 0;
    if (!is_whole_within(count, 0, 4294967295.0))
        return ply_fail(p, "a list of %.9g values", count);
    if (count * (p->format == TEXT ? 1 : (double)list->type->size) > left)
        return ply_fail(p, "a list of %.0f values, which is more than the rest of the file holds", count);
    *out = (uint32_t)count;
    return 1;
}

/* Returns 1 for -1, or for -1 converted to an unsigned type. */
static int is_restart(const ply *p, double v, const scalar_type *t)
{
    return v == -1 || (t->min == 0 && t->max > 0 && v == t->max && v >= (double)p->vertex->count);
}

static int take_corners(ply *p, uint32_t n, const scalar_type *t, int kind)
{
    double v;
    uint32_t i;
    for (i = 0; i < n; ++i) {
        if (!take_value(p, &v, t))
            return 0;
        p->corner[i] = RESTART;
        if (kind == STRIP && is_restart(p, v, t))
            continue;
        if (!is_whole_within(v, 0, (double)p->vertex->count - 1))
            return ply_fail(p, "vertex number %.12g, but there are %u from 0", v, (unsigned)p->vertex->count);
        p->corner[i] = (uint32_t)v;
    }
    return 1;
}

static int take_coords(ply *p, uint32_t n, const scalar_type *t)
{
    double v;
    uint32_t i;
    for (i = 0; i < n; ++i) {
        if (!take_value(p, &v, t))
            return 0;
        p->coord[i] = build_uv(i % 2 ? 1 - v : v);
    }
    return 1;
}

static int take_list(ply *p, const property *list, int kind)
{
    uint32_t n = 0, i;
    if (!take_count(p, &n, list))
        return 0;
    if (list->role == INDICES)
        p->corners = n;
    if (list->role == TEXCOORDS)
        p->coords = n;
    if (list->role == INDICES && p->corner)
        return take_corners(p, n, list->type, kind);
    if (list->role == TEXCOORDS && p->coord)
        return take_coords(p, n, list->type);
    if (p->format != TEXT)
        return take_bytes(p, (uint64_t)n * list->type->size);
    for (i = 0; i < n; ++i)
        if (!take_value(p, NULL, list->type))
            return 0;
    return 1;
}

/* In text files each item is one line. Empty lines and comments are skipped. */
static void skip_empty_lines(ply *p)
{
    while (p->format == TEXT && p->at < p->end) {
        const uint8_t *begin = p->at;
        slice word;
        if (!is_blank(*begin) && *begin != '\n' && *begin != 'c' && *begin != 'o')
            return;
        if (next_word(&word, p) && !is_remark(word)) {
            p->at = begin;
            return;
        }
        while (p->at < p->end && !ends_line(p, *p->at))
            ++p->at;
        p->line += p->at < p->end;
        p->at += p->at < p->end;
    }
}

static int end_line(ply *p)
{
    slice extra;
    if (p->format == TEXT && next_word(&extra, p))
        return ply_fail(p, "\"%.*s\" is one value more than the header promises", shown(extra), extra.at);
    return 1;
}

void ply_begin(ply *p, const element *e)
{
    p->at = e->at;
    p->line = e->line;
}

int ply_take(ply *p, double *values, const element *e)
{
    uint32_t i;
    skip_empty_lines(p);
    p->corners = p->coords = 0;
    for (i = 0; i < e->properties; ++i) {
        const property *prop = &p->properties[e->first + i];
        double *out = values && prop->role != NO_ROLE ? &values[prop->role] : NULL;
        if (!(prop->count_type ? take_list(p, prop, e->kind) : take_value(p, out, prop->type)))
            return 0;
    }
    return end_line(p);
}

/* --- first pass --- */

static uint32_t larger(uint32_t a, uint32_t b) { return a > b ? a : b; }

static void count_item(ply *p, int kind)
{
    p->triangles += p->corners > 2 ? p->corners - 2 : 0;
    p->all_corners += (kind == STRIP ? 3 : 1) * (uint64_t)p->corners;
    if (kind == FACE)
        p->widest = larger(p->widest, p->corners);
    else
        p->longest_strip = larger(p->longest_strip, p->corners);
    p->longest_coords = larger(p->longest_coords, p->coords);
}

/* Items without properties take no bytes, so a header may claim any number of them. */
static int walk_element(ply *p, element *e)
{
    uint32_t i;
    skip_empty_lines(p);
    e->at = p->at;
    e->line = p->line;
    /* the last value of a text file needs no separator after it */
    if ((uint64_t)e->count * e->bytes > (uint64_t)(p->end - p->at) + (p->format == TEXT))
        return ply_fail(p, "%u elements, which is more than the rest of the file holds; get the whole file",
                    (unsigned)e->count);
    if (p->format != TEXT && !e->has_lists)
        return take_bytes(p, (uint64_t)e->count * e->bytes);
    for (i = 0; e->properties && i < e->count; ++i) {
        if (!ply_take(p, NULL, e))
            return 0;
        if (e == p->face || e == p->strip)
            count_item(p, e->kind);
    }
    return 1;
}

static int traversal(ply *p)
{
    uint32_t i;
    for (i = 0; i < p->element_count; ++i)
        if (!walk_element(p, &p->elements[i]))
            return 0;
    skip_empty_lines(p);
    if (p->at < p->end)
        return ply_fail(p, "%.0f bytes behind the last element; the header describes another file",
                    (double)(p->end - p->at));
    if (p->triangles == 0)
        return report_fail(p->b->r, "%s: no face has 3 corners; points and lines are not drawn, give a polygon model",
                           p->b->path);
    return p->all_corners < UINT32_MAX / 4 ||
           report_fail(p->b->r, "%s: more than a thousand million triangles; split it", p->b->path);
}

int ply_has(const element *e, int first, int last)
{
    int k;
    for (k = first; k <= last; ++k)
        if (!e || !e->roles[k])
            return 0;
    return 1;
}

/* Returns the first byte that is no blank after "ply", or `size`. */
static size_t after_ply(const uint8_t *data, size_t size)
{
    size_t at = 3;
    while (at < size && is_blank(data[at]))
        ++at;
    return at;
}

int ply_begins(const uint8_t *data, size_t size)
{
    const size_t at = size >= 4 && memcmp(data, "ply", 3) == 0 ? after_ply(data, size) : size;
    return at < size && (data[at] == '\n' || memchr(data + 3, '\r', at - 3) != NULL);
}

int ply_walk(ply *p)
{
    const size_t size = (size_t)(p->end - p->begin), at = size > 3 ? after_ply(p->begin, size) : size;
    p->has_cr_lines = at < size && p->begin[at] != '\n';
    return read_header(p) && traversal(p);
}
