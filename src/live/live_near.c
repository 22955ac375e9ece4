/* live_near.c: refines near nodes: a leaf's first points, a point's texels, parts of a texel. Layer 5.          [ours]
 *
 * A first point represents a block of texels. Near a receiver the block's texels are used, each where the map sampled
 * it; still nearer, parts of each texel. A part lies off the texel's middle, where the map has no sample, so it stays
 * on the triangle and does not move towards a neighbour with another triangle. */
#include "live_part.h"

#include <lambent/elements.h>

#include "../lane/kernels.h"
#include "../raster/triangle.h"

#if LMB_LIVE

enum {
    DEEPEST = LMB_LIVE_SMALL ? 1 : 3, /* divisions by 4 of a block's side, down to 1/16 of a texel, or to a texel */
    PART_BITS = 10
};

/* --- places ------------------------------------------------------------------------------------------------------- */

const lmb_live_facet *lmb_live_facet_of(lmb_live_facet *known, uint32_t many, const lmb_scene *scene,
                                        const lmb_view *view, uint32_t face, uint32_t id)
{
    lmb_live_facet *p = &known[id % many];
    lmb_triangle t;
    float area;
    if (p->id == id && p->face == face) {
        return p;
    }
    p->id = 0;
    if (!lmb_triangle_fetch(&t, scene, id) || !lmb_triangle_shape(&p->normal, &area, &t)) {
        return NULL;
    }
    const lmb_vec3 u = sub3(t.corner[1], t.corner[0]), v = sub3(t.corner[2], t.corner[0]), n = cross3(u, v);
    const float n2 = dot3(n, n), per = n2 > 1e-30f ? 1.0f / n2 : 0.0f;
    const lmb_vec3 to_light = view->kind == LMB_PERSPECTIVE ? sub3(view->eye, t.corner[0]) : view->back;
    p->normal = dot3(p->normal, to_light) < 0.0f ? mul3(p->normal, -1.0f) : p->normal;
    p->corner = t.corner[0];
    p->side[0] = u;
    p->side[1] = v;
    p->along[0] = mul3(cross3(v, n), per);
    p->along[1] = mul3(cross3(n, u), per);
    p->id = id;
    p->face = face;
    return p;
}

int lmb_live_place(lmb_vec3 *out, const lmb_live_facet *p, const lmb_view *view, float sx, float sy)
{
    const lmb_vec3 at = footprint_over(view, p->corner, p->normal, sx, sy), from = sub3(at, p->corner);
    float b1 = dot3(p->along[0], from), b2 = dot3(p->along[1], from);
    *out = at;
    if (!is_place(at)) {
        return 0;
    }
    if (b1 < 0.0f || b2 < 0.0f || b1 + b2 > 1.0f) {
        b1 = maxf(b1, LIVE_INSIDE);
        b2 = maxf(b2, LIVE_INSIDE);
        const float over = b1 + b2 > 1.0f - LIVE_INSIDE ? (1.0f - LIVE_INSIDE) / (b1 + b2) : 1.0f;
        *out = add3(p->corner, add3(mul3(p->side[0], b1 * over), mul3(p->side[1], b2 * over)));
    }
    return 1;
}

/* --- near chunks -------------------------------------------------------------------------------------------------- */

/* Number of nodes that can still be stored. */
static int32_t room(const lmb_live_scratch *s)
{
    const int32_t cut = LMB_LIVE_CUT - s->count, near = LMB_LIVE_NEAR - s->near_count;
    return (cut < near ? cut : near) * LMB_LIVE_NODES + LMB_LIVE_NODES - s->near_lane;
}

/* Allocates the next node; call it only if `room` allows. */
static lmb_live_chunk *take(lmb_live_scratch *s, int *lane)
{
    if (s->near_lane == LMB_LIVE_NODES) {
        lmb_live_chunk *c = &s->near[LMB_LIVE_KEPT + s->near_count++];
        s->chunk[s->count] = c;
        s->asked[s->count++] = 0;
        live_blank(c);
        s->near_lane = 0;
    }
    *lane = s->near_lane++;
    s->asked[s->count - 1] |= (uint16_t)(1u << *lane);
    return &s->near[LMB_LIVE_KEPT + s->near_count - 1];
}

