# What the scripts of hulls.gd and wakes.gd share: nodes, files and printed lines.
extends SceneTree

const STEP_S = 1 / 60.0
var given = JSON.parse(OS.get_environment("GIVEN")).result
var refusals = []
var ocean
var hull

func refused(why):
	refusals.append(why)

func say(words):
	print("SAYS ", words)

func made(name, values):
	var node = load("res://addons/pelagic/%s.gdns" % name).new()
	node.connect("refused", self, "refused")
	for property in values:
		node.set(property, values[property])
	return node

func written(name):
	var file = File.new()
	file.open(OS.get_environment("FILES") + "/" + name, File.WRITE)
	return file

func bytes_in(name):
	var file = File.new()
	file.open(OS.get_environment("FILES") + "/" + name, File.READ)
	return file.get_buffer(file.get_len())
