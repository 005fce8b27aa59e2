#!/usr/bin/env python3
"""The package for Unity: its files, their metas, and the checks of native libraries.

usage: package_test.py C_COMPILER
"""
import json
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/android"))
import native_libraries  # noqa: E402
from native_libraries import FUNCTIONS  # noqa: E402


class Package(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def pack(self, *options, out="out"):
        return subprocess.run([sys.executable, "-B", SOURCE / "unity/pack.py", "--out", self.folder / out, *options], capture_output=True, text=True)

    def packed(self, *options, out="out"):
        found = self.pack(*options, out=out)
        self.assertEqual(found.returncode, 0, found.stderr)
        return pathlib.Path(found.stdout.splitlines()[-1])

    def library(self, functions=FUNCTIONS, **options):
        return native_libraries.build(COMPILER, self.folder / "library.so", functions, **options)

    def android_library(self, **options):
        return native_libraries.for_android(COMPILER, self.folder / "library.so", **options)

    def files(self, archive):
        with tarfile.open(archive) as tar:
            return {entry.name.removeprefix("package/"): tar.extractfile(entry).read() for entry in tar}

    def test_has_the_files_of_a_unity_package(self):
        names = self.files(self.packed())
        for name in ("package.json", "README.md", "LICENSE.md", "Third Party Notices.md", "Runtime/Pelagic.asmdef", "Runtime/Native.g.cs", "Runtime/Unity/Pelagic.Unity.asmdef",
                     "Samples~/FrameLoop/FrameLoop.cs", "Documentation~/pelagic.md"):
            self.assertIn(name, names)
        manifest = json.loads(names["package.json"])
        defined = dict(re.findall(r"#define PELAGIC_VERSION_(\w+) (\d+)", (SOURCE / "capi/pelagic.h").read_text()))
        project = f"{defined['MAJOR']}.{defined['MINOR']}.{defined['PATCH']}"
        self.assertEqual((manifest["name"], manifest["version"], manifest["unity"]), ("com.pelagic.ocean", project, "2022.3"))
        for sample in manifest["samples"]:
            self.assertTrue(any(name.startswith(sample["path"] + "/") for name in names))
        assembly = json.loads(names["Runtime/Pelagic.asmdef"])
        self.assertTrue(assembly["noEngineReferences"] and assembly["allowUnsafeCode"])

    def test_each_asset_has_a_meta_with_a_guid_of_its_own(self):
        names = self.files(self.packed("--linux", self.library()))
        metas = {name for name in names if name.endswith(".meta")}
        assets = set(names) - metas
        folders = {parent.as_posix() for name in assets for parent in pathlib.PurePosixPath(name).parents} - {"."}
        visible = {name for name in assets | folders if not name.startswith("Documentation~") and name != "Samples~"}
        self.assertEqual(metas, {f"{name}.meta" for name in visible})
        guids = [re.search(rb"^guid: ([0-9a-f]{32})$", names[name], re.M)[1] for name in metas]
        self.assertEqual(len(set(guids)), len(guids))
        # Must never change: scenes of applications refer to it.
        self.assertIn(b"guid: 3cc9817c06aae85ece0d2b063ff7482e\n", names["Runtime/Ocean.cs.meta"])
        self.assertIn(b"CPU: x86_64", names["Plugins/Linux/libpelagic_c.so.meta"])

    def test_equal_files_give_equal_bytes(self):
        self.assertEqual(self.packed(out="first").read_bytes(), self.packed(out="second").read_bytes())

    def test_a_library_that_is_not_given_is_left_out_with_a_line(self):
        found = self.pack("--android", self.android_library(machine=183))
        self.assertEqual(found.stdout.splitlines()[:-1], ["without linux: no --linux", "without windows: no --windows", "without android_x86_64: no --android-x86-64"])
        plugins = [name for name in self.files(found.stdout.splitlines()[-1]) if name.startswith("Plugins/") and "." in name]
        folder = "Plugins/Android/arm64-v8a"
        self.assertEqual(sorted(plugins), ["Plugins/Android.meta", f"{folder}.meta", f"{folder}/libpelagic_c.so", f"{folder}/libpelagic_c.so.meta"])

    def test_android_has_a_library_for_each_processor(self):
        arm64 = self.android_library(machine=183).rename(self.folder / "arm64.so")
        names = self.files(self.packed("--android", arm64, "--android-x86-64", self.android_library()))
        for folder, cpu in (("arm64-v8a", b"CPU: ARM64"), ("x86_64", b"CPU: X86_64")):
            self.assertIn(cpu + b"\n", names[f"Plugins/Android/{folder}/libpelagic_c.so.meta"])
        self.assertEqual(names["Plugins/Android/arm64-v8a/libpelagic_c.so"], arm64.read_bytes())

    def test_a_library_that_unity_cannot_load_is_rejected(self):
        text = self.folder / "text.so"
        text.write_text("not a library")
        rejected = [
            (("--android", lambda: self.android_library()), "is for x86-64, expected arm64"),
            (("--android", lambda: self.android_library(machine=183, page_bytes=4096)), "aligns LOAD segment 0 to 4096 bytes, expected 16384"),
            (("--android-x86-64", lambda: self.android_library(needed="libc++_shared.so")), "needs libc++_shared.so, which the system does not provide"),
            (("--linux", lambda: self.library(FUNCTIONS[1:])), f"does not export {FUNCTIONS[0]}: it is not this version of Pelagic"),
            (("--linux", lambda: self.library(needed="libtbb.so.12")), "needs libtbb.so.12, which the system does not provide"),
            (("--linux", lambda: text), "not a 64-bit ELF file"),
            (("--windows", lambda: self.library()), "not a DLL"),
        ]
        for (option, library), message in rejected:
            found = self.pack(option, library())
            self.assertEqual(found.returncode, 1)
            self.assertIn(message, found.stderr)
            self.assertEqual(len(found.stderr.splitlines()), 1)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    COMPILER = sys.argv.pop()
    unittest.main()
