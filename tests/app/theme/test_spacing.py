"""Margins and spacings of layouts are on a grid of 4 pixels."""

from __future__ import annotations

import ast

from tests.examples import ROOT

_SETTERS = {"setContentsMargins", "setSpacing", "setHorizontalSpacing", "setVerticalSpacing", "addSpacing"}


def lengths():
    """Yield the place and value of each number that a margin or spacing is set to."""
    for path in sorted((ROOT / "app/hexmend_app").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in _SETTERS:
                for argument in node.args:
                    if isinstance(argument, ast.Constant):
                        yield f"{path.relative_to(ROOT)}:{node.lineno}", argument.value


def test_margins_and_spacings_are_multiples_of_four():
    found = list(lengths())
    assert len(found) > 100
    assert [place for place, value in found if value % 4] == []
