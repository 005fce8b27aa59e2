# Prints the hash and a height of a sea: godot4 --headless -s server.gd
extends SceneTree

func _init():
	var ocean = PelagicOcean.new()
	ocean.preset = "moderate"
	ocean.time_s = 12.34
	print(ocean.hash(), " ", ocean.height_at(Vector3(10, 0, 20)))
	ocean.free()
	quit()
