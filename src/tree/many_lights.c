/* many_lights.c: sorts a stream of lights into a fixed number of world cells, with integer sums. Layer 6.    [V3]
 *
 * A cell holds sums, minima, maxima or best members of its lights, all in exact arithmetic. Merging is associative and
 * commutative, so a cell depends only on the set of lights in it. The side of cells is the smallest at which they fit.
 * It doubles only if the lights so far need more cells, and then all lights need them too, in any order. So the result
 * does not depend on the order. */
#include <lambent/many_lights.h>

#include <string.h>

#include "../base/light_kind.h"
#include "../base/poly.h"
#include "../base/vec.h"
#include "many_lights_cell.h"

#define MAX_CELLS (1u << 22)
#define AXIS_BITS 21 /* three axes fill a key */

/* Slots of the hash table: a power of two of at least twice the cells, so that probes stay short. */
static uint32_t slots_of(uint32_t cells)
{
    uint32_t n = 2;
    while (n < 2 * cells) {
        n *= 2;
    }
    return n;
}

/* A tree of n cells without single-child nodes has at most 2 n - 1 nodes. Kernels read up to 16 past the last. */
static uint32_t nodes_of_cells(uint32_t cells) { return 2 * cells; }
static uint32_t planes_of_cells(uint32_t cells) { return 2 * cells + 16; }

size_t lmb_many_lights_bytes(uint32_t cells)
{
    if (cells < 1 || cells > MAX_CELLS) {
        return 0;
    }
    return cells * sizeof(lmb_many_lights_cell) + nodes_of_cells(cells) * sizeof(lmb_many_lights_node) +
           (size_t)planes_of_cells(cells) * LMB_MANY_LIGHTS_PLANES * sizeof(float) + slots_of(cells) * sizeof(uint32_t);
}

static int is_light_box(lmb_vec3 low, lmb_vec3 high)
{
    return is_sane(low.x) && is_sane(low.y) && is_sane(low.z) && is_sane(high.x) && is_sane(high.y) &&
           is_sane(high.z) && low.x <= high.x && low.y <= high.y && low.z <= high.z;
}

/* The smallest power of two from max / 2^60 up: a sum may reach 4 max before it exceeds 2^62 quanta. */
static float quantum_of(float max)
{
    float q = 0x1p-120f;
    while (q < max * 0x1p-60f) {
        q *= 2.0f;
    }
    return q;
}

/* Alignment of a 64-bit number: 4 bytes on some targets, 8 on others. */
struct aligned {
    char before;
    uint64_t value;
};

lmb_status lmb_many_lights_init(lmb_many_lights *out, uint32_t cells, lmb_vec3 low, lmb_vec3 high, float max,
                                void *memory, size_t bytes)
{
    const lmb_vec3 side = sub3(high, low);
    const float longest = maxf(side.x, maxf(side.y, side.z));
    if (out == NULL || memory == NULL || lmb_many_lights_bytes(cells) == 0 || !is_light_box(low, high) ||
        !(max >= 0x1p-60f && max <= 0x1p+60f)) {
        return LMB_ERR_ARG;
    }
    if ((uintptr_t)memory % offsetof(struct aligned, value) != 0) {
        return LMB_ERR_ALIGN;
    }
    if (bytes < lmb_many_lights_bytes(cells)) {
        return LMB_ERR_CAPACITY;
    }
    memset(out, 0, sizeof *out);
    out->cell_cap = cells;
    out->plane_step = planes_of_cells(cells);
    out->slot_count = slots_of(cells);
    out->cell = (lmb_many_lights_cell *)memory;
    out->node = (lmb_many_lights_node *)(void *)(out->cell + cells);
    out->plane = (float *)(void *)(out->node + nodes_of_cells(cells));
    out->slot = (uint32_t *)(void *)(out->plane + (size_t)out->plane_step * LMB_MANY_LIGHTS_PLANES);
    out->low = low;
    out->high = high;
    out->step = maxf(longest, 0x1p-20f) * 0x1p-24f;
    out->quantum = quantum_of(max);
    memset(out->slot, 0, out->slot_count * sizeof *out->slot);
    return LMB_OK;
}

/* --- one light as a cell ------------------------------------------------------------------------------------------ */

