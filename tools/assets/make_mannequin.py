#!/usr/bin/env python3
"""Makes assets/models/mannequin.glb, Lutka's default character. Needs Python 3 and numpy, nothing else.

    tools/assets/make_mannequin [OUTPUT.glb]

The same machine and numpy give the same bytes on every run.
"""
import os
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # sums in one order: the file must not depend on the number of cores

import numpy as np  # noqa: E402

from mannequin import clips, fields, moves, paint, parts, remesh, surface, unwrap  # noqa: E402
from mannequin.figure import Figure  # noqa: E402
from mannequin import skeleton as sk  # noqa: E402
from mannequin.glb import Document  # noqa: E402
from mannequin.skeleton import joints as make_joints  # noqa: E402
from mannequin.skin import skin_weights  # noqa: E402

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
OUTPUT = os.path.join(ROOT, "assets", "models", "mannequin.glb")
CELL = 0.004  # m, of the first grid: small enough for the gaps between the fingers
# name, linear base colour, roughness
MATERIALS = [("mannequin_body", (.640, .455, .290), .55), ("mannequin_joint", (.045, .040, .040), .60),
             ("mannequin_accent", (.780, .190, .035), .45)]


def normals_of(figure):
    def normals(points):
        slope = fields.gradient(figure, points)
        slope[points[:, 0] == 0, 0] = 0
        return slope / np.linalg.norm(slope, axis=1, keepdims=True)
    return normals


def half_surface(figure):
    """Vertices and triangles of the left half, remeshed and cut along the materials' borders."""
    vertices, triangles = surface.polygonise(figure, (0, -.02, -.20), (.80, 1.80, .25), CELL)

    def project(points, rounds=2):
        return surface.project(figure, fields.gradient, points, rounds)

    vertices, triangles = remesh.remesh(vertices, triangles, figure.size, project, normals_of(figure))
    for line in paint.Paint(figure).lines():
        vertices, triangles = remesh.cut(vertices, triangles, line, project)
    return project(vertices, 6), triangles


def mirror(vertices, triangles):
    """The welded figure, the index of every vertex's mirror image, and triangles of both halves (left first)."""
    seam = vertices[:, 0] == 0
    count = len(vertices)
    twin = np.arange(count)
    twin[~seam] = count + np.arange((~seam).sum())
    whole = np.vstack([vertices, vertices[~seam] * [-1, 1, 1]])
    back = np.concatenate([twin, np.flatnonzero(~seam)])
    return whole, back, np.vstack([triangles, twin[triangles][:, ::-1]])


def add_mesh(document, material, half, uv_half, weights, normals, triangles_of):
    """One primitive a material; `half` maps texture-split vertices of the left half to welded ones."""
    primitives = []
    for index in range(len(MATERIALS)):
        parts = {key: [] for key in ("vertex", "uv", "triangles")}
        start = 0
        for flip in (False, True):
            corner, vertex = triangles_of(material == index, flip)
            used, local = np.unique(corner, return_inverse=True)
            parts["vertex"].append(vertex[used])
            parts["uv"].append(uv_half[used] if not flip else [1, 0] + uv_half[used] * [-1, 1])
            parts["triangles"].append(local.reshape(-1, 3) + start)
            start += len(used)
        vertex = np.concatenate(parts["vertex"])
        order = np.argsort(-weights[vertex], axis=1, kind="stable")[:, :4]
        share = np.take_along_axis(weights[vertex], order, axis=1)
        order = np.where(share > 0, order, 0)
        primitives.append(document.primitive(index, half[vertex], normals[vertex], np.vstack(parts["uv"]), order,
                                             exact_sums(share), np.vstack(parts["triangles"])))
    document.json["meshes"].append({"name": "mannequin", "primitives": primitives})


def exact_sums(share):
    """Rounds weights to multiples of 2^-16, so that each vertex's sum is 1 exactly in single precision."""
    steps = np.round(share / share.sum(axis=1, keepdims=True) * 65536)
    steps[:, 0] += 65536 - steps.sum(axis=1)
    return steps / 65536


