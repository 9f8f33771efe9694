"""Node debugger in the window, by mouse and keys: the step of a node."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from hexmend.smoothers import METHODS
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.visibility import Isolate
from hexmend_app.state.node_step import explain
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.palette import DESCENT, SEARCH
from tests.app.driving import LEFT, choose, choose_by_keys, click, key, named, phase, pixels, tick
from tests.app.features.node_step.step_display import (
    button,
    count_pixels,
    patch_box,
    shown_step,
    texts,
    wait_for_step,
    wait_for_text,
)
from tests.patience import PATIENCE

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
def test_links_select_nodes_and_a_change_of_method_updates_the_step(node_window, qtbot):
    window = node_window
    label = named(window.features["node_step"].panel, QLabel, "Free nodes")
    mesh, before = window.session.document.now.mesh, window.session.selection.node
    other = next(int(i) for i in mesh.hexes[window.session.selection.hex] if mesh.free[i] and i != before)
    assert f'href="{other}"' in label.text()
    label.setFocus()
    for _ in range(8):
        if window.session.selection.node == other:
            break
        QTest.keyClick(label, Qt.Key.Key_Tab)
        QTest.keyClick(label, Qt.Key.Key_Return)
        window.refresh()
    assert window.session.selection.node != before
    wait_for_step(window, qtbot, "local-sd")
    choose_by_keys(window, "local-mnr")
    step = wait_for_step(window, qtbot, "local-mnr")
    assert "Shift" in texts(window)
    window.features["smooth"].panel.stage.parameters.set_values({"p": 3.0})
    window.features["smooth"].panel.stage.parameters.changed.emit()
    qtbot.waitUntil(lambda: shown_step(window).norm.p == 3, timeout=PATIENCE)
    assert shown_step(window).energy != step.energy


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


@pytest.mark.slow
def test_no_step_is_shown_during_a_run_and_none_is_made_while_it_is_paused(node_window, qtbot):
    window = node_window
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    wait_for_step(window, qtbot, "local-sd")
    assert not button(window, "Next node").isEnabled()
    assert "paused" in button(window, "Next node").toolTip()
    now = window.session.document.now
    key(window, Qt.Key.Key_F11)
    assert window.session.document.now is now
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    qtbot.waitUntil(button(window, "Next node").isEnabled, timeout=PATIENCE)
    choose_by_keys(window, "local-sd")
    with qtbot.waitSignal(window.session.run.phase_changed, timeout=PATIENCE):
        click(window, "Run")
    window.refresh()
    if window.session.run.phase in (Phase.RUNNING, Phase.PREPARING):
        assert "A run is in progress" in texts(window)
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)


# Display


@pytest.mark.slow
def test_the_patch_is_isolated_and_its_marks_are_visible_with_any_cut_and_in_pictures(node_window, qtbot, tmp_path):
    window = node_window
    box = patch_box(window)
    tick(box)
    step = shown_step(window)
    assert window.session.view.look.show.isolate == Isolate(tuple(step.hexes.tolist()), 0)
    assert window.canvas.viewport.shown == step.hexes.size
    qtbot.waitUntil(lambda: not window.canvas.camera_animation.active, timeout=PATIENCE)

    assert min(count_pixels(pixels(window), role) for role in (DESCENT, SEARCH)) > 20
    window.session.view.set_cut(Cut.at((1, 0, 0), tuple(step.before - 100.0)))
    window.session.view.set_handles(False)
    window.refresh()
    assert window.canvas.viewport.shown == 0
    assert count_pixels(pixels(window), DESCENT) > 20
    assert window.features["save"].picture(tmp_path / "step.png", (800, 600))
    assert count_pixels(np.asarray(Image.open(tmp_path / "step.png").convert("RGB")).astype(int), DESCENT) > 20
    window.messages.clear()  # Esc closes messages first
    qtbot.waitUntil(lambda: window.window_actions["back"].isEnabled(), timeout=PATIENCE)
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.show.isolate is None
    assert not box.isChecked()
    window.session.selection.choose(None)
    qtbot.waitUntil(lambda: shown_step(window) is None, timeout=PATIENCE)
    assert count_pixels(pixels(window), DESCENT) == 0
