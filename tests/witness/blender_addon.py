# The add-on of tools/blender in Blender, headless: `blender -b --factory-startup --python-exit-code 1 --python blender_addon.py
# -- ADDON.py MODEL FOLDER`. Imports the model, moves and turns its armature, presses Ragdoll, and holds the joints of the baked action against those
# of Blender's own importer on the clip that lutka wrote; the rigid bodies against the profile.
import json
import os
import re
import sys

import addon_utils
import bpy
import numpy
from mathutils import Matrix

numpy.bool = bool  # Debian's importer of Blender 3.4 uses a name that its NumPy no longer has

addon, model, folder = sys.argv[sys.argv.index('--') + 1:]
sys.path.insert(0, os.path.dirname(addon))
addon_utils.enable(os.path.splitext(os.path.basename(addon))[0], default_set=True)


def only_armature(things):
    found = [thing for thing in things if thing.type == 'ARMATURE']
    assert len(found) == 1, found
    return found[0]


def load(path):
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=path)
    return [thing for thing in bpy.data.objects if thing not in before]


def heads(armature, names, frame):
    bpy.context.scene.frame_set(frame)
    bpy.context.view_layer.update()
    return [armature.matrix_world @ armature.pose.bones[name].head for name in names]


for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
scene = bpy.context.scene
scene.render.fps, scene.frame_start, scene.frame_end = 60, 0, 120
scene.frame_set(0)
any_rig = os.environ.get('LUTKA_RIG') == 'any'

assert not bpy.ops.lutka.ragdoll.poll(), 'nothing is picked'
armature = only_armature(load(model))
armature.animation_data_clear()
top = armature
while top.parent:
    top = top.parent
# Somewhere else, turned: the figure falls where it stands.
top.matrix_world = Matrix.Translation((3, -2, 0)) @ Matrix.Rotation(0.7, 4, 'Z') @ top.matrix_world
bpy.ops.object.select_all(action='DESELECT')
armature.select_set(True)
bpy.context.view_layer.objects.active = armature
bpy.context.view_layer.update()
names = [bone.name for bone in armature.data.bones]
rest = {name: armature.matrix_world @ armature.data.bones[name].head_local for name in names}
armature.pose.bones[names[1]].scale = (1, 1.1, 1)  # of the pose that it stands in: not the action's

try:  # an operator that reports an error raises from a script
    bpy.ops.lutka.ragdoll(scene='drop', seconds=2.0, seed=3, folder=folder, any_rig=any_rig)
except RuntimeError as trouble:
    sys.exit(f'FAIL {trouble}')
assert armature.animation_data.action.name.endswith('ragdoll')

clip = only_armature(load(os.path.join(folder, 'fall.glb')))
worst, fallen = 0.0, 0.0
# Where a joint and a mesh's node share a name, either may have got a number from the importer.
names = [name for name in names if name in clip.pose.bones and f'{name}.001' not in clip.pose.bones]
assert len(names) > 10
place = None
for frame in (0, 15, 30, 60, 90, 120):
    ours = heads(armature, names, frame)
    theirs = heads(clip, names, frame)
    if place is None:  # the add-on keeps where the figure stands and which way it faces; the clip has it in the middle
        # lutka may have found that a unit of the armature is no metre.
        units = max((p - ours[0]).length for p in ours) / max((p - theirs[0]).length for p in theirs)
        turn = Matrix.Rotation(0.7, 4, 'Z') @ Matrix.Scale(units, 4)
        shift = ours[0] - turn @ theirs[0]
        assert abs(shift.z) < 1e-4 * units, shift
        place = Matrix.Translation(shift) @ turn
    worst = max(worst, max((a - place @ b).length for a, b in zip(ours, theirs)))
    fallen = max(fallen, max(rest[name].z - now.z for name, now in zip(names, ours)))
start = heads(armature, names, 0)
level = (start[0] - rest[names[0]]).to_2d().length

profile = json.load(open(os.path.join(folder, 'model.ragdoll.json')))
group = bpy.data.collections[f'{armature.name} ragdoll']
bodies = {thing.name: thing for thing in group.objects if thing.rigid_body}
masses = sum(body.rigid_body.mass for body in bodies.values())
joints = [thing for thing in group.objects if thing.rigid_body_constraint]
off = 0.0
for body in profile['bodies']:
    word = re.sub('[^A-Za-z0-9]+', '_', body['name'])  # as the export writes it
    thing = next(b for name, b in bodies.items() if name == 'body ' + word)
    if body['joint'] in rest:  # a body's centre lies near its joint, in the rest pose where the armature stands
        off = max(off, (thing.matrix_world.translation - rest[body['joint']]).length)
height = units * profile['heightM']
failures = []
if worst > 1e-3 * height: failures.append(f'joints are off by {worst}')
if fallen < (0.05 if any_rig else 0.2) * height:  # a hand may lie already
    failures.append(f'no joint fell by more than {fallen}')
if level > 1e-3: failures.append(f'the figure jumped by {level}')
if abs(masses - profile['totalMassKg']) > 1e-3: failures.append(f'masses {masses}')
if len(bodies) != len(profile['bodies']) or len(joints) < len(profile['constraints']): failures.append('bodies or joints are missing')
if off > 0.35 * height: failures.append(f'a body stands {off} m from its joint')
print(f"{'FAIL' if failures else 'ok  '} Blender add-on {os.path.basename(model)}: {len(names)} bones within {1000 * worst:.3f} mm of Blender's importer, "
      f'{len(bodies)} bodies of {masses:.2f} kg, {len(joints)} joints {failures}')
sys.exit(1 if failures else 0)
