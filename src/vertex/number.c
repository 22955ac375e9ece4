/* number.c: the tables of number.h. Layer 10. */
#include "number.h"

#include "number_tables.inc"
