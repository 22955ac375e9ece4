/* fixed_light.c: light at the visible vertices: the lamp's, and reflected light by links. Layer 8.
 *
 * Light is given as the radiosity of a white surface, in 1/65536 of the picture's white: at most MAX_LIGHT. */
#include <lambent/fixed.h>

#include "fixed_part.h"
#include "number.h"

enum { MAX_LIGHT = 1 << 26, FULL_WEIGHT = 32768, CELL_CORNERS = 8 };

/* The places around the lamp, with weights that sum to less than FULL_WEIGHT. */
typedef struct cell_around {
    uint32_t word[CELL_CORNERS], bit[CELL_CORNERS], weight[CELL_CORNERS];
    int count;
} cell_around;

/* The same for all receivers. */
typedef struct lamp_now {
    const lmb_fixed *s;
    const lmb_fixed_lamp *lamp;
    cell_around places;
    uint32_t colour[3]; /* 16 bits: intensity / 127, in 2^-bits */
    int32_t bits;
    uint32_t per_cone; /* 2^30 / (cos_inner - cos_outer); 0: a point light */
} lamp_now;

/* --- places ------------------------------------------------------------------------------------------------------- */

/* The cell that holds a coordinate, and the position in it, 0 .. 256. */
static int32_t cell_between(uint32_t *part, int32_t at, int32_t places, int32_t spacing)
{
    const int32_t free = zeros_above((uint32_t)spacing);
    const uint32_t per = reciprocal((uint32_t)spacing << free); /* 2^(62 - free) / spacing */
    int32_t off = within(at, 0, (places - 1) * spacing);
    int32_t cell = (int32_t)(high_of((uint32_t)off << 16, per) >> (30 - free)) >> 16;
    /* `off` has 15 bits: off by one at most */
    cell += (cell + 1) * spacing <= off;
    cell = maxi(mini(cell, places - 2), 0);
    off -= cell * spacing;
    *part = (uint32_t)mini((int32_t)(high_of((uint32_t)off << 17, per) >> (39 - free)), 256);
    return cell;
}

static int is_light_place(const lmb_fixed *s, uint32_t place)
{
    return (int)(s->valid[place >> 5] >> (place & 31u) & 1u);
}

NOINLINE void find_places(cell_around *out, const lmb_fixed *s, const int32_t at[3])
{
    uint32_t part[3], place[CELL_CORNERS] = {0}, weight[CELL_CORNERS] = {0}, sum = 0;
    int32_t cell[3];
    for (int i = 0; i < 3; ++i) {
        cell[i] = cell_between(&part[i], at[i] - s->first[i], s->places[i], s->spacing);
    }
    out->count = 0;
    for (int k = 0; k < CELL_CORNERS; ++k) {
        uint32_t own = 1, index = 0;
        for (int i = 2; i >= 0; --i) {
            const int up = k >> i & 1;
            own *= up ? part[i] : 256 - part[i];
            index = index * (uint32_t)s->places[i] + (uint32_t)mini(cell[i] + up, s->places[i] - 1);
        }
        own >>= 9; /* of 2^24 */
        if (own > 1 && is_light_place(s, index)) {
            place[out->count] = index;
            weight[out->count++] = own;
            sum += own;
        }
    }
    for (int k = 0; k < out->count; ++k) {
        const int32_t free = zeros_above(sum);
        out->word[k] = place[k] >> 5;
        out->bit[k] = place[k] & 31u;
        out->weight[k] = high_of(weight[k] * (FULL_WEIGHT - 1u), reciprocal(sum << free)) >> (30 - free);
    }
}

static uint32_t seen_of(const cell_around *a, const uint32_t *seen)
{
    uint32_t sum = 0;
    for (int k = 0; k < a->count; ++k) {
        if (seen[a->word[k]] >> a->bit[k] & 1u) {
            sum += a->weight[k];
        }
    }
    return sum;
}

/* --- direct light ------------------------------------------------------------------------------------------------- */

