/* io_ply.c: reads PLY: a header that describes elements, then their values as text or in either byte order.
 *
 * Two passes over the values: the first only finds where elements begin and how many corners faces have, and so proves
 * that the file is as long as its header says before anything is allocated; the second fills. A corner, one byte or
 * more, costs 12 bytes in the model and 48 more in the file's widest face; a vertex, three bytes or more, at most 32:
 * within MODEL_BYTES_PER_BYTE. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../common/io_text.h"
#include "ear_clip.h"
#include "io_ply.h"

enum { MAX_ELEMENTS = 32, MAX_PROPERTIES = 512, MAX_WORDS = 5 };

typedef struct scalar_type {
    const char *name, *alias;
    double min, max; /* of whole numbers; both 0: a float */
    uint32_t size;
} scalar_type;

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

/* What a property is to us; the numbers index an item's values. */
enum { X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, ALPHA, U, V, INDICES, ROLES, NO_ROLE = ROLES };

static const struct {
    const char *name;
    int role;
} vertex_roles[] = {
    {"x", X},       {"y", Y},       {"z", Z},         {"nx", NX},         {"ny", NY}, {"nz", NZ},
    {"red", RED},   {"green", GREEN}, {"blue", BLUE}, {"alpha", ALPHA},   {"s", U},   {"t", V},
    {"u", U},       {"v", V},       {"texture_u", U}, {"texture_v", V},
};

enum { VERTEX, FACE, OTHER };

typedef struct property {
    slice name;
    const scalar_type *type;
    const scalar_type *count_type; /* of a list; NULL: a single value */
    int role;
} property;

typedef struct element {
    int kind;
    uint32_t count;
    uint32_t first, properties; /* in ply.properties */
    uint32_t bytes;             /* least that an item takes in the file */
    int has_lists;
    const property *roles[ROLES];
    const uint8_t *at; /* its first item, and that one's line */
    uint32_t line;
} element;

/* The mesh's arrays while they are written. */
typedef struct streams {
    float *positions, *uvs;
    int16_t *normals;
    uint8_t *colours;
    uint16_t *indices16; /* one of the two, or NULL */
    uint32_t *indices32;
} streams;

typedef enum encoding { NO_FORMAT, TEXT, LITTLE_ENDIAN_BYTES, BIG_ENDIAN_BYTES } encoding;

typedef struct ply {
    model_build *b;
    const uint8_t *begin, *at, *end;
    uint32_t line; /* from 1; of the header and of text */
    int in_bytes;  /* behind the header of a binary file: places are bytes */
    encoding format;
    element elements[MAX_ELEMENTS];
    property properties[MAX_PROPERTIES];
    uint32_t element_count, property_count;
    element *vertex, *face;
    uint64_t triangles; /* counted by the first pass */
    uint32_t widest;    /* most corners of a face */
    uint32_t corners;   /* of the face read last */
    uint32_t *corner;   /* those corners' vertices; NULL in the first pass */
    double *points;     /* scratch for one face: its corners' places, triangles and links */
    uint32_t *cut, *links;
    uint64_t cut_steps; /* polygon_cut_within's, left for all faces */
    streams s;
    uint32_t degenerate, overlapping, zero_normals, unused, unknown_lines;
} ply;

static int fail(const ply *p, const char *format, ...) REPORT_PRINTF(2, 3);
static int fail(const ply *p, const char *format, ...)
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

/* For %.*s: names and numbers of a damaged file can be long. */
static int shown(slice s) { return s.size < 40 ? (int)s.size : 40; }

/* --- header --- */

static int is_blank(uint8_t c) { return c == ' ' || c == '\t' || c == '\r'; }

/* The next word of this line; 0 at its end. */
static int next_word(slice *out, ply *p)
{
    while (p->at < p->end && is_blank(*p->at))
        ++p->at;
    out->at = (const char *)p->at;
    while (p->at < p->end && *p->at != '\n' && !is_blank(*p->at))
        ++p->at;
    out->size = (size_t)((const char *)p->at - out->at);
    return out->size > 0;
}

