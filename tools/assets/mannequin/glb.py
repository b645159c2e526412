"""Writes a binary glTF 2.0 file: one skinned mesh, its materials, its joints and clips."""
import json
import struct

import numpy as np

_COMPONENT = {np.dtype("float32"): 5126, np.dtype("uint16"): 5123, np.dtype("uint8"): 5121}
_SHAPE = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
_VERTEX_DATA, _INDEX_DATA = 34962, 34963


class Document:
    def __init__(self, generator):
        self.json = {"asset": {"version": "2.0", "generator": generator}, "scene": 0, "scenes": [], "nodes": [], "meshes": [],
                     "materials": [], "skins": [], "animations": [], "accessors": [], "bufferViews": [], "buffers": []}
        self.blob = bytearray()

    def accessor(self, array, target=None, bounds=False):
        """Stores an array of shape (N,) or (N, k) and returns its accessor's index."""
        array = np.ascontiguousarray(array)
        width = 1 if array.ndim == 1 else array.shape[1]
        view = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": array.nbytes}
        if target:
            view["target"] = target
        self.blob += array.tobytes()
        self.blob += b"\0" * (-len(self.blob) % 4)
        self.json["bufferViews"].append(view)
        entry = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": _COMPONENT[array.dtype],
                 "count": len(array), "type": _SHAPE[width]}
        if bounds:
            rows = array.reshape(len(array), -1)
            entry["min"], entry["max"] = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def primitive(self, material, positions, normals, uv, joints, weights, triangles):
        attributes = {"POSITION": self.accessor(positions.astype("float32"), _VERTEX_DATA, bounds=True),
                      "NORMAL": self.accessor(normals.astype("float32"), _VERTEX_DATA),
                      "TEXCOORD_0": self.accessor(uv.astype("float32"), _VERTEX_DATA),
                      "JOINTS_0": self.accessor(joints.astype("uint8"), _VERTEX_DATA),
                      "WEIGHTS_0": self.accessor(weights.astype("float32"), _VERTEX_DATA)}
        indices = self.accessor(triangles.astype("uint16").ravel(), _INDEX_DATA)
        return {"attributes": attributes, "indices": indices, "material": material, "mode": 4}

    def clip(self, name, times, channels):
        """`channels`: (node, "rotation" or "translation", values)."""
        clock = self.accessor(np.asarray(times, dtype="float32"), bounds=True)
        entry = {"name": name, "samplers": [], "channels": []}
        for node, path, values in channels:
            output = self.accessor(np.asarray(values, dtype="float32"))
            entry["channels"].append({"sampler": len(entry["samplers"]), "target": {"node": node, "path": path}})
            entry["samplers"].append({"input": clock, "output": output, "interpolation": "LINEAR"})
        self.json["animations"].append(entry)

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.blob)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.blob)))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self.blob), b"BIN\0") + bytes(self.blob))
