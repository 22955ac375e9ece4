/* blur.c: irradiance by blurring a map's columns, then its rows. Layer 5. [S11-S13]
 *
 * The paper blurs by cos of the angle in latitude, then in longitude, with the same kernel everywhere. The exact weight
 * between a normal and a direction is max(0, n . d), which is such a product only at the equator. Fitted kernels are
 * the best approximation by one or two products, in least squares over the sphere, for each row of the result. The fit
 * alternates between the column weights and the row weights. */
#include <string.h>

#include "../base/memory_check.h"
#include "../base/poly.h"
#include "../lane/kernels.h"
#include "cube.h"

#if LMB_PROBES

enum { CIRCLE_STEPS = 24 };

/* --- kernels ------------------------------------------------------------------------------------------------------ */

static size_t words(int32_t width, int32_t height, int32_t terms)
{
    const size_t w = (size_t)width, h = (size_t)height;
    return (size_t)(terms > 0 ? terms : 1) * h * (2 * h + w);
}

size_t lmb_probe_blur_bytes(const lmb_probe_table *table, int32_t terms)
{
    const int is_table = table != NULL && lmb_probe_table_bytes(table->width, table->height) > 0;
    return is_table && terms >= 0 && terms <= 2 ? 4 * words(table->width, table->height, terms) : 0;
}

static float *column_of(const lmb_probe_blur *b, int32_t term, int32_t row)
{
    return b->column + (size_t)(term * b->height + row) * (size_t)(2 * b->height);
}

static float *row_of_term(const lmb_probe_blur *b, int32_t term, int32_t row)
{
    return b->row + (size_t)(term * b->height + row) * (size_t)b->width;
}

static float sum_of_weights(const float *v, int32_t n)
{
    float sum = 0.0f;
    for (int32_t i = 0; i < n; ++i) {
        sum += v[i];
    }
    return sum;
}

/* Cosine of a lag of i steps, n to the full turn; 0 beyond a quarter turn. */
static float lag_cos(int32_t i, int32_t n) { return 4 * i < n ? lmb_cos(2.0f * LMB_PI * ((float)i / (float)n)) : 0.0f; }

/* Sets the paper's kernels [S11]: rows past a pole are those before it, rotated by half a turn. */
static void set_source(lmb_probe_blur *b, int32_t row)
{
    const int32_t h = b->height, w = b->width;
    float *column = column_of(b, 0, row), *along = row_of_term(b, 0, row);
    memset(column, 0, 2 * (size_t)h * sizeof *column);
    for (int32_t y = row - h / 2; y <= row + h / 2; ++y) {
        const int32_t real = y < 0 ? -1 - y : y >= h ? 2 * h - 1 - y : y;
        column[real + (real == y ? 0 : h)] += lag_cos(y < row ? row - y : y - row, 2 * h);
    }
    for (int32_t x = 0; x < w; ++x) {
        along[x] = lag_cos(mini(x, w - x), w);
    }
    const float scale = LMB_PI / (sum_of_weights(column, 2 * h) * sum_of_weights(along, w));
    for (int32_t x = 0; x < w; ++x) {
        along[x] *= scale;
    }
}

/* State of the fit of one row's kernels. */
typedef struct fit {
    const lmb_probe_blur *blur;
    const lmb_probe_table *table;
    int32_t row, term;
} fit;

static float latitude_cos(const lmb_probe_table *t, int32_t row)
{
    return lmb_cos(LMB_PI * ((float)(2 * row + 1) / (float)(2 * t->height)));
}

/* The rest of max(0, n . d) sqrt(area) at row y and lag x after the earlier terms. */
static float wanted(const fit *f, int32_t y, float lag, int32_t x)
{
    const float up = latitude_cos(f->table, f->row), at = latitude_cos(f->table, y);
    const float round = sqrtf(1.0f - up * up) * sqrtf(1.0f - at * at);
    float v = maxf(up * at + round * lag, 0.0f) * sqrtf(f->table->area[y]);
    for (int32_t term = 0; term < f->term; ++term) {
        v -= column_of(f->blur, term, f->row)[y] * row_of_term(f->blur, term, f->row)[x];
    }
    return v;
}

