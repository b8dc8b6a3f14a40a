"""Reads an export with readers that are not Tanglebin's, and compares it with the dataset.

    check_export.py FORMAT DATASET EXPORT

The dataset has depth images, label images and occlusions. Fails with an AssertionError at the first difference.
Whole masks are compared with a calculation of their own: which rays pass a tube's centre line within its radius.
"""
import io
import json
import pathlib
import sys
import tarfile

import h5py
import numpy as np
from PIL import Image

STEPS = 10000  # of a depth image in a metre
NOTHING = 65535


def pixels_of(file):
    return np.array(Image.open(file)).astype(np.int64)


def tubes_in(file):
    """The tubes of a configuration: (radius, edges as pairs of points)."""
    lines = iter(pathlib.Path(file).read_text().splitlines())
    tubes = []
    for _ in range(int(next(lines))):
        _, n_nodes, n_edges = (int(field) for field in next(lines).split())
        nodes, radius = {}, 0
        for _ in range(n_nodes):
            identity, x, y, z, radius = (float(field) for field in next(lines).split())
            nodes[int(identity)] = np.array([x, y, z])
        edges = [next(lines).split() for _ in range(n_edges)]
        tubes.append((radius, [(nodes[int(edge[1])], nodes[int(edge[2])]) for edge in edges]))
    return tubes


def rays_of(camera):
    width, height = camera["width"], camera["height"]
    fx, _, _, _, fy, _, cx, cy, _ = camera["intrinsic_matrix"]
    pose = np.array(camera["camera_to_world"])
    u, v = np.meshgrid(np.arange(width), np.arange(height))
    directions = np.stack([(u - cx) / fx, (v - cy) / fy, np.ones((height, width))], -1) @ pose[:3, :3].T
    return pose[:3, 3], directions / np.linalg.norm(directions, axis=-1, keepdims=True)


def distances_from(ray_origin, directions, a, b):
    """Of each ray from the segment a-b, m."""
    across = lambda vector: vector - (directions @ vector)[..., None] * directions
    start, along = across(a - ray_origin), across(b - a)
    s = np.clip(-(start * along).sum(-1) / (along**2).sum(-1), 0, 1)
    return np.linalg.norm(start + s[..., None] * along, axis=-1)


