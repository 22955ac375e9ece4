/* ending.h: tests the ending of a file name. */
#ifndef ENDING_H
#define ENDING_H

/* has_ending: returns whether the name ends in `ending` (lower case, with the dot, as ".png"), ignoring case. */
int has_ending(const char *name, const char *ending);

#endif
