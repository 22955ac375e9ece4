/* slice_items.h: one of N slices of a work, and which items of the work it has. */
#ifndef SLICE_ITEMS_H
#define SLICE_ITEMS_H

#include <stdint.h>

/* Which one: number 1 .. count. count 0: the whole work in one. */
typedef struct slice {
    int32_t number, count;
} slice;

/* Items 0 .. total - 1 go to the slices to and fro: 1 .. N, N .. 1, 1 .. N, so that each has as many, of all parts of
 * the work, and none always the first of its neighbours. slice_items: how many a slice has. slice_item: its kth. */
int32_t slice_items(slice s, int32_t total);
int32_t slice_item(slice s, int32_t k);
int slice_has(slice s, int32_t item);

#endif
