/* bins.c: Frama-C's Eva proves for bins that corners b and c of a small triangle, stored as two differences in 32 bits,
 * are restored exactly, and that no sum leaves 32 bits.
 *
 * First all differences at once, from a corner a at the origin, because Eva's ranges are independent. Then every 64th
 * difference in y, with all in x and all corners a that snapping gives (snap.c: +-2^22). */
#include "any.h"

#include "../../src/raster/setup.inl"

#include "../../src/raster/bins.inl"

enum { SNAP_MAX = 1 << 22, APART_MAX = LMB_SMALL_24_8 - 1 };

static lanei any_apart(void)
{
    lanei r;
    r.v[0] = any_between(-APART_MAX, APART_MAX);
    return r;
}

int main(void)
{
    const float d = any_share();
    const lanei none = lanei_splat(0), x = any_apart();
    lanei a_x, a_y, y;
    (void)bin_corner(none, none, bin_pair(x, any_apart()), &d);
    a_x.v[0] = any_between(-SNAP_MAX, SNAP_MAX);
    a_y.v[0] = any_between(-SNAP_MAX, SNAP_MAX);
    /*@ loop unroll 600; */
    for (y.v[0] = -APART_MAX; y.v[0] <= APART_MAX; y.v[0] += 64) {
        const setup_corner c = bin_corner(a_x, a_y, bin_pair(x, y), &d);
        /*@ assert -SNAP_MAX - APART_MAX <= c.x.v[0] <= SNAP_MAX + APART_MAX; */
        /*@ assert y.v[0] - SNAP_MAX <= c.y.v[0] <= y.v[0] + SNAP_MAX; */
    }
    return 0;
}