static uint32_t part_of(uint32_t level, uint32_t x, uint32_t y) { return (level << PART_BITS | x) << PART_BITS | y; }

/* A number of a point's part that does not depend on other points. */
static uint32_t part_number(const lmb_live_point *p, uint32_t part)
{
    return live_hash(live_element_of(p), p->face, part);
}

/* Light of later bounces is smooth and a small part of the total. With half the radius, the errors of Cornell and the
 * corridor change by .003 and .001, and samples take a third of the time. */
#define SOFT 0.25f

float lmb_live_softness(const lmb_live *live, const lmb_live_point *p)
{
    const float *glow = p->face == LMB_LIVE_ELEMENT ? live->element[live_element_of(p)].emission : NULL;
    return glow != NULL && glow[0] + glow[1] + glow[2] <= 0.0f ? SOFT : 1.0f;
}

float lmb_live_reach2(const lmb_live *live, const lmb_live_point *p)
{
    return p->face == LMB_LIVE_ELEMENT ? maxf(p->area, live->element[live_element_of(p)].reach2) : p->area;
}

int lmb_live_is_whole(const lmb_live *live, const lmb_live_point *p)
{
    return p->face == LMB_LIVE_ELEMENT && !(live->element[live_element_of(p)].reach2 > 0.0f);
}

/* Stores the points of a leaf. */
static void put_points(lmb_live_scratch *s, const lmb_live *live, uint32_t first, uint32_t count)
{
    for (uint32_t k = first; k < first + count; ++k) {
        const lmb_live_point *p = &live->sorted[k];
        int i;
        lmb_live_chunk *c = take(s, &i);
        const int whole = lmb_live_is_whole(live, p);
        const live_light light = live_light_of(p->flux);
        const float disc = maxf((whole ? 1.0f : LIVE_DISC) * p->area, 1e-30f);
        live_put(c, i, p->position, p->normal, &light, disc, p->position, p->normal, p->id);
        c->radius2[i] = lmb_live_reach2(live, p) * lmb_live_softness(live, p);
        c->first[i] = k;
        c->count[i] = whole ? 0 : LMB_LIVE_LEAF | 1u;
        c->threshold[i] = live_threshold(part_number(p, 0), 0);
        s->part[LMB_LIVE_KEPT + s->near_count - 1][i] = part_of(0, 0, 0);
    }
}

/* --- parts of a point --------------------------------------------------------------------------------------------- */

/* A face, and cached facets. */
typedef struct live_look {
    const lmb_kernels *kernels;
    const lmb_live *live;
    const lmb_live_face *face;
    lmb_live_facet *known;
} live_look;

static const lmb_live_facet *facet_of(const live_look *l, uint32_t id)
{
    return lmb_live_facet_of(l->known, LMB_LIVE_FACETS, l->live->scene, &l->face->view,
                             (uint32_t)(l->face - l->live->face), id);
}

/* Do two triangles lie in one plane? */
static int goes_on(live_look *l, uint32_t id, uint32_t other)
{
    const lmb_live_facet *a = other != 0 ? facet_of(l, id) : NULL;
    if (a == NULL) {
        return 0;
    }
    const lmb_live_facet own = *a, *b = facet_of(l, other);
    if (b == NULL) {
        return 0;
    }
    const lmb_vec3 to = sub3(b->corner, own.corner), side = b->side[0];
    const float flat = 1e-8f * (dot3(to, to) + dot3(side, side)), lift = dot3(own.normal, to);
    return dot3(own.normal, b->normal) > 0.99999f && lift * lift <= flat;
}

/* Offset from a texel's middle: `off` if the neighbour on that side shows the same plane, else 0. */
static float towards(live_look *l, int32_t x, int32_t y, uint32_t id, float off)
{
    const lmb_live_face *f = l->face;
    const uint32_t other = x >= 0 && y >= 0 && x < f->size && y < f->size ? live_id(&f->id, x, y) : 0;
    return other == id || goes_on(l, id, other) ? off : 0.0f;
}

/* The sixteen parts of a part. */
typedef struct live_parts {
    lmb_live_spots at;
    uint32_t id[LMB_LIVE_NODES], part[LMB_LIVE_NODES];
    float over[LMB_LIVE_NODES]; /* number of parts at this position, unless they move towards a neighbour */
    uint32_t shown; /* mask of those that show a surface */
} live_parts;

