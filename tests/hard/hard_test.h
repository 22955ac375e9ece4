/* hard_test.h: what the program of hard cases is made of besides its table. */
#ifndef HARD_TEST_H
#define HARD_TEST_H

#include "../../tools/hard/hard.h"
#include "../test.h"

/* Sanitizers slow frames down tenfold and more: a few of each are enough there. */
#if defined(__SANITIZE_ADDRESS__)
#define HARD_FEWER 5
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
#define HARD_FEWER 5
#endif
#endif
#ifndef HARD_FEWER
#define HARD_FEWER 1
#endif

/* What must not matter, over random scenes. */
void hard_invariants(hard_stage *stage);

/* The same call, thousands of times. */
void hard_again(hard_stage *stage);
void hard_masks(hard_stage *s);

#endif
