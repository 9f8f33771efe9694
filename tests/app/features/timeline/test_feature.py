"""The timeline in the window, by mouse and keys: scrubbing, playing, branching, breakpoints."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QSettings, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox, QMenu, QSpinBox, QStyle, QStyleOptionSlider, QToolButton

from hexmend import METHODS, Outcome, Step, StoppingCriteria
from hexmend_app.features.timeline.timeline_bar import RunBar, TrackSlider
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, choose, click, click_until, key, named, phase, press, sentence, type_text

ENDLESS = StoppingCriteria(tolerance=0.0, max_iterations=1_000_000)


def stepped(window, qtbot, iterations=12, method="local-sd"):
    """Run a number of iterations by the Step button, and wait for the pause."""
    panel = window.features["smooth"].panel
    choose(window, method, ENDLESS)
    box = named(panel, QSpinBox, "Iterations per step")
    box.setFocus()
    type_text(box, str(iterations))
    click_until(window, qtbot, "Step", Phase.PAUSED)
    window.refresh()
    return window.session.run.record


def slider(window):
    return named(window.features["timeline"].panel, TrackSlider, "Iteration")


def slider_place(window, number):
    """Return the position of a number on the slider."""
    window.refresh()
    track, option = slider(window), QStyleOptionSlider()
    track.initStyleOption(option)
    option.sliderPosition = number
    parts = QStyle.ComplexControl.CC_Slider, option, QStyle.SubControl.SC_SliderHandle
    return track.style().subControlRect(*parts, track).center()


def go(window, qtbot, number):
    """Press the slider at a number."""
    QTest.mouseClick(slider(window), LEFT, pos=slider_place(window, number))
    qtbot.waitUntil(at(window, number))
    window.refresh()


def at(window, number):
    return lambda: (
        window.session.timeline.shown_iteration is not None and window.session.timeline.shown_iteration.number == number
    )


def check(window, text):
    box = named(window.features["smooth"].panel, QCheckBox, text)
    QTest.mouseClick(box, LEFT, pos=QPoint(8, box.height() // 2))
    assert box.isChecked()


@pytest.mark.slow
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


def test_a_breakpoint_pauses_and_selects_the_hex(window, qtbot):
    click(window, "Pause when")
    check(window, "A hex inverts")
    choose(window, "laplacian", ENDLESS)
    with qtbot.waitSignal(window.session.run.hit) as hit:
        click_until(window, qtbot, "Run", Phase.PAUSED)
    frame = hit.args[0]
    assert window.session.selection.hex == frame.hit.hexes[0]
    assert window.canvas.viewport.filters.ghosts(window.canvas.viewport.frame) is None  # nothing is before it
    assert sentence(window) == f"Paused at a breakpoint: {frame.hit.sentence}."
    assert at(window, frame.iteration.number)()
    assert frame.hit.sentence in slider(window).toolTip()


@pytest.mark.slow
def test_memory_and_speed_are_remembered(window, qtbot):
    record = stepped(window, qtbot)
    each = (window.session.history.bytes) // 12
    window.session.history.set_limit(4 * each)
    menu = named(window.features["timeline"].panel, QToolButton, "Timeline settings").menu()
    choices = {action.text(): action for part in (menu, *menu.findChildren(QMenu)) for action in part.actions()}
    choices["128 MiB"].trigger()
    choices["30 iterations per second"].trigger()
    assert window.session.history.limit == 128 << 20
    assert window.session.timeline.speed == 30
    assert (QSettings().value("history_megabytes"), QSettings().value("iterations_played")) == (128, 30)
    window.refresh()
    assert "5 of them are stored" in slider(window).toolTip()
    assert not choices["Delete this run"].isEnabled()  # it is under way
    with qtbot.waitSignal(window.session.run.ended):
        click(window, "Stop")
    window.refresh()
    choices["Delete this run"].trigger()
    window.refresh()
    assert record not in window.session.history.records
    assert not window.window_actions["iteration_play"].isEnabled()


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


# Buttons below the view run, pause, step and stop, and a word says the state, whatever panel is open.


def bar_of(window):
    window.refresh()
    return window.features["timeline"].panel.run_bar


def test_a_run_is_started_paused_stepped_stopped_and_reset_by_mouse(window, qtbot):
    document, start = window.session.document, window.session.document.now
    choose(window, "local-sd", StoppingCriteria(max_iterations=100_000, tolerance=0))
    bar = bar_of(window)
    assert bar.isVisible()
    assert bar.state == "Ready"
    press(bar.button("run"))
    qtbot.waitUntil(phase(window, Phase.RUNNING))
    qtbot.waitUntil(lambda: document.now is not start)
    assert bar_of(window).state == "Running"
    assert bar.button("run").text() == "Pause"
    press(bar.button("run"))
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    assert bar_of(window).state == "Paused"
    newest = window.session.run.record.newest
    press(bar.button("step"))
    qtbot.waitUntil(lambda: window.session.run.record.newest == newest + 1)
    qtbot.waitUntil(phase(window, Phase.PAUSED))
    press(bar_of(window).button("stop"))
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    assert bar_of(window).state == "Stopped"
    assert window.isWindowModified()
    assert document.undo_title == "Local steepest descent"
    click(window, "Reset")
    np.testing.assert_array_equal(document.now.mesh.points, start.mesh.points)
    assert document.undo_title == "reset"


@pytest.mark.slow
def test_a_result_that_is_undone_or_reset_is_not_called_converged(window, qtbot):
    bar = bar_of(window)
    choose(window, "local-sd", StoppingCriteria(max_iterations=3, tolerance=0))
    with qtbot.waitSignal(window.session.run.ended):
        press(bar.button("run"))
    for action, state in (
        ("undo", "Undone"),
        ("redo", "Iteration limit"),
        ("reset", "Undone"),
        ("undo", "Iteration limit"),
        ("first", "Iteration limit"),
    ):
        window.refresh()
        window.action("iteration_first" if action == "first" else action).trigger()
        window.refresh()
        assert bar.state == state, action


@pytest.mark.parametrize("outcome", list(Outcome))
def test_every_outcome_has_a_word(qapp, outcome):
    bar = RunBar()
    bar.set_state(Phase.FINISHED, outcome)
    word = bar.state
    assert word
    bar.set_state(Phase.FINISHED, outcome, inverted=44)
    assert bar.state == ("44 inverted" if word in ("Converged", "Done") else word)
    bar.deleteLater()


@pytest.mark.slow
def test_a_failed_run_says_so(window, qtbot, monkeypatch):
    def steps(self, mesh):
        yield Step(mesh.points)
        raise ZeroDivisionError("one over nothing")

    choose(window, "local-sd")
    monkeypatch.setattr(METHODS["local-sd"], "steps", steps)
    with qtbot.waitSignal(window.session.run.failed):
        press(bar_of(window).button("run"))
    assert bar_of(window).state == "Failed"
