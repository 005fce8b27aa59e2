# Builds the sea, its water, the sun and a sky for Cycles, and path-traces an image.
#
# Blender's z is up: (x, y, z) of Pelagic is (x, -z, y) there. Light keeps Pelagic's unit.
import math

import bpy
from mathutils import Matrix, Vector

sun_radius_rad = 0.00465
water_index = 1.333


def blender(p):
    return Vector((p[0], -p[2], p[1]))


def henyey_greenstein_g(backwards):
    """Returns the asymmetry g for which the fraction `backwards` is scattered backwards, by
    bisection of the phase function's integral."""
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
    # No clamping or blurring: light through the water is compared.
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.max_bounces = cycles.transmission_bounces = cycles.volume_bounces = 256
    cycles.glossy_bounces = 16
    return scene


def add_world(scene, panorama):
    """Adds a world; it is black without a panorama."""
    world = scene.world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    if panorama is None:
        world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
        return
    nodes, links = world.node_tree.nodes, world.node_tree.links
    # The middle column of the panorama is +x and azimuths increase to the right, towards Pelagic's
    # +z. This is Blender's convention, so it is not rotated.
    image = nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(str(panorama))
    image.image.colorspace_settings.name = "Non-Color"
    links.new(image.outputs["Color"], nodes["Background"].inputs["Color"])


def add_sun(scene, direction, irradiance):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.angle = 2 * sun_radius_rad
    strength = max(irradiance)
    sun.energy = strength
    sun.color = [part / strength for part in irradiance]
    # Sampled only where light is scattered: paths that hit the sun's disc by chance would count it
    # twice.
    sun.cycles.use_multiple_importance_sampling = False
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_mode = "QUATERNION"
    lamp.rotation_quaternion = blender(direction).to_track_quat("Z", "Y")
    scene.collection.objects.link(lamp)


class Nodes:
    """Creates nodes of a material, by the quantity that they compute; arguments are sockets or
    numbers."""

    def __init__(self, tree):
        self.nodes, self.links = tree.nodes, tree.links

    def add(self, kind, **settings):
        node = self.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def give(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, *values):
        node = self.add("ShaderNodeMath", operation=operation)
        for socket, value in zip(node.inputs, values):
            self.give(socket, value)
        return node.outputs["Value"]

    def vector(self, operation, *values):
        node = self.add("ShaderNodeVectorMath", operation=operation)
        for socket, value in zip(node.inputs, values):
            self.give(socket, value)
        return node.outputs["Value" if operation == "DOT_PRODUCT" else "Vector"]

    def fresnel(self, normal=None):
        node = self.add("ShaderNodeFresnel")
        node.inputs["IOR"].default_value = water_index
        if normal:
            self.give(node.inputs["Normal"], normal)
        return node.outputs["Fac"]

    def bsdf(self, kind, roughness, distribution, colour=(1, 1, 1, 1), normal=None):
        node = self.add(kind, distribution=distribution)
        self.give(node.inputs["Roughness"], roughness)
        self.give(node.inputs["Color"], colour)
        if normal:
            self.give(node.inputs["Normal"], normal)
        if "IOR" in node.inputs:
            node.inputs["IOR"].default_value = water_index
        return node.outputs["BSDF"]

    def mixed(self, part, first, second):
        node = self.add("ShaderNodeMixShader")
        for socket, value in zip(node.inputs, (part, first, second)):
            self.give(socket, value)
        return node.outputs["Shader"]

    def sum(self, first, second):
        node = self.add("ShaderNodeAddShader")
        for socket, value in zip(node.inputs, (first, second)):
            self.give(socket, value)
        return node.outputs["Shader"]


def rough_glass(nodes, alpha_root, part):
    """Returns reflection and refraction with Beckmann's distribution, which is the Gaussian of
    slopes. \\param part  reflected fraction"""
    mirror, lens = (nodes.bsdf(kind, alpha_root, "BECKMANN") for kind in ("ShaderNodeBsdfGlossy", "ShaderNodeBsdfRefraction"))
    return nodes.mixed(part, lens, mirror)


def surface_in_sunlight(nodes, geometry, alpha_root, sun):
    """The Fresnel reflectance is that of the facet that reflects the sun to the eye."""
    facet = nodes.vector("NORMALIZE", nodes.vector("ADD", geometry.outputs["Incoming"], tuple(blender(sun))))
    return rough_glass(nodes, alpha_root, nodes.fresnel(facet))


