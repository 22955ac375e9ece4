/* gouraud.c: a scene's triangles, as a transfer divides them, with light at their corners. Layer 8. */
#include <lambent/gouraud.h>

#include <string.h>

#include "../base/poly.h"
#include "../base/surface_check.h"
#include "../base/vec.h"
#include "../base/vertex.h"
#include "../raster/target.h"
#include "../transfer/halvings.h"
#include "gouraud_fill.h"
#include "gouraud_light.h"

#if LMB_TRANSFER

/* Box sides in 1/16 px. Triangles under MAX_TINY_SIXTEENTHS take the colour of their first corner. MAX_SMALL_SIXTEENTHS
 * ones are lit only after a test that they cover a pixel. */
enum { MAX_TINY_SIXTEENTHS = 2 * 16, MAX_SMALL_SIXTEENTHS = 4 * 16 };

/* A cached corner of a mesh, indexed by the low bits of the vertex: other triangles use it soon. */
typedef struct kept_corner {
    uint32_t vertex, outside;
    float x, y, z, w;
    int32_t px, py; /* as in gouraud_corner; valid if `outside` is 0 */
    float d;
    uint32_t lit; /* side of the colour, 1 or 2; 0: no colour yet */
    float colour[3], spare[3];
} kept_corner;

/* A part of a triangle: positions and colours of the corners, and the place in the tree of divisions. */
typedef struct triangle_part {
    lmb_vec3 at[3];
    float b1[3], b2[3];
    uint32_t node, spare;
} triangle_part;

typedef char scratch_fits[sizeof(kept_corner) == sizeof(((lmb_gouraud_scratch *)0)->corner[0]) &&
                                  sizeof(triangle_part) == sizeof(((lmb_gouraud_scratch *)0)->part[0])
                              ? 1
                              : -1];

/* The same for all triangles of an instance. */
typedef struct drawing {
    const lmb_gouraud *g; /* NULL: a map */
    const lmb_scene *scene;
    gouraud_target target;
    gouraud_view of_world, of_mesh; /* of_mesh and place: for positions as stored */
    float place[3][4];              /* to world space */
    kept_corner *kept;
    triangle_part *parts;
    const lmb_instance *instance;
    const lmb_mesh *mesh;
    const lmb_material *material;
    lmb_vec3 cofactor[3];
    float albedo[3], gain;
    int is_mirrored, shows_backs;
} drawing;

/* A triangle of the instance. */
typedef struct triangle {
    uint32_t id;
    kept_corner *corner[3];
    uint32_t any;
    int back, is_tiny;
} triangle;

static void set_drawn_instance(drawing *d, const lmb_view *v, const lmb_instance *instance)
{
    const float *m = instance->to_world.m;
    const lmb_vec3 x = vec3(m[0], m[1], m[2]), y = vec3(m[4], m[5], m[6]), z = vec3(m[8], m[9], m[10]);
    d->instance = instance;
    d->mesh = &d->scene->meshes[instance->mesh];
    d->material = &d->scene->materials[instance->material];
    d->is_mirrored = is_mirrored(&instance->to_world);
    d->cofactor[0] = cross3(y, z);
    d->cofactor[1] = cross3(z, x);
    d->cofactor[2] = cross3(x, y);
    d->shows_backs = (d->material->flags & LMB_DOUBLE_SIDED) != 0;
    lmb_gouraud_view_of(&d->of_mesh, v, &instance->to_world);
    for (int i = 0; i < 3; ++i) {
        d->place[i][0] = m[i], d->place[i][1] = m[4 + i], d->place[i][2] = m[8 + i], d->place[i][3] = m[12 + i];
    }
    if (d->mesh->position_format != LMB_POSITION_F32) {
        lmb_gouraud_scale(d->of_mesh.row, d->mesh->position_scale, d->mesh->position_offset);
        lmb_gouraud_scale(d->place, d->mesh->position_scale, d->mesh->position_offset);
    }
    if (d->g != NULL) {
        lmb_gouraud_albedo(d->albedo, d->scene, d->material);
    }
    for (uint32_t i = 0; i < LMB_GOURAUD_KEPT; ++i) {
        d->kept[i].vertex = i + 1; /* invalid: this vertex belongs in another slot */
    }
}

