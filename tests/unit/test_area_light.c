/* test_area_light.c: lights with a size: their sum and positions, and the penumbra of a straight edge in closed
 * form. */
#include <math.h>
#include <string.h>

#include "../../tools/common/area_light.h"
#include "../../tools/common/option_value.h"
#include "../test.h"

void test_area_light(void);

static const double pi = 3.14159265358979323846;

static double dot(lmb_vec3 a, const double b[3])
{
    return (double)a.x * b[0] + (double)a.y * b[1] + (double)a.z * b[2];
}

/* The part of a disc on one side of a chord `x` radii from the centre. */
static double disc_below(double x)
{
    x = fmin(fmax(x, -1.0), 1.0);
    return 0.5 + (x * sqrt(1.0 - x * x) + asin(x)) / pi;
}

static lmb_light light_of(int32_t kind)
{
    const lmb_light l = {{1, 2, 3}, {0.48f, -0.6f, 0.64f}, {5, 6, 7}, 0.9f, 0.8f, kind, 4, 0};
    return l;
}

/* Relative RMS error of an edge's penumbra over positions across the edge and orientations of it. */
static double penumbra_error(int32_t kind, int32_t count, double *worst)
{
    lmb_light all[64];
    const lmb_light from = light_of(kind);
    const double size = kind == LMB_LIGHT_DIRECTIONAL ? 10.0 : 0.4;
    const double radius = kind == LMB_LIGHT_DIRECTIONAL ? tan(5.0 * pi / 180.0) : 0.2;
    double sum = 0.0;
    int n = 0;
    area_light(all, count, &from, (float)size);
    *worst = 0.0;
    for (int edge = 0; edge < 90; ++edge) {
        const double a = 2.0 * pi * edge / 90.0, u[3] = {0.8, 0.0, -0.6}, v[3] = {0.36, 0.8, 0.48};
        const double across[3] = {cos(a) * u[0] + sin(a) * v[0], cos(a) * u[1] + sin(a) * v[1],
                                  cos(a) * u[2] + sin(a) * v[2]};
        for (int k = -20; k <= 20; ++k) {
            int seen = 0;
            for (int32_t i = 0; i < count; ++i) {
                const double axis[3] = {0.48, -0.6, 0.64};
                const double at = kind == LMB_LIGHT_DIRECTIONAL
                                      ? dot(all[i].direction, across) / dot(all[i].direction, axis)
                                      : dot(all[i].position, across) - dot(from.position, across);
                seen += at < radius * k / 20.0;
            }
            const double off = (double)seen / count - disc_below(k / 20.0);
            sum += off * off;
            *worst = fmax(*worst, fabs(off));
            ++n;
        }
    }
    return sqrt(sum / n);
}

/* Kinds are tested with the light counts of `mix` (32) and `render` (64). */
static void penumbras(void)
{
    static const struct bar {
        int32_t kind, count;
        double rms, worst;
    } bars[] = {{LMB_LIGHT_DIRECTIONAL, 32, 0.025, 0.09}, {LMB_LIGHT_DIRECTIONAL, 64, 0.015, 0.055},
                {LMB_LIGHT_SPOT, 64, 0.015, 0.055}, {LMB_LIGHT_POINT, 32, 0.035, 0.13},
                {LMB_LIGHT_POINT, 64, 0.022, 0.09}};
    for (size_t i = 0; i < sizeof bars / sizeof *bars; ++i) {
        double worst;
        const double rms = penumbra_error(bars[i].kind, bars[i].count, &worst);
        CHECK_MSG(rms <= bars[i].rms && worst <= bars[i].worst, "kind %d, %d lights: %.4f, at most %.4f",
                  (int)bars[i].kind, (int)bars[i].count, rms, worst);
    }
}

/* Together the lights give the light of the original from about the same position; for spots and suns they lie across
 * the axis. */
static void sums(void)
{
    for (int32_t kind = 0; kind < 3; ++kind) {
        lmb_light all[32];
        const lmb_light from = light_of(kind);
        const double axis[3] = {0.48, -0.6, 0.64};
        double power = 0.0, middle[3] = {0, 0, 0}, far = 0.0, ahead = 0.0;
        area_light(all, 32, &from, kind == LMB_LIGHT_DIRECTIONAL ? 10.0f : 0.4f);
        for (int i = 0; i < 32; ++i) {
            const lmb_vec3 p = kind == LMB_LIGHT_DIRECTIONAL ? all[i].direction : all[i].position,
                           o = kind == LMB_LIGHT_DIRECTIONAL ? from.direction : from.position;
            const double d[3] = {(double)p.x - (double)o.x, (double)p.y - (double)o.y, (double)p.z - (double)o.z};
            power += (double)all[i].intensity[1];
            far = fmax(far, sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
            ahead = fmax(ahead, fabs(d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]));
            for (int c = 0; c < 3; ++c) {
                middle[c] += d[c] / 32.0;
            }
            CHECK(all[i].kind == kind && all[i].revision == 4 && all[i].cos_outer == 0.8f);
        }
        CHECK_MSG(fabs(power - 6.0) < 1e-5 && far <= 0.2001 && far > 0.08, "%g %g", power, far);
        CHECK(sqrt(middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2]) < 0.15 * far);
        CHECK_MSG(kind == LMB_LIGHT_POINT ? ahead > 0.15 : ahead < 0.005, "%d: %g", (int)kind, ahead);
    }
}

