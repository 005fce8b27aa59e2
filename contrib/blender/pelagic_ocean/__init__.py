"""Pelagic in Blender: seas that follow the timeline, the same bits as everywhere else."""
bl_info = {
    "name": "Pelagic Ocean",
    "author": "The authors of Pelagic",
    "version": (0, 1, 0),
    "blender": (3, 3, 0),
    "location": "3D View > Sidebar > Pelagic; Add > Mesh > Ocean (Pelagic)",
    "description": "An open sea that follows the timeline: vertices, foam, velocities, bakes",
    "category": "Object",
}

from . import operators, panel, settings, timeline

parts = (settings, operators, panel, timeline)


def register():
    for part in parts:
        part.register()


def unregister():
    for part in reversed(parts):
        part.unregister()
