"""Panels of the sidebar."""
import bpy

from . import library, sea_object


class Section:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Pelagic"

    def prepare(self):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = True
        return self.layout


class OfOcean(Section):
    bl_parent_id = "PELAGIC_PT_ocean"

    @classmethod
    def poll(cls, context):
        return is_ocean(context.object)


def is_ocean(object):
    return object is not None and object.pelagic.is_ocean and not library.problem


class PELAGIC_MT_presets(bpy.types.Menu):
    bl_label = "Presets"

    def draw(self, context):
        for name in library.pelagic.presets:
            self.layout.operator("pelagic.preset", text=title(name)).preset = name


class PELAGIC_PT_ocean(Section, bpy.types.Panel):
    bl_label = "Ocean"

    def draw(self, context):
        layout = self.layout
        if library.problem:
            layout.label(text=library.problem, icon="ERROR")
            return
        layout.operator("pelagic.add_ocean", text="Add Ocean", icon="MOD_OCEAN")
        if not is_ocean(context.object):
            return
        settings = context.object.pelagic
        layout.menu("PELAGIC_MT_presets", text=title(settings.preset))
        if settings.error:
            layout.label(text=settings.error, icon="ERROR")


def draw_settings(layout, settings, panel):
    """Draws the settings of a panel that have an effect on the sea."""
    sea = library.pelagic.preset(settings.preset)
    for setting in sea_object.SETTINGS:
        if setting.panel == panel and setting.is_of(sea):
            layout.prop(settings, setting.name)


class PELAGIC_PT_waves(OfOcean, bpy.types.Panel):
    bl_label = "Waves"

    def draw(self, context):
        layout, settings = self.prepare(), context.object.pelagic
        draw_settings(layout, settings, "waves")


class OfSpectrum(OfOcean):
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        object = context.object
        return is_ocean(object) and sea_object.has_spectrum(library.pelagic.preset(object.pelagic.preset))


class PELAGIC_PT_swell(OfSpectrum, bpy.types.Panel):
    bl_label = "Swell"

    def draw(self, context):
        draw_settings(self.prepare(), context.object.pelagic, "swell")


class PELAGIC_PT_systems(OfSpectrum, bpy.types.Panel):
    bl_label = "Wave Systems"

    def draw(self, context):
        layout, systems = self.prepare(), context.object.pelagic.systems
        for index, system in enumerate(systems):
            box = layout.box()
            for setting in sea_object.SYSTEM_SETTINGS:
                box.prop(system, setting.name)
            box.operator("pelagic.remove_system", icon="REMOVE").index = index
        layout.operator("pelagic.add_system", icon="ADD")


class PELAGIC_PT_spectrum(OfOcean, bpy.types.Panel):
    bl_label = "Spectrum and Cascades"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        for panel in ("spectrum", "cascades"):
            draw_settings(self.prepare(), context.object.pelagic, panel)


class PELAGIC_PT_mesh(OfOcean, bpy.types.Panel):
    bl_label = "Mesh"

    def draw(self, context):
        for name in ("size", "resolution", "place", "foam", "velocity"):
            self.prepare().prop(context.object.pelagic, name)


class PELAGIC_PT_time(OfOcean, bpy.types.Panel):
    bl_label = "Time"

    def draw(self, context):
        for name in ("time_offset", "speed", "first_frame"):
            self.prepare().prop(context.object.pelagic, name)


class PELAGIC_PT_dynamic_waves(OfOcean, bpy.types.Panel):
    bl_label = "Dynamic Waves"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.prepare(), context.object.pelagic
        layout.prop(settings, "sources")
        layout.prop(settings, "source_mode")
        layout.operator("pelagic.record")
        for name in ("events", "rain", "rain_radius", "rain_depth", "waves_side", "waves_resolution"):
            layout.prop(settings, name)


class PELAGIC_PT_shore(OfOcean, bpy.types.Panel):
    bl_label = "Shore"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.prepare().prop(context.object.pelagic, "floor")


class PELAGIC_PT_bake(OfOcean, bpy.types.Panel):
    bl_label = "Bake"

    def draw(self, context):
        layout, settings = self.prepare(), context.object.pelagic
        for name in ("bake_folder", "bake_start", "bake_end"):
            layout.prop(settings, name)
        layout.operator("pelagic.bake")
        if settings.is_baked:
            layout.label(text="Plays the bake", icon="FILE_CACHE")
            layout.operator("pelagic.go_live")


def title(preset):
    return preset.replace("-", " ").title()


classes = (PELAGIC_MT_presets, PELAGIC_PT_ocean, PELAGIC_PT_waves, PELAGIC_PT_swell, PELAGIC_PT_systems, PELAGIC_PT_spectrum,
           PELAGIC_PT_mesh, PELAGIC_PT_time, PELAGIC_PT_dynamic_waves, PELAGIC_PT_shore, PELAGIC_PT_bake)


def register():
    for each in classes:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(classes):
        bpy.utils.unregister_class(each)
