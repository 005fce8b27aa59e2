# Renders the sea to images of half floats for drawn_test.py. Instead of a colour, a pixel has its
# distance or the components of its normal; the rest of the shader is that of the node.
extends SceneTree

const CODED = """
void fragment() {
	float distance_m = length(place);
	ALBEDO = vec3(floor(distance_m), fract(distance_m), 4.0);
}
"""
const WALL = """
shader_type spatial;
render_mode unshaded, cull_disabled;
void fragment() { ALBEDO = vec3(0.0, 0.0, 8.0); }
"""
var cases = JSON.parse(OS.get_environment("CASES")).result
var view
var camera
var ocean
var wall
var number = -1
var frame = 0

func shader_material(code):
	var material = ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = code
	return material

func _init():
	view = Viewport.new()
	view.size = Vector2(cases["width"], cases["height"])
	view.own_world = true
	view.hdr = true
	view.keep_3d_linear = true
	view.render_target_v_flip = true
	view.render_target_update_mode = Viewport.UPDATE_ALWAYS
	root.add_child(view)
	camera = Camera.new()
	camera.near = 0.2
	camera.far = 30000
	camera.fov = cases["fov"]
	view.add_child(camera)
	wall = MeshInstance.new()
	wall.mesh = QuadMesh.new()
	wall.mesh.size = Vector2(40, 4)
	wall.material_override = shader_material(WALL)
	view.add_child(wall)

func refused(why):
	print("SAYS refused ", why)

func floats_in(name):
	var file = File.new()
	file.open("%s/%s" % [OS.get_environment("IMAGES"), name], File.READ)
	var numbers = PoolRealArray()
	while file.get_position() < file.get_len():
		numbers.append(file.get_float())
	file.close()
	return numbers

# Drops a stone in the second tick, and computes the ticks until the image's time.
func play(ticks, center, stone):
	ocean.set_center(Vector3(center[0], 0, center[1]))
	for tick in range(ticks[0], ticks[1] + 1):
		if tick == ticks[0] + 1:
			ocean.add_impulse(stone)
		ocean.time_s = tick / 60.0
		ocean.hash()

func next_case():
	number += 1
	frame = 0
	if ocean:
		ocean.free()
	if number == cases["cases"].size():
		quit()
		return
	var case = cases["cases"][number]
	var from = case["from"]
	var to = case["to"]
	camera.look_at_from_position(Vector3(from[0], from[1], from[2]), Vector3(to[0], to[1], to[2]), Vector3.UP)
	wall.visible = case.has("wall")
	if wall.visible:
		wall.translation = Vector3(case["wall"][0], case["wall"][1], case["wall"][2])
	ocean = load("res://addons/pelagic/ocean.gdns").new()
	ocean.connect("refused", self, "refused")
	ocean.playing = false
	ocean.foam = false
	for property in case["values"]:
		ocean.set(property, case["values"][property])
	if case.has("heights"):
		ocean.shore_heights_m = floats_in(case["heights"])
	if case.has("stone"):
		play(case["ticks"], case["center"], case["stone"])
	var code = load("res://addons/pelagic/sea.shader").code
	if case.has("normals"):
		var colour = "ALBEDO = mix(water, foam_colour.rgb, foam);"
		assert(colour in code)
		code = code.replace(colour, "ALBEDO = 0.5 + 0.5 * normal;")
	else:
		code = code.substr(0, code.find("void fragment()")) + CODED
	ocean.material = shader_material(code.replace("skip_vertex_transform", "skip_vertex_transform, unshaded"))
	view.add_child(ocean)

func _idle(_seconds):
	if number < 0 or frame == 2:
		if number >= 0:
			var image = view.get_texture().get_data()
			assert(image.get_format() == Image.FORMAT_RGBAH)
			var file = File.new()
			file.open("%s/%d.rgbah" % [OS.get_environment("IMAGES"), number], File.WRITE)
			file.store_buffer(image.get_data())
			file.close()
			print("SAYS case %d %s" % [number, camera.global_transform.basis.z])
		next_case()
	frame += 1
