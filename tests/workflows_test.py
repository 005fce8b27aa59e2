#!/usr/bin/env python3
"""The workflows of GitHub test every part of test.sh: each part of the gate and of `night` is in a
matrix, and each preset that a workflow names exists.

usage: workflows_test.py SOURCE_FOLDER
"""
import json
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
presets = json.loads((source / "CMakePresets.json").read_text())["workflowPresets"]
tiers = {}
for preset in presets:
    tiers.setdefault(preset["displayName"].partition(":")[0], set()).add(preset["name"])
findings = []
for file, tier in (("test.yml", "gate"), ("nightly.yml", "night")):
    text = (source / ".github/workflows" / file).read_text()
    parts = set(re.search(r"part: \[(.*)\]", text)[1].split(", "))
    findings += [f"{file}: {part} is in one of matrix and {tier} only" for part in sorted(parts ^ tiers[tier])]
for file in sorted((source / ".github/workflows").glob("*.yml")):
    text = file.read_text()
    findings += [f"{file.name}: there is no preset {name}" for name in re.findall(r"--preset (\S+)", text) if not any(preset["name"] == name for preset in presets)]
    findings += [f"{file.name}: there is no {name}" for name in re.findall(r"run: \./(\S+)", text) if not (source / name).exists()]
sys.exit("\n".join(findings) or 0)