enum { PARTS_SIDE = 4 };

/* Middles of four parts side by side along an axis of the map. */
typedef struct part_steps {
    int32_t texel[PARTS_SIDE];
    float off[PARTS_SIDE]; /* texels from a texel's middle */
} part_steps;

/* first: the first part of a grid in a block that starts at texel `from`. `wide`: a part's side, texels. */
static void set_part_steps(part_steps *out, int32_t from, uint32_t first, float wide, int32_t size)
{
    for (uint32_t i = 0; i < PARTS_SIDE; ++i) {
        const float at = (float)from + ((float)(first + i) + 0.5f) * wide;
        out->texel[i] = clampi((int32_t)at, 0, size - 1);
        out->off[i] = wide >= 1.0f ? 0.0f : at - ((float)out->texel[i] + 0.5f);
    }
}

/* Do the texels of sixteen parts, and the texels around them, all show triangle `id`? */
static int are_parts_amid(const lmb_live_face *f, const part_steps *x, const part_steps *y, uint32_t id)
{
    const int32_t left = x->texel[0] - 1, right = x->texel[PARTS_SIDE - 1] + 1, top = y->texel[0] - 1,
                  low = y->texel[PARTS_SIDE - 1] + 1;
    int amid = id != 0 && left >= 0 && top >= 0 && right < f->size && low < f->size;
    for (int32_t v = top; v <= low && amid; ++v) {
        for (int32_t u = left; u <= right && amid; ++u) {
            amid = live_id(&f->id, u, v) == id;
        }
    }
    return amid;
}

/* Moves part i towards the texel's middle if it has a neighbour with another plane. `wide`: the part's side, texels. */
static void move_part(live_parts *p, float place[2], live_look *l, int i, const part_steps *x, const part_steps *y,
                      float wide)
{
    const int32_t tx = x->texel[i % PARTS_SIDE], ty = y->texel[i / PARTS_SIDE];
    float du = x->off[i % PARTS_SIDE], dv = y->off[i / PARTS_SIDE];
    const int32_t nx = du < 0.0f ? tx - 1 : tx + 1, ny = dv < 0.0f ? ty - 1 : ty + 1;
    if (p->id[i] != 0) {
        du = towards(l, nx, ty, p->id[i], du);
        dv = towards(l, tx, ny, p->id[i], dv);
        dv = du != 0.0f && dv != 0.0f ? towards(l, nx, ny, p->id[i], dv) : dv;
        p->over[i] = (du == 0.0f ? 0.5f / wide : 1.0f) * (dv == 0.0f ? 0.5f / wide : 1.0f);
    }
    place[0] = (float)tx + 0.5f + du;
    place[1] = (float)ty + 0.5f + dv;
}

/* Sets the ids of the texels in which sixteen parts lie. Returns 1 if all of them are the same. */
static int set_part_ids(uint32_t id[LMB_LIVE_NODES], const lmb_live_face *f, const part_steps *x, const part_steps *y)
{
    uint32_t differ = 0;
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        const int u = i % PARTS_SIDE, v = i / PARTS_SIDE;
        id[i] = v > 0 && y->texel[v] == y->texel[v - 1]   ? id[i - PARTS_SIDE]
                : u > 0 && x->texel[u] == x->texel[u - 1] ? id[i - 1]
                                                          : live_id(&f->id, x->texel[u], y->texel[v]);
        differ |= id[i] ^ id[0];
    }
    return differ == 0;
}

