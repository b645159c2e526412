"""A simulation from Python: the same bits as from C++, views that live, and misuse that raises."""
import gc
import json
import os
import subprocess
import threading
from math import inf, nan

import numpy as np
import pytest

import lutka


def test_a_doll_falls_and_comes_to_rest(ragdoll):
    simulation = lutka.Simulation(ragdoll)
    start = simulation.bodies[:, 5].mean()
    simulation.run(4)
    assert simulation.steps == 240 and simulation.seconds == pytest.approx(4, rel=1e-5)
    assert simulation.bodies[:, 5].mean() < start - 0.5
    assert np.isfinite(simulation.bodies).all()
    quality = simulation.report()["quality"]
    assert quality["jointSeparationM"]["max"] < 0.01 and quality["nonFinite"] == 0


def test_the_bits_are_those_of_the_command_line(ragdoll):
    program = os.environ.get("LUTKA")
    if program is None:
        pytest.skip("LUTKA names no executable")
    simulation = lutka.Simulation(ragdoll, scene="stairs", count=3, seed=7)
    simulation.run(1)
    printed = subprocess.run([program, "simulate", str(lutka.mannequin()), "--scene", "stairs", "--count", "3", "--seed", "7",
                              "--seconds", "1", "--json"], capture_output=True, check=True, text=True).stdout
    assert json.loads(printed)["stateHash"] == f"{simulation.state_hash:016x}"


def test_reset_gives_the_same_bits_again(simulation):
    simulation.run(0.5)
    first = simulation.state_hash
    simulation.apply_impulse(0, "head", (5, 0, 0))
    simulation.reset()
    assert simulation.steps == 0
    simulation.run(0.5)
    assert simulation.state_hash == first


def test_bodies_are_a_view_that_is_not_copied_and_follows_every_step(simulation):
    view = simulation.bodies
    assert view.base is not None and not view.flags.writeable and not view.flags.owndata
    before = view.copy()
    for _ in range(5):
        simulation.step()
        assert view.__array_interface__["data"] == simulation.bodies.__array_interface__["data"]
    assert (view != before).any()
    simulation.reset()
    assert (view == before).all()
    with pytest.raises(ValueError):
        view[0, 0] = 1
    with pytest.raises(ValueError):
        view.setflags(write=True)


def test_views_keep_what_they_show_alive(ragdoll):
    simulation = lutka.Simulation(ragdoll, count=30, scene="spread", measure=False)
    simulation.step(3)
    views = [simulation.bodies, simulation.bodies_of(7), simulation.poses(), simulation.pose(5), simulation.palettes(),
             simulation.world_from_model(2)]
    copies = [view.copy() for view in views]
    del simulation
    gc.collect()
    rubbish = [np.random.rand(30, 16, 7) for _ in range(200)]
    assert all((view == copy).all() for view, copy in zip(views, copies))
    mesh = lutka.build(lutka.mannequin()).meshes[0].positions
    sum_before = float(mesh.sum())
    gc.collect()
    assert float(mesh.sum()) == sum_before and rubbish


def test_a_simulation_keeps_its_ragdoll_alive():
    simulation = lutka.Simulation(lutka.build(lutka.mannequin()), measure=False)
    gc.collect()
    simulation.step(20)
    assert np.isfinite(simulation.bodies).all()


def test_crowds_are_one_array(ragdoll):
    crowd = lutka.Simulation(ragdoll, scene="spread", count=50, seed=3, threads=2, measure=False)
    crowd.step(10)
    dolls = crowd.bodies.reshape(crowd.doll_count, len(ragdoll.bodies), 7)
    assert np.shares_memory(dolls, crowd.bodies)
    assert (dolls[11] == crowd.bodies_of(11)).all()
    poses = crowd.poses().reshape(crowd.doll_count, len(ragdoll.joints), 7)
    assert (poses[4] == crowd.pose(4)).all()
    assert crowd.palettes().shape == (50 * len(ragdoll.joints), 3, 4)
    assert np.allclose(np.linalg.norm(poses[:, :, :4], axis=2), 1, atol=1e-5)


