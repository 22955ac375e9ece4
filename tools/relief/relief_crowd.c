/* relief_crowd.c: draws many placements of reliefs. Each is drawn in the relief's own space, where the eye is turned,
 * moved and scaled instead of the model: depths of the view stay equal. [P11] */
#include "relief_crowd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../common/fvec.h"

/* --- placements --------------------------------------------------------------------------------------------------- */

static lmb_vec3 turned(const relief_placed *p, lmb_vec3 d)
{
    return vec3(p->cosine * d.x + p->sine * d.z, d.y, p->cosine * d.z - p->sine * d.x);
}

static lmb_vec3 turned_back(const relief_placed *p, lmb_vec3 d)
{
    return vec3(p->cosine * d.x - p->sine * d.z, d.y, p->cosine * d.z + p->sine * d.x);
}

static lmb_vec3 placed_at(const relief_placed *p, lmb_vec3 q) { return add3(mul3(turned(p, q), p->scale), p->at); }

static lmb_vec3 box_corner(const lmb_relief *r, int i)
{
    return vec3(i & 1 ? r->high.x : r->low.x, i & 2 ? r->high.y : r->low.y, i & 4 ? r->high.z : r->low.z);
}

static lmb_mat4 matrix_of(const relief_placed *p)
{
    const float c = p->cosine * p->scale, s = p->sine * p->scale;
    return (lmb_mat4){{c, 0, -s, 0, 0, p->scale, 0, 0, s, 0, c, 0, p->at.x, p->at.y, p->at.z, 1}};
}

static uint32_t file_of(const relief_crowd *c, const lmb_relief *relief)
{
    uint32_t i = 0;
    while (i < c->files && &c->file[i]->relief != relief) {
        ++i;
    }
    return i;
}

static void widen_scene(lmb_scene *s, const relief_placed *p, int is_first)
{
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 q = placed_at(p, box_corner(p->relief, i));
        s->bounds_min = is_first && i == 0 ? q : min3(s->bounds_min, q);
        s->bounds_max = is_first && i == 0 ? q : max3(s->bounds_max, q);
    }
}

int relief_crowd_scene(relief_crowd *c, report *r)
{
    uint64_t triangles = 0;
    c->meshes = calloc(c->files, sizeof *c->meshes);
    c->instances = calloc(c->count, sizeof *c->instances);
    if (c->meshes == NULL || c->instances == NULL) {
        return report_fail(r, "not enough memory for %u reliefs", (unsigned)c->count);
    }
    for (uint32_t i = 0; i < c->files; ++i) {
        c->meshes[i] = c->file[i]->relief.mesh;
    }
    for (uint32_t i = 0; i < c->count; ++i) {
        const relief_placed *p = &c->placed[i];
        c->instances[i] = p->relief->instance;
        c->instances[i].to_world = matrix_of(p);
        c->instances[i].mesh = file_of(c, p->relief);
        c->instances[i].first_id = (uint32_t)triangles + 1;
        triangles += p->relief->mesh.triangle_count;
        if (triangles >= LMB_MAX_TRIANGLES) {
            return report_fail(r, "the simple models have over %d triangles in all", LMB_MAX_TRIANGLES - 1);
        }
        widen_scene(&c->scene, p, i == 0);
    }
    c->scene.meshes = c->meshes;
    c->scene.materials = &c->file[0]->relief.material; /* all are equal */
    c->scene.instances = c->instances;
    c->scene.mesh_count = c->files;
    c->scene.material_count = 1;
    c->scene.instance_count = c->count;
    return 1;
}

/* --- in a view ---------------------------------------------------------------------------------------------------- */

static lmb_view own_view(const relief_placed *p, const lmb_view *v)
{
    lmb_view out = *v;
    const float per = 1.0f / p->scale;
    out.eye = mul3(turned_back(p, sub3(v->eye, p->at)), per);
    out.right = turned_back(p, v->right);
    out.up = turned_back(p, v->up);
    out.back = turned_back(p, v->back);
    out.near_m *= per;
    out.far_m *= per;
    if (v->kind != LMB_PERSPECTIVE) {
        out.half_width *= per;
        out.half_height *= per;
    }
    return out;
}

/* Pixels that may show a box, with a pixel more on each side. */
typedef struct screen_box {
    float left, top, right, bottom; /* px */
    float near_m, far_m;
} screen_box;

