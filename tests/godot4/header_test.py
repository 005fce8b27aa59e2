# A path to the engine's header: files that are not there, or are of Godot 4.0, give one line.
# usage: header_test.py CMAKE SOURCE
import re
import subprocess
import sys
import tempfile
from pathlib import Path

cmake, source = sys.argv[1:]
old = "typedef struct { uint32_t version_major; } GDExtensionInterface;\n"  # the interface of 4.0 is a struct
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder, "gdextension_interface.h")
    project = Path(folder, "CMakeLists.txt")
    project.write_text(f"cmake_minimum_required(VERSION 3.25)\nproject(header NONE)\nadd_subdirectory({source}/contrib/godot4 godot4)\n")
    for content, what in [(None, r"expected the file gdextension_interface\.h"), (old, r"of Godot 4\.0 or another file, expected that of Godot 4\.1 or later")]:
        if content:
            file.write_text(content)
        run = subprocess.run([cmake, "-S", folder, "-B", f"{folder}/build", f"-DPELAGIC_GDEXTENSION_HEADER={file}"], capture_output=True, text=True)
        message = " ".join(run.stderr.split())
        assert run.returncode and re.search(rf"PELAGIC_GDEXTENSION_HEADER is {re.escape(str(file))},? {what}", message), run.stderr
