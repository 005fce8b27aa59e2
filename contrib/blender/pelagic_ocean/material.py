"""Water materials for Cycles and Eevee: dark and glossy, white where there is foam."""
import bpy


live_name = "Pelagic Water"


def water():
    """Returns the material that all live oceans of a file share."""
    return bpy.data.materials.get(live_name) or make(live_name)


def make(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    nodes, links = tree.nodes, tree.links

    def add(kind, x, y, **inputs):
        node = nodes.new(kind)
        node.location = x, y
        for socket, value in inputs.items():
            node.inputs[socket.replace("_", " ")].default_value = value
        return node

    # Deep water reflects little light, most of it blue-green. Its index of refraction is 1.333.
    sea = add("ShaderNodeBsdfPrincipled", 0, 300, Base_Color=(0.003, 0.022, 0.04, 1), Roughness=0.08, IOR=1.333,
              Specular=0.25)
    foam = add("ShaderNodeBsdfDiffuse", 0, -300, Color=(0.85, 0.88, 0.9, 1))
    amount = add("ShaderNodeAttribute", -900, 0)
    amount.name = amount.label = "Foam"
    amount.attribute_name = "foam"
    cover = lace(add, links, amount.outputs["Fac"])
    mix = add("ShaderNodeMixShader", 300, 0)
    links.new(cover, mix.inputs["Fac"])
    links.new(sea.outputs[0], mix.inputs[1])
    links.new(foam.outputs[0], mix.inputs[2])
    out = add("ShaderNodeOutputMaterial", 500, 0)
    links.new(mix.outputs[0], out.inputs["Surface"])
    return material


def lace(add, links, amount):
    """Cuts holes into the foam that are finer than a mesh. They move with the water: the noise is a
    function of the attribute `rest_position`, metres."""
    rest = add("ShaderNodeAttribute", -1100, -300)
    rest.attribute_name = "rest_position"
    noise = add("ShaderNodeTexNoise", -900, -300, Scale=1.7, Detail=9.0, Roughness=0.68)
    links.new(rest.outputs["Vector"], noise.inputs["Vector"])
    holes = add("ShaderNodeMapRange", -700, -300, From_Min=0.4, From_Max=0.62, To_Min=0.25, To_Max=1.5)
    links.new(noise.outputs["Fac"], holes.inputs["Value"])
    product = add("ShaderNodeMath", -500, -200)
    product.operation = "MULTIPLY"
    links.new(amount, product.inputs[0])
    links.new(holes.outputs["Result"], product.inputs[1])
    cover = add("ShaderNodeMapRange", -300, -200, From_Min=0.12, From_Max=0.75)
    cover.interpolation_type = "SMOOTHSTEP"
    links.new(product.outputs[0], cover.inputs["Value"])
    return cover.outputs["Result"]


def baked_water(name, first_image, first_frame, frames):
    """Returns a copy of the material that reads foam from an image sequence, one image per frame,
    instead of the attribute."""
    old = bpy.data.materials.get(name)
    material = water().copy()
    if old:
        old.user_remap(material)
        bpy.data.materials.remove(old)
    material.name = name
    nodes, links = material.node_tree.nodes, material.node_tree.links
    image = nodes.new("ShaderNodeTexImage")
    image.name = image.label = "Baked Foam"
    image.location = -900, 0
    image.image = bpy.data.images.load(first_image)
    image.image.source = "SEQUENCE" if frames > 1 else "FILE"
    image.image.colorspace_settings.name = "Non-Color"
    image.extension = "EXTEND"
    # Images have the numbers of their frames; at frame_start Blender shows image 1 + frame_offset.
    image.image_user.frame_start, image.image_user.frame_offset = first_frame, first_frame - 1
    image.image_user.frame_duration = frames
    image.image_user.use_auto_refresh = True
    for node in [node for node in nodes if node.type == "ATTRIBUTE" and node.attribute_name == "foam"]:
        for link in list(node.outputs["Fac"].links):
            links.new(image.outputs["Color"], link.to_socket)
        nodes.remove(node)
    return material
