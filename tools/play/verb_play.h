/* verb_play.h: `lambent play`. */
#ifndef VERB_PLAY_H
#define VERB_PLAY_H

/* argv[0] is "play". Returns the exit status: 0 done, 1 failed, 2 bad usage. */
int verb_play(int argc, char **argv);

#endif
