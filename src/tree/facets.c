/* facets.c: the parts of a texel in which several surfaces show. Layer 6.                               [V15]
 *
 * A texel of the tree represents a block of the shadow map's pixels and has one plane. On round objects, at silhouettes
 * and in narrow gaps the block shows several. Near receivers get light from each triangle: from the triangle's part of
 * the texel's cell, clipped at concave edges. If something hides more of that part, from the runs of pixels that show
 * it. */
#include "facets.h"

#include <string.h>

#include "../bounce/polygon.h"
#include "../direct/footprint.h"
#include "../raster/target.h"
#include "../raster/tile.h"
#include "piece.h"

#if LMB_FACETS

#define MAX_HIDDEN_ROWS 1.0f /* rows of pixels: if more of a part does not show, something hides it */
#define MAX_SMALL_SHARE 0.5f /* of a cell: a triangle that covers less is small */
#define SPECK_SHARE 0.5f /* of the pixels that show a triangle: if it covers less, it represents others, too */
#define SNAPPED (1.0f / 64.0f) /* of a part: a snapped corner moves a pixel's middle past an edge by less */
#define STEEP_FACET 0.35f /* cosine to the light: at a sharp edge, steeper planes reach far past their triangles */

/* --- at the tree's building --------------------------------------------------------------------------------------- */

static int in_plane(lmb_vec3 normal, lmb_vec3 other, lmb_vec3 between)
{
    return dot3(normal, other) > 0.9999f && absf(dot3(normal, between)) <= 1e-3f * length3(between);
}

static int absi(int a) { return a < 0 ? -a : a; }

/* 1 if two pixels are no farther apart than on one surface. */
static int go_on(const lmb_vec3 *reach, lmb_vec3 between, int steps)
{
    const float far = 1.5f * (float)steps * (length3(reach[0]) + length3(reach[1]));
    return dot3(between, between) <= far * far;
}

void lmb_facets_mark(lmb_texel *inout, const lmb_tile *t, int own, int first, int32_t each, const lmb_view *v,
                     int32_t size, int32_t tests)
{
    const lmb_vec3 normal = tile_vec(t->face, own), at = tile_vec(t->position, own);
    const lmb_vec3 ray = facets_extent_of(inout, v, size).ray;
    float cosine = 1.0f, nearest = 0.0f, farthest = 0.0f;
    int several = 0, other = -1;
    lmb_vec3 own_reach[2];
    footprint_sides(&own_reach[0], &own_reach[1], v, size * each, at, normal);
    for (int i = 0; i < each * each; ++i) {
        const int k = first + i / each * LMB_TILE + i % each;
        if (t->id[k] == 0) {
            continue;
        }
        const lmb_vec3 n = tile_vec(t->face, k), p = tile_vec(t->position, k);
        lmb_vec3 reach[2];
        footprint_sides(&reach[0], &reach[1], v, size * each, p, n);
        const float before = dot3(ray, sub3(p, inout->position));
        const float more = 0.5f * (absf(dot3(ray, reach[0])) + absf(dot3(ray, reach[1])));
        nearest = maxf(nearest, before + more);
        farthest = minf(farthest, before - more);
        if (t->id[k] == t->id[own] || in_plane(normal, n, sub3(p, at))) {
            continue;
        }
        const int steps = absi(k % LMB_TILE - own % LMB_TILE) + absi(k / LMB_TILE - own / LMB_TILE);
        const lmb_vec3 *longer = length3(reach[0]) + length3(reach[1]) > length3(own_reach[0]) + length3(own_reach[1])
                                     ? reach : own_reach;
        const int steep = tests && minf(absf(dot3(ray, normal)), absf(dot3(ray, n))) < STEEP_FACET;
        several |= steep || dot3(normal, n) >= TILE_COS_25 || !go_on(longer, sub3(p, at), steps) ||
                   (other >= 0 && !in_plane(tile_vec(t->face, other), n, sub3(p, tile_vec(t->position, other))));
        other = k;
        cosine = minf(cosine, dot3(normal, n));
    }
    if (several) {
        inout->side[0] = SIDE_SEVERAL;
        inout->side[1] = (uint8_t)(127.0f * maxf(cosine, -1.0f) + 127.0f);
        inout->side[2] = (uint8_t)own;
        inout->share = nearest - farthest;
        inout->side[3] = (uint8_t)(255.0f * nearest / maxf(inout->share, 1e-18f));
    }
}

