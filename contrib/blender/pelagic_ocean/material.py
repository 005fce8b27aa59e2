"""Water that Cycles and Eevee both draw: dark and glossy, white where foam is."""
import bpy


live_name = "Pelagic Water"


def water():
    """The material of all live oceans, made once a file; whoever changes it changes it for all of them."""
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

    # Deep water sends back little light, and that is blue-green; its index of refraction is 1.333.
    sea = add("ShaderNodeBsdfPrincipled", 0, 300, Base_Color=(0.003, 0.022, 0.04, 1), Roughness=0.08, IOR=1.333,
              Specular=0.25)
    foam = add("ShaderNodeBsdfDiffuse", 0, -300, Color=(0.8, 0.83, 0.85, 1))
    amount = add("ShaderNodeAttribute", -500, 0)
    amount.name = amount.label = "Foam"
    amount.attribute_name = "foam"
    mix = add("ShaderNodeMixShader", 300, 0)
    links.new(amount.outputs["Fac"], mix.inputs["Fac"])
    links.new(sea.outputs[0], mix.inputs[1])
    links.new(foam.outputs[0], mix.inputs[2])
    out = add("ShaderNodeOutputMaterial", 500, 0)
    links.new(mix.outputs[0], out.inputs["Surface"])
    return material


def baked_water(name, first_picture, first_frame, frames):
    """The same with foam of a sequence of pictures, one a frame, in place of the attribute: it needs no add-on."""
    old = bpy.data.materials.get(name)
    material = water().copy()
    if old:
        old.user_remap(material)
        bpy.data.materials.remove(old)
    material.name = name
    nodes, links = material.node_tree.nodes, material.node_tree.links
    picture = nodes.new("ShaderNodeTexImage")
    picture.name = picture.label = "Baked Foam"
    picture.location = -500, -300
    picture.image = bpy.data.images.load(first_picture)
    picture.image.source = "SEQUENCE" if frames > 1 else "FILE"
    picture.image.colorspace_settings.name = "Non-Color"
    picture.extension = "EXTEND"
    # Pictures are numbered as frames are, and frame_offset is added to 1 at frame_start.
    picture.image_user.frame_start, picture.image_user.frame_offset = first_frame, first_frame - 1
    picture.image_user.frame_duration = frames
    picture.image_user.use_auto_refresh = True
    for node in [node for node in nodes if node.type == "ATTRIBUTE" and node.attribute_name == "foam"]:
        for link in list(node.outputs["Fac"].links):
            links.new(picture.outputs["Color"], link.to_socket)
        nodes.remove(node)
    return material
