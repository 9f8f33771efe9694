"""Typing in lists of a window of which single letters are keys."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QListWidget, QSpinBox, QTableView, QVBoxLayout, QWidget

from hexmend_app.shell.palette.type_to_find import TypeToFind
from tests.app.driving import LEFT, named

WORDS = ["Laplacian", "Mend", "Steepest descent", "Truss"]


class Lists(QWidget):
    """Window with lists and single-letter shortcuts, which records the shortcuts used."""

    def __init__(self):
        super().__init__()
        self.box, self.list, self.number = QComboBox(), QListWidget(), QSpinBox()
        self.other = QComboBox()
        layout = QVBoxLayout(self)
        for part in (self.box, self.other, self.list, self.number):
            layout.addWidget(part)
        for part in (self.box, self.other, self.list):
            part.addItems(WORDS)
        self.pressed = []
        for letter in "LMNST1":
            QShortcut(QKeySequence(letter), self, lambda letter=letter: self.pressed.append(letter))
        QShortcut(QKeySequence("Ctrl+S"), self, lambda: self.pressed.append("Ctrl+S"))
        TypeToFind(self)


@pytest.fixture
def lists(shown):
    return shown(Lists(), 300, 400)


def choose_by_mouse(box, at, qtbot):
    """Open a combo box and choose an entry by mouse."""
    QTest.mouseClick(box, LEFT)
    view = box.view()
    qtbot.waitUntil(view.isVisible)
    # Qt ignores a second click that follows the first one quickly.
    qtbot.waitUntil(lambda: _clicked(view, at) or not view.isVisible(), timeout=5000)
    assert box.currentIndex() == at


def _clicked(view, at):
    QTest.mouseClick(view.viewport(), LEFT, pos=view.visualRect(view.model().index(at, 0)).center())
    return not view.isVisible()


@pytest.mark.parametrize("typed", ["s", "S"])
def test_a_letter_typed_in_a_combo_box_finds_an_entry(lists, typed):
    lists.box.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClicks(lists.box, typed)
    assert lists.box.currentText() == "Steepest descent"
    assert lists.pressed == []


def test_typing_in_a_combo_box_triggers_no_shortcuts(lists):
    lists.box.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClicks(lists.box, "trussnl1")
    assert lists.box.currentText() == "Truss"
    assert lists.pressed == []


def test_keys_other_than_letters_trigger_shortcuts(lists):
    lists.box.setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(lists.box, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    assert lists.pressed == ["Ctrl+S"]


def test_letters_trigger_shortcuts_after_a_choice_by_mouse(lists, qtbot):
    QTest.mouseClick(lists.box, LEFT)
    qtbot.waitUntil(lists.box.view().isVisible)
    QTest.keyClicks(QApplication.focusWidget(), "t")
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_Return)
    assert lists.box.currentText() == "Truss"
    assert lists.pressed == []
    choose_by_mouse(lists.other, 1, qtbot)
    QTest.keyClicks(lists.other, "s")
    assert (lists.other.currentText(), lists.pressed) == ("Mend", ["S"])
    QTest.keyClick(lists.other, Qt.Key.Key_Up)  # now the combo box is used by keyboard
    QTest.keyClicks(lists.other, "s")
    assert (lists.other.currentText(), lists.pressed) == ("Steepest descent", ["S"])


def test_a_list_receives_letters_that_match_an_entry(lists):
    lists.list.setCurrentRow(0)
    lists.list.setFocus()
    QTest.keyClicks(lists.list, "m")
    assert lists.list.currentItem().text() == "Mend"
    QTest.keyClicks(lists.list, "n")
    assert lists.pressed == ["N"]


def test_elsewhere_letters_trigger_shortcuts_and_digits_edit_numbers(lists):
    lists.number.setFocus()
    lists.number.selectAll()
    QTest.keyClicks(lists.number, "11")
    assert (lists.number.value(), lists.pressed) == (11, [])
    lists.setFocus()
    QTest.keyClicks(lists, "ls")
    assert lists.pressed == ["L", "S"]


@pytest.mark.slow
def test_typing_finds_a_method_and_n_selects_the_next_worst_hex(window):
    box = named(window.features["smooth"].panel, QComboBox, "Method")
    box.setFocus(Qt.FocusReason.TabFocusReason)
    structure = window.session.view.look.structure
    QTest.keyClicks(box, "smart")
    window.refresh()
    assert window.session.run_setup.method == "smart-laplacian"
    assert window.session.view.look.structure == structure
    window.show_panel("worst")
    table = window.features["hex_inspector"].worst_list.findChild(QTableView)
    table.setFocus()
    table.setCurrentIndex(table.model().index(0, 0))
    QTest.keyClick(table, Qt.Key.Key_N)
    assert window.session.selection.hex == window.features["hex_inspector"].worst_list.hexes[1]
