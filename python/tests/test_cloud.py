import gc
import pickle

import numpy as np
import pytest

import tanglebin

PROPERTIES = ["points", "labels", "colors", "normals", "intensities", "mixed"]


def a_cloud():
    points = np.arange(12, dtype=np.float32).reshape(4, 3)
    return tanglebin.PointCloud(
        points,
        labels=[0, 1, 2, -1],
        colors=np.full((4, 3), 7, np.uint8),
        normals=np.tile([0, 0, 1], (4, 1)),
        intensities=[0.5, 1, 1, 1],
        mixed=[0, 0, 1, 0],
    )


def expect_same(cloud, other):
    for name in PROPERTIES:
        np.testing.assert_array_equal(getattr(cloud, name), getattr(other, name))
    assert (cloud.width, cloud.height) == (other.width, other.height)


def test_arrays_have_the_types_that_are_promised():
    cloud = a_cloud()
    assert len(cloud) == 4 and (cloud.height, cloud.width) == (1, 4)
    types = [getattr(cloud, name).dtype.name for name in PROPERTIES]
    assert types == ["float32", "int32", "uint8", "float32", "float32", "uint8"]
    assert [getattr(cloud, name).shape for name in PROPERTIES] == [(4, 3), (4,), (4, 3), (4, 3), (4,), (4,)]


@pytest.mark.parametrize("name", PROPERTIES)
def test_arrays_are_in_the_clouds_memory_and_keep_it_alive(name):
    cloud = a_cloud()
    array = getattr(cloud, name)
    assert np.shares_memory(array, getattr(cloud, name)) and not array.flags.owndata
    array.flat[0] = 1
    assert getattr(cloud, name).flat[0] == 1
    before = array.copy()
    del cloud
    gc.collect()
    np.testing.assert_array_equal(array, before)


def test_an_array_stays_valid_whatever_becomes_of_the_property():
    cloud = a_cloud()
    labels = cloud.labels
    cloud.labels = [3, 3, 3, 3]
    np.testing.assert_array_equal(labels, [3, 3, 3, 3])  # written in place
    cloud.labels = None
    assert cloud.labels is None
    cloud.labels = np.array([5, 5, 5, 5], np.int64)
    np.testing.assert_array_equal(labels, [5, 5, 5, 5])


def test_what_was_given_is_copied():
    points = np.zeros((2, 3), np.float32)
    cloud = tanglebin.PointCloud(points)
    points[:] = 1
    assert not cloud.points.any()
    assert cloud.labels is None and cloud.colors is None and cloud.viewpoint is None


def test_an_image_of_points_is_an_organized_cloud():
    cloud = tanglebin.PointCloud(np.zeros((3, 5, 3)), labels=np.zeros((3, 5), int), viewpoint=np.eye(4))
    assert (cloud.height, cloud.width, len(cloud)) == (3, 5, 15)
    np.testing.assert_array_equal(cloud.viewpoint, np.eye(4))
    expect_same(pickle.loads(pickle.dumps(cloud)), cloud)


@pytest.mark.parametrize(
    "arguments, message",
    [
        (dict(points=np.zeros((4, 2))), r"points: found an array of shape \(4, 2\), expected n x 3"),
        (dict(points=np.zeros((4, 3)), labels=[1, 2]), "labels: found 2, expected one for each of 4 points"),
        (dict(points=np.zeros((1, 3)), labels=[0.5]), "labels: found an array of float64, expected an array of integ"),
        (dict(points=np.zeros((1, 3)), labels=[2**40]), "labels: found 1099511627776, expected an integer from"),
        (
            dict(points=np.zeros((1, 3)), labels=np.array([2**64 - 1], np.uint64)),
            "labels: found 18446744073709551615, expected an integer from",
        ),
        (dict(points=np.zeros((1, 3)), labels=[-2]), "labels: found -2, expected a label from -1, which is null, to 2147483647"),
        (dict(points=np.zeros((1, 3)), colors=[[0, 0, 256]]), "colors: found 256, expected an integer from 0 to 255"),
    ],
)
def test_what_is_no_cloud_is_refused(arguments, message):
    with pytest.raises(tanglebin.InputError, match=message):
        tanglebin.PointCloud(**arguments)


@pytest.mark.parametrize(
    "write, read, name",
    [(tanglebin.write_ply, tanglebin.read_ply, "1.ply"), (tanglebin.write_pcd, tanglebin.read_pcd, "1.pcd")],
)
def test_clouds_are_written_and_read(write, read, name, tmp_path):
    write(tmp_path / name, a_cloud())
    expect_same(read(tmp_path / name), a_cloud())
    expect_same(tanglebin.read_cloud(str(tmp_path / name)), a_cloud())


