"""The house keeps its floors: a module imports only from floors below its own, and the core knows no window."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# From the ground up; an import goes down, or stays inside one package's own folder.
CORE = [
    {"aliases", "arrays", "errors", "signal_guard"},
    {"figures", "html_repr", "parameters", "registry", "toml_text"},
    {"kernels"},
    {"mesh"},
    {"quality"},
    {"gallery", "boundary"},
    {"energy"},
    {"doctor"},
    {"iteration"},
    {"optimise"},
    {"smoothers"},
    {"io"},
    {"interop", "run"},
    {"node_step"},
    {"advice"},
    {"notebook", "report", "study"},
    {"cli"},
    {"__main__"},
]
APP = [
    {"resources"},
    {"formats"},
    {"state"},
    {"scene"},
    {"report"},
    {"widgets"},
    {"canvas"},
    {"feature"},
    {"features"},
    {"shell"},
    {"bench"},
    {"cli", "notebook"},
    {"__main__"},
]
# Of these folders none imports another.
SIBLINGS = "features"
# The public face stands above the core's floors: of them only the command line may look at it.
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
# The one module of the core that may name one of them: it is imported when its functions are called.
CONVERTS = {("interop", "pyvista_grid"): "pyvista"}


def sources(folder: Path) -> list[tuple[Path, tuple[str, ...]]]:
    """Every source file below `folder` and its module's path from there; never none."""
    found = [(path, path.relative_to(folder).with_suffix("").parts) for path in sorted(folder.rglob("*.py"))]
    assert found, f"there are no sources in {folder}"
    return found


