"""usage: blender -b -P install_addon.py -- ZIP"""
import sys

import bpy

bpy.ops.preferences.addon_install(filepath=sys.argv[-1])
bpy.ops.preferences.addon_enable(module="pelagic_ocean")
bpy.ops.wm.save_userpref()
