"""Settings of an ocean object, saved with the .blend. Lengths, angles, speeds: Blender's units."""
import math

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty,
                       PointerProperty, StringProperty)

from . import timeline

# Defaults and ranges are the library's, which checks values again.
full_turn = 2 * math.pi


def changed(settings, context):
    timeline.settings_changed(settings.id_data)


def is_floor(settings, object):
    return object.type == "MESH" and object != settings.id_data and not object.pelagic.is_ocean


class PelagicSystem(bpy.types.PropertyGroup):
    """A wave system of the sea."""
    # generated from schema/wave_system.toml: blender-properties
    spectrum: EnumProperty(
        name="Spectrum", update=changed,
        default="jonswap", items=(
            ("phillips-paper", "phillips-paper", "Scaled as in VR Ocean, without a swell", 0),
            ("phillips", "phillips", "Phillips' shape with a physical height", 1),
            ("pierson-moskowitz", "pierson-moskowitz", "A fully developed sea; no fetch", 2),
            ("jonswap", "jonswap", "A sea that grows with the fetch", 3),
            ("none", "none", "No wind sea: only the swell and systems; the wind still sets roughness, drift, and foam on waves that it can raise", 4)),
        description="Spectrum: jonswap, pierson-moskowitz or phillips")
    spreading: EnumProperty(
        name="Spreading", update=changed,
        default="donelan-banner", items=(
            ("paper", "paper", "VR Ocean, by wind_alignment", 0),
            ("cosine-2s", "cosine-2s", "Measured, Longuet-Higgins et al. 1963", 1),
            ("hasselmann", "hasselmann", "Measured, Hasselmann et al. 1980", 2),
            ("donelan-banner", "donelan-banner", "Measured, Donelan et al. 1985 and Banner 1990", 3)),
        description="Directional spreading, where Spread is 0")
    wind_speed: FloatProperty(
        name="Wind", update=changed,
        default=12, min=0.1, max=60, unit="VELOCITY",
        description="U10 of the wind of the system")
    fetch: FloatProperty(
        name="Fetch", update=changed,
        default=100000, min=1, max=2000000, subtype="DISTANCE",
        description="Distance that it has blown over water (jonswap)")
    height: FloatProperty(
        name="Height", update=changed,
        default=0, min=0, max=30, subtype="DISTANCE",
        description="Significant wave height, Hm0; 0: by the wind and Peak Period")
    peak_period: FloatProperty(
        name="Peak Period", update=changed,
        default=0, min=0, max=40, unit="TIME_ABSOLUTE",
        description="Peak period; 0: by the wind and Height")
    peak_enhancement: FloatProperty(
        name="Peak Enhancement", update=changed,
        default=3.3, min=1, max=10,
        description="Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap)")
    direction: FloatProperty(
        name="Runs Towards", update=changed,
        default=0, min=-6.283185307, max=6.283185307, subtype="ANGLE",
        description="Where the waves run towards, from +X clockwise seen from above")
    spread: FloatProperty(
        name="Spread", update=changed,
        default=0, min=0, max=1.396263402, subtype="ANGLE",
        description="Standard deviation of the directions; 0: by Spreading")
    # end of generated


