# A floating box, which lies on the plane through the water at four points of its hull. It does not
# drift.
extends Spatial

export(NodePath) var ocean
const LENGTH = 5.0
const WIDTH = 2.0
const ABOVE_WATER = 0.25 # height of the box's centre, metres

var places = PoolVector3Array()

func _process(_delta):
	var ahead = global_transform.basis.x
	ahead = Vector3(ahead.x, 0, ahead.z).normalized()
	var right = ahead.cross(Vector3.UP)
	var middle = Vector3(translation.x, 0, translation.z)
	places = PoolVector3Array([middle + ahead * LENGTH / 2, middle - ahead * LENGTH / 2,
			middle + right * WIDTH / 2, middle - right * WIDTH / 2])
	var water = get_node(ocean).query(places)
	var h = water["height"]
	var along = ahead * LENGTH + Vector3.UP * (h[0] - h[1])
	var across = right * WIDTH + Vector3.UP * (h[2] - h[3])
	var up = across.cross(along).normalized()
	var x = along.normalized()
	var basis = Basis(x, up, x.cross(up))
	global_transform = Transform(basis, middle + Vector3.UP * ((h[0] + h[1] + h[2] + h[3]) / 4 + ABOVE_WATER))
