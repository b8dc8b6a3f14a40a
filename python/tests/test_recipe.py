import pickle

import numpy as np
import pytest

import tanglebin


def test_a_recipe_lists_its_cases(recipe):
    assert [str(id) for id in recipe.cases] == ["A1/1", "A1/2", "A1/3", "A3/1", "A3/2", "A3/3"]
    id = recipe.cases[4]
    assert (id.set, id.tubes, id.number) == ("A", 3, 2) and id == tanglebin.CaseId("A", 3, 2)
    assert len({id, tanglebin.CaseId("A", 3, 2)}) == 1 and sorted(recipe.cases) == recipe.cases


@pytest.mark.parametrize("tubes, number, field", [(0, 1, "tubes"), (-3, 1, "tubes"), (3, 0, "number"), (3, -3, "number")])
def test_a_case_that_cannot_be_is_refused(tubes, number, field):
    with pytest.raises(tanglebin.InputError, match="expected at least 1") as caught:
        tanglebin.CaseId("A", tubes, number)
    assert caught.value.field == field


def test_a_recipe_is_read_written_and_sent(recipe, tmp_path):
    tanglebin.write_recipe(tmp_path / "recipe.toml", recipe)
    assert tanglebin.read_recipe(tmp_path / "recipe.toml") == recipe
    assert pickle.loads(pickle.dumps(recipe)) == recipe == tanglebin.Recipe(recipe.toml())


def test_the_recipes_that_ship_are_read(source):
    for file in sorted((source / "recipes").glob("*.toml")):
        assert tanglebin.read_recipe(file).cases


def test_errors_in_a_recipe_are_those_of_the_program():
    with pytest.raises(tanglebin.InputError, match="recipe:2: unknown key 'sed', did you mean 'seed'") as caught:
        tanglebin.Recipe("attempts = 5\nsed = 1\n")
    assert caught.value.line == 2 and caught.value.file == "recipe"


def test_a_recipe_is_made_in_code(recipe):
    made = tanglebin.Recipe(recipe.toml())
    spec = tanglebin.TubeSpec(radius=0.008, segments=[tanglebin.SegmentSpec(length=0.3, bend_max=0.2)])
    made.sets = [tanglebin.SetRecipe("thin", tubes=[2], cases=1, kinds=[spec])]
    made.seed = 3
    made.camera = tanglebin.downward_camera(120, 80, 90, [0, 0, 2])
    made.output.worlds = False
    made.validate()
    assert made != recipe and [str(id) for id in made.cases] == ["thin2/1"]
    assert made.doubts() and all("pixels" in doubt for doubt in made.doubts())
    scene = tanglebin.simulate(made, made.cases[0])
    assert [tube.radius for tube in scene.tubes] == [0.008, 0.008]
    made.attempts = 0
    with pytest.raises(tanglebin.InputError, match="attempts"):
        made.validate()


def test_a_random_recipe_is_resolved_for_each_case(source):
    varied = tanglebin.read_recipe(source / "recipes" / "varied.toml")
    assert varied.is_random
    first, second = varied.cases[:2]
    resolved = varied.resolved(first)
    assert not resolved.is_random
    assert not np.array_equal(resolved.camera.pose, varied.resolved(second).camera.pose)


def test_a_scanner_is_a_preset_with_changes():
    scanner = tanglebin.scanner_with("zivid-one-plus-l", ["scanner.baseline=0.3"])
    assert isinstance(scanner, tanglebin.Scanner) and scanner.sensor.baseline == 0.3
    assert scanner.camera == tanglebin.camera_preset("zivid-one-plus-l")
    with pytest.raises(tanglebin.InputError, match="settings: scanner: unknown key 'basline'"):
        tanglebin.scanner_with("paper", ["scanner.basline=0.3"])


def test_a_simulated_scene_says_how_it_came_about(scene, recipe):
    assert isinstance(scene, tanglebin.SimulatedScene)
    assert repr(scene) == f"<SimulatedScene of 3 tubes, 1 scan, seed {scene.seed:#x}>"
    assert scene.further_scans == [] and scene.largest_overlap < 0.0003 and scene.simulated > 0
    assert all(isinstance(rejection, tanglebin.Rejection) for rejection in scene.rejections)
    again = tanglebin.simulate(recipe, tanglebin.CaseId("A", 3, 1))
    assert again.seed == scene.seed
    np.testing.assert_array_equal(again.scan.points, scene.scan.points)


def test_output_settings_can_be_changed():
    output = tanglebin.OutputSettings()
    assert output.plys and isinstance(output.properties, tanglebin.PointProperties)
    output.properties.normals = True
    assert output.properties.normals


def test_a_case_that_is_not_in_the_recipe_is_refused(recipe):
    with pytest.raises(tanglebin.InputError):
        tanglebin.simulate(recipe, tanglebin.CaseId("B", 3, 1))


def test_lists_are_copies_that_are_assigned_to_change_them(recipe, source):
    made = tanglebin.Recipe(recipe.toml())
    sets = made.sets
    sets[0].cases = 9
    assert made.sets[0].cases == 3
    sets.append(tanglebin.SetRecipe("B", [2], 1, sets[0].kinds))
    made.sets = sets
    made.sets = made.sets * 50  # whatever becomes of the recipe's list, its old items stay as they were
    assert (sets[0].name, sets[0].cases, sets[1].name) == ("A", 9, "B")
    kinds = sets[0].kinds
    segments = kinds[0].segments
    segments[0].length = 0.3
    kinds[0].segments = segments
    sets[0].kinds = kinds
    assert sets[0].kinds[0].segments[0].length == 0.3 and made.sets[0].kinds[0].segments[0].length == 0.5
    realistic = tanglebin.read_recipe(source / "recipes" / "realistic.toml")
    scanners = realistic.further_scanners
    name = scanners[0].name
    realistic.further_scanners = []
    assert scanners[0].name == name


def test_a_number_that_cases_draw_cannot_be_set_in_code(source):
    varied = tanglebin.read_recipe(source / "recipes" / "varied.toml")
    sets = varied.sets
    sets[0].cases = 2
    varied.sets = sets
    varied.validate()
    kinds = sets[0].kinds
    kinds[0].radius = 0.005
    sets[0].kinds = kinds
    varied.sets = sets
    for use in (varied.resolved, lambda id: tanglebin.simulate(varied, id), lambda id: tanglebin.known_scene(varied, id)):
        with pytest.raises(tanglebin.InputError, match=r"set\[0\].tube\[0\].radius: found 0.005.*cannot be set in code"):
            use(varied.cases[0])
