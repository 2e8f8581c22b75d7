# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""The backend of setuptools, with its setup.py in this folder instead of the project's."""

from setuptools.build_meta import _BuildMetaBackend


class Backend(_BuildMetaBackend):
    def run_setup(self, setup_script="python/setup.py"):
        super().run_setup(setup_script)


_backend = Backend()
build_sdist = _backend.build_sdist
build_wheel = _backend.build_wheel
get_requires_for_build_sdist = _backend.get_requires_for_build_sdist
get_requires_for_build_wheel = _backend.get_requires_for_build_wheel
prepare_metadata_for_build_wheel = _backend.prepare_metadata_for_build_wheel
if hasattr(_backend, "build_editable"):  # from setuptools 64 on
    build_editable = _backend.build_editable
    get_requires_for_build_editable = _backend.get_requires_for_build_editable
    prepare_metadata_for_build_editable = _backend.prepare_metadata_for_build_editable
