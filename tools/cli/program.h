/* program.h: the parts of a main function that lambent and lambent-bench share: help, man page, version, time limit,
 * signals, and whether standard output could be written. */
#ifndef PROGRAM_H
#define PROGRAM_H

enum { PROGRAM_TEXT_WORDS = 2 };

typedef struct program {
    const char *name, *title;                /* title: the line of the man page */
    int has_verbs;                           /* messages have the first word behind the name */
    int (*run)(int argc, char **argv);       /* argv[1] is the first word; returns the exit status */
    void (*print_usage)(void);               /* --help */
    void (*print_synopsis)(void);            /* lines of the man page, each with the name */
    const char *const (*texts)[PROGRAM_TEXT_WORDS]; /* the words in front of --help, NULL for none, of each help text */
    int text_count;
} program;

/* program_main: returns the exit status. */
int program_main(const program *p, int argc, char **argv);

#endif
