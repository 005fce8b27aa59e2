"""Builds a wheel of the CMake target pelagic_python, for every Python 3. PEP 517, with only Python's
standard library and CMake.

CMAKE_ARGS has additional options for CMake, such as -DPELAGIC_TBB=OFF. The build stays in
build/python, for the next one. PELAGIC_PYTHON_PACKAGE names the package folder of a build that
exists, which is packed instead. PELAGIC_WHEEL_PLATFORM is the platform of the wheel's name instead of
this system, such as manylinux_2_34_x86_64.
"""

import base64
import hashlib
import io
import os
import re
import shlex
import subprocess
import sysconfig
import tarfile
import zipfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]


def field_of_project(name):
    """Returns a string of pyproject.toml's table [project]; Python reads TOML only from 3.11 on."""
    table = (SOURCE / "pyproject.toml").read_text("utf-8").split("[project]")[1]
    return re.search(rf'^{name} = "(.*)"$', table, re.MULTILINE).group(1)


def list_of_project(name):
    """Returns a list of strings of that table."""
    table = (SOURCE / "pyproject.toml").read_text("utf-8").split("[project]")[1]
    return re.findall(r'"(.*?)"', re.search(rf"^{name} = \[(.*?)\]$", table, re.MULTILINE | re.DOTALL).group(1))


def version_of_header():
    text = (SOURCE / "capi" / "pelagic.h").read_text("utf-8")
    return ".".join(re.search(rf"PELAGIC_VERSION_{part} (\d+)", text).group(1) for part in ("MAJOR", "MINOR", "PATCH"))


NAME, VERSION = field_of_project("name"), version_of_header()
INFO = f"{NAME}-{VERSION}.dist-info"


def tag():
    platform = os.environ.get("PELAGIC_WHEEL_PLATFORM") or re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"py3-none-{platform}"


def metadata():
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {NAME}",
        f"Version: {VERSION}",
        f"Summary: {field_of_project('description')}",
        f"Requires-Python: {field_of_project('requires-python')}",
        *(f"Classifier: {each}" for each in list_of_project("classifiers")),
        *(f"Requires-Dist: {needed}" for needed in list_of_project("dependencies")),
        "Description-Content-Type: text/markdown",
        "",
        (SOURCE / field_of_project("readme")).read_text("utf-8"),
    ]
    return "\n".join(lines)


def run(*command):
    print(shlex.join(map(str, command)), flush=True)
    if subprocess.run(list(map(str, command))).returncode != 0:
        raise SystemExit(f"{command[0]} failed; what building Pelagic needs stands in docs/integrations/python.md")


def built_files():
    """Returns the files of the package, by name."""
    folder = os.environ.get("PELAGIC_PYTHON_PACKAGE")
    if not folder:
        build = SOURCE / "build" / "python"
        run("cmake", "--preset", "python", "-S", SOURCE, "-B", build, *shlex.split(os.environ.get("CMAKE_ARGS", "")))
        run("cmake", "--build", build, "--target", "pelagic_python",
            "--parallel", os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", os.cpu_count()))
        folder = build / "python" / "pelagic"
    return {file.name: file.read_bytes() for file in sorted(Path(folder).iterdir())
            if file.suffix in (".py", ".typed", ".so", ".dylib", ".dll")}


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    files = {f"pelagic/{name}": content for name, content in built_files().items()}
    for name in ("LICENSE", "NOTICE"):
        files[f"{INFO}/{name}"] = (SOURCE / name).read_bytes()
    files[f"{INFO}/METADATA"] = metadata().encode()
    files[f"{INFO}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: pelagic\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    record = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record.append(f"{name},sha256={digest},{len(content)}\n")
    files[f"{INFO}/RECORD"] = "".join([*record, f"{INFO}/RECORD,,\n"]).encode()

    wheel = f"{NAME}-{VERSION}-{tag()}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """All files of the folder except build products."""
    folder = f"{NAME}-{VERSION}"
    with tarfile.open(Path(sdist_directory) / f"{folder}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in sorted(SOURCE.iterdir()):
            if path.name not in (".git", "build", "dist", "out"):
                archive.add(path, f"{folder}/{path.name}", filter=lambda entry: None if "__pycache__" in entry.name else entry)
        info = tarfile.TarInfo(f"{folder}/PKG-INFO")
        content = metadata().encode()
        info.size = len(content)
        archive.addfile(info, io.BytesIO(content))
    return f"{folder}.tar.gz"
