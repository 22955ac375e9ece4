/* main_page.c: the page's own calls on this machine: page-hash SHOW LX,LY,LZ|- WORD...: a frame's hash, as the page's.
 *
 * SHOW: LMB_SHOW_*. LX,LY,LZ: where the first light goes. WORDs: `lambent render`'s. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../../platform/web/page/page_calls.h"

enum { LINE = 4096 };

static int put_light(const char *text)
{
    float at[3];
    if (sscanf(text, "%f,%f,%f", &at[0], &at[1], &at[2]) != 3) {
        return 0;
    }
    const double *n = page_numbers(0);
    return page_put_light(0, at[0], at[1], at[2], (float)n[PAGE_LIGHT + 4], (float)n[PAGE_LIGHT + 5],
                          (float)n[PAGE_LIGHT + 6]);
}

static int draw(int show)
{
    int more = page_begin(PAGE_TO_SCREEN, show);
    while (more > 0) {
        more = page_step(1000);
    }
    return more == 0 && page_report()[0] == '\0';
}

int main(int argc, char **argv)
{
    char words[LINE] = "";
    for (int i = 3; i < argc && strlen(words) + strlen(argv[i]) + 2 < LINE; ++i) {
        strcat(strcat(words, i > 3 ? "\n" : ""), argv[i]);
    }
    if (argc < 4 || !page_open(words) || (strcmp(argv[2], "-") != 0 && !put_light(argv[2])) || !draw(atoi(argv[1]))) {
        fprintf(stderr, "page-hash: %s\n", page_report()[0] != '\0' ? page_report() : "see tests/web/main_page.c");
        return 1;
    }
    puts(page_hash());
    return 0;
}
