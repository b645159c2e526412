"""Where the materials lie: smooth fields over the figure whose zero lines become edges of the mesh.

Negative inside. `joints` marks the dark articulations, `accent` the coloured lines and the mark on the chest.
"""
import numpy as np

from . import skeleton as sk
from .figure import CAPS, MARK_HEIGHT

BODY, JOINT, ACCENT = range(3)


RING_RADIUS, RING_HALF = .028, .0085


class Paint:
    """Bands are limited to their own limb, since a plane across an elbow also crosses the body."""

    def __init__(self, figure):
        self.figure = figure

    def bands(self, p):
        """Articulations of the left half, each as (distance from the middle, half width, limb mask)."""
        x, y, z = p.T
        arm = np.minimum(self.figure.arm(p), self.figure.hand(p)) - .02
        leg = np.where(y < .7, -1.0, 1.0)
        ankle = np.where((y < .3) & (z < .06), -1.0, 1.0)
        return [((p - sk.SHOULDER) @ sk.ARM_AXIS - sk.UPPER_ARM, .034, arm), ((p - sk.WRIST) @ sk.FOREARM_AXIS, .017, arm),
                (y - .494 - .12 * z, .044, leg), (y - .108 - .25 * (z - sk.ANKLE[2]), .016, ankle),
                (y + .34 * z - 1.514, .017, np.maximum(-arm, x - .10))]

    def joint(self, p):
        p = np.column_stack([np.abs(p[:, 0]), p[:, 1:]])
        fields = [np.maximum(np.abs(c) - half, mask) for c, half, mask in self.bands(p)]
        fields += [np.linalg.norm(p - centre, axis=1) - radius for centre, radius in CAPS]
        # The abdomen: a lens between the arch of the ribs and the iliac crests.
        x2, y = p[:, 0] ** 2, p[:, 1]
        abdomen = np.maximum(y - 1.152 + 2.7 * x2, 1.040 + 1.9 * x2 - y)
        fields.append(np.where(p[:, 0] < .20, abdomen, 1.0))
        return np.min(fields, axis=0)

    def chest_mark(self, p):
        ring = np.abs(np.hypot(p[:, 0], p[:, 1] - MARK_HEIGHT) - RING_RADIUS) - RING_HALF
        return np.where(p[:, 2] > 0, ring, 1.0)

    def lines(self):
        """Fields to cut the mesh along, in order."""
        return [self.joint, self.chest_mark]

    def material(self, centres):
        kind = np.where(self.joint(centres) < 0, JOINT, BODY)
        return np.where(self.chest_mark(centres) < 0, ACCENT, kind)