/* Moves bit i of v to bit 3 i. */
static uint64_t spread_bits(uint32_t v)
{
    uint64_t x = v;
    x = (x | x << 32) & UINT64_C(0x001f00000000ffff);
    x = (x | x << 16) & UINT64_C(0x001f0000ff0000ff);
    x = (x | x << 8) & UINT64_C(0x100f00f00f00f00f);
    x = (x | x << 4) & UINT64_C(0x10c30c30c30c30c3);
    x = (x | x << 2) & UINT64_C(0x1249249249249249);
    return x;
}

static uint64_t hash_more(uint64_t h, float v)
{
    h = (h ^ float_bits(v)) * UINT64_C(0x9e3779b97f4a7c15);
    return h ^ h >> 32;
}

static uint32_t hash_of(const lmb_light *l)
{
    const lmb_vec3 p = light_kind_is(l->kind, LIGHT_FAR) ? vec3(0.0f, 0.0f, 0.0f) : l->position, d = l->direction;
    const float v[11] = {p.x, p.y, p.z, l->intensity[0], l->intensity[1], l->intensity[2], d.x, d.y, d.z,
                         l->cos_inner, l->cos_outer}, range2 = light_range2(l);
    const int count = light_kind_is(l->kind, LIGHT_CONED) ? 11 : light_kind_is(l->kind, LIGHT_AIMED) ? 9 : 6;
    uint64_t h = 0;
    for (int i = 0; i < count; ++i) {
        h = hash_more(h, v[i]);
    }
    return (uint32_t)(range2 > 0.0f ? hash_more(h, range2) : h);
}

/* Weighted random choice. Of scores log2(u) / w, with u uniform in 0 .. 1 from the hash, light i has the largest with
 * probability w_i / sum w (Efraimidis and Spirakis 2006), in any order. */
static float lot_of(uint32_t hash, float weight)
{
    const float u = ((float)(hash >> 8) + 0.5f) * 0x1p-24f;
    return lmb_log2(u) / weight;
}

static uint32_t step_in_box(float p, float low, float step)
{
    return (uint32_t)clampf((p - low) / step, 0.0f, 16777215.0f);
}

static lmb_many_lights_member member_of(const lmb_many_lights_source *source, float score, uint32_t hash)
{
    lmb_many_lights_member m;
    m.source = *source;
    m.score = score;
    m.hash = hash;
    return m;
}

static int is_inside_box(const lmb_many_lights *m, lmb_vec3 p)
{
    return p.x >= m->low.x && p.x <= m->high.x && p.y >= m->low.y && p.y <= m->high.y && p.z >= m->low.z &&
           p.z <= m->high.z;
}

/* Does the light emit anything, and is it inside the box? Comparisons fail for NaN. Intensities under 2^-60 W/sr count
 * as 0. */
static int is_taken(const lmb_many_lights *m, const lmb_light *l)
{
    int dark = 1;
    for (int c = 0; c < 3; ++c) {
        if (!(l->intensity[c] >= 0.0f && l->intensity[c] < 3e38f)) {
            return 0;
        }
        dark = dark && l->intensity[c] < maxf(m->quantum, 0x1p-60f);
    }
    return !dark && l->range >= 0.0f && light_kind_is(l->kind, LIGHT_KNOWN) && light_shape_is_valid(l) &&
           (light_kind_is(l->kind, LIGHT_FAR) || is_inside_box(m, l->position));
}

/* Rounds values under a micrometre to +0: with both zeros the minimum would depend on the order. */
static float plain(float p) { return absf(p) < 0x1p-20f ? 0.0f : p; }

static lmb_vec3 plain3(lmb_vec3 p) { return vec3(plain(p.x), plain(p.y), plain(p.z)); }

static lmb_many_lights_source source_of(const lmb_light *l)
{
    lmb_many_lights_source s;
    memset(&s, 0, sizeof s);
    s.position = plain3(light_kind_is(l->kind, LIGHT_FAR) ? mul3(l->direction, -1.0f) : l->position);
    if (light_kind_is(l->kind, LIGHT_CONED)) {
        s.direction = plain3(l->direction);
        s.cos_inner = l->cos_inner;
        s.cos_outer = l->cos_outer;
    }
    s.range2 = light_range2(l);
    return s;
}

