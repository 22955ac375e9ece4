/* pack_mesh.c: a scene's meshes -> 16-bit vertices if the error allows, equal vertices merged, triangles reordered.
 *
 * All positions lie on one power-of-two grid: positions that two meshes share stay equal, and scale x code + offset is
 * exact, so no cracks open between meshes with the same placement. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"
#include "pack.h"

enum { VERTEX_WORDS = 10 };
#define UV_TEXELS 0.0625 /* error allowed for 16-bit texture coordinates */
#define EXACT     8388608.0 /* grid steps from the origin up to which binary32 is exact for steps and a mesh's middle */

/* A mesh and the requirements of the materials on it. */
typedef struct mesh_job {
    const lmb_mesh *mesh;
    double step, grows; /* step: m, 0: positions stay binary32; grows: largest scale of the instances */
    double low[3], high[3]; /* bounding box of the corners */
    int has_maps, has_normal_map, may_shift, side;
    double uv_shift[2], uv_scale[2];
    uint8_t position_format, uv_format, colour_format, has_colours, is_sane;
    double middle[3]; /* steps */
} mesh_job;

/* Vertices as written, without duplicates. */
typedef struct vertex_table {
    uint32_t *word; /* `each` words per vertex */
    uint32_t *slot; /* hash table: 1 + the vertex; 0: free */
    uint32_t each, count, slots;
} vertex_table;

/* --- analysis ----------------------------------------------------------------------------------------------------- */

/* The maximum scale of a vector by this transform: at least the largest singular value. */
static double growth_of(const float *m)
{
    double upper = 0.0;
    for (int a = 0; a < 3; ++a) {
        double sum = 0.0;
        for (int b = 0; b < 3; ++b) {
            double dot = 0.0;
            for (int k = 0; k < 3; ++k) {
                dot += (double)m[4 * a + k] * (double)m[4 * b + k];
            }
            sum += fabs(dot);
        }
        upper = sum > upper ? sum : upper;
    }
    return sqrt(upper);
}

static void add_map(mesh_job *j, const lmb_scene *s, uint32_t texture)
{
    const lmb_texture *t = &s->textures[texture];
    j->has_maps = 1;
    j->side = t->width > j->side ? t->width : j->side;
    j->side = t->height > j->side ? t->height : j->side;
    j->may_shift &= t->wrap_s != LMB_WRAP_CLAMP && t->wrap_t != LMB_WRAP_CLAMP;
}

static void add_material(mesh_job *j, const lmb_scene *s, const lmb_material *m)
{
    if (m->texture >= 0) {
        add_map(j, s, (uint32_t)m->texture);
    }
    if (m->normal_scale != 0.0f) {
        add_map(j, s, m->normal_map);
        j->has_normal_map = 1;
    }
    if (m->emission_map > 0) {
        add_map(j, s, m->emission_map - 1);
    }
    if (m->metal_map > 0) {
        add_map(j, s, m->metal_map - 1);
    }
}

static int is_corner(const lmb_mesh *m, uint32_t corner, uint32_t *vertex)
{
    *vertex = lmb_mesh_index(m, corner);
    return *vertex < m->vertex_count;
}

/* Bounds of positions and texture coordinates, over corners. */
static void measure(mesh_job *j)
{
    const lmb_mesh *m = j->mesh;
    double uv_low[2] = {1e30, 1e30}, uv_high[2] = {-1e30, -1e30};
    uint32_t v;
    j->is_sane = 1;
    for (int k = 0; k < 3; ++k) {
        j->low[k] = 1e30;
        j->high[k] = -1e30;
    }
    for (uint32_t i = 0; i < 3 * m->triangle_count; ++i) {
        lmb_vertex own;
        if (!is_corner(m, i, &v) || !lmb_mesh_vertex(&own, m, v)) {
            continue;
        }
        const lmb_vec3 p = own.position;
        const double at[3] = {(double)p.x, (double)p.y, (double)p.z};
        const float *uv = own.uv;
        j->is_sane &= is_place(p);
        for (int k = 0; k < 3; ++k) {
            j->low[k] = at[k] < j->low[k] ? at[k] : j->low[k];
            j->high[k] = at[k] > j->high[k] ? at[k] : j->high[k];
        }
        for (int k = 0; k < 2; ++k) {
            j->uv_format = fabs((double)uv[k]) < 1e6 ? j->uv_format : LMB_UV_F32;
            uv_low[k] = (double)uv[k] < uv_low[k] ? (double)uv[k] : uv_low[k];
            uv_high[k] = (double)uv[k] > uv_high[k] ? (double)uv[k] : uv_high[k];
        }
        if (m->colours != NULL) {
            for (int k = 0; k < 4; ++k) {
                j->has_colours |= own.colour[k] < 1.0f;
            }
        }
    }
    for (int k = 0; k < 2; ++k) { /* two periods, for mirrored ones */
        j->uv_shift[k] = j->may_shift && uv_low[k] > -1e6 && uv_low[k] < 1e6 ? 2.0 * floor(uv_low[k] / 2.0) : 0.0;
        j->uv_scale[k] = uv_high[k] - j->uv_shift[k] > 0.0 ? (double)(float)(uv_high[k] - j->uv_shift[k]) : 1.0;
        const double error = j->uv_scale[k] / 131070.0 * j->side;
        if (!(uv_low[k] - j->uv_shift[k] >= 0.0) || !(error <= UV_TEXELS)) {
            j->uv_format = LMB_UV_F32;
        }
    }
}

