/* test_light_probes.c: tests irradiance -> the harmonics of `lambent bake --to probes`, under a sky of known light. */
#include "../../tools/bake/light_export.h"

#include <math.h>

#include "../../src/base/vec.h"
#include "../test.h"

void test_light_probes(void);

#define PI 3.14159265358979323846

/* With radiance a + b.d + c (3 (p.d)^2 - 1) / 2, a plane of normal n receives pi (a + 2/3 b.n + c / 4 (3 (p.n)^2 - 1) /
 * 2) [Ramamoorthi and Hanrahan 2001]: each band has its own factor. */
static const double flat[3] = {1.0, 0.3, 2.0}, way[3][3] = {{0.5, 0, 0}, {0, -0.2, 0.1}, {0, 0, 0.7}},
                    bend[3] = {0.4, 0.2, -0.3};
static const double pole[3] = {2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0};

static double band(int which, int c, const double d[3])
{
    const double p = pole[0] * d[0] + pole[1] * d[1] + pole[2] * d[2];
    return which == 0   ? flat[c]
           : which == 1 ? way[c][0] * d[0] + way[c][1] * d[1] + way[c][2] * d[2]
                        : bend[c] * (1.5 * p * p - 0.5);
}

/* The harmonics in the order of three.js and others: l l + l + m. */
static double radiance(const float sh[27], int c, const double d[3])
{
    const double x = d[0], y = d[1], z = d[2], a = sqrt(1.0 / (4.0 * PI)), b = sqrt(3.0 / (4.0 * PI)),
                 e = sqrt(15.0 / (4.0 * PI)), f = sqrt(5.0 / (16.0 * PI));
    const double value[9] = {a,         b * y,     b * z, b * x, e * x * y, e * y * z, f * (3.0 * z * z - 1.0),
                             e * x * z, 0.5 * e * (x * x - y * y)};
    double sum = 0.0;
    for (int t = 0; t < 9; ++t) {
        sum += (double)sh[3 * t + c] * value[t];
    }
    return sum;
}

void test_light_probes(void)
{
    static const double factor[3] = {PI, 2.0 * PI / 3.0, PI / 4.0};
    float sh[27] = {0.0f};
    double weights = 0.0, worst = 0.0;
    for (int k = 0; k < LIGHT_PROBE_NORMALS; ++k) {
        float weight, e[3];
        const lmb_vec3 n = light_probe_normal(k, &weight);
        const double d[3] = {(double)n.x, (double)n.y, (double)n.z};
        for (int c = 0; c < 3; ++c) {
            e[c] = (float)(factor[0] * band(0, c, d) + factor[1] * band(1, c, d) + factor[2] * band(2, c, d));
        }
        light_probe_add(sh, k, e);
        weights += (double)weight;
    }
    CHECK_MSG(fabs(weights - 4.0 * PI) < 1e-5, "%g", weights);
    for (int i = 0; i < 200; ++i) {
        const double z = (i + 0.5) / 100.0 - 1.0, round = sqrt(1.0 - z * z);
        const double d[3] = {round * cos(2.4 * i), round * sin(2.4 * i), z};
        for (int c = 0; c < 3; ++c) {
            worst = fmax(worst, fabs(radiance(sh, c, d) - band(0, c, d) - band(1, c, d) - band(2, c, d)));
        }
    }
    CHECK_MSG(worst < 1e-5, "radiance is off by %g", worst);
}
