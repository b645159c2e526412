"""Blender add-on: pick an armature, press Ragdoll, get its fall as an action and its ragdoll as rigid bodies.

Install it by Edit > Preferences > Add-ons > Install (this one file), and tell it where `lutka` is if it isn't on the PATH.
The button is in the 3D view's sidebar (N), tab Lutka. The work is done by the executable: the armature with its meshes goes out
as glTF, what comes back is a baked clip and the rigid bodies of `lutka export --format blender`.
"""

import json
import os
import runpy
import shutil
import struct
import subprocess
import tempfile

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from mathutils import Matrix, Quaternion, Vector

bl_info = {
    "name": "Lutka Ragdoll",
    "author": "The Lutka developers",
    "version": (0, 2, 0),
    "blender": (3, 0, 0),
    "location": "3D View > Sidebar > Lutka",
    "description": "Turns the picked armature into a physically sound ragdoll",
    "category": "Animation",
}

SCENES = ("drop", "spread", "pile", "stairs", "ramp", "hang", "throw", "balls")
# glTF has y up and faces +z; Blender z up and -y.
BLENDER_FROM_GLTF = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
GLTF_FROM_BLENDER = BLENDER_FROM_GLTF.inverted()


class Trouble(Exception):
    """What the user is told."""


# What lutka writes: node 0 carries the placing in the world, its descendants are the joints in the bind pose.


def read_glb(path):
    with open(path, "rb") as file:
        magic, _, _ = struct.unpack("<4sII", file.read(12))
        if magic != b"glTF":
            raise Trouble(f"{path} is no binary glTF")
        length, _ = struct.unpack("<II", file.read(8))
        document = json.loads(file.read(length))
        length, _ = struct.unpack("<II", file.read(8))
        return document, file.read(length)


