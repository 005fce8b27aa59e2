#!/usr/bin/env python3
"""Writes the bill of materials of dist/, pelagic-VERSION.spdx.json (SPDX 2.3): for each package the
versions and licences of the code of others that is compiled into it.

usage: bill_of_materials.py DIST_FOLDER SOURCE_FOLDER

Versions are those of the installed Debian packages, of the Debian sources that windows_libraries.sh built,
and of the NDK in PELAGIC_NDK. NOTICE has the same components. Fails if the headers that the builds in
SOURCE_FOLDER/build included belong to other Debian packages.
"""
import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

import artefact

SOURCE = pathlib.Path(__file__).resolve().parents[1]
# Name in NOTICE: Debian package, or "source" and a source package, licence, home page.
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
    "libpng": ("source libpng1.6", "libpng-2.0", "http://www.libpng.org/pub/png/libpng.html"),
    "zlib": ("libz-mingw-w64-dev", "Zlib", "https://zlib.net"),
    "Zstandard": ("source libzstd", "BSD-3-Clause", "https://github.com/facebook/zstd"),
    "Dear ImGui": ("libimgui-dev", "MIT", "https://github.com/ocornut/imgui"),
    "stb": ("libstb-dev", "MIT OR Unlicense", "https://github.com/nothings/stb"),
    "Emscripten": ("emscripten", "MIT OR NCSA", "https://github.com/emscripten-core/emscripten"),
    "musl": ("emscripten", "MIT", "https://musl.libc.org"),
    "dlmalloc": ("emscripten", "CC0-1.0", "https://gee.cs.oswego.edu/dl/html/malloc.html"),
    "libc++": ("emscripten", "Apache-2.0 WITH LLVM-exception", "https://llvm.org"),
    "mingw-w64": ("mingw-w64-x86-64-dev", "ZPL-2.1 AND MIT AND LicenseRef-public-domain", "https://www.mingw-w64.org"),
    "Android NDK": (None, "Apache-2.0 WITH LLVM-exception", "https://developer.android.com/ndk"),  # libc++, libc++abi, libunwind, compiler-rt
    "libstdc++": ("g++-mingw-w64-x86-64-posix", "GPL-3.0-or-later WITH GCC-exception-3.1", "https://gcc.gnu.org"),
}
LIBRARY = ["xsimd", "xxHash", "GLM"]
MODULE = ["xsimd", "xxHash"]
COMMAND = ["CLI11", "toml++", "nlohmann-json"]
IMAGES = ["stb", "OpenImageIO", "Imath", "OpenEXR", "Dear ImGui"]
WINDOWS = ["mingw-w64", "libstdc++"]
WINDOWS_IMAGES = ["stb", "Imath", "OpenEXR", "libpng", "zlib", "Zstandard"]
# Patterns of file names, first match.
CONTENTS = [
    (r"libpelagic[\d.]+_.*\.deb", [*LIBRARY, "oneTBB"]),
    (r"libpelagic-dev_.*\.deb", [*LIBRARY, "oneTBB"]),
    (r"pelagic_[\d.]+-.*\.deb", [*LIBRARY, "oneTBB", *COMMAND, *IMAGES]),
    (r"pelagic-[\d.]+-linux-x86_64\.tar\.gz", [*LIBRARY, *COMMAND, *IMAGES]),
    (r"pelagic-[\d.]+-linux-arm64\.tar\.gz", [*LIBRARY, *COMMAND]),
    (r"pelagic-[\d.]+-windows-x86_64\.zip", [*LIBRARY, *COMMAND, *WINDOWS_IMAGES, *WINDOWS]),
    (r"pelagic-.*\.whl|pelagic_blender-.*\.zip", LIBRARY),
    (r"pelagic-[\d.]+\.tgz", [*MODULE, "Emscripten", "musl", "dlmalloc", "libc++"]),
    (r"pelagic-godot[34]-.*\.zip", LIBRARY),
    (r"pelagic-[\d.]+-android\.(aar|zip)", [*LIBRARY, "Android NDK"]),
    (r"com\.pelagic\.ocean-.*\.tgz", LIBRARY),  # and those of its plugins
]
# Builds of build.sh, with patterns of the files made there.
BUILDS = {
    "debian": r".*\.deb",
    "linux": r"pelagic-.*linux-x86_64\.(tar\.gz|zip)",
    "arm64-package": r".*arm64\.tar\.gz|.*aarch64\.whl",
    "windows-package": r".*windows.*\.zip",
    "python": r".*x86_64\.whl|pelagic_blender-.*\.zip",
    "android-arm64-v8a": r"pelagic-.*-android\.(aar|zip)",
    "web-threads": r"pelagic-[\d.]+\.tgz",
}
# Headers of windows_libraries.sh, by the start of their names: the owner that COMPONENTS names.
WINDOWS_HEADERS = {"OpenEXR": "libopenexr-dev", "Imath": "libimath-dev", "png": "source libpng1.6", "libpng": "source libpng1.6",
                   "zstd": "source libzstd"}
# Owners of headers that compile nothing in: those of the systems' compilers, and of libraries that
# are linked at run time or behind another one.
INTERFACES = re.compile(r"libc6-.*|libgcc-.*|libstdc\+\+-.*|libc\+\+-.*|linux-libc-.*|libclang-.*|gcc-mingw-.*|mingw-.*|libegl-dev|libgles-dev|libgl-dev|"
                        r"libglfw3-dev|libzstd-dev|libz-mingw-.*")


