"""The figure's shape: lofts, cones and ellipsoids placed by anatomy and blended into one distance field.

Only x >= 0 is modelled (see skeleton.py for the axes). Body proportions: 7.5 heads, height 1.75 m.
"""
import numpy as np

from . import skeleton as sk
from .fields import Cone, Ellipsoid, Loft, carve, union

X, Y, Z = np.eye(3)
MARK_HEIGHT = 1.345  # of the mark on the chest
ARMPIT = np.array([.170, 1.320, -.018])
# Balls (centre, radius) at shoulder and hip; where they cut the surface, discs of the joints' material lie.
CAPS = [(sk.SHOULDER + [.034, .018, 0], .056), (sk.HIP + [.044, .000, .002], .060)]

# (y, centre x, centre z, half width twice, depth to the front, depth to the back)
TORSO = [
    (0.858, 0, .000, .085, .085, .058, .072), (0.890, 0, .000, .140, .140, .086, .098),
    (0.930, 0, .000, .164, .164, .094, .104), (0.975, 0, .002, .163, .163, .096, .094),
    (1.020, 0, .006, .148, .148, .092, .084), (1.070, 0, .008, .132, .132, .087, .078),
    (1.115, 0, .006, .127, .127, .087, .080), (1.165, 0, .002, .133, .133, .093, .088),
    (1.230, 0, -.004, .148, .148, .102, .098), (1.300, 0, -.010, .162, .162, .107, .104),
    (1.365, 0, -.018, .168, .168, .100, .098), (1.415, 0, -.024, .154, .154, .082, .084),
    (1.450, 0, -.028, .108, .108, .062, .066), (1.475, 0, -.028, .062, .062, .050, .052)]
NECK = [
    (1.420, 0, -.036, .066, .066, .055, .050), (1.465, 0, -.024, .058, .058, .055, .055),
    (1.510, 0, -.010, .053, .053, .053, .056), (1.560, 0, .002, .053, .053, .050, .060),
    (1.600, 0, .004, .053, .053, .045, .062)]
FACE = [
    (1.528, 0, .044, .027, .027, .050, .030), (1.540, 0, .038, .038, .038, .060, .036),
    (1.560, 0, .032, .049, .049, .066, .045), (1.585, 0, .026, .057, .057, .071, .060),
    (1.615, 0, .020, .063, .063, .076, .075), (1.645, 0, .014, .066, .066, .080, .078),
    (1.675, 0, .006, .062, .062, .078, .072), (1.700, 0, .000, .046, .046, .058, .050)]

# Along the arm from the shoulder joint: (s, centre up, centre forward, radii up, down, forward, back).
ARM_BEND = np.tan(sk.ELBOW_BEND)
ARM = [(s, 0.0, max(0.0, s - sk.UPPER_ARM) * ARM_BEND, *r) for s, r in (
    (-.030, (.044, .040, .044, .044)), (.020, (.057, .050, .058, .056)), (.065, (.057, .046, .057, .054)),
    (.110, (.050, .044, .052, .051)), (.160, (.043, .043, .050, .049)), (.205, (.039, .041, .047, .046)),
    (.250, (.036, .037, .040, .040)), (.285, (.037, .035, .037, .039)), (.315, (.042, .036, .040, .038)),
    (.350, (.043, .037, .042, .037)), (.390, (.039, .035, .040, .034)), (.430, (.033, .031, .036, .030)),
    (.475, (.027, .026, .031, .026)), (.510, (.022, .022, .028, .025)), (.540, (.020, .020, .027, .025)),
    (.560, (.019, .019, .027, .025)))]
PALM = [
    (-.012, .000, .000, .018, .018, .024, .023), (.010, .000, .001, .0175, .018, .028, .025),
    (.035, .001, .001, .0160, .0165, .035, .033), (.060, .001, .000, .0145, .0145, .040, .038),
    (.080, .001, .000, .0130, .0125, .042, .040), (.090, .001, .000, .0115, .0110, .041, .038)]

