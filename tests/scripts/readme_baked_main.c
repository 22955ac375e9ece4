/* readme_baked_main.c: adds memory and a loop to the program of include/README.md. The light of the built-in room moves
 * back and forth: checks that pictures differ, and that the first one comes back. */
#include <lambent/lambent.h>

#include <stdio.h>
#include <stdlib.h>

void *give(size_t bytes);
lmb_status start(void), next(float x);
extern uint64_t picture_hash(void);

void *give(size_t bytes) { return malloc(bytes); }

int main(void)
{
    uint64_t hash[3];
    lmb_status status = start();
    for (int i = 0; status == LMB_OK && i < 3; ++i) {
        status = next(i == 1 ? 0.5f : 0.0f);
        hash[i] = picture_hash();
    }
    if (status != LMB_OK) {
        printf("%s\n", lmb_status_name(status));
        return 1;
    }
    return hash[0] == hash[1] || hash[0] != hash[2];
}
