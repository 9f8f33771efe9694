"""What the panel says of a run that ended."""

import pytest
from PySide6.QtWidgets import QLabel

from hexmend.advice import advise
from hexmend.gallery import make
from hexmend.run import iterate, smooth
from hexmend_app.features.outcome.outcome_panel import OutcomePanel


@pytest.fixture
def panel(shown):
    return shown(OutcomePanel(), 400, 300)


def said(panel):
    return [label.text() for label in panel.findChildren(QLabel) if label.isVisible()]


def test_a_run_that_was_stopped_before_it_began_is_only_said_to_be(panel):
    run = iterate(make("cube", size=27, scramble=0.0), "mend")
    run.close()
    panel.show_advice("Why mend stopped", advise(run.result()))
    assert any("before its first iteration" in text for text in said(panel))
    assert not any("No further suggestions" in text or text == "What to try next" for text in said(panel))
    panel.show_advice("Why mend stopped", advise(smooth(make("cube", size=27), "mend")))
    assert "No further suggestions." in said(panel)
    assert "What to try next" in said(panel)
