"""Undo and redo in the window, by keys."""

import numpy as np
from PySide6.QtCore import Qt

from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import click_until, key

CONTROL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


def test_keys_undo_and_redo_a_run(window, qtbot):
    start = window.session.document.now
    click_until(window, qtbot, "Step", Phase.PAUSED)
    click_until(window, qtbot, "Stop", Phase.FINISHED)
    after = window.session.document.now
    assert after is not start
    key(window, Qt.Key.Key_Z, CONTROL)
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
    key(window, Qt.Key.Key_Z, CONTROL, SHIFT)
    assert window.session.document.now is after
