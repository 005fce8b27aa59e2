#!/usr/bin/env python3
"""Compares the command for Windows with the command for Linux: exports have the same bytes, and other
commands print the same lines. Then exports in hard places: killed, resumed, in shards, two at once, and
in folders with long names, letters of other alphabets and drive letters.

usage: export_test.py WORK_FOLDER PELAGIC_OF_LINUX WINE_PREFIX PELAGIC_OF_WINDOWS...

The last may begin with an emulator. Exits with 77, skipped, if the command for Linux is not built.
"""
import os
import pathlib
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import zlib

SETS = 40
SPEED = ["--threads", "2", "--no-sync"]
SIZE = ["--resolution", "16", *SPEED]
work, linux, prefix = pathlib.Path(sys.argv[1]).resolve(), [sys.argv[2]], pathlib.Path(sys.argv[3])
windows = sys.argv[4:]
ENVIRONMENT = {**os.environ, "LC_ALL": "C.UTF-8"}  # wine converts arguments by it


def run(command, *arguments, folder=None):
    done = subprocess.run([*command, *map(str, arguments)], capture_output=True, env=ENVIRONMENT, cwd=folder or work, timeout=120)
    return done.returncode, done.stdout.decode(), done.stderr.decode().replace("\r\n", "\n")


def start(command, *arguments):
    return subprocess.Popen([*command, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=ENVIRONMENT, cwd=work)


def files_of(folder):
    """Names and contents, without the lock, which stays after an export."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*"))
            if file.is_file() and not file.name.endswith(".lock")}


def expect(condition, *what):
    if not condition:
        sys.exit("\n".join(["export_test.py:", *map(str, what)]))


def expect_equal_folders(a, b, *what):
    expect(a.is_dir() and b.is_dir(), *what, f"{a} or {b} is missing")
    files, others = files_of(a), files_of(b)
    names = [name for name in {**files, **others} if files.get(name) != others.get(name)]
    expect(files and not names, *what, f"these files differ: {names}")


def export_both(name, *arguments):
    """Exports on both systems and compares everything. Returns whether the options were accepted."""
    results = []
    for system, command in (("linux", linux), ("windows", windows)):
        (work / system).mkdir(exist_ok=True)
        results.append(run(command, "export", *arguments, folder=work / system))
    expect(results[0] == results[1], f"export {' '.join(map(str, arguments))}", *results)
    if results[0][0] == 0:
        expect_equal_folders(work / "linux" / name, work / "windows" / name, f"export {' '.join(map(str, arguments))}")
    return results[0][0] == 0


def accepted_by_windows(*arguments, folder=None):
    code, out, error = run(windows, *arguments, folder=folder)
    expect(code == 0, f"{' '.join(map(str, arguments))}: exit code {code}", out, error)
    return out


def refused_by_windows(line, *arguments):
    code, _, error = run(windows, *arguments)
    expect(code == 2 and error == f"pelagic: {line}\n", f"{' '.join(map(str, arguments))}: exit code {code}", error, "expected", line)


def write_png(file, bits, columns=12, rows=9):
    """A floor that falls from white to black."""
    most = (1 << bits) - 1
    values = [[round(most * (column + row) / (columns + rows - 2)) for column in range(columns)] for row in range(rows)]
    lines = b"".join(b"\0" + b"".join(value.to_bytes(bits // 8, "big") for value in line) for line in values)
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", columns, rows, bits, 0, 0, 0, 0)), (b"IDAT", zlib.compress(lines)), (b"IEND", b""))
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks))


def write_exr(file, columns=10, rows=8):
    """A floor of 32-bit floats, not compressed."""
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value
    window = struct.pack("<4i", 0, 0, columns - 1, rows - 1)
    header = struct.pack("<II", 20000630, 2) + b"".join((
        attribute(b"channels", b"chlist", b"Y\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) + b"\0"),
        attribute(b"compression", b"compression", b"\0"), attribute(b"dataWindow", b"box2i", window),
        attribute(b"displayWindow", b"box2i", window), attribute(b"lineOrder", b"lineOrder", b"\0"),
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)))) + b"\0"
    line_bytes = 8 + 4 * columns
    table = b"".join(struct.pack("<Q", len(header) + 8 * rows + row * line_bytes) for row in range(rows))
    lines = b"".join(struct.pack("<ii", row, 4 * columns) + struct.pack(f"<{columns}f", *(-20 + 1.7 * row + column for column in range(columns)))
                     for row in range(rows))
    file.write_bytes(header + table + lines)


def random_options(random_):
    """Options of an export, most of them valid together."""
    def some(*values):
        return random_.choice(values)
    maps = random_.sample(["displacement", "gradient", "normal", "foam", "velocity", "jacobian", "slope", "compression"], some(1, 2, 3, 4, 8))
    form, cascades = some("exr", "exr", "exr", "ktx2", "dds"), some("1", "2")
    sea = random_.choice((["--preset", some("calm", "moderate", "storm", "swell"), "--seed", random_.randrange(1000), "--cascades", cascades],
                          ["--preset", "analytic-moderate"], ["--preset", "pond"]))
    options = [*sea, "--resolution", "32", "--maps", ",".join(maps), "--format", form, "--frames", some("1", "2", "3", "5-7")]
    if form == "exr":
        options += ["--compression", some("zip", "zips", "piz", "dwaa", "none"), "--pack", some("files", "files", "layers", "parts")]
        options += some([], [], ["--tiled"], ["--tiled", "--mips"], ["--mips"])
    elif form == "ktx2":
        options += ["--compression", some("none", "zstd"), *some([], ["--mips"])]
    else:
        options += some([], ["--mips"])
    if "normal" in maps or "foam" in maps:
        options += some([], ["--bit-depth", "8"], ["--bit-depth", "16"], ["--bit-depth", "float"])
    for choice in ([], ["--half"]), ([], ["--rows", "bottom"]), ([], ["--fps", "30"]), ([], ["--start", "-12.5"]), \
            ([], [], [], ["--flipbook", "2x2"]), \
            (["--axes", "z-up"], ["--unit", "cm", "--mesh", some("obj", "ply", "mdd", "obj,mdd"), "--mesh-steps", "6"],
             ["--mesh", some("gltf", "gltf-animation", "ply,gltf"), "--mesh-steps", "7"]), \
            ([], ["--wind-direction", "from-NW"]), ([], [], ["--events", "../events.csv"]):
        options += random_.choice(choice)
    return options


def compare_random_options():
    random_, compared, refused = random.Random(54), 0, 0
    while compared < SETS:
        if export_both(f"set{compared}", f"set{compared}", *SPEED, *random_options(random_)):
            compared += 1
        else:
            refused += 1
    print(f"{compared} exports are equal; {refused} sets of options were refused with equal lines")
    # Images of 8 and 16 bits, and those of one file for all frames.
    for command in linux, windows:
        expect(run(command, "export", f"preview of {len(command)}", *SIZE, "--preview")[0] == 0, "no preview")
    expect_equal_folders(*sorted(work.glob("preview of *")), "previews")
    expect(export_both("sequence", "sequence/wave.####.exr", *SIZE, "--cascades", "1", "--maps", "displacement"), "no sequence")


def compare_other_commands():
    expect(export_both("waves", "waves", *SIZE, "--frames", "loop", "--fps", "1", "--loop-period", "16", "--half"), "no waves")
    expect(export_both("packed", "packed", *SIZE, "--frames", "4", "--pack", "parts", "--compression", "piz"), "no packed waves")
    expect(export_both("ktx2", "ktx2", *SIZE, "--frames", "4", "--format", "ktx2", "--compression", "zstd"), "no textures")
    for name in "waves", "packed", "ktx2":
        for command in ["info", "--measure", f"linux/{name}"], ["verify", f"linux/{name}"]:
            results = [run(system, *command) for system in (linux, windows)]
            expect(results[0][0] == 0 and results[0] == results[1], command, *results)
    for floor in "floor8.png", "floor16.png", "floor.exr":
        command = ["query", "--floor", floor, "--floor-size", "300", "--shore", "--points", "points.csv", "--time", "3.5", "--resolution", "32"]
        results = [run(system, *command) for system in (linux, windows)]
        expect(results[0][0] == 0 and results[0] == results[1], command, *results)
    damaged = work / "linux/waves/displacement_0003.exr"
    damaged.write_bytes(damaged.read_bytes()[:-9])
    results = [run(system, "verify", "linux/waves") for system in (linux, windows)]
    expect(results[0][0] == 1 and results[0][0] == results[1][0] and results[0][1] == results[1][1].replace("\\", "/"), "verify of a damaged file", *results)
    refused_by_windows("tif files are not in this build, which lacks OpenImageIO; expected exr, ktx2 or dds", "export", "x", "--format", "tif")
    refused_by_windows("tif files are not in this build, which lacks OpenImageIO; expected exr, ktx2 or dds", "export", "x/wave.####.tif")
    expect(run(linux, "export", "tif", *SIZE, "--format", "tif", "--frames", "2")[0] == 0, "Linux writes no TIFF")
    code, _, error = run(windows, "info", "--measure", "tif")
    expect(code == 1 and error.count("\n") == 1 and "built without OpenImageIO, which writes and reads tif" in error, error)


def kill_and_resume():
    options = [*SIZE, "--frames", "60", "--maps", "displacement,foam"]
    random_, kills = random.Random(1), 0
    expect(run(linux, "export", "whole", *options)[0] == 0, "Linux exports nothing")
    for _ in range(8):
        process = start(windows, "export", "killed", *options, "--resume")
        files = len(list((work / "killed").glob("*.exr")))
        deadline = time.monotonic() + 30
        while process.poll() is None and len(list((work / "killed").glob("*.exr"))) <= files and time.monotonic() < deadline:
            time.sleep(0.005)
        time.sleep(random_.uniform(0, 0.05))
        if process.poll() is None:
            process.kill()
            kills += 1
        process.wait()
    expect(kills >= 4, f"only {kills} of 8 exports were killed")
    accepted_by_windows("export", "killed", *options, "--resume")
    expect_equal_folders(work / "whole", work / "killed", "an export killed and resumed")

    # Ctrl-C, which wine sends for SIGINT
    process = start(windows, "export", "stopped", *options[:-3], "1000000", *options[-2:], "-q")
    while not list((work / "stopped").glob("*.exr")):
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=60)[0].decode()
    expect(process.returncode == 130 and re.fullmatch(r"pelagic: stopped after \d+ of 1000000 frames; the same command with --resume makes the rest\r?\n", said),
           process.returncode, said)
    expect(not list((work / "stopped").glob(".*.part")), "a partial file stays")


def share_a_folder():
    options = [*SPEED, "--frames", "9", "--resolution", "32", "--cascades", "2"]
    expect(run(linux, "export", "whole9", *options)[0] == 0, "Linux exports nothing")
    shards = [start(windows, "export", "shards", *options, "--shard", f"{shard}/3") for shard in (1, 2, 3)]
    for shard in shards:
        said = shard.communicate(timeout=120)[0].decode()
        expect(shard.returncode == 0, said)
    accepted_by_windows("merge", "shards")
    accepted_by_windows("verify", "shards")
    expect_equal_folders(work / "whole9", work / "shards", "three shards at once")

    # The second export of a folder is refused while the first one writes.
    first = start(windows, "export", "shared", *SIZE, "--frames", "100000")
    while not list((work / "shared").glob("*.exr")):
        time.sleep(0.01)
    code, _, error = run(windows, "export", "shared", *SIZE, "--frames", "100000", "--resume")
    first.kill()
    first.wait()
    expect(code == 2 and error.count("\n") == 1 and "another export is at work there and holds .sea.lock" in error, code, error)
    # The lock of a killed process is free. Images that it had not recorded stay.
    accepted_by_windows("export", "shared", *options, "--overwrite")
    for name in set(files_of(work / "shared")) - set(files_of(work / "whole9")):
        expect(int(re.fullmatch(r"\w+_(\d{4,6})\.\w+", name)[1]) >= 9, name)
        (work / "shared" / name).unlink()
    expect_equal_folders(work / "whole9", work / "shared", "an export that replaces another")
    # Two exports at once in folders of their own.
    pair = [start(windows, "export", f"pair{number}", *options) for number in range(2)]
    for number, export in enumerate(pair):
        expect(export.wait(timeout=120) == 0, export.communicate())
        expect_equal_folders(work / "whole9", work / f"pair{number}", "two exports at once")


def export_to_odd_places():
    options = [*SIZE, "--frames", "2"]
    expect(run(linux, "export", "plain", *options)[0] == 0, "Linux exports nothing")
    long_name = "/".join(["a folder with a name of fifty letters and then some"] * 7)
    expect(len(long_name) > 320, "the name is short")
    places = {work / "absolute": "absolute", "Übung 波 🌊": "Übung 波 🌊", "with spaces and 'quotes'": "with spaces and 'quotes'", long_name: long_name}
    if prefix.is_dir():  # of wine
        drive = work / "drive"
        drive.mkdir()
        link = prefix / "dosdevices/d:"
        link.unlink(missing_ok=True)
        link.symlink_to(drive)
        places |= {r"D:\waves": "drive/waves", r"D:\a\b\waves": "drive/a/b/waves", r"D:/c/waves": "drive/c/waves",
                   "D:\\" + long_name.replace("/", "\\"): f"drive/{long_name}"}
    for place, folder in places.items():
        accepted_by_windows("export", place, *options)
        expect_equal_folders(work / "plain", work / folder, place)
        accepted_by_windows("export", place, *options, "--resume")
        accepted_by_windows("verify", place)
        accepted_by_windows("info", "--measure", place)
    for place, folder in (("Übung 波 🌊/wave.####.exr", "Übung 波 🌊"), ("plain\\wave.####.exr", "plain")):
        accepted_by_windows("export", place, *options, "--overwrite", "--cascades", "1", "--maps", "displacement")
        expect((work / folder / "wave.0001.exr").is_file(), place)
    for file in "points.csv", "floor16.png", "floor.exr":
        shutil.copy(work / file, work / f"Übung 波 {file}")
    command = ["query", "--points", "Übung 波 points.csv", "--shore", "--resolution", "32", "--floor"]
    for floor in "Übung 波 floor16.png", "Übung 波 floor.exr":
        results = [run(system, *command, floor) for system in (linux, windows)]
        expect(results[0][0] == 0 and results[0] == results[1], command, floor, *results)
    refused_by_windows("--out is Übung 波.csv/x, expected a folder, but Übung 波.csv is a file", "export", "Übung 波.csv/x", *options)


shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
if not pathlib.Path(linux[0]).is_file():
    print(f"{linux[0]} is not built: the part release builds it")
    sys.exit(77)
for bits in 8, 16:
    write_png(work / f"floor{bits}.png", bits)
write_exr(work / "floor.exr")
(work / "events.csv").write_text("time,x,z,radius,height\n0.1,2,3,1.5,0.4\n0.2,-4,1,2,-0.3\n")
(work / "points.csv").write_text("x,z\n0,0\n12.5,-3\n80,40\n")
(work / "Übung 波.csv").write_text("x,z\n0,0\n")
for step in compare_random_options, compare_other_commands, kill_and_resume, share_a_folder, export_to_odd_places:
    began, busy = time.monotonic(), os.times()
    step()
    now = os.times()
    print(f"{step.__name__}: {time.monotonic() - began:.1f} s, {now.children_user + now.children_system - busy.children_user - busy.children_system:.1f} s of processor time")