/* --- the grid ----------------------------------------------------------------------------------------------------- */

static double power_of_2(double at_most)
{
    int e;
    frexp(at_most, &e);
    return ldexp(1.0, e - 1);
}

static double widest(const mesh_job *j)
{
    double upper = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double wide = floor(j->high[k] / j->step + 0.5) - floor(j->low[k] / j->step + 0.5);
        upper = wide > upper ? wide : upper;
    }
    return upper;
}

static double farthest(const mesh_job *j)
{
    double upper = 0.0;
    for (int k = 0; k < 3; ++k) {
        upper = fmax(upper, fmax(fabs(j->low[k]), fabs(j->high[k])) / j->step);
    }
    return upper;
}

static int fits(const mesh_job *j) { return widest(j) <= 65535.0 && farthest(j) < EXACT; }

static int may_quantise(const mesh_job *j) { return j->is_sane && j->low[0] <= j->high[0]; }

/* Sets the step that the error allows. Then makes it finer for all meshes together, as long as 16-bit meshes stay so,
 * because that costs nothing. */
static void set_grid(mesh_job *jobs, uint32_t count, double error_m)
{
    const double largest = 2.0 * error_m / sqrt(3.0);
    uint32_t i;
    for (i = 0; i < count; ++i) {
        jobs[i].step = error_m > 0.0 && may_quantise(&jobs[i]) ? power_of_2(largest / fmax(jobs[i].grows, 1e-9)) : 0.0;
        jobs[i].position_format = jobs[i].step > 0.0 && fits(&jobs[i]) ? LMB_POSITION_I16 : LMB_POSITION_F32;
    }
    for (int halvings = 0; halvings < 8; ++halvings) {
        int all = 1;
        for (i = 0; i < count; ++i) {
            mesh_job finer = jobs[i];
            finer.step *= 0.5;
            all &= finer.position_format != LMB_POSITION_I16 || fits(&finer);
        }
        for (i = 0; i < count && all; ++i) {
            jobs[i].step *= 0.5;
        }
        if (!all) {
            break;
        }
    }
    for (i = 0; i < count; ++i) {
        for (int k = 0; k < 3 && jobs[i].position_format == LMB_POSITION_I16; ++k) {
            jobs[i].middle[k] = floor(jobs[i].low[k] / jobs[i].step + 0.5) + 32768.0;
        }
        if (jobs[i].step > 0.0 && jobs[i].position_format == LMB_POSITION_F32 && farthest(&jobs[i]) >= EXACT) {
            jobs[i].step = 0.0;
        }
    }
}

/* --- vertices ----------------------------------------------------------------------------------------------------- */

static void put_position(uint32_t *w, const mesh_job *j, uint32_t v, double *error_m)
{
    lmb_vertex own;
    lmb_mesh_vertex(&own, j->mesh, v);
    const lmb_vec3 p = own.position;
    const double at[3] = {(double)p.x, (double)p.y, (double)p.z};
    int16_t code[4] = {0, 0, 0, 0};
    float moved[3];
    double off = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double steps = j->step > 0.0 ? floor(at[k] / j->step + 0.5) : 0.0;
        const double to = j->step > 0.0 ? steps * j->step : at[k];
        moved[k] = (float)to + 0.0f;
        off += (to - at[k]) * (to - at[k]);
        code[k] = (int16_t)(steps - j->middle[k]);
    }
    off = sqrt(off) * j->grows;
    *error_m = off > *error_m ? off : *error_m;
    if (j->position_format == LMB_POSITION_I16) {
        memcpy(w, code, sizeof code);
    } else {
        memcpy(w, moved, sizeof moved);
    }
}

