"""What the tests share. TANGLEBIN_PROGRAM and TANGLEBIN_SOURCE say where the program and the sources are."""

import os
import subprocess
from pathlib import Path

import pytest

import tanglebin

SMALL_RECIPE = """
seed = 7
attempts = 20

[scanner]
width = 240
height = 150
hfov_deg = 70
position = [0, 0, 2]

[output]
depths = true
labels = true

[[set]]
name = "A"
tubes = [1, 3]
cases = 3
[set.tube]
radius = 0.0125
mass = 0.5
length = 0.5
cylinders_min = 5
cylinders_max = 10
cylinder_length_min = 0.02
bend_min_deg = 0
bend_max_deg = 30
"""


@pytest.fixture(scope="session")
def source():
    return Path(os.environ["TANGLEBIN_SOURCE"])


@pytest.fixture(scope="session")
def program():
    """Runs the program with arguments; returns what it prints."""

    def run(*arguments):
        command = [os.environ["TANGLEBIN_PROGRAM"], *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    return run


@pytest.fixture(scope="session")
def recipe():
    """Six cases that are quick to make: set A's tubes, one and three a case, and a coarse camera."""
    return tanglebin.Recipe(SMALL_RECIPE)


@pytest.fixture(scope="session")
def scene(recipe):
    """Three tubes at rest."""
    return tanglebin.simulate(recipe, tanglebin.CaseId("A", 3, 1))


@pytest.fixture(scope="session")
def dataset_directory(recipe, tmp_path_factory):
    directory = tmp_path_factory.mktemp("dataset") / "small"
    tanglebin.generate_dataset(recipe, directory, jobs=2)
    return directory


@pytest.fixture
def dataset(dataset_directory):
    return tanglebin.Dataset(dataset_directory)
