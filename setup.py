"""`pip install .`: CMake builds the module `lutka` with the static library and installs it into the wheel.

Needs what the library needs (tools/lib/setup.sh, LUTKA_BUILD_PACKAGES) and pybind11. Environment: LUTKA_CMAKE_ARGUMENTS are given to
CMake; LUTKA_PYTHON_BUILD is the build folder, `build-python` beside this file if it isn't set.
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).parent.resolve()
BUILD = pathlib.Path(os.environ.get("LUTKA_PYTHON_BUILD", ROOT / "build-python"))
VERSION = re.search(r"project\(Lutka VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def pybind11_folder():
    """Where pybind11's CMake package lies, when it was installed by pip."""
    try:
        import pybind11
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"]


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        to = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent.parent
        configure = ["cmake", "-S", str(ROOT), "-B", str(BUILD), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
        configure += ["-DLUTKA_BUILD_PYTHON=ON", "-DLUTKA_BUILD_TESTS=OFF", "-DLUTKA_UNITY_BUILD=ON"]
        configure += [f"-DPython_EXECUTABLE={sys.executable}", *pybind11_folder()]
        subprocess.run(configure + shlex.split(os.environ.get("LUTKA_CMAKE_ARGUMENTS", "")), check=True)
        jobs = ["-j", str(self.parallel)] if self.parallel else []
        subprocess.run(["cmake", "--build", str(BUILD), "--target", "lutka_python", *jobs], check=True)
        install = ["cmake", "--install", str(BUILD), "--component", "python", "--strip", "--prefix", str(to)]
        subprocess.run(install, check=True)


setup(
    version=VERSION,
    ext_modules=[Extension("lutka._lutka", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    options={"build": {"build_base": str(BUILD / "setuptools")}},
)
