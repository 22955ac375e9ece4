/* qemu_interface.h: the part of qemu's plugin interface that the plugins use; distributions package
 * qemu without the header. */
#ifndef QEMU_INTERFACE_H
#define QEMU_INTERFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef uint64_t plugin_id;
typedef struct qemu_plugin_tb block;
typedef struct qemu_plugin_insn instruction;

enum { INLINE_ADD = 0, NO_REGISTERS = 0, READS_AND_WRITES = 3 };

extern void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id id, void (*call)(plugin_id id, block *b));
extern size_t qemu_plugin_tb_n_insns(const block *b);
extern uint64_t qemu_plugin_tb_vaddr(const block *b);
extern instruction *qemu_plugin_tb_get_insn(const block *b, size_t index);
extern const char *qemu_plugin_insn_symbol(const instruction *i);
extern const void *qemu_plugin_insn_data(const instruction *i);
extern uint64_t qemu_plugin_insn_vaddr(const instruction *i);
extern size_t qemu_plugin_insn_size(const instruction *i);
extern void qemu_plugin_register_vcpu_insn_exec_inline(instruction *i, int operation, void *at, uint64_t add);
extern void qemu_plugin_register_vcpu_insn_exec_cb(instruction *i, void (*call)(unsigned cpu, void *user),
                                                   int registers, void *user);
extern void qemu_plugin_register_vcpu_tb_exec_cb(block *b, void (*call)(unsigned cpu, void *user), int registers,
                                                 void *user);
extern void qemu_plugin_register_vcpu_mem_cb(instruction *i,
                                             void (*call)(unsigned cpu, uint32_t info, uint64_t at, void *user),
                                             int registers, int access, void *user);
extern bool qemu_plugin_mem_is_store(uint32_t info);
extern unsigned qemu_plugin_mem_size_shift(uint32_t info);

/* Defined by a plugin. */
#define QEMU_EXPORTED __attribute__((visibility("default")))
extern int qemu_plugin_version;
int qemu_plugin_install(plugin_id id, const void *info, int count, char **word);
QEMU_EXPORTED int qemu_plugin_version = 1;

#endif
