"""Skin weights: smooth partitions along each limb, spread a little over the surface (never through the air), four a vertex.

Weights are worked out for the left half and mirrored; vertices are those of the welded figure.
"""
import numpy as np

from . import skeleton as sk
from .fields import smoothstep
from .figure import ARMPIT


class Weights:
    """A dense (vertices, joints) table addressed by joint name."""

    def __init__(self, count, names):
        self.names = list(names)
        self.table = np.zeros((count, len(self.names)))

    def add(self, name, value):
        self.table[:, self.names.index(name)] += value


def _steps(coordinate, borders):
    """Shares of the pieces of a chain: `borders` are (position, half width), the shares sum to 1."""
    rises = [np.ones(len(coordinate))] + [smoothstep(b - h, b + h, coordinate) for b, h in borders] + [np.zeros(len(coordinate))]
    return [rises[k] * (1 - rises[k + 1]) for k in range(len(borders) + 1)]


def _torso(weights, p, share):
    x, y, z = p.T
    level = y + .35 * np.maximum(z, -.04) * smoothstep(1.50, 1.54, y) - .25 * x * smoothstep(1.40, 1.46, y)
    parts = _steps(level, [(1.045, .060), (1.155, .060), (1.285, .065), (1.462, .032), (1.548, .024)])
    clavicle = .85 * smoothstep(.045, .150, x) * smoothstep(1.335, 1.430, y)
    for name, part in zip(sk.SPINE, parts):
        if name in ("chest", "upperChest"):
            weights.add("leftShoulder", share * part * clavicle)
            part = part * (1 - clavicle)
        weights.add(name, share * part)


def _leg(weights, p, share):
    along = (p - sk.ANKLE) @ sk.FOOT_AXIS
    knee = p[:, 1] - .2 * (p[:, 2] - sk.KNEE[2])
    upper, lower = _steps(-knee, [(-sk.KNEE[1], .048)])
    foot = smoothstep(-.034, .034, .084 - p[:, 1] + .30 * along)
    toes = smoothstep(-.016, .016, along - .128)
    weights.add("leftUpperLeg", share * upper)
    weights.add("leftLowerLeg", share * lower * (1 - foot))
    weights.add("leftFoot", share * lower * foot * (1 - toes))
    weights.add("leftToes", share * lower * foot * toes)


