"""The clips `idle`, `walk` and `run`, worked out from gait figures, the legs by inverse kinematics so that the feet hold the floor.

Angles are in degrees. Phase runs from 0 to 1 over a clip; in `walk` and `run` the left foot strikes at phase 0.
"""
import numpy as np

from . import skeleton as sk

WALK_SECONDS, WALK_FRAMES = 32 / 30, 32
RUN_SECONDS, RUN_FRAMES = 22 / 30, 22
IDLE_SECONDS, IDLE_FRAMES = 4.0, 60
WALK_SPEED = 0.95        # m/s of the floor under the figure
RUN_SPEED, RUN_STANCE, RUN_STRIKE_AHEAD = 2.5, .35, .21
STANCE = 0.62            # share of the cycle that a foot is on the floor
STRIKE_AHEAD = 0.285     # m, of the flat foot's ankle ahead of the hips at heel strike
HEEL = np.array([0, -.082, -.060])   # pivots of the foot, from the ankle, foot flat
BALL = np.array([0, -.062, .128])    # the toe joint


def rotation(axis, degrees):
    axis, angle = np.asarray(axis, dtype=float), np.radians(degrees)
    axis = axis / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def about_x(degrees):
    return rotation((1, 0, 0), degrees)


def about_y(degrees):
    return rotation((0, 1, 0), degrees)


def about_z(degrees):
    return rotation((0, 0, 1), degrees)


def quaternion(m):
    """(x, y, z, w) of a rotation matrix, w >= 0."""
    w = np.sqrt(max(0.0, 1 + m[0, 0] + m[1, 1] + m[2, 2])) / 2
    if w > 1e-3:
        q = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 4 * w * w]) / (4 * w)
    else:
        values, vectors = np.linalg.eigh((m + m.T) / 2)
        axis = vectors[:, 2]
        q = np.array([*axis, 0.0])
    return q / np.linalg.norm(q)


def matrix(q):
    """The rotation matrix of a unit quaternion (x, y, z, w)."""
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


class Pose:
    """Turns away from the bind pose. `turn`: joint -> rotation in model axes as seen with its parent at rest; `flex`: joint ->
    degrees about its own X; `world`: joint -> modelFromJoint outright (feet and legs)."""

    def __init__(self, joints):
        self.joints = joints
        self.turn, self.flex, self.world, self.hips = {}, {}, {}, np.zeros(3)

    def solve(self):
        """Local rotations (joint order), and the joints' positions and rotations in the model."""
        by_name, rotations, positions, local = {j.name: j for j in self.joints}, {}, {}, []
        for j in self.joints:
            parent = by_name.get(j.parent)
            rest_parent = parent.rotation if parent else np.eye(3)
            now_parent = rotations[j.parent] if parent else np.eye(3)
            turned = rest_parent.T @ self.turn.get(j.name, np.eye(3)) @ j.rotation @ about_x(self.flex.get(j.name, 0))
            rotations[j.name] = self.world.get(j.name, now_parent @ turned)
            offset = rest_parent.T @ (j.position - parent.position) if parent else j.position + self.hips
            positions[j.name] = now_parent @ offset + (positions[j.parent] if parent else 0)
            local.append(now_parent.T @ rotations[j.name])
        return local, positions, rotations

    def plant(self, side, ankle, pitch, toe_pitch):
        """Two-bone inverse kinematics: the ankle to a place, the foot tipped by `pitch` (toes up), knee forward."""
        by_name = {j.name: j for j in self.joints}
        upper, lower, foot, toes = (by_name[side + n] for n in ("UpperLeg", "LowerLeg", "Foot", "Toes"))
        hip = self.solve()[1][upper.name]
        a, b = np.linalg.norm(lower.position - upper.position), np.linalg.norm(foot.position - lower.position)
        reach = ankle - hip
        length = min(np.linalg.norm(reach), .9995 * (a + b))
        along = reach / np.linalg.norm(reach)
        turn_out = about_y(3 if side == "left" else -3)
        across = turn_out @ np.array([1.0, 0, 0])
        across -= (across @ along) * along
        ahead = np.cross(across / np.linalg.norm(across), along)
        ahead = ahead if ahead[2] > 0 else -ahead
        cosine = np.clip((a * a + length * length - b * b) / (2 * a * length), -1, 1)
        knee = hip + a * (cosine * along + np.sqrt(1 - cosine ** 2) * ahead)
        for joint, start, end in ((upper, hip, knee), (lower, knee, hip + length * along)):
            y = (end - start) / np.linalg.norm(end - start)
            x = joint.rotation[0, 0] / abs(joint.rotation[0, 0]) * across
            x = x - (x @ y) * y
            x /= np.linalg.norm(x)
            self.world[joint.name] = np.stack([x, y, np.cross(x, y)], axis=1)
        self.world[foot.name] = about_x(-pitch) @ foot.rotation
        self.world[toes.name] = about_x(-toe_pitch) @ toes.rotation


