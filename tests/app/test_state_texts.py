"""The state of the app contains neither sentences for users nor calls of kernels, which belong to other layers."""

from __future__ import annotations

import ast

import pytest

from tests.test_floors import ROOT, imported, sources


def sentences(source: str) -> list[str]:
    """List the texts of a module with four words, or three and a full stop; a formatted value counts as a word.

    Docstrings, messages of errors and names of threads are excluded.
    """
    tree, excluded, found = ast.parse(source), set(), []
    for node in ast.walk(tree):
        is_task = isinstance(node, ast.Call) and ast.unparse(node.func) == "Task"
        is_docstring = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        if isinstance(node, ast.Raise) or is_docstring:
            excluded.update(map(id, ast.walk(node)))
        elif is_task:
            excluded.update(map(id, ast.walk(node.args[0])))
        if isinstance(node, ast.JoinedStr):
            text = "".join(part.value if isinstance(part, ast.Constant) else "0" for part in node.values)
            excluded.update(map(id, node.values))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            text = node.value
        else:
            continue
        words = len(text.split())
        if id(node) not in excluded and (words > 3 or (words > 2 and text.endswith("."))):
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
def test_sentences_are_found(source, count):
    assert len(sentences(source)) == count


def test_state_contains_no_sentences_and_no_kernels():
    rows = []
    for path, _ in sources(ROOT / "app/hexmend_app/state"):
        rows += [f"{path}: {sentence}" for sentence in sentences(path.read_text(encoding="utf-8"))]
        for name, line in imported(path):
            if name.startswith("hexmend.kernels") and name.split(".")[-1] not in ("threads", "set_threads"):
                rows.append(f"{path}:{line} imports {name}")
    assert rows == []
