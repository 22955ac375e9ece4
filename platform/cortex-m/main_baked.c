/* main_baked.c: main_live.c with bounced light. */
#define BAKED 1
#include "main_live.c"