/* --- at the gather ------------------------------------------------------------------------------------------------ */

/* Keeps the part of a polygon in front of a plane. */
static int keep_before(lmb_vec3 *inout, int corners, lmb_vec3 on, lmb_vec3 normal)
{
    lmb_vec3 out[POLYGON_CORNERS + 1];
    for (int i = 0; i < corners; ++i) {
        inout[i] = sub3(inout[i], on);
    }
    corners = mini(polygon_clip(out, inout, corners, normal), POLYGON_CORNERS);
    for (int i = 0; i < corners; ++i) {
        inout[i] = add3(out[i], on);
    }
    return corners;
}

/* Keeps what lies on the inner side of one border of the map, through the place `s` of the axis. */
static int keep_inside(lmb_vec3 *inout, int corners, const lmb_view *v, lmb_vec3 axis, float s, float sign)
{
    const int is_cone = v->kind == LMB_PERSPECTIVE;
    return keep_before(inout, corners, is_cone ? vec3(0, 0, 0) : mul3(axis, s),
                       mul3(is_cone ? add3(axis, mul3(v->back, s)) : axis, sign));
}

/* The polygon's area and middle. */
static void set_middle(lmb_facet *out)
{
    const float share = 1.0f / (float)maxi(out->corners, 1);
    lmb_vec3 twice = vec3(0, 0, 0);
    out->middle = vec3(0, 0, 0);
    for (int i = 0; i < out->corners; ++i) {
        out->middle = add3(out->middle, mul3(out->corner[i], share));
    }
    for (int i = 1; i + 1 < out->corners; ++i) {
        twice = add3(twice, cross3(sub3(out->corner[i], out->corner[0]), sub3(out->corner[i + 1], out->corner[0])));
    }
    out->area = 0.5f * length3(twice);
}

/* The part of a triangle in a rectangle of the block's pixels. */
static void cut_out(lmb_facet *out, const lmb_facets *f, const lmb_triangle *t, int x0, int y0, int x1, int y1)
{
    const lmb_view *v = &f->tree->view[f->at.face];
    const float pixels = (float)(f->tree->size * f->each), wide = 2.0f * v->half_width / pixels,
                high = 2.0f * v->half_height / pixels;
    const float left = (float)(f->at.x * f->each) - 0.5f * pixels, top = 0.5f * pixels - (float)(f->at.y * f->each);
    int n = 3;
    for (int i = 0; i < 3; ++i) {
        out->corner[i] = sub3(t->corner[i], v->eye);
    }
    n = keep_inside(out->corner, n, v, v->right, (left + (float)x0) * wide, 1.0f);
    n = keep_inside(out->corner, n, v, v->right, (left + (float)x1) * wide, -1.0f);
    n = keep_inside(out->corner, n, v, v->up, (top - (float)y1) * high, 1.0f);
    n = keep_inside(out->corner, n, v, v->up, (top - (float)y0) * high, -1.0f);
    out->corners = n;
    for (int i = 0; i < n; ++i) {
        out->corner[i] = add3(out->corner[i], v->eye);
    }
    set_middle(out);
}

/* The place of pixel k of the block on a surface. */
static lmb_vec3 place_of_corner(const lmb_facets *f, int s, int k)
{
    const lmb_view *v = &f->tree->view[f->at.face];
    const float size = (float)(f->tree->size * f->each);
    const float x = (float)(2 * (f->at.x * f->each + k % f->each) + 1) / size - 1.0f,
                y = 1.0f - (float)(2 * (f->at.y * f->each + k / f->each) + 1) / size;
    return footprint_over(v, f->surface[s].on, f->surface[s].normal, x * v->half_width, y * v->half_height);
}

