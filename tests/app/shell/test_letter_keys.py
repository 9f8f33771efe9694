"""Letters in combo boxes, lists and tables of a window of which single letters are shortcuts."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QComboBox,
    QDockWidget,
    QListWidget,
    QMainWindow,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.shell.letter_keys import LetterKeys

WORDS = ["Laplacian", "Mend", "Steepest descent", "Truss"]


class Lists(QMainWindow):
    """Window with lists and single-letter shortcuts, which records the shortcuts used."""

    def __init__(self):
        super().__init__()
        self.box, self.editable, self.list, self.number = QComboBox(), QComboBox(), QListWidget(), QSpinBox()
        self.editable.setEditable(True)
        page = QWidget()
        layout = QVBoxLayout(page)
        for part in (self.box, self.editable, self.list, self.number):
            layout.addWidget(part)
        self.dock = QDockWidget()
        self.docked = QComboBox()
        self.dock.setWidget(self.docked)
        self.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, self.dock)
        self.setCentralWidget(page)
        for part in (self.box, self.editable, self.list, self.docked):
            part.addItems(WORDS)
        self.list.setCurrentRow(0)
        self.pressed = []
        for letter in "LMST1":
            QShortcut(QKeySequence(letter), self, lambda letter=letter: self.pressed.append(letter))
        LetterKeys(self)


@pytest.fixture
def lists(shown):
    return shown(Lists(), 500, 400)


@pytest.mark.parametrize("part", ["box", "list", "docked"])
@pytest.mark.parametrize("reason", [Qt.FocusReason.TabFocusReason, Qt.FocusReason.MouseFocusReason])
def test_letters_change_nothing_and_trigger_shortcuts(lists, part, reason):
    widget = getattr(lists, part)
    widget.setFocus(reason)
    QTest.keyClicks(widget, "stSndg1")  # n, d and g are no shortcuts
    row = widget.currentRow() if part == "list" else widget.currentIndex()
    assert row == 0
    assert lists.pressed == ["S", "T", "S", "1"]


def test_arrows_and_space_work_in_lists(lists):
    lists.box.setFocus()
    QTest.keyClick(lists.box, Qt.Key.Key_Down)
    assert lists.box.currentIndex() == 1
    QTest.keyClick(lists.box, Qt.Key.Key_Space)
    assert lists.box.view().isVisible()
    lists.box.hidePopup()
    lists.list.setFocus()
    QTest.keyClick(lists.list, Qt.Key.Key_Down)
    assert lists.list.currentRow() == 1


def test_text_fields_receive_letters_and_numbers(lists):
    lists.editable.setFocus()
    lists.editable.lineEdit().selectAll()
    QTest.keyClicks(lists.editable, "slm")
    lists.number.setFocus()
    lists.number.selectAll()
    QTest.keyClicks(lists.number, "11")
    assert (lists.editable.currentText(), lists.number.value(), lists.pressed) == ("slm", 11, [])
