"""The timeline in the window, by mouse and keys: scrubbing, playing, branching, breakpoints."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QSettings, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QComboBox, QDoubleSpinBox, QLabel, QSpinBox, QToolButton

from hexmend.run import StoppingCriteria
from hexmend_app.features.timeline.track_slider import TrackSlider
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, choose, choose_by_keys, click, drag, key, phase, pixels
from tests.app.driving import press as press_button
from tests.patience import PATIENCE

ENDLESS = StoppingCriteria(tolerance=0.0, max_iterations=1_000_000)


def named(widget, kind, name):
    """Return the child of a widget with an accessible name."""
    return next(one for one in widget.findChildren(kind) if one.accessibleName() == name)


def stepped(window, qtbot, iterations=12, method="local-sd"):
    """Run a number of iterations by the Step button, and wait for the pause."""
    panel = window.features["smooth"].panel
    choose(window, method, ENDLESS)
    box = named(panel, QSpinBox, "Iterations per step")
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, str(iterations))
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    window.refresh()
    return window.session.run.record


def press(window, name):
    window.refresh()
    press_button(window.features["timeline"].panel.button(name))


def slider(window):
    return named(window.features["timeline"].panel, TrackSlider, "Iteration")


def slider_place(window, number):
    """Return the position of a number on the slider."""
    window.refresh()
    return QPoint(slider(window).place(number), slider(window).height() // 2)


def go(window, qtbot, number):
    """Press the slider at a number."""
    QTest.mouseClick(slider(window), LEFT, pos=slider_place(window, number))
    qtbot.waitUntil(at(window, number), timeout=PATIENCE)
    window.refresh()


def said(window):
    """Return the sentence below the buttons of the run."""
    window.refresh()
    return named(window.features["smooth"].panel, QLabel, "Outcome").text()


def at(window, number):
    return lambda: (
        window.session.timeline.shown_iteration is not None and window.session.timeline.shown_iteration.number == number
    )


def check(window, text):
    box = next(b for b in window.features["smooth"].panel.breakpoint_form.findChildren(QCheckBox) if b.text() == text)
    QTest.mouseClick(box, LEFT, pos=QPoint(8, box.height() // 2))
    assert box.isChecked()


@pytest.mark.slow
def test_everything_follows_the_slider(window, qtbot):
    record = stepped(window, qtbot)
    newest, picture = window.session.document.now, pixels(window)
    drag(slider(window), slider_place(window, 12), slider_place(window, 3))
    qtbot.waitUntil(at(window, 3), timeout=PATIENCE)
    window.refresh()
    state = window.session.document.now
    assert state.summary.q_mean == pytest.approx(record.rows[3]["q_mean"], abs=1e-6)
    assert state.summary.inverted == record.rows[3]["inverted"]
    assert np.abs(pixels(window) - picture).max() > 50
    assert named(window.statusBar(), QLabel, "Counts").text().endswith(f"{state.summary.invalid:,} invalid")
    assert state.figures.inverted[window.features["hex_inspector"].worst_list.hexes[0]]
    assert state is not newest


def test_shortcuts_show_other_iterations(window, qtbot):
    stepped(window, qtbot)
    for pressed, number in (
        (Qt.Key.Key_Comma, 11),
        (Qt.Key.Key_Comma, 10),
        (Qt.Key.Key_Period, 11),
    ):
        key(window, pressed)
        assert at(window, number)()
    key(window, Qt.Key.Key_Home, Qt.KeyboardModifier.AltModifier)
    assert at(window, 0)()
    assert not window.features["timeline"].panel.button("back").isEnabled()
    key(window, Qt.Key.Key_End, Qt.KeyboardModifier.AltModifier)
    assert at(window, 12)()
    assert window.session.timeline.live


@pytest.mark.slow
def test_a_branch_is_a_second_run(window, qtbot):
    first = stepped(window, qtbot)
    go(window, qtbot, 4)
    choose(window, "laplacian", StoppingCriteria(tolerance=0.0, max_iterations=3))
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):  # of the run that is left
        key(window, Qt.Key.Key_F5, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    second = window.session.run.record
    assert (second.name, second.parent.record, second.parent.number, second.newest) == ("Laplacian", first, 4, 3)
    window.refresh()
    runs = named(window.features["timeline"].panel, QComboBox, "Run")
    assert [runs.itemText(i) for i in range(runs.count())] == ["Local steepest descent", "Laplacian"]
    assert runs.currentText() == "Laplacian"
    runs.setFocus()
    QTest.keyClick(runs, Qt.Key.Key_Up)
    assert window.session.timeline.record is first
    assert at(window, 12)()
    for title in ("Laplacian", "Local steepest descent"):
        assert window.session.document.undo_title == title
        key(window, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.session.document.now is window.session.document.start


def test_a_breakpoint_pauses_and_selects_the_hex(window, qtbot):
    click(window, "Pause when")
    check(window, "A hex inverts")
    choose(window, "laplacian", ENDLESS)
    with qtbot.waitSignal(window.session.run.hit, timeout=PATIENCE) as hit:
        click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    frame = hit.args[0]
    assert window.session.selection.hex == frame.hit.hexes[0]
    assert window.canvas.viewport.filters.ghosts(window.canvas.viewport.frame) is None  # nothing is before it
    assert said(window) == f"Paused at a breakpoint: {frame.hit.sentence}."
    assert at(window, frame.iteration.number)()
    assert frame.hit.sentence in slider(window).toolTip()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "method", "chooses"), [("Node moves", "laplacian", True), ("Line search backtracks", "global-sd", False)]
)
def test_breakpoints_for_a_node_and_for_the_line_search(window, qtbot, text, method, chooses):
    click(window, "Pause when")
    mesh = window.session.document.now.mesh
    node = int(np.flatnonzero(mesh.free)[100])
    window.session.selection.choose(int(np.flatnonzero((mesh.hexes == node).any(axis=1))[0]), node)
    window.refresh()
    check(window, text)  # a node is taken from the selection
    form = window.features["smooth"].panel.breakpoint_form
    named(form, QDoubleSpinBox, "Node moves by more than").setValue(0.001)
    named(form, QSpinBox, "Maximum backtracks of the line search").setValue(0)
    window.session.selection.choose(None)
    choose(window, method)
    with qtbot.waitSignal(window.session.run.hit, timeout=PATIENCE) as hit:
        click(window, "Run")
    assert hit.args[0].hit.sentence in said(window)
    assert window.session.selection.node == (node if chooses else None)


@pytest.mark.slow
def test_memory_and_speed_are_remembered(window, qtbot):
    record = stepped(window, qtbot)
    each = (window.session.history.bytes) // 12
    window.session.history.limit = 4 * each
    menu = named(window.features["timeline"].panel, QToolButton, "Timeline settings").menu()
    choices = {action.text(): action for action in menu.actions()}
    choices["128 MiB"].trigger()
    choices["30 iterations per second"].trigger()
    assert window.session.history.limit == 128 << 20
    assert window.session.timeline.speed == 30
    assert (QSettings().value("history_megabytes"), QSettings().value("iterations_played")) == (128, 30)
    window.refresh()
    assert "5 of them are stored" in slider(window).toolTip()
    assert not choices["Delete this run"].isEnabled()  # it is under way
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        click(window, "Stop")
    window.refresh()
    choices["Delete this run"].trigger()
    window.refresh()
    assert record not in window.session.history.records
    assert not window.window_actions["iteration_play"].isEnabled()


@pytest.mark.slow
def test_the_method_can_change_while_a_run_is_paused(window, qtbot):
    record = stepped(window, qtbot, 4)
    click(window, "Step")
    qtbot.waitUntil(lambda: at(window, 8)() and phase(window, Phase.PAUSED)(), timeout=PATIENCE)
    window.refresh()
    choose_by_keys(window, "laplacian")
    assert window.session.run_setup.method == "laplacian"
    click(window, "Step")
    qtbot.waitUntil(at(window, 12), timeout=PATIENCE)
    assert [row["method"] for row in record.rows[1:]] == ["local-sd"] * 8 + ["laplacian"] * 4
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    choose(window, "laplacian", StoppingCriteria(tolerance=0.0, max_iterations=15))
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE) as ended:
        click(window, "Resume")
    assert ended.args[0].iterations == 15
    assert "After iteration 8" in said(window)
    assert "After iteration 12" in said(window)
    assert window.session.document.undo_title == "Local steepest descent"
    window.session.document.undo()
    assert window.session.document.now is window.session.document.start


@pytest.mark.slow
def test_an_iteration_stays_in_its_side_view(window, qtbot):
    stepped(window, qtbot, 6)
    go(window, qtbot, 2)
    kept = window.session.document.now
    key(window, Qt.Key.Key_V)
    key(window, Qt.Key.Key_V)
    key(window, Qt.Key.Key_Period)
    (shown,) = window.session.side_views.all
    assert (shown.name, shown.state) == ("Local steepest descent 2", kept)
    assert window.session.document.now is not kept
    for _ in range(2):
        assert window.window_actions["beside"].isEnabled()
        key(window, Qt.Key.Key_V)
        key(window, Qt.Key.Key_Period)
    assert [one.name for one in window.session.side_views.all] == [f"Local steepest descent {k}" for k in (2, 3, 4)]
    assert not window.window_actions["beside"].isEnabled()