static void put_uv(uint32_t *w, const mesh_job *j, uint32_t v, double *error)
{
    lmb_vertex own;
    uint16_t code[2];
    lmb_mesh_vertex(&own, j->mesh, v);
    const float *uv = own.uv;
    if (j->uv_format == LMB_UV_F32) {
        memcpy(w, uv, sizeof own.uv);
        return;
    }
    for (int k = 0; k < 2; ++k) {
        const double share = ((double)uv[k] - j->uv_shift[k]) / j->uv_scale[k];
        code[k] = (uint16_t)floor(share * 65535.0 + 0.5);
        const double off = fabs((double)code[k] / 65535.0 - share) * j->uv_scale[k] * j->side;
        *error = off > *error ? off : *error;
    }
    memcpy(w, code, sizeof code);
}

static void put_colour(uint32_t *w, const mesh_job *j, uint32_t v)
{
    const lmb_mesh *m = j->mesh;
    lmb_vertex own;
    uint8_t code[4];
    if (j->colour_format == m->colour_format) {
        const size_t bytes = m->colour_format == LMB_COLOUR_RGBA16 ? 8 : 4;
        memcpy(w, m->colours + bytes * v, bytes);
        return;
    }
    lmb_mesh_vertex(&own, m, v);
    for (int k = 0; k < 4; ++k) {
        code[k] = (uint8_t)(own.colour[k] * 255.0f + 0.5f);
    }
    memcpy(w, code, sizeof code);
}

static uint32_t colour_words(const mesh_job *j)
{
    return j->mesh->colours == NULL ? 0 : j->colour_format == LMB_COLOUR_RGBA16 ? 2 : 1;
}

static uint32_t words_of(const mesh_job *j)
{
    return (j->position_format == LMB_POSITION_I16 ? 2 : 3) + (j->mesh->normals != NULL) + (j->mesh->tangents != NULL) +
           (j->mesh->uvs == NULL ? 0 : j->uv_format == LMB_UV_U16 ? 1 : 2) + colour_words(j);
}

static void make_vertex(uint32_t *w, const mesh_job *j, uint32_t v, pack_losses *lost)
{
    const lmb_mesh *m = j->mesh;
    put_position(w, j, v, &lost->position_m);
    w += j->position_format == LMB_POSITION_I16 ? 2 : 3;
    if (m->normals != NULL) {
        memcpy(w++, m->normals + 2 * (size_t)v, 4);
    }
    if (m->tangents != NULL) {
        memcpy(w++, m->tangents + 2 * (size_t)v, 4);
    }
    if (m->uvs != NULL) {
        put_uv(w, j, v, &lost->uv_texels);
        w += j->uv_format == LMB_UV_U16 ? 1 : 2;
    }
    if (m->colours != NULL) {
        put_colour(w, j, v);
    }
}

/* Returns the number of the vertex with these words, adding it if it is new. */
static uint32_t join(vertex_table *t, const uint32_t *w)
{
    uint32_t hash = 2166136261u;
    for (uint32_t i = 0; i < t->each; ++i) {
        hash = (hash ^ w[i]) * 0x9e3779b1u;
        hash ^= hash >> 15;
    }
    for (uint32_t at = hash & (t->slots - 1);; at = (at + 1) & (t->slots - 1)) {
        const uint32_t v = t->slot[at];
        if (v == 0) {
            memcpy(t->word + (size_t)t->count * t->each, w, t->each * sizeof *w);
            t->slot[at] = ++t->count;
            return t->count - 1;
        }
        if (memcmp(t->word + (size_t)(v - 1) * t->each, w, t->each * sizeof *w) == 0) {
            return v - 1;
        }
    }
}

static int is_flat(const vertex_table *t, const mesh_job *j, const uint32_t *corner)
{
    const size_t words = j->position_format == LMB_POSITION_I16 ? 2 : 3;
    int same = 0;
    for (int k = 0; k < 3; ++k) {
        same |= memcmp(t->word + (size_t)corner[k] * t->each, t->word + (size_t)corner[(k + 1) % 3] * t->each,
                       words * sizeof *t->word) == 0;
    }
    return same;
}

