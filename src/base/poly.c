/* poly.c: sine, cosine, tangent, arc cosine, arc tangent, log2 and exp2 from polynomials. Layer 1.
 *
 * Each polynomial is a minimax fit (Remez; Lawson for exp2) of the relative error of the whole function. Coefficients
 * were rounded to float from the lowest order up, and the rest was refitted after each, so that rounding costs no
 * visible accuracy. They are written in hexadecimal because that is exact. */
#include "poly.h"

#include "vec.h"

/* x = k pi/2 + r with |r| <= pi/4 and a bit; returns k modulo 4. pi/2 is split into 17 + 14 + 24 bits. |k| <= 41 has
 * six bits, so k * first and k * second are exact, x - k * first is exact by cancellation, and the error of the split
 * is 2^-60. The two later subtractions round |r| < 0.8, 2^-25 each. */
static int32_t reduce_quarter(float *r, float x)
{
    float k;
    if (!(absf(x) <= 64.0f))
        x = 0.0f;
    k = floorf(x * 0x1.45f306p-1f + 0.5f);
    *r = ((x - k * 0x1.921fp+0f) - k * 0x1.6a88p-17f) - k * 0x1.0b4612p-34f;
    return (int32_t)k & 3;
}

/* sin r / r - 1 = z S(z), z = r^2: error 4.0e-9. */
static float sin_near(float r)
{
    float z = r * r;
    float s = -0x1.555546p-3f + z * (0x1.110778p-7f + z * -0x1.995406p-13f);
    return r + (r * z) * s;
}

/* cos r = 1 - z/2 + z^2 C(z): error 1.2e-10. */
static float cos_near(float r)
{
    float z = r * r;
    float c = 0x1.55554ap-5f + z * (-0x1.6c0c28p-10f + z * 0x1.99e80cp-16f);
    return 1.0f - (0.5f * z - (z * z) * c);
}

float lmb_sin(float x)
{
    float r, v;
    int32_t k = reduce_quarter(&r, x);
    v = (k & 1) ? cos_near(r) : sin_near(r);
    return (k & 2) ? -v : v;
}

float lmb_cos(float x)
{
    float r, v;
    int32_t k = reduce_quarter(&r, x);
    v = (k & 1) ? sin_near(r) : cos_near(r);
    return k == 1 || k == 2 ? -v : v;
}

/* -0 gives 0 too. */
float lmb_sqrt(float x) { return x > 0.0f ? sqrtf(x) : 0.0f; }

float lmb_tan(float x) { return lmb_sin(x) / lmb_cos(x); }

/* asin s - s = s z A(z), z = s^2 <= 1/4: error 4.9e-9. */
static float asin_rest(float s, float z)
{
    float a = 0x1.5555c8p-3f +
              z * (0x1.330204p-4f + z * (0x1.747bbap-5f + z * (0x1.8c3e2ap-6f + z * 0x1.595c8cp-5f)));
    return (s * z) * a;
}

/* Beyond 1/2 the half angle keeps the argument small: acos x = 2 asin sqrt((1 - x) / 2); 1 - |x| is exact there. Pi is
 * a sum of two floats: the rest is added to the small term, before the sum rounds. */
float lmb_acos(float x)
{
    float a = absf(x), z, s, p;
    if (a <= 0.5f) {
        p = asin_rest(x, x * x);
        return 0.5f * LMB_PI - (x - (0.5f * LMB_PI_REST - p));
    }
    if (!(a < 1.0f)) /* outside, and NaN, which compares as not negative */
        a = 1.0f;
    z = (1.0f - a) * 0.5f;
    s = sqrtf(z);
    p = 2.0f * (s + asin_rest(s, z));
    return x < 0.0f ? LMB_PI - (p - LMB_PI_REST) : p;
}

/* atan t, |t| <= tan(pi/8): t + t z T(z), error 7.0e-10. */
static float atan_near(float t)
{
    float z = t * t;
    float p = -0x1.55554ap-2f +
              z * (0x1.9991e2p-3f + z * (-0x1.23b9a2p-3f + z * (0x1.b22456p-4f + z * -0x1.f2e5a8p-5f)));
    return t + (t * z) * p;
}

/* The angle is octant * pi/4 plus or minus a small one. Folding across the diagonal and the y axis changes the octant
 * and the sign, so that only one sum rounds at the size of the result. */
float lmb_atan2(float y, float x)
{
    static const float octant_hi[5] = {0.0f, 0x1.921fb6p-1f, 0x1.921fb6p+0f, 0x1.2d97c8p+1f, 0x1.921fb6p+1f};
    static const float octant_lo[5] = {0.0f, -0x1.777a5cp-26f, -0x1.777a5cp-25f, -0x1.99bc5cp-28f, -0x1.777a5cp-24f};
    float ax = absf(x), ay = absf(y), ratio, small;
    int32_t octant = 0;
    if (x != x || y != y || (ax == 0.0f && ay == 0.0f))
        return 0.0f;
    ratio = ax == ay ? 1.0f : ay > ax ? ax / ay : ay / ax;
    if (ratio > 0x1.a8279ap-2f) { /* tan(pi/8): atan a = pi/4 + atan((a - 1) / (a + 1)) */
        ratio = (ratio - 1.0f) / (ratio + 1.0f);
        octant = 1;
    }
    small = atan_near(ratio);
    if (ay > ax) {
        octant = 2 - octant;
        small = -small;
    }
    if (x < 0.0f) {
        octant = 4 - octant;
        small = -small;
    }
    small = octant_hi[octant] + (small + octant_lo[octant]);
    return y < 0.0f ? -small : small;
}

/* x = 2^e m, m in [sqrt(1/2), sqrt(2)), f = m - 1 (exact), s = f / (2 + f): ln m = 2 atanh s = f - s (f - z L(z)),
 * z = s^2, L's error 8.1e-10. Then log2 m = f + (C (f - q) - q) with C = 1/ln 2 - 1, q = s (f - z L): the exact f
 * carries most of it, and only the smaller rest rounds twice. */
float lmb_log2(float x)
{
    uint32_t u;
    int32_t e;
    float f, s, z, q;
    if (!(x >= FLT_MIN))
        x = FLT_MIN;
    u = float_bits(x);
    e = ((int32_t)u - 0x3f3504f3) >> 23;
    f = bits_float(u - (uint32_t)e * 0x800000u) - 1.0f;
    s = f / (2.0f + f);
    z = s * s;
    q = s * (f - z * (0x1.55557ap-1f + z * (0x1.995ed8p-2f + z * 0x1.31e03cp-2f)));
    return (float)e + (f + (0x1.c551dap-2f * (f - q) - q));
}

/* 2^x = 2^k 2^f, |f| <= 1/2: f is exact, the polynomial's error 3.0e-9. The power of two is added to the exponent
 * field. The result neither overflows (k = 128 occurs only with f < 0, so the exponent is one lower) nor becomes
 * denormal. */
float lmb_exp2(float x)
{
    float k, f, p;
    if (!(x >= -126.0f))
        x = -126.0f;
    x = minf(x, 127.99f);
    k = floorf(x + 0.5f);
    f = x - k;
    p = 0x1.c6af7ap-5f + f * (0x1.3b2dd2p-7f + f * (0x1.5f0946p-10f + f * 0x1.417a5cp-13f));
    p = 1.0f + f * (0x1.62e43p-1f + f * (0x1.ebfbdcp-3f + f * p));
    return bits_float(float_bits(p) + (uint32_t)(int32_t)k * 0x800000u);
}
