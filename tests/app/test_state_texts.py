"""The state of the app has neither sentences for users nor calls of kernels: both belong to the layers above it."""

from __future__ import annotations

import ast

import pytest

from tests.test_floors import ROOT, imported, sources


def sayings(source: str) -> list[str]:
    """List the sentences among a module's texts: four words, or fewer with a full stop; a formatted value is a word.

    Docstrings, messages of errors and names of threads are left out.
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
