"""The node debugger in the window, with mouse and keys: a node's step explained, and a sweep node by node."""

from __future__ import annotations

import itertools
from html import unescape

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QLabel, QPushButton

from hexmend.node_step import Verdict, explain
from hexmend.smoothers import METHODS
from hexmend_app.scene.palette import SEARCH, UPHILL
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.look import Isolation
from hexmend_app.state.run import Phase
from hexmend_app.state.task import running
from hexmend_app.widgets import theming
from hexmend_app.widgets.theming import Choice
from tests.app.driving import LEFT, click, phase, pixels
from tests.patience import PATIENCE

BOX = QPoint(8, 8)


def choose(window, name):
    """Choose a method as a hand does."""
    box = next(b for b in window.smoothing_panel.findChildren(QComboBox) if b.accessibleName() == "Method")
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Home)
    for _ in range(box.count()):
        if box.currentData() == name:
            return
        QTest.keyClick(box, Qt.Key.Key_Down)
    raise AssertionError(f"{name} is not offered")


def shown(window):
    return window.canvas.viewport.chosen.node_step


def wait_for_step(window, qtbot, method, node=None):
    qtbot.waitUntil(
        lambda: (
            shown(window) is not None
            and shown(window).method == method
            and shown(window).node == (window.selection.node if node is None else node)
        ),
        timeout=PATIENCE,
    )
    return shown(window)


def key(window, key, *modifiers):
    window.setFocus()
    held = Qt.KeyboardModifier.NoModifier
    for modifier in modifiers:
        held |= modifier
    QTest.keyClick(window, key, held)


def button(window, text):
    return next(b for b in window.node_panel.findChildren(QPushButton) if b.text() == text)


def texts(window):
    panel = window.node_panel
    labels = " ".join(unescape(one.text()) for one in panel.findChildren(QLabel) if one.isVisible())
    return labels + (panel.figures.toPlainText().replace("\xa0", " ") if panel.figures.isVisible() else "")


def said(window, qtbot, words):
    qtbot.waitUntil(lambda: words in texts(window), timeout=PATIENCE)


@pytest.fixture
def at_work(window, qtbot):
    """The window with a local method, and a node of the worst element chosen by key."""
    choose(window, "local-sd")
    key(window, Qt.Key.Key_D)
    wait_for_step(window, qtbot, "local-sd")
    return window


# One node


def test_a_key_explains_a_free_node_of_the_worst_element(at_work):
    window, step = at_work, shown(at_work)
    mesh = window.document.now.mesh
    assert window.selection.hex == window.worst_list.elements[0]
    assert window.selection.node in mesh.hexes[window.selection.hex]
    assert mesh.free[step.node]
    np.testing.assert_array_equal(step.after, explain(mesh, METHODS["local-sd"](), step.node).after)
    assert window.docks["node"].widget().isVisible()
    words = texts(window)
    assert f"Node {step.node:,}" in words
    assert "Local steepest descent. Will be moved." in words
    assert "Eigenvalues" in words
    assert window.document.now is window.document.start  # nothing has moved


def test_the_trials_are_numbered_in_the_plot(at_work):
    step = shown(at_work)
    drawn = at_work.node_panel.plot.shown_trials()
    assert drawn
    for number, alpha, height in drawn:
        trial = step.trials[number - 1]
        assert alpha == trial.alpha
        if number == len(step.trials):
            assert height == pytest.approx(trial.energy - step.energy)
    assert drawn[-1][0] == len(step.trials)  # the accepted one is never left out


def test_another_node_is_chosen_by_its_link_and_another_method_explained_at_once(at_work, qtbot):
    window = at_work
    label = next(one for one in window.node_panel.findChildren(QLabel) if one.accessibleName() == "Free nodes")
    mesh, before = window.document.now.mesh, window.selection.node
    other = next(int(i) for i in mesh.hexes[window.selection.hex] if mesh.free[i] and i != before)
    assert f'href="{other}"' in label.text()
    label.setFocus()
    for _ in range(8):
        if window.selection.node == other:
            break
        QTest.keyClick(label, Qt.Key.Key_Tab)
        QTest.keyClick(label, Qt.Key.Key_Return)
        qtbot.wait(5)
    assert window.selection.node != before
    wait_for_step(window, qtbot, "local-sd")
    choose(window, "local-mnr")
    step = wait_for_step(window, qtbot, "local-mnr")
    assert "Shift" in texts(window)
    window.smoothing_panel.form.set_values({"p": 3.0})
    window.smoothing_panel.form.changed.emit()
    qtbot.waitUntil(lambda: shown(window).p == 3, timeout=PATIENCE)
    assert shown(window).energy != step.energy


