import multiprocessing
import pickle
import shutil
import threading

import numpy as np
import pytest
from interrupted import Interruption

import tanglebin


def test_cases_are_listed_and_read_when_asked_for(dataset, dataset_directory, recipe):
    assert isinstance(dataset, tanglebin.Dataset) and len(dataset) == 6 and dataset.ids == recipe.cases
    assert dataset.directory == dataset_directory and dataset.recipe == recipe
    case = dataset[3]
    assert isinstance(case, tanglebin.Case) and str(case.id) == "A3/1"
    assert len(case.tubes) == 3 and set(np.unique(case.cloud.labels)) == {0, 1, 2, 3}
    assert case.cloud is case.cloud  # read once
    assert case.depths.shape == case.labels.shape == (150, 240)
    assert case.known.camera == recipe.camera and case.known.support.bin == recipe.bin
    assert case.record.id == case.id and case.record.points == len(case.cloud)
    assert isinstance(case.record, tanglebin.CaseRecord) and '"set":"A"' in case.record.json.replace(" ", "")
    assert {type(file) for file in case.record.files} == {tanglebin.FileRecord}
    assert case.recipe.sets[0].name == "A"
    assert [str(case.id) for case in dataset[-2:]] == ["A3/2", "A3/3"] and len(list(dataset)) == 6
    with pytest.raises(IndexError):
        dataset[6]


def test_an_index_reads_no_case(dataset_directory, tmp_path):
    copy = shutil.copytree(dataset_directory, tmp_path / "copy")
    shutil.rmtree(copy / "A3" / "plys")
    dataset = tanglebin.Dataset(copy)
    assert len(dataset) == 6 and len(dataset[3].tubes) == 3
    with pytest.raises(tanglebin.InputError, match="A3/plys/1.ply"):
        dataset[3].cloud


def test_the_case_on_disk_is_the_case_that_is_simulated(dataset, scene):
    case = dataset[3]
    for tube, simulated in zip(case.tubes, scene.tubes):
        np.testing.assert_array_equal(tube.nodes, simulated.nodes)
    cloud = tanglebin.cloud_from_scan(scene.scan, tubes=3, with_bin=True)
    np.testing.assert_array_equal(case.cloud.points, cloud.points)
    np.testing.assert_array_equal(case.labels, tanglebin.label_image(scene.scan))
    np.testing.assert_allclose(case.depths, tanglebin.depth_image(scene.scan), atol=5.1e-5)


TWO_SCANNERS = """
[[scanner]]
name = "above"
preset = "paper"
[[scanner]]
name = "aslant"
preset = "paper"
look_at = [0, 0, 0]
distance = 1.2
tilt_deg = { min = 20, max = 30 }
"""


def test_the_cloud_of_each_scanner_is_modelled_with_its_own_camera(source, tmp_path):
    text = (source / "recipes" / "set-a.toml").read_text()
    before, after = text.split("[scanner]", 1)
    recipe = tanglebin.Recipe(before + TWO_SCANNERS + after[after.index("[[set]]"):])
    tanglebin.generate_dataset(recipe, tmp_path / "seen-twice", wanted=[tanglebin.CaseId("A", 3, 1)])
    (case,) = tanglebin.Dataset(tmp_path / "seen-twice")
    assert case.known.camera == case.known_of("above").camera == recipe.camera
    assert case.known.camera.pose[2, 3] == 2 and case.known_of("aslant").camera.pose[2, 3] < 1.2
    for scanner in ["above", "aslant"]:
        cloud = case.cloud_of(scanner)
        model = tanglebin.model_tubes(cloud, case.known_of(scanner))
        assert tanglebin.score(cloud.labels, model.labels).micro_recall > 0.999
    with pytest.raises(tanglebin.InputError, match="below"):
        case.known_of("below")


def points_of(case):
    return len(case.cloud)


def test_workers_are_sent_datasets_and_cases(dataset):
    assert pickle.loads(pickle.dumps(dataset)).ids == dataset.ids
    for method in ["fork", "spawn"]:
        with multiprocessing.get_context(method).Pool(2) as pool:
            assert pool.map(points_of, dataset[:4]) == [case.record.points for case in dataset[:4]]


def simulated_points(arguments):
    recipe, id = arguments
    return tanglebin.simulate(recipe, id).scan.points


def test_workers_simulate_the_same_scene(recipe, scene):
    for method in ["fork", "spawn"]:
        with multiprocessing.get_context(method).Pool(2) as pool:
            for points in pool.map(simulated_points, 2 * [(recipe, tanglebin.CaseId("A", 3, 1))]):
                np.testing.assert_array_equal(points, scene.scan.points)


def test_a_run_reports_progress_and_its_digest(recipe, tmp_path):
    reported = []
    summary = tanglebin.generate_dataset(
        recipe, tmp_path / "new", wanted=recipe.cases[:2], jobs=2, progress=lambda *counts: reported.append(counts)
    )
    assert isinstance(summary, tanglebin.FillSummary) and summary.is_complete and summary.failed == []
    assert isinstance(summary.progress, tanglebin.RunProgress) and summary.progress.made == 2
    assert isinstance(summary.dataset, tanglebin.DatasetSummary) and len(summary.dataset.digest) == 64
    assert summary.dataset.cases == 2 and not summary.dataset.is_complete
    assert reported[-1] == (2, 2) and all(done <= total == 2 for done, total in reported)


