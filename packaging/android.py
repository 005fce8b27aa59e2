#!/usr/bin/env python3
"""Packs the C library for Android: an AAR with a prefab package, for applications with native code, and a
zip with the folders of a project, for others.

usage: android.py OUT_FOLDER NDK_MAJOR_VERSION ABI=LIBRARY...

The format is schema 2 of https://google.github.io/prefab. Its "stl" is none, because no function or class
of the C++ library, which is part of the library, is visible to applications. The AAR has no jni folder:
the Android Gradle Plugin would find each library twice.
"""
import json
import pathlib
import sys
import tempfile

import artefact

SOURCE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(SOURCE / "unity"))
import pack  # noqa: E402

MODULE = "prefab/modules/pelagic_c"
LICENCES = {"LICENSE": SOURCE / "LICENSE", "NOTICE": SOURCE / "NOTICE"}
MANIFEST = """<?xml version="1.0" encoding="utf-8"?>
<manifest xmlns:android="http://schemas.android.com/apk/res/android" package="com.pelagic.ocean">
    <uses-sdk android:minSdkVersion="{level}" />
</manifest>
"""


def as_json(value):
    return (json.dumps(value, indent=2) + "\n").encode()


def aar_files(ndk, libraries):
    level = pack.ANDROID["api_level"]
    files = {"AndroidManifest.xml": MANIFEST.format(level=level).encode(),
             "prefab/prefab.json": as_json({"schema_version": 2, "name": "pelagic", "version": pack.version(), "dependencies": []}),
             f"{MODULE}/module.json": as_json({"export_libraries": [], "library_name": "libpelagic_c"}),
             f"{MODULE}/include/pelagic/pelagic.h": (SOURCE / "capi/pelagic.h").read_bytes()}
    for name, file in LICENCES.items():
        files[f"META-INF/{name}"] = file.read_bytes()
    for abi, library in libraries.items():
        folder = f"{MODULE}/libs/android.{abi}"
        files[f"{folder}/abi.json"] = as_json({"abi": abi, "api": level, "ndk": ndk, "stl": "none", "static": False})
        files[f"{folder}/libpelagic_c.so"] = library
    return files


def zip_files(libraries):
    files = {name: file.read_bytes() for name, file in LICENCES.items()}
    files["include/pelagic/pelagic.h"] = (SOURCE / "capi/pelagic.h").read_bytes()
    for abi, library in libraries.items():
        files[f"jniLibs/{abi}/libpelagic_c.so"] = library
    return files


def write(out, files):
    with tempfile.TemporaryDirectory() as folder:
        for name, data in files.items():
            file = pathlib.Path(folder, name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)
        artefact.write_zip(out, folder, *sorted({name.split("/")[0] for name in files}))


def main():
    out, ndk = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    libraries = {abi: pathlib.Path(file).read_bytes() for abi, file in (word.split("=", 1) for word in sys.argv[3:])}
    stem = f"pelagic-{pack.version()}-android"
    write(out / f"{stem}.aar", aar_files(ndk, libraries))
    write(out / f"{stem}.zip", zip_files(libraries))


if __name__ == "__main__":
    main()
