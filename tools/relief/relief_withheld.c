/* relief_withheld.c: a picture of a relief beside a photo that it was not made of. */
#include "relief_withheld.h"

#include <math.h>

#include "relief_compare.h"

void withheld_measure(withheld_figures *out, const relief_frame *frame, const relief_photo *photo)
{
    const size_t pixels = (size_t)frame->width * (size_t)frame->height;
    size_t shown = 0;
    double sum = 0.0;
    for (size_t i = 0; i < pixels; ++i) {
        if (frame->depth[i] > 0.0f) {
            sum += relief_squared(frame->albedo + 3 * i, photo->colour + 3 * i);
            ++shown;
        }
    }
    out->db = shown == 0 ? -1.0 : sum > 0.0 ? 10.0 * log10(255.0 * 255.0 * 3.0 * (double)shown / sum) : 99.0;
    out->shown = (double)shown / (double)pixels;
    out->filled = (double)frame->stats.holes / (double)pixels;
}
