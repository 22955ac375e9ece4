/* main_torus_few.c: main_torus.c with a quarter of the pixels and a small shadow map in all frames but the first, for
 * tests/scripts/tiny.sh. */
#define OTHERS 80
#define OTHERS_MAP 32
#include "main_torus.c"
