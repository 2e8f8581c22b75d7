# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""The backend of setuptools, with its setup.py in this folder instead of the project's."""

from setuptools.build_meta import _BuildMetaBackend


class Backend(_BuildMetaBackend):
    def run_setup(self, setup_script="python/setup.py"):
        super().run_setup(setup_script)


class UnsupportedOperation(Exception):
    """What a frontend expects of a hook that a project has not (PEP 517)."""


def build_sdist(sdist_directory, config_settings=None):
    raise UnsupportedOperation("stillpoint has no archive of sources for Python, because its C++ is outside of the package; "
                               "build the wheel in a checkout instead: pip wheel --no-build-isolation . (docs/python.md)")


_backend = Backend()
build_wheel = _backend.build_wheel
get_requires_for_build_wheel = _backend.get_requires_for_build_wheel
prepare_metadata_for_build_wheel = _backend.prepare_metadata_for_build_wheel
if hasattr(_backend, "build_editable"):  # from setuptools 64 on
    build_editable = _backend.build_editable
    get_requires_for_build_editable = _backend.get_requires_for_build_editable
    prepare_metadata_for_build_editable = _backend.prepare_metadata_for_build_editable
