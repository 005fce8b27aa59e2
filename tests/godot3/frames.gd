# Plays a thousand frames of the demo with dynamic waves, which nothing disturbs, and prints the
# heights of the water and the boat and the memory at three of them.
extends SceneTree

const FRAMES = 1000
var ocean
var count = 0

func resident_kib():
	var file = File.new()
	file.open("/proc/self/status", File.READ)
	while true:
		var line = file.get_line()
		if line.begins_with("VmRSS:"):
			return int(line.split("\t")[1])

func _init():
	var demo = load("res://demo.tscn").instance()
	root.add_child(demo)
	ocean = demo.get_node("ocean")
	demo.get_node("boat").wake = false
	ocean.connect("refused", self, "refused")
	ocean.quality = "low"
	ocean.dynamic_waves = true
	ocean.dynamic_waves_resolution = 64

func refused(why):
	print("SAYS refused ", why)

func _idle(_seconds):
	count += 1
	if count in [200, 600, FRAMES]:
		var boat = root.get_node("demo/boat").translation
		print("SAYS frame %d %.9f %.9f %.9f %.9f %.9f %d" % [count, ocean.time_s, boat.x, boat.z, ocean.height_at(boat), boat.y, resident_kib()])
	if count == FRAMES:
		quit()
