/* sections.h: how many words an entry of each section of a .lmt has. Layer 9. */
#ifndef LMB_TRANSFER_SECTIONS_H
#define LMB_TRANSFER_SECTIONS_H

#include <lambent/transfer.h>

static const uint32_t transfer_words_each[LMB_TRANSFER_SECTIONS] = {
    LMB_TRANSFER_SURFACE_WORDS,  1, 1, 1, LMB_TRANSFER_CORNER_WORDS, LMB_TRANSFER_RECEIVER_WORDS, 1,
    LMB_TRANSFER_BLEND_WORDS, LMB_TRANSFER_CLUSTER_WORDS, LMB_TRANSFER_CLUSTER_LINK_WORDS, LMB_TRANSFER_COARSE_WORDS, 1};

#endif