class View:
    """What the dataset says of a scanner's view of a case."""

    def __init__(self, dataset, case):
        folder = pathlib.Path(dataset) / case["folder"]
        own = folder / case["scanner"]
        number = case["number"]
        self.case = case
        self.steps = pixels_of(own / f"depths/{number}.png")
        self.labels = pixels_of(own / f"labels/{number}.png")
        self.camera = json.loads((own / f"depths/{number}.json").read_text())
        self.facts = json.loads((own / f"occlusions/{number}.json").read_text())
        self.configuration = (folder / f"tube_configurations/{number}.txt").read_text()
        self.cloud = (own / f"plys/{number}.ply").read_bytes()
        self.tubes = tubes_in(folder / f"tube_configurations/{number}.txt")

    @property
    def name(self):
        scanner = self.case["scanner"]
        return f"{self.case['folder']}-{self.case['number']:06}" + (f"-{scanner}" if scanner else "")

    def expect_depth(self, metres):
        """Depths in metres, NaN for none, are those of the dataset's image."""
        assert metres.dtype == np.float32
        steps = np.where(np.isnan(metres), 0, np.floor(metres.astype(np.float64) * STEPS + 0.5))
        assert np.array_equal(steps, self.steps)

    def expect_visible(self, tube, mask):
        assert np.array_equal(mask.astype(bool), self.labels == tube), f"tube {tube}"

    def expect_whole(self, tube, mask):
        radius, edges = self.tubes[tube - 1]
        origin, directions = rays_of(self.camera)
        distance = np.min([distances_from(origin, directions, a, b) for a, b in edges], axis=0)
        differs = mask.astype(bool) != (distance <= radius)
        assert not (differs & (abs(distance - radius) > 1e-9)).any(), f"tube {tube}"
        assert mask.sum() == self.facts["tubes"][tube - 1]["whole_pixels"]

    def expect_facts(self, facts, whole):
        """Facts are the dataset's, and add up with the whole masks."""
        assert facts == self.facts
        ideal = self.case["scanner"] != "beside"
        shares = facts["tubes"]
        for i, mask in enumerate(whole, 1):
            if ideal:
                assert shares[i - 1]["visible_pixels"] == (self.labels == i).sum()
            for j, other in enumerate(whole, 1):
                both = (mask & other).astype(bool)
                between = [c for c in facts["crossings"] if {c["over"], c["under"]} == {i, j}]
                if i < j:
                    assert sum(c["pixels"] for c in between) == both.sum(), f"tubes {i} and {j}"
                if ideal and i != j:
                    seen = sum(c["visible_pixels"] for c in between if c["over"] == i)
                    assert seen == (both & (self.labels == i)).sum(), f"{i} over {j}"
        for contact in facts["contacts"]:
            for tube in [contact["tube"]] + ([contact["other"]] if contact["other"] else []):
                radius, edges = self.tubes[tube - 1]
                point = np.array(contact["point"])
                toward = lambda a, b: np.clip((point - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
                distance = min(np.linalg.norm(point - a - toward(a, b) * (b - a)) for a, b in edges)
                assert abs(distance - radius - contact["gap"] / 2) < 1e-6


def views_of(dataset):
    for line in (pathlib.Path(dataset) / "manifest.jsonl").read_text().splitlines():
        record = json.loads(line)
        for scanner in [entry["name"] for entry in record.get("scanners", [])] or [""]:
            yield View(dataset, {"folder": f"{record['set']}{record['tubes']}", "number": record["case"],
                                 "scanner": scanner})


def unpacked(starts, pixels, shape):
    masks = []
    for first, end in zip(starts[:-1], starts[1:]):
        mask = np.zeros(shape, bool)
        mask.reshape(-1)[pixels[first:end]] = True
        masks.append(mask)
    return masks


def decoded(segmentation):
    """The mask of COCO's compressed run lengths, by their specification."""
    height, width = segmentation["size"]
    lengths, number, shift = [], 0, 0
    for character in segmentation["counts"].encode("ascii"):
        bits = character - 48
        number |= (bits & 31) << shift
        shift += 5
        if bits & 32:
            continue
        if bits & 16:
            number -= 1 << shift
        if len(lengths) > 2:
            number += lengths[-2]
        lengths.append(number)
        number, shift = 0, 0
    values = np.arange(len(lengths)) % 2 == 1
    return np.repeat(values, lengths).reshape(width, height).T


def filled(polygons, shape):
    """The union of polygons along pixel edges, each filled by the even-odd rule."""
    mask = np.zeros(shape, bool)
    for polygon in polygons:
        corners = np.array(polygon).reshape(-1, 2)
        one = np.zeros(shape, bool)
        for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0)):
            assert x0 == x1 or y0 == y1
            one[y0:, min(x0, x1):max(x0, x1)] ^= True
        assert not (mask & one).any(), "polygons overlap"
        mask |= one
    return mask


def box_of(mask):
    rows, columns = np.nonzero(mask)
    return [columns.min(), rows.min(), np.ptp(columns) + 1, np.ptp(rows) + 1] if len(rows) else None


def check_coco(dataset, export):
    files = {name: json.loads((export / f"annotations/{name}.json").read_text())
             for name in ("instances", "instances_polygons", "amodal")}
    for file in files.values():
        identities = [annotation["id"] for annotation in file["annotations"]]
        assert len(set(identities)) == len(identities)
        assert [category["name"] for category in file["categories"]] == ["tube"]
    of_image = lambda name, image: {annotation["tube"]: annotation for annotation in files[name]["annotations"]
                                    if annotation["image_id"] == image["id"]}
    views = list(views_of(dataset))
    images = files["instances"]["images"]
    assert [image["file_name"] for image in images] == [f"depth/{view.name}.png" for view in views]
    for view, image in zip(views, images):
        shape = view.labels.shape
        assert (image["height"], image["width"]) == shape
        assert np.array_equal(pixels_of(export / image["file_name"]), view.steps)
        instances, outlines, amodal = (of_image(name, image) for name in files)
        whole = []
        for tube in range(1, len(view.tubes) + 1):
            seen = view.labels == tube
            assert (tube in instances) == (tube in outlines) == bool(seen.any())
            if tube in instances:
                annotation = instances[tube]
                view.expect_visible(tube, decoded(annotation["segmentation"]))
                view.expect_visible(tube, filled(outlines[tube]["segmentation"], shape))
                assert annotation["area"] == seen.sum() and annotation["bbox"] == box_of(seen)
            whole.append(decoded(amodal[tube]["segmentation"]))
            view.expect_whole(tube, whole[-1])
            assert amodal[tube]["bbox"] == box_of(whole[-1])
            assert amodal[tube]["visible_share"] == view.facts["tubes"][tube - 1]["visible_share"]
        view.expect_facts(image["occlusions"], whole)


