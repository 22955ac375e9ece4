/* command_name.h: the name of the program for messages and help. */
#ifndef COMMAND_NAME_H
#define COMMAND_NAME_H

/* command_program: sets the name of the program; `lambent` by default. command_name: returns the name with the verb
 * behind it, or only the name if the verb is "". The text is valid until the next call. */
void command_program(const char *name);
const char *command_name(const char *verb);

#endif
