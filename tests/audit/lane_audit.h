/* lane_audit.h: the scalar lane verbs, four wide, that count what a kernel should never meet.
 *
 * Denormals: ARMv7's NEON, Helium and AltiVec flush them, so a kernel that makes one is not the same there. Conversions
 * to int of what int32 does not hold: undefined in C, and different on every machine. */
#ifndef LANE_AUDIT_H
#define LANE_AUDIT_H

#define lane_add lane_add_plain
#define lane_sub lane_sub_plain
#define lane_mul lane_mul_plain
#define lane_div lane_div_plain
#define lane_sqrt lane_sqrt_plain
#define lane_to_int lane_to_int_plain
#define lane_trunc lane_trunc_plain
#include "../../src/lane/lane_scalar.h"
#undef lane_add
#undef lane_sub
#undef lane_mul
#undef lane_div
#undef lane_sqrt
#undef lane_to_int
#undef lane_trunc

/* Counts a denormal among `a`; returns `a`. */
lane audit_result(lane a, const char *verb, const char *file, int line);
/* Counts a value that int32 does not hold. */
lane audit_whole(lane a, const char *verb, const char *file, int line);

#define lane_add(a, b) audit_result(lane_add_plain(a, b), "add", __FILE__, __LINE__)
#define lane_sub(a, b) audit_result(lane_sub_plain(a, b), "sub", __FILE__, __LINE__)
#define lane_mul(a, b) audit_result(lane_mul_plain(a, b), "mul", __FILE__, __LINE__)
#define lane_div(a, b) audit_result(lane_div_plain(a, b), "div", __FILE__, __LINE__)
#define lane_sqrt(a)   audit_result(lane_sqrt_plain(a), "sqrt", __FILE__, __LINE__)
#define lane_to_int(a) lane_to_int_plain(audit_whole(a, "to_int", __FILE__, __LINE__))
#define lane_trunc(a)  lane_trunc_plain(audit_whole(a, "trunc", __FILE__, __LINE__))

#endif