/* The position as of_mesh and place expect it. */
static lmb_vec3 stored_position(const lmb_mesh *m, uint32_t vertex)
{
    if (m->position_format == LMB_POSITION_F32) {
        return mesh_position(m, vertex);
    }
    const int16_t *at = (const int16_t *)m->positions + (size_t)vertex * 4;
    return vec3((float)at[0], (float)at[1], (float)at[2]);
}

static void keep_corner(kept_corner *out, const drawing *d, uint32_t vertex)
{
    gouraud_point p;
    out->vertex = vertex;
    out->lit = 0;
    out->outside = gouraud_project(&p, &d->of_mesh, stored_position(d->mesh, vertex));
    out->x = p.x, out->y = p.y, out->z = p.z, out->w = p.w;
    if (out->outside == 0) {
        gouraud_point_of(&out->px, &out->py, &out->d, &d->target, &p);
    }
}

/* The visible side of a triangle that is not inside all planes, from the sign of the volume of its corners and the eye;
 * 0: front. */
static int shows_back(const drawing *d, const kept_corner *a, const kept_corner *b, const kept_corner *c)
{
    float volume;
    if (d->of_mesh.is_far) {
        volume = (b->x - a->x) * (c->y - a->y) - (c->x - a->x) * (b->y - a->y);
    } else {
        volume = a->x * (b->y * c->w - c->y * b->w) + b->x * (c->y * a->w - a->y * c->w) +
                 c->x * (a->y * b->w - b->y * a->w);
    }
    return (volume < 0.0f) != d->is_mirrored;
}

/* A corner that is not in the cache: goes into the cache, or into `spare` if another corner of the same triangle has
 * the slot. NULL: no such vertex. */
static kept_corner *new_corner(const drawing *d, uint32_t vertex, const kept_corner *other, const kept_corner *another,
                               kept_corner *spare)
{
    kept_corner *own = &d->kept[vertex % LMB_GOURAUD_KEPT];
    if (vertex >= d->mesh->vertex_count) {
        return NULL;
    }
    own = own == other || own == another ? spare : own;
    keep_corner(own, d, vertex);
    return own;
}

static inline kept_corner *find_corner(const drawing *d, uint32_t vertex, const kept_corner *other,
                                       const kept_corner *another, kept_corner *spare)
{
    kept_corner *own = &d->kept[vertex % LMB_GOURAUD_KEPT];
    return own->vertex == vertex ? own : new_corner(d, vertex, other, another, spare);
}

/* Distance of (x, y) inside an edge, times the edge's length, in 1/256 px2; and the steps per pixel along x and y. */
typedef struct side {
    int32_t at, per_x, per_y;
} side;

enum { ROW_SLACK = 8 }; /* rounding of edges along rows is less */

static side side_of_edge(const kept_corner *from, const kept_corner *to, int32_t x, int32_t y, int32_t turn)
{
    const int32_t dx = turn * (to->px - from->px), dy = turn * (to->py - from->py);
    const side s = {dx * (y - from->py) - dy * (x - from->px) + ROW_SLACK, -16 * dy, 16 * dx};
    return s;
}

