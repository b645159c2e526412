"""Posed key frames: the trunk by angles, hands and feet by where they are, and what lies between the keys.

A key is a dictionary; members that it leaves out go on from the key before it. Lengths in metres in the model's frame
(Y up), angles in degrees. Hands and feet are reached by two bones, so that what stands keeps its place between two keys
that give it the same place. Everything runs through its keys by monotone cubics (Fritsch and Carlson 1980): smooth, no
overshoot, and constant where two keys are equal.
"""
import numpy as np

from . import skeleton as sk
from .clips import Pose, about_x, about_y, about_z, matrix, quaternion

# `hips`: the joint's place. `turn`: of the hips from the bind pose, a matrix. `bend`: (forward, to the left, turn to the
# left) spread over spine, chest and upper chest. `look`: (down, to the left) spread over neck and head. Of each side:
# `hand`: the wrist's place; `palm`: where the palm looks; `fingers`: where the fingers point; `elbow`: where it sticks
# out; `foot`: the ankle's place; `sole`: turn of the foot from standing flat, a matrix; `knee`: where it sticks out;
# `toes`: degrees up; `shrug`: (up, forward) of the shoulder; `curl`: of the fingers.
MIRROR = np.diag([-1.0, 1, 1])


def euler(down=0.0, left=0.0, roll=0.0):
    """Forward by `down`, then over to the left side, then about the vertical to the left."""
    return about_y(left) @ about_z(-roll) @ about_x(down)


def _slopes(times, values):
    """Of monotone cubics, Fritsch-Carlson by the weighted harmonic mean; at rest at both ends."""
    step = np.diff(times)[:, None]
    rise = np.diff(values, axis=0) / step
    slopes = np.zeros_like(values)
    for k in range(1, len(times) - 1):
        a, b = rise[k - 1], rise[k]
        w1, w2 = 2 * step[k] + step[k - 1], step[k] + 2 * step[k - 1]
        same = a * b > 0
        with np.errstate(divide="ignore", invalid="ignore"):
            mean = (w1 + w2) / (w1 / a + w2 / b)
        slopes[k] = np.where(same, mean, 0)
    return slopes


def _between(times, values, t):
    values = np.asarray(values, dtype=float).reshape(len(times), -1)
    slopes = _slopes(times, values)
    k = int(np.clip(np.searchsorted(times, t, side="right") - 1, 0, len(times) - 2))
    h = times[k + 1] - times[k]
    s = np.clip((t - times[k]) / h, 0, 1)
    return ((1 + 2 * s) * (1 - s) ** 2 * values[k] + s * (1 - s) ** 2 * h * slopes[k]
            + s * s * (3 - 2 * s) * values[k + 1] + s * s * (s - 1) * h * slopes[k + 1])


def _matrices(times, values, t):
    """Rotations as quaternions without sign jumps, normalised."""
    turns = [quaternion(np.asarray(m, dtype=float)) for m in values]
    for k in range(1, len(turns)):
        if turns[k] @ turns[k - 1] < 0:
            turns[k] = -turns[k]
    turn = _between(times, turns, t)
    return matrix(turn / np.linalg.norm(turn))


def filled(keys):
    """Every key with all members."""
    result, last = [], {}
    for key in keys:
        last = {**last, **key}
        result.append(dict(last))
    return result


def mirrored(keys):
    """The same moves of the other side."""
    result = []
    for key in keys:
        other = {}
        for name, value in key.items():
            side = next((s for s in ("left", "right") if name.startswith(s)), None)
            target = name if side is None else {"left": "right", "right": "left"}[side] + name[len(side):]
            kind = name if side is None else name[len(side) + 1:]
            if kind in ("turn", "sole"):
                value = MIRROR @ np.asarray(value) @ MIRROR
            elif kind in ("hips", "hand", "palm", "fingers", "elbow", "foot", "knee"):
                value = np.asarray(value, dtype=float) * [-1, 1, 1]
            elif kind == "bend":
                value = (value[0], -value[1], -value[2])
            elif kind == "look":
                value = (value[0], -value[1])
            other[target] = value
        result.append(other)
    return result


def _limb_frame(joint, along, normal):
    y = along / np.linalg.norm(along)
    x = normal - (normal @ y) * y
    x /= np.linalg.norm(x)
    return np.stack([x, y, np.cross(x, y)], axis=1)


