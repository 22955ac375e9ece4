/* slice_items.c: the items of a job that belong to a slice. */
#include "slice_items.h"

int32_t slice_item(slice s, int32_t k)
{
    return s.count == 0 ? k : k * s.count + (k % 2 == 0 ? s.number - 1 : s.count - s.number);
}

int32_t slice_items(slice s, int32_t total)
{
    const int32_t rounds = s.count == 0 ? total : total / s.count;
    return s.count == 0 ? total : rounds + (slice_item(s, rounds) < total);
}

int slice_has(slice s, int32_t item) { return s.count == 0 || slice_item(s, item / s.count) == item; }
