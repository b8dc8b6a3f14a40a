"""The examples run, and do what they say."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import tanglebin

EXAMPLES = Path(__file__).parents[1] / "examples"


def run(name, *arguments):
    command = [sys.executable, EXAMPLES / name, *map(str, arguments)]
    return subprocess.run(command, check=True, capture_output=True, text=True, env=os.environ).stdout


@pytest.mark.parametrize("name", ["model_a_scan.py", "score_my_algorithm.py", "train_loader.py"])
def test_without_arguments_they_say_how_to_run_them(name):
    run = subprocess.run([sys.executable, EXAMPLES / name], capture_output=True, text=True, env=os.environ)
    assert run.returncode == 2 and run.stderr.startswith("usage: " + name) and "Traceback" not in run.stderr


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # its classes go to workers by name
    spec.loader.exec_module(module)
    return module


def test_generate_and_look(tmp_path):
    pytest.importorskip("open3d", reason="Open3D is not installed")
    out = run("generate_and_look.py", "--tubes", 1, "--out", tmp_path / "cloud.ply")
    points = int(out.split()[0])
    assert points > 10000 and len(tanglebin.read_ply(tmp_path / "cloud.ply")) == points


def test_score_my_algorithm(dataset_directory):
    lines = run("score_my_algorithm.py", dataset_directory).splitlines()
    assert len(lines) == 7 and lines[0].startswith("A1/1: micro-recall 1.000")
    assert 0 < float(lines[-1].split()[-1]) <= 1


def test_model_a_scan(source, scene, tmp_path):
    scan = tanglebin.scan(scene.tubes, tanglebin.Bin(), tanglebin.camera_preset("paper"))
    tanglebin.write_ply(tmp_path / "scan.ply", tanglebin.cloud_from_scan(scan, tubes=3, with_bin=True))
    out = run("model_a_scan.py", tmp_path / "scan.ply", source / "scenes" / "paper.toml")
    assert [line.split(":")[0] for line in out.splitlines() if line.startswith("tube")] == ["tube 1", "tube 2", "tube 3"]


def test_loaders_are_sequences_without_torch(recipe, dataset_directory):
    loader = example("train_loader")
    drawn = loader.DrawnScenes(recipe, scenes=6)
    saved = loader.SavedScenes(dataset_directory)
    assert len(drawn) == len(saved) == 6
    sample = drawn[3]  # the numbers of tubes take turns: 1, 3, 1, 3, …
    assert set(np.unique(sample["labels"])) == {1, 2, 3} and sample["points"].shape == (len(sample["labels"]), 3)
    on_tubes = saved[4]["labels"] > 0
    np.testing.assert_array_equal(saved[4]["points"][on_tubes], sample["points"])
    with pytest.raises(IndexError):
        drawn[6]


def test_scenes_that_draw_their_number_of_tubes_are_loaded(source):
    varied = tanglebin.read_recipe(source / "recipes" / "varied.toml")
    drawn = example("train_loader").DrawnScenes(varied, scenes=3)
    assert [id.number for id in drawn.ids] == [1, 2, 3] and drawn.ids == varied.cases[:3]
    assert set(np.unique(drawn[1]["labels"])) <= set(range(1, drawn.ids[1].tubes + 1))


@pytest.mark.parametrize("kind", ["DrawnScenes", "SavedScenes"])
def test_torch_loads_the_same_with_any_number_of_workers(kind, recipe, dataset_directory):
    pytest.importorskip("torch", reason="PyTorch is not installed")
    example_module = example("train_loader")
    scenes = (
        example_module.DrawnScenes(recipe, 6) if kind == "DrawnScenes" else example_module.SavedScenes(dataset_directory)
    )
    clouds = [
        [sample["points"].numpy() for batch in example_module.loader(scenes, workers) for sample in batch]
        for workers in (0, 2)
    ]
    assert len(clouds[0]) == len(clouds[1]) == 6
    for alone, shared in zip(*clouds):
        np.testing.assert_array_equal(alone, shared)
