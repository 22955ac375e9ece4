/* notes.h: notes that wait until the set-up of a command has succeeded, so that an error is the only line. */
#ifndef NOTES_H
#define NOTES_H

#include <stdarg.h>

/* notes_hold: from now on notes wait. notes_add: keeps the line "NAME: TEXT" and returns 1, or returns 0 if notes do
 * not wait, or memory is short. notes_tell: prints them on stderr. notes_drop: forgets them. After either call notes
 * no longer wait. One thread at a time. */
void notes_hold(void);
int notes_add(const char *name, const char *format, va_list args);
void notes_tell(void);
void notes_drop(void);

#endif
