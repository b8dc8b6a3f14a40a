"""What holds for all public names."""

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import tanglebin

PUBLIC = sorted(name for name in vars(tanglebin) if not name.startswith("_"))


def members(described):
    return [name for name, member in vars(described).items() if isinstance(member, property)]


def test_every_public_name_is_tested():
    tests = "".join(file.read_text() for file in Path(__file__).parent.glob("test_*.py"))
    assert [name for name in PUBLIC if f"tanglebin.{name}" not in tests] == []


def test_every_public_name_is_documented():
    undocumented = []
    for name in PUBLIC:
        member = getattr(tanglebin, name)
        if inspect.isclass(member) and not hasattr(member, "__members__"):
            undocumented += [f"{name}.{of}" for of in members(member) if not getattr(member, of).__doc__]
        if callable(member):
            text = "".join(line for line in (member.__doc__ or "").splitlines() if not line.startswith(f"{name}("))
            undocumented += [] if text.strip() else [name]
    assert not undocumented, undocumented


def test_one_text_serves_both_languages(source):
    header = (source / "tanglebin" / "geometry" / "bin.hpp").read_text()
    assert f"/// {tanglebin.Bin.__doc__}" in header
    assert f"///< {tanglebin.Bin.wall.__doc__}" in header


def test_docstrings_are_those_of_python():
    assert "Raises InputError" in tanglebin.read_cloud.__doc__ and "Throws" not in tanglebin.read_cloud.__doc__
    texts = "".join(getattr(tanglebin, name).__doc__ or "" for name in PUBLIC)
    only_in_cpp = ["std::", "at_step", "at_place", "before_attempt", "checks the stream", "SIGINT", ".hpp", "validate("]
    assert [words for words in only_in_cpp if words in texts] == []


def run_mypy(*arguments):
    pytest.importorskip("mypy", reason="mypy is not installed")
    folder = str(Path(tanglebin.__file__).parents[1])
    return subprocess.run(
        [sys.executable, "-m", *arguments], env={"MYPYPATH": folder, "PYTHONPATH": folder, "PATH": "/usr/bin:/bin"},
        capture_output=True, text=True,
    )  # fmt: skip


def test_the_stubs_are_those_of_the_module(tmp_path):
    # What pybind11 does to every class: its own metaclass, and an __init__ that says that there is none.
    (tmp_path / "allowed").write_text("tanglebin\\._core\\.[A-Z]\\w+(\\.__init__)?\n")
    result = run_mypy("mypy.stubtest", "tanglebin._core", "--allowlist", str(tmp_path / "allowed"))
    assert result.returncode == 0, result.stdout + result.stderr


def test_a_type_checker_finds_the_mistakes_in_a_program(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import tanglebin\n"
        "cloud = tanglebin.read_ply('1.ply')\n"
        "tubes: list[tanglebin.Tube] = tanglebin.Dataset('dataset')[0].tubes\n"
        "tanglebin.score([1, 1], [1, 2])\n"
        "tanglebin.Bin(lenght=1)\n"
        "cloud.pionts\n"
    )
    result = run_mypy("mypy", "--cache-dir", str(tmp_path), str(program))
    lines = [line.split(":")[1] for line in result.stdout.splitlines() if ": error:" in line]
    assert lines == ["5", "6"], result.stdout + result.stderr


def test_a_strict_type_checker_finds_nothing_in_a_right_program(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import numpy\n"
        "import tanglebin\n"
        "camera = tanglebin.camera_preset('paper')\n"
        "camera.pose = numpy.eye(4)\n"
        "cloud = tanglebin.PointCloud(numpy.zeros((3, 3)))\n"
        "cloud.labels = numpy.array([1, 2, 3])\n"
        "for case in tanglebin.Dataset('dataset'):\n"
        "    points: int = len(case.cloud)\n"
        "recipe = tanglebin.Dataset('dataset').recipe\n"
        "recipe.sets = recipe.sets[:1]\n"
        "print(tanglebin.__version__)\n"
    )
    result = run_mypy("mypy", "--strict", "--cache-dir", str(tmp_path), str(program))
    assert result.returncode == 0, result.stdout + result.stderr
