#!/usr/bin/env python3
"""Feeds PyTorch with labelled clouds: scenes drawn on the fly in worker processes, or those of a dataset on disk.

    train_loader.py RECIPE.toml [--scenes 100] [--workers 2]
    train_loader.py DATASET [--workers 2]

Scene i is always the same, whichever worker draws it. Each sample has `points` (n x 3 float32, m, world frame) and
`labels` (n int32: 1, 2, … are the tubes). The two classes are plain sequences; only the DataLoader needs PyTorch.
"""

import argparse
import time
from pathlib import Path

import tanglebin


def sample_of(cloud):
    return {"points": cloud.points, "labels": cloud.labels}


class DrawnScenes:
    """Scenes of a recipe's first set, drawn when they are asked for. There are as many as you like.

    If the set lists several numbers of tubes, they take turns.
    """

    def __init__(self, recipe, scenes):
        self.recipe = tanglebin.Recipe(recipe.toml())
        first, *others = self.recipe.sets
        first.cases = scenes
        self.recipe.sets = [first, *others]
        of_first = [id for id in self.recipe.cases if id.set == first.name]
        self.ids = sorted(of_first, key=lambda id: id.number)[:scenes]

    def __len__(self):
        return len(self.ids)

    def __getitem__(self, i):
        scene = tanglebin.simulate(self.recipe, self.ids[i])
        return sample_of(tanglebin.cloud_from_scan(scene.scan, tubes=self.ids[i].tubes))


class SavedScenes:
    """The scenes of a dataset on disk, read when they are asked for."""

    def __init__(self, directory):
        self.dataset = tanglebin.Dataset(directory)

    def __len__(self):
        return len(self.dataset)

    def __getitem__(self, i):
        return sample_of(self.dataset[i].cloud)


def tensors(batch):
    """A batch is a list, because clouds differ in size."""
    import torch

    return [{name: torch.from_numpy(array) for name, array in sample.items()} for sample in batch]


def loader(scenes, workers, batch=4):
    from torch.utils.data import DataLoader

    return DataLoader(scenes, batch_size=batch, num_workers=workers, collate_fn=tensors)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=Path, help="recipe (TOML) or directory of a dataset")
    parser.add_argument("--scenes", type=int, default=100, help="how many to draw")
    parser.add_argument("--workers", type=int, default=2, help="worker processes")
    arguments = parser.parse_args()

    if arguments.source.is_dir():
        scenes = SavedScenes(arguments.source)
    else:
        scenes = DrawnScenes(tanglebin.read_recipe(arguments.source), arguments.scenes)
    start = time.perf_counter()
    points = 0
    for batch in loader(scenes, arguments.workers):
        points += sum(len(sample["points"]) for sample in batch)  # train here
    seconds = time.perf_counter() - start
    print(f"{len(scenes)} scenes, {points} points, {len(scenes) / seconds:.1f} scenes a second")


if __name__ == "__main__":
    main()
