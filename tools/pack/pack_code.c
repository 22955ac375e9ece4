/* pack_code.c: a packed scene as a C array. */
#include "../common/text_buffer.h"
#include "pack.h"

enum { A_LINE = 8 };

int pack_code(const char *path, const char *name, const file_bytes *file, int is_big, report *r)
{
    text_buffer t = {NULL, 0, 0, 0};
    text_buffer_add(
        &t,
        "/* A scene for lmb_pack_open(&pack, %s, %s_bytes), of machines whose words begin with the %s byte;\n"
        " * made by `lambent pack`, see lambent/pack.h. */\n"
        "#include <stddef.h>\n#include <stdint.h>\n\n"
        "#ifdef __cplusplus\nextern \"C\" {\n#endif\n"
        "extern const uint32_t %s[];\nextern const size_t %s_bytes;\n"
        "#ifdef __cplusplus\n}\n#endif\n\nconst uint32_t %s[] = {\n",
        name, name, is_big ? "highest" : "lowest", name, name, name);
    for (size_t i = 0; i < file->size; i += 4) {
        const uint8_t *p = file->data + i;
        const uint32_t word = is_big ? (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3]
                                     : (uint32_t)p[3] << 24 | (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
        const size_t at = i / 4;
        text_buffer_add(&t, "%s0x%08lxu,", at % A_LINE == 0 ? "    " : " ", (unsigned long)word);
        text_buffer_plain(&t, at % A_LINE == A_LINE - 1 || i + 4 == file->size ? "\n" : "");
    }
    text_buffer_add(&t, "};\n\nconst size_t %s_bytes = sizeof %s;\n", name, name);
    const int ok = text_buffer_write(&t, path, r);
    text_buffer_free(&t);
    return ok;
}
