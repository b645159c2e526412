"""Signed-distance fields that the figure is modelled with.

Every field takes points of shape (N, 3) in metres and returns (N,) distances, negative inside. They are exact to first order
near the surface, which is what smooth unions and the projection of vertices need.
"""
import numpy as np


class Spline:
    """Cubic Hermite curve through rows (s, value, value, ...); constant beyond its ends."""

    def __init__(self, rows):
        table = np.array(rows, dtype=float)
        order = np.argsort(table[:, 0])
        self.knots, self.values = table[order, 0], table[order, 1:]
        step = np.diff(self.knots)[:, None]
        slope = np.diff(self.values, axis=0) / step
        inner = (slope[:-1] * step[1:] + slope[1:] * step[:-1]) / (step[1:] + step[:-1])
        self.tangents = np.vstack([slope[:1], inner, slope[-1:]])

    def __call__(self, s):
        s = np.clip(s, self.knots[0], self.knots[-1])
        i = np.clip(np.searchsorted(self.knots, s, side="right") - 1, 0, len(self.knots) - 2)
        width = self.knots[i + 1] - self.knots[i]
        t = ((s - self.knots[i]) / width)[:, None]
        width = width[:, None]
        return (self.values[i] * (1 + 2 * t) * (1 - t) ** 2 + self.tangents[i] * width * t * (1 - t) ** 2
                + self.values[i + 1] * t * t * (3 - 2 * t) + self.tangents[i + 1] * width * t * t * (t - 1))


class Loft:
    """Cross-sections along a straight axis.

    A row is (s, centreU, centreV, radius+U, radius-U, radius+V, radius-V): four radii a section, so that a calf can swell to the
    back only. `power` is the exponent of the section's superellipse (2: ellipse, more: boxier); `caps` are the lengths by which
    the two ends bulge out.
    """

    def __init__(self, origin, u, v, axis, rows, caps, power=2.0):
        self.origin = np.array(origin, dtype=float)
        self.frame = np.array([u, v, axis], dtype=float)
        self.spline, self.caps, self.power = Spline(rows), caps, power

    def coordinates(self, points):
        return (points - self.origin) @ self.frame.T

    def __call__(self, points):
        local = self.coordinates(points)
        low, high = self.spline.knots[0], self.spline.knots[-1]
        centre_u, centre_v, up, um, vp, vm = self.spline(local[:, 2]).T
        du, dv = local[:, 0] - centre_u, local[:, 1] - centre_v
        ru, rv = np.where(du > 0, up, um), np.where(dv > 0, vp, vm)
        over = np.where(local[:, 2] < low, (local[:, 2] - low) / self.caps[0],
                        np.where(local[:, 2] > high, (local[:, 2] - high) / self.caps[1], 0.0))
        cap = np.where(local[:, 2] < low, self.caps[0], self.caps[1])
        n = self.power
        a, b = np.abs(du / ru), np.abs(dv / rv)
        section = (a ** n + b ** n + 1e-12) ** (1 / n)
        level = np.sqrt(section ** 2 + over ** 2)
        ga, gb = (a / section) ** (n - 1) / ru, (b / section) ** (n - 1) / rv
        slope = np.sqrt((section * ga) ** 2 + (section * gb) ** 2 + (over / cap) ** 2) / level
        return (level - 1) / np.maximum(slope, 1 / np.maximum(ru, rv))


class Ellipsoid:
    """Axis-aligned unless `axes` (rows: the three directions) are given."""

    def __init__(self, centre, radii, axes=None):
        self.centre, self.radii = np.array(centre, dtype=float), np.array(radii, dtype=float)
        self.axes = np.eye(3) if axes is None else np.array(axes, dtype=float)

    def __call__(self, points):
        local = (points - self.centre) @ self.axes.T / self.radii
        level = np.linalg.norm(local, axis=1)
        slope = np.linalg.norm(local / self.radii, axis=1) + 1e-9
        return level * (level - 1) / slope


class Cone:
    """Round cone: the spheres between (start, radius) and (end, radius)."""

    def __init__(self, start, end, radius_start, radius_end):
        self.start, self.along = np.array(start, dtype=float), np.array(end, dtype=float) - np.array(start, dtype=float)
        self.radii = radius_start, radius_end

    def parameter(self, points):
        return (points - self.start) @ self.along / (self.along @ self.along)

    def __call__(self, points):
        h = np.clip(self.parameter(points), 0, 1)
        radius = self.radii[0] + (self.radii[1] - self.radii[0]) * h
        return np.linalg.norm(points - self.start - h[:, None] * self.along, axis=1) - radius


def union(a, b, blend):
    """Smooth minimum; `blend` is the width in metres over which two surfaces flow into each other."""
    h = np.maximum(blend - np.abs(a - b), 0) / blend
    return np.minimum(a, b) - h * h * blend / 4


def carve(a, b, blend):
    """`a` without `b`, smoothly."""
    return -union(-a, b, blend)


def smoothstep(low, high, x):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def gradient(field, points, step=2e-4):
    """Central differences, (N, 3), not normalised."""
    result = np.empty_like(points)
    for axis in range(3):
        offset = np.zeros(3)
        offset[axis] = step
        result[:, axis] = (field(points + offset) - field(points - offset)) / (2 * step)
    return result
