#!/usr/bin/env python3
"""Counts the instructions of every job. Counts do not depend on other load on the machine.

  bench/instructions/instructions.py             prints a table of build/release's jobs
  bench/instructions/instructions.py --check     fails if a job takes over 2 % more than its
                                                 budget in bench/budgets.json
  bench/instructions/instructions.py --update    writes the current counts as budgets; with
                                                 --bytes those of bytes
  bench/instructions/instructions.py --bytes 1048576 --seas 1x512 1x1024
                                                 bytes between memory and a second-level
                                                 cache of this size
  bench/instructions/instructions.py --bytes 1048576 --check
                                                 fails if a frame of textures only moves over
                                                 2 % more bytes than its budget
  bench/instructions/instructions.py --store-bytes
                                                 writes bench/bytes.json, the bytes of frames
                                                 beyond caches of 32 KiB to 32 MiB
  bench/instructions/instructions.py --of PROGRAM ...
                                                 counts of any program with marks, one line
                                                 with a name and a number each

valgrind counts x86, with SSE4.2 and AVX2 but not AVX-512; a plug-in of qemu's user mode counts NEON
(--program build/arm64/bin/pelagic_count_jobs). Counts are for one texel of the sea, and for one
point of queries. They depend on the compiler, so budgets are for one version of it; with another
version --check skips (exit status 77).

Bytes are those of valgrind's cache model: lines of 64 bytes fetched, to read or to write a part of
them, and lines written back.
"""
import argparse
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BUDGETS = HERE.parent / "budgets.json"
BYTES = HERE.parent / "bytes.json"
BYTES_SEAS = ["4x128", "1x64", "1x128", "1x256", "1x512", "1x1024"]
BYTES_CACHES = [1 << exponent for exponent in (15, 18, 19, 20, 21, 22, 23, 24, 25)]
MOST_MORE = 0.02
TEXTURES = "textures only"  # a frame without planes
SKIPPED = 77


class CannotCount(Exception):
    """The counting tool is missing, or the budgets are for another compiler."""


def is_arm(program):
    """Checks for EM_AARCH64 in the header of an ELF file."""
    with open(program, "rb") as file:
        return file.read(20)[18:20] == b"\xb7\x00"


def isas_of(program):
    """Returns the instruction sets that can be counted here."""
    if is_arm(program):
        return ["neon"]
    with open("/proc/cpuinfo") as info:
        return ["sse4.2", "avx2"] if " avx2 " in info.read() else ["sse4.2"]


def needed(tool):
    path = shutil.which(tool)
    if not path:
        raise CannotCount(f"needs {tool}, which is not installed")
    return path