def _blend(phase, knots):
    """Smooth interpolation through (phase, value) knots."""
    times, values = np.array(knots).T
    i = int(np.clip(np.searchsorted(times, phase, side="right") - 1, 0, len(times) - 2))
    t = (phase - times[i]) / (times[i + 1] - times[i])
    return values[i] + (values[i + 1] - values[i]) * t * t * (3 - 2 * t)


PITCH = [(0, 17), (.11, 0), (.36, 0), (STANCE, -38), (.74, -22), (.92, 14), (1, 17)]


def _stance_ankle(phase, pitch):
    """Ankle (y, z) while the heel or the ball rests on the floor, which runs backwards."""
    flat = np.array([0, sk.ANKLE[1], STRIKE_AHEAD - WALK_SPEED * WALK_SECONDS * phase])
    pivot = HEEL if pitch > 0 else BALL
    return flat + pivot - about_x(-pitch) @ pivot


def _walk_foot(phase):
    """Ankle offset in the sagittal plane, foot pitch and toe pitch."""
    phase %= 1.0
    pitch = _blend(phase, PITCH)
    if phase <= STANCE:
        return _stance_ankle(phase, pitch), pitch, max(pitch, 0.0)
    start, end = _stance_ankle(STANCE, PITCH[3][1]), _stance_ankle(0.0, PITCH[0][1])
    t = (phase - STANCE) / (1 - STANCE)
    drag = -WALK_SPEED * WALK_SECONDS * (1 - STANCE)
    z = (start[2] * (1 + 2 * t) * (1 - t) ** 2 + drag * t * (1 - t) ** 2 + end[2] * t * t * (3 - 2 * t) + drag * t * t * (t - 1))
    y = start[1] + (end[1] - start[1]) * t * t * (3 - 2 * t) + .045 * np.sin(np.pi * t) ** 2
    return np.array([0, y, z]), pitch, pitch * t * (1 - t) + max(pitch, 0) * t


def _arms_down(pose, swing, elbow, curl=1.0):
    """Arms hanging at the sides; `swing` (left, right) is degrees forward; `curl`: of the fingers, times the relaxed hand's."""
    for side, sign, ahead, bend in (("left", -1, swing[0], elbow[0]), ("right", 1, swing[1], elbow[1])):
        pose.turn[side + "Shoulder"] = about_z(sign * 4) @ about_y(-sign * .12 * ahead)
        pose.turn[side + "UpperArm"] = about_x(-ahead) @ about_z(sign * 29)
        pose.flex[side + "LowerArm"] = bend
        pose.turn[side + "Hand"] = about_z(-sign * 4)
        for finger in sk.FINGERS:
            for part, degrees in (("Proximal", 12), ("Intermediate", 16), ("Distal", 10)):
                pose.flex[side + finger + part] = curl * degrees


def walk_pose(joints, phase):
    pose, turn = Pose(joints), 2 * np.pi * phase
    # Lowest at the two heel strikes, and over the standing foot in between; the left foot stands in the first half.
    pose.hips = np.array([.016 * np.sin(turn), -.021 - .013 * np.cos(2 * turn), 0])
    yaw, drop = -6 * np.cos(turn), 3 * np.sin(turn)
    pose.turn["hips"] = about_y(yaw) @ about_z(-drop) @ about_x(2)
    for name, share in (("spine", .5), ("chest", .6), ("upperChest", .6)):
        pose.turn[name] = about_y(-yaw * share) @ about_z(drop * share * .7) @ about_x(.8)
    pose.turn["neck"], pose.turn["head"] = about_y(yaw * .35) @ about_x(-1), about_y(yaw * .3) @ about_x(-2.5)
    for side, sign, lag in (("left", 1, 0.0), ("right", -1, .5)):
        ankle, pitch, toes = _walk_foot(phase + lag)
        ankle = ankle + [sign * (sk.ANKLE[0] - .022), 0, 0]
        pose.plant(side, ankle, pitch, toes)
    swing = -20 * np.cos(turn)
    _arms_down(pose, (swing - 2, -swing - 2), (16 + .4 * swing, 16 - .4 * swing))
    return pose


RUN_PITCH = [(0, 4), (.07, 0), (.20, 0), (RUN_STANCE, -48), (.48, -72), (.68, -50), (.90, 6), (1, 4)]


