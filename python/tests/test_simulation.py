import pickle
import threading
import time

import numpy as np
import pytest
from interrupted import Interruption

import tanglebin


def drawn_tubes(count, seed=1):
    rng = tanglebin.Rng(seed)
    spec = tanglebin.TubeSpec(segments=[tanglebin.SegmentSpec(bend_max=0.5)])
    tubes = [tanglebin.draw_tube(rng, spec, id) for id in range(1, count + 1)]
    return tanglebin.spawn(rng, tubes, tanglebin.Bin())


def test_tubes_are_drawn_dropped_and_scanned():
    tubes = drawn_tubes(3)
    assert [tube.id for tube in tubes] == [1, 2, 3]
    assert min(tube.nodes[:, 2].min() for tube in tubes) > tanglebin.Bin().height
    settled = tanglebin.settle(tubes, tanglebin.Bin(), seed=1)
    assert isinstance(settled, tanglebin.Settled) and 0 < settled.simulated < 10
    assert settled.fault == "" and tanglebin.fault_of_heap(settled.tubes) == ""
    assert max(tube.nodes[:, 2].max() for tube in settled.tubes) < 0.3
    overlap = max(
        tanglebin.largest_tube_overlap(settled.tubes), tanglebin.largest_bin_overlap(settled.tubes, tanglebin.Bin())
    )
    assert overlap == settled.largest_overlap < 0.0003
    scan = tanglebin.scan(settled.tubes, tanglebin.Bin(), tanglebin.camera_preset("kinect-v1"))
    assert set(np.unique(scan.labels)) == {-1, 0, 1, 2, 3}


def test_the_same_seed_gives_the_same_tubes():
    assert tanglebin.Rng(5)() == tanglebin.Rng(5)() != tanglebin.Rng(6)()
    for first, second, other in zip(drawn_tubes(2), drawn_tubes(2), drawn_tubes(2, seed=2)):
        np.testing.assert_array_equal(first.nodes, second.nodes)
        assert first.nodes.shape != other.nodes.shape or (first.nodes != other.nodes).any()


def test_settings_are_checked():
    settings = tanglebin.SettleSettings()
    assert settings == tanglebin.SettleSettings() and settings.gravity == 9.8
    settings.step = 1
    with pytest.raises(tanglebin.InputError, match="settle.step: found 1, expected more than 0, at most 0.01 s"):
        tanglebin.settle(drawn_tubes(1), settings=settings)
    with pytest.raises(tanglebin.InputError, match="tube.radius"):
        tanglebin.TubeSpec(radius=-1)


def test_a_bar_has_round_bends_and_flat_ends():
    pieces = [tanglebin.Piece(length=0.1), tanglebin.Piece(bend=1.5, bend_radius=0.02), tanglebin.Piece(length=0.05)]
    spec = tanglebin.TubeSpec(radius=0.006, segments=[], pieces=pieces, flat_ends=True)
    assert spec.pieces == pieces and spec.flat_ends
    bar = tanglebin.draw_tube(tanglebin.Rng(1), spec, 1)
    assert bar.flat_ends and len(bar.nodes) > 10
    first, last = np.diff(bar.nodes[:2], axis=0)[0], np.diff(bar.nodes[-2:], axis=0)[0]
    cosine = first @ last / np.linalg.norm(first) / np.linalg.norm(last)
    assert np.arccos(cosine) == pytest.approx(1.5, abs=1e-6)


def test_a_sensor_has_the_terms_of_every_preset():
    phoxi = tanglebin.sensor_preset("phoxi")
    assert phoxi.column_correlation > 0 and phoxi.quantization > 0
    assert phoxi.fill > 0 and phoxi.median % 2 == 1


def long_settling():
    """Tubes that never come to rest, for so long that nobody waits for the end."""
    settings = tanglebin.SettleSettings()
    settings.time_limit = 1000
    settings.rest_time = 900
    return dict(tubes=drawn_tubes(8), settings=settings)


def test_settling_reports_progress_and_takes_ctrl_c():
    reported = []
    with Interruption() as interruption:

        def progress(done, total):
            reported.append((done, total))
            interruption.progress(done, total)

        with pytest.raises(KeyboardInterrupt):
            tanglebin.settle(**long_settling(), progress=progress)
    assert all(0 < done < total == 1000 for done, total in reported) and 1 <= len(reported) <= 2


