"""The node debugger in the window, with mouse and keys: a node's step explained, and a sweep node by node."""

from __future__ import annotations

import itertools
from html import unescape

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QCheckBox, QLabel, QPushButton, QTabBar

from hexmend.node_step import Verdict, explain
from hexmend.smoothers import METHODS
from hexmend_app.scene.palette import SEARCH, UPHILL
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.look import Isolation
from hexmend_app.state.run import Phase
from hexmend_app.state.task import running
from hexmend_app.widgets import theming
from hexmend_app.widgets.theming import Choice
from tests.app.driving import LEFT, choose_by_keys, click, key, named, phase, pixels, press, tick
from tests.patience import PATIENCE


def shown(window):
    return window.canvas.viewport.chosen.node_step


def wait_for_step(window, qtbot, method, node=None):
    window.refresh()
    qtbot.waitUntil(
        lambda: (
            shown(window) is not None
            and shown(window).method == method
            and shown(window).node == (window.session.selection.node if node is None else node)
        ),
        timeout=PATIENCE,
    )
    window.refresh()
    return shown(window)


def button(window, text):
    return next(b for b in window.features["node"].panel.findChildren(QPushButton) if b.text() == text)


def patch_alone(window):
    return named(window.features["node"].panel, QCheckBox, "Patch alone")


def seen(image, role, dark=False):
    """How many pixels of a picture, (h, w, 3), have the colour of a role."""
    colour = [int(role.of(dark)[k : k + 2], 16) for k in (1, 3, 5)]
    return int((np.abs(image[..., :3].astype(int) - colour).max(axis=2) < 12).sum())


