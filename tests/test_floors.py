"""The house keeps its floors: a module imports only from floors below its own, and the core knows no window."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

CORE = [
    {"errors", "hexahedron"},
    {"parameters", "registry"},
    {"kernels"},
    {"topology"},
    {"mesh"},
    {"quality"},
    {"energy", "gallery"},
    {"optimise"},
    {"smoothers"},
    {"run"},
    {"io"},
    {"report", "study"},
    {"cli"},
    {"__main__"},
]
APP = [
    {"resources", "display"},
    {"state"},
    {"scene"},
    {"widgets"},
    {"actions", "commands"},
    {"window"},
    {"program"},
    {"bench", "cli"},
    {"__main__"},
]
WINDOWS = (
    "PySide6",
    "PyQt5",
    "PyQt6",
    "shiboken6",
    "qtpy",
    "vtk",
    "vtkmodules",
    "pyvista",
    "pyvistaqt",
    "pyqtgraph",
    "hexmend_app",
)


def modules(package: Path):
    return [(path, path.relative_to(package).with_suffix("").parts) for path in sorted(package.rglob("*.py"))]


def imported(path: Path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module, node.lineno
            yield from ((f"{node.module}.{alias.name}", node.lineno) for alias in node.names)


def broken(package: Path, floors: list[set[str]], root: str) -> list[str]:
    level = {name: floor for floor, names in enumerate(floors) for name in names}
    rows = []
    for path, parts in modules(package):
        mine = parts[0]
        if mine == "__init__":
            continue
        if mine not in level:
            rows.append(f"{path}: {mine!r} has no floor; give it one in this test")
            continue
        for name, line in imported(path):
            other = name.split(".")
            if other[0] != root or len(other) < 2 or other[1] not in level:
                continue
            if other[1] != mine and level[other[1]] >= level[mine]:
                rows.append(f"{path}:{line} imports {name}, which is not below {mine}")
    return rows


def test_the_core_keeps_its_floors():
    assert broken(ROOT / "core/hexmend", CORE, "hexmend") == []


def test_the_app_keeps_its_floors():
    assert broken(ROOT / "app/hexmend_app", APP, "hexmend_app") == []


def test_importing_all_of_the_core_brings_no_window_along():
    program = (
        "import importlib, pkgutil, sys, hexmend\n"
        "for one in pkgutil.walk_packages(hexmend.__path__, 'hexmend.'):\n"
        "    if not one.name.endswith('__main__'):\n"
        "        importlib.import_module(one.name)\n"
        f"print(sorted({{name.split('.')[0] for name in sys.modules}} & set({WINDOWS!r})))\n"
        "print(len([name for name in sys.modules if name.startswith('hexmend.')]))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    windows, count = done.stdout.splitlines()
    assert windows == "[]"
    assert int(count) > 40


@pytest.mark.parametrize(("floor", "forbidden"), [
    ("state", ("PySide6.QtWidgets", "PySide6.QtGui", "pyvista", "vtk", "vtkmodules", "pyvistaqt", "pyqtgraph")),
    ("scene", ("PySide6", "pyvistaqt", "pyqtgraph", "qtpy")),
])  # fmt: skip
def test_the_lower_floors_of_the_app_know_less(floor, forbidden):
    rows = [
        f"{path}:{line} imports {name}"
        for path, _ in modules(ROOT / "app/hexmend_app" / floor)
        for name, line in imported(path)
        if name.startswith(forbidden)
    ]
    assert rows == []


def test_the_library_neither_prints_nor_exits():
    rows = []
    for path, parts in modules(ROOT / "core/hexmend"):
        if parts[0] in ("cli", "__main__"):
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) in ("print", "sys.exit", "exit", "os._exit"):
                rows.append(f"{path}:{node.lineno} calls {ast.unparse(node.func)}")
    assert rows == []
