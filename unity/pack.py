#!/usr/bin/env python3
"""Packs the package for Unity: com.pelagic.ocean-VERSION.tgz, which the package manager installs.

usage: pack.py --out FOLDER [--linux FILE] [--windows FILE] [--android FILE] [--android-x86-64 FILE]

--linux           libpelagic_c.so for x86-64, built with -DPELAGIC_TBB=OFF
--windows         pelagic.dll for x86-64, built with -DPELAGIC_TBB=OFF
--android         libpelagic_c.so for arm64, built with the NDK (docs/integrations/vr.md)
--android-x86-64  the same for x86-64

A library that is not given is left out. Equal files give equal bytes.
"""
import argparse
import gzip
import hashlib
import io
import pathlib
import re
import sys
import tarfile

import native_library

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent
NAME = "com.pelagic.ocean"
# What systems provide. An application would have to bring anything else, for instance oneTBB.
LINUX_LIBRARIES = {"libc.so.6", "libm.so.6", "libstdc++.so.6", "libgcc_s.so.1", "ld-linux-x86-64.so.2", "libpthread.so.0"}
ANDROID_LIBRARIES = {"libc.so", "libm.so", "libdl.so", "liblog.so"}
ANDROID = {"page_bytes": 16384, "api_level": 29}  # pages that Google Play requires; docs/integrations/vr.md has the level
# Of Unity, by the name that C# loads on each system.
PLUGINS = {"linux": ("Plugins/Linux/libpelagic_c.so", "x86-64", LINUX_LIBRARIES),
           "windows": ("Plugins/Windows/pelagic_c.dll", "x86-64", native_library.WINDOWS_LIBRARIES),
           "android": ("Plugins/Android/arm64-v8a/libpelagic_c.so", "arm64", ANDROID_LIBRARIES),
           "android_x86_64": ("Plugins/Android/x86_64/libpelagic_c.so", "x86-64", ANDROID_LIBRARIES)}
PLATFORMS = {"linux": (("Editor: Editor", "CPU: x86_64", "OS: Linux"), ("Standalone: Linux64", "CPU: x86_64")),
             "windows": (("Editor: Editor", "CPU: x86_64", "OS: Windows"), ("Standalone: Win64", "CPU: x86_64")),
             "android": (("Android: Android", "CPU: ARM64"),),
             "android_x86_64": (("Android: Android", "CPU: X86_64"),)}
IMPORTERS = {".cs": "MonoImporter", ".asmdef": "AssemblyDefinitionImporter", ".json": "PackageManifestImporter", ".md": "TextScriptImporter",
             ".hlsl": "ShaderIncludeImporter", ".shader": "ShaderImporter", ".unity": "DefaultImporter", ".mat": "NativeFormatImporter",
             ".prefab": "PrefabImporter"}


def functions_of_the_header():
    return set((SOURCE / "tests/abi/pelagic.symbols").read_text().split())


def checked_library(system, file):
    """The bytes of a library. Exits if Unity could not load it, or it is not Pelagic's."""
    _, machine, libraries = PLUGINS[system]
    data = pathlib.Path(file).read_bytes()
    try:
        library = (native_library.read_pe if system == "windows" else native_library.read_elf)(data)
    except (native_library.Unreadable, ValueError, IndexError, native_library.struct.error) as error:
        sys.exit(f"pack.py: {file}: {error}")
    for problem in native_library.problems(library, machine, libraries, functions_of_the_header(), **(ANDROID if "android" in system else {})):
        sys.exit(f"pack.py: {file} {problem}")
    return data


def guid_of(path):
    """Stable for a path, so that references of projects survive an update."""
    return hashlib.md5(f"{NAME}/{path}".encode()).hexdigest()


def plugin_meta(system):
    lines = ["PluginImporter:", "  externalObjects: {}", "  serializedVersion: 2", "  iconMap: {}", "  executionOrder: {}",
             "  defineConstraints: []", "  isPreloaded: 0", "  isOverridable: 0", "  isExplicitlyReferenced: 0",
             "  validateReferences: 1", "  platformData:", "  - first:", "      Any: ", "    second:", "      enabled: 0", "      settings: {}"]
    for platform, *settings in PLATFORMS[system]:
        lines += ["  - first:", f"      {platform}", "    second:", "      enabled: 1", "      settings:", *(f"        {line}" for line in settings)]
    return lines