/* Sets the best weights of the columns for given row weights, or the reverse. */
static void fit_turn(const fit *f, int of_columns)
{
    const int32_t w = f->blur->width, h = f->blur->height;
    float *column = column_of(f->blur, f->term, f->row), *along = row_of_term(f->blur, f->term, f->row);
    float *to = of_columns ? column : along;
    const float *from = of_columns ? along : column;
    float norm = 1e-20f;
    for (int32_t i = 0; i < (of_columns ? w : h); ++i) {
        norm += from[i] * from[i];
    }
    memset(to, 0, (size_t)(of_columns ? h : w) * sizeof *to);
    for (int32_t x = 0; x < w; ++x) {
        const float lag = lmb_cos(2.0f * LMB_PI * ((float)x / (float)w));
        for (int32_t y = 0; y < h; ++y) {
            to[of_columns ? y : x] += wanted(f, y, lag, x) * from[of_columns ? x : y] / norm;
        }
    }
}

static void set_fitted(lmb_probe_blur *b, const lmb_probe_table *t, int32_t row)
{
    float whole = 0.0f;
    for (int32_t term = 0; term < b->terms; ++term) {
        const fit f = {b, t, row, term};
        float *along = row_of_term(b, term, row);
        for (int32_t x = 0; x < b->width; ++x) {
            along[x] = 1.0f + lmb_cos((float)(term + 1) * 2.0f * LMB_PI * ((float)x / (float)b->width));
        }
        memset(column_of(b, term, row), 0, 2 * (size_t)b->height * sizeof(float));
        for (int32_t i = 0; i < CIRCLE_STEPS; ++i) {
            fit_turn(&f, 1);
            fit_turn(&f, 0);
        }
    }
    for (int32_t term = 0; term < b->terms; ++term) {
        float *column = column_of(b, term, row);
        for (int32_t y = 0; y < b->height; ++y) {
            column[y] *= sqrtf(t->area[y]);
        }
        whole += sum_of_weights(column, b->height) * sum_of_weights(row_of_term(b, term, row), b->width);
    }
    for (int32_t i = 0; i < b->terms * b->width; ++i) {
        row_of_term(b, i / b->width, row)[i % b->width] *= LMB_PI / whole;
    }
}

lmb_status lmb_probe_blur_init(lmb_probe_blur *out, const lmb_probe_table *table, int32_t terms, void *memory,
                               size_t bytes)
{
    if (out == NULL || table == NULL || terms < 0 || terms > 2) {
        return LMB_ERR_ARG;
    }
    const lmb_status status = check_memory(memory, bytes, lmb_probe_blur_bytes(table, terms));
    if (status != LMB_OK) {
        return status;
    }
    out->width = table->width;
    out->height = table->height;
    out->terms = terms;
    out->column = (float *)memory;
    out->row = out->column + (size_t)(terms > 0 ? terms : 1) * 2 * (size_t)table->height * (size_t)table->height;
    for (int32_t row = 0; row < table->height; ++row) {
        if (terms == 0) {
            set_source(out, row);
        } else {
            set_fitted(out, table, row);
        }
    }
    return LMB_OK;
}

/* --- maps --------------------------------------------------------------------------------------------------------- */

