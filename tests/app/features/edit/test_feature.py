"""Undo and redo in the window, by keys."""

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QToolButton

from tests.app.driving import key, named, run_to_end

CONTROL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


def test_before_shows_the_mesh_before_the_run_while_its_button_is_held_and_y_switches(window, qtbot):
    document = window.session.document
    start = document.now
    button = named(window, QToolButton, "Show before")
    assert not button.isEnabled()
    run_to_end(window, qtbot, "laplacian", max_iterations=2)
    result = document.now
    qtbot.waitUntil(button.isEnabled)
    qtbot.mousePress(button, Qt.MouseButton.LeftButton)
    assert document.now is start
    qtbot.mouseRelease(button, Qt.MouseButton.LeftButton)
    assert document.now is result
    for shown in (start, result):
        key(window, Qt.Key.Key_Y)
        assert document.now is shown
    key(window, Qt.Key.Key_Y)
    window.refresh()
    assert button.isDown()
    window.session.commands.tag("bad", [0])  # a change is made to the mesh after the run
    assert document.now.mesh.points is result.mesh.points
