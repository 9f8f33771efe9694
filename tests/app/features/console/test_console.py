"""The console: commands run in a thread, change the mesh as an edit, and can be interrupted."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend_app.features.console.interpreter import is_complete
from hexmend_app.features.console.panel import ConsolePanel


@pytest.fixture
def console(window, qtbot):
    """Return the console of the window, with a function that enters a command and waits for it."""
    feature = window.features["console"]
    window.action("console").trigger()
    feature.panel.output.clear()

    def enter(source):
        qtbot.keyClicks(feature.panel.input, source)
        qtbot.keyClick(feature.panel.input, Qt.Key.Key_Return)
        qtbot.waitUntil(lambda: not feature.running)
        return feature.panel.output.toPlainText()

    feature.enter_and_wait = enter
    return feature


def test_it_opens_and_evaluates(window, console):
    assert window.in_front("console")
    mesh = window.session.document.now.mesh
    assert f"\n{mesh.n_hexes}\n" in console.enter_and_wait("mesh.n_hexes")
    assert "\n'hexmend'\n" in console.enter_and_wait("hx.__name__")
    assert "None" not in console.enter_and_wait("result")
    assert f"\n{mesh.n_hexes} lines" in console.enter_and_wait("print(quality.q.size, 'lines')")
    assert "SystemExit" in console.enter_and_wait("raise SystemExit")
    text = console.enter_and_wait("1 / 0")
    assert "ZeroDivisionError" in text
    assert "1 / 0" in text.split("Traceback")[1]
    assert "interpreter.py" not in text


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


@pytest.mark.slow
def test_an_endless_loop_can_be_interrupted(window, console, qtbot):
    qtbot.keyClicks(console.panel.input, r"exec('print(\'begun\')\nwhile True: pass')")
    qtbot.keyClick(console.panel.input, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: "\nbegun\n" in console.panel.output.toPlainText())
    assert console.running
    qtbot.keyClick(console.panel.input, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: not console.running)
    assert "KeyboardInterrupt" in console.panel.output.toPlainText()
    assert "\n2\n" in console.enter_and_wait("1 + 1")


@pytest.mark.slow
def test_an_endless_print_is_shown_and_interrupted(console, qtbot):
    console.run("while True: print('again')")
    qtbot.waitUntil(lambda: console.panel.output.blockCount() > 1000)
    console.interrupt()
    qtbot.waitUntil(lambda: not console.running)
    assert "KeyboardInterrupt" in console.panel.output.toPlainText()


def test_lines_history_and_completion(window, console, qtbot):
    panel = console.panel
    qtbot.keyClicks(panel.input, "for i in range(2):")
    qtbot.keyClick(panel.input, Qt.Key.Key_Return)
    qtbot.keyClicks(panel.input, "print(7 + i)")
    qtbot.keyClick(panel.input, Qt.Key.Key_Return)
    assert not console.running
    assert "\n7\n8" in console.enter_and_wait("")
    qtbot.keyClick(panel.input, Qt.Key.Key_Up)
    assert panel.input.toPlainText().startswith("for i in range(2):")
    qtbot.keyClick(panel.input, Qt.Key.Key_Down)
    qtbot.keyClick(panel.input, Qt.Key.Key_Down)
    assert panel.input.toPlainText() == ""
    qtbot.keyClicks(panel.input, "mesh.n_hex")
    qtbot.keyClick(panel.input, Qt.Key.Key_Tab)
    assert panel.input.toPlainText() == "mesh.n_hexes"
    panel.input.clear()


SOURCES = [
    ("1 + 1", True),
    ("x = (1,", False),
    ("def f():", False),
    ("def f():\n    return 1", False),
    ("def f():\n    return 1\n    ", True),
    ("a = 1\nb = 2", True),
    ("a b", True),
    ("", True),
]


@pytest.mark.parametrize(("source", "complete"), SOURCES)
def test_is_complete(source, complete):
    assert is_complete(source) == complete


def test_the_panel_keeps_a_colon_indented(shown, qtbot):
    panel = shown(ConsolePanel())
    panel.input.setPlainText("if x:")
    panel.input.moveCursor(panel.input.textCursor().MoveOperation.End)
    panel.new_line()
    assert panel.input.toPlainText() == "if x:\n    "
