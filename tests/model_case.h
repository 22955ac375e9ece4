/* model_case.h: the model that a test loaded last, what was said of it, and checks of that. */
#ifndef MODEL_CASE_H
#define MODEL_CASE_H

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../tools/model/model.h"
#include "test.h"

static model loaded;
static model_notes notes;
static report problem;

/* Before each load: the last model goes, and what was said of it. */
static inline void forget(void)
{
    model_free(&loaded);
    memset(&problem, 0, sizeof problem);
}

static inline int load_file(const char *path)
{
    forget();
    return model_load(&loaded, path, NULL, &notes, &problem);
}

/* Loads a glTF document made by printf. Notes of earlier models are removed. */
static inline int load_gltf(const char *format, ...)
{
    static char text[1 << 16];
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    CHECK(n > 0 && n < (int)sizeof text);
    forget();
    memset(&notes, 0, sizeof notes);
    return model_read(&loaded, "a.gltf", NULL, (const uint8_t *)text, (size_t)n, &notes, &problem);
}

static inline int noted(const char *part)
{
    uint32_t i;
    for (i = 0; i < notes.count; ++i)
        if (strstr(notes.line[i], part))
            return 1;
    return 0;
}

#define CHECK_LOADS(call) CHECK_MSG(call, "%s", problem.text)

/* A failure is one line that holds `part`, and leaves nothing behind. */
static inline void check_fails(int ok, const char *part)
{
    CHECK_MSG(!ok, "loaded, but should say: %s", part);
    CHECK_MSG(strstr(problem.text, part) != NULL, "\"%s\" lacks \"%s\"", problem.text, part);
    CHECK(!strchr(problem.text, '\n') && loaded.block_count == 0 && loaded.scene.mesh_count == 0 && !loaded.blocks);
}

#endif
