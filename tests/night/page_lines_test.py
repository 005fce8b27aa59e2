#!/usr/bin/env python3
"""Runs every line of README and docs that calls `pelagic`, in order, in a new folder for each page,
and lets `pelagic` read every TOML block. Images are small. Other tests run the lines of
docs/render-farm.md and docs/integrations.

usage: page_lines_test.py SOURCE_FOLDER PELAGIC
"""
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

source, pelagic = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()


def floor_image():
    """Returns a PNG of 16 x 16 heights that rise along x."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(17 * i for i in range(16)) for _ in range(16))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 16, 16, 8, 0, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def shortened(line):
    if re.search(r"pelagic (render|view)\b", line):
        line += " --size 64x36 --quality low"
    if "pelagic bench" in line:
        line = re.sub(r" --seconds \S+", "", line.split("#")[0]) + " --seconds 0.1"
    return line


def run_page(page):
    """Returns the number of lines that ran."""
    lines = re.findall(r"^ {4}((?:build/release/bin/)?pelagic .*|echo .*)$", page.read_text(), re.MULTILINE)
    lines = [line for line in lines if "pelagic view" not in line]
    for number, block in enumerate(re.findall(r"^```toml\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)):
        pathlib.Path(f"block_{number}.toml").write_text(block)
        option = "--weather" if "[[change]]" in block else "--config"
        lines.append(f"pelagic query {option} block_{number}.toml --points buoys.csv --time 12.5")
    bin = pathlib.Path("build/release/bin")
    bin.mkdir(parents=True)
    (bin / "pelagic").symlink_to(pelagic)
    for folder in ("bench", "examples"):
        pathlib.Path(folder).symlink_to(source / folder)
    pathlib.Path("buoys.csv").write_text("0,0\n12.5,-3\n")
    pathlib.Path("island.png").write_bytes(floor_image())
    for line in lines:
        print(f"{page.name}: {line}", flush=True)
        done = subprocess.run(["bash", "-e", "-c", shortened(line)], env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0 or not (done.stdout or line.startswith("echo")):
            sys.exit(f"exit code {done.returncode}\n{done.stdout}")
    return len(lines)


environment = {**os.environ, "PATH": f"{pelagic.parent}:{os.environ['PATH']}"}
ran = 0
for page in [source / "README.md", *sorted((source / "docs").glob("*.md"))]:
    if page.name != "render-farm.md":
        with tempfile.TemporaryDirectory() as work:
            os.chdir(work)
            ran += run_page(page)
            os.chdir(source)
print(f"{ran} lines")
sys.exit(ran < 20)
