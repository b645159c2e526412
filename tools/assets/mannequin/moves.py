"""The clips that are made of posed key frames: getting up from lying in four ways, and two stumbles. All end in `idle`'s first pose."""
import numpy as np

from .clips import about_x, about_z, idle_pose, quaternion
from .keys import Moves, key_of, mirrored

FLAT = np.eye(3)
DOWN, AHEAD = (0, -1, 0), (0, 0, 1)
FRAMES_PER_SECOND = 30


def both(**members):
    """Of both sides: what the left one has, mirrored."""
    result = {}
    for name, value in members.items():
        result["left_" + name] = value
        result["right_" + name] = mirrored([{"left_" + name: value}])[0]["right_" + name]
    return result


def stood(joints, ahead=0.0):
    """The pose that `idle` begins with, so far ahead."""
    key = key_of(idle_pose(joints, 0.0), joints)
    for name in ("hips", "left_hand", "right_hand", "left_foot", "right_foot"):
        key[name] = key[name] + np.array([0, 0, ahead])
    return key


# On hands and knees, and what follows: the right foot comes forward, the left one pushes and steps up to it.
ALL_FOURS = {"hips": (0, .49, -.40), "turn": about_x(88), "bend": (6, 0, 0), "look": (-30, 0),
             **both(foot=(.116, .155, -.82), sole=about_x(112), knee=(.1, -.74, .67), toes=72, shrug=(0, 0), curl=3, palm=DOWN,
                    fingers=(-.15, 0, 1), elbow=(.5, .1, -.8), hand=(.27, .035, .18))}


def from_all_fours(joints):
    """(seconds, key) from ALL_FOURS on."""
    return [
        (.20, {"hips": (.04, .585, -.41), "turn": about_z(-5) @ about_x(44), "bend": (20, 0, 0), "right_foot": (-.16, .27, -.52),
               "right_sole": about_x(78), "right_toes": 0, **both(hand=(.26, .12, .12)), "right_knee": (-.2, .2, .9), "left_sole": about_x(112),
               "left_foot": (.116, .155, -.81), "left_toes": 70}),
        (.36, {"hips": (.03, .615, -.38), "turn": about_z(-4) @ about_x(18), "bend": (16, 0, 0), "right_foot": (-.15, .21, -.20),
               "right_sole": about_x(24), "right_knee": (-.16, .4, .9), **both(hand=(.26, .30, .08))}),
        (.52, {"hips": (.01, .57, -.35), "turn": about_z(-2) @ about_x(14), "bend": (20, 0, 0), "right_foot": (-.116, .082, -.026),
               "right_sole": FLAT, "right_knee": (-.18, .5, .8), "left_sole": about_x(102), "left_foot": (.116, .152, -.80),
               "left_toes": 68, "look": (-18, 0), **both(hand=(.25, .44, .06))}),
        (.78, {"hips": (-.01, .56, -.31), "turn": about_x(20), "bend": (22, 0, 0), "look": (-12, 0), "left_sole": about_x(84),
               "left_foot": (.116, .170, -.83), "left_toes": 62, "right_hand": (-.17, .53, .04), "right_fingers": (.3, -.2, 1),
               "right_palm": (0, -1, -.3), "right_elbow": (-1, .2, -.3), "left_hand": (.25, .47, .06), "left_fingers": (0, -.8, .6),
               "left_palm": (-1, 0, 0), "left_elbow": (.6, .1, -1), "left_curl": 10}),
        (1.04, {"hips": (-.04, .68, -.19), "turn": about_x(26), "bend": (14, 0, 0), "left_sole": about_x(62), "left_toes": 45,
                "left_foot": (.116, .180, -.82), "left_knee": (.1, -.2, .9), "right_hand": (-.17, .55, .06), "left_hand": (.27, .52, .14),
                "right_sole": about_x(10), "right_foot": (-.116, .093, -.026)}),
        (1.30, {"hips": (-.03, .81, -.08), "turn": about_x(22), "bend": (10, 0, 0), "look": (-6, 0), "left_foot": (.13, .27, -.42),
                "left_sole": about_x(60), "left_toes": 5, "left_knee": (.1, .2, .9), "right_hand": (-.25, .70, .08),
                "right_fingers": (0, -1, .3), "right_palm": (1, 0, 0), "right_elbow": (-.5, .1, -1), "right_curl": 10,
                "left_hand": (.27, .66, .06), "right_sole": about_x(10), "right_foot": (-.116, .093, -.026)}),
        (1.56, {"hips": (-.015, .90, -.02), "turn": about_x(9), "bend": (5, 0, 0), "look": (-2, 0), "left_foot": (.116, .105, -.06),
                "left_sole": about_x(4), "left_toes": 0, "right_hand": (-.27, .77, .05), "left_hand": (.28, .76, 0),
                "right_sole": FLAT, "right_foot": (-.116, .082, -.026)}),
        (1.70, {"hips": (0, .918, -.01), "turn": about_x(6), "bend": (3, 0, 0), "left_foot": (.116, .082, -.026), "left_sole": FLAT,
                "right_foot": (-.116, .082, -.026)}),
        (2.00, {**stood(joints), "right_foot": (-.116, .082, -.026)})]


