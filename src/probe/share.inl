/* share.inl: adds a map's light, two by two texels, to the nine nearest of 6 x 8 x 8 directions. Layer 5. [S14]
 *
 * The weights preserve the sum, mean position and spread of the lights, so light that is smooth over three texels comes
 * out right. With four texels, which spread more, the error is half as large again; with one it is two to three times
 * as large.
 *
 * Three texels in a row are twelve adjacent numbers; a fourth with weight 0 makes whole vectors on any backend. Lanes
 * are these numbers. */

enum { SHARE_LANES = 16, SHARE_SIDE = LMB_PROBE_SIDE + 2 };

/* Coefficients of the parabola through the middles of three texels, at t -0.5 .. 0.5 from the second: square t^2 + line
 * t + flat. */
static const float share_square[SHARE_LANES] = {0.5f, 0.5f, 0.5f, 0.5f, -1, -1, -1, -1, 0.5f, 0.5f, 0.5f, 0.5f};
static const float share_line[SHARE_LANES] = {-0.5f, -0.5f, -0.5f, -0.5f, 0, 0, 0, 0, 0.5f, 0.5f, 0.5f, 0.5f};
static const float share_flat[SHARE_LANES] = {0, 0, 0, 0, 1, 1, 1, 1};

LANE_INLINE float share_place(uint8_t code) { return (float)code * (1.0f / 255.0f) - 0.5f; }

/* Sums red, green, blue and solid angle of four texels, repeated four times. */
LANE_INLINE void share_light(float light[SHARE_LANES], const float *at, size_t plane, int32_t width,
                             const float area[2])
{
    light[3] = 2.0f * (area[0] + area[1]);
    for (int c = 0; c < 3; ++c) {
        const float *row = at + (size_t)c * plane;
        light[c] = (row[0] + row[1]) * area[0] + (row[width] + row[width + 1]) * area[1];
    }
    for (int c = 4; c < SHARE_LANES; ++c) {
        light[c] = light[c - 4];
    }
}

LANE_INLINE void share_add(float *to, const lmb_probe_share *at, const float light[SHARE_LANES])
{
    const float t = share_place(at->y), down[3] = {0.5f * t * (t - 1.0f), 1.0f - t * t, 0.5f * t * (t + 1.0f)};
    const lane x = lane_splat(share_place(at->x)), x2 = lane_mul(x, x);
    for (int k = 0; k < SHARE_LANES; k += LANES) {
        const lane across = lane_add(lane_add(lane_mul(lane_load(share_square + k), x2),
                                              lane_mul(lane_load(share_line + k), x)), lane_load(share_flat + k));
        const lane value = lane_mul(across, lane_load(light + k));
        for (int i = 0; i < 3; ++i) {
            float *row = to + 4 * SHARE_SIDE * i + k;
            lane_store(row, lane_add(lane_load(row), lane_mul(lane_splat(down[i]), value)));
        }
    }
}

/* Processes eight at a time, because a vector load right after the scalar stores would stall. */
static void KERNEL(share)(float (*shared)[4], const float *map, const lmb_probe_table *table)
{
    const int32_t width = table->width, count = width * table->height;
    float light[8][SHARE_LANES];
    for (int32_t i = 0; i < count / 4; i += 8) {
        const int32_t y = 2 * (i / (width / 2)), at = y * width + 2 * (i % (width / 2));
        for (int32_t k = 0; k < 8; ++k) {
            share_light(light[k], map + at + 2 * k, (size_t)count, width, table->area + y);
        }
        for (int32_t k = 0; k < 8; ++k) {
            share_add(shared[table->share[i + k].slot], &table->share[i + k], light[k]);
        }
    }
}
