/* io_ply_mesh.c: second pass of the PLY reader: converts vertices, faces and strips to a scene. */
#include <math.h>
#include <string.h>

#include "ear_clip.h"
#include "io_ply_read.h"

enum { NEAR_WEDGES = 64 }; /* wedges of one vertex that are compared; beyond them a wedge may be stored twice */

/* --- ranges of colours -------------------------------------------------------------------------------------------- */

typedef struct codes {
    double top;
    int is_whole;
} codes;

/* Properties of the colour values of one type in an element. */
static int survey(codes *out, ply *p, const element *e, const scalar_type *type)
{
    double values[ROLES];
    uint32_t i;
    int k;
    out->top = 0;
    out->is_whole = 1;
    ply_begin(p, e);
    for (i = 0; i < e->count; ++i) {
        if (!ply_take(p, values, e))
            return 0;
        for (k = RED; k <= ALPHA; ++k)
            if (e->roles[k] && e->roles[k]->type == type) {
                out->top = values[k] > out->top ? values[k] : out->top;
                out->is_whole = out->is_whole && values[k] == floor(values[k]);
            }
    }
    return 1;
}

/* Floats are 0 .. 1, and integers are 0 .. the maximum of their type. But some programs write 8-bit codes as any
 * type. */
static double range_of(const scalar_type *type, const codes *c)
{
    if (ply_is_float(type))
        return c->top > 1 && c->top <= 255 && (c->is_whole || c->top > 16) ? 255 : 1;
    if (type->size == 1)
        return type->max;
    return c->top <= 255 ? 255 : c->top <= 65535 && type->size > 2 ? 65535 : type->max;
}

/* Finds the colour ranges of an element. Adds a note if a range is not the usual range of the type. */
static int find_ranges(double range[4], ply *p, const element *e)
{
    codes c = {0, 1};
    int k, i;
    for (k = RED; k <= ALPHA; ++k) {
        const property *channel = e->roles[k];
        range[k - RED] = 1;
        if (!channel)
            continue;
        for (i = RED; i < k && (!e->roles[i] || e->roles[i]->type != channel->type); ++i)
            ;
        if (i < k) {
            range[k - RED] = range[i - RED];
            continue;
        }
        if (channel->type->size > 1 && !survey(&c, p, e, channel->type))
            return 0;
        range[k - RED] = range_of(channel->type, &c);
        if (channel->type->size > 1 && range[k - RED] != (ply_is_float(channel->type) ? 1 : channel->type->max))
            build_note(p->b, "colours of the type %s hold no more than codes, read as 0 to %.0f", channel->type->name,
                       range[k - RED]);
    }
    return 1;
}

/* Returns 1 if an alpha is ignored. */
static int store_colour(uint16_t to[4], const ply *p, const element *e, const double *values)
{
    const double *range = p->range[e == p->face];
    const double alpha = e->roles[ALPHA] ? values[ALPHA] / range[3] : 1;
    int k;
    for (k = 0; k < 3; ++k)
        to[k] = build_colour(p->b, values[RED + k] / range[k]);
    to[3] = build_share(alpha);
    return to[3] < 65535;
}

/* --- textures ----------------------------------------------------------------------------------------------------- */

static int load_texture(int32_t *out, model_build *b, slice name, report *why)
{
    lmb_texture *to = &b->textures[b->texture_count];
    char path[MODEL_PATH_MAX], text[512];
    file_bytes bytes = {NULL, 0};
    size_t i;
    if (name.size >= sizeof text)
        return report_fail(why, "%.40s ...: a name of %.0f bytes", name.at, (double)name.size);
    for (i = 0; i < name.size; ++i)
        text[i] = name.at[i] == '\\' ? '/' : name.at[i];
    text[i] = '\0';
    if (!build_is_relative(text))
        return report_fail(why, "%.100s: not a path from the model's folder", text);
    if (!build_sibling(path, sizeof path, b, text, why) || !build_read(b, &bytes, path, why) ||
        !build_texels(b, to, bytes.data, bytes.size, TEXELS_COLOUR, path, NULL, why))
        return 0;
    to->wrap_s = to->wrap_t = LMB_WRAP_REPEAT;
    to->filter = LMB_TRILINEAR;
    *out = (int32_t)b->texture_count++;
    return 1;
}