static int next_line(ply *p)
{
    const uint8_t *stop = p->at < p->end ? (const uint8_t *)memchr(p->at, '\n', (size_t)(p->end - p->at)) : NULL;
    if (!stop)
        return fail(p, "the file ends in its header; get the whole file");
    p->at = stop + 1;
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
        return fail(p, "a second format; keep one");
    if (n == 3 && slice_is(words[1], "ascii"))
        p->format = TEXT;
    else if (n == 3 && slice_is(words[1], "binary_little_endian"))
        p->format = LITTLE_ENDIAN_BYTES;
    else if (n == 3 && slice_is(words[1], "binary_big_endian"))
        p->format = BIG_ENDIAN_BYTES;
    if (p->format == NO_FORMAT || !slice_is(words[2], "1.0"))
        return fail(p, "not a format of PLY 1.0: ascii, binary_little_endian or binary_big_endian");
    return 1;
}

static int read_element(ply *p, const slice *words, int n)
{
    element *e = &p->elements[p->element_count];
    int64_t count = -1;
    if (n != 3 || !slice_integer(&count, words[2]) || count < 0 || count > (int64_t)UINT32_MAX)
        return fail(p, "not an element's name and count (up to %u)", (unsigned)UINT32_MAX);
    if (p->element_count == MAX_ELEMENTS)
        return fail(p, "more than %d elements; leave some out", (int)MAX_ELEMENTS);
    e->count = (uint32_t)count;
    e->first = p->property_count;
    e->kind = slice_is(words[1], "vertex") ? VERTEX : slice_is(words[1], "face") ? FACE : OTHER;
    if ((e->kind == VERTEX && p->vertex) || (e->kind == FACE && p->face))
        return fail(p, "a second element %.*s; join them", shown(words[1]), words[1].at);
    if (e->kind == VERTEX)
        p->vertex = e;
    if (e->kind == FACE)
        p->face = e;
    ++p->element_count;
    return 1;
}

static int role_of(const element *e, slice name)
{
    size_t i;
    if (e->kind == FACE && (slice_is(name, "vertex_indices") || slice_is(name, "vertex_index")))
        return INDICES;
    for (i = 0; e->kind == VERTEX && i < sizeof vertex_roles / sizeof vertex_roles[0]; ++i)
        if (slice_is(name, vertex_roles[i].name))
            return vertex_roles[i].role;
    return NO_ROLE;
}

/* Of several pairs of texture coordinates the first counts; anything else given twice leaves no telling which. */
static int take_role(ply *p, element *e, property *out)
{
    const int role = role_of(e, out->name), is_list = out->count_type != NULL;
    uint32_t i;
    for (i = e->first; i < p->property_count; ++i)
        if (p->properties[i].name.size == out->name.size &&
            memcmp(p->properties[i].name.at, out->name.at, out->name.size) == 0)
            return fail(p, "a second property %.*s in one element", shown(out->name), out->name.at);
    out->role = NO_ROLE;
    if (role == NO_ROLE)
        return 1;
    if (is_list != (role == INDICES))
        return fail(p, "%.*s must %sbe a list", shown(out->name), out->name.at, is_list ? "not " : "");
    if (e->roles[role] && role == INDICES)
        return fail(p, "both vertex_indices and vertex_index; keep one");
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
        return fail(p, "a property before any element");
    if (p->property_count == MAX_PROPERTIES)
        return fail(p, "more than %d properties; leave some out", (int)MAX_PROPERTIES);
    if (n != (is_list ? 5 : 3))
        return fail(p, "not a property's type and name");
    e = &p->elements[p->element_count - 1];
    out->name = words[n - 1];
    out->type = find_type(words[n - 2]);
    out->count_type = is_list ? find_type(words[2]) : NULL;
    if (!out->type || (is_list && !out->count_type))
        return fail(p, "property %.*s is of no type of PLY 1.0", shown(out->name), out->name.at);
    if (!take_role(p, e, out))
        return 0;
    e->has_lists = e->has_lists || is_list;
    ++p->property_count;
    ++e->properties;
    return 1;
}

/* Lines of the header, or of text between items, that are for people. */
static int is_remark(slice word) { return slice_is(word, "comment") || slice_is(word, "obj_info"); }

/* A line behind the first one; *done at end_header. Other readers pass over what they do not know, as a comment's second
 * line without its keyword: so does this one, and says so. */
