"""Sweep of a local method, run node by node in the window, by mouse and keys."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend.smoothers import METHODS
from hexmend_app.state.node_step import StepStatus
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose_by_keys, click, key, phase, press
from tests.app.features.node_step.step_display import button, shown_step, texts, wait_for_step
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


def test_undo_reverts_a_sweep_as_one_change(node_window, qtbot):
    window = node_window
    start = window.session.document.now
    press(button(window, "Next node"))
    step = wait_for_step(window, qtbot, "local-sd")
    assert step.status is StepStatus.MOVED
    points = window.session.document.now.mesh.points
    np.testing.assert_array_equal(points[step.node], step.after)
    assert (points != start.mesh.points).any(axis=1).sum() == 1
    assert "Local steepest descent. Moved." in texts(window)
    assert "1 of" in texts(window)
    press(button(window, "10 nodes"))
    key(window, Qt.Key.Key_F11)
    assert window.session.node_sweep.sweep.done == 12
    assert window.session.document.undo_title is None
    assert window.window_actions["undo"].text() == "&Undo sweep of local-sd, 12 nodes"
    now = window.session.document.now
    key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.now is start
    assert window.session.node_sweep.sweep is None
    key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier)
    assert window.session.document.now is now
    assert window.session.document.undo_title == "sweep of local-sd, 12 nodes"


def test_a_finished_sweep_equals_one_iteration_of_the_method(node_window, qtbot):
    window = node_window
    mesh = window.session.document.now.mesh
    expected = next(itertools.islice(METHODS["local-sd"]().steps(mesh), 1, None)).points
    key(window, Qt.Key.Key_F11, Qt.KeyboardModifier.ShiftModifier)
    press(button(window, "Finish"))
    np.testing.assert_allclose(window.session.document.now.mesh.points, expected, rtol=0, atol=1e-13)
    assert window.session.node_sweep.sweep is None
    free = int(mesh.free.sum())
    assert window.session.document.undo_title == f"sweep of local-sd, {free:,} nodes"
    qtbot.waitUntil(lambda: shown_step(window).node == window.session.selection.node, timeout=PATIENCE)
    assert "Moved." in texts(window)


@pytest.mark.parametrize("change", ["run", "method", "reset"])
def test_any_other_change_of_the_mesh_ends_the_sweep_first(node_window, qtbot, change):
    window = node_window
    start = window.session.document.now
    key(window, Qt.Key.Key_F11)
    key(window, Qt.Key.Key_F11)
    stepped = window.session.document.now
    if change == "run":
        choose_by_keys(window, "laplacian")
        click(window, "Step")
        qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
        click(window, "Stop")
        qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
        window.session.commands.undo()
    elif change == "method":
        choose_by_keys(window, "local-nr")
        wait_for_step(window, qtbot, "local-nr")
        key(window, Qt.Key.Key_F11)
        assert window.session.node_sweep.sweep.done == 1
        window.session.commands.undo()
    else:
        window.session.commands.reset()
        np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
        window.session.commands.undo()
    assert window.session.document.undo_title == "sweep of local-sd, 2 nodes"
    np.testing.assert_array_equal(window.session.document.now.mesh.points, stepped.mesh.points)
