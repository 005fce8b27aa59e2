# Renders docs/images/blender.jpg with Cycles: the scene of docs/users/blender.md, with the add-on
# installed as documented there. Run in the clone:
#
#   mkdir -p out
#   blender -b --python-exit-code 1 -P docs/images/blender.py -- docs/images/blender.jpg
import re
import sys

import bpy

page = open("docs/users/blender.md").read()
exec(re.search(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL).group(1))
sea.resolution = 1400
scene.cycles.samples, scene.render.resolution_percentage = 128, 100
scene.render.image_settings.file_format = "JPEG"
scene.render.image_settings.quality = 88
scene.render.filepath = sys.argv[-1]
bpy.ops.render.render(write_still=True)