/* Sets places in the map, as view coordinates, and ids. Most parts lie amid texels of one triangle. */
static int place_parts(live_parts *out, live_look *l, const lmb_live_point *p, uint32_t x, uint32_t y, float wide)
{
    const lmb_live_face *f = l->face;
    const float per = 2.0f / (float)f->size;
    part_steps across, down;
    set_part_steps(&across, p->column * f->each, x, wide, f->size);
    set_part_steps(&down, p->row * f->each, y, wide, f->size);
    const int same = set_part_ids(out->id, f, &across, &down),
              stay = wide >= 1.0f || (same && are_parts_amid(f, &across, &down, out->id[0]));
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        out->over[i] = 1.0f;
    }
    if (stay) {
        float sx[PARTS_SIDE], sy[PARTS_SIDE];
        for (int i = 0; i < PARTS_SIDE; ++i) {
            sx[i] = (((float)across.texel[i] + 0.5f + across.off[i]) * per - 1.0f) * f->view.half_width;
            sy[i] = (1.0f - ((float)down.texel[i] + 0.5f + down.off[i]) * per) * f->view.half_height;
        }
        for (int i = 0; i < LMB_LIVE_NODES; ++i) {
            out->at.sx[i] = sx[i % PARTS_SIDE];
            out->at.sy[i] = sy[i / PARTS_SIDE];
        }
        return same;
    }
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        float place[2];
        move_part(out, place, l, i, &across, &down, wide);
        out->at.sx[i] = (place[0] * per - 1.0f) * f->view.half_width;
        out->at.sy[i] = (1.0f - place[1] * per) * f->view.half_height;
    }
    return same;
}

static void find_parts(live_parts *out, live_look *l, const lmb_live_point *p, uint32_t part)
{
    const lmb_live_face *f = l->face;
    const uint32_t level = (part >> 2 * PART_BITS) + 1, mask = (1u << PART_BITS) - 1,
                   x = (part >> PART_BITS & mask) * PARTS_SIDE, y = (part & mask) * PARTS_SIDE;
    uint32_t left = 0;
    memset(&out->at, 0, sizeof out->at);
    const int one = place_parts(out, l, p, x, y, (float)(f->each * p->wide) / (float)(1u << 2 * level));
    for (uint32_t i = 0; i < LMB_LIVE_NODES; ++i) {
        out->part[i] = part_of(level, x + i % PARTS_SIDE, y + i / PARTS_SIDE);
        left |= (uint32_t)(out->id[i] != 0) << i;
    }
    left &= level == 1 ? p->shows : 0xffffu;
    for (out->shown = 0; left != 0;) {
        const uint32_t id = out->id[lowest_bit(left)];
        const lmb_live_facet *on = facet_of(l, id);
        uint32_t same = 0;
        for (int i = 0; i < LMB_LIVE_NODES && !one; ++i) {
            same |= (uint32_t)(out->id[i] == id) << i;
        }
        same = one ? left : same & left;
        left &= ~same;
        if (on != NULL) {
            const lmb_live_surface plane = {&f->view, on->corner, on->normal, {on->side[0], on->side[1]},
                                          {on->along[0], on->along[1]}};
            out->shown |= l->kernels->live_places(&out->at, &plane, same);
        }
    }
}

/* Appends chunk k of `near`. */
static void append_chunk(lmb_live_scratch *s, int32_t k, uint32_t nodes)
{
    s->chunk[s->count] = &s->near[k];
    s->asked[s->count++] = (uint16_t)nodes;
    s->near_lane = LMB_LIVE_NODES;
    ++s->near_count;
}

#define NOT_KEPT (~(uint64_t)0)

/* The kept chunk of a point's part, or a place for it: *found is 0. If both places of a chunk hold chunks of the
 * current cut, it is not kept. */
static int32_t slot_of_part(int *found, const lmb_live_scratch *s, uint64_t key)
{
    const uint32_t h = live_hash((uint32_t)key, (uint32_t)(key >> 32), 1) % (LMB_LIVE_KEPT / 2) * 2;
    const uint32_t old = s->number - s->kept_for[h] >= s->number - s->kept_for[h + 1] ? h : h + 1;
    *found = s->keeps && (s->kept[h] == key || s->kept[h + 1] == key);
    if (*found) {
        return (int32_t)(s->kept[h] == key ? h : h + 1);
    }
    return s->keeps && s->kept_for[old] != s->number ? (int32_t)old : LMB_LIVE_KEPT + s->near_count;
}

