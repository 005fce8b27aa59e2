"""The panel in Blender's window on a virtual display: it draws for all kinds of seas and invalid
options; Escape stops a bake, and the next one continues. Leaves an image of the window.

usage: blender -b -P window_test.py -- PELAGIC FOLDER"""
import os
import subprocess
import sys
from pathlib import Path

import bpy

folder = sys.argv[-1]
here = Path(__file__).resolve().parent
display = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1280x900x24"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
try:
    number = display.stdout.readline().strip()
    answer = subprocess.run([bpy.app.binary_path, "--enable-event-simulate", "--window-geometry", "0", "0", "1280", "900", "--python-exit-code", "1",
                             "-P", str(here / "window_steps.py"), "--", folder], text=True, capture_output=True, timeout=500,
                            env=dict(os.environ, DISPLAY=":" + number, LIBGL_ALWAYS_SOFTWARE="1"))
finally:
    display.kill()
    display.wait()
output = answer.stdout + answer.stderr
assert "window_steps passed" in answer.stdout and "Traceback" not in output and "rna_uiItemR" not in output, output
print("window_test passed")
