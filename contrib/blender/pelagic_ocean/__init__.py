"""Pelagic Ocean: ocean meshes that follow Blender's timeline."""
bl_info = {
    "name": "Pelagic Ocean",
    "author": "The authors of Pelagic",
    "version": (1, 0, 0),
    "blender": (3, 3, 0),
    "location": "3D View > Sidebar > Pelagic; Add > Mesh > Ocean (Pelagic)",
    "description": "Ocean meshes that follow the timeline: waves, foam, dynamic waves, shorelines, bakes",
    "category": "Object",
}

from . import operators, panel, settings, timeline

modules = (settings, operators, panel, timeline)


def register():
    for module in modules:
        module.register()


def unregister():
    for module in reversed(modules):
        module.unregister()
