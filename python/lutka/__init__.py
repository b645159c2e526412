"""Lutka turns any rigged character into a physically sound ragdoll.

    ragdoll = lutka.build("hero.fbx")
    simulation = lutka.Simulation(ragdoll, scene="stairs")
    simulation.run(seconds=2)
    print(simulation.bodies[0])  # the hips: rotation (x, y, z, w), position

Metres, kilograms, radians, Y up. Quaternions are (x, y, z, w). See docs/python.md.
"""

import copyreg as _copyreg
from pathlib import Path as _Path

from ._errors import Error, InputError, InternalError, OutputError, UsageError
from ._lutka import (
    Binding,
    Body,
    Checkup,
    Constraint,
    Drag,
    Finding,
    Map,
    Mesh,
    Profile,
    Ragdoll,
    Simulation,
    __version__,
    bake,
    build,
    check,
    export,
    export_formats,
    map,
    scenes,
)


def mannequin():
    """The path of Lutka's own character, for a first try."""
    return _Path(__file__).parent / "mannequin.glb"


def _profile_of(text):
    return Profile.from_json(text, "pickle")


_copyreg.pickle(Profile, lambda profile: (_profile_of, (profile.to_json(),)))

__all__ = [
    "Binding",
    "Body",
    "Checkup",
    "Constraint",
    "Drag",
    "Error",
    "Finding",
    "InputError",
    "InternalError",
    "Map",
    "Mesh",
    "OutputError",
    "Profile",
    "Ragdoll",
    "Simulation",
    "UsageError",
    "__version__",
    "bake",
    "build",
    "check",
    "export",
    "export_formats",
    "mannequin",
    "map",
    "scenes",
]
