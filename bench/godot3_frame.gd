# Benchmark of a frame of the node PelagicOcean on the engine's thread: medians of its _process and
# of a query of 1000 points.
#
#   THREADS=0 xvfb-run -a godot3 --path build/release/godot3 --audio-driver Dummy \
#     --resolution 64x36 -s $PWD/bench/godot3_frame.gd
extends SceneTree

const FRAMES = 200
const POINTS = 1000
var ocean
var places = PoolVector3Array()
var process_us = []
var query_us = []

func _init():
	var demo = load("res://demo.tscn").instance()
	root.add_child(demo)
	ocean = demo.get_node("ocean")
	ocean.velocities = false
	demo.get_node("boat").playing = false
	ocean.threads = int(OS.get_environment("THREADS"))
	for i in range(POINTS):
		places.append(Vector3(i * 0.37, 0, i * 0.11))

func _idle(_seconds):
	ocean.set_process(false)
	var start = OS.get_ticks_usec()
	ocean._process(1.0 / 60)
	process_us.append(OS.get_ticks_usec() - start)
	start = OS.get_ticks_usec()
	ocean.query(places)
	query_us.append(OS.get_ticks_usec() - start)
	OS.delay_msec(12) # like the rendering of another frame
	if process_us.size() == FRAMES:
		process_us.sort()
		query_us.sort()
		print("_process %.2f ms, %d points %.2f ms" % [process_us[FRAMES / 2] / 1e3, POINTS, query_us[FRAMES / 2] / 1e3])
		quit()
