/* small_fixed.h: a blob of lambent/fixed.h made by hand: a cube from within, 4 m wide, a smaller one in it, one element a
 * face, 3 x 3 x 3 places of a lamp, one of them not valid. */
#ifndef SMALL_FIXED_H
#define SMALL_FIXED_H

#include <lambent/fixed.h>

enum {
    SMALL_FIXED_FACES = 12,
    SMALL_FIXED_ACROSS = 5, /* vertices along a face's side */
    SMALL_FIXED_VERTICES = SMALL_FIXED_FACES * SMALL_FIXED_ACROSS * SMALL_FIXED_ACROSS,
    SMALL_FIXED_TRIANGLES = SMALL_FIXED_FACES * (SMALL_FIXED_ACROSS - 1) * (SMALL_FIXED_ACROSS - 1) * 2,
    SMALL_FIXED_RECEIVERS = SMALL_FIXED_VERTICES + SMALL_FIXED_FACES,
    SMALL_FIXED_LINKS = 6, /* of a receiver */
    SMALL_FIXED_PLACES = 27,
    SMALL_FIXED_WORDS = LMB_FIXED_HEADER_WORDS + SMALL_FIXED_RECEIVERS * (3 + 2 + SMALL_FIXED_LINKS / 2 + 1) +
                        2 * SMALL_FIXED_TRIANGLES + 1
};

/* Faces 0 .. 5 of the room, seen from within; 6 .. 11 of the cube, seen from without. */
static inline void small_fixed_face(int32_t axis[3][3], int32_t *half, int face)
{
    const int along = face % 6 / 2, sign = face % 2 ? -1 : 1, outside = face >= 6;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            axis[i][k] = 0;
        }
    }
    axis[2][along] = outside ? sign : -sign; /* the normal */
    axis[0][(along + 1) % 3] = 1;
    axis[1][(along + 2) % 3] = axis[2][along];
    *half = outside ? 400 : 2048;
}

static inline uint32_t *small_fixed_receiver(uint32_t *at, int face, int32_t u, int32_t v)
{
    int32_t axis[3][3], half, p[3], n[3];
    small_fixed_face(axis, &half, face);
    for (int k = 0; k < 3; ++k) {
        const int32_t out = face >= 6 ? half : -half;
        p[k] = axis[2][k] * out + (axis[0][k] * u + axis[1][k] * v) * half / 2 + (face >= 6 ? 500 * (k == 0) - 300 : 0);
        n[k] = axis[2][k] * 127;
    }
    *at++ = ((uint32_t)p[0] & 0xffffu) | (uint32_t)p[1] << 16;
    *at++ = ((uint32_t)p[2] & 0xffffu) | ((uint32_t)n[0] & 255u) << 16 | ((uint32_t)n[1] & 255u) << 24;
    *at++ = ((uint32_t)n[2] & 255u) | (uint32_t)(90 + 12 * face) << 8 | (uint32_t)(200 - 5 * face) << 16 |
            (uint32_t)(120 + 9 * face) << 24;
    return at;
}

/* SMALL_FIXED_WORDS of them; bytes. Numbers that are anything come from a sequence of its own. */
static inline size_t small_fixed(uint32_t *out)
{
    const uint32_t header[LMB_FIXED_HEADER_WORDS] = {
        0x4c4d4600u | LMB_FIXED_VERSION, SMALL_FIXED_WORDS, 10, SMALL_FIXED_VERTICES, SMALL_FIXED_TRIANGLES,
        SMALL_FIXED_FACES, SMALL_FIXED_RECEIVERS * SMALL_FIXED_LINKS / 2, 3, 3, 3, (uint32_t)-1500, (uint32_t)-1500,
        (uint32_t)-1500, 1500, 0, 0, 0, SMALL_FIXED_TRIANGLES / 2, 0, 0};
    enum { N = SMALL_FIXED_ACROSS };
    uint32_t *at = out, dice = 1;
    for (int i = 0; i < LMB_FIXED_HEADER_WORDS; ++i) {
        *at++ = header[i];
    }
    for (int f = 0; f < SMALL_FIXED_FACES; ++f) {
        for (int i = 0; i < N * N; ++i) {
            at = small_fixed_receiver(at, f, i % N - N / 2, i / N - N / 2);
        }
    }
    for (int f = 0; f < SMALL_FIXED_FACES; ++f) {
        at = small_fixed_receiver(at, f, 0, 0);
    }
    for (uint32_t f = 0; f < SMALL_FIXED_FACES; ++f) {
        for (uint32_t i = 0; i < (N - 1) * (N - 1); ++i) {
            const uint32_t a = f * N * N + i / (N - 1) * N + i % (N - 1);
            *at++ = a | (a + 1) << 16, *at++ = a + N + 1;
            *at++ = a | (a + N + 1) << 16, *at++ = a + N;
        }
    }
    for (uint32_t i = 0; i < SMALL_FIXED_RECEIVERS; ++i) {
        *at++ = i * SMALL_FIXED_LINKS / 2 | (uint32_t)SMALL_FIXED_LINKS << 24;
        *at++ = 60000000u - 1000u * i;
    }
    for (uint32_t i = 0; i < SMALL_FIXED_RECEIVERS * SMALL_FIXED_LINKS / 2; ++i) {
        dice = dice * 1664525u + 1013904223u;
        const uint32_t weights = dice >> 8 & 0x7f007f00u;
        *at++ = weights | (i * 5 % SMALL_FIXED_FACES) | (i * 7 + 1) % SMALL_FIXED_FACES << 16;
    }
    *at++ = 0x07fffffeu; /* not the first place */
    for (uint32_t i = 0; i < SMALL_FIXED_RECEIVERS; ++i) {
        dice = dice * 1664525u + 1013904223u;
        *at++ = (dice >> 4 | dice << 13) & 0x07ffffffu;
    }
    return 4 * (size_t)(at - out);
}

/* A frame of it from within; `which` turns the camera, moves it and picks the lamp. */
static inline void small_fixed_frame(lmb_fixed_frame *f, int32_t width, int32_t height, int which)
{
    static const int32_t eye[4][3] = {{-1500, 600, 1700}, {1900, -1900, 1900}, {0, 1200, 0}, {-700, -100, -250}};
    static const int32_t to[4][3] = {{200, -300, -300}, {0, 0, 0}, {300, -1500, 40}, {1500, -600, -200}};
    f->view.width = width;
    f->view.height = height;
    f->view.focal = 14 * height;
    f->view.near_units = 64;
    f->bounces = which & 3;
    lmb_fixed_look_at(&f->view, eye[which & 3], to[which & 3]);
    for (int i = 0; i < 3; ++i) {
        f->lamp.position[i] = 900 - 700 * i + 100 * which;
        f->lamp.direction[i] = which & 4 ? (i == 1 ? -15600 : 3000) : 0;
        f->lamp.intensity[i] = (uint32_t)(20000 + 6000 * i);
    }
    f->lamp.cos_inner = which & 4 ? 14000 : 0;
    f->lamp.cos_outer = which & 4 ? 9000 : 0;
}

#endif
