"""Updates meshes after a change of the frame, in renders too, after a change of settings, and after
undo, redo and loading."""
import bpy
from bpy.app.handlers import persistent

from . import sea_object


def follow(scene, depsgraph=None):
    if sea_object.is_quiet:
        return
    used = set()
    for object in scene.objects:
        if sea_object.is_live(object):
            # In a render only its evaluated copy has the values of keyed settings.
            keyed = object.evaluated_get(depsgraph).pelagic if depsgraph else object.pelagic
            used |= sea_object.update(object, scene, keyed)
    sea_object.keep(scene, used)


def settings_changed(object):
    if sea_object.is_quiet or not sea_object.is_live(object):
        return
    if object.data.users - object.data.use_fake_user > 1:
        object.data = object.data.copy()  # a linked duplicate that gets its own sea
    scenes = [each for each in (bpy.context.scene, *bpy.data.scenes) if each and object.name in each.objects]
    if scenes:
        sea_object.update(object, scenes[0], object.pelagic)
        sea_object.keep(scenes[0], sea_object.keys_in(scenes[0]))


@persistent
def frame_changed(scene, depsgraph=None):
    follow(scene, depsgraph)


@persistent
def file_changed(*_):
    for scene in bpy.data.scenes:
        follow(scene)


handlers = ((bpy.app.handlers.frame_change_post, frame_changed),
            (bpy.app.handlers.load_post, file_changed),
            (bpy.app.handlers.undo_post, file_changed),
            (bpy.app.handlers.redo_post, file_changed))


def register():
    for called, handler in handlers:
        called.append(handler)


def unregister():
    for called, handler in handlers:
        called.remove(handler)
    sea_object.forget_all()
