/* fuzz.c: the table of targets, and the check that aborts the run. */
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const fuzz_names[] = {"png",  "jpeg", "hdr", "pfm", "ppm", "pam", "picture", "inflate",
                                  "json", "gltf", "obj", "mtl", "ply", "lmr", "lmt", "lmf", "lmp", "cli",
                                  "api",  "calls", "stages", NULL};

static const fuzz_target targets[] = {fuzz_png,  fuzz_jpeg, fuzz_hdr, fuzz_pfm, fuzz_ppm, fuzz_pam, fuzz_picture,
                                      fuzz_inflate,
                                      fuzz_json, fuzz_gltf, fuzz_obj, fuzz_mtl, fuzz_ply, fuzz_lmr, fuzz_lmt, fuzz_lmf,
                                      fuzz_lmp,  fuzz_cli,  fuzz_api,  fuzz_calls, fuzz_stages};

fuzz_target fuzz_find(const char *name)
{
    for (int i = 0; fuzz_names[i] != NULL; ++i) {
        if (strcmp(fuzz_names[i], name) == 0) {
            return targets[i];
        }
    }
    return NULL;
}

void fuzz_check(int holds, const char *condition, const char *file, int line)
{
    if (!holds) {
        fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, condition);
        abort();
    }
}

uint32_t fuzz_failures;

void fuzz_failed(const report *r, const char *begin)
{
    size_t n = strlen(begin);
    ++fuzz_failures;
    fuzz_require(strncmp(r->text, begin, n) == 0 && r->text[n] != '\0');
    for (const char *c = r->text; *c != '\0'; ++c) {
        fuzz_require((unsigned char)*c >= 32);
    }
}
