# Runs in Blender: `blender -b --python-exit-code 1 --python blender_skin.py -- BAKED.glb OUT.json FRAME ...`.
# Reads a baked fall by Blender's own importer and tells where its vertices are at those frames of 60 a second, mesh by mesh
# in the order of the file, as (x, y, z) with y up.
import json
import sys

import bpy
import numpy

if 'bool' not in vars(numpy):  # Debian's importer is older than its NumPy, which has dropped the alias
    numpy.bool = bool
baked, out, *frames = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps = 60  # so that keys lie on whole frames
bpy.ops.import_scene.gltf(filepath=baked)
# The importer adds a sphere that shows bones.
meshes = [o for o in bpy.data.objects if o.type == 'MESH' and any(m.type == 'ARMATURE' for m in o.modifiers)]


def vertices(mesh, graph):
    evaluated = mesh.evaluated_get(graph)
    data = evaluated.to_mesh()
    points = [evaluated.matrix_world @ v.co for v in data.vertices]
    evaluated.to_mesh_clear()
    return [[p.x, p.z, -p.y] for p in points]


shown = []
for frame in frames:
    scene.frame_set(int(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    shown.append([vertices(mesh, graph) for mesh in meshes])
with open(out, 'w') as file:
    json.dump(shown, file)
