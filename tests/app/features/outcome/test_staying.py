"""After undo, reset and on the way through a run, the explanation says that it is of something else."""

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
def said(host, qtbot):
    """What the panel says once a run of eight iterations has ended."""
    feature = FeatureOutcome(host)
    qtbot.addWidget(feature.panel)
    with qtbot.waitSignal(host.session.run.ended, timeout=PATIENCE):
        host.session.run.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0, max_iterations=8))

    def say():
        feature.refresh()
        return " ".join(label.text() for label in feature.panel.findChildren(QLabel) if not label.isHidden())

    return say


def test_what_the_run_left_is_explained_without_more(said):
    assert "Why Local steepest descent stopped" in said()
    assert "The mesh" not in said()


@pytest.mark.parametrize("way", ["undo", "reset"])
def test_what_was_taken_back_is_said_to_be(host, said, way):
    getattr(host.session.commands, way)()
    assert "as it was before the run" in said()
    if way == "undo":
        host.session.commands.redo()
    else:
        host.session.commands.undo()
    assert "as it was before the run" not in said()


def test_an_iteration_on_the_way_is_named(host, said):
    host.session.timeline.go(host.session.timeline.record, 5)
    assert "at Local steepest descent 5" in said()