static float height_over(const lmb_facets *f, int s, lmb_vec3 at)
{
    return dot3(f->surface[s].normal, sub3(at, f->surface[s].on));
}

/* Are the middles of surface `of` in these pixels in front of surface s? They may lie `past` m behind it. */
static int are_before(const lmb_facets *f, int of, uint64_t pixels, int s, float past)
{
    int before = 1;
    for (; pixels != 0 && before; pixels &= pixels - 1) {
        before = height_over(f, s, place_of_corner(f, of, lowest_bit_64(pixels))) > -past;
    }
    return before;
}

/* Where two surfaces meet in a concave edge, each ends at the other one's plane. Triangles in one plane do not end
 * at each other: rounding decides which of them is in front. pixels: those that show the part. */
static void clip_by_others(lmb_facet *inout, const lmb_facets *f, int s, uint64_t pixels)
{
    for (int o = 0; o < f->surfaces; ++o) {
        const int is_same = in_plane(f->surface[s].normal, f->surface[o].normal,
                                     sub3(f->surface[o].on, f->surface[s].on));
        float low = 0.0f, high = 0.0f;
        for (int i = 0; i < inout->corners && !is_same; ++i) {
            const float height = height_over(f, o, inout->corner[i]);
            low = minf(low, height);
            high = maxf(high, height);
        }
        const float past = SNAPPED * (high - low);
        if (low < 0.0f && are_before(f, s, pixels, o, past) &&
            are_before(f, o, f->surface[o].pixels, s, past)) {
            inout->corners = keep_before(inout->corner, inout->corners, f->surface[o].on, f->surface[o].normal);
        }
    }
    set_middle(inout);
}

/* Turns the normal and the corners towards the light. */
static void turn_to_light(lmb_facet *out, const lmb_view *v)
{
    const lmb_vec3 to = v->kind == LMB_PERSPECTIVE ? sub3(v->eye, out->middle) : v->back;
    if (dot3(out->normal, to) < 0.0f) {
        out->normal = mul3(out->normal, -1.0f);
        for (int i = 0; i < out->corners / 2; ++i) {
            const lmb_vec3 other = out->corner[out->corners - 1 - i];
            out->corner[out->corners - 1 - i] = out->corner[i];
            out->corner[i] = other;
        }
    }
}

/* 1 if textures or vertex colours change the albedo within a triangle. */
static int varies(const lmb_scene *scene, const lmb_material *m, uint32_t id)
{
    const lmb_instance *instance = lmb_instance_of(scene, id);
    return m->texture >= 0 || m->metal_map > 0 || (instance != NULL && scene->meshes[instance->mesh].colours != NULL);
}

static void albedo_of(float out[3], const lmb_facets *f, uint32_t id, lmb_vec3 at, float area)
{
    piece_source s;
    out[0] = out[1] = out[2] = 0.0f;
    if (lmb_source_open(&s, f->scene, id)) {
        lmb_source_albedo_at(out, &s, at, area);
    }
}

/* Sets the light per m2 of this facet of a triangle from the flux of the texel, in proportion to the albedo, times
 * `more`. */
