#!/usr/bin/env python3
"""Tables of docs/performance.md from stored results, and the figures that README takes from them.

    bench/tables.py            writes tables into docs/performance.md, and figures into README
    bench/tables.py --check    fails if a table or a figure is not that of the stored results

Frames beside peers are of bench/results (pelagic-compare), instructions of bench/budgets.json, all
other figures of bench/results/programs (bench/measure.py).
"""
import argparse
import json
import pathlib
import re
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[1]
MACHINE = "amd-epyc-family-26-model-2.json"
COMPARED_MACHINE = "amd-epyc-family-26-model-2.json"
COSTED_MACHINE = "amd-epyc-family-25-model-17.json"
GENERATIONS = {"family 25, model 17": "Zen 4", "family 26, model 2": "Zen 5"}
ISAS = {"avx2": "AVX2", "avx512": "AVX-512", "sse4.2": "SSE4.2", "neon": "NEON"}
SEAS = {"3x128": "3 x 128", "4x128": "4 x 128", "1x256": "1 x 256", "1x512": "1 x 512"}

measured = json.loads((ROOT / "bench/results/programs" / MACHINE).read_text())
costed = json.loads((ROOT / "bench/results/programs" / COSTED_MACHINE).read_text())
compared = json.loads((ROOT / "bench/results" / COMPARED_MACHINE).read_text())
budgets = json.loads((ROOT / "bench/budgets.json").read_text())["budgets"]
figures = measured["figures"]


def generation(results):
    """Returns the marketing name of a CPU's generation, such as Zen 4."""
    return next(name for model, name in GENERATIONS.items() if model in results["cpu"])


def machine(results):
    return f"{results['cpu'].replace('EPYC', f'EPYC {generation(results)}')}, {results['compiler']}"


def number(value, digits=3):
    """Returns a decimal with some significant digits, without an exponent."""
    text = f"{value:#.{digits}g}"
    return f"{value:.0f}" if "e" in text else text.rstrip(".")


def ms(name):
    return number(figures[name] / 1e3)


def million_per_s(name):
    return number(1 / figures[name])


def table(head, rows):
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in [head, *rows]]
    return "\n".join([lines[0], "|" + "---|" * len(head), *lines[1:]]).replace("|  |", "| |")


def frames():
    rows = {(row["isa"], row["n"]): row for row in compared["rows"] if row["threads"] == 1}
    sizes = sorted({n for _, n in rows})

    def row(name, isa, figure, digits=3):
        return [name, *(number(figure(rows[isa, n]), digits) for n in sizes)]
    def known(name, isa, figure):
        """Returns the row in a list, or an empty list if the figure is not stored."""
        return [row(name, isa, lambda row: row[figure], 2)] if all(figure in rows[isa, n] for n in sizes) else []

    textures = ", textures only" if compared.get("textures_only") else ""
    return f"{machine(compared)}; one cascade, one thread{textures}, ms:", table(["N", *sizes], [
        row("AVX2", "avx2", lambda row: row["ours_ms"]),
        row("AVX-512", "avx512", lambda row: row["ours_ms"]),
        row("FFTW frame, beside AVX2", "avx2", lambda row: row["fftw_ms"]),
        row("AVX2 / FFTW frame", "avx2", lambda row: row["ours_over_fftw"], 2),
        row("AVX-512 / FFTW frame", "avx512", lambda row: row["ours_over_fftw"], 2),
        *known("AVX2 / FFTW frame, cold", "avx2", "ours_over_fftw_cold"),
        *known("AVX-512 / FFTW frame, cold", "avx512", "ours_over_fftw_cold"),
        *known("AVX2 / KISS FFT frame", "avx2", "ours_over_kiss"),
        row("paper's loop / AVX2", "avx2", lambda row: row["paper_ms"] / row["ours_ms"], 2)])


def threads():
    rows = {(row["isa"], row["n"]): row["speedup"] for row in compared["rows"] if row["threads"] == 2}
    sizes = sorted({n for _, n in rows})
    return (f"{machine(compared)}; one cascade, speed-up on two threads over one:",
            table(["N", *sizes], [[ISAS[isa], *(f"{rows[isa, n]:.2f}" for n in sizes)] for isa in ("avx2", "avx512")]))


def instructions():
    counts = {(row["isa"], row["sea"]): row["instructions"] for row in budgets if row["job"] == "frame"}
    fftw = {f"1x{row['n']}": row["fftw_instructions_per_texel"] for row in compared["rows"]
            if "fftw_instructions_per_texel" in row}
    seas = ["1x64", "1x256", "1x1024", "4x128"]
    return "g++ 12.2, one thread, instructions per texel of a frame:", table(
        ["", *(sea.replace("x", " x ") for sea in seas)],
        [*([ISAS[isa], *(f"{counts[isa, sea]:.1f}" for sea in seas)] for isa in ("avx2", "sse4.2", "neon")),
         ["FFTW frame, AVX2", *(f"{fftw[sea]:.1f}" if sea in fftw else "-" for sea in seas)]])


