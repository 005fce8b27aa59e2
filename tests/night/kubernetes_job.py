"""Reads a Kubernetes Job without Kubernetes: prints it as JSON, or runs its container's command for
each index.

usage: kubernetes_job.py json FILE
       kubernetes_job.py run FILE FOLDER    FOLDER replaces the mounted volume
"""
import json
import os
import subprocess
import sys

import yaml

action, file, *folder = sys.argv[1:]
with open(file) as text:
    job = yaml.safe_load(text)
if action == "json":
    print(json.dumps(job))
    sys.exit()

spec = job["spec"]
container = spec["template"]["spec"]["containers"][0]
mount = container["volumeMounts"][0]["mountPath"]
command = [word.replace(mount + "/", folder[0] + "/") for word in container["command"]]
for index in range(spec.get("completions", 1)):
    subprocess.run(command, check=True, env=os.environ | {"JOB_COMPLETION_INDEX": str(index)})
