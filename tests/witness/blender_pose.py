# Runs in Blender: `blender -b --python-exit-code 1 --python blender_pose.py -- FILE.glb SECONDS,… OUT.json`.
# Reads a file with a clip and tells of every moment where the skin's vertices are: their number, lowest and highest
# place, and the root mean square of their distances from their middle, which no heading changes.
import json
import sys

import bpy
import numpy

# Blender 3.4's reader of glTF names types that numpy 1.24 has no more.
numpy.bool = bool
numpy.object = object

file, moments, out = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=file)
scene = bpy.context.scene
told = []
for seconds in map(float, moments.split(',')):
    frame = seconds * scene.render.fps
    scene.frame_set(int(frame), subframe=frame - int(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    places = []
    for thing in bpy.data.objects:
        # Blender draws bones as a mesh of its own.
        if thing.type != 'MESH' or not any(m.type == 'ARMATURE' for m in thing.modifiers):
            continue
        mesh = thing.evaluated_get(graph).to_mesh()
        places += [thing.matrix_world @ v.co for v in mesh.vertices]
    points = numpy.array([[p.x, p.y, p.z] for p in places])
    spread = numpy.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean())
    told.append({'vertices': len(points), 'low': points[:, 2].min(), 'high': points[:, 2].max(), 'spread': spread})
with open(out, 'w') as f:
    json.dump(told, f)
