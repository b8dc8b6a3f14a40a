"""Datasets as sequences of cases that are read when they are asked for."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import Iterator, Sequence, overload

import numpy as np
from numpy.typing import NDArray

from tanglebin._core import CaseId, CaseRecord, Index, KnownScene, PointCloud, Recipe, SceneScore, Tube


class Case:
    """A case of a dataset. Each of its parts is read, and checked against the manifest, when it is first asked for.

    Raises InputError naming the file that is missing, has another checksum than in the manifest, or cannot be read.
    """

    def __init__(self, index: Index, id: CaseId) -> None:
        self._index = index
        self.id = id

    @cached_property
    def _first_scanner(self) -> str:
        return self._index.recipe.scanner_name

    @cached_property
    def record(self) -> CaseRecord:
        """Its entry in the manifest."""
        return self._index.record(self.id)

    @cached_property
    def recipe(self) -> Recipe:
        """The dataset's recipe with the numbers that were drawn for the case."""
        return self._index.recipe_of(self.id)

    @cached_property
    def tubes(self) -> list[Tube]:
        """The true tubes, m, world frame."""
        return self._index.tubes(self.id)

    @cached_property
    def cloud(self) -> PointCloud:
        """The first scanner's cloud with the true labels, m, world frame."""
        return self.cloud_of(self._first_scanner)

    @cached_property
    def known(self) -> KnownScene:
        """What model_tubes() is told of the first scanner's cloud: bin, camera, and kinds of tubes."""
        return self.known_of(self._first_scanner)

    @cached_property
    def depths(self) -> NDArray[np.float32]:
        """The first scanner's depths along the camera's z axis, h x w, m; NaN if nothing was measured."""
        return self.depths_of(self._first_scanner)

    @cached_property
    def labels(self) -> NDArray[np.int32]:
        """The first scanner's label image, h x w: 0 is the bin, 1 to n are the tubes, -1 is null."""
        return self.labels_of(self._first_scanner)

    def cloud_of(self, scanner: str) -> PointCloud:
        """Reads the cloud of the scanner of this name."""
        return self._index.cloud(self.id, scanner)

    def known_of(self, scanner: str) -> KnownScene:
        """What model_tubes() is told of the cloud of the scanner of this name. Raises InputError if there is none."""
        return self._index.known(self.id, scanner)

    def depths_of(self, scanner: str) -> NDArray[np.float32]:
        """Reads the depths of the scanner of this name."""
        return self._index.depths(self.id, scanner)

    def labels_of(self, scanner: str) -> NDArray[np.int32]:
        """Reads the label image of the scanner of this name."""
        return self._index.labels(self.id, scanner)

    def score_labels(self, labels: str | os.PathLike[str], scanner: str | None = None) -> SceneScore:
        """Scores the labels in a directory that are of its cloud, of all points on tubes (docs/benchmark.md).

        The scanner is the first if none is named. mean_scores() sums up many.
        """
        return self._index.score_labels(self.id, labels, self._first_scanner if scanner is None else scanner)

    def __repr__(self) -> str:
        return f"<Case {self.id} of {self._index.directory}>"


class Dataset(Sequence[Case]):
    """The finished cases of a dataset's directory, in the recipe's order. dataset[i] reads nothing but the index.

    A dataset can be sent to worker processes: it goes as its path. Raises InputError if the directory has no recipe,
    or if a file cannot be read.
    """

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self._index = Index(directory)

    @property
    def directory(self) -> Path:
        """Where it is."""
        return Path(self._index.directory)

    @property
    def recipe(self) -> Recipe:
        """The recipe that it was made from."""
        return self._index.recipe

    @cached_property
    def ids(self) -> list[CaseId]:
        """The finished cases."""
        return self._index.ids

    def __len__(self) -> int:
        return len(self.ids)

    @overload
    def __getitem__(self, position: int) -> Case: ...

    @overload
    def __getitem__(self, position: slice) -> list[Case]: ...

    def __getitem__(self, position: int | slice) -> Case | list[Case]:
        if isinstance(position, slice):
            return [Case(self._index, id) for id in self.ids[position]]
        return Case(self._index, self.ids[position])

    def __iter__(self) -> Iterator[Case]:
        return (Case(self._index, id) for id in self.ids)

    def __repr__(self) -> str:
        return f"<Dataset {self.directory}: {len(self)} cases>"
