# Prints hashes, samples and errors of nodes with dynamic waves and shores for ocean_parts_test.py.
extends SceneTree

var refusals = []
var given = JSON.parse(OS.get_environment("GIVEN")).result

func refused(why):
	refusals.append(why)

func say(words):
	print("SAYS ", words)

func floats_in(name):
	var file = File.new()
	file.open(OS.get_environment("FILES") + "/" + name, File.READ)
	var numbers = PoolRealArray()
	while file.get_position() < file.get_len():
		numbers.append(file.get_float())
	file.close()
	return numbers

func made(values, with_shore = false):
	var ocean = load("res://addons/pelagic/ocean.gdns").new()
	root.add_child(ocean)
	ocean.connect("refused", self, "refused")
	ocean.playing = false
	for property in values:
		ocean.set(property, values[property])
	if with_shore:
		ocean.shore_heights_m = floats_in("heights")
	return ocean

# Writes height, normal and velocity of each point.
func store_samples(ocean):
	var numbers = floats_in("points")
	var places = PoolVector3Array()
	for i in range(0, numbers.size(), 2):
		places.append(Vector3(numbers[i], 77, numbers[i + 1]))
	var water = ocean.query(places)
	var file = File.new()
	file.open(OS.get_environment("FILES") + "/samples", File.WRITE)
	for i in range(places.size()):
		file.store_float(water["height"][i])
		for of in ["normal", "velocity"]:
			for axis in range(3):
				file.store_float(water[of][i][axis])
	file.close()
	say("has_depth %s" % str(water.has("depth")))

# The commands of tests/golden_values_test.cpp.
func play(ocean):
	ocean.set_center(Vector3(0.75, 5, -1))
	var boat
	var deeper = given["boat"].duplicate()
	deeper["height_m"] = -1
	for tick in range(61):
		match tick:
			3: ocean.add_impulse(given["stone"])
			5: boat = ocean.add_source(given["boat"])
			20: ocean.set_source(boat, deeper)
			25: ocean.set_rain({"drops_per_m2_s": 0.5, "radius_m": 1, "height_m": 0.1, "seed": 3})
			30: ocean.add_impulse({"mode": "foam", "x_m": 12, "z_m": -10, "height_m": 0.3})
			40:
				ocean.remove_source(boat)
				ocean.set_rain({})
		ocean.time_s = tick / 60.0
		ocean.hash()
		if tick % 10 == 0:
			say("waves %d %s %s" % [tick, ocean.hash(), ocean.dynamic_waves_hash()])
	store_samples(ocean)

func hashes(ocean, first):
	var all = []
	for tick in range(30):
		ocean.time_s = (first + tick) / 60.0
		all.append(ocean.dynamic_waves_hash())
	return all

func test_saved_states():
	var ocean = made(given["sea"])
	var other = made(given["sea"])
	ocean.add_source(given["boat"])
	ocean.set_rain({"drops_per_m2_s": 0.5, "radius_m": 1, "height_m": 0.1, "seed": 3})
	hashes(ocean, 0)
	var saved = ocean.save_state()
	var after = hashes(ocean, 30)
	other.restore_state(saved)
	say("restored_elsewhere %s" % str(hashes(other, 30) == after))
	ocean.restore_state(saved)
	say("restored %s" % str(hashes(ocean, 30) == after))
	# While a frame is in flight, as it is between the frames of a playing node.
	ocean.restore_state(saved)
	ocean.time_s = 30 / 60.0
	var later = ocean.save_state()
	ocean.restore_state(later)
	ocean.time_s = 31 / 60.0
	say("in_flight %s" % str(ocean.dynamic_waves_hash() == after[1]))

	var before = ocean.dynamic_waves_hash()
	refusals = []
	ocean.restore_state(saved.subarray(0, saved.size() - 2))
	say("damaged %s" % JSON.print(refusals))
	for wrong in given["refused"]:
		refusals = []
		if wrong[0] in ["property"]:
			ocean.set(wrong[1], wrong[2])
		else:
			say("answer %s" % str(ocean.callv(wrong[1], wrong[2]) == null))
		say("refused %s" % JSON.print(refusals))
	say("unchanged %s" % str(ocean.dynamic_waves_hash() == before))

	refusals = []
	ocean.dynamic_waves_border_m = 2000
	ocean.hash()
	say("together %s" % JSON.print(refusals))
	ocean.dynamic_waves_border_m = 12
	ocean.shore_heights_m = PoolRealArray([1, 2, 3])
	refusals = []
	ocean.hash()
	say("together %s" % JSON.print(refusals))
	ocean.shore_columns = 2
	ocean.shore_rows = 2
	refusals = []
	ocean.hash()
	say("together %s" % JSON.print(refusals))
	ocean.shore_heights_m = PoolRealArray([-1, -2, -3, -4])
	ocean.cascades = 1
	refusals = []
	ocean.hash()
	say("together %s" % JSON.print(refusals))
	ocean.shore_heights_m = PoolRealArray()
	ocean.cascades = 2
	ocean.dynamic_waves = false
	refusals = []
	say("off %s %s" % [str(ocean.add_impulse(given["stone"]) == null), str(ocean.dynamic_waves_hash() == null)])
	say("off_refused %s" % JSON.print(refusals))
	ocean.free()
	other.free()

# The spray of tests/golden_values_test.cpp.
func test_spray():
	var ocean = made(given["spray_sea"])
	var other = made(given["spray_sea"])
	ocean.set_spray_center(Vector3(5, 9, -3))
	other.set_spray_center(Vector3(5, 9, -3))
	ocean.emit_spray(given["bow"])
	ocean.time_s = 1
	other.restore_spray(ocean.save_spray())
	for time in [2.0625, 7.25]:
		ocean.time_s = time
		other.time_s = time
		var droplets = ocean.droplets()
		var at = [ocean.spray_hash(), str(droplets["position"].size())]
		for i in [0, droplets["age"].size() - 1]:
			for of in ["position", "velocity"]:
				for axis in range(3):
					at.append(droplets[of][i][axis])
		say("spray %s" % JSON.print(at))
		say("restored_spray %s" % str(other.spray_hash() == ocean.spray_hash()))
	refusals = []
	ocean.emit_spray({"count": 9000})
	ocean.spray = false
	ocean.emit_spray({})
	say("spray_refused %s" % JSON.print(refusals))
	ocean.free()
	other.free()

func _init():
	var ocean = made(given["shore_sea"], true)
	play(ocean)
	ocean.free()
	say("no_errors %s" % JSON.print(refusals))
	test_saved_states()
	test_spray()
	say("end")
	quit()
