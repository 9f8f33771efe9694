"""Shortage of memory: the window asks before a run, and nothing changes if the user declines."""

from __future__ import annotations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox

from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session import commands
from tests.app.driving import choose, click, key, phase
from tests.patience import PATIENCE

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
    with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
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
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    record = window.session.run.record
    window.session.commands.branch(Stage(METHODS["mend"](), StoppingCriteria()))
    assert len(asked) == 1
    assert window.session.run.phase is Phase.PAUSED
    assert window.session.run.record is record