/* Collects the visible triangles. Returns their number. Vertices of the others may stay in the table: compact drops
 * them. */
static uint32_t take_triangles(uint32_t *index, vertex_table *t, const mesh_job *j, pack_losses *lost)
{
    const lmb_mesh *m = j->mesh;
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->triangle_count; ++i) {
        uint32_t *corner = index + 3 * (size_t)count, v;
        int all = 1;
        for (uint32_t k = 0; k < 3 && all; ++k) {
            uint32_t w[VERTEX_WORDS] = {0};
            all = is_corner(m, 3 * i + k, &v);
            if (all) {
                make_vertex(w, j, v, lost);
                corner[k] = join(t, w);
            }
        }
        count += all && !is_flat(t, j, corner);
    }
    lost->dropped += m->triangle_count - count;
    return count;
}

/* Renumbers vertices in the order of first use, and drops unused ones. */
static void compact(uint32_t *index, uint32_t triangles, uint32_t *number, uint32_t *moved, vertex_table *t)
{
    uint32_t count = 0;
    memset(number, 255, (size_t)t->count * sizeof *number);
    for (size_t i = 0; i < 3 * (size_t)triangles; ++i) {
        uint32_t *to = &number[index[i]];
        if (*to == UINT32_MAX) {
            *to = count;
            memcpy(moved + (size_t)count++ * t->each, t->word + (size_t)index[i] * t->each, t->each * sizeof *moved);
        }
        index[i] = *to;
    }
    memcpy(t->word, moved, (size_t)count * t->each * sizeof *moved);
    t->count = count;
}

/* --- streams ------------------------------------------------------------------------------------------------------ */

/* Appends `words` words of each vertex from word `at` on. Returns the offset. */
static uint32_t put_stream(pack_buffer *to, const vertex_table *t, uint32_t *at, uint32_t words)
{
    const uint32_t place = pack_place(to);
    for (uint32_t v = 0; v < t->count; ++v) {
        pack_put(to, t->word + (size_t)v * t->each + *at, words * sizeof *t->word);
    }
    *at += words;
    return t->count > 0 ? place : 0;
}

static uint32_t put_indices(pack_buffer *to, const uint32_t *index, uint32_t triangles, int format)
{
    const uint32_t place = pack_place(to);
    const size_t corners = 3 * (size_t)triangles;
    for (size_t i = 0; i < corners; i += 2) {
        const uint16_t pair[2] = {(uint16_t)index[i], (uint16_t)(i + 1 < corners ? index[i + 1] : 0)};
        if (format == LMB_INDEX_U16) {
            pack_put(to, pair, sizeof pair);
        } else {
            pack_put(to, index + i, (i + 1 < corners ? 2 : 1) * sizeof *index);
        }
    }
    return triangles > 0 ? place : 0;
}

static void put_mesh(pack *out, const mesh_job *j, const vertex_table *t, const uint32_t *index, uint32_t triangles)
{
    pack_buffer *record = &out->part[LMB_PACK_MESHES], *vertices = &out->part[LMB_PACK_VERTICES];
    const lmb_mesh *m = j->mesh;
    const int is_short = t->count <= 65536, index_format = is_short ? LMB_INDEX_U16 : LMB_INDEX_U32;
    uint32_t at = 0;
    pack_word(record, t->count);
    pack_word(record, triangles);
    pack_word(record, (uint32_t)j->position_format | (uint32_t)j->uv_format << 8 | (uint32_t)index_format << 16 |
                          (m->tangents != NULL ? (uint32_t)m->tangent_format << 24 : 0) |
                          (m->colours != NULL ? (uint32_t)j->colour_format << 28 : 0));
    pack_word(record, put_stream(vertices, t, &at, j->position_format == LMB_POSITION_I16 ? 2 : 3));
    pack_word(record, m->normals != NULL ? put_stream(vertices, t, &at, 1) : 0);
    pack_word(record, m->tangents != NULL ? put_stream(vertices, t, &at, 1) : 0);
    pack_word(record, m->uvs != NULL ? put_stream(vertices, t, &at, j->uv_format == LMB_UV_U16 ? 1 : 2) : 0);
    pack_word(record, m->colours != NULL ? put_stream(vertices, t, &at, colour_words(j)) : 0);
    pack_word(record, put_indices(&out->part[LMB_PACK_INDICES], index, triangles, index_format));
    for (int k = 0; k < 3; ++k) {
        pack_float(record, j->position_format == LMB_POSITION_I16 ? (float)j->step : 0.0f);
    }
    for (int k = 0; k < 3; ++k) {
        pack_float(record, j->position_format == LMB_POSITION_I16 ? (float)(j->middle[k] * j->step) : 0.0f);
    }
    for (int k = 0; k < 2; ++k) {
        pack_float(record, m->uvs != NULL && j->uv_format == LMB_UV_U16 ? (float)j->uv_scale[k] : 0.0f);
    }
    pack_words(record, 3, 0);
    out->lost.vertices += t->count;
    out->lost.triangles += triangles;
    out->lost.float_meshes += j->position_format == LMB_POSITION_F32 && t->count > 0;
}

