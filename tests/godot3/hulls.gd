# Prints states and errors of PelagicHull for hulls_test.py.
extends "hull_scene.gd"

func vectors(numbers):
	var all = PoolVector3Array()
	for i in range(0, numbers.size(), 3):
		all.append(Vector3(numbers[i], numbers[i + 1], numbers[i + 2]))
	return all

# A surface of indexed triangles, and one of separate triangles.
func mesh_of(surfaces, primitive = Mesh.PRIMITIVE_TRIANGLES):
	var mesh = ArrayMesh.new()
	for surface in surfaces:
		var arrays = []
		arrays.resize(Mesh.ARRAY_MAX)
		arrays[Mesh.ARRAY_VERTEX] = vectors(surface["vertices"])
		if surface["numbers"].size() > 0:
			arrays[Mesh.ARRAY_INDEX] = PoolIntArray(surface["numbers"])
		mesh.add_surface_from_arrays(primitive, arrays)
	return mesh

func pose_of(numbers):
	var v = vectors(numbers)
	return Transform(Basis(v[0], v[1], v[2]), v[3])

func numbers_of(pose):
	var text = []
	for v in [pose.basis.x, pose.basis.y, pose.basis.z, pose.origin]:
		for axis in range(3):
			text.append("%.9f" % v[axis])
	return PoolStringArray(text).join(" ")

func add_hull(values, pose = Transform()):
	hull = made("hull", values)
	hull.playing = false
	hull.transform = pose
	ocean.add_child(hull)

# A launch at another sea level, with the mass that was set last.
func test_level():
	ocean = made("ocean", given["still_sea"])
	root.add_child(ocean)
	var size = Vector3(given["box"][0], given["box"][1], given["box"][2])
	var mesh = CubeMesh.new()
	mesh.size = size
	add_hull({"mesh": mesh, "mass_kg": 9}, Transform(Basis(), Vector3(5, 3, -2)))
	hull.step(STEP_S)
	hull.mass_kg = given["mass_of_box"]
	ocean.sea_level_m = 7
	hull.launch()
	say("level %.9f" % (size.y / 2 - hull.translation.y + 7))
	ocean.free()

# Of two boats with wakes in equal oceans, one is shifted. Prints how far it and the water are from the other.
func test_origin():
	var oceans = []
	var hulls = []
	for i in range(2):
		ocean = made("ocean", given["origin_sea"])
		root.add_child(ocean)
		add_hull({"mesh": mesh_of(given["boat"]), "mass_kg": given["mass_kg"], "force_n": Vector3(900, 0, -250)}, pose_of(given["pose"]))
		oceans.append(ocean)
		hulls.append(hull)
	var to = Vector3(2048, 0, -512)
	for step in range(40):
		for i in range(2):
			oceans[i].time_s = step / 60.0
			hulls[i].step(STEP_S)
		if step == 20:
			oceans[1].set_origin(to.x, to.z)
			hulls[1].shift(-to.x, -to.z)
			say("origin_at_once %.9f" % (oceans[1].height_at(Vector3(7, 0, 3) - to) - oceans[0].height_at(Vector3(7, 0, 3))))
	say("origin_boat %.9f" % hulls[1].translation.distance_to(hulls[0].translation - to))
	say("origin_went %.9f" % hulls[0].translation.distance_to(pose_of(given["pose"]).origin))
	say("origin_water %.9f" % (oceans[1].height_at(Vector3(7, 0, 3) - to) - oceans[0].height_at(Vector3(7, 0, 3))))
	say("origin_hash %s" % str(oceans[0].hash() == oceans[1].hash()))
	refusals = []
	say("origin_null %s" % str(ocean.set_origin(2e8, 0) == null))
	say("origin_refused %s" % JSON.print(refusals))
	refusals = []
	for node in oceans:
		node.free()

func test_states():
	ocean = made("ocean", given["sea"])
	root.add_child(ocean)
	add_hull({"mesh": mesh_of(given["boat"]), "mass_kg": given["mass_kg"], "roll_damping": 0.125}, pose_of(given["pose"]))
	hull.centre_of_mass_m = vectors(given["centre_of_mass_m"])[0]
	hull.inertia_kgm2 = vectors(given["inertia_kgm2"])[0]
	hull.force_n = vectors(given["force_n"])[0]
	for case in ["launched", "restored"]:
		var file = written(case)
		if case == "restored":
			hull.restore_state(bytes_in("start"))
			say("inputs %s %s %s" % [hull.force_n, hull.torque_nm, hull.wind_mps])
		for step in range(given["steps"]):
			ocean.time_s = step / 60.0
			if step == given["steps"] / 2:
				hull.force_n = Vector3(-500, 0, 250)
				hull.torque_nm = Vector3(0, 64, 0)
				hull.wind_mps = Vector3(0, 0, 8)
			hull.step(STEP_S)
			file.store_buffer(hull.save_state())
			if step % 20 == 19:
				say("pose %s %d %s" % [case, step, numbers_of(hull.global_transform)])
		file.close()
	hull.global_transform = pose_of(given["turned_pose"])
	hull.launch()
	var file = written("turned")
	file.store_buffer(hull.save_state())
	file.close()
	say("no_errors %s" % JSON.print(refusals))

