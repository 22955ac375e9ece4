/* command_name.c: the name of the program, for messages and help. */
#include "command_name.h"

#include <stdio.h>

static const char *program = "lambent";

void command_program(const char *name) { program = name; }

const char *command_name(const char *verb)
{
    static char name[64];
    snprintf(name, sizeof name, "%.20s%s%.40s", program, verb[0] != '\0' ? " " : "", verb);
    return name;
}
