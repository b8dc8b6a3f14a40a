"""Python and the program write the same bytes."""

import json

import tanglebin


def test_a_dataset_has_the_same_digest(program, recipe, dataset_directory, tmp_path):
    tanglebin.write_recipe(tmp_path / "recipe.toml", recipe)
    out = program("generate", tmp_path / "recipe.toml", "--out", tmp_path / "dataset", "--jobs", 2, "--json")
    digest = json.loads(out)["dataset"]["digest"]
    assert digest == tanglebin.verify_dataset(dataset_directory).digest
    for name in ["recipe.toml", "manifest.jsonl", "dataset.json"]:
        assert (tmp_path / "dataset" / name).read_bytes() == (dataset_directory / name).read_bytes()


def test_a_scan_has_the_same_bytes(program, dataset_directory, tmp_path):
    configuration = dataset_directory / "A3" / "tube_configurations" / "2.txt"
    program(
        *("scan", configuration, "--out", tmp_path / "program.ply", "--scanner", "zivid-one-plus-l", "--seed", 5),
        *("--with-bin", "--normals", "--intensities", "--mixed"),
        *("--depth", tmp_path / "program.png", "--labels", tmp_path / "labels.png"),
    )
    tubes = tanglebin.read_configuration(configuration)
    scanner = tanglebin.scanner_with("zivid-one-plus-l")
    scan = tanglebin.scan(tubes, tanglebin.bin_preset("paper"), scanner.camera, scanner.sensor, scene_seed=5)
    cloud = tanglebin.cloud_from_scan(scan, tubes=3, with_bin=True, normals=True, intensities=True, mixed=True)
    tanglebin.write_ply(tmp_path / "python.ply", cloud)
    assert (tmp_path / "python.ply").read_bytes() == (tmp_path / "program.ply").read_bytes()
    assert tanglebin.depth_png(tanglebin.depth_image(scan)) == (tmp_path / "program.png").read_bytes()
    assert tanglebin.label_png(tanglebin.label_image(scan)) == (tmp_path / "labels.png").read_bytes()
    assert tanglebin.camera_json(scan.camera) == (tmp_path / "program.json").read_text()


def test_a_model_has_the_same_bytes(program, source, scene, tmp_path):
    scan = tanglebin.scan(scene.tubes, tanglebin.Bin(), tanglebin.camera_preset("paper"))
    cloud = tanglebin.cloud_from_scan(scan, tubes=3, with_bin=True)
    tanglebin.write_ply(tmp_path / "cloud.ply", cloud)
    paper = source / "scenes" / "paper.toml"
    program(
        *("model", tmp_path / "cloud.ply", "--scene", paper, "--out", tmp_path / "program.ply"),
        *("--modelled-tubes", tmp_path / "program.json", "--mesh", tmp_path / "program_mesh.ply"),
    )
    measured = tanglebin.read_measurement(tmp_path / "cloud.ply", tanglebin.read_scene(paper))
    resolved = tanglebin.resolve(measured.scene, measured.cloud)
    model = tanglebin.model_tubes(resolved.cloud, resolved.known)
    labelled = tanglebin.labelled(measured.cloud, model.labels)
    tanglebin.write_ply(tmp_path / "python.ply", labelled, coordinates="unit and frame of the input")
    assert (tmp_path / "python.ply").read_bytes() == (tmp_path / "program.ply").read_bytes()
    assert tanglebin.tubes_json(model) == (tmp_path / "program.json").read_text().rstrip("\n")
    tanglebin.write_mesh_ply(tmp_path / "python_mesh.ply", [tanglebin.mesh_of(tube) for tube in model.tubes])
    assert (tmp_path / "python_mesh.ply").read_bytes() == (tmp_path / "program_mesh.ply").read_bytes()


def test_the_version_is_the_programs(program):
    assert program("--version").split()[0] == tanglebin.__version__
