#!/usr/bin/env python3
"""Scores an algorithm on every case of a dataset. Put yours in the place of label_points().

    score_my_algorithm.py DATASET

Prints the micro-recall of each case, and their mean: the share of the points on tubes whose label is the one assigned
to their tube (docs/metrics.md).
"""

import argparse

import numpy as np
import tanglebin


def label_points(points):
    """An example to be beaten: points in neighbouring cells of 2 cm belong together.

    points: n x 3 float32, m, world frame. Returns a label for each: 1, 2, … for the tubes, -1 for none.
    """
    cells, cell_of_point = np.unique(np.floor(points / 0.02).astype(int), axis=0, return_inverse=True)
    index = {tuple(cell): i for i, cell in enumerate(cells)}
    label_of_cell = np.full(len(cells), -1)
    label = 0
    for start in range(len(cells)):
        if label_of_cell[start] >= 0:
            continue
        label += 1
        to_visit = [start]
        while to_visit:
            cell = to_visit.pop()
            if label_of_cell[cell] >= 0:
                continue
            label_of_cell[cell] = label
            for step in np.ndindex(3, 3, 3):
                neighbour = index.get(tuple(cells[cell] + np.array(step) - 1))
                if neighbour is not None and label_of_cell[neighbour] < 0:
                    to_visit.append(neighbour)
    return label_of_cell[cell_of_point.ravel()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dataset", help="directory of a dataset")
    dataset = tanglebin.Dataset(parser.parse_args().dataset)
    recalls = []
    for case in dataset:
        on_tubes = case.cloud.labels > 0
        labels = np.full(len(case.cloud), -1)
        labels[on_tubes] = label_points(case.cloud.points[on_tubes])
        score = tanglebin.score(case.cloud.labels, labels)
        recalls.append(score.micro_recall)
        print(f"{case.id}: micro-recall {score.micro_recall:.3f}, {score.detection.f1:.3f} F1 of whole tubes")
    print(f"mean micro-recall of {len(recalls)} cases: {np.mean(recalls):.3f}")


if __name__ == "__main__":
    main()
