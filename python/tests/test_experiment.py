import json

import numpy as np
import pytest
from interrupted import Interruption

import tanglebin


@pytest.fixture(scope="module")
def settings():
    """The axis method, and a command that finds one tube everywhere."""
    one_tube = "python3 -c 'import sys; n = int(open(sys.argv[1], \"rb\").read(400).split(b\"vertex \")[1].split()[0]); "
    one_tube += "open(sys.argv[2], \"w\").write(\"1\\n\" * n)' {cloud} {out.txt}"
    methods = [tanglebin.Entry("axis"), tanglebin.Entry("one", command=one_tube, time_limit=60)]
    return tanglebin.ExperimentSettings(methods, ratios=[0.3, 1])


@pytest.fixture(scope="module")
def results(dataset_directory, settings, tmp_path_factory):
    directory = tmp_path_factory.mktemp("experiment") / "results"
    summary = tanglebin.run_experiment(dataset_directory, settings, directory, jobs=2)
    assert isinstance(summary, tanglebin.ExperimentSummary) and summary.is_complete and summary.failed == []
    return directory


def lines_of(results):
    return [json.loads(line) for line in (results / "results.jsonl").read_text().splitlines()]


def test_an_experiment_runs_every_method_on_every_case(results, settings):
    assert [method.name for method in settings.methods] == ["axis", "one"] and settings.ratios == [0.3, 1]
    assert settings.model.method == "axis" and settings.scene.is_empty and not settings.keep_models
    lines = lines_of(results)
    assert len(lines) == 2 * 2 * 6 and not any("failure" in line for line in lines)
    of_one = [line["micro_recall"] for line in lines if line["method"] == "one"]
    assert max(of_one) == 1 and min(of_one) < 0.7  # of one tube, and of three


def test_an_experiment_gives_the_bytes_of_the_program(results, dataset_directory, program, tmp_path):
    settings = tanglebin.ExperimentSettings([tanglebin.Entry("axis")], ratios=[0.3, 1])
    tanglebin.run_experiment(dataset_directory, settings, tmp_path / "ours")
    tanglebin.write_pictures(tmp_path / "ours", dataset_directory, settings)
    tanglebin.write_scenes(tmp_path / "ours", dataset_directory, settings)
    program("experiment", dataset_directory, "--out", tmp_path / "its", "--downsample", "0.3,1")
    for name in ["results.jsonl", "results.csv", "tubes.csv", "pictures.jsonl", "scenes.jsonl"]:
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "its" / name).read_bytes(), name


def test_an_experiment_goes_on_after_ctrl_c(dataset_directory, settings, results, tmp_path):
    with Interruption() as interruption, pytest.raises(KeyboardInterrupt):
        tanglebin.run_experiment(dataset_directory, settings, tmp_path, progress=interruption.progress)
    assert len((tmp_path / "results.jsonl").read_text().splitlines()) < 24
    reported = []
    tanglebin.run_experiment(dataset_directory, settings, tmp_path, progress=lambda *counts: reported.append(counts))
    assert (tmp_path / "results.jsonl").read_bytes() == (results / "results.jsonl").read_bytes()
    assert all(done <= total == 6 for done, total in reported)


def test_some_of_the_cases_are_run(dataset_directory, settings, recipe, tmp_path):
    summary = tanglebin.run_experiment(dataset_directory, settings, tmp_path, wanted=recipe.cases[:2])
    assert summary.progress.wanted == summary.progress.made == 2


def test_a_case_that_ends_its_workers_is_given_up(dataset_directory, recipe, tmp_path):
    script = tmp_path / "kill_the_worker.py"  # the parent of the parent: between them is the command's supervisor
    script.write_text("import os; os.kill(int(open(f'/proc/{os.getppid()}/stat').read().split()[3]), 9)")
    settings = tanglebin.ExperimentSettings([tanglebin.Entry("one", command=f"python3 {script} {{cloud}} {{out}}")])
    summary = tanglebin.run_experiment(dataset_directory, settings, tmp_path / "results", wanted=recipe.cases[:1])
    (failed,) = summary.failed
    assert isinstance(failed, tanglebin.FailedModel) and str(failed.id) == "A1/1" and "signal 9" in failed.reason
    assert not summary.is_complete