def check_numpy(dataset, export):
    for view in views_of(dataset):
        case = view.case
        with np.load(export / case["folder"] / case["scanner"] / f"{case['number']}.npz") as file:
            arrays = dict(file)
        view.expect_depth(arrays["depth"])
        assert np.array_equal(np.where(arrays["labels"] < 0, NOTHING, arrays["labels"]), view.labels)
        points = np.frombuffer(view.cloud.split(b"end_header\n", 1)[1],
                               dtype=[("xyz", "<f4", 3), ("rgb", "u1", 3), ("label", "<i4")])
        assert np.array_equal(arrays["points"], points["xyz"])
        assert np.array_equal(arrays["point_labels"], points["label"])
        assert np.array_equal(arrays["intrinsics"].T.reshape(-1), view.camera["intrinsic_matrix"])
        assert np.array_equal(arrays["camera_to_world"], view.camera["camera_to_world"])
        whole = unpacked(arrays["whole_mask_starts"], arrays["whole_mask_pixels"], view.labels.shape)
        for tube, mask in enumerate(whole, 1):
            view.expect_whole(tube, mask)
        names = {"visible_share": "tubes", "crossing_over": "crossings", "crossing_point": "crossings",
                 "contact_tube": "contacts", "contact_gap": "contacts", "contact_point": "contacts"}
        for name, of in names.items():
            expected = [entry[name.split("_", 1)[1] if of != "tubes" else name] for entry in view.facts[of]]
            expected = np.array(expected).reshape(arrays[name].shape)
            assert np.allclose(arrays[name], expected, rtol=0, atol=1e-9), name
        nodes = arrays["node_position"][arrays["edge_nodes"]]
        assert np.array_equal(nodes, [edge for _, edges in view.tubes for edge in edges])


def check_hdf5(dataset, export):
    for view in views_of(dataset):
        case = view.case
        with h5py.File(export / case["folder"] / case["scanner"] / f"{case['number']}.hdf5", "r") as file:
            data = {key: np.array(file[key]) for key in file}
        text = lambda key: json.loads(data[key].tobytes())
        view.expect_depth(data["depth"])
        assert np.array_equal(data["instance_segmaps"], view.labels)
        attributes = {entry["idx"]: entry for entry in text("instance_attribute_maps")}
        for instance in np.unique(view.labels):
            category = attributes[instance]["category_id"]
            assert (data["category_id_segmaps"][view.labels == instance] == category).all()
            assert category == {0: 2, NOTHING: 0}.get(instance, 1)
        whole = unpacked(data["whole_mask_starts"], data["whole_mask_pixels"], view.labels.shape)
        for tube, mask in enumerate(whole, 1):
            view.expect_whole(tube, mask)
        view.expect_facts(text("scene")["occlusions"], whole)


