/* edges.c: what Frama-C's Eva is asked: can edge set-up and its sums over a frame and a tile leave their integers?
 *
 *     frama-c -eva ... tests/static/edges.c        (tests/build/static.sh)
 *
 * All corners within what snapping gives (draw_one.c: +-2^22), all pixels of a frame of LMB_MAX_FRAME. Eva takes every
 * value in these ranges at once; a signed overflow, a bad shift, or an assertion that it cannot prove is an alarm. */
#include "../../src/raster/setup.c"

/*@ requires low <= high;
    assigns \result \from low, high;
    ensures low <= \result <= high; */
int any_between(int low, int high);

/*@ assigns \result \from \nothing;
    ensures \is_finite(\result) && 0.0 <= \result <= 1.0; */
float any_share(void);

enum { SNAP_MOST = 1 << 22, FAR_INSIDE = 1 << 29, FRAME_24_8 = LMB_MAX_FRAME / 2 * 256 };

static lmb_screen_vertex any_corner(void)
{
    lmb_screen_vertex v;
    v.x_24_8 = any_between(-SNAP_MOST, SNAP_MOST);
    v.y_24_8 = any_between(-SNAP_MOST, SNAP_MOST);
    v.d = any_share();
    return v;
}

/* fill_large.inl's least and greatest change within a tile, and its hold on edges that are far inside. */
static int64_t low_of(int32_t ex, int32_t ey)
{
    return (LMB_TILE - 1) * ((int64_t)(ex < 0 ? ex : 0) + (ey < 0 ? ey : 0));
}

static int64_t high_of(int32_t ex, int32_t ey)
{
    return (LMB_TILE - 1) * ((int64_t)(ex > 0 ? ex : 0) + (ey > 0 ? ey : 0));
}

/* A tile that the edge is not outside of: its value at any pixel fits 32 bits, and far inside stays inside. */
static void over_a_tile(int64_t at, int32_t ex, int32_t ey)
{
    const int64_t high = high_of(ex, ey), low = low_of(ex, ey);
    const int32_t dx = any_between(0, LMB_TILE - 1), dy = any_between(0, LMB_TILE - 1);
    /*@ assert high <= 117440512 && low >= -117440512; */
    if (at < -117440512) {
        return; /* outside: at + high < 0 */
    }
    const int32_t e = at < FAR_INSIDE ? (int32_t)at : FAR_INSIDE;
    const int32_t there = e + ey * dy + ex * dx;
    if (e == FAR_INSIDE) {
        /*@ assert there >= 0; */
    }
}

int main(void)
{
    const lmb_screen_vertex a = any_corner(), b = any_corner(), c = any_corner();
    lmb_setup s;
    if (lmb_setup_triangle(&s, &a, &b, &c)) {
        const int32_t x = any_between(-FRAME_24_8, FRAME_24_8), y = any_between(-FRAME_24_8, FRAME_24_8);
        const int i = any_between(0, 2);
        /*@ assert -8388608 <= s.ex[i] <= 8388608 && -8388608 <= s.ey[i] <= 8388608; */
        const int64_t at = setup_edge(&s, i, x, y);
        /*@ assert -1099511627776 <= at <= 1099511627776; */
        over_a_tile(at, s.ex[i], s.ey[i]);
    }
    return 0;
}