def test_threads_do_not_change_the_bits(ragdoll):
    hashes = set()
    for threads in (1, 2, 3):
        crowd = lutka.Simulation(ragdoll, scene="pile", count=12, seed=2, threads=threads, measure=False)
        crowd.step(40)
        hashes.add(crowd.state_hash)
    assert len(hashes) == 1


def test_the_skin_lies_about_its_bodies(ragdoll, simulation):
    simulation.step(30)
    skin = np.concatenate(simulation.skin())
    assert len(skin) == sum(len(mesh.positions) for mesh in ragdoll.meshes)
    assert np.abs(skin.mean(axis=0) - simulation.bodies[:, 4:].mean(axis=0)).max() < 0.3


def test_impulses_forces_and_velocities(simulation):
    assert (simulation.velocities() == 0).all()
    mass = 0.5
    simulation.apply_impulse(0, "head", (0, 0, mass))
    simulation.apply_force(0, 0, [0.0, 100.0, 0.0], point=np.array([0, 1, 0]))
    assert simulation.velocities().shape == (16, 6)
    simulation.step()
    assert simulation.velocities()[:, 2].max() > 0


def test_motors_hold_what_would_sag(ragdoll):
    def bend(hold):
        simulation = lutka.Simulation(ragdoll, scene="hang", measure=False)
        for body in ragdoll.bodies[1:] if hold else ():
            simulation.set_motor(0, body, stiffness=500.0, damping=50.0, max_torque=1000.0)
        start = simulation.bodies.copy()
        simulation.run(1)
        return np.abs(simulation.bodies[:, 4:] - start[:, 4:]).max()

    assert bend(True) != bend(False)
    simulation = lutka.Simulation(ragdoll, measure=False)
    simulation.set_motor(0, "leftLowerLeg", angle=0.5, stiffness=300.0, damping=30.0)
    simulation.set_motor(0, "head", target=(0, 0, 0, 1), stiffness=10.0)
    simulation.clear_motor(0, "head")
    simulation.step(5)


def test_a_pull_is_followed_and_ends(simulation):
    drag = simulation.drag(0, "leftHand", (0.0, 2.5, 0.0), max_force=5000.0)
    simulation.run(1.5)
    hand = simulation.bodies[16 * 0 + simulation.ragdolls[0].bodies.index("leftHand"), 4:]
    assert np.linalg.norm(hand - (0, 2.5, 0)) < 0.2
    drag.target = (0, 2.0, 0)
    assert drag.target == pytest.approx((0, 2.0, 0)) and drag.active
    drag.remove()
    drag.remove()
    assert not drag.active
    with pytest.raises(lutka.UsageError):
        drag.target = (0, 0, 0)


def test_a_pull_of_before_a_reset_is_stale_not_another(ragdoll):
    hanging = lutka.Simulation(ragdoll, scene="hang", measure=False)
    drag = hanging.drag(0, "head", (0, 3, 0))
    hanging.reset()
    assert not drag.active
    drag.remove()
    with pytest.raises(lutka.UsageError):
        drag.target = (0, 0, 0)
    hanging.run(1)
    assert hanging.bodies[:, 5].max() > 1  # still hangs by its hands


def test_bodies_are_placed(simulation):
    frames = simulation.bodies.copy()
    frames[:, 4] += 3
    simulation.set_bodies(0, frames, np.tile((0, 1, 0, 0, 0, 0), (16, 1)))
    assert np.allclose(simulation.bodies, frames, atol=1e-6)
    assert np.allclose(simulation.velocities()[:, 1], 1)


def test_clips_and_muscles(ragdoll):
    clip = ragdoll.clips[0] if ragdoll.clips else None
    if clip is None:
        puppet = lutka.Simulation(ragdoll, muscles="powered", pin=3000.0)
    else:
        puppet = lutka.Simulation(ragdoll, clip=(clip, 0.1), muscles="powered", strength=1.0)
    puppet.run(0.5)
    assert "puppet" in puppet.report()
    with pytest.raises(lutka.UsageError):
        lutka.Simulation(ragdoll, clip="no such clip")
    with pytest.raises(lutka.UsageError):
        lutka.Simulation(ragdoll, strength=2.0)


