/* info_text.h: output of `lambent info`: labelled lines, or JSON. */
#ifndef INFO_TEXT_H
#define INFO_TEXT_H

#include <stdio.h>

#include <lambent/types.h>

/* json_text: prints a JSON string; bytes that are not UTF-8 become U+FFFD. json_vec3: a member with three numbers. */
void json_text(FILE *out, const char *text);
void json_vec3(FILE *out, const char *name, lmb_vec3 v);

/* plain_text: prints text on one line, although names may contain line breaks. label: prints the label of a line, or
 * blanks below the one before. */
void plain_text(FILE *out, const char *text);
void label(FILE *out, const char *text);

#endif
