/* qemu_count.c: a plugin for qemu's system emulation that counts events of a program without operating system: `-plugin
 * FILE.so,counts=COUNTS,what=instructions|loads|stores`.
 *
 * On each call of bare_mark (bare_room.c), the plugin writes the count to COUNTS for the program to read: the lower 32
 * bits, little-endian, then the name of the counted event. A load or store of several registers counts each register.
 * Counts are exact, and equal in every run. Build the plugin for the host. */
#include <stdio.h>
#include <string.h>

#include "qemu_interface.h"

static uint64_t counted;
static const char *what = "instructions";
static FILE *file;

static void mark(unsigned cpu, void *user)
{
    (void)cpu, (void)user;
    rewind(file);
    for (int i = 0; i < 4; ++i)
        putc((int)(counted >> 8 * i & 255), file);
    fwrite(what, 1, strlen(what) + 1, file);
    fflush(file);
}

/* Checks the kind of access here, because qemu 7.2 confuses reads and writes if a callback is
 * registered for only one. */
static void count_access(unsigned cpu, uint32_t about, uint64_t at, void *user)
{
    (void)cpu, (void)at, (void)user;
    counted += qemu_plugin_mem_is_store(about) == (what[0] == 's');
}

static void translate(plugin_id id, block *b)
{
    (void)id;
    for (size_t k = 0; k < qemu_plugin_tb_n_insns(b); ++k) {
        instruction *i = qemu_plugin_tb_get_insn(b, k);
        const char *function = qemu_plugin_insn_symbol(i);
        if (function != NULL && strcmp(function, "bare_mark") == 0)
            qemu_plugin_register_vcpu_insn_exec_cb(i, mark, NO_REGISTERS, NULL);
        else if (what[0] == 'i')
            qemu_plugin_register_vcpu_insn_exec_inline(i, INLINE_ADD, &counted, 1);
        else
            qemu_plugin_register_vcpu_mem_cb(i, count_access, NO_REGISTERS, READS_AND_WRITES, NULL);
    }
}

QEMU_EXPORTED int qemu_plugin_install(plugin_id id, const void *info, int count, char **word)
{
    (void)info;
    for (int i = 0; i < count; ++i)
        if (strncmp(word[i], "counts=", 7) == 0)
            file = fopen(word[i] + 7, "wb");
        else if (strcmp(word[i], "what=loads") == 0)
            what = "loads";
        else if (strcmp(word[i], "what=stores") == 0)
            what = "stores";
        else if (strcmp(word[i], "what=instructions") != 0)
            return fprintf(stderr, "qemu_count: unknown word %s\n", word[i]);
    if (file == NULL)
        return fprintf(stderr, "qemu_count: counts=COUNTS is missing, or cannot be written\n");
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    return 0;
}
