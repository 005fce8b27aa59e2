# Saves an image of the demo at ten seconds as image.png in the project's folder.
extends SceneTree

const SECONDS = 10.0
const STEPS = 60
const STEP_S = 0.05
var demo
var frames = 0

func _init():
	demo = load("res://demo.tscn").instance()
	root.add_child(demo)
	demo.get_node("ocean").playing = false
	demo.get_node("boat").playing = false
	demo.get_node("camera").turn_s = INF

func _idle(_seconds):
	frames += 1
	if frames == 1:
		for step in range(STEPS, -1, -1):
			demo.get_node("ocean").time_s = SECONDS - step * STEP_S
			demo.get_node("boat").step(STEP_S)
	if frames < 5:
		return
	var image = root.get_texture().get_data()
	image.flip_y()
	image.convert(Image.FORMAT_RGB8)
	image.save_png("res://image.png")
	quit()