# Down the leg: (y, centre x, centre z, radii outward, inward, to the front, to the back).
LEG = [
    (0.960, .092, .000, .060, .050, .060, .070), (0.900, .093, .000, .077, .080, .084, .086),
    (0.840, .094, .003, .079, .080, .088, .086), (0.770, .096, .006, .076, .073, .085, .080),
    (0.690, .098, .008, .069, .066, .078, .071), (0.620, .100, .008, .061, .060, .069, .062),
    (0.560, .102, .007, .053, .055, .060, .056), (0.515, .1035, .006, .050, .051, .056, .050),
    (0.485, .104, .004, .050, .050, .054, .049), (0.450, .105, -.002, .047, .048, .050, .051),
    (0.410, .106, -.008, .050, .050, .048, .059), (0.355, .1075, -.013, .053, .052, .047, .066),
    (0.300, .109, -.016, .049, .046, .045, .061), (0.240, .111, -.020, .041, .038, .042, .049),
    (0.180, .113, -.023, .034, .032, .038, .039), (0.125, .115, -.025, .031, .031, .036, .036),
    (0.085, .116, -.026, .033, .034, .038, .037), (0.055, .116, -.026, .033, .034, .040, .038)]
# Along the foot from under the ankle: (s, centre side, centre y, outward, inward, up, down); the sole is cut flat at y = 0.
FOOT = [
    (-.040, -.001, .030, .028, .028, .034, .036), (-.010, -.001, .032, .033, .032, .048, .040),
    (.030, .000, .030, .035, .033, .053, .038), (.065, .003, .026, .040, .036, .040, .034),
    (.100, .003, .022, .046, .042, .026, .030), (.130, .002, .017, .049, .046, .019, .025),
    (.155, .001, .015, .047, .044, .013, .022)]
# Toes: start and end in the foot's frame (side, along, height), radii.
TOES = [((-.029, .135, .017), (-.031, .190, .0135), .0165, .0128), ((-.006, .142, .014), (-.008, .188, .0105), .0118, .0098),
        ((.010, .138, .013), (.010, .178, .0098), .0110, .0092), ((.0255, .130, .012), (.027, .167, .0092), .0105, .0086),
        ((.039, .120, .011), (.042, .152, .0085), .0100, .0080)]


def foot_point(side, along, height):
    return sk.ANKLE * [1, 0, 1] + side * sk.FOOT_SIDE + along * sk.FOOT_AXIS + [0, height, 0]


