/* main_baked.c: main_live.c with light that surfaces throw back. */
#define BAKED 1
#include "main_live.c"
