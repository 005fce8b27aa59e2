#!/usr/bin/env python3
"""schema/*.toml: the generated regions are current, wrong schemas are refused in one line, and an option that is added
to a schema exists in each language.

usage: options_test.py SOURCE C_COMPILER CXX_COMPILER
"""
import ctypes
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

SOURCE, CC, CXX = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
sys.path.insert(0, str(SOURCE / "tools/bindings"))
sys.dont_write_bytecode = True

import c_header  # noqa: E402
import python_layouts  # noqa: E402

FOLDERS = ("schema", "sim", "message", "simd", "analytic", "capi", "floating", "gl/sky", "jobs", "quadtree", "python/pelagic",
           "tools/options", "tools/bindings", "web/package", "docs/sea-state.md")
MADE_UP = """
[[option]]
name = "made_up_m"
unit = "m"
default = 2.5
range = "(0, 7]"
text = "an option of a test"
flag_help = "an option of a test"

[[option]]
name = "made_up_model"
enum = "SpreadingModel"
default = "hasselmann"
text = "an enumeration of a test"

[[option]]
name = "made_up_waves"
records = "made_up.toml"
max = 3
text = "a list of a test"
"""
MADE_UP_RECORD = """
struct = "MadeUp"
c = "pelagic_made_up"

[[option]]
name = "size_m"
unit = "m"
default = 1.5
range = "(0, 7]"
text = "a number of a record"

[[option]]
name = "model"
enum = "SpreadingModel"
default = "hasselmann"
text = "an enumeration of a record"
"""
# What stands around the regions of a record, before a line of a file.
AROUND_RECORD = (
    ("sim/sea_state.hpp", "/// Waves of one origin", """struct MadeUp {
    // generated from schema/made_up.toml: members
    // end of generated
};
std::string check_made_up(const MadeUp&);
"""),
    ("sim/spectrum/sea_state.cpp", "std::string check(const SeaState& sea) {", """constexpr NumericField<MadeUp> made_up_fields[] = {
    // generated from schema/made_up.toml: table
    // end of generated
};
std::string check_made_up(const MadeUp& up) {
    // generated from schema/made_up.toml: checks
    // end of generated
    return check_fields(up, made_up_fields);
}
"""),
    ("capi/pelagic.h", "/* A wave system", """typedef struct pelagic_made_up {
    /* generated from schema/made_up.toml: c-members */
    /* end of generated */
} pelagic_made_up;
/* generated from schema/made_up.toml: c-make */
/* end of generated */
"""),
    ("capi/c_sea.cpp", "pelagic_sea c_sea_of(", """pelagic_made_up c_made_up_of(const MadeUp& from) {
    pelagic_made_up to{};
    // generated from schema/made_up.toml: c-writes
    // end of generated
    return to;
}
MadeUp made_up_of(const pelagic_made_up& from, std::string_view prefix) {
    MadeUp to;
    // generated from schema/made_up.toml: c-reads
    // end of generated
    return to;
}
"""))


def generate(tree, *arguments):
    return subprocess.run([sys.executable, SOURCE / "tools/bindings/options.py", *arguments, tree], capture_output=True, text=True)


class Regions(unittest.TestCase):
    def test_are_those_of_the_schemas(self):
        found = generate(SOURCE)
        self.assertEqual((found.returncode, found.stdout + found.stderr), (0, ""))


