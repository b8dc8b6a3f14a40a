"""DBSCAN (Ester et al. 1996) on positions and normals, by scikit-learn (Debian: python3-sklearn).

tanglebin experiment dataset --out results --method dbscan='python3 dbscan.py {cloud} {scene} {out.npy}'
"""
import re
import sys

import numpy as np
from sklearn.cluster import DBSCAN
from sklearn.neighbors import NearestNeighbors

MARGIN = 0.001  # m, from the bin's floor and walls
NEIGHBOURS = 20  # of a point, for its normal
DISTANCE = 0.006  # m, between neighbours on a tube ...
ANGLE = 1.0  # ... and between their normals: a radian counts as DISTANCE / ANGLE


def read_points(file):
    """The positions (m) in a binary little-endian PLY file whose properties are all float."""
    data = open(file, "rb").read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    properties = re.findall(rb"property (\w+) (\w+)", data[:end])
    assert all(kind == b"float" for kind, _ in properties), properties
    return np.frombuffer(data[end:], "<f4").reshape(-1, len(properties))[:, :3].astype(float)


def support(scene, key):
    """A number of the scene file's [support], m."""
    table = scene.split("[support]")[1].split("\n[")[0]
    return float(re.search(rf"^{key} = (\S+)", table, re.MULTILINE)[1])


def normals_of(points):
    """The direction of least variance among the nearest points, upwards."""
    _, nearest = NearestNeighbors(n_neighbors=NEIGHBOURS).fit(points).kneighbors(points)
    around = points[nearest] - points[nearest].mean(axis=1, keepdims=True)
    _, axes = np.linalg.eigh(np.einsum("pni,pnj->pij", around, around))
    normals = axes[:, :, 0]
    return normals * np.where(normals[:, 2:] < 0, -1, 1)


if len(sys.argv) != 4:
    sys.exit("usage: dbscan.py CLOUD.ply SCENE.toml OUT.npy")
cloud, scene_file, out = sys.argv[1:]
points = read_points(cloud)
scene = open(scene_file).read()
half = np.array([support(scene, "length"), support(scene, "width")]) / 2 - MARGIN
with np.errstate(invalid="ignore"):  # points without a position are NaN
    on_tubes = (np.abs(points[:, :2]) < half).all(axis=1) & (points[:, 2] > MARGIN)
labels = np.zeros(len(points), np.int32)
if on_tubes.sum() > NEIGHBOURS:
    features = np.hstack([points[on_tubes], normals_of(points[on_tubes]) * DISTANCE / ANGLE])
    labels[on_tubes] = DBSCAN(eps=DISTANCE, min_samples=5).fit_predict(features) + 1
np.save(out, labels)
