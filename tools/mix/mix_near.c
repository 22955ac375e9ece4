/* mix_near.c: light from around that the samples of a pixel share. */
#include "mix_near.h"

#include <string.h>

/* Within half a leaf, and facing the same way to some twelve degrees. */
static int is_near(const mix_near *n, const lmb_tile *tile, int k, float leaf)
{
    float far = 0.0f, turn = 0.0f;
    for (int c = 0; c < 3; ++c) {
        const float d = n->tile.position[c][k] - tile->position[c][k];
        far += d * d;
        turn += n->tile.normal[c][k] * tile->normal[c][k];
    }
    return n->tile.id[k] != 0 && far <= 0.25f * leaf * leaf && turn >= 0.98f;
}

void mix_cones_near(lmb_irradiance *inout, const mix_job *j, const lmb_tile *tile, mix_near *near)
{
    int of[LMB_TILE_PIXELS], count = 0;
    lmb_irradiance light;
    memset(&light, 0, sizeof light);
    memset(&near->asked, 0, sizeof near->asked);
    for (int k = 0; k < LMB_TILE_PIXELS; ++k) {
        if (tile->id[k] != 0 && !is_near(near, tile, k, j->world->voxels.leaf)) {
            mix_put_place(&near->asked, count, tile, k);
            of[count++] = k;
        }
    }
    if (count > 0) {
        mix_cones_tile(&light, j, &near->asked);
    }
    for (int n = 0; n < count; ++n) {
        mix_put_place(&near->tile, of[n], tile, of[n]);
        for (int c = 0; c < 3; ++c) {
            near->light.rgb[c][of[n]] = light.rgb[c][n];
        }
    }
    for (int k = 0; k < 3 * LMB_TILE_PIXELS; ++k) {
        if (tile->id[k % LMB_TILE_PIXELS] != 0) {
            inout->rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS] +=
                near->light.rgb[k / LMB_TILE_PIXELS][k % LMB_TILE_PIXELS];
        }
    }
}
