"""Body parts, front and back apart: the charts that the texture coordinates are made of."""
import numpy as np

from . import skeleton as sk

TRUNK, HEAD, ARM, HAND, LEG, FOOT, SOLE, FIRST_FINGER = range(8)


def _finger_of(figure, points):
    """Index of the finger that a point of the hand belongs to, -1 on the palm."""
    result, nearest = np.full(len(points), -1), np.full(len(points), .006)
    for k, name in enumerate(figure.fingers):
        chain = np.array(sk.THUMB if name == "Thumb" else sk.FINGERS[name])
        first = 1 if name == "Thumb" else 0
        axis = chain[first + 1] - chain[first]
        axis /= np.linalg.norm(axis)
        distance = figure.finger(name, points)
        mine = (distance < nearest) & ((points - chain[first]) @ axis > .004)
        result[mine], nearest = k, np.where(mine, distance, nearest)
    return result


def labels(figure, vertices, triangles, normals):
    """A number for each triangle of the left half: twice the part, plus one on its front, top or back of the hand."""
    centre, normal = vertices[triangles].mean(axis=1), normals[triangles].sum(axis=1)
    x, y, z = centre.T
    arm_field = np.minimum(figure.arm(centre), figure.hand(centre))
    arm = (arm_field < np.minimum(figure.torso(centre), figure.leg(centre))) & (x > .15)
    hand = arm & ((centre - sk.WRIST) @ sk.FOREARM_AXIS > 0)
    leg = (y < .93) & ~arm & (.673 * x - .74 * (y - .835) > 0)
    foot = leg & (y - .25 * (z - sk.ANKLE[2]) < .108)
    sole = (y < .03) & (normal[:, 1] < -1.5)
    finger = np.where(hand, _finger_of(figure, centre), -1)
    part = np.select([finger >= 0, hand, arm, sole, foot, leg, y + .34 * z > 1.514],
                     [FIRST_FINGER + finger, HAND, ARM, SOLE, FOOT, LEG, HEAD], TRUNK)
    along = (centre - sk.SHOULDER) @ sk.ARM_AXIS
    middle = np.select([part == LEG, part == FOOT, part == ARM],
                       [np.interp(y, [.08, .5, .9], [-.026, .004, 0]), sk.ANKLE[2] - .004,
                        sk.SHOULDER[2] + np.maximum(0, along - sk.UPPER_ARM) * np.tan(sk.ELBOW_BEND)], -.005)
    front = np.where(part >= FIRST_FINGER, normal @ sk.ARM_UP > 0, np.where(part == HAND, normal @ sk.ARM_UP > 0, z > middle))
    return part * 2 + (front & (part != SOLE))