static void set_lamp(lamp_now *out, const lmb_fixed *s, const lmb_fixed_lamp *lamp)
{
    const int32_t width = lamp->cos_inner - lamp->cos_outer;
    uint32_t any = 1;
    out->s = s;
    out->lamp = lamp;
    find_places(&out->places, s, lamp->position);
    for (int c = 0; c < 3; ++c) {
        any |= lamp->intensity[c];
    }
    /* to 15 bits; 129 / 2^14 is 1 / 127.01 */
    const int32_t left = zeros_above(any) - 12;
    for (int c = 0; c < 3; ++c) {
        out->colour[c] = ((lamp->intensity[c] << left >> 5) * 129u) >> 7;
    }
    out->bits = left + 2;
    out->per_cone = 0;
    if (width > 0) {
        const int32_t free = zeros_above((uint32_t)width);
        out->per_cone = reciprocal((uint32_t)width << free) >> (32 - free);
    }
}

/* The lamp's cone fall-off by the cosine to the axis: smoothstep, 0 .. FULL_WEIGHT - 1. */
static uint32_t cone_of(const lamp_now *l, int32_t cosine)
{
    const int32_t over = cosine - l->lamp->cos_outer;
    if (over <= 0) {
        return 0;
    }
    if (cosine >= l->lamp->cos_inner) {
        return FULL_WEIGHT - 1;
    }
    const uint32_t t = ((uint32_t)over * l->per_cone) >> 15;
    return (((t * t) >> 15) * (3u * FULL_WEIGHT - 2u * t)) >> 15;
}

static void direct_at(uint32_t out[3], const lamp_now *l, const fixed_receiver *r, const uint32_t *seen)
{
    int32_t d[3];
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < 3; ++i) {
        d[i] = l->lamp->position[i] - r->at[i];
    }
    const int32_t along = d[0] * r->normal[0] + d[1] * r->normal[1] + d[2] * r->normal[2];
    if (along <= 0) {
        return;
    }
    const uint32_t part = seen_of(&l->places, seen);
    const uint32_t far2 = (uint32_t)(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (part == 0) {
        return;
    }
    /* to 2^28 .. 2^30: distances to 2^14 .. 2^15 */
    const int32_t k = (zeros_above(far2) - 2) >> 1;
    const uint32_t m = far2 << (2 * k), cube = inverse_cube(m);
    uint32_t e = (((uint32_t)along << k) >> 6) * cube;
    e = high_of(e, part << 17);
    if (l->per_cone != 0) {
        const int32_t *way = l->lamp->direction;
        const int32_t to = -(d[0] * way[0] + d[1] * way[1] + d[2] * way[2]) >> (14 - k);
        const uint32_t size = (uint32_t)(to < 0 ? -to : to), per = high_of(cube << 2, m << 2); /* 2^30 / distance */
        const int32_t cosine = (int32_t)((size * per) >> 16);
        e = high_of(e, cone_of(l, to < 0 ? -cosine : cosine) << 17);
    }
    /* at most 26, because k <= 14, units_log2 <= 16 and bits >= 2 */
    const int32_t up = 2 * (k + l->s->units_log2) - 32 - l->bits;
    for (int c = 0; c < 3; ++c) {
        const uint32_t v = high_of(e, l->colour[c] << 16);
        out[c] = up <= -32 ? 0 : up <= 0 ? v >> -up : v > (uint32_t)MAX_LIGHT >> up ? MAX_LIGHT : v << up;
        out[c] = out[c] > MAX_LIGHT ? MAX_LIGHT : out[c];
    }
}

/* --- reflected light ---------------------------------------------------------------------------------------------- */

/* v times an albedo, given as a square root in 1/255. */
static uint32_t reflected(uint32_t v, uint32_t root)
{
    const uint32_t albedo = root * root;
    v = v > MAX_LIGHT ? MAX_LIGHT : v;
    return high_of(v << 4, (albedo + (albedo >> 7)) << 12);
}

/* Light that elements send to a receiver, 1/65536 of white >> down. */
LOOP_APART void links_at(uint32_t out[3], const lmb_fixed *s, const uint16_t (*element)[4], uint32_t receiver,
                       int32_t down)
{
    const uint32_t *row = s->row + LMB_FIXED_ROW_WORDS * receiver, *link = s->link + (row[0] & 0xffffffu),
                   *past = link + (row[0] >> 25);
    uint32_t red = 0, green = 0, blue = 0;
    for (; link != past; ++link) {
        const uint32_t two = *link, w = two >> 8 & 255u, x = two >> 24;
        const uint16_t *a = element[two & 255u], *b = element[two >> 16 & 255u];
        red += w * a[0] + x * b[0];
        green += w * a[1] + x * b[1];
        blue += w * a[2] + x * b[2];
    }
    const int32_t up = maxi(down - 4, 0), less = maxi(4 - down, 0);
    out[0] = high_of(red, row[1]) << up >> less;
    out[1] = high_of(green, row[1]) << up >> less;
    out[2] = high_of(blue, row[1]) << up >> less;
}

