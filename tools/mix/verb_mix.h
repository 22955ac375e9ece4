/* verb_mix.h: `lambent mix`: a virtual object in one photo with depth. */
#ifndef VERB_MIX_H
#define VERB_MIX_H

/* argv[0] is the verb. Returns the exit status. */
int verb_mix(int argc, char **argv);

#endif
