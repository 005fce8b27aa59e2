#!/usr/bin/env python3
"""Compiles the C# package and its tests with mcs, and runs them under mono. Expected values are the
golden hashes and values, the layout of C, and patches of the command.

usage: runtime_test.py C_COMPILER LIBRARY PELAGIC OUTPUT_FOLDER [TEST...]
"""
import json
import os
import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(SOURCE / "tools/bindings"))
sys.dont_write_bytecode = True

import c_layout  # noqa: E402
import header as generator  # noqa: E402

GOLDEN = SOURCE / "tests/golden"


def quadtree_lines(program, folder):
    """Patches of the viewers of QuadtreeTests.cs: triangles, by level, by stitching."""
    file = folder / "quadtree.json"
    for quality in ("low", "high"):
        for number, viewer in enumerate(("0,2,0", "313.7,1.7,-271.3", "-9000.25,180,4500.5")):
            x, y, z = viewer.split(",")
            subprocess.run([program, "quadtree", "--all", "--quality", quality, "--camera", viewer, "--target", f"{float(x) + 9},{y},{z}",
                            "--resolution", "16", "--json", file], check=True, stdout=subprocess.DEVNULL)
            found = json.loads(file.read_text())
            batches = {batch["stitches"]: batch["instances"] for batch in found["batches"]}
            levels, stitches = (level["patches"] for level in found["patches_by_level"]), (batches.get(i, 0) for i in range(16))
            yield f"quadtree {quality} {number} {found['triangles']}:{','.join(map(str, levels))}:{','.join(map(str, stitches))}"


def expected_lines(compiler):
    header = generator.read_pelagic_header()
    yield from (f"layout {name} {number}" for name, number in c_layout.compiled_layout(header, SOURCE / "capi", compiler).items())
    yield from (f"default {name} {number!r}" for name, number in c_layout.compiled_defaults(header, SOURCE / "capi", compiler).items())
    yield from (f"golden {line}" for line in (GOLDEN / "hashes.txt").read_text().splitlines())
    # a name, and numbers with commas
    yield from (" ".join([*words[:2], ",".join(words[2:])]) for words in map(str.split, (GOLDEN / "values.txt").read_text().splitlines()))


def other_libraries(compiler, folder, run):
    """Runs tests of the components without the library, with another version, and with another library."""
    for name, code in (("AMissingPluginIsOneLine", None), ("AnotherVersionIsOneLine", "unsigned pelagic_version(void) { return 20000; }"), ("AnotherLibraryIsOneLine", "int other;")):
        place = folder / name
        place.mkdir(exist_ok=True)
        if code:
            (place / "other.c").write_text(code)
            subprocess.run([compiler, "-shared", "-o", place / "libpelagic_c.so", place / "other.c"], check=True)
        subprocess.run([*run, f"PluginTests.{name}"], env=os.environ | {"LD_LIBRARY_PATH": str(place)}, check=True, timeout=40)


def main():
    compiler, library, program, folder, *tests = sys.argv[1:]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    flags = ["mcs", "-unsafe", "-langversion:7.2", "-warnaserror", "-optimize", "-d:ENABLE_UNITY_COLLECTIONS_CHECKS"]
    runtime, here = SOURCE / "unity/Runtime", pathlib.Path(__file__).parent
    core, engine, component, editor = (folder / f"{name}.dll" for name in ("Pelagic", "Stubs", "Pelagic.Unity", "Pelagic.Unity.Editor"))

    def build(target, sources, *references):
        kind = "-target:library" if target.suffix == ".dll" else "-target:exe"
        others = [f"-r:{reference}" for reference in references]
        subprocess.run([*flags, kind, f"-out:{target}", *others, *sorted(sources)], check=True)

    stubs = here / "Stubs.cs"
    build(core, runtime.glob("*.cs"))
    build(engine, [stubs])
    build(component, (runtime / "Unity").glob("*.cs"), core, engine)
    guide = folder / "Guide.cs"
    guide.write_text("\n".join(re.findall(r"```csharp\n(.*?)```", (SOURCE / "unity/Documentation~/pelagic.md").read_text(), re.S)))
    build(editor, (SOURCE / "unity/Editor").glob("*.cs"), core, engine, component)
    build(folder / "Tests.exe", [*(SOURCE / "unity/Samples~").rglob("*.cs"), guide, *(set(here.glob("*.cs")) - {stubs})], core, engine, component, editor)
    (folder / "expected.txt").write_text("\n".join([*expected_lines(compiler), *quadtree_lines(program, folder)]) + "\n")
    environment = os.environ | {"LD_LIBRARY_PATH": str(pathlib.Path(library).parent)}
    run = ["mono", folder / "Tests.exe", folder / "expected.txt"]
    other_libraries(compiler, folder, run)
    # The end of a frame in flight takes 2 s; 44 s without the guard, when mono gives up its
    # threads.
    for test in ("ReloadTests.AProcessWithAFrameInFlightEnds", "CallbackTests.AProcessWhoseCallbacksRanOnThreadsEnds"):
        subprocess.run([*run, test], env=environment, check=True, timeout=40)
    sys.exit(subprocess.run([*run, *tests], env=environment).returncode)


main()