class Schemas(unittest.TestCase):
    def refused(self, change, file="sea.toml"):
        """The error of a schema after change(text)."""
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(SOURCE / "schema", pathlib.Path(folder, "schema"))
            path = pathlib.Path(folder, "schema", file)
            text = path.read_text()
            path.write_text(change(text))
            self.assertNotEqual(path.read_text(), text)
            found = generate(folder)
            self.assertEqual((found.returncode, found.stdout), (1, ""))
            return found.stderr

    def test_wrong_ones_are_refused_in_one_line(self):
        for expected, change in (
            ("options.py: sea.toml has fetch_m twice\n", lambda text: text.replace('name = "depth_m"', 'name = "fetch_m"')),
            (r"options.py: sea.toml: fetch_m has the unknown unit km, accepted: m, s, .*\n", lambda text: text.replace('"fetch_m"\nunit = "m"', '"fetch_m"\nunit = "km"')),
            (r"options.py: sea.toml: fetch_m has the unit s, expected a name that ends in _s\n", lambda text: text.replace('"fetch_m"\nunit = "m"', '"fetch_m"\nunit = "s"')),
            (r"options.py: sea.toml: choppiness has the default 1.2, which is out of its range \[0, 1\]\n", lambda text: text.replace("default = 0.8", "default = 1.2")),
            (r"options.py: sea.toml: spreading has the default round, expected one of paper, .*\n", lambda text: text.replace('default = "donelan-banner"', 'default = "round"')),
            (r"options.py: sea.toml: seed has the unknown key maximum, accepted: accepted, .*\n", lambda text: text.replace('name = "seed"\n', 'name = "seed"\nmaximum = 3\n')),
            (r"options.py: sea.toml: seed has the unknown type long, accepted: bool, .*\n", lambda text: text.replace('type = "uint32"', 'type = "long"')),
            (r"options.py: sea.toml: systems has no max\n", lambda text: text.replace("max = 8\n", "")),
            (r"options.py: sea.toml: systems is a list of wind.toml, expected a file of schema/ without lists\n", lambda text: text.replace("wave_system.toml", "wind.toml")),
            (r"options.py: sea.toml: system is a list, expected a name that ends in s\n", lambda text: text.replace('"systems"', '"system"')),
            (r"options.py: sea.toml: seed has types of the unknown language Rust, accepted: C, C\+\+, Python, TypeScript\n",
             lambda text: text.replace('name = "seed"\n', 'name = "seed"\ntypes = { Rust = "u32" }\n')),
            (r"options.py: sea.toml: .*line \d+.*\n", lambda text: "option]\n" + text),
        ):
            self.assertRegex(self.refused(change), rf"\A{expected}\Z")

    def test_a_region_of_no_schema_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "sim").mkdir()
            pathlib.Path(folder, "sim/a.hpp").write_text("// generated from schema/nosuch.toml: members\n// end of generated\n")
            self.assertEqual(generate(folder).stderr, "options.py: sim/a.hpp has a region of nosuch.toml, which is not in schema/\n")


class NewOption(unittest.TestCase):
    """A copy of the tree whose sea has two options and a list more."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.tree = pathlib.Path(cls.folder.name, "pelagic")
        for name in FOLDERS:
            target = cls.tree / name
            target.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if (SOURCE / name).is_dir() else shutil.copy)(SOURCE / name, target)
        shutil.copy(SOURCE / "capi/pelagic.h", cls.tree / "pelagic.h")
        with open(cls.tree / "schema/sea.toml", "a") as schema:
            schema.write(MADE_UP)
        (cls.tree / "schema/made_up.toml").write_text(MADE_UP_RECORD)
        for name, line, text in AROUND_RECORD:
            there = (cls.tree / name).read_text()
            assert there.count(line) == 1, name
            (cls.tree / name).write_text(there.replace(line, text + line))
        found = generate(cls.tree, "--write")
        assert found.returncode == 0, found.stderr
        shutil.copy(cls.tree / "capi/pelagic.h", cls.tree / "pelagic.h")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_program(self, compiler, name, text, *flags):
        source = self.tree / name
        source.write_text(text)
        built = subprocess.run([compiler, f"-I{self.tree.parent}", source, *flags, "-o", source.with_suffix("")], capture_output=True, text=True)
        self.assertEqual((built.returncode, built.stderr), (0, ""))
        ran = subprocess.run([source.with_suffix("")], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 0, ran.stderr)
        return ran.stdout

    def test_is_set_and_checked_in_cpp(self):
        # The linker drops check(), and with it what it needs of the library.
        output = self.run_program(CXX, "set.cpp", """
#include <cstdio>
#include "pelagic/sim/spectrum/sea_state.cpp"
int main() {
    pelagic::SeaState sea;
    for (const pelagic::SeaStateField& field : pelagic::sea_state_fields()) {
        if (field.name != "made_up_m") continue;
        std::printf("%g %d %d %.*s", field.value_in(sea), field.accepts(0), field.accepts(7), int(field.accepted.size()), field.accepted.data());
        field.set(sea, 3);
    }
    sea.made_up_model = pelagic::SpreadingModel::cosine_2s;
    std::printf(" %g", sea.made_up_m);
}
""", "-std=c++20", "-ffunction-sections", "-Wl,--gc-sections")
        self.assertEqual(output, "2.5 0 1 (0, 7] 3")

    def test_is_set_in_c(self):
        output = self.run_program(CC, "set.c", """
