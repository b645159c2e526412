"""A first look at Lutka from Python, cell by cell.

    python first_fall.py [MODEL] [FOLDER]

Editors that know `# %%` (Jupyter through jupytext, VS Code, Spyder) run it as a notebook.
"""

# %% A model, and a folder for what is written
import sys
import tempfile
from math import radians
from pathlib import Path

import numpy as np

import lutka

model = Path(sys.argv[1]) if len(sys.argv) > 1 else lutka.mannequin()
folder = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(tempfile.mkdtemp())

# %% Which joint plays which part, how sure, and why
found = lutka.map(model)
for role, binding in sorted(found.roles.items()):
    print(f"{role:15} {binding.joint:28} {binding.confidence:4.0%}  {binding.reason}")

# %% The ragdoll, and what the doctor says
ragdoll = lutka.build(model)
print(lutka.check(ragdoll))

# %% A profile is edited as a copy: heavier feet, a stiff neck, narrower knees
profile = ragdoll.profile
for foot in ("leftFoot", "rightFoot"):
    profile.body(foot).mass *= 1.5
profile.constraint("head").friction = 5.0
for knee in ("leftLowerLeg", "rightLowerLeg"):
    joint = profile.constraint(knee)
    if joint.hinge is not None:
        lower, upper = joint.hinge
        joint.hinge = max(lower, -radians(100)), min(upper, radians(100))
profile.save(folder / "edited.ragdoll.json")
edited = ragdoll.with_profile(profile)

# %% One doll falls down the stairs, and is kicked half a second later
simulation = lutka.Simulation(edited, scene="stairs")
simulation.run(0.5)
simulation.apply_impulse(0, "chest" if "chest" in edited.bodies else "spine", (0, 20, -60))
heights = []
for _ in range(120):
    simulation.step()
    heights.append(simulation.bodies[:, 5].mean())  # a view of where the bodies are now: (x, y, z, w, px, py, pz)
print(f"mean height {heights[0]:.2f} m, {heights[-1]:.2f} m at the end")

# %% The skin of the same moment, for any plotting library
vertices = np.concatenate(simulation.skin())
print(f"{len(vertices)} vertices between {vertices.min(axis=0)} and {vertices.max(axis=0)}")

# %% A crowd: one array for all dolls
crowd = lutka.Simulation(edited, scene="pile", count=40, seed=1, threads=2, measure=False)
crowd.run(1.0)
hips = crowd.bodies.reshape(crowd.doll_count, -1, 7)[:, 0, 4:]
print(f"the hips of {len(hips)} dolls spread over {np.ptp(hips[:, 0]):.1f} m by {np.ptp(hips[:, 2]):.1f} m")

# %% Muscles: a motor in every joint holds the pose that it starts in
stiff = lutka.Simulation(ragdoll)
for body in ragdoll.bodies[1:]:
    stiff.set_motor(0, body, stiffness=200.0, damping=20.0)
stiff.run(1.0)

# %% Take it away: an animation of the skin, and the ragdoll for MuJoCo
frames = lutka.bake(lutka.Simulation(edited, scene="stairs"), folder / "fall.glb", seconds=2.0)
for warning in lutka.export(edited, folder / "doll.xml"):
    print("MJCF:", warning)
print(f"{frames} frames and {[file.name for file in sorted(folder.iterdir())]} in {folder}")
