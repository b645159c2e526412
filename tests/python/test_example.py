"""The notebook-like example runs as it is."""
import subprocess
import sys
from pathlib import Path

EXAMPLE = Path(__file__).parents[2] / "python/examples/first_fall.py"


def test_the_example_runs_and_writes_what_it_says(tmp_path):
    import lutka

    done = subprocess.run([sys.executable, str(EXAMPLE), str(lutka.mannequin()), str(tmp_path)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "of 100" in done.stdout
    assert {file.name for file in tmp_path.iterdir()} == {"edited.ragdoll.json", "fall.glb", "doll.xml"}
