"""Undo and redo in the window, by keys."""

import numpy as np
from PySide6.QtCore import Qt

from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import click, key, phase

CONTROL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


def test_keys_undo_and_redo_a_run(window, qtbot):
    start = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    after = window.session.document.now
    assert after is not start
    key(window, Qt.Key.Key_Z, CONTROL)
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
    key(window, Qt.Key.Key_Z, CONTROL, SHIFT)
    assert window.session.document.now is after