static int load_textures(ply *p)
{
    model_build *b = p->b;
    report why, first;
    uint32_t i, missing = 0;
    first.text[0] = '\0';
    b->textures = (lmb_texture *)build_keep(b, p->pictures, sizeof *b->textures);
    if (!b->textures)
        return 0;
    for (i = 0; i < p->pictures; ++i) {
        memset(&why, 0, sizeof why);
        p->texture_of[i] = -1;
        if (load_texture(&p->texture_of[i], b, p->picture[i], &why))
            continue;
        if (b->r->text[0])
            return 0;
        if (missing++ == 0)
            first = why;
    }
    if (missing)
        build_note(b, "textures left out, plain colour instead: %u (first: %.120s)", (unsigned)missing, first.text);
    build_note_count(b, "textures left out after the first 64", p->more_pictures);
    return 1;
}

static int has_part(const element *e)
{
    return (e->roles[RED] || e->roles[GREEN] || e->roles[BLUE]) && !ply_has(e, RED, BLUE);
}

/* Chooses between several colours and coordinates: a texture first, then face colours, then vertex colours. The texture
 * of a scan already contains the vertex colours, so using both would count them twice. */
static int choose(ply *p)
{
    const int by_vertex = ply_has(p->vertex, U, V), by_face = ply_has(p->face, TEXCOORDS, TEXCOORDS);
    const int face_colours = ply_has(p->face, RED, BLUE), vertex_colours = ply_has(p->vertex, RED, BLUE);
    if (p->pictures > 0 && !by_vertex && !by_face)
        build_note_count(p->b, "textures without texture coordinates left out", p->pictures);
    else if (p->pictures > 0 && !load_textures(p))
        return 0;
    p->is_textured = p->b->texture_count > 0;
    p->has_face_uvs = p->is_textured && by_face;
    p->has_face_colours = face_colours && !p->is_textured;
    p->has_vertex_colours = vertex_colours && !p->is_textured && !face_colours;
    if (p->is_textured && (face_colours || vertex_colours))
        build_note(p->b, "colours beside a texture left out");
    else if (face_colours && vertex_colours)
        build_note(p->b, "colours of vertices left out, as faces have their own");
    if (has_part(p->vertex) || (p->face && has_part(p->face)))
        build_note(p->b, "colours that are not red, green and blue left out");
    if (p->has_vertex_colours && !find_ranges(p->range[0], p, p->vertex))
        return 0;
    return !p->has_face_colours || find_ranges(p->range[1], p, p->face);
}

/* --- vertices ----------------------------------------------------------------------------------------------------- */

/* Allocates streams for n vertices with build_keep, or with build_scratch if wedges replace the vertices. */
static int allocate_streams(streams *s, const ply *p, uint32_t n, void *(*get)(model_build *, uint64_t, size_t),
                            int colours, int uvs)
{
    const int normals = ply_has(p->vertex, NX, NZ);
    s->positions = (float *)get(p->b, n, 3 * sizeof *s->positions);
    s->normals = normals ? (int16_t *)get(p->b, n, 2 * sizeof *s->normals) : NULL;
    s->colours = colours ? (uint16_t *)get(p->b, n, 4 * sizeof *s->colours) : NULL;
    s->uvs = uvs ? (float *)get(p->b, n, 2 * sizeof *s->uvs) : NULL;
    return s->positions && !s->normals == !normals && !s->colours == !colours && !s->uvs == !uvs;
}

/* The second texture coordinate of PLY counts upwards from the bottom of the image. In lambent it counts downwards from
 * the top. */