def test_a_run_goes_on_after_ctrl_c(recipe, dataset, dataset_directory, tmp_path):
    directory = tmp_path / "interrupted"
    with Interruption() as interruption, pytest.raises(KeyboardInterrupt):
        tanglebin.generate_dataset(recipe, directory, progress=interruption.progress)
    assert len(tanglebin.Dataset(directory)) < 6
    summary = tanglebin.generate_dataset(recipe, directory)
    assert summary.is_complete and summary.dataset.digest == tanglebin.verify_dataset(dataset_directory).digest


def test_an_error_in_progress_ends_the_run(recipe, tmp_path):
    def progress(done, total):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tanglebin.generate_dataset(recipe, tmp_path / "new", progress=progress)


def test_a_run_forks_while_other_threads_run(recipe, dataset_directory, tmp_path):
    tanglebin.simulate(recipe, recipe.cases[0])  # the scanner's library is in use, too
    stop = threading.Event()

    def work():
        while not stop.is_set():
            np.ones((200, 200)) @ np.ones((200, 200))

    threads = [threading.Thread(target=work) for _ in range(2)]
    for thread in threads:
        thread.start()
    try:
        summary = tanglebin.generate_dataset(recipe, tmp_path / "new", jobs=2)
    finally:
        stop.set()
        for thread in threads:
            thread.join()
    assert summary.dataset.digest == tanglebin.verify_dataset(dataset_directory).digest


@pytest.mark.parametrize("jobs", [0, -1, 1025])
def test_no_or_too_many_workers_are_refused_before_anything_is_done(dataset_directory, recipe, tmp_path, jobs):
    copy = shutil.copytree(dataset_directory, tmp_path / "copy")
    (copy / "A1" / "plys" / "2.ply").unlink()
    found = tanglebin.verify_dataset(copy)
    before = (copy / "manifest.jsonl").read_bytes()
    for run in [
        lambda: tanglebin.verify_dataset(copy, jobs=jobs),
        lambda: tanglebin.repair_dataset(copy, found, jobs=jobs),
        lambda: tanglebin.generate_dataset(recipe, tmp_path / "new", jobs=jobs),
        lambda: tanglebin.merge_datasets([copy], tmp_path / "new", jobs=jobs),
    ]:
        with pytest.raises(tanglebin.InputError, match="jobs: found .*, expected 1 to 1024"):
            run()
    assert (copy / "manifest.jsonl").read_bytes() == before and not (tmp_path / "new").exists()


def test_faults_are_found_and_repaired(dataset_directory, tmp_path):
    copy = shutil.copytree(dataset_directory, tmp_path / "copy")
    assert tanglebin.verify_dataset(copy, jobs=2, rest=True).faults == []
    cloud = copy / "A1" / "plys" / "2.ply"
    cloud.write_bytes(cloud.read_bytes()[:-1])
    found = tanglebin.verify_dataset(copy)
    assert isinstance(found, tanglebin.VerifySummary) and found.cases == 6 and found.notes == []
    assert [str(id) for id in found.broken] == ["A1/2"]
    assert isinstance(found.faults[0], tanglebin.DatasetFault) and found.faults[0].where == "A1/plys/2.ply"
    assert found.faults[0].what
    assert tanglebin.repair_dataset(copy, found).progress.made == 1
    assert tanglebin.verify_dataset(copy).faults == []


def test_parts_are_merged(recipe, dataset_directory, tmp_path):
    for name, wanted in [("a", recipe.cases[:2]), ("b", recipe.cases[2:])]:
        tanglebin.generate_dataset(recipe, tmp_path / name, wanted=wanted)
    merged = tanglebin.merge_datasets([tmp_path / "a", tmp_path / "b"], tmp_path / "all")
    assert merged.dataset.digest == tanglebin.verify_dataset(dataset_directory).digest


def test_a_case_without_a_valid_scene_fails_and_says_why(recipe, tmp_path):
    crowded = tanglebin.Recipe(recipe.toml())
    crowded.attempts = 1
    settings = crowded.settle
    settings.time_limit = 0.01
    crowded.settle = settings
    summary = tanglebin.generate_dataset(crowded, tmp_path / "none", wanted=crowded.cases[:1])
    (failed,) = summary.failed
    assert isinstance(failed, tanglebin.FailedCase) and failed.id == crowded.cases[0]
    assert "no valid scene" in failed.reason and failed.seed


def test_what_is_no_dataset_is_refused(tmp_path, recipe):
    with pytest.raises(tanglebin.InputError, match="recipe.toml"):
        tanglebin.Dataset(tmp_path)
    with pytest.raises(tanglebin.InputError, match="recipe.toml"):
        tanglebin.Index(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(tanglebin.InputError, match=str(tmp_path)):
        tanglebin.generate_dataset(recipe, tmp_path)


@pytest.mark.parametrize("case", [("A", 21, 1), ("A", 3, 99), ("Z", 1, 1)])
def test_a_case_that_the_recipe_does_not_have_is_refused(case, recipe, dataset_directory, tmp_path):
    wanted = [tanglebin.CaseId(*case)]
    with pytest.raises(tanglebin.InputError, match="wanted: found .*, expected a case of the recipe"):
        tanglebin.generate_dataset(recipe, tmp_path / "new", wanted=wanted)
    assert not (tmp_path / "new").exists()
    with pytest.raises(tanglebin.InputError, match="wanted: found .*, expected a case of the recipe"):
        tanglebin.verify_dataset(dataset_directory, wanted=wanted)