def _reach(pose, by_name, names, target, pole, signs, give):
    """Two bones to a place; the middle joint sticks out towards `pole`. `signs`: of the flexion axes against the bend's."""
    upper, lower, last = (by_name[n] for n in names)
    start = pose.solve()[1][upper.name]
    a, b = np.linalg.norm(lower.position - upper.position), np.linalg.norm(last.position - lower.position)
    way = target - start
    soft = give * (a + b)  # within this of its whole length the limb gives way softly, or its middle joint would snap
    length, end = max(np.linalg.norm(way), abs(a - b) + .02), .999 * (a + b)
    if length > end - soft:
        length = end - soft * np.exp(-(length - (end - soft)) / soft)
    along = way / np.linalg.norm(way)
    out = pole - (pole @ along) * along
    out /= np.linalg.norm(out)
    cosine = np.clip((a * a + length * length - b * b) / (2 * a * length), -1, 1)
    middle = start + a * (cosine * along + np.sqrt(1 - cosine ** 2) * out)
    tip = start + length * along
    normal = np.cross(out, along)
    pose.world[upper.name] = _limb_frame(upper, middle - start, signs[0] * normal)
    pose.world[lower.name] = _limb_frame(lower, tip - middle, signs[1] * normal)


class Moves:
    """Key frames over time; `times` rise from 0."""

    def __init__(self, times, keys):
        self.times, self.keys = np.array(times, dtype=float), filled(keys)
        assert len(self.times) == len(self.keys)

    @property
    def seconds(self):
        return float(self.times[-1])

    def value(self, name, t):
        return _between(self.times, [key[name] for key in self.keys], t)

    def pose(self, joints, t, lift=0.0):
        by_name, pose = {j.name: j for j in joints}, Pose(joints)
        pose.hips = self.value("hips", t) + [0, lift, 0] - by_name["hips"].position
        pose.turn["hips"] = _matrices(self.times, [key["turn"] for key in self.keys], t)
        forward, left, turn = self.value("bend", t)
        for name, share in (("spine", .3), ("chest", .35), ("upperChest", .35)):
            pose.turn[name] = about_y(turn * share) @ about_z(-left * share) @ about_x(forward * share)
        down, aside = self.value("look", t)
        for name, share in (("neck", .45), ("head", .55)):
            pose.turn[name] = about_y(aside * share) @ about_x(down * share)
        for side, sign in (("left", 1), ("right", -1)):
            self._arm(pose, by_name, side, sign, t)
            self._leg(pose, by_name, side, t)
        return pose

    def _arm(self, pose, by_name, side, sign, t):
        def value(kind):
            return self.value(f"{side}_{kind}", t)

        up, ahead = value("shrug")
        pose.turn[side + "Shoulder"] = about_z(sign * up) @ about_y(-sign * ahead)
        _reach(pose, by_name, [side + n for n in ("UpperArm", "LowerArm", "Hand")], value("hand"), value("elbow"), (1, 1),
               give=.05)
        fingers, palm = value("fingers"), value("palm")
        y = fingers / np.linalg.norm(fingers)
        z = palm - (palm @ y) * y
        z /= np.linalg.norm(z)
        pose.world[side + "Hand"] = np.stack([np.cross(y, z), y, z], axis=1)
        for finger in sk.FINGERS:
            for part, share in (("Proximal", .9), ("Intermediate", 1.2), ("Distal", .8)):
                pose.flex[side + finger + part] = float(value("curl")[0]) * share

    def _leg(self, pose, by_name, side, t):
        sole = _matrices(self.times, [key[side + "_sole"] for key in self.keys], t)
        _reach(pose, by_name, [side + n for n in ("UpperLeg", "LowerLeg", "Foot")], self.value(side + "_foot", t),
               self.value(side + "_knee", t), (-1, 1), give=.004)
        pose.world[side + "Foot"] = sole @ by_name[side + "Foot"].rotation
        pose.flex[side + "Toes"] = float(self.value(side + "_toes", t)[0])


def key_of(pose, joints):
    """The key that a pose is: where a clip begins or ends in another one's pose."""
    _, places, rotations = pose.solve()
    by_name = {j.name: j for j in joints}
    key = {"hips": places["hips"], "turn": rotations["hips"] @ by_name["hips"].rotation.T, "bend": (0, 0, 0), "look": (0, 0)}
    for side in ("left", "right"):
        for limb, kind, end, out in ((("UpperArm", "LowerArm", "Hand"), "hand", "Hand", "elbow"),
                                     (("UpperLeg", "LowerLeg", "Foot"), "foot", "Foot", "knee")):
            start, middle, tip = (places[side + n] for n in limb)
            along = (tip - start) / np.linalg.norm(tip - start)
            pole = (middle - start) - ((middle - start) @ along) * along
            key[f"{side}_{kind}"], key[f"{side}_{out}"] = places[side + end], pole / np.linalg.norm(pole)
        key[side + "_fingers"], key[side + "_palm"] = rotations[side + "Hand"][:, 1], rotations[side + "Hand"][:, 2]
        key[side + "_sole"] = rotations[side + "Foot"] @ by_name[side + "Foot"].rotation.T
        key[side + "_toes"], key[side + "_curl"], key[side + "_shrug"] = 0.0, 13.0, (4, 0)
    return key