def test_scene_files(tmp_path):
    program = os.environ.get("LUTKA")
    if program is None:
        pytest.skip("LUTKA names no executable")
    file = tmp_path / "ours.scene.json"
    subprocess.run([program, "scene", "stairs", "-o", str(file)], check=True)
    simulation = lutka.Simulation.load(file, lutka.mannequin(), measure=False)
    simulation.step(5)
    assert simulation.doll_count == 1
    file.write_text("{}")
    with pytest.raises(lutka.InputError):
        lutka.Simulation.load(file)


def test_bake_writes_an_animation(simulation, ragdoll, tmp_path):
    assert lutka.bake(simulation, tmp_path / "fall.glb", seconds=0.5, name="tumble") == 31
    assert simulation.steps == 30
    assert b"tumble" in (tmp_path / "fall.glb").read_bytes()
    for reduce in (True, False):
        again = lutka.Simulation(ragdoll, measure=False)
        lutka.bake(again, tmp_path / f"{reduce}.glb", seconds=0.5, reduce=reduce)
    assert (tmp_path / "True.glb").stat().st_size < (tmp_path / "False.glb").stat().st_size
    with pytest.raises(lutka.OutputError):
        lutka.bake(simulation, "/dev/null/fall.glb", seconds=0.1)


NUMBERS = [nan, inf, -inf]


@pytest.mark.parametrize("misuse", [
    lambda s: s.step(-1),
    lambda s: s.run(nan),
    lambda s: s.run(-1),
    lambda s: s.run(inf),
    lambda s: s.bodies_of(1),
    lambda s: s.bodies_of(-1),
    lambda s: s.velocities(99),
    lambda s: s.asleep(2**31 - 1),
    lambda s: s.pose(1),
    lambda s: s.poses(nan),
    lambda s: s.poses(1.5),
    lambda s: s.skin(0, -0.1),
    lambda s: s.skin(3),
    lambda s: s.world_from_model(1),
    lambda s: s.wake(7),
    lambda s: s.apply_impulse(0, "tail", (0, 0, 0)),
    lambda s: s.apply_impulse(0, 16, (0, 0, 0)),
    lambda s: s.apply_impulse(0, -1, (0, 0, 0)),
    lambda s: s.apply_impulse(5, 0, (0, 0, 0)),
    *[lambda s, n=n: s.apply_impulse(0, 0, (n, 0, 0)) for n in NUMBERS],
    *[lambda s, n=n: s.apply_force(0, 0, (0, 0, 0), (0, n, 0)) for n in NUMBERS],
    *[lambda s, n=n: s.set_motor(0, 1, stiffness=n) for n in NUMBERS],
    *[lambda s, n=n: s.set_motor(0, 1, angle=n) for n in NUMBERS],
    lambda s: s.set_motor(0, 1, target=(0, 0, 0, 0)),
    lambda s: s.set_motor(0, 1, target=(nan, 0, 0, 1)),
    lambda s: s.set_motor(0, 0, stiffness=1.0),
    lambda s: s.clear_motor(0, "hips"),
    *[lambda s, n=n: s.drag(0, 0, (n, 0, 0)) for n in NUMBERS],
    lambda s: s.drag(0, 0, (0, 0, 0), max_force=-1.0),
    lambda s: s.set_bodies(0, np.zeros((16, 7))),
    lambda s: s.set_bodies(0, np.full((16, 7), nan)),
    lambda s: s.set_bodies(0, s.bodies, np.full((16, 6), inf)),
    lambda s: s.set_bodies(1, s.bodies),
])
def test_misuse_raises_and_changes_nothing(simulation, misuse):
    before = simulation.state_hash
    with pytest.raises(lutka.UsageError) as refused:
        misuse(simulation)
    assert refused.value.message and refused.value.mend
    assert simulation.state_hash == before
    simulation.step(2)
    assert np.isfinite(simulation.bodies).all()


