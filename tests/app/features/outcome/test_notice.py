"""Notice at the end of a run, whatever panel is open."""

import re
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtWidgets import QPushButton

from hexmend.iteration import StoppingCriteria
from hexmend_app.features.outcome.notice import notice
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, click, phase, press
from tests.patience import PATIENCE


def run(window, qtbot, method, **stop):
    choose(window, method, StoppingCriteria(**stop))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.refresh()


def choice(window, text):
    (button,) = (b for b in window.messages.findChildren(QPushButton) if b.text() == text and not b.isHidden())
    return button


def test_it_says_what_a_run_has_changed_and_undoes_it(window, qtbot):
    start = window.session.document.now
    run(window, qtbot, "mend")
    title, text = window.messages.title.text(), window.messages.text.text()
    counts = rf"{start.summary.inverted} → 0 inverted · {start.summary.invalid} → 0 invalid"
    pattern = rf"{counts} · q min 0\.\d{{3}} · scaled Jacobian min 0\.\d{{3}}"
    assert re.fullmatch(pattern, title)
    assert re.fullmatch(r"\d+ iterations · \d+\.\d\d s · Converged.*", text)
    press(choice(window, "Undo"))
    np.testing.assert_array_equal(window.session.document.now.mesh.points, start.mesh.points)
    assert not window.messages.isVisible()


@pytest.mark.slow
def test_it_is_removed_when_its_result_is_undone_by_other_means(window, qtbot):
    run(window, qtbot, "local-sd", max_iterations=2)
    window.messages.show_error("Other")
    assert sorted(kind for kind, *_ in window.messages.messages()) == ["error", "info"]
    window.action("undo").trigger()
    window.refresh()
    assert [title for _, title, _ in window.messages.messages()] == ["Other"]
    window.action("redo").trigger()
    window.refresh()
    assert [title for _, title, _ in window.messages.messages()] == ["Other"]


@pytest.mark.slow
def test_its_undo_leaves_later_changes_alone(window, qtbot):
    run(window, qtbot, "local-sd", max_iterations=2)
    undo = choice(window, "Undo")
    window.session.commands.reset()
    reset = window.session.document.now
    press(undo)
    assert window.session.document.now is reset


def test_a_run_that_helps_nothing_keeps_the_mesh_and_says_so():
    record = SimpleNamespace(result=0, message="Iteration 0 was kept: later ones were worse.")
    title, text = notice(record, None, None)
    assert title == "Initial mesh kept: no iteration was better"
    assert text == record.message
