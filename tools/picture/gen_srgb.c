/* gen_srgb.c: prints src/base/srgb_table.inc, the two tables of the sRGB curve (IEC 61966-2-1).
 *
 *    cc -o gen_srgb tools/picture/gen_srgb.c -lm && ./gen_srgb > src/base/srgb_table.inc
 *
 * Each threshold is found by stepping float by float against the curve in double. The table may only be checked in if
 * no libm could move a threshold, so the program fails unless every one is clear of the curve's rounding. */
#include <math.h>
#include <stdio.h>

static double curve(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

static double inverse(double coded)
{
    return coded <= 0.04045 ? coded / 12.92 : pow((coded + 0.055) / 1.055, 2.4);
}

/* The smallest float with a code of at least `code`: there 255 curve(x) first reaches code - 1/2. */
static float threshold(int code, double *margin)
{
    double want = code - 0.5, above, below;
    float x = (float)inverse(want / 255.0);
    while (255.0 * curve((double)x) >= want)
        x = nextafterf(x, 0.0f);
    while (255.0 * curve((double)x) < want)
        x = nextafterf(x, 2.0f);
    above = 255.0 * curve((double)x) - want;
    below = want - 255.0 * curve((double)nextafterf(x, 0.0f));
    *margin = fmin(*margin, fmin(above, below));
    return x;
}

/* Six to a line; nine digits bring every float back exactly. */
static void print_value(int i, float v)
{
    printf("%s%#.9gf,%s", i % 6 ? " " : "    ", (double)v, i % 6 == 5 ? "\n" : "");
}

int main(void)
{
    double margin = 1.0;
    int i;
    printf("/* srgb_table.inc: the sRGB curve's tables; printed by tools/picture/gen_srgb.c, not edited by hand. */\n"
           "\n");
    printf("/* [c]: the smallest float that is coded c or more; 0 for c = 0. */\n");
    printf("const float lmb_srgb_threshold[256] = {\n");
    for (i = 0; i < 256; ++i)
        print_value(i, i ? threshold(i, &margin) : 0.0f);
    printf("\n};\n\n/* [c]: the linear value of code c. */\nconst float lmb_srgb_linear[256] = {\n");
    for (i = 0; i < 256; ++i)
        print_value(i, (float)inverse(i / 255.0));
    printf("\n};\n");
    fprintf(stderr, "closest threshold: %.3g codes\n", margin);
    return margin > 1e-11 ? 0 : 1; /* pow errs by 1e-13 of a code */
}
