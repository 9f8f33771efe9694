"""Layers of core and app: a module imports only from layers below its own, without circles; the core needs no window."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator, Sequence
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# From the lowest layer up; an import goes down, or stays inside one package.
CORE = [
    {"arrays", "errors", "hooks", "signal_guard"},
    {"parameters", "quantity", "registry", "terminal_text", "toml_text"},
    {"kernels", "summary"},
    {"mesh"},
    {"quality"},
    {"gallery", "boundary", "target"},
    {"layers", "locking"},
    {"energy"},
    {"doctor", "solver_checks"},
    {"iteration"},
    {"optimise"},
    {"smoothers"},
    {"io"},
    {"interop", "ranks", "run"},
    {"padding"},
    {"advice"},
    {"notebook", "report", "study"},
    {"cli"},
    {"__main__"},
]
APP = [
    {"resources", "translation"},
    {"formats"},
    {"codec"},
    {"picture"},
    {"state"},
    {"theme"},
    {"scene"},
    {"report"},
    {"widgets"},
    {"canvas"},
    {"host"},
    {"feature"},
    {"features"},
    {"shell"},
    {"cli", "notebook"},
    {"__main__"},
]
# None of the packages in this one imports another.
SIBLINGS = "features"
# The package itself, which exports names of all layers: in the core only these import from it.
SEES_THE_FACE = {"cli", "__main__"}
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
# Modules of the core that may import one of these, each when its functions are called.
CONVERTS = {("interop", "pyvista_grid"): "pyvista"}


def sources(folder: Path) -> list[tuple[Path, tuple[str, ...]]]:
    """List the source files below `folder`, each with its module's path from there."""
    found = [(path, path.relative_to(folder).with_suffix("").parts) for path in sorted(folder.rglob("*.py"))]
    assert found, f"there are no sources in {folder}"
    return found


def imported(path: Path) -> Iterator[tuple[str, int]]:
    """List the dotted names that a file imports anywhere, with lines; `from a import b` gives `a.b`.

    Imports for type checking, inside functions by `import_module("...")` and by `deferred("...:...")` are included.
    """
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1] in ("import_module", "deferred"):
            words = [word.value for word in node.args[:1] if isinstance(word, ast.Constant)]
            yield from ((word.partition(":")[0], node.lineno) for word in words)
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            home = "." * node.level + (node.module or "")
            yield from ((f"{home}.{alias.name}", node.lineno) for alias in node.names)


def broken(package: Path, floors: Sequence[set[str]], sees_the_face: set[str]) -> list[str]:
    """List the imports in `package` that go up or sideways, and the modules without a layer."""
    level = {name: floor for floor, names in enumerate(floors) for name in names}
    rows = []
    for path, parts in sources(package):
        mine = parts[0]
        if mine == "__init__":
            continue
        if mine not in level:
            rows.append(f"{path}: {mine!r} has no layer: give it one in {Path(__file__).name}")
            continue
        for name, line in imported(path):
            where = f"{path}:{line} imports {name}"
            root, *below = name.split(".")
            if root == "":
                rows.append(f"{where}: write the absolute name")
            elif root == package.name and mine == SIBLINGS and below[:1] == [mine] and len(parts) > 1:
                if below[1:2] and below[1] != parts[1]:
                    rows.append(f"{where}, a sibling of {parts[1]}: features meet in the session")
            elif root != package.name or below[:1] == [mine]:
                continue
            elif not below or below[0] not in level:
                if mine not in sees_the_face:
                    rows.append(f"{where} from the public face: name the module that has it")
            elif level[below[0]] >= level[mine]:
                rows.append(f"{where}, which is not below {mine}")
    return rows


def import_graph(package: Path) -> dict[str, set[str]]:
    """Map each module of `package` to the modules that it imports, packages above those included.

    A module's own packages are left out: Python has begun to import them whenever the module is imported.
    """
    modules = {".".join((package.name, *parts)).removesuffix(".__init__"): path for path, parts in sources(package)}
    graph: dict[str, set[str]] = {name: set() for name in modules}
    for name, path in modules.items():
        for target, _ in imported(path):
            words = target.split(".")
            reached = {".".join(words[:count]) for count in range(1, len(words) + 1)} & modules.keys()
            graph[name] |= {other for other in reached if not f"{name}.".startswith(f"{other}.")}
    return graph


def circle(graph: dict[str, set[str]]) -> str:
    """Name the modules of an import circle in order, "a -> b -> a"; "" where there is none."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return " -> ".join(reversed(error.args[1]))
    return ""


def test_the_core_has_no_import_circle():
    found = circle(import_graph(ROOT / "core/hexmend"))
    assert not found, f"import circle: {found}"


def test_the_core_keeps_its_floors():
    assert broken(ROOT / "core/hexmend", CORE, SEES_THE_FACE) == []


def test_the_app_keeps_its_floors():
    assert broken(ROOT / "app/hexmend_app", APP, set()) == []


DRAWS = {"pyvista", "vtk", "vtkmodules", "pyvistaqt", "pyqtgraph", "qtpy"}


@pytest.mark.parametrize(("folder", "forbidden"), [
    ("core/hexmend", {*WINDOWS, "benchmarks", "tests", "scripts"}),
    ("app/hexmend_app", {"benchmarks", "tests", "scripts"}),
    ("app/hexmend_app/state", {"PySide6.QtWidgets", "PySide6.QtGui", *DRAWS}),
    ("app/hexmend_app/scene", {"PySide6", "pyvistaqt", "pyqtgraph", "qtpy"}),
    ("app/hexmend_app/report", {"PySide6", *DRAWS}),
])  # fmt: skip
def test_a_folder_imports_nothing_that_it_may_not_know(folder, forbidden):
    rows = [
        f"{path}:{line} imports {name}"
        for path, parts in sources(ROOT / folder)
        for name, line in imported(path)
        if any(f"{name}.".startswith(f"{other}.") for other in forbidden) and name != CONVERTS.get(parts)
    ]
    assert rows == []


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


def test_the_library_does_not_exit():
    calls = {
        f"{path}:{node.lineno}"
        for path, parts in sources(ROOT / "core/hexmend")
        if parts[0] not in SEES_THE_FACE
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("sys.exit", "exit", "quit", "os._exit")
    }
    assert not calls
