"""Pictures of a glTF character for a look by eye: views, close-ups, joint tests and frames of its clips.

    blender -b -noaudio --python tools/assets/render_mannequin.py -- MODEL.glb FOLDER [SHEET...]

Sheets: body, close, bend, flex, walk, idle, uv. Each is one PNG a picture, named SHEET_N.png in FOLDER.
"""
import math
import os
import sys

import bpy
import numpy

numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object  # Blender 3.4's importer predates numpy 1.24
from mathutils import Quaternion, Vector  # noqa: E402

# azimuth and elevation in degrees, target (Blender axes: Z up, the figure faces -Y), width of the picture in metres, pixels
BODY = [(0, 0, (0, 0, .88), 1.90, 560, 640), (90, 0, (0, 0, .88), 1.90, 330, 640), (35, 8, (0, 0, .88), 1.90, 480, 640),
        (180, 0, (0, 0, .88), 1.90, 560, 640)]
CLOSE = [
    (0, 0, (0, 0, 1.60), .44, 420, 420), (35, 5, (0, 0, 1.60), .44, 420, 420), (90, 0, (0, 0, 1.60), .44, 420, 420),
    (60, 40, (.61, -.05, .99), .30, 420, 420), (-70, 0, (.61, -.05, .99), .30, 420, 420), (40, 25, (.12, -.06, .08), .34, 420, 420),
    (150, 10, (.08, 0, 1.38), .55, 420, 420), (30, 0, (.08, 0, .92), .50, 420, 420), (110, 0, (.08, 0, .42), .50, 420, 420)]
# Turns about each joint's own X in degrees, or about an axis of the model ("y+30": y is forward, z is up).
LONG_FINGERS = ["left" + f + p for f in ("Index", "Middle", "Ring", "Little") for p in ("Proximal", "Intermediate", "Distal")]
BEND = [
    {"leftLowerArm": 90, "rightLowerArm": 130, "leftLowerLeg": 100, "rightLowerLeg": 60, "rightUpperLeg": 60, "leftUpperLeg": 10},
    {"leftUpperArm": "y+60", "rightUpperArm": "y-120", "rightUpperLeg": 90, "rightLowerLeg": 90, "leftUpperLeg": "y-30",
     "head": "z+50"},
    {"leftUpperArm": "y-45", "rightUpperArm": "z+60", "spine": 25, "chest": 25, "upperChest": 20, "leftFoot": -40, "rightFoot": 20},
    {"spine": "z+20", "chest": "z+20", "upperChest": "z+15", "leftUpperLeg": -25, "rightUpperLeg": 110, "rightLowerLeg": 130,
     **{name: 60 for name in LONG_FINGERS}}]
# Close-ups of bent joints: turns, then the view.
FIST = {**{name: 75 for name in LONG_FINGERS}, "leftThumbProximal": 40, "leftThumbDistal": 40}
FLEX = [
    ({"leftLowerArm": 90}, (0, 35, (.38, -.05, 1.22), .42, 420, 420)),
    ({"leftLowerArm": 135}, (-40, 10, (.38, -.05, 1.25), .42, 420, 420)),
    (FIST, (-70, 0, (.59, -.05, 1.02), .26, 420, 420)),
    ({"leftLowerLeg": 100}, (90, 5, (.1, .08, .48), .50, 420, 420)),
    ({"leftUpperLeg": 100, "leftLowerLeg": 120}, (60, 10, (.05, -.1, .92), .62, 420, 420)),
    ({"leftUpperArm": "y+80", "leftShoulder": 15}, (20, 0, (.15, 0, 1.42), .55, 420, 420)),
    ({"leftUpperArm": "y-42"}, (15, 0, (.15, 0, 1.32), .50, 420, 420)),
    ({"leftFoot": -35, "leftToes": 35}, (75, 5, (.12, -.05, .08), .40, 420, 420)),
    ({"leftUpperLeg": -35, "rightUpperLeg": 60}, (160, 0, (0, 0, .92), .60, 420, 420))]
MODEL_AXES = {"y": (0, -1, 0), "z": (0, 0, 1)}


def material(name, colour, rough):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Roughness"].default_value = rough
    return made