static void store_vertex(ply *p, size_t i, const double *values)
{
    const streams *s = &p->s;
    int k;
    for (k = 0; k < 3; ++k)
        s->positions[3 * i + (size_t)k] = build_float(values[X + k]);
    if (s->normals)
        build_normal_code(p->b, s->normals + 2 * i, values + NX);
    if (s->colours)
        p->translucent += store_colour(s->colours + 4 * i, p, p->vertex, values) != 0;
    if (s->uvs) {
        s->uvs[2 * i] = build_uv(values[U]);
        s->uvs[2 * i + 1] = build_uv(1 - values[V]);
    }
}

static int has_wedges(const ply *p) { return p->has_face_uvs || p->has_face_colours; }

static int read_vertices(ply *p)
{
    double values[ROLES];
    uint32_t i;
    if (!allocate_streams(&p->s, p, p->vertex->count, has_wedges(p) ? build_scratch : build_keep, p->has_vertex_colours,
                          ply_has(p->vertex, U, V)))
        return 0;
    ply_begin(p, p->vertex);
    for (i = 0; i < p->vertex->count; ++i) {
        if (!ply_take(p, values, p->vertex))
            return 0;
        store_vertex(p, i, values);
    }
    return 1;
}

/* --- faces and strips --------------------------------------------------------------------------------------------- */

static int allocate_wedges(ply *p)
{
    p->wedges = (wedge *)build_scratch(p->b, p->all_corners, sizeof *p->wedges);
    p->wedge_of = (uint32_t *)build_scratch(p->b, p->vertex->count, sizeof *p->wedge_of);
    return p->wedges && p->wedge_of;
}