def grabbed(widget):
    """What a widget shows, (h, w, 4), red first."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGBA8888)
    return np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine() // 4, 4)


def texts(window):
    window.refresh()
    panel = window.features["node"].panel
    labels = " ".join(unescape(one.text()) for one in panel.findChildren(QLabel) if one.isVisible())
    return labels + (panel.figures.toPlainText().replace("\xa0", " ") if panel.figures.isVisible() else "")


def said(window, qtbot, words):
    qtbot.waitUntil(lambda: words in texts(window), timeout=PATIENCE)


@pytest.fixture
def at_work(window, qtbot):
    """The window with a local method, and a node of the worst element chosen by key."""
    choose_by_keys(window, "local-sd")
    key(window, Qt.Key.Key_D)
    wait_for_step(window, qtbot, "local-sd")
    return window


# One node


def test_a_key_explains_a_free_node_of_the_worst_element(at_work):
    window, step = at_work, shown(at_work)
    mesh = window.session.document.now.mesh
    assert window.session.selection.hex == window.features["inspect"].worst_list.elements[0]
    assert window.session.selection.node in mesh.hexes[window.session.selection.hex]
    assert mesh.free[step.node]
    np.testing.assert_array_equal(step.after, explain(mesh, METHODS["local-sd"](), step.node).after)
    assert window.in_front("node")
    words = texts(window)
    assert f"Node {step.node:,}" in words
    assert "Local steepest descent. Will be moved." in words
    assert "Eigenvalues" in words
    assert window.session.document.now is window.session.document.start  # nothing has moved


def test_the_camera_flies_to_the_hex_of_the_node_that_is_explained(window, qtbot):
    camera = window.canvas.viewport.camera

    def arrived(h):
        mesh = window.session.document.now.mesh
        return lambda: np.allclose(camera.GetFocalPoint(), mesh.points[mesh.hexes[h]].mean(axis=0))

    key(window, Qt.Key.Key_D)
    first = window.session.selection.hex
    qtbot.waitUntil(arrived(first), timeout=PATIENCE)
    window.canvas.look_along("iso")
    window.canvas.fit()
    assert not arrived(first)()
    key(window, Qt.Key.Key_D)  # to that which is chosen already, too
    qtbot.waitUntil(arrived(first), timeout=PATIENCE)


def test_the_trials_are_numbered_in_the_plot(at_work):
    step = shown(at_work)
    drawn = at_work.features["node"].panel.plot.shown_trials()
    assert drawn
    for number, alpha, height in drawn:
        trial = step.trials[number - 1]
        assert alpha == trial.alpha
        if number == len(step.trials):
            assert height == pytest.approx(trial.energy - step.energy)
    assert drawn[-1][0] == len(step.trials)  # the accepted one is never left out


def test_another_node_is_chosen_by_its_link_and_another_method_explained_at_once(at_work, qtbot):
    window = at_work
    label = named(window.features["node"].panel, QLabel, "Free nodes")
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
    window.features["smooth"].panel.form.set_values({"p": 3.0})
    window.features["smooth"].panel.form.changed.emit()
    qtbot.waitUntil(lambda: shown(window).p == 3, timeout=PATIENCE)
    assert shown(window).energy != step.energy


@pytest.mark.parametrize("name", list(METHODS))
def test_every_method_is_explained(at_work, qtbot, name):
    choose_by_keys(at_work, name)
    wait_for_step(at_work, qtbot, "getme" if name == "general" else name)
    assert at_work.features["node"].panel.plot.isVisible() == bool(len(shown(at_work).curve))
    words = texts(at_work)
    assert "Energy" in words
    assert ("Armijo" in words) == (name.split("-")[-1] in ("sd", "nr", "mnr"))
    assert ("Goes to" in words) == (name in ("laplacian", "smart-laplacian", "getme", "general"))


def test_a_node_that_is_fixed_has_no_step_and_says_why(window, qtbot):
    choose_by_keys(window, "local-sd")
    window.show_panel("node")
    said(window, qtbot, "Click a hex in the view")
    QTest.mouseClick(window.canvas.interactor, LEFT, pos=window.canvas.interactor.rect().center())
    assert window.session.selection.hex is not None
    assert window.in_front("node")  # a click does not bring another panel to the front
    said(window, qtbot, "lies on the boundary: no method moves it")
    assert shown(window) is None
    mesh = window.session.document.now.mesh
    inner = int(np.flatnonzero(mesh.free)[50])
    window.session.selection.choose(int(mesh.topology.node_corners[inner][0] // 8), inner)
    wait_for_step(window, qtbot, "local-sd", inner)
    window.session.commands.pin(inner, True)
    said(window, qtbot, "is pinned: no method moves it")
    assert shown(window) is None


def test_a_wrong_value_of_a_parameter_is_said(at_work, qtbot):
    window = at_work
    if not window.features["smooth"].panel.form.isVisible():
        press(named(window.features["smooth"].panel, QAbstractButton, "Parameters"))
    editor = window.features["smooth"].panel.form.editor("p")
    target = editor.widget if hasattr(editor, "widget") else editor
    target.setFocus()
    line = target.lineEdit() if hasattr(target, "lineEdit") else target
    line.selectAll()
    QTest.keyClicks(line, "0.1")
    said(window, qtbot, "Correct the marked value")
    assert shown(window) is None
    assert not button(window, "Next node").isEnabled()
    assert not window.actions["next_node"].isEnabled()


def test_while_a_run_goes_on_there_is_no_step_and_while_it_is_paused_none_is_made(at_work, qtbot):
    window = at_work
    with qtbot.waitSignal(window.session.smoothing.phase_changed, timeout=PATIENCE):
        click(window, "Run")
    window.refresh()
    if window.session.smoothing.phase in (Phase.RUNNING, Phase.PREPARING):
        assert "A run is under way" in texts(window)
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    choose_by_keys(window, "local-sd")
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


def test_nothing_is_worked_out_while_another_panel_is_in_front(at_work, qtbot):
    window = at_work
    window.show_panel("convergence")
    qtbot.waitUntil(lambda: shown(window) is None, timeout=PATIENCE)
    choose_by_keys(window, "getme")
    assert not window.session.explainer.busy
    window.show_panel("node")
    wait_for_step(window, qtbot, "getme")


# What is seen


def test_the_patch_is_isolated_and_the_marks_are_seen_under_any_cut_and_in_pictures(at_work, qtbot, tmp_path):
    window = at_work
    box = patch_alone(window)
    tick(box)
    step = shown(window)
    assert window.session.view.look.isolation == Isolation(tuple(step.hexes.tolist()), 0)
    assert window.canvas.viewport.shown == step.hexes.size
    qtbot.waitUntil(lambda: not window.canvas.flying, timeout=PATIENCE)

    assert min(seen(pixels(window), role) for role in (UPHILL, SEARCH)) > 20
    window.session.view.set_clip(PlaneClip.at((1, 0, 0), tuple(step.before - 100.0)))
    window.session.view.set_handles(False)
    window.refresh()
    assert window.canvas.viewport.shown == 0
    assert seen(pixels(window), UPHILL) > 20
    assert window.features["save"].picture(tmp_path / "step.png", (800, 600))
    assert seen(np.asarray(Image.open(tmp_path / "step.png").convert("RGB")).astype(int), UPHILL) > 20
    window.messages.clear()  # Esc is for a message first
    qtbot.waitUntil(lambda: window.actions["back"].isEnabled(), timeout=PATIENCE)
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.isolation is None
    assert not box.isChecked()
    window.session.selection.choose(None)
    qtbot.waitUntil(lambda: shown(window) is None, timeout=PATIENCE)
    assert seen(pixels(window), UPHILL) == 0


def test_the_marks_and_the_plot_follow_the_theme(at_work, qtbot):
    try:
        assert seen(pixels(at_work), UPHILL, dark=True) < 20
        assert seen(grabbed(at_work.features["node"].panel.plot), SEARCH, dark=True) < 20
        theming.choose(Choice.DARK)
        at_work.refresh()
        assert seen(pixels(at_work), UPHILL, dark=True) > 20
        assert seen(grabbed(at_work.features["node"].panel.plot), SEARCH, dark=True) > 20
    finally:
        theming.choose(Choice.LIGHT)


# A sweep


def test_a_sweep_node_by_node_is_one_change_that_undo_takes_back(at_work, qtbot):
    window = at_work
    start = window.session.document.now
    press(button(window, "Next node"))
    step = wait_for_step(window, qtbot, "local-sd")
    assert step.verdict is Verdict.MOVED
    points = window.session.document.now.mesh.points
    np.testing.assert_array_equal(points[step.node], step.after)
    assert (points != start.mesh.points).any(axis=1).sum() == 1
    assert "Local steepest descent. Moved." in texts(window)
    assert "1 of" in texts(window)
    press(button(window, "10 nodes"))
    key(window, Qt.Key.Key_F11)
    assert window.session.stepping.sweep.done == 12
    assert window.session.document.undo_title is None
    assert window.actions["undo"].text() == "&Undo sweep of local-sd, 12 nodes"
    now = window.session.document.now
    key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.now is start
    assert window.session.stepping.sweep is None
    key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier)
    assert window.session.document.now is now
    assert window.session.document.undo_title == "sweep of local-sd, 12 nodes"


def test_a_finished_sweep_is_the_methods_iteration(at_work, qtbot):
    window = at_work
    mesh = window.session.document.now.mesh
    expected = next(itertools.islice(METHODS["local-sd"]().steps(mesh), 1, None)).points
    key(window, Qt.Key.Key_F11, Qt.KeyboardModifier.ShiftModifier)
    press(button(window, "Finish"))
    np.testing.assert_allclose(window.session.document.now.mesh.points, expected, rtol=0, atol=1e-13)
    assert window.session.stepping.sweep is None
    free = int(mesh.free.sum())
    assert window.session.document.undo_title == f"sweep of local-sd, {free:,} nodes"
    qtbot.waitUntil(lambda: shown(window).node == window.session.selection.node, timeout=PATIENCE)
    assert "Moved." in texts(window)


def test_a_node_looked_at_in_a_sweep_is_explained_as_the_sweep_would_treat_it(at_work, qtbot):
    window = at_work
    key(window, Qt.Key.Key_F11)
    sweep = window.session.stepping.sweep
    coming = int(sweep.nodes[5])
    window.session.selection.choose(int(window.session.document.now.mesh.topology.node_corners[coming][0] // 8), coming)
    step = wait_for_step(window, qtbot, "local-sd", coming)
    assert "Will be moved" in texts(window)
    assert window.session.stepping.sweep is sweep
    np.testing.assert_array_equal(step.after, sweep.look(coming).after)


@pytest.mark.parametrize("what", ["run", "method", "tag", "save", "reset"])
def test_whatever_else_changes_the_mesh_leaves_the_sweep_first(at_work, qtbot, tmp_path, what):
    window = at_work
    start = window.session.document.now
    key(window, Qt.Key.Key_F11)
    key(window, Qt.Key.Key_F11)
    stepped = window.session.document.now
    if what == "run":
        choose_by_keys(window, "laplacian")
        click(window, "Step")
        qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
        click(window, "Stop")
        qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
        window.session.commands.undo()
    elif what == "method":
        choose_by_keys(window, "local-nr")
        wait_for_step(window, qtbot, "local-nr")
        key(window, Qt.Key.Key_F11)
        assert window.session.stepping.sweep.done == 1
        window.session.commands.undo()
    elif what == "tag":
        window.session.commands.tag("bad", [7])
        assert window.session.document.undo_title == "tag"
        window.session.commands.undo()
    elif what == "save":
        assert window.features["save"].mesh(tmp_path / "saved.vtu")
        assert not window.session.document.modified
    else:
        window.session.commands.reset()
        np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
        window.session.commands.undo()
    assert window.session.document.undo_title == "sweep of local-sd, 2 nodes"
    np.testing.assert_array_equal(window.session.document.now.mesh.points, stepped.mesh.points)


def test_going_back_to_an_iteration_leaves_the_sweep_and_stays_there(at_work, qtbot):
    window = at_work
    choose_by_keys(window, "laplacian")
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    choose_by_keys(window, "local-sd")
    wait_for_step(window, qtbot, "local-sd")
    key(window, Qt.Key.Key_F11)
    stepped = window.session.document.now
    timeline = window.session.timeline
    timeline.go(timeline.record, 0)
    assert window.session.stepping.sweep is None
    np.testing.assert_array_equal(window.session.document.now.mesh.points, window.session.document.start.mesh.points)
    assert window.session.document.undo_title == "sweep of local-sd, 1 node"
    now = window.session.document.now.mesh.points
    qtbot.waitUntil(lambda: np.array_equal(shown(window).before, now[shown(window).node]), timeout=PATIENCE)
    wait_for_step(window, qtbot, "local-sd")
    window.session.commands.undo()
    window.session.commands.redo()
    assert window.session.document.now is stepped


def test_only_local_methods_go_from_node_to_node(at_work, qtbot):
    window = at_work
    choose_by_keys(window, "mend")
    wait_for_step(window, qtbot, "mend")
    for id in ("next_node", "ten_nodes", "finish_sweep"):
        assert not window.actions[id].isEnabled()
    assert "Local steepest descent" in button(window, "10 nodes").toolTip()
    now = window.session.document.now
    key(window, Qt.Key.Key_F11)
    assert window.session.document.now is now


def test_a_sweep_can_be_begun_before_anything_was_explained(window, qtbot):
    choose_by_keys(window, "local-nr")
    key(window, Qt.Key.Key_F11)
    qtbot.waitUntil(lambda: window.session.stepping.sweep is not None, timeout=PATIENCE)
    step = wait_for_step(window, qtbot, "local-nr")
    assert step.node == window.session.stepping.sweep.nodes[0]
    np.testing.assert_array_equal(window.session.document.now.mesh.points[step.node], step.after)


def test_closing_while_a_step_is_worked_out_leaves_no_thread(fresh_window, qtbot):
    window = fresh_window
    choose_by_keys(window, "global-nr")
    key(window, Qt.Key.Key_D)
    qtbot.waitUntil(lambda: window.session.explainer.busy, timeout=PATIENCE)
    window.close()
    assert running() == ()


@pytest.mark.parametrize("size", [(1440, 900), (1100, 700)])
def test_nothing_is_cut_off(at_work, qtbot, size):
    window = at_work
    key(window, Qt.Key.Key_F11)
    window.resize(*size)
    panel = window.features["node"].panel
    tools = named(window, QTabBar, "Tools")
    qtbot.waitUntil(lambda: panel.mapTo(window, panel.rect().bottomRight()).x() < tools.mapTo(window, QPoint()).x())
    assert window.width() == size[0]
    labels = [named(panel, QLabel, name) for name in ("Node", "Progress of the sweep")]
    for part in [*panel.findChildren(QPushButton), patch_alone(window), *labels]:
        assert part.width() >= part.fontMetrics().horizontalAdvance(part.text()) + 12 * isinstance(part, QPushButton)
        assert panel.rect().contains(part.mapTo(panel, part.rect().bottomRight())), part.text()
    assert panel.figures.document().idealWidth() <= panel.figures.viewport().width()
    assert min(panel.figures.height(), panel.plot.height()) > 100
