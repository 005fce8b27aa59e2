/* A plug-in of qemu's user mode that counts instructions between the marks of count_marks.hpp.
 *
 *   cc -shared -fPIC -o qemu_count.so qemu_count.c
 *   qemu-aarch64 -plugin ./qemu_count.so,out=COUNTS program ...
 *
 * COUNTS gets a line for each count, in order. One thread. The interface is version 1 of qemu's plug-ins (qemu 4.2 to 8.2);
 * Debian ships no header of it, so what is used of it is declared here. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef uint64_t qemu_plugin_id_t;

enum { qemu_plugin_inline_add_u64 = 0, qemu_plugin_cb_no_regs = 0 };

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* tb);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb* tb, size_t index);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn* instruction);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id,
                                           void (*translated)(qemu_plugin_id_t, struct qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* tb, int operation, void* target, uint64_t value);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb* tb, void (*run)(unsigned, void*), int flags,
                                          void* user);

int qemu_plugin_version = 1;

static uint64_t executed, at_begin;
static FILE* out;

static void begin(unsigned cpu, void* user) {
    (void)cpu, (void)user;
    at_begin = executed;
}

static void end(unsigned cpu, void* user) {
    (void)cpu, (void)user;
    fprintf(out, "%llu\n", (unsigned long long)(executed - at_begin));
    fflush(out);
}

/* A function that is called starts a block of its own. */
static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
    const char* symbol = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(tb, 0));
    (void)id;
    qemu_plugin_register_vcpu_tb_exec_inline(tb, qemu_plugin_inline_add_u64, &executed, qemu_plugin_tb_n_insns(tb));
    if (symbol && strcmp(symbol, "pelagic_count_begin") == 0)
        qemu_plugin_register_vcpu_tb_exec_cb(tb, begin, qemu_plugin_cb_no_regs, NULL);
    if (symbol && strcmp(symbol, "pelagic_count_end") == 0)
        qemu_plugin_register_vcpu_tb_exec_cb(tb, end, qemu_plugin_cb_no_regs, NULL);
}

int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int argc, char** argv) {
    (void)info;
    if (argc != 1 || strncmp(argv[0], "out=", 4) != 0 || !(out = fopen(argv[0] + 4, "w"))) return -1;
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    return 0;
}