static int read_header_line(ply *p, int *done)
{
    slice words[MAX_WORDS], extra;
    int n = 0;
    while (n < MAX_WORDS && next_word(&words[n], p))
        ++n;
    if (n == 0 || is_remark(words[0]))
        return 1;
    const int kind = slice_is(words[0], "format")       ? 1
                     : slice_is(words[0], "element")    ? 2
                     : slice_is(words[0], "property")   ? 3
                     : slice_is(words[0], "end_header") ? 4
                                                        : 0;
    if (kind > 0 && (next_word(&extra, p) || (kind == 4 && n > 1)))
        return fail(p, "more words than a line of the header has");
    p->unknown_lines += kind == 0;
    *done = kind == 4;
    return kind == 1 ? read_format(p, words, n)
         : kind == 2 ? read_element(p, words, n)
         : kind == 3 ? read_property(p, words, n)
                     : 1;
}

/* The bytes that an item takes at least, now that the format is known, wherever it stood. */
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

static int read_header(ply *p)
{
    int done = 0, k;
    if (!ply_begins(p->begin, (size_t)(p->end - p->begin)))
        return fail(p, "not a PLY file: its first line is not \"ply\"");
    while (!done) {
        if (!next_line(p) || !read_header_line(p, &done))
            return 0;
    }
    if (p->format == NO_FORMAT)
        return fail(p, "no line before it says the format");
    if (!next_line(p))
        return 0;
    count_bytes(p);
    p->in_bytes = p->format != TEXT;
    if (!p->vertex || !p->face || p->vertex->count == 0 || p->face->count == 0)
        return report_fail(p->b->r, "%s: no faces; points and lines are not drawn, give a polygon model", p->b->path);
    for (k = X; k <= Z; ++k)
        if (!p->vertex->roles[k])
            return report_fail(p->b->r, "%s: its vertices have no property %s", p->b->path, vertex_roles[k].name);
    return p->face->roles[INDICES] != NULL ||
           report_fail(p->b->r, "%s: its faces have no list vertex_indices", p->b->path);
}

/* --- values --- */

static int is_float(const scalar_type *t) { return t->max <= 0; }

static int is_whole_within(double v, double min, double max) { return v >= min && v <= max && v == floor(v); }

static int take_bytes(ply *p, uint64_t n)
{
    if ((uint64_t)(p->end - p->at) < n)
        return fail(p, "the file ends in the middle of its elements; get the whole file");
    p->at += (size_t)n;
    return 1;
}

static double bytes_value(const uint8_t *from, const scalar_type *t, int big_endian)
{
    uint64_t bits = 0;
    uint32_t i;
    for (i = 0; i < t->size; ++i)
        bits = bits << 8 | from[big_endian ? i : t->size - 1 - i];
    if (is_float(t) && t->size == 4) {
        const uint32_t low = (uint32_t)bits;
        float v;
        memcpy(&v, &low, 4);
        return (double)v;
    }
    if (is_float(t)) {
        double v;
        memcpy(&v, &bits, 8);
        return v;
    }
    return (double)bits > t->max ? (double)bits - (t->max - t->min + 1) : (double)bits;
}

static int text_value(double *out, slice word, const scalar_type *t, const ply *p)
{
    if (!slice_number(out, word))
        return fail(p, "\"%.*s\" is not a number", shown(word), word.at);
    if (!is_float(t) && !is_whole_within(*out, t->min, t->max))
        return fail(p, "%.*s is not of the type %s", shown(word), word.at, t->name);
    return 1;
}

/* One value; out NULL: only step over it. A double holds every type's values exactly. */
static int take_value(ply *p, double *out, const scalar_type *t)
{
    slice word;
    if (p->format == TEXT) {
        if (!next_word(&word, p))
            return fail(p, "fewer values than the header promises");
        return !out || text_value(out, word, t, p);
    }
    if (!take_bytes(p, t->size))
        return 0;
    if (out)
        *out = bytes_value(p->at - t->size, t, p->format == BIG_ENDIAN_BYTES);
    return 1;
}

/* How many values the list has: not more than there are bytes left, each taking one at least. */
static int take_count(ply *p, uint32_t *out, const property *list)
{
    const double left = (double)(p->end - p->at);
    double count;
    if (!take_value(p, &count, list->count_type))
        return 0;
    if (!is_whole_within(count, 0, 4294967295.0))
        return fail(p, "a list of %.9g values", count);
    if (count * (p->format == TEXT ? 1 : (double)list->type->size) > left)
        return fail(p, "a list of %.0f values, which is more than the rest of the file holds", count);
    *out = (uint32_t)count;
    return 1;
}

