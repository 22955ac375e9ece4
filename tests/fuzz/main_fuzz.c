/* main_fuzz.c: the main program for the fuzzing engine: `fuzz TARGET [options] [folders]`; built by `make
 * fuzz` with clang's libFuzzer. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t cap, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t cap);

static fuzz_target target;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    target = *argc > 1 && strcmp((*argv)[1], "gl") == 0 ? fuzz_gl : *argc > 1 ? fuzz_find((*argv)[1]) : NULL;
    if (target == NULL) {
        fputs("usage: fuzz TARGET [libFuzzer's options] [folders]; targets:", stderr);
        for (int i = 0; fuzz_names[i] != NULL; ++i) {
            fprintf(stderr, " %s", fuzz_names[i]);
        }
        fputs(" gl\n", stderr);
        exit(2);
    }
    (*argv)[1] = (*argv)[0];
    ++*argv;
    --*argc;
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    target(data, size);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t cap, unsigned seed)
{
    size = LLVMFuzzerMutate(data, size, cap);
    fuzz_repair(target, data, size, seed);
    return size;
}