def add_skeleton(document, joints):
    """Nodes 0: root, 1: mesh, 2...: joints. Returns the node of every joint."""
    nodes = document.json["nodes"]
    nodes += [{"name": "mannequin", "children": [1, 2]}, {"name": "mannequin_mesh", "mesh": 0, "skin": 0}]
    index = {j.name: i for i, j in enumerate(joints)}
    inverse = []
    for j in joints:
        parent = joints[index[j.parent]] if j.parent else None
        frame = parent.rotation if parent else np.eye(3)
        offset = frame.T @ (j.position - (parent.position if parent else 0))
        turn = clips.quaternion(frame.T @ j.rotation)
        node = {"name": j.name, "translation": offset.round(9).tolist(), "rotation": turn.round(9).tolist()}
        children = [2 + index[k.name] for k in joints if k.parent == j.name]
        if children:
            node["children"] = children
        nodes.append(node)
        bind = np.eye(4)
        bind[:3, :3], bind[:3, 3] = j.rotation.T, -j.rotation.T @ j.position
        inverse.append(bind.T.ravel())
    document.json["skins"] = [{"name": "mannequin", "skeleton": 2, "joints": list(range(2, 2 + len(joints))),
                               "inverseBindMatrices": document.accessor(np.array(inverse, dtype="float32"))}]


def lowest_point(joints, vertices, weights):
    """The function that moves.sample_moves() wants: over the skin of all but hands and feet, with a thousandth of the weights."""
    ends = [k for k, j in enumerate(joints) if any(part in j.name for part in ("Hand", "Foot", "Toes", "Thumb", *sk.FINGERS))]
    pick = np.flatnonzero(weights[:, ends].sum(axis=1) < .3)[::4]
    points, share = np.column_stack([vertices[pick], np.ones(len(pick))]), weights[pick]
    index = {j.name: k for k, j in enumerate(joints)}

    def lowest(quaternions, hips):
        frames, heights = [], np.zeros(len(pick))
        for k, j in enumerate(joints):
            parent = joints[index[j.parent]] if j.parent else None
            local = np.eye(4)
            local[:3, :3] = clips.matrix(quaternions[k])
            local[:3, 3] = parent.rotation.T @ (j.position - parent.position) if parent else hips
            frames.append(frames[index[j.parent]] @ local if parent else local)
            bind = np.eye(4)
            bind[:3, :3], bind[:3, 3] = j.rotation.T, -j.rotation.T @ j.position
            heights += share[:, k] * (points @ (frames[k] @ bind)[1])
        return heights.min()

    return lowest


def add_clips(document, joints, vertices, weights):
    def add(name, times, rotations, hips):
        channels = [(2, "translation", hips)] + [(2 + k, "rotation", rotations[:, k]) for k in range(len(joints))]
        document.clip(name, times, channels)

    for name, pose_at, seconds, frames in (("idle", clips.idle_pose, clips.IDLE_SECONDS, clips.IDLE_FRAMES),
                                           ("walk", clips.walk_pose, clips.WALK_SECONDS, clips.WALK_FRAMES),
                                           ("run", clips.run_pose, clips.RUN_SECONDS, clips.RUN_FRAMES)):
        add(name, *clips.sample(joints, pose_at, seconds, frames))
    lowest = lowest_point(joints, vertices, weights)
    for name, make in moves.MOVES:
        add(name, *moves.sample_moves(joints, make(joints), lowest))


def build(path):
    figure, joints = Figure(), make_joints()
    half, half_triangles = half_surface(figure)
    whole, back, triangles = mirror(half, half_triangles)
    half_normals = normals_of(figure)(half)
    normals = np.vstack([half_normals, half_normals[half[:, 0] != 0] * [-1, 1, 1]])
    weights = skin_weights(figure, whole, triangles, back, [j.name for j in joints])
    chart = unwrap.charts(half_triangles, parts.labels(figure, half, half_triangles, half_normals))
    vertex, uv, corner = unwrap.unwrap(half, half_triangles, chart)
    material = paint.Paint(figure).material(half[half_triangles].mean(axis=1))

    def triangles_of(pick, flip):
        return (corner[pick][:, ::-1], back[vertex]) if flip else (corner[pick], vertex)

    document = Document("Lutka tools/assets/make_mannequin")
    document.json["scenes"] = [{"name": "mannequin", "nodes": [0]}]
    document.json["materials"] = [{"name": n, "pbrMetallicRoughness": {"baseColorFactor": [*c, 1.0], "metallicFactor": 0.0,
                                                                      "roughnessFactor": r}} for n, c, r in MATERIALS]
    add_mesh(document, material, whole, uv, weights, normals, triangles_of)
    add_skeleton(document, joints)
    add_clips(document, joints, whole, weights)
    document.write(path)
    print(f"{os.path.relpath(path)}: {len(triangles)} triangles, {len(whole)} vertices, {len(joints)} joints, "
          f"{chart.max() + 1} charts a side")


if __name__ == "__main__":
    build(sys.argv[1] if len(sys.argv) > 1 else OUTPUT)
