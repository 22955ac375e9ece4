/* main_torus_few.c: main_torus.c with a quarter of the pixels in all frames but the first, for tests/scripts/tiny.sh. */
#define OTHERS 80
#include "main_torus.c"
