/* info_text.c: output of `lambent info`: labelled lines, or JSON. */
#include "info_text.h"

#include "../common/report.h"
#include "../common/text_clean.h"

void json_text(FILE *out, const char *text)
{
    fputc('"', out);
    while (*text != '\0') {
        char character[TEXT_JSON];
        text_json(character, &text);
        fputs(character, out);
    }
    fputc('"', out);
}

void plain_text(FILE *out, const char *text) { report_print(out, "%s", text); }

void label(FILE *out, const char *text) { fprintf(out, "%-12s ", text); }

void json_vec3(FILE *out, const char *name, lmb_vec3 v)
{
    fprintf(out, "\"%s\":[%.9g,%.9g,%.9g]", name, (double)v.x, (double)v.y, (double)v.z);
}