def imported(path: Path) -> Iterator[tuple[str, int]]:
    """What a file imports, at any depth of it, as dotted names with lines; `from a import b` gives `a.b`."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            home = "." * node.level + (node.module or "")
            yield from ((f"{home}.{alias.name}", node.lineno) for alias in node.names)


def broken(package: Path, floors: Sequence[set[str]], sees_the_face: set[str]) -> list[str]:
    """The imports in `package` that go up or sideways, and the modules that have no floor."""
    level = {name: floor for floor, names in enumerate(floors) for name in names}
    rows = []
    for path, parts in sources(package):
        mine = parts[0]
        if mine == "__init__":
            continue
        if mine not in level:
            rows.append(f"{path}: {mine!r} has no floor: give it one in {Path(__file__).name}")
            continue
        for name, line in imported(path):
            where = f"{path}:{line} imports {name}"
            root, *below = name.split(".")
            if root == "":
                rows.append(f"{where}: write the whole name, so that floors can be seen")
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


def test_the_core_keeps_its_floors():
    assert broken(ROOT / "core/hexmend", CORE, SEES_THE_FACE) == []


def test_the_app_keeps_its_floors():
    assert broken(ROOT / "app/hexmend_app", APP, set()) == []


@pytest.mark.parametrize(("module", "line", "complaint"), [
    ("mesh/mesh.py", "from hexmend.run import smooth", "not below mesh"),
    ("mesh/mesh.py", "def late():\n    import hexmend.io.formats.vtk.vtu", "not below mesh"),
    ("energy/regularisation.py", "from hexmend import smoothers", "not below energy"),
    ("run/recipe.py", "import hexmend", "public face"),
    ("run/recipe.py", "from hexmend import Mesh", "public face"),
    ("run/recipe.py", "from .recipe_files import read_recipe", "whole name"),
    ("magic.py", "import os", "has no floor"),
    ("cli/info.py", "from hexmend import read", None),
    ("cli/info.py", "from hexmend.cli.command import settings", None),
    ("io/vtu.py", "from hexmend import errors", None),
    ("io/vtu.py", "from hexmend_app.shell.window import Window", None),  # the windows' own test sees to this one
])  # fmt: skip
def test_a_broken_floor_is_seen(tmp_path, module, line, complaint):
    path = tmp_path / "hexmend" / module
    path.parent.mkdir(parents=True)
    path.write_text(line)
    rows = broken(tmp_path / "hexmend", CORE, SEES_THE_FACE)
    assert [complaint in row for row in rows] == ([True] if complaint else [])


def test_a_feature_that_imports_a_sibling_is_seen(tmp_path):
    path = tmp_path / "hexmend_app" / "features" / "cut" / "feature.py"
    path.parent.mkdir(parents=True)
    path.write_text("from hexmend_app.features.cut.panel import Panel\nfrom hexmend_app.features.look import feature")
    (row,) = broken(tmp_path / "hexmend_app", APP, set())
    assert "a sibling of cut" in row


def test_the_core_names_no_window():
    rows = [
        f"{path}:{line} imports {name}"
        for path, parts in sources(ROOT / "core/hexmend")
        for name, line in imported(path)
        if name.split(".")[0] in WINDOWS and name != CONVERTS.get(parts)
    ]
    assert rows == []


def test_the_modules_that_convert_are_there():
    assert {parts for _, parts in sources(ROOT / "core/hexmend")} >= CONVERTS.keys()


def test_importing_all_of_the_core_brings_no_window_along():
    program = (
        "import importlib, pkgutil, sys, hexmend\n"
        "for one in pkgutil.walk_packages(hexmend.__path__, 'hexmend.'):\n"
        "    if not one.name.endswith('__main__'):\n"
        "        importlib.import_module(one.name)\n"
        f"print(sorted({{name.split('.')[0] for name in sys.modules}} & set({WINDOWS!r})))\n"
        "print(*sorted(name for name in sys.modules if name.startswith('hexmend.')))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    windows, modules = done.stdout.splitlines()
    assert windows == "[]"
    every = {
        ".".join(("hexmend", *parts)).removesuffix(".__init__")
        for _, parts in sources(ROOT / "core/hexmend")
        if parts[-1] != "__main__"
    }
    assert every - set(modules.split()) == {"hexmend"}, "these were not looked at"


@pytest.mark.parametrize(("floor", "forbidden"), [
    ("state", {"PySide6.QtWidgets", "PySide6.QtGui", "pyvista", "vtk", "vtkmodules", "pyvistaqt", "pyqtgraph", "qtpy"}),
    ("scene", {"PySide6", "pyvistaqt", "pyqtgraph", "qtpy"}),
    ("report", {"PySide6", "pyvista", "vtk", "vtkmodules", "pyvistaqt", "pyqtgraph", "qtpy"}),
])  # fmt: skip
def test_the_lower_floors_of_the_app_know_less(floor, forbidden):
    rows = [
        f"{path}:{line} imports {name}"
        for path, _ in sources(ROOT / "app/hexmend_app" / floor)
        for name, line in imported(path)
        if any(f"{name}.".startswith(f"{other}.") for other in forbidden)
    ]
    assert rows == []


def sayings(source: str) -> list[str]:
    """The sentences among a module's texts: four words, or fewer with a full stop. What stands for a value is a word.

    Left out are docstrings, the words of errors, which name what is wrong where it is found, and names of threads.
    """
    tree, left_out, found = ast.parse(source), set(), []
    for node in ast.walk(tree):
        thread = isinstance(node, ast.Call) and ast.unparse(node.func) == "Task"
        documents = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        if isinstance(node, ast.Raise) or documents:
            left_out.update(map(id, ast.walk(node)))
        elif thread:
            left_out.update(map(id, ast.walk(node.args[0])))
        if isinstance(node, ast.JoinedStr):
            text = "".join(part.value if isinstance(part, ast.Constant) else "0" for part in node.values)
            left_out.update(map(id, node.values))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            text = node.value
        else:
            continue
        words = len(text.split())
        if id(node) not in left_out and (words > 3 or (words > 2 and text.endswith("."))):
            found.append(f"line {node.lineno}: {text!r}")
    return found


@pytest.mark.parametrize(("source", "count"), [
    ('x = "an element is inverted"', 1),
    ('x = f"{node} is {where}."', 1),
    ('x = "go back"', 0),
    ('"""An element is inverted, alas."""', 0),
    ('class A:\n    x = 1\n    """What an element is now."""', 0),
    ('raise ValueError(f"{x} is no number: expected one")', 0),
    ('Task(f"reading the step of node {k}", lambda task: tell("this is a sentence"))', 1),
])  # fmt: skip
def test_a_sentence_is_seen(source, count):
    assert len(sayings(source)) == count


def test_state_holds_no_sentences_and_no_kernels():
    rows = []
    for path, _ in sources(ROOT / "app/hexmend_app/state"):
        rows += [f"{path}: {saying}" for saying in sayings(path.read_text(encoding="utf-8"))]
        for name, line in imported(path):
            if name.startswith("hexmend.kernels") and name.split(".")[-1] not in ("threads", "set_threads"):
                rows.append(f"{path}:{line} imports {name}")
    assert rows == []


def test_the_library_neither_prints_nor_exits():
    rows = []
    for path, parts in sources(ROOT / "core/hexmend"):
        if parts[0] in ("cli", "__main__"):
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) in (
                "print",
                "sys.exit",
                "exit",
                "quit",
                "os._exit",
            ):
                rows.append(f"{path}:{node.lineno} calls {ast.unparse(node.func)}")
    assert rows == []