def area_seen(nodes, cosine, mean_square):
    """Returns the visible area of facets with Gaussian slopes, relative to that of their mean
    plane: mu P(a) + s t p(a), a = mu / (s t), with the Gaussian p and P."""
    sine = nodes.math("SQRT", nodes.math("MAXIMUM", nodes.math("SUBTRACT", 1.0, nodes.math("MULTIPLY", cosine, cosine)), 1e-8))
    spread = nodes.math("MULTIPLY", nodes.math("SQRT", nodes.math("MULTIPLY", mean_square, 0.5)), sine)
    a = nodes.math("MINIMUM", nodes.math("DIVIDE", cosine, spread), 8.0)
    a2 = nodes.math("MULTIPLY", a, a)
    density = nodes.math("MULTIPLY", nodes.math("EXPONENT", nodes.math("MULTIPLY", a2, -0.5)), 1 / math.sqrt(2 * math.pi))
    # The distribution within 1.4e-4: Page 1977.
    odd = nodes.math("ADD", nodes.math("MULTIPLY", a, -1.5976),
                     nodes.math("MULTIPLY", nodes.math("MULTIPLY", a, a2), -0.070566))
    distribution = nodes.math("DIVIDE", 1.0, nodes.math("ADD", 1.0, nodes.math("EXPONENT", odd)))
    return nodes.math("ADD", nodes.math("MULTIPLY", cosine, distribution), nodes.math("MULTIPLY", spread, density))


def doubled(nodes, value):
    node = nodes.add("ShaderNodeCombineXYZ")
    for socket in node.inputs:
        nodes.give(socket, nodes.math("MULTIPLY", value, 2.0))
    return node.outputs["Vector"]


def masked_area(nodes, cosine, mean_square):
    """Returns Smith's function for Gaussian slopes (Walter et al. 2007, equation 15), times the
    cosine."""
    sine2 = nodes.math("SUBTRACT", 1.0, nodes.math("MULTIPLY", cosine, cosine))
    across = nodes.math("SQRT", nodes.math("MULTIPLY", mean_square, nodes.math("MAXIMUM", sine2, 1e-6)))
    # there it is 0.1 % of the cosine
    a = nodes.math("MINIMUM", nodes.math("DIVIDE", cosine, across), 1.6)
    above = nodes.math("MULTIPLY_ADD", a, nodes.math("MULTIPLY_ADD", a, 0.396, -1.259), 1.0)
    below = nodes.math("MULTIPLY_ADD", a, 2.181, 3.535)
    return nodes.math("MULTIPLY", across, nodes.math("DIVIDE", above, below))


def sky_share(nodes, eye, towards, mean_square):
    """Returns the fraction of sky in a facet's reflection: waves that the mesh does not resolve
    hide the rest (Smith, Heitz 2014, equation 99), and reflect 0.3 of the sky in turn. Cosines are
    relative to the mesh's normal; nothing comes from below the mesh."""
    eye, up = nodes.math("MAXIMUM", eye, 1e-3), nodes.math("MAXIMUM", towards, 1e-4)
    seen = nodes.math("MULTIPLY", nodes.math("ADD", eye, masked_area(nodes, eye, mean_square)), up)
    hidden = nodes.math("MULTIPLY", masked_area(nodes, up, mean_square), eye)
    lit = nodes.math("DIVIDE", seen, nodes.math("ADD", seen, hidden))
    return nodes.math("MULTIPLY", nodes.math("GREATER_THAN", towards, 0.0), nodes.math("MULTIPLY_ADD", lit, 0.7, 0.3))


def ripple_slopes(nodes, ripples):
    """Returns the slopes of ripples at a point, and their mean square around it.
    \\param ripples  `image` of slopes, `side_m` and `mean_square`"""
    gust = nodes.add("ShaderNodeAttribute", attribute_name="gust").outputs["Fac"]
    place = nodes.add("ShaderNodeAttribute", attribute_name="rest").outputs["Vector"]
    axes = nodes.add("ShaderNodeSeparateXYZ")
    nodes.give(axes.inputs[0], place)
    at = nodes.add("ShaderNodeCombineXYZ")
    for axis, name in (("X", "X"), ("Y", "Z")):
        nodes.give(at.inputs[axis], nodes.math("DIVIDE", axes.outputs[name], ripples.side_m))
    texture = nodes.add("ShaderNodeTexImage", image=ripples.image, interpolation="Cubic", extension="REPEAT")
    nodes.give(texture.inputs["Vector"], at.outputs["Vector"])
    scaled = nodes.add("ShaderNodeVectorMath", operation="SCALE")
    nodes.give(scaled.inputs[0], texture.outputs["Color"])
    nodes.give(scaled.inputs["Scale"], nodes.math("SQRT", gust))
    return scaled.outputs[0], nodes.math("MULTIPLY", gust, ripples.mean_square)


