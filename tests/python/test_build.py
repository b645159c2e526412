"""From a model to its ragdoll, and out again."""
import json
import pickle
import shutil
import subprocess
import sys
import threading

import pytest

import lutka


def test_map_says_which_joint_how_sure_and_why():
    found = lutka.map(lutka.mannequin())
    assert found.humanoid and found.confidence > 0.9 and not found.missing
    assert {"hips", "head", "leftHand", "rightFoot"} <= set(found.roles)
    hips = found.roles["hips"]
    assert hips.path.endswith(hips.joint) and hips.reason


def test_map_without_names_finds_the_same_limbs():
    named, blind = lutka.map(lutka.mannequin()), lutka.map(lutka.mannequin(), use_names=False)
    assert blind.roles["leftFoot"].path == named.roles["leftFoot"].path


def test_build_gives_bodies_joints_and_meshes(ragdoll):
    assert ragdoll.bodies[0] == "hips" and len(ragdoll.bodies) == 16
    assert len(ragdoll.joints) == len(ragdoll.joint_parents)
    mesh = ragdoll.meshes[0]
    assert mesh.positions.shape[1] == 3 and mesh.triangles.max() < len(mesh.positions)
    assert ragdoll.model == lutka.mannequin()
    assert not ragdoll.from_model and not ragdoll.rebound


def test_bodies_are_hulls_on_request():
    profile = lutka.build(lutka.mannequin(), hulls=True).profile
    head = profile.body("head")
    assert head.shape == "hull" and 4 <= len(head.points) <= 32
    assert all(len(point) == 3 for point in head.points)
    assert json.loads(profile.to_json())["bodies"][0]["shape"]["kind"] == "hull"
    assert lutka.build(lutka.mannequin()).profile.body("head").points is None


def test_options_of_build_do_what_they_say():
    heavy = lutka.build(lutka.mannequin(), mass=120, bodies=["neck", "toes"], preset="stiff")
    assert heavy.profile.mass == pytest.approx(120, rel=1e-4)
    assert {"neck", "leftToes"} <= set(heavy.bodies)
    assert len(lutka.build(lutka.mannequin(), bodies="neck, toes").bodies) == len(heavy.bodies)
    assert len(lutka.build(lutka.mannequin(), rig="any", max_bodies=12).bodies) <= 12


def test_a_profile_is_given_as_a_file_or_as_an_object(ragdoll, tmp_path):
    profile = ragdoll.profile
    profile.body("head").mass = 9.0
    profile.save(tmp_path / "a.ragdoll.json")
    by_file = lutka.build(lutka.mannequin(), profile=tmp_path / "a.ragdoll.json")
    by_object = lutka.build(lutka.mannequin(), profile=profile)
    assert by_file.profile == by_object.profile == ragdoll.with_profile(profile).profile
    assert by_object.profile.body("head").mass == 9.0


def test_check_scores_and_mends(ragdoll):
    checkup = lutka.check(ragdoll)
    assert checkup.sound and checkup.score > 80
    assert checkup.facts()["score"] == pytest.approx(checkup.score, abs=1e-3)
    assert "of 100" in str(checkup)
    profile = ragdoll.profile
    profile.body("leftFoot").mass = 0.05
    sick = ragdoll.with_profile(profile)
    findings = lutka.check(sick).findings
    assert any(f.code == "mass-ratio" and f.mend for f in findings)
    assert sick.mended() != profile


def test_export_writes_every_format_and_says_what_is_lost(ragdoll, tmp_path):
    for name in lutka.export_formats:
        file = tmp_path / f"doll.{name}"
        warnings = lutka.export(ragdoll, file, format=name)
        assert file.stat().st_size > 1000 and all(isinstance(w, str) for w in warnings)
    lutka.export(ragdoll, tmp_path / "doll.xml")
    assert (tmp_path / "doll.xml").read_bytes() == (tmp_path / "doll.mjcf").read_bytes()


def test_nothing_is_written_over_the_model(tmp_path):
    model = tmp_path / "hero.glb"
    shutil.copy(lutka.mannequin(), model)
    was = model.read_bytes()
    ragdoll = lutka.build(model)
    with pytest.raises(lutka.UsageError, match="the model itself"):
        lutka.export(ragdoll, model)
    with pytest.raises(lutka.UsageError, match="the model itself"):
        lutka.bake(lutka.Simulation(ragdoll), model, seconds=0.1)
    assert model.read_bytes() == was


