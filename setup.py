"""Builds the Python package with CMake; pyproject.toml says the rest. The version is CMakeLists.txt's."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).parent.resolve()


def version():
    return re.search(r"project\(tanglebin VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)


class BuildWithCMake(build_ext):
    def build_extension(self, extension):
        build = Path(self.build_temp).resolve()
        options = ["-DTANGLEBIN_PYTHON=ON", "-DTANGLEBIN_BUILD_TESTS=OFF", "-DTANGLEBIN_BUILD_BENCH=OFF"]
        configure = ["cmake", "--preset", "release", "-S", SOURCE, "-B", build, *options]
        subprocess.run([*configure, f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "tanglebin_python"], check=True)
        package = Path(self.get_ext_fullpath(extension.name)).parent
        package.mkdir(parents=True, exist_ok=True)
        for file in (build / "python" / "tanglebin").glob("_core.*"):
            shutil.copy(file, package)


setup(
    version=version(),
    ext_modules=[Extension("tanglebin._core", sources=[])],
    cmdclass={"build_ext": BuildWithCMake},
)
