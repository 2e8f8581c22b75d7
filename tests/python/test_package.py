# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

"""The package as a whole: its stubs say what there is, the program starts, other modules are left in peace."""

import ast
import enum
import importlib
import pathlib
import re
import subprocess
import sys

import cv2
import pytest

import stillpoint
from conftest import PROJECT

PACKAGE = pathlib.Path(stillpoint.__file__).parent


def public(names):
    return {name for name in names if not name.startswith("_")}


def words(doc):
    return " ".join((doc or "").split())


def stubs():
    return {node.name: node for node in ast.parse((PACKAGE / "__init__.pyi").read_text()).body
            if isinstance(node, (ast.ClassDef, ast.FunctionDef))}


def assert_same_function(stub, function, place):
    names = [argument.arg for argument in stub.args.args]
    signature = function.__doc__.splitlines()[0]
    found = re.findall(r"[(,] ?(\w+):", re.sub(r"\[[^\]]*\]", "", signature))
    assert found == names or found == ["self"] + names[1:], f"{place}: {signature}"
    assert words(ast.get_docstring(stub)) in words(function.__doc__), place


def test_stubs_say_what_there_is():
    assert public(stubs()) == public(stillpoint.__all__) == public(dir(stillpoint))
    for name, stub in stubs().items():
        thing = getattr(stillpoint, name)
        assert words(ast.get_docstring(stub)) in words(thing.__doc__), name
        if isinstance(stub, ast.FunctionDef):
            assert_same_function(stub, thing, name)
            continue
        if issubclass(thing, enum.IntEnum):
            assert {line.targets[0].id: line.value.value for line in stub.body[1:]} == {m.name: m.value for m in thing}, name
            continue
        members = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
        assert public(members) == public(vars(thing)), name
        for member, node in members.items():
            if isinstance(vars(thing).get(member), property):
                assert words(ast.get_docstring(node)) == words(vars(thing)[member].__doc__), f"{name}.{member}"
            elif member == "__init__" or not member.startswith("_"):
                assert_same_function(node, getattr(thing, member), f"{name}.{member}")
    assert (PACKAGE / "py.typed").is_file()


def test_statuses_and_warnings_are_those_of_the_document():
    page = (PROJECT / "docs/statuses.md").read_text()
    statuses, rest = page.split("## Statuses")[1].split("## Warnings")
    rows = lambda text: re.findall(r"^\| `(\w+)`", text, re.MULTILINE)
    assert rows(statuses) == [status.name for status in stillpoint.Status]
    assert rows(rest.split("## ")[0]) == [warning.name for warning in stillpoint.FrameWarning]


def test_version():
    header = (PROJECT / "include/stillpoint/version.hpp").read_text()
    assert f'STILLPOINT_VERSION "{stillpoint.__version__}"' in header


def program(*arguments, **more):
    return subprocess.run([sys.executable, "-m", "stillpoint", *arguments], capture_output=True, text=True, **more)


def test_program():
    assert program("--version").stdout.strip().endswith(stillpoint.__version__)
    wrong = program("--tum", "/none")
    assert wrong.returncode == 2 and wrong.stderr.startswith("stillpoint_run: ") and wrong.stderr.count("\n") == 1


def test_the_example_passes_over_images_without_features(reference, tmp_path):
    for file in reference.iterdir():
        if file.name != "rgb":
            (tmp_path / file.name).symlink_to(file)
    rows = [row for row in (reference / "rgb.txt").read_text().splitlines() if not row.startswith("#")][:4]
    (tmp_path / "rgb.txt").unlink()
    (tmp_path / "rgb.txt").write_text("\n".join(rows))
    (tmp_path / "rgb").mkdir()
    for i, row in enumerate(rows):
        image = cv2.imread(str(reference / row.split()[1]))
        cv2.imwrite(str(tmp_path / row.split()[1]), image * (i not in (0, 2)))  # black
    outcome = subprocess.run([sys.executable, PROJECT / "examples/python/tum_folder.py", tmp_path], capture_output=True,
                             text=True)
    assert outcome.returncode == 0, outcome.stderr
    assert [line.split(":", 1)[1][:13] == " no features" for line in outcome.stdout.splitlines()] == [True, False, True, False]


def test_an_archive_of_sources_is_refused(monkeypatch):
    monkeypatch.syspath_prepend(PROJECT / "python")
    backend = importlib.import_module("setup_beside_package")
    with pytest.raises(backend.UnsupportedOperation, match="no archive of sources .* build the wheel"):
        backend.build_sdist("anywhere")


@pytest.mark.skipif(sys.platform != "linux", reason="reads the memory map of Linux")
def test_no_opencv_is_loaded_and_any_cv2_may_be():
    """The module takes no part of OpenCV: cv2 of Debian or of a wheel, before or after it."""
    loaded = "sum('opencv' in line for line in open('/proc/self/maps'))"
    alone = subprocess.run([sys.executable, "-c", f"import stillpoint; print({loaded})"], capture_output=True, text=True, check=True)
    assert alone.stdout.strip() == "0"
    for order in ("cv2, stillpoint", "stillpoint, cv2"):
        subprocess.run([sys.executable, "-c", f"import numpy as np, {order}\n"
                        "image = np.zeros((48, 64), np.uint8)\n"
                        "f = stillpoint.FrameFilter(stillpoint.Camera(60, 60, 32, 24, 64, 48))\n"
                        "print(f.filter_frame(image, None, 0, cv2.ORB_create().detect(image)))"], check=True)