def _moves(rows):
    return Moves([row[0] for row in rows], [row[1] for row in rows])


def _then(start, rows):
    return [(start + seconds, key) for seconds, key in rows]


def get_up_prone(joints):
    lie = {**ALL_FOURS, "hips": (0, .115, .03), "turn": about_x(90), "bend": (0, 0, 0), "look": (-22, 25),
           **both(hand=(.27, .035, .18), elbow=(.6, .8, -.2), shrug=(6, 0), fingers=(-.1, 0, 1), knee=(.2, -1, 0),
                    foot=(.116, .09, -.84), sole=about_x(150), toes=0)}
    push = {"hips": (0, .205, .0), "turn": about_x(74), "bend": (-14, 0, 0), "look": (-30, 0),
            **both(elbow=(.6, .4, -.7), shrug=(0, 0), knee=(.1, -.9, .3))}
    rise = {"hips": (0, .388, -.125), "turn": about_x(82), "bend": (-4, 0, 0), **both(foot=(.116, .115, -.83), sole=about_x(132), toes=0)}
    return _moves([(0, lie), (.15, {"look": (-30, 5)}), (.45, push), (.66, rise), (.92, ALL_FOURS)]
                  + _then(.92, from_all_fours(joints)))


def _on_left_side():
    turn = about_z(-90) @ about_x(90)
    return {"hips": (.17, .185, -.15), "turn": about_z(4) @ turn, "bend": (14, -10, 0), "look": (5, 0),
            "left_foot": (.05, .075, -.80), "left_sole": turn @ about_x(30), "left_knee": (-1, .05, .1), "left_toes": 0,
            "right_foot": (-.02, .16, -.78), "right_sole": turn @ about_x(30), "right_knee": (-1, .1, .1), "right_toes": 0,
            "left_hand": (-.16, .05, .34), "left_palm": (0, .3, -1), "left_fingers": (-1, 0, .2), "left_elbow": (.3, .35, -1),
            "left_shrug": (0, 22), "left_curl": 20,
            "right_hand": (-.15, .04, .20), "right_palm": DOWN, "right_fingers": (-.6, 0, .8), "right_elbow": (.2, 1, -.5),
            "right_shrug": (0, 8), "right_curl": 6}


def get_up_left(joints):
    roll = {"hips": (.12, .25, -.16), "turn": about_z(-55) @ about_x(84), "bend": (6, -8, 0), "look": (-12, -10),
            "left_hand": (-.02, .055, .33), "left_palm": (-.6, -.6, .4), "left_fingers": (-.3, 0, 1), "left_elbow": (.6, .2, -1),
            "left_curl": 5, "left_foot": (.10, .155, -.82), "left_knee": (-.9, -.4, .4), "left_sole": about_z(-60) @ about_x(140),
            "right_foot": (-.08, .16, -.82), "right_knee": (-.7, -.3, .6), "right_sole": about_z(-50) @ about_x(140)}
    up = {"hips": (.05, .40, -.28), "turn": about_z(-22) @ about_x(84), "bend": (2, 0, 0), "look": (-25, 0),
          "left_hand": (.14, .04, .24), "left_fingers": (-.4, 0, 1), "left_elbow": (.7, .2, -.6), "left_shrug": (0, 4),
          "left_foot": (.116, .115, -.83), "left_knee": (-.2, -.74, .6), "left_sole": about_z(-10) @ about_x(130), "left_toes": 0,
          "right_hand": (-.20, .035, .18), "right_foot": (-.116, .13, -.83), "right_knee": (-.3, -.74, .6),
          "right_sole": about_z(-10) @ about_x(130), "right_toes": 0, "right_fingers": (0, 0, 1), "right_elbow": (-.5, .2, -.8), "right_shrug": (0, 0)}
    return _moves([(0, _on_left_side()), (.38, roll), (.70, up), (.95, {**ALL_FOURS, "right_hand": (-.22, .035, .18)})]
                  + _then(.95, from_all_fours(joints)))