/* 1 if a small triangle covers the centre of a pixel from x, y to before past_x, past_y. */
static int covers(const triangle *t, int32_t turn, int32_t x, int32_t y, int32_t past_x, int32_t past_y)
{
    const kept_corner *a = t->corner[0], *b = t->corner[1], *c = t->corner[2];
    side s = side_of_edge(a, b, 16 * x + 8, 16 * y + 8, turn), u = side_of_edge(b, c, 16 * x + 8, 16 * y + 8, turn),
         v = side_of_edge(c, a, 16 * x + 8, 16 * y + 8, turn);
    for (; y < past_y; ++y) {
        int32_t at_s = s.at, at_u = u.at, at_v = v.at;
        for (int32_t i = x; i < past_x; ++i) {
            if ((at_s | at_u | at_v) >= 0) {
                return 1;
            }
            at_s += s.per_x, at_u += u.per_x, at_v += v.per_x;
        }
        s.at += s.per_y, u.at += u.per_y, v.at += v.per_y;
    }
    return 0;
}

/* 1 if a triangle inside all planes is visible and may cover the centre of a pixel. Facing is computed from the rounded
 * corners, so neighbours agree; a few products drop half the triangles of a closed mesh. */
static int may_cover(triangle *t, const drawing *d, const kept_corner *a, const kept_corner *b, const kept_corner *c)
{
    const int32_t area = (b->px - a->px) * (c->py - a->py) - (c->px - a->px) * (b->py - a->py);
    t->back = (area > 0) != d->is_mirrored;
    if (area == 0 || (t->back && !d->shows_backs)) {
        return 0;
    }
    const int32_t x0 = mini(a->px, mini(b->px, c->px)), x1 = maxi(a->px, maxi(b->px, c->px)),
                  y0 = mini(a->py, mini(b->py, c->py)), y1 = maxi(a->py, maxi(b->py, c->py));
    const int32_t first_x = (x0 + 7) >> 4, past_x = (x1 + 7) >> 4, first_y = (y0 + 7) >> 4, past_y = (y1 + 7) >> 4;
    if (first_x >= past_x || first_y >= past_y || x1 <= 0 || y1 <= 0 || x0 >= 16 * d->target.width ||
        y0 >= 16 * d->target.height) {
        return 0;
    }
    t->is_tiny = x1 - x0 < MAX_TINY_SIXTEENTHS && y1 - y0 < MAX_TINY_SIXTEENTHS;
    return x1 - x0 >= MAX_SMALL_SIXTEENTHS || y1 - y0 >= MAX_SMALL_SIXTEENTHS ||
           covers(t, area < 0 ? -1 : 1, first_x, first_y, past_x, past_y);
}

/* 1 if triangle n of the mesh may be visible. */
static int find_triangle(triangle *out, kept_corner spare[2], const drawing *d, uint32_t n)
{
    uint32_t vertex[3];
    if (d->mesh->index_format == LMB_INDEX_U16) {
        const uint16_t *index = (const uint16_t *)d->mesh->indices + 3 * (size_t)n;
        vertex[0] = index[0], vertex[1] = index[1], vertex[2] = index[2];
    } else {
        mesh_triangle(d->mesh, n, vertex);
    }
    kept_corner *a = find_corner(d, vertex[0], NULL, NULL, NULL), *b = find_corner(d, vertex[1], a, NULL, &spare[0]),
         *c = find_corner(d, vertex[2], a, b, &spare[1]);
    if (a == NULL || b == NULL || c == NULL) {
        return 0;
    }
    out->corner[0] = a, out->corner[1] = b, out->corner[2] = c;
    out->any = a->outside | b->outside | c->outside;
    out->is_tiny = 0;
    if (out->any == 0) {
        return may_cover(out, d, a, b, c);
    }
    out->back = shows_back(d, a, b, c);
    return (a->outside & b->outside & c->outside) == 0 && (!out->back || d->shows_backs);
}

/* --- a whole triangle --------------------------------------------------------------------------------------------- */

