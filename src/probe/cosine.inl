/* cosine.inl: irradiance of normals from lights in all directions. Layer 5.                                       [S14]
 *
 * Pi times the mean of the lights weighted by max(0, n . d), plus peaks along their own directions. Lanes are
 * normals. */

static void KERNEL(cosine)(float out[3][LMB_TILE_PIXELS], float normal[3][LMB_TILE_PIXELS],
                           const lmb_probe_lights *lights, const float *direction)
{
    const float *x = direction, *y = x + LMB_PROBE_TEXELS, *z = y + LMB_PROBE_TEXELS;
    const lane zero = lane_splat(0.0f);
    for (int k = 0; k < LMB_TILE_PIXELS; k += LANES) {
        const lane3 n = {lane_load(normal[0] + k), lane_load(normal[1] + k), lane_load(normal[2] + k)};
        lane3 sum = {zero, zero, zero};
        lane weight = zero;
        for (int j = 0; j < LMB_PROBE_TEXELS; ++j) {
            const lane cosine = lane_max(lane3_dot(n, lane3_splat(x[j], y[j], z[j])), zero);
            sum.x = lane_add(sum.x, lane_mul(cosine, lane_splat(lights->rgbw[0][j])));
            sum.y = lane_add(sum.y, lane_mul(cosine, lane_splat(lights->rgbw[1][j])));
            sum.z = lane_add(sum.z, lane_mul(cosine, lane_splat(lights->rgbw[2][j])));
            weight = lane_add(weight, lane_mul(cosine, lane_splat(lights->rgbw[3][j])));
        }
        const lane scale = lane_div(lane_splat(3.14159274f), weight);
        sum = lane3_scale(sum, scale);
        for (int32_t j = 0; j < lights->peaks; ++j) {
            const lane3 to = lane3_splat(lights->peak[0][j], lights->peak[1][j], lights->peak[2][j]);
            const lane3 light = lane3_splat(lights->peak[3][j], lights->peak[4][j], lights->peak[5][j]);
            sum = lane3_add(sum, lane3_scale(light, lane_max(lane3_dot(n, to), zero)));
        }
        lane_store(out[0] + k, sum.x);
        lane_store(out[1] + k, sum.y);
        lane_store(out[2] + k, sum.z);
    }
}