static uint32_t kind_of(const lmb_light *l)
{
    return l->kind == LMB_LIGHT_POINT  ? 0u
           : l->kind == LMB_LIGHT_SPOT ? 1u + side_of3(l->direction)
                                       : LMB_MANY_LIGHTS_SUNS;
}

/* Sets a cell's fields for the shape of a spot. */
static void set_shape(lmb_many_lights_cell *out, const lmb_many_lights_source *s)
{
    const float axis[3] = {s->direction.x, s->direction.y, s->direction.z};
    for (int a = 0; a < 3; ++a) {
        out->turn |= spread_bits(step_in_box(axis[a], -1.0f, 0x1p-23f) >> (24 - AXIS_BITS)) << a;
    }
    memcpy(out->axis_low, axis, sizeof axis);
    memcpy(out->axis_high, axis, sizeof axis);
    out->cos_outer = s->cos_outer;
}

static void cell_of_light(lmb_many_lights_cell *out, const lmb_many_lights *m, const lmb_light *l)
{
    const lmb_many_lights_source source = source_of(l);
    const float place[3] = {source.position.x, source.position.y, source.position.z};
    const float weight = l->intensity[0] + l->intensity[1] + l->intensity[2];
    const uint32_t hash = hash_of(l);
    lmb_many_lights_scale scale;
    int64_t sum = 0;
    memset(out, 0, sizeof *out);
    out->kind = kind_of(l);
    scale = lmb_many_lights_scale_of(m, out->kind);
    if (light_kind_is(l->kind, LIGHT_CONED)) {
        set_shape(out, &source);
    }
    for (int c = 0; c < 3; ++c) {
        out->intensity[c] = (int64_t)(l->intensity[c] / m->quantum);
        sum += out->intensity[c];
    }
    out->weight = (sum >> 24) + 1;
    for (int a = 0; a < 3; ++a) {
        const uint32_t at = step_in_box(place[a], scale.low[a], scale.step);
        out->moment[a] = out->weight * (int64_t)at;
        out->key |= spread_bits(at >> (24 - AXIS_BITS)) << a;
        out->low[a] = out->high[a] = place[a];
    }
    out->key >>= 3 * m->doubled;
    out->turn >>= 3 * m->doubled;
    out->range2_low = out->range2_high = source.range2 > 0.0f ? source.range2 : LMB_MANY_LIGHTS_ENDLESS2;
    out->strongest = member_of(&source, weight, hash);
    out->median = member_of(&source, lot_of(hash, weight), hash);
    out->lights = 1;
}

/* Could the sums overflow 64 bits? Three channels of 2^61 quanta are less than 2^63. */
static int is_too_much(const lmb_many_lights *m, const lmb_light *l)
{
    const float limit = m->quantum * 0x1p+61f;
    return l->intensity[0] > limit || l->intensity[1] > limit || l->intensity[2] > limit;
}

/* --- merging ------------------------------------------------------------------------------------------------------ */

static int is_better(const lmb_many_lights_member *a, const lmb_many_lights_member *b)
{
    if (a->score != b->score) {
        return a->score > b->score;
    }
    if (a->hash != b->hash) {
        return a->hash < b->hash;
    }
    const lmb_many_lights_source *s = &a->source, *t = &b->source;
    const float u[9] = {s->position.x,  s->position.y, s->position.z, s->direction.x, s->direction.y,
                        s->direction.z, s->cos_inner,  s->cos_outer,  s->range2};
    const float v[9] = {t->position.x,  t->position.y, t->position.z, t->direction.x, t->direction.y,
                        t->direction.z, t->cos_inner,  t->cos_outer,  t->range2};
    int i = 0;
    while (i < 8 && u[i] == v[i]) {
        ++i;
    }
    return u[i] < v[i];
}