#include <stdio.h>
#include "pelagic/pelagic.h"
int main(void) {
    pelagic_sea sea = pelagic_sea_make();
    printf("%g %d", sea.made_up_m, sea.made_up_model == PELAGIC_SPREADING_HASSELMANN);
    sea.made_up_m = 3;
    sea.made_up_model = PELAGIC_SPREADING_PAPER;
    printf(" %g", sea.made_up_m);
    return 0;
}
""", "-std=c99", "-Wall", "-Wextra", "-Werror", "-DPELAGIC_STATIC")
        self.assertEqual(output, "2.5 1 3")

    def test_a_list_is_set_and_checked_in_cpp(self):
        output = self.run_program(CXX, "list.cpp", """
#include <cstdio>
#include <iostream>
#include "pelagic/sim/spectrum/sea_state.cpp"
namespace pelagic {
std::string check_wave_list(const SeaState&) { return {}; }
WaveSystem wind_sea_of(const SeaState&) { return {}; }
}
int main() {
    pelagic::SeaState sea;
    std::cout << sea.made_up_waves.size() << pelagic::check(sea) << '\\n';
    sea.made_up_waves = {{}, {.size_m = 7, .model = pelagic::SpreadingModel::paper}};
    std::cout << sea.made_up_waves[0].size_m << ' ' << pelagic::check(sea) << '\\n';
    sea.made_up_waves.push_back({.size_m = 8});
    std::cout << pelagic::check(sea) << '\\n';
    sea.made_up_waves = {{.model = pelagic::SpreadingModel(4)}};
    std::cout << pelagic::check(sea) << '\\n';
    sea.made_up_waves = {{}, {}, {}};
    try {
        sea.made_up_waves.push_back({});
    } catch (const std::length_error& error) {
        std::cout << error.what() << '\\n';
    }
}
""", "-std=c++20", "-ffunction-sections", "-Wl,--gc-sections")
        self.assertEqual(output, "0\n1.5 \nmade_up_waves[2].size_m 8 is out of range (0, 7]\nmade_up_waves[0].model is no known model\n"
                                 "a list holds more values than it accepts\n")

    def test_a_list_is_set_in_c_and_converted(self):
        self.run_program(CC, "made.c", """
#include "pelagic/pelagic.h"
int main(void) {
    pelagic_sea sea = pelagic_sea_make();
    sea.made_up_waves[0] = pelagic_made_up_make();
    sea.made_up_wave_count = 1;
    return sea.made_up_waves[0].size_m == 1.5 && sea.made_up_waves[0].model == PELAGIC_SPREADING_HASSELMANN ? 0 : 1;
}
""", "-std=c99", "-Wall", "-Wextra", "-Werror", "-DPELAGIC_STATIC")
        output = self.run_program(CXX, "convert.cpp", """