def test_errors_say_where_they_are(tmp_path):
    file = tmp_path / "bad.ply"
    file.write_text("ply\nformat ascii 1.0\nelement vertex x\n")
    with pytest.raises(tanglebin.InputError) as caught:
        tanglebin.read_ply(file)
    assert isinstance(caught.value, ValueError)
    assert caught.value.file == str(file) and caught.value.line == 3
    assert str(caught.value) == f"{file}:3: {caught.value.field}: {caught.value.problem}"


def test_what_the_system_refuses_is_an_os_error():
    with pytest.raises(tanglebin.SystemError, match="No space left on device") as caught:
        tanglebin.write_ply("/dev/full", a_cloud())
    assert isinstance(caught.value, OSError)


def test_tubes_are_written_and_read(tmp_path):
    tube = tanglebin.Tube([[0, 0, 0.1], [0.2, 0, 0.1], [0.2, 0.1, 0.1]], radius=0.0125)
    tanglebin.write_configuration(tmp_path / "1.txt", [tube])
    (read,) = tanglebin.read_configuration(tmp_path / "1.txt")
    np.testing.assert_array_equal(read.nodes, tube.nodes)
    meshes = [tanglebin.mesh_of(tube)]
    tanglebin.write_mesh_ply(tmp_path / "1.ply", meshes)
    tanglebin.write_mesh_obj(tmp_path / "1.obj", meshes)
    assert (tmp_path / "1.ply").read_bytes().startswith(b"ply")
    assert "\no tube_1\n" in (tmp_path / "1.obj").read_text()


def test_images_are_written_and_read(tmp_path):
    depths = np.array([[1.5, np.nan], [0.25, 2]], np.float32)
    (tmp_path / "depth.png").write_bytes(tanglebin.depth_png(depths))
    read = tanglebin.read_depths(tmp_path / "depth.png", steps_per_metre=tanglebin.depth_scale)
    assert read.dtype == np.float32
    np.testing.assert_array_equal(read, depths)
    np.save(tmp_path / "depth.npy", depths)
    np.testing.assert_array_equal(tanglebin.read_depths(tmp_path / "depth.npy"), depths)

    labels = np.array([[0, 1, 2], [-1, 3, 0]])
    (tmp_path / "labels.png").write_bytes(tanglebin.label_png(labels))
    read = tanglebin.read_labels(tmp_path / "labels.png")
    assert read.dtype == np.int32
    np.testing.assert_array_equal(read, labels)
    with pytest.raises(tanglebin.InputError, match=r"labels: found an array of shape \(3,\), expected h x w"):
        tanglebin.label_png([1, 2, 3])


def test_depths_become_points_in_the_cameras_frame():
    depths = np.full((3, 5), 2, np.float32)
    cloud = tanglebin.cloud_from_depths(depths, tanglebin.Intrinsics(5, 3, 10, 10, 2, 1))
    points = cloud.points.reshape(cloud.height, cloud.width, 3)
    np.testing.assert_allclose(points[0, 4], [0.4, -0.2, 2], atol=1e-6)
    depths[0, :3] = [0, -1, np.inf]
    nothing = tanglebin.cloud_from_depths(depths, tanglebin.Intrinsics(5, 3, 10, 10, 2, 1)).points[:3]
    assert np.isnan(nothing).all()
    assert '"width": 1920' in tanglebin.camera_json(tanglebin.camera_preset("paper"))


@pytest.mark.parametrize("intrinsics", [(5, 3, 0, 10, 2, 1), (5, 3, 10, np.nan, 2, 1)])
def test_depths_need_a_focal_length(intrinsics):
    with pytest.raises(ValueError, match="expected a positive number of pixels"):
        tanglebin.cloud_from_depths(np.ones((3, 5), np.float32), tanglebin.Intrinsics(*intrinsics))


@pytest.mark.parametrize("kind", [complex, bool, str])
def test_points_are_real_numbers(kind):
    other = np.zeros((2, 3)).astype(kind)
    with pytest.raises(ValueError, match="points: found an array of .*, expected an array of real numbers"):
        tanglebin.PointCloud(other)
    with pytest.raises(ValueError, match="normals: found an array of .*, expected an array of real numbers"):
        tanglebin.PointCloud(np.zeros((2, 3)), normals=other)


def test_labels_give_colours():
    colors = tanglebin.label_colors(2)
    assert colors.shape == (3, 3) and len({tuple(color) for color in colors}) == 3
    cloud = tanglebin.labelled(tanglebin.PointCloud(np.zeros((2, 3))), [1, 2])
    np.testing.assert_array_equal(cloud.colors, colors[1:])
    with pytest.raises(tanglebin.InputError, match="labels: found 1, expected one for each of 2"):
        tanglebin.labelled(cloud, [1])