/* Stores sixteen parts as chunk k. number: of the point. */
static void put_whole(lmb_live_scratch *s, int32_t k, const live_parts *p, uint32_t point, uint32_t number,
                      uint32_t count, const live_light *light, const float area[2])
{
    lmb_live_chunk *c = &s->near[k];
    memcpy(c->place, p->at.place, sizeof c->place);
    memcpy(c->normal, p->at.normal, sizeof c->normal);
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        c->area[i] = maxf(count != 0 ? area[0] : area[0] * p->over[i], 1e-30f);
        c->power[i] = light->power;
        c->radius2[i] = area[1];
        c->first[i] = point;
        c->count[i] = count;
        c->threshold[i] = live_threshold(number, p->part[i]);
        c->colour[0][i] = light->colour[0];
        c->colour[1][i] = light->colour[1];
        c->colour[2][i] = light->colour[2];
    }
    for (int i = 0; i < LMB_LIVE_NODES; ++i) {
        const lmb_live_target to = {{p->at.place[0][i], p->at.place[1][i], p->at.place[2][i]},
                                    {p->at.normal[0][i], p->at.normal[1][i], p->at.normal[2][i]},
                                    {light->colour[0], light->colour[1], light->colour[2]},
                                    p->id[i]};
        c->target[i] = to;
    }
    memcpy(s->part[k], p->part, sizeof p->part);
}

/* Stores the sixteen parts of a point's part. Returns 0 if none of them shows a surface. */
static int put_parts(lmb_live_scratch *s, live_look *l, uint32_t point, uint32_t part, const lmb_live_chunk *whole,
                     uint32_t lane)
{
    live_parts p;
    int found;
    const uint32_t level = (part >> 2 * PART_BITS) + 1;
    const uint64_t key = (uint64_t)point << 32 | part;
    const int32_t to = slot_of_part(&found, s, key);
    if (found) {
        s->kept_for[to] = s->number;
        append_chunk(s, to, s->kept_nodes[to]);
        return 1;
    }
    find_parts(&p, l, &l->live->sorted[point], part);
    const uint32_t count = count_bits_16(p.shown);
    const float share = count > 0 ? 1.0f / (float)count : 0.0f, power = whole->power[lane] * share,
                area = whole->radius2[lane] * share; /* of a point: the block's area */
    const float flux[3] = {whole->colour[0][lane] * power, whole->colour[1][lane] * power,
                           whole->colour[2][lane] * power};
    if (!(live_power(flux) > 0.0f)) {
        return 0;
    }
    const live_light light = live_light_of(flux);
    const uint32_t parts = level < DEEPEST ? LMB_LIVE_LEAF | 1u : 0;
    const float areas[2] = {level < DEEPEST ? LIVE_DISC * area : area, area};
    put_whole(s, to, &p, point, part_number(&l->live->sorted[point], level), parts, &light, areas);
    if (to < LMB_LIVE_KEPT) {
        s->kept[to] = key;
        s->kept_for[to] = s->number;
        s->kept_nodes[to] = (uint16_t)p.shown;
    }
    append_chunk(s, to, p.shown);
    return 1;
}

void lmb_live_forget(lmb_live_scratch *s)
{
    for (int i = 0; i < LMB_LIVE_KEPT; ++i) {
        s->kept[i] = NOT_KEPT;
        s->kept_for[i] = 0;
    }
    for (int i = 0; i < LMB_LIVE_FACETS; ++i) {
        s->facet[i].id = 0;
    }
    for (int i = 0; i < LMB_LIVE_KNOWN; ++i) {
        s->known[i].id = 0;
    }
    s->number = 0;
}

/* --- parts of an element ------------------------------------------------------------------------------------------ */

/* Replaces a triangle by one of the four similar triangles in it: at a corner, or the middle one. */
static void into_quarter(lmb_vec3 corner[3], uint32_t quarter)
{
    const lmb_vec3 m[3] = {mul3(add3(corner[1], corner[2]), 0.5f), mul3(add3(corner[2], corner[0]), 0.5f),
                           mul3(add3(corner[0], corner[1]), 0.5f)};
    if (quarter == 3) {
        memcpy(corner, m, sizeof m);
        return;
    }
    corner[(quarter + 1) % 3] = m[(quarter + 2) % 3];
    corner[(quarter + 2) % 3] = m[(quarter + 1) % 3];
}

/* Stores the sixteen parts of an element's part: a quarter's quarters. Each two bits of `part` select a quarter, the
 * last ones first. Returns 0 if the element has no shape. Segments go to the element's middle, where it receives light,
 * because the shape may continue behind a wall on the element. */
