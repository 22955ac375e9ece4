/* c_name.h: names of arrays in C code that goes into programs of any C or C++. */
#ifndef C_NAME_H
#define C_NAME_H

#include <stddef.h>

#include "../common/report.h"

enum { C_NAME = 64 };

/* c_name_check: is this a name for an array that compiles as C99 .. C23 and as C++, and links with any program?
 * Letters, digits and single _, first a letter, under 64 characters; no keyword, no name or macro of the C library,
 * POSIX or the usual compilers, nothing that begins with lmb_ or LMB_. NULL, or what is against it. */
const char *c_name_check(const char *name);

/* c_name_of: a name that passes, of a file's: up to its first dot, with _ for each run of other characters; where that
 * does not pass, behind scene_; `scene` where nothing is left. Long ones are cut. */
void c_name_of(char out[C_NAME], const char *path);

#endif
