#!/usr/bin/env python3
"""Times Python's arrays and loader. PYTHONPATH=build/python bench/python_bench.py build/tanglebin [CASES]

1. How long it takes to get a cloud's points as an array, and to copy them.
2. How many scenes per second two processes make: `tanglebin generate`, which also writes them to disk, and the workers
   of a PyTorch DataLoader (python/examples/train_loader.py), in turns.
"""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import numpy as np
import tanglebin

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


def rate_of_program(program, recipe, cases):
    with tempfile.TemporaryDirectory() as folder:
        tanglebin.write_recipe(Path(folder) / "recipe.toml", recipe)
        command = [program, "generate", Path(folder) / "recipe.toml", "--out", Path(folder) / "dataset"]
        out = subprocess.run([*command, "--jobs", str(WORKERS), "--json"], check=True, capture_output=True).stdout
        return cases / json.loads(out)["seconds"]


def rate_of_loader(recipe, cases):
    loader = train_loader.loader(train_loader.DrawnScenes(recipe, cases), WORKERS)
    return cases / seconds_of(lambda: [len(batch) for batch in loader])


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
    rates = [(rate_of_program(program, recipe, cases), rate_of_loader(recipe, cases)) for _ in range(3)]
    for by_program, by_loader in rates:
        print(
            f"{cases} scenes of ten tubes: program {by_program:.1f} a second, loader {by_loader:.1f}, "
            f"{by_loader / by_program:.0%}"
        )


if __name__ == "__main__":
    time_arrays()
    time_loader(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 100)
