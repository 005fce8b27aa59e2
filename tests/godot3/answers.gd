# Prints hashes, samples and errors of the node without a window, which answers_test.py compares
# with the command line.
extends SceneTree

var refusals = []

func refused(why):
	refusals.append(why)

func say(words):
	print("SAYS ", words)

func _init():
	var ocean = load("res://addons/pelagic/ocean.gdns").new()
	root.add_child(ocean)
	ocean.playing = false
	ocean.connect("refused", self, "refused")
	var seas = JSON.parse(OS.get_environment("SEAS")).result
	var defaults = {}
	for property in seas["properties"]:
		defaults[property] = ocean.get(property)
		say("default %s %s" % [property, ocean.get(property)])
	for sea in seas["seas"]:
		for property in defaults:
			ocean.set(property, defaults[property])
		for property in sea["values"]:
			ocean.set(property, sea["values"][property])
		for time in [0.0, 12.34]:
			ocean.time_s = time
			say("hash %s@%s %s" % [sea["name"], time, ocean.hash()])
	for property in defaults:
		ocean.set(property, defaults[property])

	ocean.wind_direction_deg = 30
	ocean.time_s = 0
	for property in ocean.get_script().get_script_property_list():
		if property["name"] == "preset":
			for name in property["hint_string"].split(","):
				ocean.preset = name
				say("preset %s %s" % [name, ocean.hash()])
	ocean.preset = "custom"

	ocean.velocities = true
	ocean.time_s = 12.34
	var place = Vector3(12.5, 77, -40)
	say("same %s" % str(ocean.query(PoolVector3Array([place]))["height"][0] == ocean.height_at(place)))

	# Water below the surface, which the property `depth` adds.
	var below = PoolVector3Array([place - Vector3(0, 80, 0)])
	refusals = []
	say("shallow %s %s" % [ocean.sample_water(below) == null, JSON.print(refusals)])
	ocean.depth = true
	var water = ocean.sample_water(below)
	say("water %.6f %.1f %d %d" % [water["depth"][0] - ocean.height_at(place), water["pressure"][0], water["velocity"].size(), water["acceleration"].size()])
	ocean.depth = false

	# A ray hits the surface that height_at() returns.
	var hit = ocean.first_hit(Vector3(3, 12, -7), Vector3(1, -0.4, 0.3), 500)
	say("hit %s %.9f %.9f" % [hit["hit"], hit["position"].y, ocean.height_at(hit["position"])])
	say("miss %s" % ocean.first_hit(Vector3(3, 12, -7), Vector3(0, 1, 0), 500)["hit"])

	# Invalid values are reported in one line and do not change the sea.
	var before = ocean.hash()
	for wrong in seas["refused"]:
		refusals = []
		ocean.set(wrong[0], wrong[1])
		say("refused %s" % JSON.print(refusals))
	for wrong in [[ocean.first_hit(Vector3(), Vector3(), 10)], [ocean.query(3)], [ocean.height_at("here")]]:
		say("nothing %s" % str(wrong[0] == null))
	say("stays %s" % str(ocean.hash() == before))
	refusals = []
	ocean.patch_size_m = 250
	ocean.cascades = 4
	say("together %s %s" % [str(ocean.hash() == before), JSON.print(refusals)])
	ocean.free()
	say("end")
	quit()
