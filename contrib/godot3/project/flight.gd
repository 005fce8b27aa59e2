# A camera that circles its target, low over the water.
extends Camera

export(NodePath) var target
export(float) var distance_m = 20.0
export(float) var height_m = 4.0
export(float) var turn_s = 60.0
var seconds = 0.0

func _process(delta):
	seconds += delta
	var angle = 2.3 + TAU * seconds / turn_s
	var at = get_node(target).translation
	look_at_from_position(at + Vector3(cos(angle) * distance_m, height_m, sin(angle) * distance_m), at + Vector3(0, 1, 0), Vector3.UP)