void lmb_many_lights_merge(lmb_many_lights_cell *into, const lmb_many_lights_cell *from)
{
    for (int c = 0; c < 3; ++c) {
        into->intensity[c] += from->intensity[c];
        into->moment[c] += from->moment[c];
        into->low[c] = minf(into->low[c], from->low[c]);
        into->high[c] = maxf(into->high[c], from->high[c]);
        into->axis_low[c] = minf(into->axis_low[c], from->axis_low[c]);
        into->axis_high[c] = maxf(into->axis_high[c], from->axis_high[c]);
    }
    into->cos_outer = minf(into->cos_outer, from->cos_outer);
    into->range2_low = minf(into->range2_low, from->range2_low);
    into->range2_high = maxf(into->range2_high, from->range2_high);
    into->weight += from->weight;
    into->lights += from->lights;
    if (is_better(&from->strongest, &into->strongest)) {
        into->strongest = from->strongest;
    }
    if (is_better(&from->median, &into->median)) {
        into->median = from->median;
    }
}

/* --- the table of cells ------------------------------------------------------------------------------------------- */

static int is_cell(const lmb_many_lights_cell *a, const lmb_many_lights_cell *b)
{
    return a->key == b->key && a->turn == b->turn && a->kind == b->kind;
}

/* The slot of a cell equal to c, or the empty slot for it. Slots hold the cell's index + 1. */
static uint32_t *slot_of(const lmb_many_lights *m, const lmb_many_lights_cell *c)
{
    const uint32_t mask = m->slot_count - 1;
    const uint64_t all = c->key + (c->turn + c->kind) * UINT64_C(0xbf58476d1ce4e5b9);
    uint32_t i = (uint32_t)(all * UINT64_C(0x9e3779b97f4a7c15) >> 32) & mask;
    while (m->slot[i] != 0 && !is_cell(&m->cell[m->slot[i] - 1], c)) {
        i = (i + 1) & mask;
    }
    return &m->slot[i];
}

static void widen_cell(lmb_many_lights_cell *c)
{
    c->key >>= 3;
    c->turn >>= 3;
}

/* Doubles the side of cells, in place: merged cells never outnumber the cells read. */
static void double_cells(lmb_many_lights *m)
{
    const uint32_t count = m->cell_count;
    memset(m->slot, 0, m->slot_count * sizeof *m->slot);
    ++m->doubled;
    m->cell_count = 0;
    for (uint32_t i = 0; i < count; ++i) {
        widen_cell(&m->cell[i]);
        uint32_t *slot = slot_of(m, &m->cell[i]);
        if (*slot != 0) {
            lmb_many_lights_merge(&m->cell[*slot - 1], &m->cell[i]);
        } else {
            m->cell[m->cell_count] = m->cell[i];
            *slot = ++m->cell_count;
        }
    }
}

/* Returns 0 if not even one cell for each kind fits. */
static int put_light_cell(lmb_many_lights *m, lmb_many_lights_cell *c)
{
    uint32_t *slot = slot_of(m, c);
    while (*slot == 0 && m->cell_count == m->cell_cap) {
        if (m->doubled == AXIS_BITS) {
            return 0;
        }
        double_cells(m);
        widen_cell(c);
        slot = slot_of(m, c);
    }
    if (*slot != 0) {
        lmb_many_lights_merge(&m->cell[*slot - 1], c);
    } else {
        m->cell[m->cell_count] = *c;
        *slot = ++m->cell_count;
    }
    return 1;
}

lmb_status lmb_many_lights_add(lmb_many_lights *inout, const lmb_light *lights, uint32_t count)
{
    lmb_many_lights_cell c;
    if (inout == NULL || inout->cell == NULL || inout->node_count > 0 || (lights == NULL && count > 0)) {
        return LMB_ERR_ARG;
    }
    for (uint32_t i = 0; i < count; ++i) {
        if (!is_taken(inout, &lights[i])) {
            ++inout->dropped;
            continue;
        }
        if (is_too_much(inout, &lights[i])) {
            return LMB_ERR_CAPACITY;
        }
        cell_of_light(&c, inout, &lights[i]);
        const int64_t sum = c.intensity[0] + c.intensity[1] + c.intensity[2];
        if (sum > (INT64_C(1) << 62) - inout->total || !put_light_cell(inout, &c)) {
            return LMB_ERR_CAPACITY;
        }
        inout->total += sum;
        ++inout->lights;
        inout->ranged += c.range2_low < LMB_MANY_LIGHTS_ENDLESS2;
    }
    return LMB_OK;
}
