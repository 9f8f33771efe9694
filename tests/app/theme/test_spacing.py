"""Margins and spacings of layouts are on a grid of 4 pixels."""

from __future__ import annotations

import ast

from PySide6.QtCore import QMargins
from PySide6.QtWidgets import (
    QBoxLayout,
    QDialogButtonBox,
    QFormLayout,
    QGridLayout,
    QLayout,
    QMainWindow,
    QMenu,
    QTabBar,
)

from hexmend_app.canvas.canvas import Canvas
from hexmend_app.widgets.section import Section
from tests.app.dialogs import DIALOGS
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


def test_layouts_of_the_window_and_its_dialogs_have_no_spacing_of_qt(window):
    parts = [window, *(make(window) for name, make in DIALOGS.items() if name != "waiting")]
    off, seen = [], 0
    for layout in {layout for part in parts for layout in part.findChildren(QLayout)}:
        owner = layout.parentWidget()
        if not isinstance(layout, QBoxLayout | QGridLayout | QFormLayout) or not made_by_hexmend(owner):
            continue
        seen += 1
        box = isinstance(layout, QBoxLayout)
        spacings = [layout.spacing()] if box else [layout.horizontalSpacing(), layout.verticalSpacing()]
        margins = QMargins() if isinstance(owner, Canvas) else layout.contentsMargins()  # for its focus ring
        spacings += [margins.left(), margins.top(), margins.right(), margins.bottom()]
        if any(length % 4 for length in spacings):
            off.append((type(owner).__name__, owner.accessibleName(), spacings))
    for part in parts[1:]:
        part.deleteLater()
    assert seen > 150
    assert off == []


def made_by_hexmend(owner):
    """Return True for the widget of a layout that is not part of a composed widget of Qt, superqt or pyqtgraph."""
    composed = QDialogButtonBox, QMainWindow, QMenu, Section, QTabBar
    while owner is not None and type(owner).__module__.startswith(("PySide6", "pyqtgraph")):
        if isinstance(owner, composed) or owner.objectName() == "Form":
            return False
        owner = owner.parentWidget()
    return owner is not None and not isinstance(owner, composed)