def meta(path, is_folder, system=None):
    lines = ["fileFormatVersion: 2", f"guid: {guid_of(path)}"]
    if is_folder:
        lines += ["folderAsset: yes", "DefaultImporter:", "  externalObjects: {}"]
    elif system:
        lines += plugin_meta(system)
    else:
        lines += [f"{IMPORTERS[pathlib.PurePosixPath(path).suffix]}:", "  externalObjects: {}"]
        if path.endswith(".cs"):
            lines += ["  serializedVersion: 2", "  defaultReferences: []", "  executionOrder: 0", "  icon: {instanceID: 0}"]
        if path.endswith(".mat"):
            lines.append("  mainObjectFileID: 2100000")
    return "\n".join(lines + ["  userData: ", "  assetBundleName: ", "  assetBundleVariant: ", ""]).encode()


def without_links(page):
    """A page for users, without links into the source tree."""
    text = (SOURCE / page).read_text()
    return re.sub(r"\[([^\]]+)\]\((?![a-z]+:)[^)]+\)", r"\1", text)


def version():
    text = (SOURCE / "capi/pelagic.h").read_text()
    return ".".join(re.search(rf"PELAGIC_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def contents(libraries):
    files = {"package.json": (HERE / "package.json.in").read_text().replace("@PROJECT_VERSION@", version()).encode(),
             "README.md": (HERE / "README.md").read_bytes(),
             "LICENSE.md": (SOURCE / "LICENSE").read_bytes(),
             "Third Party Notices.md": (SOURCE / "NOTICE").read_bytes(),
             "Documentation~/pelagic.md": without_links("unity/Documentation~/pelagic.md").encode(),
             "Documentation~/engines.md": without_links("docs/integrations/unity.md").encode()}
    for folder in ("Runtime", "Editor", "Samples~"):
        for file in sorted((HERE / folder).rglob("*")):
            if file.is_file():
                files[file.relative_to(HERE).as_posix()] = file.read_bytes()
    systems = {}
    for system, file in libraries.items():
        if file:
            files[PLUGINS[system][0]] = checked_library(system, file)
            systems[PLUGINS[system][0]] = system
        else:
            print(f"without {system}: no --{system.replace('_', '-')}")
    return files, systems


def is_ignored_by_unity(path):
    """Folders whose names end with ~ are no assets. Samples are copied with their metas."""
    first = pathlib.PurePosixPath(path).parts
    return first[0] == "Documentation~" or path == "Samples~"


def with_metas(files, systems):
    folders = {parent.as_posix() for path in files for parent in pathlib.PurePosixPath(path).parents if parent.as_posix() != "."}
    everything = dict(files)
    for path in [*files, *folders]:
        if not is_ignored_by_unity(path):
            everything[path + ".meta"] = meta(path, path in folders, systems.get(path))
    return everything


def archive(files):
    packed = io.BytesIO()
    with gzip.GzipFile(fileobj=packed, mode="wb", filename="", mtime=0) as zipped, tarfile.open(fileobj=zipped, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for path in sorted(files):
            entry = tarfile.TarInfo(f"package/{path}")
            entry.size, entry.mode = len(files[path]), 0o644
            tar.addfile(entry, io.BytesIO(files[path]))
    return packed.getvalue()


def main():
    parser = argparse.ArgumentParser(usage=__doc__, add_help=False)
    parser.add_argument("--out", required=True)
    for system in PLUGINS:
        parser.add_argument(f"--{system.replace('_', '-')}")
    options = vars(parser.parse_args())
    file = pathlib.Path(options.pop("out"), f"{NAME}-{version()}.tgz")
    data = archive(with_metas(*contents(options)))
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(data)
    print(file)


if __name__ == "__main__":
    main()
