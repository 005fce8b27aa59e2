"""Settings of an ocean object, saved with the .blend. Lengths, angles, speeds: Blender's units."""
import math

import bpy
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import timeline

# Defaults and ranges are the library's (sim/sea_state.hpp, dynamic_waves.hpp, rain.hpp), which
# checks values again.
full_turn = 2 * math.pi


def changed(settings, context):
    timeline.settings_changed(settings.id_data)


def is_floor(settings, object):
    return object.type == "MESH" and object != settings.id_data and not object.pelagic.is_ocean


class PelagicOcean(bpy.types.PropertyGroup):
    is_ocean: BoolProperty(options={"HIDDEN"})
    error: StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    preset: StringProperty(
        name="Preset", default="moderate", options={"HIDDEN"}, update=changed,
        description="The named sea that was chosen last; it also sets options that have no setting here")

    wind_speed: FloatProperty(
        name="Wind", default=12, min=0.1, max=60, unit="VELOCITY", update=changed,
        description="Mean wind 10 m above the sea")
    wind_direction: FloatProperty(
        name="Blows Towards", min=-full_turn, max=full_turn, subtype="ANGLE", update=changed,
        description="Where the wind blows towards, from +X clockwise seen from above: 90 degrees is -Y")
    fetch: FloatProperty(
        name="Fetch", default=100e3, min=1, max=2e6, subtype="DISTANCE", update=changed,
        description="How far the wind has blown over water; a longer fetch makes longer and higher waves, "
                    "until they are fully developed")
    depth: FloatProperty(
        name="Depth", default=4000, min=0.01, max=11000, subtype="DISTANCE", update=changed,
        description="Depth of the water; waves that feel the ground are slower and lower")
    choppiness: FloatProperty(
        name="Choppiness", default=0.8, min=0, max=1, subtype="FACTOR", update=changed,
        description="How far water moves towards crests: 0 gives round waves, 1 sharp ones")
    spectrum: EnumProperty(
        name="Spectrum", default="jonswap", update=changed, items=(
            ("phillips-paper", "Phillips, VR Ocean", "Scaled as in VR Ocean; one cascade, no swell", 0),
            ("phillips", "Phillips", "In metres", 1),
            ("pierson-moskowitz", "Pierson-Moskowitz", "A fully developed sea; no fetch", 2),
            ("jonswap", "JONSWAP", "A sea that grows with the fetch", 3)))
    spreading: EnumProperty(
        name="Spreading", default="paper", update=changed, items=(
            ("paper", "VR Ocean", "By Alignment", 0),
            ("cosine-2s", "Cosine-2s", "Measured, Longuet-Higgins", 1),
            ("hasselmann", "Hasselmann", "Measured, Hasselmann 1980", 2),
            ("donelan-banner", "Donelan-Banner", "Measured, Donelan 1985 and Banner 1990", 3)))
    wind_alignment: FloatProperty(
        name="Alignment", default=0.5, min=0, max=1, subtype="FACTOR", update=changed,
        description="Of the spreading VR Ocean: 0 sends a third of the energy against the wind, 1 a hundredth")
    short_wave_cutoff: FloatProperty(
        name="Calm Small Waves", min=0, max=1, subtype="FACTOR", update=changed,
        description="0 keeps small waves, 1 removes those below a quarter of the peak's")
    wave_strength: FloatProperty(
        name="Strength", default=1, min=0, max=2, update=changed,
        description="Of an analytic sea: 0 calm, 1 moderate, 2 intense")
    wave_height: FloatProperty(
        name="Wave Height", min=0, max=30, subtype="DISTANCE", update=changed,
        description="Significant height of an analytic sea or a pond; 0: from its other options")
    seed: IntProperty(name="Seed", default=1, min=0, update=changed, description="Which sea of this kind")
    loop_period: FloatProperty(
        name="Loop", default=200, min=0.1, max=86400, unit="TIME_ABSOLUTE", update=changed,
        description="The sea repeats exactly after so many seconds")

    swell_height: FloatProperty(
        name="Height", min=0, max=30, subtype="DISTANCE", update=changed,
        description="Significant height of waves from elsewhere; 0: none")
    swell_period: FloatProperty(
        name="Period", default=12, min=1, max=40, unit="TIME_ABSOLUTE", update=changed,
        description="Seconds at which the swell's spectrum peaks")
    swell_direction: FloatProperty(
        name="Runs Towards", min=-full_turn, max=full_turn, subtype="ANGLE", update=changed,
        description="Where the swell runs towards, from +X clockwise seen from above")
    swell_spread: FloatProperty(
        name="Spread", default=math.radians(15), min=math.radians(1), max=math.radians(80), subtype="ANGLE",
        update=changed, description="Standard deviation of the swell's directions")

    cascades: IntProperty(
        name="Cascades", default=0, min=0, max=4, update=changed,
        description="Bands of wavelengths, each with a periodic square; 0: four, or one if its side is given")
    cascade_resolution: EnumProperty(
        name="Texels", default="0", update=changed,
        description="Along a side of each cascade; more hold shorter waves",
        items=[("0", "Automatic", "128, or 256 where the side is given", 0)] +
              [(str(2 ** k), str(2 ** k), "", 2 ** k) for k in range(4, 12)])
    cascade_side: FloatProperty(
        name="Cascade Side", min=0, max=1e6, subtype="DISTANCE", update=changed,
        description="Side of the only cascade, after which the sea repeats; 0: from the sea")

    size: FloatProperty(
        name="Size", default=100, min=0.01, max=1e5, soft_max=2000, subtype="DISTANCE", update=changed,
        description="Side of the undisplaced mesh")
    resolution: IntProperty(
        name="Resolution", default=256, min=1, max=4096, soft_max=1024, update=changed,
        description="Faces along a side of the mesh")
    place: FloatVectorProperty(
        name="Place", size=2, subtype="XYZ_LENGTH", update=changed,
        description="Position in the sea of the object's origin. An object moved by as much joins its neighbours")

    time_offset: FloatProperty(
        name="Time Offset", unit="TIME_ABSOLUTE", min=-1e6, max=1e6, update=changed,
        description="The sea's time at the first frame, seconds")
    speed: FloatProperty(name="Speed", default=1, min=-100, max=100, update=changed,
                         description="Seconds of the sea per second of film")
    first_frame: IntProperty(name="First Frame", default=1, update=changed,
                             description="The frame that shows the time offset")

    foam: BoolProperty(
        name="Foam", default=True, update=changed,
        description='Foam of breaking water, which lasts 2.8 seconds: point attribute "foam", 0 to 1')
    velocity: BoolProperty(
        name="Velocity", default=False, update=changed,
        description='Point attribute "velocity", metres a second, from which Cycles makes motion blur')

    sources: PointerProperty(
        name="Objects", type=bpy.types.Collection,
        description="Objects that make waves while their bounding box cuts the sea's rest level")
    source_mode: EnumProperty(
        name="Act As", default="pressure", items=(
            ("pressure", "Pressure", "The weight of a floating hull: the volume of the water stays", 0),
            ("relaxation", "Relaxation", "The water takes the shape of the hull: bounded, but it adds volume", 1)))
    events: PointerProperty(
        name="Events", type=bpy.types.Text, update=changed,
        description="CSV text of disturbances, as pelagic query --events reads it; Record Objects writes one")
    rain: FloatProperty(
        name="Rain", default=0, min=0, max=1e4, soft_max=10, update=changed,
        description="Mean number of drops per square metre and second, from First Frame on; 0: none")
    rain_radius: FloatProperty(
        name="Drop Radius", default=0.25, min=0.001, max=625, soft_max=1, subtype="DISTANCE", update=changed,
        description="Radius of a drop's crater, at most a 16th of Wave Side")
    rain_depth: FloatProperty(
        name="Drop Depth", default=0.02, min=-10, max=10, soft_min=0, soft_max=0.2, subtype="DISTANCE",
        update=changed, description="Depth of a drop's crater")
    waves_side: FloatProperty(
        name="Wave Side", default=64, min=1, max=10000, subtype="DISTANCE", update=changed,
        description="Side of the dynamic-wave grid around the object's origin; waves fade towards its edges")
    waves_resolution: EnumProperty(
        name="Wave Texels", default="256", update=changed, description="Along that side; more hold shorter waves",
        items=[(str(2 ** k), str(2 ** k), "", 2 ** k) for k in range(6, 11)])
    floor: PointerProperty(
        name="Floor", type=bpy.types.Object, update=changed, poll=is_floor,
        description="Mesh of the sea floor, which may rise above the water; its modifiers do not count")

    is_baked: BoolProperty(options={"HIDDEN"})
    bake_folder: StringProperty(name="Folder", subtype="DIR_PATH", default="//pelagic_bake/",
                                description="Folder of bakes, which has a folder for each object")
    bake_start: IntProperty(name="Start", default=1, description="First frame that is baked")
    bake_end: IntProperty(name="End", default=250, description="Last frame that is baked")


def register():
    bpy.utils.register_class(PelagicOcean)
    bpy.types.Object.pelagic = PointerProperty(type=PelagicOcean, name="Pelagic")


def unregister():
    del bpy.types.Object.pelagic
    bpy.utils.unregister_class(PelagicOcean)
