import pickle

import numpy as np
import pytest

import tanglebin


@pytest.fixture(scope="module")
def told(recipe, scene):
    """What the recipe tells of the scene."""
    known = tanglebin.known_scene(recipe, tanglebin.CaseId("A", 3, 1))
    return tanglebin.scene_of(known)


def test_scene_files_are_read_and_written(source, tmp_path):
    scene = tanglebin.read_scene(source / "scenes" / "paper.toml")
    tanglebin.write_scene(tmp_path / "scene.toml", scene)
    again = tanglebin.read_scene(tmp_path / "scene.toml")
    assert again.toml() == scene.toml() == pickle.loads(pickle.dumps(scene)).toml()
    assert tanglebin.Scene().is_empty and not scene.is_empty
    assert repr(scene) == "<Scene: camera, bin, tubes>" and repr(tanglebin.Scene()) == "<Scene: nothing>"
    assert tanglebin.Scene().overridden(scene).toml() == scene.toml()
    with pytest.raises(tanglebin.InputError, match="scene:1: unknown key 'camra'"):
        tanglebin.Scene("[camra]\n")


def test_a_scan_is_read_with_what_is_known_of_it(scene, told, tmp_path):
    cloud = tanglebin.cloud_from_scan(scene.scan, tubes=3, with_bin=True)
    tanglebin.write_ply(tmp_path / "scan.ply", cloud)
    measured = tanglebin.read_measurement(tmp_path / "scan.ply", told)
    assert isinstance(measured, tanglebin.Measurement)
    resolved = tanglebin.resolve(measured.scene, measured.cloud)
    assert isinstance(resolved, tanglebin.ResolvedScene) and isinstance(resolved.notes, list)
    np.testing.assert_array_equal(resolved.cloud.points, cloud.points)
    assert repr(resolved) == f"<ResolvedScene of {len(cloud)} points: 1 kind of tubes, support: bin>"
    known = resolved.known
    assert isinstance(known, tanglebin.KnownScene) and known.camera == scene.scan.camera
    assert known.kinds[0].radius == 0.0125 and known.kinds[0].length == pytest.approx(0.5)
    assert known.kinds[0].segments == [tanglebin.Segment(length=0.5)]
    assert tanglebin.resolve_without_tubes(measured.scene, cloud).known.support.shape == "bin"


def test_what_is_missing_is_named():
    cloud = tanglebin.PointCloud(np.random.default_rng(0).random((100, 3)))
    with pytest.raises(tanglebin.InputError, match="camera"):
        tanglebin.resolve(tanglebin.Scene(), cloud)


def test_a_known_scene_is_made_in_code():
    kind = tanglebin.TubeKind(radius=0.01, segments=[tanglebin.Segment(length=0.4)])
    known = tanglebin.KnownScene(tanglebin.Support("plane"), tanglebin.camera_preset("kinect-v1"), [kind])
    assert known.kinds[0].length == 0.4
    with pytest.raises(tanglebin.InputError, match="radius"):
        tanglebin.KnownScene(tanglebin.Support(), tanglebin.camera_preset("paper"), [tanglebin.TubeKind(radius=-1)])


def test_the_kinds_of_a_known_scene_are_copies():
    known = tanglebin.KnownScene(tanglebin.Support(), tanglebin.camera_preset("paper"), [tanglebin.TubeKind(0.01)])
    kind = known.kinds[0]
    segment = kind.segments[0]
    known.kinds = [tanglebin.TubeKind(0.02)] * 100
    kind.segments = [tanglebin.Segment(length=0.2)] * 100
    assert kind.radius == 0.01 and segment == tanglebin.Segment()


def test_the_known_scene_of_a_random_recipe_has_the_numbers_of_the_case(source):
    varied = tanglebin.read_recipe(source / "recipes" / "varied.toml")
    case = varied.cases[1]
    known = tanglebin.known_scene(varied, case)
    assert known.camera == varied.resolved(case).camera != varied.camera


def test_a_camera_file_is_read(scene, tmp_path):
    (tmp_path / "camera.json").write_text(tanglebin.camera_json(scene.scan.camera))
    camera = tanglebin.read_camera_file(tmp_path / "camera.json")
    assert isinstance(camera, tanglebin.SceneCamera) and camera.intrinsics == scene.scan.camera.intrinsics
    np.testing.assert_allclose(camera.pose, scene.scan.camera.pose)
    assert camera.depth_scale == tanglebin.depth_scale and camera.unit is None


def test_the_bin_is_located(scene, recipe):
    camera = tanglebin.camera_preset("kinect-v1")
    scan = tanglebin.scan(scene.tubes, recipe.bin, camera)
    cloud = tanglebin.cloud_from_scan(scan, tubes=3, with_bin=True)
    located = tanglebin.locate(cloud, tanglebin.Support("bin", recipe.bin), camera)
    assert isinstance(located, tanglebin.Located)
    np.testing.assert_allclose(located.support.pose, np.eye(4), atol=0.002)
    assert located.residual < 0.001 and located.position_sd.shape == located.rotation_sd.shape == (3,)
    assert located.explained > 0.8 and located.contradicted < 0.05 and located.measured.length == pytest.approx(0.55, abs=0.01)
    assert all(isinstance(part, tanglebin.LocatedPart) for part in located.parts)
    assert "floor" in [part.name for part in located.parts]