def valgrind_counts(command, folder, options=()):
    """Returns the output of `command`, and the events of each count as a dictionary: Ir, and with
    --cache-sim=yes many more."""
    run = subprocess.run(
        [needed("valgrind"), "--tool=callgrind", f"--callgrind-out-file={folder}/counts", "--zero-before=pelagic_count_begin",
         "--dump-before=pelagic_count_end", *options, *command],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if run.returncode:
        raise SystemExit(f"{' '.join(command)} failed under valgrind:\n{run.stderr}")
    counts = []
    while os.path.exists(dump := f"{folder}/counts.{len(counts) + 1}"):
        lines = dict(line.split(": ", 1) for line in open(dump) if line.startswith(("events: ", "summary: ")))
        events, figures = lines["events"].split(), map(int, lines["summary"].split())
        # trailing zeros are omitted
        counts.append(dict(itertools.zip_longest(events, figures, fillvalue=0)))
    return run.stdout, counts


def built_plug_in(folder):
    plug_in = f"{folder}/qemu_count.so"
    subprocess.run([needed("cc"), "-O2", "-shared", "-fPIC", "-o", plug_in, HERE / "qemu_count.c"], check=True)
    return plug_in


def qemu_counts(command, folder):
    """Like valgrind_counts() for a program for 64-bit Arm; instructions only."""
    plug_in, out = built_plug_in(folder), f"{folder}/counts"
    run = subprocess.run([needed("qemu-aarch64"), "-plugin", f"{plug_in},out={out}", *command], stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, text=True)
    if run.returncode:
        raise SystemExit(f"{' '.join(command)} failed under qemu:\n{run.stderr}")
    return run.stdout, [{"Ir": int(line)} for line in open(out)]


def count(command, options=()):
    """Runs a program with marks. Returns its properties (compiler, ...) and a list of (name, items,
    events)."""
    command = [str(word) for word in command]
    with tempfile.TemporaryDirectory() as folder:
        printed, counts = (qemu_counts(command, folder) if is_arm(command[0]) else
                           valgrind_counts(command, folder, options))
    lines = [line.split("\t") for line in printed.splitlines() if "\t" in line]
    compiler = next((line[1] for line in lines if line[0] == "compiler"), None)
    named = [(line[0], float(line[1])) for line in lines if line[0] != "compiler"]
    if len(named) != len(counts):
        raise SystemExit(f"{command[0]} names {len(named)} counts, of which {len(counts)} were seen")
    return compiler, [(name, items, events) for (name, items), events in zip(named, counts)]


def rows_of(program, isas, seas):
    """Returns the compiler, and for each job and instruction set a row as in budgets.json."""
    rows = []
    for isa in isas:
        compiler, counts = count([program, isa, *seas])
        for name, items, events in counts:
            sea, job = name.split("/", 1)
            rows.append({"sea": sea, "job": job, "isa": isa, "instructions": round(events["Ir"] / items, 3)})
    return compiler, rows


def compulsory_bytes(sea):
    """Returns the bytes a texel that a frame of textures only moves beyond a cache in which nothing
    stays from frame to frame: 12 of waves read, and textures fetched and written. Lines of 12 bytes
    are fetched, written and read, too, unless all lines of a cascade fit into the cache with
    everything else."""
    cascades, resolution = map(int, sea.split("x"))
    textures = 8 + (16 / 3 if cascades == 1 else 32 / 3)
    return 12 + 2 * textures + (36 if resolution > 128 else 0)


def bytes_beyond(program, isa, seas, cache_bytes):
    """Returns the compiler, and for each job its name and bytes a texel: read, fetched for
    writing, and written."""
    # The second-level cache of most current processors has 16 ways.
    options = ["--cache-sim=yes", "--simulate-wb=yes", "--D1=32768,8,64", f"--LL={cache_bytes},16,64"]
    compiler, counts = count([program, isa, *seas], options)
    return compiler, [(name, [64 * lines / texels
                              for lines in (events["DLmr"], events["DLmw"], events["DLdmr"] + events["DLdmw"])])
                      for name, texels, events in counts]


def print_bytes(isa, cache_bytes, jobs):
    print(f"{isa}, beyond {cache_bytes} bytes of cache, a texel")
    print(f"{'sea':8}{'job':24}{'read':>8}{'for writing':>12}{'written':>8}{'all':>8}  bytes")
    for name, moved in jobs:
        sea, job = name.split("/", 1)
        if job.startswith("query"):
            continue
        known = f", {compulsory_bytes(sea):.1f} compulsory" if job == TEXTURES else ""
        print(f"{sea:8}{job:24}{moved[0]:8.1f}{moved[1]:12.1f}{moved[2]:8.1f}{sum(moved):8.1f}{known}")


def check_bytes(compiler, isa, cache_bytes, jobs, budgets):
    if budgets["compiler"] != compiler:
        raise CannotCount(f"budgets are for {budgets['compiler']}, this is {compiler}")
    before = {(row["sea"], row["isa"], row["cache"]): row["bytes"] for row in budgets.get("bytes", [])}
    faults = 0
    for name, moved in jobs:
        sea, job = name.split("/", 1)
        if job != TEXTURES:
            continue
        budget, now = before.get((sea, isa, cache_bytes)), sum(moved)
        if budget is None or now > (1 + MOST_MORE) * budget:
            print(f"{job} on {isa}, sea {sea}: {now:.1f} bytes a texel, budget {budget or 'missing'}")
            faults += 1
    print(f"bytes of {len(jobs)} jobs, {faults} over budget")
    return faults == 0


def update_bytes(compiler, isa, cache_bytes, jobs):
    budgets = json.loads(BUDGETS.read_text())
    if budgets["compiler"] != compiler:
        raise CannotCount(f"budgets are for {budgets['compiler']}, this is {compiler}")
    rows = {(row["sea"], row["isa"], row["cache"]): row for row in budgets.get("bytes", [])}
    for name, moved in jobs:
        sea, job = name.split("/", 1)
        if job == TEXTURES:
            rows[sea, isa, cache_bytes] = {"sea": sea, "isa": isa, "cache": cache_bytes, "bytes": round(sum(moved), 1)}
    write_budgets(compiler, budgets["budgets"], [rows[name] for name in sorted(rows)])


def store_bytes(program, isa):
    rows = []
    for sea, cache_bytes in itertools.product(BYTES_SEAS, BYTES_CACHES):
        moved = dict(bytes_beyond(program, isa, [sea], cache_bytes)[1])[f"{sea}/frame"]
        rows.append({"sea": sea, "cache_bytes": cache_bytes, "read": round(moved[0], 1),
                     "for_writing": round(moved[1], 1), "written": round(moved[2], 1)})
        text = ",\n".join("    " + json.dumps(row) for row in rows)
        BYTES.write_text(f'{{\n  "isa": {json.dumps(isa)},\n  "bytes_per_texel": [\n{text}\n  ]\n}}\n')
    print(f"wrote {BYTES}")


def key(row):
    return row["sea"], row["job"], row["isa"]


def unit_of(row):
    return "a point" if row["job"].startswith("query") else "a texel"


def print_table(rows, isas):
    print(f"{'sea':8}{'job':24}" + "".join(f"{isa:>10}" for isa in isas) + "  instructions")
    by_key = {key(row): row for row in rows}
    for sea, job in dict.fromkeys((row["sea"], row["job"]) for row in rows):
        figures = [by_key[sea, job, isa] for isa in isas]
        print(f"{sea:8}{job:24}" + "".join(f"{row['instructions']:10.2f}" for row in figures) + f"  {unit_of(figures[0])}")


def check(compiler, rows, budgets):
    if budgets["compiler"] != compiler:
        raise CannotCount(f"budgets are for {budgets['compiler']}, this is {compiler}")
    before = {key(row): row["instructions"] for row in budgets["budgets"]}
    faults = 0
    for row in rows:
        name = f"{row['job']} on {row['isa']}, sea {row['sea']}"
        if key(row) not in before:
            print(f"{name}: has no budget; instructions.py --update gives it one")
            faults += 1
            continue
        budget, now = before[key(row)], row["instructions"]
        change = now / budget - 1
        if change > MOST_MORE:
            print(f"{name}: {budget:.2f} instructions {unit_of(row)} before, {now:.2f} now, {100 * change:.1f} % more")
            faults += 1
        elif change < -MOST_MORE:
            print(f"{name}: {budget:.2f} before, {now:.2f} now; instructions.py --update keeps the gain")
    print(f"{len(rows)} counts, {faults} over budget")
    return faults == 0


def update(compiler, rows):
    budgets = json.loads(BUDGETS.read_text()) if BUDGETS.exists() else {"compiler": compiler, "budgets": []}
    if budgets["compiler"] != compiler:
        budgets = {"compiler": compiler, "budgets": []}
    merged = {key(row): row for row in [*budgets["budgets"], *rows]}
    write_budgets(compiler, [merged[name] for name in sorted(merged)], budgets.get("bytes", []))


def write_budgets(compiler, instructions, moved):
    lists = [f'  "{name}": [\n' + ",\n".join("    " + json.dumps(row) for row in rows) + "\n  ]"
             for name, rows in (("budgets", instructions), ("bytes", moved)) if rows]
    BUDGETS.write_text(f'{{\n  "compiler": {json.dumps(compiler)},\n' + ",\n".join(lists) + "\n}\n")
    print(f"wrote {BUDGETS}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=HERE.parents[1] / "build/release/bin/pelagic_count_jobs", type=pathlib.Path)
    parser.add_argument("--isa", help="instruction sets, separated by commas [sse4.2,avx2, or neon]")
    parser.add_argument("--seas", nargs="+", default=["1x256", "3x128"], help="cascades x resolution")
    parser.add_argument("--check", action="store_true", help="compare with bench/budgets.json")
    parser.add_argument("--update", action="store_true", help="write bench/budgets.json")
    parser.add_argument("--bytes", type=int, metavar="CACHE", help="bytes moved beyond a cache of that size, instead of instructions")
    parser.add_argument("--store-bytes", action="store_true", help="write bench/bytes.json")
    parser.add_argument("--of", nargs=argparse.REMAINDER, metavar="PROGRAM", help="count a program of your own")
    options = parser.parse_args()
    if options.of:
        for name, items, events in count(options.of)[1]:
            print(f"{name}\t{events['Ir'] / items:.3f}")
        return
    if not options.program.exists():
        parser.error(f"--program is {options.program}, which does not exist: build the target pelagic_count_jobs")
    isas = options.isa.split(",") if options.isa else isas_of(options.program)
    try:
        if options.store_bytes:
            return store_bytes(options.program, isas[-1])
        if options.bytes:
            compiler, jobs = bytes_beyond(options.program, isas[-1], options.seas, options.bytes)
            if options.update:
                update_bytes(compiler, isas[-1], options.bytes, jobs)
            elif options.check:
                sys.exit(0 if check_bytes(compiler, isas[-1], options.bytes, jobs,
                                          json.loads(BUDGETS.read_text())) else 1)
            else:
                print_bytes(isas[-1], options.bytes, jobs)
            return
        compiler, rows = rows_of(options.program, isas, options.seas)
        if options.update:
            update(compiler, rows)
        elif options.check:
            sys.exit(0 if check(compiler, rows, json.loads(BUDGETS.read_text())) else 1)
        else:
            print(f"compiled by {compiler}")
            print_table(rows, isas)
    except CannotCount as why:
        print(f"not counted: {why}")
        sys.exit(SKIPPED)


if __name__ == "__main__":
    main()
