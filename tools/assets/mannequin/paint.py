"""Where the materials lie: smooth fields over the figure whose zero lines become edges of the mesh.

Negative inside. `joints` marks the dark articulations, `accent` the coloured lines and the mark on the chest.
"""
import numpy as np

from . import skeleton as sk

BODY, JOINT, ACCENT = range(3)


def _band(coordinate, centre, half):
    return np.abs(coordinate - centre) - half


class Paint:
    """Bands are limited to their own limb, since a plane across an elbow also crosses the body."""

    def __init__(self, figure):
        self.figure = figure

    def _on_arm(self, p):
        return np.minimum(self.figure.arm(p), self.figure.hand(p)) - .02

    def bands(self, p):
        """Articulations as (coordinate minus centre, half width, limb mask) triples."""
        x, y, z = np.abs(p[:, 0]), p[:, 1], p[:, 2]
        q = np.column_stack([x, y, z])
        arm = self._on_arm(q)
        s = (q - sk.SHOULDER) @ sk.ARM_AXIS
        wrist = (q - sk.WRIST) @ sk.FOREARM_AXIS
        leg = np.where(y < .7, -1.0, 1.0)
        trunk = np.where(arm < 0, 1.0, -1.0)
        neck = y + .30 * z - 1.503
        waist = y - 1.085 - .35 * x * x / .13 + .02
        return [(s - sk.UPPER_ARM, .036, arm), (wrist - .000, .018, arm), (y - .494 - .12 * z, .046, leg),
                (y - .108 - .25 * (z - sk.ANKLE[2]), .017, np.where((y < .3) & (z < .06), -1.0, 1.0)), (neck, .022, trunk),
                (waist, .040, trunk)]

    def joint(self, p):
        return np.min([np.maximum(np.abs(c) - half, mask) for c, half, mask in self.bands(p)], axis=0)

    def chest_mark(self, p):
        ring = np.abs(np.hypot(p[:, 0], p[:, 1] - 1.335) - .026) - .0075
        return np.where(p[:, 2] > 0, ring, 1.0)

    def lines(self):
        """Fields to cut the mesh along, in order."""
        return [self.joint, self.chest_mark]

    def material(self, centres):
        kind = np.where(self.joint(centres) < 0, JOINT, BODY)
        return np.where(self.chest_mark(centres) < 0, ACCENT, kind)