/* Fills with the cached colours of the corners. */
static void fill_whole(const drawing *d, const triangle *t)
{
    gouraud_corner c[3];
    gouraud_point p[3];
    for (int i = 0; i < 3 && t->any == 0; ++i) {
        const kept_corner *k = t->corner[i];
        c[i].x = k->px, c[i].y = k->py, c[i].d = k->d;
        c[i].colour[0] = k->colour[0], c[i].colour[1] = k->colour[1], c[i].colour[2] = k->colour[2];
    }
    if (t->any == 0) {
        lmb_gouraud_fill(&d->target, c, t->id, t->is_tiny ? GOURAUD_FLAT : GOURAUD_MIXED);
        return;
    }
    for (int i = 0; i < 3; ++i) {
        const kept_corner *k = t->corner[i];
        p[i].x = k->x, p[i].y = k->y, p[i].z = k->z, p[i].w = k->w;
        p[i].colour[0] = k->colour[0], p[i].colour[1] = k->colour[1], p[i].colour[2] = k->colour[2];
    }
    lmb_gouraud_clip(&d->target, p, t->any, t->id, GOURAUD_MIXED);
}

/* --- light -------------------------------------------------------------------------------------------------------- */

static lmb_vec3 world_of(const drawing *d, uint32_t vertex)
{
    const lmb_vec3 at = stored_position(d->mesh, vertex);
    return vec3(gouraud_along(d->place[0], at), gouraud_along(d->place[1], at), gouraud_along(d->place[2], at));
}

/* The triangle's unit normal, on the visible side. */
static lmb_vec3 face_of(const drawing *d, const triangle *t)
{
    const lmb_vec3 a = world_of(d, t->corner[0]->vertex),
                   n = cross3(sub3(world_of(d, t->corner[1]->vertex), a), sub3(world_of(d, t->corner[2]->vertex), a));
    return mul3(normalize3(n), t->back != d->is_mirrored ? -1.0f : 1.0f);
}

/* The vertex normal, on the visible side. */
static lmb_vec3 normal_of(const drawing *d, const triangle *t, int i)
{
    const lmb_vec3 own = mesh_normal(d->mesh, t->corner[i]->vertex);
    const lmb_vec3 n =
        normalize3(add3(add3(mul3(d->cofactor[0], own.x), mul3(d->cofactor[1], own.y)), mul3(d->cofactor[2], own.z)));
    return mul3(n, t->back != d->is_mirrored ? -1.0f : 1.0f);
}

static void albedo_at_corner(float out[3], const drawing *d, const triangle *t, float b1, float b2)
{
    float colour[3][4];
    out[0] = d->albedo[0], out[1] = d->albedo[1], out[2] = d->albedo[2];
    if (d->mesh->colours == NULL) {
        return;
    }
    for (int i = 0; i < 3; ++i) {
        mesh_colour(d->mesh, t->corner[i]->vertex, colour[i]);
    }
    for (int c = 0; c < 3; ++c) {
        out[c] *= colour[0][c] + ((colour[1][c] - colour[0][c]) * b1 + (colour[2][c] - colour[0][c]) * b2);
    }
}

/* Colours a corner. If the mesh has normals, all triangles on this side share the colour, with the blend of the first
 * visible one: clusters are far larger than triangles. `blend` NULL: no reflected light. */
static void light_corner(const drawing *d, const triangle *t, int i, const uint32_t *blend)
{
    const int is_smooth = d->mesh->normals != NULL;
    kept_corner *k = t->corner[i];
    float e[3] = {0.0f, 0.0f, 0.0f}, albedo[4];
    if (is_smooth && k->lit == 1u + (uint32_t)t->back) {
        return;
    }
    const lmb_vec3 normal = is_smooth ? normal_of(d, t, i) : face_of(d, t);
    k->lit = 1u + (uint32_t)t->back;
    lmb_gouraud_direct(e, d->g, world_of(d, t->corner[i]->vertex), normal, t->id, 0);
    if (blend != NULL) {
        lmb_gouraud_blend(e, d->g, blend[i], normal);
    }
    mesh_colour(d->mesh, k->vertex, albedo);
    for (int c = 0; c < 3; ++c) {
        albedo[c] *= d->albedo[c];
    }
    lmb_gouraud_colour(k->colour, e, albedo, d->gain);
}

