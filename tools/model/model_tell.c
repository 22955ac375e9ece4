/* model_tell.c: prints the notes of a model. */
#include <string.h>

#include "../common/progress.h"
#include "../common/slice.h"
#include "model.h"

enum { TOLD_MAX = 256 };

/* Returns whether the line was printed before: a sweep loads a model for each picture. Adds the line. */
static int is_told(const char *name, const char *line)
{
    static uint64_t told[TOLD_MAX];
    static int count;
    const uint64_t hash = slice_hash(slice_hash(1, name, strlen(name) + 1), line, strlen(line));
    for (int i = 0; i < count; ++i) {
        if (told[i] == hash) {
            return 1;
        }
    }
    if (count < TOLD_MAX) {
        told[count++] = hash;
    }
    return 0;
}

void model_tell(const model_notes *notes, const char *name, int hides)
{
    for (uint32_t i = 0; i < notes->count; ++i) {
        const int is_hidden = (notes->kind[i] & hides) != 0;
        report_note(is_hidden || progress_is_quiet() || is_told(name, notes->line[i]), "note: %s: %s", name,
                    notes->line[i]);
    }
}
