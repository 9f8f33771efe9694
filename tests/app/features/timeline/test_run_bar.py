"""Buttons below the view run, pause, step and stop, and a word says the state, whatever panel is open."""

import pytest

from hexmend.iteration import Outcome, Step, StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend_app.features.timeline.run_bar import RunBar
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, phase, press
from tests.patience import PATIENCE


def bar_of(window):
    window.refresh()
    return window.features["timeline"].panel.run_bar


def test_a_run_is_started_paused_stepped_and_stopped_below_the_view(window, qtbot):
    choose(window, "local-sd", StoppingCriteria(max_iterations=100_000, tolerance=0))
    bar = bar_of(window)
    assert bar.isVisible()
    assert bar.state == "Ready"
    press(bar.button("run"))
    qtbot.waitUntil(phase(window, Phase.RUNNING), timeout=PATIENCE)
    assert bar_of(window).state == "Running"
    assert bar.button("run").text() == "Pause"
    press(bar.button("run"))
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    assert bar_of(window).state == "Paused"
    newest = window.session.run.record.newest
    press(bar.button("step"))
    qtbot.waitUntil(lambda: window.session.run.record.newest == newest + 1, timeout=PATIENCE)
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    press(bar_of(window).button("stop"))
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert bar_of(window).state == "Stopped"


@pytest.mark.slow
def test_a_result_that_is_undone_or_reset_is_not_called_converged(window, qtbot):
    bar = bar_of(window)
    choose(window, "local-sd", StoppingCriteria(max_iterations=3, tolerance=0))
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
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
    assert bar.state
    bar.deleteLater()


@pytest.mark.slow
def test_a_failed_run_says_so(window, qtbot, monkeypatch):
    def steps(self, mesh):
        yield Step(mesh.points)
        raise ZeroDivisionError("one over nothing")

    choose(window, "local-sd")
    monkeypatch.setattr(METHODS["local-sd"], "steps", steps)
    with qtbot.waitSignal(window.session.run.failed, timeout=PATIENCE):
        press(bar_of(window).button("run"))
    assert bar_of(window).state == "Failed"
