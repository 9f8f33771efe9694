"""Commands found by name."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from hexmend_app.shell.palette import CommandPalette


@pytest.fixture
def palette(qtbot):
    done = []
    actions = []
    for text, help, enabled in (
        ("&Fit", "Show the whole mesh.", True),
        ("Along &X", "Look along the X axis.", True),
        ("Along &Y", "Look along the Y axis.", True),
        ("&Undo", "Take back the last change.", False),
    ):
        action = QAction(text)
        action.setStatusTip(help)
        action.setEnabled(enabled)
        action.triggered.connect(lambda _, text=text: done.append(text.replace("&", "")))
        actions.append(action)
    widget = CommandPalette(actions)
    qtbot.addWidget(widget)
    widget.actions_kept = actions
    widget.carried_out = done
    widget.open()
    return widget


def field(palette):
    return palette.findChild(QLineEdit)


def test_all_commands_that_can_be_carried_out_are_listed(palette):
    assert palette.found() == ["Fit", "Along X", "Along Y"]


def test_letters_in_any_order_find_it_and_enter_carries_it_out(palette):
    QTest.keyClicks(field(palette), "y alo")
    assert palette.found() == ["Along Y"]
    QTest.keyClick(field(palette), Qt.Key.Key_Return)
    assert palette.carried_out == ["Along Y"]
    assert not palette.isVisible()


def test_arrow_keys_walk_while_one_types(palette):
    QTest.keyClicks(field(palette), "along")
    QTest.keyClick(field(palette), Qt.Key.Key_Down)
    QTest.keyClick(field(palette), Qt.Key.Key_Return)
    assert palette.carried_out == ["Along Y"]


def test_what_is_not_there_is_said_and_nothing_is_carried_out(palette):
    QTest.keyClicks(field(palette), "nonsense")
    assert palette.found() == []
    QTest.keyClick(field(palette), Qt.Key.Key_Return)
    assert palette.carried_out == []
    assert palette.isVisible()
    QTest.keyClick(palette, Qt.Key.Key_Escape)
    assert not palette.isVisible()
