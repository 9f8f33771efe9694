"""Texts and plot of a node's step, without a window."""

import dataclasses

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from hexmend.smoothers import METHODS
from hexmend_app.features.node_step.feature import FeatureNodeStep
from hexmend_app.features.node_step.panel import NodePanel
from hexmend_app.features.node_step.step_plot import NodePlot, extent
from hexmend_app.features.node_step.step_texts import rows
from hexmend_app.picture import Cut, Isolate
from hexmend_app.state.node_step import StepStatus, Trial, explain
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.palette import DESCENT, SEARCH, TEXT, WORSE
from tests.app.driving import LEFT, button, choose, choose_by_keys, click_until, key, named, pixels, press
from tests.app.features.node_step.step_display import (
    count_pixels,
    drawn_trials,
    shown_step,
    texts,
    wait_for_step,
    wait_for_text,
)
from tests.app.hosting import action
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(3), 0.2, 5)
NODE = int(np.flatnonzero(MESH.free)[3])


def step_of(name, **values):
    return explain(MESH, METHODS[name](**values), NODE)


def row(step, name):
    return next(row for row in rows(step) if row.name == name)


def test_a_move_within_rounding_counts_as_none():
    step = step_of("local-sd")
    assert step.outcome is StepStatus.MOVED
    nudged = dataclasses.replace(step, after=step.before + 1e-17)
    assert nudged.outcome is StepStatus.AT_TARGET
    assert dataclasses.replace(nudged, status=StepStatus.REJECTED).outcome is StepStatus.REJECTED


def test_a_negative_eigenvalue_is_called_a_saddle():
    step = step_of("local-nr")
    assert "locally convex" in row(step, "Eigenvalues").meaning
    assert row(step, "Eigenvalues").colour is TEXT
    saddle = dataclasses.replace(step, hessian=np.diag([-2.0, 1.0, 3.0]), fallback=True)
    assert "1 negative, as on a saddle" in row(saddle, "Eigenvalues").meaning
    assert row(saddle, "Eigenvalues").value == "−2  1  3"
    assert row(saddle, "Eigenvalues").colour is WORSE
    assert "would lead uphill" in row(saddle, "Direction").meaning
    valley = dataclasses.replace(step, hessian=np.diag([1.0, 1.0, 300.0]))
    assert "narrow valley" in row(valley, "Eigenvalues").meaning


def test_infinite_energy_is_shown_as_text_and_not_plotted(shown):
    nothing = np.full(3, np.nan)
    step = dataclasses.replace(
        step_of("local-sd"), energy=np.inf, energy_after=np.inf, gradient=nothing, hessian=np.full((3, 3), np.nan),
        curve=np.empty((0, 2)), trials=(), alpha=0.0, status=StepStatus.INFINITE,
    )  # fmt: skip
    assert row(step, "Energy").value.startswith("∞")
    assert "Eigenvalues" not in [row.name for row in rows(step)]
    panel = shown(NodePanel(), 500, 260)
    panel.show_step(step, "Local steepest descent", done=False)
    assert not panel.plot.isVisible()
    assert "infinite" in named(panel, QLabel, "Outcome of the step").text()


def test_rounding_is_not_plotted_and_a_sentence_says_so(shown):
    step = step_of("local-nr")
    curve = step.curve.copy()
    curve[:, 1] = step.energy * (1 + 1e-15 * (-1.0) ** np.arange(len(curve)))
    gradient = 1e-17 * step.gradient
    panel = shown(NodePanel(), 500, 260)
    sentences = []
    for one in (step, dataclasses.replace(step, curve=curve, gradient=gradient)):
        panel.show_step(one, "Local Newton-Raphson", done=False)
        sentences.append([label.isVisible() for label in panel.findChildren(QLabel) if "No plot" in label.text()])
        assert panel.plot.isVisible() == (one is step)
    assert sentences == [[False], [True]]
    assert row(one, "Gradient |∇f|").value == "0"
    assert "no arrow is drawn" in row(one, "Gradient |∇f|").meaning
    assert "points downhill" in row(step, "Gradient |∇f|").meaning


def test_the_energy_may_rise_with_a_method_that_does_not_evaluate_it():
    step = step_of("laplacian")
    up = dataclasses.replace(step, energy_after=step.energy + 1)
    assert "does not evaluate it" in row(up, "Energy").meaning
    assert "rises" not in row(dataclasses.replace(step, energy_after=step.energy - 0.1), "Energy").meaning
    rounded = dataclasses.replace(step, energy_after=np.nextafter(step.energy, np.inf))
    assert "rises" not in row(rounded, "Energy").meaning
    assert "whole mesh" in row(step_of("global-sd"), "Energy").meaning


