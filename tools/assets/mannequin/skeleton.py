"""Joints of the figure: names (VRM 1.0 humanoid), bind positions and local frames.

Metres, Y up, facing +Z, the character's left at +X, feet on y = 0. Only the left half is written down; the right half is its
mirror image. Every joint's local +Y points along the limb to the next joint; a positive turn about its +X flexes it
(hip and elbow forward, knee back, fingers to the palm; clavicle and foot up).
"""
import numpy as np

ARM_SLOPE = np.radians(42)     # arms below the horizontal in the bind pose
ELBOW_BEND = np.radians(7)     # forearm forward of the upper arm in the bind pose
FOOT_TURN = np.radians(6)      # toes outward
UPPER_ARM, FOREARM = 0.285, 0.252

ARM_AXIS = np.array([np.cos(ARM_SLOPE), -np.sin(ARM_SLOPE), 0])
ARM_UP = np.array([np.sin(ARM_SLOPE), np.cos(ARM_SLOPE), 0])   # away from the body, towards the back of the hand
FORWARD = np.array([0.0, 0, 1])
SHOULDER = np.array([0.184, 1.418, -0.018])
ELBOW = SHOULDER + UPPER_ARM * ARM_AXIS
FOREARM_AXIS = np.cos(ELBOW_BEND) * ARM_AXIS + np.sin(ELBOW_BEND) * FORWARD
HAND_SIDE = np.cos(ELBOW_BEND) * FORWARD - np.sin(ELBOW_BEND) * ARM_AXIS   # towards the thumb
WRIST = ELBOW + FOREARM * FOREARM_AXIS

HIP = np.array([0.090, 0.925, 0.000])
KNEE = np.array([0.104, 0.497, 0.008])
ANKLE = np.array([0.116, 0.082, -0.026])
FOOT_AXIS = np.array([np.sin(FOOT_TURN), 0, np.cos(FOOT_TURN)])
FOOT_SIDE = np.array([np.cos(FOOT_TURN), 0, -np.sin(FOOT_TURN)])
BALL = ANKLE * [1, 0, 1] + 0.128 * FOOT_AXIS + [0, 0.020, 0]
TOE_TIP = ANKLE * [1, 0, 1] + 0.208 * FOOT_AXIS + [0, 0.014, 0]

SPINE = {"hips": (0, 0.955, 0.000), "spine": (0, 1.050, 0.002), "chest": (0, 1.160, -0.004), "upperChest": (0, 1.290, -0.018),
         "neck": (0, 1.468, -0.022), "head": (0, 1.555, 0.002)}
HEAD_TOP = (0, 1.750, 0.010)


def hand_point(along, side, up):
    """From the hand's own frame: along the fingers from the wrist, towards the thumb, out of the back of the hand."""
    return WRIST + along * FOREARM_AXIS + side * HAND_SIDE + up * ARM_UP


def _finger(base, spread, lengths, curl):
    """Joints of one finger and its tip: `spread` towards the thumb and `curl` a joint towards the palm, both in degrees."""
    points, bend = [np.array(base, dtype=float)], 0.0
    for length, turn in zip(lengths, curl):
        bend += np.radians(turn)
        side = np.radians(spread)
        step = np.array([np.cos(bend) * np.cos(side), np.cos(bend) * np.sin(side), -np.sin(bend)])
        points.append(points[-1] + length * step)
    return [hand_point(*p) for p in points]


# Base in the hand's frame, spread, lengths of the three phalanges, curl of the three joints, radii at the four points.
FINGERS = {
    "Index": _finger((0.091, 0.0315, 0.000), 7, (0.041, 0.025, 0.020), (8, 9, 7)),
    "Middle": _finger((0.094, 0.0100, 0.002), 1.5, (0.045, 0.029, 0.021), (8, 9, 7)),
    "Ring": _finger((0.090, -0.0115, 0.001), -4.5, (0.041, 0.027, 0.020), (9, 10, 8)),
    "Little": _finger((0.082, -0.0310, -0.002), -12, (0.032, 0.020, 0.018), (10, 11, 8)),
}
THUMB = [hand_point(*p) for p in ((0.018, 0.020, -0.010), (0.052, 0.047, -0.020), (0.079, 0.064, -0.025), (0.104, 0.073, -0.027))]
FINGER_RADII = {"Index": (.0098, .0090, .0082, .0066), "Middle": (.0100, .0093, .0085, .0068),
                "Ring": (.0096, .0089, .0080, .0064), "Little": (.0086, .0078, .0070, .0057)}
THUMB_RADII = (.0150, .0122, .0112, .0080)


def _limb_joints(side):
    """(name, parent, position, end, flexion axis) of one side, positions of the left side."""
    across = np.array([1.0, 0, 0])
    rows = [("Shoulder", "upperChest", np.array([0.022, 1.430, 0.010]), SHOULDER, FORWARD),
            ("UpperArm", "Shoulder", SHOULDER, ELBOW, -ARM_UP), ("LowerArm", "UpperArm", ELBOW, WRIST, -ARM_UP),
            ("Hand", "LowerArm", WRIST, hand_point(0.094, 0.01, 0), -HAND_SIDE),
            ("UpperLeg", "hips", HIP, KNEE, -across), ("LowerLeg", "UpperLeg", KNEE, ANKLE, across),
            ("Foot", "LowerLeg", ANKLE, BALL, -across), ("Toes", "Foot", BALL, TOE_TIP, -across)]
    chains = {"Thumb": (THUMB, ("Metacarpal", "Proximal", "Distal"))}
    chains.update({n: (p, ("Proximal", "Intermediate", "Distal")) for n, p in FINGERS.items()})
    for finger, (points, parts) in chains.items():
        parent = "Hand"
        axis = ARM_UP if finger == "Thumb" else -HAND_SIDE
        for k, part in enumerate(parts):
            rows.append((finger + part, parent, points[k], points[k + 1], axis))
            parent = finger + part
    return [(side + name, parent if parent in SPINE else side + parent, start, end, axis) for name, parent, start, end, axis in rows]


def _frame(along, flexion):
    """Rotation matrix with +Y along the limb and +X as near to the flexion axis as that allows."""
    y = along / np.linalg.norm(along)
    x = flexion - (flexion @ y) * y
    x /= np.linalg.norm(x)
    return np.stack([x, y, np.cross(x, y)], axis=1)


class Joint:
    """A joint in the bind pose; `rotation` is modelFromJoint."""

    def __init__(self, name, parent, position, end, flexion):
        self.name, self.parent = name, parent
        self.position, self.end = np.array(position, dtype=float), np.array(end, dtype=float)
        self.rotation = _frame(self.end - self.position, np.array(flexion, dtype=float))


def joints():
    """All joints, parents before children."""
    names = list(SPINE)
    ends = [SPINE[n] for n in names[1:]] + [HEAD_TOP]
    result = [Joint(n, names[i - 1] if i else None, SPINE[n], ends[i], (1, 0, 0)) for i, n in enumerate(names)]
    mirror = np.array([-1.0, 1, 1])
    for name, parent, start, end, axis in _limb_joints("left"):
        result.append(Joint(name, parent, start, end, axis))
    for name, parent, start, end, axis in _limb_joints("right"):
        # Mirroring reverses the sense of a rotation: the flexion axis is mirrored and negated, so that equal angles flex both.
        result.append(Joint(name, parent, start * mirror, end * mirror, -axis * mirror))
    return result
