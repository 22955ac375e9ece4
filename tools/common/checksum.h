/* checksum.h: the checksum of .lmp, .lmr and .lmt files, which tells damage that leaves a readable file.
 *
 * The last word of the header is FNV-1a, of 32 bits, of the file's other bytes in their order, and 1 in place of 0; 0
 * says that there is none. Any change of one byte changes it. The tool reads every byte anyway and checks it; the
 * library, which opens files in place in flash, passes it over. */
#ifndef CHECKSUM_H
#define CHECKSUM_H

#include "io_file.h"

/* checksum_put: into a file of whole words, whose header has `words` of them; in the file's byte order. */
void checksum_put(file_bytes *inout, int words);

/* checksum_fits: 0 where bytes of the file, which is as long as its header says, are others than were written. */
int checksum_fits(const uint8_t *data, size_t size, int words);

#endif