func value_of(given_value):
	if given_value is Dictionary:
		match given_value["is"]:
			"mesh": return mesh_of(given_value["surfaces"])
			"nan":
				var arrays = mesh_of(given_value["surfaces"]).surface_get_arrays(0)
				arrays[Mesh.ARRAY_VERTEX][0].y = NAN
				var mesh = ArrayMesh.new()
				mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
				return mesh
			"lines": return mesh_of(given_value["surfaces"], Mesh.PRIMITIVE_LINES)
			"new": return ClassDB.instance(given_value["class"])
			"vector": return vectors(given_value["numbers"])[0]
			"number": return float(given_value["text"]) if given_value["text"] != "nan" else NAN
	return given_value

func test_refusals():
	hull.translation = Vector3(1, 0, 1)
	for step in range(30):
		hull.step(STEP_S)
	var before = hull.save_state()
	var mesh = hull.mesh
	var pose = hull.transform
	for wrong in given["refused"]:
		refusals = []
		if wrong[0] == "property":
			hull.set(wrong[1], value_of(wrong[2]))
		else:
			var arguments = []
			for argument in wrong[2]:
				arguments.append(value_of(argument))
			say("answer %s" % str(hull.callv(wrong[1], arguments) == null))
		say("refused %s" % JSON.print(refusals))
	refusals = []
	hull.restore_state(before.subarray(0, before.size() - 2))
	hull.restore_state(bytes_in("two"))
	hull.restore_state(bytes_in("second"))
	say("restore %s" % JSON.print(refusals))
	say("unchanged %s" % str(hull.save_state() == before and hull.mesh == mesh and hull.transform == pose))
	var other = made("hull", {"playing": false})
	refusals = []
	other.step(STEP_S)
	ocean.add_child(other)
	other.step(STEP_S)
	other.mesh = CubeMesh.new()
	other.scale = Vector3(2, 1, 1)
	other.step(STEP_S)
	other.scale = Vector3(1, 1, 1)
	for path in ["../boat", "", "."]:
		other.ocean = path
		other.step(STEP_S)
	other.ocean = NodePath("..")
	ocean.depth = false
	other.step(STEP_S)
	ocean.depth = true
	say("unusable %s" % JSON.print(refusals))
	say("untouched %s" % str(other.transform == Transform()))
	refusals = []
	other.step(STEP_S)
	say("usable %s %s" % [JSON.print(refusals), str(other.transform != Transform())])
	other.mesh = null
	other.launch()
	say("emptied %s" % JSON.print(refusals))
	other.free()

# The engine's round meshes have seams of vertices that differ by rounding.
func test_round_meshes():
	refusals = []
	for name in ["CylinderMesh", "CapsuleMesh"]:
		hull = made("hull", {"mesh": ClassDB.instance(name)})
		say("volume %s %.9f" % [name, hull.info()["volume_m3"]])
		hull.free()
	say("round %s" % JSON.print(refusals))

# A changed property keeps pose and velocity of the mesh.
func test_changes():
	var pose = hull.transform
	hull.centre_of_mass_m = hull.centre_of_mass_m + Vector3(0.25, 0, 0)
	hull.state()
	hull.restore_state(hull.save_state())
	say("kept %.9f %.9f" % [pose.origin.distance_to(hull.transform.origin), pose.basis.x.distance_to(hull.transform.basis.x)])
	hull.centre_of_mass_m = null
	hull.inertia_kgm2 = null
	say("derived %s %s" % [str(hull.centre_of_mass_m == null), str(hull.info()["centre_of_mass_m"])])

# The engine's objects may be freed in any order.
func test_freed():
	refusals = []
	var state = hull.save_state()
	var mesh = weakref(hull.mesh)
	ocean.remove_child(hull)
	hull.step(STEP_S)
	root.add_child(hull)
	hull.ocean = "../sea"
	ocean.name = "sea"
	hull.step(STEP_S)
	var with_ocean = hull.save_state()
	ocean.free()
	hull.step(STEP_S)
	hull.step(STEP_S)
	say("freed %s %s" % [JSON.print(refusals), str(state != with_ocean and hull.save_state() == with_ocean)])
	ocean = made("ocean", given["sea"])
	ocean.name = "sea"
	root.add_child(ocean)
	refusals = []
	hull.step(STEP_S)
	say("again %s %s" % [JSON.print(refusals), str(hull.save_state() != with_ocean)])
	hull.mesh = CubeMesh.new() # no other reference
	hull.step(STEP_S)
	say("mesh_freed %s %s" % [str(mesh.get_ref() == null), JSON.print(refusals)])
	hull.free()
	ocean.hash()
	ocean.free()

# In a scene: the engine steps the hull, which is a child of its ocean. An error is reported once.
var frames = 0
var launched

func start_scene():
	ocean = made("ocean", given["sea"])
	ocean.depth = false
	root.add_child(ocean)
	hull = made("hull", {"mesh": mesh_of(given["boat"]), "mass_kg": given["mass_kg"]})
	ocean.add_child(hull)
	refusals = []

func _initialize():
	test_round_meshes()
	test_level()
	test_origin()
	test_states()
	test_refusals()
	test_changes()
	test_freed()
	start_scene()

func _iteration(_seconds):
	frames += 1
	if frames == 20:
		say("once %s %s" % [JSON.print(refusals), str(hull.transform == Transform())])
		ocean.depth = true
	if frames == 200:
		var up = hull.global_transform.basis.y
		say("scene %.9f %.9f %.9f" % [hull.translation.y, ocean.height_at(hull.global_transform.origin), up.y])
		hull.playing = false
		launched = hull.transform
	if frames == 210:
		say("paused %s %d" % [str(hull.transform == launched), refusals.size()])
		say("end")
		quit()
