import json
import math
import pickle

import numpy as np
import pytest
from interrupted import Interruption

import tanglebin


@pytest.fixture(scope="module")
def cloud(scene, recipe):
    scan = tanglebin.scan(scene.tubes, recipe.bin, tanglebin.camera_preset("paper"))
    return tanglebin.cloud_from_scan(scan, tubes=3, with_bin=True)


@pytest.fixture(scope="module")
def known():
    return tanglebin.KnownScene(tanglebin.Support(), tanglebin.camera_preset("paper"))


@pytest.fixture(scope="module")
def model(cloud, known):
    return tanglebin.model_tubes(cloud, known)


def test_a_model_finds_the_tubes(model, cloud, scene):
    assert not model.is_refused and len(model.tubes) == 3
    assert tanglebin.score(cloud.labels, model.labels).micro_recall > 0.98
    assert tanglebin.score_tubes(scene.tubes, model.tubes).complete_tubes == 3
    assert repr(model) == f"<Model of {len(cloud)} points: 3 tubes, {len(model.findings)} findings>"


def test_arrays_are_in_the_models_memory(model, cloud):
    assert model.labels.dtype == np.int32 and len(model.labels) == len(cloud)
    assert np.shares_memory(model.labels, model.labels) and np.shares_memory(model.filtered, model.filtered)
    assert (np.diff(model.filtered.astype(np.int64)) > 0).all()


def test_a_model_says_how_sure_it_is(model, cloud):
    for evidence in model.evidence:
        assert isinstance(evidence, tanglebin.TubeEvidence)
        assert 0 < evidence.confidence <= 1 and 0 < evidence.coverage <= 1
        assert 0 <= evidence.disagreement <= 1
        assert evidence.length_fit in ["unknown", "complete", "too_short", "too_long"]
        assert evidence.length == pytest.approx(0.5, abs=0.05) and evidence.residual < 0.002
        for join in evidence.joins:
            assert isinstance(join, tanglebin.TubeJoin) and join.from_point.shape == join.to_point.shape == (3,)
    assert model.foreign_radii == [] and model.estimated_lengths == []
    assert isinstance(model.counts, tanglebin.PointCounts) and model.counts.all == len(cloud)
    assert model.counts.on_tubes == (model.labels > 0).sum()
    assert all(isinstance(step, tanglebin.Step) and step.seconds >= 0 for step in model.steps)
    assert len(json.loads(tanglebin.tubes_json(model))["tubes"]) == 3


def test_a_model_says_which_length_it_found(cloud):
    of_any_length = tanglebin.TubeKind(0.0125, [tanglebin.Segment(1, 2, math.inf)])
    known = tanglebin.KnownScene(tanglebin.Support(), tanglebin.camera_preset("paper"), [of_any_length])
    [estimate] = tanglebin.model_tubes(cloud, known).estimated_lengths
    assert isinstance(estimate, tanglebin.EstimatedLength)
    assert estimate.kind == 0 and estimate.length == pytest.approx(0.5, abs=0.02)


def test_a_cloud_that_cannot_be_of_this_scene_is_refused_with_findings(cloud, known):
    in_millimetres = tanglebin.PointCloud(1000 * cloud.points)
    model = tanglebin.model_tubes(in_millimetres, known)
    assert model.is_refused and model.findings[0].is_error
    assert isinstance(model.findings[0], tanglebin.Finding) and model.findings[0].code and model.findings[0].message


def test_methods_and_parameters_are_chosen_by_name():
    settings = tanglebin.ModelSettings("axis", ratio=0.5, seed=3, parameters={"axis.vote.floor_margin": 0.4})
    assert settings.method == "axis" and settings.parameters["axis.vote.floor_margin"] == 0.4
    assert settings.changed_parameters == {"axis.vote.floor_margin": 0.4}
    again = pickle.loads(pickle.dumps(settings))
    assert (again.ratio, again.seed, again.parameters) == (0.5, 3, settings.parameters)
    with pytest.raises(tanglebin.InputError, match="parameters"):
        tanglebin.ModelSettings(parameters={"axis.vote.flor_margin": 0.4})
    with pytest.raises(tanglebin.InputError, match="hough"):
        tanglebin.ModelSettings("hough")


def test_the_papers_method_models_too(cloud, known):
    settings = tanglebin.ModelSettings("paper", ratio=0.3)
    try:
        model = tanglebin.model_tubes(cloud, known, settings)
    except tanglebin.InputError as error:
        pytest.skip(str(error))  # built without the Point Cloud Library
    assert tanglebin.score(cloud.labels, model.labels).micro_recall > 0.9


@pytest.mark.parametrize("method", ["axis", "paper"])
def test_modelling_takes_ctrl_c(cloud, known, method):
    settings = tanglebin.ModelSettings(method)
    try:
        tanglebin.model_tubes(tanglebin.PointCloud(cloud.points[:100]), known, settings)
    except tanglebin.InputError as error:
        pytest.skip(str(error))  # built without the Point Cloud Library
    with Interruption(at_the_latest=0.2), pytest.raises(KeyboardInterrupt):
        while True:
            tanglebin.model_tubes(cloud, known, settings)


def test_a_known_scene_must_be_valid(cloud, known):
    settings = tanglebin.ModelSettings(ratio=2)
    with pytest.raises(tanglebin.InputError, match="ratio"):
        tanglebin.model_tubes(cloud, known, settings)