def stage():
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.cycles.max_bounces = "CYCLES", 10, 2
    scene.cycles.use_denoising = False  # Debian builds Blender without the denoiser
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (.34, .36, .40, 1)
    for angles, energy in (((50, 0, 40), 2.4), ((60, 0, -130), .8)):
        data = bpy.data.lights.new("sun", "SUN")
        data.energy, data.angle = energy, .2
        sun = bpy.data.objects.new("sun", data)
        sun.rotation_euler = [math.radians(a) for a in angles]
        bpy.context.collection.objects.link(sun)
    bpy.ops.mesh.primitive_plane_add(size=200)
    bpy.context.object.data.materials.append(material("floor", (.30, .31, .33), .9))
    camera = bpy.data.cameras.new("camera")
    camera.type = "ORTHO"
    scene.camera = bpy.data.objects.new("camera", camera)
    bpy.context.collection.objects.link(scene.camera)


def shoot(path, azimuth, elevation, target, width, pixels_x, pixels_y):
    scene, a, e = bpy.context.scene, math.radians(azimuth), math.radians(elevation)
    away = Vector((math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e)))
    scene.camera.location = Vector(target) + away * 4
    scene.camera.rotation_euler = away.to_track_quat("Z", "Y").to_euler()
    scene.camera.data.ortho_scale = width
    scene.render.resolution_x, scene.render.resolution_y, scene.render.filepath = pixels_x, pixels_y, path
    bpy.ops.render.render(write_still=True)


def bend(armature, turns):
    armature.animation_data_clear()
    for bone in armature.pose.bones:
        bone.rotation_mode, bone.rotation_quaternion, bone.location = "QUATERNION", Quaternion(), (0, 0, 0)
    for name, turn in turns.items():
        bone = armature.pose.bones[name]
        axis, degrees = Vector((1, 0, 0)), turn
        if isinstance(turn, str):
            axis = bone.bone.matrix_local.to_3x3().inverted() @ Vector(MODEL_AXES[turn[0]])
            degrees = float(turn[1:])
        bone.rotation_quaternion = Quaternion(axis, math.radians(degrees))


def play(armature, clip, share):
    action = next(a for a in bpy.data.actions if a.name.startswith(clip))
    armature.animation_data_create()
    for track in armature.animation_data.nla_tracks:
        track.mute = True
    armature.animation_data.action = action
    first, last = action.frame_range
    frame = first + share * (last - first)
    bpy.context.scene.frame_set(int(frame), subframe=frame % 1)


def checkerboard():
    for slot in (s for o in bpy.data.objects if o.type == "MESH" for s in o.material_slots if "floor" not in s.material.name):
        tree = slot.material.node_tree
        board, place = tree.nodes.new("ShaderNodeTexChecker"), tree.nodes.new("ShaderNodeTexCoord")
        board.inputs["Scale"].default_value = 90
        tree.links.new(place.outputs["UV"], board.inputs["Vector"])
        shader = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
        tree.links.new(board.outputs["Color"], shader.inputs["Base Color"])


def main():
    model, folder, *sheets = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # Vertices split along texture seams are merged: Blender bends normals by its own fans, which would show every seam.
    bpy.ops.import_scene.gltf(filepath=os.path.abspath(model), merge_vertices=True)
    armature = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    stage()

    def path(sheet, number):
        return os.path.join(os.path.abspath(folder), f"{sheet}_{number}.png")

    bend(armature, {})
    for sheet, views in (("body", BODY), ("close", CLOSE)):
        for k, view in enumerate(views if sheet in sheets else []):
            shoot(path(sheet, k), *view)
    for k, turns in enumerate(BEND if "bend" in sheets else []):
        bend(armature, turns)
        shoot(path("bend", k), (25, 30, 60, -25)[k], 5, (0, 0, .92), 2.0, 480, 520)
    for k, (turns, view) in enumerate(FLEX if "flex" in sheets else []):
        bend(armature, turns)
        shoot(path("flex", k), *view)
    for clip in ("walk", "idle"):
        for k in range(6 if clip in sheets else 0):
            play(armature, clip, k / (8 if clip == "walk" else 6))
            shoot(path(clip, k), 70 if k < 5 else 0, 4, (0, 0, .88), 1.90, 330, 560)
    if "uv" in sheets:
        bend(armature, {})
        checkerboard()
        for k, view in enumerate([BODY[2], BODY[3], CLOSE[1], CLOSE[3]]):
            shoot(path("uv", k), *view)


main()