def numbers_of(document, binary, index):
    """An accessor of floats, as rows."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", 4 * width)
    return [struct.unpack_from(f"<{width}f", binary, start + i * stride) for i in range(accessor["count"])]


def quaternion_of(row):
    return Quaternion((row[3], row[0], row[1], row[2]))


class Clip:
    """The baked fall: worlds(frame) gives each joint's frame in the world, glTF's axes."""

    def __init__(self, path):
        document, binary = read_glb(path)
        self.nodes = document["nodes"]
        self.order = self._order(document)
        self.tracks = {}
        animation = document["animations"][0]
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            times = [row[0] for row in numbers_of(document, binary, sampler["input"])]
            rows = numbers_of(document, binary, sampler["output"])
            target = channel["target"]
            self.tracks[target["node"], target["path"]] = times, rows
        self.seconds = max(times[-1] for times, _ in self.tracks.values())

    def _order(self, document):
        order = [(node, None) for node in document["scenes"][document.get("scene", 0)]["nodes"]]
        for node, _ in order:
            order += [(child, node) for child in self.nodes[node].get("children", ())]
        return order

    def _value(self, node, path, seconds, rest):
        if (node, path) not in self.tracks:
            return rest
        times, rows = self.tracks[node, path]
        after = next((i for i, time in enumerate(times) if time >= seconds - 1e-6), len(times) - 1)
        before = max(after - 1, 0)
        span = times[after] - times[before]
        share = min(max((seconds - times[before]) / span, 0.0), 1.0) if span > 0 else 1.0
        if path == "rotation":
            return quaternion_of(rows[before]).slerp(quaternion_of(rows[after]), share)
        return Vector(rows[before]).lerp(Vector(rows[after]), share)

    def worlds(self, seconds=None):
        """By node, at a moment, or as the nodes stand without the clip."""
        worlds = {}
        for node, parent in self.order:
            here = self.nodes[node]
            place = Vector(here.get("translation", (0, 0, 0)))
            turn = quaternion_of(here.get("rotation", (0, 0, 0, 1)))
            if seconds is not None:
                place = self._value(node, "translation", seconds, place)
                turn = self._value(node, "rotation", seconds, turn)
            local = Matrix.Translation(place) @ turn.to_matrix().to_4x4()
            worlds[node] = worlds[parent] @ local if parent is not None else local
        return worlds

    def nodes_by_name(self):
        return {self.nodes[node].get("name", ""): node for node, _ in self.order[1:]}

    def root(self):
        return self.order[0][0]

    def resize(self, factor):
        """Everything that many times as large."""
        for node in self.nodes:
            if "translation" in node:
                node["translation"] = [factor * x for x in node["translation"]]
        for (_, path), (_, rows) in self.tracks.items():
            if path == "translation":
                rows[:] = [tuple(factor * x for x in row) for row in rows]


# The executable.


def program(context):
    addon = context.preferences.addons.get(__name__)
    given = addon.preferences.program if addon else ""
    found = bpy.path.abspath(given) if given else os.environ.get("LUTKA") or shutil.which("lutka")
    if not found or not os.path.exists(found):
        raise Trouble("The program lutka was not found: tell the add-on's preferences where it is")
    return found


def run(context, *arguments):
    done = subprocess.run([program(context), *map(str, arguments)], capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        raise Trouble(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"lutka ended with {done.returncode}")
    return done.stdout


def standing(armature):
    """Where the figure stands and which way it is turned, level: what the executable need not know."""
    place, turn, _ = armature.matrix_world.decompose()
    return Matrix.Translation((place.x, place.y, 0)) @ Matrix.Rotation(turn.to_euler("XYZ").z, 4, "Z")


def export_armature(context, armature, path):
    """The armature on the origin in its rest pose with the meshes that it moves, and nothing else."""
    meshes = [thing for thing in context.scene.objects
              if thing.type == "MESH" and (thing.find_armature() == armature or thing.parent == armature)]
    if not meshes:
        raise Trouble(f"No mesh follows {armature.name}: a ragdoll is fitted to the skin")
    picked, active, position = context.selected_objects[:], context.view_layer.objects.active, armature.data.pose_position
    places = [(thing, thing.matrix_world.copy()) for thing in [armature, *meshes]]
    back = standing(armature).inverted()
    try:
        armature.data.pose_position = "REST"
        bpy.ops.object.select_all(action="DESELECT")
        for thing, place in places:
            thing.matrix_world = back @ place
            context.view_layer.update()
            thing.select_set(True)
        context.view_layer.objects.active = armature
        bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", use_selection=True, export_animations=False,
                                  export_apply=False, export_yup=True)
    finally:
        armature.data.pose_position = position
        bpy.ops.object.select_all(action="DESELECT")
        for thing, place in places:
            thing.matrix_world = place
            context.view_layer.update()
        for thing in picked:
            thing.select_set(True)
        context.view_layer.objects.active = active


# Back into Blender.


def bones_of(armature, clip):
    """Pairs of bone and node of one name; what moves no joint of the file is left as it is."""
    nodes = clip.nodes_by_name()
    pairs = [(bone, nodes[bone.name]) for bone in armature.data.bones if bone.name in nodes]
    if not pairs:
        raise Trouble("No bone of the armature is in the clip")
    return pairs


def fit_to(clip, pairs, exported_from_armature):
    """lutka may have moved the whole figure to the origin and taken another unit than a metre for it. Brings the clip to the armature's
    size. Returns lutka's model space from the exported file's, both in that size, and Blender's units a metre."""
    heads = [GLTF_FROM_BLENDER @ (exported_from_armature @ bone.head_local) for bone, _ in pairs]
    size = max((head - heads[0]).length for head in heads)

    def bind():
        worlds = clip.worlds()
        to_model = worlds[clip.root()].inverted()
        return [(to_model @ worlds[node]).translation for _, node in pairs]

    joints = bind()
    units = size / max(max((joint - joints[0]).length for joint in joints), 1e-9)
    clip.resize(units)
    shifts = [joint - head for joint, head in zip(bind(), heads)]
    if max((shift - shifts[0]).length for shift in shifts) > 0.01 * size:
        raise Trouble("The bones do not stand where the file has them: apply the armature's rotation and scale first")
    return Matrix.Translation(shifts[0]), units


