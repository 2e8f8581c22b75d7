# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""The compiled part of the Python package: CMake builds it, with the options in CMAKE_ARGS. The rest is in
../pyproject.toml, whose backend runs this from the folder above."""

import os
import pathlib
import re
import shlex
import subprocess
import sys

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Without --backend slam and --bag, stillpoint_run in the wheel needs OpenCV and yaml-cpp alone of the machine that it runs on.
SMALL_PROGRAM = ["-DCMAKE_DISABLE_FIND_PACKAGE_Ceres=ON", "-DSTILLPOINT_BUILD_ROS=OFF"]


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        build = pathlib.Path(self.build_temp).resolve()
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DSTILLPOINT_BUILD_PYTHON=ON", "-DSTILLPOINT_BUILD_EXAMPLES=ON",
                   "-DSTILLPOINT_BUILD_TESTS=OFF", "-DSTILLPOINT_BUILD_BENCHMARKS=OFF", "-DSTILLPOINT_BUILD_DOCS=OFF",
                   "-DSTILLPOINT_BUILD_SHIM=OFF", *SMALL_PROGRAM, f"-DPython_EXECUTABLE={sys.executable}",
                   f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"] + shlex.split(os.environ.get("CMAKE_ARGS", ""))
        (package / "stillpoint_run").unlink(missing_ok=True)  # of an earlier build with other options
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        for command in (["cmake", "-S", ROOT, "-B", build, *options],
                        ["cmake", "--build", build, "--target", "stillpoint_python_package", "--parallel", jobs],
                        ["cmake", "--install", build, "--component", "python", "--prefix", package]):
            subprocess.run(command, check=True)


VERSION = re.search(r'STILLPOINT_VERSION "(.*)"', (ROOT / "include/stillpoint/version.hpp").read_text(encoding="utf-8"))[1]

setup(version=VERSION, ext_modules=[Extension("stillpoint._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