def get_up_right(joints):
    left = get_up_left(joints)
    return Moves(left.times, mirrored(left.keys))


def get_up_supine(joints):
    """Draws the feet up, sits up, pushes off with the left hand and stands up out of a squat."""
    lie = {"hips": (0, .11, -.47), "turn": about_x(-90), "bend": (0, 0, 0), "look": (4, 0),
           **both(foot=(.14, .098, .385), sole=about_x(-58), knee=(.3, 1, 0), toes=0, hand=(.34, .045, -.50), palm=DOWN,
                  fingers=(-.1, 0, 1), elbow=(1, -.4, -.3), shrug=(0, 0), curl=10)}
    draw = {"hips": (0, .115, -.47), "turn": about_x(-84), "bend": (12, 0, 0), "look": (30, 0),
            **both(foot=(.116, .082, -.026), sole=FLAT, knee=(.15, 1, .4))}
    sit = {"hips": (.01, .125, -.46), "turn": about_x(-34), "bend": (34, 5, 0), "look": (6, 0), "left_hand": (.27, .035, -.43),
           "left_fingers": (.5, 0, 1), "left_elbow": (.7, .2, -1), "right_hand": (-.20, .46, -.22), "right_fingers": (.1, .1, 1),
           "right_palm": (.6, -.8, 0), "right_elbow": (-.7, -.7, -.2), "left_curl": 3}
    rock = {"hips": (.01, .17, -.41), "turn": about_x(-20), "bend": (50, 6, 0), "look": (-8, 0), "right_hand": (-.20, .44, .06)}
    squat = {"hips": (0, .29, -.29), "turn": about_x(-8), "bend": (60, 0, 0), "look": (-24, 0), "left_hand": (.24, .26, -.02),
             "left_fingers": (0, -.5, 1), "left_palm": (-.6, -.6, 0), "left_elbow": (.8, -.2, -.6), "right_hand": (-.20, .38, .24),
             **both(knee=(.2, .8, .6), sole=about_x(12), foot=(.116, .096, -.026))}
    half = {"hips": (0, .54, -.20), "turn": about_x(34), "bend": (34, 0, 0), "look": (-24, 0), "left_hand": (.22, .42, .22),
            "left_fingers": (0, -.4, 1), "right_hand": (-.20, .43, .26), "right_fingers": (.1, -.4, 1), **both(knee=(.1, .5, .9))}
    high = {"hips": (0, .80, -.09), "turn": about_x(26), "bend": (14, 0, 0), "look": (-10, 0), "left_curl": 10,
            **both(hand=(.25, .64, .16), fingers=(0, -.8, .6), palm=(-1, 0, 0), elbow=(.6, 0, -1), knee=(.05, .1, 1), sole=about_x(8), foot=(.116, .091, -.026))}
    top = {"hips": (0, .915, -.015), "turn": about_x(6), "bend": (4, 0, 0), "look": (-1, 0),
           **both(hand=(.29, .77, .03), fingers=(0, -1, .2), elbow=(.4, 0, -1))}
    return _moves([(0, lie), (.42, draw), (.80, sit), (1.06, rock), (1.30, squat), (1.62, half), (1.98, high), (2.30, top),
                   (2.60, {**stood(joints), **both(foot=(.116, .082, -.026), sole=FLAT)})])