def _run_foot(phase):
    """As _walk_foot; the heel comes up behind while the leg swings."""
    phase %= 1.0
    pitch = _blend(phase, RUN_PITCH)
    travel = RUN_SPEED * RUN_SECONDS

    def stance(at, tip):
        flat = np.array([0, sk.ANKLE[1], RUN_STRIKE_AHEAD - travel * at])
        pivot = HEEL if tip > 0 else BALL
        return flat + pivot - about_x(-tip) @ pivot

    if phase <= RUN_STANCE:
        return stance(phase, pitch), pitch, max(pitch, 0.0)
    start, end = stance(RUN_STANCE, RUN_PITCH[3][1]), stance(0.0, RUN_PITCH[0][1])
    t = (phase - RUN_STANCE) / (1 - RUN_STANCE)
    drag = -travel * (1 - RUN_STANCE)
    z = (start[2] * (1 + 2 * t) * (1 - t) ** 2 + drag * t * (1 - t) ** 2 + end[2] * t * t * (3 - 2 * t) + drag * t * t * (t - 1))
    hump = np.sin(np.pi * min(t / .9, 1)) ** 2
    y = start[1] + (end[1] - start[1]) * t * t * (3 - 2 * t) + .17 * hump + .05 * np.sin(np.pi * t) ** 2
    return np.array([0, y, z]), pitch, 0.0


def run_pose(joints, phase):
    pose, turn = Pose(joints), 2 * np.pi * phase
    # Lowest in the middle of each stance, highest in flight.
    bob = np.cos(2 * (turn - np.pi * RUN_STANCE))
    pose.hips = np.array([.008 * np.sin(turn), -.050 - .035 * bob, 0])
    yaw, drop = -8 * np.cos(turn), 4 * np.sin(turn)
    pose.turn["hips"] = about_y(yaw) @ about_z(-drop) @ about_x(9)
    for name, share in (("spine", .6), ("chest", .7), ("upperChest", .7)):
        pose.turn[name] = about_y(-yaw * share) @ about_z(drop * share * .6) @ about_x(1.5)
    pose.turn["neck"], pose.turn["head"] = about_y(yaw * .5) @ about_x(-4), about_y(yaw * .5) @ about_x(-6)
    for side, sign, lag in (("left", 1, 0.0), ("right", -1, .5)):
        ankle, pitch, toes = _run_foot(phase + lag)
        pose.plant(side, ankle + [sign * (sk.ANKLE[0] - .045), 0, 0], pitch, toes)
    swing = -40 * np.cos(turn - .3)
    _arms_down(pose, (swing - 12, -swing - 12), (84 + .45 * swing, 84 - .45 * swing), curl=2.2)
    return pose


def idle_pose(joints, phase):
    pose, turn = Pose(joints), 2 * np.pi * phase
    breath = .5 - .5 * np.cos(2 * turn)
    sway = np.sin(turn)
    pose.hips = np.array([.010 * sway, -.010 + .002 * breath, .003 * np.cos(turn)])
    pose.turn["hips"] = about_z(-.7 * sway) @ about_y(.8 * sway)
    pose.turn["spine"] = about_z(.5 * sway) @ about_x(.8 - .6 * breath)
    pose.turn["chest"] = about_z(.4 * sway) @ about_x(.6 - 1.4 * breath)
    pose.turn["upperChest"] = about_x(.4 - 1.2 * breath)
    pose.turn["neck"] = about_x(.6 * breath)
    pose.turn["head"] = about_y(3 * np.sin(turn + .6)) @ about_x(1.6 * breath - .5)
    _arms_down(pose, (1 + sway, 1 - sway), (13 + breath, 13 + breath))
    for side, sign in (("left", 1), ("right", -1)):
        raised = about_z(sign * 1.6 * breath)
        pose.turn[side + "Shoulder"] = raised @ pose.turn[side + "Shoulder"]
        pose.plant(side, sk.ANKLE * [sign, 1, 1], 0, 0)
    return pose


def sample(joints, pose_at, seconds, frames):
    """Times, local quaternions (frame, joint, 4) without sign jumps, and hips translations; the last key equals the first."""
    rotations, hips = [], []
    for frame in range(frames + 1):
        pose = pose_at(joints, frame % frames / frames)
        rotations.append([quaternion(m) for m in pose.solve()[0]])
        hips.append(joints[0].position + pose.hips)
    rotations = np.array(rotations)
    for frame in range(1, frames + 1):
        flip = (rotations[frame] * rotations[frame - 1]).sum(axis=1) < 0
        rotations[frame][flip] *= -1
    return np.linspace(0, seconds, frames + 1), rotations, np.array(hips)
