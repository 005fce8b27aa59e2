#!/usr/bin/env python3
"""The descriptions that tools/bindings generates from pelagic.h agree with the C compiler and with
the library.

usage: header_test.py COMPILER LIBRARY
"""
import ctypes
import functools
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(SOURCE / "tools/bindings"), str(SOURCE / "python/pelagic")]
sys.dont_write_bytecode = True

import _native as pelagic  # noqa: E402
import abi  # noqa: E402
import c_header  # noqa: E402
import c_layout  # noqa: E402
import header as generator  # noqa: E402
from _native import make  # noqa: E402

GOLDEN = dict(line.split() for line in (SOURCE / "tests/golden/hashes.txt").read_text().splitlines())


@functools.cache
def compiled_defaults():
    return c_layout.compiled_defaults(generator.read_pelagic_header(), SOURCE / "capi", COMPILER)


@functools.cache
def compiled():
    """Sizes, offsets and enumerators by the C compiler."""
    return c_layout.compiled_layout(generator.read_pelagic_header(), SOURCE / "capi", COMPILER)


class GeneratedFiles(unittest.TestCase):
    def test_are_those_of_the_header(self):
        found = subprocess.run([sys.executable, SOURCE / "tools/bindings/header.py"], capture_output=True, text=True)
        self.assertEqual((found.returncode, found.stdout + found.stderr), (0, ""))


class Parser(unittest.TestCase):
    def setUp(self):
        self.header, self.compiled = generator.read_pelagic_header(), compiled()

    def test_has_the_sizes_offsets_and_enumerators_of_the_compiler(self):
        self.assertGreater(len(self.compiled), 300)
        self.assertEqual(c_layout.differences(self.compiled, c_layout.read_layout(self.header)), [])

    def test_structs_with_a_size_grow_with_each_new_field(self):
        """A field that a later version adds would else lie in padding, whose bytes have no value."""
        for struct in self.header.structs:
            end = self.compiled[f"{struct.name}.{struct.fields[-1].name}"] + c_header.field_bytes(self.header, struct.fields[-1])
            if struct.has_size:
                self.assertEqual(end, self.compiled[struct.name], struct.name)

    def test_has_the_defaults_of_the_compiler(self):
        self.assertGreater(len([name for name, number in compiled_defaults().items() if number != 0]), 40)
        self.assertEqual(c_layout.differences(compiled_defaults(), c_layout.read_defaults(self.header)), [])

    def test_each_struct_with_a_size_has_a_function_that_makes_it(self):
        text = (SOURCE / "capi/pelagic.h").read_text()
        self.assertEqual([s.name for s in self.header.structs if s.has_size and f"{s.name}_make(void)" not in text], [])

    def test_structs_have_one_hole_at_most(self):
        for struct in self.header.structs:
            fields = sum(c_header.field_bytes(self.header, field) for field in struct.fields)
            self.assertIn(self.compiled[struct.name] - fields, (0, 4), struct.name)

    def test_structs_that_the_library_only_writes_have_no_size(self):
        written = {"pelagic_sea"}  # by pelagic_sea_preset()
        for function in self.header.functions:
            for parameter in function.parameters:
                struct = self.header.struct(parameter.type.base)
                if struct and parameter.type.pointers and struct.name not in written:
                    is_read = parameter.type.is_const
                    self.assertEqual(struct.has_size, is_read and struct.name != "pelagic_hull_state", (function.name, struct.name))

    def test_finds_the_functions_that_the_library_exports(self):
        exported = (SOURCE / "tests/abi/pelagic.symbols").read_text().split()
        self.assertEqual(sorted(function.name for function in self.header.functions), sorted(exported))

    def test_finds_each_name_that_the_header_defines(self):
        text = re.sub(r"/\*.*?\*/", "", (SOURCE / "capi/pelagic.h").read_text(), flags=re.S)
        found = {s.name for s in self.header.structs} | {name for name, _ in self.header.handles} | {c.name for c in self.header.callbacks}
        found |= {f.name for f in self.header.functions} | {self.header.status}
        found |= {f"{s.name}_make" for s in self.header.structs if s.has_size or s.defaults}
        self.assertEqual(set(re.findall(r"\bpelagic_\w+", text)), found)

    def test_rejects_what_it_cannot_read(self):
        text = (SOURCE / "capi/pelagic.h").read_text()
        for unknown in ("union pelagic_union { int32_t a; float b; };", "typedef struct pelagic_bits { uint32_t a : 3; } pelagic_bits;",
                        "static inline pelagic_rain pelagic_rain_make(void) { PELAGIC_ZEROS(pelagic_rain, rain); rain.seed += 1; return rain; }"):
            with self.assertRaises((ValueError, TypeError)):
                c_header.read_header(text.replace("#ifdef __cplusplus\n}", unknown + "\n#ifdef __cplusplus\n}"))

    def test_a_moved_field_is_a_difference(self):
        self.header.struct("pelagic_sea").fields.reverse()
        self.assertIn("pelagic_sea.wind_speed_mps", "".join(c_layout.differences(self.compiled, c_layout.read_layout(self.header))))