def source_versions(source):
    """Versions of the Debian sources that windows_libraries.sh built in a folder with the sources."""
    file = source / "build/windows-libraries/versions"
    versions = dict(line.split() for line in file.read_text().splitlines()) if file.exists() else {}
    for name, debian in (("openexr", "libopenexr-dev"), ("imath", "libimath-dev")):
        if name in versions and versions[name] != version_of(debian, {}):
            sys.exit(f"bill_of_materials.py: {file} has {name} {versions[name]}, expected that of {debian}, {version_of(debian, {})}")
    return versions


def version_of(package, sources):
    if package is not None and package.startswith("source "):
        return sources.get(package.split()[1]) or sys.exit(f"bill_of_materials.py: build/windows-libraries has no {package}")
    if package is None:
        return re.search(r"Pkg\.Revision *= *(\S+)", pathlib.Path(os.environ["PELAGIC_NDK"], "source.properties").read_text())[1]
    shown = subprocess.run(["dpkg-query", "-W", "-f", "${Version}\n", package], capture_output=True, text=True)
    return next(iter(shown.stdout.split()), None) or sys.exit(f"bill_of_materials.py: {package} is not installed")


def identifier(name):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name)


def package(name, version, supplier, declared, concluded, **more):
    return {"SPDXID": identifier(name), "name": name, "versionInfo": version, "supplier": f"Organization: {supplier}",
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": concluded, "licenseDeclared": declared,
            "copyrightText": "NOASSERTION", **more}


def component(name, sources):
    debian, licence, page = COMPONENTS[name]
    version = version_of(debian, sources)
    if debian is None:
        return package(name, version, "Google", licence, licence, homepage=page, sourceInfo="Libraries of the Android NDK")
    kind, _, debian = debian.rpartition(" ")
    locator = f"pkg:deb/debian/{debian}@{version}?{'arch=source&' if kind else ''}distro=bookworm".replace("+", "%2B")
    return package(name, version, "Debian", licence, licence, homepage=page, sourceInfo=f"Code and version of Debian's {(kind + ' package').strip()} {debian}",
                   externalRefs=[{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": locator}])


def all_licences(components):
    """The expression for a file that contains Pelagic and these components."""
    licences = sorted({licence for name in components for licence in COMPONENTS[name][1].split(" AND ")} - {"MIT"})
    return " AND ".join(["MIT", *(f"({licence})" if " OR " in licence else licence for licence in licences)])


def owners_of_headers(build):
    """Debian packages of the headers that the compiler included, without INTERFACES."""
    text = "\n".join(file.read_text() for file in build.rglob("*.d") if file.is_file())
    text = re.sub(r"[^\s:\\]*/linked-headers/", "/usr/include/", text)  # linked_headers.cmake
    headers = {os.path.realpath(name) for name in re.findall(r"/[^\s:\\]+", text)}
    built = {owner for name in headers for start, owner in WINDOWS_HEADERS.items() if f"/windows-libraries/include/{start}" in name}
    headers = sorted(name for name in headers if name.startswith("/usr/"))
    found = subprocess.run(["dpkg-query", "-S", *headers], capture_output=True, text=True, check=True).stdout
    owners = built | {owner.split(":")[0] for line in found.splitlines() for owner in line.partition(": ")[0].split(", ")}
    return {owner for owner in owners if not INTERFACES.fullmatch(owner)}


def check_builds(source, contents):
    """Compares the components of files, by their names, with what each build included."""
    for folder, pattern in BUILDS.items():
        listed = {COMPONENTS[name][0] for file, names in contents.items() if re.fullmatch(pattern, file) for name in names}
        if listed:
            listed = {name for name in listed if name and not INTERFACES.fullmatch(name)}
            included = owners_of_headers(source / "build" / folder)
            for text, names in (("includes headers of", included - listed), ("includes no header of", listed - included)):
                if names:
                    sys.exit(f"bill_of_materials.py: build/{folder} {text} {', '.join(sorted(names))}, unlike its list of components")


def main():
    dist, source = map(pathlib.Path, sys.argv[1:])
    notice = (SOURCE / "NOTICE").read_text()
    if missing := [name for name in COMPONENTS if name not in notice]:
        sys.exit(f"bill_of_materials.py: NOTICE lacks {', '.join(missing)}")
    version = subprocess.run([SOURCE / "packaging/version.sh"], capture_output=True, text=True, check=True).stdout.strip()
    packages, relationships, contents = [], [], {}
    for file in sorted(dist.iterdir()):
        found = next((list(components) for pattern, components in CONTENTS if re.fullmatch(pattern, file.name)), None)
        if found is None:
            sys.exit(f"bill_of_materials.py: {file.name} is in no list of components")
        if file.name.startswith("com.pelagic.ocean-"):
            plugins = {name.split("/")[2] for name in artefact.contents(file) if name.startswith("package/Plugins/")}
            found += (WINDOWS if "Windows" in plugins else []) + (["Android NDK"] if "Android" in plugins else [])
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        packages.append(package(file.name, version, "The Pelagic authors", "MIT", all_licences(found), packageFileName=file.name,
                                checksums=[{"algorithm": "SHA256", "checksumValue": digest}]))
        relationships.append(("SPDXRef-DOCUMENT", "DESCRIBES", identifier(file.name)))
        relationships += [(identifier(file.name), "CONTAINS", identifier(name)) for name in found]
        contents[file.name] = found
    check_builds(source, contents)
    used = set().union(*contents.values())
    sources = source_versions(source)
    packages += [component(name, sources) for name in COMPONENTS if name in used]
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
