# Installs and enables the add-on, as Edit > Preferences > Add-ons > Install does in the window:
#
#   blender -b --python-exit-code 1 -P install.py -- ZIP
import sys

import bpy

bpy.ops.preferences.addon_install(filepath=sys.argv[-1])
bpy.ops.preferences.addon_enable(module="pelagic_ocean")
bpy.ops.wm.save_userpref()
