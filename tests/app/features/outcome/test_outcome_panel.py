"""Panel of the outcome of a run."""

import numpy as np
import pytest
from PySide6.QtWidgets import QLabel

from hexmend import LocalSteepestDescent, StoppingCriteria, advise, iterate, smooth
from hexmend.gallery import make
from hexmend_app.features.outcome.feature import FeatureOutcome
from hexmend_app.features.outcome.outcome_panel import OutcomePanel
from tests.app.driving import texts
from tests.core.grids import grid, scrambled


@pytest.fixture
def panel(shown):
    return shown(OutcomePanel(), 400, 300)


def test_a_run_stopped_before_its_first_iteration_gets_no_suggestions(panel):
    run = iterate(make("cube", size=27, scramble=0.0), "mend")
    run.close()
    panel.show_advice("Why mend stopped", advise(run.result()))
    assert any("before its first iteration" in text for text in texts(panel))
    assert not any("No further suggestions" in text or text == "Suggestions" for text in texts(panel))
    panel.show_advice("Why mend stopped", advise(smooth(make("cube", size=27), "mend")))
    assert "No further suggestions." in texts(panel)
    assert "Suggestions" in texts(panel)


def test_hexes_left_inverted_have_the_numbers_of_the_file_too(panel):
    result = smooth(make("cube", size=125, scramble=2.0), "laplacian", max_iterations=0)
    advice = advise(result)
    assert advice.unlocked.size
    panel.show_advice("Why Laplacian stopped", advice, np.arange(125) + 501)
    listed = ", ".join(str(number + 501) for number in advice.unlocked[:24])
    assert any(text.startswith("Inverted: ") and text.endswith(f" (in the file {listed})") for text in texts(panel))


# After undo, reset and a move in the timeline, a note says that the mesh in the view is not the result of the run.


@pytest.fixture
def host(hosted):
    return hosted(scrambled(grid(4), 0.3))


@pytest.fixture
def shown_texts(host, qtbot):
    """Return a function that gives the texts of the panel after a run of eight iterations."""
    feature = FeatureOutcome(host)
    qtbot.addWidget(feature.panel)
    with qtbot.waitSignal(host.session.run.ended):
        host.session.run.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0, max_iterations=8))

    def visible_texts():
        feature.refresh()
        return " ".join(label.text() for label in feature.panel.findChildren(QLabel) if not label.isHidden())

    return visible_texts


def test_the_result_of_the_run_has_no_note(shown_texts):
    assert "Why Local steepest descent stopped" in shown_texts()
    assert "The view shows" not in shown_texts()


@pytest.mark.parametrize("command", ["undo", "reset"])
def test_the_note_after_undo_and_reset(host, shown_texts, command):
    getattr(host.session.commands, command)()
    assert "the mesh before the run" in shown_texts()
    if command == "undo":
        host.session.commands.redo()
    else:
        host.session.commands.undo()
    assert "the mesh before the run" not in shown_texts()


def test_the_iteration_in_the_view_is_named(host, shown_texts):
    host.session.timeline.go(host.session.timeline.record, 5)
    assert "at Local steepest descent 5" in shown_texts()