static int take_corners(ply *p, uint32_t n, const scalar_type *t)
{
    double v;
    uint32_t i;
    for (i = 0; i < n; ++i) {
        if (!take_value(p, &v, t))
            return 0;
        if (!is_whole_within(v, 0, (double)p->vertex->count - 1))
            return fail(p, "vertex number %.12g, but there are %u from 0", v, (unsigned)p->vertex->count);
        p->corner[i] = (uint32_t)v;
    }
    return 1;
}

static int take_list(ply *p, const property *list)
{
    uint32_t n = 0, i;
    if (!take_count(p, &n, list))
        return 0;
    if (list->role == INDICES)
        p->corners = n;
    if (list->role == INDICES && p->corner)
        return take_corners(p, n, list->type);
    if (p->format != TEXT)
        return take_bytes(p, (uint64_t)n * list->type->size);
    for (i = 0; i < n; ++i)
        if (!take_value(p, NULL, list->type))
            return 0;
    return 1;
}

/* In text, an item is a line; empty ones and comments are passed over. */
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
        while (p->at < p->end && *p->at != '\n')
            ++p->at;
        p->line += p->at < p->end;
        p->at += p->at < p->end;
    }
}

static int end_line(ply *p)
{
    slice extra;
    if (p->format == TEXT && next_word(&extra, p))
        return fail(p, "\"%.*s\" is one value more than the header promises", shown(extra), extra.at);
    return 1;
}

/* One item: its values by role, and a face's corners. values NULL: only step over it. */
static int take_item(ply *p, double *values, const element *e)
{
    uint32_t i;
    skip_empty_lines(p);
    for (i = 0; i < e->properties; ++i) {
        const property *prop = &p->properties[e->first + i];
        double *out = values && prop->role != NO_ROLE ? &values[prop->role] : NULL;
        if (!(prop->count_type ? take_list(p, prop) : take_value(p, out, prop->type)))
            return 0;
    }
    return end_line(p);
}

/* --- first pass --- */

static void count_face(ply *p)
{
    p->triangles += p->corners > 2 ? p->corners - 2 : 0;
    p->widest = p->corners > p->widest ? p->corners : p->widest;
}

