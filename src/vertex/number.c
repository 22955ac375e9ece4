/* number.c: the tables of number.h. Layer 8. */
#include "number.h"

#include "number_tables.inc"