def _stumble(joints, way):
    """Two quick steps ahead (`way` 1) or back (-1), thrown off balance; arms out for it, then upright again."""
    start = stood(joints)
    lean = 13 if way > 0 else -14

    def arms(x, y, z, hips):  # they come along with the hips
        return both(hand=(x, y, z + hips * way), fingers=(.7, -.3, .7), palm=(-.3, -1, 0), elbow=(.5, -.4, -1))

    lifted = about_x(25 if way > 0 else 12)

    def moved(side, height, z):
        return ((.116 if side == "left" else -.116), height, z - .026)

    thrown = {"hips": (.02, .925, .13 * way), "turn": about_x(lean), "bend": (lean, 0, 0), "look": (-lean, 0), **arms(.44, .98, .20, .06),
              "right_foot": moved("right", .16, .22 * way), "right_sole": lifted}
    caught = {"hips": (-.02, .885, .25 * way), "turn": about_x(1.2 * lean), "bend": (1.2 * lean, 4, 0), **arms(.50, 1.05, .14, .20),
              "right_foot": moved("right", .082, .46 * way), "right_sole": FLAT, "left_foot": moved("left", .125, .02 * way),
              "left_sole": about_x(14)}
    again = {"hips": (-.025, .895, .40 * way), "turn": about_x(.5 * lean), "bend": (.4 * lean, 0, 0), "left_sole": lifted, **arms(.50, 1.04, .12, .36),
             "left_foot": moved("left", .16, .36 * way)}
    stands = {"hips": (.015, .885, .48 * way), "turn": about_x(-.5 * lean), "bend": (-.6 * lean, -3, 0), "look": (.3 * lean, 0), **arms(.46, 1.0, .18, .46),
              "left_foot": moved("left", .082, .58 * way), "left_sole": FLAT}
    gathers = {"hips": (.02, .915, .50 * way), "turn": about_x(.2 * lean), "bend": (.2 * lean, 0, 0), "look": (0, 0),
               **both(hand=(.36, .88, .08 + .48 * way), fingers=(.2, -1, .3), palm=(-1, 0, 0), elbow=(.4, 0, -1)),
               "right_foot": moved("right", .13, .52 * way), "right_sole": about_x(10), "left_foot": moved("left", .082, .58 * way)}
    end = {"hips": (0, .935, .57 * way), "turn": FLAT, "bend": (0, 0, 0),
           **both(hand=(.31, .80, .03 + .56 * way), fingers=(.1, -1, .2), palm=(-1, 0, 0), elbow=(.4, 0, -1)),
           "right_foot": moved("right", .082, .58 * way), "right_sole": FLAT}
    return _moves([(0, start), (.16, thrown), (.34, caught), (.52, again), (.70, stands), (1.0, gathers), (1.24, end),
                   (1.5, stood(joints, .58 * way))])


def stumble_forward(joints):
    return _stumble(joints, 1)


def stumble_backward(joints):
    return _stumble(joints, -1)


MOVES = (("get_up_prone", get_up_prone), ("get_up_supine", get_up_supine), ("get_up_left", get_up_left), ("get_up_right", get_up_right),
         ("stumble_forward", stumble_forward), ("stumble_backward", stumble_backward))


def sample_moves(joints, moves, lowest):
    """Times, local quaternions and hips translations of key frames. `lowest(rotations, hips)` is the height of a pose's lowest
    point but for hands and feet, which are where the keys have them: by what it is in the floor the hips are lifted."""
    frames = int(round(moves.seconds * FRAMES_PER_SECOND))
    rotations, hips = [], []
    for frame in range(frames + 1):
        lift = 0.0
        for _ in range(4):  # limbs that stand do not come along, so that it takes more than one
            pose = moves.pose(joints, frame / frames * moves.seconds, lift)
            quaternions = np.array([quaternion(m) for m in pose.solve()[0]])
            place = joints[0].position + pose.hips
            sunk = lowest(quaternions, place)
            if sunk > -5e-4:
                break
            lift -= sunk
        rotations.append(quaternions)
        hips.append(place)
    rotations = np.array(rotations)
    for frame in range(1, frames + 1):
        flip = (rotations[frame] * rotations[frame - 1]).sum(axis=1) < 0
        rotations[frame][flip] *= -1
    return np.linspace(0, moves.seconds, frames + 1), rotations, np.array(hips)
