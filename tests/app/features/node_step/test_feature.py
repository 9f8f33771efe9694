"""Node debugger in the window, by mouse and keys: the step of a node."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from hexmend.smoothers import METHODS
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.visibility import Isolate
from hexmend_app.state.node_step import StepStatus, explain
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.palette import DESCENT, SEARCH
from tests.app.driving import LEFT, choose, choose_by_keys, click, key, phase, pixels, press, tick
from tests.app.features.node_step.step_display import (
    button,
    count_pixels,
    patch_box,
    shown_step,
    texts,
    wait_for_step,
    wait_for_text,
)

# One node


def test_a_key_explains_a_free_node_of_the_worst_hex(node_window):
    window, step = node_window, shown_step(node_window)
    mesh = window.session.document.now.mesh
    assert window.session.selection.hex == window.features["hex_inspector"].worst_list.hexes[0]
    assert window.session.selection.node in mesh.hexes[window.session.selection.hex]
    assert mesh.free[step.node]
    np.testing.assert_array_equal(step.after, explain(mesh, METHODS["local-sd"](), step.node).after)
    assert window.in_front("node")
    words = texts(window)
    assert f"Node {step.node:,}" in words
    assert "Local steepest descent. Will be moved." in words
    assert "Eigenvalues" in words
    assert window.session.document.now is window.session.document.start  # nothing has moved


@pytest.mark.slow
def test_a_fixed_node_has_no_step_and_the_reason_is_shown(window, qtbot):
    choose_by_keys(window, "local-sd")
    window.show_panel("node")
    wait_for_text(window, qtbot, "Click a hex in the view")
    QTest.mouseClick(window.canvas.interactor, LEFT, pos=window.canvas.interactor.rect().center())
    assert window.session.selection.hex is not None
    assert window.in_front("node")  # a click does not bring another panel to the front
    wait_for_text(window, qtbot, "is on the boundary: no method moves it")
    choose(window, "local-sd", boundary="slide")
    wait_for_text(window, qtbot, "is on the sliding boundary: only steps of interior nodes are shown")
    choose(window, "local-sd")
    assert shown_step(window) is None
    mesh = window.session.document.now.mesh
    inner = int(np.flatnonzero(mesh.free)[50])
    window.session.selection.choose(int(mesh.topology.node_corners[inner][0] // 8), inner)
    wait_for_step(window, qtbot, "local-sd", inner)
    window.session.commands.pin(inner, True)
    wait_for_text(window, qtbot, "is pinned: no method moves it")
    assert shown_step(window) is None


# Display


@pytest.mark.slow
def test_the_patch_is_isolated_and_its_marks_are_visible_with_any_cut(node_window, qtbot):
    window = node_window
    tick(patch_box(window))
    step = shown_step(window)
    assert window.session.view.look.show.isolate == Isolate(tuple(step.hexes.tolist()), 0)
    assert window.canvas.viewport.shown == step.hexes.size
    qtbot.waitUntil(lambda: not window.canvas.camera_animation.active)
    assert min(count_pixels(pixels(window), role) for role in (DESCENT, SEARCH)) > 20
    window.session.view.set_cut(Cut.at((1, 0, 0), tuple(step.before - 100.0)))
    window.session.view.set_handles(False)
    window.refresh()
    assert window.canvas.viewport.shown == 0
    assert count_pixels(pixels(window), DESCENT) > 20


# Sweep of a local method, run node by node in the window, by mouse and keys.


@pytest.mark.slow
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


@pytest.mark.slow
@pytest.mark.parametrize("change", ["run", "method"])
def test_any_other_change_of_the_mesh_ends_the_sweep_first(node_window, qtbot, change):
    window = node_window
    key(window, Qt.Key.Key_F11)
    key(window, Qt.Key.Key_F11)
    stepped = window.session.document.now
    if change == "run":
        choose_by_keys(window, "laplacian")
        click(window, "Step")
        qtbot.waitUntil(phase(window, Phase.PAUSED))
        click(window, "Stop")
        qtbot.waitUntil(phase(window, Phase.FINISHED))
        window.session.commands.undo()
    else:
        choose_by_keys(window, "local-nr")
        wait_for_step(window, qtbot, "local-nr")
        key(window, Qt.Key.Key_F11)
        assert window.session.node_sweep.sweep.done == 1
        window.session.commands.undo()
    assert window.session.document.undo_title == "sweep of local-sd, 2 nodes"
    np.testing.assert_array_equal(window.session.document.now.mesh.points, stepped.mesh.points)