static int allocate_faces(ply *p)
{
    model_build *b = p->b;
    const uint64_t vertices = has_wedges(p) ? p->all_corners : p->vertex->count;
    const uint32_t longest = p->widest > p->longest_strip ? p->widest : p->longest_strip;
    if (vertices <= 65536)
        p->s.indices16 = (uint16_t *)build_keep(b, 3 * p->triangles, sizeof *p->s.indices16);
    else
        p->s.indices32 = (uint32_t *)build_keep(b, 3 * p->triangles, sizeof *p->s.indices32);
    p->corner = (uint32_t *)build_scratch(b, longest, sizeof *p->corner);
    p->points = (double *)build_scratch(b, p->widest, 3 * sizeof *p->points);
    p->number = (uint32_t *)build_scratch(b, p->widest, sizeof *p->number);
    p->cut = (uint32_t *)build_scratch(b, p->widest, 3 * sizeof *p->cut);
    p->links = (uint32_t *)build_scratch(b, p->widest, 2 * sizeof *p->links);
    if (p->is_textured && !(p->paint = (uint8_t *)build_scratch(b, p->triangles, 1)))
        return 0;
    if (p->has_face_uvs && !(p->coord = (float *)build_scratch(b, p->longest_coords, sizeof *p->coord)))
        return 0;
    return (p->s.indices16 || p->s.indices32) && p->corner && p->points && p->number && p->cut && p->links &&
           (!has_wedges(p) || allocate_wedges(p));
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

/* Returns the index of the wedge with this vertex, uv and colour, and adds it if it is new. uv NULL: use the uv of the
 * vertex, else (0, 0). */
static uint32_t find_wedge(ply *p, uint32_t vertex, const float *uv, const uint16_t colour[4])
{
    wedge want = {vertex, p->wedge_of[vertex], {0, 0}, {0, 0, 0, 0}};
    uint32_t at = want.next, seen = 0;
    if (uv == NULL && p->s.uvs)
        uv = p->s.uvs + 2 * (size_t)vertex;
    if (uv != NULL)
        memcpy(want.uv, uv, sizeof want.uv);
    memcpy(want.colour, colour, sizeof want.colour);
    for (; at != 0 && seen < NEAR_WEDGES; at = p->wedges[at - 1].next, ++seen)
        if (memcmp(p->wedges[at - 1].uv, want.uv, sizeof want.uv) == 0 &&
            memcmp(p->wedges[at - 1].colour, want.colour, sizeof want.colour) == 0)
            return at - 1;
    p->wedges[p->wedge_count] = want;
    p->wedge_of[vertex] = ++p->wedge_count;
    return p->wedge_count - 1;
}

/* Returns the material of the face read last: the one with the face's texture, or the last material, which has none. */
static uint8_t paint_of(ply *p, const double *values)
{
    const double picture = p->face->roles[PICTURE] ? values[PICTURE] : 0;
    const int has_place = p->has_face_uvs ? p->coords == 2 * p->corners : p->s.uvs != NULL;
    p->odd_coords += p->has_face_uvs && p->coords != 0 && !has_place;
    if (!has_place || !(picture >= 0 && picture < p->pictures) || p->texture_of[(uint32_t)picture] < 0)
        return (uint8_t)p->b->texture_count;
    return (uint8_t)p->texture_of[(uint32_t)picture];
}

/* Converts the corners of the face to vertices of the mesh. */
static void number_corners(ply *p, const double *values)
{
    const int has_uvs = p->has_face_uvs && p->coords == 2 * p->corners;
    uint16_t colour[4] = {65535, 65535, 65535, 65535};
    uint32_t i;
    if (p->has_face_colours)
        p->translucent += store_colour(colour, p, p->face, values) != 0;
    for (i = 0; i < p->corners; ++i)
        p->number[i] = !has_wedges(p) ? p->corner[i]
                                      : find_wedge(p, p->corner[i], has_uvs ? p->coord + 2 * (size_t)i : NULL, colour);
}

/* Writes the triangles of the face read last, starting at index `at` of the mesh. Returns the next free index. */
static size_t cut_face(ply *p, size_t at, const double *values)
{
    const uint32_t n = p->corners;
    uint32_t i;
    number_corners(p, values);
    for (i = 0; i < 3 * n; ++i)
        p->points[i] = (double)p->s.positions[3 * (size_t)p->corner[i / 3] + i % 3];
    p->overlapping += !polygon_cut_within(p->cut, p->points, n, p->links, &p->cut_steps);
    if (p->paint)
        memset(p->paint + at / 3, paint_of(p, values), n - 2);
    for (i = 0; i < 3 * (n - 2); ++i)
        set_index(p, at++, p->number[p->cut[i]]);
    return at;
}

static int read_faces(ply *p, size_t *at)
{
    double values[ROLES];
    uint32_t i;
    ply_begin(p, p->face);
    for (i = 0; i < p->face->count; ++i) {
        if (!ply_take(p, values, p->face))
            return 0;
        if (p->corners < 3)
            ++p->degenerate;
        else
            *at = cut_face(p, *at, values);
    }
    return 1;
}

static size_t put_triangle(ply *p, size_t at, uint32_t a, uint32_t b, uint32_t c)
{
    const uint16_t code = build_linear(0.8), grey[4] = {code, code, code, 65535};
    const uint32_t corner[3] = {a, b, c};
    int k;
    if (p->paint)
        p->paint[at / 3] =
            (uint8_t)(p->s.uvs && p->texture_of[0] >= 0 ? (uint32_t)p->texture_of[0] : p->b->texture_count);
    for (k = 0; k < 3; ++k)
        set_index(p, at++, has_wedges(p) ? find_wedge(p, corner[k], NULL, grey) : corner[k]);
    return at;
}

/* Writes the triangles of the strip read last. Each vertex makes a triangle with the two before it, and every second
 * triangle has the opposite winding. A triangle with a repeated vertex only turns or joins strips. */
static size_t cut_strip(ply *p, size_t at)
{
    uint32_t i, run = 0;
    for (i = 0; i < p->corners; ++i) {
        const uint32_t c = p->corner[i], b = run > 0 ? p->corner[i - 1] : c, a = run > 1 ? p->corner[i - 2] : c;
        if (c == RESTART) {
            p->short_strips += run == 1 || run == 2;
            run = 0;
            continue;
        }
        if (++run < 3 || a == b || b == c || a == c)
            continue;
        at = run % 2 ? put_triangle(p, at, a, b, c) : put_triangle(p, at, b, a, c);
    }
    p->short_strips += run == 1 || run == 2;
    return at;
}

static int read_strips(ply *p, size_t *at)
{
    uint32_t i;
    ply_begin(p, p->strip);
    for (i = 0; i < p->strip->count; ++i) {
        if (!ply_take(p, NULL, p->strip))
            return 0;
        *at = cut_strip(p, *at);
    }
    return 1;
}

static int read_triangles(ply *p)
{
    size_t at = 0;
    if (!allocate_faces(p) || (p->face && !read_faces(p, &at)) || (p->strip && !read_strips(p, &at)))
        return 0;
    p->triangles = at / 3;
    return at > 0 || report_fail(p->b->r, "%s: no strip makes a triangle; give a polygon model", p->b->path);
}

/* --- the mesh ----------------------------------------------------------------------------------------------------- */

static void copy_vertex(const streams *out, size_t to, const streams *in, size_t from)
{
    memmove(out->positions + 3 * to, in->positions + 3 * from, 3 * sizeof *out->positions);
    if (in->normals)
        memmove(out->normals + 2 * to, in->normals + 2 * from, 2 * sizeof *out->normals);
    if (in->colours)
        memmove(out->colours + 4 * to, in->colours + 4 * from, 4 * sizeof *out->colours);
    if (in->uvs)
        memmove(out->uvs + 2 * to, in->uvs + 2 * from, 2 * sizeof *out->uvs);
}

/* Removes vertices that no triangle uses: scans have stray points far outside, which would widen the bounds of the
 * scene. The other vertices keep their order. */
static int drop_unused(uint32_t *count, ply *p)
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
            copy_vertex(&p->s, used, &p->s, i);
            number[i] = used++;
        }
    for (at = 0; at < indices; ++at)
        set_index(p, at, number[get_index(p, at)]);
    p->unused = p->vertex->count - used;
    *count = used;
    return 1;
}