def _bend_planes(points):
    """Unit normals of the planes that halve the angles of a chain of points, one for each but the last."""
    steps = np.diff(points, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    normals = np.vstack([steps[:1], steps[:-1] + steps[1:]])
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def _hand(weights, figure, p, share):
    names = list(figure.fingers)
    distance = np.stack([figure.finger(n, p) for n in names])
    nearest = np.exp(-(distance - distance.min(axis=0)) / .0012)
    nearest /= nearest.sum(axis=0)
    rest = share.copy()
    for name, near in zip(names, nearest):
        points = np.array(sk.THUMB if name == "Thumb" else sk.FINGERS[name])
        planes = _bend_planes(points)
        width = (.014, .009, .008) if name == "Thumb" else (.009, .0065, .0055)
        rise = [smoothstep(-w, w, (p - c) @ n) for c, n, w in zip(points, planes, width)]
        if name == "Thumb":
            near = near * smoothstep(-.012, .006, figure.palm(p) - distance[0])
        parts = [rise[0] * (1 - rise[1]), rise[0] * rise[1] * (1 - rise[2]), rise[0] * rise[1] * rise[2]]
        labels = ("Metacarpal", "Proximal", "Distal") if name == "Thumb" else ("Proximal", "Intermediate", "Distal")
        for label, part in zip(labels, parts):
            weights.add("left" + name + label, share * near * part)
            rest -= share * near * part
    weights.add("leftHand", rest)


def _arm(weights, figure, p, share):
    s = (p - sk.SHOULDER) @ sk.ARM_AXIS
    upper, lower = _steps(s, [(sk.UPPER_ARM, .036)])
    hand = smoothstep(-.022, .018, (p - sk.WRIST) @ sk.FOREARM_AXIS)
    weights.add("leftUpperArm", share * upper)
    weights.add("leftLowerArm", share * lower * (1 - hand))
    _hand(weights, figure, p, share * lower * hand)


def _left_half(figure, p, names):
    weights = Weights(len(p), names)
    x, y, z = p.T
    # The shoulder: right of an upright plane through acromion and armpit, and on the arm rather than on the flank below it.
    arm_field = np.minimum(figure.arm(p), figure.hand(p))
    torso_field = np.minimum(figure.torso(p), figure.leg(p))
    arm = smoothstep(.134, .214, x) * smoothstep(-.030, .020, torso_field - arm_field)
    # The hip: below an oblique plane from the crotch to the iliac crest, lower at the back (the fold under the gluteus).
    groin = .673 * x - .740 * (y - .835) - .30 * np.maximum(-z, 0)
    leg = smoothstep(-.058, .058, groin) * (1 - arm) * np.where(y > .79, smoothstep(-.004, .030, x), 1)
    leg = np.where(y < 1.02, leg, 0) * (arm_field > .02)
    _torso(weights, p, 1 - arm - leg)
    _leg(weights, p, leg)
    _arm(weights, figure, p, arm)
    return weights.table


def mirrored_columns(names):
    swap = {"left": "right", "right": "left"}
    other = [next((swap[s] + n[len(s):] for s in swap if n.startswith(s)), n) for n in names]
    return [names.index(n) for n in other]


def _spread(table, triangles, rounds, rate):
    """Averages with the neighbours along the surface; `rate` in 0..1, a number or one for each vertex."""
    edges = np.unique(np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1), axis=0)
    valence = np.bincount(edges.ravel(), minlength=len(table))[:, None]
    for _ in range(rounds):
        mean = np.zeros_like(table)
        np.add.at(mean, edges[:, 0], table[edges[:, 1]])
        np.add.at(mean, edges[:, 1], table[edges[:, 0]])
        table = (1 - rate) * table + rate * mean / valence
    return table


def _four_largest(table, seam, columns):
    """On the seam left and right count alike, so a pair is kept or dropped as one."""
    table = np.where(table < .004, 0, table)
    score = np.where(seam[:, None], table + table[:, columns] * (np.array(columns) != np.arange(len(columns))), table)
    order = np.argsort(-score, axis=1, kind="stable")
    for row in range(len(table)):
        kept = set()
        for j in order[row]:
            group = {j, columns[j]} if seam[row] else {j}
            if table[row, j] > 0 and len(kept | group) <= 4:
                kept |= group
        table[row, [j for j in range(table.shape[1]) if j not in kept]] = 0
    return table / table.sum(axis=1, keepdims=True)


def skin_weights(figure, vertices, triangles, mirror_of, names):
    """(vertices, joints) weights. `mirror_of` is the index of each vertex's mirror image, itself on the seam."""
    columns = mirrored_columns(names)
    left = vertices[:, 0] >= 0
    folded = np.column_stack([np.abs(vertices[:, 0]), vertices[:, 1:]])
    table = _left_half(figure, folded, names)
    table = np.where(left[:, None], table, table[:, columns])
    seam = mirror_of == np.arange(len(vertices))
    table[seam] = .5 * (table[seam] + table[seam][:, columns])
    table = _spread(table, triangles, rounds=4, rate=.5)
    # The armpit is where the skin stretches most: the change from flank to arm is drawn out over a hand's breadth.
    armpit = 1 - smoothstep(.050, .115, np.linalg.norm(folded - ARMPIT, axis=1))
    table = _spread(table, triangles, rounds=24, rate=.6 * armpit[:, None])
    table = .5 * (table + table[mirror_of][:, columns])
    table = _four_largest(table, seam, columns)
    return np.where(left[:, None], table, table[mirror_of][:, columns])