/* Draws a small triangle of a mesh. */
static void draw_small(const drawing *d, const triangle *t, const uint32_t *blend)
{
    for (int i = 0; i < (t->is_tiny ? 1 : 3); ++i) {
        light_corner(d, t, i, blend);
    }
    fill_whole(d, t);
}

/* --- a divided triangle ------------------------------------------------------------------------------------------- */

/* Light at a corner of a leaf: direct light, once for all corners with the same receiver, plus reflected light. */
static void light_at(float e[3], const drawing *d, const triangle *t, lmb_vec3 at, uint32_t receiver, lmb_vec3 face)
{
    float *direct = d->g->direct[receiver];
    if (direct[0] < 0.0f) {
        direct[0] = direct[1] = direct[2] = 0.0f;
        lmb_gouraud_direct(direct, d->g, at, face, t->id, 1);
    }
    for (int c = 0; c < 3; ++c) {
        e[c] = direct[c] + maxf(d->g->light->receiver[receiver][c], 0.0f);
    }
}

/* `corner`: receivers, or blends if light is stored by direction. */
static void draw_leaf(const drawing *d, const triangle *t, const triangle_part *leaf, const uint32_t *corner,
                      int is_directed, lmb_vec3 face)
{
    gouraud_point p[3];
    uint32_t any = 0, all = GOURAUD_OUTSIDE;
    for (int i = 0; i < 3; ++i) {
        const uint32_t outside = gouraud_project(&p[i], &d->of_world, leaf->at[i]);
        any |= outside;
        all &= outside;
    }
    if (all != 0) {
        return;
    }
    for (int i = 0; i < 3; ++i) {
        float e[3] = {0.0f, 0.0f, 0.0f}, albedo[3];
        if (is_directed) {
            lmb_gouraud_direct(e, d->g, leaf->at[i], face, t->id, 1);
            lmb_gouraud_blend(e, d->g, corner[i], face);
        } else {
            light_at(e, d, t, leaf->at[i], corner[i], face);
        }
        albedo_at_corner(albedo, d, t, leaf->b1[i], leaf->b2[i]);
        lmb_gouraud_colour(p[i].colour, e, albedo, d->gain);
    }
    if (any == 0) {
        const gouraud_corner c[3] = {lmb_gouraud_place(&d->target, &p[0]), lmb_gouraud_place(&d->target, &p[1]),
                                     lmb_gouraud_place(&d->target, &p[2])};
        lmb_gouraud_fill(&d->target, c, t->id, GOURAUD_GROWN);
    } else {
        lmb_gouraud_clip(&d->target, p, any, t->id, GOURAUD_GROWN);
    }
}

/* Moves corner k to the split point of the edge. It is exactly the same point for both triangles that share the
 * edge. */
static void enter_triangle_half(triangle_part *p, const transfer_halving *h, int second)
{
    const int from = h->from, to = halving_to(from), k = second ? from : to;
    const float rest = 1.0f - h->part;
    const lmb_vec3 at = add3(mul3(p->at[from], rest), mul3(p->at[to], h->part));
    const float b1 = rest * p->b1[from] + h->part * p->b1[to], b2 = rest * p->b2[from] + h->part * p->b2[to];
    p->at[k] = at;
    p->b1[k] = b1;
    p->b2[k] = b2;
    p->node = h->first + (uint32_t)second;
}

