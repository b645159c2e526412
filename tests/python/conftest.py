import pytest

import lutka


@pytest.fixture(scope="session")
def ragdoll():
    """The mannequin's, built once: it never changes."""
    return lutka.build(lutka.mannequin())


@pytest.fixture
def simulation(ragdoll):
    return lutka.Simulation(ragdoll, measure=False)
