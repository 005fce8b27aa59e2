# Displays the maps of an export with --patch-size 300 --maps displacement,gradient,foam (one
# cascade), in the folder waves/ beside this file, on a mesh whose vertices a shader displaces. Godot
# has Pelagic's axes: x right, y up, right-handed. Its texture coordinates count from the upper edge,
# like texel rows.
extends Spatial

const PATCHES = 3
var record
var material = ShaderMaterial.new()

# The files are loaded directly, because the maps are numbers and must not be imported as colours.
# Godot 3 converts an EXR to 16-bit floats.
func map(name, filtered):
	var image = Image.new()
	assert(image.load("res://waves/" + name) == OK)
	var texture = ImageTexture.new()
	texture.create_from_image(image, Texture.FLAG_REPEAT | (Texture.FLAG_FILTER if filtered else 0))
	return texture

# Vertex (i, j) has the reference position x = i L/N, z = j L/N and uses the centre of texel (i, j).
func patch(N, L, primitive):
	var places = PoolVector3Array()
	var texels = PoolVector2Array()
	var indices = PoolIntArray()
	for j in range(N + 1):
		for i in range(N + 1):
			places.append(Vector3(i * L / N, 0, j * L / N))
			texels.append(Vector2((i + 0.5) / N, (j + 0.5) / N))
			var a = j * (N + 1) + i
			var b = a + N + 1
			if primitive == Mesh.PRIMITIVE_POINTS:
				indices.append(a)
			elif i < N and j < N:
				for k in [a, a + 1, b, a + 1, b + 1, b]:
					indices.append(k)
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = places
	arrays[Mesh.ARRAY_TEX_UV] = texels
	arrays[Mesh.ARRAY_INDEX] = indices
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(primitive, arrays, [], 0)  # 0: no compression
	return mesh

func _ready():
	var file = File.new()
	file.open("res://waves/sea.json", File.READ)
	record = JSON.parse(file.get_as_text()).result
	var N = int(record["sea"]["resolution"])
	var L = float(record["sea"]["patch_size_m"])
	material.shader = load("res://sea.shader")
	material.set_shader_param("displacement", map("displacement_0000.exr", false))
	material.set_shader_param("gradient", map("gradient_0000.png", true))
	material.set_shader_param("foam", map("foam_0000.png", true))
	var mesh = patch(N, L, Mesh.PRIMITIVE_TRIANGLES)
	for k in range(PATCHES * PATCHES):
		var cascade = MeshInstance.new()
		cascade.mesh = mesh
		cascade.material_override = material
		cascade.translation = Vector3(k % PATCHES * L, 0, k / PATCHES * L)
		cascade.extra_cull_margin = 100
		add_child(cascade)

	var sky = ProceduralSky.new()
	sky.sun_latitude = 25
	sky.sun_longitude = 125
	sky.ground_horizon_color = sky.sky_horizon_color
	sky.ground_bottom_color = sky.sky_horizon_color
	var world = WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_SKY
	world.environment.background_sky = sky
	world.environment.tonemap_mode = Environment.TONE_MAPPER_ACES
	world.environment.tonemap_exposure = 0.4
	add_child(world)
	var sun = DirectionalLight.new()
	sun.rotation_degrees = Vector3(-25, 125, 0)
	add_child(sun)
	var camera = Camera.new()
	camera.far = 5000
	camera.fov = 45
	var highest = float(record["frames"][0]["height_max_m"])
	add_child(camera)
	camera.look_at_from_position(Vector3(0.9 * L, 2 * highest + 2, 2.1 * L), Vector3(1.9 * L, -2 * highest, 1.1 * L), Vector3.UP)
