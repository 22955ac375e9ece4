/* notes.c: notes that wait until the set-up of a command has succeeded, so that an error is the only line. */
#include "notes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text_clean.h"

static struct waiting_notes {
    char *text;
    size_t size, cap;
    int is_on;
} waiting;

void notes_hold(void) { waiting.is_on = 1; }

void notes_drop(void)
{
    free(waiting.text);
    memset(&waiting, 0, sizeof waiting);
}

int notes_wait(void) { return waiting.is_on; }

void notes_print(void)
{
    if (waiting.size > 0) {
        fwrite(waiting.text, 1, waiting.size, stderr);
    }
    if (waiting.is_on) {
        notes_drop();
    }
}

int notes_add(const char *name, const char *format, va_list args)
{
    va_list again;
    va_copy(again, args);
    const int n = vsnprintf(NULL, 0, format, again);
    va_end(again);
    const size_t head = strlen(name) + 2, body = (n < 0 ? 0 : (size_t)n) + 1, needed = waiting.size + head + body + 1;
    if (!waiting.is_on) {
        return 0;
    }
    if (needed > waiting.cap) {
        char *more = realloc(waiting.text, 2 * needed);
        if (more == NULL) {
            return 0;
        }
        waiting.text = more;
        waiting.cap = 2 * needed;
    }
    char *out = waiting.text + waiting.size;
    sprintf(out, "%s: ", name);
    va_copy(again, args);
    text_format(out + head, body, format, again);
    va_end(again);
    strcat(out + head, "\n");
    waiting.size += strlen(out);
    return 1;
}
