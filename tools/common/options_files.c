/* options_files.c: checks the files of a command line: none may be both input and output. */
#include <string.h>

#include "io_file.h"
#include "options_table.h"

/* Name i stored by a row; NULL if the row does not name such files. */
static const char *name_at(const void *out, const option_row *row, int file, int32_t i)
{
    const char *name = NULL;
    if (row->file == file && (i == 0 || i < row->times)) {
        memcpy(&name, (const char *)out + row->at + (size_t)i * row->size, sizeof name);
    }
    return name;
}

static const char *name_of(const void *out, const option_row *row, int file) { return name_at(out, row, file, 0); }

/* Standard input and built-in scenes are not files. */
static int keep_inputs(const void *out, const option_table *t, report *r)
{
    const option_row *row;
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        const char *name;
        for (int32_t k = 0; (name = name_at(out, row, OPTION_READS, k)) != NULL; ++k) {
            if (strcmp(name, "-") != 0 && strcmp(name, "demo") != 0 && !file_keep(name, r)) {
                return 0;
            }
        }
    }
    return 1;
}

/* The row before `end` that writes to the same place; NULL if there is none. */
static const option_row *find_same(const void *out, const option_table *t, int end, const char *name)
{
    for (int i = 0; i < end; ++i) {
        const option_row *row = options_row(t, i);
        const char *other = name_of(out, row, OPTION_WRITES);
        if (other != NULL && file_is_same_place(other, name)) {
            return row;
        }
    }
    return NULL;
}

/* The ending in the placeholder of a row, as in OUT.png; NULL if several are possible. */
static const char *shown_ending(const option_row *row)
{
    const char *at = row->value != NULL ? strchr(row->value, '.') : NULL;
    return at != NULL && strspn(at + 1, "abcdefghijklmnopqrstuvwxyz") == strlen(at + 1) ? at : NULL;
}

/* Checks the name of an output of this row. */
static int check_output(const option_row *row, const char *name, report *r)
{
    const char *ending = shown_ending(row);
    if (file_is_stdout(name)) {
        report_take_stdout();
    }
    return (ending == NULL || file_suits(row->name, name, ending, r)) && file_can_write(name, r);
}

int options_files(const void *out, const option_table *t, report *r)
{
    const option_row *row;
    file_keep_all();
    if (!keep_inputs(out, t, r)) {
        return 0;
    }
    for (int i = 0; (row = options_row(t, i)) != NULL; ++i) {
        const char *name = name_of(out, row, OPTION_WRITES);
        const option_row *same = name != NULL ? find_same(out, t, i, name) : NULL;
        if (same != NULL) {
            return report_fail_usage(r, "%s: both %s and %s; give each another name", name, same->name,
                                     row->name);
        }
        if (name != NULL && !check_output(row, name, r)) {
            return 0;
        }
    }
    return 1;
}
