#include "light_export.h"
int light_map(const char *path, light_solve *s, const model *loaded, int32_t side, report *r){(void)path;(void)s;(void)loaded;(void)side;return report_fail(r,"todo");}
