/* ending.h: how a file's name ends. */
#ifndef ENDING_H
#define ENDING_H

/* Does the name end in `ending` (lower case, with its point, as ".png"), in letters of either case? */
int has_ending(const char *name, const char *ending);

#endif
