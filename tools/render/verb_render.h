/* verb_render.h: `lambent render`. */
#ifndef VERB_RENDER_H
#define VERB_RENDER_H

/* verb_render: argv[0] is "render". Returns the exit status: 0 done, 1 failed, 2 bad usage. */
int verb_render(int argc, char **argv);

#endif
