/* verb_relief.h: `lambent relief`. */
#ifndef VERB_RELIEF_H
#define VERB_RELIEF_H

/* argv[0] is the verb. Returns the exit status: 0 done, 1 file error, 2 bad usage. */
int verb_relief(int argc, char **argv);

/* The same; argv[0] is "bake". */
int verb_relief_bake(int argc, char **argv);

/* The same; argv[0] is "render". */
int verb_relief_render(int argc, char **argv);

#endif
