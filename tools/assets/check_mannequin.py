#!/usr/bin/env python3
"""Checks assets/models/mannequin.glb and prints every fault found; exit code 1 when there is one.

    python3 tools/assets/check_mannequin.py [MODEL.glb]

Reads the file alone, with none of the code that made it.
"""
import json
import os
import struct
import sys

import numpy as np

DEFAULT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "assets", "models", "mannequin.glb")
BODY_JOINTS = ["hips", "spine", "chest", "upperChest", "neck", "head"] + [
    side + part for side in ("left", "right") for part in
    ["Shoulder", "UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot", "Toes", "ThumbMetacarpal", "ThumbProximal", "ThumbDistal"]
    + [f + p for f in ("Index", "Middle", "Ring", "Little") for p in ("Proximal", "Intermediate", "Distal")]]
CLIPS = ["idle", "walk", "run", "get_up_prone", "get_up_supine", "get_up_left", "get_up_right", "stumble_forward", "stumble_backward"]
_TYPES = {5126: "<f4", 5125: "<u4", 5123: "<u2", 5121: "u1"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Model:
    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        magic, version, total = struct.unpack_from("<4sII", data)
        if magic != b"glTF" or version != 2 or total != len(data):
            raise ValueError("not a whole binary glTF 2.0 file")
        length = struct.unpack_from("<I", data, 12)[0]
        self.json, self.blob = json.loads(data[20:20 + length]), data[28 + length:]
        self.nodes = self.json["nodes"]

    def array(self, index):
        entry = self.json["accessors"][index]
        view = self.json["bufferViews"][entry["bufferView"]]
        width = _WIDTHS[entry["type"]]
        start = view.get("byteOffset", 0) + entry.get("byteOffset", 0)
        flat = np.frombuffer(self.blob, _TYPES[entry["componentType"]], entry["count"] * width, start)
        return flat.reshape(-1, width) if width > 1 else flat

    def mesh(self):
        """All primitives in one: attributes stacked, triangles over them."""
        parts, triangles, start = {}, [], 0
        for primitive in self.json["meshes"][0]["primitives"]:
            for name, accessor in primitive["attributes"].items():
                parts.setdefault(name, []).append(self.array(accessor).astype(float))
            triangles.append(self.array(primitive["indices"]).reshape(-1, 3).astype(int) + start)
            start += len(parts["POSITION"][-1])
        return {name: np.vstack(p) for name, p in parts.items()}, np.vstack(triangles)

    def globals(self, overrides=None):
        """modelFromNode of every node; `overrides`: (node, path) -> value."""
        result = {}

        def visit(index, parent):
            node = self.nodes[index]
            t = (overrides or {}).get((index, "translation"), node.get("translation", (0, 0, 0)))
            r = (overrides or {}).get((index, "rotation"), node.get("rotation", (0, 0, 0, 1)))
            result[index] = parent @ _matrix(t, r)
            for child in node.get("children", []):
                visit(child, result[index])

        for root in self.json["scenes"][0]["nodes"]:
            visit(root, np.eye(4))
        return result

    def skinned(self, mesh, overrides=None):
        skin, nodes = self.json["skins"][0], self.globals(overrides)
        inverse = self.array(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1).astype(float)
        palette = np.stack([nodes[j] for j in skin["joints"]]) @ inverse
        points = np.column_stack([mesh["POSITION"], np.ones(len(mesh["POSITION"]))])
        joints = mesh["JOINTS_0"].astype(int)
        return sum(mesh["WEIGHTS_0"][:, k, None] * np.einsum("nij,nj->ni", palette[joints[:, k]], points)[:, :3] for k in range(4))


def _matrix(t, q):
    x, y, z, w = np.array(q, dtype=float) / np.linalg.norm(q)
    m = np.eye(4)
    m[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    m[:3, 3] = t
    return m


def _weld(positions):
    return np.unique(np.round(positions * 1e6).astype(np.int64), axis=0, return_inverse=True)


def check_tree(model, expect):
    document = model.json
    expect(len(document["skins"]) == 1, "exactly one skin")
    expect(len(document["meshes"]) == 1, "exactly one mesh")
    names = [node["name"] for node in model.nodes]
    expect(len(set(names)) == len(names), "node names are unique")
    joints = [names[j] for j in document["skins"][0]["joints"]]
    expect(sorted(joints) == sorted(BODY_JOINTS), f"the {len(BODY_JOINTS)} VRM joint names")
    root = model.nodes[document["scenes"][0]["nodes"][0]]
    expect(len(document["scenes"][0]["nodes"]) == 1 and root["name"] == "mannequin", "one root, named mannequin")
    expect(not {"translation", "rotation", "scale", "matrix"} & set(root), "the root is the identity")
    expect(all("scale" not in n and "matrix" not in n for n in model.nodes), "no node has a scale")
    expect(len(document["materials"]) >= 2 and all("pbrMetallicRoughness" in m for m in document["materials"]), "two PBR materials or more")
    expect([clip["name"] for clip in document["animations"]] == CLIPS, "the clips " + ", ".join(CLIPS))


def check_surface(mesh, triangles, expect):
    p, uv = mesh["POSITION"], mesh["TEXCOORD_0"]
    expect(8000 <= len(triangles) <= 20000, f"8,000 to 20,000 triangles (has {len(triangles)})")
    height = p[:, 1].max() - p[:, 1].min()
    expect(1.70 <= height <= 1.80, f"1.70 to 1.80 m tall (is {height:.4f})")
    expect(abs(p[:, 1].min()) < 1e-3, f"the soles are at y = 0 (are at {p[:, 1].min():.5f})")
    expect(np.abs(np.linalg.norm(mesh["NORMAL"], axis=1) - 1).max() < 1e-4, "normals have unit length")
    corner = p[triangles]
    cross = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    area = np.linalg.norm(cross, axis=1) / 2
    expect(area.min() > 1e-8, f"no degenerate triangle (smallest {area.min() * 1e6:.3f} mm2)")
    facing = (cross / (2 * area[:, None]) * mesh["NORMAL"][triangles].mean(axis=1)).sum(axis=1)
    expect(facing.min() > 0, f"normals and triangles face the same way (worst cosine {facing.min():.2f})")
    welded = _weld(p)[1].reshape(-1)[triangles]
    edges = np.vstack([welded[:, [0, 1]], welded[:, [1, 2]], welded[:, [2, 0]]])
    forward = edges[:, 0] * (welded.max() + 1) + edges[:, 1]
    backward = edges[:, 1] * (welded.max() + 1) + edges[:, 0]
    expect(len(np.unique(forward)) == len(forward), "each directed edge belongs to one triangle")
    expect(np.array_equal(np.sort(forward), np.sort(backward)), "watertight: each edge has two triangles")
    count = len(np.unique(welded))
    expect(count - len(forward) // 2 + len(triangles) == 2, "one closed surface without handles (Euler number 2)")
    expect(uv.min() >= 0 and uv.max() <= 1, "texture coordinates lie in [0, 1]")
    flat = uv[triangles]
    d1, d2 = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    uv_area = (d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]) / 2
    expect(np.abs(uv_area).min() > 1e-10, "no triangle vanishes in the texture")
    print(f"  texture: {np.abs(uv_area).sum() * 100:.0f} % used; area ratio p5..p95 of its median "
          f"{np.percentile(np.abs(uv_area) / area, 5) / np.median(np.abs(uv_area) / area):.2f}.."
          f"{np.percentile(np.abs(uv_area) / area, 95) / np.median(np.abs(uv_area) / area):.2f}")


def check_weights(model, mesh, expect):
    weights, joints = mesh["WEIGHTS_0"], mesh["JOINTS_0"].astype(int)
    expect(weights.shape[1] == 4 and (weights >= 0).all(), "four influences at most, none negative")
    expect(np.abs(weights.sum(axis=1) - 1).max() < 1e-6, "the weights of each vertex sum to 1")
    expect(joints.max() < len(model.json["skins"][0]["joints"]), "joint indices are in range")
    used = np.unique(joints[weights > 0])
    expect(len(used) == len(BODY_JOINTS), "every joint moves some of the skin")
    moved = np.linalg.norm(model.skinned(mesh) - mesh["POSITION"], axis=1).max()
    expect(moved < 1e-5, f"the nodes' pose is the bind pose (skin moves by {moved:.2e} m)")


def _dense(mesh, first):
    table = np.zeros((len(mesh["POSITION"]), len(BODY_JOINTS)))
    for k in range(4):
        np.add.at(table, (np.arange(len(table)), mesh["JOINTS_0"][:, k].astype(int)), mesh["WEIGHTS_0"][:, k])
    return table[first]


def check_symmetry(model, mesh, expect):
    _, first = np.unique(np.round(mesh["POSITION"] * 1e6).astype(np.int64), axis=0, return_index=True)
    p, n, weights = mesh["POSITION"][first], mesh["NORMAL"][first], _dense(mesh, first)
    image = p * [-1, 1, 1]
    order, other = np.lexsort(np.round(p * 1e5).T), np.lexsort(np.round(image * 1e5).T)
    expect(np.abs(p[order] - image[other]).max() < 1e-4, "positions are mirror-symmetric to 1e-4 m")
    expect(np.abs(n[order] - (n * [-1, 1, 1])[other]).max() < 1e-3, "normals are mirror-symmetric")
    names = [model.nodes[j]["name"] for j in model.json["skins"][0]["joints"]]
    swap = [names.index(m.replace("left", "\0").replace("right", "left").replace("\0", "right")) for m in names]
    expect(np.abs(weights[order] - weights[:, swap][other]).max() < 1e-3, "weights are mirror-symmetric")
    place = {model.nodes[k]["name"]: m[:3, 3] for k, m in model.globals().items()}
    pairs = [np.abs(place[m] * [-1, 1, 1] - place[names[swap[i]]]).max() for i, m in enumerate(names)]
    expect(max(pairs) < 1e-4, "joints are mirror-symmetric to 1e-4 m")
    expect(place["leftHand"][0] > 0 and place["leftToes"][2] > place["leftFoot"][2], "left is +X, forward is +Z")


def _first_of(model, name, target):
    clip = next(c for c in model.json["animations"] if c["name"] == name)
    channel = next(c for c in clip["channels"] if c["target"] == target)
    return model.array(clip["samplers"][channel["sampler"]]["output"]).astype(float)[0]


LOOPS = ("idle", "walk", "run")  # the others end standing, in idle's first pose
SINK = .03  # m: clips of key frames, whose toes and fingers roll over the floor


def check_clip(model, mesh, clip, expect):
    name, tracks = clip["name"], []
    loops = name in LOOPS
    for channel in clip["channels"]:
        sampler = clip["samplers"][channel["sampler"]]
        values = model.array(sampler["output"]).astype(float)
        tracks.append((channel["target"]["node"], channel["target"]["path"], values))
        first = _first_of(model, "idle", channel["target"]) if not loops else values[0]
        ends = first @ values[-1] if channel["target"]["path"] == "rotation" else 1 - np.abs(first - values[-1])[1]
        expect(abs(ends) > 1 - (1e-5 if loops else 1e-2), f"{name}: node {channel['target']['node']} ends as {'it' if loops else 'idle'} began")
        if channel["target"]["path"] == "rotation":
            expect(np.abs(np.linalg.norm(values, axis=1) - 1).max() < 1e-4, f"{name}: unit quaternions")
    times = model.array(clip["samplers"][0]["input"])
    expect(times[0] == 0 and (np.diff(times) > 0).all(), f"{name}: times start at 0 and rise")
    lowest = []
    for key in range(len(times)):
        points = model.skinned(mesh, {(node, path): values[key] for node, path, values in tracks})
        expect(np.isfinite(points).all(), f"{name}: finite at key {key}")
        lowest.append(points[:, 1].min())
    most, least = (.05 if name == "run" else .015), (-.015 if loops else -SINK)
    expect(max(lowest) < most and min(lowest) > least, f"{name}: the lowest point stays near the floor "
           f"({min(lowest) * 1000:.1f} to {max(lowest) * 1000:.1f} mm)")
    print(f"  clip {name}: {times[-1]:.3f} s, {len(times)} keys, lowest point {min(lowest) * 1000:.1f} to {max(lowest) * 1000:.1f} mm")


def main():
    path = sys.argv[1] if len(sys.argv) > 1 else DEFAULT
    faults = []

    def expect(condition, what):
        if not condition and what not in faults:
            faults.append(what)

    model = Model(path)
    mesh, triangles = model.mesh()
    check_tree(model, expect)
    expect(all(np.isfinite(a).all() for a in mesh.values()), "all vertex data are finite")
    if not faults:  # what follows relies on the names and on numbers
        check_surface(mesh, triangles, expect)
        check_weights(model, mesh, expect)
        check_symmetry(model, mesh, expect)
        for clip in model.json["animations"]:
            check_clip(model, mesh, clip, expect)
    for fault in faults:
        print("FAULT, expected: " + fault)
    print(f"{os.path.basename(path)}: {len(triangles)} triangles, {len(mesh['POSITION'])} vertices, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
