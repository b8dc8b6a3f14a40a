import pytest
from interrupted import Interruption

import tanglebin


SETTINGS = {"scenes": 2, "evaluations": 20}


@pytest.fixture(scope="module")
def calibration(recipe, tmp_path_factory):
    settings = tanglebin.CalibrationSettings(**SETTINGS)
    return tanglebin.calibrate(recipe, tmp_path_factory.mktemp("calibration"), settings)


def text_of(profile, directory):
    tanglebin.write_profile(directory / "profile.toml", profile, title="For a test")
    return (directory / "profile.toml").read_text()


def test_a_calibration_says_what_it_is_for_and_what_it_reached(calibration, recipe):
    assert isinstance(calibration, tanglebin.Calibration) and calibration.evaluations >= 20
    profile = calibration.profile
    assert isinstance(profile, tanglebin.Profile) and profile.method == "axis"
    made_for, reached = profile.made_for, profile.reached
    assert isinstance(made_for, tanglebin.MadeFor) and made_for.bin == recipe.bin and made_for.image_width == 240
    (tubes,) = made_for.tubes
    assert isinstance(tubes, tanglebin.TubesMadeFor) and tubes.radius_min == tubes.radius_max == 0.0125
    assert isinstance(reached, tanglebin.Reached) and (reached.objective, reached.scenes) == ("unmixed_recall", 2)
    assert isinstance(reached.after, tanglebin.Estimate) and reached.after.mean >= reached.before.mean
    assert calibration.is_better == (reached.difference.mean > 0)
    assert all(isinstance(its, tanglebin.Sensitivity) for its in calibration.sensitivities)


def test_a_profile_is_written_and_read(calibration, recipe, tmp_path):
    text = text_of(calibration.profile, tmp_path)
    assert text.startswith("# For a test")
    read = tanglebin.read_profile(tmp_path / "profile.toml")
    assert read.parameters == calibration.profile.parameters
    settings = tanglebin.ModelSettings(read.method, parameters=read.parameters)
    assert settings.changed_parameters == read.parameters
    known = tanglebin.known_scene(recipe, tanglebin.CaseId("A", 1, 1))
    assert tanglebin.doubts_of(read, known) == []
    known.camera = tanglebin.camera_preset("paper")
    (doubt,) = tanglebin.doubts_of(read, known)
    assert "240 pixels wide" in doubt


def test_a_calibration_goes_on_after_ctrl_c(calibration, recipe, tmp_path):
    settings = tanglebin.CalibrationSettings(**SETTINGS)
    with Interruption() as interruption, pytest.raises(KeyboardInterrupt):
        tanglebin.calibrate(recipe, tmp_path / "run", settings, progress=interruption.progress)
    reported = []
    again = tanglebin.calibrate(
        recipe, tmp_path / "run", settings, progress=lambda done, most: reported.append((done, most))
    )
    assert text_of(again.profile, tmp_path) == text_of(calibration.profile, tmp_path)
    assert reported and all(done <= most for done, most in reported)


def test_what_progress_raises_ends_a_calibration(recipe, tmp_path):
    def stop(done, most):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        tanglebin.calibrate(recipe, tmp_path, tanglebin.CalibrationSettings(**SETTINGS), progress=stop)


def test_settings_that_cannot_be_are_refused():
    with pytest.raises(tanglebin.InputError, match="hough"):
        tanglebin.CalibrationSettings(method="hough")
    with pytest.raises(tanglebin.InputError, match="f1"):
        tanglebin.CalibrationSettings(objective="f1")
    for wrong in [{"ratio": 0}, {"scenes": 1}, {"jobs": 0}, {"time_limit": 0}, {"seconds": -1}]:
        with pytest.raises(tanglebin.InputError, match=next(iter(wrong))):
            tanglebin.CalibrationSettings(**wrong)