def test_errors_carry_message_place_and_mend(ragdoll, tmp_path):
    with pytest.raises(lutka.InputError) as missing:
        lutka.build("nowhere.glb")
    assert "nowhere.glb" in missing.value.location and missing.value.message
    with pytest.raises(lutka.UsageError) as ending:
        lutka.export(ragdoll, tmp_path / "doll.xyz")
    assert "mjcf" in ending.value.mend
    with pytest.raises(lutka.OutputError):
        lutka.export(ragdoll, tmp_path / "file" / "x.xml") if (tmp_path / "file").write_text("") == 0 else None
    (tmp_path / "bad.ragdoll.json").write_text('{"format": "lutka-ragdoll", "version": 2, "bodies": 3}')
    with pytest.raises(lutka.InputError) as profile:
        lutka.Profile.load(tmp_path / "bad.ragdoll.json")
    assert "/bodies" in str(profile.value)
    copy = pickle.loads(pickle.dumps(profile.value))
    assert (copy.message, copy.location, copy.mend) == (
        profile.value.message, profile.value.location, profile.value.mend)
    assert issubclass(lutka.UsageError, ValueError) and issubclass(lutka.InputError, lutka.Error)


@pytest.mark.parametrize("options", [
    {"mass": float("nan")}, {"mass": -1}, {"scale": 0}, {"figure": 0}, {"preset": "soft"}, {"rig": "cat"},
    {"bodies": "wheels"}, {"up": "w"}, {"max_bodies": 0}, {"mass_table": "none"}])
def test_wrong_values_are_usage_errors(options):
    with pytest.raises(lutka.UsageError) as wrong:
        lutka.build(lutka.mannequin(), **options)
    assert wrong.value.mend


@pytest.mark.parametrize("options", [{"weight": 3}, {"mass": "heavy"}, {"bodies": 3}, {"profile": 4}])
def test_wrong_types_and_names_are_type_errors(options):
    with pytest.raises(TypeError):
        lutka.build(lutka.mannequin(), **options)


def test_hostile_files_are_errors_in_a_process_of_their_own(tmp_path):
    good = lutka.mannequin().read_bytes()
    for name, content in {"empty.glb": b"", "cut.glb": good[:5000], "noise.fbx": bytes(range(256)) * 40}.items():
        (tmp_path / name).write_bytes(content)
        with pytest.raises(lutka.InputError):
            lutka.build(tmp_path / name)
    # A limit that the file breaks ends that process, not this one.
    (tmp_path / "large.obj").write_bytes(b"v 0 0 0\n" * 10_000_000)
    with pytest.raises(lutka.InputError):
        lutka.build(tmp_path / "large.obj", import_memory=64)


def test_the_file_is_read_while_other_threads_run():
    ticks, done = [], threading.Event()

    def count():
        while not done.is_set():
            ticks.append(1)

    counter = threading.Thread(target=count)
    counter.start()
    lutka.build(lutka.mannequin())
    done.set()
    counter.join()
    assert len(ticks) > 100


def test_names_that_are_not_utf8_do_not_break_anything(tmp_path):
    import os

    odd = os.fsdecode(bytes(tmp_path) + b"/caf\xe9.glb")
    shutil.copy(lutka.mannequin(), odd)
    assert len(lutka.build(odd).bodies) == 16
    with pytest.raises(lutka.InputError):
        lutka.build(os.fsdecode(bytes(tmp_path) + b"/n\xff.glb"))


def test_the_stub_names_everything_that_the_module_has(tmp_path):
    from pathlib import Path

    stub = (Path(lutka.__file__).parent / "__init__.pyi").read_text()
    for name in lutka.__all__:
        assert name in stub, name
        for member in vars(getattr(lutka, name)) if isinstance(getattr(lutka, name), type) else ():
            if not member.startswith("_"):
                assert f"{member}" in stub, f"{name}.{member}"
        if callable(getattr(lutka, name)) and name != "mannequin":
            assert getattr(lutka, name).__doc__, name


def test_mypy_finds_nothing_against_the_stub_in_the_example():
    pytest.importorskip("mypy")
    from pathlib import Path

    example = Path(__file__).parents[2] / "python/examples/first_fall.py"
    done = subprocess.run([sys.executable, "-m", "mypy", "--ignore-missing-imports", "--cache-dir=/dev/null", str(example)],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_the_report_of_a_checkup_is_json(ragdoll):
    assert json.dumps(lutka.check(ragdoll).facts())


def test_everything_public_says_what_it_is():
    silent = []
    for name, thing in vars(lutka).items():
        if name.startswith("_") or not callable(thing):
            continue
        members = vars(thing).items() if isinstance(thing, type) and thing.__module__ == "lutka._lutka" else ()
        silent += [name] * (not thing.__doc__)
        silent += [f"{name}.{member}" for member, value in members if not member.startswith("_") and not value.__doc__]
    assert silent == []


def test_errors_speak_of_arguments_not_of_options(ragdoll):
    with pytest.raises(lutka.UsageError) as told:
        lutka.Simulation(ragdoll, scene="nope")
    assert told.value.location == "scene" and "--" not in str(told.value)
    with pytest.raises(lutka.InputError) as told:
        lutka.build(sys.executable)
    assert "--" not in str(told.value)