/* --- command lines ------------------------------------------------------------------------------------------------ */

static void texts(void)
{
    static const struct text {
        const char *text;
        float size; /* -1: refused */
    } texts[] = {{"sun:0,0,0:0,-1,0:1,1,1:60", 60.0f},
                 {"sun:0,0,0:0,-1,0:1,1,1", 0.0f},        {"sun:0,0,0:0,-1,0:1,1,1:0.5", 0.5f},
                 {"spot:0,0,0:0,-1,0:1,1,1:20,30", 0.0f}, {"spot:0,0,0:0,-1,0:1,1,1:20,30:0.25", 0.25f},
                 {"point:0,0,0:0,-1,0:1,1,1:2", 2.0f},    {"sun:0,0,0:0,-1,0:1,1,1:91", -1.0f},
                 {"sun:0,0,0:0,-1,0:1,1,1:0", -1.0f},     {"point:0,0,0:0,-1,0:1,1,1:-1", -1.0f},
                 {"point:0,0,0:0,-1,0:1,1,1:1:1", -1.0f}, {"spot:0,0,0:0,-1,0:1,1,1:30,20:1", -1.0f},
                 {"point:0,0,0:0,-1,0:1,1,1:", -1.0f},    {"point:0,0,0:0,-1,0:1,1,1:1,2,3", -1.0f}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; ++i) {
        lmb_light light;
        float size = 7.0f;
        const int ok = option_light(texts[i].text, &light, &size) == NULL;
        CHECK_MSG(ok == (texts[i].size >= 0.0f) && (!ok || size == texts[i].size), "%s: %d %g", texts[i].text, ok,
                  (double)size);
    }
    lmb_light light;
    float size;
    CHECK(option_light(texts[2].text, &light, NULL) != NULL && option_light(texts[3].text, &light, NULL) == NULL);
    /* A size without angles keeps the default cone, with an inner angle of 0. */
    CHECK(option_light("spot:0,0,0:0,-1,0:1,1,1:0.5", &light, &size) == NULL && light.cos_inner == 1.0f);
}

/* Messages name the wrong part. */
static void parts(void)
{
    static const struct part {
        const char *text, *wrong;
    } all[] = {{"lamp:0,0,0:0,-1,0:1,1,1", "KIND"},           {"spot", "KIND"},
               {"spot:0,0:0,-1,0:1,1,1", "PX,PY,PZ"},         {"spot:", "PX,PY,PZ"},
               {"spot::0,-1,0:1,1,1", "PX,PY,PZ"},            {"spot:0,0,0,0:0,-1,0:1,1,1", "PX,PY,PZ"},
               {"spot:0,0,0", "DX,DY,DZ"},                    {"spot:0,0,0:0,x,0:1,1,1", "DX,DY,DZ"},
               {"spot:0,0,0:0,0,0:1,1,1", "DX,DY,DZ"},        {"spot:0,0,0:0,-1,0", "R,G,B"},
               {"spot:0,0,0:0,-1,0:1,1", "R,G,B"},            {"spot:0,0,0:0,-1,0:1,1,-1", "R,G,B"},
               {"spot:0,0,0:0,-1,0:1,1,1,1", "R,G,B"},        {"spot:0,0,0:0,-1,0:1,1,1:30,20", "INNER,OUTER"},
               {"spot:0,0,0:0,-1,0:1,1,1:20,90", "INNER,OUTER"}, {"spot:0,0,0:0,-1,0:1,1,1:0.1:20,30", "INNER,OUTER"},
               {"spot:0,0,0:0,-1,0:1,1,1:20,30:x", "SIZE"},   {"sun:0,0,0:0,-1,0:1,1,1:91", "SIZE"}};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        lmb_light light;
        float size;
        const char *wrong = option_light(all[i].text, &light, &size);
        CHECK_MSG(wrong != NULL && strcmp(wrong, all[i].wrong) == 0, "%s: %s", all[i].text, wrong != NULL ? wrong : "none");
    }
}

void test_area_light(void)
{
    penumbras();
    sums();
    texts();
    parts();
}
