/* verb_bake.h: `lambent bake`, for the program and for tests. */
#ifndef VERB_BAKE_H
#define VERB_BAKE_H

/* verb_bake: runs the verb; argv[0] is "bake". Returns the exit status. */
int verb_bake(int argc, char **argv);

#endif
