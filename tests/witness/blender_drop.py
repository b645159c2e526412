# Runs in Blender after an exported script: `blender -b --python-exit-code 1 --python blender_drop.py -- DOLL.py OUT.json`.
# Lays the doll on its back 1 m up, or higher where it hangs down farther, steps 6 s and tells every body's place, as (x, y, z) and (x, y, z, w) of our body frame.
import json
import runpy
import sys
from math import pi

import bpy
from mathutils import Matrix, Vector

script, out = sys.argv[sys.argv.index('--') + 1:]
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
built = runpy.run_path(script, run_name='doll')
bodies = built['build']()
built['add_floor']()
bpy.context.view_layer.update()
lying = Matrix.Rotation(-pi / 2, 4, 'X')
lowest = min((lying @ body.matrix_world @ Vector(corner)).z for body in bodies.values() for corner in body.bound_box)
turn = Matrix.Translation((0, 0, max(1, 0.2 - lowest))) @ lying
for thing in bpy.data.objects:
    if thing.name != 'floor':
        thing.matrix_world = turn @ thing.matrix_world
scene = bpy.context.scene
scene.render.fps = 60
scene.frame_start, scene.frame_end = 1, 361
scene.rigidbody_world.point_cache.frame_end = 361


def places():
    found = {}
    graph = bpy.context.evaluated_depsgraph_get()
    for name, body in bodies.items():
        m = body.evaluated_get(graph).matrix_world
        if body.rigid_body.collision_shape == 'CAPSULE':  # along z there, along y here
            m = m @ Matrix.Rotation(pi / 2, 4, 'X')
        q = m.to_quaternion()
        found[name] = {'p': list(m.translation), 'q': [q.x, q.y, q.z, q.w]}
    return found


steps = []
for frame in range(1, 362):
    scene.frame_set(frame)
    steps.append(places())
masses = {name: body.rigid_body.mass for name, body in bodies.items()}
shapes = {name: {'kind': body.rigid_body.collision_shape, 'size': list(body.dimensions)} for name, body in bodies.items()}
with open(out, 'w') as file:
    json.dump({'masses': masses, 'shapes': shapes, 'steps': steps}, file)
