/* options_table.c: the rows of a verb's table, numbered over all parts. */
#include "options_table.h"

#include <string.h>

const option_row *options_row(const option_table *t, int i)
{
    for (int part = 0; part < OPTION_PARTS && t->part[part] != NULL; ++part) {
        for (const option_row *row = t->part[part]; row->kind != OPTION_END; ++row) {
            if (i-- == 0) {
                return row;
            }
        }
    }
    return NULL;
}

int options_has_value(const option_row *row) { return row->kind > OPTION_FLAG; }

const char *options_key(const option_row *row)
{
    const char *blank = row->name != NULL && row->name[0] == '-' ? strchr(row->name, ' ') : NULL;
    return blank != NULL ? blank + 1 : NULL;
}
