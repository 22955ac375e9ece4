/* verb_pack.h: `lambent pack`. */
#ifndef VERB_PACK_H
#define VERB_PACK_H

/* Returns the exit status. */
int verb_pack(int argc, char **argv);

#endif