class FrozenInterface(unittest.TestCase):
    def setUp(self):
        self.header, self.stored = generator.read_pelagic_header(), generator.ABI.read_text()

    def breaks(self, layout):
        return list(abi.breaks(self.stored, abi.write(self.header, layout)))

    def test_is_kept(self):
        self.assertEqual(self.breaks(compiled()), [])

    def test_a_new_field_at_the_end_keeps_it(self):
        self.assertEqual(self.breaks(compiled() | {"pelagic_sea": compiled()["pelagic_sea"] + 8}), [])

    def test_other_changes_break_it(self):
        for name, number in (("pelagic_sea", 8), ("pelagic_frame", compiled()["pelagic_frame"] + 8), ("pelagic_sea.wind_speed_mps", 0),
                             ("PELAGIC_OUT_OF_MEMORY", 77)):
            self.assertEqual(len(self.breaks(compiled() | {name: number})), 1, name)
        self.header.functions = [f for f in self.header.functions if f.name != "pelagic_ocean_query"]
        self.assertEqual(len([line for line in self.breaks(compiled()) if line.startswith("pelagic_status pelagic_ocean_query(")]), 1)

    def test_experimental_functions_are_left_out(self):
        self.assertEqual([f.name for f in self.header.functions if f.is_experimental and f"{f.name}(" in self.stored], [])


class PythonLayouts(unittest.TestCase):
    def test_are_those_of_the_compiler(self):
        here = {name: getattr(pelagic, name) for name in compiled() if name.startswith("PELAGIC_")}
        for struct in pelagic.STRUCTS:
            here[struct.__name__] = ctypes.sizeof(struct)
            here.update({f"{struct.__name__}.{field}": getattr(struct, field).offset for field, *_ in struct._fields_})
        self.assertEqual(c_layout.differences(compiled(), here), [])

    def test_make_structs_of_the_defaults(self):
        structs = {struct.__name__: make(struct) for struct in pelagic.STRUCTS if hasattr(struct, "struct_size") or struct in pelagic.DEFAULTS}
        here = {name: float(getattr(structs[name.split(".")[0]], name.split(".")[1])) for name in compiled_defaults()}
        self.assertEqual(c_layout.differences(compiled_defaults(), here), [])
        self.assertEqual({name: ctypes.sizeof(s) for name, s in structs.items() if hasattr(s, "struct_size")},
                         {name: s.struct_size for name, s in structs.items() if hasattr(s, "struct_size")})

    def test_the_library_computes_golden_hashes_by_them(self):
        library = pelagic.load(LIBRARY)
        for name in ("preset-calm", "preset-storm"):
            sea, frame, options = make(pelagic.pelagic_sea), pelagic.pelagic_frame(), make(pelagic.pelagic_ocean_options)
            ocean, number = ctypes.c_void_p(), ctypes.c_uint64()
            self.assertEqual(library.pelagic_sea_preset(name.partition("-")[2].encode(), sea), pelagic.PELAGIC_OK)
            self.assertEqual(library.pelagic_ocean_create(sea, options, ctypes.byref(ocean)), pelagic.PELAGIC_OK)
            for time_s in (0, 12.34):
                self.assertEqual(library.pelagic_ocean_schedule(ocean, time_s), pelagic.PELAGIC_OK)
                self.assertEqual(library.pelagic_ocean_complete(ocean, frame), pelagic.PELAGIC_OK)
                self.assertEqual(library.pelagic_ocean_frame_hash(ocean, frame.number, pelagic.PELAGIC_HASH_FRAME, ctypes.byref(number)), pelagic.PELAGIC_OK)
                self.assertEqual((frame.time_s, f"{number.value:x}"), (time_s, GOLDEN[f"{name}@{time_s}"].lstrip("0")))
            library.pelagic_ocean_destroy(ocean)


class NamesInOtherLanguages(unittest.TestCase):
    """Words of options that are written by hand for types and menus."""

    def names(self, prefix):
        enum = next(e for e in generator.read_pelagic_header().enums if e.prefix == prefix)
        return {name.lower().replace("_", "-") for name, _, _ in enum.values}

    def test_javascript_has_the_words_of_the_enums(self):
        types = (SOURCE / "web/package/index.d.ts").read_text()
        for option, prefix in (("spectrum", "PELAGIC_SPECTRUM_"), ("spreading", "PELAGIC_SPREADING_"), ("waves", "PELAGIC_WAVES_"),
                               ("step", "PELAGIC_DYNAMIC_WAVES_"), ("shape", "PELAGIC_SHAPE_"), ("mode", "PELAGIC_DISTURBANCE_")):
            unions = re.findall(rf"\b{option}\??: ((?:'[\w-]+'(?: \| )?)+)", types)
            self.assertTrue(unions, option)
            for union in unions:
                self.assertEqual(set(re.findall(r"'([\w-]+)'", union)), self.names(prefix), option)

    def test_python_has_the_fields_of_the_sea(self):
        sea = generator.read_pelagic_header().struct("pelagic_sea")
        text = (SOURCE / "python/pelagic/_sea.py").read_text()
        for field in sea.fields:
            if field.name not in ("struct_size", "system_count"):
                self.assertRegex(text, rf"(?m)^    {field.name}: ", field.name)


if __name__ == "__main__":
    LIBRARY, COMPILER = sys.argv.pop(), sys.argv.pop()
    unittest.main()
