"""Panel of the outcome of a run."""

import numpy as np
import pytest
from PySide6.QtWidgets import QLabel

from hexmend.advice import advise
from hexmend.gallery import make
from hexmend.run import iterate, smooth
from hexmend_app.features.outcome.outcome_panel import OutcomePanel


@pytest.fixture
def panel(shown):
    return shown(OutcomePanel(), 400, 300)


def texts(panel):
    return [label.text() for label in panel.findChildren(QLabel) if label.isVisible()]


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
