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
FUNCTIONS = (SOURCE / "tests/abi/pelagic.symbols").read_text().split()


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

    def library(self, functions=FUNCTIONS, machine=None, needed=""):
        """A shared library that exports the functions and needs nothing, or one other library."""
        file, source = self.folder / "library.so", self.folder / "library.c"
        source.write_text("".join(f"void {name}(void) {{}}\n" for name in functions))
        other = []
        if needed:
            other = [self.folder / needed]
            subprocess.run([COMPILER, "-shared", "-fPIC", "-nostdlib", f"-Wl,-soname,{needed}", "-xc", "/dev/null", "-o", *other], check=True)
        subprocess.run([COMPILER, "-shared", "-fPIC", "-nostdlib", "-Wl,--no-as-needed", source, *other, "-o", file], check=True)
        if machine:
            data = bytearray(file.read_bytes())
            data[18:20] = machine.to_bytes(2, "little")
            file.write_bytes(data)
        return file

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
        found = self.pack("--android", self.library(machine=183))
        self.assertEqual(found.stdout.splitlines()[:-1], ["without linux: no --linux", "without windows: no --windows"])
        plugins = [name for name in self.files(found.stdout.splitlines()[-1]) if name.startswith("Plugins/") and "." in name]
        self.assertEqual(sorted(plugins), ["Plugins/Android.meta", "Plugins/Android/libpelagic_c.so", "Plugins/Android/libpelagic_c.so.meta"])

    def test_a_library_that_unity_cannot_load_is_rejected(self):
        text = self.folder / "text.so"
        text.write_text("not a library")
        rejected = [
            (("--android", lambda: self.library()), "is for x86-64, expected arm64"),
            (("--linux", lambda: self.library(FUNCTIONS[1:])), f"does not export {FUNCTIONS[0]}: it is not this version of Pelagic"),
            (("--linux", lambda: self.library(needed="libtbb.so.12")), "needs libtbb.so.12, which linux does not provide"),
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
