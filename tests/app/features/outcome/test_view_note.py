"""After undo, reset and a move in the timeline, a note says that the mesh in the view is not the result of the run."""

import pytest
from PySide6.QtWidgets import QLabel

from hexmend.run import StoppingCriteria
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from hexmend_app.features.outcome.feature import FeatureOutcome
from tests.app.hosting import PlainHost
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE


@pytest.fixture
def host(qtbot):
    host = PlainHost(scrambled(grid(4), 0.3))
    yield host
    host.session.close()


@pytest.fixture
def texts(host, qtbot):
    """Return a function that gives the texts of the panel after a run of eight iterations."""
    feature = FeatureOutcome(host)
    qtbot.addWidget(feature.panel)
    with qtbot.waitSignal(host.session.run.ended, timeout=PATIENCE):
        host.session.run.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0, max_iterations=8))

    def visible_texts():
        feature.refresh()
        return " ".join(label.text() for label in feature.panel.findChildren(QLabel) if not label.isHidden())

    return visible_texts


def test_the_result_of_the_run_has_no_note(texts):
    assert "Why Local steepest descent stopped" in texts()
    assert "The view shows" not in texts()


@pytest.mark.parametrize("command", ["undo", "reset"])
def test_the_note_after_undo_and_reset(host, texts, command):
    getattr(host.session.commands, command)()
    assert "the mesh before the run" in texts()
    if command == "undo":
        host.session.commands.redo()
    else:
        host.session.commands.undo()
    assert "the mesh before the run" not in texts()


def test_the_iteration_in_the_view_is_named(host, texts):
    host.session.timeline.go(host.session.timeline.record, 5)
    assert "at Local steepest descent 5" in texts()
