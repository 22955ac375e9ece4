/* isa_audit.c: every kernel by the audited verbs, as the only backend there is; says at exit what they met. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../src/base/exact.h"
#include "lane_audit.h"

#define BACKEND "audit"
#define KERNEL(name) name##_audit
#include "../../src/isa/all_kernels.inl"

enum { SITES = 256 };

/* A verb in a line that met something. */
typedef struct site {
    const char *verb, *file;
    int line;
    float example;
    unsigned long count;
} site;

static site sites[SITES];
static int site_count;
static uint64_t asked;

static void met(const char *verb, const char *file, int line, float value)
{
    int i = 0;
    while (i < site_count &&
           (sites[i].line != line || strcmp(sites[i].verb, verb) != 0 || strcmp(sites[i].file, file) != 0)) {
        ++i;
    }
    if (i == SITES) {
        return;
    }
    if (i == site_count) {
        ++site_count;
        sites[i].verb = verb;
        sites[i].file = file;
        sites[i].line = line;
        sites[i].example = value;
    }
    ++sites[i].count;
}

static int is_denormal(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return (bits & 0x7f800000u) == 0 && (bits & 0x007fffffu) != 0;
}

lane audit_result(lane a, const char *verb, const char *file, int line)
{
    for (int i = 0; i < LANES; ++i) {
        ++asked;
        if (is_denormal(a.v[i])) {
            met(verb, file, line, a.v[i]);
        }
    }
    return a;
}

lane audit_whole(lane a, const char *verb, const char *file, int line)
{
    for (int i = 0; i < LANES; ++i) {
        ++asked;
        if (!(a.v[i] > -2147483904.0f && a.v[i] < 2147483648.0f)) {
            met(verb, file, line, a.v[i]);
            a.v[i] = 0.0f;
        }
    }
    return a;
}

static void report(void)
{
    for (int i = 0; i < site_count; ++i) {
        printf("%s:%d: %s met %g, %lu times\n", sites[i].file, sites[i].line, sites[i].verb, (double)sites[i].example,
               sites[i].count);
    }
    printf("%lu results audited\n%d passed, %d failed, 0 skipped\n", (unsigned long)asked, site_count == 0, site_count);
    fflush(stdout);
    if (site_count > 0) {
        _Exit(1);
    }
}

/* What isa_pick.c is elsewhere. */
const lmb_kernels *lmb_kernels_at(int32_t i)
{
    static int begun;
    if (!begun) {
        begun = 1;
        atexit(report);
    }
    return i == 0 ? &lmb_kernels_audit : NULL;
}

const char *lmb_kernels_built(int32_t i) { return i == 0 ? lmb_kernels_audit.name : NULL; }
const lmb_kernels *lmb_kernels_pick(void) { return lmb_kernels_at(0); }
const lmb_kernels *lmb_kernels_named(const char *name)
{
    return name != NULL && strcmp(name, "audit") == 0 ? lmb_kernels_at(0) : NULL;
}
const char *lmb_kernels_name(const lmb_kernels *kernels) { return kernels != NULL ? kernels->name : "?"; }

lmb_status lmb_build_check(void) { return LMB_OK; }
