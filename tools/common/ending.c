/* ending.c: tests the ending of a file name. */
#include "ending.h"

#include <ctype.h>
#include <string.h>

int has_ending(const char *name, const char *ending)
{
    const size_t n = strlen(name), e = strlen(ending);
    for (size_t i = 0; n >= e && i < e; ++i) {
        if (tolower((unsigned char)name[n - e + i]) != ending[i]) {
            return 0;
        }
    }
    return n >= e;
}
