"""The command palette."""

from functools import partial

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QMainWindow, QWidget

from hexmend import METHODS, METRICS
from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.shell.command_palette import (
    CommandPalette,
    choice_entries,
    command_entries,
    entry,
    name_of,
    panel_entries,
    ranked,
    title_of,
)
from hexmend_app.shell.panels.docks import Docks
from tests.core.grids import grid


@pytest.fixture
def palette(qtbot):
    executed = []
    widget = CommandPalette(
        entry(name, partial(executed.append, name), help)
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
    film = entry("Film", partial(executed.append, 1))
    film.setEnabled(False)
    palette = CommandPalette([film])
    qtbot.addWidget(palette)
    palette.open()
    QTest.keyClicks(field(palette), "film")
    assert palette.titles() == ["Film"]
    QTest.keyClick(field(palette), Qt.Key.Key_Return)
    assert palette.isVisible()
    assert not executed


# Ranking of the entries of the command palette for a typed text.


@pytest.fixture
def entries(qapp):
    return [
        entry(name, print, help, kind)
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


RANKED = [
    ("undo", ["Undo", "Reset", "Redo"]),
    ("mend", ["Mend", "Recommended smoothing"]),
    ("lap", ["Smart Laplacian"]),
    ("jac colour", ["Scaled Jacobian"]),
    ("run", ["Run or pause", "Tolerance"]),
    ("as mesh", ["Save mesh as…", "Undo"]),
    ("method", ["Mend", "Smart Laplacian", "Run or pause"]),
    ("  UNDO ", ["Undo", "Reset", "Redo"]),
    ("untangle", ["Mend", "Recommended smoothing"]),
    ("nonsense", []),
]


@pytest.mark.parametrize(("text", "names"), RANKED)
def test_matches_in_names_rank_before_matches_in_help(entries, text, names):
    assert [name_of(one) for one in ranked(entries, text)] == names


def test_an_empty_text_keeps_the_order(entries):
    assert ranked(entries, " ") == entries


def test_commands_that_cannot_be_run_now_come_last_and_only_for_a_text(entries):
    film = entry("Save film…", print, "Save the run as an animation.")
    film.setEnabled(False)
    assert ranked([film, *entries], "") == entries
    assert ranked([film, *entries], "animation") == [film]
    assert [name_of(one) for one in ranked([film, *entries], "save")] == ["Save mesh as…", "Save film…"]


# Entries of the command palette.


@pytest.fixture
def host(hosted):
    return hosted(grid(3))


def test_panels_have_entries_that_show_them(shown):
    panels = [Panel(id=id, title=id.title(), widget=QWidget(), place=PanelPlace.TOOLS) for id in ("boxes", "other")]
    main = QMainWindow()
    docks = Docks(main)
    docks.add(panels)
    shown(main, 900, 500)
    entries = {title_of(one): one for one in panel_entries(docks, panels)}
    assert list(entries) == ["Panel: Boxes", "Panel: Other"]
    entries["Panel: Other"].trigger()
    assert docks.is_visible("other")


def test_choosing_a_method_keeps_its_last_parameters(host):
    run_setup = host.session.run_setup
    entries = {title_of(one): one for one in choice_entries(host.session)}
    for method in METHODS.values():
        entries[f"Method: {method.title}"].trigger()
        assert run_setup.method == method.name
        assert run_setup.smoother == run_setup.smoother_of(method.name)
        assert method.title in run_setup.reason


def test_choosing_a_metric_colours_by_it(host, qtbot):
    entries = {title_of(one): one for one in choice_entries(host.session)}
    for metric in (*METRICS.values(), *DISPLACEMENT_QUANTITIES.values()):
        with qtbot.waitSignal(host.session.view.metric_wanted) as signal:
            entries[f"Colour by: {metric.title}"].trigger()
        assert signal.args == [metric.name]


def test_commands_have_entries_which_say_what_is_enabled_and_those_that_open_panels_have_none(qtbot):
    executed, actions = [], {}
    for id, enabled in (("fit", True), ("undo", False), ("panel_run", True), ("edges", True)):
        actions[id] = QAction(f"&{id.title()}")
        actions[id].setEnabled(enabled)
        actions[id].triggered.connect(lambda _=False, id=id: executed.append(id))
    actions["edges"].setCheckable(True)
    entries = list(command_entries(actions))
    assert [title_of(one) for one in entries if one.isEnabled()] == ["Fit", "Edges: off"]
    assert [title_of(one) for one in entries if not one.isEnabled()] == ["Undo"]
    entries[0].trigger()
    assert executed == ["fit"]
