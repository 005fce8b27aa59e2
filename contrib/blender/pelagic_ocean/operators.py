"""Operators: Add Ocean, presets, recordings, bakes."""
import bpy
from bpy.props import IntProperty, StringProperty

from . import bake, library, material, recording, sea_object, timeline


class PELAGIC_OT_add_ocean(bpy.types.Operator):
    """Add a sea that follows the timeline"""
    bl_idname = "pelagic.add_ocean"
    bl_label = "Ocean (Pelagic)"
    bl_options = {"REGISTER", "UNDO"}

    preset: StringProperty(name="Preset", default="moderate")

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and not library.problem

    def execute(self, context):
        if self.preset not in library.pelagic.presets:
            names = ", ".join(library.pelagic.presets)
            self.report({"ERROR"}, f"Preset {self.preset}: must be one of {names}")
            return {"CANCELLED"}
        mesh = bpy.data.meshes.new("Ocean")
        mesh.materials.append(material.water())
        ocean = bpy.data.objects.new("Ocean", mesh)
        ocean.location = context.scene.cursor.location
        context.collection.objects.link(ocean)
        with sea_object.quiet():
            sea_object.take_preset(ocean.pelagic, self.preset)
            ocean.pelagic.bake_start, ocean.pelagic.bake_end = context.scene.frame_start, context.scene.frame_end
            ocean.pelagic.is_ocean = True
        sea_object.update(ocean, context.scene, ocean.pelagic)
        if ocean.pelagic.error:
            self.report({"ERROR"}, ocean.pelagic.error)
        for selected in context.selected_objects:
            selected.select_set(False)
        ocean.select_set(True)
        context.view_layer.objects.active = ocean
        return {"FINISHED"}


class OnOcean:
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.pelagic.is_ocean


class PELAGIC_OT_preset(OnOcean, bpy.types.Operator):
    """Set waves, swell and cascades to those of a named sea; size, time, foam and seed stay"""
    bl_idname = "pelagic.preset"
    bl_label = "Preset"

    preset: StringProperty(name="Preset")

    def execute(self, context):
        if self.preset not in library.pelagic.presets:
            names = ", ".join(library.pelagic.presets)
            self.report({"ERROR"}, f"Preset {self.preset}: must be one of {names}")
            return {"CANCELLED"}
        settings = context.object.pelagic
        with sea_object.quiet():
            sea_object.take_preset(settings, self.preset)
        settings.preset = self.preset  # updates the mesh once
        return {"FINISHED"}


class PELAGIC_OT_add_system(OnOcean, bpy.types.Operator):
    """Add a wave system to the sea"""
    bl_idname = "pelagic.add_system"
    bl_label = "Add System"

    def execute(self, context):
        settings = context.object.pelagic
        settings.systems.add().height = 1  # updates the mesh
        return {"FINISHED"}


class PELAGIC_OT_remove_system(OnOcean, bpy.types.Operator):
    """Remove this wave system from the sea"""
    bl_idname = "pelagic.remove_system"
    bl_label = "Remove System"

    index: IntProperty(name="Index", min=0)

    def execute(self, context):
        object = context.object
        object.pelagic.systems.remove(self.index)
        timeline.settings_changed(object)
        return {"FINISHED"}


class PELAGIC_OT_record(OnOcean, bpy.types.Operator):
    """Step through the scene's frames and write the motion of the objects as events"""
    bl_idname = "pelagic.record"
    bl_label = "Record Objects"

    def execute(self, context):
        object, scene = context.object, context.scene
        frame, subframe = scene.frame_current, scene.frame_subframe

        def depsgraph_of(frame):
            scene.frame_set(frame)
            return context.evaluated_depsgraph_get()

        try:
            with sea_object.quiet():
                text = recording.record(object, scene, depsgraph_of)
                name = f"{object.name} events.csv"
                block = bpy.data.texts.get(name) or bpy.data.texts.new(name)
                block.from_string(text)
                object.pelagic.events = block
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            scene.frame_set(frame, subframe=subframe)
        self.report({"INFO"}, f"Recorded {len(text.splitlines()) - 1} events in the text {name}")
        return {"FINISHED"}


class PELAGIC_OT_bake(OnOcean, bpy.types.Operator):
    """Write the frames to disk and play them from there. Escape stops; the next bake continues"""
    bl_idname = "pelagic.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER"}

    def execute(self, context):
        try:
            for _ in bake.run(context.object, context.scene):
                pass
        except bake.BakeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Baked to {bake.folder_of(context.object)}")
        return {"FINISHED"}

    # In the window, one frame per timer event, so that Blender stays responsive.
    def invoke(self, context, event):
        self.work = bake.run(context.object, context.scene)
        self.timer = context.window_manager.event_timer_add(0.001, window=context.window)
        context.window_manager.progress_begin(0, 1)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.work.close()
            self.report({"INFO"}, "Stopped; the next bake continues from here")
            return self.leave(context, {"CANCELLED"})
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            done, frames = next(self.work)
        except StopIteration:
            return self.leave(context, {"FINISHED"})
        except bake.BakeError as error:
            self.report({"ERROR"}, str(error))
            return self.leave(context, {"CANCELLED"})
        context.window_manager.progress_update(done / frames)
        context.workspace.status_text_set(f"Pelagic bake: {done} of {frames} frames, Escape stops")
        return {"RUNNING_MODAL"}

    def leave(self, context, result):
        context.workspace.status_text_set(None)
        context.window_manager.progress_end()
        context.window_manager.event_timer_remove(self.timer)
        return result


class PELAGIC_OT_go_live(OnOcean, bpy.types.Operator):
    """Let the sea move the mesh again; the files of the bake stay"""
    bl_idname = "pelagic.go_live"
    bl_label = "Back to Live"

    def execute(self, context):
        bake.go_live(context.object)
        sea_object.update(context.object, context.scene, context.object.pelagic)
        return {"FINISHED"}


def add_menu(menu, context):
    menu.layout.operator(PELAGIC_OT_add_ocean.bl_idname, icon="MOD_OCEAN")


classes = (PELAGIC_OT_add_ocean, PELAGIC_OT_preset, PELAGIC_OT_add_system, PELAGIC_OT_remove_system, PELAGIC_OT_record,
           PELAGIC_OT_bake, PELAGIC_OT_go_live)


def register():
    for each in classes:
        bpy.utils.register_class(each)
    bpy.types.VIEW3D_MT_mesh_add.append(add_menu)


def unregister():
    bpy.types.VIEW3D_MT_mesh_add.remove(add_menu)
    for each in reversed(classes):
        bpy.utils.unregister_class(each)
