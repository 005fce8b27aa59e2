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
sys.path[:0] = [str(SOURCE / "tests/android"), str(SOURCE / "tests/unity")]
import native_libraries  # noqa: E402
import unity_yaml  # noqa: E402
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
                     "Samples~/FrameLoop/FrameLoop.cs", "Documentation~/pelagic.md", "Documentation~/engines.md", "Editor/Pelagic.Unity.Editor.asmdef", "Samples~/FirstSea/FirstSea.unity"):
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

    def test_each_stub_has_a_link_to_its_signature(self):
        text = (SOURCE / "tests/unity/Stubs.cs").read_text()
        reference = "https://docs.unity3d.com/2022.3/Documentation/ScriptReference/"
        types = re.findall(r"((?:^ *///.*\n|^ *\[.*\n)*)^ +public (?:static |sealed |unsafe |readonly )*(?:class|struct|enum|interface) (\w+)", text, re.M)
        self.assertGreater(len(types), 60)
        for comment, name in types:
            if name != "ShaderValues":
                self.assertRegex(comment, rf"<summary>{reference}(\w+\.)*{name}\w*([.-]\w+)?\.html</summary>", name)

    # ---- Scenes, prefabs and materials ---------------------------------------------------------

    # Unity's own assets, by file number: https://docs.unity3d.com/2022.3/Documentation/ScriptReference/Resources.GetBuiltinResource.html
    BUILT_IN = {"0000000000000000e000000000000000": {10202: "the cube", 10001: "a cookie"}, "0000000000000000f000000000000000": {10304: "the sky"},
                "31321ba15b8f8eb4c954353edc038b1d": {2100000: "Runtime/Materials/Lit.mat of URP"}}
    # Numbers of types: https://docs.unity3d.com/2022.3/Documentation/Manual/ClassIDReference.html
    CLASSES = {1: "GameObject", 4: "Transform", 20: "Camera", 21: "Material", 23: "MeshRenderer", 29: "OcclusionCullingSettings", 33: "MeshFilter", 54: "Rigidbody",
               65: "BoxCollider", 81: "AudioListener", 104: "RenderSettings", 108: "Light", 114: "MonoBehaviour", 157: "LightmapSettings", 196: "NavMeshSettings",
               1001: "PrefabInstance", 1660057539: "SceneRoots"}
    # As public scenes and prefabs of 2022.3 have them: the examples of Cinemachine 3 and others.
    VERSIONS = {"GameObject": "6", "Transform": "2", "Camera": "2", "Material": "8", "Rigidbody": "4", "BoxCollider": "3", "RenderSettings": "9", "Light": "10",
                "LightmapSettings": "12", "PrefabInstance": "2"}
    PUBLIC_FIELD = re.compile(r"^        public (?!static|const|readonly|event|override)([\w.\[\]]+) (\w+)(?: = [^;>]+)?;", re.M)
    RANGE = re.compile(r"\[Range\(([-\d.]+)f?, ([-\d.]+)f?\).*?\]\n        public (?:float|int) (\w+)")

    def assets(self, names):
        """Paths by GUID, and the documents of files that are YAML."""
        guids = {re.search(rb"^guid: ([0-9a-f]{32})$", data, re.M)[1].decode(): name.removesuffix(".meta") for name, data in names.items() if name.endswith(".meta")}
        documents = {name: unity_yaml.documents(data.decode()) for name, data in names.items() if name.endswith((".unity", ".prefab", ".mat"))}
        return guids, documents

    def check_reference(self, where, reference, own, guids, documents):
        number, guid = int(reference["fileID"]), reference.get("guid")
        if number == 0:
            return None
        if guid is None:
            self.assertIn(number, own, where)
            return own[number]
        if guid in self.BUILT_IN:
            self.assertIn(number, self.BUILT_IN[guid], where)
            return None
        self.assertIn(guid, guids, where)
        path = guids[guid]
        kind = {".cs": (11500000, "3"), ".shader": (4800000, "3"), ".mat": (2100000, "2")}.get(pathlib.PurePosixPath(path).suffix)
        if kind:
            self.assertEqual((number, reference["type"]), kind, where)
            return path
        self.assertTrue(path.endswith(".prefab") and reference["type"] == "3" and (number == 100100000 or number in documents[path]), where)
        return documents[path].get(number)

    def test_scenes_refer_to_objects_that_exist(self):
        names = self.files(self.packed())
        guids, documents = self.assets(names)
        self.assertEqual(sorted(pathlib.PurePosixPath(name).suffix for name in documents), [".mat", ".prefab", ".unity"])
        count = 0
        for name, objects in documents.items():
            for number, document in objects.items():
                self.assertEqual(self.CLASSES[document.class_number], document.type_name, f"{name} {number}")
                if document.type_name in self.VERSIONS:
                    self.assertEqual(document.fields["serializedVersion"], self.VERSIONS[document.type_name], f"{name} {document.type_name}")
                for path, reference in unity_yaml.references(document.fields):
                    found = self.check_reference(f"{name} {number}{path}", reference, objects, guids, documents)
                    count += 1
                    if path == ".m_GameObject":
                        components = [int(entry["component"]["fileID"]) for entry in found.fields["m_Component"]]
                        self.assertIn(number, components, f"{name} {number}: a component of its object")
                if document.type_name == "GameObject":
                    for entry in document.fields["m_Component"]:
                        self.assertEqual(objects[int(entry["component"]["fileID"])].fields["m_GameObject"], {"fileID": str(number)})
        self.assertGreater(count, 150)

    def test_serialised_fields_are_those_of_the_scripts(self):
        names = self.files(self.packed())
        guids, documents = self.assets(names)
        system = names["Runtime/Unity/OceanSystem.cs"].decode()
        seen = set()
        for name, objects in documents.items():
            for document in objects.values():
                if document.type_name != "MonoBehaviour":
                    continue
                path = guids[document.fields["m_Script"]["guid"]]
                source = names[path].decode()
                fields = {field: kind for kind, field in self.PUBLIC_FIELD.findall(source)}
                written = list(document.fields)[list(document.fields).index("m_EditorClassIdentifier") + 1:]
                self.assertEqual(written, list(fields), f"{name} {path}")
                seen.add(pathlib.PurePosixPath(path).stem)
                for item in document.fields.get("Systems", []):
                    self.assertEqual(list(item), [field for _, field in self.PUBLIC_FIELD.findall(system)])
                for low, high, field in self.RANGE.findall(source):
                    self.assertTrue(float(low) <= float(document.fields[field]) <= float(high), f"{name} {path} {field}")
                # References to components are to those of the field's type.
                for field, kind in fields.items():
                    value = document.fields[field]
                    if isinstance(value, dict) and "fileID" in value and "guid" not in value and value["fileID"] != "0":
                        found = objects[int(value["fileID"])]
                        script = found.fields.get("m_Script")
                        self.assertEqual(pathlib.PurePosixPath(guids[script["guid"]]).stem if script else found.type_name, kind, f"{name} {field}")
        self.assertEqual(seen, {"OceanBehaviour", "OceanSurface", "OceanFloating", "FloatingOrigin"})

    def test_a_prefab_in_a_scene_changes_what_it_has(self):
        guids, documents = self.assets(self.files(self.packed()))
        scene = documents["Samples~/FirstSea/FirstSea.unity"]
        roots = {int(entry["fileID"]) for entry in scene[9223372036854775807].fields["m_Roots"]}
        self.assertEqual(roots, {number for number, of in scene.items() if of.type_name == "PrefabInstance" or (of.type_name == "Transform" and of.fields["m_Father"] == {"fileID": "0"})})
        (instance,) = (of for of in scene.values() if of.type_name == "PrefabInstance")
        changes = instance.fields["m_Modification"]["m_Modifications"]
        for change in changes:
            value = documents[guids[change["target"]["guid"]]][int(change["target"]["fileID"])].fields
            for key in change["propertyPath"].split("."):
                self.assertIn(key, value)
                value = value[key]
        ocean = next(change for change in changes if change["propertyPath"] == "Ocean")
        self.assertEqual(guids[scene[int(ocean["objectReference"]["fileID"])].fields["m_Script"]["guid"]], "Runtime/Unity/OceanBehaviour.cs")

    def test_a_scene_with_a_fault_is_found(self):
        good = (SOURCE / "unity/Samples~/FirstSea/FirstSea.unity").read_text()
        for old, new in (("--- !u!4 &1001", "--- !u!4 &1000"), ("  m_Enabled: 1\n", "  m_Enabled: 1\n  m_Enabled: 1\n"), ("{fileID: 1002}", "{fileID: 1002"), ("  m_Layer: 0", "   m_Layer: 0")):
            with self.assertRaises(unity_yaml.Unreadable):
                unity_yaml.documents(good.replace(old, new, 1))


if __name__ == "__main__":
    COMPILER = sys.argv.pop()
    unittest.main()