def default_sea():
    def row(sea):
        return [SEAS[sea], *(ms(f"frame/{isa}/{sea}/{count}") for isa in ("avx2", "avx512") for count in (1, 2))]
    return f"{machine(measured)}; frame with slopes and moments, ms:", table(
        ["", "AVX2", "AVX2, two threads", "AVX-512", "AVX-512, two threads"], map(row, ("3x128", "4x128")))


def foam_bytes(sea):
    """Returns the bytes of snapshots that a frame after a foam tick uploads: one image of each
    cascade but the fourth."""
    cascades, n = map(int, sea.split("x"))
    return min(cascades, 3) * 4 * (4 * n * n - 1) // 3


def memory():
    def row(sea):
        memory_bytes, upload = figures[f"memory bytes/avx2/{sea}"], figures[f"upload bytes/avx2/{sea}"]
        return [SEAS[sea], *(number(size / 1e6) for size in (memory_bytes, upload, upload + foam_bytes(sea)))]
    return "AVX2, MB:", table(["", "memory", "upload per frame", "after a foam tick"], map(row, ("4x128", "1x256", "1x512")))


def upload():
    keys = {"copied": "moderate_one_eye", "written by the jobs": "moderate_one_eye_mapped"}
    return f"{machine(measured)}; upload and draw of 1 x 256 with slopes, one view, CPU time without the driver, ms:", table(
        list(keys), [[ms(f"gl/{key}") for key in keys.values()]])


def queries():
    columns = [("256", "avx2"), ("256", "avx512"), ("256", "sse4.2"), ("4x128", "avx2"), ("4x128", "avx512")]
    kinds = {"height": "height", "height, normal": "height+normal", "height, normal, velocity": "height+normal+velocity",
             "height, normal; cubic": "cubic/height+normal"}
    rays = [f"query/ray/{isa}/{sea}" for sea, isa in columns]
    return f"{machine(measured)}; one thread, random positions, choppiness 1, million points/s:", table(
        ["", *(f"{SEAS.get(sea, '1 x 256')}, {ISAS[isa]}" for sea, isa in columns)],
        [*([name, *(million_per_s(f"query/{key}/{isa}/{sea}/random") for sea, isa in columns)] for name, key in kinds.items()),
         ["ray from 20 m, µs", *(number(figures[ray], 2) if ray in figures else "-" for ray in rays)]])


def option_cost():
    options = {"queries": "queries", "velocities drawn": "velocities drawn", "water": "velocities water",
               "depth": "depth", "foam": "foam", "dynamic waves": "dynamic waves 256", "hull": "hull",
               "1,000 heights": "1,000 heights", "all for a boat": "boat"}
    rows = {"frames one after another": "warm", "a frame each 13.9 ms": "rhythm", "memory, MB": "memory_mb"}
    return f"{machine(costed)}; one thread, AVX2, default sea, processor time / that of a frame without options:", table(
        ["", *options],
        [[name, *(number(costed["figures"][f"cost/{key}/{option}"]) for option in options.values())]
         for name, key in rows.items()])


def analytic():
    keys = {"reference positions": "rest/height+normal/avx2/16", "world positions": "world/height+normal/avx2/16",
            "reference positions, default pond": "pond/height+normal/avx2/24"}
    return f"{machine(measured)}; one thread, AVX2, 16 analytic waves, height and normal, million points/s:", table(
        list(keys), [[million_per_s(f"analytic/{key}") for key in keys.values()]])


def quadtree():
    sizes = (512, 2048, 8192)

    def row(name, key, digits=3):
        return [name, *(number(figures[f"quadtree/{key}/medium/{size}"], digits) for size in sizes)]
    return f"{machine(measured)}; one thread, preset medium, 80 degrees, µs:", table(
        ["side of the sea", *(f"{size:,} m" for size in sizes)],
        [row("one view", "selection"), row("two eyes", "stereo"), row("one view, the paper's traversal", "paper"),
         row("patches of one view", "patches/selection", 2)])


def foam():
    def row(sea):
        none, quiet, tick, jump = (figures[f"foam/{key}/avx2/{sea}"] for key in ("none", "no tick", "tick", "jump"))
        mean = quiet + (tick - quiet) * 10 / 72
        return [SEAS[sea], *(f"{value / none:.2f}" for value in (quiet, tick, mean)), number(jump / 1e3, 2)]
    return f"{machine(measured)}; one thread, AVX2, frame time / frame time without foam:", table(
        ["", "between ticks", "with a tick", "mean at 72 frames/s", "jump in time, ms"],
        map(row, ("4x128", "3x128", "1x256")))


def dynamic_waves():
    def row(n):
        return [n, *(ms(f"dynamic waves/{kind}/avx2/{n}/{count}") for kind in ("spectral", "verlet") for count in (1, 2))]
    return f"{machine(measured)}; AVX2, ms per tick:", table(
        ["texels per side", "spectral", "spectral, two threads", "Verlet", "Verlet, two threads"], map(row, (128, 256, 512)))


