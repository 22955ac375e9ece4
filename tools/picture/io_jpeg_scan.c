/* io_jpeg_scan.c: the entropy-coded data of a JPEG scan: bits, Huffman codes, blocks, restart markers. */
#include "io_jpeg.h"

#include <inttypes.h>
#include <string.h>

const uint8_t jpeg_zigzag[64] = {0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,
                                 12, 19, 26, 33, 40, 48, 41, 34, 27, 20, 13, 6,  7,  14, 21, 28,
                                 35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23, 30, 37, 44, 51,
                                 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

/* --- bits; after a fault they are 0, which ends every block --- */

/* Coefficients are kept in 16 bits, sign included. */
#define VALUE_BITS 15u

static uint32_t set_fault(jpeg_reader *j, int fault)
{
    if (!j->fault) j->fault = fault;
    j->bits = j->bit_count = 0;
    return 0;
}

/* At least 25 bits, unless a marker or the end of the file comes first. FF 00 encodes the byte FF. */
static void fill_bits(jpeg_reader *j)
{
    while (j->bit_count <= 24 && j->at < j->size) {
        uint32_t byte = j->data[j->at];
        if (byte == 0xFF && (j->size - j->at < 2 || j->data[j->at + 1] != 0)) return;
        j->at += byte == 0xFF ? 2 : 1;
        j->bits = j->bits << 8 | byte;
        j->bit_count += 8;
    }
}

/* The next n bits, 1 to 16, without consuming them; zeros after the end. */
static uint32_t peek_bits(jpeg_reader *j, uint32_t n)
{
    uint32_t mask = (1u << n) - 1u;
    if (j->bit_count < n) fill_bits(j);
    if (j->bit_count >= n) return j->bits >> (j->bit_count - n) & mask;
    return j->bits << (n - j->bit_count) & mask;
}

static uint32_t take_bits(jpeg_reader *j, uint32_t n)
{
    uint32_t v = n > 0 ? peek_bits(j, n) : 0;
    if (j->fault || n > j->bit_count) return set_fault(j, JPEG_NO_BITS);
    j->bit_count -= n;
    return v;
}

static uint32_t take_symbol(jpeg_reader *j, const jpeg_code *code)
{
    uint32_t quick = code->quick[peek_bits(j, JPEG_QUICK_BITS)], length = quick >> 8, bits, symbol = quick & 255;
    if (!quick) {
        bits = peek_bits(j, 16);
        for (length = JPEG_QUICK_BITS + 1; length <= 16 && bits >> (16 - length) >= code->limit[length];) ++length;
        if (length > 16) return set_fault(j, j->bit_count < 16 ? JPEG_NO_BITS : JPEG_NO_CODE);
        symbol = code->symbols[(int32_t)(bits >> (16 - length)) + code->offset[length]];
    }
    if (j->fault || length > j->bit_count) return set_fault(j, JPEG_NO_BITS);
    j->bit_count -= length;
    return symbol;
}

/* A number of n bits, times 2^low. The first bit is the sign: 1 for positive. */
static int32_t take_value(jpeg_reader *j, uint32_t n)
{
    int32_t v;
    if (n + j->low > VALUE_BITS) return (int32_t)set_fault(j, JPEG_NO_CODE);
    v = (int32_t)take_bits(j, n);
    if (n > 0 && v < 1 << (n - 1)) v -= (1 << n) - 1;
    return v * (1 << j->low);
}

/* --- blocks --- */

static void take_dc(jpeg_reader *j, jpeg_component *c, int16_t *block)
{
    int32_t dc = c->prediction + take_value(j, take_symbol(j, c->dc));
    if (dc < INT16_MIN || dc > INT16_MAX) dc = (int32_t)set_fault(j, JPEG_NO_CODE);
    c->prediction = dc;
    block[0] = (int16_t)dc;
}

static void refine_dc(jpeg_reader *j, jpeg_component *c, int16_t *block)
{
    (void)c;
    if (take_bits(j, 1)) block[0] = (int16_t)(block[0] + (1 << j->low)); /* that bit is still 0 */
}

/* Counts this block and the following ones of an end-of-band symbol with `run`. */
static void take_empty_run(jpeg_reader *j, uint32_t run)
{
    if (run > 0 && !j->progressive) set_fault(j, JPEG_NO_CODE);
    j->empty_run = (1u << run) + take_bits(j, run);
}

/* Symbols are zeros to skip << 4 | bits of the value that follows; 15 without a value skips 16. */
static void take_ac(jpeg_reader *j, jpeg_component *c, int16_t *block)
{
    uint32_t k, symbol, run;
    for (k = j->first > 0 ? j->first : 1; !j->empty_run && k <= j->last; ++k) {
        symbol = take_symbol(j, c->ac);
        run = symbol >> 4;
        if (!(symbol & 15) && run < 15) {
            take_empty_run(j, run);
            break;
        }
        k += run;
        if (k > j->last) set_fault(j, JPEG_NO_CODE);
        else if (symbol & 15) block[jpeg_zigzag[k]] = (int16_t)take_value(j, symbol & 15);
    }
    if (j->empty_run > 0) --j->empty_run;
}

/* From k on, one more bit for each coefficient that is not 0; to the zero behind `zeros` others, or past the band. */
static uint32_t refine_until(jpeg_reader *j, int16_t *block, uint32_t k, uint32_t zeros)
{
    for (; k <= j->last; ++k) {
        int16_t *value = &block[jpeg_zigzag[k]];
        if (*value == 0) {
            if (zeros-- == 0) break;
        } else if (take_bits(j, 1)) {
            *value = (int16_t)(*value + (*value < 0 ? -(1 << j->low) : 1 << j->low));
        }
    }
    return k;
}

/* As take_ac, but zeros are counted among the coefficients that were 0, and all others refined on the way. */
static void refine_ac(jpeg_reader *j, jpeg_component *c, int16_t *block)
{
    static const int16_t nothing[64];
    uint32_t k = j->first, symbol;
    int value;
    if (j->empty_run > 0) {
        if (j->idle > 0) --j->idle;
        else set_fault(j, JPEG_IDLE);
    }
    while (!j->empty_run && k <= j->last) {
        symbol = take_symbol(j, c->ac);
        if (!(symbol & 15) && symbol >> 4 < 15) {
            take_empty_run(j, symbol >> 4);
            break;
        }
        if ((symbol & 15) > 1) set_fault(j, JPEG_NO_CODE);
        value = !(symbol & 15) ? 0 : take_bits(j, 1) ? 1 << j->low : -(1 << j->low);
        k = refine_until(j, block, k, symbol >> 4);
        if (k > j->last) set_fault(j, JPEG_NO_CODE);
        else block[jpeg_zigzag[k++]] = (int16_t)value;
    }
    if (j->empty_run > 0) {
        if (memcmp(block + 1, nothing + 1, sizeof nothing - sizeof *nothing) != 0) refine_until(j, block, k, 64);
        --j->empty_run;
    }
}

static void take_block(jpeg_reader *j, jpeg_component *c, int16_t *block)
{
    if (!j->progressive) {
        take_dc(j, c, block);
        take_ac(j, c, block);
    } else if (j->first == 0) {
        (j->high ? refine_dc : take_dc)(j, c, block);
    } else {
        (j->high ? refine_ac : take_ac)(j, c, block);
    }
}

/* Reads block x, y of a component; decodes and drops blocks outside. */
static int read_block(jpeg_reader *j, jpeg_component *c, uint32_t x, uint32_t y)
{
    int16_t own[64], *block = own;
    int inside = x < c->blocks_x && y < c->blocks_y;
    size_t stride = (size_t)c->blocks_x * 8, at = (size_t)y * c->blocks_x + x;

    if (inside && j->progressive) block = c->coefficients + 64 * at;
    else memset(own, 0, sizeof own);
    take_block(j, c, block);
    if (j->fault == JPEG_NO_BITS)
        return report_fail(j->r, "%s: the scan ends at byte %zu, before the picture; the file is truncated or damaged",
                           j->name, j->at);
    if (j->fault == JPEG_IDLE)
        return report_fail(j->r, "%s: byte %zu: more scans over an empty picture than a file of %zu bytes may have;"
                           " save it as a baseline JPEG", j->name, j->at, j->size);
    if (j->fault)
        return report_fail(j->r, "%s: no valid code just before byte %zu; the file is damaged", j->name, j->at);
    if (inside && !j->progressive) jpeg_inverse_dct(c->samples + (y * stride + x) * 8, stride, block, c->quant);
    return 1;
}

/* --- scans --- */

/* A single component has only its blocks, in rows; several are interleaved, h x v blocks each. */
static int read_mcu(jpeg_reader *j, uint32_t x, uint32_t y)
{
    uint32_t i, k;
    if (j->scan_count == 1) return read_block(j, j->scan[0], x, y);
    for (i = 0; i < j->scan_count; ++i) {
        jpeg_component *c = j->scan[i];
        for (k = 0; k < c->h * c->v; ++k) {
            if (!read_block(j, c, x * c->h + k % c->h, y * c->v + k / c->h)) return 0;
        }
    }
    return 1;
}

/* Moves to the marker that must follow, and drops padding bits. The last run of empty blocks of some encoders is
 * longer than the rest of the blocks, which loses nothing. */
static int end_bits(jpeg_reader *j)
{
    fill_bits(j);
    if (j->empty_run > 0)
        j->note = "its empty blocks run past a scan's end";
    j->empty_run = 0;
    if (j->bit_count >= 8)
        return report_fail(j->r, "%s: more data than blocks just before byte %zu; the file is damaged", j->name, j->at);
    j->bits = j->bit_count = 0;
    if (j->size - j->at < 2)
        return report_fail(j->r, "%s: the file ends at byte %zu, in or behind a scan; it is truncated", j->name,
                           j->size);
    return 1;
}

static int read_restart(jpeg_reader *j, uint32_t number)
{
    uint32_t i;
    if (!end_bits(j)) return 0;
    while (j->size - j->at > 2 && j->data[j->at + 1] == 0xFF) ++j->at; /* fill bytes */
    if (j->data[j->at] != 0xFF || j->data[j->at + 1] != 0xD0 + (number & 7))
        return report_fail(j->r, "%s: no restart marker %" PRIu32 " at byte %zu; the file is damaged", j->name,
                           number & 7, j->at);
    j->at += 2;
    for (i = 0; i < j->scan_count; ++i) j->scan[i]->prediction = 0;
    return 1;
}

static uint32_t divide_up(uint32_t a, uint32_t b)
{
    return (a + b - 1) / b;
}

/* A first scan of details skips the blocks of an empty run: returns how many to skip after block `done`, up to the
 * next restart marker. */
static uint32_t skip_empty(jpeg_reader *j, uint32_t done, uint32_t total)
{
    uint32_t stop = j->restart ? done - done % j->restart + j->restart : total, n;
    if (!j->progressive || j->first == 0 || j->high > 0) return 0;
    n = (stop < total ? stop : total) - done - 1;
    if (n > j->empty_run) n = j->empty_run;
    j->empty_run -= n;
    return n;
}

int jpeg_scan(jpeg_reader *j)
{
    int alone = j->scan_count == 1;
    uint32_t columns = alone ? j->scan[0]->blocks_x : divide_up(j->width, 8 * j->h_max);
    uint32_t rows = alone ? j->scan[0]->blocks_y : divide_up(j->height, 8 * j->v_max);
    uint32_t i, done;

    j->bits = j->bit_count = j->empty_run = 0;
    j->fault = JPEG_VALID;
    for (i = 0; i < j->scan_count; ++i) j->scan[i]->prediction = 0;
    for (done = 0; done < columns * rows; done += 1 + skip_empty(j, done, columns * rows)) {
        if (j->restart && done && done % j->restart == 0 && !read_restart(j, done / j->restart - 1)) return 0;
        if (!read_mcu(j, done % columns, done / columns)) return 0;
    }
    return end_bits(j);
}
