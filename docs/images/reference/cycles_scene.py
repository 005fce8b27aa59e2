# The sea, its water, the sun and a sky for Cycles, and a path-traced picture of it.
#
# Blender's z is up: (x, y, z) of Pelagic is (x, -z, y) there. Light keeps Pelagic's unit.
import math

import bpy
from mathutils import Matrix, Vector

import facets

sun_radius_rad = 0.00465
water_index = 1.333


def blender(p):
    return Vector((p[0], -p[2], p[1]))


def henyey_greenstein_g(backwards):
    """The asymmetry g for which that part is scattered backwards, by bisection of the phase function's integral."""
    low, high = 1e-6, 1 - 1e-9
    for _ in range(60):
        g = 0.5 * (low + high)
        part = (1 - g) / (2 * g) * ((1 + g) / math.sqrt(1 + g * g) - 1)
        low, high = (g, high) if part > backwards else (low, g)
    return low


def new_scene(samples, width, height, threads):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.samples = samples
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    # Nothing is cut off or blurred: light through the water is what is compared.
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.max_bounces = cycles.transmission_bounces = cycles.volume_bounces = 256
    cycles.glossy_bounces = 16
    return scene


def add_world(scene, panorama):
    """Without a panorama it is black."""
    world = scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    if panorama is None:
        world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
        return
    nodes, links = world.node_tree.nodes, world.node_tree.links
    # Its middle column is +x and azimuths grow to the right, towards Pelagic's +z: Blender's own convention, so unturned.
    picture = nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(str(panorama))
    picture.image.colorspace_settings.name = "Non-Color"
    links.new(picture.outputs["Color"], nodes["Background"].inputs["Color"])


def add_sun(scene, direction, irradiance):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.angle = 2 * sun_radius_rad
    strength = max(irradiance)
    sun.energy = strength
    sun.color = [part / strength for part in irradiance]
    # Only sampled from where light is scattered: a path that meets the disc by chance would count it twice.
    sun.cycles.use_multiple_importance_sampling = False
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_mode = "QUATERNION"
    lamp.rotation_quaternion = blender(direction).to_track_quat("Z", "Y")
    scene.collection.objects.link(lamp)


def add_fresnel_of_sun(nodes, links, geometry, sun):
    """Of the facet that mirrors the sun to the eye; the output that holds it."""
    half, facet = nodes.new("ShaderNodeVectorMath"), nodes.new("ShaderNodeVectorMath")
    half.operation, facet.operation = "ADD", "NORMALIZE"
    half.inputs[1].default_value = blender(sun)
    links.new(geometry.outputs["Incoming"], half.inputs[0])
    links.new(half.outputs["Vector"], facet.inputs[0])
    fresnel = nodes.new("ShaderNodeFresnel")
    fresnel.inputs["IOR"].default_value = water_index
    links.new(facet.outputs["Vector"], fresnel.inputs["Normal"])
    return fresnel.outputs["Fac"]


def add_fresnel_of_sky(nodes, links, geometry, roughness, slopes):
    """The mean of the facets that are seen, by tables for two roughnesses. \\param slopes  mean squares, of the sea's calmest ring and of all"""
    cosine, root = nodes.new("ShaderNodeVectorMath"), nodes.new("ShaderNodeMath")
    cosine.operation, root.operation = "DOT_PRODUCT", "SQRT"
    links.new(geometry.outputs["Incoming"], cosine.inputs[0])
    links.new(geometry.outputs["Normal"], cosine.inputs[1])
    links.new(cosine.outputs["Value"], root.inputs[0])
    between = nodes.new("ShaderNodeMapRange")
    between.inputs["From Min"].default_value, between.inputs["From Max"].default_value = slopes
    links.new(roughness, between.inputs["Value"])
    mixed = nodes.new("ShaderNodeMixRGB")
    links.new(between.outputs["Result"], mixed.inputs["Fac"])
    for square, socket in zip(slopes, ("Color1", "Color2")):
        table = nodes.new("ShaderNodeFloatCurve")
        curve = table.mapping.curves[0]
        while len(curve.points) > 2:
            curve.points.remove(curve.points[1])
        knots = 20
        for k in range(knots + 1):
            at = k / knots
            value = facets.mean_fresnel(at * at, square)
            point = curve.points[0] if k == 0 else curve.points[-1] if k == knots else curve.points.new(at, value)
            point.location = at, value
        table.mapping.update()
        links.new(root.outputs["Value"], table.inputs["Value"])
        links.new(table.outputs["Value"], mixed.inputs[socket])
    return mixed.outputs["Color"]


