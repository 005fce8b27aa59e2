#!/usr/bin/env python3
"""Reads packages of dist/: .deb, .tar.gz, .tgz, .zip, .aar and .whl.

usage: artefact.py check LIST VERSION SOVERSION FORBIDDEN ARTEFACT
       artefact.py glibc NEWEST ARTEFACT...
       artefact.py zip OUT FOLDER NAME...

check   compares the names of files with LIST: a pattern of fnmatch in each line, in which @VERSION@
        and @SOVERSION@ are replaced. A line FOLDER/@OTHER.txt has the lines of that list below the
        folder. Each file matches a line, and each line a file. No file contains FORBIDDEN, the path of the build. No path is absolute, and files of Debian's
        packages belong to root.
glibc   prints the newest version of the C and C++ libraries that the programs and libraries of
        each artefact need. Fails if the C library's is newer than NEWEST.
zip     writes files and folders of FOLDER into a zip, sorted, with the time SOURCE_DATE_EPOCH.
"""
import fnmatch
import io
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile


def contents(artefact):
    """Files and links of an artefact by name, with their bytes."""
    path = pathlib.Path(artefact)
    if path.suffix in (".zip", ".whl", ".aar"):
        with zipfile.ZipFile(path) as archive:
            return {entry.filename: archive.read(entry) for entry in archive.infolist() if not entry.is_dir()}
    data = path.read_bytes()
    if path.suffix == ".deb":
        data = subprocess.run(["dpkg-deb", "--fsys-tarfile", path], capture_output=True, check=True).stdout
    files = {}
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        for entry in archive:
            if entry.name.startswith("/") or ".." in entry.name.split("/"):
                sys.exit(f"{path.name}: the path {entry.name} is absolute")
            if path.suffix == ".deb" and (entry.uid, entry.gid) != (0, 0):
                sys.exit(f"{path.name}: {entry.name} belongs to {entry.uid}:{entry.gid}, expected 0:0")
            if not entry.isdir():
                files[entry.name.removeprefix("./")] = archive.extractfile(entry).read() if entry.isfile() else b""
    return files


def lines_of(listed):
    """Lines of a list, and of the lists that it includes."""
    for line in pathlib.Path(listed).read_text().split("\n"):
        folder, includes, other = line.partition("/@")
        if includes and other.endswith(".txt"):
            yield from (f"{folder}/{name}" for name in lines_of(pathlib.Path(listed).with_name(other)))
        elif line and not line.startswith("#"):
            yield line


def check(listed, version, soversion, forbidden, artefact):
    lines = [line.replace("@VERSION@", version).replace("@SOVERSION@", soversion) for line in lines_of(listed)]
    files = contents(artefact)
    unlisted = [name for name in files if not any(fnmatch.fnmatchcase(name, line) for line in lines)]
    missing = [line for line in lines if not fnmatch.filter(files, line)]
    leaking = [name for name, data in files.items() if forbidden.encode() in data]
    for text, names in (("is not in the list", unlisted), ("is missing", missing), (f"contains {forbidden}", leaking)):
        for name in names:
            print(f"{pathlib.Path(artefact).name}: {name} {text}")
    return not (unlisted or missing or leaking)


def needed_versions(data):
    """Versions of symbols that an ELF file needs, as (library, version)."""
    with tempfile.NamedTemporaryFile() as file:
        file.write(data)
        file.flush()
        text = subprocess.run(["readelf", "--version-info", "--wide", file.name], capture_output=True, text=True, check=True).stdout
    needs = text.partition("Version needs section")[2]
    for library, version in re.findall(r"Name: (GLIBC|GLIBCXX)_([\d.]+)", needs):
        yield library, tuple(map(int, version.split(".")))


def glibc(newest, *artefacts):
    within = True
    for artefact in artefacts:
        found = {}
        for data in contents(artefact).values():
            if data.startswith(b"\x7fELF"):
                for library, version in needed_versions(data):
                    found[library] = max(found.get(library, version), version)
        texts = [f"{library} {'.'.join(map(str, version))}" for library, version in sorted(found.items())]
        print(f"{pathlib.Path(artefact).name}: {', '.join(texts) or 'no programs'}")
        if found.get("GLIBC", (0,)) > tuple(map(int, newest.split("."))):
            print(f"{pathlib.Path(artefact).name}: needs a newer glibc than {newest}, which docs/packages.md states")
            within = False
    return within


def write_zip(out, folder, *names):
    folder = pathlib.Path(folder)
    files = [file for name in names for file in ([folder / name] if (folder / name).is_file() else (folder / name).rglob("*")) if file.is_file()]
    when = time.gmtime(int(os.environ["SOURCE_DATE_EPOCH"]))[:6]
    with zipfile.ZipFile(out, "w") as archive:
        for file in sorted(files):
            entry = zipfile.ZipInfo(file.relative_to(folder).as_posix(), when)
            entry.external_attr, entry.compress_type = 0o100644 << 16, zipfile.ZIP_DEFLATED
            archive.writestr(entry, file.read_bytes())
    return True


if __name__ == "__main__":
    sys.exit(0 if {"check": check, "glibc": glibc, "zip": write_zip}[sys.argv[1]](*sys.argv[2:]) else 1)