class PelagicOcean(bpy.types.PropertyGroup):
    is_ocean: BoolProperty(options={"HIDDEN"})
    error: StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    preset: StringProperty(
        name="Preset", default="moderate", options={"HIDDEN"}, update=changed,
        description="The named sea that was chosen last; it also sets options that have no setting here")

    # generated from schema/sea.toml: blender-properties
    spectrum: EnumProperty(
        name="Spectrum", update=changed,
        default="jonswap", items=(
            ("phillips-paper", "phillips-paper", "Scaled as in VR Ocean, without a swell", 0),
            ("phillips", "phillips", "Phillips' shape with a physical height", 1),
            ("pierson-moskowitz", "pierson-moskowitz", "A fully developed sea; no fetch", 2),
            ("jonswap", "jonswap", "A sea that grows with the fetch", 3),
            ("none", "none", "No wind sea: only the swell and systems; the wind still sets roughness, drift, and foam on waves that it can raise", 4)),
        description="Wave spectrum")
    spreading: EnumProperty(
        name="Spreading", update=changed,
        default="donelan-banner", items=(
            ("paper", "paper", "VR Ocean, by Alignment", 0),
            ("cosine-2s", "cosine-2s", "Measured, Longuet-Higgins et al. 1963", 1),
            ("hasselmann", "hasselmann", "Measured, Hasselmann et al. 1980", 2),
            ("donelan-banner", "donelan-banner", "Measured, Donelan et al. 1985 and Banner 1990", 3)),
        description="Directional spreading")
    cascades: IntProperty(
        name="Cascades", update=changed,
        default=0, min=0, max=4,
        description="Number of cascades, each a band of wavelengths; 0: four, or one if Cascade Side is set, the "
                    "resolution is 16 or the model has only one")
    cascade_resolution: EnumProperty(
        name="Texels", update=changed,
        default="0",
        items=[("0", "Automatic", "128, or 256 if Cascade Side is set", 0)] + [(str(n), str(n), "", n) for n in (16, 32, 64, 128, 256, 512, 1024, 2048)],
        description="N, texels along a side of each cascade")
    cascade_side: FloatProperty(
        name="Cascade Side", update=changed,
        default=0, min=0, max=1000000, subtype="DISTANCE",
        description="L, the side of the only cascade, after which the sea repeats; 0: sides derived from the sea")
    wind_speed: FloatProperty(
        name="Wind", update=changed,
        default=12, min=0.1, max=60, unit="VELOCITY",
        description="U10, mean wind speed 10 m above the sea")
    wind_direction: FloatProperty(
        name="Blows Towards", update=changed,
        default=0, min=-6.283185307, max=6.283185307, subtype="ANGLE",
        description="Where the wind blows towards, from +X clockwise seen from above: 90 degrees is -Y")
    fetch: FloatProperty(
        name="Fetch", update=changed,
        default=100000, min=1, max=2000000, subtype="DISTANCE",
        description="Distance that the wind has blown over water (jonswap), of which at most 17,000 U10^2 / g has an "
                    "effect")
    peak_period: FloatProperty(
        name="Peak Period", update=changed,
        default=0, min=0, max=40, unit="TIME_ABSOLUTE",
        description="Peak period of the wind sea (jonswap, pierson-moskowitz); 0: by Wave Height and the wind")
    peak_enhancement: FloatProperty(
        name="Peak Enhancement", update=changed,
        default=3.3, min=1, max=10,
        description="Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap)")
    depth: FloatProperty(
        name="Depth", update=changed,
        default=4000, min=0.01, max=11000, subtype="DISTANCE",
        description="Depth of the water, which slows and lowers long waves")
    choppiness: FloatProperty(
        name="Choppiness", update=changed,
        default=0.8, min=0, max=1, subtype="FACTOR",
        description="Scale of horizontal displacements")
    short_wave_cutoff: FloatProperty(
        name="Calm Small Waves", update=changed,
        default=0, min=0, max=1, subtype="FACTOR",
        description="0 keeps short waves, 1 removes waves shorter than a quarter of the peak wavelength")
    wind_alignment: FloatProperty(
        name="Alignment", update=changed,
        default=0.5, min=0, max=1, subtype="FACTOR",
        description="Alignment of waves with the wind, alpha of equations 6 to 9, for the spreading paper")
    swell_height: FloatProperty(
        name="Height", update=changed,
        default=0, min=0, max=30, subtype="DISTANCE",
        description="Significant wave height of a swell, in addition to the waves of the wind")
    swell_period: FloatProperty(
        name="Period", update=changed,
        default=12, min=1, max=40, unit="TIME_ABSOLUTE",
        description="Peak period of the swell")
    swell_direction: FloatProperty(
        name="Runs Towards", update=changed,
        default=0, min=-6.283185307, max=6.283185307, subtype="ANGLE",
        description="Where the swell runs towards, from +X clockwise seen from above")
    swell_spread: FloatProperty(
        name="Spread", update=changed,
        default=0.2617993878, min=0.01745329252, max=1.396263402, subtype="ANGLE",
        description="Standard deviation of the swell's directions")
    loop_period: FloatProperty(
        name="Loop", update=changed,
        default=3600, min=0.1, max=86400, unit="TIME_ABSOLUTE",
        description="T, the period after which the sea repeats exactly")
    seed: IntProperty(
        name="Seed", update=changed,
        default=1, min=0,
        description="Seed of the random phases and amplitudes")
    wave_strength: FloatProperty(
        name="Strength", update=changed,
        default=1, min=0, max=2,
        description="Strength of analytic waves: 0 calm, 1 moderate, 2 intense, interpolated between")
    wave_height: FloatProperty(
        name="Wave Height", update=changed,
        default=0, min=0, max=30, subtype="DISTANCE",
        description="Significant wave height of the wind sea (jonswap, pierson-moskowitz), of an analytic sea or of "
                    "a pond; 0: from the wind, of analytic waves from Strength, of a pond 0.017 longest_wave_m")
    # end of generated

    systems: CollectionProperty(type=PelagicSystem)

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
    bpy.utils.register_class(PelagicSystem)
    bpy.utils.register_class(PelagicOcean)
    bpy.types.Object.pelagic = PointerProperty(type=PelagicOcean, name="Pelagic")


def unregister():
    del bpy.types.Object.pelagic
    bpy.utils.unregister_class(PelagicOcean)
    bpy.utils.unregister_class(PelagicSystem)
