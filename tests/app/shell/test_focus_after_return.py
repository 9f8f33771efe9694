"""After Return in a field, the keys of the view work."""

import gc

from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QSpinBox, QVBoxLayout, QWidget

from hexmend_app.shell.focus_after_return import FocusAfterReturn
from tests.app.driving import named


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