static screen_box box_of(const relief_placed *p, const lmb_view *v)
{
    const float w = (float)v->frame_width, h = (float)v->frame_height;
    screen_box b = {w, h, 0.0f, 0.0f, 3e38f, -3e38f};
    for (int i = 0; i < 8; ++i) {
        const lmb_vec3 d = sub3(placed_at(p, box_corner(p->relief, i)), v->eye);
        const float z = -dot3(v->back, d), unit = v->kind == LMB_PERSPECTIVE ? maxf(z, 1e-20f) : 1.0f;
        const float x = (dot3(v->right, d) / (unit * v->half_width) * 0.5f + 0.5f) * w,
                    y = (0.5f - dot3(v->up, d) / (unit * v->half_height) * 0.5f) * h;
        b.left = minf(b.left, x - 1.0f);
        b.right = maxf(b.right, x + 1.0f);
        b.top = minf(b.top, y - 1.0f);
        b.bottom = maxf(b.bottom, y + 1.0f);
        b.near_m = minf(b.near_m, z);
        b.far_m = maxf(b.far_m, z);
    }
    if (v->kind == LMB_PERSPECTIVE && b.near_m <= v->near_m) { /* the box is around the eye */
        b = (screen_box){0.0f, 0.0f, w, h, b.near_m, b.far_m};
    }
    return b;
}

static int32_t to_tile(float px, int32_t side, int up)
{
    const int32_t at = (int32_t)clampf(px, 0.0f, (float)side), tiles = (side + LMB_TILE - 1) / LMB_TILE;
    const int32_t tile = up ? at / LMB_TILE + 1 : at / LMB_TILE;
    return tile < tiles ? tile : tiles;
}

static int is_seen(relief_seen *out, const relief_placed *p, const lmb_view *v)
{
    const screen_box b = box_of(p, v);
    if (!(b.right > 0.0f && b.bottom > 0.0f && b.left < (float)v->frame_width && b.top < (float)v->frame_height) ||
        (v->kind == LMB_PERSPECTIVE && b.far_m <= 0.0f)) {
        return 0;
    }
    out->placed = p;
    out->view = own_view(p, v);
    out->left = to_tile(b.left, v->frame_width, 0);
    out->top = to_tile(b.top, v->frame_height, 0);
    out->right = to_tile(b.right, v->frame_width, 1);
    out->bottom = to_tile(b.bottom, v->frame_height, 1);
    out->near_m = b.near_m;
    return 1;
}

/* Placements of one distance stay in the order of the list. */
static int compare_seen(const void *left, const void *right)
{
    const relief_seen *a = left, *b = right;
    if (a->near_m != b->near_m) {
        return a->near_m < b->near_m ? -1 : 1;
    }
    return (a->placed > b->placed) - (a->placed < b->placed);
}

uint32_t relief_crowd_see(relief_seen *out, const relief_crowd *crowd, const lmb_view *view)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < crowd->count; ++i) {
        count += (uint32_t)is_seen(&out[count], &crowd->placed[i], view);
    }
    qsort(out, count, sizeof *out, compare_seen);
    return count;
}

/* --- a band ------------------------------------------------------------------------------------------------------- */

size_t crowd_band_take(crowd_band *b, int32_t width)
{
    b->columns = (width + LMB_TILE - 1) / LMB_TILE;
    const size_t tiles = (size_t)b->columns * CROWD_ROWS * sizeof *b->tiles;
    b->surface_bytes = lmb_surface_bytes(LMB_DEPTH32F, b->columns * LMB_TILE, CROWD_ROWS * LMB_TILE);
    b->tiles = malloc(tiles);
    b->depth = malloc(b->surface_bytes);
    b->id = malloc(b->surface_bytes);
    return b->tiles != NULL && b->depth != NULL && b->id != NULL ? tiles + 2 * b->surface_bytes : 0;
}

void crowd_band_free(crowd_band *b)
{
    free(b->tiles);
    free(b->depth);
    free(b->id);
    memset(b, 0, sizeof *b);
}

/* Returns 1 if nearer surfaces hide the simple model, which encloses the complex one, in the whole tile. */
static int is_hidden(const crowd_tile *by, const lmb_tile *t, float scale)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (t->id[k] != 0 && !(by->depth[k] > 0.0f && by->depth[k] <= t->depth[k] * scale)) {
            return 0;
        }
    }
    return 1;
}

static lmb_vec3 plane_at(const float (*planes)[LMB_TILE_PIXELS], int k)
{
    return vec3(planes[0][k], planes[1][k], planes[2][k]);
}

static void put_at(float (*planes)[LMB_TILE_PIXELS], int k, lmb_vec3 v)
{
    planes[0][k] = v.x;
    planes[1][k] = v.y;
    planes[2][k] = v.z;
}

