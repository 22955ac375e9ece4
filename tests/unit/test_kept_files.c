/* test_kept_files.c: files that a command reads, so that it does not overwrite any of them. */
#include "../folder.h"

#include "../../tools/common/io_file.h"

void test_kept_files(void);

/* More than the initial capacity. */
enum { KEPT = 50, OTHERS = 10 };

static const char *put(folder *f, int i)
{
    char name[16];
    snprintf(name, sizeof name, "%d.json", i);
    return folder_put(f, name, "{}", 2);
}

void test_kept_files(void)
{
    static folder f;
    const char *path[KEPT + OTHERS];
    file_keep_end(); /* files kept by earlier tests are gone, and a new file may reuse an inode */
    folder_open(&f);
    for (int i = 0; i < KEPT + OTHERS; ++i) {
        path[i] = put(&f, i);
    }
    for (int i = 0; i < 2 * KEPT; ++i) { /* each twice */
        report r = {""};
        CHECK_MSG(file_keep(path[i % KEPT], &r), "%s", r.text);
    }
    for (int i = 0; i < KEPT + OTHERS; ++i) {
        report r = {""};
        CHECK_MSG(file_may_replace(path[i], &r) == (i >= KEPT), "%s", path[i]);
        CHECK((r.text[0] != '\0' && report_is_usage(&r)) == (i < KEPT));
    }
    file_keep_end();
    report r = {""};
    CHECK(file_may_replace(path[0], &r));
    folder_close(&f);
}
