/* program.c: the parts of a main function that lambent and lambent-bench share. */
#include "program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lambent/lambent.h>

#include "../../platform/host/host.h"
#include "../../platform/host/limit.h"
#include "../common/command_name.h"
#include "../common/io_file.h"
#include "../common/options.h"
#include "../common/progress.h"

static int is_one_of(const char *word, const char *a, const char *b)
{
    return strcmp(word, a) == 0 || strcmp(word, b) == 0;
}

/* --- help --------------------------------------------------------------------------------------------------------- */

enum { HELP_WORDS = 4 };

/* Prints help for these words, like WORD ... --help. */
static int help(const program *p, int count, char **words)
{
    static char name[] = "lambent", ask[] = "--help";
    char *argv[HELP_WORDS + 3] = {name};
    int argc = 1;
    for (; argc <= count && argc <= HELP_WORDS; ++argc) {
        argv[argc] = words[argc - 1];
    }
    argv[argc++] = ask;
    argv[argc] = NULL;
    return p->run(argc, argv);
}

static void print_upper(const char *text)
{
    for (; *text != '\0'; ++text) {
        putchar(*text >= 'a' && *text <= 'z' ? *text - 'a' + 'A' : *text);
    }
}

static int print_man(const program *p)
{
    int status = 0;
    options_form(1);
    fputs(".TH ", stdout);
    print_upper(p->name);
    printf(" 1 \"\" \"lambent %d.%d.%d\" \"User Commands\"\n.SH NAME\n%s \\- %s\n.SH SYNOPSIS\n.nf\n",
           LMB_VERSION / 10000, LMB_VERSION / 100 % 100, LMB_VERSION % 100, p->name, p->title);
    p->print_synopsis();
    fputs(".fi\n", stdout);
    for (int i = 0; i < p->text_count && status == 0; ++i) {
        char words[PROGRAM_TEXT_WORDS][16];
        char *both[PROGRAM_TEXT_WORDS] = {words[0], words[1]};
        int count = 0;
        for (; count < PROGRAM_TEXT_WORDS && p->texts[i][count] != NULL; ++count) {
            snprintf(words[count], sizeof words[count], "%s", p->texts[i][count]);
        }
        status = help(p, count, both);
    }
    return status;
}

/* `help` and `--help`, with or without the words of a verb. */
static int answer_help(const program *p, int argc, char **argv)
{
    if (argc > 2 && strcmp(argv[2], "--man") == 0) {
        return print_man(p);
    }
    if (argc > 2 && strcmp(argv[2], "help") != 0 && (argv[2][0] != '-' || !p->has_verbs)) {
        return help(p, argc - 2, argv + 2);
    }
    p->print_usage();
    return 0;
}

/* --- all ---------------------------------------------------------------------------------------------------------- */

/* In a signal handler, before the program ends. */
static void clean_up(void)
{
    file_drop_aside();
    progress_wipe();
}

static char over_line[160];

/* Called by the thread of --time-limit. It holds the limit, so no file is being written. */
static void end_over(void)
{
    file_drop_aside();
    file_drop_written();
    progress_wipe();
    host_print_now(over_line, strlen(over_line));
}

static const char *verb_name; /* "" if the program has no verbs */

static int limit(double seconds)
{
    snprintf(over_line, sizeof over_line,
             "%.40s: --time-limit %g: the time is over; what this command has written is removed\n",
             command_name(verb_name), seconds);
    file_keep_names();
    if (!limit_time(seconds, end_over)) {
        fprintf(stderr, "%.40s: --time-limit: the system gives no thread that could keep it\n",
                command_name(verb_name));
        exit(1);
    }
    return 1;
}

static int start(const program *p, int argc, char **argv)
{
    if (argc >= 2 && (is_one_of(argv[1], "--help", "-h") || strcmp(argv[1], "help") == 0)) {
        return answer_help(p, argc, argv);
    }
    if (argc >= 2 && is_one_of(argv[1], "--version", "-V")) {
        options_version(stdout);
        return 0;
    }
    if (lmb_build_check() != LMB_OK && (argc < 2 || strcmp(argv[1], "doctor") != 0)) {
        fputs("lambent: this build does not compute like others (contraction, fast math or flushed denormals): pixels "
              "would differ; build with the Makefile's flags; lambent doctor tells more\n", stderr);
        return 1;
    }
    return p->run(argc, argv);
}

/* Buffered output may still meet a full disk. */
int program_main(const program *p, int argc, char **argv)
{
    report r = {""};
    command_program(p->name);
    host_take_streams();
    host_outlive_file_limit();
    host_end_cleanly(clean_up);
    verb_name = argc >= 2 && p->has_verbs ? argv[1] : "";
    options_limit_by(limit);
    report_hold_notes();
    const int status = start(p, argc, argv);
    report_print_notes();
    limit_end();
    file_keep_end();
    return status != 0 || report_flush(&r) ? status : report_end(&r, verb_name, 1);
}