def check_webdataset(dataset, export):
    samples = {}
    for shard in sorted(export.glob("*.tar")):
        with tarfile.open(shard) as tar:
            for member in tar:
                key, extension = member.name.split(".", 1)
                samples.setdefault(key, {})[extension] = tar.extractfile(member).read()
    views = list(views_of(dataset))
    assert list(samples) == [view.name for view in views]
    for view, sample in zip(views, samples.values()):
        assert np.array_equal(pixels_of(io.BytesIO(sample["depth.png"])), view.steps)
        assert np.array_equal(pixels_of(io.BytesIO(sample["labels.png"])), view.labels)
        assert sample["ply"] == view.cloud
        assert sample["tubes.txt"].decode() == view.configuration
        about = json.loads(sample["json"])
        assert about["camera"] == view.camera
        whole = [decoded(mask) for mask in about["whole_masks"]]
        for tube, mask in enumerate(whole, 1):
            view.expect_whole(tube, mask)
        view.expect_facts(about["occlusions"], whole)


def vertices_of(ply):
    header, body = ply.split(b"end_header\n", 1)
    count = int(header.split(b"element vertex ")[1].split()[0])
    assert b"format binary_little_endian 1.0" in header
    return np.frombuffer(body, dtype=[("xyz", "<f4", 3), ("rgb", "u1", 3)], count=count)["xyz"].astype(float)


def check_bop(dataset, export):
    models = json.loads((export / "models/models_info.json").read_text())
    scenes = sorted((export / "train").iterdir())
    views = iter(views_of(dataset))
    objects = set()
    for scene in scenes:
        cameras, poses, infos, facts = (json.loads((scene / f"scene_{name}.json").read_text())
                                        for name in ("camera", "gt", "gt_info", "tanglebin"))
        for image in cameras:
            view, camera = next(views), cameras[image]
            depth = pixels_of(scene / f"depth/{int(image):06}.png")
            assert np.array_equal(depth, view.steps) and camera["depth_scale"] == 0.1
            assert np.array_equal(np.reshape(camera["cam_K"], (3, 3)).T.reshape(-1), view.camera["intrinsic_matrix"])
            whole = []
            for i, (pose, info) in enumerate(zip(poses[image], infos[image])):
                mask, visible = (pixels_of(scene / f"{kind}/{int(image):06}_{i:06}.png") for kind in ("mask", "mask_visib"))
                assert set(np.unique(mask)) <= {0, 255}
                view.expect_visible(i + 1, visible)
                whole.append(mask > 0)
                view.expect_whole(i + 1, whole[-1])
                assert info["px_count_all"] == (mask > 0).sum() and info["px_count_visib"] == (visible > 0).sum()
                assert info["visib_fract"] == ((mask > 0) & (visible > 0)).sum() / max(1, (mask > 0).sum())
                assert info["px_count_valid"] == ((mask > 0) & (depth > 0)).sum()
                assert info["bbox_obj"] == box_of(mask) and info["bbox_visib"] == (box_of(visible) or [-1] * 4)
                # The model in this pose is the tube in the scene.
                objects.add(pose["obj_id"])
                rotation, shift = np.reshape(pose["cam_R_m2c"], (3, 3)), np.array(pose["cam_t_m2c"])
                vertices = vertices_of((export / f"models/obj_{pose['obj_id']:06}.ply").read_bytes())
                to_world = np.array(view.camera["camera_to_world"])
                world = (vertices @ rotation.T + shift) / 1000 @ to_world[:3, :3].T + to_world[:3, 3]
                radius, edges = view.tubes[i]
                nearest = np.full(len(world), np.inf)
                for a, b in edges:
                    s = np.clip((world - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
                    nearest = np.minimum(nearest, np.linalg.norm(world - a - s[:, None] * (b - a), axis=1))
                assert (nearest < radius + 1e-6).all() and nearest.max() > radius - 1e-6
                size = models[str(pose["obj_id"])]
                assert np.allclose([size["size_x"], size["size_y"], size["size_z"]], np.ptp(vertices, axis=0), atol=0.5)
                assert np.allclose([size["min_x"], size["min_y"], size["min_z"]], vertices.min(axis=0), atol=0.25)
            view.expect_facts(facts[image]["occlusions"], whole)
    assert next(views, None) is None
    assert {str(number) for number in objects} == set(models)


if __name__ == "__main__":
    chosen, dataset, export = sys.argv[1:]
    checks = {"coco": check_coco, "numpy": check_numpy, "hdf5": check_hdf5, "webdataset": check_webdataset,
              "bop": check_bop}
    checks[chosen](dataset, pathlib.Path(export))
