#!/usr/bin/env python3
"""Times Python's arrays and loader. PYTHONPATH=build/python bench/python_bench.py build/tanglebin [CASES]

1. How long it takes to get a cloud's points as an array, and to copy them.
2. How many scenes per second two processes make: `tanglebin generate`, which also writes them to disk, and the workers
   of a PyTorch DataLoader (python/examples/train_loader.py), in turns. The processor time of a scene tells on a machine
   that is busy with other work, too.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
import tanglebin
import torch  # noqa: F401  (here, so that nobody's time has it)

SOURCE = Path(__file__).parents[1]
sys.path.insert(0, str(SOURCE / "python" / "examples"))
import train_loader

WORKERS = 2


def seconds_of(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def time_arrays():
    cloud = tanglebin.PointCloud(np.zeros((1_000_000, 3), np.float32))
    view = median(seconds_of(lambda: cloud.points) for _ in range(1000))
    copy = median(seconds_of(lambda: cloud.points.copy()) for _ in range(100))
    print(f"a million points: {1e6 * view:.1f} us as an array, {1e6 * copy:.0f} us for a copy")


def processor_seconds():
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def costs(call):
    """Seconds by the clock, and of the processors."""
    start = processor_seconds()
    return np.array([seconds_of(call), processor_seconds() - start])


def costs_of_program(program, recipe):
    with tempfile.TemporaryDirectory() as folder:
        tanglebin.write_recipe(Path(folder) / "recipe.toml", recipe)
        command = [program, "generate", Path(folder) / "recipe.toml", "--out", Path(folder) / "dataset"]
        return costs(lambda: subprocess.run([*command, "--jobs", str(WORKERS)], check=True, capture_output=True))


def costs_of_loader(recipe, cases):
    scenes = train_loader.DrawnScenes(recipe, cases)
    return costs(lambda: [len(batch) for batch in train_loader.loader(scenes, WORKERS)])


def ten_tubes(cases):
    """Set A with ten tubes in each case, and of its files only the tubes' points and the configurations."""
    recipe = tanglebin.read_recipe(SOURCE / "recipes" / "set-a.toml")
    sets = recipe.sets
    sets[0].tubes, sets[0].cases = [10], cases
    recipe.sets = sets
    output = recipe.output
    output.bin_points = output.worlds = False
    recipe.output = output
    return recipe


def time_loader(program, cases):
    recipe = ten_tubes(cases)
    for _ in range(3):
        by_program, by_loader = costs_of_program(program, recipe) / cases, costs_of_loader(recipe, cases) / cases
        print(
            f"{cases} scenes of ten tubes: program {1 / by_program[0]:.1f} a second, loader {1 / by_loader[0]:.1f}, "
            f"{by_program[0] / by_loader[0]:.0%}; of the processors {1e3 * by_program[1]:.0f} and "
            f"{1e3 * by_loader[1]:.0f} ms a scene, {by_program[1] / by_loader[1]:.0%}"
        )


if __name__ == "__main__":
    time_arrays()
    time_loader(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 100)