/* Makes the wedges the vertices of the mesh. */
static int take_wedges(uint32_t *count, ply *p)
{
    streams to = p->s;
    uint32_t i;
    if (!allocate_streams(&to, p, p->wedge_count, build_keep, p->has_face_colours, p->has_face_uvs || p->s.uvs))
        return 0;
    for (i = 0; i < p->wedge_count; ++i) {
        const wedge *w = &p->wedges[i];
        copy_vertex(&to, i, &p->s, w->vertex);
        if (to.colours)
            memcpy(to.colours + 4 * (size_t)i, w->colour, sizeof w->colour);
        if (to.uvs)
            memcpy(to.uvs + 2 * (size_t)i, w->uv, sizeof w->uv);
    }
    for (i = 0; i < p->vertex->count; ++i)
        p->unused += p->wedge_of[i] == 0;
    p->s = to;
    *count = p->wedge_count;
    return 1;
}

static int fill_mesh(lmb_mesh *out, ply *p)
{
    const streams *s = &p->s;
    if (!read_vertices(p) || !read_triangles(p) ||
        !(has_wedges(p) ? take_wedges : drop_unused)(&out->vertex_count, p))
        return 0;
    out->positions = s->positions;
    out->normals = s->normals;
    out->colour_format = s->colours ? build_narrow(s->colours, out->vertex_count) : LMB_COLOUR_RGBA8;
    out->colours = (const uint8_t *)s->colours;
    out->uvs = s->uvs;
    out->indices = s->indices16 ? (const void *)s->indices16 : (const void *)s->indices32;
    out->triangle_count = (uint32_t)p->triangles;
    out->position_format = LMB_POSITION_F32;
    out->uv_format = LMB_UV_F32;
    out->index_format = s->indices16 ? LMB_INDEX_U16 : LMB_INDEX_U32;
    return 1;
}

/* --- the model ---------------------------------------------------------------------------------------------------- */