def surface_in_skylight(nodes, geometry, mean_square, below=None, slopes_of_ripples=None, all_square=None):
    """Each sample hits one smooth facet, whose slopes are drawn from the Gaussian distribution and
    whose weight is its visible area. So the Fresnel reflectance and the direction of the light are
    those of the same facet.

    \\param below  returns the closure of light from below of a transmitted fraction; if None, the
                  light is refracted into the mesh
    \\param slopes_of_ripples, all_square  if given, ripples lean each facet; their mean square is
                  part of `all_square`, with `mean_square`"""
    all_square = all_square or mean_square
    dice = nodes.add("ShaderNodeTexWhiteNoise", noise_dimensions="3D")
    nodes.give(dice.inputs["Vector"], geometry.outputs["Position"])
    parts = nodes.add("ShaderNodeSeparateXYZ")
    nodes.give(parts.inputs[0], dice.outputs["Color"])
    # Box and Muller 1958; both slopes together have the variance `mean_square`.
    far = nodes.math("SQRT", nodes.math("MULTIPLY", mean_square, nodes.math(
        "MULTIPLY", -1.0, nodes.math("LOGARITHM", nodes.math("MAXIMUM", parts.outputs["X"], 1e-7), math.e))))
    angle = nodes.math("MULTIPLY", parts.outputs["Y"], 2 * math.pi)
    slopes = nodes.add("ShaderNodeCombineXYZ")
    nodes.give(slopes.inputs["X"], nodes.math("MULTIPLY", far, nodes.math("COSINE", angle)))
    nodes.give(slopes.inputs["Y"], nodes.math("MULTIPLY", far, nodes.math("SINE", angle)))
    eye, normal = geometry.outputs["Incoming"], geometry.outputs["Normal"]
    leaning = nodes.vector("ADD", normal, slopes.outputs["Vector"])
    if slopes_of_ripples:
        leaning = nodes.vector("ADD", leaning, slopes_of_ripples)
    facet = nodes.vector("NORMALIZE", leaning)
    weight = nodes.math("DIVIDE", nodes.math("MAXIMUM", nodes.vector("DOT_PRODUCT", eye, leaning), 0.0),
                        area_seen(nodes, nodes.vector("DOT_PRODUCT", eye, normal), all_square))
    mirrored = nodes.math("MULTIPLY", weight, nodes.fresnel(facet))
    towards = nodes.vector("SUBTRACT", nodes.vector("MULTIPLY", facet, doubled(nodes, nodes.vector("DOT_PRODUCT", eye, facet))), eye)
    share = sky_share(nodes, nodes.vector("DOT_PRODUCT", eye, normal), nodes.vector("DOT_PRODUCT", towards, normal), all_square)
    through = nodes.math("SUBTRACT", weight, mirrored)
    mirrored = nodes.math("MULTIPLY", mirrored, share)
    mirror = nodes.bsdf("ShaderNodeBsdfGlossy", 0.0, "SHARP", mirrored, facet)
    lens = below(through) if below else nodes.bsdf("ShaderNodeBsdfRefraction", 0.0, "SHARP", through, facet)
    return nodes.sum(mirror, lens)


def add_surface(tree, sun):
    """Returns the closure output of the surface in the light of the sun or, without `sun`, of the
    sky.

    Slopes are Gaussian, as measured by Cox and Munk. For rough glass Cycles 3.4 uses the Fresnel
    reflectance of the mean normal, three times too much at grazing angles. So reflection and
    refraction are combined here, for the sun and for the sky in one image each.
    """
    nodes = Nodes(tree)
    mean_square = nodes.add("ShaderNodeAttribute", attribute_name="roughness").outputs["Fac"]
    # alpha^2 is the mean square slope, Blender's roughness the root of alpha
    alpha_root = nodes.math("POWER", mean_square, 0.25)
    geometry = nodes.add("ShaderNodeNewGeometry")
    above = (surface_in_sunlight(nodes, geometry, alpha_root, sun) if sun else
             surface_in_skylight(nodes, geometry, mean_square))
    below = rough_glass(nodes, alpha_root, nodes.fresnel())
    return nodes.mixed(geometry.outputs["Backfacing"], above, below)


