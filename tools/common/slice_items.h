/* slice_items.h: one of N slices of a job, and the items that belong to it. */
#ifndef SLICE_ITEMS_H
#define SLICE_ITEMS_H

#include <stdint.h>

/* Number 1 .. count. count 0: the whole job. */
typedef struct slice {
    int32_t number, count;
} slice;

/* Items 0 .. total - 1 are dealt back and forth: 1 .. N, N .. 1, 1 .. N. Each slice gets the same number from all
 * parts of the job, and none always the first of neighbouring items. slice_items: the number of items in a slice.
 * slice_item: item k of a slice. */
int32_t slice_items(slice s, int32_t total);
int32_t slice_item(slice s, int32_t k);
int slice_has(slice s, int32_t item);

#endif
