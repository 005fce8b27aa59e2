#!/usr/bin/env python3
"""Charts of stored results for README, docs/performance.md and bench/README.md.

    bench/chart.py            writes bench_frames.svg, bench_threads.svg, bench_bytes.svg and
                              bench_headset.svg in docs/images
    bench/chart.py --check    fails if the files differ from charts of the current results

Frames and threads are of bench/results, with a row of panels for each machine. Bytes are of
bench/bytes.json, and the headset model is the table of docs/integrations/vr.md.

Lines are labelled, and the background is white, so that charts are readable on light and dark
pages.
"""
import argparse
import html
import json
import math
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
ISAS = {"sse4.2": "SSE4.2", "neon": "NEON", "avx2": "AVX2", "avx512": "AVX-512"}  # weakest first
OURS, FFTW, PAPER, AXIS, TEXT = "#0b5cad", "#b45309", "#6b7280", "#d7dce2", "#24292f"
ISA_COLOURS = {"sse4.2": "#0f766e", "neon": "#0b5cad", "avx2": "#0b5cad", "avx512": "#7e3aa8"}
THREAD_COLOURS = ["#0b5cad", "#0f766e", "#7e3aa8", "#b45309", "#be185d", "#4d7c0f", "#6b7280"]
WIDTH, ROW, PLOT_WIDTH, PLOT_HEIGHT, LEFTS, TOP = 900, 372, 290, 250, (56, 504), 66
INSET = 26  # offset of the first and the last N


class Machine:
    """A file of bench/results: frames by instruction set and threads, ordered by N.
    """

    def __init__(self, file):
        results = json.loads(file.read_text())
        self.name = f"{results['cpu']}, {results['compiler']}"
        self.rows = sorted((row for row in results["rows"] if row.get("cascades", 1) == 1), key=lambda row: row["n"])
        self.isas = [isa for isa in ISAS if any(row["isa"] == isa for row in self.rows)]
        self.threads = sorted({row["threads"] for row in self.rows})
        self.has_peers = all("fftw_ms" in row for row in self.rows)

    def points(self, figure, isa, threads=1):
        return [(row["n"], figure(row)) for row in self.rows if row["isa"] == isa and row["threads"] == threads]


class Counts:
    """Bytes of frames, which do not depend on the machine."""

    def __init__(self, counted):
        self.name = f"Counted by valgrind, {ISAS[counted['isa']]}: read, fetched for writing and written"
        self.rows = counted["bytes_per_texel"]


class Headset:
    """Rows of the headset model."""

    name = "Model of headset cores, from 2.8 GHz without cache misses to 2.0 GHz with estimated losses"

    def __init__(self, rows):
        self.rows = rows


