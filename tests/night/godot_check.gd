# After the recipe has rendered an image, renders each vertex of its patch into a pixel of its own,
# coloured by its displacement.
extends "res://sea.gd"

func drawn():
	VisualServer.force_draw()
	yield(get_tree(), "idle_frame")

func _process(_delta):
	set_process(false)
	for k in range(3):
		yield(get_tree(), "idle_frame")
	var image = get_viewport().get_texture().get_data()
	image.flip_y()
	image.convert(Image.FORMAT_RGB8)
	assert(image.save_png(OS.get_environment("IMAGE")) == OK)

	var N = int(record["sea"]["resolution"])
	var L = float(record["sea"]["patch_size_m"])
	var view = Viewport.new()
	view.size = Vector2(N + 1, N + 1)
	view.own_world = true
	view.hdr = true
	view.keep_3d_linear = true
	view.render_target_update_mode = Viewport.UPDATE_ALWAYS
	add_child(view)
	var camera = Camera.new()
	camera.projection = Camera.PROJECTION_ORTHOGONAL
	camera.size = (N + 1) * L / N
	camera.far = 200
	view.add_child(camera)
	camera.look_at_from_position(Vector3(L / 2, 100, L / 2), Vector3(L / 2, 0, L / 2), Vector3(0, 0, -1))
	var shader = Shader.new()
	var vertex = load("res://sea.shader").code
	vertex = vertex.substr(vertex.find("VERTEX +="))
	vertex = vertex.substr(0, vertex.find("}"))
	shader.code = "shader_type spatial; render_mode unshaded, cull_disabled; uniform sampler2D displacement; varying vec3 moved;\n" \
		+ "void vertex() { vec3 rest = VERTEX; " + vertex + " moved = VERTEX - rest; VERTEX = rest; POINT_SIZE = 1.0; }\n" \
		+ "void fragment() { ALBEDO = moved; }"
	var points = MeshInstance.new()
	points.mesh = patch(N, L, Mesh.PRIMITIVE_POINTS)
	points.material_override = ShaderMaterial.new()
	points.material_override.shader = shader
	points.extra_cull_margin = 100
	view.add_child(points)

	var places = File.new()
	places.open(OS.get_environment("PLACES"), File.WRITE)
	for frame in record["frames"]:
		points.material_override.set_shader_param("displacement", map(frame["files"][0]["name"], false))
		for k in range(3):
			yield(get_tree(), "idle_frame")
		var pixels = view.get_texture().get_data()
		pixels.flip_y()
		pixels.lock()
		for j in range(N + 1):
			for i in range(N + 1):
				var d = pixels.get_pixel(i, j)
				places.store_line("%.9f %.9f %.9f" % [i * L / N + d.r, d.g, j * L / N + d.b])
	places.close()
	get_tree().quit()
