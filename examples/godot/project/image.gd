# Saves an image of the demo at ten seconds as image.png in the project's folder.
extends SceneTree

const SECONDS = 10.0
var demo
var frames = 0

func _init():
	demo = load("res://demo.tscn").instance()
	root.add_child(demo)
	demo.get_node("ocean").playing = false
	demo.get_node("ocean").time_s = SECONDS
	demo.get_node("camera").turn_s = INF

func _idle(_seconds):
	frames += 1
	if frames < 4:
		return
	var image = root.get_texture().get_data()
	image.flip_y()
	image.convert(Image.FORMAT_RGB8)
	image.save_png("res://image.png")
	quit()
