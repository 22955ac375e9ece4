/* main_replay.c: runs targets on files: `replay FOLDER/TARGET/FILE...`; a failed check aborts as under the fuzzer. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../tools/picture/image.h"
#include "fuzz.h"

/* The target of corpus/png/x is png, the name of the file's folder. */
static fuzz_target target_of(const char *path)
{
    char name[16];
    const char *end = strrchr(path, '/'), *start = end;
    while (start != NULL && start > path && start[-1] != '/') {
        --start;
    }
    if (end == NULL || (size_t)(end - start) >= sizeof name) {
        return NULL;
    }
    memcpy(name, start, (size_t)(end - start));
    name[end - start] = '\0';
    return fuzz_find(name);
}

int main(int argc, char **argv)
{
    int failed = 0;
    for (int i = 1; i < argc; ++i) {
        report r = {{0}};
        file_bytes file;
        fuzz_target target = target_of(argv[i]);
        if (target == NULL) {
            printf("%s: lies in no folder named as a target\n", argv[i]);
            ++failed;
        } else if (!file_read(&file, argv[i], &r)) {
            printf("%s\n", r.text);
            ++failed;
        } else {
            target(file.data, file.size);
            file_free(&file);
        }
    }
    printf("%d passed, %d failed, 0 skipped\n", argc - 1 - failed, failed);
    return failed != 0 || argc < 2;
}
