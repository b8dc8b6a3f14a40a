import numpy as np
import pytest

import tanglebin


def test_labels_are_scored():
    truth = np.array([0, 1, 1, 1, 1, 2, 2, 2, 2, -1])
    predicted = np.array([0, 7, 7, 7, 0, 9, 9, 9, 9, 7], np.int64)
    score = tanglebin.score(truth, predicted)
    assert isinstance(score, tanglebin.Score)
    assert (score.points, score.correct_points, score.null_points) == (8, 7, 1)
    assert score.micro_recall == 7 / 8 and score.mean_iou == pytest.approx((3 / 4 + 1) / 2)
    assert isinstance(score.detection, tanglebin.Detection) and score.detection.f1 == 1
    assert score.detection.panoptic_quality == pytest.approx(7 / 8)
    assert isinstance(score.instances, tanglebin.Instances) and score.instances.correct == 2
    assert 0 < score.adjusted_rand_index < 1 and score.unmixed_recall is None
    assert tanglebin.score(truth, predicted, mixed=predicted == 0).unmixed_recall == 1
    first = score.tubes[0]
    assert isinstance(first, tanglebin.TubeScore)
    assert (first.label, first.points, first.assigned, first.correct_points, first.iou) == (1, 4, 7, 3, 0.75)


def test_what_cannot_be_scored_is_refused():
    with pytest.raises(tanglebin.InputError, match="the same number of labels"):
        tanglebin.score([1, 2], [1])
    with pytest.raises(tanglebin.InputError, match="no point on a tube"):
        tanglebin.score([0, 0], [1, 1])
    with pytest.raises(tanglebin.InputError, match="predicted: found an array of float64"):
        tanglebin.score([1, 1], [0.5, 1])


def test_clouds_are_scored_in_any_order(scene):
    truth = tanglebin.cloud_from_scan(scene.scan, tubes=3)
    order = np.random.default_rng(0).permutation(len(truth))[: len(truth) // 2]
    labelled = tanglebin.PointCloud(truth.points[order], labels=truth.labels[order])
    score = tanglebin.score_clouds(truth, labelled)
    assert score.correct_points == len(order)
    with pytest.raises(tanglebin.InputError, match="mine.ply"):
        tanglebin.score_clouds(truth, tanglebin.PointCloud([[9, 9, 9]], labels=[1]), labelled_file="mine.ply")


def test_tubes_are_scored(scene):
    score = tanglebin.score_tubes(scene.tubes, scene.tubes[:2])
    assert isinstance(score, tanglebin.TubesScore)
    assert score.complete_tubes == 2 and score.centre_line_error == pytest.approx(0, abs=1e-6)
    assert score.centre_line_coverage < 1
    assert tanglebin.score_tubes(scene.tubes, []).centre_line_error is None