/* Drops streams that no material or triangle uses. */
static lmb_mesh needed(const mesh_job *j)
{
    lmb_mesh m = *j->mesh;
    m.uvs = j->has_maps ? m.uvs : NULL;
    m.tangents = j->has_normal_map && (m.uvs != NULL || m.tangent_format == LMB_TANGENT_SIDED) ? m.tangents : NULL;
    m.colours = j->has_colours ? m.colours : NULL;
    return m;
}

static int pack_one(pack *out, const mesh_job *job, const pack_settings *set, report *r)
{
    const lmb_mesh m = needed(job);
    mesh_job j = *job;
    vertex_table t;
    memset(&t, 0, sizeof t);
    j.mesh = &m;
    t.each = words_of(&j);
    const size_t corners = 3 * (size_t)m.triangle_count, upper = corners < m.vertex_count ? corners : m.vertex_count;
    for (t.slots = 16; t.slots < 2 * upper; t.slots *= 2) {
    }
    uint32_t *index = malloc((corners + 1) * sizeof *index), *number = malloc((upper + 1) * sizeof *number),
             *moved = malloc((upper + 1) * t.each * sizeof *moved);
    t.word = malloc((upper + 1) * t.each * sizeof *t.word);
    t.slot = calloc(t.slots, sizeof *t.slot);
    int ok = index != NULL && number != NULL && moved != NULL && t.word != NULL && t.slot != NULL;
    if (ok) {
        const uint32_t triangles = take_triangles(index, &t, &j, &out->lost);
        out->lost.vertices_before += m.vertex_count;
        out->lost.fetched_before += pack_fetched(index, triangles, number, t.count);
        ok = set->order == PACK_FILE || pack_order(index, triangles, t.count);
        out->lost.fetched += pack_fetched(index, triangles, number, t.count);
        compact(index, triangles, number, moved, &t);
        put_mesh(out, &j, &t, index, triangles);
    }
    free(index);
    free(number);
    free(moved);
    free(t.word);
    free(t.slot);
    return ok || report_fail(r, "not enough memory for a mesh of %u triangles", (unsigned)m.triangle_count);
}

int pack_meshes(pack *out, const lmb_scene *scene, const pack_settings *set, report *r)
{
    mesh_job *jobs = calloc((size_t)scene->mesh_count + 1, sizeof *jobs);
    if (jobs == NULL) {
        return report_fail(r, "not enough memory for %u meshes", (unsigned)scene->mesh_count);
    }
    for (uint32_t i = 0; i < scene->mesh_count; ++i) {
        jobs[i].mesh = &scene->meshes[i];
        jobs[i].may_shift = 1;
        jobs[i].uv_format = LMB_UV_U16;
        jobs[i].colour_format = set->textures == PACK_RGBA8 ? LMB_COLOUR_RGBA8 : scene->meshes[i].colour_format;
    }
    for (uint32_t i = 0; i < scene->instance_count; ++i) {
        mesh_job *j = &jobs[scene->instances[i].mesh];
        double grows = growth_of(scene->instances[i].to_world.m);
        grows = grows > 1e-3 ? grows : 1.0; /* an instance of scale 0 may grow by an animation */
        j->grows = grows > j->grows ? grows : j->grows;
        add_material(j, scene, &scene->materials[scene->instances[i].material]);
    }
    for (uint32_t i = 0; i < scene->mesh_count; ++i) {
        jobs[i].grows = jobs[i].grows > 0.0 ? jobs[i].grows : 1.0;
        measure(&jobs[i]);
    }
    set_grid(jobs, scene->mesh_count, set->position_error_m);
    int ok = 1;
    for (uint32_t i = 0; ok && i < scene->mesh_count; ++i) {
        ok = pack_one(out, &jobs[i], set, r);
    }
    free(jobs);
    return ok;
}
