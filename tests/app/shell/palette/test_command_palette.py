"""Commands found by name."""

from functools import partial

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from hexmend_app.shell.palette.command_palette import CommandPalette
from hexmend_app.shell.palette.ranking import PaletteEntry


@pytest.fixture
def palette(qtbot):
    done = []
    widget = CommandPalette(
        PaletteEntry(name=name, help=help, do=partial(done.append, name))
        for name, help in (
            ("Fit", "Show the whole mesh."),
            ("Along X", "Look along the X axis."),
            ("Along Y", "Look along the Y axis."),
        )
    )
    qtbot.addWidget(widget)
    widget.carried_out = done
    widget.open()
    return widget


def field(palette):
    return palette.findChild(QLineEdit)


def test_all_are_listed_at_first(palette):
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