def add_surface(nodes, links, roughness, sun, slopes):
    """What the surface does to light of the sun or, without `sun`, of the sky; the closure's output.

    A mirror and a lens with Beckmann's distribution, which is Gauss' of slopes, as Cox and Munk measured them. Cycles 3.4 takes the
    mean normal's Fresnel for a rough glass, three times too much at grazing angles; so the parts are mixed here. The sun and the sky
    have pictures of their own because they need different parts.
    """
    mirror, lens, mixed = (nodes.new(kind) for kind in
                           ("ShaderNodeBsdfGlossy", "ShaderNodeBsdfRefraction", "ShaderNodeMixShader"))
    root = nodes.new("ShaderNodeMath")  # alpha^2 is the mean square slope, and Blender's roughness the root of alpha
    root.operation = "POWER"
    root.inputs[1].default_value = 0.25
    links.new(roughness, root.inputs[0])
    for node in (mirror, lens):
        node.distribution = "BECKMANN"
        node.inputs["Color"].default_value = (1, 1, 1, 1)
        links.new(root.outputs["Value"], node.inputs["Roughness"])
    lens.inputs["IOR"].default_value = water_index
    geometry = nodes.new("ShaderNodeNewGeometry")
    above = (add_fresnel_of_sun(nodes, links, geometry, sun) if sun else
             add_fresnel_of_sky(nodes, links, geometry, roughness, slopes))
    below = nodes.new("ShaderNodeFresnel")  # where light leaves the water
    below.inputs["IOR"].default_value = water_index
    chosen = nodes.new("ShaderNodeMixRGB")
    links.new(geometry.outputs["Backfacing"], chosen.inputs["Fac"])
    links.new(above, chosen.inputs["Color1"])
    links.new(below.outputs["Fac"], chosen.inputs["Color2"])
    links.new(chosen.outputs["Color"], mixed.inputs["Fac"])
    links.new(lens.outputs["BSDF"], mixed.inputs[1])
    links.new(mirror.outputs["BSDF"], mixed.inputs[2])
    return mixed.outputs["Shader"]


def water_material(optics, sun, slopes):
    """A rough surface over a medium. \\param optics  "water" of `pelagic render --json`

    Light that is scattered forwards goes on nearly as if it were not, so only what goes backwards matters, and its shape: real
    water's is nearly even from 120 to 180 degrees (Petzold 1972), while Henyey and Greenstein's curve with the g of real water's
    forward peak has two thirds of its mean there. With g so that 0.4 goes backwards it is 0.9 of even.
    """
    material = bpy.data.materials.new("water")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    left = nodes.new("ShaderNodeAttribute")
    left.attribute_name = "roughness"
    links.new(add_surface(nodes, links, left.outputs["Fac"], sun, slopes), out.inputs["Surface"])

    def medium(kind, coefficients, complement):
        node = nodes.new(kind)
        most = max(coefficients)
        parts = [c / most for c in coefficients]
        node.inputs["Color"].default_value = [1 - p if complement else p for p in parts] + [1]
        node.inputs["Density"].default_value = most
        return node

    backwards = 0.4
    absorbed = medium("ShaderNodeVolumeAbsorption", optics["absorption_per_m"], True)
    # One kind of scattering only: two in one medium come out several times too bright in Cycles 3.4.
    scattered = medium("ShaderNodeVolumeScatter", [bb / backwards for bb in optics["backscattering_per_m"]], False)
    scattered.inputs["Anisotropy"].default_value = henyey_greenstein_g(backwards)
    both = nodes.new("ShaderNodeAddShader")
    links.new(absorbed.outputs["Volume"], both.inputs[0])
    links.new(scattered.outputs["Volume"], both.inputs[1])
    links.new(both.outputs["Shader"], out.inputs["Volume"])
    material.cycles.homogeneous_volume = True
    return material


def add_sea(scene, sea, optics, sun):
    vertices, quads = len(sea.places) // 3, len(sea.quads) // 4
    mesh = bpy.data.meshes.new("sea")
    mesh.vertices.add(vertices)
    mesh.vertices.foreach_set("co", sea.places)
    mesh.loops.add(4 * quads)
    mesh.loops.foreach_set("vertex_index", sea.quads)
    mesh.polygons.add(quads)
    mesh.polygons.foreach_set("loop_start", range(0, 4 * quads, 4))
    mesh.polygons.foreach_set("loop_total", [4] * quads)
    mesh.attributes.new("roughness", "FLOAT", "POINT").data.foreach_set("value", sea.roughness)
    mesh.update(calc_edges=True)
    mesh.validate()
    mesh.materials.append(water_material(optics, sun, (min(sea.roughness), max(sea.roughness) + 1e-6)))
    thing = bpy.data.objects.new("sea", mesh)
    thing.rotation_euler.x = math.radians(90)
    scene.collection.objects.link(thing)


def add_camera(scene, place, target, fov_deg):
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle = math.radians(fov_deg)
    camera.data.clip_start, camera.data.clip_end = 0.1, 1e7
    camera.location = blender(place)
    forward = blender(target) - blender(place)
    # Straight down, +x is at the top of the picture (quadtree/camera.hpp).
    up = Vector((0, 0, 1)) if forward.xy.length > 1e-6 * forward.length else Vector((1, 0, 0))
    back = -forward.normalized()
    right = up.cross(back).normalized()
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = Matrix((right, back.cross(right), back)).transposed().to_quaternion()
    scene.collection.objects.link(camera)
    scene.camera = camera


def render(scene, file):
    scene.render.filepath = str(file)
    bpy.ops.render.render(write_still=True)