/* Items without properties take no bytes, so that any number of them may be claimed. */
static int walk_element(ply *p, element *e)
{
    uint32_t i;
    skip_empty_lines(p);
    e->at = p->at;
    e->line = p->line;
    /* the last value of a text need not have a separator behind it */
    if ((uint64_t)e->count * e->bytes > (uint64_t)(p->end - p->at) + (p->format == TEXT))
        return fail(p, "%u elements, which is more than the rest of the file holds; get the whole file",
                    (unsigned)e->count);
    if (p->format != TEXT && !e->has_lists)
        return take_bytes(p, (uint64_t)e->count * e->bytes);
    for (i = 0; e->properties && i < e->count; ++i) {
        if (!take_item(p, NULL, e))
            return 0;
        if (e->kind == FACE)
            count_face(p);
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
        return fail(p, "%.0f bytes behind the last element; the header describes another file",
                    (double)(p->end - p->at));
    if (p->triangles == 0)
        return report_fail(p->b->r, "%s: no face has 3 corners; points and lines are not drawn, give a polygon model",
                           p->b->path);
    return p->triangles < UINT32_MAX / 4 ||
           report_fail(p->b->r, "%s: more than a thousand million triangles; split it", p->b->path);
}

/* --- second pass --- */

static int has_roles(const ply *p, int first, int last)
{
    int k;
    for (k = first; k <= last; ++k)
        if (!p->vertex->roles[k])
            return 0;
    return 1;
}

static int allocate_vertices(ply *p)
{
    model_build *b = p->b;
    streams *s = &p->s;
    const uint32_t n = p->vertex->count;
    const int normals = has_roles(p, NX, NZ), colours = has_roles(p, RED, BLUE), uvs = has_roles(p, U, V);
    s->positions = (float *)build_keep(b, n, 3 * sizeof *s->positions);
    if (normals)
        s->normals = (int16_t *)build_keep(b, n, 2 * sizeof *s->normals);
    if (colours)
        s->colours = (uint8_t *)build_keep(b, n, 4);
    if (uvs)
        s->uvs = (float *)build_keep(b, n, 2 * sizeof *s->uvs);
    return s->positions && !s->normals == !normals && !s->colours == !colours && !s->uvs == !uvs;
}

/* Floats run from 0 to 1, whole numbers from 0 to their type's largest. */
static double share_of(double v, const property *prop) { return is_float(prop->type) ? v : v / prop->type->max; }

/* PLY's second texture coordinate counts upwards from the image's foot, lambent's downwards from its top. */
static void store_vertex(ply *p, size_t i, const double *values)
{
    const streams *s = &p->s;
    int k;
    for (k = 0; k < 3; ++k)
        s->positions[3 * i + (size_t)k] = build_float(values[X + k]);
    if (s->normals)
        lmb_octahedral_encode(s->normals + 2 * i, build_normal(values + NX, &p->zero_normals));
    for (k = 0; s->colours && k < 4; ++k) {
        const property *prop = p->vertex->roles[RED + k];
        const double share = prop ? share_of(values[RED + k], prop) : 1;
        s->colours[4 * i + (size_t)k] = k < 3 ? build_colour(p->b, share) : build_share(share);
    }
    if (s->uvs) {
        s->uvs[2 * i] = build_uv(values[U]);
        s->uvs[2 * i + 1] = build_uv(1 - values[V]);
    }
}

static int read_vertices(ply *p)
{
    double values[ROLES];
    uint32_t i;
    if (!allocate_vertices(p))
        return 0;
    p->at = p->vertex->at;
    p->line = p->vertex->line;
    for (i = 0; i < p->vertex->count; ++i) {
        if (!take_item(p, values, p->vertex))
            return 0;
        store_vertex(p, i, values);
    }
    return 1;
}

static int allocate_faces(ply *p)
{
    model_build *b = p->b;
    if (p->vertex->count <= 65536)
        p->s.indices16 = (uint16_t *)build_keep(b, 3 * p->triangles, sizeof *p->s.indices16);
    else
        p->s.indices32 = (uint32_t *)build_keep(b, 3 * p->triangles, sizeof *p->s.indices32);
    p->corner = (uint32_t *)build_scratch(b, p->widest, sizeof *p->corner);
    p->points = (double *)build_scratch(b, p->widest, 3 * sizeof *p->points);
    p->cut = (uint32_t *)build_scratch(b, p->widest, 3 * sizeof *p->cut);
    p->links = (uint32_t *)build_scratch(b, p->widest, 2 * sizeof *p->links);
    return (p->s.indices16 || p->s.indices32) && p->corner && p->points && p->cut && p->links;
}

static uint32_t get_index(const ply *p, size_t at)
{
    return p->s.indices16 ? p->s.indices16[at] : p->s.indices32[at];
}

static void set_index(ply *p, size_t at, uint32_t vertex)
{
    if (p->s.indices16)
        p->s.indices16[at] = (uint16_t)vertex;
    else
        p->s.indices32[at] = vertex;
}

/* The face read last to its triangles, from the mesh's index `at`. Returns the index behind. */
static size_t cut_face(ply *p, size_t at)
{
    const uint32_t n = p->corners;
    uint32_t i;
    for (i = 0; i < 3 * n; ++i)
        p->points[i] = (double)p->s.positions[3 * (size_t)p->corner[i / 3] + i % 3];
    p->overlapping += !polygon_cut_within(p->cut, p->points, n, p->links, &p->cut_steps);
    for (i = 0; i < 3 * (n - 2); ++i)
        set_index(p, at++, p->corner[p->cut[i]]);
    return at;
}

static int read_faces(ply *p)
{
    size_t at = 0;
    uint32_t i;
    if (!allocate_faces(p))
        return 0;
    p->at = p->face->at;
    p->line = p->face->line;
    for (i = 0; i < p->face->count; ++i) {
        if (!take_item(p, NULL, p->face))
            return 0;
        if (p->corners < 3)
            ++p->degenerate;
        else
            at = cut_face(p, at);
    }
    return 1;
}

static void move_vertex(const streams *s, size_t to, size_t from)
{
    memmove(s->positions + 3 * to, s->positions + 3 * from, 3 * sizeof *s->positions);
    if (s->normals)
        memmove(s->normals + 2 * to, s->normals + 2 * from, 2 * sizeof *s->normals);
    if (s->colours)
        memmove(s->colours + 4 * to, s->colours + 4 * from, 4);
    if (s->uvs)
        memmove(s->uvs + 2 * to, s->uvs + 2 * from, 2 * sizeof *s->uvs);
}

/* Scans leave stray points far outside; kept, they would widen the scene's bounds. The others move up in order. */
static int drop_unused(lmb_mesh *out, ply *p)
{
    const size_t indices = 3 * (size_t)p->triangles;
    uint32_t *number = (uint32_t *)build_scratch(p->b, p->vertex->count, sizeof *number), i, used = 0;
    size_t at;
    if (!number)
        return 0;
    for (at = 0; at < indices; ++at)
        number[get_index(p, at)] = 1;
    for (i = 0; i < p->vertex->count; ++i)
        if (number[i]) {
            move_vertex(&p->s, used, i);
            number[i] = used++;
        }
    for (at = 0; at < indices; ++at)
        set_index(p, at, number[get_index(p, at)]);
    p->unused = p->vertex->count - used;
    out->vertex_count = used;
    return 1;
}

static int fill_mesh(lmb_mesh *out, ply *p)
{
    const streams *s = &p->s;
    if (!read_vertices(p) || !read_faces(p) || !drop_unused(out, p))
        return 0;
    out->positions = s->positions;
    out->normals = s->normals;
    out->colours = s->colours;
    out->uvs = s->uvs;
    out->indices = s->indices16 ? (const void *)s->indices16 : (const void *)s->indices32;
    out->triangle_count = (uint32_t)p->triangles;
    out->position_format = LMB_POSITION_F32;
    out->uv_format = LMB_UV_F32;
    out->index_format = s->indices16 ? LMB_INDEX_U16 : LMB_INDEX_U32;
    return 1;
}

/* --- the model --- */

/* A middle grey, white under colours of vertices; double sided, because PLY says nothing of materials. */
static int make_scene(ply *p)
{
    model_build *b = p->b;
    int k;
    b->meshes = (lmb_mesh *)build_keep(b, 1, sizeof *b->meshes);
    b->instances = (lmb_instance *)build_keep(b, 1, sizeof *b->instances);
    if (!build_materials(b, 1) || !b->meshes || !b->instances)
        return 0;
    for (k = 0; k < 3; ++k)
        b->materials->albedo[k] = has_roles(p, RED, BLUE) ? 1.0f : 0.8f;
    b->materials->alpha = 1.0f;
    b->materials->alpha_cutoff = 0.5f;
    b->materials->texture = -1;
    b->materials->flags = LMB_DOUBLE_SIDED;
    for (k = 0; k < 16; k += 5)
        b->instances->to_world.m[k] = 1.0f;
    b->mesh_count = b->material_count = b->instance_count = 1;
    return fill_mesh(b->meshes, p);
}

static void tell_left_out(const ply *p)
{
    uint32_t i, others = 0;
    for (i = 0; i < p->element_count; ++i)
        others += p->elements[i].kind == OTHER && p->elements[i].count > 0;
    build_note_count(p->b, "lines of the header that mean nothing here passed over", p->unknown_lines);
    build_note_count(p->b, "kinds of elements other than vertex and face skipped", others);
    build_note_count(p->b, "faces with fewer than 3 corners skipped", p->degenerate);
    build_note_count(p->b, "concave faces too large or too tangled to cut well, which may overlap themselves",
                     p->overlapping);
    build_note_count(p->b, "vertices that no face uses left out", p->unused);
    build_note_count(p->b, "normals without length, set to +Y", p->zero_normals);
}

int ply_begins(const uint8_t *data, size_t size)
{
    size_t at = 3;
    if (size < 4 || memcmp(data, "ply", 3) != 0)
        return 0;
    while (at < size && is_blank(data[at]))
        ++at;
    return at < size && data[at] == '\n';
}

int ply_load(model_build *b, const uint8_t *data, size_t size)
{
    ply p;
    memset(&p, 0, sizeof p);
    p.b = b;
    p.begin = p.at = data;
    p.end = size ? data + size : data;
    p.line = 1;
    p.cut_steps = polygon_steps(size);
    if (!read_header(&p) || !traversal(&p) || !make_scene(&p))
        return 0;
    b->out->facts.format = "PLY";
    b->out->facts.vertices = p.vertex->count;
    tell_left_out(&p);
    return 1;
}
