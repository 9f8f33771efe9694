#!/usr/bin/env python3
"""Check the layers of core and app: modules import from layers below their own, without circles. Part of make lint."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator, Sequence
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

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
    {"chart_feature"},
    {"features"},
    {"shell"},
    {"cli", "notebook"},
    {"__main__"},
]
# The folders of the app's `scene`, by the same rule.
SCENE = [
    {"geometry", "camera"},
    {"colour"},
    {"cutting"},
    {"layers"},
    {"views", "handles"},
    {"film", "page", "render"},
]
# Folders of one layer that may import each other.
JOINED = {"film", "page", "render"}
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


def broken(package: Path, floors: Sequence[set[str]], sees_the_face: set[str], home: str = "") -> list[str]:
    """List the imports in `package`, of the dotted name `home`, that go up or sideways, and modules without a layer."""
    level = {name: floor for floor, names in enumerate(floors) for name in names}
    home, rows = home or package.name, []
    for path, parts in sources(package):
        mine = parts[0]
        if mine == "__init__":
            continue
        if mine not in level:
            rows.append(f"{path}: {mine!r} has no layer: give it one in {Path(__file__).name}")
            continue
        for name, line in imported(path):
            where = f"{path}:{line} imports {name}"
            inside, below = f"{name}.".startswith(f"{home}."), name.removeprefix(home).split(".")[1:]
            if name.startswith("."):
                rows.append(f"{where}: write the absolute name")
            elif inside and mine == SIBLINGS and below[:1] == [mine] and len(parts) > 1:
                if below[1:2] and below[1] != parts[1]:
                    rows.append(f"{where}, a sibling of {parts[1]}: features meet in the session")
            elif not inside or below[:1] == [mine] or {mine, *below[:1]} <= JOINED:
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


#: Packages that draw.
DRAWS = {"pyvista", "vtk", "vtkmodules", "pyvistaqt", "pyqtgraph", "qtpy"}
#: Names that the modules of a folder do not import.
FORBIDDEN = {
    "core/hexmend": {*WINDOWS, "benchmarks", "tests", "scripts"},
    "app/hexmend_app": {"benchmarks", "tests", "scripts"},
    "app/hexmend_app/state": {"PySide6.QtWidgets", "PySide6.QtGui", *DRAWS},
    "app/hexmend_app/scene": {"PySide6", "pyvistaqt", "pyqtgraph", "qtpy"},
    "app/hexmend_app/report": {"PySide6", *DRAWS},
}


def forbidden(folder: str) -> list[str]:
    """List the imports of names that modules of a folder must not import."""
    return [
        f"{path}:{line} imports {name}"
        for path, parts in sources(ROOT / folder)
        for name, line in imported(path)
        if any(f"{name}.".startswith(f"{other}.") for other in FORBIDDEN[folder]) and name != CONVERTS.get(parts)
    ]


def exits() -> list[str]:
    """List the calls by which a library would end the process."""
    return [
        f"{path}:{node.lineno} ends the process"
        for path, parts in sources(ROOT / "core/hexmend")
        if parts[0] not in SEES_THE_FACE
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("sys.exit", "exit", "quit", "os._exit")
    ]


def main() -> int:
    """Print what is wrong; returns 1 if there is anything."""
    core, app = ROOT / "core/hexmend", ROOT / "app/hexmend_app"
    rows = broken(core, CORE, SEES_THE_FACE) + broken(app, APP, set()) + exits()
    rows += broken(app / "scene", SCENE, set(), "hexmend_app.scene")
    rows += [row for folder in FORBIDDEN for row in forbidden(folder)]
    found = circle(import_graph(core))
    rows += [f"import circle: {found}"] if found else []
    print(*rows, sep="\n", end="\n" if rows else "", file=sys.stderr)
    return bool(rows)


if __name__ == "__main__":
    sys.exit(main())
