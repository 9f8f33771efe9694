"""One word for one thing, in whatever the user reads: hex, not element; cut, not clip; titles of methods, not their ids."""

import ast
import re
from pathlib import Path

import pytest

import hexmend_app
from hexmend.smoothers import METHODS

ROOT = Path(hexmend_app.__file__).parent
FOLDERS = ("features", "widgets", "canvas", "shell", "state", "report", "cli")
FILES = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.py"))
BANNED = re.compile(r"\b(elements?|clip(s|ped|ping)?)\b", re.IGNORECASE)

#: Names for programs, which nobody reads: arguments of calls by which something is found, and options of the command.
KEYS = {"another", "get"}
OPTION = re.compile(r"--[a-z-]+")


def words_of(path: Path) -> list[tuple[int, str]]:
    """What a file's strings say, docstrings and names for programs left out: (line, text)."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    silent = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):  # of a module, a class, an attribute
            silent.add(node.value)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in KEYS:
            silent.update(node.args)
        if isinstance(node, ast.Dict):
            silent.update(key for key in node.keys if key is not None)
    return [
        (node.lineno, OPTION.sub("", node.value))
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in silent
    ]


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_a_thing_has_one_name(path):
    wrong = [f"line {line}: {text!r}" for line, text in words_of(path) if BANNED.search(text)]
    assert wrong == []


def test_the_words_are_found_where_they_are_read(tmp_path):
    source = tmp_path / "one.py"
    source.write_text(
        '"""An element."""\n'
        'label = "No element is chosen"\n'
        'other = f"{count} Elements"\n'
        'seen.another("clip", 1)\n'
        'parser.add("--clip", "where to cut")\n'
        'kept = {"clip": 1}\n'
    )
    found = [line for line, text in words_of(source) if BANNED.search(text)]
    assert found == [2, 3]


def test_a_method_is_called_by_its_title():
    from hexmend_app.features.compare.comparison_table import INITIAL, title_of
    from hexmend_app.state.mesh.document import State
    from hexmend_app.state.mesh.history import History
    from tests.core.grids import grid

    for name, method in METHODS.items():
        assert title_of(name) == method.title
    assert title_of(INITIAL) == INITIAL
    history, start = History(), State.of(grid(1))
    names = [history.begin(METHODS["local-sd"].title, start).name for _ in range(2)]
    assert names == ["Local steepest descent", "Local steepest descent (2)"]
