"""Letters in combo boxes, lists and tables of a window of which single letters are shortcuts."""

import gc

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QComboBox,
    QDockWidget,
    QLineEdit,
    QListWidget,
    QMainWindow,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.shell.key_filters import FocusAfterReturn, LetterKeys
from tests.app.driving import named, type_text

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
    type_text(lists.number, "11")
    assert (lists.editable.currentText(), lists.number.value(), lists.pressed) == ("slm", 11, [])


# After Return in a field, the keys of the view work.


class Fields(QWidget):
    """Window with fields and a view."""

    def __init__(self):
        super().__init__()
        self.line, self.number, self.view = QLineEdit(), QSpinBox(), QWidget()
        self.view.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        layout = QVBoxLayout(self)
        for part in (self.line, self.number, self.view):
            layout.addWidget(part)
        FocusAfterReturn(self, lambda: self.view)


def test_return_ends_typing(shown):
    fields = shown(Fields(), 200, 200)
    for field in (fields.line, fields.number):
        field.setFocus()
        QTest.keyClicks(field, "7")
        assert QApplication.focusWidget() is field
        QTest.keyClick(field, Qt.Key.Key_Return)
        assert QApplication.focusWidget() is fields.view
    assert fields.line.text() == "7"
    assert "7" in fields.number.text()


def test_letters_cut_after_a_number_was_typed(window):
    window.show_panel("run")
    steps = named(window.features["smooth"].panel, QSpinBox, "Iterations per step")
    steps.setFocus()
    QTest.keyClick(steps, Qt.Key.Key_Return)
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_C)
    window.refresh()
    assert window.session.view.look.cut.active


@pytest.mark.slow
def test_a_window_that_is_collected_hears_of_no_focus(qtbot):
    """Its filter may be there still while the window, which is part of a cycle, moves the focus."""
    for number in range(30):
        fields = Fields()
        fields.itself = fields
        fields.show()
        fields.activateWindow()
        fields.line.setFocus()
        QApplication.processEvents()
        del fields
        if number % 3 == 0:
            gc.collect()
        QApplication.processEvents()
    gc.collect()
    QApplication.processEvents()  # what a slot raises fails the test
