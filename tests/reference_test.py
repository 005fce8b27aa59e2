#!/usr/bin/env python3
"""Builds the API reference and checks that every function of the C and C++ interface has a comment,
and that the functions of the C interface are grouped by object. Destructors, copies and moves need
no comment.

usage: reference_test.py CMAKE BUILD_FOLDER
"""
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

cmake, build = sys.argv[1:]
done = subprocess.run([cmake, "--build", build, "--target", "docs"], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
if done.returncode != 0 or "warning:" in done.stdout:
    sys.exit(done.stdout)


def is_special(name, arguments):
    own = name.rsplit("::", 1)[-1]
    return own.startswith("~") or own == "operator=" or "&&" in arguments or arguments.endswith(("=delete", "=default"))


documented, missing = set(), set()
folder = pathlib.Path(build, "reference/xml")
for file in folder.glob("*.xml"):
    for member in ElementTree.parse(file).iter("memberdef"):
        name, arguments = member.findtext("qualifiedname") or member.findtext("name"), member.findtext("argsstring") or ""
        if member.get("kind") != "function" or member.get("prot") == "private" or is_special(name, arguments):
            continue
        text = "".join("".join(member.find(part).itertext()) for part in ("briefdescription", "detaileddescription"))
        location = member.find("location")
        entry = f"{location.get('file')}:{location.get('line')}: {name}{arguments}"
        (documented if text.strip() else missing).add(entry if not text.strip() else name)
for name in ("pelagic_ocean_create", "pelagic_ocean_query", "pelagic::Ocean::schedule", "pelagic::SurfaceQuery::sample"):
    assert name in documented, f"the reference lacks {name}"
assert len(documented) > 300, f"the reference has {len(documented)} functions only"

# The pages have an index of functions, whose links lead to a page with that anchor.
html = folder.parent / "html"
assert (html / "index.html").exists()
for index, name in (("globals_func.html", "pelagic_ocean_create"), ("globals_func.html", "pelagic_ocean_query"), ("namespacemembers_func.html", "hash_of"),
                    ("namespacemembers_func.html", "make_default_executor"), ("functions_func_s.html", "schedule")):
    text = (html / index).read_text() if (html / index).exists() else ""
    text += "".join(file.read_text() for file in html.glob(index.replace(".html", "_?.html")))
    found = re.search(rf'>{name}\(\)(?:&#160;:|:|</a>).*?href="([^"#]+)#(\w+)"', text)
    assert found, f"{index} lacks {name}"
    assert f'id="{found[2]}"' in (html / found[1]).read_text(), f"{found[1]} lacks {name}"

# Each function that the shared library exports is in one group of the C interface, that of its object.
GROUPS_OF_OBJECTS = {"sea": "The sea", "executor": "Executors", "dynamic_waves": "Dynamic waves", "input": "Wave inputs",
                     "exact_water": "Exact water", "hull": "Hulls",
                     "bodies": "Floating bodies"}
exported = (pathlib.Path(__file__).parent / "abi/pelagic.symbols").read_text().split()
groups = dict(re.findall(r'href="(group__c\w*\.html)"[^>]*>([^<]+)</a>', (html / "modules.html").read_text()))
headings = {title: re.findall(r"</span>(pelagic_\w+)\(\)</h2>", (html / page).read_text()) for page, title in groups.items()}
for name in exported:
    found = [title for title, functions in headings.items() if name in functions]
    assert len(found) == 1, f"{name} is in the groups {found}, expected one"
    for name_part, title in GROUPS_OF_OBJECTS.items():
        assert found == [title] or not name.startswith(f"pelagic_{name_part}_"), f"{name} is in {found[0]}, expected {title}"
print(f"{len(documented)} functions are documented; C functions are in {len(groups)} groups")
if missing:
    sys.exit("no comment:\n" + "\n".join(sorted(missing)))