static void set_flux(lmb_facet *out, const lmb_facets *f, const lmb_material *m, uint32_t id, float more)
{
    const lmb_texel *t = tree_texel(f->tree, f->at.face, f->at.x, f->at.y);
    const lmb_material *own = lmb_material_of(f->scene, f->own);
    float to[3] = {1.0f, 1.0f, 1.0f}, from[3] = {1.0f, 1.0f, 1.0f};
    if (own != NULL && (varies(f->scene, m, id) || varies(f->scene, own, f->own))) {
        const float pixels = (float)(f->each * f->each);
        albedo_of(to, f, id, out->middle, out->area);
        albedo_of(from, f, f->own, t->position, 1.0f / (out->per_area * pixels));
    } else if (own != NULL && own != m) {
        memcpy(to, m->albedo, sizeof to);
        memcpy(from, own->albedo, sizeof from);
    }
    for (int c = 0; c < 3; ++c) {
        out->flux[c] = t->flux[c] * minf(to[c] / maxf(from[c], 1e-3f), 1e3f) * out->per_area * more;
    }
}

/* The whole part of a triangle in the texel's cell, without the light; 0: it has none. */
static int whole_part(lmb_facet *out, lmb_triangle *t, const lmb_facets *f, uint32_t id)
{
    lmb_vec3 u, v;
    float area;
    if (!lmb_triangle_fetch(t, f->scene, id) || !lmb_triangle_shape(&out->normal, &area, t)) {
        return 0;
    }
    cut_out(out, f, t, 0, 0, f->each, f->each);
    if (out->corners < 3) {
        return 0;
    }
    turn_to_light(out, &f->tree->view[f->at.face]);
    footprint_sides(&u, &v, &f->tree->view[f->at.face], f->tree->size, out->middle, out->normal);
    out->per_area = 1.0f / length3(cross3(u, v));
    return 1;
}

/* Lists the surfaces. The map's pixels miss triangles that are finer. Specks fill their pixels; the other small ones
 * that show send the light of those that are missed: the factor is the area of the pixels in which small ones show,
 * divided by the area that these cover. */
static void list_surfaces(lmb_facets *f)
{
    const int pixels = f->each * f->each;
    const float per_pixel = 1.0f / (float)pixels;
    const lmb_texel *texel = tree_texel(f->tree, f->at.face, f->at.x, f->at.y);
    const lmb_vec3 ray = facets_extent_of(texel, &f->tree->view[f->at.face], f->tree->size).ray;
    float covered = 0.0f, shown = 0.0f;
    uint64_t done = 0;
    f->surfaces = 0;
    for (int k = 0; k < pixels; ++k) {
        lmb_facet part;
        lmb_triangle t;
        uint64_t own = 0;
        if (f->id[k] == 0 || (done >> k & 1u) != 0) {
            continue;
        }
        for (int i = k; i < pixels; ++i) {
            own |= (uint64_t)(f->id[i] == f->id[k]) << i;
        }
        done |= own;
        if (whole_part(&part, &t, f, f->id[k])) {
            lmb_facet_surface *s = &f->surface[f->surfaces++];
            const float share = part.area * part.per_area;
            s->normal = part.normal;
            s->on = t.corner[0];
            s->pixels = own;
            s->id = f->id[k];
            const float here = (float)count_bits_64(own) * per_pixel;
            s->is_speck = share < SPECK_SHARE * here && absf(dot3(ray, part.normal)) > STEEP_FACET;
            if (share < MAX_SMALL_SHARE && !s->is_speck) {
                covered += share;
                shown += here;
            }
        }
    }
    f->more = covered > 0.0f ? maxf(shown / covered, 1.0f) : 1.0f;
}

/* 1 if something hides more of the part than a row of pixels. */
static int lacks_pixels(const lmb_facet *part, const lmb_facets *f, uint64_t pixels)
{
    const float shown = (float)count_bits_64(pixels) / (float)(f->each * f->each);
    return part->area * part->per_area - shown > MAX_HIDDEN_ROWS / (float)f->each;
}

