#!/usr/bin/env python3
"""The packages for Android, and the checks of their libraries, with small libraries that no NDK built.
stand_in_test.sh builds Pelagic.

usage: packages_test.py C_COMPILER
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

import native_libraries
from native_libraries import FUNCTIONS, SOURCE

ARM64 = 183


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def library(self, name="libpelagic_c.so", **options):
        return native_libraries.for_android(COMPILER, self.folder / name, **options)


class Packages(Folder):
    def pack(self, out, arm64, x86_64):
        (self.folder / out).mkdir()
        subprocess.run([sys.executable, "-B", SOURCE / "packaging/android.py", self.folder / out, "27", f"arm64-v8a={arm64}", f"x86_64={x86_64}"],
                       check=True, env={"SOURCE_DATE_EPOCH": "1700000000"})
        return {file.suffix: file for file in (self.folder / out).iterdir()}

    def packed(self, out="out", **options):
        return self.pack(out, self.library("arm64.so", machine=ARM64, **options), self.library("x86_64.so"))

    def checked(self, artefact):
        return subprocess.run([sys.executable, "-B", SOURCE / "packaging/libraries.py", artefact], capture_output=True, text=True)

    def test_the_aar_has_a_prefab_package_with_header_and_libraries(self):
        with zipfile.ZipFile(self.packed()[".aar"]) as aar:
            files = {name: aar.read(name) for name in aar.namelist()}
        # Names and fields of schema 2, https://google.github.io/prefab.
        module = "prefab/modules/pelagic_c"
        self.assertEqual(sorted(files), sorted([
            "AndroidManifest.xml", "META-INF/LICENSE", "META-INF/NOTICE", "prefab/prefab.json", f"{module}/module.json", f"{module}/include/pelagic/pelagic.h",
            *(f"{module}/libs/android.{abi}/{file}" for abi in ("arm64-v8a", "x86_64") for file in ("abi.json", "libpelagic_c.so"))]))
        package = json.loads(files["prefab/prefab.json"])
        self.assertEqual((package["schema_version"], package["name"], package["dependencies"]), (2, "pelagic", []))
        self.assertRegex(package["version"], r"^\d+\.\d+\.\d+$")
        self.assertEqual(json.loads(files[f"{module}/module.json"]), {"export_libraries": [], "library_name": "libpelagic_c"})
        for abi, name in (("arm64-v8a", "arm64.so"), ("x86_64", "x86_64.so")):
            self.assertEqual(json.loads(files[f"{module}/libs/android.{abi}/abi.json"]), {"abi": abi, "api": 29, "ndk": 27, "stl": "none", "static": False})
            self.assertEqual(files[f"{module}/libs/android.{abi}/libpelagic_c.so"], (self.folder / name).read_bytes())
        self.assertEqual(files[f"{module}/include/pelagic/pelagic.h"], (SOURCE / "capi/pelagic.h").read_bytes())
        self.assertIn(b'android:minSdkVersion="29"', files["AndroidManifest.xml"])

    def test_equal_libraries_give_equal_bytes(self):
        first, second = self.packed("first"), self.packed("second")
        for suffix in (".aar", ".zip"):
            self.assertEqual(first[suffix].read_bytes(), second[suffix].read_bytes())

    def test_both_archives_pass_the_checks_and_match_their_lists(self):
        version = subprocess.run([SOURCE / "packaging/version.sh"], capture_output=True, text=True, check=True).stdout.strip()
        for suffix, file in self.packed().items():
            found = self.checked(file)
            self.assertEqual(found.returncode, 0, found.stdout + found.stderr)
            self.assertEqual(found.stdout.count(f"LOAD segments at multiples of 16384, API level 29, {len(FUNCTIONS)} exports"), 2)
            listed = SOURCE / f"packaging/files/android_{suffix[1:]}.txt"
            subprocess.run([sys.executable, "-B", SOURCE / "packaging/artefact.py", "check", listed, version, "1", str(self.folder), file], check=True)

    def test_an_archive_with_pages_of_4_kb_is_rejected(self):
        for file in self.packed(page_bytes=4096).values():
            found = self.checked(file)
            self.assertEqual(found.returncode, 1)
            self.assertRegex(found.stdout, r"arm64-v8a/libpelagic_c\.so aligns LOAD segment 0 to 4096 bytes, expected 16384\n")

    def test_a_library_that_no_rule_names_is_rejected(self):
        with zipfile.ZipFile(self.folder / "pelagic-1.0.0-android.zip", "w") as other:
            other.write(self.library(), "jniLibs/x86/libother.so")
        self.assertIn("jniLibs/x86/libother.so is in no rule", self.checked(self.folder / "pelagic-1.0.0-android.zip").stdout)


class Libraries(Folder):
    """Each fault of a library for Android, in one that is otherwise accepted."""

    def problems(self, file):
        return list(native_library.problems(native_library.read_elf(file.read_bytes()), "x86-64", pack.ANDROID_LIBRARIES, FUNCTIONS, exactly=True, **pack.ANDROID))

    def patched(self, change, **options):
        """A library with changed program headers: `change` gets the fields of one (Elf64_Phdr), and changes them."""
        file = self.library(**options)
        data = bytearray(file.read_bytes())
        begin, size, count = (struct.unpack_from("<Q", data, 32)[0], *struct.unpack_from("<HH", data, 54))
        for at in range(begin, begin + size * count, size):
            fields = list(struct.unpack_from("<IIQQQQQQ", data, at))
            change(fields)
            struct.pack_into("<IIQQQQQQ", data, at, *fields)
        file.write_bytes(data)
        return file

    def test_a_library_for_android_has_none(self):
        self.assertEqual(self.problems(self.library()), [])
        self.assertEqual(self.problems(self.library(needed="libdl.so")), [])

    def test_alignment_of_4_kb(self):
        found = self.problems(self.library(page_bytes=4096))
        self.assertEqual(found[0], "aligns LOAD segment 0 to 4096 bytes, expected 16384")
        self.assertGreater(len([text for text in found if "LOAD" in text]), 2)

    def test_alignment_of_4_kb_under_headers_that_state_16_kb(self):
        def state(fields):
            if fields[0] == native_library.LOAD:
                fields[7] = 16384

        self.assertIn("has LOAD segments 0 and 1 in one page of 16384 bytes", self.problems(self.patched(state, page_bytes=4096)))

    def test_other_bytes_of_a_page_in_file_and_memory(self):
        def move(fields):
            if fields[0] == native_library.LOAD and fields[3]:
                fields[3] += 4096

        self.assertIn("has LOAD segment 1 at other bytes of a page in the file and in memory", self.problems(self.patched(move)))

    def test_writable_data_behind_protected_data(self):
        def shorten(fields):
            if fields[0] == native_library.GNU_RELRO:
                fields[6] -= 8

        self.assertEqual(self.problems(self.patched(shorten)), ["has writable data in the last page of 16384 bytes of its RELRO segment"])

    def test_api_levels(self):
        self.assertEqual(self.problems(self.library(api_level=21)), [])
        self.assertEqual(self.problems(self.library(api_level=30)), ["was built for API level 30, expected at most 29"])
        self.assertEqual(self.problems(self.library(api_level=None)), ["was built for API level none, expected at most 29"])

    def test_needed_libraries_and_functions(self):
        self.assertEqual(self.problems(self.library(needed="libc++_shared.so")), ["needs libc++_shared.so, which the system does not provide"])
        self.assertEqual(self.problems(self.library(functions=FUNCTIONS[1:])), [f"does not export {FUNCTIONS[0]}: it is not this version of Pelagic"])
        self.assertEqual(self.problems(self.library(functions=[*FUNCTIONS, "other"])), ["exports other, which is not in the interface"])
        code = "void _ZSt9terminatev(void);\nvoid pelagic_x(void) { _ZSt9terminatev(); }\n"
        self.assertIn("imports _ZSt9terminatev, though its C++ library should be part of it", self.problems(self.library(code=code)))

    def test_stacks_code_and_search_paths(self):
        self.assertEqual(self.problems(self.library(options=["-Wl,-z,execstack"])), ["has an executable stack"])
        self.assertEqual(self.problems(self.library(options=["-Wl,-rpath,/lib"])), ["has a search path for libraries"])


class Arguments(Folder):
    """release.sh refuses a wrong NDK with one line, before it installs or builds anything."""

    def refused(self, *words):
        found = subprocess.run([SOURCE / "release.sh", *words], capture_output=True, text=True)
        self.assertEqual((found.returncode, found.stdout, found.stderr.count("\n")), (2, "", 1), found.stderr)
        return found.stderr.strip()

    def ndk(self, revision):
        for name in ("build/cmake/android.toolchain.cmake", "toolchains/llvm/prebuilt/linux-x86_64/bin/clang++"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).touch()
        (self.folder / "source.properties").write_text(f"Pkg.Desc = Android NDK\nPkg.Revision = {revision}\n")
        return str(self.folder)

    def test_without_an_ndk(self):
        self.assertEqual(self.refused("android"), "release.sh: android needs --ndk PATH, the folder of an Android NDK, r26 or later")
        self.assertEqual(self.refused("android", "--ndk"), "release.sh: --ndk needs a path: the folder of an Android NDK, r26 or later")
        self.assertEqual(self.refused("linux", "--ndk", "/"), "release.sh: --ndk is for the part android, given linux")

    def test_a_path_that_is_no_ndk(self):
        self.assertEqual(self.refused("android", "--ndk", "/no/ndk"), "release.sh: --ndk /no/ndk is no folder")
        self.assertEqual(self.refused("android", "--ndk", str(self.folder)),
                         f"release.sh: --ndk {self.folder} is no Android NDK for Linux: there is no source.properties")

    def test_an_ndk_that_is_too_old(self):
        old = self.ndk("25.2.9519653")
        self.assertEqual(self.refused("android", "--ndk", old), f"release.sh: --ndk {old} is NDK r25 (25.2.9519653), accepted: r26 or later")

    def test_an_accepted_ndk(self):
        for revision, major in (("26.0.10792818", "26"), ("28.0.12433566-beta1", "28")):
            found = subprocess.run([SOURCE / "packaging/android_ndk.sh", self.ndk(revision)], capture_output=True, text=True)
            self.assertEqual((found.returncode, found.stdout), (0, f"{major}\n"), found.stderr)

    def test_unity_before_android(self):
        self.assertEqual(self.refused("linux", "windows", "unity", "android", "--ndk", self.ndk("27.0.1")), "release.sh: unity needs the part android before it")


if __name__ == "__main__":
    COMPILER = sys.argv.pop()
    sys.path.insert(0, str(SOURCE / "unity"))
    import native_library
    import pack
    unittest.main()
