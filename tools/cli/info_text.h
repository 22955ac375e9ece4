/* info_text.h: what `lambent info` prints: labelled lines, or JSON. */
#ifndef INFO_TEXT_H
#define INFO_TEXT_H

#include <stdio.h>

#include <lambent/types.h>

/* json_text: a JSON string; bytes that are not UTF-8 become U+FFFD. json_vec3: a member of three numbers. */
void json_text(FILE *out, const char *text);
void json_vec3(FILE *out, const char *name, lmb_vec3 v);

/* plain_text: names may hold anything; a line of text stays one line. label: a line's label, or blanks under the one
 * before. */
void plain_text(FILE *out, const char *text);
void label(FILE *out, const char *text);

#endif
