"""Layers: the core needs no window, and the check of make lint sees what breaks them."""

import subprocess
import sys
from pathlib import Path

import pytest

from scripts.check_layers import CORE, SEES_THE_FACE, WINDOWS, broken, circle, import_graph


def package(folder: Path, **files: str) -> Path:
    """Write the modules of a package `hexmend`, with __ for / in their names."""
    for name, text in files.items():
        path = folder / "hexmend" / f"{name.replace('__', '/')}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "hexmend"


@pytest.mark.parametrize("line", [
    "from hexmend.mesh import upper",
    "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from hexmend.mesh.upper import X",
    "import importlib\n\ndef late():\n    importlib.import_module('hexmend.mesh.upper')",
])  # fmt: skip
def test_a_circle_is_named(tmp_path, line):
    found = circle(import_graph(package(tmp_path, mesh__lower=line, mesh__upper="import hexmend.mesh.lower")))
    assert found.split(" -> ").count("hexmend.mesh.upper") > 0
    assert circle(import_graph(package(tmp_path, mesh__lower="import os"))) == ""


@pytest.mark.parametrize(("module", "line", "complaint"), [
    ("mesh__mesh", "from hexmend.run import smooth", "not below mesh"),
    ("mesh__mesh", "import importlib\nimportlib.import_module('hexmend.quality')", "not below mesh"),
    ("run__recipe", "from hexmend import Mesh", "public face"),
    ("run__recipe", "from .recipe_files import read_recipe", "absolute name"),
    ("magic", "import os", "has no layer"),
    ("cli__info", "from hexmend import read", None),
])  # fmt: skip
def test_a_broken_floor_is_seen(tmp_path, module, line, complaint):
    rows = broken(package(tmp_path, **{module: line}), CORE, SEES_THE_FACE)
    assert [complaint in row for row in rows] == ([True] if complaint else [])


def test_importing_all_of_the_core_brings_no_window_along():
    program = (
        "import importlib, pkgutil, sys, hexmend\n"
        "for one in pkgutil.walk_packages(hexmend.__path__, 'hexmend.'):\n"
        "    if not one.name.endswith('__main__'):\n"
        "        importlib.import_module(one.name)\n"
        f"print(sorted({{name.split('.')[0] for name in sys.modules}} & set({WINDOWS!r})))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
