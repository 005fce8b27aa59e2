#!/usr/bin/env python3
"""Runs the benchmark programs several times and stores the least time of each figure, and medians of the costs of
options, which are ratios of one run.

    bench/measure.py build/release/bin --runs 5          writes bench/results/programs/CPU.json
    bench/measure.py build/release/bin --keep query      query only; keeps smaller stored times

The least time is the one that other work on the machine disturbed least. Figures of one thread are
CPU time if the program measures it, others elapsed time. Times are in microseconds: of a frame, a
tick, a selection, a ray, a queried point, a command, or an export of 11 frames.
"""
import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import tempfile

RESULTS = pathlib.Path(__file__).resolve().parent / "results/programs"


def printed(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def google(filter_, per_item=False, elapsed=False, counter=None, repetitions=3):
    """Returns a function that runs a program of Google Benchmark and yields names and times."""
    def run(program):
        output = printed(program, f"--benchmark_filter={filter_}", f"--benchmark_repetitions={repetitions}",
                         "--benchmark_min_time=0.1", "--benchmark_format=json")
        for row in json.loads(output)["benchmarks"]:
            if row["run_type"] != "iteration":
                continue
            name = re.sub("^time_frame/|/iterations:.*|/real_time$", "", row["run_name"])
            time = row["real_time" if elapsed else "cpu_time"] / {"ns": 1e3, "us": 1}[row["time_unit"]]
            if counter:
                time = row[counter] * 1e3
            elif per_item and not name.startswith("frame"):
                time = 1e6 / row["items_per_second"]
            yield name, time
            if "patches" in row:
                yield f"patches/{name}", row["patches"]
    return run


def table(row_pattern, columns, isa="avx2"):
    """Returns a function that runs a program which prints a table, and yields its figures."""
    def run(program):
        for line in printed(program, isa).splitlines():
            if match := re.match(row_pattern, line):
                fields = re.sub(r"\(.*?\)", "", line[match.end():]).split()
                name = "/".join(match.groups()).replace(" ", "")
                yield from ((f"{column}/{isa}/{name}", float(field)) for column, field in zip(columns, fields))
            elif match := re.match(r"(a frame|four grids).*, (\d) thread.*: ([\d.]+) ms", line):
                yield f"{match[1]}/{isa}/{match[2]}", float(match[3]) * 1e3
    return run


def cpu_us(*command):
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"{' '.join(command)}: failed")
    return (usage.ru_utime + usage.ru_stime) * 1e6


def commands(program):
    """CPU time of short commands, and of exports of 12 frames less 1 frame."""
    with tempfile.TemporaryDirectory() as folder:
        points = pathlib.Path(folder, "points.csv")
        points.write_text("0,0\n")
        for words in (["--help"], ["quadtree"], ["info"], ["query", "--points", str(points)]):
            yield words[0], min(cpu_us(program, *words) for _ in range(3))
        for compression in ("zip", "piz", "dwaa", "none"):
            def export(frames):
                out = pathlib.Path(folder, f"{compression}{frames}")
                us = cpu_us(program, "export", "--out", str(out), "--patch-size", "200", "--resolution", "512",
                            "--maps", "displacement", "--frames", str(frames), "--threads", "2",
                            "--compression", compression, "--no-sync")
                return us, sum(file.stat().st_size for file in out.glob("*.exr"))
            long, short = export(12), export(1)
            yield f"export/{compression}", long[0] - short[0]
            yield f"export bytes/{compression}", long[1] - short[1]


def costs(program):
    """Ratios to the bare frame by option, warm and at 72 Hz, and memory in MB."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "costs.json")
        printed(program, "bench", "--cost", "--seconds", "12", "--isa", "avx2", "--json", file)
        for row in json.loads(file.read_text())["rows"]:
            yield f"warm/{row['option']}", row["warm_ratio"]
            yield f"rhythm/{row['option']}", row["rhythm_ratio"]
            yield f"memory_mb/{row['option']}", row["memory_bytes"] / 1e6


QUERIES = (r"^(height|height\+normal|height\+normal\+velocity|cubic/height\+normal)/.*/(256|4x128)/random$"
           r"|^(ray|frame.*)/(avx2|avx512)/(256|4x128)$")
ANALYTIC = r"^((rest|world)/height\+normal/avx2/16|pond/height\+normal/avx2/24)$"
SHORE = ["baking_s", "memory_mb", "frame", "open frame", "ratio", "query_ns", "open query_ns"]
PROGRAMS = {
    "frame": ("pelagic_bench", google("^frame/(avx2|avx512)/([34]x128|256|512)/[12](/|$)", elapsed=True)),
    "query": ("pelagic_query_bench", google(QUERIES, per_item=True)),
    "analytic": ("pelagic_analytic_bench", google(ANALYTIC, per_item=True)),
    "quadtree": ("pelagic_quadtree_bench", google("/medium/")),
    "gl": ("pelagic_gl_bench", google("one_eye", counter="own_ms", repetitions=1)),
    "foam": ("pelagic_foam_bench", table(r"(\d x \d+) +avx2", ["none", "no tick", "tick", "mean", "jump"])),
    "inputs": ("pelagic_inputs_bench", table(r"(\d x \d+) +avx2", ["none", "zeros", "waves"])),
    "shore": ("pelagic_shore_bench", table(r" *(\d+)(?= )", SHORE)),
    "dynamic waves": ("pelagic_dynamic_waves_bench", table(r" *(\d+) +(\d)(?= )", ["frame", "spectral", "verlet"])),
    "command": ("pelagic", commands),
    "cost": ("pelagic", costs),
}


def machine_and_sizes(folder):
    """Returns CPU and compiler, and memory and upload of seas, which are no times."""
    with tempfile.TemporaryDirectory() as out:
        file = pathlib.Path(out, "bench.json")
        printed(folder / "pelagic", "bench", "--seconds", "0.1", "--isa", "avx2", "--threads", "1", "--json", file)
        bench = json.loads(file.read_text())
    sizes = {}
    for row in bench["rows"]:
        name = f"{row['isa']}/{row['cascades']}x{row['n']}"
        sizes |= {f"memory bytes/{name}": row["memory_bytes"], f"upload bytes/{name}": row["upload_bytes"]}
    return {"cpu": bench["cpu"], "compiler": bench["compiler"]}, sizes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="folder with the programs")
    parser.add_argument("subjects", nargs="*", default=list(PROGRAMS), help=", ".join(PROGRAMS))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--keep", action="store_true", help="keep smaller times of the stored file")
    options = parser.parse_args()
    machine, sizes = machine_and_sizes(options.folder)
    file = RESULTS / (re.sub("[^a-z0-9]+", "-", machine["cpu"].lower()).strip("-") + ".json")
    figures = json.loads(file.read_text())["figures"] if options.keep and file.exists() else {}
    ratios = {}
    for _ in range(options.runs):
        for subject in options.subjects:
            program, run = PROGRAMS[subject]
            for name, value in run(options.folder / program):
                name = f"{subject}/{name.removeprefix(subject + '/')}"
                value = float(f"{value:.4g}")
                if subject == "cost":
                    ratios.setdefault(name, []).append(value)
                    figures[name] = float(f"{statistics.median(ratios[name]):.4g}")
                else:
                    figures[name] = min(figures.get(name, value), value)
        file.write_text(json.dumps(machine | {"figures": dict(sorted((figures | sizes).items()))}, indent=1) + "\n")


if __name__ == "__main__":
    main()
