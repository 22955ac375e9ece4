/* relight_export.h: the light at a place as files for other programs. */
#ifndef RELIGHT_EXPORT_H
#define RELIGHT_EXPORT_H

#include "relight_light.h"

/* relight_exports: does `o` request such a file? relight_export_check: are the options consistent? Returns 1, or 0 with
 * `r` set. */
int relight_exports(const relight_options *o);
int relight_export_check(const relight_options *o, report *r);

/* relight_export: writes all such files for one place. Returns 1, or 0 with `r` set. */
int relight_export(relight_light *w, const relight_options *o, lmb_vec3 at, report *r);

#endif
