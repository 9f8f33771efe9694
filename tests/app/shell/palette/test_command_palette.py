"""The command palette."""

from functools import partial

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from hexmend_app.shell.palette.command_palette import CommandPalette
from hexmend_app.shell.palette.ranking import PaletteEntry, ranked


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


# Ranking of the entries of the command palette for a typed text.


ENTRIES = [
    PaletteEntry(name=name, run=print, help=help, kind=kind)
    for name, help, kind in (
        ("Reset", "Put all nodes back; undo takes that back too.", ""),
        ("Redo", "Do again what undo took back.", ""),
        ("Undo", "Take back the last change of the mesh.", ""),
        ("Run or pause", "Run the chosen method.", ""),
        ("Save mesh as…", "", ""),
        ("Mend", "Untangles.", "Method"),
        ("Smart Laplacian", "", "Method"),
        ("Recommended smoothing", "Mends.", ""),
        ("Scaled Jacobian", "", "Colour by"),
        ("Tolerance", "Where it stops.", "In Run"),
    )
]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("undo", ["Undo", "Reset", "Redo"]),
        ("mend", ["Mend", "Recommended smoothing"]),
        ("lap", ["Smart Laplacian"]),
        ("jac colour", ["Scaled Jacobian"]),
        ("run", ["Run or pause", "Tolerance"]),
        ("as mesh", ["Save mesh as…", "Undo"]),
        ("method", ["Mend", "Smart Laplacian", "Run or pause"]),
        ("  UNDO ", ["Undo", "Reset", "Redo"]),
        ("nonsense", []),
    ],
)
def test_matches_in_names_rank_before_matches_in_help(text, names):
    assert [entry.name for entry in ranked(ENTRIES, text)] == names


def test_an_empty_text_keeps_the_order():
    assert ranked(ENTRIES, " ") == ENTRIES


def test_commands_that_cannot_be_run_now_come_last_and_only_for_a_text():
    film = PaletteEntry(name="Save film…", run=print, help="Save the run as an animation.", enabled=False)
    assert ranked([film, *ENTRIES], "") == ENTRIES
    assert ranked([film, *ENTRIES], "animation") == [film]
    assert [entry.name for entry in ranked([film, *ENTRIES], "save")] == ["Save mesh as…", "Save film…"]
