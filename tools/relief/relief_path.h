/* relief_path.h: pictures of a relief along a path: where its camera and its light are in each. */
#ifndef RELIEF_PATH_H
#define RELIEF_PATH_H

#include "../common/key_path.h"
#include "relief_draw.h"
#include "relief_options.h"

extern const option_row relief_path_rows[];

/* relief_path_check: do the path's options go together? 1, or 0 with `r` set. */
int relief_path_check(const relief_options *o, report *r);

/* relief_path_open: the path, if there is one; `light` is what would shine without it. 1, or 0 with `r` set; key_path_free
 * releases it in either case. relief_path_leads: is the camera among what it moves? */
int relief_path_open(key_path *out, const relief_options *o, const lmb_light *light, report *r);
int relief_path_leads(const key_path *path);

/* Writes one picture. 1, or 0 with `r` set. */
typedef int relief_write(relief_options *o, relief_frame *f, const char *path, report *r);

/* relief_along: all pictures of the path. `shot` is drawn by `light`, `simple` is its relief's scene; both are where they
 * are without a path. 1, or 0 with `r` set. */
int relief_along(relief_options *o, const key_path *path, relief_shot *shot, lmb_light *light, const lmb_scene *simple,
                 relief_write *write, report *r);

#endif
