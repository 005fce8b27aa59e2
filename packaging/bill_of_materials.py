#!/usr/bin/env python3
"""Writes the bill of materials of dist/, pelagic-VERSION.spdx.json (SPDX 2.3): for each package the
versions and licences of the code of others that is compiled into it.

usage: bill_of_materials.py DIST_FOLDER

Versions are those of the installed Debian packages. NOTICE has the same components.
"""
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[1]
# Name in NOTICE: Debian package, licence, home page.
COMPONENTS = {
    "xsimd": ("libxsimd-dev", "BSD-3-Clause AND BSL-1.0", "https://github.com/xtensor-stack/xsimd"),
    "xxHash": ("libxxhash-dev", "BSD-2-Clause", "https://github.com/Cyan4973/xxHash"),
    "oneTBB": ("libtbb-dev", "Apache-2.0", "https://github.com/oneapi-src/oneTBB"),
    "GLM": ("libglm-dev", "MIT", "https://github.com/g-truc/glm"),
    "CLI11": ("libcli11-dev", "BSD-3-Clause", "https://github.com/CLIUtils/CLI11"),
    "toml++": ("libtomlplusplus-dev", "MIT", "https://github.com/marzer/tomlplusplus"),
    "nlohmann-json": ("nlohmann-json3-dev", "MIT", "https://github.com/nlohmann/json"),
    "OpenImageIO": ("libopenimageio-dev", "BSD-3-Clause AND Apache-2.0 AND MIT", "https://github.com/OpenImageIO/oiio"),
    "Imath": ("libimath-dev", "BSD-3-Clause", "https://github.com/AcademySoftwareFoundation/Imath"),
    "OpenEXR": ("libopenexr-dev", "BSD-3-Clause", "https://github.com/AcademySoftwareFoundation/openexr"),
    "Dear ImGui": ("libimgui-dev", "MIT", "https://github.com/ocornut/imgui"),
    "stb": ("libstb-dev", "MIT OR Unlicense", "https://github.com/nothings/stb"),
    "pybind11": ("pybind11-dev", "BSD-3-Clause", "https://github.com/pybind/pybind11"),
    "Emscripten": ("emscripten", "MIT OR NCSA", "https://github.com/emscripten-core/emscripten"),
    "musl": ("emscripten", "MIT", "https://musl.libc.org"),
    "dlmalloc": ("emscripten", "CC0-1.0", "https://gee.cs.oswego.edu/dl/html/malloc.html"),
    "libc++": ("emscripten", "Apache-2.0 WITH LLVM-exception", "https://llvm.org"),
    "mingw-w64": ("mingw-w64-x86-64-dev", "ZPL-2.1 AND MIT AND LicenseRef-public-domain", "https://www.mingw-w64.org"),
    "libstdc++": ("g++-mingw-w64-x86-64-posix", "GPL-3.0-or-later WITH GCC-exception-3.1", "https://gcc.gnu.org"),
}
LIBRARY = ["xsimd", "xxHash", "GLM"]
MODULE = ["xsimd", "xxHash"]
COMMAND = ["CLI11", "toml++", "nlohmann-json"]
IMAGES = ["stb", "OpenImageIO", "Imath", "OpenEXR", "Dear ImGui"]
WINDOWS = ["mingw-w64", "libstdc++"]
# Patterns of file names, first match.
CONTENTS = [
    (r"libpelagic[\d.]+_.*\.deb", [*LIBRARY, "oneTBB"]),
    (r"libpelagic-dev_.*\.deb", [*LIBRARY, "oneTBB"]),
    (r"pelagic_[\d.]+-.*\.deb", [*LIBRARY, "oneTBB", *COMMAND, *IMAGES]),
    (r"pelagic-[\d.]+-linux-x86_64\.tar\.gz", [*LIBRARY, *COMMAND, *IMAGES]),
    (r"pelagic-[\d.]+-linux-arm64\.tar\.gz", [*LIBRARY, *COMMAND]),
    (r"pelagic-[\d.]+-windows-x86_64\.zip", [*LIBRARY, *COMMAND, *WINDOWS]),
    (r"pelagic-.*\.whl|pelagic_blender-.*\.zip", [*LIBRARY, "pybind11"]),
    (r"pelagic-[\d.]+\.tgz", [*MODULE, "Emscripten", "musl", "dlmalloc", "libc++"]),
    (r"pelagic-godot-.*\.zip", LIBRARY),
    (r"com\.pelagic\.ocean-.*\.tgz", [*LIBRARY, *WINDOWS]),
]


def version_of(package):
    shown = subprocess.run(["dpkg-query", "-W", "-f", "${Version}\n", package], capture_output=True, text=True)
    return next(iter(shown.stdout.split()), None) or sys.exit(f"bill_of_materials.py: {package} is not installed")


def identifier(name):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)


def package(name, version, supplier, declared, concluded, **more):
    return {"SPDXID": identifier(name), "name": name, "versionInfo": version, "supplier": f"Organization: {supplier}",
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": concluded, "licenseDeclared": declared,
            "copyrightText": "NOASSERTION", **more}


def component(name):
    debian, licence, page = COMPONENTS[name]
    version = version_of(debian)
    locator = f"pkg:deb/debian/{debian}@{version}?distro=bookworm".replace("+", "%2B")
    return package(name, version, "Debian", licence, licence, homepage=page, sourceInfo=f"Code and version of Debian's package {debian}",
                   externalRefs=[{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": locator}])


def all_licences(components):
    """The expression for a file that contains Pelagic and these components."""
    licences = sorted({licence for name in components for licence in COMPONENTS[name][1].split(" AND ")} - {"MIT"})
    return " AND ".join(["MIT", *(f"({licence})" if " OR " in licence else licence for licence in licences)])


def main():
    dist = pathlib.Path(sys.argv[1])
    notice = (SOURCE / "NOTICE").read_text()
    if missing := [name for name in COMPONENTS if name not in notice]:
        sys.exit(f"bill_of_materials.py: NOTICE lacks {', '.join(missing)}")
    version = subprocess.run([SOURCE / "packaging/version.sh"], capture_output=True, text=True, check=True).stdout.strip()
    packages, relationships, used = [], [], set()
    for file in sorted(dist.iterdir()):
        found = next((components for pattern, components in CONTENTS if re.fullmatch(pattern, file.name)), None)
        if found is None:
            sys.exit(f"bill_of_materials.py: {file.name} is in no list of components")
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        packages.append(package(file.name, version, "The Pelagic authors", "MIT", all_licences(found), packageFileName=file.name,
                                checksums=[{"algorithm": "SHA256", "checksumValue": digest}]))
        relationships.append(("SPDXRef-DOCUMENT", "DESCRIBES", identifier(file.name)))
        relationships += [(identifier(file.name), "CONTAINS", identifier(name)) for name in found]
        used.update(found)
    packages += [component(name) for name in COMPONENTS if name in used]
    commit = subprocess.run(["git", "-C", SOURCE, "rev-parse", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
    created = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"pelagic-{version}",
        "documentNamespace": f"https://spdx.org/spdxdocs/pelagic-{version}-{commit}",
        "creationInfo": {"created": created, "creators": [f"Tool: bill_of_materials.py-{version}"]},
        "packages": packages,
        "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b} for a, kind, b in relationships]}
    if "mingw-w64" in used:
        document["hasExtractedLicensingInfos"] = [{"licenseId": "LicenseRef-public-domain", "extractedText": "Placed in the public domain.", "name": "Public domain"}]
    (dist / f"pelagic-{version}.spdx.json").write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    main()
