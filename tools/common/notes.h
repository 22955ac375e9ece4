/* notes.h: notes that wait until the set-up of a command has succeeded, so that an error is the only line. */
#ifndef NOTES_H
#define NOTES_H

#include <stdarg.h>

/* notes_hold: from now on notes wait. notes_add: keeps the line "NAME: TEXT" and returns 1, or returns 0 if notes do
 * not wait, or memory is short. notes_wait: returns 1 from notes_hold until notes_print, which prints the notes on
 * stderr, or notes_drop, which forgets them. One thread at a time. */
void notes_hold(void);
int notes_wait(void);
int notes_add(const char *name, const char *format, va_list args);
void notes_print(void);
void notes_drop(void);

#endif
