# Loads res://doll.tscn in Godot 3, tells what it holds, drops it on its back from 1 m and tells every body's place.
extends SceneTree

const STEPS = 1440  # 6 s at 240 a second

var skeleton
var out = File.new()
var steps = 0

func _init():
	var floor_body = StaticBody.new()
	var shape = CollisionShape.new()
	shape.shape = BoxShape.new()
	shape.shape.extents = Vector3(50, 1, 50)
	floor_body.add_child(shape)
	floor_body.translation = Vector3(0, -1, 0)
	root.add_child(floor_body)
	var doll = load("res://doll.tscn").instance()
	doll.transform = Transform(Basis(Vector3(1, 0, 0), -PI / 2), Vector3(0, 1, 0))
	root.add_child(doll)
	skeleton = doll.get_node("Skeleton")
	out.open("res://drop.jsonl", File.WRITE)
	connect("physics_frame", self, "_step")

func _facts():
	var facts = {}
	for body in skeleton.get_children():
		var fact = {"mass": body.mass, "bone": body.get_bone_id(), "joint": body.joint_type, "exceptions": body.get_collision_exceptions().size()}
		var shape = body.get_node("Shape").shape
		fact["shape"] = shape.get_class()
		if shape is BoxShape:
			fact["sizes"] = [shape.extents.x, shape.extents.y, shape.extents.z]
		elif shape is CapsuleShape:
			fact["sizes"] = [shape.radius, shape.height / 2]
		elif shape is ConvexPolygonShape:
			fact["sizes"] = []
		else:
			fact["sizes"] = [shape.radius]
		for name in ["angular_limit_lower", "angular_limit_upper", "x/angular_limit_lower", "x/angular_limit_upper", "y/angular_limit_lower", "y/angular_limit_upper", "z/angular_limit_lower", "z/angular_limit_upper"]:
			fact[name] = body.get("joint_constraints/" + name)
		facts[body.name] = fact
	return facts

func _step():
	if steps == 0:
		out.store_line(to_json(_facts()))
	var places = {}
	for body in skeleton.get_children():
		var t = body.global_transform
		var q = t.basis.get_rotation_quat()
		places[body.name] = {"p": [t.origin.x, t.origin.y, t.origin.z], "q": [q.x, q.y, q.z, q.w]}
	out.store_line(to_json(places))
	steps += 1
	if steps > STEPS:
		out.close()
		quit()
