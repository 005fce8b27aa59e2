#!/usr/bin/env python3
"""Cycles of a frame on a headset's cores, by a model: for those who have none.

    cmake --preset arm64 && cmake --build build/arm64 --target pelagic_count_jobs
    bench/instructions/headset_model.py [--seas 1x128 1x256 3x128]

qemu says how often each block of instructions runs; llvm-mca (19 or newer, Debian's llvm-19) says how many cycles a core takes
for it, over and over, when every load hits the first cache. neoverse-v2 is near a Cortex-X3, neoverse-n2 near a Cortex-A710 or
A715. Left out: misses, mispredicted branches, what neighbouring blocks overlap or hinder. A device takes longer.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

import instructions

CORES = {"neoverse-v2": "X3-like", "neoverse-n2": "A715-like"}
CLOCKS_GHZ = (2.0, 2.8)
ITERATIONS = 100


def blocks_of(program, sea):
    """Of each job of the frame: its texels, and how often each block ran, by its bytes."""
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
    return {name.split("/", 1)[1]: (float(items), blocks) for (name, items), blocks in zip(jobs, counts)}


def cycles_of(blocks, core):
    """Cycles a run of each block on a core."""
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path,
                        default=instructions.HERE.parents[1] / "build/arm64/bin/pelagic_count_jobs")
    parser.add_argument("--seas", nargs="+", default=["1x128", "1x256", "3x128"])
    options = parser.parse_args()
    print(f"{'sea':8}{'job':20}{'core':>22}{'cycles a texel':>16}" +
          "".join(f"{f'ms at {clock} GHz':>16}" for clock in CLOCKS_GHZ))
    for sea in options.seas:
        jobs = {job: part for job, part in blocks_of(options.program, sea).items()
                if not job.startswith(("query", "folds"))}
        for core, like in CORES.items():
            cycles = cycles_of({block for _, blocks in jobs.values() for block in blocks}, core)
            for job, (texels, blocks) in jobs.items():
                a_texel = sum(cycles[block] * runs for block, runs in blocks.items()) / texels
                print(f"{sea:8}{job:20}{f'{core}, {like}':>22}{a_texel:16.1f}" +
                      "".join(f"{a_texel * texels / clock / 1e6:16.3f}" for clock in CLOCKS_GHZ))


if __name__ == "__main__":
    main()