class Panel:
    """Axes with N, or another size, along x, and lines with their names at the right ends."""

    def __init__(self, left, top, title, sizes, ticks, low, high, logarithmic=False, label="N, texels along a side",
                 name_of=str):
        self.left, self.top, self.logarithmic, self.low, self.high = left, top, logarithmic, low, high
        self.sizes = sizes
        self.names = []  # (y, name, colour)
        self.svg = [text(left - 40, top - 18, title, TEXT, weight=600)]
        for value in ticks:
            y = self.y(value)
            self.svg.append(f'<path d="M{left} {y:.1f}h{PLOT_WIDTH}" stroke="{AXIS}"/>')
            self.svg.append(text(left - 8, y + 4, f"{value:g}", PAPER, "end"))
        for n in sizes:
            self.svg.append(text(self.x(n), top + PLOT_HEIGHT + 20, name_of(n), PAPER, "middle"))
        self.svg.append(text(left + PLOT_WIDTH / 2, top + PLOT_HEIGHT + 38, label, PAPER, "middle"))

    def x(self, n):
        low, high = math.log2(self.sizes[0]), math.log2(self.sizes[-1])
        return self.left + INSET + (PLOT_WIDTH - 2 * INSET) * (math.log2(n) - low) / max(1, high - low)

    def y(self, value):
        scale = math.log10 if self.logarithmic else float
        part = (scale(value) - scale(self.low)) / (scale(self.high) - scale(self.low))
        return self.top + PLOT_HEIGHT * (1 - part)

    def line(self, points, name, colour):
        at = [(self.x(n), self.y(value)) for n, value in points]
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in at)
        self.svg.append(f'<path d="M{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        self.svg += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in at]
        self.names.append((at[-1][1], name, colour))

    def values(self, points, colour, below):
        """Writes the milliseconds beside each point."""
        for n, value in points:
            digits = f"{value:#.2g}" if value < 1 else f"{value:#.3g}" if value < 100 else f"{value:.0f}"
            self.svg.append(text(self.x(n), self.y(value) + (18 if below else -10), digits, colour, "middle", size=11))

    def bars(self, points, colour):
        for n, (low, high) in points:
            self.svg.append(f'<path d="M{self.x(n):.1f} {self.y(low):.1f}V{self.y(high):.1f}" stroke="{colour}" '
                            'stroke-width="6" stroke-opacity="0.25"/>')

    def level(self, value, name):
        y = self.y(value)
        self.svg.append(f'<path d="M{self.left} {y:.1f}h{PLOT_WIDTH}" stroke="{PAPER}" stroke-dasharray="5 4"/>')
        self.names.append((y, name, PAPER))

    def drawn(self):
        """Names have at least one line height between them."""
        named, last = [], -math.inf
        for y, name, colour in sorted(self.names):
            last = max(y, last + 16)
            named.append(text(self.left + PLOT_WIDTH + 6, last + 4, name, colour, weight=600))
        return "\n".join(self.svg + named)


def text(x, y, words, colour, anchor="start", weight=400, size=12.5):
    """With a white outline, so that text is readable on lines."""
    return (f'<text x="{x:.1f}" y="{y:.1f}" fill="{colour}" text-anchor="{anchor}" font-weight="{weight}" '
            f'font-size="{size}" stroke="#ffffff" stroke-width="3" paint-order="stroke">{html.escape(words)}</text>')


def linear_ticks(highest):
    """Returns ticks from 0 to above the highest value, at most seven."""
    step = next(step for step in (0.1, 0.2, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if highest / step <= 6)
    return [step * i for i in range(math.ceil(highest / step) + 1)]


def frames_panels(machine, top):
    isa = machine.isas[-1]
    kinds = [("paper_ms", "the paper", PAPER), ("fftw_ms", "FFTW frame", FFTW), ("ours_ms", "Pelagic", OURS)]
    lines = [(machine.points(lambda row: row[key], isa), name, colour) for key, name, colour in kinds]
    values = [value for points, _, _ in lines for _, value in points]
    low, high = min(values) / 2.5, max(values) * 2.5
    sizes = [n for n, _ in lines[0][0]]
    times = Panel(LEFTS[0], top, f"Milliseconds a frame, one thread, {ISAS[isa]}", sizes,
                  [10.0**e for e in range(-6, 7) if low < 10.0**e < high], low, high, logarithmic=True)
    for points, name, colour in lines:
        times.line(points, name, colour)
    times.values(lines[0][0], PAPER, below=False)
    times.values(lines[2][0], OURS, below=True)

    quartiles = [quartile for row in machine.rows for quartile in row["ours_over_fftw_quartiles"]]
    ticks = linear_ticks(max(1, *quartiles))
    ratios = Panel(LEFTS[1], top, "Pelagic's time over the FFTW frame's, quartiles of turns", sizes, ticks, 0, ticks[-1])
    ratios.level(1, "FFTW frame")
    for isa in machine.isas:
        ratios.bars(machine.points(lambda row: row["ours_over_fftw_quartiles"], isa), ISA_COLOURS[isa])
        ratios.line(machine.points(lambda row: row["ours_over_fftw"], isa), ISAS[isa], ISA_COLOURS[isa])
    return times, ratios


def threads_panels(machine, top):
    isa = machine.isas[-1]
    sizes = [n for n, _ in machine.points(lambda row: row["ours_ms"], isa)]
    faster = {threads: machine.points(lambda row: row["speedup"], isa, threads) for threads in machine.threads[1:]}
    ticks = linear_ticks(max([1] + [value for points in faster.values() for _, value in points]))
    threads_panel = Panel(LEFTS[0], top, f"Times as fast as on one thread, {ISAS[isa]}", sizes, ticks, 0, ticks[-1])
    threads_panel.level(1, "one thread")
    for colour, (threads, points) in zip(THREAD_COLOURS, faster.items()):
        threads_panel.line(points, f"{threads} threads", colour)

    def ns_per_texel(row):
        return row["ours_ms"] * 1e6 / row["n"]**2

    lines = {isa: machine.points(ns_per_texel, isa) for isa in machine.isas}
    ticks = linear_ticks(max(value for points in lines.values() for _, value in points))
    isas_panel = Panel(LEFTS[1], top, "Nanoseconds a texel, one thread", sizes, ticks, 0, ticks[-1])
    for isa, points in lines.items():
        isas_panel.line(points, ISAS[isa], ISA_COLOURS[isa])
    return threads_panel, isas_panel


def sea_text(sea):
    return sea.replace("x", " x ")


def bytes_panels(counts, top):
    """Two panels: seas of one cascade, and the default sea beside one cascade of its size."""
    rows = {}
    for row in counts.rows:
        rows.setdefault(row["sea"], []).append((row["cache_bytes"] >> 10, row["read"] + row["for_writing"] + row["written"]))
    sizes = [size for size, _ in next(iter(rows.values()))]
    ticks = linear_ticks(max(value for points in rows.values() for _, value in points))

    def name_of(kib):
        exponent = kib.bit_length() - 1
        return "" if exponent % 2 == 0 else f"{kib}K" if kib < 1024 else f"{kib >> 10}M"

    panels = []
    for left, title, seas in ((LEFTS[0], "Bytes a texel beyond a cache, one cascade", ["1x64", "1x256", "1x1024"]),
                              (LEFTS[1], "Bytes a texel beyond a cache, N = 128", ["1x128", "4x128"])):
        panel = Panel(left, top, title, sizes, ticks, 0, ticks[-1], label="size of the cache, bytes", name_of=name_of)
        for sea, colour in zip(seas, THREAD_COLOURS):
            points = rows[sea]
            panel.line(points, "", colour)
            size, value = next(point for point in points if point[1] < 0.75 * points[0][1])
            panel.svg.append(text(panel.x(size) + 8, panel.y(value) - 6, sea_text(sea), colour, weight=600))
        panels.append(panel)
    return panels


def headset_rows():
    """Returns (sea, threads, X3-like range, A715-like range) of each row."""
    number = r"([\d.]+)"
    line = re.compile(rf"^\| (\d+x\d+) \| (\d+) \| {number} to {number} \| {number} to {number} \|", re.MULTILINE)
    page = (ROOT / "docs/integrations/vr.md").read_text()
    return [(sea, int(threads), (float(a), float(b)), (float(c), float(d)))
            for sea, threads, a, b, c, d in line.findall(page)]


def headset_panels(headset, top):
    rows = headset.rows
    seas = list(dict.fromkeys(sea for sea, *_ in rows))
    ticks = linear_ticks(max(high for _, _, *ranges in rows for _, high in ranges))
    places = [2**i for i in range(len(seas))]
    panels = []
    for left, title, at in ((LEFTS[0], "Milliseconds a frame, X3-like cores, model", 2),
                            (LEFTS[1], "Milliseconds a frame, A715-like cores, model", 3)):
        panel = Panel(left, top, title, places, ticks, 0, ticks[-1], label="cascades x N",
                      name_of=lambda place: sea_text(seas[place.bit_length() - 1]))
        for row in rows:
            threads, (low, high) = row[1], row[at]
            x = panel.x(places[seas.index(row[0])]) + 12 * (threads - 2)
            panel.svg.append(f'<path d="M{x:.1f} {panel.y(low):.1f}V{panel.y(high):.1f}" '
                             f'stroke="{THREAD_COLOURS[threads - 1]}" stroke-width="8"/>')
        for threads in sorted({row[1] for row in rows}):
            panel.names.append((panel.y(ticks[-1]) + 16 * threads, f"{threads} thread{'s' * (threads > 1)}",
                                THREAD_COLOURS[threads - 1]))
        panels.append(panel)
    return panels


def chart(machines, panels_of):
    height = ROW * len(machines) + 8
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" '
             'font-family="system-ui, -apple-system, Segoe UI, Helvetica, Arial, sans-serif">',
             f'<rect x="0.5" y="0.5" width="{WIDTH - 1}" height="{height - 1}" rx="8" fill="#ffffff" stroke="{AXIS}"/>']
    for row, machine in enumerate(machines):
        top = ROW * row
        parts.append(text(16, top + 24, machine.name, PAPER))
        parts += [panel.drawn() for panel in panels_of(machine, top + TOP)]
    return "\n".join(parts + ["</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    options = parser.parse_args()
    machines = [Machine(file) for file in sorted((ROOT / "bench/results").glob("*.json"))]
    charts = {"bench_frames.svg": chart([machine for machine in machines if machine.has_peers], frames_panels),
              "bench_threads.svg": chart(machines, threads_panels),
              "bench_bytes.svg": chart([Counts(json.loads((ROOT / "bench/bytes.json").read_text()))], bytes_panels),
              "bench_headset.svg": chart([Headset(headset_rows())], headset_panels)}
    stale = []
    for name, svg in charts.items():
        file = ROOT / "docs/images" / name
        if not options.check:
            file.write_text(svg)
        elif not file.exists() or file.read_text() != svg:
            stale.append(name)
    if stale:
        sys.exit(f"docs/images/{', '.join(stale)}: not of today's bench/results; bench/chart.py makes them anew")


if __name__ == "__main__":
    main()
