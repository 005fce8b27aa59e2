/* A plug-in of qemu's user mode that counts instructions between the marks of count_marks.hpp.
 *
 *   cc -shared -fPIC -o qemu_count.so qemu_count.c
 *   qemu-aarch64 -plugin ./qemu_count.so,out=COUNTS[,blocks=on] program ...
 *
 * Writes one line for each count to COUNTS, in order; with blocks=on, before it one line for each
 * block of instructions that ran, with its number of runs and its bytes. For one thread. The
 * interface is version 1 of qemu's plug-ins (qemu 4.2 to 8.2). Debian has no header for it, so this
 * file declares the functions that it uses. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef uint64_t qemu_plugin_id_t;

enum { qemu_plugin_inline_add_u64 = 0, qemu_plugin_cb_no_regs = 0 };

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* tb);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb* tb, size_t index);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn* instruction);
const void* qemu_plugin_insn_data(const struct qemu_plugin_insn* instruction);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn* instruction);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id,
                                           void (*translated)(qemu_plugin_id_t, struct qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* tb, int operation, void* target, uint64_t value);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb* tb, void (*run)(unsigned, void*), int flags,
                                          void* user);

int qemu_plugin_version = 1;

/* Instructions that always run together; qemu may translate the same ones more than once. */
struct block {
    uint64_t runs;
    char* bytes; /* hexadecimal */
    struct block* next;
};

static uint64_t executed, at_begin;
static struct block* blocks;
static int wants_blocks;
static FILE* out;

static struct block* new_block(const struct qemu_plugin_tb* tb) {
    const size_t count = qemu_plugin_tb_n_insns(tb);
    struct block* block = calloc(1, sizeof *block);
    char* to = block->bytes = malloc(count * 8 + 1);
    for (size_t i = 0; i < count; ++i) {
        const struct qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(tb, i);
        const unsigned char* data = qemu_plugin_insn_data(instruction);
        for (size_t byte = 0; byte < qemu_plugin_insn_size(instruction); ++byte) to += sprintf(to, "%02x", data[byte]);
    }
    block->next = blocks;
    return blocks = block;
}

static void begin(unsigned cpu, void* user) {
    (void)cpu, (void)user;
    at_begin = executed;
    for (struct block* block = blocks; block; block = block->next) block->runs = 0;
}

static void end(unsigned cpu, void* user) {
    (void)cpu, (void)user;
    for (struct block* block = blocks; block; block = block->next)
        if (block->runs) fprintf(out, "%llu %s\n", (unsigned long long)block->runs, block->bytes);
    fprintf(out, "%llu\n", (unsigned long long)(executed - at_begin));
    fflush(out);
}

/* A function that is called starts a block of its own. */
static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
    const char* symbol = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(tb, 0));
    (void)id;
    qemu_plugin_register_vcpu_tb_exec_inline(tb, qemu_plugin_inline_add_u64, &executed, qemu_plugin_tb_n_insns(tb));
    if (wants_blocks)
        qemu_plugin_register_vcpu_tb_exec_inline(tb, qemu_plugin_inline_add_u64, &new_block(tb)->runs, 1);
    if (symbol && strcmp(symbol, "pelagic_count_begin") == 0)
        qemu_plugin_register_vcpu_tb_exec_cb(tb, begin, qemu_plugin_cb_no_regs, NULL);
    if (symbol && strcmp(symbol, "pelagic_count_end") == 0)
        qemu_plugin_register_vcpu_tb_exec_cb(tb, end, qemu_plugin_cb_no_regs, NULL);
}

int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int argc, char** argv) {
    (void)info;
    wants_blocks = argc == 2 && strcmp(argv[1], "blocks=on") == 0;
    if (argc != 1 + wants_blocks || strncmp(argv[0], "out=", 4) != 0 || !(out = fopen(argv[0] + 4, "w"))) return -1;
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    return 0;
}