#include <iostream>
#include "pelagic/capi/c_sea.cpp"
#include "pelagic/capi/c_status.cpp"
int main() {
    pelagic_sea sea = pelagic_sea_make(), back = pelagic_sea_make();
    for (pelagic_made_up& wave : sea.made_up_waves) wave = pelagic_made_up_make();
    sea.made_up_wave_count = 2;
    sea.made_up_waves[1].size_m = 3;
    sea.made_up_waves[1].model = PELAGIC_SPREADING_COSINE_2S;
    pelagic::capi::write_sea(pelagic::capi::sea_of(&sea), &back);
    std::cout << back.made_up_wave_count << ' ' << back.made_up_waves[0].size_m << ' ' << back.made_up_waves[1].size_m << ' '
              << back.made_up_waves[1].model << ' ' << back.made_up_waves[2].size_m << '\\n';
    const auto message = [&] {
        try {
            pelagic::capi::sea_of(&sea);
        } catch (const std::exception& error) {
            std::cout << error.what() << '\\n';
        }
    };
    sea.made_up_waves[1].model = 7;
    message();
    sea.made_up_wave_count = 4;
    message();
    sea.made_up_wave_count = -1;
    message();
}
""", "-std=c++20", "-O1", "-DPELAGIC_STATIC", "-static", "-Wl,--unresolved-symbols=ignore-all")  # of functions that nothing calls
        self.assertEqual(output, "2 1.5 3 1 0\nmade_up_waves[1].model is 7, expected one of PELAGIC_SPREADING_...\n"
                                 "made_up_wave_count is 4, expected 0 to 3\nmade_up_wave_count is -1, expected 0 to 3\n")

    def test_a_list_is_set_in_python_and_a_type_in_javascript(self):
        self.assertRegex((self.tree / "python/pelagic/_sea.py").read_text(), r"(?m)^    made_up_waves: tuple\[MadeUp, \.\.\.\] = \(\)$")
        self.assertIn("  /** A list of a test: at most 3. Default: none. */\n  madeUpWaves?: MadeUp[];", (self.tree / "web/package/index.d.ts").read_text())
        layouts = {}
        exec(python_layouts.write(c_header.read_header((self.tree / "pelagic.h").read_text())), layouts)
        wave = layouts["make"](layouts["pelagic_made_up"], size_m=3)
        sea = layouts["make"](layouts["pelagic_sea"], made_up_waves=(wave,), made_up_wave_count=1)
        self.assertEqual((sea.made_up_waves[0].size_m, sea.made_up_waves[0].model, sea.made_up_waves[1].size_m),
                         (3, layouts["PELAGIC_SPREADING_HASSELMANN"], 0))
        self.assertEqual(ctypes.sizeof(sea.made_up_waves), 3 * ctypes.sizeof(wave))

    def test_is_converted_between_c_and_cpp(self):
        text = (self.tree / "capi/c_sea.cpp").read_text()
        self.assertIn("to.made_up_m = from.made_up_m;", text)
        self.assertEqual(text.count("made_up_model"), 5, "three names where it is read, two where it is written")

    def test_is_a_flag_a_key_and_a_row_of_the_page(self):
        flags = (self.tree / "tools/options/sea_options.cpp").read_text()
        self.assertIn('{"made-up", "made_up_m", "an option of a test"', flags)
        self.assertIn('visit("made-up-model", &SeaState::made_up_model', flags)
        self.assertIn("| `made_up_m` | (0, 7] | 2.5 | an option of a test |", (self.tree / "docs/sea-state.md").read_text())

    def test_is_a_type_in_javascript(self):
        types = (self.tree / "web/package/index.d.ts").read_text()
        self.assertIn("  /** An option of a test, metres: (0, 7]. Default 2.5. */\n  madeUpM?: number;", types)
        self.assertIn("  madeUpModel?: 'paper' | 'cosine-2s' | 'hasselmann' | 'donelan-banner';", types)

    def test_is_set_in_python(self):
        text = (self.tree / "python/pelagic/_sea.py").read_text()
        self.assertRegex(text, r'(?m)^    made_up_m: float = 2\.5$')
        self.assertRegex(text, r'(?m)^    made_up_model: str = "hasselmann"$')
        layouts = {}
        exec(python_layouts.write(c_header.read_header((self.tree / "pelagic.h").read_text())), layouts)
        sea = layouts["make"](layouts["pelagic_sea"])
        self.assertEqual((sea.made_up_m, sea.made_up_model), (2.5, layouts["PELAGIC_SPREADING_HASSELMANN"]))
        sea.made_up_m = 3
        bytes_of_c = self.run_program(CC, "layout.c", """
#include <stddef.h>
#include <stdio.h>
#include "pelagic/pelagic.h"
int main(void) {
    printf("%zu %zu %zu", sizeof(pelagic_sea), offsetof(pelagic_sea, made_up_m), offsetof(pelagic_sea, made_up_model));
    return 0;
}
""", "-DPELAGIC_STATIC")
        self.assertEqual(bytes_of_c, f"{ctypes.sizeof(sea)} {type(sea).made_up_m.offset} {type(sea).made_up_model.offset}")
        self.assertEqual(struct.unpack_from("d", bytes(sea), type(sea).made_up_m.offset), (3,))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
