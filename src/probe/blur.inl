/* blur.inl: one row of a map's blur: down the columns, then along the row. Layer 5.                               [S11]
 *
 * Four independent sums hide the latency of additions. Lanes are columns. */

/* Sums rows of `map` times weights. */
LANE_INLINE lane blur_column(const float *map, const float *weight, int32_t height, size_t step)
{
    lane sum[4] = {lane_splat(0.0f), lane_splat(0.0f), lane_splat(0.0f), lane_splat(0.0f)};
    for (int32_t y = 0; y < height; y += 4) {
        for (int i = 0; i < 4; ++i) {
            const lane value = lane_load(map + (size_t)(y + i) * step);
            sum[i] = lane_add(sum[i], lane_mul(lane_splat(weight[y + i]), value));
        }
    }
    return lane_add(lane_add(sum[0], sum[1]), lane_add(sum[2], sum[3]));
}

/* Stores the row twice, so that reads past the end wrap to the start. [S12] */
LANE_INLINE void blur_twice(float *line, int32_t width, int32_t x, lane v)
{
    lane_store(line + x, v);
    lane_store(line + width + x, v);
}

static void KERNEL(blur)(float *inout, float *line, const lmb_blur_job *job)
{
    const int32_t width = job->width, height = job->height;
    const size_t step = (size_t)width;
    float *over = line + 2 * width;
    for (int32_t x = 0; x < width && job->over; x += LANES) {
        blur_twice(over, width, x, blur_column(job->map + x, job->column + height, height, step));
    }
    for (int32_t x = 0; x < width; x += LANES) {
        lane sum = blur_column(job->map + x, job->column, height, step);
        if (job->over) {
            sum = lane_add(sum, lane_load(over + width / 2 + x));
        }
        blur_twice(line, width, x, sum);
    }
    for (int32_t x = 0; x < width; x += LANES) {
        lane_store(inout + x, lane_add(lane_load(inout + x), blur_column(line + x, job->row, width, 1)));
    }
}