@pytest.mark.parametrize("name", list(METHODS))
def test_every_method_is_explained(at_work, qtbot, name):
    choose(at_work, name)
    wait_for_step(at_work, qtbot, "getme" if name == "general" else name)
    assert at_work.node_panel.plot.isVisible() == bool(len(shown(at_work).curve))
    words = texts(at_work)
    assert "Energy" in words
    assert ("Armijo" in words) == (name.split("-")[-1] in ("sd", "nr", "mnr"))
    assert ("Goes to" in words) == (name in ("laplacian", "smart-laplacian", "getme", "general"))


def test_a_node_that_is_fixed_has_no_step_and_says_why(window, qtbot):
    choose(window, "local-sd")
    window.docks["node"].raise_()
    said(window, qtbot, "Click an element in the view")
    QTest.mouseClick(window.canvas.interactor, LEFT, pos=window.canvas.interactor.rect().center())
    assert window.selection.hex is not None
    assert window.docks["node"].widget().isVisible()  # a click does not bring another panel to the front
    said(window, qtbot, "lies on the boundary: no method moves it")
    assert shown(window) is None
    mesh = window.document.now.mesh
    inner = int(np.flatnonzero(mesh.free)[50])
    window.selection.choose(int(mesh.topology.node_corners[inner][0] // 8), inner)
    wait_for_step(window, qtbot, "local-sd", inner)
    window.commands.pin(inner, True)
    said(window, qtbot, "is pinned: no method moves it")
    assert shown(window) is None


def test_a_wrong_value_of_a_parameter_is_said(at_work, qtbot):
    window = at_work
    window.smoothing_panel._sections[0].expand()
    editor = window.smoothing_panel.form.editor("p")
    target = editor.widget if hasattr(editor, "widget") else editor
    target.setFocus()
    line = target.lineEdit() if hasattr(target, "lineEdit") else target
    line.selectAll()
    QTest.keyClicks(line, "0.1")
    said(window, qtbot, "Correct the marked value")
    assert shown(window) is None
    assert not button(window, "Next node").isEnabled()
    assert not window.actions_by_id["next_node"].isEnabled()


def test_while_a_run_goes_on_there_is_no_step_and_while_it_is_paused_none_is_made(at_work, qtbot):
    window = at_work
    with qtbot.waitSignal(window.smoothing.phase_changed, timeout=PATIENCE):
        click(window, "Run")
    window.debugging._refresh()
    if window.smoothing.phase in (Phase.RUNNING, Phase.PREPARING):
        assert "A run is under way" in texts(window)
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    choose(window, "local-sd")
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    wait_for_step(window, qtbot, "local-sd")
    assert not button(window, "Next node").isEnabled()
    assert "paused" in button(window, "Next node").toolTip()
    now = window.document.now
    key(window, Qt.Key.Key_F11)
    assert window.document.now is now
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    qtbot.waitUntil(button(window, "Next node").isEnabled, timeout=5000)


def test_nothing_is_worked_out_while_another_panel_is_in_front(at_work, qtbot):
    window = at_work
    window.docks["histogram"].raise_()
    qtbot.waitUntil(lambda: shown(window) is None, timeout=5000)
    choose(window, "getme")
    qtbot.wait(50)
    assert not window.session.explainer.busy
    window.docks["node"].raise_()
    wait_for_step(window, qtbot, "getme")


# What is seen


def test_the_patch_is_isolated_and_the_marks_are_seen_under_any_cut_and_in_pictures(at_work, qtbot, tmp_path):
    window = at_work
    box = window.node_panel._patch
    QTest.mouseClick(box, LEFT, pos=BOX)
    step = shown(window)
    assert window.view.look.isolation == Isolation(tuple(step.hexes.tolist()), 0)
    assert window.canvas.viewport.shown == step.hexes.size
    qtbot.waitUntil(lambda: not window.canvas.flying, timeout=5000)

    def seen(image, role):
        colour = [int(role.light[k : k + 2], 16) for k in (1, 3, 5)]
        return int((np.abs(image - colour).max(axis=2) < 12).sum())

    assert min(seen(pixels(window), role) for role in (UPHILL, SEARCH)) > 20
    window.view.set_clip(PlaneClip.at((1, 0, 0), tuple(step.before - 100.0)))
    window.view.set_handles(False)
    assert window.canvas.viewport.shown == 0
    assert seen(pixels(window), UPHILL) > 20
    assert window.saving.picture(tmp_path / "step.png", (800, 600))
    assert seen(np.asarray(Image.open(tmp_path / "step.png").convert("RGB")).astype(int), UPHILL) > 20
    window.messages.clear()  # Esc is for a message first
    qtbot.waitUntil(lambda: window.actions_by_id["back"].isEnabled(), timeout=5000)
    key(window, Qt.Key.Key_Escape)
    assert window.view.look.isolation is None
    assert not box.isChecked()
    window.selection.choose(None)
    qtbot.waitUntil(lambda: shown(window) is None, timeout=5000)
    assert seen(pixels(window), UPHILL) == 0


def test_the_marks_and_the_plot_follow_the_theme(at_work, qtbot):
    try:
        theming.choose(Choice.DARK)
        qtbot.wait(20)
        arrow = at_work.canvas.viewport.chosen._node_step._arrows[UPHILL][1]
        wanted = [int(UPHILL.dark[k : k + 2], 16) / 255 for k in (1, 3, 5)]
        assert arrow.GetProperty().GetColor() == pytest.approx(wanted)
        assert at_work.node_panel.plot._curve.opts["pen"].color().name() == SEARCH.dark
    finally:
        theming.choose(Choice.LIGHT)


# A sweep


def test_a_sweep_node_by_node_is_one_change_that_undo_takes_back(at_work, qtbot):
    window = at_work
    start = window.document.now
    QTest.mouseClick(button(window, "Next node"), LEFT)
    step = wait_for_step(window, qtbot, "local-sd")
    assert step.verdict is Verdict.MOVED
    points = window.document.now.mesh.points
    np.testing.assert_array_equal(points[step.node], step.after)
    assert (points != start.mesh.points).any(axis=1).sum() == 1
    assert "Local steepest descent. Moved." in texts(window)
    assert "1 of" in texts(window)
    QTest.mouseClick(button(window, "10 nodes"), LEFT)
    key(window, Qt.Key.Key_F11)
    assert window.session.stepping.sweep.done == 12
    assert window.document.undo_title is None
    assert window.actions_by_id["undo"].text() == "&Undo sweep of local-sd, 12 nodes"
    now = window.document.now
    key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.document.now is start
    assert window.session.stepping.sweep is None
    key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier)
    assert window.document.now is now
    assert window.document.undo_title == "sweep of local-sd, 12 nodes"


def test_a_finished_sweep_is_the_methods_iteration(at_work, qtbot):
    window = at_work
    mesh = window.document.now.mesh
    expected = next(itertools.islice(METHODS["local-sd"]().steps(mesh), 1, None)).points
    key(window, Qt.Key.Key_F11, Qt.KeyboardModifier.ShiftModifier)
    QTest.mouseClick(button(window, "Finish"), LEFT)
    np.testing.assert_allclose(window.document.now.mesh.points, expected, rtol=0, atol=1e-13)
    assert window.session.stepping.sweep is None
    free = int(mesh.free.sum())
    assert window.document.undo_title == f"sweep of local-sd, {free:,} nodes"
    qtbot.waitUntil(lambda: shown(window).node == window.selection.node, timeout=5000)
    assert "Moved." in texts(window)


def test_a_node_looked_at_in_a_sweep_is_explained_as_the_sweep_would_treat_it(at_work, qtbot):
    window = at_work
    key(window, Qt.Key.Key_F11)
    sweep = window.session.stepping.sweep
    coming = int(sweep.nodes[5])
    window.selection.choose(int(window.document.now.mesh.topology.node_corners[coming][0] // 8), coming)
    step = wait_for_step(window, qtbot, "local-sd", coming)
    assert "Will be moved" in texts(window)
    assert window.session.stepping.sweep is sweep
    np.testing.assert_array_equal(step.after, sweep.look(coming).after)


@pytest.mark.parametrize("what", ["run", "method", "tag", "save", "reset"])
def test_whatever_else_changes_the_mesh_leaves_the_sweep_first(at_work, qtbot, tmp_path, what):
    window = at_work
    start = window.document.now
    key(window, Qt.Key.Key_F11)
    key(window, Qt.Key.Key_F11)
    stepped = window.document.now
    if what == "run":
        window.smoothing_panel.set_method("laplacian")
        click(window, "Step")
        qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
        click(window, "Stop")
        qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
        window.commands.undo()
    elif what == "method":
        choose(window, "local-nr")
        wait_for_step(window, qtbot, "local-nr")
        key(window, Qt.Key.Key_F11)
        assert window.session.stepping.sweep.done == 1
        window.commands.undo()
    elif what == "tag":
        window.commands.tag("bad", [7])
        assert window.document.undo_title == "tag"
        window.commands.undo()
    elif what == "save":
        assert window.saving.mesh(tmp_path / "saved.vtu")
        assert not window.document.modified
    else:
        window.commands.reset()
        np.testing.assert_array_equal(window.document.now.mesh.points, start.mesh.points)
        window.commands.undo()
    assert window.document.undo_title == "sweep of local-sd, 2 nodes"
    np.testing.assert_array_equal(window.document.now.mesh.points, stepped.mesh.points)


def test_going_back_to_an_iteration_leaves_the_sweep_and_stays_there(at_work, qtbot):
    window = at_work
    window.smoothing_panel.set_method("laplacian")
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    choose(window, "local-sd")
    wait_for_step(window, qtbot, "local-sd")
    key(window, Qt.Key.Key_F11)
    stepped = window.document.now
    timeline = window.session.timeline
    timeline.go(timeline.record, 0)
    assert window.session.stepping.sweep is None
    np.testing.assert_array_equal(window.document.now.mesh.points, window.document.start.mesh.points)
    assert window.document.undo_title == "sweep of local-sd, 1 node"
    wait_for_step(window, qtbot, "local-sd")
    np.testing.assert_array_equal(shown(window).before, window.document.now.mesh.points[shown(window).node])
    window.commands.undo()
    window.commands.redo()
    assert window.document.now is stepped


def test_only_local_methods_go_from_node_to_node(at_work, qtbot):
    window = at_work
    choose(window, "mend")
    wait_for_step(window, qtbot, "mend")
    for id in ("next_node", "ten_nodes", "finish_sweep"):
        assert not window.actions_by_id[id].isEnabled()
    assert "Local steepest descent" in button(window, "10 nodes").toolTip()
    now = window.document.now
    key(window, Qt.Key.Key_F11)
    assert window.document.now is now


def test_a_sweep_can_be_begun_before_anything_was_explained(window, qtbot):
    choose(window, "local-nr")
    key(window, Qt.Key.Key_F11)
    qtbot.waitUntil(lambda: window.session.stepping.sweep is not None, timeout=PATIENCE)
    step = wait_for_step(window, qtbot, "local-nr")
    assert step.node == window.session.stepping.sweep.nodes[0]
    np.testing.assert_array_equal(window.document.now.mesh.points[step.node], step.after)


def test_closing_while_a_step_is_worked_out_leaves_no_thread(window, qtbot):
    choose(window, "global-nr")
    key(window, Qt.Key.Key_D)
    qtbot.waitUntil(lambda: window.session.explainer.busy, timeout=5000)
    window.close()
    assert running() == ()


@pytest.mark.parametrize("size", [(1440, 900), (1100, 700)])
def test_nothing_is_cut_off(at_work, qtbot, size):
    window = at_work
    key(window, Qt.Key.Key_F11)
    window.resize(*size)
    qtbot.wait(50)
    panel = window.node_panel
    assert window.width() == size[0]
    for part in [*panel.findChildren(QPushButton), panel._patch, panel._title, panel._progress]:
        assert part.width() >= part.fontMetrics().horizontalAdvance(part.text()) + 12 * isinstance(part, QPushButton)
        assert panel.rect().contains(part.mapTo(panel, part.rect().bottomRight())), part.text()
    assert panel.mapTo(window, panel.rect().bottomRight()).x() < window.docks["tools"].x()
    assert panel.figures.document().idealWidth() <= panel.figures.viewport().width()
    assert min(panel.figures.height(), panel.plot.height()) > 100