@pytest.mark.parametrize("name", ["local-sd", "local-nr", "global-sd", "laplacian", "getme"])
def test_start_and_end_are_in_the_range_of_the_plot(shown, name):
    step = step_of(name)
    low, high = extent(step)
    change = step.energy_after - step.energy
    assert low < 0 < high
    assert low < change < high
    assert np.isfinite([low, high]).all()


def test_trials_above_the_plot_are_drawn_at_its_upper_edge(shown):
    step = step_of("local-sd", initial_step=50.0)
    assert step.backtracks > 5
    trials = (*(Trial(alpha, np.inf, bound) for alpha, _, bound in step.trials[:-1]), step.trials[-1])
    step = dataclasses.replace(step, trials=trials)
    plot = shown(NodePlot(), 260, 180)
    plot.show_step(step)
    low, high = extent(step)
    drawn = drawn_trials(plot)
    assert [number for number, _, _ in drawn] == list(range(len(trials) + 1 - len(drawn), len(trials) + 1))
    assert len(drawn) > 3  # most trials, from 50 times the step on, are beyond the right edge
    for number, alpha, height in drawn:
        assert alpha == trials[number - 1].alpha
        assert low < height < high
        assert (height > 0.8 * high) == (number < len(trials))


@pytest.mark.parametrize("name", METHODS)
def test_every_method_is_explained(name):
    texts = " ".join(f"{row.name} {row.meaning}" for row in rows(step_of(name)))
    assert "Energy" in texts
    assert ("Armijo" in texts) == (name.split("-")[-1] in ("sd", "nr", "mnr"))
    assert ("Target" in texts) == (name in ("laplacian", "smart-laplacian", "getme", "general"))


# Choice of the node that is explained; the camera moves to it.


@pytest.fixture
def host(hosted):
    host = hosted(scrambled(grid(4), 0.3))
    host.session.selection.rank_by("q")
    host.visited = []
    host.session.selection.visited.connect(host.visited.append)
    return host


@pytest.mark.parametrize("chosen", ["nothing", "a hex", "a free node"])
def test_the_camera_moves_to_the_explained_node(host, chosen):
    selection, mesh = host.session.selection, host.session.document.now.mesh
    free = int(np.flatnonzero(mesh.free)[0])
    around = int((mesh.hexes == free).any(axis=1).argmax())
    if chosen != "nothing":
        selection.choose(around, free if chosen == "a free node" else None)
    action(FeatureNodeStep(host), "explain_node").handle()
    assert host.fronted == ["node"]
    assert host.visited == [(selection.hex,)]
    assert mesh.free[selection.node]
    assert selection.node in mesh.hexes[selection.hex]
    if chosen == "a free node":
        assert (selection.hex, selection.node) == (around, free)
    elif chosen == "a hex":
        assert selection.hex == around


# Node debugger in the window, by mouse and keys: the step of a node.


# One node


def test_a_key_explains_a_free_node_of_the_worst_hex(node_window):
    window, step = node_window, shown_step(node_window)
    mesh = window.session.document.now.mesh
    assert window.session.selection.hex == window.features["hex_inspector"].worst_list.hexes[0]
    assert window.session.selection.node in mesh.hexes[window.session.selection.hex]
    assert mesh.free[step.node]
    np.testing.assert_array_equal(step.after, explain(mesh, METHODS["local-sd"](), step.node).after)
    assert window.is_visible("node")
    words = texts(window)
    assert f"Node {step.node}" in words
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
    assert window.is_visible("node")  # a click does not bring another panel to the front
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
    press(button(window.features["node_step"].panel, "Isolate patch"))
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
    press(button(window.features["node_step"].panel, "Next node"))
    step = wait_for_step(window, qtbot, "local-sd")
    assert step.status is StepStatus.MOVED
    points = window.session.document.now.mesh.points
    np.testing.assert_array_equal(points[step.node], step.after)
    assert (points != start.mesh.points).any(axis=1).sum() == 1
    assert "Local steepest descent. Moved." in texts(window)
    assert "1 of" in texts(window)
    press(button(window.features["node_step"].panel, "10 nodes"))
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
        click_until(window, qtbot, "Step", Phase.PAUSED)
        click_until(window, qtbot, "Stop", Phase.FINISHED)
        window.session.commands.undo()
    else:
        choose_by_keys(window, "local-nr")
        wait_for_step(window, qtbot, "local-nr")
        key(window, Qt.Key.Key_F11)
        assert window.session.node_sweep.sweep.done == 1
        window.session.commands.undo()
    assert window.session.document.undo_title == "sweep of local-sd, 2 nodes"
    np.testing.assert_array_equal(window.session.document.now.mesh.points, stepped.mesh.points)
