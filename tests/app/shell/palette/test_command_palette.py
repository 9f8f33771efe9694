"""The command palette."""

from functools import partial

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from hexmend_app.shell.palette.command_palette import CommandPalette
from hexmend_app.shell.palette.ranking import PaletteEntry


@pytest.fixture
def palette(qtbot):
    executed = []
    widget = CommandPalette(
        PaletteEntry(name=name, help=help, run=partial(executed.append, name))
        for name, help in (
            ("Fit", "Show the whole mesh."),
            ("Along X", "Look along the X axis."),
            ("Along Y", "Look along the Y axis."),
        )
    )
    qtbot.addWidget(widget)
    widget.executed = executed
    widget.open()
    return widget


def field(palette):
    return palette.findChild(QLineEdit)


def test_parts_of_a_name_in_any_order_match_and_enter_runs_the_command(palette):
    QTest.keyClicks(field(palette), "y alo")
    assert palette.titles() == ["Along Y"]
    QTest.keyClick(field(palette), Qt.Key.Key_Return)
    assert palette.executed == ["Along Y"]
    assert not palette.isVisible()


def test_arrow_keys_move_in_the_list_while_the_field_has_the_focus(palette):
    QTest.keyClicks(field(palette), "along")
    QTest.keyClick(field(palette), Qt.Key.Key_Down)
    QTest.keyClick(field(palette), Qt.Key.Key_Return)
    assert palette.executed == ["Along Y"]


def test_a_command_that_cannot_be_run_now_is_listed_and_not_run(qtbot):
    executed = []
    palette = CommandPalette([PaletteEntry(name="Film", run=partial(executed.append, 1), enabled=False)])
    qtbot.addWidget(palette)
    palette.open()
    QTest.keyClicks(field(palette), "film")
    assert palette.titles() == ["Film"]
    QTest.keyClick(field(palette), Qt.Key.Key_Return)
    assert palette.isVisible()
    assert not executed
