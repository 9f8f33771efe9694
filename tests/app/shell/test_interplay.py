"""Interactions of features: another mesh, another cut or a run in the middle of an operation."""

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from hexmend import METHODS, Mesh, Stage, StoppingCriteria, io
from hexmend_app.feature import MENUS
from hexmend_app.picture import Box, Cut, Plane
from hexmend_app.shell import window as shell_window
from hexmend_app.shell.command_palette import SYNONYMS, choice_entries, command_entries, name_of, ranked
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.tasks.task import running
from scripts.write_keys import as_markdown
from tests.app.driving import LEFT, key, move, open_mesh, pixels
from tests.app.features.cut.test_cut import seen_at
from tests.core.grids import grid, scrambled

pytestmark = pytest.mark.slow


def middle(window):
    return tuple(window.session.document.now.mesh.points.mean(axis=0))


def test_nothing_changes_the_mesh_while_another_is_read(window, qtbot, tmp_path):
    io.write(tmp_path / "small.vtu", scrambled(grid(3), 0.3))
    window.session.selection.choose(7)
    window.session.commands.tag("before", [7])
    with qtbot.waitSignal(window.session.opener.ended):
        window.features["open"].open(tmp_path / "small.vtu")
        before = window.session.document.now
        window.refresh()
        assert not any(window.window_actions[id].isEnabled() for id in ("run", "step", "reset", "undo"))
        assert not window.features["smooth"].panel.isEnabled()
        window.session.commands.run(Stage(METHODS["laplacian"](), StoppingCriteria()))
        window.session.commands.tag("late", [8])
        window.session.commands.undo()
        assert window.session.document.now is before
        assert not window.session.run.busy
    assert window.session.document.now is window.session.document.start
    assert window.session.document.now.mesh.n_hexes == 27
    window.refresh()
    assert window.window_actions["run"].isEnabled()
    assert window.features["smooth"].panel.isEnabled()


def test_the_box_can_be_dragged_again_after_an_interrupted_drag(window, qtbot):
    size = np.ptp(window.session.document.now.mesh.points, axis=0)
    low = window.session.document.now.mesh.points.min(axis=0)
    box = Cut(box=Box(tuple(low + 0.2 * size), tuple(low + 0.8 * size)))
    window.session.view.set_cut(box)
    pixels(window)
    view = window.canvas.interactor
    place = seen_at(window, (*(low + 0.5 * size)[:2], (low + 0.8 * size)[2]))
    move(view, place)
    QTest.mousePress(view, LEFT, pos=place)
    for k in range(1, 8):
        move(view, place + QPoint(0, 4 * k), LEFT)
    assert window.session.view.look.cut != box
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_C)
    QTest.mouseRelease(view, LEFT, pos=place)
    other = Cut(box=Box(tuple(low), tuple(low + 0.5 * size)))
    window.refresh()
    window.session.view.set_cut(other)
    window.refresh()
    np.testing.assert_allclose(window.canvas.box.corners, [other.box.low, other.box.high])
    window.session.view.set_cut(box)
    pixels(window)
    for k in range(6):
        move(view, place - QPoint(0, 4 * k))
    assert window.session.view.look.cut == box  # no button is held any more


def test_the_chosen_plane_is_still_the_one_after_the_cut_was_off_or_a_box(window):
    planes = tuple(Plane(tuple(normal.tolist()), point=middle(window)) for normal in np.eye(3))
    window.session.view.set_cut(Cut(planes))
    window.session.view.choose_plane(2)
    for other in (Cut(), Cut(box=Box((0, 0, 0), (1, 1, 1)))):
        window.session.view.set_cut(other)
        window.session.view.set_cut(Cut(planes))
        assert window.session.view.plane_at == 2
    window.session.view.set_cut(Cut(planes[:1]))
    assert window.session.view.plane_at == 0


def test_a_cut_begins_in_a_mesh_of_any_units_however_far_unused_nodes_are(window, qtbot, tmp_path):
    window.session.view.set_cut(Cut.at((0, 1, 0), middle(window)))
    mesh = scrambled(grid(3), 0.3)
    stray = Mesh(np.concatenate([mesh.points, [[1e4, 1e4, 1e4]]]), mesh.hexes)
    for opened in (mesh.with_points(1e-9 * mesh.points), mesh.with_points(1e9 * mesh.points), stray):
        open_mesh(qtbot, window, tmp_path / "mesh.vtu", opened)
        key(window, Qt.Key.Key_C)
        assert 0 < window.canvas.viewport.shown < mesh.n_hexes


# Features: their actions have a place and a help, and they are refreshed when what they show changes.


def test_every_action_has_a_known_menu_and_help(window):
    declared = list(window.menus.declared())
    assert {one.menu for one in declared} <= {"", *MENUS}
    for one in declared:
        assert one.help.endswith("."), one.id


def test_words_of_other_programs_find_a_command(window):
    entries = [*command_entries(window.window_actions), *choice_entries(window.session)]
    assert [word for word in SYNONYMS if not ranked(entries, word)] == []
    assert "picture" in name_of(ranked(entries, "screensh")[0]).lower()


def test_docs_keys_match_the_declared_actions(window):
    """`make docs` writes it."""
    page = Path(__file__).resolve().parents[3] / "docs" / "reference" / "keys.md"
    assert page.read_text(encoding="utf-8") == as_markdown(window.menus.declared())


def test_all_changes_in_a_turn_of_the_event_loop_cause_one_refresh(window, qtbot, monkeypatch):
    calls = []
    qtbot.waitUntil(lambda: not running())  # the end of a task causes a refresh too
    for _ in range(2):
        QApplication.processEvents()
    monkeypatch.setattr(window.features["help"], "refresh", lambda: calls.append(1))
    for _ in range(20):
        window.session.selection.changed.emit()
    assert calls == []
    qtbot.waitUntil(lambda: calls != [])
    assert calls == [1]


def test_an_iteration_is_drawn_at_once_and_panels_follow(window, qtbot, monkeypatch):
    calls, document, run = [], window.session.document, window.session.run
    monkeypatch.setattr(window.canvas, "draw", lambda frame, live: calls.append("view"))
    monkeypatch.setattr(window.features["help"], "refresh", lambda: calls.append("panels"))
    monkeypatch.setattr(run, "iterating", True)
    monkeypatch.setattr(shell_window, "_DELAY", 2_000)  # of the panels, which cannot follow meanwhile on a busy machine
    for _ in range(2):
        document.preview(MeasuredMesh.of(document.now.mesh))
        run.iterated.emit(None)
    assert calls == ["view", "view"]
    qtbot.waitUntil(lambda: len(calls) > 2)
    assert calls == ["view", "view", "panels"]
