"""The console: commands run in a thread and change the mesh as an edit."""

import numpy as np
import pytest
from PySide6.QtCore import Qt


@pytest.fixture
def console(window, qtbot):
    """Return the console of the window, with a function that enters a command and waits for it."""
    console = window.features["reproduce"].panel.console
    window.action("reproduce").trigger()
    console.output.clear()

    def enter(source):
        qtbot.keyClicks(console.line, source)
        qtbot.keyClick(console.line, Qt.Key.Key_Return)
        qtbot.waitUntil(lambda: not console.running)
        return console.output.toPlainText()

    console.enter_and_wait = enter
    return console


def test_it_opens_and_evaluates(window, console):
    assert window.is_visible("reproduce")
    mesh = window.session.document.now.mesh
    assert f"\n{mesh.n_hexes}" in console.enter_and_wait("mesh.n_hexes")
    assert "\n'hexmend'" in console.enter_and_wait("hx.__name__")
    assert "None" not in console.enter_and_wait("result")
    assert f"\n{mesh.n_hexes} lines" in console.enter_and_wait("print(quality.q.size, 'lines')")
    assert "SystemExit" in console.enter_and_wait("raise SystemExit")
    text = console.enter_and_wait("1 / 0")
    assert "ZeroDivisionError" in text
    assert '"<console>", line 1' in text
    assert "console.py" not in text


def test_assigning_to_mesh_is_an_undoable_edit(window, console):
    document = window.session.document
    before = document.now
    console.enter_and_wait("mesh = mesh.with_points(2 * mesh.points)")
    assert np.allclose(document.now.mesh.points, 2 * before.mesh.points)
    assert document.undo_title == "console"
    assert "True" in console.enter_and_wait("bool(mesh.points.max() > 0)")
    window.session.commands.undo()
    assert document.now is before
    window.session.commands.redo()
    window.session.commands.undo()
    assert "expected mesh to be a hexmend Mesh" in console.enter_and_wait("mesh = 3")
    assert document.now is before


def test_another_topology_is_drawn_and_undone(window, console):
    document, before = window.session.document, window.session.document.now
    console.enter_and_wait("mesh = hx.gallery.make('cube', size=64)")
    assert document.now.mesh.n_hexes == 64
    window.refresh()
    assert window.canvas.viewport.frame.mesh is document.now.mesh
    window.session.commands.undo()
    assert document.now is before
    window.refresh()


def test_blocks_and_history(window, console, qtbot):
    line = console.line
    console.enter_and_wait("for i in range(2):")
    console.enter_and_wait("    print(7 + i)")
    assert "\n7\n8" in console.enter_and_wait("")
    qtbot.keyClick(line, Qt.Key.Key_Up)
    qtbot.keyClick(line, Qt.Key.Key_Up)
    assert line.text() == "for i in range(2):"
    for _ in range(3):
        qtbot.keyClick(line, Qt.Key.Key_Down)
    assert line.text() == ""
