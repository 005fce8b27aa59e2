#!/usr/bin/env python3
"""Checks each shared library and program in packages: processor, alignment of segments to the pages of
systems, libraries that it needs, exported functions. Prints a line for each.

usage: libraries.py ARTEFACT...

Fails if a library is in no rule.
"""
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(SOURCE / "unity"))
import artefact  # noqa: E402
import native_library  # noqa: E402
import pack  # noqa: E402

CXX = {"libc.so.6", "libm.so.6", "libstdc++.so.6", "libgcc_s.so.1", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
# docs/packages.md has the libraries that the command needs. Debian's packages depend on further ones.
COMMAND, TBB = CXX | {"libglfw.so.3", "libzstd.so.1"}, {"libtbb.so.12"}
EXR, IMAGES = CXX | {"libOpenEXR-3_1.so.30"}, CXX | {"libOpenImageIO.so.2.4", "libOpenImageIO_Util.so.2.4"}
WINDOWS = native_library.WINDOWS_LIBRARIES
ANDROID = r"com\.pelagic\.ocean-.*\.tgz|pelagic-.*-android\.(aar|zip)"
ARM_PAGE = 65536  # of some kernels
C, GODOT, GODOT_4, NOTHING = "pelagic.symbols", "godot3.symbols", "godot4.symbols", None
# Patterns of artefacts and of files in them: processor, libraries of the system, list of exports, other options of
# problems().
RULES = [
    (r"libpelagic.*\.deb", r".*/libpelagic_c\.so\.[\d.]+", "x86-64", CXX | TBB, C, {}),
    (r"pelagic_.*\.deb", r"usr/bin/pelagic", "x86-64", COMMAND | TBB | {"libstb.so.0"}, NOTHING, {}),
    (r"pelagic_.*\.deb|.*-linux-x86_64\.tar\.gz", r".*/pelagic_exr\.so", "x86-64", EXR, NOTHING, {}),
    (r"pelagic_.*\.deb|.*-linux-x86_64\.tar\.gz", r".*/pelagic_images\.so", "x86-64", IMAGES, NOTHING, {}),
    (r".*-linux-x86_64\.tar\.gz", r".*/libpelagic_c\.so\.[\d.]+", "x86-64", CXX, C, {}),
    (r".*-linux-x86_64\.tar\.gz", r".*/bin/pelagic", "x86-64", COMMAND, NOTHING, {}),
    (r".*-linux-arm64\.tar\.gz", r".*/libpelagic_c\.so\.[\d.]+", "arm64", CXX, C, {"page_bytes": ARM_PAGE}),
    (r".*-linux-arm64\.tar\.gz", r".*/bin/pelagic", "arm64", CXX, NOTHING, {"page_bytes": ARM_PAGE}),
    (r".*_aarch64\.whl", r"pelagic/libpelagic_c\.so", "arm64", CXX, C, {"page_bytes": ARM_PAGE}),
    (r".*_x86_64\.whl", r"pelagic/libpelagic_c\.so", "x86-64", CXX, C, {}),
    (r"pelagic_blender-.*\.zip", r"pelagic_ocean/python/pelagic/libpelagic_c\.so", "x86-64", CXX, C, {}),
    (r"pelagic-godot3-.*\.zip", r"addons/pelagic/libpelagic_godot3\.so", "x86-64", CXX, GODOT, {}),
    (r"pelagic-godot4-.*\.zip", r"addons/pelagic/libpelagic_godot4\.so", "x86-64", CXX, GODOT_4, {}),
    (r".*-windows-x86_64\.zip", r".*/bin/pelagic\.dll", "x86-64", WINDOWS, C, {}),
    (r".*-windows-x86_64\.zip", r".*/bin/pelagic\.exe", "x86-64", WINDOWS, NOTHING, {}),
    (r"com\.pelagic\.ocean-.*\.tgz", r"package/Plugins/Linux/libpelagic_c\.so", "x86-64", CXX, C, {}),
    (r"com\.pelagic\.ocean-.*\.tgz", r"package/Plugins/Windows/pelagic_c\.dll", "x86-64", WINDOWS, C, {}),
    (ANDROID, r".*(/|\.)arm64-v8a/libpelagic_c\.so", "arm64", pack.ANDROID_LIBRARIES, C, pack.ANDROID),
    (ANDROID, r".*(/|\.)x86_64/libpelagic_c\.so", "x86-64", pack.ANDROID_LIBRARIES, C, pack.ANDROID),
]


def problems(package, name, data):
    """Prints a line about a library, and yields why an application could not load it."""
    rule = next((rule for rule in RULES if re.fullmatch(rule[0], package) and re.fullmatch(rule[1], name)), None)
    if rule is None:
        yield "is in no rule of libraries.py"
        return
    machine, libraries, listed, options = rule[2:]
    library = (native_library.read_elf if data.startswith(b"\x7fELF") else native_library.read_pe)(data)
    functions = (SOURCE / "tests/abi" / listed).read_text().split() if listed else ()
    loads = library.loads()
    parts = [library.machine, f"{len(data) / 1e6:.1f} MB"]
    if loads:
        parts.append(f"{len(loads)} LOAD segments at multiples of {min(load.alignment for load in loads)}")
    if library.api_level:
        parts.append(f"API level {library.api_level}")
    parts += [f"{len(library.exports)} exports", f"needs {' '.join(library.needed)}"]
    print(f"{package}: {name}: {', '.join(parts)}")
    yield from native_library.problems(library, machine, libraries, functions, exactly=listed is not None, **options)


def main(artefacts):
    failed = False
    for path in map(pathlib.Path, artefacts):
        for name, data in artefact.contents(path).items():
            if data.startswith((b"\x7fELF", b"MZ")):
                for problem in problems(path.name, name, data):
                    print(f"{path.name}: {name} {problem}")
                    failed = True
    sys.exit(failed)


if __name__ == "__main__":
    main(sys.argv[1:])
