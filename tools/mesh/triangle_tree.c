/* triangle_tree.c: bounding boxes of repeatedly halved sets of triangles, and a search that skips distant boxes. */
#include "triangle_tree.h"

#include <string.h>

#define LEAF 4   /* triangles, at most */
#define PI 3.141592653589793
#define TIE 1e-9 /* of a squared distance: rounding between triangles that share the nearest point */

static const float *corner(const triangle_mesh *m, uint32_t triangle, int k)
{
    return m->positions + 3 * (size_t)m->indices[3 * (size_t)triangle + (size_t)k];
}

/* --- build --- */

static double centre(const triangle_mesh *m, uint32_t t, int axis)
{
    return (double)corner(m, t, 0)[axis] + (double)corner(m, t, 1)[axis] + (double)corner(m, t, 2)[axis];
}

/* Ties go to the lower number: a total order, so that the halves don't depend on how they were found. */
static int comes_before(const triangle_mesh *m, uint32_t s, uint32_t t, int axis)
{
    const double a = centre(m, s, axis), b = centre(m, t, axis);
    return a < b || (!(b < a) && s < t);
}

static int longest_axis(const triangle_mesh *m, const uint32_t *order, uint32_t n)
{
    double low[3], high[3];
    uint32_t i;
    int k, best = 0;
    for (k = 0; k < 3; ++k) {
        low[k] = high[k] = centre(m, order[0], k);
        for (i = 1; i < n; ++i) {
            const double c = centre(m, order[i], k);
            low[k] = c < low[k] ? c : low[k];
            high[k] = c > high[k] ? c : high[k];
        }
        if (high[k] - low[k] > high[best] - low[best])
            best = k;
    }
    return best;
}

static uint32_t middle_of_three(const triangle_mesh *m, uint32_t a, uint32_t b, uint32_t c, int axis)
{
    if (comes_before(m, a, b, axis))
        return comes_before(m, b, c, axis) ? b : comes_before(m, a, c, axis) ? c : a;
    return comes_before(m, a, c, axis) ? a : comes_before(m, b, c, axis) ? c : b;
}

/* Quickselect: the first `half` of n come before the others. */
static void halve(const triangle_mesh *m, uint32_t *order, uint32_t n, uint32_t half, int axis)
{
    uint32_t low = 0, high = n;
    while (high - low > 1) {
        const uint32_t pivot = middle_of_three(m, order[low], order[low + (high - low) / 2], order[high - 1], axis);
        uint32_t i = low, k = high;
        while (i < k) {
            if (comes_before(m, order[i], pivot, axis)) {
                ++i;
            } else {
                const uint32_t swap = order[--k];
                order[k] = order[i];
                order[i] = swap;
            }
        }
        /* i triangles come before the pivot; it is among the others, and moves to their front. */
        for (k = i; order[k] != pivot; ++k)
            continue;
        order[k] = order[i];
        order[i] = pivot;
        if (half <= i)
            high = i;
        else
            low = i + 1;
        if (low >= half)
            break;
    }
}

/* Triangles of node i of a level: an even share. */
static uint32_t share(const triangle_tree *tree, uint32_t level, uint32_t i)
{
    return (uint32_t)((uint64_t)tree->mesh->triangle_count * i >> level);
}

static void order_triangles(triangle_tree *tree)
{
    uint32_t level, i;
    for (level = 0; level + 1 < tree->levels; ++level)
        for (i = 0; i < UINT32_C(1) << level; ++i) {
            const uint32_t from = share(tree, level, i), half = share(tree, level + 1, 2 * i + 1);
            const uint32_t n = share(tree, level, i + 1) - from;
            if (n > 1)
                halve(tree->mesh, tree->order + from, n, half - from, longest_axis(tree->mesh, tree->order + from, n));
        }
}

static tree_box no_box(void)
{
    tree_box b;
    int k;
    for (k = 0; k < 3; ++k) {
        b.low[k] = HUGE_VALF;
        b.high[k] = -HUGE_VALF;
    }
    return b;
}

