"""Undo and redo in the window, by keys."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import click, key, phase
from tests.patience import PATIENCE

CONTROL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


def test_keys_undo_and_redo_a_run(window, qtbot):
    start = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    after = window.session.document.now
    assert after is not start
    key(window, Qt.Key.Key_Z, CONTROL)
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
    key(window, Qt.Key.Key_Z, CONTROL, SHIFT)
    assert window.session.document.now is after


@pytest.mark.slow
def test_the_menu_names_the_change_that_is_undone(window):
    undo, redo = window.action("undo"), window.action("redo")
    assert not undo.isEnabled()
    assert not redo.isEnabled()
    window.session.commands.tag("bad", [7])
    window.refresh()
    assert undo.isEnabled()
    assert undo.text() == "&Undo tag"
    undo.trigger()
    window.refresh()
    assert not undo.isEnabled()
    assert redo.text() == "&Redo tag"
    redo.trigger()
    assert list(window.session.document.now.mesh.hex_sets) == ["bad"]
