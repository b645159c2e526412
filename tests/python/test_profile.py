"""Editing a profile: it stays valid, and nothing that stands for a part of it goes stale."""
import copy
import gc
import pickle
from math import nan, radians

import pytest

import lutka


@pytest.fixture
def profile(ragdoll):
    return ragdoll.profile


def test_a_ragdolls_profile_is_a_copy(ragdoll, profile):
    profile.body("head").mass = 20
    assert ragdoll.profile.body("head").mass != 20


def test_masses_sum_up_and_inertia_follows(profile):
    head = profile.body("head")
    before, inertia = head.mass, head.inertia
    others = profile.mass - before
    head.mass = 2 * before
    assert profile.mass == pytest.approx(others + 2 * before, rel=1e-5)
    assert head.inertia == pytest.approx([2 * i for i in inertia], rel=1e-5)


def test_limits_shapes_and_friction_are_edited(profile):
    knee = profile.constraint("leftLowerLeg")
    assert knee.kind == "hinge" and knee.cone is None
    knee.hinge = (-radians(10), radians(90))
    assert knee.hinge == pytest.approx((-radians(10), radians(90)))
    hip = profile.constraint("leftUpperLeg")
    hip.cone = (0.5, 0.6, 0.2)
    assert hip.cone == pytest.approx((0.5, 0.6, 0.2))
    hip.friction = 3
    assert hip.friction == 3 and hip.parent.name == "hips" and hip.child.name == "leftUpperLeg"
    arm = profile.body("leftUpperArm")
    arm.radius *= 1.1
    assert lutka.Profile.from_json(profile.to_json()) == profile


def test_pairs_are_filtered_and_no_longer(profile):
    pair = ("leftHand", "rightHand")
    profile.set_filtered(*pair)
    profile.set_filtered(*reversed(pair))
    assert profile.filtered_pairs.count(pair) == 1
    profile.set_filtered(*pair, False)
    assert pair not in profile.filtered_pairs


@pytest.mark.parametrize("spoil", [
    lambda p: setattr(p.body("head"), "mass", nan),
    lambda p: setattr(p.body("head"), "mass", 0),
    lambda p: setattr(p.body("head"), "mass", 1e30),
    lambda p: setattr(p.body("head"), "inertia", (1, 0, 1)),
    lambda p: setattr(p.body("leftUpperArm"), "radius", -1),
    lambda p: setattr(p.body("leftUpperArm"), "half_length", nan),
    lambda p: setattr(p.constraint("leftLowerLeg"), "hinge", (1, 2)),
    lambda p: setattr(p.constraint("leftLowerLeg"), "hinge", (nan, 0)),
    lambda p: setattr(p.constraint("leftUpperLeg"), "cone", (0, 1, 1)),
    lambda p: setattr(p.constraint("leftUpperLeg"), "hinge", (0, 1)),
    lambda p: setattr(p.constraint("leftLowerLeg"), "cone", (1, 1, 1)),
    lambda p: setattr(p.constraint("head"), "friction", -1),
    lambda p: p.set_filtered("head", "head"),
    lambda p: p.set_filtered("head", "tail"),
    lambda p: p.body("tail"),
    lambda p: p.constraint("hips"),
])
def test_what_makes_no_sense_is_refused_and_changes_nothing(profile, spoil):
    before = profile.to_json()
    with pytest.raises(lutka.UsageError) as refused:
        spoil(profile)
    assert refused.value.message and refused.value.location
    assert profile.to_json() == before


@pytest.mark.parametrize("spoil", [
    lambda p: setattr(p.body("head"), "mass", "heavy"),
    lambda p: setattr(p.body("head"), "inertia", (1, 2)),
    lambda p: setattr(p.constraint("head"), "cone", 3),
    lambda p: p.body(3),
    lambda p: setattr(p.body("head"), "name", "skull"),
])
def test_wrong_types_are_refused(profile, spoil):
    with pytest.raises((TypeError, AttributeError)):
        spoil(profile)


def test_parts_keep_their_profile_alive(ragdoll):
    head = ragdoll.profile.body("head")
    joints = ragdoll.profile.constraints
    gc.collect()
    head.mass = 5
    assert head.mass == 5 and [c.child.name for c in joints] == ragdoll.bodies[1:]


def test_copies_and_pickles_are_their_own(profile):
    for other in (profile.copy(), copy.copy(profile), copy.deepcopy(profile), pickle.loads(pickle.dumps(profile))):
        assert other == profile
        other.body("head").mass = 6
        assert other != profile
