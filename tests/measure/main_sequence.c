/* main_sequence.c: tools of tests/measure/sequence.sh: camera poses, sensor noise, and the difference between frames.
 *
 *     measure-sequence poses SEED COUNT EX,EY,EZ TX,TY,TZ STEP_M FOV WIDTH HEIGHT PREFIX
 *         writes PREFIXnn.json for a hand-held camera; prints a line each: number, eye, target
 *     measure-sequence sensor SEED FOV FIRST.pfm DEPTH.pfm PHOTO.pfm OUT_DEPTH.pfm OUT_PHOTO.png [still]
 *         adds a Kinect's noise and shadow to the depth and a camera's noise to the photo, with the exposure of FIRST;
 *         still: the photo's noise is always the same
 *     measure-sequence change A.png B.png PHOTO_A.png PHOTO_B.png
 *         change, of 255, of pixels whose photo changed less or not at all: 99.9th percentile, maximum */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/picture.h"
#include "../../tools/picture/picture_read.h"
#include "../test.h"

int test_passed, test_failed, test_skipped;

/* --- poses -------------------------------------------------------------------------------------------------------- */

static void less3(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = a[i] - b[i];
    }
}

static void cross(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

static void unit3(double v[3])
{
    const double n = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; ++i) {
        v[i] /= n;
    }
}

/* One turn around an ellipse with STEP_M of its circumference per frame, and a hand's tremor. */
static int poses(char **a)
{
    test_rng rng = {(uint32_t)atoi(a[0])};
    const int count = atoi(a[1]), width = atoi(a[6]), height = atoi(a[7]);
    double eye[3], target[3];
    const double step = atof(a[4]), focal = 0.5 * height / tan(0.5 * atof(a[5]) * 3.14159265358979 / 180.0);
    if (sscanf(a[2], "%lf,%lf,%lf", &eye[0], &eye[1], &eye[2]) != 3 ||
        sscanf(a[3], "%lf,%lf,%lf", &target[0], &target[1], &target[2]) != 3) {
        return 2;
    }
    for (int k = 0; k < count; ++k) {
        const double up[3] = {0, 1, 0}, t = (double)k;
        double f[3], right[3], down[3], e[3], to[3];
        char path[600];
        for (int i = 0; i < 3; ++i) {
            const double tremor = 0.1 * step * (double)test_uniform(&rng, -1, 1);
            e[i] = eye[i] + step * (i == 0 ? t : i == 1 ? 3.0 * sin(0.21 * t) : -0.35 * t) + tremor;
            to[i] = target[i] + 0.5 * step * (double)test_uniform(&rng, -1, 1);
        }
        less3(f, to, e);
        unit3(f);
        cross(right, f, up);
        unit3(right);
        cross(down, f, right);
        snprintf(path, sizeof path, "%s%02d.json", a[8], k);
        FILE *out = fopen(path, "w");
        if (out == NULL) {
            return 1;
        }
        fprintf(out, "{\"fx\": %.6f, \"fy\": %.6f, \"cx\": %.1f, \"cy\": %.1f, \"depth_unit_mm\": 1000, ", focal, focal,
                0.5 * (width - 1), 0.5 * (height - 1));
        fprintf(out, "\"camera_to_world\": [");
        for (int i = 0; i < 3; ++i) {
            fprintf(out, "[%.9f, %.9f, %.9f, %.9f], ", right[i], down[i], f[i], e[i]);
        }
        fprintf(out, "[0, 0, 0, 1]]}\n");
        fclose(out);
        printf("%d %.9f,%.9f,%.9f %.9f,%.9f,%.9f\n", k, e[0], e[1], e[2], to[0], to[1], to[2]);
    }
    return 0;
}

/* --- a sensor ----------------------------------------------------------------------------------------------------- */

static float gauss(test_rng *rng)
{
    float sum = 0.0f;
    for (int i = 0; i < 12; ++i) {
        sum += test_uniform(rng, 0, 1);
    }
    return sum - 6.0f;
}

static int read_picture(image *out, const char *path)
{
    report r = {""};
    file_bytes file;
    const int ok = file_read(&file, path, &r) && pfm_decode(out, file.data, file.size, path, &r);
    if (!ok) {
        fprintf(stderr, "%s\n", r.text);
    }
    return ok; /* one picture of a short run: the file stays in memory */
}

static int write_picture(const image *p, const char *path)
{
    report r = {""};
    const int ok = picture_write(path, p, 0.0f, PICTURE_CLIPPED, &r);
    if (!ok) {
        fprintf(stderr, "%s\n", r.text);
    }
    return ok;
}

/* A Kinect's errors: points that its projector, 75 mm to one side, does not reach are missing; edges shift by one or
 * two pixels, in short runs; disparity is in eighths of a pixel; random spots are missing. */
