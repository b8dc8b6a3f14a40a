"""The packages hold what they should, and nothing of the machine that made them."""

import gzip
import re
import shutil
import subprocess

import pytest


@pytest.fixture(scope="session")
def packages(build, tmp_path_factory):
    """The files of each package, and its control fields."""
    for program in ("dpkg-deb", "dpkg-shlibdeps", "cpack"):
        if not shutil.which(program):
            pytest.skip(f"{program} is not installed")
    folder = tmp_path_factory.mktemp("packages")
    subprocess.run(["cpack", "-G", "DEB", "-B", folder], cwd=build, check=True, stdout=subprocess.DEVNULL)
    for file in folder.glob("*.deb"):
        subprocess.run(["dpkg-deb", "--raw-extract", file, folder / file.name.split("_")[0]], check=True)
    yield folder
    shutil.rmtree(folder)


def control(packages, package):
    return dict(re.findall(r"^([\w-]+): (.*)$", (packages / package / "DEBIAN" / "control").read_text(), re.MULTILINE))


def files(packages, package):
    folder = packages / package
    return {str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()}


ALL = ["tanglebin", "libtanglebin-dev", "python3-tanglebin"]


def test_there_are_three_of_the_projects_version(packages, source):
    version = re.search(r"project\(tanglebin VERSION (\S+)", (source / "CMakeLists.txt").read_text()).group(1)
    assert sorted(file.name.split("_")[:2] for file in packages.glob("*.deb")) == sorted([name, f"{version}-1"] for name in ALL)
    for package in ALL:
        assert control(packages, package)["Version"] == f"{version}-1"


def test_the_program_has_its_manual_completions_and_recipes(packages, source, options):
    expected = {"usr/bin/tanglebin", "usr/share/man/man1/tanglebin.1.gz", "usr/share/bash-completion/completions/tanglebin",
                "usr/share/zsh/vendor-completions/_tanglebin", "usr/share/doc/tanglebin/formats.md"}
    expected |= {f"usr/share/man/man1/tanglebin-{command}.1.gz" for command in filter(None, options)}
    expected |= {f"usr/share/tanglebin/recipes/{recipe.name}" for recipe in (source / "recipes").glob("*.toml")}
    assert expected - files(packages, "tanglebin") == set()


def test_the_manual_has_every_option(packages, options):
    for command in filter(None, options):
        page = gzip.open(packages / "tanglebin" / "usr/share/man/man1" / f"tanglebin-{command}.1.gz", "rt").read()
        assert re.findall(r"^\\fB(--[\w-]+)\\fR", page.replace("\\-", "-"), re.MULTILINE) == options[command]


def test_the_libraries_have_headers_and_what_cmake_finds_them_by(packages):
    found = files(packages, "libtanglebin-dev")
    assert {"usr/lib/libtanglebin_core.a", "usr/lib/cmake/tanglebin/tanglebinConfig.cmake",
            "usr/include/tanglebin/model/model_tubes.hpp", "usr/share/doc/libtanglebin-dev/examples/minimal/main.cpp"} - found == set()
    assert "usr/bin/tanglebin" not in found


def test_the_python_package_has_module_and_stubs(packages):
    module = "usr/lib/python3/dist-packages/tanglebin"
    found = files(packages, "python3-tanglebin")
    assert {f"{module}/__init__.py", f"{module}/_dataset.py", f"{module}/_core.pyi", f"{module}/py.typed"} - found == set()
    assert any(re.fullmatch(rf"{module}/_core\..*\.so", file) for file in found)
    assert not any("__pycache__" in file for file in found)


@pytest.mark.parametrize("package, needs", [
    ("tanglebin", ["libembree3-3", "libode8", "libhdf5-103-1", "libc6"]),
    ("libtanglebin-dev", ["libembree-dev", "libode-dev", "libeigen3-dev", "pkgconf"]),
    ("python3-tanglebin", ["libembree3-3", "libode8", "python3", "python3-numpy"]),
])
def test_dependencies_are_those_that_are_linked(packages, package, needs):
    dependencies = {dependency.split()[0] for dependency in control(packages, package)["Depends"].split(", ")}
    assert set(needs) - dependencies == set()
    assert dependencies & {"libpcl-dev", "cmake", "g++"} == set()


@pytest.mark.parametrize("package", ALL)
def test_each_has_copyright_and_changelogs(packages, package):
    expected = {f"usr/share/doc/{package}/{name}" for name in ("copyright", "changelog.gz", "changelog.Debian.gz")}
    assert expected - files(packages, package) == set()


@pytest.mark.parametrize("package", ALL)
def test_no_file_names_a_folder_of_this_machine(packages, package, build, source):
    here = [str(build).encode(), str(source).encode()]
    guilty = [file for file in files(packages, package) if any(path in (packages / package / file).read_bytes() for path in here)]
    assert guilty == []