def water_material(optics, sun):
    """Returns a rough surface over a medium. \\param optics  "water" of `pelagic render --json`

    Forward scattering hardly changes the light, so only backward scattering matters, and its shape.
    That of real water is nearly uniform from 120 to 180 degrees (Petzold 1972), while the phase
    function of Henyey and Greenstein with the g of real water's forward peak has two thirds of its
    mean there. With g such that 0.4 is scattered backwards it is 0.9 of uniform.
    """
    material = bpy.data.materials.new("water")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    links.new(add_surface(material.node_tree, sun), out.inputs["Surface"])

    def medium(kind, coefficients, complement):
        node = nodes.new(kind)
        most = max(coefficients)
        parts = [c / most for c in coefficients]
        node.inputs["Color"].default_value = [1 - p if complement else p for p in parts] + [1]
        node.inputs["Density"].default_value = most
        return node

    backwards = 0.4
    absorbed = medium("ShaderNodeVolumeAbsorption", optics["absorption_per_m"], True)
    # A single scattering closure: in Cycles 3.4 two in one medium are several times too bright.
    scattered = medium("ShaderNodeVolumeScatter", [bb / backwards for bb in optics["backscattering_per_m"]], False)
    scattered.inputs["Anisotropy"].default_value = henyey_greenstein_g(backwards)
    both = nodes.new("ShaderNodeAddShader")
    links.new(absorbed.outputs["Volume"], both.inputs[0])
    links.new(scattered.outputs["Volume"], both.inputs[1])
    links.new(both.outputs["Shader"], out.inputs["Volume"])
    material.cycles.homogeneous_volume = True
    return material


def surface_with_ripples_in_sunlight(nodes, geometry, mean_square, sun, slopes_of_ripples, all_square):
    """The light of a rippled facet counts by its visible area."""
    eye, normal = geometry.outputs["Incoming"], geometry.outputs["Normal"]
    leaning = nodes.vector("ADD", normal, slopes_of_ripples)
    weight = nodes.math("DIVIDE", nodes.math("MAXIMUM", nodes.vector("DOT_PRODUCT", eye, leaning), 0.0),
                        area_seen(nodes, nodes.vector("DOT_PRODUCT", eye, normal), all_square))
    middle = nodes.vector("NORMALIZE", nodes.vector("ADD", eye, tuple(blender(sun))))
    colour = nodes.math("MULTIPLY", weight, nodes.fresnel(middle))
    return nodes.bsdf("ShaderNodeBsdfGlossy", nodes.math("POWER", mean_square, 0.25), "BECKMANN", colour,
                      nodes.vector("NORMALIZE", leaning))


def opaque_water_material(optics, light, sun, ripples):
    """Returns a rough surface over water whose upwelling radiance is uniform and in closed form
    (Gordon 1973): 0.57 / pi bb / (a + bb) E / (s + v), with the cosines s and v of light and view
    in the water, and E just below the surface.

    \\param light    "sky" of `pelagic render --json`
    \\param ripples  `image` of slopes, `side_m` and `mean_square`"""
    material = bpy.data.materials.new("water")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    nodes = Nodes(tree)
    mean_square = nodes.add("ShaderNodeAttribute", attribute_name="roughness").outputs["Fac"]
    geometry = nodes.add("ShaderNodeNewGeometry")
    high = max(light["sun_direction"][1], 0)
    sun_below, sky_below = math.sqrt(1 - (1 - high * high) / water_index ** 2), 0.86
    seen = 0.75  # of rays 12 to 30 degrees below the horizon
    radiance = [0.57 / (math.pi * water_index ** 2) * bb / (a + bb) *
                (0.97 * high * e / (sun_below + seen) + 0.934 * sky / (sky_below + seen))
                for a, bb, e, sky in zip(optics["absorption_per_m"], optics["backscattering_per_m"],
                                         light["sun_irradiance"], light["sky_irradiance"])]

    def upwelling(transmitted):
        node = nodes.add("ShaderNodeEmission")
        node.inputs["Color"].default_value = radiance + [1]
        nodes.give(node.inputs["Strength"], transmitted)
        return node.outputs["Emission"]

    slopes, of_ripples = ripple_slopes(nodes, ripples)
    all_square = nodes.math("ADD", mean_square, of_ripples)
    if sun:
        surface = surface_with_ripples_in_sunlight(nodes, geometry, mean_square, sun, slopes, all_square)
    else:
        surface = surface_in_skylight(nodes, geometry, mean_square, upwelling, slopes, all_square)
    tree.links.new(surface, nodes.add("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def add_sea(scene, sea, material, smooth=False):
    """\\param smooth  interpolate normals between vertices"""
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
    if hasattr(sea, "rest"):
        mesh.attributes.new("rest", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", sea.rest)
        mesh.attributes.new("gust", "FLOAT", "POINT").data.foreach_set("value", sea.gust)
    mesh.polygons.foreach_set("use_smooth", [smooth] * quads)
    mesh.update(calc_edges=True)
    mesh.validate()
    mesh.materials.append(material)
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
    # Straight down, +x is at the top of the image (quadtree/camera.hpp).
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