static void measure_depth(float *out, const image *z, float focal, test_rng *rng)
{
    const int w = z->width, h = z->height;
    const float base = 0.075f * focal;
    float *lit = malloc(3 * (size_t)w * sizeof *lit), *shift = malloc((size_t)(w * h) * sizeof *shift);
    for (int i = 0; i < w * h; ++i) {
        shift[i] = 1.3f * gauss(rng);
    }
    for (int y = 0; y < h; ++y) {
        for (int i = 0; i < 3 * w; ++i) {
            lit[i] = 1e9f;
        }
        for (int pass = 0; pass < 2; ++pass) {
            for (int x = 0; x < w; ++x) {
                const int at = y / 2 * w + x / 2 * 2;
                int u = x + (int)floorf(shift[at] + 0.5f), v = y + (int)floorf(shift[at + 1 < w * h ? at + 1 : at] + 0.5f);
                u = u < 0 ? 0 : u >= w ? w - 1 : u;
                v = v < 0 ? 0 : v >= h ? h - 1 : v;
                const float far = z->pixels[(size_t)(v * w + u) * (size_t)z->channels], d = far > 0.1f ? base / far : 0.0f;
                const float seen = floorf(8.0f * (d + 0.06f * gauss(rng)) + 0.5f) / 8.0f;
                const int to = (int)((float)x - d + (float)w);
                if (pass == 0) {
                    lit[to] = far < lit[to] ? far : lit[to];
                } else {
                    out[y * w + x] = !(far > 0.1f) || !(seen > 0.0f) || far > 1.02f * lit[to] ? 0.0f : base / seen;
                }
            }
        }
    }
    for (int i = 0; i < 150; ++i) {
        const int x = (int)test_uniform(rng, 0, (float)(w - 3)), y = (int)test_uniform(rng, 0, (float)(h - 3));
        for (int k = 0; k < 9; ++k) {
            out[(y + k / 3) * w + x + k % 3] = 0.0f;
        }
    }
    free(lit);
    free(shift);
}

/* Files have three channels; those of depth are equal. */
static float *grey(const float *in, int count)
{
    float *out = malloc(3 * (size_t)count * sizeof *out);
    for (int i = 0; i < 3 * count; ++i) {
        out[i] = in[i / 3];
    }
    return out;
}

static int sensor(char **a, int count)
{
    image z, photo, first;
    if (!read_picture(&first, a[2]) || !read_picture(&z, a[3]) || !read_picture(&photo, a[4])) {
        return 1;
    }
    test_rng rng = {(uint32_t)atoi(a[0])}, light = {count > 7 ? 77u : (uint32_t)atoi(a[0]) + 5000u};
    const float focal = 0.5f * (float)z.height / tanf(0.5f * (float)atof(a[1]) * 3.14159265f / 180.0f);
    float *depth = malloc((size_t)(z.width * z.height) * sizeof *depth);
    const float gain = exp2f(picture_auto_exposure(&first, PICTURE_CLIPPED));
    measure_depth(depth, &z, focal, &rng);
    image out = {.width = z.width, .height = z.height, .channels = 3, .pixels = NULL};
    out.pixels = grey(depth, z.width * z.height);
    for (int i = 0; i < 3 * photo.width * photo.height; ++i) {
        const float v = sqrtf(gain * photo.pixels[i]) + 0.01f * gauss(&light);
        photo.pixels[i] = v > 0.0f ? fminf(v * v, 1.0f) : 0.0f;
    }
    return write_picture(&out, a[5]) && write_picture(&photo, a[6]) ? 0 : 1;
}

/* --- change ------------------------------------------------------------------------------------------------------- */

static int change(char **a)
{
    stored_picture p[4];
    int bin[256] = {0}, total = 0, max = 0, above = 0, found = -1;
    for (int i = 0; i < 4; ++i) {
        report r = {""};
        file_bytes file;
        if (!file_read(&file, a[i], &r) || !picture_read(&p[i], file.data, file.size, a[i], &r) || p[i].codes.texels == NULL) {
            fprintf(stderr, "%s: no PNG\n", a[i]);
            return 1;
        }
    }
    for (int i = 0; i < p[0].width * p[0].height; ++i) {
        int differs = 0, same = 1;
        for (int c = 0; c < 3; ++c) {
            const int d = abs(p[0].codes.texels[4 * i + c] - p[1].codes.texels[4 * i + c]);
            differs = d > differs ? d : differs;
            same &= p[2].codes.texels[4 * i + c] == p[3].codes.texels[4 * i + c];
        }
        if (same) {
            ++bin[differs];
            ++total;
            max = differs > max ? differs : max;
        }
    }
    for (int d = 255; d >= 0 && found < 0; --d) {
        above += bin[d];
        found = 1000 * above > total ? d : -1;
    }
    printf("%d %d of %d pixels\n", found, max, total);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 11 && strcmp(argv[1], "poses") == 0) {
        return poses(argv + 2);
    }
    if (argc >= 9 && strcmp(argv[1], "sensor") == 0) {
        return sensor(argv + 2, argc - 2);
    }
    if (argc == 6 && strcmp(argv[1], "change") == 0) {
        return change(argv + 2);
    }
    return 2;
}