/* Blurs one plane. Each row of the result needs all rows, so a blur in place reads from a copy. [S13] */
static void blur_plane(float *out, float *line, const lmb_kernels *kernels, const float *map,
                       const lmb_probe_blur *blur)
{
    const size_t width = (size_t)blur->width, bytes = width * (size_t)blur->height * sizeof *out;
    if (out == map) {
        memcpy(line + 4 * width, map, bytes);
        map = line + 4 * width;
    }
    memset(out, 0, bytes);
    for (int32_t i = 0; i < blur->height * maxi(blur->terms, 1); ++i) {
        const int32_t row = i / maxi(blur->terms, 1), term = i % maxi(blur->terms, 1);
        lmb_blur_job job;
        job.map = map;
        job.width = blur->width;
        job.height = blur->height;
        job.over = blur->terms == 0;
        job.column = column_of(blur, term, row);
        job.row = row_of_term(blur, term, row);
        kernels->blur(out + (size_t)row * width, line, &job);
    }
}

lmb_status lmb_probe_blur_map(float *out, const lmb_kernels *kernels, float *line, const float *map,
                              const lmb_probe_blur *blur)
{
    if (out == NULL || line == NULL || kernels == NULL || map == NULL || blur == NULL || blur->row == NULL) {
        return LMB_ERR_ARG;
    }
    const size_t plane = (size_t)blur->width * (size_t)blur->height;
    for (size_t c = 0; c < 3; ++c) {
        blur_plane(out + c * plane, line, kernels, map + c * plane, blur);
    }
    return LMB_OK;
}

lmb_status lmb_probe_halve(float *out, const float *map, const lmb_probe_table *table)
{
    if (out == NULL || map == NULL || table == NULL || table->area == NULL || table->height % 16 != 0) {
        return LMB_ERR_ARG;
    }
    const int32_t w = table->width, h = table->height;
    for (int32_t i = 0; i < 3 * (h / 2); ++i) {
        const float *from = map + (size_t)(2 * i) * (size_t)w, a = table->area[2 * i % h],
                    b = table->area[2 * i % h + 1], whole = 2.0f * (a + b);
        float *to = out + (size_t)i * (size_t)(w / 2);
        for (int32_t x = 0; x < w / 2; ++x) {
            to[x] = ((from[2 * x] + from[2 * x + 1]) * a + (from[w + 2 * x] + from[w + 2 * x + 1]) * b) / whole;
        }
    }
    return LMB_OK;
}

/* Value at column x of row y of a map: rows past a pole are rotated by half a turn, columns wrap. */
static float map_at(const float *plane, const lmb_probe_table *t, int32_t x, int32_t y)
{
    const int32_t w = t->width, h = t->height, real = y < 0 ? -1 - y : y >= h ? 2 * h - 1 - y : y;
    return plane[real * w + (x + (real == y ? 0 : w / 2) + w) % w];
}

lmb_status lmb_probe_map_cube(float *cube, int32_t n, const float *map, const lmb_probe_table *table)
{
    if (cube == NULL || map == NULL || table == NULL || table->width < 1 || n < 1 || n > 64) {
        return LMB_ERR_ARG;
    }
    for (int32_t i = 0; i < 6 * n * n; ++i) {
        const lmb_vec3 d = cube_nth_direction(i, n);
        const float turn = (lmb_atan2(d.x, -d.z) - table->start) * (1.0f / (2.0f * LMB_PI)) + 2.0f;
        const float u = (turn - floorf(turn)) * (float)table->width + 0.5f,
                    v = lmb_acos(d.y) * (1.0f / LMB_PI) * (float)table->height + 0.5f;
        const int32_t x = (int32_t)u, y = (int32_t)v;
        const float fx = u - (float)x, fy = v - (float)y;
        for (int32_t c = 0; c < 3; ++c) {
            const float *plane = map + (size_t)c * (size_t)table->width * (size_t)table->height;
            const float above = map_at(plane, table, x - 1, y - 1) * (1.0f - fx) + map_at(plane, table, x, y - 1) * fx,
                        below = map_at(plane, table, x - 1, y) * (1.0f - fx) + map_at(plane, table, x, y) * fx;
            cube[(size_t)c * 6 * (size_t)(n * n) + (size_t)i] = above * (1.0f - fy) + below * fy;
        }
    }
    return LMB_OK;
}

#endif
