/* relief_path.h: pictures of a relief along a path of the camera and the light. */
#ifndef RELIEF_PATH_H
#define RELIEF_PATH_H

#include "../common/key_path.h"
#include "relief_draw.h"
#include "relief_options.h"

extern const option_row relief_path_rows[];

/* relief_path_check: are the path's options consistent? Returns 1, or 0 with `r` set. */
int relief_path_check(const relief_options *o, report *r);

/* relief_path_open: reads the path, if there is one; `light` is the light without it. Returns 1, or 0 with `r` set;
 * call key_path_free in either case. relief_path_leads: does the path move KEY_CAMERA or KEY_LIGHT? */
int relief_path_open(key_path *out, const relief_options *o, const lmb_light *light, report *r);
int relief_path_leads(const key_path *path, int what);

/* Writes one picture. Returns 1, or 0 with `r` set. */
typedef int relief_write(relief_options *o, relief_frame *f, const char *path, report *r);

/* relief_along: draws all pictures of the path. `shot` uses `light`; `simple` is the scene of the relief's simple
 * model. If the path does not move the camera or the light, it stays as set. Returns 1, or 0 with `r` set. */
int relief_along(relief_options *o, const key_path *path, relief_shot *shot, lmb_light *light, const lmb_scene *simple,
                 relief_write *write, report *r);

#endif
