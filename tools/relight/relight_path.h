/* relight_path.h: a file of places, X,Y,Z a line; empty lines and those that begin with # are nothing. */
#ifndef RELIGHT_PATH_H
#define RELIGHT_PATH_H

#include <lambent/types.h>

#include "../common/report.h"

typedef struct place_list {
    lmb_vec3 *place;
    int32_t count;
} place_list;

/* 1, or 0 with `r` set; place_list_free releases it in either case. */
int place_list_read(place_list *out, const char *path, report *r);
void place_list_free(place_list *list);

#endif
