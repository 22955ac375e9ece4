/* text_block.h: how a program on a console sends text to lrhost: a block in main memory that begins with eight marks,
 * followed by the number of bytes and the bytes. lrhost searches for the marks; all words are little-endian. */
#ifndef TEXT_BLOCK_H
#define TEXT_BLOCK_H

#include <stdint.h>

enum { TEXT_MARKS = 8, TEXT_BYTES = 4096 };

#define TEXT_MARK(i) (0x9e3779b9u * ((uint32_t)(i) + 1u) ^ 0x7e470000u)

typedef struct text_block {
    uint32_t marks[TEXT_MARKS];
    volatile uint32_t bytes;
    volatile char text[TEXT_BYTES];
} text_block;

/* In RAM, not in ROM, so that the marks occur once. */
#define TEXT_BLOCK                                                                                              \
    {                                                                                                           \
        {TEXT_MARK(0), TEXT_MARK(1), TEXT_MARK(2), TEXT_MARK(3), TEXT_MARK(4), TEXT_MARK(5), TEXT_MARK(6),      \
         TEXT_MARK(7)},                                                                                         \
            0, { 0 }                                                                                            \
    }

/* Drops text that does not fit. */
static inline void text_block_put(text_block *block, const char *text)
{
    for (uint32_t at = block->bytes; *text && at < TEXT_BYTES; block->bytes = ++at)
        block->text[at] = *text++;
}

#endif
