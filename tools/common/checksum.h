/* checksum.h: the checksum of .lmp, .lmr and .lmt files, to detect damage that leaves a file readable. The last word of
 * the header is the 32-bit FNV-1a hash of all other bytes in order. 1 replaces a hash of 0, and 0 means no checksum.
 * Any change of one byte changes the hash. The tool reads every byte anyway and checks it. The library opens files in
 * place in flash, and does not check. */
#ifndef CHECKSUM_H
#define CHECKSUM_H

#include "io_file.h"

/* checksum_put: sets the checksum of a file of whole words with a header of `words` words, in the file's byte order. */
void checksum_put(file_bytes *inout, int words);

/* checksum_fits: returns 0 if bytes of the file differ from those written; the size must be as in the header. */
int checksum_fits(const uint8_t *data, size_t size, int words);

#endif