class Placing:
    """From the clip's frames to matrices in the scene, where the figure stands."""

    def __init__(self, armature, clip):
        self.clip, self.armature = clip, armature
        self.pairs = bones_of(armature, clip)
        self.standing = standing(armature)
        self.shift, self.units = fit_to(clip, self.pairs, self.standing.inverted() @ armature.matrix_world)
        bind = clip.worlds()
        to_model = bind[clip.root()].inverted()
        self.bind = {node: to_model @ bind[node] for _, node in self.pairs}
        self.stay = Matrix.Identity(4)
        # The figure falls where it stands, not in the middle of the world.
        bone, node = self.pairs[0]
        rest = armature.matrix_world @ bone.head_local
        moved = self.deform(clip.worlds(0.0), node) @ rest
        self.stay = Matrix.Translation((rest.x - moved.x, rest.y - moved.y, 0))

    def deform(self, worlds, node):
        """What takes a joint's skin from the rest pose to the clip's, in the scene."""
        of_file = worlds[node] @ self.bind[node].inverted() @ self.shift
        return self.stay @ self.standing @ BLENDER_FROM_GLTF @ of_file @ GLTF_FROM_BLENDER @ self.standing.inverted()

    def poses(self, seconds):
        """Each bone's matrix relative to its rest (what keys hold), by name."""
        worlds = self.clip.worlds(seconds)
        into = self.armature.matrix_world.inverted()
        nodes = {bone.name: node for bone, node in self.pairs}
        posed, basis = {}, {}
        for bone in self._parents_first():
            rest = bone.matrix_local
            if bone.name in nodes:
                matrix = into @ self.deform(worlds, nodes[bone.name]) @ self.armature.matrix_world @ rest
            elif bone.parent:
                matrix = posed[bone.parent.name] @ bone.parent.matrix_local.inverted() @ rest
            else:
                matrix = rest.copy()
            posed[bone.name] = matrix
            if bone.parent:
                above = posed[bone.parent.name] @ bone.parent.matrix_local.inverted() @ rest
                basis[bone.name] = above.inverted() @ matrix
            else:
                basis[bone.name] = rest.inverted() @ matrix
        return basis

    def _parents_first(self):
        order = [bone for bone in self.armature.data.bones if bone.parent is None]
        for bone in order:
            order += bone.children
        return order


def bake_action(context, armature, placing, start):
    """A new action on the armature, a key a frame of the scene from `start` on. Returns the last frame."""
    fps = context.scene.render.fps / context.scene.render.fps_base
    count = int(round(placing.clip.seconds * fps)) + 1
    keys = {}
    before = {}
    for i in range(count):
        for name, matrix in placing.poses(i / fps).items():
            place, turn, _ = matrix.decompose()
            if name in before:
                turn.make_compatible(before[name])
            before[name] = turn
            keys.setdefault(name, []).append((*place, *turn))
    armature.animation_data_create()
    action = bpy.data.actions.new(f"{armature.name} ragdoll")
    armature.animation_data.action = action
    for name, rows in keys.items():
        armature.pose.bones[name].rotation_mode = "QUATERNION"
        bone = f'pose.bones["{bpy.utils.escape_identifier(name)}"]'
        for axis in range(3):  # the rest pose's size: the pose that the armature stands in may have another
            curve = action.fcurves.new(f"{bone}.scale", index=axis, action_group=name)
            curve.keyframe_points.insert(start, 1.0)
        for path, first, width in (("location", 0, 3), ("rotation_quaternion", 3, 4)):
            for axis in range(width):
                curve = action.fcurves.new(f"{bone}.{path}", index=axis, action_group=name)
                curve.keyframe_points.add(count)
                flat = [value for i, row in enumerate(rows) for value in (start + i, row[first + axis])]
                curve.keyframe_points.foreach_set("co", flat)
                for point in curve.keyframe_points:
                    point.interpolation = "LINEAR"
                curve.update()
    return start + count - 1


def add_rigid_bodies(context, armature, placing, script, profile, drive):
    """The script's bodies and joints, moved to where the armature stands, in a collection of their own."""
    before = set(bpy.data.objects)
    built = runpy.run_path(script, run_name="lutka_doll")
    bodies = built["build"](None)
    made = [thing for thing in bpy.data.objects if thing not in before]
    context.view_layer.update()
    # The script stands the figure on the origin, facing -y; the root body tells where it belongs.
    root = profile["bodies"][0]
    joint = next((node for bone, node in placing.pairs if bone.name == root["joint"]), None)
    if joint is None:
        raise Trouble(f"The ragdoll's root {root['joint']} is no bone of the armature")
    frame = root["jointFromBody"]
    size = Matrix.Scale(placing.units, 4)
    joint_from_body = Matrix.Translation(placing.units * Vector(frame["translation"])) @ quaternion_of(frame["rotation"]).to_matrix().to_4x4()
    target = placing.standing @ BLENDER_FROM_GLTF @ placing.shift.inverted() @ placing.bind[joint] @ joint_from_body
    place, turn, _ = (size @ built["matrix"](built["BODIES"][0][3])).decompose()
    move = target @ (Matrix.Translation(place) @ turn.to_matrix().to_4x4()).inverted() @ size
    group = bpy.data.collections.new(f"{armature.name} ragdoll")
    context.scene.collection.children.link(group)
    for thing in made:
        thing.matrix_world = move @ thing.matrix_world
        group.objects.link(thing)
        context.scene.collection.objects.unlink(thing)
    context.view_layer.update()
    if drive:
        built["drive"](armature, bodies)
    return group


