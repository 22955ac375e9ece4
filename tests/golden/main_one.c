/* main_one.c: draws golden pictures by name, on a machine with a libc: golden-one NAME... */
#include <stdio.h>
#include <string.h>

#include "golden.h"

static int passed, failed;

static void put_line(const char *line)
{
    puts(line);
    if (strstr(line, " WRONG") != NULL)
        ++failed;
    else
        ++passed;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; ++i) {
        const int before = passed + failed;
        golden_only = argv[i];
        golden_run(&golden_whole, put_line);
        if (passed + failed == before) {
            printf("FAIL there is no golden picture `%s`\n", argv[i]);
            ++failed;
        }
    }
    printf("%d passed, %d failed, 0 skipped\n", passed, failed);
    return failed > 0 || passed == 0;
}
