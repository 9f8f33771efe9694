"""Rows of joined buttons, used by keyboard."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QVBoxLayout, QWidget

from hexmend_app.widgets.inputs.segmented import Segmented
from tests.patience import PATIENCE


@pytest.fixture
def between(shown):
    """Three joined buttons between two text fields."""
    widget = QWidget()
    column = QVBoxLayout(widget)
    widget.before, widget.after = QLineEdit(), QLineEdit()
    widget.choice = Segmented("Size", [(key, key.title(), f"{key}.") for key in ("small", "middle", "large")])
    for part in (widget.before, widget.choice, widget.after):
        column.addWidget(part)
    return shown(widget)


@pytest.mark.parametrize("chosen", ["small", "middle", "large"])
@pytest.mark.parametrize("back", [False, True], ids=["Tab", "Shift+Tab"])
def test_tab_reaches_only_the_checked_button_from_either_side(between, chosen, back):
    between.choice.set_value(chosen)
    first, last = (between.after, between.before) if back else (between.before, between.after)
    first.setFocus()
    key = Qt.Key.Key_Backtab if back else Qt.Key.Key_Tab
    QTest.keyClick(first, key)
    assert QApplication.focusWidget() is between.choice.button(chosen)
    QTest.keyClick(QApplication.focusWidget(), key)
    assert QApplication.focusWidget() is last


def test_arrow_keys_check_buttons(between, qtbot):
    between.before.setFocus()
    QTest.keyClick(between.before, Qt.Key.Key_Tab)
    with qtbot.waitSignal(between.choice.chosen, timeout=PATIENCE) as told:
        QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Right)
    assert told.args == ["middle"]
    assert between.choice.value() == "middle"
    assert between.choice.button("middle").hasFocus()
