"""Runs in the window: started, paused, stepped, stopped and reset, by mouse and keys."""

from __future__ import annotations

import threading

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QMessageBox

from hexmend.run import StoppingCriteria
from hexmend_app.state.run import worker
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, click, key, named, phase
from tests.patience import PATIENCE

CONTROL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier


@pytest.fixture
def endless(window):
    """The window, set up with a method that runs until it is stopped."""
    choose(window, "local-sd", StoppingCriteria(tolerance=0.0))
    return window


def sentence(window):
    """Return the sentence below the buttons."""
    window.refresh()
    return named(window.features["smooth"].panel, QLabel, "Outcome").text()


def counts(window):
    """Return the text of the counts below the view."""
    window.refresh()
    return named(window, QLabel, "Counts").text()


def test_run_pause_step_stop_reset_by_mouse(endless, qtbot):
    window, document = endless, endless.session.document
    start = document.now
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.RUNNING), timeout=PATIENCE)
    qtbot.waitUntil(lambda: document.now is not start, timeout=PATIENCE)
    click(window, "Pause")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    held = document.now
    click(window, "Step")
    qtbot.waitUntil(lambda: document.now is not held, timeout=PATIENCE)
    assert document.now.summary.objective != held.summary.objective or held.summary.objective is None
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
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
    choose(window, "laplacian", StoppingCriteria(tolerance=0.0, max_iterations=3))
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        click(window, "Run")
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
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
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
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    with monkeypatch.context() as patched:
        patched.setattr(QMessageBox, "exec", lambda self: QMessageBox.StandardButton.Cancel)
        window.close()
        assert window.isVisible()
        assert window.session.run.phase is Phase.PAUSED


@pytest.mark.slow
@pytest.mark.parametrize(("metric", "shown"), [("q", "scaled-jacobian"), ("condition", "condition")])
def test_a_run_that_raises_the_scaled_jacobian_is_coloured_by_it(window, qtbot, metric, shown):
    window.session.view.change(colours={"metric": metric})
    choose(window, "mend", goal="scaled-jacobian")
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    assert window.session.view.look.colours.metric == shown