void lmb_facets_open(lmb_facets *out, const lmb_tree *tree, const lmb_scene *scene, lmb_node_ref at)
{
    const lmb_target *shown = &tree_shown(tree)[at.face];
    const int32_t each = shown->id.width / tree->size, x = at.x * each, y = at.y * each;
    const lmb_fill_tile t = lmb_target_tile(shown, x / LMB_TILE, y / LMB_TILE);
    out->tree = tree;
    out->scene = scene;
    out->at = at;
    out->each = each;
    for (int i = 0; i < each * each; ++i) {
        const int32_t from = (y % LMB_TILE + i / each) * t.id_step + x % LMB_TILE + i % each;
        out->id[i] = t.id_format == LMB_ID16 ? ((const uint16_t *)t.id)[from] : ((const uint32_t *)t.id)[from];
    }
    const int own = tree_texel(tree, at.face, at.x, at.y)->side[2];
    out->own = out->id[(own / LMB_TILE - y % LMB_TILE) * each + own % LMB_TILE - x % LMB_TILE];
    list_surfaces(out);
    out->at_surface = 0;
    out->left = out->surfaces > 0 ? out->surface[0].pixels : 0;
}

/* Pixels x0 .. x1 - 1 of a row, in the plane of a speck: neighbours that no pixel shows continue it. Returns 0 if the
 * plane does not extend that far. */
static int spread_speck(lmb_facet *out, const lmb_facets *f, int x0, int y, int x1)
{
    const lmb_view *v = &f->tree->view[f->at.face];
    const float size = 0.5f * (float)(f->tree->size * f->each);
    const lmb_facet_surface *s = &f->surface[f->at_surface];
    for (int i = 0; i < 4; ++i) {
        const float x = (float)(f->at.x * f->each + (i == 1 || i == 2 ? x1 : x0)) / size - 1.0f,
                    up = 1.0f - (float)(f->at.y * f->each + y + (i < 2)) / size;
        out->corner[i] = footprint_over(v, s->on, s->normal, x * v->half_width, up * v->half_height);
        if (!is_place(out->corner[i])) {
            return 0;
        }
    }
    out->normal = s->normal;
    out->corners = 4;
    set_middle(out);
    return 1;
}

/* Cuts the part to the next run of pixels that show it. */
static void cut_to_run(lmb_facet *inout, lmb_facets *f, const lmb_triangle *t)
{
    const int32_t each = f->each;
    const int k = lowest_bit_64(f->left);
    int past = k;
    while (past % each + 1 < each && (f->left >> (past + 1) & 1u)) {
        ++past;
    }
    const uint64_t run = ((uint64_t)2 << past) - ((uint64_t)1 << k);
    float area;
    lmb_triangle_shape(&inout->normal, &area, t);
    if (!f->surface[f->at_surface].is_speck || !spread_speck(inout, f, k % each, k / each, past % each + 1)) {
        cut_out(inout, f, t, k % each, k / each, past % each + 1, k / each + 1);
    }
    turn_to_light(inout, &f->tree->view[f->at.face]);
    clip_by_others(inout, f, f->at_surface, run);
    f->left &= ~run;
}

/* The whole part of the surface, or the next run of pixels where something hides the rest. */
static void next_part(lmb_facet *out, lmb_facets *f)
{
    const lmb_facet_surface *s = &f->surface[f->at_surface];
    lmb_triangle t;
    whole_part(out, &t, f, s->id);
    const float more = out->area * out->per_area < MAX_SMALL_SHARE && !s->is_speck ? f->more : 1.0f;
    if (f->left == s->pixels) {
        clip_by_others(out, f, f->at_surface, s->pixels);
    }
    if (s->is_speck || f->left != s->pixels || lacks_pixels(out, f, s->pixels)) {
        cut_to_run(out, f, &t);
    } else {
        f->left = 0;
    }
    if (out->corners >= 3) {
        set_flux(out, f, t.material, s->id, more);
    }
}

int lmb_facets_next(lmb_facet *out, lmb_facets *f)
{
    do {
        while (f->left == 0) {
            if (++f->at_surface >= f->surfaces) {
                return 0;
            }
            f->left = f->surface[f->at_surface].pixels;
        }
        next_part(out, f);
    } while (out->corners < 3);
    return 1;
}

#endif
