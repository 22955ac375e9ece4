/* options_table.h: what reading command lines and printing their help have in common. */
#ifndef OPTIONS_TABLE_H
#define OPTIONS_TABLE_H

#include "options.h"

/* Row i of all parts, or NULL behind the last one and for i < 0. */
const option_row *options_row(const option_table *t, int i);

int options_has_value(const option_row *row);

/* What stands behind the name of an option: "WxH", "full|direct"; "" where it has no value. */
void options_value(char *out, size_t size, const option_row *row);

/* What an option is for, with its range. */
void options_text(char *out, size_t size, const option_row *row);

const char *options_status(const option_table *t);

/* What a value has to be, for `is not ...` and `wants a value: ...`. */
void options_wants(char *out, size_t size, const option_row *row);

#endif
