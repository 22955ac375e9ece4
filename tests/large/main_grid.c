/* main_grid.c: prints a hilly grid of N x N squares as a binary PLY: 2 N^2 triangles, 19 bytes each. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static int put_u32(uint32_t v)
{
    const uint8_t bytes[4] = {(uint8_t)v, (uint8_t)(v >> 8), (uint8_t)(v >> 16), (uint8_t)(v >> 24)};
    return fwrite(bytes, 1, 4, stdout) == 4;
}

/* Whole numbers: the same file everywhere. Hills are parabolas, 64 squares wide. */
static uint32_t height(uint32_t x, uint32_t y)
{
    const uint32_t u = x % 64, v = y % 64;
    return u * (64 - u) * (v * (64 - v)) / 4096;
}

static int put_vertices(uint32_t n)
{
    int ok = 1;
    for (uint32_t y = 0; y <= n; ++y) {
        for (uint32_t x = 0; x <= n; ++x) {
            ok &= put_u32(x) && put_u32(height(x, y)) && put_u32(y);
        }
    }
    return ok;
}

static int put_triangle(uint32_t a, uint32_t b, uint32_t c)
{
    return putchar(3) == 3 && put_u32(a) && put_u32(b) && put_u32(c);
}

static int put_squares(uint32_t n)
{
    int ok = 1;
    for (uint32_t y = 0; y < n; ++y) {
        for (uint32_t x = 0; x < n; ++x) {
            const uint32_t at = y * (n + 1) + x;
            ok &= put_triangle(at, at + n + 1, at + 1) && put_triangle(at + 1, at + n + 1, at + n + 2);
        }
    }
    return ok;
}

int main(int argc, char **argv)
{
    const uint32_t n = argc == 2 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0;
    if (n < 1 || n > 20000) {
        fputs("usage: grid N > OUT.ply, N from 1 to 20000\n", stderr);
        return 2;
    }
    printf("ply\nformat binary_little_endian 1.0\nelement vertex %lu\nproperty int x\nproperty int y\nproperty int z\n"
           "element face %lu\nproperty list uchar uint vertex_indices\nend_header\n",
           (unsigned long)(n + 1) * (n + 1), 2ul * n * n);
    return !(put_vertices(n) && put_squares(n) && fflush(stdout) == 0);
}
