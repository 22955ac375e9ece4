/* gen_fixed.c: prints src/vertex/number_tables.inc: reciprocals, powers and sRGB codes of the frame by integers.
 *
 * Uses only + - * / and sqrt in double, except for the sRGB curve, which has no entries near halves. */
#include <math.h>
#include <stdio.h>

static void print(int at, long value) { printf("%s%ld,", at % 16 == 0 ? "\n    " : " ", value); }

static double srgb(double v) { return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1.0 / 2.4) - 0.055); }

int main(void)
{
    printf("/* number_tables.inc: printed by tools/pack/gen_fixed.c, not edited by hand. */\n\n");
    printf("/* [i]: 2^16 / (1 + (i + 1/2) / 256). */\nconst uint16_t lmb_fixed_reciprocals[256] = {");
    for (int i = 0; i < 256; ++i) {
        print(i, (long)floor(65536.0 / (1.0 + (i + 0.5) / 256.0) + 0.5));
    }
    printf("\n};\n\n/* [i]: 2^16 (1 + i / 64)^-1.5. */\nconst uint16_t lmb_fixed_cubes[194] = {");
    for (int i = 0; i < 194; ++i) {
        const double v = 1.0 + i / 64.0, c = floor(65536.0 / (v * sqrt(v)) + 0.5);
        print(i, (long)(c > 65535.0 ? 65535.0 : c));
    }
    printf("\n};\n\n/* [0][i]: the code of i / 1024; [1][i]: of i / 64; in 1/256. */\n");
    printf("const uint16_t lmb_fixed_srgb[2][65] = {");
    for (int k = 0; k < 2; ++k) {
        printf("\n    {");
        for (int i = 0; i < 65; ++i) {
            print(i, (long)floor(256.0 * srgb(i / (k == 0 ? 1024.0 : 64.0)) + 0.5));
        }
        printf("\n    },");
    }
    printf("\n};\n");
    return 0;
}
