# Prints states and waves of hulls in dynamic waves for wakes_test.py.
extends "hull_scene.gd"

func made_ocean(sea):
	var node = made("ocean", given[sea])
	node.name = "sea"
	root.add_child(node)
	return node

func made_hull(values = {}):
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	var vertices = PoolVector3Array()
	for i in range(0, given["vertices"].size(), 3):
		vertices.append(Vector3(given["vertices"][i], given["vertices"][i + 1], given["vertices"][i + 2]))
	arrays[Mesh.ARRAY_VERTEX] = vertices
	arrays[Mesh.ARRAY_INDEX] = PoolIntArray(given["numbers"])
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	var node = made("hull", {"mesh": mesh, "mass_kg": given["mass_kg"], "centre_of_mass_m": Vector3(), "ocean": NodePath("../sea")})
	for property in values:
		node.set(property, values[property])
	root.add_child(node)
	return node

# The height of dynamic waves is that of the water in a still sea.
func water_at(x, z):
	return ocean.height_at(Vector3(x, 0, z)) - ocean.sea_level_m

# Each frame has a number of steps.
func test_states():
	for case in given["cases"]:
		ocean = made_ocean("sea")
		ocean.playing = false
		hull = made_hull({"playing": false})
		var file = written(case["name"])
		for number in range(case["frames"]):
			ocean.time_s = number * case["steps"] / 60.0
			hull.force_n = Vector3(3000, 0, 500) if number < case["frames"] / 2 else Vector3()
			for step in range(case["steps"]):
				hull.step(STEP_S)
			file.store_buffer(hull.save_state())
			say("%s %s" % [case["name"], ocean.dynamic_waves_hash()])
		file.close()
		hull.free()
		ocean.free()

# Two hulls; the states of 30 frames after a restored one.
func frames_after(hulls, first):
	var all = []
	for frame in range(first, first + 30):
		ocean.time_s = frame / 60.0
		for one in hulls:
			one.step(STEP_S)
			all.append(hash(one.save_state()))
		all.append(ocean.dynamic_waves_hash())
	return all

func test_restored():
	ocean = made_ocean("sea")
	ocean.playing = false
	var hulls = [made_hull({"playing": false}), made_hull({"playing": false, "translation": Vector3(6, 0, 1)})]
	hulls[1].force_n = Vector3(-4000, 0, 0)
	frames_after(hulls, 0)
	var waves = ocean.save_state()
	var saved = [hulls[0].save_state(), hulls[1].save_state()]
	var after = frames_after(hulls, 30)
	for case in ["same", "new"]:
		if case == "new":
			hulls[1].free()
			hulls[1] = made_hull({"playing": false})
		ocean.restore_state(waves)
		hulls[0].restore_state(saved[0])
		hulls[1].restore_state(saved[1])
		ocean.time_s = 29 / 60.0 # of the saved frame
		say("restored %s %s" % [case, str(frames_after(hulls, 30) == after and after[0] != after[3])])
	refusals = []
	var before = hulls[0].save_state()
	hulls[0].restore_state(before.subarray(0, before.size() - 34))
	hulls[0].restore_state(before.subarray(0, 20))
	var damaged = before
	damaged[damaged.size() - 1] = 255 # the sign of the seconds
	hulls[0].restore_state(damaged)
	hulls[0].restore_state(bytes_in("two"))
	hulls[0].restore_state(bytes_in("dry"))
	say("errors %s" % JSON.print(refusals))
	say("unchanged %s" % str(hulls[0].save_state() == before))
	hulls[0].free()
	hulls[1].free()
	ocean.free()

# The launch of a hull of 7 m, 8.5 s, and three time constants in which the pressure follows the hull, of as
# long: a hull that falls into the hollow of its predecessor leaves the water for a moment.
const SETTLED_S = 34

# A hull that changes its ocean, its mass and its parent, which is freed with it.
var passed_s = 0.0

func play(oceans, seconds):
	for _frame in range(60 * seconds):
		passed_s += STEP_S
		for one in oceans:
			one.time_s = passed_s
		hull.step(STEP_S)
	for one in oceans:
		ocean = one
		say("moved %.9f" % water_at(0, 0))

func test_moved():
	var first = made_ocean("still_sea")
	var second = made_ocean("still_sea")
	second.name = "second"
	for one in [first, second]:
		one.playing = false
	hull = made_hull({"playing": false})
	play([first, second], 14)
	hull.ocean = "../second"
	play([first, second], 14)
	hull.mass_kg = given["mass_kg"] / 2
	play([first, second], SETTLED_S)
	hull.launch()
	play([first, second], SETTLED_S)
	root.remove_child(hull)
	second.add_child(hull)
	hull.ocean = ".."
	play([first, second], SETTLED_S)
	second.free()
	first.hash()
	first.free()
	say("moved_errors %s" % JSON.print(refusals))

# In a scene, with the engine's frames.
var frame = 0
var events = []
var seconds = 0.0

func _initialize():
	if given.has("cases"):
		refusals = []
		test_states()
		test_restored()
		refusals = []
		test_moved()
		refusals = []
	ocean = made_ocean("still_sea")
	hull = made_hull()
	events = given["events"].duplicate()

# Called after the nodes' _physics_process() and before their _process().
func _idle(delta):
	seconds += delta
	if events.size() == 0 or seconds < events[0][0]:
		return
	var event = events.pop_front()
	match event[1]:
		"water": say("water %s %.9f" % [event[2], water_at(0, 0)])
		"set": (hull if event[2] == "hull" else ocean).set(event[3], event[4])
		"free_hull":
			hull.free()
			hull = null
		"leave": root.remove_child(hull)
		"enter": root.add_child(hull)
		"make_hull": hull = made_hull()
		"free_ocean": ocean.free()
		"make_ocean": ocean = made_ocean("still_sea")
		"refusals":
			say("refusals %s" % JSON.print(refusals))
			refusals = []
		"end":
			say("end")
			quit()