def server():
    rows = {"frame of 4 x 128, 12 points on each of 1,000 boats": "a frame",
            "tick of four grids of 256 with 250 hulls each": "four grids"}
    return f"{machine(measured)}; AVX2, ms:", table(
        ["", "one thread", "two threads"],
        [[name, *(ms(f"dynamic waves/{key}/avx2/{count}") for count in (1, 2))] for name, key in rows.items()])


def shore():
    def row(n):
        baking, size, frame, open_frame, query, open_query = (
            figures[f"shore/{key}/avx2/{n}"]
            for key in ("baking_s", "memory_mb", "frame", "open frame", "query_ns", "open query_ns"))
        return [n, number(baking, 2), number(size, 2), f"{frame / open_frame:.2f}", f"{query / open_query:.1f}"]
    return f"{machine(measured)}; one thread, AVX2, 1 km of the default sea:", table(
        ["texels per side", "baking, s", "memory, MB", "frame time / without", "height query / without"],
        map(row, (64, 128, 256, 512)))


def inputs():
    def row(sea):
        none, zeros, waves = (figures[f"inputs/{key}/avx2/{sea}"] for key in ("none", "zeros", "waves"))
        return [SEAS[sea], f"{zeros / none:.2f}", f"{waves / none:.2f}"]
    return f"{machine(measured)}; one thread, AVX2, frame time / frame time without inputs:", table(
        ["", "an input of zeros", "16 Gerstner waves and a ring"], map(row, ("4x128", "3x128", "1x256")))


def export():
    floats = 11 * 512 * 512 * 3 * 4  # bytes

    def row(name, key):
        return [name, f"{figures[f'command/export bytes/{key}'] / floats:.3f}", number(floats / figures[f"command/export/{key}"], 2)]
    return f"{machine(measured)}; displacement of 1 x 512, MB of floats per second of CPU time:", table(
        ["compression", "size ratio", "MB/s"],
        [row("`zip`", "zip"), row("`piz`", "piz"), row("`dwaa`, lossy", "dwaa"), row("`none`", "none")])


def commands():
    names = {"`--help`": "--help", "`quadtree`": "quadtree", "`query` of one point": "query", "`info`": "info"}
    return f"{machine(measured)}; CPU time of a command, ms:", table(
        list(names), [[number(figures[f"command/{key}"] / 1e3, 2) for key in names.values()]])


TABLES = [frames, threads, instructions, default_sea, memory, upload, option_cost, queries, analytic, quadtree, foam,
          dynamic_waves, server, shore, inputs, export, commands]

# Figures in prose: page, expression with one group, text that the group must have.
FIGURES = [
    ("README.md", r"([\d.]+) ms for a frame of the default sea \(one thread, AVX2,",
     lambda: number(figures["frame/avx2/4x128/1"] / 1e3, 2)),
    ("README.md", r"one thread, AVX2, AMD EPYC (Zen \d)", lambda: generation(measured)),
    ("README.md", r"default sea gives ([\d.]+) million points/s",
     lambda: number(1 / figures["query/height+normal/avx2/4x128/random"])),
    ("README.md", r"choppiness 1, AVX2, AMD EPYC \((Zen \d)\)", lambda: generation(measured)),
]


def generated(page, text):
    """Returns the page's text with the tables and figures of the stored results."""
    for function in TABLES:
        begin = marker(function)
        if begin in text:
            head, content = function()
            before, _, rest = text.partition(begin)
            head = textwrap.fill(head, 118)
            text = f"{before}{begin}{head}\n\n{content}\n<!-- /generated -->{rest.partition('<!-- /generated -->')[2]}"
    for _, pattern, value in (figure for figure in FIGURES if figure[0] == page):
        found = list(re.finditer(pattern.replace(" ", r"\s+"), text))
        if len(found) != 1:
            sys.exit(f"{page}: {len(found)} places match {pattern}, expected one")
        text = text[:found[0].start(1)] + value() + text[found[0].end(1):]
    return text


def marker(function):
    return f"<!-- generated: {function.__name__.replace('_', '-')} -->\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    options = parser.parse_args()
    performance = (ROOT / "docs/performance.md").read_text()
    missing = [function.__name__ for function in TABLES if marker(function) not in performance]
    if missing or performance.count("<!-- generated") != len(TABLES):
        sys.exit(f"docs/performance.md: tables are missing or unknown: {missing}")
    stale = []
    for page in ("README.md", "docs/performance.md"):
        file = ROOT / page
        old, new = file.read_text(), generated(page, file.read_text())
        if not options.check:
            file.write_text(new)
        elif old != new:
            stale += [f"{page}: {line}" for line in new.splitlines() if line not in old.splitlines()]
    if stale:
        sys.exit("\n".join(["expected, from bench/results (bench/tables.py writes them):", *stale]))


if __name__ == "__main__":
    main()
