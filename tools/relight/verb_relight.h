/* verb_relight.h: `lambent relight`: the light at a place of a world that was captured at another. */
#ifndef VERB_RELIGHT_H
#define VERB_RELIGHT_H

/* argv[0] is the verb. Returns the exit status: 0 done, 1 failed, 2 bad usage. */
int verb_relight(int argc, char **argv);

#endif
