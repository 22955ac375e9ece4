/* c_name.h: names of arrays in C code for any C or C++ program. */
#ifndef C_NAME_H
#define C_NAME_H

#include <stddef.h>

#include "../common/report.h"

enum { C_NAME = 64 };

/* c_name_check: checks that an array with this name compiles as C99 .. C23 and as C++, and links with any program. A
 * valid name has letters, digits and single _, starts with a letter and is under 64 characters. It is no keyword and no
 * name or macro of the C library, POSIX or the usual compilers, and does not begin with lmb_ or LMB_. Returns NULL if
 * the name is valid, else the reason. */
const char *c_name_check(const char *name);

/* c_name_of: makes a valid name from a file name: the part up to the first dot, with _ for each run of other
 * characters. If that is not valid, scene_ is put in front; if nothing is left, the name is `scene`. Long names are
 * truncated. */
void c_name_of(char out[C_NAME], const char *path);

#endif