class LUTKA_OT_ragdoll(bpy.types.Operator):
    """Let the picked armature fall: a baked action, and rigid bodies"""

    bl_idname = "lutka.ragdoll"
    bl_label = "Ragdoll"
    bl_options = {"REGISTER", "UNDO"}

    scene: EnumProperty(name="Scene", items=[(name, name, "") for name in SCENES], default="drop",
                        description="What it falls on")
    seconds: FloatProperty(name="Seconds", default=3.0, min=0.1, max=600.0, description="How long it falls")
    seed: IntProperty(name="Seed", default=1, min=0, description="Another seed, another fall; 0 stands nearly upright")
    action: BoolProperty(name="Action", default=True, description="Bake the fall into an action of the armature")
    bodies: BoolProperty(name="Rigid bodies", default=True, description="Make the ragdoll's rigid bodies and joints")
    drive: BoolProperty(name="Bones follow the bodies", default=False,
                        description="The bones copy the rigid bodies, in place of the baked action")
    any_rig: BoolProperty(name="Any skeleton", default=False,
                          description="A creature, a hand, a chain: bodies by the bones themselves, not by the parts of a human")
    folder: StringProperty(name="Keep files in", subtype="DIR_PATH", description="Empty: they are removed afterwards")

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and context.active_object is not None and context.active_object.type == "ARMATURE"

    def execute(self, context):
        folder = bpy.path.abspath(self.folder) if self.folder else tempfile.mkdtemp(prefix="lutka_")
        try:
            self.work(context, context.active_object, folder)
        except Trouble as trouble:
            self.report({"ERROR"}, str(trouble))
            return {"CANCELLED"}
        finally:
            if not self.folder:
                shutil.rmtree(folder, ignore_errors=True)
        return {"FINISHED"}

    def work(self, context, armature, folder):
        os.makedirs(folder, exist_ok=True)
        model, profile, clip, script = (os.path.join(folder, name) for name in
                                        ("model.glb", "model.ragdoll.json", "fall.glb", "doll.py"))
        export_armature(context, armature, model)
        run(context, "build", model, "-o", profile, *(["--rig", "any"] if self.any_rig else []))
        run(context, "simulate", model, "--profile", profile, "--scene", self.scene, "--seed", self.seed,
            "--seconds", self.seconds, "--out", clip)
        placing = Placing(armature, Clip(clip))
        if self.bodies or self.drive:
            run(context, "export", model, "--profile", profile, "--format", "blender", "-o", script)
            with open(profile, encoding="utf-8") as file:
                document = json.load(file)
            add_rigid_bodies(context, armature, placing, script, document, self.drive)
        if self.action and not self.drive:
            start = context.scene.frame_current
            last = bake_action(context, armature, placing, start)
            context.scene.frame_end = max(context.scene.frame_end, last)


class LUTKA_PT_panel(bpy.types.Panel):
    bl_label = "Ragdoll"
    bl_idname = "LUTKA_PT_panel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Lutka"

    def draw(self, context):
        picked = context.active_object
        if picked is None or picked.type != "ARMATURE":
            self.layout.label(text="Pick an armature", icon="INFO")
        self.layout.operator(LUTKA_OT_ragdoll.bl_idname, icon="ARMATURE_DATA")


class LUTKA_preferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: StringProperty(name="lutka", subtype="FILE_PATH", description="The executable; empty: the one on the PATH")

    def draw(self, context):
        self.layout.prop(self, "program")


CLASSES = (LUTKA_preferences, LUTKA_OT_ragdoll, LUTKA_PT_panel)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)


if __name__ == "__main__":
    register()
