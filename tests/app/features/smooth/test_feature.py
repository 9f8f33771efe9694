"""Runs in the window: started, paused, stepped, stopped and reset, by mouse and keys."""

import threading

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QMessageBox

from hexmend import METHODS, Stage, StoppingCriteria
from hexmend_app.state.run import worker
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.run.run_settings import Pace
from hexmend_app.state.session import commands
from hexmend_app.state.settings import settings
from tests.app.driving import choose, click, click_until, key, named, phase, run_to_end, sentence
from tests.patience import PATIENCE

CONTROL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def endless(window):
    """The window, set up with a method that runs until it is stopped."""
    choose(window, "local-sd", StoppingCriteria(tolerance=0.0))
    return window


def counts(window):
    """Return the text of the counts below the view."""
    window.refresh()
    return named(window, QLabel, "Counts").text()


def test_run_pause_step_stop_reset_by_mouse(endless, qtbot):
    window, document = endless, endless.session.document
    start = document.now
    click_until(window, qtbot, "Run", Phase.RUNNING)
    qtbot.waitUntil(lambda: document.now is not start)
    click_until(window, qtbot, "Pause", Phase.PAUSED)
    held = document.now
    click(window, "Step")
    qtbot.waitUntil(lambda: document.now is not held)
    assert document.now.summary.objective != held.summary.objective or held.summary.objective is None
    click_until(window, qtbot, "Stop", Phase.FINISHED)
    window.refresh()
    assert window.isWindowModified()
    assert document.undo_title == "Local steepest descent"
    click(window, "Reset")
    np.testing.assert_array_equal(document.now.mesh.points, start.mesh.points)
    assert document.undo_title == "reset"


@pytest.mark.slow
@pytest.mark.parametrize("back", [Qt.Key.Key_Z, Qt.Key.Key_R], ids=["undo", "reset"])
def test_the_outcome_of_a_run_follows_undo_and_redo(window, qtbot, back):
    panel, before = window.features["smooth"].panel, counts(window)
    run_to_end(window, qtbot, "laplacian", tolerance=0.0, max_iterations=3)
    after, said, progress = counts(window), sentence(window), named(panel, QLabel, "Progress").text()
    assert after != before
    assert said
    assert "iteration" in progress
    key(window, back, CONTROL)
    assert (counts(window), sentence(window)) == (before, "")
    assert named(panel, QLabel, "Progress").text() != progress
    key(window, Qt.Key.Key_Z, CONTROL, *([SHIFT] if back == Qt.Key.Key_Z else []))
    assert (counts(window), sentence(window)) == (after, said)
    assert named(panel, QLabel, "Progress").text() == progress


@pytest.fixture
def slow_method(monkeypatch):
    """Block the preparation of a method until the returned event is set."""
    go_on, iterate = threading.Event(), worker.iterate

    def preparing(*order):
        go_on.wait(PATIENCE / 1000)
        return iterate(*order)

    monkeypatch.setattr(worker, "iterate", preparing)
    yield go_on
    go_on.set()


@pytest.mark.slow
def test_a_run_is_stopped_while_its_method_is_prepared(window, qtbot, slow_method):
    before = window.session.document.now
    click(window, "Run")
    assert window.session.run.phase is Phase.PREPARING
    assert "Preparing" in sentence(window)
    click(window, "Stop")
    assert window.session.run.phase is Phase.STOPPING
    assert "when the method is ready" in sentence(window)
    assert not window.action("stop").isEnabled()
    slow_method.set()
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    assert window.session.document.now is before
    assert window.session.document.undo_title is None
    assert "Stopped" in sentence(window)
    assert not window.busy.isVisible()
    window.session.commands.tag("bad", [7])
    assert sentence(window) == ""  # the mesh is no longer that of the run


# Closing the window


@pytest.mark.slow
def test_cancelling_keeps_the_window_and_its_run(fresh_window, qtbot, monkeypatch):
    window = fresh_window
    click_until(window, qtbot, "Step", Phase.PAUSED)
    with monkeypatch.context() as patched:
        patched.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Cancel)
        window.close()
        assert window.isVisible()
        assert window.session.run.phase is Phase.PAUSED


# The pace at which iterations are shown is chosen in a menu and stored.


def test_a_pace_is_chosen_in_the_menu_and_stored(window):
    pace = Pace.EVERY
    action = window.action(f"pace_{pace.value}")
    action.trigger()
    window.refresh()
    assert window.session.run.pace is pace
    assert [one for one in Pace if window.action(f"pace_{one.value}").isChecked()] == [pace]
    assert Pace(settings.RUN_PACE.get()) is pace


# Shortage of memory: the window asks before a run, and nothing changes if the user declines.


YES, NO = QMessageBox.StandardButton.Yes, QMessageBox.StandardButton.No


@pytest.fixture
def asked(window, monkeypatch):
    """Make memory short; record the questions of the window and answer them with `answer`."""

    class Asked(list):
        answer = NO

        def exec(self, box):
            self.append(f"{box.text()} {box.informativeText()}")
            return self.answer

    asked = Asked()
    monkeypatch.setattr(commands, "available", lambda: 80_000_000)
    monkeypatch.setattr(QMessageBox, "exec", lambda box: asked.exec(box))
    monkeypatch.setattr(METHODS["mend"], "bytes_per_hex", 10**9)
    return asked


@pytest.mark.slow
def test_a_run_starts_only_with_consent(window, qtbot, asked):
    session = window.session
    before = session.document.now
    choose(window, "mend", StoppingCriteria(max_iterations=2))
    for begin in (lambda: click(window, "Run"), lambda: click(window, "Step"), lambda: key(window, Qt.Key.Key_F5)):
        begin()
        assert session.run.phase is Phase.IDLE
        assert session.document.now is before
        assert not session.history.records
    assert len(asked) == 3
    assert "Mend on " in asked[0]
    assert "80\u00a0MB are free" in asked[0]
    assert METHODS["local-sd"].title in asked[0] or METHODS["local-nr"].title in asked[0]
    asked.answer = YES
    with qtbot.waitSignal(session.run.ended):
        click(window, "Run")
    assert session.document.now is not before


def test_a_recipe_and_a_comparison_need_consent(window, asked):
    session = window.session
    session.recipe_draft.add(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=2)))
    session.recipe_draft.add(Stage(METHODS["mend"](), StoppingCriteria(max_iterations=2)))
    window.features["recipe"].run()
    assert session.run.phase is Phase.IDLE
    window.features["compare"].panel.run_requested.emit(["laplacian", "mend"])
    assert not session.comparison.busy
    assert len(asked) == 2


@pytest.mark.slow
def test_a_branch_without_consent_leaves_the_active_run(window, qtbot, asked):
    choose(window, "laplacian", StoppingCriteria(tolerance=0.0))
    click_until(window, qtbot, "Step", Phase.PAUSED)
    record = window.session.run.record
    window.session.commands.branch(Stage(METHODS["mend"](), StoppingCriteria()))
    assert len(asked) == 1
    assert window.session.run.phase is Phase.PAUSED
    assert window.session.run.record is record
