/* bake_words.c: the growing words of a file's sections; which triangles are small. */
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bake_triangle.h"

int bake_put(bake_words *w, uint32_t word, report *r)
{
    if (w->count == w->cap) {
        const size_t cap = w->cap > 0 ? 2 * w->cap : 1024;
        uint32_t *data = cap < SIZE_MAX / 8 ? realloc(w->data, cap * sizeof *data) : NULL;
        if (data == NULL) {
            return report_fail(r, "not enough memory for %.0f words", (double)cap);
        }
        w->data = data;
        w->cap = cap;
    }
    w->data[w->count++] = word;
    return 1;
}

int bake_put_float(bake_words *w, float v, report *r)
{
    uint32_t word;
    memcpy(&word, &v, sizeof word);
    return bake_put(w, word, r);
}

int32_t bake_cell(float at, float per) { return (int32_t)clampf(floorf(at * per), -1e9f, 1e9f); }

int bake_is_small(const bake *b, const lmb_vec3 corner[3])
{
    int from;
    return triangle_longest(&from, corner) < b->small_m;
}