static int put_quarters(lmb_live_scratch *s, const lmb_live *live, uint32_t point, uint32_t part,
                        const lmb_live_chunk *whole, uint32_t lane)
{
    const lmb_live_point *p = &live->sorted[point];
    const uint32_t level = (part >> 2 * PART_BITS) + 1, way = part & ((1u << 2 * PART_BITS) - 1);
    const float share = 1.0f / LMB_LIVE_NODES, power = whole->power[lane] * share, area = whole->area[lane] / LIVE_DISC;
    const float flux[3] = {whole->colour[0][lane] * power, whole->colour[1][lane] * power,
                           whole->colour[2][lane] * power};
    lmb_vec3 own[3];
    if (lmb_live_is_whole(live, p) || !(live_power(flux) > 0.0f)) {
        return 0;
    }
    const live_light light = live_light_of(flux);
    memcpy(own, live->element[live_element_of(p)].corner, sizeof own);
    for (uint32_t k = 4 * (level - 1); k > 0; k -= 2) {
        into_quarter(own, way >> (k - 2) & 3u);
    }
    for (uint32_t k = 0; k < LMB_LIVE_NODES; ++k) {
        lmb_vec3 corner[3];
        int i;
        memcpy(corner, own, sizeof corner);
        into_quarter(corner, k >> 2);
        into_quarter(corner, k & 3u);
        const lmb_vec3 at = mul3(add3(add3(corner[0], corner[1]), corner[2]), 1.0f / 3.0f);
        lmb_live_chunk *c = take(s, &i);
        const float disc = level < DEEPEST ? LIVE_DISC * area * share : area * share;
        live_put(c, i, at, p->normal, &light, maxf(disc, 1e-30f), p->position, p->normal, p->id);
        c->radius2[i] = whole->radius2[lane] * share;
        c->first[i] = point;
        c->count[i] = level < DEEPEST ? LMB_LIVE_LEAF | 1u : 0;
        c->threshold[i] = live_threshold(part_number(p, level), way << 4 | k);
        s->part[LMB_LIVE_KEPT + s->near_count - 1][i] = level << 2 * PART_BITS | way << 4 | k;
    }
    return 1;
}

/* Selects a face. Returns 1. */
static int look_at(live_look *l, uint32_t face)
{
    l->face = &l->live->face[face];
    return 1;
}

/* Is a chunk of the cut one of the near chunks? */
static int is_near(const lmb_live_scratch *s, const lmb_live_chunk *c)
{
    return c >= s->near && c < s->near + LMB_LIVE_KEPT + LMB_LIVE_NEAR;
}

/* Stores the parts of a block or of an element. */
static int put_parts_of(lmb_live_scratch *s, live_look *l, uint32_t point, uint32_t part, const lmb_live_chunk *whole,
                        uint32_t lane)
{
    const uint32_t face = l->live->sorted[point].face;
    return face == LMB_LIVE_ELEMENT ? put_quarters(s, l->live, point, part, whole, lane)
                                    : look_at(l, face) && put_parts(s, l, point, part, whole, lane);
}

int lmb_live_come_near(lmb_live_scratch *s, const lmb_kernels *kernels, const lmb_live *live)
{
    const int32_t before = s->count, leaves = s->leaves;
    live_look l;
    if (leaves == 0) {
        return 0;
    }
    l.kernels = kernels;
    l.live = live;
    l.known = s->facet;
    s->near_lane = LMB_LIVE_NODES;
    for (int32_t n = 0; n < leaves; ++n) {
        const uint32_t k = s->leaf[n] / LMB_LIVE_NODES, i = s->leaf[n] % LMB_LIVE_NODES;
        const lmb_live_chunk *c = s->chunk[k];
        const uint32_t first = c->first[i], count = c->count[i] & ~LMB_LIVE_LEAF;
        if (room(s) < (int32_t)(count > 1 ? count : LMB_LIVE_NODES)) {
            s->is_full = 1;
        } else if (count > 1) {
            put_points(s, live, first, count);
            s->value[k][i] = 0.0f;
        } else if (put_parts_of(s, &l, first, is_near(s, c) ? s->part[c - s->near][i] : part_of(0, 0, 0), c, i)) {
            s->value[k][i] = 0.0f;
        }
    }
    s->leaves = 0;
    return s->count > before;
}

#endif