static void put_nearer(crowd_tile *out, const lmb_tile *t, const relief_placed *p)
{
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        const float depth = t->depth[k] * p->scale;
        if (t->id[k] == 0 || (out->depth[k] > 0.0f && out->depth[k] <= depth)) {
            continue;
        }
        put_at(out->position, k, placed_at(p, plane_at(t->position, k)));
        put_at(out->face, k, turned(p, plane_at(t->face, k)));
        put_at(out->normal, k, turned(p, plane_at(t->normal, k)));
        put_at(out->albedo, k, plane_at(t->albedo, k));
        out->depth[k] = depth;
    }
}

/* Draws one placement into the tile rows first .. past - 1 of a band that begins at row `origin`. */
static lmb_status draw_placed(crowd_band *b, const relief_seen *s, const lmb_kernels *kernels,
                              const lmb_relief_how *how, const int32_t rows[2], int32_t origin, lmb_relief_stats *stats)
{
    const lmb_relief *relief = s->placed->relief;
    const int32_t width = (s->right - s->left) * LMB_TILE, height = (rows[1] - rows[0]) * LMB_TILE;
    lmb_target window;
    lmb_scene simple;
    memset(&window, 0, sizeof window);
    window.x0 = s->left * LMB_TILE;
    window.y0 = rows[0] * LMB_TILE;
    const int32_t w = width < s->view.frame_width - window.x0 ? width : s->view.frame_width - window.x0,
                  h = height < s->view.frame_height - window.y0 ? height : s->view.frame_height - window.y0;
    lmb_surface_init(&window.depth, LMB_DEPTH32F, w, h, b->depth, b->surface_bytes);
    lmb_surface_init(&window.id, LMB_ID32, w, h, b->id, b->surface_bytes);
    lmb_surface_clear(&window.depth);
    lmb_surface_clear(&window.id);
    lmb_relief_scene(&simple, relief);
    lmb_status status = lmb_draw(&window, kernels, &s->view, &simple, 1, lmb_scene_triangles(&simple), 0, NULL);
    for (int32_t y = rows[0]; y < rows[1]; ++y) {
        for (int32_t x = s->left; x < s->right && status == LMB_OK; ++x) {
            crowd_tile *to = &b->tiles[(size_t)(y - origin) * (size_t)b->columns + (size_t)x];
            status = lmb_resolve_tile(&b->tile, kernels, &s->view, &simple, &window, x * LMB_TILE, y * LMB_TILE);
            if (status != LMB_OK || b->tile.hits == 0 || is_hidden(to, &b->tile, s->placed->scale)) {
                continue;
            }
            status = lmb_relief_tile(&b->tile, kernels, relief, &s->view, how, stats);
            put_nearer(to, &b->tile, s->placed);
        }
    }
    return status;
}

lmb_status crowd_band_draw(crowd_band *b, const relief_seen *seen, uint32_t count, const lmb_view *view,
                           const lmb_kernels *kernels, const lmb_relief_how *how, int32_t first, int32_t past,
                           lmb_relief_stats *stats)
{
    lmb_status status = view->frame_width <= b->columns * LMB_TILE && past - first <= CROWD_ROWS ? LMB_OK : LMB_ERR_ARG;
    for (int32_t i = 0; i < b->columns * (past - first) && status == LMB_OK; ++i) {
        memset(b->tiles[i].depth, 0, sizeof b->tiles[i].depth);
    }
    for (uint32_t i = 0; i < count && status == LMB_OK; ++i) {
        const int32_t rows[2] = {seen[i].top > first ? seen[i].top : first,
                                 seen[i].bottom < past ? seen[i].bottom : past};
        if (rows[0] < rows[1]) {
            status = draw_placed(b, &seen[i], kernels, how, rows, first, stats);
        }
    }
    return status;
}

void crowd_band_tile(lmb_tile *out, const crowd_band *b, int32_t column, int32_t row, int32_t x, int32_t y)
{
    const crowd_tile *from = &b->tiles[(size_t)row * (size_t)b->columns + (size_t)column];
    memset(out, 0, sizeof *out);
    out->x = x;
    out->y = y;
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (from->depth[k] > 0.0f) {
            for (int c = 0; c < 3; ++c) {
                out->position[c][k] = from->position[c][k];
                out->face[c][k] = from->face[c][k];
                out->normal[c][k] = from->normal[c][k];
                out->albedo[c][k] = from->albedo[c][k];
            }
            out->depth[k] = from->depth[k];
            out->id[k] = LMB_MAX_TRIANGLES;
            ++out->hits;
        }
    }
}