/* Draws all leaves below a root. `left`: limits their number in damaged files. */
static void draw_divided(const drawing *d, const triangle *t, uint32_t root)
{
    const lmb_transfer *file = d->g->transfer;
    const uint32_t *node = file->section[LMB_TRANSFER_DIVISIONS], *corners = file->section[LMB_TRANSFER_CORNERS];
    const lmb_vec3 face = face_of(d, t);
    uint32_t left = file->count[LMB_TRANSFER_DIVISIONS];
    int count = 1;
    triangle_part *first = &d->parts[0];
    memset(first, 0, sizeof *first);
    for (int i = 0; i < 3; ++i) {
        first->at[i] = world_of(d, t->corner[i]->vertex);
    }
    first->b1[1] = first->b2[2] = 1.0f;
    first->node = root;
    for (; count > 0 && left > 0; --left) {
        triangle_part here = d->parts[--count];
        while ((node[here.node] & LMB_TRANSFER_LEAF) == 0 && count <= LMB_TRANSFER_MAX_HALVINGS) {
            const transfer_halving h = halving_of(file, node[here.node]);
            d->parts[count] = here;
            enter_triangle_half(&d->parts[count++], &h, 1);
            enter_triangle_half(&here, &h, 0);
        }
        const uint32_t place = node[here.node] & ~LMB_TRANSFER_LEAF;
        if ((node[here.node] & LMB_TRANSFER_LEAF) != 0) {
            draw_leaf(d, t, &here, corners + LMB_TRANSFER_CORNER_WORDS * (size_t)place, place >= file->leaves, face);
        }
    }
}

static void draw_triangle(const drawing *d, const triangle *t)
{
    if (d->g == NULL) {
        fill_whole(d, t);
        return;
    }
    const lmb_transfer *file = d->g->transfer;
    const uint32_t root = file->section[LMB_TRANSFER_SURFACES]
                                       [LMB_TRANSFER_SURFACE_WORDS * (size_t)(t->id - 1) + 2 + (t->back ? 1u : 0u)];
    const uint32_t word = root != LMB_TRANSFER_NONE ? file->section[LMB_TRANSFER_DIVISIONS][root] : 0;
    if (root == LMB_TRANSFER_NONE) {
        draw_small(d, t, NULL);
    } else if ((word & LMB_TRANSFER_LEAF) != 0 && (word & ~LMB_TRANSFER_LEAF) >= file->leaves) {
        draw_small(d, t,
                   file->section[LMB_TRANSFER_CORNERS] +
                       LMB_TRANSFER_CORNER_WORDS * (size_t)(word & ~LMB_TRANSFER_LEAF));
    } else {
        draw_divided(d, t, root);
    }
}

