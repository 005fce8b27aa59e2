#!/usr/bin/env python3
"""Estimates the cycles of a frame on a headset's cores with a model, without a headset.

  cmake --preset arm64-libcxx
  cmake --build build/arm64-libcxx --target pelagic_count_jobs

  bench/instructions/headset_model.py [--seas 1x128 1x256 3x128]    each job on one thread
  bench/instructions/headset_model.py --table       the table of docs/integrations/vr.md

qemu counts how often each block of instructions runs. llvm-mca (19 or newer, Debian's llvm-19)
computes the cycles that a core takes for repetitions of a block if every load hits the first-level
cache. neoverse-v2 is similar to a Cortex-X3, neoverse-n2 to a Cortex-A710 or A715. The model omits
cache misses, mispredicted branches, interaction of neighbouring blocks, and the time to wake
threads. A device takes longer.
"""
import argparse
import itertools
import json
import math
import pathlib
import subprocess
import tempfile

import instructions

CORES = {"neoverse-v2": "X3-like", "neoverse-n2": "A715-like"}
CLOCKS_GHZ = (2.0, 2.8)
ITERATIONS = 100
# The table's ranges: from the model's time at the higher clock to its time at the lower clock times
# an estimated factor for omitted effects. The speed-up by more threads is then 0.7 of the ideal,
# the minimum for two threads in docs/performance.md: 1.42 at N = 128.
LEFT_OUT = 1.5
SPEED_UP_KEPT = 0.7


def blocks_of(program, sea):
    """Returns for each job of the frame its items, the number of blocks that threads can share, and
    how often each block of instructions ran, by its bytes."""
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/counts"
        plug_in = instructions.built_plug_in(folder)
        printed = subprocess.run(["qemu-aarch64", "-plugin", f"{plug_in},out={out},blocks=on", program, "neon", sea],
                                 stdout=subprocess.PIPE, text=True, check=True).stdout
        counts, blocks = [], {}
        for line in open(out):
            words = line.split()
            if len(words) == 1:
                counts.append(blocks)
                blocks = {}
            else:
                blocks[words[1]] = blocks.get(words[1], 0) + int(words[0])
    jobs = [line.split("\t") for line in printed.splitlines() if not line.startswith("compiler")]
    return {name.split("/", 1)[1]: (float(items), int(parts), blocks) for (name, items, parts), blocks in zip(jobs, counts)}


def cycles_of(blocks, core):
    """Returns the cycles of one run of each block on a core."""
    names = list(blocks)
    words = "\n".join(" ".join(f"0x{name[i:i + 2]}" for i in range(0, len(name), 2)) for name in names)
    text = subprocess.run(["llvm-mc-19", "--disassemble", "-triple=aarch64", f"-mcpu={core}"], input=words,
                          stdout=subprocess.PIPE, text=True, check=True).stdout
    lines = [line for line in text.splitlines() if line.strip() and not line.strip().startswith(".")]
    parts, at = [], 0
    for number, name in enumerate(names):
        count = len(name) // 8
        parts += [f"# LLVM-MCA-BEGIN {number}", *lines[at:at + count], f"# LLVM-MCA-END {number}"]
        at += count
    if at != len(lines):
        raise SystemExit(f"{at} instructions, of which {len(lines)} have a name")
    report = subprocess.run(["llvm-mca-19", "-mtriple=aarch64", f"-mcpu={core}", f"-iterations={ITERATIONS}", "-json",
                             "-"], input="\n".join(parts) + "\n", stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                            check=True).stdout
    regions = json.loads(report)["CodeRegions"]
    return {names[int(region["Name"])]: region["SummaryView"]["TotalCycles"] / ITERATIONS for region in regions}


def threads_ms(jobs, cycles, threads, clock_ghz):
    """Returns the milliseconds of a frame: its jobs in sequence, a job's blocks shared evenly by
    threads without other waits."""
    total = 0
    for _, count, blocks in jobs.values():
        job = sum(cycles[block] * runs for block, runs in blocks.items())
        total += job * math.ceil(count / threads) / count
    return total / clock_ghz / 1e6


def of_frame(job):
    """Returns true for jobs of every frame: not queries, their preparation, or the total."""
    return not job.startswith(("query", "folds")) and job != "frame"


def print_jobs(options):
    print(f"{'sea':8}{'job':22}{'core':>22}{'cycles a texel':>16}" +
          "".join(f"{f'ms at {clock} GHz':>16}" for clock in CLOCKS_GHZ))
    for sea in options.seas or ["1x128", "1x256", "3x128"]:
        jobs = blocks_of(options.program, sea)
        for core, like in CORES.items():
            cycles = cycles_of({block for _, _, blocks in jobs.values() for block in blocks}, core)
            for job, (items, _, blocks) in jobs.items():
                an_item = sum(cycles[block] * runs for block, runs in blocks.items()) / items
                print(f"{sea:8}{job:22}{f'{core}, {like}':>22}{an_item:16.1f}" +
                      "".join(f"{an_item * items / clock / 1e6:16.3f}" for clock in CLOCKS_GHZ))


def print_table(options):
    """Prints the rows of docs/integrations/vr.md, which are those of `pelagic bench --headset`."""
    # SSE4.2 has registers as wide as NEON's, so frames have equal padding.
    printed = subprocess.run([options.command, "bench", "--headset", "--isa", "sse4.2", "--threads", "3", "--seconds", "0.1",
                              "--json", "-"], stdout=subprocess.PIPE, check=True).stdout
    print("| sea | threads | X3-like, ms | A715-like, ms | of 11.1 ms | memory, MB | uploaded, MB |\n|" + "---|" * 7)
    for sea, rows in itertools.groupby(json.loads(printed)["rows"], lambda row: f"{row['cascades']}x{row['n']}"):
        jobs = {job: part for job, part in blocks_of(options.program, sea).items() if of_frame(job)}
        cycles = [cycles_of({block for _, _, blocks in jobs.values() for block in blocks}, core) for core in CORES]
        for row in rows:
            threads = row["threads"]
            kept = 1 if threads == 1 else SPEED_UP_KEPT
            ranges = [(threads_ms(jobs, of_core, threads, CLOCKS_GHZ[1]),
                       threads_ms(jobs, of_core, threads, CLOCKS_GHZ[0]) * LEFT_OUT / kept) for of_core in cycles]
            cells = [f"{low:.2f} to {high:.2f}" for low, high in ranges]
            part = [100 * ms / (1000 / 90) for ms in ranges[1]]
            print(f"| {sea} | {threads} | {cells[0]} | {cells[1]} | {part[0]:.1f} to {part[1]:.1f} % | "
                  f"{row['memory_bytes'] / 1e6:.1f} | {row['upload_bytes'] / 1e6:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    builds = instructions.HERE.parents[1] / "build"
    parser.add_argument("--program", type=pathlib.Path, default=builds / "arm64-libcxx/bin/pelagic_count_jobs")
    parser.add_argument("--command", type=pathlib.Path, default=builds / "release/bin/pelagic")
    parser.add_argument("--seas", nargs="+", help="cascades x resolution [1x128 1x256 3x128]")
    parser.add_argument("--table", action="store_true", help="print the table of docs/integrations/vr.md")
    options = parser.parse_args()
    print_table(options) if options.table else print_jobs(options)


if __name__ == "__main__":
    main()