def test_settings_that_cannot_be_are_refused(dataset_directory, results, tmp_path):
    axis = tanglebin.Entry("axis")
    for ratios in [[], [0], [1, 0.3], [1.1]]:
        with pytest.raises(tanglebin.InputError, match="ratios"):
            tanglebin.ExperimentSettings([axis], ratios)
    with pytest.raises(tanglebin.InputError, match="hough"):
        tanglebin.Entry("hough")
    with pytest.raises(tanglebin.InputError, match="no-such-program"):
        tanglebin.Entry("mine", command="no-such-program {cloud} {out}")
    with pytest.raises(tanglebin.InputError, match="labels"):
        tanglebin.Entry("mine", command="true {cloud} {out}", labels="labels")
    with pytest.raises(tanglebin.InputError, match="time_limit"):
        tanglebin.Entry("mine", command="true {cloud} {out}", time_limit=0)
    with pytest.raises(tanglebin.InputError, match="axis"):
        tanglebin.ExperimentSettings([axis, axis])
    with pytest.raises(tanglebin.InputError, match="another experiment"):
        tanglebin.run_experiment(dataset_directory, tanglebin.ExperimentSettings([axis]), results)
    with pytest.raises(tanglebin.InputError, match="recipe.toml"):
        tanglebin.run_experiment(tmp_path, tanglebin.ExperimentSettings([axis]), tmp_path / "results")


def test_methods_are_compared_scene_by_scene(results, recipe):
    with pytest.raises(tanglebin.InputError, match="results: found none"):
        tanglebin.pairs_to_compare([])
    ((baseline, other),) = tanglebin.pairs_to_compare([results], baseline="axis")
    assert isinstance(other, tanglebin.Contestant) and (baseline.method, other.method) == ("axis", "one")
    comparison = tanglebin.compare(baseline, other)
    assert isinstance(comparison, tanglebin.Comparison) and (comparison.scenes, comparison.unpaired) == (6, 0)
    recall = comparison.measures[0]
    assert isinstance(recall, tanglebin.MeasureDifference) and recall.measure == "micro_recall"
    assert recall.difference == pytest.approx(recall.other - recall.baseline)
    assert recall.low <= recall.difference <= recall.high and recall.difference > 0.1
    assert all(isinstance(scene, tanglebin.SceneDifference) for scene in comparison.better)
    assert comparison.better[0].difference >= comparison.better[-1].difference > 0
    assert comparison.better[0].id in recipe.cases
    with pytest.raises(tanglebin.InputError, match="hough"):
        tanglebin.compare(baseline, tanglebin.Contestant(results, "hough"))


def write_labels(directory, case, labels):
    folder = directory / f"{case.id.set}{case.id.tubes}" / "labels"
    folder.mkdir(parents=True, exist_ok=True)
    np.save(folder / f"{case.id.number}.npy", labels)


def test_labels_of_a_directory_are_scored(dataset, tmp_path):
    for case in dataset[1:]:
        write_labels(tmp_path, case, case.cloud.labels if case.id.tubes == 1 else np.ones(len(case.cloud), np.int32))
    scores = [case.score_labels(tmp_path) for case in dataset]
    assert isinstance(scores[0], tanglebin.SceneScore) and str(scores[0].id) == "A1/1" and scores[0].scanner == ""
    assert scores[0].labels is None and scores[0].tubes is None and "A1" in scores[0].failure
    assert scores[1].failure is None and scores[1].labels.micro_recall == 1 and scores[1].tubes is None
    means = tanglebin.mean_scores(scores)
    assert isinstance(means[0], tanglebin.MeanScore) and [mean.tubes for mean in means] == [1, 3]
    assert (means[0].set, means[0].scanner, means[0].scenes, means[0].failed) == ("A", "", 3, 1)
    assert means[0].micro_recall == pytest.approx(2 / 3)
    assert means[1].micro_recall == pytest.approx(np.mean([score.labels.micro_recall for score in scores[3:]]))


def test_labels_take_part_in_an_experiment(dataset, dataset_directory, tmp_path):
    for case in dataset:
        write_labels(tmp_path / "labels", case, case.cloud.labels)
    settings = tanglebin.ExperimentSettings([tanglebin.Entry("truth", labels=tmp_path / "labels")])
    tanglebin.run_experiment(dataset_directory, settings, tmp_path / "results")
    assert {line["micro_recall"] for line in lines_of(tmp_path / "results")} == {1.0}


def test_a_report_is_the_page_of_the_program(results, dataset_directory, settings, program, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tanglebin.write_pictures(results, dataset_directory, settings)
    tanglebin.write_scenes(results, dataset_directory, settings, count=1)
    program("report", results, "--out", "page.html")
    assert tanglebin.report_page(results, "page.html") == (tmp_path / "page.html").read_text()
    with pytest.raises(tanglebin.InputError, match="experiment.json"):
        tanglebin.report_page(tmp_path)


def test_pictures_take_ctrl_c(results, dataset_directory):
    slow = [tanglebin.Entry("axis"), tanglebin.Entry("one", command="python3 -c 'import time; time.sleep(2)' {cloud} {out}")]
    settings = tanglebin.ExperimentSettings(slow, ratios=[0.3, 1])
    with Interruption(at_the_latest=0.5), pytest.raises(KeyboardInterrupt):
        tanglebin.write_pictures(results, dataset_directory, settings)