def test_an_error_in_progress_ends_the_work():
    def progress(done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tanglebin.settle(**long_settling(), progress=progress)


def test_other_threads_run_while_tubes_settle():
    counted = []
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted.append(len(counted))
            time.sleep(0.001)
            if len(counted) == 20:
                stop.set()

    def progress(done, total):
        if stop.is_set():
            raise InterruptedError

    threading.Thread(target=count).start()
    with pytest.raises(InterruptedError):
        tanglebin.settle(**long_settling(), progress=progress)
    assert len(counted) == 20


def test_two_threads_settle_the_same_heap():
    tubes, heaps = drawn_tubes(5), []
    alone = tanglebin.settle(tubes, seed=3)
    threads = [threading.Thread(target=lambda: heaps.append(tanglebin.settle(tubes, seed=3))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for heap in heaps:
        for tube, expected in zip(heap.tubes, alone.tubes):
            np.testing.assert_array_equal(tube.nodes, expected.nodes)


def test_a_simulation_cannot_start_in_the_progress_of_another():
    with pytest.raises(RuntimeError, match="cannot start another simulation"):
        tanglebin.settle(**long_settling(), progress=lambda done, total: tanglebin.settle(drawn_tubes(1)))


def test_a_simulation_that_waits_for_its_turn_takes_ctrl_c():
    has_begun, is_enough = threading.Event(), threading.Event()

    def progress(done, total):
        has_begun.set()
        if is_enough.is_set():
            raise InterruptedError

    def settle_in_thread():
        with pytest.raises(InterruptedError):
            tanglebin.settle(**long_settling(), progress=progress)

    other = threading.Thread(target=settle_in_thread)
    other.start()
    has_begun.wait()
    with Interruption(at_the_latest=0.2), pytest.raises(KeyboardInterrupt):
        tanglebin.settle(drawn_tubes(1))  # returns only by Ctrl-C: the other goes on until it is told to end
    is_enough.set()
    other.join()


def test_every_scanner_scans(scene):
    for name in ["paper", "gaussian", "zivid-one-plus-l", "kinect-v1"]:
        sensor = tanglebin.sensor_preset(name)
        assert tanglebin.is_ideal(sensor) == (name == "paper")
        camera = tanglebin.downward_camera(160, 100, 110, [0, 0, 1.5])
        scan = tanglebin.scan(scene.tubes, tanglebin.Bin(), camera, sensor, scene_seed=9)
        assert (scan.labels > 0).any()
        assert (scan.snr is None) == tanglebin.is_ideal(sensor)
        assert (scan.mixed is None) == tanglebin.is_ideal(sensor)
    sensor.edges = tanglebin.Edges.mix
    assert sensor != tanglebin.Sensor()


def test_a_scan_is_arrays_in_its_memory(scene):
    scan = scene.scan
    window = scan.window
    assert isinstance(window, tanglebin.PixelWindow) and window.left > 0 and window.top > 0
    shape = (window.height, window.width)
    for name, dtype in [("depths", "f4"), ("ranges", "f4"), ("incidences", "f4"), ("labels", "i4")]:
        array = getattr(scan, name)
        assert array.shape == shape and array.dtype == dtype
        assert np.shares_memory(array, getattr(scan, name)) and not array.flags.owndata
    for name in ["points", "normals"]:
        assert getattr(scan, name).shape == (*shape, 3)
        assert np.shares_memory(getattr(scan, name), getattr(scan, name))
    hit = scan.labels >= 0
    np.testing.assert_allclose(np.linalg.norm(scan.normals[hit], axis=1), 1, atol=1e-5)
    assert np.isnan(scan.depths[~hit]).all() and (scan.ranges[hit] >= scan.depths[hit]).all()


def test_a_scan_becomes_clouds_and_images(scene):
    scan = scene.scan
    cloud = tanglebin.cloud_from_scan(scan, tubes=3)
    np.testing.assert_array_equal(cloud.points, scan.points[scan.labels > 0])
    assert cloud.normals is None
    cloud = tanglebin.cloud_from_scan(scan, tubes=3, with_bin=True, normals=True, intensities=True, mixed=True)
    np.testing.assert_array_equal(cloud.labels, scan.labels[scan.labels >= 0])
    np.testing.assert_array_equal(cloud.normals, scan.normals[scan.labels >= 0])
    assert (cloud.intensities == 1).all() and not cloud.mixed.any()

    organized = tanglebin.organized_cloud_from_scan(scan, tubes=3)
    assert (organized.height, organized.width) == (scan.camera.height, scan.camera.width)
    depths, labels = tanglebin.depth_image(scan), tanglebin.label_image(scan)
    assert depths.shape == labels.shape == (scan.camera.height, scan.camera.width)
    window = scan.window
    part = np.s_[window.top : window.top + window.height, window.left : window.left + window.width]
    np.testing.assert_array_equal(depths[part], scan.depths)
    np.testing.assert_array_equal(labels[part], scan.labels)
    with pytest.raises(tanglebin.InputError, match="tubes: found 2, expected at least 3, the largest label"):
        tanglebin.cloud_from_scan(scene.scan, tubes=2)


def test_tubes_lie_on_a_table(scene):
    camera = tanglebin.downward_camera(80, 50, 40, [0, 0, 2])
    scan = tanglebin.scan(scene.tubes, tanglebin.Support("plane"), camera)
    assert (scan.labels >= 0).all() and (scan.labels == 0).any()
    with pytest.raises(tanglebin.InputError, match="bin.length"):
        tanglebin.scan(scene.tubes, tanglebin.Bin(length=-1), camera)
    with pytest.raises(TypeError):
        tanglebin.scan(scene.tubes, "bin", camera)


def test_a_world_is_for_gazebo(scene, recipe, tmp_path):
    tanglebin.write_world(tmp_path / "1.world", scene.tubes, recipe.bin, recipe.camera, recipe.settle)
    assert "<sdf version" in (tmp_path / "1.world").read_text()


def test_simulation_of_a_case_takes_ctrl_c(recipe):
    slow = pickle.loads(pickle.dumps(recipe))
    settings = slow.settle
    settings.time_limit = 1000
    settings.rest_time = 900
    slow.settle = settings
    with Interruption() as interruption, pytest.raises(KeyboardInterrupt):
        tanglebin.simulate(slow, tanglebin.CaseId("A", 3, 1), progress=interruption.progress)
    assert interruption.calls == 1