static void widen(tree_box *b, const float *low, const float *high)
{
    int k;
    for (k = 0; k < 3; ++k) {
        b->low[k] = low[k] < b->low[k] ? low[k] : b->low[k];
        b->high[k] = high[k] > b->high[k] ? high[k] : b->high[k];
    }
}

void triangle_tree_fit(triangle_tree *tree)
{
    const uint32_t leaves = UINT32_C(1) << (tree->levels - 1);
    uint32_t i, k;
    for (i = 0; i < leaves; ++i) {
        tree_box b = no_box();
        for (k = share(tree, tree->levels - 1, i); k < share(tree, tree->levels - 1, i + 1); ++k) {
            int c;
            for (c = 0; c < 3; ++c)
                widen(&b, corner(tree->mesh, tree->order[k], c), corner(tree->mesh, tree->order[k], c));
        }
        tree->boxes[leaves - 1 + i] = b;
    }
    for (i = leaves - 1; i-- > 0;) {
        tree->boxes[i] = tree->boxes[2 * i + 1];
        widen(&tree->boxes[i], tree->boxes[2 * i + 2].low, tree->boxes[2 * i + 2].high);
    }
}

int triangle_tree_build(triangle_tree *tree, const triangle_mesh *mesh, counted_heap *t)
{
    uint32_t i;
    memset(tree, 0, sizeof *tree);
    tree->mesh = mesh;
    for (tree->levels = 1; (uint64_t)LEAF << (tree->levels - 1) < mesh->triangle_count; ++tree->levels)
        continue;
    tree->box_count = (UINT32_C(1) << tree->levels) - 1;
    tree->order = counted_alloc(t, mesh->triangle_count, sizeof *tree->order);
    tree->boxes = counted_alloc(t, tree->box_count, sizeof *tree->boxes);
    if (!tree->order || !tree->boxes)
        return 0;
    for (i = 0; i < mesh->triangle_count; ++i)
        tree->order[i] = i;
    order_triangles(tree);
    triangle_tree_fit(tree);
    return 1;
}

void triangle_tree_free(triangle_tree *tree, counted_heap *t)
{
    if (tree->mesh)
        counted_free(t, tree->order, tree->mesh->triangle_count, sizeof *tree->order);
    counted_free(t, tree->boxes, tree->box_count, sizeof *tree->boxes);
    memset(tree, 0, sizeof *tree);
}

/* --- search --- */

static double clamp01(double v) { return v > 0 ? v < 1 ? v : 1 : 0; }

/* The position on a b nearest to p; 0 if a and b are equal. */
static double share_of_edge(dvec p, dvec a, dvec b)
{
    const dvec ab = dvec_sub(b, a);
    const double length2 = dvec_dot(ab, ab);
    return length2 > 0 ? clamp01(dvec_dot(dvec_sub(p, a), ab) / length2) : 0;
}

static void try_edge(nearest *best, dvec p, const dvec v[3], int k)
{
    const int l = (k + 1) % 3;
    const double s = share_of_edge(p, v[k], v[l]);
    const dvec at = dvec_mix(v[k], v[l], s), off = dvec_sub(p, at);
    const double distance2 = dvec_dot(off, off);
    if (!(distance2 < best->distance2))
        return;
    best->distance2 = distance2;
    best->point = at;
    best->weight[k] = 1 - s;
    best->weight[l] = s;
    best->weight[3 - k - l] = 0;
}

/* Angle between two directions, to 7e-5 (Abramowitz and Stegun 4.4.45), because libm differs between machines. */
static double angle(dvec a, dvec b)
{
    const double c = dvec_dot(dvec_unit(a), dvec_unit(b)), x = fabs(c) < 1 ? fabs(c) : 1;
    const double acute = sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
    return c < 0 ? PI - acute : acute;
}