static void draw_gouraud_range(drawing *d, const lmb_view *v, uint32_t first_id, uint32_t past)
{
    const uint32_t all = lmb_scene_triangles(d->scene);
    past = past < all + 1 ? past : all + 1;
    for (uint32_t i = 0; i < d->scene->instance_count; ++i) {
        const lmb_instance *instance = &d->scene->instances[i];
        const uint32_t own = instance->first_id, own_past = own + d->scene->meshes[instance->mesh].triangle_count;
        const uint32_t from = first_id > own ? first_id : own, to = past < own_past ? past : own_past;
        if (from < to) {
            set_drawn_instance(d, v, instance);
        }
        for (uint32_t id = from; id < to; ++id) {
            triangle t;
            kept_corner spare[2];
            t.id = id;
            if (find_triangle(&t, spare, d, id - own)) {
                draw_triangle(d, &t);
            }
        }
    }
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

static void lay_rows(lmb_surface *s)
{
    if (s->layout == LMB_TILED) {
        s->layout = LMB_LINEAR;
        s->stride_bytes /= LMB_TILE;
    }
}

lmb_status lmb_gouraud_map(lmb_shadow_map *map, lmb_gouraud_scratch *scratch, const lmb_scene *scene)
{
    drawing d;
    if (map == NULL || scene == NULL || scratch == NULL || map->size < 1 || map->size > LMB_GOURAUD_MAX_SIDE ||
        map->faces < 1) {
        return LMB_ERR_ARG;
    }
    memset(&d, 0, sizeof d);
    d.scene = scene;
    d.kept = (kept_corner *)(void *)scratch->corner;
    for (int32_t f = 0; f < map->faces; ++f) {
        lmb_target *face = &map->face[f];
        lmb_surface_clear(&face->depth);
        lmb_surface_clear(&face->id);
        lay_rows(&face->depth);
        lay_rows(&face->id);
        d.target.depth = (float *)face->depth.data;
        d.target.id = face->id.data;
        d.target.id_format = face->id.format;
        d.target.step = map->size;
        lmb_gouraud_size(&d.target, map->size, map->size);
        if ((map->drawn >> f & 1u) != 0) {
            draw_gouraud_range(&d, &map->view[f], 1, UINT32_MAX);
        }
    }
    return LMB_OK;
}

/* 1 if the maps are linear, as lmb_gouraud_map leaves them. */
static int are_maps(const lmb_shadow_map *maps, uint32_t count)
{
    int all = 1;
    for (uint32_t i = 0; maps != NULL && i < count; ++i) {
        all &= maps[i].faces > 0 && maps[i].face[0].depth.layout == LMB_LINEAR;
    }
    return all;
}

static int is_complete(const lmb_gouraud *g)
{
    return g != NULL && g->scene != NULL && g->transfer != NULL && g->transfer->section[0] != NULL &&
           g->light != NULL && g->light->receiver != NULL && g->direct != NULL && g->scratch != NULL &&
           g->depth != NULL && g->transfer->count[LMB_TRANSFER_SURFACES] == lmb_scene_triangles(g->scene) &&
           are_maps(g->maps, g->scene->light_count) && lmb_view_is_valid(&g->view) && lmb_surface_is_valid(&g->out) &&
           g->out.width == g->view.frame_width && g->out.height == g->view.frame_height;
}

lmb_status lmb_gouraud_begin(const lmb_gouraud *g)
{
    if (!is_complete(g)) {
        return LMB_ERR_ARG;
    }
    if (g->out.format != LMB_RGB565 || g->out.layout != LMB_LINEAR) {
        return LMB_ERR_FORMAT;
    }
    if (g->out.width > LMB_GOURAUD_MAX_SIDE || g->out.height > LMB_GOURAUD_MAX_SIDE) {
        return LMB_ERR_CAPACITY;
    }
    lmb_surface_clear(&g->out);
    memset(g->depth, 0, (size_t)g->out.width * (size_t)g->out.height * sizeof *g->depth);
    for (uint32_t i = 0; i < g->transfer->count[LMB_TRANSFER_RECEIVERS]; ++i) {
        g->direct[i][0] = -1.0f;
    }
    return LMB_OK;
}

lmb_status lmb_gouraud_draw(const lmb_gouraud *g, uint32_t first_id, uint32_t count)
{
    static const lmb_mat4 unit = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    drawing d;
    if (!is_complete(g) || first_id == 0 || g->out.format != LMB_RGB565 || g->out.width > LMB_GOURAUD_MAX_SIDE ||
        g->out.height > LMB_GOURAUD_MAX_SIDE) {
        return LMB_ERR_ARG;
    }
    memset(&d, 0, sizeof d);
    d.g = g;
    d.scene = g->scene;
    d.kept = (kept_corner *)(void *)g->scratch->corner;
    d.parts = (triangle_part *)(void *)g->scratch->part;
    d.gain = lmb_exp2(g->exposure_ev) * 0.31830989f;
    d.target.pixel = (uint16_t *)g->out.data;
    d.target.pixel_step = g->out.stride_bytes / (int32_t)sizeof(uint16_t);
    d.target.depth16 = g->depth;
    d.target.step = g->out.width;
    lmb_gouraud_size(&d.target, g->out.width, g->out.height);
    lmb_gouraud_view_of(&d.of_world, &g->view, &unit);
    draw_gouraud_range(&d, &g->view, first_id, count > UINT32_MAX - first_id ? UINT32_MAX : first_id + count);
    return LMB_OK;
}

#endif