class Figure:
    """Callable: distance to the whole surface. The parts stay reachable, for weights, edge lengths and materials."""

    def __init__(self):
        self.torso = Loft((0, 0, 0), X, Z, Y, TORSO, (.018, .025), power=2.25)
        self.neck = Loft((0, 0, 0), X, Z, Y, NECK, (.03, .03))
        self.face = Loft((0, 0, 0), X, Z, Y, FACE, (.014, .03), power=2.1)
        self.skull = Ellipsoid((0, 1.658, -.002), (.0765, .092, .097))
        self.forehead = Ellipsoid((0, 1.690, .042), (.056, .046, .049))
        self.arm = Loft(sk.SHOULDER, sk.ARM_UP, sk.FORWARD, sk.ARM_AXIS, ARM, (.03, .02))
        self.palm = Loft(sk.WRIST, sk.ARM_UP, sk.HAND_SIDE, sk.FOREARM_AXIS, PALM, (.015, .008), power=2.5)
        self.leg = Loft((0, 0, 0), X, Z, -Y, [(-r[0], *r[1:]) for r in LEG], (.05, .03))
        self.foot = Loft(sk.ANKLE * [1, 0, 1], sk.FOOT_SIDE, Y, sk.FOOT_AXIS, FOOT, (.038, .02), power=2.5)
        self.toes = [Cone(foot_point(*a), foot_point(*b), ra, rb) for a, b, ra, rb in TOES]
        self.fingers = {"Thumb": self._finger(sk.THUMB, sk.THUMB_RADII)}
        for name, points in sk.FINGERS.items():
            self.fingers[name] = self._finger(points, sk.FINGER_RADII[name])
        self._muscles()

    @staticmethod
    def _finger(points, radii):
        points = list(points)
        points[-1] = points[-1] + (points[-2] - points[-1]) / np.linalg.norm(points[-2] - points[-1]) * radii[-1]
        return [Cone(points[k], points[k + 1], radii[k], radii[k + 1]) for k in range(3)]

    def _muscles(self):
        """(field, blend) of what lies on the torso; all are on the left and mirrored."""
        self.muscles = [
            (Ellipsoid((.080, 1.342, .050), (.086, .060, .034), _turned(-8, -16)), .050),   # pectoralis
            (Ellipsoid((.088, 1.335, -.080), (.070, .088, .034), _turned(10, 12)), .060),   # scapula
            (Ellipsoid((.112, 1.250, -.045), (.045, .110, .060), _turned(-8, 0)), .050),    # latissimus
            (Ellipsoid((.076, .918, -.054), (.078, .082, .060)), .050),                     # gluteus
            (Cone((.018, 1.500, -.030), (.150, 1.440, -.024), .034, .036), .060),           # trapezius
            (Cone((.028, 1.424, .036), (.165, 1.452, .000), .011, .013), .036),             # clavicle
        ]
        self.eye = Ellipsoid((.036, 1.636, .108), (.030, .014, .020), _turned(0, 22))
        self.nose = Cone((0, 1.650, .086), (0, 1.603, .1005), .0075, .0110)
        self.brow = Cone((0, 1.662, .082), (.046, 1.660, .064), .010, .009)
        self.chin = Ellipsoid((0, 1.538, .078), (.022, .015, .018))
        self.mouth = Ellipsoid((0, 1.573, .078), (.032, .022, .017))

    def body(self, p):
        """Torso, neck and head."""
        mirrored = p * [-1, 1, 1]
        d = self.torso(p)
        for field, blend in self.muscles:
            both = union(field(p), field(mirrored), blend)
            d = union(d, both, blend)
        d = union(d, self.neck(p), .045)
        return union(d, self.head(p), .012)

    def head(self, p):
        mirrored = p * [-1, 1, 1]
        d = union(self.skull(p), self.face(p), .06)
        d = union(d, self.forehead(p), .035)
        d = union(d, union(self.brow(p), self.brow(mirrored), .01), .022)
        d = carve(d, union(self.eye(p), self.eye(mirrored), .005), .026)
        d = union(d, self.chin(p), .024)
        d = union(d, self.mouth(p), .036)
        return union(d, self.nose(p), .018)

    def finger(self, name, p):
        a, b, c = (part(p) for part in self.fingers[name])
        return union(union(a, b, .004), c, .004)

    def hand(self, p):
        d = self.palm(p)
        thumb = self.finger("Thumb", p)
        d = union(d, thumb, .020)
        others = [self.finger(n, p) for n in sk.FINGERS]
        web = others[0]
        for other in others[1:]:
            web = union(web, other, .003)
        return union(d, web, .010)

    def whole_foot(self, p):
        d = self.foot(p)
        toes = self.toes[0](p)
        for toe in self.toes[1:]:
            toes = union(toes, toe(p), .005)
        return union(d, toes, .014)

    def legs(self, p):
        d = union(self.leg(p), self.whole_foot(p), .035)
        return -union(-d, p[:, 1], .006)

    def __call__(self, p):
        p = np.column_stack([np.abs(p[:, 0]), p[:, 1:]])
        upper_leg = self.leg(p * [-1, 1, 1])
        d = self.body(p)
        d = union(d, union(self.legs(p), upper_leg, .020), .030)
        d = union(d, self.arm(p), .034)
        return union(d, self.hand(p), .012)

    def size(self, p):
        """Wanted edge length in metres."""
        size = np.full(len(p), .0195)
        arm = self.arm.coordinates(p)[:, 2]
        limb = self.arm(p) < .02
        size = np.where(limb, np.interp(arm, [0, .15, .28, .40, .52], [.019, .0165, .0135, .0135, .010]), size)
        leg = (p[:, 1] < .86) & (p[:, 0] < .3)
        size = np.where(leg, np.interp(p[:, 1], [.04, .10, .25, .40, .50, .60, .86], [.010, .012, .015, .016, .014, .018, .020]), size)
        foot = leg & (p[:, 1] < .07) & (p[:, 2] > .09)
        size = np.where(foot, .0075, size)
        palm = self.palm(p) < .012
        size = np.where(palm & (arm > .53), .0085, size)
        fingers = np.min([self.finger(n, p) for n in self.fingers], axis=0) < .004
        size = np.where(fingers, .0060, size)
        mark = (np.hypot(p[:, 0], p[:, 1] - MARK_HEIGHT) < .055) & (p[:, 2] > 0)
        size = np.where(mark, .0090, size)
        size = np.where(np.linalg.norm(p - ARMPIT, axis=1) < .060, .0140, size)
        for centre, radius in CAPS:
            size = np.where(np.abs(np.linalg.norm(p - centre, axis=1) - radius) < .012, .0120, size)
        tips = np.min([chain[2](p) + .02 * (chain[2].parameter(p) < .55) for chain in self.fingers.values()], axis=0) < .003
        size = np.where(tips, .0046, size)
        head = p[:, 1] > 1.46
        front = (p[:, 2] > .05) & (p[:, 1] > 1.53)
        return 1.06 * np.where(head, np.where(front, .0090, .0150), size)


def _turned(about_z, about_y):
    """Rows: the axes of an ellipsoid turned by degrees about z, then y."""
    a, b = np.radians(about_z), np.radians(about_y)
    rz = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    ry = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    return (ry @ rz).T