/* The projection of p if it lies inside the triangle, otherwise the nearest point of the three edges. */
static nearest nearest_of_triangle(const triangle_mesh *m, uint32_t t, dvec p)
{
    const dvec v[3] = {dvec_read(corner(m, t, 0)), dvec_read(corner(m, t, 1)), dvec_read(corner(m, t, 2))};
    const dvec turn = dvec_turn(v[0], v[1], v[2]);
    const double length2 = dvec_dot(turn, turn);
    nearest n;
    int k, inside = length2 > 0;
    n.triangle = t;
    n.distance2 = HUGE_VAL;
    n.point = p;
    n.normal = dvec_unit(turn);
    for (k = 0; k < 3; ++k) {
        const double w = dvec_dot(dvec_turn(p, v[(k + 1) % 3], v[(k + 2) % 3]), turn);
        n.weight[k] = length2 > 0 ? w / length2 : 0;
        inside &= w >= 0;
    }
    if (inside) {
        const double height = dvec_dot(dvec_sub(p, v[0]), n.normal);
        n.distance2 = height * height;
        n.point = dvec_sub(p, dvec_mul(n.normal, height));
        return n;
    }
    for (k = 0; k < 3; ++k)
        try_edge(&n, p, v, k);
    for (k = 0; k < 3; ++k)
        if (n.weight[k] > 1 - TIE)
            n.normal = dvec_mul(n.normal, angle(dvec_sub(v[(k + 1) % 3], v[k]), dvec_sub(v[(k + 2) % 3], v[k])) / PI);
    return n;
}

static double box_distance2(const tree_box *b, dvec p)
{
    const double at[3] = {p.x, p.y, p.z};
    double sum = 0;
    int k;
    for (k = 0; k < 3; ++k) {
        const double under = (double)b->low[k] - at[k], over = at[k] - (double)b->high[k];
        const double d = under > 0 ? under : over > 0 ? over : 0;
        sum += d * d;
    }
    return sum;
}

/* Takes n if it is nearer. If both are as near, they share the point, and the sum of their normals weighted by their
 * angles there decides the side correctly (Baerentzen and Aanaes 2005). */
static void take_if_nearer(nearest *best, const nearest *n)
{
    const double slack = TIE * best->distance2;
    const dvec sum = dvec_add(best->normal, n->normal);
    if (n->distance2 > best->distance2 + slack)
        return;
    if (n->distance2 < best->distance2 - slack) {
        *best = *n;
        return;
    }
    if (n->triangle < best->triangle)
        *best = *n;
    best->normal = sum;
}

/* Searches a leaf, except for the guess that the search began with. */
static void search_leaf(const triangle_tree *tree, nearest *best, uint32_t leaf, dvec from, uint32_t guess)
{
    uint32_t i;
    for (i = share(tree, tree->levels - 1, leaf); i < share(tree, tree->levels - 1, leaf + 1); ++i) {
        const nearest n = nearest_of_triangle(tree->mesh, tree->order[i], from);
        if (n.triangle != guess)
            take_if_nearer(best, &n);
    }
}

nearest triangle_tree_nearest(const triangle_tree *tree, dvec from, uint32_t guess)
{
    const uint32_t leaves = UINT32_C(1) << (tree->levels - 1);
    uint32_t stack[40], depth = 0;
    nearest best;
    memset(&best, 0, sizeof best);
    best.distance2 = HUGE_VAL;
    if (!tree->mesh->triangle_count)
        return best;
    best = nearest_of_triangle(tree->mesh, guess, from);
    stack[depth++] = 0;
    while (depth) {
        const uint32_t i = stack[--depth], left = 2 * i + 1;
        if (box_distance2(&tree->boxes[i], from) > best.distance2 * (1 + TIE))
            continue;
        if (i >= leaves - 1) {
            search_leaf(tree, &best, i - (leaves - 1), from, guess);
        } else {
            const double l2 = box_distance2(&tree->boxes[left], from), r2 = box_distance2(&tree->boxes[left + 1], from);
            stack[depth++] = r2 < l2 ? left : left + 1; /* later */
            stack[depth++] = r2 < l2 ? left + 1 : left;
        }
    }
    return best;
}