static void place_mesh(model_build *b, const lmb_mesh *mesh, uint32_t material)
{
    lmb_instance *to = &b->instances[b->instance_count++];
    int k;
    for (k = 0; k < 16; k += 5)
        to->to_world.m[k] = 1.0f;
    to->material = material;
    to->mesh = b->mesh_count;
    b->meshes[b->mesh_count++] = *mesh;
}

/* Makes a mesh for each material that triangles use. The meshes share the vertices. */
static int share_out(ply *p, const lmb_mesh *whole)
{
    const size_t width = p->s.indices16 ? sizeof *p->s.indices16 : sizeof *p->s.indices32;
    uint32_t count[MAX_PICTURES + 1] = {0}, i, m;
    uint8_t *to[MAX_PICTURES + 1] = {NULL};
    for (i = 0; i < p->triangles; ++i)
        ++count[p->paint[i]];
    for (m = 0; m < p->b->material_count; ++m) {
        lmb_mesh mesh = *whole;
        if (count[m] == 0)
            continue;
        to[m] = (uint8_t *)build_keep(p->b, 3 * (uint64_t)count[m], width);
        if (!to[m])
            return 0;
        mesh.indices = to[m];
        mesh.triangle_count = count[m];
        place_mesh(p->b, &mesh, m);
    }
    for (i = 0; i < p->triangles; ++i) {
        memcpy(to[p->paint[i]], (const uint8_t *)whole->indices + 3 * width * i, 3 * width);
        to[p->paint[i]] += 3 * width;
    }
    return 1;
}

/* Materials are white with a texture or colours, else middle grey. They are double-sided because PLY does not specify
 * sides. */
static void make_material(lmb_material *out, int32_t texture, int is_white)
{
    int k;
    for (k = 0; k < 3; ++k)
        out->albedo[k] = is_white ? 1.0f : 0.8f;
    out->alpha = 1.0f;
    out->alpha_cutoff = 0.5f;
    out->texture = texture;
    out->flags = LMB_DOUBLE_SIDED;
}

static void tell_left_out(const ply *p)
{
    uint32_t i, others = 0;
    for (i = 0; i < p->element_count; ++i)
        others += p->elements[i].kind == OTHER && p->elements[i].count > 0;
    build_note_count(p->b, "lines of the header that mean nothing here passed over", p->unknown_lines);
    build_note_count(p->b, "kinds of elements other than vertex and face skipped", others);
    build_note_count(p->b, "faces with fewer than 3 corners skipped", p->degenerate);
    build_note_count(p->b, "strips with fewer than 3 corners skipped", p->short_strips);
    build_note_count(p->b, "concave faces too large or too tangled to cut well, which may overlap themselves",
                     p->overlapping);
    build_note_count(p->b, "vertices that no face uses left out", p->unused);
    build_note_count(p->b, "colours with an alpha under 1, drawn opaque", p->translucent);
    build_note_count(p->b, "faces whose texture coordinates are not two a corner, drawn plain", p->odd_coords);
}

int ply_scene(ply *p)
{
    model_build *b = p->b;
    lmb_mesh mesh;
    uint32_t i, materials;
    memset(&mesh, 0, sizeof mesh);
    if (!choose(p))
        return 0;
    materials = b->texture_count + 1;
    b->meshes = (lmb_mesh *)build_keep(b, materials, sizeof *b->meshes);
    b->instances = (lmb_instance *)build_keep(b, materials, sizeof *b->instances);
    if (!build_materials(b, materials) || !b->meshes || !b->instances || !fill_mesh(&mesh, p))
        return 0;
    b->material_count = materials;
    for (i = 0; i < materials; ++i)
        make_material(&b->materials[i], i < b->texture_count ? (int32_t)i : -1,
                      i < b->texture_count || p->has_face_colours || p->has_vertex_colours);
    if (!p->paint)
        place_mesh(b, &mesh, 0);
    else if (!share_out(p, &mesh))
        return 0;
    tell_left_out(p);
    return 1;
}