static void set_receiver_sent(uint16_t out[4], const uint32_t light[3], const fixed_receiver *r, int32_t down)
{
    for (int c = 0; c < 3; ++c) {
        const uint32_t v = reflected(light[c], r->albedo[c]) >> down;
        out[c] = (uint16_t)(v > 65535u ? 65535u : v);
    }
    out[3] = 0;
}

/* Computes the total light that each element sends. Returns the number of bits that it is shifted down by. */
static int32_t solve_light(uint16_t (*sent)[4], const lmb_fixed_frame *f, const lamp_now *l)
{
    const lmb_fixed *s = f->scene;
    fixed_receiver r;
    uint32_t any = 1;
    for (uint32_t i = 0; i < s->elements; ++i) {
        fixed_receiver_at(&r, s, s->vertices + i);
        direct_at(f->direct[i], l, &r, s->seen + (size_t)s->place_words * (s->vertices + i));
        any |= f->direct[i][0] | f->direct[i][1] | f->direct[i][2];
    }
    /* headroom of a factor of 2 for further bounces */
    const int32_t down = maxi(17 - zeros_above(any), 0);
    for (int32_t bounce = 0; bounce < f->bounces; ++bounce) {
        for (uint32_t i = 0; i < s->elements; ++i) {
            uint32_t more[3] = {0, 0, 0};
            if (bounce > 0) {
                links_at(more, s, (const uint16_t(*)[4])sent, s->vertices + i, down);
            }
            for (int c = 0; c < 3; ++c) {
                more[c] += f->direct[i][c];
            }
            fixed_receiver_at(&r, s, s->vertices + i);
            set_receiver_sent(sent[i], more, &r, down);
        }
    }
    return down;
}

static void shade(lmb_fixed_vertex *out, const uint16_t (*sent)[4], int has_bounces, const lamp_now *l, uint32_t i,
                  int32_t down)
{
    const lmb_fixed *s = l->s;
    uint32_t e[3], more[3] = {0, 0, 0};
    fixed_receiver r;
    fixed_receiver_at(&r, s, i);
    direct_at(e, l, &r, s->seen + (size_t)s->place_words * i);
    if (has_bounces) {
        links_at(more, s, sent, i, down);
    }
    for (int c = 0; c < 3; ++c) {
        const uint32_t light = reflected(e[c] + more[c], r.albedo[c]);
        out->colour[c] = (uint8_t)within((int32_t)(srgb_of(light >> 2) + 127u) >> 8, FIXED_LEAST, FIXED_MOST);
    }
}

static int is_lamp(const lmb_fixed_lamp *l)
{
    int64_t length = 0;
    for (int i = 0; i < 3; ++i) {
        length += (int64_t)l->direction[i] * l->direction[i];
        if (l->position[i] < -LMB_FIXED_REACH || l->position[i] > LMB_FIXED_REACH || l->intensity[i] >= 1u << 20) {
            return 0;
        }
    }
    return length <= 16400 * 16400 && l->cos_inner >= l->cos_outer && l->cos_inner <= LMB_FIXED_ONE &&
           l->cos_outer >= -LMB_FIXED_ONE;
}

lmb_status lmb_fixed_light(lmb_fixed_frame *f)
{
    uint16_t sent[LMB_FIXED_MAX_ELEMENTS][4]; /* on the stack, which is usually the fastest memory */
    lamp_now l;
    if (f == NULL || f->scene == NULL || f->scene->receiver == NULL || f->vertex == NULL || f->direct == NULL ||
        f->bounces < 0 || f->bounces > 3 || !is_lamp(&f->lamp)) {
        return LMB_ERR_ARG;
    }
    f->ready_count = 0;
    set_lamp(&l, f->scene, &f->lamp);
    const int32_t down = f->bounces > 0 ? solve_light(sent, f, &l) : 0;
    for (uint32_t i = 0; i < f->scene->vertices; ++i) {
        if (f->vertex[i].flags & FIXED_USED) {
            shade(&f->vertex[i], (const uint16_t(*)[4])sent, f->bounces > 0, &l, i, down);
        }
    }
    return LMB_OK;
}