@pytest.mark.parametrize("misuse", [
    lambda s: s.step("one"),
    lambda s: s.step(2**40),
    lambda s: s.bodies_of("first"),
    lambda s: s.apply_impulse(0, 1.5, (0, 0, 0)),
    lambda s: s.apply_impulse(0, None, (0, 0, 0)),
    lambda s: s.apply_impulse(0, 0, "up!"),
    lambda s: s.apply_impulse(0, 0, (1, 2)),
    lambda s: s.apply_impulse(0, 0, object()),
    lambda s: s.set_motor(0, 1, stiff=1.0),
    lambda s: s.set_bodies(0, np.zeros((3, 7))),
    lambda s: s.set_bodies(0, "bodies"),
    lambda s: s.set_bodies(0, [[1, 2], [3]]),
    lambda s: lutka.Simulation("doll"),
    lambda s: lutka.Simulation(None),
    lambda s: lutka.Simulation(s.ragdolls[0], seed=-1),
    lambda s: lutka.Simulation(s.ragdolls[0], speed=2),
    lambda s: lutka.Simulation.__new__(lutka.Simulation).step(),
    lambda s: lutka.Ragdoll.__new__(lutka.Ragdoll).bodies,
    lambda s: lutka.Profile.__new__(lutka.Profile).bodies,
    lambda s: lutka.Simulation(),
    lambda s: type("Mine", (lutka.Simulation,), {}),
    lambda s: __import__("copy").copy(s),
    lambda s: lutka.Drag(),
    lambda s: lutka.check(s),
])
def test_wrong_types_raise(simulation, misuse):
    with pytest.raises((TypeError, ValueError)):
        misuse(simulation)


@pytest.mark.parametrize("options", [
    {"scene": "moon"}, {"count": 0}, {"count": 10**6}, {"threads": 0}, {"dt": 0.0}, {"dt": nan}, {"solver": "magic"},
    {"gravity": (0, nan, 0)}, {"substeps": 0}, {"pose": "dance"}, {"from_clip": ("no such", 0.0)}, {"muscles": "huge"}])
def test_wrong_options_are_usage_errors(ragdoll, options):
    with pytest.raises(lutka.UsageError):
        lutka.Simulation(ragdoll, **options)


def test_other_threads_run_while_it_steps_and_may_step_too(ragdoll):
    simulation = lutka.Simulation(ragdoll, scene="pile", count=30, seed=1, measure=False)
    seen, failures, done = [], [], threading.Event()

    def read():
        while not done.is_set():
            try:
                seen.append(float(simulation.bodies.sum()))
                simulation.velocities(3)
                simulation.poses(0.5)
            except Exception as failure:  # whatever it is, the test tells it
                failures.append(failure)
                return

    readers = [threading.Thread(target=read) for _ in range(2)]
    steppers = [threading.Thread(target=simulation.step, args=(20,)) for _ in range(3)]
    for thread in readers + steppers:
        thread.start()
    for thread in steppers:
        thread.join()
    simulation.reset()
    done.set()
    for thread in readers:
        thread.join()
    assert not failures and seen
    simulation.step(60)
    alone = lutka.Simulation(ragdoll, scene="pile", count=30, seed=1, measure=False)
    alone.step(60)
    assert simulation.state_hash == alone.state_hash


def test_an_interrupt_ends_a_long_run(ragdoll):
    import _thread

    simulation = lutka.Simulation(ragdoll, scene="pile", count=100, measure=False)
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        simulation.step(10**6)
    assert 0 < simulation.steps < 10**6


def test_a_second_init_changes_nothing(ragdoll, simulation):
    view = simulation.bodies.copy()
    simulation.__init__(ragdoll, scene="stairs", count=5)
    assert simulation.doll_count == 1 and (simulation.bodies == view).all()
